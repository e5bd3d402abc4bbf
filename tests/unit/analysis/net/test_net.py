"""Strips, rails and anchors found in the nets of real hulls, and nets with fewer lines."""

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.analysis.hydrostatics.flotation import flotation
from assoc_hull.analysis.net.curve_net import (
    CurveNet,
    every_other_line,
    every_other_section,
    gather_net,
    station_planes,
    thinned_net,
)
from assoc_hull.analysis.net.strip_anchors import LineSpans, line_spans, strip_anchors
from assoc_hull.analysis.net.strip_boundaries import StripBoundary, boundary_arcs, strip_boundaries
from assoc_hull.analysis.net.surface_layout import lay_out_surface, parallel_slabs
from assoc_hull.geometry.curves import PointKind
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.geometry.splines.segments import evaluate
from assoc_hull.model.line_source import LineSource
from assoc_hull.shipped.series60 import series60_adopted
from assoc_hull.shipped.wigley import wigley
from tests.nets import ellipsoid_net


def _rail(net: CurveNet, frame: StripBoundary, which: str) -> list[str]:
    names = [net.name[part[0]] for part in getattr(frame, which)]
    return list(dict.fromkeys(names))


def _volume(hull: ah.Hull, draught: float) -> float:
    below = flotation(hull.state).measure(
        FloatingPlanes(np.array([draught]), np.zeros(1), np.zeros(1))
    )
    return float(below.volume[0])


def test_a_wigley_hull_has_a_strip_between_all_neighbours() -> None:
    """Stem and stern post are rails, keel and deck edge the sides."""
    net = gather_net(wigley())
    layout = lay_out_surface(net, 100.0, closed=True)
    assert layout.lost == ()
    assert len(layout.frames) == 20
    assert layout.cells.plane.all()
    assert layout.edge.all()
    first, last = layout.frames[0], layout.frames[-1]
    assert _rail(net, first, "aft") == ["profile"] == _rail(net, last, "fore")
    for frame in layout.frames:
        assert _rail(net, frame, "keel") == ["profile"]
        assert _rail(net, frame, "deck") == ["deck edge"]


def test_every_anchor_of_a_wigley_hull_is_found() -> None:
    """Ten waterlines, keel and deck edge in each of 20 strips."""
    layout = lay_out_surface(gather_net(wigley()), 100.0, closed=True)
    assert np.diff(layout.cells.anchor_start).tolist() == [12] * 20
    assert (layout.cells.anchor >= 0).all()


def test_the_carrier_comes_apart_at_bulb_and_bossing(bulk_carrier: ah.Hull) -> None:
    """Rails there are made of the pieces and the profile between them; flat ends are rails."""
    net = gather_net(bulk_carrier.state)
    layout = lay_out_surface(net, 300.0, closed=True)
    assert layout.lost == ()
    rails = [(_rail(net, f, "aft"), _rail(net, f, "fore")) for f in layout.frames]
    assert (["ST 19.8"], ["ST 20.04", "profile"]) in rails
    assert (["ST 0.5", "profile"], ["ST 0.62"]) in rails
    assert (["transom"], ["ST -0.25"]) in rails
    assert (["bossing end"], ["ST 0.45"]) in rails
    assert (["ST 20.3"], ["profile"]) in rails
    assert sum(aft == ["ST 20.175"] for aft, _ in rails) == 2


def test_lines_that_run_to_a_point_make_a_rail_of_it() -> None:
    """The tip of the ellipsoid; all diagonals arrive there."""
    layout = lay_out_surface(gather_net(ellipsoid_net(11, 6)), 100.0, closed=False)
    _curve, begin, finish = layout.frames[0].aft[0]
    assert begin == finish
    assert len(layout.frames[0].aft) == 1
    assert np.diff(layout.cells.anchor_start).tolist() == [11] * 10


def test_a_thinned_net_lacks_every_other_section() -> None:
    """What is left out differs between the two choices, the outermost included; lines follow."""
    state = wigley()
    net = gather_net(state)
    even, odd = (every_other_section(net, first) for first in (0, 1))
    assert not (even & odd).any()
    assert int((even | odd).sum()) == 19
    fewer = thinned_net(state, net, even)
    assert len(station_planes(fewer)) == 19 - int(even.sum())
    level = fewer.name.index("WL 2.5")
    size = np.diff(fewer.batch.start)[level]
    assert size == np.diff(net.batch.start)[net.name.index("WL 2.5")] - int(even.sum())
    assert lay_out_surface(fewer, 100.0, closed=True).lost == ()


def test_places_on_a_thinned_net_are_on_both_lines() -> None:
    """Crossings carried over to the coarser splines meet to within what the splines differ by."""
    state = wigley()
    net = gather_net(state)
    fewer = thinned_net(state, net, every_other_line(net))
    one, other = (evaluate(fewer.batch, fewer.meets[:, i], fewer.place[:, i]) for i in (0, 1))
    assert np.abs(one - other).max() < 2e-3


def test_the_surface_is_kept_until_a_line_changes() -> None:
    """The same object is given again; an edit makes a new one, undo brings the volume back."""
    hull = ah.examples.wigley()
    first, before = flotation(hull.state), _volume(hull, 6.25)
    assert flotation(hull.state) is first
    with hull.edit("drag") as edit:
        point = hull.points["WL 2.5 x ST 7"]
        edit.move(point, y=point.y + 0.05)
    after = _volume(hull, 6.25)
    assert flotation(hull.state) is not first
    assert after > before + 0.05
    hull.undo()
    assert _volume(hull, 6.25) == before


def test_a_line_that_is_renamed_goes_by_its_new_name() -> None:
    """What is kept of a hull does not hold the names of before."""
    hull = ah.examples.wigley()
    assert "ST 1" in flotation(hull.state).sections.names
    with hull.edit("rename") as edit:
        edit.rename(hull.groups["sections"].lines["ST 1"], "frame 48")
    assert "frame 48" in flotation(hull.state).sections.names
    assert "ST 1" not in flotation(hull.state).sections.names


@pytest.mark.parametrize("count", [2, 3])
def test_a_few_sections_have_numbers_and_errors(count: int) -> None:
    """A box of two or three sections has an error, though half of them bound nothing."""
    corners = np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 12.0]])
    lines = [
        LineSource.make(
            "sections", f"ST {x:g}", np.column_stack([np.full(3, x), corners]),
            kind=[0, PointKind.KNUCKLE, 0],
        )
        for x in np.linspace(0.0, 100.0, count).tolist()
    ]  # fmt: skip
    ship = ah.Particulars("box", 100.0, 20.0, 12.0, 6.0)
    found = ah.Hull.from_lines(lines, particulars=ship, associations=[]).hydrostatics()
    assert found.volume == pytest.approx(12000.0, rel=1e-12)
    assert (found.error["volume"] or 0.0) > 0.0


def test_two_sections_at_least() -> None:
    """One section bounds nothing."""
    hull = ah.examples.wigley()
    with hull.edit("one left") as edit:
        for name in list(hull.groups["sections"].lines)[1:]:
            edit.remove_line(hull.groups["sections"].lines[name])
    with pytest.raises(ah.errors.BadInputError, match=r"1 section"):
        flotation(hull.state)


def test_ends_of_a_hull_without_deck_edge_are_not_lost() -> None:
    """Stem and stern are joined to the tops of the last sections: the volume stays."""
    hull = ah.examples.wigley()
    whole = _volume(hull, 6.25)
    with hull.edit("no deck edge") as edit:
        edit.remove_line(hull.groups["boundary"].lines["deck edge"])
    layout = flotation(hull.state).layout
    assert layout.lost == ()
    assert len(layout.frames) == 20
    assert _volume(hull, 6.25) == pytest.approx(whole, rel=1e-4)


def test_only_the_uppermost_strip_has_a_deck_edge(bulk_carrier: ah.Hull) -> None:
    """Also where no deck edge is drawn: bulb and bossing end on the centre plane, below others."""
    with bulk_carrier.edit("no deck edge") as edit:
        edit.remove_line(bulk_carrier.groups["boundary"].lines["deck edge"])
    try:
        found = flotation(bulk_carrier.state)
        assert found.limits.deck[:, 2].min() > 26.9
        top: dict[int, float] = {}
        heights = [_height(found.net, frame) for frame in found.layout.frames]
        for frame, height in zip(found.layout.frames, heights, strict=True):
            top[frame.slab] = max(top.get(frame.slab, 0.0), height)
        for frame, height, edge in zip(
            found.layout.frames, heights, found.layout.edge.tolist(), strict=True
        ):
            assert edge == (height == top[frame.slab]), frame
    finally:
        bulk_carrier.undo()


def _height(net: CurveNet, frame: StripBoundary) -> float:
    """Give the height of the upper ends of the rails, m."""
    ends = [rail[-1] for rail in (frame.aft, frame.fore)]
    place = evaluate(net.batch, np.array([e[0] for e in ends]), np.array([e[2] for e in ends]))
    return float(place[:, 2].max())


def test_between_equal_largest_sections_a_hull_with_flats_runs_straight(
    series60_70: ah.Hull, series60_60: ah.Hull
) -> None:
    """The parallel body of CB .70 is that from ST 10 to ST 12; CB .60 has none, nor has Wigley."""
    net = gather_net(series60_70.state)
    x = station_planes(net)
    slabs = sorted(parallel_slabs(net, x))
    stations = np.round(20.0 * x / series60_70.particulars.length, 9).tolist()
    assert [(stations[i - 1], stations[i]) for i in slabs] == [(10.0, 11.0), (11.0, 12.0)]
    layout = lay_out_surface(net, series60_70.particulars.length, closed=True)
    for i, frame in enumerate(layout.frames):
        begin, end = layout.cells.anchor_start[i : i + 2]
        straight = (layout.cells.anchor[begin:end] == -1).all()
        assert straight == (frame.slab in slabs)
    for state in (series60_60.state, wigley(stations=22)):
        net = gather_net(state)
        assert parallel_slabs(net, station_planes(net)) == frozenset()


def test_a_border_that_dips_below_a_waterline_between_sections_holds_no_surface() -> None:
    """Two lines that change places would fold it: the waterline stays, the border goes."""
    state = series60_adopted(0.70)[0]
    net = gather_net(state)
    every = line_spans(net)
    found, _ = strip_boundaries(
        net, boundary_arcs(net, station_planes(net)), len(station_planes(net)), 121.92
    )
    [frame] = [each for each in found if each.slab == 14]
    held = _held(net, frame, every)
    assert "WL 0.25" in held
    assert "flat of side" not in held
    [frame] = [each for each in found if each.slab == 12]
    assert {"WL 0.25", "flat of side"} <= _held(net, frame, every)


def _held(net: CurveNet, frame: StripBoundary, every: LineSpans) -> set[str]:
    """Give the lines along which the anchors of a strip run, but for its sides."""
    span = strip_anchors([frame], every)[1].span
    return {net.name[i] for i in every.curve[span[span >= 0]].tolist()}
