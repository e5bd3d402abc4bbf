"""Slices and sections of a body whose strips carry tangents.

A plane across the ship stands at a place v of a strip of sections, x(v) = c. Where the strip
moves, or the plane, v' = (c' - x') / x_v. A strip that ends at the plane is continued by its own
cubics: so what a section between the plane and the end adds counts, as that end moves.

Raked strips are traced and not differentiated: where a plane meets one, nothing is given.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.floating.between_planes import Stretches
from assoc_hull.geometry.floating.cross_sections import sides_at
from assoc_hull.geometry.floating.immersed import Immersed, Planes
from assoc_hull.geometry.floating.immersed_sections import sections_below
from assoc_hull.geometry.floating.immersion import immersed
from assoc_hull.geometry.floating.prepared_strips import prepare
from assoc_hull.geometry.floating.strip_spans import Spans, level_at
from assoc_hull.geometry.numeric.dual import Dual, as_array, real
from assoc_hull.geometry.numeric.generic_sums import nil
from assoc_hull.geometry.surfaces.isocurves import Strips

__all__ = ["area_with_tangents", "slice_with_tangents"]

_ON = 1e-9
"""m: an end of a strip that is so near to a plane lies in it."""


def slice_with_tangents(
    body: Spans, strips: Strips, aft: Any, fore: Any, plane: Planes
) -> Immersed | None:
    """Integrate the slice of a body between two planes across it, with tangents.

    Parameters
    ----------
    body : Spans
        The strips in plain numbers, and where they lie.
    strips : Strips
        The same strips with tangents.
    aft, fore : float, or Dual (), m
        x of the planes, fore the greater; infinite for none.
    plane : Planes
        One floating plane, upright.

    Returns
    -------
    Immersed or None
        The integrals, (1,) each; None where one of the planes meets a raked strip.
    """
    low, high = float(real(aft)), float(real(fore))
    chosen = (body.fore > low + _ON) & (body.aft < high - _ON) & (body.fore > body.aft)
    level = np.flatnonzero(chosen)
    ends = []
    for place, cut, rest in (
        (aft, body.aft[level] < low + _ON, 0.0),
        (fore, body.fore[level] > high - _ON, 1.0),
    ):
        if not body.flat[level[cut]].all():
            return None
        ends.append(_ends(body, strips, level, cut, place, rest))
    plain = (np.clip(real(each), 0.0, 1.0) for each in ends)
    part = Stretches(strips, level, *ends)
    return immersed(prepare(part, plain=Stretches(body.prepared.strips, level, *plain)), plane)


def area_with_tangents(body: Spans, strips: Strips, x: Any, plane: Planes) -> Any:
    """Give the area of a section below a floating plane, both sides, with tangents.

    Parameters
    ----------
    body, strips, plane
        As for `slice_with_tangents`.
    x : float, or Dual (), m
        Where. On a section that is an end of strips, the mean of those on both sides.

    Returns
    -------
    Dual (), m2, or None
        None where a raked strip is met.
    """
    found = [side for side in sides_at(body, float(real(x))) if len(side)]
    flat = [side for side in found if body.flat[side].all()]
    if not flat:
        return None
    areas = [_section(body, strips, side, x, plane) for side in flat]
    return sum(areas[1:], areas[0]) / len(areas)


def _section(body: Spans, strips: Strips, strip: IntArray, x: Any, plane: Planes) -> Any:
    curves = strips.curves(strip, _level(body, strips, strip, x))
    return sections_below(curves, plane).sum()


def _ends(
    body: Spans, strips: Strips, level: IntArray, cut: np.typing.NDArray[np.bool_], place: Any,
    rest: float,
) -> FloatArray:  # fmt: skip
    """Give from or to which v strips count: those that are cut, to the plane."""
    if not cut.any():
        return np.full(len(level), rest)
    at = _level(body, strips, level[cut], place)
    found = nil((len(level),), at) + rest
    found[cut] = at
    return found


def _level(body: Spans, strips: Strips, strip: IntArray, x: Any) -> FloatArray:
    """Give the v at which flat strips (k,) stand at a place, with tangents."""
    v = level_at(body, strip, float(real(x)))
    curves = strips.curves(strip, v)
    first = curves.start[:-1]
    off = curves.point[first, 0, 0] - x
    along = real(curves.across[first, 0, 0])
    return as_array(Dual(v, -off.dot / along)) if isinstance(off, Dual) else v
