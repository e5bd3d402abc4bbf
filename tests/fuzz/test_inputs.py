"""Malformed inputs give one line of error or a whole file, and nothing else.

`python -m tests.fuzz` tries as many as one likes; here stand those that once broke the
program, and some that are new each time.
"""

from __future__ import annotations

import tempfile
from pathlib import Path
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.fuzz.all_kinds import KINDS
from tests.fuzz.harvest import CORPUS
from tests.fuzz.kind import made
from tests.fuzz.trial import trial
from tests.long_forms import LONG, draws

KEPT = sorted(path for path in CORPUS.rglob("*") if path.is_file())
TIMES = 4 if LONG else 2
"""Inputs of each kind that takes long."""

SLOW = {name: kind for name, kind in KINDS.items() if kind.weight < 10}


@pytest.mark.parametrize("path", KEPT, ids=lambda path: f"{path.parent.name}: {path.name}")
def test_what_was_once_broken_is_mended(path: Path, tmp_path: Path) -> None:
    """Every input of the corpus is taken, or refused in one line that says why."""
    assert trial(KINDS[path.parent.name], path.read_bytes(), tmp_path).fault == ""


@pytest.mark.parametrize("name", [name for name in KINDS if name not in SLOW])
@settings(max_examples=draws(60))
@given(rng=st.randoms(use_true_random=False))
def test_a_changed_input_is_taken_or_refused(name: str, rng: Random) -> None:
    """No traceback, no second line, no file but the one that was asked for, and that whole."""
    with tempfile.TemporaryDirectory() as folder:
        assert trial(KINDS[name], KINDS[name].make(rng), Path(folder)).fault == ""


@pytest.mark.parametrize("number", range(TIMES))
@pytest.mark.parametrize("name", SLOW)
def test_a_changed_drawing_or_mesh_is_taken_or_refused(
    name: str, number: int, tmp_path: Path
) -> None:
    """The same, for inputs that take long."""
    assert trial(SLOW[name], made(SLOW[name], 0, number), tmp_path).fault == ""
