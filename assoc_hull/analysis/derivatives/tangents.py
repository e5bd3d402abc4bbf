"""Hydrostatics of a hull that carries tangents by parameters, some at a time."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import attrs
import numpy as np

from assoc_hull.analysis.derivatives.curve_tangents import Moving
from assoc_hull.analysis.derivatives.parameters import HELD, Parameter, Position, Rates, Shape
from assoc_hull.analysis.derivatives.tangent_flotation import Varied, varied_by
from assoc_hull.analysis.hydrostatics.algebra import Values
from assoc_hull.analysis.hydrostatics.compute import values_at
from assoc_hull.analysis.hydrostatics.flotation import Flotation
from assoc_hull.analysis.hydrostatics.hydrostatic_header import HydrostaticHeader
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.floating.immersed import Planes
from assoc_hull.geometry.numeric.dual import Dual, as_array, real

__all__ = ["Tangents", "carried", "dots", "tangents_by"]

_AT_ONCE = 8
"""Tangents that are carried along together, which bounds the memory."""


@attrs.frozen(eq=False)
class Tangents:
    """A hull at a floating position, with tangents by k parameters.

    Attributes
    ----------
    where : tuple of k int
        The places of these parameters among all.
    rates : tuple of k Rates
        How the principal dimensions change.
    draughts : (3, k)
        How T_A (m), T_F (m) and the heel (degrees) change.
    body : Varied or Flotation
        The hull; in plain numbers where only its position changes.
    moving : Moving or None
        How its points move, if they do.
    planes : Planes
        Where it floats.
    header : HydrostaticHeader
        Its dimensions; with tangents where these change.
    values : dict of (d,)
        Every value of the record.
    """

    where: tuple[int, ...]
    rates: tuple[Rates, ...]
    draughts: FloatArray
    body: Varied | Flotation
    moving: Moving | None
    planes: Planes
    header: HydrostaticHeader
    values: Values

    @property
    def count(self) -> int:
        """Number of parameters."""
        return len(self.where)


def tangents_by(
    body: Flotation,
    plane: Planes,
    header: HydrostaticHeader,
    wrt: Sequence[Parameter],
    *,
    sinks: bool = False,
) -> Iterator[Tangents]:
    """Carry parameters through hydrostatics, eight at a time; those of the position, cheap, apart.

    Parameters
    ----------
    body : Flotation
        The hull.
    plane : Planes
        Where it floats: one plane.
    header : HydrostaticHeader
        Dimensions, water and what counts.
    wrt : sequence of Parameter
        The parameters; rates of length and breadth enter coefficients.
    sinks : bool
        The plane goes along with the design draught; else draughts at the perpendiculars stay.

    Raises
    ------
    BadInputError
        A parameter that cannot be used.
    """
    for kind in (Position, Shape):
        own = [k for k, each in enumerate(wrt) if isinstance(each, kind)]
        for i in range(0, len(own), _AT_ONCE):
            yield _some(body, plane, header, wrt, tuple(own[i : i + _AT_ONCE]), sinks)


def _some(
    body: Flotation, plane: Planes, header: HydrostaticHeader, wrt: Sequence[Parameter],
    where: tuple[int, ...], sinks: bool,
) -> Tangents:  # fmt: skip
    given = [wrt[k] for k in where]
    shapes = [each for each in given if isinstance(each, Shape)]
    rates = tuple(each.rates if isinstance(each, Shape) else HELD for each in given)
    draughts = np.array([_draughts(each, sinks) for each in given]).T
    varied = varied_by(body, shapes) if shapes else None
    sized, tilted = _sized(header, rates), _tilted(plane, header.length, rates, draughts)
    hull = body if varied is None else varied
    values = values_at(hull, tilted, sized)
    way = None if varied is None else varied.moving
    return Tangents(where, rates, draughts, hull, way, tilted, sized, values)


def _draughts(parameter: Parameter, sinks: bool) -> tuple[float, float, float]:
    if isinstance(parameter, Position):
        return parameter.rates
    rate = parameter.rates.draught if sinks and isinstance(parameter, Shape) else 0.0
    return rate, rate, 0.0


def carried(value: float, rates: Sequence[float] | FloatArray) -> float:
    """Give a number with its tangents; as it is where none of them is other than nil."""
    dot = np.array(rates, np.float64)
    return Dual(value, dot) if dot.any() else value  # type: ignore[return-value]


def _sized(header: HydrostaticHeader, rates: Sequence[Rates]) -> HydrostaticHeader:
    sizes: Mapping[str, Any] = {
        name: carried(getattr(header, name), [getattr(each, name) for each in rates])
        for name in ("length", "breadth", "draught")
    }
    return attrs.evolve(header, **sizes)


def _tilted(plane: Planes, length: float, rates: Sequence[Rates], draughts: FloatArray) -> Planes:
    """Give the plane with its tangents; with trim it turns if the length changes."""
    aft, fore, heel = draughts[..., None]
    longer = np.array([each.length for each in rates])[:, None]
    turn = (fore - aft - plane.tan_trim * longer) / length
    lean = np.radians(heel) * (1.0 + plane.tan_heel**2)
    given = zip(attrs.astuple(plane, recurse=False), (aft, turn, lean), strict=True)
    return Planes(*(as_array(Dual(value, dot)) if dot.any() else value for value, dot in given))


def dots(value: Any, count: int) -> FloatArray:
    """Give the tangents of a number, or of that of one plane, (count,); nan where it is nan."""
    dot = value.dot.reshape(count, -1)[:, 0] if isinstance(value, Dual) else np.zeros(count)
    return np.where(np.isnan(real(value).ravel()[0]), np.nan, dot)
