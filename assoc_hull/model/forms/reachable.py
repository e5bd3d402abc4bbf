"""Between which values something can be made, found by trying.

Examples
--------
>>> from assoc_hull.model.forms.reachable import reachable
>>> low, high = reachable(lambda x: 1.0 <= x <= 2.0, 0.0, 10.0, 9.0)
>>> round(low, 9), round(high, 9)
(1.0, 2.0)
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

__all__ = ["reachable"]

_PLACES = 129
"""So many values are tried between the ends."""

_HALVINGS = 44


def reachable(
    made: Callable[[float], bool], least: float, most: float, asked: float
) -> tuple[float, float] | None:
    """Give the interval of values that can be made which lies nearest to one that cannot.

    Parameters
    ----------
    made : callable
        Tells whether a value can be made.
    least, most : float
        Outside of these nothing can be made.
    asked : float
        The value that was asked for.

    Returns
    -------
    (float, float) or None
        Its ends, both of which can be made; None if nothing was found.
    """
    places = np.linspace(least, most, _PLACES)[1:-1].tolist()
    good = [made(place) for place in places]
    if not any(good):
        return None
    nearest = min(
        (number for number, fits in enumerate(good) if fits),
        key=lambda number: abs(places[number] - asked),
    )
    low = high = nearest
    while low > 0 and good[low - 1]:
        low -= 1
    while high + 1 < len(good) and good[high + 1]:
        high += 1
    below = places[low - 1] if low else least
    above = places[high + 1] if high + 1 < len(places) else most
    return _edge(made, places[low], below), _edge(made, places[high], above)


def _edge(made: Callable[[float], bool], inside: float, outside: float) -> float:
    """Give the last value that can be made on the way out."""
    for _ in range(_HALVINGS):
        middle = 0.5 * (inside + outside)
        inside, outside = (middle, outside) if made(middle) else (inside, middle)
    return inside
