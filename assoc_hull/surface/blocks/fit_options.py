"""What a surface of a hull is asked to be: penalty, tolerances, spacing of knots and points.

All scales with the length of the ship, and is given here for one of 300 m.

Examples
--------
>>> from assoc_hull.surface.blocks.fit_options import fit_options
>>> options = fit_options(150.0)
>>> options.limit("body"), options.limit("bow")
(0.004, 0.0075)
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.arguments import not_negative, positive
from assoc_hull.model.tables import HullState

__all__ = ["CREASE", "CUTOFF", "FitOptions", "angle_limit", "fit_options", "length_of"]

_LENGTH = 300.0
SMOOTHING = 9.6e-10
"""The penalty over the cube of the length."""

_BODY, _ENDS, _MEDIAN = 0.008, 0.015, 0.0015
CUTOFF = 1e-7
"""Control points and points of lines that move by less, m, count as unmoved."""

_OF_ENDS = 0.5
"""The penalty of bow and stern, as a part of that of the body ..."""

_AREA = 0.005
"""... if their area is this part of the length squared or more; smaller ones have less."""

_BODY_ANGLE, _END_ANGLE = 0.1, 0.5
CREASE = 180.0
"""The limit of the angle where blocks meet along a knuckle line, degrees: none."""


@attrs.frozen
class FitOptions:
    """Numbers of a fit.

    Attributes
    ----------
    length : float, m
        Of the ship, between perpendiculars.
    smoothing : float, m3
        The factor of the penalty of the body.
    body_limit : float, m
        What 95 % of the residuals of the body should keep; bulb and stern have 15/8 of it.
    cutoff : float, m
        Points of lines that move by less leave their block as it is when a surface follows an
        edit; control points that do keep their place.
    """

    length: float
    smoothing: float
    body_limit: float
    cutoff: float

    @property
    def scale(self) -> float:
        """The length of the ship over 300 m."""
        return self.length / _LENGTH

    @property
    def median_limit(self) -> float:
        """What the median of the residuals should keep, m."""
        return self.body_limit * _MEDIAN / _BODY

    def smoothing_of(self, kind: str, area: float) -> float:
        """Give the factor of the penalty of a block, m3.

        Parameters
        ----------
        kind : {"body", "bow", "stern"}
            Its kind.
        area : float, m2
            Of its rectangle. The radii of a bulb or a boss are as small as it is itself, so that
            the penalty of ends goes with the cube of their size.
        """
        if kind == "body":
            return self.smoothing
        share = min(area / (_AREA * self.length**2), 1.0)
        return float(_OF_ENDS * self.smoothing * share**1.5)

    def limit(self, kind: str) -> float:
        """Give what 95 % of the residuals of a kind of block should keep, m."""
        return self.body_limit if kind == "body" else self.body_limit * _ENDS / _BODY

    @property
    def girth_span(self) -> float:
        """How long spans along the girth are, m."""
        return 1.2 * self.scale

    @property
    def point_step(self) -> float:
        """How far apart the points are at which lines that were left out are measured, m."""
        return 0.6 * self.scale


def angle_limit(kinds: tuple[str, str]) -> float:
    """Give the angle that the normals at a border of two kinds of blocks should keep, degrees."""
    return _BODY_ANGLE if "body" in kinds else _END_ANGLE


def length_of(state: HullState) -> float:
    """Give the length that tolerances go by, m.

    That between perpendiculars; or that of the lines, if they are not half as long or more than
    twice: a hull that was scaled keeps its particulars.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.surface.blocks.fit_options import length_of
    >>> length_of(ah.examples.wigley().state)
    100.0
    """
    x = state.rows.xyz[state.live("rows"), 0]
    stated, drawn = state.particulars.length, float(np.ptp(x))
    return stated if 0.5 * stated <= drawn <= 2.0 * stated else drawn


def fit_options(
    length: float,
    smoothing: float | None = None,
    tolerance: float | None = None,
    cutoff: float = CUTOFF,
) -> FitOptions:
    """Take options, or what is usual for a ship.

    Parameters
    ----------
    length : float, m
        Of the ship.
    smoothing : float, m3, optional
        The factor of the penalty of the body; ``9.6e-10 length**3`` if None.
    tolerance : float, m, optional
        What 95 % of the residuals of the body should keep; 8 mm at 300 m if None.
    cutoff : float, m
        As of `FitOptions`.

    Raises
    ------
    WrongTypeError, BadInputError
        No numbers; a tolerance that is not above 0, another below it.
    """
    where = "in surface"
    usual = SMOOTHING * length**3, _BODY * length / _LENGTH
    return FitOptions(
        length,
        usual[0] if smoothing is None else positive(smoothing, "smoothing", where),
        usual[1] if tolerance is None else positive(tolerance, "tolerance", where),
        not_negative(cutoff, "cutoff", where),
    )
