"""Making and unmaking objects: every write of structure goes through here.

Identities come from content, never from a counter: a line's key from its group and first
position (or name), a crossing's from the keys of its lines, its sign and the number of its
birth for that pair, a placed or adopted point's from its curve and first place.
"""

from __future__ import annotations

from collections.abc import Container, Iterable, Sequence
from typing import Protocol, TypeVar

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import plain_name
from assoc_hull.errors import NameTakenError, UnknownNameError
from assoc_hull.geometry.curves import FloatArray, IntArray, PointKind, freeze
from assoc_hull.graph.journal import Journal
from assoc_hull.graph.table import ValueColumn
from assoc_hull.model.attachments import attachment_named
from assoc_hull.model.births import Pair
from assoc_hull.model.features import Feature
from assoc_hull.model.form_definition import FormDefinition, GeneratedCurve
from assoc_hull.model.keys import crossing_key
from assoc_hull.model.kinds import OWN, Role, Sort
from assoc_hull.model.tables import Association, Ends, Featured, Formed, HullState, Produced

__all__ = ["CrossingSpec", "Maker", "PointSpec"]

_FEW = 8
"""So many new keys are looked for among those that there are; for more, these are made texts."""


class _HasKey(Protocol):
    @property
    def key(self) -> str: ...


K = TypeVar("K", bound=_HasKey)


@attrs.frozen(eq=False)
class CrossingSpec:
    """A crossing to be made.

    Attributes
    ----------
    a, b : int
        Its curves; `a` is the one of lower rank.
    xyz : (3,), m
        Its place.
    role : Role
        What it defines.
    sign : int
        Sense in which a passes the plane of b (or b that of a at a contact); 0 if neither.
    spots : (2, 3), m, or None
        Where it lies on a and on b; both at `xyz` if None.
    contact : bool
        Whether b ends, turns or leaves a flat at the boundary curve a.
    kind_b : PointKind
        How b passes.
    direction_b : (3,)
        Given direction of b at a tangent point.
    """

    a: int
    b: int
    xyz: ArrayLike
    role: Role
    sign: int = 0
    spots: tuple[ArrayLike, ArrayLike] | None = None
    contact: bool = False
    kind_b: int = PointKind.SMOOTH
    direction_b: ArrayLike = (0.0, 0.0, 0.0)


@attrs.frozen(eq=False)
class PointSpec:
    """A placed or adopted point to be made on one curve."""

    curve: int
    xyz: ArrayLike
    sort: Sort
    kind: int = PointKind.SMOOTH
    direction: ArrayLike = (0.0, 0.0, 0.0)


def _stack(values: Sequence[object]) -> FloatArray:
    """Make one array of places or directions."""
    return np.array(values, np.float64)


@attrs.frozen(eq=False)
class Maker:
    """Writes structure into the tables of a hull, through a journal."""

    state: HullState
    journal: Journal

    def group(self, name: str, family: str) -> int:
        """Add a group of lines."""
        if name in self.state.groups.name.data:
            raise NameTakenError("group", name)
        number = int(self.journal.grow(self.state.groups, 1)[0])
        self.journal.set(self.state.groups.name, [number], [name])
        self.journal.set(self.state.groups.family, [number], [family])
        self.journal.put(self.state.groups.alive, [number], [True])
        return number

    def own_group(self, name: str, members: tuple[str, ...]) -> int:
        """Add a group of a designer's own, of lines by key and groups by name."""
        number = self.group(name, OWN)
        self.journal.set(self.state.groups.members, [number], [members])
        return number

    def associate(self, link: Association) -> None:
        """Declare an association; one between the same groups is replaced."""
        for name in (link.a, link.b):
            if name not in self.state.groups.name.data:
                raise UnknownNameError("group", name, tuple(self.state.groups.name.data))
        kept = tuple(old for old in self.state.associations if {old.a, old.b} != {link.a, link.b})
        links = tuple(sorted((*kept, link), key=lambda each: (each.a, each.b)))
        self.journal.set(self.state.settings.associations, [0], [links])

    def line(
        self,
        group: int,
        name: str,
        plane: tuple[ArrayLike, float] | None,
        boundary: int = -1,
        key: str | None = None,
    ) -> int:
        """Add a line without curves."""
        table, title = self.state.lines, self.state.groups.name[group]
        taken = [table.name[i] for i in self.state.live("lines") if table.group[i] == group]
        if name in taken:
            raise NameTakenError(f"line of {title}", name)
        if beside := attachment_named(self.state, name):
            raise NameTakenError(beside[0].word, name)
        groups, plain = self.state.groups, plain_name(name)
        for each in self.state.live("groups").tolist():
            if groups.family[each] == OWN and plain_name(groups.name[each]) == plain:
                raise NameTakenError("group", name)
        number = int(self.journal.grow(table, 1)[0])
        place = name if plane is None or boundary >= 0 else f"{plane[1]:.6f}"
        self.journal.set(
            table.key, [number], [self._fresh(key or f"{title}:{place}", table.key.data)]
        )
        self.journal.set(table.name, [number], [name])
        self.journal.put(table.group, [number], [group])
        self.journal.put(table.boundary, [number], [boundary])
        self.journal.put(table.alive, [number], [True])
        if plane is not None:
            self.journal.put(table.planar, [number], [True])
            self.journal.put(table.normal, [number], _stack([plane[0]]))
            self.journal.put(table.offset, [number], [plane[1]])
        return number

    @staticmethod
    def _fresh(wish: str, *taken: Container[str]) -> str:
        """Give a key that no object has or had."""
        key, number = wish, 1
        while any(key in each for each in taken):
            number += 1
            key = f"{wish}~{number}"
        return key

    def curve(self, line: int, ends: Ends | None = None) -> int:
        """Add a curve to a line; its points come by `define`."""
        table = self.state.curves
        number = int(self.journal.grow(table, 1)[0])
        before = self.state.lines.curves[line]
        key = self._fresh(f"{self.state.lines.key[line]}/{len(before) + 1}", table.key.data)
        self.journal.set(table.key, [number], [key])
        self.journal.put(table.line, [number], [line])
        self.journal.put(table.alive, [number], [True])
        self.journal.set(table.ends, [number], [ends or Ends()])
        self.journal.set(self.state.lines.curves, [line], [(*before, number)])
        return number

    def crossings(self, specs: Sequence[CrossingSpec]) -> IntArray:
        """Add crossings; births are numbered in the order given, per pair of lines."""
        rows = self.journal.grow(self.state.rows, len(specs))
        if not len(specs):
            return rows
        table, births, fresh = self.state.rows, self.state.births, dict[Pair, int]()
        keys: list[str] = []
        numbers: list[int] = []
        for spec in specs:
            pair = self._pair(spec)
            fresh[pair] = (fresh.get(pair) or births.get(pair, 0)) + 1
            numbers.append(fresh[pair])
            keys.append(crossing_key(*pair, spec.sign, fresh[pair]))
        self.journal.set(self.state.settings.births, [0], [births.counted(fresh)])
        self.journal.set(table.key, rows.tolist(), keys)
        put = self.journal.put
        put(table.birth, rows, numbers)
        put(table.alive, rows, True)
        put(table.sort, rows, int(Sort.CROSSING))
        put(table.xyz, rows, _stack([spec.xyz for spec in specs]))
        put(table.spot, rows, _stack([spec.spots or (spec.xyz, spec.xyz) for spec in specs]))
        put(table.curve, rows, [(spec.a, spec.b) for spec in specs])
        put(table.sign, rows, [spec.sign for spec in specs])
        put(table.contact, rows, [spec.contact for spec in specs])
        put(table.kind, rows, [(int(PointKind.SMOOTH), spec.kind_b) for spec in specs])
        put(table.direction, rows, _stack([((0.0, 0.0, 0.0), spec.direction_b) for spec in specs]))
        self.roles(rows, np.array([int(spec.role) for spec in specs]))
        return rows

    def replace(self, row: int, spec: CrossingSpec) -> None:
        """Give a crossing that is there already a new place, role and kind; its key stays."""
        table, put = self.state.rows, self.journal.put
        put(table.xyz, [row], _stack([spec.xyz]))
        put(table.spot, [row], _stack([spec.spots or (spec.xyz, spec.xyz)]))
        put(table.contact, [row], [spec.contact])
        put(table.kind, [row], [(int(PointKind.SMOOTH), spec.kind_b)])
        put(table.direction, [row], _stack([((0.0, 0.0, 0.0), spec.direction_b)]))
        self.roles(np.array([row]), np.array([int(spec.role)]))

    def _pair(self, spec: CrossingSpec) -> Pair:
        keys = self.state.lines.key.data
        return keys[self.state.line_of(spec.a)], keys[self.state.line_of(spec.b)]

    def roles(self, rows: IntArray, roles: IntArray) -> None:
        """Give crossings their roles, with the links that follow from them."""
        table = self.state.rows
        curve = table.curve[rows]
        first = (roles == Role.SHARED) | (roles == Role.DRIVES_A)
        second = (roles == Role.SHARED) | (roles == Role.DRIVES_B)
        reader = np.where(np.column_stack([first, second]), curve, -1)
        driver = np.where(roles == Role.DRIVES_B, curve[:, 0], -1)
        driver = np.where(roles == Role.DRIVES_A, curve[:, 1], driver)
        self.journal.put(table.role, rows, roles)
        self.journal.put(table.reader, rows, reader)
        self.journal.put(table.driver, rows, driver)

    def points(self, specs: Sequence[PointSpec]) -> IntArray:
        """Add placed or adopted points."""
        if not specs:
            return np.zeros(0, np.int64)
        rows = self.journal.grow(self.state.rows, len(specs))
        table, put = self.state.rows, self.journal.put
        # One or two are looked for among all keys, for many these are made texts once.
        taken: Container[str] = table.key.data if len(specs) <= _FEW else set(table.key.data)
        mine, keys = set[str](), list[str]()
        for spec in specs:
            x, y, z = np.asarray(spec.xyz, np.float64).tolist()
            wish = f"{self.state.curves.key[spec.curve]} @ ({x:.4f}, {y:.4f}, {z:.4f})"
            keys.append(self._fresh(wish, taken, mine))
            mine.add(keys[-1])
        self.journal.set(table.key, rows.tolist(), keys)
        put(table.alive, rows, True)
        put(table.sort, rows, [int(spec.sort) for spec in specs])
        put(table.xyz, rows, _stack([spec.xyz for spec in specs]))
        put(table.base, rows, _stack([spec.xyz for spec in specs]))
        put(table.curve, rows, [(spec.curve, -1) for spec in specs])
        put(table.reader, rows, [(spec.curve, -1) for spec in specs])
        put(table.kind, rows, [(spec.kind, 0) for spec in specs])
        put(table.direction, rows, _stack([(spec.direction, (0.0, 0.0, 0.0)) for spec in specs]))
        return rows

    def stand_ins(self, crossings: IntArray, sides: IntArray) -> IntArray:
        """Add adopted points that stand in for crossings (k,), on the curves of their sides (k,).

        The same one comes back where it was there before and was taken out.
        """
        table = self.state.rows
        there = {(table.stands_for[row], int(table.curve[row, 0])): row
                 for row in sorted(table.stands_for.data.given)}  # fmt: skip
        found: list[int] = []
        for row, side in zip(crossings.tolist(), sides.tolist(), strict=True):
            curve, title = int(table.curve[row, side]), str(table.key[row])
            old = there.get((title, curve), -1)
            if old < 0 or table.alive[old]:
                wish = f"{self.state.curves.key[curve]} for {title}"
                old = int(self.journal.grow(table, 1)[0])
                self.journal.set(table.key, [old], [self._fresh(wish, table.key.data)])
                self.journal.set(table.stands_for, [old], [title])
            found.append(old)
        rows, put = np.array(found, np.int64), self.journal.put
        giver = table.curve[crossings, sides]
        none = np.full(len(rows), -1)
        put(table.alive, rows, True)
        put(table.sort, rows, int(Sort.ADOPTED))
        put(table.curve, rows, np.column_stack([giver, none]))
        put(table.reader, rows, np.column_stack([giver, none]))
        put(table.kind, rows, np.column_stack([table.kind[crossings, sides], none * 0]))
        direction = np.zeros((len(rows), 2, 3))
        direction[:, 0] = table.direction[crossings, sides]
        put(table.direction, rows, direction)
        put(table.xyz, rows, table.xyz[crossings])
        put(table.base, rows, table.xyz[crossings])
        put(table.faired, rows, table.faired[crossings])
        put(table.anchor, rows, -1)
        return rows

    def define(self, curve: int, rows: ArrayLike) -> None:
        """Say which points define a curve, in order."""
        chosen = np.array(rows, np.int64)
        side = (self.state.rows.curve[chosen, 0] != curve).astype(np.int64)
        freeze(chosen, side)
        self.journal.set(self.state.curves.rows, [curve], [chosen])
        self.journal.set(self.state.curves.side, [curve], [side])

    def features(self, wanted: Iterable[Feature]) -> None:
        """Let a hull have these features and no others; what stays as it is, is not written.

        Parameters
        ----------
        wanted : iterable of Feature
            By their keys they take the place of those that are there.
        """
        self._keyed(self.state.featured, self.state.featured.feature, wanted)

    def definitions(self, wanted: Iterable[FormDefinition]) -> None:
        """Let a hull have these definitions and no others; one of the same use is replaced."""
        self._keyed(self.state.formed, self.state.formed.definition, wanted)

    def generated(self, wanted: Iterable[GeneratedCurve]) -> None:
        """Let these curves and no others come from definitions, or have come before."""
        self._keyed(self.state.produced, self.state.produced.curve, wanted)

    def _keyed(
        self, table: Featured | Formed | Produced, column: ValueColumn[K], wanted: Iterable[K]
    ) -> None:
        """Bring a table of objects with keys to these objects; a key keeps its row."""
        there = {
            column.data[number].key: number for number in np.flatnonzero(table.alive.data).tolist()
        }
        by_key = {each.key: each for each in wanted}
        gone = [number for key, number in there.items() if key not in by_key]
        self.journal.put(table.alive, gone, False)
        known = [key for key in sorted(by_key) if key in there]
        changed = [key for key in known if by_key[key] != column.data[there[key]]]
        if changed:
            numbers = [there[key] for key in changed]
            self.journal.set(column, numbers, [by_key[key] for key in changed])
        fresh = [key for key in sorted(by_key) if key not in there]
        if fresh:
            rows = self.journal.grow(table, len(fresh))
            self.journal.set(column, rows.tolist(), [by_key[key] for key in fresh])
            self.journal.put(table.alive, rows, True)

    def remove_rows(self, rows: ArrayLike) -> None:
        """Take points out; their keys are never used again."""
        gone = np.asarray(rows, np.int64)
        self.journal.put(self.state.rows.alive, gone, False)
        self.journal.put(self.state.rows.reader, gone, -1)
        self.journal.put(self.state.rows.driver, gone, -1)
