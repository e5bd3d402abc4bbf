"""Hulls, adoptions and edits in words, as several commands print them.

Each function takes what the library gave and returns text for a terminal; `hull_facts` returns
the same as plain values for `--json`. The report of an adoption is a table with a row per
curve, in mm.
"""

from __future__ import annotations

import textwrap
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from itertools import zip_longest
from typing import TYPE_CHECKING, Any

import attrs

from assoc_hull.display import counted
from assoc_hull.edit.step import SAME_MOVEMENT, EditReport, Movement
from assoc_hull.hull import Hull
from assoc_hull.model.address import AddressBook
from assoc_hull.model.kinds import OWN, Sort
from assoc_hull.model.objects import Curve

if TYPE_CHECKING:  # most commands read no foreign file
    from assoc_hull.edit.adoption.adopt_lines import AdoptionReport, LineReport
    from assoc_hull.io.importing.import_hull import ImportReport
    from assoc_hull.io.offsets.table import OffsetTable
    from assoc_hull.io.reports import OffsetReport
    from assoc_hull.io.slicing.net import SliceReport
    from assoc_hull.io.slicing.smooth_lines import SmoothReport

__all__ = [
    "adoption_words",
    "edit_words",
    "followers",
    "hull_facts",
    "hull_words",
    "import_words",
    "largest_gap",
    "line_table",
    "lists",
    "wrap_text",
]

# --------------------------------------------------------------------------------------
# The report of an adoption as a table, one row per curve.

_WIDTH = 160
"""Room for every column, whatever is printed to: a table that is cut tells nothing."""

_SMOOTHED = ("points", "noise", "smoothed", "band")
_ADOPTED = (
    "median", "p95", "max", "allowed", "at x, y, z (m)", "crossings", "adopted", "placed",
    "inflections",
)  # fmt: skip


def line_table(adoption: AdoptionReport, smoothing: Sequence[SmoothReport] = ()) -> str:
    """Write a row per curve; lengths in mm but for places.

    Parameters
    ----------
    adoption : AdoptionReport
        Per curve.
    smoothing : sequence of SmoothReport
        Of the piece behind each curve, if it was smoothed.

    Examples
    --------
    >>> from assoc_hull.cli.hull_words import line_table
    >>> from assoc_hull.shipped.series60 import series60_adopted
    >>> print(line_table(series60_adopted(0.70)[1]).splitlines()[0].split()[:4])
    ['line', 'median', 'p95', 'max']
    """
    from rich import box
    from rich.console import Console
    from rich.table import Table

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, show_edge=False)
    table.add_column("line")
    for title in (*(_SMOOTHED if smoothing else ()), *_ADOPTED):
        table.add_column(title, justify="right", no_wrap=True)
    for line, piece in zip_longest(adoption.lines, smoothing):
        table.add_row(line.line, *_smoothed(piece, line), *_adopted(line))
    console = Console(width=_WIDTH, color_system=None, force_terminal=False, legacy_windows=False)
    with console.capture() as text:
        console.print(table)
    rows = [row.rstrip() for row in text.get().splitlines()]
    return "\n".join([*rows, "", *_legend(bool(smoothing))])


def _legend(smoothed: bool) -> Iterator[str]:
    """Say what the columns mean."""
    given = "smooth" if smoothed else "given"
    if smoothed:
        yield "points: given > of the smooth line; noise: of the given points, mm; smoothed: how"
        yield "far the smooth line passes the farthest of them, mm; band: how far the hull may lie"
        yield "off the adopted curve, mm"
    yield f"median, p95, max: distances of the {given} line's points from the adopted curve, mm;"
    yield "allowed, at: for the farthest of them; crossings, adopted, placed: points that define"
    yield f"the curve; inflections: of the {given} line > of the adopted curve"


def _smoothed(piece: SmoothReport | None, line: LineReport) -> Iterator[str]:
    if piece is not None:
        yield f"{piece.given} > {piece.points}"
        yield f"{1e3 * piece.noise:.2f}"
        yield f"{1e3 * piece.residual:.2f}"
        yield f"{1e3 * (piece.band + line.deviation):.2f}"


def _adopted(line: LineReport) -> Iterator[str]:
    yield f"{1e3 * line.deviation_median:.2f}"
    yield f"{1e3 * line.deviation_p95:.2f}"
    yield f"{1e3 * line.deviation:.2f}"
    yield f"{1e3 * line.tolerance:.1f}"
    yield ", ".join(f"{value:.2f}" for value in line.place)
    for count in (line.crossings, line.adopted, line.placed):
        yield str(count)
    yield f"{line.inflections_given} > {line.inflections}"


# --------------------------------------------------------------------------------------
# Hulls, adoptions and edits in words.

_MOST_JOINS = 20
"""So many joins are named."""


_NAME = 60
"""A text of more letters than this is parted at its blanks."""


def wrap_text(title: str, names: Iterable[str], indent: str = "  ") -> str:
    """Write a title and names after it, on as many lines as they need."""
    pad = indent + " " * 13
    # A name stays on one line; a sentence, as notes are, does not fit on one.
    text = ", ".join(n.replace(" ", "\xa0") if len(n) <= _NAME else n for n in names)
    # A minus sign is no hyphen to part a line at.
    lines = textwrap.wrap(
        text, 96, initial_indent=f"{indent}{title:12} ", subsequent_indent=pad,
        break_on_hyphens=False,
    )  # fmt: skip
    return "\n".join(lines).replace("\xa0", " ") if text else f"{indent}{title:12} -"


def largest_gap(hull: Hull) -> float:
    """Give the largest gap (m) at any watched crossing of a hull, 0 if there is none."""
    gaps = [each.gap for each in hull.crossings.values()]
    return max((gap for gap in gaps if gap is not None), default=0.0)


def hull_facts(hull: Hull) -> dict[str, Any]:
    """Give what a hull holds; lengths in m."""
    groups = {
        name: {"family": group.family, "lines": list(group.lines)}
        | ({"members": [each.name for each in group.members]} if group.family == OWN else {})
        for name, group in hull.groups.items()
    }
    return {
        "particulars": hull.particulars,
        "groups": groups,
        "associations": hull.state.associations,
        "points": _sorts(hull),
        "crossings": dict(Counter(each.role for each in hull.crossings.values())),
        "largest_gap": largest_gap(hull),
        "fingerprint": hull.fingerprint,
    } | _beside(hull)


def _beside(hull: Hull) -> dict[str, Any]:
    """Give tunnels and bodies, those that there are; of bodies no points."""
    bodies = [
        {"name": each.name, "group": each.group, "low": each.points.min(axis=(0, 1)).tolist(),
         "high": each.points.max(axis=(0, 1)).tolist(), "volume": each.volume, "both": each.both,
         "sign": each.sign}
        for each in hull.state.bodies
    ]  # fmt: skip
    found = {"tunnels": hull.state.tunnels, "bodies": bodies}
    return {kind: held for kind, held in found.items() if held}


def _sorts(hull: Hull) -> dict[str, int]:
    """Count the points by sort; from the tables, because handles on all would take long."""
    table = hull.state.rows.sort[hull.state.live("rows")]
    return dict(Counter(Sort(number).name.lower() for number in table.tolist()))


def hull_words(hull: Hull, *, names: bool = False) -> str:
    """Say what a hull holds, with the names of all lines if asked."""
    facts, ship = hull_facts(hull), hull.particulars
    points, roles = facts["points"], facts["crossings"]
    driven = roles.get("drives a", 0) + roles.get("drives b", 0)
    lines = [
        f"{ship.name}: length {ship.length:.3f} m, breadth {ship.breadth:.3f} m, "
        f"depth {ship.depth:.3f} m, draught {ship.draught:.3f} m, deck {ship.deck}",
        *(wrap_text("breadth", [told]) for told in _drawn_breadth(hull)),
        wrap_text("lines", (f"{len(g['lines'])} {name}" for name, g in facts["groups"].items())),
        f"  crossings    {sum(roles.values())}: {roles.get('shared', 0)} shared, {driven} driven, "
        f"{roles.get('watched', 0)} watched",
        f"  points       {points.get('placed', 0)} placed, {points.get('adopted', 0)} adopted",
        f"  largest gap  {1e3 * facts['largest_gap']:.2f} mm",
        f"  fingerprint  {facts['fingerprint']}",
    ]
    if hull.tunnels:
        lines.insert(-1, wrap_text("tunnels", map(str, hull.tunnels.values())))
    if hull.bodies:
        lines.insert(-1, wrap_text("bodies", map(str, hull.bodies.values())))
    if names:
        lines += [wrap_text(name, group["lines"]) for name, group in facts["groups"].items()]
    return "\n".join(lines)


def _drawn_breadth(hull: Hull) -> tuple[str, ...]:
    """Say where lines are not as broad as the ship."""
    from assoc_hull.variation.parameters.hull_and_end_measures import drawn_breadth

    return drawn_breadth(hull.measure(only=["breadth"]).anchors["breadth"])


def import_words(name: str, report: ImportReport) -> str:
    """Say how a file was read and adopted, and all that was found; the verdict stands apart."""
    if report.slices is not None:
        lines = _slice_words(name, report, report.slices)
    else:
        lines = _table_words(name, report)
    return "\n".join(lines)


def _read_words(report: ImportReport) -> Iterator[str]:
    """Name what was assumed, mended and found, each under its heading."""
    notes, verdict = report.notes, report.verdict
    parts: dict[str, Sequence[object]] = {
        "assumptions": notes.assumptions, "repairs": notes.repairs,
        "suspicions": verdict.suspicions,
    }  # fmt: skip
    if verdict.faults:
        parts["faults"] = verdict.faults
    for title, found in parts.items():
        yield f"  {title} ({len(found)})"
        yield from (f"    {each}" for each in found)


def _table_words(name: str, report: ImportReport) -> list[str]:
    """Say how a table was read, how exact it is, and how well the net holds it."""
    adoption = attrs.evolve(report.adoption, notes=report.own_notes)
    read = list(_read_words(report))
    if report.table is None:
        return [line_table(adoption), name, *read, *_adopted_words(adoption)]
    return _words_of_table(report.table, read, adoption)


def adoption_words(table: OffsetTable, offsets: OffsetReport, adoption: AdoptionReport) -> str:
    """Say how a table was read, how exact it is, and how well the net holds it."""
    read = [f"  {line}" for line in str(offsets).splitlines()]
    return "\n".join(_words_of_table(table, read, adoption))


def _words_of_table(table: OffsetTable, read: list[str], adoption: AdoptionReport) -> list[str]:
    return [
        line_table(adoption),
        f"{table.name}: {len(table.x)} stations, {len(table.z)} waterlines",
        *read,
        *_rounding(table),
        *_adopted_words(adoption),
    ]


def _adopted_words(adoption: AdoptionReport) -> Iterator[str]:
    worst = adoption.worst
    yield (
        f"adopted {len(adoption.lines)} curves, {adoption.own_points} points of theirs that no "
        f"crossing holds; they pass within {1e3 * worst.deviation:.3f} mm of every given point "
        f"({worst.line})"
    )
    yield from (f"  {note}" for note in adoption.notes)


def _slice_words(name: str, whole: ImportReport, report: SliceReport) -> list[str]:
    """Say how a mesh or digitised lines were read, smoothed and adopted."""
    worst = max(report.smoothing, key=lambda each: each.residual)
    adopted = report.adoption.worst
    return [
        line_table(report.adoption, report.smoothing),
        name,
        *_read_words(whole),
        *_joins(report),
        f"noise {1e3 * report.noise:.2g} mm; smoothed by at most {1e3 * worst.residual:.2g} mm "
        f"({worst.line}); {len(report.knuckles)} knuckle lines",
        *(
            f"  boundary curve: {e.name}, from {len(e.lines)} marks, {e.taken} lines end or turn "
            "on it"
            for e in report.borders
        ),
        f"adopted {len(report.adoption.lines)} curves within {1e3 * report.tolerance:.2g} mm, "
        f"{report.adopted} points of theirs that no crossing holds; the farthest smooth point is "
        f"{1e3 * adopted.deviation:.3g} mm off ({adopted.line}); {report.inflections[0]} "
        f"inflections, {report.inflections[1]} more in the net",
        *(f"  {note}" for note in whole.own_notes),
    ]


def _joins(report: SliceReport) -> Iterator[str]:
    """Name the widest joins across gaps."""
    widest = sorted(report.joins, key=lambda each: -each.gap)
    for each in widest[:_MOST_JOINS]:
        x, y, z = each.place
        yield f"  join: {each.line}: {1e3 * each.gap:.1f} mm at ({x:.3f}, {y:.3f}, {z:.3f}) m"
    if len(widest) > _MOST_JOINS:
        yield f"  join: {len(widest) - _MOST_JOINS} more, narrower ones; all in --report"


def _rounding(table: OffsetTable) -> Iterator[str]:
    """Say how exact the printed offsets are, waterlines of one rounding together."""
    unit = table.draught or 1.0
    of = "T" if table.draught else "m"
    found: dict[float, list[str]] = {}
    for z, amount in zip(table.z.tolist(), table.rounding.tolist(), strict=True):
        found.setdefault(round(1e3 * amount, 6), []).append(f"{z / unit:g}")
    for amount, heights in found.items():
        yield f"  rounding: +-{amount:.2g} mm at waterlines {', '.join(heights)} {of}"


def followers(hull: Hull, report: EditReport) -> dict[str, list[str]]:
    """Give the names of the curves an edit re-lofted, by group, along each group."""
    book, found = AddressBook(hull.state), dict[str, list[tuple[float, str]]]()
    for key in report.relofted:
        curve = book.keys[key].curve if key in book.keys else -1
        if curve >= 0:
            line = Curve.of(hull.state, curve).line
            place = (line.position or 0.0, book.curve_name(curve))
            found.setdefault(line.group.name, []).append(place)
    order = [name for name in hull.groups if name in found]
    return {name: [title for _, title in sorted(found[name])] for name in order}


def edit_words(hull: Hull, report: EditReport, indent: str = "  ") -> str:
    """Say what an edit did: what followed, what moved most, what remains."""
    groups = followers(hull, report)
    counts = ", ".join(f"{name} {len(names)}" for name, names in groups.items())
    bent = sum(count for _, count in report.inflections)
    stopped = f"at {counted(report.cut_off, 'point')} that came out as they were"
    lines = [
        f"{indent}followed     {counted(len(report.relofted), 'curve')} re-lofted "
        f"({counts or 'none'})",
        *([f"{indent}stopped      {stopped}"] if report.cut_off else []),
        *(wrap_text(name, names, indent) for name, names in groups.items()),
        *_moved(hull, report, indent),
        f"{indent}largest gap  {1e3 * report.largest_gap:.2f} mm; "
        f"{counted(bent, 'new inflection') if bent else 'no new inflection'}",
        *lists(hull, report, indent),
    ]
    return "\n".join(lines)


def _moved(hull: Hull, report: EditReport, indent: str) -> Iterator[str]:
    """Name the largest movement along the normal, and the farthest slide along curves."""
    if report.largest is None:
        return
    normal = report.largest_normal
    if normal is None:
        yield f"{indent}moved most   {_movement(hull, report.largest)}"
        return
    yield f"{indent}moved most   {_movement(hull, normal, ' along the normal')}"
    if report.largest.distance > normal.distance + SAME_MOVEMENT:
        yield f"{indent}with slides  {_movement(hull, report.largest)}"


def _movement(hull: Hull, movement: Movement, way: str = "") -> str:
    book, (x, y, z) = AddressBook(hull.state), movement.place
    key = movement.point
    name = book.address(book.keys[key].row) if key in book.keys else movement.name or key
    return f"{name}, by {1e3 * movement.distance:.1f} mm{way}, to ({x:.3f}, {y:.3f}, {z:.3f}) m"


def lists(hull: Hull, report: EditReport, indent: str) -> Iterator[str]:
    """Name what appeared, vanished, was mended or could not be made."""
    book = AddressBook(hull.state)
    for title in ("born", "gone", "mended", "failed", "blocked", "notes"):
        names: Sequence[str] = getattr(report, title)
        if names:
            yield wrap_text(title, [_spoken(book, each) for each in names], indent)


def _spoken(book: AddressBook, key: str) -> str:
    """Give what is called by a key its name; of a crossing that is not there the two lines'."""
    found = book.keys.get(key)
    if found is not None and found.row >= 0:
        return book.address(found.row)
    crossing, _, sense = key.rpartition(" ")
    ends = crossing.split(" x ")
    if len(ends) != 2 or not sense.lstrip("+-").isdigit():
        return key
    lines = (book.keys.get(each) for each in ends)
    return " x ".join(
        each if line is None else book.line_name(line.line)
        for each, line in zip(ends, lines, strict=True)
    )
