"""Tables of offsets, sound ones, and what happens to tables: 200 damages, 100 harmless changes.

A `PlainTable` is a table as cells. `damages` spoils one by chance as files are spoilt on their way:
units mixed, columns exchanged, rows shifted, the corner lost, commas for points, titles, the other
side, a station lost or doubled; it tells the places at which a reader should look. `volume` is that
of a table as read, below the draught: monotone cubics up each station and along the ship, without
adoption, so that thousands of tables can be tried.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Callable, Sequence
from importlib.resources import files
from pathlib import Path
from typing import Any

import attrs
import numpy as np
from scipy.interpolate import PchipInterpolator

from assoc_hull.io.offsets.table import OffsetTable
from assoc_hull.shipped.wigley import wigley_half_breadth

Random = np.random.Generator


@attrs.frozen
class PlainTable:
    """A table as cells, and what is given besides it when it is read."""

    name: str
    comments: tuple[str, ...]
    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    options: dict[str, Any]

    def text(self, mark: str = ",", comma: bool = False) -> str:
        """Write it, with another mark between cells or decimal commas."""
        lines = [f"# {comment}" for comment in self.comments]
        rows = [self.header, *self.rows]
        if comma:
            rows = [tuple(re.sub(r"(?<=[0-9])\.(?=[0-9])", ",", cell) for cell in row)
                    for row in rows]  # fmt: skip
        return "\n".join([*lines, *(mark.join(row) for row in rows)]) + "\n"

    @property
    def waterlines(self) -> list[int]:
        """Which columns are waterlines."""
        return [k for k, name in enumerate(self.header) if name.startswith("wl")]

    def with_rows(self, rows: Sequence[Sequence[str]]) -> PlainTable:
        """The same with other rows."""
        return attrs.evolve(self, rows=tuple(map(tuple, rows)))


def plain_table(name: str, text: str, **options: Any) -> PlainTable:
    """The first block of a text of comma-separated cells."""
    lines = text.splitlines()
    comments = tuple(line[1:].strip() for line in lines if line.startswith("#"))
    rows = [tuple(row) for row in csv.reader(line for line in lines if line[:1] not in ("#", ""))]
    heads = [k for k, row in enumerate(rows) if row[0] in ("station", "x_m")]
    end = heads[1] if len(heads) > 1 else len(rows)
    return PlainTable(name, comments, rows[0], tuple(rows[1:end]), options)


def wigley_table() -> PlainTable:
    """The Wigley hull to the millimetre, 21 stations, 9 waterlines."""
    x, z = np.linspace(0.0, 100.0, 21), np.linspace(0.0, 8.0, 9)
    y = np.array([wigley_half_breadth(np.full(9, each), z, 100.0, 10.0, 8.0) for each in x])
    header = "station," + ",".join(f"wl_{each:g}" for each in z)
    rows = [f"{k}," + ",".join(f"{each:.3f}" for each in row) for k, row in enumerate(y)]
    head = ["# 0 = AP", "# Lpp = 100 m, B = 10 m, T = 6.25 m"]
    return plain_table("Wigley by formula", "\n".join([*head, header, *rows]))


def series60_table(cb: str) -> PlainTable:
    """A shipped table of Series 60."""
    data = files("assoc_hull.shipped") / "data" / f"series60_{cb}.csv"
    return plain_table(f"Series 60 {cb}", data.read_text("utf-8"), length=121.92)


def sysser_table(data: Path) -> PlainTable:
    """The yacht Sysser 1, whose length and breadth its file does not tell."""
    text = (data / "sysser1" / "sysser01_offsets.csv").read_text("utf-8")
    return plain_table("Sysser 1", text)


def exported_table(hull: Any, folder: Path) -> PlainTable:
    """The table of offsets of a hull, as it is exported."""
    path = folder / "offsets.csv"
    hull.export(path)
    return plain_table(hull.particulars.name, path.read_text("utf-8"))


def volume(table: OffsetTable) -> float:
    """Volume (m3) below the draught, or the highest waterline where none is known."""
    top = min(table.draught or table.z[-1], table.z[-1])
    areas = []
    for i in range(len(table.x)):
        known = np.isfinite(table.half_breadth[i])
        z, y = table.z[known], table.half_breadth[i, known]
        if len(z) < 2:
            areas.append(0.0)
            continue
        low = z[0]
        if table.keel is not None and np.isfinite(table.keel[i]) and table.keel[i] < low:
            z, y = np.append(table.keel[i], z), np.append(0.0, y)
            low = z[0]
        high = min(top, float(z[-1]))
        whole = PchipInterpolator(z, y).integrate(low, high) if high > low else 0.0
        areas.append(2.0 * float(whole))
    return float(PchipInterpolator(table.x, areas).integrate(table.x[0], table.x[-1]))


# --------------------------------------------------------------------------------------
# Damages: each gives the text, options, and patterns of which one must occur in a suspicion.

Damaged = tuple[str, dict[str, Any], tuple[str, ...]]


def station(table: PlainTable, *rows: int) -> tuple[str, ...]:
    """Patterns of stations."""
    names = [table.rows[k][0] for k in rows if 0 <= k < len(table.rows)]
    return tuple(rf"(?<![\d.]){re.escape(name)}(?![\d.])" for name in names)


def waterline(table: PlainTable, *columns: int) -> tuple[str, ...]:
    """Patterns of columns, by the height or by the name."""
    names = [table.header[k].removeprefix("wl_") for k in columns]
    numbers = [f"{float(name):g}" if re.fullmatch(r"[\d.]+", name) else name for name in names]
    found = [*names, *numbers, *(table.header[k] for k in columns)]
    return tuple(rf"(?<![\d.]){re.escape(name)}(?![\d.])" for name in found)


def scaled(cell: str, times: float) -> str:
    """A number in another unit, with about as many digits."""
    if not re.fullmatch(r"-?[\d.]+", cell):
        return cell
    digits = len(cell.partition(".")[2])
    return f"{float(cell) * times:.{max(digits - round(np.log10(times)), 0)}f}"


_TIMES = {"mm": 1000.0, "cm": 100.0, "ft": 1.0 / 0.3048, "in": 1.0 / 0.0254}


def mixed_column(table: PlainTable, random: Random) -> Damaged:
    """One waterline in another unit."""
    k, times = random.choice(table.waterlines), random.choice(list(_TIMES.values()))
    rows = [[scaled(c, times) if j == k else c for j, c in enumerate(row)] for row in table.rows]
    return table.with_rows(rows).text(), {}, waterline(table, k)


def mixed_row(table: PlainTable, random: Random) -> Damaged:
    """One station in another unit."""
    k, times = int(random.integers(len(table.rows))), random.choice(list(_TIMES.values()))
    rows = [
        [scaled(c, times) if i == k and j in table.waterlines else c for j, c in enumerate(row)]
        for i, row in enumerate(table.rows)
    ]
    return table.with_rows(rows).text(), {}, station(table, k)


def mixed_block(table: PlainTable, random: Random) -> Damaged:
    """All half-breadths, or all heights, in another unit."""
    times = random.choice(list(_TIMES.values()))
    if random.random() < 0.5:
        rows = [
            [scaled(c, times) if j in table.waterlines else c for j, c in enumerate(row)]
            for row in table.rows
        ]
        return table.with_rows(rows).text(), {}, ("unit", "breadth")
    header = [
        f"wl_{scaled(name[3:] + '000', times)}" if k in table.waterlines else name
        for k, name in enumerate(table.header)
    ]
    return attrs.evolve(table, header=tuple(header)).text(), {}, ("unit", "height")


def wrong_unit(table: PlainTable, random: Random) -> Damaged:
    """A unit is given that is not the table's."""
    unit = random.choice(["mm", "cm", "ft", "in", "mm,m", "m,mm", "m,ft"])
    return table.text(), {"unit": str(unit)}, ("unit", "breadth")


def swapped_columns(table: PlainTable, random: Random) -> Damaged:
    """The numbers of two waterlines exchanged, their names left."""
    a, b = random.choice(table.waterlines, 2, replace=False).tolist()
    return _exchanged(table, a, b), {}, waterline(table, a, b)


def swapped_neighbours(table: PlainTable, random: Random) -> Damaged:
    """The numbers of two waterlines next to each other exchanged."""
    k = int(random.integers(len(table.waterlines) - 1))
    a, b = table.waterlines[k : k + 2]
    return _exchanged(table, a, b), {}, waterline(table, a, b)


def swapped_with_another(table: PlainTable, random: Random) -> Damaged:
    """A waterline exchanged with another column: stations, x, keel or deck."""
    others = [k for k in range(len(table.header)) if k not in table.waterlines]
    a, b = int(random.choice(others)), int(random.choice(table.waterlines))
    kind = table.header[a]
    words = (
        ("keel", "deck") if "keel" in kind or "deck" in kind or "sheer" in kind else ("station",)
    )
    return _exchanged(table, a, b), {}, (*waterline(table, a, b), *words)


def _exchanged(table: PlainTable, a: int, b: int) -> str:
    rows = []
    for row in table.rows:
        cells = list(row)
        cells[a], cells[b] = cells[b], cells[a]
        rows.append(cells)
    return table.with_rows(rows).text()


def shifted_down(table: PlainTable, random: Random) -> Damaged:
    """From one station on the half-breadths stand a row too low; the first is there twice."""
    k = int(random.integers(1, len(table.rows) - 1))
    # All stations from there on have the numbers of another.
    return _shifted(table, k, 1), {}, station(table, *range(k - 1, len(table.rows)))


def shifted_up(table: PlainTable, random: Random) -> Damaged:
    """From one station on the half-breadths stand a row too high; the last is there twice."""
    k = int(random.integers(1, len(table.rows) - 1))
    return _shifted(table, k, -1), {}, station(table, *range(k - 1, len(table.rows)))


def _shifted(table: PlainTable, k: int, by: int) -> str:
    last = len(table.rows) - 1
    source = [i if i < k else min(max(i - by, 0), last) for i in range(last + 1)]
    rows = [
        [table.rows[source[i]][j] if j in table.waterlines else c for j, c in enumerate(row)]
        for i, row in enumerate(table.rows)
    ]
    return table.with_rows(rows).text()


def shifted_cells(table: PlainTable, random: Random) -> Damaged:
    """Below one cell of a column all stand a row too high; the last cell is empty."""
    k = int(random.integers(1, len(table.rows) - 1))
    column = int(random.choice(table.waterlines))
    last = len(table.rows) - 1
    rows = [list(row) for row in table.rows]
    for i in range(k, last):
        rows[i][column] = table.rows[i + 1][column]
    rows[last][column] = ""
    named = (*waterline(table, column), *station(table, *range(k - 1, last + 1)))
    return table.with_rows(rows).text(), {}, named


def shifted_right(table: PlainTable, random: Random) -> Damaged:
    """In one row the numbers stand a column too far right, the last of them lost."""
    k, first = int(random.integers(len(table.rows))), table.waterlines[0]
    row = list(table.rows[k])
    row[first + 1 :] = row[first:-1]
    row[first] = ""
    rows = [*table.rows[:k], tuple(row), *table.rows[k + 1 :]]
    return table.with_rows(rows).text(), {}, station(table, k)


def no_corner(table: PlainTable, random: Random) -> Damaged:
    """The corner is blank, or its cell is gone."""
    if random.random() < 0.5:
        return attrs.evolve(table, header=("", *table.header[1:])).text(), {}, ("corner",)
    return attrs.evolve(table, header=table.header[1:]).text(), {}, ("corner",)


def commas(table: PlainTable, random: Random) -> Damaged:
    """Decimal commas: in all cells between commas or semicolons, or in some rows."""
    kind = int(random.integers(3))
    if kind < 2:
        return table.text(",;"[kind], comma=True), {}, ("comma",)
    k = int(random.integers(len(table.rows)))
    rows = [
        tuple(c.replace(".", ",") for c in row) if i == k else row
        for i, row in enumerate(table.rows)
    ]
    return table.with_rows(rows).text(";"), {}, ("comma", *station(table, k))


def titles(table: PlainTable, random: Random) -> Damaged:
    """Titles above the table, a note below it, or its header once more in the middle."""
    width = len(table.header) - 1
    text = table.text().splitlines()
    head = len(table.comments)
    kind = int(random.integers(4))
    if kind == 0:
        text.insert(head, "Table 5: offsets of the hull" + "," * width)
    elif kind == 1:
        text[head:head] = ["Sheet,2,of,3" + "," * (width - 3), "Waterlines" + "," * width]
    elif kind == 2:
        text.append("Moulded dimensions" + "," * width)
    else:
        text.insert(head + 1 + int(random.integers(2, len(table.rows) - 2)), text[head])
    return "\n".join(text) + "\n", {}, ("title", "row", "block")


def other_side(table: PlainTable, random: Random) -> Damaged:
    """Half-breadths to starboard: all, of some stations, or of a waterline."""
    kind = int(random.integers(3))
    k, column = int(random.integers(len(table.rows))), int(random.choice(table.waterlines))

    def minus(i: int, j: int) -> bool:
        return j in table.waterlines and (kind == 0 or (kind == 1 and i >= k) or column == j)

    rows = [
        [f"-{c}" if c and minus(i, j) else c for j, c in enumerate(row)]
        for i, row in enumerate(table.rows)
    ]
    return table.with_rows(rows).text(), {}, ("starboard",)


def lost_station(table: PlainTable, random: Random) -> Damaged:
    """A row is gone."""
    k = int(random.integers(len(table.rows)))
    rows = [*table.rows[:k], *table.rows[k + 1 :]]
    return table.with_rows(rows).text(), {}, station(table, k - 1, k + 1)


def lost_end(table: PlainTable, random: Random) -> Damaged:
    """The first rows or the last are gone."""
    many = int(random.integers(1, 4))
    if random.random() < 0.5:
        return table.with_rows(table.rows[many:]).text(), {}, station(table, many)
    place = len(table.rows) - many - 1
    return table.with_rows(table.rows[:-many]).text(), {}, station(table, place)


def doubled_station(table: PlainTable, random: Random) -> Damaged:
    """A row is there twice: as it is, over the next one, or under a number between."""
    k = int(random.integers(len(table.rows) - 1))
    kind = int(random.integers(3))
    rows = [list(row) for row in table.rows]
    if kind == 0:
        rows.insert(k, rows[k])
    elif kind == 1:
        for j in table.waterlines:
            rows[k + 1][j] = rows[k][j]
    else:
        between = list(rows[k])
        for j in range(table.waterlines[0]):
            try:
                between[j] = f"{0.5 * (float(rows[k][j]) + float(rows[k + 1][j])):.6g}"
            except ValueError:
                between[j] = rows[k][j]
        rows.insert(k + 1, between)
    return table.with_rows(rows).text(), {}, station(table, k, k + 1)


DAMAGES: tuple[Callable[[PlainTable, Random], Damaged], ...] = (
    mixed_column, mixed_row, mixed_block, wrong_unit, swapped_columns, swapped_neighbours,
    swapped_with_another, shifted_down, shifted_up, shifted_cells, shifted_right, no_corner,
    commas, titles, other_side, lost_station, lost_end, doubled_station,
)  # fmt: skip


# --------------------------------------------------------------------------------------
# Changes that change nothing.


def _goes_by_column(comment: str) -> bool:
    """Tell whether a comment gives columns different numbers, in their order."""
    return comment.startswith("rounding") and len(set(comment.split()[1:])) > 1


def harmless(table: PlainTable, random: Random) -> str:
    """A comment, another order of columns, another mark between cells, or several of these."""
    kinds = random.random(3) < 0.5
    if not kinds.any():
        kinds[int(random.integers(3))] = True
    if kinds[0]:
        words = ("Drawn by the loft, 12 May 1974", "Revision 3", "All numbers moulded")
        place = int(random.integers(len(table.comments) + 1))
        comments = [*table.comments]
        comments.insert(place, str(random.choice(words)))
        table = attrs.evolve(table, comments=tuple(comments))
    if kinds[1]:
        order = [0, *(1 + random.permutation(len(table.header) - 1)).tolist()]
        table = attrs.evolve(
            table,
            header=tuple(table.header[k] for k in order),
            rows=tuple(tuple(row[k] for k in order) for row in table.rows),
            comments=tuple(c for c in table.comments if not _goes_by_column(c)),
        )
    if not kinds[2]:
        return table.text()
    mark = str(random.choice([";", "\t", "|", " ; "]))
    return table.text(mark, comma=bool(random.random() < 0.5))
