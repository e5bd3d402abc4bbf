"""Polynomials and their roots, many at once.

Polynomials in power form, many at once: values and derivatives.

Rows stand for polynomials, ascending powers along the second axis. The result of one row is
the same to the last bit whatever the other rows are. Coefficients and parameters may be
complex or carry tangents (`assoc_hull.geometry.numeric.dual.Dual`); so then do the results.

Roots of many polynomials, and of any continuous functions, all at once.

`bracketed_roots` finds the one root of cubics in brackets, in steps that compiled code repeats
bit by bit (intersections of curves and planes); `unit_roots` finds all sign changes of polynomials
of any degree in [0, 1] (lengths, integrals, closest points); `false_position` and, for one function
at a time, `brent_root` need values only.
A root has the same bits alone and in a batch. Coefficients stand in ascending powers. The finders
look at plain numbers: `roots_with_tangents` carries derivatives through the roots.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.numeric.dual import is_plain, real

__all__ = [
    "FLOOR",
    "MOST_TRIALS",
    "RELATIVE",
    "STEPS",
    "BracketedFunction",
    "bracketed_roots",
    "brent_root",
    "cubic_values",
    "differentiate",
    "false_position",
    "hermite",
    "horner",
    "quadratic_roots",
    "roots_with_tangents",
    "stationary_fractions",
    "unit_roots",
]


def cubic_values(
    origin: FloatArray,
    first: FloatArray,
    second: FloatArray,
    third: FloatArray,
    fraction: FloatArray,
) -> FloatArray:
    """Evaluate cubics given by their powers, by Horner's rule.

    Parameters
    ----------
    origin, first, second, third : (k,), any unit
        Coefficients of 1, u, u**2, u**3.
    fraction : (k,)
        The arguments u.

    Returns
    -------
    (k,), the unit of the coefficients
        The values.

    Examples
    --------
    >>> cubic_values(*np.array([[1.0], [1.0], [0.0], [2.0]]), np.array([0.5]))
    array([1.75])
    """
    result = third * fraction
    result += second
    result *= fraction
    result += first
    result *= fraction
    result += origin
    return result


def stationary_fractions(
    first: FloatArray, second: FloatArray, third: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Cut cubics into three parts that are monotone.

    Parameters
    ----------
    first, second, third : (k,), any unit
        Coefficients of u, u**2, u**3.

    Returns
    -------
    lower, upper : (k,)
        Fractions ``0 <= lower <= upper <= 1`` where the derivative is zero; a fraction that
        is not needed is 0 or 1.

    Examples
    --------
    >>> stationary_fractions(np.array([3.0]), np.array([-8.0]), np.array([4.0]))
    (array([0.]), array([0.2257]))
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        # Sum of equal signs only, so that neither root loses digits.
        root = np.sqrt(second * second - 3.0 * (third * first))
        sum_ = -(second + np.copysign(root, second))
        one, other = sum_ / (3.0 * third), first / sum_
    one = np.where((one > 0.0) & (one < 1.0), one, 0.0)
    other = np.where((other > 0.0) & (other < 1.0), other, 0.0)
    lower, upper = np.minimum(one, other), np.maximum(one, other)
    return lower, np.where(upper > 0.0, upper, 1.0)


def differentiate(coefficients: FloatArray) -> FloatArray:
    """Differentiate polynomials in power form.

    Parameters
    ----------
    coefficients : (s, d + 1, ...)
        Ascending powers along the second axis.

    Returns
    -------
    (s, d, ...)
        The coefficients of the derivatives.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.numeric.polynomials import differentiate
    >>> differentiate(np.array([[5.0, 1.0, 4.0]]))
    array([[1., 8.]])
    """
    factors = np.arange(1.0, coefficients.shape[1])
    slopes: FloatArray = coefficients[:, 1:] * factors.reshape(-1, *(1,) * (coefficients.ndim - 2))
    freeze(slopes)
    return slopes


def hermite(
    begin: FloatArray, end: FloatArray, leave: FloatArray, arrive: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Give cubics from 0 to 1 by values and slopes at both ends.

    Parameters
    ----------
    begin, end : any shape
        Values at 0 and 1.
    leave, arrive : the same shape
        Derivatives there.

    Returns
    -------
    four arrays of that shape
        The coefficients of 1, u, u^2 and u^3.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.numeric.polynomials import hermite
    >>> [float(each[0]) for each in hermite(*np.array([[0.0], [1.0], [0.0], [0.0]]))]
    [0.0, 0.0, 3.0, -2.0]
    """
    rise = end - begin
    return begin, leave, 3.0 * rise - 2.0 * leave - arrive, leave + arrive - 2.0 * rise


def horner(coefficients: FloatArray, u: FloatArray) -> FloatArray:
    """Evaluate polynomials in power form.

    Parameters
    ----------
    coefficients : (s, d + 1) or (s, d + 1, 3)
        Ascending powers along the second axis.
    u : (s, k)
        Parameters, k for each polynomial.

    Returns
    -------
    (s, k) or (s, k, 3)
        The values.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.numeric.polynomials import horner
    >>> horner(np.array([[1.0, 0.0, 2.0]]), np.array([[0.0, 0.5, 1.0]]))
    array([[1. , 1.5, 3. ]])
    """
    at = u[..., None] if coefficients.ndim == 3 else u
    value = coefficients[:, -1, None] + 0.0 * at
    for column in range(coefficients.shape[1] - 2, -1, -1):
        value = value * at + coefficients[:, column, None]
    result: FloatArray = value
    freeze(result)
    return result


def roots_with_tangents(
    coefficients: FloatArray, u: FloatArray, simple: NDArray[np.bool_]
) -> FloatArray:
    """Let roots (s, k) vary with the coefficients (s, d + 1) of polynomials, as ``p(u) = 0`` wants.

    Only those vary that are `simple` roots; other places stay. The values stay the same; tangents
    or an imaginary part come with those of the coefficients.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.numeric.dual import Dual
    >>> from assoc_hull.geometry.numeric.polynomials import roots_with_tangents
    >>> square = Dual([[-4.0, 0.0, 1.0]], [[[-1.0, 0.0, 0.0]]])  # u^2 = 4 + e, u = 2 + e / 4
    >>> roots_with_tangents(square, np.array([[2.0]]), np.array([[True]])).dot.tolist()
    [[[0.25]]]
    """
    if is_plain(coefficients):
        return u
    left = horner(coefficients, u)
    slope = np.where(simple, horner(differentiate(real(coefficients)), u), np.inf)
    roots: FloatArray = u - (left - real(left)) / slope
    return roots


_ROUNDING = 4e-16  # a step below this changes nothing in [0, 1]
_HALVINGS = 80  # more than bisection alone needs
_FEW = 48  # brackets, so many as plain numbers are faster for than arrays

STEPS = 3
"""From the secant, three steps of Halley's rule reach the last bits of nearly all roots."""

FLOOR, RELATIVE = 1e-14, 1e-15
MOST_TRIALS = 200


def bracketed_roots(
    cubic: FloatArray,
    lower: FloatArray,
    upper: FloatArray,
    at_lower: FloatArray,
    at_upper: FloatArray,
    start: FloatArray | None = None,
    factor: float = 1.0,
) -> FloatArray:
    """Find the one root of each cubic (4, k) in a bracket in which it changes sign once.

    Of the values at the ends of a bracket one is negative, the other is not: they decide the sign,
    whatever rounding makes of the cubic itself. The root is exactly the end where a value is zero.
    Steps begin at `start`, or at the root of the secant.

    Every cubic takes the same fixed steps; the few whose residual is not yet at rounding level, or
    that left their bracket, start again with bisection as a safeguard. Either way a root depends on
    its own cubic only. `factor`, at most 1, is what lengths of a short hull are multiplied by.

    Examples
    --------
    >>> cubic = np.array([[-0.125], [0.0], [0.0], [1.0]])
    >>> bracketed_roots(cubic, np.zeros(1), np.ones(1), np.array([-0.125]), np.array([0.875]))
    array([0.5])
    """
    origin, first, second, third = cubic
    limit = factor * FLOOR + RELATIVE * (np.abs(at_lower) + np.abs(at_upper))
    if start is None:
        root = lower + (upper - lower) * (at_lower / (at_lower - at_upper))
    else:
        root = start.copy()
    with np.errstate(all="ignore"):
        steep = 3.0 * third
        for _ in range(STEPS):
            root -= _halley(origin, first, second, third, steep, root)
        residual = np.abs(cubic_values(origin, first, second, third, root))
        good = (residual <= limit) & (root >= lower) & (root <= upper)
    at_begin, at_end = at_lower == 0.0, at_upper == 0.0
    # Many intersections lie on knots: those are known, whatever the steps have made of them.
    bad = np.flatnonzero(~(good | at_begin | at_end))
    if len(bad):
        rising = at_lower[bad] < 0.0
        root[bad] = _safe_roots(cubic[:, bad], lower[bad], upper[bad], rising, limit[bad])
    np.copyto(root, lower, where=at_begin)
    np.copyto(root, upper, where=at_end)
    return root


def _halley(
    origin: FloatArray,
    first: FloatArray,
    second: FloatArray,
    third: FloatArray,
    steep: FloatArray,
    root: FloatArray,
) -> FloatArray:
    """Give the step f f' / (f'**2 - f f'' / 2)."""
    height = cubic_values(origin, first, second, third, root)
    bend = steep * root
    bend += second
    slope = bend + second
    slope *= root
    slope += first
    bend *= height
    height *= slope
    slope *= slope
    slope -= bend
    height /= slope
    return height


def _safe_roots(
    cubic: FloatArray,
    lower: FloatArray,
    upper: FloatArray,
    rising: np.typing.NDArray[np.bool_],
    limit: FloatArray,
) -> FloatArray:
    """Find roots by Newton's rule, every third trial and whenever it fails by bisection."""
    result = 0.5 * (lower + upper)
    active = np.arange(len(result))
    for trial in range(MOST_TRIALS):
        root = result[active]
        origin, first, second, third = cubic[:, active]
        height = cubic_values(origin, first, second, third, root)
        above = (height >= 0.0) == rising[active]
        upper[active] = np.where(above, root, upper[active])
        lower[active] = np.where(above, lower[active], root)
        low, high = lower[active], upper[active]
        middle = 0.5 * (low + high)
        with np.errstate(all="ignore"):
            slope = first + root * (2.0 * second + root * (3.0 * third))
            newton = root - height / slope
        bisect = ~((newton > low) & (newton < high)) | (trial % 3 == 2)
        more = (np.abs(height) > limit[active]) & (middle > low) & (middle < high)
        result[active] = np.where(more, np.where(bisect, middle, newton), root)
        active = active[more]
        if not len(active):
            break
    return result


def quadratic_roots(constant: FloatArray, linear: FloatArray, square: FloatArray) -> FloatArray:
    """Give the real roots of ``constant + linear u + square u^2``, (p, 2), ascending.

    They are nan where there are none, and infinite or nan where the degree is less than two.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.numeric.polynomials import quadratic_roots
    >>> quadratic_roots(np.array([2.0, 1.0]), np.array([-3.0, 0.0]), np.array([1.0, 1.0]))
    array([[ 1.,  2.],
           [nan, nan]])
    """
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        discriminant = linear * linear - 4.0 * constant * square
        # Adding numbers of one sign keeps the digits that the textbook formula loses.
        larger = -0.5 * (linear + np.copysign(np.sqrt(discriminant), linear))
        pair = np.stack([larger / square, constant / larger], axis=-1)
    # 0 / 0 where both roots are zero.
    pair[..., 1] = np.where(larger == 0.0, pair[..., 0], pair[..., 1])
    roots: FloatArray = np.sort(pair, axis=-1)
    freeze(roots)
    return roots


def unit_roots(coefficients: FloatArray) -> FloatArray:
    """Split [0, 1] so that each polynomial (p, d + 1), d >= 2, keeps its sign on every part.

    The result is (p, d), ascending: every root at which the sign changes, and harmless repetitions
    or other places in the room that is left. Between neighbouring roots of its derivative a
    polynomial is monotone and has one root at most, which bisection with Newton steps cannot miss.
    No coefficient is divided by, so a polynomial of lower degree than its row is as good as any.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.numeric.polynomials import unit_roots
    >>> cubic = np.array([[-0.09375, 0.6875, -1.5, 1.0]])  # (u - 1/4) (u - 1/2) (u - 3/4)
    >>> [round(float(u), 12) for u in unit_roots(cubic)[0]]
    [0.25, 0.5, 0.75]
    """
    count, degree = coefficients.shape[0], coefficients.shape[1] - 1
    if degree == 2:
        roots = quadratic_roots(coefficients[:, 0], coefficients[:, 1], coefficients[:, 2])
        clipped = np.sort(np.clip(np.where(np.isnan(roots), 0.0, roots), 0.0, 1.0), axis=1)
        freeze(clipped)
        return clipped
    inner = unit_roots(differentiate(coefficients))
    edge = np.concatenate([np.zeros((count, 1)), inner, np.ones((count, 1))], axis=1)
    negative = horner(coefficients, edge) < 0.0
    row, column = np.nonzero(negative[:, :-1] != negative[:, 1:])
    found = edge[:, :-1].copy()
    found[row, column] = _bracketed(
        coefficients[row], edge[row, column], edge[row, column + 1], negative[row, column]
    )
    freeze(found)
    return found


def _bracketed(
    coefficients: FloatArray, low: FloatArray, high: FloatArray, rising: NDArray[np.bool_]
) -> FloatArray:
    """Find the one root in each bracket: Newton steps where they halve, else bisection."""
    if len(low) <= _FEW:
        # Calls of numpy cost more than the arithmetic here; plain numbers have the same bits.
        given = zip(
            coefficients.tolist(), low.tolist(), high.tolist(), rising.tolist(), strict=True
        )
        return np.array([_bracketed_one(*each) for each in given], np.float64)
    columns = list(np.ascontiguousarray(coefficients.T))
    slopes = [power * column for power, column in enumerate(columns[1:], 1)]
    at, last = 0.5 * (low + high), high - low
    alive = np.ones(len(at), bool)
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        for _ in range(_HALVINGS):
            if not alive.any():
                break
            height = _value(columns, at)
            right = (height < 0.0) == rising
            low, high = np.where(right, at, low), np.where(right, high, at)
            aim = at - height / _value(slopes, at)
            good = (aim >= low) & (aim <= high) & (np.abs(aim - at) <= 0.5 * last)
            aim = np.where(height == 0.0, at, np.where(good, aim, 0.5 * (low + high)))
            last = np.abs(aim - at)
            # A root that has settled stays: its last bit must not depend on the others.
            at = np.where(alive, aim, at)
            alive &= last > _ROUNDING
    return at


def _value(columns: list[FloatArray], at: FloatArray) -> FloatArray:
    """Evaluate polynomials by their coefficients, power by power, at one place each."""
    value = columns[-1] + 0.0 * at
    for column in columns[-2::-1]:
        value *= at
        value += column
    return value


def _bracketed_one(coefficients: list[float], low: float, high: float, rising: bool) -> float:
    """Find the one root in a bracket as `_bracketed` does, operation by operation."""
    falling = coefficients[::-1]
    slopes = [power * each for power, each in enumerate(coefficients[1:], 1)][::-1]
    at, last = 0.5 * (low + high), high - low
    for _ in range(_HALVINGS):
        height, slope = _value_one(falling, at), _value_one(slopes, at)
        if height == 0.0:
            break
        if (height < 0.0) == rising:
            low = at
        else:
            high = at
        aim = at - height / slope if slope else np.inf
        if not (low <= aim <= high and abs(aim - at) <= 0.5 * last):
            aim = 0.5 * (low + high)
        last, at = abs(aim - at), aim
        if not last > _ROUNDING:
            break
    return at


def _value_one(falling: list[float], at: float) -> float:
    value = falling[0]
    for each in falling[1:]:
        value = value * at + each
    return value


# --------------------------------------------------------------------------------------
# Roots of any continuous functions in brackets, without derivatives.

BracketedFunction = Callable[[IntArray, FloatArray], FloatArray]
"""Takes rows (k,) of the brackets and places (k,) in them, and gives the values there, (k,)."""

_ROUNDS = 80
"""Steps of a bracketed root, seldom more than ten."""


def false_position(
    give: BracketedFunction,
    low: FloatArray,
    high: FloatArray,
    at_low: FloatArray,
    at_high: FloatArray,
    enough: ArrayLike = 1e-13,
) -> FloatArray:
    """Find one root in every bracket (k,) by the Illinois rule; `high` may be below `low`.

    Of the values at the ends one is negative and the other is not. A root is found where the value
    or the bracket is as small as `enough`; the place with the smallest value seen is given.
    """
    a, b, fa, fb = low.copy(), high.copy(), at_low.copy(), at_high.copy()
    enough = np.broadcast_to(np.asarray(enough, np.float64), a.shape)
    best = np.where(np.abs(fa) <= np.abs(fb), a, b)
    least = np.minimum(np.abs(fa), np.abs(fb))
    for _ in range(_ROUNDS):
        open_ = np.flatnonzero((least > enough) & (np.abs(b - a) > enough))
        if not len(open_):
            break
        x, y, fx, fy = a[open_], b[open_], fa[open_], fb[open_]
        mid = x - fx * (y - x) / (fy - fx)
        mid = np.where((mid > np.minimum(x, y)) & (mid < np.maximum(x, y)), mid, 0.5 * (x + y))
        value = give(open_, mid)
        good = np.abs(value) < least[open_]
        best[open_] = np.where(good, mid, best[open_])
        least[open_] = np.where(good, np.abs(value), least[open_])
        same = (value >= 0.0) == (fy >= 0.0)
        # The end that stays counts half (Illinois), or it would stay for good.
        a[open_], fa[open_] = np.where(same, x, y), np.where(same, 0.5 * fx, fy)
        b[open_], fb[open_] = mid, value
    return best


_TRIALS = 100
"""Most trials of Brent's rule; bisection alone reaches the last bit from 1 km in 60."""
_LEAST_RTOL = 2.0**-50
"""Four units of the last place."""


def brent_root(
    give: Callable[[float], float],
    low: float,
    high: float,
    *,
    xtol: float,
    rtol: float = _LEAST_RTOL,
) -> float:
    """Find one root in a bracket to ``xtol + rtol |x|``; of the values at its ends one is negative.

    Brent (1973), *Algorithms for Minimization without Derivatives*, chapter 4, in the form of
    scipy, operation by operation. scipy.optimize costs a third of a second when it is imported
    first, and its compiled form may fuse products with sums, which gives other bits elsewhere.

    Examples
    --------
    >>> from assoc_hull.geometry.numeric.polynomials import brent_root
    >>> brent_root(lambda x: x * x - 4.0, 0.0, 5.0, xtol=1e-12)
    2.0
    """
    before, at = float(low), float(high)
    f_before, f_at = float(give(before)), float(give(at))
    if f_before == 0.0:
        return before
    if f_at == 0.0:
        return at
    if (f_before < 0.0) == (f_at < 0.0):
        raise ValueError(f"no root between {low:g} and {high:g}: {f_before:g} and {f_at:g} there")
    # The root lies between `at` and `other`; `before` is the place before `at`.
    other, f_other = before, f_before
    step = last = at - before
    for _ in range(_TRIALS):
        if f_before != 0.0 and (f_before < 0.0) != (f_at < 0.0):
            other, f_other = before, f_before
            step = last = at - before
        if abs(f_other) < abs(f_at):
            before, at, other = at, other, at
            f_before, f_at, f_other = f_at, f_other, f_at
        least = (xtol + rtol * abs(at)) / 2.0
        half = (other - at) / 2.0
        if f_at == 0.0 or abs(half) < least:
            return at
        trial = np.inf
        if abs(last) > least and abs(f_at) < abs(f_before):
            trial = _brent_trial(before, at, other, f_before, f_at, f_other)
        if 2.0 * abs(trial) < min(abs(last), 3.0 * abs(half) - least):
            # The next trial is held against this step, not against the one of this round.
            last, step = step, trial
        else:
            last = step = half
        before, f_before = at, f_at
        if abs(step) > least:
            at += step
        else:
            at += least if half > 0.0 else -least
        f_at = float(give(at))
    raise ValueError(f"no root between {low:g} and {high:g} within {_TRIALS} trials")


def _brent_trial(
    before: float, at: float, other: float, f_before: float, f_at: float, f_other: float
) -> float:
    """Give the step of the secant, or of the inverse parabola where three places differ."""
    if before == other:
        return -f_at * (at - before) / (f_at - f_before)
    down = (f_before - f_at) / (before - at)
    up = (f_other - f_at) / (other - at)
    divisor = up * down * (f_other - f_before)
    return -f_at * (f_other * up - f_before * down) / divisor if divisor else np.inf
