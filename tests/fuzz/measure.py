"""What a trial takes of the machine: processor time, with that of readers in children, and memory.

Where the system tells neither, both are nil.
"""

from __future__ import annotations

import contextlib
import os
import time
from pathlib import Path

__all__ = ["MOST_MEMORY", "MOST_TIME", "peak_memory", "processor_time", "reset_peak"]

MOST_TIME = 10.0
"""Seconds of processor time that one input may take."""

MOST_MEMORY = 1000.0
"""Megabytes that one input may take, on top of what this process held before."""

_TICK = float(os.sysconf("SC_CLK_TCK")) if hasattr(os, "sysconf") else 100.0


def processor_time() -> float:
    """Seconds of this process and of all processes that it has started, so far."""
    started: dict[str, list[str]] = {}
    spent: dict[str, float] = {}
    for path in Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError):
            fields = path.read_text().rpartition(")")[2].split()
            started.setdefault(fields[1], []).append(path.parent.name)
            # Its own, and of those that it waited for: what still runs is counted by itself.
            spent[path.parent.name] = sum(map(int, fields[11:15])) / _TICK
    found, below = time.process_time(), started.get(str(os.getpid()), [])
    while below:
        found += sum(spent[each] for each in below)
        below = [child for each in below for child in started.get(each, [])]
    return found


def reset_peak() -> float:
    """Forget how much memory was held at most; give what is held now, MB."""
    with contextlib.suppress(OSError):
        Path("/proc/self/clear_refs").write_text("5")
    return _status("VmRSS:")


def peak_memory() -> float:
    """Megabytes held at most since then."""
    return _status("VmHWM:")


def _status(name: str) -> float:
    with contextlib.suppress(OSError):
        for line in Path("/proc/self/status").read_text().splitlines():
            if line.startswith(name):
                return int(line.split()[1]) / 1e3
    return 0.0
