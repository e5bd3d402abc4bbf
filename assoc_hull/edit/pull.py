"""The soft pull: one point is drawn along the hull's normal, its surroundings follow."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.edit.arguments import pair
from assoc_hull.edit.field import FieldContext, Shift, bell, context, move_normal, row_spacing
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import PointRoleError
from assoc_hull.geometry.curves import FloatArray, IntArray

__all__ = ["Pull", "pull"]


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


def pull(
    edit: Transaction,
    row: int,
    amount: float,
    radius: tuple[float, float] | None = None,
    *,
    across_flats: bool = False,
) -> None:
    """Ask for a soft pull.

    Parameters
    ----------
    edit : Transaction
        The edit.
    row : int
        The point; it may also be a driven or watched one.
    amount : float, m
        Along the outward normal.
    radius : (float, float) or None, m
        Along the length and the girth; three spacings of the points there if None.
    across_flats : bool
        Whether the field may move flats.

    Raises
    ------
    BadInputError
        A radius that is not positive, an amount that is not finite.
    PointRoleError
        The point lies on a flat, or on the profile.
    """
    state = edit.state
    place = state.rows.xyz.data[row].copy()
    if radius is None:
        reach = (3.0 * row_spacing(state, place), 3.0 * row_spacing(state, place))
    else:
        reach = pair(radius, "radius", positive=True)
    ground = context(state, across_flats=across_flats)
    border = _border_distance(ground, row)
    if border is None:
        raise PointRoleError(
            state.rows.key.data[row],
            "on a flat or on the profile, or its normal is not known",
            None,
            "move the border curve, or pull with across_flats=True",
        )
    fade = min(reach[1], border)
    edit.pending.fields.append(Pull(row, place, amount, reach, fade, across_flats))


def _border_distance(ground: FieldContext, row: int) -> float | None:
    """Give the distance of a point from the next flat; None if it cannot be pulled."""
    if not (ground.normal[row] != 0.0).any():
        return None
    at = np.flatnonzero(ground.free == row)
    if len(at):
        return float(ground.flat_distance[at[0]])
    xyz = ground.state.rows.xyz.data
    if ground.state.rows.driver.data[row] < 0 and not np.isfinite(ground.state.rows.gap.data[row]):
        return None
    step = xyz[ground.free] - xyz[row]
    nearest = int(np.argmin((step * step).sum(axis=1)))
    return float(ground.flat_distance[nearest])
