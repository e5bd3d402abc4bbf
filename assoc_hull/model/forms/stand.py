"""Sections of one layout where they stand, and the errors of what cannot stand there.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.model.forms.forms import Forms
>>> from assoc_hull.model.forms.stand import Stand
>>> from assoc_hull.model.state import Particulars
>>> forms = Forms.of([], Particulars("ship", 180.0, 28.0, 15.5, 10.5))
>>> ends = np.array([[[9.0, 0.0, 0.0], [9.0, 12.0, 15.5]]])
>>> Stand.of(forms, np.array([9.0]), ends).finish.tolist()
[[15.5, 12.0]]
"""

from __future__ import annotations

import math
from typing import Self

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError, OutOfRangeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.forms.forms import Forms

__all__ = ["Stand"]


@attrs.frozen(eq=False)
class Stand:
    """Sections of one layout.

    Attributes
    ----------
    forms : Forms
        The definitions.
    x : (n,), m
        Where they stand.
    start, finish : (n, 2), m
        Contour and deck edge there: z, y.
    """

    forms: Forms
    x: FloatArray
    start: FloatArray
    finish: FloatArray

    @classmethod
    def of(cls, forms: Forms, x: FloatArray, ends: FloatArray) -> Self:
        """Take sections by their places, and (n, 2, 3) their ends in space."""
        plane = np.stack([ends[..., 2], ends[..., 1]], axis=-1)
        return cls(forms, x, plane[:, 0], plane[:, 1])

    @property
    def draught(self) -> FloatArray:
        """The draught at each, (n,), m."""
        return np.full(len(self.x), self.forms.particulars.draught)

    def value(self, use: str, default: float = np.nan) -> FloatArray:
        """Read a definition at each."""
        return self.forms.value(use, self.x, default)

    def needed(self, use: str) -> FloatArray:
        """Read a definition that must reach each."""
        self.forms.needed(use, self.where(0))
        found = self.value(use)
        self.refuse(np.isnan(found), f"the definition for {use} does not reach so far", "extend it")
        return found

    def radians(self, use: str, default: float | None = None) -> FloatArray:
        """Read angles."""
        degrees = self.needed(use) if default is None else self.value(use, default)
        return degrees * (math.pi / 180.0)

    def where(self, number: int) -> str:
        """Name one of them."""
        return f"at the section x = {float(self.x[number]):g} m"

    def refuse(self, bad: NDArray[np.bool_], what: str, remedy: str) -> None:
        """Raise an error that names the first bad one."""
        for number in np.flatnonzero(bad)[:1].tolist():
            raise BadInputError(what, self.where(number), remedy)

    def within(
        self, name: str, unit: str, why: str, value: FloatArray, least: FloatArray, most: FloatArray
    ) -> None:
        """Raise an error that names the first value outside its interval, with a trifle of play."""
        slack = 1e-9 * np.maximum(1.0, np.maximum(np.abs(least), np.abs(most)))
        slack = np.where(np.isfinite(slack), slack, 0.0)
        bad = (value < least - slack) | (value > most + slack)
        for number in np.flatnonzero(bad)[:1].tolist():
            given, low, high = (float(each[number]) for each in (value, least, most))
            raise OutOfRangeError(name, given, self.where(number), why, low, high, unit)
