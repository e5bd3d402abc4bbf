"""What commands ask that float a hull: draughts, water, appendages, numbers from and to."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING

from assoc_hull.errors import BadInputError

if TYPE_CHECKING:
    from assoc_hull.analysis.hydrostatics.appendage import Appendage

__all__ = ["add_draughts", "add_water", "appendages_of", "density_of", "levels"]

_WATERS = {"salt": 1.025, "fresh": 1.000}
_MOST = 2000


def add_draughts(parser: argparse.ArgumentParser) -> argparse._MutuallyExclusiveGroup:
    """Add the draughts, of which one may be given, and give their group for more of the kind."""
    group = parser.add_mutually_exclusive_group()
    group.add_argument(
        "--draught", type=float, metavar="T", help="at even keel, m (default: design)"
    )
    group.add_argument(
        "--draughts", type=float, nargs=2, metavar=("TA", "TF"), help="at the perpendiculars, m"
    )
    return group


def add_water(parser: argparse.ArgumentParser) -> None:
    """Add density, shell factor, appendages, and what to do with a doubtful hull."""
    water = parser.add_mutually_exclusive_group()
    water.add_argument("--rho", type=float, metavar="R", help="density of the water, t/m3")
    water.add_argument("--water", choices=tuple(_WATERS), help="1.025 (default) or 1.000 t/m3")
    parser.add_argument(
        "--shell-factor", type=float, default=1.0, metavar="F",
        help="displacement over that of the moulded volume (default: 1)",
    )  # fmt: skip
    parser.add_argument(
        "--appendage", action="append", default=[], metavar="NAME,VOLUME,X,Y,Z,AREA",
        help="add one, m3, m, m2; may be given again",
    )  # fmt: skip
    parser.add_argument(
        "--on-error", choices=("refuse", "report"), default="refuse",
        help="what to do where the integrals are doubtful",
    )  # fmt: skip


def density_of(arguments: argparse.Namespace) -> float:
    """Give the density of the water, t/m3."""
    known: float = _WATERS[arguments.water or "salt"]
    return known if arguments.rho is None else float(arguments.rho)


def appendages_of(arguments: argparse.Namespace) -> tuple[Appendage, ...]:
    """Give the appendages."""
    return tuple(map(_appendage, arguments.appendage))


def levels(text: str, option: str, what: str = "draughts") -> list[float]:
    """Take rising numbers, ``FROM:TO:STEP``, both ends included.

    Parameters
    ----------
    text : str
        What was typed.
    option : str
        After which option, for the error.
    what : str
        What they are, for the error.

    Raises
    ------
    BadInputError
        Not three numbers, or none or too many.

    Examples
    --------
    >>> from assoc_hull.cli.floating_terms import levels
    >>> levels("4:5:0.25", "--table")
    [4.0, 4.25, 4.5, 4.75, 5.0]
    """
    where = f"in {option}"
    try:
        low, high, step = (float(part) for part in text.split(":"))
    except ValueError:
        low = high = step = math.nan
    if not (math.isfinite(low) and math.isfinite(high) and math.isfinite(step)):
        raise BadInputError(f"{option} is {text!r}", where, "give FROM:TO:STEP, as 4:18:1")
    if not (step > 0.0 and low <= high):
        raise BadInputError(f"{text} does not rise", where, "give FROM below TO, STEP above 0")
    count = math.floor((high - low) / step + 1e-9) + 1
    if count > _MOST:
        remedy = f"give a step of {(high - low) / _MOST:.3g} m or more"
        raise BadInputError(f"{text} has {count} {what}", where, remedy)
    return [round(low + step * k, 12) for k in range(count)]


def _appendage(text: str) -> Appendage:
    """Take an appendage, ``NAME,VOLUME,X,Y,Z,AREA``."""
    from assoc_hull.analysis.hydrostatics.appendage import Appendage

    name, *rest = (part.strip() for part in text.split(","))
    try:
        volume, x, y, z, area = map(float, rest)
    except ValueError:
        what, remedy = f"the appendage is {text!r}", "give NAME,VOLUME,X,Y,Z,AREA in m3, m, m2"
        raise BadInputError(what, "in --appendage", remedy) from None
    return Appendage(name, volume, (x, y, z), area)
