"""The command that writes a hull in the form of another program."""

from __future__ import annotations

import argparse
from pathlib import Path

from assoc_hull.cli.arguments import Commands, add_command, add_hull, add_json
from assoc_hull.cli.export_check import check_arcs, check_form
from assoc_hull.cli.lengths import length
from assoc_hull.cli.output import emit, progress
from assoc_hull.cli.problems import check_other_target
from assoc_hull.io.export_book import ExportReport
from assoc_hull.io.write_file import form_by_ending
from assoc_hull.sources import open as open_hull

__all__ = ["add", "export_words"]

_LINES = {
    "hull": ".hull.json", "csv": ".csv", "xlsx": ".xlsx", "britfair": ".bri", "delftship": ".txt",
    "delftship-offsets": "", "gf": ".gf", "dxf": ".dxf", "dxf-polylines": "", "dxf-plan": "",
    "iges-lines": "",
}  # fmt: skip
"""Forms of lines, with their endings; the writers tell the same, and are loaded when needed."""

_SURFACES = {
    "step": ".step .stp", "iges": ".iges .igs", "iges-brep": "", "iges-surfaces": "",
    "stl": ".stl", "stl-text": "", "obj": ".obj", "ply": ".ply", "glb": ".glb",
}  # fmt: skip
"""Forms of surfaces and meshes, with their endings."""

_FORMS = (*_LINES, *_SURFACES)
_ENDINGS = {
    ending: name for name, known in {**_LINES, **_SURFACES}.items() for ending in known.split()
}


def add(commands: Commands) -> None:
    """Add ``export``."""
    parser = add_command(
        commands, "export", "write lines, surfaces or meshes for other programs", _export,
        """assoc-hull export ship.hull -o offsets.csv
        assoc-hull export ship.hull -o offsets.xlsx
        assoc-hull export ship.hull -o ship.bri
        assoc-hull export ship.hull -o ship.gf --json
        assoc-hull export ship.hull -o ship.txt --format delftship-offsets
        assoc-hull export ship.hull -o ship.step
        assoc-hull export ship.hull -o ship.igs --unit m --half
        assoc-hull export ship.hull -o ship.stl --unit mm
        assoc-hull export ship.hull -o plan.dxf --views 2d --scale 200
        assoc-hull export ship.hull -o lines.dxf --biarcs 0.5mm
        assoc-hull export ship.hull -o arcs.csv --biarcs 1mm --least-radius 5cm --lines sections""",
    )  # fmt: skip
    add_hull(parser)
    parser.add_argument(
        "-o", "--out", type=Path, required=True, metavar="FILE",
        help="lines: .csv, .xlsx, .bri, .gf, .txt (delftship), .dxf or .hull.json; surfaces: "
        ".step or .igs; a closed mesh: .stl, .obj, .ply or .glb",
    )  # fmt: skip
    parser.add_argument(
        "--format", choices=_FORMS, help="where the ending of the name does not tell it"
    )
    parser.add_argument(
        "--unit", choices=("m", "mm"),
        help="of drawings and meshes (default: m), of surfaces (default: mm)",
    )  # fmt: skip
    parser.add_argument(
        "--half", action="store_true", help="of surfaces and meshes: the port half only"
    )
    parser.add_argument(
        "--points", type=int, metavar="N",
        help="of a mesh: parts of each line between two crossings, even (default: 4)",
    )  # fmt: skip
    _add_drawing(parser)
    _add_arcs(parser)
    add_json(parser)


def _add_drawing(parser: argparse.ArgumentParser) -> None:
    drawing = parser.add_argument_group("drawings")
    drawing.add_argument(
        "--views", choices=("2d", "3d"),
        help="of a .dxf: a lines plan in three views, or all lines in their places (default)",
    )  # fmt: skip
    drawing.add_argument(
        "--scale", type=float, metavar="N",
        help="of a lines plan: letters are for a print at 1:N (default: one that fits A1)",
    )  # fmt: skip


def _add_arcs(parser: argparse.ArgumentParser) -> None:
    arcs = parser.add_argument_group("arcs for production")
    arcs.add_argument(
        "--biarcs", type=length, metavar="TOL",
        help="write lines as circular arcs and straight lines that leave them by no more than "
        "TOL, such as 0.5mm; m without a unit; to a .dxf or .csv file",
    )  # fmt: skip
    arcs.add_argument(
        "--least-radius", type=length, metavar="R", help="radius of the sharpest arc, such as 50mm"
    )
    arcs.add_argument(
        "--entities", choices=("polylines", "arcs"),
        help="of a .dxf: a polyline per curve (default), or ARC and LINE one by one",
    )  # fmt: skip
    arcs.add_argument("--lines", nargs="+", metavar="NAME", help="lines or groups (default: all)")


def _export(arguments: argparse.Namespace) -> int:
    check_arcs(arguments)
    if arguments.biarcs is not None:
        from assoc_hull.cli.export_arcs import export_arcs

        return export_arcs(arguments)
    form = form_by_ending(arguments.out, arguments.format, _FORMS, _ENDINGS, "in export")
    form = check_form(arguments, form, mesh_or_surface=form in _SURFACES)
    check_other_target(arguments.out, arguments.hull)
    if form in _SURFACES:
        from assoc_hull.cli.export_surface import export_surface

        return export_surface(arguments, form)
    from assoc_hull.io.export.write import export

    hull = open_hull(arguments.hull)
    with progress(f"writing {arguments.out}"):
        report = export(hull.state, arguments.out, form, arguments.unit, scale=arguments.scale)
    emit(arguments, {"export": report}, export_words(report))
    return 0


def export_words(report: ExportReport) -> str:
    """Say what was written, how it was rounded, and what is not in the file."""
    rows = [f"{report.lines} lines in {report.curves} curves, {report.points} points"]
    if report.rounding:
        rows.append(
            f"rounded by {1e3 * report.largest:.4f} mm at most (half a digit is "
            f"{1e3 * report.rounding:.4f} mm)"
        )
    if report.chord:
        rows.append(
            f"straight lines between points leave the curves by {1e3 * report.chord:.2f} mm"
        )
    for title, notes in (("left out", report.left_out), ("otherwise", report.mended)):
        rows += [f"{title} ({len(notes)})", *(f"  {note}" for note in notes)] if notes else []
    return "\n".join([*rows, f"written: {report.path} ({report.form})"])
