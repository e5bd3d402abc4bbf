"""Half hulls whose surface passes the centre plane a little, and the loops that this makes."""

from __future__ import annotations

import numpy as np
import pytest

from assoc_hull.geometry.surfaces.triangles import Triangles, grid_triangles
from assoc_hull.io.lines.slices import LinePiece
from assoc_hull.io.mesh.frame import half_side
from assoc_hull.io.reports import Notebook
from assoc_hull.io.slicing.mesh_lines import open_pieces, without_loops


def _half(past: float) -> Triangles:
    x, z = np.meshgrid(np.linspace(0, 100, 41), np.linspace(0, 6.25, 11), indexing="ij")
    y = 5.0 * (1.0 - (x / 50.0 - 1.0) ** 2) * (1.0 - (1.0 - z / 6.25) ** 2)
    y[20, 0] = -past
    return grid_triangles(np.stack([x, y, z], axis=2))


@pytest.mark.parametrize("past", [0.0, 0.002, 0.05])
def test_a_half_hull_with_a_vertex_past_its_plane_is_a_half_hull(past: float) -> None:
    """Its plane is where most of the open edge lies."""
    assert half_side(_half(past), 1) == pytest.approx(0.0, abs=1e-9)


def _profile(loop: float) -> LinePiece:
    """A keel of 100 m with a loop of this height (m) whose ends lie 10 mm apart."""
    keel = [[x, 0.0, 0.0] for x in np.linspace(0.0, 50.0, 26)]
    ring = [[50.0 + loop, 0.0, 0.0], [50.0 + loop, 0.0, loop], [50.01, 0.0, loop]]
    rest = [[x, 0.0, 0.01] for x in np.linspace(50.01, 100.0, 26)]
    return LinePiece(np.array([*keel, *ring, *rest]))


def test_a_small_loop_is_left_out_and_told() -> None:
    """The shortest way past it is taken, with its place in a suspicion."""
    book = Notebook()
    found = without_loops(_profile(0.2), 0.06, book)
    assert len(found.points) == 52
    assert (np.diff(found.points[:, 0]) > 0.0).all()
    (note,) = book.report().suspicions
    assert note.kind == "loop"
    assert "(50, 0) m" in note.what


def test_a_wide_loop_is_a_part_of_the_hull() -> None:
    """A notch of 10 m in a hull of 100 m is no crossing of its halves."""
    book = Notebook()
    piece = _profile(10.0)
    assert without_loops(piece, 0.06, book) is piece
    assert book.report().suspicions == ()


def test_a_clean_profile_comes_back_as_it_is() -> None:
    """Points closer than the width of joins are no loops."""
    line = LinePiece(np.column_stack([np.linspace(0, 10, 1001), np.zeros(1001), np.zeros(1001)]))
    assert without_loops(line, 0.06, Notebook()) is line


def test_a_closed_piece_of_the_deck_edge_is_left_out_and_told() -> None:
    """A body that lies on the deck leaves loops along it: the edge of a half runs end to end."""
    edge = LinePiece(np.column_stack([np.linspace(0, 100, 51), np.full(51, 5.0), np.full(51, 8.0)]))
    way = np.linspace(0.0, 2.0 * np.pi, 13)
    ring = np.column_stack([40.0 + np.cos(way), 5.0 + 0.0 * way, 8.0 + 0.1 * np.sin(way)])
    ring[-1] = ring[0]
    book = Notebook()
    assert open_pieces([LinePiece(ring), edge], "deck edge", book) == [edge]
    (note,) = book.report().suspicions
    assert note.kind == "closed piece"
    assert "(41, 5, 8) m" in note.what
    alone = [LinePiece(ring)]
    assert open_pieces(alone, "deck edge", Notebook()) is alone  # nothing would be left
