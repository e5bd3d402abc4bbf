"""Digitised lines with bulwarks: a named line is the deck edge, and what stands above it is cut.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.io.digitised.bulwarks import below_deck
>>> from assoc_hull.io.lines.raw_lines import RawPiece
>>> from assoc_hull.io.reports import Notebook
>>> deck = RawPiece("main deck", np.array([[0.0, 4, 5], [50, 4, 5]]), "row 2")
>>> side = RawPiece("ST 5", np.array([[9.0, 0, 0], [9, 4, 4], [9, 4, 6]]), "row 4")
>>> below_deck([deck, side], "Main deck", Notebook())[1].points[-1].tolist()
[9.0, 4.0, 5.0]
"""

from __future__ import annotations

from collections.abc import Iterator

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.polylines.operations import runs_where
from assoc_hull.io.lines.raw_lines import RawPiece
from assoc_hull.io.reports import Notebook

__all__ = ["below_deck"]

_DECK = "deck edge"
_SAME = 1e-9
_NAMES = 12


def below_deck(raw: list[RawPiece], name: str, book: Notebook) -> list[RawPiece]:
    """Make the line of a name the deck edge, and cut all other lines there.

    Raises
    ------
    BadInputError
        No line has this name.
    """
    mine = [each for each in raw if each.line.lower() == name.lower()]
    if not mine:
        names = list(dict.fromkeys(each.line for each in raw))
        more = " and others" if len(names) > _NAMES else ""
        raise BadInputError(
            f"no line is called {name!r}", "the argument deck_edge",
            f"give one of {', '.join(names[:_NAMES])}{more}",
        )  # fmt: skip
    every = np.concatenate([each.points for each in mine])
    deck = every[np.argsort(every[:, 0], kind="stable")][:, [0, 2]]
    found = [attrs.evolve(each, line=_DECK) for each in mine]
    cut: list[str] = []
    for each in raw:
        if each in mine or each.line.lower() == _DECK:
            continue
        parts = list(_parts_below(each.points, deck))
        if len(parts) != 1 or len(parts[0]) != len(each.points):
            cut.append(each.line)
        found += [attrs.evolve(each, points=points) for points in parts]
    _tell(name, list(dict.fromkeys(cut)), book)
    return found


def _tell(name: str, cut: list[str], book: Notebook) -> None:
    what = f"{name} is the deck edge, as given"
    book.assume("deck edge", "the lines", what)
    if cut:
        what = f"{len(cut)} lines, as {cut[0]}, were cut there: what stands above is bulwark"
        book.repair("bulwark", "the lines", what, len(cut))


def _parts_below(points: FloatArray, deck: FloatArray) -> Iterator[FloatArray]:
    """Give the parts of a polyline that lie below the deck, each with its ends on it."""
    over = points[:, 2] - np.interp(points[:, 0], deck[:, 0], deck[:, 1])
    inside = over <= _SAME
    for first, stop in runs_where(inside).tolist():
        run = [points[first:stop]]
        if first > 0:
            run.insert(0, _crossing(points, over, first, first - 1))
        if stop < len(points):
            run.append(_crossing(points, over, stop - 1, stop))
        part = np.concatenate(run)
        if len(part) > 1:
            yield part


def _crossing(points: FloatArray, over: FloatArray, inner: int, outer: int) -> FloatArray:
    """Give the place between two points where a line passes the deck; none at a point on it."""
    if over[inner] > -_SAME:
        return np.zeros((0, 3))
    part = over[inner] / (over[inner] - over[outer])
    return np.asarray((points[inner] + part * (points[outer] - points[inner]))[None])
