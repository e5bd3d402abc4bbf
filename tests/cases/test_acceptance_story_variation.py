"""The acceptance story, step 3: shaft raised by 1 m, bossing end radius from 0.725 to 1.0 m.

One call, no hand work: circle, profile and the 1.0 m buttock come out as drawn, all other lines
follow.
"""

from __future__ import annotations

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.variation import Variation
from tests.independent import trouble

ASKED = {"shaft_height": 6.0, "bossing_radius": 1.0}


@pytest.fixture(scope="module")
def story(bulk_carrier: ah.Hull) -> Variation:
    """The varied carrier, with its report."""
    return bulk_carrier.vary(set=ASKED)


def test_the_bossing_circle_has_its_new_radius_and_centre(story: Variation) -> None:
    """Measured on the drawn curve: to 1e-6 m, all the way round; the feature knows them exactly."""
    reached = {target.name: target.reached for target in story.report.targets}
    assert reached == pytest.approx(ASKED, abs=1e-6)
    x, y, z = story.hull.lines["bossing end"].curves[0].polyline(64).T
    assert np.abs(x - 6.0).max() == 0.0
    assert np.abs(np.hypot(y, z - 6.0) - 1.0).max() <= 1e-6
    feature = story.hull.features["bossing end"]
    assert (feature.parameters["centre"], feature.parameters["radius"]) == ((6.0, 0.0, 6.0), 1.0)


def test_the_bossing_stays_the_cylinder_it_was(story: Variation) -> None:
    """Both stations on it have the same circle; each is a feature still."""
    for name in ("ST 0.45 circle", "ST 0.5 circle"):
        found = story.hull.features[name].parameters
        centre = found["centre"]
        assert isinstance(centre, tuple)
        assert centre[1:] == pytest.approx((0.0, 6.0), abs=1e-12)
        assert found["radius"] == pytest.approx(1.0, abs=1e-12)


def test_the_profile_meets_the_circle(story: Variation) -> None:
    """Two of its ends are the lowest and the highest place of it, to the bit."""
    ends = [
        curve.spline.xyz[end].tolist()
        for curve in story.hull.lines["profile"].curves
        for end in (0, -1)
    ]
    assert [6.0, 0.0, 5.0] in ends
    assert [6.0, 0.0, 7.0] in ends
    circle = story.hull.lines["bossing end"].curves[0].spline.xyz
    assert circle[[0, -1]].tolist() == [[6.0, 0.0, 5.0], [6.0, 0.0, 7.0]]


def test_the_buttock_that_missed_the_bossing_meets_it_in_a_knuckle(
    bulk_carrier: ah.Hull, story: Variation
) -> None:
    """At the circle's widest place; on the parent no point of it is a knuckle."""
    name = "BTK 1 x bossing end"
    assert name not in bulk_carrier.points
    point = story.hull.points[name]
    assert point.position.tolist() == [6.0, 1.0, 6.0]
    assert point.kind == "knuckle"
    (curve,) = story.hull.lines["BTK 1"].curves
    # A point that defines the curve, to the last bit: the curve passes it by construction.
    assert [6.0, 1.0, 6.0] in curve.spline.xyz.tolist()
    knot = curve.spline.xyz.tolist().index([6.0, 1.0, 6.0])
    above, below = curve.spline.xyz[[knot - 1, knot + 1]]
    # Both branches run along the cylinder to its last station, each on its side.
    assert above[0] == below[0] == 7.5
    assert above[2] > 6.0 > below[2]


def test_frames_and_waterlines_follow_without_hand_work(
    bulk_carrier: ah.Hull, story: Variation
) -> None:
    """The hull is sound, crossings lie on both curves, and every line of the stern has moved."""
    hull = story.hull
    assert list(trouble(hull)) == []
    assert (hull.check(), hull.verify()) == ((), ())
    assert len(hull.history) == 1
    for name in ("ST 0.45", "ST 0.62", "ST 1", "ST 2", "WL 4", "WL 5", "WL 6", "WL 7", "WL 8"):
        old = np.concatenate([curve.polyline(8) for curve in bulk_carrier.lines[name].curves])
        new = np.concatenate([curve.polyline(8) for curve in hull.lines[name].curves])
        assert old.shape != new.shape or np.abs(old - new).max() > 0.05, name


def test_waterlines_end_where_the_bossing_has_come_to(story: Variation) -> None:
    """That of the new shaft height on the circle, at its widest place."""
    first = story.hull.lines["WL 6"].curves[0].points[0]
    assert first.name == "WL 6 x bossing end"
    assert first.position.tolist() == [6.0, 1.0, 6.0]


def test_lines_forward_of_the_stern_keep_their_bits(
    bulk_carrier: ah.Hull, story: Variation
) -> None:
    """Beyond the regions that the report names, a quarter of the length forward of the bossing."""
    fore = max(region.x[1] for region in story.report.regions)
    assert fore < 90.0
    for name, line in bulk_carrier.groups["sections"].lines.items():
        if line.curves[0].points[0].x <= fore:
            continue
        for old, new in zip(line.curves, story.hull.lines[name].curves, strict=True):
            assert np.array_equal(old.spline.xyz, new.spline.xyz), name


def test_lines_cut_anew_keep_their_points_forward_of_the_stern(
    bulk_carrier: ah.Hull, story: Variation
) -> None:
    """They come to end elsewhere aft; forward of the regions each point keeps name and bits."""
    fore = max(region.x[1] for region in story.report.regions)
    for name in ("WL 5", "WL 6", "WL 7", "BTK 1"):
        old, new = (
            {
                point.name: point.position.tolist()
                for curve in hull.lines[name].curves
                for point in curve.points
                if point.x > fore and point.crossing_role == "shared"
            }
            for hull in (bulk_carrier, story.hull)
        )
        assert len(old) > 20
        assert new == old, name


def test_the_comparison_tells_what_came_of_it(bulk_carrier: ah.Hull, story: Variation) -> None:
    """Circles by their parameters, the shaft by its own, lines where they moved and no others."""
    found = bulk_carrier.compare(story.hull)
    changed = {each.name: each for each in found.features if each.what != "same"}
    assert {"bossing end", "ST 0.45 circle", "ST 0.5 circle"} <= set(changed)
    end = changed["bossing end"]
    assert (end.before or {})["radius"] == 0.725
    assert (end.after or {})["radius"] == 1.0
    assert found.parameter("SCH").difference == pytest.approx(1.0, abs=1e-6)
    assert "BTK 1 x bossing end" in found.points.came
    assert found.line("bossing end").length == pytest.approx(1.275, abs=1e-6)  # its top: 5.725 > 7
    assert {found.line(name).what for name in ("ST 3", "ST 10", "ST 20.3")} == {"same"}
    assert {line.what for line in found.lines} == {"same", "moved"}


def test_the_bossing_alone_becomes_as_wide(bulk_carrier: ah.Hull) -> None:
    """Two waterlines and a buttock are tangent to it then; the hull is sound, all are met."""
    alone = bulk_carrier.vary(set={"bossing_radius": 1.0})
    assert alone.report.targets[0].reached == pytest.approx(1.0, abs=1e-6)
    assert (alone.hull.check(), alone.hull.verify()) == ((), ())
    assert alone.hull.points["BTK 1 x bossing end"].position.tolist() == [6.0, 1.0, 5.0]
    top = alone.hull.lines["WL 6"].curves[0].spline.xyz
    assert top[:2].tolist() == [[6.0, 0.0, 6.0], [7.5, 0.0, 6.0]]


def test_undo_gives_the_parent_back(bulk_carrier: ah.Hull, story: Variation) -> None:
    """To the last bit; redo the variant."""
    after = story.hull.fingerprint
    story.hull.undo()
    assert story.hull.fingerprint == bulk_carrier.fingerprint
    story.hull.redo()
    assert story.hull.fingerprint == after
