"""Which blocks a half hull is parted into, with four corners each and bays beyond their sides.

The body is master of the ends; of an end parted along, the upper part is master of the lower.
A master knows nothing of what follows it, so a change in a bow changes nothing abaft of it.
Knuckle lines from end to end part all of them once more, the part above master of that below.
A surface is fitted over the bays too and cut at the border, so its end is not its worst place.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.surface.blocks.cell_regions import (
    BorderCourse,
    CellRegion,
    ProfileBend,
    Quad,
    RegionChord,
    border_course,
    border_turns,
    find_inward_bends,
)
from assoc_hull.surface.blocks.end_cuts import (
    LEAST,
    EndCut,
    KnuckleCut,
    KnuckleLayer,
    add_bridges,
    end_cut,
    knuckle_cuts,
    layers_between,
    passes_bend,
    require_disc,
)
from assoc_hull.surface.cells.net_faces import NetCells

__all__ = [
    "BlockPlan",
    "BlockSeam",
    "bays_of_parts",
    "bays_of_whole",
    "block_plans",
    "four_corners",
]


_WINDOW = 0.02
"""Over this part of the ship's length the turn of a border is taken."""

_TIP, _SHARP = 0.002, 40.0
"""A border that turns by so many degrees over so small a part of the ship has a corner."""

_EASED = 10.0
"""Over a larger part it may turn by so many degrees less."""

_ROUND = 1.0
"""A smooth border has none where it turns by fewer degrees over the window."""

_APART, _BESIDE = 0.02, 0.003
"""Corners lie no nearer to one another than this part of the border, nor, than the other, to where
the hull runs on."""

_NARROW = 0.001
"""Corners of a layer along a knuckle line, which may be narrow, are no nearer to one another."""


def four_corners(
    region: CellRegion,
    length: float,
    first: Sequence[int],
    second: Sequence[int] = (),
    never: Sequence[int] = (),
    *,
    least: float = _ROUND,
    apart: float = _APART,
) -> tuple[tuple[int, ...], tuple[float, ...]]:
    """Choose four nodes round a region, counter-clockwise; also give the turns there, degrees.

    The turns are those over a short way: little at round borders. Nodes `first` are corners
    whatever the border does: those at the ends of a section that bounds it. Then come sharp corners
    of the hull, then nodes `second`, then where a smooth border turns most. Nodes `never` are none,
    nor any near them: the hull runs on there. `length`, m, is that of the ship. Where a border
    turns by fewer degrees than `least` it has no corner; corners are a part `apart` of it from one
    another.
    """
    found = border_course(region)
    node = found.node.tolist()
    normal = region.graph.normal[found.node]
    window = min(_WINDOW * length, 0.1 * found.length)
    turn = border_turns(found, found.start[:-1], window, normal)
    sharp = border_turns(found, found.start[:-1], _TIP * length, normal)
    rank = np.where((sharp >= _SHARP) & (turn >= _SHARP - _EASED), 2, 0)
    rank[[not _apart(found, i, _at(node, never), _BESIDE) for i in range(len(node))]] = -1
    rank[np.isin(node, second)] = 1
    rank[np.isin(node, first)] = 3
    chosen = np.flatnonzero(rank == 3).tolist()
    for level in (2, 1, 0):
        of = [i for i in np.flatnonzero(rank == level).tolist() if turn[i] >= least]
        chosen += _best(found, turn, of, chosen, apart)
    chosen.sort()
    return tuple(node[i] for i in chosen), tuple(float(sharp[i]) for i in chosen)


def _at(node: Sequence[int], which: Sequence[int]) -> list[int]:
    return [i for i, each in enumerate(node) if each in which]


def _apart(found: BorderCourse, i: int, chosen: Sequence[int], part: float) -> bool:
    """Tell whether a node is a part of the border away from others."""
    gaps = [abs(float(found.start[i] - found.start[j])) for j in chosen]
    return all(min(gap, found.length - gap) >= part * found.length for gap in gaps)


def _best(
    found: BorderCourse, turn: FloatArray, of: Sequence[int], chosen: Sequence[int], part: float
) -> list[int]:
    """Choose from nodes the corners that lack: they turn most, and sides stay in proportion."""
    lack = 4 - len(chosen)
    good = [i for i in of if _apart(found, i, chosen, part)]
    if len(good) <= lack:
        return good
    best, value = tuple[int, ...](), 0.0
    for extra in itertools.combinations(good, lack):
        apart = (_apart(found, i, extra[:k], part) for k, i in enumerate(extra))
        bent = np.maximum(turn[list(extra)], _ROUND)
        worth = float(np.prod(bent)) * _shape(found, [*chosen, *extra])
        if worth > value and all(apart):
            best, value = extra, worth
    return list(best)


def _shape(found: BorderCourse, corner: Sequence[int]) -> float:
    """Give how alike opposite sides are, 1 for a rectangle."""
    where = np.sort(found.start[list(corner)])
    side = np.diff(np.append(where, where[0] + found.length))
    pairs = ((side[0], side[2]), (side[1], side[3]))
    return float(np.prod([min(pair) / max(pair) for pair in pairs]))


# --------------------------------------------------------------------------------------
# Bays beyond the borders of a block: as far as the next line, on its master's side.

Bays = dict[str, Quad]


def bays_of_whole(strip: CellRegion | None, end: EndCut, top: int, bottom: int) -> Bays:
    """Give the bay beside an end, or a layer of it, that is one block, by its side.

    `strip` is the part of the body beside it, `top` and `bottom` are where its section ends.
    """
    found = None if strip is None else _bay(strip, end, top, bottom)
    return {} if found is None else {_side(end): found}


def bays_of_parts(
    strip: CellRegion | None, end: EndCut, upper: CellRegion, high: int, top: int, bottom: int
) -> tuple[Bays, Bays]:
    """Give the bays beside the upper and the lower block of an end that is cut along a waterline.

    `strip` is the part of the body beside both, `upper` the block above the waterline, `high` a
    half-edge of this that has it on its left; `top` and `bottom` are where the section of both
    ends. The bays of the lower block reach beyond the waterline as well.
    """
    side, line = _side(end), end.along[0]
    carried = [None if strip is None else _carried(strip, each) for each in end.along]
    above, below = Bays(), Bays()
    base = carried[0]
    if strip is not None and base is not None:
        # Towards midship it runs aft from a bow, its upper side on the left; from a stern, forward.
        upward = int(base.half[0]) ^ (end.kind == "stern")
        for bays, half, first, last in (
            (above, upward, top, line.first),
            (below, upward ^ 1, line.first, bottom),
        ):
            found = _bay(strip.with_half([base.half], half), end, first, last)
            if found is not None:
                bays[side] = found
    if len(end.along) == 1:
        return above, below
    next_line = end.along[1]
    if not upper.interior[next_line.half >> 1].all():
        return above, below  # a knuckle line runs between
    part = upper.with_half([next_line.half], high)
    # Only a disc has four corners.
    if part is not None and part.is_disc:
        below["v0"] = _across(end, part)
    over = carried[1]
    # Beyond a corner there is a bay only if there is one beyond the side next to it.
    if strip is not None and base is not None and over is not None and "v0" in below:
        between = strip.with_half([base.half, over.half], upward)
        found = _bay(between, end, next_line.first, line.first)
        if found is not None:
            below[f"{side} v0"] = found
    return above, below


def _side(end: EndCut) -> str:
    """Tell on which side of the blocks of an end the body lies."""
    return "u1" if end.kind == "stern" else "u0"


def _strip(whole: CellRegion, end: EndCut, layer: CellRegion) -> CellRegion | None:
    """Give the bay of the body beside an end, of a layer of the body."""
    if end.beside is None:
        return None
    cuts = [end.section.half, end.beside.half]
    found = whole.with_half(cuts, int(end.section.half[0]) ^ (end.kind == "stern"))
    if found is None or not found.is_disc:
        return None
    return CellRegion(found.cells, found.inside & layer.inside)


def _bay(region: CellRegion | None, end: EndCut, top: int, bottom: int) -> Quad | None:
    """Give a bay beside a part of a section as a quad, if it has corners."""
    other = end.beside
    if region is None or other is None or not region.is_disc:
        return None
    node = set(region.begin(region.loop).tolist())
    far = [
        each for each in np.append(region.begin(other.half), other.last).tolist() if each in node
    ]
    if top not in node or bottom not in node or len(far) < 2:
        return None
    aft = end.kind == "stern"
    corner = (top, far[0], far[-1], bottom) if aft else (far[0], top, bottom, far[-1])
    return Quad(region, corner)


def _across(end: EndCut, region: CellRegion) -> Quad:
    """Give the strip between the two waterlines of an end as a quad."""
    line, above = end.along
    if end.kind == "stern":
        return Quad(region, (above.last, above.first, line.first, line.last))
    return Quad(region, (above.first, above.last, line.last, line.first))


def _carried(strip: CellRegion, line: RegionChord) -> RegionChord | None:
    """Give the same line through the bay beside it, from the section on."""
    for chord in strip.chords(line.curve):
        for run in (chord, chord.reversed()):
            if run.first == line.first:
                return run
    return None


# --------------------------------------------------------------------------------------
# Plans of all blocks, masters first.

_PASSES = 0.002
"""A border passes a place that it misses by less than this part of the ship's length."""


@attrs.frozen(eq=False)
class BlockSeam:
    """A side of a block, or a part of one, that follows another block.

    Attributes
    ----------
    side : str
        The side of the block.
    master : str
        The name of the other block.
    half : tuple of int
        The half-edges along it.
    crease : bool
        It is a knuckle line: places are shared, tangent planes are not.
    """

    side: str
    master: str
    half: tuple[int, ...]
    crease: bool = False


@attrs.frozen(eq=False)
class BlockPlan:
    """One block: four corners, and bays beyond its sides.

    Attributes
    ----------
    name : str
        ``"body"``, ``"bow stem"`` ...
    kind : {"body", "bow", "stern"}
        Where it lies.
    core : Quad
        The block itself.
    bays : dict of str to Quad
        Beyond ``"u0"``, ``"u1"``, ``"v0"``; and beyond a corner, ``"u0 v0"`` or ``"u1 v0"``.
    seams : tuple of BlockSeam
        Where it follows another block.
    rails : tuple of RegionChord
        Sections from deck to keel by which a body is laid out.
    turns : tuple of float, degrees
        By how much the border turns at the corners.
    notes : tuple of str
        What is to be known.
    """

    name: str
    kind: str
    core: Quad
    bays: dict[str, Quad]
    seams: tuple[BlockSeam, ...]
    rails: tuple[RegionChord, ...]
    turns: tuple[float, ...]
    notes: tuple[str, ...]


def block_plans(cells: NetCells, length: float) -> tuple[BlockPlan, ...]:
    """Part a half hull into blocks, masters first; `length`, m, is that of the ship.

    A knuckle line along which no blocks with four corners are found stays within them, with a note.
    Raises BadInputError where the half hull, or a part of it, is no disc with four corners.
    """
    whole = CellRegion.whole(cells)
    require_disc(whole, "the half hull")
    ends = tuple(end_cut(whole, length, kind) for kind in ("stern", "bow"))
    found = add_bridges(cells, ends, length)
    if found is not cells:
        whole = CellRegion.whole(found)
        ends = tuple(end_cut(whole, length, kind) for kind in ("stern", "bow"))
    plans, notes = _creased(whole, length, ends)
    cut_off = [end.bend.place for end in ends if end is not None]
    bends = find_inward_bends(border_course(whole), length, LEAST)
    left = [bend for bend in bends if bend.place not in cut_off]
    plans[0] = attrs.evolve(plans[0], notes=(*plans[0].notes, *notes))
    return tuple(attrs.evolve(plan, notes=plan.notes + _hard(plan, left, length)) for plan in plans)


def _creased(
    whole: CellRegion, length: float, ends: Sequence[EndCut | None]
) -> tuple[list[BlockPlan], list[str]]:
    """Plan all blocks, cut along as many knuckle lines as can be; say why others are not."""
    taken = list[KnuckleCut]()
    knuckles, rounded = knuckle_cuts(whole)
    notes = list(rounded)
    try:
        plans = _plans(whole, length, ends, ())
    except BadInputError:
        # The corners of a chined end may be too many for one block.
        return _plans(whole, length, ends, knuckles), notes
    for cut in knuckles:
        try:
            plans = _plans(whole, length, ends, [*taken, cut])
            taken.append(cut)
        except BadInputError as error:
            notes.append(f"{cut.name} is no crease: {error.what}")
    return plans, notes


def _plans(
    whole: CellRegion, length: float, ends: Sequence[EndCut | None], cuts: Sequence[KnuckleCut]
) -> list[BlockPlan]:
    """Plan all blocks, cut along knuckle lines too."""
    stern, bow = ends
    body = _body(whole, length, stern, bow, cuts)
    every = list(body)
    for end in ends:
        if end is not None:
            every += _end(whole, length, end, body, cuts)
    return every


def _hard(plan: BlockPlan, bends: Sequence[ProfileBend], length: float) -> tuple[str, ...]:
    """Name the bends of the profile that stay in the border of a block."""
    return tuple(
        f"the profile bends into the ship by {bend.turn:.0f} degrees "
        f"at ({bend.place[0]:.2f}, {bend.place[2]:.2f}), within a side"
        for bend in bends
        if passes_bend(plan.core.region, bend, _PASSES * length)
    )


def _body(
    whole: CellRegion,
    length: float,
    stern: EndCut | None,
    bow: EndCut | None,
    knuckles: Sequence[KnuckleCut],
) -> list[BlockPlan]:
    """Plan the layers of the body, from the deck down."""
    cuts = [each.section.half for each in (stern, bow) if each is not None]
    region = whole
    if stern is not None:
        region = _part(whole, cuts, int(stern.section.half[0]) ^ 1, "the body")
    elif bow is not None:
        region = _part(whole, cuts, int(bow.section.half[0]), "the body")
    first, never = list[int](), list[int]()
    for end in (stern, bow):
        if end is not None:
            first.append(end.section.first)
            (never if end.beside is None else first).append(end.section.last)
    found = list[BlockPlan]()
    for layer in layers_between(region, knuckles, "body"):
        name = "body" + layer.titled
        quad, turn = _quad(layer, length, first, (), name, never=never)
        seams = _crease(layer, found)
        rails = _rails(layer.region, quad)
        found.append(BlockPlan(name, "body", quad, {}, seams, rails, turn, ()))
    return found


def _rails(region: CellRegion, quad: Quad) -> tuple[RegionChord, ...]:
    """Give the sections that run through a region from its upper side to its lower, from aft."""
    graph = region.graph
    nodes = [set(quad.nodes(side).tolist()) for side in ("v0", "v1")]
    curves = np.unique(graph.curve[region.edges])
    rails = [
        run
        for curve in curves.tolist()
        if graph.net.family[curve] == "sections"
        for chord in region.chords(curve)
        for run in (chord, chord.reversed())
        if run.first in nodes[0] and run.last in nodes[1]
    ]
    rails.sort(key=lambda run: float(graph.net.x[run.curve]))
    return tuple(rails)


def _crease(layer: KnuckleLayer, above: Sequence[BlockPlan]) -> tuple[BlockSeam, ...]:
    """Give the seam along the knuckle line over a layer; its master is the last of those above."""
    if layer.above is None:
        return ()
    return (BlockSeam("v0", above[-1].name, tuple(layer.above.half.tolist()), crease=True),)


def _beside_body(quad: Quad, side: str, body: Sequence[BlockPlan]) -> BlockPlan:
    """Give the layer of the body that a block lies beside."""
    half = quad.side(side)[:1]
    cells = quad.region.cells.cell_of[np.concatenate([half, half ^ 1])]
    return next(each for each in body if each.core.region.inside[cells[cells >= 0]].any())


def _end(
    whole: CellRegion,
    length: float,
    end: EndCut,
    body: Sequence[BlockPlan],
    knuckles: Sequence[KnuckleCut],
) -> list[BlockPlan]:
    """Plan the blocks of an end."""
    aft = end.kind == "stern"
    section = end.section
    region = _part(whole, [section.half], int(section.half[0]) ^ (not aft), end.kind)
    side = "u1" if aft else "u0"
    if end.along:
        return _parted_end(whole, length, end, region, body, knuckles)
    title = "stern counter" if aft and end.beside is None else end.kind
    found = list[BlockPlan]()
    for layer in layers_between(region, knuckles, title):
        name = title + layer.titled
        quad, turn = _quad(layer, length, [section.first, section.last], [], name, aft)
        master = _beside_body(quad, side, body)
        top, bottom = quad.nodes(side)[[0, -1]].tolist()
        bays = bays_of_whole(_strip(whole, end, master.core.region), end, top, bottom)
        seam = BlockSeam(side, master.name, tuple(quad.side(side).tolist()))
        seams = (seam, *_crease(layer, found))
        found.append(BlockPlan(name, end.kind, quad, bays, seams, (), turn, end.notes))
    return found


def _parted_end(
    whole: CellRegion,
    length: float,
    end: EndCut,
    region: CellRegion,
    body: Sequence[BlockPlan],
    knuckles: Sequence[KnuckleCut],
) -> list[BlockPlan]:
    """Plan the blocks of an end that is cut along a waterline, and along knuckle lines above."""
    aft = end.kind == "stern"
    side = "u1" if aft else "u0"
    section, line = end.section, end.along[0]
    names = ("stern counter", "stern boss") if aft else ("bow stem", "bow bulb")
    high = int(line.half[0]) ^ (not aft)
    parts = [
        _part(region, [line.half], half, name)
        for half, name in zip((high, high ^ 1), names, strict=True)
    ]
    within = region.begin(line.half[1:]).tolist()
    found = list[BlockPlan]()
    for layer in layers_between(parts[0], knuckles, names[0]):
        name, first = names[0] + layer.titled, [section.first, line.first]
        upper, turn = _quad(layer, length, first, [line.last], name, aft, within)
        master = _beside_body(upper, side, body)
        strip = _strip(whole, end, master.core.region)
        top, bottom = upper.nodes(side)[[0, -1]].tolist()
        bays = bays_of_whole(strip, end, top, bottom)
        seam = BlockSeam(side, master.name, tuple(upper.side(side).tolist()))
        seams = (seam, *_crease(layer, found))
        found.append(BlockPlan(name, end.kind, upper, bays, seams, (), turn, end.notes))
    (lowest,) = layers_between(parts[1], (), names[1])
    lower, turn = _quad(
        lowest, length, [line.first, section.last, line.last], (), names[1], aft, within
    )
    above, below = bays_of_parts(strip, end, upper.region, high, top, section.last)
    found[-1] = attrs.evolve(found[-1], bays=above)
    seams = (
        BlockSeam(side, master.name, tuple(lower.side(side).tolist())),
        BlockSeam("v0", found[-1].name, tuple(line.half.tolist())),
    )
    found.append(BlockPlan(names[1], end.kind, lower, below, seams, (), turn, end.notes))
    return found


def _part(whole: CellRegion, cuts: Sequence[np.ndarray], half: int, name: str) -> CellRegion:
    found = whole.with_half(cuts, half)
    if found is None:
        raise BadInputError(
            f"{name} has no cells", "in the blocks of a surface", "look at the lines at the ends"
        )
    require_disc(found, name)
    return found


def _quad(
    layer: KnuckleLayer,
    length: float,
    first: Sequence[int],
    second: Sequence[int],
    name: str,
    aft: bool | None = None,
    never: Sequence[int] = (),
) -> tuple[Quad, tuple[float, ...]]:
    """Find the four corners of a layer, beginning aft at the deck."""
    region, ends = layer.region, layer.corners
    apart = _NARROW if ends else _APART
    node, turn = four_corners(region, length, [*first, *ends], second, never, apart=apart)
    if len(node) < 4 and ends:
        # Where a chine runs into the keel there are three sides, or two: others than it are cut.
        within = [
            node
            for chord in (layer.above, layer.below)
            if chord is not None
            for node in region.begin(chord.half[1:]).tolist()
        ]
        node, turn = four_corners(
            region, length, [*first, *ends], second, [*never, *within], least=0.0, apart=apart
        )
    if len(node) != 4:
        raise BadInputError(
            f"{name} has {len(node)} corners", "in the blocks of a surface",
            "its border has to turn at four places",
        )  # fmt: skip
    if layer.above is not None:
        i = node.index(layer.above.first)
    elif layer.below is not None:
        i = (node.index(layer.below.first) + 1) % 4
    else:
        i = _first_corner(region, node, first, aft)
    order = [(i + k) % 4 for k in range(4)]
    return Quad(region, tuple(node[k] for k in order)), tuple(turn[k] for k in order)  # type: ignore[arg-type]


def _first_corner(
    region: CellRegion, node: tuple[int, ...], first: Sequence[int], aft: bool | None
) -> int:
    """Tell which of four corners is the upper one aft."""
    if aft is not None:
        at = node.index(first[0])
        return (at - 1) % 4 if aft else at
    quads = [Quad(region, tuple(node[(i + k) % 4] for k in range(4))) for i in range(4)]  # type: ignore[arg-type]
    high = [float(region.graph.place[quad.nodes("v0"), 2].mean()) for quad in quads]
    return int(np.argmax(high))
