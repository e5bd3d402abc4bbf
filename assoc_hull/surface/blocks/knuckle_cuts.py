"""Where blocks are cut along knuckle lines, so that the surface has a crease there.

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

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import IntArray, freeze
from assoc_hull.surface.blocks.cell_regions import CellRegion, RegionChord
from assoc_hull.surface.cells.net_graph import NetGraph

__all__ = ["KnuckleCut", "KnuckleLayer", "knuckle_cuts", "layers_between", "require_disc"]


_TURN = 3.0
"""A line at which half of the sections turn by less, degrees, is followed by a smooth surface, as
the upper knuckle of the supply ship is: 0.7 there."""


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


def knuckle_cuts(whole: CellRegion) -> tuple[KnuckleCut, ...]:
    """Find the knuckle lines that run from end to end of a half hull, from the deck down."""
    graph = whole.graph
    names = dict.fromkeys(graph.net.name[c] for c in np.flatnonzero(graph.net.knuckle).tolist())
    found = list[tuple[int, KnuckleCut]]()
    for name in names:
        half = _from_end_to_end(whole, name)
        if half is not None and _turns_sections(graph, half, name):
            above = whole.with_half([half], int(half[0]) ^ 1)
            found.append((0 if above is None else int(above.inside.sum()), KnuckleCut(name, half)))
    return tuple(cut for _, cut in sorted(found, key=lambda each: (each[0], each[1].name)))


def _from_end_to_end(whole: CellRegion, name: str) -> IntArray | None:
    """Give the half-edges of a knuckle line from the aft border to the fore one, or None."""
    graph = whole.graph
    curves = [c for c, each in enumerate(graph.net.name) if each == name]
    own = np.flatnonzero(np.isin(graph.curve, curves) & whole.interior)
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


def _turns_sections(graph: NetGraph, half: IntArray, name: str) -> bool:
    """Tell whether every section that a line crosses has a knuckle there, and half a sharp one."""
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
            return False
        sine = np.linalg.norm(np.cross(batch.leave[row], batch.arrive[row]))
        turns.append(float(np.degrees(np.arctan2(sine, batch.leave[row] @ batch.arrive[row]))))
    return bool(turns) and float(np.median(turns)) >= _TURN


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
