r"""A table of offsets as lines: what it says and no more, for hulls no rule completes.

Examples
--------
>>> from assoc_hull.io.offsets.lines import lines_of_table, net_of_lines
>>> from assoc_hull.io.offsets.read import read_offsets
>>> text = "# unit: m\nx_m,z_keel,wl_1,wl_2\n0,1,0,2\n5,0.5,3,4\n9,0.5,3,5\n14,,0,2\n"
>>> table, _ = read_offsets(text)
>>> lines = lines_of_table(table)
>>> [line.name for line in lines]
['ST 0', 'ST 5', 'ST 9', 'ST 14', 'WL 1', 'deck edge']
>>> lines[1].points.tolist()
[[5.0, 0.0, 0.5], [5.0, 3.0, 1.0], [5.0, 4.0, 2.0]]
>>> len(net_of_lines(table)[1].lines)
6
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from assoc_hull.edit.adoption.adopt import adopt
from assoc_hull.edit.adoption.report import AdoptionReport
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.lines.raw_lines import plane_name
from assoc_hull.io.offsets.net import ASSOCIATIONS, particulars_of_table
from assoc_hull.io.offsets.table import OffsetTable
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.state import HullState, Particulars
from assoc_hull.tolerance import Tolerances

__all__ = ["lines_of_table", "net_of_lines"]

_SAME = 1e-9
_LEVEL = 1e-6
"""The plane of a waterline this close (m) to the base line touches a flat bottom."""


def net_of_lines(
    table: OffsetTable,
    particulars: Particulars | None = None,
    tolerances: Tolerances | None = None,
) -> tuple[HullState, AdoptionReport]:
    """Adopt the lines of a table; profile, ends and flats are left open.

    Parameters
    ----------
    table : OffsetTable
        Any table.
    particulars : Particulars or None
        From the table if None.
    tolerances : Tolerances or None
        Defaults if None.

    Returns
    -------
    HullState, AdoptionReport

    Raises
    ------
    BadInputError
        A table whose lines do not make a net.
    """
    lines = lines_of_table(table)
    groups = {line.group for line in lines}
    links = [each for each in ASSOCIATIONS if {each.a, each.b} <= groups]
    return adopt(lines, particulars or particulars_of_table(table), links, tolerances)


def lines_of_table(table: OffsetTable) -> list[LineSource]:
    """Give sections, waterlines and the deck edge of a table.

    A blank between two numbers ends a curve; of zeros in a row those count that lie next to a
    half-breadth. Heights of buttocks are points of the sections. The deck edge is what the table
    calls so, else its highest waterline.

    Parameters
    ----------
    table : OffsetTable
        Any table.

    Returns
    -------
    list of LineSource
    """
    found = [
        LineSource.make(
            "sections", plane_name("sections", x), points, plane=((1.0, 0.0, 0.0), x)
        )
        for i, x in enumerate(table.x.tolist()) for points in _section(table, i)
    ]  # fmt: skip
    levels = len(table.z) - (table.deck_height is None)
    found += [
        LineSource.make(
            "waterlines", plane_name("waterlines", z), points, plane=((0.0, 0.0, 1.0), z)
        )
        for j, z in enumerate(table.z[:levels].tolist()) if z > _LEVEL
        for points in _waterline(table, j)
    ]  # fmt: skip
    for points in _deck(table):
        level = float(points[0, 2]) if np.ptp(points[:, 2]) < _SAME else None
        plane = None if level is None else ((0.0, 0.0, 1.0), level)
        found.append(
            LineSource.make("boundary", "deck edge", points, plane=plane, boundary=BoundaryKind.END)
        )
    return found


def _section(table: OffsetTable, i: int) -> Iterator[FloatArray]:
    runs: list[FloatArray] = [
        np.column_stack([y, z]) for y, z in _runs(table.half_breadth[i], table.z)
    ]
    if not runs:
        return
    keel = 0.0 if table.keel is None else float(table.keel[i])
    first = runs[0][0]
    if np.isfinite(keel) and (keel, 0.0) < (first[1], first[0]) and first[0] > 0.0:
        runs[0] = np.vstack([[0.0, keel], runs[0]])
    if table.deck_height is not None and table.deck_half_breadth is not None:
        edge = np.array([table.deck_half_breadth[i], table.deck_height[i]])
        if np.isfinite(edge).all() and edge[1] > runs[-1][-1, 1] + _SAME:
            runs[-1] = np.vstack([runs[-1], edge])
    runs[0] = _with_buttocks(runs[0], table, i)
    for run in runs:
        if len(run) > 1:
            yield np.column_stack([np.full(len(run), table.x[i]), run])


def _with_buttocks(run: FloatArray, table: OffsetTable, i: int) -> FloatArray:
    """Put heights of buttocks among the points of the lowest run, below its largest breadth."""
    if table.buttock_height is None:
        return run
    heights = table.buttock_height[i]
    widest = run[int(run[:, 0].argmax())]
    wanted = (heights < widest[1] - _SAME) & (table.buttock_y < widest[0])
    wanted &= (heights >= run[0, 1]) & (table.buttock_y > run[0, 0] + _SAME)
    every = np.vstack([run, np.column_stack([table.buttock_y, heights])[wanted]])
    every = every[np.lexsort((every[:, 0], every[:, 1]))]
    kept = np.append(True, np.linalg.norm(np.diff(every, axis=0), axis=1) > 1e-3)
    return np.asarray(every[kept])


def _waterline(table: OffsetTable, j: int) -> Iterator[FloatArray]:
    for y, x in _runs(table.half_breadth[:, j], table.x):
        if len(x) > 1:
            yield np.column_stack([x, y, np.full(len(x), table.z[j])])


def _deck(table: OffsetTable) -> Iterator[FloatArray]:
    if table.deck_height is None or table.deck_half_breadth is None:
        yield from _waterline(table, len(table.z) - 1)
        return
    known = np.isfinite(table.deck_height) & np.isfinite(table.deck_half_breadth)
    if known.sum() > 1:
        points = np.column_stack([table.x, table.deck_half_breadth, table.deck_height])
        yield points[known]


def _runs(y: FloatArray, at: FloatArray) -> Iterator[tuple[FloatArray, FloatArray]]:
    """Give the runs of numbers, with one nil at either end where there is one."""
    wide = np.nan_to_num(y) > 0.0
    known = np.isfinite(y)
    near = np.zeros(len(y), np.bool_)
    near[1:] |= wide[:-1]
    near[:-1] |= wide[1:]
    keep = known & (wide | near)
    edges = np.flatnonzero(np.diff(np.concatenate([[0], keep, [0]])))
    for first, stop in edges.reshape(-1, 2).tolist():
        yield y[first:stop], at[first:stop]
