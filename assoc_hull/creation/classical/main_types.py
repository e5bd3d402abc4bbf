"""The main types of a PRELIKON job, and which of them needs which.

Examples
--------
>>> from assoc_hull.creation.classical.main_types import MAIN_TYPES, require_types
>>> MAIN_TYPES[5], require_types({5, 1})
('transverse sections', (1, 5))
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from types import MappingProxyType

from assoc_hull.arguments import shown
from assoc_hull.errors import GeometryError

__all__ = ["LATER", "MAIN_TYPES", "require_types"]

MAIN_TYPES: Mapping[int, str] = MappingProxyType({
    1: "general",
    2: "sheer",
    3: "camber",
    4: "deck",
    5: "transverse sections",
    6: "boundary curves",
    7: "appendages",
    8: "deck houses",
    9: "space curves",
})  # fmt: skip
"""Number and name of every main type."""

LATER = (7, 8)
"""Main types that are better given after the others, when the body plan has been looked at."""

_REQUIRED = (1, 5)
_NEEDS = {4: (2, 3), 8: (2, 3, 4)}


def require_types(given: Iterable[object]) -> tuple[int, ...]:
    """Check that a job has the main types that it needs.

    Origin and units (1) and transverse sections (5) must be there; a deck (4) needs sheer and
    camber, a deck house (8) those and a deck. After the PRELIKON system in Kim & Chang, "Some
    Representations of Ship Hulls by Mathematical Method for Design and Production", J. SNAK.

    Parameters
    ----------
    given : iterable of int
        Numbers of main types, in any order.

    Returns
    -------
    tuple of int
        They, sorted, each once.

    Raises
    ------
    GeometryError
        ``"main type {t}: unknown"``, ``"main type {t} is required"``,
        ``"main type {t} needs main type {u}"``.
    """
    try:
        listed = list(given)
    except TypeError:
        what = f"main types: expected numbers, got {shown(given)}"
        raise GeometryError(what, "give a set of numbers") from None
    numbers = sorted({_known(each) for each in listed})
    for needed in _REQUIRED:
        if needed not in numbers:
            raise GeometryError(
                f"main type {needed} is required", f"give the {MAIN_TYPES[needed]}",
                {"type": needed},
            )  # fmt: skip
    for each in numbers:
        for needed in _NEEDS.get(each, ()):
            if needed not in numbers:
                raise GeometryError(
                    f"main type {each} needs main type {needed}",
                    f"give the {MAIN_TYPES[needed]}, or leave out the {MAIN_TYPES[each]}",
                    {"type": each, "needs": needed},
                )  # fmt: skip
    return tuple(numbers)


def _known(each: object) -> int:
    if isinstance(each, bool) or not isinstance(each, int) or each not in MAIN_TYPES:
        raise GeometryError(f"main type {shown(each)}: unknown", "use 1 to 9", {"type": each})
    return each
