"""A net carried point by point: points stay in the planes of their lines and on the image."""

from functools import cache

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.edit.mapped_planes import carry_planes
from assoc_hull.edit.recut.carry_numbers import NetMap, carry_net
from assoc_hull.edit.space_map import PointMapping, SpaceMap
from assoc_hull.edit.transaction import Transaction
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.model.kinds import Sort
from assoc_hull.model.tables import HullState, copy_state
from assoc_hull.shipped.wigley import wigley_half_breadth


def swell(by: float) -> PointMapping:
    """Broaden amidships by a part, fading along the length: waterlines stay plane, sections too."""

    def carried(xyz: FloatArray) -> FloatArray:
        bell = np.exp(-(((xyz[:, 0] - 60.0) / 25.0) ** 2))
        return np.column_stack([xyz[:, 0], xyz[:, 1] * (1.0 + by * bell), xyz[:, 2]])

    return carried


def lift(by: float) -> PointMapping:
    """Lift the ends: waterlines and sections' heights bend, buttocks stay in their planes."""

    def carried(xyz: FloatArray) -> FloatArray:
        up = by * ((xyz[:, 0] - 50.0) / 50.0) ** 2
        return np.column_stack([xyz[:, 0], xyz[:, 1], xyz[:, 2] + up])

    return carried


def carried(hull: ah.Hull, mapping: PointMapping, drivers: str) -> None:
    """Carry a hull by a mapping; a group drives, and boundary curves."""
    state, space = hull.state, SpaceMap(mapping)
    lines = state.lines
    driving = [line for line in state.live("lines").tolist()
               if lines.boundary[line] >= 0
               or str(state.lines.key[line]).startswith(drivers)]  # fmt: skip
    numbers = np.array(sorted(driving))
    planes = carry_planes(state, space, numbers, follow=False)
    with Transaction(hull.document, "carry") as edit:
        carry_net(edit, NetMap(space, numbers, planes, state.features, state.particulars))


@cache
def made() -> HullState:
    """A small Wigley hull with waterlines, sections and buttocks."""
    hull = ah.examples.wigley(stations=13, waterlines=8)
    with hull.edit("buttocks") as edit:
        for breadth in (1.5, 3.0):
            edit.add_line("buttocks", breadth)
    return hull.state


def net() -> ah.Hull:
    """A copy of it."""
    return ah.Hull(copy_state(made()))


def off_planes(state: HullState) -> float:
    """How far defining points lie off the planes of their lines, m."""
    rows, worst = state.live("rows"), 0.0
    for side in (0, 1):
        curve = state.rows.curve[rows, side]
        some = rows[curve >= 0]
        line = state.curves.line[curve[curve >= 0]]
        flat = state.lines.planar[line]
        height = (state.rows.xyz[some] * state.lines.normal[line]).sum(axis=1)
        away = np.abs(height - state.lines.offset[line])[flat]
        worst = max(worst, float(away.max(initial=0.0)))
    return worst


def keys_of(state: HullState) -> list[str]:
    """Give the keys of all points."""
    return sorted(str(state.rows.key[row]) for row in state.live("rows").tolist())


@pytest.mark.parametrize(("mapping", "tolerance"), [(swell, 5e-3), (lift, 5e-3)], ids=["y", "z"])
def test_points_stay_in_their_planes_and_on_the_image(mapping: object, tolerance: float) -> None:
    """No point comes or goes; each lies where the image of the formula's hull has it."""
    hull = net()
    keys = keys_of(hull.state)
    carried(hull, mapping(0.04), "sections")  # type: ignore[operator]
    state = hull.state
    rows = state.live("rows")
    assert keys_of(state) == keys
    assert off_planes(state) <= 1e-9
    x, y, z = state.rows.xyz[rows].T
    before = np.stack([x, y, z], axis=1)
    for _ in range(30):  # back by the mapping, whose displacement is small
        before += np.stack([x, y, z], axis=1) - mapping(0.04)(before)  # type: ignore[operator]
    inner = (before[:, 2] < 6.25) & (before[:, 2] > 0.0) & (np.abs(before[:, 0] - 50.0) < 49.0)
    formula = wigley_half_breadth(before[inner, 0], before[inner, 2], 100.0, 10.0, 6.25)
    assert np.abs(before[inner, 1] - formula).max() <= tolerance
    assert hull.check() == ()
    hull.undo()
    assert hull.fingerprint == net().fingerprint


def test_places_depend_smoothly_on_the_mapping() -> None:
    """Second differences of all points fall with the square of the step."""

    def places(by: float) -> FloatArray:
        hull = net()
        carried(hull, lift(by), "sections")
        found: FloatArray = hull.state.rows.xyz[hull.state.live("rows")]
        return found

    middle = places(0.2)
    bend = [np.abs(places(0.2 + h) - 2.0 * middle + places(0.2 - h)).max() for h in (4e-2, 1e-2)]
    assert bend[1] <= bend[0] / 12.0
    assert bend[0] <= 1e-2


def test_a_bent_driver_and_a_second_modification_are_refused() -> None:
    """The hull is as it was."""
    hull = net()
    before = hull.fingerprint
    with pytest.raises(ah.errors.BadInputError, match="leaves its plane"):
        carried(hull, lift(0.5), "waterlines")
    state, space = hull.state, SpaceMap(swell(0.01))
    planes = carry_planes(state, space, np.zeros(0, np.int64), follow=False)
    row = state.live("rows")[state.rows.sort[state.live("rows")] == Sort.CROSSING][:1]
    by = NetMap(space, np.zeros(0, np.int64), planes, state.features, state.particulars)
    with pytest.raises(ah.errors.BadInputError, match="another modification in one edit"):
        _both(hull, row, by)
    assert hull.fingerprint == before


def _both(hull: ah.Hull, row: IntArray, by: NetMap) -> None:
    with Transaction(hull.document, "both") as edit:
        edit.write(row, hull.state.rows.xyz[row], "a test")
        carry_net(edit, by)
