"""Form-parameter curves: a batch against one at a time, and against a solver of all vertices.

The peer finds the 14 coordinates of the vertices by `scipy.optimize.fsolve` from the 14 equations
of the parameters, area and moment by eight Gauss points a segment, from the vertices of the
straight line. It is what one would write without the closed form of the middle vertex.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.polynomial.legendre import leggauss
from scipy.optimize import fsolve

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.chain import straight_vertices
from assoc_hull.geometry.form_curves.curve import FormEnd, form_vertices
from assoc_hull.geometry.form_curves.shape import fairest_tangents
from benchmarks.clock import Figure, side_by_side

__all__ = ["figures"]

COUNT = 1000
_FIELDS = ("x", "y", "angle", "curvature", "tangent", "stretch")

Curves = tuple[FormEnd, FormEnd, FloatArray, FloatArray]


def curves(count: int) -> Curves:
    """Give rising curves near a published one, all of which can be made."""
    rng = np.random.default_rng(1)
    turn = np.radians(60.0) + rng.uniform(-0.05, 0.05, count)
    pace = 0.15 + rng.uniform(-0.02, 0.02, count)
    start = FormEnd.of(-1.0, 0.0, turn, -2.0, pace)
    finish = FormEnd.of(-0.3 + rng.uniform(-0.02, 0.02, count), 1.0, 0.0, 0.0, pace)
    return start, finish, np.full(count, 0.55), np.full(count, -0.59)


def part(given: Curves, rows: slice) -> Curves:
    """Give some of them."""
    start, finish = (FormEnd(*(getattr(e, name)[rows] for name in _FIELDS)) for e in given[:2])
    return start, finish, given[2][rows], given[3][rows]


_T = (np.arange(4.0)[:, None] + 0.5 * (leggauss(8)[0] + 1.0)).ravel()
_WEIGHT = np.tile(0.5 * leggauss(8)[1], 4)


def _basis() -> tuple[FloatArray, FloatArray]:
    """Give the basis functions and their slopes at the Gauss points, (32, 7) each."""
    value, slope = np.zeros((2, len(_T), 7))
    for row, t in enumerate(_T.tolist()):
        s = int(t)
        u = t - s
        value[row, s : s + 4] = (
            np.array(
                [(1 - u) ** 3, 3 * u**3 - 6 * u * u + 4, 1 + 3 * u + 3 * u * u - 3 * u**3, u**3]
            )
            / 6.0
        )
        slope[row, s : s + 4] = (
            np.array([-((1 - u) ** 2), 3 * u * u - 4 * u, 1 + 2 * u - 3 * u * u, u * u]) / 2.0
        )
    return value, slope


_VALUE, _SLOPE = _basis()


def peer(given: Curves) -> FloatArray:
    """Solve for all vertices of one curve at once."""
    (start, finish), area, centroid = given[:2], given[2][0], given[3][0]
    want = list[float]()
    for end in (start, finish):
        cos, sin, d = math.cos(end.angle[0]), math.sin(end.angle[0]), end.tangent[0]
        bend = d * d * end.curvature[0]
        want += [end.x[0], end.y[0], d * cos, d * sin, -bend * sin, bend * cos]
    want += [area, area * centroid]

    def lack(flat: FloatArray) -> list[float]:
        p = flat.reshape(7, 2)
        found = list[float]()
        for a, b, c in (p[:3], p[4:]):
            found += [*(a + 4 * b + c) / 6, *(c - a) / 2, *(a - 2 * b + c)]
        x, y = (_VALUE @ p).T
        under = _WEIGHT * y * (_SLOPE @ p[:, 0])
        found += [float(under.sum()), float((under * x).sum())]
        return [got - each for got, each in zip(found, want, strict=True)]

    begin = straight_vertices((start.x[0], start.y[0]), (finish.x[0], finish.y[0]))
    return np.asarray(fsolve(lack, begin.ravel(), xtol=1e-12)).reshape(7, 2)


def figures(quick: bool = False) -> list[Figure]:
    """Measure."""
    every = curves(COUNT)
    one, few = part(every, slice(0, 1)), part(every, slice(0, 10))
    assert np.abs(peer(one) - form_vertices(*one)[0]).max() < 1e-9
    rounds = 5 if quick else 25
    found = side_by_side(
        {
            "batch": lambda: form_vertices(*every),
            "ten": lambda: form_vertices(*few),
            "one": lambda: form_vertices(*one),
            "peer": lambda: peer(one),
            "half": lambda: form_vertices(*part(every, slice(0, COUNT // 2))),
        },
        rounds, {"one": 20, "ten": 20, "peer": 5},
    )  # fmt: skip
    fair = side_by_side(
        {
            "all": lambda: fairest_tangents(*few),
            "each": lambda: [fairest_tangents(*part(few, slice(k, k + 1))) for k in range(10)],
        },
        max(2, rounds // 5),
    )
    return [
        Figure("one form-parameter curve alone", 1e6 * found["one"], "us"),
        Figure("the same in a batch of 1,000", 1e6 * found["batch"] / COUNT, "us"),
        Figure(
            "1,000 one at a time / in a batch", COUNT * found["one"] / found["batch"], "x", 10.0
        ),
        Figure(
            "all 14 equations by scipy / one curve alone", found["peer"] / found["one"], "x", 2.0
        ),
        Figure(
            "all 14 equations by scipy / in a batch",
            COUNT * found["peer"] / found["batch"],
            "x",
            50.0,
        ),
        Figure("1,000 curves / 500 curves", found["batch"] / found["half"], "x", 2.5, "most"),
        Figure("tangents of ten fairest curves, together", 1e3 * fair["all"], "ms"),
        Figure("the same, one at a time / together", fair["each"] / fair["all"], "x"),
    ]
