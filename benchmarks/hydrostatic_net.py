"""The Wigley hull of the benchmark as a net, ready to be lofted and measured again and again."""

from __future__ import annotations

from functools import cache

import attrs

from assoc_hull.analysis.net.curve_net import gather_net
from assoc_hull.analysis.net.surface_layout import lay_out_surface
from assoc_hull.geometry.curves import CurveData
from assoc_hull.geometry.floating.immersed_strips import PreparedStrips, prepare_strips
from assoc_hull.geometry.floating.immersion import (
    FloatingPlanes,
    ImmersedIntegrals,
    integrate_immersed,
)
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.surfaces.coons import CoonsCells, CoonsStrips
from assoc_hull.model.network import curve_data
from tests.nets import wigley_net

__all__ = ["NetToMeasure", "net"]

STATIONS, WATERLINES = 31, 7
"""Lines with the fewest cells that make the volume right to 2e-6 in both positions."""


@attrs.frozen(eq=False)
class NetToMeasure:
    """The points of a net, and how its surface is put together."""

    points: CurveData
    cells: CoonsCells

    def fitted(self) -> PreparedStrips:
        """Loft the lines, lay the surface through them, integrate its tiles."""
        return prepare_strips(CoonsStrips.on(self.cells, loft(self.points)))

    def measure(self, planes: FloatingPlanes) -> ImmersedIntegrals:
        """Do all that an edit of the hull makes necessary."""
        return integrate_immersed(self.fitted(), planes)


@cache
def net(stations: int = STATIONS, waterlines: int = WATERLINES) -> NetToMeasure:
    """Give a net; lines have the directions of the formula at their ends."""
    state = wigley_net(stations, waterlines)
    lines = gather_net(state)
    layout = lay_out_surface(lines, state.particulars.length, closed=False)
    return NetToMeasure(curve_data(state, lines.curve), layout.cells)
