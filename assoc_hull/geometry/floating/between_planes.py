"""Integrals of the slice of a body between two planes across it.

The flux runs along y, so that the sums of some strips are those of the slice of the body that
they bound. Where a plane stands in a strip of sections, the strip ends there; of a raked strip
that a plane cuts, sections are integrated along the ship.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.floating.immersed import Immersed, Planes
from assoc_hull.geometry.floating.immersion import immersed
from assoc_hull.geometry.floating.immersion_half import curve_by_curve
from assoc_hull.geometry.floating.prepared_strips import prepare
from assoc_hull.geometry.floating.raked import Raked
from assoc_hull.geometry.floating.strip_spans import Spans, level_at
from assoc_hull.geometry.floating.tiles import from_curves
from assoc_hull.geometry.numeric.dual import is_plain
from assoc_hull.geometry.numeric.quadrature import bunched
from assoc_hull.geometry.surfaces.isocurves import IsoCurves, Strips

__all__ = ["Between", "Stretches", "between"]

_POINTS = 16
"""Sections in each part of a raked strip that is cut."""


@attrs.frozen
class Between:
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

    def __add__(self, other: Between) -> Between:
        return Between(*(a + b for a, b in zip(_tuple(self), _tuple(other), strict=True)))


def _tuple(part: Between) -> tuple[float, ...]:
    return part.volume, part.moment_x, part.moment_z, part.area, part.area_x


@attrs.frozen(eq=False)
class Stretches:
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


def between(body: Spans, aft: float, fore: float, plane: Planes) -> Between:
    """Integrate the slice of a body between two planes across it.

    Parameters
    ----------
    body : Spans
        The strips, and where they lie.
    aft, fore : float, m
        x of the planes, fore the greater; infinite for none.
    plane : Planes
        One floating plane, upright.

    Returns
    -------
    Between
        The integrals.

    Notes
    -----
    In strips of sections as accurate as those of the body. A raked strip that a plane cuts is
    parted where its rails turn or meet the water, and each part integrated on `_POINTS`
    sections.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.analysis.hydrostatics.flotation import flotation
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.geometry.floating.between_planes import between
    >>> from assoc_hull.geometry.floating.immersed import Planes
    >>> from assoc_hull.geometry.floating.strip_spans import spans
    >>> plane = Planes(np.array([6.25]), np.zeros(1), np.zeros(1))
    >>> part = between(spans(flotation(wigley()).prepared), -np.inf, 50.0, plane)
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
        ends[cut] = level_at(body, level[cut], place)
    found = _taken(immersed(prepare(Stretches(strips, level, begin, finish)), plane))
    for strip in np.flatnonzero(inside & ~whole & ~body.flat).tolist():
        low, high = max(aft, float(body.aft[strip])), min(fore, float(body.fore[strip]))
        found = found + _raked(body.raked[strip], low, high, plane)
    return found


def _taken(sums: Immersed) -> Between:
    names = ("volume", "moment_x", "moment_z", "area", "area_x")
    return Between(*(float(getattr(sums, name)[0]) for name in names))


def _raked(strip: Raked, aft: float, fore: float, plane: Planes) -> Between:
    """Integrate sections of a strip from one place to another, part by part."""
    inner = strip.turns(plane)
    edge = np.concatenate([[aft], inner[(inner > aft) & (inner < fore)], [fore]])
    node, share = bunched(_POINTS)
    length = np.diff(edge)[:, None]
    x, weight = (edge[:-1, None] + length * node).ravel(), (length * share).ravel()
    total = np.zeros(13)
    for place, each in zip(x.tolist(), weight.tolist(), strict=True):
        tiles = from_curves(strip.section(place, quick=True))
        level = np.repeat(plane.height, tiles.curves)
        columns = curve_by_curve(tiles, level, plane.tan_trim, np.zeros(1))
        total += 2.0 * each * columns.sum(axis=1)
    return Between(*(float(total[i]) for i in (0, 1, 3, 7, 8)))
