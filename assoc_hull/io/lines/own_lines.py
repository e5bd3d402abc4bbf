"""What our drawings tell of lines besides their splines, so that a hull comes back as it was.

A file of ours holds a text for the hull (lines, particulars, tolerances, associations) and one for
each curve (its points and what they are, knuckles, tangents, ends): JSON in ASCII, in m, wherever
the form has room for it. The splines themselves are those of the form, with a knot at every point.
The curve that is lofted through the points must be the spline of the file again; else another
program has changed it. Points stand in the text to the last bit, which a spline tells to rounding
only: where a line ends in the plane of another, that bit decides whether they meet.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import attrs
import numpy as np

from assoc_hull.arguments import once
from assoc_hull.errors import AssocHullError, BadInputError
from assoc_hull.geometry.curves import EndKind, PointKind, SplineBatch
from assoc_hull.geometry.patches.spline_curve import SplineCurve
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.segments import evaluate
from assoc_hull.io.reports import ExportBook
from assoc_hull.model.kinds import OWN, BoundaryKind, Sort
from assoc_hull.model.line_source import LineSource, Origin, line_curve_data
from assoc_hull.model.tables import Association, Ends, HullState, Particulars
from assoc_hull.tolerance import Tolerances

__all__ = [
    "BETWEEN",
    "EXACT",
    "IMAGE",
    "MARK",
    "OwnLines",
    "TextedCurve",
    "curve_texts",
    "hull_text",
    "own_lines",
    "pieces_of",
    "tell_losses",
]

IMAGE = "image"
"""Our text of a curve that is but the image of another to starboard."""

MARK = "ASSOC_HULL"
"""Under this name our texts stand in a file."""

EXACT = 1e-9
"""A curve that comes back differs from the spline of the file by no more than this (m)."""

_VERSION = 1
_ADOPTED, _PLACED = -1, -2
_KNOWN = {_ADOPTED: Sort.ADOPTED, _PLACED: Sort.PLACED}
_AGAIN = "export it again"
_NEAR = 1e-6
"""How far (m) adoption says that a line may be passed; that it is nearer is checked apart."""

# --------------------------------------------------------------------------------------
# Writing.


def hull_text(state: HullState) -> str:
    """Give the text of the hull: its lines by number, and all that is of no one curve."""
    ship, known = state.particulars, state.tolerances
    lines = [_line(state, line) for line in state.live("lines").tolist()]
    return _compact({
        "assoc-hull lines": _VERSION,
        "curves": len(state.live("curves")),
        "particulars": attrs.asdict(ship),
        "tolerances": {k: v for k, v in attrs.asdict(known).items() if v != _DEFAULTS[k]},
        "groups": {
            str(state.groups.name[i]): str(state.groups.family[i])
            for i in state.live("groups").tolist()
            if state.groups.family[i] != OWN
        },
        "associations": [[each.a, each.b, each.two_way] for each in state.associations],
        "features": [[each.kind, each.name] for each in state.features],
        "lines": lines,
    })  # fmt: skip


_DEFAULTS = attrs.asdict(Tolerances())


def _compact(record: Mapping[str, Any]) -> str:
    text = json.dumps(record, ensure_ascii=True, allow_nan=False, separators=(",", ":"))
    # Readers of DXF and IGES strip words, and DXF has meanings of its own for ^ and %%.
    return "".join(_ESCAPED.get(each, each) for each in text)


BETWEEN = "|"
"""Texts may be joined by this letter: none of them holds it."""

_ESCAPED = {each: f"\\u{ord(each):04x}" for each in (" ", "^", "%", BETWEEN)}


def _line(state: HullState, line: int) -> dict[str, Any]:
    table = state.lines
    found: dict[str, Any] = {
        "name": str(table.name[line]),
        "group": str(state.groups.name[table.group[line]]),
    }
    if table.planar[line]:
        found["plane"] = [*table.normal[line].tolist(), float(table.offset[line])]
    if table.boundary[line] >= 0:
        found["boundary"] = BoundaryKind(int(table.boundary[line])).name.lower()
    return found


def curve_texts(state: HullState, line: int) -> list[str]:
    """Give the texts of the curves of a line, in their order."""
    number = {each: i for i, each in enumerate(state.live("lines").tolist())}
    curves = [c for c in state.lines.curves[line] if state.curves.alive[c]]
    return [_compact({"line": number[line], **_curve(state, curve, number)}) for curve in curves]


def _curve(state: HullState, curve: int, number: Mapping[int, int]) -> dict[str, Any]:
    rows, side = state.curves.rows[curve], state.curves.side[curve]
    kind, direction = state.rows.kind[rows, side], state.rows.direction[rows, side]
    ends: Ends = state.curves.ends[curve]
    found: dict[str, Any] = {
        "points": state.spline(curve).xyz.tolist(), "of": list(_partners(state, curve, number))
    }  # fmt: skip
    knuckles = np.flatnonzero(kind == PointKind.KNUCKLE).tolist()
    tangents = np.flatnonzero(kind == PointKind.TANGENT).tolist()
    if knuckles:
        found["knuckles"] = knuckles
    if tangents:
        found["tangents"] = {str(i): direction[i].tolist() for i in tangents}
    if any(ends.kind):
        words = [EndKind(each).name.lower() for each in ends.kind]
        found["ends"] = [[w, list(v)] for w, v in zip(words, ends.vector, strict=True)]
    return found


def _partners(state: HullState, curve: int, number: Mapping[int, int]) -> Iterator[int]:
    """Give per point the number of the line that it is a crossing with, or what else it is."""
    table = state.rows
    for row in state.curves.rows[curve].tolist():
        if table.sort[row] == Sort.CROSSING:
            one, other = table.curve[row].tolist()
            yield number[state.line_of(one if other == curve else other)]
        else:
            yield _PLACED if table.sort[row] == Sort.PLACED else _ADOPTED


def tell_losses(state: HullState, book: ExportBook) -> None:
    """Note what of a hull our drawings do not hold."""
    formed, notes = len(state.definitions), [n for n in state.lines.note.data if n]
    if formed:
        what = f"{formed} definitions by form parameters: their curves come back as points"
        book.leave_out("definitions", "the hull", what, formed)
    if notes:
        book.leave_out("notes", "the lines", f"{len(notes)} notes on lines", len(notes))
    groups = [i for i in state.live("groups").tolist() if state.groups.family[i] == OWN]
    if groups:
        book.leave_out("groups", "the groups", f"{len(groups)} groups of one's own", len(groups))
    if count := len(state.rulings):
        book.leave_out("rulings", "the associations", f"{count} rulings by regions", count)
    live = state.live("rows")
    for column, word, none in (
        (state.rows.label, "labels of points", ""), (state.rows.override, "roles by hand", -1),
    ):  # fmt: skip
        count = sum(column.data[row] != none for row in live.tolist())
        if count:
            book.leave_out(word.split()[0], "the points", f"{count} {word}", count)


def pieces_of(text: str, size: int) -> list[str]:
    """Cut a text into pieces of no more than a size, for forms that limit the length of words."""
    return [text[at : at + size] for at in range(0, len(text), size)]


# --------------------------------------------------------------------------------------
# Reading.


@attrs.frozen(eq=False)
class TextedCurve:
    """A spline of a file, m, and our text of it."""

    text: str
    spline: SplineCurve


@attrs.frozen(eq=False)
class OwnLines:
    """The lines of a file of ours; `fault` tells why they are not those that were written.

    Features stand by kind and name: the points tell the rest. `unit` is that of the splines.
    """

    sources: tuple[LineSource, ...] = ()
    particulars: Particulars | None = None
    tolerances: Tolerances = attrs.field(factory=Tolerances)
    associations: tuple[Association, ...] = ()
    features: tuple[tuple[str, str], ...] = ()
    fault: str = ""
    unit: str = ""


def own_lines(text: str, curves: Sequence[TextedCurve], others: Sequence[str]) -> OwnLines:
    """Put the lines of a file together again.

    Parameters
    ----------
    text : str
        The text of the hull.
    curves : sequence of TextedCurve
        Curves of the file that have a text.
    others : sequence of str
        Names or places of curves that have none.
    """
    try:
        record = _loaded(text)
        if record["assoc-hull lines"] != _VERSION:
            return OwnLines(fault=f"its texts are of version {record['assoc-hull lines']!r:.20}")
        fault = _count_fault(len(curves), int(record["curves"]), others)
        if fault:
            return OwnLines(fault=fault)
        sources = [_source(record, each) for each in curves]
        fault = _shape_fault(sources, curves)
        if fault:
            return OwnLines(fault=fault)
        return OwnLines(
            tuple(sources), Particulars(**record["particulars"]),
            Tolerances(**record["tolerances"]),
            tuple(Association(*each) for each in record["associations"]),
            tuple((str(kind), str(name)) for kind, name in record["features"]),
        )  # fmt: skip
    except BadInputError as error:
        return OwnLines(fault=f"{error.what}, {error.where}")
    except (KeyError, IndexError, TypeError, ValueError, RecursionError, AssocHullError) as error:
        return OwnLines(fault=f"its texts cannot be read ({type(error).__name__})")


def _loaded(text: str) -> dict[str, Any]:
    found = json.loads(text, object_pairs_hook=once)
    if not isinstance(found, dict):
        raise TypeError
    return found


def _count_fault(count: int, wanted: int, others: Sequence[str]) -> str:
    """Say that curves are missing, or came in from elsewhere."""
    if others:
        return f"{len(others)} curves were added or lost their texts, as {others[0]}"
    return "" if count == wanted else f"it has {count} curves of the {wanted} that were written"


def _source(record: Mapping[str, Any], curve: TextedCurve) -> LineSource:
    """Make the line of a curve: its points are where the knots are."""
    told = _loaded(curve.text)
    line = record["lines"][_index(told["line"])]
    origin = [_origin(record["lines"], each) for each in told["of"]]
    points = np.array(told["points"], np.float64)
    _require_knots(curve.spline, line["name"], len(points))
    plane = None
    if "plane" in line:
        plane = np.array(line["plane"][:3], np.float64), float(line["plane"][3])
    kind, direction = np.zeros(len(points), np.int8), np.zeros((len(points), 3))
    for each in told.get("knuckles", ()):
        kind[_index(each)] = PointKind.KNUCKLE
    for each, along in told.get("tangents", {}).items():
        kind[_index(int(each))], direction[int(each)] = PointKind.TANGENT, along
    boundary = BoundaryKind[line["boundary"].upper()] if "boundary" in line else None
    return LineSource.make(
        line["group"], line["name"], points, family=record["groups"][line["group"]], plane=plane,
        boundary=boundary, kind=kind.tolist(), direction=direction, ends=_ends(told),
        tolerance=_NEAR, origin=origin,
    )  # fmt: skip


def _index(value: object) -> int:
    if type(value) is not int or value < 0:
        raise ValueError(value)
    return value


def _origin(lines: Sequence[Mapping[str, Any]], number: object) -> Origin:
    if number in _KNOWN:
        return _KNOWN[number]
    other = lines[_index(number)]
    return str(other["group"]), str(other["name"])


def _ends(told: Mapping[str, Any]) -> Ends | None:
    if "ends" not in told:
        return None
    (one, begin), (other, end) = told["ends"]
    kinds = EndKind[one.upper()], EndKind[other.upper()]
    return Ends((int(kinds[0]), int(kinds[1])), (tuple(begin), tuple(end)))


def _require_knots(spline: SplineCurve, name: str, count: int) -> None:
    """Check that a spline has a knot at every point."""
    if spline.degree != 3 or spline.weights is not None:
        raise BadInputError("this is no cubic B-spline any more", f"in {name}", _AGAIN)
    knots = np.unique(spline.knots)
    if len(knots) != count:
        what = f"there are {len(knots)} knots where {count} were written"
        raise BadInputError(what, f"in {name}", _AGAIN)


def _shape_fault(sources: Sequence[LineSource], curves: Sequence[TextedCurve]) -> str:
    """Say which spline is not the one through its points; empty if all are."""
    batch = loft(line_curve_data(sources))
    for number, (source, curve) in enumerate(zip(sources, curves, strict=True)):
        away = _apart(batch.curve(number), curve.spline)
        if not away <= EXACT:
            return f"{source.name} is {1e3 * away:.3g} mm off the curve through its points"
    return ""


def _apart(lofted: SplineBatch, spline: SplineCurve) -> float:
    """Give how far two cubic splines lie apart at the ends and thirds of each span, m."""
    worst = 0.0
    one, other = lofted.knot, np.unique(spline.knots)
    for part in (0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0):
        here, there = (t[:-1] + part * (t[1:] - t[:-1]) for t in (one, other))
        step = evaluate(lofted, np.zeros(len(here), np.int64), here) - spline.at(there)
        worst = max(worst, float(np.abs(step).max()))
    return worst
