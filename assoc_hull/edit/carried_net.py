"""What a map of the whole hull leaves to the update, and the nudge that keeps its structure.

A nudge: all points of a hull move by a little that is known, its structure stays.

A transformation finds anew which points a line needs; so its result is no smooth function of the
mapping. A nudge moves the points that there are, with the planes of their lines, by given
displacements. What is computed from curves follows, and no point comes or goes.
"""

from __future__ import annotations

from collections.abc import (
    Callable,
    Iterable,
    Mapping,
    Sequence,
)
from typing import Protocol

import attrs
import numpy as np

from assoc_hull.edit.crossings.adopted_points import link_adopted_points
from assoc_hull.edit.mapped_planes import TransformedPlanes, snap_into_planes
from assoc_hull.edit.modification import Modification, Pending, Work
from assoc_hull.edit.space_map import CarriedFeatures
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import (
    EndKind,
    FloatArray,
    IntArray,
    freeze,
)
from assoc_hull.graph.journal import Journal
from assoc_hull.model.features import Feature
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.tables import Ends, HullState, Particulars

__all__ = [
    "CarriedNet",
    "Nudge",
    "Nudged",
    "nudge",
    "nudged",
    "relink_adopted_points",
    "write_nudge",
]


@attrs.define(eq=False)
class CarriedNet(Modification):
    """What is done to a net that a mapping carries when its main pass has run.

    Attributes
    ----------
    relink : set of int
        Curves whose adopted points ride from where they and their neighbours are then.
    after : list of callable
        What is done to the structure then.
    """

    relink: set[int] = attrs.field(factory=set)
    after: list[Callable[[], None]] = attrs.field(factory=list)

    @property
    def idle(self) -> bool:
        """Whether nothing is to be done."""
        return not (self.relink or self.after)

    def follow(self, work: Work) -> None:
        """Link adopted points anew, and run a second pass for lines that come back."""
        relink_adopted_points(work, self.relink)
        if not self.after:
            return
        pending = work.pending
        pending.curves.clear()
        for act in self.after:
            act()
        work.link_riders()
        work.renew()
        live = [curve for curve in sorted(pending.curves) if work.state.curves.alive[curve]]
        work.go(np.zeros(0, np.int64), np.array(live, np.int64))
        work.settle()


def relink_adopted_points(work: Work, curves: Iterable[int]) -> None:
    """Let adopted points that were carried ride from where they and their neighbours are now."""
    chosen = np.array(sorted(curves), np.int64)
    chosen = chosen[work.state.curves.alive[chosen]]
    link_adopted_points(work.state, chosen, work.journal)
    if len(chosen):
        work.renew()
    work.pending.held.clear()


@attrs.frozen(eq=False)
class Nudge:
    """By how much everything of a hull moves.

    Attributes
    ----------
    move : (rows, 3), m
        Displacements of all points of the tables; those of computed and watched points are not
        read.
    turn : (rows, 3, 3)
        At each point: a given direction t becomes t + turn t. Zero along the normals of the planes
        that the direction must stay in.
    level : (lines,), m
        By how much the planes of lines move along their normals; zero for curves in space.
    features : mapping of str to mapping of str to float or (3,)
        By the keys of features, what is added to ``centre``, ``radius`` and ``offset`` (m).
    particulars : Particulars
        Those of the hull afterwards.
    within : float, m
        How far points of features may come to lie off them.
    """

    move: FloatArray
    turn: FloatArray
    level: FloatArray
    features: Mapping[str, Mapping[str, FloatArray]]
    particulars: Particulars
    within: float

    def __attrs_post_init__(self) -> None:
        freeze(self.move, self.turn, self.level)


@attrs.define(eq=False)
class Nudged(Modification):
    """A nudge that an edit asks for."""

    by: Nudge | None = None

    @property
    def idle(self) -> bool:
        """Whether there is none."""
        return self.by is None

    def finish(self, work: Work) -> bool:
        """Move the hull as it has become by a little, and let what is computed follow."""
        if self.by is None:
            return False
        pending, state = work.pending, work.state
        curves = state.live("curves")
        carried = pending.features or CarriedFeatures(state.features, frozenset(), self.by.within)
        rows, moved = write_nudge(state, work.journal, self.by, carried.features)
        pending.features = attrs.evolve(carried, features=moved)
        live = state.live("rows")
        pending.held |= set(live[state.rows.sort[live] == Sort.ADOPTED].tolist())
        pending.computed |= set(live[state.rows.driver[live] >= 0].tolist())
        work.renew()
        work.go(rows, curves)  # gaps have been mended: points are all there
        work.settle()
        relink_adopted_points(work, curves.tolist())
        return True


class _Edit(Protocol):
    """What `nudge` needs of a `Transaction`, whose update imports this module."""

    @property
    def name(self) -> str: ...
    @property
    def pending(self) -> Pending: ...
    @property
    def journal(self) -> Journal: ...


def nudge(edit: _Edit, by: Nudge) -> None:
    """Move a hull by a little when all else of an edit has run.

    Parameters
    ----------
    edit : Transaction
        The edit: empty, or with a transformation in it.
    by : Nudge
        What moves, for the tables as they are then.

    Raises
    ------
    BadInputError
        Something else but a transformation is in the edit.
    """
    pending = edit.pending
    others = pending.values or pending.displaces or pending.curves or edit.journal.entries
    if pending.asked(Nudged) is not None or (others and not pending.alone):
        raise BadInputError(*pending.not_alone(edit.name))
    pending.alone, pending.ask(Nudged).by = True, by


def write_nudge(
    state: HullState, journal: Journal, by: Nudge, features: Sequence[Feature]
) -> tuple[IntArray, tuple[Feature, ...]]:
    """Write the new places, planes and directions.

    Parameters
    ----------
    state : HullState
        The tables.
    journal : Journal
        Takes every write.
    by : Nudge
        What moves.
    features : sequence of Feature
        As they are before.

    Returns
    -------
    (k,) int
        The points that were moved.
    tuple of Feature
        The features afterwards.

    Raises
    ------
    BadInputError
        The tables are others than those that the nudge is for.
    """
    if len(by.move) != state.rows.count or len(by.level) != state.lines.count:
        raise BadInputError(
            f"a nudge of {len(by.move)} points for a hull of {state.rows.count}", "in nudge",
            "carry the hull in full",
        )  # fmt: skip
    planes, rows = _planes(state, by.level), nudged(state)
    rows = rows[by.move[rows].any(axis=1)]
    lines = np.flatnonzero(by.level != 0.0)
    journal.put(state.lines.offset, lines, planes.offset[lines])
    places = snap_into_planes(state, planes, rows, state.rows.xyz[rows] + by.move[rows])
    journal.put(state.rows.xyz, rows, places)
    _turn_points(state, journal, by.turn)
    _turn_ends(state, journal, by.turn)
    if by.particulars != state.particulars:
        journal.set(state.settings.particulars, [0], [by.particulars])
    return rows, tuple(_moved(each, by.features.get(each.key, {})) for each in features)


def nudged(state: HullState) -> IntArray:
    """Give the points that a nudge moves by itself: they are alive, and not computed."""
    table = state.rows
    watched = (table.sort.data == Sort.CROSSING) & (table.role.data == Role.WATCHED)
    return np.flatnonzero(table.alive.data & (table.driver.data < 0) & ~watched)


def _planes(state: HullState, level: FloatArray) -> TransformedPlanes:
    lines = state.lines
    return TransformedPlanes(lines.normal.data, lines.offset.data + level, lines.planar.data, {})


def _turn_points(state: HullState, journal: Journal, turn: FloatArray) -> None:
    """Turn the directions that are given at points."""
    table = state.rows
    turned = table.alive.data & turn.any(axis=(1, 2))
    rows = np.flatnonzero(turned & table.direction.data.any(axis=(1, 2)))
    old = table.direction[rows]
    journal.put(table.direction, rows, old + np.einsum("nij,nsj->nsi", turn[rows], old))


def _turn_ends(state: HullState, journal: Journal, turn: FloatArray) -> None:
    """Turn the tangents that are given at the ends of curves."""
    for curve in state.live("curves").tolist():
        ends: Ends = state.curves.ends[curve]
        if EndKind.TANGENT not in ends.kind:
            continue
        rows = state.curves.rows[curve][[0, -1]]
        old = np.array(ends.vector)
        tangent = np.array(ends.kind) == EndKind.TANGENT
        new = old + np.where(tangent[:, None], np.einsum("nij,nj->ni", turn[rows], old), 0.0)
        if (new != old).any():
            start, finish = (tuple(each) for each in new.tolist())
            journal.set(state.curves.ends, [curve], [Ends(ends.kind, (start, finish))])


def _moved(feature: Feature, by: Mapping[str, FloatArray]) -> Feature:
    """Give a feature with what is added to its numbers."""
    new = {name: np.asarray(getattr(feature, name)) + step for name, step in by.items()}
    return attrs.evolve(feature, **{name: each.tolist() for name, each in new.items()})
