"""The fingerprint of a hull, and the tree of hashes by which its file is guarded.

Every column in canonical order goes in with its name, type and shape; the bits themselves
are hashed. History, row numbers and the order of creation play no part. A hull file is guarded by
another one, of which an edit makes a part only: `assoc_hull.model.definition.fingerprint`.

The fingerprint by which a hull file is guarded: a tree of hashes, curve, line, group, hull.

It covers what `assoc_hull.model.definition.fingerprint` covers, and is another number. A node is
the SHA-256 of its own content and of the nodes below it, in the order of their keys; objects name
one another by key, so that row numbers and the order of work never show. `HashTree.note` takes a
change and marks what it touched; only those branches are made anew when the root is asked for.
A point hangs below the curve on its first side.

Examples
--------
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.model.definition.fingerprint import fingerprint
>>> fingerprint(wigley()) == fingerprint(wigley())
True
>>> from assoc_hull.model.definition.fingerprint import HashTree
>>> HashTree(wigley()).root() == HashTree(wigley()).root()
True
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.graph.derived import same_objects
from assoc_hull.graph.journal import distinct
from assoc_hull.model.attachments import attachment_records
from assoc_hull.model.change import TableChange
from assoc_hull.model.definition.canonical_columns import (
    CanonicalOrder,
    Column,
    canonical_order,
    curve_columns,
    feature_columns,
    line_columns,
    meet_columns,
    point_columns,
    retired_keys,
    spline_columns,
    value_columns,
)
from assoc_hull.model.definition.records import (
    association_records,
    birth_records,
    definition_columns,
    definition_records,
    generated_columns,
    generated_records,
    plain_fields,
    ruling_records,
)
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.tables import CurveIntersections, HullState

__all__ = ["HashTree", "column_bytes", "fingerprint", "fingerprint_parts", "is_root", "root_of"]


def fingerprint(state: HullState) -> str:
    """Give the SHA-256 of definition and published values, 64 hexadecimal digits.

    Every column in canonical order, with its name, type and shape; floats as 8 bytes IEEE
    754, little end first, whole numbers as 8 bytes likewise, texts as JSON. The bits
    themselves are hashed: -0.0 and 0.0 are two numbers here, as they are to the update.
    Revisions, history, causes, times, row numbers and the order of creation play no part.
    """
    digest = hashlib.sha256()
    for _, part in fingerprint_parts(state, canonical_order(state)):
        digest.update(part)
    return digest.hexdigest()


def fingerprint_parts(state: HullState, order: CanonicalOrder) -> Iterator[tuple[str, bytes]]:
    """Give what a fingerprint is taken of, part by part, each column with its name."""
    for each in (state.particulars, state.tolerances):
        fields = plain_fields(each)
        texts = [value for value in fields.values() if isinstance(value, str)]
        numbers = [value for value in fields.values() if not isinstance(value, str)]
        head = column_bytes(",".join(fields), texts)
        yield "", head + column_bytes("", np.array(numbers, np.float64))
    yield "", json.dumps(_settings(state, order)).encode()
    tables = {
        "line": line_columns(state, order),
        "curve": curve_columns(state, order),
        "meet": meet_columns(state, order),
        "point": point_columns(state, order),
        "value": value_columns(state, order),
        "spline": spline_columns(state, order),
    }
    if state.features:
        tables["feature"] = feature_columns(state, order)
    if state.definitions:
        tables["definition"] = definition_columns(state)
    if state.generated:
        tables["generated"] = generated_columns(state, order)
    for title, columns in tables.items():
        for column, values in columns.items():
            name = f"{title}.{column}"
            yield name, column_bytes(name, values)


def _settings(state: HullState, order: CanonicalOrder) -> list[object]:
    """Give the parts of a definition that hold texts and counts only."""
    names = [(state.groups.name[i], state.groups.family[i]) for i in order.groups.tolist()]
    members = [state.groups.members[i] for i in order.groups.tolist()]
    found = [names, association_records(state), birth_records(state), retired_keys(state)]
    found += [ruling_records(state)] if state.rulings else []
    found += [{kind: held} for kind, held in attachment_records(state).items() if held]
    return [*found, *([{"members": members}] if any(members) else ())]


def column_bytes(name: str, column: Column) -> bytes:
    """Serialise a column so that no two differ in meaning and agree in bytes."""
    if isinstance(column, list):
        return f"{name}:text:".encode() + json.dumps(column).encode()
    kind = "<f8" if column.dtype.kind == "f" else "<i8"
    return f"{name}:{kind}{column.shape}:".encode() + column.astype(kind).tobytes()


_PREFIX = "tree-"

_KEYS = ("rows.key", "curves.key", "lines.key", "groups.name")


def is_root(text: str) -> bool:
    """Tell whether a text is a root, and no fingerprint."""
    return text.startswith(_PREFIX)


def root_of(state: HullState) -> str:
    """Give the root of the tree of a hull, made from nothing."""
    return HashTree(state).root()


@attrs.frozen(eq=False)
class _Fixed:
    """What an edit of shape leaves alone of a curve.

    Attributes
    ----------
    digest : bytes
        Of keys, codes, directions and limits.
    rows : (k,) int
        Its points, those that lie on it with their first side, by key.
    riding : (r,) int
        Those of them that ride on others.
    watched : (k,) bool
        Which of them have a gap.
    turn : (m,) int
        Its meetings by key of the line, then along the curve.
    """

    digest: bytes
    rows: IntArray
    riding: IntArray
    watched: NDArray[np.bool_]
    turn: IntArray


class HashTree:
    """The tree of one hull.

    Parameters
    ----------
    state : HullState
        The tables; each change of them must be told by `note`, after it has been made.
    """

    def __init__(self, state: HullState) -> None:
        self.state = state
        self._forget()

    def _forget(self) -> None:
        self._leaf, self._fixed = dict[int, bytes](), dict[int, _Fixed]()
        self._stale = set[int]()
        self._last: tuple[list[_Fixed], list[NDArray[Any]]] = [], []
        self._laid = False
        self._owner: IntArray = np.zeros(0, np.int64)

    # ----------------------------------------------------------------------------------
    # What a change touches.

    def note(self, change: TableChange) -> None:
        """Mark what a change touched, forward or backward: both touch the same."""
        if not self._leaf or _renames(change):
            self._forget()
            return
        rows, table = change.touched("rows"), self.state.rows
        owners = {*self._owner[rows[rows < len(self._owner)]].tolist()}
        curves = {*change.curves.tolist()}
        if change.keeps_structure and {"featured.feature"}.issuperset(change.objects):
            self._stale |= owners | curves
            if change.objects:
                self._features = self._feature_part()
            return
        owners |= {*table.curve.data[rows[rows < table.count], 0].tolist()}
        for curve in owners | curves | {*change.touched("curves").tolist()}:
            self._fixed.pop(curve, None)
            self._leaf.pop(curve, None)
        self._laid = False

    # ----------------------------------------------------------------------------------
    # The nodes.

    def root(self) -> str:
        """Give the root for the tables as they are: a word, then 64 hexadecimal digits."""
        if not self._laid:
            self._lay_out()
        self._make_leaves(sorted(self._stale))
        lines = {self._line_of[curve] for curve in self._stale}
        for line in lines:
            self._make_line(line)
        for group in {self._group_of[line] for line in lines}:
            self._make_group(group)
        self._stale.clear()
        whole = b"".join(self._group[group] for group in self._groups)
        return _PREFIX + hashlib.sha256(self._rest + self._features + whole).hexdigest()

    def _lay_out(self) -> None:
        """Find what hangs below what, and make all but the leaves that are known."""
        state = self.state
        owner = np.where(state.rows.alive.data, state.rows.curve.data[:, 0], -2)
        self._owner = owner
        self._by_owner = np.argsort(owner, kind="stable")
        self._first = np.searchsorted(owner[self._by_owner], np.arange(-1, state.curves.count + 1))
        # What is dead and has something alive below it is in the tree, too: nothing is left out.
        curves = _with({*state.live("curves").tolist()}, distinct(owner[owner > -2]).tolist())
        line = state.curves.line.data
        self._line_of = {c: int(line[c]) if c >= 0 else -1 for c in curves}
        lines = _with({*state.live("lines").tolist()}, self._line_of.values())
        group = state.lines.group.data
        self._group_of = {i: int(group[i]) if i >= 0 else -1 for i in lines}
        groups = _with({*state.live("groups").tolist()}, self._group_of.values())
        for known in (self._leaf, self._fixed):
            for curve in known.keys() - curves:
                del known[curve]
        self._stale = (self._stale & curves) | (curves - self._leaf.keys())
        self._make_leaves(sorted(self._stale))
        self._curves = _below(self._line_of, lines, state.curves.key.data)
        self._lines = _below(self._group_of, groups, state.lines.key.data)
        self._groups = _sorted_by(groups, state.groups.name.data)
        self._line, self._group = dict[int, bytes](), dict[int, bytes]()
        self._line_head = {i: self._line_part(i) for i in lines}
        self._group_head = {i: self._group_part(i) for i in groups}
        for i in lines:
            self._make_line(i)
        for i in groups:
            self._make_group(i)
        self._stale.clear()
        self._rest, self._features = self._rest_part(), self._feature_part()
        self._laid = True

    def _make_line(self, line: int) -> None:
        below = b"".join(self._leaf[curve] for curve in self._curves[line])
        self._line[line] = hashlib.sha256(self._line_head[line] + below).digest()

    def _make_group(self, group: int) -> None:
        below = b"".join(self._line[line] for line in self._lines[group])
        self._group[group] = hashlib.sha256(self._group_head[group] + below).digest()

    def _make_leaves(self, curves: Sequence[int]) -> None:
        """Hash the numbers of curves, gathered for all of them at once."""
        if not curves:
            return
        fresh = [curve for curve in curves if curve not in self._fixed]
        count = sum(int(self._first[c + 2] - self._first[c + 1]) for c in fresh)
        key = self.state.rows.key.data.for_looks(3 * count)
        for curve in fresh:
            self._fixed[curve] = self._fix(curve, key)
        fixed = [self._fixed[curve] for curve in curves]
        table, met = self.state.rows, [self._meets(curve) for curve in curves]
        splines = [self._spline(curve) for curve in curves]
        if not same_objects(self._last[0], fixed):  # a gesture goes on with the same curves
            joined = [
                np.concatenate([getattr(each, name) for each in fixed])
                for name in ("rows", "riding", "watched", "turn")
            ]
            counts = [len(each.turn) for each in fixed]
            joined[3] += np.repeat(np.cumsum(counts) - counts, counts)
            self._last = fixed, joined
        rows, riding, watched, turn = self._last[1]
        faired = table.faired[rows]
        points, rides = np.empty((len(rows), 4)), np.empty((len(riding), 10))
        points[:, :3], points[:, 3] = table.xyz[rows], np.where(watched, table.gap[rows], 0.0)
        rides[:, :3], rides[:, 3] = table.base[riding], table.anchor_weight[riding]
        rides[:, 4:] = table.anchor_from[riding].reshape(-1, 6)
        places = np.empty((len(turn), 4))
        places[:, 0] = np.concatenate([each.parameter for each in met])[turn]
        places[:, 1:] = np.concatenate([each.xyz for each in met])[turn]
        knots = np.empty((sum(len(each.knot) for each in splines), 10))
        knots[:, 0] = np.concatenate([each.knot for each in splines])
        for column, name in ((1, "xyz"), (4, "leave"), (7, "arrive")):
            knots[:, column : column + 3] = np.concatenate([getattr(x, name) for x in splines])
        blocks = [
            _Block(points, [len(each.rows) for each in fixed]),
            _Block(rides, [len(each.riding) for each in fixed]),
            _Block(places, [len(each.turn) for each in fixed]),
            _Block(knots, [len(each.knot) for each in splines]),
        ]
        if faired.any():
            blocks.append(_Block(faired, [len(each.rows) for each in fixed], told=False))
        for curve, *parts in zip(curves, fixed, *map(_Block.parts, blocks), strict=True):
            head: _Fixed = parts[0]
            self._leaf[curve] = hashlib.sha256(b"".join([head.digest, *parts[1:]])).digest()

    def _spline(self, curve: int) -> SplineBatch:
        dead = curve < 0 or not self.state.curves.alive[curve]
        return (None if dead else self.state.curves.spline[curve]) or _NO_SPLINE

    def _meets(self, curve: int) -> CurveIntersections:
        dead = curve < 0 or not self.state.curves.alive[curve]
        return _NO_MEETS if dead else self.state.curves.meets[curve]

    # ----------------------------------------------------------------------------------
    # Content.

    def _fix(self, curve: int, key: Sequence[str]) -> _Fixed:
        """Hash what an edit of shape leaves alone of a curve and of the points below it."""
        state = self.state
        table, curves, lines = state.rows, state.curves, state.lines
        label = table.label.data
        mine = self._by_owner[self._first[curve + 1] : self._first[curve + 2]].tolist()
        rows = np.array(sorted(mine, key=key.__getitem__), np.int64)
        met = self._meets(curve)
        line_keys = [lines.key[line] for line in met.line.tolist()]
        turn = np.array(sorted(range(len(line_keys)), key=line_keys.__getitem__), np.int64)
        crossing = table.sort[rows] == Sort.CROSSING
        watched = crossing & (table.role[rows] == Role.WATCHED)
        anchor = table.anchor[rows]
        riding = np.asarray((anchor >= 0).any(axis=1))
        texts: list[object] = [
            [key[row] for row in rows.tolist()],
            [label[row] for row in rows.tolist()],
            [_named(curves.key.data, other) for other in table.curve[rows, 1].tolist()],
            [[_named(key, each) for each in pair] for pair in anchor[riding].tolist()],
            [line_keys[i] for i in turn.tolist()],
            [_named(key, row) for row in met.row[turn].tolist()],
        ]
        numbers = [
            table.sort[rows], table.kind[rows], np.where(crossing, table.role[rows], -1),
            table.override[rows], table.contact[rows], table.sign[rows], table.birth[rows],
            table.state[rows], riding, met.sign[turn],
        ]  # fmt: skip
        reals = [table.direction[rows], np.where(watched, table.limit[rows], 0.0)]
        first, stands_for = table.first_role[rows], table.stands_for.data
        if (first >= 0).any():
            numbers.append(first)
        if stood := [stands_for[row] for row in rows.tolist() if stands_for[row]]:
            texts.append(stood)
        if curve >= 0:
            ends = curves.ends[curve]
            texts.append([curves.key[curve], bool(curves.alive[curve])])
            texts.append([key[row] for row in curves.rows[curve].tolist()])
            numbers += [curves.side[curve], np.array([curves.state[curve], *ends.kind])]
            reals.append(np.array(ends.vector))
        digest = hashlib.sha256(json.dumps(texts).encode())
        for each in numbers:
            digest.update(np.asarray(each, "<i8").tobytes())
        for each in reals:
            digest.update(_bytes(np.asarray(each)))
        return _Fixed(digest.digest(), rows, rows[riding], watched, turn)

    def _line_part(self, line: int) -> bytes:
        """Hash what a line holds besides its curves."""
        table, keys = self.state.lines, self.state.curves.key.data
        below = [_named(keys, curve) for curve in self._curves[line]]
        if line < 0:
            return _hash([below])
        planar = bool(table.planar[line])
        told = [
            table.key[line], table.name[line], table.note[line], bool(table.alive[line]), planar,
            int(table.boundary[line]), below,
            [_named(keys, curve) for curve in table.curves[line]],
        ]  # fmt: skip
        plane = [*table.normal[line].tolist(), float(table.offset[line])] if planar else []
        return _hash(told, np.array(plane))

    def _group_part(self, group: int) -> bytes:
        """Hash what a group holds besides its lines."""
        table, keys = self.state.groups, self.state.lines.key.data
        below = [_named(keys, line) for line in self._lines[group]]
        if group < 0:
            return _hash([below])
        told = [table.name[group], table.family[group], bool(table.alive[group]), below]
        return _hash([*told, *([table.members[group]] if table.members[group] else ())])

    def _rest_part(self) -> bytes:
        """Hash what hangs below no line: particulars, associations, births, definitions."""
        state = self.state
        fields = [plain_fields(each) for each in (state.particulars, state.tolerances)]
        reals = [v for each in fields for v in each.values() if not isinstance(v, str)]
        words = [[n, v if isinstance(v, str) else ""] for each in fields for n, v in each.items()]
        told = [
            words, list(association_records(state)), list(birth_records(state)),
            retired_keys(state), list(definition_records(state)), list(generated_records(state)),
            [_named(self.state.groups.name.data, group) for group in self._groups],
            *([ruling_records(state)] if state.rulings else ()),
            *({kind: held} for kind, held in attachment_records(state).items() if held),
        ]  # fmt: skip
        return _hash(told, np.array(reals, np.float64))

    def _feature_part(self) -> bytes:
        """Hash the features; their numbers as the shortest decimals that give the same bits."""
        key = self.state.rows.key.data
        told = [
            {**attrs.asdict(each), "points": [key[row] for row in each.points]}
            for each in self.state.features
        ]
        return _hash(told)


_NO_MEETS = CurveIntersections.none()
_NONE = np.zeros((0, 3))
_NO_SPLINE = SplineBatch(np.zeros(2, np.int64), np.zeros(0), _NONE, _NONE, _NONE)


class _Block:
    """Numbers of several curves, one behind the other, and how many rows each has."""

    def __init__(self, values: FloatArray, counts: Sequence[int], *, told: bool = True) -> None:
        self._data, self._size = _bytes(values), 8 * values.shape[1]
        self._counts, self._told = counts, told

    def parts(self) -> Iterator[bytes]:
        """Give the bytes of each curve, headed by how many there are.

        Nothing at all of one that has but zeros, where these need not be `told`.
        """
        first = 0
        for count in self._counts:
            last = first + count * self._size
            part = self._data[first:last]
            if self._told or part.count(0) < len(part):
                yield count.to_bytes(4, "little") + part
            else:
                yield b""
            first = last


def _renames(change: TableChange) -> bool:
    """Tell whether an object got another key, which none ever should."""
    return any(
        was and was != now
        for name in _KEYS
        if name in change.objects
        for was, now in zip(*change.objects[name][1:], strict=True)
    )


def _with(numbers: set[int], more: Iterable[int]) -> set[int]:
    return numbers.union(more)


def _below(
    above: dict[int, int], numbers: Iterable[int], keys: Sequence[str]
) -> dict[int, list[int]]:
    """Give what hangs below each of some numbers, by key."""
    found: dict[int, list[int]] = {number: [] for number in numbers}
    for each in _sorted_by(above, keys):
        found[above[each]].append(each)
    return found


def _sorted_by(numbers: Iterable[int], keys: Sequence[str]) -> list[int]:
    return sorted(numbers, key=lambda number: (number < 0, keys[number] if number >= 0 else ""))


def _named(keys: Sequence[str], number: int) -> str | None:
    return keys[number] if number >= 0 else None


def _bytes(values: FloatArray) -> bytes:
    return values.astype("<f8", copy=False).tobytes()


def _hash(told: object, reals: FloatArray | None = None) -> bytes:
    digest = hashlib.sha256(json.dumps(told).encode())
    if reals is not None:
        digest.update(_bytes(reals))
    return digest.digest()
