"""The table of offsets of a hull, as CSV or XLSX: half-breadths and heights of buttocks.

Lines of each family are intersected with the planes of the others. Stations are the sections, and
the perpendiculars where the hull reaches them. The cells are those that
`assoc_hull.io.offsets.read.read_offsets` reads; CSV and XLSX hold the same. Lengths in m, x from
the AP.
"""

from __future__ import annotations

import csv
import io
import re
from typing import Any

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.splines.plane_intersections import intersect_planes
from assoc_hull.io.lines.line_points import splines_of
from assoc_hull.io.reports import ExportBook
from assoc_hull.io.tables.spreadsheets import openpyxl_module, workbook_bytes
from assoc_hull.model.tables import HullState

__all__ = [
    "APART",
    "CoordinateRange",
    "LinesInPlanes",
    "OffsetCells",
    "boundary_curves",
    "coordinate_ranges",
    "exported_station_places",
    "keel_and_deck",
    "line_at",
    "lines_in_planes",
    "offsets_csv",
    "offsets_of",
    "offsets_xlsx",
    "with_ends",
    "with_levels",
]

_SHEET_NAMES = ("half-breadths", "heights of buttocks")


def offsets_xlsx(offsets: OffsetCells) -> bytes:
    """Lay out a table as a workbook: a sheet a block, comments above the first.

    Numbers are numbers, shown with as many digits as the CSV has.

    Raises
    ------
    MissingExtraError
        openpyxl is not installed.
    """
    book = openpyxl_module().Workbook()
    book.remove(book.active)
    for k, block in enumerate(offsets.blocks):
        sheet = book.create_sheet(_SHEET_NAMES[k])
        top = list(offsets.comments) if k == 0 else []
        for comment in top:
            sheet.append([f"# {comment}"])
        for row in block:
            sheet.append([_number_or_text(cell) for cell in row])
        _format_sheet(sheet, len(top) + 1, block)
    return workbook_bytes(book)


def _number_or_text(cell: str) -> float | str | None:
    """Give a cell as a number, if it is one."""
    if re.fullmatch(r"-?[0-9]+(\.[0-9]+)?(e-?[0-9]+)?", cell):
        return float(cell)
    return cell or None


def _format_sheet(sheet: Any, head: int, block: list[list[str]]) -> None:
    """Show the digits that were written, and keep the header and the stations in sight."""
    first = next(k for k, name in enumerate(block[0]) if name == "x_m") + 1
    for row, cells in zip(sheet.iter_rows(min_row=head + 1), block[1:], strict=True):
        for cell, text in list(zip(row, cells, strict=True))[first:]:
            cell.number_format = "0." + "0" * len(text.partition(".")[2]) if "." in text else "0"
    sheet.freeze_panes = sheet.cell(head + 1, first + 1)


# --------------------------------------------------------------------------------------
# Lines by planes, and their intersections with other planes.

_SAME = 1e-6
"""Points closer than this (m) are one."""

APART = 1e-3
"""Offsets farther apart than this (m) are two of one line, of which a table holds one."""

_ACROSS = np.eye(3)[0]


@attrs.frozen(eq=False)
class LinesInPlanes:
    """The lines of one family in planes: places ascending, names and splines."""

    at: FloatArray
    names: list[str]
    curves: list[SplineBatch]


def lines_in_planes(state: HullState, family: str, axis: int) -> LinesInPlanes:
    """Give the lines of a family across an axis (0 x, 1 y, 2 z) by offset; no oblique ones.

    Raises
    ------
    BadInputError
        A curve of theirs has failed.
    """
    live = [i for i in state.live("lines").tolist() if state.family(i).name == family]
    table = state.lines
    found = [
        (float(table.offset[i]), str(table.name[i]), splines_of(state, i))
        for i in live if table.planar[i] and table.normal[i][axis] == 1.0
    ]  # fmt: skip
    found.sort(key=lambda each: each[:2])
    return LinesInPlanes(
        np.array([each[0] for each in found]), [each[1] for each in found],
        [SplineBatch.join(each[2]) for each in found],
    )  # fmt: skip


def boundary_curves(state: HullState) -> list[SplineBatch]:
    """Give the boundary curves, one batch a line."""
    live = [i for i in state.live("lines").tolist() if state.family(i).name == "boundary"]
    return [SplineBatch.join(splines_of(state, i)) for i in live]


def with_ends(sections: LinesInPlanes, boundary: list[SplineBatch]) -> LinesInPlanes:
    """Put transverse boundary curves that lie beyond all sections among these: a transom."""
    found = list(zip(sections.at.tolist(), sections.names, sections.curves, strict=True))
    for curve in boundary:
        x = float(curve.xyz[0, 0])
        flat = np.ptp(curve.xyz[:, 0]) < _SAME and np.ptp(curve.xyz[:, 2]) > _SAME
        if flat and not (sections.at.min() - _SAME < x < sections.at.max() + _SAME):
            found.append((x, "", curve))
    found.sort(key=lambda each: each[:2])
    return LinesInPlanes(
        np.array([e[0] for e in found]), [e[1] for e in found], [e[2] for e in found]
    )


def with_levels(waterlines: LinesInPlanes, boundary: list[SplineBatch]) -> LinesInPlanes:
    """Put boundary curves in level planes, such as a level deck edge, among the waterlines.

    The plane of the base line is one of them if the hull stands on it: there a table has the
    border of its flat of bottom.
    """
    found = list(zip(waterlines.at.tolist(), waterlines.names, waterlines.curves, strict=True))
    for curve in boundary:
        z = curve.xyz[:, 2]
        if np.ptp(z) < _SAME:
            found.append((_snapped(float(z[0])), "", curve))
    lowest = min((float(curve.xyz[:, 2].min()) for curve in boundary), default=np.nan)
    if abs(lowest) < _SAME and boundary:
        found.append((0.0, "", SplineBatch.join(boundary)))
    found.sort(key=lambda each: (each[0], each[1] == ""))
    kept = [found[k] for k in range(len(found)) if not k or found[k][0] - found[k - 1][0] > _SAME]
    return LinesInPlanes(
        np.array([each[0] for each in kept]), [each[1] for each in kept],
        [each[2] for each in kept],
    )  # fmt: skip


def _snapped(value: float) -> float:
    return 0.0 if abs(value) < _SAME else value


def exported_station_places(
    state: HullState, sections: LinesInPlanes, boundary: list[SplineBatch]
) -> FloatArray:
    """Give x of the sections, and of the perpendiculars that the hull reaches."""
    ends = np.concatenate([curve.xyz[:, 0] for curve in boundary] or [np.zeros(0)])
    at = sections.at
    for x in (0.0, state.particulars.length):
        reached = len(ends) and ends.min() - _SAME <= x <= ends.max() + _SAME
        if reached and not (np.abs(at - x) < _SAME).any():
            at = np.append(at, x)
    return np.sort(at)


@attrs.frozen(eq=False)
class CoordinateRange:
    """Least and largest coordinate at intersections, (lines, planes), m; nan for none."""

    low: FloatArray
    high: FloatArray


def coordinate_ranges(
    curves: list[SplineBatch], normal: FloatArray, planes: FloatArray, column: int,
    levels: FloatArray | None = None,
) -> CoordinateRange:  # fmt: skip
    """Intersect lines with ascending planes (p,), m, and give the range of one coordinate.

    `curves` is one batch a line, `normal` (3,), `levels` (lines,), m: only points at this height
    count. A defining point in a plane counts as an intersection: there a root may be missed by
    rounding.
    """
    low, high = (np.full((len(curves), len(planes)), each) for each in (np.inf, -np.inf))
    for i, curve in enumerate(curves):
        met = intersect_planes(curve, normal, planes)
        on, knot = np.nonzero(np.abs(curve.xyz @ normal - planes[:, None]) < _SAME)
        plane = np.concatenate([met.plane, on])
        xyz = np.concatenate([met.xyz, curve.xyz[knot]])
        kept = slice(None) if levels is None else np.abs(xyz[:, 2] - levels[i]) < APART
        np.minimum.at(low[i], plane[kept], xyz[kept][:, column])
        np.maximum.at(high[i], plane[kept], xyz[kept][:, column])
    none = low > high
    low[none], high[none] = np.nan, np.nan
    return CoordinateRange(low, high)


def keel_and_deck(
    x: FloatArray, sections: LinesInPlanes, every: list[SplineBatch]
) -> tuple[FloatArray, FloatArray]:
    """Give the local height of the keel, (s,), and edge of the deck, (s, 2): y and z, m."""
    across = SplineBatch.join(every)
    met = intersect_planes(across, _ACROSS, x)
    at, knot = np.nonzero(np.abs(across.xyz[:, 0] - x[:, None]) < _SAME)
    plane = np.concatenate([met.plane, at])
    xyz = np.concatenate([met.xyz, across.xyz[knot]])
    keel, deck = np.full(len(x), np.nan), np.full((len(x), 2), np.nan)
    for i, place in enumerate(x.tolist()):
        k = line_at(sections.at, place)
        own = sections.curves[k].xyz if k >= 0 else np.zeros((0, 3))
        found = np.concatenate([own, xyz[plane == i]])
        if len(found):
            keel[i] = _snapped(float(found[:, 2].min()))
            deck[i] = found[int(np.lexsort((found[:, 1], found[:, 2]))[-1]), 1:]
    return keel, deck


def line_at(places: FloatArray, place: float) -> int:
    """Give the number of the line at a place, -1 if there is none."""
    near = np.flatnonzero(np.abs(places - place) < _SAME)
    return int(near[0]) if len(near) else -1


# --------------------------------------------------------------------------------------
# Cells of the table.

_LEVEL = np.eye(3)[2]
_ALONG = np.eye(3)[1]


@attrs.frozen
class OffsetCells:
    """A table of offsets as text.

    Attributes
    ----------
    comments : tuple of str
        What the reader needs to know, and the name of the ship.
    blocks : list of list of list of str
        Waterlines, then buttocks if there are any: a header row and one row a station.
    """

    comments: tuple[str, ...]
    blocks: list[list[list[str]]]


def offsets_of(state: HullState, book: ExportBook) -> OffsetCells:
    """Read the offsets off a hull.

    Parameters
    ----------
    state : HullState
        The hull.
    book : ExportBook
        Takes what is written, and what a table cannot hold.

    Returns
    -------
    OffsetCells
        Stations are the sections, and the perpendiculars where the hull reaches them; waterlines
        are those of the hull and boundary curves in level planes.

    Raises
    ------
    BadInputError
        Fewer than two stations or waterlines, or a line whose curve has failed.
    """
    sections, levels, buttocks = (lines_in_planes(state, *each) for each in _WANTED)
    # Before `with_ends`, which asks how far they reach.
    if not len(sections.at):
        raise BadInputError(
            "there are no sections", f"in {state.particulars.name}", "cut two or more"
        )
    boundary = boundary_curves(state)
    drawn = len(sections.at), len(levels.at)
    sections = with_ends(sections, boundary)
    levels = with_levels(levels, boundary)
    x = exported_station_places(state, sections, boundary)
    _require_two(state, drawn, (len(x), len(levels.at)))
    # A perpendicular may have no section: there keel and deck come from these.
    every = [*boundary, *levels.curves]
    breadth = _half_breadths(x, sections, levels, book)
    keel, deck = keel_and_deck(x, sections, every)
    stations = _numbers(x, sections, book)
    heads, columns = ["station"] if stations else [], [stations] if stations else []
    heads += ["x_m"]
    columns += [[_exact(each) for each in x.tolist()]]
    for head, values in _singles(keel, deck):
        heads.append(head)
        columns.append([row[0] for row in book.rows(values[:, None])])
    heads += [f"wl_{_exact(z)}" for z in levels.at.tolist()]
    columns += [list(each) for each in zip(*book.rows(breadth), strict=True)]
    blocks = [[heads, *map(list, zip(*columns, strict=True))]]
    if len(buttocks.at):
        blocks.append(_buttock_block(x, stations, sections, buttocks, book))
    book.lines += len(x)
    book.curves += len(x)
    book.points += int(np.isfinite(breadth).sum())
    _tell_boundary(state, book)
    return OffsetCells(_comments(state, x, stations, breadth, len(levels.at), book), blocks)


def _require_two(state: HullState, drawn: tuple[int, int], rows: tuple[int, int]) -> None:
    """Refuse a table of fewer than two stations or waterlines; say how to cut more."""
    for group, word, there, count, place in zip(
        ("sections", "waterlines"), ("section", "waterline"), drawn, rows,
        (0.5 * state.particulars.length, state.particulars.draught), strict=True,
    ):  # fmt: skip
        if count < 2:
            level = f" and {count - there} level boundary curve" if count > there else ""
            raise BadInputError(
                f"the hull has {there} {word}{'s' * (there != 1)}{level}, and a table of offsets "
                f"needs two", f"in {state.particulars.name}",
                f"add {group} (`assoc-hull edit HULL add_line {group} {place:.6g}`), or choose "
                "another form",
            )  # fmt: skip


_WANTED = (("sections", 0), ("waterlines", 2), ("buttocks", 1))


def offsets_csv(offsets: OffsetCells) -> str:
    """Lay out a table as comma-separated text, a block after the other."""
    out = io.StringIO()
    out.writelines(f"# {comment}\n" for comment in offsets.comments)
    writer = csv.writer(out, lineterminator="\n")
    for block in offsets.blocks:
        writer.writerows(block)
    return out.getvalue()


def _exact(value: float) -> str:
    """Write a place to a nanometre: no workbook keeps more digits than that takes."""
    return repr(round(value, 9) + 0.0).removesuffix(".0")


def _half_breadths(
    x: FloatArray, sections: LinesInPlanes, levels: LinesInPlanes, book: ExportBook
) -> FloatArray:
    """Give the half-breadths, (s, w), m: of sections, at the ends of the hull of waterlines."""
    own = coordinate_ranges(sections.curves, _LEVEL, levels.at, 1)
    row = [line_at(sections.at, place) for place in x.tolist()]
    padded = np.vstack([own.high, np.full(len(levels.at), np.nan)])
    ends = coordinate_ranges(levels.curves, _ACROSS, x, 1, levels.at).high.T
    several = (own.high - own.low > APART) & (levels.at > _SAME)
    many = [
        f"{sections.names[i]} at z = {levels.at[j]:.6g} m" for i, j in np.argwhere(several).tolist()
    ]
    if many:
        what = f"{_some(many)}: passed more than once, the outermost is written"
        book.leave_out("half-breadths", f"{len(many)} cells", what, len(many))
    return np.maximum(np.where(np.isnan(padded[row]), ends, padded[row]), 0.0)


def _some(names: list[str], most: int = 4) -> str:
    return ", ".join(names[:most]) + (f" and {len(names) - most} more" if names[most:] else "")


def _singles(keel: FloatArray, deck: FloatArray) -> list[tuple[str, FloatArray]]:
    """Give columns of keel and deck, each only where it is not level."""
    found = [] if (np.nan_to_num(keel) == 0.0).all() else [("z_keel", keel)]
    if np.nanmax(deck[:, 1]) - np.nanmin(deck[:, 1]) > _SAME:
        found += [("z_deck", deck[:, 1]), ("y_deck", np.maximum(deck[:, 0], 0.0))]
    return found


def _numbers(x: FloatArray, sections: LinesInPlanes, book: ExportBook) -> list[str]:
    """Give the numbers at the ends of the names of the sections, empty if they are not distinct."""
    ends = [re.search(r"(?<![\w.])-?[0-9]+(\.[0-9]+)?$", name) for name in sections.names]
    numbers = [found.group() if found else "" for found in ends]
    named = [each for each, name in zip(numbers, sections.names, strict=True) if name]
    if not named or "" in named or len({float(each) for each in named}) < len(named):
        what = "they hold no distinct numbers; the stations are told by x"
        book.leave_out("names", "the sections", what)
        return []
    by_place = {line_at(sections.at, place): "" for place in x.tolist()}
    by_place |= dict(enumerate(numbers))
    return [by_place[k] if (k := line_at(sections.at, place)) >= 0 else "" for place in x.tolist()]


def _buttock_block(
    x: FloatArray,
    stations: list[str],
    sections: LinesInPlanes,
    buttocks: LinesInPlanes,
    book: ExportBook,
) -> list[list[str]]:
    own = coordinate_ranges(sections.curves, _ALONG, buttocks.at, 2)
    row = [line_at(sections.at, place) for place in x.tolist()]
    heights = np.vstack([own.low, np.full(len(buttocks.at), np.nan)])[row]
    many = [
        f"{sections.names[i]} at y = {buttocks.at[j]:.6g} m"
        for i, j in np.argwhere(own.high - own.low > APART).tolist()
    ]
    if many:
        what = f"{_some(many)}: passed more than once, the lowest is written"
        book.leave_out("heights", f"{len(many)} cells", what, len(many))
    book.points += int(np.isfinite(heights).sum())
    heads = [*(["station"] if stations else []), "x_m"]
    heads += [f"bt_{_exact(y)}" for y in buttocks.at.tolist()]
    rows = [
        [*([stations[i]] if stations else []), _exact(float(x[i])), *row]
        for i, row in enumerate(book.rows(heights))
    ]
    return [heads, *rows]


def _tell_boundary(state: HullState, book: ExportBook) -> None:
    live = [i for i in state.live("lines").tolist() if state.family(i).name == "boundary"]
    names = [str(state.lines.name[i]) for i in live]
    if names:
        what = f"{', '.join(names)}: a table holds their offsets at its stations only"
        book.leave_out("boundary", f"{len(names)} boundary curves", what, len(names))


def _comments(
    state: HullState, x: FloatArray, stations: list[str], breadth: FloatArray, levels: int,
    book: ExportBook,
) -> tuple[str, ...]:  # fmt: skip
    """Write what the reader would else have to guess.

    The name of the ship comes last, and without a key: it may hold anything.
    """
    ship, half = state.particulars, 0.5 * 10.0**-book.decimals
    found = ["unit: m; x from the after perpendicular, forward positive"]
    numbered = [(float(each), place) for each, place in zip(stations, x, strict=False) if each]
    if numbered:
        (first, a), (last, b) = numbered[0], numbered[-1]
        found.append("station 0 = " + ("AP" if (last - first) * (b - a) > 0 else "FP"))
    found.append(f"Lpp = {ship.length!r}")
    found.append(f"B = {_breadth(ship.breadth, breadth, book)!r}")
    found.append(f"T = {ship.draught!r}")
    found.append("rounding: " + " ".join([f"{half:.{book.decimals + 1}f}"] * levels))
    name = book.name(ship.name, r"\w .,'()+-", 60, "hull")
    return (*found, name)


def _breadth(wanted: float, breadth: FloatArray, book: ExportBook) -> float:
    """Give B, but not less than what is written: no half-breadth may exceed B/2."""
    widest = 2.0 * round(float(np.nanmax(breadth)), book.decimals)
    if widest <= wanted:
        return wanted
    book.mend(
        "breadth", "the particulars", f"B {wanted:.8g} m is written as {widest:.8g} m", widest
    )
    return widest
