"""Numbers in text files of panels: what their readers and writers share."""

from __future__ import annotations

import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.surfaces.panel_mesh import PanelMesh, joined

__all__ = ["DECIMALS", "Row", "mesh_of", "real", "rows_of", "shown_rows", "table", "whole"]

DECIMALS = 6
"""Coordinates are written to the micrometre."""

_LARGEST = 1e6

Row = tuple[int, list[str]]
"""Number of a line, and its words."""


def rows_of(text: str) -> list[Row]:
    r"""Give the lines that hold anything, as words; commas part words too.

    Examples
    --------
    >>> from assoc_hull.io.panels.text import rows_of
    >>> rows_of("2 1\n\n1, 0.5 0 0\n")
    [(1, ['2', '1']), (3, ['1', '0.5', '0', '0'])]
    """
    lines = enumerate(text.splitlines(), start=1)
    every = ((number, line.replace(",", " ").split()) for number, line in lines)
    return [(number, words) for number, words in every if words]


def whole(word: str, line: int, path: str) -> int:
    """Take a whole number of at most nine digits.

    Raises
    ------
    BadInputError
        Anything else.
    """
    digits = word.lstrip("+-")
    if not (digits.isascii() and digits.isdigit() and len(digits) <= 9) or len(word) > 10:
        raise _not("a whole number", word, line, path)
    return int(word)


def real(word: str, line: int, path: str) -> float:
    """Take a finite number; the exponents of Fortran, as in 1.5D+01, are known.

    Raises
    ------
    BadInputError
        Anything else, and what is no length in metres.
    """
    try:
        # A float of Python may have a line between its digits, and be nan.
        found = float(word.lower().replace("d", "e")) if "_" not in word else np.nan
    except ValueError:
        found = np.nan
    if not abs(found) <= _LARGEST:
        raise _not(f"a number up to {_LARGEST:g}", word, line, path)
    return found


def _not(what: str, word: str, line: int, path: str) -> BadInputError:
    given = word if len(word) <= 20 else word[:20] + "..."
    return BadInputError(f"{given!r} is not {what}", f"at {path}, line {line}", "export it again")


def table(rows: list[Row], first: int, count: int, path: str) -> FloatArray:
    """Take `count` numbers of each line, behind its first words, as an array.

    Raises
    ------
    BadInputError
        A line is too short, or holds no number.
    """
    found = np.empty((len(rows), count))
    for i, (line, words) in enumerate(rows):
        if len(words) < first + count:
            what = f"there are {len(words)} of {first + count} numbers"
            raise BadInputError(what, f"at {path}, line {line}", "export it again")
        for j in range(count):
            found[i, j] = real(words[first + j], line, path)
    return found


def mesh_of(
    xyz: FloatArray, panel: IntArray, mirrors: tuple[bool, bool], title: str, path: str
) -> PanelMesh:
    """Make a mesh of what a file holds; equal vertices become one, panels without area go.

    Raises
    ------
    BadInputError
        Nothing is left, or it is no mesh.
    """
    places, corners = joined(xyz + 0.0, panel)
    if not len(corners):
        raise BadInputError("there are no panels", f"at {path}", "export the hull, not an outline")
    return PanelMesh(places, corners, *mirrors, title)


def shown_rows(values: FloatArray, width: int = 16) -> list[str]:
    """Write rows of coordinates, (n, 3), m, in columns; there is no -0."""
    rounded = np.round(values, DECIMALS) + 0.0
    return ["".join(f"{each:{width}.{DECIMALS}f}" for each in row) for row in rounded.tolist()]
