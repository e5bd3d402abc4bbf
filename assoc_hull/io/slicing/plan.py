"""A piece of a line split at its features, with a smooth curve fitted to each stretch."""

from __future__ import annotations

from itertools import pairwise

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.polylines.operations import arc_length
from assoc_hull.geometry.polylines.smooth import Fitted, Smooth, fit_line, straight
from assoc_hull.geometry.polylines.straight import Run
from assoc_hull.io.lines.slices import AXES
from assoc_hull.io.slicing.features import FeatureRules, PieceFeatures, plane_columns
from assoc_hull.io.slicing.runs import is_known, runs_of

__all__ = ["Break", "Plan", "Stretch", "in_space", "piece_columns", "piece_plane", "plan_piece"]


@attrs.frozen(eq=False)
class Break:
    """A place where a piece is split; no direction at a corner."""

    at: float
    place: FloatArray
    direction: FloatArray | None


@attrs.frozen(eq=False)
class Stretch:
    """Part of a piece between two breaks.

    Attributes
    ----------
    ends : (2, d), m
        Its first and last place.
    fitted : Fitted or None
        The smooth curve, None where it is straight.
    """

    ends: FloatArray
    fitted: Fitted | None

    def draw(self) -> Smooth:
        """Give the curve as points."""
        return straight(self.ends, 5) if self.fitted is None else self.fitted.draw()


@attrs.frozen(eq=False)
class Plan:
    """A piece with its breaks and the curves between them.

    Attributes
    ----------
    part : PieceFeatures
        The piece.
    breaks : tuple of Break
        In order along it.
    runs : tuple of Run
        Straight runs.
    stretches : tuple of Stretch
        One more than breaks.
    """

    part: PieceFeatures
    breaks: tuple[Break, ...]
    runs: tuple[Run, ...]
    stretches: tuple[Stretch, ...]


def plan_piece(part: PieceFeatures, rules: FeatureRules | None = None) -> Plan:
    """Split a piece at its features and fit a smooth curve to each stretch.

    Parameters
    ----------
    part : PieceFeatures
        The piece.
    rules : FeatureRules or None
        Defaults if None.
    """
    wanted = rules or FeatureRules()
    breaks = [Break(corner.at, corner.place, None) for corner in part.corners]
    runs = runs_of(part, wanted)
    breaks += [
        Break(onset.at, onset.place, run.direction)
        for run in runs
        for onset in (run.before, run.after)
        if is_known(onset, part.noise, wanted)
    ]
    breaks = _apart(breaks, float(arc_length(part.points)[-1]))
    drawn = [
        (run.begin if run.before.kind == "end" else run.before.at, run.after.at)
        for run in runs
        if run.before.kind != "gradual" and run.after.kind != "gradual"
    ]
    stretches = tuple(_stretches(part, breaks, drawn))
    return Plan(part, tuple(breaks), runs, stretches)


def _stretches(
    part: PieceFeatures, breaks: list[Break], drawn: list[tuple[float, float]]
) -> list[Stretch]:
    """Fit a smooth curve between the breaks, none where the piece is straight."""
    points, at = part.points, arc_length(part.points)
    ends = [Break(0.0, points[0], None), *breaks, Break(float(at[-1]), points[-1], None)]
    found = []
    for low, high in pairwise(ends):
        inside = (at > low.at + 1e-3) & (at < high.at - 1e-3)
        mine = np.concatenate([low.place[None], points[inside], high.place[None]])
        allowed = np.interp([low.at, *at[inside], high.at], at, part.allowed)
        if any(a - 0.05 <= low.at and high.at <= b + 0.05 for a, b in drawn):
            fitted = None
        else:
            fitted = fit_line(mine, allowed, low.direction, high.direction)
        found.append(Stretch(mine[[0, -1]], fitted))
    return found


def _apart(breaks: list[Break], length: float) -> list[Break]:
    """Leave out breaks at the ends and tangent points that lie close to another break."""
    out: list[Break] = []
    for each in sorted(breaks, key=lambda b: (b.direction is not None, b.at)):
        clear = all(abs(each.at - other.at) > 0.3 for other in out)
        if clear and 0.3 < each.at < length - 0.3:
            out.append(each)
    return sorted(out, key=lambda b: b.at)


def piece_columns(part: PieceFeatures) -> list[int]:
    """Give the coordinates in which the points of a piece are given."""
    if part.line.group != "boundary":
        return plane_columns(part.line.group)
    if part.points.shape[1] == 3:
        return [0, 1, 2]
    flat = int(np.argmin(np.ptp(part.piece.points, axis=0)))
    return [axis for axis in range(3) if axis != flat]


def in_space(part: PieceFeatures, xy: FloatArray) -> FloatArray:
    """Give places of a piece in space, (n, 3), m."""
    columns = piece_columns(part)
    out = np.empty((len(xy), 3))
    out[:, columns] = xy
    for axis in set(range(3)) - set(columns):
        out[:, axis] = _level(part, axis)
    return out


def _level(part: PieceFeatures, axis: int) -> float:
    """Give the place of the plane of a piece."""
    if part.line.group != "boundary":
        return part.line.offset
    level = round(float(np.median(part.piece.points[:, axis])), 6)
    return level + 0.0


def piece_plane(part: PieceFeatures) -> tuple[FloatArray, float] | None:
    """Give the normal of the plane of a piece and its place along it, None for one in space."""
    if part.line.group != "boundary":
        return np.eye(3)[AXES[part.line.group]], part.line.offset
    if part.points.shape[1] == 3:
        return None
    axis = next(iter(set(range(3)) - set(piece_columns(part))))
    return np.eye(3)[axis], _level(part, axis)
