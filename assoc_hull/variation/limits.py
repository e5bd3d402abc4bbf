"""Between which values a named parameter may be asked for."""

from __future__ import annotations

from collections.abc import Mapping

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.state import HullState
from assoc_hull.variation.admissible import admissible
from assoc_hull.variation.catalogue import CATALOGUE
from assoc_hull.variation.certificate import Certificate
from assoc_hull.variation.certify import certify
from assoc_hull.variation.compose import compose
from assoc_hull.variation.layout import Layout
from assoc_hull.variation.parent import Parent
from assoc_hull.variation.vmap import VMap

__all__ = ["certified", "hull_box", "interval"]

_STEP = 0.02
"""A usual change of a parameter, as a part of its value, and the least one, m or degrees."""


def hull_box(state: HullState, tolerance: float) -> FloatArray:
    """Give the box of a hull, both sides, grown by a tolerance: (2, 3), m."""
    xyz = state.rows.xyz.data[state.live("rows")]
    low, high = xyz.min(axis=0) - tolerance, xyz.max(axis=0) + tolerance
    low[1] = -high[1]
    return np.array([low, high])


def interval(
    parent: Parent, name: str, present: float, layout: Layout, box: FloatArray
) -> tuple[float, float]:
    """Give the least and greatest value that a parameter may have, asked for alone.

    Parameters
    ----------
    parent : Parent
    name : str
        Of the parameter.
    present : float
        Its value now, m or degrees.
    layout : Layout
    box : (2, 3), m
        Of the hull.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.layout import Layout
    >>> from assoc_hull.variation.limits import interval
    >>> from assoc_hull.variation.parent import Parent
    >>> ship = Parent(300, 50, 27, 18, 27, {"boss": np.array([6.0, 0.0, 5.0])})
    >>> box = np.array([[-5.0, -25.0, 0.0], [306.0, 25.0, 27.0]])
    >>> low, high = interval(ship, "shaft_height", 5.0, Layout(), box)
    >>> round(low, 2), round(high, 2)
    (0.28, 14.72)
    """
    step = max(_STEP * abs(present), _STEP)

    def laid(value: float) -> VMap:
        return compose(parent, {name: value}, layout)

    low, high = admissible(laid, box, present=present, first=step)
    return (max(low, 0.0), high) if CATALOGUE[name].positive else (low, high)


def certified(
    vmap: VMap, box: FloatArray, parent: Parent, values: Mapping[str, float], layout: Layout
) -> Certificate:
    """Certify a map, or refuse it with the room that the parameter at fault has.

    Parameters
    ----------
    vmap : VMap
    box : (2, 3), m
    parent : Parent
    values : mapping of str to float
        Present values of the named parameters that are asked for.
    layout : Layout

    Raises
    ------
    FoldError
        It folds, or nearly; where, by how much, and what would do.
    """
    found = certify(vmap, box)
    if not found.certified and found.field in values:
        now = values[found.field]
        low, high = interval(parent, found.field, now, layout, box)
        found = attrs.evolve(found, admissible=(low - now, high - now))
    found.check()
    return found
