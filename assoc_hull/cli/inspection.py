"""Commands that look at a hull and change nothing: facts, findings, causes, graphs, pictures.

`info`, `check`, `verify`, `why`, `fairness`, `sensitivities`, `graph`, `plot`. Each opens the
hull, asks one method of it, and prints what comes. `check` and `verify` exit with 1 if there
is anything to tell.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Mapping
from pathlib import Path

from assoc_hull.cli.arguments import (
    PICTURE_ENDINGS,
    Commands,
    add_command,
    add_hull,
    add_json,
    parse_length,
)
from assoc_hull.cli.hull_words import hull_facts, hull_words
from assoc_hull.cli.output import can_print, emit, progress, why_document
from assoc_hull.cli.problems import UsageError, check_other_target, check_target
from assoc_hull.edit.explain.causes import Why
from assoc_hull.hull import Hull
from assoc_hull.hull.sources import open as open_hull
from assoc_hull.model.program.engine import engine_words, wait_for_engine

__all__ = [
    "add_fairness",
    "add_graph",
    "add_inspection",
    "add_plot",
    "add_sensitivities",
    "add_why",
    "why_words",
]

# --------------------------------------------------------------------------------------
# Commands that look at a hull: its facts, its findings, and whether it is what it says.

_NOTE = "role"


def add_inspection(commands: Commands) -> None:
    """Add ``info``, ``check`` and ``verify``."""
    info = add_command(
        commands, "info", _info,
        """assoc-hull info ship.hull
        assoc-hull info ship.hull --json
        assoc-hull info --engine --wait""",
    )  # fmt: skip
    info.add_argument(
        "hull", metavar="HULL", type=Path, nargs="?", help="a .hull or .hull.json file"
    )
    info.add_argument(
        "--engine", action="store_true",
        help="tell whether live drags run compiled (extra fast) or in numpy, and why",
    )  # fmt: skip
    info.add_argument(
        "--wait", action="store_true", help="with --engine: wait until it has been compiled"
    )
    info.add_argument("--names", action="store_true", help="list the names of its lines alone")
    add_json(info)
    check = add_command(
        commands, "check", _check,
        """assoc-hull check ship.hull
        assoc-hull check ship.hull --notes --json""",
    )  # fmt: skip
    check.add_argument("--notes", action="store_true", help="tell also what is only worth knowing")
    verify = add_command(
        commands, "verify",
        _verify, "assoc-hull verify ship.hull\nassoc-hull verify ship.hull --json",
    )  # fmt: skip
    verify.add_argument(
        "--relative", type=float, default=0.0, metavar="PART",
        help="allow differences of this part of the largest number (0 compares bits; "
        "1e-12 for a hull that was written on another machine)",
    )  # fmt: skip
    for parser in (check, verify):
        add_hull(parser)
        add_json(parser)


def _info(arguments: argparse.Namespace) -> int:
    if arguments.engine:
        told = wait_for_engine() if arguments.wait else engine_words()
        emit(arguments, {"engine": told}, told)
        return 0
    if arguments.hull is None:
        raise UsageError("no hull is named: give HULL, or --engine")
    hull = open_hull(arguments.hull)
    if arguments.names:
        names = list(hull.lines)
        emit(arguments, {"lines": names}, "\n".join(names))
        return 0
    emit(arguments, hull_facts(hull), hull_words(hull, names=True))
    return 0


def _check(arguments: argparse.Namespace) -> int:
    hull = open_hull(arguments.hull, damaged=True)
    with progress("checking"):
        found = hull.check(notes=arguments.notes)
    wrong = sum(each.kind != _NOTE for each in found)
    count = f"{wrong} finding{'s' if wrong > 1 else ''}" if wrong else "no findings"
    lines = [*map(str, found), count]
    emit(arguments, {"findings": found}, "\n".join(lines))
    return 1 if wrong else 0


def _verify(arguments: argparse.Namespace) -> int:
    hull = open_hull(arguments.hull)
    with progress("rebuilding"):
        found = hull.verify(arguments.relative)
    lines = [f"{each.key}: {each.field} differs by {each.amount:.3g}" for each in found]
    plural = "s" if len(found) > 1 else ""
    lines.append(f"{len(found)} difference{plural}" if found else "no differences")
    facts = {"fingerprint": hull.fingerprint, "differences": found}
    emit(arguments, facts, "\n".join(lines))
    return 1 if found else 0


# --------------------------------------------------------------------------------------
# The command that tells why an object is as it is.


def add_why(commands: Commands) -> None:
    """Add ``why``."""
    parser = add_command(
        commands, "why", _why,
        """assoc-hull why ship.hull "BTK 0.44"
        assoc-hull why ship.hull "WL 0.5 x ST 16" --tree
        assoc-hull why ship.hull "WL 0.5" --step 3 --least 0.1mm
        assoc-hull why ship.hull "WL 0.5" --json""",
    )  # fmt: skip
    add_hull(parser)
    parser.add_argument(
        "object", metavar="OBJECT",
        help="a point, a curve, a line (of which the first curve is meant) or a definition: its "
        "address, name or key",
    )  # fmt: skip
    parser.add_argument(
        "--step", metavar="N", type=int,
        help="the edit of this number, as `history` lists it; -1 is the last (default: the last "
        "that reached the object)",
    )  # fmt: skip
    parser.add_argument(
        "--least", metavar="LENGTH", type=_least,
        help="leave out causes that moved less, as 0.1mm or in m (default: of a pull and the like, "
        "those below a hundredth of the largest)",
    )  # fmt: skip
    form = parser.add_mutually_exclusive_group()
    form.add_argument("--tree", action="store_true", help="draw the tree of causes")
    add_json(form)


def _least(text: str) -> float:
    """Take a length, or 0."""
    return 0.0 if text.strip() == "0" else parse_length(text)


def _why(arguments: argparse.Namespace) -> int:
    hull = open_hull(arguments.hull)
    with progress("looking through the history"):
        cause = hull.why(arguments.object, step=arguments.step, least=arguments.least)
    text = cause.tree(plain=not can_print("│├└─")) if arguments.tree else str(cause)
    emit(arguments, why_document(cause), text)
    return 0


def why_words(causes: Mapping[str, Why]) -> list[str]:
    """Tell the causes of several objects, each under the name by which it was asked for."""
    return [f"why {name}\n{cause}" for name, cause in causes.items()]


# --------------------------------------------------------------------------------------
# The command that tells how fair lines are.


def add_fairness(commands: Commands) -> None:
    """Add ``fairness``."""
    parser = add_command(
        commands, "fairness", _fairness,
        """assoc-hull fairness ship.hull
        assoc-hull fairness ship.hull "WL 5" "WL 7.5" --allowed 1
        assoc-hull fairness ship.hull --compare faired.hull
        assoc-hull fairness ship.hull --json""",
    )  # fmt: skip
    add_hull(parser)
    parser.add_argument(
        "lines", metavar="LINE", nargs="*", help="names of lines (default: all of them)"
    )
    parser.add_argument(
        "--allowed", type=int, default=0, metavar="N",
        help="inflections that are wanted on each curve (default: 0)",
    )  # fmt: skip
    parser.add_argument(
        "--noise",
        type=float,
        metavar="MM",
        help="noise of the source: battens that spring by so little are not judged",
    )
    parser.add_argument(
        "--compare", type=Path, metavar="OTHER",
        help="another .hull or .hull.json file: the same lines after an edit, side by side",
    )  # fmt: skip
    add_json(parser)


def _fairness(arguments: argparse.Namespace) -> int:
    from assoc_hull.fairing.line_fairness import hull_fairness

    lines = arguments.lines or None
    hull = open_hull(arguments.hull)
    after = None if arguments.compare is None else open_hull(arguments.compare)
    with progress("looking at lines"):
        noise = None if arguments.noise is None else 1e-3 * arguments.noise
        found = hull_fairness(hull, lines, arguments.allowed, noise)
        other = None if after is None else hull_fairness(after, lines, arguments.allowed, noise)
    if other is None:
        emit(arguments, found.data(), str(found))
        return 0
    emit(arguments, found.compared(other), found.comparison(other))
    return 0


# --------------------------------------------------------------------------------------
# The command that tells what of a hull changes with what.


def add_sensitivities(commands: Commands) -> None:
    """Add ``sensitivities``."""
    parser = add_command(
        commands, "sensitivities", _tell,
        """assoc-hull sensitivities ship.hull
        assoc-hull sensitivities ship.hull --of volume lcb Cpa "A ST 5" --by breadth fore_shift
        assoc-hull sensitivities ship.hull --by mean_draught trim --percent
        assoc-hull sensitivities ship.hull --of kmt --point "WL 6 x ST 14" --json""",
    )  # fmt: skip
    add_hull(parser)
    parser.add_argument(
        "--of", metavar="OUTPUT", nargs="+", default=None,
        help='fields of hydrostatics, symbols of form parameters, "A ST 5", "A x=42.5", "R 14 kn"',
    )  # fmt: skip
    parser.add_argument(
        "--by", metavar="PARAMETER", nargs="+", default=None,
        help="named parameters of vary, mean_draught, trim (default: all that the hull has)",
    )  # fmt: skip
    parser.add_argument(
        "--point", metavar="ADDRESS", action="append", default=[],
        help="a point that moves where it is free, others follow; may be given more than once",
    )  # fmt: skip
    parser.add_argument("--kg", type=float, metavar="M", help="centre of gravity above base, m")
    scale = parser.add_mutually_exclusive_group()
    scale.add_argument(
        "--usual", action="store_true", help="changes with a usual change of each parameter"
    )
    scale.add_argument(
        "--percent", action="store_true", help="these in percent of the present values"
    )
    add_json(parser)


def _tell(arguments: argparse.Namespace) -> int:
    from assoc_hull.analysis.derivatives.parameters import PointMove
    from assoc_hull.variation.sensitivities import sensitivities

    points = [PointMove(each, follow=True) for each in arguments.point]
    by = None if arguments.by is None and not points else [*(arguments.by or ()), *points]
    hull = open_hull(arguments.hull)
    with progress("differentiating"):
        found = sensitivities(hull, arguments.of, by, kg=arguments.kg)
    scale = "percent" if arguments.percent else "usual" if arguments.usual else "unit"
    emit(arguments, found.document(), found.table(scale))
    return 0


# --------------------------------------------------------------------------------------
# The command that writes the objects of a hull and their links as a graph.

_FORMATS = ("dot", "graphml", "mermaid", "json")
_ONLY = ("two-way", "one-way", "latent", "changed")


def add_graph(commands: Commands) -> None:
    """Add ``graph``."""
    parser = add_command(
        commands, "graph", _graph,
        """assoc-hull graph ship.hull --format dot --around "WL 0.5 x ST 7" --hops 2
        assoc-hull graph ship.hull --only one-way --around "WL 0.5" --hops 2 --format mermaid
        assoc-hull graph ship.hull --format graphml -o ship.graphml""",
    )  # fmt: skip
    add_hull(parser)
    form = parser.add_mutually_exclusive_group()
    form.add_argument("--format", choices=_FORMATS, help="default: dot")
    form.add_argument(
        "--json", dest="format", action="store_const", const="json", help="as --format json"
    )
    _add_filters(parser)
    parser.add_argument("-o", "--out", type=Path, metavar="FILE", help="a file to write to")


def _add_filters(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--around", metavar="ID", help="only what lies near this object: its address or key"
    )
    parser.add_argument("--hops", type=_count, metavar="K", help="how near, in links (default: 1)")
    parser.add_argument(
        "--up", type=_count, metavar="K", help="how near against the links (default: as --hops)"
    )
    parser.add_argument(
        "--down", type=_count, metavar="K", help="how near along the links (default: as --hops)"
    )
    parser.add_argument(
        "--only", choices=_ONLY,
        help="links by which both sides generate points, only one does, or none yet does; or "
        "what an edit changed",
    )  # fmt: skip
    parser.add_argument(
        "--step", type=int, metavar="N",
        help="only what the edit of this number changed, as `history` lists it; -1 is the last "
        "(default with --only changed: the last)",
    )  # fmt: skip


def _count(text: str) -> int:
    """Take a whole number, 0 or more."""
    number = int(text) if text.isdecimal() else -1
    if number < 0:
        raise argparse.ArgumentTypeError(f"{text!r} is no number of links, 0 or more")
    return number


def _graph(arguments: argparse.Namespace) -> int:
    from assoc_hull.graph.graph_text import graph_text
    from assoc_hull.io.write_file import write_whole

    up, down = _hops(arguments)
    if arguments.out is not None:
        check_other_target(arguments.out, arguments.hull)
    hull = open_hull(arguments.hull)
    with progress("writing the graph"):
        found = hull.graph(
            around=arguments.around, up=up, down=down, only=arguments.only, step=arguments.step
        )
        text = graph_text(found, arguments.format or _FORMATS[0])
    if not len(found):
        print("nothing passes these filters: the graph is empty", file=sys.stderr)
    if arguments.out is None:
        _print(text)
    else:
        write_whole(arguments.out, text.encode())
    return 0


def _print(text: str) -> None:
    """Print UTF-8, as the forms demand, whatever the terminal prefers."""
    bare = getattr(sys.stdout, "buffer", None)
    if bare is None:
        print(text, end="")
        return
    sys.stdout.flush()
    bare.write(text.encode())
    bare.flush()


def _hops(arguments: argparse.Namespace) -> tuple[int, int]:
    """Give most hops against and along the links."""
    given = [name for name in ("hops", "up", "down") if getattr(arguments, name) is not None]
    if given and arguments.around is None:
        raise UsageError(f"--{given[0]} without an object, in assoc-hull graph; add --around ID")
    both = 1 if arguments.hops is None else arguments.hops
    return (
        both if arguments.up is None else arguments.up,
        both if arguments.down is None else arguments.down,
    )


# --------------------------------------------------------------------------------------
# The command that draws a hull.


def add_plot(commands: Commands) -> None:
    """Add ``plot``."""
    parser = add_command(
        commands, "plot", _plot,
        """assoc-hull plot ship.hull -o lines.pdf --paper A1
        assoc-hull plot ship.hull -o stern.pdf --heat residual --x -5 50
        assoc-hull plot ship.hull -o combs.svg --combs "WL 0.5" "BTK 0.44"
        assoc-hull plot ship.hull -o combs.pdf --view combs --heat ratio
        assoc-hull plot ship.hull -o moved.pdf --before old.hull --exaggerate 50
        assoc-hull plot ship.hull -o definitions.pdf --view definitions""",
    )  # fmt: skip
    add_hull(parser)
    parser.add_argument(
        "-o", "--out", type=Path, required=True, metavar="FILE", help="a .pdf, .svg or .png file"
    )
    parser.add_argument("--paper", choices=("A3", "A1"), default="A3", help="default: A3")
    parser.add_argument(
        "--combs", nargs="+", metavar="LINE", help="draw these lines with their curvature"
    )
    parser.add_argument(
        "--view", choices=("lines", "combs", "definitions"), default="lines",
        help="the lines, all of them with their curvature, or the definitions of a created hull "
        "with theirs",
    )  # fmt: skip
    parser.add_argument(
        "--heat", choices=("residual", "ratio"),
        help="colour lines by how far a batten springs off each point, mm, or by how far from "
        "those of the lines beside, over the usual",
    )  # fmt: skip
    parser.add_argument(
        "--x", nargs=2, type=float, metavar=("AFT", "FORE"), help="draw this stretch only, m"
    )
    parser.add_argument(
        "--before", type=Path, metavar="OTHER", help="draw what moved since that hull"
    )
    parser.add_argument(
        "--exaggerate", type=float, metavar="TIMES",
        help="with --before: draw movements along the hull's normal so many times as large",
    )  # fmt: skip
    add_json(parser)


def _plot(arguments: argparse.Namespace) -> int:
    check_target(arguments.out, PICTURE_ENDINGS)
    _refuse_together(arguments)
    hull = open_hull(arguments.hull)
    with progress(f"drawing {arguments.out}"):
        _draw(hull, arguments)
    emit(arguments, {"saved": str(arguments.out)}, f"written: {arguments.out}")
    return 0


def _refuse_together(arguments: argparse.Namespace) -> None:
    """Refuse options that go with another picture."""
    if arguments.combs and arguments.view != "lines":
        raise UsageError("--combs needs --view lines, in plot; leave one out")
    if arguments.exaggerate is not None and arguments.before is None:
        raise UsageError("--exaggerate without --before, in plot; add --before OTHER")
    other = arguments.combs or arguments.view != "lines" or arguments.heat
    if arguments.before is not None and other:
        raise UsageError("--before draws what moved, in plot; leave the other picture out")
    if arguments.view == "definitions" and (arguments.heat or arguments.x):
        raise UsageError("--heat and --x go with lines and combs, in plot; leave them out")


def _draw(hull: Hull, arguments: argparse.Namespace) -> None:
    """Draw the picture that was asked for."""
    out, paper, heat = arguments.out, arguments.paper, arguments.heat
    x = None if arguments.x is None else (arguments.x[0], arguments.x[1])
    if arguments.view == "definitions":
        from assoc_hull.plot import definition_curves

        definition_curves(hull.state, out, paper=paper)
    elif arguments.before is not None:
        other = open_hull(arguments.before)
        other.plot.comparison(hull, out, paper=paper, exaggerate=arguments.exaggerate, x=x)
    elif arguments.combs:
        hull.plot.curvature_combs(arguments.combs, out, paper=paper, heat=heat, x=x)
    elif arguments.view == "combs":
        hull.plot.combs(out, paper=paper, heat=heat, x=x)
    else:
        hull.plot.lines_plan(out, paper=paper, heat=heat, x=x)
