"""The surface through a net, with its layout: laid out, or put on other lines."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import attrs

from assoc_hull.analysis.net.curve_net import CurveNet
from assoc_hull.analysis.net.kept_layout import KeptLayout
from assoc_hull.analysis.net.surface_layout import SurfaceLayout
from assoc_hull.geometry.curves import FloatArray, Strips
from assoc_hull.geometry.surfaces.coons import CoonsStrips
from assoc_hull.model.program.engine import is_compiled

if TYPE_CHECKING:
    from assoc_hull.geometry.floating.compiled_immersion import SurfaceRows
    from assoc_hull.geometry.surfaces.compiled_cells import PutCells

__all__ = ["NetSurface"]


@attrs.frozen(eq=False)
class NetSurface:
    """A surface; arrays that compiled code has made are brought into other forms when one asks.

    Attributes
    ----------
    known : SurfaceLayout
        Its layout; what it was before it was put on other lines, if `put` says how.
    given : Strips or None
        The surface itself.
    put : (PutCells, KeptLayout, CurveNet) or None
        Its cells on other lines; and what tells where its strips are there.
    """

    known: SurfaceLayout
    given: Strips | None
    put: tuple[PutCells, KeptLayout, CurveNet] | None = None

    @classmethod
    def on_lines(cls, kept: KeptLayout, net: CurveNet) -> NetSurface | None:
        """Put a layout on lines; None where it does not fit. Compiled or not, the bits agree."""
        if not is_compiled():
            found = kept.laid(net)
            if found is None:
                return None
            layout, walked = found
            return cls(layout, CoonsStrips.on(layout.cells, net.batch, walked))
        from assoc_hull.geometry.surfaces.compiled_cells import put_cells

        cells = put_cells(kept.structure, net.batch, net.place) if kept.fits(net) else None
        return None if cells is None else cls(kept.layout, None, (cells, kept, net))

    @cached_property
    def layout(self) -> SurfaceLayout:
        """Which lines bound which cell."""
        if self.put is None:
            return self.known
        cells, kept, net = self.put
        return attrs.evolve(
            self.known, cells=cells.cells, cell=cells.cell.copy(), frames=kept.moved_frames(net)
        )

    @cached_property
    def strips(self) -> Strips:
        """The surface as strips."""
        if self.given is not None:
            return self.given
        assert self.put is not None
        return self.put[0].strips

    def deck_edge(self, net: CurveNet) -> FloatArray:
        """Give places along the deck edge, as `SurfaceLayout.deck_edge`."""
        found = self.put[1].deck_edge(net) if self.put is not None else None
        return self.layout.deck_edge(net) if found is None else found

    @cached_property
    def rows(self) -> SurfaceRows | None:
        """The surface as compiled code takes it; None if there is more to it than cells."""
        from assoc_hull.geometry.floating.compiled_immersion import SurfaceRows

        if self.given is None and self.put is not None:
            return SurfaceRows.put(self.put[0])
        return SurfaceRows.of(self.given) if isinstance(self.given, CoonsStrips) else None
