"""What the choices of the method are based on, measured on two ships.

``python -m benchmarks.variation_tables [--ship carrier|dtc]`` prints, on the 207k carrier, and on
the Duisburg Test Case where the data folder is there: the methods side by side; a larger bossing
with and without its tube; parameters that see each other, and six together; the inverse; what
lofting again costs.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from datetime import UTC, datetime

from assoc_hull.model.tables import HullState
from benchmarks.variation_bossing import GROWTH, HATS, tubes
from benchmarks.variation_inverse import inverses
from benchmarks.variation_methods import lines, ships, title
from benchmarks.variation_reloft import SPACING, TOLERANCES, relofted
from benchmarks.variation_tasks import METHODS, Task, tasks
from benchmarks.variation_together import overlapping, together

__all__ = ["main"]


def _lofted(state: HullState, task: Task) -> Iterator[str]:
    """Give what lofting again costs."""
    for name in HATS:
        it = relofted(state, METHODS[name][0](task, METHODS[name][1]))
        more = ", ".join(
            f"{count} hold {1e3 * tolerance:.0f} mm"
            for count, tolerance in zip(it.needed, TOLERANCES, strict=True)
        )
        yield (
            f"{name}: {it.curves} sections, {it.points} points every {SPACING} m, "
            f"{1e3 * it.error:.1f} mm off; {more}"
        )


def _tell(head: str, rows: Iterator[str]) -> None:
    print(f"{head}\n" + "\n".join(f"  {row}" for row in rows), end="\n\n", flush=True)


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the tables."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.variation_tables")
    parser.add_argument("--ship", choices=("carrier", "dtc"), action="append")
    chosen = parser.parse_args(arguments).ship or ["carrier", "dtc"]
    print(datetime.now(UTC).date().isoformat())
    for name, hull in ships():
        if name.lower() not in chosen:
            continue
        state = hull.document.state
        every = tasks(state)
        for task in every:
            _tell(f"{name}, methods: {title(task)}", lines(state, task))
        shaft = every[0]
        _tell(f"{name}, bossing of {shaft.radius:.3f} m x {GROWTH:.3f}", tubes(state, shaft))
        _tell(f"{name}, two parameters at one place", overlapping(shaft))
        _tell(f"{name}, six parameters together", together(state))
        _tell(f"{name}, inverse: {title(shaft)}", inverses(state, shaft))
        for task in every:
            _tell(f"{name}, lofted again: {title(task)}", _lofted(state, task))
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
