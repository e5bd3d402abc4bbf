"""Curves across a Coons surface, compiled; numpy's of `coons` to rounding.

Unlike splines and meetings these need not have the same bits: nothing that is kept of a hull
depends on them.

Examples
--------
>>> from assoc_hull.geometry.splines.compiled_coons import set_bows, set_tiles
>>> callable(set_bows) and callable(set_tiles)
True
"""

from __future__ import annotations

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.numeric.jit import jit

__all__ = ["set_bows", "set_tiles"]


@jit
def _root(cubic: FloatArray, target: float, steps: int, small: float) -> float:
    """Find where x of one monotone cubic reaches a value; beyond 2 where Newton's rule fails."""
    c0, c1, c2, c3 = cubic[0, 0] - target, cubic[1, 0], cubic[2, 0], cubic[3, 0]
    slope = c1 + c2 + c3
    if slope == 0.0:
        return 3.0
    u = -c0 / slope
    for _ in range(steps):
        step = (((c3 * u + c2) * u + c1) * u + c0) / ((3.0 * c3 * u + 2.0 * c2) * u + c1)
        u -= step
        if abs(step) <= small:
            if -small <= u <= 1.0 + small:
                return 0.0 if u < 0.0 else (1.0 if u > 1.0 else float(u))
            return 3.0
    return 3.0


@jit
def set_bows(
    chosen: IntArray,
    path: IntArray,
    curve: IntArray,
    v: FloatArray,
    start: IntArray,
    cubic: FloatArray,
    steps: int,
    small: float,
    bow: FloatArray,
) -> bool:
    """Set by what anchors that are walked by x leave their chords; False if one is lost."""
    for k in range(len(chosen)):
        p, w = path[k], v[curve[k]]
        first, last = start[p], start[p + 1] - 1
        begin = cubic[first, 0]
        finish = cubic[last, 0] + cubic[last, 1] + cubic[last, 2] + cubic[last, 3]
        target = begin[0] + w * (finish[0] - begin[0])
        rising = finish[0] >= begin[0]
        bit = first
        while bit < last and ((cubic[bit + 1, 0, 0] <= target) == rising):
            bit += 1
        u = _root(cubic[bit], target, steps, small)
        if u > 2.0:
            return False
        row = bow[chosen[k]]
        c0, c1, c2, c3 = cubic[bit, 0], cubic[bit, 1], cubic[bit, 2], cubic[bit, 3]
        rate = (3.0 * c3[0] * u + 2.0 * c2[0]) * u + c1[0]
        share = (finish[0] - begin[0]) / rate
        for i in range(3):
            chord = finish[i] - begin[i]
            place = ((c3[i] * u + c2[i]) * u + c1[i]) * u + c0[i]
            row[i] = place - (begin[i] + w * chord)
            row[3 + i] = ((3.0 * c3[i] * u + 2.0 * c2[i]) * u + c1[i]) * share - chord
    return True


@jit
def set_tiles(
    tile: IntArray,
    curve: IntArray,
    anchor: IntArray,
    v: FloatArray,
    aft: FloatArray,
    span: FloatArray,
    blend: FloatArray,
    bow: FloatArray,
    point: FloatArray,
    across: FloatArray,
) -> None:
    """Set the cubics of tiles: what lies between the rails, and what the anchors add."""
    for s in range(len(tile)):
        t, w, a = tile[s], v[curve[s]], anchor[s]
        for i in range(4):
            for c in range(3):
                rise = 0.0
                turn = 0.0
                for j in range(4):
                    rise += blend[t, i, j] * bow[a + j, c]
                    turn += blend[t, i, j] * bow[a + j, 3 + c]
                point[s, i, c] = aft[t, i, c] + w * span[t, i, c] + rise
                across[s, i, c] = span[t, i, c] + turn
