"""The command that estimates the resistance of a hull in calm water."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from assoc_hull.cli.arguments import (
    Commands,
    add_command,
    add_density,
    add_draughts,
    add_hull,
    add_json,
    density_of,
    number_range,
)
from assoc_hull.cli.output import emit, progress
from assoc_hull.cli.problems import check_other_target, check_target
from assoc_hull.errors import BadInputError
from assoc_hull.hull.sources import open as open_hull

__all__ = ["add_resistance"]

_ENDINGS = (".txt", ".csv", ".xlsx", ".json")

_STATED = {
    "c_stern": ("C", "-25 pram with gondola, -10 V-shaped, 0 normal (default), 10 U-shaped"),
    "appendage_area": ("S", "wetted surface of all appendages, m2"),
    "appendage_factor": ("K", "1 + k2 of them, with --appendage-area"),
    "thruster_diameter": ("D", "of the opening of a bow thruster, m"),
    "thruster_coefficient": ("C", "0.003 to 0.012, with --thruster-diameter"),
    "wetted_surface": ("S", "of the bare hull, m2 (default: measured)"),
    "entrance_deg": ("DEG", "half angle of entrance (default: by the regression)"),
    "bulb_area": ("A", "of the section of the bulb at FP, m2 (default: measured)"),
    "bulb_height": ("Z", "of its centre above base, m (default: measured)"),
    "transom_area": ("A", "immersed at rest, m2 (default: measured)"),
    "nu": ("NU", "kinematic viscosity, m2/s (default: salt water of 15 degrees)"),
    "roughness": ("K", "of the shell, m (default: 150e-6)"),
}
"""What may be stated beside the hull, by the argument of `Hull.resistance`."""


def add_resistance(commands: Commands) -> None:
    """Add ``resistance``."""
    parser = add_command(
        commands, "resistance",
        _resistance,
        """assoc-hull resistance ship.hull --speeds 12 13 14.5
        assoc-hull resistance ship.hull --speeds 12:16:0.5 --c-stern 10 -o resistance.csv
        assoc-hull resistance ship.hull --speeds 14 --draughts 9.5 7.2 --json
        assoc-hull resistance ship.hull --speeds 14 --appendage-area 80 --appendage-factor 1.4""",
    )  # fmt: skip
    add_hull(parser)
    parser.add_argument(
        "--speeds", nargs="+", required=True, metavar="KN",
        help="speeds, kn: numbers, or FROM:TO:STEP",
    )  # fmt: skip
    parser.add_argument(
        "--method", choices=("1984", "1982"), default="1984", help="the paper (default: 1984)"
    )
    add_draughts(parser)
    add_density(parser)
    for name, (metavar, about) in _STATED.items():
        option = f"--{name.replace('_', '-')}"
        parser.add_argument(option, type=float, metavar=metavar, help=about)
    parser.add_argument(
        "-o", "--out", type=Path, metavar="FILE", help="a .txt, .csv, .xlsx or .json file"
    )
    add_json(parser)


def _resistance(arguments: argparse.Namespace) -> int:
    from assoc_hull.io.tables.resistance import resistance_document, write_resistance

    if arguments.out is not None:
        check_target(arguments.out, _ENDINGS)
        check_other_target(arguments.out, arguments.hull)
    speeds = [each for text in arguments.speeds for each in _speeds(text)]
    given = {name: getattr(arguments, name) for name in _STATED}
    stated: dict[str, Any] = {name: value for name, value in given.items() if value is not None}
    hull = open_hull(arguments.hull)
    with progress("measuring"):
        found = hull.resistance(
            speeds, method=arguments.method, draught=arguments.draught,
            draughts=arguments.draughts, rho=density_of(arguments), **stated,
        )  # fmt: skip
    words, saved = str(found), []
    if arguments.out is not None:
        write_resistance(found, arguments.out)
        saved.append(str(arguments.out))
    words += "".join(f"\nwritten: {each}" for each in saved)
    emit(arguments, resistance_document(found) | {"saved": saved}, words)
    return 0


def _speeds(text: str) -> list[float]:
    """Take a speed, or speeds from and to, kn."""
    if ":" in text:
        return number_range(text, "--speeds", "speeds")
    try:
        return [float(text)]
    except ValueError:
        remedy = "give numbers, kn, or FROM:TO:STEP"
        raise BadInputError(f"a speed is {text!r}", "in --speeds", remedy) from None
