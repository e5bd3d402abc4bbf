"""Hydrostatics of a hull whose shape and dimensions carry tangents, some parameters at a time."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import attrs
import numpy as np

from assoc_hull.analysis.algebra import Values
from assoc_hull.analysis.compute import values_at
from assoc_hull.analysis.flotation import Flotation
from assoc_hull.analysis.hydrostatic_header import HydrostaticHeader
from assoc_hull.analysis.parameters import Shape
from assoc_hull.analysis.varied import Varied, varied_by
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.dual import Dual, as_array, real
from assoc_hull.geometry.immersed import Planes

__all__ = ["AT_ONCE", "Tangents", "carried", "dots", "tangents_by"]

AT_ONCE = 8
"""Tangents that are carried along together, which bounds the memory."""


@attrs.frozen(eq=False)
class Tangents:
    """A hull at a floating position, with tangents by some parameters of its shape.

    Attributes
    ----------
    first : int
        Which of all parameters is the first of these.
    shapes : tuple of k Shape
        The parameters.
    varied : Varied
        The hull.
    planes : Planes
        Where it floats; with tangents where the position changes.
    header : HydrostaticHeader
        Its dimensions; with tangents where these change.
    values : dict of (d,)
        Every value of the record.
    """

    first: int
    shapes: tuple[Shape, ...]
    varied: Varied
    planes: Planes
    header: HydrostaticHeader
    values: Values

    @property
    def where(self) -> slice:
        """The places of these parameters among all."""
        return slice(self.first, self.first + len(self.shapes))


def tangents_by(
    body: Flotation,
    planes: Planes,
    header: HydrostaticHeader,
    shapes: Sequence[Shape],
    *,
    sinks: bool = False,
) -> Iterator[Tangents]:
    """Carry parameters of the shape through hydrostatics, `AT_ONCE` at a time.

    Parameters
    ----------
    body : Flotation
        The hull.
    planes : Planes
        Where it floats: one plane.
    header : HydrostaticHeader
        Dimensions, water and what counts.
    shapes : sequence of Shape
        The parameters, whose rates of length and breadth enter coefficients.
    sinks : bool
        The plane goes along with the design draught; else draughts at the perpendiculars stay.
    """
    for first in range(0, len(shapes), AT_ONCE):
        some = tuple(shapes[first : first + AT_ONCE])
        varied = varied_by(body, some)
        sized, tilted = _sized(header, some), _tilted(planes, header.length, some, sinks)
        values = values_at(varied, tilted, sized)
        yield Tangents(first, some, varied, tilted, sized, values)


def carried(value: float, rates: Sequence[float]) -> float:
    """Give a number with its tangents; as it is where none of them is other than nil."""
    dot = np.array(rates, np.float64)
    return Dual(value, dot) if dot.any() else value  # type: ignore[return-value]


def _sized(header: HydrostaticHeader, shapes: Sequence[Shape]) -> HydrostaticHeader:
    sizes: Mapping[str, Any] = {
        name: carried(getattr(header, name), [getattr(each.rates, name) for each in shapes])
        for name in ("length", "breadth", "draught")
    }
    return attrs.evolve(header, **sizes)


def _tilted(plane: Planes, length: float, shapes: Sequence[Shape], sinks: bool) -> Planes:
    """Let a plane rise with the draught, and turn where it has trim and the length changes."""
    sinking, longer = (
        np.array([getattr(each.rates, name) for each in shapes])[:, None]
        for name in ("draught", "length")
    )
    turn = -plane.tan_trim * longer / length
    height = Dual(plane.height, sinking * np.ones(1)) if sinks and sinking.any() else plane.height
    trim = Dual(plane.tan_trim, turn) if turn.any() else plane.tan_trim
    return attrs.evolve(plane, height=_array(height), tan_trim=_array(trim))


def _array(given: Dual | FloatArray) -> FloatArray:
    return as_array(given) if isinstance(given, Dual) else given


def dots(value: Any, count: int) -> FloatArray:
    """Give the tangents of a number, or of that of one plane, (count,); nan where it is nan."""
    dot = value.dot.reshape(count, -1)[:, 0] if isinstance(value, Dual) else np.zeros(count)
    return np.where(np.isnan(real(value).ravel()[0]), np.nan, dot)
