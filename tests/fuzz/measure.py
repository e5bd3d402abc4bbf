"""What a trial takes of the machine: processor time, with that of readers in children, and memory.

Where the system tells neither, both are nil.
"""

from __future__ import annotations

import contextlib
import gc
import os
import time
from pathlib import Path

from assoc_hull.io import child_process

__all__ = ["MOST_MEMORY", "MOST_TIME", "peak_memory", "processor_time", "reset_peak"]

MOST_TIME = 10.0
"""Seconds of processor time that one input may take."""

MOST_MEMORY = 1000.0
"""Megabytes that one input may take, on top of what this process held before."""

_TICK = float(os.sysconf("SC_CLK_TCK")) if hasattr(os, "sysconf") else 100.0


def processor_time() -> float:
    """Seconds of this process and of the children that wait for it, so far."""
    # A child waits again once its session is forgotten: what it did before counts as done.
    gc.collect()
    return time.process_time() + sum(map(_of, child_process._WAITING))


def _of(server: child_process._Server) -> float:
    """Seconds of a server and of the workers that have ended."""
    try:
        text = Path(f"/proc/{server.process.pid}/stat").read_text()
    except OSError:
        return 0.0
    return sum(map(int, text.rpartition(")")[2].split()[11:15])) / _TICK


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
