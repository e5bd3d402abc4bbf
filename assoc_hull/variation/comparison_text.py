"""A comparison of two hulls in words: lines that moved most, numbers, what came and went."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain
from typing import TYPE_CHECKING

from assoc_hull.model.feature import Place
from assoc_hull.variation.comparison_lines import LineComparison
from assoc_hull.variation.comparison_numbers import NumberComparison
from assoc_hull.variation.comparison_objects import FeatureComparison

if TYPE_CHECKING:
    from assoc_hull.variation.comparison import HullComparison

__all__ = ["PRINCIPAL", "amount", "change", "comparison_text", "per_cent"]

PRINCIPAL = (
    "volume", "displacement", "lcb", "lcb_percent", "kb", "kmt", "kml", "waterplane_area", "lcf",
    "tpc", "mtc", "wetted_surface", "lwl", "bwl", "a_max", "a_midship", "cb", "cm", "cp", "cw",
)  # fmt: skip
"""The values of hydrostatics that are printed."""

_TOLD = 10
"""At most so many points, or reasons, are listed."""

_LINE_HEAD = (
    "line", "shift mm", "direction", "at x, y, z (m)", "plane mm", "signs", "comb", "points",
)  # fmt: skip
_NUMBER_HEAD = ("", "unit", "parent", "variant", "difference", "%")

Rows = Sequence[Sequence[str]]


def comparison_text(found: HullComparison, lines: int = 10) -> str:
    """Lay out a comparison as a table for a terminal.

    Parameters
    ----------
    found : HullComparison
        The comparison.
    lines : int
        So many lines are listed, those that moved farthest.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.variation.comparison_text import comparison_text
    >>> hull = ah.examples.wigley()
    >>> print(comparison_text(ah.compare(hull, hull)).splitlines()[3])
    lines: 31 the same, 0 moved, 0 came, 0 went
    """
    parts = [
        _head(found),
        _lines(found, lines),
        _numbers("HYDROSTATICS", [found.hydrostatic(name) for name in PRINCIPAL]),
        _numbers("FORM PARAMETERS", [each for each in found.parameters if not each.is_same]),
        _objects(found),
    ]
    return "\n".join(chain.from_iterable(parts))


def _head(found: HullComparison) -> Iterator[str]:
    for title, hull in (("parent", found.parent), ("variant", found.variant)):
        ship = hull.particulars
        yield f"{title:9}{ship.name}: Lpp {ship.length:.3f}, B {ship.breadth:.3f}, " + (
            f"D {ship.depth:.3f}, T {ship.draught:.3f} m; measured at {hull.draught:.3f} m"
        )
        yield from (f"{'':9}{each}" for each in hull.doubts)
    if found.is_same:
        yield "         the same hull: both have one fingerprint"
    count = {what: len(found.of(what)) for what in ("same", "moved", "came", "went")}
    yield "lines: {same} the same, {moved} moved, {came} came, {went} went".format(**count)
    fair = found.fairness
    if fair.changed:
        yield f"fairness of {len(fair.changed)} lines that changed: {_fairness(found)}"


def _fairness(found: HullComparison) -> str:
    fair = found.fairness
    words = f"{fair.before} -> {fair.after} changes of sign, comb ratio {fair.median:.3f}"
    worst = fair.worst_line
    return words + ("" if worst is None else f", worst {fair.worst:.3f} ({worst.name})")


def _lines(found: HullComparison, count: int) -> Iterator[str]:
    chosen = found.worst(count)
    if chosen:
        of = len(found.of("moved"))
        yield ""
        yield f"LINES, the {len(chosen)} that moved farthest of {of}"
        yield from _laid_out([_LINE_HEAD, *(_line_cells(each) for each in chosen)], "<><<>>>>")
    for what in ("came", "went"):
        names = ", ".join(each.name for each in found.of(what))
        if names:
            yield f"{what}: {names}"
    for each in found.lines:
        if each.was not in (None, each.name):
            yield f"renamed: {each.was} -> {each.name}"


def _line_cells(line: LineComparison) -> list[str]:
    shift, fair, ratio = line.shift, line.fairness, line.comb_ratio
    plane = None if shift is None else shift.plane
    return [
        line.name,
        f"{1e3 * line.length:.1f}",
        "-" if shift is None else shift.direction,
        "-" if shift is None else ", ".join(f"{each:.2f}" for each in shift.after),
        "-" if plane is None else f"{1e3 * plane:+.1f}" if plane else "0",
        "-" if fair is None else f"{fair.before.sign_changes} > {fair.after.sign_changes}",
        "-" if ratio is None else f"{ratio:.3f}",
        f"{line.points[0]} > {line.points[1]}",
    ]


def _numbers(title: str, numbers: Sequence[NumberComparison]) -> Iterator[str]:
    if not numbers:
        return
    yield ""
    yield title
    yield from _laid_out([_NUMBER_HEAD, *(_number_cells(each) for each in numbers)], "<<>>>>")
    reasons = dict[str, list[str]]()
    for each in numbers:
        if each.reason is not None:
            reasons.setdefault(each.reason, []).append(each.symbol)
    yield from (f"{', '.join(symbols)}: {reason}" for reason, symbols in reasons.items())


def _number_cells(number: NumberComparison) -> list[str]:
    return [
        number.symbol, number.unit, amount(number.before, number.digits),
        amount(number.after, number.digits), change(number), per_cent(number),
    ]  # fmt: skip


def amount(value: float | None, digits: int) -> str:
    """Give a number as it is printed; a dash where there is none."""
    return "-" if value is None else f"{round(value, digits) + 0.0:.{digits}f}"


def change(number: NumberComparison) -> str:
    """Give a difference as it is printed."""
    if number.difference is None:
        return "-"
    return f"{round(number.difference, number.digits) + 0.0:+.{number.digits}f}"


def per_cent(number: NumberComparison) -> str:
    """Give a difference in percent as it is printed."""
    return "-" if number.percent is None else f"{round(number.percent, 3) + 0.0:+.3f}"


def _objects(found: HullComparison) -> Iterator[str]:
    points = found.points
    yield ""
    yield "points: " + ", ".join(
        f"{count} > {points.after[sort]} {sort}" for sort, count in points.before.items()
    )
    for what, names in (("came", points.came), ("went", points.went)):
        if names:
            more = f" and {len(names) - _TOLD} more" if len(names) > _TOLD else ""
            yield f"{len(names)} {what}: {', '.join(names[:_TOLD])}{more}"
    for each in found.features:
        if each.what != "same":
            yield f"feature {each.name} ({each.kind}) {each.what}{_parameters(each)}"


def _parameters(feature: FeatureComparison) -> str:
    """Tell the parameters of a feature that differ."""
    old, new = feature.before, feature.after
    if old is None or new is None:
        return ""
    told = [
        f"{name} {_value(old[name])} -> {_value(new[name])}"
        for name in new
        if name in old and old[name] != new[name]
    ]
    return f": {', '.join(told)}" if told else ""


def _value(value: float | Place) -> str:
    if isinstance(value, tuple):
        return f"({', '.join(f'{each:g}' for each in value)})"
    return f"{value:g}"


def _laid_out(rows: Iterable[Sequence[str]], sides: str) -> Iterator[str]:
    """Put cells below one another, each column to one side."""
    cells = [list(row) for row in rows]
    wide = [max(len(each) for each in column) for column in zip(*cells, strict=True)]
    for row in cells:
        told = [f"{each:{side}{room}}" for each, side, room in zip(row, sides, wide, strict=True)]
        yield "  ".join(told).rstrip()
