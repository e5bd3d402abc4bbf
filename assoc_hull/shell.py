"""The surface of a hull: the face of what `surface` fits and `io` writes.

Examples
--------
>>> import assoc_hull as ah
>>> found = ah.surface(ah.examples.wigley())
>>> [block.name for block in found.blocks]
['body']
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs

from assoc_hull.analysis.measured_hull import HasState, state_of
from assoc_hull.surface.blocks.fitting import surface_of_net
from assoc_hull.surface.net_surface import NetSurface

__all__ = ["HullSurface", "surface"]


@attrs.frozen(eq=False)
class HullSurface(NetSurface):
    """A surface that can be written; what it holds says `assoc_hull.surface.net_surface.NetSurface`."""


def surface(hull: HasState, *, leave_out: Sequence[str] = ()) -> HullSurface:
    """Fit a surface to the lines of a hull."""
    found = surface_of_net(state_of(hull, "in surface"), leave_out)
    return HullSurface(*attrs.astuple(found, recurse=False))
