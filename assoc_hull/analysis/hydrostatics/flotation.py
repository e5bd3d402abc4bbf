"""A hull as what floats: its surface below planes, its stations, its doubts.

The surface goes through the lines of the net (`assoc_hull.analysis.net`). A `Flotation` is kept
with the tables, and made again only when a line has changed. `body_of` and `header_of` are the way
from a hull to what is measured of it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.hydrostatics.accuracy import (
    ErrorEstimator,
    LinesMade,
    are_plainly_sound,
    doubtful_lines,
    doubtful_numbers,
    error_estimator,
    integrate_by_waterplanes,
    open_sections,
)
from assoc_hull.analysis.hydrostatics.floating_body import (
    FloatingBody,
    IntegralChange,
    SampledCurves,
    StationAreas,
    WaterplaneLimits,
)
from assoc_hull.analysis.hydrostatics.record import HydrostaticHeader
from assoc_hull.analysis.net.curve_net import (
    CurveNet,
    NetSections,
    NetStations,
    gather_net,
    sections_of,
    stations_of,
    sum_pieces,
    sum_transoms,
    transom_areas_below,
    transom_ends,
)
from assoc_hull.analysis.net.net_surface import KeptLayout, NetSurface
from assoc_hull.analysis.net.open_ends import with_ends
from assoc_hull.analysis.net.surface_layout import (
    OpenEnd,
    SurfaceLayout,
    lay_out_surface,
    open_ends,
)
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import (
    CurveData,
    EndKind,
    FloatArray,
    IntArray,
    PointKind,
    SplineBatch,
    Strips,
    freeze,
)
from assoc_hull.geometry.floating.immersed_strips import PreparedStrips, prepare_strips
from assoc_hull.geometry.floating.immersion import (
    FloatingPlanes,
    ImmersedIntegrals,
    integrate_immersed,
)
from assoc_hull.geometry.floating.raked_strips import StripSpans, strip_spans
from assoc_hull.geometry.floating.sections import sections_and_moments_below
from assoc_hull.geometry.numeric.dual import is_plain
from assoc_hull.geometry.splines.backend import backend
from assoc_hull.geometry.surfaces.coons import CoonsStrips
from assoc_hull.graph.derived import Objects
from assoc_hull.model.definition.fingerprint import fingerprint
from assoc_hull.model.network import curve_data
from assoc_hull.model.tables import HullState, Particulars, state_of

if TYPE_CHECKING:
    from assoc_hull.geometry.floating.compiled_sections import SectionRows
    from assoc_hull.model.tables import HasState

__all__ = [
    "EvenKeelDisplacement",
    "Flotation",
    "body_of",
    "body_of_state",
    "data_of_lines",
    "even_keel_displacement",
    "flotation",
    "flotation_of_lines",
    "header_of",
]

_SAMPLES = 8
"""Points on each segment among which the lowest of the hull is looked for."""

_STEEP = float(np.tan(np.radians(80.0)))
"""Beyond this tangent of the heel the surface is integrated on more curves.

Curves of end strips lean along the ship, so that fluxes balance over the strip and not on each
curve: the tangent of the heel multiplies what the rule along it misses. On the trawler of the tests
KN at 90 degrees was .23 m off.
"""

_STEEP_ORDER = 16
"""By this factor: KN of that trawler at 90 degrees is within .5 mm of that by twice as many."""


@attrs.frozen(eq=False)
class Flotation:
    """The surface of a net, ready to be cut by planes; implements `FloatingBody`.

    Attributes
    ----------
    state : HullState
        The tables it was taken from.
    net : CurveNet
        The lines.
    surface : NetSurface
        The surface, with what closes its open ends.
    kinds : (n,) int8
        The `PointKind` of each defining point of the net.
    ends : tuple of OpenEnd
        Ends that no line closes.
    moved : Particulars or None
        Its dimensions, where its lines are not those of the tables: these have the structure only.
    """

    state: HullState
    net: CurveNet
    surface: NetSurface
    kinds: NDArray[np.int8]
    ends: tuple[OpenEnd, ...] = ()
    moved: Particulars | None = None
    _route: dict[bytes, ImmersedIntegrals] = attrs.field(factory=dict, init=False, repr=False)
    _below: dict[bytes, ImmersedIntegrals] = attrs.field(factory=dict, init=False, repr=False)
    _areas: dict[bytes, tuple[FloatArray, FloatArray]] = attrs.field(
        factory=dict, init=False, repr=False
    )

    @property
    def layout(self) -> SurfaceLayout:
        """How the surface is put together."""
        return self.surface.layout

    @property
    def strips(self) -> Strips:
        """The surface, with what closes its open ends."""
        return self.surface.strips

    @cached_property
    def prepared(self) -> PreparedStrips:
        """The surface with its integrals."""
        return prepare_strips(self.strips)

    @cached_property
    def _steep(self) -> PreparedStrips:
        """The surface with so many curves that the end strips hold at steep heels."""
        return prepare_strips(self.strips, _STEEP_ORDER)

    @cached_property
    def spans(self) -> StripSpans:
        """How far its strips reach along the ship."""
        return strip_spans(self.prepared)

    @cached_property
    def sections(self) -> NetSections:
        """The sections as drawn."""
        return sections_of(self.net, self.closed)

    @cached_property
    def spread(self) -> ErrorEstimator:
        """What estimates how far numbers may be off."""
        data = curve_data(self.state, self.net.curve)
        if self.moved is not None:
            data = data_of_lines(data, self.net.batch)
        made = LinesMade(self.state, data, self.particulars.length)
        return error_estimator(made, self.net, self.strips, self.closed, self.ends)

    @property
    def particulars(self) -> Particulars:
        """Its dimensions."""
        return self.state.particulars if self.moved is None else self.moved

    @cached_property
    def kept(self) -> KeptLayout:
        """Its layout, ready to be put on other lines of the same structure."""
        return KeptLayout.of(self.layout, self.net, self.closed)

    @property
    def assumed(self) -> tuple[str, ...]:
        """What is taken of the hull that no line shows."""
        return tuple(str(each) for each in self.ends)

    @property
    def closed(self) -> bool:
        """The deck is closed."""
        return self.particulars.deck == "closed"

    @cached_property
    def limits(self) -> WaterplaneLimits:
        """What a waterplane must lie between, and the deck edge."""
        bottom, found = SampledCurves(self.net.batch, _SAMPLES), self.known_stations
        deck = self.surface.deck_edge(self.net)
        return WaterplaneLimits(bottom, deck, self.closed, found.x.copy(), found.names)

    def measure(self, planes: FloatingPlanes) -> ImmersedIntegrals:
        """Give the integrals below each plane; the last answer is kept."""
        if not _are_plain(planes):
            return integrate_immersed(self.prepared, planes)
        key = _key(planes)
        found = self._below.get(key)
        if found is None:
            found = self._integrated(planes)
            # Another thread may do the same: what is returned is not read back from the store.
            self._below.clear()
            self._below[key] = found
        return found

    def _integrated(self, planes: FloatingPlanes) -> ImmersedIntegrals:
        steep = np.abs(planes.tan_heel) > _STEEP
        if not steep.any():
            return self._integrated_plainly(planes)
        found = integrate_immersed(self._steep, _some(planes, steep))
        if steep.all():
            return found
        plain = self._integrated_plainly(_some(planes, ~steep))
        whole = {}
        for name, value in attrs.asdict(plain, recurse=False).items():
            whole[name] = np.empty(len(steep))
            whole[name][~steep], whole[name][steep] = value, getattr(found, name)
        return ImmersedIntegrals(**whole)

    def _integrated_plainly(self, planes: FloatingPlanes) -> ImmersedIntegrals:
        # Which arithmetic it is must not depend on when one asks: they differ by rounding.
        rows = self.surface.rows if backend() == "numba" else None
        if rows is None:
            return integrate_immersed(self.prepared, planes)
        from assoc_hull.geometry.floating.compiled_immersion import integrate_surface

        return integrate_surface(rows, planes)

    def stations(self, planes: FloatingPlanes) -> StationAreas:
        """Give the areas of the stations below each plane."""
        return self.stations_and_moments(planes)[0]

    def stations_and_moments(self, planes: FloatingPlanes) -> tuple[StationAreas, FloatArray]:
        """Give the areas of the stations, and their moments about the base line, (d, n), m3."""
        found, known = self._drawn_below(planes), self.known_stations
        if found is None:
            each = sections_and_moments_below(self.sections.curves, planes)
        else:
            area, moment = found
            each = area[:, : len(known.curve)], moment[:, : len(known.curve)]
        area, moment = (sum_pieces(values, known.station, len(known.x)) for values in each)
        freeze(moment)
        return StationAreas(known.x.copy(), area, known.names), moment

    def transom(self, planes: FloatingPlanes) -> FloatArray:
        """Give the area of transoms below each plane, (d,), m2; no end of a bossing is one."""
        found = self._drawn_below(planes)
        if found is None:
            return transom_areas_below(self.net, self.closed, planes)
        curves, area = self._drawn_curves, found[0]
        first = len(self.known_stations.curve)
        ends = curves[first : len(curves) - int(self.net.transom.sum())]
        place = {curve: first + k for k, curve in enumerate(curves[first:].tolist())}

        def areas(some: IntArray) -> FloatArray:
            total: FloatArray = area[:, [place[each] for each in some.tolist()]].sum(axis=1)
            return total

        return sum_transoms(self.net, ends, areas)

    @cached_property
    def known_stations(self) -> NetStations:
        """Which sections there are, and where they stand."""
        return stations_of(self.net)

    @cached_property
    def _drawn_curves(self) -> IntArray:
        """The sections, then the ends that are transoms, then raked ones."""
        raked = np.flatnonzero(self.net.transom)
        return np.concatenate([self.known_stations.curve, transom_ends(self.net), raked])

    def _drawn_below(self, planes: FloatingPlanes) -> tuple[FloatArray, FloatArray] | None:
        """Give areas and moments of `_drawn_curves` by compiled code; the last answer is kept."""
        if self._drawn is None or not _are_plain(planes):
            return None
        key = _key(planes)
        found = self._areas.get(key)
        if found is None:
            found = self._drawn.below(planes)
            self._areas.clear()
            self._areas[key] = found
        return found

    @cached_property
    def _drawn(self) -> SectionRows | None:
        """Sections and transoms as compiled code takes them; None where numpy serves."""
        if backend() != "numba":
            return None
        from assoc_hull.geometry.floating.compiled_sections import SectionRows

        net, curves = self.net, self._drawn_curves
        upright = np.isfinite(net.x[curves])
        return SectionRows.of(net.batch, curves, upright, self.closed, net.on_centre)

    def changes(self, planes: FloatingPlanes) -> Sequence[IntegralChange]:
        """Give by how much the integrals may be off; the amounts of several items add up."""
        return self.spread.changes(
            self.measure(planes), self.by_waterplanes(planes), self.sections, planes
        )

    def doubts(self, planes: FloatingPlanes, numbers: bool = True) -> Sequence[str]:
        """Say what is wrong with the hull, line by line; nothing if it can be trusted.

        `numbers` also compares them with those of other routes, which the estimate needs anyway.
        """
        if not numbers and self._plainly_sound(planes):
            return ()
        found = [*open_sections(self.net, self.sections, planes), *self._doubtful_lines]
        if numbers and not found:
            routes = self.measure(planes).volume, self.by_waterplanes(planes).volume
            found += doubtful_numbers(self.sections, self.spread.sections, routes, planes)
        return tuple(found)

    def _plainly_sound(self, planes: FloatingPlanes) -> bool:
        plain = backend() == "numba" and _are_plain(planes)
        return plain and are_plainly_sound(
            self.net, self.layout, self.known_stations.curve, self.kinds, planes
        )

    @cached_property
    def _corners(self) -> FloatArray:
        """Ends and knuckles of curves at which the hull ends; where flats are broadest, a deck low.

        As a waterplane passes one of these its area bends; (c, 3), m.
        """
        batch, own = self.net.batch, np.repeat(self.net.end, np.diff(self.net.batch.start))
        corner = self.kinds == PointKind.KNUCKLE
        corner[batch.start[:-1]] = corner[batch.start[1:] - 1] = True
        parts = [batch.xyz[corner & own]]
        for curve in np.flatnonzero(self.net.flat).tolist():
            border = batch.xyz[batch.start[curve] : batch.start[curve + 1]]
            parts.append(border[[border[:, 1].argmax()]])
        if self.closed:
            # From the lowest place of the deck's edge up the deck floods, and the waterplane goes.
            deck = self.limits.deck
            parts.append(deck[[int(deck[:, 2].argmin())]])
        return np.concatenate(parts)

    @cached_property
    def _doubtful_lines(self) -> list[str]:
        return doubtful_lines(self.net, self.layout, self.sections, self.kinds)

    def by_waterplanes(self, planes: FloatingPlanes) -> ImmersedIntegrals:
        """Give volume and moments by the vertical route; the last answer is kept."""
        key = _key(planes)
        found = self._route.get(key)
        if found is None:
            known = self.measure(planes)
            places = self.net.batch.xyz
            found = integrate_by_waterplanes(self.prepared, planes, known, places, self._corners)
            # Another thread may do the same: what is returned is not read back from the store.
            self._route.clear()
            self._route[key] = found
        return found


def _are_plain(planes: FloatingPlanes) -> bool:
    return all(map(is_plain, (planes.height, planes.tan_trim, planes.tan_heel)))


def data_of_lines(known: CurveData, batch: SplineBatch) -> CurveData:
    """Give what lines are made of, from the lines; of which kind that is, is `known`."""
    first, last = batch.start[:-1], batch.start[1:] - 1
    course = np.stack([batch.leave[first], batch.arrive[last]], axis=1)
    vector = np.where(known.end_kind[..., None] == EndKind.CURVATURE, _bends(batch), course)
    return attrs.evolve(known, xyz=batch.xyz, direction=batch.leave, end_vector=vector)


def _bends(batch: SplineBatch) -> FloatArray:
    """Give the second derivatives of curves by their length at both ends, (m, 2, 3), 1/m."""
    found = []
    for knot, near, far in ((batch.start[:-1], 1, 0), (batch.start[1:] - 2, 0, 1)):
        length = (batch.knot[knot + 1] - batch.knot[knot])[:, None]
        rise = (batch.xyz[knot + 1] - batch.xyz[knot]) / length
        one, other = rise - batch.leave[knot], batch.arrive[knot + 1] - rise
        found.append((2.0 * (1 + near) * one - 2.0 * (1 + far) * other) / length)
    found[1] = -found[1]
    return np.stack(found, axis=1)


def _some(planes: FloatingPlanes, some: NDArray[np.bool_]) -> FloatingPlanes:
    return FloatingPlanes(*(each[some] for each in attrs.astuple(planes)))


def _key(planes: FloatingPlanes) -> bytes:
    """Give what tells planes of plain numbers from others."""
    return b"".join(np.ascontiguousarray(each).tobytes() for each in attrs.astuple(planes))


def flotation(state: HullState) -> Flotation:
    """Give the `Flotation` of a hull; the same as before if no line has changed.

    Raises
    ------
    BadInputError
        Fewer than two sections, or lines between which no surface was found.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.analysis.hydrostatics.flotation import flotation
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.geometry.floating.immersion import FloatingPlanes
    >>> planes = FloatingPlanes(np.array([6.25]), np.zeros(1), np.zeros(1))
    >>> round(float(flotation(wigley()).measure(planes).volume[0]))  # 4/9 L B T
    2777
    """
    return state.derived(("flotation",), _depends_on(state), lambda: _flotation(state))


def _flotation(state: HullState) -> Flotation:
    net = gather_net(state)
    return flotation_of_lines(state, net, curve_data(state, net.curve).kind)


def flotation_of_lines(
    state: HullState, net: CurveNet, kinds: NDArray[np.int8], moved: Particulars | None = None
) -> Flotation:
    """Lay a surface through lines, and make what floats of it.

    Parameters
    ----------
    state : HullState
        Tables of the ship, or of one of the same structure.
    net : CurveNet
        The lines; those of the tables, or others of that structure.
    kinds : (n,) int8
        The `PointKind` of each defining point of the net.
    moved : Particulars or None
        Dimensions of the ship, where her lines are not those of the tables.

    Raises
    ------
    BadInputError
        As `flotation`.
    """
    stations = np.unique(net.x[np.isfinite(net.x) & ~net.end])
    if len(stations) < 2:
        raise BadInputError(
            f"{len(stations)} section(s)", "in hydrostatics", "give two sections or more"
        )
    ship = state.particulars if moved is None else moved
    layout = lay_out_surface(net, ship.length, ship.deck == "closed")
    if not layout.frames:
        raise BadInputError(
            "no surface between the sections", "in hydrostatics", "draw profile and deck edge"
        )
    ends, closed = open_ends(net, layout, ship.length), ship.deck == "closed"
    strips: Strips = CoonsStrips.on(layout.cells, net.batch)
    strips = with_ends(strips, net, closed, ends) if ends else strips
    return Flotation(state, net, NetSurface(layout, strips), kinds, ends, moved)


def _depends_on(state: HullState) -> tuple[object, ...]:
    """Give what the surface depends on: splines, names and some columns."""
    made = [state.spline(curve) for curve in state.live("curves").tolist()]
    return (
        Objects([*made, state.particulars]),
        state.rows.role,
        state.rows.alive,
        state.lines.boundary,
        state.lines.offset,
        tuple(state.lines.name.data),
    )


# --------------------------------------------------------------------------------------
# What can be measured of a hull, and the header of the numbers.


def body_of(hull: HasState) -> FloatingBody:
    """Make what can be measured of a hull, less the tunnels that it holds."""
    # The one place where hydrostatics takes the integrals of a net.
    return body_of_state(state_of(hull))


def body_of_state(state: HullState) -> FloatingBody:
    """Make what can be measured of the tables of a hull, as `body_of` does."""
    body: FloatingBody = flotation(state)
    if not state.tunnels:
        return body
    # A hull without tunnels measures none.
    from assoc_hull.analysis.hydrostatics.tunnel import TunnelledBody, kept_tunnels

    return TunnelledBody(body, kept_tunnels(state))


def header_of(hull: HasState, body: FloatingBody, terms: Mapping[str, object]) -> HydrostaticHeader:
    """Make the header: dimensions of the hull, and the fields (`terms`) that the caller chose.

    The fingerprint takes longer than the algebra of one position: who shows none gives "".
    """
    state = state_of(hull)
    ship = state.particulars
    chosen: dict[str, object] = {
        "kg": None, "keel_thickness": 0.0, "transom": False, "date": None, **terms
    }  # fmt: skip
    if not isinstance(body, Flotation):
        chosen["tunnels"] = state.tunnels
    if "fingerprint" not in chosen:
        chosen["fingerprint"] = fingerprint(state)
    return HydrostaticHeader(
        ship=ship.name, length=ship.length, breadth=ship.breadth, draught=ship.draught,
        deck="closed" if body.limits.closed else "open", **chosen,  # type: ignore[arg-type]
    )  # fmt: skip


# --------------------------------------------------------------------------------------
# Volume and centre of buoyancy at even keel, for the preview of an edit.


@attrs.frozen
class EvenKeelDisplacement:
    """What the hull displaces at even keel, both sides.

    Attributes
    ----------
    volume : float, m3
        Moulded.
    lcb : float, m
        Longitudinal centre of buoyancy from AP, + forward.
    """

    volume: float
    lcb: float


def even_keel_displacement(
    state: HullState, draught: float | None = None, *, tunnels: bool = False
) -> EvenKeelDisplacement:
    """Measure volume and LCB at even keel, at the design draught if `draught` (m) is None.

    `tunnels`: whether those that the hull holds are taken off.

    Raises
    ------
    BadInputError
        Fewer than two sections, or no surface between them.

    Examples
    --------
    >>> from assoc_hull.analysis.hydrostatics.flotation import even_keel_displacement
    >>> from assoc_hull.shipped.wigley import wigley
    >>> round(even_keel_displacement(wigley()).volume, 1)  # 4/9 L B T = 2777.8
    2777.4
    """
    level = state.particulars.draught if draught is None else draught
    planes = FloatingPlanes(np.array([level], np.float64), np.zeros(1), np.zeros(1))
    below = (body_of_state(state) if tunnels else flotation(state)).measure(planes)
    volume, moment = float(below.volume[0]), float(below.moment_x[0])
    return EvenKeelDisplacement(volume, moment / volume if volume else float("nan"))
