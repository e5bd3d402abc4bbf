"""Regions of a half hull: boundary curves in the side plan, and a formula between each two.

Boundary curves (flat of side, beginning of the conic, stem ...) are drawn in the side plan as x
over z, straight from point to point. On a waterline z they are evaluated and put in order; the
formula of the region between neighbours makes the piece there. Where two boundaries coincide, the
region between them has no length and its piece is dropped.

Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK, the combined method.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import combinations, pairwise, product
from typing import Self, get_args

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import mapped, number, numbers
from assoc_hull.geometry.classical.checks import figure
from assoc_hull.geometry.classical.choices import one_of
from assoc_hull.geometry.classical.pieces import Formula
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["Region", "Regions"]

_COINCIDE = 1e-9
"""Boundaries nearer than this, in parts of the extent of all, are one."""


@attrs.frozen
class Region:
    """What lies between two boundary curves on one waterline.

    Attributes
    ----------
    after, before : str
        The boundary where it begins, and the one where it ends.
    formula : str
        Of its piece.
    first, last : float, m
        The range in x.
    """

    after: str
    before: str
    formula: Formula
    first: float
    last: float


@attrs.frozen(eq=False)
class Regions:
    """Boundary curves and the formulas between them.

    Attributes
    ----------
    boundaries : mapping of str to (n, 2), m
        z and x of the points of each boundary, z rising.
    formulas : mapping of (str, str) to str
        "line", "quintic", "conic", "cubic conic" or "circle" between neighbours.
    """

    boundaries: Mapping[str, FloatArray]
    formulas: Mapping[tuple[str, str], Formula]

    def __attrs_post_init__(self) -> None:
        freeze(*self.boundaries.values())

    @classmethod
    def make(
        cls,
        boundaries: Mapping[str, ArrayLike],
        formulas: Mapping[tuple[str, str], Formula],
    ) -> Self:
        """Check boundaries and formulas; arguments as the attributes.

        Raises
        ------
        GeometryError
            ``"regions: boundaries {a} and {b} cross at z={z}"``; fewer than two boundaries,
            points whose z does not rise, a formula that is none or of boundaries that are not
            there.

        Examples
        --------
        >>> from assoc_hull.geometry.classical.regions import Regions
        >>> flat, end = [(0, 30), (5, 42), (10, 50)], [(0, 70), (5, 73), (10, 78)]
        >>> regions = Regions.make({"flat": flat, "end": end}, {("flat", "end"): "quintic"})
        >>> {name: round(x, 6) for name, x in regions.places(6.5).items()}
        {'flat': 44.4, 'end': 74.5}
        """
        mapped(boundaries, "regions: boundaries")
        mapped(formulas, "regions: formulas")
        lines = {str(name): _polyline(str(name), given) for name, given in boundaries.items()}
        if len(lines) < 2:
            raise GeometryError(f"regions: {len(lines)} boundaries", "give two or more")
        for pair, formula in formulas.items():
            one_of(formula, tuple(get_args(Formula)), "regions: no formula is called")
            if pair not in product(lines, lines):
                what = f"regions: no two boundaries are called {pair!s:.60}"
                raise GeometryError(what, f"there are {', '.join(lines)}")
        found = cls(lines, dict(formulas))
        for one, other in combinations(lines, 2):
            found._check_crossing(one, other)
        return found

    @property
    def tolerance(self) -> float:
        """Boundaries nearer than this coincide, m."""
        points = np.concatenate(list(self.boundaries.values()))
        return _COINCIDE * float(np.hypot(*np.ptp(points, axis=0)))

    def places(self, z: float) -> dict[str, float]:
        """Give x of each boundary on a waterline, m, in order of x.

        Raises
        ------
        GeometryError
            ``"regions: boundary {a} does not reach z={z}"``.
        """
        level = number(z, "regions")
        found = dict[str, float]()
        for name, line in self.boundaries.items():
            if not line[0, 0] <= level <= line[-1, 0]:
                raise GeometryError(
                    f"regions: boundary {name} does not reach z={figure(level)}",
                    f"it runs from z={figure(line[0, 0])} to z={figure(line[-1, 0])}",
                    {"boundary": name, "z": level},
                )  # fmt: skip
            found[name] = float(np.interp(level, line[:, 0], line[:, 1]))
        return dict(sorted(found.items(), key=lambda item: item[1]))

    def at(self, z: float) -> tuple[Region, ...]:
        """Give the regions of a waterline in order of x, without those of no length.

        Raises
        ------
        GeometryError
            ``"regions: boundary {a} does not reach z={z}"``,
            ``"regions: no formula for region {r}"``.
        """
        joints = list[tuple[float, list[str]]]()
        for name, x in self.places(z).items():
            if joints and x - joints[-1][0] <= self.tolerance:
                joints[-1][1].append(name)
            else:
                joints.append((x, [name]))
        return tuple(self._region(*pair) for pair in pairwise(joints))

    def _region(self, low: tuple[float, list[str]], high: tuple[float, list[str]]) -> Region:
        """Give the region between two joints, each of the boundaries that coincide there."""
        for after, before in product(reversed(low[1]), high[1]):
            if (after, before) in self.formulas:
                return Region(after, before, self.formulas[after, before], low[0], high[0])
        region = f"{low[1][-1]} to {high[1][0]}"
        raise GeometryError(
            f"regions: no formula for region {region}", "give one", {"region": region}
        )

    def _check_crossing(self, one: str, other: str) -> None:
        """Refuse two boundaries that change places; between points both are straight."""
        a, b = self.boundaries[one], self.boundaries[other]
        low, high = max(a[0, 0], b[0, 0]), min(a[-1, 0], b[-1, 0])
        if low > high:
            return
        z = np.union1d(a[:, 0], b[:, 0])
        z = np.union1d(z[(z >= low) & (z <= high)], [low, high])
        ahead = np.interp(z, b[:, 0], b[:, 1]) - np.interp(z, a[:, 0], a[:, 1])
        ahead[np.abs(ahead) <= self.tolerance] = 0.0
        sides = np.flatnonzero(ahead)
        for k, m in pairwise(sides.tolist()):
            if ahead[k] * ahead[m] < 0.0:
                far = ahead[k] / (ahead[k] - ahead[m])
                place = float(z[k] + far * (z[m] - z[k])) if m == k + 1 else float(z[k + 1])
                raise GeometryError(
                    f"regions: boundaries {one} and {other} cross at z={figure(place)}",
                    "draw them so that they keep their order",
                    {"boundaries": (one, other), "z": place},
                )  # fmt: skip


def _polyline(name: str, given: ArrayLike) -> FloatArray:
    points = numbers(given, f"regions: boundary {name}", (None, 2))
    if len(points) < 2:
        raise GeometryError(f"regions: boundary {name} has {len(points)} points", "give two")
    falls = np.flatnonzero(np.diff(points[:, 0]) <= 0.0)
    if len(falls):
        z = float(points[falls[0] + 1, 0])
        what = f"regions: z of boundary {name} does not rise at z={figure(z)}"
        raise GeometryError(what, "give points from below upward", {"z": z})
    return points
