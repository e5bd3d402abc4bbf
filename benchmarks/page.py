"""The fairing page without its browser: what a frame costs beside the bare step of a drag.

A live frame is the step of the kernel, what is measured of it, and the bytes that are sent. Both
ways do the same to the same hull in turns. Processor time; medians, of ratios where there are any.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from time import process_time

import attrs
import numpy as np

import assoc_hull as ah
from assoc_hull.page.app import static_files
from assoc_hull.page.describe import describe_net
from assoc_hull.page.messages import Begin, Cancel, Hello, Message, To
from assoc_hull.page.session import Session
from assoc_hull.page.wire import FrameKind, unpack
from benchmarks.clock import Figure

__all__ = ["figures"]

HULLS: dict[str, tuple[Callable[[], ah.Hull], str]] = {
    "Series 60": (ah.examples.series60, "WL 0.625 x ST 16"),
    "carrier": (ah.examples.bulk_carrier_207k, "WL 11 x ST 16.5"),
}
RADIUS = (20.0, 8.0)
ROUNDS, QUICK = 60, 12
EXTRA, FRAME, NET, FILES = 0.5, 120.0, 350.0, 250.0


def figures(quick: bool = False) -> list[Figure]:
    """Measure."""
    found: list[Figure] = []
    rounds = QUICK if quick else ROUNDS
    for name, (make, point) in HULLS.items():
        hull = make()
        state, shapes = hull.state, hull.shapes()
        text = len(json.dumps(describe_net(state), separators=(",", ":")))
        text += 48 * len(shapes.spline.xyz) + 28 * len(state.live("rows"))
        found.append(Figure(f"{name}: all of the net", text / 1e3, "kB", NET, "most"))
        for how in ("pull", "move"):
            bare, whole, size = _steps(hull, point, how, rounds)
            title = f"{name}, {how} 10 mm"
            found += [
                Figure(f"{title}: a live frame over a bare step", 1e3 * (whole - bare), "ms more",
                       EXTRA, "most"),
                Figure(f"{title}: a live frame", 1e3 * whole, "ms"),
                Figure(f"{title}: bytes of a live frame", size / 1e3, "kB", FRAME, "most"),
            ]  # fmt: skip
    files = sum(len(body) for body, _ in static_files().values()) / 1e3
    return [*found, Figure("static files", files, "kB", FILES, "most")]


@attrs.define(eq=False)
class _Client:
    """A page that only counts."""

    author: str = "benchmark"
    frame: bytes = b""

    def tell(self, message: str | bytes) -> None:
        """Keep the last frame."""
        if isinstance(message, bytes) and unpack(message).kind == FrameKind.LIVE:
            self.frame = message


def _steps(hull: ah.Hull, point: str, how: str, rounds: int) -> tuple[float, float, int]:
    """Give the time of a bare step and of a whole frame, s, and the bytes of one."""
    client, session = _Client(), Session(hull)
    row, times = hull.points[point].number, list[tuple[float, float]]()
    session.close()  # its thread: what it would do is done here, so that the time is one's own
    y = float(hull.points[point].position[1])

    def act(message: Message) -> float:
        begin = process_time()
        session._acts[type(message)](session, client, message)
        return process_time() - begin

    act(Hello(1, "token", "benchmark"))
    radius = RADIUS if how == "pull" else None
    for number in range(rounds):
        size = 0.009 + 1e-5 * number
        asked = {"d": size} if how == "pull" else {"y": y + size}
        with hull.drag(point, how, radius) as drag:  # type: ignore[arg-type]
            drag.to(**{name: value - 1e-4 for name, value in asked.items()})
            begin = process_time()
            drag.to(**asked)
            bare = process_time() - begin
        act(Begin(1, row, how, None if radius is None else list(radius)))
        act(To(1, 1, **{name: value - 1e-4 for name, value in asked.items()}))
        times.append((bare, act(To(1, 2, **asked))))
        act(Cancel(1))
    both = np.median(np.array(times), axis=0)
    return float(both[0]), float(both[1]), len(client.frame)
