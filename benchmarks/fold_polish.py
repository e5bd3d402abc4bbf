"""The least minors of a layer: from the lowest cells of its samples, zoomed in on."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields.layers import Layer
from benchmarks.fold_samples import Samples

__all__ = ["Least", "minors_at", "polished"]

_STARTS = 3
_BLOCKS = 8
_ROUNDS = 9
_STEPS = np.linspace(-1.0, 1.0, 7)
_AXES = {"X_x": 0, "Y_y": 1, "Z_z": 2}


@attrs.frozen
class Least:
    """The least value that sampling and polishing found.

    Attributes
    ----------
    value : float
    minor : str
    place : (float, float, float), m
    sampled : float
        Before polishing.
    """

    value: float
    minor: str
    place: tuple[float, float, float]
    sampled: float


def minors_at(layer: Layer, samples: Samples, places: FloatArray) -> dict[str, FloatArray]:
    """Give the principal minors at places (n, 3), from the layer's own Jacobian.

    They are those in the directions of the grid that was sampled.
    """
    turned = np.linalg.inv(samples.skew) @ layer.jacobian(places) @ samples.skew
    found = {name: turned[:, axis, axis] for name, axis in _AXES.items()}
    one, other = ("xyz".index(axis) for axis in samples.pair)
    found["D"] = found[f"{'XYZ'[one]}_{'xyz'[one]}"] * found[f"{'XYZ'[other]}_{'xyz'[other]}"]
    found["D"] = found["D"] - turned[:, one, other] * turned[:, other, one]
    return found


def polished(layer: Layer, samples: Samples, strength: float) -> Least:
    """Find the least minor of a layer, of which there are samples of strength 1."""
    found = samples.minors(strength)
    if not found:
        return Least(1.0, "D", (0.0, 0.0, 0.0), 1.0)
    if samples.torn:
        return Least(-np.inf, "Y_y", (0.0, 0.0, 0.0), -np.inf)
    names, starts = list[str](), list[FloatArray]()
    for name, values in found.items():
        for cell in _lowest(values):
            names.append(name)
            starts.append(np.array([side[k] for side, k in zip(samples.sides, cell, strict=True)]))
    place, value, name = _zoomed(layer, samples, names, np.array(starts))
    x, y, z = samples.places(place[None, :])[0].tolist()
    coarse = min(float(each.min()) for each in found.values())
    return Least(min(value, coarse), name, (x, y, z), coarse)


def _lowest(values: FloatArray) -> list[tuple[int, ...]]:
    """Give the lowest places, one a block, of the lowest blocks of a grid."""
    edges = [np.unique(np.linspace(0, n, _BLOCKS + 1).astype(int))[:-1] for n in values.shape]
    low = values
    for axis, edge in enumerate(edges):
        low = np.minimum.reduceat(low, edge, axis=axis)
    found = list[tuple[int, ...]]()
    for flat in np.argsort(low, axis=None)[:_STARTS].tolist():
        block = np.unravel_index(flat, low.shape)
        ends = [np.append(edge, n) for edge, n in zip(edges, values.shape, strict=True)]
        spans = [(int(end[k]), int(end[k + 1])) for end, k in zip(ends, block, strict=True)]
        part = values[tuple(slice(*span) for span in spans)]
        inner = np.unravel_index(int(part.argmin()), part.shape)
        found.append(tuple(span[0] + int(k) for span, k in zip(spans, inner, strict=True)))
    return found


def _zoomed(
    layer: Layer, samples: Samples, names: list[str], starts: FloatArray
) -> tuple[FloatArray, float, str]:
    """Go down from each start on ever finer grids around the lowest place met."""
    low = np.array([side[0] for side in samples.sides])
    high = np.array([side[-1] for side in samples.sides])
    reach = np.array([np.diff(side).max(initial=0.0) for side in samples.sides])
    steps = [_STEPS if each > 0.0 else np.zeros(1) for each in reach.tolist()]
    offsets = np.stack(np.meshgrid(*steps, indexing="ij"), axis=-1).reshape(-1, 3)
    row = np.arange(len(starts))
    value = np.full(len(starts), np.inf)
    for _ in range(_ROUNDS):
        tried = np.clip(starts[:, None, :] + offsets * reach, low, high)
        every = minors_at(layer, samples, samples.places(tried.reshape(-1, 3)))
        shape = len(starts), len(offsets)
        met = np.stack([every[name].reshape(shape)[k] for k, name in enumerate(names)])
        best = met.argmin(axis=1)
        starts, value = tried[row, best], met[row, best]
        reach = reach / 3.0
    best_start = int(value.argmin())
    return starts[best_start], float(value[best_start]), names[best_start]
