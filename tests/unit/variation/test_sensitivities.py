"""The table of sensitivities: known relations, the variation itself, text and JSON, refusals."""

from __future__ import annotations

import json
from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose

from assoc_hull.analysis.derivatives.parameters import DRAUGHT, PointMove
from assoc_hull.errors import BadInputError, UnknownNameError, WrongTypeError
from assoc_hull.hull import Hull
from assoc_hull.variation.fields.anchor_fields import hat_field
from assoc_hull.variation.fields.bounded_functions import BlendChain
from assoc_hull.variation.fields.layers import FieldLayer
from assoc_hull.variation.sensitivities import Sensitivities


@pytest.fixture(scope="module")
def wigley(shipped: Callable[[str], Hull]) -> Hull:
    """A hull with a formula."""
    return shipped("wigley")


@pytest.fixture(scope="module")
def series(shipped: Callable[[str], Hull]) -> Hull:
    """Series 60, CB 0.70."""
    return shipped("series60_70")


@pytest.fixture(scope="module")
def every(wigley: Hull) -> Sensitivities:
    """The usual outputs by all that the hull has."""
    return wigley.sensitivities()


def test_dimensions_scale_the_hull(every: Sensitivities, wigley: Hull) -> None:
    """V grows with each of L, B, T in proportion and CB stays, but for what lofting leaves."""
    ship, volume = wigley.particulars, every.values[0]
    for name, size in (("length", ship.length), ("breadth", ship.breadth), ("draught", 6.25)):
        assert_allclose(every.of("volume", name) * size, volume, rtol=1e-5)
        assert abs(every.of("cb", name) * size) < 1e-5
    assert_allclose(every.of("lcb", "length"), 0.5, rtol=1e-9)
    assert_allclose(every.of("kb", "draught") * ship.draught, every.values[2], rtol=1e-5)


def test_what_the_hull_has_not_is_told(every: Sensitivities) -> None:
    """By name, with the reason; what it has is differentiated."""
    assert "bulb_length" in every.absent
    assert "profile" in every.absent["bulb_length"]
    assert not set(every.parameters) & set(every.absent)
    assert "bulb_length: " in str(every)


def test_the_table_tells_what_a_variation_does(series: Hull) -> None:
    """Central differences of varied hulls, whose lines are all carried, cut and lofted anew."""
    outputs, change = ["volume", "lcb", "cb", "kmt"], 0.05
    found = series.sensitivities(outputs, ["fore_shift"])
    ends = [series.vary(set={"fore_shift": sign * change}).hull for sign in (1.0, -1.0)]
    plus, minus = (each.hydrostatics(estimate=False) for each in ends)
    for i, field in enumerate(outputs):
        wanted = (getattr(plus, field) - getattr(minus, field)) / (2.0 * change)
        size = max(abs(wanted), abs(found.values[i]) / series.particulars.length)
        assert abs(found.matrix[i, 0] - wanted) <= 1e-7 * size


def test_layers_points_and_the_draught_stand_beside_names(wigley: Hull) -> None:
    """A layer by its strength: one twice as strong does twice as much; the draught adds A_W."""
    along = BlendChain.through([20.0, 40.0], [1.0, 0.0])
    deeper, twice = (
        FieldLayer(name, (hat_field("keel", [("keel", 0.0, size), ("T", 6.0, 0.0)], along),))
        for name, size in (("deeper", -0.05), ("twice", -0.1))
    )
    point = PointMove("WL 2.5 x ST 7", follow=True)
    found = wigley.sensitivities(
        ["volume", "kb"], [deeper, twice, point, DRAUGHT, "mean_draught", "trim"]
    )
    one, two = found.row("volume")[:2]
    assert one > 0.0
    assert_allclose(two, 2.0 * one, rtol=1e-6)
    assert found.of("volume", "draught") == found.of("volume", "mean_draught")
    area = wigley.hydrostatics(estimate=False).waterplane_area
    assert_allclose(found.of("volume", "mean_draught"), area, rtol=1e-4)
    assert found.of("volume", point.title) > 0.0
    assert found.per[:3] == ("-", "-", "m")


def test_it_can_be_read_as_data_and_as_text(wigley: Hull) -> None:
    """JSON has all of it; the text is aligned, tells units, and what hangs on differences."""
    found = wigley.sensitivities(["volume", "L_E"], ["breadth", "depth"])
    data = json.loads(found.to_json())
    assert data["derivatives"] == found.matrix.tolist()
    assert [each["exact"] for each in data["outputs"]] == [True, False]
    assert [each["usual"] for each in data["parameters"]] == found.usual.tolist()
    rows = str(found).splitlines()
    assert len({len(row) for row in rows[:5]}) == 1
    assert rows[0].split() == ["per", "volume", "L_E", "~"]
    assert rows[-1] == "~ by differences, extrapolated"
    assert "0.5 m" in found.table("usual")
    assert_allclose(found.percent[0, 0], 5.0, rtol=1e-4)
    with pytest.raises(ValueError, match="read-only"):
        found.matrix[0, 0] = 0.0


@pytest.mark.parametrize(
    ("outputs", "parameters", "error", "words"),
    [
        (["volume"], ["bredth"], UnknownNameError, "'breadth'"),
        (["volume"], ["bulb_length"], BadInputError, "cannot vary 'bulb_length'"),
        (["volume"], ["breadth", "breadth"], BadInputError, "twice"),
        (["volume"], "breadth", WrongTypeError, "list"),
        (["volume"], [3.0], WrongTypeError, "give a name"),
        (["volum"], ["breadth"], UnknownNameError, "'volume'"),
    ],
)
def test_what_is_not_known_is_refused(
    outputs: list[str], parameters: object, error: type[Exception], words: str, wigley: Hull
) -> None:
    """With the nearest names, or why not."""
    with pytest.raises(error, match=words):
        wigley.sensitivities(outputs, parameters)  # type: ignore[arg-type]


def test_the_table_knows_its_names(every: Sensitivities) -> None:
    """An output or parameter that it has not, and a scale that is none."""
    with pytest.raises(UnknownNameError, match="'volume'"):
        every.of("volum", "breadth")
    with pytest.raises(UnknownNameError, match="'breadth'"):
        every.of("volume", "bredth")
    with pytest.raises(BadInputError, match="scale"):
        every.table("relative")
    assert np.array_equal(every.per_usual, every.matrix * every.usual)
