"""Hulls as canonical text, mostly with a fingerprint that agrees, so that they are opened."""

from __future__ import annotations

import json
import zlib
from random import Random
from typing import Any

from assoc_hull.model.definition.fingerprint import fingerprint
from assoc_hull.model.definition.restore import from_definition
from tests.fuzz.kind import TARGET, Kind
from tests.fuzz.kinds.hulls import edited_text, plain_text
from tests.fuzz.text import change_text
from tests.fuzz.values import change_value

__all__ = ["HULL_JSON"]

EDITS = b'[{"op": "transform", "scale": [1, 1.02, 1], "drivers": ["sections"]}]'
LATER = (
    ["check", "ship.hull.json"],
    ["verify", "ship.hull.json"],
    ["graph", "ship.hull.json", "--format", "json"],
    ["edit", "ship.hull.json", "edits.json", "-o", TARGET],
)


def make(rng: Random) -> bytes:
    """A changed text, or a changed document whose fingerprint is made anew."""
    text = plain_text() if rng.random() < 0.5 else edited_text()
    if rng.random() < 0.2:
        return change_text(rng, text)
    document = json.loads(text)
    part = rng.random()
    if part < 0.05:
        document = change_value(rng, document)
    else:
        half = "definition" if part < 0.65 else "published"
        document[half] = change_value(rng, document[half], rng.choice((1, 1, 1, 2)))
    if isinstance(document, dict) and rng.random() < 0.8:
        _sign(document)
    try:
        return json.dumps(document, ensure_ascii=False).encode("utf-8", "surrogatepass")
    except RecursionError:
        return b'{"definition": ' + b"[" * 3000 + b"]" * 3000 + b"}"


def _sign(document: dict[str, Any]) -> None:
    """Make the fingerprint agree, where a hull can be made at all."""
    try:
        state = from_definition(document["definition"], document["published"])
        document["fingerprint"] = fingerprint(state)
    except Exception:  # whatever it is, the trial meets it again, and judges it
        return


def commands(data: bytes) -> list[list[str]]:
    """Open it, and with one of three go a step further, if it can be opened."""
    later = zlib.crc32(data) % (3 * len(LATER))
    return [["info", "ship.hull.json"], *LATER[later : later + 1]]


def beside() -> dict[str, bytes]:
    """An edit of all of it."""
    return {"edits.json": EDITS}


HULL_JSON = Kind("hull_json", "ship.hull.json", make, commands, beside, weight=40)
