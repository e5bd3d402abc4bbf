"""Many variants of one hull: what fields do at its places is computed once.

Fields of one layer add, and each is linear in its amplitude. So with the unit displacements phi_k
of given places kept, a variant is ``P + sum_k lambda_k phi_k(P)``: one multiply-add for each
amplitude, at the places and for the coordinates that anything moves at all.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import numbers, places
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.variation.layer import Layer

__all__ = ["FieldPlan", "Moving"]

_BLOCK = 1 << 14
"""So many numbers are worked on at once: they stay in the fast memory."""


@attrs.frozen(eq=False)
class Moving:
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

    def at(self, amplitudes: FloatArray) -> FloatArray:
        """Give the coordinate in variants: amplitudes (m, k) to (m, t), m."""
        count = len(amplitudes)
        found = np.empty((count, len(self.rows)))
        together = max(1, _BLOCK // max(1, len(self.rows)))
        spare = np.empty((min(count, together), len(self.rows)))
        for first in range(0, count, together):
            part = amplitudes[first : first + together]
            into, more = found[first : first + together], spare[: len(part)]
            np.multiply(part[:, :1], self.weights[0], out=into)
            for k in range(1, len(self.weights)):
                into += np.multiply(part[:, k : k + 1], self.weights[k], out=more)
            into += self.start
        return found


@attrs.frozen(eq=False)
class FieldPlan:
    """Unit displacements of a layer's fields at given places.

    Attributes
    ----------
    xyz : (n, 3), m
        The places in the parent.
    count : int
        Number of amplitudes.
    moving : tuple of Moving
        What moves, at most one for each coordinate.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.chain import Chain
    >>> from assoc_hull.variation.fields_layer import FieldLayer
    >>> from assoc_hull.variation.hat import hat
    >>> from assoc_hull.variation.weights import FieldPlan
    >>> fade = Chain.through([6, 66], [1, 0])
    >>> shaft = hat("shaft", [("base", 0, 0), ("shaft", 5, 1), ("T", 18, 0)], fade)
    >>> parent = np.array([[6.0, 0.7, 5.0], [200.0, 20.0, 5.0]])
    >>> plan = FieldPlan.of([FieldLayer("shaft", (shaft,))], parent)
    >>> plan.places([0.5]).tolist()
    [[6.0, 0.7, 5.5], [200.0, 20.0, 5.0]]
    """

    xyz: FloatArray
    count: int
    moving: tuple[Moving, ...]

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
                found.append(Moving(axis, rows, given[rows, axis], weights))
        return cls(given, len(units), tuple(found))

    def places(self, amplitudes: ArrayLike) -> FloatArray:
        """Give the places of one variant, (n, 3), m, frozen; what does not move keeps its bits.

        Parameters
        ----------
        amplitudes : (k,)
            One for each layer.

        Raises
        ------
        BadInputError
            Another number of amplitudes, or not finite.
        """
        given = self._checked(numbers(amplitudes, "amplitudes", "in a plan of fields")[None])
        found = self.xyz.copy()
        for each in self.moving:
            found[each.rows, each.axis] = each.at(given)[0]
        freeze(found)
        return found

    def batch(self, amplitudes: ArrayLike) -> tuple[FloatArray, ...]:
        """Give what moves in many variants.

        Parameters
        ----------
        amplitudes : (m, k)
            Variant by variant.

        Returns
        -------
        tuple of (m, t) arrays, m
            For each of `moving`, its coordinate of its places; all other numbers are those of the
            parent. Bit for bit what `places` gives.

        Raises
        ------
        BadInputError
            Another number of amplitudes, or not finite.
        """
        given = self._checked(np.asarray(amplitudes, np.float64))
        return tuple(each.at(given) for each in self.moving)

    def _checked(self, given: FloatArray) -> FloatArray:
        if given.ndim != 2 or given.shape[1] != self.count or not np.isfinite(given).all():
            raise BadInputError(
                f"amplitudes of shape {given.shape}, or not finite", "in a plan of fields",
                f"give {self.count} for each variant",
            )  # fmt: skip
        return given
