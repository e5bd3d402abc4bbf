"""What numpy's linear functions of arrays do to tangents: their leading axis is left alone.

Each rule takes the tangents (k, ...) of the array, or of the arrays, and the other arguments
of the function, and does to every tangent what the function does to values. An axis that
counts from the front moves by one; one that counts from the back does not.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.numeric.dual_arrays import ONE
>>> ONE[np.sum](np.ones((2, 3, 4)), axis=0).shape
(2, 4)
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from assoc_hull.geometry.curves import FloatArray

__all__ = ["MANY", "ONE", "pick", "put", "spread", "times"]

Axis = int | tuple[int, ...] | None
Rule = Callable[..., FloatArray]


def spread(dot: FloatArray, ndim: int) -> FloatArray:
    """Give tangents (k, ...) of an array as those of one with `ndim` axes, new ones in front."""
    missing = ndim + 1 - dot.ndim
    return dot if missing <= 0 else dot.reshape(len(dot), *(1,) * missing, *dot.shape[1:])


def pick(dot: FloatArray, key: Any, ndim: int) -> FloatArray:
    """Give the tangents of ``value[key]``, where the value has `ndim` axes."""
    parts = key if isinstance(key, tuple) else (key,)
    if _together(parts):
        found: FloatArray = dot[(slice(None), *parts)]
        return found
    # Separate lists of indices come first in the result: the tangents must stand behind then.
    return np.moveaxis(np.moveaxis(dot, 0, -1)[_expanded(parts, ndim)], -1, 0)


def put(dot: FloatArray, key: Any, ndim: int, new: FloatArray) -> None:
    """Set the tangents of ``value[key]``, where the value has `ndim` axes."""
    parts = key if isinstance(key, tuple) else (key,)
    if _together(parts):
        dot[(slice(None), *parts)] = new
    else:
        np.moveaxis(dot, 0, -1)[_expanded(parts, ndim)] = np.moveaxis(new, 0, -1)


def _together(parts: tuple[Any, ...]) -> bool:
    """Tell whether indices that are not slices are whole numbers, or all stand side by side."""
    chosen = [i for i, each in enumerate(parts) if not _is_slice(each)]
    plain = all(isinstance(parts[i], int | np.integer) for i in chosen)
    return plain or chosen[-1] - chosen[0] == len(chosen) - 1


def _is_slice(part: Any) -> bool:
    return part is None or part is Ellipsis or isinstance(part, slice)


def _expanded(parts: tuple[Any, ...], ndim: int) -> tuple[Any, ...]:
    """Write an ellipsis, or what is left out at the end, as slices."""
    taken = sum(_axes_of(each) for each in parts)
    dots = [i for i, each in enumerate(parts) if each is Ellipsis]
    place = dots[0] if dots else len(parts)
    return (*parts[:place], *(slice(None),) * (ndim - taken), *parts[place + 1 :])


def _axes_of(part: Any) -> int:
    """Count the axes that a part of a key takes."""
    if part is None or part is Ellipsis:
        return 0
    if isinstance(part, slice | int | np.integer):
        return 1
    array = np.asarray(part)
    return array.ndim if array.dtype == np.bool_ else 1


def times(left: FloatArray, right: FloatArray, row: bool, column: bool) -> FloatArray:
    """Multiply matrices with a leading axis of tangents each; a row or column is made one."""
    left, right = left[:, None] if row else left, right[..., None] if column else right
    most = max(left.ndim, right.ndim) - 1
    product: FloatArray = np.matmul(spread(left, most), spread(right, most))
    return product


def _behind(axis: int) -> int:
    """Give the axis of the tangents that is this one of the values."""
    return axis if axis < 0 else axis + 1


def _flat(dot: FloatArray, axis: int | None) -> tuple[FloatArray, int]:
    """Give tangents and axis; without an axis, numpy takes the values in one row."""
    return (_ravel(dot), -1) if axis is None else (dot, _behind(axis))


def _ravel(dot: FloatArray) -> FloatArray:
    return dot.reshape(len(dot), int(np.prod(dot.shape[1:])))


def _all_of(dot: FloatArray, axis: Axis) -> tuple[int, ...]:
    if axis is None:
        return tuple(range(1, dot.ndim))
    return tuple(_behind(each) for each in (axis if isinstance(axis, tuple) else (axis,)))


def _sum(dot: FloatArray, axis: Axis = None, *, keepdims: bool = False) -> FloatArray:
    return np.asarray(np.sum(dot, axis=_all_of(dot, axis), keepdims=keepdims))


def _mean(dot: FloatArray, axis: Axis = None, *, keepdims: bool = False) -> FloatArray:
    return np.asarray(np.mean(dot, axis=_all_of(dot, axis), keepdims=keepdims))


def _cumsum(dot: FloatArray, axis: int | None = None) -> FloatArray:
    rows, along = _flat(dot, axis)
    return np.cumsum(rows, axis=along)


def _sum_runs(dot: FloatArray, indices: Any, axis: int = 0) -> FloatArray:
    return np.add.reduceat(dot, indices, axis=_behind(axis))


def _diff(dot: FloatArray, n: int = 1, axis: int = -1) -> FloatArray:
    return np.diff(dot, n=n, axis=_behind(axis))


def _take(dot: FloatArray, indices: Any, axis: int | None = None) -> FloatArray:
    rows, along = _flat(dot, axis)
    found: FloatArray = np.take(rows, indices, axis=along)
    return found


def _repeat(dot: FloatArray, repeats: Any, axis: int | None = None) -> FloatArray:
    rows, along = _flat(dot, axis)
    return np.repeat(rows, repeats, axis=along)


def _reshape(dot: FloatArray, shape: Any) -> FloatArray:
    wanted = tuple(shape) if isinstance(shape, Sequence) else (shape,)
    # With no tangent or no value numpy cannot find out what -1 stands for.
    size = int(np.prod(dot.shape[1:]))
    known = int(np.prod([each for each in wanted if each != -1]))
    sizes = [size // max(known, 1) if each == -1 else each for each in wanted]
    return dot.reshape(len(dot), *sizes)


def _broadcast_to(dot: FloatArray, shape: Any) -> FloatArray:
    wanted = tuple(shape) if isinstance(shape, Sequence) else (shape,)
    return np.broadcast_to(spread(dot, len(wanted)), (len(dot), *wanted))


def _transpose(dot: FloatArray, axes: Sequence[int] | None = None) -> FloatArray:
    ndim = dot.ndim - 1
    order = tuple(range(ndim))[::-1] if axes is None else axes
    return dot.transpose(0, *(each % ndim + 1 for each in order))


def _moveaxis(dot: FloatArray, source: Any, destination: Any) -> FloatArray:
    here, there = (
        _behind(each) if isinstance(each, int) else [_behind(one) for one in each]
        for each in (source, destination)
    )
    return np.moveaxis(dot, here, there)


def _swapaxes(dot: FloatArray, axis1: int, axis2: int) -> FloatArray:
    return np.swapaxes(dot, _behind(axis1), _behind(axis2))


def _expand_dims(dot: FloatArray, axis: int | tuple[int, ...]) -> FloatArray:
    return np.expand_dims(dot, _all_of(dot, axis))


def _squeeze(dot: FloatArray, axis: Axis = None) -> FloatArray:
    nil = tuple(i for i in range(1, dot.ndim) if dot.shape[i] == 1)
    return np.squeeze(dot, axis=nil if axis is None else _all_of(dot, axis))


def _flip(dot: FloatArray, axis: Axis = None) -> FloatArray:
    return np.flip(dot, _all_of(dot, axis))


def _stack(dots: Sequence[FloatArray], axis: int = 0) -> FloatArray:
    return np.stack(dots, axis=_behind(axis))


def _concatenate(dots: Sequence[FloatArray], axis: int | None = 0) -> FloatArray:
    parts = [_flat(each, axis) for each in dots]
    return np.concatenate([rows for rows, _ in parts], axis=parts[0][1])


ONE: Mapping[Callable[..., Any], Rule] = {
    np.sum: _sum, np.mean: _mean, np.cumsum: _cumsum, np.add.reduceat: _sum_runs,
    np.diff: _diff, np.take: _take, np.repeat: _repeat, np.reshape: _reshape, np.ravel: _ravel,
    np.broadcast_to: _broadcast_to, np.transpose: _transpose, np.moveaxis: _moveaxis,
    np.swapaxes: _swapaxes, np.expand_dims: _expand_dims, np.squeeze: _squeeze, np.flip: _flip,
    np.copy: np.copy, np.zeros_like: np.zeros_like, np.ones_like: np.zeros_like,
}  # fmt: skip
"""Functions of one array."""

MANY: Mapping[Callable[..., Any], Rule] = {np.stack: _stack, np.concatenate: _concatenate}
"""Functions of a sequence of arrays."""
