"""Binary frames of the page: shapes of curves and places of points, as the browser takes them.

Little endian, each section begins on 8 bytes. The header has 48: u8 version, u8 kind, u16 flags;
u32 gesture, sequence, state, curves c, knots k, points p; f32 milliseconds, change of volume (m3),
change of LCB (m), movement normal to the hull (m), u32 0. Then come ids u32[c], counts u32[c],
knots f64[3k], leave f32[3k], arrive f32[3k], rows u32[p], places f64[3p]. Knots are double: single
ones make combs lie.
"""

from __future__ import annotations

import struct
from enum import IntEnum

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch

__all__ = ["VERSION", "Frame", "FrameKind", "pack", "unpack"]

VERSION = 1

_HEADER = struct.Struct("<BBHIIIIIIffffI")
_STRUCTURAL = 1
_WHERE = "in a frame of the page"


class FrameKind(IntEnum):
    """All that is published, what a drag or that of another would change, an edit, a variant."""

    NET = 1
    LIVE = 2
    PUBLISHED = 3
    GHOST = 4
    THEIRS = 5


@attrs.frozen(eq=False)
class Frame:
    """Curves and points that the browser is to draw.

    Attributes
    ----------
    kind : FrameKind
        What it tells.
    state : int
        Number of the published state that a live frame is relative to, or that others lead to.
    curves, spline : (c,) int, SplineBatch
        Numbers of the curves, and their shapes.
    rows, xyz : (p,) int, (p, 3) m
        Points and their places.
    gesture, sequence : int
        What a live frame answers; 0 else.
    structural : bool
        Whether numbers have changed, so that a net must be told first.
    seconds, volume, lcb, normal : float
        How long the kernel took, s; about how much volume, m3, and LCB, m, would change; how far
        the point moves that leaves the hull most, m.
    """

    kind: FrameKind
    state: int
    curves: IntArray
    spline: SplineBatch
    rows: IntArray
    xyz: FloatArray
    gesture: int = 0
    sequence: int = 0
    structural: bool = False
    seconds: float = 0.0
    volume: float = 0.0
    lcb: float = 0.0
    normal: float = 0.0


def pack(frame: Frame) -> bytes:
    """Write a frame."""
    spline, flags = frame.spline, _STRUCTURAL if frame.structural else 0
    head = _HEADER.pack(
        VERSION, frame.kind, flags, frame.gesture, frame.sequence, frame.state, len(frame.curves),
        len(spline.xyz), len(frame.rows), 1e3 * frame.seconds, frame.volume, frame.lcb,
        frame.normal, 0,
    )  # fmt: skip
    sections: list[NDArray[np.generic]] = [
        frame.curves.astype("<u4"), np.diff(spline.start).astype("<u4"), spline.xyz.astype("<f8"),
        spline.leave.astype("<f4"), spline.arrive.astype("<f4"), frame.rows.astype("<u4"),
        frame.xyz.astype("<f8"),
    ]  # fmt: skip
    return b"".join([head, *(_padded(section.tobytes()) for section in sections)])


def _padded(section: bytes) -> bytes:
    return section + bytes(-len(section) % 8)


def unpack(data: bytes) -> Frame:
    """Read a frame; derivatives come back as single as they were sent.

    Raises
    ------
    BadInputError
        Another version, an unknown kind, or not as long as its header says.
    """
    if len(data) < _HEADER.size:
        raise BadInputError(f"it has {len(data)} bytes", _WHERE, f"send {_HEADER.size} at least")
    head = _HEADER.unpack_from(data)
    version, kind, flags, gesture, sequence, state, c, k, p, ms, volume, lcb, normal, _ = head
    if version != VERSION:
        raise BadInputError(f"it is of version {version}", _WHERE, "reload the page")
    if kind not in tuple(FrameKind):
        raise BadInputError(f"it is of kind {kind}", _WHERE, "reload the page")
    sizes = [(c, "<u4"), (c, "<u4"), (3 * k, "<f8"), (3 * k, "<f4"), (3 * k, "<f4"), (p, "<u4"),
             (3 * p, "<f8")]  # fmt: skip
    places = [_HEADER.size]
    for count, form in sizes:
        size = count * np.dtype(form).itemsize
        places.append(places[-1] + size + -size % 8)
    if places[-1] != len(data):
        what = f"it has {len(data)} bytes, and its header tells of {places[-1]}"
        raise BadInputError(what, _WHERE, "send the whole of it")
    found = [
        np.frombuffer(data, form, count, place)
        for (count, form), place in zip(sizes, places[:-1], strict=True)
    ]
    curves, counts, xyz, leave, arrive, rows, points = found
    if counts.sum() != k:
        what = f"its curves have {counts.sum()} knots, and its header tells of {k}"
        raise BadInputError(what, _WHERE, "send the whole of it")
    start = np.concatenate([[0], np.cumsum(counts, dtype=np.int64)])
    spline = _spline(start, xyz.reshape(-1, 3).astype(np.float64), leave, arrive)
    return Frame(
        FrameKind(kind), state, curves.astype(np.int64), spline, rows.astype(np.int64),
        points.reshape(-1, 3).astype(np.float64), gesture, sequence, bool(flags & _STRUCTURAL),
        1e-3 * ms, volume, lcb, normal,
    )  # fmt: skip


def _spline(
    start: IntArray, xyz: FloatArray, leave: NDArray[np.generic], arrive: NDArray[np.generic]
) -> SplineBatch:
    """Put a batch together; the parameter is the sum of the chords."""
    step = np.sqrt(((xyz[1:] - xyz[:-1]) ** 2).sum(axis=1))
    total = np.concatenate([[0.0], np.cumsum(step)])[: len(xyz)]
    first = np.repeat(start[:-1], np.diff(start))
    knot: FloatArray = total - total[first] if len(xyz) else np.zeros(0)
    ahead, behind = (each.reshape(-1, 3).astype(np.float64) for each in (leave, arrive))
    return SplineBatch(start, knot, xyz, ahead, behind)
