"""Patches taken from an earlier result, where their nets and the options are the same.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.patches import Patches
>>> from assoc_hull.surface.regions.previous import keys_of
>>> net = np.zeros((2, 2, 3))
>>> keys_of(Patches.single(net)) == keys_of(Patches.single(net.copy()))
True
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from assoc_hull.geometry.curves import IntArray
from assoc_hull.geometry.patches.gathering import gathered
from assoc_hull.geometry.patches.patches import Patches
from assoc_hull.surface.regions.arc_points import ArcPoints
from assoc_hull.surface.regions.region_options import RegionOptions
from assoc_hull.surface.regions.region_parts import RegionPart, Solution
from assoc_hull.surface.regions.region_result import RegionResult
from assoc_hull.surface.regions.solving import deltas, solved
from assoc_hull.surface.regions.surface_batches import Batch, Kind, kind_of
from assoc_hull.surface.regions.zero_band import ZeroBand

__all__ = ["keys_of", "part_of", "usable"]


def keys_of(patches: Patches) -> list[bytes]:
    """Give what the findings of each patch depend on: the bits of its net and weights."""
    if patches.weight is None:
        return [net.tobytes() for net in patches.net]
    pairs = zip(patches.net, patches.weight, strict=True)
    return [net.tobytes() + weight.tobytes() for net, weight in pairs]


def usable(
    previous: RegionResult | None, band: ZeroBand, options: RegionOptions
) -> dict[Kind, RegionPart]:
    """Give the parts of an earlier result by their kind; none if it was made with other options."""
    if previous is None or previous.band != band or previous.options != options:
        return {}
    return {kind_of(part.patches): part for part in previous.parts}


def part_of(
    batch: Batch, band: ZeroBand, options: RegionOptions, old: RegionPart | None
) -> tuple[RegionPart, int]:
    """Give a part, and how many patches had to be computed: each net once."""
    held = len(old) if old is not None else 0
    rows, fresh = _sources(keys_of(batch.patches), keys_of(old.patches) if old else [], held)
    found = [(old.solutions, old.areas)] if old is not None else []
    if len(fresh):
        found.append(solved(batch.patches[fresh], band, options))
    solutions = tuple(
        _gathered([solution_row[level] for solution_row, _ in found], rows)
        for level in range(len(found[0][0]))
    )
    areas = np.concatenate([rows_of_areas for _, rows_of_areas in found])[rows]
    delta = deltas(batch.patches, band)
    return RegionPart(batch.patches, batch.number, solutions, areas, delta), len(fresh)


def _sources(keys: list[bytes], held: list[bytes], first: int) -> tuple[IntArray, IntArray]:
    """Give for each patch its row among what is held and then computed, and what to compute."""
    known = {key: row for row, key in reversed(list(enumerate(held)))}
    rows: list[int] = []
    fresh: list[int] = []
    for place, key in enumerate(keys):
        if key not in known:
            known[key] = first + len(fresh)
            fresh.append(place)
        rows.append(known[key])
    return np.array(rows, np.intp), np.array(fresh, np.intp)


def _gathered(tables: Sequence[Solution], rows: IntArray) -> Solution:
    """Give what is known of chosen patches for one level."""
    cells, arcs = gathered([each.cells for each in tables], [each.arcs for each in tables], rows)
    edges = np.concatenate([each.edges for each in tables])[rows]
    before = np.cumsum([0, *(len(each.edges) for each in tables[:-1])])
    patch = [each.cells.patch[each.arcs.cell] + n for each, n in zip(tables, before, strict=True)]
    points = ArcPoints.gathered([each.points for each in tables], np.concatenate(patch), rows)
    return Solution(tables[0].level, cells, arcs, points, edges)
