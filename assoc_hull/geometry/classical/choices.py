"""Words and signs that a curve is told by: one of a few, or an error that names them.

Examples
--------
>>> from assoc_hull.geometry.classical.choices import one_of
>>> one_of("line", ("line", "parabola"), "camber: kind is")
'line'
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

from assoc_hull.arguments import shown
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checks import called, finite

__all__ = ["height_of", "one_of"]

Choice = TypeVar("Choice", str, int)

_HIGHEST = 1e6
"""No hull reaches up or down to here (m)."""


def height_of(value: object, name: str) -> float:
    """Take a height, m; one beyond any hull counts as a million metres.

    Raises
    ------
    GeometryError
        Anything that is no finite number.
    """
    found = float(finite(value, name, ()))  # type: ignore[arg-type]
    return min(max(found, -_HIGHEST), _HIGHEST)


def one_of(value: object, known: Sequence[Choice], what: str) -> Choice:
    """Take one of a few words or whole numbers; `what` begins the message.

    Raises
    ------
    GeometryError
        Anything else.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.choices import one_of
    >>> one_of("z", ("x", "y"), "spline: no axis")
    Traceback (most recent call last):
    ...
    assoc_hull.errors.GeometryError: spline: no axis 'z'; there are x, y
    """
    if isinstance(value, str | int | float):
        for each in known:
            if value == each and isinstance(value, str) == isinstance(each, str):
                return each
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    raise GeometryError(
        f"{what} {shown(value) if is_number else called(value)}",
        f"there are {', '.join(map(str, known))}",
        {"given": shown(value)},
    )
