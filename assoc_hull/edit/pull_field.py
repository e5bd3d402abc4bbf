"""The field of a soft pull, and whether it brought its point where it was asked to go."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

import attrs
import numpy as np

from assoc_hull.edit.field import Field, FieldContext, Shift, bell, move_normal
from assoc_hull.edit.normals import free_normals, hull_normals
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.model.address import address
from assoc_hull.model.kinds import Role, Sort, State
from assoc_hull.model.state import HullState

__all__ = ["Pull", "unreached"]

_NEARLY = 0.01
"""A point that came within this part of the way it was pulled is where it was asked to be."""


@attrs.frozen(eq=False)
class Pull:
    """The field d(P) = d b(|x - x0| / r_x) b(rho / r_g).

    Attributes
    ----------
    row : int
        The point that is pulled.
    place : (3,), m
        Where it lay before.
    amount : float, m
        d, outward positive.
    normal : (3,)
        Outward unit normal of the hull there, before.
    radius : (float, float), m
        r_x along the length, r_g seen along x.
    flat_fade : float, m
        Towards the border of a flat the field fades to nil within this distance.
    across_flats : bool
        Whether flats are moved too.
    strict : bool
        Never: what lies around follows.
    """

    row: int
    place: FloatArray
    amount: float
    normal: FloatArray
    radius: tuple[float, float]
    flat_fade: float
    across_flats: bool
    strict: bool = False

    def shift(self, ground: FieldContext, part: float) -> Shift:
        """Give the displacements for a part of the whole pull."""
        xyz = ground.state.rows.xyz.data[ground.free]
        step = xyz - self.place
        girth = np.sqrt(step[:, 1] * step[:, 1] + step[:, 2] * step[:, 2])
        amount = (
            part * self.amount * bell(step[:, 0] / self.radius[0]) * bell(girth / self.radius[1])
        )
        if not self.across_flats and np.isfinite(self.flat_fade):
            amount = amount * (1.0 - bell(ground.flat_distance / self.flat_fade))
        reach = amount != 0.0
        return move_normal(ground, ground.free[reach], amount[reach])

    def exact(self) -> tuple[IntArray, FloatArray]:
        """Nothing: every point moves by what the field says."""
        return np.zeros(0, np.int64), np.zeros((0, 3))

    def left(self, state: HullState, done: float) -> float:
        """Give the part of the pull that the point lacks, whatever part was `done`."""
        if not state.rows.alive.data[self.row]:
            return 1.0 - done
        return 1.0 - self.reached(state) / self.amount

    def reached(self, state: HullState) -> float:
        """Give how far the point has come along the normal, m.

        A watched crossing has no value: it lies where its first curve passes.
        """
        watched = state.rows.role.data[self.row] == Role.WATCHED
        crossing = state.rows.sort.data[self.row] == Sort.CROSSING
        table = state.rows
        now = table.spot.data[self.row, 0] if watched and crossing else table.xyz.data[self.row]
        return float(((now - self.place) * self.normal).sum())


def unreached(state: HullState, fields: Sequence[Field], pinned: Collection[int]) -> Iterator[str]:
    """Say which point did not come where it was pulled, if one was and nothing else moved it.

    Several fields in one edit add, so none of their points goes where one of them pulls.
    """
    pull = fields[0] if len(fields) == 1 else None
    if not isinstance(pull, Pull) or pull.row in pinned:
        return
    where = address(state, pull.row)
    if not state.rows.alive.data[pull.row]:
        yield f"{where} was pulled and has gone: pull by less, or another point"
        return
    driver = int(state.rows.driver.data[pull.row])
    if driver >= 0 and state.curves.state.data[driver] != State.CLEAN:
        return
    reached = pull.reached(state)
    if abs(reached - pull.amount) > _NEARLY * abs(pull.amount):
        yield (
            f"{where} came {1e3 * reached:.1f} mm along the normal where {1e3 * pull.amount:.1f} "
            f"mm were asked{_what_held(state, pull)}"
        )


def _what_held(state: HullState, pull: Pull) -> str:
    """Say why a point did not come where it was pulled, and what to do."""
    driver = int(state.rows.driver.data[pull.row])
    if driver < 0 and _slides(state, pull):
        return (
            ": it is free almost along the hull only, so it stays and dents the hull; make it "
            "watched (edit.set_role), or pull another point"
        )
    name = "" if driver < 0 else f", {state.lines.name.data[state.line_of(driver)]} drives it"
    return (
        f"{name}: placed points, ends and flats beside it stay; pull one of the points that can "
        "move, by less, or with another radius"
    )


def _slides(state: HullState, pull: Pull) -> bool:
    """Tell whether fields leave the pulled point alone, as the hull was or as it is now."""
    if state.rows.sort.data[pull.row] != Sort.CROSSING:
        return False
    if state.rows.role.data[pull.row] == Role.WATCHED:
        return False
    normal = np.stack([pull.normal, hull_normals(state)[pull.row]])
    along = free_normals(state, np.array([pull.row, pull.row]), normal)
    least = float(np.sqrt((along * along).sum(axis=1)).min())
    return least < state.tolerances.field_normal
