"""A hull file outlives the death of its writer at any instant; see `tests.kills`."""

from pathlib import Path

from tests.kills import run


def test_nothing_committed_is_lost_when_the_writer_is_killed(tmp_path: Path) -> None:
    """I8: a few kills here, a thousand by `python -m tests.kills --count 1000`."""
    tally = run(12, 7, tmp_path)
    assert tally.kills == 12
    assert tally.reported > 5
    assert (tally.found, tally.lost, tally.faults) == (tally.reported, 0, [])
