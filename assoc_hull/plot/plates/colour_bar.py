"""Colours for values on both sides of nil, and the bar that says which is which."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.plot.sheet.pens import LINE
from assoc_hull.plot.sheet.sheet import Sheet

if TYPE_CHECKING:
    from assoc_hull.plot.plates.plate_grid import Field

__all__ = ["CURVATURE", "STRAIN", "colour_bar", "shades"]

CURVATURE = ("#1f5e9e", "#74a9d8", "#e6f0d4", "#d5604f", "#96281b")
"""From saddle over developable to convex."""

STRAIN = ("#4a2a82", "#9b86c4", "#f6f5f3", "#eda55d", "#a8500a")
"""From shrinking over none to stretching; not to be taken for regions."""

_STEPS = 96


def shades(value: FloatArray, palette: Sequence[str]) -> FloatArray:
    """Give colours (..., 3) of values from -1 to 1; what lies beyond has the last colour.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.plot.plates.colour_bar import shades
    >>> shades(np.array([-5.0, 0.0]), ("#000000", "#ffffff", "#ff0000")).tolist()
    [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0]]
    """
    from matplotlib.colors import to_rgb

    colours = np.array([to_rgb(each) for each in palette])
    at = np.linspace(-1.0, 1.0, len(colours))
    found = [np.interp(value, at, colours[:, k]) for k in range(3)]
    return np.stack(found, axis=-1)


def colour_bar(
    sheet: Sheet,
    field: Field,
    palette: Sequence[str],
    marks: Sequence[tuple[float, str]],
    title: str,
) -> None:
    """Draw a level bar from -1 to 1 with marks below it and a title above.

    Parameters
    ----------
    sheet : Sheet
        Where to draw.
    field : Field
        The bar itself.
    palette : sequence of str
        The colours.
    marks : sequence of (float, str)
        Values from -1 to 1, and what is written there.
    title : str
        Above it.
    """
    from matplotlib.collections import PolyCollection

    factor = sheet.paper.factor
    edge = np.linspace(field.left, field.right, _STEPS + 1)
    low, top = np.full(_STEPS, field.low), np.full(_STEPS, field.top)
    x = np.stack([edge[:-1], edge[1:], edge[1:], edge[:-1]], axis=-1)
    y = np.stack([low, low, top, top], axis=-1)
    colour = shades(np.linspace(-1.0, 1.0, _STEPS), palette)
    sheet.axes.add_collection(
        PolyCollection(cast("Any", np.stack([x, y], axis=-1)), facecolors=colour, edgecolors=colour,
                       linewidths=0.2, zorder=1.5, gid="bar"),
        autolim=False,
    )  # fmt: skip
    ring = [(field.left, field.low), (field.right, field.low), (field.right, field.top),
            (field.left, field.top), (field.left, field.low)]  # fmt: skip
    sheet.line(np.array(ring), LINE, "bar/edge")
    for value, words in marks:
        across = 0.5 * (field.left + field.right + value * (field.right - field.left))
        sheet.rule((across, field.low), (across, field.low - 0.9 * factor), LINE, "bar/mark")
        sheet.text((across, field.low - 1.4 * factor), words, up="top", name="label/bar")
    sheet.text((field.left, field.top + 1.2 * factor), title, across="left", up="bottom",
               name="label/bar/title")  # fmt: skip
