"""Sections of one layout as shapes.

Examples
--------
>>> from assoc_hull.model.forms.sections import parted
>>> parted("level+curve+topside+wall")
(('level', 'curve'), ('topside', 'wall'))
"""

from __future__ import annotations

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.curve import FormEnd
from assoc_hull.model.forms.forms import Forms
from assoc_hull.model.forms.section_bulb import bulb_pieces
from assoc_hull.model.forms.section_pieces import Pieces, SectionShape
from assoc_hull.model.forms.stand import Stand
from assoc_hull.model.forms.topside import topside_pieces
from assoc_hull.model.forms.underwater import underwater_pieces

__all__ = ["parted", "section_shape"]


def parted(layout: str) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Part a layout at the draught: the pieces below it, and those above."""
    tokens = tuple(layout.split("+"))
    cut = tokens.index("topside") if "topside" in tokens else len(tokens)
    return tokens[:cut], tokens[cut:]


def section_shape(forms: Forms, layout: str, x: FloatArray, ends: FloatArray) -> SectionShape:
    """Give sections of one layout.

    Parameters
    ----------
    forms : Forms
        The definitions.
    layout : str
        Of all of them.
    x : (n,), m
        Where they stand.
    ends : (n, 2, 3), m
        Where they meet contour and deck edge.

    Returns
    -------
    SectionShape

    Raises
    ------
    OutOfRangeError
        An area or a centroid that no curve has; with the section and the interval.
    BadInputError
        A definition that does not reach so far, a half-breadth below 0.
    """
    stand = Stand.of(forms, x, ends)
    lower, upper = parted(layout)
    pieces: list[Pieces] = []
    below: FormEnd | None = None
    if lower:
        make = bulb_pieces if lower[0] in ("bulb", "round") else underwater_pieces
        pieces, below = make(stand, lower)
    if upper:
        pieces = pieces + topside_pieces(stand, upper, below)
    return SectionShape(x, tuple(pieces))
