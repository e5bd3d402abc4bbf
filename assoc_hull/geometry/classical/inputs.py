"""What splines and circles ask of their input: extents that arithmetic can bear, known words."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from assoc_hull.arguments import shown
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checks import figure
from assoc_hull.geometry.curves import FloatArray

__all__ = ["LEAST_EXTENT", "MOST_EXTENT", "bearable", "one_of"]

LEAST_EXTENT, MOST_EXTENT = 1e-50, 1e50
"""m: between an atom and the universe with room to spare."""


def bearable(values: FloatArray, name: str) -> FloatArray:
    """Take coordinates of any shape, m, whose squares and cubes are numbers.

    Raises
    ------
    GeometryError
        The largest amount is beyond the bounds; points that are all nil pass.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.classical.inputs import bearable
    >>> bearable(np.array([0.0, 1e200]), "circle")
    Traceback (most recent call last):
    ...
    assoc_hull.errors.GeometryError: circle: a coordinate of 1e+200 m; give lengths in m
    """
    size = float(np.abs(values).max(initial=0.0))
    if size and not LEAST_EXTENT <= size <= MOST_EXTENT:
        raise GeometryError(
            f"{name}: a coordinate of {figure(size)} m", "give lengths in m", {"size": size}
        )
    return values


def one_of(value: object, known: Sequence[str], what: str) -> None:
    """Refuse what is none of some words; `what` begins the message.

    Raises
    ------
    GeometryError
        Anything else.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.inputs import one_of
    >>> one_of("z", ("x", "y"), "spline: no axis")
    Traceback (most recent call last):
    ...
    assoc_hull.errors.GeometryError: spline: no axis 'z'; choose 'x' or 'y'
    """
    if not isinstance(value, str) or value not in known:
        raise GeometryError(
            f"{what} {shown(value)}", f"choose {' or '.join(map(repr, known))}", {"value": value}
        )
