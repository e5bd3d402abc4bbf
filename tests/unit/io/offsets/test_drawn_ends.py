"""What a table without ends is told about the ends that are drawn."""

from pathlib import Path

from tests.trawler import TABLE, trawler


def test_a_stern_drawn_beyond_the_table_is_an_assumption(tmp_path: Path) -> None:
    """How far, where, why, and how to choose otherwise; the advice followed, nothing is said."""
    notes = trawler(tmp_path).adoption.notes  # type: ignore[union-attr]
    (stern,) = [note for note in notes if note.startswith("assumed: stern:")]
    assert "up to 3.4 m (0.1 Lpp) abaft it" in stern
    assert "one more station aft with 0 where they end" in stern
    zeros = "-0.3" + 9 * ";0"
    closed = TABLE.replace("\n0;50", f"\n{zeros}\n0;50")
    after = trawler(tmp_path, closed).adoption.notes  # type: ignore[union-attr]
    assert not [note for note in after if note.startswith("assumed: stern:")]


def test_a_raked_stem_is_told_too(tmp_path: Path) -> None:
    """The last station has breadth above the water: the stem is drawn on as well."""
    notes = trawler(tmp_path).adoption.notes  # type: ignore[union-attr]
    (stem,) = [note for note in notes if note.startswith("assumed: stem:")]
    assert "forward of it, at z = 4.6 m" in stem


def test_no_note_names_a_line_by_its_key(tmp_path: Path) -> None:
    """A crossing that is left out is named as people name it."""
    notes = trawler(tmp_path).adoption.notes  # type: ignore[union-attr]
    (left,) = [note for note in notes if note.startswith("profile x") or "x profile" in note]
    assert left == "ST 10 x profile: not reached, left out"
