"""Between which values a curve can be made: what an error tells.

Examples
--------
>>> from assoc_hull.errors import BadInputError
>>> from assoc_hull.model.forms.admissible import admitted
>>> def root(value):
...     if not 2.0 <= value <= 5.0:
...         raise BadInputError("no root", "here", "none")
>>> tuple(round(each, 5) for each in admitted(root, 9.0, 0.0, 10.0))
(2.0, 5.0)
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from assoc_hull.errors import AssocHullError

__all__ = ["admitted"]

_TRIES = 129
"""So many values are tried first; a narrower interval may be missed."""

_HALVINGS = 40


def admitted(
    make: Callable[[float], object], asked: float, low: float, high: float
) -> tuple[float, float] | None:
    """Find the values nearest to one with which something can be made.

    Parameters
    ----------
    make : callable
        Makes it with a value, or raises an error of the package.
    asked : float
        The value with which it cannot be made.
    low, high : float
        Where to look.

    Returns
    -------
    (float, float) or None
        An interval, a trifle within its limits; between them more than a hundredth of what
        was looked at may hide no gap. None where no value was found.
    """
    if not high > low:
        return None
    values = np.linspace(low, high, _TRIES).tolist()
    fits = [_fits(make, value) for value in values]
    chosen = _nearest_run(values, fits, asked)
    if chosen is None:
        return None
    first, last = chosen
    least, most = values[first], values[last]
    if first:
        least = _edge(make, least, values[first - 1])
    if last < _TRIES - 1:
        most = _edge(make, most, values[last + 1])
    return least, most


def _fits(make: Callable[[float], object], value: float) -> bool:
    try:
        make(value)
    except AssocHullError:
        return False
    return True


def _nearest_run(values: list[float], fits: list[bool], asked: float) -> tuple[int, int] | None:
    """Give first and last of the neighbours that fit, nearest to what was asked for."""
    good = [number for number, fit in enumerate(fits) if fit]
    if not good:
        return None
    first = last = min(good, key=lambda number: abs(values[number] - asked))
    while first and fits[first - 1]:
        first -= 1
    while last < len(fits) - 1 and fits[last + 1]:
        last += 1
    return first, last


def _edge(make: Callable[[float], object], good: float, bad: float) -> float:
    """Give the last value that fits, on the way to one that does not."""
    width = abs(bad - good)
    for _ in range(_HALVINGS):
        middle = 0.5 * (good + bad)
        if _fits(make, middle):
            good = middle
        else:
            bad = middle
    # Printed with eight digits it is to fit still.
    return good - math.copysign(1e-6 * width, bad - good)
