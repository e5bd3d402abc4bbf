"""Other surfaces of the same hull, and how far their curvature lies from that of the published one.

A stiffer fit, or one without every second waterline, is as good an answer to the lines.
Where their curvatures differ, the net does not settle it.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.net.curve_net import gather_net
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.numeric.quadrature import lobatto
from assoc_hull.geometry.patches.bezier_patches import Patches, curvatures, inner, jets
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.model.tables import HullState
from assoc_hull.surface.blocks.fit_net import surface_of_net
from assoc_hull.surface.blocks.fit_options import FitOptions
from assoc_hull.surface.blocks.fitted_surface import FittedSurface
from assoc_hull.surface.plating.hull_shell import NODES, HullShell

__all__ = [
    "every_second_waterline",
    "other_fits",
    "rival_curvature",
]


_STIFFER = 2.0
"""Times the penalty."""


def every_second_waterline(state: HullState) -> tuple[str, ...]:
    """Give the names of every second waterline from below, but for those that end the hull."""
    net = gather_net(state)
    heights: dict[str, float] = {}
    for curve in np.flatnonzero((np.array(net.family) == "waterlines") & ~net.end).tolist():
        first = int(net.batch.start[curve])
        heights.setdefault(net.name[curve], float(net.batch.xyz[first, 2]))
    return tuple(sorted(heights, key=lambda name: (heights[name], name))[::2])


def other_fits(state: HullState, options: FitOptions) -> tuple[FittedSurface, ...]:
    """Fit a hull twice more: with twice the penalty, and without every second waterline."""
    stiffer = attrs.evolve(options, smoothing=_STIFFER * options.smoothing)
    found = [surface_of_net(state, stiffer)]
    thinned = every_second_waterline(state)
    if thinned:
        found.append(surface_of_net(state, options, thinned))
    return tuple(found)


# --------------------------------------------------------------------------------------
# Curvature of another fit beside the nodes of the published one.

_STEPS = 4
"""Gauss-Newton steps to the nearest point."""

_AT_ONCE = 8192
"""Points at a time: what they need stays in the cache."""

_FAR = 1e-3
"""Of the hull's length: a nearest point farther away is none."""


def rival_curvature(
    shell: HullShell, names: Sequence[str], surfaces: Sequence[SplineSurface], others: Sequence[str]
) -> FloatArray:
    """Give the curvature of another fit beside the nodes of a hull, (k, q, q), 1/m2.

    At the nearest points of the block of the same name; nan where there is none. `names` are those
    of the hull's blocks, `others` those of the blocks of the other fit, whose `surfaces` are given.
    """
    found = np.full(shell.nodes.gauss.shape, np.nan)
    far = _FAR * float(np.ptp(shell.patches.net[..., 0]))
    at, _ = lobatto(NODES)
    local = np.stack(np.meshgrid(at, at, indexing="ij"), axis=-1).reshape(-1, 2)
    for number, name in enumerate(names):
        if name not in others:
            continue
        rows = np.flatnonzero(shell.patches.surface == number)
        other = surfaces[list(others).index(name)]
        uv = shell.patches.parameters(np.repeat(rows, len(local)), np.tile(local, (len(rows), 1)))
        start = _same_place(uv, shell.surfaces[number], other)
        place, patches = shell.nodes.place[rows].reshape(-1, 3), other.patches()
        parts = [slice(low, low + _AT_ONCE) for low in range(0, len(place), _AT_ONCE)]
        gauss = [_gauss(patches, place[part], start[part], far) for part in parts]
        found[rows] = np.concatenate(gauss).reshape(found[rows].shape)
    return found


def _same_place(uv: FloatArray, own: SplineSurface, other: SplineSurface) -> FloatArray:
    """Turn parameters of a surface into those of another with a domain of its own."""
    (low, high), (start, end) = np.transpose(own.domain), np.transpose(other.domain)
    return np.asarray(start + (uv - low) / (high - low) * (end - start))


def _gauss(patches: Patches, place: FloatArray, uv: FloatArray, far: float) -> FloatArray:
    """Give K at the nearest points, (p,); nan where they are too far away."""
    low, high = patches.box[..., 0].min(axis=0), patches.box[..., 1].max(axis=0)
    for _ in range(_STEPS):
        row, local = _located(patches, uv)
        jet = jets(patches, row, local)
        off = place - jet.r
        e, f, g = inner(jet.ru, jet.ru), inner(jet.ru, jet.rv), inner(jet.rv, jet.rv)
        a, b = inner(off, jet.ru), inner(off, jet.rv)
        det = e * g - f * f
        sound = det > 1e-12 * e * g
        # Where r_u and r_v are parallel there is no step; no step is longer than a patch.
        det = np.where(sound, det, 1.0)
        step = np.stack([(g * a - f * b) / det, (e * b - f * a) / det], axis=1)
        size = patches.box[row, :, 1] - patches.box[row, :, 0]
        step = np.clip(np.where(sound[:, None], step, 0.0), -1.0, 1.0) * size
        uv = np.clip(uv + step, low, high)
    row, local = _located(patches, uv)
    found = curvatures(patches, row, local)
    near = np.linalg.norm(found.position - place, axis=1) <= far
    return np.where(near, found.gauss, np.nan)


def _located(patches: Patches, uv: FloatArray) -> tuple[IntArray, FloatArray]:
    """Give the patch of parameters, and parameters in it."""
    u, v = (np.unique(patches.box[:, axis, 0]) for axis in (0, 1))
    i, j = (
        np.clip(np.searchsorted(low, uv[:, axis], "right") - 1, 0, len(low) - 1)
        for axis, low in enumerate((u, v))
    )
    row: NDArray[np.intp] = i * len(v) + j
    box = patches.box[row]
    local = (uv - box[..., 0]) / (box[..., 1] - box[..., 0])
    return row, np.clip(local, 0.0, 1.0)
