"""From a definition to the tables of a hull, every reference checked; nothing is computed.

`make_tables` takes a definition whose form `schema` has checked. Row numbers follow the canonical
order, by key. A key that leads nowhere, a point that defines a curve twice, an intersection that is
no crossing: each is refused with its name. What is derived (splines, places of intersections) is
put in later, by `restore`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from enum import IntEnum
from itertools import pairwise
from typing import Any

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import EndKind, IntArray, PointKind
from assoc_hull.graph.journal import Journal
from assoc_hull.graph.table import ValueColumn
from assoc_hull.model.attachments import ATTACHMENTS, AttachmentKind, attachments_in_order
from assoc_hull.model.births import Births
from assoc_hull.model.definition.records import code_words
from assoc_hull.model.features import Feature
from assoc_hull.model.form_definition import GENERATED, ON_FLATS, FormDefinition, GeneratedCurve
from assoc_hull.model.index import build_index
from assoc_hull.model.kinds import OWN, BoundaryKind, Role, Sort, State
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.tables import (
    Association,
    CurveIntersections,
    Curves,
    Ends,
    Groups,
    HullState,
    Lines,
    Particulars,
    Rows,
    Ruling,
)
from assoc_hull.tolerance import Tolerances

__all__ = [
    "ObjectNumbers",
    "add_rows",
    "check_meetings",
    "computed_points",
    "contradiction",
    "make_tables",
    "meet_order",
    "put_defining",
    "put_features",
    "put_forms",
    "put_meetings",
    "put_places",
    "put_points",
]


def contradiction(what: str, where: str) -> BadInputError:
    """Give the error for a definition that contradicts itself."""
    return BadInputError(what, where, "take the file from where it was written, or write it anew")


@attrs.frozen
class ObjectNumbers:
    """Numbers of groups, lines, curves and points, by name or key."""

    groups: dict[str, int]
    lines: dict[str, int]
    curves: dict[str, int]
    points: dict[str, int]

    def find(self, kind: str, key: str, where: str) -> int:
        """Give the number of an object that is named somewhere.

        Raises
        ------
        BadInputError
            If there is none.
        """
        table: dict[str, int] = getattr(self, kind)
        if key not in table:
            raise contradiction(f"there is no {kind[:-1]} {key!r}", f"named at {where!r}")
        return table[key]


def add_rows(
    table: Groups | Lines | Curves | Rows,
    journal: Journal,
    count: int,
    **columns: Sequence[object],
) -> IntArray:
    """Add live rows to a table, column by column; lists for columns of objects."""
    rows = journal.grow(table, count)
    numbers = rows.tolist()
    for name, values in columns.items():
        column = table.columns[name]
        if isinstance(column, ValueColumn):
            journal.set(column, numbers, values)
        elif count:
            journal.put(column, rows, np.array(values))
    if count:
        journal.put(table.alive, rows, True)
    return rows


# --------------------------------------------------------------------------------------
# Features.


def put_features(
    state: HullState, journal: Journal, records: Iterable[Mapping[str, Any]], keys: ObjectNumbers
) -> None:
    """Put the features of a definition into the tables.

    Raises
    ------
    BadInputError
        A line or point that is not there, a key that stands twice, or parameters that
        do not fit the kind.
    """
    features = [_feature(record, keys) for record in records]
    there = set[str]()
    for each in features:
        if each.key in there:
            raise contradiction(f"the key {each.key!r} stands there twice", "in the features")
        there.add(each.key)
    Maker(state, journal).features(features)


def _feature(record: Mapping[str, Any], keys: ObjectNumbers) -> Feature:
    where = f"the feature {record['key']}"
    points = [keys.find("points", key, where) for key in record["points"]]
    for key in record["lines"]:
        keys.find("lines", key, where)
    try:
        return Feature(**{**record, "points": points})
    except BadInputError as error:
        raise contradiction(error.what, error.where) from error


# --------------------------------------------------------------------------------------
# Form definitions and generated curves.

Record = Mapping[str, Any]


def computed_points(definition: Record) -> frozenset[str]:
    """Name the points whose places come from form definitions."""
    return frozenset(
        key
        for record in definition.get("generated", ())
        if record.get("attached", True)
        for key in record["points"]
    )


def put_forms(state: HullState, journal: Journal, definition: Record, keys: ObjectNumbers) -> None:
    """Put form definitions and generated curves into tables that hold curves and points.

    Raises
    ------
    BadInputError
        A curve or point that is not there, a use or curve that stands twice, values that
        do not fit the kind, or points that do not define their curve in this order.
    """
    forms = [_form(record) for record in definition.get("definitions", ())]
    curves = [_curve(state, record, keys) for record in definition.get("generated", ())]
    for title, found in (("use", [each.use for each in forms]),
                         ("name", [each.name for each in forms]),
                         ("curve", [each.key for each in curves])):  # fmt: skip
        twice = sorted({each for each in found if found.count(each) > 1})
        if twice:
            raise contradiction(
                f"the {title} {twice[0]!r} stands there twice", "in the definitions"
            )
    maker = Maker(state, journal)
    maker.definitions(forms)
    maker.generated(curves)


def _form(record: Record) -> FormDefinition:
    try:
        return FormDefinition(
            record["name"], record["use"], record["kind"], record["values"], record["rule"],
            record["nodes"],
        )  # fmt: skip
    except BadInputError as error:
        raise contradiction(error.what, error.where) from error


def _curve(state: HullState, record: Record, keys: ObjectNumbers) -> GeneratedCurve:
    key = record["curve"]
    where = f"at the generated curve {key!r}"
    curve = keys.find("curves", key, "the generated curves")
    if record["what"] not in GENERATED:
        raise contradiction(f"{record['what']!r} cannot be generated", where)
    rows = tuple(keys.find("points", point, key) for point in record["points"])
    marks = tuple(_mark(mark, where) for mark in record["marks"])
    pieces = record["layout"].split("+")
    beyond = [mark for mark in marks if mark[0] >= len(pieces)]
    # a line on a flat has one layout word, and a mark at each end of the flat
    if beyond and record["what"] not in ON_FLATS:
        raise contradiction(f"a mark on piece {beyond[0][0]}, of {len(pieces)}", where)
    attached = bool(record.get("attached", True))
    if len(marks) != len(rows):
        raise contradiction(f"there are {len(rows)} points and {len(marks)} marks", where)
    if attached:
        _check(state, curve, rows, where)
    return GeneratedCurve(key, curve, record["what"], record["layout"], rows, marks, attached)


def _mark(mark: Sequence[float], where: str) -> tuple[int, float]:
    """Take a mark: number of a piece, and t on it from 0 to 4."""
    piece, t = mark
    if piece != int(piece):
        raise contradiction(f"the piece {piece!r} is no whole number", where)
    return int(piece), float(t)


def _check(state: HullState, curve: int, rows: tuple[int, ...], where: str) -> None:
    """Require that the points of an attached curve define it in their order, all adopted."""
    chosen = np.array(rows, np.int64)
    defining = state.curves.rows[curve]
    if not np.array_equal(defining[np.isin(defining, chosen)], chosen):
        raise contradiction("its points do not define it in this order", where)
    if (state.rows.sort[chosen] != Sort.ADOPTED).any():
        raise contradiction("a point of it is not adopted", where)


# --------------------------------------------------------------------------------------
# Points: places, kinds, roles, riding links, and their order on curves.

_ZERO = [0.0, 0.0, 0.0]


def _codes(values: Sequence[str], codes: type[IntEnum], count: int) -> list[int]:
    """Give the codes of words, filled up with 0 to a count."""
    names = code_words(codes)
    return [*(names.index(value) for value in values), *[0] * (count - len(values))]


def put_points(
    state: HullState,
    journal: Journal,
    points: list[Record],
    keys: ObjectNumbers,
    computed: Collection[str] = (),
) -> None:
    """Add the points of a hull, with the links that follow from their roles.

    The tables hold the curves already. `points` stand in the order of their numbers; `computed`
    are the keys of those whose places come from form definitions.

    Raises
    ------
    BadInputError
        If a point lacks what a point of its sort and role has, or has more.
    """
    for point in points:
        _check_point(point, made=point["key"] in computed)
    if not points:
        return
    roles, sorts, states = code_words(Role), code_words(Sort), code_words(State)
    values = [point.get("value", _ZERO) for point in points]
    rows = add_rows(
        state.rows,
        journal,
        len(points),
        key=[point["key"] for point in points],
        label=[point.get("label", "") for point in points],
        sort=[sorts.index(point["sort"]) for point in points],
        xyz=values,
        kind=[_codes(point.get("kinds", ()), PointKind, 2) for point in points],
        direction=[_pair(point.get("directions", ())) for point in points],
        curve=[_numbers(keys, "curves", point["curves"], point["key"]) for point in points],
        override=[_role_code(point, "override", roles) for point in points],
        first_role=[_role_code(point, "first_role", roles) for point in points],
        stands_for=[point.get("stands_for", "") for point in points],
        contact=[point.get("contact", False) for point in points],
        sign=[point.get("sign", 0) for point in points],
        birth=[point.get("birth", 0) for point in points],
        limit=[point.get("limit", np.nan) for point in points],
        # As `Maker.points` has it; `_put_riding` writes those of points that ride.
        base=values,
        state=[states.index(point.get("state", states[0])) for point in points],
        faired=[point.get("faired", _ZERO) for point in points],
    )
    # The table was empty: its rows are those of `points`, in their order.
    crossing = state.rows.sort.data == Sort.CROSSING
    # Only crossings have a role: for others the first one stands in, and is not read.
    role = np.array([roles.index(point.get("role", roles[0])) for point in points])
    Maker(state, journal).roles(rows[crossing], role[crossing])
    alone = rows[~crossing]
    # A point on one curve alone always defines it, without a role that says so.
    journal.put(state.rows.reader, alone, state.rows.curve[alone])
    _put_riding(state, journal, points, keys)


def _role_code(point: Record, name: str, roles: list[str]) -> int:
    """Give the code of a role that a point may have, else -1."""
    return roles.index(point[name]) if name in point else -1


def _check_point(point: Record, *, made: bool = False) -> None:
    """Check that a point of its sort has just the parts that such a point has."""
    where, crossing = f"at the point {point['key']!r}", point["sort"] == "crossing"
    # Where two curves meet there is a crossing; any other point is of one curve alone.
    if len(point["curves"]) != (2 if crossing else 1):
        raise contradiction(
            f"a {point['sort']} point lies on {len(point['curves'])} curve(s)", where
        )
    for name in ("kinds", "directions"):
        if len(point.get(name, point["curves"])) != len(point["curves"]):
            raise contradiction(f"there are not as many {name} as curves", where)
    role = point.get("role")
    # a value is stored where nothing computes it; a failed or blocked point keeps its last one
    own = not crossing and "riding" not in point and not made
    known = role == "shared" or own or "state" in point
    wanted = {
        "role": crossing,
        "birth": crossing,
        "limit": role == "watched",
        "value": known,
    }
    for name, needed in wanted.items():
        if needed != (name in point):
            raise contradiction(f"{name!r} is {'missing' if needed else 'out of place'}", where)
    for name in ("contact", "sign", "override", "first_role"):
        if name in point and not crossing:
            raise contradiction(f"{name!r} is out of place at a {point['sort']} point", where)
    if "stands_for" in point and crossing:
        raise contradiction("a crossing stands in for none", where)
    if "riding" in point and point["sort"] != "adopted":
        raise contradiction(f"a {point['sort']} point cannot ride", where)


def _pair(vectors: Sequence[Sequence[float]]) -> list[Sequence[float]]:
    return [*vectors, *[_ZERO] * (2 - len(vectors))]


def _numbers(keys: ObjectNumbers, kind: str, names: Sequence[str | None], where: str) -> list[int]:
    """Give two numbers, -1 for none."""
    found = [-1 if name is None else keys.find(kind, name, where) for name in names]
    return [*found, *[-1] * (2 - len(found))]


def _put_riding(
    state: HullState, journal: Journal, points: list[Record], keys: ObjectNumbers
) -> None:
    """Put the links of adopted points to the neighbours with which they ride."""
    riding = [number for number, point in enumerate(points) if "riding" in point]
    if not riding:
        return
    links = [points[number]["riding"] for number in riding]
    names = [points[number]["key"] for number in riding]
    anchors = [
        _numbers(keys, "points", link["anchors"], name)
        for link, name in zip(links, names, strict=True)
    ]
    journal.put(state.rows.anchor, riding, anchors)
    journal.put(state.rows.base, riding, [link["base"] for link in links])
    journal.put(state.rows.anchor_from, riding, [link["from"] for link in links])
    journal.put(state.rows.anchor_weight, riding, [link["weight"] for link in links])


def put_defining(
    state: HullState, journal: Journal, curves: list[Record], keys: ObjectNumbers
) -> None:
    """Put the points on the curves they define, in order.

    Raises
    ------
    BadInputError
        If a curve lists other points than those whose role says that they define it.
    """
    maker = Maker(state, journal)
    owners, used = list[int](), list[int]()
    for index, curve in enumerate(curves):
        rows = [keys.find("points", key, curve["key"]) for key in curve["points"]]
        maker.define(index, rows)
        owners += [index] * len(rows)
        used += rows
    _check_links(state, np.array(used, np.int64), np.array(owners, np.int64))


def _check_links(state: HullState, rows: IntArray, curves: IntArray) -> None:
    """Compare the points that curves list with those whose roles say that they define them."""
    side, row = np.nonzero(state.rows.reader.data.T >= 0)
    by_role = sorted(zip(row.tolist(), state.rows.reader[row, side].tolist(), strict=True))
    by_list = sorted(zip(rows.tolist(), curves.tolist(), strict=True))
    if by_role == by_list:
        return
    odd = sorted(set(by_role) ^ set(by_list)) or [
        pair for pair, after in pairwise(by_list) if pair == after
    ]
    point, curve = state.rows.key[odd[0][0]], state.curves.key[odd[0][1]]
    raise contradiction(
        f"{point!r} does not define {curve!r} just once, as its role says", "in the curves"
    )


# --------------------------------------------------------------------------------------
# Intersections of curves with planes. In the tables those of a curve lie group by group, along
# each group by plane; in a definition they lie under the keys of the lines.


def meet_order(state: HullState) -> dict[int, list[int]]:
    """Give, per group, the lines its curves are cut with, in the order of `CurveIntersections`."""
    partners = build_index(state).partners
    return {
        group: [line for planes in sets for line in planes.lines.tolist()]
        for group, sets in partners.items()
    }


def put_meetings(
    state: HullState,
    journal: Journal,
    curves: list[Record],
    find: Callable[[str, str, str], int],
) -> None:
    """Put the signs and crossings of all intersections into the tables; places are nan.

    The tables hold all objects and associations already. ``meets`` of a curve gives, per key of a
    line, [sign, key of the crossing or None] each; `find` is `Keys.find`.

    Raises
    ------
    BadInputError
        If a line cuts no curves of the group, or a crossing is not one of the two lines.
    """
    order = meet_order(state)
    for number, curve in enumerate(curves):
        group = int(state.lines.group[state.line_of(number)])
        place = {line: index for index, line in enumerate(order.get(group, []))}
        parts: list[tuple[int, int, list[list[Any]]]] = []
        for key, met in curve["meets"].items():
            line = find("lines", key, curve["key"])
            if line not in place:
                raise contradiction(
                    f"the line {key!r} cuts no curves of its group", f"at {curve['key']!r}"
                )
            parts.append((place[line], line, met))
        lines = [line for _, line, met in sorted(parts) for _ in met]
        spots = [spot for _, _, met in sorted(parts) for spot in met]
        rows = [-1 if key is None else find("points", key, curve["key"]) for _, key in spots]
        journal.set(
            state.curves.meets, [number], [_unplaced(lines, [sign for sign, _ in spots], rows)]
        )
    check_meetings(state)


def _unplaced(lines: list[int], signs: list[int], rows: list[int]) -> CurveIntersections:
    count = len(lines)
    return CurveIntersections(
        np.array(lines, np.int64),
        np.array(signs, np.int8),
        np.array(rows, np.int64),
        np.full(count, np.nan),
        np.full((count, 3), np.nan),
    )


def check_meetings(state: HullState) -> None:
    """Check that intersections and crossings of a curve and a line name one another.

    Raises
    ------
    BadInputError
        If a crossing lies elsewhere or twice, or one that is computed or watched has no
        intersection on a curve that it needs one on.
    """
    table = state.rows
    met = np.zeros((table.count, 2), bool)
    for curve in state.live("curves").tolist():
        meets: CurveIntersections = state.curves.meets[curve]
        actual = np.flatnonzero(meets.row >= 0)
        rows = meets.row[actual]
        side = (table.curve[rows, 0] != curve).astype(np.int64)
        other = table.curve[rows, 1 - side]
        fits = table.sort[rows] == Sort.CROSSING
        fits &= (table.curve[rows, side] == curve) & (other >= 0)
        fits &= state.curves.line[np.maximum(other, 0)] == meets.line[actual]
        fits &= np.bincount(rows, minlength=table.count)[rows] == 1
        if not fits.all():
            key = table.key[int(rows[~fits][0])]
            raise contradiction(
                f"{key!r} is no crossing there, or stands twice",
                f"at {state.curves.key[curve]!r}",
            )
        met[rows, side] = True
    _check_needed(state, met)


def _check_needed(state: HullState, met: np.typing.NDArray[np.bool_]) -> None:
    """Require intersections on the curves that give or watch a crossing; `met` is (rows, 2)."""
    table = state.rows
    need = np.zeros_like(met)
    crossing = table.alive.data & (table.sort.data == Sort.CROSSING)
    need[crossing & (table.role.data == Role.DRIVES_B), 0] = True
    need[crossing & (table.role.data == Role.DRIVES_A), 1] = True
    need[crossing & (table.role.data == Role.WATCHED)] = True
    for row, side in np.argwhere(need & ~met).tolist():
        curve = state.curves.key[int(table.curve[row, side])]
        raise contradiction(f"{table.key[row]!r} has no meeting on {curve!r}", "in the curves")


def put_places(
    state: HullState,
    journal: Journal,
    curve: int,
    met: Mapping[str, list[list[float]]],
) -> None:
    """Put the stored parameters and places (t, x, y, z; m) of a curve's intersections back.

    Raises
    ------
    BadInputError
        If they are not as many as the intersections, line by line.
    """
    meets: CurveIntersections = state.curves.meets[curve]
    keys = [state.lines.key[line] for line in meets.line.tolist()]
    counts = {key: len(places) for key, places in met.items()}
    if counts != {key: keys.count(key) for key in keys}:
        raise contradiction(
            f"there are places for {sum(counts.values())} meetings, and {len(keys)} meetings",
            f"at {state.curves.key[curve]!r}",
        )
    spots = np.array([spot for key in dict.fromkeys(keys) for spot in met[key]], np.float64)
    spots = spots.reshape(-1, 4)
    placed = attrs.evolve(meets, parameter=spots[:, 0].copy(), xyz=spots[:, 1:].copy())
    journal.set(state.curves.meets, [curve], [placed])
    _write_spots(state, journal, curve, placed)


def _write_spots(state: HullState, journal: Journal, curve: int, meets: CurveIntersections) -> None:
    """Store with the crossings where they lie on the curve, on its side of their rows."""
    actual = meets.row >= 0
    rows: IntArray = meets.row[actual]
    table = state.rows
    side = (table.curve[rows, 0] != curve).astype(np.int64)
    spot, at = table.spot[rows].copy(), table.parameter[rows].copy()
    spot[np.arange(len(rows)), side] = meets.xyz[actual]
    at[np.arange(len(rows)), side] = meets.parameter[actual]
    journal.put(table.spot, rows, spot)
    journal.put(table.parameter, rows, at)


# --------------------------------------------------------------------------------------
# The whole hull.

_UNIT = 1e-9
"""A unit normal is this near to 1 long."""

_STATES = code_words(State)


def make_tables(definition: Record) -> HullState:
    """Make the tables of a hull from a definition of the right form.

    Raises
    ------
    BadInputError
        If a name refers to nothing, an object stands twice, or two parts contradict.
    """
    particulars: dict[str, Any] = {
        name: value if isinstance(value, str) else float(value)
        for name, value in definition["particulars"].items()
    }
    tolerances = {name: float(value) for name, value in definition["tolerances"].items()}
    state = HullState(Particulars(**particulars), Tolerances(**tolerances))
    parts = [_sorted(definition[name]) for name in ("lines", "curves", "points")]
    groups = sorted(definition["groups"], key=lambda each: str(each["name"]))
    gone = definition["retired"]
    keys = ObjectNumbers(
        _number("group", [group["name"] for group in groups], ()),
        _number("line", [line["key"] for line in parts[0]], gone["lines"]),
        _number("curve", [curve["key"] for curve in parts[1]], gone["curves"]),
        _number("point", [point["key"] for point in parts[2]], gone["points"]),
    )
    journal = Journal()
    _put_groups(state, journal, groups, definition, keys)
    _put_lines(state, journal, parts[0], keys)
    _put_curves(state, journal, parts[1], keys)
    put_points(state, journal, parts[2], keys, computed_points(definition))
    put_defining(state, journal, parts[1], keys)
    _check_births(state)
    put_meetings(state, journal, parts[1], keys.find)
    _put_rulings(state, journal, definition.get("rulings", ()), keys)
    for kind in ATTACHMENTS:
        _put_attachments(state, journal, kind, definition.get(kind.column, ()))
    put_features(state, journal, definition.get("features", ()), keys)
    put_forms(state, journal, definition, keys)
    _retire(state, journal, gone)
    return state


def _sorted(records: Iterable[Record]) -> list[Record]:
    return sorted(records, key=lambda record: str(record["key"]))


def _number(kind: str, keys: Sequence[str], gone: Sequence[str]) -> dict[str, int]:
    """Give keys their numbers, in order; none may stand twice, or among the retired ones."""
    found = {key: number for number, key in enumerate(keys)}
    for many in (keys, gone, (*found, *gone)):
        if len(set(many)) < len(many):
            twice = next(key for key in many if list(many).count(key) > 1)
            raise contradiction(f"the {kind} {twice!r} stands there twice", "in the file")
    return found


def _put_groups(
    state: HullState,
    journal: Journal,
    groups: list[Record],
    definition: Record,
    keys: ObjectNumbers,
) -> None:
    names, families = [each["name"] for each in groups], [each["family"] for each in groups]
    members = [tuple(each.get("members", ())) for each in groups]
    for name, family, mine in zip(names, families, members, strict=True):
        if mine and family != OWN:
            raise contradiction(f"the group {name!r} of a family has members", "in the groups")
        for member in mine:
            if member not in names:
                keys.find("lines", member, f"the group {name!r}")
    add_rows(state.groups, journal, len(groups), name=names, family=families, members=members)
    links = [Association(**link) for link in definition["associations"]]
    for link in links:
        for name in (link.a, link.b):
            keys.find("groups", name, "an association")
    if len({frozenset((link.a, link.b)) for link in links}) < len(links):
        raise contradiction("two groups are associated twice", "in the associations")
    links.sort(key=lambda each: (each.a, each.b))
    births = {(a, b): count for a, b, count in definition["births"]}
    if len(births) < len(definition["births"]):
        raise contradiction("a pair of lines stands there twice", "in the births")
    journal.set(state.settings.associations, [0], [tuple(links)])
    journal.set(state.settings.births, [0], [Births.of(births)])


def _put_rulings(
    state: HullState, journal: Journal, rulings: Sequence[Record], keys: ObjectNumbers
) -> None:
    names = set(state.groups.name.data)
    for each in rulings:
        for name in (each["a"], each["b"]):
            if name not in names:
                keys.find("lines", name, "a ruling")
    if rulings:
        found = tuple(
            Ruling(**{**each, "low": tuple(each["low"]), "high": tuple(each["high"])})
            for each in rulings
        )
        journal.set(state.settings.rulings, [0], [found])


def _put_attachments(
    state: HullState, journal: Journal, kind: AttachmentKind, records: Sequence[Record]
) -> None:
    found = attachments_in_order(kind.made(**each) for each in records)
    for one, next_ in pairwise(found):
        if one.name == next_.name:
            what = f"the {kind.word} {one.name!r} stands there twice"
            raise contradiction(what, f"in the {kind.column}")
    if found:
        journal.set(kind.of(state), [0], [found])


def _put_lines(
    state: HullState, journal: Journal, lines: list[Record], keys: ObjectNumbers
) -> None:
    names = [(line["group"], line["name"]) for line in lines]
    for line, name in zip(lines, names, strict=True):
        if ("normal" in line) != ("offset" in line):
            raise contradiction(
                "a plane needs both a normal and an offset", f"at the line {line['key']!r}"
            )
        # A line in space has no normal: what stands in for it passes.
        length = math.hypot(*line.get("normal", (1.0,)))
        if abs(length - 1.0) > _UNIT:
            raise contradiction(
                f"the normal is {length:.6g} long, not 1", f"at the line {line['key']!r}"
            )
        if names.count(name) > 1:
            raise contradiction(f"two lines of {name[0]} have the name {name[1]!r}", "in the lines")
    boundary = code_words(BoundaryKind)
    add_rows(
        state.lines,
        journal,
        len(lines),
        key=[line["key"] for line in lines],
        name=[line["name"] for line in lines],
        note=[line.get("note", "") for line in lines],
        group=[keys.find("groups", line["group"], line["key"]) for line in lines],
        planar=["normal" in line for line in lines],
        normal=[line.get("normal", _ZERO) for line in lines],
        offset=[line.get("offset", np.nan) for line in lines],
        boundary=[boundary.index(line["boundary"]) if "boundary" in line else -1 for line in lines],
    )


def _put_curves(
    state: HullState, journal: Journal, curves: list[Record], keys: ObjectNumbers
) -> None:
    owner = [keys.find("lines", curve["line"], curve["key"]) for curve in curves]
    add_rows(
        state.curves,
        journal,
        len(curves),
        key=[curve["key"] for curve in curves],
        line=owner,
        ends=[_ends(curve) for curve in curves],
        state=[_STATES.index(curve["kept"]["state"]) if "kept" in curve else 0 for curve in curves],
    )
    for line in range(len(keys.lines)):
        mine = tuple(number for number, each in enumerate(owner) if each == line)
        journal.set(state.lines.curves, [line], [mine])
    failed = np.flatnonzero(state.curves.state.data == State.FAILED)
    journal.set(state.settings.failed, [0], [tuple(failed.tolist())])


def _ends(curve: Record) -> Ends:
    kinds = code_words(EndKind)
    given = [curve.get(name, {"kind": kinds[0], "vector": _ZERO}) for name in ("start", "finish")]
    first, last = (_vector(end["vector"]) for end in given)
    return Ends((kinds.index(given[0]["kind"]), kinds.index(given[1]["kind"])), (first, last))


def _vector(values: Sequence[float]) -> tuple[float, float, float]:
    x, y, z = values
    return float(x), float(y), float(z)


def _check_births(state: HullState) -> None:
    """Require that no crossing has a higher number than were ever born of its two lines."""
    table, keys, births = state.rows, state.lines.key.data, dict(state.births.items())
    for row in np.flatnonzero(table.sort.data == Sort.CROSSING).tolist():
        a, b = (keys[state.line_of(curve)] for curve in table.curve[row].tolist())
        pair = a, b
        if table.birth[row] > births.get(pair, 0):
            count = births.get(pair, 0)
            raise contradiction(f"its lines bore {count} crossings only", f"at {table.key[row]!r}")


def _retire(state: HullState, journal: Journal, gone: Record) -> None:
    """Add dead rows that hold nothing but keys, so that these never come back."""
    for table, name in ((state.lines, "lines"), (state.curves, "curves"), (state.rows, "points")):
        rows = journal.grow(table, len(gone[name]))
        journal.set(table.key, rows.tolist(), sorted(gone[name]))
    if gone["points"]:
        # `rows` are those of the last table, the points
        journal.put(state.rows.sort, rows, int(Sort.PLACED))
