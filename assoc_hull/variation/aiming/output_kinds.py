"""What can be aimed at, kind by kind: values of a hull, and their derivatives.

A `Kind` takes keys of its own (the field, the station, ...) and works on all of them together,
as they share what is measured.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Protocol

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.derivatives.tangents import Tangents, dots
from assoc_hull.analysis.form.catalogue import CATALOGUE
from assoc_hull.analysis.form.evaluate import evaluate
from assoc_hull.analysis.form.rates import form_rates
from assoc_hull.analysis.form.shape import Shape
from assoc_hull.analysis.form.slices import slices
from assoc_hull.analysis.hydrostatics.record_fields import FIELDS
from assoc_hull.errors import BadInputError, UnknownNameError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.floating.varied_slices import area_with_tangents

__all__ = ["KINDS", "Kind", "Rates"]

_WHERE = "among the outputs"

Rates = tuple[FloatArray, NDArray[np.bool_]]
"""Derivatives (n, k), and (n,) which of the n outputs hang on no differences."""


class Kind(Protocol):
    """Outputs of one kind; a key is text."""

    def unit(self, key: str) -> str:
        """Give the unit of an output."""
        ...

    def values(self, keys: Sequence[str], shape: Shape) -> FloatArray:
        """Give the outputs of a hull, (n,).

        Raises
        ------
        BadInputError, UnknownNameError
            The hull has no such value.
        """
        ...

    def rates(self, keys: Sequence[str], shape: Shape, some: Tangents) -> Rates:
        """Give their derivatives by k parameters of the shape."""
        ...


def _lacks(name: str, why: str) -> BadInputError:
    return BadInputError(f"the hull has no {name!r}: {why}", _WHERE, "aim at something else")


def _exact(rows: Sequence[FloatArray]) -> Rates:
    return np.stack(rows), np.ones(len(rows), np.bool_)


@attrs.frozen
class _Fields:
    """Values of the record of hydrostatics."""

    def unit(self, key: str) -> str:
        return FIELDS[key].unit

    def values(self, keys: Sequence[str], shape: Shape) -> FloatArray:
        given = [getattr(shape.record, key) for key in keys]
        for key, value in zip(keys, given, strict=True):
            if value is None:
                raise _lacks(key, "no centre of gravity is given")
            if np.isnan(value):
                raise _lacks(key, "no waterplane")
        return np.array(given, np.float64)

    def rates(self, keys: Sequence[str], shape: Shape, some: Tangents) -> Rates:
        count = some.count
        return _exact([dots(some.values[key], count) for key in keys])


@attrs.frozen
class _Stations:
    """Immersed areas of sections as drawn, by name; a section that moves takes its name along."""

    def unit(self, key: str) -> str:
        return "m2"

    def values(self, keys: Sequence[str], shape: Shape) -> FloatArray:
        found = shape.body.stations(shape.planes)
        for key in keys:
            if key not in found.names:
                raise UnknownNameError("station", key, found.names)
        return np.array([found.area[0, found.names.index(key)] for key in keys])

    def rates(self, keys: Sequence[str], shape: Shape, some: Tangents) -> Rates:
        found = some.body.stations(some.planes)
        places = [found.names.index(key) for key in keys]
        return _exact([dots(found.area[0, i], some.count) for i in places])


@attrs.frozen
class _Places:
    """Immersed areas of the surface at fixed places along the ship, m from AP."""

    def unit(self, key: str) -> str:
        return "m2"

    def values(self, keys: Sequence[str], shape: Shape) -> FloatArray:
        found = np.array([shape.take(slices).area(float(key)) for key in keys])
        for key, area in zip(keys, found.tolist(), strict=True):
            if not area > 0.0:
                raise _lacks(f"A x={key}", "nothing is immersed there")
        return found

    def rates(self, keys: Sequence[str], shape: Shape, some: Tangents) -> Rates:
        strips, body = some.body.prepared.strips, shape.body.spans
        rows = [area_with_tangents(body, strips, float(key), some.planes) for key in keys]
        for key, row in zip(keys, rows, strict=True):
            if row is None:
                raise _lacks(f"A x={key}", "a raked end of the hull is there")
        return _exact([dots(row, some.count) for row in rows])


@attrs.frozen
class _Forms:
    """Form parameters of the catalogue."""

    def unit(self, key: str) -> str:
        return CATALOGUE[key].unit

    def values(self, keys: Sequence[str], shape: Shape) -> FloatArray:
        found = evaluate(CATALOGUE, keys, shape, {})
        for key, value in found.items():
            if value.number is None:
                raise _lacks(key, value.reason or "it cannot be told")
        return np.array([found[key].number for key in keys], np.float64)

    def rates(self, keys: Sequence[str], shape: Shape, some: Tangents) -> Rates:
        found = form_rates(keys, shape, some)
        exact = np.array([key in found.exact for key in keys], np.bool_)
        return np.stack([found.rates[key] for key in keys]), exact


KINDS: Mapping[str, Kind] = {
    "field": _Fields(), "station": _Stations(), "place": _Places(), "form": _Forms()
}  # fmt: skip
"""All kinds by name."""
