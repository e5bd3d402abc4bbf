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
LENGTHS = (
    "--length", "--breadth", "--draught", "--depth", "--draught-aft", "--draught-fwd", "--ap",
    "--fp", "--base", "--waterline", "--centre", "--scale", "--tolerance", "--join",
    "--station-spacings", "--frame-spacing", "--stations", "--waterlines", "--buttocks",
)  # fmt: skip
NUMBERS = (
    "0", "-1", "1e300", "1e-300", "nan", "inf", "60", "3", "12.5m", "300mm", "1", "0.5", "4", "10",
    "100000000", "99999999999999999999", "1,2,3", "1,,2", "20,30,50", "8", "2", "5", "0.01", "6",
)  # fmt: skip
CHOICES = {
    "--origin": ("ap", "fp", "midship"), "--deck": ("open", "closed"),
    "--unit": ("auto", "m", "mm", "cm", "ft", "in", "normalised", "mm,m"),
    "--axes": ("+x+y+z", "+x+x+z", "-y+z+x", "auto", "-x-y+z"),
    "--station-zero": ("auto", "ap", "fp"), "--deck-edge": ("deck edge", "WL 1", ""),
}  # fmt: skip
FLAGS = ("--accept", "--accept", "--strict", "--json", "--nothing")


def make(rng: Random) -> bytes:
    """A command with some of its words changed, as JSON; the file to write stays."""
    words = list(rng.choice(GOOD[:3] if rng.random() < 0.8 else GOOD))
    for _ in range(rng.choice((1, 1, 2, 3))):
        _change(rng, words)
    return json.dumps(words).encode()


def _change(rng: Random, words: list[str]) -> None:
    """One change; `TARGET` alone may be written, so its place and option are left."""
    free = [k for k in range(1, len(words)) if words[k] not in ("-o", TARGET)]
    match rng.randrange(12):
        case 0 if free:
            del words[rng.choice(free)]
        case 1 if free:
            words[rng.choice(free)] = _harmless(odd_word(rng))
        case 2 if free:
            words[rng.choice(free)] = rng.choice(FILES)
        case 3:
            words += [rng.choice(LENGTHS), _harmless(odd_word(rng))]
        case 4 | 5:
            words.append(rng.choice(FLAGS))
        case 6 | 7:
            option = rng.choice(list(CHOICES))
            words += [option, rng.choice(CHOICES[option])]
        case _:
            words += [rng.choice(LENGTHS), rng.choice(NUMBERS)]


def _harmless(word: str) -> str:
    """A word that a shell can hand over."""
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
