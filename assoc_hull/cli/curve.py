"""The command that makes a form-parameter curve, and tells its parameters."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from assoc_hull.cli.arguments import PICTURE_ENDINGS, Commands, add_command, add_json
from assoc_hull.cli.json_file import read_json
from assoc_hull.cli.output import emit, progress
from assoc_hull.cli.pairs import pairs
from assoc_hull.cli.problems import UsageError, check_target
from assoc_hull.errors import BadInputError

if TYPE_CHECKING:
    from assoc_hull.creation.form_curve import FormCurve

__all__ = ["add"]


def add(commands: Commands) -> None:
    """Add ``curve``."""
    parser = add_command(
        commands, "curve", "make a form-parameter curve; exit 1 if a condition is violated", _curve,
        """assoc-hull curve --set start_x=-1 start_y=0 start_angle_deg=60 start_curvature=-2
        finish_x=-0.3 finish_y=1 finish_angle_deg=0 area=0.55 centroid=-0.59
        assoc-hull curve run.json --tangents auto -o run.pdf
        assoc-hull curve run.json --drag 1 -0.997 -0.016 --keep area centroid --json

        run.json: {"vertices": [[x, y], ...]}, seven of them, or {"parameters": {...}}, or what
        --json printed. Angles are in degrees; x, y and lengths in one unit; curvatures in 1/unit.
        --set gives or changes parameters; then the curve is made from parameters.""",
    )  # fmt: skip
    parser.add_argument(
        "file", metavar="FILE.json", type=Path, nargs="?", help="vertices or parameters"
    )
    parser.add_argument(
        "--set", metavar="NAME=VALUE", action="extend", nargs="+", default=[],
        help="parameters: start_x, start_y, start_angle_deg, start_curvature, start_tangent, "
        "start_stretch, the same of finish, area, centroid",
    )  # fmt: skip
    parser.add_argument(
        "--tangents", choices=("default", "auto"),
        help="tangent lengths: an eighth of the chord, or those of the fairest curve",
    )  # fmt: skip
    parser.add_argument(
        "--fairest", choices=("E2", "E3", "J"), default="E3",
        help="what is least with --tangents auto (default: E3)",
    )  # fmt: skip
    parser.add_argument(
        "--drag", nargs=3, metavar=("VERTEX", "X", "Y"), action="append", default=[],
        help="move a vertex, 0 to 6; may be given more than once",
    )  # fmt: skip
    parser.add_argument(
        "--keep", nargs="+", choices=("area", "centroid"), default=[],
        help="what stays while vertices are dragged: area, or area centroid",
    )  # fmt: skip
    parser.add_argument(
        "-o", "--out", type=Path, metavar="FILE", help="draw it: a .pdf, .svg or .png file"
    )
    add_json(parser)


def _curve(arguments: argparse.Namespace) -> int:
    if arguments.out is not None:
        check_target(arguments.out, PICTURE_ENDINGS)
    curve = _made(arguments)
    for vertex, x, y in arguments.drag:
        curve = curve.drag(_whole(vertex), (_real(x), _real(y)), keep=arguments.keep)
    text = curve.table()
    document: dict[str, Any] = {"format": "assoc-hull form curve", "schema": 1, **curve.document()}
    if arguments.out is not None:
        from assoc_hull.plot.diagrams.form_curve import form_curve_picture

        with progress(f"drawing {arguments.out}"):
            form_curve_picture(curve, arguments.out)
        text += f"\nwritten: {arguments.out}"
        document["saved"] = str(arguments.out)
    emit(arguments, document, text)
    return int(any(each.severity == "error" for each in curve.messages))


def _made(arguments: argparse.Namespace) -> FormCurve:
    """Make the curve that the file and the parameters tell."""
    from assoc_hull.creation.form_curve import FormCurve

    if arguments.file is None and not arguments.set:
        raise UsageError("neither FILE.json nor --set is given, in curve; give one")
    told = {} if arguments.file is None else _read(arguments.file)
    vertices = told.pop("vertices", None)
    inner = told.pop("parameters", None)
    if vertices is not None and not arguments.set and arguments.tangents is None:
        return FormCurve(vertices)
    if vertices is not None:
        known: Any = dict(FormCurve(vertices).parameters)
    else:
        known = told if inner is None else inner
        if not isinstance(known, dict):
            what = "the parameters are no JSON object"
            raise BadInputError(what, f"in {arguments.file}", "name each")
    known = {**known, **pairs(arguments.set, "set")}
    if arguments.tangents is None:
        return FormCurve.from_parameters(known)
    return FormCurve.from_parameters(known, tangents=arguments.tangents, energy=arguments.fairest)


def _read(path: Path) -> dict[str, Any]:
    """Read a JSON object."""
    found = read_json(path, "curve")
    if not isinstance(found, dict):
        remedy = 'give {"vertices": [...]} or {"parameters": {...}}'
        raise BadInputError("this is no JSON object", f"in {path}", remedy)
    return found


def _whole(text: str) -> int:
    try:
        return int(text)
    except ValueError:
        raise UsageError(f"--drag {text}: the vertex is a whole number from 0 to 6") from None


def _real(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise UsageError(f"--drag: {text!r} is no number") from None
