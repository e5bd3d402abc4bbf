"""Transformations of random nets after random edits: what must hold, holds, or all is refused."""

from __future__ import annotations

import attrs
import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.strategies import SearchStrategy

import assoc_hull as ah
from assoc_hull.errors import AssocHullError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.hull_json import dumps_hull_json, read_hull_json
from assoc_hull.model.kinds import Role, Sort
from tests.independent import lost_meetings, trouble
from tests.long_forms import draws
from tests.net_strategies import SHAPES, STRUCTURE, Task, carry_out, hulls, tasks


@attrs.frozen
class Smooth:
    """A smooth map: factors, a swelling by a part, a lift (m) and a rake (m)."""

    scale: tuple[float, float, float]
    swell: float
    lift: float
    rake: float

    def __call__(self, xyz: FloatArray) -> FloatArray:
        x, y, z = np.asarray(xyz).T
        bell = np.exp(-(((x - 50.0) / 40.0) ** 2))
        return np.column_stack(
            [
                self.scale[0] * x + self.rake * np.sin(z / 4.0),
                self.scale[1] * y * (1.0 + self.swell * bell),
                self.scale[2] * z + self.lift * bell * np.sin(z / 6.0),
            ]
        )


def maps() -> SearchStrategy[Smooth]:
    """Give maps, often affine, sometimes of one factor only, up to ones that cost lines an end."""
    factor = st.just(1.0) | st.floats(0.92, 1.08) | st.floats(0.75, 1.3)
    swell, lift, rake = (st.just(0.0) | st.floats(-most, most) for most in (0.2, 1.0, 0.1))
    return st.builds(Smooth, st.tuples(factor, factor, factor), swell, lift, rake)


DRIVERS = (("sections",), ("sections", "profile"), ("waterlines",), ("sections", "waterlines"))


@settings(max_examples=draws(20))
@given(hulls(), tasks(SHAPES + STRUCTURE, most=2), maps(), st.sampled_from(DRIVERS), st.booleans())
def test_a_transformed_net_is_sound(
    hull: ah.Hull, edits: list[Task], mapping: Smooth, drivers: tuple[str, ...], follow: bool
) -> None:
    """Consistency, a rebuild of the same bits, undo and redo, also through a file; else no bit.

    What was placed is placed still, and lines, kinds and ends are those of before.
    """
    for task in edits:
        carry_out(hull, task)
    before, table = hull.fingerprint, hull.state.rows
    live = hull.state.live("rows")
    placed = live[table.sort[live] == Sort.PLACED]
    names = sorted(hull.lines)
    try:
        with hull.edit("transform") as edit:
            edit.transform(mapping, drivers, planes="follow" if follow else "stay")
    except AssocHullError:
        assert hull.fingerprint == before
        return
    table = hull.state.rows
    assert table.alive[placed].all()
    assert (table.sort[placed] == Sort.PLACED).all()
    assert sorted(hull.lines) == names
    assert list(trouble(hull)) == []
    assert list(lost_meetings(hull)) == []
    assert hull.verify() == ()
    after = hull.fingerprint
    again = ah.Hull(read_hull_json(dumps_hull_json(hull.state)))
    assert again.fingerprint == after
    assert edit.report is not None
    if not edit.report.changed:
        assert after == before
        return
    hull.undo()
    assert hull.fingerprint == before
    hull.redo()
    assert hull.fingerprint == after


@given(hulls(), tasks(SHAPES + STRUCTURE, most=2))
def test_the_identity_changes_no_bit(hull: ah.Hull, edits: list[Task]) -> None:
    """After whatever edits, the identity on all groups is no change."""
    for task in edits:
        carry_out(hull, task)
    before = hull.fingerprint
    with hull.edit("identity") as edit:
        edit.transform(lambda xyz: xyz, [name for name in hull.groups if name != "boundary"])
    assert hull.fingerprint == before


@given(hulls(), st.tuples(*(st.floats(0.8, 1.25) for _ in range(3))))
def test_affine_maps_of_all_groups_are_exact(
    hull: ah.Hull, scale: tuple[float, float, float]
) -> None:
    """Shared crossings and own points go where the mapping sends them, to 1e-9 m; roles stay."""
    table, live = hull.state.rows, hull.state.live("rows")
    held = live[(table.sort[live] != Sort.CROSSING) | (table.role[live] == Role.SHARED)]
    riding = (table.anchor[held] >= 0).any(axis=1)
    held = held[~riding]
    old, roles = table.xyz[held], table.role[live]
    groups = [name for name, group in hull.groups.items() if group.lines]
    try:
        with hull.edit("affine") as edit:
            edit.transform(scale=scale, drivers=groups)
    except AssocHullError:
        return
    now = hull.state.rows
    assert np.abs(now.xyz[held] - old * scale).max() <= 1e-9
    assert (now.role[live] == roles).all()
