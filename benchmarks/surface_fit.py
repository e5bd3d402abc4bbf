"""Fits of surfaces to points: ours beside scipy's, growth with size, and what an edit costs.

The peers solve once, with parameters as they are: the same equations with sparse matrices of scipy,
and FITPACK's least squares of one coordinate after the other, which has no penalty.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial

import numpy as np
from scipy import sparse
from scipy.interpolate import BSpline, LSQBivariateSpline
from scipy.sparse.linalg import splu

import assoc_hull as ah
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.fitting.basis import clamped_knots
from assoc_hull.geometry.fitting.fit_input import Samples
from assoc_hull.geometry.fitting.fit_surface import even_breaks, fit_surface, gram, solve_controls
from assoc_hull.hull import Hull
from assoc_hull.surface.blocks.fit_net import share_kept
from benchmarks.clock import Figure, side_by_side

__all__ = ["figures"]

LENGTH, GIRTH = 217.0, 40.0
SPANS, POINTS, SMOOTHING = (70, 30), 20_000, 1e-3
PULLS = {
    "carrier, bow": ("bulk_carrier_207k", "WL 8 x ST 20.175"),
    "Series 60, midship": ("series60", "WL 0.25 x ST 10"),
}


def body(points: int) -> Samples:
    """Give points all over a smooth body of a ship of 230 m."""
    u, v = (np.random.default_rng(1).random((points, 2)) * [LENGTH, GIRTH]).T
    y = 16.0 * np.tanh(v / 8.0) * (1.0 - ((u - 108.0) / 150.0) ** 4)
    z = np.maximum(v - 16.0, 0.0) + 0.3 * np.sin(u / 9.0)
    return Samples.of(np.column_stack([u, v]), np.column_stack([u, y, z]), 0.5)


def breaks_of(spans: tuple[int, int]) -> tuple[FloatArray, FloatArray]:
    """Give even spans."""
    return even_breaks(0.0, LENGTH, spans[0]), even_breaks(0.0, GIRTH, spans[1])


def ours(samples: Samples, spans: tuple[int, int]) -> object:
    """Solve and correct the parameters, four times."""
    return fit_surface("body", samples, *breaks_of(spans), SMOOTHING)


def once(samples: Samples, spans: tuple[int, int]) -> FloatArray:
    """Solve once, by our banded equations."""
    u, v = (clamped_knots(each) for each in breaks_of(spans))
    return solve_controls(samples, u, v, SMOOTHING)


def by_sparse(samples: Samples, spans: tuple[int, int]) -> FloatArray:
    """Solve the same equations with sparse matrices and a sparse LU."""
    knots = [clamped_knots(each) for each in breaks_of(spans)]
    rows = [BSpline.design_matrix(samples.uv[:, i], knots[i], 3).tocsr() for i in (0, 1)]
    k, width = len(samples), rows[1].shape[1]
    values = (rows[0].data.reshape(k, 4, 1) * rows[1].data.reshape(k, 1, 4)).ravel()
    column = rows[0].indices.reshape(k, 4, 1) * width + rows[1].indices.reshape(k, 1, 4)
    shape = k, rows[0].shape[1] * width
    matrix = sparse.csr_array((values, column.ravel(), np.arange(0, 16 * k + 1, 16)), shape=shape)
    u, v = ([_full(gram(each, order)) for order in range(3)] for each in knots)
    bend = sparse.kron(u[2], v[0]) + 2.0 * sparse.kron(u[1], v[1]) + sparse.kron(u[0], v[2])
    weighted = matrix.T.multiply(samples.weight).tocsr()
    normal = (weighted @ matrix + SMOOTHING * bend).tocsc()
    found: FloatArray = splu(normal).solve(weighted @ samples.point)
    return found.reshape(-1, width, 3)


def _full(rows: FloatArray) -> sparse.csr_array:
    """Give a matrix of seven diagonals, of integrals of pairs d + j, j."""
    count = rows.shape[1]
    full = np.zeros((count, count))
    for below in range(4):
        entry = rows[below + 3, : count - below]
        np.fill_diagonal(full[below:], entry)
        np.fill_diagonal(full[:, below:], entry)
    return sparse.csr_array(full)


def by_fitpack(samples: Samples, spans: tuple[int, int]) -> object:
    """Solve for one coordinate after the other with FITPACK, without a penalty."""
    u, v = breaks_of(spans)
    x, y = samples.uv.T
    return [
        LSQBivariateSpline(x, y, samples.point[:, axis], u[1:-1], v[1:-1], w=samples.weight**0.5)
        for axis in range(3)
    ]


@contextmanager
def pulled(hull: Hull, point: str) -> Iterator[None]:
    """Pull a hull by 2 cm for a while."""
    with hull.edit("pull") as edit:
        edit.pull(point, d=0.02, radius=(4.0, 3.0))
    yield
    hull.undo()


def after_edits(rounds: int) -> list[Figure]:
    """Measure what a surface costs after an edit, and how many Bezier patches it keeps."""
    found = []
    for name, (maker, point) in PULLS.items():
        hull = getattr(ah.examples, maker)()
        before = hull.surface()
        with pulled(hull, point):
            after = hull.surface(previous=before)
            jobs: dict[str, Callable[[], object]] = {
                "scratch": partial(ah.Hull.surface, hull),
                "follow": partial(ah.Hull.surface, hull, previous=before),
            }  # fmt: skip
            taken = side_by_side(jobs, rounds)
        ratio = taken["scratch"] / taken["follow"]
        found += [
            Figure(f"{name} pulled: blocks fitted", float(len(after.refitted)), ""),
            Figure(f"{name} pulled: from scratch", taken["scratch"], "s"),
            Figure(f"{name} pulled: from scratch / with previous=", ratio),
        ]
        parts = {new.name: (new.surface,) for new in after.blocks if new.name in after.refitted}
        for part, surfaces in {**parts, "all blocks": after.patches}.items():
            share = share_kept(surfaces, before.patches)
            found.append(Figure(f"{name} pulled: Bezier patches kept of {part}", share, ""))
    return found


def figures(quick: bool = False) -> list[Figure]:
    """Measure."""
    rounds = 3 if quick else 7
    samples = body(POINTS)
    few, fine = (24, 10), (SPANS[0] * 2, SPANS[1] * 2)
    jobs: dict[str, Callable[[], object]] = {
        "ours": lambda: ours(samples, SPANS),
        "twice": lambda: ours(body(2 * POINTS), SPANS),
        "fine": lambda: ours(samples, fine),
        "once": lambda: once(samples, SPANS),
        "sparse": lambda: by_sparse(samples, SPANS),
        "few": lambda: once(samples, few),
        "FITPACK": lambda: by_fitpack(samples, few),
    }
    taken = side_by_side(jobs, rounds)
    peer, fitpack = taken["sparse"] / taken["once"], taken["FITPACK"] / taken["few"]
    off = float(np.abs(once(samples, SPANS) - by_sparse(samples, SPANS)).max())
    return [
        Figure("fit of 20,000 points, 70 x 30 spans, 4 rounds", taken["ours"], "s", 0.6, "most"),
        Figure("one solution of it", 1e3 * taken["once"], "ms"),
        Figure("by scipy's sparse matrices and LU / by ours", peer, "x", 1.0),
        Figure("largest difference of control points", off, "m", 1e-6, "most"),
        Figure("24 x 10 spans by FITPACK, no penalty / by ours", fitpack, "x", 1.0),
        Figure("40,000 points / 20,000", taken["twice"] / taken["ours"], "x", 2.5, "most"),
        Figure("140 x 60 spans / 70 x 30", taken["fine"] / taken["ours"]),
        *after_edits(2 if quick else 5),
    ]  # fmt: skip
