"""How fast points, planes and features of a varied hull move with what is free."""

from __future__ import annotations

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.edit.hull_normals import hull_normals
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.tables import HullState
from assoc_hull.variation.aiming.hull_problem import HullProblem, Reached
from tests.aims import SHIFTED, problem, small

STEP = 1e-3
"""Half the span of differences of hulls, in usual changes."""


@pytest.fixture(scope="module")
def kept() -> HullProblem:
    """A small hull, whose planes all free parameters keep or move."""
    return problem(small(), ["volume"], ["breadth", "draught", SHIFTED])


def off_planes(state: HullState, move: FloatArray, level: FloatArray) -> FloatArray:
    """Give how fast points leave the planes of their lines, (rows, 2)."""
    curve = state.rows.curve.data
    line = np.where(curve >= 0, state.curves.line[curve], -1)
    held = (line >= 0) & state.lines.planar[line] & state.rows.alive[:, None]
    normal = np.where(held[..., None], state.lines.normal[line], 0.0)
    rate = np.where(held, level[line], 0.0)
    found: FloatArray = (move[:, None] * normal).sum(axis=2) - rate
    return found


@pytest.mark.parametrize("at", [[0.0, 0.0, 0.0], [0.3, -0.2, 0.8]], ids=["parent", "varied"])
def test_points_move_as_carried_hulls_do(kept: HullProblem, at: list[float]) -> None:
    """Where a map keeps all planes, hulls that are carried in full differ by these rates."""
    here = np.array(at)
    base = kept._carried(here) if here.any() else kept.at(here).base
    for j, free in enumerate(kept.maps.free):
        step = np.zeros(3)
        step[j] = STEP * free.usual
        ends = [kept._carried(here + by).state for by in (step, -step)]
        rate = (ends[0].rows.xyz.data - ends[1].rows.xyz.data) / (2.0 * step[j])
        level = (ends[0].lines.offset.data - ends[1].lines.offset.data) / (2.0 * step[j])
        planar = base.state.lines.planar.data
        assert base.rates.move[j] == pytest.approx(rate, abs=1e-6)
        assert base.rates.level[j][planar] == pytest.approx(level[planar], abs=1e-6)


def test_dimensions_move_with_the_parameters_that_set_them(kept: HullProblem) -> None:
    """Breadth and draught by 1 m a metre, the depth as the deck goes along."""
    sizes = kept.at(np.zeros(3)).base.rates.sizes
    assert sizes[:, 0].tolist() == [0.0, 0.0, 0.0]
    assert sizes[:, 1] == pytest.approx([1.0, 0.0, 0.0], abs=1e-9)
    assert sizes[:, 3] == pytest.approx([0.0, 1.0, 0.0], abs=1e-9)
    assert sizes[:, 2] == pytest.approx([0.0, 1.0, 0.0], abs=1e-9)


@pytest.fixture(scope="module")
def bent(series60_70: ah.Hull) -> Reached:
    """Series 60 with a fuller fore body: its buttocks stay plane where the map bends them."""
    length, draught = series60_70.particulars.length, series60_70.particulars.draught
    along = {"x": [0.55 * length, 0.8 * length, 0.97 * length], "v": [0.0, 0.05, 0.0]}
    field = {
        "name": "fuller", "axis": "y",
        "boundaries": [["low", 0.6 * draught], ["T", draught], ["top", 1.5 * draught]],
        "pieces": [{}, {"a": along}, {}],
    }  # fmt: skip
    layer = {"name": "fuller", "fields": [{"stack": field}]}
    return problem(series60_70, ["volume", "cw"], ["fore_shift", layer]).at(np.array([0.5, 0.4]))


def test_points_stay_in_the_planes_of_their_lines(bent: Reached) -> None:
    """To rounding: a nudge never bends a line out of its plane."""
    rates = bent.base.rates
    for move, level in zip(rates.move, rates.level, strict=True):
        off = off_planes(bent.state, move, level)[rates.rows]
        assert np.abs(off).max() <= 1e-9
    # the fuller fore body alone would take many points off their buttocks
    assert np.abs(off_planes(bent.state, rates.carried[1], rates.level[1])).max() > 0.1


def test_points_slide_over_the_hull(bent: Reached) -> None:
    """What a point moves by beside the map lies in the tangent plane of the hull."""
    rates = bent.base.rates
    slid = (rates.move - rates.carried)[:, rates.rows]
    normal = hull_normals(bent.state)[rates.rows]
    out = np.abs((slid * normal).sum(axis=2))
    assert np.sqrt((slid * slid).sum(axis=2)).max() > 1.0
    assert out.max() <= 1e-9


def test_what_no_parameter_moves_has_no_rate(bent: Reached) -> None:
    """Aft of the region of all fields nothing moves, not by a bit."""
    xyz = bent.state.rows.xyz.data
    aft = bent.state.rows.alive.data & (xyz[:, 0] < 55.0)
    assert aft.sum() > 100
    assert not bent.base.rates.move[:, aft].any()
