"""Spline surfaces as an IGES file: entities 128, each with its name (406, form 15).

The same surfaces give the same bytes: the file holds no time and no name of a user. Numbers are
written with all digits, so that lengths in metres come back to the last bit.

Source: IGES 5.3 (US PRO, 1996), sections 2.2.4 and 4.24.

Examples
--------
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> from assoc_hull.io.iges.write import iges_text
>>> plate = SplineSurface.bezier([[[0, 0, 0], [0, 1, 0]], [[2, 0, 0], [2, 1, 0]]], "plate")
>>> print(iges_text([plate]).splitlines()[-1])
S      1G      3D      4P      3                                        T      1
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from assoc_hull.arguments import all_of
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.io.iges.layout import Layout, reals
from assoc_hull.io.units import METRES, checked_unit

__all__ = ["iges_text"]

_TITLE = "Control nets of surfaces, written by assoc-hull"


def iges_text(surfaces: Sequence[SplineSurface], unit: str = "m") -> str:
    """Lay out surfaces as the text of an IGES file.

    Parameters
    ----------
    surfaces : sequence of SplineSurface
        At least one; what is no letter of ASCII in a name is written as ``?``.
    unit : {"m", "mm", "cm", "ft", "in"}
        Of the lengths in the file.

    Returns
    -------
    str
        Lines of 80 columns.

    Raises
    ------
    BadInputError
        No surface, something else among them, or another unit.
    """
    where = "in iges_text"
    given = all_of(surfaces, SplineSurface, "surfaces", where)
    factor = 1.0 / METRES[checked_unit(unit, where)]
    if not given:
        raise BadInputError("there are no surfaces", where, "give one or more")
    size = max(float(np.abs(each.net).max()) for each in given) * factor
    layout = Layout()
    for each in given:
        layout.add_named(128, _surface(each, factor), each.name)
    return layout.text(_TITLE, unit, size)


def _surface(surface: SplineSurface, factor: float) -> list[str]:
    """Give the values of an entity 128."""
    (rows, columns), (m, n) = surface.net.shape[:2], surface.degrees
    net = surface.net if factor == 1.0 else surface.net * factor
    weights = np.ones((rows, columns)) if surface.weights is None else surface.weights
    spans = [end for ends in surface.domain for end in ends]
    flags = [0, 0, int(surface.weights is None), 0, 0]
    return [
        *(str(each) for each in (rows - 1, columns - 1, m, n, *flags)),
        *reals(surface.knots_u), *reals(surface.knots_v), *reals(weights.T),
        *reals(net.swapaxes(0, 1)), *reals(spans),
    ]  # fmt: skip
