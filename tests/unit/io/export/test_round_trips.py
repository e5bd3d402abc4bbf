"""Given points come back to their printed digits, and the losses of a form are told at export."""

from __future__ import annotations

import os

import pytest

from tests.round_trips import FORMS, HULLS, SECTIONS, TABLES, round_trips

LONG = bool(os.environ.get("ASSOC_HULL_LONG"))


def test_the_wigley_hull_comes_back_from_tables_and_sections() -> None:
    """With both plumb ends, which sections alone hold as sections of no breadth."""
    for each in round_trips(["wigley"], ["csv", "britfair", "delftship"]):
        print(each)
        assert each.farthest <= each.digit * (1.0 + 1e-6)
        assert abs(each.volume) <= 5e-4
        assert each.verdict == "verdict: sound"
        assert ("end post" in each.told) == (each.form in SECTIONS)
        assert "boundary" in each.told


@pytest.mark.skipif(not LONG, reason="takes minutes: set ASSOC_HULL_LONG=1")
@pytest.mark.parametrize("name", HULLS)
def test_each_hull_comes_back_from_each_form(name: str) -> None:
    """Points to their digits; what the form cannot hold is in the report of the export."""
    for each in round_trips([name], FORMS):
        print(each)
        assert each.farthest <= each.digit * (1.0 + 1e-6)
        assert "boundary" in each.told
        assert each.form in (*TABLES, "delftship-offsets") or "lines" in each.told
