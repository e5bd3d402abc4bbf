"""Words and signs that a curve is told by: one of a few, or an error that names them.

Examples
--------
>>> from assoc_hull.geometry.classical.choices import one_of
>>> one_of("line", ("line", "parabola"), "camber: kind")
'line'
"""

from __future__ import annotations

from collections.abc import Sequence

from assoc_hull.arguments import shown
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checks import finite

__all__ = ["height_of", "one_of"]

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


def one_of(value: object, known: Sequence[str | int], name: str) -> str | int:
    """Take one of a few words or whole numbers.

    Raises
    ------
    GeometryError
        Anything else.
    """
    if isinstance(value, str | int | float):
        for each in known:
            if value == each and isinstance(value, str) == isinstance(each, str):
                return each
    words = ", ".join(repr(each) if isinstance(each, str) else str(each) for each in known)
    raise GeometryError(
        f"{name} is {shown(value)}", f"give one of {words}", {"given": shown(value)}
    )
