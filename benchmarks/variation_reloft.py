"""What lofting again costs: curves through the images of points, beside the images of the curves.

Sections get a point every 0.9 m; what their lofted images leave the exact ones by is told, and how
many points more hold them to 10, 5 and 2 mm.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.edit.recut.driver_image import CurveImages, image_misfit
from assoc_hull.edit.space_map import SpaceMap
from assoc_hull.geometry.curves import CurveData, FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.segments import evaluate
from assoc_hull.model.network import curve_data
from assoc_hull.model.tables import HullState
from assoc_hull.variation.fields.layers import Layer
from assoc_hull.variation.fields.space_map import VariationMap
from benchmarks.variation_methods import mapped, sections

__all__ = ["SPACING", "TOLERANCES", "Relofted", "evenly", "relofted"]

SPACING = 0.9
"""Between points, m, as nearly as stretches between knuckles allow."""

TOLERANCES = (1e-2, 5e-3, 2e-3)
"""To which images are held, m."""

_LEAST = 0.05
"""No interval shorter than this (m) is given a point."""

_ROUNDS = 12


@attrs.frozen
class Relofted:
    """What lofting again does to the sections that a map touches.

    Attributes
    ----------
    curves, points : int
        How many sections, and their points, every 0.9 m.
    error : float, m
        Largest distance from the exact image with these points.
    needed : tuple of int
        Points that hold them to each tolerance.
    """

    curves: int
    points: int
    error: float
    needed: tuple[int, ...]


def relofted(state: HullState, layer: Layer, tolerances: Sequence[float] = TOLERANCES) -> Relofted:
    """Measure what lofting again does to sections of a hull."""
    vmap = VariationMap((layer,))
    space = SpaceMap(vmap, vmap.jacobian)
    data = _touched(evenly(state, sections(state)), vmap)
    image = CurveImages.of(space, loft(data), tuple(range(len(data.start) - 1)))
    knots = image.batch.knot
    error = float(_off(image, data, knots, vmap)[0].max())
    found = [_held(image, data, vmap, tolerance) for tolerance in tolerances]
    return Relofted(len(data.start) - 1, len(data.xyz), error, tuple(found))


def evenly(state: HullState, curves: IntArray) -> CurveData:
    """Give curves through points every 0.9 m; knuckles and given tangents stay points."""
    data = curve_data(state, curves)
    batch = loft(data)
    kept = data.kind != 0
    kept[data.start[:-1]] = kept[data.start[1:] - 1] = True
    places = [_spaced(batch, kept, i) for i in range(batch.count)]
    row = np.concatenate([each[0] for each in places])
    owner = np.repeat(np.arange(batch.count), [len(each[0]) for each in places])
    xyz = evaluate(batch, owner, np.concatenate([each[1] for each in places]))
    old = row >= 0
    return attrs.evolve(
        data, start=np.searchsorted(owner, np.arange(batch.count + 1)), xyz=xyz,
        kind=np.where(old, data.kind[row], 0).astype(np.int8),
        direction=np.where(old[:, None], data.direction[row], 0.0),
    )  # fmt: skip


def _spaced(
    batch: SplineBatch, kept: np.typing.NDArray[np.bool_], curve: int
) -> tuple[list[int], list[float]]:
    """Give which points of a curve stay, -1 for new ones between them, and all parameters, m."""
    first, last = int(batch.start[curve]), int(batch.start[curve + 1])
    own = first + np.flatnonzero(kept[first:last])
    rows, t = [int(own[0])], [float(batch.knot[own[0]])]
    for high in own[1:].tolist():
        end = float(batch.knot[high])
        count = max(int(np.ceil((end - t[-1]) / SPACING)), 1)
        t += np.linspace(t[-1], end, count + 1)[1:].tolist()
        rows += [-1] * (count - 1) + [high]
    return rows, t


def _touched(data: CurveData, vmap: VariationMap) -> CurveData:
    """Leave out curves of which no point moves."""
    moves = (vmap(data.xyz) != data.xyz).any(axis=1)
    some = np.flatnonzero(np.logical_or.reduceat(moves, data.start[:-1]))
    rows = np.concatenate([np.arange(data.start[i], data.start[i + 1]) for i in some])
    return attrs.evolve(
        data, start=np.concatenate([[0], np.cumsum(np.diff(data.start)[some])]),
        xyz=data.xyz[rows], kind=data.kind[rows], direction=data.direction[rows],
        end_kind=data.end_kind[some], end_vector=data.end_vector[some],
    )  # fmt: skip


def _off(
    image: CurveImages, data: CurveData, knots: FloatArray, vmap: VariationMap
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give per segment how far it is off, where its middle was, and how long it is, m."""
    batch = loft(mapped(data, vmap))
    away, middle = image_misfit(image, np.arange(batch.count), batch, knots)
    long = np.delete(np.diff(batch.knot), batch.start[1:-1] - 1)
    return away, middle, long


def _held(image: CurveImages, data: CurveData, vmap: VariationMap, tolerance: float) -> int:
    """Count the points that hold curves to their images."""
    knots = image.batch.knot
    for _ in range(_ROUNDS):
        away, middle, long = _off(image, data, knots, vmap)
        wide = np.flatnonzero((away > tolerance) & (long > _LEAST))
        if not len(wide):
            break
        count = np.diff(data.start) - 1
        owner = np.repeat(np.arange(len(count)), count)[wide]
        at = wide + owner + 1
        xyz = evaluate(image.batch, owner, middle[wide])
        data = attrs.evolve(
            data,
            start=data.start + np.searchsorted(owner, np.arange(len(count) + 1)),
            xyz=np.insert(data.xyz, at, xyz, axis=0), kind=np.insert(data.kind, at, 0),
            direction=np.insert(data.direction, at, 0.0, axis=0),
        )  # fmt: skip
        knots = np.insert(knots, at, middle[wide])
    return len(data.xyz)
