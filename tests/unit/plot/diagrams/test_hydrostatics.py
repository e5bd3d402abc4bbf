"""Pictures of hydrostatics: curves go through the numbers, words are apart, all is to scale."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure
from numpy.testing import assert_allclose

import assoc_hull as ah
from assoc_hull.analysis.hydrostatics.floating_body import FloatingPosition, StationAreas
from assoc_hull.analysis.hydrostatics.hull_hydrostatics import hydrostatic_table, table_of
from assoc_hull.analysis.hydrostatics.record import HydrostaticTable
from assoc_hull.analysis.hydrostatics.section_areas import Bonjean, sectional_area_course
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.hull import Hull
from assoc_hull.plot.diagrams.hydrostatics import (
    PICTURES,
    bonjean_curves,
    hydrostatic_curves,
    plot_hydrostatics,
    sectional_area_curve,
)
from assoc_hull.plot.sheet.chart import scale_to, smooth_course
from assoc_hull.plot.sheet.paper import PAPERS
from tests.floating_bodies import Wigley, head

Lines = Callable[[Figure, str], list[FloatArray]]
Boxes = Callable[[Figure], dict[str, FloatArray]]

WIGLEY = Wigley()
LEVELS = np.linspace(0.5, 6.25, 12)


@pytest.fixture(scope="module")
def table() -> HydrostaticTable:
    """The Wigley hull at twelve draughts."""
    header = head(100.0, 10.0, 6.0, kg=3.0, ship="Wigley", date="2026-01-31")
    return table_of(WIGLEY, [FloatingPosition(t, t) for t in LEVELS.tolist()], header)


def areas(height: FloatArray) -> StationAreas:
    """Of the stations of the Wigley hull at even keel."""
    return WIGLEY.stations(FloatingPlanes(height, 0.0 * height, 0.0 * height))


def pictures(table: HydrostaticTable, hull: Hull, paper: str) -> list[Figure]:
    """All three."""
    z = np.linspace(0.01, 6.25, 9)
    curves = Bonjean(z, areas(z.copy()), np.zeros((len(z), 1)))
    return [
        hydrostatic_curves(table, paper=paper),  # type: ignore[arg-type]
        sectional_area_curve(areas(LEVELS[:1]), table, paper=paper),  # type: ignore[arg-type]
        bonjean_curves(hull, curves, table, paper=paper),  # type: ignore[arg-type]
    ]


def test_curves_pass_through_the_table(table: HydrostaticTable, lines_of: Lines) -> None:
    """On the axis of each kind; equal steps of draught lie equal steps apart."""
    figure = hydrostatic_curves(table)
    for name in ("volume", "waterplane_area", "tpc", "cb"):
        (curve,) = lines_of(figure, f"curve/{name}$")
        (low,), (high,) = (lines_of(figure, f"level/{z:g}$") for z in (1, 6))
        y = low[0, 1] + (high[0, 1] - low[0, 1]) * (LEVELS - 1.0) / 5.0
        x = np.interp(y, curve[:, 1], curve[:, 0])
        slope, start = np.polyfit(table.columns[name], x, 1)
        assert slope > 0.0
        assert_allclose(start + slope * table.columns[name], x, atol=0.02)


def test_sectional_areas_are_drawn_at_their_stations(
    table: HydrostaticTable, lines_of: Lines
) -> None:
    """Largest amidships, nil at both ends, the centre of buoyancy in the middle."""
    figure = sectional_area_curve(areas(LEVELS[:1]), table)
    (spots,), (mark,) = lines_of(figure, "stations$"), lines_of(figure, "LCB$")
    assert len(spots) == 21
    assert_allclose(np.diff(spots[:, 0]), np.diff(spots[:, 0]).mean(), rtol=1e-9)
    assert_allclose(mark[:, 0], spots[10, 0])
    share = (spots[:, 1] - spots[0, 1]) / (spots[10, 1] - spots[0, 1])
    assert_allclose(share, 1.0 - np.linspace(-1, 1, 21) ** 2, atol=1e-9)


def test_the_curve_of_areas_ends_where_the_hull_does(lines_of: Lines) -> None:
    """At no area, beyond the last wet stations; what it encloses is the volume."""
    hull = ah.examples.series60()
    draught = hull.particulars.draught
    course = sectional_area_course(hull, FloatingPosition(draught, draught))
    assert course is not None
    assert np.trapezoid(course[:, 1], course[:, 0]) == pytest.approx(
        hull.hydrostatics().volume, rel=1e-5
    )
    assert course[0, 0] < -2.0
    table = hydrostatic_table(hull, [draught])
    figure = plot_hydrostatics(hull, table, "areas")
    (curve,), (spots,) = lines_of(figure, "curve/areas$"), lines_of(figure, "stations$")
    assert_allclose(curve[[0, -1], 1], curve[:, 1].min())
    assert curve[0, 0] < spots[spots[:, 1] > curve[0, 1] + 0.1, 0].min()


def test_bonjean_curves_start_at_their_stations(
    table: HydrostaticTable, wigley: Hull, lines_of: Lines
) -> None:
    """And reach as far to the right as the area is large, all on one scale."""
    z = np.linspace(0.0, 6.25, 9)
    figure = bonjean_curves(wigley, Bonjean(z, areas(z.copy()), np.zeros((len(z), 1))), table)
    reach, found = [], areas(z.copy())
    for name in found.names:
        (curve,), (upright,) = (
            lines_of(figure, f"bonjean/{name}$"),
            lines_of(figure, f"station/{name}$"),
        )
        assert curve[0, 0] == pytest.approx(upright[0, 0])
        reach.append(curve[-1, 0] - curve[0, 0])
    assert_allclose(np.array(reach) / reach[10], found.area[-1] / found.area[-1, 10], atol=1e-9)


@pytest.mark.parametrize("paper", ["A1", "A3", "A4"])
def test_words_are_apart_and_within_the_frame(
    table: HydrostaticTable, wigley: Hull, paper: str, boxes_of: Boxes
) -> None:
    """No word covers another in any of the pictures."""
    for figure in pictures(table, wigley, paper):
        found = boxes_of(figure)
        boxes, names = np.array(list(found.values())), list(found)
        for i, box in enumerate(boxes):
            apart = (boxes[:, :2] >= box[2:] - 1e-6).any(axis=1)
            apart |= (boxes[:, 2:] <= box[:2] + 1e-6).any(axis=1)
            assert [names[k] for k in np.flatnonzero(~apart).tolist() if k != i] == [], names[i]
        size = PAPERS[paper]
        assert (boxes[:, :2] > 8.0 * size.factor).all()
        assert (boxes[:, 2:] < np.array([size.width, size.height]) - 8.0 * size.factor).all()


def test_the_same_table_gives_the_same_bytes(
    table: HydrostaticTable, wigley: Hull, tmp_path: Path
) -> None:
    """No dates but the one that is given, no chance."""
    for name in ("a.svg", "b.svg"):
        hydrostatic_curves(table, tmp_path / name)
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()


def test_one_draught_makes_no_curve() -> None:
    """The error says how many are needed."""
    single = table_of(WIGLEY, [FloatingPosition(5.0, 5.0)], head(100.0, 10.0, 6.0))
    with pytest.raises(BadInputError, match="two draughts"):
        hydrostatic_curves(single)


def test_a_smooth_curve_is_level_between_level_points_and_exact_on_parabolas() -> None:
    """So that a parallel body is drawn as one."""
    x = np.array([0.0, 1.0, 2.5, 3.0, 4.0])
    course = smooth_course(x, x**2)
    assert_allclose(course[:, 1], course[:, 0] ** 2, atol=1e-12)
    flat = smooth_course(x, np.array([0.0, 3.0, 3.0, 3.0, 1.0]))
    inside = (flat[:, 0] >= 1.0) & (flat[:, 0] <= 3.0)
    assert (flat[inside, 1] == 3.0).all()


@pytest.mark.parametrize(("low", "high"), [(0.0, 1.0), (-3.7, 12.1), (4.999, 5.0), (1e5, 7e5)])
def test_a_scale_holds_its_values_between_round_marks(low: float, high: float) -> None:
    """Written with as many digits as tell the marks apart."""
    scale = scale_to(low, high, 0.0, 100.0, 10)
    slack = 1e-12 * abs(high)
    assert scale.low - slack <= low < high <= scale.high + slack
    words = [scale.word(value) for value in scale.marks.tolist()]
    assert len(set(words)) == len(words) >= 3
    assert_allclose([float(word) for word in words], scale.marks, atol=1e-9 * scale.step)


@pytest.mark.parametrize("picture", PICTURES)
def test_pictures_of_a_carrier_have_their_words_apart(
    bulk_carrier: Hull, picture: str, boxes_of: Boxes
) -> None:
    """41 stations, close together at the ends; overhang and bulb beyond the perpendiculars."""
    table = hydrostatic_table(bulk_carrier, [6.0, 12.0, 18.0], [1.0], estimate=False)
    found = list(boxes_of(plot_hydrostatics(bulk_carrier, table, picture)).values())
    boxes = np.array(found)
    for i, box in enumerate(boxes):
        apart = (boxes[:, :2] >= box[2:] - 1e-6).any(axis=1)
        apart |= (boxes[:, 2:] <= box[:2] + 1e-6).any(axis=1)
        assert np.flatnonzero(~apart).tolist() == [i]
    assert (boxes > 8.0).all()
