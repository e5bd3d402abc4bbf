"""The hull as a network of nodes: curves read their points, computed points read a curve.

Definitions by form parameters are nodes below nil, of which nothing but the edit writes the
value; generated points read them, and those of sections the ends of their curve as well.

Levels: a curve of level L in the graph of driven links is evaluated at 4 L, the points
computed from it at 4 L + 1, and adopted points that ride with such points, as generated ones,
one below the level of their own curve. A curve and a waterline that nothing drives are thus
lofted in one batch.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.graph.journal import Journal, PickedRows
from assoc_hull.graph.network import Evaluation, Readers, closure
from assoc_hull.model.align_intersections import Alignment, align_curve
from assoc_hull.model.generated_curves import attached_curves, points_given, unmade_rows
from assoc_hull.model.index import Index
from assoc_hull.model.lofting import loft_curves
from assoc_hull.model.node import Node
from assoc_hull.model.plane_intersections import PartnerIntersections, cut_curves
from assoc_hull.model.tables import CurveIntersections, HullState

__all__ = ["HullNetwork", "bits_differ", "moved_curve", "moved_curves", "placed"]

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
    """Implements `assoc_hull.graph.network.Network` on the tables of a hull.

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
