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
from numpy.typing import NDArray

from assoc_hull.analysis.net.curve_net import CurveNet, CurvePart
from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.numeric.polynomials import horner, unit_roots
from assoc_hull.geometry.splines.segments import bezier_points, evaluate, power_coefficients

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
    section = np.isfinite(net.x) & ~net.end & ~net.ends_on_transom
    section &= ~_covered(net)
    for curve in np.flatnonzero(net.end | section).tolist():
        if net.end[curve]:
            found += _cut(net, curve, x)
        else:
            part = curve, 0.0, net.length(curve)
            found.append(BoundaryArc(part, -1, int(np.abs(x - net.x[curve]).argmin())))
    return found


def _covered(net: CurveNet) -> NDArray[np.bool_]:
    """Tell which curves begin and end where an end in a transverse plane does, (m,)."""
    start = net.batch.start
    ends = np.stack([net.batch.xyz[start[:-1]], net.batch.xyz[start[1:] - 1]], axis=1)
    closing = ends[net.end & np.isfinite(net.x)]
    away = [
        np.abs(ends[:, None] - each).max(axis=(2, 3)).min(axis=1, initial=np.inf)
        for each in (closing, closing[:, ::-1])
    ]
    covered: NDArray[np.bool_] = np.minimum(*away) <= net.factor * _SAME
    return covered


def _cut(net: CurveNet, curve: int, x: FloatArray) -> list[BoundaryArc]:
    """Cut one boundary curve at the planes and at its corners."""
    one = net.batch.part(curve, curve + 1)
    edge = _edges(one, x, net.on_plane)
    middle = 0.5 * (edge[1:] + edge[:-1])
    place = _x_at(one, np.concatenate([edge, middle]))
    at, between = place[: len(edge)], place[len(edge) :]
    slab, plane = np.searchsorted(x, between), np.full(len(between), -1)
    if len(x):
        near = np.abs(x - between[:, None]).argmin(axis=1)
        three = np.stack([at[:-1], between, at[1:]])
        on = np.abs(three - x[near]).max(axis=0) <= net.on_plane
        slab, plane = np.where(on, -1, slab), np.where(on, near, -1)
    parts = zip(edge[:-1].tolist(), edge[1:].tolist(), strict=True)
    return [
        BoundaryArc((curve, begin, finish), *where)
        for (begin, finish), *where in zip(parts, slab.tolist(), plane.tolist(), strict=True)
    ]


def _edges(one: SplineBatch, x: FloatArray, near: float) -> FloatArray:
    """Give the parameters at which a curve passes the planes or has a corner, with its ends.

    Knots on a plane are taken as they are; roots next to them are the same point, found again.
    """
    cubic, control = power_coefficients(one)[:, :, 0], bezier_points(one)[:, :, 0]
    low, high = control.min(axis=1), control.max(axis=1)
    segment, plane = np.nonzero((low[:, None] <= x) & (high[:, None] >= x))
    # Most planes are passed at a knot: a segment that only rises, or falls, does not come back.
    step = np.diff(control, axis=1)
    steady = np.asarray((step > 0.0).all(axis=1) | (step < 0.0).all(axis=1))
    ends = control[segment][:, [0, -1]] == x[plane][:, None]
    other = ~(steady[segment] & ends.any(axis=1))
    segment, plane = segment[other], plane[other]
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


_Place = tuple[float, float, float]


@attrs.frozen(eq=False)
class _Edge:
    """An arc with its ends as numbers of nodes.

    `kind` is A (on the plane aft), F (on the plane forward) or E (between them); `closing` arcs
    are those that may close an end of the ship: the profile, a transom; not a deck edge. `swept`
    is the integral of y dz along it, m2, and `level` says that it lies in a plane across the ship.
    """

    part: CurvePart
    kind: str
    begin: int
    finish: int
    closing: bool
    first: _Place
    last: _Place
    swept: float = 0.0
    level: bool = False

    def turned(self) -> _Edge:
        """Give the edge the other way round."""
        curve, t0, t1 = self.part
        return _Edge(
            (curve, t1, t0), self.kind, self.finish, self.begin, self.closing,
            self.last, self.first, -self.swept, self.level,
        )  # fmt: skip


def strip_boundaries(
    net: CurveNet, arcs: Sequence[BoundaryArc], count: int, length: float
) -> tuple[list[StripBoundary], list[UnboundedCurves]]:
    """Find the strips in all slabs of `count` planes, and curves that bound none; `length` in m."""
    whole = _edges_of(net, arcs)
    # By slabs for arcs between planes, by planes for those on one.
    between, on = dict[int, list[int]](), dict[int, list[int]]()
    for i, arc in enumerate(arcs):
        (on if arc.plane >= 0 else between).setdefault(max(arc.plane, arc.slab), []).append(i)
    found: list[StripBoundary] = []
    lost: list[UnboundedCurves] = []
    for slab in range(count + 1):
        sections = [(i, "A") for i in on.get(slab - 1, ())] + [(i, "F") for i in on.get(slab, ())]
        if not sections:
            continue
        chosen = sorted(sections + [(i, "E") for i in between.get(slab, ())])
        edges = _joined(net, whole, chosen, _NEAR * length)
        for loop in _loops(_pruned(edges)):
            frame = _frame(net, loop, slab)
            if isinstance(frame, StripBoundary):
                found.append(frame)
            elif frame is not None:
                lost.append(frame)
    return found, lost


_CHORDS = 32
"""So many chords stand for an arc where no precision is needed."""


def _edges_of(net: CurveNet, arcs: Sequence[BoundaryArc]) -> list[_Edge]:
    """Give the arcs as edges whose ends have no numbers yet."""
    curve = np.array([arc.part[0] for arc in arcs], np.int64)
    begin, finish = (np.array([arc.part[i] for arc in arcs], np.float64) for i in (1, 2))
    t = np.linspace(begin, finish, _CHORDS + 1, axis=1)
    place = evaluate(net.batch, curve.repeat(_CHORDS + 1), t.ravel()).reshape(len(arcs), -1, 3)
    _, y, z = np.moveaxis(place, 2, 0)
    # By chords: only the sign matters.
    swept = (0.5 * (y[:, 1:] + y[:, :-1]) * np.diff(z, axis=1)).sum(axis=1)
    level = np.ptp(place[:, :, 0], axis=1) <= net.on_plane
    ends = place[:, 0].tolist(), place[:, -1].tolist()
    return [
        _Edge(arc.part, "E", -1, -1, closes_end(net, arc.part[0]), tuple(first), tuple(last), *more)
        for arc, first, last, *more in zip(arcs, *ends, swept.tolist(), level.tolist(), strict=True)
    ]


def _joined(
    net: CurveNet, whole: Sequence[_Edge], chosen: Sequence[tuple[int, str]], near: float
) -> list[_Edge]:
    """Give the chosen edges with numbers; ends within `near` (m) of each other share a node."""
    node: list[_Place] = []

    def number(place: _Place) -> int:
        away = [_away(each, place) for each in node]
        if away and (least := min(away)) <= near:
            return away.index(least)
        node.append(place)
        return len(node) - 1

    edges = []
    for i, kind in chosen:
        edge = whole[i]
        begin, finish = number(edge.first), number(edge.last)
        if begin != finish or not net.end[edge.part[0]]:
            edges.append(
                _Edge(
                    edge.part, kind, begin, finish, edge.closing,
                    edge.first, edge.last, edge.swept, edge.level,
                )
            )  # fmt: skip
    return edges


def _away(one: _Place, other: _Place) -> float:
    """Give how far two places are apart, m, along that axis along which it is most."""
    return max(abs(one[0] - other[0]), abs(one[1] - other[1]), abs(one[2] - other[2]))


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
    (top, place), (stem, there) = (max(ends, key=lambda each: each[1][2]) for ends in loose)
    return [_Edge((-1, 0.0, 0.0), "E", top, stem, False, place, there)]


def _upper(edge: _Edge) -> tuple[int, _Place]:
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
    loose: dict[str, list[tuple[int, _Place, bool]]] = {"A": [], "F": []}
    for edge in edges:
        if edge.kind == "E":
            continue
        for node, place, other in (
            (edge.begin, edge.first, edge.last),
            (edge.finish, edge.last, edge.first),
        ):
            if degree[node] == 1:
                loose[edge.kind].append((node, place, place[2] >= other[2]))
    pairs = sorted(
        (_away(a[1], f[1]), i, j)
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
    return abs(edge.last[0] - edge.first[0]) <= near


def _flat(edge: _Edge) -> bool:
    """Tell whether an edge runs more along the ship than up."""
    along, up = (abs(edge.last[i] - edge.first[i]) for i in (0, 2))
    return along > _KEEL * up


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
    swept = sum(edge.swept for edge in aft + fore)
    if swept < 0.0:
        aft, fore, keel, deck = _turned(aft), _turned(fore), deck, keel
    plane = all(edge.kind != "E" or edge.level for edge in aft + fore)
    across = all(edge.kind != "E" or bool(net.transom[edge.part[0]]) for edge in aft + fore)
    return StripBoundary(
        _parts(aft), _parts(fore), _parts(keel), _parts(deck), slab, plane, plane or across
    )


def _parts(run: list[_Edge]) -> tuple[CurvePart, ...]:
    return tuple(edge.part for edge in run if edge.part[0] >= 0)
