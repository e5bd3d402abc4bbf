"""Curvature regions of plates: a batch against one by one and against nodes of a grid.

The peers take K and |S| at 100 x 100 nodes of each plate and add up |S| where K > 0: with scipy's
splines, as one would write it, and with basis matrices in numpy, as fast as that goes.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from time import process_time

import numpy as np
from scipy.interpolate import NdBSpline, bisplev

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.area_integrals import bernstein_values
from assoc_hull.geometry.patches.areas_by_sign import SignAreas, sign_areas
from assoc_hull.geometry.patches.bezier_patches import Patches
from assoc_hull.geometry.patches.cell_subdivision import subdivide_patches
from assoc_hull.geometry.patches.curvature_functions import gauss_function
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.geometry.patches.zero_set_arcs import arcs_of
from assoc_hull.surface.regions.curvature_regions import curvature_regions
from benchmarks.clock import Figure, side_by_side
from tests.curved_patches import graph_plates, patch, references

__all__ = ["figures"]

COUNT, NODES, TOL = 60, 100, 1e-6
WAVY = "P08_wavy_plate"
# (du, dv) of the derivatives that K and |S| are made of.
_ORDERS = (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)

Nodes = Callable[[FloatArray, int], float]


def batch(nets: FloatArray) -> Patches:
    """Give patches of nets (k, m + 1, n + 1, 3)."""
    box = np.broadcast_to([[0.0, 1.0], [0.0, 1.0]], (len(nets), 2, 2))
    return Patches(nets, box.copy(), np.arange(len(nets)))


def regions(nets: FloatArray, tol: float = TOL, level: float = 0.0) -> SignAreas:
    """Give the areas of regions: polynomials, cells, arcs, areas."""
    patches = batch(nets)
    cells = subdivide_patches(gauss_function(patches, level))
    return sign_areas(patches, cells, arcs_of(cells), tol)


def cut_plates(count: int, seed: int = 1) -> FloatArray:
    """Give random plates of 4 m x 2 m that K = 0 cuts."""
    nets = graph_plates(2 * count, seed)
    found = regions(nets, 1e-2)
    cut = (found.positive > 1e-3) & (found.negative > 1e-3)
    assert np.count_nonzero(cut) >= count
    return nets[cut][:count]


def _positive(derivatives: list[FloatArray]) -> float:
    """Give the area where K > 0 as a sum over nodes (..., 3)."""
    ru, rv, ruu, ruv, rvv = derivatives
    s = np.cross(ru, rv)
    k = (s * ruu).sum(axis=-1) * (s * rvv).sum(axis=-1) - (s * ruv).sum(axis=-1) ** 2
    return float(np.linalg.norm(s, axis=-1)[k > 0.0].sum() / k.size)


def _knots(degree: int) -> FloatArray:
    return np.repeat([0.0, 1.0], degree + 1)


def _middles(count: int) -> FloatArray:
    return (np.arange(count) + 0.5) / count


def by_nd_spline(net: FloatArray, count: int) -> float:
    """Sample a plate with scipy's tensor splines."""
    m, n = net.shape[0] - 1, net.shape[1] - 1
    spline = NdBSpline((_knots(m), _knots(n)), net, (m, n))
    t = _middles(count)
    at = np.stack(np.meshgrid(t, t, indexing="ij"), axis=-1)
    return _positive([spline(at, nu=order) for order in _ORDERS])


def by_fitpack(net: FloatArray, count: int) -> float:
    """Sample a plate with FITPACK on a grid, through scipy."""
    m, n = net.shape[0] - 1, net.shape[1] - 1
    t = _middles(count)
    surfaces = [(_knots(m), _knots(n), net[..., c].ravel(), m, n) for c in range(3)]
    return _positive(
        [np.stack([bisplev(t, t, s, *order) for s in surfaces], axis=-1) for order in _ORDERS]
    )


def by_matrices(net: FloatArray, count: int) -> float:
    """Sample a plate with basis matrices, components apart: the fastest way in numpy."""
    shares = _by_matrices(net, count)
    return float(shares[0].sum()) / count**2


def _by_matrices(net: FloatArray, count: int) -> tuple[FloatArray, FloatArray]:
    """Give |S| where K > 0, and K, at nodes."""
    m, n = net.shape[0] - 1, net.shape[1] - 1
    t = _middles(count)
    in_u = [bernstein_values(m - order, t).T for order in range(3)]
    in_v = [bernstein_values(n - order, t) for order in range(3)]
    nets = {(0, 0): np.ascontiguousarray(np.moveaxis(net, -1, 0))}
    nets[1, 0] = m * np.diff(nets[0, 0], axis=1)
    nets[0, 1] = n * np.diff(nets[0, 0], axis=2)
    nets[2, 0] = (m - 1) * np.diff(nets[1, 0], axis=1)
    nets[1, 1] = n * np.diff(nets[1, 0], axis=2)
    nets[0, 2] = (n - 1) * np.diff(nets[0, 1], axis=2)
    ru, rv, ruu, ruv, rvv = (in_u[i] @ nets[i, j] @ in_v[j] for i, j in _ORDERS)
    x = ru[1] * rv[2] - ru[2] * rv[1]
    y = ru[2] * rv[0] - ru[0] * rv[2]
    z = ru[0] * rv[1] - ru[1] * rv[0]
    l, m_, n_ = (x * d[0] + y * d[1] + z * d[2] for d in (ruu, ruv, rvv))
    k = l * n_ - m_ * m_
    return np.sqrt(x * x + y * y + z * z) * (k > 0.0), k


def _sampled(peer: Nodes, nets: FloatArray) -> list[float]:
    return [peer(net, NODES) for net in nets]


def _least(job: Callable[[], object], rounds: int) -> float:
    """Give the least time of a job, s."""
    times = list[float]()
    job()
    for _ in range(rounds):
        begin = process_time()
        job()
        times.append(process_time() - begin)
    return min(times)


def _given_our_time(rounds: int) -> tuple[float, int, float, float]:
    """Give our time and error on the wavy plate, the N of nodes in that time, their error."""
    net, known = patch(WAVY), references()[WAVY]
    ours = _least(lambda: regions(net[None]), rounds)
    error = abs(float(regions(net[None]).positive[0]) - known.positive) / known.total
    count = NODES
    for _ in range(4):  # The time of nodes goes with their number, roughly; so in some steps.
        taken = _least(partial(by_matrices, net, count), max(3, rounds // 2))
        count = max(8, round(count * (ours / taken) ** 0.5))
    off = [abs(by_matrices(net, n) - known.positive) for n in range(count - 2, count + 3)]
    return ours, count, error, float(np.median(off)) / known.total


def figures(quick: bool = False) -> list[Figure]:
    """Measure."""
    rounds = 3 if quick else 9
    nets = cut_plates(4 * COUNT if quick else 16 * COUNT)
    few, more = nets[:COUNT], nets[: 4 * COUNT]
    surfaces = [SplineSurface.bezier(net) for net in few]
    jobs: dict[str, Callable[[], object]] = {
        "batch": lambda: regions(few),
        "single": lambda: [regions(net[None]) for net in few],
        "band": lambda: [regions(few, level=level) for level in (0.00128, -0.00128)],
        "more": lambda: regions(more),
        "fine": lambda: regions(few, 1e-10),
        "public": lambda: curvature_regions(surfaces, zero="exact"),
    }
    peers: dict[str, Nodes] = {
        "NdBSpline": by_nd_spline, "FITPACK": by_fitpack, "matrices": by_matrices,
    }  # fmt: skip
    for name, peer in peers.items():
        jobs[name] = partial(_sampled, peer, few)
    if not quick:
        jobs["most"] = lambda: regions(nets)
    found = side_by_side(jobs, rounds)
    ours, count, error, nodes = _given_our_time(rounds)
    result = [
        Figure(f"{COUNT} cut plates in a batch, one of them", 1e3 * found["batch"] / COUNT, "ms"),
        Figure("one by one / in a batch", found["single"] / found["batch"], "x", 2.0),
        Figure(
            "100 x 100 nodes by NdBSpline / batch", found["NdBSpline"] / found["batch"], "x", 1.0
        ),
        Figure("100 x 100 nodes by FITPACK / batch", found["FITPACK"] / found["batch"], "x", 1.0),
        Figure("100 x 100 nodes by basis matrices / batch", found["matrices"] / found["batch"]),
        Figure(
            "with lines of K = 0 and results (ah.surface.curvature_regions) / batch",
            found["public"] / found["batch"],
        ),
        Figure("tolerance 1e-10 / 1e-6", found["fine"] / found["batch"]),
        Figure("both sides of a band / K = 0", found["band"] / found["batch"]),
        Figure("240 plates / 60", found["more"] / found["batch"], "x", 4.8, "most"),
    ]
    if not quick:
        result.append(Figure("960 plates / 60", found["most"] / found["batch"], "x", 19.2, "most"))
    return [
        *result,
        Figure("wavy plate alone", 1e3 * ours, "ms"),
        Figure("error of K > 0 there, in parts of the whole", error, ""),
        Figure("nodes a side in the same time, by basis matrices", float(count), ""),
        Figure("their error", nodes, ""),
        Figure("their error / ours", nodes / error, "x", 1e4),
        *_accuracy(),
    ]


def _accuracy() -> list[Figure]:
    """Give errors on the wavy plate, in parts of the whole, of other ways and of ours."""
    net, known = patch(WAVY), references()[WAVY]
    found = list[Figure]()
    for count in (10, 50, 100, 200):
        area, k = _by_matrices(net, count)
        share = float((k > 0.0).mean()) - known.positive / known.total
        off = float(area.sum()) / count**2 - known.positive
        found.append(Figure(f"share of {count} x {count} nodes with K > 0: error", abs(share), ""))
        found.append(Figure("|S| at these nodes: error", abs(off) / known.total, ""))
    for tol in (1e-2, 1e-4, 1e-6, 1e-8, 1e-10):
        got = regions(net[None], tol)
        error = abs(float(got.positive[0]) - known.positive) / known.total
        estimate = float(got.error_estimate[0]) / known.total
        found.append(Figure(f"tolerance {tol:g}: error", error, ""))
        found.append(Figure("its estimate", estimate, "", tol, "most"))
    return found
