"""Arrays with tangents: every operation against complex step and central differences."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays, broadcastable_shapes, mutually_broadcastable_shapes

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.numeric.dual import Dual, real, sum_by
from tests.long_forms import draws

K = 3
STEP = 1e-100
"""So small that its square is nil: the complex step has no error of its own."""

numbers = st.floats(0.2, 0.9).map(lambda x: round(x, 3))
signs = st.sampled_from([-1.0, 1.0])


def random_dual(seed: int, shape: tuple[int, ...], low: float = 0.2, high: float = 0.9) -> Dual:
    """Values within limits, tangents of any size about 1."""
    random = np.random.default_rng(seed)
    return Dual(random.uniform(low, high, shape), random.normal(size=(K, *shape)))


def by_complex_step(function: Callable[..., Any], *given: Any) -> FloatArray:
    """The tangents of a function by complex step, one tangent after the other."""
    rows = []
    for k in range(K):
        moved = [
            each.value + 1j * STEP * each.dot[k] if isinstance(each, Dual) else each
            for each in given
        ]
        rows.append(np.imag(function(*moved)) / STEP)
    return np.stack(rows)


def by_differences(function: Callable[..., Any], *given: Any, step: float = 1e-6) -> FloatArray:
    """The tangents of a function by central differences."""
    rows = []
    for k in range(K):
        one, other = (
            function(
                *(
                    each.value + sign * step * each.dot[k] if isinstance(each, Dual) else each
                    for each in given
                )
            )
            for sign in (1.0, -1.0)
        )
        rows.append((np.asarray(one) - np.asarray(other)) / (2.0 * step))
    return np.stack(rows)


def check(function: Callable[..., Any], *given: Any, smooth: bool = True) -> None:
    """A function of duals has the values of the plain one, and its derivatives."""
    found = function(*given)
    assert isinstance(found, Dual)
    plain = function(*(each.value if isinstance(each, Dual) else each for each in given))
    np.testing.assert_array_equal(found.value, plain)
    assert found.dot.shape == (K, *np.shape(plain))
    by_hand = by_differences(function, *given)
    np.testing.assert_allclose(found.dot, by_hand, rtol=1e-6, atol=1e-7)
    if smooth:
        exact = by_complex_step(function, *given)
        np.testing.assert_allclose(found.dot, exact, rtol=1e-13, atol=1e-13)


ONE_NUMBER: dict[str, tuple[Callable[[Any], Any], bool]] = {
    "positive": (np.positive, True),
    "negative": (np.negative, True),
    "minus": (lambda x: -x, True),
    "magnitude": (lambda x: np.abs(x - 0.55), False),
    "abs": (lambda x: abs(0.1 - x), False),
    "square": (np.square, True),
    "sqrt": (np.sqrt, True),
    "reciprocal": (np.reciprocal, True),
    "exp": (np.exp, True),
    "log": (np.log, True),
    "sin": (np.sin, True),
    "cos": (np.cos, True),
    "tan": (np.tan, True),
    "arcsin": (np.arcsin, True),
    "arccos": (np.arccos, True),
    "arctan": (np.arctan, True),
    "x^0": (lambda x: x**0, True),
    "x^1": (lambda x: x**1, True),
    "x^2": (lambda x: x**2, True),
    "x^5": (lambda x: np.power(x, 5), True),
    "x^-2": (lambda x: x**-2, True),
    "x^0.3": (lambda x: x**0.3, True),
    "x^-1.5": (lambda x: x**-1.5, True),
    "2 - x": (lambda x: 2 - x, True),
    "1 / x": (lambda x: 1 / x, True),
    "x / 4": (lambda x: x / 4, True),
    "5 x": (lambda x: 5 * x, True),
    "x + 1": (lambda x: 1 + x + 1, True),
    "float64 x": (lambda x: np.float64(3.0) * x - np.float64(1.0), True),
}


@pytest.mark.parametrize("name", ONE_NUMBER)
@settings(max_examples=draws(15), deadline=None)
@given(seed=st.integers(0, 2**32 - 1), shape=st.sampled_from([(), (4,), (2, 3), (0, 2)]))
def test_functions_of_one_number(name: str, seed: int, shape: tuple[int, ...]) -> None:
    """Values are those of numpy to the bit; tangents those of the complex step."""
    function, smooth = ONE_NUMBER[name]
    x = random_dual(seed, shape)
    near_the_kink = np.abs(x.value - 0.55).min(initial=1.0) < 1e-4
    if not (near_the_kink and not smooth):
        check(function, x, smooth=smooth)


TWO_NUMBERS: dict[str, tuple[Callable[[Any, Any], Any], bool]] = {
    "a + b": (lambda a, b: a + b, True),
    "a - b": (lambda a, b: a - b, True),
    "a * b": (lambda a, b: a * b, True),
    "a / b": (lambda a, b: a / b, True),
    "hypot": (np.hypot, False),
    "arctan2": (np.arctan2, False),
    "maximum": (np.maximum, False),
    "minimum": (np.minimum, False),
}


@pytest.mark.parametrize("name", TWO_NUMBERS)
@settings(max_examples=draws(25), deadline=None)
@given(
    seed=st.integers(0, 2**31),
    shapes=mutually_broadcastable_shapes(num_shapes=2, max_dims=3, max_side=3),
    fixed=st.sampled_from([None, 0, 1]),
)
def test_functions_of_two_numbers(name: str, seed: int, shapes: Any, fixed: int | None) -> None:
    """Of any two shapes that go together; either may be constant."""
    function, smooth = TWO_NUMBERS[name]
    pair: list[Any] = [random_dual(seed + i, shapes.input_shapes[i]) for i in range(2)]
    if fixed is not None:
        pair[fixed] = pair[fixed].value
    far = np.abs(real(pair[0]) - real(pair[1])) > 1e-4
    if far.all() or "imum" not in name:
        check(function, *pair, smooth=smooth)


def test_where_two_are_the_same_the_first_is_the_larger_and_the_smaller() -> None:
    """So that the tangent is that of one of them, not of their sum."""
    a, b = Dual([1.0], [[2.0]]), Dual([1.0], [[5.0]])
    for choose in (np.maximum, np.minimum):
        found: Any = choose(a, b)
        assert found.dot.tolist() == [[2.0]]


@settings(max_examples=draws(40), deadline=None)
@given(seed=st.integers(0, 2**31), data=st.data())
def test_broadcasting_to_a_shape(seed: int, data: st.DataObject) -> None:
    """Tangents stay in front."""
    shape = data.draw(st.sampled_from([(), (3,), (2, 3), (2, 1)]))
    wider = data.draw(broadcastable_shapes(shape, min_dims=len(shape), max_dims=4, max_side=3))
    wanted = np.broadcast_shapes(shape, wider)
    check(lambda x: np.broadcast_to(x, wanted), random_dual(seed, shape))


LINEAR: dict[str, Callable[[Any], Any]] = {
    "sum": np.sum,
    "sum method": lambda x: x.sum(),
    "sum axis": lambda x: x.sum(axis=1),
    "sum last": lambda x: x.sum(axis=-1, keepdims=True),
    "sum axes": lambda x: np.sum(x, axis=(0, -1)),
    "mean": lambda x: np.mean(x, axis=0),
    "add.reduce": np.add.reduce,
    "add.reduce axis": lambda x: np.add.reduce(x, axis=2),
    "add.reduceat": lambda x: np.add.reduceat(x, [0, 1, 2], axis=1),
    "add.reduceat last": lambda x: np.add.reduceat(x, [0, 2], axis=-1),
    "add.accumulate": lambda x: np.add.accumulate(x, axis=1),
    "cumsum": np.cumsum,
    "cumsum axis": lambda x: np.cumsum(x, axis=0),
    "diff": np.diff,
    "diff axis": lambda x: np.diff(x, axis=0),
    "take": lambda x: np.take(x, [3, 0, 5]),
    "take axis": lambda x: np.take(x, [[0, 1], [1, 1]], axis=1),
    "take last": lambda x: x.take([1, 0], axis=-1),
    "repeat": lambda x: np.repeat(x, 2),
    "repeat axis": lambda x: np.repeat(x, [1, 0, 2], axis=1),
    "reshape": lambda x: x.reshape(4, 6),
    "reshape tuple": lambda x: x.reshape((6, -1)),
    "reshape flat": lambda x: np.reshape(x, -1),
    "ravel": np.ravel,
    "ravel method": lambda x: x.ravel(),
    "transpose": np.transpose,
    "T": lambda x: x.T,
    "transpose axes": lambda x: np.transpose(x, (1, -1, 0)),
    "transpose method": lambda x: x.transpose(2, 0, 1),
    "transpose method tuple": lambda x: x.transpose((2, 0, 1)),
    "moveaxis": lambda x: np.moveaxis(x, 0, -1),
    "moveaxis two": lambda x: np.moveaxis(x, (0, 1), (-1, 0)),
    "swapaxes": lambda x: np.swapaxes(x, 0, -1),
    "expand_dims": lambda x: np.expand_dims(x, 1),
    "expand_dims last": lambda x: np.expand_dims(x, (0, -1)),
    "squeeze": lambda x: np.squeeze(x[:, :1]),
    "squeeze axis": lambda x: np.squeeze(x[:, :1], axis=1),
    "flip": lambda x: np.flip(x, axis=1),
    "flip all": np.flip,
    "copy": np.copy,
    "copy method": lambda x: x.copy(),
    "zeros_like": lambda x: x + np.zeros_like(x),
    "ones_like": lambda x: x + np.ones_like(x),
    "stack": lambda x: np.stack([x, 2.0 * x, np.ones(x.shape)], axis=1),
    "stack last": lambda x: np.stack([x, x], axis=-1),
    "concatenate": lambda x: np.concatenate([np.ones((1, 3, 4)), x, x]),
    "concatenate axis": lambda x: np.concatenate([x, x[:, :1]], axis=1),
    "concatenate flat": lambda x: np.concatenate([x, x[0]], axis=None),
    "where": lambda x: np.where(np.arange(4) > 1, x, 3.0),
    "where wider": lambda x: np.where(np.ones((2, 1, 1, 1), bool), 0.0, x),
    "where both": lambda x: np.where(np.eye(3, 4, dtype=bool), x[0], x),
    "item": lambda x: x[1, 2, 3],
    "row": lambda x: x[0],
    "slices": lambda x: x[:, 1:, ::-1],
    "ellipsis": lambda x: x[..., 0],
    "new axis": lambda x: x[:, None, ..., None],
    "list": lambda x: x[:, [2, 0]],
    "lists": lambda x: x[[0, 1, 1], [2, 0, 1]],
    "apart": lambda x: x[[0, 1, 1], :, [2, 0, 1]],
    "apart with ellipsis": lambda x: x[0, ..., [2, 0]],
    "number and list": lambda x: x[:, 0, [1, 1, 2]],
    "list first": lambda x: x[[1], ..., :2],
    "mask": lambda x: x[:, np.array([True, False, True])],
    "mask of two": lambda x: x[:, np.eye(3, 4, dtype=bool)],
    "mask apart": lambda x: x[np.array([True, True]), :, np.array([0, 3])],
    "rows": lambda x: sum(row.sum() for row in x),
    "constant @ x": lambda x: np.arange(6.0).reshape(2, 3) @ x,
    "x @ constant": lambda x: x @ np.arange(8.0).reshape(4, 2),
    "x @ row": lambda x: x @ np.arange(4.0),
    "row @ x": lambda x: np.arange(3.0) @ x,
    "stack of constants @ x": lambda x: np.arange(12.0).reshape(2, 2, 1, 3) @ x,
    "constant . x": lambda x: np.dot(np.arange(6.0).reshape(2, 3), x[0]),
    "x . constant": lambda x: np.dot(x[0], np.arange(4.0)),
    "row . x": lambda x: np.dot(np.arange(4.0), x[0, 0]),
}


@pytest.mark.parametrize("name", LINEAR)
@settings(max_examples=3, deadline=None)
@given(seed=st.integers(0, 2**31))
def test_functions_of_arrays(name: str, seed: int) -> None:
    """Each does to every tangent what it does to the values."""
    check(LINEAR[name], random_dual(seed, (2, 3, 4)))


@settings(max_examples=draws(20), deadline=None)
@given(seed=st.integers(0, 2**31))
def test_products_of_two_matrices_that_vary(seed: int) -> None:
    """By the rule of products, with rows and stacks too."""
    a, b, c = (random_dual(seed + i, shape) for i, shape in enumerate([(2, 3), (5, 3, 2), (3,)]))
    check(lambda a, b: a @ b, a, b)
    check(lambda a, c: a @ c, a, c)
    check(lambda c, b: c @ b, c, b)
    check(lambda c: c @ c, c)


@settings(max_examples=draws(50), deadline=None)
@given(
    first=arrays(float, (3,), elements=numbers),
    dots=arrays(float, (K, 3), elements=st.floats(-1.0, 1.0)),
    sign=arrays(float, (3,), elements=signs),
)
def test_chains(first: FloatArray, dots: FloatArray, sign: FloatArray) -> None:
    """Of everything, in place too."""

    def chain(x: Any) -> Any:
        y = np.stack([x, np.sin(x) / (1.0 + x**2)], axis=1)
        y = np.concatenate([y, y[::-1] * sign[:, None]])
        z = np.sqrt((y * y).sum(axis=1)) - 0.3
        z += y[:, 0] ** 3 / (2.0 + np.cos(y[:, 1]))
        z *= np.where(real(z) > 0.5, z, 1.0)
        z[1:] -= 0.5 * z[:-1] ** 2
        z /= 1.5 + y[:, 1] ** 2
        return np.cumsum(z) @ np.arange(6.0)

    check(chain, Dual(first, dots))


@pytest.mark.parametrize(
    "key",
    [
        0,
        slice(1, None),
        (slice(None), 1),
        (..., 0),
        ([0, 1], [2, 0]),
        ([0, 1], slice(None), [1, 3]),
    ],
    ids=str,
)  # fmt: skip
@pytest.mark.parametrize("kind", ["dual", "plain", "number"])
def test_entries_are_set(key: Any, kind: str) -> None:
    """With their tangents; plain numbers bring nil tangents, not the old ones."""

    def put(x: Any, new: Any) -> Any:
        y = 2.0 * x
        y = y.copy()
        y[key] = new
        return y

    x = random_dual(1, (2, 3, 4))
    new = random_dual(2, x.value[key].shape)
    check(put, x, {"dual": new, "plain": new.value, "number": 7.0}[kind])


def test_an_update_in_place_is_seen_through_views() -> None:
    """As with plain arrays: a part is the whole's memory."""
    x = random_dual(1, (4,)).copy()
    part = x[1:3]
    part += 2.0 * part
    part *= 2.0
    again = random_dual(1, (4,))
    np.testing.assert_array_equal(x.value[1:3], 6.0 * again.value[1:3])
    np.testing.assert_array_equal(x.dot[:, 1:3], 6.0 * again.dot[:, 1:3])
    np.testing.assert_array_equal(x.dot[:, ::3], again.dot[:, ::3])


@pytest.mark.parametrize(
    "result", [lambda x: x + 1.0, lambda x: +x, lambda x: x - np.zeros((2, 4)), lambda x: 1.0 * x]
)
def test_a_result_has_memory_of_its_own(result: Callable[[Dual], Dual]) -> None:
    """What is done to it is not done to what it was made of."""
    x = random_dual(1, (4,))
    y = result(x)
    y *= 3.0
    np.testing.assert_array_equal(x.dot, random_dual(1, (4,)).dot)


def test_what_is_frozen_stays() -> None:
    """`freeze` takes it like any array."""
    x = random_dual(1, (4,))
    freeze(x)  # type: ignore[arg-type]
    for change in (lambda: x.__setitem__(0, 1.0), lambda: x.__iadd__(1.0)):
        with pytest.raises(ValueError, match="read-only"):
            change()


def test_comparisons_look_at_values() -> None:
    """Plain truths come out, and numbers that do not vary."""
    x, y = random_dual(1, (5,)), random_dual(2, (5,))
    for found, wanted in (
        (x < y, x.value < y.value), (x <= 0.5, x.value <= 0.5), (x > y, x.value > y.value),
        (x <= 0.5, x.value <= 0.5), (x == x.copy(), np.ones(5, bool)),
        (x != y, x.value != y.value), (np.isfinite(x), np.ones(5, bool)),
        (np.sign(x - 0.5), np.sign(x.value - 0.5)), (y.value < x, y.value < x.value),
    ):  # fmt: skip
        assert isinstance(found, np.ndarray)
        np.testing.assert_array_equal(found, wanted)
    assert (len(x), x.ndim, x.size, np.shape(x), np.ndim(x)) == (5, 1, 5, (5,), 1)


LOSSES: dict[str, Callable[[Dual], Any]] = {
    "array": np.asarray,
    "array of floats": lambda x: np.array(x, np.float64),
    "float": lambda x: float(x[0]),  # type: ignore[arg-type]
    "into an array": lambda x: np.zeros(3).__setitem__(slice(None), x),
    "added to an array": lambda x: np.zeros(3).__iadd__(x),
    "out": lambda x: np.add(x, 1.0, out=np.zeros(3)),
    "out of a sum": lambda x: np.sum(x, out=np.zeros(())),
    "where of a ufunc": lambda x: np.add(x, 1.0, where=np.ones(3, bool)),
    "exponent": lambda x: 2.0**x,
    "floor": np.floor,
    "rint": np.rint,
    "remainder": lambda x: x % 2.0,
    "multiply.reduce": np.multiply.reduce,
    "outer": lambda x: np.multiply.outer(x, x),
    "prod": np.prod,
    "sort": np.sort,
    "max": np.max,
    "interp": lambda x: np.interp(x, [0, 1], [0, 1]),
    "bincount": lambda x: np.bincount([0, 1, 1], weights=x),
    "searchsorted": lambda x: np.searchsorted([0.0, 1.0], x),
    "norm": np.linalg.norm,
    "solve": lambda x: np.linalg.solve(np.eye(3), x),
    "einsum": lambda x: np.einsum("i,i->", x, x),
    "condition": lambda x: np.where(x, 1.0, 2.0),
    "index": lambda x: np.arange(3)[x],
    "taken": lambda x: np.take(np.arange(3.0), x),
    "complex": lambda x: x * 1j,
}


@pytest.mark.parametrize("name", LOSSES)
def test_a_tangent_is_never_lost_silently(name: str) -> None:
    """What is not known raises TypeError, or IndexError of an index, and tells."""
    with pytest.raises((TypeError, IndexError)):
        LOSSES[name](random_dual(1, (3,)))


def test_shapes_that_do_not_fit_are_refused() -> None:
    """At once, not somewhere later."""
    for value, dot in ((np.ones(3), np.ones(3)), (np.ones(3), np.ones((2, 4))), (1.0, 1.0)):
        with pytest.raises(BadInputError, match="shape"):
            Dual(value, dot)
    with pytest.raises(BadInputError, match="2 and 3 tangents"):
        Dual.constant(np.ones(4), 2) + random_dual(1, (4,))


def test_real_gives_plain_values() -> None:
    """Of numbers, complex numbers and duals."""
    x = random_dual(1, (2, 2))
    np.testing.assert_array_equal(real(x), x.value)
    np.testing.assert_array_equal(real(x.value + 1e-30j), x.value)
    np.testing.assert_array_equal(real(x.value), x.value)
    assert real(2).dtype == np.float64


@settings(max_examples=draws(40), deadline=None)
@given(seed=st.integers(0, 2**31), shape=st.sampled_from([(), (2,), (2, 3)]), n=st.integers(0, 9))
def test_sums_by_owner(seed: int, shape: tuple[int, ...], n: int) -> None:
    """Row by row, for floats, complex numbers and duals; sums of nothing are nil."""
    owner = np.random.default_rng(seed).integers(0, 4, n)
    x = random_dual(seed, (n, *shape))
    wanted = np.zeros((5, *shape))
    for row, mine in zip(x.value, owner, strict=True):
        wanted[mine] += row
    np.testing.assert_array_equal(sum_by(x.value, owner, 5), wanted)
    check(lambda x: sum_by(x, owner, 5), x)


def test_an_owner_there_is_not_is_refused() -> None:
    """Else a sum would be longer than was asked."""
    for owner in ([0, 5], [-1, 0]):
        with pytest.raises(BadInputError, match="owners"):
            sum_by(np.ones(2), np.array(owner), 5)
