"""The demo does the main job on Series 60, and leaves the hull as it was."""

import json
from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.cli import demo, main

NAMES = [
    "after.hull.json",
    "before.hull.json",
    "body-plan-before-after.png",
    "lines-after.pdf",
    "lines-after.png",
    "lines-before.pdf",
    "lines-before.png",
    "lines-created.png",
    "ship.hull",
]


@pytest.mark.slow
def test_the_demo_ends_where_it_began(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Equal fingerprints, no finding, points where they were asked to be, pictures written."""
    pytest.importorskip("matplotlib")
    assert main(["demo", "--out", str(tmp_path / "a" / "b"), "--json"]) == 0
    facts = json.loads(capsys.readouterr().out)
    prints = facts["fingerprint"]
    assert prints["start"] == prints["undone"] != prints["edited"]
    assert (facts["findings"], facts["differences"]) == ([], [])
    assert facts["largest_gap"] < 6e-3
    for edit in facts["edits"]:
        assert edit["reached"] == pytest.approx(edit["asked"], abs=1e-9, rel=0.01)
        assert len(edit["report"]["relofted"]) >= 10
    assert facts["created"]["cb"] == pytest.approx(0.70, abs=1e-6)
    assert facts["why"]["name"] == "WL 0.42"
    _chain_ends_at_the_edit(facts["why"])
    folder = tmp_path / "a" / "b"
    assert sorted(path.name for path in folder.iterdir()) == NAMES
    assert all(path.stat().st_size > 10_000 for path in folder.iterdir())
    assert ah.open(folder / "before.hull.json").fingerprint == prints["start"]
    assert ah.open(folder / "after.hull.json").fingerprint == prints["edited"]
    ship = ah.open(folder / "ship.hull")
    assert ship.fingerprint == prints["start"]
    assert [report.name for report in ship.undone[::-1]] == facts["history"]
    ship.redo(len(ship.undone))
    assert ship.fingerprint == prints["edited"]
    ship.close()


def _chain_ends_at_the_edit(cause: dict[str, object]) -> None:
    while cause["causes"]:
        causes = cause["causes"]
        assert isinstance(causes, list)
        cause = causes[0]
    assert (cause["name"], cause["what"]) == ("BTK 0.68 x ST 4", "set by the edit")


@pytest.mark.slow
def test_the_demo_tells_what_it_does(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each step in words; without a library to draw with it says so and does the rest."""
    monkeypatch.setattr(demo, "find_spec", lambda name: None)
    told: list[str] = []
    assert demo.Demo(tmp_path, told.append).run()
    text = "\n".join(told)
    for part in (
        "rounding: +-4.4 mm at waterlines 0.5, 0.75, 1, 1.25, 1.5 T",
        "4 boundary, 41 sections, 20 waterlines, 12 buttocks",
        "2. drag WL 0.5 x ST 16 by 5 mm",
        "why WL 0.42 followed",
        "0 findings",
        "ship.hull, closed and opened again",
        "the hull is as it was, to the last bit",
        "pip install 'assoc-hull[plot]'",
    ):
        assert part in text
    assert sorted(path.name for path in tmp_path.iterdir()) == [*NAMES[:2], NAMES[-1]]
