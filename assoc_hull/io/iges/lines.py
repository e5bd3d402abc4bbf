"""The lines of a hull as spline curves of IGES, entities 126: the very curves, with their names.

A curve of a line is one entity; lines of several curves give their name to each. Families lie on
levels: sections on 1, waterlines on 2, buttocks on 3, diagonals on 4, boundary lines on 5. Of the
last two all but profile, deck edge and transom are named by their family too, and are not read as
lines again: "boundary: flat of side".

Source: IGES 5.3 (US PRO, 1996), section 4.23.

Examples
--------
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.io.iges.curves import curves_of_iges
>>> from assoc_hull.io.iges.lines import iges_of_lines
>>> text, report = iges_of_lines(wigley())
>>> report.lines, report.curves
(31, 31)
>>> curves, unit, _ = curves_of_iges(text, "wigley.igs")
>>> curves[0].name, unit
('ST 1', 'm')
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence

import attrs
import numpy as np

from assoc_hull.arguments import all_of, choice, file_path, flag, instance
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.splines.control_polygon import control_polygon
from assoc_hull.io.iges.write import IgesLayout, real_values
from assoc_hull.io.lines.line_points import splines_of
from assoc_hull.io.lines.own_lines import IMAGE, curve_texts, hull_text
from assoc_hull.io.lines.raw_lines import BOUNDARIES, OTHER_FAMILIES
from assoc_hull.io.units import METRES
from assoc_hull.io.write_file import write_whole
from assoc_hull.model.tables import HullState

__all__ = ["FAMILIES", "LinesReport", "curve_values", "iges_of_lines", "write_iges_lines"]

FAMILIES = ("sections", "waterlines", "buttocks", "diagonals", "boundary")
"""Families of lines, in the order and on the levels of the file."""

_TITLE = "Lines of a hull, written by assoc-hull"
_WHERE = "in write_iges_lines"
_ACROSS = np.array([1.0, -1.0, 1.0])


@attrs.frozen
class LinesReport:
    """What was written.

    Attributes
    ----------
    path, unit : str
        Where, and in which unit of length.
    half : bool
        Whether it is the half y >= 0 alone.
    lines, curves, points : int
        Lines, the curves they are made of, to both sides if so, and their control points.
    size : int
        Bytes.
    """

    path: str
    unit: str
    half: bool
    lines: int
    curves: int
    points: int
    size: int


def write_iges_lines(
    state: HullState,
    path: str | os.PathLike[str],
    *,
    unit: str = "m",
    half: bool = True,
    families: Sequence[str] = FAMILIES,
) -> LinesReport:
    """Write the lines of a hull as spline curves of IGES.

    Parameters
    ----------
    state : HullState
        The hull.
    path : path
        The file; what was there is replaced by the whole of it, or stays.
    unit : {"m", "mm"}
        Of the lengths in the file.
    half : bool
        Whether to write the half y >= 0 alone; else the images to starboard too.
    families : sequence of str
        Which, some of `FAMILIES`.

    Raises
    ------
    BadInputError
        Another unit or family, no line of these, a curve that has failed, or a file that cannot
        be written.
    """
    file_path(path, _WHERE)
    text, report = iges_of_lines(state, unit=unit, half=half, families=families)
    write_whole(path, text.encode())
    return attrs.evolve(report, path=os.fspath(path))


def iges_of_lines(
    state: HullState,
    *,
    unit: str = "m",
    half: bool = True,
    families: Sequence[str] = FAMILIES,
) -> tuple[str, LinesReport]:
    """Lay out the lines of a hull as the text of an IGES file; as `write_iges_lines`."""
    factor = 1.0 / METRES[choice(unit, "unit", ("m", "mm"), _WHERE)]
    alone = flag(half, "half", _WHERE)
    given = all_of(families, str, "families", _WHERE)
    wanted = [choice(each, "family", FAMILIES, _WHERE) for each in given]
    instance(state, HullState, "state", _WHERE)
    layout, size, points, curves = IgesLayout(), 0.0, 0, 0
    lines = list(_lines(state, wanted))
    for family, line in lines:
        name, level = _name(state, family, line), FAMILIES.index(family) + 1
        for spline, told in zip(splines_of(state, line), curve_texts(state, line), strict=True):
            curve = control_polygon(spline)
            for net, words in zip(_sides(curve.points, alone), (told, IMAGE), strict=False):
                values = curve_values(curve.knots, net * factor)
                layout.add_named(126, values, name, level, words)
                curves, points = curves + 1, points + len(net)
                size = max(size, float(np.abs(net).max()) * factor)
    if not lines:
        raise BadInputError("there are no lines of these families", _WHERE, "give others")
    layout.add_text(hull_text(state))
    text = layout.text(_TITLE, unit, size, _particulars(state))
    return text, LinesReport("", unit, alone, len(lines), curves, points, len(text))


def _particulars(state: HullState) -> list[str]:
    """Give name and particulars for people who look into the file."""
    ship = state.particulars
    sizes = f"Lpp {ship.length:.6g} m, B {ship.breadth:.6g} m, D {ship.depth:.6g} m"
    return [ship.name, f"{sizes}, T {ship.draught:.6g} m, deck {ship.deck}"]


def _lines(state: HullState, families: Sequence[str]) -> Iterator[tuple[str, int]]:
    """Give the lines by family, within a family by place, then by name."""
    live = state.live("lines").tolist()
    for family in FAMILIES:
        mine = [line for line in live if state.family(line).name == family and family in families]
        yield from ((family, line) for line in sorted(mine, key=lambda line: _place(state, line)))


def _name(state: HullState, family: str, line: int) -> str:
    """Name a line; one that no reader of lines would know goes by its family too."""
    name = str(state.lines.name[line])
    plain = family not in OTHER_FAMILIES or name.lower() in BOUNDARIES
    return name if plain else f"{family}: {name}"


def _place(state: HullState, line: int) -> tuple[float, str]:
    planar = bool(state.lines.planar[line])
    offset = float(state.lines.offset[line]) if planar else 0.0
    return offset, str(state.lines.name[line])


def _sides(points: FloatArray, half: bool) -> list[FloatArray]:
    """Give the control points of a curve, and those of its image if there is one to be drawn."""
    centred = not points[:, 1].any()
    return [points] if half or centred else [points, points * _ACROSS]


def curve_values(knots: FloatArray, points: FloatArray) -> list[str]:
    """Give the values of a cubic curve as an entity 126, without pointers.

    Parameters
    ----------
    knots : (n + 4,)
        Not falling.
    points : (n, 3)
        Control points, in units of the file.
    """
    flat = (points == points[0]).all(axis=0)
    planar = bool(flat.any())
    normal = np.arange(3) == np.argmax(flat) if planar else np.zeros(3)
    closed = bool((points[0] == points[-1]).all())
    flags = (len(points) - 1, 3, int(planar), int(closed), 1, 0)
    return [
        *(str(each) for each in flags),
        *real_values(knots),
        *real_values(np.ones(len(points))),
        *real_values(points),
        *real_values([knots[0], knots[-1]]),
        *real_values(normal.astype(np.float64)),
    ]
