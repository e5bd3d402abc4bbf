"""Arcs in simple cells: where they end, that they meet, and points along them."""

import numpy as np
import pytest
from scipy.spatial import cKDTree

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.bernstein_polynomials import multiply
from assoc_hull.geometry.patches.bezier_patches import Patches, patch_points
from assoc_hull.geometry.patches.cell_subdivision import subdivide_patches
from assoc_hull.geometry.patches.cells import CellKind, SignCells, ZeroSetArcs
from assoc_hull.geometry.patches.curvature_functions import IsoFunction, gauss_function
from assoc_hull.geometry.patches.zero_set_arcs import (
    arc_heights,
    arcs_of,
    bernstein_table,
    patch_parameters,
    sample_arcs,
)
from tests.curved_patches import graph_plates, patch, random_nets
from tests.unit.geometry.patches.isolines import batch, function, plate, pointwise, polynomial


def free_ends(cells: SignCells, arcs: ZeroSetArcs, within: float = 1e-9) -> FloatArray:
    """Ends (n, 3), with the patch, that meet no other, and lie on no border of their patch."""
    ends = arcs.ends.reshape(-1, 2)
    keys = np.column_stack([ends, np.repeat(cells.patch[arcs.cell], 2)]).astype(np.float64)
    pairs = cKDTree(keys).query_pairs(within, output_type="ndarray")
    met = np.isin(np.arange(len(keys)), pairs) | ((ends == 0.0) | (ends == 1.0)).any(axis=1)
    return np.asarray(keys[~met])


def touching(cells: SignCells, keys: FloatArray) -> FloatArray:
    """Whether each end touches a cell that is undecided, or nil."""
    found = np.zeros(len(keys), bool)
    for number, (u, v, own) in enumerate(keys.tolist()):
        open_ = (cells.patch == own) & np.isin(cells.kind, [CellKind.UNRESOLVED, CellKind.ZERO])
        box, point = cells.box[open_], np.array([u, v])
        inside = (box[..., 0] - 1e-9 <= point) & (point <= box[..., 1] + 1e-9)
        found[number] = inside.all(axis=1).any()
    return found


@pytest.mark.parametrize("level", [0.0, 1e-3])
def test_arcs_of_plates_meet_end_to_end(level: float) -> None:
    """On 120 random plates each end within a patch is the end of another arc, to 1e-12."""
    cells = subdivide_patches(gauss_function(batch(graph_plates(120, 11)), level))
    arcs = arcs_of(cells)
    assert len(arcs) > 1500
    assert len(free_ends(cells, arcs, 1e-12)) == 0


def test_arcs_that_meet_none_end_at_what_is_undecided() -> None:
    """On 60 folded and pierced nets, of 10,000 arcs no end is left over that nothing explains."""
    cells = subdivide_patches(gauss_function(batch(random_nets(60, 1)), 0.0))
    keys = free_ends(cells, arcs_of(cells))
    assert len(keys) > 100
    assert touching(cells, keys).all()


@pytest.mark.parametrize("factor", [False, True], ids=["one", "product"])
def test_whole_numbers_leave_no_end_over(factor: bool) -> None:
    """Polynomials of small whole numbers, nil at corners and edges: no end is unexplained."""
    draw = np.random.default_rng(5)
    for m, n in ((1, 3), (2, 2), (4, 3)):
        b = draw.integers(-1, 2, (60, m + 1, n + 1)).astype(np.float64)
        if factor:
            b = multiply(b, draw.integers(-2, 3, (60, 3, 2)).astype(np.float64))
        cells = subdivide_patches(IsoFunction(b, np.full(b.shape, 1e-14)), budget=500)
        arcs = arcs_of(cells)
        simple = (cells.kind == CellKind.U_SIMPLE) | (cells.kind == CellKind.V_SIMPLE)
        assert np.array_equal(arcs.cell, np.flatnonzero(simple))
        assert touching(cells, free_ends(cells, arcs)).all()


def test_ends_lie_on_borders_to_the_bit() -> None:
    """Each end has a parameter of a border of its cell, and the span is that of its ends."""
    cells = subdivide_patches(gauss_function(batch(graph_plates(30, 2)), 0.0))
    arcs = arcs_of(cells)
    box = cells.box[arcs.cell]
    on_border = (arcs.ends[..., None] == box[:, None]).any(axis=(2, 3))
    assert on_border.all()
    run = arcs.ends[np.arange(len(arcs)), :, 1 - arcs.across]
    assert np.array_equal(run, arcs.span)
    assert (arcs.span[:, 0] < arcs.span[:, 1]).all()
    assert np.array_equal(arcs.across, cells.kind[arcs.cell] == CellKind.V_SIMPLE)
    assert (np.diff(arcs.cell) > 0).all()


def test_exchanged_parameters_give_exchanged_arcs() -> None:
    """With u and v exchanged, in one cell, the arc is the same with its parameters exchanged."""
    b = polynomial({(1, 0): 1.0, (0, 2): 0.4, (0, 0): -0.5}, 5)
    arcs, other = (arcs_of(subdivide_patches(function(each))) for each in (b, b.T))
    assert (arcs.across.tolist(), other.across.tolist()) == ([0], [1])
    assert np.abs(arcs.ends - other.ends[..., ::-1]).max() < 1e-15
    assert arcs.rising.tolist() == other.rising.tolist() == [True]
    assert arcs_of(subdivide_patches(function(-b))).rising.tolist() == [False]


@pytest.mark.parametrize(
    ("terms", "ends"),
    [
        ({(1, 0): 1.0, (0, 1): -1.0}, [[0.0, 0.0], [1.0, 1.0]]),
        ({(1, 0): 1.0, (0, 1): 1.0, (0, 0): -1.0}, [[1.0, 0.0], [0.0, 1.0]]),
        ({(1, 0): 1.0, (0, 1): 2.0, (0, 0): -0.5}, [[0.0, 0.25], [0.5, 0.0]]),
        ({(1, 0): 2.0, (0, 1): 1.0, (0, 0): -0.5}, [[0.25, 0.0], [0.0, 0.5]]),
        ({(1, 0): 2.0, (0, 1): 1.0, (0, 0): -2.5}, [[1.0, 0.5], [0.75, 1.0]]),
    ],
    ids=["diagonal", "other diagonal", "corner, steep", "corner, flat", "far corner"],
)
def test_ends_of_straight_lines(
    terms: dict[tuple[int, int], float], ends: list[list[float]]
) -> None:
    """A line from corner to corner, or across a corner, is one arc with its ends there."""
    found = arcs_of(subdivide_patches(function(polynomial(terms, 4))))
    assert len(found) == 1
    assert np.abs(np.sort(found.ends[0], axis=0) - np.sort(ends, axis=0)).max() < 1e-15


def test_arcs_do_not_depend_on_their_batch() -> None:
    """Arcs and their points are the same to the last bit alone and in a batch."""
    nets = np.concatenate([graph_plates(12, 5), random_nets(2, 6)])
    f = gauss_function(batch(nets), 0.0)
    cells = subdivide_patches(f)
    arcs = arcs_of(cells)
    start, uv = sample_arcs(batch(nets), cells, arcs, 0.002)
    for k in range(14):
        own = subdivide_patches(IsoFunction(f.b[k : k + 1], f.err[k : k + 1]))
        alone = arcs_of(own)
        rows = np.flatnonzero(cells.patch[arcs.cell] == k)
        assert np.array_equal(arcs.ends[rows], alone.ends)
        begin, point = sample_arcs(Patches.single(nets[k]), own, alone, 0.002)
        assert np.array_equal(np.diff(start)[rows], np.diff(begin))
        assert np.array_equal(uv[start[rows[0]] : start[rows[-1] + 1]], point)


@pytest.mark.parametrize("name", ["P03_circle_loop", "P08_wavy_plate", "P20_five_arcs"])
def test_every_point_of_a_polyline_is_a_root(name: str) -> None:
    """Points are 1e-13 from the zero set, by curvature found without the polynomial."""
    patches = Patches.single(patch(name))
    cells = subdivide_patches(gauss_function(patches, 0.0))
    arcs = arcs_of(cells)
    start, uv = sample_arcs(patches, cells, arcs, 0.001)
    assert np.array_equal(uv[start[:-1]], arcs.ends[:, 0])
    assert np.array_equal(uv[start[1:] - 1], arcs.ends[:, 1])
    value, step = np.empty((5, len(uv))), 1e-6
    for k, (u, v) in enumerate([(0, 0), (1, 0), (-1, 0), (0, 1), (0, -1)]):
        place = np.clip(uv + step * np.array([u, v]), 0.0, 1.0)
        value[k] = pointwise(patches.net, np.zeros(1, np.int64), place[None])[0]
    slope = np.hypot(value[1] - value[2], value[3] - value[4]) / (2.0 * step)
    assert np.abs(value[0] / slope).max() < 1e-13


@pytest.mark.parametrize("chord_tol", [0.02, 0.001])
def test_polylines_keep_their_chord_tolerance(chord_tol: float) -> None:
    """A circle in a plate stays as near to its chords as was asked, and has no points in vain."""
    net = plate({(3, 0): 1.0, (1, 2): -3.0, (2, 0): 1.5, (0, 2): 1.5})
    patches = Patches.single(net)
    cells = subdivide_patches(gauss_function(patches, 0.0))
    start, uv = sample_arcs(patches, cells, arcs_of(cells), chord_tol)
    xyz = patch_points(patches, np.zeros(len(uv), np.int64), uv)
    inner = np.setdiff1d(np.arange(len(uv) - 1), start[1:] - 1)
    middle = 0.5 * (xyz[inner] + xyz[inner + 1])
    assert np.abs(np.hypot(xyz[:, 0], xyz[:, 1]) - 0.5).max() < 1e-14
    assert (0.5 - np.hypot(middle[:, 0], middle[:, 1])).max() < chord_tol
    assert len(uv) < (70 if chord_tol > 0.01 else 160)


def test_an_arc_that_meets_its_chord_in_the_middle_is_followed() -> None:
    """An arc in the shape of an S has points on both of its bows."""
    terms = {(1, 0): 1.0, (0, 3): -2.0, (0, 2): 3.0, (0, 1): -1.0, (0, 0): -0.5}
    cells = subdivide_patches(function(polynomial(terms, 3)))
    flat = Patches.single(plate({}, (0.0, 1.0, 0.0, 1.0)))
    _, uv = sample_arcs(flat, cells, arcs_of(cells), 0.01)
    assert len(cells) == 1
    assert len(uv) > 8
    assert np.ptp(uv[:, 0]) == pytest.approx(0.19, abs=0.01)


def test_short_arcs_have_no_points_in_vain() -> None:
    """Where arcs are shorter than the tolerance, only their ends are given."""
    patches = Patches.single(patch("P05_cross"))
    cells = subdivide_patches(gauss_function(patches, 0.0))
    start, _ = sample_arcs(patches, cells, arcs_of(cells), 10.0)
    assert np.diff(start).tolist() == [2] * (len(start) - 1)


def test_borders_are_kept_to_the_bit() -> None:
    """At 0 and 1 of a box its borders are given, not sums that round to another number."""
    box = np.array([[0.1, 0.7], [2.0**-54, 0.5 + 2.0**-53]])
    assert box[1, 0] + (box[1, 1] - box[1, 0]) != box[1, 1]
    assert np.array_equal(patch_parameters(box, np.zeros(2)), box[:, 0])
    assert np.array_equal(patch_parameters(box, np.ones(2)), box[:, 1])


def test_heights_are_where_the_polynomial_is_nil() -> None:
    """At the height of an arc its polynomial vanishes, on 50 lines of 100 cells."""
    random = np.random.default_rng(4)
    b = np.sort(random.normal(size=(100, 9, 6)), axis=1)
    b[:, 0], b[:, -1] = -1.0, 1.0
    rising = np.arange(100) % 2 == 0
    b = np.where(rising[:, None, None], b, -b)
    t = random.random((100, 50))
    g = arc_heights(b, rising, t)
    u = bernstein_table(g.ravel(), 8).reshape(9, 100, 50)
    v = bernstein_table(t.ravel(), 5).reshape(6, 100, 50)
    assert np.abs(np.einsum("icq,cij,jcq->cq", u, b, v)).max() < 1e-14
