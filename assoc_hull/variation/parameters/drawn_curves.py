"""The drawn curves of a hull, as its named parameters are measured on them."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import cached_property
from typing import TypeVar, cast

import attrs
import numpy as np

from assoc_hull.analysis.net.gather import Net, gather
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.polylines.flats import fit_plane
from assoc_hull.geometry.splines.plane_places import Places, across, turning_places
from assoc_hull.model.state import HullState, Particulars

__all__ = ["Drawn"]

Measured = TypeVar("Measured")


@attrs.frozen(eq=False)
class Drawn:
    """The curves of a hull.

    Attributes
    ----------
    state : HullState
        Its tables.
    """

    state: HullState
    _kept: dict[object, object] = attrs.field(factory=dict, init=False, repr=False)

    def take(self, measure: Callable[[Drawn], Measured]) -> Measured:
        """Give what a measure says of this hull; it is asked once."""
        if measure not in self._kept:
            self._kept[measure] = measure(self)
        return cast(Measured, self._kept[measure])

    @cached_property
    def net(self) -> Net:
        """The curves as arrays."""
        return gather(self.state)

    @property
    def ship(self) -> Particulars:
        """The stored particulars."""
        return self.state.particulars

    @property
    def length(self) -> float:
        """Lpp, m: x of FP."""
        return self.ship.length

    @property
    def middle(self) -> float:
        """Where midship is, m from AP."""
        return 0.5 * self.ship.length

    def one(self, curve: int) -> SplineBatch:
        """Give a curve of the net."""
        return self.net.batch.part(curve, curve + 1)

    def some(self, curves: Iterable[int]) -> SplineBatch:
        """Give curves of the net."""
        return SplineBatch.join([self.one(curve) for curve in curves])

    def keys(self, curves: Iterable[int]) -> tuple[str, ...]:
        """Give the keys of curves."""
        return tuple(str(self.state.curves.key.data[self.net.curve[i]]) for i in curves)

    def across(self, curves: Iterable[int], axis: int, value: float) -> Places:
        """Give where curves have an x (axis 0), y or z, m; `Places.curve` counts in `curves`."""
        chosen = list(curves)
        return across(self.some(chosen) if chosen else _NOTHING, axis, value)

    def extreme(self, curves: Iterable[int], axis: int, sense: float = 1.0) -> FloatArray:
        """Give the place, (3,), m, at which curves have the greatest x, y or z; -1: the least."""
        places = np.concatenate(turning_places(self.some(curves), axis))
        found: FloatArray = places[int((sense * places[:, axis]).argmax())]
        return found

    # Which curve is what.

    @cached_property
    def profile(self) -> list[int]:
        """The curves of the centre plane at which the hull ends."""
        return np.flatnonzero(self.net.end & self.net.centre).tolist()

    @cached_property
    def deck_edge(self) -> list[int]:
        """The curves at which the hull ends off the centre plane, but for flat ends."""
        ends = self.net.end & ~self.net.centre & ~np.isfinite(self.net.x)
        return np.flatnonzero(ends).tolist()

    @cached_property
    def flats_of_bottom(self) -> list[int]:
        """The borders of flats that lie level, or nearly."""
        return [i for i in self._flats if self._outward(i) == 2]

    @cached_property
    def flats_of_side(self) -> list[int]:
        """The borders of flats that stand upright along the ship, or nearly."""
        return [i for i in self._flats if self._outward(i) == 1]

    @property
    def _flats(self) -> list[int]:
        return np.flatnonzero(self.net.flat).tolist()

    def _outward(self, curve: int) -> int:
        """Give the axis that the plane through a curve is most nearly square to."""
        normal = self.net.normal[curve]
        if np.isnan(normal).any():
            normal = fit_plane(self.one(curve).xyz, 0.0)[0]
        return int(np.abs(normal).argmax())

    @cached_property
    def waterlines(self) -> IntArray:
        """The curves of waterlines."""
        return np.flatnonzero(np.array(self.net.family) == "waterlines")

    @cached_property
    def sections(self) -> IntArray:
        """The curves of sections that stand across the ship."""
        return np.flatnonzero(np.isfinite(self.net.x) & ~self.net.end)

    @cached_property
    def section_amidships(self) -> int | None:
        """The longest curve of the section nearest to midship; of two as near, of the aft one."""
        if not len(self.sections):
            return None
        off = np.abs(self.net.x[self.sections] - self.middle)
        nearest = self.sections[off <= off.min() + 1e-9]
        x = self.net.x[nearest].min()
        there: list[int] = nearest[self.net.x[nearest] == x].tolist()
        return max(there, key=self.net.length)


_NOTHING = SplineBatch(
    np.zeros(1, np.int64), np.zeros(0), np.zeros((0, 3)), np.zeros((0, 3)), np.zeros((0, 3))
)
"""No curve at all."""
