"""By what plates are told apart: checked options, each for one thing.

Examples
--------
>>> from assoc_hull.surface.plating.options import plate_options
>>> plate_options(share=0.9).flat_bend(2.0)
0.006
"""

from __future__ import annotations

from collections.abc import Mapping

import attrs

from assoc_hull.arguments import positive
from assoc_hull.errors import BadInputError
from assoc_hull.surface.plating.plate_class import suggestions_with
from assoc_hull.surface.regions.options import BREADTH

__all__ = ["SAGITTA_TOL", "SHARE", "PlateOptions", "plate_options"]

SAGITTA_TOL = 0.003
"""m: how far a plate may stand off a plane over its breadth and still count as flat."""

SHARE = 0.95
"""The part of a plate that makes its class."""

_SHORTEST = 1e-6
"""m: nothing that is shorter is a plate, or a part of one."""


@attrs.frozen(eq=False)
class PlateOptions:
    """By what plates are told apart.

    Attributes
    ----------
    breadth : float or None, m
        The breadth of the band and of the sagitta; None for each plate's own.
    sagitta_tol : float, m
        How far a plate may stand off a plane and still count as flat.
    sagitta_length : float or None, m
        Over which length; None for the breadth.
    share : float
        The part of its area that makes the class of a plate, above 0.5 to 1.
    suggestions : mapping of str to str
        The advice by class.
    """

    breadth: float | None
    sagitta_tol: float
    sagitta_length: float | None
    share: float
    suggestions: Mapping[str, str]

    def flat_bend(self, breadth: float) -> float:
        """Give the curvature up to which a plate is flat, 1/m: 8 sagitta / length**2."""
        length = self.sagitta_length or breadth
        return 8.0 * self.sagitta_tol / length**2


def plate_options(
    breadth: object = BREADTH,
    sagitta_tol: object = SAGITTA_TOL,
    sagitta_length: object = None,
    share: object = SHARE,
    suggestions: object = None,
    where: str = "in plates",
) -> PlateOptions:
    """Check what is given; see `PlateOptions`.

    Raises
    ------
    BadInputError, WrongTypeError
        Numbers that are none, or out of range; suggestions for what is no class.
    """
    part = positive(share, "share", where)
    if not 0.5 < part <= 1.0:
        remedy = "give a part of the area above 0.5, up to 1"
        raise BadInputError(f"share is {part:g}", where, remedy)
    return PlateOptions(
        None if breadth is None else _length(breadth, "breadth", where),
        positive(sagitta_tol, "sagitta_tol", where),
        None if sagitta_length is None else _length(sagitta_length, "sagitta_length", where),
        part,
        suggestions_with(suggestions, where),
    )


def _length(value: object, name: str, where: str) -> float:
    """Take a length whose square can be divided by."""
    found = positive(value, name, where)
    if found < _SHORTEST:
        remedy = f"give {_SHORTEST:g} m or more"
        raise BadInputError(f"{name} is {found:g} m", where, remedy)
    return found
