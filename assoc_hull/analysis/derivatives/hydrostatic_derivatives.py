"""Exact derivatives of hydrostatics, and the hull whose lines carry them along.

Everything runs through the same code as the values, on arrays that carry tangents
(`assoc_hull.geometry.numeric.dual`): the loft with its chord lengths, the surface, its cuts by the
plane, the points where the immersed part changes its kind, the algebra of the record. `tangents_by`
carries eight parameters at a time; form parameters and variations use it, too.

Source: A. Griewank, A. Walther, "Evaluating Derivatives", 2nd ed., SIAM 2008, ch. 3 (forward mode).

A hull whose lines carry derivatives along, put together as it was without them.

The layout is that of the hull as it stands: which lines bound which cell, what is decided. So
the sums are differentiated, not the decisions.
"""

from __future__ import annotations

from collections.abc import (
    Iterable,
    Iterator,
    Mapping,
    Sequence,
)
from functools import cached_property
from types import MappingProxyType
from typing import Any

import attrs
import numpy as np

from assoc_hull.analysis.derivatives.curve_tangents import CurveTangents, curve_tangents
from assoc_hull.analysis.derivatives.parameters import (
    FIXED_DIMENSIONS,
    Parameter,
    Position,
    Rates,
    ShapeParameter,
)
from assoc_hull.analysis.hydrostatics.floating_body import Appendage, StationAreas, planes_of
from assoc_hull.analysis.hydrostatics.flotation import Flotation, flotation, header_of
from assoc_hull.analysis.hydrostatics.hull_hydrostatics import (
    DraughtTo,
    OnError,
    Values,
    position_of,
    table_without_doubts,
    values_at,
)
from assoc_hull.analysis.hydrostatics.record import (
    FIELDS,
    SALT,
    HydrostaticHeader,
    Hydrostatics,
)
from assoc_hull.analysis.net.curve_net import CurveNet, sections_of, transom_areas_below
from assoc_hull.analysis.net.net_surface import move_cells
from assoc_hull.analysis.net.open_ends import with_ends
from assoc_hull.arguments import all_of, choice
from assoc_hull.geometry.curves import (
    FloatArray,
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
from assoc_hull.geometry.floating.sections import sections_below
from assoc_hull.geometry.numeric.dual import Dual, as_array, is_plain, real
from assoc_hull.geometry.surfaces.coons import CoonsStrips
from assoc_hull.model.tables import HasState, state_of

__all__ = [
    "Derivatives",
    "TangentFlotation",
    "TangentHull",
    "hydrostatic_derivatives",
    "tangent_flotation",
    "tangents_by",
    "tangents_of",
    "with_tangents",
]


@attrs.frozen(eq=False)
class TangentFlotation:
    """The surface of a net whose splines are of any arithmetic; implements `Measurable`.

    Attributes
    ----------
    base : Flotation
        The hull in plain numbers, which gives the layout.
    batch : SplineBatch
        Its splines: with tangents, complex, or of points that have moved a little.
    points : (n, 3), m
        All points of its tables, in the same arithmetic.
    moving : CurveTangents or None
        What the tangents come from, if these are such.
    """

    base: Flotation
    batch: SplineBatch
    points: FloatArray
    moving: CurveTangents | None = None

    @cached_property
    def net(self) -> CurveNet:
        """The lines."""
        return attrs.evolve(self.base.net, batch=self.batch)

    @cached_property
    def prepared(self) -> PreparedStrips:
        """The surface with its integrals."""
        cells = move_cells(self.base.layout, self.base.net, self.batch, self.points)
        strips: Strips = CoonsStrips.on(cells, self.batch)
        if self.base.ends:
            strips = with_ends(strips, self.net, self.base.closed, self.base.ends)
        return prepare_strips(strips, plain=None if is_plain(self.batch.xyz) else self.base.strips)

    def measure(self, planes: FloatingPlanes) -> ImmersedIntegrals:
        """Give the integrals below each plane."""
        return integrate_immersed(self.prepared, planes)

    def stations(self, planes: FloatingPlanes) -> StationAreas:
        """Give the areas of the stations below each plane."""
        found = sections_of(self.net, self.base.closed)
        area = found.per_station(sections_below(found.curves, planes))
        return StationAreas(self._places(found.x), area, found.names)

    def _places(self, x: FloatArray) -> FloatArray:
        """Give where the stations are: where the first points of their first pieces have gone."""
        sections = self.base.sections
        first = sections.curve[np.searchsorted(sections.station, np.arange(len(x)))]
        row = self.batch.start[first]
        was = self.base.net.batch.xyz[row, 0]
        gone: FloatArray = x + (self.batch.xyz[row, 0] - was)
        return gone

    def transom(self, planes: FloatingPlanes) -> FloatArray:
        """Give the area of transoms below each plane, (d,), m2; no end of a bossing is one."""
        return transom_areas_below(self.net, self.base.closed, planes)


def tangent_flotation(base: Flotation, shapes: Sequence[ShapeParameter]) -> TangentFlotation:
    """Give a hull whose lines carry tangents, one per parameter.

    Parameters
    ----------
    base : Flotation
        The hull.
    shapes : sequence of ShapeParameter
        The parameters.

    Raises
    ------
    BadInputError
        A curve of the hull has failed; a parameter that cannot be used.
    """
    found, batch = curve_tangents(base, shapes)
    return TangentFlotation(base, batch, as_array(Dual(found.place, found.points)), found)


# --------------------------------------------------------------------------------------
# A hull that carries tangents.

_AT_ONCE = 8
"""Tangents that are carried along together, which bounds the memory."""


@attrs.frozen(eq=False)
class TangentHull:
    """A hull at a floating position, with tangents by k parameters.

    Attributes
    ----------
    where : tuple of k int
        The places of these parameters among all.
    rates : tuple of k Rates
        How the principal dimensions change.
    draughts : (3, k)
        How T_A (m), T_F (m) and the heel (degrees) change.
    body : TangentFlotation or Flotation
        The hull; in plain numbers where only its position changes.
    moving : CurveTangents or None
        How its points move, if they do.
    planes : FloatingPlanes
        Where it floats.
    header : HydrostaticHeader
        Its dimensions; with tangents where these change.
    values : dict of (d,)
        Every value of the record.
    """

    where: tuple[int, ...]
    rates: tuple[Rates, ...]
    draughts: FloatArray
    body: TangentFlotation | Flotation
    moving: CurveTangents | None
    planes: FloatingPlanes
    header: HydrostaticHeader
    values: Values

    @property
    def count(self) -> int:
        """Number of parameters."""
        return len(self.where)


def tangents_by(
    body: Flotation,
    plane: FloatingPlanes,
    header: HydrostaticHeader,
    wrt: Sequence[Parameter],
    *,
    sinks: bool = False,
) -> Iterator[TangentHull]:
    """Carry parameters through hydrostatics at one plane, eight at a time.

    Those of the position, which are cheap, come apart from those that move points. Rates of length
    and breadth enter coefficients. `sinks`: the plane goes along with the design draught; else
    draughts at the perpendiculars stay.

    Raises
    ------
    BadInputError
        A parameter that cannot be used.
    """
    for kind in (Position, ShapeParameter):
        own = [k for k, each in enumerate(wrt) if isinstance(each, kind)]
        for i in range(0, len(own), _AT_ONCE):
            yield _some(body, plane, header, wrt, tuple(own[i : i + _AT_ONCE]), sinks)


def _some(
    body: Flotation, plane: FloatingPlanes, header: HydrostaticHeader, wrt: Sequence[Parameter],
    where: tuple[int, ...], sinks: bool,
) -> TangentHull:  # fmt: skip
    given = [wrt[k] for k in where]
    shapes = [each for each in given if isinstance(each, ShapeParameter)]
    rates = tuple(
        each.rates if isinstance(each, ShapeParameter) else FIXED_DIMENSIONS for each in given
    )
    draughts = np.array([_draughts(each, sinks) for each in given]).T
    varied = tangent_flotation(body, shapes) if shapes else None
    sized, tilted = _sized(header, rates), _tilted(plane, header.length, rates, draughts)
    hull = body if varied is None else varied
    values = values_at(hull, tilted, sized)
    way = None if varied is None else varied.moving
    return TangentHull(where, rates, draughts, hull, way, tilted, sized, values)


def _draughts(parameter: Parameter, sinks: bool) -> tuple[float, float, float]:
    if isinstance(parameter, Position):
        return parameter.rates
    rate = parameter.rates.draught if sinks and isinstance(parameter, ShapeParameter) else 0.0
    return rate, rate, 0.0


def with_tangents(value: float, rates: Sequence[float] | FloatArray) -> float:
    """Give a number with its tangents; as it is where all of them are zero."""
    dot = np.array(rates, np.float64)
    return Dual(value, dot) if dot.any() else value  # type: ignore[return-value]


def _sized(header: HydrostaticHeader, rates: Sequence[Rates]) -> HydrostaticHeader:
    sizes: Mapping[str, Any] = {
        name: with_tangents(getattr(header, name), [getattr(each, name) for each in rates])
        for name in ("length", "breadth", "draught")
    }
    return attrs.evolve(header, **sizes)


def _tilted(
    plane: FloatingPlanes, length: float, rates: Sequence[Rates], draughts: FloatArray
) -> FloatingPlanes:
    """Give the plane with its tangents; with trim it turns if the length changes."""
    aft, fore, heel = draughts[..., None]
    longer = np.array([each.length for each in rates])[:, None]
    turn = (fore - aft - plane.tan_trim * longer) / length
    lean = np.radians(heel) * (1.0 + plane.tan_heel**2)
    given = zip(attrs.astuple(plane, recurse=False), (aft, turn, lean), strict=True)
    return FloatingPlanes(
        *(as_array(Dual(value, dot)) if dot.any() else value for value, dot in given)
    )


def tangents_of(value: Any, count: int) -> FloatArray:
    """Give the tangents of a number, or of that of one plane, (count,); nan where it is nan."""
    dot = value.dot.reshape(count, -1)[:, 0] if isinstance(value, Dual) else np.zeros(count)
    return np.where(np.isnan(real(value).ravel()[0]), np.nan, dot)


# --------------------------------------------------------------------------------------
# Derivatives of the record.

_WHERE = "in hydrostatic_derivatives"


@attrs.frozen(eq=False)
class Derivatives:
    """Derivatives of a record of hydrostatics by k parameters.

    Attributes
    ----------
    value : Hydrostatics
        The record.
    names, units : tuple of k str
        The parameters and their units.
    columns : mapping of str to (k,)
        By field of the record: its derivatives, in its unit per unit of each parameter; nan
        where the record has no value.
    """

    value: Hydrostatics
    names: tuple[str, ...]
    units: tuple[str, ...]
    columns: Mapping[str, FloatArray]

    def __attrs_post_init__(self) -> None:
        freeze(*self.columns.values())

    def of(self, name: str) -> FloatArray:
        """Give the derivatives of one field of the record, (k,).

        Raises
        ------
        BadInputError
            The record has no such field.
        """
        return self.columns[choice(name, "the field", self.columns, _WHERE)]

    def matrix(self, names: Iterable[str]) -> FloatArray:
        """Give the derivatives of some fields, (n, k): a row each."""
        return np.stack([self.of(name) for name in names])


def hydrostatic_derivatives(
    hull: HasState,
    wrt: Iterable[Parameter],
    *,
    draught: float | None = None,
    draughts: tuple[float, float] | None = None,
    heel_deg: float = 0.0,
    rho: float = SALT,
    shell_factor: float = 1.0,
    kg: float | None = None,
    transom: bool = False,
    on_error: OnError = "refuse",
    appendages: Iterable[Appendage] = (),
    keel_thickness: float = 0.0,
    draught_to: DraughtTo = "moulded",
) -> Derivatives:
    """Differentiate the hydrostatics of a hull at one floating position.

    The arguments and what is raised are those of `Hull.hydrostatic_derivatives`.
    """
    terms: dict[str, object] = {
        "rho": rho, "shell_factor": shell_factor, "kg": kg, "transom": transom,
        "appendages": appendages, "keel_thickness": keel_thickness,
    }  # fmt: skip
    body = flotation(state_of(hull))
    header = header_of(hull, body, terms)
    position = position_of(header, draught, draughts, heel_deg, draught_to)
    parameters = all_of(wrt, Parameter, "wrt", _WHERE)  # type: ignore[type-abstract]
    table = table_without_doubts(body, [position], header, (1, 1), on_error, estimate=False)
    # With an open deck that is drowned, what is reported is measured up to its edge.
    plane = planes_of(table.positions, header.length)
    return Derivatives(
        table[0],
        tuple(each.title for each in parameters),
        tuple(each.per for each in parameters),
        MappingProxyType(_differentiated(body, plane, header, parameters)),
    )


def _differentiated(
    body: Flotation, plane: FloatingPlanes, header: HydrostaticHeader, wrt: Sequence[Parameter]
) -> dict[str, FloatArray]:
    """Give the derivatives, (k,) by field; nan where there is no value."""
    found = {name: np.zeros(len(wrt)) for name in FIELDS}
    for some in tangents_by(body, plane, header, wrt):
        for name, value in some.values.items():
            found[name][list(some.where)] = tangents_of(value, some.count)
    return found
