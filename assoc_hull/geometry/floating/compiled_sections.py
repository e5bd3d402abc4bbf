"""Areas of curves as they are drawn, below floating planes, by compiled code.

Importing this module imports numba. It is what `sections_and_moments_below` gives but for rounding.

Examples
--------
>>> from assoc_hull.geometry.floating.compiled_sections import SectionRows
>>> callable(SectionRows.of)
True
"""

from __future__ import annotations

from collections.abc import Callable

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.floating.compiled_immersion import SurfaceRows, integrate_each, read_only
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.geometry.numeric.jit import jit, was_loaded

__all__ = ["SectionRows", "set_sections", "warm"]

Flags = NDArray[np.bool_]


@jit
def set_sections(
    curves: IntArray, start: IntArray, knot: FloatArray, xyz: FloatArray, leave: FloatArray,
    arrive: FloatArray, closed: bool, on_centre: float, tile_start: IntArray, edge: IntArray,
    deck: Flags, rows: FloatArray,
) -> None:  # fmt: skip
    """Set curves as tiles from keel to deck, with a deck where they end off the centre plane.

    Curves (k,) of splines (3, n); `rows` (12, t) get the coefficients of x, of y, of z.
    """
    t = curves[0] - curves[0]
    for i in range(len(curves)):
        first, last = start[curves[i]], start[curves[i] + 1] - 1
        tile_start[i], edge[i] = t, -1
        swept = 0.0
        for f in range(first, last):
            swept += (xyz[1, f] + xyz[1, f + 1]) * (xyz[2, f + 1] - xyz[2, f])
        for number in range(last - first):
            f = first + number if swept >= 0.0 else last - 1 - number
            size = knot[f + 1] - knot[f]
            for c in range(3):
                chord = xyz[c, f + 1] - xyz[c, f]
                c0, c1, end = xyz[c, f], leave[c, f] * size, arrive[c, f + 1] * size
                c2 = 3.0 * (chord - c1) + (c1 - end)
                c3 = (c1 - chord) + (end - chord)
                if swept < 0.0:
                    c0, c1, c2, c3 = (
                        c0 + c1 + c2 + c3, -(c1 + 2.0 * c2 + 3.0 * c3), c2 + 3.0 * c3, -c3
                    )  # fmt: skip
                rows[4 * c, t], rows[4 * c + 1, t] = c0, c1
                rows[4 * c + 2, t], rows[4 * c + 3, t] = c2, c3
            deck[t] = False
            t += 1
        y = rows[4, t - 1] + rows[5, t - 1] + rows[6, t - 1] + rows[7, t - 1]
        if closed and abs(y) > on_centre:
            for c in range(3):
                row = rows[4 * c : 4 * c + 4]
                row[0, t] = row[0, t - 1] + row[1, t - 1] + row[2, t - 1] + row[3, t - 1]
                row[1:, t] = 0.0
            rows[5, t] = -rows[4, t]
            deck[t], edge[i] = True, t - tile_start[i]
            t += 1
    tile_start[len(curves)] = t


_set_sections: Callable[..., None] = set_sections
"""It is called with arrays of splines, in the order above."""


@attrs.frozen(eq=False)
class SectionRows:
    """Curves as compiled code takes them: strips of one curve each."""

    rows: SurfaceRows

    @classmethod
    def of(
        cls, batch: SplineBatch, curves: IntArray, upright: Flags, closed: bool, on_centre: float
    ) -> SectionRows:
        """Take curves (k,) of a batch; `upright` (k,): x is the same all along.

        With a `closed` deck those that end farther from the centre plane than `on_centre` (m) have
        one.
        """
        count = len(curves)
        size = int((batch.start[curves + 1] - batch.start[curves]).sum())
        tile_start, edge = np.empty(count + 1, np.int64), np.empty(count, np.int64)
        deck, rows = np.empty(size, np.bool_), np.empty((12, size))
        vectors = (read_only(each.T) for each in (batch.xyz, batch.leave, batch.arrive))
        _set_sections(
            read_only(curves), read_only(batch.start), read_only(batch.knot), *vectors, closed,
            on_centre, tile_start, edge, deck, rows,
        )  # fmt: skip
        span, none = np.zeros((12, size)), np.zeros(count + 1, np.int64)
        span[0] = 1.0
        arrays = (
            none, none, tile_start, np.zeros(size, np.int64), upright, deck, edge, none,
            np.zeros((1, 4, 3)), np.zeros(1), np.zeros(1), rows, span, np.zeros((16, size)),
        )  # fmt: skip
        rules = np.arange(count + 1), np.zeros(count), np.ones(count), np.arange(count)
        return cls(SurfaceRows(tuple(map(read_only, arrays)), tuple(map(read_only, rules))))

    def below(self, planes: FloatingPlanes) -> tuple[FloatArray, FloatArray]:
        """Give areas (d, k), m2, and moments about the base line (d, k), m3, of both sides."""
        columns = integrate_each(self.rows, planes)
        area, moment = columns[:, 0].copy(), columns[:, 3].copy()
        freeze(area, moment)
        return area, moment


def warm() -> bool:
    """Compile all, or load what was compiled; tell whether it was loaded."""
    one = np.zeros((2, 3))
    one[1] = 0.0, 1.0, 1.0
    line = SplineBatch(np.array([0, 2]), np.array([0.0, 1.0]), one, one.copy(), one.copy())
    rows = SectionRows.of(line, np.zeros(1, np.int64), np.ones(1, np.bool_), True, 1e-4)
    rows.below(FloatingPlanes(np.ones(1), np.zeros(1), np.zeros(1)))
    return was_loaded(set_sections)
