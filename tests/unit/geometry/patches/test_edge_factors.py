"""Polynomials that are nil along edges, and parts of polynomials."""

import numpy as np
import pytest

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.bernstein_polynomials import multiply
from assoc_hull.geometry.patches.bezier_patches import Patches
from assoc_hull.geometry.patches.cell_subdivision import (
    divide_by_edge_lines,
    subdivide_patches,
    zero_edges,
)
from assoc_hull.geometry.patches.cells import CellKind
from assoc_hull.geometry.patches.curvature_functions import IsoFunction, gauss_function
from assoc_hull.geometry.patches.zero_set_arcs import arcs_of, bernstein_table
from tests.curved_patches import patch
from tests.polynomial_parts import restricted
from tests.unit.geometry.patches.isolines import function, plate, polynomial

U, V = np.array([[0.0], [1.0]]), np.array([[0.0, 1.0]])


def values(b: FloatArray, uv: FloatArray) -> FloatArray:
    """The values of one polynomial at points (p, 2)."""
    u, v = (bernstein_table(uv[:, axis], b.shape[axis] - 1) for axis in (0, 1))
    return np.asarray(np.einsum("ip,ij,jp->p", u, b, v))


@pytest.mark.parametrize(
    ("factors", "lines"),
    [
        ((U,), [True, False, False, False]),
        ((1.0 - U, 1.0 - U), [False, True, False, False]),
        ((V, V, V), [False, False, True, False]),
        ((U, V, V, 1.0 - V), [True, False, True, True]),
    ],
    ids=["u", "(1 - u)**2", "v**3", "u v**2 (1 - v)"],
)
def test_factors_are_taken_out_at_every_edge(
    factors: tuple[FloatArray, ...], lines: list[bool]
) -> None:
    """What is left is the other factor, with an error no smaller than its rounding."""
    rest = np.random.default_rng(1).normal(size=(5, 4))
    b = rest
    for factor in factors:
        b = multiply(b, factor)
    err = 1e-14 * np.abs(b)
    found = divide_by_edge_lines(np.stack([b, err])[None])[0]
    uv = np.random.default_rng(2).random((40, 2))
    assert zero_edges(b[None], err[None])[0].tolist() == lines
    assert found.shape == (2, *b.shape)
    off = np.abs(values(found[0], uv) - values(rest, uv))
    assert (off <= values(found[1], uv)).all()
    assert not zero_edges(found[:1], found[1:]).any()
    assert divide_by_edge_lines(np.stack([b, np.zeros_like(b)])[None])[0, 1].min() > 0.0


def test_patches_without_such_edges_keep_their_bits() -> None:
    """In a batch only those polynomials are divided that have a nil edge; one that is nil stays."""
    b = np.stack([np.ones((3, 3)), multiply(U, np.ones((2, 3))), np.zeros((3, 3))])
    found = divide_by_edge_lines(np.stack([b, np.full(b.shape, 1e-12)], axis=1))
    assert np.array_equal(found[[0, 2], 0], b[[0, 2]])
    assert np.allclose(found[1, 0], 1.0, rtol=0.0, atol=1e-15)


def test_noise_at_a_pole_is_not_cut() -> None:
    """An edge drawn together in a point, its points off by rounding, leaves one cell."""
    net = patch("P17_pole_sphere").copy()
    net += 1e-16 * np.random.default_rng(3).normal(size=net.shape)
    f = gauss_function(Patches.single(net), 0.0, 1e-14)
    assert zero_edges(f.b, f.err).any()
    assert subdivide_patches(f).kind.tolist() == [CellKind.POSITIVE]


def test_noise_at_a_pole_hides_no_loop() -> None:
    """A loop is closed where the polynomial is nil at u = 0 to third order, but for noise."""
    terms = {(2, 0): 1.0, (0, 2): 1.0, (1, 0): -0.8, (0, 1): -1.1, (0, 0): 0.4}
    loop = polynomial(terms, 8)
    b = multiply(multiply(U, U), multiply(U, loop))
    b[:3] = 1e-17 * np.random.default_rng(4).normal(size=b[:3].shape)
    cells = subdivide_patches(IsoFunction(b[None], np.full((1, *b.shape), 1e-15)))
    ends = np.sort(arcs_of(cells).ends.reshape(-1, 2), axis=0)
    assert CellKind.UNRESOLVED not in cells.kind
    assert np.abs(ends[::2] - ends[1::2]).max() < 1e-12
    assert len(cells) < 40


@pytest.mark.parametrize(
    ("terms", "lines"),
    [
        ({(3, 0): 1.0, (0, 2): 1.0}, [True, False, False, False]),
        ({(2, 0): 1.0, (0, 3): 1.0}, [False, False, True, False]),
        ({(2, 0): 1.0, (0, 2): 1.0}, [False, False, False, False]),
        ({(2, 0): 1.0}, [True, True, True, True]),
    ],
    ids=["u = 0", "v = 0", "none", "developable"],
)
def test_edges_where_curvature_vanishes_are_told(
    terms: dict[tuple[int, int], float], lines: list[bool]
) -> None:
    """K = 0 along an edge is told by edge, beside cells that hold no arc."""
    f = gauss_function(Patches.single(plate(terms, (0.0, 1.0, 0.0, 1.0))), 0.0, 1e-13)
    assert zero_edges(f.b, f.err)[0].tolist() == lines
    assert len(subdivide_patches(f)) == 1


def test_restricted_polynomials_have_the_values_of_the_whole() -> None:
    """On boxes down to 1e-6 wide the values are those of the whole, within the error told."""
    b = np.random.default_rng(5).normal(size=(3, 15, 12))
    low = np.random.default_rng(6).uniform(0.0, 0.9, (30, 2))
    size = 10.0 ** np.random.default_rng(7).uniform(-6.0, -1.0, (30, 2))
    box = np.stack([low, low + size], axis=2)
    box[0], box[1] = [[0.0, 1.0], [0.0, 1.0]], [[0.0, 0.25], [0.5, 1.0]]
    own = np.arange(30) % 3
    found = restricted(IsoFunction(b, np.zeros_like(b)), own, box)
    local = np.random.default_rng(8).random((20, 2))
    for k in range(30):
        place = box[k, :, 0] + local * (box[k, :, 1] - box[k, :, 0])
        off = np.abs(values(found.b[k], local) - values(b[own[k]], place))
        assert (off <= 1e-14 + values(found.err[k], local)).all()
        assert 0.0 < found.err[k].min() <= found.err[k].max() < 1e-12


def test_a_box_is_solved_with_other_cuts() -> None:
    """A loop that a cut touches is closed in a box of its own, cut elsewhere."""
    radius, x, y = 0.2, 0.4871 + 0.2, 0.4
    terms = {
        (2, 0): 1.0, (0, 2): 1.0, (1, 0): -2.0 * x, (0, 1): -2.0 * y,
        (0, 0): x * x + y * y - radius * radius,
    }  # fmt: skip
    whole = function(polynomial(terms, 4))
    cells = subdivide_patches(whole)
    left = cells.box[cells.kind == CellKind.UNRESOLVED]
    assert 1 <= len(left) <= 4
    low, high = left[..., 0].min(axis=0), left[..., 1].max(axis=0)
    box = np.stack([low - (high - low), high + (high - low)], axis=1)[None]
    again = subdivide_patches(restricted(whole, np.array([0]), box), split=(0.4583, 0.5391))
    assert CellKind.UNRESOLVED not in again.kind
    assert {CellKind.U_SIMPLE, CellKind.V_SIMPLE} & set(again.kind.tolist())
