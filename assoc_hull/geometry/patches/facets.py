"""Spline surfaces as triangles that know which parameters their corners have.

Every surface is a grid over its knot spans, so fine that triangles stay within a distance of
it and edges below a length. What is cut from the triangles can then be put on the surface itself.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.facets import facets_of
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> net = np.zeros((3, 2, 3))
>>> net[..., 0], net[..., 1] = np.mgrid[0:3, 0:2]
>>> net[1, :, 2] = 0.5
>>> found = facets_of([SplineSurface.bezier(net)], deflection=0.01, longest=1.0)
>>> len(found.mesh.face), found.uv.shape
(10, (10, 3, 2))
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.patches.knots import limits
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.geometry.surfaces.triangles import Triangles, merge_vertices

__all__ = ["Facets", "facets_of", "joined_facets", "kept_facets"]

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

    Parameters
    ----------
    surfaces : sequence of SplineSurface
        One at least.
    deflection : float, m
        How far triangles may lie off their surface, by a bound on second derivatives.
    longest : float, m
        How long sides along the parameters may be.
    """
    return joined_facets([_grid(each, deflection, longest) for each in surfaces])


def joined_facets(parts: Sequence[tuple[FloatArray, IntArray, FloatArray]]) -> Facets:
    """Put triangles of surfaces together.

    Parameters
    ----------
    parts : sequence of ((v, 3) float m, (f, 3) int, (v, 2) float)
        Of each surface the vertices, the triangles, and the parameters of the vertices.

    Returns
    -------
    Facets
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
        deflection, longest = 4.0 * deflection, 2.0 * longest
        u, v = _steps(surface, deflection, longest)
    uu, vv = np.meshgrid(u, v, indexing="ij")
    number = np.arange(uu.size).reshape(uu.shape)
    a, b, c, d = number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]
    first, second = np.stack([a, b, c], axis=2), np.stack([a, c, d], axis=2)
    face = np.stack([first, second], axis=2).reshape(-1, 3)
    parameters = np.column_stack([uu.ravel(), vv.ravel()])
    return surface.at(parameters[:, 0], parameters[:, 1]), face, parameters


def _steps(
    surface: SplineSurface, deflection: float, longest: float
) -> tuple[FloatArray, FloatArray]:
    """Give the parameters of the lines of a grid each way."""
    spans = [
        limits(knots, degree)
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
    return np.clip(np.ceil(wanted), 1, _MOST).astype(np.int64)


def _parted(spans: FloatArray, counts: IntArray) -> FloatArray:
    """Cut spans (k, 2) in equal parts; their ends are met to the bit."""
    inner = [
        np.linspace(low, high, count, endpoint=False)
        for (low, high), count in zip(spans.tolist(), counts.tolist(), strict=True)
    ]
    return np.concatenate([*inner, spans[-1:, 1]])
