"""The command that writes one document with all that is known of a hull: a PDF, or a workbook."""

from __future__ import annotations

import argparse
from collections.abc import Collection
from pathlib import Path
from typing import TYPE_CHECKING, Any

from assoc_hull.cli.arguments import (
    Commands,
    add_command,
    add_hull,
    add_json,
    add_water,
    appendages_of,
    density_of,
    number_range,
)
from assoc_hull.cli.output import emit, progress_bar
from assoc_hull.cli.plates import add_seams, seams_of
from assoc_hull.cli.problems import check_other_target, check_target
from assoc_hull.cli.stability import add_flooding, opening
from assoc_hull.errors import BadInputError
from assoc_hull.hull import Hull
from assoc_hull.hull.sources import open as open_hull

if TYPE_CHECKING:
    from assoc_hull.io.reports import Tell
    from assoc_hull.plot.booklet.parts import PartName

__all__ = ["add_report"]

_ENDINGS = (".pdf", ".xlsx")


def add_report(commands: Commands) -> None:
    """Add ``report``."""
    parser = add_command(
        commands, "report",
        _report,
        """assoc-hull report ship.hull ship.pdf --kg 11.2
        assoc-hull report ship.hull tables.xlsx --kg 11.2 --table 4:18:1
        assoc-hull report ship.hull curves.pdf --parts hydrostatics bonjean areas
        assoc-hull report ship.hull shell.pdf --parts surface plates --butts 24:300:12""",
    )  # fmt: skip
    add_hull(parser)
    parser.add_argument("out", metavar="OUT", type=Path, help="a .pdf or .xlsx file; -o OUT too")
    parser.add_argument(
        "--parts", nargs="+", metavar="PART",
        help="some of lines, hydrostatics, bonjean, areas, form, stability, surface, plates, "
        "accuracy (default: all but surface and plates, which are fitted where they are named)",
    )  # fmt: skip
    parser.add_argument(
        "--draught", type=float, metavar="T", help="at even keel, m (default: design)"
    )
    parser.add_argument(
        "--table", metavar="FROM:TO:STEP", help="draughts of hydrostatics and cross curves, m"
    )
    parser.add_argument("--kg", type=float, metavar="Z", help="centre of gravity above base, m")
    add_flooding(parser)
    add_water(parser)
    parser.add_argument("--title", default="Hull report", metavar="WORDS", help="of the document")
    parser.add_argument(
        "--date", metavar="WORDS", help="stands in it; none does by default, so that bytes are kept"
    )
    add_seams(parser)
    add_json(parser)


def _report(arguments: argparse.Namespace) -> int:
    check_target(arguments.out, _ENDINGS)
    check_other_target(arguments.out, arguments.hull)
    parts: list[PartName] | None = arguments.parts
    seams = seams_of(arguments)
    if seams is None and "plates" in (parts or ()):
        remedy = "give --butts, --seams-z or --seams-girth"
        raise BadInputError("plates are asked, and nothing cuts the hull", "in --parts", remedy)
    from assoc_hull.plot.booklet.write import write_booklet  # it needs matplotlib's extra

    draughts = None if arguments.table is None else number_range(arguments.table, "--table")
    hull = open_hull(arguments.hull)
    with progress_bar(f"report {arguments.out}", hidden=False) as tell:
        written = write_booklet(
            hull, arguments.out, parts,
            draught=arguments.draught, draughts=draughts, kg=arguments.kg,
            flooding=map(opening, arguments.flooding), rho=density_of(arguments),
            shell_factor=arguments.shell_factor, appendages=appendages_of(arguments),
            on_error=arguments.on_error, title=arguments.title, date=arguments.date,
            adoption=hull.adoption, tell=tell,
            **_shell(hull, parts or [], seams, one_fit=arguments.one_fit, tell=tell),
        )  # fmt: skip
    words = f"written: {arguments.out} ({', '.join(written)})"
    emit(arguments, {"parts": list(written), "saved": [str(arguments.out)]}, words)
    return 0


def _shell(
    hull: Hull, parts: Collection[str], seams: Any, *, one_fit: bool, tell: Tell
) -> dict[str, Any]:
    """Fit the surface and cut plates where these parts are named, or seams are given."""
    found: dict[str, Any] = {}
    if "surface" in parts:
        tell("fitting the surface", 0, 0)
        found["surface"] = hull.surface()
    if seams is not None:
        tell("cutting plates", 0, 0)
        found["plates"] = hull.plates(seams, others=() if one_fit else None)
    return found
