"""A thousand variants of the bulk carrier, beside a loop of single calls.

``python -m benchmarks.variants_study [--count 1000] [--workers 2] [--beside 24] [--single 6]``
aims at volume, LCB and KM_T drawn at random, with breadth and the shifts of both bodies free. First
some variants are made by a study in this process and some by calls of ``vary``, in turns, and their
times of the processor are compared. Then all are made, and counted: how many have a hull, what the
others lack, and how well targets are met by hulls that are made once more.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter
from collections.abc import Sequence
from typing import Any

import numpy as np

import assoc_hull as ah
from assoc_hull.cli.output import progress_bar
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.hull.studies import Study

__all__ = ["beside", "facts", "request"]

FREE = ("breadth", "fore_shift", "aft_shift")
AIMS = ("volume", "lcb", "kmt")
_AGAIN = 10
"""So many hulls are made once more and measured by `hydrostatics`."""


def request(hull: ah.Hull, count: int, seed: int = 1) -> dict[str, Any]:
    """Draw targets within reach of shifts of 15 m: V 1 %, LCB 0.2 % of L, KM_T 0.1 m either way."""
    now = hull.hydrostatics(estimate=False)
    part = {"volume": 0.01 * now.volume, "lcb": 0.002 * hull.particulars.length, "kmt": 0.1}
    ends = {name: (getattr(now, name) - by, getattr(now, name) + by) for name, by in part.items()}
    bounds = {"fore_shift": (-15.0, 15.0), "aft_shift": (-15.0, 15.0)}
    return {"reach": ah.study.sample(ends, count, seed=seed), "free": FREE, "bounds": bounds}


def beside(hull: ah.Hull, asked: dict[str, Any], variants: int, calls: int) -> tuple[float, float]:
    """Give the seconds of the processor of one variant in a study, and of one call of `vary`.

    The study is made in as many parts as there are calls, in turns with them. What it prepares
    first is counted apart, by a study of no more than one variant, and left out.
    """
    one = {**asked, "reach": {name: column[:1] for name, column in asked["reach"].items()}}
    begin, spent = [], np.zeros(2)
    for _ in range(2):
        start = time.process_time()
        hull.study(**one)
        begin.append(time.process_time() - start)
    for part in np.array_split(np.arange(variants), calls):
        some = {name: column[part] for name, column in asked["reach"].items()}
        start = time.process_time()
        hull.study(**{**asked, "reach": some})
        middle = time.process_time()
        hull.vary(**_single(asked, int(part[0])))
        spent += middle - start, time.process_time() - middle
    more = variants - calls  # of each part one variant is paid for with what is prepared
    return float((spent[0] - calls * min(begin)) / more), float(spent[1] / calls)


def _single(asked: dict[str, Any], number: int) -> dict[str, Any]:
    """Give what a call of `vary` is asked for to make one variant."""
    reach = {name: float(column[number]) for name, column in asked["reach"].items()}
    return {"reach": reach, "free": list(asked["free"]), "bounds": asked["bounds"]}


def facts(found: Study, seconds: float) -> list[str]:
    """Say what came of all variants."""
    table = found.table()
    good = [row.number for row in found.rows if not row.failure]
    counts = Counter(row.failure for row in found.failed)
    reasons = ", ".join(f"{count} {kind}" for kind, count in sorted(counts.items())) or "none"
    return [
        f"variants with a hull           {len(good)} of {len(found)}",
        f"without one                    {reasons}",
        f"per second, all processes      {len(found) / seconds:.2f} ({seconds:.0f} s)",
        f"least margin of a map          {np.nanmin(table['margin']):.3f}",
        f"largest movement of a point    {np.nanmax(table['shift']):.2f} m",
        f"hulls made for a variant       {table['trials'][good].mean():.2f}",
        f"largest residual               {np.nanmax(table['residual']):.1e}",
        f"the same, hulls made anew      {_again(found, good[:: max(1, len(good) // _AGAIN)]):.1e}",
    ]


def _again(found: Study, numbers: Sequence[int]) -> float:
    """Make hulls once more, and give the largest part of a target that these lack."""
    worst: list[float] = []
    for number in numbers:
        record = found.hull(number).hydrostatics(estimate=False)
        got: FloatArray = np.array([getattr(record, name) for name in found.design.aims])
        worst.append(float(np.abs(got / found.design.targets[number] - 1.0).max()))
    return max(worst, default=np.nan)


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--beside", type=int, default=24)
    parser.add_argument("--single", type=int, default=6)
    given = parser.parse_args(arguments)
    hull = ah.examples.bulk_carrier_207k()
    asked = request(hull, given.count)
    if given.single:
        each, alone = beside(hull, asked, given.beside, given.single)
        print(f"one variant of a study         {each:.2f} s of the processor")
        print(f"one call of vary               {alone:.2f} s")
        print(f"ratio                          {alone / each:.1f}", flush=True)
    start = time.perf_counter()
    with progress_bar("study", hidden=False) as tell:
        found = hull.study(**asked, workers=given.workers, progress=tell)
    print("\n".join(facts(found, time.perf_counter() - start)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
