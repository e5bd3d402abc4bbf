"""What all handles share: they hold no geometry, and know when their object has gone."""

from __future__ import annotations

from typing import ClassVar, Self

import attrs

from assoc_hull.arguments import instance, integer, word
from assoc_hull.errors import ForeignPointError
from assoc_hull.model.state import HullState

__all__ = ["Handle"]


@attrs.frozen(repr=False)
class Handle:
    """A handle on one object of a hull.

    Attributes
    ----------
    tables : HullState
        The tables of the hull.
    number : int
        Row of the object in its table.
    id : str
        Key of the object; it outlives renaming and shifting.
    """

    _table: ClassVar[str]
    tables: HullState
    number: int
    id: str

    def __attrs_post_init__(self) -> None:
        instance(self.tables, HullState, "tables", "in a handle")
        if not isinstance(self.number, int):
            integer(self.number, "number", "in a handle", least=0)
        word(self.id, "id", "in a handle")

    @classmethod
    def of(cls, tables: HullState, number: int) -> Self:
        """Give the handle on a row of the table."""
        table = getattr(instance(tables, HullState, "tables", "in a handle"), cls._table)
        integer(number, "number", "in a handle", least=0, most=table.count - 1)
        column = table.name if cls._table == "groups" else table.key
        return cls(tables, int(number), column.data[int(number)])

    @property
    def alive(self) -> bool:
        """Whether the object is still there."""
        table = getattr(self.tables, self._table)
        if self.number >= table.count or not table.alive.data[self.number]:
            return False
        return self._table == "groups" or bool(table.key.data[self.number] == self.id)

    @property
    def row(self) -> int:
        """The number of the object, which is checked to be alive.

        Raises
        ------
        ForeignPointError
            It has gone.
        """
        if not self.alive:
            raise ForeignPointError(f"{type(self).__name__.lower()} {self.id!r}")
        return self.number

    def __repr__(self) -> str:
        name = getattr(self, "name", self.id) if self.alive else f"{self.id}, gone"
        return f"<{type(self).__name__} {name}>"
