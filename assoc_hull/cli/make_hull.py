"""Commands that make a hull: `example`, `import`, `create`, `classical`.

A hull ships with the program, or is read from offsets, meshes, surfaces or lines, or is made
from a design by form parameters or from a classical definition. Each checks where the hull is
to go before it works, writes it, and tells what was adopted.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Any

import attrs

from assoc_hull.arguments import regular_file
from assoc_hull.cli.arguments import (
    PICTURE_ENDINGS,
    Commands,
    add_command,
    add_json,
    add_replace,
    metres,
)
from assoc_hull.cli.hull_words import hull_words, import_words
from assoc_hull.cli.output import emit, plain, progress, progress_bar, say
from assoc_hull.cli.problems import (
    FILE_ENDING,
    UsageError,
    check_hull_target,
    check_target,
    is_apart,
)
from assoc_hull.errors import BadInputError, NotSoundError
from assoc_hull.hull import Hull
from assoc_hull.hull.sources import create, examples, imported_hull, read_classical
from assoc_hull.hull.sources import open as open_hull
from assoc_hull.io.hull_file.saving import holds_hull
from assoc_hull.io.importing.import_hull import ImportReport
from assoc_hull.io.importing.options import ImportOptions
from assoc_hull.io.importing.verdict import Verdict, refused_findings, require_sound
from assoc_hull.io.reports import Tell
from assoc_hull.model.tables import DECKS

__all__ = [
    "add_classical",
    "add_create",
    "add_example_and_import",
]

# --------------------------------------------------------------------------------------
# Commands that make a hull: one that ships (or plates that do), or one from a table of offsets.

_EXAMPLES = {
    "wigley": lambda: examples.wigley(),
    "series60-060": lambda: examples.series60(0.60),
    "series60-070": lambda: examples.series60(0.70),
    "bulk-carrier-207k": lambda: examples.bulk_carrier_207k(),
    "bulk-carrier-180m": lambda: examples.bulk_carrier_180m(),
    "container-ship-225m": lambda: examples.container_ship_225m(),
    "plain-ship": lambda: examples.plain_ship(),
    "seaking-ship": lambda: examples.seaking_ship(),
    "sfolds-ship": lambda: examples.sfolds_ship(),
    "prelikon-ship": lambda: examples.prelikon_ship(),
}
_SURFACES = {"typical-plates": lambda: examples.typical_plates()}
_SURFACE_ENDINGS = (".csv", ".json", ".igs", ".iges")


def add_example_and_import(commands: Commands) -> None:
    """Add ``example`` and ``import``."""
    _add_example(commands)
    _add_import(commands)


def _add_example(commands: Commands) -> None:
    parser = add_command(
        commands, "example", _example,
        """assoc-hull example series60-070 -o ship.hull
        assoc-hull example typical-plates -o plates.csv""",
    )  # fmt: skip
    names = (*_EXAMPLES, *_SURFACES)
    parser.add_argument("name", metavar="NAME", choices=names, help=", ".join(names))
    _add_target(parser)
    add_json(parser)


class _Units(tuple[str, ...]):
    """Words for a unit, of which several may stand with commas."""

    __slots__ = ()

    def __contains__(self, word: object) -> bool:
        return all(tuple.__contains__(self, each) for each in str(word).split(","))


def _add_import(commands: Commands) -> None:
    parser = add_command(
        commands, "import", _import,
        """assoc-hull import offsets.csv -o ship.hull
        assoc-hull import ship.hull.json -o ship.hull
        assoc-hull import hull.stl -o ship.hull --scale 59.407 --stations 41
        assoc-hull import hull.stl -o ship.hull --report report.json --picture report.pdf
        assoc-hull import ship.step -o ship.hull --draught 8.5
        assoc-hull import sections.bri -o ship.hull
        assoc-hull import offsets.csv -o ship.hull --unit mm --draught 8.5
        assoc-hull import offsets.csv -o ship.hull --station-zero fp --report report.json""",
    )  # fmt: skip
    parser.add_argument(
        "file",
        metavar="FILE",
        type=Path,
        nargs="?",
        help="CSV, TSV, XLSX, STL, OBJ, PLY, IGES, STEP, Rhino (.3dm), DXF, BRITFAIR (.bri), "
        "DELFTship (.txt), GHS (.gf), a text of a classical definition, or a saved hull (.hull, "
        ".hull.json)",
    )
    _add_target(parser, required=False)
    parser.add_argument(
        "--template", metavar="TABLE.csv", type=Path,
        help="write a table of offsets to fill in, with comments; it imports as it stands",
    )  # fmt: skip
    for name, what in (
        ("length", "length between perpendiculars"), ("breadth", "moulded breadth"),
        ("draught", "design draught"), ("depth", "depth to the deck edge amidships"),
        ("draught-aft", "design draught at the AP, with --draught-fwd"),
        ("draught-fwd", "design draught at the FP"),
        ("frame-spacing", "of a table: distance of frames, if its stations are frame numbers"),
    ):  # fmt: skip
        parser.add_argument(f"--{name}", type=metres, metavar="M", help=f"{what}, m")
    for name, what in (
        ("ap", "x of the aft perpendicular"), ("fp", "x of the forward perpendicular"),
        ("base", "height of the base line"), ("waterline", "height of the design waterline"),
        ("centre", "y of the centre plane, of one of two hulls too"),
    ):  # fmt: skip
        parser.add_argument(
            f"--{name}", metavar="X", help=f"{what}, in units of the file, or as 12.5m"
        )
    parser.add_argument(
        "--origin", choices=("ap", "midship", "fp"), help="where x = 0 of the file is"
    )
    parser.add_argument(
        "--deck", choices=DECKS,
        help="closed: a deck lies between the deck edges; open by default",
    )  # fmt: skip
    units = _Units(("auto", "m", "mm", "cm", "ft", "in", "normalised"))
    parser.add_argument(
        "--unit", choices=units, default="auto",
        help="of the numbers in the file; of a table also mm,m: half-breadths in mm, the rest in m",
    )  # fmt: skip
    for name, count in (("stations", 41), ("waterlines", 20), ("buttocks", 12)):
        parser.add_argument(
            f"--{name}", type=_places, metavar="N",
            help=f"of a mesh, surfaces: how many {name}, or places in m, as 1,2.5; else {count}",
        )  # fmt: skip
    parser.add_argument(
        "--scale", type=float, metavar="S", help="of a mesh, surfaces: full over model scale"
    )
    parser.add_argument(
        "--axes", metavar="AXES", help="of a mesh, surfaces: forward, port, up, as +x+y+z"
    )
    parser.add_argument(
        "--tolerance", type=float, metavar="M", help="of a mesh or lines: adopted within this, m"
    )
    parser.add_argument(
        "--join", type=float, metavar="M",
        help="of a mesh or lines: loose ends this close are joined, m; 0.06 by default",
    )  # fmt: skip
    parser.add_argument(
        "--station-zero", choices=("auto", "ap", "fp"), default="auto",
        help="perpendicular of station 0",
    )  # fmt: skip
    parser.add_argument(
        "--station-spacings", type=int, metavar="N",
        help="of a table: station spacings between the perpendiculars, 10 or 20 or others",
    )  # fmt: skip
    parser.add_argument(
        "--deck-edge", metavar="LINE",
        help="of lines: the one that is the deck edge, where bulwarks stand above it",
    )  # fmt: skip
    parser.add_argument(
        "--accept", action="store_true", help="take a hull that is not sound; exit code 0"
    )
    parser.add_argument(
        "--strict", action="store_true", help="refuse a hull under suspicion too; exit code 3"
    )
    parser.add_argument(
        "--report", metavar="FILE", type=Path, help="write all assumptions and deviations as JSON"
    )
    parser.add_argument(
        "--picture", metavar="FILE", type=Path,
        help="draw the deviations of all lines, and where they are: .pdf, .svg or .png",
    )  # fmt: skip
    add_json(parser)


def _add_target(parser: argparse.ArgumentParser, *, required: bool = True) -> None:
    parser.add_argument(
        "-o", "--out", metavar="HULL", type=Path, required=required,
        help="the hull to write: .hull keeps the history, .hull.json is text",
    )  # fmt: skip
    add_replace(parser)


def _example(arguments: argparse.Namespace) -> int:
    if arguments.name in _SURFACES:
        return _example_surfaces(arguments)
    check_hull_target(arguments.out, replace=arguments.replace)
    with progress(f"making {arguments.name}"):
        hull = _EXAMPLES[arguments.name]()
    hull.save(arguments.out, replace=arguments.replace)
    _tell(arguments, hull, {}, "")
    return 0


def _example_surfaces(arguments: argparse.Namespace) -> int:
    """Write surfaces: control nets as a table or JSON, or IGES."""
    from assoc_hull.io.surfaces.surface_file import write_surfaces

    check_target(arguments.out, _SURFACE_ENDINGS)
    surfaces = _SURFACES[arguments.name]()
    write_surfaces(surfaces, arguments.out)
    names = [each.name for each in surfaces]
    words = f"{len(names)} surfaces: {', '.join(names)}\nwritten: {arguments.out}"
    emit(arguments, {"surfaces": names, "saved": [str(arguments.out)]}, words)
    return 0


def _import(arguments: argparse.Namespace) -> int:
    from assoc_hull.io.write_file import write_whole

    if arguments.template is not None:
        return _write_template(arguments)
    if arguments.file is None or arguments.out is None:
        missing = "FILE" if arguments.file is None else "-o HULL"
        raise UsageError(f"{missing} is missing, in import; see: assoc-hull import --help")
    check_hull_target(arguments.out, replace=arguments.replace)
    if arguments.report is not None:
        check_target(arguments.report, (".json",))
        if not is_apart(arguments.report, arguments.out):
            what = "the report would be written over the hull"
            raise BadInputError(what, f"at {arguments.report}", "give it another name")
    if arguments.picture is not None:
        check_target(arguments.picture, PICTURE_ENDINGS)
        _require_plot()
    with progress_bar(f"importing {arguments.file.name}", hidden=arguments.json) as tell:
        hull, report, text, verdict = _adopt(arguments, tell)
        if arguments.picture is not None:
            tell("drawing", 0, 0)
            _draw(hull, arguments.picture)
    # Of a hull that is refused too: the report is what one needs to mend the file.
    if arguments.report is not None:
        write_whole(arguments.report, (json.dumps(plain(report), indent=1) + "\n").encode())
    if verdict is not None:
        _require_taken(arguments, verdict, report, text)
    hull.save(arguments.out, replace=arguments.replace)
    last = "" if verdict is None else f"\n{_kept(arguments.out, verdict)}verdict: {verdict}"
    _tell(arguments, hull, {"report": report}, text + "\n", last)
    return 0


def _require_taken(
    arguments: argparse.Namespace, verdict: Verdict, report: dict[str, Any], text: str
) -> None:
    """Refuse a hull that is not sound, after all that was found is told."""
    choice = {"accept": arguments.accept, "strict": arguments.strict}
    if refused_findings(verdict, **choice):
        facts = {"hull": None, "fingerprint": None, "report": report}
        emit(arguments, facts, f"{text}\nnot written: {arguments.out}\nverdict: {verdict}")
    require_sound(verdict, arguments.file.name, **choice)


def _tell_findings(arguments: argparse.Namespace, error: NotSoundError) -> None:
    """Tell what is wrong with a file of which nothing could be made; into the report as well."""
    from assoc_hull.io.write_file import write_whole

    verdict = {"word": "not sound", "findings": error.findings}
    report = _SCHEMA | {"verdict": verdict}
    if arguments.report is not None:
        write_whole(arguments.report, (json.dumps(plain(report), indent=1) + "\n").encode())
    rows = [f"faults ({len(error.findings)})", *(f"  {each}" for each in error.findings)]
    if error.suspicions:
        rows += [
            f"suspicions ({len(error.suspicions)})",
            *(f"  {each}" for each in error.suspicions),
        ]
    rows += [f"not written: {arguments.out}", f"verdict: not sound ({len(error.findings)} faults)"]
    facts = {"hull": None, "fingerprint": None, "report": report}
    emit(arguments, facts, "\n".join(rows))


def _kept(out: Path, verdict: Verdict) -> str:
    """Say where the verdict on a hull that was accepted is not kept."""
    if verdict.faults and not out.name.endswith(FILE_ENDING):
        return f"the verdict is not kept in {out.name}: that form has no history; keep --report\n"
    return ""


def _write_template(arguments: argparse.Namespace) -> int:
    """Write a table of offsets to fill in."""
    from importlib.resources import files

    from assoc_hull.io.write_file import write_whole

    if arguments.file is not None or arguments.out is not None:
        raise UsageError("--template stands alone, in import; leave FILE and -o out")
    check_target(arguments.template, (".csv",))
    if arguments.template.exists() and not arguments.replace:
        what = "there is a file already"
        raise BadInputError(what, f"at {arguments.template}", "give another name, or --replace")
    text = (files("assoc_hull.shipped") / "data" / "offset_template.csv").read_bytes()
    write_whole(arguments.template, text)
    words = f"written: {arguments.template}; fill it in, then: assoc-hull import "
    emit(
        arguments, {"saved": [str(arguments.template)]},
        f"{words}{arguments.template} -o ship.hull",
    )  # fmt: skip
    return 0


def _require_plot() -> None:
    """Say before anything is computed that pictures cannot be drawn."""
    from assoc_hull.plot.sheet.sheet_figure import require_matplotlib

    require_matplotlib()


def _draw(hull: Hull, path: Path) -> None:
    """Draw the deviations of all lines."""
    from assoc_hull.plot.lines_plan.adoption_deviations import adoption_deviations

    adoption_deviations(hull, path=path)


def _places(text: str) -> int | list[float]:
    """Read a number of planes, or their places."""
    try:
        return int(text) if text.isdigit() else [float(word) for word in text.split(",")]
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"{text!r} is no number and no list of places") from error


def _adopt(
    arguments: argparse.Namespace, tell: Tell
) -> tuple[Hull, dict[str, Any], str, Verdict | None]:
    """Give the hull, its report, that in words, and the verdict on it if it was imported."""
    from assoc_hull.io.classical.read import holds_definition
    from assoc_hull.io.importing.import_hull import import_hull

    options = _options(arguments)
    regular_file(arguments.file)
    if holds_hull(arguments.file):
        return *_adopt_nothing(arguments, options), None
    if holds_definition(arguments.file):
        options.refuse("a definition says all of it", arguments.file, options.of_lines())
        return _adopt_definition(arguments)
    # Taken here whatever it is worth, so that all that was found can be told; refused by `_import`.
    every = attrs.evolve(options, accept=True, strict=False)
    try:
        state, report = import_hull(arguments.file, every, tell)
    except NotSoundError as error:  # of which no hull can be made at all
        _tell_findings(arguments, error)
        raise
    hull = imported_hull(state, report)
    words = import_words(hull.particulars.name, report)
    return hull, _report_facts(report), words, report.verdict


def _options(arguments: argparse.Namespace) -> ImportOptions:
    """Give the options of the command; each has the name that it has in `read`."""
    named = {each.name: getattr(arguments, each.name) for each in attrs.fields(ImportOptions)}
    named |= {name: None for name in ("unit", "station_zero") if named[name] == "auto"}
    return ImportOptions(**named)


def _adopt_nothing(
    arguments: argparse.Namespace, options: ImportOptions
) -> tuple[Hull, dict[str, Any], str]:
    """Take a hull that was saved; its history comes along where the file has one."""
    options.refuse("a hull is read as it is", arguments.file)
    for name in ("report", "picture"):
        if getattr(arguments, name) is not None:
            raise BadInputError(
                f"--{name} cannot be given", f"with {arguments.file}, which is a hull already",
                "leave it out",
            )  # fmt: skip
    if arguments.out.exists() and arguments.out.samefile(arguments.file):
        what = "it would be written over itself"
        raise BadInputError(what, f"at {arguments.out}", "give another name after -o")
    hull = open_hull(arguments.file)
    hull.detach()
    return hull, _SCHEMA | {"source": str(arguments.file)}, f"taken from {arguments.file}"


def _adopt_definition(
    arguments: argparse.Namespace,
) -> tuple[Hull, dict[str, Any], str, Verdict | None]:
    """Make the net of a classical definition; the report is the definition's, beside the net."""
    from assoc_hull.io.importing.judge import judge_definition

    definition = read_classical(arguments.file)
    hull = create(definition)
    report = definition.report(hull.state)
    facts = _SCHEMA | {"definition": report.as_dict(), "adoption": hull.adoption}
    verdict = None if hull.adoption is None else judge_definition(hull.state, hull.adoption)
    return hull, facts, str(report), verdict


_SCHEMA = {"format": "assoc-hull report", "schema": 1}
"""What a report begins with; the number grows when a field changes its meaning or goes."""


def _report_facts(report: ImportReport) -> dict[str, Any]:
    """Give the report on an import as plain values."""
    verdict = {
        "word": report.verdict.word, "text": str(report.verdict), "faults": report.verdict.faults,
        "suspicions": report.verdict.suspicions,
    }  # fmt: skip
    if report.slices is not None:
        slices = report.slices
        totals = {
            "bands": slices.bands, "adopted": slices.adopted, "inflections": slices.inflections
        }  # fmt: skip
        facts: dict[str, Any] = _SCHEMA | plain(slices) | totals | {"verdict": verdict}
        return facts
    rounding = [
        {"z": z, "rounding": amount}
        for table in (report.table,) if table is not None
        for z, amount in zip(table.z.tolist(), table.rounding.tolist(), strict=True)
    ]  # fmt: skip
    return _SCHEMA | {
        "offsets": report.notes, "rounding": rounding, "adoption": report.adoption,
        "verdict": verdict,
    }  # fmt: skip


def _tell(
    arguments: argparse.Namespace, hull: Hull, more: dict[str, Any], text: str, last: str = ""
) -> None:
    facts = {"hull": arguments.out, "fingerprint": hull.fingerprint, **more}
    emit(arguments, facts, f"{text}{hull_words(hull)}\nwritten: {arguments.out}{last}")


# --------------------------------------------------------------------------------------
# The command that creates a hull from a design, by form parameters.


_TYPES = "bulk carrier (default), tanker, container ship, general cargo, ro-ro, trawler, yacht"
_SIX = (
    "length", "breadth", "draught", "depth", "cb", "lcb", "lcb_percent", "cm", "bilge_radius", "cw",
)  # fmt: skip


def add_create(commands: Commands) -> None:
    """Add ``create``."""
    parser = add_command(
        commands, "create", _create,
        """assoc-hull create --example > design.json
        assoc-hull create design.json -o ship.hull
        assoc-hull create design.json -o ship.hull --json
        assoc-hull create --length 90 --breadth 15 --draught 6 --depth 8.5 --cb .8 --lcb 1 -o b.hull
        """,
    )  # fmt: skip
    parser.add_argument("--type", metavar="TYPE", help="of a ship from six numbers: " + _TYPES)
    for name, what in (
        ("length", "length between perpendiculars, m"), ("breadth", "moulded breadth, m"),
        ("draught", "design draught, m"), ("depth", "depth to the deck edge amidships, m"),
        ("cb", "block coefficient"), ("lcb", "centre of buoyancy from midship, m, + forward"),
        ("lcb-percent", "the same in %% of the length"), ("cm", "midship section coefficient"),
        ("bilge-radius", "m, in the place of --cm"), ("cw", "waterplane coefficient"),
    ):  # fmt: skip
        parser.add_argument(f"--{name}", type=float, metavar="X", help=what)
    parser.add_argument(
        "design", metavar="DESIGN.json", type=Path, nargs="?", help="particulars and definitions"
    )
    parser.add_argument(
        "-o", "--out", metavar="HULL", type=Path,
        help="the hull to write: .hull keeps the history, .hull.json is text",
    )  # fmt: skip
    parser.add_argument(
        "--example", action="store_true", help="print a design to start from, and make nothing"
    )
    add_replace(parser)
    add_json(parser)


def _create(arguments: argparse.Namespace) -> int:
    from assoc_hull.creation.design import Design
    from assoc_hull.hull.sources import create

    if arguments.example:
        return _create_example(arguments)
    six = {name: getattr(arguments, name) for name in _SIX}
    if arguments.type is not None or any(each is not None for each in six.values()):
        return _create_from_six(arguments, six)
    if arguments.design is None or arguments.out is None:
        missing = "DESIGN.json, or --length and so on," if arguments.design is None else "-o HULL"
        raise UsageError(f"{missing} is missing, in create; see: assoc-hull create --help")
    check_hull_target(arguments.out, replace=arguments.replace)
    design = Design.from_json(arguments.design)
    with progress(f"creating {design.particulars.name}"):
        hull = create(design)
        report = hull.creation
    hull.save(arguments.out, replace=arguments.replace)
    facts = {
        "format": "assoc-hull report", "schema": 1, "hull": arguments.out,
        "fingerprint": hull.fingerprint, "report": report.data(),
    }  # fmt: skip
    text = f"{report}\n{hull_words(hull)}\nwritten: {arguments.out}"
    emit(arguments, facts, text)
    return 0


def _create_from_six(arguments: argparse.Namespace, six: dict[str, float | None]) -> int:
    """Create a ship from six numbers; tell where each other value comes from."""
    if arguments.design is not None:
        raise UsageError("DESIGN.json and numbers are both given, in create; leave one out")
    if arguments.out is None:
        raise UsageError("-o HULL is missing, in create; see: assoc-hull create --help")
    check_hull_target(arguments.out, replace=arguments.replace)
    kind = arguments.type or "bulk carrier"
    with progress(f"creating a {kind}"):
        hull = create(type=kind, **six)  # type: ignore[arg-type]
        report = hull.creation
    hull.save(arguments.out, replace=arguments.replace)
    notes = [attrs.asdict(each) for each in hull.notes]
    facts = {
        "format": "assoc-hull report", "schema": 1, "hull": arguments.out,
        "fingerprint": hull.fingerprint, "report": report.data(), "notes": notes,
    }  # fmt: skip
    words = "\n".join(str(each) for each in hull.notes)
    emit(arguments, facts, f"{words}\n\n{hull_words(hull)}\nwritten: {arguments.out}")
    return 0


def _create_example(arguments: argparse.Namespace) -> int:
    """Print the design of an example."""
    from assoc_hull.shipped.plain_ship import plain_ship_design

    if arguments.design is not None or arguments.out is not None or arguments.json:
        raise UsageError("--example stands alone, in create; leave the rest out")
    say(plain_ship_design().to_json().rstrip("\n"))
    return 0


# --------------------------------------------------------------------------------------
# The command that reads a classical definition and tells its own numbers.


def add_classical(commands: Commands) -> None:
    """Add ``classical``."""
    parser = add_command(
        commands, "classical",
        _classical,
        """assoc-hull classical --example sfolds > ferry.txt
        assoc-hull classical ferry.txt
        assoc-hull classical ferry.txt -o ferry.hull --json""",
    )  # fmt: skip
    parser.add_argument(
        "file", metavar="FILE", type=Path, nargs="?",
        help="a text of cards that begins with SEAKING, SFOLDS or PRELIKON",
    )  # fmt: skip
    parser.add_argument(
        "-o", "--out", metavar="HULL", type=Path,
        help="make the net as well, tell its numbers beside, and write it",
    )  # fmt: skip
    parser.add_argument(
        "--example", metavar="KIND", help="print a text to start from: seaking, sfolds, prelikon"
    )
    add_replace(parser)
    add_json(parser)


def _classical(arguments: argparse.Namespace) -> int:
    from assoc_hull.hull.sources import create, read_classical

    if arguments.example is not None:
        return _classical_example(arguments)
    if arguments.file is None:
        raise UsageError("FILE is missing, in classical; see: assoc-hull classical --help")
    if arguments.out is not None:
        check_hull_target(arguments.out, replace=arguments.replace)
    definition = read_classical(arguments.file)
    facts = {"format": "assoc-hull report", "schema": 1, "source": arguments.file}
    if arguments.out is None:
        report = definition.report()
        emit(arguments, facts | {"definition": report.as_dict()}, str(report).rstrip("\n"))
        return 0
    with progress(f"making {definition.particulars.name}"):
        hull = create(definition)
        report = definition.report(hull.state)
    hull.save(arguments.out, replace=arguments.replace)
    facts |= {
        "definition": report.as_dict(), "hull": arguments.out, "fingerprint": hull.fingerprint,
    }  # fmt: skip
    emit(arguments, facts, f"{report}\n{hull_words(hull)}\nwritten: {arguments.out}")
    return 0


def _classical_example(arguments: argparse.Namespace) -> int:
    """Print the text of an example."""
    from assoc_hull.shipped.classical_ships import SHIPS, classical_text

    if arguments.file is not None or arguments.out is not None or arguments.json:
        raise UsageError("--example stands alone, in classical; leave the rest out")
    kinds = {name.partition("_")[0]: name for name in SHIPS}
    if arguments.example not in kinds:
        known = ", ".join(kinds)
        raise UsageError(f"there is no example {arguments.example!r}, in classical; give {known}")
    say(classical_text(kinds[arguments.example]).rstrip("\n"))
    return 0
