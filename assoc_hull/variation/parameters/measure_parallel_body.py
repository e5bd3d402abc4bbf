"""Measures of the parallel middle body: where it begins and ends.

Where borders of the flats of bottom and side are drawn and run level for a while, the parallel
body is where both do. Its ends are then defining points of the borders, which a map carries
exactly. Section areas would tell less: they are within 1e-4 of the largest over many metres more,
and a waterline that is a millimetre off moves the end of that by as many.
"""

from __future__ import annotations

from collections.abc import Callable

import attrs
import numpy as np
from scipy.optimize import brentq

from assoc_hull.analysis.form.form_parameters import shape_of
from assoc_hull.analysis.form.largest_section import EQUAL, parallel_body
from assoc_hull.errors import BadInputError, OutOfRangeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.floating.cross_sections import areas_at
from assoc_hull.variation.parameters.anchor import Anchor
from assoc_hull.variation.parameters.drawn_curves import Drawn

__all__ = ["parallel_body_end", "parallel_body_start"]

_LEVEL = 1e-6
"""Neighbouring points of a level run differ by less, in parts of the breadth."""

_SHORT = 0.02
"""Of Lpp: what is level over less is no parallel middle body."""

_NEAR = 1e-4
"""m: the end of a level stretch of section areas is known so well before it is sought finely."""


@attrs.frozen
class _Ends:
    """First and last x of the parallel body, m, the curves they were taken from, and how."""

    start: float
    end: float
    how: str
    curves: tuple[int, ...] = ()


def parallel_body_start(hull: Drawn) -> Anchor:
    """Give the first x of the parallel middle body; `start`, `end`: both of its ends."""
    return _anchor(hull, "parallel_body_start", 0)


def parallel_body_end(hull: Drawn) -> Anchor:
    """Give the last x of the parallel middle body; `start`, `end`: both of its ends."""
    return _anchor(hull, "parallel_body_end", 1)


def _anchor(hull: Drawn, name: str, end: int) -> Anchor:
    found = hull.take(_ends)
    if isinstance(found, str):
        return Anchor(name, "m", None, reason=found)
    x = (found.start, found.end)[end]
    return Anchor(
        name, "m", x, found.how, [[x, 0.0, 0.0]], hull.keys(found.curves),
        {"start": found.start, "end": found.end},
    )  # fmt: skip


def _ends(hull: Drawn) -> _Ends | str:
    """Give where the parallel body begins and ends, or say why there is none."""
    return hull.take(_of_flats) or _of_areas(hull)


def _of_flats(hull: Drawn) -> _Ends | None:
    """Give the stretch along which the borders of all flats run level."""
    bottoms, sides = hull.flats_of_bottom, hull.flats_of_side
    if not bottoms:
        return None
    within = _LEVEL * hull.ship.breadth
    runs = [_level_run(hull.one(i).xyz, 1, within) for i in bottoms]
    runs += [_level_run(hull.one(i).xyz, 2, within) for i in sides]
    start, end = max(run[0] for run in runs), min(run[1] for run in runs)
    if end - start < _SHORT * hull.length:
        return None
    how = "where the borders of the flats of bottom and side run level"
    return _Ends(start, end, how, (*bottoms, *sides))


def _level_run(xyz: FloatArray, axis: int, within: float) -> tuple[float, float]:
    """Give the longest stretch in x along which y (axis 1) or z (axis 2) of a border stays.

    It need not be the broadest or lowest: a bilge that was made larger is so amidships only.
    """
    level = np.concatenate([[False], np.abs(np.diff(xyz[:, axis])) <= within, [False]])
    step = np.diff(level.astype(np.int8))
    begin, end = xyz[np.flatnonzero(step == 1), 0], xyz[np.flatnonzero(step == -1), 0]
    if not len(begin):
        return 0.0, 0.0
    longest = int(np.abs(end - begin).argmax())
    ends = sorted((float(begin[longest]), float(end[longest])))
    return ends[0], ends[1]


def _of_areas(hull: Drawn) -> _Ends | str:
    """Give the stretch along which sections are as large as the largest but for 1e-4 of it."""
    try:
        shape = shape_of(hull)
        found = parallel_body(shape)
    except (BadInputError, OutOfRangeError) as error:
        return f"parent has no section areas: {error}"
    if found.level is None:
        return "parent has no parallel middle body"
    least, spans = (1.0 - EQUAL) * found.largest, shape.body.spans

    def spare(x: float) -> float:
        return float(areas_at(spans, np.array([x]), shape.planes)[0]) - least

    ends = float(spans.aft.min()), float(spans.fore.max())
    start, end = (_sought(spare, x, ends) for x in found.level)
    how = "where section areas below the draught are the largest but for 1e-4 of it"
    return _Ends(start, end, how)


def _sought(spare: Callable[[float], float], x: float, ends: tuple[float, float]) -> float:
    """Find finely where something becomes nil within a hull, m; x if it does not near there."""
    low, high = max(x - _NEAR, ends[0]), min(x + _NEAR, ends[1])
    if spare(low) * spare(high) >= 0.0:
        return x
    return float(brentq(spare, low, high, xtol=1e-12, rtol=1e-14))
