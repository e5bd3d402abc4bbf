"""The comparison of a hull with what its own definition gives.

Examples
--------
>>> from assoc_hull.model.tables import HullState, Particulars
>>> from assoc_hull.model.definition.verify import verify
>>> verify(HullState(Particulars("S", 9.0, 2.0, 1.0, 1.0)))
[]
"""

from __future__ import annotations

from collections.abc import Iterator

import attrs
import numpy as np

from assoc_hull.errors import AssocHullError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.model.definition.canonical_columns import (
    canonical_order,
    meet_columns,
    value_columns,
)
from assoc_hull.model.definition.records import definition
from assoc_hull.model.definition.restore import rebuilt
from assoc_hull.model.tables import HullState

__all__ = ["Difference", "verify"]


@attrs.frozen
class Difference:
    """One derived value that is not what the definition gives.

    Attributes
    ----------
    key : str
        Key of the curve or point.
    field : str
        Which value, for instance ``"spline.leave"``.
    amount : float
        Largest difference of its numbers, m where it is a length; inf where they cannot be
        compared.
    """

    key: str
    field: str
    amount: float


def verify(state: HullState, relative: float = 0.0) -> list[Difference]:
    """Rebuild a hull beside the published one, and give every derived value that differs.

    Parameters
    ----------
    state : HullState
        The published tables; only read.
    relative : float
        0 compares bits. On another machine 1e-12 allows for its arithmetic: a value may
        then differ by this part of the largest number of its array, of 1 at least.

    Returns
    -------
    list of Difference
        By object, then field; empty if there is none.
    """
    try:
        other, misfits = rebuilt(definition(state))
    except AssocHullError as error:
        return [Difference(state.particulars.name, f"rebuild: {error}", float("inf"))]
    found = [Difference(key, "meetings", float("inf")) for key in misfits]
    found += _points(state, other, relative)
    found += _links(state, other)
    theirs = dict(_curves(other))
    for place, mine in _curves(state):
        amount = _apart(mine, theirs[place], relative)
        if amount is not None:
            found.append(Difference(*place, amount))
    return sorted(found, key=lambda each: (each.key, each.field))


def _points(state: HullState, other: HullState, relative: float) -> Iterator[Difference]:
    """Compare places of points and watched gaps."""
    order = canonical_order(state)
    one, two = value_columns(state, order), value_columns(other, canonical_order(other))
    for field in one:
        mine, theirs = np.asarray(one[field]), np.asarray(two[field])
        for place in np.flatnonzero(_odd(mine, theirs)).tolist():
            amount = _apart(np.atleast_1d(mine[place]), np.atleast_1d(theirs[place]), relative)
            if amount is not None:
                yield Difference(state.rows.key[order.rows[place]], field, amount)


def _odd(one: FloatArray, other: FloatArray) -> np.typing.NDArray[np.bool_]:
    """Tell which rows differ by a bit."""
    differs = _bits(one) != _bits(other)
    found: np.typing.NDArray[np.bool_] = differs.any(axis=1) if differs.ndim > 1 else differs
    return found


def _bits(values: FloatArray) -> IntArray:
    found: IntArray = np.ascontiguousarray(values, np.float64).view(np.int64)
    return found


def _links(state: HullState, other: HullState) -> Iterator[Difference]:
    """Compare which curves each point defines and which drives it with what its role says."""
    mine, theirs = canonical_order(state), canonical_order(other)
    for field in ("reader", "driver"):
        one = mine.curve[getattr(state.rows, field).data[mine.rows]]
        two = theirs.curve[getattr(other.rows, field).data[theirs.rows]]
        odd = (one != two).any(axis=1) if one.ndim > 1 else one != two
        for place in np.flatnonzero(odd).tolist():
            yield Difference(state.rows.key[mine.rows[place]], field, float("inf"))


def _curves(state: HullState) -> Iterator[tuple[tuple[str, str], FloatArray]]:
    """Give spline and places of meetings of each curve, by key of the curve and field."""
    order = canonical_order(state)
    met = {name: np.asarray(part) for name, part in meet_columns(state, order).items()}
    first = np.searchsorted(met["owner"], np.arange(len(order.curves) + 1)).tolist()
    for place, number in enumerate(order.curves.tolist()):
        key, spline = str(state.curves.key[number]), state.spline(number)
        for name in ("knot", "xyz", "leave", "arrive"):
            yield (key, f"spline.{name}"), getattr(spline, name)
        for name in ("parameter", "xyz"):
            yield (key, f"meetings.{name}"), met[name][first[place] : first[place + 1]]


def _apart(one: FloatArray, other: FloatArray, relative: float) -> float | None:
    """Give how far two arrays differ, None if they agree."""
    if one.shape != other.shape:
        return float("inf")
    if not one.size or np.array_equal(_bits(one), _bits(other)):
        return None
    amount = float(np.abs(one - other).max())
    if not np.isfinite(amount):
        return float("inf")
    most = max(1.0, float(np.abs(one).max()), float(np.abs(other).max()))
    return None if relative > 0.0 and amount <= relative * most else amount
