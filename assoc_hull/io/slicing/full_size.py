"""Short hulls worked on at the size for which lengths in the code hold, and brought back.

Finding features and smoothing know dozens of lengths, and fits that are not linear: a hull of 6 m
passes through them as the same hull of 100 m, and comes back by the same factor.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.io.slicing.full_size import scaled
>>> from assoc_hull.io.lines.slices import GapJoin
>>> scaled(GapJoin("ST 1", (1.0, 2.0, 0.5), 0.06), 0.5).place
(0.5, 1.0, 0.25)
"""

from __future__ import annotations

from typing import Any, TypeVar

import attrs
import numpy as np

from assoc_hull.geometry.polylines.circular_arcs import CircularArc
from assoc_hull.geometry.polylines.straight_runs import Onset
from assoc_hull.io.lines.slices import GapJoin, Gaps, HullSlices, LinePiece, SliceLine
from assoc_hull.io.slicing.boundary_curves import BoundaryCurve
from assoc_hull.io.slicing.features import KnuckleTrace
from assoc_hull.io.slicing.smooth_lines import SmoothReport
from assoc_hull.tolerance import at_full_length

__all__ = ["grown_slices", "scaled"]

_LENGTHS: dict[type, tuple[str, ...]] = {
    GapJoin: ("place", "gap"),
    Gaps: ("join", "refuse"),
    LinePiece: ("points",),
    SliceLine: ("offset", "pieces"),
    HullSlices: (
        "lines", "boundaries", "joins", "low", "high", "depth", "gaps", "knuckles",
    ),
    Onset: ("at", "place", "radius", "uncertainty"),
    CircularArc: (
        "begin", "end", "centre", "radius", "uncertainty", "residual", "before", "after",
    ),
    KnuckleTrace: ("places", "doubt"),
    SmoothReport: ("noise", "band", "residual", "onsets", "arcs"),
    BoundaryCurve: ("places", "doubt", "residual"),
}  # fmt: skip
"""What of a value is a length, or holds lengths; all else stays."""

Value = TypeVar("Value")


def scaled(value: Value, factor: float) -> Value:
    """Give a value with every length in it times a factor."""
    found: Any = _scaled(value, factor)
    return found  # type: ignore[no-any-return]


def grown_slices(slices: HullSlices) -> HullSlices:
    """Give slices of a short hull at full size; decimals of digitised points stay decimals."""
    factor = slices.factor
    found = scaled(slices, 1.0 / factor)
    if slices.facets:
        return found
    low, high = (at_full_length(each, factor) for each in (slices.low, slices.high))
    widths = at_full_length([slices.gaps.join, slices.gaps.refuse], factor).tolist()
    marks = {name: at_full_length(places, factor) for name, places in slices.knuckles.items()}
    found = attrs.evolve(found, low=low, high=high, gaps=Gaps(*widths), knuckles=marks)
    pairs = [(getattr(found, name), getattr(slices, name)) for name in ("lines", "boundaries")]
    grown = [
        tuple(_settled(new, old, factor) for new, old in zip(*pair, strict=True)) for pair in pairs
    ]
    return attrs.evolve(found, lines=grown[0], boundaries=grown[1])


def _settled(new: SliceLine, old: SliceLine, factor: float) -> SliceLine:
    pieces = tuple(
        attrs.evolve(each, points=at_full_length(given.points, factor))
        for each, given in zip(new.pieces, old.pieces, strict=True)
    )
    return attrs.evolve(new, offset=float(at_full_length(old.offset, factor)), pieces=pieces)


def _scaled(value: Any, factor: float) -> Any:
    if isinstance(value, float | np.ndarray):
        return factor * value
    if isinstance(value, tuple | list):
        return type(value)(_scaled(each, factor) for each in value)
    if isinstance(value, dict):
        return {key: _scaled(each, factor) for key, each in value.items()}
    names = _LENGTHS.get(type(value))
    if names is None:
        return value
    return attrs.evolve(value, **{each: _scaled(getattr(value, each), factor) for each in names})
