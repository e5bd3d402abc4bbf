"""Lines of a hull cut from its surfaces: IGES by our own reader or OpenCASCADE, and STEP.

Surfaces are triangulated once and cut as any mesh is, which finds pieces, ends and boundary curves;
then each point is moved onto the surface that its triangle stands for, in the plane of its line.
Triangles and surfaces are in axes of the file, lines in ship axes (m); `AxisChange` goes between.

Examples
--------
>>> import tempfile
>>> from pathlib import Path
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> from assoc_hull.io.surfaces.surface_file import write_surfaces
>>> from assoc_hull.io.slicing.surface_lines import cad_kind
>>> plate = SplineSurface.bezier([[[0, 0, 0], [0, 1, 0]], [[2, 0, 0], [2, 1, 0]]], "plate")
>>> with tempfile.TemporaryDirectory() as folder:
...     path = Path(folder) / "plate.igs"
...     write_surfaces([plate], path)
...     cad_kind(path)
'iges'
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.arguments import regular_file
from assoc_hull.errors import BadInputError, MissingExtraError, NeedsCadError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.plane_intersection import intersect_plane
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.geometry.patches.triangulation import Facets
from assoc_hull.geometry.surfaces.triangles import check_mesh
from assoc_hull.io.cad.faces import FINE, HullFaces, facets_at_scale, hull_size
from assoc_hull.io.digitised.rhino import rhino_shows, tell_left_out
from assoc_hull.io.iges.curves import holds_surfaces
from assoc_hull.io.iges.file import UNITS, IgesFile, looks_like_iges
from assoc_hull.io.iges.surfaces import surfaces_of_iges
from assoc_hull.io.lines.several_hulls import HullChoice
from assoc_hull.io.lines.slices import (
    AXES,
    Gaps,
    HullSlices,
    LinePiece,
    SliceLine,
    settled_gaps,
)
from assoc_hull.io.mesh.frame import AxisChange, place_mesh, refuse_tilt
from assoc_hull.io.mesh.one_hull import place_one_hull
from assoc_hull.io.mesh.repair import mend_mesh
from assoc_hull.io.placing.options import FrameOptions
from assoc_hull.io.reports import Notebook, Tell, no_progress
from assoc_hull.io.rhino.read import is_rhino, read_rhino
from assoc_hull.io.slicing.cut_planes import Places
from assoc_hull.io.slicing.mesh_lines import cut_placed, in_ship_axes
from assoc_hull.io.units import METRES, checked_unit, refuse_other_unit
from assoc_hull.tolerance import length_factor

__all__ = [
    "AxisChange",
    "cad_kind",
    "faces_of_file",
    "project_to_surfaces",
    "read_surface_lines",
    "slice_surfaces",
]

_FAR = 0.02
"""A point of a surface farther (m), of a hull under 100 m less in proportion,
from the triangles is not the one meant."""

_LEAST_SINE = 0.03
"""Where a plane cuts at a smaller angle (sine), a point stays on its triangle."""


def project_to_surfaces(
    xyz: FloatArray,
    axis: IntArray,
    offset: FloatArray,
    owner: IntArray,
    facets: Facets,
    surfaces: Sequence[SplineSurface | None],
    motion: AxisChange,
    factor: float = 1.0,
) -> tuple[FloatArray, FloatArray, NDArray[np.bool_]]:
    """Move points that were cut from triangles onto their surfaces, each in its plane.

    Points `xyz` (n, 3) m, with the `axis` (n,) that is constant on their line, its `offset` (n,) m
    and the triangle `owner` (n,) of each; `factor` is that of lengths, by the size.
    Gives points (n, 3), the sine of the angle between plane
    and surface (n,), and which lie on a surface now (n,).
    """
    there = motion.back(xyz)
    uv = _parameters(there, facets.mesh.corners[owner], facets.uv[owner])
    column, place = motion.plane(axis, offset)
    centre = xyz[:, 1] == 0.0
    # Points of the centre plane stay in it: the axis and offset of y = 0 are a second constraint.
    middle, zero = motion.plane(np.array([1]), np.zeros(1))
    out, sine, good = xyz.copy(), np.ones(len(xyz)), np.zeros(len(xyz), np.bool_)
    for number in np.unique(facets.surface[owner]).tolist():
        rows = np.flatnonzero(facets.surface[owner] == number)
        second = centre[rows], int(middle[0]), float(zero[0])
        surface = surfaces[number]
        if surface is None:
            continue
        found = intersect_plane(surface, uv[rows], column[rows], place[rows], second)
        away = np.sqrt(((found.xyz - there[rows]) ** 2).sum(axis=1))
        mine = (found.off < factor * 1e-7) & (found.sine > _LEAST_SINE)
        mine &= away < factor * _FAR
        good[rows] = mine
        out[rows[mine]] = motion.ahead(found.xyz[mine])
        sine[rows] = found.sine
    out[np.arange(len(out)), axis] = offset
    out[centre, 1] = 0.0
    return out, sine, good


def _parameters(xyz: FloatArray, corner: FloatArray, uv: FloatArray) -> FloatArray:
    """Give surface parameters (n, 2) of points on triangles (n, 3, 3), from those of corners."""
    b, c, p = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0], xyz - corner[:, 0]
    bb, bc, cc = ((one * other).sum(axis=1) for one, other in ((b, b), (b, c), (c, c)))
    pb, pc = (p * b).sum(axis=1), (p * c).sum(axis=1)
    det = np.maximum(bb * cc - bc * bc, 1e-300)
    part = np.clip(np.stack([cc * pb - bc * pc, bb * pc - bc * pb], axis=1) / det[:, None], 0, 1)
    # Barycentric parts may leave the triangle by rounding, of a sliver by much.
    part[np.abs(part) < 1e-9] = 0.0
    part /= np.maximum(part.sum(axis=1), 1.0)[:, None]
    first = 1.0 - part.sum(axis=1)
    return np.asarray(first[:, None] * uv[:, 0] + part[:, :1] * uv[:, 1] + part[:, 1:] * uv[:, 2])


_SAG = 1e-3
"""Chords between the points that are kept pass the others no farther off than this (m), of a hull
under 100 m less in proportion: what is fitted to them follows the surface between them, too."""

_POINTS, _TURN = 100.0, 0.05
"""A piece keeps this many points, and one more wherever it turns by this much (rad)."""


def slice_surfaces(
    faces: HullFaces,
    *,
    stations: Places = 41,
    waterlines: Places = 20,
    buttocks: Places = 12,
    scale: float = 1.0,
    axes: str = "auto",
    gaps: Gaps | float | None = None,
    length: float | None = None,
    name: str = "hull",
    tell: Tell = no_progress,
    frame: FrameOptions | None = None,
    choice: HullChoice | None = None,
) -> HullSlices:
    """Cut surfaces into stations, waterlines, buttocks and boundary curves.

    Parameters
    ----------
    faces : HullFaces
        Whole hull or half.
    stations, waterlines, buttocks, scale, axes, gaps, length, name, tell, frame, choice
        As for `assoc_hull.io.slicing.mesh_lines.slice_mesh`.

    Returns
    -------
    HullSlices
        Points lie on the surfaces to rounding, but for those that its report counts.

    Raises
    ------
    BadInputError, NoMeetingError
        As for `assoc_hull.io.slicing.mesh_lines.slice_mesh`; or surfaces of no ship's length.
    """
    tell("making triangles of the surfaces", 0, 0)
    book = Notebook()
    for note in faces.notes:
        book.assume("file", "the surfaces", note)
    size = hull_size(faces, scale, book)
    factor = length_factor(length or size)
    if factor < 1.0:
        what = f"all limits of gaps and features are {factor:.3g} of those of a ship of 100 m"
        book.assume("small", "the surfaces", f"{what}, since it is short", length or size)
    facets = facets_at_scale(faces, scale, size, book, factor)
    check_mesh(facets.mesh)
    mended = mend_mesh(facets.mesh, book)
    refuse_tilt(mended, "the surfaces")
    metres = scale * METRES.get(faces.unit, 1.0)
    ends = (frame or FrameOptions()).ends(metres)
    mended, turned = place_one_hull(
        mended, lambda each, notes: place_mesh(each, axes, notes, 2.0 * FINE * size, ends),
        choice or HullChoice(), metres, book, turned=axes != "auto",
    )  # fmt: skip
    placed, found = in_ship_axes(turned, mended, metres, frame, book, "the surfaces")
    motion = AxisChange.between(mended.xyz, placed.xyz)
    wanted = {"sections": stations, "waterlines": waterlines, "buttocks": buttocks}
    limits = settled_gaps(gaps, factor, "in slice_surfaces")
    slices = cut_placed(placed, wanted, limits, name, book, tell, factor)
    scaled = [_scaled(each, scale) for each in faces.surfaces]
    settled = _settled(slices, facets, scaled, motion, book)
    return attrs.evolve(settled, frame=found, report=book.report())


def _scaled(surface: SplineSurface | None, scale: float) -> SplineSurface | None:
    if surface is None or scale == 1.0:
        return surface
    return attrs.evolve(surface, net=surface.net * scale)


def _settled(
    slices: HullSlices,
    facets: Facets,
    surfaces: Sequence[SplineSurface | None],
    motion: AxisChange,
    book: Notebook,
) -> HullSlices:
    """Move the points of all lines and of the profile onto their surfaces."""
    lines = (*slices.lines, *(line for line in slices.boundaries if line.name == "profile"))
    pieces = [(line, piece) for line in lines for piece in line.pieces]
    owner = np.concatenate([_owner(piece) for _, piece in pieces])
    xyz = np.concatenate([piece.points for _, piece in pieces])
    count = [len(piece.points) for _, piece in pieces]
    axis = np.repeat([AXES.get(line.group, 1) for line, _ in pieces], count)
    offset = np.repeat([_place(line) for line, _ in pieces], count)
    places, sine, good = project_to_surfaces(
        xyz, axis, offset, owner, facets, surfaces, motion, slices.factor
    )
    if not good.all():
        x, y, z = xyz[np.argmin(good)].tolist()
        what = (
            f"{int((~good).sum())} of {len(good)} points stay on triangles, first ({x:.4g}, "
            f"{y:.4g}, {z:.4g}) m: surfaces end there, or are nearly in the plane of the line"
        )
        book.assume("on triangles", "the lines", what, int((~good).sum()))
    split = np.cumsum(count)[:-1]
    found = iter(zip(np.split(places, split), np.split(sine, split), strict=True))
    settled = [_replaced(line, found, slices.factor) for line in lines]
    rest = [line for line in slices.boundaries if line.name != "profile"]
    return attrs.evolve(
        slices, lines=tuple(settled[: len(slices.lines)]),
        boundaries=tuple([*settled[len(slices.lines) :], *rest]), facets=False, depth=0.0,
    )  # fmt: skip


def _owner(piece: LinePiece) -> IntArray:
    if piece.owner is None:
        raise BadInputError("a line has no triangles", "in the surfaces", "report this")
    return piece.owner


def _place(line: SliceLine) -> float:
    return 0.0 if line.group == "boundary" else line.offset


def _replaced(
    line: SliceLine, found: Iterator[tuple[FloatArray, FloatArray]], factor: float
) -> SliceLine:
    """Give a line with the next places, thinned, and sines where it had some."""
    pieces = []
    for piece in line.pieces:
        points, sine = next(found)
        kept = np.arange(len(points))
        if line.group != "boundary":
            kept = _with_sag(points, _thinned(points), factor * _SAG)
        angle = None if piece.sine is None else sine[kept]
        owner = None if piece.owner is None else piece.owner[kept]
        pieces.append(attrs.evolve(piece, points=points[kept], sine=angle, owner=owner))
    return attrs.evolve(line, pieces=tuple(pieces))


def _thinned(points: FloatArray) -> IntArray:
    """Choose points at equal lengths, closer where the line turns; ends stay.

    Points are exact, so that more of them add nothing.
    """
    step = np.diff(points, axis=0)
    length = np.sqrt((step * step).sum(axis=1))
    ahead = step / np.maximum(length, 1e-300)[:, None]
    turn = np.arccos(np.clip((ahead[1:] * ahead[:-1]).sum(axis=1), -1.0, 1.0))
    way = np.cumsum(length) * (_POINTS / max(float(length.sum()), 1e-300))
    way[:-1] += np.cumsum(turn) / _TURN
    way[-1:] += turn.sum() / _TURN
    place = np.floor(np.append(0.0, way))
    kept = np.append(True, np.diff(place) > 0.0)
    kept[-1] = True
    return np.flatnonzero(kept)


def _with_sag(points: FloatArray, kept: IntArray, most: float) -> IntArray:
    """Keep further points where chords between those kept pass others by more than `most` (m)."""
    while True:
        chord = np.repeat(np.arange(len(kept) - 1), np.diff(kept))
        away = points[: len(chord)] - points[kept[chord]]
        along = points[kept[chord + 1]] - points[kept[chord]]
        part = (away * along).sum(axis=1) / np.maximum((along * along).sum(axis=1), 1e-300)
        off = np.sqrt(((away - part[:, None] * along) ** 2).sum(axis=1))
        worst = np.maximum.reduceat(off, kept[:-1])
        if not (worst > most).any():
            return kept
        more = np.flatnonzero((off == worst[chord]) & (off > most))
        kept = np.union1d(kept, more)


# --------------------------------------------------------------------------------------
# Files of surfaces.

_MOST_BYTES = 200_000_000
_HEAD = 2000
_WHERE = "as an argument"


def cad_kind(path: Path) -> str | None:
    """Tell by its content what a file of CAD is: "iges", "step", "3dm", or None for anything else.

    IGES or 3DM without surfaces is something else: its curves are digitised lines.
    """
    if not path.is_file():
        return None
    if is_rhino(path):
        return "3dm" if rhino_shows(read_rhino(path), path.name) == "surfaces" else None
    try:
        with regular_file(path).open("rb") as file:
            head = file.read(_HEAD).decode("latin-1")
            if looks_like_iges(head):
                text = head + file.read(_MOST_BYTES).decode("latin-1")
                return "iges" if holds_surfaces(text) else None
    except OSError:
        return None
    if head.lstrip("\ufeff\u00ef\u00bb\u00bf \t\r\n").startswith("ISO-10303-21"):
        return "step"
    return None


def faces_of_file(path: Path, unit: str = "auto") -> HullFaces:
    """Read the surfaces of a file, IGES or STEP; `unit` "auto" is the one that the file states.

    Untrimmed spline surfaces of IGES need no extra; anything else does.

    Raises
    ------
    BadInputError
        A file that is damaged or too large, tells no unit or another than is given, or holds no
        surface.
    MissingExtraError
        It needs OpenCASCADE, which is not installed.
    """
    given = None if unit == "auto" else checked_unit(unit, _WHERE)
    kind = cad_kind(path)
    if kind == "3dm":
        return _faces_of_rhino(path, given)
    text = _text(path)
    if kind == "step":
        from assoc_hull.io.cad.kernel import require_installed
        from assoc_hull.io.cad.read import read_faces, require_sound_step, step_unit

        require_installed()
        require_sound_step(text, path.name)
        return read_faces(path, "step", step_unit(text), given)
    try:
        file = IgesFile.of_text(text, path.name)
        told = UNITS[file.unit][0] if file.metres is not None else None
        refuse_other_unit(path.name, told, given)
        surfaces, used, notes = surfaces_of_iges(text, path.name, given)
    except NeedsCadError as error:
        return _through_cad(path, text, given, error)
    return HullFaces.of(surfaces, used, notes)


def _faces_of_rhino(path: Path, unit: str | None) -> HullFaces:
    """Give the surfaces that a file of Rhino shows."""
    model = read_rhino(path)
    if model.trimmed:
        what = f"{len(model.trimmed)} faces are trimmed, as {model.trimmed[0]!r}"
        remedy = "rhino3dm does not tell trims: export the hull as STEP, or hide what is none of it"
        raise BadInputError(what, f"in {path.name}", remedy)
    refuse_other_unit(path.name, model.unit, unit)
    if unit is None and model.unit is None:
        raise BadInputError("it tells no unit of length that can be used", f"in {path.name}",
                            f"give unit: {', '.join(METRES)}")  # fmt: skip
    used = unit or str(model.unit)
    book = Notebook()
    tell_left_out(model, book, curves=len(model.curves))
    notes = tuple(map(str, book.assumptions))
    metres = METRES[used]
    scaled = [attrs.evolve(each, net=each.net * metres) for _, each in model.surfaces]
    return HullFaces.of(scaled, used, notes)


def _through_cad(path: Path, text: str, unit: str | None, why: NeedsCadError) -> HullFaces:
    """Read what our own reader leaves to OpenCASCADE; without it, tell why it is needed."""
    from assoc_hull.io.cad.read import read_faces

    told = UNITS.get(IgesFile.of_text(text, path.name).unit)
    try:
        return read_faces(path, "iges", told[0] if told else None, unit)
    except MissingExtraError as error:
        raise NeedsCadError(why.what, why.where, f"{why.remedy}: {error}") from error


def _text(path: Path) -> str:
    try:
        with regular_file(path).open("rb") as file:
            data = file.read(_MOST_BYTES + 1)
    except OSError as error:
        what = f"the file cannot be read ({error.strerror or error})"
        raise BadInputError(what, f"at {path}", "check name and permissions") from error
    if len(data) > _MOST_BYTES:
        what = f"the file has more than {_MOST_BYTES / 1e6:g} MB"
        raise BadInputError(what, f"at {path}", "export the hull only")
    return data.decode("latin-1")


def read_surface_lines(
    path: Path,
    *,
    stations: Places = 41,
    waterlines: Places = 20,
    buttocks: Places = 12,
    scale: float = 1.0,
    unit: str = "auto",
    axes: str = "auto",
    gaps: Gaps | float | None = None,
    length: float | None = None,
    tell: Tell = no_progress,
    frame: FrameOptions | None = None,
    choice: HullChoice | None = None,
) -> HullSlices:
    """Read surfaces and cut them; arguments as for `assoc_hull.io.slicing.mesh_lines.read_mesh`.

    Raises
    ------
    BadInputError, NoMeetingError, MissingExtraError
        As for `faces_of_file` and `slice_surfaces`.
    """
    tell("reading the surfaces", 0, 0)
    faces = faces_of_file(path, unit)
    return slice_surfaces(
        faces, stations=stations, waterlines=waterlines, buttocks=buttocks, scale=scale,
        axes=axes, gaps=gaps, length=length, name=path.stem, tell=tell, frame=frame,
        choice=choice,
    )  # fmt: skip
