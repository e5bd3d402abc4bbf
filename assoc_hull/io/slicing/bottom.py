"""A hull whose bottom is missing: its sections begin far from the centre plane, on no boundary.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.io.offset_report import Notebook
>>> from assoc_hull.io.slicing.bottom import tell_bottom
>>> from assoc_hull.io.lines.slices import Piece, SliceLine
>>> piece = Piece(np.array([[5.0, 3, 0], [5, 4, 2]]), ("loose", "deck edge"))
>>> book = Notebook()
>>> tell_bottom([SliceLine("sections", "ST 5", 5.0, (piece,))], 4.0, book)
>>> print(book.report().suspicions[0])
bottom missing: the sections: 1 of 1 begin off the centre plane, by up to 3 m (ST 5)
"""

from __future__ import annotations

from collections.abc import Sequence

from assoc_hull.errors import BadInputError
from assoc_hull.io.lines.slices import SliceLine, Slices
from assoc_hull.io.offset_report import Notebook

__all__ = ["BOTTOM", "refuse_bottomless", "tell_bottom"]

BOTTOM = "bottom missing"

_OFF = 0.02
"""A section that begins this part of the half-breadth off the centre plane does not reach it."""

_MANY = 0.1
"""One section of ten may do so: a hole, which is told of by itself."""


def tell_bottom(lines: Sequence[SliceLine], half: float, book: Notebook) -> None:
    """Tell of sections that do not reach the centre plane.

    Parameters
    ----------
    lines : sequence of SliceLine
        All lines; their loose ends are joined.
    half : float, m
        Half the breadth of the hull.
    book : Notebook
        Takes what was found.
    """
    sections = [line for line in lines if line.group == "sections"]
    off = {line.name: _gap(line) for line in sections}
    bad = {name: gap for name, gap in off.items() if gap > _OFF * half}
    if len(bad) <= _MANY * len(sections):
        return
    worst = max(bad, key=lambda name: bad[name])
    begin = f"{len(bad)} of {len(sections)} begin off the centre plane"
    what = f"{begin}, by up to {bad[worst]:.4g} m ({worst})"
    book.suspect(BOTTOM, "the sections", what, bad[worst])


def _gap(line: SliceLine) -> float:
    """Give how far (m) the lower end of a section is off the centre plane; 0 where it has one."""
    ends = [
        (float(piece.points[-end, 2]), float(piece.points[-end, 1]), piece.ends[end])
        for piece in line.pieces
        if not piece.closed
        for end in (0, 1)
    ]
    if not ends or any(kind == "profile" for _, _, kind in ends):
        return 0.0
    _, off, kind = min(ends)
    return off if kind == "loose" else 0.0


def refuse_bottomless(slices: Slices) -> None:
    """Refuse to make a hull of lines whose bottom is missing: its volume would be wrong unseen.

    Raises
    ------
    BadInputError
        The report of the slices tells of it.
    """
    found = next((note for note in slices.report.suspicions if note.kind == BOTTOM), None)
    if found is not None:
        what = f"the bottom is missing: of the sections {found.what}"
        raise BadInputError(what, f"in {slices.name}", "export the bottom too, or close the hull")
