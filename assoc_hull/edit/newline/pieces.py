"""Which curve is which piece, when a line comes to have more or fewer of them.

A piece keeps the curve that most of its crossings were on (ties: the curve that comes
first in the line). A piece without one is born as a new curve; a curve without one dies.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.newline.plane_marks import Marks
from assoc_hull.edit.transaction import Transaction
from assoc_hull.geometry.curves import CurveData, SplineBatch
from assoc_hull.geometry.splines.closest import closest
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.model.state import Ends, HullState

__all__ = ["gather", "match_pieces"]


def match_pieces(
    edit: Transaction, line: int, pieces: list[Marks], known: dict[tuple[int, int], int]
) -> list[tuple[int, Marks]]:
    """Give each piece of a line its curve; make and unmake curves as needed.

    Parameters
    ----------
    edit : Transaction
        The edit.
    line : int
        The line.
    pieces : list of Marks
        Its pieces, each in order along it.
    known : dict of (int, int) to int
        Crossings that are there already, by the other curve and the mark's `root`. They go
        over to the curve of their piece.

    Returns
    -------
    list of (int, Marks)
        The curves with their pieces, in the order of the pieces.
    """
    state = edit.state
    old = [int(curve) for curve in state.lines.curves.data[line]]
    rows = [_rows_of(piece, known) for piece in pieces]
    kept = _keep(state, old, rows)
    for curve in old:
        if curve not in kept.values():
            _end(edit, curve)
    found: list[tuple[int, Marks]] = []
    for i, piece in enumerate(pieces):
        curve = kept.get(i, -1)
        if curve < 0:
            curve = edit.maker.curve(line, Ends())
            edit.pending.born.append(state.curves.key.data[curve])
        _take_over(edit, curve, piece, known)
        found.append((curve, piece))
    edit.journal.set(state.lines.curves, [line], [tuple(curve for curve, _ in found)])
    return found


def _rows_of(piece: Marks, known: dict[tuple[int, int], int]) -> list[int]:
    marks = zip(piece.curve.tolist(), piece.root.tolist(), strict=True)
    return [known[mark] for mark in marks if mark in known]


def _keep(state: HullState, old: list[int], rows: list[list[int]]) -> dict[int, int]:
    """Pair pieces with curves by the number of crossings they share, the most first."""
    shared = [
        (
            -int(np.isin(state.rows.curve.data[np.array(part, np.int64)], curve).any(axis=1).sum()),
            j,
            i,
        )
        for i, part in enumerate(rows)
        for j, curve in enumerate(old)
        if part
    ]
    kept: dict[int, int] = {}
    for count, j, i in sorted(shared):
        if count < 0 and i not in kept and old[j] not in kept.values():
            kept[i] = old[j]
    return kept


def _end(edit: Transaction, curve: int) -> None:
    """Unmake a curve that has no piece any more."""
    edit.journal.put(edit.state.curves.alive, [curve], False)
    edit.pending.curves.discard(curve)
    edit.pending.gone.append(edit.state.curves.key.data[curve])


def _take_over(
    edit: Transaction, curve: int, piece: Marks, known: dict[tuple[int, int], int]
) -> None:
    """Let the crossings of a piece be on its curve, and look for them at their new place."""
    state = edit.state
    line = state.line_of(curve)
    marks = zip(piece.curve.tolist(), piece.root.tolist(), piece.xyz, strict=True)
    for other, root, place in marks:
        row = known.get((other, root))
        if row is None:
            continue
        pair = state.rows.curve.data[row].tolist()
        side = int(state.line_of(pair[1]) == line)
        pair[side] = curve
        edit.journal.put(state.rows.curve, [row], [pair])
        edit.journal.put(state.rows.spot, [row], [(place, place)])


def gather(
    edit: Transaction, line: int, pieces: list[tuple[int, Marks]], known: dict[tuple[int, int], int]
) -> None:
    """Let followed crossings that mark no piece go over to the piece they have come to.

    These are the crossings with lines of higher rank, from which the line is not cut.

    Parameters
    ----------
    edit : Transaction
        The edit.
    line : int
        The line.
    pieces : list of (int, Marks)
        Its curves, and where each passes.
    known : dict of (int, int) to int
        Crossings by the other curve and its meeting with the line's plane; their spots are
        there already.
    """
    state = edit.state
    marked = {
        mark
        for _, piece in pieces
        for mark in zip(piece.curve.tolist(), piece.root.tolist(), strict=True)
    }
    rows = [row for mark, row in sorted(known.items()) if mark not in marked]
    if not rows or not pieces:
        return
    shapes = SplineBatch.join([loft(CurveData.single(piece.xyz)) for _, piece in pieces])
    spots = state.rows.spot.data[rows, 0]
    away = np.array([closest(shapes, i, spots)[2] for i in range(len(pieces))])
    for row, nearest in zip(rows, away.argmin(axis=0).tolist(), strict=True):
        pair = state.rows.curve.data[row].tolist()
        pair[int(state.line_of(pair[1]) == line)] = pieces[nearest][0]
        edit.journal.put(state.rows.curve, [row], [pair])
