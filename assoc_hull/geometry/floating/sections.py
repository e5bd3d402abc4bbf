"""Sections of a body across the ship, and slices of it between two of them.

`sections_below` takes curves as they are, one area each. `cross_section` and `areas_at` cut a body
by a plane anywhere along it: exactly in a strip of sections, to some 1e-7 of the length of a tile
in a raked one.

Integrals of the slice of a body between two planes across it, also with tangents.

The flux runs along y, so that sums of strips are those of the slice that they bound. Where a plane
stands in a strip of sections, the strip ends there; of a raked strip sections are integrated along
the ship. With tangents, what a section at a cut adds counts as the cut moves; raked strips are
not differentiated, and nothing is given where a plane cuts one.
"""

from __future__ import annotations

from typing import Any

import attrs
import numpy as np

from assoc_hull.geometry.curves import (
    FloatArray,
    IntArray,
    IsoCurves,
    Strips,
    freeze,
)
from assoc_hull.geometry.floating.immersed_strips import prepare_strips
from assoc_hull.geometry.floating.immersion import (
    FloatingPlanes,
    ImmersedIntegrals,
    integrate_curves,
    integrate_immersed,
)
from assoc_hull.geometry.floating.raked_strips import RakedStrip, StripSpans, strip_parameters_at
from assoc_hull.geometry.floating.tiles import CurveTiles, tiles_of_curves, tiles_subset
from assoc_hull.geometry.numeric.dual import Dual, as_array, common_zeros, is_plain, real
from assoc_hull.geometry.numeric.quadrature import bunched_rule

__all__ = [
    "SliceIntegrals",
    "StripStretches",
    "area_with_tangents",
    "areas_at",
    "cross_section",
    "integrate_slice",
    "sections_and_moments_below",
    "sections_below",
    "slice_with_tangents",
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


# --------------------------------------------------------------------------------------
# Slices in plain numbers.

_POINTS = 16
"""Sections in each part of a raked strip that is cut."""


@attrs.frozen
class SliceIntegrals:
    """What a body has between two planes across it, below a floating plane; both sides.

    Attributes
    ----------
    volume : float, m3
    moment_x, moment_z : float, m4
        Integrals of x and z over the volume.
    area : float, m2
        Of the waterplane, in plan.
    area_x : float, m3
        Integral of x over it.
    """

    volume: float
    moment_x: float
    moment_z: float
    area: float
    area_x: float

    def __add__(self, other: SliceIntegrals) -> SliceIntegrals:
        return SliceIntegrals(*(a + b for a, b in zip(_tuple(self), _tuple(other), strict=True)))


def _tuple(part: SliceIntegrals) -> tuple[float, ...]:
    return part.volume, part.moment_x, part.moment_z, part.area, part.area_x


@attrs.frozen(eq=False)
class StripStretches:
    """Strips from one v to another; implements `Strips`.

    Attributes
    ----------
    whole : Strips
        The body.
    strip : (k,) int
        Which of its strips.
    begin, finish : (k,)
        From which v to which; in any arithmetic.
    """

    whole: Strips
    strip: IntArray
    begin: FloatArray
    finish: FloatArray

    @property
    def count(self) -> int:
        """Number of strips."""
        return len(self.strip)

    @property
    def order(self) -> IntArray:
        """How many Gauss points along v each strip wants, (count,)."""
        return self.whole.order[self.strip]

    def curves(self, strip: IntArray, v: FloatArray) -> IsoCurves:
        """Give one curve for each pair of a strip and a v, (k,) each."""
        length = (self.finish - self.begin)[strip]
        found = self.whole.curves(self.strip[strip], self.begin[strip] + length * v)
        if is_plain(length) and (length == 1.0).all():
            return found
        rate = np.repeat(length, np.diff(found.start))[:, None, None]
        return IsoCurves(found.start, found.point, rate * found.across, found.deck)


def integrate_slice(
    body: StripSpans, aft: float, fore: float, plane: FloatingPlanes
) -> SliceIntegrals:
    """Integrate the slice of a body between planes across it at aft < fore, m; infinite for none.

    Below one upright floating plane. In strips of sections it is as accurate as integrals of the
    body. A raked strip that a plane cuts is parted where its rails turn or pass through the water,
    and each part integrated on `_POINTS` sections.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.analysis.hydrostatics.flotation import flotation
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.geometry.floating.sections import integrate_slice
    >>> from assoc_hull.geometry.floating.immersion import FloatingPlanes
    >>> from assoc_hull.geometry.floating.raked_strips import strip_spans
    >>> plane = FloatingPlanes(np.array([6.25]), np.zeros(1), np.zeros(1))
    >>> part = integrate_slice(strip_spans(flotation(wigley()).prepared), -np.inf, 50.0, plane)
    >>> round(part.volume)  # half of 4/9 L B T
    1389
    """
    inside = (body.fore - body.near > aft) & (body.aft + body.near < fore)
    inside &= body.fore > body.aft
    whole = inside & (body.aft >= aft) & (body.fore <= fore)
    level = np.flatnonzero(inside & (whole | body.flat))
    begin, finish, strips = np.zeros(len(level)), np.ones(len(level)), body.prepared.strips
    for ends, place, cut in (
        (begin, aft, body.aft[level] < aft),
        (finish, fore, body.fore[level] > fore),
    ):
        ends[cut] = strip_parameters_at(body, level[cut], place)
    found = _taken(
        integrate_immersed(prepare_strips(StripStretches(strips, level, begin, finish)), plane)
    )
    for strip in np.flatnonzero(inside & ~whole & ~body.flat).tolist():
        low, high = max(aft, float(body.aft[strip])), min(fore, float(body.fore[strip]))
        found = found + _raked(body.raked[strip], low, high, plane)
    return found


def _taken(sums: ImmersedIntegrals) -> SliceIntegrals:
    names = ("volume", "moment_x", "moment_z", "area", "area_x")
    return SliceIntegrals(*(float(getattr(sums, name)[0]) for name in names))


def _raked(strip: RakedStrip, aft: float, fore: float, plane: FloatingPlanes) -> SliceIntegrals:
    """Integrate sections of a strip from one place to another, part by part."""
    inner = strip.turns(plane)
    edge = np.concatenate([[aft], inner[(inner > aft) & (inner < fore)], [fore]])
    node, share = bunched_rule(_POINTS)
    length = np.diff(edge)[:, None]
    x, weight = (edge[:-1, None] + length * node).ravel(), (length * share).ravel()
    total = np.zeros(13)
    for place, each in zip(x.tolist(), weight.tolist(), strict=True):
        tiles = tiles_of_curves(strip.section(place, quick=True))
        level = np.repeat(plane.height, tiles.curves)
        columns = integrate_curves(tiles, level, plane.tan_trim, np.zeros(1))
        total += 2.0 * each * columns.sum(axis=1)
    return SliceIntegrals(*(float(total[i]) for i in (0, 1, 3, 7, 8)))


# --------------------------------------------------------------------------------------
# Slices and sections of a body whose strips carry tangents.
#
# A plane across the ship stands at a place v of a strip of sections, x(v) = c. Where the strip
# moves, or the plane, v' = (c' - x') / x_v. A strip that ends at the plane is continued by its own
# cubics: so what a section between the plane and the end adds counts, as that end moves.


def slice_with_tangents(
    body: StripSpans, strips: Strips, aft: Any, fore: Any, plane: FloatingPlanes
) -> ImmersedIntegrals | None:
    """Integrate the slice between planes across a body at aft < fore (m), with tangents.

    `body` has the strips in plain numbers, `strips` the same with tangents; the floating plane is
    upright. The integrals are (1,) each; None where one of the planes cuts a raked strip.
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
    part = StripStretches(strips, level, *ends)
    return integrate_immersed(
        prepare_strips(part, plain=StripStretches(body.prepared.strips, level, *plain)), plane
    )


def area_with_tangents(body: StripSpans, strips: Strips, x: Any, plane: FloatingPlanes) -> Any:
    """Give the area of a section below a floating plane, both sides, m2, with tangents.

    The arguments are those of `slice_with_tangents`. At an x that is an end of strips it is the
    mean of those on both sides; None where a raked strip is cut.
    """
    found = [side for side in strips_at(body, float(real(x))) if len(side)]
    flat = [side for side in found if body.flat[side].all()]
    if not flat:
        return None
    areas = [_section(body, strips, side, x, plane) for side in flat]
    return sum(areas[1:], areas[0]) / len(areas)


def _section(
    body: StripSpans, strips: Strips, strip: IntArray, x: Any, plane: FloatingPlanes
) -> Any:
    curves = strips.curves(strip, _level(body, strips, strip, x))
    return sections_below(curves, plane).sum()


def _ends(
    body: StripSpans, strips: Strips, level: IntArray, cut: np.typing.NDArray[np.bool_], place: Any,
    rest: float,
) -> FloatArray:  # fmt: skip
    """Give from or to which v strips count: those that are cut, to the plane."""
    if not cut.any():
        return np.full(len(level), rest)
    at = _level(body, strips, level[cut], place)
    found = common_zeros((len(level),), at) + rest
    found[cut] = at
    return found


def _level(body: StripSpans, strips: Strips, strip: IntArray, x: Any) -> FloatArray:
    """Give the v at which flat strips (k,) stand at a place, with tangents."""
    v = strip_parameters_at(body, strip, float(real(x)))
    curves = strips.curves(strip, v)
    first = curves.start[:-1]
    off = curves.point[first, 0, 0] - x
    along = real(curves.across[first, 0, 0])
    return as_array(Dual(v, -off.dot / along)) if isinstance(off, Dual) else v
