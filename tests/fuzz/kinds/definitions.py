"""Texts of classical definitions: a small body is made a net, the ships that ship are told."""

from __future__ import annotations

from random import Random

from assoc_hull.shipped.classical_ships import SHIPS, classical_text
from tests.fuzz.kind import TARGET, Kind
from tests.fuzz.text import change_text

__all__ = ["DEFINITIONS"]

BODY = """SFOLDS "Middle body"
length 32
breadth 30.4
depth 12.4
draught 9
deck closed
origin midship
corner 5
waterlines 3 6
section m hb=0.9 sb=3 sw=2 hd=12.4 bd=15.2 cam=0.4 nb=4 nw=7
  0 0.02 0.10 0.31 0.80
  12.3 14.2 14.8 15 15.1 15.2 15.2
section e hb=0 sb=1 sw=5 hd=12.4 bd=0 cam=0 nb=0 nw=4
  0
  0 0 0 0
portion 3
  -16 m
  -8 m
  0 m
portion 6  # it ends on a stem
  0 m
  8 m
  16 e
portion 12
  0 m
  4 m
  8 m
"""


def make(rng: Random) -> bytes:
    """A changed text."""
    return change_text(rng, BODY if rng.random() < 0.6 else classical_text(rng.choice(SHIPS)))


def of_definition(data: bytes) -> list[list[str]]:
    """Tell it; make a net of it where it is small."""
    told = ["classical", "definition.txt", "--json"]
    if len(data) > 2 * len(BODY):
        return [told]
    return [told, ["import", "definition.txt", "-o", TARGET]]


DEFINITIONS = Kind("definition", "definition.txt", make, of_definition, weight=2)
