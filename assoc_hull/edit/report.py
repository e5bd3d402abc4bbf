"""What an edit did, as data: what was re-lofted and why, what moved, what remains."""

from __future__ import annotations

import attrs

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.fairness.inflections import inflections

__all__ = ["EditReport", "Fairness", "FormChange", "Movement", "change_text"]

Inflections = tuple[tuple[str, int], ...]

FormChange = tuple[str, str, float | None, float | None]
"""Name of a definition, name of a value, what it was, what it is."""


@attrs.frozen(eq=False)
class Fairness:
    """Splines of the re-lofted curves before and after an edit, for counting when asked.

    Attributes
    ----------
    before, after : dict of int to SplineBatch
        By number of curve; a new curve has no spline before.
    normals : (k, 3)
        Unit normals of the planes of `curves`.
    curves, keys : (k,) int, tuple of str
        The curves.
    """

    before: dict[int, SplineBatch]
    after: dict[int, SplineBatch]
    normals: FloatArray
    curves: IntArray
    keys: tuple[str, ...]

    def added(self) -> tuple[tuple[str, int], ...]:
        """Give the curves with more curvature sign changes than before, and how many."""
        known = [i for i, curve in enumerate(self.curves.tolist()) if curve in self.before]
        if not known:
            return ()
        numbers, normals = self.curves[known].tolist(), self.normals[known]
        old = SplineBatch.join([self.before[curve] for curve in numbers])
        new = SplineBatch.join([self.after[curve] for curve in numbers])
        more = inflections(new, normals)[0] - inflections(old, normals)[0]
        return tuple(
            (self.keys[i], int(count))
            for i, count in zip(known, more.tolist(), strict=True)
            if count > 0
        )


def change_text(change: FormChange) -> str:
    """Say how a value of a definition was changed.

    Examples
    --------
    >>> from assoc_hull.edit.report import change_text
    >>> change_text(("areas", "run_area", 0.51, None))
    'run_area 0.51 -> free'
    """
    _, name, old, new = change
    told = ["free" if value is None else f"{value:.10g}" for value in (old, new)]
    return f"{name} {told[0]} -> {told[1]}"


@attrs.frozen
class Movement:
    """The largest movement of an edit.

    Attributes
    ----------
    point : str
        Key of the point that moved farthest.
    distance : float, m
        How far.
    place : (float, float, float), m
        Where it lies now.
    """

    point: str
    distance: float
    place: tuple[float, float, float]


@attrs.frozen
class EditReport:
    """The report of one committed edit.

    Attributes
    ----------
    name : str
        Name of the edit.
    changed : bool
        Whether the edit changed anything; if not, it added no step to the history.
    planned : int
        Curves that could at most be lofted in the main pass: the closure of what was set.
    relofted : tuple of str
        Keys of the curves that were lofted again, in order of the update.
    cut_off : int
        Nodes that were evaluated and came out as they were.
    born, gone : tuple of str
        Crossings that appeared and vanished.
    mended : tuple of str
        Curves that were given a point to close a gap.
    failed, blocked : tuple of str
        Objects that could not be made, and those made from them.
    largest : Movement or None
        The largest movement of any point.
    largest_gap : float, m
        The largest gap at the watched crossings that were checked.
    notes : tuple of str
        What was left alone, and why.
    carried, cut_again : tuple of str
        Keys of the lines that a mapping carried, and of those that were cut again from them.
    definitions : tuple of (str, str, float or None, float or None)
        Values of definitions that were set: name of the definition, name of the value, what it
        was, what it is.
    seconds : dict of str to float
        Time per phase.
    number : int
        Number of the step in the history, which it keeps; 0 before it is committed.
    author : str
        Who made the edit.
    time : str
        When it was committed, ISO 8601, UTC.
    fairness : Fairness or None
        What `inflections` counts; None where it is `counted` already.
    counted : tuple of (str, int)
        What was counted.
    """

    name: str
    planned: int = 0
    relofted: tuple[str, ...] = ()
    cut_off: int = 0
    born: tuple[str, ...] = ()
    gone: tuple[str, ...] = ()
    mended: tuple[str, ...] = ()
    failed: tuple[str, ...] = ()
    blocked: tuple[str, ...] = ()
    largest: Movement | None = None
    largest_gap: float = 0.0
    notes: tuple[str, ...] = ()
    carried: tuple[str, ...] = ()
    cut_again: tuple[str, ...] = ()
    definitions: tuple[FormChange, ...] = ()
    seconds: dict[str, float] = attrs.field(factory=dict, eq=False)
    fairness: Fairness | None = attrs.field(default=None, eq=False, repr=False)
    counted: Inflections = attrs.field(default=(), eq=False, repr=False)
    changed: bool = True
    number: int = attrs.field(default=0, eq=False)
    author: str = attrs.field(default="", eq=False)
    time: str = attrs.field(default="", eq=False)

    @property
    def inflections(self) -> tuple[tuple[str, int], ...]:
        """Curves with more curvature sign changes than before, and how many more."""
        return self.counted if self.fairness is None else self.fairness.added()

    def __str__(self) -> str:
        if not self.changed:
            return f"{self.name}: nothing changed, no step was added"
        parts = [f"{self.name}: {len(self.relofted)} curves re-lofted"]
        parts += [f"{each[0]}: {change_text(each)}" for each in self.definitions]
        if self.largest is not None:
            x, y, z = self.largest.place
            parts.append(
                f"largest movement {1e3 * self.largest.distance:.1f} mm at "
                f"({x:.3f}, {y:.3f}, {z:.3f}) m, {self.largest.point}"
            )
        parts.append(f"largest gap {1e3 * self.largest_gap:.2f} mm")
        if self.carried:
            parts.append(f"{len(self.carried)} lines carried, {len(self.cut_again)} cut again")
        for title in ("born", "gone", "mended", "failed", "blocked"):
            found = getattr(self, title)
            if found:
                parts.append(f"{len(found)} {title}")
        return "; ".join(parts)
