"""Random sets of everyday parameters on several hulls: how many `vary` takes, and how well.

    python -m tests.variation_sets [--seed 1] [--count 60] [--hulls carrier ...] [--reach]
    python -m tests.variation_sets --clashes [--seed 1] [--count 4] [--hulls ...]
    python -m tests.variation_sets --planes [--hulls ...]

A set has two to seven parameters, of those that the list of a hull gives a value for, no two of
them one number. Each change is one that is taken alone. What is taken must be met to 1e-6,
`check` must be empty, and undo must bring back the parent to the bit. Pairs that are one number
are drawn apart; each must be refused by both names. Last, values that put a place of the hull
exactly onto a plane of its net, or an end of a feature onto one.
"""

from __future__ import annotations

import argparse
import os
import random
import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache, partial
from itertools import pairwise, zip_longest
from pathlib import Path

import attrs
import numpy as np

import assoc_hull as ah
from assoc_hull.errors import AssocHullError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.carrying.admissible_values import ListedParameter, list_parameters
from tests.foreign_hulls import data_folder

__all__ = ["HULLS", "Outcome", "draw_sets", "outcome"]

HULLS: Mapping[str, Callable[[], ah.Hull]] = {
    "carrier": ah.examples.bulk_carrier_207k,
    "container": ah.examples.container_ship_225m,
    "series60_70": partial(ah.examples.series60, cb=0.7),
    "series60_60": partial(ah.examples.series60, cb=0.6),
    "dtc": lambda: _dtc(),
}
"""The hulls by name."""

_SIZES = ("length", "breadth", "draught", "depth", "deck_height")
_BODY = {"parallel_body_start", "parallel_body_end", "parallel_body_length"}
"""Two of them give the third: all three are refused at once, as pairs that are one number are."""

_MET, _REACHED = 1e-6, 1e-8


def _dtc() -> ah.Hull:
    path: Path = data_folder() / "dtc" / "DTC-scaled.stl.gz"
    return ah.read(path, scale=59.407, draught=14.5)


@cache
def hull_of(name: str) -> ah.Hull:
    """Give a hull; it is only read."""
    return HULLS[name]()


@cache
def listed(name: str) -> tuple[ListedParameter, ...]:
    """Give the parameters of a hull that can be varied."""
    found = list_parameters(hull_of(name).document.state)
    return tuple(each for each in found if each.value is not None and each.reason is None)


def largest_change(each: ListedParameter, length: float) -> float:
    """Give the largest change that is drawn, m or degrees: what is asked for on a working day."""
    assert each.value is not None, "only those with a value are drawn"
    if each.unit == "deg":
        return 1.0
    if each.name in _SIZES:
        return 0.02 * each.value
    local = length / 300.0
    return local if each.name.endswith("_shift") else min(0.1 * abs(each.value), local)


@cache
def _alone(name: str, parameter: str, value: float) -> bool:
    try:
        hull_of(name).vary(set={parameter: value})
    except AssocHullError:
        return False
    return True


def draw_sets(name: str, count: int, seed: int) -> Iterator[dict[str, float]]:
    """Draw sets of changes, each of which is taken alone, one after the other."""
    rng, hull, entries = random.Random(f"{name} {seed}"), hull_of(name), listed(name)
    length = hull.particulars.length
    for i in range(count):
        size = 2 + i % 6
        chosen = dict[str, float]()
        for each in rng.sample(entries, len(entries)):
            if len(chosen) == size:
                break
            if any(other in chosen for other in each.conflicts) or {*chosen, each.name} >= _BODY:
                continue
            most = largest_change(each, length)
            value = (each.value or 0.0) + rng.uniform(-most, most)
            low = -1e9 if each.low is None else each.low
            high = 1e9 if each.high is None else each.high
            if low <= value <= high and _alone(name, each.name, value):
                chosen[each.name] = value
        yield chosen


def draw_clashes(name: str, count: int, seed: int) -> Iterator[dict[str, float]]:
    """Draw pairs that are one number, each with a small change."""
    rng, entries = random.Random(f"clash {name} {seed}"), listed(name)
    by_name = {each.name: each for each in entries}
    pairs = [
        (each, by_name[other]) for each in entries for other in each.conflicts if other in by_name
    ]
    for _ in range(count):
        pair = rng.choice(pairs)
        yield {each.name: (each.value or 0.0) * (1.0 + rng.uniform(-0.01, 0.01)) for each in pair}


_ON_PLANES = {
    "shaft_height": 2, "transom_height": 2, "bulb_height": 2, "transom_half_breadth": 1,
    "bulb_half_breadth": 1, "flat_of_bottom": 1, "parallel_body_start": 0, "parallel_body_end": 0,
}  # fmt: skip
"""The axis along which a parameter moves the place that it is measured at."""


def sets_on_planes(name: str) -> Iterator[dict[str, float]]:
    """Give values that lie exactly on a plane of the net, the nearest, alone and two together."""
    table = hull_of(name).document.state.lines
    live = hull_of(name).document.state.live("lines")
    live = live[table.planar.data[live]]
    offset, normal = table.offset.data[live], table.normal.data[live]
    found = list[dict[str, float]]()
    present = {each.name: each.value or 0.0 for each in listed(name)}
    for parameter, axis in _ON_PLANES.items():
        if parameter not in present:
            continue
        planes = offset[np.abs(normal[:, axis]) == 1.0]
        now, radius = present[parameter], present.get("bossing_radius", 0.0)
        found.append({parameter: _nearest(planes, now)})
        if parameter == "shaft_height" and radius:
            found.append({parameter: _nearest(planes - radius, now)})
            found.append({"bossing_radius": _nearest(planes - now, radius)})
    pairs = [one | other for one, other in pairwise(found)]
    yield from found
    yield from (each for each in pairs if len(each) > 1)


def _nearest(planes: FloatArray, now: float) -> float:
    others = planes[np.abs(planes - now) > _MET]
    return float(others[np.abs(others - now).argmin()])


@attrs.frozen
class Outcome:
    """What became of a set."""

    taken: bool
    worst: float
    sound: bool
    comb: float
    added: int
    rounds: int
    seconds: float
    words: str

    @property
    def good(self) -> bool:
        """Whether it was taken, met, sound, and can be undone."""
        return self.taken and self.worst <= _MET and self.sound


def outcome(hull: ah.Hull, values: Mapping[str, float], **more: object) -> Outcome:
    """Vary a hull by a set, and look at what comes out."""
    begin = time.process_time()
    try:
        varied = hull.vary(set=values, **more)  # type: ignore[arg-type]
    except AssocHullError as error:
        spent = time.process_time() - begin
        return Outcome(
            False, float("nan"), True, 1.0, 0, 0, spent, f"{type(error).__name__}: {error}"
        )
    spent = time.process_time() - begin
    now, report = varied.hull.measure(), varied.report
    worst = max(
        abs(now[name] - value) for name, value in values.items() if not name.endswith("_shift")
    ) if any(not name.endswith("_shift") for name in values) else 0.0  # fmt: skip
    # Lines of a hull that a definition made are its own from the first edit on.
    sound = all("detached" in str(each) for each in varied.hull.check())
    targets, doubts = more.get("reach"), tuple[str, ...]()
    if isinstance(targets, Mapping):
        there = varied.hull.hydrostatics(on_error="report")
        doubts = there.notes  # that the lines are too few to tell a volume is no fault of a target
        sound &= all(
            abs(getattr(there, key) - value) <= _REACHED * abs(value)
            for key, value in targets.items()
        )
    varied.hull.undo()
    sound &= varied.hull.fingerprint == hull.fingerprint
    return Outcome(
        True, worst, sound, report.worst_comb, report.added_sign_changes, report.rounds, spent,
        "; ".join((*report.stages, *doubts)),
    )  # fmt: skip


def main() -> None:
    """Draw, vary, print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=60, help="sets a hull")
    parser.add_argument("--hulls", nargs="*", default=list(HULLS), choices=HULLS)
    parser.add_argument("--clashes", action="store_true", help="pairs that are one number")
    parser.add_argument("--planes", action="store_true", help="values exactly on planes")
    parser.add_argument("--reach", action="store_true", help="volume and LCB reached on top")
    given = parser.parse_args()
    if given.clashes:
        _print_clashes(given.hulls, given.count, given.seed)
        return
    drawn = {
        name: sets_on_planes(name) if given.planes else draw_sets(name, given.count, given.seed)
        for name in given.hulls
    }
    found = {name: list[tuple[int, Outcome]]() for name in given.hulls}
    # hull by hull in turn: whatever was printed by some time is of all of them
    for i, each_set in enumerate(zip_longest(*drawn.values())):
        for name, values in zip(drawn, each_set, strict=True):
            if values is None:
                continue
            hull = hull_of(name)
            each = outcome(hull, values, **_reach(hull, values) if given.reach else {})
            found[name].append((len(values), each))
            asked = ", ".join(f"{key}={value:.6g}" for key, value in values.items())
            verdict = "good" if each.good else "TAKEN BUT WRONG" if each.taken else "refused"
            print(f"{name} {i}: {verdict} {asked} | {each}", flush=True)
    for name, mine in found.items():
        _tell(name, mine)
    total = [each for mine in found.values() for each in mine]
    _tell("all", total)
    if any(each.taken and not each.good for _, each in total):
        sys.exit(1)


def _print_clashes(hulls: Sequence[str], count: int, seed: int) -> None:
    """Ask for pairs that are one number, and tell which are refused by both names."""
    asked, named = 0, 0
    for name in hulls:
        hull = hull_of(name)
        before = hull.fingerprint
        for values in draw_clashes(name, count, seed):
            found = outcome(hull, values)
            both = not found.taken and all(f"'{each}'" in found.words for each in values)
            both &= hull.fingerprint == before
            asked, named = asked + 1, named + both
            print(f"{name}: {'refused by both' if both else 'WRONG'} {values} | {found.words}")
    print(f"== {named} of {asked} refused by both names")
    if named < asked:
        sys.exit(1)


def _reach(hull: ah.Hull, values: Mapping[str, float]) -> dict[str, object]:
    """Ask for volume and LCB on top: 1 % more, .2 % of Lpp forward."""
    now, free = hull.hydrostatics(), ("breadth", "fore_shift", "aft_shift", "draught")
    return {
        "reach": {"volume": 1.01 * now.volume, "lcb": now.lcb + 2e-3 * hull.particulars.length},
        "free": [name for name in free if name not in values][:3],
    }


def _tell(name: str, found: list[tuple[int, Outcome]]) -> None:
    def share(some: list[Outcome]) -> str:
        good = sum(each.good for each in some)
        return f"{good} of {len(some)} ({100.0 * good / max(1, len(some)):.0f} %)"

    large = share([each for size, each in found if size >= 5])
    every = [each for _, each in found]
    spent = sum(each.seconds for each in every)
    combs = sum(each.comb > 10.0 for each in every)
    print(f"== {name}: {share(every)}; of five and more {large}; comb above 10 in {combs}; "
          f"{spent / max(1, len(every)):.1f} s each")  # fmt: skip


if __name__ == "__main__":
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    main()
