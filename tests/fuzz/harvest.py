"""What a run found: counts by kind, and an input for each fault, made small and kept."""

from __future__ import annotations

import re
import tempfile
import time
import zlib
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import attrs

from tests.fuzz.kind import Kind
from tests.fuzz.pool import DEAD, HANG, Item
from tests.fuzz.trial import Outcome, signature, trial

__all__ = ["CORPUS", "Tally", "keep", "small"]

CORPUS = Path(__file__).with_name("corpus")
"""What once was broken: a folder by kind, an input per file."""

_TIME = 20.0
"""Seconds that are spent on making one input small."""


@attrs.define
class Tally:
    """The counts of a kind."""

    codes: Counter[int] = attrs.field(factory=Counter)
    faults: dict[str, list[tuple[Item, Outcome]]] = attrs.field(factory=dict)
    slowest: float = 0.0
    words: Counter[str] = attrs.field(factory=Counter)
    spent: float = 0.0
    memory: float = 0.0

    def add(self, item: Item, outcome: Outcome) -> None:
        """Count an outcome."""
        self.codes[outcome.code] += 1
        self.slowest = max(self.slowest, outcome.seconds)
        self.spent = max(self.spent, outcome.spent)
        self.memory = max(self.memory, outcome.memory)
        if outcome.code == 0 and outcome.word:
            self.words[outcome.word] += 1
        if outcome.fault:
            self.faults.setdefault(signature(outcome.fault), []).append((item, outcome))

    def line(self, name: str) -> str:
        """The row of a table: see `HEAD`."""
        number, lost = sum(self.codes.values()), sum(map(len, self.faults.values()))
        words = [self.words[each] for each in ("sound", "sound with suspicions", "not sound")]
        counts = [number, *(self.codes[code] for code in (2, 3, 1, 0)), *words]
        return (
            f"{name:13}{''.join(f'{each:9}' for each in counts)}{lost:9}{len(self.faults):8}"
            f"{self.slowest:9.2f}{self.spent:8.2f}{self.memory:8.0f}"
        )


def keep(item: Item, fault: str, folder: Path = CORPUS) -> Path:
    """Keep an input, made small, under a name that tells the fault."""
    data = item.data
    if fault not in (HANG, DEAD):
        data = small(item.kind, data, fault)
    place = folder / item.kind.name
    place.mkdir(parents=True, exist_ok=True)
    words = re.sub(r"[^a-z]+", "-", signature(fault).lower())[:48].strip("-")
    path = place / f"{words}-{zlib.crc32(signature(fault).encode()):08x}"
    path.write_bytes(data)
    return path


def small(kind: Kind, data: bytes, fault: str) -> bytes:
    """Take lines, then pieces, out of an input while its fault stays the same."""
    until, wanted = time.monotonic() + _TIME, signature(fault)
    with tempfile.TemporaryDirectory(prefix="fuzz-") as folder:

        def same(tried: bytes) -> bool:
            found = trial(kind, tried, Path(folder)).fault
            return bool(found) and signature(found) == wanted

        for mark in (b"\n", b",", b" "):
            data = _without(data, mark, same, until)
    return data


def _without(data: bytes, mark: bytes, same: Callable[[bytes], bool], until: float) -> bytes:
    """Take runs of parts out, long ones first."""
    parts = data.split(mark)
    size = len(parts) // 2
    while size:
        at = 0
        while at < len(parts) and time.monotonic() < until:
            rest = parts[:at] + parts[at + size :]
            if same(mark.join(rest)):
                parts = rest
            else:
                at += size
        size //= 2
    return mark.join(parts)
