"""What methods of a hull give back, where it can be written to files.

They add to what `surface` and `analysis` find that it can be written, which these packages, below
`io`, cannot know.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from functools import wraps
from typing import TYPE_CHECKING, Any, overload

import attrs

from assoc_hull.analysis.production_arcs import ArcLines, arc_lines
from assoc_hull.arguments import (
    all_of,
    instance,
    not_negative,
    number,
    positive,
)
from assoc_hull.display import ShownAsText
from assoc_hull.edit.document import HasDocument
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.geometry.patches.volume_below import VolumeBelow, integrate_below
from assoc_hull.io.export.arcs import write_arcs
from assoc_hull.io.tables.plates import write_plates
from assoc_hull.model.objects import Curve, Group, Line
from assoc_hull.model.tables import HasState, state_of
from assoc_hull.surface.blocks.fit_net import surface_of_net
from assoc_hull.surface.blocks.fit_options import CUTOFF, fit_options, length_of
from assoc_hull.surface.blocks.fitted_surface import (
    FittedSurface,
    ResidualTable,
    document_of,
    text_of,
)
from assoc_hull.surface.cells.closed_mesh import ClosedMesh, mesh_of_net
from assoc_hull.surface.plating.hull_plates import HullPlateTable, hull_plates
from assoc_hull.surface.plating.hull_seams import HullSeams
from assoc_hull.surface.plating.plate_table import PlateTable
from assoc_hull.surface.plating.rival_fits import other_fits
from assoc_hull.surface.plating.surface_plates import Seams
from assoc_hull.surface.plating.surface_plates import plates as find_plates

if TYPE_CHECKING:
    from assoc_hull.io.cad.write import CadReport
    from assoc_hull.io.mesh.closed_mesh import MeshFile

__all__ = [
    "HullPlates",
    "HullSurface",
    "Plates",
    "ProductionArcs",
    "arcs_of_hull",
    "plates",
    "plates_of_hull",
    "surface_of_hull",
]

_FINEST, _COARSEST = 1e-6, 1.0
"""m: finer is the rounding of coordinates, coarser are no lines of a ship."""


@attrs.frozen(eq=False)
class ProductionArcs(ArcLines):
    """Lines of a hull as arcs and straight pieces, which can be written."""

    def save(self, path: str | os.PathLike[str], entities: str = "polylines") -> None:
        """Write the arcs, as a drawing (``.dxf``) or as a table (``.csv``).

        Parameters
        ----------
        path : path
            The file; what was there is replaced by the whole of it, or stays.
        entities : {"polylines", "arcs"}
            Of a drawing: one polyline a curve, exact to the last digit; or ARC and LINE one by
            one, for machines that read nothing else.

        Raises
        ------
        BadInputError, MissingExtraError
            Another ending, other entities, a file that cannot be written; no ezdxf for a drawing.
        """
        write_arcs(self, path, entities)


def arcs_of_hull(
    hull: HasDocument,
    lines: Sequence[Group | Line | Curve | str] | Group | Line | Curve | str | None,
    within: float,
    least_radius: float,
) -> ProductionArcs:
    """Make chains of arcs of the lines of a hull; lengths in m."""
    where = "in production_arcs"
    state = state_of(hull, where)
    hull.document.require_ended("production_arcs")
    tolerance = positive(within, "within", where)
    if not _FINEST <= tolerance <= _COARSEST:
        what = f"within is {tolerance:g} m"
        raise BadInputError(what, where, f"give {_FINEST:g} to {_COARSEST:g} m")
    radius = not_negative(least_radius, "least_radius", where)
    found = arc_lines(state, lines, tolerance, radius)
    return ProductionArcs(*attrs.astuple(found, recurse=False))


@attrs.frozen(eq=False)
class Plates(PlateTable):
    """Plates that can be written; see `assoc_hull.surface.plating.plate_table.PlateTable`."""

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the plates, as a table (``.csv``) or as a document (``.json``).

        `assoc_hull.plot.plates.plate_book.plate_sheet` draws them on a sheet, with the same table.

        Parameters
        ----------
        path : path
            The file; what was there is replaced by the whole of it, or stays.

        Raises
        ------
        BadInputError
            Another ending, or a file that cannot be written.
        """
        write_plates(self, path)


@attrs.frozen(eq=False)
class HullPlates(HullPlateTable):
    """Plates of a hull that can be written.

    What they hold says `assoc_hull.surface.plating.hull_plates.HullPlateTable`.
    """

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the plates, as a table (``.csv``) or as a document (``.json``).

        `assoc_hull.plot.plates.hull_map.hull_map` draws them on the hull.

        Parameters
        ----------
        path : path
            The file; what was there is replaced by the whole of it, or stays.

        Raises
        ------
        BadInputError
            Another ending, or a file that cannot be written.
        """
        write_plates(self, path)


Surfaces = SplineSurface | Sequence[SplineSurface] | FloatArray
"""What is cut along lines of constant parameter, or not at all."""


@overload
def plates(
    surfaces: HasState | FittedSurface | Sequence[SplineSurface], seams: HullSeams, **options: Any
) -> HullPlates: ...


@overload
def plates(
    surfaces: Surfaces | FittedSurface,
    seams: Seams | Sequence[Seams | None] | None = None,
    *args: Any,
    **options: Any,
) -> Plates: ...


@wraps(find_plates)
def plates(surfaces: Any, seams: Any = None, *args: Any, **options: Any) -> Plates | HullPlates:
    """Find plates of surfaces, or of a hull; see `find_plates` and `plates_of_hull`."""
    if isinstance(seams, HullSeams):
        return plates_of_hull(surfaces, seams, *args, **options)
    given = surfaces.patches if isinstance(surfaces, FittedSurface) else surfaces
    return Plates(*attrs.astuple(find_plates(given, seams, *args, **options), recurse=False))


@wraps(hull_plates)
def plates_of_hull(surface: Any, seams: HullSeams, *args: Any, **options: Any) -> HullPlates:
    """Find plates of a hull; of a hull its surface is made, and two more to compare with."""
    if hasattr(surface, "state"):
        state = state_of(surface, "in plates of a hull")
        usual = fit_options(length_of(state))
        if "others" not in options:
            options["others"] = other_fits(state, usual)
        surface = surface_of_net(state, usual)
    found = hull_plates(surface, seams, *args, **options)
    return HullPlates(*attrs.astuple(found, recurse=False))


@attrs.frozen(eq=False, repr=False)
class HullSurface(ShownAsText, FittedSurface):
    """The surface of a half hull: a `FittedSurface` that can be measured, meshed and written."""

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
        level = (
            self.particulars.draught
            if draught is None
            else number(draught, "draught", "in surface")
        )
        return integrate_below(self.patches, level)

    def mesh(self, *, half: bool = False, points: int = 4) -> ClosedMesh:
        """Give the closed mesh on the lines that the surface was fitted to.

        It is made of the lines, not of the surface: see `Hull.mesh`.

        Parameters
        ----------
        half : bool
            The port half only, open in the centre plane.
        points : int
            Into how many parts each piece of a line between two crossings is cut: even, 2 to 64.

        Raises
        ------
        BadInputError, OpenNetError, OpenMeshError
            As `Hull.mesh`.
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
        accept: bool = False,
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
        accept : bool
            Write patches too that cross the centre plane or leave their residual limits.

        Raises
        ------
        BadInputError, MissingExtraError, NotSoundError, OpenNetError, OpenMeshError
            See there.
        """
        from assoc_hull.io.surfaces.hull_surface import write_surface

        return write_surface(self, path, form, unit=unit, half=half, accept=accept)

    def __str__(self) -> str:
        return text_of(self)


def surface_of_hull(
    hull: HasState,
    *,
    leave_out: Sequence[str] = (),
    previous: FittedSurface | None = None,
    smoothing: float | None = None,
    tolerance: float | None = None,
    cutoff: float = CUTOFF,
) -> HullSurface:
    """Fit a surface to the lines of a hull."""
    where = "in surface"
    state = state_of(hull, where)
    if previous is not None:
        instance(previous, FittedSurface, "previous", where)
    options = fit_options(length_of(state), smoothing, tolerance, cutoff)
    names = all_of(leave_out, str, "leave_out", where)
    found = surface_of_net(state, options, tuple(names), previous)
    return HullSurface(*attrs.astuple(found, recurse=False))
