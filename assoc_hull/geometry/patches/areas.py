"""Areas of surface where a polynomial is positive, negative, nil, and where this is not known.

Cells of one sign are integrated whole; cells with an arc are parted along it (`arc_areas`). All
errors are estimates of the rules themselves, none is a guess from a grid.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.arcs import arcs_of
>>> from assoc_hull.geometry.patches.areas import areas
>>> from assoc_hull.geometry.patches.curvature_functions import gauss_function
>>> from assoc_hull.geometry.patches.patches import Patches
>>> from assoc_hull.geometry.patches.solve import solve
>>> net = np.zeros((2, 2, 3))
>>> net[1, :, 0] = net[:, 1, 1] = net[1, 1, 2] = 1.0
>>> patches = Patches.single(net)
>>> cells = solve(gauss_function(patches, 0.0))
>>> found = areas(patches, cells, arcs_of(cells), 1e-9)
>>> found.negative.round(6), found.total.round(6)
(array([1.280789]), array([1.280789]))
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.patches.arc_areas import below
from assoc_hull.geometry.patches.arc_curves import ArcCurves, arc_curves
from assoc_hull.geometry.patches.area_ground import AreaGround
from assoc_hull.geometry.patches.cells import Arcs, CellKind, Cells
from assoc_hull.geometry.patches.patches import Patches
from assoc_hull.geometry.patches.undecided import sampled_signs

__all__ = ["Areas", "areas"]

# What rounding may leave of the area of a patch.
_ROUNDING = 4e-15
# Arcs at a time: their polynomials take room.
_BLOCK = 2048


@attrs.frozen(eq=False)
class Areas:
    """Areas of each patch of a batch.

    Attributes
    ----------
    positive, negative, zero : (k,) float, m2
        Where the polynomial has this sign, or is nil to its error; cells without a decision in
        none of them.
    unresolved : (k,) float, m2
        The area of the cells without a decision. What is positive lies between `positive` and
        `positive` + `unresolved`, but for `error_estimate`; and so on.
    positive_estimate, negative_estimate : (k,) float, m2
        The same areas with what samples in the cells without a decision add.
    error_estimate : (k,) float, m2
        What these two, and `total`, may be off by: the differences of the rules, the samples with a
        neighbour of the other sign, and by how much all parts do not make up the total.
    total : (k,) float, m2
        The area of each patch, by a rule of its own.
    """

    positive: FloatArray
    negative: FloatArray
    zero: FloatArray
    unresolved: FloatArray
    positive_estimate: FloatArray
    negative_estimate: FloatArray
    error_estimate: FloatArray
    total: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(*(getattr(self, field.name) for field in attrs.fields(type(self))))

    def __len__(self) -> int:
        """Count the patches."""
        return len(self.total)


def areas(
    patches: Patches,
    cells: Cells,
    arcs: Arcs,
    area_tol: float = 1e-6,
    ground: AreaGround | None = None,
) -> Areas:
    """Find the areas of the regions of each sign.

    Parameters
    ----------
    patches : Patches
        The patches, k of them.
    cells : Cells
        Their cells, for one polynomial.
    arcs : Arcs
        The arcs in these cells, at most one in each.
    area_tol : float
        How large the estimate of the error may be, in parts of the area of a patch.
    ground : AreaGround, optional
        What areas are taken from, if it was made before: ``AreaGround.of(patches, area_tol)``. It
        serves any polynomial on the same patches.

    Returns
    -------
    Areas
        For each patch; what is found for one does not depend on the others, to the last bit.
    """
    count = len(patches)
    ground = AreaGround.of(patches, area_tol) if ground is None else ground
    allowed = area_tol * ground.scale
    number = np.bincount(cells.patch, minlength=count)
    cell_tol = (0.25 * allowed / np.maximum(number, 1))[cells.patch]
    whole, off = ground.over(cells.patch, cells.box, cell_tol)
    whole = np.maximum(whole, 0.0)
    low, low_off = _low_parts(ground, cells, arcs, allowed, whole)
    low = np.clip(low, 0.0, whole[arcs.cell])
    sign = _signs(cells)
    parted = np.zeros(len(cells), np.bool_)
    parted[arcs.cell] = True
    positive = np.where(sign == 1, whole, 0.0)
    positive[arcs.cell] = np.where(arcs.rising, whole[arcs.cell] - low, low)
    negative = np.where((sign < 0) | parted, whole - positive, 0.0)
    unknown = np.nonzero(cells.kind == CellKind.UNRESOLVED)[0]
    above, under, doubt = (part * whole[unknown] for part in sampled_signs(cells, unknown))
    off[arcs.cell] += low_off
    off[unknown] += doubt

    def summed(values: FloatArray, rows: IntArray | slice = slice(None)) -> FloatArray:
        return np.asarray(np.bincount(cells.patch[rows], values, count), np.float64)

    found = summed(positive), summed(negative), summed(np.where(sign == 0, whole, 0.0))
    rest = summed(whole[unknown], unknown)
    error = summed(off) + ground.error + _ROUNDING * ground.total
    error += np.abs(found[0] + found[1] + found[2] + rest - ground.total)
    return Areas(
        *found, rest, found[0] + summed(above, unknown), found[1] + summed(under, unknown),
        error, ground.total.copy(),
    )  # fmt: skip


def _signs(cells: Cells) -> IntArray:
    """Give the sign of each cell, 2 where there is none; a simple cell without arc has one."""
    sign = np.where(cells.kind == CellKind.UNRESOLVED, 2, cells.kind)
    simple = np.nonzero((cells.kind == CellKind.U_SIMPLE) | (cells.kind == CellKind.V_SIMPLE))[0]
    mean = cells.b[cells.row[simple]].sum(axis=(1, 2))
    sign[simple] = np.where(mean > 0.0, 1, -1)
    return sign


def _low_parts(
    ground: AreaGround, cells: Cells, arcs: Arcs, allowed: FloatArray, whole: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Give the area of the part of smaller u (or v) of each cell with an arc, and its error."""
    patch = cells.patch[arcs.cell]
    number = np.bincount(patch, minlength=len(allowed))
    share = whole[arcs.cell] / ground.scale[patch] + 1.0 / number[patch]
    tolerance = np.maximum(0.3 * allowed, 1e-15 * ground.scale)[patch] * share
    value, error = np.zeros((2, len(arcs)))
    for first in range(0, len(arcs), _BLOCK):
        chosen = np.arange(first, min(first + _BLOCK, len(arcs)))
        for curves, rows in arc_curves(cells, arcs, chosen):
            value[rows], error[rows] = _low(ground, curves, tolerance[rows])
    return value, error


def _low(
    ground: AreaGround, curves: ArcCurves, tolerance: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Add what lies below the arcs, and beyond their ends where they leave a cell sideways."""
    value, error = below(ground, curves, tolerance)
    beyond = np.empty((2, len(value), 2, 2))
    beyond[:, :, 0, 0] = curves.box[:, 0, 0]
    beyond[:, :, 0, 1] = curves.ends.T
    beyond[0, :, 1], beyond[1, :, 1] = curves.box[:, 1], curves.box[:, 1]
    beyond[0, :, 1, 1], beyond[1, :, 1, 0] = curves.span.T
    beyond = np.where((curves.flip == 1)[:, None, None], beyond[:, :, ::-1], beyond)
    side, row = np.nonzero((beyond[..., 1] > beyond[..., 0]).all(axis=2))
    part, off = ground.over(curves.patch[row], beyond[side, row], 0.25 * tolerance[row])
    value += np.bincount(row, part, len(value))
    error += np.bincount(row, off, len(value))
    return value, error
