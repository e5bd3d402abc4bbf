"""The hull as a network of nodes: how curves are lofted, cut and aligned, level by level.

Definitions by form parameters are nodes below nil, of which nothing but the edit writes the
value; generated points read them, and those of sections the ends of their curve as well.

Levels: a curve of level L in the graph of driven links is evaluated at 4 L, the points
computed from it at 4 L + 1, and adopted points that ride with such points, as generated ones,
one below the level of their own curve. A curve and a waterline that nothing drives are thus
lofted in one batch.

Cutting a batch of curves with all planes of its partners.

Which root is which: meetings of a curve before and after it changed.

A plane may meet a curve many times. New roots are aligned with the old ones by sign and
order, with the fewest births and deaths, ties by the least total displacement, then the
lower position along the curve. Ordinals along the curve would be wrong after every birth.

From tables to splines: what a batch of curves is made from, and the lofting of it.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import TypeVar, overload

import attrs
import numpy as np

from assoc_hull.geometry.curves import (
    CurveData,
    FloatArray,
    IntArray,
    SplineBatch,
    freeze,
)
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.plane_intersections import PlaneIntersections, intersect_planes
from assoc_hull.graph.journal import Journal, PickedRows
from assoc_hull.graph.run_update import Evaluation, Readers, closure
from assoc_hull.model.address import AddressBook
from assoc_hull.model.generated_curves import attached_curves, points_given, unmade_rows
from assoc_hull.model.index import Index, PlaneSet
from assoc_hull.model.node import Node
from assoc_hull.model.tables import CurveIntersections, HullState

__all__ = [
    "Alignment",
    "HullNetwork",
    "PartnerIntersections",
    "align_curve",
    "align_plane_roots",
    "bits_differ",
    "curve_data",
    "cut_curves",
    "loft_curves",
    "moved_curve",
    "moved_curves",
    "placed",
]

Scalar = TypeVar("Scalar", bound=np.generic)


@attrs.frozen(eq=False)
class PartnerIntersections:
    """Meetings of a batch of curves, sorted by curve, then as in `CurveIntersections`.

    Attributes
    ----------
    curve, line : (k,) int
        Place of the curve in the batch, and the line whose plane it meets.
    sign : (k,) int8
        As in `CurveIntersections`.
    segment : (k,) int
        Number of the segment along its curve.
    parameter, xyz : (k,), (k, 3), m
        As in `CurveIntersections`; frozen.
    bounds : list of int
        Where the meetings of each curve begin; the last entry is k.
    """

    curve: IntArray
    line: IntArray
    sign: np.typing.NDArray[np.int8]
    segment: IntArray
    parameter: FloatArray
    xyz: FloatArray
    bounds: list[int]

    def take(self, first: int, stop: int) -> CurveIntersections:
        """Give the meetings of one curve; of which crossings they are is not known yet."""
        span = slice(first, stop)
        return CurveIntersections(
            self.line[span].copy(), self.sign[span].copy(), np.full(stop - first, -1),
            self.parameter[span].copy(), self.xyz[span].copy(),
        )  # fmt: skip


@attrs.frozen(eq=False)
class _Piece:
    """The meetings of the curves of one group with one set of planes."""

    met: PlaneIntersections
    local: IntArray
    segment: IntArray
    planes: PlaneSet


def cut_curves(
    state: HullState, index: Index, curves: IntArray, splines: Sequence[SplineBatch]
) -> PartnerIntersections:
    """Meet the planes of the partners of each curve.

    Parameters
    ----------
    state : HullState
        The tables.
    index : Index
        Holds the planes.
    curves : (m,) int
        The curves.
    splines : sequence of SplineBatch
        Their splines, singly.
    """
    lines = state.curves.line[curves]
    groups = state.lines.group[lines]
    pieces: list[_Piece] = []
    for group in sorted(set(groups.tolist())):
        partners = index.partners.get(group, ())
        if partners:
            mine = np.flatnonzero(groups == group)
            batch = SplineBatch.join([splines[i] for i in mine.tolist()])
            factor = state.tolerances.factor
            pieces += [_cut(mine, batch, planes, factor) for planes in partners]
    return _merge(state, lines, pieces)


def _cut(mine: IntArray, batch: SplineBatch, planes: PlaneSet, factor: float) -> _Piece:
    """Meet one set of planes."""
    met = intersect_planes(batch, planes.normal, planes.offsets, factor)
    segment = met.segment - batch.start.take(met.curve)
    return _Piece(met, mine.take(met.curve), segment, planes)


def _merge(state: HullState, lines: IntArray, pieces: Sequence[_Piece]) -> PartnerIntersections:
    """Sort the meetings of all pieces by curve; along a curve the order of the pieces stays.

    The places are put exactly into the plane of their own curve too.
    """
    if not pieces:
        none, whole = CurveIntersections.none(), np.zeros(0, np.int64)
        bounds = [0] * (len(lines) + 1)
        return PartnerIntersections(
            whole, none.line, none.sign, whole, none.parameter, none.xyz, bounds
        )
    curve = _all([piece.local for piece in pieces], None)
    order = np.argsort(curve, kind="stable") if len(pieces) > 1 else None
    curve = curve if order is None else curve.take(order)
    line = _all([piece.planes.lines.take(piece.met.plane) for piece in pieces], order)
    sign = _all([piece.met.sign for piece in pieces], order)
    bounds = np.searchsorted(curve, np.arange(len(lines) + 1)).tolist()
    segment = _all([piece.segment for piece in pieces], order)
    parameter = _all([piece.met.t for piece in pieces], order)
    xyz = np.concatenate([piece.met.xyz for piece in pieces])
    xyz = xyz if order is None else xyz.take(order, axis=0)
    own = (state.lines.normal[lines] == 1.0).take(curve, axis=0)
    xyz = np.where(own, state.lines.offset[lines].take(curve)[:, None], xyz)
    freeze(line, sign, parameter, xyz)
    return PartnerIntersections(curve, line, sign, segment, parameter, xyz, bounds)


def _all(
    parts: list[np.typing.NDArray[Scalar]], order: IntArray | None
) -> np.typing.NDArray[Scalar]:
    joined = parts[0] if len(parts) == 1 else np.concatenate(parts)
    return joined if order is None else joined.take(order, axis=0)


@attrs.frozen(eq=False)
class Alignment:
    """How the meetings of one curve follow from the old ones.

    Attributes
    ----------
    curve : int
        Number of the curve.
    row : (k,) int
        For each new meeting the crossing it is, -1 if none.
    gone : (g,) int
        Crossings that have no meeting on this curve any more.
    come : (b,) int
        New meetings that no old one corresponds to.
    """

    curve: int
    row: IntArray
    gone: IntArray
    come: IntArray


def align_curve(curve: int, old: CurveIntersections, new: CurveIntersections) -> Alignment:
    """Align all meetings of a curve, plane by plane."""
    row = np.full(len(new.line), -1)
    known = np.zeros(len(new.line), bool)
    before, after = (np.argsort(each.line, kind="stable") for each in (old, new))
    odd = _odd_lines(old, before, new, after)
    # Of all other planes each meeting is the one that stood in its place.
    kept = after[~np.isin(new.line[after], odd)]
    row[kept], known[kept] = old.row[before[~np.isin(old.line[before], odd)]], True
    gone: list[int] = []
    for line in odd.tolist():
        first, then = np.flatnonzero(old.line == line), np.flatnonzero(new.line == line)
        match = align_plane_roots(old.sign[first], old.xyz[first], new.sign[then], new.xyz[then])
        for one, other in match:
            row[then[other]], known[then[other]] = old.row[first[one]], True
        lost = set(range(len(first))) - {one for one, _ in match}
        gone += [int(old.row[first[i]]) for i in lost if old.row[first[i]] >= 0]
    return Alignment(curve, row, np.array(sorted(gone), np.int64), np.flatnonzero(~known))


def _odd_lines(
    old: CurveIntersections, before: IntArray, new: CurveIntersections, after: IntArray
) -> IntArray:
    """Give the lines whose planes are met more or less often than before, or in other senses.

    `before` and `after` are the orders of the meetings by lines.
    """
    was, now = old.line[before], new.line[after]
    lines = np.union1d(was, now)
    counts = [each.searchsorted(lines, "right") - each.searchsorted(lines) for each in (was, now)]
    odd: IntArray = lines[counts[0] != counts[1]]
    one, other = ~np.isin(was, odd), ~np.isin(now, odd)
    turned = old.sign[before[one]] != new.sign[after[other]]
    return np.union1d(odd, was[one][turned])


def align_plane_roots(
    old_sign: np.typing.NDArray[np.int8],
    old_xyz: FloatArray,
    new_sign: np.typing.NDArray[np.int8],
    new_xyz: FloatArray,
) -> list[tuple[int, int]]:
    """Pair old with new roots of one curve and one plane, both in order along the curve.

    Parameters
    ----------
    old_sign, new_sign : (k,), (l,)
        +1 or -1.
    old_xyz, new_xyz : (k, 3), (l, 3), m
        Where they lie.

    Returns
    -------
    list of (int, int)
        Pairs of equal sign, both ascending: the most pairs; among these, the least sum of
        distances; among these, the pairs that come first along the curve.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.model.network import align_plane_roots
    >>> at = np.array([[0.0, 0, 0], [1, 0, 0], [5, 0, 0]])
    >>> align_plane_roots(np.array([1]), at[2:], np.array([1, -1, 1]), at)
    [(0, 2)]
    """
    if np.array_equal(old_sign, new_sign):
        return [(i, i) for i in range(len(old_sign))]
    before, after = len(old_sign), len(new_sign)
    offset = old_xyz[:, None, :] - new_xyz[None, :, :]
    distance = np.sqrt((offset * offset).sum(axis=2))
    cost = [[(0, 0.0)] * (after + 1) for _ in range(before + 1)]
    for i in range(before - 1, -1, -1):
        for j in range(after - 1, -1, -1):
            best = min(cost[i + 1][j], cost[i][j + 1])
            if old_sign[i] == new_sign[j]:
                pairs, length = cost[i + 1][j + 1]
                best = min(best, (pairs - 1, length + float(distance[i, j])))
            cost[i][j] = best
    return _walk(cost, distance, old_sign, new_sign)


def _walk(
    cost: list[list[tuple[int, float]]],
    distance: FloatArray,
    old_sign: np.typing.NDArray[np.int8],
    new_sign: np.typing.NDArray[np.int8],
) -> list[tuple[int, int]]:
    """Read the best pairing off the table, taking a pair as early as it is as good."""
    i = j = 0
    pairs: list[tuple[int, int]] = []
    while i < len(old_sign) and j < len(new_sign):
        if old_sign[i] == new_sign[j]:
            count, length = cost[i + 1][j + 1]
            if (count - 1, length + float(distance[i, j])) == cost[i][j]:
                pairs.append((i, j))
                i, j = i + 1, j + 1
                continue
        if cost[i + 1][j] <= cost[i][j + 1]:
            i += 1
        else:
            j += 1
    return pairs


def curve_data(state: HullState, curves: IntArray) -> CurveData:
    """Gather the defining points, kinds and end conditions of curves.

    Parameters
    ----------
    state : HullState
        The tables.
    curves : (m,) int
        Numbers of the curves.

    Returns
    -------
    CurveData
        The curves in the order given.
    """
    table, numbers = state.curves, curves.tolist()
    rows = [table.rows.data[curve] for curve in numbers]
    ends = [table.ends.data[curve] for curve in numbers]
    row, start = np.concatenate(rows), np.zeros(len(rows) + 1, np.int64)
    np.cumsum([len(part) for part in rows], out=start[1:])
    part = 2 * row + np.concatenate([table.side.data[curve] for curve in numbers])
    points = state.rows
    return CurveData(
        start,
        points.xyz.data.take(row, axis=0),
        points.kind.data.reshape(-1).take(part),
        points.direction.take_parts(part),
        np.array([end.kind for end in ends], np.int8),
        np.array([end.vector for end in ends], np.float64),
    )


@attrs.frozen(eq=False)
class _Names(Sequence[str]):
    """What error messages call the curves; made when one is asked for."""

    state: HullState
    curves: IntArray

    def __len__(self) -> int:
        return len(self.curves)

    @overload
    def __getitem__(self, place: int) -> str: ...

    @overload
    def __getitem__(self, place: slice) -> Sequence[str]: ...

    def __getitem__(self, place: int | slice) -> str | Sequence[str]:
        if isinstance(place, slice):
            return _Names(self.state, self.curves[place])
        return AddressBook(self.state).curve_name(int(self.curves[place]))


def loft_curves(state: HullState, curves: IntArray) -> SplineBatch:
    """Loft curves from their defining points, in one batch.

    Raises
    ------
    TooFewPointsError, CoincidentPointsError, BadInputError
        Naming the curve.
    """
    return loft(curve_data(state, curves), _Names(state, curves))


_NO_NODES: IntArray = np.zeros(0, np.int64)
_MANY = 4096
"""The readers of more nodes are not kept: finding them is little beside evaluating them."""


def bits_differ(first: FloatArray, second: FloatArray) -> np.typing.NDArray[np.bool_]:
    """Tell for each row of two (k, 3) arrays whether a bit differs."""
    differs: np.typing.NDArray[np.bool_] = (first.view(np.int64) != second.view(np.int64)).any(
        axis=1
    )
    return differs


@attrs.define(eq=False)
class HullNetwork:
    """Implements `assoc_hull.graph.run_update.Network` on the tables of a hull.

    Attributes
    ----------
    state : HullState
        The tables.
    index : Index
        Look-ups derived from them.
    realigned : list of Alignment
        Curves whose meetings with their partners' planes changed in number or sign.
    before : dict of int to SplineBatch
        The splines of all curves evaluated so far, as they were before the first time.
    """

    state: HullState
    index: Index
    realigned: list[Alignment] = attrs.field(factory=list)
    before: dict[int, SplineBatch] = attrs.field(factory=dict)

    def level(self, nodes: IntArray) -> IntArray:
        """Give the level of each node."""
        number, odd = Node.number(nodes), Node.is_curve(nodes)
        found = np.empty(len(nodes), np.int64)
        found[odd] = 4 * self.index.level[number[odd]]
        rows = number[~odd]
        driver = self.state.rows.driver[rows]
        own = self.state.rows.curve[rows, 0]
        riding = driver < 0
        of = np.where(riding, own, driver)
        found[~odd] = 4 * self.index.level[of] + np.where(riding, -1, 1)
        return found

    def readers(self, nodes: IntArray) -> Readers:
        """Give the curves that points define, and the points computed from curves."""
        if len(nodes) > _MANY:
            return self._find_readers(nodes)
        depends_on = self.index, self.state.rows.reader
        return self.state.derived(
            ("readers", nodes.tobytes()), depends_on, lambda: self._find_readers(nodes)
        )

    def reached(self, seeds: IntArray) -> int:
        """Give how many curves are made from nodes, at any distance, these included."""
        return self.state.derived(
            ("reached", seeds.tobytes()),
            (self.index, self.state.rows.reader),
            lambda: int(Node.is_curve(closure(self, seeds)).sum()),
        )

    def _find_readers(self, nodes: IntArray) -> Readers:
        forms = nodes[Node.is_form(nodes)]
        points, curves = nodes[Node.is_point(nodes)], nodes[Node.is_curve(nodes)]
        pairs: list[tuple[IntArray, IntArray]] = []
        if len(points):
            rows = Node.number(points)
            reader = self.state.rows.reader.data.take(rows, axis=0)
            both = reader >= 0
            pairs.append((Node.curve(reader[both]), np.repeat(points, 2)[both.ravel()]))
            pairs += self._listed(points, rows, self.index.riders)
            pairs += self._listed(points, rows, self.index.makes)
        pairs += self._listed(curves, Node.number(curves), self.index.drives)
        pairs += self._listed(forms, Node.form_number(forms), self.index.forms)
        if len(pairs) == 1:
            return Readers(*pairs[0])
        return Readers(
            np.concatenate([first for first, _ in pairs]) if pairs else _NO_NODES,
            np.concatenate([second for _, second in pairs]) if pairs else _NO_NODES,
        )

    @staticmethod
    def _listed(
        nodes: IntArray, numbers: IntArray, table: dict[int, IntArray]
    ) -> list[tuple[IntArray, IntArray]]:
        if not table:
            return []
        pairs = zip(nodes.tolist(), numbers.tolist(), strict=True)
        hits = [(node, table[number]) for node, number in pairs if number in table]
        return [(Node.point(out), np.full(len(out), node)) for node, out in hits]

    def name(self, node: int) -> str:
        """Name a node by the key of its object."""
        if Node.is_form(node):
            return str(self.state.formed.definition[Node.form_number(node)].key)
        table = self.state.curves if Node.is_curve(node) else self.state.rows
        return str(table.key[Node.number(node)])

    def evaluate(self, nodes: IntArray, journal: Journal) -> Evaluation:
        """Evaluate curves, computed points, or riding and generated ones, as the nodes are."""
        numbers = Node.number(nodes)
        if Node.is_curve(int(nodes[0])):
            return self._curves(numbers, journal)
        if self.state.rows.driver[numbers[0]] >= 0:
            return self._computed(numbers, journal)
        rides = unmade_rows(self.state, numbers)
        if rides.all():
            return self._riding(numbers, journal)
        made = self._generated(numbers[~rides], journal)
        if not rides.any():
            return made
        rest = self._riding(numbers[rides], journal)
        return Evaluation(
            np.concatenate([rest.changed, made.changed]), np.concatenate([rest.moved, made.moved])
        )

    def _computed(self, rows: IntArray, journal: Journal) -> Evaluation:
        """Points computed from their driver: its meeting with the other line's plane."""
        table = self.state.rows
        side = (table.curve[rows, 0] != table.driver[rows]).astype(np.int64)
        return self._publish(rows, table.spot[rows, side], journal)

    def _riding(self, rows: IntArray, journal: Journal) -> Evaluation:
        """Adopted points ride: base + linear blend of the displacements of their anchors."""
        table = self.state.rows
        anchor = table.anchor[rows]
        shift = table.xyz[anchor] - table.anchor_from[rows]
        shift = np.where((anchor >= 0)[:, :, None], shift, 0.0)
        weight = table.anchor_weight[rows][:, None]
        value = table.base[rows] + ((1.0 - weight) * shift[:, 0] + weight * shift[:, 1])
        return self._publish(rows, value, journal)

    def _generated(self, rows: IntArray, journal: Journal) -> Evaluation:
        """Points of generated curves, as the definitions have them; one batch of curves."""
        owners = set(self.state.rows.curve[rows, 0].tolist())
        every, value = points_given(
            self.state,
            [made for curve, made in attached_curves(self.state).items() if curve in owners],
        )
        chosen = np.isin(every, rows)
        return self._publish(every[chosen], value[chosen], journal)

    def _publish(self, rows: IntArray, value: FloatArray, journal: Journal) -> Evaluation:
        """Write the points that differ by a bit from what is published."""
        old = self.state.rows.xyz[rows]
        value = np.ascontiguousarray(value)
        differs = bits_differ(old, value)
        journal.put(self.state.rows.xyz, rows[differs], value[differs])
        step = value[differs] - old[differs]
        moved = np.sqrt(step[:, 0] * step[:, 0] + step[:, 1] * step[:, 1] + step[:, 2] * step[:, 2])
        return Evaluation(Node.point(rows[differs]), moved)

    def _curves(self, curves: IntArray, journal: Journal) -> Evaluation:
        """Loft, meet the partners' planes, keep the identity of each meeting."""
        table, numbers = self.state.curves, curves.tolist()
        old = [table.spline.data[curve] for curve in numbers]
        batch = loft_curves(self.state, curves)
        splines = batch.single()
        found = cut_curves(self.state, self.index, curves, splines)
        for curve, spline in zip(numbers, old, strict=True):
            if spline is not None:
                self.before.setdefault(curve, spline)
        moved = moved_curves(old, splines, batch)
        journal.set(table.spline, numbers, splines)
        meets = self._identified(numbers, found)
        journal.set(table.meets, numbers, meets)
        self._write_spots(curves, found, meets, journal)
        differs = moved != 0.0
        return Evaluation(Node.curve(curves[differs]), moved[differs])

    def _identified(
        self, numbers: list[int], found: PartnerIntersections
    ) -> list[CurveIntersections]:
        """Give each meeting the crossing it is; a curve keeps its arrays where it can."""
        old = [self.state.curves.meets.data[curve] for curve in numbers]
        spans = list(pairwise(found.bounds))
        same = [b - a for a, b in spans] == [len(each.line) for each in old]
        same = same and np.array_equal(np.concatenate([each.line for each in old]), found.line)
        if same and np.array_equal(np.concatenate([each.sign for each in old]), found.sign):
            return [
                placed(each, found.parameter[a:b], found.xyz[a:b])
                for each, (a, b) in zip(old, spans, strict=True)
            ]
        return [
            self._aligned(curve, each, found.take(a, b))
            for curve, each, (a, b) in zip(numbers, old, spans, strict=True)
        ]

    def _aligned(
        self, curve: int, old: CurveIntersections, new: CurveIntersections
    ) -> CurveIntersections:
        """Say which crossing each meeting of a curve is; the rows of `new` are not known yet."""
        if np.array_equal(old.line, new.line) and np.array_equal(old.sign, new.sign):
            return placed(old, new.parameter, new.xyz)
        alignment = align_curve(curve, old, new)
        if alignment.gone.size or alignment.come.size:
            self.realigned.append(alignment)
        return attrs.evolve(new, row=alignment.row)

    def _write_spots(
        self,
        curves: IntArray,
        found: PartnerIntersections,
        meets: list[CurveIntersections],
        journal: Journal,
    ) -> None:
        """Write where crossings lie on curves; a batch may hold both curves of a crossing."""
        table, guess = self.state.rows, self.index.guess.reshape(-1)
        row = np.concatenate([each.row for each in meets])
        actual = np.flatnonzero(row >= 0)
        owner = curves[found.curve[actual]]
        part = 2 * row[actual] + (table.curve[row[actual], 0] != owner)
        pick = None if len(actual) == len(row) else actual
        journal.put_parts(table.spot, part, PickedRows(found.xyz, pick))
        journal.put_parts(table.parameter, part, PickedRows(found.parameter, pick))
        if len(guess) == 2 * table.count:
            guess[part] = found.segment[actual]


_set_line, _set_sign, _set_row, _set_parameter, _set_xyz = (
    getattr(CurveIntersections, field.name).__set__ for field in attrs.fields(CurveIntersections)
)


def placed(meets: CurveIntersections, parameter: FloatArray, xyz: FloatArray) -> CurveIntersections:
    """Give the same meetings at other places; the arrays are frozen already."""
    found = object.__new__(CurveIntersections)
    _set_line(found, meets.line)
    _set_sign(found, meets.sign)
    _set_row(found, meets.row)
    _set_parameter(found, parameter)
    _set_xyz(found, xyz)
    return found


def moved_curves(
    old: Sequence[SplineBatch | None], splines: Sequence[SplineBatch], batch: SplineBatch
) -> FloatArray:
    """Tell how far the points of each curve moved at most (m): 0 only if no bit changed."""
    was = [each for each in old if each is not None]
    before = SplineBatch.join(was) if len(was) == len(old) else None
    if before is None or not np.array_equal(before.start, batch.start):
        return np.array([moved_curve(a, b) for a, b in zip(old, splines, strict=True)])
    moved: FloatArray = np.maximum.reduceat(_distances(before.xyz, batch.xyz), batch.start[:-1])
    for still in np.flatnonzero(moved == 0.0).tolist():
        moved[still] = moved_curve(old[still], splines[still])
    return moved


def _distances(before: FloatArray, after: FloatArray) -> FloatArray:
    """Give how far points (n, 3) moved, (n,), m: 0 only if no bit changed."""
    step = np.abs(after - before)
    x, y, z = step.T
    # A square may vanish where the step does not.
    found: FloatArray = np.maximum(np.sqrt(x * x + y * y + z * z), step.max(axis=1))
    return found


def moved_curve(before: SplineBatch | None, after: SplineBatch) -> float:
    """Tell how far the points of a curve moved at most (m); nan where it has others now."""
    if before is None or len(before.knot) != len(after.knot):
        return float("nan")
    step = float(_distances(before.xyz, after.xyz).max())
    if step == 0.0 and not np.array_equal(before.leave, after.leave):
        return float(np.abs(after.leave - before.leave).max())
    return step
