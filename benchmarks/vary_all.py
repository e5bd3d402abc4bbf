"""Every named parameter on two ships: what was reached, what moved, and how fair it is.

``python -m benchmarks.vary_all [--write docs/variation_figures.json] [name ...]`` varies the bulk
carrier, and the Duisburg Test Case where the data folder is there, by each parameter alone, in both
senses, and prints tables.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path

import attrs
import numpy as np

import assoc_hull as ah
from assoc_hull.errors import AssocHullError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.hull.variants import Variation
from assoc_hull.model.tables import HullState
from assoc_hull.variation.comparing.line_fairness import (
    LineFairness,
    compare_fairness,
    measure_fairness,
)
from assoc_hull.variation.parameters.catalogue import NAMES
from benchmarks.ships import duisburg_test_case

__all__ = ["AMOUNTS", "Row", "rows", "table"]

AMOUNTS: dict[str, tuple[float, float]] = {
    "length": (0.02, 0.0), "breadth": (0.03, 0.0), "draught": (0.05, 0.0), "depth": (-0.04, 0.0),
    "deck_height": (0.0, 0.5), "shaft_height": (0.0, 1.0), "bossing_radius": (0.0, 0.275),
    "transom_height": (0.0, 0.6), "transom_half_breadth": (0.05, 0.0), "bulb_height": (0.0, 0.5),
    "bulb_half_breadth": (0.08, 0.0), "bulb_area": (0.08, 0.0), "bulb_section_height": (0.0, 0.2),
    "bulb_length": (0.0, 1.0), "bilge_radius": (0.25, 0.0),
    "deadrise_deg": (0.0, 0.4), "flat_of_bottom": (-0.02, 0.0), "parallel_body_start": (0.0, 8.0),
    "parallel_body_end": (0.0, -8.0), "stem_rake_deg": (0.0, 3.5), "fore_shift": (0.0, 2.0),
    "aft_shift": (0.0, 2.0), "parallel_body_length": (0.0, 8.0), "sheer_fore": (0.0, 0.5),
    "sheer_aft": (0.0, 0.5), "fore_frame_height": (0.01, 0.0), "aft_frame_height": (0.01, 0.0),
    "entrance_deg": (0.0, 1.0), "run_deg": (0.0, 1.0), "waterline_fullness": (0.004, 0.0),
}  # fmt: skip
"""Part of the present value, and m or degrees, by which each is changed."""

_BODY = ("parallel_body_length", "parallel_body_start", "parallel_body_end")
_OF_BODY = 0.2
"""A parallel body is changed by no more than this part of its length."""

_SHAPES = frozenset({
    "sheer_fore", "sheer_aft", "fore_frame_height", "aft_frame_height", "entrance_deg", "run_deg",
    "waterline_fullness", "parallel_body_length", "bulb_area", "bulb_section_height",
})  # fmt: skip
"""Parameters of shape, which are counted apart as well."""


@attrs.frozen
class Faired:
    """The same variation with its followers faired.

    Attributes
    ----------
    miss : float
        Measured less asked, m or degrees.
    after : int
        Changes of sign of curvature more than the parent has, over all lines together.
    more_before, more : int
        The same over the lines that have more, by the map alone and faired.
    worst : float
        The largest ratio of comb integrals.
    worst_line, left : str
        Its line; lines that have more still.
    points : int
        How many moved.
    largest : float, m
        The farthest.
    seconds : float
    trouble : str
        Why there is no variant.
    """

    miss: float = np.nan
    after: int = 0
    more_before: int = 0
    more: int = 0
    worst: float = np.nan
    worst_line: str = ""
    left: str = ""
    points: int = 0
    largest: float = np.nan
    seconds: float = np.nan
    trouble: str = ""


@attrs.frozen
class Row:
    """One variation.

    Attributes
    ----------
    name : str
    asked : float or None
        None if the parent has no such parameter.
    miss : float
        Measured less asked, m or degrees.
    drivers, followers, driven : int
        Points outside the region that are not what they were, to the bit: of drivers, of
        followers, and among these crossings that are computed from a driver.
    drift : float, m
        How far the farthest of the last ones moved.
    before, after : int
        Curvature sign changes of the lines that changed.
    median, worst : float
        Ratio of the comb integrals.
    worst_line : str
    seconds : float
    trouble : str
        Why there is no variant.
    faired : Faired or None
        None where there is no variant.
    """

    name: str
    asked: float | None = None
    miss: float = np.nan
    drivers: int = 0
    followers: int = 0
    driven: int = 0
    drift: float = 0.0
    before: int = 0
    after: int = 0
    median: float = np.nan
    worst: float = np.nan
    worst_line: str = ""
    seconds: float = np.nan
    trouble: str = ""
    faired: Faired | None = None

    def cells(self) -> tuple[str, ...]:
        """Give the row as a table has it."""
        if self.trouble:
            asked = "-" if self.asked is None else f"{self.asked:.6g}"
            return (self.name, asked, self.trouble, *[""] * 6)
        return (
            self.name, f"{self.asked:.6g}", f"{self.miss:.0e}", str(self.drivers),
            f"{self.followers} + {self.driven} ({1e6 * self.drift:.2g} um)",
            f"{self.before} -> {self.after}", f"{self.median:.3f}",
            f"{self.worst:.3f} {self.worst_line}", f"{self.seconds:.1f}",
        )  # fmt: skip

    def faired_cells(self) -> tuple[str, ...]:
        """Give the row of the table of variants with faired followers."""
        found = self.faired
        if found is None or found.trouble:
            return (self.name, "-" if found is None else found.trouble, *[""] * 6)
        return (
            self.name, f"{found.miss:.0e}", f"{self.after - self.before:+d} -> {found.after:+d}",
            f"{found.more_before} -> {found.more}", found.left, f"{found.worst:.3f} "
            f"{found.worst_line}", f"{found.points}, {1e3 * found.largest:.1f}",
            f"{found.seconds:.1f}",
        )  # fmt: skip


FAIRED_HEAD = (
    "parameter", "missed by", "sign changes added", "on lines that gain", "left on",
    "comb, worst", "points moved, mm", "s",
)  # fmt: skip

_MORE = 1.05
"""A comb that fairing made so many times what it was is named."""

HEAD = (
    "parameter", "asked", "missed by", "drivers' points", "followers' points", "sign changes",
    "comb, median", "comb, worst", "s",
)  # fmt: skip


def rows(hull: ah.Hull, sense: float, names: Sequence[str]) -> list[Row]:
    """Vary a hull by each parameter alone."""
    parent = measure_fairness(hull.state)
    return [_row(hull, name, sense, parent) for name in names]


def _row(hull: ah.Hull, name: str, sense: float, parent: dict[str, LineFairness]) -> Row:
    measures = hull.measure(only=[name])
    if name not in measures:
        return Row(name, trouble=str(measures.absent[name]))
    part, amount = AMOUNTS[name]
    if name in _BODY:
        most = _OF_BODY * hull.measure(only=_BODY[:1])[_BODY[0]]
        amount = float(np.clip(amount, -most, most))
    asked = measures[name] + sense * (part * measures[name] + amount)
    start = time.perf_counter()
    try:
        found = hull.vary(set={name: asked})
    except AssocHullError as error:
        return Row(name, asked, trouble=str(error).replace("|", "/"))
    seconds = time.perf_counter() - start
    fair = compare_fairness(parent, measure_fairness(found.hull.state, like=parent))
    worst = fair.worst_line
    faired = _faired(hull, name, asked, parent)
    return Row(
        name, asked, found.report.targets[0].reached - asked, *_moved(hull.state, found),
        fair.before, fair.after, fair.median, fair.worst, worst.name if worst else "", seconds,
        faired=faired,
    )  # fmt: skip


def _faired(hull: ah.Hull, name: str, asked: float, parent: dict[str, LineFairness]) -> Faired:
    """Vary a hull with its followers faired."""
    start = time.perf_counter()
    try:
        found = hull.vary(set={name: asked}, fair=True)
    except AssocHullError as error:
        return Faired(trouble=str(error).replace("|", "/"))
    seconds = time.perf_counter() - start
    fair = compare_fairness(parent, measure_fairness(found.hull.state, like=parent))
    worst, told = fair.worst_line, found.report.faired
    assert told is not None, "it was asked for"
    return Faired(
        found.report.targets[0].reached - asked, fair.added, told.before, told.after, fair.worst,
        worst.name if worst else "",
        ", ".join(f"{line} {was} -> {now}" for line, was, now in told.lines),
        told.points, told.largest, seconds,
    )  # fmt: skip


def _moved(before: HullState, found: Variation) -> tuple[int, int, int, float]:
    """Count the points outside the region that are not what they were."""
    after = found.hull.state
    row_of = {str(after.rows.key[row]): row for row in after.live("rows").tolist()}
    drives = {
        line for line in before.live("lines").tolist()
        if before.lines.boundary[line] >= 0
        or str(before.lines.name[line]) in found.report.drivers
    }  # fmt: skip
    live = before.live("rows")
    outside = live[~_inside(before.rows.xyz[live], found)]
    count, drift = [0, 0, 0], 0.0
    for row in outside.tolist():
        other = row_of.get(str(before.rows.key[row]))
        old = before.rows.xyz[row]
        if other is not None and (after.rows.xyz[other] == old).all():
            continue
        curves = [each for each in before.rows.curve[row].tolist() if each >= 0]
        readers = set(before.rows.reader[row].tolist()) - {-1}
        mine = {curve for curve in curves if before.line_of(curve) in drives} & readers
        computed = other is not None and after.rows.driver[other] >= 0
        if before.rows.role[row] == 3 and not readers:
            continue  # watched: it defines nothing, and has no value
        count[2 if computed else 0 if mine else 1] += 1
        if computed and other is not None:
            drift = max(drift, float(np.sqrt(((after.rows.xyz[other] - old) ** 2).sum())))
    return count[0], count[1], count[2], drift


def _inside(xyz: FloatArray, found: Variation) -> np.typing.NDArray[np.bool_]:
    """Tell which places lie in a box of the region, or on its edge."""
    inside = np.zeros(len(xyz), bool)
    for region in found.report.regions:
        (left, right), (low, high) = region.x, region.z
        inside |= (
            (xyz[:, 0] >= left) & (xyz[:, 0] <= right)
            & (xyz[:, 2] >= low) & (xyz[:, 2] <= high)
        )  # fmt: skip
    return inside


def table(found: Sequence[Row]) -> list[tuple[str, ...]]:
    """Give the head and rows of the table of variants."""
    return [HEAD, *(row.cells() for row in found)]


def faired_table(found: Sequence[Row]) -> list[tuple[str, ...]]:
    """Give the head and rows of the same variants with faired followers."""
    return [FAIRED_HEAD, *(row.faired_cells() for row in found)]


def faired_sum(found: Sequence[Row]) -> str:
    """Say how many variants add no sign change, by the map alone and faired."""
    had = [row for row in found if not row.trouble]
    plain, none, count = _fair_ones(had)
    faired = [row.faired for row in had if row.faired is not None and not row.faired.trouble]
    lost = sum(not each.more for each in faired)
    first = _fair_ones([row for row in had if row.name not in _SHAPES])
    combs = [max((each.worst for each in some), default=1.0) for some in (had, faired)]
    larger = ", ".join(
        f"{row.name} {row.worst:.2f} to {row.faired.worst:.2f}" for row in had
        if row.faired is not None and row.faired.worst > _MORE * row.worst
    )  # fmt: skip
    return (
        f"Of {count} variants {plain} add no change of sign without fairing, {none} with it; in "
        f"{lost} no line at all gains one. Without sheer, frames, entrance, run, fullness, length "
        f"of the body, area and section height of the bulb: {first[0]} and {first[1]} of "
        f"{first[2]}. The worst comb is {combs[0]:.2f} times the parent's without, {combs[1]:.2f} "
        f"with it; combs that fairing made larger: {larger or 'none'}."
    )


def _fair_ones(had: Sequence[Row]) -> tuple[int, int, int]:
    """Count variants that add no change of sign, by the map alone and faired; and all."""
    faired = [row.faired for row in had if row.faired is not None and not row.faired.trouble]
    plain = sum(row.after <= row.before for row in had)
    return plain, sum(each.after <= 0 for each in faired), len(had)


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the tables; write them where it is asked."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.vary_all", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="name", help="parameters (default: all)")
    parser.add_argument("--write", type=Path, metavar="FILE")
    parser.add_argument("--ship", choices=("carrier", "dtc"), action="append")
    chosen = parser.parse_args(arguments)
    names = tuple(chosen.names) or NAMES
    ships = chosen.ship or ["carrier", "dtc"]
    parts = list[str]()
    for ship in ships:
        hull = ah.examples.bulk_carrier_207k() if ship == "carrier" else duisburg_test_case()
        if hull is None:
            print("the data folder is not there: no DTC", file=sys.stderr)
            continue
        for sense, word in ((1.0, "as asked"), (-1.0, "the opposite signs")):
            title = f"{hull.particulars.name}, {word}"
            print(title, file=sys.stderr, flush=True)
            found = rows(hull, sense, names)
            parts.append(_as_json(title, "", table(found)))
            parts.append(_as_json(f"{title}, faired", faired_sum(found), faired_table(found)))
    day = datetime.now(UTC).date().isoformat()
    text = f'{{"day": "{day}", "tables": [\n' + ",\n".join(parts) + "\n]}\n"
    print(text)
    if chosen.write:
        chosen.write.write_text(text, encoding="utf-8")
    return 0


def _as_json(title: str, note: str, cells: Sequence[Sequence[str]]) -> str:
    """Give a table as JSON, a line per row, so that differences of two runs are read."""
    lines = ",\n".join(f"  {json.dumps(row)}" for row in cells)
    head = f'"title": {json.dumps(title)}, "note": {json.dumps(note)}'
    return f'{{{head}, "rows": [\n{lines}\n]}}'


if __name__ == "__main__":
    raise SystemExit(main())
