"""Which arithmetic runs the program, and what is said of it."""

from __future__ import annotations

import importlib.util
import os
import select
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import assoc_hull
from assoc_hull.cli import main
from assoc_hull.model.program import engine as program_engine
from assoc_hull.model.program.engine import engine_words, wait_for_engine


@pytest.fixture(autouse=True)
def nobody_has_asked(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Let every test begin as a process does."""
    engine = program_engine._Engine()
    monkeypatch.setattr(program_engine, "_engine", engine)
    monkeypatch.delenv("ASSOC_HULL_FAST", raising=False)
    monkeypatch.setattr(program_engine, "backend", lambda: "numpy")
    yield
    if engine.child is not None:
        engine.child.communicate()


def child_that(monkeypatch: pytest.MonkeyPatch, code: str) -> None:
    """Let the child run other code."""
    pytest.importorskip("numba")
    monkeypatch.setattr(program_engine, "_MAKE", code)


def test_numpy_can_be_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    """Then no child is started."""
    monkeypatch.setenv("ASSOC_HULL_FAST", "0")
    monkeypatch.setattr(program_engine, "_begin", lambda: pytest.fail("a child"))
    assert engine_words() == "numpy: ASSOC_HULL_FAST=0 asks for it"


def test_without_numba_numpy_serves_and_says_what_to_install(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """It is no error."""
    monkeypatch.setattr(importlib.util, "find_spec", lambda _: None)
    assert "pip install 'assoc-hull[fast]'" in engine_words()


def test_numpy_serves_while_a_child_compiles(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """When the child is done the compiled form serves."""
    told = tmp_path / "told"
    code = f"import os, time\nwhile not os.path.exists({str(told)!r}):\n    time.sleep(0.01)"
    child_that(monkeypatch, code)
    assert engine_words() == "numpy: the compiled form is being made"
    told.touch()
    assert wait_for_engine() == "compiled by numba"


@pytest.mark.parametrize(
    ("code", "words"),
    [
        ("raise ImportError('numba is too old')", "ImportError: numba is too old"),
        ("import sys; sys.exit('what numba compiles cannot be kept')", "cannot be kept"),
        ("import os; os._exit(9)", "exit code 9"),
    ],
)
def test_a_child_that_fails_leaves_numpy_and_says_why(
    monkeypatch: pytest.MonkeyPatch, code: str, words: str
) -> None:
    """It is asked once in a process, not at every drag."""
    child_that(monkeypatch, code)
    assert words in wait_for_engine()
    monkeypatch.setattr(program_engine, "_begin", lambda: pytest.fail("a second child"))
    assert words in engine_words()


@pytest.mark.skipif(not hasattr(os, "getsid"), reason="no sessions here")
def test_an_interrupt_from_the_terminal_does_not_reach_the_child(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """It is in a session of its own."""
    child_that(monkeypatch, "import os, sys; sys.exit(os.getsid(0) != os.getpid())")
    assert wait_for_engine() == "compiled by numba"


def test_what_a_child_compiles_is_found_by_another_process() -> None:
    """One version of each function is compiled, and it is loaded the next time."""
    pytest.importorskip("numba")
    code = (
        "from assoc_hull.model.program.engine import wait_for_engine\n"
        "print(wait_for_engine())\n"
        "from assoc_hull.model.program import compiled_program as made\n"
        "made.warm()\n"
        "parts = made.run, made.restore, made.gather, made.compare\n"
        "print(*(len(each.signatures) for each in parts))\n"
        "from assoc_hull.variation.features.compiled_map import warm\n"
        "print(warm())\n"
    )
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout.split("\n")[:3] == ["compiled by numba", "1 1 1 1", "True"], found


def test_two_processes_do_not_compile_the_same_at_once() -> None:
    """A minute of a processor is spent once; the second looks when the first is done."""
    fcntl = pytest.importorskip("fcntl")
    code = f"import assoc_hull\nprint('begun', flush=True)\n{program_engine._ALONE}\nprint('done')"
    folder = os.open(Path(assoc_hull.__file__).parent, os.O_RDONLY)
    try:
        fcntl.flock(folder, fcntl.LOCK_EX)
        with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE) as child:
            assert child.stdout is not None
            assert child.stdout.readline() == b"begun\n"
            assert not select.select([child.stdout], [], [], 0.3)[0]
            fcntl.flock(folder, fcntl.LOCK_UN)
            assert child.stdout.read() == b"done\n"
    finally:
        os.close(folder)


def test_the_command_tells(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """No hull is needed for it, and one is for all else."""
    monkeypatch.setenv("ASSOC_HULL_FAST", "0")
    assert main(["info", "--engine", "--wait"]) == 0
    assert capsys.readouterr().out == "numpy: ASSOC_HULL_FAST=0 asks for it\n"
    assert main(["info"]) == 2
    assert "give HULL, or --engine" in capsys.readouterr().err


def test_who_asks_seldom_has_nothing_compiled(monkeypatch: pytest.MonkeyPatch) -> None:
    """Twenty asks are answered with no; from the next one on the compiled form serves."""
    looked = list[bool]()

    def ready() -> bool:
        looked.append(True)
        return True

    monkeypatch.setattr(program_engine, "_is_ready", ready)
    assert not any(program_engine.is_compiled(counts=False) for _ in range(50))
    told = [program_engine.is_compiled() for _ in range(23)]
    assert told == [False] * 20 + [True] * 3
    assert len(looked) == 3
