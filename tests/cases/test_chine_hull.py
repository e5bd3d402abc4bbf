"""A hull with a chine: its knuckle line becomes a boundary curve that splits all lines there."""

import numpy as np
import pytest

from assoc_hull.geometry.curves import FloatArray, PointKind
from assoc_hull.geometry.surfaces.triangles import Triangles, grid_triangles, merge_vertices
from assoc_hull.hull import Hull
from assoc_hull.io.digitised.read import read_lines
from assoc_hull.io.lines.slices import HullSlices, LinePiece, SliceLine
from assoc_hull.io.slicing.mesh_lines import slice_mesh
from assoc_hull.io.slicing.net import SliceReport, net_from_slices
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.tables import HullState
from tests.unit.io.digitised.test_digitised import as_csv

NOISE = 1e-3


def chine(x: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Half-breadth and height of the chine, m, on a hull of 60 m."""
    part = x / 60.0
    return 6.0 * (1.0 - part**3), 1.0 + 2.5 * part * part


def chine_hull(nx: int = 401) -> Triangles:
    """A bottom that bulges up to the chine, and a side that bulges from there to the deck."""
    x, t = np.meshgrid(np.linspace(0.0, 60.0, nx), np.linspace(0.0, 1.0, 61), indexing="ij")
    y0, z0 = chine(x)
    low = np.stack([x, y0 * t, z0 * t + 0.2 * y0 * t * (t - 1.0)], axis=2)
    flare = (1.0 - (x / 60.0) ** 3) * (1.2 * t - 0.5 * t * t)
    high = np.stack([x, y0 + flare, z0 + (6.0 - z0) * t], axis=2)
    both = [grid_triangles(low), grid_triangles(high)]
    face = np.concatenate([both[0].face, both[1].face + len(both[0].xyz)])
    return merge_vertices(np.concatenate([both[0].xyz, both[1].xyz]), face)


def scattered(slices: HullSlices, seed: int) -> str:
    """The lines as digitised text, with noise across."""
    import attrs

    draw = np.random.default_rng(seed)

    def noisy(line: SliceLine) -> SliceLine:
        pieces = []
        for piece in line.pieces:
            points = piece.points.copy()
            axis = {"sections": 0, "waterlines": 2, "buttocks": 1}[line.group]
            ahead = np.gradient(points, axis=0)
            across = np.cross(ahead, np.eye(3)[axis])
            across /= np.maximum(np.linalg.norm(across, axis=1), 1e-12)[:, None]
            points[1:-1] += (across * draw.normal(0.0, NOISE, (len(points), 1)))[1:-1]
            pieces.append(LinePiece(points, piece.ends))
        return attrs.evolve(line, pieces=tuple(pieces))

    return as_csv(attrs.evolve(slices, lines=tuple(map(noisy, slices.lines))))


@pytest.fixture(scope="module")
def net() -> tuple[HullState, SliceReport]:
    """The hull digitised with 1 mm noise and adopted."""
    stations = [6.0, 12.0, 18.0, 24.0, 30.0, 36.0, 42.0, 48.0]
    slices = slice_mesh(
        chine_hull(), stations=stations, waterlines=[1.3, 2.0, 2.8, 4.0, 5.0], buttocks=[1.5, 3.0]
    )
    return net_from_slices(read_lines(scattered(slices, 3)))


def test_the_chine_is_a_boundary_curve(net: tuple[HullState, SliceReport]) -> None:
    """One knuckle border is drawn, within 20 mm of the chine at its marks."""
    _, report = net
    [border] = [each for each in report.borders if each.kind == BoundaryKind.KNUCKLE]
    y, z = chine(border.places[:, 0])
    off = np.hypot(border.places[:, 1] - y, border.places[:, 2] - z)
    print(
        f"\nchine: {len(border.lines)} marks, {border.taken} lines split, {1e3 * off.max():.1f} mm"
    )
    assert len(border.lines) >= 8
    assert off.max() < 0.02


def knuckles_of(state: HullState) -> dict[str, list[str]]:
    """Per line of the net, on which boundary curves its knuckle points lie; "" for none."""
    rows, found = state.rows, dict[str, list[str]]()
    for row in state.live("rows").tolist():
        for side, curve in enumerate(rows.curve[row].tolist()):
            if curve < 0 or rows.kind[row, side] != PointKind.KNUCKLE:
                continue
            other = int(rows.curve[row, 1 - side])
            name = "" if other < 0 else state.lines.name[state.line_of(other)]
            found.setdefault(state.lines.name[state.line_of(curve)], []).append(name)
    return found


def test_all_lines_that_cross_the_chine_are_split(net: tuple[HullState, SliceReport]) -> None:
    """So are waterlines that hardly turn there, of which none showed a corner by itself.

    The buttock that crosses the chine ahead of the last station keeps a knuckle of its own.
    """
    state, report = net
    found = knuckles_of(state)
    stations = [f"ST {x}" for x in range(6, 49, 6)]
    for name in [*stations, "WL 1.3", "WL 2", "BTK 3"]:
        assert found[name] == ["knuckle 1"]
    assert found["BTK 1.5"] == [""]
    assert sum(names == ["knuckle 1"] for names in found.values()) == report.borders[0].taken
    hull = Hull(state)
    assert hull.check() == ()
    assert hull.verify() == ()


def test_two_lines_make_no_chine() -> None:
    """Corners of two stations only stay adopted points of the kind knuckle."""
    slices = slice_mesh(chine_hull(), stations=[20.0, 40.0], waterlines=[4.0], buttocks=0)
    state, report = net_from_slices(read_lines(scattered(slices, 4)))
    assert report.borders == ()
    found = knuckles_of(state)
    assert (found["ST 20"], found["ST 40"], "WL 4" in found) == ([""], [""], False)
