"""A box as a net of lines: flat bottom, sides and ends, a closed deck, a chine all round."""

from __future__ import annotations

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.geometry.curves import PointKind
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.tables import Association, Particulars

LENGTH, BREADTH, DEPTH = 100.0, 20.0, 12.0
KNUCKLE = int(PointKind.KNUCKLE)
FIELDS = (
    "volume", "lcb", "tcb", "kb", "waterplane_area_proj", "lcf", "tcf", "i_t_proj", "i_l_proj",
    "wetted_surface",
)  # fmt: skip
SCALES = np.array([
    12000.0, LENGTH, BREADTH, DEPTH, 2000.0, LENGTH, BREADTH, BREADTH**3 * LENGTH,
    BREADTH * LENGTH**3, 3440.0,
])  # fmt: skip

WET_DECK = LENGTH * (0.5 * BREADTH - (DEPTH - 8.0) / float(np.tan(np.radians(40.0))))
"""Of the deck, m2, at a draught of 8 m and heel of 40 degrees: the table has it in the surface."""

# T0, tan trim, heel, then the fields; from the reference table, ends included in the surface and
# the deck, which is no shell, taken off
CASES = {
    "even": (6.0, 0.0, 0.0, 12000.0, 50.0, 0.0, 3.0, 2000.0, 50.0, 0.0, 2e5 / 3, 5e6 / 3, 3440.0),
    "trim": (
        5.0, 0.02, 0.0, 12000.0, 50.0 + 25.0 / 9.0, 0.0, 3.0 + 1.0 / 36.0, 2000.0, 50.0, 0.0,
        2e5 / 3, 5e6 / 3, 3440.0,
    ),
    "heel": (
        6.0, 0.0, 20.0, 12000.0, 50.0, -2.0220568570344577, 3.3679842539772062, 2000.0, 50.0, 0.0,
        2e5 / 3, 5e6 / 3, 3440.0,
    ),
    "both": (
        5.0, 0.02, 20.0, 12000.0, 50.0 + 25.0 / 9.0, -2.0220568570344577, 3.3957620317549835,
        2000.0, 50.0, 0.0, 2e5 / 3, 5e6 / 3, 3440.0,
    ),
    "deck wet": (
        8.0, 0.0, 40.0, 14860.208622226106, 50.0, -3.1201005029111597, 4.845154050684799,
        1430.104311113052, 50.0, 2.38350718518842, 24373.72470054203, 1191753.5925942115,
        3973.9056094822067 - WET_DECK,
    ),
}  # fmt: skip


def _rim(x: float) -> np.ndarray:
    """Half a section: from the keel along the bottom, round the chine, up to the deck."""
    half = 0.5 * BREADTH
    return np.array([[x, 0.0, 0.0], [x, half, 0.0], [x, half, DEPTH]])


def _end(name: str, points: np.ndarray, normal: tuple[int, int, int], offset: float) -> LineSource:
    kind = [0, *[KNUCKLE] * (len(points) - 2), 0]
    return LineSource.make(
        "boundary", name, points, plane=(normal, offset), kind=kind, boundary=BoundaryKind.END
    )


def box_net(stations: int = 5, deck: str = "closed") -> ah.Hull:
    """The box of the reference table; its two ends are transoms."""
    return box_of_lines(box_lines(stations), deck)


def box_lines(stations: int) -> list[LineSource]:
    """The lines of the box."""
    half = 0.5 * BREADTH
    chine = np.array([[0.0, half, 0.0], [LENGTH, half, 0.0]])
    lines = [
        _end("profile", chine * [1.0, 0.0, 1.0], (0, 1, 0), 0.0),
        _end("deck edge", chine + np.array([0.0, 0.0, DEPTH]), (0, 0, 1), DEPTH),
        _end("aft end", _rim(0.0), (1, 0, 0), 0.0),
        _end("fore end", _rim(LENGTH), (1, 0, 0), LENGTH),
        LineSource.make("boundary", "chine", chine, boundary=BoundaryKind.KNUCKLE),
    ]
    places = np.linspace(0.0, LENGTH, stations + 2)[1:-1].tolist()
    lines += [
        LineSource.make("sections", f"ST {k}", _rim(x), kind=[0, KNUCKLE, 0])
        for k, x in enumerate(places, 1)
    ]
    return lines


def box_of_lines(lines: list[LineSource], deck: str = "closed") -> ah.Hull:
    """A hull of such lines."""
    ship = Particulars("Box", LENGTH, BREADTH, DEPTH, 6.0, deck)
    links = [Association("boundary", "sections")]
    return ah.Hull.from_lines(lines, particulars=ship, associations=links)


@pytest.fixture(scope="module")
def box() -> ah.Hull:
    """The box with five sections."""
    return box_net()


@pytest.mark.parametrize("case", CASES)
def test_the_record_of_a_box_has_the_reference_values(box: ah.Hull, case: str) -> None:
    """All to 1e-9 of their scale; `transom=True` counts both ends as wetted surface."""
    height, slope, heel, *wanted = CASES[case]
    found = box.hydrostatics(
        draughts=(height, height + LENGTH * slope), heel_deg=heel, transom=True
    )
    seen = np.array([getattr(found, name) for name in FIELDS])
    np.testing.assert_allclose(seen / SCALES, np.array(wanted) / SCALES, atol=1e-9)


@pytest.mark.parametrize("case", CASES)
def test_what_is_stated_of_a_box_is_next_to_nothing(box: ah.Hull, case: str) -> None:
    """Fewer lines make the same box: estimates are rounding, and cover what is off."""
    height, slope, heel, *wanted = CASES[case]
    found = box.hydrostatics(
        draughts=(height, height + LENGTH * slope), heel_deg=heel, transom=True
    )
    for name, truth, scale in zip(FIELDS, wanted, SCALES.tolist(), strict=True):
        stated = found.error[name]
        assert stated is not None
        assert stated >= abs(getattr(found, name) - truth) - 1e-12 * scale, name
        if case in ("even", "heel"):
            assert stated <= 1e-9 * scale, name


def test_the_ends_of_a_box_count_only_if_asked(box: ah.Hull) -> None:
    """3440 m2 with both ends, 240 m2 less without them."""
    whole, shell = (box.hydrostatics(draught=6.0, transom=each) for each in (True, False))
    assert whole.wetted_surface == pytest.approx(3440.0, rel=1e-12)
    assert shell.wetted_surface == pytest.approx(3200.0, rel=1e-12)
    assert shell.transom_area == pytest.approx(240.0, rel=1e-12)
    assert (whole.lwl, whole.bwl, whole.cb) == pytest.approx((100.0, 20.0, 1.0))


@pytest.mark.parametrize("stations", [2, 3, 8])
def test_a_box_is_the_same_with_any_number_of_sections(stations: int) -> None:
    """Two are enough."""
    found = box_net(stations).hydrostatics(draughts=(5.0, 7.0), heel_deg=20.0)
    assert found.volume == pytest.approx(12000.0, rel=1e-12)
    assert found.i_l_proj == pytest.approx(5e6 / 3.0, rel=1e-12)


def test_a_heel_that_drowns_an_open_deck_is_refused() -> None:
    """The error names draught and range; closed, the same box floats with a wet deck edge."""
    with pytest.raises(
        ah.errors.OutOfRangeError, match=r"8 m drowns the open deck.*from .* to 3\.609 "
    ):
        box_net(deck="open").hydrostatics(draught=8.0, heel_deg=40.0)
    found = box_net(deck="open").hydrostatics(draught=8.0, heel_deg=20.0)
    assert found.volume == pytest.approx(16000.0, rel=1e-12)


@pytest.mark.parametrize(
    ("kg", "word"), [(-1.0, "below the base line"), (90.0, "than the ship is broad")]
)
def test_a_centre_of_gravity_where_none_lies_is_remarked_on(
    box: ah.Hull, kg: float, word: str
) -> None:
    """In every table that takes it; one within the ship is not."""
    assert word in str(box.hydrostatics(draught=5.0, kg=kg))
    assert "check its unit" in str(box.stability(kg=kg, draught=5.0))
    assert "check its unit" not in str(box.hydrostatics(draught=5.0, kg=4.0))
