"""Sections of a body across the ship, and their areas and moments below floating planes.

`sections_below` takes curves as they are, one area each. `cross_section` and `areas_at` cut a body
by a plane anywhere along it: exactly in a strip of sections, to some 1e-7 of the length of a tile
in a raked one.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, IsoCurves, freeze
from assoc_hull.geometry.floating.immersion import FloatingPlanes, integrate_curves
from assoc_hull.geometry.floating.raked_strips import StripSpans, strip_parameters_at
from assoc_hull.geometry.floating.tiles import CurveTiles, tiles_of_curves, tiles_subset
from assoc_hull.geometry.numeric.dual import is_plain

__all__ = [
    "areas_at",
    "cross_section",
    "sections_and_moments_below",
    "sections_below",
    "strips_at",
]

# --------------------------------------------------------------------------------------
# Areas of single curves below planes, and their moments.

_AREA, _MOMENT = 0, 3
"""Among the columns of a strip: volume and its moment about the base line."""

_MOST = 20_000
"""So many tiles are looked at together, which bounds the memory."""


def sections_below(curves: IsoCurves, planes: FloatingPlanes) -> FloatArray:
    """Give the area that each of k curves and its mirror image enclose below each of d planes.

    The curves lie in planes x = const; their `across` does not matter. The areas, (d, k), m2, are
    those in the plane of the section.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.floating.immersion import FloatingPlanes
    >>> from assoc_hull.geometry.floating.sections import sections_below
    >>> from assoc_hull.geometry.curves import IsoCurves
    >>> wedge = np.zeros((1, 4, 3))
    >>> wedge[0, 1] = [0.0, 2.0, 3.0]  # 3 m deep, 2 m wide at either side
    >>> curves = IsoCurves(np.array([0, 1]), wedge, np.zeros((1, 4, 3)), np.array([False]))
    >>> planes = FloatingPlanes(np.array([1.5]), np.zeros(1), np.zeros(1))
    >>> sections_below(curves, planes).round(12).tolist()
    [[1.5]]
    """
    return sections_and_moments_below(curves, planes)[0]


def sections_and_moments_below(
    curves: IsoCurves, planes: FloatingPlanes
) -> tuple[FloatArray, FloatArray]:
    """Give areas as `sections_below` does, and their moments about the base line (of z dA).

    Areas (d, k), m2, and moments (d, k), m3, of both sides.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.floating.immersion import FloatingPlanes
    >>> from assoc_hull.geometry.floating.sections import sections_and_moments_below
    >>> from assoc_hull.geometry.curves import IsoCurves
    >>> wedge = np.zeros((1, 4, 3))
    >>> wedge[0, 1] = [0.0, 2.0, 3.0]  # 3 m deep, 2 m wide at either side
    >>> curves = IsoCurves(np.array([0, 1]), wedge, np.zeros((1, 4, 3)), np.array([False]))
    >>> planes = FloatingPlanes(np.array([1.5]), np.zeros(1), np.zeros(1))
    >>> sections_and_moments_below(curves, planes)[1].round(12).tolist()  # 1.5 m2 at z = 1 m
    [[1.5]]
    """
    forward = np.zeros_like(curves.across)
    forward[:, 0, 0] = 1.0
    tiles = tiles_of_curves(attrs.evolve(curves, across=forward))
    runs = _runs(planes, max(1, _MOST // max(len(tiles.curve), 1)))
    several = [_several(tiles, planes, rows) for rows in runs]
    area = np.concatenate([each[0] for each in several])
    moment = np.concatenate([each[1] for each in several])
    freeze(area, moment)
    return area, moment


def _runs(planes: FloatingPlanes, most: int) -> list[IntArray]:
    """Part planes into runs of one inclination, of `most` at the utmost."""
    count = len(planes.height)
    inclined = planes.tan_trim, planes.tan_heel
    if not all(map(is_plain, inclined)):
        # The derivatives that inclinations carry along may be different ones.
        return [np.array([row]) for row in range(count)]
    new = np.zeros(count, np.bool_)
    new[1:] = (np.diff(inclined[0]) != 0.0) | (np.diff(inclined[1]) != 0.0)
    parts = np.split(np.arange(count), np.flatnonzero(new))
    return [part[i : i + most] for part in parts for i in range(0, len(part), most)]


def _several(
    tiles: CurveTiles, planes: FloatingPlanes, rows: IntArray
) -> tuple[FloatArray, FloatArray]:
    """Take each curve as a strip of its own: what it has per metre; (r, k) each."""
    count = tiles.curves
    many = tiles if len(rows) == 1 else tiles_subset(tiles, np.tile(np.arange(count), len(rows)))
    level = np.repeat(planes.height[rows], count)
    trim, heel = planes.tan_trim[rows[:1]], planes.tan_heel[rows[:1]]
    port = integrate_curves(many, level, trim, heel)
    upright = is_plain(heel) and heel[0] == 0.0
    starboard = port if upright else integrate_curves(many, level, trim, -heel)
    shape = len(rows), count
    area, moment = (port[i] + starboard[i] for i in (_AREA, _MOMENT))
    return area.reshape(shape), moment.reshape(shape)


# --------------------------------------------------------------------------------------
# Sections of a body by a plane across the ship, anywhere along it.

_ON = 1e-9
"""m: an end of a strip that is so near to the plane lies in it."""


def cross_section(body: StripSpans, x: float) -> IsoCurves:
    """Give the section of one side of a body by a plane across it at x (m).

    Pieces come each from keel to deck; none where there is no body. Their `across` is that of
    strips of sections that run forward by 1 m.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.analysis.hydrostatics.flotation import flotation
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.geometry.floating.sections import cross_section
    >>> from assoc_hull.geometry.floating.immersion import FloatingPlanes
    >>> from assoc_hull.geometry.floating.sections import sections_below
    >>> from assoc_hull.geometry.floating.raked_strips import strip_spans
    >>> found = cross_section(strip_spans(flotation(wigley()).prepared), 42.5)
    >>> plane = FloatingPlanes(np.array([6.25]), np.zeros(1), np.zeros(1))
    >>> round(float(sections_below(found, plane)[0, 0]), 1)  # 2/3 B T (1 - 0.15^2)
    40.7
    """
    cut_strips = _strips_of_section(body, x)
    flat, strips = cut_strips[body.flat[cut_strips]], body.prepared.strips
    found = [strips.curves(flat, strip_parameters_at(body, flat, x))]
    found += [body.raked[strip].section(x) for strip in cut_strips[~body.flat[cut_strips]].tolist()]
    return _joined(found)


def areas_at(body: StripSpans, x: FloatArray, plane: FloatingPlanes) -> FloatArray:
    """Give the areas of sections at x (n,), m, below one floating plane: (n,), m2, of both sides.

    Nothing is looked for beyond the ends of the body.
    """
    cut_strips = [_strips_of_section(body, place) for place in x.tolist()]
    flat = np.array([bool(body.flat[strips].all()) for strips in cut_strips], np.bool_)
    found = np.zeros(len(x))
    for i in np.flatnonzero(~flat).tolist():
        found[i] = sections_below(cross_section(body, float(x[i])), plane).sum()
    some = np.flatnonzero(flat).tolist()
    owner = np.repeat(some, [len(cut_strips[i]) for i in some]).astype(np.int64)
    if len(owner):
        strip, strips = np.concatenate([cut_strips[i] for i in some]), body.prepared.strips
        curves = strips.curves(strip, strip_parameters_at(body, strip, x[owner]))
        found += np.bincount(owner, sections_below(curves, plane)[0], len(x))
    return found


def strips_at(body: StripSpans, x: float) -> tuple[IntArray, IntArray]:
    """Give the strips that a plane across the ship cuts, from aft and from forward of it.

    Within a strip both are the same; at a section they are those on either side.
    """
    long = body.fore > body.aft + _ON
    before = np.flatnonzero(long & (body.aft < x - _ON) & (body.fore >= x - _ON))
    behind = np.flatnonzero(long & (body.aft <= x + _ON) & (body.fore > x + _ON))
    return before, behind


def _strips_of_section(body: StripSpans, x: float) -> IntArray:
    """Give the strips that a plane cuts; at a section, those of the side without raked ones."""
    before, behind = strips_at(body, x)
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
