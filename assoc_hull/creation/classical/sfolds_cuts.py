"""By which planes the net of a ship of portions is cut: those its widest section is given on."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from assoc_hull.creation.classical.sfolds_portion import Portion
from assoc_hull.geometry.classical.ordinate_section import OrdinateSection

__all__ = ["default_cuts"]

_MOST = 12
"""More lines of a family than this are thinned out."""

_APART = 0.05
"""A waterline nearer to the draught than this part of it stands for it."""


def default_cuts(portions: Sequence[Portion], draught: float) -> dict[str, tuple[float, ...]]:
    """Give half-breadths of buttocks and heights of waterlines, m.

    Buttocks come first: where the bottom rises slowly, as at a broad stern, they run along it and
    waterlines turn sharply. So the net gets its shape there from the lines that are smooth.

    Parameters
    ----------
    portions : sequence of Portion
        Those of the main body count.
    draught : float, m
        Has a waterline of its own where none is near.
    """
    sections = [each for portion in portions if portion.is_main for each in portion.sections]
    if not sections:
        return {"buttocks": (), "waterlines": ()}
    widest = max(sections, key=lambda each: each.area)
    top = min(each.hd for each in sections)
    heights = widest.side.places[1:]
    heights = heights[heights < top - 0.25 * widest.sw]
    if draught < top and np.abs(heights - draught).min(initial=np.inf) > _APART * draught:
        heights = np.sort(np.append(heights, draught))
    return {
        "buttocks": _thinned(_buttocks(widest)),
        "waterlines": _thinned(heights.tolist()),
    }


def _buttocks(widest: OrdinateSection) -> list[float]:
    if widest.bottom is None:
        return [part * widest.deck_breadth for part in (0.25, 0.5, 0.75)]
    inside = widest.bottom.places <= widest.side.values[0] + 1e-9 * widest.sb
    return [float(y) for y in widest.bottom.places[inside][1:]]


def _thinned(places: Sequence[float]) -> tuple[float, ...]:
    return tuple(places[:: -(-len(places) // _MOST)] if places else ())
