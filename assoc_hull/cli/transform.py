"""The command that gives a curve of a hull as a series."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from assoc_hull.cli.arguments import PICTURE_ENDINGS, Commands, add_command, add_hull, add_json
from assoc_hull.cli.output import emit, progress
from assoc_hull.cli.problems import check_target
from assoc_hull.sources import open as open_hull

if TYPE_CHECKING:
    from assoc_hull.analysis.form.transform_record import CurveTransform

__all__ = ["add"]

_KINDS = ("chebyshev", "sine", "fourier")
_AREAS = "sectional areas"


def add(commands: Commands) -> None:
    """Add ``transform``."""
    parser = add_command(
        commands, "transform", "give a curve as a Chebyshev, sine or Fourier series", _transform,
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
    from assoc_hull.analysis.form.curve_transforms import curve_transform

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
