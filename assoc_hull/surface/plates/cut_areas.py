r"""Areas of what several functions bound together, from the areas by sign of their products.

With s_f the sign of f, and S(f) the area where f > 0 less that where f < 0, the area where f, g
and h are all above nil is

    integral of (1 + s_f) (1 + s_g) (1 + s_h) / 8
        = (S(1) + S(f) + S(g) + S(h) + S(f g) + S(f h) + S(g h) + S(f g h)) / 8

On a Bezier patch a plane x = x0 is the zero set of a polynomial, and K = K0 that of another; so
each product is a polynomial, of which the search of curvature regions finds the areas. What it does
not decide, where two lines cross, is no more than 2**-9 of a patch wide, and shared out by samples.

Source: the sum is Walsh's expansion of a product of signs (Am. J. Math. 45, 1923), with areas for
its coefficients.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.area_ground import AreaGround
>>> from assoc_hull.geometry.patches.patches import Patches
>>> from assoc_hull.geometry.patches.running_bounds import Running
>>> from assoc_hull.surface.plates.cut_areas import CutAreas
>>> net = np.zeros((2, 2, 3))
>>> net[1, :, 0], net[:, 1, 1] = 2.0, 3.0
>>> ground = AreaGround.of(Patches.single(net), 1e-6)
>>> off = np.full((1, 2, 2), 1e-15)
>>> right = Running(net[None, ..., 0] - 0.5, off)  # x > 0.5
>>> above = Running(net[None, ..., 1] - 1.0, off)  # y > 1
>>> CutAreas.of(ground, (right, above)).inside.round(9)
array([3.])
"""

from __future__ import annotations

from functools import reduce
from itertools import combinations
from typing import Self

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.patches.arcs import arcs_of
from assoc_hull.geometry.patches.area_ground import AreaGround
from assoc_hull.geometry.patches.areas import areas
from assoc_hull.geometry.patches.curvature_functions import IsoFunction
from assoc_hull.geometry.patches.refining import refined
from assoc_hull.geometry.patches.running_bounds import Running
from assoc_hull.geometry.patches.solve import solve

__all__ = ["TOL", "CutAreas", "Signed", "signed_area"]

_DEPTH = 9
"""How often a patch is halved: what stays undecided at a crossing is 2**-9 of it wide."""

_BUDGET = 4000

TOL = 1e-6
"""Of areas, in parts of that of a patch."""


@attrs.frozen(eq=False)
class Signed:
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


def signed_area(ground: AreaGround, function: Running) -> Signed:
    """Give the area where a function is positive, less that where it is negative.

    Parameters
    ----------
    ground : AreaGround
        The k patches.
    function : Running
        A polynomial a patch, (k, M + 1, N + 1), with the errors of its coefficients.
    """
    asked = IsoFunction(np.array(function.b), np.array(function.err))
    cells = solve(asked, _DEPTH, _BUDGET)
    cells = refined(asked, cells, _DEPTH, _BUDGET)
    found = areas(ground.patches, cells, arcs_of(cells), TOL, ground)
    off = found.unresolved + found.zero + found.error_estimate
    return Signed(found.positive_estimate - found.negative_estimate, off)


@attrs.frozen(eq=False)
class CutAreas:
    """Areas of the parts of k patches where all of some functions are above nil.

    Attributes
    ----------
    ground : AreaGround
        The patches.
    products : tuple of Running
        The products of all selections of the functions, but the empty one.
    signed : tuple of Signed
        Their areas by sign.
    """

    ground: AreaGround
    products: tuple[Running, ...]
    signed: tuple[Signed, ...]

    @classmethod
    def of(cls, ground: AreaGround, functions: tuple[Running, ...]) -> Self:
        """Find the areas by the sign of all products."""
        products = tuple(
            reduce(Running.times, chosen)
            for count in range(1, len(functions) + 1)
            for chosen in combinations(functions, count)
        )
        return cls(ground, products, tuple(signed_area(ground, each) for each in products))

    @property
    def inside(self) -> FloatArray:
        """Where all functions are above nil, (k,) m2."""
        whole = self.ground.total + sum(each.value for each in self.signed)
        return np.clip(whole / (len(self.signed) + 1), 0.0, self.ground.total)

    @property
    def off(self) -> FloatArray:
        """What `inside` may be off by, (k,) m2."""
        return np.asarray(sum(each.off for each in self.signed)) / (len(self.signed) + 1)

    def above(self, level: Running) -> tuple[FloatArray, FloatArray]:
        """Give the part of `inside` where a further function is above nil, too.

        Parameters
        ----------
        level : Running
            The function, (k, M + 1, N + 1).

        Returns
        -------
        (k,), (k,) float, m2
            Areas, and what they may be off by.
        """
        inside = self.inside
        least, most = level.b - level.err, level.b + level.err
        value = np.where((least > 0.0).all(axis=(1, 2)), inside, 0.0)
        off = np.array(self.off)
        rows = np.flatnonzero((least <= 0.0).any(axis=(1, 2)) & (most >= 0.0).any(axis=(1, 2)))
        if len(rows):
            ground = AreaGround.of(self.ground.patches[rows], TOL)
            chosen = Running(level.b[rows], level.err[rows])
            alone = signed_area(ground, chosen)
            parts = [
                signed_area(ground, Running(each.b[rows], each.err[rows]).times(chosen))
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
