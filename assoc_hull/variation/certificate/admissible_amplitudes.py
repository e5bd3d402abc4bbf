"""How far an amplitude may go before a layer folds."""

from __future__ import annotations

import math
from collections.abc import Callable

from numpy.typing import ArrayLike

from assoc_hull.arguments import number, positive
from assoc_hull.errors import BadInputError
from assoc_hull.variation.certificate.fold_check import MARGIN, certify
from assoc_hull.variation.fields.layers import Layer
from assoc_hull.variation.fields.space_map import VariationMap

__all__ = ["admissible_amplitudes"]

_ROUNDS = 60
_NEAR = 1e-9
"""An end is known to so much of itself,"""

_UNSURE = 1e-7
"""or the least minor there is the margin to twice so much: nearer, bounds leave it undecided."""

_LARGE = 16.0
"""Steps grow so much at most."""

_FARTHEST = _LARGE**6
"""So many first changes away nothing is taken to fold."""

_FLAT = 1e-9


def admissible_amplitudes(
    layer_of: Callable[[float], VariationMap | Layer], box: ArrayLike, *, present: float = 0.0,
    first: float = 1.0, least: float = MARGIN,
) -> tuple[float, float]:  # fmt: skip
    """Give the least and the greatest amplitude that are certified.

    Parameters
    ----------
    layer_of : callable
        Gives the layer, or map, of an amplitude. One that it refuses (BadInputError) counts as
        one that folds.
    box : (2, 3), m
        Least and greatest coordinates.
    present : float
        The amplitude at which nothing moves.
    first : float
        A usual change of it, above nil.
    least : float
        What minors must reach.

    Returns
    -------
    low, high : float
        Both certified themselves; infinite where nothing ever folds.

    Examples
    --------
    >>> from assoc_hull.variation.certificate.admissible_amplitudes import admissible_amplitudes
    >>> from assoc_hull.variation.fields.bounded_functions import BlendChain
    >>> from assoc_hull.variation.fields.layers import FieldLayer
    >>> from assoc_hull.variation.fields.anchor_fields import hat_field
    >>> fade = BlendChain.through([6, 66], [1, 0])
    >>> def shaft(rise):
    ...     anchors = [("base", 0, 0), ("shaft", 5, rise), ("T", 18, 0)]
    ...     return FieldLayer("local", (hat_field("shaft", anchors, fade),))
    >>> low, high = admissible_amplitudes(shaft, [[0, -25, -1], [300, 25, 27]])
    >>> round(low, 3), round(high, 3)
    (-3.83, 7.601)
    """
    number(present, "present", "in admissible")
    step = positive(first, "first", "in admissible")

    def spare(amplitude: float) -> float:
        """Give by how much the least minor lies above the margin; it falls with the amplitude."""
        try:
            found = certify(layer_of(amplitude), box, least)
        except BadInputError:
            return -math.inf
        return found.least - least if found.certified else min(found.least - least, -_UNSURE)

    return _end(spare, present, -step), _end(spare, present, step)


def _end(spare: Callable[[float], float], present: float, step: float) -> float:
    """Find the last amplitude in one sense that leaves something to spare.

    Where minors are linear in the amplitude, the secant meets the end at once.
    """
    held, room = present, spare(present)
    if room < 0.0:
        return present
    failed, lack = present + step, spare(present + step)
    while lack >= 0.0:
        if abs(failed - present) > _FARTHEST * abs(step):
            return math.copysign(math.inf, step)
        beyond = _beyond(failed - held, room, lack)
        held, room = failed, lack
        failed, lack = held + beyond, spare(held + beyond)
    for rounds in range(_ROUNDS):
        if abs(failed - held) <= _NEAR * abs(failed - present) or room <= 2.0 * _UNSURE:
            break
        tried = _between(held, room, failed, lack, halve=rounds % 3 == 2)
        value = spare(tried)
        if value >= 0.0:
            held, room = tried, value
        else:
            failed, lack = tried, value
    return held


def _beyond(step: float, before: float, after: float) -> float:
    """Give a step at whose end nothing will be left, if what is left goes on falling as it did.

    It is no shorter than the last: what falls ever slower, as a square does, is met all the same.
    """
    falls = before - after
    if not falls > _FLAT * before:
        return _LARGE * step
    return min(max(after / falls * (1.0 + 1e-9) + 1e-9, 1.0), _LARGE) * step


def _between(held: float, room: float, failed: float, lack: float, *, halve: bool) -> float:
    """Give where the secant is nil, a little to the safe side; now and then the middle."""
    part = 0.5 if halve or math.isinf(lack) else room / (room - lack) * (1.0 - 1e-10)
    return held + part * (failed - held)
