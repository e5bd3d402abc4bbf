"""Digitised lines, as lists of points and as polylines of a drawing."""

from __future__ import annotations

import zlib
from random import Random

from tests.fuzz.kind import TARGET, Kind
from tests.fuzz.text import change_text

__all__ = ["DIGITISED", "DRAWINGS"]

Line = tuple[str, list[tuple[float, float, float]]]
OPTIONS: tuple[list[str], ...] = (
    [], ["--tolerance", "0.05"], ["--unit", "mm"], ["--scale", "20"], ["--join", "0.5"], ["--json"],
    ["--report", "report.json"], ["--accept"], ["--accept", "--json"], ["--strict"],
)  # fmt: skip


def _half_breadth(x: float, z: float) -> float:
    return round(2.0 * (1 - (2 * x / 20 - 1) ** 2) * (1 - (1 - z / 2.5) ** 2), 4)


def _hull() -> list[Line]:
    """A Wigley hull of 20 m: three sections, two waterlines, a profile."""
    heights, places = (
        [0.0, 0.3, 0.8, 1.4, 2.0, 2.5],
        [0.0, 1.5, 4.0, 7.0, 10.0, 13.0, 16.0, 18.5, 20.0],
    )
    lines = [
        (f"ST {x:g}", [(x, _half_breadth(x, z), z) for z in heights]) for x in (5.0, 10.0, 15.0)
    ]
    lines += [(f"WL {z:g}", [(x, _half_breadth(x, z), z) for x in places]) for z in (1.0, 2.5)]
    keel = [(0.0, 0.0, 2.5), (0.0, 0.0, 0.0), (10.0, 0.0, 0.0), (20.0, 0.0, 0.0), (20.0, 0.0, 2.5)]
    return [*lines, ("profile", keel)]


def _rows(mark: str, head: str) -> str:
    """The lines as a list of points."""
    rows = [head.replace(",", mark)]
    for name, points in _hull():
        rows += [mark.join([name, *map(str, point)]) for point in points]
    return "\n".join(rows) + "\n"


def _drawing(kind: str) -> str:
    """The lines as polylines of a drawing."""
    words: list[object] = [0, "SECTION", 2, "ENTITIES"]
    for name, points in _hull():
        words += [0, "POLYLINE", 8, name, 66, 1, 70, 8]
        for point in points:
            words += [0, kind, 8, name, 10, point[0], 20, point[1], 30, point[2]]
        words += [0, "SEQEND"]
    words += [0, "LINE", 8, "deck edge", 10, 0, 20, 0, 30, 2.5, 11, 20, 21, 0, 31, 2.5]
    words += [0, "LWPOLYLINE", 8, "WL 2", 38, 2.0, 70, 0]
    for x in (0.0, 5.0, 10.0, 15.0, 20.0):
        words += [10, x, 20, _half_breadth(x, 2.0)]
    return "\n".join(map(str, [*words, 0, "ENDSEC", 0, "EOF"])) + "\n"


LISTS = (_rows(",", "line,x,y,z"), _rows(";", "line,x,y,z"))
DRAWN = (_drawing("VERTEX"),)


def make_list(rng: Random) -> bytes:
    """A changed list of points."""
    return change_text(rng, rng.choice(LISTS))


def make_drawing(rng: Random) -> bytes:
    """A changed drawing."""
    return change_text(rng, rng.choice(DRAWN))


def _options(data: bytes) -> list[str]:
    return OPTIONS[zlib.crc32(data) % len(OPTIONS)]


def of_list(data: bytes) -> list[list[str]]:
    """Import it."""
    return [["import", "lines.csv", "-o", TARGET, *_options(data)]]


def of_drawing(data: bytes) -> list[list[str]]:
    """Import it."""
    return [["import", "lines.dxf", "-o", TARGET, *_options(data)]]


DIGITISED = Kind("digitised", "lines.csv", make_list, of_list, extra=("report.json",), weight=2)
DRAWINGS = Kind("dxf", "lines.dxf", make_drawing, of_drawing, extra=("report.json",), weight=2)
