"""What counts as no Gaussian curvature: a band by strain, a band as such, or nil itself.

The sign of a curvature that is nil but for rounding means nothing: of a cylinder with control
points 1e-9 m off, three quarters come out convex and one as a saddle. So curvatures up to some K0
count as none. A strip of breadth b with the constant curvature K needs a range of longitudinal
strain of |K| b**2 / 8 to be made flat; so the strain that may be neglected gives

    K0 = 8 strain_tol / b**2

Source: the strain of a narrow strip is our own derivation, checked by flattening strips by least
squares; "Curvature Region Analysis for Application of Plates Forming", J. SNAK, takes nil itself.

Examples
--------
>>> from assoc_hull.surface.regions.zero_band import zero_band
>>> zero_band("strain", strain_tol=1e-3, breadth=2.5).k0
0.00128
"""

from __future__ import annotations

import attrs

from assoc_hull.arguments import choice, not_negative, positive
from assoc_hull.errors import BadInputError

__all__ = ["BREADTH", "MODES", "STRAIN_TOL", "ZeroBand", "zero_band"]

MODES = ("strain", "absolute", "exact")

STRAIN_TOL = 1e-3
"""Strain that is neglected: a millimetre a metre, which cold rolling and fitting take up."""

BREADTH = 2.5
"""m, the breadth of a common shell plate."""


@attrs.frozen
class ZeroBand:
    """The band of Gaussian curvatures that count as none, |K| <= K0.

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
