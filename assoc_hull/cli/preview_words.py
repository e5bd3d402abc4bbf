"""What an edit would do, in words: which lines, how far, where, and what the hull displaces."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from operator import attrgetter

from assoc_hull.cli.words import lists, wrapped
from assoc_hull.edit.explain.line_changes import LineChange
from assoc_hull.edit.explain.preview import Preview
from assoc_hull.edit.report import EditReport
from assoc_hull.hull import Hull
from assoc_hull.model.address import AddressBook

__all__ = ["preview_words"]

_SMALL = 1e-4
"""Lines that move less than this (m) are counted, and not named."""


def preview_words(hull: Hull, found: Preview, indent: str = "  ") -> Iterator[str]:
    """Say what an edit would do, in lines.

    Parameters
    ----------
    hull : Hull
        The hull as it is.
    found : Preview
        What was found; not refused.
    indent : str
        What every line begins with.
    """
    report = found.report
    if report is None or not report.changed:
        yield f"{indent}nothing would change"
        return
    yield f"{indent}would change {len(found.lines)} lines"
    for group, lines in groupby(found.lines, attrgetter("group")):
        yield from _group(group, tuple(lines), indent)
    yield from _remains(hull, report, indent)
    yield from _displaces(hull, found, indent)
    yield from lists(report, indent)


def _group(name: str, lines: Sequence[LineChange], indent: str) -> Iterator[str]:
    """Name the lines of a group that would move, and say where most."""
    moved = [each for each in lines if each.distance is None or each.distance >= _SMALL]
    yield f"{indent}{name:12} {len(lines)}" + _less(len(lines) - len(moved))
    pad = indent + "  "
    if moved:
        yield wrapped("lines", [each.line for each in moved], pad)
    yield from _most(lines, pad)


def _less(count: int) -> str:
    return f", {count} of them by less than {1e3 * _SMALL:g} mm" if count else ""


def _most(lines: Iterable[LineChange], pad: str) -> Iterator[str]:
    """Say which of some lines would move most, and where."""
    known = [each for each in lines if each.distance is not None and each.place is not None]
    if not known:
        return
    most = max(known, key=lambda each: each.distance or 0.0)
    x, y, z = most.place or (0.0, 0.0, 0.0)
    where = f"{most.line}, between its points," if most.point is None else most.point
    yield (
        f"{pad}{'most':12} {1e3 * (most.distance or 0.0):.3f} mm at {where} "
        f"({x:.3f}, {y:.3f}, {z:.3f}) m"
    )


def _remains(hull: Hull, report: EditReport, indent: str) -> Iterator[str]:
    """Name the curves that would turn more often than they do, and the largest gap."""
    added, book = report.inflections, AddressBook(hull.state)
    yield f"{indent}inflections  {sum(count for _, count in added)} new"
    if added:
        names = [f"{book.curve_name(book.keys[key].curve)} ({count})" for key, count in added]
        yield wrapped("on", names, indent + "  ")
    yield f"{indent}largest gap  {1e3 * report.largest_gap:.2f} mm"


def _displaces(hull: Hull, found: Preview, indent: str) -> Iterator[str]:
    if found.volume_change is None or found.lcb_change is None:
        yield f"{indent}volume       not known: it takes two sections or more"
        return
    draught = hull.particulars.draught
    yield (
        f"{indent}volume       {found.volume_change:+.4g} m3 (both sides, draught {draught:g} m); "
        f"LCB {1e3 * found.lcb_change:+.4g} mm"
    )
