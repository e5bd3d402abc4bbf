"""Straight runs among points, and where a line of points turns back.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.classical.biarc_runs import straight_runs
>>> unit = np.array([[1.0, 0.0], [1.0, 0.0], [0.6, 0.8], [0.8, 0.6]])
>>> straight_runs(unit, 1e-9)
[(0, 2)]
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.curves import FloatArray

__all__ = ["straight_runs"]


def straight_runs(unit: FloatArray, sine: float, offset: int = 0) -> list[tuple[int, int]]:
    """Give the first and last points of all straight runs of three points or more.

    Parameters
    ----------
    unit : (n - 1, 2)
        Unit chords between n points.
    sine : float
        Largest sine of the angle between chords that lie in a row.
    offset : int
        Number of the first point, for messages.

    Raises
    ------
    GeometryError
        ``"biarc: curve reverses at point {i}"``; ``"biarc: point {i} belongs to two different
        straight runs; mark it as a knuckle"``.
    """
    before, behind = unit[:-1], unit[1:]
    across = np.abs(before[:, 0] * behind[:, 1] - before[:, 1] * behind[:, 0])
    ahead = np.sum(before * behind, axis=1) > 0.0
    level = across <= sine
    _refuse(level & ~ahead, "curve reverses at point {}", "mark it as a knuckle", offset)
    row = level & ahead
    twice = np.zeros_like(row)
    twice[1:-1] = row[:-2] & row[2:] & ~row[1:-1]
    what = "point {} belongs to two different straight runs; mark it as a knuckle"
    _refuse(twice, what, "the line has a corner there", offset)
    edges = np.diff(np.concatenate([[False], row, [False]]).astype(np.int8))
    first, behind_last = np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
    return list(zip(first.tolist(), (behind_last + 1).tolist(), strict=True))


def _refuse(bad: NDArray[np.bool_], what: str, remedy: str, offset: int) -> None:
    """Refuse where an inner point is bad; numbers count from the first point."""
    if bad.any():
        index = offset + 1 + int(np.argmax(bad))
        raise GeometryError(f"biarc: {what.format(index)}", remedy, {"index": index})
