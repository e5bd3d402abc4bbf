"""Runs that an edit draws: whether the hull has taken them, and the features that they are.

A run is asked for as places of points, kinds and a field. What an update does besides (a crossing
that comes, a gap that is mended) may put a point beside it: that refuses the edit.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import attrs
import numpy as np

from assoc_hull.edit.followup.features import circle_side, drawn_feature
from assoc_hull.edit.modification import Modification, Work
from assoc_hull.geometry.curves import IntArray
from assoc_hull.geometry.polylines.drawn_run import DrawnRun
from assoc_hull.model.address import address
from assoc_hull.model.features import Feature
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.tables import HullState

__all__ = ["AskedRun", "DrawnRuns", "features_on", "points_between"]

_ON = 1e-9
"""Times `Tolerances.factor`: points of a run lie on it within this (m)."""

_SHORTEST = 1e-3
"""A straight run of this part of the length of the ship is a feature."""


@attrs.frozen(eq=False)
class AskedRun:
    """A run that is asked for.

    Attributes
    ----------
    curve : int
        Its curve.
    breaks : tuple of int
        The points at which its straight pieces and its arc begin and end, in order.
    arc : int
        Which piece is the arc; -1 of a straight run.
    drawn : DrawnRun
        Its shape.
    """

    curve: int
    breaks: tuple[int, ...]
    arc: int
    drawn: DrawnRun


@attrs.define(eq=False)
class DrawnRuns(Modification):
    """The runs of an edit."""

    runs: list[AskedRun] = attrs.field(factory=list)

    @property
    def idle(self) -> bool:
        """Whether there is none."""
        return not self.runs

    def check(self, work: Work) -> Iterable[str]:
        """Say which point lies off its run."""
        for run in self.runs:
            yield from _off_run(work.state, run)

    def finish(self, work: Work) -> bool:
        """Make the features; the points have come to stay."""
        state = work.state
        for run in self.runs:
            for number, (first, last) in enumerate(zip(run.breaks, run.breaks[1:], strict=False)):
                rows = points_between(state, run.curve, first, last)
                made = _feature(state, run, number, rows)
                if made is not None:
                    Maker(state, work.journal).features([*state.features, made])
        return False


def points_between(state: HullState, curve: int, first: int, last: int) -> IntArray:
    """Give the points of a curve from one to another, both included; none if one has gone."""
    rows: IntArray = state.curves.rows[curve]
    found = [np.flatnonzero(rows == row) for row in (first, last)]
    if not all(len(at) for at in found):
        return rows[:0]
    return rows[found[0][0] : found[1][0] + 1]


def _off_run(state: HullState, run: AskedRun) -> Iterator[str]:
    rows = points_between(state, run.curve, run.breaks[0], run.breaks[-1])
    title = state.lines.name[state.line_of(run.curve)]
    if not len(rows):
        yield f"{title}: an end of the run has gone; draw it between other points"
        return
    off = run.drawn.off(state.rows.xyz[rows])
    worst = int(off.argmax())
    if off[worst] > _ON * state.tolerances.factor:
        name = address(state, int(rows[worst]))
        yield (
            f"{name} came to lie {1e3 * off[worst]:.3g} mm off the run of {title}: another "
            "change of the edit holds it, or what crosses there does not follow so far; draw the "
            "run in an edit of its own, shorter, or nearer to the line"
        )


def _feature(state: HullState, run: AskedRun, number: int, rows: IntArray) -> Feature | None:
    """Give the feature of one piece; None of a straight one that is too short for one."""
    xyz, drawn = state.rows.xyz[rows], run.drawn
    if number != run.arc:
        chord = xyz[-1] - xyz[0]
        short = float(np.sqrt((chord * chord).sum())) < _SHORTEST * state.particulars.length
        return None if short else drawn_feature(state, run.curve, "straight", rows)
    normal = state.lines.normal[state.line_of(run.curve)]
    return drawn_feature(
        state, run.curve, "arc", rows, centre=drawn.centre.tolist(), radius=drawn.radius,
        normal=normal.tolist(), side=circle_side(xyz, drawn.centre, normal),
    )  # fmt: skip


def features_on(state: HullState, curve: int, rows: Sequence[int]) -> list[Feature]:
    """Give the features of a curve's line that own one of some points."""
    key = state.lines.key[state.line_of(curve)]
    return [each for each in state.features if key in each.lines and set(rows) & set(each.points)]
