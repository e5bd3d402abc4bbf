"""The hull as a network of nodes: curves read their points, computed points read a curve.

Definitions by form parameters are nodes below nil, of which nothing but the edit writes the
value; generated points read them, and those of sections the ends of their curve as well.

Levels: a curve of level L in the graph of driven links is evaluated at 4 L, the points
computed from it at 4 L + 1, and adopted points that ride with such points, as generated ones,
one below the level of their own curve. A curve and a waterline that nothing drives are thus
lofted in one batch.
"""

from __future__ import annotations

from itertools import pairwise

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.graph.journal import Journal, PickedRows
from assoc_hull.graph.network import Evaluation, Readers, closure
from assoc_hull.model.align_intersections import Alignment, align_curve
from assoc_hull.model.generated_curves import attached_curves, points_given, unmade_rows
from assoc_hull.model.index import Index
from assoc_hull.model.lofting import loft_curves, remember
from assoc_hull.model.node import Node
from assoc_hull.model.plane_intersections import LastIntersections, PartnerIntersections, cut_curves
from assoc_hull.model.tables import CurveIntersections, HullState

__all__ = ["HullNetwork", "bits_differ", "moved_curves", "placed"]

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
        table, numbers, recall = self.state.curves, curves.tolist(), self.index.recall
        key = curves.tobytes()
        old = [table.spline.data[curve] for curve in numbers]
        met = [table.meets.data[curve] for curve in numbers]
        recalled = recall.get(key)
        last = recalled if isinstance(recalled, LastIntersections) else None
        known = last if last is not None and last.holds(old, met) else None
        batch = loft_curves(self.state, curves, keep=True)
        splines = batch.single()
        found = cut_curves(self.state, self.index, curves, splines, known.found if known else None)
        for curve, spline in zip(numbers, old, strict=True):
            if spline is not None:
                self.before.setdefault(curve, spline)
        moved = moved_curves(old, known.batch if known else None, splines, batch)
        journal.set(table.spline, numbers, splines)
        now = self._attach(numbers, met, splines, batch, found, known)
        journal.set(table.meets, numbers, now.meets)
        self._write_spots(now, known, journal)
        if last is not None:
            last.spot.release()
            last.at.release()
        remember(recall, key, now)
        differs = moved != 0.0
        return Evaluation(Node.curve(curves[differs]), moved[differs])

    def _attach(
        self,
        numbers: list[int],
        old: list[CurveIntersections],
        splines: list[SplineBatch],
        batch: SplineBatch,
        found: PartnerIntersections,
        known: LastIntersections | None,
    ) -> LastIntersections:
        """Give each meeting the crossing it is: at once where lines and signs are as before."""
        at, xyz, spans = found.parameter, found.xyz, list(pairwise(found.bounds))
        if known is not None and found.line is known.found.line:
            meets = [
                placed(each, at[a:b], xyz[a:b]) for each, (a, b) in zip(old, spans, strict=True)
            ]
            row, actual, part = known.row, known.actual, known.part
        else:
            row = self._identify(numbers, old, found)
            freeze(row)
            meets = [
                CurveIntersections(found.line[a:b], found.sign[a:b], row[a:b], at[a:b], xyz[a:b])
                for a, b in spans
            ]
            actual = np.flatnonzero(row >= 0)
            owner = np.array(numbers, np.int64)[found.curve[actual]]
            part = 2 * row[actual] + (self.state.rows.curve[row[actual], 0] != owner)
            actual = None if len(actual) == len(row) else actual
        spot, place = PickedRows(found.xyz, actual), PickedRows(found.parameter, actual)
        return LastIntersections(splines, meets, batch, found, row, actual, part, spot, place)

    def _write_spots(
        self, now: LastIntersections, known: LastIntersections | None, journal: Journal
    ) -> None:
        """Write where crossings lie on curves; a batch may hold both curves of a crossing."""
        table, guess = self.state.rows, self.index.guess.reshape(-1)
        before = known if known is not None and known.part is now.part else None
        for column, new, old in (
            (table.spot, now.spot, before.spot if before else None),
            (table.parameter, now.at, before.at if before else None),
        ):
            new.take()
            journal.put_parts(column, now.part, new, old)
        if len(guess) == 2 * table.count:
            segment = now.found.segment
            guess[now.part] = segment if now.actual is None else segment.take(now.actual)

    def _identify(
        self, numbers: list[int], old: list[CurveIntersections], found: PartnerIntersections
    ) -> IntArray:
        """Say which crossing each meeting is, curve by curve where lines or signs changed."""
        line = np.concatenate([meets.line for meets in old])
        sign = np.concatenate([meets.sign for meets in old])
        counts = [len(meets.line) for meets in old]
        bounds = found.bounds
        same = [b - a for a, b in pairwise(bounds)] == counts
        if same and np.array_equal(line, found.line) and np.array_equal(sign, found.sign):
            return np.concatenate([meets.row for meets in old])
        parts: list[IntArray] = []
        for i, curve in enumerate(numbers):
            span = slice(bounds[i], bounds[i + 1])
            new = CurveIntersections(
                found.line[span].copy(),
                found.sign[span].copy(),
                np.full(span.stop - span.start, -1),
                found.parameter[span].copy(),
                found.xyz[span].copy(),
            )
            alignment = align_curve(curve, old[i], new)
            if alignment.gone.size or alignment.come.size:
                self.realigned.append(alignment)
            parts.append(alignment.row)
        return np.concatenate(parts)


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
    old: list[SplineBatch | None],
    before: SplineBatch | None,
    splines: list[SplineBatch],
    batch: SplineBatch,
) -> FloatArray:
    """Tell how far the defining points of each curve moved (m): 0 only if no bit changed."""
    was = [each for each in old if each is not None]
    if before is None and len(was) == len(old):
        before = SplineBatch.join(was)
    if before is None or not np.array_equal(before.start, batch.start):
        return np.array([_moved_one(a, b) for a, b in zip(old, splines, strict=True)])
    step = np.abs(batch.xyz.T - before.xyz.T)
    moved: FloatArray = np.maximum.reduceat(step.max(axis=0), batch.start[:-1])
    for still in np.flatnonzero(moved == 0.0).tolist():
        moved[still] = _moved_one(old[still], splines[still])
    return moved


def _moved_one(before: SplineBatch | None, after: SplineBatch) -> float:
    if before is None or len(before.knot) != len(after.knot):
        return float("nan")
    step = float(np.abs(after.xyz - before.xyz).max())
    if step == 0.0 and not np.array_equal(before.leave, after.leave):
        return float(np.abs(after.leave - before.leave).max())
    return step
