"""The error of classical curves and definitions: what is given makes no curve."""

from __future__ import annotations

from collections.abc import Mapping

import attrs

from assoc_hull.errors.family import AssocHullError

__all__ = ["GeometryError"]


@attrs.define(slots=False, eq=False)
class GeometryError(AssocHullError, ValueError):
    """A classical curve, section or definition cannot be made of what is given.

    Attributes
    ----------
    what : str
        What is wrong, with its numbers; begins with the kind of object ("biarc: ...").
    remedy : str
        What to do about it.
    values : mapping of str to object
        The numbers of the message by name.
    where : str
        Line of a file or name of an object, where one is known; else empty.
    """

    what: str
    remedy: str
    values: Mapping[str, object] = attrs.field(factory=dict)
    where: str = ""

    def __str__(self) -> str:
        place = f", {self.where}" if self.where else ""
        return f"{self.what}{place}; {self.remedy}"

    def at(self, where: str) -> GeometryError:
        """Give the same error with the place it was found at, unless it has one."""
        return GeometryError(self.what, self.remedy, self.values, self.where or where)
