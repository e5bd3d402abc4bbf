"""The command that tells how stable a ship is: righting levers, criteria, cross curves, rest."""

from __future__ import annotations

import argparse
import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from assoc_hull.cli.arguments import (
    PICTURE_ENDINGS,
    Commands,
    add_command,
    add_draughts,
    add_hull,
    add_json,
    add_water,
    appendages_of,
    density_of,
    metres,
    number_range,
)
from assoc_hull.cli.output import emit, progress
from assoc_hull.cli.problems import check_other_target, check_target
from assoc_hull.errors import BadInputError
from assoc_hull.hull import Hull
from assoc_hull.hull.sources import open as open_hull

if TYPE_CHECKING:
    from assoc_hull.analysis.stability.cross_curves import CrossCurves
    from assoc_hull.analysis.stability.flooding import FloodingPoint
    from assoc_hull.analysis.stability.stability_report import Stability

__all__ = ["add_flooding", "add_stability", "opening"]

_FILES = (".txt", ".csv", ".xlsx", ".json")
_CALL = "in the call"


def add_stability(commands: Commands) -> None:
    """Add ``stability``."""
    parser = add_command(
        commands, "stability",
        _stability,
        """assoc-hull stability ship.hull --kg 11.2
        assoc-hull stability ship.hull --kg 11.2 --weight 150000 --lcg 148 --trim free --json
        assoc-hull stability ship.hull --kg 11.2 --flooding "vent,30,4,26" -o gz.xlsx --plot gz.pdf
        assoc-hull stability ship.hull --cross 6:18:1 --heels 5:90:5 -o kn.csv --plot kn.pdf
        assoc-hull stability ship.hull --rest --weight 150000 --lcg 148 --tcg 0.1 --kg 11.2""",
    )  # fmt: skip
    add_hull(parser)
    _add_condition(parser)
    add_water(parser)
    _add_output(parser)


def _add_condition(parser: argparse.ArgumentParser) -> None:
    kind = parser.add_mutually_exclusive_group()
    kind.add_argument(
        "--cross", metavar="FROM:TO:STEP", help="cross curves KN instead, at mean draughts, m"
    )
    kind.add_argument(
        "--rest", action="store_true", help="find draughts and heel at which she rests instead"
    )
    group = add_draughts(parser)
    group.add_argument("--weight", type=float, metavar="W", help="all of it, t")
    parser.add_argument("--lcg", type=metres, metavar="X", help="with --weight: from AP, m")
    parser.add_argument(
        "--tcg", type=metres, metavar="Y", help="centre of gravity to port, m (default: 0)"
    )
    parser.add_argument("--kg", type=metres, metavar="Z", help="centre of gravity above base, m")
    parser.add_argument(
        "--trim", choices=("fixed", "free"),
        help="as she heels: that of upright (default), or that of equilibrium",
    )  # fmt: skip
    parser.add_argument(
        "--heels", metavar="FROM:TO:STEP", help="of the table, degrees, + starboard down"
    )
    add_flooding(parser)


def add_flooding(parser: argparse.ArgumentParser) -> None:
    """Add openings through which water comes in."""
    parser.add_argument(
        "--flooding", action="append", default=[], metavar="NAME,X,Y,Z",
        help="an opening, on both sides, m; may be given again",
    )  # fmt: skip


def _add_output(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "-o", "--out", type=Path, metavar="FILE", help="a .txt, .csv, .xlsx or .json file"
    )
    parser.add_argument("--plot", type=Path, metavar="FILE", help="a .pdf, .svg or .png file")
    add_json(parser)


def _stability(arguments: argparse.Namespace) -> int:
    _check(arguments)
    if arguments.rest:
        return _rest(arguments)
    from assoc_hull.io.tables.stability import stability_document, stability_text

    hull = open_hull(arguments.hull)
    with progress("heeling"):
        found = _cross(hull, arguments) if arguments.cross else _condition(hull, arguments)
    saved = _saved(found, arguments)
    words = "\n".join([stability_text(found).rstrip(), *(f"written: {each}" for each in saved)])
    emit(arguments, stability_document(found) | {"saved": saved}, words)
    return 0


def _check(arguments: argparse.Namespace) -> None:
    """Refuse, before anything is computed, what could not be done."""
    if arguments.out is not None:
        check_target(arguments.out, _FILES)
        # What is written must not go over the hull.
        check_other_target(arguments.out, arguments.hull)
    if arguments.plot is not None:
        check_target(arguments.plot, PICTURE_ENDINGS)
    # KN is about the keel: cross curves need no centre of gravity.
    if arguments.kg is None and not arguments.cross:
        raise BadInputError(
            "--kg is not given", _CALL,
            "give the centre of gravity by --kg, m above the base line, or ask for --cross",
        )  # fmt: skip
    # --flooding may be given again, so it is an empty list if not given: hence `or None`.
    wrong: dict[str, Any] = {}
    if arguments.cross:
        # Cross curves are of no condition: draughts come with --cross itself.
        names: tuple[str, ...] = ("draught", "draughts", "weight", "lcg", "tcg")
        wrong = {name: getattr(arguments, name) for name in names} | {
            "flooding": arguments.flooding or None
        }
    elif arguments.rest:
        # Position and heel are what --rest looks for, and it makes no table to write or draw.
        names = ("draught", "draughts", "heels", "trim", "out", "plot")
        wrong = {name: getattr(arguments, name) for name in names} | {
            "flooding": arguments.flooding or None
        }
        if arguments.weight is None or arguments.lcg is None:
            remedy = "give both: rest is that of a weight and its centre"
            raise BadInputError("--rest is given without --weight and --lcg", _CALL, remedy)
    kind = "--cross" if arguments.cross else "--rest"
    for name in (name for name, value in wrong.items() if value is not None):
        raise BadInputError(f"--{name} is given with {kind}", _CALL, "leave one of them out")


def _terms(arguments: argparse.Namespace) -> dict[str, Any]:
    return {
        "rho": density_of(arguments), "shell_factor": arguments.shell_factor,
        "appendages": appendages_of(arguments), "on_error": arguments.on_error,
    }  # fmt: skip


def _table(arguments: argparse.Namespace) -> dict[str, Any]:
    """Give what both tables need."""
    found = _terms(arguments) | {"trim": arguments.trim or "fixed", "kg": arguments.kg}
    found["date"] = datetime.date.today().isoformat()
    if arguments.heels is not None:
        found["heels"] = number_range(arguments.heels, "--heels", "heels")
    return found


def _condition(hull: Hull, arguments: argparse.Namespace) -> Stability:
    from assoc_hull.analysis.stability.stability_report import stability

    return stability(
        hull, weight=arguments.weight, draught=arguments.draught,
        draughts=None if arguments.draughts is None else tuple(arguments.draughts),
        lcg=arguments.lcg, tcg=arguments.tcg or 0.0,
        flooding=tuple(map(opening, arguments.flooding)), **_table(arguments),
    )  # fmt: skip


def _cross(hull: Hull, arguments: argparse.Namespace) -> CrossCurves:
    from assoc_hull.analysis.stability.cross_curves import cross_curves

    return cross_curves(
        hull, draughts=number_range(arguments.cross, "--cross"), **_table(arguments)
    )


def _rest(arguments: argparse.Namespace) -> int:
    """Tell where she comes to rest."""
    from assoc_hull.analysis.stability.equilibrium import equilibrium
    from assoc_hull.io.tables.stability import equilibrium_document

    hull = open_hull(arguments.hull)
    with progress("heeling"):
        found = equilibrium(
            hull, arguments.weight, lcg=arguments.lcg, tcg=arguments.tcg or 0.0, kg=arguments.kg,
            **_terms(arguments),
        )  # fmt: skip
    at = found.position
    lines = [
        f"rests    {found.kind}",
        f"T_A      {at.draught_aft:.4f} m",
        f"T_F      {at.draught_fore:.4f} m",
        f"heel     {at.heel_deg:.4f} deg, + starboard down",
        f"GM       {found.gm:.4f} m at rest, {found.gm_upright:.4f} m upright",
        *(f"note: {note}" for note in found.notes),
    ]
    emit(arguments, equilibrium_document(found), "\n".join(lines))
    return 0


def opening(text: str) -> FloodingPoint:
    """Take an opening, ``NAME,X,Y,Z``."""
    from assoc_hull.analysis.stability.flooding import FloodingPoint

    name, *rest = (part.strip() for part in text.split(","))
    try:
        x, y, z = map(float, rest)
    except ValueError:
        what, remedy = f"the opening is {text!r}", "give NAME,X,Y,Z in m"
        raise BadInputError(what, "in --flooding", remedy) from None
    return FloodingPoint(name, (x, y, z))


def _saved(found: Stability | CrossCurves, arguments: argparse.Namespace) -> list[str]:
    """Write table and picture, where they were asked; name the files."""
    saved: list[Path] = []
    if arguments.out is not None:
        from assoc_hull.io.tables.stability import write_stability

        write_stability(found, arguments.out)
        saved.append(arguments.out)
    if arguments.plot is not None:
        from assoc_hull.plot.diagrams.stability import plot_stability

        with progress(f"drawing {arguments.plot}"):
            plot_stability(found, arguments.plot)
        saved.append(arguments.plot)
    return [str(each) for each in saved]
