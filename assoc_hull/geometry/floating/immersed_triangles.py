"""What a triangulated body has below floating planes, each triangle cut exactly.

A plane takes a corner off a triangle. Over triangles all integrands are polynomials, so no value
has an error but rounding. The flux is that of height above the plane, ``h dz``: it is zero on the
plane, which so needs no lid; the edges of the waterplane give its area, moments and extents.
A vertex in the plane counts as above it: a row of such vertices is counted once, and a level top
face that the plane just reaches is the waterplane.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.floating.immersion import FloatingPlanes, ImmersedIntegrals
from assoc_hull.geometry.surfaces.triangles import Triangles, unmatched_edges

__all__ = [
    "TriangleBody",
    "WaterEdges",
    "edge_extents",
    "edge_moments",
    "immersed_triangles",
    "join_edges",
    "make_body",
]

# --------------------------------------------------------------------------------------
# Straight pieces of the edges of waterplanes.


@attrs.frozen(eq=False)
class WaterEdges:
    """Straight pieces of the edge of waterplanes.

    Attributes
    ----------
    plane : (k,) int
        The plane of each; ascending for `edge_extents`.
    ends : (k, 2, 3), m
        Begin and end, the waterplane to the left.
    """

    plane: IntArray
    ends: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.plane, self.ends)


def edge_moments(cuts: WaterEdges, count: int) -> tuple[FloatArray, ...]:
    """Give area, first and second moments of waterplanes by Green's theorem, (count,) each."""
    (x, y), (to_x, to_y) = cuts.ends[:, 0, :2].T, cuts.ends[:, 1, :2].T
    swept = 0.5 * (x * to_y - y * to_x)
    columns = [
        swept,
        swept * (x + to_x) / 3.0,
        swept * (y + to_y) / 3.0,
        swept * (x * x + x * to_x + to_x * to_x) / 6.0,
        swept * (2.0 * (x * y + to_x * to_y) + x * to_y + to_x * y) / 12.0,
        swept * (y * y + y * to_y + to_y * to_y) / 6.0,
    ]
    return tuple(np.asarray(np.bincount(cuts.plane, each, count), np.float64) for each in columns)


def edge_extents(cuts: WaterEdges, count: int) -> tuple[FloatArray, ...]:
    """Give least x, greatest x, least y, greatest y of waterplanes; nan where there is none."""
    found = np.full((count, 4), np.nan)
    if len(cuts.plane):
        first = np.flatnonzero(np.append(True, np.diff(cuts.plane) != 0))
        low = np.minimum.reduceat(cuts.ends.min(axis=1), first)
        high = np.maximum.reduceat(cuts.ends.max(axis=1), first)
        rows = np.stack([low[:, 0], high[:, 0], low[:, 1], high[:, 1]], axis=1)
        found[cuts.plane[first]] = rows
    return tuple(column.copy() for column in found.T)


def join_edges(one: WaterEdges, other: WaterEdges) -> WaterEdges:
    """Give the pieces of both, sorted by plane; those given need not be."""
    plane = np.concatenate([one.plane, other.plane])
    order = np.argsort(plane, kind="stable")
    return WaterEdges(plane[order], np.concatenate([one.ends, other.ends])[order])


# --------------------------------------------------------------------------------------
# Triangles below planes.

_AT_ONCE = 200_000
"""About so many cut triangles are held at a time."""

_FEW = 4
"""Up to so many planes it is quicker to add up the triangles below each one separately."""

_ROUNDING = 1e-9
"""An open edge this part of the size of the body below the plane is at it."""


@attrs.frozen(eq=False)
class TriangleBody:
    """Triangles with their integrals.

    Attributes
    ----------
    mesh : Triangles
        The surface, outward.
    rim : (e, 2) int
        Vertices of its open edges, as their triangles run.
    sums : (12, f)
        Integrals over each triangle, see `_triangle_sums`.
    """

    mesh: Triangles
    rim: IntArray
    sums: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.rim, self.sums)


def make_body(mesh: Triangles) -> TriangleBody:
    """Prepare a surface, outward all over, for `immersed_triangles`."""
    return TriangleBody(mesh, unmatched_edges(mesh), _triangle_sums(mesh.corners))


def immersed_triangles(body: TriangleBody, planes: FloatingPlanes) -> ImmersedIntegrals:
    """Integrate what a body has below each plane; in any order of heights and inclinations.

    Raises
    ------
    BadInputError
        The surface is open below a plane.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.floating.immersion import FloatingPlanes
    >>> from assoc_hull.geometry.floating.immersed_triangles import immersed_triangles, make_body
    >>> from assoc_hull.geometry.surfaces.triangles import Triangles
    >>> xyz = np.array([[0.0, 0, 0], [3, 0, 0], [0, 3, 0], [0, 0, 3]])
    >>> corner = Triangles(xyz, np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]))
    >>> level = FloatingPlanes(np.array([1.0, 3]), np.zeros(2), np.zeros(2))
    >>> below = immersed_triangles(make_body(corner), level)
    >>> below.volume.round(12).tolist(), below.area.round(12).tolist()
    ([3.166666666667, 4.5], [2.0, 0.0])
    """
    tilt, group = np.unique(
        np.stack([planes.tan_trim, planes.tan_heel], axis=1), axis=0, return_inverse=True
    )
    values = np.empty((len(attrs.fields(ImmersedIntegrals)), len(planes.height)))
    for number, (trim, heel) in enumerate(tilt.tolist()):
        rows = np.flatnonzero(group.reshape(-1) == number)
        rows = rows[np.argsort(planes.height[rows], kind="stable")]
        values[:, rows] = _parallel(body, _Levels.make(body.mesh, trim, heel), planes.height[rows])
    return ImmersedIntegrals(*(row.copy() for row in values))


@attrs.frozen(eq=False)
class _Levels:
    """Heights at which planes of one inclination touch a mesh, as heights over the origin.

    Attributes
    ----------
    trim, heel : float
        Tangents.
    vertex : (n,), m
        Of the planes through the vertices.
    low, high : (f,), m
        Of the planes that touch the triangles.
    """

    trim: float
    heel: float
    vertex: FloatArray
    low: FloatArray
    high: FloatArray

    @classmethod
    def make(cls, mesh: Triangles, trim: float, heel: float) -> _Levels:
        """Find them for all vertices and triangles."""
        x, y, z = mesh.xyz.T
        vertex = z - (trim * x - heel * y)
        a, b, c = (vertex[column] for column in mesh.face.T)
        low = np.minimum(np.minimum(a, b), c)
        return cls(trim, heel, vertex, low, np.maximum(np.maximum(a, b), c))


def _parallel(body: TriangleBody, levels: _Levels, height: FloatArray) -> FloatArray:
    """Integrate below parallel planes, heights ascending: `ImmersedIntegrals` as rows, (17, d)."""
    above = np.searchsorted(height, levels.low, "right")
    cuts = int((np.searchsorted(height, levels.high, "right") - above).sum())
    step = max(1, _AT_ONCE * len(height) // max(cuts, 1))
    starts = range(0, max(1, len(height)), step)
    return np.concatenate([_block(body, levels, height[i : i + step]) for i in starts], axis=1)


def _block(body: TriangleBody, levels: _Levels, height: FloatArray) -> FloatArray:
    count = len(height)
    # From plane `first` on a triangle is cut, from plane `whole` on it is wholly below.
    first = np.searchsorted(height, levels.low, "right")
    whole = np.searchsorted(height, levels.high, "right")
    sums = _sum_whole(body, whole, count)
    face = np.repeat(np.arange(len(first)), whole - first)
    plane = np.arange(len(face)) - np.repeat(np.cumsum(whole - first) - whole, whole - first)
    corners, sign = _cut_corners(body.mesh, levels.vertex, height[plane], face)
    sums += _sum_rows(plane, sign * _triangle_sums(corners), count)
    most = sign < 0.0
    sums += _sum_rows(plane[most], body.sums[:, face[most]], count)
    # The side in the plane, the waterplane to its left: by which part of the triangle is below.
    turned = np.where(sign[:, None, None] > 0.0, corners[:, :0:-1], corners[:, 1:])
    cuts = join_edges(WaterEdges(plane, turned), _wet_rim(body, levels.vertex, height))
    solid = _solid(sums, height, levels.trim, -levels.heel)
    shell = sums[10], sums[11], np.zeros(count)
    return np.stack([*solid, *edge_moments(cuts, count), *shell, *edge_extents(cuts, count)])


def _sum_whole(body: TriangleBody, whole: IntArray, count: int) -> FloatArray:
    """Add up the triangles that are below each plane as a whole, (12, count)."""
    if count <= _FEW:
        return np.asarray(body.sums @ (whole[:, None] <= np.arange(count)).astype(np.float64))
    return np.cumsum(_sum_rows(whole, body.sums, count + 1)[:, :-1], axis=1)


def _cut_corners(
    mesh: Triangles, vertex: FloatArray, height: FloatArray, face: IntArray
) -> tuple[FloatArray, FloatArray]:
    """Give the corner that a plane takes off each cut triangle, (k, 3, 3), tip first; its sign.

    The sign is +1 where the corner is all that is below, -1 where it is what is missing.
    """
    below = vertex[mesh.face[face]] < height[:, None]
    sign = np.where(below.sum(axis=1) == 1, 1.0, -1.0)
    tip = np.argmax(below == (sign > 0.0)[:, None], axis=1)
    number = mesh.face[face[:, None], (tip[:, None] + np.arange(3)) % 3]
    place, level = mesh.xyz[number], vertex[number] - height[:, None]
    for side in (1, 2):
        place[:, side] = _cut_edges(place[:, [0, side]], level[:, [0, side]])
    return place, sign


def _cut_edges(ends: FloatArray, level: FloatArray) -> FloatArray:
    """Cut edges, (k, 2, 3), with the plane; always from below, so neighbours agree to the bit."""
    turn = level[:, 0] >= 0.0
    ends = np.where(turn[:, None, None], ends[:, ::-1], ends)
    level = np.where(turn[:, None], level[:, ::-1], level)
    part = level[:, 0] / (level[:, 0] - level[:, 1])
    return np.asarray(ends[:, 0] + part[:, None] * (ends[:, 1] - ends[:, 0]))


def _triangle_sums(corners: FloatArray) -> FloatArray:
    """Integrate over triangles, (k, 3, 3): 1, x, y, z, xx, xy, yy, xz, yz, zz, area, girth.

    The first ten, of the (12, k), are over the projection on z = 0, positive for triangles that
    face up.
    """
    x, y, z = np.ascontiguousarray(corners.transpose(2, 1, 0))
    side, other = ([w[n] - w[0] for w in (x, y, z)] for n in (1, 2))
    vector = [0.5 * (side[i] * other[j] - side[j] * other[i]) for i, j in ((1, 2), (2, 0), (0, 1))]
    across = vector[0] ** 2, vector[1] ** 2 + vector[2] ** 2
    plan, sums = vector[2], [w.sum(axis=0) for w in (x, y, z)]
    pairs = (x, 0, x, 0), (x, 0, y, 1), (y, 1, y, 1), (x, 0, z, 2), (y, 1, z, 2), (z, 2, z, 2)
    products = [(v * w).sum(axis=0) + sums[i] * sums[j] for v, i, w, j in pairs]
    return np.array(
        [
            plan, *(plan / 3.0 * each for each in sums), *(plan / 12.0 * each for each in products),
            np.sqrt(across[0] + across[1]), np.sqrt(across[1]),
        ]
    )  # fmt: skip


def _sum_rows(plane: IntArray, values: FloatArray, count: int) -> FloatArray:
    """Add up columns, (c, k), per plane: (c, count)."""
    return np.array([np.bincount(plane, row, count) for row in values], np.float64)


def _solid(sums: FloatArray, t: FloatArray, a: float, b: float) -> tuple[FloatArray, ...]:
    """Give the volume and the integrals of x, y and z over it.

    Each is that of the height above the plane ``z = t + a x + b y``, and its square, over the
    shell in plan.
    """
    one, x, y, z, xx, xy, yy, xz, yz, zz = sums[:10]
    volume = z - (t * one + a * x + b * y)
    moment_x = xz - (t * x + a * xx + b * xy)
    moment_y = yz - (t * y + a * xy + b * yy)
    level_z = t * z + a * xz + b * yz
    level_level = t * (t * one + 2.0 * (a * x + b * y)) + a * a * xx + 2.0 * a * b * xy + b * b * yy
    above = 0.5 * (zz - 2.0 * level_z + level_level)
    return volume, moment_x, moment_y, above + t * volume + a * moment_x + b * moment_y


def _wet_rim(body: TriangleBody, vertex: FloatArray, height: FloatArray) -> WaterEdges:
    """Give the open edges at the plane: within rounding below it, they bound the waterplane."""
    level = vertex[body.rim] - height[:, None, None]
    plane, edge = np.nonzero((level < 0.0).any(axis=2))
    level, ends = level[plane, edge], body.mesh.xyz[body.rim[edge]]
    if not len(plane):
        return WaterEdges(plane, ends)
    size = float(np.ptp(body.mesh.xyz, axis=0).max())
    half = (level >= 0.0).any(axis=1)
    meet = _cut_edges(ends[half], level[half])
    ends[half] = np.where((level[half] >= 0.0)[:, :, None], meet[:, None], ends[half])
    _refuse_open(plane, ends, level, _ROUNDING * size)
    return WaterEdges(plane, ends[:, ::-1].copy())


def _refuse_open(plane: IntArray, ends: FloatArray, level: FloatArray, least: float) -> None:
    """Refuse openings deeper below a plane than rounding explains."""
    deep = np.flatnonzero(level.min(axis=1) < -least)
    if not len(deep):
        return
    here = deep[plane[deep] == plane[deep[0]]]
    worst = here[np.argmin(level[here].min(axis=1))]
    x, y, z = ends[worst].mean(axis=0).tolist()
    length = float(np.linalg.norm(ends[here, 1] - ends[here, 0], axis=1).sum())
    raise BadInputError(
        f"the mesh is open below the plane: {len(here)} edges, {length:.4g} m in all, are "
        f"not shared by two triangles; deepest, {-float(level[worst].min()):.4g} m below it, "
        f"at ({x:.6g}, {y:.6g}, {z:.6g}) m",
        "in the mesh", "close it there, or choose a plane below",
    )  # fmt: skip
