"""Fair pulls and re-shapes beside plain ones: which gain a new sign change of curvature.

``python -m benchmarks.fair_edits [--ship carrier|series60|dtc] [--count 24]`` draws points that a
field may move, by a seed, and pulls each by 20 and 50 mm in turns, inwards or outwards; and leads
one of its waterlines or buttocks through the place: the plain field over a span between Lpp / 60
and Lpp / 10, the fair answer over Lpp / 4. New sign changes are counted over all lines of the hull,
at lobes of .2 and of 1 degree. After fair pulls and windows that are faired at such points, the
lines are counted that `hull.fairness` calls unfair.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator, Sequence
from time import process_time

import attrs
import numpy as np

import assoc_hull as ah
from assoc_hull.analysis.fairness.batten_problem import BattenProblem
from assoc_hull.edit.checks.update_findings import plane_normals
from assoc_hull.edit.net_battens import net_battens
from assoc_hull.edit.session import Edit
from assoc_hull.errors import AssocHullError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.fairness.inflections import inflections
from assoc_hull.model.address import address as address_of
from assoc_hull.model.kinds import Sort
from assoc_hull.model.tables import HullState
from benchmarks.clock import Figure
from benchmarks.ships import duisburg_test_case

__all__ = ["Tally", "called", "figures", "main", "measure", "sign_changes"]

SHIPS: dict[str, Callable[[], ah.Hull | None]] = {
    "carrier": ah.examples.bulk_carrier_207k,
    "series60": lambda: ah.examples.series60(cb=0.7),
    "dtc": duisburg_test_case,
}
GOALS = {"carrier": (3, 0), "series60": (14, 2), "dtc": (15, 8)}
"""Of 48 edits, and of the 24 by 20 mm: how many may gain a sign change."""

_AMOUNTS = (0.02, 0.05)
_WINDOW, _WINDOW_NOISE = (20.0, 6.0), 1.6e-3
"""m."""

_FREE = 0.3
"""|U^T n|, and more, of the points that are drawn."""


@attrs.define
class Tally:
    """What edits of one kind did.

    `gained` and `count` are by lobe; `small` counts the edits by 20 mm that gained at .2 degree.
    """

    edits: int = 0
    refused: int = 0
    gained: list[int] = attrs.field(factory=lambda: [0, 0])
    count: list[int] = attrs.field(factory=lambda: [0, 0])
    small: int = 0
    milliseconds: list[float] = attrs.field(factory=list)

    def __str__(self) -> str:
        median = float(np.median(self.milliseconds)) if self.milliseconds else 0.0
        return (
            f"{self.edits} edits, {self.refused} refused; at .2 degree {self.gained[0]} gained "
            f"{self.count[0]} sign changes, at 1 degree {self.gained[1]} gained {self.count[1]}; "
            f"by 20 mm {self.small}; median {median:.0f} ms"
        )


def sign_changes(state: HullState) -> dict[str, tuple[int, int]]:
    """Count those of all curves, at lobes of .2 and 1 degree, by key."""
    curves = state.live("curves")
    batch = SplineBatch.join([state.spline(curve) for curve in curves.tolist()])
    normals = plane_normals(state, curves)
    small, large = (inflections(batch, normals, lobe)[0].tolist() for lobe in (0.2, 1.0))
    keys = [state.curves.key[curve] for curve in curves.tolist()]
    return dict(zip(keys, zip(small, large, strict=True), strict=True))


def _drawn_from(problem: BattenProblem, state: HullState) -> IntArray:
    """Give the points that edits are drawn from."""
    crossing = state.rows.sort[problem.rows] == Sort.CROSSING
    found: IntArray = np.sort(problem.rows[crossing & (problem.freedom > _FREE)])
    return found


def called(hull: ah.Hull, count: int, seed: int = 3) -> dict[str, tuple[int, int]]:
    """Count the lines called unfair, of all, over edits, each done on the hull as it was."""
    state, rng = hull.document.state, np.random.default_rng(seed)
    chosen = _drawn_from(net_battens(state), state)
    found = {"as she is": _unfair(hull), "fair pulls": (0, 0), "faired windows": (0, 0)}
    for turn in range(count):
        address = address_of(state, int(chosen[rng.integers(len(chosen))]))
        amount = _AMOUNTS[turn % 2] * float(rng.choice([-1.0, 1.0]))
        window = hull.fair_window(at=address, radius=_WINDOW)
        window.to(noise=_WINDOW_NOISE)
        window.commit()
        found["faired windows"] = _sum(found["faired windows"], _unfair(hull))
        hull.undo()
        try:
            with hull.edit("a drawn one") as edit:
                edit.pull(address, amount, fair=True)
        except AssocHullError:
            continue
        found["fair pulls"] = _sum(found["fair pulls"], _unfair(hull))
        hull.undo()
    return found


def _unfair(hull: ah.Hull) -> tuple[int, int]:
    table = hull.fairness()
    return len({place.line for place in table.unfair}), len(set(table.lines))


def _sum(first: tuple[int, int], second: tuple[int, int]) -> tuple[int, int]:
    return first[0] + second[0], first[1] + second[1]


def measure(hull: ah.Hull, count: int, seed: int = 3) -> dict[str, Tally]:
    """Carry out the edits, each on the hull as it was."""
    state, rng = hull.document.state, np.random.default_rng(seed)
    before, print_before = sign_changes(state), hull.fingerprint
    problem = net_battens(state)
    chosen = _drawn_from(problem, state)
    moves = dict(zip(problem.rows.tolist(), problem.moves, strict=True))
    names = [f"{kind}, {way}" for kind in ("pull", "re-shape") for way in ("plain", "fair")]
    found = {name: Tally() for name in names}
    length = hull.particulars.length
    for turn in range(count):
        row = int(chosen[rng.integers(len(chosen))])
        amount = _AMOUNTS[turn % 2] * float(rng.choice([-1.0, 1.0]))
        span = float(rng.uniform(length / 60.0, length / 10.0))
        place = state.rows.xyz[row].copy()
        jobs = list(_pulls(state, row, amount))
        jobs += list(_shapes(state, row, place, amount * moves[row], (span, length / 4.0)))
        for name, job in jobs:
            _tally(hull, job, found[name], before, small=not turn % 2)
            assert hull.fingerprint == print_before, "it was undone to the bit"
    return found


Job = tuple[str, Callable[[Edit], None]]


def _pulls(state: HullState, row: int, amount: float) -> Iterator[Job]:
    address = address_of(state, row)
    yield "pull, plain", lambda edit: edit.pull(address, amount)
    yield "pull, fair", lambda edit: edit.pull(address, amount, fair=True)


def _shapes(
    state: HullState, row: int, place: FloatArray, step: FloatArray, spans: tuple[float, float]
) -> Iterator[Job]:
    curves = [
        curve for curve in state.rows.curve[row].tolist()
        if curve >= 0 and state.family(state.line_of(curve)).name in ("waterlines", "buttocks")
    ]  # fmt: skip
    if not curves:
        return
    key, to = state.curves.key[curves[0]], (place + step)[None]
    plain, fair = ((place[0] - 0.5 * span, place[0] + 0.5 * span) for span in spans)
    yield "re-shape, plain", lambda edit: _ignore(edit.reshape(key, to, span=plain))
    yield "re-shape, fair", lambda edit: _ignore(edit.reshape(key, to, span=fair, fair=True))


def _ignore(_: object) -> None:
    pass


def _tally(
    hull: ah.Hull, job: Callable[[Edit], None], tally: Tally,
    before: dict[str, tuple[int, int]], *, small: bool,
) -> None:  # fmt: skip
    tally.edits += 1
    begin = process_time()
    try:
        with hull.edit("a drawn one") as edit:
            job(edit)
    except AssocHullError:
        tally.refused += 1
        return
    tally.milliseconds.append(1e3 * (process_time() - begin))
    now = sign_changes(hull.document.state)
    for lobe in range(2):
        more = sum(max(now[key][lobe] - was[lobe], 0) for key, was in before.items() if key in now)
        tally.count[lobe] += more
        tally.gained[lobe] += more > 0
        tally.small += lobe == 0 and small and more > 0
    hull.undo()


def figures(quick: bool = False) -> list[Figure]:
    """Give how many fair edits gain a sign change, and how many sign changes beside the plain."""
    found: list[Figure] = []
    for name, make in SHIPS.items():
        hull = make()
        if hull is None:
            continue
        told = measure(hull, 6 if quick else 24)
        fair = [told["pull, fair"], told["re-shape, fair"]]
        plain = [told["pull, plain"], told["re-shape, plain"]]
        most, small = GOALS[name]
        gained, by_20 = sum(each.gained[0] for each in fair), sum(each.small for each in fair)
        share = sum(e.count[0] for e in fair) / max(sum(e.count[0] for e in plain), 1)
        time = np.median(fair[0].milliseconds) / np.median(plain[0].milliseconds)
        found += [
            Figure(f"{name}: fair edits that gain a sign change", gained, "", most, "most"),
            Figure(f"{name}: of those by 20 mm", by_20, "", small, "most"),
            Figure(f"{name}: new sign changes, fair over plain", share),
            Figure(f"{name}: a fair pull over a plain one, time", float(time)),
        ]
    return [*found, *_verdicts(6 if quick else 24)]


def _verdicts(count: int) -> Iterator[Figure]:
    """Tell the part of lines that is called unfair, as hulls are and after fair edits."""
    ships = {"wigley": ah.examples.wigley, **SHIPS}
    for name in ("wigley", "carrier", "series60"):
        hull = ships[name]()
        assert hull is not None, "it comes with the package"
        for how, (lines, of) in called(hull, count).items():
            title = f"{name}, {how}: lines called unfair, {lines} of {of}"
            yield Figure(title, 100.0 * lines / of, "%", 5, "most")


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the tallies."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.fair_edits")
    parser.add_argument("--ship", choices=tuple(SHIPS), action="append")
    parser.add_argument("--count", type=int, default=24)
    chosen = parser.parse_args(arguments)
    for name in chosen.ship or SHIPS:
        hull = SHIPS[name]()
        if hull is None:
            print(f"{name}: the data folder is not there")
            continue
        for kind, tally in measure(hull, chosen.count).items():
            print(f"{name}, {kind}: {tally}", flush=True)
        for how, (lines, of) in called(hull, chosen.count).items():
            print(f"{name}, {how}: {lines} of {of} lines called unfair", flush=True)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
