"""The command that writes a hull in the form of another program: lines, arcs, surfaces, meshes.

The ending of the name tells the form. Options that do not go together are refused before
anything is computed. Each kind says in words what was written and how near it is.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from assoc_hull.analysis.production_arcs import ArcLines
from assoc_hull.cli.arguments import Commands, add_command, add_hull, add_json, parse_length
from assoc_hull.cli.output import emit, progress
from assoc_hull.cli.problems import check_other_target
from assoc_hull.errors import BadInputError, NotSoundError
from assoc_hull.hull.sources import open as open_hull
from assoc_hull.io.write_file import form_by_ending

__all__ = [
    "add_export",
    "arc_words",
    "check_arcs",
    "check_form",
    "export_arcs",
    "tell_faults",
]

# --------------------------------------------------------------------------------------
# Options of `export` that do not go together, refused before anything is computed.

_MESHES = ("stl", "stl-text", "obj", "ply", "glb")


def check_arcs(arguments: argparse.Namespace) -> None:
    """Refuse what means nothing without, or beside, a tolerance for arcs.

    Raises
    ------
    BadInputError
        A radius or lines without the tolerance; another form or its options with it.
    """
    name = str(arguments.out)
    if arguments.biarcs is None:
        told = {
            "--least-radius is one of arcs": arguments.least_radius is not None,
            "--lines chooses lines for arcs": arguments.lines is not None,
            "--entities is for a drawing of arcs": arguments.entities is not None,
        }
        remedy = "add --biarcs 0.5mm"
    else:
        told = {
            "--format is none of arcs": arguments.format is not None,
            "--views is none of arcs, which lie in their places": arguments.views is not None,
            "--scale is none of arcs": arguments.scale is not None,
            "--unit is none of arcs, which are in m": arguments.unit is not None,
            "--half is none of arcs, which are those of one half": arguments.half,
            "--points is none of arcs": arguments.points is not None,
            "--accept is none of arcs": arguments.accept,
        }
        remedy = "leave it out, and end the file in .dxf or .csv"
    _refuse(told, name, remedy)


def check_form(arguments: argparse.Namespace, form: str, *, mesh_or_surface: bool) -> str:
    """Refuse options that a form does not take; give the form, as the views choose it.

    Parameters
    ----------
    arguments : Namespace
        As they were typed.
    form : str
        By the format, or the ending.
    mesh_or_surface : bool
        Whether it holds these, and not lines.

    Raises
    ------
    BadInputError
        An option of another form.
    """
    drawn = form.startswith("dxf")
    told = {
        "--views chooses the views of a drawing": arguments.views is not None and form != "dxf",
        "--half is for surfaces and meshes": arguments.half and not mesh_or_surface,
        "--points is for meshes": arguments.points is not None and form not in _MESHES,
        "--accept is for surfaces and meshes": arguments.accept
        and not mesh_or_surface and form != "3dm",
        "--unit is for drawings, surfaces and meshes": arguments.unit is not None
        and not (drawn or mesh_or_surface or form in ("iges-lines", "3dm")),
    }  # fmt: skip
    _refuse(told, str(arguments.out), "leave it out")
    chosen = "dxf-plan" if arguments.views == "2d" else form
    if arguments.scale is not None and chosen != "dxf-plan":
        _refuse({"--scale is for a lines plan": True}, str(arguments.out), "add --views 2d")
    return chosen


def _refuse(told: dict[str, bool], name: str, remedy: str) -> None:
    for what, given in told.items():
        if given:
            raise BadInputError(what, f"at {name}", remedy)


# --------------------------------------------------------------------------------------
# What `export --biarcs` does and says: lines as arcs.


def export_arcs(arguments: argparse.Namespace) -> int:
    """Write the lines that are asked for as arcs, and report them."""
    from assoc_hull.io.export.arcs import arc_form

    form = arc_form(arguments.out)
    check_other_target(arguments.out, arguments.hull)
    hull = open_hull(arguments.hull)
    with progress(f"fitting arcs for {arguments.out}"):
        arcs = hull.production_arcs(
            arguments.lines, arguments.biarcs, arguments.least_radius or 0.0
        )
        arcs.save(arguments.out, arguments.entities or "polylines")
    report = {"path": str(arguments.out), "form": form, **arcs.facts()}
    emit(arguments, {"arcs": report}, f"{arc_words(arcs)}\nwritten: {arguments.out} ({form})")
    return 0


def arc_words(arcs: ArcLines) -> str:
    """Give a row per curve, and the sum of all.

    Examples
    --------
    >>> from assoc_hull.analysis.production_arcs import arc_lines
    >>> from assoc_hull.cli.export import arc_words
    >>> from assoc_hull.shipped.wigley import wigley
    >>> print(arc_words(arc_lines(wigley(), "WL 5", 0.0005, 0.0)))
    line  arcs  straight  net points  off by (mm)  least radius (m)
    WL 5    10         0          21        0.440           244.449
    1 curves, 10 arcs (40 with a biarc between neighbouring net points), at most 0.440 mm off
    """
    head = ("line", "arcs", "straight", "net points", "off by (mm)", "least radius (m)")
    rows = [
        (
            line.name, str(len(line.arcs)), str(int((line.arcs.curvature == 0.0).sum())),
            str(line.points), f"{1e3 * float(line.deviation.max()):.3f}",
            f"{line.least_radius:.3f}",
        )
        for line in arcs.lines
    ]  # fmt: skip
    wide = [max(len(row[i]) for row in (head, *rows)) for i in range(len(head))]
    text = [
        "  ".join(
            cell.rjust(size) if i else cell.ljust(size)
            for i, (cell, size) in enumerate(zip(row, wide, strict=True))
        ).rstrip()
        for row in (head, *rows)
    ]
    text.append(
        f"{len(arcs.lines)} curves, {arcs.count} arcs ({arcs.one_per_interval} with a biarc "
        f"between neighbouring net points), at most {1e3 * arcs.deviation:.3f} mm off"
    )
    for title, told in (("left out", arcs.left_out), ("views", arcs.notes)):
        if told:
            text += [f"{title} ({len(told)})", *(f"  {each}" for each in told)]
    return "\n".join(text)


# --------------------------------------------------------------------------------------
# What `export` does and says of surfaces and meshes.


def tell_faults(arguments: argparse.Namespace, error: NotSoundError) -> None:
    """Tell every fault of a surface that is not written, before the one line of the error."""
    faults = "\n".join(error.findings)
    facts = {"export": None, "faults": error.findings}
    emit(arguments, facts, f"{faults}\nnot written: {arguments.out}")


# --------------------------------------------------------------------------------------
# The command that writes a hull in the form of another program.

_LINES = {
    "hull": ".hull.json", "csv": ".csv", "xlsx": ".xlsx", "britfair": ".bri", "delftship": ".txt",
    "delftship-offsets": "", "gf": ".gf", "dxf": ".dxf", "dxf-polylines": "", "dxf-plan": "",
    "3dm": ".3dm", "iges-lines": "",
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


def add_export(commands: Commands) -> None:
    """Add ``export``."""
    parser = add_command(
        commands, "export", _export,
        """assoc-hull export ship.hull -o offsets.csv
        assoc-hull export ship.hull -o offsets.xlsx
        assoc-hull export ship.hull -o ship.bri
        assoc-hull export ship.hull -o ship.gf --json
        assoc-hull export ship.hull -o ship.txt --format delftship-offsets
        assoc-hull export ship.hull -o ship.3dm
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
        ".step or .igs; a closed mesh: .stl, .obj, .ply or .glb; all of them: .3dm",
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
        help="of a mesh: parts of each line between two crossings, even (4, or more of round ones)",
    )  # fmt: skip
    parser.add_argument(
        "--leave-out", nargs="+", default=[], metavar="NAME",
        help="of a mesh: lines, tunnels and bodies beside the net to do without",
    )  # fmt: skip
    parser.add_argument(
        "--accept", action="store_true",
        help="write a surface or mesh too that is not sound, as one of another volume",
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
        "--biarcs", type=parse_length, metavar="TOL",
        help="write lines as circular arcs and straight lines that leave them by no more than "
        "TOL, such as 0.5mm; m without a unit; to a .dxf or .csv file",
    )  # fmt: skip
    arcs.add_argument(
        "--least-radius",
        type=parse_length,
        metavar="R",
        help="radius of the sharpest arc, such as 50mm",
    )
    arcs.add_argument(
        "--entities", choices=("polylines", "arcs"),
        help="of a .dxf: a polyline per curve (default), or ARC and LINE one by one",
    )  # fmt: skip
    arcs.add_argument("--lines", nargs="+", metavar="NAME", help="lines or groups (default: all)")


def _export(arguments: argparse.Namespace) -> int:
    check_arcs(arguments)
    if arguments.biarcs is not None:
        return export_arcs(arguments)
    form = form_by_ending(arguments.out, arguments.format, _FORMS, _ENDINGS, "in export")
    form = check_form(arguments, form, mesh_or_surface=form in _SURFACES)
    check_other_target(arguments.out, arguments.hull)
    hull = open_hull(arguments.hull)
    try:
        # Of a surface nearly all of the time goes into the fit.
        doing = "fitting the surface for" if form in _SURFACES else "writing"
        with progress(f"{doing} {arguments.out}"):
            report = hull.export(
                arguments.out, form, arguments.unit, scale=arguments.scale, half=arguments.half,
                points=arguments.points, accept=arguments.accept, leave_out=arguments.leave_out,
            )  # fmt: skip
    except NotSoundError as error:
        tell_faults(arguments, error)
        raise
    emit(arguments, {"export": report}, str(report))
    return 0
