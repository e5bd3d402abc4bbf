"""Fairness of a net: one batch for all lines, knuckles left out, gaps as offsets."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

import assoc_hull as ah
from assoc_hull.errors import BadInputError, GeometryError, UnknownNameError, WrongTypeError
from assoc_hull.fairing.line_fairness import FairnessTable
from assoc_hull.geometry.classical.chord_spline import ChordSpline
from assoc_hull.geometry.classical.circular_arcs import PlaneArcs
from assoc_hull.geometry.classical.elastica import fit_elastica
from assoc_hull.geometry.classical.truncated_power_spline import TruncatedPower
from assoc_hull.geometry.fairness.combs import comb_integrals


@pytest.fixture(scope="module")
def ship(shipped: Callable[[str], ah.Hull]) -> ah.Hull:
    """A published form with knuckles at the deck and watched crossings."""
    return shipped("series60_70")


@pytest.fixture(scope="module")
def table(ship: ah.Hull) -> FairnessTable:
    """All its curves."""
    found = ah.form.fairness(ship)
    assert isinstance(found, FairnessTable)
    return found


def test_every_curve_has_a_record(ship: ah.Hull, table: FairnessTable) -> None:
    """As many as the hull has curves, each with a length and one direction at its knots."""
    assert len(table) == len(ship.state.live("curves"))
    assert all(each.length > 0.0 for each in table)
    assert table.failures["first derivative"] == ()


def test_variation_is_the_comb_integral_without_unit(ship: ah.Hull, table: FairnessTable) -> None:
    """E3 of a plane line is L^3 times the integral that studies compare."""
    for line in ("WL 0.75", "ST 10"):
        handle = ship.lines[line]
        [record] = table[line]
        curve = handle.curves[0]
        normal = ship.state.lines.normal[handle.row]
        comb = comb_integrals(ship.state.spline(curve.row), normal)[0]
        assert record.variation == pytest.approx(record.length**3 * comb, rel=1e-9)


def test_a_line_and_a_curve_have_the_records_of_the_net(
    ship: ah.Hull, table: FairnessTable
) -> None:
    """The same numbers, whatever is asked for together."""
    line = ship.lines["WL 0.75"]
    for found in (ah.form.fairness(line), ah.form.fairness(line.curves[0])):
        assert tuple(found) == table["WL 0.75"]  # type: ignore[arg-type]
    assert tuple(ah.form.fairness(ship, lines=["WL 0.75"])) == table["WL 0.75"]  # type: ignore[arg-type]


def test_gaps_of_watched_crossings_are_offsets(ship: ah.Hull, table: FairnessTable) -> None:
    """Each crossing that defines neither line counts on both; all are within their limits."""
    state = ship.state
    watched = state.rows.alive.data & np.isfinite(state.rows.gap.data)
    assert sum(each.offsets for each in table) == 2 * int(watched.sum())
    worst = max(each.deviation_max or 0.0 for each in table)
    share = state.rows.gap[watched] / state.rows.limit[watched]
    assert worst == pytest.approx(share.max())
    assert table.failures["deviation"] == ()


def test_wanted_inflections_go_by_name(ship: ah.Hull, table: FairnessTable) -> None:
    """A line that wants as many as it has keeps the criterion; others want none."""
    [before] = table["WL 0.75"]
    assert before.inflections
    after = ah.form.fairness(ship, allowed={"WL 0.75": before.inflections})
    assert isinstance(after, FairnessTable)
    assert after["WL 0.75"][0].passed["inflections"] is True
    assert "WL 0.75" not in after.failures["inflections"]
    assert "WL 0.75" in table.failures["inflections"]


def test_a_knuckle_of_the_net_is_meant() -> None:
    """A chined hull bends at its knuckles: they are counted and no fault."""
    source = [
        ah.LineSource.make("waterlines", "WL 1", [(0, 0, 1), (5, 2, 1), (10, 2, 1)], kind=[0, 2, 0])
    ]
    hull = ah.Hull.from_lines(
        source, particulars=ah.Particulars("a", 10.0, 4.0, 2.0, 1.0), associations=[]
    )
    found = ah.form.fairness(hull)
    assert isinstance(found, FairnessTable)
    [record] = found["WL 1"]
    assert (record.knuckles, record.angle_jump, record.failed) == (1, 0.0, ())


def test_an_edit_is_judged_before_and_after() -> None:
    """A point pushed 30 mm: its own line bends more, lines far away are the same."""
    hull = ah.examples.wigley()
    before = ah.form.fairness(hull)
    assert isinstance(before, FairnessTable)
    with hull.edit("push") as edit:
        edit.move("WL 2.5 x ST 3", y=hull.points["WL 2.5 x ST 3"].y + 0.03)
    after = ah.form.fairness(hull)
    assert isinstance(after, FairnessTable)
    pairs = {pair.before.name: pair for pair in before.pairs(after)}
    for line in ("WL 2.5", "ST 3"):
        ratio = pairs[line].ratio("variation")
        assert ratio is not None
        assert ratio > 1.01
    assert not pairs["ST 15"].changed
    text = before.comparison(after)
    assert "WL 2.5" in text
    assert "curves are the same" in text
    assert before.compared(after)["curves"][0].keys() == {"before", "after", "ratios"}


CURVES: dict[str, Any] = {
    "chord spline": ChordSpline.through([(0, 0), (1, 0.2), (2, 0)]),
    "elastica": fit_elastica([0, 0], [1, 0], 0.3, -0.3),
    "arcs": PlaneArcs.make([(0, 0)], [0.0], [0.1], [3.0]),
    "truncated powers": TruncatedPower.through([0, 1, 2], [0, 0.2, 0]),
    "graph": CubicSpline([0, 1, 2], [0, 0.2, 0]),
}


@pytest.mark.parametrize("kind", CURVES)
def test_a_plane_curve_has_one_record(kind: str) -> None:
    """Classical curves and graphs, with offsets of their own."""
    record = ah.form.fairness(CURVES[kind], offsets=[(0.5, 0.1)], tolerances=0.2)
    assert not isinstance(record, FairnessTable)
    assert (record.name, record.offsets) == (kind, 1)
    assert record.deviation_max is not None


def test_the_table_prints_one_row_a_curve(table: FairnessTable) -> None:
    """A head, a row a curve, what is counted, how many lines are unfair, each place where."""
    lines = str(table).splitlines()
    assert len(lines) == 1 + len(table) + 1 + 2 + len(table.unfair)
    assert lines[0].split()[0] == "curve"
    assert "all changes of the sign" in lines[len(table) + 2]
    assert "unfair" in lines[len(table) + 3]


@pytest.mark.parametrize(
    ("call", "kind", "message"),
    [
        pytest.param({"lines": ["WL 77"]}, UnknownNameError, "WL 77", id="unknown line"),
        pytest.param({"lines": "WL 1"}, WrongTypeError, "give a list of names", id="one text"),
        pytest.param({"allowed": -1}, BadInputError, "allowed is -1", id="below nil"),
        pytest.param({"allowed": {"x": 1}}, UnknownNameError, "'x'", id="allowed on no line"),
        pytest.param({"offsets": [(0, 0)]}, BadInputError, "bring their offsets", id="offsets"),
    ],
)
def test_what_a_hull_cannot_answer_is_refused(
    ship: ah.Hull, call: dict[str, Any], kind: type[Exception], message: str
) -> None:
    """One line that says what to give."""
    with pytest.raises(kind, match=message):
        ah.form.fairness(ship, **call)


def test_what_is_no_curve_is_refused() -> None:
    """A number, a chain of no arcs, and offsets of another count."""
    with pytest.raises(WrongTypeError, match="no curve that can be looked at"):
        ah.form.fairness(3.0)  # type: ignore[arg-type]
    none = PlaneArcs(np.zeros((0, 2)), np.zeros(0), np.zeros(0), np.zeros(0))
    with pytest.raises(GeometryError, match="fairness: curve has no length"):
        ah.form.fairness(none)
    with pytest.raises(GeometryError, match="offsets and tolerances differ in length"):
        ah.form.fairness(CURVES["graph"], offsets=[(0, 0)], tolerances=[0.1, 0.2])
