"""Labels on the lines themselves, where there is room; the others in a row above."""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.plot.sheet.rails import overlaps, rail
from assoc_hull.plot.sheet.sheet import Sheet

__all__ = ["Lettered", "label_above", "label_lines", "resample"]

_STEP = 1.2  # mm between two places where a label may lie on a line
_CLEAR = 0.5  # least distance (label heights) of another line from the middle of a label
_FREE = 1.0  # beyond this distance (label heights) more room is no gain
_NEIGHBOURS = 8  # more places than these that are nearer lie on the same line: it is alone
_FAR = 5.0  # mm at A3, the distance of a line that is alone
_SMALL = 0.8  # size of letters that lie on lines


@attrs.frozen(eq=False)
class Lettered:
    """A line that is to be labelled: its label, its polyline, (n, 2), mm, and its full name."""

    label: str
    points: FloatArray
    name: str = ""


def label_lines(
    sheet: Sheet, lines: Sequence[Lettered], low: float, high: float, *, axis: int = 0, name: str
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


def label_above(
    sheet: Sheet, lines: Sequence[Lettered], wanted: set[str], at: float, name: str
) -> None:
    """Write labels for which lines have no room in a row above a view, each with a leader.

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
    for line, course, free in zip(lines, courses, room, strict=True):
        if line.label not in wanted or line.label in words:
            continue
        used = np.array([anchor[0] for anchor in anchors])
        near = np.abs(course[:, :1] - used).min(axis=1, initial=np.inf) < apart
        off = np.abs(np.linspace(-0.25, 0.75, len(course)))  # a quarter of the way, if all is one
        anchors.append(course[int(np.argmax(free - 0.1 * off - 1e3 * near))])
        words.append(line.label)
        names.append(line.name or line.label)
    if words:
        ends = np.array(anchors)
        sheet.dots(ends, "black", 0.45, "leader/dots")
        rail(sheet, ends, names, "above", at, name=name)


def resample(points: FloatArray, step: float) -> FloatArray:
    """Give points at equal distances along a polyline, both ends included."""
    if not len(points):
        return points
    length = np.sqrt((np.diff(points, axis=0) ** 2).sum(axis=1))
    way = np.concatenate([[0.0], np.cumsum(length)])
    count = max(2, int(np.ceil(way[-1] / step)) + 1)
    at = np.linspace(0.0, way[-1], count)
    return np.column_stack([np.interp(at, way, points[:, i]) for i in range(2)])


def _courses(sheet: Sheet, lines: Sequence[Lettered]) -> tuple[list[FloatArray], list[FloatArray]]:
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
