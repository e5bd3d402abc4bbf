"""The error of curvature regions: a line of the zero set breaks off."""

from __future__ import annotations

import attrs

from assoc_hull.errors.family import AssocHullError

__all__ = ["DanglingArcError"]


@attrs.define(slots=False, eq=False)
class DanglingArcError(AssocHullError, ArithmeticError):
    """A line of the zero set breaks off inside a patch, at nothing that explains it.

    Attributes
    ----------
    count : int
        How many ends break off.
    surface, patch : int
        Where the first of them lies.
    uv : (float, float)
        Its parameters on the surface.
    gap : float
        How far the nearest other end is, in parameters of the patch; infinite where there is none.
    """

    count: int
    surface: int
    patch: int
    uv: tuple[float, float]
    gap: float

    def __str__(self) -> str:
        which = "an end" if self.count == 1 else f"{self.count} ends"
        return (
            f"{which} of lines of the zero set break off, the first on surface {self.surface}, "
            f"patch {self.patch}, at u = {self.uv[0]:.9g}, v = {self.uv[1]:.9g}, {self.gap:.3g} of "
            "the patch from the next end; give a larger delta (the uncertainty of control "
            "points), so that noise is taken as nil"
        )
