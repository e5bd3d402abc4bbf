"""A hull as what floats: its surface below planes, its stations, its doubts.

The surface goes through the lines of the net (`assoc_hull.analysis.net`); it is put together
anew only when a line has changed.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from functools import cached_property
from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.hydrostatics.doubt import doubtful_lines, doubtful_numbers, open_sections
from assoc_hull.analysis.hydrostatics.estimate import Spread, by_waterplanes, spread_of
from assoc_hull.analysis.hydrostatics.floating import Limits
from assoc_hull.analysis.hydrostatics.floating_body import Change, StationAreas
from assoc_hull.analysis.net.cells import Layout, lay_out
from assoc_hull.analysis.net.gather import Net, gather
from assoc_hull.analysis.net.sections import Sections, flat_ends_below, sections_of
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, PointKind, freeze
from assoc_hull.geometry.floating.immersed import Immersed, Planes
from assoc_hull.geometry.floating.immersed_sections import sections_and_moments_below
from assoc_hull.geometry.floating.immersion import immersed
from assoc_hull.geometry.floating.prepared_strips import Prepared, prepare
from assoc_hull.geometry.floating.strip_spans import Spans, spans
from assoc_hull.geometry.splines.evaluation import sample
from assoc_hull.geometry.surfaces.coons import CoonsStrips
from assoc_hull.model.index import Objects
from assoc_hull.model.lofting import curve_data
from assoc_hull.model.state import HullState

__all__ = ["Flotation", "flotation"]

_KEPT = "flotation"
"""Under this name what floats of a hull is kept with its tables."""

_SAMPLES = 8
"""Places on each segment among which the lowest of the hull is looked for."""


@attrs.frozen(eq=False)
class Flotation:
    """The surface of a net, ready to be cut by planes; implements `FloatingBody`.

    Attributes
    ----------
    state : HullState
        The tables it was taken from.
    net : Net
        The lines.
    layout : Layout
        How the surface is put together.
    strips : CoonsStrips
        The surface.
    kinds : (n,) int8
        The `PointKind` of each defining point of the net.
    kept : dict
        What others measured of it, to go when a line changes.
    """

    state: HullState
    net: Net
    layout: Layout
    strips: CoonsStrips
    kinds: NDArray[np.int8]
    kept: dict[object, Any] = attrs.field(factory=dict, init=False, repr=False)
    _route: dict[bytes, Immersed] = attrs.field(factory=dict, init=False, repr=False)

    @cached_property
    def prepared(self) -> Prepared:
        """The surface with its integrals."""
        return prepare(self.strips)

    @cached_property
    def spans(self) -> Spans:
        """How far its strips reach along the ship."""
        return spans(self.prepared)

    @cached_property
    def sections(self) -> Sections:
        """The sections as drawn."""
        return sections_of(self.net, self.closed)

    @cached_property
    def spread(self) -> Spread:
        """What tells how far numbers may be off."""
        return spread_of(self.state, self.net, self.strips, self.closed)

    @property
    def closed(self) -> bool:
        """The deck is closed."""
        return self.state.particulars.deck == "closed"

    @cached_property
    def limits(self) -> Limits:
        """What a waterplane must lie between, and the deck edge."""
        places = sample(self.net.batch, _SAMPLES)[1]
        deck = self.layout.deck_edge(self.net)
        return Limits(places, deck, self.closed)

    def measure(self, planes: Planes) -> Immersed:
        """Give the integrals below each plane."""
        return immersed(self.prepared, planes)

    def stations(self, planes: Planes) -> StationAreas:
        """Give the areas of the stations below each plane."""
        return self.stations_and_moments(planes)[0]

    def stations_and_moments(self, planes: Planes) -> tuple[StationAreas, FloatArray]:
        """Give the areas of the stations, and their moments about the base line, (d, n), m3."""
        found = self.sections
        each = sections_and_moments_below(found.curves, planes)
        area, moment = map(found.per_station, each)
        freeze(moment)
        return StationAreas(found.x.copy(), area, found.names), moment

    def transom(self, planes: Planes) -> FloatArray:
        """Give the area of transom and other flat ends below each plane, (d,), m2."""
        return flat_ends_below(self.net, self.closed, planes)

    def changes(self, planes: Planes) -> Sequence[Change]:
        """Give by how much the integrals may be off; the amounts of several items add up."""
        return self.spread.changes(
            self.measure(planes), self.by_waterplanes(planes), self.sections, planes
        )

    def doubts(self, planes: Planes, numbers: bool = True) -> Sequence[str]:
        """Say what is wrong with the hull, line by line; nothing if it can be trusted.

        Parameters
        ----------
        planes : Planes
            Where it floats.
        numbers : bool
            Also compare the numbers with those of other routes, which the estimate needs anyway.
        """
        found = [*open_sections(self.net, self.sections, planes), *self._doubtful_lines]
        if numbers and not found:
            routes = self.measure(planes).volume, self.by_waterplanes(planes).volume
            found += doubtful_numbers(self.sections, self.spread.sections, routes, planes)
        return tuple(found)

    @cached_property
    def _corners(self) -> FloatArray:
        """Ends and knuckles of the curves at which the hull ends, and where flats are broadest.

        As a waterplane passes one of these its area bends; (c, 3), m.
        """
        batch, own = self.net.batch, np.repeat(self.net.end, np.diff(self.net.batch.start))
        corner = self.kinds == PointKind.KNUCKLE
        corner[batch.start[:-1]] = corner[batch.start[1:] - 1] = True
        parts = [batch.xyz[corner & own]]
        for curve in np.flatnonzero(self.net.flat).tolist():
            border = batch.xyz[batch.start[curve] : batch.start[curve + 1]]
            parts.append(border[[border[:, 1].argmax()]])
        return np.concatenate(parts)

    @cached_property
    def _doubtful_lines(self) -> list[str]:
        return doubtful_lines(self.net, self.layout, self.sections, self.kinds)

    def by_waterplanes(self, planes: Planes) -> Immersed:
        """Give volume and moments by the vertical route; the last answer is kept."""
        key = b"".join(np.ascontiguousarray(each).tobytes() for each in attrs.astuple(planes))
        found = self._route.get(key)
        if found is None:
            known = self.measure(planes)
            places = self.net.batch.xyz
            found = by_waterplanes(self.prepared, planes, known, places, self._corners)
            # Another thread may do the same: what is returned is not read back from the store.
            self._route.clear()
            self._route[key] = found
        return found


def flotation(state: HullState) -> Flotation:
    """Make what floats of a hull; the same as before if no line has changed.

    Parameters
    ----------
    state : HullState
        The tables.

    Raises
    ------
    BadInputError
        Fewer than two sections, or lines between which no surface was found.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.analysis.hydrostatics.flotation import flotation
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.geometry.floating.immersed import Planes
    >>> planes = Planes(np.array([6.25]), np.zeros(1), np.zeros(1))
    >>> round(float(flotation(wigley()).measure(planes).volume[0]))  # 4/9 L B T
    2777
    """
    stamp = _stamp(state)
    known: tuple[Hashable, Flotation] | None = state.kept.get(_KEPT)
    if known is not None and known[0] == stamp:
        return known[1]
    net = gather(state)
    stations = np.unique(net.x[np.isfinite(net.x) & ~net.end])
    if len(stations) < 2:
        raise BadInputError(
            f"{len(stations)} section(s)", "in hydrostatics", "give two sections or more"
        )
    ship = state.particulars
    layout = lay_out(net, ship.length, ship.deck == "closed")
    if not layout.frames:
        raise BadInputError(
            "no surface between the sections", "in hydrostatics", "draw profile and deck edge"
        )
    kinds = curve_data(state, net.curve).kind
    found = Flotation(state, net, layout, CoonsStrips.on(layout.cells, net.batch), kinds)
    state.kept[_KEPT] = stamp, found
    return found


def _stamp(state: HullState) -> Hashable:
    """Give splines and names themselves, and how often what else the surface depends on changed."""
    made = [state.spline(curve) for curve in state.live("curves").tolist()]
    return (
        Objects([*made, state.particulars]),
        state.rows.role.writes,
        state.rows.alive.writes,
        state.lines.boundary.writes,
        state.lines.offset.writes,
        tuple(state.lines.name.data),
    )
