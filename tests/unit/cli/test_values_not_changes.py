"""A value that looks like a change is refused where a value is asked for."""

from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.cli import main


def test_a_plus_before_a_value_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """``breadth=+1`` of a ship of 10 m would make her 1 m broad."""
    path = tmp_path / "wigley.hull.json"
    ah.examples.wigley(stations=11, waterlines=6).save(str(path))
    assert main(["vary", str(path), "breadth=+1", "-o", str(tmp_path / "new.hull.json")]) == 2
    assert "takes the new value itself, not a change" in capsys.readouterr().err
