"""Spline surfaces of a hull cut into lines, whose points lie on the surfaces themselves.

Surfaces are made triangles once; these are cut as any mesh is, which tells pieces, ends and
boundary curves; then each point is put on the surface that its triangle stands for, in its plane.

Examples
--------
A Wigley hull of one surface, exactly:

>>> import numpy as np
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> from assoc_hull.io.surface_slices import Faces, slice_surfaces
>>> u, v = np.mgrid[0:1:3j, 0:1:3j]
>>> net = np.stack([100.0 * u, 5.0 * 2.0 * (u == 0.5) * (v > 0.0), 6.25 * v], axis=2)
>>> faces = Faces.of([SplineSurface.bezier(net, "wigley")], "m")
>>> slices = slice_surfaces(faces, stations=[25.0, 50.0], waterlines=[1.5625], buttocks=1)
>>> x, y, z = slices["WL 1.5625"].pieces[0].points.T
>>> bool(np.abs(y - 5.0 * (1 - (x / 50 - 1) ** 2) * (1 - (1 - z / 6.25) ** 2)).max() < 1e-9)
True
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.facets import Facets, facets_of
from assoc_hull.geometry.patches.meeting import meet_plane
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.geometry.patches.stitching import outward_parts, stitched
from assoc_hull.geometry.triangles import check_mesh
from assoc_hull.io.mesh import cut_placed
from assoc_hull.io.mesh_doctor import mend_mesh
from assoc_hull.io.mesh_frame import place_mesh
from assoc_hull.io.offset_report import Notebook
from assoc_hull.io.progress import Tell, silent
from assoc_hull.io.slice_places import Places
from assoc_hull.io.slice_types import AXES, Gaps, Piece, SliceLine, Slices
from assoc_hull.io.surface_units import METRES

__all__ = ["Faces", "slice_surfaces", "small"]

_WELD = 2e-3
"""Borders at most so far apart (m) are one."""

_SHIP = 50.0
"""A hull shorter than this (m) is taken for a model: limits are less in proportion."""

_LONGEST, _SHORTEST = 600.0, 1.0

_FINE = 1e-5
"""Triangles lie off their surface by at most this part of the length of the hull."""

_LONG = 1.0 / 150.0
"""Their sides along the parameters are at most this part of it."""

_FAR = 0.02
"""A place of a surface farther (m) from the triangles is not the one meant."""

_LEAST_SINE = 0.03
"""Where a plane cuts at a smaller angle (sine), a point stays on its triangle."""


@attrs.frozen(eq=False)
class Faces:
    """Surfaces of a hull as a file has them.

    Attributes
    ----------
    surfaces : tuple of SplineSurface
        m, at the scale of the file; a face may be a part of its surface.
    unit : str
        The unit of the file.
    notes : tuple of str
        What reading it told.
    facets : callable
        Gives the triangles of the faces, within a deflection and no longer than a length, m.
    """

    surfaces: tuple[SplineSurface, ...]
    unit: str
    notes: tuple[str, ...]
    facets: Callable[[float, float], Facets]

    @classmethod
    def of(cls, surfaces: Sequence[SplineSurface], unit: str, notes: tuple[str, ...] = ()) -> Faces:
        """Take whole surfaces."""
        return cls(tuple(surfaces), unit, notes, lambda fine, long: facets_of(surfaces, fine, long))


@attrs.frozen(eq=False)
class _Motion:
    """From the file to the ship: ``xyz @ turn + shift``; `turn` exchanges and mirrors axes."""

    turn: FloatArray
    shift: FloatArray

    @classmethod
    def between(cls, before: FloatArray, after: FloatArray) -> _Motion:
        """Tell how vertices were moved."""
        middle = before.mean(axis=0)
        turn = np.rint(np.linalg.lstsq(before - middle, after - after.mean(axis=0))[0])
        return cls(turn + 0.0, np.median(after - before @ turn, axis=0))

    def back(self, xyz: FloatArray) -> FloatArray:
        """Give places of the file."""
        return np.asarray((xyz - self.shift) @ self.turn.T)

    def ahead(self, xyz: FloatArray) -> FloatArray:
        """Give places in ship axes."""
        return np.asarray(xyz @ self.turn + self.shift)

    def plane(self, axis: IntArray, offset: FloatArray) -> tuple[IntArray, FloatArray]:
        """Give axis and place in the file of planes across axes of the ship."""
        column = np.abs(self.turn).argmax(axis=0)
        sign = self.turn[column, np.arange(3)]
        return column[axis], (offset - self.shift[axis]) * sign[axis]


def slice_surfaces(
    faces: Faces,
    *,
    stations: Places = 41,
    waterlines: Places = 20,
    buttocks: Places = 12,
    scale: float = 1.0,
    axes: str = "auto",
    gaps: Gaps | None = None,
    name: str = "hull",
    tell: Tell = silent,
) -> Slices:
    """Cut surfaces into stations, waterlines, buttocks and boundary curves.

    Parameters
    ----------
    faces : Faces
        Whole hull or half.
    stations, waterlines, buttocks, scale, axes, gaps, name, tell
        As for `assoc_hull.io.mesh.slice_mesh`.

    Returns
    -------
    Slices
        Points lie on the surfaces to rounding, but for those its report tells of.

    Raises
    ------
    BadInputError, NoMeetingError
        As for `assoc_hull.io.mesh.slice_mesh`; or surfaces of no ship's length.
    """
    tell("making triangles of the surfaces", 0, 0)
    book = Notebook()
    for note in faces.notes:
        book.assume("file", "the surfaces", note)
    size = _size(faces, scale, book)
    facets = _facets(faces, scale, size)
    check_mesh(facets.mesh)
    mended = mend_mesh(facets.mesh, book)
    placed = place_mesh(mended, axes, book)
    motion = _Motion.between(mended.xyz, placed.xyz)
    wanted = {"sections": stations, "waterlines": waterlines, "buttocks": buttocks}
    limits = _gaps(size) if gaps is None else gaps
    slices = cut_placed(placed, wanted, limits, name, book, tell)
    scaled = [_scaled(each, scale) for each in faces.surfaces]
    waterline = _waterline(motion, slices, book)
    return attrs.evolve(
        _settled(slices, facets, scaled, motion, book), waterline=waterline, report=book.report()
    )


def _waterline(motion: _Motion, slices: Slices, book: Notebook) -> float | None:
    """Give the height of z = 0 of the file, if it cuts the hull, above the new base line."""
    height = float(motion.shift[2])
    depth = float(slices.high[2] - slices.low[2])
    if not 0.1 * depth < height < 0.95 * depth:
        return None
    what = f"z = 0 of the file is taken for the waterline: draught {height:.6g} m, unless given"
    book.assume("waterline", "the surfaces", what, height)
    return height


def small(size: float) -> float:
    """Give what lengths that hold for ships are to be multiplied by: less than 1 for models.

    Examples
    --------
    >>> from assoc_hull.io.surface_slices import small
    >>> small(120.0), small(2.5)
    (1.0, 0.05)
    """
    return min(1.0, size / _SHIP)


def _gaps(size: float) -> Gaps:
    return Gaps(small(size) * Gaps().join, small(size) * Gaps().refuse)


def _size(faces: Faces, scale: float, book: Notebook) -> float:
    """Give the longest side of the hull at full scale, m; refuse what is no ship's."""
    net = np.concatenate([each.net.reshape(-1, 3) for each in faces.surfaces])
    size = float(np.ptp(net, axis=0).max()) * scale
    said = f"the surfaces are {size:.4g} m long in {faces.unit}, the unit of the file"
    where = f"at scale {scale:g}"
    if not size <= _LONGEST:
        known = ", ".join(METRES)
        raise BadInputError(said, where, f"are these millimetres? give unit ({known}), or scale")
    if size < _SHORTEST:
        remedy = "are these metres? give unit='m', or the scale of the model"
        raise BadInputError(said, where, remedy)
    book.assume("unit", "the surfaces", f"{faces.unit}: the hull is {size:.6g} m long", size)
    if size < _SHIP:
        what = f"all limits of gaps and features are {small(size):.3g} of those of a ship"
        book.assume("small", "the surfaces", f"{what}, since it is short", size)
    return size


def _facets(faces: Faces, scale: float, size: float) -> Facets:
    """Give triangles at full scale, sewn, and each part outward."""
    deflection = _FINE * size
    found = faces.facets(deflection / scale, _LONG * size / scale)
    mesh = found.mesh.moved(found.mesh.xyz * scale)
    whole = Facets(mesh, found.surface, found.uv)
    return outward_parts(stitched(whole, max(small(size) * _WELD, 2.0 * deflection)))


def _scaled(surface: SplineSurface, scale: float) -> SplineSurface:
    return surface if scale == 1.0 else attrs.evolve(surface, net=surface.net * scale)


def _settled(
    slices: Slices,
    facets: Facets,
    surfaces: Sequence[SplineSurface],
    motion: _Motion,
    book: Notebook,
) -> Slices:
    """Put the points of all lines on their surfaces."""
    lines = (*slices.lines, *(line for line in slices.boundaries if line.name == "profile"))
    pieces = [(line, piece) for line in lines for piece in line.pieces]
    owner = np.concatenate([_owner(piece) for _, piece in pieces])
    xyz = np.concatenate([piece.points for _, piece in pieces])
    count = [len(piece.points) for _, piece in pieces]
    axis = np.repeat([AXES.get(line.group, 1) for line, _ in pieces], count)
    offset = np.repeat([_place(line) for line, _ in pieces], count)
    places, sine, good = _on_surfaces(xyz, axis, offset, owner, facets, surfaces, motion)
    if not good.all():
        x, y, z = xyz[np.argmin(good)].tolist()
        what = (
            f"{int((~good).sum())} of {len(good)} points stay on triangles, first ({x:.4g}, "
            f"{y:.4g}, {z:.4g}) m: surfaces end there, or are nearly in the plane of the line"
        )
        book.assume("on triangles", "the lines", what, int((~good).sum()))
    split = np.cumsum(count)[:-1]
    found = iter(zip(np.split(places, split), np.split(sine, split), strict=True))
    settled = [_replaced(line, found) for line in lines]
    rest = [line for line in slices.boundaries if line.name != "profile"]
    return attrs.evolve(
        slices, lines=tuple(settled[: len(slices.lines)]),
        boundaries=tuple([*settled[len(slices.lines) :], *rest]), facets=False, depth=0.0,
    )  # fmt: skip


def _owner(piece: Piece) -> IntArray:
    if piece.owner is None:
        raise BadInputError("a line has no triangles", "in the surfaces", "report this")
    return piece.owner


def _place(line: SliceLine) -> float:
    return 0.0 if line.group == "boundary" else line.offset


def _replaced(line: SliceLine, found: Iterator[tuple[FloatArray, FloatArray]]) -> SliceLine:
    """Give a line with the next places, and sines where it had some."""
    pieces = []
    for piece in line.pieces:
        points, sine = next(found)
        kept = None if piece.sine is None else sine.copy()
        pieces.append(attrs.evolve(piece, points=points.copy(), sine=kept))
    return attrs.evolve(line, pieces=tuple(pieces))


def _on_surfaces(
    xyz: FloatArray,
    axis: IntArray,
    offset: FloatArray,
    owner: IntArray,
    facets: Facets,
    surfaces: Sequence[SplineSurface],
    motion: _Motion,
) -> tuple[FloatArray, FloatArray, np.typing.NDArray[np.bool_]]:
    """Give places on the surfaces, the sine of the angle there, and which were found."""
    there = motion.back(xyz)
    uv = _parameters(there, facets.mesh.corners[owner], facets.uv[owner])
    column, place = motion.plane(axis, offset)
    centre = xyz[:, 1] == 0.0
    middle, nil = motion.plane(np.array([1]), np.zeros(1))
    out, sine, good = xyz.copy(), np.ones(len(xyz)), np.zeros(len(xyz), np.bool_)
    for number in np.unique(facets.surface[owner]).tolist():
        rows = np.flatnonzero(facets.surface[owner] == number)
        second = centre[rows], int(middle[0]), float(nil[0])
        found = meet_plane(surfaces[number], uv[rows], column[rows], place[rows], second)
        away = np.sqrt(((found.xyz - there[rows]) ** 2).sum(axis=1))
        mine = (found.off < 1e-7) & (found.sine > _LEAST_SINE) & (away < _FAR)
        good[rows] = mine
        out[rows[mine]] = motion.ahead(found.xyz[mine])
        sine[rows] = found.sine
    out[np.arange(len(out)), axis] = offset
    out[centre, 1] = 0.0
    return out, sine, good


def _parameters(xyz: FloatArray, corner: FloatArray, uv: FloatArray) -> FloatArray:
    """Give parameters (n, 2) of places on triangles (n, 3, 3), from those of the corners."""
    b, c, p = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0], xyz - corner[:, 0]
    bb, bc, cc = ((one * other).sum(axis=1) for one, other in ((b, b), (b, c), (c, c)))
    pb, pc = (p * b).sum(axis=1), (p * c).sum(axis=1)
    det = np.maximum(bb * cc - bc * bc, 1e-300)
    part = np.clip(np.stack([cc * pb - bc * pc, bb * pc - bc * pb], axis=1) / det[:, None], 0, 1)
    part[np.abs(part) < 1e-9] = 0.0
    part /= np.maximum(part.sum(axis=1), 1.0)[:, None]
    first = 1.0 - part.sum(axis=1)
    return np.asarray(first[:, None] * uv[:, 0] + part[:, :1] * uv[:, 1] + part[:, 1:] * uv[:, 2])
