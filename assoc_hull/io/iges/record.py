"""The parameters of one entity of an IGES file: whole numbers, reals, pointers, text, checked.

Examples
--------
>>> from assoc_hull.io.iges.record import Record
>>> record = Record(["124", "1.", "2.5D-1", ""], "here")
>>> record.whole(0, "the type"), record.reals(1, 3, "the matrix").tolist()
(124, [1.0, 0.25, 0.0])
"""

from __future__ import annotations

import re

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.iges.text import Hollerith

__all__ = ["Record"]

_REAL = re.compile(r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eEdD][-+]?[0-9]{1,3})?")
_WHOLE = re.compile(r"[-+]?[0-9]{1,9}")
_AGAIN = "export the file again"


@attrs.frozen(eq=False)
class Record:
    """Values of an entity, the type first; those that are left out at the end are missing.

    Attributes
    ----------
    values : list of str
        As they stand in the file.
    where : str
        For messages.
    """

    values: list[str]
    where: str

    def __len__(self) -> int:
        """Count the values."""
        return len(self.values)

    def whole(self, place: int, what: str, default: int | None = None) -> int:
        """Give a whole number.

        Parameters
        ----------
        place : int
            Which value, from 0; the type of the entity is number 0.
        what : str
            Its name, for the message.
        default : int or None
            What it is where it is left out; None: it may not be.

        Raises
        ------
        BadInputError
            Something else stands there.
        """
        text = self.values[place] if place < len(self.values) else ""
        if not text and default is not None:
            return default
        if isinstance(text, Hollerith) or not _WHOLE.fullmatch(text):
            raise BadInputError(f"{what} is {text[:20]!r}, no whole number", self.where, _AGAIN)
        return int(text)

    def count(self, place: int, what: str, most: int) -> int:
        """Give a whole number from 0 up to a limit; raises as `whole`."""
        found = self.whole(place, what)
        if not 0 <= found <= most:
            raise BadInputError(f"{what} is {found}", self.where, f"0 to {most} can be read")
        return found

    def pointers(self, place: int, count: int, what: str) -> tuple[int, ...]:
        """Give the numbers of other entities, 0 where there is none; raises as `whole`."""
        self._require(place, count, what)
        return tuple(abs(self.whole(at, what, default=0)) for at in range(place, place + count))

    def reals(self, place: int, count: int, what: str, default: float = 0.0) -> FloatArray:
        """Give real numbers, (count,); what is left out is the default.

        Raises
        ------
        BadInputError
            There are fewer, or something else stands there.
        """
        self._require(place, count, what)
        texts = self.values[place : place + count]
        wrong = next(
            (text for text in texts if text and (
                isinstance(text, Hollerith) or not _REAL.fullmatch(text))), None,
        )  # fmt: skip
        if wrong is not None:
            raise BadInputError(f"{what}: {wrong[:20]!r} is no number", self.where, _AGAIN)
        words = [text.translate(_EXPONENT) if text else repr(default) for text in texts]
        found = np.array(words, dtype=np.float64)
        if not np.isfinite(found).all():
            raise BadInputError(f"{what} holds a number without limit", self.where, _AGAIN)
        return found

    def text(self, place: int) -> str:
        """Give text, empty if there is none."""
        found = self.values[place] if place < len(self.values) else ""
        return found.strip() if isinstance(found, Hollerith) else ""

    def _require(self, place: int, count: int, what: str) -> None:
        if place + count > len(self.values):
            there = max(len(self.values) - place, 0)
            missing = f"{what}: {count} values are wanted, and {there} are there"
            raise BadInputError(missing, self.where, _AGAIN)


_EXPONENT = str.maketrans("dD", "ee")
