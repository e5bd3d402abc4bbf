"""Arcs for production: how many, beside optima over break points, and how fast they are found.

The optima are those of `tests/arc_optimum.py`: dynamic programming over eight break points a cubic,
of biarcs that keep the tangents of the curve, and of single arcs in any direction. The peer of
the search makes one biarc after the other, each by halving its reach, one candidate at a time.
With `ASSOC_HULL_DATA` naming the data folder, three waterlines of the DTC; else of Series 60.
"""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np

from assoc_hull.geometry.classical.arc_fit import fit_arcs
from assoc_hull.geometry.curves import CurveData, FloatArray
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.segments import power_coefficients
from assoc_hull.hull import Hull
from assoc_hull.hull.sources import examples
from assoc_hull.model.objects import Line
from benchmarks.clock import Figure, side_by_side
from tests.arc_optimum import PlaneCurve, fewest_exact, fewest_tilted, fits_one
from tests.cases.dtc import read_dtc_with_report

__all__ = ["figures"]

WITHIN = 0.0005


def ship() -> tuple[Hull, tuple[str, ...]]:
    """Give a hull and three smooth waterlines of it."""
    folder = os.environ.get("ASSOC_HULL_DATA")
    if folder is None:
        return examples.series60(0.70), ("WL 0.25", "WL 0.5", "WL 1")
    return read_dtc_with_report(Path(folder))[0], ("WL 0.85", "WL 17.85", "WL 33.15")


def cubics(line: Line) -> FloatArray:
    """Give the cubics of a waterline in its plane."""
    return np.ascontiguousarray(power_coefficients(line.curves[0].spline)[:, :, :2])


def naive(curve: PlaneCurve) -> int:
    """Count the arcs of biarcs that each reach as far as they can, one candidate at a time."""
    at, last, arcs = 0, len(curve.breaks) - 1, 0
    while at < last:
        low, high = at + 1, last
        while low < high:
            middle = (low + high + 1) // 2
            low, high = (middle, high) if fits_one(curve, at, middle, WITHIN) else (low, middle - 1)
        at, arcs = low, arcs + 2
    return arcs


def wave(count: int) -> FloatArray:
    """Give the cubics of a curve of so many waves, eight points each."""
    x = np.linspace(0.0, 6.0 * count, 8 * count + 1)
    return power_coefficients(
        loft(CurveData.single(np.stack([x, 0.3 * np.sin(x), 0.0 * x], axis=1)))
    )[:, :, :2]


def counts(hull: Hull, names: tuple[str, ...]) -> list[Figure]:
    """Count arcs line by line."""
    found = []
    for name in names:
        line = hull.lines[name]
        ours = hull.production_arcs(name, WITHIN)
        curve = PlaneCurve(cubics(line), 8, 6)
        exact = fewest_exact(curve, WITHIN)
        tilted = fewest_tilted(curve, WITHIN, 0.01, 60)
        found += [
            Figure(f"{name}: arcs", ours.count, ""),
            Figure(f"{name}: least with the tangents of the curve, over break points", exact, ""),
            Figure(f"{name}: least in any direction, over break points", tilted, ""),
            Figure(f"{name}: arcs with a biarc between net points", ours.one_per_interval, ""),
            Figure(
                f"{name}: ours / least with the tangents", ours.count / exact, "x", 1.25, "most"
            ),
            Figure(
                f"{name}: ours / least in any direction", ours.count / tilted, "x", 1.25, "most"
            ),
        ]
    return found


def figures(quick: bool = False) -> list[Figure]:
    """Measure."""
    hull, names = ship()
    found = counts(hull, names[:1] if quick else names)
    whole = hull.production_arcs("waterlines", WITHIN)
    found += [
        Figure("all waterlines: arcs", whole.count, ""),
        Figure(
            "all waterlines: ours / a biarc between net points",
            whole.count / whole.one_per_interval, "x", 0.5, "most",
        ),
    ]  # fmt: skip
    own = cubics(hull.lines[names[1]])
    curve, one = PlaneCurve(own, 8, 6), np.array([0, len(own)])
    long, short = wave(80), wave(40)
    many = np.concatenate([short] * 16)
    sixteen = np.arange(17) * len(short)
    times = side_by_side(
        {
            "all": lambda: hull.production_arcs(None, WITHIN),
            "one": lambda: fit_arcs(own, one, WITHIN),
            "naive": lambda: naive(curve),
            "long": lambda: fit_arcs(long, np.array([0, len(long)]), WITHIN),
            "short": lambda: fit_arcs(short, np.array([0, len(short)]), WITHIN),
            "sixteen": lambda: fit_arcs(many, sixteen, WITHIN),
        },
        2 if quick else 5,
    )
    return [
        *found,
        Figure("all lines of the hull", times["all"], "s"),
        Figure(f"{names[1]}: arcs by one candidate at a time", naive(curve), ""),
        Figure(f"{names[1]}: time of that / ours alone", times["naive"] / times["one"]),
        Figure("16 curves one by one / in a batch", 16 * times["short"] / times["sixteen"]),
        Figure("640 points / 320 points", times["long"] / times["short"], "x", 2.5, "most"),
    ]
