"""The command that varies a hull by named parameters."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from assoc_hull.arguments import shown
from assoc_hull.cli.arguments import Commands, add_command, add_hull
from assoc_hull.cli.output import emit, progress
from assoc_hull.cli.pairs import limits, pairs
from assoc_hull.cli.varied import add_out, told_if_refused, varied_into
from assoc_hull.cli.words import edit_words
from assoc_hull.errors import BadInputError
from assoc_hull.sources import open as open_hull

__all__ = ["add"]


def add(commands: Commands) -> None:
    """Add ``vary``."""
    parser = add_command(
        commands, "vary", "vary a hull by named parameters; exit 1 if it is refused", _vary,
        """assoc-hull vary ship.hull --list
        assoc-hull vary ship.hull --set shaft_height=6.0 --set bossing_radius=1.0 -o larger.hull
        assoc-hull vary ship.hull --set breadth=51.5 --stations x --json
        assoc-hull vary ship.hull --script larger_screw.json -o larger.hull
        assoc-hull vary ship.hull --reach volume=236000 --reach lcb=157 --free breadth=49:52
        --free fore_shift=-3:3 --free aft_shift -o fuller.hull

        larger_screw.json: {"set": {"shaft_height": 6.0, "bossing_radius": 1.0},
        "layout": {"stern": 0.3}, "name": "larger screw"}
        (m, or degrees where a name ends in _deg; x from AP, z from the base line)""",
    )  # fmt: skip
    add_hull(parser)
    parser.add_argument(
        "--set", metavar="NAME=VALUE", action="append", default=[],
        help="a named parameter and the value it is to have; may be given more than once",
    )  # fmt: skip
    parser.add_argument(
        "--reach", metavar="NAME=VALUE", action="append", default=[],
        help="an output and the value it is to reach, as volume, lcb or cw; more than once",
    )  # fmt: skip
    parser.add_argument(
        "--free", metavar="NAME[=LOW:HIGH]", action="append", default=[],
        help="a named parameter that may change for it, and between which values; more than once",
    )  # fmt: skip
    parser.add_argument(
        "--compromise", action="store_true",
        help="where targets are out of reach, come as near as possible",
    )  # fmt: skip
    parser.add_argument(
        "--layout", metavar="NAME=VALUE", action="append", default=[],
        help="how far the fields reach; may be given more than once",
    )  # fmt: skip
    parser.add_argument("--script", metavar="FILE.json", type=Path, help="all of it as a file")
    parser.add_argument(
        "--drivers", metavar="NAME", nargs="+",
        help="groups or lines that are carried as they are (default: all whose planes stay planes)",
    )  # fmt: skip
    parser.add_argument(
        "--stations", choices=("number", "x"), default=None,
        help="sections keep their numbers and move, or stay where they are (default: number)",
    )  # fmt: skip
    parser.add_argument(
        "--planes", choices=("follow", "stay"), default=None,
        help="waterlines and buttocks go with a map that keeps all their planes, or stay "
        "(default: follow)",
    )  # fmt: skip
    parser.add_argument(
        "--tolerance", type=float, metavar="M",
        help="how far a driver may leave its exact image, m (default: 0.002)",
    )  # fmt: skip
    parser.add_argument(
        "--list",
        action="store_true",
        help="show present values and what may be asked; write nothing",
    )
    add_out(parser)


def _vary(arguments: argparse.Namespace) -> int:
    if arguments.list:
        return _list(arguments)
    script = _script(arguments)
    return told_if_refused(arguments, lambda: _carry_out(arguments, script))


def _carry_out(arguments: argparse.Namespace, script: dict[str, Any]) -> int:
    from assoc_hull.variants import vary_by

    hull, found = varied_into(
        arguments, "varying", lambda hull: vary_by(hull, script, in_place=True)
    )
    report, saved = found.report, str(arguments.out or arguments.hull)
    facts = {
        "targets": report.targets, "rounds": report.rounds, "regions": report.regions,
        "drivers": report.drivers, "added": report.added, "fingerprint": hull.fingerprint,
        "refused": False, "saved": saved, "script": report.script, "aim": report.aim,
    }  # fmt: skip
    told = [report.edit.name, *(f"  {each}" for each in report.targets)]
    if report.aim is not None:
        told += [f"  {each}" for each in str(report.aim).splitlines()]
    told += [edit_words(hull, report.edit), f"written: {saved}"]
    emit(arguments, facts, "\n".join(told))
    return 0


def _list(arguments: argparse.Namespace) -> int:
    from assoc_hull.variation.carrying.listing import list_table, listing
    from assoc_hull.variation.parameters.layout import Layout

    layout = Layout.of(_script(arguments).get("layout"))
    hull = open_hull(arguments.hull)
    with progress("looking for what may be asked"):
        found = listing(hull.state, layout)
    emit(arguments, {"parameters": found}, list_table(found))
    return 0


def _script(arguments: argparse.Namespace) -> dict[str, Any]:
    """Put together what is asked for; options go before what the file says."""
    from assoc_hull.variation.script import read_script

    script: dict[str, Any] = read_script(arguments.script) if arguments.script else {}
    for key in ("set", "layout", "reach"):
        given = pairs(getattr(arguments, key), key)
        if given:
            script[key] = {**_held(script, key, arguments), **given}
    _reach(script, arguments)
    for key in ("drivers", "stations", "planes", "tolerance", "name"):
        value = getattr(arguments, key)
        if value is not None:
            script[key] = value
    return script


def _held(script: dict[str, Any], key: str, arguments: argparse.Namespace) -> dict[str, Any]:
    """Give what the file says by name."""
    held = script.get(key, {})
    if not isinstance(held, dict):
        raise BadInputError(
            f"{key} is {shown(held)}", f"in {arguments.script}", "give values by name"
        )
    return held


def _reach(script: dict[str, Any], arguments: argparse.Namespace) -> None:
    """Add what is free, with its bounds, to what the file says."""
    given = limits(arguments.free, "free")
    if given:
        held = script.get("free", [])
        known = list(held) if isinstance(held, list) else [held]
        script["free"] = [*known, *(name for name in given if name not in known)]
    bounds = {name: span for name, span in given.items() if span is not None}
    if bounds:
        script["bounds"] = {**_held(script, "bounds", arguments), **bounds}
    if arguments.compromise:
        script["exact"] = False
