"""A parent and a variant of it side by side: lines, numbers, fairness, points, features.

`compare` gives a `HullComparison`. The rows of its tables are made once and are the same on a
terminal, on paper and in the plots. All differences are variant less parent; lengths in m, shifts
of lines printed in mm. The schema of its JSON is in `assoc_hull.io.tables.comparison`.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import chain
from types import MappingProxyType
from typing import Any

import attrs

from assoc_hull.analysis.form.floating_shape import Screw
from assoc_hull.arguments import choice, instance, integer
from assoc_hull.display import ShownAsText, html_room, html_table, html_text
from assoc_hull.model.definition.fingerprint import fingerprint
from assoc_hull.model.features import Place
from assoc_hull.model.named_mapping import NamedMapping
from assoc_hull.model.tables import HasState, HullState, Particulars, state_of
from assoc_hull.variation.comparing.line_comparison import LineComparison, LineShift, compare_lines
from assoc_hull.variation.comparing.line_fairness import FairnessComparison, LineFairness
from assoc_hull.variation.comparing.number_comparison import (
    FeatureComparison,
    NumberComparison,
    PointsComparison,
    compare_features,
    compare_numbers,
    compare_points,
    numbers_of,
)

__all__ = [
    "COMPARISON_FORMAT",
    "LINE_HEAD",
    "NUMBER_HEAD",
    "PRINCIPAL",
    "SCHEMA",
    "ComparedHull",
    "HullComparison",
    "alike_words",
    "amount",
    "change_words",
    "compare",
    "comparison_document",
    "comparison_json",
    "comparison_text",
    "counts",
    "hull_words",
    "line_cells",
    "line_words",
    "number_cells",
    "object_words",
    "reason_words",
    "that_differ",
    "visibly_moved",
]

_WHERE = "in compare"


@attrs.frozen
class ComparedHull:
    """One of both hulls.

    Attributes
    ----------
    particulars : Particulars
        Name and principal dimensions, m.
    fingerprint : str
        SHA-256 of definition and published values.
    draught : float, m
        Moulded, at which it was measured, at even keel.
    doubts : tuple of str
        What makes its hydrostatics doubtful, or why there are none.
    """

    particulars: Particulars
    fingerprint: str
    draught: float
    doubts: tuple[str, ...]


_OUT_OF_MEASURE = 1e4
"""A ratio of combs as large as this has no decimals."""

_SHARPER = 2.5
"""Times the comb integral of the parent's line, above which a line is told to be less fair."""

_BY: Mapping[str, Callable[[LineComparison], float]] = MappingProxyType(
    {
        "shift": lambda line: line.length,
        "course": lambda line: line.course,
        "comb": lambda line: line.comb_ratio or 0.0,
        "signs": lambda line: float(line.added),
    }
)
"""By what lines may be sorted, the greatest first."""


@attrs.frozen(eq=False, repr=False)
class HullComparison(ShownAsText):
    """A parent and a variant side by side; `str` gives it as a table.

    Attributes
    ----------
    parent, variant : ComparedHull
        Which hulls, and at which draughts.
    lines : tuple of LineComparison
        Every line of either, in the order of the variant; those that went come last.
    hydrostatics : tuple of NumberComparison
        As `Hull.hydrostatics` gives them, under its names.
    parameters : tuple of NumberComparison
        All form parameters, in the order of the tables of the catalogue.
    points : PointsComparison
        Points that came and went.
    features : tuple of FeatureComparison
        Every feature of either.
    """

    parent: ComparedHull
    variant: ComparedHull
    lines: tuple[LineComparison, ...]
    hydrostatics: tuple[NumberComparison, ...]
    parameters: tuple[NumberComparison, ...]
    points: PointsComparison
    features: tuple[FeatureComparison, ...]

    def line(self, name: str) -> LineComparison:
        """Give a line by its name.

        Raises
        ------
        UnknownNameError
            Neither hull has it.
        """
        return NamedMapping("line", {each.name: each for each in reversed(self.lines)})[name]

    def hydrostatic(self, name: str) -> NumberComparison:
        """Give a value of the record of hydrostatics by its name or its symbol: "kmt", "KM_T".

        Raises
        ------
        UnknownNameError
            There is none.
        """
        named = {each.symbol: each for each in self.hydrostatics}
        # A reader of the table knows the symbol that is printed, and not the name of the field.
        named |= {each.printed_symbol: each for each in self.hydrostatics}
        return NamedMapping("value", named)[name]

    def parameter(self, symbol: str) -> NumberComparison:
        """Give a form parameter by its symbol.

        Raises
        ------
        UnknownNameError
            There is none.
        """
        return NamedMapping("form parameter", {each.symbol: each for each in self.parameters})[
            symbol
        ]

    def worst(self, count: int = 10, *, by: str = "shift") -> tuple[LineComparison, ...]:
        """Give the lines that changed most, the worst first.

        Parameters
        ----------
        count : int
            At most so many.
        by : {"shift", "course", "comb", "signs"}
            The largest shift; that beside the shift of the plane; the ratio of the comb
            integrals; changes of sign of curvature that were added. A line of which this is
            zero does not come, nor one whose comb has not risen.

        Raises
        ------
        BadInputError
            No such number, or another order.
        """
        integer(count, "count", "in worst", least=0)
        measure = _BY[choice(by, "by", _BY, "in worst")]
        least = 1.0 if by == "comb" else 0.0
        found = [line for line in self.lines if line.what == "moved" and measure(line) > least]
        return tuple(sorted(found, key=lambda line: -measure(line))[:count])

    @property
    def less_fair(self) -> tuple[LineComparison, ...]:
        """Lines that are less fair than in the parent, those of the sharpest combs first.

        Their curvature changes its sign more often, or their comb integral has risen by more than
        2.5 times, as no designer would let it.
        """
        found = [
            line for line in self.lines
            if line.added > 0 or (line.comb_ratio or 0.0) > _SHARPER
        ]  # fmt: skip
        return tuple(sorted(found, key=lambda line: -(line.comb_ratio or 0.0)))

    def of(self, what: str) -> tuple[LineComparison, ...]:
        """Give the lines that are the same, moved, came or went.

        Raises
        ------
        BadInputError
            Another word.
        """
        choice(what, "what", ("same", "moved", "came", "went"), "in of")
        return tuple(line for line in self.lines if line.what == what)

    @property
    def fairness(self) -> FairnessComparison:
        """Changes of sign and comb ratios of the lines of both, and their sums."""
        told = (line.fairness for line in self.lines)
        return FairnessComparison(tuple(each for each in told if each is not None))

    @property
    def is_same(self) -> bool:
        """Tell whether both hulls have the same fingerprint."""
        return self.parent.fingerprint == self.variant.fingerprint

    def to_json(self) -> str:
        """Give everything as JSON text; its schema is `comparison` of ``assoc-hull schema``."""
        return comparison_json(self)

    def __str__(self) -> str:
        return comparison_text(self)

    def _repr_html_(self) -> str:
        moved = [line_cells(each) for each in visibly_moved(self)[:_LISTED]]
        numbers = [self.hydrostatic(name) for name in PRINCIPAL]
        tables = [html_table(LINE_HEAD, moved, right=(1, 4, 5, 6, 7))] if moved else []
        tables += [
            html_table(NUMBER_HEAD, map(number_cells, differ), right=(3, 4, 5, 6))
            for differ in (that_differ(numbers), that_differ(self.parameters))
            if differ
        ]
        return html_room(html_text("\n".join([*_head(self), *_less_fair(self, _LISTED)])), *tables)


def compare(
    parent: HasState,
    variant: HasState,
    *,
    draught: float | None = None,
    screw: Screw | None = None,
) -> HullComparison:
    """Compare a variant with its parent, or any two hulls.

    Lines are paired by name, and by key where one was renamed. Of each pair the largest shift
    is reported, measured curve to curve in the plane of the line (see
    `assoc_hull.variation.comparing.line_comparison`), and how fair it is before and after. All
    differences are variant less parent: with both exchanged, they change their signs.

    Parameters
    ----------
    parent, variant : Hull
        The hulls; neither is changed.
    draught : float or None, m
        Moulded, at even keel, for the numbers of both; each at its design draught if not given.
    screw : Screw or None
        For the form parameters that need it.

    Returns
    -------
    HullComparison
        Everything; what has no number has a reason.

    Raises
    ------
    OutOfRangeError
        One of both does not float at the draught that was asked.
    BadInputError
        No hull, or a number that cannot be used.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> parent = ah.examples.wigley()
    >>> found = parent.compare(parent.vary(set={"breadth": 11.0}).hull, draught=5.0)
    >>> print(f"{found.parameter('BMT').percent:.3f} %")
    21.000 %
    """
    old, new = state_of(parent, _WHERE), state_of(variant, _WHERE)
    if screw is not None:
        instance(screw, Screw, "screw", _WHERE)
    was, now = (numbers_of(hull, draught, screw) for hull in (parent, variant))
    hydrostatics, parameters = compare_numbers(was, now)
    return HullComparison(
        _compared(old, draught, was.doubts),
        _compared(new, draught, now.doubts),
        compare_lines(old, new),
        hydrostatics,
        parameters,
        compare_points(old, new),
        compare_features(old, new),
    )


def _compared(state: HullState, draught: float | None, doubts: Iterable[str]) -> ComparedHull:
    ship = state.particulars
    level = ship.draught if draught is None else float(draught)
    return ComparedHull(ship, fingerprint(state), level, tuple(doubts))


PRINCIPAL = (
    "volume", "displacement", "lcb", "lcb_percent", "kb", "kmt", "kml", "waterplane_area", "lcf",
    "tpc", "mtc", "wetted_surface", "lwl", "bwl", "a_max", "a_midship", "cb", "cm", "cp", "cw",
)  # fmt: skip
"""The values of hydrostatics that are printed."""

LINE_HEAD = (
    "line", "shift mm", "direction", "at x, y, z (m)", "plane mm", "signs", "comb", "points",
)  # fmt: skip
"""Head of `line_cells`: the largest shift, where it is on the variant, that of the plane alone;
changes of sign of curvature, ratio of the comb integrals, points that define the line."""

NUMBER_HEAD = ("", "symbol", "unit", "parent", "variant", "difference", "%")
"""Head of `number_cells`."""

_LISTED = 10
"""At most so many points are listed."""

_STATES = ("same", "moved", "came", "went")


def hull_words(hull: ComparedHull) -> str:
    """Give name, dimensions (m) and measured draught of a hull as text."""
    ship = hull.particulars
    sizes = f"Lpp {ship.length:.3f}, B {ship.breadth:.3f}, D {ship.depth:.3f}, T {ship.draught:.3f}"
    return f"{ship.name}: {sizes} m; measured at {hull.draught:.3f} m"


def counts(found: HullComparison) -> str:
    """Give how many lines are the same, moved, came and went, as text."""
    return ", ".join(f"{len(found.of(what))} {what}" for what in _STATES)


def line_cells(line: LineComparison) -> list[str]:
    """Give the row of a line, below `LINE_HEAD`."""
    shift, fair, ratio = line.shift, line.fairness, line.comb_ratio
    plane = None if shift is None else shift.plane
    return [
        line.name,
        f"{1e3 * line.length:.1f}",
        "-" if shift is None else shift.direction,
        "-" if shift is None else ", ".join(f"{each:.2f}" for each in shift.after),
        "-" if plane is None else f"{1e3 * plane:+.1f}" if plane else "0",
        "-" if fair is None else f"{fair.before.sign_changes} > {fair.after.sign_changes}",
        "-" if ratio is None else _ratio_words(ratio),
        f"{line.points[0]} > {line.points[1]}",
    ]


def _ratio_words(ratio: float) -> str:
    """Give a ratio; of one that is out of all measure, how large it is."""
    return f"{ratio:.3f}" if ratio < _OUT_OF_MEASURE else f"{ratio:.2g}"


def visibly_moved(found: HullComparison) -> tuple[LineComparison, ...]:
    """Give the lines whose shift is not printed as 0.0 mm, the farthest first."""
    return tuple(line for line in found.worst(len(found.lines)) if round(1e3 * line.length, 1))


def line_words(found: HullComparison) -> Iterator[str]:
    """Give which lines came, went or were renamed, and the fairness of all together."""
    hidden = len(found.of("moved")) - len(visibly_moved(found))
    if hidden:
        yield f"moved by less than 0.05 mm: {hidden}"
    for what in ("came", "went"):
        names = ", ".join(each.name for each in found.of(what))
        if names:
            yield f"{what}: {names}"
    for each in found.lines:
        if each.was not in (None, each.name):
            yield f"renamed: {each.was} > {each.name}"
    fair = found.fairness
    if fair.changed:
        worst = fair.worst_line
        yield (
            f"fairness of {len(fair.changed)} lines that changed: {fair.before} > {fair.after} "
            f"changes of sign, comb ratio {_ratio_words(fair.median)}"
            + ("" if worst is None else f", worst {_ratio_words(fair.worst)} ({worst.name})")
        )


def number_cells(number: NumberComparison) -> list[str]:
    """Give the row of a number, below `NUMBER_HEAD`."""
    digits, difference, percent = number.digits, number.difference, number.percent
    return [
        number.short_title,
        number.printed_symbol,
        number.unit,
        amount(number.before, digits),
        amount(number.after, digits),
        "-" if difference is None else f"{round(difference, digits) + 0.0:+.{digits}f}",
        "-" if percent is None else f"{round(percent, 3) + 0.0:+.3f}",
    ]


def amount(value: float | None, digits: int) -> str:
    """Give a number with fixed digits; a dash where there is none.

    Adding 0.0 turns -0.0 into 0.0, which prints without a sign.
    """
    return "-" if value is None else f"{round(value, digits) + 0.0:.{digits}f}"


def that_differ(numbers: Sequence[NumberComparison]) -> list[NumberComparison]:
    """Give the numbers whose printed digits differ, and those that only one of both has."""
    return [each for each in numbers if not each.prints_alike]


def alike_words(numbers: Sequence[NumberComparison]) -> Iterator[str]:
    """Give the symbols of values that print alike, whose rows are left out."""
    alike = [
        each.printed_symbol for each in numbers if each.prints_alike and each.after is not None
    ]
    if alike:
        yield f"alike in both: {', '.join(alike)}"


def reason_words(numbers: Sequence[NumberComparison]) -> Iterator[str]:
    """Give why numbers are missing, each reason once."""
    reasons = dict[str, list[str]]()
    for each in numbers:
        if each.reason is not None:
            reasons.setdefault(each.reason, []).append(each.printed_symbol)
    yield from (f"{', '.join(symbols)}: {reason}" for reason, symbols in reasons.items())


def object_words(found: HullComparison) -> Iterator[str]:
    """Give which points came and went, and which features changed."""
    points = found.points
    yield "points: " + ", ".join(
        f"{count} > {points.after[sort]} {sort}" for sort, count in points.before.items()
    )
    for what, names in (("came", points.came), ("went", points.went)):
        if names:
            more = f" and {len(names) - _LISTED} more" if len(names) > _LISTED else ""
            yield f"{len(names)} {what}: {', '.join(names[:_LISTED])}{more}"
    for each in found.features:
        if each.what != "same":
            yield f"feature {each.name} ({each.kind}) {each.what}{_parameters(each)}"


def _parameters(feature: FeatureComparison) -> str:
    """Give the parameters of a feature that differ, before and after."""
    old, new = feature.before, feature.after
    if old is None or new is None:
        return ""
    told = [
        f"{name} {_value(old[name])} > {_value(new[name])}"
        for name in new
        if name in old and old[name] != new[name]
    ]
    return f": {', '.join(told)}" if told else ""


def _value(value: float | Place) -> str:
    if isinstance(value, tuple):
        return f"({', '.join(f'{each:g}' for each in value)})"
    return f"{value:g}"


# --------------------------------------------------------------------------------------
# The table for a terminal.


def comparison_text(found: HullComparison, lines: int = 10) -> str:
    """Lay out a comparison: lines that moved, numbers, what came and went.

    Parameters
    ----------
    found : HullComparison
        The comparison.
    lines : int
        At most so many lines are listed, those that moved farthest.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.variation.comparing.comparison import comparison_text
    >>> hull = ah.examples.wigley()
    >>> print(comparison_text(hull.compare(hull)).splitlines()[3])
    lines: 31 same, 0 moved, 0 came, 0 went
    """
    parts = [
        _head(found),
        _less_fair(found, lines),
        _lines(found, lines),
        _numbers("HYDROSTATICS", [found.hydrostatic(name) for name in PRINCIPAL]),
        _numbers("FORM PARAMETERS", found.parameters),
        ("", *object_words(found)),
    ]
    return "\n".join(chain.from_iterable(parts))


def change_words(found: HullComparison, lines: int = 10) -> Iterator[str]:
    """Say what a variation would change: the lines, those that are less fair, the main numbers."""
    yield f"lines: {counts(found)}"
    yield from line_words(found)
    yield from _less_fair(found, lines)
    yield from _lines(found, lines)
    yield from _numbers("HYDROSTATICS", [found.hydrostatic(name) for name in PRINCIPAL])


def _head(found: HullComparison) -> Iterator[str]:
    for title, hull in (("parent", found.parent), ("variant", found.variant)):
        yield f"{title:9}{hull_words(hull)}"
        yield from (f"{'':9}{each}" for each in hull.doubts)
    if found.is_same:
        yield f"{'':9}the same hull: both have one fingerprint"
    yield f"lines: {counts(found)}"
    yield from line_words(found)


def _less_fair(found: HullComparison, count: int) -> Iterator[str]:
    """Warn of lines that are less fair, by name; at most so many."""
    less = found.less_fair
    if less:
        yield ""
        lines = "1 line is" if len(less) == 1 else f"{len(less)} lines are"
        yield f"WARNING: {lines} less fair than in the parent"
        yield from (
            f"  {line.name}: {line.added:+d} changes of curvature sign, comb integral "
            + _comb_words(line)
            for line in less[:count]
        )
        if len(less) > count:
            yield f"  and {len(less) - count} more"


def _comb_words(line: LineComparison) -> str:
    """Say by how much the comb integral has risen; of a line that was straight, to what."""
    if line.comb_ratio is None:
        return "of no parent"
    fair = line.fairness
    if fair is not None and fair.before.comb <= fair.before.least_comb:
        return f"0 > {fair.after.comb:.3g} 1/m3"
    return f"{line.comb_ratio:.3g} times"


def _lines(found: HullComparison, count: int) -> Iterator[str]:
    chosen = visibly_moved(found)[:count]
    if chosen:
        yield ""
        yield f"LINES, the {len(chosen)} that moved farthest of {len(found.of('moved'))}"
        yield from _laid_out([LINE_HEAD, *map(line_cells, chosen)], "<><<>>>>")


def _numbers(title: str, numbers: Sequence[NumberComparison]) -> Iterator[str]:
    differ, alike = that_differ(numbers), list(alike_words(numbers))
    if differ or alike:
        yield ""
        yield title
    if differ:
        yield from _laid_out([NUMBER_HEAD, *map(number_cells, differ)], "<<<>>>>")
        yield from reason_words(differ)
    yield from alike


def _laid_out(rows: Iterable[Sequence[str]], sides: str) -> Iterator[str]:
    """Put cells below one another, each column to the side "<" or ">"."""
    cells = [list(row) for row in rows]
    wide = [max(len(each) for each in column) for column in zip(*cells, strict=True)]
    for row in cells:
        told = [f"{each:{side}{room}}" for each, side, room in zip(row, sides, wide, strict=True)]
        yield "  ".join(told).rstrip()


# --------------------------------------------------------------------------------------
# The comparison as JSON.

COMPARISON_FORMAT = "assoc-hull comparison"
SCHEMA = 1
"""Version of the schema."""


def comparison_json(found: HullComparison) -> str:
    """Give a comparison as JSON text; it ends with a newline."""
    return json.dumps(comparison_document(found), indent=1, allow_nan=False) + "\n"


def comparison_document(found: HullComparison) -> dict[str, Any]:
    """Give a comparison as JSON says it: every number to its last bit, derived ones as well."""
    return {
        "format": COMPARISON_FORMAT,
        "schema": SCHEMA,
        "parent": _hull_data(found.parent),
        "variant": _hull_data(found.variant),
        "lines": [_line(each) for each in found.lines],
        "hydrostatics": [_number(each) for each in found.hydrostatics],
        "parameters": [_number(each) for each in found.parameters],
        "points": _as_data(found.points),
        "features": [_as_data(each) for each in found.features],
    }


def _as_data(thing: PointsComparison | FeatureComparison) -> dict[str, Any]:
    """Give the attributes of a thing; read-only mappings become dicts."""
    told = attrs.asdict(thing, recurse=False)
    return {
        name: dict(value) if isinstance(value, Mapping) else value for name, value in told.items()
    }


def _hull_data(hull: ComparedHull) -> dict[str, Any]:
    return {
        **attrs.asdict(hull.particulars), "fingerprint": hull.fingerprint,
        "at_draught": hull.draught, "doubts": list(hull.doubts),
    }  # fmt: skip


def _line(line: LineComparison) -> dict[str, Any]:
    ratio = line.comb_ratio
    return {
        "name": line.name,
        "was": line.was,
        "group": line.group,
        "what": line.what,
        "shift": None if line.shift is None else _shift(line.shift),
        "before": _fairness(line.before, line.points[0]),
        "after": _fairness(line.after, line.points[1]),
        "comb_ratio": None if ratio is None or math.isinf(ratio) else ratio,
    }


def _shift(shift: LineShift) -> dict[str, Any]:
    return {
        **attrs.asdict(shift), "vector": shift.vector, "length": shift.length,
        "direction": shift.direction,
    }  # fmt: skip


def _fairness(fairness: LineFairness | None, points: int) -> dict[str, Any] | None:
    if fairness is None:
        return None
    return {"points": points, "sign_changes": fairness.sign_changes, "comb": fairness.comb}


def _number(number: NumberComparison) -> dict[str, Any]:
    derived = {"difference": number.difference, "percent": number.percent}
    return {**attrs.asdict(number), **derived}
