"""One finding of a check: what is wrong, where, how much, and what to do."""

from __future__ import annotations

import attrs

from assoc_hull.model.address import AddressBook
from assoc_hull.model.tables import HullState

__all__ = ["Finding", "row_finding"]


@attrs.frozen
class Finding:
    """Something that is wrong with a hull, or a note on it.

    Attributes
    ----------
    kind : str
        ``failed``, ``blocked``, ``not finite``, ``fold``, ``loop``, ``close``, ``off curve``,
        ``off plane``, ``sense``, ``gap``, ``links``, ``orphan``, ``twin``, ``association``,
        ``ruling``, ``ring``, ``tables``, ``feature``, ``detached``, ``tunnel``, or the
        note ``role``.
    object : str
        Address of the object.
    place : (float, float, float) or None, m
        Where.
    amount : float or None
        How much: a length in m, an angle's cosine at a fold, a count for a ring or of lines.
    message : str
        The finding in words, with what to do about it.
    """

    kind: str
    object: str
    place: tuple[float, float, float] | None
    amount: float | None
    message: str

    def __str__(self) -> str:
        where = "" if self.place is None else " at ({:.3f}, {:.3f}, {:.3f}) m".format(*self.place)
        return f"{self.kind}: {self.object}{where} {self.message}"


def row_finding(
    state: HullState, book: AddressBook, row: int, kind: str, message: str,
    amount: float | None = None,
) -> Finding:  # fmt: skip
    """Make a finding on a point.

    Examples
    --------
    >>> from assoc_hull.edit.checks.finding import row_finding
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.model.address import AddressBook
    >>> state = wigley()
    >>> str(row_finding(state, AddressBook(state), 0, "gap", "is wide"))
    'gap: ST 1 x profile at (5.000, 0.000, 0.000) m is wide'
    """
    x, y, z = state.rows.xyz[row].tolist()
    return Finding(kind, book.address(row), (x, y, z), amount, message)
