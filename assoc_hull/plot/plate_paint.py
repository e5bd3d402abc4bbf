"""Painting plates onto a sheet: regions in red, green and blue, each with its sign."""

from __future__ import annotations

import math

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.plot.labels import resample
from assoc_hull.plot.paper import POINT, Pen
from assoc_hull.plot.plate_scene import Shape
from assoc_hull.plot.plate_view import Place
from assoc_hull.plot.sheet import Sheet

__all__ = ["BORDER", "SIGNS", "TINTS", "colours", "fill", "hatched", "paint", "signs"]

TINTS = {1: "#d5604f", 0: "#d3e8b6", -1: "#5b93c9"}
"""Red, green and blue that differ in lightness too."""

SIGNS = {1: "+", 0: "0", -1: "−"}
"""What is written on regions, so that colour alone does not carry what they are."""

BORDER = Pen(0.32, "black", over=2.6)
_EDGE = Pen(0.2, "0.2", over=2.4)
_DARKEST = 0.72
_CLEAR, _APART, _MOST = 2.2, 32.0, 5
"""mm at A3: a sign from the border of its region, and from the next one; so many at most."""

_RINGS = 60
"""More spots than these are a line or an area, which the hatching shows."""


def colours(shape: Shape) -> FloatArray:
    """Give the colours of regions, (k, 3)."""
    from matplotlib.colors import to_rgb

    palette = np.array([to_rgb(TINTS[sign]) for sign in (-1, 0, 1)])
    return np.asarray(palette[shape.tint + 1])


def fill(
    sheet: Sheet, corner: FloatArray, colour: FloatArray, name: str, *, over: float = 1.5
) -> None:
    """Fill polygons (k, c, 2), mm, with colours (k, 3); no gap is seen between neighbours."""
    from matplotlib.collections import PolyCollection

    if len(corner):
        sheet.axes.add_collection(
            PolyCollection(
                list(corner), facecolors=colour, edgecolors=colour,
                linewidths=0.12 * sheet.paper.factor / POINT, joinstyle="bevel",
                snap=False, zorder=over, gid=name,
            ),
            autolim=False,
        )  # fmt: skip


def paint(
    sheet: Sheet, place: Place, shape: Shape, colour: FloatArray, name: str, *, shaded: bool = False
) -> None:
    """Paint a plate.

    Parameters
    ----------
    sheet : Sheet
        Where to draw.
    place : Place
        Where the plate lies on it, and from where it is seen.
    shape : Shape
        The plate.
    colour : (k, 3)
        Of the tiles.
    name : str
        Begins the ids of what is drawn.
    shaded : bool
        Whether there is light on the plate.
    """
    if shaded:
        bright = _DARKEST + (1.0 - _DARKEST) * place.eye.lit(shape.normal)
        colour = colour * bright[:, None]
    order = _order(place, shape)
    fill(sheet, place.on_paper(shape.corner)[order], colour[order], f"{name}/tiles")
    for edge in shape.edges:
        sheet.line(place.on_paper(edge), _EDGE, f"{name}/edge")
    spots = [shape.unresolved.mean(axis=1)]
    for component, lines in shape.lines:
        spots += [line for line in lines if len(line) == 1]
        for line in lines:
            sheet.line(place.on_paper(line), BORDER, f"{name}/line/{component.level:g}")
    _unresolved(sheet, place, shape.unresolved, np.concatenate(spots), name)


def _order(place: Place, shape: Shape) -> IntArray:
    """Give the tiles from the farthest to the nearest, the ground before what lies on it."""
    near = place.toward(shape.corner)
    key = np.where(shape.under, near.min(axis=1), near.max(axis=1))
    return np.argsort(key, kind="stable")


def _unresolved(
    sheet: Sheet, place: Place, corner: FloatArray, spots: FloatArray, name: str
) -> None:
    """Hatch cells that are unresolved, and draw rings around them: most are too small to see."""
    if len(corner):
        hatched(sheet, place.on_paper(corner), f"{name}/unresolved")
    seen = place.on_paper(spots)
    _, first = np.unique(np.round(seen), axis=0, return_index=True)
    if 0 < len(first) <= _RINGS:
        _rings(sheet, seen[np.sort(first)], f"{name}/ring")


def hatched(sheet: Sheet, corner: FloatArray, name: str) -> None:
    """Hatch polygons (k, c, 2), or one (c, 2), mm."""
    from matplotlib.collections import PolyCollection

    rings = corner.reshape(-1, *corner.shape[-2:])
    sheet.axes.add_collection(
        PolyCollection(list(rings), facecolors="white", edgecolors="black", hatch="xxxxxx",
                       linewidths=0.0, zorder=2.2, gid=name),
        autolim=False,
    )  # fmt: skip


def _rings(sheet: Sheet, centre: FloatArray, name: str) -> None:
    from matplotlib.lines import Line2D

    wide = 2.0 * sheet.paper.factor / POINT
    sheet.axes.add_line(
        Line2D(
            centre[:, 0], centre[:, 1], linestyle="", marker="o", markersize=wide, fillstyle="none",
            markeredgecolor="black", markeredgewidth=0.14 / POINT, zorder=4.0, gid=name,
        )
    )  # fmt: skip


def signs(sheet: Sheet, place: Place, shape: Shape, name: str) -> None:
    """Write the sign of each region where it is widest, once or a few times."""
    from scipy.spatial import cKDTree

    factor, tint = sheet.paper.factor, shape.tint
    corner = place.on_paper(shape.corner)
    middle = corner.mean(axis=1)
    room = np.array(cKDTree(_borders(place, shape)).query(middle)[0], np.float64)
    if shape.under.any() and not shape.under.all():
        over = corner[~shape.under]
        halves = 0.5 * (over + np.roll(over, 1, axis=1))
        dense = np.concatenate([over, halves, middle[~shape.under, None]], axis=1)
        # What lies beyond a border is no nearer than this; so these are covered.
        covered = cKDTree(dense.reshape(-1, 2)).query(middle)[0] < room
        room[shape.under & covered] = 0.0
    for sign in np.unique(tint).tolist():
        own = tint == sign
        for x, y in _apart(middle[own], room[own], _CLEAR * factor, _APART * factor):
            sheet.text((x, y), SIGNS[sign], size=1.9, bold=True, colour="0.1",
                       name=f"{name}/sign/{sign}")  # fmt: skip


def _borders(place: Place, shape: Shape) -> FloatArray:
    """Give close places along all lines and edges of a plate, (k, 2), mm."""
    lines = [line for _, lines in shape.lines for line in lines]
    return np.concatenate([resample(place.on_paper(line), 0.7) for line in (*lines, *shape.edges)])


def _apart(
    places: FloatArray, room: FloatArray, least: float, apart: float
) -> list[tuple[float, float]]:
    """Choose places with most room, some way from one another."""
    chosen: list[tuple[float, float]] = []
    for k in np.argsort(-np.round(room, 2), kind="stable").tolist():
        if room[k] < least or len(chosen) == _MOST:
            break
        x, y = places[k].tolist()
        if all(math.hypot(x - a, y - b) > apart for a, b in chosen):
            chosen.append((x, y))
    return chosen
