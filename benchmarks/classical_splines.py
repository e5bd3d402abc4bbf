"""Classical splines against their plain peers, in batches, and fairness of a whole net at once."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import CubicSpline

import assoc_hull as ah
from assoc_hull.fairing.line_fairness import hull_fairness
from assoc_hull.geometry.classical.chord_spline import ChordSpline, chord_splines
from assoc_hull.geometry.classical.elastica import FREE_MODULUS, fit_amplitudes, fit_elastica
from assoc_hull.geometry.curves import FloatArray
from benchmarks.clock import Figure, side_by_side

__all__ = ["figures"]

COUNT, POINTS = 200, 20


def battens(count: int, points: int) -> list[FloatArray]:
    """Give rising curves that a graph y(x) can follow, too."""
    rng = np.random.default_rng(2)
    x = np.cumsum(rng.uniform(0.5, 1.5, (count, points)), axis=1)
    y = np.sin(0.2 * x) + 0.05 * rng.uniform(size=x.shape)
    return list(np.stack([x, y], axis=2))


def figures(quick: bool = False) -> list[Figure]:
    """Measure."""
    return [*_splines(5 if quick else 25), *_rods(3 if quick else 15), *_net(3 if quick else 15)]


def _splines(rounds: int) -> list[Figure]:
    every, long = battens(COUNT, POINTS), battens(1, COUNT * POINTS)[0]
    one = every[0]
    found = side_by_side(
        {
            "batch": lambda: chord_splines(every),
            "half": lambda: chord_splines(every[: COUNT // 2]),
            "one": lambda: ChordSpline.through(one),
            "graph": lambda: CubicSpline(*one.T, bc_type="natural"),
            "long": lambda: ChordSpline.through(long),
            "short": lambda: ChordSpline.through(long[: COUNT * POINTS // 2]),
        },
        rounds, {"one": 20, "graph": 20},
    )  # fmt: skip
    return [
        Figure(f"mechanical spline through {POINTS} points, alone", 1e6 * found["one"], "us"),
        Figure("the same / scipy's CubicSpline y(x)", found["one"] / found["graph"]),
        Figure(
            f"{COUNT} one at a time / in a batch", COUNT * found["one"] / found["batch"], "x", 3
        ),
        Figure(f"{COUNT} splines / half of them", found["batch"] / found["half"], "x", 2.5, "most"),
        Figure(
            f"{COUNT * POINTS} points / half of them", found["long"] / found["short"], "x", 2.5,
            "most",
        ),
    ]  # fmt: skip


def _rods(rounds: int) -> list[Figure]:
    alpha, beta = np.random.default_rng(3).uniform(-1.0, 1.0, (2, 2000))
    found = side_by_side(
        {
            "batch": lambda: fit_amplitudes(alpha, beta, FREE_MODULUS),
            "half": lambda: fit_amplitudes(alpha[:1000], beta[:1000], FREE_MODULUS),
            "one": lambda: fit_elastica([0, 0], [1, 0], 0.5, -0.3),
            "length": lambda: fit_elastica([0, 0], [1, 0], 0.5, -0.3, length=1.03),
            "chord": lambda: ChordSpline.through([(0, 0), (1, 0)], 0.5, -0.3),
        },
        rounds, {"one": 5, "chord": 10},
    )  # fmt: skip
    return [
        Figure("one elastica of free length", 1e3 * found["one"], "ms"),
        Figure("the same / a mechanical spline on its chord", found["one"] / found["chord"]),
        Figure("elastica of given length / of free length", found["length"] / found["one"]),
        Figure(
            "2,000 elastica one at a time / in a batch", 2000 * found["one"] / found["batch"], "x",
            20,
        ),
        Figure("2,000 elastica / 1,000", found["batch"] / found["half"], "x", 2.5, "most"),
    ]  # fmt: skip


def _net(rounds: int) -> list[Figure]:
    hull = ah.examples.series60(cb=0.7)
    lines = list(hull.lines.values())
    curves = sum(len(line.curves) for line in lines)
    found = side_by_side(
        {
            "net": lambda: hull_fairness(hull),
            "each": lambda: [hull_fairness(line) for line in lines],
        },
        rounds,
    )
    return [
        Figure(f"fairness of a net of {curves} curves", 1e3 * found["net"], "ms"),
        Figure("line by line / in one batch", found["each"] / found["net"], "x", 3),
    ]
