"""The exact affine image of a hull: every curve is the image of the spline it was, not lofted anew.

A cubic spline with its knots left as they are is carried by an affine map exactly: places and
derivatives at the knots are multiplied.
"""

from __future__ import annotations

from typing import Any

import numpy as np

import assoc_hull as ah
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.definition.records import definition, published
from assoc_hull.model.definition.restore import from_definition

__all__ = ["affine_image"]

_PLACES = {"value", "base", "from"}
_SLOPES = {"leave", "arrive"}
_SIZES = {"length": 0, "breadth": 1, "depth": 2, "draught": 2}


def affine_image(hull: ah.Hull, factors: tuple[float, float, float]) -> ah.Hull:
    """Give the hull whose every place is that of another times factors along x, y and z.

    Features, which are circles and arcs, are left out: they would not be any more.

    Parameters
    ----------
    hull : Hull
        Of lines in planes x, y or z = const, or in none.
    factors : (float, float, float)

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from benchmarks.affine_image import affine_image
    >>> affine_image(ah.examples.wigley(), (1.0, 2.0, 1.0)).half_breadth(50.0, 6.25)
    10.0
    """
    factor = np.array(factors)
    shape: dict[str, Any] = definition(hull.state)
    shown: dict[str, Any] = published(hull.state)
    sizes = shape["particulars"]
    shape = {
        **_part(shape, factor),
        "particulars": {
            key: value * factors[_SIZES[key]] if key in _SIZES else value
            for key, value in sizes.items()
        },
        "lines": [_line(line, factor) for line in shape["lines"]],
        "features": [],
    }
    curves = {key: _curve(each, factor) for key, each in shown["curves"].items()}
    return ah.Hull(from_definition(shape, {**_part(shown, factor), "curves": curves}))


def _line(line: dict[str, Any], factor: FloatArray) -> dict[str, Any]:
    """Move the plane of a line across an axis."""
    if "normal" not in line:
        return line
    along = float((np.abs(line["normal"]) * factor).sum())
    return {**line, "offset": line["offset"] * along}


def _curve(curve: dict[str, Any], factor: FloatArray) -> dict[str, Any]:
    """Carry a published curve; its knots, and where it meets others on them, stay."""
    meets = {
        key: [[at[0], *(factor * at[1:]).tolist()] for at in rows]
        for key, rows in curve["meets"].items()
    }
    return {**_part(curve, factor), "meets": meets}


def _part(part: Any, factor: FloatArray) -> Any:
    if isinstance(part, dict):
        return {key: _named(key, value, factor) for key, value in part.items()}
    return [_part(each, factor) for each in part] if isinstance(part, list) else part


def _named(key: str, value: Any, factor: FloatArray) -> Any:
    if key in _PLACES or key in _SLOPES:
        return (np.array(value) * factor).tolist()
    return _part(value, factor)
