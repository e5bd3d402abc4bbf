"""What lies in the ranges of plates: whole patches, parts of patches, areas above levels.

All patches that are cut in the same way, for whichever plate, are one batch; what is found for one
of them does not depend on the others.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> from assoc_hull.surface.plates.hull_seams import PlateRange
>>> from assoc_hull.surface.plates.level_table import level_table
>>> from assoc_hull.surface.plates.shell import Shell
>>> from assoc_hull.surface.plates.tally import tallies
>>> x, z = np.mgrid[0:30:4j, 0:3:4j]
>>> shell = Shell.of((SplineSurface.bezier(np.stack([x, 1.0 + 0.0 * x, z], axis=-1), "side"),))
>>> wanted = PlateRange("1", x=(4.0, 10.0))
>>> (found,) = tallies(shell, (wanted,), (), level_table(shell.patches, ()))
>>> round(found.area, 9)
18.0
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import product

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.patches.area_ground import AreaGround
from assoc_hull.geometry.patches.running_bounds import EPS, Running
from assoc_hull.surface.plates.cut_areas import TOL, CutAreas
from assoc_hull.surface.plates.hull_seams import AXES, PlateRange
from assoc_hull.surface.plates.level_table import LevelTable, level_functions
from assoc_hull.surface.plates.shell import Shell

__all__ = ["Tally", "patches_in", "tallies"]

_STRAY = 1e-6
"""m: so far a patch may stand over a seam and count as whole."""

_AT_MOST, _BOTH = 2, 3
"""How an axis cuts a patch: at the upper end of a range only, at both ends."""

_AT_ONCE = 512
"""Patches that are cut in one go: what they need stays below 100 MB."""


@attrs.frozen(eq=False)
class Tally:
    """Areas of a plate, m2.

    Attributes
    ----------
    area : float
        All of it.
    margin : float
        What lies beside borders of blocks: part of no level.
    above : (l,) float
        Where K exceeds each level.
    off : float
        What any of these may be off by.
    """

    area: float
    margin: float
    above: FloatArray
    off: float

    def __attrs_post_init__(self) -> None:
        freeze(self.above)


@attrs.frozen(eq=False)
class _Pairs:
    """Patches with a part in a plate: of each the plate, the patch, and how it is cut.

    The last is the sum of 2**(2 a) for the least and of 2**(2 a + 1) for the greatest of each axis
    a that cuts it, 0 for whole patches.
    """

    plate: IntArray
    row: IntArray
    cut: IntArray

    def chosen(self, rows: IntArray) -> _Pairs:
        """Take some of them."""
        return _Pairs(self.plate[rows], self.row[rows], self.cut[rows])


def patches_in(shell: Shell, wanted: PlateRange) -> tuple[IntArray, IntArray]:
    """Give the patches with a part in a range, (p,), and how each is cut, (p,); 0 for whole."""
    there, cut = np.ones(len(shell.patches), np.bool_), np.zeros(len(shell.patches), np.intp)
    for number, axis in enumerate(AXES):
        low, high = getattr(wanted, axis)
        if np.isinf(low) and np.isinf(high):
            continue
        least, most = shell.extremes[axis]
        there &= (most > low + _STRAY) & (least < high - _STRAY)
        cut += np.where(least < low - _STRAY, 1 << (2 * number), 0)
        cut += np.where(most > high + _STRAY, 2 << (2 * number), 0)
    rows = np.flatnonzero(there)
    return rows, cut[rows]


def tallies(
    shell: Shell, wanted: Sequence[PlateRange], levels: Sequence[float], table: LevelTable
) -> tuple[Tally, ...]:
    """Add up the areas of plates.

    Parameters
    ----------
    shell : Shell
        The hull.
    wanted : sequence of PlateRange
        Which parts of it.
    levels : sequence of float, 1/m2
        Levels of Gaussian curvature.
    table : LevelTable
        The areas of all patches, at these levels at least.
    """
    found = [patches_in(shell, each) for each in wanted]
    plate = np.repeat(np.arange(len(found)), [len(rows) for rows, _ in found])
    pairs = _Pairs(plate, *(np.concatenate(each) for each in zip(*found, strict=True)))
    sums = _Sums(len(wanted), len(levels))
    _add_whole(sums, shell, pairs.chosen(np.flatnonzero(pairs.cut == 0)), levels, table)
    for kind in np.unique(pairs.cut[pairs.cut > 0]).tolist():
        rows = np.flatnonzero(pairs.cut == kind)
        for first in range(0, len(rows), _AT_ONCE):
            some = pairs.chosen(rows[first : first + _AT_ONCE])
            for sign, functions in _bounds(shell, wanted, some, kind):
                _add_parts(sums, shell, some, functions, levels, sign)
    return tuple(
        Tally(float(sums.area[i]), float(sums.margin[i]), sums.above[i].copy(), float(sums.off[i]))
        for i in range(len(wanted))
    )


class _Sums:
    """Areas by plate, being added up."""

    def __init__(self, plates: int, levels: int) -> None:
        self.area, self.margin, self.off = np.zeros((3, plates))
        self.above = np.zeros((plates, levels))

    def add(
        self, pairs: _Pairs, margin: np.typing.NDArray[np.bool_], area: FloatArray,
        above: FloatArray, off: FloatArray,
    ) -> None:  # fmt: skip
        """Add what pairs (p,) have: area (p,), areas above levels (p, l), and errors (p,)."""
        np.add.at(self.area, pairs.plate, area)
        np.add.at(self.margin, pairs.plate, np.where(margin, area, 0.0))
        np.add.at(self.above, pairs.plate, np.where(margin[:, None], 0.0, above))
        np.add.at(self.off, pairs.plate, off)


def _add_whole(
    sums: _Sums, shell: Shell, pairs: _Pairs, levels: Sequence[float], table: LevelTable
) -> None:
    """Add whole patches."""
    row = pairs.row
    above, off = np.zeros((len(row), len(levels))), np.zeros(len(row))
    for number, level in enumerate(levels):
        above[:, number] = table.above[level][row]
        off = np.maximum(off, table.off[level][row])
    sums.add(pairs, shell.margin[row], table.total[row], above, off)


def _add_parts(
    sums: _Sums,
    shell: Shell,
    pairs: _Pairs,
    functions: tuple[Running, ...],
    levels: Sequence[float],
    sign: float,
) -> None:
    """Add parts of patches that are cut in the same way, or take them away."""
    cut = CutAreas.of(AreaGround.of(shell.patches[pairs.row], TOL), functions)
    above, off = np.zeros((len(pairs.row), len(levels))), np.array(cut.off)
    own, place = np.unique(pairs.row, return_inverse=True)
    for number, each in enumerate(level_functions(shell.patches[own], levels)):
        above[:, number], doubt = cut.above(Running(each.b[place], each.err[place]))
        off = np.maximum(off, doubt)
    sums.add(pairs, shell.margin[pairs.row], sign * cut.inside, sign * above, off)


def _bounds(
    shell: Shell, wanted: Sequence[PlateRange], pairs: _Pairs, kind: int
) -> Iterator[tuple[float, tuple[Running, ...]]]:
    """Give functions that are above nil in each range, one an axis that cuts these patches.

    Where both ends of a range cut a patch, it is what lies above the lower end less what lies above
    the upper one: so a narrow range is as exact as a wide one. 1 and -1 tell which.
    """
    choices = []
    for number, axis in enumerate(AXES):
        low, high = np.array([getattr(each, axis) for each in wanted])[pairs.plate].T
        cut = kind >> (2 * number) & 3
        if cut == _AT_MOST:
            choices.append([(1.0, _shifted(shell.places[axis], pairs.row, high, -1.0))])
        elif cut:
            ends = ((1.0, low), (-1.0, high)) if cut == _BOTH else ((1.0, low),)
            choices.append(
                [(sign, _shifted(shell.places[axis], pairs.row, end, 1.0)) for sign, end in ends]
            )
    for chosen in product(*choices):
        yield math.prod(sign for sign, _ in chosen), tuple(function for _, function in chosen)


def _shifted(place: Running, rows: IntArray, by: FloatArray, sign: float) -> Running:
    """Give sign (f - by) for each pair."""
    b, err, by = place.b[rows], place.err[rows], by[:, None, None]
    return Running(sign * (b - by), err + 2.0 * EPS * (np.abs(b) + np.abs(by)))
