"""What fairing did to a hull: the noise, the lines before and after, and what it did not do."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from typing import Any

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.flotation import (
    EvenKeelDisplacement,
    even_keel_displacement,
)
from assoc_hull.display import ShownAsText, counted
from assoc_hull.edit.hull_normals import hull_normals
from assoc_hull.edit.modifications.fair import BoundPoint, Faired
from assoc_hull.edit.net_battens import net_battens
from assoc_hull.edit.step import EditReport
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.fairness.inflections import LOBE, inflections
from assoc_hull.model.address import AddressBook
from assoc_hull.model.tables import HullState

__all__ = ["FairLine", "FairReport"]

_SHOWN = 10
"""So many lines and points are named."""

_FIRST = 5
"""So many points of a list in a note are named."""

_SUSPECT, _TOO_MUCH = 2.0, 3.0
"""Lines that look so many times noisier than was stated, or less noisy, are worth a note."""

_ALIKE = 5e-6
"""Lines that move by less (m) are counted only."""


_HEAD = f"{'line':16}{'|r| median mm':>16}{'largest mm':>18}{'inflections':>13}{'moved mm':>11}"


@attrs.frozen(repr=False)
class FairLine(ShownAsText):
    """A curve before and after fairing.

    Attributes
    ----------
    line : str
        Its name.
    residual_median, residual_largest : (float, float) or None, m
        How far a batten springs off its points, before and after; None where no point of it or
        beside it can move.
    inflections : (int, int)
        Changes of the sign of curvature, before and after.
    moved : float, m
        The largest movement of its points along the normal of the hull.
    """

    line: str
    residual_median: tuple[float, float] | None
    residual_largest: tuple[float, float] | None
    inflections: tuple[int, int]
    moved: float

    def __str__(self) -> str:
        cells = [
            "-" if pair is None else f"{1e3 * pair[0]:.2f} > {1e3 * pair[1]:.2f}"
            for pair in (self.residual_median, self.residual_largest)
        ]
        bends = f"{self.inflections[0]} > {self.inflections[1]}"
        return f"{self.line:16}{cells[0]:>16}{cells[1]:>18}{bends:>13}{1e3 * self.moved:11.2f}"


@attrs.frozen(eq=False, slots=False, repr=False)
class FairReport(ShownAsText):
    """What fairing did, or would do.

    Attributes
    ----------
    found : Faired
        The noise, who could move and who could not, and how far points moved.
    edit : EditReport or None
        The report of the edit; None if nothing changed.
    applied : bool
        Whether the hull was changed; else it was only tried.
    seconds : float, s
        Processor time of all that.
    """

    found: Faired
    edit: EditReport | None
    applied: bool
    seconds: float
    _before: HullState = attrs.field(repr=False)
    _after: HullState = attrs.field(repr=False)

    @property
    def noise(self) -> float:
        """The noise that was taken out, m, as a standard deviation along the points' freedom."""
        return self.found.noise

    @property
    def at_bound(self) -> tuple[BoundPoint, ...]:
        """Points that ended at their tolerance."""
        return self.found.at_bound

    @cached_property
    def estimated_noise(self) -> float:
        """What the lines look like, m: as ``noise="auto"`` takes it."""
        return self.found.estimated_noise(self._before.tolerances.factor)

    @cached_property
    def lines(self) -> tuple[FairLine, ...]:
        """The curves of the hull, those with the largest residual before first."""
        return _lines(self._before, self._after)

    @cached_property
    def volume(self) -> tuple[float, float] | None:
        """Before and after, m3, both sides, at the design draught; None without a surface."""
        sizes = self._displacements
        return None if sizes is None else (sizes[0].volume, sizes[1].volume)

    @property
    def lcb(self) -> tuple[float, float] | None:
        """Centre of buoyancy before and after, m, + forward; None likewise."""
        sizes = self._displacements
        return None if sizes is None else (sizes[0].lcb, sizes[1].lcb)

    @cached_property
    def _displacements(self) -> tuple[EvenKeelDisplacement, EvenKeelDisplacement] | None:
        try:
            return even_keel_displacement(self._before), even_keel_displacement(self._after)
        except BadInputError:
            return None

    @property
    def largest_gap(self) -> float:
        """The largest gap at the watched crossings that were checked, m."""
        return 0.0 if self.edit is None else self.edit.largest_gap

    @property
    def notes(self) -> tuple[str, ...]:
        """What is worth knowing besides."""
        return tuple(self._notes())

    def _notes(self) -> Iterator[str]:
        if self.found.source == "stated" and self.estimated_noise > _SUSPECT * self.noise:
            yield (
                f"the lines look like a noise of {1e3 * self.estimated_noise:.2g} mm, more than "
                f"twice the {1e3 * self.noise:.3g} mm that was stated"
            )
        if self.found.source == "stated" and self.noise > _TOO_MUCH * self.estimated_noise:
            yield (
                f"the lines look like a noise of {1e3 * self.estimated_noise:.2g} mm, and "
                f"{1e3 * self.noise:.3g} mm were stated: fairing by more than there is costs shape"
            )
        yield from self._taken_back()
        if self.edit is not None:
            yield from (note for note in self.edit.notes if note != self.found.note)
        if self.edit is not None and self.edit.mended:
            yield f"{len(self.edit.mended)} curves were given a point to close a gap"
        change = {each.line: each.inflections[1] - each.inflections[0] for each in self.lines}
        for word, names in (
            ("more", [name for name, by in change.items() if by > 0]),
            ("fewer", [name for name, by in change.items() if by < 0]),
        ):
            if names:
                more = f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else ""
                yield f"{word} inflections on {', '.join(names[:_SHOWN])}{more}"
        yield (
            "waves longer than about six points are shape to it, and stay; so does a wrong "
            "offset, which is to be found first"
        )

    def _taken_back(self) -> Iterator[str]:
        """Say what edits since the checkpoint are taken back."""
        points = self.found.taken_back
        if not points:
            return
        names = ", ".join(
            f"{each.point} ({1e3 * each.distance:.1f} mm)" for each in points[:_FIRST]
        )
        more = f" and {len(points) - _FIRST} more" if len(points) > _FIRST else ""
        edits = ", ".join(f"'{each}'" for each in self.found.taken_back_edits)
        by, ending = f" by {edits}" if edits else "", "s" if len(points) > 1 else ""
        yield (
            f"taken back: {len(points)} point{ending} moved{by} since the checkpoint count from "
            f"where they were then: {names}{more}"
        )

    def data(self) -> dict[str, Any]:
        """Give all as plain values, lengths in m."""
        told = attrs.asdict(self.found, filter=lambda field, _: field.name != "problem")
        return told | {
            "applied": self.applied, "estimated_noise": self.estimated_noise,
            "lines": [attrs.asdict(each) for each in self.lines],
            "volume": self.volume, "lcb": self.lcb, "largest_gap": self.largest_gap,
            "notes": list(self.notes), "seconds": self.seconds,
        }  # fmt: skip

    def __str__(self) -> str:
        return "\n".join(self._words())

    def _words(self) -> Iterator[str]:
        found = self.found
        yield "faired" if self.applied else "would be faired; nothing is changed"
        look = f"; the lines look like {1e3 * self.estimated_noise:.3g} mm"
        told = "" if found.source.startswith("estimated") else look
        yield f"noise        {1e3 * found.noise:.3g} mm, {found.source}{told}"
        yield (
            f"points       {found.unknowns} can move, battens are looked at in "
            f"{found.residuals} places"
        )
        stay = ", ".join(f"{count} {why}" for why, count in found.stayed.items())
        yield f"stay         {stay or '-'}"
        where = f" at {found.largest_at}" if found.largest_at else ""
        yield (
            f"moved        rms {1e3 * found.moved_rms:.2f} mm, 95 % below "
            f"{1e3 * found.moved_95:.2f} mm, largest {1e3 * found.moved_largest:.2f} mm{where}"
        )
        bounds = "; ".join(_bound_words(each) for each in found.at_bound[:_SHOWN])
        more = len(found.at_bound) - _SHOWN
        yield f"at bound     {bounds or '-'}" + (f"; and {more} more" if more > 0 else "")
        if self.volume is not None and self.lcb is not None:
            part = self.volume[1] / self.volume[0] - 1.0
            yield (
                f"volume       {self.volume[0]:.2f} > {self.volume[1]:.2f} m3 ({part:+.1e}); "
                f"LCB {1e3 * (self.lcb[1] - self.lcb[0]):+.2f} mm"
            )
        counts = np.array([each.inflections for each in self.lines]).reshape(-1, 2).sum(axis=0)
        yield f"inflections  {counts[0]} > {counts[1]}, between bends of {LOBE:g} degree or more"
        yield f"largest gap  {1e3 * self.largest_gap:.2f} mm"
        moved = [each for each in self.lines if each.moved >= _ALIKE]
        if moved:
            yield ""
            yield _HEAD
            yield from map(str, moved[:_SHOWN])
        if len(moved) > _SHOWN:
            yield f"and {counted(len(moved) - _SHOWN, 'more line')}"
        yield ""
        yield from self.notes


def _bound_words(point: BoundPoint) -> str:
    pairs = zip("xyz", point.given, point.now, strict=True)
    moved = [f"{axis} {a:.4f} > {b:.4f}" for axis, a, b in pairs if a != b]
    return f"{point.point} ({', '.join(moved)}, {1e3 * point.tolerance:.3g} mm allowed)"


def _lines(before: HullState, after: HullState) -> tuple[FairLine, ...]:
    """Tell of the curves that both have."""
    curves = np.array(
        [
            curve for curve in before.live("curves").tolist()
            if after.curves.alive.data[curve] and before.curves.spline.data[curve] is not None
            and after.curves.spline.data[curve] is not None
        ],
        np.int64,
    )  # fmt: skip
    book = AddressBook(before)
    line = before.curves.line[curves]
    planar = before.lines.planar[line]
    normals = np.where(planar[:, None], before.lines.normal[line], np.nan)
    bends = [
        inflections(SplineBatch.join([state.spline(c) for c in curves.tolist()]), normals)[0]
        for state in (before, after)
    ]
    sizes = [_sizes(state, curves) for state in (before, after)]
    moved = _movements(before, after, curves)
    found = [
        FairLine(
            book.curve_name(curve),
            _both(sizes[0][i][0], sizes[1][i][0]),
            _both(sizes[0][i][1], sizes[1][i][1]),
            (int(bends[0][i]), int(bends[1][i])),
            float(moved[i]),
        )
        for i, curve in enumerate(curves.tolist())
    ]
    return tuple(sorted(found, key=lambda e: (-(e.residual_largest or (0.0, 0.0))[0], e.line)))


def _both(before: float, after: float) -> tuple[float, float] | None:
    return (before, after) if np.isfinite(before) and np.isfinite(after) else None


def _sizes(state: HullState, curves: IntArray) -> list[tuple[float, float]]:
    """Give median and largest |r| of curves, m; nan where there is none."""
    problem = net_battens(state)
    size = np.abs(problem.residual)
    found: list[tuple[float, float]] = []
    order = np.argsort(problem.curve, kind="stable")
    first = np.searchsorted(problem.curve[order], curves)
    stop = np.searchsorted(problem.curve[order], curves, side="right")
    for a, b in zip(first.tolist(), stop.tolist(), strict=True):
        mine = size[order[a:b]]
        found.append((float(np.median(mine)), float(mine.max())) if a < b else (np.nan, np.nan))
    return found


def _movements(before: HullState, after: HullState, curves: IntArray) -> FloatArray:
    """Give the largest movement along the normal of the points of each curve, m."""
    count = before.rows.count
    step = after.rows.xyz.data[:count] - before.rows.xyz.data
    step[~(before.rows.alive.data & after.rows.alive.data[:count])] = 0.0
    away = np.abs((step * hull_normals(before)).sum(axis=1))
    return np.array([away[before.curves.rows.data[c]].max(initial=0.0) for c in curves.tolist()])
