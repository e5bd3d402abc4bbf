"""What of a ship by boundary data must go together: heights, ends, the midship section."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from assoc_hull.creation.classical.seaking_parts import Parallel
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checks import figure, finite, inside
from assoc_hull.geometry.classical.keel_outline import KeelOutline
from assoc_hull.geometry.classical.knuckle_codes import KnuckleLine
from assoc_hull.geometry.classical.parallel_waterline import ParallelWaterline
from assoc_hull.geometry.curves import FloatArray

__all__ = ["check_deck", "check_frames", "check_heights", "check_parallel"]

_SAME = 1e-6
"""Places (m) that differ by less are one."""


def check_heights(waterlines: Sequence[ParallelWaterline]) -> None:
    """Refuse waterlines that do not stand one above the other."""
    for one, other in pairwise(waterlines):
        if other.z - one.z <= _SAME:
            raise GeometryError(
                f"waterline z={figure(other.z)}: stands at or below the one before it",
                "give waterlines upward, each once", {"z": other.z},
            )  # fmt: skip


def check_deck(deck: KnuckleLine, keel: KeelOutline) -> None:
    """Refuse a deck side that is too short, below nil or below the keel."""
    if deck.single:
        what = "deck side: has one column of values"
        raise GeometryError(what, "give half-breadths and heights", {})
    first, last = keel.ends
    if deck.ends[0] > first + _SAME or deck.ends[1] < last - _SAME:
        raise GeometryError(
            f"deck side: must cover [{figure(first)}, {figure(last)}]",
            "let it run as far as the contour", {"ends": deck.ends},
        )  # fmt: skip
    if (deck.v[:, 0] < 0.0).any():
        row = int(np.argmax(deck.v[:, 0] < 0.0))
        raise GeometryError(
            f"deck side: negative half-breadth at row {row}", "give 0 or more", {"row": row}
        )
    for x in (first, last):
        top, bottom = float(deck.at(x)[1]), float(keel.height(x))
        if top < bottom - _SAME:
            what = f"deck side: z={figure(top)} at x={figure(x)} lies below the contour"
            raise GeometryError(what, "raise it or lower the contour", {"x": x, "z": top})


def check_frames(frames: FloatArray, ends: tuple[float, float]) -> None:
    """Refuse frames that are out of order or beyond the ends."""
    finite(frames, "frames", (None,))
    step = np.diff(frames)
    if len(frames) < 2 or (step <= _SAME).any():
        row = int(np.argmax(step <= _SAME)) + 1 if len(frames) > 1 else 0
        what = f"frames: x not strictly increasing at row {row}"
        raise GeometryError(what, "give two frames or more, in order from aft", {"row": row})
    inside(frames, "frames", *ends)


def check_parallel(parallel: Parallel, deck: KnuckleLine, keel: KeelOutline) -> None:
    """Refuse a midship section off the level keel, or of another breadth than the deck side."""
    first, last, half = parallel.first, parallel.last, parallel.section.half_breadth
    if not keel.x_a - _SAME <= first < last <= keel.x_b + _SAME:
        raise GeometryError(
            f"midship: its part [{figure(first)}, {figure(last)}] leaves the level keel",
            f"let it lie between {figure(keel.x_a)} and {figure(keel.x_b)}", {},
        )  # fmt: skip
    nodes = deck.x[(deck.x > first) & (deck.x < last)]
    for x in (first, *nodes.tolist(), last):
        y, z = deck.at(x).tolist()
        if abs(y - half) > _SAME:
            raise GeometryError(
                f"midship: the deck side at x={figure(x)} has y={figure(y)}, not a={figure(half)}",
                "let the deck side run parallel there", {"x": x, "y": y, "a": half},
            )  # fmt: skip
        if parallel.section.centre[1] > z:
            raise GeometryError(
                f"midship: bilge centre z={figure(parallel.section.centre[1])} above the side "
                f"height {figure(z)}", "give a smaller radius or rise", {"x": x, "D": z},
            )  # fmt: skip
