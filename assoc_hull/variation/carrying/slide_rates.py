"""Points that a map moves are kept in the planes of their lines, to first order.

A station stays plane where the map bends it, a buttock stays a buttock. A point in which two lines
cross then slides over the hull: along the line that the map carries exactly, or, where it carries
neither, by the shortest way within the tangent plane.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.edit.hull_normals import curve_tangents, hull_normals
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.splines.evaluation import curvature
from assoc_hull.model.tables import HullState

__all__ = ["SlideSurface", "curve_bending"]

_STEEP = 0.02
"""A line as level as this to a plane (sine of the angle) is no way into it."""

_FLAT = 1e-3
"""Planes and tangent plane that turn no more than this from one another leave no way."""

_KEPT = 1e-9
"""A point leaves its plane by no more than this part of the largest movement."""


def curve_bending(state: HullState) -> FloatArray:
    """Give the larger curvature of the curves through every point, (rows,), 1/m."""
    found, curves = np.zeros(state.rows.count), state.live("curves").tolist()
    batch = SplineBatch.join([state.spline(curve) for curve in curves])
    bend = np.sqrt((curvature(batch) ** 2).sum(axis=1))
    rows = np.concatenate([state.curves.rows[curve] for curve in curves])
    np.maximum.at(found, rows, np.nan_to_num(bend))
    return found


@attrs.frozen(eq=False)
class SlideSurface:
    """What points of a hull slide over.

    Attributes
    ----------
    line : (r, 2) int
        Lines of both sides of every point, -1 where there is none.
    held : (r, 2) bool
        Whether a side's line lies in a plane.
    plane : (r, 2, 3)
        Normals of these planes; nil where there are none.
    tangent : (r, 2, 3)
        Unit tangents of the curves.
    drives : (r, 2) bool
        Whether a side's line is carried exactly.
    normal : (r, 3)
        Unit normals of the hull.
    """

    line: IntArray
    held: NDArray[np.bool_]
    plane: FloatArray
    tangent: FloatArray
    drives: NDArray[np.bool_]
    normal: FloatArray

    @classmethod
    def of(cls, state: HullState, lines: IntArray) -> SlideSurface:
        """Take it from the tables of a hull; `lines` (d,) are carried exactly."""
        curve = state.rows.curve.data
        line = np.where(curve >= 0, state.curves.line[curve], -1)
        held = (line >= 0) & state.lines.planar[line]
        plane = np.where(held[..., None], state.lines.normal[line], 0.0)
        drives = (line >= 0) & np.isin(line, lines)
        return cls(line, held, plane, curve_tangents(state), drives, np.array(hull_normals(state)))

    def kept(self, move: FloatArray, level: FloatArray) -> FloatArray:
        """Give displacements that keep points in the planes of their lines.

        Parameters
        ----------
        move : (r, 3), m
            Where a map moves the points.
        level : (l,), m
            How far the planes of lines move along their normals.

        Returns
        -------
        (r, 3), m
        """
        rate = np.where(self.held, level[self.line], 0.0)
        off = np.where(self.held, rate - (self.plane * move[:, None]).sum(axis=2), 0.0)
        least = _KEPT * (1.0 + float(np.abs(move).max(initial=0.0)))
        left = np.abs(off) > least
        found = move.copy()
        for side in (0, 1):
            done = self._along(found, off, left, side)
            left[done] = False
        rest = np.flatnonzero(left.any(axis=1))
        found[rest] += self._shortest(rest, np.where(left, off, 0.0)[rest])
        return self._exactly(found, rate)

    def _along(
        self, found: FloatArray, off: FloatArray, left: NDArray[np.bool_], side: int
    ) -> NDArray[np.bool_]:
        """Slide along the curves of one side, which are carried, into the planes of the other."""
        along, other = self.tangent[:, side], 1 - side
        steep = (along * self.plane[:, other]).sum(axis=1)
        slides = self.drives[:, side] & ~left[:, side] & left[:, other] & (np.abs(steep) > _STEEP)
        found[slides] += along[slides] * (off[slides, other] / steep[slides])[:, None]
        return np.asarray(slides)

    def _shortest(self, rows: IntArray, off: FloatArray) -> FloatArray:
        """Give the shortest ways within tangent planes into the planes of the lines, (n, 3)."""
        demands = np.concatenate([self.normal[rows, None], self.plane[rows]], axis=1)
        amount = np.concatenate([np.zeros((len(rows), 1)), off], axis=1)
        return np.asarray(np.einsum("nij,nj->ni", np.linalg.pinv(demands, rcond=_FLAT), amount))

    def _exactly(self, found: FloatArray, rate: FloatArray) -> FloatArray:
        """Let points go with planes across an axis to the bit."""
        for side in (0, 1):
            for axis in range(3):
                exact = np.abs(self.plane[:, side, axis]) == 1.0
                found[exact, axis] = rate[exact, side] * self.plane[exact, side, axis]
        return found
