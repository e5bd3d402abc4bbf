"""What `export --biarcs` does and says: lines as arcs."""

from __future__ import annotations

import argparse

from assoc_hull.analysis.arc_lines import ArcLines
from assoc_hull.cli.output import emit, progress
from assoc_hull.cli.problems import check_other_target
from assoc_hull.sources import open as open_hull

__all__ = ["arc_words", "export_arcs"]


def export_arcs(arguments: argparse.Namespace) -> int:
    """Write the lines that are asked for as arcs, and report them."""
    from assoc_hull.io.export.arc_file import arc_form
    from assoc_hull.production import production_arcs

    form = arc_form(arguments.out)
    check_other_target(arguments.out, arguments.hull)
    hull = open_hull(arguments.hull)
    with progress(f"fitting arcs for {arguments.out}"):
        arcs = production_arcs(
            hull, arguments.lines, arguments.biarcs, arguments.least_radius or 0.0
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
    >>> from assoc_hull.cli.export_arcs import arc_words
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
