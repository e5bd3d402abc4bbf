"""The command that fits a surface to the lines of a hull, and says how well it fits."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from assoc_hull.cli.arguments import PICTURE_ENDINGS, Commands, add_command, add_hull, add_json
from assoc_hull.cli.output import emit, progress
from assoc_hull.cli.problems import check_other_target, check_target
from assoc_hull.errors import BadInputError, NotSoundError
from assoc_hull.hull.sources import open as open_hull

if TYPE_CHECKING:
    from assoc_hull.hull import Hull

__all__ = ["add_surface", "every_fourth"]

_FOURTH = "every-fourth"
_FAMILIES = ("sections", "waterlines")


def add_surface(commands: Commands) -> None:
    """Add ``surface``."""
    parser = add_command(
        commands, "surface", _surface,
        """assoc-hull surface ship.hull
        assoc-hull surface ship.hull -o ship.step
        assoc-hull surface ship.hull -o ship.igs --unit m --half --json
        assoc-hull surface ship.hull --leave-out every-fourth
        assoc-hull surface ship.hull --leave-out "WL 1" "ST 10" --picture shaded.png""",
    )  # fmt: skip
    add_hull(parser)
    parser.add_argument(
        "-o", "--out", type=Path, metavar="FILE",
        help="write it, .step or .igs, or the closed mesh: .stl, .obj, .ply or .glb",
    )  # fmt: skip
    parser.add_argument("--unit", choices=("m", "mm"), help="of FILE (default: mm, m of meshes)")
    parser.add_argument("--half", action="store_true", help="write the port half only")
    parser.add_argument(
        "--accept", action="store_true",
        help="write it too if its halves cross or it leaves its residual limits",
    )  # fmt: skip
    parser.add_argument(
        "--leave-out", nargs="+", default=[], metavar="NAME",
        help=f"lines that are not fitted, but measured; {_FOURTH}: of the waterlines and sections",
    )  # fmt: skip
    parser.add_argument(
        "--picture", type=Path, metavar="FILE", help="draw it shaded: .pdf, .svg or .png"
    )
    add_json(parser)


def _surface(arguments: argparse.Namespace) -> int:

    _check_targets(arguments)
    hull = open_hull(arguments.hull)
    names = every_fourth(hull) if arguments.leave_out == [_FOURTH] else arguments.leave_out
    with progress("fitting the surface"):
        found = hull.surface(leave_out=names)
    words, saved = [str(found)], []
    document = found.document()
    if arguments.out is not None:
        from assoc_hull.cli.export import tell_faults

        try:
            with progress(f"writing {arguments.out}"):
                report = found.write(
                    arguments.out, unit=arguments.unit, half=arguments.half, accept=arguments.accept
                )
        except NotSoundError as error:
            tell_faults(arguments, error)
            raise
        saved.append(str(arguments.out))
        words += ["", str(report)]
    if arguments.picture is not None:
        from assoc_hull.plot.plates.lit_surface import surface_figure

        with progress(f"drawing {arguments.picture}"):
            surface_figure(found, arguments.picture)
        saved.append(str(arguments.picture))
        words.append(f"written: {arguments.picture}")
    emit(arguments, {**document, "saved": saved}, "\n".join(words))
    return 0


def _check_targets(arguments: argparse.Namespace) -> None:
    """Refuse, before anything is computed, what could not be written.

    Raises
    ------
    BadInputError, MissingExtraError
        Another ending, a name that is in use, or options without a file; no matplotlib.
    """
    if arguments.out is None:
        for what, given in (
            ("--unit", arguments.unit is not None), ("--half", arguments.half),
            ("--accept", arguments.accept),
        ):  # fmt: skip
            if given:
                raise BadInputError(f"{what} is for a file", "in surface", "give it with -o FILE")
    else:
        from assoc_hull.io.surfaces.hull_surface import surface_form_of

        surface_form_of(arguments.out)
        check_other_target(arguments.out, arguments.hull)
    if arguments.picture is not None:
        from assoc_hull.plot.sheet.sheet_figure import require_matplotlib

        check_target(arguments.picture, PICTURE_ENDINGS)
        check_other_target(arguments.picture, arguments.hull)
        require_matplotlib()


def every_fourth(hull: Hull) -> list[str]:
    """Name the fourth, eighth ... section and waterline, by place, without the last.

    Examples
    --------
    >>> from assoc_hull.cli.surface import every_fourth
    >>> from assoc_hull.hull.sources import examples
    >>> every_fourth(examples.wigley(stations=11, waterlines=6))
    ['ST 4', 'ST 8', 'WL 5']
    """
    state = hull.state
    found: list[str] = []
    for family in _FAMILIES:
        lines = [
            (float(state.lines.offset[line]), str(state.lines.name[line]))
            for line in state.live("lines").tolist()
            if state.family(line).name == family
        ]
        found += [name for _, name in sorted(lines)[3:-1:4]]
    return found
