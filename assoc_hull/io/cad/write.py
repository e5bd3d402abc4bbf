"""Surfaces of a hull for CAD programs: STEP or IGES, read back and compared before it is kept.

Half a hull (y >= 0, m) may be written with its image to starboard. The same surfaces give the same
bytes: headers hold a fixed time and no name of a user. OpenCASCADE writes all but bare surfaces.

Source: ISO 10303-21 and 10303-214; IGES 5.3 (US PRO, 1996), sections 4.34, 4.24, 4.148 to 4.151.
"""

from __future__ import annotations

import io
import itertools
import os
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any

import attrs
import numpy as np

from assoc_hull.arguments import all_of, choice, flag, text
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.geometry.polylines.operations import runs_where
from assoc_hull.io.cad.check_file import (
    area_of,
    breadth_flux,
    control_point_error,
    free_edges,
    is_closed_solid,
    measure_file,
    require_written,
)
from assoc_hull.io.cad.faces import SEWN, SewnShell, face_of, sew_surfaces
from assoc_hull.io.cad.kernel import MILLIMETRES, ascii_words, quiet_kernel
from assoc_hull.io.iges.surfaces import surfaces_of_iges
from assoc_hull.io.iges.write import iges_text
from assoc_hull.io.write_file import form_by_ending, write_whole

__all__ = [
    "CAD_ENDINGS",
    "CAD_FORMS",
    "CAD_UNITS",
    "CadReport",
    "both_sides",
    "cad_bytes",
    "closed_solid",
    "iges_bytes",
    "mirrored_surface",
    "off_centre",
    "step_bytes",
    "write_cad",
]

# --------------------------------------------------------------------------------------
# The half of a hull to port, and its image to starboard.

_MIRROR = np.array([1.0, -1.0, 1.0])


def both_sides(surfaces: Sequence[SplineSurface]) -> list[SplineSurface]:
    """Give surfaces to port, and their images to starboard, which are named so."""
    port = [attrs.evolve(each, name=_named(each, "port")) for each in surfaces]
    return port + [mirrored_surface(each, _named(each, "starboard")) for each in surfaces]


def off_centre(surfaces: Sequence[SplineSurface]) -> tuple[float, str]:
    """Say how far off the centre plane the nearest side of all is (m), and whose it is.

    Examples
    --------
    >>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
    >>> from assoc_hull.io.cad.write import off_centre
    >>> side = SplineSurface.bezier([[[0, 1, 0], [0, 2, 2]], [[5, 1, 0], [5, 2, 2]]], "side")
    >>> off_centre([side])
    (1.0, 'side')
    """
    found = []
    for each in surfaces:
        off = np.abs(each.restricted(*each.domain).net[..., 1])
        sides = (off[0], off[-1], off[:, 0], off[:, -1])
        found.append((min(float(side.max()) for side in sides), each.name))
    return min(found)


def _named(surface: SplineSurface, side: str) -> str:
    return f"{surface.name}, {side}" if surface.name else side


def mirrored_surface(surface: SplineSurface, name: str) -> SplineSurface:
    """Give the image of a surface in the centre plane, its normal on the same side of the hull.

    Notes
    -----
    y changes its sign, and u its sense: of the two each alone would turn the normals in.

    Examples
    --------
    >>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
    >>> from assoc_hull.io.cad.write import mirrored_surface
    >>> side = SplineSurface.bezier([[[0, 1, 0], [0, 1, 2]], [[5, 1, 0], [5, 1, 2]]], "side")
    >>> mirrored_surface(side, "other").net[0].tolist()
    [[5.0, -1.0, 0.0], [5.0, -1.0, 2.0]]
    """
    knots = surface.knots_u
    net = surface.net[::-1] * _MIRROR + 0.0
    weights = None if surface.weights is None else surface.weights[::-1].copy()
    turned = (knots[0] + knots[-1]) - knots[::-1]
    return SplineSurface(name, surface.degrees, turned, surface.knots_v, net, weights)


# --------------------------------------------------------------------------------------
# The closed solid of both sides. What a shell leaves open to port is a line that its image to
# starboard answers. Between the two a ruled face is drawn, straight across the ship, as the closed
# mesh has it: a plane where deck or transom is one. The camber of a deck is not there.

_ASIDE = 1e-3
"""A span of an edge whose middle is so far from the centre plane (mm) is to port."""


def closed_solid(sewn: SewnShell) -> Any | None:
    """Give the solid that a shell of both sides encloses; None where deck and transom do not close.

    Parameters
    ----------
    sewn : SewnShell
        Both sides, joined on the centre plane.

    Examples
    --------
    >>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
    >>> from assoc_hull.io.cad.check_file import volume_of
    >>> from assoc_hull.io.cad.faces import sew_surfaces
    >>> from assoc_hull.io.cad.kernel import quiet_kernel
    >>> from assoc_hull.io.cad.write import both_sides, closed_solid
    >>> side = SplineSurface.bezier([[[0, 0, 0], [0, 2, 3]], [[6, 0, 0], [6, 2, 3]]], "side")
    >>> with quiet_kernel():
    ...     solid = closed_solid(sew_surfaces(both_sides([side])))
    ...     print(round(volume_of(solid), 6))
    36.0
    """
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeSolid, BRepBuilderAPI_Sewing
    from OCP.BRepLib import BRepLib
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopoDS import TopoDS

    sewing = BRepBuilderAPI_Sewing(SEWN)
    for face in sewn.faces:
        sewing.Add(face)
    for cap in _caps(free_edges(sewn.shell)[0]):
        sewing.Add(face_of(cap))
    sewing.Perform()
    shell = sewing.SewedShape()
    if shell.IsNull() or shell.ShapeType() != TopAbs_ShapeEnum.TopAbs_SHELL:
        return None
    solid = BRepBuilderAPI_MakeSolid(TopoDS.Shell(shell)).Solid()
    BRepLib.OrientClosedSolid_s(solid)
    return solid if is_closed_solid(solid) else None


def _caps(edges: Sequence[Any]) -> list[SplineSurface]:
    """Rule a surface across the ship from each run of a free edge to port.

    An edge may run in the centre plane and leave it, as the end of a bossing does: there both
    sides are joined, and the run beyond is closed by itself; sewing cuts the edge at its ends.
    """
    found = []
    for edge in edges:
        spline = _spline_of(edge)
        knots = [spline.Knot(i) for i in range(1, spline.NbKnots() + 1)]
        aside = np.array([_half_breadth(spline, *span) for span in itertools.pairwise(knots)])
        runs = runs_where(aside > _ASIDE).tolist()
        found += [_ruled(spline, knots[first], knots[stop]) for first, stop in runs]
    return found


def _spline_of(edge: Any) -> Any:
    """Give the curve of an edge as a B-spline of OpenCASCADE, from end to end."""
    from OCP.BRep import BRep_Tool
    from OCP.Geom import Geom_TrimmedCurve
    from OCP.GeomConvert import GeomConvert

    first, last = BRep_Tool.Range_s(edge)
    curve = BRep_Tool.Curve_s(edge, first, last)
    return GeomConvert.CurveToBSplineCurve_s(Geom_TrimmedCurve(curve, first, last))


def _half_breadth(spline: Any, first: float, last: float) -> float:
    """Give the half-breadth (mm) amidst a span of a curve; below 0 to starboard."""
    return float(spline.Value(0.5 * (first + last)).Y())


def _ruled(spline: Any, first: float, last: float) -> SplineSurface:
    """Rule a surface from a part of a curve to its image; called by what it closes."""
    from OCP.Geom import Geom_TrimmedCurve
    from OCP.GeomConvert import GeomConvert

    part = GeomConvert.CurveToBSplineCurve_s(Geom_TrimmedCurve(spline, first, last))
    degree, knots, points = _curve_of(part)
    net = np.stack([points, points * _MIRROR], axis=1)
    chord = points[-1] - points[0]
    name = "transom" if abs(chord[2]) > np.hypot(chord[0], 1e-9) else "deck"
    return SplineSurface(name, (degree, 1), knots, np.array([0.0, 0.0, 1.0, 1.0]), net)


def _curve_of(spline: Any) -> tuple[int, FloatArray, FloatArray]:
    """Give degree, knots and control points (n, 3), m, of a curve."""
    poles = (spline.Pole(i) for i in range(1, spline.NbPoles() + 1))
    points = np.array([(each.X(), each.Y(), each.Z()) for each in poles]) / MILLIMETRES
    places = range(1, spline.NbKnots() + 1)
    knots = np.repeat(
        np.array([spline.Knot(i) for i in places]), [spline.Multiplicity(i) for i in places]
    )
    return int(spline.Degree()), knots, points


# --------------------------------------------------------------------------------------
# A shell as STEP (AP214), by OpenCASCADE. The counter that it puts behind the name of the part is
# taken off, so that bytes do not depend on what was written before.

_STEP_TIME = "2000-01-01T00:00:00"
_STEP_UNITS = {"m": "M", "mm": "MM"}


def step_bytes(
    sewn: SewnShell, names: Sequence[str], unit: str, name: str, solid: Any | None = None
) -> bytes:
    """Lay out a shell as the bytes of a STEP file, with one name for each face; unit "m" or "mm".

    A solid stands beside the shell, as a part of its own.

    Raises
    ------
    BadInputError
        OpenCASCADE does not write it.
    """
    from OCP.IFSelect import IFSelect_ReturnStatus
    from OCP.STEPControl import STEPControl_StepModelType, STEPControl_Writer

    settings = {"write.step.schema": "AP214IS", "write.step.unit": _STEP_UNITS[unit]}
    with quiet_kernel(settings):
        writer = STEPControl_Writer()
        kind = STEPControl_StepModelType.STEPControl_ShellBasedSurfaceModel
        done = writer.Transfer(sewn.shell, kind)
        if solid is not None and done == IFSelect_ReturnStatus.IFSelect_RetDone:
            done = writer.Transfer(solid, STEPControl_StepModelType.STEPControl_ManifoldSolidBrep)
        if done == IFSelect_ReturnStatus.IFSelect_RetDone:
            _name_step_faces(writer, sewn, names)
            _name_part(writer.Model(), name)
            _set_step_header(writer.Model(), name)
            out = io.BytesIO()
            done = writer.WriteStream(out)
    if done != IFSelect_ReturnStatus.IFSelect_RetDone:
        what = f"OpenCASCADE does not write these surfaces as STEP ({done.name})"
        raise BadInputError(what, "in write_cad", "write IGES")
    return out.getvalue()


def _name_step_faces(writer: Any, sewn: SewnShell, names: Sequence[str]) -> None:
    from OCP.STEPConstruct import STEPConstruct

    finder = writer.WS().TransferWriter().FinderProcess()
    for face, name in zip(sewn.faces, names, strict=True):
        STEPConstruct.FindEntity_s(finder, face).SetName(ascii_words(name))


def _name_part(model: Any, name: str) -> None:
    from OCP.StepBasic import StepBasic_Product

    called = name
    for number in range(1, model.NbEntities() + 1):
        entity = model.Value(number)
        if isinstance(entity, StepBasic_Product):
            entity.SetId(ascii_words(called))
            entity.SetName(ascii_words(called))
            called = f"{name} solid"


def _set_step_header(model: Any, name: str) -> None:
    from OCP.APIHeaderSection import APIHeaderSection_MakeHeader

    header = APIHeaderSection_MakeHeader(model)
    header.SetName(ascii_words(name))
    header.SetTimeStamp(ascii_words(_STEP_TIME))
    header.SetDescriptionValue(1, ascii_words("Surface of a hull"))
    header.SetAuthorValue(1, ascii_words(""))
    header.SetOrganizationValue(1, ascii_words(""))
    header.SetOriginatingSystem(ascii_words("assoc-hull"))


# --------------------------------------------------------------------------------------
# IGES, by OpenCASCADE: trimmed surfaces (144 on 128), which do not know their neighbours, or faces
# of a shell (514, 510), which do and which fewer programs read.

_IGES_TIME = "20000101.000000"
_IGES_UNITS = {"m": "M", "mm": "MM"}
_FACES = (144, 510)
_DIGITS = 12
"""Behind the point; of 14 and more OpenCASCADE loses the power of ten."""


def iges_bytes(
    sewn: SewnShell, names: Sequence[str], unit: str, name: str, *, shell: bool = False
) -> bytes:
    """Lay out a shell as the bytes of an IGES file, with one name for each face; unit "m" or "mm".

    With `shell`, faces share their edges (514, 510); else each is a 144 by itself. What is not
    ASCII in a name is written as ``?``.

    Raises
    ------
    BadInputError
        OpenCASCADE does not write it.
    """
    from OCP.IGESControl import IGESControl_Writer

    with quiet_kernel():
        writer = IGESControl_Writer(_IGES_UNITS[unit], int(shell))
        done = writer.AddShape(sewn.shell)
        if done:
            _set_iges_head(writer.Model(), name)
            writer.ComputeModel()
            _name_iges_faces(writer.Model(), names)
            data = _printed(writer.Model())
    if not done:
        what = "OpenCASCADE does not write these surfaces as IGES"
        raise BadInputError(what, "in write_cad", "write the form 'iges-surfaces'")
    return data


def _set_iges_head(model: Any, name: str) -> None:
    head = model.GlobalSection()
    head.SetDate(ascii_words(_IGES_TIME))
    head.SetLastChangeDate(ascii_words(_IGES_TIME))
    head.SetSendName(ascii_words(name))
    head.SetFileName(ascii_words("surfaces.igs"))
    head.SetAuthorName(ascii_words(""))
    head.SetCompanyName(ascii_words(""))
    model.SetGlobalSection(head)


def _name_iges_faces(model: Any, names: Sequence[str]) -> None:
    """Label faces, by eight letters; face and surface have the whole name as a property."""
    from OCP.IGESBasic import IGESBasic_Name

    numbers = range(1, model.NbEntities() + 1)
    entities = [model.Entity(number) for number in numbers]
    faces = [each for each in entities if each.TypeNumber() in _FACES]
    for face, name in zip(faces, names, strict=True):
        face.SetLabel(ascii_words(name[:8]))
        called = IGESBasic_Name()
        called.Init(1, ascii_words(name))
        for each in (face, face.Surface()):
            each.AddProperty(called)
        model.AddEntity(called)


def _printed(model: Any) -> bytes:
    """Print with more digits than OpenCASCADE does: its nine leave 0.05 micrometres at 100 m."""
    from OCP.IGESData import IGESData_IGESWriter

    printer, out = IGESData_IGESWriter(model), io.BytesIO()
    printer.FloatWriter().SetDefaults(_DIGITS)
    printer.SendModel(model.Protocol())
    printer.Print(out)
    return out.getvalue()


# --------------------------------------------------------------------------------------
# Files: written, read back, compared.

CAD_FORMS: Mapping[str, str] = MappingProxyType({
    "step": "STEP (AP214): one shell of faces that share their edges, and the solid it encloses",
    "iges": "IGES: trimmed surfaces (144), each by itself",
    "iges-brep": "IGES: one shell of faces that share their edges (514)",
    "iges-surfaces": "IGES: bare spline surfaces (128), by our own writer",
})  # fmt: skip
"""The forms, and what each holds."""

CAD_ENDINGS: Mapping[str, str] = MappingProxyType(
    {".step": "step", ".stp": "step", ".iges": "iges", ".igs": "iges"}
)
"""The form that the ending of a file means."""

CAD_UNITS = ("mm", "m")
"""Units of length that files are written in."""

_CENTRED = 4e-6
"""Sides nearer to the centre plane than this (m) are joined to their images."""

_WHERE = "in write_cad"


@attrs.frozen
class CadReport:
    """What was written, as it was read back.

    Attributes
    ----------
    path, form, unit : str
        Where, in which of `CAD_FORMS`, and in which unit of length.
    half : bool
        Whether it is the half y >= 0 alone.
    faces, shells : int
        How many; a form without shells has none.
    joined_edges, free_edges : int
        Edges that two faces share, and those of one face: of a hull the deck edge, the rim of a
        transom and, of a half, the centre line. 0 where the form knows no edges.
    area : float, m2
        Of all faces.
    control_point_error : float, m
        The largest distance between a control point as written and as read back.
    size : int
        Bytes.
    volume : float or None, m3
        Of the solid beside the shell, closed by deck and transom; None where there is none.
    residual : float or None, m
        How far the lines of the hull lie off its surfaces at most; None of surfaces alone.
    residual_place : str
        On which line that is, and near which crossing; empty of surfaces alone.
    left_out : tuple of str
        What the hull has and the file has not, such as bodies beside the net.
    faults : tuple of str
        What was accepted of the surface.
    """

    path: str
    form: str
    unit: str
    half: bool
    faces: int
    shells: int
    joined_edges: int
    free_edges: int
    area: float
    control_point_error: float
    size: int
    volume: float | None = None
    residual: float | None = None
    residual_place: str = ""
    left_out: tuple[str, ...] = ()
    faults: tuple[str, ...] = ()

    @property
    def words(self) -> str:
        """What was written for CAD programs, without where."""
        side = "the port half" if self.half else "both sides"
        rows = [f"{self.faces} faces, {side}, {self.area:.3f} m2"]
        if self.shells:
            shells = "1 shell" if self.shells == 1 else f"{self.shells} shells"
            rows.append(f"{shells}, {self.joined_edges} joined edges, {self.free_edges} free")
        if self.volume is not None:
            rows.append(f"beside it the solid, closed by deck and transom: {self.volume:.3f} m3")
        if self.residual is not None:
            at = f", {self.residual_place}" if self.residual_place else ""
            rows.append(f"lines lie up to {1e3 * self.residual:.1f} mm off it{at}")
        rows += [f"accepted: {each}" for each in self.faults]
        rows += self.left_out
        rows.append(f"read back: control points within {1e3 * self.control_point_error:.1e} mm")
        return "\n".join(rows)

    def __str__(self) -> str:
        return f"{self.words}\nwritten: {self.path} ({self.form}, {self.unit})"


def write_cad(
    surfaces: Sequence[SplineSurface],
    path: str | os.PathLike[str],
    form: str | None = None,
    *,
    unit: str = "mm",
    half: bool = False,
    name: str = "hull",
) -> CadReport:
    """Write surfaces for CAD programs, and see that the file holds them.

    Parameters
    ----------
    surfaces : sequence of SplineSurface
        Of the half y >= 0, m; borders that two of them share run through the same points.
    path : path
        The file; what was there is replaced by the whole of it, or stays.
    form : str or None
        One of `CAD_FORMS`; None: by the ending of the name.
    unit : {"mm", "m"}
        Of the lengths in the file.
    half : bool
        Whether to write the half alone; else its image to starboard too, joined to it on the
        centre plane.
    name : str
        What the file calls the part.

    Returns
    -------
    CadReport

    Raises
    ------
    BadInputError
        Another form or unit, no surface, surfaces that do not hang together, a file that cannot
        be written, or that is not what was to be written when it is read back.
    MissingExtraError
        OpenCASCADE is not there, for a form that needs it.

    Notes
    -----
    The same surfaces give the same bytes. A surface beside two others keeps its one face, whose
    edge is cut where these meet.
    """
    chosen = form_by_ending(path, form, tuple(CAD_FORMS), CAD_ENDINGS, _WHERE)
    data, report = cad_bytes(surfaces, chosen, unit=unit, half=half, name=name)
    write_whole(path, data)
    return attrs.evolve(report, path=os.fspath(path))


def cad_bytes(
    surfaces: Sequence[SplineSurface],
    form: str,
    *,
    unit: str = "mm",
    half: bool = False,
    name: str = "hull",
) -> tuple[bytes, CadReport]:
    """Lay out surfaces as the bytes of a file that has been read back; as `write_cad`."""
    given = all_of(surfaces, SplineSurface, "surfaces", _WHERE)
    if not given:
        raise BadInputError("there are no surfaces", _WHERE, "give one or more")
    choice(form, "form", tuple(CAD_FORMS), _WHERE)
    choice(unit, "unit", CAD_UNITS, _WHERE)
    called = text(name, "name", _WHERE)
    alone = flag(half, "half", _WHERE)
    _require_outward(given)
    if not alone and form != "iges-surfaces":
        _require_centred(given)
    whole = list(given) if alone else both_sides(given)
    if form == "iges-surfaces":
        return _bare(whole, unit, alone)
    return _by_opencascade(whole, form, unit, called, alone)


def _require_outward(surfaces: Sequence[SplineSurface]) -> None:
    """Refuse a half whose normals point to the centre plane."""
    if sum(map(breadth_flux, surfaces)) < 0.0:
        what, remedy = "normals point into the hull", "turn u or v of all surfaces"
        raise BadInputError(what, _WHERE, remedy)


def _require_centred(surfaces: Sequence[SplineSurface]) -> None:
    """Refuse a half that does not reach its image."""
    off, name = off_centre(surfaces)
    if off > _CENTRED:
        what = f"no side lies on the centre plane: the nearest, of {name!r}, is {1e3 * off:.4g} mm"
        raise BadInputError(f"{what} off it", _WHERE, "write the half alone, or close the keel")


def _bare(surfaces: list[SplineSurface], unit: str, half: bool) -> tuple[bytes, CadReport]:
    """Write bare surfaces with our own writer, and read them back with our own reader."""
    data = iges_text(surfaces, unit)
    found = surfaces_of_iges(data, "the file")[0]
    error = control_point_error(found, surfaces)
    return data.encode(), CadReport(
        "", "iges-surfaces", unit, half, len(found), 0, 0, 0, sum(map(area_of, found)), error,
        len(data),
    )  # fmt: skip


def _by_opencascade(
    surfaces: list[SplineSurface], form: str, unit: str, name: str, half: bool
) -> tuple[bytes, CadReport]:
    names, shell = [each.name for each in surfaces], form != "iges"
    with quiet_kernel():
        joined = sew_surfaces(surfaces)
        if form == "step":
            solid = None if half else closed_solid(joined)
            data = step_bytes(joined, names, unit, name, solid)
        else:
            data = iges_bytes(joined, names, unit, name, shell=shell)
        found = measure_file(data, "step" if form == "step" else "iges")
        require_written(found, surfaces, unit, shell=shell)
        volume = found.solids[0] if found.solids else None
        error = control_point_error(found.surfaces, surfaces)
    edges = (found.joined, found.free) if shell else (0, 0)
    return data, CadReport(
        "", form, unit, half, len(surfaces), found.shells, *edges, found.area, error, len(data),
        volume,
    )  # fmt: skip
