"""Which arithmetic runs the program of a net: numpy, or the compiled form where that is at hand.

Compiling takes a minute of one processor, once on a machine; so it is done by a child process,
which leaves it in the cache of numba, and numpy serves until then. Both give the same bits.
``ASSOC_HULL_FAST=0`` keeps to numpy, ``1`` compiles here and now. Nothing of numba is imported
before somebody drags: that would cost a command that runs once a third of a second.
"""

from __future__ import annotations

import contextlib
import importlib.util
import os
import subprocess
import sys
from typing import TYPE_CHECKING

import attrs

from assoc_hull.geometry.splines.backend import backend
from assoc_hull.graph.derived import Gate
from assoc_hull.model.program.run_program import NumpyProgram, RunProgram
from assoc_hull.model.program.structure import Program
from assoc_hull.model.tables import HullState

if TYPE_CHECKING:
    from assoc_hull.model.program.compiled_fields import CompiledFields

__all__ = [
    "engine_words",
    "fields_of",
    "is_asked_often",
    "is_compiled",
    "runner_of",
    "wait_for_engine",
]

_ALONE = """
import contextlib, os, assoc_hull
with contextlib.suppress(ImportError, OSError):
    import fcntl
    fcntl.flock(os.open(os.path.dirname(assoc_hull.__file__), os.O_RDONLY), fcntl.LOCK_EX)
"""
"""Lets one process compile at a time: the next one finds what was compiled, and does not anew.

It locks the folder of the package, as long as the process lives; where that cannot be, each goes
on."""

_MAKE = f"""
import os, sys
again, *sys.path[:] = sys.argv[1:]
if again == "no" and hasattr(os, "nice"):
    os.nice(5)
{_ALONE}
from assoc_hull.edit.recut import compiled_images
from assoc_hull.geometry.floating import compiled_doubts, compiled_immersion, compiled_sections
from assoc_hull.geometry.surfaces import compiled_cells
from assoc_hull.model.program import compiled_fields, compiled_program
from assoc_hull.variation.certificate import compiled_search
from assoc_hull.variation.features import compiled_map
parts = (
    compiled_program, compiled_fields, compiled_map, compiled_cells, compiled_immersion,
    compiled_sections, compiled_doubts, compiled_images, compiled_search,
)
if not all([each.warm() for each in parts]):
    if again == "yes":
        sys.exit("what numba compiles cannot be kept on this disk: see NUMBA_CACHE_DIR")
    os.execv(sys.executable, [sys.executable, "-c", os.environ["MAKE"], "yes", *sys.path])
"""
"""What the child runs: it compiles, and makes sure that another process finds that in the cache.

It is a program of its own, so it may compile what stands on top of this package, too."""

_SELDOM = 20
"""Who edits a hull more often is no command that runs once."""

_gate = Gate()


@attrs.define
class _Engine:
    """What is known of the compiled form in this process; `told` says why numpy serves."""

    child: subprocess.Popen[bytes] | None = None
    told: str = ""
    ready: bool = False
    asked: int = 0


_engine = _Engine()


def runner_of(program: Program) -> RunProgram:
    """Give a program with the arithmetic at hand; where none is compiled yet, begin that."""
    if _is_ready():
        from assoc_hull.model.program.compiled_program import CompiledProgram

        return CompiledProgram(program)
    return NumpyProgram(program)


def fields_of(state: HullState, program: Program, short: float) -> CompiledFields | None:
    """Give what displaces points of a hull along its normals; None where numpy serves.

    Ends of a curve nearer than `short`, m, do not tell its course.
    """
    if not _is_ready():
        return None
    from assoc_hull.model.program.compiled_fields import CompiledFields, FieldStructure

    depends_on = program, state.lines.boundary, state.settings.particulars, short
    structure = state.derived(
        ("field structure",), depends_on, lambda: FieldStructure.of(state, program, short), most=1
    )
    return None if structure is None else CompiledFields(structure, program)


def is_compiled(*, counts: bool = True) -> bool:
    """Tell whether the compiled form serves; one who asks often enough has it made.

    A process that runs once asks seldom: it is not to pay for a compilation. What asks often for
    the sake of one hull does not count.
    """
    _engine.asked += counts
    return _engine.ready or (_engine.asked > _SELDOM and _is_ready())


def is_asked_often() -> bool:
    """Tell whether this process has asked so often that what it compiles is worth while."""
    return _engine.asked > _SELDOM


def engine_words() -> str:
    """Say in one line which arithmetic serves, and why."""
    if _is_ready():
        return "compiled by numba"
    return f"numpy: {_engine.told}"


def wait_for_engine(seconds: float = 300.0) -> str:
    """Wait until the compiled form is at hand, if it is being made; say which arithmetic serves."""
    _is_ready()
    child = _engine.child
    if child is not None:
        with contextlib.suppress(subprocess.TimeoutExpired):
            child.wait(seconds)
    return engine_words()


def _is_ready() -> bool:
    """Tell whether the compiled form can be used at once; ask for it where nobody has."""
    if os.environ.get("ASSOC_HULL_FAST") == "0":
        _engine.told = "ASSOC_HULL_FAST=0 asks for it"
        return False
    if backend() == "numba":
        return True
    return _gate.alone(_look)


def _look() -> bool:
    """Begin to compile, or see whether that is done."""
    if not _engine.ready and not _engine.told:
        _begin()
    child = _engine.child
    if child is not None and child.poll() is not None:
        _finish(child)
    return _engine.ready


def _begin() -> None:
    """Let a child process compile, or find what was compiled before."""
    if importlib.util.find_spec("numba") is None:
        _engine.told = "numba is not installed (pip install 'assoc-hull[fast]')"
        return
    command = [sys.executable, "-c", _MAKE, "no", *sys.path]
    try:
        _engine.child = subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            env={**os.environ, "MAKE": _MAKE, "ASSOC_HULL_FAST": "0"},
            start_new_session=True,  # Ctrl-C in the terminal is not meant for it
        )
        _engine.told = "the compiled form is being made"
    except OSError as error:
        _engine.told = f"the compiled form cannot be made ({error})"


def _finish(child: subprocess.Popen[bytes]) -> None:
    """Take note of how a child has ended."""
    _engine.child = None
    told = child.communicate()[1].decode(errors="replace")
    if child.returncode == 0:
        _engine.ready = True
        return
    last = told.strip().splitlines()[-1:] or [f"exit code {child.returncode}"]
    _engine.told = f"the compiled form cannot be made ({last[0]})"
