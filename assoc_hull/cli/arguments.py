"""Arguments that several commands share, and how what is typed is read.

`add_...` puts an argument on a parser: the hull, a JSON wish, draughts, water, appendages, the
screw. The others turn text into values: lengths with a unit, NAME=VALUE, LOW:HIGH, JSON that
holds each key once and only finite numbers. What cannot be read is a `UsageError` or
`argparse.ArgumentTypeError` with the words to type instead.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import math
import re
from collections.abc import Callable, Container
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

from assoc_hull.arguments import once
from assoc_hull.cli.command_table import COMMANDS
from assoc_hull.cli.problems import UsageError
from assoc_hull.errors import BadInputError

if TYPE_CHECKING:
    from assoc_hull.analysis.form.floating_shape import Screw
    from assoc_hull.analysis.hydrostatics.floating_body import Appendage

__all__ = [
    "PICTURE_ENDINGS",
    "Commands",
    "add_command",
    "add_density",
    "add_draughts",
    "add_hull",
    "add_json",
    "add_replace",
    "add_screw",
    "add_wait",
    "add_water",
    "appendages_of",
    "density_of",
    "metres",
    "number_range",
    "parse_length",
    "parse_limits",
    "parse_pairs",
    "read_json",
    "screw_of",
]

# --------------------------------------------------------------------------------------
# Arguments that several commands share.

if TYPE_CHECKING:
    Commands = argparse._SubParsersAction[argparse.ArgumentParser]
else:
    Commands = argparse._SubParsersAction
PICTURE_ENDINGS = (".pdf", ".svg", ".png")


def add_command(
    commands: Commands,
    name: str,
    run: Callable[[argparse.Namespace], int],
    examples: str,
) -> argparse.ArgumentParser:
    """Add a command of the table: what runs it, and examples that can be copied."""
    about = COMMANDS[name].about
    lines = "".join(f"\n  {line.strip()}" for line in examples.strip().splitlines())
    parser = commands.add_parser(
        name,
        help=about,
        description=about[0].upper() + about[1:] + ".",
        epilog=f"examples:{lines}",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.set_defaults(run=run)
    return parser


def add_hull(parser: argparse.ArgumentParser) -> None:
    """Add the hull to be read."""
    parser.add_argument("hull", metavar="HULL", type=Path, help="a .hull or .hull.json file")


def add_wait(parser: argparse.ArgumentParser) -> None:
    """Add how long to wait for another writer."""
    parser.add_argument(
        "--wait", type=_seconds, default=0.0, metavar="S",
        help="wait so long (s) while another process writes to HULL (default: 0)",
    )  # fmt: skip


def _seconds(text: str) -> float:
    """Take a time in seconds."""
    try:
        found = float(text)
    except ValueError:
        found = math.nan
    if not 0.0 <= found < 1e6:
        raise argparse.ArgumentTypeError(f"{text!r} is no time in seconds")
    return found


def add_replace(parser: argparse.ArgumentParser) -> None:
    """Add the leave to write over a hull file."""
    parser.add_argument(
        "--replace", action="store_true",
        help="write over a .hull file that is there, with its history",
    )  # fmt: skip


def add_json(parser: argparse._ActionsContainer) -> None:
    """Add the wish for one JSON document on standard output."""
    parser.add_argument("--json", action="store_true", help="print one JSON document")


# --------------------------------------------------------------------------------------
# Lengths that are typed with a unit.

_UNITS = {"m": 1.0, "cm": 0.01, "mm": 0.001, "": 1.0}
_FORM = re.compile(r"\s*([0-9]*\.?[0-9]+(?:[eE][+-]?[0-9]+)?)\s*([a-z]*)\s*")
_SMALLEST, _LARGEST = 1e-6, 1e3  # m


def parse_length(text: str) -> float:
    """Take a length like ``0.5mm``, ``2 cm`` or ``0.0005``, and give it in m.

    Raises
    ------
    argparse.ArgumentTypeError
        No number, another unit, or no length between a thousandth of a millimetre and a kilometre.

    Examples
    --------
    >>> from assoc_hull.cli.arguments import parse_length
    >>> parse_length("0.5mm"), parse_length("2 cm"), parse_length("0.0005")
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


def metres(text: str) -> float:
    """Take a number of metres of either sign, alone or with a unit as `parse_length` knows it.

    Raises
    ------
    argparse.ArgumentTypeError
        No number, or another unit.

    Examples
    --------
    >>> from assoc_hull.cli.arguments import metres
    >>> metres("18"), metres("-12.5m"), metres("6 mm")
    (18.0, -12.5, 0.006)
    """
    with contextlib.suppress(ValueError):
        return float(text)
    size = text.strip()
    sign = -1.0 if size.startswith("-") else 1.0
    return sign * parse_length(size.removeprefix("-").removeprefix("+"))


# --------------------------------------------------------------------------------------
# What is typed as NAME=VALUE, or as NAME=LOW:HIGH.


def parse_pairs(given: list[str], option: str) -> dict[str, Any]:
    """Take ``NAME=VALUE``; what is no number, nor a length with its unit, is a word.

    Raises
    ------
    UsageError
        Another form, or a name that is given twice.

    Examples
    --------
    >>> from assoc_hull.cli.arguments import parse_pairs
    >>> parse_pairs(["breadth=51.5", "shift=c1"], "set")
    {'breadth': 51.5, 'shift': 'c1'}
    """
    found: dict[str, Any] = {}
    for each in given:
        name, equals, value = each.partition("=")
        if not equals or not name or not value:
            raise UsageError(f"--{option} {each}: give NAME=VALUE")
        _once(name, found, option)
        found[name] = _value(value, length=option == "set" and not name.endswith("_deg"))
    return found


def _once(name: str, found: Container[str], option: str) -> None:
    if name in found:
        raise UsageError(f"--{option} {name} is given twice")


def _value(text: str, *, length: bool) -> float | bool | str:
    if text in ("true", "false"):
        return text == "true"
    with contextlib.suppress(ValueError, argparse.ArgumentTypeError):
        return metres(text) if length else float(text)
    return text


def parse_limits(given: list[str], option: str) -> dict[str, list[float | None] | None]:
    """Take ``NAME`` or ``NAME=LOW:HIGH``; an end that is left out is open.

    Raises
    ------
    UsageError
        Another form, or a name that is given twice.

    Examples
    --------
    >>> from assoc_hull.cli.arguments import parse_limits
    >>> parse_limits(["breadth", "fore_shift=-2:2", "draught=:19"], "free")
    {'breadth': None, 'fore_shift': [-2.0, 2.0], 'draught': [None, 19.0]}
    """
    found: dict[str, list[float | None] | None] = {}
    for each in given:
        name, equals, span = each.partition("=")
        low, colon, high = span.partition(":")
        if not name or (equals and not colon):
            raise UsageError(f"--{option} {each}: give NAME or NAME=LOW:HIGH")
        _once(name, found, option)
        try:
            ends = [float(end) if end else None for end in (low, high)]
        except ValueError:
            raise UsageError(f"--{option} {each}: LOW and HIGH are numbers") from None
        found[name] = ends if equals else None
    return found


# --------------------------------------------------------------------------------------
# Reading of JSON that a command is given.


def read_json(path: Path, what: str) -> Any:
    """Read a file of JSON: no name twice in one object, no number that is not finite.

    Parameters
    ----------
    path : Path
        The file.
    what : str
        What it is to hold, for the message: ``"curve"``.

    Raises
    ------
    BadInputError
        With file, place and remedy.
    """
    try:
        text = path.read_bytes().decode("utf-8-sig")
        return json.loads(text, object_pairs_hook=once, parse_constant=_not_finite)
    except OSError as error:
        reason = f"the file cannot be read ({error.strerror})"
        raise BadInputError(reason, f"at {path}", "check name and permissions") from error
    except json.JSONDecodeError as error:
        where = f"in {path}, line {error.lineno}, column {error.colno}"
        raise BadInputError(f"this is no JSON ({error.msg})", where, "mend it") from error
    except (ValueError, RecursionError) as error:
        raise BadInputError(f"this is no {what} ({error})", f"in {path}", "mend it") from error


def _not_finite(text: str) -> NoReturn:
    raise ValueError(f"{text} is no finite number")


# --------------------------------------------------------------------------------------
# What commands ask that float a hull: draughts, water, appendages, numbers from and to.

_WATERS = {"salt": 1.025, "fresh": 1.000}
_MOST = 2000


def add_draughts(parser: argparse.ArgumentParser) -> argparse._MutuallyExclusiveGroup:
    """Add the draughts, of which one may be given, and give their group for more of the kind."""
    group = parser.add_mutually_exclusive_group()
    group.add_argument(
        "--draught", type=metres, metavar="T", help="at even keel, m (default: design)"
    )
    group.add_argument(
        "--draughts", type=metres, nargs=2, metavar=("TA", "TF"), help="at the perpendiculars, m"
    )
    return group


def add_density(parser: argparse.ArgumentParser) -> None:
    """Add the density of the water, as a number or by a word."""
    water = parser.add_mutually_exclusive_group()
    water.add_argument("--rho", type=float, metavar="R", help="density of the water, t/m3")
    water.add_argument("--water", choices=tuple(_WATERS), help="1.025 (default) or 1.000 t/m3")


def add_water(parser: argparse.ArgumentParser) -> None:
    """Add density, shell factor, appendages, and what to do with a doubtful hull."""
    add_density(parser)
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


def number_range(text: str, option: str, what: str = "draughts") -> list[float]:
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
    >>> from assoc_hull.cli.arguments import number_range
    >>> number_range("4:5:0.25", "--table")
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
    from assoc_hull.analysis.hydrostatics.floating_body import Appendage

    name, *rest = (part.strip() for part in text.split(","))
    try:
        volume, x, y, z, area = map(float, rest)
    except ValueError:
        what, remedy = f"the appendage is {text!r}", "give NAME,VOLUME,X,Y,Z,AREA in m3, m, m2"
        raise BadInputError(what, "in --appendage", remedy) from None
    return Appendage(name, volume, (x, y, z), area)


# --------------------------------------------------------------------------------------
# The screw, as several commands take it.


def add_screw(parser: argparse.ArgumentParser) -> None:
    """Add what may be told of the screw."""
    parser.add_argument(
        "--shaft-height", type=metres, metavar="Z", help="of the shaft at the screw, above base, m"
    )
    parser.add_argument("--propeller-diameter", type=metres, metavar="D", help="m")
    parser.add_argument(
        "--screw-x", type=metres, metavar="X", help="plane of the screw, from AP, + forward, m"
    )
    parser.add_argument(
        "--shaft-spacing", type=metres, metavar="M", help="between the shafts of two screws, m"
    )
    parser.add_argument(
        "--boss-diameter", type=metres, metavar="D", help="of the stern boss at its aft face, m"
    )
    parser.add_argument(
        "--boss-x",
        type=metres,
        metavar="X",
        help="aft face of the stern boss, from AP, + forward, m",
    )


def screw_of(arguments: argparse.Namespace) -> Screw | None:
    """Take what is told of the screw; height and diameter go together, others need both."""
    from assoc_hull.analysis.form.floating_shape import Screw

    given = {
        "height": arguments.shaft_height, "diameter": arguments.propeller_diameter,
        "x": arguments.screw_x, "spacing": arguments.shaft_spacing,
        "boss_diameter": arguments.boss_diameter, "boss_x": arguments.boss_x,
    }  # fmt: skip
    told: dict[str, Any] = {name: value for name, value in given.items() if value is not None}
    if not told:
        return None
    for name, option in (("height", "--shaft-height"), ("diameter", "--propeller-diameter")):
        if name not in told:
            what = f"the screw is told without {option}"
            raise BadInputError(
                what, "in the call", "give height of the shaft and diameter of the screw"
            )
    return Screw(**told)
