"""The least value of a minor that is a polynomial on each of some boxes of its parameters.

A minor is given by its values; from those at nodes come its Bernstein coefficients, which
enclose it on a box. Boxes that may hold a smaller value than the least one met are halved.
Where the minor is a quotient of two polynomials, the quotients of their coefficients enclose it.
"""

from __future__ import annotations

from collections.abc import Callable

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.numeric.tensor_bernstein import (
    bernstein_coefficients,
    bernstein_nodes,
    corner_coefficients,
    halve_boxes,
)
from assoc_hull.model.program.engine import is_compiled

__all__ = ["LeastMinor", "Minor", "find_least_minor"]

_Values = Callable[[FloatArray], FloatArray]
_Mask = np.typing.NDArray[np.bool_]

_NEAR = 1e-9
"""The least value is found to so much."""

_NEARLY = 1e-4
"""The least value is found to so much, if there are many boxes."""

_SHARP = 2000
_ENOUGH = 8000
"""With more boxes than that, only what is not known to reach the margin is looked at further."""

_MOST = 60_000
_DEPTH = 14
_TIE = 1e-12
"""Values this close are taken for equal, and the last of them is told: where a minor is the same
all along the ship, rounding, which is not the same on every machine, would choose the place."""

_INWARD = 1e-10
"""The witness is taken so far inside its box, as a part of it: where slopes jump, they are those
of the box."""


@attrs.frozen(eq=False)
class Minor:
    """A minor of the Jacobian on boxes of k parameters.

    Attributes
    ----------
    name : str
    lower, upper : (m, k)
        The boxes; on each it is a polynomial, or a quotient of two.
    degrees : tuple of int
        In each parameter; may be larger than need be.
    at : callable
        Numerator at parameters (n, k).
    place : callable
        Places (n, 3), m, of parameters.
    over : callable or None
        Denominator, above nil.
    within : callable or None
        Which parameters (n, k) count; boxes reach further than what is asked about.
    beyond : callable or None
        Which boxes (lower, upper) hold no parameter that counts.
    """

    name: str
    lower: FloatArray
    upper: FloatArray
    degrees: tuple[int, ...]
    at: _Values
    place: _Values
    over: _Values | None = None
    within: Callable[[FloatArray], _Mask] | None = None
    beyond: Callable[[FloatArray, FloatArray], _Mask] | None = None

    def value(self, parameters: FloatArray) -> FloatArray:
        """Give the minor at parameters (n, k)."""
        found = self.at(parameters)
        return found if self.over is None else found / self.over(parameters)


@attrs.frozen
class LeastMinor:
    """The least value of a minor.

    Attributes
    ----------
    minor : str
    least : float
        The least value met.
    bound : float
        No value is below it.
    witness : (float, float, float), m
        Where `least` was met.
    boxes, splits : int
    """

    minor: str
    least: float
    bound: float
    witness: tuple[float, float, float]
    boxes: int
    splits: int


@attrs.define(eq=False)
class _Boxes:
    """Boxes with the coefficients on them, and the box of the minor that each is part of."""

    lower: FloatArray
    upper: FloatArray
    top: FloatArray
    foot: FloatArray | None
    slack: FloatArray
    home: np.typing.NDArray[np.int64]

    def taken(self, some: _Mask) -> _Boxes:
        foot = None if self.foot is None else self.foot[some]
        return _Boxes(
            self.lower[some], self.upper[some], self.top[some], foot, self.slack[some],
            self.home[some],
        )  # fmt: skip

    def ratios(self) -> FloatArray:
        """Give what encloses the minor; minus infinity where the denominator is not known."""
        if self.foot is None:
            return self.top
        ratio: FloatArray = self.top / np.where(self.foot > 0.0, self.foot, np.nan)
        return np.where(self.foot > 0.0, ratio, -np.inf)

    def bounds(self, ratios: FloatArray) -> FloatArray:
        inner = tuple(range(1, ratios.ndim))
        size = 1.0 if self.foot is None else self.foot.min(axis=inner)
        return np.asarray(ratios.min(axis=inner) - self.slack / np.maximum(size, 1e-12))


def find_least_minor(minor: Minor, enough: float) -> LeastMinor:
    """Find the least value of a minor.

    Parameters
    ----------
    minor : Minor
    enough : float
        What it must reach: above it, sharpness is not worth many boxes.

    Returns
    -------
    Found
        Least value and bound are 1e-9 apart, unless that takes too many boxes.
    """
    boxes = _begin(minor)
    if minor.within is None and minor.beyond is None and boxes.foot is None and _is_quick():
        return _by_compiled(minor, boxes, enough)
    least, bound, count, splits = np.inf, np.inf, 0, 0
    where, home = minor.lower[0], 0
    for rounds in range(_DEPTH * minor.lower.shape[1] + 1):
        if minor.beyond is not None:
            boxes = boxes.taken(~minor.beyond(boxes.lower, boxes.upper))
        if not len(boxes.lower):
            break
        count += len(boxes.lower)
        ratios = boxes.ratios()
        low = boxes.bounds(ratios)
        value, place, row = _lowest_corner(minor, boxes, ratios)
        if value < least - _TIE:
            least, where, home = value, place, int(boxes.home[row])
        open_ = low < least - (_NEAR if count < _SHARP else _NEARLY)
        if count > _ENOUGH:
            open_ &= (low < enough) & (least > 0.0)
        if (~open_).any():
            bound = min(bound, float(low[~open_].min()))
        boxes = boxes.taken(open_)
        if count + 2 * len(boxes.lower) > _MOST or rounds == _DEPTH * minor.lower.shape[1]:
            bound = min(bound, float(low[open_].min(initial=np.inf)))
            break
        splits += len(boxes.lower)
        boxes = _split(boxes)
    return _found(minor, where, home, (bound, least), (count, splits))


def _is_quick() -> bool:
    """Tell whether compiled code is at hand; a certificate alone is no reason to have it made."""
    return is_compiled(counts=False)


def _by_compiled(minor: Minor, boxes: _Boxes, enough: float) -> LeastMinor:
    """Do the same by compiled code: polynomials alone, that count on all of their boxes."""
    from assoc_hull.variation.certificate.compiled_search import SearchLimits, search_coefficients

    limits = SearchLimits(_NEAR, _NEARLY, _SHARP, _ENOUGH, _MOST, _DEPTH, _TIE)
    found = search_coefficients(
        boxes.lower, boxes.upper, boxes.top, boxes.slack, enough, limits
    )  # fmt: skip
    values, counts = (found.bound, found.least), (found.boxes, found.splits)
    return _found(minor, found.where, found.home, values, counts)


def _begin(minor: Minor) -> _Boxes:
    unit = bernstein_nodes(minor.degrees)
    width = (minor.upper - minor.lower)[:, None, :]
    parameters = (minor.lower[:, None, :] + unit[None, :, :] * width).reshape(-1, unit.shape[1])
    top, slack = bernstein_coefficients(minor.at(parameters).reshape(-1, len(unit)), minor.degrees)
    foot = None
    if minor.over is not None:
        values = minor.over(parameters).reshape(-1, len(unit))
        foot, further = bernstein_coefficients(values, minor.degrees)
        slack = slack + further * np.abs(top).reshape(len(top), -1).max(axis=1)
    home = np.arange(len(minor.lower))
    return _Boxes(minor.lower.copy(), minor.upper.copy(), top, foot, slack, home)


def _lowest_corner(
    minor: Minor, boxes: _Boxes, ratios: FloatArray
) -> tuple[float, FloatArray, int]:
    """Give the least value at corners that count, its parameters, and its box."""
    count, k = boxes.lower.shape
    values = corner_coefficients(ratios).reshape(count, -1)
    bits = np.array(list(np.ndindex(*(2,) * k)))
    ends = np.stack([boxes.lower, boxes.upper])
    places = ends[bits[None, :, :], np.arange(count)[:, None, None], np.arange(k)]
    if minor.within is not None:
        counts = minor.within(places.reshape(-1, k)).reshape(count, -1)
        values = np.where(counts, values, np.inf)
    last = int(np.flatnonzero(values <= values.min() + _TIE)[-1])
    row, column = np.unravel_index(last, values.shape)
    return float(values[row, column]), places[row, column], int(row)


def _split(boxes: _Boxes) -> _Boxes:
    """Halve each box across the parameter along which its coefficients differ most."""
    inner = tuple(range(1, boxes.top.ndim))
    spread = np.stack([
        np.ptp(boxes.top, axis=axis).max(axis=tuple(range(1, boxes.top.ndim - 1)))
        for axis in inner
    ])  # fmt: skip
    chosen = spread.argmax(axis=0)
    parts = [_halved(boxes.taken(chosen == axis), axis) for axis in np.unique(chosen).tolist()]
    if not parts:
        return boxes
    foot = None
    if boxes.foot is not None:
        foot = np.concatenate([part.foot for part in parts if part.foot is not None])
    return _Boxes(
        np.concatenate([part.lower for part in parts]),
        np.concatenate([part.upper for part in parts]),
        np.concatenate([part.top for part in parts]), foot,
        np.concatenate([part.slack for part in parts]),
        np.concatenate([part.home for part in parts]),
    )  # fmt: skip


def _halved(boxes: _Boxes, axis: int) -> _Boxes:
    middle = 0.5 * (boxes.lower[:, axis] + boxes.upper[:, axis])
    lower, upper = boxes.lower.copy(), boxes.upper.copy()
    lower[:, axis], upper[:, axis] = middle, middle
    foot = None if boxes.foot is None else np.concatenate(halve_boxes(boxes.foot, axis))
    return _Boxes(
        np.concatenate([boxes.lower, lower]), np.concatenate([upper, boxes.upper]),
        np.concatenate(halve_boxes(boxes.top, axis)), foot,
        np.tile(boxes.slack, 2), np.tile(boxes.home, 2),
    )  # fmt: skip


def _found(
    minor: Minor, where: FloatArray, home: int, values: tuple[float, float],
    counts: tuple[int, int],
) -> LeastMinor:  # fmt: skip
    """Take the witness just inside its box, and the minor's own value there."""
    bound, least = values
    if not np.isfinite(least):
        x, y, z = minor.place(where[None, :])[0].tolist()
        return LeastMinor(minor.name, least, bound, (x, y, z), *counts)
    width = minor.upper[home] - minor.lower[home]
    inside = minor.lower[home] + _INWARD * width, minor.upper[home] - _INWARD * width
    where = np.clip(where, *inside)
    least = float(minor.value(where[None, :])[0])
    x, y, z = minor.place(where[None, :])[0].tolist()
    return LeastMinor(minor.name, least, min(bound, least), (x, y, z), *counts)
