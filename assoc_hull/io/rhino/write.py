"""A hull as a file of Rhino: its lines as curves, the surface through them, the closed mesh.

Each line lies on the layer of its group by its name, in curves that are the very splines of the
net; the surface is that of `assoc_hull.surface.blocks`, both sides, and the mesh that of
`assoc_hull.surface.cells`. User text tells what a spline does not, so that the hull comes back as
it was. Files hold the time at which they were written: the same hull gives other bytes.
"""

from __future__ import annotations

import tempfile
import uuid
from pathlib import Path
from typing import Any

import attrs
import numpy as np

from assoc_hull.analysis.net.curve_net import gather_net
from assoc_hull.errors import AssocHullError, BadInputError, MissingExtraError, NotSoundError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.geometry.splines.control_polygon import control_polygon
from assoc_hull.io.lines.line_points import splines_of
from assoc_hull.io.lines.own_lines import IMAGE, MARK, curve_texts, hull_text, tell_losses
from assoc_hull.io.reports import ExportBook
from assoc_hull.model.kinds import FAMILIES
from assoc_hull.model.tables import HullState
from assoc_hull.surface.blocks.fit_net import surface_of_net
from assoc_hull.surface.blocks.fit_options import fit_options, length_of
from assoc_hull.surface.blocks.fitted_surface import require_sound_surface
from assoc_hull.surface.cells.closed_mesh import fine_mesh_of_state
from assoc_hull.surface.volume_check import displaced_of, mesh_faults, mesh_off

__all__ = ["rhino_file", "rhino_module"]

_ACROSS = np.array([1.0, -1.0, 1.0])
_VERSION = 7
"""Of the file: what programs of some years ago read."""

_COLOURS = {
    "boundary": (0, 0, 0), "sections": (0, 0, 200), "waterlines": (0, 130, 0),
    "buttocks": (200, 0, 0), "surface": (120, 120, 160), "mesh": (160, 160, 160),
}  # fmt: skip


def rhino_module() -> Any:
    """Give rhino3dm.

    Raises
    ------
    MissingExtraError
        It is not installed.
    """
    try:
        import rhino3dm
    except ImportError as error:
        raise MissingExtraError("rhino3dm", "rhino") from error
    return rhino3dm


def rhino_file(state: HullState, book: ExportBook) -> bytes:
    """Give the bytes of a file of Rhino.

    Parameters
    ----------
    state : HullState
        The hull.
    book : ExportBook
        Tells the unit, "m" or "mm", and takes what was written and what could not be.

    Raises
    ------
    BadInputError, MissingExtraError
        A curve has failed; rhino3dm is not installed.
    """
    file = _File.begin(book)
    _add_lines(file, state)
    tell_losses(state, book)
    try:
        surface = surface_of_net(state, fit_options(length_of(state)))
        require_sound_surface(surface, accept=book.accept)
        for patch in surface.patches:
            file.add_surface(patch)
    except NotSoundError as error:
        book.leave_out("surface", "the hull", str(error))
    except AssocHullError as error:
        book.leave_out("surface", "the hull", f"none can be fitted: {error}")
    try:
        by_lines = displaced_of(state)
        mesh = fine_mesh_of_state(state, lambda made: mesh_off(made, by_lines))
        faults = mesh_faults(mesh, by_lines, gather_net(state))
        if faults and not book.accept:
            raise NotSoundError("the closed mesh", faults)
        file.add_mesh("closed mesh", mesh.xyz, mesh.triangle[: mesh.report.triangles])
        for each in mesh.bodies:
            file.add_mesh(each.name, mesh.xyz, mesh.triangle[each.first : each.last])
    except NotSoundError as error:
        book.leave_out("mesh", "the hull", str(error))
    except AssocHullError as error:
        book.leave_out("mesh", "the hull", f"none closes: {error}")
    file.model.Strings[MARK] = hull_text(state)
    return file.bytes()


def _add_lines(file: _File, state: HullState) -> None:
    """Add all lines, family by family, within one by place and name."""
    table, book = state.lines, file.book
    lines = sorted(
        state.live("lines").tolist(),
        key=lambda i: (
            FAMILIES[state.family(i).name].rank, bool(table.planar[i]),
            float(np.nan_to_num(table.offset[i])), str(table.name[i]),
        ),
    )  # fmt: skip
    for line in lines:
        group = str(state.groups.name[table.group[line]])
        layer = file.layer(group, state.family(line).name)
        for spline, text in zip(splines_of(state, line), curve_texts(state, line), strict=True):
            curve = control_polygon(spline)
            file.add_curve(curve.knots, curve.points, str(table.name[line]), layer, text)
            book.curves, book.points = book.curves + 1, book.points + len(curve.points)
    book.lines = len(lines)


@attrs.define(eq=False)
class _File:
    """A file in the making."""

    rhino: Any
    model: Any
    book: ExportBook
    count: int = 0
    layers: dict[str, int] = attrs.field(factory=dict)

    @classmethod
    def begin(cls, book: ExportBook) -> _File:
        rhino = rhino_module()
        model = rhino.File3dm()
        units = {"m": rhino.UnitSystem.Meters, "mm": rhino.UnitSystem.Millimeters}
        model.Settings.ModelUnitSystem = units[book.unit]
        model.Settings.ModelAbsoluteTolerance = 1e-4 * book.scale
        model.ApplicationName = "assoc-hull"
        return cls(rhino, model, book)

    def layer(self, name: str, family: str) -> int:
        """Give the layer of a name, which is made if it is not there."""
        if name not in self.layers:
            layer = self.rhino.Layer()
            layer.Name = name
            layer.Color = (*_COLOURS.get(family, (110, 0, 110)), 255)
            self.layers[name] = self.model.Layers.Add(layer)
        return self.layers[name]

    def attributes(self, name: str, layer: int, text: str) -> Any:
        """Give name, layer and user text of the next object."""
        found = self.rhino.ObjectAttributes()
        found.Name, found.LayerIndex = name, layer
        self.count += 1
        found.Id = str(uuid.UUID(int=self.count))
        found.SetUserString(MARK, text)
        return found

    def add_curve(
        self, knots: FloatArray, points: FloatArray, name: str, layer: int, text: str
    ) -> None:
        """Add a cubic B-spline, control points (n, 3) in m."""
        curve = self.rhino.NurbsCurve(3, False, 4, len(points))
        for i, (x, y, z) in enumerate((points * self.book.scale + 0.0).tolist()):
            curve.Points[i] = self.rhino.Point4d(x, y, z, 1.0)
        # Rhino has no first and no last knot: they say nothing.
        for i, knot in enumerate(knots[1:-1].tolist()):
            curve.Knots[i] = knot
        if not curve.IsValid:
            raise BadInputError("rhino3dm does not take the curve", f"in {name}", "report this")
        self.model.Objects.AddCurve(curve, self.attributes(name, layer, text))

    def add_surface(self, patch: SplineSurface) -> None:
        """Add a surface and its image to starboard; its normal looks out there, too."""
        layer = self.layer("surface", "surface")
        for side, net in (("port", patch.net), ("starboard", patch.net[::-1] * _ACROSS)):
            knots_u = patch.knots_u
            if side == "starboard":
                knots_u = knots_u[0] + knots_u[-1] - knots_u[::-1]
            made = self._surface(patch, net, knots_u)
            self.model.Objects.AddSurface(
                made, self.attributes(f"{patch.name} {side}".strip(), layer, IMAGE)
            )

    def _surface(self, patch: SplineSurface, net: FloatArray, knots_u: FloatArray) -> Any:
        rows, columns = net.shape[:2]
        (m, n), rhino = patch.degrees, self.rhino
        made = rhino.NurbsSurface.Create(3, False, m + 1, n + 1, rows, columns)
        scaled = (net * self.book.scale + 0.0).tolist()
        for i in range(rows):
            for j in range(columns):
                made.Points[i, j] = rhino.Point4d(*scaled[i][j], 1.0)
        for side, knots in ((made.KnotsU, knots_u), (made.KnotsV, patch.knots_v)):
            for i, knot in enumerate(knots[1:-1].tolist()):
                side[i] = knot
        return made

    def add_mesh(self, name: str, xyz: FloatArray, triangle: IntArray) -> None:
        """Add triangles as one mesh, with the vertices that they use."""
        used, face = np.unique(triangle, return_inverse=True)
        mesh = self.rhino.Mesh()
        mesh.Vertices.UseDoublePrecisionVertices = True
        for x, y, z in (xyz[used] * self.book.scale + 0.0).tolist():
            mesh.Vertices.Add(x, y, z)
        for a, b, c in face.reshape(-1, 3).tolist():
            mesh.Faces.AddFace(a, b, c)
        layer = self.layer("mesh", "mesh")
        self.model.Objects.AddMesh(mesh, self.attributes(name, layer, IMAGE))

    def bytes(self) -> bytes:
        """Give the file, which the library writes to a place of its own first."""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "hull.3dm"
            if not self.model.Write(str(path), _VERSION):
                raise BadInputError("rhino3dm cannot write it", "in export", "check free space")
            return path.read_bytes()
