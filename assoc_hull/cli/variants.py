"""Commands that make variants of a hull and compare them.

`vary` by named parameters or targets, `shift` and `swing` of sections, `jumboise` by a length of
parallel body, `compare` of a variant with its parent. A refused variant
leaves the hull as it is; the findings are told and the exit code is 1.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import attrs

from assoc_hull.arguments import shown
from assoc_hull.cli.arguments import (
    Commands,
    add_command,
    add_hull,
    add_json,
    add_replace,
    add_screw,
    add_wait,
    metres,
    parse_limits,
    parse_pairs,
    screw_of,
)
from assoc_hull.cli.edits import open_to_change
from assoc_hull.cli.hull_words import edit_words
from assoc_hull.cli.output import emit, progress
from assoc_hull.cli.problems import UsageError, check_other_target, check_target
from assoc_hull.errors import AssocHullError, BadInputError, RefusedEditError
from assoc_hull.hull import Hull
from assoc_hull.hull.sources import open as open_hull

if TYPE_CHECKING:
    from assoc_hull.hull.variants import Jumboised, Shifted, Variation
    from assoc_hull.variation.faired_followers import FairedFollowers
    from assoc_hull.variation.vary import VariationReport

__all__ = [
    "add_compare",
    "add_out",
    "add_shift_and_swing",
    "add_vary",
    "report_refusal",
    "vary_into_file",
]

# --------------------------------------------------------------------------------------
# What commands that make a variant share: where it goes, how it is made, what a refusal says.

Done = TypeVar("Done")


def add_out(parser: argparse.ArgumentParser) -> None:
    """Add the name of the step, and where the variant goes."""
    parser.add_argument("--name", help="name of the step in the history")
    parser.add_argument(
        "-o", "--out", metavar="OUT", type=Path, help="where to write the hull (default: HULL)"
    )
    add_wait(parser)
    add_replace(parser)
    add_json(parser)


def vary_into_file(
    arguments: argparse.Namespace, doing: str, act: Callable[[Hull], Done]
) -> tuple[Hull, Done]:
    """Open the hull, vary it in place, and write it where it is to go.

    Parameters
    ----------
    arguments : Namespace
        With those of `add_out` and the hull.
    doing : str
        What is done, for who waits.
    act : callable
        Varies the hull in place.
    """
    changed = open_to_change(arguments)
    hull = changed.hull
    with progress(doing):
        found = act(hull)
    changed.save()
    return hull, found


def report_refusal(arguments: argparse.Namespace, run: Callable[[], int]) -> int:
    """Run what may be refused; then tell the findings, and exit with 1."""
    try:
        return run()
    except RefusedEditError as error:
        facts = {"refused": True, "edit": error.edit, "findings": error.findings, "saved": None}
        emit(arguments, facts, "\n".join(error.findings))
        what = "would be refused" if getattr(arguments, "dry_run", False) else "refused"
        print(f"{what}: {error.edit!r}; the hull is unchanged", file=sys.stderr)
        return 1


# --------------------------------------------------------------------------------------
# The command that varies a hull by named parameters.


def add_vary(commands: Commands) -> None:
    """Add ``vary``."""
    parser = add_command(
        commands, "vary", _vary,
        """assoc-hull vary ship.hull --list
        assoc-hull vary ship.hull --set shaft_height=6.0 --set bossing_radius=1.0 -o larger.hull
        assoc-hull vary ship.hull breadth=51.5 --stations x --json
        assoc-hull vary ship.hull breadth=51.5 --dry-run
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
        help="a named parameter and the value it is to have; several times, or without --set",
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
        "--ship", metavar="NAME",
        help="what the variant in OUT is called (default: as her parent, with what was asked for)",
    )  # fmt: skip
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
        "--fair", type=float, metavar="M", nargs="?", const=True,
        help="let points that moved move once more, so that lines get no new changes of curvature "
        "sign; how far at most, m (without a number: 0.02)",
    )  # fmt: skip
    parser.add_argument(
        "--accept", action="store_true",
        help="take a hull as well whose lines come to bend as no one would have it",
    )  # fmt: skip
    parser.add_argument(
        "--list",
        action="store_true",
        help="show present values and what may be asked; write nothing",
    )
    parser.add_argument(
        "--dry-run", action="store_true",
        help="tell what would change: values, lines by their movement along the normal, lines that "
        "are less fair, hydrostatics; write nothing",
    )  # fmt: skip
    add_out(parser)


def _vary(arguments: argparse.Namespace) -> int:
    if arguments.list:
        return _list(arguments)
    script = _script(arguments)
    act = _try if arguments.dry_run else _carry_out
    return report_refusal(arguments, lambda: act(arguments, script))


def _try(arguments: argparse.Namespace, script: dict[str, Any]) -> int:
    """Tell what the variation would change; nothing is written."""
    from assoc_hull.variation.comparing.comparison import change_words, comparison_document

    hull = open_hull(arguments.hull)
    with progress("varying"):
        varied = hull.vary_by(script, ship=arguments.ship)
    with progress("comparing"):
        changes = hull.compare(varied.hull)
    facts = _variation_facts(varied.report, varied.hull.fingerprint, None)
    told = [*_variation_words(varied.report), *(f"  {each}" for each in change_words(changes))]
    emit(
        arguments, facts | {"comparison": comparison_document(changes)},
        "\n".join([*(each.rstrip() for each in told), "nothing written"]),
    )  # fmt: skip
    return 0


def _carry_out(arguments: argparse.Namespace, script: dict[str, Any]) -> int:
    afloat = list[_Afloat | None]()

    def act(hull: Hull) -> Variation[Hull]:
        afloat.append(_Afloat.of(hull))
        return hull.vary_by(script, ship=_ship(arguments, script, hull), in_place=True)

    hull, found = vary_into_file(arguments, "varying", act)
    report, saved = found.report, str(arguments.out or arguments.hull)
    told = [
        *_variation_words(report), *_afloat_words(afloat[0], _Afloat.of(hull)),
        edit_words(hull, report.edit), f"written: {saved}",
    ]  # fmt: skip
    emit(arguments, _variation_facts(report, hull.fingerprint, saved), "\n".join(told))
    return 0


def _variation_facts(
    report: VariationReport, fingerprint: str, saved: str | None
) -> dict[str, Any]:
    return {
        "targets": report.targets, "rounds": report.rounds, "regions": report.regions,
        "drivers": report.drivers, "added": report.added, "fingerprint": fingerprint,
        "refused": False, "saved": saved, "script": report.script, "aim": report.aim,
        "faired": _faired(report.faired), "notes": report.notes,
    }  # fmt: skip


def _variation_words(report: VariationReport) -> Iterator[str]:
    """Say what the values were and have become."""
    yield report.edit.name
    yield from (f"  {each}" for each in report.targets)
    if report.aim is not None:
        yield from (f"  {each}" for each in str(report.aim).splitlines())
    if report.faired is not None:
        yield f"  {report.faired}"
    yield from (f"  {each}" for each in report.notes)


@attrs.frozen
class _Afloat:
    """What a designer asks first of a variant: volume (m3) and LCB (m from AP), upright."""

    volume: float
    lcb: float

    @classmethod
    def of(cls, hull: Hull) -> _Afloat | None:
        """Measure a hull at its design draught; None where it has no hydrostatics."""
        with suppress(AssocHullError):
            found = hull.hydrostatics(estimate=False)
            return cls(found.volume, found.lcb)
        return None


def _afloat_words(before: _Afloat | None, after: _Afloat | None) -> Iterator[str]:
    """Say how both have changed: also where neither was asked for, both do."""
    if before is not None and after is not None:
        change = 100 * (after.volume / before.volume - 1)
        yield (
            f"  afloat: volume {before.volume:.6g} -> {after.volume:.6g} m3 ({change:+.2f} %), "
            f"lcb {before.lcb:.6g} -> {after.lcb:.6g} m"
        )


def _ship(arguments: argparse.Namespace, script: dict[str, Any], hull: Hull) -> str | None:
    """Give what the variant is called; in the file of the parent the name stays."""
    from assoc_hull.variation.request import request_from_data
    from assoc_hull.variation.vary import variant_name

    if arguments.ship is not None or arguments.out is None:
        ship: str | None = arguments.ship
        return ship
    return variant_name(hull.particulars.name, request_from_data(script))


def _list(arguments: argparse.Namespace) -> int:
    from assoc_hull.variation.carrying.admissible_values import list_parameters, parameter_table
    from assoc_hull.variation.parameters.field_layout import Layout

    layout = Layout.of(_script(arguments).get("layout"))
    hull = open_hull(arguments.hull)
    with progress("looking for what may be asked"):
        found = list_parameters(hull.state, layout)
    emit(arguments, {"parameters": found}, parameter_table(found))
    return 0


def _faired(found: FairedFollowers | None) -> dict[str, Any] | None:
    """Give what fairing has done, without the moves of all points."""
    if found is None:
        return None
    return attrs.asdict(found, filter=lambda field, _: field.name != "steps")


_OPTIONS = ("stations", "planes", "drivers", "tolerance", "fair", "name", "ship")
"""What is no parameter of the form, and is an option of its own."""


def _refuse_words(given: Mapping[str, Any], option: str) -> None:
    """Refuse values that are no numbers as they are typed: with a comma, or with another unit."""
    for name, value in given.items():
        if name in _OPTIONS:
            raise UsageError(f"--{option} {name}={value}: write --{name} {value}")
        if isinstance(value, str):
            length = option == "set" and not name.endswith("_deg")
            unit = "in m, or one with mm, cm or m behind it" if length else "without a unit"
            raise UsageError(
                f"--{option} {name}={value}: '{value}' is no number; give one {unit}, with a point "
                "where it has decimals"
            )


def _script(arguments: argparse.Namespace) -> dict[str, Any]:
    """Put together what is asked for; options go before what the file says."""
    from assoc_hull.variation.request import read_script

    script: dict[str, Any] = read_script(arguments.script) if arguments.script else {}
    for key in ("set", "layout", "reach"):
        typed = getattr(arguments, key)
        given = parse_pairs(typed, key)
        if key == "set":
            _require_values(typed)
        if key != "layout":
            _refuse_words(given, key)
        if given:
            script[key] = {**_held(script, key, arguments), **given}
    _reach(script, arguments)
    for key in ("drivers", "stations", "planes", "tolerance", "fair", "name"):
        value = getattr(arguments, key)
        if value is not None:
            script[key] = value
    if arguments.accept:
        script["accept"] = True
    return script


def _require_values(typed: Sequence[str]) -> None:
    """Refuse ``breadth=+1``: it looks like a change, and values are asked for."""
    for each in typed:
        name, _, value = each.partition("=")
        if value.startswith("+"):
            raise UsageError(
                f"--set {each}: {name} takes the new value itself, not a change; add the change "
                f"to the present value, or write {name}={value[1:]} if that is the value meant"
            )


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
    given = parse_limits(arguments.free, "free")
    if given:
        held = script.get("free", [])
        known = list(held) if isinstance(held, list) else [held]
        script["free"] = [*known, *(name for name in given if name not in known)]
    bounds = {name: span for name, span in given.items() if span is not None}
    if bounds:
        script["bounds"] = {**_held(script, "bounds", arguments), **bounds}
    if arguments.compromise:
        script["exact"] = False


# --------------------------------------------------------------------------------------
# The commands that shift the sections of a hull, that swing it, and that cut it open.

_SHAPES = ("c1", "c2", "end", "half", "lackenby", "1-cp")


def add_shift_and_swing(commands: Commands) -> None:
    """Add ``shift``, ``swing`` and ``jumboise``."""
    _add_shift(commands)
    _add_swing(commands)
    _add_jumboise(commands)


def _add_shift(commands: Commands) -> None:
    parser = add_command(
        commands, "shift", _shift,
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
        "--terminals", metavar="M", nargs=4, type=metres,
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
        commands, "swing", _swing,
        """assoc-hull swing ship.hull --breadth 18.5 -o broader.hull
        assoc-hull swing ship.hull --length 125 --draught 7 --json""",
    )  # fmt: skip
    add_hull(parser)
    for name, rest in (
        ("length", "alone: breadth and draught give way in one ratio"),
        ("breadth", "alone: the draught gives way"), ("draught", "alone: the breadth gives way"),
    ):  # fmt: skip
        parser.add_argument(
            f"--{name}", type=metres, metavar="M", help=f"{name} that it is to have, m; {rest}"
        )
    add_out(parser)


def _add_jumboise(commands: Commands) -> None:
    parser = add_command(
        commands, "jumboise", _jumboise,
        """assoc-hull jumboise ship.hull 12 -o longer.hull
        assoc-hull jumboise ship.hull 30 --at 150 --names number --json
        assoc-hull jumboise ship.hull -15""",
    )  # fmt: skip
    add_hull(parser)
    parser.add_argument(
        "length", type=metres, metavar="M", help="to insert, m; below 0: to take out"
    )
    parser.add_argument(
        "--at", type=metres, metavar="X",
        help="where to cut, m from AP: the nearest section of the parallel body is taken "
        "(default: that nearest to its middle)",
    )  # fmt: skip
    parser.add_argument(
        "--names", choices=("keep", "number"), default="keep",
        help="sections keep their names, or are numbered by the new length (default: keep)",
    )  # fmt: skip
    add_out(parser)


def _shift(arguments: argparse.Namespace) -> int:

    to, by = parse_pairs(arguments.to, "to") or None, parse_pairs(arguments.by, "by") or None

    def act(hull: Hull) -> Shifted[Hull]:
        return hull.shift_sections(
            to=to, by=by, shape=arguments.shape, terminals=arguments.terminals,
            fade=arguments.fade, tolerance=arguments.tolerance, name=arguments.name, in_place=True,
        )  # fmt: skip

    return report_refusal(arguments, lambda: _told(arguments, "shifting sections", act))


def _swing(arguments: argparse.Namespace) -> int:

    def act(hull: Hull) -> Shifted[Hull]:
        return hull.swing(
            length=arguments.length, breadth=arguments.breadth, draught=arguments.draught,
            name=arguments.name, in_place=True,
        )  # fmt: skip

    return report_refusal(arguments, lambda: _told(arguments, "swinging", act))


def _jumboise(arguments: argparse.Namespace) -> int:

    def act(hull: Hull) -> Jumboised[Hull]:
        return hull.jumboise(
            arguments.length, arguments.at, names=arguments.names, name=arguments.name,
            in_place=True,
        )  # fmt: skip

    def run() -> int:
        hull, found = vary_into_file(arguments, "jumboising", act)
        report, saved = found.report, str(arguments.out or arguments.hull)
        facts: dict[str, Any] = {
            key: getattr(report, key)
            for key in ("length", "at", "section", "area", "volume", "lcb", "moved_off", "added",
                        "removed", "renamed", "notes")
        } | {"fingerprint": hull.fingerprint, "refused": False, "saved": saved}  # fmt: skip
        told = [report.edit.name, *(f"  {each}" for each in report.told)]
        told += [edit_words(hull, report.edit), f"written: {saved}"]
        emit(arguments, facts, "\n".join(told))
        return 0

    return report_refusal(arguments, run)


def _told(arguments: argparse.Namespace, doing: str, act: Callable[[Hull], Shifted[Hull]]) -> int:
    """Carry out, and tell what came of it."""
    hull, found = vary_into_file(arguments, doing, act)
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


# --------------------------------------------------------------------------------------
# The command that compares a variant with its parent.


def add_compare(commands: Commands) -> None:
    """Add ``compare``."""
    parser = add_command(
        commands, "compare", _compare,
        """assoc-hull compare parent.hull variant.hull
        assoc-hull compare parent.hull variant.hull --draught 16.5 --lines 50
        assoc-hull compare parent.hull variant.hull --pdf comparison.pdf --json""",
    )  # fmt: skip
    for name in ("parent", "variant"):
        parser.add_argument(
            name, metavar=name.upper(), type=Path, help="a .hull or .hull.json file"
        )
    parser.add_argument(
        "--draught", type=metres, metavar="T",
        help="moulded, even keel, for the numbers of both, m (default: the design draught of each)",
    )  # fmt: skip
    add_screw(parser)
    parser.add_argument(
        "--lines", type=int, default=10, metavar="N",
        help="list so many lines, those that moved farthest (default: 10)",
    )  # fmt: skip
    parser.add_argument(
        "--pdf", type=Path, metavar="FILE", help="both lines plans and all tables, a .pdf file"
    )
    add_json(parser)


def _compare(arguments: argparse.Namespace) -> int:
    from assoc_hull.arguments import integer
    from assoc_hull.variation.comparing.comparison import (
        compare,
        comparison_document,
        comparison_text,
    )

    integer(arguments.lines, "lines", "in --lines", least=0)
    screw = screw_of(arguments)
    _check_target(arguments)
    parent, variant = open_hull(arguments.parent), open_hull(arguments.variant)
    with progress("comparing"):
        found = compare(parent, variant, draught=arguments.draught, screw=screw)
    saved: list[str] = []
    if arguments.pdf is not None:
        from assoc_hull.io.write_file import write_whole
        from assoc_hull.plot.lines_plan.comparison import comparison_pdf

        with progress(f"writing {arguments.pdf}"):
            write_whole(arguments.pdf, comparison_pdf(parent, variant, found))
        saved.append(str(arguments.pdf))
    words = [comparison_text(found, arguments.lines), *(f"written: {each}" for each in saved)]
    emit(arguments, comparison_document(found) | {"saved": saved}, "\n".join(words))
    return 0


def _check_target(arguments: argparse.Namespace) -> None:
    """Refuse, before anything is computed, what could not be written."""
    if arguments.pdf is not None:
        check_target(arguments.pdf, (".pdf",))
        for hull in (arguments.parent, arguments.variant):
            check_other_target(arguments.pdf, hull)
