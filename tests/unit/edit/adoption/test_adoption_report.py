"""The report of an adoption says, curve by curve, what an independent look at the net finds."""

import attrs
import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from scipy.spatial import cKDTree

from assoc_hull.edit.adoption.adopt_lines import AdoptionReport, LineReport, adopt
from assoc_hull.geometry.curves import CurveData, FloatArray
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.model.kinds import Sort
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.tables import HullState, Particulars

SHIP = Particulars("test", 100.0, 20.0, 10.0, 6.0)


def wave(x: FloatArray) -> FloatArray:
    """Half-breadth of a waterline with two inflections, m."""
    return np.asarray(5.0 + np.sin(2.0 * np.pi * x / 100.0 * 1.5))


def net() -> tuple[list[LineSource], HullState, AdoptionReport]:
    """A waterline that waves, drawn closely, crossed by four sections; 20 mm are allowed."""
    x = np.linspace(0.0, 100.0, 81)
    water = np.column_stack([x, wave(x), np.full(81, 3.0)])
    sources = [LineSource.make("waterlines", "WL 3", water, tolerance=0.02, dense=True)]
    for place in (20.0, 40.0, 60.0, 80.0):
        z = np.linspace(0.0, 6.0, 7)
        y = float(wave(np.array(place))) * (1.0 + 0.05 * (z - 3.0))
        section = np.column_stack([np.full(7, place), y, z])
        sources.append(LineSource.make("sections", f"ST {place:g}", section, placed=True))
    return sources, *adopt(sources, SHIP, ())


def line(report: AdoptionReport, name: str) -> LineReport:
    """The row of a line."""
    (found,) = (each for each in report.lines if each.line == name)
    return found


def test_deviations_are_those_of_a_close_look_at_the_curve() -> None:
    """Median, p95, largest and its place, against places of the curve under 1 mm apart."""
    sources, state, report = net()
    row = line(report, "WL 3")
    curve = state.curves.key.data.index(row.curve)
    places = sample(state.spline(curve), 20000)[1]
    drawn = sample(loft(CurveData.single(sources[0].points)), 2)[1]  # with points half-way
    away = np.asarray(cKDTree(places).query(drawn)[0])
    assert row.deviation == pytest.approx(away.max(), abs=1e-5)
    assert row.deviation_median == pytest.approx(np.median(away), abs=1e-4)
    assert row.deviation_p95 == pytest.approx(np.percentile(away, 95), abs=1e-4)
    assert row.place == pytest.approx(drawn[int(away.argmax())].tolist())
    assert row.tolerance == 0.02
    assert row.deviation <= row.tolerance
    assert report.worst == row


def test_points_are_counted_by_sort() -> None:
    """Crossings, adopted and placed ones make up the defining points."""
    _, state, report = net()
    for row in report.lines:
        rows = state.curves.rows[state.curves.key.data.index(row.curve)]
        sort = state.rows.sort[rows].tolist()
        counts = [sort.count(each) for each in (Sort.CROSSING, Sort.ADOPTED, Sort.PLACED)]
        assert [row.crossings, row.adopted, row.placed] == counts
        assert row.defining == len(rows)
    assert line(report, "ST 20").placed >= 6
    assert report.own_points == sum(row.adopted for row in report.lines) > 0


def test_inflections_are_those_before_and_after() -> None:
    """The waterline waves twice; curves that lose a wave make up for none of another line."""
    _, _, report = net()
    x = np.linspace(0.0, 100.0, 81)
    bend = CubicSpline(x, wave(x))(np.linspace(1.0, 99.0, 500), 2)
    waves = int((np.diff(np.sign(bend)) != 0).sum())
    row = line(report, "WL 3")
    assert (row.inflections_given, row.inflections) == (waves, waves) == (2, 2)
    straight = line(report, "ST 20")
    assert (straight.inflections_given, straight.inflections) == (0, 0)
    assert report.inflections == (2, 0)


def test_waves_that_are_lost_do_not_hide_waves_that_are_new() -> None:
    """The excess is counted line by line; pieces of one line count together."""
    _, _, report = net()
    first, second = report.lines[0], report.lines[1]
    calm = attrs.evolve(first, inflections_given=5, inflections=0)
    rough = attrs.evolve(second, inflections_given=0, inflections=3)
    piece = attrs.evolve(second, inflections_given=2, inflections=0)
    assert AdoptionReport((calm, rough), ()).inflections == (5, 3)
    assert AdoptionReport((calm, rough, piece), ()).inflections == (7, 1)
