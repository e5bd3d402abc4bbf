"""The part of a mesh of panels that lies below the water surface z = 0."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.surfaces.panel_mesh import PanelMesh, joined

__all__ = ["below_water"]


def below_water(mesh: PanelMesh) -> PanelMesh:
    """Cut a mesh at z = 0, along straight edges, and keep what lies below.

    Panels that are cut become triangles and quadrilaterals; neighbours stay joined.

    Parameters
    ----------
    mesh : PanelMesh
        Any mesh, such as one of a whole ship with her upper works.

    Returns
    -------
    PanelMesh
        With the symmetry and title of the other; what that was made of is not kept.

    Raises
    ------
    BadInputError
        Nothing lies below.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.surfaces.panel_clip import below_water
    >>> from assoc_hull.geometry.surfaces.panel_mesh import PanelMesh
    >>> side = np.array([[0.0, 1, -2], [5, 1, -2], [5, 1, 3], [0, 1, 3]])
    >>> below_water(PanelMesh(side, np.array([[3, 2, 1, 0]]))).area
    10.0
    """
    z = mesh.xyz[:, 2][mesh.panel]
    kept = (z <= 0.0).all(axis=1) & (z < 0.0).any(axis=1)
    cut = np.flatnonzero((z < 0.0).any(axis=1) & ~kept)
    places, panels = [mesh.xyz], mesh.panel[kept].tolist()
    count = len(mesh.xyz)
    for each in cut.tolist():
        corner = mesh.xyz[mesh.panel[each][: 3 if mesh.triangle[each] else 4]]
        polygon = _below(corner)
        first = count
        places.append(polygon)
        count += len(polygon)
        panels += _split(first, len(polygon))
    if not panels:
        raise BadInputError("no panel lies below z = 0", "in a panel mesh", "lower the mesh")
    xyz, panel = joined(np.concatenate(places), np.array(panels, np.int64))
    return attrs.evolve(mesh, xyz=xyz, panel=panel, origin=None)


def _below(corner: FloatArray) -> FloatArray:
    """Cut a polygon."""
    found = []
    for here, there in zip(corner, np.roll(corner, -1, axis=0), strict=True):
        if here[2] <= 0.0:
            found.append(here)
        if here[2] * there[2] < 0.0:
            # From the lower end, so that both panels of an edge get the same place.
            low, high = (here, there) if here[2] < there[2] else (there, here)
            place = low + (high - low) * (low[2] / (low[2] - high[2]))
            found.append(np.array([place[0], place[1], 0.0]))
    return np.array(found)


def _split(first: int, size: int) -> list[list[int]]:
    """Split a polygon of three to six corners."""
    if size == 3:
        return [[first, first + 1, first + 2, first + 2]]
    found = [[first, first + i, first + i + 1, first + i + 2] for i in range(1, size - 2, 2)]
    if size % 2:
        found.append([first, first + size - 2, first + size - 1, first + size - 1])
    return found
