"""The net with fewer lines: what its numbers differ by tells how far they may be off.

A line that is left out takes with it the points at which it crossed the others, unless these
are ends, knuckles or tangent points; the lines that stay are lofted again without them.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.net.gather import Net
from assoc_hull.geometry.curves import CurveData, FloatArray, IntArray, PointKind, SplineBatch
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.model.lofting import curve_data
from assoc_hull.model.state import HullState

__all__ = ["every_other_line", "every_other_section", "thinned"]


def every_other_section(net: Net, first: int) -> NDArray[np.bool_]:
    """Choose every other section, (m,), from the second or the first on (`first` 0 or 1).

    Those that stand beside one of another number of pieces stay: there something begins or ends.
    The outermost are left out too when it is their turn, or how much lies between the ends of
    the ship and the next section would not show.
    """
    section = np.isfinite(net.x) & ~net.end
    place, number, pieces = np.unique(net.x[section], return_inverse=True, return_counts=True)
    alike = np.ones(len(place), bool)
    alike[1:] &= pieces[1:] == pieces[:-1]
    alike[:-1] &= pieces[1:] == pieces[:-1]
    alike[(np.arange(len(place)) + first) % 2 == 0] = False
    chosen = np.zeros(net.batch.count, bool)
    chosen[np.flatnonzero(section)] = alike[number]
    return chosen


def every_other_line(net: Net) -> NDArray[np.bool_]:
    """Choose every other line of each family that runs along the ship, (m,)."""
    chosen = np.zeros(net.batch.count, bool)
    for family in ("waterlines", "buttocks", "diagonals"):
        own = [i for i, each in enumerate(net.family) if each == family]
        names = sorted({net.name[i] for i in own}, key=lambda name: _height(net, own, name))
        for i in own:
            chosen[i] = names.index(net.name[i]) % 2 == 0
    return chosen


def _height(net: Net, own: list[int], name: str) -> tuple[float, str]:
    """Give how far up or in a line runs, to bring lines of a family into order.

    Diagonals go by how far up the sections they lie on the average: heights and breadths of
    two that are neighbours may turn round from bottom to side.
    """
    mine = np.array([i for i in own if net.name[i] == name])
    family = net.family[mine[0]]
    rows = np.concatenate([np.arange(net.batch.start[i], net.batch.start[i + 1]) for i in mine])
    if family == "waterlines":
        return float(net.batch.xyz[rows, 2].mean()), name
    if family == "buttocks":
        return -float(net.batch.xyz[rows, 1].mean()), name
    part = [
        net.place[k, 1 - side] / net.length(int(net.meets[k, 1 - side]))
        for side in (0, 1)
        for k in np.flatnonzero(np.isin(net.meets[:, side], mine)).tolist()
        if np.isfinite(net.x[net.meets[k, 1 - side]])
    ]
    return float(np.mean(part)) if part else np.inf, name


def thinned(state: HullState, net: Net, without: NDArray[np.bool_]) -> Net:
    """Give the net without some curves.

    Parameters
    ----------
    state : HullState
        The tables that the net was taken from.
    net : Net
        The net.
    without : (m,) bool
        The curves to leave out.
    """
    data = curve_data(state, net.curve)
    keep = _points(state, net, data, without)
    size = np.add.reduceat(keep, data.start[:-1])
    short = np.repeat(size < 2, np.diff(data.start))
    keep |= short & ~np.repeat(without, np.diff(data.start))
    stay = np.flatnonzero(~without)
    batch = loft(_taken(data, keep, stay))
    number = np.full(net.batch.count, -1)
    number[stay] = np.arange(len(stay))
    good = ~without[net.meets].any(axis=1)
    meets = number[net.meets[good]]
    place = _places(net, keep, batch, net.meets[good], meets, net.place[good])
    return attrs.evolve(
        net,
        batch=batch,
        curve=net.curve[stay],
        name=tuple(net.name[i] for i in stay.tolist()),
        family=tuple(net.family[i] for i in stay.tolist()),
        end=net.end[stay],
        flat=net.flat[stay],
        knuckle=net.knuckle[stay],
        x=net.x[stay],
        centre=net.centre[stay],
        normal=net.normal[stay],
        meets=meets,
        place=place,
        watched=net.watched[good],
        row=net.row[good],
    )


def _points(
    state: HullState, net: Net, data: CurveData, without: NDArray[np.bool_]
) -> NDArray[np.bool_]:
    """Tell which defining points stay."""
    row = np.concatenate([state.curves.rows.data[curve] for curve in net.curve.tolist()])
    own = np.repeat(np.arange(net.batch.count), np.diff(data.start))
    gone = np.zeros(state.curves.count + 1, bool)
    gone[net.curve[without]] = True
    gone[-1] = False
    crossed = gone[state.rows.curve.data[row]].any(axis=1)
    fixed = data.kind != PointKind.SMOOTH
    fixed[data.start[:-1]] = fixed[data.start[1:] - 1] = True
    keep: NDArray[np.bool_] = (fixed | ~crossed) & ~without[own]
    return keep


def _taken(data: CurveData, keep: NDArray[np.bool_], stay: IntArray) -> CurveData:
    size = np.add.reduceat(keep.astype(np.int64), data.start[:-1])[stay]
    start = np.zeros(len(stay) + 1, np.int64)
    np.cumsum(size, out=start[1:])
    return CurveData(
        start,
        data.xyz[keep],
        data.kind[keep],
        data.direction[keep],
        data.end_kind[stay],
        data.end_vector[stay],
    )


def _places(
    net: Net,
    keep: NDArray[np.bool_],
    batch: SplineBatch,
    old: IntArray,
    new: IntArray,
    place: FloatArray,
) -> FloatArray:
    """Carry places on curves over: in proportion between the points that stayed."""
    found = np.empty_like(place)
    start = net.batch.start
    for side in (0, 1):
        for curve in np.unique(old[:, side]).tolist():
            mine = np.flatnonzero(old[:, side] == curve)
            target = int(new[mine[0], side])
            kept = np.flatnonzero(keep[start[curve] : start[curve + 1]]) + start[curve]
            knot = batch.knot[batch.start[target] : batch.start[target + 1]]
            found[mine, side] = np.interp(place[mine, side], net.batch.knot[kept], knot)
    return found
