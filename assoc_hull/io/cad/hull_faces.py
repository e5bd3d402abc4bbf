"""Surfaces of a hull as a file has them, and their triangles at full scale: sewn, outward.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> from assoc_hull.io.reports import Notebook
>>> from assoc_hull.io.cad.hull_faces import hull_size, HullFaces
>>> faces = HullFaces.of([SplineSurface.bezier(2.5 * np.eye(3).reshape(3, 1, 3)[:, [0, 0]])], "m")
>>> hull_size(faces, 40.0, Notebook())
100.0
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.geometry.patches.triangulation import (
    Facets,
    facets_of,
    kept_facets,
    outward_parts,
    stitch_facets,
)
from assoc_hull.io.reports import Notebook
from assoc_hull.io.units import METRES

__all__ = ["FINE", "HullFaces", "facets_at_scale", "hull_size"]

_WELD = 2e-3
"""Borders at most this far apart (m), of a hull under 100 m less in proportion, are one."""

_LONGEST, _SHORTEST = 600.0, 1.0
"""Lengths (m) between which a hull may lie. Absolute: others show a wrong unit."""

FINE = 2e-5
"""Triangles lie off their surface by at most this part of the length of the hull."""

_COARSE, _ROUGH = 1e-3, 100.0
"""Triangles this part of the nets off their surface tell how long it is; nets of this size, m."""

_LONG = 1.0 / 150.0
"""Their sides along the parameters are at most this part of it."""


@attrs.frozen(eq=False)
class HullFaces:
    """Surfaces of a hull as a file has them.

    Attributes
    ----------
    surfaces : tuple of SplineSurface or None
        m, at the scale of the file; a face may be a part of its surface. None where it lies on
        what is no spline of ours: its lines are those of its triangles.
    unit : str
        The unit of the file.
    notes : tuple of str
        What reading it told.
    facets : callable
        Gives the triangles of the faces, within a deflection and no longer than a length, m.
    """

    surfaces: tuple[SplineSurface | None, ...]
    unit: str
    notes: tuple[str, ...]
    facets: Callable[[float, float], Facets]

    @classmethod
    def of(
        cls, surfaces: Sequence[SplineSurface], unit: str, notes: tuple[str, ...] = ()
    ) -> HullFaces:
        """Take whole surfaces."""
        return cls(tuple(surfaces), unit, notes, lambda fine, long: facets_of(surfaces, fine, long))


def hull_size(faces: HullFaces, scale: float, book: Notebook) -> float:
    """Give the longest side of the hull at full scale, m; refuse what is no ship's.

    Parameters
    ----------
    faces : HullFaces
        As read.
    scale : float
        Full scale over that of the file.
    book : Notebook
        Takes unit and length.

    Raises
    ------
    BadInputError
        Less than 1 m or more than 600 m: a unit was taken for another.
    """
    size = _extent(faces) * scale
    said = f"the surfaces are {size:.4g} m long in {faces.unit}, the unit of the file"
    where = f"at scale {scale:g}"
    if not size <= _LONGEST:
        remedy = f"are these millimetres? give scale={METRES['mm'] / METRES[faces.unit]:g}"
        raise BadInputError(said, where, f"{remedy}, or the scale that they have")
    if size < _SHORTEST:
        times = METRES["m"] / METRES[faces.unit]
        remedy = f"are these metres? give scale={times:g}, or the scale of the model"
        raise BadInputError(said, where, remedy)
    book.assume("unit", "the surfaces", f"{faces.unit}: the hull is {size:.6g} m long", size)
    return size


def _extent(faces: HullFaces) -> float:
    """Give the longest side at the scale of the file, m: of faces, not of whole surfaces."""
    nets = [each.net.reshape(-1, 3) for each in faces.surfaces if each is not None]
    box = max((float(np.ptp(net, axis=0).max()) for net in nets), default=_ROUGH)
    found = faces.facets(_COARSE * box, box).mesh.xyz
    return float(np.ptp(found, axis=0).max()) if len(found) else 0.0


def facets_at_scale(
    faces: HullFaces, scale: float, size: float, book: Notebook, factor: float = 1.0
) -> Facets:
    """Give triangles at full scale, each once, sewn, and each part outward.

    Parameters
    ----------
    faces : HullFaces
        As read.
    scale : float
        Full scale over that of the file.
    size : float, m
        The longest side of the hull at full scale.
    book : Notebook
        Takes what was there twice.
    factor : float
        Of lengths, by the size of the hull.
    """
    deflection = FINE * size
    found = faces.facets(deflection / scale, _LONG * size / scale)
    if not len(found.mesh.face):
        raise BadInputError("all surfaces are points or lines", "in the file", "export the hull")
    mesh = found.mesh.moved(found.mesh.xyz * scale)
    whole = _once(Facets(mesh, found.surface, found.uv), book)
    return outward_parts(stitch_facets(whole, max(factor * _WELD, 2.0 * deflection)))


def _once(facets: Facets, book: Notebook) -> Facets:
    """Keep of triangles that are there twice the first: of a surface that is in the file twice."""
    corners = np.sort(facets.mesh.face, axis=1)
    kept = np.sort(np.unique(corners, axis=0, return_index=True)[1])
    if len(kept) == len(corners):
        return facets
    names = f"{len(corners) - len(kept)} of {len(corners)} triangles of the surfaces"
    book.repair("duplicate", "the surfaces", f"{names} occur twice; each is kept once")
    mesh = facets.mesh
    return kept_facets(mesh.xyz, mesh.face[kept], facets.surface[kept], facets.uv[kept])
