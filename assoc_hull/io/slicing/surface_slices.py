"""Spline surfaces of a hull cut into lines, whose points lie on the surfaces themselves.

Surfaces are made triangles once; these are cut as any mesh is, which tells pieces, ends and
boundary curves; then each point is put on the surface that its triangle stands for, in its plane.

Examples
--------
A Wigley hull of one surface, exactly:

>>> import numpy as np
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> from assoc_hull.io.cad.hull_faces import Faces
>>> from assoc_hull.io.slicing.surface_slices import slice_surfaces
>>> u, v = np.mgrid[0:1:3j, 0:1:3j]
>>> net = np.stack([100.0 * u, 5.0 * 2.0 * (u == 0.5) * (v > 0.0), 6.25 * v], axis=2)
>>> faces = Faces.of([SplineSurface.bezier(net, "wigley")], "m")
>>> slices = slice_surfaces(faces, stations=[25.0, 50.0], waterlines=[1.5625], buttocks=1)
>>> x, y, z = slices["WL 1.5625"].pieces[0].points.T
>>> bool(np.abs(y - 5.0 * (1 - (x / 50 - 1) ** 2) * (1 - (1 - z / 6.25) ** 2)).max() < 1e-9)
True
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.facets import Facets
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.geometry.surfaces.triangles import check_mesh
from assoc_hull.io.cad.hull_faces import FINE, Faces, facets_at_scale, size_of, small
from assoc_hull.io.lines.slices import AXES, Gaps, Piece, SliceLine, Slices
from assoc_hull.io.mesh.frame import place_mesh
from assoc_hull.io.mesh.repair import mend_mesh
from assoc_hull.io.offset_report import Notebook
from assoc_hull.io.progress import Tell, silent
from assoc_hull.io.slicing.cut_planes import Places
from assoc_hull.io.slicing.mesh import cut_placed
from assoc_hull.io.slicing.surface_points import Motion, on_surfaces

__all__ = ["slice_surfaces"]

_POINTS, _TURN = 100.0, 0.05
"""A piece keeps so many points, and one more wherever it turns by so much (rad)."""


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
        As for `assoc_hull.io.slicing.mesh.slice_mesh`.

    Returns
    -------
    Slices
        Points lie on the surfaces to rounding, but for those its report tells of.

    Raises
    ------
    BadInputError, NoMeetingError
        As for `assoc_hull.io.slicing.mesh.slice_mesh`; or surfaces of no ship's length.
    """
    tell("making triangles of the surfaces", 0, 0)
    book = Notebook()
    for note in faces.notes:
        book.assume("file", "the surfaces", note)
    size = size_of(faces, scale, book)
    facets = facets_at_scale(faces, scale, size, book)
    check_mesh(facets.mesh)
    mended = mend_mesh(facets.mesh, book)
    placed = place_mesh(mended, axes, book, 2.0 * FINE * size)
    motion = Motion.between(mended.xyz, placed.xyz)
    wanted = {"sections": stations, "waterlines": waterlines, "buttocks": buttocks}
    limits = _gaps(size) if gaps is None else gaps
    slices = cut_placed(placed, wanted, limits, name, book, tell)
    scaled = [_scaled(each, scale) for each in faces.surfaces]
    waterline = _waterline(motion, slices, book)
    return attrs.evolve(
        _settled(slices, facets, scaled, motion, book), waterline=waterline, report=book.report()
    )


def _waterline(motion: Motion, slices: Slices, book: Notebook) -> float | None:
    """Give the height of z = 0 of the file, if it cuts the hull, above the new base line."""
    height = float(motion.shift[2])
    depth = float(slices.high[2] - slices.low[2])
    if not 0.1 * depth < height < 0.95 * depth:
        return None
    what = f"z = 0 of the file is taken for the waterline: draught {height:.6g} m, unless given"
    book.assume("waterline", "the surfaces", what, height)
    return height


def _gaps(size: float) -> Gaps:
    return Gaps(small(size) * Gaps().join, small(size) * Gaps().refuse)


def _scaled(surface: SplineSurface | None, scale: float) -> SplineSurface | None:
    if surface is None or scale == 1.0:
        return surface
    return attrs.evolve(surface, net=surface.net * scale)


def _settled(
    slices: Slices,
    facets: Facets,
    surfaces: Sequence[SplineSurface | None],
    motion: Motion,
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
    places, sine, good = on_surfaces(xyz, axis, offset, owner, facets, surfaces, motion)
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
    """Give a line with the next places, thinned, and sines where it had some."""
    pieces = []
    for piece in line.pieces:
        points, sine = next(found)
        kept = _thinned(points) if line.group != "boundary" else np.arange(len(points))
        angle = None if piece.sine is None else sine[kept]
        owner = None if piece.owner is None else piece.owner[kept]
        pieces.append(attrs.evolve(piece, points=points[kept], sine=angle, owner=owner))
    return attrs.evolve(line, pieces=tuple(pieces))


def _thinned(points: FloatArray) -> IntArray:
    """Choose points that stand at equal lengths, closer where the line turns; ends stay.

    Points are exact, so that more of them tell no more.
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
