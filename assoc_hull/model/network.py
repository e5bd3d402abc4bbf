"""The hull as a network of nodes: curves read their points, computed points read a curve.

Levels: a curve of level L in the graph of driven links is evaluated at 4 L, the points
computed from it at 4 L + 1, and adopted points that ride with such points one below the
level of their own curve. A curve and a waterline that nothing drives are thus lofted in one
batch.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.crossing import meet_planes
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.graph.journal import Journal
from assoc_hull.graph.node import Evaluation, Readers
from assoc_hull.model.align import Alignment, align_curve
from assoc_hull.model.index import Index, PlaneSet
from assoc_hull.model.recipe import loft_curves
from assoc_hull.model.state import HullState, Meets, curve_node, row_node

__all__ = ["HullNetwork", "bits_differ"]


def bits_differ(first: FloatArray, second: FloatArray) -> np.typing.NDArray[np.bool_]:
    """Tell for each row of two (k, 3) arrays whether a bit differs."""
    return (first.view(np.int64) != second.view(np.int64)).any(axis=1)


@attrs.frozen(eq=False)
class _Found:
    """Meetings of a batch of curves, sorted by curve, then as in `Meets`."""

    curve: IntArray
    line: IntArray
    sign: np.typing.NDArray[np.int8]
    parameter: FloatArray
    xyz: FloatArray


@attrs.define(eq=False)
class HullNetwork:
    """Implements `assoc_hull.graph.node.Network` on the tables of a hull.

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
        number, odd = nodes >> 1, (nodes & 1).astype(bool)
        found = np.empty(len(nodes), np.int64)
        found[odd] = 4 * self.index.level[number[odd]]
        rows = number[~odd]
        driver = self.state.rows.driver.data[rows]
        own = self.state.rows.curve.data[rows, 0]
        riding = driver < 0
        of = np.where(riding, own, driver)
        found[~odd] = 4 * self.index.level[of] + np.where(riding, -1, 1)
        return found

    def readers(self, nodes: IntArray) -> Readers:
        """Give the curves that points define, and the points computed from curves."""
        rows = (nodes[(nodes & 1) == 0]) >> 1
        reader = self.state.rows.reader.data[rows]
        both = reader >= 0
        pairs = [(curve_node(reader[both]), np.repeat(row_node(rows), 2)[both.ravel()])]
        pairs += self._listed(rows, self.index.riders, row_node) if self.index.riders else []
        curves = (nodes[(nodes & 1) == 1]) >> 1
        pairs += self._listed(curves, self.index.drives, curve_node)
        return Readers(
            np.concatenate([first for first, _ in pairs]),
            np.concatenate([second for _, second in pairs]),
        )

    @staticmethod
    def _listed(
        items: IntArray, table: dict[int, IntArray], node: object
    ) -> list[tuple[IntArray, IntArray]]:
        hits = [(item, table[item]) for item in items.tolist() if item in table]
        source = row_node if node is row_node else curve_node
        return [(row_node(out), np.full(len(out), int(source(np.int64(item))))) for item, out in hits]

    def name(self, node: int) -> str:
        """Name a node by the key of its object."""
        table = self.state.curves if node & 1 else self.state.rows
        return str(table.key.data[node >> 1])

    def evaluate(self, nodes: IntArray, journal: Journal) -> Evaluation:
        """Evaluate curves, computed points or riding points, whichever the nodes are."""
        numbers = nodes >> 1
        if nodes[0] & 1:
            return self._curves(numbers, journal)
        if self.state.rows.driver.data[numbers[0]] >= 0:
            return self._computed(numbers, journal)
        return self._riding(numbers, journal)

    def _computed(self, rows: IntArray, journal: Journal) -> Evaluation:
        """Points computed from their driver: its meeting with the other line's plane."""
        table = self.state.rows
        side = (table.curve.data[rows, 0] != table.driver.data[rows]).astype(np.int64)
        return self._publish(rows, table.spot.data[rows, side], journal)

    def _riding(self, rows: IntArray, journal: Journal) -> Evaluation:
        """Adopted points ride: base + linear blend of the displacements of their anchors."""
        table = self.state.rows
        anchor = table.anchor.data[rows]
        shift = table.xyz.data[anchor] - table.anchor_from.data[rows]
        shift = np.where((anchor >= 0)[:, :, None], shift, 0.0)
        weight = table.anchor_weight.data[rows][:, None]
        value = table.base.data[rows] + ((1.0 - weight) * shift[:, 0] + weight * shift[:, 1])
        return self._publish(rows, value, journal)

    def _publish(self, rows: IntArray, value: FloatArray, journal: Journal) -> Evaluation:
        """Write the points that differ by a bit from what is published."""
        old = self.state.rows.xyz.data[rows]
        value = np.ascontiguousarray(value)
        differs = bits_differ(old, value)
        journal.put(self.state.rows.xyz, rows[differs], value[differs])
        step = value[differs] - old[differs]
        moved = np.sqrt(step[:, 0] * step[:, 0] + step[:, 1] * step[:, 1] + step[:, 2] * step[:, 2])
        return Evaluation(row_node(rows[differs]), moved)

    def _curves(self, curves: IntArray, journal: Journal) -> Evaluation:
        """Loft, meet the partners' planes, keep the identity of each meeting."""
        batch = loft_curves(self.state, curves)
        found = self._meet(curves, batch)
        splines = [batch.curve(i) for i in range(len(curves))]
        old = [self.state.curves.spline.data[curve] for curve in curves.tolist()]
        for curve, spline in zip(curves.tolist(), old, strict=True):
            if spline is not None:
                self.before.setdefault(curve, spline)
        pairs = [_moved(before, after) for before, after in zip(old, splines, strict=True)]
        moved = np.array(pairs)
        journal.set(self.state.curves.spline, curves.tolist(), splines)
        self._attach(curves, found, journal)
        differs = moved != 0.0
        return Evaluation(curve_node(curves[differs]), moved[differs])

    def _meet(self, curves: IntArray, batch: SplineBatch) -> _Found:
        groups = self.state.lines.group.data[self.state.curves.line.data[curves]]
        parts: list[_Found] = []
        for group in np.unique(groups).tolist():
            mine = np.flatnonzero(groups == group)
            whole = len(mine) == len(curves)
            sub = batch if whole else SplineBatch.join([batch.curve(i) for i in mine.tolist()])
            parts += [self._cut(curves, mine, sub, p) for p in self.index.partners.get(group, ())]
        if len(parts) == 1:
            return parts[0]
        if not parts:
            none = Meets.none()
            return _Found(none.line, none.line, none.sign, none.parameter, none.xyz)
        curve = np.concatenate([part.curve for part in parts])
        order = np.argsort(curve, kind="stable")
        return _Found(
            curve[order],
            np.concatenate([part.line for part in parts])[order],
            np.concatenate([part.sign for part in parts])[order],
            np.concatenate([part.parameter for part in parts])[order],
            np.concatenate([part.xyz for part in parts])[order],
        )

    def _cut(self, curves: IntArray, mine: IntArray, sub: SplineBatch, planes: PlaneSet) -> _Found:
        """Meet one set of planes; the place lies exactly in the curve's own plane too."""
        met = meet_planes(sub, planes.normal, planes.offsets)
        local = mine[met.curve]
        xyz = met.xyz.copy()
        lines = self.state.lines
        own = lines.normal.data[self.state.curves.line.data[curves[local]]]
        level = lines.offset.data[self.state.curves.line.data[curves[local]]]
        exact = own == 1.0
        xyz[exact] = np.broadcast_to(level[:, None], xyz.shape)[exact]
        return _Found(local, planes.lines[met.plane], met.sign, met.t, xyz)

    def _attach(self, curves: IntArray, found: _Found, journal: Journal) -> None:
        """Give each meeting the crossing it is, and write where the crossing now lies."""
        numbers = curves.tolist()
        old = [self.state.curves.meets.data[curve] for curve in numbers]
        first = np.searchsorted(found.curve, np.arange(len(numbers) + 1))
        row = self._identify(numbers, old, found, first)
        spans = list(zip(first[:-1].tolist(), first[1:].tolist(), strict=True))
        journal.set(
            self.state.curves.meets,
            numbers,
            [
                Meets(found.line[a:b], found.sign[a:b], row[a:b], found.parameter[a:b], found.xyz[a:b])
                for a, b in spans
            ],
        )
        actual = row >= 0
        rows, owner = row[actual], curves[found.curve[actual]]
        self._write_spots(rows, owner, found.xyz[actual], found.parameter[actual], journal)

    def _write_spots(
        self, rows: IntArray, owner: IntArray, xyz: FloatArray, at: FloatArray, journal: Journal
    ) -> None:
        """Write where crossings lie on curves; a batch may hold both curves of a crossing."""
        table = self.state.rows
        side = (table.curve.data[rows, 0] != owner).astype(np.int64)
        for which in (0, 1):
            mine = side == which
            if not mine.any():
                continue
            spot = table.spot.data[rows[mine]].copy()
            spot[:, which] = xyz[mine]
            journal.put(table.spot, rows[mine], spot)
            parameter = table.parameter.data[rows[mine]].copy()
            parameter[:, which] = at[mine]
            journal.put(table.parameter, rows[mine], parameter)

    def _identify(
        self, numbers: list[int], old: list[Meets], found: _Found, first: IntArray
    ) -> IntArray:
        """Say which crossing each meeting is: at once where lines and signs are as before."""
        line = np.concatenate([meets.line for meets in old])
        sign = np.concatenate([meets.sign for meets in old])
        row = np.concatenate([meets.row for meets in old])
        counts = [len(meets.line) for meets in old]
        same = np.array_equal(np.diff(first), counts)
        if same and np.array_equal(line, found.line) and np.array_equal(sign, found.sign):
            return row
        parts: list[IntArray] = []
        for i, curve in enumerate(numbers):
            span = slice(int(first[i]), int(first[i + 1]))
            new = Meets(
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


def _moved(before: SplineBatch | None, after: SplineBatch) -> float:
    """Tell how far the defining points moved (m): 0 only if no bit of the spline changed."""
    if before is None or len(before.knot) != len(after.knot):
        return float("nan")
    step = float(np.abs(after.xyz - before.xyz).max())
    if step == 0.0 and not np.array_equal(before.leave, after.leave):
        return float(np.abs(after.leave - before.leave).max())
    return step
