"""Damaged tables through the public door: `python -m tests.damaged_imports --help`.

Each of the sound tables is spoilt by chance, written to a file, and read by `assoc_hull.read` as a
user would; what is taken is compared by the volume of its hydrostatics with the undamaged table,
read in the same way. Nothing may be taken with a volume off by more than .5 % unless a suspicion
names the place of the damage, and what is sound or changed without harm may raise no suspicion.
"""

from __future__ import annotations

import argparse
import os
import re
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from importlib.resources import files
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import attrs
import numpy as np

import assoc_hull as ah
from assoc_hull.errors import AssocHullError
from tests.damaged_tables import (
    DAMAGES,
    PlainTable,
    exported_table,
    harmless,
    plain_table,
    series60_table,
    sysser_table,
    wigley_table,
)

MOST_OFF = 0.005
SEED = 1962
_FOUND = re.compile(r"^(suspicion|fault): ")


@attrs.frozen
class Taken:
    """A hull that the door let in: its volume, and what was said against it."""

    volume: float
    doubts: tuple[str, ...]


def taken(text: str, folder: Path, options: dict[str, Any]) -> Taken:
    """Read a table as a user does, and measure the hull at its draught."""
    path = folder / "table.csv"
    path.write_text(text, encoding="utf-8")
    hull = ah.read(path, **options)
    assert hull.adoption is not None
    doubts = tuple(_FOUND.sub("", note) for note in hull.adoption.notes if _FOUND.match(note))
    return Taken(hull.hydrostatics(on_error="report").volume, doubts)


@attrs.define
class Rates:
    """What became of all; `wrong` and `needless` tell each case that must not be."""

    damaged: Counter[str] = attrs.field(factory=Counter)
    by_kind: dict[str, Counter[str]] = attrs.field(factory=dict)
    unharmed: Counter[str] = attrs.field(factory=Counter)
    wrong: list[str] = attrs.field(factory=list)
    needless: list[str] = attrs.field(factory=list)

    def lines(self) -> Iterator[str]:
        """Print-ready rates."""
        count = self.damaged.total()
        for word, many in sorted(self.damaged.items()):
            yield f"  {word:28s} {many:4d}  {100.0 * many / count:5.1f} %"
        for kind, words in sorted(self.by_kind.items()):
            yield f"    {kind:24s} " + ", ".join(f"{n} {w}" for w, n in sorted(words.items()))
        yield f"undamaged and harmless: {dict(sorted(self.unharmed.items()))}"
        yield from (f"WRONG {each}" for each in self.wrong)
        yield from (f"NEEDLESS {each}" for each in self.needless)


def judged(found: Taken, truth: float, places: Sequence[str]) -> str:
    """Say whether a volume is right, and whether a doubt names one of the places."""
    right = abs(found.volume / truth - 1.0) <= MOST_OFF
    named = any(re.search(place, doubt) for place in places for doubt in found.doubts)
    told = "place named" if named else "told" if found.doubts else "quiet"
    return f"{'right' if right else 'WRONG'}, {told}"


def run(
    tables: Sequence[PlainTable], damages: int, changes: int, seed: int, *, show: bool = False
) -> Rates:
    """Try the tables as they are, spoilt, and changed without harm."""
    random = np.random.default_rng(seed)
    rates = Rates()
    with TemporaryDirectory() as name:
        folder = Path(name)
        truth = []
        for table in tables:
            found = taken(table.text(), folder, table.options)
            truth.append(found.volume)
            _unharmed(rates, f"{table.name}, undamaged", found, found.volume)
        for n in range(damages):
            k, damage = int(random.integers(len(tables))), DAMAGES[n % len(DAMAGES)]
            text, options, places = damage(tables[k], random)
            case = f"{n}: {damage.__name__} of {tables[k].name}"
            try:
                found = taken(text, folder, tables[k].options | options)
            except AssocHullError as error:
                word, doubts, off = "refused", str(error).splitlines()[:2], float("nan")
            else:
                word, doubts = judged(found, truth[k], places), list(found.doubts)
                off = 100.0 * (found.volume / truth[k] - 1.0)
            rates.damaged[word] += 1
            rates.by_kind.setdefault(damage.__name__, Counter())[word] += 1
            if word.startswith("WRONG") and not word.endswith("named"):
                rates.wrong.append(f"{case}: V {off:+.2f} %; {doubts}")
            if show:
                print(f"{case}: {word}, V {off:+.2f} %; {doubts[:2]}", flush=True)
        for n in range(changes):
            k = n % len(tables)
            found = taken(harmless(tables[k], random), folder, tables[k].options)
            _unharmed(rates, f"{tables[k].name}, harmless change {n}", found, truth[k])
    return rates


def _unharmed(rates: Rates, case: str, found: Taken, truth: float) -> None:
    off = abs(found.volume / truth - 1.0)
    word = "suspected" if found.doubts else "other volume" if off > 1e-9 else "clean"
    rates.unharmed[word] += 1
    if word != "clean":
        rates.needless.append(f"{case}: V off by {off:.1e}; {list(found.doubts)}")


def shipped_tables() -> list[PlainTable]:
    """The tables that need no data besides the package."""
    template = files("assoc_hull.shipped") / "data" / "offset_template.csv"
    return [
        wigley_table(), series60_table("060"), series60_table("070"),
        plain_table("the template", template.read_text("utf-8")),
    ]  # fmt: skip


def all_tables(data: Path, folder: Path) -> list[PlainTable]:
    """Those shipped, a yacht, and ships as they are exported."""
    yacht = attrs.evolve(sysser_table(data), options={"length": 10.0474})
    tables = [*shipped_tables(), yacht]
    for ship in ("container_ship_225m", "wigley"):
        (folder / ship).mkdir()
        tables.append(exported_table(getattr(ah.examples, ship)(), folder / ship))
    return tables


def main(arguments: Sequence[str] | None = None) -> int:
    """Run from the command line; 1 if anything is as it must not be."""
    parser = argparse.ArgumentParser(prog="python -m tests.damaged_imports", description=__doc__)
    parser.add_argument("--damages", type=int, default=200)
    parser.add_argument("--changes", type=int, default=100)
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--shipped", action="store_true", help="tables of the package alone")
    parser.add_argument("--details", action="store_true", help="a line for each damage")
    given = parser.parse_args(arguments)
    data = Path(os.environ.get("ASSOC_HULL_DATA", Path(__file__).parents[2] / "shared" / "data"))
    with TemporaryDirectory() as folder:
        tables = shipped_tables() if given.shipped else all_tables(data, Path(folder))
        rates = run(tables, given.damages, given.changes, given.seed, show=given.details)
    print(f"{given.damages} damages of {len(tables)} tables, seed {given.seed}:")
    print("\n".join(rates.lines()))
    return 1 if rates.wrong or rates.needless else 0


if __name__ == "__main__":
    sys.exit(main())
