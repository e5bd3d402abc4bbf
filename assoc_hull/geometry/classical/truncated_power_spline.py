"""The truncated-power spline, by the equal spline that can be computed, and why.

Theilheimer & Starkweather write a spline as one quadratic and a sum of truncated powers,
``y = a + b x + c x^2 + A_0 x^3 + sum A_j (x - x_j)_+^3``, x measured from the first point. The
terms reach over all that follows and are nearly parallel, so to solve for them directly loses
digits. The same curve is the natural cubic spline (y'' = 0 at both ends, which is our choice:
the form leaves two conditions open); its cubics give the coefficients by differences.

6 A_j is the jump of y''' at x_j. It is proportional to the force with which a batten rests on
its support there (6 E I A_j), and tells where a line is unfair.

Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK, eq. 8.

Examples
--------
>>> from assoc_hull.geometry.classical.truncated_power_spline import TruncatedPower
>>> spline = TruncatedPower.through([0, 2, 4, 7, 9], [0, 1, 1.5, 1.2, 0])
>>> round(spline.b, 6), spline.jumps.round(6).tolist()
(0.554506, [-0.013626, 0.019259, -0.015371, 0.03234])
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import CubicSpline, PPoly

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import check_magnitude, finite_array, within_range
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["TruncatedPower", "power_columns", "solve_truncated_powers"]


@attrs.frozen(eq=False)
class TruncatedPower:
    """A spline y(x) in truncated powers, of which no more than a table is ever evaluated.

    Attributes
    ----------
    x, y : (n,), m
        The points.
    a, b, c : float
        Of the quadratic in x - x_0: m, 1, 1/m.
    jumps : (n - 1,), 1/m2
        A_0 and a sixth of the jump of y''' at each inner point.
    curve : scipy.interpolate.PPoly
        The same curve, x as it was given.
    """

    x: FloatArray
    y: FloatArray
    a: float
    b: float
    c: float
    jumps: FloatArray
    curve: PPoly

    def __attrs_post_init__(self) -> None:
        freeze(self.x, self.y, self.jumps)

    @classmethod
    def through(cls, x: ArrayLike, y: ArrayLike) -> Self:
        """Lay the natural spline through points.

        Parameters
        ----------
        x, y : (n,), m
            Three points or more, x ascending.

        Raises
        ------
        GeometryError
            ``"spline: at least 3 points"``, ``"spline: x not strictly increasing at {i}"``.
        """
        places, heights = _checked(x, y)
        curve = CubicSpline(places, heights, bc_type="natural")
        cube, square, slope, height = curve.c
        jumps = np.concatenate([cube[:1], np.diff(cube)])
        return cls(
            places, heights, float(height[0]), float(slope[0]), float(square[0]), jumps,
            PPoly(curve.c, curve.x),
        )  # fmt: skip

    def at(self, x: ArrayLike) -> FloatArray:
        """Give y (m) at x of any shape.

        Raises
        ------
        GeometryError
            ``"spline: x={x} outside [{a}, {b}]"``.
        """
        found = within_range(x, "spline", float(self.x[0]), float(self.x[-1]))
        return np.asarray(self.curve(found))

    @property
    def unfairness(self) -> float:
        """Root of the sum of squares of the jumps of y''' at inner points, 1/m2."""
        return float(6.0 * np.sqrt((self.jumps[1:] ** 2).sum()))


def _checked(x: ArrayLike, y: ArrayLike) -> tuple[FloatArray, FloatArray]:
    places = check_magnitude(finite_array(x, "spline", (None,)), "spline")
    if len(places) < 3:
        raise GeometryError("spline: at least 3 points", "give more", {"points": len(places)})
    heights = check_magnitude(finite_array(y, "spline", (len(places),)), "spline")
    back = np.diff(places) <= 0.0
    if back.any():
        index = int(np.argmax(back)) + 1
        raise GeometryError(
            f"spline: x not strictly increasing at {index}", "sort the points, each x once",
            {"index": index, "x": float(places[index])},
        )  # fmt: skip
    return places, heights


def power_columns(x: ArrayLike) -> FloatArray:
    """Give the square system of truncated powers, natural ends as its last two rows.

    It is here to show what it costs to solve it; nothing else uses it.

    Parameters
    ----------
    x : (n,), m
        Ascending; taken as they are, not from the first.

    Returns
    -------
    (n + 2, n + 2)
        Columns 1, x, x^2, x^3 and the truncated powers; rows: the values at the points, then
        the second derivatives at both ends.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.classical.truncated_power_spline import power_columns
    >>> near, far = (power_columns(np.linspace(x, x + 100.0, 41)) for x in (0.0, 1000.0))
    >>> bool(np.linalg.cond(far) > 1e9 * np.linalg.cond(near))
    True
    """
    places = finite_array(x, "spline", (None,))
    places = _checked(places, np.zeros(len(places)))[0]
    beyond = np.maximum(places[:, None] - places[None, 1:-1], 0.0)
    values = np.column_stack([places[:, None] ** np.arange(4), beyond**3])
    ends = places[[0, -1]]
    bends = np.column_stack([np.zeros((2, 2)), np.full(2, 2.0), 6.0 * ends, 6.0 * beyond[[0, -1]]])
    return np.vstack([values, bends])


def solve_truncated_powers(x: ArrayLike, y: ArrayLike) -> FloatArray:
    """Solve for the coefficients a, b, c, A_0, A_1 ... of powers of x itself, (n + 2,).

    For comparison only: it loses digits where x is far from 0 or points are many.

    Raises
    ------
    GeometryError
        As `TruncatedPower.through`.
    """
    places, heights = _checked(x, y)
    right = np.concatenate([heights, [0.0, 0.0]])
    try:
        return np.asarray(np.linalg.solve(power_columns(places), right))
    except np.linalg.LinAlgError:
        what = "spline: the columns of truncated powers are parallel to rounding"
        raise GeometryError(what, "measure x from the first point") from None
