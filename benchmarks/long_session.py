"""Five thousand edits of one hull in memory: what the last cost beside those of a fresh hull.

``python -m benchmarks.long_session [--edits 5000]`` edits Series 60 CB .70 at random: points are
moved and pulled by millimetres, lines cut and removed. Now and then the hull is copied without its
history, and both are edited alike in turns: the ratio of their processor times does not grow where
the past costs nothing. At the end `verify` looks at all, and all is undone and redone.
"""

from __future__ import annotations

import argparse
import itertools
import random
import resource
from collections.abc import Callable, Sequence
from time import process_time

import assoc_hull as ah
from assoc_hull.errors import AssocHullError
from benchmarks.clock import Figure, side_by_side

__all__ = ["figures", "main"]

_LOOKS = 10
"""So often is an edit timed on the way."""


def figures(quick: bool = False) -> list[Figure]:
    """Measure."""
    return measure(500 if quick else 5000, lambda _: None)


def measure(count: int, tell: Callable[[str], None]) -> list[Figure]:
    """Edit, and time the same edit before and after; `tell` hears of each look on the way."""
    hull, rng = ah.examples.series60(cb=0.70), random.Random(28)
    first, names = hull.fingerprint, _points(hull)
    ratios: list[float] = []
    begin, least, most = process_time(), len(hull.history), _resident()
    for number in range(count):
        while not _edit(hull, names, rng):
            pass
        if (number + 1) % max(count // _LOOKS, 1) == 0:
            took = process_time() - begin
            ratios.append(_ratio(hull, names))
            tell(f"{number + 1} edits: {ratios[-1]:.3f} x a fresh hull, {took:.1f} s, "
                 f"{_resident():.0f} MB")  # fmt: skip
            begin = process_time()
    grown = _resident() - most
    last, undone = hull.fingerprint, len(hull.history) - least
    found = hull.verify()
    times = []
    for act, goal in ((hull.undo, first), (hull.redo, last)):
        begin = process_time()
        act(undone)
        times.append(process_time() - begin)
        assert hull.fingerprint == goal, "all is undone and redone to the bit"
    title = f"{count} edits: "
    return [
        Figure(f"{title}an edit at the end / on a fresh hull", ratios[-1]),
        Figure(
            f"{title}that, the last three looks / the first three",
            sum(ratios[-3:]) / sum(ratios[:3]),
            "x",
            1.1,
            "most",
        ),
        Figure(f"{title}grown by, per edit", 1024.0 * grown / count, "kB"),
        Figure(f"{title}findings of verify", len(found), "", 0, "equal"),
        Figure(f"{title}undo of all", times[0], "s"),
        Figure(f"{title}redo of all", times[1], "s"),
    ]


def _points(hull: ah.Hull) -> list[str]:
    return [
        name for name, point in hull.points.items()
        if point.free == ("y",) and point.driver is None and point.role == "defining"
    ]  # fmt: skip


def _edit(hull: ah.Hull, names: list[str], rng: random.Random) -> bool:
    """Edit at random; tell whether it was taken."""
    name, part, by = rng.choice(names), rng.random(), rng.uniform(-0.002, 0.002)
    extra = [line for line in hull.lines if line.startswith("extra")] if part > 0.97 else []
    try:
        with hull.edit("at random") as edit:
            if part < 0.75:
                edit.move(name, y=hull.points[name].y + by)
            elif part <= 0.97:
                edit.pull(name, d=by, radius=(12.0, 5.0))
            elif extra:
                edit.remove_line(extra[0])
            else:
                place = rng.uniform(1.0, 6.0)
                edit.add_line("waterlines", place, f"extra {place:.4f}")
    except AssocHullError:
        return False
    return True


def _ratio(hull: ah.Hull, names: list[str]) -> float:
    """Give what a move costs here over what it costs on a hull without a past."""
    name, fresh = names[len(names) // 2], ah.Hull(hull.snapshot().state)

    def job(of: ah.Hull) -> Callable[[], None]:
        places = itertools.cycle(of.points[name].y + by for by in (1e-3, 0.0))

        def act() -> None:
            with of.edit("the same") as edit:
                edit.move(name, y=next(places))

        return act

    times = side_by_side({"here": job(hull), "fresh": job(fresh)}, 59)
    return times["here"] / times["fresh"]


def _resident() -> float:
    """Give the most memory that this process has had, MB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.long_session")
    parser.add_argument("--edits", type=int, default=5000)
    for each in measure(parser.parse_args(arguments).edits, lambda told: print(told, flush=True)):
        print("  ".join(each.cells()))
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
