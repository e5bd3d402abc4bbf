"""Which points of a densely given line are adopted."""

import numpy as np

from assoc_hull.edit.adoption.adopt_lines import adopt
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.kinds import Sort
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.tables import HullState, Particulars

SHIP = Particulars("piece", 10.0, 4.0, 4.0, 2.0)


def adopted(points: FloatArray, **options: object) -> tuple[HullState, FloatArray]:
    """The net of one line, and the points that define it, in order."""
    source = LineSource.make("waterlines", "WL 1", points, **options)  # type: ignore[arg-type]
    state = adopt([source], SHIP, [])[0]
    rows = state.curves.rows[0]
    assert (state.rows.sort[rows] == Sort.ADOPTED).all()
    return state, np.asarray(state.rows.xyz[rows])


def wave(count: int = 201) -> FloatArray:
    """A line with one bump."""
    x = np.linspace(0.0, 10.0, count)
    return np.column_stack([x, np.exp(-((x - 3.0) ** 2)), np.ones(count)])


def test_points_of_a_dense_line_keep_apart() -> None:
    """None of the adopted points lies within a quarter of the interval it was put in."""
    _, places = adopted(wave(), dense=True, tolerance=5e-3)
    step = np.diff(places[:, 0])
    assert (step > 0.2).all()
    assert (np.minimum(step[1:], step[:-1]) / np.maximum(step[1:], step[:-1]) > 0.2).all()


def test_a_tolerance_per_point_is_kept() -> None:
    """Where the tolerance is wide no point is adopted; where it is narrow the line is held."""
    tolerance = np.where(wave()[:, 0] < 5.0, 5e-3, 10.0)
    _, places = adopted(wave(), dense=True, tolerance=tolerance)
    assert (places[1:-1, 0] < 5.5).all()
    assert len(places) > 5


def test_a_hairpin_is_drawn_without_a_fold() -> None:
    """Round a tight end the chords between defining points turn by less than a right angle."""
    t = np.linspace(0.0, np.pi, 60)
    arc = np.column_stack([9.0 + np.sin(t), 1.0 - np.cos(t), np.ones(60)])
    low, high = np.linspace(0.0, 8.9, 60), np.linspace(8.9, 0.0, 60)
    line = np.concatenate([
        np.column_stack([low, np.zeros(60), np.ones(60)]), arc,
        np.column_stack([high, np.full(60, 2.0), np.ones(60)]),
    ])  # fmt: skip
    _, places = adopted(line, dense=True, tolerance=0.4)
    chord = np.diff(places, axis=0)
    chord /= np.linalg.norm(chord, axis=1)[:, None]
    assert (chord[1:] * chord[:-1]).sum(axis=1).min() > 0.0
