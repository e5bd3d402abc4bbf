"""`bracketed_roots` of `polynomials`, compiled: same operations in the same order, same bits.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.numeric.compiled_roots import find_roots
>>> line = np.array([[-0.5], [1.0], [0.0], [0.0], [0.0], [1.0], [-0.5], [0.5]])
>>> find_roots(line, 3, 1e-14, 1e-15, 200)
array([0.5])
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.numeric.jit import jit

__all__ = ["find_roots", "safe_root"]


@jit
def _value(origin: float, first: float, second: float, third: float, u: float) -> float:
    """Evaluate a cubic by Horner's rule."""
    return ((third * u + second) * u + first) * u + origin


@jit
def safe_root(
    origin: float,
    first: float,
    second: float,
    third: float,
    lower: float,
    upper: float,
    rising: bool,
    limit: float,
    most_trials: int,
) -> float:
    """Find a root by Newton's rule, every third trial and whenever it fails by bisection."""
    root = 0.5 * (lower + upper)
    for trial in range(most_trials):
        height = _value(origin, first, second, third, root)
        if (height >= 0.0) == rising:
            upper = root
        else:
            lower = root
        middle = 0.5 * (lower + upper)
        if not (abs(height) > limit and lower < middle < upper):
            break
        slope = first + root * (2.0 * second + root * (3.0 * third))
        newton = root - height / slope
        root = newton if lower < newton < upper and trial % 3 != 2 else middle
    return root


@jit
def _set_roots(
    cubics: FloatArray, steps: int, floor: float, relative: float, roots: FloatArray
) -> None:
    """Take the fixed steps of `roots`; NaN where they do not reach the root.

    No decision and no call stands in these loops: they become vector instructions.
    """
    for m in range(len(roots)):
        share = cubics[6, m] / (cubics[6, m] - cubics[7, m])
        roots[m] = cubics[4, m] + (cubics[5, m] - cubics[4, m]) * share
    for _ in range(steps):
        for m in range(len(roots)):
            u, second, third = roots[m], cubics[2, m], cubics[3, m]
            height = ((third * u + second) * u + cubics[1, m]) * u + cubics[0, m]
            bend = 3.0 * third * u + second
            slope = (bend + second) * u + cubics[1, m]
            roots[m] = u - (height * slope) / (slope * slope - bend * height)
    for m in range(len(roots)):
        u = roots[m]
        height = ((cubics[3, m] * u + cubics[2, m]) * u + cubics[1, m]) * u + cubics[0, m]
        limit = floor + relative * (abs(cubics[6, m]) + abs(cubics[7, m]))
        good = (abs(height) <= limit) & (u >= cubics[4, m]) & (u <= cubics[5, m])
        roots[m] = u if good else np.nan


@jit
def _mend_roots(
    cubics: FloatArray, floor: float, relative: float, most_trials: int, roots: FloatArray
) -> None:
    """Find the roots that are missing still, and those at the ends of their brackets."""
    for m in range(len(roots)):
        lower, upper, at_lower, at_upper = cubics[4, m], cubics[5, m], cubics[6, m], cubics[7, m]
        if at_upper == 0.0:
            roots[m] = upper
        elif at_lower == 0.0:
            roots[m] = lower
        elif np.isnan(roots[m]):
            limit = floor + relative * (abs(at_lower) + abs(at_upper))
            roots[m] = safe_root(
                cubics[0, m], cubics[1, m], cubics[2, m], cubics[3, m],
                lower, upper, at_lower < 0.0, limit, most_trials,
            )  # fmt: skip


@jit
def find_roots(
    cubics: FloatArray, steps: int, floor: float, relative: float, most_trials: int
) -> FloatArray:
    """Find the root of each cubic: rows as `compiled_intersections.meet_curves` gives them."""
    roots = np.empty(cubics.shape[1])
    _set_roots(cubics, steps, floor, relative, roots)
    _mend_roots(cubics, floor, relative, most_trials, roots)
    return roots
