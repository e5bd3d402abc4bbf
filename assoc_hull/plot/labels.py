"""Labels that stay clear of one another: on rails beside a view, and on the lines themselves."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.plot.sheet import Pen, Sheet
from assoc_hull.plot.spread import spread

__all__ = ["Lettered", "Side", "label_lines", "overlaps", "rail", "resample"]

Side = Literal["left", "right", "below", "above"]

_LEADER = Pen(0.07, "0.45", over=1.5)
_GAP = 0.35  # mm at A3 between two labels
_STEP = 1.2  # mm between two places where a label may lie on a line
_CLEAR = 0.38  # least distance (label heights) of another line from the middle of a label
_FREE = 1.0  # beyond this distance (label heights) more room is no gain
_SMALL = 0.8  # size of letters that lie on lines


@attrs.frozen(eq=False)
class Lettered:
    """A line that is to be labelled: its label and its polyline, (n, 2), mm."""

    label: str
    points: FloatArray


def rail(
    sheet: Sheet,
    anchors: FloatArray,
    words: Sequence[str],
    side: Side,
    at: float,
    *,
    upright: bool = False,
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
    name : str
        Begins the ids of the labels.
    """
    if not len(words):
        return
    along = 1 if side in ("left", "right") else 0
    texts = [_write(sheet, side, at, upright, each, f"{name}/{each}") for each in words]
    boxes = np.array([sheet.box(text) for text in texts])
    size = boxes[:, along + 2] - boxes[:, along]
    place = spread(anchors[:, along], size, _GAP * sheet.paper.factor)
    shift = place - 0.5 * (boxes[:, along + 2] + boxes[:, along])
    for text, anchor, middle, move in zip(texts, anchors, place, shift, strict=True):
        x, y = text.get_position()
        text.set_position((x + move, y) if along == 0 else (x, y + move))
        sheet.take(text)
        end = (middle, at) if along == 0 else (at, middle)
        sheet.line(_leader(anchor, end, along), _LEADER, f"leader/{text.get_text()}")


def _write(sheet: Sheet, side: Side, at: float, upright: bool, words: str, name: str):  # type: ignore[no-untyped-def]
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


def label_lines(
    sheet: Sheet, lines: Sequence[Lettered], low: float, high: float, *, axis: int = 0, name: str
) -> list[str]:
    """Write labels on lines themselves, where there is room, within a zone of the sheet.

    Parameters
    ----------
    sheet : Sheet
        Where to draw.
    lines : sequence of Lettered
        The lines of a view; each keeps clear of the others.
    low, high : float, mm
        The zone, across the sheet (`axis` 0) or up (1).
    axis : 0 or 1
        What bounds the zone.
    name : str
        Begins the ids of the labels.

    Returns
    -------
    list of str
        Labels for which there was no room.
    """
    courses = [resample(line.points, _STEP * sheet.paper.factor) for line in lines]
    room = [_room(courses, i) for i in range(len(courses))]
    missed = []
    inside = [(course[:, axis] > low) & (course[:, axis] < high) for course in courses]
    order = sorted(range(len(lines)), key=lambda i: float(np.max(room[i][inside[i]], initial=0.0)))
    for i in order:
        places = np.flatnonzero(inside[i][1:-1]) + 1
        if not _place(sheet, lines[i].label, courses[i], room[i], places, name):
            missed.append(lines[i].label)
    return missed


def resample(points: FloatArray, step: float) -> FloatArray:
    """Give points at equal distances along a polyline, both ends included."""
    if not len(points):
        return points
    length = np.sqrt((np.diff(points, axis=0) ** 2).sum(axis=1))
    way = np.concatenate([[0.0], np.cumsum(length)])
    count = max(2, int(np.ceil(way[-1] / step)) + 1)
    at = np.linspace(0.0, way[-1], count)
    return np.column_stack([np.interp(at, way, points[:, i]) for i in range(2)])


def _room(courses: Sequence[FloatArray], mine: int) -> FloatArray:
    """Give the distance from each point of a line to the nearest of all others, mm."""
    found = np.full(len(courses[mine]), np.inf)
    for i, other in enumerate(courses):
        if i == mine or not len(other):
            continue
        step = courses[mine][:, None] - other[None]
        found = np.minimum(found, np.sqrt((step * step).sum(axis=2).min(axis=1)))
    return found


def _place(
    sheet: Sheet, label: str, course: FloatArray, room: FloatArray, places: FloatArray, name: str
) -> bool:
    """Write one label at the best free place of its line; false if there is none."""
    if not len(places):
        return False
    text = sheet.text((0.0, 0.0), label, size=_SMALL, paper=True, name=f"{name}/{label}")
    box = sheet.box(text)
    width, height = box[2] - box[0], box[3] - box[1]
    middle = 0.5 * (len(places) - 1)
    far = np.abs(np.arange(len(places)) - middle) / max(middle, 1.0)
    worth = np.minimum(room[places] / height, _FREE) - 0.05 * far
    for at in places[np.argsort(-worth, kind="stable")].tolist():
        if room[at] < _CLEAR * height:
            break
        angle = _angle(course, at)
        text.set_position((float(course[at, 0]), float(course[at, 1])))
        text.set_rotation(angle)
        if not overlaps(_around(course[at], width, height, angle), sheet.taken):
            sheet.take(text)
            return True
    text.remove()
    return False


def _angle(course: FloatArray, at: int) -> float:
    """Give the angle of a line on the sheet, so that words on it can be read from below."""
    step = course[at + 1] - course[at - 1]
    angle = float(np.degrees(np.arctan2(step[1], step[0])))
    return (angle + 89.0) % 180.0 - 89.0


def _around(place: FloatArray, width: float, height: float, angle: float) -> FloatArray:
    turn = np.radians(angle)
    cosine, sine = abs(np.cos(turn)), abs(np.sin(turn))
    half = 0.5 * np.array([width * cosine + height * sine, width * sine + height * cosine])
    return np.concatenate([place - half, place + half])


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
