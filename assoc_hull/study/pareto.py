"""The variants of which none is better in every respect: the front of V. Pareto.

A row is on the front if no other one is at least as good in all columns that count and better in
one. Which direction is better is what the user says; rows outside limits, and rows without a
hull, are left out.

Source: V. Pareto, Manuale di economia politica, Milan 1906.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assoc_hull.arguments import choice, shown, shown_name
from assoc_hull.errors import BadInputError, UnknownNameError, WrongTypeError
from assoc_hull.geometry.curves import FloatArray

__all__ = [
    "BETTER",
    "column_of",
    "front_of",
    "limits_of",
    "pareto_front",
    "within_limits",
]

BETTER = ("less", "more")
"""Which direction is better."""

_WHERE = "in a Pareto front"
_PART = 512


def front_of(cost: FloatArray) -> NDArray[np.bool_]:
    """Tell which rows of (n, k) costs are not dominated, (n,); rows with nan are not.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.study.pareto import front_of
    >>> front_of(np.array([[1.0, 3.0], [2.0, 2.0], [2.0, 3.0]])).tolist()
    [True, True, False]
    """
    found = np.zeros(len(cost), bool)
    known = np.flatnonzero(np.isfinite(cost).all(axis=1))
    # in this order no row is dominated by a later one
    order = known[np.lexsort(cost[known].T[::-1])]
    best = np.empty((0, cost.shape[1]))
    for i in range(0, len(order), _PART):
        part = cost[order[i : i + _PART]]
        some = np.flatnonzero(~_dominated(part, best))
        some = some[~_dominated(part[some], part[some])]
        found[order[i + some]] = True
        best = np.concatenate([best, part[some]])
    return found


def _dominated(rows: FloatArray, by: FloatArray) -> NDArray[np.bool_]:
    """Tell which rows, (n, k), one of others, (m, k), is at least as good as, and better in one."""
    found = np.zeros(len(rows), bool)
    for part in np.array_split(by, max(1, -(-len(by) // _PART))):
        ahead, behind = part[:, None] <= rows, part[:, None] < rows
        found |= (ahead.all(axis=2) & behind.any(axis=2)).any(axis=0)
    return found


def within_limits(
    table: Mapping[str, NDArray[Any]], limits: Mapping[str, object] | None
) -> NDArray[np.bool_]:
    """Tell which rows have a hull, and all columns within limits, (n,).

    Parameters
    ----------
    table : mapping of str to (n,)
        As `Study.table` gives it.
    limits : mapping of str to (float or None, float or None)
        Least and greatest value by column; None leaves an end open.

    Raises
    ------
    UnknownNameError, BadInputError, WrongTypeError
        No such column of numbers; no two ends, the lower one first.
    """
    found: NDArray[np.bool_] = table["failure"] == ""
    if limits is not None and not isinstance(limits, Mapping):
        raise WrongTypeError(f"within is {shown(limits)}", _WHERE, "give (low, high) by column")
    for name, ends in (limits or {}).items():
        low, high = limits_of(ends, name)
        column = column_of(table, name)
        found = found & (column >= low) & (column <= high)
    return found


def limits_of(given: object, name: object) -> tuple[float, float]:
    """Take a least and a greatest value; None leaves an end open.

    Raises
    ------
    BadInputError
        Anything else.
    """
    fault = BadInputError(
        f"the limits of {shown_name(name)} are {shown(given)}", _WHERE,
        "give (low, high), the lower first; None leaves an end open",
    )  # fmt: skip
    if not isinstance(given, tuple | list) or len(given) != 2:
        raise fault
    usual = -np.inf, np.inf
    ends = [limit if each is None else each for each, limit in zip(given, usual, strict=True)]
    if not all(isinstance(each, int | float) and not isinstance(each, bool) for each in ends):
        raise fault
    if not ends[0] <= ends[1]:
        raise fault
    return ends[0], ends[1]


def column_of(table: Mapping[str, NDArray[Any]], name: object) -> FloatArray:
    """Give a column of numbers of the table of a study.

    Raises
    ------
    UnknownNameError
        There is none of this name.
    """
    known = [each for each, column in table.items() if column.dtype.kind in "fib"]
    if name not in known:
        raise UnknownNameError("column", shown_name(name), tuple(known))
    return table[str(name)].astype(np.float64)


def pareto_front(
    table: Mapping[str, NDArray[Any]],
    better: Mapping[str, str],
    within: Mapping[str, object] | None = None,
) -> NDArray[np.bool_]:
    """Tell which rows of the table of a study are on the front, (n,); see `Study.front`.

    Raises
    ------
    UnknownNameError, BadInputError, WrongTypeError
        No such column, no such direction, or limits that are none.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.study.pareto import pareto_front
    >>> table = {"cb": np.array([0.8, 0.7, 0.6]), "kmt": np.array([5.0, 6.0, 5.5]),
    ...          "failure": np.array(["", "", ""], object)}
    >>> pareto_front(table, {"cb": "more", "kmt": "more"}).tolist()
    [True, True, False]
    """
    if not isinstance(better, Mapping):
        what = f"better is {shown(better)}"
        raise WrongTypeError(what, _WHERE, "say 'less' or 'more' by the names of columns")
    if not better:
        what = "no column is named that counts"
        raise BadInputError(what, _WHERE, "say 'less' or 'more' by the names of columns")
    signs = {"less": 1.0, "more": -1.0}
    costs = [
        signs[choice(way, f"better of {shown_name(name)}", BETTER, _WHERE)] * column_of(table, name)
        for name, way in better.items()
    ]
    admitted = within_limits(table, within)
    cost = np.where(admitted[:, None], np.column_stack(costs), np.nan)
    return front_of(cost)
