"""Curves of an IGES file as digitised lines: each by the name of its entity.

Examples
--------
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.io.digitised.iges import parse_iges
>>> from assoc_hull.io.iges.lines import iges_of_lines
>>> from assoc_hull.io.offset_report import Notebook
>>> found = parse_iges(iges_of_lines(wigley())[0], "wigley.igs", Notebook())
>>> found.pieces[0].line, found.unit
('ST 1', 'm')
"""

from __future__ import annotations

import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.patches.spline_curve import SplineCurve
from assoc_hull.io.iges.curves import curves_of_iges
from assoc_hull.io.iges.file import IgesFile
from assoc_hull.io.lines.digitised_piece import BESIDE, BOUNDARIES, RawPiece
from assoc_hull.io.lines.raw_lines import RawLines
from assoc_hull.io.offset_report import Notebook
from assoc_hull.io.units import METRES

__all__ = ["parse_iges"]

_CHORD = 1e-6
"""Points leave curves by this part of the size of all: 0.3 mm on a ship of 300 m."""

_FLAT = 1e-4
"""Curves that leave a plane by more than this part of the size lie in none."""

_FAMILIES = ("ST", "SECTION", "FRAME", "FR", "WL", "WATERLINE", "BTK", "BUTTOCK")


def parse_iges(text: str, source: str, book: Notebook) -> RawLines:
    """Read the curves of a file without surfaces as pieces of lines.

    Parameters
    ----------
    text : str
        IGES; the name of a curve is that of its line.
    source : str
        Name of the file, for messages.
    book : Notebook
        Takes what the file holds and lines do not.

    Raises
    ------
    BadInputError
        The file is damaged, or holds no curve.
    """
    file = IgesFile.of_text(text, source)
    # Points are handed on in the unit of the file; where it tells none, size or the user will.
    curves, name, notes = curves_of_iges(text, source, None if file.metres else "m")
    unit = name if file.metres and name in METRES else None
    length = METRES[unit] if unit else 1.0
    for note in notes:
        book.suspect("iges", "the file", note)
    size = max(float(np.ptp(curve.points, axis=0).max()) for curve in curves)
    lines = [curve for curve in curves if _is_line(curve, size)]
    others = [curve for curve in curves if not _is_line(curve, size)]
    _tell_others(others, book)
    if not lines:
        what = f"none of {len(curves)} curves lies in a plane"
        raise BadInputError(what, f"in {source}", "export sections, waterlines or buttocks")
    pieces = [
        RawPiece(
            curve.name, curve.polyline(_CHORD * size) / length, f"{curve.name!r} of {source}",
            curve.knuckles() / length,
        )
        for curve in lines
    ]  # fmt: skip
    return RawLines(pieces, unit, told=False)


def _is_line(curve: SplineCurve, size: float) -> bool:
    """Tell whether a curve is a boundary, named as a line, or lies in a plane as a line does."""
    word = curve.name.split()[0].upper() if curve.name.split() else ""
    if word.lower().removesuffix(":") in BESIDE:
        return False
    flat = bool(np.ptp(curve.points, axis=0).min() <= _FLAT * size)
    return curve.name.lower() in BOUNDARIES or word in _FAMILIES or flat


def _tell_others(curves: list[SplineCurve], book: Notebook) -> None:
    """Tell which curves are left out."""
    names = list(dict.fromkeys(curve.name for curve in curves))
    if names:
        known = ", ".join(BOUNDARIES)
        what = f"no section, waterline or buttock, and none of {known}: left out"
        book.suspect("curve", ", ".join(names[:6]), what, len(curves))
