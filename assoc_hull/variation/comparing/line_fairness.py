"""How fair the lines of a varied net are beside those of its parent, line by line.

A line is measured before and after: an edit changes the hull in place, so the parent is
measured first. Two numbers count: how often its curvature changes sign beyond a dead band,
and the integral of the squared slope of its curvature comb, of which the ratio is told.

Examples
--------
>>> import assoc_hull as ah
>>> from assoc_hull.variation.comparing.line_fairness import compare_fairness, measure_fairness
>>> hull = ah.examples.wigley()
>>> parent = measure_fairness(hull.document.state)
>>> with hull.edit("10 % broader") as edit:
...     edit.transform(scale=[1, 1.1, 1], drivers=["sections", "profile"])
>>> table = compare_fairness(parent, measure_fairness(hull.document.state, like=parent))
>>> table.added
0
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cached_property

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import CurveData, FloatArray, IntArray, PointKind, SplineBatch
from assoc_hull.geometry.fairness.combs import (
    DEAD_BAND,
    comb_integrals,
    sampled_curvatures,
)
from assoc_hull.geometry.splines.arc_length import arc_length
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.model.network import curve_data
from assoc_hull.model.tables import HullState

__all__ = [
    "FairnessChange",
    "FairnessComparison",
    "ImagedLines",
    "LineFairness",
    "comb_within",
    "compare_fairness",
    "measure_fairness",
]

_WAVE = 2e-3
"""m: height of one wave along a line that nobody sees, as far as a driver may leave its image by
default; of a hull under 100 m in proportion less."""

_VIEWS = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
"""A curve in space is seen from the side and from above; what both show is added."""


@attrs.frozen(eq=False)
class LineFairness:
    """One line as it is.

    Attributes
    ----------
    key, name : str
        The line.
    views : (v, 3)
        Unit normals of the planes in which it is seen: its own, or two for a line in space.
    sign_changes : int
        Changes of sign of the curvature of all its curves, beyond the dead band.
    comb : float, 1/m3
        Integral of (dk/ds)^2 ds over all its curves.
    greatest : float, 1/m
        Greatest curvature.
    length : float, m
        Of all its curves.
    border : bool
        Whether it is a boundary curve: an end of the hull, the border of a flat, a knuckle line.
    wave : float, m
        Height of one wave along it that nobody sees.
    """

    key: str
    name: str
    views: FloatArray
    sign_changes: int
    comb: float
    greatest: float
    length: float
    border: bool = False
    wave: float = _WAVE

    @property
    def is_straight(self) -> bool:
        """Tell whether its curvature stays within the dead band."""
        return self.greatest <= DEAD_BAND

    @property
    def least_comb(self) -> float:
        """Comb integral, 1/m3, below which nobody sees any: that of one wave."""
        if not self.length:
            return 0.0
        return 0.5 * self.wave**2 * (2.0 * math.pi / self.length) ** 6 * self.length


@attrs.frozen(eq=False)
class FairnessChange:
    """A line before and after a variation."""

    before: LineFairness
    after: LineFairness

    @property
    def name(self) -> str:
        """Name of the line."""
        return self.before.name

    @property
    def added(self) -> int:
        """Changes of sign that the variation added; negative if it took some away."""
        return self.after.sign_changes - self.before.sign_changes

    @property
    def changed(self) -> bool:
        """Tell whether the shape of the line has changed at all."""
        return self.before.comb != self.after.comb or self.added != 0

    @property
    def comb_ratio(self) -> float:
        """Comb integral varied / parent; nan where both are straight within the dead band.

        Combs that nobody sees count as the least that is seen: the parent's may be rounding alone.
        """
        if self.before.is_straight and self.after.is_straight:
            return float("nan")
        before, after = (max(each.comb, each.least_comb) for each in (self.before, self.after))
        if before == 0.0:
            return 1.0 if after == 0.0 else float("inf")
        return after / before

    @property
    def shape_ratio(self) -> float:
        """The same of the line at the size that it had in the parent.

        A section of a bulb that becomes half as large has eight times the comb and is as fair.
        """
        if not self.before.length:
            return self.comb_ratio
        return self.comb_ratio * (self.after.length / self.before.length) ** 3


_SLIGHT = 10.0
"""A comb, at the size of its line, that is hardly seen: that of two waves whose height is a five
hundredth of the length."""


def _comb_at_size(line: LineFairness) -> float:
    """Give the comb integral of a line as if it were 1 m long: no size counts in it."""
    return line.comb * line.length**3


@attrs.frozen(eq=False)
class FairnessComparison:
    """The lines that both hulls have, in the order of the parent's.

    Attributes
    ----------
    lines : tuple of FairnessChange
        Line by line.
    """

    lines: tuple[FairnessChange, ...]

    @property
    def changed(self) -> tuple[FairnessChange, ...]:
        """The lines whose shape has changed."""
        return tuple(line for line in self.lines if line.changed)

    @property
    def before(self) -> int:
        """Changes of sign in the parent, over the lines that have changed."""
        return sum(line.before.sign_changes for line in self.changed)

    @property
    def after(self) -> int:
        """Changes of sign in the varied hull, over the same lines."""
        return sum(line.after.sign_changes for line in self.changed)

    @property
    def added(self) -> int:
        """Changes of sign added, over all lines together."""
        return self.after - self.before

    @property
    def median(self) -> float:
        """Median of the comb ratios of lines that have changed; 1 if none has one."""
        ratios = self._ratios
        return float(np.median(ratios)) if len(ratios) else 1.0

    @property
    def worst(self) -> float:
        """Greatest comb ratio of the lines that have changed; 1 if none has one."""
        ratios = self._ratios
        return float(ratios.max()) if len(ratios) else 1.0

    @property
    def _ratios(self) -> FloatArray:
        ratios = np.array([line.comb_ratio for line in self.changed], np.float64)
        return ratios[~np.isnan(ratios)]

    @property
    def worst_shape(self) -> float:
        """Greatest `shape_ratio` of the lines that have changed; 1 if none has one."""
        ratios = [line.shape_ratio for line in self.changed]
        return max((each for each in ratios if not np.isnan(each)), default=1.0)

    @property
    def unfairness(self) -> tuple[tuple[FairnessChange, float], ...]:
        """Give the lines that have changed, each with how much sharper its comb has become.

        That is at the size that the line had, in parts of its own comb or, where that is nearly
        straight, of a slight one: what nobody sees is not made large by a division. A long border,
        as a profile that is straight so far, may bend at its end as other lines do.
        """
        combs = [line.before.comb for line in self.lines if not line.before.border]
        usual = float(np.median([comb for comb in combs if comb > 0.0] or [0.0]))
        return tuple(
            (line, _comb_at_size(line.after) / max(
                _comb_at_size(line.before), _SLIGHT,
                usual * line.before.length**3 if line.before.border else 0.0,
            ))
            for line in self.changed
        )  # fmt: skip

    @property
    def worst_line(self) -> FairnessChange | None:
        """The line with the greatest comb ratio, the first of equals; None if none has one."""
        told = [line for line in self.changed if not np.isnan(line.comb_ratio)]
        return max(told, key=lambda line: line.comb_ratio, default=None)


@attrs.frozen(eq=False)
class ImagedLines:
    """Lines of a hull at places close together, of which a map is judged before it is carried.

    Attributes
    ----------
    lines : tuple of LineFairness
        What they are named; their numbers are those of the hull as it is drawn.
    owner : (m,) int
        To which of them each curve belongs, once for each of its views.
    views : (m, 3)
        Normals of the planes in which the curves are seen.
    close : CurveData
        The curves at places close together.
    """

    lines: tuple[LineFairness, ...]
    owner: IntArray
    views: FloatArray
    close: CurveData

    @classmethod
    def of(cls, state: HullState) -> ImagedLines:
        """Take all lines of a hull."""
        lines = tuple(measure_fairness(state).values())
        place = {line.key: i for i, line in enumerate(lines)}
        seen = [
            (place[key], state.spline(curve), view)
            for line in state.live("lines").tolist() if (key := str(state.lines.key[line])) in place
            for curve in state.curves_of(line) for view in lines[place[key]].views
        ]  # fmt: skip
        batch = SplineBatch.join([spline for _, spline, _ in seen])
        chords = int(np.clip(_PLACES // len(batch.knot), 1, _CLOSE))
        owner = np.array([line for line, _, _ in seen])
        return cls(lines, owner, np.array([view for *_, view in seen]), _close(batch, chords))

    @cached_property
    def before(self) -> Mapping[str, LineFairness]:
        """The lines as they are, drawn through the places close together as images are."""
        return self._drawn(self.close.xyz)

    def compared(self, move: Callable[[FloatArray], FloatArray]) -> FairnessComparison:
        """Compare the images of the lines under a map with the lines."""
        return compare_fairness(self.before, self._drawn(move(self.close.xyz)))

    def _drawn(self, xyz: FloatArray) -> Mapping[str, LineFairness]:
        batch = loft(attrs.evolve(self.close, xyz=xyz))
        lengths = np.zeros(len(self.lines))
        np.add.at(lengths, self.owner, arc_length(batch))
        found = _summed(batch, self.views, self.owner, DEAD_BAND)
        return {
            line.key: attrs.evolve(
                line, sign_changes=each[0], comb=each[1], greatest=each[2],
                length=length / len(line.views),
            )
            for line, each, length in zip(self.lines, found, lengths.tolist(), strict=True)
        }  # fmt: skip


_CLOSE = 4
"""Chords at most that stand for a segment of a line whose image is judged."""

_PLACES = 4000
"""In nets of more places segments are short: fewer chords will do."""

_TURNS = 1e-9
"""Unit derivatives beside a point that differ by more turn there."""


def _close(batch: SplineBatch, chords: int) -> CurveData:
    """Give curves through places close together that turn where the splines do."""
    start, xyz = sample(batch, chords)
    kind = np.zeros(len(xyz), np.int8)
    for i in range(batch.count):
        mine = slice(int(batch.start[i]), int(batch.start[i + 1]))
        turns = (np.abs(batch.leave[mine] - batch.arrive[mine]) > _TURNS).any(axis=1)
        kind[int(start[i]) : int(start[i + 1]) : chords][turns] = int(PointKind.KNUCKLE)
    none = np.zeros((batch.count, 2), np.int8)
    return CurveData(start, xyz, kind, np.zeros_like(xyz), none, np.zeros((batch.count, 2, 3)))


def measure_fairness(
    state: HullState,
    lines: Iterable[int] | None = None,
    *,
    like: Mapping[str, LineFairness] | None = None,
    band: float = DEAD_BAND,
) -> dict[str, LineFairness]:
    """Measure lines of a net.

    Parameters
    ----------
    state : HullState
        The tables of the hull.
    lines : iterable of int or None
        Numbers of lines; all live ones if None.
    like : mapping of str to LineFairness or None
        The parent's lines by key: a line that it has is seen in the same planes, so that one
        which was bent out of its plane is judged as it was.
    band : float, 1/m
        The dead band.

    Returns
    -------
    dict of str to LineFairness
        By key of the line, in the order given; lines without a shape are left out.

    Raises
    ------
    BadInputError
        No such line, or a negative band.
    """
    table = state.lines
    wanted = state.live("lines").tolist() if lines is None else [int(line) for line in lines]
    for line in wanted:
        # A negative number would count from the end of the table.
        if not 0 <= line < table.count or not table.alive[line]:
            what = f"there is no line {line}"
            raise BadInputError(what, "in measure_fairness", "give numbers of live lines")
    curves = [(line, curve) for line in wanted for curve in state.curves_of(line)]
    # Lines without curves go: the sums come one for each line that has some.
    wanted = list(dict.fromkeys(line for line, _ in curves))
    views = {line: _views(state, line, like or {}) for line in wanted}
    seen = [(line, curve, view) for line, curve in curves for view in views[line]]
    # An empty list of splines cannot be joined.
    if not seen:
        return {}
    batch = SplineBatch.join([state.spline(curve) for _, curve, _ in seen])
    normals = np.array([view for _, _, view in seen])
    place = {line: i for i, line in enumerate(wanted)}
    owner = np.array([place[line] for line, _, _ in seen])
    found = _summed(batch, normals, owner, band)
    lengths = np.bincount(owner, arc_length(batch))
    return {
        str(table.key[line]): LineFairness(
            str(table.key[line]), str(table.name[line]), views[line], *each, length,
            bool(table.boundary[line] >= 0), _WAVE * state.tolerances.factor,
        )
        for line, each, length in zip(wanted, found, lengths.tolist(), strict=True)
    }  # fmt: skip


def comb_within(
    state: HullState, line: LineFairness, tolerance: float, enough: float = 0.0
) -> float:
    """Give the least comb integral, 1/m3, of a line drawn through fewer of its points.

    None of the others may be left by more than a tolerance, m. Two points some millimetres apart
    bend a line sharply though it moves by less than a pencil's breadth; through one of them it is
    the same line to the eye. At most `enough` is as good as the least.
    """
    number = next(i for i in state.live("lines").tolist() if state.lines.key[i] == line.key)
    found = 0.0
    for curve in state.curves_of(number):
        data, made = curve_data(state, np.array([curve])), state.spline(curve)
        best = _seen_comb(made, line.views)
        # A curve that is made by more than its points stays what it is.
        if np.allclose(_seen_comb(loft(data), line.views), best, rtol=1e-6, atol=0.0):
            for each in _thinner(data, tolerance):
                best = min(best, _seen_comb(loft(each), line.views))
                if found + best <= enough:
                    break
        found += best
    return found


def _seen_comb(spline: SplineBatch, views: FloatArray) -> float:
    """Give the comb integral of a curve, summed over the planes in which it is seen."""
    return float(comb_integrals(SplineBatch.join([spline] * len(views)), views).sum())


def _thinner(data: CurveData, tolerance: float) -> Iterator[CurveData]:
    """Give a curve through one point less each time, as long as it stays within a tolerance."""
    keep = _one_less(data, np.ones(len(data.xyz), np.bool_), tolerance)
    while keep is not None:
        yield data.through(keep)
        keep = _one_less(data, keep, tolerance)


def _one_less(
    data: CurveData, keep: NDArray[np.bool_], tolerance: float
) -> NDArray[np.bool_] | None:
    """Leave out the point nearest to a neighbour that may go; None where none may."""
    rows = np.flatnonzero(keep)
    step = np.sqrt((np.diff(data.xyz[rows], axis=0) ** 2).sum(axis=1))
    for i in np.argsort(np.minimum(step[:-1], step[1:]), kind="stable").tolist():
        row = rows[i + 1]
        if data.kind[row] != PointKind.SMOOTH:
            continue
        fewer = keep.copy()
        fewer[row] = False
        _, _, away = closest_points(loft(data.through(fewer)), 0, data.xyz[~fewer])
        if away.max() <= tolerance:
            return fewer
    return None


def _summed(
    batch: SplineBatch, normals: FloatArray, owner: IntArray, band: float
) -> list[tuple[int, float, float]]:
    """Give sign changes, comb integral and greatest curvature of each line."""
    bends = sampled_curvatures(batch, normals)
    changes = np.bincount(owner, bends.sign_changes(band)).astype(np.int64)
    comb = np.bincount(owner, comb_integrals(batch, normals))
    greatest = np.zeros(len(comb))
    np.maximum.at(greatest, owner, bends.greatest())
    return list(zip(changes.tolist(), comb.tolist(), greatest.tolist(), strict=True))


def _views(state: HullState, line: int, like: Mapping[str, LineFairness]) -> FloatArray:
    """Give the normals of the planes in which a line is seen."""
    parent = like.get(str(state.lines.key[line]))
    if parent is not None:
        return parent.views
    if not state.lines.planar[line]:
        return _VIEWS
    normal: FloatArray = state.lines.normal[line][None].copy()
    return normal


def compare_fairness(
    parent: Mapping[str, LineFairness], varied: Mapping[str, LineFairness]
) -> FairnessComparison:
    """Put the lines of a parent and of a varied hull side by side.

    Parameters
    ----------
    parent, varied : mapping of str to LineFairness
        What `measure_fairness` gives of them.

    Returns
    -------
    FairnessTable
        The lines that both have.
    """
    return FairnessComparison(
        tuple(FairnessChange(line, varied[key]) for key, line in parent.items() if key in varied)
    )
