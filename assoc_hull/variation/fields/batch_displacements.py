"""Many variants of one hull: what fields do at its places is computed once.

Fields of one layer add, and each is linear in its amplitude. So with the unit displacements phi_k
of given places kept, a variant is ``P + sum_k lambda_k phi_k(P)``: one multiply-add for each
amplitude, at the places and for the coordinates that anything moves at all.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import places
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.variation.fields.layers import Layer

__all__ = ["FieldPlan", "MovingCoordinate"]

_BLOCK = 30
"""So many variants are worked on at once: they stay in the fast memory, on one core."""


@attrs.frozen(eq=False)
class MovingCoordinate:
    """One coordinate of the places that move along it.

    Attributes
    ----------
    axis : int
        0, 1, 2: x, y, z.
    rows : (t,) int
        The places, rising.
    start : (t,), m
        Their coordinate in the parent.
    weights : (k, t)
        Displacement (m) at amplitude 1, amplitude by amplitude.
    """

    axis: int
    rows: IntArray
    start: FloatArray
    weights: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.rows, self.start, self.weights)

    def one(self, amplitudes: Sequence[float]) -> FloatArray:
        """Give the coordinate in one variant, (t,), m."""
        found: FloatArray = self.weights[0] * amplitudes[0]
        for weights, amplitude in zip(self.weights[1:], amplitudes[1:], strict=True):
            found += weights * amplitude
        found += self.start
        return found

    def many(self, amplitudes: FloatArray, out: FloatArray) -> FloatArray:
        """Give the coordinate in variants: amplitudes (m, k) to `out` (m, t), m."""
        count, k = amplitudes.shape
        factors = np.ones((count, k + 1))
        factors[:, :k] = amplitudes
        whole = np.vstack([self.weights, self.start])
        for first in range(0, count, _BLOCK):
            some = slice(first, first + _BLOCK)
            np.matmul(factors[some], whole, out=out[some])
        return out


@attrs.frozen(eq=False)
class FieldPlan:
    """Unit displacements of a layer's fields at given places.

    Attributes
    ----------
    xyz : (n, 3), m
        The places in the parent.
    count : int
        Number of amplitudes.
    moving : tuple of MovingCoordinate
        What moves, at most one for each coordinate.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.fields.bounded_functions import BlendChain
    >>> from assoc_hull.variation.fields.layers import FieldLayer
    >>> from assoc_hull.variation.fields.anchor_fields import hat_field
    >>> from assoc_hull.variation.fields.batch_displacements import FieldPlan
    >>> fade = BlendChain.through([6, 66], [1, 0])
    >>> shaft = hat_field("shaft", [("base", 0, 0), ("shaft", 5, 1), ("T", 18, 0)], fade)
    >>> parent = np.array([[6.0, 0.7, 5.0], [200.0, 20.0, 5.0]])
    >>> plan = FieldPlan.of([FieldLayer("shaft", (shaft,))], parent)
    >>> plan.places([0.5]).tolist()
    [[6.0, 0.7, 5.5], [200.0, 20.0, 5.0]]
    """

    xyz: FloatArray
    count: int
    moving: tuple[MovingCoordinate, ...]

    @classmethod
    def of(cls, units: Sequence[Layer], xyz: ArrayLike) -> FieldPlan:
        """Compute what layers do at places.

        Parameters
        ----------
        units : sequence of Layer
            What each amplitude is multiplied with: all of them read the places of the parent.
        xyz : (n, 3), m
            Places of the parent.

        Raises
        ------
        BadInputError
            No layer, or places that are none.
        """
        if not len(units):
            raise BadInputError("no layer", "in a plan of fields", "give one for each amplitude")
        given = places(xyz, "xyz", "in a plan of fields").copy()
        freeze(given)
        moved = np.stack([layer.displacement(given) for layer in units])
        found = []
        for axis in range(3):
            rows = np.flatnonzero((moved[:, :, axis] != 0.0).any(axis=0))
            if len(rows):
                weights = np.ascontiguousarray(moved[:, rows, axis])
                found.append(MovingCoordinate(axis, rows, given[rows, axis], weights))
        return cls(given, len(units), tuple(found))

    def moved(self, amplitudes: Sequence[float] | FloatArray) -> tuple[FloatArray, ...]:
        """Give what moves in one variant.

        Parameters
        ----------
        amplitudes : (k,)
            One for each layer.

        Returns
        -------
        tuple of (t,) arrays, m
            For each of `moving`, its coordinate of its places.

        Raises
        ------
        BadInputError
            Another number of amplitudes, or not finite.
        """
        given = self._numbers(amplitudes)
        row: list[float] = given.tolist()
        if given.shape != (self.count,) or not all(map(isfinite, row)):
            raise self._refused(given)
        return tuple([each.one(row) for each in self.moving])

    def places(self, amplitudes: Sequence[float] | FloatArray) -> FloatArray:
        """Give the places of one variant, (n, 3), m, frozen; what does not move keeps its bits.

        Raises
        ------
        BadInputError
            As for `moved`.
        """
        found = self.xyz.copy()
        for each, values in zip(self.moving, self.moved(amplitudes), strict=True):
            found[each.rows, each.axis] = values
        freeze(found)
        return found

    def batch(
        self, amplitudes: ArrayLike, out: Sequence[FloatArray] | None = None
    ) -> tuple[FloatArray, ...]:
        """Give what moves in many variants.

        Parameters
        ----------
        amplitudes : (m, k)
            Variant by variant.
        out : sequence of (m, t) arrays or None
            Memory to be written to, as an earlier batch gave it: fresh memory is dear.

        Returns
        -------
        tuple of (m, t) arrays, m
            For each of `moving`, its coordinate of its places; all other numbers are those of the
            parent. It is what `moved` gives, to rounding.

        Raises
        ------
        BadInputError
            As for `moved`; memory of another shape.
        """
        given = self._numbers(amplitudes)
        if given.ndim != 2 or given.shape[1] != self.count or not np.isfinite(given).all():
            raise self._refused(given)
        shapes = [(len(given), len(each.rows)) for each in self.moving]
        memory = [np.empty(shape) for shape in shapes] if out is None else list(out)
        if [each.shape for each in memory] != shapes:
            raise BadInputError(
                f"memory of shapes {[each.shape for each in memory]}", "in a plan of fields",
                f"give {shapes}",
            )  # fmt: skip
        return tuple(each.many(given, into) for each, into in zip(self.moving, memory, strict=True))

    def _numbers(self, amplitudes: ArrayLike) -> FloatArray:
        try:
            return np.asarray(amplitudes, np.float64)
        except (TypeError, ValueError):
            raise self._refused(np.full(1, np.nan)) from None

    def _refused(self, given: FloatArray) -> BadInputError:
        return BadInputError(
            f"amplitudes of shape {given.shape}, or not finite", "in a plan of fields",
            f"give {self.count} for each variant",
        )  # fmt: skip
