"""Which axes of a mesh are length, breadth and height.

The length is the longest. The breadth is the axis in which the hull mirrors, or across which
half a hull is cut. Where more than one choice remains, or none, the report calls it doubtful.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.surfaces.triangles import Triangles, boundary_edges
from assoc_hull.io.offset_report import Notebook

__all__ = ["asymmetry", "find_columns", "half_side"]

_WHERE = "the mesh"
_WORST = 0.02
"""A hull that is farther from mirroring, as a part of its length, has no centre plane."""


def find_columns(mesh: Triangles, book: Notebook) -> tuple[int, int, int]:
    """Find the columns of length, breadth and height.

    Raises
    ------
    BadInputError
        The hull mirrors in no axis, and is not cut across one.
    """
    x = int(np.argmax(np.ptp(mesh.xyz, axis=0)))
    others = [axis for axis in range(3) if axis != x]
    tried = 1 if x != 1 else others[0]
    y, why, sure = _find_breadth(mesh, x, tried, next(a for a in others if a != tried))
    z = next(axis for axis in others if axis != y)
    names = "".join("xyz"[axis] for axis in (x, y, z))
    said = f"length along {names[0]}, breadth along {names[1]}, height along {names[2]} of the file"
    if (x, y, z) == (0, 1, 2):
        book.assume("axes", _WHERE, f"{said}, because x is longest and {why}")
    else:
        book.repair("axes", _WHERE, f"{said}; turned into ship axes")
    if not sure:
        what = f"{said}, because {why}; another choice is possible: give axes=, such as '+x+y+z'"
        book.suspect("axes doubtful", _WHERE, what)
    return x, y, z


def _find_breadth(mesh: Triangles, x: int, tried: int, other: int) -> tuple[int, str, bool]:
    """Give the axis of breadth, why, and whether that is clear; `tried` is the usual one."""
    mirrors = [axis for axis in (tried, other) if _is_mirrored(mesh, axis)]
    sides = {axis: half_side(mesh, axis) for axis in (tried, other)}
    open_there = [axis for axis in (tried, other) if sides[axis] is not None]
    if mirrors:
        best = mirrors[0]
        cut = other if best == tried else tried
        side = None if cut in mirrors else sides[cut]
        y, why = _mirror_or_cut(mesh, best, cut, side)
        return y, why, y == tried == best or side is None
    if len(open_there) == 2:
        return _centre_axis(mesh, x, tried, other)
    if open_there == [tried]:
        return tried, f"half a hull is cut across {'xyz'[tried]}", True
    if open_there:
        return _cut_or_deck(mesh, tried, other)
    return _nearest_mirror(mesh, tried, other)


def _is_mirrored(mesh: Triangles, axis: int) -> bool:
    """Tell whether both the surface and its open edges mirror in an axis."""
    size = np.ptp(mesh.xyz, axis=0)
    if asymmetry(mesh, axis) * size.max() > 0.02 * size[axis]:
        return False
    rim = boundary_edges(mesh)
    if not len(rim):
        return True
    ends = mesh.xyz[rim]
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    balance = float((ends[:, :, axis].mean(axis=1) * length).sum() / length.sum())
    middle = 0.5 * float(mesh.xyz[:, axis].min() + mesh.xyz[:, axis].max())
    return abs(balance - middle) < 0.05 * float(size[axis])


def _mirror_or_cut(mesh: Triangles, mirror: int, cut: int, side: float | None) -> tuple[int, str]:
    """Tell a whole hull with an open deck from half of one that is alike above and below.

    Both mirror in one axis and are open at one side across another: the deck of the one, the
    centre plane of the other. What lies at nil of the file is the centre plane.
    """
    mirrors = f"{'xyz'[mirror]} mirrors"
    if side is None:
        return mirror, mirrors
    size = float(np.ptp(mesh.xyz, axis=0).max())
    middle = 0.5 * float(mesh.xyz[:, mirror].min() + mesh.xyz[:, mirror].max())
    if abs(side) < 1e-3 * size < abs(middle):
        return cut, f"half a hull is cut at {'xyz'[cut]} = 0"
    return mirror, f"{mirrors} and the opening across {'xyz'[cut]} may be the deck"


def _centre_axis(mesh: Triangles, x: int, tried: int, other: int) -> tuple[int, str, bool]:
    """Tell the centre plane of a half hull from its open deck: the keel is straighter."""
    share = {axis: _straight_share(mesh, x, axis, away)
             for axis, away in ((tried, other), (other, tried))}  # fmt: skip
    gain = share[other] - share[tried]
    best = other if gain > 0.05 else tried
    why = f"half a hull is cut across {'xyz'[best]}, where its edge is straighter"
    return best, why, best == tried or gain > 0.15


def _cut_or_deck(mesh: Triangles, tried: int, other: int) -> tuple[int, str, bool]:
    """Tell the centre plane of a half hull from the open deck of one without a bottom.

    The edge of half a hull in its centre plane closes in itself; that of a half deck does not.
    """
    cut = f"half a hull is cut across {'xyz'[other]}"
    if _closes(mesh, other):
        return other, cut, True
    size = float(np.ptp(mesh.xyz, axis=0).max())
    low, high = float(mesh.xyz[:, tried].min()), float(mesh.xyz[:, tried].max())
    if min(abs(low), abs(high)) < 1e-3 * size:
        return tried, f"half a hull lies beside {'xyz'[tried]} = 0", False
    return other, f"{cut}, or its deck is open there", False


def _closes(mesh: Triangles, axis: int) -> bool:
    """Tell whether the open edge in the side across an axis is a ring."""
    rim, side = boundary_edges(mesh), half_side(mesh, axis)
    if side is None:
        return False
    size = float(np.ptp(mesh.xyz, axis=0).max())
    on = (np.abs(mesh.xyz[rim][:, :, axis] - side) < 1e-5 * size).all(axis=1)
    return bool((np.unique(rim[on], return_counts=True)[1] % 2 == 0).all())


def _nearest_mirror(mesh: Triangles, tried: int, other: int) -> tuple[int, str, bool]:
    """Take the axis in which the hull comes closest to mirroring."""
    offs = {axis: asymmetry(mesh, axis) for axis in (tried, other)}
    y = other if offs[tried] > 2.0 * offs[other] + 1e-3 else tried
    if offs[y] > _WORST:
        raise BadInputError(
            f"no side of the mesh mirrors the other (best: {1e2 * offs[y]:.3g} % of the length "
            "off)", f"in {_WHERE}", "give axes=, such as '+x+y+z'",
        )  # fmt: skip
    return y, f"{'xyz'[y]} mirrors but for {1e2 * offs[y]:.2g} % of the length", y == tried


def _straight_share(mesh: Triangles, x: int, axis: int, other: int) -> float:
    """Give the part of the length on which the edge in one open plane is farthest from another."""
    rim, size = boundary_edges(mesh), np.ptp(mesh.xyz, axis=0)
    plane, away = half_side(mesh, axis), half_side(mesh, other)
    middle = mesh.xyz[rim].mean(axis=1)
    step = np.abs(np.diff(mesh.xyz[rim], axis=1)[:, 0, x])
    on = np.abs(middle[:, axis] - plane) < 1e-5 * size.max()
    far = np.abs(middle[:, other] - away) > 0.98 * size[other]
    return float(step[on & far].sum() / size[x])


def asymmetry(mesh: Triangles, axis: int) -> float:
    """Give how far the mesh is from mirroring in an axis, as a part of its length."""
    from scipy.spatial import cKDTree

    size = float(np.ptp(mesh.xyz, axis=0).max())
    low, high = float(mesh.xyz[:, axis].min()), float(mesh.xyz[:, axis].max())
    middle = 0.5 * (low + high)
    some = mesh.xyz[:: max(1, len(mesh.xyz) // 4000)].copy()
    some[:, axis] = 2.0 * middle - some[:, axis]
    near = cKDTree(mesh.xyz).query(some)[1]
    away = np.abs(((some - mesh.xyz[near]) * _normals(mesh)[near]).sum(axis=1))
    return float(np.percentile(away, 90)) / size


def _normals(mesh: Triangles) -> FloatArray:
    """Give the mean normal at each vertex: two triangulations of one surface differ along it."""
    vectors = np.repeat(mesh.area_vectors()[:, None, :], 3, axis=1).reshape(-1, 3)
    number, count = mesh.face.ravel(), len(mesh.xyz)
    sums = np.stack([np.bincount(number, column, count) for column in vectors.T], axis=1)
    length = np.linalg.norm(sums, axis=1)
    return np.asarray(sums / np.maximum(length, 1e-300)[:, None])


def half_side(mesh: Triangles, axis: int) -> float | None:
    """Give the place of the centre plane if this is a half hull cut across an axis."""
    rim = boundary_edges(mesh)
    if not len(rim):
        return None
    size = float(np.ptp(mesh.xyz, axis=0).max())
    values = mesh.xyz[rim][:, :, axis]
    length = np.linalg.norm(np.diff(mesh.xyz[rim], axis=1)[:, 0], axis=1)
    for side in (float(mesh.xyz[:, axis].min()), float(mesh.xyz[:, axis].max())):
        on = (np.abs(values - side) < 1e-5 * size).all(axis=1)
        span = np.ptp(mesh.xyz[rim[on]].reshape(-1, 3), axis=0) if on.any() else np.zeros(3)
        across = [other for other in range(3) if other != axis]
        whole = np.ptp(mesh.xyz, axis=0)
        filled = all(span[other] > 0.8 * whole[other] for other in across)
        if filled and length[on].sum() > 0.15 * length.sum():
            return float(np.median(values[on]))  # single vertices may reach a little farther
    return None
