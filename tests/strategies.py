"""Small random nets and random pinned edits, for all suites.

A net is what `adopt` takes: lines of two or three families on a smooth random hull with a
profile and a deck edge. An edit moves shared crossings along their freedom.
"""

from __future__ import annotations

import attrs
import numpy as np
from hypothesis import strategies as st
from hypothesis.strategies import DrawFn, SearchStrategy

from assoc_hull.edit.adoption.adopt_lines import adopt
from assoc_hull.edit.document import Document
from assoc_hull.edit.recording import Settings
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import RefusedEditError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.model.kinds import BoundaryKind, Role, Sort
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.tables import Association, HullState, Particulars

__all__ = [
    "Form",
    "Move",
    "Net",
    "PinnedEdit",
    "apply_edit",
    "documents",
    "forms",
    "free_axis",
    "make_document",
    "movable",
    "net_of",
    "nets",
    "pinned_edits",
    "wigley_sources",
]


@attrs.frozen
class Form:
    """A smooth hull: y = B/2 (1 - |2 x / L - 1|^along) (1 - (1 - z / T)^up) waved along x.

    `up` grows by `twist` from aft to forward, so that no two waterlines are alike.
    """

    length: float = 100.0
    breadth: float = 10.0
    draught: float = 6.25
    along: float = 2.0
    up: float = 2.0
    twist: float = 0.0
    wave: float = 0.0

    def deck(self, x: FloatArray) -> FloatArray:
        """Half breadth at the greatest height, m; exactly nil at both ends."""
        place = 2.0 * x / self.length - 1.0
        full = 1.0 - np.abs(place) ** self.along
        return np.asarray(0.5 * self.breadth * full * (1.0 + self.wave * np.sin(3.0 * place)))

    def half_breadth(self, x: FloatArray, z: FloatArray) -> FloatArray:
        """Half breadth, m."""
        power = self.up + self.twist * x / self.length
        return np.asarray(self.deck(x) * (1.0 - (1.0 - z / self.draught) ** power))

    def height(self, x: FloatArray, y: float) -> FloatArray:
        """Height at which the hull has a half breadth, m; x where the deck is as broad."""
        power = self.up + self.twist * x / self.length
        left = np.clip(1.0 - y / self.deck(x), 0.0, 1.0)
        return np.asarray(self.draught * (1.0 - left ** (1.0 / power)))

    def reach(self, y: float) -> tuple[float, float] | None:
        """Where the deck has a half breadth, aft and forward; None where it has not."""
        middle = 0.5 * self.length
        if self.deck(np.array([middle]))[0] <= 1.02 * y:
            return None
        ends: list[float] = []
        for outer in (0.0, self.length):
            low, high = outer, middle
            for _ in range(80):
                half = 0.5 * (low + high)
                low, high = (half, high) if self.deck(np.array([half]))[0] < y else (low, half)
            ends.append(high)
        return ends[0], ends[1]


@attrs.frozen
class Net:
    """What `adopt` takes."""

    sources: tuple[LineSource, ...]
    particulars: Particulars
    associations: tuple[Association, ...]

    def adopt(self) -> HullState:
        """Make the net."""
        return adopt(self.sources, self.particulars, self.associations)[0]


def net_of(
    form: Form,
    stations: int,
    waterlines: int,
    buttocks: int = 0,
    points: tuple[int, int] | None = None,
    two_way: tuple[bool, bool, bool] = (True, True, True),
) -> Net:
    """Give the lines of a form.

    `points` are given per section and per waterline; None puts them where the lines cross.
    `two_way` is said of sections x waterlines, sections x buttocks, waterlines x buttocks.
    """
    xs = np.linspace(0.0, form.length, stations + 2)
    zs = np.linspace(0.0, form.draught, waterlines + 2)
    up = zs if points is None else np.linspace(0.0, form.draught, points[0])
    along = xs if points is None else np.linspace(0.0, form.length, points[1])
    sources = [_section(form, i, x, up) for i, x in enumerate(xs[1:-1], 1)]
    sources += [_waterline(form, z, along) for z in zs[1:-1]]
    for y in np.linspace(0.0, 0.5 * form.breadth, buttocks + 2)[1:-1]:
        sources += _buttock(form, float(y), 2 * stations + 9)
    sources += _boundaries(form, along)
    links = [Association("sections", "waterlines", two_way[0])]
    links += [Association("boundary", name) for name in ("sections", "waterlines")]
    if any(source.group == "buttocks" for source in sources):
        links.append(Association("sections", "buttocks", two_way[1]))
        links.append(Association("waterlines", "buttocks", two_way[2]))
        links.append(Association("boundary", "buttocks"))
    size = Particulars("Net", form.length, form.breadth, form.draught, form.draught)
    return Net(tuple(sources), size, tuple(links))


def _section(form: Form, number: int, x: float, z: FloatArray) -> LineSource:
    at = np.full(len(z), x)
    points = np.column_stack([at, form.half_breadth(at, z), z])
    return LineSource.make("sections", f"ST {number}", points)


def _waterline(form: Form, z: float, x: FloatArray) -> LineSource:
    at = np.full(len(x), z)
    points = np.column_stack([x, form.half_breadth(x, at), at])
    return LineSource.make("waterlines", f"WL {z:.3f}", points)


def _buttock(form: Form, y: float, count: int) -> list[LineSource]:
    reach = form.reach(y)
    if reach is None:
        return []
    turn = 0.5 * (1.0 - np.cos(np.linspace(0.0, np.pi, count)))
    x = reach[0] + (reach[1] - reach[0]) * turn
    z = form.height(x, y)
    z[[0, -1]] = form.draught
    points = np.column_stack([x, np.full(count, y), z])
    return [LineSource.make("buttocks", f"BTK {y:.3f}", points)]


def _boundaries(form: Form, x: FloatArray) -> list[LineSource]:
    L, T, end = form.length, form.draught, BoundaryKind.END
    deck = np.column_stack([x, form.deck(x), np.full(len(x), T)])
    profile = [[0.0, 0.0, T], [0.0, 0.0, 0.0], [L, 0.0, 0.0], [L, 0.0, T]]
    upward, across = ((0.0, 0.0, 1.0), T), ((0.0, 1.0, 0.0), 0.0)
    return [
        LineSource.make("boundary", "deck edge", deck, plane=upward, boundary=end),
        LineSource.make(
            "boundary", "profile", profile, plane=across, boundary=end, kind=[0, 2, 2, 0]
        ),
    ]


def wigley_sources(stations: int, waterlines: int, buttocks: int = 0) -> Net:
    """Give the lines of Wigley's parabolic hull, 100 x 10 x 6.25 m, all two-way."""
    return net_of(Form(), stations, waterlines, buttocks)


def forms() -> SearchStrategy[Form]:
    """Give smooth hulls of many proportions."""
    number = st.floats
    return st.builds(
        Form,
        length=number(40.0, 300.0),
        breadth=number(6.0, 45.0),
        draught=number(3.0, 20.0),
        along=number(2.0, 4.0),
        up=number(1.5, 3.0),
        twist=number(-0.3, 0.3),
        wave=number(-0.08, 0.08),
    )


@st.composite
def nets(draw: DrawFn, families: int | None = None) -> Net:
    """Give small nets: two families, or three with buttocks; one-way or two-way."""
    count = draw(st.sampled_from((2, 3))) if families is None else families
    return net_of(
        draw(forms()),
        draw(st.integers(3, 8)),
        draw(st.integers(2, 6)),
        draw(st.integers(1, 3)) if count == 3 else 0,
        draw(st.none() | st.tuples(st.integers(7, 16), st.integers(9, 24))),
        draw(st.tuples(st.booleans(), st.booleans(), st.booleans())),
    )


def make_document(net: Net) -> Document:
    """Adopt a net and open it for edits."""
    return Document(net.adopt())


def documents(families: int | None = None) -> SearchStrategy[Document]:
    """Give adopted nets that may be edited."""
    return nets(families).map(make_document)


@attrs.frozen
class Move:
    """Move the crossing `which` (modulo their number) by a distance in m."""

    which: int
    distance: float


@attrs.frozen
class PinnedEdit:
    """One transaction that moves crossings; wide gaps refuse it, or are kept."""

    moves: tuple[Move, ...]
    refuse_gaps: bool


def pinned_edits(
    largest: float = 0.05, most: int = 6, moves: int = 4
) -> SearchStrategy[list[PinnedEdit]]:
    """Give sequences of pinned edits of at most `largest` metres each."""
    move = st.builds(Move, st.integers(0, 2**20), st.floats(-largest, largest))
    each = st.lists(move, min_size=1, max_size=moves).map(tuple)
    return st.lists(st.builds(PinnedEdit, each, st.booleans()), min_size=1, max_size=most)


def free_axis(state: HullState, row: int) -> int | None:
    """Give the one coordinate along which a crossing of two plane lines is free."""
    lines = [state.line_of(curve) for curve in state.rows.curve[row].tolist()]
    if not state.lines.planar[lines].all():
        return None
    free = np.flatnonzero((state.lines.normal[lines] == 0.0).all(axis=0))
    return int(free[0]) if len(free) == 1 else None


def movable(state: HullState) -> list[int]:
    """Give the shared crossings that have one free coordinate, by key."""
    table = state.rows
    chosen: IntArray = np.flatnonzero(
        table.alive.data & (table.sort.data == Sort.CROSSING) & (table.role.data == Role.SHARED)
    )
    rows = [row for row in chosen.tolist() if free_axis(state, row) is not None]
    return sorted(rows, key=table.key.data.__getitem__)


def apply_edit(document: Document, edit: PinnedEdit) -> bool:
    """Carry an edit out; False if nothing changed: it was refused, or moved by nothing."""
    state, rows = document.state, movable(document.state)
    wanted = {rows[move.which % len(rows)]: move.distance for move in edit.moves}
    values = state.rows.xyz[list(wanted)].copy()
    for value, (row, distance) in zip(values, wanted.items(), strict=True):
        value[free_axis(state, row)] += distance
    try:
        with Transaction(document, "move", Settings(refuse_gaps=edit.refuse_gaps)) as transaction:
            transaction.write(np.array(list(wanted)), values, "move")
    except RefusedEditError:
        return False
    return transaction.report is not None and transaction.report.changed
