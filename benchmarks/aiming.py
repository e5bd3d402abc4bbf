"""Aiming on three ships: ``python -m benchmarks.aiming [--ships NAME ...]``.

Targets are 1 % more volume, LCB 0.3 % of Lpp further forward, KM_T 0.2 m higher, and, where there
are five, C_W 0.005 larger and the midship section 0.2 % smaller. Three, five or seven parameters
are free. Beside the least change stand plain shortest steps. Then one call of `Hull.vary` is looked
at from outside, and what it says of a volume that is out of reach. Some ten minutes of one core.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise

import numpy as np

import assoc_hull as ah
from assoc_hull.errors import UnreachableError
from assoc_hull.variation.aiming.newton_iteration import StoppingRule
from assoc_hull.variation.aiming.reach_targets import problem_of
from assoc_hull.variation.aiming.report import AimReport
from assoc_hull.variation.aiming.target_solver import solve_targets
from assoc_hull.variation.request import VariationRequest
from benchmarks.ships import duisburg_test_case

__all__ = ["free_of", "targets_of"]

SHIPS: Mapping[str, Callable[[], ah.Hull | None]] = {
    "series60": ah.examples.series60, "dtc": duisburg_test_case,
    "carrier": ah.examples.bulk_carrier_207k,
}  # fmt: skip
THREE = ("volume", "lcb", "kmt")
FIVE = (*THREE, "cw", "a_midship")

_ROUNDING = 1e-13
"""Residuals below are rounding: how they compare with the last one says nothing."""


def targets_of(hull: ah.Hull) -> dict[str, float]:
    """Give the five targets of a hull."""
    now = hull.hydrostatics()
    return {
        "volume": 1.01 * now.volume, "lcb": now.lcb + 0.003 * hull.particulars.length,
        "kmt": now.kmt + 0.2, "cw": now.cw + 0.005, "a_midship": 0.998 * now.a_midship,
    }  # fmt: skip


def free_of(hull: ah.Hull, count: int) -> list[object]:
    """Give what is free: three parameters; one more and a field; two more fields."""
    named: list[object] = ["breadth", "fore_shift", "aft_shift"]
    waterline, turn = (0.6, 1.0, 1.5), (0.02, 0.2, 0.5)
    fore = _broader(hull, "fore waterline", (0.55, 0.8, 0.97), (0.0, 0.05, 0.0), waterline)
    aft = _broader(hull, "aft waterline", (0.03, 0.2, 0.45), (0.0, 0.05, 0.0), waterline)
    bilge = _broader(hull, "bilge", (0.1, 0.4, 0.6, 0.9), (0.0, 0.01, 0.01, 0.0), turn)
    more = {3: [], 5: ["draught", fore], 7: ["draught", fore, aft, bilge]}
    return [*named, *more[count]]


def _broader(
    hull: ah.Hull, name: str, x: Sequence[float], ratios: Sequence[float], z: Sequence[float]
) -> dict[str, object]:
    """Give a field that widens a part of the hull, at parts of its length and draught."""
    length, draught = hull.particulars.length, hull.particulars.draught
    along = {"x": [each * length for each in x], "v": list(ratios)}
    walls = [[f"{each:g} T", each * draught] for each in z]
    stack = {"name": name, "axis": "y", "boundaries": walls, "pieces": [{}, {"a": along}, {}]}
    return {"name": name, "fields": [{"stack": stack}]}


def aim(
    hull: ah.Hull, names: Sequence[str], count: int, rule: StoppingRule
) -> tuple[AimReport, float]:
    """Aim from a hull; give what was found, and the seconds of the processor that it took."""
    targets = targets_of(hull)
    ask = VariationRequest.of(
        reach={name: targets[name] for name in names}, free=free_of(hull, count)
    )
    start = time.process_time()
    problem = problem_of(hull.state, ask)
    before = problem.at(np.zeros(count)).values
    found = solve_targets(
        problem, [targets[name] for name in names], start=np.zeros(count),
        scales_free=[each.usual for each in problem.maps.free], scales_out=np.abs(before),
        rule=rule,
    )  # fmt: skip
    return found, time.process_time() - start


def ratio(found: AimReport) -> float:
    """Give the largest residual over the square of the last one, below 1e-2 and above rounding."""
    pairs = pairwise(each.residual for each in found.steps)
    return max(
        (after / before**2 for before, after in pairs if before <= 1e-2 and after > _ROUNDING),
        default=0.0,
    )


def table(hull: ah.Hull) -> None:
    """Print how targets are reached."""
    print("| targets, free | residuals | r(k+1) / r(k)^2 | condition | change | KKT | CPU s |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    cases = (THREE, 3, True), (FIVE, 5, True), (FIVE, 7, True), (FIVE, 7, False)
    for names, count, least in cases:
        found, seconds = aim(hull, names, count, StoppingRule(least=least))
        residuals = ", ".join(f"{each.residual:.1e}" for each in found.steps)
        what = f"{len(names)}, {count}" + ("" if least else ", shortest steps")
        square = count == len(names)
        by, kkt = (f"{ratio(found):.2g}", "") if square else ("", f"{found.kkt:.1e}")
        print(
            f"| {what} | {residuals} | {by} | {found.condition:.3g} | {found.change:.6f} | "
            f"{kkt} | {seconds:.0f} |",
            flush=True,
        )


def published(hull: ah.Hull) -> None:
    """Print what a call of `Hull.vary` gives, measured from outside."""
    targets = targets_of(hull)
    start = time.process_time()
    variant = hull.vary(reach=targets, free=free_of(hull, 5))
    seconds = time.process_time() - start
    now = variant.hull.hydrostatics()
    off = max(abs(getattr(now, name) / value - 1.0) for name, value in targets.items())
    same = hull.vary_by(variant.report.script or {}).hull.fingerprint
    print(
        f"Hull.vary to five targets: {off:.1e} off on the published hull, {seconds:.0f} s of CPU; "
        f"its script gives the same hull: {same == variant.hull.fingerprint}"
    )


def out_of_reach(hull: ah.Hull) -> None:
    """Print what is said of 10 % more volume when stations may move by 2 m only."""
    fingerprint, steps = hull.fingerprint, len(hull.history)
    volume = hull.hydrostatics().volume
    ends = {"fore_shift": (-2.0, 2.0), "aft_shift": (-2.0, 2.0)}
    try:
        hull.vary(reach={"volume": 1.1 * volume}, free=list(ends), bounds=ends, in_place=True)
    except UnreachableError as error:
        print(error)
        shifts = {"fore_shift": 2.0, "aft_shift": -2.0}
        best = hull.vary(set=shifts).hull.hydrostatics().volume
        told = 100.0 * (best - 1.1 * volume) / volume
        same = fingerprint == hull.fingerprint and steps == len(hull.history)
        print(
            f"shortfall {error.shortfall:.7f} %; with both shifts set to their bounds "
            f"{told:.7f} %; the hull is unchanged: {same}"
        )


def main() -> int:
    """Print the tables of the ships."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("--ships", nargs="+", choices=tuple(SHIPS), default=list(SHIPS))
    for name in parser.parse_args().ships:
        hull = SHIPS[name]()
        if hull is None:
            print(f"{name}: ASSOC_HULL_DATA does not name the folder of hulls\n")
            continue
        print(f"{name}:\n")
        table(hull)
        print()
        published(hull)
        out_of_reach(hull)
        print(flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
