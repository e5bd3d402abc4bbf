"""Where waterlines go onto a flat: between these places they are straight.

Examples
--------
>>> from assoc_hull.model.forms.forms import Forms
>>> from assoc_hull.model.forms.waterline_flats import water_layout
>>> from assoc_hull.model.state import Particulars
>>> water_layout(Forms.of([], Particulars("ship", 180.0, 28.0, 15.5, 10.5)), 6.0)
''
"""

from __future__ import annotations

import math

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.forms.forms import Forms
from assoc_hull.model.forms.middle_body import breadth_at, span_of

__all__ = ["water_layout", "water_points"]

_LEAST = 0.1
"""A shorter flat (m) is none."""


def water_layout(forms: Forms, z: float) -> str:
    """Give what flat a waterline runs along.

    Parameters
    ----------
    forms : Forms
        The definitions.
    z : float, m
        Its height.

    Returns
    -------
    str
        ``"side"`` on the flat of side, ``"parallel"`` on the parallel middle body below it, else
        empty.
    """
    if _side(forms, z) is not None:
        return "side"
    if forms.has("bilge_radius") and z <= forms.particulars.draught:
        low, high = span_of(forms)
        if high - low > _LEAST and math.isfinite(breadth_at(forms, z)):
            return "parallel"
    return ""


def water_points(forms: Forms, layout: str, z: float) -> FloatArray:
    """Give the two places where a waterline comes onto its flat and leaves it.

    Parameters
    ----------
    forms : Forms
        The definitions.
    layout : str
        From `water_layout`.
    z : float, m
        Its height.

    Returns
    -------
    (2, 3), m
        nan where the flat is no more.
    """
    found = np.full((2, 3), z)
    if layout == "side":
        ends = _side(forms, z)
        found[:, 0] = (math.nan, math.nan) if ends is None else ends
        found[:, 1] = 0.5 * forms.particulars.breadth
    else:
        found[:, 0] = span_of(forms)
        found[:, 1] = breadth_at(forms, z)
    return found


def _side(forms: Forms, z: float) -> tuple[float, float] | None:
    """Give where (x, m) the flat of side begins and ends at a height."""
    if not forms.has("flat_of_side"):
        return None
    chain = forms.chain("flat_of_side")
    places = chain.meets(1, z)
    if len(places) != 2:
        return None
    piece, t = (np.array(each) for each in zip(*places, strict=True))
    low, high = chain.at(piece, t)[:, 0].tolist()
    between = float(chain.ordinate(np.array([0.5 * (low + high)]))[0])
    return (low, high) if high - low > _LEAST and between < z else None
