"""Labels in a row beside a view, moved apart as little as possible, with leaders."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.numeric.interval_spacing import spread
from assoc_hull.plot.sheet.paper import MARGIN, Pen
from assoc_hull.plot.sheet.sheet import Sheet

if TYPE_CHECKING:
    from matplotlib.text import Text

__all__ = ["Side", "overlaps", "rail"]

Side = Literal["left", "right", "below", "above"]

_LEADER = Pen(0.07, "0.45", over=1.5)
_GAP, _GAP_ALONG = 0.35, 0.9  # mm at A3 between two labels above, and beside one another


def rail(
    sheet: Sheet,
    anchors: FloatArray,
    words: Sequence[str],
    side: Side,
    at: float,
    *,
    upright: bool = False,
    heading: str = "",
    sparse: bool = False,
    name: str = "label",
) -> None:
    """Write labels in a row beside a view, each with a leader to what it names.

    Parameters
    ----------
    sheet : Sheet
        Where to draw.
    anchors : (k, 2), mm
        Where the named lines end.
    words : sequence of k str
        The labels.
    side : "left", "right", "below" or "above"
        On which side of the view the row lies.
    at : float, mm
        Where the row begins: its edge toward the view.
    upright : bool
        Whether the words run upward.
    heading : str
        Written before the row.
    sparse : bool
        Whether labels may be left out where the row would cover others or leave the frame: then
        those are written that have room right beside what they name.
    name : str
        Begins the ids of the labels.
    """
    if not len(words):
        return
    along = 1 if side in ("left", "right") else 0
    texts = [_write(sheet, side, at, upright, each, f"{name}/{each}") for each in words]
    boxes = np.array([sheet.box(text) for text in texts])
    size = boxes[:, along + 2] - boxes[:, along]
    gap = (_GAP if upright or along else _GAP_ALONG) * sheet.paper.factor
    place = spread(anchors[:, along], size, gap)
    shift = place - 0.5 * (boxes[:, along + 2] + boxes[:, along])
    boxes[:, [along, along + 2]] += shift[:, None]
    if sparse and (_leaves(sheet, boxes) or any(overlaps(box, sheet.taken) for box in boxes)):
        for text in texts:
            text.remove()
        kept = _with_room(anchors[:, along], size + gap)
        some = [words[i] for i in kept]
        rail(sheet, anchors[kept], some, side, at, upright=upright, heading=heading, name=name)
        return
    for text, anchor, middle, move in zip(texts, anchors, place, shift, strict=True):
        x, y = text.get_position()
        text.set_position((x + move, y) if along == 0 else (x, y + move))
        sheet.take(text)
        end = (middle, at) if along == 0 else (at, middle)
        sheet.line(_leader(anchor, end, along), _LEADER, f"leader/{text.get_text()}")
    if heading:
        _head(sheet, _write(sheet, side, at, False, heading, f"{name}/heading"), place, size)


def _leaves(sheet: Sheet, boxes: FloatArray) -> bool:
    """Tell whether labels reach beyond the frame of the sheet."""
    edge = MARGIN * sheet.paper.factor
    size = np.array([sheet.paper.width, sheet.paper.height]) - edge
    return bool((boxes[:, :2] < edge).any() or (boxes[:, 2:] > size).any())


def _with_room(wanted: FloatArray, size: FloatArray) -> list[int]:
    """Choose, from the lowest on, the labels that do not reach into the one before."""
    kept: list[int] = []
    for i in np.argsort(wanted, kind="stable").tolist():
        if not kept or wanted[i] - wanted[kept[-1]] >= 0.5 * (size[i] + size[kept[-1]]):
            kept.append(i)
    return kept


def _head(sheet: Sheet, title: Text, place: FloatArray, size: FloatArray) -> None:
    """Put the heading of a row before it; after it where the space before is taken."""
    off = 1.2 * sheet.paper.factor
    title.set_position((float((place - 0.5 * size).min()) - off, title.get_position()[1]))
    title.set_horizontalalignment("right")
    if overlaps(sheet.box(title), sheet.taken, 0.8 * off):
        title.set_position((float((place + 0.5 * size).max()) + off, title.get_position()[1]))
        title.set_horizontalalignment("left")
    sheet.take(title)


def _write(sheet: Sheet, side: Side, at: float, upright: bool, words: str, name: str) -> Text:
    off = 0.3 * sheet.paper.factor
    angle = 90.0 if upright else 0.0
    if side == "left":
        return sheet.text((at - off, 0.0), words, across="right", name=name)
    if side == "right":
        return sheet.text((at + off, 0.0), words, across="left", name=name)
    up: Literal["top", "bottom"] = "top" if side == "below" else "bottom"
    place = (0.0, at - off if side == "below" else at + off)
    return sheet.text(place, words, up=up, angle=angle, name=name)


def _leader(anchor: FloatArray, end: tuple[float, float], along: int) -> FloatArray:
    """Straight on from the line for a third of the way, then to the label."""
    knee = np.array(anchor, np.float64)
    knee[1 - along] += 0.3 * (end[1 - along] - anchor[1 - along])
    return np.array([anchor, knee, end])


def overlaps(box: FloatArray, taken: Sequence[FloatArray], slack: float = 0.15) -> bool:
    """Tell whether a box comes within `slack` (mm) of one of others."""
    if not taken:
        return False
    others = np.array(taken)
    apart = (
        (others[:, 0] > box[2] + slack)
        | (others[:, 2] < box[0] - slack)
        | (others[:, 1] > box[3] + slack)
        | (others[:, 3] < box[1] - slack)
    )
    return not bool(apart.all())
