"""Lines made smooth and fitted together: places on them, and ends on boundary curves."""

import numpy as np
import pytest

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.lines.slices import LinePiece, SliceLine
from assoc_hull.io.slicing.boundary_curves import loft_source
from assoc_hull.io.slicing.features import PieceFeatures
from assoc_hull.io.slicing.smooth_lines import Rim, _tracks, make_source, plan_piece, snap_ends
from assoc_hull.model.line_source import LineSource


def piece(group: str, offset: float, points: FloatArray, columns: list[int]) -> PieceFeatures:
    """A piece of a line without features, its points (n, 2), m, in its plane."""
    xyz = np.full((len(points), 3), offset)
    xyz[:, columns] = points
    made = LinePiece(xyz, ("deck edge", "profile"))
    line = SliceLine(group, "line", offset, (made,))
    return PieceFeatures(
        line, made, points, 1e-4, np.full(len(points), 1e-2), np.ones(len(points))
    )  # fmt: skip


def test_a_place_on_a_line_is_that_place_on_its_fit() -> None:
    """Also where the smooth line waves across the centre plane, and has fewer points than its fit.

    Ties between lines were held at a neighbour's place there, and moved a waterline by .14 m.
    """
    x = np.linspace(0.0, 100.0, 60)
    y = 10.0 * np.sin(np.pi * x / 100.0)
    y[1:4] = -3e-4
    plan = plan_piece(piece("waterlines", 5.0, np.column_stack([x, y]), [0, 1]))
    source = make_source(plan, 1.0)[0]
    drawn = [each.draw() for each in plan.stretches]
    assert len(source.points) < sum(len(each.points) for each in drawn)
    [track] = _tracks([plan], range(len(drawn)))
    for i, point in enumerate(source.points[:-1]):
        number, at = track.find(i, 0.0)
        same = int(np.abs(drawn[number].at - at).argmin())
        assert drawn[number].points[same] == pytest.approx(point[:2], abs=1e-12)


@pytest.mark.parametrize("sheer", [0.5, 0.02])
def test_an_end_is_led_to_its_boundary_curve_at_flat_angles_too(sheer: float) -> None:
    """A waterline ends on a deck edge with little sheer, which crosses its plane 10 mm / sheer off.

    Facets end it where the raw edge was; the move is along the line itself.
    """
    x = np.linspace(50.0, 100.0, 51)
    edge = np.column_stack([x, np.full(51, 8.0), 10.0 - sheer * (x - 75.0)])
    deck = LineSource.make("boundary", "deck edge", edge)
    off = 0.01 / sheer
    line = np.column_stack([np.linspace(75.0 + off, 110.0, 40), np.full(40, 8.0)])
    line[:, 1] -= 0.1 * (line[:, 0] - line[0, 0])
    line[:3, 1] = 8.0
    rim = Rim(loft_source(deck), 0.0)
    found = snap_ends(piece("waterlines", 10.0, line, [0, 1]), {"deck edge": [rim]}, 5e-3)
    assert found.points[0] == pytest.approx([75.0, 8.0], abs=1e-6)
