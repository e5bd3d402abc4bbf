"""A bicubic spline surface fitted to samples by penalised least squares, in its simplest form."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.fitting.samples import Samples
from assoc_hull.geometry.patches.spline_surface import SplineSurface

__all__ = ["clamped", "fit", "values"]

_DEGREE = 3


def clamped(places: FloatArray) -> FloatArray:
    """Give the knots of a cubic with spans between rising places."""
    return np.concatenate([[places[0]] * _DEGREE, places, [places[-1]] * _DEGREE])


def _rows(knots: FloatArray, t: FloatArray, order: int = 0) -> tuple[FloatArray, FloatArray]:
    """Give the first column (k,) and the four values (k, 4) of the basis at each place."""
    from scipy.interpolate import BSpline

    count = len(knots) - _DEGREE - 1
    span = np.clip(np.searchsorted(knots, t, side="right") - 1, _DEGREE, count - 1)
    first = span - _DEGREE
    table = BSpline(knots, np.eye(count), _DEGREE)
    if order:
        table = table.derivative(order)
    full = table(np.clip(t, knots[0], knots[-1]))
    return first, np.take_along_axis(full, first[:, None] + np.arange(4), axis=1)


def values(
    surface: SplineSurface, uv: FloatArray, orders: tuple[tuple[int, int], ...] = ((0, 0),)
) -> list[FloatArray]:
    """Give points or derivatives (k, 3) of a surface for each pair of orders."""
    found = []
    for order in orders:
        i, a = _rows(surface.knots_u, uv[:, 0], order[0])
        j, b = _rows(surface.knots_v, uv[:, 1], order[1])
        local = surface.net[
            (i[:, None] + np.arange(4))[:, :, None], (j[:, None] + np.arange(4))[:, None, :]
        ]
        found.append(np.einsum("ki,kj,kijc->kc", a, b, local))
    return found


def _gram(knots: FloatArray, order: int) -> FloatArray:
    from numpy.polynomial.legendre import leggauss

    node, weight = leggauss(4)
    edges = np.unique(knots)
    half = 0.5 * np.diff(edges)
    t = (0.5 * (edges[:-1] + edges[1:]))[:, None] + half[:, None] * node
    w = (half[:, None] * weight).ravel()
    first, value = _rows(knots, t.ravel(), order)
    full = np.zeros((len(w), len(knots) - _DEGREE - 1))
    np.put_along_axis(full, first[:, None] + np.arange(4), value, axis=1)
    return full.T @ (w[:, None] * full)


def _solve(
    name: str, samples: Samples, ku: FloatArray, kv: FloatArray, smoothing: float
) -> SplineSurface:
    from scipy import sparse
    from scipy.sparse.linalg import splu

    nu, nv = len(ku) - 4, len(kv) - 4
    i, a = _rows(ku, samples.uv[:, 0])
    j, b = _rows(kv, samples.uv[:, 1])
    value = (a[:, :, None] * b[:, None, :]).reshape(len(i), 16)
    four = np.arange(4)
    column = ((i[:, None] + four)[:, :, None] * nv + (j[:, None] + four)[:, None, :]).reshape(
        -1, 16
    )
    row = np.repeat(np.arange(len(i)), 16)
    design = sparse.csr_matrix((value.ravel(), (row, column.ravel())), shape=(len(i), nu * nv))
    kron = sparse.kron
    u, v = [[_gram(k, o) for o in range(3)] for k in (ku, kv)]
    penalty = kron(u[2], v[0]) + 2 * kron(u[1], v[1]) + kron(u[0], v[2])
    left = design.T @ sparse.diags(samples.weight) @ design + smoothing * penalty
    right = design.T @ (samples.weight[:, None] * samples.point)
    net = splu(left.tocsc()).solve(right)
    return SplineSurface(name, (3, 3), ku, kv, net.reshape(nu, nv, 3))


def feet(surface: SplineSurface, samples: Samples, steps: int = 3) -> FloatArray:
    """Give parameters (k, 2) of the nearest points, from those of the samples."""
    uv = samples.uv.copy()
    low, high = np.array(surface.domain).T
    limit = (high - low) / 40.0
    free = ~samples.held
    for _ in range(steps):
        s, su, sv = values(surface, uv, ((0, 0), (1, 0), (0, 1)))
        gap = samples.point - s
        e, f, g = (su * su).sum(1), (su * sv).sum(1), (sv * sv).sum(1)
        p, q = (su * gap).sum(1), (sv * gap).sum(1)
        det = np.maximum(e * g - f * f, 1e-12 * e * g + 1e-300)
        du, dv = (g * p - f * q) / det, (e * q - f * p) / det
        du = np.where(free[:, 1], du, p / np.maximum(e, 1e-300))
        dv = np.where(free[:, 0], dv, q / np.maximum(g, 1e-300))
        step = np.where(free, np.stack([du, dv], 1), 0.0)
        uv = np.clip(uv + np.clip(step, -limit, limit), low, high)
    return uv


def fit(
    name: str, samples: Samples, ku: FloatArray, kv: FloatArray, smoothing: float, rounds: int = 4
) -> tuple[SplineSurface, Samples, FloatArray]:
    """Fit a surface; give it, the samples with the parameters found, and their distances (k,), m."""
    import attrs

    for turn in range(rounds):
        surface = _solve(name, samples, ku, kv, smoothing * (30.0 if turn < 2 else 1.0))
        samples = attrs.evolve(samples, uv=feet(surface, samples))
    gap = samples.point - values(surface, samples.uv)[0]
    return surface, samples, np.linalg.norm(gap, axis=1)
