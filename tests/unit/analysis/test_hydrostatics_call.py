"""The calls `hydrostatics`, `hydrostatic_table` and their kin: options and refusals."""

import math
from fractions import Fraction
from typing import Any

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.analysis.hydrostatics import flotation
from assoc_hull.analysis.hydrostatics.draughts_from_weight import deck_edge_angle, freeboard
from assoc_hull.analysis.hydrostatics.floating_body import FloatingPosition
from tests.floating_bodies import Box

TROUBLE = ("ST 7 is open by 0.31 m at (45.000, 2.100, 8.200) m", "ST 8 crosses itself")


@pytest.fixture(scope="module")
def hull() -> ah.Hull:
    """Dimensions 100 x 10 x 6.25 m; what is measured stands in for it."""
    return ah.examples.wigley()


@pytest.fixture
def body(monkeypatch: pytest.MonkeyPatch) -> list[Box]:
    """What is measured: the first of this list, a box."""
    bodies = [Box(breadth=10.0, depth=8.0, off=1e-6)]
    monkeypatch.setattr(flotation, "flotation", lambda state: bodies[0])
    return bodies


@pytest.mark.usefixtures("body")
def test_one_call_gives_the_record(hull: ah.Hull) -> None:
    """At the design draught, at even keel, at draughts at the perpendiculars."""
    assert hull.hydrostatics().draught_mean == 6.25
    assert hull.hydrostatics(draught=5.0).volume == pytest.approx(5000.0)
    found = hull.hydrostatics(draughts=(5.5, 4.5), heel_deg=3.0, kg=2.0)
    assert (found.draught_mean, found.trim_by_stern) == pytest.approx((5.0, 1.0))
    assert found.tcb < 0.0
    assert found.error["volume"] == pytest.approx(5e-3, rel=1e-9)
    assert hull.hydrostatics(estimate=False).error["volume"] is None


@pytest.mark.usefixtures("body")
def test_a_table_heads_its_numbers(hull: ah.Hull) -> None:
    """With the ship, its fingerprint, and what the caller chose; no date unless given."""
    fin = ah.hydro.Appendage("fin", 2.0, (50.0, 0.0, 1.0))
    table = hull.hydrostatic_table([4.0, 5.0, 6.0], [-1.0, 0.0], rho=1.0, appendages=[fin])
    head = table.header
    assert (head.ship, head.fingerprint, head.date) == ("Wigley", hull.fingerprint, None)
    assert head.water == "fresh water, 1 t/m3"
    assert attrs.evolve(head, rho=1.0252).water == "water, 1.0252 t/m3"
    assert head.appendages == (fin,)
    assert table.shape == (3, 2)
    assert table[1, 0].trim_by_stern == pytest.approx(-1.0)
    assert table[1, 1].volume == pytest.approx(5002.0)
    assert hull.hydrostatic_table([4.0], date="2026-01-31").header.date == "2026-01-31"


@pytest.mark.usefixtures("body")
def test_draughts_to_the_keel_are_longer_by_its_thickness(hull: ah.Hull) -> None:
    """In the record they are moulded, whatever was given."""
    found = hull.hydrostatics(draught=5.02, keel_thickness=0.02, draught_to="keel")
    assert found.draught_mean == pytest.approx(5.0)
    table = hull.hydrostatic_table([5.02], keel_thickness=0.02, draught_to="keel")
    assert table[0].draught_mean == pytest.approx(5.0)
    assert table.draughts["draught_aft_extreme"][0] == pytest.approx(5.02)
    assert hull.hydrostatics(keel_thickness=0.02, draught_to="keel").draught_mean == 6.25


def test_a_doubtful_hull_is_refused_or_reported(hull: ah.Hull, body: list[Box]) -> None:
    """The error names the section, and how to have the numbers all the same."""
    body[0] = attrs.evolve(body[0], trouble=TROUBLE)
    with pytest.raises(ah.errors.BadInputError, match=r"ST 7 is open .* \(and 1 more\).*report"):
        hull.hydrostatics()
    found = hull.hydrostatics(on_error="report")
    assert found.volume == pytest.approx(6250.0)
    assert found.notes == TROUBLE
    table = hull.hydrostatic_table([5.0], on_error="report")
    assert table.notes == table[0].notes == TROUBLE
    body[0] = attrs.evolve(body[0], trouble=())
    assert hull.hydrostatics(on_error="report").notes == ()


@pytest.mark.usefixtures("body")
@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"draught": 5.0, "draughts": (5.0, 5.0)}, "both given"),
        ({"draughts": (5.0,)}, "T_A, T_F"),
        ({"draught": math.nan}, "draught of nan m is no finite number.*from 0 to 8 m"),
        ({"draughts": (5.0, math.inf)}, "draught of inf m is no finite number.*from 0 to 8 m"),
        ({"draught": "deep"}, "draught is 'deep'"),
        ({"draught": 8.5}, "from 0 to 8 m"),
        ({"heel_deg": math.nan}, "heel_deg is nan"),
        ({"heel_deg": 91.0}, "heel of 91 deg"),
        ({"rho": -1.0}, "rho is -1.0"),
        ({"shell_factor": 0.0}, "shell_factor is 0.0"),
        ({"kg": math.inf}, "kg is inf"),
        ({"keel_thickness": -0.01}, "keel_thickness is -0.01"),
        ({"transom": 1}, "transom is 1"),
        ({"appendages": ["rudder"]}, "appendages"),
        ({"on_error": "ignore"}, "on_error is 'ignore'"),
        ({"draught_to": "top"}, "draught_to is 'top'"),
        ({"estimate": None}, "estimate is None"),
    ],
    ids=str,
)
def test_an_odd_option_is_refused_by_name(
    hull: ah.Hull, options: dict[str, Any], words: str
) -> None:
    """Never guessed."""
    with pytest.raises(ah.AssocHullError, match=words):
        hull.hydrostatics(**options)


@pytest.mark.usefixtures("body")
def test_numbers_of_other_sorts_count_as_numbers(hull: ah.Hull) -> None:
    """Wherever a number is taken; what is kept is the plain number."""
    given: dict[str, Any] = {
        "rho": np.float64(1.0), "shell_factor": Fraction(101, 100), "kg": np.int64(4),
        "heel_deg": np.array(0),
    }  # fmt: skip
    meant: dict[str, Any] = {"rho": 1.0, "shell_factor": 1.01, "kg": 4.0, "heel_deg": 0.0}
    one, other = (hull.hydrostatics(draught=5.0, **each) for each in (given, meant))
    assert (one.displacement, one.gmt) == (other.displacement, other.gmt)
    del given["heel_deg"], meant["heel_deg"]
    assert hull.immersion(5125.0, **given) == hull.immersion(5125.0, **meant)
    assert type(FloatingPosition(np.int64(6), np.float64(5.0)).draught_aft) is float  # type: ignore[arg-type]


@pytest.mark.usefixtures("body")
def test_weights_find_their_draughts(hull: ah.Hull) -> None:
    """And the position they give has that displacement."""
    found = hull.immersion(5125.0, lcg=50.5, kg=3.0)
    record = hull.hydrostatics(draughts=(found.draught_aft, found.draught_fore))
    assert record.displacement == pytest.approx(5125.0, rel=1e-12)
    assert found.trim_by_stern < 0.0
    with pytest.raises(
        ah.errors.OutOfRangeError, match=r"weight of nan t is none.*from 0 to 8200 t"
    ):
        hull.immersion(math.nan)
    with pytest.raises(ah.errors.BadInputError, match="weight is 'heavy'"):
        hull.immersion("heavy")  # type: ignore[arg-type]
    for weight in (9000.0, 2_000_000, 10**400):
        with pytest.raises(ah.errors.OutOfRangeError, match=r"more than .* from 0 to 8200 t"):
            hull.immersion(weight)
    assert hull.immersion(5125) == hull.immersion(5125.0)


@pytest.mark.usefixtures("body")
def test_a_trim_is_given_or_found(hull: ah.Hull) -> None:
    """With LCG it is found, and one that is given besides is not passed over."""
    with pytest.raises(ah.errors.BadInputError, match="trim_by_stern of 1 m are both given"):
        hull.immersion(5125.0, lcg=50.0, trim_by_stern=1)


@pytest.mark.usefixtures("body")
def test_appendages_leave_something_of_the_hull(hull: ah.Hull) -> None:
    """Recesses as large as the hull, or larger, are refused with both volumes."""
    for size in (-5000.0, -7000.0):
        hole = ah.hydro.Appendage("hole", size, (50.0, 0.0, 1.0))
        words = f"appendages of {size:g} m3 leave nothing of the 5000 m3"
        with pytest.raises(ah.errors.BadInputError, match=words):
            hull.hydrostatics(draught=5.0, appendages=[hole])
    assert hull.hydrostatics(draught=0.5, appendages=[hole]).volume == pytest.approx(500.0)
    hole = attrs.evolve(hole, volume=-9000.0)
    with pytest.raises(ah.errors.BadInputError, match="-9000 m3 leave nothing of the 8000 m3"):
        hull.immersion(500.0, appendages=[hole])


@pytest.mark.usefixtures("body")
@pytest.mark.parametrize("date", [5, "", "a\nb"])
def test_a_date_is_text_in_one_line(hull: ah.Hull, date: Any) -> None:
    """It is refused at the call, not where the table is written."""
    with pytest.raises(ah.errors.BadInputError, match="date is"):
        hull.hydrostatic_table([5.0], date=date)


@pytest.mark.usefixtures("body")
def test_freeboard_and_deck_edge_of_a_hull(hull: ah.Hull) -> None:
    """Of a box by its sides; positions in which it does not float are refused."""
    place = FloatingPosition(6.0, 6.0, 5.0)
    up = math.tan(math.radians(5.0))
    assert freeboard(hull, place).least == pytest.approx((2 - 5 * up) / math.hypot(1, up))
    assert deck_edge_angle(hull, place) == pytest.approx(math.degrees(math.atan(0.4)))
    with pytest.raises(ah.errors.OutOfRangeError):
        freeboard(hull, FloatingPosition(9.0, 9.0))


@pytest.mark.usefixtures("body")
@pytest.mark.parametrize(
    ("draughts", "words"),
    [
        ([4.0, math.nan], "draught of nan m .*from 0 to 8 m"),
        ([4.0, 9.0], "draught of 9 m .*from 0 to 8 m"),
        ([5.0, 4.0], "4 stands after 5"),
        ([], "draughts is empty"),
    ],
)
def test_odd_draughts_of_a_table_are_refused(
    hull: ah.Hull, draughts: list[float], words: str
) -> None:
    """With the range, where it is one of numbers."""
    with pytest.raises(ah.AssocHullError, match=words):
        hull.hydrostatic_table(draughts)
