"""The errors of form-parameter curves: no middle vertex gives what was asked for."""

from __future__ import annotations

import attrs

from assoc_hull.errors.family import AssocHullError

__all__ = ["DegenerateEndsError", "NoMiddleVertexError"]


@attrs.define(slots=False, eq=False)
class DegenerateEndsError(AssocHullError, ValueError):
    """The area under a form-parameter curve does not depend on its middle vertex.

    Attributes
    ----------
    where : str
        The curve.
    area : float
        As asked for, in square units of the plane.
    only : float
        The one area that the curve has with these ends.
    """

    where: str
    area: float
    only: float

    def __str__(self) -> str:
        return (
            f"the two ends leave the area at {self.only:.8g} whatever the middle vertex, and "
            f"{self.area:.8g} was asked for, in {self.where}; change a tangent length or an angle"
        )


@attrs.define(slots=False, eq=False)
class NoMiddleVertexError(AssocHullError, ValueError):
    """Area and centroid of a form-parameter curve cannot both be met.

    Attributes
    ----------
    where : str
        The curve.
    area, centroid : float
        As asked for; the centroid is the abscissa of that of the area.
    nearest : float
        The nearest centroid that can be reached with this area and these ends.
    discriminant : float
        Of the quadratic equation for the middle vertex, in its own units: below 0.
    """

    where: str
    area: float
    centroid: float
    nearest: float
    discriminant: float

    def __str__(self) -> str:
        way = "up" if self.nearest > self.centroid else "down"
        return (
            f"area {self.area:.8g} and centroid {self.centroid:.8g} cannot both be met, in "
            f"{self.where}; with this area and these ends give a centroid from "
            f"{self.nearest:.8g} {way}"
        )
