"""The layout of the surface after any edit, to the bit: as the long way makes it, as if made first.

What previews and hydrostatics keep of a hull must never show in their numbers.
"""

from __future__ import annotations

from unittest import mock

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import assoc_hull as ah
from assoc_hull.analysis.hydrostatics import flotation as hydrostatics_of
from assoc_hull.analysis.hydrostatics.flotation import even_keel_displacement, flotation
from assoc_hull.analysis.net.curve_net import (
    CurveNet,
    every_other_line,
    every_other_section,
    gather_net,
    station_planes,
    thinned_net,
)
from assoc_hull.analysis.net.surface_layout import SurfaceLayout, lay_out_surface, parallel_slabs
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.floating.immersion import FloatingPlanes, ImmersedIntegrals
from assoc_hull.graph.derived import Derived
from assoc_hull.model.tables import HullState
from tests.conftest import Shipped
from tests.long_forms import draws
from tests.net_strategies import POOL, SHAPES, STRUCTURE, Task, carry_out, fresh, tasks
from tests.plain_layout import plain_layout, plain_parallel_slabs

PULLED = {"series60_70": "WL 1.08 x ST 4", "bulk_carrier": "WL 9 x ST 4"}


def arrays_of(layout: SurfaceLayout) -> dict[str, np.ndarray]:
    """All arrays of a layout by name, but for those that others say."""
    cells, paths = layout.cells, layout.cells.paths
    names = ("anchor_start", "anchor", "tile_start", "blend", "first", "aft", "fore", "low", "high")
    return {
        "start": paths.start, "segment": paths.segment, "path low": paths.low,
        "path high": paths.high, **{name: getattr(cells, name) for name in (*names, "plane")},
        "cell": layout.cell, "cell_start": layout.cell_start, "rails": layout.rails,
        "flat": layout.flat, "knuckle": layout.knuckle,
    }  # fmt: skip


def assert_as_made_plainly(net: CurveNet, length: float, closed: bool) -> None:
    """Fail with the first array that is not that of the long way."""
    layout = lay_out_surface(net, length, closed)
    frames, plain = plain_layout(net, length, layout.edge & closed)
    assert tuple(frames) == layout.frames
    for name, found in arrays_of(layout).items():
        assert found.shape == plain[name].shape, name
        # A zero may have another sign: the weight of an anchor that is not there.
        assert (found == plain[name]).all(), name
    x = station_planes(net)
    assert parallel_slabs(net, x) == plain_parallel_slabs(net, x)


def nets_of(state: HullState) -> list[CurveNet]:
    """The net of a hull, and those with fewer lines that its numbers are compared with."""
    net = gather_net(state)
    if len(station_planes(net)) < 2:
        return []
    fewer = [*(every_other_section(net, first) for first in (0, 1)), every_other_line(net)]
    return [net, *(thinned_net(state, net, without) for without in fewer)]


def forgetful(state: HullState) -> HullState:
    """Give the same tables, of which nothing is known."""
    found = state.snapshot()
    found.memory = Derived()
    return found


def bits(found: ImmersedIntegrals) -> list[bytes]:
    """All integrals by their bits."""
    return [np.asarray(each).tobytes() for each in attrs.astuple(found, recurse=False)]


def assert_as_if_made_first(hull: ah.Hull) -> None:
    """Fail if what floats of a hull is not, to the bit, what a hull has that was never asked."""
    try:
        known = flotation(hull.state)
    except BadInputError:
        with pytest.raises(BadInputError):
            flotation(forgetful(hull.state))
        return
    anew = flotation(forgetful(hull.state))
    mine, theirs = arrays_of(known.layout), arrays_of(anew.layout)
    assert [name for name in mine if mine[name].tobytes() != theirs[name].tobytes()] == []
    assert (known.layout.frames, known.layout.lost) == (anew.layout.frames, anew.layout.lost)
    level = hull.particulars.draught
    planes = FloatingPlanes(np.array([level, 0.8 * level]), np.zeros(2), np.array([0.0, 0.1]))
    assert bits(known.measure(planes)) == bits(anew.measure(planes))
    assert bits(known.by_waterplanes(planes)) == bits(anew.by_waterplanes(planes))


@settings(max_examples=draws(25), deadline=None)
@given(number=st.integers(0, POOL - 1), edits=tasks(SHAPES + STRUCTURE), back=st.integers(0, 2))
def test_the_layout_is_that_of_the_long_way_after_any_edit(
    number: int, edits: list[Task], back: int
) -> None:
    """Edits of every kind, those that change the structure among them, and undo; thinner nets."""
    hull = fresh(number)
    flotation(hull.state)
    for each in edits:
        carry_out(hull, each)
        assert_as_if_made_first(hull)
    for _ in range(min(back, len(hull.history))):
        hull.undo()
        assert_as_if_made_first(hull)
    for net in nets_of(hull.state):
        assert_as_made_plainly(net, hull.particulars.length, closed=bool(back))


@pytest.mark.parametrize("name", PULLED)
def test_the_layout_of_a_pulled_ship_is_that_of_the_long_way(shipped: Shipped, name: str) -> None:
    """Bulb, bossing, raked stem, flats and a parallel body are there; then undo."""
    hull = shipped(name)
    before = flotation(hull.state)
    for d in (0.02, -0.03):
        with hull.edit("pull") as edit:
            edit.pull(PULLED[name], d=d, radius=(20.0, 8.0))
        assert_as_if_made_first(hull)
        for net in nets_of(hull.state):
            assert_as_made_plainly(net, hull.particulars.length, closed=True)
    for _ in range(2):
        hull.undo()
    level = FloatingPlanes(np.array([hull.particulars.draught]), np.zeros(1), np.zeros(1))
    assert bits(flotation(hull.state).measure(level)) == bits(before.measure(level))


@pytest.mark.parametrize("name", PULLED)
def test_a_preview_measures_what_the_edit_then_has(shipped: Shipped, name: str) -> None:
    """Volume and LCB change by what they differ by, to the bit; the hull keeps what it knows."""
    hull = shipped(name)
    before, known = even_keel_displacement(hull.state), flotation(hull.state)
    acts = [{"op": "pull", "point": PULLED[name], "d": 0.02, "radius": [20.0, 8.0]}]
    with mock.patch.object(hydrostatics_of, "lay_out_surface", wraps=lay_out_surface) as laid_out:
        found, again = hull.preview(acts), hull.preview(acts)
        assert laid_out.call_count == 0  # nobody has asked for the volume
        assert again.volume_change == found.volume_change
    assert laid_out.call_count == 2  # the hull as it is has been laid out
    assert again.lcb_change == found.lcb_change
    assert flotation(hull.state) is known
    with hull.edit("pull") as edit:
        edit.pull(PULLED[name], d=0.02, radius=(20.0, 8.0))
    after = even_keel_displacement(forgetful(hull.state))
    assert found.volume_change == after.volume - before.volume
    assert found.lcb_change == after.lcb - before.lcb
