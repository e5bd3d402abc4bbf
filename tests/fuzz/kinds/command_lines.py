"""Command lines: good files, and options that are odd, doubled, lacking or of another command."""

from __future__ import annotations

import functools
import json
from random import Random
from typing import Any

from tests.fuzz.kind import TARGET, Kind
from tests.fuzz.kinds.hulls import edited_text
from tests.fuzz.kinds.lines import LISTS
from tests.fuzz.kinds.meshes import unchanged_stl
from tests.fuzz.odd import odd_word

__all__ = ["COMMAND_LINES"]

TABLE = b"""# station 0 = AP, metres; heights of keel and deck
station,keel,wl_1,wl_2,wl_3,deck_height,deck_half_breadth
0,1.5,,0,0.8,4,1.4
2,0.0,1.9,2.6,3.0,4,3.2
6,0.0,3.4,3.8,4.0,4,4.0
10,0.2,0,0,0.2,4.5,0.5
"""
FILES = ("table.csv", "lines.csv", "hull.stl", "ship.hull.json", "edits.json", "none.csv", ".")
GOOD: tuple[list[str], ...] = (
    ["import", "table.csv", "-o", TARGET, "--length", "60", "--draught", "3"],
    ["import", "lines.csv", "-o", TARGET, "--tolerance", "0.05"],
    ["import", "hull.stl", "-o", TARGET, "--stations", "3", "--waterlines", "2", "--buttocks", "1"],
    ["info", "ship.hull.json"],
    ["check", "ship.hull.json", "--json"],
    ["graph", "ship.hull.json", "--format", "json"],
    ["edit", "ship.hull.json", "edits.json", "-o", TARGET],
    ["hydrostatics", "ship.hull.json", "--draught", "4"],
)
OPTIONS = (
    "--length", "--breadth", "--draught", "--depth", "--draught-aft", "--draught-fwd", "--ap",
    "--fp", "--base", "--waterline", "--centre", "--origin", "--deck", "--unit", "--scale",
    "--axes", "--tolerance", "--join", "--station-zero", "--station-spacings", "--deck-edge",
    "--frame-spacing", "--stations", "--waterlines", "--buttocks", "--accept", "--strict",
    "--json", "--heel", "--trim", "--kg", "--format", "--nothing",
)  # fmt: skip
VALUES = (
    "0", "-1", "1e300", "1e-300", "nan", "inf", "60", "3", "3 m", "3000 mm", "12-6-3+", "m", "mm",
    "ft", "normalised", "ap", "fp", "midship", "open", "closed", "+x+y+z", "+x+x+z", "-y+z+x",
    "auto", "deck edge", "WL 1", "1,2,3", "1,,2", "100000000", "99999999999999999999", "",
)  # fmt: skip


def make(rng: Random) -> bytes:
    """A command with some of its words changed, as JSON; the file to write stays."""
    words = list(rng.choice(GOOD))
    for _ in range(rng.choice((1, 1, 2, 3))):
        _change(rng, words)
    return json.dumps(words).encode()


def _change(rng: Random, words: list[str]) -> None:
    """One change; `TARGET` alone may be written, so its place and option are left."""
    free = [k for k in range(1, len(words)) if words[k] not in ("-o", TARGET)]
    match rng.randrange(6):
        case 0 if free:
            del words[rng.choice(free)]
        case 1 if free:
            words[rng.choice(free)] = _value(rng)
        case 2 if free:
            words[rng.choice(free)] = rng.choice(FILES)
        case 3:
            words.append(rng.choice(OPTIONS))
        case _:
            words += [rng.choice(OPTIONS), _value(rng)]


def _value(rng: Random) -> str:
    """A word that a shell can hand over; none that names a file to write."""
    word = rng.choice(VALUES) if rng.random() < 0.7 else odd_word(rng)
    return "x" if "\0" in word or "\ud800" in word else word


def commands(data: bytes) -> list[list[str]]:
    """The command itself."""
    found: Any = json.loads(data)
    return [[str(each) for each in found]]


@functools.cache
def beside() -> dict[str, bytes]:
    """The files that are named."""
    edits = b'[{"op": "move", "point": "WL 4.167 x ST 1", "y": 3.97}]'
    return {
        "table.csv": TABLE, "lines.csv": LISTS[0].encode(), "hull.stl": unchanged_stl(),
        "ship.hull.json": edited_text().encode(), "edits.json": edits,
    }  # fmt: skip


COMMAND_LINES = Kind("command_line", "arguments.json", make, commands, beside, weight=4)
