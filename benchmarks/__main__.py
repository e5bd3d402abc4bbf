"""Run the benchmarks and print one table: ``python -m benchmarks [--quick] [name ...]``."""

from __future__ import annotations

import argparse
import importlib
import os
import platform
import sys
from collections.abc import Sequence
from datetime import UTC, datetime

from benchmarks.clock import Figure

NAMES = (
    "full_reloft", "one_edit", "edits", "drags", "drag_session", "start", "session",
    "long_session", "hydrostatics", "variation_methods", "variants", "form_curves",
    "created_hulls", "six_numbers", "biarcs", "production_arcs", "classical_splines",
    "conformal_sections",
    "curvature_regions", "surface_fit", "cad_files", "cad_slicing", "closed_mesh", "doctor",
    "fairing", "fair_edits", "leads", "switches", "page",
)  # fmt: skip


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the named benchmarks, or all; 1 if a goal is missed."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="name", help=", ".join(NAMES))
    parser.add_argument("--quick", action="store_true", help="fewer rounds: coarser figures")
    chosen = parser.parse_args(arguments)
    unknown = sorted(set(chosen.names) - set(NAMES))
    if unknown:
        parser.error(f"no benchmark is called {unknown[0]}; there are {', '.join(NAMES)}")
    found: list[Figure] = []
    for name in chosen.names or NAMES:
        print(f"running {name} ...", file=sys.stderr, flush=True)
        found += importlib.import_module(f"benchmarks.{name}").figures(chosen.quick)
    print(_machine())
    print(table(found))
    return int(not all(figure.holds for figure in found))


def _machine() -> str:
    day = datetime.now(UTC).date().isoformat()
    return (
        f"{day}, Python {platform.python_version()}, {platform.machine()}, {os.cpu_count()} cores"
    )


def table(figures: Sequence[Figure]) -> str:
    """Give figures as a table."""
    rows = [("what", "figure", "goal", "met"), *(figure.cells() for figure in figures)]
    widths = [max(len(row[column]) for row in rows) for column in range(4)]
    lines = [
        "  ".join(
            (name.ljust(widths[0]), value.rjust(widths[1]), goal.ljust(widths[2]), met)
        ).rstrip()
        for name, value, goal, met in rows
    ]
    return "\n".join([lines[0], "-" * len(max(lines, key=len)), *lines[1:]])


if __name__ == "__main__":
    sys.exit(main())
