"""Biarcs: a batch against one at a time, against a search for each join, and growth.

The peer finds the direction of the join at which R1 - R2 is smallest by
`scipy.optimize.minimize_scalar`, from the radii of the family. It is what one would write without
the closed form, and it finds the same joins to 1e-6 rad.
"""

from __future__ import annotations

import numpy as np
from scipy.optimize import minimize_scalar

from assoc_hull.geometry.classical.biarc_chain import biarc_chain
from assoc_hull.geometry.classical.biarc_family import one_bend_radii
from assoc_hull.geometry.classical.biarcs import biarcs
from assoc_hull.geometry.curves import FloatArray
from benchmarks.clock import Figure, side_by_side

__all__ = ["figures"]

COUNT = 10_000
PEER = 20

Given = tuple[FloatArray, FloatArray, FloatArray, FloatArray]


def given(count: int) -> Given:
    """Give intervals with one bend over chords of 1, whose rule needs no fallback."""
    rng = np.random.default_rng(1)
    a = rng.uniform(0.1, 1.0, count)
    b = a * rng.uniform(0.4, 2.4, count)
    return np.zeros((count, 2)), a, np.tile([1.0, 0.0], (count, 1)), -np.minimum(b, 1.5)


def one_by_one(every: Given, count: int) -> list[object]:
    """Make biarcs with a call for each."""
    return [biarcs(*(each[row : row + 1] for each in every)) for row in range(count)]


def searched(every: Given, count: int) -> list[float]:
    """Give the join direction of each by a search."""
    found = list[float]()
    for row in range(count):
        a, b, chord = every[1][row : row + 1], -every[3][row : row + 1], np.ones(1)
        least = float(min(a[0], b[0]))

        def jump(tau: float, a: FloatArray = a, b: FloatArray = b, p: FloatArray = chord) -> float:
            first, second = one_bend_radii(p, a, b, np.array([tau]))
            return float(abs(first[0] - second[0]))

        bounds = (-0.999 * least, 0.999 * least)
        found.append(float(minimize_scalar(jump, bounds=bounds, options={"xatol": 1e-9}).x))
    return found


def wave(count: int) -> FloatArray:
    """Give points of a sine."""
    x = np.linspace(0.0, 3.0, count)
    return np.stack([x, np.sin(x)], axis=1)


def figures(quick: bool = False) -> list[Figure]:
    """Measure."""
    every = given(COUNT)
    half: Given = (every[0][::2], every[1][::2], every[2][::2], every[3][::2])
    few = biarcs(*(each[:PEER] for each in every)).tau
    assert np.abs(np.array(searched(every, PEER)) - few).max() < 1e-6
    rounds = 5 if quick else 25
    found = side_by_side(
        {
            "batch": lambda: biarcs(*every),
            "half": lambda: biarcs(*half),
            "one": lambda: one_by_one(every, PEER),
            "peer": lambda: searched(every, PEER),
            "chain": lambda: biarc_chain(wave(2001)),
            "half chain": lambda: biarc_chain(wave(1001)),
        },
        rounds,
    )
    one, peer = found["one"] / PEER, found["peer"] / PEER
    return [
        Figure("one biarc alone", 1e6 * one, "us"),
        Figure("the same in a batch of 10,000", 1e6 * found["batch"] / COUNT, "us"),
        Figure("10,000 one at a time / in a batch", COUNT * one / found["batch"], "x", 100.0),
        Figure("a search by scipy / one alone", peer / one),
        Figure("a search by scipy / in a batch", COUNT * peer / found["batch"], "x", 100.0),
        Figure("10,000 biarcs / 5,000 biarcs", found["batch"] / found["half"], "x", 2.5, "most"),
        Figure("a chain through 2,001 points", 1e3 * found["chain"], "ms"),
        Figure("the same / through 1,001", found["chain"] / found["half chain"], "x", 2.5, "most"),
    ]
