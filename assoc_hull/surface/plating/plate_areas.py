"""Areas of the plates of a hull, whole and by level of Gaussian curvature.

What several functions bound together follows from areas by sign of their products (Walsh 1923).
All patches that are cut in the same way, for whichever plate, are one batch.
Levels are K0, its halves and its doubles, so it is known how much lies near the limit.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from functools import reduce
from itertools import combinations, product
from typing import Self

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.patches.area_integrals import AreaIntegrator
from assoc_hull.geometry.patches.areas_by_sign import sign_areas
from assoc_hull.geometry.patches.bernstein_polynomials import EPS, BoundedPolynomial
from assoc_hull.geometry.patches.bezier_patches import Patches
from assoc_hull.geometry.patches.cell_subdivision import subdivide_again, subdivide_patches
from assoc_hull.geometry.patches.curvature_functions import IsoFunction, gauss_functions
from assoc_hull.geometry.patches.zero_set_arcs import arcs_of
from assoc_hull.surface.plating.hull_seams import AXES, PlateRange
from assoc_hull.surface.plating.hull_shell import HullShell
from assoc_hull.surface.regions.level_lines import LevelSolution

__all__ = [
    "TOL",
    "CutAreas",
    "LevelTable",
    "SignedAreas",
    "Tally",
    "level_functions",
    "level_table",
    "levels_about",
    "patches_in",
    "signed_area",
    "tallies",
]


_DEPTH = 9
"""How often a patch is halved: what stays undecided at a crossing is 2**-9 of it wide."""

_BUDGET = 4000

TOL = 1e-6
"""Of areas, in parts of that of a patch."""


@attrs.frozen(eq=False)
class SignedAreas:
    """Areas by the sign of a function, of each of k patches.

    Attributes
    ----------
    value : (k,) float, m2
        Where it is positive, less where it is negative.
    off : (k,) float, m2
        What that may be off by: what is not decided, and the error of quadrature.
    """

    value: FloatArray
    off: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.value, self.off)


def signed_area(ground: AreaIntegrator, function: BoundedPolynomial) -> SignedAreas:
    """Give the area where a function is positive, less that where it is negative.

    `function` is a polynomial for each of the k patches of `ground`, (k, M + 1, N + 1), with the
    errors of its coefficients. What the search does not decide, where two lines cross, is no more
    than 2**-9 of a patch wide, and shared out by samples.
    """
    asked = IsoFunction(np.array(function.b), np.array(function.err))
    cells = subdivide_patches(asked, _DEPTH, _BUDGET)
    cells = subdivide_again(asked, cells, _DEPTH, _BUDGET)
    found = sign_areas(ground.patches, cells, arcs_of(cells), TOL, ground)
    off = found.unresolved + found.zero + found.error_estimate
    return SignedAreas(found.positive_estimate - found.negative_estimate, off)


@attrs.frozen(eq=False)
class CutAreas:
    """Areas of the parts of k patches where all of some functions are positive.

    With s_f the sign of f, and S(f) the area where f > 0 less that where f < 0, the area where f, g
    and h are all positive is

        integral of (1 + s_f) (1 + s_g) (1 + s_h) / 8
            = (S(1) + S(f) + S(g) + S(h) + S(f g) + S(f h) + S(g h) + S(f g h)) / 8

    On a Bezier patch a plane x = x0 is the zero set of a polynomial, and K = K0 that of another; so
    each product is a polynomial, whose areas the search of curvature regions finds. Source: the sum
    is Walsh's expansion of a product of signs (Am. J. Math. 45, 1923), with areas for coefficients.

    Attributes
    ----------
    ground : AreaIntegrator
        The patches.
    products : tuple of BoundedPolynomial
        The products of all selections of the functions, but the empty one.
    signed : tuple of SignedAreas
        Their areas by sign.
    """

    ground: AreaIntegrator
    products: tuple[BoundedPolynomial, ...]
    signed: tuple[SignedAreas, ...]

    @classmethod
    def of(cls, ground: AreaIntegrator, functions: tuple[BoundedPolynomial, ...]) -> Self:
        """Find the areas by the sign of all products."""
        products = tuple(
            reduce(BoundedPolynomial.times, chosen)
            for count in range(1, len(functions) + 1)
            for chosen in combinations(functions, count)
        )
        return cls(ground, products, tuple(signed_area(ground, each) for each in products))

    @property
    def inside(self) -> FloatArray:
        """Where all functions are above zero, (k,) m2."""
        whole = self.ground.total + sum(each.value for each in self.signed)
        return np.clip(whole / (len(self.signed) + 1), 0.0, self.ground.total)

    @property
    def off(self) -> FloatArray:
        """What `inside` may be off by, (k,) m2."""
        return np.asarray(sum(each.off for each in self.signed)) / (len(self.signed) + 1)

    def above(self, level: BoundedPolynomial) -> tuple[FloatArray, FloatArray]:
        """Give the part of `inside` where a further function (k, M + 1, N + 1) is positive, too.

        Areas, and what they may be off by, (k,) and (k,), m2.
        """
        inside = self.inside
        least, most = level.b - level.err, level.b + level.err
        value = np.where((least > 0.0).all(axis=(1, 2)), inside, 0.0)
        off = np.array(self.off)
        rows = np.flatnonzero((least <= 0.0).any(axis=(1, 2)) & (most >= 0.0).any(axis=(1, 2)))
        if len(rows):
            ground = AreaIntegrator.of(self.ground.patches[rows], TOL)
            chosen = BoundedPolynomial(level.b[rows], level.err[rows])
            alone = signed_area(ground, chosen)
            parts = [
                signed_area(ground, BoundedPolynomial(each.b[rows], each.err[rows]).times(chosen))
                for each in self.products
            ]
            total, doubt = (
                getattr(alone, name) + sum(getattr(part, name) for part in parts)
                for name in ("value", "off")
            )
            count = 2 * (len(parts) + 1)
            value[rows] = np.clip(0.5 * inside[rows] + total / count, 0.0, inside[rows])
            off[rows] = 0.5 * off[rows] + doubt / count
        return value, off


# --------------------------------------------------------------------------------------
# Areas above levels of Gaussian curvature.


def levels_about(k0: float) -> tuple[float, ...]:
    """Give the levels that a plate is judged by, 1/m2: K0 and -K0, their halves and doubles."""
    return tuple(factor * k0 * sign for factor in (1.0, 0.5, 2.0) for sign in (1.0, -1.0))


def level_functions(patches: Patches, levels: Sequence[float]) -> tuple[BoundedPolynomial, ...]:
    """Give polynomials with the sign of K less each level."""
    found = gauss_functions(patches, levels)
    return tuple(BoundedPolynomial(each.b, each.err) for each in found)


@attrs.frozen(eq=False)
class LevelTable:
    """Areas of k patches above levels.

    Attributes
    ----------
    total : (k,) float, m2
        Of each patch.
    above : mapping of float to (k,) float, m2
        Where K exceeds the level.
    off : mapping of float to (k,) float, m2
        What that may be off by.
    """

    total: FloatArray
    above: Mapping[float, FloatArray]
    off: Mapping[float, FloatArray]

    def __attrs_post_init__(self) -> None:
        freeze(self.total, *self.above.values(), *self.off.values())


def level_table(
    patches: Patches, levels: Sequence[float], solutions: Sequence[LevelSolution] = ()
) -> LevelTable:
    """Find areas of patches above levels, 1/m2; some levels may be solved for already."""
    ground = AreaIntegrator.of(patches, TOL)
    known = {each.level: each for each in solutions}
    above, off = {}, {}
    for level in levels:
        if level in known:
            found = sign_areas(patches, known[level].cells, known[level].arcs, TOL, ground)
            above[level] = found.positive_estimate
            off[level] = found.unresolved + found.error_estimate
    wanted = [level for level in levels if level not in known]
    functions = level_functions(patches, wanted) if wanted else ()
    for level, function in zip(wanted, functions, strict=True):
        signed = signed_area(ground, function)
        above[level] = np.maximum(0.5 * (ground.total + signed.value), 0.0)
        off[level] = np.array(signed.off)
    return LevelTable(np.array(ground.total), above, off)


# --------------------------------------------------------------------------------------
# Areas of plates: whole patches, parts of patches, areas above levels.

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


def patches_in(shell: HullShell, wanted: PlateRange) -> tuple[IntArray, IntArray]:
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
    shell: HullShell, wanted: Sequence[PlateRange], levels: Sequence[float], table: LevelTable
) -> tuple[Tally, ...]:
    """Add up the areas of plates, and those above levels of Gaussian curvature, 1/m2.

    `table` holds the areas of all patches at these levels at least.
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
    sums: _Sums, shell: HullShell, pairs: _Pairs, levels: Sequence[float], table: LevelTable
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
    shell: HullShell,
    pairs: _Pairs,
    functions: tuple[BoundedPolynomial, ...],
    levels: Sequence[float],
    sign: float,
) -> None:
    """Add parts of patches that are cut in the same way, or take them away."""
    cut = CutAreas.of(AreaIntegrator.of(shell.patches[pairs.row], TOL), functions)
    above, off = np.zeros((len(pairs.row), len(levels))), np.array(cut.off)
    own, place = np.unique(pairs.row, return_inverse=True)
    for number, each in enumerate(level_functions(shell.patches[own], levels)):
        above[:, number], doubt = cut.above(BoundedPolynomial(each.b[place], each.err[place]))
        off = np.maximum(off, doubt)
    sums.add(pairs, shell.margin[pairs.row], sign * cut.inside, sign * above, off)


def _bounds(
    shell: HullShell, wanted: Sequence[PlateRange], pairs: _Pairs, kind: int
) -> Iterator[tuple[float, tuple[BoundedPolynomial, ...]]]:
    """Give functions that are above zero in each range, one an axis that cuts these patches.

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


def _shifted(
    place: BoundedPolynomial, rows: IntArray, by: FloatArray, sign: float
) -> BoundedPolynomial:
    """Give sign (f - by) for each pair."""
    b, err, by = place.b[rows], place.err[rows], by[:, None, None]
    return BoundedPolynomial(sign * (b - by), err + 2.0 * EPS * (np.abs(b) + np.abs(by)))
