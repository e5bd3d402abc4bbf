"""A long study on local workers, killed and resumed: time, rows a second, memory of processes.

``python -m benchmarks.long_study [--rows 100000] [--workers 2] [--file study.sqlite] [--targets]``
draws breadth, draught and the shifts of both bodies of the bulk carrier; with ``--targets`` volume
and LCB are aimed at. The study runs in a process of its own, on a local Dask cluster. A worker of
it is killed after a fifth and after two fifths of the rows, the process itself after three fifths,
each by signal 9; then the same call goes on. At last every row must be there once, and rows drawn
at random must have the bits that this process makes of them.
"""

from __future__ import annotations

import argparse
import os
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

import assoc_hull as ah

__all__ = ["request"]

_KILLS = ((0.2, "a worker"), (0.4, "a worker"), (0.6, "the client"))
_LOOK = 1.0
"""s between two looks at the processes."""


def request(hull: ah.Hull, rows: int, *, targets: bool) -> dict[str, Any]:
    """Give what the study is asked for."""
    ship = hull.particulars
    if targets:
        now = hull.hydrostatics(estimate=False)
        ends = {"volume": (0.995 * now.volume, 1.005 * now.volume),
                "lcb": (now.lcb - 0.001 * ship.length, now.lcb + 0.001 * ship.length)}  # fmt: skip
        free = ["fore_shift", "aft_shift"]
        return {"reach": ah.study.sample(ends, rows, seed=1), "free": free}
    ranges = {
        "breadth": (0.99 * ship.breadth, 1.01 * ship.breadth),
        "draught": (0.99 * ship.draught, 1.01 * ship.draught),
        "fore_shift": (-1.0, 1.0), "aft_shift": (-1.0, 1.0),
    }  # fmt: skip
    return {"set": ah.study.sample(ranges, rows, seed=1)}


def _landed(path: Path) -> int:
    """Count the rows that are in the file."""
    try:
        database = sqlite3.connect(f"file:{path}?mode=rw", uri=True)
        with database:
            found = int(database.execute("SELECT count(*) FROM rows").fetchone()[0])
        database.close()
    except sqlite3.Error:
        return 0
    return found


def _memory(pid: int) -> float:
    """Give the memory of a process that it shares with no other, MB; 0 if it has ended."""
    try:
        text = Path(f"/proc/{pid}/smaps_rollup").read_text()
    except OSError:
        return 0.0
    return sum(int(line.split()[1]) for line in text.splitlines() if "Private_" in line) / 1024.0


def _children(pid: int) -> list[int]:
    """Give the processes that a process has begun and that make rows."""
    try:
        found = Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
        for each in Path(f"/proc/{pid}/task").iterdir():
            found += (each / "children").read_text().split()
    except OSError:
        return []
    return sorted({int(each) for each in found if _makes_rows(int(each))})


def _makes_rows(pid: int) -> bool:
    try:
        return b"spawn_main" in Path(f"/proc/{pid}/cmdline").read_bytes()
    except OSError:
        return False


def _watch(client: subprocess.Popen[bytes], path: Path, rows: int, kills: list[Any]) -> None:
    """Look at a study until it ends, and kill what is to be killed; print memory now and then."""
    told = _landed(path)
    start, before = time.perf_counter(), told
    while client.poll() is None:
        time.sleep(_LOOK)
        done = _landed(path)
        workers = _children(client.pid)
        if done - told >= rows // 10:
            told = done
            pace = (done - before) / (time.perf_counter() - start)
            sizes = ", ".join(f"{_memory(pid):.0f}" for pid in workers)
            print(f"{done:>9} rows, {pace:.2f} a second; private memory: client "
                  f"{_memory(client.pid):.0f} MB, workers {sizes} MB", flush=True)  # fmt: skip
        if kills and done >= kills[0][0] * rows and workers:
            what = kills.pop(0)[1]
            os.kill(client.pid if what == "the client" else workers[0], signal.SIGKILL)
            print(f"{done:>9} rows: {what} was killed", flush=True)


def _same(found: ah.study.Study, hull: ah.Hull, asked: dict[str, Any], count: int) -> int:
    """Make some rows here; give how many of them have other bits."""
    some = np.random.default_rng(1).choice(len(found), min(count, len(found)), replace=False)
    key = "set" if "set" in asked else "reach"
    part = {name: column[some] for name, column in asked[key].items()}
    here = hull.study(**{**asked, key: part}).to_array()
    there = found.to_array()[some]
    names = [name for name in here.dtype.names or () if name != "number"]
    return sum(
        any(one[name].tobytes() != other[name].tobytes() for name in names)
        for one, other in zip(here[names], there[names], strict=True)
    )


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a study, kill it, let it go on, and print the figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rows", type=int, default=100_000)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--file", type=Path)
    parser.add_argument("--targets", action="store_true")
    parser.add_argument("--again", type=int, default=20, help="rows that are made here as well")
    parser.add_argument("--child", action="store_true", help=argparse.SUPPRESS)
    given = parser.parse_args(arguments)
    hull = ah.examples.bulk_carrier_207k()
    asked = request(hull, given.rows, targets=given.targets)
    if given.child:
        hull.study(**asked, file=given.file, cluster="local", workers=given.workers)
        return 0
    with tempfile.TemporaryDirectory() as folder:
        path = given.file or Path(folder) / "study.sqlite"
        command = [sys.executable, "-m", "benchmarks.long_study", "--child",
                   *(["--targets"] if given.targets else []), "--rows", str(given.rows),
                   "--workers", str(given.workers), "--file", str(path)]  # fmt: skip
        kills, start = list(_KILLS), time.perf_counter()
        while _landed(path) < given.rows:
            _watch(subprocess.Popen(command), path, given.rows, kills)
        spent = time.perf_counter() - start
        print(f"all rows              {given.rows} in {spent:.0f} s, with what kills cost")
        print(f"rows a second         {given.rows / spent:.2f}")
        found = hull.study(**asked, file=path)
        numbers = found.table()["number"]
        once = numbers.tolist() == list(range(given.rows))
        print(f"every row once        {'yes' if once else 'NO'}")
        print(f"variants              {found}")
        print(f"file                  {path.stat().st_size / given.rows:.0f} bytes a row")
        other = _same(found, hull, asked, given.again)
        print(f"other bits than here  {other} of {min(given.again, given.rows)} rows")
    return 0 if once and not other else 1


if __name__ == "__main__":
    sys.exit(main())
