"""Many copies of a net side by side in one hull: own groups, no crossing between copies."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from assoc_hull.graph.journal import Journal
from assoc_hull.graph.table import Column
from assoc_hull.model.births import Births
from assoc_hull.model.index import build_index
from assoc_hull.model.keys import crossing_key
from assoc_hull.model.kinds import Sort
from assoc_hull.model.network import HullNetwork
from assoc_hull.model.node import Node
from assoc_hull.model.tables import Association, CurveIntersections, HullState

__all__ = ["copies_of"]

STEP = 200.0
"""Distance (m) from one copy to the next, along x."""

REFERS = {
    ("lines", "group"): "groups",
    ("curves", "line"): "lines",
    ("rows", "curve"): "curves",
    ("rows", "reader"): "curves",
    ("rows", "driver"): "curves",
    ("rows", "anchor"): "rows",
}
"""Columns that hold numbers of rows of another table, or -1."""

PLACES = {("rows", "xyz"), ("rows", "spot")}


def copies_of(net: HullState, count: int) -> HullState:
    """Give a hull that holds a net `count` times."""
    state = HullState(net.particulars, net.tolerances)
    for name in ("groups", "lines", "curves", "rows"):
        source, target = getattr(net, name), getattr(state, name)
        target.resize(count * source.count)
        for title, column in source.columns.items():
            copy = _array_copy if isinstance(column, Column) else _list_copy
            for number in range(count):
                copy(net, target.columns[title], column, (name, title), number)
    _settings(net, state, count)
    _loft(state)
    return state


def _array_copy(
    net: HullState, target: Any, source: Any, which: tuple[str, str], number: int
) -> None:
    size = len(source.data)
    block = source.data.copy()
    if which in REFERS:
        block[source.data >= 0] += number * getattr(net, REFERS[which]).count
    elif which in PLACES:
        block[..., 0] += number * STEP
    elif which == ("rows", "base"):
        # Crossings ride with nothing, and have none.
        block[net.rows.sort.data != Sort.CROSSING, 0] += number * STEP
    elif which == ("lines", "offset"):
        block += number * STEP * net.lines.normal[:, 0]
    target.put(np.arange(number * size, (number + 1) * size), block)


def _list_copy(
    net: HullState, target: Any, source: Any, which: tuple[str, str], number: int
) -> None:
    lines, curves, rows = (
        number * getattr(net, name).count for name in ("lines", "curves", "rows")
    )
    turns: dict[tuple[str, str], Callable[[Any], Any]] = {
        ("groups", "name"): lambda name: _named(name, number),
        ("lines", "key"): lambda key: _named(key, number),
        ("curves", "key"): lambda key: _named(key, number),
        ("lines", "curves"): lambda each: tuple(curve + curves for curve in each),
        ("curves", "rows"): lambda each: each + rows,
        ("curves", "meets"): lambda each: _meets(each, lines, rows),
    }
    turn = turns.get(which, lambda each: each)
    size = len(source.data)
    if which == ("rows", "key"):
        target.data[number * size : (number + 1) * size] = list(_keys(net, number))
        return
    target.data[number * size : (number + 1) * size] = [turn(each) for each in source.data]


def _meets(meets: CurveIntersections, lines: int, rows: int) -> CurveIntersections:
    row = np.where(meets.row >= 0, meets.row + rows, -1)
    return CurveIntersections(meets.line + lines, meets.sign, row, meets.parameter, meets.xyz)


def _keys(net: HullState, number: int) -> Iterator[str]:
    """Give the keys of points; those of crossings say the keys of their lines, as always."""
    table, lines = net.rows, net.lines.key.data
    for row, key in enumerate(table.key.data):
        if table.sort[row] == Sort.CROSSING:
            a, b = (_named(lines[net.line_of(curve)], number) for curve in table.curve[row])
            yield crossing_key(a, b, int(table.sign[row]), int(table.birth[row]))
        else:
            yield _named(key, number)


def _named(name: str, number: int) -> str:
    return f"{name} #{number}"


def _settings(net: HullState, state: HullState, count: int) -> None:
    links: list[Association] = []
    births: dict[tuple[str, str], int] = {}
    for number in range(count):
        links += [
            Association(_named(link.a, number), _named(link.b, number), link.two_way)
            for link in net.associations
        ]
        births |= {
            (_named(a, number), _named(b, number)): born for (a, b), born in net.births.items()
        }
    state.settings.associations.data[0] = tuple(links)
    state.settings.births.data[0] = Births.of(births)


def _loft(state: HullState) -> None:
    """Loft and cut every copy where it stands."""
    index, journal = build_index(state), Journal()
    network = HullNetwork(state, index)
    for level in range(int(index.level.max()) + 1):
        curves = np.flatnonzero(index.level == level)
        network.evaluate(Node.curve(curves), journal)
        driven = [index.drives[curve] for curve in curves.tolist() if curve in index.drives]
        if driven:
            network.evaluate(Node.point(np.sort(np.concatenate(driven))), journal)
    if network.realigned:
        raise AssertionError("a copy has other crossings than the net")
