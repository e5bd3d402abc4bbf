"""What a designer should know of a variation beside what was asked for."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from assoc_hull.edit.mapped_planes import PLANE
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.state import HullState
from assoc_hull.variation.certificate.fold_outside import fold_outside
from assoc_hull.variation.fields.space_map import VMap
from assoc_hull.variation.parameters.catalogue import CATALOGUE
from assoc_hull.variation.parameters.layouts_body import shift_terminals
from assoc_hull.variation.parameters.limits import hull_box
from assoc_hull.variation.parameters.parent_places import Parent

__all__ = ["also_changed", "folds_outside", "shifted_without_body", "went_along"]

_SEEN = 1e-3
"""A named value that changes by less (m, degrees) is not told."""


def folds_outside(vmap: VMap, state: HullState, tolerance: float) -> tuple[str, ...]:
    """Tell where a map folds beyond the hull."""
    beyond = fold_outside(vmap, hull_box(state, tolerance))
    if beyond is None:
        return ()
    x, _, z = beyond.witness
    return (f"fold_outside_hull: the map folds at x={x:.3f} z={z:.3f}, where there is no hull",)


def went_along(before: FloatArray, state: HullState) -> tuple[str, ...]:
    """Tell of waterlines and buttocks that went with the map: names may say where they were.

    Parameters
    ----------
    before : (l,), m
        Offsets of the planes of all lines.
    state : HullState
        The hull afterwards.
    """
    lines = np.array([
        line for line in state.live("lines").tolist()
        if state.family(line).axis in (1, 2) and state.lines.boundary.data[line] < 0
    ], np.int64)  # fmt: skip
    moved = np.abs(state.lines.offset.data[lines] - before[lines])
    gone = lines[moved > PLANE]
    if not len(gone):
        return ()
    farthest = int(lines[np.nanargmax(moved)])
    name, level = state.lines.name.data[farthest], float(state.lines.offset.data[farthest])
    told = f"{len(gone)} waterlines and buttocks went along and kept their names"
    return (f"{told}: {name} is at {level:.6g} m",)


def also_changed(
    before: Mapping[str, float], after: Mapping[str, float], asked: Mapping[str, float]
) -> tuple[str, ...]:
    """Tell of named values that changed though nobody asked: a field moves all that it reaches.

    Examples
    --------
    >>> from assoc_hull.variation.notes import also_changed
    >>> was = {"shaft_height": 5.0, "transom_height": 18.4}
    >>> also_changed(was, {"shaft_height": 6.0, "transom_height": 18.632}, {"shaft_height": 6.0})
    ('also changed: transom_height 18.4 -> 18.632 m',)
    """
    told = [
        f"{name} {before[name]:.6g} -> {after[name]:.6g} {CATALOGUE[name].unit}"
        for name in CATALOGUE
        if name in before and name in after and name not in asked
        and abs(after[name] - before[name]) > _SEEN
    ]  # fmt: skip
    return (f"also changed: {', '.join(told)}",) if told else ()


def shifted_without_body(
    parent: Parent, asked: Iterable[str] = ("fore_shift", "aft_shift")
) -> tuple[str, ...]:
    """Tell what stands for the parallel body where sections shift and there is none.

    Parameters
    ----------
    parent : Parent
    asked : iterable of str
        Names of the parameters that are asked for.
    """
    shifts = any(name in ("fore_shift", "aft_shift") for name in asked)
    if not shifts or parent.has("body start") or not parent.has("largest aft"):
        return ()
    _, start, end, _ = shift_terminals(parent, "section shifts")
    where = f"at {start:.6g} m" if start == end else f"from {start:.6g} to {end:.6g} m"
    what = "the largest station stands" if start == end else "the two largest stations stand"
    return (f"no parallel middle body: {what} for it, {where}",)
