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
from typing import Any

import attrs

from assoc_hull.analysis.measured_hull import HasState, state_of
from assoc_hull.arguments import number
from assoc_hull.geometry.patches.below import Below, below
from assoc_hull.surface.blocks.fit_options import fit_options
from assoc_hull.surface.blocks.fitting import surface_of_net
from assoc_hull.surface.net_report import ResidualTable, document_of, text_of
from assoc_hull.surface.net_surface import NetSurface

__all__ = ["HullSurface", "surface"]

_WHERE = "in surface"


@attrs.frozen(eq=False)
class HullSurface(NetSurface):
    """The surface of a half hull; what it holds says `assoc_hull.surface.net_surface.NetSurface`."""

    @property
    def residuals(self) -> ResidualTable:
        """How far the lines lie from the surface, block by block."""
        return ResidualTable(self.blocks)

    def below(self, draught: float | None = None) -> Below:
        """Give volume, moments and area of the half below a waterplane, from the surface alone.

        Parameters
        ----------
        draught : float, m
            Of the waterplane, at even keel; the design draught if None.
        """
        level = self.particulars.draught if draught is None else number(draught, "draught", _WHERE)
        return below(self.patches, level)

    def document(self) -> dict[str, Any]:
        """Give the report as plain values: lengths in m, angles in degrees."""
        return document_of(self)

    def __str__(self) -> str:
        return text_of(self)


def surface(
    hull: HasState,
    *,
    leave_out: Sequence[str] = (),
    smoothing: float | None = None,
    tolerance: float | None = None,
) -> HullSurface:
    """Fit a surface to the lines of a hull."""
    state = state_of(hull, _WHERE)
    options = fit_options(state.particulars.length, smoothing, tolerance)
    found = surface_of_net(state, options, tuple(leave_out))
    return HullSurface(*attrs.astuple(found, recurse=False))
