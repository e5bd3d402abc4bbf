"""Given points come back to their printed digits, and the losses of a form are told at export."""

from __future__ import annotations

import os

import pytest

from tests.round_trips import FORMS, HULLS, SECTIONS, SOLIDS, SPLINES, TABLES, round_trips

LONG = bool(os.environ.get("ASSOC_HULL_LONG"))


def test_the_wigley_hull_comes_back_from_tables_and_sections() -> None:
    """With both plumb ends, which sections alone hold as sections of no breadth."""
    for each in round_trips(["wigley"], ["csv", "britfair", "delftship"]):
        print(each)
        assert each.farthest <= each.limit * (1.0 + 1e-6)
        assert abs(each.volume) <= 5e-4
        assert each.verdict == "sound"
        assert ("end post" in each.told) == (each.form in SECTIONS)
        assert "boundary" in each.told


NOT_BACK = {"step": ("yacht", "seaking_ship", "prelikon_ship"), "stl": ("yacht", "sfolds_ship")}
"""Solids that are refused at import today, with the place."""


def test_the_surface_of_a_file_of_rhino_is_a_sound_hull_by_itself() -> None:
    """Triangles at the foot of the stem do not lie in the centre plane: waterlines reach it."""
    [found] = round_trips(["wigley"], ["3dm-surface"])
    print(found)
    assert found.verdict.startswith("sound")
    assert abs(found.volume) <= 5e-4
    assert found.farthest <= found.limit


def test_sections_that_part_are_told_at_export_and_at_import() -> None:
    """Where a bulb ends between two sections no form of sections can say: the hull is open."""
    [found] = round_trips(["container_ship_225m"], ["britfair"])
    print(found)
    assert "parting" in found.told
    assert "ST 222.1875, ST 225: between two sections they do not close" in found.verdict


@pytest.mark.skipif(not LONG, reason="takes minutes: set ASSOC_HULL_LONG=1")
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
