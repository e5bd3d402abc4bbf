"""Commands of form parameters: those of a hull, a curve made of them, a curve as a series.

`parameters` tells the form parameters of a hull and their catalogue, `curve` makes one
form-parameter curve, `transform` gives a curve of a hull as a series of coefficients.
"""

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
    add_screw,
    parse_pairs,
    read_json,
    screw_of,
)
from assoc_hull.cli.output import emit, progress
from assoc_hull.cli.problems import UsageError, check_other_target, check_target
from assoc_hull.errors import BadInputError
from assoc_hull.hull.sources import open as open_hull

if TYPE_CHECKING:
    from assoc_hull.analysis.form.curve_transform import CurveTransform
    from assoc_hull.analysis.form.form_parameters import FormReport
    from assoc_hull.analysis.form.parameter import FormParameter
    from assoc_hull.creation.form_curve import FormCurve

__all__ = [
    "add_curve",
    "add_parameters",
    "add_transform",
]

# --------------------------------------------------------------------------------------
# The command that tells the form parameters of a hull.

_ENDINGS = (".txt", ".pdf", ".csv", ".xlsx", ".json")
_TABLES = ("particulars", "hydrostatic", "hull form", "bulb and resistance", "measures")
_CALL = "in the call"


def add_parameters(commands: Commands) -> None:
    """Add ``parameters``."""
    parser = add_command(
        commands, "parameters", _parameters,
        """assoc-hull parameters ship.hull --draught 18
        assoc-hull parameters ship.hull --draughts 18.5 17.5 --only Cb,Cp,LCB --json
        assoc-hull parameters ship.hull --table "hull form" -o form.pdf
        assoc-hull parameters ship.hull --shaft-height 4.2 --propeller-diameter 8.5 -o form.txt
        assoc-hull parameters --catalogue --json""",
    )  # fmt: skip
    parser.add_argument(
        "hull", metavar="HULL", type=Path, nargs="?", help="a .hull or .hull.json file"
    )
    _add_position(parser)
    add_screw(parser)
    _add_output(parser)


def _add_position(parser: argparse.ArgumentParser) -> None:
    add_draughts(parser)
    parser.add_argument(
        "--rho", type=float, default=1.025, metavar="R",
        help="density of the water, t/m3 (default: 1.025)",
    )  # fmt: skip
    parser.add_argument(
        "--shell-factor", type=float, default=1.0, metavar="F",
        help="displacement over that of the moulded volume (default: 1)",
    )  # fmt: skip
    parser.add_argument(
        "--transom", action="store_true", help="count the immersed transom as wetted surface"
    )


def _add_output(parser: argparse.ArgumentParser) -> None:
    group = parser.add_mutually_exclusive_group()
    group.add_argument(
        "--only", metavar="SYMBOLS", help="entries wanted, as Cb,Cp (default: all of them)"
    )
    group.add_argument(
        "--table", action="append", choices=_TABLES,
        help="a part of the catalogue; may be given again",
    )  # fmt: skip
    parser.add_argument(
        "--catalogue", action="store_true", help="tell the definitions instead; takes no HULL"
    )
    parser.add_argument(
        "-o", "--out", type=Path, metavar="FILE", help="a .txt, .pdf, .csv, .xlsx or .json file"
    )
    add_json(parser)


def _parameters(arguments: argparse.Namespace) -> int:
    if arguments.catalogue:
        return _catalogue(arguments)
    from assoc_hull.io.tables.form_parameters import form_document, form_text

    _check_target(arguments)
    report = _report(arguments)
    words, saved = form_text(report), []
    if arguments.out is not None:
        from assoc_hull.plot.diagrams.form_report import write_form_report

        with progress(f"writing {arguments.out}"):
            write_form_report(report, arguments.out)
        saved.append(str(arguments.out))
    words += "".join(f"\nwritten: {each}" for each in saved)
    emit(arguments, form_document(report) | {"saved": saved}, words.rstrip("\n"))
    return 0


def _check_target(arguments: argparse.Namespace) -> None:
    """Refuse, before anything is computed, what could not be done."""
    if arguments.hull is None:
        raise BadInputError("no hull is named", _CALL, "give HULL, or --catalogue")
    if arguments.out is not None:
        check_target(arguments.out, _ENDINGS)
        check_other_target(arguments.out, arguments.hull)


def _report(arguments: argparse.Namespace) -> FormReport:
    """Measure what was asked."""
    from assoc_hull.analysis.form.form_parameters import form_report

    screw = screw_of(arguments)
    hull = open_hull(arguments.hull)
    with progress("measuring"):
        return form_report(
            hull, draught=arguments.draught, draughts=arguments.draughts, screw=screw,
            rho=arguments.rho, shell_factor=arguments.shell_factor, transom=arguments.transom,
            only=_symbols(arguments), tables=arguments.table,
            date=datetime.date.today().isoformat(),
        )  # fmt: skip


def _symbols(arguments: argparse.Namespace) -> list[str] | None:
    if arguments.only is None:
        return None
    found = [each.strip() for each in arguments.only.split(",") if each.strip()]
    if not found:
        raise BadInputError("no symbol is named", "in --only", "give some, as Cb,Cp")
    return found


def _catalogue(arguments: argparse.Namespace) -> int:
    """Tell the definitions."""
    from assoc_hull.io.tables.form_parameters import (
        catalogue_document,
        catalogue_json,
        catalogue_text,
    )
    from assoc_hull.io.write_file import write_whole

    if arguments.hull is not None:
        raise BadInputError("a hull and --catalogue are both given", _CALL, "give one of them")
    entries = _entries(arguments)
    words, saved = catalogue_text(entries).rstrip("\n"), []
    if arguments.out is not None:
        check_target(arguments.out, (".txt", ".json"))
        as_json = arguments.out.suffix == ".json"
        text = catalogue_json(entries) if as_json else catalogue_text(entries)
        write_whole(arguments.out, text.encode())
        saved.append(str(arguments.out))
    document = catalogue_document(entries) | {"saved": saved}
    emit(arguments, document, "\n".join([words, *(f"written: {each}" for each in saved)]))
    return 0


def _entries(arguments: argparse.Namespace) -> list[FormParameter]:
    """Give the entries wanted."""
    from assoc_hull.analysis.form.form_parameters import CATALOGUE

    symbols = _symbols(arguments)
    if symbols is not None:
        return [CATALOGUE[symbol] for symbol in symbols]
    tables = arguments.table or _TABLES
    return [each for each in CATALOGUE.values() if each.table in tables]


# --------------------------------------------------------------------------------------
# The command that makes a form-parameter curve, and tells its parameters.


def add_curve(commands: Commands) -> None:
    """Add ``curve``."""
    parser = add_command(
        commands, "curve", _curve,
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
    known = {**known, **parse_pairs(arguments.set, "set")}
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


# --------------------------------------------------------------------------------------
# The command that gives a curve of a hull as a series.

_KINDS = ("chebyshev", "sine", "fourier")
_AREAS = "sectional areas"


def add_transform(commands: Commands) -> None:
    """Add ``transform``."""
    parser = add_command(
        commands, "transform", _transform,
        """assoc-hull transform ship.hull --line "WL 0.5" --terms 12
        assoc-hull transform ship.hull --draught 18 --kind sine --json
        assoc-hull transform ship.hull --line "ST 18" --kind fourier --span 0 18
        assoc-hull transform ship.hull --span-lpp --plot areas.pdf""",
    )  # fmt: skip
    add_hull(parser)
    parser.add_argument(
        "--line", default=_AREAS, metavar="NAME",
        help="address of a line or curve (default: the sectional areas)",
    )  # fmt: skip
    parser.add_argument("--kind", choices=_KINDS, default="chebyshev", help="(default: chebyshev)")
    parser.add_argument(
        "--terms", type=int, default=12, metavar="N",
        help="coefficients, or harmonics to each side (default: 12)",
    )  # fmt: skip
    parser.add_argument("--along", choices=tuple("xyz"), help="abscissa")
    parser.add_argument("--across", choices=tuple("xyz"), help="ordinate")
    span = parser.add_mutually_exclusive_group()
    span.add_argument(
        "--span", type=float, nargs=2, metavar=("LOW", "HIGH"), help="range of the abscissa, m"
    )
    span.add_argument("--span-lpp", action="store_true", help="range from AP to FP")
    place = parser.add_mutually_exclusive_group()
    place.add_argument("--draught", type=float, metavar="T", help="of sectional areas, m")
    place.add_argument(
        "--draughts", type=float, nargs=2, metavar=("TA", "TF"), help="at the perpendiculars, m"
    )
    parser.add_argument("--heel", type=float, default=0.0, metavar="DEG", help="+ starboard down")
    parser.add_argument("--plot", type=Path, metavar="FILE", help="a .pdf, .svg or .png file")
    add_json(parser)


def _transform(arguments: argparse.Namespace) -> int:
    from assoc_hull.analysis.form.curve_transform import curve_transform

    if arguments.plot is not None:
        check_target(arguments.plot, PICTURE_ENDINGS)
    hull = open_hull(arguments.hull)
    span = arguments.span if arguments.span is None else tuple(arguments.span)
    with progress("integrating"):
        found = curve_transform(
            hull, arguments.line, arguments.kind, arguments.terms, along=arguments.along,
            across=arguments.across, span="perpendiculars" if arguments.span_lpp else span,
            draught=arguments.draught, draughts=arguments.draughts, heel_deg=arguments.heel,
        )  # fmt: skip
    saved = _saved(found, arguments.plot)
    words = "\n".join([*_words(found), *(f"written: {each}" for each in saved)])
    emit(arguments, _document(found) | {"saved": saved}, words)
    return 0


def _saved(found: CurveTransform, path: Path | None) -> list[str]:
    """Draw the picture, where it was asked; name the file."""
    if path is None:
        return []
    from assoc_hull.plot.diagrams.curve_series import curve_series

    with progress(f"drawing {path}"):
        curve_series(found, path)
    return [str(path)]


def _document(found: CurveTransform) -> dict[str, Any]:
    """Give a series as it stands in a JSON document; complex numbers as pairs."""
    pairs = found.kind == "fourier"
    return {
        "kind": found.kind, "name": found.name, "position": found.position,
        "along": found.along, "across": found.across, "low": found.low, "high": found.high,
        "unit": found.unit, "orders": found.orders,
        "coefficients": [[c.real, c.imag] if pairs else c for c in found.coefficients.tolist()],
        "rms": found.truncation.rms, "largest": found.truncation.largest,
    }  # fmt: skip


def _words(found: CurveTransform) -> list[str]:
    """Say what the coefficients are, one to a line."""
    place = f" {found.position}" if found.position else ""
    over = f" over {found.unit:.6g}" if found.unit != 1.0 else ""
    if found.kind == "fourier":
        head = f"{found.along} + i {found.across}, {found.high:.6g} m around"
    else:
        head = f"{found.across}{over}, {found.along} from {found.low:.6g} to {found.high:.6g} m"
    symbol = {"chebyshev": "c", "sine": "b", "fourier": "X"}[found.kind]
    rows = [
        f"{symbol}_{k:<4d} {_number(value)}"
        for k, value in zip(found.orders, found.coefficients.tolist(), strict=True)
    ]
    rest = found.truncation
    left = f"left out: rms {rest.rms[-1]:.3g}, at most {rest.largest[-1]:.3g}"
    return [f"{found.name}{place}: {found.kind}, {head}", *rows, left]


def _number(value: complex) -> str:
    if isinstance(value, complex):
        return f"{value.real:+.10f} {value.imag:+.10f} i"
    return f"{value:+.10f}"
