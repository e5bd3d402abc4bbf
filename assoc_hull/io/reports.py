"""What readers and writers report: notes, reports, and how far a long read has come.

A `Notebook` collects what a reader assumes, repairs and suspects; an `ExportBook` does the same for
a writer, with counts and rounding. `OffsetReport` and `ExportReport` hold the notes frozen. `Tell`
is the callable that a caller hands in to hear of progress.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable

import attrs
import numpy as np

from assoc_hull.display import ShownAsText
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray

__all__ = [
    "ExportBook",
    "ExportReport",
    "Note",
    "Notebook",
    "OffsetReport",
    "Tell",
    "no_progress",
]

# --------------------------------------------------------------------------------------
# Reading.


@attrs.frozen(repr=False)
class Note(ShownAsText):
    """One remark on what is read: on a table, its lines, or the hull that is made of them.

    Attributes
    ----------
    kind : str
        A short word to filter by, such as "unit", "station zero", "blank", "outlier" or "gap".
    where : str
        Station and waterline as the file names them, the line, the column, or "the table".
    what : str
        A sentence with the numbers.
    amount : float or None
        The number that matters, m where it is a length; what it is stands in `what`.
    """

    kind: str
    where: str
    what: str
    amount: float | None = None

    def __str__(self) -> str:
        return f"{self.kind}: {self.where}: {self.what}"


@attrs.frozen(repr=False)
class OffsetReport(ShownAsText):
    """Everything a reader decided that the file does not say by itself.

    Attributes
    ----------
    assumptions : tuple of Note
        What was taken to be so: unit, frame, station numbers, meaning of blanks.
    repairs : tuple of Note
        What was changed: order, duplicates, separators.
    suspicions : tuple of Note
        What was read as it stands and looks wrong.
    faults : tuple of Note
        What was read as it stands and cannot be right: the hull is not sound.
    """

    assumptions: tuple[Note, ...] = ()
    repairs: tuple[Note, ...] = ()
    suspicions: tuple[Note, ...] = ()
    faults: tuple[Note, ...] = ()

    def __str__(self) -> str:
        parts = []
        titles = ("assumptions", "repairs", "suspicions", *(("faults",) if self.faults else ()))
        for title in titles:
            notes: tuple[Note, ...] = getattr(self, title)
            parts.append("\n".join([f"{title} ({len(notes)})", *(f"  {note}" for note in notes)]))
        return "\n".join(parts)

    def then(self, other: OffsetReport) -> OffsetReport:
        """Give these notes and those of a later step."""
        parts = ("assumptions", "repairs", "suspicions", "faults")
        return OffsetReport(*(getattr(self, each) + getattr(other, each) for each in parts))

    def kinds(self, part: str = "suspicions") -> tuple[str, ...]:
        """Give the kinds of the notes of one part, sorted, each once."""
        return tuple(sorted({note.kind for note in getattr(self, part)}))


@attrs.define
class Notebook:
    """Collects notes while a table is read; `report` gives them frozen."""

    assumptions: list[Note] = attrs.field(factory=list)
    repairs: list[Note] = attrs.field(factory=list)
    suspicions: list[Note] = attrs.field(factory=list)
    faults: list[Note] = attrs.field(factory=list)

    def assume(self, kind: str, where: str, what: str, amount: float | None = None) -> None:
        """Note something taken to be so."""
        self.assumptions.append(Note(kind, where, what, amount))

    def repair(self, kind: str, where: str, what: str, amount: float | None = None) -> None:
        """Note something that was changed."""
        self.repairs.append(Note(kind, where, what, amount))

    def suspect(self, kind: str, where: str, what: str, amount: float | None = None) -> None:
        """Note something that looks wrong and was left as it is."""
        self.suspicions.append(Note(kind, where, what, amount))

    def fault(self, kind: str, where: str, what: str, amount: float | None = None) -> None:
        """Note something that cannot be right and was left as it is."""
        self.faults.append(Note(kind, where, what, amount))

    def report(self) -> OffsetReport:
        """Give the notes taken so far."""
        parts = (self.assumptions, self.repairs, self.suspicions, self.faults)
        return OffsetReport(*map(tuple, parts))


# --------------------------------------------------------------------------------------
# Writing.


@attrs.frozen
class ExportReport:
    """What an export wrote, and what the form cannot hold.

    Attributes
    ----------
    path : str
        The file.
    form : str
        As in `assoc_hull.io.export.write.FORMS`.
    lines, curves, points : int
        What was written; a line may come in several curves.
    rounding : float, m
        Half a unit of the last digit written.
    largest : float, m
        The largest difference between a number and what was written for it.
    chord : float, m
        How far the straight line between two points written may leave the curve; 0 for tables
        and hull files, which say nothing of it.
    left_out : tuple of Note
        What is in the hull and not in the file.
    mended : tuple of Note
        What the form has otherwise than the hull: names, joined curves.
    """

    path: str
    form: str
    lines: int
    curves: int
    points: int
    rounding: float
    largest: float
    chord: float
    left_out: tuple[Note, ...]
    mended: tuple[Note, ...]

    @property
    def words(self) -> str:
        """What was written, how it was rounded, and what is not in the file."""
        rows = [f"{self.lines} lines in {self.curves} curves, {self.points} points"]
        if self.rounding:
            rows.append(
                f"rounded by {1e3 * self.largest:.4f} mm at most (half a digit is "
                f"{1e3 * self.rounding:.4f} mm)"
            )
        if self.chord:
            rows.append(
                f"straight lines between points leave the curves by {1e3 * self.chord:.2f} mm"
            )
        for title, notes in (("left out", self.left_out), ("otherwise", self.mended)):
            rows += [f"{title} ({len(notes)})", *(f"  {note}" for note in notes)] if notes else []
        return "\n".join(rows)

    def __str__(self) -> str:
        return f"{self.words}\nwritten: {self.path} ({self.form})"


@attrs.define
class ExportBook:
    """Takes down what is written.

    Attributes
    ----------
    decimals : int
        Digits after the point.
    scale : float
        Units of the file in a metre.
    unit : str
        Its unit, where the form has several.
    paper : float or None
        Denominator of the scale at which a drawing is to be printed; None: a fitting one.
    accept : bool
        Write a surface that is not sound as well.
    """

    decimals: int
    scale: float = 1.0
    unit: str = "m"
    paper: float | None = None
    accept: bool = False
    lines: int = 0
    curves: int = 0
    points: int = 0
    largest: float = 0.0
    chord: float = 0.0
    left_out: list[Note] = attrs.field(factory=list)
    mended: list[Note] = attrs.field(factory=list)

    def rows(self, values: FloatArray) -> list[list[str]]:
        """Write numbers, (n, k), m, in the unit of the file; a number that is nan is blank.

        Raises
        ------
        BadInputError
            A number is infinite.
        """
        if np.isinf(values).any():
            raise BadInputError("a number is not finite", "in the export", "verify the hull")
        scaled = values * self.scale
        near = np.round(scaled, self.decimals) + 0.0
        off = np.abs(near - scaled)[np.isfinite(scaled)]
        self.largest = max(self.largest, float(off.max(initial=0.0)) / self.scale)
        return [
            ["" if math.isnan(x) else f"{x:.{self.decimals}f}" for x in row]
            for row in near.tolist()
        ]

    def leave_out(self, kind: str, where: str, what: str, amount: float | None = None) -> None:
        """Note what the form does not hold."""
        self.left_out.append(Note(kind, where, what, amount))

    def mend(self, kind: str, where: str, what: str, amount: float | None = None) -> None:
        """Note what was written otherwise than the hull has it."""
        self.mended.append(Note(kind, where, what, amount))

    def name(self, name: str, allowed: str, most: int, default: str) -> str:
        """Give a name in the characters a form allows, and note where it is another one.

        Parameters
        ----------
        name : str
            The name.
        allowed : str
            A class of characters of a regular expression, without brackets.
        most : int
            Its greatest length.
        default : str
            What is written if nothing of the name is left.
        """
        plain = " ".join(re.sub(f"[^{allowed}]", " ", name).split())
        kept = plain if " " in allowed else plain.replace(" ", "")
        kept = kept[:most].strip() or default
        if kept != name:
            self.mend("name", "the ship", f"{name!r} is written as {kept!r}")
        return kept

    def report(self, path: str, form: str) -> ExportReport:
        """Give what was noted."""
        rounding = 0.5 * 10.0**-self.decimals / self.scale
        return ExportReport(
            path, form, self.lines, self.curves, self.points, rounding, self.largest, self.chord,
            tuple(self.left_out), tuple(self.mended),
        )  # fmt: skip


# --------------------------------------------------------------------------------------
# Progress.

Tell = Callable[[str, int, int], None]
"""Takes what is being done, how many parts of it are done, and of how many; 0 if unknown."""


def no_progress(what: str, done: int, of: int) -> None:
    """Tell nobody.

    Examples
    --------
    >>> from assoc_hull.io.reports import no_progress
    >>> no_progress("cutting", 3, 73)
    """
