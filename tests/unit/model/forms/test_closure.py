"""Closures: the entrance by which a curve of two halves has its fullness and its centroid."""

from typing import Any

import numpy as np
import pytest

from assoc_hull.errors import BadInputError, OutOfRangeError
from assoc_hull.model.form_definition import FormDefinition
from assoc_hull.model.forms.closure import close_halves, close_sac, coefficients
from assoc_hull.model.forms.two_halves import halves_vertices
from assoc_hull.model.tables import Particulars

SHIP = Particulars("ship", 180.0, 28.0, 15.8, 10.5)

TYPES: dict[str, tuple[dict[str, Any], tuple[float, float]]] = {
    "type 1": (
        {
            "run_area": 0.55, "run_centroid": -0.59, "run_start_angle_deg": 60.0,
            "run_start_curvature": -2.0, "run_end": -0.30, "top": 1.0, "entrance_start": 0.20,
            "entrance_area": 0.60, "entrance_centroid": 0.52, "entrance_end_angle_deg": -50.0,
            "entrance_end_curvature": -2.0,
        },
        (0.825, -1.136),
    ),
    "type 2": (
        {
            "run_area": 0.775, "run_centroid": -0.50, "run_start_angle_deg": 60.0,
            "run_start_curvature": 0.0, "run_end": -0.10, "top": 1.0, "entrance_start": -0.10,
            "entrance_area": 0.775, "entrance_centroid": 0.325, "entrance_end_angle_deg": -20.0,
            "entrance_end_curvature": 0.0,
        },
        (0.775, -4.375),
    ),
}  # fmt: skip


def areas(use: str = "sectional_area", full: float = 292.59, **values: Any) -> FormDefinition:
    """A curve between perpendiculars that ends at nil."""
    ends = {"run_start": -1.0, "run_start_ordinate": 0.0, "entrance_end": 1.0}
    return FormDefinition("areas", use, "halves", {"full": full, **ends, **values})


def bulk(**values: Any) -> FormDefinition:
    """The curve of areas of the bulk carrier, without an entrance."""
    given: dict[str, Any] = {
        "run_start_ordinate": 6.08 / 292.59, "run_start_angle_deg": 25.0,
        "run_start_tangent": 0.067, "run_end": -0.208, "run_end_tangent": 0.298,
        "run_area": 0.511, "run_centroid": -0.488, "top": 1.0, "entrance_start": 0.34,
        "entrance_end_angle_deg": -54.0, "entrance_start_tangent": 0.222,
        "entrance_end_tangent": 0.053,
    }  # fmt: skip
    return areas(**{**given, **values})


@pytest.mark.parametrize("name", list(TYPES))
def test_coefficients_of_printed_curves(name: str) -> None:
    """Prismatic coefficient and centroid are those of the sums, to the printed digits."""
    values, (cp, lcb) = TYPES[name]
    found = coefficients(areas(**values), SHIP)
    assert found.fullness == pytest.approx(cp, abs=1e-12)
    assert found.centroid_percent == pytest.approx(lcb, abs=5e-4)


@pytest.mark.parametrize("name", list(TYPES))
def test_closure_gives_the_entrance_back(name: str) -> None:
    """From fullness and centroid come the entrance's area and centroid."""
    values, _ = TYPES[name]
    now = coefficients(areas(**values), SHIP)
    given = {key: value for key, value in values.items() if key[:13] != "entrance_area"}
    given.pop("entrance_centroid")
    closed = close_halves(areas(**given), SHIP, cp=now.fullness, lcb=now.centroid)
    assert closed.value("entrance_area") == pytest.approx(values["entrance_area"], abs=1e-12)
    assert closed.value("entrance_centroid") == pytest.approx(
        values["entrance_centroid"], abs=1e-12
    )


def test_entrance_of_the_bulk_carrier() -> None:
    """The test vector has its printed entrance, and block coefficient and centroid exactly."""
    closed = close_halves(bulk(), SHIP, cb=0.75, lcb=2.90)
    assert closed.value("entrance_area") == pytest.approx(0.448228545063, abs=5e-13)
    assert closed.value("entrance_centroid") == pytest.approx(0.584001746435, abs=5e-13)
    found = coefficients(closed, SHIP)
    assert found.block == pytest.approx(0.75, abs=1e-12)
    assert found.centroid == pytest.approx(2.90, abs=1e-12)
    assert found.fullness == pytest.approx(0.753614272532, abs=5e-13)


def test_a_waterline_is_closed_as_well() -> None:
    """Waterplane coefficient and centre of flotation; what is not given stays."""
    values, _ = TYPES["type 1"]
    line = areas("design_waterline", full=14.0, **values)
    closed = close_halves(line, SHIP, cw=0.83)
    found, was = coefficients(closed, SHIP), coefficients(line, SHIP)
    assert found.fullness == pytest.approx(0.83, abs=1e-13)
    assert found.centroid == pytest.approx(was.centroid, abs=1e-12)
    assert found.block is None


def test_a_run_by_fairness_is_measured() -> None:
    """Where the run has no area of its own, the closure takes that of its curve."""
    free = bulk(run_area=None, run_centroid=None)
    found = coefficients(close_halves(free, SHIP, cb=0.75, lcb=0.6), SHIP)
    assert (found.block, found.centroid) == pytest.approx((0.75, 0.6), abs=1e-12)


def test_limits_are_where_the_entrance_ends_to_be_one() -> None:
    """At the told ends of the interval an entrance can still be made, beyond them none can."""
    with pytest.raises(OutOfRangeError) as caught:
        close_halves(bulk(), SHIP, cb=0.75, lcb=6.0)
    low, high = caught.value.least, caught.value.most
    assert (caught.value.name, caught.value.unit) == ("lcb", "m")
    assert low < 2.9 < high < 6.0
    for inside, outside in ((low, low - 1e-6), (high, high + 1e-6)):
        close_halves(bulk(), SHIP, cb=0.75, lcb=inside)
        with pytest.raises(OutOfRangeError, match=r"no entrance that can be made"):
            close_halves(bulk(), SHIP, cb=0.75, lcb=outside)
    for lcb in np.linspace(low, high, 9).tolist():
        halves_vertices(close_halves(bulk(), SHIP, cb=0.75, lcb=lcb))


def test_limits_of_the_centroid_are_those_of_falling_curves() -> None:
    """A step and a flat course of the same area are the extremes."""
    run: dict[str, Any] = {
        "run_end": 0.0,
        "run_area": 0.6,
        "run_centroid": -0.4,
        "entrance_start": 0.0,
    }
    area = 0.5
    for moment in (0.5 * area**2, 0.5 * area):
        out = 1.0 if moment > 0.2 else -1.0
        lcb = (0.6 * -0.4 + moment) / (0.6 + area) - 1e-12 * out
        found = close_sac(0.5 * (0.6 + area), lcb, **run)
        assert found == pytest.approx((area, moment / area), abs=1e-11)
        beyond = lcb + 1e-6 * out
        with pytest.raises(OutOfRangeError, match="falls and rises"):
            close_sac(0.5 * (0.6 + area), beyond, **run)


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        pytest.param({"cb": 0.95}, "cb of 0.95", id="too full"),
        pytest.param({"cb": 0.3}, "cb of 0.3", id="too fine"),
        pytest.param({"cp": 0.95}, "cp of 0.95", id="too full by the prismatic coefficient"),
    ],
)
def test_fullness_outside_its_interval(asked: dict[str, float], words: str) -> None:
    """The error tells what was asked for, and between what it may lie with the centroid kept."""
    with pytest.raises(OutOfRangeError, match=words) as caught:
        close_halves(bulk(), SHIP, lcb=2.9, **asked)
    (name,) = asked
    assert "'areas'" in str(caught.value)
    for value in (caught.value.least, 0.5 * (caught.value.least + caught.value.most)):
        found = coefficients(close_halves(bulk(), SHIP, lcb=2.9, **{name: value}), SHIP)
        there = found.block if name == "cb" else found.fullness
        assert there == pytest.approx(value, abs=1e-12)
        assert found.centroid == pytest.approx(2.9, abs=1e-12)


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        pytest.param({"cw": 0.8}, "cw does not belong", id="of a waterline"),
        pytest.param({"cb": 0.75, "cp": 0.75}, "both given", id="two of a kind"),
        pytest.param({"cb": "full"}, "cb is 'full'", id="a word"),
    ],
)
def test_names_that_do_not_fit(asked: dict[str, float], words: str) -> None:
    """Each curve has its own names."""
    with pytest.raises(BadInputError, match=words):
        close_halves(bulk(), SHIP, **asked)


def test_ends_in_the_wrong_order() -> None:
    """The run must end before the entrance begins."""
    with pytest.raises(BadInputError, match=r"run ends at 0.5"):
        close_halves(bulk(run_end=0.5), SHIP, cb=0.75, lcb=2.9)


def test_a_centroid_by_fairness_stays_one() -> None:
    """Where only the fullness is asked for, an entrance without a centroid keeps it free."""
    closed = close_halves(bulk(), SHIP, cb=0.75)
    assert closed.value("entrance_centroid") is None
    assert coefficients(closed, SHIP).block == pytest.approx(0.75, abs=1e-12)
