"""Where the images of points go, compiled: the bits of `point_images` in numpy.

Importing this module imports numba. Arrays come in one by one; those of a hull that stay are
read-only, as for `compiled_program`.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.numeric.jit import jit, was_loaded
from assoc_hull.model.program.compiled_program import read_only

__all__ = ["set_images", "warm"]

Flags = NDArray[np.bool_]


@jit
def _off(p: FloatArray, r: int, normal: FloatArray, offset: FloatArray, line: int) -> float:
    """Give how far a place lies off the plane of a line."""
    two = p[r, 0] * normal[line, 0] + p[r, 1] * normal[line, 1]
    return float(two + p[r, 2] * normal[line, 2] - offset[line])


@jit
def place_images(
    live: IntArray, line: IntArray, xyz: FloatArray, normal: FloatArray, offset: FloatArray,
    planar: Flags, driver: Flags, crossing: Flags, near: float, image: FloatArray,
    slope: FloatArray, value: FloatArray, direct: Flags, still: Flags, known: Flags,
) -> bool:  # fmt: skip
    """Set what becomes of live points (r, 3); tell whether the mapping folds nowhere among them."""
    sound = True
    for n in range(len(live)):
        r = live[n]
        j = slope[r]
        one = j[0, 0] * (j[1, 1] * j[2, 2] - j[1, 2] * j[2, 1])
        two = j[0, 1] * (j[1, 0] * j[2, 2] - j[1, 2] * j[2, 0])
        volume = one - two + j[0, 2] * (j[1, 0] * j[2, 1] - j[1, 1] * j[2, 0])
        sound = sound and volume > 0.0
        same, on, drives = True, True, True
        for k in range(3):
            same = same and image[r, k] == xyz[r, k]
            for i in range(3):
                same = same and slope[r, k, i] == (1.0 if k == i else 0.0)
            value[r, k] = image[r, k]
        for side in range(2):
            own = line[r, side]
            if own < 0:
                continue
            drives = drives and driver[own]
            if planar[own]:
                on = on and abs(_off(image, r, normal, offset, own)) <= near
        still[r], direct[r] = same, on
        known[r] = on if crossing[r] else drives and on
        if not on:
            continue
        for side in range(2):
            own = line[r, side]
            if own < 0 or not planar[own]:
                continue
            along = False
            for k in range(3):
                along = along or abs(normal[own, k]) == 1.0
            if not along:
                off = _off(value, r, normal, offset, own)
                for k in range(3):
                    value[r, k] -= normal[own, k] * off
        for side in range(2):
            own = line[r, side]
            if own < 0 or not planar[own]:
                continue
            for k in range(3):
                if normal[own, k] == 1.0:
                    value[r, k] = offset[own]
    return sound


_place_images: Callable[..., bool] = place_images


def set_images(
    structure: tuple[NDArray[np.generic], ...], planes: tuple[NDArray[np.generic], ...],
    near: float, image: FloatArray, slope: FloatArray,
) -> tuple[bool, FloatArray, Flags, Flags, Flags]:  # fmt: skip
    """Give whether nothing folds, and value, direct, still and known of `PointImages`.

    Parameters
    ----------
    structure : live (k,), line (r, 2), xyz (r, 3), crossing (r,)
    planes : normal (l, 3), offset (l,), planar (l,), driver (l,)
    near : float, m
        A place as near to a plane as this lies in it.
    image, slope : (r, 3), m, and (r, 3, 3)
        Of all points.
    """
    live, line, xyz, crossing = (read_only(each) for each in structure)
    normal, offset, planar, driver = (read_only(each) for each in planes)
    count = len(image)
    value, direct, known = image.copy(), np.ones(count, np.bool_), np.ones(count, np.bool_)
    still = np.zeros(count, np.bool_)
    sound = _place_images(
        live, line, xyz, normal, offset, planar, driver, crossing, near, read_only(image),
        read_only(slope), value, direct, still, known,
    )  # fmt: skip
    return sound, value, direct, still, known


def warm() -> bool:
    """Compile all, or load what was compiled; tell whether it was loaded."""
    flag, none = np.zeros(1, np.bool_), np.zeros(0, np.int64)
    wide, deep = np.zeros((1, 3)), np.zeros((1, 3, 3))
    structure = none, np.zeros((1, 2), np.int64), wide, flag
    set_images(structure, (wide, np.zeros(1), flag, flag), 0.0, wide, deep)
    return was_loaded(place_images)
