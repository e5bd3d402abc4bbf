"""All that a hull holds, as tables: points, curves, lines and groups; and a copy of them.

Objects are handles on these rows. Coordinates of all points lie in one column; a crossing
is one row of it, and the two friend points of the crossing are handles on that row. Side 0
of a row is curve *a* (the line of lower rank, ties by key), side 1 is curve *b*; a placed
or adopted point has a curve on side 0 only. Tables are written through a `Journal` only, see
`assoc_hull.graph.journal`; a copy is written freely and leaves the hull as it is.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Protocol, TypeVar

import attrs
import numpy as np

from assoc_hull.arguments import checked, choice, flag, integer, places, positive, shown, word
from assoc_hull.errors import BadInputError, WrongTypeError
from assoc_hull.geometry.curves import EndKind, FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.graph.derived import Derived, Gate, Key
from assoc_hull.graph.table import (
    Column,
    MatrixColumn,
    NumberColumn,
    Table,
    ValueColumn,
    VectorColumn,
    matrices,
    numbers,
    values,
    values_given,
    vectors,
    writes_begun,
)
from assoc_hull.model.attached_body import AttachedBody
from assoc_hull.model.births import Births
from assoc_hull.model.dirty_nodes import CLEAN, DirtyNodes
from assoc_hull.model.features import Feature
from assoc_hull.model.form_definition import FormDefinition, GeneratedCurve
from assoc_hull.model.keys import KeyColumn, LabelColumn, keys, labels
from assoc_hull.model.kinds import FAMILIES, Family
from assoc_hull.model.tunnel_definition import TunnelDefinition
from assoc_hull.tolerance import Tolerances

__all__ = [
    "DECKS",
    "TABLES",
    "Association",
    "Corner",
    "CurveIntersections",
    "Curves",
    "Ends",
    "Featured",
    "Formed",
    "Groups",
    "HasState",
    "HullSettings",
    "HullState",
    "Lines",
    "Particulars",
    "Produced",
    "Rows",
    "Ruling",
    "copy_into",
    "copy_state",
    "state_of",
]

T = TypeVar("T")

_OF_THIS_PROCESS = ("number", "_live", "_published", "_written_here", "_looked", "_reached")

_GATE = Gate()
"""Held for the moment in which a state is published, or one is taken."""


class HasState(Protocol):
    """A hull."""

    @property
    def state(self) -> HullState:
        """Its tables."""
        ...


def state_of(hull: HasState, where: str = "in hydrostatics") -> HullState:
    """Take a hull, and give its tables; `where` is for the message.

    Raises
    ------
    WrongTypeError
        No hull was given; tables alone are none.
    """
    state: object = getattr(hull, "state", None)
    if not isinstance(state, HullState):
        # The value itself is not shown: tables are long.
        what = f"the hull is a {type(hull).__name__}"
        raise WrongTypeError(what, where, "give a Hull")
    return state


TABLES = ("groups", "lines", "curves", "rows", "featured", "formed", "produced", "settings")


# --------------------------------------------------------------------------------------
# Values that the tables hold.

DECKS = ("open", "closed")
"""What may lie between the deck edges to port and starboard: nothing, or a deck."""


def _deck(value: object, name: str, where: str) -> None:
    choice(value, name, DECKS, where)


@attrs.frozen
class Particulars:
    """Principal dimensions, m, and whether water stays off the deck.

    Attributes
    ----------
    name : str
        Name of the ship.
    length : float
        Between perpendiculars, Lpp.
    breadth, depth, draught : float
        Moulded; the draught is the design draught.
    deck : {"open", "closed"}
        Closed: straight athwartships between the deck edges to port and starboard, so that
        it may dip into the water. Open: nothing is there, and water above the edge comes in.
    """

    name: str = attrs.field(validator=checked(word, "in the particulars"))
    length: float = attrs.field(validator=checked(positive, "in the particulars"))
    breadth: float = attrs.field(validator=checked(positive, "in the particulars"))
    depth: float = attrs.field(validator=checked(positive, "in the particulars"))
    draught: float = attrs.field(validator=checked(positive, "in the particulars"))
    deck: str = attrs.field(default="open", validator=checked(_deck, "in the particulars"))


@attrs.frozen
class Association:
    """Lines of group `a` generate points on those of group `b`, and back if `two_way`."""

    a: str = attrs.field(validator=checked(word, "in an association"))
    b: str = attrs.field(validator=checked(word, "in an association"))
    two_way: bool = attrs.field(default=True, validator=checked(flag, "in an association"))


Corner = tuple[float | None, float | None, float | None]


@attrs.frozen
class Ruling:
    """Within a box, lines of `a` generate points on those of `b`, and back if `two_way`.

    A crossing follows the first ruling that holds it, else the association of its groups. Of two
    boxes that share a border the lower one holds what lies on it.

    Attributes
    ----------
    a, b : str
        Names of groups, or keys of lines.
    two_way : bool
        Whether `b` generates on `a` as well.
    low, high : tuple of three float or None, m
        Corners of the box; None where it has no bound.
    """

    a: str = attrs.field(validator=checked(word, "in a ruling"))
    b: str = attrs.field(validator=checked(word, "in a ruling"))
    two_way: bool = attrs.field(default=True, validator=checked(flag, "in a ruling"))
    low: Corner = (None, None, None)
    high: Corner = (None, None, None)


def _end_kinds(_: object, __: object, value: object) -> None:
    if not isinstance(value, tuple) or len(value) != 2:
        remedy = "give an EndKind for the start and one for the finish"
        raise BadInputError(f"kind is {shown(value)}", "in Ends", remedy)
    for each in value:
        EndKind(integer(each, "kind", "in Ends", least=0, most=len(EndKind) - 1))


def _two_places(value: object, name: str, where: str) -> None:
    if not isinstance(value, tuple) or len(places(value, name, where)) != 2:
        remedy = "give a vector for the start and one for the finish"
        raise BadInputError(f"{name} is {shown(value)}", where, remedy)


@attrs.frozen
class Ends:
    """End conditions of a curve: an `EndKind` and a vector at the start and at the finish."""

    kind: tuple[int, int] = attrs.field(default=(0, 0), validator=_end_kinds)
    vector: tuple[tuple[float, float, float], tuple[float, float, float]] = attrs.field(
        default=((0.0, 0.0, 0.0), (0.0, 0.0, 0.0)), validator=checked(_two_places, "in Ends")
    )


@attrs.frozen(eq=False)
class CurveIntersections:
    """Where a curve meets the planes of the lines it is associated with.

    Attributes
    ----------
    line : (k,) int
        The lines whose planes are met, group by group, along each group by plane, then by
        position along the curve.
    sign : (k,) int8
        +1 where the curve passes to the positive side of the plane, else -1.
    row : (k,) int
        The crossing there; -1 where the other line does not come: the relation is latent.
    parameter : (k,), m
        Chord parameter on the curve.
    xyz : (k, 3), m
        The place on the curve.
    """

    line: IntArray
    sign: np.typing.NDArray[np.int8]
    row: IntArray
    parameter: FloatArray
    xyz: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.line, self.sign, self.row, self.parameter, self.xyz)

    def take(self, chosen: IntArray | np.typing.NDArray[np.bool_]) -> CurveIntersections:
        """Give some of the intersections, by index or mask, in that order."""
        return CurveIntersections(
            self.line[chosen],
            self.sign[chosen],
            self.row[chosen],
            self.parameter[chosen],
            self.xyz[chosen],
        )

    @classmethod
    def none(cls) -> CurveIntersections:
        """Give no intersections."""
        whole = np.zeros(0, np.int64)
        return cls(whole, np.zeros(0, np.int8), whole.copy(), np.zeros(0), np.zeros((0, 3)))


# --------------------------------------------------------------------------------------
# The tables.


def _no_rows() -> IntArray:
    rows = np.zeros(0, np.int64)
    freeze(rows)
    return rows


@attrs.frozen(eq=False)
class Rows(Table):
    """Points; columns of two values have one per side of the row.

    ``curve``: the curves that a point lies on; ``reader``: those that are made through it;
    ``driver``: the one that it is computed from. ``xyz`` is its one value, ``spot`` and
    ``parameter`` say where each curve passes it. ``contact``: a is a boundary or space curve, and
    the line b is always made through the crossing. ``override``: the role by the designer's word.
    ``gap`` and ``limit`` are of watched crossings. An adopted point rides from ``base`` with the
    points ``anchor``, which lay at ``anchor_from`` then; the second one counts ``anchor_weight``.
    ``faired``: how far fairing has taken a point from the value that was given for it. A crossing
    that an association was switched at has the role of before as ``first_role``; ``stands_for`` of
    a stand-in is the key of its crossing, which may be dead.
    """

    key: KeyColumn = keys()
    alive: NumberColumn[np.bool_] = numbers(np.bool_)
    sort: NumberColumn[np.int8] = numbers(np.int8)
    xyz: VectorColumn[np.float64] = vectors(np.float64, 3)
    kind: VectorColumn[np.int8] = vectors(np.int8, 2)
    direction: MatrixColumn[np.float64] = matrices(np.float64, (2, 3), sparse=True)
    curve: VectorColumn[np.int64] = vectors(np.int64, 2, -1)
    role: NumberColumn[np.int8] = numbers(np.int8)
    override: NumberColumn[np.int8] = numbers(np.int8, -1)
    reader: VectorColumn[np.int64] = vectors(np.int64, 2, -1)
    driver: NumberColumn[np.int64] = numbers(np.int64, -1)
    contact: NumberColumn[np.bool_] = numbers(np.bool_)
    sign: NumberColumn[np.int8] = numbers(np.int8)
    birth: NumberColumn[np.int64] = numbers(np.int64)
    limit: NumberColumn[np.float64] = numbers(np.float64, np.nan, sparse=True)
    gap: NumberColumn[np.float64] = numbers(np.float64, np.nan, sparse=True)
    spot: MatrixColumn[np.float64] = matrices(np.float64, (2, 3), np.nan)
    parameter: VectorColumn[np.float64] = vectors(np.float64, 2, np.nan)
    anchor: VectorColumn[np.int64] = vectors(np.int64, 2, -1, sparse=True)
    anchor_from: MatrixColumn[np.float64] = matrices(np.float64, (2, 3), sparse=True)
    anchor_weight: NumberColumn[np.float64] = numbers(np.float64, sparse=True)
    base: VectorColumn[np.float64] = vectors(np.float64, 3, sparse=True)
    faired: VectorColumn[np.float64] = vectors(np.float64, 3, sparse=True)
    state: NumberColumn[np.int8] = numbers(np.int8)
    first_role: NumberColumn[np.int8] = numbers(np.int8, -1, sparse=True)
    label: LabelColumn = labels()
    stands_for: LabelColumn = labels()


@attrs.frozen(eq=False)
class Curves(Table):
    """Curves; ``rows`` and ``side`` are their defining points in order."""

    key: ValueColumn[str] = values("")
    alive: NumberColumn[np.bool_] = numbers(np.bool_)
    line: NumberColumn[np.int64] = numbers(np.int64, -1)
    rows: ValueColumn[IntArray] = values(_no_rows())
    side: ValueColumn[IntArray] = values(_no_rows())
    ends: ValueColumn[Ends] = values(Ends())
    spline: ValueColumn[SplineBatch | None] = values(None)
    meets: ValueColumn[CurveIntersections] = values(CurveIntersections.none())
    state: NumberColumn[np.int8] = numbers(np.int8)


@attrs.frozen(eq=False)
class Lines(Table):
    """Lines, their planes, and the curves that they consist of."""

    key: ValueColumn[str] = values("")
    alive: NumberColumn[np.bool_] = numbers(np.bool_)
    name: ValueColumn[str] = values("")
    group: NumberColumn[np.int64] = numbers(np.int64, -1)
    planar: NumberColumn[np.bool_] = numbers(np.bool_)
    normal: VectorColumn[np.float64] = vectors(np.float64, 3)
    offset: NumberColumn[np.float64] = numbers(np.float64, np.nan)
    boundary: NumberColumn[np.int8] = numbers(np.int8, -1)
    curves: ValueColumn[tuple[int, ...]] = values(())
    note: ValueColumn[str] = values("")


@attrs.frozen(eq=False)
class Groups(Table):
    """Groups of lines; ``members`` of a designer's own are keys of lines and names of groups."""

    name: ValueColumn[str] = values("")
    family: ValueColumn[str] = values("")
    alive: NumberColumn[np.bool_] = numbers(np.bool_)
    members: ValueColumn[tuple[str, ...]] = values(())


@attrs.frozen(eq=False)
class Featured(Table):
    """Features, held whole."""

    alive: NumberColumn[np.bool_] = numbers(np.bool_)
    feature: ValueColumn[Feature] = values_given()


@attrs.frozen(eq=False)
class Formed(Table):
    """Definitions by form parameters, held whole."""

    alive: NumberColumn[np.bool_] = numbers(np.bool_)
    definition: ValueColumn[FormDefinition] = values_given()


@attrs.frozen(eq=False)
class Produced(Table):
    """Curves whose points come from definitions."""

    alive: NumberColumn[np.bool_] = numbers(np.bool_)
    curve: ValueColumn[GeneratedCurve] = values_given()


@attrs.frozen(eq=False)
class HullSettings(Table):
    """What belongs to the hull as a whole; one row."""

    associations: ValueColumn[tuple[Association, ...]] = values(())
    rulings: ValueColumn[tuple[Ruling, ...]] = values(())
    tunnels: ValueColumn[tuple[TunnelDefinition, ...]] = values(())
    bodies: ValueColumn[tuple[AttachedBody, ...]] = values(())
    births: ValueColumn[Births] = values_given()
    failed: ValueColumn[tuple[int, ...]] = values(())
    particulars: ValueColumn[Particulars] = values_given()


@attrs.define(eq=False)
class HullState:
    """The tables of one hull.

    Attributes
    ----------
    particulars : Particulars
        Principal dimensions, m.
    tolerances : Tolerances
        Part of the definition.
    rows, curves, lines, groups : Rows, Curves, Lines, Groups
        The objects.
    featured : Featured
        One row per feature, which it holds whole: see `features`.
    formed : Formed
        One row per definition by form parameters, which it holds whole: see `definitions`.
    produced : Produced
        One row per curve whose points come from definitions: see `generated`.
    settings : HullSettings
        One row: the associations (`associations`) and how many crossings of each pair of
        lines were ever born (`births`), so that a dead id never comes back; the name may
        change, so the particulars lie here too.
    revision_row, revision_curve : dict of int to int
        Revisions; outside the journal, as they never run backward.
    number : int
        Number of the state in the history of the hull; what is published keeps that of its time.
    memory : Derived
        What was made of the tables, see `derived`. It lies here to go with the hull: a store by
        hull elsewhere would keep it for ever.
    """

    _given: Particulars = attrs.field(alias="particulars")
    tolerances: Tolerances = attrs.field(factory=Tolerances)
    rows: Rows = attrs.field(factory=Rows)
    curves: Curves = attrs.field(factory=Curves)
    lines: Lines = attrs.field(factory=Lines)
    groups: Groups = attrs.field(factory=Groups)
    featured: Featured = attrs.field(factory=Featured)
    formed: Formed = attrs.field(factory=Formed)
    produced: Produced = attrs.field(factory=Produced)
    settings: HullSettings = attrs.field(factory=HullSettings)
    revision_row: dict[int, int] = attrs.field(factory=dict)
    revision_curve: dict[int, int] = attrs.field(factory=dict)
    number: int = attrs.field(default=0, init=False)
    memory: Derived = attrs.field(factory=Derived, init=False, repr=False)
    _live: HullState | None = attrs.field(default=None, init=False, repr=False)
    _published: HullState | None = attrs.field(default=None, init=False, repr=False)
    _written_here: Callable[[], bool] | None = attrs.field(default=None, init=False, repr=False)
    _looked: int = attrs.field(default=-1, init=False, repr=False)
    _reached: Callable[[], DirtyNodes] | None = attrs.field(default=None, init=False, repr=False)

    def __attrs_post_init__(self) -> None:
        if not self.settings.count:
            self.settings.resize(1)
            self.settings.births.data[0] = Births.of({})
            self.settings.particulars.data[0] = self._given

    @property
    def live_tables(self) -> HullState:
        """The tables that this is a published state of; itself, if it is the state of nothing."""
        return self if self._live is None else self._live

    def __repr__(self) -> str:
        return f"<HullState {self.particulars.name}, number {self.number}>"

    def published(self) -> HullState:
        """Give the tables as they were when they were published last; they stay so for ever.

        While somebody writes that is how they were before. Numbers are copied by whoever writes.
        """
        if self._live is not None:
            return self
        if self._written_here is not None and self._published is not None:
            return self._published  # it was made before anybody began to write, and stays
        return _GATE.alone(self._published_now)

    def _published_now(self) -> HullState:
        if self._written_here is None and not self._is_current():
            taken = writes_begun()
            self._published = self._shared(self, self._published)
            self._looked = taken
        assert self._published is not None, "made above, or before anybody began to write"
        return self._published

    def _is_current(self) -> bool:
        """Tell whether the tables are as they were published, or as they were again."""
        published, taken = self._published, writes_begun()
        if published is None or published.number != self.number:
            return False
        if taken != self._looked:  # else nobody has written to any column of any hull
            if not all(getattr(self, name).equals(getattr(published, name)) for name in TABLES):
                return False
            self._looked = taken
        return True

    def seen_here(self) -> HullState:
        """Give the tables that are being written to whoever writes them, else the published."""
        mine = self._written_here
        return self if mine is not None and mine() else self.published()

    def dirty_here(self) -> DirtyNodes:
        """Give what is dirty to whoever writes these tables; to all others nothing is."""
        mine, reached = self._written_here, self._reached
        return reached() if reached is not None and mine is not None and mine() else CLEAN

    def tell_dirty(self, reached: Callable[[], DirtyNodes]) -> None:
        """Ask this for what is dirty, until writing ends."""
        self._reached = reached

    def begin_writing(self, written_here: Callable[[], bool]) -> None:
        """Keep what is published, for all but those of whom `written_here` is true."""
        _GATE.alone(partial(self._begin_writing, written_here))

    def _begin_writing(self, written_here: Callable[[], bool]) -> None:
        self.memory.add(self._published_now().memory)
        self._written_here = written_here

    def end_writing(self) -> None:
        """Publish the tables as they are."""
        _GATE.alone(self._end_writing)

    def _end_writing(self) -> None:
        self._written_here = self._reached = None
        self._published_now()

    def snapshot(self) -> HullState:
        """Give tables of their own with the published content; nothing is copied until a write."""
        return self.published()._shared(None)

    def as_written(self) -> HullState:
        """Give tables of their own with what is being written, as it is now; as `snapshot`."""
        found = self._shared(None)
        found.memory.add(self.published().memory)
        return found

    def _shared(self, live: HullState | None, before: HullState | None = None) -> HullState:
        """Give tables that share all columns; what was derived is known there as well."""
        found = object.__new__(HullState)
        for name in TABLES:
            known = None if before is None else getattr(before, name)
            setattr(found, name, getattr(self, name).share(known))
        found._given, found.tolerances = self._given, self.tolerances
        found.number = 0 if live is None else self.number
        found.revision_row, found.revision_curve = (
            dict(self.revision_row),
            dict(self.revision_curve),
        )
        found._live, found._published, found._written_here, found._looked = live, None, None, -1
        found._reached = None
        found.memory = Derived()
        # What was made of tables that may be written to is not handed on: it may look at them.
        if (source := self if self._live is not None else before) is not None:
            found.memory.add(source.memory)
        return found

    def __getstate__(self) -> dict[str, object]:
        # In another process these tables are a hull of their own.
        names = [each.name for each in attrs.fields(HullState)]
        return {name: getattr(self, name) for name in names if name not in _OF_THIS_PROCESS}

    def __setstate__(self, state: dict[str, object]) -> None:
        for name, value in state.items():
            setattr(self, name, value)
        self._live, self._published, self._written_here, self._looked = None, None, None, -1
        self._reached, self.number = None, 0

    def derived(
        self, key: Key, depends_on: tuple[object, ...], make: Callable[[], T], most: int = 64
    ) -> T:
        """Give what was made last for a key, or make it anew; see `assoc_hull.graph.derived`."""
        return self.memory.give(key, depends_on, make, most)

    @property
    def particulars(self) -> Particulars:
        """Name and principal dimensions, m."""
        return self.settings.particulars[0]

    @property
    def associations(self) -> tuple[Association, ...]:
        """The declared associations."""
        return self.settings.associations[0]

    @property
    def rulings(self) -> tuple[Ruling, ...]:
        """Which lines rule where, the statement that was made last first."""
        return self.settings.rulings[0]

    @property
    def tunnels(self) -> tuple[TunnelDefinition, ...]:
        """The tunnels that the hull holds, by name."""
        return self.settings.tunnels[0]

    @property
    def bodies(self) -> tuple[AttachedBody, ...]:
        """Bodies beside the net, by name."""
        return self.settings.bodies[0]

    @property
    def features(self) -> tuple[Feature, ...]:
        """The features that are alive, by key."""
        table = self.featured
        found = [table.feature[number] for number in self.live("featured").tolist()]
        return tuple(sorted(found, key=lambda each: each.key))

    @property
    def definitions(self) -> tuple[FormDefinition, ...]:
        """The definitions by form parameters, by key."""
        table = self.formed
        found = [table.definition[number] for number in self.live("formed").tolist()]
        return tuple(sorted(found, key=lambda each: each.key))

    @property
    def generated(self) -> tuple[GeneratedCurve, ...]:
        """The curves whose points come from definitions, detached ones too, by key."""
        table = self.produced
        found = [table.curve[number] for number in self.live("produced").tolist()]
        return tuple(sorted(found, key=lambda each: each.key))

    @property
    def failed(self) -> tuple[int, ...]:
        """Curves that could not be lofted and keep their last good shape."""
        return self.settings.failed[0]

    @property
    def births(self) -> Births:
        """How many crossings each pair of lines has ever had, by the keys of the lines."""
        return self.settings.births[0]

    def family(self, line: int) -> Family:
        """Give the family of a line."""
        return FAMILIES[self.groups.family[int(self.lines.group[line])]]

    def line_of(self, curve: int) -> int:
        """Give the line that a curve belongs to."""
        return int(self.curves.line[curve])

    def rank(self, curve: int) -> tuple[int, str, str]:
        """Give the rank of a curve: by family, then by the keys of line and curve."""
        line = self.line_of(curve)
        keys = self.lines.key[line], self.curves.key[curve]
        return (self.family(line).rank, *keys)

    def spline(self, curve: int) -> SplineBatch:
        """Give the published spline of a curve, a batch of one."""
        found = self.curves.spline[curve]
        assert found is not None, "a published curve has a shape"
        return found

    def curves_of(self, line: int) -> list[int]:
        """Give the curves of a line that have a shape, in their order."""
        curves = self.curves
        return [
            curve
            for curve in self.lines.curves[line]
            if curves.alive[curve] and curves.spline[curve] is not None
        ]

    def live(self, table: str) -> IntArray:
        """Give the numbers of the live rows of a table."""
        return np.flatnonzero(getattr(self, table).alive.data)


# --------------------------------------------------------------------------------------
# Copies.


def copy_state(state: HullState) -> HullState:
    """Copy the tables of a hull; row numbers stay, values that never change are shared.

    What was measured in plain numbers is known of the copy as well.
    """
    found = HullState(state.particulars, state.tolerances)
    copy_into(found, state)
    found.memory.add_some(state.memory, _PLAIN)
    return found


_PLAIN = ("measures", "fairness")
"""Kinds of derived things that look at no tables: they are plain numbers."""


def copy_into(found: HullState, state: HullState) -> None:
    """Give tables the content of a copy; they stay the same objects, so handles on them hold."""
    for name in TABLES:
        _copy(getattr(state, name), getattr(found, name))
    found.revision_row, found.revision_curve = dict(state.revision_row), dict(state.revision_curve)


def _copy(given: Table, found: Table) -> None:
    found.resize(given.count)
    for name, column in given.columns.items():
        other = found.columns[name]
        if isinstance(column, Column) and isinstance(other, Column):
            other.take_over(column)
        elif isinstance(column, ValueColumn) and isinstance(other, ValueColumn):
            other.store[:] = column.data
        # The number of a write stands for its content.
        other.writes = column.writes
