"""Limits with fair lines, and hulls that no one would take."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.cli import main
from assoc_hull.errors import FoldError, RefusedEditError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.carrying.admissible_values import list_parameters
from assoc_hull.variation.comparing.line_fairness import ImagedLines, comb_within, measure_fairness
from assoc_hull.variation.parameters.value_limits import fair_end
from tests.long_forms import long_form

FAR = {"draught": 15.4, "breadth": 90.0}
"""Within the interval in which nothing folds, and far beyond what any ship is."""


@pytest.mark.parametrize("name", list(FAR))
def test_at_both_fair_ends_no_line_is_told_to_be_less_fair(name: str, series60_70: ah.Hull) -> None:
    """The list tells them apart from the ends at which the map folds, and they lie within."""
    found = {each.name: each for each in list_parameters(series60_70.state, limits=[name])}[name]
    assert found.low is not None
    assert found.fair_low is not None
    assert found.fair_high is not None
    assert found.low < found.fair_low < 0.9 * (found.value or 0.0)
    assert 1.1 * (found.value or math.inf) < found.fair_high < (found.high or math.inf)
    for value in (found.fair_low, found.fair_high):
        notes = series60_70.vary(set={name: value}).report.notes
        assert not [note for note in notes if note.startswith("lines less fair")]


@pytest.mark.parametrize("name", list(FAR))
def test_a_hull_that_no_one_would_take_is_refused_with_what_may_be_asked(
    name: str, series60_70: ah.Hull
) -> None:
    """Following the message works, and accept=True takes the hull, also of a script."""
    with pytest.raises(RefusedEditError) as caught:
        series60_70.vary(set={name: FAR[name]})
    told = re.search(rf"ask for {name} from ([\d.]+) to ([\d.]+) m, where", str(caught.value))
    assert told is not None
    assert "accept=True (--accept)" in str(caught.value)
    assert series60_70.vary(set={name: float(told[2])}).report.targets[0].reached == float(told[2])
    taken = series60_70.vary(set={name: FAR[name]}, accept=True)
    assert taken.report.targets[0].reached == pytest.approx(FAR[name], abs=1e-6)
    assert [note for note in taken.report.notes if note.startswith("lines less fair")]
    assert taken.report.script is not None
    again = series60_70.vary_by(taken.report.script)
    assert again.hull.fingerprint == taken.hull.fingerprint


def test_the_command_refuses_with_code_1_and_takes_with_accept(
    tmp_path: Path, series60_70: ah.Hull, capsys: pytest.CaptureFixture[str]
) -> None:
    """A refused hull is not written; one that is taken prints which lines are less fair."""
    ship, deep = tmp_path / "ship.hull", tmp_path / "deep.hull"
    series60_70.save(ship)
    command = ["vary", str(ship), "draught=15.4", "-o", str(deep)]
    assert main(command) == 1
    assert "where lines stay fair, or take the hull as it is" in capsys.readouterr().out
    assert not deep.exists()
    assert main([*command, "--accept"]) == 0
    assert "lines less fair than those of the parent" in capsys.readouterr().out
    assert deep.exists()


def test_a_fold_is_told_with_the_ends_between_which_lines_are_fair(series60_70: ah.Hull) -> None:
    """In words, and beside those at which nothing folds."""
    with pytest.raises(FoldError) as caught:
        series60_70.vary(set={"draught": 17.0})
    text = str(caught.value)
    assert "(heights come out -" in text
    assert caught.value.interval is not None
    assert caught.value.fair is not None
    assert caught.value.interval[0] < caught.value.fair[0]
    assert caught.value.fair[1] < caught.value.interval[1]
    assert f"with fair lines from {math.ceil(1e3 * caught.value.fair[0]) / 1e3:g} to" in text


def test_images_of_lines_tell_what_a_map_does_to_them(series60_70: ah.Hull) -> None:
    """Nothing where nothing moves; a wave of the frames at every level where there is one."""
    images = ImagedLines.of(series60_70.state)
    assert images.compared(lambda xyz: xyz).unfairness == ()

    def waved(xyz: FloatArray) -> FloatArray:
        moved = 0.2 * np.sin(2.5 * xyz[:, 2])
        return np.column_stack([xyz[:, 0], xyz[:, 1] + moved, xyz[:, 2]])

    times = {line.name: each for line, each in images.compared(waved).unfairness}
    assert times["ST 15"] > 10.0
    assert times["WL 1"] < 1.5


@pytest.mark.parametrize(("now", "end"), [(1.0, math.inf), (1.0, 50.0), (-1.0, -math.inf)])
def test_a_fair_end_is_the_last_value_that_is_fair(now: float, end: float) -> None:
    """Sought to a few percent; an end that is fair itself is the end."""
    found = fair_end(lambda value: 2.0 * math.log(abs(value)), now, end)
    assert 0.95 * 2.0 < abs(found) <= 2.0
    assert fair_end(lambda value: 0.0, now, end) == end


@pytest.mark.parametrize(("off", "seen"), [(1e-4, False), (3e-2, True)])
def test_a_bend_between_points_close_together_counts_where_it_leaves_the_tolerance(
    off: float, seen: bool
) -> None:
    """20 mm beside a point a tenth of a millimetre makes a comb that 30 mm make, seen by nobody."""
    hull = ah.examples.wigley()
    state = hull.document.state
    [curve] = hull.groups["waterlines"].lines["WL 2.5"].curves
    before = measure_fairness(state)
    line = next(each for each in before.values() if each.name == "WL 2.5")
    beside = curve.points[len(curve.points) // 2].position + np.array([0.02, off, 0.0])
    with hull.edit("a point close to another") as edit:
        edit.insert(curve, beside, lead=False)
    after = measure_fairness(hull.document.state, like=before)[line.key]
    assert after.comb > 100.0 * line.comb
    within = comb_within(hull.document.state, after, hull.document.state.tolerances.adoption)
    assert (within > 100.0 * line.comb) is seen
    assert within <= after.comb


@long_form
def test_a_section_that_is_fair_within_the_tolerance_is_no_reason_to_refuse(dtc: ah.Hull) -> None:
    """The end of the flat comes 18 mm beside a buttock: a comb 280 times the parent's."""
    values = {
        "bulb_half_breadth": 3.56557, "parallel_body_start": 165.784, "sheer_fore": 0.0,
        "transom_half_breadth": 26.575, "parallel_body_end": 179.097, "flat_of_bottom": 20.2599,
    }  # fmt: skip
    report = dtc.vary(set=values).report
    assert any("ST 165.14 (28" in note for note in report.notes)
