"""What definitions are used for: each use stands once in a hull.

A curve that is generated reads the values of these definitions where it stands, and nothing else;
that is what the graph of dependencies holds.

Examples
--------
>>> from assoc_hull.model.uses import USES
>>> USES["keel_angle"].unit, USES["keel_angle"].kind, USES["sectional_area"].needed
('deg', 'course', True)
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

import attrs

__all__ = ["USES", "Use"]


@attrs.frozen
class Use:
    """What a definition may be used for.

    Attributes
    ----------
    kind : str
        Of what kind the definition is.
    unit : str
        Of its ordinate.
    what : str
        What it gives.
    needed : bool
        Whether sections cannot be made without it.
    held : bool
        Whether its first and last ordinates hold beyond its ends, too.
    """

    kind: str
    unit: str
    what: str
    needed: bool = False
    held: bool = False


USES: Mapping[str, Use] = MappingProxyType(
    {
        "sectional_area": Use("halves", "m2", "area of the whole section below the draught", True),
        "design_waterline": Use("halves", "m", "half-breadth at the draught", True),
        "profile": Use("course", "m", "contour in the centre plane, x and z", True),
        "deck_side": Use("course", "m", "half-breadth of the deck edge", True),
        "deck_height": Use("course", "m", "z of the deck edge", True),
        "deck_centre": Use("course", "m", "z of the deck in the centre plane"),
        "flat_of_side": Use("course", "m", "z of the lower border of the flat of side"),
        "flat_of_bottom": Use("course", "m", "half-breadth of the flat of bottom"),
        "bilge_radius": Use(
            "course", "m", "radius of the bilge in the parallel middle body", held=True
        ),
        "half_siding": Use("course", "m", "half-breadth at the contour"),
        "centroid": Use("course", "m", "z of the centroid of the section below the draught"),
        "keel_angle": Use("course", "deg", "angle at the contour, 0 upright, 90 level", held=True),
        "keel_curvature": Use("course", "1/m", "curvature at the contour", held=True),
        "keel_tangent": Use(
            "course", "", "tangent at the contour, in quarters of the chord", held=True
        ),
        "waterline_angle": Use(
            "course", "deg", "angle (flare) at the draught, 0 upright", held=True
        ),
        "waterline_curvature": Use(
            "course", "1/m", "curvature at the draught, or where the flat of side begins", held=True
        ),
        "waterline_tangent": Use(
            "course", "", "tangent at the draught, in quarters of the chord", held=True
        ),
        "deck_angle": Use("course", "deg", "angle (flare) at the deck edge, 0 upright", held=True),
        "deck_curvature": Use("course", "1/m", "curvature at the deck edge", held=True),
        "bulb_area": Use(
            "course", "m2", "area of the whole section up to the neck, or of the bulb"
        ),
        "bulb_height": Use("course", "m", "z of the neck, or of the bulb's top ahead of the stem"),
        "bulb_neck": Use("course", "m", "half-breadth of the neck"),
        "bulb_neck_angle": Use("course", "deg", "angle of the section at the neck", held=True),
    }
)
"""By use: what the definition gives. Angles and abscissae of sections are those of a graph of the
half-breadth over the height: z is its abscissa."""
