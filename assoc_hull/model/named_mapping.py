"""Mappings by name that say which names are near when one is not there."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TypeVar

from assoc_hull.arguments import shown_name
from assoc_hull.errors import UnknownNameError

__all__ = ["NamedMapping"]

Item = TypeVar("Item", covariant=True)


class NamedMapping(Mapping[str, Item]):
    """A read-only mapping by name.

    Parameters
    ----------
    kind : str
        What the items are, for the error.
    items : mapping of str
        The items, in order.

    Examples
    --------
    >>> from assoc_hull.model.named_mapping import NamedMapping
    >>> NamedMapping("line", {"WL 1": 1, "WL 2": 2})["WL 2"]
    2
    """

    def __init__(self, kind: str, items: Mapping[str, Item]) -> None:
        self._kind = kind
        self._items = dict(items)

    def __getitem__(self, name: str) -> Item:
        if name not in self:
            raise UnknownNameError(self._kind, shown_name(name), tuple(self._items))
        return self._items[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._items)

    def __len__(self) -> int:
        return len(self._items)

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and name in self._items

    def __repr__(self) -> str:
        return f"<{len(self._items)} by name: {', '.join(list(self._items)[:4])}, ...>"
