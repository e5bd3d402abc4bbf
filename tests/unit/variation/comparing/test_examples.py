"""What the parts of `variation.comparing` give, one small example of each."""

from __future__ import annotations

import json

import pytest

import assoc_hull as ah


def test_a_parent_and_a_variant_of_it_side() -> None:
    """A parent and a variant of it side by side: lines, numbers, fairness, points, features."""
    parent = ah.examples.wigley()
    variant = parent.vary(set={"breadth": 11.0}).hull
    found = parent.compare(variant)
    line = found.line("WL 6.25")
    assert line.shift is not None
    assert (line.shift.direction, round(line.shift.length, 6)) == ("out", 0.5)
    percent = found.hydrostatic("volume").percent
    assert percent is not None
    assert round(percent, 6) == pytest.approx(10.0, abs=0.1)


def test_a_comparison_of_two_hulls_as_json_its_schema() -> None:
    """A comparison of two hulls as JSON. Its schema is `assoc_hull.io.tables.comparison`."""
    hull = ah.examples.wigley()
    assert json.loads(hull.compare(hull).to_json())["lines"][0]["what"] == "same"
