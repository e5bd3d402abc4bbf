"""Painting tiles of a hull onto a sheet: colours, hatching, pieces of line.

Tiles are so many that they are kept as dots also in pictures of lines (PDF, SVG); words, seams and
frames stay lines.
"""

from __future__ import annotations

from typing import Any, cast

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.plot.sheet.paper import POINT, Pen
from assoc_hull.plot.sheet.sheet import Sheet
from assoc_hull.plot.sheet.view import View

__all__ = ["CONTESTED", "MARGIN_TINT", "hatch", "painted", "segments", "tiles_in"]

CONTESTED = "#7a5200"
"""Colour of the hatching of what is contested."""

MARGIN_TINT = "#c9c9c9"
"""Colour of what lies beside borders of blocks."""


def painted(sheet: Sheet, corner: FloatArray, colour: FloatArray, name: str) -> None:
    """Fill tiles (k, 4, 2), mm, with colours (k, 3), in their order."""
    from matplotlib.collections import PolyCollection

    if not len(corner):
        return
    sheet.axes.add_collection(
        PolyCollection(
            cast("Any", corner), facecolors=colour, edgecolors=colour, linewidths=0.15,
            snap=False, zorder=1.5, gid=name, rasterized=True,
        ),
        autolim=False,
    )  # fmt: skip


def tiles_in(sheet: Sheet, view: View, corner: FloatArray, colour: FloatArray) -> None:
    """Fill tiles (k, 4, 4), m, in a view."""
    flat = view.on_paper(corner.reshape(-1, corner.shape[-1])).reshape(-1, 4, 2)
    painted(sheet, flat, colour, f"{view.name}/tiles")


def hatch(sheet: Sheet, view: View, corner: FloatArray) -> None:
    """Hatch tiles (k, 4, 4), m, in a view: all as one shape, so that hatching runs through."""
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    if not len(corner):
        return
    flat = view.on_paper(corner.reshape(-1, corner.shape[-1])).reshape(-1, 4, 2)
    rings = np.concatenate([flat, flat[:, :1]], axis=1).reshape(-1, 2)
    codes = np.tile([Path.MOVETO, *[Path.LINETO] * 3, Path.CLOSEPOLY], len(flat))
    sheet.axes.add_patch(
        PathPatch(
            Path(rings, codes), facecolor="none", edgecolor=CONTESTED, linewidth=0.0,
            hatch="//////", zorder=1.8, gid=f"{view.name}/contested", rasterized=True,
        )
    )  # fmt: skip


def segments(sheet: Sheet, view: View, piece: FloatArray, pen: Pen) -> None:
    """Draw pieces of line (s, 2, 4), m, in a view."""
    from matplotlib.collections import LineCollection

    if not len(piece):
        return
    flat = view.on_paper(piece.reshape(-1, piece.shape[-1])).reshape(-1, 2, 2)
    sheet.axes.add_collection(
        LineCollection(
            cast("Any", flat), colors=pen.colour, linewidths=pen.width * sheet.paper.factor / POINT,
            capstyle="round", zorder=pen.over, gid=f"{view.name}/lines", rasterized=True,
        ),
        autolim=False,
    )  # fmt: skip
