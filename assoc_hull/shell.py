"""The surface of a hull: the face of what `surface` fits and `io` writes.

Examples
--------
>>> import assoc_hull as ah
>>> found = ah.surface(ah.examples.wigley())
>>> [block.name for block in found.blocks]
['body']
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import attrs

from assoc_hull.analysis.measured_hull import HasState, state_of
from assoc_hull.arguments import number
from assoc_hull.geometry.patches.below import Below, below
from assoc_hull.surface.blocks.fit_options import fit_options
from assoc_hull.surface.blocks.fitting import surface_of_net
from assoc_hull.surface.net_report import ResidualTable, document_of, text_of
from assoc_hull.surface.net_surface import NetSurface

if TYPE_CHECKING:
    from assoc_hull.io.cad.write import CadReport
    from assoc_hull.io.closed_mesh_file import MeshFile

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

    def write(
        self,
        path: str | os.PathLike[str],
        form: str | None = None,
        *,
        unit: str | None = None,
        half: bool = False,
    ) -> CadReport | MeshFile:
        """Write it for CAD programs, or the closed mesh; see `assoc_hull.io.hull_surface_file`.

        Parameters
        ----------
        path : path
            ``.step``, ``.stp``, ``.igs`` or ``.iges``; a mesh: ``.stl``, ``.obj``, ``.ply``,
            ``.glb``.
        form : str or None
            Where the ending does not tell it, such as "iges-surfaces" or "stl-text".
        unit : {"m", "mm"} or None
            Of the file: mm of CAD files if None, m of meshes.
        half : bool
            The half y >= 0 only; both sides otherwise.

        Raises
        ------
        BadInputError, MissingExtraError, OpenNetError, OpenMeshError
            See there.
        """
        from assoc_hull.io.hull_surface_file import write_surface

        return write_surface(self, path, form, unit=unit, half=half)

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
