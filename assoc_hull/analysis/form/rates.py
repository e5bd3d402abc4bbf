"""How form parameters change with parameters of the hull's shape.

What follows from the record of hydrostatics and the principal dimensions by formulas of the
catalogue is differentiated exactly: the formulas run on numbers that carry tangents. So are
volumes and waterplanes aft and forward of a station, and areas of sections. Other measures look
for places (where the parallel body ends, how a waterline runs); they are taken of hulls whose
points have moved a little to either side, at two distances, and the differences extrapolated to
nil after Richardson.

Source: L.F. Richardson, "The approximate arithmetical solution by finite differences", Phil.
Trans. A 210 (1911) 307-357.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import attrs
import numpy as np

from assoc_hull.analysis.derivatives.reused_layout import moved
from assoc_hull.analysis.derivatives.tangents import Tangents, dots
from assoc_hull.analysis.form.carried import CarriedShape, SearchedForError
from assoc_hull.analysis.form.catalogue import CATALOGUE
from assoc_hull.analysis.form.evaluate import evaluate
from assoc_hull.analysis.form.parameter import SHAPE, Parameter
from assoc_hull.analysis.form.shape import Shape
from assoc_hull.analysis.form.value import Absent, Warned
from assoc_hull.analysis.hydrostatics.floating import FloatingPosition
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.numeric.dual import Dual

__all__ = ["FormRates", "form_rates"]

_STEP = 2e-5
"""Of Lpp: so far the point that moves most goes in the longer of the two steps."""

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


def form_rates(symbols: Iterable[str], shape: Shape, some: Tangents) -> FormRates:
    """Differentiate form parameters.

    Parameters
    ----------
    symbols : iterable of str
        Entries of the catalogue that the hull has.
    shape : Shape
        The hull, upright.
    some : Tangents
        The same, with tangents by k parameters, none of which heels it.
    """
    wanted, count = tuple(symbols), some.count
    found = _Walk(CarriedShape.of(shape, some))
    searched = {each: tuple(found.searched(each)) for each in wanted}
    leaves = sorted({leaf for every in searched.values() for leaf in every})
    if leaves:
        known = evaluate(CATALOGUE, leaves, shape, {})
        found.known.update(_differences(leaves, known, shape, some))
    rates = {each: dots(found.value(each), count) for each in wanted}
    return FormRates(rates, frozenset(each for each in wanted if not searched[each]))


@attrs.frozen(eq=False)
class _Walk:
    """Values of entries with tangents, each once."""

    shape: CarriedShape
    known: dict[str, Any] = attrs.field(factory=dict)

    def searched(self, symbol: str) -> Iterator[str]:
        """Give the entries below one that cannot be computed with tangents."""
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

    def _computed(self, entry: Parameter) -> Any:
        taken = [self.shape if need == SHAPE else self.value(need) for need in entry.needs]
        found = entry.compute(*taken)
        if isinstance(found, Absent):
            return np.nan
        return found.number if isinstance(found, Warned) else found


def _differences(
    leaves: Iterable[str], known: Mapping[str, Any], shape: Shape, some: Tangents
) -> dict[str, Any]:
    """Give values of entries, with tangents from differences."""
    names = tuple(leaves)
    dot = np.stack([_difference(names, shape, some, k) for k in range(some.count)])
    return {
        name: Dual(np.float64(_number(known[name].number)), dot[:, i])
        for i, name in enumerate(names)
    }


def _difference(names: tuple[str, ...], shape: Shape, some: Tangents, k: int) -> FloatArray:
    """Give the derivatives of entries by one parameter, (n,)."""
    step = _step(shape, some, k)
    total = np.zeros(len(names))
    if step == 0.0:
        return total
    for times, weight in _RULE.items():
        values = evaluate(CATALOGUE, names, _moved(shape, some, k, times * step), {})
        total += weight / step * np.array([_number(values[name].number) for name in names])
    return total


def _step(shape: Shape, some: Tangents, k: int) -> float:
    """Give the shorter step of a parameter; nil for one that moves nothing."""
    points = np.zeros(1) if some.moving is None else some.moving.points[k]
    rates = attrs.astuple(some.rates[k])
    most = max(
        float(np.abs(each).max(initial=0.0)) for each in (points, some.draughts[:, k], rates)
    )
    return 0.5 * _STEP * shape.length / most if most > 0.0 else 0.0


def _moved(shape: Shape, some: Tangents, k: int, step: float) -> Shape:
    """Give the hull where one parameter has changed a little."""
    rates, header, body = some.rates[k], shape.header, shape.body
    if some.moving is not None:
        body = moved(body, *some.moving.stepped(k, step))
    sized = attrs.evolve(
        header,
        length=header.length + step * rates.length,
        breadth=header.breadth + step * rates.breadth,
        draught=header.draught + step * rates.draught,
    )
    was = attrs.astuple(shape.position)
    position = FloatingPosition(*(was + step * some.draughts[:, k]).tolist())
    return Shape(body, sized, position, shape.depth + step * rates.depth, shape.screw)


def _number(given: float | None) -> float:
    return np.nan if given is None else given
