"""One polyline of digitised lines, and the numbers it is made of."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.arguments import shown
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray

__all__ = ["BESIDE", "BOUNDARIES", "RawPiece", "read_number", "refuse_retraced"]

BOUNDARIES = ("profile", "deck edge", "transom")
"""Names of boundary curves among digitised lines."""

BESIDE = ("diagonals", "boundary")
"""Families whose other curves are drawn beside digitised lines, and are none."""

_LARGEST = 1e9
"""No coordinate exceeds this in any unit."""

_VISITS = 3
"""A polyline that comes to one place more often than this goes over itself again and again."""


@attrs.frozen(eq=False)
class RawPiece:
    """One polyline as the file gives it.

    Attributes
    ----------
    line : str
        Name of the line it belongs to.
    points : (n, 3)
        In the unit of the file.
    where : str
        Row or entity, for messages.
    knuckles : (k, 3)
        Places that the file marks as knuckles, in its unit.
    """

    line: str
    points: FloatArray
    where: str
    knuckles: FloatArray = attrs.field(factory=lambda: np.zeros((0, 3)))


def read_number(cell: str, where: str, *, comma: bool = False) -> float:
    """Read a number, or say where there is none.

    Parameters
    ----------
    cell : str
        The text.
    where : str
        For the message.
    comma : bool
        Whether a comma may be the decimal sign.

    Raises
    ------
    BadInputError
        The text is no finite number, or one that no ship has.

    Examples
    --------
    >>> from assoc_hull.io.lines.digitised_piece import read_number
    >>> read_number("1,5", "row 2", comma=True)
    1.5
    """
    text = cell.strip()
    try:
        value = float(text.replace(",", ".") if comma else text)
    except ValueError:
        value = np.nan
    if not np.isfinite(value):
        raise BadInputError(f"{shown(cell)} is no number", where, "correct the cell")
    if abs(value) > _LARGEST:
        raise BadInputError(f"{shown(cell)} is too large for a ship", where, "correct the cell")
    return value


def refuse_retraced(piece: RawPiece) -> None:
    """Refuse a polyline that runs over its own points again and again.

    Raises
    ------
    BadInputError
        It does: rows of the file were written many times.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.io.lines.digitised_piece import RawPiece, refuse_retraced
    >>> refuse_retraced(RawPiece("WL 1", np.array([[0.0, 0, 1], [5, 2, 1], [9, 0, 1]]), "row 2"))
    """
    apart = np.append(True, (np.diff(piece.points, axis=0) != 0.0).any(axis=1))
    places, counts = np.unique(piece.points[apart], axis=0, return_counts=True)
    most = int(np.argmax(counts))
    if counts[most] > _VISITS:
        x, y, z = places[most].tolist()
        raise BadInputError(
            f"{piece.line} comes to ({x:.4g}, {y:.4g}, {z:.4g}) {counts[most]} times",
            f"in {piece.where}", "take out the rows that were written again",
        )  # fmt: skip
