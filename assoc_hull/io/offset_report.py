"""What a reader of offsets assumed, mended and found suspicious, as data.

Examples
--------
>>> from assoc_hull.io.offset_report import Notebook
>>> book = Notebook()
>>> book.assume("unit", "the table", "half-breadths are metres: the largest is 16.2", 16.2)
>>> print(book.report())
assumptions (1)
  unit: the table: half-breadths are metres: the largest is 16.2
repairs (0)
suspicions (0)
"""

from __future__ import annotations

import attrs

__all__ = ["Note", "Notebook", "OffsetReport"]


@attrs.frozen
class Note:
    """One remark on a table.

    Attributes
    ----------
    kind : str
        A short word to filter by, such as "unit", "station zero", "blank" or "outlier".
    where : str
        Station and waterline as the file names them, or the column, or "the table".
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


@attrs.frozen
class OffsetReport:
    """Everything a reader decided that the file does not say by itself.

    Attributes
    ----------
    assumptions : tuple of Note
        What was taken to be so: unit, frame, station numbers, meaning of blanks.
    repairs : tuple of Note
        What was changed: order, duplicates, separators.
    suspicions : tuple of Note
        What was read as it stands and looks wrong.
    """

    assumptions: tuple[Note, ...] = ()
    repairs: tuple[Note, ...] = ()
    suspicions: tuple[Note, ...] = ()

    def __str__(self) -> str:
        parts = []
        for title in ("assumptions", "repairs", "suspicions"):
            notes: tuple[Note, ...] = getattr(self, title)
            parts.append("\n".join([f"{title} ({len(notes)})", *(f"  {note}" for note in notes)]))
        return "\n".join(parts)

    def kinds(self, part: str = "suspicions") -> tuple[str, ...]:
        """Give the kinds of the notes of one part, sorted, each once."""
        return tuple(sorted({note.kind for note in getattr(self, part)}))


@attrs.define
class Notebook:
    """Collects notes while a table is read; `report` gives them frozen."""

    assumptions: list[Note] = attrs.field(factory=list)
    repairs: list[Note] = attrs.field(factory=list)
    suspicions: list[Note] = attrs.field(factory=list)

    def assume(self, kind: str, where: str, what: str, amount: float | None = None) -> None:
        """Note something taken to be so."""
        self.assumptions.append(Note(kind, where, what, amount))

    def repair(self, kind: str, where: str, what: str, amount: float | None = None) -> None:
        """Note something that was changed."""
        self.repairs.append(Note(kind, where, what, amount))

    def suspect(self, kind: str, where: str, what: str, amount: float | None = None) -> None:
        """Note something that looks wrong and was left as it is."""
        self.suspicions.append(Note(kind, where, what, amount))

    def report(self) -> OffsetReport:
        """Give the notes taken so far."""
        return OffsetReport(tuple(self.assumptions), tuple(self.repairs), tuple(self.suspicions))
