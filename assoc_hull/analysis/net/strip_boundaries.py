"""What bounds the hull between two sections: closed loops of sections and boundary curves.

Boundary curves are cut where sections stand (`boundary_arcs`); the arcs of a slab, the space
between two neighbouring planes, are followed round (`strip_boundaries`). A loop is split into two
*rails* across the ship and two *sides* along it. A rail may have several parts: where a section has
come apart (a bulb below a stem), the stem between its pieces belongs to the rail.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.analysis.net.curve_net import CurveNet, CurvePart
from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.numeric.polynomials import horner
from assoc_hull.geometry.numeric.roots import unit_roots
from assoc_hull.geometry.splines.evaluation import evaluate
from assoc_hull.geometry.splines.segments import bezier_points, power_coefficients

__all__ = [
    "BoundaryArc",
    "StripBoundary",
    "UnboundedCurves",
    "boundary_arcs",
    "closes_end",
    "strip_boundaries",
]

# --------------------------------------------------------------------------------------
# Boundary curves, cut where sections stand.

_SAME = 1e-3
"""Curves in one plane whose ends lie this near (m) are one."""

_KNUCKLE = 1e-9
"""Derivatives that differ by more at a knot have a corner between them."""


@attrs.frozen
class BoundaryArc:
    """A part of a curve that bounds the hull between two planes.

    Attributes
    ----------
    part : (int, float, float)
        Curve of the net, and the parameters (m) between which it runs.
    slab : int
        Between the planes `slab` - 1 and `slab`; -1 for an arc that lies on a plane.
    plane : int
        The plane it lies on; -1 for an arc between planes.
    """

    part: CurvePart
    slab: int
    plane: int


def boundary_arcs(net: CurveNet, x: FloatArray) -> list[BoundaryArc]:
    """Cut all boundary curves at which the hull ends at the planes x (p,), m; add the sections.

    A section that a transom or another end covers is left out: there the hull ends. So is one that
    begins or ends on a raked transom.
    """
    found: list[BoundaryArc] = []
    ends = _covering(net)
    for curve in range(net.batch.count):
        if net.end[curve]:
            found += _cut(net, curve, x)
        elif (
            np.isfinite(net.x[curve])
            and not net.ends_on_transom[curve]
            and not _covered(net, curve, ends)
        ):
            found.append(
                BoundaryArc((curve, 0.0, net.length(curve)), -1, _nearest(x, net.x[curve]))
            )
    return found


def _covering(net: CurveNet) -> FloatArray:
    """Give first and last points of the ends in transverse planes, (k, 2, 3), m."""
    chosen = np.flatnonzero(net.end & np.isfinite(net.x))
    start = net.batch.start
    return np.stack([net.batch.xyz[start[chosen]], net.batch.xyz[start[chosen + 1] - 1]], axis=1)


def _covered(net: CurveNet, curve: int, ends: FloatArray) -> bool:
    """Tell whether a section begins and ends where such an end does."""
    own = net.batch.xyz[[net.batch.start[curve], net.batch.start[curve + 1] - 1]]
    away = [np.abs(ends - each).max(axis=(1, 2), initial=0.0) for each in (own, own[::-1])]
    return bool(len(ends)) and float(np.min(away)) <= net.factor * _SAME


def _nearest(x: FloatArray, place: float) -> int:
    return int(np.abs(x - place).argmin())


def _cut(net: CurveNet, curve: int, x: FloatArray) -> list[BoundaryArc]:
    """Cut one boundary curve at the planes and at its corners."""
    one = net.batch.part(curve, curve + 1)
    edge = _edges(one, x, net.on_plane)
    middle = 0.5 * (edge[1:] + edge[:-1])
    place = _x_at(one, np.concatenate([edge, middle]))
    at, between = place[: len(edge)], place[len(edge) :]
    found = []
    for i, (begin, finish) in enumerate(zip(edge[:-1].tolist(), edge[1:].tolist(), strict=True)):
        near = _nearest(x, float(between[i])) if len(x) else -1
        spread = np.abs(np.array([at[i], between[i], at[i + 1]]) - x[near]).max()
        plane = near if spread <= net.on_plane else -1
        slab = -1 if plane >= 0 else int(np.searchsorted(x, between[i]))
        found.append(BoundaryArc((curve, begin, finish), slab, plane))
    return found


def _edges(one: SplineBatch, x: FloatArray, near: float) -> FloatArray:
    """Give the parameters at which a curve passes the planes or has a corner, with its ends.

    Knots on a plane are taken as they are; roots next to them are the same point, found again.
    """
    cubic, control = power_coefficients(one)[:, :, 0], bezier_points(one)[:, :, 0]
    low, high = control.min(axis=1), control.max(axis=1)
    segment, plane = np.nonzero((low[:, None] <= x) & (high[:, None] >= x))
    shifted = cubic[segment].copy()
    shifted[:, 0] -= x[plane]
    roots = unit_roots(shifted)
    roots = np.where(np.abs(horner(shifted, roots)) <= near, roots, np.nan)
    step = np.diff(one.knot)[segment]
    at = (one.knot[segment][:, None] + roots * step[:, None]).ravel()
    corner = np.flatnonzero(np.abs(one.leave - one.arrive).max(axis=1) > _KNUCKLE)
    on = np.flatnonzero((np.abs(one.xyz[:, 0][:, None] - x) <= near).any(axis=1))
    fixed = np.unique(np.concatenate([one.knot[[0, -1]], one.knot[corner], one.knot[on]]))
    at = at[np.isfinite(at)]
    apart = np.abs(at[:, None] - fixed).min(axis=1) > 10.0 * near
    every = np.sort(np.concatenate([fixed, at[apart]]))
    edges: FloatArray = every[np.diff(every, prepend=-np.inf) > 10.0 * near]
    return edges


def _x_at(one: SplineBatch, t: FloatArray) -> FloatArray:
    found: FloatArray = evaluate(one, np.zeros(len(t), np.int64), t)[:, 0]
    return found


# --------------------------------------------------------------------------------------
# Loops between two planes, and their rails and sides.

_NEAR = 1e-4
"""Ends of curves this near to one another, in lengths of the ship, are one node."""

_KEEL = 2.0
"""A boundary curve that runs this many times more forward than up is keel, not stem."""


@attrs.frozen
class StripBoundary:
    """The boundary of one strip; parts run from keel to deck, and from aft forward.

    Attributes
    ----------
    aft, fore : tuple of CurvePart
        The rails.
    keel, deck : tuple of CurvePart
        The sides; none where the rails end in one point, or nothing is drawn between them.
    slab : int
        The slab.
    plane : bool
        Both rails lie wholly in planes across the ship.
    across : bool
        Both rails are sections or transoms, though these may rake.
    """

    aft: tuple[CurvePart, ...]
    fore: tuple[CurvePart, ...]
    keel: tuple[CurvePart, ...]
    deck: tuple[CurvePart, ...]
    slab: int
    plane: bool
    across: bool = False


@attrs.frozen
class UnboundedCurves:
    """Curves between two planes that bound nothing that could be understood.

    Attributes
    ----------
    names : tuple of str
        The lines.
    slab : int
        The slab.
    why : str
        What is wrong with them.
    """

    names: tuple[str, ...]
    slab: int
    why: str


@attrs.frozen(eq=False)
class _Edge:
    """An arc with its ends as numbers of nodes.

    `kind` is A (on the plane aft), F (on the plane forward) or E (between them); `closing` arcs
    are those that may close an end of the ship: the profile, a transom; not a deck edge.
    """

    part: CurvePart
    kind: str
    begin: int
    finish: int
    closing: bool
    first: FloatArray
    last: FloatArray

    def turned(self) -> _Edge:
        """Give the edge the other way round."""
        curve, t0, t1 = self.part
        return _Edge(
            (curve, t1, t0), self.kind, self.finish, self.begin, self.closing, self.last, self.first
        )


def strip_boundaries(
    net: CurveNet, arcs: Sequence[BoundaryArc], count: int, length: float
) -> tuple[list[StripBoundary], list[UnboundedCurves]]:
    """Find the strips in all slabs of `count` planes, and curves that bound none; `length` in m."""
    begin = _places(net, [(arc.part[0], arc.part[1]) for arc in arcs])
    finish = _places(net, [(arc.part[0], arc.part[2]) for arc in arcs])
    found: list[StripBoundary] = []
    lost: list[UnboundedCurves] = []
    for slab in range(count + 1):
        kinds = {slab - 1: "A", slab: "F"}
        chosen = [
            (i, "E" if arc.plane < 0 else kinds[arc.plane])
            for i, arc in enumerate(arcs)
            if arc.slab == slab or (arc.plane >= 0 and arc.plane in kinds)
        ]
        if not any(kind != "E" for _, kind in chosen):
            continue
        edges = _joined(net, arcs, chosen, begin, finish, _NEAR * length)
        for loop in _loops(_pruned(edges)):
            frame = _frame(net, loop, slab)
            if isinstance(frame, StripBoundary):
                found.append(frame)
            elif frame is not None:
                lost.append(frame)
    return found, lost


def _places(net: CurveNet, where: Sequence[tuple[int, float]]) -> FloatArray:
    curve = np.array([each[0] for each in where], np.int64)
    return evaluate(net.batch, curve, np.array([each[1] for each in where]))


def _joined(
    net: CurveNet,
    arcs: Sequence[BoundaryArc],
    chosen: Sequence[tuple[int, str]],
    begin: FloatArray,
    finish: FloatArray,
    near: float,
) -> list[_Edge]:
    """Give the chosen arcs as edges; ends within `near` (m) of each other share a node."""
    node: list[FloatArray] = []

    def number(place: FloatArray) -> int:
        if node:
            away = np.abs(np.array(node) - place).max(axis=1)
            if float(away.min()) <= near:
                return int(away.argmin())
        node.append(place)
        return len(node) - 1

    edges = []
    for i, kind in chosen:
        edge = _Edge(
            arcs[i].part, kind, number(begin[i]), number(finish[i]),
            closes_end(net, arcs[i].part[0]), begin[i], finish[i],
        )  # fmt: skip
        if edge.begin != edge.finish or not net.end[arcs[i].part[0]]:
            edges.append(edge)
    return edges


def closes_end(net: CurveNet, curve: int) -> bool:
    """Tell whether a curve may close an end of the ship: the profile, or the edge of a transom.

    Others at which the hull ends are deck edges.
    """
    closes = net.centre[curve] or np.isfinite(net.x[curve]) or net.transom[curve]
    return bool(net.end[curve] and closes)


def _pruned(edges: list[_Edge]) -> list[_Edge]:
    """Leave out boundary curves that end nowhere, and join loose ends of sections straight.

    Leaving out one may set another free, hence the loop.
    """
    edges = edges + _capping(edges, _degrees(edges))
    while True:
        degree = _degrees(edges)
        kept = [
            edge
            for edge in edges
            if min(degree[edge.begin], degree[edge.finish]) > 1 or _is_section(edge)
        ]
        if len(kept) == len(edges):
            return edges + _closing(edges, degree)
        edges = kept


def _capping(edges: Sequence[_Edge], degree: dict[int, int]) -> list[_Edge]:
    """Join a stem or stern that no deck edge reaches to the last section's upper end, straight.

    Else the hull beyond the last section would be lost where no deck edge is drawn.
    """
    if {edge.kind for edge in edges} >= {"A", "F"}:
        return []
    tops = [_upper(edge) for edge in edges if _is_section(edge)]
    stems = [_upper(edge) for edge in edges if edge.kind == "E" and edge.closing]
    loose = [[each for each in ends if degree[each[0]] == 1] for ends in (tops, stems)]
    if not loose[0] or not loose[1]:
        return []
    (top, place), (stem, there) = (max(ends, key=lambda each: float(each[1][2])) for ends in loose)
    return [_Edge((-1, 0.0, 0.0), "E", top, stem, False, place, there)]


def _upper(edge: _Edge) -> tuple[int, FloatArray]:
    """Give the upper end of an edge."""
    if edge.last[2] >= edge.first[2]:
        return edge.finish, edge.last
    return edge.begin, edge.first


def _is_section(edge: _Edge) -> bool:
    return edge.kind != "E" and not edge.closing


def _degrees(edges: Sequence[_Edge]) -> dict[int, int]:
    degree: dict[int, int] = {}
    for edge in edges:
        for node in (edge.begin, edge.finish):
            degree[node] = degree.get(node, 0) + 1
    return degree


def _closing(edges: Sequence[_Edge], degree: dict[int, int]) -> list[_Edge]:
    """Join loose ends on the two planes in pairs, the nearest first; upper ends with upper ones."""
    loose: dict[str, list[tuple[int, FloatArray, bool]]] = {"A": [], "F": []}
    for edge in edges:
        if edge.kind == "E":
            continue
        for node, place, other in (
            (edge.begin, edge.first, edge.last),
            (edge.finish, edge.last, edge.first),
        ):
            if degree[node] == 1:
                loose[edge.kind].append((node, place, bool(place[2] >= other[2])))
    pairs = sorted(
        (float(np.abs(a[1] - f[1]).max()), i, j)
        for i, a in enumerate(loose["A"])
        for j, f in enumerate(loose["F"])
        if a[2] == f[2]
    )
    added, used = [], set()
    for _, i, j in pairs:
        if ("A", i) in used or ("F", j) in used:
            continue
        used |= {("A", i), ("F", j)}
        a, f = loose["A"][i], loose["F"][j]
        added.append(_Edge((-1, 0.0, 0.0), "E", a[0], f[0], False, a[1], f[1]))
    return added


def _loops(edges: Sequence[_Edge]) -> list[list[_Edge]]:
    """Follow the edges round; runs that do not close, or branch, are given as they are."""
    left = list(range(len(edges)))
    found = []
    while left:
        run = [edges[left.pop(0)]]
        while run[-1].finish != run[0].begin:
            at = run[-1].finish
            step = [i for i in left if at in (edges[i].begin, edges[i].finish)]
            if len(step) != 1:
                break
            left.remove(step[0])
            edge = edges[step[0]]
            run.append(edge if edge.begin == at else edge.turned())
        found.append(run)
    return found


def _frame(net: CurveNet, loop: list[_Edge], slab: int) -> StripBoundary | UnboundedCurves | None:
    """Split a closed loop into rails and sides; None for what bounds nothing."""
    # Straight joins across gaps are no curves of the net.
    names = tuple(dict.fromkeys(net.name[edge.part[0]] for edge in loop if edge.part[0] >= 0))
    if loop[-1].finish != loop[0].begin:
        if all(edge.kind != "F" for edge in loop) or all(edge.kind != "A" for edge in loop):
            return None  # the last section of an open end: a face, or nothing behind it
        return UnboundedCurves(names, slab, "they do not close")
    kinds = {edge.kind for edge in loop}
    if kinds == {"E"}:
        return None
    if {"A", "F"} <= kinds:
        parts = _between(loop)
    else:
        parts = _at_an_end(net, loop, "A" if "A" in kinds else "F")
    if parts is None:
        return UnboundedCurves(names, slab, "sections and boundary curves alternate")
    aft, deck, fore, keel = parts
    # Without a second rail it has no extent along the ship.
    if not aft or not fore:
        return None
    return _upward(net, aft, fore, keel, deck, slab)


def _between(loop: list[_Edge]) -> tuple[list[_Edge], list[_Edge], list[_Edge], list[_Edge]] | None:
    """Split a run with sections on both planes: aft rail, side, fore rail (turned), side."""
    stands = [i for i, edge in enumerate(loop) if edge.kind != "E"]
    turns = [
        i
        for i, j in zip(stands, stands[-1:] + stands[:-1], strict=True)
        if loop[i].kind == "A" and loop[j].kind == "F"
    ]
    if len(turns) != 1:
        return None
    run = loop[turns[0] :] + loop[: turns[0]]
    last_a = max(i for i, edge in enumerate(run) if edge.kind == "A")
    first_f = min(i for i, edge in enumerate(run) if edge.kind == "F")
    last_f = max(i for i, edge in enumerate(run) if edge.kind == "F")
    aft, side = run[: last_a + 1], run[last_a + 1 : first_f]
    fore, back = run[first_f : last_f + 1], run[last_f + 1 :]
    return aft, side, _turned(fore), _turned(back)


def _at_an_end(
    net: CurveNet, loop: list[_Edge], kind: str
) -> tuple[list[_Edge], list[_Edge], list[_Edge], list[_Edge]] | None:
    """Split a run with sections on one plane: stem or stern is the other rail."""
    stands = [i for i, edge in enumerate(loop) if edge.kind == kind]
    size = len(loop)
    gaps = [((j - i - 1) % size, j) for i, j in zip(stands[-1:] + stands[:-1], stands, strict=True)]
    # The longest run without sections is the end itself; the rail begins behind it.
    begin = max(gaps)[1]
    run = loop[begin:] + loop[:begin]
    last = max(i for i, edge in enumerate(run) if edge.kind == kind)
    rail, rest = run[: last + 1], run[last + 1 :]
    side, middle, back = _stem(rest, net.on_plane)
    if kind == "A":
        return rail, side, _turned(middle), _turned(back)
    # The section is the fore rail: sides run from stern to section.
    return _turned(middle), _turned(side), rail, back


def _stem(rest: list[_Edge], near: float) -> tuple[list[_Edge], list[_Edge], list[_Edge]]:
    """Split the run that closes an end into deck edge, stem (or stern, transom) and keel.

    A transverse edge is the rail itself; else it is what closes, without its flat ends.
    """
    upright = [i for i, edge in enumerate(rest) if edge.closing and _is_upright(edge, near)]
    if upright:
        return rest[: upright[0]], rest[upright[0] : upright[-1] + 1], rest[upright[-1] + 1 :]
    first, last = 0, len(rest)
    if any(edge.closing for edge in rest):
        while first < last and not rest[first].closing:
            first += 1
        while last > first and not rest[last - 1].closing:
            last -= 1
    # One edge stays, flat or not: it is the rail.
    while last - first > 1 and _flat(rest[last - 1]):
        last -= 1
    while last - first > 1 and _flat(rest[first]):
        first += 1
    return rest[:first], rest[first:last], rest[last:]


def _is_upright(edge: _Edge, near: float) -> bool:
    return bool(np.abs(edge.last[0] - edge.first[0]) <= near)


def _flat(edge: _Edge) -> bool:
    """Tell whether an edge runs more along the ship than up."""
    step = np.abs(edge.last - edge.first)
    return bool(step[0] > _KEEL * step[2])


def _turned(run: list[_Edge]) -> list[_Edge]:
    return [edge.turned() for edge in reversed(run)]


def _upward(
    net: CurveNet,
    aft: list[_Edge],
    fore: list[_Edge],
    keel: list[_Edge],
    deck: list[_Edge],
    slab: int,
) -> StripBoundary:
    """Turn a strip so that its rails run from keel to deck: they enclose area to port.

    The integral of y dz is positive upward; against that, rails are reversed and sides swapped.
    """
    swept = sum(_swept(net, edge) for edge in aft + fore)
    if swept < 0.0:
        aft, fore, keel, deck = _turned(aft), _turned(fore), deck, keel
    plane = all(_stands(net, edge) for edge in aft + fore)
    across = all(edge.kind != "E" or bool(net.transom[edge.part[0]]) for edge in aft + fore)
    return StripBoundary(
        _parts(aft), _parts(fore), _parts(keel), _parts(deck), slab, plane, plane or across
    )


def _parts(run: list[_Edge]) -> tuple[CurvePart, ...]:
    return tuple(edge.part for edge in run if edge.part[0] >= 0)


def _stands(net: CurveNet, edge: _Edge) -> bool:
    """Tell whether an edge lies in a plane across the ship."""
    if edge.kind != "E":
        return True
    return bool(np.ptp(_along(net, edge.part)[:, 0]) <= net.on_plane)


def _along(net: CurveNet, part: CurvePart) -> FloatArray:
    """Give places along a part of a curve, for what needs no precision."""
    curve, t0, t1 = part
    return evaluate(net.batch, np.full(33, curve), np.linspace(t0, t1, 33))


def _swept(net: CurveNet, edge: _Edge) -> float:
    """Integrate y dz along an edge, m2, by chords: only the sign matters."""
    if edge.part[0] < 0:
        return 0.0
    _, y, z = _along(net, edge.part).T
    return float((0.5 * (y[1:] + y[:-1]) * np.diff(z)).sum())
