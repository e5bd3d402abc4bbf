"""What an edit did, as data: what was re-lofted and why, what moved, what remains."""

from __future__ import annotations

from typing import Protocol

import attrs

from assoc_hull.display import Printer, ShownAsText, html_room, html_table, screenful, shortened
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.fairness.inflections import inflections

__all__ = [
    "SAME_MOVEMENT",
    "Counting",
    "EditReport",
    "EditReports",
    "Fairness",
    "FormChange",
    "Led",
    "Movement",
    "change_text",
    "movement_words",
]

Inflections = tuple[tuple[str, int], ...]

FormChange = tuple[str, str, float | None, float | None]
"""Name of a definition, name of a value, what it was, what it is."""


class Counting(Protocol):
    """What can count inflections when asked."""

    def added(self) -> Inflections:
        """Give the curves with more curvature sign changes than before, and how many."""


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
    name : str
        Its address, as ``WL 0.5 x ST 16``; empty in steps that older versions kept.
    """

    point: str
    distance: float
    place: tuple[float, float, float]
    name: str = ""


SAME_MOVEMENT = 0.05e-3
"""A slide that adds less (m) to the movement along the normal is not told: it prints alike."""


def movement_words(largest: Movement, normal: Movement | None) -> list[str]:
    """Say how far the hull moved along its normal, and by how much more a point slid on it.

    Examples
    --------
    >>> from assoc_hull.edit.report import Movement, movement_words
    >>> slid = Movement("P", 0.0813, (50.0, 4.0, 2.0))
    >>> movement_words(slid, Movement("Q", 0.01, (48.0, 4.1, 2.5)))[0]
    'largest movement 10.0 mm along the normal at Q (48.000, 4.100, 2.500) m'
    """
    if normal is None:
        return [f"largest movement {_movement_words(largest)}"]
    slid = largest.distance > normal.distance + SAME_MOVEMENT
    if slid and largest.point == normal.point:
        way = f" along the normal and {1e3 * largest.distance:.1f} mm in all"
        return [f"largest movement {_movement_words(normal, way)}"]
    told = [f"largest movement {_movement_words(normal, ' along the normal')}"]
    return [*told, f"with slides on the hull {_movement_words(largest)}"] if slid else told


def _movement_words(movement: Movement, way: str = "") -> str:
    x, y, z = movement.place
    distance = f"{1e3 * movement.distance:.1f} mm"
    # A key of the tables ("sections:97.536 x ...") is no word: the place alone says where.
    name = movement.name or ("" if ":" in movement.point else movement.point)
    return f"{distance}{way} at {name}{' ' * bool(name)}({x:.3f}, {y:.3f}, {z:.3f}) m"


@attrs.frozen
class Led:
    """A line that led, and what of its own followed.

    Attributes
    ----------
    line : str
        Key of the line.
    along : {"x", "z", "girth"}
        What the stretch is measured along.
    stretch : (float, float), m
        Where it could change.
    asked : tuple of (str, float)
        Keys of the points that were asked for, and how far each came along the outward normal, m.
    crossings : tuple of (str, float)
        Keys of the crossings of the line that followed, in their order along it, each so.
    """

    line: str
    along: str
    stretch: tuple[float, float]
    asked: tuple[tuple[str, float], ...]
    crossings: tuple[tuple[str, float], ...]


@attrs.frozen
class EditReport(ShownAsText):
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
        The largest movement of any point; a crossing may only have slid along its curves.
    largest_normal : Movement or None
        The largest movement along the normal of the hull, or across the curve of a point that is
        on one alone; None if no point moved, and in steps that older versions kept.
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
    fairness : Counting or None
        Counts `inflections`; None where it is `counted` already.
    counted : tuple of (str, int)
        What was counted.
    led : tuple of Led
        The lines that led.
    followed : tuple of (str, float)
        Keys of the lines that followed those, and the farthest way of a point of each along the
        outward normal, m.
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
    fairness: Counting | None = attrs.field(default=None, eq=False, repr=False)
    counted: Inflections = attrs.field(default=(), eq=False, repr=False)
    changed: bool = True
    largest_normal: Movement | None = None
    number: int = attrs.field(default=0, eq=False)
    author: str = attrs.field(default="", eq=False)
    time: str = attrs.field(default="", eq=False)
    led: tuple[Led, ...] = ()
    followed: tuple[tuple[str, float], ...] = ()

    @property
    def inflections(self) -> tuple[tuple[str, int], ...]:
        """Curves with more curvature sign changes than before, and how many more."""
        return self.counted if self.fairness is None else self.fairness.added()

    def __repr__(self) -> str:
        return f"<EditReport {self}>"

    def __str__(self) -> str:
        if not self.changed:
            return f"{self.name}: nothing changed, no step was added"
        parts = [f"{self.name}: {len(self.relofted)} curves re-lofted"]
        parts += [f"{each[0]}: {change_text(each)}" for each in self.definitions]
        if self.largest is not None:
            parts += movement_words(self.largest, self.largest_normal)
        parts.append(f"largest gap {1e3 * self.largest_gap:.2f} mm")
        if self.carried:
            parts.append(f"{len(self.carried)} lines carried, {len(self.cut_again)} cut again")
        for title in ("born", "gone", "mended", "failed", "blocked"):
            found = getattr(self, title)
            if found:
                parts.append(f"{len(found)} {title}")
        return "; ".join(parts)


class EditReports(tuple[EditReport, ...]):
    """Reports of edits, oldest first; a notebook shows them as a table."""

    __slots__ = ()

    def __repr__(self) -> str:
        count = f"{len(self)} edit{'' if len(self) == 1 else 's'}"
        return f"<{count}: {shortened(', '.join(each.name for each in self))}>" if self else "()"

    def __str__(self) -> str:
        return "\n".join(f"{each.number:>4}  {each}" for each in self)

    def _repr_pretty_(self, printer: Printer, cycle: bool) -> None:
        printer.text(screenful(str(self) or "()") if not cycle else "...")

    def _repr_html_(self) -> str:
        rows = (
            (
                str(each.number), each.name, each.author, each.time[:16].replace("T", " "),
                str(len(each.relofted)),
                "" if each.largest is None else f"{1e3 * each.largest.distance:.1f}",
            )
            for each in self
        )  # fmt: skip
        head = ("step", "edit", "author", "time, UTC", "curves that followed", "most, mm")
        return html_room(html_table(head, rows, right=(0, 4, 5)))
