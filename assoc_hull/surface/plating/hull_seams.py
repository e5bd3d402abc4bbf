"""Butts and seams of a shell: planes x = constant and z = constant, and lines of equal girth.

Examples
--------
>>> from assoc_hull.surface.plating.hull_seams import HullSeams
>>> [each.name for each in HullSeams(x=(100.0, 112.0), z=4.0).ranges(("x", "z"))][:3]
['1.1', '1.2', '2.1']
"""

from __future__ import annotations

from itertools import pairwise, product
from typing import Any

import attrs
import numpy as np

from assoc_hull.arguments import numbers, shown
from assoc_hull.errors import BadInputError, WrongTypeError

__all__ = ["AXES", "HullSeams", "PlateRange"]

AXES = ("x", "z", "girth")
"""What seams are given in, m."""

_NEAREST = 1e-3
"""m: between seams that are nearer lies no plate."""


@attrs.frozen
class PlateRange:
    """What belongs to a plate.

    Attributes
    ----------
    name : str
        The number of its place along the ship, and, after a point, up the girth.
    x, z, girth : (float, float), m
        Least and greatest; infinite where no seam ends it.
    """

    name: str
    x: tuple[float, float] = (-np.inf, np.inf)
    z: tuple[float, float] = (-np.inf, np.inf)
    girth: tuple[float, float] = (-np.inf, np.inf)

    def __str__(self) -> str:
        """Say the range in words."""
        found = [_words(axis, *getattr(self, axis)) for axis in AXES]
        return ", ".join(each for each in found if each) or "the whole hull"


def _words(axis: str, low: float, high: float) -> str:
    if np.isinf(low) and np.isinf(high):
        return ""
    if np.isinf(low):
        return f"{axis} below {high:g} m"
    return f"{axis} above {low:g} m" if np.isinf(high) else f"{axis} {low:g} to {high:g} m"


def _places(value: object, name: str) -> tuple[float, ...]:
    """Take places that rise."""
    found = np.atleast_1d(numbers(value, name, "in HullSeams"))
    if (np.diff(found) < _NEAREST).any():
        remedy = f"give places that rise by {_NEAREST:g} m at least, in m"
        raise BadInputError(f"{name} is {shown(value)}", "in HullSeams", remedy)
    return tuple(found.tolist())


def _butts(value: Any) -> tuple[float, ...]:
    return _places(value, "x")


def _levels(value: Any) -> tuple[float, ...]:
    return _places(value, "z")


def _girths(value: Any) -> tuple[float, ...]:
    return _places(value, "girth")


def _switch(value: object) -> bool:
    if not isinstance(value, bool):
        remedy = "give True to leave out what lies beyond the first and the last place"
        raise WrongTypeError(f"inside is {shown(value)}", "in HullSeams", remedy)
    return value


@attrs.frozen
class HullSeams:
    """Where the shell of a hull is cut into plates.

    Attributes
    ----------
    x : tuple of float, m
        Butts: planes across the ship, rising.
    z : tuple of float, m
        Seams: horizontal planes, rising.
    girth : tuple of float, m
        Seams: lines of equal girth, measured along sections from their lowest point, rising.
    inside : bool
        Whether only plates between the first and the last place are wanted; else those beyond
        them are found, too.

    Raises
    ------
    BadInputError, WrongTypeError
        Numbers that are none, or do not rise by a millimetre.

    Examples
    --------
    >>> from assoc_hull.surface.plating.hull_seams import HullSeams
    >>> [str(each) for each in HullSeams(x=(100, 112), girth=(2.0, 4.5), inside=True).ranges()]
    ['x 100 to 112 m, girth 2 to 4.5 m']
    """

    x: tuple[float, ...] = attrs.field(default=(), converter=_butts)
    z: tuple[float, ...] = attrs.field(default=(), converter=_levels)
    girth: tuple[float, ...] = attrs.field(default=(), converter=_girths)
    inside: bool = attrs.field(default=False, converter=_switch)

    def __bool__(self) -> bool:
        """Whether anything is cut."""
        return bool(self.x or self.z or self.girth)

    def ranges(self, axes: tuple[str, ...] = AXES) -> tuple[PlateRange, ...]:
        """Give the ranges of all plates, from aft forward, and each ring from below upward.

        Parameters
        ----------
        axes : tuple of str
            What is cut by.
        """
        places = {axis: self._intervals(axis) for axis in axes}
        numbers = [range(1, len(each) + 1) for each in places.values()]
        cut = [len(each) > 1 or bool(getattr(self, axis)) for axis, each in places.items()]
        found = []
        for spans, order in zip(product(*places.values()), product(*numbers), strict=True):
            name = ".".join(str(n) for n, told in zip(order, cut, strict=True) if told)
            found.append(PlateRange(name or "1", **dict(zip(axes, spans, strict=True))))
        return tuple(found)

    def _intervals(self, axis: str) -> list[tuple[float, float]]:
        """Give the intervals between places."""
        places = getattr(self, axis)
        if self.inside and len(places) > 1:
            return list(pairwise(places))
        return list(pairwise((-np.inf, *places, np.inf)))
