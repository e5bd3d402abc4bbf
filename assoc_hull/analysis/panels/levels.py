"""The curves across a band between which panels are put.

To the places that are wanted come those at which the wet part of the section changes its kind: it
appears or vanishes, parts or joins, reaches the end of the curve or leaves it. Such a place is
found by halving; its level has two sides, the last curve before and the first behind it, which
differ by rounding only.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.analysis.panels.bands import Band, Waterplane
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.floating.wetted_curves import WetRuns

__all__ = ["Levels", "levels"]

_ROUNDS = 12
"""So many changes are found between two levels at most."""

_HALVINGS = 70
_ONE = 1e-6
"""Changes that lie so near to one another in q are one."""

_CROWDED = 0.3
"""A level that was not asked for by its place is left out so near to a change or end, in steps."""

Kind = tuple[tuple[bool, bool], ...]
"""Of each run of a curve: it begins where the curve does, it ends where the curve does."""


@attrs.frozen(eq=False)
class Levels:
    """Where a band is cut.

    Attributes
    ----------
    aft, fore : (k,)
        The parameter q of each level as seen from aft and from forward.
    """

    aft: FloatArray
    fore: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.aft, self.fore)

    @property
    def count(self) -> int:
        """Number of levels."""
        return len(self.aft)


def levels(band: Band, planes: list[Waterplane], x: FloatArray, fixed: bool) -> Levels:
    """Choose the levels of a band.

    Parameters
    ----------
    band : Band
        The band.
    planes : list of Waterplane
        As the halves see the water; both get the same levels, so that they meet.
    x : (n,), m
        Places along the ship that are asked for, ascending; those off the band do not matter.
    fixed : bool
        Keep all of these, however near to a change or an end they lie.
    """
    q = np.concatenate([[0.0], band.q_at(x), [float(band.count)]])
    q = q[np.append(True, np.diff(q) > 1e-9)]
    aft, fore = q.tolist(), q.tolist()
    for _ in range(_ROUNDS):
        gaps = _changing(band, planes, np.array(fore[:-1]), np.array(aft[1:]))
        if not gaps:
            break
        for gap in reversed(gaps):
            low, high = _change(band, planes, fore[gap], aft[gap + 1])
            aft.insert(gap + 1, low)
            fore.insert(gap + 1, high)
    found = _merged(np.array(aft), np.array(fore))
    return found if fixed else _thinned(band, found, x)


def _merged(aft: FloatArray, fore: FloatArray) -> Levels:
    """Make one level of changes that follow one another at once."""
    first = np.append(True, aft[1:] - fore[:-1] > _ONE)
    last = np.append(first[1:], True)
    return Levels(aft[first], fore[last])


def _kinds(wet: WetRuns, count: int) -> list[Kind]:
    """Say of what kind the wet part of each of so many curves is."""
    found: list[list[tuple[bool, bool]]] = [[] for _ in range(count)]
    ends = zip(wet.curve.tolist(), wet.bottom.tolist(), wet.top.tolist(), strict=True)
    for curve, bottom, top in ends:
        found[curve].append((bottom, top))
    return [tuple(each) for each in found]


def _changing(band: Band, planes: list[Waterplane], low: FloatArray, high: FloatArray) -> list[int]:
    """Find the gaps whose two ends are of different kinds, on one side at least."""
    found = set()
    for plane in planes:
        kinds = _kinds(band.wet(np.concatenate([low, high]), plane), 2 * len(low))
        found |= {i for i in range(len(low)) if kinds[i] != kinds[i + len(low)]}
    return sorted(found)


def _change(band: Band, planes: list[Waterplane], low: float, high: float) -> tuple[float, float]:
    """Find the first change of kind behind `low`: the last q before it and the first behind."""
    first = [_kinds(band.wet(np.array([low]), plane), 1)[0] for plane in planes]
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        if not low < middle < high:
            break
        now = [_kinds(band.wet(np.array([middle]), plane), 1)[0] for plane in planes]
        low, high = (middle, high) if now == first else (low, middle)
    return low, high


def _thinned(band: Band, found: Levels, x: FloatArray) -> Levels:
    """Leave out levels that crowd where a change was found, and at the ends of the band."""
    kept = found.aft != found.fore
    kept[[0, -1]] = True
    place = np.interp(found.aft, np.arange(band.count + 1.0), band.x)
    step = np.interp(place, x, np.gradient(x)) if len(x) > 1 else 0.0
    kept |= np.abs(place[:, None] - place[kept]).min(axis=1) >= _CROWDED * step
    return Levels(found.aft[kept], found.fore[kept])
