"""Components of a zero set: lines that are joined, points, edges of patches.

Examples
--------
>>> from assoc_hull.geometry.patches.components import ComponentKind
>>> [kind.value for kind in ComponentKind]
['closed', 'open', 'junction', 'isolated', 'edge_line']
"""

from __future__ import annotations

from enum import StrEnum

import attrs

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = ["Component", "ComponentKind", "EndKind"]


class ComponentKind(StrEnum):
    """What a component is.

    CLOSED: a loop. OPEN: a line with two ends. JUNCTION: lines that meet at cells in which the
    sign is undecided or nil, or at a point. ISOLATED: such cells alone, with no line: a point
    contact, a loop smaller than they are, or a line that the curvature touches without changing
    sign; which of these is not decided. EDGE_LINE: edges of patches along which the polynomial
    is nil.
    """

    CLOSED = "closed"
    OPEN = "open"
    JUNCTION = "junction"
    ISOLATED = "isolated"
    EDGE_LINE = "edge_line"


class EndKind(StrEnum):
    """Where a line ends.

    BORDER: on the border of its surface. KNOT_LINE: on a border of two patches, where the
    curvature jumps and the line does not go on. JUNCTION: at undecided or nil cells, or at a
    point where other lines end as well.
    """

    BORDER = "border"
    KNOT_LINE = "knot-line"
    JUNCTION = "junction"


@attrs.frozen(eq=False)
class Component:
    """One connected part of the zero set.

    Attributes
    ----------
    kind : ComponentKind
        What it is.
    chains : tuple of (n,) int
        The arcs of each of its lines, in the order of a walk with the positive side on the left
        (`chains.forward` tells which arcs are walked as they run).
    loops : tuple of bool
        Whether each of these lines is closed.
    cells : (c,) int
        The undecided and nil cells that belong to it.
    edges : (e, 2) int
        Of an edge line, the patch and the side (0: u = 0, 1: u = 1, 2: v = 0, 3: v = 1).
    patches : (p,) int
        The patches it touches, in rising order.
    ends : (k, 2)
        Parameters, on the surface, of the beginning and the end of each line that is not closed.
    end_kinds : tuple of EndKind
        What each of these ends is; as many of them as are junctions meet there.
    tags : tuple of str
        "singular": the surface has no tangent plane there, so that this is no feature of its
        curvature. "knot-line": a line ends where the curvature jumps. "tangent": a line was
        followed through undecided cells in which it is proven to be a graph. "flat": it touches
        cells in which the polynomial is nil. "gap": a line was followed over a gap in which the
        polynomial is nil within its error.
    """

    kind: ComponentKind
    chains: tuple[IntArray, ...]
    loops: tuple[bool, ...]
    cells: IntArray
    edges: IntArray
    patches: IntArray
    ends: FloatArray
    end_kinds: tuple[EndKind, ...]
    tags: tuple[str, ...]

    def __attrs_post_init__(self) -> None:
        freeze(self.cells, self.edges, self.patches, self.ends, *self.chains)

    @property
    def meetings(self) -> int:
        """How many ends of lines meet at junctions: 4 where two lines cross."""
        return self.end_kinds.count(EndKind.JUNCTION)
