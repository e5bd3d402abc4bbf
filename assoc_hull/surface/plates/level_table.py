"""Where the Gaussian curvature of patches exceeds levels: areas, level by level.

Levels are K0, and its halves and doubles, so that it is known how much lies near the limit.

Examples
--------
>>> from assoc_hull.surface.plates.level_table import levels_about
>>> levels_about(1.0)
(1.0, -1.0, 0.5, -0.5, 2.0, -2.0)
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.patches.area_ground import AreaGround
from assoc_hull.geometry.patches.areas import areas
from assoc_hull.geometry.patches.curvature_functions import gauss_functions
from assoc_hull.geometry.patches.patches import Patches
from assoc_hull.geometry.patches.running_bounds import Running
from assoc_hull.surface.plates.cut_areas import TOL, signed_area
from assoc_hull.surface.regions.region_parts import Solution

__all__ = ["LevelTable", "level_functions", "level_table", "levels_about"]


def levels_about(k0: float) -> tuple[float, ...]:
    """Give the levels that a plate is judged by, 1/m2: K0 and -K0, their halves and doubles."""
    return tuple(factor * k0 * sign for factor in (1.0, 0.5, 2.0) for sign in (1.0, -1.0))


def level_functions(patches: Patches, levels: Sequence[float]) -> tuple[Running, ...]:
    """Give polynomials with the sign of K less each level."""
    found = gauss_functions(patches, levels)
    return tuple(Running(each.b, each.err) for each in found)


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
    patches: Patches, levels: Sequence[float], solutions: Sequence[Solution] = ()
) -> LevelTable:
    """Find areas above levels.

    Parameters
    ----------
    patches : Patches
        The patches.
    levels : sequence of float, 1/m2
        The levels.
    solutions : sequence of Solution
        What is known of some of the levels for the same patches.
    """
    ground = AreaGround.of(patches, TOL)
    known = {each.level: each for each in solutions}
    above, off = {}, {}
    for level in levels:
        if level in known:
            found = areas(patches, known[level].cells, known[level].arcs, TOL, ground)
            above[level] = found.positive_estimate
            off[level] = found.unresolved + found.error_estimate
    wanted = [level for level in levels if level not in known]
    functions = level_functions(patches, wanted) if wanted else ()
    for level, function in zip(wanted, functions, strict=True):
        signed = signed_area(ground, function)
        above[level] = np.maximum(0.5 * (ground.total + signed.value), 0.0)
        off[level] = np.array(signed.off)
    return LevelTable(np.array(ground.total), above, off)
