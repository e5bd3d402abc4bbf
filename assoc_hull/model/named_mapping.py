"""Mappings by name that say which names are near when one is not there."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TypeVar

from assoc_hull.arguments import plain_name, shown_name
from assoc_hull.errors import UnknownNameError

__all__ = ["NamedMapping"]

_SHOWN = 4

Item = TypeVar("Item", covariant=True)


class NamedMapping(Mapping[str, Item]):
    """A read-only mapping by name.

    Parameters
    ----------
    kind : str
        What the items are, for the error.
    items : mapping of str
        The items, in order.
    spoken : bool
        Whether a name is found however a person writes it (`plain_name`), if that names one item.

    Examples
    --------
    >>> from assoc_hull.model.named_mapping import NamedMapping
    >>> NamedMapping("line", {"WL 1": 1, "WL 2": 2})["WL 2"]
    2
    """

    def __init__(self, kind: str, items: Mapping[str, Item], *, spoken: bool = False) -> None:
        self._kind, self._spoken = kind, spoken
        self._items = dict(items)

    def __getitem__(self, name: str) -> Item:
        found = self._name(name)
        if found is None:
            raise UnknownNameError(self._kind, shown_name(name), tuple(self._items))
        return self._items[found]

    def _name(self, given: object) -> str | None:
        """Give the name of the item that is meant; None if there is none, or several."""
        if not isinstance(given, str) or given in self._items:
            return given if isinstance(given, str) else None
        if not self._spoken:
            return None
        plain = plain_name(given)
        alike = [name for name in self._items if plain_name(name) == plain]
        return alike[0] if len(alike) == 1 else None

    def __iter__(self) -> Iterator[str]:
        return iter(self._items)

    def __len__(self) -> int:
        return len(self._items)

    def __contains__(self, name: object) -> bool:
        return self._name(name) is not None

    def _ipython_key_completions_(self) -> list[str]:
        return list(self._items)

    def __repr__(self) -> str:
        names = list(self._items)
        told = ", ".join(names[:_SHOWN]) + (", ..." if len(names) > _SHOWN else "")
        return f"<{len(names)} by name: {told}>" if names else f"<no {self._kind}>"
