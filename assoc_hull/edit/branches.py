"""Which meeting is which while a plane moves: large shifts are taken in sub-steps.

Between two positions of a plane the meetings of a curve are paired only if their number
and signs agree, or exactly one adjacent pair has come or gone; else the step is halved.
Ordinals along the curve were measured to be wrong at every birth and death.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.crossing import meet_planes
from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.model.align import align_roots

__all__ = ["track"]

_LEAST = 1e-4
"""Steps shorter than this (m) are taken as they are."""


@attrs.frozen(eq=False)
class _Roots:
    sign: np.typing.NDArray[np.int8]
    xyz: FloatArray


def track(
    spline: SplineBatch, normal: FloatArray, start: float, stop: float, step: float = 0.1
) -> dict[int, int]:
    """Follow the meetings of a curve with a plane that is shifted along its normal.

    Parameters
    ----------
    spline : SplineBatch
        One curve.
    normal : (3,)
        Unit normal of the plane.
    start, stop : float, m
        Offsets of the plane.
    step : float, m
        Longest step.

    Returns
    -------
    dict of int to int
        For a meeting at the start, counted along the curve, the meeting at the stop that it
        becomes; one that has gone on the way is missing.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.edit.branches import track
    >>> from assoc_hull.geometry.curves import CurveData
    >>> from assoc_hull.geometry.spline import loft
    >>> hill = np.array([[0.0, 0, 0], [1, 0, 2], [2, 0, 1], [3, 0, 3]])
    >>> curve = loft(CurveData.single(hill))
    >>> track(curve, np.array([0.0, 0, 1]), 1.5, 2.6)
    {2: 0}
    """
    count = max(1, int(np.ceil(abs(stop - start) / step)))
    places = np.linspace(start, stop, count + 1)
    roots = _roots(spline, normal, places)
    path = {i: i for i in range(len(roots[0].sign))}
    for i in range(count):
        link = _link(spline, normal, (places[i], roots[i]), (places[i + 1], roots[i + 1]))
        path = {first: link[here] for first, here in path.items() if here in link}
    return path


def _roots(spline: SplineBatch, normal: FloatArray, places: FloatArray) -> list[_Roots]:
    order = np.argsort(places, kind="stable")
    met = meet_planes(spline, normal, places[order])
    found: list[_Roots] = [_Roots(met.sign[:0], met.xyz[:0])] * len(places)
    for rank, place in enumerate(order.tolist()):
        mine = met.plane == rank
        found[place] = _Roots(met.sign[mine], met.xyz[mine])
    return found


def _link(
    spline: SplineBatch,
    normal: FloatArray,
    before: tuple[float, _Roots],
    after: tuple[float, _Roots],
) -> dict[int, int]:
    """Pair the meetings of two positions, halving the step while that is ambiguous."""
    (low, old), (high, new) = before, after
    change = abs(len(old.sign) - len(new.sign))
    plain = np.array_equal(old.sign, new.sign) or change in (1, 2)
    if plain or abs(high - low) <= _LEAST:
        return dict(align_roots(old.sign, old.xyz, new.sign, new.xyz))
    middle = 0.5 * (low + high)
    between = middle, _roots(spline, normal, np.array([middle]))[0]
    first = _link(spline, normal, before, between)
    second = _link(spline, normal, between, after)
    return {i: second[j] for i, j in first.items() if j in second}
