"""A variation carried out: which lines drive, what is met by correction, what size the ship has."""

from __future__ import annotations

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.edit.space_map import SpaceMap
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.aiming import reach_targets
from assoc_hull.variation.carrying.driving_lines import find_kept_planes
from assoc_hull.variation.request import Planes, Stations
from tests.long_forms import long_form


@pytest.fixture(scope="module")
def wigley() -> ah.Hull:
    """A parent that nothing changes."""
    return ah.examples.wigley()


@pytest.mark.parametrize(
    ("name", "value", "stations", "planes", "families"),
    [
        ("breadth", 11.0, "number", "stay", {"ST", "WL"}),
        ("draught", 7.0, "number", "follow", {"ST", "WL"}),
        ("draught", 7.0, "number", "stay", {"ST"}),
        ("length", 110.0, "x", "follow", {"WL"}),
    ],
)
def test_lines_drive_whose_planes_stay_or_may_go(
    wigley: ah.Hull, name: str, value: float, stations: Stations, planes: Planes, families: set[str]
) -> None:
    """Waterlines stay where they are under a breadth; all others are cut again."""
    found = wigley.vary(set={name: value}, stations=stations, planes=planes).report.drivers
    assert {each.split()[0] for each in found if each.startswith(("ST", "WL"))} == families


def test_a_line_that_is_bent_where_no_slope_tells_keeps_no_plane(wigley: ah.Hull) -> None:
    """Its places count as well: a circle drawn anew moves its own points alone."""

    def lifted(xyz: FloatArray) -> FloatArray:
        return xyz + np.where(xyz[:, 2:] > 4.0, [[1e-3, 0.0, 0.0]], 0.0)

    def slope(xyz: FloatArray) -> FloatArray:
        return np.tile(np.eye(3), (len(xyz), 1, 1))

    state = wigley.state
    kept = find_kept_planes(state, SpaceMap(lifted, slope))
    lines = {str(state.lines.name[line]): line for line in state.live("lines").tolist()}
    section, low = lines["ST 10"], lines["WL 2.5"]
    assert not kept.plane[section, 0]
    assert not kept.place[section, 0]
    assert kept.plane[low, 2]
    assert kept.place[low, 2]


@pytest.mark.parametrize(("value", "depth"), [({"draught": 7.0}, None), ({"depth": 10.0}, 10.0)])
def test_the_stored_depth_is_that_of_the_deck(
    wigley: ah.Hull, value: dict[str, float], depth: float | None
) -> None:
    """A deeper ship has a higher deck, and her particulars say so."""
    variant = wigley.vary(set=value).hull
    measured = variant.measure()["depth"]
    assert variant.particulars.depth == pytest.approx(depth or measured, abs=1e-9)
    assert measured > wigley.measure()["depth"]


def test_a_breadth_asked_for_is_that_of_the_particulars_however_broad_lines_are_drawn() -> None:
    """Lines that pass B/2 between points keep their ratio to it, and the report says so."""
    parent = ah.examples.plain_ship()
    before = parent.measure(only=["breadth"]).anchors["breadth"]
    assert before.value == parent.particulars.breadth == 18.0
    assert before.numbers["drawn"] > 18.0 + 5e-3
    found = parent.vary(set={"breadth": 19.0})
    after = found.hull.measure(only=["breadth"]).anchors["breadth"]
    assert found.hull.particulars.breadth == after.value == 19.0
    assert after.numbers["drawn"] == pytest.approx(before.numbers["drawn"] * 19.0 / 18.0, abs=1e-4)
    [told] = [note for note in found.report.notes if note.startswith("the lines are at most")]
    assert f"{after.numbers['drawn']:.3f} m broad" in told
    assert told.endswith("where the breadth of the ship is 19 m")
    floats = found.hull.hydrostatics()
    assert floats.cw == pytest.approx(parent.hydrostatics().cw, abs=2e-5)


@pytest.mark.parametrize("nudged", [True, False])
def test_what_lofting_misses_is_corrected(
    series60_70: ah.Hull, monkeypatch: pytest.MonkeyPatch, nudged: bool
) -> None:
    """The bilge of a broader ship is measured at a curve through new points, and met to 1e-6.

    The carried hull is nudged; where that cannot be, it is carried anew with corrected aims.
    """
    if not nudged:
        monkeypatch.setattr(reach_targets, "_TRIALS", 0)
    asked = {"breadth": 17.25, "bilge_radius": 1.88}
    variant = series60_70.vary(set=asked)
    assert (variant.report.rounds == 1) == nudged
    measured = variant.hull.measure(only=list(asked))
    assert dict(measured) == pytest.approx(asked, abs=1e-6)
    assert variant.hull.check() == ()


@pytest.mark.parametrize("nudged", [True, False])
@pytest.mark.parametrize("fair", [False, True])
def test_what_lofting_misses_is_corrected_while_targets_are_held(
    series60_70: ah.Hull, monkeypatch: pytest.MonkeyPatch, nudged: bool, fair: bool
) -> None:
    """Set values are met to 1e-6, targets to 1e-8, within bounds, by the same small changes."""
    if not nudged:
        monkeypatch.setattr(reach_targets, "_TRIALS", 0)
    now = series60_70.hydrostatics()
    asked, free = {"breadth": 17.25, "bilge_radius": 1.88}, ["fore_shift", "aft_shift"]
    targets = {"volume": 1.005 * now.volume, "lcb": now.lcb - 0.1}
    variant = series60_70.vary(
        set=asked, reach=targets, free=free, bounds={"aft_shift": (-9.0, 9.0)}, fair=fair
    )
    report, after = variant.report, variant.hull.hydrostatics()
    assert (report.rounds == 1) == nudged
    assert dict(variant.hull.measure(only=list(asked))) == pytest.approx(asked, abs=1e-6)
    assert {name: getattr(after, name) for name in targets} == pytest.approx(targets, rel=1e-8)
    assert variant.hull.check() == ()
    assert report.aim is not None
    assert report.aim.reached
    assert report.aim.values.tolist() == pytest.approx(list(targets.values()), rel=1e-8)
    assert report.aim.residual <= 1e-9
    assert abs(report.aim.amplitudes[1]) <= 9.0
    again = series60_70.vary(
        set=asked | dict(zip(free, report.aim.amplitudes.tolist(), strict=True)), fair=fair
    )
    assert again.hull.hydrostatics().lcb == pytest.approx(after.lcb, abs=2e-3)


@pytest.mark.parametrize("fair", [False, pytest.param(True, marks=long_form)])
def test_a_nudge_to_what_is_asked_for_is_as_fair_as_maps_with_corrected_aims(
    monkeypatch: pytest.MonkeyPatch, fair: bool
) -> None:
    """Values are met, the two hulls lie on each other, and neither has more changes of sign."""
    hull = ah.examples.bulk_carrier_207k()
    asked = {"bulb_height": 6.4, "bulb_half_breadth": 5.3}
    quick = hull.vary(set=asked, fair=fair)
    monkeypatch.setattr(reach_targets, "_TRIALS", 0)
    full = hull.vary(set=asked, fair=fair)
    for each in (quick, full):
        assert dict(each.hull.measure(only=list(asked))) == pytest.approx(asked, abs=1e-7)
        assert each.hull.check() == ()
    assert quick.report.rounds < full.report.rounds
    assert quick.report.maps == full.report.maps
    assert quick.report.added_sign_changes <= full.report.added_sign_changes
    assert quick.report.worst_comb == pytest.approx(full.report.worst_comb, rel=0.02)
    assert max(each.length for each in quick.hull.compare(full.hull).lines) < 2e-3


@pytest.mark.parametrize("planes", ["follow", "stay"])
@pytest.mark.parametrize("asked", [{"fore_shift": 0.5}, {"length": 103.0}, {"draught": 7.0}])
def test_sections_that_stay_stay_to_the_bit(
    wigley: ah.Hull, asked: dict[str, float], planes: Planes
) -> None:
    """Whatever waterlines and buttocks do."""

    def places(hull: ah.Hull) -> dict[str, float]:
        lines = hull.state.lines
        live = hull.state.live("lines").tolist()
        named = [each for each in live if lines.name[each].startswith("ST ")]
        return {str(lines.name[each]): float(lines.offset[each]) for each in named}

    was = places(wigley)
    assert places(wigley.vary(set=asked, stations="x", planes=planes).hull) == was
