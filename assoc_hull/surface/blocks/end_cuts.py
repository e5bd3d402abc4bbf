"""Where blocks of a half hull are cut: ends off the body, and creases along knuckle lines.

A cut runs along a section or a waterline. Where no waterline ends at a sharp corner of the profile,
a bridge goes there through one cell: an edge that is no line, and whose points count for little.

Where blocks are cut along knuckle lines, so that the surface has a crease there.

No smooth surface follows a chine: each block ends at it, and two share only its places.
Cut is along lines that run from the aft end of the half hull to its fore end, and at which every
section that crosses them has a knuckle, of some degrees at half of them at least. One that dies
out, or ends at the deck, cuts nothing.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.net.curve_net import CurveNet
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import (
    CurveData,
    FloatArray,
    IntArray,
    SplineBatch,
    freeze,
)
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.surface.blocks.cell_regions import (
    BRIDGE,
    WINDOW,
    BorderCourse,
    CellRegion,
    ProfileBend,
    RegionChord,
    border_course,
    border_turns,
    find_inward_bends,
)
from assoc_hull.surface.cells.net_faces import NetCells, find_cells
from assoc_hull.surface.cells.net_graph import NetGraph, measure_pieces

__all__ = [
    "LEAST",
    "EndCut",
    "KnuckleCut",
    "KnuckleLayer",
    "add_bridges",
    "end_cut",
    "knuckle_cuts",
    "layers_between",
    "passes_bend",
    "require_disc",
    "whole_sections",
]

_TURN = 3.0
"""A line at which half of the sections turn by less, degrees, is followed by a smooth surface, as
the upper knuckle of the supply ship is: 0.7 there."""

_ROUNDED = "{} is no crease of the surface, which rounds it: {}"


@attrs.frozen(eq=False)
class KnuckleCut:
    """A knuckle line from end to end of the half hull.

    Attributes
    ----------
    name : str
        Of the line.
    half : (k,) int
        Its half-edges from aft forward: what lies below is on their left.
    """

    name: str
    half: IntArray

    def __attrs_post_init__(self) -> None:
        freeze(self.half)


@attrs.frozen(eq=False)
class KnuckleLayer:
    """A part of a region between two knuckle lines, or between one and the border.

    Attributes
    ----------
    region : CellRegion
        The part.
    above, below : RegionChord or None
        The knuckle lines along it, from aft forward.
    name : str
        Of the line above; empty at the deck.
    """

    region: CellRegion
    above: RegionChord | None = None
    below: RegionChord | None = None
    name: str = ""

    @property
    def titled(self) -> str:
        """What follows the name of a block of this layer."""
        return f" below {self.name}" if self.name else ""

    @property
    def corners(self) -> tuple[int, ...]:
        """The nodes at the ends of its knuckle lines."""
        return tuple(
            node
            for chord in (self.above, self.below)
            if chord is not None
            for node in (chord.first, chord.last)
        )


def require_disc(region: CellRegion, name: str) -> None:
    """Refuse a region with holes, or that is pinched."""
    if not region.is_disc:
        raise BadInputError(
            f"{name} is no disc: its border has {len(region.loops)} loops",
            "in the blocks of a surface",
            "look for lines that end nowhere, or that lie on one another",
        )


def knuckle_cuts(whole: CellRegion) -> tuple[tuple[KnuckleCut, ...], tuple[str, ...]]:
    """Find the knuckle lines that run from end to end of a half hull, from the deck down.

    Notes tell of those that do not, or at which sections hardly turn: the surface rounds them.
    """
    graph = whole.graph
    names = dict.fromkeys(graph.net.name[c] for c in np.flatnonzero(graph.net.knuckle).tolist())
    found, notes = list[tuple[int, KnuckleCut]](), list[str]()
    for name in names:
        half = _from_end_to_end(whole, name)
        if half is None:
            if len(_inner_edges(whole, name)):
                notes.append(
                    _ROUNDED.format(name, "it does not run from end to end of the half hull")
                )
        elif (turn := _turn_of_sections(graph, half, name)) < _TURN:
            why = f"sections turn by {turn:.2g} degrees there, creases are cut from {_TURN:g} on"
            why = why if turn else "not every section has a knuckle where it crosses it"
            notes.append(_ROUNDED.format(name, why))
        else:
            above = whole.with_half([half], int(half[0]) ^ 1)
            found.append((0 if above is None else int(above.inside.sum()), KnuckleCut(name, half)))
    ordered = sorted(found, key=lambda each: (each[0], each[1].name))
    return tuple(cut for _, cut in ordered), tuple(notes)


def _inner_edges(whole: CellRegion, name: str) -> IntArray:
    """Give the edges of a line that lie within the half hull, not along its border."""
    curves = [c for c, each in enumerate(whole.graph.net.name) if each == name]
    return np.flatnonzero(np.isin(whole.graph.curve, curves) & whole.interior)


def _from_end_to_end(whole: CellRegion, name: str) -> IntArray | None:
    """Give the half-edges of a knuckle line from the aft border to the fore one, or None."""
    graph = whole.graph
    own = _inner_edges(whole, name)
    ends = whole.on_loop & ~_deck_nodes(graph)
    for first in np.unique(graph.edge[own]).tolist():
        if not ends[first]:
            continue
        half = _walk(whole, own, first)
        if half is None:
            continue
        last = int(whole.end(half[-1:])[0])
        x = graph.place[:, 0]
        middle = 0.5 * (float(x.min()) + float(x.max()))
        if ends[last] and x[first] < middle < x[last]:
            return half
    return None


def _walk(whole: CellRegion, own: IntArray, first: int) -> IntArray | None:
    """Walk along edges from a node of the border to the next one; None where they part or end."""
    edge, left = whole.graph.edge, set(own.tolist())
    run, node = list[int](), first
    while not run or not whole.on_loop[node]:
        ahead = [each for each in left if node in edge[each]]
        if len(ahead) != 1:
            return None
        left.discard(ahead[0])
        run.append(2 * ahead[0] + int(edge[ahead[0], 1] == node))
        node = int(edge[ahead[0]].sum()) - node
    return np.array(run, np.int64)


def _deck_nodes(graph: NetGraph) -> NDArray[np.bool_]:
    """Tell which nodes lie on the deck edge, (n,)."""
    net = graph.net
    deck = net.end & ~net.centre & ~np.isfinite(net.x) & ~net.transom
    found = np.zeros(len(graph.place), np.bool_)
    found[graph.edge[deck[graph.curve] & (graph.curve >= 0)]] = True
    return found


def _turn_of_sections(graph: NetGraph, half: IntArray, name: str) -> float:
    """Give by how much the sections that a line crosses turn there, the median, degrees.

    Nil where no section crosses it, or one has no knuckle there.
    """
    net, batch = graph.net, graph.net.batch
    own = np.array([each == name for each in net.name])
    nodes = graph.edge.ravel()[half[1:]]
    met = np.flatnonzero(np.isin(graph.row_node, nodes) & (own[net.meets].sum(axis=1) == 1))
    side = np.argmin(own[net.meets[met]], axis=1)
    curve, place = net.meets[met, side], net.place[met, side]
    section = np.array(net.family)[curve] == "sections"
    turns = list[float]()
    for c, t in zip(curve[section].tolist(), place[section].tolist(), strict=True):
        rows = np.arange(batch.start[c], batch.start[c + 1])
        row = int(rows[np.abs(batch.knot[rows] - t).argmin()])
        # Derivatives differ at knuckles only; elsewhere they are the same number.
        if (batch.leave[row] == batch.arrive[row]).all():
            return 0.0
        sine = np.linalg.norm(np.cross(batch.leave[row], batch.arrive[row]))
        turns.append(float(np.degrees(np.arctan2(sine, batch.leave[row] @ batch.arrive[row]))))
    return float(np.median(turns)) if turns else 0.0


def layers_between(
    region: CellRegion, cuts: Sequence[KnuckleCut], name: str
) -> tuple[KnuckleLayer, ...]:
    """Part a region along the knuckle lines that run through it, from the deck down.

    Raises BadInputError where one runs through it in pieces, or a part is no disc.
    """
    found, rest, above, title = list[KnuckleLayer](), region, None, ""
    for cut in cuts:
        run = _through(region, cut, name)
        if run is None:
            continue
        high = rest.with_half([run.half], int(run.half[0]) ^ 1)
        low = rest.with_half([run.half], int(run.half[0]))
        if high is None or low is None:
            raise BadInputError(
                f"{cut.name} does not part {name}", "in the blocks of a surface",
                "knuckle lines that cross one another cannot all be creases",
            )  # fmt: skip
        found.append(KnuckleLayer(high, above, run, title))
        rest, above, title = low, run, cut.name
    found.append(KnuckleLayer(rest, above, None, title))
    for each in found:
        require_disc(each.region, name + each.titled)
    return tuple(found)


def _through(region: CellRegion, cut: KnuckleCut, name: str) -> RegionChord | None:
    """Give the piece of a knuckle line within a region; None if it has none."""
    inside = np.flatnonzero(region.interior[cut.half >> 1])
    if not len(inside):
        return None
    half = cut.half[inside]
    nodes = np.append(region.begin(half), region.end(half[-1:]))
    if (np.diff(inside) != 1).any() or region.on_loop[nodes[1:-1]].any():
        raise BadInputError(
            f"{cut.name} runs through {name} in pieces", "in the blocks of a surface",
            "end it before the lines that blocks end at, or lead it past them",
        )  # fmt: skip
    curve = int(region.graph.curve[half[0] >> 1])
    return RegionChord(half, curve, int(nodes[0]), int(nodes[-1]))


_KEEL = 0.1
"""A section stands on the keel where the profile rises by less than this a metre."""

_NEAR = 0.02
"""A line near a bend is no farther from it than this part of the ship's length ..."""

_THROUGH = 0.006
"""... and one through it, than this."""

_BEFORE = 0.01
"""A section beside a bend stands this part of the length off it."""

_LONG = {"bow": 0.08, "stern": 0.11}
"""An end is at least so long a part of the ship: what is pulled at its tip has faded where the body
begins; and there sections have lost the hollow of a skeg, for which the body has too few knots."""

LEAST, _SHARP = 35.0, 60.0
"""An end whose profile bends into the ship by so many degrees has a block of its own; and two, if
by so many."""


@attrs.frozen(eq=False)
class EndCut:
    """How an end of the hull is cut off the body.

    Attributes
    ----------
    kind : {"bow", "stern"}
        Which end.
    section : RegionChord
        The section, from the deck down.
    beside : RegionChord or None
        The next section towards midship: the bay between is where surfaces overlap.
    along : tuple of RegionChord
        The waterline that parts the end, from the section to the profile; and the next one above.
    bend : ProfileBend
        The bend it is cut for.
    notes : tuple of str
        What is to be known.
    """

    kind: str
    section: RegionChord
    beside: RegionChord | None
    along: tuple[RegionChord, ...]
    bend: ProfileBend
    notes: tuple[str, ...] = ()


def whole_sections(whole: CellRegion, length: float) -> tuple[RegionChord, ...]:
    """Give the sections in one piece that stand on the keel, from aft forward.

    Each runs from the deck down; `length`, m, is that of the ship.
    """
    graph, net = whole.graph, whole.graph.net
    found = list[tuple[float, RegionChord]]()
    lines: dict[str, list[RegionChord]] = {}
    for curve in np.unique(graph.curve).tolist():
        if net.family[curve] == "sections" and np.isfinite(net.x[curve]):
            lines.setdefault(net.name[curve], []).extend(whole.chords(curve))
    outline = border_course(whole)
    for chords in lines.values():
        if len(chords) == 1:
            chord = _downward(whole, chords[0])
            if _on_keel(whole, outline, chord.last, length):
                found.append((float(net.x[chord.curve]), chord))
    return tuple(chord for _, chord in sorted(found, key=lambda each: each[0]))


def _downward(region: CellRegion, chord: RegionChord) -> RegionChord:
    z = region.graph.place[[chord.first, chord.last], 2]
    return chord if z[0] >= z[1] else chord.reversed()


def _on_keel(whole: CellRegion, outline: BorderCourse, node: int, length: float) -> bool:
    """Tell whether the border is nearly level at a node."""
    i = int(np.flatnonzero(outline.node == node)[0])
    half = 0.25 * WINDOW * length
    before, behind = outline.at(outline.start[i] + np.array([-half, half]))
    step = np.abs(behind - before)
    return bool(outline.centre[np.searchsorted(outline.along, outline.start[i])]) and bool(
        step[2] <= _KEEL * step[0]
    )


def end_cut(whole: CellRegion, length: float, kind: str) -> EndCut | None:
    """Find how the end `kind`, "bow" or "stern", is to be cut off, if at all.

    `length`, m, is that of the ship.
    """
    bend = _main_bend(whole, length, kind)
    if bend is None:
        return None
    through = _section_through(whole, bend, length)
    if through is not None:
        return EndCut(kind, through, None, (), bend)
    pair = _section_beside(whole, bend, length, kind)
    if pair is None:
        return None
    section, beside = pair
    parted = kind == "stern" or bend.turn >= _SHARP
    along = _waterlines(whole, section, bend, length) if parted else ()
    x, _, z = bend.place
    note = (
        () if along or not parted else (f"no waterline ends near the bend at ({x:.2f}, {z:.2f})",)
    )
    return EndCut(kind, section, beside, along, bend, note)


def _towards(kind: str) -> float:
    """Give the sign of the way from an end to midship."""
    return -1.0 if kind == "bow" else 1.0


def _main_bend(whole: CellRegion, length: float, kind: str) -> ProfileBend | None:
    """Give the sharpest bend of the profile in a half of the ship."""
    x = whole.graph.place[:, 0]
    middle = 0.5 * (float(x.min()) + float(x.max()))
    bends = [
        bend
        for bend in find_inward_bends(border_course(whole), length, LEAST)
        if (bend.place[0] - middle) * _towards(kind) < 0.0
    ]
    return max(bends, key=lambda each: (each.turn, each.along)) if bends else None


def _section_beside(
    whole: CellRegion, bend: ProfileBend, length: float, kind: str
) -> tuple[RegionChord, RegionChord | None] | None:
    """Give the section that cuts an end off, and the next one towards midship."""
    towards, x = _towards(kind), whole.graph.net.x
    sections = whole_sections(whole, length)
    sections = sections[::-1] if kind == "stern" else sections
    tip = float((whole.graph.place[:, 0] * towards).min())
    limit = max(bend.place[0] * towards + _BEFORE * length, tip + _LONG[kind] * length)
    good = [i for i, run in enumerate(sections) if float(x[run.curve]) * towards >= limit]
    if not good:
        return None
    return sections[good[-1]], sections[good[-1] - 1] if good[-1] else None


def _section_through(whole: CellRegion, bend: ProfileBend, length: float) -> RegionChord | None:
    """Give a section that ends at a bend of the profile, if one does."""
    net, place = whole.graph.net, whole.graph.place
    for curve in np.unique(whole.graph.curve).tolist():
        if net.family[curve] != "sections":
            continue
        for chord in whole.chords(curve):
            down = _downward(whole, chord)
            away = np.abs(place[down.last] - np.array(bend.place)).max()
            if away <= _THROUGH * length:
                return down
    return None


def _waterlines(
    whole: CellRegion, section: RegionChord, bend: ProfileBend, length: float
) -> tuple[RegionChord, ...]:
    """Give the waterline from a section to a bend of the profile, and the next above it."""
    graph = whole.graph
    on_section = set(np.append(whole.begin(section.half), section.last).tolist())
    parts = [
        part
        for part in whole.parted([section.half])
        # The section stands `_BEFORE` off the bend: what lies behind it comes no nearer than that.
        if passes_bend(part, bend, 0.5 * _BEFORE * length)
    ]
    if len(parts) != 1:
        return ()
    (part,) = parts
    outline = border_course(whole)
    # `start` has the whole length behind the last node.
    where = dict(zip(outline.node.tolist(), outline.start.tolist(), strict=False))
    found = list[tuple[float, float, RegionChord]]()
    for curve in np.unique(graph.curve[part.edges]).tolist():
        if graph.net.family[curve] != "waterlines":
            continue
        for chord in part.chords(curve):
            run = chord if chord.first in on_section else chord.reversed()
            # One that comes back to the section parts nothing.
            if run.first in on_section and run.last in where and run.last not in on_section:
                away = abs(where[run.last] - bend.along)
                # The border is closed: the shorter way round counts.
                away = min(away, outline.length - away)
                found.append((away, float(graph.place[run.last, 2]), run))
    close = [each for each in found if each[0] <= _NEAR * length]
    if not close:
        return ()
    # By numbers only: lines cannot be compared.
    _, level, cut = min(close, key=lambda each: each[:2])
    above = sorted((each for each in found if each[1] > level), key=lambda each: each[1])
    cut = _over_bridge(part, cut)
    return (cut, above[0][2]) if above else (cut,)


def _over_bridge(region: CellRegion, line: RegionChord) -> RegionChord:
    """Let a waterline end over the bridge that leaves its last crossing, if there is one."""
    graph = region.graph
    last = int(region.begin(line.half[-1:])[0])
    for edge in np.flatnonzero(region.interior).tolist():
        if graph.net.family[int(graph.curve[edge])] == BRIDGE and last in graph.edge[edge]:
            half = 2 * edge + int(graph.edge[edge, 1] == last)
            run = np.append(line.half[:-1], half)
            return RegionChord(run, line.curve, line.first, int(region.end(run[-1:])[0]))
    return line


def passes_bend(part: CellRegion, bend: ProfileBend, near: float) -> bool:
    """Tell whether the border of a part passes a bend of the profile nearer than `near`, m."""
    found = part.path(part.loop)
    return bool(np.abs(found - np.array(bend.place)).max(axis=1).min() <= near)


# --------------------------------------------------------------------------------------
# Bridges. An aperture has its corner where the drawing has it, and no waterline need end there. If
# the cut ended beside it, one block would keep a corner of more than 180 degrees in its border, and
# fold. So the cut leaves the waterline at its last crossing and runs to the corner, in the shape
# that the waterline has there, moved by a part that grows towards the corner.

_STEPS = 8
_CORNER_NEAR = 0.01
"""The corner is no farther from the end of the waterline than this part of the ship's length."""

_TIP, _CORNER_SHARP = 0.002, 40.0
"""It turns by so many degrees over so small a part of the length."""


def add_bridges(found: NetCells, ends: tuple[EndCut | None, ...], length: float) -> NetCells:
    """Give the cells with the edges that cuts of ends want: one cell more for each.

    Numbers of nodes and edges stay. The new edges are no lines of the hull: their points count for
    little, and residuals are not taken on them.
    """
    whole = CellRegion.whole(found)
    every = [_bridge(whole, end, length) for end in ends if end is not None and end.along]
    wanted = [each for each in every if each is not None]
    return find_cells(_with_edges(found.graph, wanted)) if wanted else found


@attrs.frozen(eq=False)
class _Bridge:
    """An edge: its nodes, the last on the waterline and the corner; points on it; the waterline."""

    nodes: tuple[int, int]
    place: FloatArray
    curve: int


def _bridge(whole: CellRegion, end: EndCut, length: float) -> _Bridge | None:
    """Give the edge that the cut of an end wants, if it does."""
    line = end.along[0]
    outline = border_course(whole)
    at = int(np.flatnonzero(outline.node == line.last)[0])
    away = np.abs(outline.start[:-1] - outline.start[at])
    away = np.minimum(away, outline.length - away)
    sharp = border_turns(outline, outline.start[:-1], _TIP * length)
    near = np.flatnonzero((away <= _CORNER_NEAR * length) & (sharp >= _CORNER_SHARP))
    if not len(near) or at in near or len(line.half) < 2:
        return None
    i = int(near[np.argmax(sharp[near])])
    corner, last = int(outline.node[i]), int(whole.begin(line.half[-1:])[0])
    cell = int(whole.cells.cell_of[whole.loop[i]])
    around = whole.cells.nodes(cell).tolist()
    if last not in around or corner not in around:
        return None
    place = whole.path(line.half[-1:], _STEPS)
    part = np.linspace(0.0, 1.0, _STEPS + 1)[:, None]
    return _Bridge(
        (last, corner), place + part * (whole.graph.place[corner] - place[-1]), line.curve
    )


def _with_edges(graph: NetGraph, bridges: list[_Bridge]) -> NetGraph:
    """Give a graph with more edges."""
    net = graph.net
    for each in bridges:
        net = _with_line(net, each)
    pairs = [each.nodes for each in bridges]
    first = len(graph.net.name)
    edge = np.concatenate([graph.edge, np.array(pairs, np.int64)])
    curve = np.concatenate([graph.curve, first + np.arange(len(pairs))])
    away = graph.place[edge[-len(pairs) :, 1]] - graph.place[edge[-len(pairs) :, 0]]
    size = np.sqrt((away * away).sum(axis=1))
    most = net.batch.knot[net.batch.start[first + 1 :] - 1]
    t = np.concatenate([graph.t, np.column_stack([np.zeros(len(pairs)), most])])
    unit = away / size[:, None]
    leave = np.concatenate([graph.leave, np.stack([unit, -unit], axis=1)])
    return attrs.evolve(
        graph, net=net, edge=edge, curve=curve, t=t, leave=leave,
        pieces=measure_pieces(net.batch, curve, t, graph.place[edge]),
    )  # fmt: skip


def _with_line(net: CurveNet, bridge: _Bridge) -> CurveNet:
    """Give a net with one curve more, that is no line of the hull."""
    no = np.zeros(1, np.bool_)
    line = loft(CurveData.single(bridge.place))
    return attrs.evolve(
        net, batch=SplineBatch.join([net.batch, line]), curve=np.append(net.curve, -1),
        name=(*net.name, net.name[bridge.curve]), family=(*net.family, BRIDGE),
        end=np.append(net.end, no), flat=np.append(net.flat, no),
        knuckle=np.append(net.knuckle, no), x=np.append(net.x, np.nan),
        centre=np.append(net.centre, no),
        normal=np.concatenate([net.normal, np.full((1, 3), np.nan)]),
    )  # fmt: skip
