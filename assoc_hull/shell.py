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

from assoc_hull.arguments import all_of, instance, number
from assoc_hull.geometry.patches.volume_below import VolumeBelow, integrate_below
from assoc_hull.model.tables import HasState, state_of
from assoc_hull.surface.blocks.fit_net import surface_of_net
from assoc_hull.surface.blocks.fit_options import CUTOFF, fit_options, length_of
from assoc_hull.surface.blocks.net_surface import NetSurface, ResidualTable, document_of, text_of
from assoc_hull.surface.cells.closed_mesh import ClosedMesh, mesh_of_net

if TYPE_CHECKING:
    from assoc_hull.io.cad.write import CadReport
    from assoc_hull.io.mesh.closed_mesh import MeshFile

__all__ = ["HullSurface", "surface"]

_WHERE = "in surface"


@attrs.frozen(eq=False)
class HullSurface(NetSurface):
    """The surface of a half hull: a `NetSurface` that can be measured, meshed and written."""

    @property
    def residuals(self) -> ResidualTable:
        """How far the lines lie from the surface, block by block."""
        return ResidualTable(self.blocks, self.whole)

    def below(self, draught: float | None = None) -> VolumeBelow:
        """Give volume, moments and area of the half below a waterplane, from the surface alone.

        Parameters
        ----------
        draught : float, m
            Of the waterplane, at even keel; the design draught if None.
        """
        level = self.particulars.draught if draught is None else number(draught, "draught", _WHERE)
        return integrate_below(self.patches, level)

    def mesh(self, *, half: bool = False, points: int = 4) -> ClosedMesh:
        """Give the closed mesh on the lines that the surface was fitted to.

        It is made of the lines, not of the surface: see `assoc_hull.closed_mesh`.

        Parameters
        ----------
        half : bool
            The port half only, open in the centre plane.
        points : int
            Into how many parts each piece of a line between two crossings is cut: even, 2 to 64.

        Raises
        ------
        BadInputError, OpenNetError, OpenMeshError
            As `assoc_hull.closed_mesh`.
        """
        return mesh_of_net(self.net, half=half, points=points)

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
        """Write it for CAD programs, or the closed mesh.

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
        from assoc_hull.io.surfaces.hull_surface import write_surface

        return write_surface(self, path, form, unit=unit, half=half)

    def __str__(self) -> str:
        return text_of(self)


def surface(
    hull: HasState,
    *,
    leave_out: Sequence[str] = (),
    previous: NetSurface | None = None,
    smoothing: float | None = None,
    tolerance: float | None = None,
    cutoff: float = CUTOFF,
) -> HullSurface:
    """Fit a surface to the lines of a hull.

    Parameters
    ----------
    hull : Hull
        The hull.
    leave_out : sequence of str
        Names of lines that nothing is fitted to, but from which the surface is measured.
    previous : HullSurface, optional
        An earlier surface of the hull: blocks whose lines have not moved are taken from it. One
        that was made with other options, or other lines left out, is of no use, and no error.
    smoothing : float, m3, optional
        The factor of the penalty on second derivatives; ``9.6e-10 length**3`` without it.
    tolerance : float, m, optional
        What 95 % of the distances of the body should keep; 8 mm at a length of 300 m without it.
    cutoff : float, m
        With `previous`, points of lines that have moved by less since the fit of their block was
        made count as unmoved, and so do control points. With 0 only what is the same in every bit
        is taken over: the surface then is, in every bit, the one that comes without `previous`.

    Returns
    -------
    HullSurface
        One spline surface a block, for the half y >= 0; `refitted` names the blocks fitted.

    Raises
    ------
    BadInputError, UnknownNameError
        A curve of the hull has failed; there is no such line; lines that no blocks were found
        between; numbers that are none, or below nil.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> hull = ah.examples.wigley()
    >>> found = ah.surface(hull)
    >>> found.refitted, ah.surface(hull, previous=found).refitted
    (('body',), ())
    """
    state = state_of(hull, _WHERE)
    if previous is not None:
        instance(previous, NetSurface, "previous", _WHERE)
    options = fit_options(length_of(state), smoothing, tolerance, cutoff)
    names = all_of(leave_out, str, "leave_out", _WHERE)
    found = surface_of_net(state, options, tuple(names), previous)
    return HullSurface(*attrs.astuple(found, recurse=False))
