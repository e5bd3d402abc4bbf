"""Rows of vectors: scalar products that do not depend on their company, and unit normals."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray

__all__ = ["check_normals", "dot"]

_UNIT = 1e-9  # by which the length of a unit normal may miss 1


def check_normals(normal: ArrayLike, count: int) -> FloatArray:
    """Give unit normals as an array of one row per item, or say what is wrong with them.

    Parameters
    ----------
    normal : (3,) or (count, 3)
        Unit vectors; a row of nan stands for "no plane" and is let through.
    count : int
        Number of rows wanted.

    Returns
    -------
    (count, 3)
        The normals.

    Raises
    ------
    BadInputError
        The shape is another, or a normal is not of unit length.

    Examples
    --------
    >>> from assoc_hull.geometry.numeric.vectors import check_normals
    >>> check_normals([0, 0, 1], 2).tolist()
    [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0]]
    """
    rows = np.asarray(normal, np.float64)
    if rows.shape not in ((3,), (count, 3)):
        raise BadInputError(
            f"plane normals of shape {rows.shape}",
            f"where (3,) or ({count}, 3) is wanted",
            "give one unit vector for all or one for each",
        )
    rows = np.broadcast_to(rows, (count, 3))
    size = np.sqrt(dot(rows, rows))
    bad = ~np.isnan(rows).all(axis=1) & ~(np.abs(size - 1.0) <= _UNIT)
    if bad.any():
        worst = int(np.argmax(bad))
        raise BadInputError(
            f"a plane normal {rows[worst].tolist()} of length {size[worst]:.6g}",
            f"in row {worst}",
            "divide it by its length",
        )
    return rows


def dot(left: FloatArray, right: FloatArray) -> FloatArray:
    """Give scalar products, each by the same three products and two sums.

    Parameters
    ----------
    left, right : (..., 3)
        Vectors; the shapes may be broadcast.

    Returns
    -------
    (...)
        The products; not frozen.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.numeric.vectors import dot
    >>> dot(np.array([[1.0, 2, 3], [0, 1, 0]]), np.array([1.0, 1, 2]))
    array([9., 1.])
    """
    product: FloatArray = (
        left[..., 0] * right[..., 0] + left[..., 1] * right[..., 1] + left[..., 2] * right[..., 2]
    )
    return product
