"""Tables and sections of hulls, exported and read back: `python -m tests.table_round_trips`.

For each hull and form: how many points were written, how far the farthest comes back from where it
was, half of the last printed digit, what volume the hull has that is read of it, the verdict, and
what the export said that the form cannot hold.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import attrs
import numpy as np

import assoc_hull as ah
from assoc_hull.errors import AssocHullError
from assoc_hull.hull import Hull
from assoc_hull.io.digitised.read import read_lines
from assoc_hull.io.export.sections import sections_to_export
from assoc_hull.io.lines.line_points import LinePolylines, lines_as_points
from assoc_hull.io.offsets.read import read_offsets
from assoc_hull.io.reports import ExportBook

TABLES = ("csv", "xlsx")
SECTIONS = ("britfair", "gf", "delftship")
FORMS = (*TABLES, *SECTIONS, "delftship-offsets")


def yacht() -> Hull:
    """Sysser 1, from its table."""
    data = Path(os.environ.get("ASSOC_HULL_DATA", Path(__file__).parents[2] / "shared" / "data"))
    return ah.read(data / "sysser1" / "sysser01_offsets.csv", length=10.0474)


HULLS: dict[str, Callable[[], Hull]] = {
    "wigley": ah.examples.wigley,
    "series60": ah.examples.series60,
    "yacht": yacht,
    "container_ship_225m": ah.examples.container_ship_225m,
    "bulk_carrier_207k": ah.examples.bulk_carrier_207k,
}


@attrs.frozen
class RoundTrip:
    """One hull through one form; lengths in m, `volume` off by so large a part."""

    hull: str
    form: str
    points: int
    farthest: float
    digit: float
    told: tuple[str, ...]
    volume: float
    verdict: str

    def __str__(self) -> str:
        return (
            f"{self.hull:20s} {self.form:18s} {self.points:6d} points, "
            f"{1e3 * self.farthest:.5f} of {1e3 * self.digit:.5f} mm, "
            f"V {100.0 * self.volume:+.3f} %, {self.verdict}; "
            f"told: {', '.join(self.told) or 'nothing'}"
        )


def round_trip(name: str, hull: Hull, form: str, folder: Path) -> RoundTrip:
    """Export, read the points, and read the hull as a user does."""
    path = folder / f"{name}.{form if form in TABLES else 'txt'}"
    report = hull.export(path, form)
    far = table_off(hull, path) if form in TABLES else lines_off(hull, form, path)
    told = sorted({note.kind for note in (*report.left_out, *report.mended)})
    ship = hull.particulars
    options: dict[str, Any] = (
        {} if form in TABLES else {"ap": "0 m", "length": ship.length, "draught": ship.draught}
    )
    try:
        back = ah.read(path, accept=True, deck=ship.deck, **options)
        volume = back.hydrostatics(on_error="report").volume
        truth = hull.hydrostatics(on_error="report").volume
        notes = back.adoption.notes if back.adoption else ()
        [verdict] = [note for note in notes if note.startswith("verdict")]
    except AssocHullError as error:
        truth, volume, verdict = 1.0, float("nan"), f"refused: {str(error)[:80]}"
    return RoundTrip(
        name, form, report.points, far, report.rounding, tuple(told), volume / truth - 1.0, verdict
    )


def table_off(hull: Hull, path: Path) -> float:
    """Give how far the farthest half-breadth of a table is off the section of the hull, m."""
    table = read_offsets(path)[0]
    worst = 0.0
    for line in hull.groups["sections"].lines.values():
        i = int(np.abs(table.x - (line.position or 0.0)).argmin())
        for j, z in enumerate(table.z.tolist()):
            met = line.meet(((0.0, 0.0, 1.0), z))
            if len(met) and np.isfinite(table.half_breadth[i, j]):
                worst = max(worst, abs(float(met[:, 1].max()) - float(table.half_breadth[i, j])))
    return worst


def lines_off(hull: Hull, form: str, path: Path) -> float:
    """Give how far the farthest point of a line is off where it was written from, m."""
    found = read_lines(path)
    worst = 0.0
    for line in written(hull, form):
        [same] = [o for o in found.group(line.group) if abs(o.offset - line.offset) < 1e-3]
        for one, other in zip(line.pieces, same.pieces, strict=True):
            worst = max(worst, float(np.abs(one.points - other.points).max()))
    return worst


def written(hull: Hull, form: str) -> list[LinePolylines]:
    """The lines that a form holds, as points before rounding."""
    if form in SECTIONS:
        return sections_to_export(hull.state, ExportBook(decimals=9))
    return lines_as_points(hull.state, ("sections", "waterlines", "buttocks"))


def round_trips(names: Sequence[str], forms: Sequence[str]) -> Iterator[RoundTrip]:
    """All of them, one by one."""
    with TemporaryDirectory() as folder:
        for name in names:
            hull = HULLS[name]()
            for form in forms:
                yield round_trip(name, hull, form, Path(folder))


def main(arguments: Sequence[str] | None = None) -> int:
    """Run from the command line; 1 if a point comes back off its printed digits."""
    parser = argparse.ArgumentParser(prog="python -m tests.table_round_trips", description=__doc__)
    parser.add_argument("--hulls", nargs="*", choices=HULLS, default=list(HULLS))
    parser.add_argument("--forms", nargs="*", choices=FORMS, default=list(FORMS))
    given = parser.parse_args(arguments)
    off = 0
    for each in round_trips(given.hulls, given.forms):
        print(each, flush=True)
        off += not each.farthest <= each.digit * (1.0 + 1e-6)
    return 1 if off else 0


if __name__ == "__main__":
    sys.exit(main())
