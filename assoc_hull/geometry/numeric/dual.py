"""Arrays that carry derivatives along: values, several tangents at once, and their sums.

A `Dual` stands in for an array of floats in code that computes with numpy. Each of its k
tangents says how the values change with one parameter; operators, numpy's functions, products
of matrices and indexing carry them through the same formulas, exactly. What is not known here
raises `TypeError`: no tangent is ever lost silently. Comparisons look at values only, so that
branches are those of the plain code.

What numpy's linear functions of arrays do to tangents: their leading axis is left alone.

Each rule takes the tangents (k, ...) of the array, or of the arrays, and the other arguments
of the function, and does to every tangent what the function does to values. An axis that
counts from the front moves by one; one that counts from the back does not.

The few sums of the immersion that are not element by element, and what decisions see.

All other arithmetic of the immersion is written with plain operators, so it runs on real
numbers, on complex ones (derivatives by complex step) and on any array type that overloads
them. The sums below are kept together here, so that one place knows how each type adds up.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.numeric.dual import Dual
>>> x = Dual([3.0, 4.0], [[1.0, 0.0], [0.0, 1.0]])
>>> length = np.sqrt((x**2).sum())
>>> float(length.value), length.dot.tolist()
(5.0, [0.6, 0.8])
>>> from assoc_hull.geometry.numeric.dual import ONE
>>> ONE[np.sum](np.ones((2, 3, 4)), axis=0).shape
(2, 4)
"""

from __future__ import annotations

from collections.abc import (
    Callable,
    Iterable,
    Iterator,
    Mapping,
    Sequence,
)
from typing import (
    Any,
    Literal,
    NoReturn,
    Self,
    cast,
)

import numpy as np
from numpy.lib.mixins import NDArrayOperatorsMixin
from numpy.typing import ArrayLike, NDArray

from assoc_hull.errors import BadInputError, WrongTypeError
from assoc_hull.geometry.curves import FloatArray, IntArray

__all__ = [
    "MANY",
    "ONE",
    "Dual",
    "as_array",
    "combine_rows",
    "common_zeros",
    "differs_from_zero",
    "is_plain",
    "pick",
    "put",
    "real",
    "safe_sqrt",
    "spread",
    "sum_by",
    "sum_columns_by",
    "times",
]

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


# --------------------------------------------------------------------------------------
# Derivatives of numpy's functions of one or two numbers, on plain arrays.
#
# `PARTIAL` gives for each function its partial derivatives, one per argument, as functions of
# all arguments and of the result. `assoc_hull.geometry.numeric.dual` chains them.

Partial = Callable[..., Any]

CONSTANT = frozenset(
    {
        np.less, np.less_equal, np.greater, np.greater_equal, np.equal, np.not_equal,
        np.isfinite, np.isinf, np.isnan, np.sign, np.signbit,
    }
)  # fmt: skip
"""Functions whose result does not vary with its arguments, but for jumps: they see values."""


def _power_base(base: Any, exponent: Any, _: Any) -> Any:
    """``n x^(n - 1)``; nil for n = 0 also where x is nil."""
    nil = np.equal(exponent, 0)
    return np.where(nil, 0.0, exponent * np.power(base, np.where(nil, 1, exponent - 1)))


PARTIAL: Mapping[np.ufunc, tuple[Partial | None, ...]] = {
    np.positive: (lambda x, y: 1.0,),
    np.negative: (lambda x, y: -1.0,),
    np.absolute: (lambda x, y: np.sign(x),),
    np.square: (lambda x, y: 2.0 * x,),
    np.sqrt: (lambda x, y: 0.5 / y,),
    np.cbrt: (lambda x, y: y / (3.0 * x),),
    np.reciprocal: (lambda x, y: -y * y,),
    np.exp: (lambda x, y: y,),
    np.log: (lambda x, y: 1.0 / x,),
    np.sin: (lambda x, y: np.cos(x),),
    np.cos: (lambda x, y: -np.sin(x),),
    np.tan: (lambda x, y: 1.0 + y * y,),
    np.arcsin: (lambda x, y: 1.0 / np.sqrt(1.0 - x * x),),
    np.arccos: (lambda x, y: -1.0 / np.sqrt(1.0 - x * x),),
    np.arctan: (lambda x, y: 1.0 / (1.0 + x * x),),
    np.add: (lambda a, b, y: 1.0, lambda a, b, y: 1.0),
    np.subtract: (lambda a, b, y: 1.0, lambda a, b, y: -1.0),
    np.multiply: (lambda a, b, y: b, lambda a, b, y: a),
    np.true_divide: (lambda a, b, y: 1.0 / b, lambda a, b, y: -y / b),
    np.hypot: (lambda a, b, y: a / y, lambda a, b, y: b / y),
    np.arctan2: (lambda a, b, y: b / (a * a + b * b), lambda a, b, y: -a / (a * a + b * b)),
    # Where both are the same, the derivative is that of the first.
    np.maximum: (lambda a, b, y: 1.0 * (a >= b), lambda a, b, y: 1.0 * (a < b)),
    np.minimum: (lambda a, b, y: 1.0 * (a <= b), lambda a, b, y: 1.0 * (a > b)),
    np.power: (_power_base, None),
}
"""By function: the partial derivative for each argument; None where it must be a constant.

Of the magnitude it is nil at 0, where there is none.
"""


_SUMS = frozenset({np.add, np.subtract})
_SUM: Callable[..., Any] = np.sum
_METHODS: dict[str, Callable[..., Any]] = {
    "reduce": np.sum, "accumulate": np.cumsum, "reduceat": np.add.reduceat,
}  # fmt: skip


class Dual(NDArrayOperatorsMixin):
    """Values with k tangents.

    Parameters
    ----------
    value : (...)
        The values, real numbers of any unit.
    dot : (k, ...), unit of the value per unit of its parameter
        Their derivatives with respect to k parameters.

    Raises
    ------
    BadInputError
        Shapes that do not fit, or complex numbers.
    """

    __slots__ = ("dot", "value")

    value: FloatArray
    dot: FloatArray

    def __init__(self, value: ArrayLike, dot: ArrayLike) -> None:
        if np.iscomplexobj(value) or np.iscomplexobj(dot):
            _refuse("a complex number", "use complex numbers or tangents, not both")
        self.value, self.dot = np.asarray(value, np.float64), np.asarray(dot, np.float64)
        if self.dot.shape[1:] != self.value.shape or self.dot.ndim == 0:
            raise BadInputError(
                f"values of shape {self.value.shape} and tangents of shape {self.dot.shape}",
                "in Dual",
                "give (...) and (k, ...)",
            )

    @classmethod
    def _made(cls, value: FloatArray, dot: FloatArray) -> Self:
        """Make one of what is known to fit."""
        made = object.__new__(cls)
        made.value, made.dot = np.asarray(value), dot
        return made

    @classmethod
    def constant(cls, value: ArrayLike, count: int) -> Self:
        """Give values that do not vary with any of so many parameters."""
        fixed = np.asarray(value, np.float64)
        return cls(fixed, np.zeros((count, *fixed.shape)))

    def __repr__(self) -> str:
        return f"<Dual {self.shape}, {self.count} tangents>"

    @property
    def count(self) -> int:
        """Number of tangents."""
        return len(self.dot)

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the values."""
        return self.value.shape

    @property
    def ndim(self) -> int:
        """Number of axes of the values."""
        return self.value.ndim

    @property
    def size(self) -> int:
        """Number of values."""
        return self.value.size

    @property
    def real(self) -> FloatArray:
        """The values alone, under the name that they have in complex numbers."""
        return self.value

    @property
    def T(self) -> Dual:  # noqa: N802
        """Axes in reverse order."""
        return self.transpose()

    def __len__(self) -> int:
        return len(self.value)

    def __iter__(self) -> Iterator[Dual]:
        return (self[i] for i in range(len(self)))

    def __getitem__(self, key: Any) -> Dual:
        return Dual._made(self.value[key], pick(self.dot, key, self.ndim))

    def __setitem__(self, key: Any, new: Any) -> None:
        here = self.value[key].ndim
        if isinstance(new, Dual):
            _same_count((self, new))
            fresh = spread(new.dot, here)
        else:
            fresh = np.zeros((self.count, *(1,) * here))
        self.value[key] = real(new)
        put(self.dot, key, self.ndim, fresh)

    def setflags(self, *, write: bool) -> None:
        """Make values and tangents read-only, or not."""
        self.value.setflags(write=write)
        self.dot.setflags(write=write)

    def sum(self, axis: int | tuple[int, ...] | None = None, *, keepdims: bool = False) -> Dual:
        """Sum along axes, or of everything."""
        return _one(_SUM, self, axis=axis, keepdims=keepdims)

    def reshape(self, *shape: Any) -> Dual:
        """Give the same numbers in another shape."""
        return _one(np.reshape, self, shape[0] if len(shape) == 1 else shape)

    def transpose(self, *axes: Any) -> Dual:
        """Permute the axes; reverse them if none are given."""
        order = axes[0] if len(axes) == 1 and not isinstance(axes[0], int) else axes or None
        return _one(np.transpose, self, order)

    def take(self, indices: Any, axis: int | None = None) -> Dual:
        """Give the entries at some indices."""
        return _one(np.take, self, indices, axis=axis)

    def ravel(self) -> Dual:
        """Give all entries in one row."""
        return _one(np.ravel, self)

    def copy(self, order: Literal["C", "F", "A", "K"] = "C") -> Dual:
        """Give the same numbers in memory of their own."""
        return Dual(self.value.copy(order), self.dot.copy(order))

    def __array__(self, *_: Any, **__: Any) -> NoReturn:
        _refuse("an array of plain numbers made of values with tangents", "use real(x) for values")

    def __array_ufunc__(
        self, ufunc: np.ufunc, method: str, *inputs: Any, out: Any = None, **more: Any
    ) -> Any:
        found: Any
        if method == "__call__" and not more:
            found = _call(ufunc, inputs)
        elif ufunc is np.add and method in _METHODS:
            found = _one(_METHODS[method], *inputs, **({"axis": 0} | more))
        else:
            _refuse(f"numpy.{ufunc.__name__}, {method} {sorted(more)}", "differentiate it by hand")
        if out is None:
            return found
        if not isinstance(out[0], Dual) or not isinstance(found, Dual):
            _refuse(f"numpy.{ufunc.__name__} into plain numbers", "leave out `out`")
        out[0][...] = found
        return out[0]

    def __array_function__(
        self, function: Callable[..., Any], types: Iterable[type], args: Any, kwargs: Any
    ) -> Any:
        del types
        if function in _SPECIAL:
            return _SPECIAL[function](*args, **kwargs)
        if function in ONE:
            return _one(function, *args, **kwargs)
        if function in MANY:
            return _many(function, *args, **kwargs)
        _refuse(f"numpy.{function.__name__}", "differentiate it by hand")


def _refuse(what: str, remedy: str) -> NoReturn:
    raise WrongTypeError(what, "in a calculation that carries tangents", remedy)


def _value(given: Any) -> Any:
    return given.value if isinstance(given, Dual) else given


def _same_count(given: Iterable[Any]) -> int:
    """Give the number of tangents, which all that have any must share."""
    counts = {each.count for each in given if isinstance(each, Dual)}
    if len(counts) > 1:
        raise BadInputError(
            f"values with {' and '.join(map(str, sorted(counts)))} tangents",
            "in one calculation",
            "give all as many",
        )
    return counts.pop()


def _call(ufunc: np.ufunc, given: Sequence[Any]) -> Any:
    """Apply a function of numbers; its result is a `Dual` unless it is constant."""
    values = [_value(each) for each in given]
    if ufunc in CONSTANT:
        return ufunc(*values)
    if ufunc is np.matmul:
        return _matmul(given[0], given[1])
    if ufunc not in PARTIAL:
        _refuse(f"numpy.{ufunc.__name__}", "differentiate it by hand")
    count, result = _same_count(given), np.asarray(ufunc(*values))
    shape = (count, *result.shape)
    if ufunc in _SUMS and all(isinstance(each, Dual) for each in given):
        return Dual(result, ufunc(*(spread(each.dot, result.ndim) for each in given)))
    parts = [
        _scaled(ufunc, partial, (*values, result), spread(each.dot, result.ndim))
        for each, partial in zip(given, PARTIAL[ufunc], strict=True)
        if isinstance(each, Dual)
    ]
    dot = _whole(parts[0], shape)
    for more in parts[1:]:
        dot += more
    return Dual(result, dot)


def _scaled(
    ufunc: np.ufunc, partial: Partial | None, values: Sequence[Any], dot: FloatArray
) -> FloatArray:
    if partial is None:
        _refuse(f"an argument of numpy.{ufunc.__name__} that varies", "give a constant")
    # Also where the factor is 1: the tangents of a result share no memory with any others.
    scaled: FloatArray = partial(*values) * dot
    return scaled


def _whole(dot: FloatArray, shape: tuple[int, ...]) -> FloatArray:
    """Give tangents of one row or column as those of the whole; all can be written to."""
    return dot if dot.shape == shape else np.array(np.broadcast_to(dot, shape))


def _one(function: Callable[..., Any], given: Any, *args: Any, **kwargs: Any) -> Dual:
    """Apply a linear function of one array."""
    if not isinstance(given, Dual) or any(isinstance(each, Dual) for each in args):
        _refuse(f"an argument of numpy.{function.__name__} that varies", "give a constant")
    dot = ONE[function](given.dot, *args, **kwargs)
    return Dual._made(function(given.value, *args, **kwargs), dot)


def _many(function: Callable[..., Any], given: Sequence[Any], *args: Any, **kwargs: Any) -> Dual:
    """Apply a linear function of several arrays, some of which may be constant."""
    parts, count = list(given), _same_count(given)
    dots = [_tangents(each, count) for each in parts]
    values = [_value(each) for each in parts]
    return Dual(function(values, *args, **kwargs), MANY[function](dots, *args, **kwargs))


def _tangents(given: Any, count: int) -> FloatArray:
    return given.dot if isinstance(given, Dual) else np.zeros((count, *np.shape(given)))


def _where(condition: Any, *choices: Any) -> Dual:
    if isinstance(condition, Dual) or len(choices) != 2:
        _refuse("numpy.where of values", "give a condition and two arrays")
    count, value = _same_count(choices), np.where(condition, *map(_value, choices))
    first, second = (spread(_tangents(each, count), value.ndim) for each in choices)
    dot = np.where(condition, first, second)
    return Dual(value, _whole(dot, (count, *value.shape)))


def _matmul(left: Any, right: Any) -> Dual:
    """Multiply matrices or rows, of which one or both vary."""
    one, other = np.asarray(_value(left)), np.asarray(_value(right))
    value = np.matmul(one, other)
    row, column = one.ndim == 1, other.ndim == 1
    dots = []
    if isinstance(left, Dual):
        dots.append(times(left.dot, other[None], row, column))
    if isinstance(right, Dual):
        dots.append(times(one[None], right.dot, row, column))
    count = _same_count((left, right))
    return Dual(value, sum(dots[1:], dots[0]).reshape(count, *value.shape))


_SPECIAL: dict[Callable[..., Any], Callable[..., Any]] = {
    np.where: _where,
    np.dot: _matmul,
    np.shape: lambda given: given.shape,
    np.ndim: lambda given: given.ndim,
    np.size: lambda given: given.size,
    np.iscomplexobj: lambda given: False,
}


def real(given: Any) -> FloatArray:
    """Give the plain values of numbers, complex numbers or a `Dual`.

    Parameters
    ----------
    given : (...) array of float or complex, or Dual
        Any numbers.

    Returns
    -------
    (...)
        Values; the real parts of complex numbers. What is decided by them is decided alike
        with and without derivatives.

    Examples
    --------
    >>> from assoc_hull.geometry.numeric.dual import real
    >>> real([1.0, 2.0 + 1e-30j]).tolist()
    [1.0, 2.0]
    """
    return np.asarray(np.real(_value(given)), np.float64)


def is_plain(given: Any) -> bool:
    """Tell whether numbers are plain: neither complex nor with tangents."""
    return not isinstance(given, Dual) and not np.iscomplexobj(given)


def as_array(given: Dual) -> FloatArray:
    """Let a `Dual` stand for an array of floats where a type checker wants one."""
    return cast("FloatArray", given)


def sum_by(values: Any, owner: IntArray, count: int) -> Any:
    """Sum rows by owner, one after the other, of any kind of numbers.

    Parameters
    ----------
    values : (n, ...) array of float or complex, or Dual
        One row per item.
    owner : (n,) int
        To which sum each row belongs.
    count : int
        Number of sums.

    Returns
    -------
    (count, ...) of the kind of the values
        The sums.

    Raises
    ------
    BadInputError
        An owner that is not from 0 to count - 1.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.numeric.dual import sum_by
    >>> sum_by(np.array([1.0, 2.0, 4.0]), np.array([2, 0, 2]), 3).tolist()
    [2.0, 0.0, 5.0]
    """
    if isinstance(values, Dual):
        dot = sum_by(np.moveaxis(values.dot, 0, -1), owner, count)
        return Dual(sum_by(values.value, owner, count), np.moveaxis(dot, -1, 0))
    if np.iscomplexobj(values):
        return sum_by(values.real, owner, count) + 1j * sum_by(values.imag, owner, count)
    if len(owner) and not 0 <= int(owner.min()) <= int(owner.max()) < count:
        what = f"owners from {owner.min()} to {owner.max()}"
        raise BadInputError(what, "in sum_by", f"give 0 to {count - 1}")
    width = int(np.prod(values.shape[1:]))
    place = (owner[:, None] * width + np.arange(width)).ravel()
    sums = np.bincount(
        place, weights=values.reshape(len(owner), width).ravel(), minlength=count * width
    )
    return sums.reshape(count, *values.shape[1:])


def differs_from_zero(values: FloatArray) -> NDArray[np.bool_]:
    """Say which numbers are not zero, or have a derivative that is not."""
    if isinstance(values, Dual):
        return np.asarray((values.value != 0.0) | (values.dot != 0.0).any(axis=0))
    return np.asarray(values != 0.0)


def common_zeros(shape: tuple[int, ...], *like: FloatArray) -> FloatArray:
    """Give zeros of the arithmetic that results from all of some numbers."""
    for each in like:
        if isinstance(each, Dual):
            return as_array(Dual.constant(np.zeros(shape), each.count))
    return np.zeros(shape, np.result_type(*like))


_NONE = 1e-22
"""A square of less is rounding about zero, from which a root would take any direction."""


def safe_sqrt(values: FloatArray) -> FloatArray:
    """Give square roots; where there is nothing to take one of, zero and no derivative."""
    if is_plain(values):
        return np.sqrt(values)
    some = real(values) > _NONE
    return np.where(some, np.sqrt(np.where(some, values, 1.0)), 0.0)


def combine_rows(matrix: FloatArray, values: FloatArray) -> FloatArray:
    """Combine rows: ``matrix @ values``, of which the matrix is plain.

    Parameters
    ----------
    matrix : (m, n)
        Real factors.
    values : (..., n, k)
        Any arithmetic.

    Returns
    -------
    (..., m, k)
        The combinations.
    """
    mixed: FloatArray = matrix @ values
    return mixed


def sum_columns_by(values: FloatArray, owner: IntArray, count: int) -> FloatArray:
    """Add up columns by owner.

    Parameters
    ----------
    values : (c, k)
        Any arithmetic.
    owner : (k,) int
        From 0 to count - 1.
    count : int
        Number of owners.

    Returns
    -------
    (c, count)
        The sums, each in the order of its columns.

    Examples
    --------
    >>> import numpy as np
    >>> sum_columns_by(np.array([[1.0, 2.0, 4.0]]), np.array([1, 0, 1]), 3)
    array([[2., 5., 0.]])
    """
    if count == 1:
        alone: FloatArray = values.sum(axis=1)[:, None]
        return alone
    if isinstance(values, Dual):
        dot = values.dot.reshape(values.count * len(values), values.shape[1])
        sums = sum_columns_by(dot, owner, count).reshape(values.count, len(values), count)
        return as_array(Dual(sum_columns_by(values.value, owner, count), sums))
    if not is_plain(values):
        summed: FloatArray = sum_by(values.T, owner, count).T
        return summed
    return np.stack([np.bincount(owner, row, count) for row in values])
