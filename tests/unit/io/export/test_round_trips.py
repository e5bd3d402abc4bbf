"""Given points come back to their printed digits, and the losses of a form are told at export."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import assoc_hull as ah
from assoc_hull.errors import NotSoundError
from tests.long_forms import long_form
from tests.round_trips import (
    FORMS,
    HULLS,
    SECTIONS,
    SOLIDS,
    SPLINES,
    TABLES,
    round_trip,
    round_trips,
)


def test_the_wigley_hull_comes_back_from_tables_and_sections(tmp_path: Path) -> None:
    """With both plumb ends, which sections alone hold as sections of no breadth."""
    hull = ah.examples.wigley(stations=9, waterlines=5)
    for form in ("csv", "britfair", "delftship"):
        each = round_trip("wigley", hull, form, tmp_path)
        print(each)
        assert each.farthest <= each.limit * (1.0 + 1e-6)
        assert abs(each.volume) <= 5e-4
        assert each.verdict == "sound"
        assert ("end post" in each.told) == (each.form in SECTIONS)
        assert "boundary" in each.told


NOT_BACK = {"step": ("yacht", "seaking_ship", "prelikon_ship"), "stl": ("yacht", "sfolds_ship")}
"""Solids that are refused at import today, with the place."""


def test_the_surface_of_a_file_of_rhino_is_a_sound_hull_by_itself(tmp_path: Path) -> None:
    """Triangles at the foot of the stem do not lie in the centre plane: waterlines reach it."""
    cuts = {"stations": 15, "waterlines": 8, "buttocks": 1}
    found = round_trip("wigley", ah.examples.wigley(), "3dm-surface", tmp_path, **cuts)
    print(found)
    assert found.verdict.startswith("sound")
    assert abs(found.volume) <= 5e-4
    assert found.farthest <= found.limit


def test_sections_that_part_are_told_at_export_and_at_import(
    shipped: Callable[[str], ah.Hull], tmp_path: Path
) -> None:
    """Where a bulb ends between two sections no form of sections can say: the hull is open."""
    hull = shipped("container_ship_225m")
    report = hull.export(tmp_path / "ship.bri", "britfair")
    assert any(note.kind == "parting" for note in (*report.left_out, *report.mended))
    ship = hull.particulars
    given: dict[str, Any] = {
        "length": ship.length,
        "draught": ship.draught,
        "deck": ship.deck,
        "ap": "0 m",
    }
    with pytest.raises(NotSoundError) as refused:
        ah.read(tmp_path / "ship.bri", **given)
    told = "ST 222.1875, ST 225: between two sections they do not close"
    assert any(told in each for each in refused.value.findings)


@long_form
@pytest.mark.parametrize("name", HULLS)
def test_each_hull_comes_back_from_each_form(name: str) -> None:
    """Within what the form allows for; what it cannot hold is in the report of the export."""
    for each in round_trips([name], FORMS):
        print(each)
        if each.form == "step" and each.verdict.startswith("not written: not sound"):
            assert "centre plane" in each.verdict  # the halves of two ships cross at the stern
            continue
        assert each.farthest <= each.limit * (1.0 + 1e-6)
        if each.form in SPLINES:
            assert each.same == "0 new inflections, all else the same"
        elif each.form not in SOLIDS:
            assert "boundary" in each.told
            assert each.form in (*TABLES, "delftship-offsets") or "lines" in each.told
        elif name not in NOT_BACK.get(each.form, ()):
            assert not each.verdict.startswith("refused")
            assert abs(each.volume) <= 5e-4
