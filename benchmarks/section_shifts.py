"""Section shifts on three ships: how well they are met, by how much sections move, fairness.

``python -m benchmarks.section_shifts [--ship series60|carrier|dtc] [--limits]`` prints a row a
shape: what the closed form leaves, the residual of each Newton step, sizes, largest movement, least
1 + delta', changes of the sign of curvature of the waterlines before and after, comb ratios,
seconds. With ``--limits`` it asks for too much, and then for 50 and 98 % of what the refusal says
can be had. The DTC is there if ASSOC_HULL_DATA names the folder of hulls.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator, Sequence
from datetime import UTC, datetime
from itertools import product
from time import perf_counter

import assoc_hull as ah
from assoc_hull.errors import AssocHullError, OutOfRangeError
from assoc_hull.variation.comparing.line_fairness import (
    FairnessComparison,
    LineFairness,
    compare_fairness,
    measure_fairness,
)
from assoc_hull.variation.shifts.shift_hull import ShiftWork
from assoc_hull.variation.shifts.shift_terms import SHIFT_SHAPES, ShiftRequest, ShiftShape
from benchmarks.ships import duisburg_test_case

__all__ = ["main"]

_ASKED = {
    "series60": {"cb": 0.02, "lcb_percent": 0.5},
    "carrier": {"cb": 0.005, "lcb_percent": 0.2},
    "dtc": {"cb": 0.01, "lcb_percent": 0.3},
}
_SHIPS: dict[str, Callable[[], ah.Hull | None]] = {
    "series60": ah.examples.series60,
    "carrier": ah.examples.bulk_carrier_207k,
    "dtc": duisburg_test_case,
}


def _waterlines(hull: ah.Hull) -> dict[str, LineFairness]:
    """Give the fairness of the waterlines by key."""
    names = set(hull.groups["waterlines"].lines)
    return {key: each for key, each in measure_fairness(hull.state).items() if each.name in names}


def _row(hull: ah.Hull, shape: ShiftShape, asked: dict[str, float]) -> str:
    begin = perf_counter()
    try:
        found = hull.shift_sections(by=asked, shape=shape)
    except AssocHullError as error:
        return f"| {shape} | refused: {error} |"
    seconds = perf_counter() - begin
    report = found.report
    table: FairnessComparison = compare_fairness(_waterlines(hull), _waterlines(found.hull))
    residuals = ", ".join(f"{step.residual:.1e}" for step in report.steps)
    return (
        f"| {shape} | {residuals} | {report.fore:+.4f} | {report.aft:+.4f} "
        f"| {report.shift.largest:.3f} | {report.shift.least:.3f} "
        f"| {table.before} -> {table.after} | {table.median:.2f} / {table.worst:.2f} "
        f"| {seconds:.1f} |"
    )


def _rows(name: str) -> Iterator[str]:
    hull = _SHIPS[name]()
    if hull is None:
        yield "ASSOC_HULL_DATA is not set: no Duisburg Test Case"
        return
    asked = _ASKED[name]
    words = " and ".join(f"{key} {value:+g}" for key, value in asked.items())
    at = ShiftWork.of(hull.state, ShiftRequest.of(by=asked)).terms.terminals
    yield f"{hull.state.particulars.name}: {words}; terminals {at.places.round(3).tolist()} m"
    yield (
        "| shape | residuals | c_f, m | c_a, m | largest, m | least 1+delta' | waterlines "
        "| combs, median / worst | s |"
    )
    yield "| --- " * 9 + "|"
    for shape in SHIFT_SHAPES:
        yield _row(hull, shape, asked)


def _limit_rows(name: str) -> Iterator[str]:
    """Ask for parts of the largest changes, which refusals tell."""
    hull = _SHIPS[name]()
    if hull is None:
        return
    yield hull.state.particulars.name
    yield "| shape | change | residuals | least 1+delta' | adopted points |"
    yield "| --- " * 5 + "|"
    shapes: tuple[ShiftShape, ...] = ("c2", "lackenby", "1-cp")
    for shape, key, sign in product(shapes, ("cb", "lcb_percent"), (1.0, -1.0)):
        try:
            hull.shift_sections(by={key: 20.0 * sign}, shape=shape)
        except OutOfRangeError as error:
            limit = error.most if sign > 0.0 else error.least
            for part in (0.5, 0.98):
                yield _limit_row(hull, shape, key, part * limit)


def _limit_row(hull: ah.Hull, shape: ShiftShape, key: str, change: float) -> str:
    try:
        report = hull.shift_sections(by={key: change}, shape=shape).report
    except AssocHullError as error:
        return f"| {shape} | {key} {change:+.4f} | refused: {error} |"
    residuals = ", ".join(f"{step.residual:.1e}" for step in report.steps)
    return (
        f"| {shape} | {key} {change:+.4f} | {residuals} | {report.shift.least:.3f} "
        f"| {report.variation.added} |"
    )


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the tables."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.section_shifts")
    parser.add_argument("--ship", choices=tuple(_SHIPS), help="one ship only")
    parser.add_argument("--limits", action="store_true", help="parts of the largest changes")
    given = parser.parse_args(arguments)
    print(datetime.now(UTC).date().isoformat())
    for name in [given.ship] if given.ship else _SHIPS:
        for row in _limit_rows(name) if given.limits else _rows(name):
            print(row, flush=True)
        print()
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
