"""Arcs as heights over a border of their cell: at a running parameter t, the other one.

In a simple cell every line t = constant meets the zero set at most once. Where it does, the
polynomial on that line, sum over j of b[:, j] B_j(t), changes sign once, and this gives the height.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.heights import heights
>>> b = np.array([[[-1.0, -2.0], [3.0, 2.0]]])
>>> heights(b, np.array([True]), np.array([[0.0, 1.0]]))
array([[0.25, 0.5 ]])
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.algebra import binomials
from assoc_hull.geometry.patches.cells import Cells
from assoc_hull.geometry.patches.roots import crossing, powers

__all__ = ["bernstein_table", "heights", "polynomials_over"]


def polynomials_over(cells: Cells, rows: NDArray[np.intp], across: int) -> FloatArray:
    """Give the polynomials of simple cells, the running parameter last.

    Parameters
    ----------
    cells : Cells
        The cells.
    rows : (c,) int
        Some of them, all u-simple or all v-simple.
    across : int
        0 where they are u-simple, 1 where u runs: the parameters are exchanged then.

    Returns
    -------
    (c, A + 1, T + 1)
        Their coefficients.
    """
    b = cells.b[cells.row[rows]]
    return np.ascontiguousarray(b.swapaxes(1, 2)) if across else b


def bernstein_table(t: FloatArray, degree: int) -> FloatArray:
    """Give the Bernstein polynomials of a degree at places t (r,): (degree + 1, r)."""
    if degree == 0:
        return np.ones((1, len(t)))
    table = powers(t, degree + 1) * powers(1.0 - t, degree + 1)[::-1]
    return np.asarray(table * binomials(degree)[:, None])


def heights(
    b: FloatArray, rising: NDArray[np.bool_], t: FloatArray, start: FloatArray | None = None
) -> FloatArray:
    """Find the heights of arcs.

    Parameters
    ----------
    b : (c, A + 1, T + 1)
        Polynomials as `polynomials_over` gives them.
    rising : (c,) bool
        Whether they rise with the height.
    t : (c, q)
        Where: running parameters in [0, 1], from the start to the end of the cell.
    start : (c, q), optional
        The heights, if they are known roughly.

    Returns
    -------
    (c, q)
        Heights, 0 to 1 over the cell.
    """
    count, places = t.shape
    table = bernstein_table(t.reshape(-1), b.shape[2] - 1)
    lines = b @ np.ascontiguousarray(table.reshape(-1, count, places).swapaxes(0, 1))
    rows = lines.swapaxes(1, 2).reshape(count * places, -1)
    rough = None if start is None else start.reshape(-1)
    return crossing(rows, np.repeat(rising, places), rough).reshape(count, places)
