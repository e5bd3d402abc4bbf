"""Whether a file holds what was to be written, as OpenCASCADE reads it: for every file we write.

Examples
--------
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> from assoc_hull.io.cad.check import area_of
>>> side = SplineSurface.bezier([[[0, 1, 0], [0, 1, 2]], [[5, 1, 0], [5, 1, 2]]], "side")
>>> round(area_of(side), 9)
10.0
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.numeric.quadrature import gauss
from assoc_hull.geometry.patches.area_elements import on_grid
from assoc_hull.geometry.patches.points import normals, points
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.io.cad.found import Found

__all__ = ["area_of", "breadth_flux", "control_point_error", "faults_of", "require_written"]

_POINT = 1e-8
"""Control points come back to this (m): 1e-5 mm."""

_AREA = 1e-6
"""Areas come back to this part."""

_NODES = 16


def area_of(surface: SplineSurface) -> float:
    """Give the area of a surface, m2, by Gauss's rule on each of its patches."""
    nodes, weights = gauss(_NODES)
    element = on_grid(surface.patches(), nodes, nodes)
    return float((element @ weights @ weights).sum())


def breadth_flux(surface: SplineSurface) -> float:
    """Give the integral of y n_y over a surface, m3, roughly; above 0 where normals point out."""
    patches = surface.patches()
    row, middle = np.arange(len(patches)), np.full((len(patches), 2), 0.5)
    normal = normals(patches, row, middle)
    return float((points(patches, row, middle)[:, 1] * normal[:, 1]).sum())


def control_point_error(found: Sequence[SplineSurface], surfaces: Sequence[SplineSurface]) -> float:
    """Give the largest distance of control points, m; inf where nets are of other sizes."""
    if len(found) != len(surfaces):
        return float("inf")
    return max(_net_error(one, other) for one, other in zip(found, surfaces, strict=True))


def _net_error(one: SplineSurface, other: SplineSurface) -> float:
    if one.net.shape != other.net.shape or one.degrees != other.degrees:
        return float("inf")
    return float(np.linalg.norm(one.net - other.net, axis=-1).max())


def faults_of(
    found: Found, surfaces: Sequence[SplineSurface], unit: str, *, shell: bool
) -> list[str]:
    """List what is wrong with a file.

    Parameters
    ----------
    found : Found
        What was read back.
    surfaces : sequence of SplineSurface
        What was to be written, in this order; m.
    unit : str
        The unit it was to be in.
    shell : bool
        Whether the form keeps edges that faces have in common: then there must be one shell, and
        no seam within it.

    Returns
    -------
    list of str
        One sentence a fault; empty if there is none.
    """
    return [
        *_faults_of_surfaces(found, surfaces, unit),
        *(_faults_of_shell(found) if shell else ()),
    ]


def _faults_of_surfaces(
    found: Found, surfaces: Sequence[SplineSurface], unit: str
) -> Iterator[str]:
    if found.unit != unit:
        yield f"the unit is {found.unit or 'not told'} instead of {unit}"
    if len(found.surfaces) != len(surfaces):
        yield f"there are {len(found.surfaces)} faces instead of {len(surfaces)}"
        return
    for one, other in zip(found.surfaces, surfaces, strict=True):
        error = _net_error(one, other)
        if not error <= _POINT:
            yield f"control points of {other.name!r} are off by {1e3 * error:.6g} mm"
    wanted = sum(map(area_of, surfaces))
    if not abs(found.area - wanted) <= _AREA * wanted:
        yield f"the area is {found.area:.6f} m2 instead of {wanted:.6f} m2"
    if not found.valid:
        yield "OpenCASCADE finds its topology unsound"


def _faults_of_shell(found: Found) -> Iterator[str]:
    if found.shells != 1:
        yield f"there are {found.shells} shells instead of one"
    if found.seams:
        yield f"{found.seams} edges within the shell are not joined"
    if found.turned:
        yield f"{len(found.turned)} faces have their normals turned"


def require_written(
    found: Found, surfaces: Sequence[SplineSurface], unit: str, *, shell: bool
) -> None:
    """Refuse a file that does not hold what was to be written; arguments as of `faults_of`.

    Raises
    ------
    BadInputError
        All faults, in one line.
    """
    faults = faults_of(found, surfaces, unit, shell=shell)
    if faults:
        what = f"the file does not hold what was to be written: {'; '.join(faults)}"
        raise BadInputError(what, "as it is read back", "nothing is kept of it; write another form")
