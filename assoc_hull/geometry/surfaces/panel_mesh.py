"""Meshes of flat or warped panels with three or four corners, as seakeeping codes take them.

Axes of such codes: x forward, y to port, z up, the water surface at z = 0. Corners go round
counter-clockwise as seen from the water, so that normals point out of the hull. `below_water`
keeps the part of a mesh that lies below the surface.
"""

from __future__ import annotations

from functools import cached_property
from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.arguments import checked, flag, word
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = [
    "PanelMesh",
    "PanelOrigin",
    "below_water",
    "merge_equal_vertices",
    "weld_vertices",
]

_WHERE = "in a panel mesh"
_LARGEST = 1e6


@attrs.frozen(eq=False)
class PanelOrigin:
    """What a mesh was made of: the hull, where it floats, and its exact integrals there.

    Attributes
    ----------
    ship : str
        Name of the hull.
    draught_aft, draught_fore : float, m
        On the centre line, at the perpendiculars.
    heel_deg : float, degrees
        + starboard down.
    x : float, m
        Where along the ship, from AP, the origin of the mesh lies, in the water surface.
    volume : float, m3
        Of the immersed hull.
    area : float, m2
        Of its wetted surface, as far as the mesh covers it.
    centre : (3,), m
        Its centre of buoyancy, in the axes of the mesh.
    """

    ship: str
    draught_aft: float
    draught_fore: float
    heel_deg: float
    x: float
    volume: float
    area: float
    centre: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.centre)


def _numbers(values: object) -> FloatArray:
    """Take places, as an array of its own; one nan where they are not numbers."""
    try:
        return np.array(values, np.float64)
    except (TypeError, ValueError, OverflowError):
        return np.full((1, 3), np.nan)


def _shape(values: NDArray[Any]) -> str:
    """Show an array by its shape: a mesh has thousands of numbers."""
    return str(values.shape)


def _corners(values: object) -> IntArray:
    """Take whole numbers, as an array of its own; none where they are not whole."""
    try:
        found = np.asarray(values)
        whole = found.dtype.kind in "iu" or not found.size
        return np.array(found, np.int64) if whole else np.zeros(0, np.int64)
    except (TypeError, ValueError, OverflowError):
        return np.zeros(0, np.int64)


@attrs.frozen(eq=False)
class PanelMesh:
    """Panels over shared vertices.

    Attributes
    ----------
    xyz : (v, 3), m
        The vertices.
    panel : (p, 4) int
        The corners of each panel; a triangle ends with its third corner twice.
    mirror_x, mirror_y : bool
        The mesh stands for its mirror image in the plane x = 0, y = 0 too.
    title : str
        One line about it.
    origin : PanelOrigin or None
        What it was made of, if that is known.

    Raises
    ------
    BadInputError
        No panel, a corner that is not there, a vertex that is not finite, a panel of fewer than
        three corners.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.surfaces.panel_mesh import PanelMesh
    >>> side = np.array([[0.0, 1, -2], [5, 1, -2], [5, 1, 0], [0, 1, 0]])
    >>> mesh = PanelMesh(side, np.array([[3, 2, 1, 0]]), mirror_y=True)
    >>> mesh.count, float(mesh.area), mesh.whole().count
    (1, 20.0, 2)
    """

    xyz: FloatArray = attrs.field(converter=_numbers, repr=_shape)
    panel: IntArray = attrs.field(converter=_corners, repr=_shape)
    mirror_x: bool = attrs.field(default=False, validator=checked(flag, _WHERE))
    mirror_y: bool = attrs.field(default=False, validator=checked(flag, _WHERE))
    title: str = attrs.field(default="", validator=checked(word, _WHERE))
    origin: PanelOrigin | None = attrs.field(default=None, repr=False)

    def __attrs_post_init__(self) -> None:
        _check(self.xyz, self.panel)
        freeze(self.xyz, self.panel)

    @property
    def count(self) -> int:
        """Number of panels, mirror images not counted."""
        return len(self.panel)

    @property
    def images(self) -> int:
        """Of how many parts like this one the whole consists: 1, 2 or 4."""
        return (1 + self.mirror_x) * (1 + self.mirror_y)

    @cached_property
    def triangle(self) -> NDArray[np.bool_]:
        """The panel has three corners, (p,)."""
        found: NDArray[np.bool_] = self.panel[:, 3] == self.panel[:, 2]
        return found

    @cached_property
    def centre(self) -> FloatArray:
        """The mean of the corners of each panel, (p, 3), m."""
        corner = self.xyz[self.panel]
        quad = corner.mean(axis=1)
        found: FloatArray = np.where(self.triangle[:, None], corner[:, :3].mean(axis=1), quad)
        return found

    @cached_property
    def fans(self) -> FloatArray:
        """Each panel as four triangles about its mean corner, (p, 4, 3, 3), m.

        With them a warped panel is as large as the bilinear patch through its corners, to the
        second order, and whatever the first corner is.
        """
        corner = self.xyz[self.panel]
        middle = np.broadcast_to(self.centre[:, None], corner.shape)
        return np.stack([corner, np.roll(corner, -1, axis=1), middle], axis=2)

    @cached_property
    def vectors(self) -> FloatArray:
        """The area vectors of those triangles, out of the hull, (p, 4, 3), m2."""
        a, b, c = (self.fans[:, :, i] for i in range(3))
        found: FloatArray = 0.5 * np.cross(b - a, c - a)
        return found

    @cached_property
    def normal(self) -> FloatArray:
        """The unit normal of each panel, (p, 3); zero for one without area."""
        vector = self.vectors.sum(axis=1)
        size = np.sqrt((vector**2).sum(axis=1))[:, None]
        found: FloatArray = vector / np.where(size > 0.0, size, 1.0)
        return found

    @cached_property
    def areas(self) -> FloatArray:
        """The area of each panel, (p,), m2."""
        found: FloatArray = np.sqrt((self.vectors**2).sum(axis=2)).sum(axis=1)
        return found

    @property
    def area(self) -> float:
        """Area of the whole, with mirror images, m2."""
        return float(self.areas.sum()) * self.images

    @cached_property
    def volumes(self) -> FloatArray:
        """The volume of the whole by the fluxes of x, of y and of z, (3,), m3.

        They are one number if the mesh is closed but for the water surface z = 0.
        """
        mean = self.fans.mean(axis=2)
        flux = (mean * self.vectors).sum(axis=(0, 1))
        found: FloatArray = flux * self.images
        return found

    @cached_property
    def buoyancy(self) -> FloatArray:
        """The centre of the volume of the whole, (3,), m; nan if there is none."""
        a, b, c = (self.fans[:, :, i] for i in range(3))
        square = (a * a + b * b + c * c + a * b + b * c + c * a) / 6.0
        moment = 0.5 * (square * self.vectors).sum(axis=(0, 1)) * self.images
        if self.mirror_x:
            moment[0] = 0.0
        if self.mirror_y:
            moment[1] = 0.0
        volume = float(self.volumes.mean())
        return moment / volume if volume != 0.0 else np.full(3, np.nan)

    def whole(self) -> PanelMesh:
        """Give the mesh with its mirror images; vertices on the planes are shared."""
        mesh = self
        for axis, wanted in ((0, self.mirror_x), (1, self.mirror_y)):
            if wanted:
                mesh = _mirrored(mesh, axis)
        return attrs.evolve(mesh, mirror_x=False, mirror_y=False)

    def edges(self) -> IntArray:
        """Give the directed edges of all panels, (e, 2) int, those of no length left out."""
        first = self.panel.ravel()
        ends = np.stack([first, np.roll(self.panel, -1, axis=1).ravel()], axis=1)
        return np.asarray(ends[ends[:, 0] != ends[:, 1]])

    def free_edges(self) -> IntArray:
        """Give the edges that no other panel runs along the other way, (e, 2) int."""
        ends = self.edges()
        low, high = np.sort(ends, axis=1).T
        key = low * len(self.xyz) + high
        order = np.argsort(key, kind="stable")
        first = np.flatnonzero(np.append(True, np.diff(key[order]) != 0))
        net = np.add.reduceat(np.where(ends[order, 0] < ends[order, 1], 1, -1), first)
        left = np.flatnonzero(net)
        pair = np.sort(ends[order[first[left]]], axis=1)
        pair = np.where(net[left, None] > 0, pair, pair[:, ::-1])
        return np.asarray(np.repeat(pair, np.abs(net[left]), axis=0), np.int64).reshape(-1, 2)


def _check(xyz: FloatArray, panel: IntArray) -> None:
    if xyz.ndim != 2 or xyz.shape[1:] != (3,) or panel.ndim != 2 or panel.shape[1:] != (4,):
        what = f"vertices have shape {xyz.shape}, panels {panel.shape}"
        raise BadInputError(what, _WHERE, "give (v, 3) places and (p, 4) numbers")
    if not len(panel):
        raise BadInputError("there are no panels", _WHERE, "give one or more")
    wrong = np.flatnonzero(~(np.abs(xyz) <= _LARGEST).all(axis=1))
    if len(wrong):
        what = f"vertex {wrong[0] + 1} is not finite, or farther than {_LARGEST:g} m"
        raise BadInputError(what, _WHERE, "give metres")
    outside = np.flatnonzero(((panel < 0) | (panel >= len(xyz))).any(axis=1))
    if len(outside):
        what = f"panel {outside[0] + 1} has a corner that is none of the {len(xyz)} vertices"
        raise BadInputError(what, _WHERE, f"number corners from 0 to {len(xyz) - 1}")
    _check_corners(panel)


def _check_corners(panel: IntArray) -> None:
    """Refuse panels of fewer than three corners, and those that name one twice out of turn."""
    a, b, c, d = panel.T
    bad = np.flatnonzero((a == b) | (a == c) | (b == c) | (a == d) | (b == d))
    if len(bad):
        what = f"panel {bad[0] + 1} names a corner twice"
        raise BadInputError(what, _WHERE, "a triangle ends with its third corner twice")


def _mirrored(mesh: PanelMesh, axis: int) -> PanelMesh:
    """Add the image in the plane where one coordinate is zero."""
    other = mesh.xyz.copy()
    other[:, axis] *= -1.0
    count = len(mesh.xyz)
    number = np.where(mesh.xyz[:, axis] == 0.0, np.arange(count), np.arange(count) + count)
    a, b, c, d = number[mesh.panel].T
    # Corners go round the other way; a triangle still ends with its third corner twice.
    turned = np.where(mesh.triangle[:, None], np.stack([a, c, b, b], 1), np.stack([a, d, c, b], 1))
    used = np.append(np.ones(count, np.bool_), mesh.xyz[:, axis] != 0.0)
    new = np.cumsum(used) - 1
    xyz = np.concatenate([mesh.xyz, other])[used]
    return attrs.evolve(mesh, xyz=xyz, panel=new[np.concatenate([mesh.panel, turned])])


def weld_vertices(
    xyz: FloatArray, panel: IntArray, near: float
) -> tuple[FloatArray, IntArray, IntArray]:
    """Make vertices one that lie near one another, and drop what becomes of panels without area.

    Parameters
    ----------
    xyz : (v, 3), m
        Vertices, perhaps several in one place.
    panel : (p, 4) int
        Panels.
    near : float, m
        How near.

    Returns
    -------
    xyz : (w, 3), m
        The vertices that are used; each is the first of those it was made of.
    panel : (q, 4) int
        Panels of three or four different corners.
    vertex : (v,) int
        What became of each vertex given; -1 if no panel has it.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.surfaces.panel_mesh import weld_vertices
    >>> xyz = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1e-9, 0]])
    >>> weld_vertices(xyz, np.array([[0, 1, 2, 3]]), 1e-6)[1].tolist()
    [[1, 2, 0, 0]]
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    pairs = cKDTree(xyz).query_pairs(near, output_type="ndarray")
    links = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), (len(xyz), len(xyz)))
    group = connected_components(links, directed=False)[1]
    first = np.unique(group, return_index=True)[1]
    corners = _proper(first[group][panel])
    used = np.unique(corners)
    number = np.full(len(xyz), -1, np.int64)
    number[used] = np.arange(len(used))
    return xyz[used], number[corners], number[first[group]]


def _proper(panel: IntArray) -> IntArray:
    """Leave out panels of fewer than three corners; let triangles end with the third one twice."""
    same = panel == np.roll(panel, -1, axis=1)
    opposite = (panel[:, 0] == panel[:, 2]) | (panel[:, 1] == panel[:, 3])
    kept = (same.sum(axis=1) <= 1) & ~opposite
    panel, same = panel[kept], same[kept]
    turn = np.where(same.any(axis=1), same.argmax(axis=1) + 2, 0)
    column = (np.arange(4) + turn[:, None]) % 4
    return np.asarray(np.take_along_axis(panel, column, axis=1))


def merge_equal_vertices(xyz: FloatArray, panel: IntArray) -> tuple[FloatArray, IntArray]:
    """Make vertices one that are equal, and drop what becomes of panels without area.

    Vertices stay in the order in which they were first given; those that no panel has are left
    out.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.surfaces.panel_mesh import merge_equal_vertices
    >>> xyz = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 0, 0], [5, 5, 5]])
    >>> merge_equal_vertices(xyz, np.array([[0, 1, 2, 3]]))[1].tolist()
    [[1, 2, 0, 0]]
    """
    first, group = np.unique(xyz, axis=0, return_index=True, return_inverse=True)[1:]
    corners = _proper(first[group.ravel()][panel])
    used = np.unique(corners)
    number = np.zeros(len(xyz), np.int64)
    number[used] = np.arange(len(used))
    return xyz[used], number[corners]


# --------------------------------------------------------------------------------------
# The part of a mesh that lies below the water surface z = 0.


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
    >>> from assoc_hull.geometry.surfaces.panel_mesh import below_water
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
    xyz, panel = merge_equal_vertices(np.concatenate(places), np.array(panels, np.int64))
    return attrs.evolve(mesh, xyz=xyz, panel=panel, origin=None)


def _below(corner: FloatArray) -> FloatArray:
    """Cut a polygon (n, 3) at z = 0 and give the part below."""
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
    """Split a polygon of three to six corners into panels; vertices are numbered from `first`."""
    if size == 3:
        return [[first, first + 1, first + 2, first + 2]]
    found = [[first, first + i, first + i + 1, first + i + 2] for i in range(1, size - 2, 2)]
    if size % 2:
        found.append([first, first + size - 2, first + size - 1, first + size - 1])
    return found
