"""Bays beyond the borders of a block: as far as the next line, on its master's side.

A surface is fitted over them too and cut at the border, so that its end is not its worst place.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.surface.blocks.cuts import EndCut
from assoc_hull.surface.blocks.quad import Quad
from assoc_hull.surface.blocks.region import Chord, Region

__all__ = ["bays_of_parts", "bays_of_whole"]

Bays = dict[str, Quad]


def bays_of_whole(whole: Region, end: EndCut) -> Bays:
    """Give the bay beside an end that is one block.

    Parameters
    ----------
    whole : Region
        The half hull.
    end : EndCut
        How the end is cut off.
    """
    strip = _strip(whole, end)
    found = None if strip is None else _bay(strip, end, end.section.first, end.section.last)
    return {} if found is None else {_side(end): found}


def bays_of_parts(whole: Region, end: EndCut, upper: Region, high: int) -> tuple[Bays, Bays]:
    """Give the bays beside the two blocks of an end that is cut along a waterline.

    Parameters
    ----------
    whole : Region
        The half hull.
    end : EndCut
        How the end is cut off.
    upper : Region
        The part above the waterline.
    high : int
        A half-edge of the waterline that has this part on its left.

    Returns
    -------
    dict of str to Quad, twice
        Bays of the upper and of the lower block; the latter reaches beyond the waterline as well.
    """
    strip, side, line = _strip(whole, end), _side(end), end.along[0]
    carried = [None if strip is None else _carried(strip, each) for each in end.along]
    above, below = Bays(), Bays()
    base = carried[0]
    if strip is not None and base is not None:
        upward = int(base.half[0]) ^ (end.kind == "stern")
        for bays, half, top, bottom in (
            (above, upward, end.section.first, line.first),
            (below, upward ^ 1, line.first, end.section.last),
        ):
            found = _bay(strip.with_half([base.half], half), end, top, bottom)
            if found is not None:
                bays[side] = found
    if len(end.along) == 1:
        return above, below
    next_line = end.along[1]
    part = upper.with_half([next_line.half], high)
    if part is not None and part.is_disc:
        below["v0"] = _across(end, part)
    over = carried[1]
    if strip is not None and base is not None and over is not None and "v0" in below:
        between = strip.with_half([base.half, over.half], upward)
        found = _bay(between, end, next_line.first, line.first)
        if found is not None:
            below[f"{side} v0"] = found
    return above, below


def _side(end: EndCut) -> str:
    """Tell on which side of the blocks of an end the body lies."""
    return "u1" if end.kind == "stern" else "u0"


def _strip(whole: Region, end: EndCut) -> Region | None:
    """Give the bay of the body beside an end."""
    if end.beside is None:
        return None
    cuts = [end.section.half, end.beside.half]
    found = whole.with_half(cuts, int(end.section.half[0]) ^ (end.kind == "stern"))
    return found if found is not None and found.is_disc else None


def _bay(region: Region | None, end: EndCut, top: int, bottom: int) -> Quad | None:
    """Give a bay beside a part of a section as a quad, if it has corners."""
    other = end.beside
    if region is None or other is None or not region.is_disc:
        return None
    node = set(region.begin(region.loop).tolist())
    far = [
        each for each in np.append(region.begin(other.half), other.last).tolist() if each in node
    ]
    if top not in node or bottom not in node or len(far) < 2:
        return None
    aft = end.kind == "stern"
    corner = (top, far[0], far[-1], bottom) if aft else (far[0], top, bottom, far[-1])
    return Quad(region, corner)


def _across(end: EndCut, region: Region) -> Quad:
    """Give the strip between the two waterlines of an end as a quad."""
    line, above = end.along
    if end.kind == "stern":
        return Quad(region, (above.last, above.first, line.first, line.last))
    return Quad(region, (above.first, above.last, line.last, line.first))


def _carried(strip: Region, line: Chord) -> Chord | None:
    """Give the same line through the bay beside it, from the section on."""
    for chord in strip.chords(line.curve):
        for run in (chord, chord.reversed()):
            if run.first == line.first:
                return run
    return None
