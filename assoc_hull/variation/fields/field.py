"""Fields: displacements of one coordinate, laid out in the profile plane.

A field moves one coordinate c by ``u``, evaluated at the place before the map. A stack of boundary
curves ``h_0(x) < h_1(x) < ..`` divides the profile plane; each carries an affine piece, and
between two of them u goes over from one piece to the next. Boundary curves must not touch: their
least gap is found by bounds that cannot miss it, and a field without a gap is refused when it is
made. Lengths in m, x from AP forward, z from the base line up.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from itertools import pairwise
from typing import Literal

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields.bounded_functions import (
    QUINTIC,
    Blend,
    BlendChain,
    BoundedFunction,
)

__all__ = [
    "AffinePiece",
    "Axis",
    "Boundary",
    "FieldRegion",
    "StackedField",
    "Tube",
    "check_gaps",
    "least_gap",
    "level_boundaries",
    "nonzero_span",
]

# --------------------------------------------------------------------------------------
# The least gap of two boundary curves. Both give exact bounds of value and slope on any interval;
# an interval whose lower bound lies above the least gap found so far is left, every other one
# halved.

_NEAR = 1e-9
"""The least gap is known to so many m."""

_ROUNDS = 60


def least_gap(lower: BoundedFunction, upper: BoundedFunction) -> tuple[float, float]:
    """Give where one curve comes nearest to the one above it, and how near.

    Parameters
    ----------
    lower, upper : BoundedFunction
        Heights, m, over x.

    Returns
    -------
    x, gap : float, m
        The least gap to 1e-9 m; negative where the curves cross.

    Examples
    --------
    >>> from assoc_hull.variation.fields.bounded_functions import BlendChain
    >>> from assoc_hull.variation.fields.field import least_gap
    >>> x, gap = least_gap(BlendChain.constant(4.0), BlendChain.through([0, 10, 20], [6, 4.5, 7]))
    >>> round(x, 6), round(gap, 9)
    (10.0, 0.5)
    """
    nodes = np.unique(np.concatenate([lower.nodes, upper.nodes]))
    gaps = upper.at(nodes) - lower.at(nodes)
    first = int(np.argmin(gaps))
    place, least = float(nodes[first]), float(gaps[first])
    begin, end = nodes[:-1], nodes[1:]
    for _ in range(_ROUNDS):
        bound, middle, value = _bound(lower, upper, begin, end)
        if len(value) and value.min() < least:
            place, least = float(middle[value.argmin()]), float(value.min())
        # only what may hold a smaller gap is looked at again
        left = bound < least - _NEAR
        if not left.any():
            break
        begin, middle, end = begin[left], middle[left], end[left]
        begin, end = np.concatenate([begin, middle]), np.concatenate([middle, end])
    return place, least


def _bound(
    lower: BoundedFunction, upper: BoundedFunction, begin: FloatArray, end: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give the lower bound of the gap on intervals, their middles, and the gap there; (n,), m."""
    middle = 0.5 * (begin + end)
    value = upper.at(middle) - lower.at(middle)
    plain = upper.bounds(begin, end)[0] - lower.bounds(begin, end)[1]
    rise, fall = upper.slope_bounds(begin, end), lower.slope_bounds(begin, end)
    steepest = np.maximum(rise[1] - fall[0], fall[1] - rise[0])
    return np.maximum(plain, value - 0.5 * (end - begin) * steepest), middle, value


def check_gaps(field: str, stack: Sequence[tuple[str, BoundedFunction]]) -> None:
    """Refuse boundary curves of a field that touch or cross anywhere.

    Raises
    ------
    BadInputError
        With both names, the place and the gap there.
    """
    for (below, lower), (above, upper) in pairwise(stack):
        x, gap = least_gap(lower, upper)
        if not gap > _NEAR:
            raise BadInputError(
                f"boundary curves '{below}' and '{above}' of field '{field}' touch at x={x:.3f} "
                f"(gap {gap:.3g} m)", "in vary", "move one or reduce the range",
            )  # fmt: skip


# --------------------------------------------------------------------------------------
# With the pieces and the blend b,
#
#     e_k(x, c) = a_k(x) (c - p_k) + d_k(x)
#     u = e_k + (e_{k+1} - e_k) b(s),   s = (z - h_k) / (h_{k+1} - h_k)
#
# and u = e_0 below the stack, the last piece above it. With p = 0 and d = 0 this is the
# variation-ratio field of Choi & Lee, "A Study on the Hull Form Design System on the Basis of the
# Associative Geometry Objects", J. SNAK 36(4), 1999, section 3.4: a = ratio - 1. Pivot p and shift
# d let a field move a place at coordinate zero, and make a circle a circle.

Axis = Literal["x", "y", "z"]


@attrs.frozen(eq=False)
class Boundary:
    """A boundary curve of a stack.

    Attributes
    ----------
    name : str
        For messages: ``"T"``, ``"shaft+r"``.
    height : BoundedFunction
        h(x), m.
    """

    name: str
    height: BoundedFunction


@attrs.frozen(eq=False)
class AffinePiece:
    """An affine piece ``a(x) (c - pivot) + d(x)`` of a displacement, m.

    Attributes
    ----------
    a : BoundedFunction
        Departure: ratio - 1.
    pivot : float, m
    d : BoundedFunction
        Shift, m.
    """

    a: BoundedFunction
    pivot: float
    d: BoundedFunction

    @classmethod
    def along(cls, course: BoundedFunction, a: float, d: float, pivot: float = 0.0) -> AffinePiece:
        """Give a piece whose departure a and shift d (m) fade along the ship by one function."""
        return cls(course.scaled(a), pivot, course.scaled(d))

    def scaled(self, factor: float) -> AffinePiece:
        """Give the piece times a factor."""
        return AffinePiece(self.a.scaled(factor), self.pivot, self.d.scaled(factor))


@attrs.frozen
class Tube:
    """psi(y) in place of y: the identity within a radius, zero beyond n radii.

    It keeps the widening of a slender part, a bossing, from widening the hull beside it.

    Attributes
    ----------
    radius : float, m
    n : float
    blend : Blend
    """

    radius: float
    n: float = 6.0
    blend: Blend = QUINTIC

    def at(self, y: FloatArray) -> FloatArray:
        """Give psi, odd in y."""
        return np.asarray(y * (1.0 - self.blend.value(self._s(y))))

    def slope(self, y: FloatArray) -> FloatArray:
        """Give psi'."""
        s = self._s(y)
        fade = self.blend.slope(s) * np.abs(y) / (self.radius * (self.n - 1.0))
        return np.asarray(1.0 - self.blend.value(s) - fade)

    def _s(self, y: FloatArray) -> FloatArray:
        """Give the part of the fade: 0 at the radius, 1 at n radii."""
        s: FloatArray = (np.abs(y) / self.radius - 1.0) / (self.n - 1.0)
        return s


@attrs.frozen
class FieldRegion:
    """Where a layer may move anything: a box of the profile plane, m.

    Attributes
    ----------
    name : str
    x, z : (float, float), m
        Infinite where there is no end.
    """

    name: str
    x: tuple[float, float]
    z: tuple[float, float]


@attrs.frozen(eq=False)
class StackedField:
    """A field with a stack of boundaries.

    Attributes
    ----------
    name : str
    axis : {"x", "y", "z"}
        The coordinate that it moves.
    boundaries : tuple of Boundary
        From below.
    pieces : tuple of AffinePiece
        One a boundary. Those of a y-field have no pivot and no shift: the centre plane stays.
    blend : Blend
    tube : Tube or None
        For a y-field.
    """

    name: str
    axis: Axis
    boundaries: tuple[Boundary, ...]
    pieces: tuple[AffinePiece, ...]
    blend: Blend = QUINTIC
    tube: Tube | None = None

    def __attrs_post_init__(self) -> None:
        if len(self.boundaries) != len(self.pieces) or not self.pieces:
            raise BadInputError(
                f"field '{self.name}' has {len(self.boundaries)} boundary curves and "
                f"{len(self.pieces)} pieces", "in vary", "give one piece a boundary curve",
            )  # fmt: skip
        if self.axis == "y" and any(each.pivot or _acts(each.d) for each in self.pieces):
            raise BadInputError(
                f"field '{self.name}' shifts y", "in vary",
                "give ratios of y: the centre plane stays where it is",
            )  # fmt: skip

    @classmethod
    def checked(
        cls,
        name: str,
        axis: Axis,
        boundaries: Sequence[Boundary],
        pieces: Sequence[AffinePiece],
        *,
        blend: Blend = QUINTIC,
        tube: Tube | None = None,
    ) -> StackedField:
        """Take a field as a designer lays it out.

        Raises
        ------
        BadInputError
            Boundary curves that touch or cross anywhere along the ship; not one piece a
            boundary; a y-field that shifts.
        """
        check_gaps(name, [(each.name, each.height) for each in boundaries])
        return cls(name, axis, tuple(boundaries), tuple(pieces), blend, tube)

    def scaled(self, factor: float) -> StackedField:
        """Give the field with its displacement times a factor."""
        return attrs.evolve(self, pieces=tuple(each.scaled(factor) for each in self.pieces))

    def displacement(self, xyz: FloatArray) -> FloatArray:
        """Give u, (n,), m, at places (n, 3), m; only those in the region are evaluated."""
        some = self._touched(xyz)
        u = np.zeros(len(xyz))
        u[some] = self._displacement(xyz[some])
        return u

    def _touched(self, xyz: FloatArray) -> np.typing.NDArray[np.int64]:
        """Give which places lie in the region."""
        found = np.ones(len(xyz), bool)
        for axis, (low, high) in ((0, self._region.x), (2, self._region.z)):
            if low > -np.inf:
                found &= xyz[:, axis] >= low
            if high < np.inf:
                found &= xyz[:, axis] <= high
        return np.flatnonzero(found)

    def _displacement(self, xyz: FloatArray) -> FloatArray:
        """Give u at places in the region; pieces are evaluated only where they count."""
        x, z = xyz[:, 0], xyz[:, 2]
        c = self._own(xyz)
        low, s = self.strip(x, z)
        weight = self.blend.value(s)
        u = np.zeros(len(x))
        for k in range(len(self.pieces)):
            some = np.flatnonzero((low == k) | ((low == k - 1) & (weight > 0.0)))
            if not len(some):
                continue
            e = self._piece(k, x[some], c[some])
            own = low[some] == k
            part = np.where(own, 1.0 - weight[some], weight[some])
            # where the two pieces are equal, so is their blend, to the last bit
            u[some] = np.where(own, e, u[some] + (e - u[some]) * part)
        return u

    def gradient(self, xyz: FloatArray) -> FloatArray:
        """Give du/dx, du/dy, du/dz, (n, 3); only places in the region are evaluated."""
        some = self._touched(xyz)
        found = np.zeros((len(xyz), 3))
        found[some] = self._gradient(xyz[some])
        return found

    def _gradient(self, xyz: FloatArray) -> FloatArray:
        """Give the derivatives of u at places in the region, by the formulas of the module."""
        x, z, c = xyz[:, 0], xyz[:, 2], self._own(xyz)
        low, s = self.strip(x, z)
        high = np.minimum(low + 1, len(self.pieces) - 1)
        e, e_x, e_c = self._chosen(low, x, c)
        f, f_x, f_c = self._chosen(high, x, c)
        h, h_x = self._heights(low, x)
        g, g_x = (top - foot for top, foot in zip(self._heights(high, x), (h, h_x), strict=True))
        # below and above the stack there is one piece and no gap
        g = np.where(high > low, g, 1.0)
        b, turn = self.blend.value(s), self.blend.slope(s) * (f - e)
        own = e_c + (f_c - e_c) * b
        along = e_x + (f_x - e_x) * b - turn * (h_x + s * g_x) / g
        found = np.zeros((len(x), 3))
        found[:, 0] = along + (own if self.axis == "x" else 0.0)
        found[:, 2] = turn / g + (own if self.axis == "z" else 0.0)
        if self.axis == "y":
            found[:, 1] = own * (self.tube.slope(xyz[:, 1]) if self.tube else 1.0)
        return found

    def strip(self, x: FloatArray, z: FloatArray) -> tuple[np.typing.NDArray[np.int64], FloatArray]:
        """Find the boundary next below places, and where between it and the next they lie.

        Returns
        -------
        low : (n,) int
            The boundary next below; 0 below the stack.
        s : (n,)
            0 on it, 1 on the next above; 0 below and above the stack.
        """
        heights = np.array([each.height.at(x) for each in self.boundaries])
        low = np.maximum((heights <= z).sum(axis=0) - 1, 0)
        high = np.minimum(low + 1, len(heights) - 1)
        column = np.arange(len(x))
        foot, top = heights[low, column], heights[high, column]
        gap = np.where(top > foot, top - foot, 1.0)
        return low, np.where(top > foot, np.clip((z - foot) / gap, 0.0, 1.0), 0.0)

    def region(self) -> FieldRegion:
        """Give the box of the profile plane outside which u is exactly zero."""
        return self._region

    @cached_property
    def _region(self) -> FieldRegion:
        acts = [_acts(each.a) or _acts(each.d) for each in self.pieces]
        spans = [
            nonzero_span(part) for each in self.pieces for part in (each.a, each.d) if _acts(part)
        ]  # fmt: skip
        if not spans:
            return FieldRegion(self.name, (np.inf, -np.inf), (np.inf, -np.inf))
        x = min(each[0] for each in spans), max(each[1] for each in spans)
        first, last = acts.index(True), len(acts) - 1 - acts[::-1].index(True)
        everywhere = np.array(-np.inf), np.array(np.inf)
        low, high = -np.inf, np.inf
        if first > 0:
            low = float(self.boundaries[first - 1].height.bounds(*everywhere)[0])
        if last < len(acts) - 1:
            high = float(self.boundaries[last + 1].height.bounds(*everywhere)[1])
        return FieldRegion(self.name, x, (low, high))

    def _own(self, xyz: FloatArray) -> FloatArray:
        """Give the coordinate that the pieces act on."""
        c = xyz[:, "xyz".index(self.axis)]
        return self.tube.at(c) if self.tube else c

    def _piece(self, k: int, x: FloatArray, c: FloatArray) -> FloatArray:
        """Give e_k at places, m."""
        piece = self.pieces[k]
        return piece.a.at(x) * (c - piece.pivot) + piece.d.at(x)

    def _chosen(
        self, chosen: np.typing.NDArray[np.int64], x: FloatArray, c: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Give value and derivatives by x (c held) and by c of the piece chosen for each place."""
        e, e_x, e_c = np.zeros(len(x)), np.zeros(len(x)), np.zeros(len(x))
        for k, piece in enumerate(self.pieces):
            some = np.flatnonzero(chosen == k)
            if len(some):
                lever = c[some] - piece.pivot
                e_c[some] = piece.a.at(x[some])
                e[some] = e_c[some] * lever + piece.d.at(x[some])
                e_x[some] = piece.a.slope(x[some]) * lever + piece.d.slope(x[some])
        return e, e_x, e_c

    def _heights(
        self, chosen: np.typing.NDArray[np.int64], x: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Give height (m) and slope of the boundary chosen for each place."""
        h, h_x = np.zeros(len(x)), np.zeros(len(x))
        for k, each in enumerate(self.boundaries):
            some = np.flatnonzero(chosen == k)
            if len(some):
                h[some], h_x[some] = each.height.at(x[some]), each.height.slope(x[some])
        return h, h_x


def level_boundaries(names: Sequence[str], heights: Sequence[float]) -> tuple[Boundary, ...]:
    """Give level boundary curves.

    Raises
    ------
    BadInputError
        Two touch, or come in the wrong order.
    """
    for i in range(1, len(heights)):
        if not heights[i] > heights[i - 1]:
            raise BadInputError(
                f"boundary curves '{names[i - 1]}' and '{names[i]}' touch "
                f"(gap {heights[i] - heights[i - 1]:.3g} m)", "in vary",
                "move one or reduce the range",
            )  # fmt: skip
    return tuple(
        Boundary(name, BlendChain.constant(height))
        for name, height in zip(names, heights, strict=True)
    )


def _acts(course: BoundedFunction) -> bool:
    """Tell whether a function is anywhere other than zero."""
    if isinstance(course, BlendChain):
        return bool(course.v.any())
    low, high = course.bounds(np.array(-np.inf), np.array(np.inf))
    return bool(low != 0.0) or bool(high != 0.0)


def nonzero_span(course: BoundedFunction) -> tuple[float, float]:
    """Give between which x, m, a function is other than zero; infinite where it has no end."""
    nodes = course.nodes
    value = course.v if isinstance(course, BlendChain) else course.at(nodes)
    first = -np.inf if value[0] != 0.0 else float(nodes[0])
    last = np.inf if value[-1] != 0.0 else float(nodes[-1])
    if isinstance(course, BlendChain):
        acts = np.flatnonzero(value != 0.0)
        if len(acts) and value[0] == 0.0:
            first = float(nodes[acts[0] - 1])
        if len(acts) and value[-1] == 0.0:
            last = float(nodes[acts[-1] + 1])
    return first, last
