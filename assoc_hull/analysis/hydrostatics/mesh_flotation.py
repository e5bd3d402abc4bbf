"""Hydrostatics' integrals of a triangulated hull: the independent check on those of splines."""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import flag
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.floating.immersed_triangles import (
    TriangleBody,
    immersed_triangles,
    make_body,
)
from assoc_hull.geometry.floating.immersion import FloatingPlanes, ImmersedIntegrals
from assoc_hull.geometry.surfaces.triangles import (
    Triangles,
    check_mesh,
    inconsistent_triangles,
    merge_vertices,
    part_contents,
    sheet_labels,
    turn_triangles,
    unmatched_edges,
    weld_edges,
)

__all__ = ["MeshFlotation", "mesh_flotation"]

_WHERE = "in the mesh"
_ROUNDING = 1e-9
"""Vertices on open edges this part of the size of the hull apart are one."""

_NOTHING = 1e-12
"""Volumes this part of the cube of the size are those of flat sheets."""


@attrs.frozen(eq=False)
class MeshFlotation:
    """A triangulated hull that can be measured below any plane.

    Attributes
    ----------
    body : TriangleBody
        Both sides of the hull, outward.
    half : bool
        Whether half a hull was given.
    turned : int
        How many of its triangles, both sides, were turned round to face outward.
    """

    body: TriangleBody
    half: bool
    turned: int

    def measure(self, planes: FloatingPlanes) -> ImmersedIntegrals:
        """Integrate what the hull has below each plane.

        The mesh does not know a deck: whatever of it is below the plane is part of `shell`,
        ends and deck as well, and `wet_deck` is nil.

        Raises
        ------
        BadInputError
            The mesh is open below a plane.
        """
        return immersed_triangles(self.body, planes)


def mesh_flotation(
    vertices: ArrayLike, faces: ArrayLike, *, half: bool | None = None
) -> MeshFlotation:
    """Prepare a triangulated hull for measuring.

    Parameters
    ----------
    vertices : (n, 3), m
        In ship axes: x forward, y to port, z up.
    faces : (m, 3) int
        Vertices of each triangle. The mesh may be open above every plane it is measured at.
    half : bool or None
        Whether this is one side of the hull, to be mirrored in y = 0. Found from the mesh if
        None: a half lies on one side and is open in the centre plane.

    Returns
    -------
    MeshFlotation
        Its triangles all face outward.

    Raises
    ------
    BadInputError
        No surface, one side of a hull or all of it (that cannot be told), or triangles that
        cannot be made to face outward.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.analysis.hydrostatics.mesh_flotation import mesh_flotation
    >>> from assoc_hull.geometry.floating.immersion import FloatingPlanes
    >>> from assoc_hull.geometry.surfaces.triangles import grid_triangles
    >>> x, z = np.meshgrid(np.linspace(0, 100, 81), np.linspace(0, 6.25, 31), indexing="ij")
    >>> y = 5.0 * (1.0 - (x / 50.0 - 1.0) ** 2) * (1.0 - (1.0 - z / 6.25) ** 2)
    >>> side = grid_triangles(np.stack([x, y, z], axis=2))
    >>> hull = mesh_flotation(side.xyz, side.face)
    >>> level = FloatingPlanes(np.array([6.25]), np.zeros(1), np.zeros(1))
    >>> hull.half, hull.measure(level).volume.round(1).tolist()  # 4/9 L B T = 2777.8
    (True, [2776.6])
    """
    mesh = _surface(vertices, faces)
    size = float(np.ptp(mesh.xyz, axis=0).max())
    mesh = _proper(weld_edges(mesh, _ROUNDING * size)[0])
    one_side = _is_half(mesh, _ROUNDING * size) if half is None else flag(half, "half", _WHERE)
    if one_side:
        mesh = _mirrored(mesh, _ROUNDING * size)
    outward, count = _outward(mesh)
    return MeshFlotation(make_body(outward), one_side, count)


def _surface(vertices: ArrayLike, faces: ArrayLike) -> Triangles:
    """Take vertices and faces; equal places are one vertex, triangles without area are none."""
    numbers = np.array(faces)
    if not np.issubdtype(numbers.dtype, np.integer):
        raise BadInputError(
            f"faces hold {numbers.dtype}", _WHERE, "give whole numbers: the rows of the vertices"
        )
    given = Triangles(np.array(vertices, np.float64), numbers.astype(np.int64))
    check_mesh(given)
    return _proper(merge_vertices(given.xyz, given.face))


def _proper(mesh: Triangles) -> Triangles:
    i, j, k = mesh.face.T
    return Triangles(mesh.xyz, mesh.face[(i != j) & (j != k) & (k != i)])


def _is_half(mesh: Triangles, near: float) -> bool:
    """Tell whether this is one side of a hull, open in the centre plane."""
    y = mesh.xyz[:, 1]
    if y.min() < -near and y.max() > near:
        return False
    if (np.abs(y[unmatched_edges(mesh)]) <= near).all(axis=1).any():
        return True
    if (np.abs(y[mesh.face]) <= near).all(axis=1).any():
        raise BadInputError(
            "the mesh lies on one side and is closed in y = 0: half a hull with a lid, or a whole "
            "one beside the centre plane",
            _WHERE, "say which: half=True or half=False",
        )  # fmt: skip
    return False


def _mirrored(mesh: Triangles, near: float) -> Triangles:
    """Give both sides of a hull; triangles in the centre plane are inside it."""
    xyz = mesh.xyz.copy()
    xyz[np.abs(xyz[:, 1]) <= near, 1] = 0.0
    if xyz[:, 1].min() < 0.0 < xyz[:, 1].max():
        raise BadInputError(
            f"y runs from {xyz[:, 1].min():.6g} to {xyz[:, 1].max():.6g} m in half a hull", _WHERE,
            "leave out what is across the centre plane, or give half=False",
        )  # fmt: skip
    face = mesh.face[(xyz[mesh.face][:, :, 1] != 0.0).any(axis=1)]
    both = np.concatenate([face, face[:, ::-1] + len(xyz)])
    return _proper(merge_vertices(np.concatenate([xyz, xyz * [1.0, -1.0, 1.0]]), both))


def _outward(mesh: Triangles) -> tuple[Triangles, int]:
    """Turn all triangles outward, and count those that were not."""
    flip = inconsistent_triangles(mesh)
    agreed = turn_triangles(mesh, flip)
    _refuse_one_sided(agreed)
    label = sheet_labels(agreed)
    content = part_contents(agreed, label)
    sound = np.abs(content) > _NOTHING * float(np.ptp(mesh.xyz, axis=0).max()) ** 3
    inward = sound & (content < 0.0)
    if not inward.any():
        return agreed, int(flip.sum())
    if (sound & ~inward).any():
        raise _inside_out(agreed, label, content)
    return turn_triangles(agreed, ~np.zeros_like(flip)), int((~flip).sum())


def _refuse_one_sided(mesh: Triangles) -> None:
    """Refuse a surface that has no two sides, as a Moebius strip has none."""
    both = unmatched_edges(mesh)
    edge, count = np.unique(both, axis=0, return_counts=True)
    bad = edge[count > 1]
    if len(bad):
        x, y, z = mesh.xyz[bad[0]].mean(axis=0).tolist()
        raise BadInputError(
            f"{len(bad)} edges have triangles that cannot all face outward, first at "
            f"({x:.6g}, {y:.6g}, {z:.6g}) m",
            _WHERE, "leave out repeated triangles and what crosses the hull",
        )  # fmt: skip


def _inside_out(mesh: Triangles, label: IntArray, content: FloatArray) -> BadInputError:
    worst = int(np.argmin(content))
    x, y, z = mesh.corners[label == worst].mean(axis=(0, 1)).tolist()
    return BadInputError(
        f"of {len(content)} parts some face outward and some inward, as the one "
        f"of {int((label == worst).sum())} triangles and {-content[worst]:.4g} m3 about "
        f"({x:.6g}, {y:.6g}, {z:.6g}) m",
        _WHERE, "turn its triangles round, close it, or leave it out",
    )  # fmt: skip
