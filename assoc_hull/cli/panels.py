"""The command that divides a hull into panels."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from assoc_hull.cli.arguments import (
    PICTURE_ENDINGS,
    Commands,
    add_command,
    add_draughts,
    add_hull,
    add_json,
)
from assoc_hull.cli.output import emit, progress
from assoc_hull.cli.problems import check_other_target, check_target
from assoc_hull.hull import Hull
from assoc_hull.hull.sources import open as open_hull

if TYPE_CHECKING:
    from assoc_hull.geometry.surfaces.panel_mesh import PanelMesh

__all__ = ["add_panels"]

_FORMS = ("nemoh", "wamit", "hams", "stl", "stl-text")


def add_panels(commands: Commands) -> None:
    """Add ``panels``."""
    parser = add_command(
        commands, "panels", _panels,
        """assoc-hull panels ship.hull --count 2000 -o ship.gdf
        assoc-hull panels ship.hull --draughts 18.5 17.5 --stations 60 --points 15 -o ship.mar
        assoc-hull panels ship.hull --full --heel 5 --count 3000 -o HullMesh.pnl --json
        assoc-hull panels ship.hull --knuckles 10 --plot panels.pdf -o ship.stl""",
    )  # fmt: skip
    add_hull(parser)
    _add_position(parser)
    _add_division(parser)
    parser.add_argument(
        "-o", "--out", type=Path, metavar="FILE",
        help="a .mar (Nemoh), .gdf (WAMIT), .pnl (HAMS) or .stl file",
    )  # fmt: skip
    parser.add_argument(
        "--format", choices=_FORMS, help="where the ending of the name does not tell it"
    )
    parser.add_argument("--plot", type=Path, metavar="FILE", help="a .pdf, .svg or .png file")
    add_json(parser)


def _add_position(parser: argparse.ArgumentParser) -> None:
    add_draughts(parser)
    parser.add_argument("--heel", type=float, default=0.0, metavar="DEG", help="+ starboard down")
    parser.add_argument(
        "--origin", type=float, metavar="X", help="x of the origin from AP, m (default: midship)"
    )


def _add_division(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--count", type=int, metavar="N", help="panels to aim at")
    stations = parser.add_mutually_exclusive_group()
    stations.add_argument("--stations", type=int, metavar="N", help="how many sections to join")
    stations.add_argument(
        "--at", type=float, nargs="+", metavar="X", help="sections at these x from AP, m"
    )
    parser.add_argument(
        "--points", type=int, metavar="N", help="on a half section (default: 20, or by --count)"
    )
    parser.add_argument(
        "--spacing", choices=("arc", "cosine"), default="arc",
        help="of sections: equal along the waterline (default), or close at both ends",
    )  # fmt: skip
    side = parser.add_mutually_exclusive_group()
    side.add_argument("--half", action="store_true", help="port only (default if upright)")
    side.add_argument("--full", action="store_true", help="both sides")
    parser.add_argument(
        "--knuckles", type=float, metavar="DEG", help="put points on knuckles that turn by more"
    )
    parser.add_argument(
        "--open-transom", action="store_true", help="do not close transoms and other ends"
    )
    parser.add_argument(
        "--on-error", choices=("refuse", "report"), default="refuse",
        help="what to do where the surface is doubtful",
    )  # fmt: skip


def _panels(arguments: argparse.Namespace) -> int:
    from assoc_hull.analysis.panels.mesh_quality import panel_report

    _check_targets(arguments)
    hull = open_hull(arguments.hull)
    with progress("dividing"):
        mesh = _mesh(hull, arguments)
        report = panel_report(mesh)
    saved = _saved(mesh, arguments)
    words = "\n".join([str(report), *(f"written: {each}" for each in saved)])
    emit(arguments, {"panels": report.as_dict(), "saved": saved}, words)
    return 0


def _check_targets(arguments: argparse.Namespace) -> None:
    """Refuse, before anything is computed, what could not be written."""
    if arguments.out is not None:
        from assoc_hull.io.panels.formats import panel_form_of

        panel_form_of(arguments.out, arguments.format)
        check_other_target(arguments.out, arguments.hull)
    if arguments.plot is not None:
        check_target(arguments.plot, PICTURE_ENDINGS)


def _mesh(hull: Hull, arguments: argparse.Namespace) -> PanelMesh:
    from assoc_hull.analysis.panels.hull_panels import panels

    side: Any = "half" if arguments.half else "full" if arguments.full else None
    return panels(
        hull, draught=arguments.draught,
        draughts=None if arguments.draughts is None else tuple(arguments.draughts),
        heel_deg=arguments.heel, count=arguments.count,
        stations=arguments.stations if arguments.at is None else arguments.at,
        points=arguments.points, spacing=arguments.spacing, side=side,
        knuckle_deg=arguments.knuckles, transom=not arguments.open_transom,
        origin=arguments.origin, on_error=arguments.on_error,
    )  # fmt: skip


def _saved(mesh: PanelMesh, arguments: argparse.Namespace) -> list[str]:
    """Write mesh and picture, where they were asked; name the files."""
    saved: list[Path] = []
    if arguments.out is not None:
        from assoc_hull.io.panels.formats import write_panels

        with progress(f"writing {arguments.out}"):
            write_panels(mesh, arguments.out, arguments.format)
        saved.append(arguments.out)
    if arguments.plot is not None:
        from assoc_hull.plot.plates.panel_plan import panel_plan

        with progress(f"drawing {arguments.plot}"):
            panel_plan(mesh, arguments.plot)
        saved.append(arguments.plot)
    return [str(each) for each in saved]
