"""The table of offsets of a hull: half-breadths by station and waterline, heights of buttocks.

The cells are those that `assoc_hull.io.offsets.read.read_offsets` reads; CSV and XLSX hold the
same.

Examples
--------
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.io.export_book import ExportBook
>>> from assoc_hull.io.export.offset_out import offsets_of
>>> sheet = offsets_of(wigley(), ExportBook(decimals=4))
>>> [block[0][:4] for block in sheet.blocks], sheet.blocks[0][7][:4]
([['station', 'x_m', 'wl_0', 'wl_0.625']], ['6', '30', '0.0000', '0.7980'])
"""

from __future__ import annotations

import csv
import io
import re

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.export.offset_meet import (
    APART,
    LinesInPlanes,
    boundary_curves,
    keel_and_deck,
    line_at,
    lines_in_planes,
    spread,
    station_places,
    with_ends,
    with_levels,
)
from assoc_hull.io.export_book import ExportBook
from assoc_hull.model.state import HullState

__all__ = ["Offsets", "csv_text", "offsets_of"]

_SAME = 1e-6
"""Places closer than this (m) are one."""

_LEVEL = np.eye(3)[2]
_ACROSS = np.eye(3)[0]
_ALONG = np.eye(3)[1]


@attrs.frozen
class Offsets:
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


def offsets_of(state: HullState, book: ExportBook) -> Offsets:
    """Read the offsets off a hull.

    Parameters
    ----------
    state : HullState
        The hull.
    book : ExportBook
        Takes what is written, and what a table cannot hold.

    Returns
    -------
    Offsets
        Stations are the sections, and the perpendiculars where the hull reaches them; waterlines
        are those of the hull and boundary curves in level planes.

    Raises
    ------
    BadInputError
        Fewer than two stations or waterlines, or a line whose curve has failed.
    """
    sections, levels, buttocks = (lines_in_planes(state, *each) for each in _WANTED)
    if not len(sections.at):
        raise BadInputError(
            "there are no sections", f"in {state.particulars.name}", "cut two or more"
        )
    boundary = boundary_curves(state)
    sections = with_ends(sections, boundary)
    levels = with_levels(levels, boundary)
    x = station_places(state, sections, boundary)
    if len(x) < 2 or len(levels.at) < 2:
        raise BadInputError(
            f"there are {len(x)} stations and {len(levels.at)} waterlines",
            f"in {state.particulars.name}", "cut two or more of each, or choose another form",
        )  # fmt: skip
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
    return Offsets(_comments(state, x, stations, breadth, len(levels.at), book), blocks)


_WANTED = (("sections", 0), ("waterlines", 2), ("buttocks", 1))


def csv_text(offsets: Offsets) -> str:
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
    own = spread(sections.curves, _LEVEL, levels.at, 1)
    row = [line_at(sections.at, place) for place in x.tolist()]
    padded = np.vstack([own.high, np.full(len(levels.at), np.nan)])
    ends = spread(levels.curves, _ACROSS, x, 1, levels.at).high.T
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
    own = spread(sections.curves, _ALONG, buttocks.at, 2)
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
    names = [str(state.lines.name.data[i]) for i in live]
    if names:
        what = f"{', '.join(names)}: a table holds their offsets at its stations only"
        book.leave_out("boundary", f"{len(names)} boundary curves", what, len(names))


def _comments(
    state: HullState, x: FloatArray, stations: list[str], breadth: FloatArray, levels: int,
    book: ExportBook,
) -> tuple[str, ...]:  # fmt: skip
    """Say what the reader would else have to guess; the name comes last, as it may say anything."""
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
