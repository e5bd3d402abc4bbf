"""What earlier variations set, reached and spent is told later, and by the hull itself."""

from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.hull.variants import Variation

FREE = ["breadth", "fore_shift", "aft_shift"]


@pytest.fixture(scope="module")
def reached() -> Variation[ah.Hull]:
    """A hull of which volume and LCB were reached."""
    parent = ah.examples.series60(0.70)
    now = parent.hydrostatics(estimate=False)
    return parent.vary(reach={"volume": 1.01 * now.volume, "lcb": now.lcb + 0.2}, free=FREE)


def notes_about(varied: Variation[ah.Hull], word: str) -> list[str]:
    """Give the notes of a report that begin with a word."""
    return [note for note in varied.report.notes if note.startswith(word)]


def test_a_value_that_was_reached_and_left_is_told_with_what_would_hold_it(
    reached: Variation[ah.Hull],
) -> None:
    """And what is told holds it."""
    varied = reached.hull.vary(set={"draught": 7.0})
    (note,) = notes_about(varied, "volume was reached")
    assert "now +" in note
    assert "reach={'volume': " in note
    target = float(note.partition("reach={'volume': ")[2].partition("}")[0])
    held = reached.hull.vary(
        set={"draught": 7.0}, reach={"volume": target}, free=["fore_shift", "aft_shift"]
    )
    assert held.hull.hydrostatics(estimate=False).volume == pytest.approx(target, rel=1e-8)
    assert not notes_about(held, "volume")
    assert notes_about(held, "lcb was reached")


def test_a_value_that_was_set_and_is_held_is_not_told(reached: Variation[ah.Hull]) -> None:
    """Length leaves the draught, and what is set anew was meant."""
    hull = reached.hull.vary(set={"draught": 7.0}).hull
    assert not notes_about(hull.vary(set={"length": 122.5}), "draught")
    assert not notes_about(hull.vary(set={"draught": 7.1}), "draught")


def test_what_was_spent_is_told_by_the_hull_and_its_copies_and_its_file(
    reached: Variation[ah.Hull], tmp_path: Path
) -> None:
    """Shifts show in no line; an undone variation has spent nothing."""
    assert reached.report.aim is not None
    told = dict(zip(reached.report.aim.free, reached.report.aim.amplitudes.tolist(), strict=True))
    hull = reached.hull
    assert dict(hull.measure(only=["breadth"]).spent) == told
    again = hull.vary(set={"fore_shift": 0.3}).hull
    spent = again.measure(only=["breadth"]).spent
    assert spent["fore_shift"] == told["fore_shift"] + 0.3
    assert spent["aft_shift"] == told["aft_shift"]
    assert "spent by variations" in repr(again.measure(only=["breadth"]))
    again.save(tmp_path / "ship.hull")
    reopened = ah.open(tmp_path / "ship.hull")
    assert reopened.measure(only=["breadth"]).spent == spent
    hull.undo()
    assert not hull.measure(only=["breadth"]).spent
    hull.redo()


def test_a_comparison_warns_of_lines_that_are_less_fair(reached: Variation[ah.Hull]) -> None:
    """By name; of a hull with itself there are none."""
    parent = ah.examples.bulk_carrier_207k()
    varied = parent.vary(set={"shaft_height": 5.5}).hull
    found = parent.compare(varied)
    assert [line.name for line in found.less_fair if line.added > 0] != []
    worst = found.less_fair[0].name
    assert f"less fair than in the parent\n  {worst}: " in str(found)
    assert reached.hull.compare(reached.hull).less_fair == ()


def test_what_is_told_to_hold_a_value_is_taken(reached: Variation[ah.Hull]) -> None:
    """Beside one that is the same number nothing does; what is set is not told to be free."""
    depth = reached.hull.particulars.depth
    hull = reached.hull.vary(set={"depth": depth + 0.1}).hull
    (note,) = notes_about(hull.vary(set={"deck_height": depth + 0.3}), "depth")
    assert note.endswith("nothing holds it beside deck_height")
    volume = reached.hull.hydrostatics(estimate=False).volume
    heavier = {"displacement": 1.01 * 1.025 * volume}
    (note,) = notes_about(reached.hull.vary(reach=heavier, free=FREE[:1]), "volume")
    assert note.endswith("nothing holds it beside displacement")
    (note,) = notes_about(reached.hull.vary(set={"fore_shift": 0.5}), "volume")
    assert note.endswith('free=["aft_shift", "breadth"] would hold it')
    wider = reached.hull.vary(set={"breadth": 17.6}).hull
    (note,) = notes_about(wider.vary(reach={"kmt": 7.3}, free=["breadth"]), "breadth")
    assert note.endswith("with something else free in its place would hold it")


def test_a_hull_of_a_study_tells_what_variations_have_spent(reached: Variation[ah.Hull]) -> None:
    """Those of the parent, and its own; and what it set is told when it is left."""
    hull = reached.hull.vary(set={"fore_shift": 0.3}).hull
    before = hull.measure(only=["breadth"]).spent
    made = hull.study(set={"fore_shift": [0.1], "draught": 7.0}, outputs=["volume"]).hull(0)
    spent = made.measure(only=["breadth"]).spent
    assert spent["fore_shift"] == before["fore_shift"] + 0.1
    assert spent["aft_shift"] == before["aft_shift"]
    assert notes_about(made.vary(set={"draught": 7.1}), "volume was reached before")
    (note,) = notes_about(made.vary(reach={"kb": 3.9}, free=["draught"]), "draught was set")
    assert "(7)" in note
    made.undo()
    assert made.measure(only=["breadth"]).spent == before


def test_what_was_spent_before_a_copy_is_told_of_its_file_after_undo(
    reached: Variation[ah.Hull], tmp_path: Path
) -> None:
    """And on another branch, and after that is opened again."""
    before = reached.hull.measure(only=["breadth"]).spent
    reached.hull.vary(set={"fore_shift": 0.2}).hull.save(tmp_path / "ship.hull")
    hull = ah.open(tmp_path / "ship.hull")
    hull.undo()
    assert hull.measure(only=["breadth"]).spent == before
    hull.close()
    hull = ah.open(tmp_path / "ship.hull")
    assert hull.measure(only=["breadth"]).spent == before
    hull.vary(set={"draught": 7.0}, in_place=True)
    hull.undo()
    assert hull.measure(only=["breadth"]).spent == before
    hull.close()
