"""Variants as a designer has them: one step that is undone, kept, and repeated by a script."""

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import assoc_hull as ah
from assoc_hull.errors import AssocHullError
from assoc_hull.variation.fields.anchor_fields import hat_field
from assoc_hull.variation.fields.bounded_functions import BlendChain
from assoc_hull.variation.fields.layers import FieldLayer

SCRIPT: dict[str, Any] = {
    "version": 1,
    "name": "more beam",
    "set": {"breadth": 10.6, "draught": 6.6},
    "layout": {"draught_top": 1.4},
    "layers": [
        [{"hat": {"name": "stern", "along": {"x": [10, 40], "v": [1, 0]},
                  "anchors": [["keel", 0, 0.25], ["T", 6, 0]]}}],
    ],
    "drivers": ["sections"],
    "tolerance": 0.004,
}  # fmt: skip
"""All that a script may hold."""

REPEAT = """
import json, sys
import assoc_hull as ah
parent, script = ah.open(sys.argv[1]), sys.argv[2]
given = json.load(open(script))
del given["version"]
given["set"] = dict(reversed(given["set"].items()))
print(parent.vary_by(script).hull.fingerprint, parent.vary(**given).hull.fingerprint)
"""


@pytest.fixture(scope="module")
def parent(shipped: Callable[[str], ah.Hull]) -> ah.Hull:
    """The hull that is varied; nothing here changes it."""
    return shipped("wigley")


@pytest.fixture(scope="module")
def variant(parent: ah.Hull) -> ah.Hull:
    """Its variant by the script."""
    return parent.vary_by(SCRIPT).hull


def test_a_script_gives_the_same_hull_in_either_form_and_in_another_process(
    parent: ah.Hull, variant: ah.Hull, tmp_path: Path
) -> None:
    """To the last bit: as data, as a file, as a call; whatever the order of what it holds."""
    hull, script = tmp_path / "parent.hull.json", tmp_path / "more_beam.json"
    parent.save(hull)
    parent.detach()
    script.write_text(json.dumps(SCRIPT))
    command = [sys.executable, "-c", REPEAT, str(hull), str(script)]
    other = {**os.environ, "PYTHONHASHSEED": "4711"}
    run = subprocess.run(command, capture_output=True, text=True, check=True, env=other)
    assert run.stdout.split() == [variant.fingerprint] * 2


def test_a_report_repeats_its_variation(parent: ah.Hull, variant: ah.Hull) -> None:
    """What was asked for, defaults included, goes through JSON and gives the same hull."""
    report = parent.vary_by(SCRIPT).report
    assert report.script is not None
    kept = json.loads(json.dumps(dict(report.script)))
    assert kept == {**SCRIPT, "stations": "number", "planes": "follow"}
    assert parent.vary_by(kept).hull.fingerprint == variant.fingerprint


def test_layers_that_are_no_data_leave_no_script(parent: ah.Hull) -> None:
    """A program made them; the report does not pretend that a file can."""
    lifted = hat_field("keel", [("keel", 0.0, 0.2), ("T", 6.0, 0.0)], BlendChain.constant(1.0))
    report = parent.vary(layers=[FieldLayer("lifted", (lifted,))]).report
    assert report.script is None
    assert report.edit.name == "vary by fields"


FILES = {
    "no file": (None, "check name and place"),
    "a broken one": ('{"set": {"breadth": 11', "is no JSON"),
    "one without an end": ("[" * 100_000, "is no JSON"),
    "bytes that are no text": (b"\xff\xfe{", "is no JSON"),
    "a list": ('[{"set": {}}]', "holds a list"),
    "an empty object": ("{}", "nothing is asked for"),
    "a key twice": ('{"set": {"breadth": 11, "breadth": 12}}', "'breadth' is given twice"),
    "an unknown key": ('{"sett": {"breadth": 11}}', "the nearest names are 'set'"),
    "not a number": ('{"set": {"breadth": NaN}}', "breadth is nan"),
    "another version": ('{"version": 2, "set": {"breadth": 11}}', "give version 1"),
    "a version in words": ('{"version": "one", "set": {"breadth": 11}}', "version 'one'"),
    "a set in words": ('{"set": "breadth"}', "set is str"),
    "no layers": ('{"layers": null, "set": {"breadth": 11}}', "layers is NoneType"),
    "drivers as a number": ('{"set": {"breadth": 11}, "drivers": 3}', "drivers is int"),
}


@pytest.mark.parametrize("case", FILES)
def test_a_bad_script_is_told_in_one_line(parent: ah.Hull, tmp_path: Path, case: str) -> None:
    """An error of the family; the hull has not changed."""
    text, says = FILES[case]
    script, before = tmp_path / "script.json", parent.fingerprint
    if text is not None:
        script.write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(AssocHullError) as found:
        parent.vary_by(script, in_place=True)
    assert says in str(found.value)
    assert "\n" not in str(found.value)
    assert (parent.fingerprint, parent.history) == (before, ())


def test_values_that_a_hull_has_change_nothing(bulk_carrier: ah.Hull) -> None:
    """All that is measured, asked for again: no step, no point moved, every target met."""
    apart = ("bilge_radius", "bulb_area", "deadrise_deg", "deck_height", "parallel_body_length")
    now = {name: value for name, value in bulk_carrier.measure().items() if name not in apart}
    before = bulk_carrier.fingerprint
    found = bulk_carrier.vary(set=now, in_place=True)
    assert (bulk_carrier.fingerprint, bulk_carrier.history) == (before, ())
    assert not found.report.edit.changed
    assert found.map.layers == ()
    assert [each.reached for each in found.report.targets] == pytest.approx(list(now.values()))


def test_a_variation_is_one_step(shipped: Callable[[str], ah.Hull], variant: ah.Hull) -> None:
    """Undo gives the parent back to the bit, redo the variant."""
    hull = shipped("wigley")
    before, particulars = hull.fingerprint, hull.particulars
    found = hull.vary_by(SCRIPT, ship=variant.particulars.name, in_place=True)
    assert found.hull is hull
    assert [step.name for step in hull.history] == ["more beam"]
    assert hull.fingerprint == variant.fingerprint
    assert hull.particulars.breadth == 10.6
    hull.undo()
    assert (hull.fingerprint, hull.particulars) == (before, particulars)
    hull.redo()
    assert hull.fingerprint == variant.fingerprint


def test_a_copy_is_varied_unless_it_is_said(parent: ah.Hull, variant: ah.Hull) -> None:
    """The parent has no step and keeps its bits; the variant has one, and can go back to it."""
    assert parent.history == ()
    assert parent.fingerprint != variant.fingerprint
    variant.undo()
    assert variant.fingerprint == parent.fingerprint
    variant.redo()


@pytest.mark.parametrize("ending", [".hull", ".hull.json"])
def test_a_variant_is_kept_in_its_file(
    parent: ah.Hull, variant: ah.Hull, tmp_path: Path, ending: str
) -> None:
    """Opened again it is the same and measures the same; a hull file can still undo it."""
    path = tmp_path / f"variant{ending}"
    variant.save(path)
    variant.detach()
    opened = ah.open(path)
    assert opened.fingerprint == variant.fingerprint
    assert dict(opened.measure()) == dict(variant.measure())
    if ending == ".hull":
        opened.undo()
        assert opened.fingerprint == parent.fingerprint
    opened.close()


def test_sections_that_were_bent_are_told_where_they_cannot_serve(parent: ah.Hull) -> None:
    """Named as drivers, they become curves in space; what needs planes across the ship says so.

    What is measured on single lines is there still.
    """
    bent = parent.vary(set={"stem_rake_deg": 4.0}, drivers=["sections"]).hull
    found = bent.measure()
    assert found["stem_rake_deg"] == pytest.approx(4.0, abs=1e-6)
    with pytest.raises(AssocHullError, match="is a curve in space"):
        bent.hydrostatics()


def test_a_variant_has_a_name_of_her_own() -> None:
    """Her parent's with what was asked for; undo takes it back, in place it stays."""
    parent = ah.examples.wigley(stations=5, waterlines=4)
    variant = parent.vary(set={"breadth": 11.0}).hull
    assert variant.particulars.name == "Wigley, breadth=11"
    assert parent.particulars.name == "Wigley"
    assert not variant.verify()
    variant.undo()
    assert variant.fingerprint == parent.fingerprint
    variant.redo()
    assert variant.particulars.name == "Wigley, breadth=11"
    assert parent.vary(set={"breadth": 11.0}, ship="B").hull.particulars.name == "B"
    assert parent.vary(set={"breadth": 10.0}).hull.fingerprint == parent.fingerprint
    parent.vary(set={"breadth": 11.0}, in_place=True)
    assert parent.particulars.name == "Wigley"
