"""What is wet of a band, followed from level to level: pieces of surface without holes.

A *sheet* is a run of levels between which the wet part of the section is one arc, from keel or
waterline to waterline or deck. It ends where the band does, and where arcs appear, vanish, part
or join.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.panels.bands import Band, Waterplane
from assoc_hull.analysis.panels.levels import Levels
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.floating.wetted_curves import WetRuns
from assoc_hull.geometry.splines.equal_arcs import Chains

__all__ = ["Sheet", "sheets"]

_SAME = 1e-6
"""Ends of arcs so near to one another, in lengths of the ship, are one."""


@attrs.frozen(eq=False)
class Sheet:
    """A piece of the wet surface of one side.

    Attributes
    ----------
    band : int
        Number of its band.
    port : bool
        It lies on the port side; what lies to starboard has its own y, below 0.
    chains : Chains
        One arc per level, k, from aft forward, each from keel to deck.
    afloat : (k, 2) bool
        The first, the last place of the arc lies on the waterplane.
    turn : (s,)
        By how much the arcs turn where a cubic begins, degrees.
    open_aft, open_fore : bool
        The sheet ends at the end of its band, where another band, a stem or a transom is.
    """

    band: int
    port: bool
    chains: Chains
    afloat: NDArray[np.bool_]
    turn: FloatArray
    open_aft: bool
    open_fore: bool

    def __attrs_post_init__(self) -> None:
        freeze(self.afloat, self.turn)


def sheets(
    band: Band, found: Levels, plane: Waterplane, who: tuple[int, bool], length: float
) -> list[Sheet]:
    """Follow what is wet of one half of a band.

    Parameters
    ----------
    band : Band
        The band.
    found : Levels
        Where it is cut.
    plane : Waterplane
        As this half sees it, y away from the centre plane.
    who : (int, bool)
        Number of the band, and whether this is its port half.
    length : float, m
        Of the ship.
    """
    gaps = found.count - 1
    wet = band.wet(np.concatenate([found.fore[:-1], found.aft[1:]]), plane)
    # The arcs behind each level, then those before the next: the same number in each gap.
    begins = [np.flatnonzero(wet.curve == g) for g in range(gaps)]
    finishes = [np.flatnonzero(wet.curve == gaps + g) for g in range(gaps)]
    runs = _followed(wet, begins, finishes, _SAME * length)
    return [_sheet(wet, run, who, gaps) for run in runs]


def _followed(
    wet: WetRuns, begins: list[IntArray], finishes: list[IntArray], near: float
) -> list[tuple[int, list[int]]]:
    """Give for each sheet its first level and its arcs, level by level."""
    alive: list[tuple[int, list[int]]] = []
    done: list[tuple[int, list[int]]] = []
    for gap, (begin, finish) in enumerate(zip(begins, finishes, strict=True)):
        going = []
        left = list(alive)
        for first, last in zip(begin.tolist(), finish.tolist(), strict=False):
            same = [each for each in left if _meet(wet, each[1][-1], first, near)]
            if same:
                left.remove(same[0])
                same[0][1].append(last)
                going.append(same[0])
            else:
                going.append((gap, [first, last]))
        done += left
        alive = going
    return done + alive


def _meet(wet: WetRuns, one: int, other: int, near: float) -> bool:
    """Tell whether two arcs have the same ends."""
    return all(float(np.abs(end[one] - end[other]).max()) <= near for end in wet.chains.ends)


def _sheet(wet: WetRuns, run: tuple[int, list[int]], who: tuple[int, bool], gaps: int) -> Sheet:
    first, arcs = run
    chosen = np.array(arcs, np.int64)
    chains = wet.chains.take(chosen)
    if not who[1]:
        chains = Chains(chains.start, chains.cubic * np.array([1.0, -1.0, 1.0]))
    member = [
        np.arange(wet.chains.start[each], wet.chains.start[each + 1]) for each in chosen.tolist()
    ]
    afloat = ~np.column_stack([wet.bottom[chosen], wet.top[chosen]])
    last = first + len(arcs) - 1
    turn = wet.knuckle[np.concatenate(member)]
    return Sheet(*who, chains, afloat, turn, first == 0, last == gaps)
