"""As many points of a shape as bring the spline through them within 1 mm, and to its area.

First come the knots of the pieces and the middles of their segments; an interval that passes its
piece too far off is halved, then those that miss the area most. So marks are at dyadic fractions,
and the same shape always gets the same ones.

Examples
--------
>>> from assoc_hull.model.forms.marks import first_marks
>>> first_marks("level+arc")
[(0, 0.0), (1, 0.0), (1, 0.5), (1, 1.0), (1, 1.5), (1, 2.0), (1, 2.5), (1, 3.0), (1, 3.5), (1, 4.0)]
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.definition_part import Mark
from assoc_hull.model.forms.composite import Composite
from assoc_hull.model.forms.section_pieces import Shape

__all__ = ["AREA_WITHIN", "WITHIN", "finer", "first_marks", "near_enough"]

WITHIN = 9e-4
"""So far (m) the spline may pass the pieces where it is measured: between, it stays within 1 mm."""

AREA_WITHIN = 5e-7
"""By so much, of itself, the area below the draught may be missed; the bilge has the rest."""

_LEAST_AREA = 0.1
"""A smaller half section (m2) is taken for this large: its area says nothing of the ship."""

_STRAIGHT = ("level", "siding", "upright", "ahead", "up", "down")
"""Pieces that need no points within."""

_SHORTEST = 1.0 / 64.0
"""The shortest interval, in t."""

_ROUNDS = 60


def first_marks(layout: str) -> list[Mark]:
    """Give knots and middles of segments of all pieces that are bent, and both ends.

    Parameters
    ----------
    layout : str
        Of the line.

    Returns
    -------
    list of Mark
        In order. A joint is named by the piece that begins there.
    """
    tokens = [each.partition(":")[0].rstrip("^") for each in layout.split("+")]
    found: list[Mark] = []
    for piece, token in enumerate(tokens):
        inner = 1 if token in _STRAIGHT else 8
        found += [(piece, 0.5 * step) for step in range(inner)]
    return [*found, (len(tokens) - 1, 4.0)]


def finer(
    shape: Shape,
    layout: str,
    marks: Sequence[Mark],
    ends: FloatArray | None,
    under: int,
    where: str,
) -> list[Mark]:
    """Add marks until the spline is near enough.

    Parameters
    ----------
    shape : Shape
        Of one curve.
    layout : str
        Its layout.
    marks : sequence of Mark
        Those to begin with, both ends among them.
    ends : (1, 2, 3), m, or None
        Where the ends lie; on the shape if None.
    under : int
        The number of pieces below the draught, whose area counts.
    where : str
        Names the line in messages.

    Returns
    -------
    list of Mark

    Raises
    ------
    BadInputError
        The shape is bent too sharply for a spline with points at a decent distance.
    """
    found = list(marks)
    for _ in range(_ROUNDS):
        whole = Composite.of(shape, layout, [found], ends)
        halved = _to_halve(whole, under)
        if halved is None:
            return found
        halved &= whole.high - whole.low > _SHORTEST
        if not halved.any():
            break
        middle = 0.5 * (whole.low + whole.high)
        extra = [(int(whole.piece[i]), float(middle[i])) for i in np.flatnonzero(halved)]
        found = sorted([*found, *extra])
    raise BadInputError(
        "the curve is bent too sharply to be held within 1 mm and its area", where,
        "give smaller curvatures, or tangents nearer to a quarter of the chord",
    )  # fmt: skip


def near_enough(whole: Composite, under: int, count: int) -> NDArray[np.bool_]:
    """Tell which curves keep to their shapes.

    Parameters
    ----------
    whole : Composite
        The curves.
    under : int
        The number of pieces below the draught, whose area counts.
    count : int
        The number of curves.

    Returns
    -------
    (count,) bool
    """
    found = np.ones(count, np.bool_)
    found[whole.row[whole.deviations() > WITHIN]] = False
    if under:
        found &= _enough_area(whole, *whole.areas(under), count)
    return found


def _enough_area(
    whole: Composite, exact: FloatArray, spline: FloatArray, count: int
) -> NDArray[np.bool_]:
    """Tell which curves have the area of their pieces."""
    off, area = (np.bincount(whole.row, each, minlength=count) for each in (spline - exact, exact))
    return np.asarray(np.abs(off) <= AREA_WITHIN * np.maximum(area, _LEAST_AREA))


def _to_halve(whole: Composite, under: int) -> NDArray[np.bool_] | None:
    """Tell which intervals of one curve to halve; None where all is near enough."""
    far = whole.deviations() > WITHIN
    if far.any():
        return far
    if not under:
        return None
    exact, spline = whole.areas(under)
    if _enough_area(whole, exact, spline, 1)[0]:
        return None
    off = np.where(whole.high - whole.low > _SHORTEST, np.abs(spline - exact), 0.0)
    return np.asarray(off > 0.5 * off.max())
