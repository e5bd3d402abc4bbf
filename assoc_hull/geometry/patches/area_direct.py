"""Areas under a patch point by point: Gauss's rules of 5 and 8 points on boxes and on lines.

The difference of the two rules is the estimate of the error; a box or a piece of a line for which
it is too large is split. This needs many more points than a series (`area_series`), and gets along
where there is none: at points where the normal vector vanishes, or almost does.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.area_direct import over_boxes
>>> from assoc_hull.geometry.patches.patches import Patches
>>> net = np.zeros((2, 2, 3))
>>> net[1, :, 0], net[:, 1, 1] = 2.0, 3.0
>>> box = np.array([[[0.0, 1.0], [0.0, 0.5]]])
>>> area, error = over_boxes(Patches.single(net), np.array([0]), box, np.array([1e-9]))
>>> area.round(12)
array([3.])
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.numeric.quadrature import gauss
from assoc_hull.geometry.patches.area_elements import added, on_lines
from assoc_hull.geometry.patches.patches import Patches

__all__ = ["along_lines", "over_boxes"]

_FEW, _MANY = 5, 8
_ROUNDS = 24
# Rows at a time, so that the values stay in the cache.
_BLOCK = 512

Rule = Callable[[IntArray, FloatArray, int], FloatArray]


def over_boxes(
    patches: Patches, patch: IntArray, box: FloatArray, tolerance: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Integrate the area element over boxes of parameters.

    Parameters
    ----------
    patches : Patches
        The patches.
    patch : (c,) int
        The patch of each box.
    box : (c, 2, 2)
        ``[[u0, u1], [v0, v1]]``, in parameters of the patch.
    tolerance : (c,) float, m2
        How large the estimate of the error of each may be.

    Returns
    -------
    (c,), (c,) float, m2
        Areas and estimates of their errors. An estimate above the tolerance tells that splitting
        ended first.
    """

    def rule(rows: IntArray, part: FloatArray, count: int) -> FloatArray:
        nodes, weights = gauss(count)
        width = part[:, :, 1] - part[:, :, 0]
        u, v = np.moveaxis(part[..., :1] + width[..., None] * nodes, 1, 0)
        places = np.repeat(u[:, None], count, axis=1)
        values = on_lines(patches, patch[rows], places, v) * weights * weights[:, None]
        return width[:, 0] * width[:, 1] * added(values.reshape(len(rows), -1).T.copy())

    return _halved(rule, box, tolerance)


def along_lines(
    patches: Patches,
    patch: IntArray,
    span: FloatArray,
    v: FloatArray,
    tolerance: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """Integrate the area element along lines v = constant.

    Parameters
    ----------
    patches : Patches
        The patches.
    patch : (c,) int
        The patch of each line.
    span : (c, 2)
        The values of u at which each begins and ends.
    v : (c,)
        The lines.
    tolerance : (c,) float, m2
        How large the estimate of the error of each may be, per unit of v.

    Returns
    -------
    (c,), (c,) float, m2
        Integrals and estimates of their errors, per unit of v.
    """

    def rule(rows: IntArray, part: FloatArray, count: int) -> FloatArray:
        nodes, weights = gauss(count)
        width = part[:, 0, 1] - part[:, 0, 0]
        u = part[:, 0, :1] + width[:, None] * nodes
        values = on_lines(patches, patch[rows], u[:, None], v[rows, None])[:, 0] * weights
        return width * added(values.T.copy())

    return _halved(rule, span[:, None], tolerance)


def _halved(rule: Rule, box: FloatArray, tolerance: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Integrate over boxes (c, d, 2) of any dimension d; halve what is not good enough."""
    count = len(box)
    value, error = np.zeros((2, count))
    rows, allowed = np.arange(count), tolerance
    for turn in range(_ROUNDS):
        fine, off = _by_blocks(rule, rows, box)
        good = off <= np.maximum(allowed, 1e-15 * np.abs(fine))
        if turn == _ROUNDS - 1:
            good[:] = True
        value += np.bincount(rows[good], fine[good], count)
        error += np.bincount(rows[good], off[good], count)
        if good.all():
            break
        rows, allowed, box = rows[~good], allowed[~good], _parts(box[~good])
        parts = box.shape[1]
        rows, allowed = rows.repeat(parts), (allowed / parts).repeat(parts)
        box = box.reshape(-1, *box.shape[2:])
    return value, error


def _by_blocks(rule: Rule, rows: IntArray, box: FloatArray) -> tuple[FloatArray, FloatArray]:
    fine, coarse = np.empty((2, len(rows)))
    for first in range(0, len(rows), _BLOCK):
        part = slice(first, first + _BLOCK)
        fine[part] = rule(rows[part], box[part], _MANY)
        coarse[part] = rule(rows[part], box[part], _FEW)
    return fine, np.abs(fine - coarse)


def _parts(box: FloatArray) -> FloatArray:
    """Halve boxes (c, d, 2) in all directions: (c, 2 ** d, d, 2)."""
    middle = 0.5 * (box[..., 0] + box[..., 1])
    found = box[:, None]
    for axis in range(box.shape[1]):
        low, high = found.copy(), found.copy()
        low[:, :, axis, 1] = middle[:, None, axis]
        high[:, :, axis, 0] = middle[:, None, axis]
        found = np.concatenate([low, high], axis=1)
    return found
