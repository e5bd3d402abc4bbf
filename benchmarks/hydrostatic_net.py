"""The Wigley hull of the benchmark as a net, ready to be lofted and measured again and again."""

from __future__ import annotations

from functools import cache

import attrs

from assoc_hull.analysis.net.cells import lay_out
from assoc_hull.analysis.net.gather import gather
from assoc_hull.geometry.curves import CurveData
from assoc_hull.geometry.floating.immersed import Immersed, Planes
from assoc_hull.geometry.floating.immersion import immersed
from assoc_hull.geometry.floating.prepared_strips import Prepared, prepare
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.surfaces.coons import Cells, CoonsStrips
from assoc_hull.model.lofting import curve_data
from tests.nets import wigley_net

__all__ = ["NetToMeasure", "net"]

STATIONS, WATERLINES = 31, 7
"""Lines with the fewest cells that make the volume right to 2e-6 in both positions."""


@attrs.frozen(eq=False)
class NetToMeasure:
    """The points of a net, and how its surface is put together."""

    points: CurveData
    cells: Cells

    def fitted(self) -> Prepared:
        """Loft the lines, lay the surface through them, integrate its tiles."""
        return prepare(CoonsStrips.on(self.cells, loft(self.points)))

    def measure(self, planes: Planes) -> Immersed:
        """Do all that an edit of the hull makes necessary."""
        return immersed(self.fitted(), planes)


@cache
def net(stations: int = STATIONS, waterlines: int = WATERLINES) -> NetToMeasure:
    """Give a net; lines have the directions of the formula at their ends."""
    state = wigley_net(stations, waterlines)
    lines = gather(state)
    layout = lay_out(lines, state.particulars.length, closed=False)
    return NetToMeasure(curve_data(state, lines.curve), layout.cells)
