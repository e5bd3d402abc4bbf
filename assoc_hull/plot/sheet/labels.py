"""Labels: in a row beside a view with leaders, or on the lines themselves where there is room.

A row moves its labels apart as little as possible. A label on a line looks for the place where
other lines are farthest; lines that have none are named in a row above. Boxes of letters that
are written are kept with the sheet, so that later ones keep clear. Lengths are mm.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.numeric.interval_spacing import space_intervals
from assoc_hull.plot.sheet.paper import MARGIN, Pen
from assoc_hull.plot.sheet.sheet_figure import Sheet

if TYPE_CHECKING:
    from matplotlib.text import Text

__all__ = [
    "LabelledLine",
    "Side",
    "label_above",
    "label_lines",
    "label_row",
    "overlaps",
    "resample",
    "wrap_words",
]


def wrap_words(sheet: Sheet, words: str, room: float, size: float) -> list[str]:
    """Part words into lines that are no wider than the room, mm; a long word may be."""
    lines = [""]
    for word in words.split():
        longer = f"{lines[-1]} {word}".strip()
        if lines[-1] and sheet.width(longer, size=size) > room:
            lines.append(word)
        else:
            lines[-1] = longer
    return lines


# --------------------------------------------------------------------------------------
# Labels in a row beside a view, moved apart as little as possible, with leaders.

Side = Literal["left", "right", "below", "above"]

_LEADER = Pen(0.07, "0.45", over=1.5)
_GAP, _GAP_ALONG = 0.35, 0.9  # mm at A3 between two labels above, and beside one another


def label_row(
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
    # Labels above one another, or upright ones in a row, stand as close as lines of text.
    gap = (_GAP if upright or along else _GAP_ALONG) * sheet.paper.factor
    place = space_intervals(anchors[:, along], size, gap)
    shift = place - 0.5 * (boxes[:, along + 2] + boxes[:, along])
    boxes[:, [along, along + 2]] += shift[:, None]
    if sparse and (_leaves(sheet, boxes) or any(overlaps(box, sheet.taken) for box in boxes)):
        for text in texts:
            text.remove()
        kept = _with_room(anchors[:, along], size + gap)
        some = [words[i] for i in kept]
        # Not sparse again: those that are left are written, or this would not end.
        label_row(sheet, anchors[kept], some, side, at, upright=upright, heading=heading, name=name)
        return
    for text, anchor, middle, move in zip(texts, anchors, place, shift, strict=True):
        x, y = text.get_position()
        text.set_position((x + move, y) if along == 0 else (x, y + move))
        sheet.take(text)
        end = (middle, at) if along == 0 else (at, middle)
        sheet.line(_leader(anchor, end, along), _LEADER, f"leader/{text.get_text()}")
    # After the labels: it keeps clear of them, too.
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


# --------------------------------------------------------------------------------------
# Labels on the lines themselves, where there is room; the others in a row above.

_STEP = 1.2  # mm between two places where a label may lie on a line
_CLEAR = 0.5  # least distance (label heights) of another line from the middle of a label
_FREE = 1.0  # beyond this distance (label heights) more room is no gain
_NEIGHBOURS = 8  # more places than these that are nearer lie on the same line: it is alone
_FAR = 5.0  # mm at A3, the distance of a line that is alone
_SMALL = 0.8  # size of letters that lie on lines


@attrs.frozen(eq=False)
class LabelledLine:
    """A line that is to be labelled: its label, its polyline, (n, 2), mm, and its full name."""

    label: str
    points: FloatArray
    name: str = ""


def label_lines(
    sheet: Sheet,
    lines: Sequence[LabelledLine],
    low: float,
    high: float,
    *,
    axis: int = 0,
    name: str,
) -> set[str]:
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
    set of str
        The labels that were written; for the others there was no room.
    """
    courses, room = _courses(sheet, lines)
    inside = [(course[:, axis] > low) & (course[:, axis] < high) for course in courses]
    order = sorted(range(len(lines)), key=lambda i: float(np.max(room[i][inside[i]], initial=0.0)))
    written = set()
    for i in order:
        places = np.flatnonzero(inside[i][1:-1]) + 1
        if _place(sheet, lines[i].label, courses[i], room[i], places, name):
            written.add(lines[i].label)
    return written


_UPRIGHT = 0.02
"""A line that goes aside by less than this part of its height stands along its own leader."""


def label_above(
    sheet: Sheet, lines: Sequence[LabelledLine], wanted: set[str], at: float, name: str
) -> None:
    """Write labels for which lines have no room in a row above a view, each with a leader.

    It ends in a dot on the line; that of an upright line, as of a transom in the half-breadth plan,
    runs on from its upper end, without one.

    Parameters
    ----------
    sheet : Sheet
        Where to draw.
    lines : sequence of Lettered
        All lines of the view.
    wanted : set of str
        The labels to write.
    at : float, mm
        Where the row begins.
    name : str
        Begins the ids of the labels.
    """
    courses, room = _courses(sheet, lines)
    apart = 5.0 * sheet.paper.factor
    anchors: list[FloatArray] = []
    words: list[str] = []
    names: list[str] = []
    dotted: list[FloatArray] = []
    for line, course, free in zip(lines, courses, room, strict=True):
        if line.label not in wanted or line.label in words:
            continue
        used = np.array([anchor[0] for anchor in anchors])
        near = np.abs(course[:, :1] - used).min(axis=1, initial=np.inf) < apart
        off = np.abs(np.linspace(-0.25, 0.75, len(course)))  # a quarter of the way, if all is one
        if np.ptp(course[:, 0]) < _UPRIGHT * np.ptp(course[:, 1]):
            anchors.append(course[int(course[:, 1].argmax())])
        else:
            anchors.append(course[int(np.argmax(free - 0.1 * off - 1e3 * near))])
            dotted.append(anchors[-1])
        words.append(line.label)
        names.append(line.name or line.label)
    if words:
        if dotted:
            sheet.dots(np.array(dotted), "black", 0.45, "leader/dots")
        label_row(sheet, np.array(anchors), names, "above", at, name=name)


def resample(points: FloatArray, step: float) -> FloatArray:
    """Give points at equal distances along a polyline, both ends included."""
    if not len(points):
        return points
    length = np.sqrt((np.diff(points, axis=0) ** 2).sum(axis=1))
    way = np.concatenate([[0.0], np.cumsum(length)])
    count = max(2, int(np.ceil(way[-1] / step)) + 1)
    at = np.linspace(0.0, way[-1], count)
    return np.column_stack([np.interp(at, way, points[:, i]) for i in range(2)])


def _courses(
    sheet: Sheet, lines: Sequence[LabelledLine]
) -> tuple[list[FloatArray], list[FloatArray]]:
    """Give places along each line and their distance (mm) from the nearest other line."""
    from scipy.spatial import cKDTree

    courses = [resample(line.points, _STEP * sheet.paper.factor) for line in lines]
    if not courses:
        return [], []
    every = np.concatenate(courses)
    owner = np.repeat(np.arange(len(courses)), [len(course) for course in courses])
    near = min(_NEIGHBOURS, len(every))
    found, index = cKDTree(every).query(every, k=[*range(1, near + 1)])
    distance = np.asarray(found)
    distance[owner[index] == owner[:, None]] = np.inf
    room = np.minimum(distance.min(axis=1), _FAR * sheet.paper.factor)
    return courses, np.split(room, np.cumsum([len(course) for course in courses])[:-1])


def _place(
    sheet: Sheet, label: str, course: FloatArray, room: FloatArray, places: IntArray, name: str
) -> bool:
    """Write one label at the best free place of its line; false if there is none."""
    if not len(places):
        return False
    text = sheet.text((0.0, 0.0), label, size=_SMALL, halo=True, name=f"{name}/{label}")
    box = sheet.box(text)
    width, height = box[2] - box[0], box[3] - box[1]
    middle = 0.5 * (len(places) - 1)
    far = np.abs(np.arange(len(places)) - middle) / max(middle, 1.0)
    worth = np.minimum(room[places] / height, _FREE) - 0.05 * far
    for at in places[np.argsort(-worth, kind="stable")].tolist():
        if room[at] < _CLEAR * height:
            break
        angle = _angle(course, at)
        if not overlaps(_around(course[at], width, height, angle), sheet.taken):
            text.set_position((float(course[at, 0]), float(course[at, 1])))
            text.set_rotation(angle)
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
