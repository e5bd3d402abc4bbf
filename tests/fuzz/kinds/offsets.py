"""Tables of offsets: separators, units, blocks of buttocks, columns of keel and deck."""

from __future__ import annotations

import zlib
from random import Random

from tests.fuzz.kind import TARGET, Kind
from tests.fuzz.text import change_text

__all__ = ["OFFSETS"]

PLAIN = """# station 0 = AP
station,wl_0,wl_1,wl_2,wl_3
0,0,0.1,0.8,1.4
2,0.5,3.0,3.6,3.9
5,1.8,4.0,4.0,4.0
8,0.6,2.6,3.1,3.5
10,0,0,0.2,0.5
"""
MILLIMETRES = """# half-breadths in mm; 0 = AP
station;wl_0;wl_1500;wl_3000
0;0;0;120
3;400;2100,5;2900
7;380;2050,5;2800
10;0;0;100
"""
NORMALISED = """# y/(B/2), z/T; station 0 = FP; L/B = 7.0; B/T = 2.5
x_m\twl_0\twl_0.5\twl_1.0\twl_1.5
0\t0\t0\t0\t0.1
20\t0.2\t0.6\t0.8\t0.9
40\t0.6\t1.0\t1.0\t1.0
60\t0\t0\t0.1\t0.3
"""
KEEL = """# station 0 = AP, metres; heights of keel and deck
station,keel,wl_1,wl_2,wl_3,deck_height,deck_half_breadth
0,1.5,,0,0.8,4,1.4
2,0.0,1.9,2.6,3.0,4,3.2
6,0.0,3.4,3.8,4.0,4,4.0
10,0.2,0,0,0.2,4.5,0.5

station,bt_1,bt_2
2,0.3,1.1
6,0.0,0.2
"""
BASES = (PLAIN, MILLIMETRES, NORMALISED, KEEL)
OPTIONS: tuple[list[str], ...] = (
    [],
    ["--length", "60"],
    ["--length", "60", "--breadth", "8", "--draught", "4", "--unit", "m"],
    ["--length", "60", "--station-zero", "ap"],
    ["--length", "60", "--report", "report.json"],
    ["--length", "60", "--draught", "3", "--unit", "normalised", "--json"],
    ["--length", "60", "--accept"],
    ["--length", "60", "--breadth", "8", "--draught", "3", "--accept"],
)


def make(rng: Random) -> bytes:
    """A changed table."""
    return change_text(rng, rng.choice(BASES))


def commands(data: bytes) -> list[list[str]]:
    """Import it; the options hang on the input, so that it alone tells what is run."""
    options = OPTIONS[zlib.crc32(data) % len(OPTIONS)]
    return [["import", "table.csv", "-o", TARGET, *options]]


OFFSETS = Kind("offsets", "table.csv", make, commands, extra=("report.json",), weight=40)
