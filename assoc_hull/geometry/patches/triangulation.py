"""Spline surfaces as triangles, sewn where their borders run along each other.

Every corner of a triangle keeps its surface and its parameters, so exact points can be found later.
Borders are sewn however each surface was cut; parts that touch nowhere are turned to face outward.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.patches.knots import span_limits
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.geometry.surfaces.triangles import (
    Triangles,
    inconsistent_triangles,
    merge_vertices,
    part_labels,
    weld_edges,
)

__all__ = [
    "Facets",
    "facets_of",
    "joined_facets",
    "kept_facets",
    "outward_parts",
    "stitch_facets",
]


_MOST = 200
"""A span of a surface is cut in so many parts at most."""

_ALL = 400_000
"""So many triangles are made of one surface at most."""


@attrs.frozen(eq=False)
class Facets:
    """Triangles of surfaces.

    Attributes
    ----------
    mesh : Triangles
        The triangles, each its own origin.
    surface : (f,) int
        The surface that each stands for.
    uv : (f, 3, 2)
        The parameters of its corners there.
    """

    mesh: Triangles
    surface: IntArray
    uv: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.surface, self.uv)


def facets_of(surfaces: Sequence[SplineSurface], deflection: float, longest: float) -> Facets:
    """Make triangles of surfaces, wound so that they face as ``S_u x S_v`` does.

    Every surface is a grid over its knot spans: triangles lie off it by `deflection` at most, m, by
    a bound on second derivatives, sides along the parameters are at most `longest`, m. What is cut
    from the triangles can be put on the surface itself by the parameters of its corners.
    """
    return joined_facets([_grid(each, deflection, longest) for each in surfaces])


def joined_facets(parts: Sequence[tuple[FloatArray, IntArray, FloatArray]]) -> Facets:
    """Put surfaces together, each with vertices (v, 3), m, triangles (f, 3) and parameters (v, 2).

    Equal vertices are one; triangles of two corners are left out.
    """
    count = np.cumsum([0, *(len(xyz) for xyz, _, _ in parts)])
    face = np.concatenate([f + n for (_, f, _), n in zip(parts, count.tolist(), strict=False)])
    uv = np.concatenate([found for _, _, found in parts])[face]
    surface = np.repeat(np.arange(len(parts)), [len(f) for _, f, _ in parts])
    merged = merge_vertices(np.concatenate([xyz for xyz, _, _ in parts]), face)
    return kept_facets(merged.xyz, merged.face, surface, uv)


def kept_facets(xyz: FloatArray, face: IntArray, surface: IntArray, uv: FloatArray) -> Facets:
    """Leave out triangles of two corners."""
    i, j, k = face.T
    good = (i != j) & (j != k) & (k != i)
    mesh = Triangles(xyz, face[good], np.arange(int(good.sum())))
    return Facets(mesh, surface[good], uv[good])


def _grid(
    surface: SplineSurface, deflection: float, longest: float
) -> tuple[FloatArray, IntArray, FloatArray]:
    """Give vertices, triangles and parameters of one surface."""
    u, v = _steps(surface, deflection, longest)
    while 2 * len(u) * len(v) > _ALL:
        # Half the steps each way: the deflection goes with the square of a step.
        deflection, longest = 4.0 * deflection, 2.0 * longest
        u, v = _steps(surface, deflection, longest)
    uu, vv = np.meshgrid(u, v, indexing="ij")
    number = np.arange(uu.size).reshape(uu.shape)
    a, b, c, d = number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]
    first, second = np.stack([a, b, c], axis=2), np.stack([a, c, d], axis=2)
    # A cell at a corner is cut through the corner: else all of one triangle lies on two borders,
    # at the foot of a stem in the centre plane, and waterlines end on its third side.
    for i, j in ((-1, 0), (0, -1)):
        first[i, j], second[i, j] = (a[i, j], b[i, j], d[i, j]), (b[i, j], c[i, j], d[i, j])
    face = np.stack([first, second], axis=2).reshape(-1, 3)
    parameters = np.column_stack([uu.ravel(), vv.ravel()])
    return surface.at(parameters[:, 0], parameters[:, 1]), face, parameters


def _steps(
    surface: SplineSurface, deflection: float, longest: float
) -> tuple[FloatArray, FloatArray]:
    """Give the parameters of the lines of a grid each way."""
    spans = [
        span_limits(knots, degree)
        for knots, degree in zip((surface.knots_u, surface.knots_v), surface.degrees, strict=True)
    ]
    net = surface.patches().net.reshape(len(spans[0]), len(spans[1]), *_orders(surface), 3)
    counts = (
        _counts(np.moveaxis(net, 2, 1), deflection, longest),
        _counts(np.moveaxis(net, (1, 3), (0, 1)), deflection, longest),
    )
    u, v = (_parted(span, count) for span, count in zip(spans, counts, strict=True))
    return u, v


def _orders(surface: SplineSurface) -> tuple[int, int]:
    return surface.degrees[0] + 1, surface.degrees[1] + 1


def _counts(net: FloatArray, deflection: float, longest: float) -> IntArray:
    """Give into how many parts each span is cut; nets (spans, order, ...others, 3)."""
    degree = net.shape[1] - 1
    legs = np.sqrt((np.diff(net, axis=1) ** 2).sum(axis=-1))
    length = legs.sum(axis=1).max(axis=(1, 2)) if degree else np.zeros(len(net))
    wanted = length / longest
    if degree > 1:
        bend = np.sqrt((np.diff(net, 2, axis=1) ** 2).sum(axis=-1)).max(axis=(1, 2, 3))
        wanted = np.maximum(wanted, np.sqrt(degree * (degree - 1) * bend / (8.0 * deflection)))
    # Of places beyond all numbers the extent is refused later.
    wanted = np.nan_to_num(wanted, nan=_MOST, posinf=_MOST)
    return np.clip(np.ceil(wanted), 1, _MOST).astype(np.int64)


def _parted(spans: FloatArray, counts: IntArray) -> FloatArray:
    """Cut spans (k, 2) in equal parts; their ends are met to the bit."""
    inner = [
        np.linspace(low, high, count, endpoint=False)
        for (low, high), count in zip(spans.tolist(), counts.tolist(), strict=True)
    ]
    return np.concatenate([*inner, spans[-1:, 1]])


# --------------------------------------------------------------------------------------
# Sewing.

_PASSES = 6
"""A triangle has three sides; new triangles may have one that is open again."""


def stitch_facets(facets: Facets, reach: float) -> Facets:
    """Sew borders that lie at most so far apart, m.

    Vertices on open edges that lie close become one; an open edge that passes close to a vertex of
    another is split there. What stays open is a border, or a gap wider than asked for.
    """
    welded, _ = weld_edges(facets.mesh, reach)
    found = kept_facets(welded.xyz, welded.face, facets.surface, facets.uv)
    for _ in range(_PASSES):
        splits = _splits(found.mesh, reach)
        if splits is None:
            break
        found = _split(found, splits)
    return found


@attrs.frozen(eq=False)
class _Splits:
    """Sides of triangles to be split: a row for each new vertex, along each side in order."""

    face: IntArray
    side: IntArray
    vertex: IntArray
    part: FloatArray


def _splits(mesh: Triangles, reach: float) -> _Splits | None:
    """Find the vertices on open edges that lie on other open edges; one side a triangle."""
    from scipy.spatial import cKDTree

    rim = _rim_numbers(mesh)
    if not len(rim):
        return None
    ends = mesh.edges()[rim]
    vertex = np.unique(ends)
    start, step = mesh.xyz[ends[:, 0]], mesh.xyz[ends[:, 1]] - mesh.xyz[ends[:, 0]]
    length = np.sqrt((step * step).sum(axis=1))
    near = cKDTree(mesh.xyz[vertex]).query_ball_point(start + 0.5 * step, 0.5 * length + reach)
    edge = np.repeat(np.arange(len(rim)), [len(each) for each in near])
    if not len(edge):
        return None
    point = vertex[np.concatenate([np.array(each, np.int64) for each in near])]
    # `Triangles.edges` has all first sides, then all second, then all third.
    own = mesh.face[rim % len(mesh.face)][edge]
    edge, point = (each[(own != point[:, None]).all(axis=1)] for each in (edge, point))
    away = mesh.xyz[point] - start[edge]
    part = (away * step[edge]).sum(axis=1) / np.maximum(length[edge] ** 2, 1e-300)
    off = away - part[:, None] * step[edge]
    least = reach / np.maximum(length[edge], 1e-300)
    inside = (part > least) & (part < 1.0 - least)
    good = inside & ((off * off).sum(axis=1) <= reach * reach)
    if not good.any():
        return None
    edge, point, part = edge[good], point[good], part[good]
    face, side = rim[edge] % len(mesh.face), rim[edge] // len(mesh.face)
    first = np.full(len(mesh.face), 3)
    np.minimum.at(first, face, side)
    chosen = side == first[face]
    order = np.lexsort((part[chosen], face[chosen]))
    return _Splits(*(each[chosen][order] for each in (face, side, point, part)))


def _rim_numbers(mesh: Triangles) -> IntArray:
    """Give the open edges by their numbers among `Triangles.edges`."""
    keys = mesh.edge_keys()
    order = np.argsort(keys, kind="stable")
    new = np.append(True, np.diff(keys[order]) != 0)
    return np.asarray(order[new & np.append(new[1:], True)])


def _split(facets: Facets, splits: _Splits) -> Facets:
    """Part triangles from the corner across from the side that is split."""
    mesh = facets.mesh
    turn = np.arange(3)
    corner = (splits.side[:, None] + turn) % 3  # a, b on the side, c across from it
    a, b, c = (mesh.face[splits.face, corner[:, i]] for i in turn)
    at = [facets.uv[splits.face, corner[:, i]] for i in turn]
    new = at[0] + splits.part[:, None] * (at[1] - at[0])
    first = np.append(True, splits.face[1:] != splits.face[:-1])
    last = np.append(first[1:], True)
    before = np.where(first, a, np.roll(splits.vertex, 1))
    before_uv = np.where(first[:, None], at[0], np.roll(new, 1, axis=0))
    fans = [np.stack([before, splits.vertex, c], axis=1),
            np.stack([splits.vertex, b, c], axis=1)[last]]  # fmt: skip
    fans_uv = [
        np.stack([before_uv, new, at[2]], axis=1),
        np.stack([new, at[1], at[2]], axis=1)[last],
    ]
    kept = np.ones(len(mesh.face), np.bool_)
    kept[splits.face] = False
    owner = np.concatenate([np.flatnonzero(kept), splits.face, splits.face[last]])
    face = np.concatenate([mesh.face[kept], *fans])
    uv = np.concatenate([facets.uv[kept], *fans_uv])
    return kept_facets(mesh.xyz, face, facets.surface[owner], uv)


def outward_parts(facets: Facets) -> Facets:
    """Turn parts that touch nowhere so that each faces away from the middle of all of them.

    Surfaces of a file may face either way; where they are sewn, neighbours tell each other.
    """
    mesh = facets.mesh
    flip = inconsistent_triangles(mesh)
    sign = np.where(flip, -1.0, 1.0)
    middle = 0.5 * (mesh.xyz.min(axis=0) + mesh.xyz.max(axis=0))
    flux = sign * (mesh.area_vectors() * (mesh.corners.mean(axis=1) - middle)).sum(axis=1)
    label = part_labels(mesh)
    flip ^= np.bincount(label, flux)[label] < 0.0
    face = np.where(flip[:, None], mesh.face[:, ::-1], mesh.face)
    uv = np.where(flip[:, None, None], facets.uv[:, ::-1], facets.uv)
    return Facets(Triangles(mesh.xyz, face, mesh.origin), facets.surface, uv)
