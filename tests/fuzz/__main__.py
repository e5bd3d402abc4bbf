"""Fuzz: ``python -m tests.fuzz --count 100000 --kind all --seed 1``.

Exit code 1 if an input was found that the program does not stand; each such fault leaves one
small input in the corpus, which the tests replay.
"""

from __future__ import annotations

import argparse
import contextlib
import itertools
import os
import sys
import time
from collections.abc import Iterator, Sequence

from tests.fuzz.all_kinds import KINDS
from tests.fuzz.harvest import Tally, keep
from tests.fuzz.pool import LIMIT, Item, run_all
from tests.fuzz.trial import Outcome

COLUMNS = ("inputs", "refused", "unsound", "findings", "accepted", "sound", "suspect", "unsound!")
HEAD = (
    f"{'kind':13}{''.join(f'{each:>9}' for each in COLUMNS)}{'failures':>9}{'faults':>8}"
    f"{'slowest':>9}{'cpu s':>8}{'MB':>8}"
)
"""Refused by exit code 2 or 3, findings (1), accepted (0); of imports accepted the verdicts; the
slowest by the clock and by the processor, s; the most memory."""


def main(argv: Sequence[str] | None = None) -> int:
    """Run, print a table, and keep what was found."""
    arguments = _arguments(argv)
    names = list(KINDS) if arguments.kind == "all" else arguments.kind.split(",")
    tallies = {name: Tally() for name in names}
    start = time.perf_counter()
    items = _items(names, arguments.seed, arguments.first, arguments.count, even=arguments.even)
    with contextlib.suppress(KeyboardInterrupt):  # what was tried until then is told
        for done, found in enumerate(run_all(items, arguments.jobs, arguments.limit), 1):
            _count(tallies, *found)
            if done % 1000 == 0:
                rate = done / (time.perf_counter() - start)
                _say(f"{done} of {arguments.count}, {rate:.0f} per second")
    print(HEAD, *(tally.line(name) for name, tally in tallies.items()), sep="\n")
    print(f"{time.perf_counter() - start:.0f} s, {arguments.jobs} processes, seed {arguments.seed}")
    return _tell(tallies, kept=arguments.keep)


def _count(tallies: dict[str, Tally], item: Item, outcome: Outcome) -> None:
    """Count an outcome, and tell at once of a fault that is new."""
    tally = tallies[item.kind.name]
    known = len(tally.faults)
    tally.add(item, outcome)
    if len(tally.faults) > known:
        _say(f"{item.kind.name} {item.number}: {outcome.fault[:300]}")


def _say(text: str) -> None:
    print(text, file=sys.stderr, flush=True)


def _arguments(argv: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz", description=__doc__)
    parser.add_argument("--count", type=int, default=1000, help="how many inputs (1000)")
    parser.add_argument("--kind", default="all", help=f"all, or some of: {', '.join(KINDS)}")
    parser.add_argument("--seed", type=int, default=1, help="another seed, other inputs (1)")
    parser.add_argument("--first", type=int, default=0, help="number of the first input (0)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="processes")
    parser.add_argument("--limit", type=float, default=LIMIT, help="seconds per input (5)")
    parser.add_argument("--even", action="store_true", help="as many of each kind")
    parser.add_argument("--keep", action="store_true", help="keep an input per fault in the corpus")
    return parser.parse_args(argv)


def _items(
    names: Sequence[str], seed: int, first: int, count: int, *, even: bool
) -> Iterator[Item]:
    """Inputs of all kinds in turn, each as often as its weight says, or all as often."""
    kinds = [KINDS[name] for name in names]
    order = [
        kind
        for turn in range(1 if even else max(kind.weight for kind in kinds))
        for kind in kinds
        if turn < kind.weight
    ]
    numbers = {kind.name: itertools.count(first) for kind in kinds}
    for kind in itertools.islice(itertools.cycle(order), count):
        yield Item(kind, seed, next(numbers[kind.name]))


def _tell(tallies: dict[str, Tally], *, kept: bool) -> int:
    """Name every fault once, with the number of an input that shows it."""
    found = 0
    for name, tally in tallies.items():
        for examples in tally.faults.values():
            item, outcome = min(examples, key=lambda each: len(each[0].data))
            place = f", kept as {keep(item, outcome.fault)}" if kept else ""
            print(f"\n{name} {item.number} ({len(examples)} times{place}):\n  {outcome.fault}")
            found += 1
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
