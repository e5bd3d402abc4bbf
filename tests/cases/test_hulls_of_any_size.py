"""A short hull is taken in as the same hull of 100 m is, whatever the unit of its file."""

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import cKDTree

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.hull import Hull
from assoc_hull.io.importing.import_hull import ImportReport
from assoc_hull.model.tables import HullState
from assoc_hull.tolerance import Tolerances
from tests.long_forms import LONG, long_form
from tests.scaled_hulls import LENGTH, scaled_hull

SHORT_ONES = ["Series 60 .60, table", "Wigley, mesh"]
ALL = [
    *SHORT_ONES, "Wigley, surface", "yacht, mesh", "Series 60 .70, lines",
    "container ship, lines", "carrier, lines",
]  # fmt: skip
SCALES = [(1.0 / 25.0, "m"), (1.0 / 60.0, "m"), (1.0, "mm"), (1.0 / 25.0, "mm")]
UNITS = [(1.0, "in"), (1.0, "ft")]


def places(state: HullState, scale: float) -> FloatArray:
    """The points of a hull at 100 m, sorted."""
    xyz: FloatArray = state.rows.xyz[state.live("rows")] / scale
    return xyz[np.lexsort(xyz.T)]


def coefficients(state: HullState) -> FloatArray:
    """CB, CM, CP, CW and the place of LCB as a part of the length."""
    found = Hull(state).hydrostatics(on_error="report")
    length = state.particulars.length
    return np.array([found.cb, found.cm, found.cp, found.cw, found.lcb / length])


def features(state: HullState) -> list[tuple[str, int]]:
    """Kind and number of points of every feature of a hull, sorted."""
    return sorted((each.kind, len(each.points)) for each in state.features)


def check(name: str, scales: list[tuple[float, str]], folder: Path) -> None:
    """Read a hull at scales and compare it with itself at 100 m, m."""
    state, report = scaled_hull(name).read(folder)
    base, wanted = places(state, 1.0), coefficients(state)
    for scale, unit in scales:
        small, told = scaled_hull(name).read(folder, scale, unit)
        found = places(small, scale)
        assert len(found) == len(base), (scale, unit)
        assert told.adoption.own_points == report.adoption.own_points
        assert np.max(cKDTree(found).query(base)[0]) <= 1e-6 * LENGTH, (scale, unit)
        assert str(told.verdict) == str(report.verdict)
        assert coefficients(small) == pytest.approx(wanted, abs=1e-6)


def check_bits(name: str, folder: Path) -> None:
    """Read a hull at scales that are powers of two: nothing at all is different."""
    base: tuple[HullState, ImportReport] = scaled_hull(name).read(folder)
    for scale in (1.0 / 16.0, 1.0 / 64.0):
        state, report = scaled_hull(name).read(folder, scale)
        assert places(state, scale).tobytes() == places(base[0], 1.0).tobytes()
        assert state.tolerances == base[0].tolerances.scaled(scale)
        assert report.verdict.word == base[1].verdict.word
        # They stand in the order of their names, which hold places in metres.
        assert features(state) == features(base[0])


@pytest.mark.parametrize("name", ALL if LONG else SHORT_ONES)
def test_a_short_hull_is_adopted_as_at_100_m(name: str, tmp_path: Path) -> None:
    """Points, verdict and coefficients are the same at 1/25, 1/60 and in millimetres."""
    check(name, SCALES if LONG else [SCALES[0]], tmp_path)


@pytest.mark.parametrize("name", ALL if LONG else SHORT_ONES)
def test_powers_of_two_change_no_bit(name: str, tmp_path: Path) -> None:
    """At 1/16 and 1/64 the hull has the same bits after scaling back."""
    check_bits(name, tmp_path)


@long_form
@pytest.mark.parametrize("name", [each for each in ALL if "table" not in each])
def test_files_in_feet_and_inches_are_the_same_hull(name: str, tmp_path: Path) -> None:
    """The same file in inches and in feet gives the same hull."""
    check(name, UNITS, tmp_path)


def test_water_at_the_edge_of_the_deck_has_its_whole_waterplane(tmp_path: Path) -> None:
    """A hull that ends at its draught, whose edge is level but for rounding: CW is 2/3 by formula.

    The deck edge is a little wet here and a little dry there, and the stem ends at the water.
    """
    state, report = scaled_hull("Wigley, surface").read(tmp_path, 1.0 / 25.0)
    assert coefficients(state)[3] == pytest.approx(2.0 / 3.0, abs=1e-4)
    assert report.frame is not None
    assert report.frame.ap == pytest.approx(0.0, abs=1e-3)


def test_tolerances_of_100_m_and_more_are_the_usual_ones() -> None:
    """Lengths shrink below 100 m only, in proportion; angles and parts never do."""
    assert Tolerances.of_length(100.0) == Tolerances.of_length(355.0) == Tolerances()
    short = Tolerances.of_length(6.0)
    assert short.adopted_spacing == pytest.approx(0.012)
    assert (short.turn_deg, short.spacing) == (Tolerances().turn_deg, Tolerances().spacing)
    assert short.factor == pytest.approx(0.06)
    assert Tolerances.of_length(6.0, adopted_spacing=0.01).adopted_spacing == 0.01
