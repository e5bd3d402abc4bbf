"""Cells that cover a patch: what is claimed of each is true, and what is not known is told."""

import tracemalloc

import numpy as np
import pytest

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.bezier_patches import Patches
from assoc_hull.geometry.patches.cell_subdivision import FIRST_CUT, OTHER_CUT, subdivide_patches
from assoc_hull.geometry.patches.cells import CellKind, SignCells, ZeroSetArcs
from assoc_hull.geometry.patches.curvature_functions import IsoFunction, gauss_function
from assoc_hull.geometry.patches.zero_set_arcs import (
    arc_heights,
    arcs_of,
    bernstein_table,
    polynomials_over,
)
from tests.curved_patches import graph_plates, nets, patch, random_nets
from tests.unit.geometry.patches.isolines import (
    Box,
    batch,
    function,
    monkey,
    plate,
    pointwise,
    polynomial,
)

UNRESOLVED = {"P02_monkey": 2, "P05_cross": 4}
POINTS = np.array([0.0, 0.03, 0.2, 0.5, 0.8, 0.97, 1.0])


def gauss(net: FloatArray, delta: float = 0.0) -> IsoFunction:
    """The polynomial of Gaussian curvature of one patch."""
    return gauss_function(Patches.single(net), 0.0, delta)


def kinds_of(cells: SignCells) -> dict[CellKind, int]:
    """How many cells there are of each kind."""
    return {kind: int((cells.kind == kind).sum()) for kind in CellKind if kind in cells.kind}


@pytest.mark.parametrize("name", sorted(set(nets()) - {"P07_double_cross"}))
def test_what_is_left_of_reference_patches(name: str) -> None:
    """Only the isolated point and the crossing stay open: a few cells, at the last level."""
    cells = subdivide_patches(gauss(patch(name)))
    left = cells.level[cells.kind == CellKind.UNRESOLVED]
    assert len(left) <= UNRESOLVED.get(name, 0)
    assert (left == 16).all()
    assert (len(left) > 0) == (name in UNRESOLVED)
    assert not cells.stopped.any()


@pytest.mark.parametrize(("name", "most"), [("P02_monkey", 2), ("P05_cross", 4)])
def test_a_point_costs_a_few_cells_a_level(name: str, most: int) -> None:
    """At each level an isolated zero has one or two open cells, a crossing four at most."""
    for depth in range(2, 14, 3):
        cells = subdivide_patches(gauss(patch(name)), depth=depth)
        assert 1 <= (cells.kind == CellKind.UNRESOLVED).sum() <= most


def test_a_double_line_doubles_its_cells_until_the_budget_ends() -> None:
    """A line without change of sign has twice the cells at each level; the budget ends this."""
    counts = []
    for depth in (5, 6, 7):
        cells = subdivide_patches(gauss(patch("P07_double_cross")), depth=depth)
        assert not cells.stopped.any()
        counts.append(int((cells.kind == CellKind.UNRESOLVED).sum()))
    assert counts == [63, 127, 255]
    cells = subdivide_patches(gauss(patch("P07_double_cross")), budget=1000)
    assert cells.stopped.tolist() == [True]
    assert len(cells) < 4 * 1000
    assert (cells.kind == CellKind.UNRESOLVED).any()
    assert (cells.kind != CellKind.POSITIVE).all()


@pytest.mark.parametrize(
    ("name", "kind"),
    [("P13_plane", 0), ("P14_cyl", 0), ("P15_cyl_rot", 0), ("P16_cone_rot", 0),
     ("P11_hypar", -1), ("P12_bowl", 1), ("P17_pole_sphere", 1), ("P18_inflect_edge", 1)],
)  # fmt: skip
def test_patches_of_one_sign_are_one_cell(name: str, kind: int) -> None:
    """A developable patch is nil, a bowl positive, at once; so are poles, edges with K = 0."""
    assert subdivide_patches(gauss(patch(name), 1e-12)).kind.tolist() == [kind]


def checked_points(cells: SignCells) -> tuple[FloatArray, FloatArray]:
    """A grid of points in each cell: local (c, 7, 7, 2), and in the patch."""
    local = np.stack(np.meshgrid(POINTS, POINTS, indexing="ij"), axis=-1)
    low, high = cells.box[:, None, None, :, 0], cells.box[:, None, None, :, 1]
    return local, low + local * (high - low)


def claimed(cells: SignCells, arcs: ZeroSetArcs) -> FloatArray:
    """The signs that cells and arcs claim at the points of `checked_points`: nan for none."""
    found = np.full((len(cells), 7, 7), np.nan)
    found[np.abs(cells.kind) == 1] = cells.kind[np.abs(cells.kind) == 1, None, None]
    for across in (0, 1):
        rows = np.flatnonzero(arcs.across == across)
        cell = arcs.cell[rows]
        box = cells.box[cell, 1 - across]
        ends = (arcs.span[rows] - box[:, :1]) / (box[:, 1:] - box[:, :1])
        places = np.clip(POINTS, ends[:, :1], ends[:, 1:])
        b = polynomials_over(cells, cell, across)
        height = arc_heights(b, arcs.rising[rows], places)
        side = np.sign(POINTS[:, None] - height[:, None, :])
        side = np.where(arcs.rising[rows, None, None], side, -side)
        inside = (ends[:, :1] <= POINTS) & (ends[:, 1:] >= POINTS)
        side[np.broadcast_to(~inside[:, None], side.shape)] = np.nan
        found[cell] = side.swapaxes(1, 2) if across else side
    return found


def thinned(cells: SignCells, arcs: ZeroSetArcs, count: int) -> tuple[SignCells, ZeroSetArcs]:
    """About so many of the cells, with their arcs."""
    kept = np.arange(len(cells)) % (len(cells) // count + 1) == 0
    number, own = np.cumsum(kept) - 1, kept[arcs.cell]
    thin = SignCells(
        cells.patch[kept], cells.box[kept], cells.level[kept], cells.kind[kept], cells.row[kept],
        cells.b, cells.err, cells.stopped,
    )  # fmt: skip
    return thin, ZeroSetArcs(
        number[arcs.cell[own]], arcs.across[own], arcs.span[own], arcs.ends[own], arcs.rising[own]
    )


def bound(function: IsoFunction, cells: SignCells, place: FloatArray) -> FloatArray:
    """What rounding may do to the polynomial at points (c, p, 2)."""
    m, n = (size - 1 for size in function.err.shape[1:])
    u, v = bernstein_table(place[..., 0].ravel(), m), bernstein_table(place[..., 1].ravel(), n)
    err = (np.abs(function.b) * 1e-15 + function.err)[cells.patch]
    lines = np.einsum("icp,cij->cpj", u.reshape(-1, *place.shape[:2]), err)
    return np.asarray(np.einsum("jcp,cpj->cp", v.reshape(-1, *place.shape[:2]), lines))


@pytest.mark.parametrize("draw", [graph_plates, random_nets], ids=["graphs", "anywhere"])
def test_every_claim_on_random_patches_is_true(draw: object) -> None:
    """Signs found point by point, without the polynomial, are those that cells and arcs claim."""
    assert callable(draw)
    net = draw(120 if draw is graph_plates else 60, 5)
    f = gauss_function(batch(net), 0.0)
    cells = subdivide_patches(f)
    arcs = arcs_of(cells)
    assert sorted(arcs.cell) == np.flatnonzero((cells.kind == 2) | (cells.kind == 3)).tolist()
    cells, arcs = thinned(cells, arcs, 3000)
    _, place = checked_points(cells)
    place = place.reshape(len(cells), -1, 2)
    value = pointwise(net, cells.patch, place)
    wide = bound(f, cells, place)
    sign = claimed(cells, arcs).reshape(len(cells), -1)
    assert (value * sign >= -wide)[~np.isnan(sign)].all()
    assert (np.abs(value) <= wide)[cells.kind == CellKind.ZERO].all()
    assert np.isnan(sign).mean() < 0.25
    assert_one_sign_beside_arcs(cells, sign, value, wide)


def assert_one_sign_beside_arcs(
    cells: SignCells, sign: FloatArray, value: FloatArray, wide: FloatArray
) -> None:
    """Lines of a simple cell that its arc does not reach have one sign."""
    for kind in (CellKind.U_SIMPLE, CellKind.V_SIMPLE):
        rows = cells.kind == kind
        shape = (-1, 7, 7)
        grids = [a[rows].reshape(shape) for a in (sign, value, wide)]
        if kind == CellKind.V_SIMPLE:
            grids = [grid.swapaxes(1, 2) for grid in grids]
        free = np.isnan(grids[0]).all(axis=1)
        above = (grids[1] > grids[2]).any(axis=1)
        below = (grids[1] < -grids[2]).any(axis=1)
        assert not (free & above & below).any()


def test_cells_tile_each_patch() -> None:
    """Every point lies in one cell, and borders of neighbours are the same number."""
    cells = subdivide_patches(gauss_function(batch(graph_plates(20, 3)), 0.0))
    size = cells.box[..., 1] - cells.box[..., 0]
    assert np.abs(np.bincount(cells.patch, size.prod(axis=1)) - 1.0).max() < 1e-14
    for k in range(20):
        box = cells.box[cells.patch == k]
        point = np.random.default_rng(k).random((200, 1, 2))
        inside = ((box[:, :, 0] < point) & (point < box[:, :, 1])).all(axis=2)
        assert (inside.sum(axis=1) == 1).all()
        for axis in (0, 1):
            assert np.isin(box[:, axis, 1], [*box[:, axis, 0], 1.0]).all()


def test_a_patch_does_not_depend_on_its_batch() -> None:
    """Cells and polynomials are the same to the last bit alone, in a batch, in another order."""
    f = gauss_function(batch(np.concatenate([graph_plates(70, 1), random_nets(4, 2)])), 0.0)
    whole = subdivide_patches(f)
    order = np.random.default_rng(3).permutation(74)
    mixed = subdivide_patches(IsoFunction(f.b[order], f.err[order]))
    for k in [*range(0, 74, 9), 70, 71, 72, 73]:
        alone = subdivide_patches(IsoFunction(f.b[k : k + 1], f.err[k : k + 1]))
        for cells, number in ((whole, k), (mixed, int(np.flatnonzero(order == k)[0]))):
            rows = cells.patch == number
            used = cells.row[rows][cells.row[rows] >= 0]
            assert np.array_equal(cells.box[rows], alone.box)
            assert np.array_equal(cells.kind[rows], alone.kind)
            assert np.array_equal(cells.b[used], alone.b)
            assert np.array_equal(cells.err[used], alone.err)


def test_cells_come_in_the_order_of_patch_level_and_box() -> None:
    """The order is told, and rows of polynomials follow it."""
    cells = subdivide_patches(gauss_function(batch(graph_plates(9, 4)), 0.0))
    keys = [*zip(cells.patch, cells.level, cells.box[:, 0, 0], cells.box[:, 1, 0], strict=True)]
    assert keys == sorted(keys)
    assert cells.row[cells.row >= 0].tolist() == list(range(len(cells.b)))
    assert np.array_equal(cells.row >= 0, cells.kind > CellKind.POSITIVE)


@pytest.mark.parametrize("radius", [1e-2, 1e-3, 1e-4])
@pytest.mark.parametrize("box", [(-0.8, 1.0, -0.9, 0.7), (-1.0, 1.0, -1.0, 1.0)])
def test_small_loops_are_found(radius: float, box: Box) -> None:
    """A convex disc in a monkey saddle, down to a radius of 1e-4, is closed by arcs."""
    cells = subdivide_patches(gauss(monkey(radius, box)))
    arcs = arcs_of(cells)
    assert CellKind.UNRESOLVED not in cells.kind
    ends = np.sort(arcs.ends.reshape(-1, 2), axis=0)
    assert np.abs(ends[::2] - ends[1::2]).max() < 1e-12
    x = box[0] + (box[1] - box[0]) * arcs.ends[..., 0]
    y = box[2] + (box[3] - box[2]) * arcs.ends[..., 1]
    assert np.abs(np.hypot(x, y) / radius - 1.0).max() < 1e-15 / radius**2 + 1e-12


def test_a_loop_below_the_last_cells_is_told_as_open() -> None:
    """A convex disc of 1e-5 is not lost: cells that hold it are unresolved."""
    cells = subdivide_patches(gauss(monkey(1e-5)))
    assert 1 <= kinds_of(cells)[CellKind.UNRESOLVED] <= 4
    box = cells.box[cells.kind == CellKind.UNRESOLVED]
    middle = np.array([0.8 / 1.8, 0.9 / 1.6])
    assert (box[..., 0].min(axis=0) <= middle).all()
    assert (box[..., 1].max(axis=0) >= middle).all()


@pytest.mark.parametrize("box", [(-1.0, 1.0, -1.0, 1.0), (-0.7, 1.1, -0.8, 0.9)])
def test_a_straight_line_in_the_middle_is_found(box: Box) -> None:
    """The line of a plate x**3 + y**2 is an arc, also where it halves the patch."""
    arcs = arcs_of(subdivide_patches(gauss(plate({(3, 0): 1.0, (0, 2): 1.0}, box))))
    assert len(arcs) == 1
    assert np.abs(arcs.ends[0, :, 0] + box[0] / (box[1] - box[0])).max() < 4e-16
    assert arcs.ends[0, :, 1].tolist() == [0.0, 1.0]


@pytest.mark.parametrize("at", [*FIRST_CUT, *OTHER_CUT, 0.5])
@pytest.mark.parametrize("turned", [False, True], ids=["u", "v"])
def test_a_line_where_a_cut_goes_is_found(at: float, turned: bool) -> None:
    """A zero line that a cut would follow from end to end is an arc all the same."""
    line = polynomial({(2, 0): 1.0, (1, 0): -at - 0.1, (0, 0): 0.1 * at}, 6)
    cells = subdivide_patches(function(line.T if turned else line))
    arcs = arcs_of(cells)
    found = arcs.ends[..., int(turned)].mean(axis=1)
    assert CellKind.UNRESOLVED not in cells.kind
    for place in (0.1, at):
        rows = np.abs(found - place) < 1e-9
        length = np.abs(arcs.span[rows, 1] - arcs.span[rows, 0]).sum()
        assert length == pytest.approx(1.0, abs=1e-12)


def test_crossings_are_never_taken_for_arcs_that_pass() -> None:
    """In the middle of each of 60 crossings, at any angle, lies a cell that is unresolved."""
    random = np.random.default_rng(8)
    crossings, places = [], random.uniform(0.1, 0.9, (60, 2))
    for (x, y), (a, b) in zip(places, random.uniform(0.0, np.pi, (60, 2)), strict=True):
        first = {(1, 0): np.cos(a), (0, 1): np.sin(a), (0, 0): -x * np.cos(a) - y * np.sin(a)}
        other = {(1, 0): np.cos(b), (0, 1): np.sin(b), (0, 0): -x * np.cos(b) - y * np.sin(b)}
        terms: dict[tuple[int, int], float] = {}
        for (i, j), p in first.items():
            for (k, l), q in other.items():
                terms[i + k, j + l] = terms.get((i + k, j + l), 0.0) + p * q
        crossings.append(polynomial(terms, 8))
    cells = subdivide_patches(function(*crossings))
    left = cells.kind == CellKind.UNRESOLVED
    low, high = cells.box[..., 0], cells.box[..., 1]
    near = (low - 1e-9 <= places[cells.patch]) & (places[cells.patch] <= high + 1e-9)
    assert set(cells.patch[left & near.all(axis=1)]) == set(range(60))


@pytest.mark.parametrize(("m", "n"), [(2, 2), (1, 5), (2, 8), (14, 14), (20, 20), (32, 32)])
def test_polynomials_of_any_degree(m: int, n: int) -> None:
    """The signs at points are those claimed, for degrees of bilinear to rational patches."""
    b = np.random.default_rng(m).normal(size=(4, m + 1, n + 1))
    f = IsoFunction(b, np.full(b.shape, 1e-13))
    cells = subdivide_patches(f)
    arcs = arcs_of(cells)
    _, place = checked_points(cells)
    place = place.reshape(len(cells), -1, 2)
    u = bernstein_table(place[..., 0].ravel(), m).reshape(m + 1, len(cells), -1)
    v = bernstein_table(place[..., 1].ravel(), n).reshape(n + 1, len(cells), -1)
    value = np.einsum("icp,cij,jcp->cp", u, b[cells.patch], v, optimize=True)
    sign = claimed(cells, arcs).reshape(len(cells), -1)
    assert (value * sign >= -1e-12)[~np.isnan(sign)].all()
    assert (cells.kind == CellKind.UNRESOLVED).sum() <= 8


@pytest.mark.parametrize(
    ("b", "err", "kind"),
    [
        (np.zeros((3, 3)), 0.0, CellKind.ZERO),
        (np.eye(5) - 0.3, 9.0, CellKind.ZERO),
        (np.ones((1, 1)), 0.0, CellKind.POSITIVE),
        (-np.ones((4, 2)), 0.5, CellKind.NEGATIVE),
        (np.array([[0.0, 1.0], [1.0, 1.0]]), 0.0, CellKind.POSITIVE),
        (np.array([[0.0, 0.0], [-1.0, -1.0]]), 1e-9, CellKind.NEGATIVE),
    ],
    ids=["nil", "all in the error", "one", "error of half", "nil corner", "nil edge"],
)
def test_polynomials_of_one_sign(b: FloatArray, err: float, kind: CellKind) -> None:
    """What is nil, or of one sign within its error, is one cell."""
    cells = subdivide_patches(IsoFunction(b[None].copy(), np.full((1, *b.shape), err)))
    assert cells.kind.tolist() == [kind]
    assert len(arcs_of(cells)) == 0


def test_errors_as_large_as_the_polynomial_end_the_search() -> None:
    """Noise about its error is told as nil or unresolved, in few cells, and claims no arc."""
    b = np.random.default_rng(0).normal(size=(1, 15, 15))
    cells = subdivide_patches(IsoFunction(b, np.full(b.shape, 0.3)))
    assert len(cells) < 6000
    assert not cells.stopped.any()
    assert {CellKind.ZERO, CellKind.UNRESOLVED} <= set(kinds_of(cells))
    assert len(arcs_of(cells)) == 0


def test_no_patches_have_no_cells() -> None:
    """An empty batch is solved."""
    none = np.zeros((0, 4, 4))
    cells = subdivide_patches(IsoFunction(none, none.copy()))
    assert (len(cells), len(arcs_of(cells)), cells.b.shape) == (0, 0, (0, 4, 4))


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_polynomials_that_are_not_finite_are_refused(value: float) -> None:
    """A coefficient that is no number is not taken for nil."""
    b = np.ones((3, 2, 2))
    b[1, 0, 1] = value
    with pytest.raises(BadInputError, match=r"coefficient 0, 1 .* patch 1;"):
        subdivide_patches(IsoFunction(b, np.zeros((3, 2, 2))))


def test_what_counts_as_nil_moves_no_arc() -> None:
    """Cells no larger than what is known are nil; those with arcs, and the arcs, stay."""
    b = polynomial({(2, 0): 1.0, (1, 0): -0.9, (0, 0): 0.14, (0, 4): 0.3}, 6)
    f = function(b, 1e-12 * b, b)
    nil = np.full(f.b.shape, 1e-10)
    plain, known = subdivide_patches(f), subdivide_patches(f, nil=nil)
    assert known.kind[known.patch == 1].tolist() == [CellKind.ZERO]
    for k in (0, 2):
        mine, own = (cells.box[cells.patch == k] for cells in (plain, known))
        assert np.array_equal(mine, own)
    ends = [arcs_of(cells).ends for cells in (plain, known)]
    count = int((arcs_of(plain).cell < (plain.patch == 0).sum()).sum())
    assert count > 1
    assert np.array_equal(ends[0][:count], ends[1][:count])


def test_many_hostile_patches_fit_into_memory() -> None:
    """Forty patches that use up their budgets take little more memory than what is left open."""
    f = gauss(patch("P07_double_cross"))
    rows = np.zeros(40, np.int64)
    tracemalloc.start()
    cells = subdivide_patches(IsoFunction(f.b[rows], f.err[rows]), budget=400)
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert cells.stopped.all()
    assert most < 6 * (cells.b.nbytes + cells.err.nbytes)
