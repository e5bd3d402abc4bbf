"""Lines cut from facets: where they run to and fro."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assoc_hull.geometry.polylines.noise import facet_depth, forward_points


def test_a_line_cut_at_a_grazing_angle_is_led_forward() -> None:
    """Points between which it runs to and fro within what is allowed are left out."""
    line = np.array(
        [[95.1, 0.605], [96.4, 0.566], [98.5, 0.534], [98.3, 0.513], [98.7, 0.508], [98.1, 0.501],
         [98.7, 0.483], [99.7, 0.468], [104.8, 0.433]]
    )  # fmt: skip
    kept = line[forward_points(line, np.full(len(line), 0.045))]
    steps = np.diff(kept, axis=0)
    assert ((steps[1:] * steps[:-1]).sum(axis=1) > 0.0).all()
    assert (kept[[0, -1]] == line[[0, -1]]).all()


@given(st.lists(st.tuples(st.floats(-5.0, 5.0), st.floats(-5.0, 5.0)), min_size=2, max_size=20))
def test_what_is_left_out_lies_on_what_is_kept(places: list[tuple[float, float]]) -> None:
    """Ends and order stay, and each point left out lies near a chord that takes its place."""
    line, within = np.array(places), 0.3
    kept = forward_points(line, np.full(len(line), within))
    assert kept[0] == 0
    assert kept[-1] == len(line) - 1
    assert (np.diff(kept) > 0).all()
    start, step = line[kept[:-1]], np.diff(line[kept], axis=0)
    for point in np.delete(line, kept, axis=0):
        part = ((point - start) * step).sum(axis=1) / np.maximum((step * step).sum(axis=1), 1e-300)
        away = point - start - np.clip(part, 0.0, 1.0)[:, None] * step
        assert np.sqrt((away * away).sum(axis=1)).min() <= 12 * within


def test_corners_stay() -> None:
    """A bar across a line is no facet: chords pass it too far off."""
    line = np.array([[0.0, 0.0], [1.0, 0.0], [0.8, 0.3], [1.2, 0.6], [2.0, 0.6]])
    assert forward_points(line, np.full(5, 0.02)).tolist() == [0, 1, 2, 3, 4]


def test_a_point_that_turns_alone_makes_no_facets_deep() -> None:
    """A stem of long steps on a keel of long steps: neither is a facet of a curve."""
    keel = np.column_stack([np.arange(0.0, 40.0, 2.5), np.zeros(16)])
    stem = keel[-1] + np.arange(1.0, 6.0)[:, None] * [0.6, 1.6]
    assert facet_depth(np.concatenate([keel, stem])) == pytest.approx(0.0, abs=1e-7)


def test_facets_of_an_arc_between_straight_lines_stay_deep() -> None:
    """A bilge of three facets of 1 m: each stands for an arc it lies inside of."""
    angle = np.linspace(0.0, 0.5 * np.pi, 4)
    bilge = np.column_stack([8.0 + 2.0 * np.sin(angle), 2.0 - 2.0 * np.cos(angle)])
    points = np.concatenate([[[0.0, 0.0], [4.0, 0.0]], bilge, [[10.0, 6.0], [10.0, 10.0]]])
    assert facet_depth(points) > 0.05
