"""How form parameters change with parameters of the hull's shape.

What follows by formulas is differentiated exactly: entries run on a `TangentShape`, as much of a
hull as carries tangents; volumes and waterplanes aft and forward of a station and areas of sections
count among these. An entry that searches for a place (where the parallel body ends) raises
`SearchedForError` there, which never leaves this module; it is differentiated by central
differences.

Source: L.F. Richardson, "The approximate arithmetical solution by finite differences", Phil. Trans.
A 210 (1911) 307-357.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from types import SimpleNamespace
from typing import Any, NoReturn

import attrs
import numpy as np

from assoc_hull.analysis.derivatives.hydrostatic_derivatives import (
    TangentHull,
    tangents_of,
    with_tangents,
)
from assoc_hull.analysis.derivatives.reused_layout import flotation_at_points
from assoc_hull.analysis.form.floating_shape import STATIONS, FloatingShape
from assoc_hull.analysis.form.form_parameters import CATALOGUE
from assoc_hull.analysis.form.longitudinal_parts import largest_section, parallel_body, ship_slices
from assoc_hull.analysis.form.parameter import SHAPE, Absent, FormParameter, Warned, evaluate
from assoc_hull.analysis.hydrostatics.floating_body import FloatingPosition
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.floating.sections import area_with_tangents, slice_with_tangents
from assoc_hull.geometry.numeric.dual import Dual, real

__all__ = [
    "FormRates",
    "SearchedForError",
    "TangentShape",
    "form_rates",
]

# --------------------------------------------------------------------------------------
# As much of a hull as carries tangents. It answers like a `FloatingShape` where it can.


class SearchedForError(Exception):
    """An entry wants more of a hull than carries tangents; it never leaves this package."""


class _Unknown:
    """What is not known here is searched for."""

    def __getattr__(self, name: str) -> NoReturn:
        raise SearchedForError(name)


@attrs.frozen(eq=False, slots=False)
class TangentShape(_Unknown):
    """An upright hull whose numbers carry k tangents.

    Attributes
    ----------
    plain : FloatingShape
        The hull in plain numbers.
    some : TangentHull
        The hull with tangents.
    record : namespace
        Hydrostatics; None where there is no value.
    depth : float or Dual, m
        Moulded.
    """

    plain: FloatingShape
    some: TangentHull
    record: SimpleNamespace
    depth: Any
    _kept: dict[object, Any] = attrs.field(factory=dict, init=False, repr=False)

    @classmethod
    def of(cls, shape: FloatingShape, some: TangentHull) -> TangentShape:
        """Let a shape carry tangents."""
        values = {name: value[0] for name, value in some.values.items()}
        lacking = {name: None if np.isnan(real(each)) else each for name, each in values.items()}
        depth = with_tangents(shape.depth, [each.depth for each in some.rates])
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
        return with_tangents(self.plain.draught, 0.5 * (aft + fore))

    @property
    def position(self) -> SimpleNamespace:
        """Draughts at the perpendiculars, m."""
        where, (aft, fore, _) = self.plain.position, self.some.draughts
        return SimpleNamespace(
            draught_aft=with_tangents(where.draught_aft, aft),
            draught_fore=with_tangents(where.draught_fore, fore),
        )

    def x_of(self, station: float) -> Any:
        """Give where a station is, m from AP."""
        return station * self.length / STATIONS

    def take(self, measure: object) -> Any:
        """Give what a measure returns for this hull, if that carries tangents; called once."""
        if measure not in _MEASURES:
            raise SearchedForError(str(measure))
        if measure not in self._kept:
            self._kept[measure] = _MEASURES[measure](self)
        return self._kept[measure]


@attrs.frozen(eq=False, slots=False)
class _TangentSlices(_Unknown):
    """Parts of a hull, as `ShipSlices`."""

    shape: TangentShape
    _kept: dict[object, Any] = attrs.field(factory=dict, init=False, repr=False)

    def aft_of(self, x: Any) -> SimpleNamespace:
        return self._part(-np.inf, x)

    def forward_of(self, x: Any) -> SimpleNamespace:
        return self._part(x, np.inf)

    def area(self, x: Any) -> Any:
        return _area(self.shape, x)

    def runs_back(self, x: Any) -> bool:
        return self.shape.plain.take(ship_slices).runs_back(float(real(x)))

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


def _area(shape: TangentShape, x: Any) -> Any:
    some, body = shape.some, shape.plain.body
    found = area_with_tangents(body.spans, some.body.prepared.strips, x, some.planes)
    if found is None:
        raise SearchedForError("a raked section")
    return found


@attrs.frozen(eq=False, slots=False)
class _TangentLargest(_Unknown):
    """The largest section: an area that is greatest does not change as its place moves."""

    largest: Any


def _largest(shape: TangentShape) -> _TangentLargest:
    return _TangentLargest(_area(shape, shape.plain.take(largest_section).x_largest))


def _parallel(shape: TangentShape) -> _TangentLargest:
    if not shape.plain.even_keel:
        raise SearchedForError("parallel body at another plane")
    return shape.take(largest_section)  # type: ignore[no-any-return]


_MEASURES: dict[object, Any] = {
    ship_slices: _TangentSlices, largest_section: _largest, parallel_body: _parallel
}  # fmt: skip


# --------------------------------------------------------------------------------------
# Derivatives. What carries no tangents is taken of hulls whose points have moved a little to either
# side, at two distances, and the differences extrapolated after Richardson.

_STEP = 2e-5
"""Of Lpp: how far the point that moves most goes in the longer of the two steps."""

_RULE = {2: -1.0 / 12.0, 1: 8.0 / 12.0, -1: -8.0 / 12.0, -2: 1.0 / 12.0}
"""Central differences at h and 2 h, extrapolated: exact up to the fourth power."""


@attrs.frozen(eq=False)
class FormRates:
    """Derivatives of form parameters by k parameters of the shape.

    Attributes
    ----------
    rates : mapping of str to (k,)
        By symbol, in the unit of the form parameter per unit of each parameter; nan where a hull
        that has moved a little lacks it.
    exact : frozenset of str
        Those that hang on no difference.
    """

    rates: Mapping[str, FloatArray]
    exact: frozenset[str]


def form_rates(symbols: Iterable[str], shape: FloatingShape, some: TangentHull) -> FormRates:
    """Differentiate form parameters by k parameters, none of which heels the hull.

    `shape` is the hull in plain numbers, upright, `some` the same with tangents.
    """
    wanted, count = tuple(symbols), some.count
    found = _Walk(TangentShape.of(shape, some))
    searched = {each: tuple(found.searched(each)) for each in wanted}
    leaves = sorted({leaf for every in searched.values() for leaf in every})
    if leaves:
        known = evaluate(CATALOGUE, leaves, shape, {})
        found.known.update(_differences(leaves, known, shape, some))
    rates = {each: tangents_of(found.value(each), count) for each in wanted}
    return FormRates(rates, frozenset(each for each in wanted if not searched[each]))


@attrs.frozen(eq=False)
class _Walk:
    """Values of entries with tangents, each once."""

    shape: TangentShape
    known: dict[str, Any] = attrs.field(factory=dict)

    def searched(self, symbol: str) -> Iterator[str]:
        """Give the entries that this one rests on and that cannot be computed with tangents."""
        entry = CATALOGUE[symbol]
        if SHAPE in entry.needs:
            try:
                self.value(symbol)
            except SearchedForError:
                yield symbol
            return
        for need in entry.needs:
            yield from self.searched(need)

    def value(self, symbol: str) -> Any:
        """Give a value; nan where there is none."""
        if symbol not in self.known:
            self.known[symbol] = self._computed(CATALOGUE[symbol])
        return self.known[symbol]

    def _computed(self, entry: FormParameter) -> Any:
        taken = [self.shape if need == SHAPE else self.value(need) for need in entry.needs]
        found = entry.compute(*taken)
        if isinstance(found, Absent):
            return np.nan
        return found.number if isinstance(found, Warned) else found


def _differences(
    leaves: Iterable[str], known: Mapping[str, Any], shape: FloatingShape, some: TangentHull
) -> dict[str, Any]:
    """Give values of entries, with tangents from differences."""
    names = tuple(leaves)
    dot = np.stack([_difference(names, shape, some, k) for k in range(some.count)])
    return {
        name: Dual(np.float64(_number(known[name].number)), dot[:, i])
        for i, name in enumerate(names)
    }


def _difference(
    names: tuple[str, ...], shape: FloatingShape, some: TangentHull, k: int
) -> FloatArray:
    """Give the derivatives of entries by one parameter, (n,)."""
    step = _step(shape, some, k)
    total = np.zeros(len(names))
    if step == 0.0:
        return total
    for times, weight in _RULE.items():
        values = evaluate(CATALOGUE, names, _moved(shape, some, k, times * step), {})
        total += weight / step * np.array([_number(values[name].number) for name in names])
    return total


def _step(shape: FloatingShape, some: TangentHull, k: int) -> float:
    """Give the shorter step of a parameter; 0 for one that moves nothing."""
    points = np.zeros(1) if some.moving is None else some.moving.points[k]
    rates = attrs.astuple(some.rates[k])
    most = max(
        float(np.abs(each).max(initial=0.0)) for each in (points, some.draughts[:, k], rates)
    )
    return 0.5 * _STEP * shape.length / most if most > 0.0 else 0.0


def _moved(shape: FloatingShape, some: TangentHull, k: int, step: float) -> FloatingShape:
    """Give the hull where one parameter has changed a little."""
    rates, header, body = some.rates[k], shape.header, shape.body
    if some.moving is not None:
        body = flotation_at_points(body, *some.moving.stepped(k, step))
    sized = attrs.evolve(
        header,
        length=header.length + step * rates.length,
        breadth=header.breadth + step * rates.breadth,
        draught=header.draught + step * rates.draught,
    )
    was = attrs.astuple(shape.position)
    position = FloatingPosition(*(was + step * some.draughts[:, k]).tolist())
    return FloatingShape(body, sized, position, shape.depth + step * rates.depth, shape.screw)


def _number(given: float | None) -> float:
    return np.nan if given is None else given
