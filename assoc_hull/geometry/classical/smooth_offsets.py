"""Tables of offsets made smooth without a formula, or by smoothing splines to and fro.

Bakker's way knows no function: of n values at even places those are sought that leave the given
ones little and have small third differences,

    sum w_i (f_i - y_i)^2 + s sum (f_{i+3} - 3 f_{i+2} + 3 f_{i+1} - f_i)^2 = least.

Parabolas have none and are not changed. Corin's way smooths a table by waterlines, then by
sections, and again, until both agree.

Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK, Table 1.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import (
    digits,
    number,
    number_array,
    numbers,
    positive_weights,
    whole_number,
)
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["SmoothedTable", "smooth_offsets", "smooth_table"]


def smooth_offsets(y: ArrayLike, stiffness: float, weights: ArrayLike | None = None) -> FloatArray:
    """Give smooth values beside given ones, at even places.

    Parameters
    ----------
    y : (n,) or (n, k), m
        Four or more; columns are smoothed each on its own.
    stiffness : float
        s; 0 leaves everything, a great one gives the parabola of least squares.
    weights : (n,) or None
        Above 0.

    Returns
    -------
    of the shape of y, m

    Raises
    ------
    GeometryError
        Fewer than four values, a stiffness below 0, weights that are not positive.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.smooth_offsets import smooth_offsets
    >>> smooth_offsets([0.0, 1.0, 4.0, 9.0, 16.0], 10.0).round(9).tolist()
    [0.0, 1.0, 4.0, 9.0, 16.0]
    """
    from scipy.linalg import solveh_banded

    values = number_array(y, "offsets")
    if values.ndim not in (1, 2):
        raise GeometryError(f"offsets: shape {values.shape}", "give (n,) or (n, k)")
    stiff = number(stiffness, "offsets: stiffness")
    if len(values) < 4 or stiff < 0.0:
        what = f"offsets: {len(values)} values, stiffness {digits(stiff)}"
        raise GeometryError(what, "give four values or more, and a stiffness of 0 or more")
    w = positive_weights(weights, len(values), "offsets")
    third = np.array([-1.0, 3.0, -3.0, 1.0])
    bands = np.zeros((4, len(values)))
    for i in range(4):
        for j in range(i, 4):
            # Row i of each difference meets column j: the band j - i above the diagonal.
            bands[3 - (j - i), j : len(values) - 3 + j] += stiff * third[i] * third[j]
    bands[3] += w
    right = w.reshape(-1, *(1,) * (values.ndim - 1)) * values
    return np.asarray(solveh_banded(bands, right))


@attrs.frozen(eq=False)
class SmoothedTable:
    """A table of offsets that is smooth both ways.

    Attributes
    ----------
    y : (n, m), m
        Half-breadths, waterlines by stations.
    rounds : int
        So many were taken.
    change : float, m
        The largest change of the last round.
    moved : float, m
        The largest difference from what was given.
    """

    y: FloatArray
    rounds: int
    change: float
    moved: float

    def __attrs_post_init__(self) -> None:
        freeze(self.y)


def smooth_table(
    x: ArrayLike, z: ArrayLike, y: ArrayLike, lam: float, tolerance: float = 1e-4, most: int = 50
) -> SmoothedTable:
    """Smooth a table by waterlines and by sections in turn, until both agree.

    Parameters
    ----------
    x, z : (m,), (n,), m
        Stations and waterlines, rising, five or more each.
    y : (n, m), m
        Half-breadths.
    lam : float
        Weight of the squared second derivative, times length cubed (1): the same for both ways.
    tolerance : float, m
        A round that changes less is the last.
    most : int
        No more rounds than this.

    Raises
    ------
    GeometryError
        Fewer than five stations or waterlines, places that do not rise, a weight below 0.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.classical.smooth_offsets import smooth_table
    >>> x, z = np.linspace(0.0, 10.0, 9), np.linspace(0.0, 4.0, 6)
    >>> flat = smooth_table(x, z, 0.2 * x + 0.1 * z[:, None], 1e-3)
    >>> flat.rounds, flat.moved < 1e-9
    (1, True)
    """
    from scipy.interpolate import make_smoothing_spline

    stations, levels = numbers(x, "offsets", (None,)), numbers(z, "offsets", (None,))
    table = given = numbers(y, "offsets", (len(levels), len(stations)))
    weight, near = numbers([lam, tolerance], "offsets", (2,)).tolist()
    for each in (stations, levels):
        if len(each) < 5 or not (np.diff(each) > 0.0).all():
            what = f"offsets: {len(each)} places that do not all rise"
            raise GeometryError(what, "give five or more, rising")
    if weight < 0.0:
        raise GeometryError(f"offsets: weight {digits(weight)}", "give one of 0 or more")
    last = whole_number(most, "offsets: rounds", 1, 10_000)
    along, up = ((p - p[0]) / (p[-1] - p[0]) for p in (stations, levels))
    change, rounds = np.inf, 0
    while rounds < last and change > near:
        before, rounds = table, rounds + 1
        table = make_smoothing_spline(along, table, lam=weight, axis=1)(along)
        table = make_smoothing_spline(up, table, lam=weight, axis=0)(up)
        change = float(np.abs(table - before).max())
    moved = float(np.abs(table - given).max())
    return SmoothedTable(np.asarray(table), rounds, change, moved)
