"""Half waterlines and curves of areas as polynomials of form parameters: Taylor, Benson, others.

D.W. Taylor's quintic runs from the end of the ship (x = 0) to midship (x = 1),

    y = t x + a x^2 + b x^3 + c x^4 + d x^5,     y(1) = 1, y'(1) = 0, y''(1) = p, area C;

t is the angle of the end, p the bend amidships, C the fullness. Any other set of linear conditions
on any powers is `form_polynomial`. Products and parabolas stand at the end: Chapman's 1 - x^n,
Weinblum's and Thieme's (1 - sum a_n |x|^n)(1 - sum b_m zeta^m), x from amidships, zeta from the
waterline downward.

Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK, Table 1, which names them; the equations are the well-known ones.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import numpy as np
from numpy.polynomial.polynomial import polyval
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import listed, number, numbers, together
from assoc_hull.geometry.classical.checks import called, figure, inside
from assoc_hull.geometry.classical.choices import one_of
from assoc_hull.geometry.curves import FloatArray

__all__ = ["chapman", "form_polynomial", "product_hull", "taylor_quintic"]

Condition = tuple[Literal["value", "slope", "bend", "area", "moment"], float, float]

_CONDITIONS = ("value", "slope", "bend", "area", "moment")


def taylor_quintic(t: ArrayLike, p: ArrayLike, c: ArrayLike) -> FloatArray:
    """Give Taylor's quintics.

    Parameters
    ----------
    t : (...)
        Slope at the end, in half-breadths by half length.
    p : (...)
        Second derivative amidships, in the same unit.
    c : (...)
        Area under the curve: the waterplane or prismatic coefficient of this half.

    Returns
    -------
    (..., 6)
        Ascending powers of x: 0, t, a, b, c, d. Evaluate by `numpy.polynomial`.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.form_polynomials import taylor_quintic
    >>> taylor_quintic(1.8, -2.2, 0.7).round(9).tolist()
    [0.0, 1.8, 2.3, -8.8, 8.5, -2.8]
    """
    end, bend, full = together((t, p, c), "Taylor quintic")
    power = np.arange(2.0, 6.0)
    rows = np.stack([np.ones(4), power, power * (power - 1.0), 1.0 / (power + 1.0)])
    right = np.stack([1.0 - end, -end, bend, full - 0.5 * end], axis=-1)
    rest = np.linalg.solve(rows, right[..., None])[..., 0]
    return np.concatenate([np.stack([np.zeros_like(end), end], axis=-1), rest], axis=-1)


def form_polynomial(powers: Sequence[int], conditions: Sequence[Condition]) -> FloatArray:
    """Give the polynomial of some powers of x that satisfies conditions.

    Parameters
    ----------
    powers : sequence of int
        Of which it is made, 0 or more; as many as there are conditions.
    conditions : sequence of (str, float, float)
        What, where, how much: "value", "slope" or "bend" (second derivative) at x; "area" or
        "moment" (integral of x y) from 0 to x.

    Returns
    -------
    (n,)
        Ascending powers, up to the highest.

    Raises
    ------
    GeometryError
        Powers and conditions of other counts, conditions that no such polynomial or more than
        one satisfies.

    Examples
    --------
    A run that begins at 0.1 with slope 2 and has area 0.7 and moment 0.4 up to midship:

    >>> from assoc_hull.geometry.classical.form_polynomials import form_polynomial
    >>> run = form_polynomial(range(6), [("value", 0, 0.1), ("slope", 0, 2), ("value", 1, 1),
    ...                                  ("slope", 1, 0), ("area", 1, 0.7), ("moment", 1, 0.4)])
    >>> round(float(run.sum()), 9)
    1.0
    """
    kinds = [_condition(each) for each in listed(conditions, "form polynomial")]
    power = numbers(listed(powers, "form polynomial"), "form polynomial", (None,))
    if len(power) != len(kinds) or not len(power):
        what = f"form polynomial: {len(power)} powers, {len(kinds)} conditions"
        raise GeometryError(what, "give as many conditions as powers")
    if (power < 0.0).any() or (power % 1.0 != 0.0).any() or (power > 50.0).any():
        raise GeometryError("form polynomial: powers are not whole", "give 0 to 50")
    x = np.array([place for _, place, _ in kinds])[:, None]
    rows = np.empty((len(power), len(power)))
    for row, (kind, _, _), place in zip(rows, kinds, x, strict=True):
        row[:] = _row(kind, float(place[0]), power)
    size = np.abs(rows).max(axis=1, keepdims=True)
    if not (size > 0.0).all() or np.linalg.matrix_rank(rows / size) < len(power):
        what = "form polynomial: the conditions do not make one polynomial"
        raise GeometryError(what, "leave out a condition that says what another says")
    found = np.linalg.solve(rows / size, np.array([v for *_, v in kinds]) / size[:, 0])
    whole = np.zeros(int(power.max()) + 1)
    whole[power.astype(int)] = found
    return whole


def chapman(x: ArrayLike, n: float = 2.0) -> FloatArray:
    """Give Chapman's parabola 1 - x^n, x from 0 amidships to 1 at the end; in half-breadths.

    Raises
    ------
    GeometryError
        An x outside; a power that is not above 0.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.form_polynomials import chapman
    >>> round(float(chapman(0.4)), 12)
    0.84
    """
    power = number(n, "Chapman parabola")
    if power <= 0.0:
        what = f"Chapman parabola: power {figure(power)}"
        raise GeometryError(what, "give one above 0", {"n": power})
    return np.asarray(1.0 - inside(x, "Chapman parabola", 0.0, 1.0) ** power)


def product_hull(x: ArrayLike, zeta: ArrayLike, a: ArrayLike, b: ArrayLike) -> FloatArray:
    """Give half-breadths y = (1 - sum a_n |x|^n)(1 - sum b_m zeta^m), in half beams.

    Parameters
    ----------
    x : (...)
        From -1 to 1, from midship in half lengths.
    zeta : (...)
        From 0 at the waterline to 1 at the keel.
    a, b : (n,), (m,)
        Coefficients of powers 1, 2, 3 ...

    Raises
    ------
    GeometryError
        Places outside.

    Examples
    --------
    Wigley's hull, a = b = (0, 1):

    >>> from assoc_hull.geometry.classical.form_polynomials import product_hull
    >>> float(product_hull(-0.5, 0.5, [0, 1], [0, 1]))
    0.5625
    """
    along = np.abs(inside(x, "product hull", -1.0, 1.0))
    down = inside(zeta, "product hull", 0.0, 1.0)
    first, second = (
        np.concatenate([[1.0], -numbers(each, "product hull", (None,))]) for each in (a, b)
    )
    along, down = together((along, down), "product hull")
    return np.asarray(polyval(along, first) * polyval(down, second))


def _condition(given: Condition) -> Condition:
    try:
        kind, place, value = given
    except (TypeError, ValueError):
        what = f"form polynomial: condition {called(given)}"
        raise GeometryError(what, "give (what, where, how much)") from None
    one_of(kind, tuple(_CONDITIONS), "form polynomial: no condition is called")
    x, wanted = numbers([place, value], "form polynomial", (2,)).tolist()
    return kind, x, wanted


def _row(kind: str, x: float, power: FloatArray) -> FloatArray:
    """Give what each power contributes to a condition."""
    match kind:
        case "value":
            row = x**power
        case "slope":
            row = power * x ** np.maximum(power - 1.0, 0.0)
        case "bend":
            row = power * (power - 1.0) * x ** np.maximum(power - 2.0, 0.0)
        case "area":
            row = x ** (power + 1.0) / (power + 1.0)
        case _:
            row = x ** (power + 2.0) / (power + 2.0)
    return np.asarray(row)
