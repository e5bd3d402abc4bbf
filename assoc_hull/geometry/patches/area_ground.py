"""Areas under patches, by series where there is one, point by point elsewhere.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.area_ground import AreaGround
>>> from assoc_hull.geometry.patches.patches import Patches
>>> net = np.zeros((2, 2, 3))
>>> net[1, :, 0], net[:, 1, 1] = 2.0, 3.0
>>> AreaGround.of(Patches.single(net), 1e-6).total.round(12)
array([6.])
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.numeric.quadrature import gauss
from assoc_hull.geometry.patches.area_direct import along_lines, over_boxes
from assoc_hull.geometry.patches.area_elements import added, on_grid, swapped, taken
from assoc_hull.geometry.patches.area_series import AreaSeries, area_series
from assoc_hull.geometry.patches.patches import Patches

__all__ = ["AreaGround"]

_ROUGH = 8
# Patches without a series are cut into so many parts in each parameter before all else: a rule
# judges well what is nearly smooth only.
_PARTS = 4
# What of the tolerance the series may take, and its least: what rounding leaves of an area.
_SHARE, _LEAST = 0.25, 2e-14


@attrs.frozen(eq=False)
class AreaGround:
    """What areas under patches are taken from.

    Attributes
    ----------
    patches : Patches
        The patches, k of them.
    series : tuple of AreaSeries
        Series, by their length.
    kind : (k,) int
        Which of these each patch has; -1 for none.
    row : (k,) int
        Its row there.
    scale : (k,) float, m2
        The area of each patch, roughly.
    total : (k,) float, m2
        The area of each patch by a rule of its own, not from the series.
    error : (k,) float, m2
        What any area under a patch may be off by.
    """

    patches: Patches
    series: tuple[AreaSeries, ...]
    kind: IntArray
    row: IntArray
    scale: FloatArray
    total: FloatArray
    error: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.kind, self.row, self.scale, self.total, self.error)

    @classmethod
    def of(cls, patches: Patches, area_tol: float, by_series: bool = True) -> Self:
        """Prepare.

        Parameters
        ----------
        patches : Patches
            The patches.
        area_tol : float
            What an area may be off by, in parts of that of its patch.
        by_series : bool
            Whether to use series at all.

        Returns
        -------
        AreaGround
            The ground.
        """
        count = len(patches)
        scale = _totals(patches, _ROUGH)
        allowed = max(_SHARE * area_tol, _LEAST) * scale
        found = area_series(patches, allowed) if by_series else ()
        kind, row = np.full(count, -1), np.zeros(count, np.intp)
        total, error = np.zeros((2, count))
        for index, series in enumerate(found):
            kind[series.patch], row[series.patch] = index, np.arange(len(series.patch))
            total[series.patch] = _totals(taken(patches, series.patch), series.count)
            error[series.patch] = series.error
        rest = np.flatnonzero(kind < 0)
        if len(rest):
            total[rest], error[rest] = _direct_totals(patches, rest, allowed[rest])
        return cls(patches, found, kind, row, scale, total, error)

    def over(
        self, patch: IntArray, box: FloatArray, tolerance: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Integrate over boxes.

        Parameters
        ----------
        patch : (c,) int
            The patch of each.
        box : (c, 2, 2)
            ``[[u0, u1], [v0, v1]]``, in parameters of the patch.
        tolerance : (c,) float, m2
            What the area may be off by, where there is no series.

        Returns
        -------
        (c,), (c,) float, m2
            Areas, and what they may be off by beyond the `error` of the patch.
        """
        value, error = np.zeros((2, len(patch)))
        kind = self.kind[patch]
        for index, series in enumerate(self.series):
            rows = np.flatnonzero(kind == index)
            if len(rows):
                value[rows] = series.over(self.row[patch[rows]], box[rows])
        rows = np.flatnonzero(kind < 0)
        if len(rows):
            value[rows], error[rows] = over_boxes(
                self.patches, patch[rows], box[rows], tolerance[rows]
            )
        return value, error

    def between(
        self, patch: IntArray, flip: IntArray, start: FloatArray, u: FloatArray, v: FloatArray,
        tolerance: FloatArray,
    ) -> tuple[FloatArray, FloatArray]:  # fmt: skip
        """Integrate along lines v = constant.

        Parameters
        ----------
        patch : (c,) int
            The patch of each row.
        flip : (c,) int
            1 where u and v are exchanged, else 0.
        start : (c,)
            Where its lines begin.
        u, v : (c, q)
            Where they end.
        tolerance : (c,) float, m2
            What an integral may be off by, per unit of v, where there is no series.

        Returns
        -------
        (c, q), (c, q) float, m2
            Integrals per unit of v, and what they may be off by.
        """
        value, error = np.zeros((2, *u.shape))
        kind = self.kind[patch]
        for index, series in enumerate(self.series):
            rows = np.flatnonzero(kind == index)
            if len(rows):
                value[rows] = series.between(
                    self.row[patch[rows]], flip[rows], start[rows], u[rows], v[rows]
                )
        for way in (0, 1):
            rows = np.flatnonzero((kind < 0) & (flip == way))
            if len(rows):
                patches = swapped(self.patches) if way else self.patches
                value[rows], error[rows] = _directly(
                    patches, patch[rows], start[rows], u[rows], v[rows], tolerance[rows]
                )
        return value, error


def _directly(
    patches: Patches, patch: IntArray, start: FloatArray, u: FloatArray, v: FloatArray,
    tolerance: FloatArray,
) -> tuple[FloatArray, ...]:  # fmt: skip
    count = u.shape[1]
    each = np.arange(len(u)).repeat(count)
    span = np.stack([start[each], u.reshape(-1)], axis=1)
    found = along_lines(patches, patch[each], span, v.reshape(-1), tolerance[each])
    return tuple(part.reshape(-1, count) for part in found)


def _direct_totals(
    patches: Patches, rows: IntArray, tolerance: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Give the areas of patches that have no series, and their errors, from parts of each."""
    count = len(rows)
    each = np.arange(count).repeat(_PARTS**2)
    lines = np.arange(_PARTS + 1) / _PARTS
    spans = np.stack([lines[:-1], lines[1:]], axis=1)
    box = np.empty((count, _PARTS, _PARTS, 2, 2))
    box[..., 0, :], box[..., 1, :] = spans[:, None], spans
    found = over_boxes(patches, rows[each], box.reshape(-1, 2, 2), (tolerance / _PARTS**2)[each])
    value, error = (np.bincount(each, part, count).astype(np.float64) for part in found)
    return value, error


def _totals(patches: Patches, count: int) -> FloatArray:
    """Give the areas of patches by Gauss's rule of so many points in each parameter."""
    nodes, weights = gauss(count)
    values = on_grid(patches, nodes, nodes) * weights * weights[:, None]
    return added(values.reshape(len(patches), -1).T.copy())
