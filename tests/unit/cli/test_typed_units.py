"""Lengths may be typed with their unit, wherever a length is typed."""

from __future__ import annotations

import argparse
from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.cli import main
from assoc_hull.cli.arguments import metres, parse_pairs
from assoc_hull.cli.typed_edits import typed_edit
from tests.unit.cli.conftest import Json


@pytest.mark.parametrize(
    ("text", "wanted"),
    [("18", 18.0), ("18m", 18.0), ("-12.5 m", -12.5), ("6mm", 0.006), ("1.2e3", 1200.0)],
)
def test_a_length_of_either_sign_may_have_a_unit(text: str, wanted: float) -> None:
    """Without one it is in metres."""
    assert metres(text) == wanted


@pytest.mark.parametrize("text", ["18 ft", "m", "--3m", "abc"])
def test_another_unit_is_refused(text: str) -> None:
    """By the parser of arguments."""
    with pytest.raises(argparse.ArgumentTypeError, match="no length in mm, cm or m"):
        metres(text)


def test_values_that_are_set_may_have_a_unit_where_they_are_lengths() -> None:
    """An angle has none, and an output is no length."""
    assert parse_pairs(["breadth=14.5m", "bulb_height=200 mm"], "set") == {
        "breadth": 14.5, "bulb_height": 0.2,
    }  # fmt: skip
    assert parse_pairs(["run_deg=3m"], "set") == {"run_deg": "3m"}
    assert parse_pairs(["volume=3m"], "reach") == {"volume": "3m"}


def test_a_unit_behind_a_blank_belongs_to_the_number_before_it() -> None:
    """And is no value of its own."""
    wanted = typed_edit("pull", ["ST 7 x WL 2.5", "20mm"])
    assert typed_edit("pull", ["ST 7 x WL 2.5", "20", "mm"]) == wanted


def test_draughts_and_values_with_units_reach_the_hull(tmp_path: Path, facts: Json) -> None:
    """As those in metres do."""
    path = tmp_path / "ship.hull"
    ah.examples.wigley().save(path)
    with_unit = facts("hydrostatics", path, "--draught", "5m")
    assert with_unit == facts("hydrostatics", path, "--draught", "5")
    assert main(["vary", str(path), "breadth=10.5m"]) == 0
    assert ah.open(path).particulars.breadth == pytest.approx(10.5)


@pytest.mark.parametrize(
    ("typed", "told"),
    [
        ("breadth=18,5", "'18,5' is no number; give one in m, or one with mm, cm or m behind it"),
        ("breadth=59ft", "'59ft' is no number; give one in m, or one with mm, cm or m behind it"),
        ("run_deg=3m", "'3m' is no number; give one without a unit"),
    ],
    ids=["a decimal comma", "feet", "degrees in metres"],
)
def test_a_value_that_is_no_number_is_told_how_to_be_typed(
    typed: str, told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """A shell has no quotes to leave out."""
    assert main(["vary", "never.hull", typed]) == 2
    assert told in capsys.readouterr().err


def test_blanks_around_the_sign_of_a_value_are_told(capsys: pytest.CaptureFixture[str]) -> None:
    """They part one word of the command into three."""
    assert main(["vary", "never.hull", "breadth", "=", "18"]) == 2
    assert "write NAME=VALUE without blanks" in capsys.readouterr().err
