"""As much of a hull as carries tangents, for the entries of the catalogue.

It answers like a `Shape` where it can; an entry that asks for more is told so by
`SearchedForError`, and has to be differentiated otherwise.
"""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, NoReturn

import attrs
import numpy as np

from assoc_hull.analysis.derivatives.tangents import Tangents, carried
from assoc_hull.analysis.form.largest_section import largest_section, parallel_body
from assoc_hull.analysis.form.shape import STATIONS, Shape
from assoc_hull.analysis.form.slices import slices
from assoc_hull.geometry.floating.varied_slices import area_with_tangents, slice_with_tangents
from assoc_hull.geometry.numeric.dual import real

__all__ = ["CarriedShape", "SearchedForError"]


class SearchedForError(Exception):
    """An entry wants more of a hull than carries tangents; it never leaves this package."""


class _Told:
    """What is not known here is searched for."""

    def __getattr__(self, name: str) -> NoReturn:
        raise SearchedForError(name)


@attrs.frozen(eq=False, slots=False)
class CarriedShape(_Told):
    """An upright hull whose numbers carry k tangents.

    Attributes
    ----------
    plain : Shape
        The hull in plain numbers.
    some : Tangents
        The hull with tangents.
    record : namespace
        Hydrostatics; None where there is no value.
    depth : float or Dual, m
        Moulded.
    """

    plain: Shape
    some: Tangents
    record: SimpleNamespace
    depth: Any
    _kept: dict[object, Any] = attrs.field(factory=dict, init=False, repr=False)

    @classmethod
    def of(cls, shape: Shape, some: Tangents) -> CarriedShape:
        """Let a shape carry tangents."""
        values = {name: value[0] for name, value in some.values.items()}
        lacking = {name: None if np.isnan(real(each)) else each for name, each in values.items()}
        depth = carried(shape.depth, [each.depth for each in some.rates])
        return cls(shape, some, SimpleNamespace(**lacking), depth)

    @property
    def length(self) -> Any:
        """Lpp, m."""
        return self.some.header.length

    @property
    def breadth(self) -> Any:
        """B, moulded, m."""
        return self.some.header.breadth

    @property
    def draught(self) -> Any:
        """T, the mean of T_A and T_F, m."""
        aft, fore = self.some.draughts[:2]
        return carried(self.plain.draught, 0.5 * (aft + fore))

    @property
    def position(self) -> SimpleNamespace:
        """Draughts at the perpendiculars, m."""
        where, (aft, fore, _) = self.plain.position, self.some.draughts
        return SimpleNamespace(
            draught_aft=carried(where.draught_aft, aft),
            draught_fore=carried(where.draught_fore, fore),
        )

    def x_of(self, station: float) -> Any:
        """Give where a station is, m from AP."""
        return station * self.length / STATIONS

    def take(self, measure: object) -> Any:
        """Give what a measure says of this hull, if that carries tangents; it is asked once."""
        if measure not in _MEASURES:
            raise SearchedForError(str(measure))
        if measure not in self._kept:
            self._kept[measure] = _MEASURES[measure](self)
        return self._kept[measure]


@attrs.frozen(eq=False, slots=False)
class _CarriedSlices(_Told):
    """Parts of a hull, as `Slices`."""

    shape: CarriedShape
    _kept: dict[object, Any] = attrs.field(factory=dict, init=False, repr=False)

    def aft_of(self, x: Any) -> SimpleNamespace:
        return self._part(-np.inf, x)

    def forward_of(self, x: Any) -> SimpleNamespace:
        return self._part(x, np.inf)

    def area(self, x: Any) -> Any:
        return _area(self.shape, x)

    def runs_back(self, x: Any) -> bool:
        return self.shape.plain.take(slices).runs_back(float(real(x)))

    def _part(self, aft: Any, fore: Any) -> SimpleNamespace:
        key = float(real(aft)), float(real(fore))
        if key not in self._kept:
            body, some = self.shape.plain.body, self.shape.some
            strips = some.body.prepared.strips
            found = slice_with_tangents(body.spans, strips, aft, fore, some.planes)
            if found is None:
                raise SearchedForError("a raked part")
            sums = attrs.asdict(found, recurse=False)
            self._kept[key] = SimpleNamespace(**{name: each[0] for name, each in sums.items()})
        kept: SimpleNamespace = self._kept[key]
        return kept


def _area(shape: CarriedShape, x: Any) -> Any:
    some, body = shape.some, shape.plain.body
    found = area_with_tangents(body.spans, some.body.prepared.strips, x, some.planes)
    if found is None:
        raise SearchedForError("a raked section")
    return found


@attrs.frozen(eq=False, slots=False)
class _CarriedLargest(_Told):
    """The largest section: as its area is greatest, it matters not that its place moves."""

    largest: Any


def _largest(shape: CarriedShape) -> _CarriedLargest:
    return _CarriedLargest(_area(shape, shape.plain.take(largest_section).x_largest))


def _parallel(shape: CarriedShape) -> _CarriedLargest:
    if not shape.plain.even_keel:
        raise SearchedForError("parallel body at another plane")
    return shape.take(largest_section)  # type: ignore[no-any-return]


_MEASURES: dict[object, Any] = {
    slices: _CarriedSlices, largest_section: _largest, parallel_body: _parallel
}  # fmt: skip
