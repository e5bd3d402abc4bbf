"""Spline surfaces as an IGES file: entities 128, each with its name (406, form 15).

The same surfaces give the same bytes: the file holds no time and no name of a user. Numbers are
written with all digits, so that lengths in metres come back to the last bit.

Source: IGES 5.3 (US PRO, 1996), sections 2.2.4 and 4.24.

Examples
--------
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> from assoc_hull.io.iges_write import iges_text
>>> plate = SplineSurface.bezier([[[0, 0, 0], [0, 1, 0]], [[2, 0, 0], [2, 1, 0]]], "plate")
>>> print(iges_text([plate]).splitlines()[-1])
S      1G      3D      4P      3                                        T      1
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from assoc_hull.arguments import all_of
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.io.iges_file import UNITS
from assoc_hull.io.surface_units import METRES, checked_unit

__all__ = ["iges_text"]

_TITLE = "Control nets of surfaces, written by assoc-hull"
_DATE = "20000101.000000"
"""The format wants a time; one for all makes files comparable."""

_FLAGS = {name: flag for flag, (name, _) in UNITS.items()}
_NAMES = {"m": "M", "mm": "MM", "cm": "CM", "ft": "FT", "in": "IN"}


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
    directory: list[str] = []
    parameters: list[str] = []
    for each in given:
        number = len(directory) + 1
        label = _ascii(each.name)
        _add(directory, parameters, 128, 0, _surface(each, factor, number + 2), label[:8])
        _add(directory, parameters, 406, 15, ["406", "1", _hollerith(label)], "")
    sections = {
        "S": [f"{_TITLE:72}"], "G": _packed(_globals(unit, size), 72), "D": directory,
        "P": parameters,
    }  # fmt: skip
    lines = [
        f"{line}{letter}{number:7d}"
        for letter, section in sections.items()
        for number, line in enumerate(section, start=1)
    ]
    counts = "".join(f"{letter}{len(section):7d}" for letter, section in sections.items())
    return "\n".join([*lines, f"{counts:72}T{1:7d}"]) + "\n"


def _add(
    directory: list[str], parameters: list[str], kind: int, form: int, values: list[str], label: str
) -> None:
    """Add an entity to both sections."""
    number, first = len(directory) + 1, len(parameters) + 1
    lines = _packed(values, 64)
    parameters += [f"{line:64}{number:8d}" for line in lines]
    status = "00010300" if kind == 406 else "00000000"
    directory.append(f"{kind:8d}{first:8d}{0:8d}{0:8d}{0:8d}{0:8d}{0:8d}{0:8d}{status}")
    directory.append(f"{kind:8d}{0:8d}{0:8d}{len(lines):8d}{form:8d}{'':16}{label:>8}{0:8d}")


def _surface(surface: SplineSurface, factor: float, name: int) -> list[str]:
    """Give the values of an entity 128, and the pointer to its name."""
    (rows, columns), (m, n) = surface.net.shape[:2], surface.degrees
    net = surface.net if factor == 1.0 else surface.net * factor
    weights = np.ones((rows, columns)) if surface.weights is None else surface.weights
    spans = [end for ends in surface.domain for end in ends]
    flags = [0, 0, int(surface.weights is None), 0, 0]
    return [
        *(str(each) for each in (128, rows - 1, columns - 1, m, n, *flags)),
        *_reals(surface.knots_u), *_reals(surface.knots_v), *_reals(weights.T),
        *_reals(net.swapaxes(0, 1)), *_reals(spans), "0", "1", str(name),
    ]  # fmt: skip


def _reals(values: FloatArray | Sequence[float]) -> Iterable[str]:
    """Give numbers with all digits, the last axis fastest, with a point and D for powers of ten."""
    for value in np.asarray(values, np.float64).ravel().tolist():
        digits, power, exponent = repr(value + 0.0).partition("e")
        whole = digits.removesuffix("0") if digits.endswith(".0") else digits
        point = "" if "." in whole else "."
        yield f"{whole}{point}" + (f"D{int(exponent)}" if power else "")


def _globals(unit: str, size: float) -> list[str]:
    """Give the values of the global section."""
    program = _hollerith("assoc-hull")
    words = ["1H,", "1H;", program, _hollerith("surfaces.igs"), program, program]
    words += ["32", "38", "6", "308", "15", program]
    words += ["1.", str(_FLAGS[unit]), _hollerith(_NAMES[unit]), "1", "0.1", _hollerith(_DATE)]
    least, most = _reals([max(size, 1.0) * 1e-15, size])
    return [*words, least, most, "", "", "11", "0", _hollerith(_DATE), ""]


def _hollerith(text: str) -> str:
    return f"{len(text)}H{text}" if text else ""


def _ascii(text: str) -> str:
    """Give a name in the letters that the format knows, and short enough for a line."""
    return text.encode("ascii", "replace").decode()[:60]


def _packed(values: Iterable[str], width: int) -> list[str]:
    """Put values into lines, none of them parted."""
    given = list(values)
    lines = [""]
    for place, value in enumerate(given, start=1):
        word = value + (";" if place == len(given) else ",")
        if len(lines[-1]) + len(word) > width:
            lines.append("")
        lines[-1] += word
    return [f"{line:{width}}" for line in lines]
