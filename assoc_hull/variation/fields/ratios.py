"""Ratio curves: how the source paper lays out a field, for who wants to compare with it.

A boundary curve through each anchor carries the ratio of the anchor's coordinate after and
before; between two of them the ratio is blended, so a place keeps nothing of the lines that
join the anchors. Choi & Lee, "A Study on the Hull Form Design System on the Basis of the
Associative Geometry Objects", J. SNAK 36(4), 1999, section 3.4, formulas 3.1 to 3.3.
"""

from __future__ import annotations

from collections.abc import Sequence

from assoc_hull.errors import BadInputError
from assoc_hull.variation.fields.blend import QUINTIC, Blend
from assoc_hull.variation.fields.field import Field, Piece, stack
from assoc_hull.variation.fields.piecewise_linear import Course

__all__ = ["ratios"]

_GRIP = 1e-6
"""A height below this part of the highest anchor's has no ratio."""


def ratios(
    name: str,
    anchors: Sequence[tuple[str, float, float]],
    course: Course,
    *,
    blend: Blend = QUINTIC,
) -> Field:
    """Lay out a z-field by the ratios of heights.

    Parameters
    ----------
    name : str
    anchors : sequence of (str, float, float)
        Name, height (m, above the base) and displacement (m), from below.
    course : Course
        How it fades along the ship, 1 where it is full.
    blend : Blend

    Raises
    ------
    BadInputError
        Anchors that do not rise, or one at the base that is to move.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.fields.piecewise_linear import Chain
    >>> from assoc_hull.variation.fields.ratios import ratios
    >>> anchors = [("base", 0, 0), ("shaft", 5, 1), ("T", 18, 0)]
    >>> field = ratios("shaft", anchors, Chain.constant(1))
    >>> field.displacement(np.array([[10.0, 2.0, 5.0], [10.0, 2.0, 22.0]])).tolist()
    [1.0, 0.0]
    """
    heights = [float(z) for _, z, _ in anchors]
    walls = stack([label for label, _, _ in anchors], heights)
    least = _GRIP * max(map(abs, heights))
    pieces = list[Piece]()
    for label, z, change in anchors:
        if abs(z) < least and change != 0.0:
            raise BadInputError(
                f"'{name}' cannot use a ratio: anchor '{label}' at {z:.3f} m equals its pivot",
                "in vary", "leave blend='paper' out, so that it is shifted",
            )  # fmt: skip
        pieces.append(Piece.along(course, change / z if change else 0.0, 0.0))
    return Field(name, "z", walls, tuple(pieces), blend)
