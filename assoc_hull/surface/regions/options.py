"""What counts as no Gaussian curvature, and how finely regions of curvature are searched for.

Curvatures up to K0 count as none: K0 follows from a strain over a breadth, or is given as such.
Each option is for one thing; all of them are checked here and nowhere else.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.arguments import choice, integer, not_negative, numbers, positive
from assoc_hull.errors import BadInputError

__all__ = [
    "BREADTH",
    "MODES",
    "STRAIN_TOL",
    "RegionOptions",
    "ZeroBand",
    "region_options",
    "zero_band",
]

# The sign of a curvature that is zero but for rounding means nothing: of a cylinder with control
# points 1e-9 m off, three quarters come out convex and one as a saddle.

MODES = ("strain", "absolute", "exact")

STRAIN_TOL = 1e-3
"""Strain that is neglected: a millimetre a metre, which cold rolling and fitting take up."""

BREADTH = 2.5
"""m, the breadth of a common shell plate."""


@attrs.frozen
class ZeroBand:
    """The band of Gaussian curvatures that count as none, |K| <= K0.

    A strip of breadth b with the constant curvature K needs a range of longitudinal strain of
    |K| b**2 / 8 to be made flat; so the strain that may be neglected gives
    K0 = 8 strain_tol / b**2. Source: our own derivation, checked by flattening strips by least
    squares; "Curvature Region Analysis for Application of Plates Forming", J. SNAK, takes K = 0.

    Attributes
    ----------
    mode : {"strain", "absolute", "exact"}
        By a strain and a breadth; by K0 itself; no band.
    k0 : float, 1/m2
        Half the width of the band; 0 in the mode "exact".
    strain_tol : float or None
        The strain that may be neglected; None in other modes than "strain".
    breadth : float or None, m
        The breadth of the strip that has this strain; None in other modes.
    delta : float or None, m
        What a coordinate of a control point may be off by, besides its rounding; None where it is
        1e-9 of the diagonal of each patch's own box, which is so in the mode "exact" if it is not
        given.
    """

    mode: str
    k0: float
    strain_tol: float | None
    breadth: float | None
    delta: float | None

    @property
    def levels(self) -> tuple[float, ...]:
        """The curvatures that part the regions, 1/m2: (K0, -K0), or (0,) without a band."""
        return (self.k0, -self.k0) if self.k0 else (0.0,)

    def __str__(self) -> str:
        """Say the band in words, with its numbers."""
        if self.mode == "exact":
            return "K = 0 exactly"
        if self.mode == "absolute":
            return f"K0 = {self.k0:.4g} 1/m2"
        return f"K0 = {self.k0:.4g} 1/m2 (strain {self.strain_tol:g} over {self.breadth:g} m)"


def zero_band(
    zero: object = "strain",
    strain_tol: object = STRAIN_TOL,
    breadth: object = BREADTH,
    k0: object = None,
    delta: object = None,
    where: str = "in curvature_regions",
) -> ZeroBand:
    """Check what is given for the band; see `ZeroBand`.

    Raises
    ------
    BadInputError
        An unknown mode, numbers that are none, a number that the mode does not use.
    """
    mode = choice(zero, "zero", MODES, where)
    off = None if delta is None else not_negative(delta, "delta", where)
    strain = positive(strain_tol, "strain_tol", where)
    width = positive(breadth, "breadth", where)
    if mode == "absolute" and k0 is None:
        raise BadInputError("zero is 'absolute' without k0", where, "give k0, 1/m2")
    if mode != "absolute" and k0 is not None:
        what = f"k0 is given beside zero={mode!r}, which does not use it"
        raise BadInputError(what, where, "leave k0 out, or give zero='absolute'")
    if mode == "strain":
        level = positive(8.0 * strain / width / width, "8 strain_tol / breadth**2", where)
        return ZeroBand(mode, level, strain, width, off or 0.0)
    _require_defaults(mode, strain, width, where)
    if mode == "exact":
        return ZeroBand(mode, 0.0, None, None, off)
    return ZeroBand(mode, positive(k0, "k0", where), None, None, off or 0.0)


def _require_defaults(mode: str, strain: float, width: float, where: str) -> None:
    """Refuse a strain or breadth that would be ignored."""
    for name, value, usual in (("strain_tol", strain, STRAIN_TOL), ("breadth", width, BREADTH)):
        if value != usual:
            what = f"{name} is {value:g} beside zero={mode!r}, which does not use it"
            raise BadInputError(what, where, f"leave {name} out, or give zero='strain'")


# --------------------------------------------------------------------------------------
# How finely regions are searched for: tolerances, each for one thing, none for another.

_FINEST, _COARSEST = 1e-13, 0.1
"""Of area_tol: finer is the rounding of a sum of areas, coarser is no area."""

_FINEST_CHORD = 1e-9
"""m: finer is the rounding of coordinates."""


@attrs.frozen
class RegionOptions:
    """Tolerances and limits of a search.

    Attributes
    ----------
    area_tol : float
        Of areas, relative to that of the patch (quadrature).
    depth : int
        How often a patch is halved at most: what is unresolved is 2**-depth of a patch wide.
    budget : int
        So many cells of a patch are looked at, at most.
    chord_tol : float, m
        How far chords of the polylines may stray from the lines; areas do not depend on it.
    levels : tuple of float, 1/m2
        Curvatures for which lines are given beside those of the band.
    """

    area_tol: float
    depth: int
    budget: int
    chord_tol: float
    levels: tuple[float, ...]


def region_options(
    area_tol: object = 1e-6,
    depth: object = 16,
    budget: object = 6000,
    chord_tol: object = 0.001,
    levels: object = (),
    where: str = "in curvature_regions",
) -> RegionOptions:
    """Check what is given; see `RegionOptions`.

    Raises
    ------
    BadInputError
        Numbers that are none, or out of range; a level that is given twice.
    """
    tolerance = positive(area_tol, "area_tol", where)
    if not _FINEST <= tolerance <= _COARSEST:
        remedy = f"give {_FINEST:g} to {_COARSEST:g}, relative to the area of a patch"
        raise BadInputError(f"area_tol is {tolerance:g}", where, remedy)
    chord = positive(chord_tol, "chord_tol", where)
    if chord < _FINEST_CHORD:
        raise BadInputError(f"chord_tol is {chord:g} m", where, f"give {_FINEST_CHORD:g} m or more")
    return RegionOptions(
        tolerance,
        integer(depth, "depth", where, least=1, most=30),
        integer(budget, "budget", where, least=1, most=10**6),
        chord,
        _levels(levels, where),
    )


def _levels(levels: object, where: str) -> tuple[float, ...]:
    """Take curvatures, each once, in the order they are given in."""
    # + 0.0 makes 0.0 of -0.0.
    found = np.atleast_1d(numbers(levels, "levels", where)) + 0.0
    for level, count in zip(*np.unique(found, return_counts=True), strict=True):
        if count > 1:
            what = f"levels holds {level:g} 1/m2 {count} times"
            raise BadInputError(what, where, "give each curvature once")
    return tuple(found.tolist())
