"""The points of a hull as a mapping by address."""

from __future__ import annotations

from collections.abc import ItemsView, Iterator, Mapping, ValuesView

from assoc_hull.errors import BadInputError, UnknownNameError
from assoc_hull.model.address import AddressBook
from assoc_hull.model.handles import handle
from assoc_hull.model.point import Point
from assoc_hull.model.state import HullState

__all__ = ["Points"]


class Points(Mapping[str, Point]):
    """The points of a hull by address; a crossing stands under its line of higher rank.

    Any address leads to a point, also the other way round: ``points["ST 7 x WL 0.5"]``.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.model.points import Points
    >>> points = Points(wigley())
    >>> next(iter(points)), points["ST 7 x WL 2.5"].parent_curve
    ('ST 1 x profile', <Curve WL 2.5>)
    """

    def __init__(self, state: HullState) -> None:
        self._state = state

    def __getitem__(self, address: str) -> Point:
        found = handle(self._state, address)
        if isinstance(found, Point):
            return found
        raise BadInputError(f"{address!r} names no point", "in points", "ask hull.find for it")

    def __contains__(self, address: object) -> bool:
        try:
            return isinstance(address, str) and bool(self[address])
        except (BadInputError, UnknownNameError):
            return False

    def items(self) -> ItemsView[str, Point]:
        """Give addresses with their points."""
        return dict(self._all()).items()

    def values(self) -> ValuesView[Point]:
        """Give the points."""
        return dict(self._all()).values()

    def _all(self) -> Iterator[tuple[str, Point]]:
        """Give all points by address from one book: a look-up each would make one each."""
        book, keys = AddressBook(self._state), self._state.rows.key.data
        for row in self._state.live("rows").tolist():
            side = book.usual_side(row)
            yield book.address(row, side), Point(self._state, row, keys[row], side)

    def __iter__(self) -> Iterator[str]:
        book = AddressBook(self._state)
        return (book.address(row) for row in self._state.live("rows").tolist())

    def __len__(self) -> int:
        return len(self._state.live("rows"))
