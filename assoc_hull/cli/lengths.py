"""Lengths that are typed with a unit."""

from __future__ import annotations

import argparse
import math
import re

__all__ = ["length"]

_UNITS = {"m": 1.0, "cm": 0.01, "mm": 0.001, "": 1.0}
_FORM = re.compile(r"\s*([0-9]*\.?[0-9]+(?:[eE][+-]?[0-9]+)?)\s*([a-z]*)\s*")
_SMALLEST, _LARGEST = 1e-6, 1e3  # m


def length(text: str) -> float:
    """Take a length like ``0.5mm``, ``2 cm`` or ``0.0005``, and give it in m.

    Raises
    ------
    argparse.ArgumentTypeError
        No number, another unit, or no length between a thousandth of a millimetre and a kilometre.

    Examples
    --------
    >>> from assoc_hull.cli.lengths import length
    >>> length("0.5mm"), length("2 cm"), length("0.0005")
    (0.0005, 0.02, 0.0005)
    """
    match = _FORM.fullmatch(text)
    if match is None or match[2] not in _UNITS:
        raise argparse.ArgumentTypeError(f"{text!r} is no length in mm, cm or m, such as 0.5mm")
    # Through its decimal digits, so that 0.5mm is the number 0.0005.
    shift = {"mm": "e-3", "cm": "e-2"}.get(match[2], "")
    mantissa, _, power = match[1].lower().partition("e")
    found = (
        float(f"{mantissa}e{int(power or 0) + int(shift[1:] or 0)}") if shift else float(match[1])
    )
    if not math.isfinite(found) or not _SMALLEST <= found <= _LARGEST:
        raise argparse.ArgumentTypeError(f"{text!r} lies not between 0.001 mm and 1000 m")
    return found
