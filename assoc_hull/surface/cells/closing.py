"""A filled half hull is covered where it is open, as far as the centre plane, and mirrored."""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.numeric.vectors import dot
from assoc_hull.surface.cells.filling import FilledCells
from assoc_hull.surface.cells.stops import united

__all__ = ["SHELL", "Sheets", "cover", "mirrored"]

SHELL = "shell"
"""The name of the group of the hull itself."""

_ON_CENTRE = 1e-6
"""Places on the border so near to the centre plane (lengths of the hull) lie in it."""
_COINCIDE = 1e-8
"""Vertices on one edge so near to one another (lengths of the hull) are one."""

_CAPS = {"deck edge": "deck"}
"""What is closed by a line other than by its own name."""


@attrs.frozen(eq=False)
class Sheets:
    """Triangles of a hull in groups.

    Attributes
    ----------
    xyz : (v, 3), m
        Vertices.
    triangle : (f, 3) int
        Counter-clockwise from outside.
    group : (f,) int
        The group of each, in `names`.
    cell : (f,) int
        The cell of the net that each lies in; -1 in what closes the hull.
    central : (v,) bool
        Vertices in the centre plane at which the halves meet.
    names : tuple of str
        The groups: the shell, and what closes it, by the lines at its border.
    collapsed : int
        Triangles that vanished because two of their corners coincide.
    """

    xyz: FloatArray
    triangle: IntArray
    group: IntArray
    cell: IntArray
    central: NDArray[np.bool_]
    names: tuple[str, ...]
    collapsed: int


def cover(filled: FilledCells) -> Sheets:
    """Close a half hull but for the centre plane: deck, transom and other ends.

    What the border encloses is ruled across the ship, from each place on it to the centre plane:
    a plane where deck or transom is one. The camber of a deck is not there.
    """
    graph, outline = filled.cells.graph, filled.cells.outline
    curve = graph.curve[outline >> 1]
    rim = filled.along(outline)
    xyz, central = _on_centre(filled.xyz, rim, graph.net.centre[curve])
    aside = np.flatnonzero(~central[rim].all(axis=1))
    named = [_CAPS.get(graph.net.name[c], graph.net.name[c]) for c in curve[aside].tolist()]
    names = (SHELL, *dict.fromkeys(named))
    group = np.array([names.index(each) for each in named], np.int64)
    xyz, central, quad = _across(xyz, central, rim[aside])
    shell, cell = filled.triangles()
    caps = np.concatenate([quad[:, [0, 1, 2]], quad[:, [0, 2, 3]]])
    triangle = np.concatenate([shell, caps])
    of_caps = np.tile(np.repeat(group, filled.steps), 2)
    found = Sheets(
        xyz, triangle,
        np.concatenate([np.zeros(len(shell), np.int64), of_caps]),
        np.concatenate([cell, np.full(len(caps), -1)]),
        central, names, 0,
    )  # fmt: skip
    return _collapsed(found)


def _on_centre(
    xyz: FloatArray, rim: IntArray, centre: NDArray[np.bool_]
) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Lay the border into the centre plane where its lines lie there."""
    near = _ON_CENTRE * float(np.ptp(xyz[:, 0]))
    central = np.zeros(len(xyz), bool)
    central[rim[centre]] = True
    central[rim[np.abs(xyz[rim, 1]) <= near]] = True
    placed = xyz.copy()
    placed[central, 1] = 0.0
    return placed, central


def _across(
    xyz: FloatArray, central: NDArray[np.bool_], rim: IntArray
) -> tuple[FloatArray, NDArray[np.bool_], IntArray]:
    """Give elements from the border to the centre plane, with the vertices that they add there."""
    outer = np.unique(rim[~central[rim]])
    foot = np.arange(len(xyz))
    foot[outer] = len(xyz) + np.arange(len(outer))
    added = xyz[outer] * [1.0, 0.0, 1.0]
    begin, finish = rim[:, :-1].ravel(), rim[:, 1:].ravel()
    quad = np.column_stack([begin, finish, foot[finish], foot[begin]])
    return (
        np.concatenate([xyz, added]),
        np.concatenate([central, np.ones(len(outer), bool)]),
        quad,
    )


def _collapsed(sheets: Sheets) -> Sheets:
    """Make vertices one that coincide, and take away triangles that have lost a corner by it."""
    triangle = sheets.triangle
    edge = np.concatenate([triangle[:, [0, 1]], triangle[:, [1, 2]], triangle[:, [2, 0]]])
    step = sheets.xyz[edge[:, 0]] - sheets.xyz[edge[:, 1]]
    near = (_COINCIDE * float(np.ptp(sheets.xyz[:, 0]))) ** 2
    pair = edge[(dot(step, step) <= near) & (edge[:, 0] != edge[:, 1])]
    one = np.arange(len(sheets.xyz))
    if len(pair):
        one = united(len(sheets.xyz), pair)
    central = sheets.central.copy()
    central[one[sheets.central]] = True
    xyz = sheets.xyz.copy()
    xyz[central, 1] = 0.0
    triangle = one[triangle]
    # Elements with two equal corners were triangles from the start.
    stays = (triangle != np.roll(triangle, 1, axis=1)).all(axis=1)
    whole = (sheets.triangle != np.roll(sheets.triangle, 1, axis=1)).all(axis=1)
    return _used(
        attrs.evolve(
            sheets, xyz=xyz, triangle=triangle[stays], group=sheets.group[stays],
            cell=sheets.cell[stays], central=central, collapsed=int((whole & ~stays).sum()),
        )
    )  # fmt: skip


def _used(sheets: Sheets) -> Sheets:
    """Leave out vertices of no triangle."""
    used = np.unique(sheets.triangle)
    number = np.full(len(sheets.xyz), -1, np.int64)
    number[used] = np.arange(len(used))
    return attrs.evolve(
        sheets, xyz=sheets.xyz[used], triangle=number[sheets.triangle], central=sheets.central[used]
    )


def mirrored(sheets: Sheets) -> Sheets:
    """Give both sides of the hull: port first, then starboard."""
    across = np.flatnonzero(~sheets.central)
    twin = np.arange(len(sheets.xyz))
    twin[across] = len(sheets.xyz) + np.arange(len(across))
    return Sheets(
        np.concatenate([sheets.xyz, sheets.xyz[across] * [1.0, -1.0, 1.0]]),
        np.concatenate([sheets.triangle, twin[sheets.triangle][:, ::-1]]),
        np.tile(sheets.group, 2),
        np.tile(sheets.cell, 2),
        np.concatenate([sheets.central, np.zeros(len(across), bool)]),
        sheets.names,
        2 * sheets.collapsed,
    )
