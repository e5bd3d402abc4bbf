"""How far hydrostatics may be off: other rules, another route, fewer lines.

Four comparisons, of which each gives a change of every integral:

1. the Gauss order along the strips doubled: the error of the rule;
2. waterplanes integrated vertically: volume and moments by another route, which agrees only
   if the surface is closed and consistent;
3. every other section left out, the even ones and then the odd ones: how much lies between
   the sections;
4. every other waterline, buttock and diagonal left out: how much lies between these.

For lines twice as far apart an error of third order is eight times as large, so that the
difference is seven times the error of the net itself; half of the difference is stated. Where
lines are so wide apart that no order shows, the difference itself is large.

Source: L.F. Richardson, J.A. Gaunt, "The deferred approach to the limit", Phil. Trans. A
226 (1927).
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.hydrostatics.floating_body import Change
from assoc_hull.analysis.net.cells import Layout, lay_out
from assoc_hull.analysis.net.gather import Net
from assoc_hull.analysis.net.sections import Sections, flat_ends_below, sections_of
from assoc_hull.analysis.net.thin import every_other_line, every_other_section, thinned
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.floating.immersed import Immersed, Planes
from assoc_hull.geometry.floating.immersed_sections import sections_below
from assoc_hull.geometry.floating.immersion import immersed
from assoc_hull.geometry.floating.prepared_strips import Prepared, prepare
from assoc_hull.geometry.numeric.quadrature import bunched
from assoc_hull.geometry.surfaces.coons import CoonsStrips
from assoc_hull.model.state import HullState

__all__ = ["Coarse", "Spread", "by_waterplanes", "spread_of"]

_PART = 0.5
"""Of the difference to the net with half the lines this is stated."""

_LEVELS, _LEAST = 48, 12
"""Waterplanes of the vertical route, and those of a stretch between two corners at least."""

_STRETCHES = 7
"""Between so many corners at most the vertical route is parted."""

_NEAR = 1e-3
"""Corners whose heights differ by less, in parts of the whole, are one."""


@attrs.frozen(eq=False)
class Coarse:
    """A hull with fewer lines.

    Attributes
    ----------
    net : Net
        The lines.
    layout : Layout
        How the surface through them is put together.
    prepared : Prepared
        The surface.
    """

    net: Net
    layout: Layout
    prepared: Prepared


@attrs.frozen(eq=False)
class Spread:
    """What the numbers of a hull are compared with.

    Attributes
    ----------
    own : Net
        The lines.
    fine : Prepared
        The same surface with the order along the strips doubled.
    sections : tuple of Coarse
        Without the even and without the odd sections.
    lines : Coarse
        Without every other line along the ship.
    closed : bool
        The deck is closed.
    """

    own: Net
    fine: Prepared
    sections: tuple[Coarse, ...]
    lines: Coarse
    closed: bool

    def changes(
        self, known: Immersed, route: Immersed, own: Sections, planes: Planes
    ) -> list[Change]:
        """Give the change of each comparison; see the module.

        Parameters
        ----------
        known : Immersed
            What is published.
        route : Immersed
            What `by_waterplanes` gives.
        own : Sections
            The sections.
        planes : Planes
            d planes.
        """
        areas = own.per_station(sections_below(own.curves, planes))
        ends = flat_ends_below(self.own, self.closed, planes)
        still, dry = np.zeros_like(areas), np.zeros_like(ends)
        share = _PART / max(len(self.sections), 1)
        found = [
            Change(_less(immersed(self.fine, planes), known), still, dry),
            Change(_less(route, known), still, dry),
        ]
        found += [
            Change(_times(_less(immersed(each.prepared, planes), known), share), still, dry)
            for each in self.sections
        ]
        coarse = sections_of(self.lines.net, self.closed)
        fewer = coarse.per_station(sections_below(coarse.curves, planes))
        found.append(
            Change(
                _times(_less(immersed(self.lines.prepared, planes), known), _PART),
                _PART * (fewer - areas),
                _PART * (flat_ends_below(self.lines.net, self.closed, planes) - ends),
            )
        )
        return found


def spread_of(state: HullState, net: Net, strips: CoonsStrips, closed: bool) -> Spread:
    """Make what a hull is compared with.

    Parameters
    ----------
    state : HullState
        The tables.
    net : Net
        The lines.
    strips : CoonsStrips
        The surface through them.
    closed : bool
        The deck is closed.
    """

    def coarse(without: NDArray[np.bool_]) -> Coarse:
        fewer = thinned(state, net, without)
        layout = lay_out(fewer, state.particulars.length, closed)
        return Coarse(fewer, layout, prepare(CoonsStrips.on(layout.cells, fewer.batch)))

    return Spread(
        net,
        prepare(strips, factor=2),
        tuple(coarse(every_other_section(net, first)) for first in (0, 1)),
        coarse(every_other_line(net)),
        closed,
    )


def by_waterplanes(
    prepared: Prepared,
    planes: Planes,
    known: Immersed,
    places: FloatArray,
    corners: FloatArray,
) -> Immersed:
    """Integrate waterplanes from the lowest place up: volume and moments by another route.

    Parameters
    ----------
    prepared : Prepared
        The surface.
    planes : Planes
        d planes.
    known : Immersed
        What is below them; all but volume and moments is taken from it.
    places : (n, 3), m
        Among which the lowest is.
    corners : (c, 3), m
        At the heights of which the area of the waterplane may bend: each stretch between them
        has a rule of its own.

    Returns
    -------
    Immersed
        With volume and moments as integrals of the area of the waterplane and its moments.
    """
    lowest = _heights(places, planes).min(axis=1)
    stretches = [
        _stretches(float(low), float(high), row)
        for low, high, row in zip(lowest, planes.height, _heights(corners, planes), strict=True)
    ]
    rules = [_rule(edge) for edge in stretches]
    height, weight = (np.concatenate(parts) for parts in zip(*rules, strict=True))
    owner = np.repeat(np.arange(len(rules)), [len(rule[0]) for rule in rules])
    trim, heel = planes.tan_trim[owner], planes.tan_heel[owner]
    cut = immersed(prepared, Planes(height, trim, heel))
    z = cut.area * height + trim * cut.area_x - heel * cut.area_y

    def sum_up(values: FloatArray) -> FloatArray:
        total: FloatArray = np.bincount(owner, values * weight, len(rules)).astype(np.float64)
        return total

    return attrs.evolve(
        known,
        volume=sum_up(cut.area),
        moment_x=sum_up(cut.area_x),
        moment_y=sum_up(cut.area_y),
        moment_z=sum_up(z),
    )


def _heights(places: FloatArray, planes: Planes) -> FloatArray:
    """Give the heights at x = y = 0 of planes through places of both sides, (d, 2 n), m."""
    x, y, z = places.T
    level = z - planes.tan_trim[:, None] * x
    heel = planes.tan_heel[:, None] * y
    return np.concatenate([level - heel, level + heel], axis=1)


def _stretches(low: float, high: float, corners: FloatArray) -> FloatArray:
    """Give the heights between which a rule is laid, (s + 1,): no more than are worth it."""
    reach = max(high - low, 0.0)
    inner = np.sort(corners[(corners > low + _NEAR * reach) & (corners < high - _NEAR * reach)])
    inner = inner[np.diff(inner, prepend=-np.inf) > _NEAR * reach]
    if len(inner) >= _STRETCHES:
        inner = inner[np.linspace(0, len(inner) - 1, _STRETCHES - 1).round().astype(np.int64)]
    return np.concatenate([[low], inner, [low + reach]])


def _rule(edge: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give heights and weights between edges, for half-integer powers over a round bottom."""
    part, weight = bunched(max(_LEVELS // (len(edge) - 1), _LEAST))
    step = np.diff(edge)[:, None]
    return (edge[:-1, None] + step * part).ravel(), (step * weight).ravel()


def _less(one: Immersed, other: Immersed) -> Immersed:
    pairs = {
        field.name: getattr(one, field.name) - getattr(other, field.name)
        for field in attrs.fields(Immersed)
    }
    return Immersed(**pairs)


def _times(one: Immersed, factor: float) -> Immersed:
    return Immersed(
        **{field.name: factor * getattr(one, field.name) for field in attrs.fields(Immersed)}
    )
