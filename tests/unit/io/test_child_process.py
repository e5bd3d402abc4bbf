"""Foreign libraries in a child: results and errors come back, limits hold, and nothing hangs."""

from __future__ import annotations

import contextlib
import copyreg
import gzip
import os
import pickle
import signal
import socket
import subprocess
import sys
import time
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.cli import main
from assoc_hull.errors import AssocHullError, BadInputError
from assoc_hull.hull.sources import read_classical
from assoc_hull.io import child_process
from assoc_hull.io.child_process import ChildSession, Limits, limits_for, run_in_child
from assoc_hull.io.mesh.read import read_triangles
from assoc_hull.io.rhino.read import read_rhino
from assoc_hull.io.write_file import write_whole
from tests import meshes
from tests.unit.test_errors import SAMPLES

FEW = Limits(seconds=5.0, memory=300.0)
POSIX = pytest.mark.skipif(not hasattr(os, "fork"), reason="the system has no such limits")


def test_arrays_come_back_as_they_were_made_there() -> None:
    """With their bits, from a process of another number."""
    found = run_in_child("numpy:linspace", (0.0, 1.0, 7), FEW, "here")
    assert np.array_equal(found, np.linspace(0.0, 1.0, 7))
    assert run_in_child("os:getpid", (), FEW, "here") != os.getpid()


@pytest.mark.parametrize(
    "error", [pytest.param(each[0], id=type(each[0]).__name__) for each in SAMPLES]
)
def test_errors_of_the_package_come_through_pickles(
    error: Exception, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each with its words and its facts."""
    # Dask, once it is imported, pickles all errors in its own way; no child imports it.
    for kind in [each for each in copyreg.dispatch_table if issubclass(each, BaseException)]:
        monkeypatch.delitem(copyreg.dispatch_table, kind)
    back = child_process._Plain(BytesIO(pickle.dumps(error, protocol=5))).load()
    assert type(back) is type(error)
    assert str(back) == str(error)
    assert vars(back) == vars(error)


def test_an_error_that_is_raised_there_is_raised_here(tmp_path: Path) -> None:
    """As the same error, with its fields."""
    path = tmp_path / "a.obj"
    path.write_text("v 0 0 0\n")
    with pytest.raises(BadInputError) as found:
        read_triangles(path)
    assert found.value.what == "there are no triangles"
    assert found.value.where == f"at {path}"


@POSIX
@pytest.mark.parametrize(
    ("target", "arguments", "words"),
    [
        pytest.param("os:abort", (), r"broke down \(SIGABRT\)", id="aborts"),
        pytest.param("ctypes:string_at", (0,), r"broke down \(SIGSEGV\)", id="reads at nil"),
        pytest.param("os:_exit", (7,), "broke down", id="exits"),
        pytest.param("builtins:bytearray", (4_000_000_000,), "more than 300 MB", id="memory"),
        pytest.param("builtins:int", ("x",), r"cannot be read \(ValueError\)", id="raises"),
        pytest.param("os:system", ("kill -9 $PPID",), r"\(SIGKILL\)", id="is killed"),
        pytest.param("threading:Lock", (), "cannot be read", id="odd"),
    ],
)
def test_what_breaks_down_there_is_an_error_here(
    target: str, arguments: tuple[Any, ...], words: str
) -> None:
    """It is said how; and the next call is answered."""
    with pytest.raises(BadInputError, match=words) as found:
        run_in_child(target, arguments, FEW, "at hull.step")
    assert "at hull.step" in str(found.value)
    assert run_in_child("builtins:len", ("abc",), FEW, "here") == 3


@POSIX
def test_a_child_that_computes_for_too_long_is_ended() -> None:
    """The remedy names the variable that allows more."""
    with pytest.raises(BadInputError, match=r"more than 1 s of proc.*ASSOC_HULL_READ_SECONDS"):
        run_in_child("builtins:sum", (range(10**13),), Limits(1.0, 300.0), "here")


def test_a_child_that_sleeps_is_ended_by_the_clock(monkeypatch: pytest.MonkeyPatch) -> None:
    """It takes no processor time at all."""
    monkeypatch.setattr(child_process, "_GRACE", 1.0)
    run_in_child("builtins:len", ("abc",), FEW, "here")
    with pytest.raises(BadInputError, match="more than 0 s of processor time"):
        run_in_child("time:sleep", (1000.0,), Limits(0.01, 300.0), "here")


def test_an_object_lives_there_from_call_to_call() -> None:
    """Two sessions at once do not know of one another; one that is forgotten ends."""
    one = ChildSession("collections:Counter", ("aab",), FEW, "here")
    other = ChildSession("collections:Counter", ("b",), FEW, "here")
    one.call("update", "abb")
    assert one.call("most_common") == [("a", 3), ("b", 3)]
    assert other.call("most_common") == [("b", 1)]
    waiting = len(child_process._WAITING)
    del one
    assert len(child_process._WAITING) == waiting + 1
    other.close()


def test_a_child_that_was_taken_over_makes_nothing_run_here() -> None:
    """Only arrays, plain values and errors of the package are taken from it."""
    for value in (os.system, Path("x"), print, ah.Hull):
        with pytest.raises(pickle.UnpicklingError):
            child_process._Plain(BytesIO(pickle.dumps(value))).load()
    kept = {"a": [1, 2.5, None, (True, "b")], "c": np.arange(3.0)}
    found = child_process._Plain(BytesIO(pickle.dumps(kept, protocol=5))).load()
    assert str(found) == str(kept)


def test_limits_grow_with_the_file_and_are_given_by_the_environment(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A small file has 8 s and 600 MB; what is no number is refused by its name."""
    path = tmp_path / "a"
    path.write_bytes(b"x" * 1000)
    small = limits_for(path)
    assert (round(small.seconds), round(small.memory)) == (8, 600)
    path.write_bytes(b"x" * 2_000_000)
    assert limits_for(path).seconds > 100.0
    monkeypatch.setenv("ASSOC_HULL_READ_SECONDS", "3")
    monkeypatch.setenv("ASSOC_HULL_READ_MEMORY", "50")
    assert limits_for(path) == Limits(3.0, 50.0)
    monkeypatch.setenv("ASSOC_HULL_READ_SECONDS", "long")
    with pytest.raises(BadInputError, match="ASSOC_HULL_READ_SECONDS is 'long'"):
        limits_for(path)


def nested(depth: int) -> str:
    """A STEP file whose brackets go so deep."""
    point = f"#1=CARTESIAN_POINT('',{'(' * depth}0.,0.,0.{')' * depth});"
    unit = "#2=( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT($,.METRE.) );"
    head = "HEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');"
    schema = "FILE_SCHEMA(('CONFIG_CONTROL_DESIGN'));\nENDSEC;"
    rows = ["ISO-10303-21;", head, schema, "DATA;", point, unit, "ENDSEC;", "END-ISO-10303-21;"]
    return "\n".join(rows) + "\n"


def test_a_step_file_that_ends_opencascade_ends_no_more_than_its_child(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """200,000 nested brackets: one line of error, exit code 2, and no file."""
    pytest.importorskip("OCP")
    path = tmp_path / "deep.step"
    path.write_text(nested(200_000))
    assert main(["import", str(path), "-o", str(tmp_path / "a.hull")]) == 2
    words = capsys.readouterr().err.strip().splitlines()[-1]
    assert "broke down (SIGSEGV)" in words
    assert list(tmp_path.iterdir()) == [path]


def test_a_small_file_that_unpacks_to_much_is_refused(tmp_path: Path) -> None:
    """.2 MB that hold 80 MB; a hull that is packed is read."""
    path = tmp_path / "bomb.stl.gz"
    path.write_bytes(gzip.compress(b"solid\n" + b"facet normal 0 0 1\n" * 4_000_000, 9))
    assert path.stat().st_size < 200_000
    with pytest.raises(BadInputError, match=r"holds more than [0-9.]+ MB unpacked"):
        ah.read(path)
    good = meshes.write(meshes.wigley_half(), tmp_path / "hull.stl.gz")
    assert len(read_triangles(good).face) == len(meshes.wigley_half().face)


def test_a_damaged_file_of_rhino_is_an_error_of_the_family(tmp_path: Path) -> None:
    """Bytes of it changed here and there: rhino3dm may end its child, and nothing else."""
    pytest.importorskip("rhino3dm")
    path = tmp_path / "a.3dm"
    ah.examples.wigley().export(path)
    whole, draw = path.read_bytes(), np.random.default_rng(3)
    for _ in range(4):
        data = np.frombuffer(whole, np.uint8).copy()
        data[draw.integers(32, len(data), 400)] = draw.integers(0, 256, 400)
        path.write_bytes(data.tobytes())
        with contextlib.suppress(AssocHullError):
            read_rhino(path)
    path.write_bytes(whole[: len(whole) // 2])
    with pytest.raises(BadInputError, match=r"a\.3dm"):
        read_rhino(path)
    path.write_bytes(whole)
    assert len(read_rhino(path).curves) > 30


@pytest.mark.parametrize("ending", [".step", ".stl", ".csv", ".hull", ".hull.json", ""])
def test_what_is_no_regular_file_is_refused_with_words(
    tmp_path: Path, ending: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """A pipe would be waited for for ever; a folder is an error of the family."""
    pipe, folder = tmp_path / f"pipe{ending}", tmp_path / f"folder{ending}"
    os.mkfifo(pipe)
    folder.mkdir()
    with pytest.raises(BadInputError, match="this is a pipe and no regular file"):
        ah.read(pipe)
    with pytest.raises(AssocHullError):
        ah.read(folder)
    assert main(["import", str(pipe), "-o", str(tmp_path / "a.hull")]) == 2
    assert "this is a pipe" in capsys.readouterr().err


def test_other_doors_refuse_pipes_and_devices(tmp_path: Path) -> None:
    """Saved hulls, texts of definitions and surfaces as well."""
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    with pytest.raises(BadInputError, match="this is a pipe"):
        ah.open(pipe)
    with pytest.raises(BadInputError, match="this is a pipe"):
        ah.surface.read_surfaces(pipe)
    with pytest.raises(BadInputError, match="this is a pipe"):
        read_classical(pipe)
    with pytest.raises(BadInputError, match="this is a device"):
        ah.read(os.devnull)
    place = Path(os.environ.get("TMPDIR", "/tmp")) / f"assoc-hull-{os.getpid()}"
    with socket.socket(socket.AF_UNIX) as made:
        made.bind(str(place))
        try:
            with pytest.raises(BadInputError, match="this is a socket"):
                ah.read(place)
        finally:
            place.unlink()


def test_an_export_follows_no_link_out_of_its_folder(tmp_path: Path) -> None:
    """The place that the message names is written to when it is given itself, or on demand."""
    inside, outside = tmp_path / "in", tmp_path / "out"
    inside.mkdir()
    outside.mkdir()
    (outside / "a.csv").write_text("kept")
    (inside / "a.csv").symlink_to(outside / "a.csv")
    with pytest.raises(BadInputError, match="a link out of its folder") as found:
        ah.examples.wigley().export(inside / "a.csv")
    assert (outside / "a.csv").read_text() == "kept"
    target = found.value.what.rpartition("to ")[2]
    write_whole(target, b"1")
    assert (outside / "a.csv").read_text() == "1"
    write_whole(inside / "a.csv", b"2", follow=True)
    assert (outside / "a.csv").read_text() == "2"
    (tmp_path / "other").symlink_to(inside)
    write_whole(tmp_path / "other" / "b.csv", b"3")
    assert (inside / "b.csv").read_text() == "3"


@POSIX
def test_no_child_outlives_the_program() -> None:
    """A server that waits ends with the process that made it, also where that is killed."""
    script = (
        "import os, signal\n"
        "from assoc_hull.io import child_process as c\n"
        "c.run_in_child('builtins:len', ('abc',), c.Limits(5, 300), 'here')\n"
        "print(c._WAITING[0].process.pid, flush=True)\n"
        "os.kill(os.getpid(), signal.SIGKILL)\n"
    )
    run = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert run.returncode == -signal.SIGKILL
    server = Path("/proc") / run.stdout.strip()
    for _ in range(100):
        if not server.exists() or "Z" in (server / "stat").read_text().split()[2]:
            return
        time.sleep(0.1)
    raise AssertionError(f"{server} is there still")


def test_names_of_files_are_relative_to_where_the_caller_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also when the server was started from another folder."""
    for name in ("one", "two"):
        folder = tmp_path / name
        folder.mkdir()
        meshes.write(meshes.wigley_half(), folder / f"{name}.stl")
        monkeypatch.chdir(folder)
        assert len(read_triangles(Path(f"{name}.stl")).face) == len(meshes.wigley_half().face)
