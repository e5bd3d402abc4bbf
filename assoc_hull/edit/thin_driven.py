"""Driven crossings while a net is thinned: their values lie on the drivers as these are now."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from assoc_hull.edit.match import snap
from assoc_hull.edit.thin_work import Work
from assoc_hull.geometry.closest import closest
from assoc_hull.geometry.curves import IntArray, SplineBatch
from assoc_hull.geometry.spline import derivative, evaluate
from assoc_hull.model.family import Role

__all__ = ["follow_drivers"]

_STEPS = 3
_FAR = 0.5
"""A driven value does not go farther (m) than this from where the given lines meet."""

_MOVED = 1e-4
"""A value that moved by this (m) makes its curve be measured again."""


def follow_drivers(work: Work, roles: Sequence[Role], splines: SplineBatch) -> None:
    """Set the values of crossings that one curve drives to where that curve meets the plane.

    Parameters
    ----------
    work : Work
        Its values are set anew.
    roles : sequence of Role
        Of the contacts, then the meetings.
    splines : SplineBatch
        The curves as they are thinned so far.
    """
    state, meetings, first = work.net.state, work.net.meetings, len(work.net.contacts)
    driven = _driven(work, roles, splines)
    if not len(driven):
        return
    number, driver, curve = driven.T
    spots = np.array([meetings[i].spots[0] for i in number.tolist()])
    lines = np.array([state.line_of(each) for each in curve.tolist()])
    normal, offset = state.lines.normal.data[lines], state.lines.offset.data[lines]
    at = np.zeros(len(driven))
    for each in np.unique(driver).tolist():
        at[driver == each] = closest(splines, each, spots[driver == each])[0]
    for _ in range(_STEPS):
        slope = (derivative(splines, driver, at) * normal).sum(axis=1)
        height = (evaluate(splines, driver, at) * normal).sum(axis=1) - offset
        at = at - np.where(np.abs(slope) > 1e-3, height / np.where(slope == 0.0, 1.0, slope), 0.0)
    found = evaluate(splines, driver, at)
    for (i, first_curve, last_curve), xyz, spot in zip(driven.tolist(), found, spots, strict=True):
        if not np.abs(xyz - spot).max() < _FAR:
            continue
        value = snap(state, (state.line_of(first_curve), state.line_of(last_curve)), xyz)
        if np.abs(value - work.values.get(first + i, spot)).max() > _MOVED:
            work.held.pop(last_curve, None)
        work.values[first + i] = value


def _driven(work: Work, roles: Sequence[Role], splines: SplineBatch) -> IntArray:
    """Give meeting, driver and driven curve, (k, 3), where the driver has changed."""
    found = []
    dense = [source.dense for source in work.net.sources]
    for i, role in enumerate(roles[len(work.net.contacts) :]):
        a, b = work.net.meetings[i].a, work.net.meetings[i].b
        # A table gives the very place of a crossing: there the given value stands.
        if role in (Role.DRIVES_A, Role.DRIVES_B) and dense[a] and dense[b]:
            found.append((i, b, a) if role is Role.DRIVES_A else (i, a, b))
    drivers = sorted({driver for _, driver, _ in found})
    shape = {
        driver: splines.xyz[int(splines.start[driver]) : int(splines.start[driver + 1])].tobytes()
        for driver in drivers
    }
    changed = {driver for driver in drivers if work.followed.get(driver) != shape[driver]}
    work.followed.update(shape)
    fresh = [each for each in found if each[1] in changed or each[0] not in work.asked]
    work.asked.update(each[0] for each in found)
    return np.array(fresh, np.int64).reshape(-1, 3)
