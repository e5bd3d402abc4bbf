"""Lists of edits: every operation, with arguments that fit and such that do not."""

from __future__ import annotations

import json
from random import Random

from tests.fuzz.kind import TARGET, Kind
from tests.fuzz.kinds.hulls import edited_text
from tests.fuzz.odd import odd_text, odd_value
from tests.fuzz.text import change_text
from tests.fuzz.values import change_value

__all__ = ["EDITS"]

GOOD = (
    {"op": "move", "point": "WL 4.167 x ST 1", "y": 3.97},
    {"op": "insert", "curve": "ST 2", "place": [200 / 3, 1.0, 0.7]},
    {"op": "delete", "point": "ST 1 @ placed 1"},
    {"op": "set_kind", "point": "ST 1 @ placed 1", "kind": "smooth", "direction": [0, 1, 0.5]},
    {"op": "pin", "point": "profile @ adopted 1"},
    {"op": "unpin", "point": "ST 1 @ placed 1"},
    {"op": "pull", "point": "WL 4.167 x ST 1", "d": 0.02, "radius": [20, 3]},
    {"op": "reshape", "curve": "WL 4.167", "points": [[40, 3.9, 4.2], [60, 3.9, 4.2]],
     "span": [35, 65], "fade": [10, 2]},
    {"op": "set_end", "curve": "ST 1", "end": "finish", "curvature": [0, 0.01, 0]},
    {"op": "set_role", "crossing": "WL 4.167 x ST 2", "role": "drives b"},
    {"op": "renew_roles", "lines": ["ST 1", "WL 4.167"]},
    {"op": "associate", "a": "waterlines", "b": "buttocks", "two_way": False},
    {"op": "dissociate", "a": "sections", "b": "buttocks"},
    {"op": "rename", "obj": "ST 1", "name": "frame 33"},
    {"op": "add_line", "group": "sections", "position": 50.0, "name": "ST 1.5"},
    {"op": "add_line", "group": "diagonals", "position": [5.0, 40.0]},
    {"op": "shift_line", "line": "ST 1", "position": 34.0},
    {"op": "remove_line", "line": "BTK 2.500"},
    {"op": "transform", "scale": [1, 1.05, 1], "shift": [0, 0, 0], "drivers": ["sections"],
     "planes": "stay", "tolerance": 0.01},
)  # fmt: skip
NAMES = (
    "ST 1", "ST 2", "WL 2.083", "WL 4.167", "BTK 2.500", "profile", "deck edge", "sections",
    "waterlines", "buttocks", "boundary", "bilge", "WL 4.167 x ST 1", "WL 2.083 x profile #2",
    "profile @ adopted 2", "ST 1 @ placed 1", "ST 1 @ placed 0", "ST 1 x", "x", "@", "#",
    "WL 4.167 x profile #1", "WL 4.167 x profile #99999999999999999999", "ST 1 x WL 4.167", "Net",
)  # fmt: skip


def make(rng: Random) -> bytes:
    """One to three operations, changed; seldom the text itself."""
    edits = [json.loads(json.dumps(rng.choice(GOOD))) for _ in range(rng.choice((1, 1, 1, 2, 3)))]
    for _ in range(rng.choice((0, 1, 1, 2))):
        _rename(rng, rng.choice(edits))
    if rng.random() < 0.85:
        edits = change_value(rng, edits, rng.choice((1, 1, 2, 3)))
    try:
        text = json.dumps(edits)
    except RecursionError:
        text = "[" * 3000 + "]" * 3000
    return change_text(rng, text) if rng.random() < 0.1 else text.encode("utf-8", "surrogatepass")


def _rename(rng: Random, edit: dict[str, object]) -> None:
    """An argument becomes the name of something else, or anything."""
    key = rng.choice([key for key in edit if key != "op"])
    odd = rng.random()
    edit[key] = rng.choice(NAMES) if odd < 0.6 else odd_text(rng) if odd < 0.7 else odd_value(rng)


def commands(_: bytes) -> list[list[str]]:
    """Carry them out."""
    return [["edit", "ship.hull.json", "edits.json", "-o", TARGET]]


def beside() -> dict[str, bytes]:
    """The hull they are meant for."""
    return {"ship.hull.json": edited_text().encode()}


EDITS = Kind("edits", "edits.json", make, commands, beside, weight=30)
