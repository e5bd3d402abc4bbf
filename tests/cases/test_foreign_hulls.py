"""Foreign files of hulls come in right, or say what is wrong: a table of files and options.

The ordinary suite tries the cheapest files; with `make test-long` all of them, and the table in
the documentation is compared with what was found.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from tests.foreign_hulls import CORPUS, QUICK, Foreign, Row, row_of, uses_of
from tests.long_forms import LONG, long_form

TRIED = tuple(case for case in CORPUS if LONG or case.name in QUICK)
SOUND = tuple(case for case in TRIED if case.sound)

LEAST = 9
"""So many files come in right with nothing said."""

NOT_RUN = {"carrier_transom": {"mesh", "surface"}}
"""What does not run yet on a hull that is right: her bossing's end is a curve of no family, is left
out with a suspicion that names it, and leaves the net open there."""

USED = tuple(case for case in SOUND if LONG or case.name == "sysser1")
"""Surfaces take seconds each."""

Rows = Callable[[Foreign], Row]


def _names(case: Foreign) -> str:
    return case.name


@pytest.fixture(scope="module")
def rows(tmp_path_factory: pytest.TempPathFactory, data_folder: Path) -> Rows:
    """Rows of the table, each made when it is first asked for."""
    assert data_folder.is_dir()
    made: dict[str, Row] = {}

    def row(case: Foreign) -> Row:
        if case.name not in made:
            made[case.name] = row_of(case, tmp_path_factory.mktemp(case.name))
        return made[case.name]

    return row


@pytest.mark.parametrize("case", SOUND, ids=_names)
def test_with_the_right_options_a_hull_is_taken_and_right(case: Foreign, rows: Rows) -> None:
    """V within .05 %, LCB within .05 % of Lpp, S within .5 % of what the file was cut from."""
    cell = rows(case).right
    assert (cell.word, cell.text) == ("right", "")


@pytest.mark.parametrize("case", USED, ids=_names)
def test_what_is_run_next_runs_on_a_hull_taken(case: Foreign, rows: Rows) -> None:
    """Hydrostatics, a variation of breadth, panels, closed mesh and surface."""
    hull = rows(case).right.hull
    assert hull is not None
    assert set(uses_of(hull)) == NOT_RUN.get(case.name, set())


@pytest.mark.parametrize("case", TRIED, ids=_names)
def test_with_nothing_said_a_hull_is_right_or_the_refusal_helps(case: Foreign, rows: Rows) -> None:
    """What is refused is right as soon as what the refusal asks for is given."""
    row = rows(case)
    if case.sound and row.remedy is not None:
        assert row.remedy[1].word == "right", row.defaults.text
    else:
        assert row.defaults.word == ("right" if case.sound else "refused"), row.defaults.text


@pytest.mark.parametrize("case", TRIED, ids=_names)
def test_a_wrong_option_is_refused_or_named(case: Foreign, rows: Rows) -> None:
    """No wrong length, draught, unit or scale leads to wrong numbers in silence."""
    found = {str(wrong): cell.word for wrong, cell in rows(case).wrong}
    assert {word for word in found.values() if word not in ("refused", "told")} == set(), found


def test_clean_files_raise_few_suspicions(rows: Rows) -> None:
    """With the right options, one suspicion at most in the median."""
    counts = [len(rows(case).right.suspicions) for case in SOUND]
    assert np.median(counts) <= 1, counts


@long_form
def test_most_files_come_in_right_with_nothing_said(rows: Rows) -> None:
    """At least nine of all files."""
    right = [case.name for case in SOUND if rows(case).defaults.word == "right"]
    assert len(right) >= LEAST, right
