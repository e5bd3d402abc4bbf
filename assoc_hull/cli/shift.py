"""The commands that shift the sections of a hull, and that swing it."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from assoc_hull.cli.arguments import Commands, add_command, add_hull
from assoc_hull.cli.output import emit
from assoc_hull.cli.pairs import pairs
from assoc_hull.cli.varied import add_out, told_if_refused, varied_into
from assoc_hull.cli.words import edit_words

if TYPE_CHECKING:
    from assoc_hull.hull import Hull
    from assoc_hull.shifts import Shifted

__all__ = ["add"]

_SHAPES = ("c1", "c2", "end", "half", "lackenby", "1-cp")


def add(commands: Commands) -> None:
    """Add ``shift`` and ``swing``."""
    _add_shift(commands)
    _add_swing(commands)


def _add_shift(commands: Commands) -> None:
    parser = add_command(
        commands, "shift", "shift sections along the ship for another block or prismatic "
        "coefficient and centre of buoyancy; exit 1 if it is refused", _shift,
        """assoc-hull shift ship.hull --by cb=0.02 --by lcb_percent=0.5 -o fuller.hull
        assoc-hull shift ship.hull --to cp=0.72 --shape lackenby --json
        assoc-hull shift ship.hull --by Cpf=0.01 --terminals 0 60.96 67.056 121.92
        assoc-hull shift ship.hull --by parallel_body_end=3

        Values: cb, cp or volume (m3); lcb (m from AP) or lcb_percent (% Lpp from midship); or
        Cpf and Cpa, each on its own; parallel_body_start and parallel_body_end (m from AP).
        What is not named is held.""",
    )  # fmt: skip
    add_hull(parser)
    parser.add_argument(
        "--to", metavar="NAME=VALUE", action="append", default=[],
        help="a value that is to be had; may be given more than once",
    )  # fmt: skip
    parser.add_argument(
        "--by", metavar="NAME=CHANGE", action="append", default=[],
        help="a change of a present value; may be given more than once",
    )  # fmt: skip
    parser.add_argument(
        "--shape", choices=_SHAPES, default="c2",
        help="how the movement rises and falls between parallel body and end (default: c2)",
    )  # fmt: skip
    parser.add_argument(
        "--terminals", metavar="M", nargs=4, type=float,
        help="after terminal, start and end of the parallel body, fore terminal, m from AP "
        "(default: as measured)",
    )  # fmt: skip
    parser.add_argument(
        "--fade", choices=("b5", "linear"), default="b5",
        help="how the movement of an end of the parallel body fades out (default: b5)",
    )  # fmt: skip
    parser.add_argument(
        "--tolerance", type=float, metavar="M", default=2e-3,
        help="how far a line may leave its exact image, m (default: 0.002)",
    )  # fmt: skip
    add_out(parser)


def _add_swing(commands: Commands) -> None:
    parser = add_command(
        commands, "swing", "change breadth against draught, or length against both, at the same "
        "volume and coefficients; exit 1 if it is refused", _swing,
        """assoc-hull swing ship.hull --breadth 18.5 -o broader.hull
        assoc-hull swing ship.hull --length 125 --draught 7 --json""",
    )  # fmt: skip
    add_hull(parser)
    for name, rest in (
        ("length", "alone: breadth and draught give way in one ratio"),
        ("breadth", "alone: the draught gives way"), ("draught", "alone: the breadth gives way"),
    ):  # fmt: skip
        parser.add_argument(
            f"--{name}", type=float, metavar="M", help=f"{name} that it is to have, m; {rest}"
        )
    add_out(parser)


def _shift(arguments: argparse.Namespace) -> int:
    from assoc_hull.shifts import shift_sections

    to, by = pairs(arguments.to, "to") or None, pairs(arguments.by, "by") or None

    def act(hull: Hull) -> Shifted:
        return shift_sections(
            hull, to=to, by=by, shape=arguments.shape, terminals=arguments.terminals,
            fade=arguments.fade, tolerance=arguments.tolerance, name=arguments.name, in_place=True,
        )  # fmt: skip

    return told_if_refused(arguments, lambda: _told(arguments, "shifting sections", act))


def _swing(arguments: argparse.Namespace) -> int:
    from assoc_hull.shifts import swing

    def act(hull: Hull) -> Shifted:
        return swing(
            hull, length=arguments.length, breadth=arguments.breadth, draught=arguments.draught,
            name=arguments.name, in_place=True,
        )  # fmt: skip

    return told_if_refused(arguments, lambda: _told(arguments, "swinging", act))


def _told(arguments: argparse.Namespace, doing: str, act: Callable[[Hull], Shifted]) -> int:
    """Carry out, and tell what came of it."""
    hull, found = varied_into(arguments, doing, act)
    report, saved = found.report, str(arguments.out or arguments.hull)
    at = report.shift.terms.terminals
    facts: dict[str, Any] = {
        "targets": report.targets, "shape": report.shift.terms.shape,
        "terminals": at.places.tolist(), "fore": report.fore, "aft": report.aft,
        "largest": report.shift.largest, "least": report.shift.least, "steps": report.steps,
        "notes": report.notes, "fingerprint": hull.fingerprint, "refused": False, "saved": saved,
        "script": report.variation.script,
    }  # fmt: skip
    told = [report.variation.edit.name, *(f"  {each}" for each in report.told)]
    told += [edit_words(hull, report.variation.edit), f"written: {saved}"]
    emit(arguments, facts, "\n".join(told))
    return 0
