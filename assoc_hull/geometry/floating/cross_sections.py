"""Sections of a body by a plane across the ship, anywhere along it.

In a strip of sections the section is one of its curves, exactly. What a raked strip has of it
is traced, which is good to some 1e-7 of the length of a tile.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.floating.immersed import Planes
from assoc_hull.geometry.floating.immersed_sections import sections_below
from assoc_hull.geometry.floating.strip_spans import Spans, level_at
from assoc_hull.geometry.surfaces.isocurves import IsoCurves

__all__ = ["areas_at", "cross_section", "sides_at"]

_ON = 1e-9
"""m: an end of a strip that is so near to the plane lies in it."""


def cross_section(body: Spans, x: float) -> IsoCurves:
    """Give the section of one side of a body by a plane across it.

    Parameters
    ----------
    body : Spans
        The strips, and where they lie.
    x : float, m
        Where the plane stands.

    Returns
    -------
    IsoCurves
        The pieces of the section, each from keel to deck; none where there is no body. What
        they have of `across` is that of strips of sections that run forward by 1 m.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.analysis.hydrostatics.flotation import flotation
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.geometry.floating.cross_sections import cross_section
    >>> from assoc_hull.geometry.floating.immersed import Planes
    >>> from assoc_hull.geometry.floating.immersed_sections import sections_below
    >>> from assoc_hull.geometry.floating.strip_spans import spans
    >>> found = cross_section(spans(flotation(wigley()).prepared), 42.5)
    >>> plane = Planes(np.array([6.25]), np.zeros(1), np.zeros(1))
    >>> round(float(sections_below(found, plane)[0, 0]), 1)  # 2/3 B T (1 - 0.15^2)
    40.7
    """
    met = _met(body, x)
    flat, strips = met[body.flat[met]], body.prepared.strips
    found = [strips.curves(flat, level_at(body, flat, x))]
    found += [body.raked[strip].section(x) for strip in met[~body.flat[met]].tolist()]
    return _joined(found)


def areas_at(body: Spans, x: FloatArray, plane: Planes) -> FloatArray:
    """Give the areas of sections below one floating plane.

    Parameters
    ----------
    body : Spans
        The strips, and where they lie.
    x : (n,), m
        Where; nothing is looked for beyond the ends of the body.
    plane : Planes
        One plane.

    Returns
    -------
    (n,), m2
        Of both sides.
    """
    met = [_met(body, place) for place in x.tolist()]
    flat = np.array([bool(body.flat[strips].all()) for strips in met], np.bool_)
    found = np.zeros(len(x))
    for i in np.flatnonzero(~flat).tolist():
        found[i] = sections_below(cross_section(body, float(x[i])), plane).sum()
    some = np.flatnonzero(flat).tolist()
    owner = np.repeat(some, [len(met[i]) for i in some]).astype(np.int64)
    if len(owner):
        strip, strips = np.concatenate([met[i] for i in some]), body.prepared.strips
        curves = strips.curves(strip, level_at(body, strip, x[owner]))
        found += np.bincount(owner, sections_below(curves, plane)[0], len(x))
    return found


def sides_at(body: Spans, x: float) -> tuple[IntArray, IntArray]:
    """Give the strips that a plane across the ship meets, from aft and from forward of it.

    Within a strip both are the same; at a section they are those on either side.
    """
    long = body.fore > body.aft + _ON
    before = np.flatnonzero(long & (body.aft < x - _ON) & (body.fore >= x - _ON))
    behind = np.flatnonzero(long & (body.aft <= x + _ON) & (body.fore > x + _ON))
    return before, behind


def _met(body: Spans, x: float) -> IntArray:
    """Give the strips that a plane meets; at a section, those of the side without raked ones."""
    before, behind = sides_at(body, x)
    for side in (before, behind):
        if len(side) and body.flat[side].all():
            return side
    return before if len(before) else behind


def _joined(parts: list[IsoCurves]) -> IsoCurves:
    size = np.concatenate([np.diff(part.start) for part in parts])
    start = np.concatenate([[0], np.cumsum(size)])
    point, deck = (
        np.concatenate([getattr(part, name) for part in parts]) for name in ("point", "deck")
    )
    across = np.zeros_like(point)
    across[:, 0, 0] = 1.0
    return IsoCurves(start, point, across, deck)
