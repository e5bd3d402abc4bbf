"""Which biarc of the family is taken: by rule, and where none applies.

Source: Kim and Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK. Closed forms are in `biarc_c` and `biarc_s`.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.classical.biarc_family import BiarcChords
>>> from assoc_hull.geometry.classical.biarc_rules import biarc_kinds, ruled_chords
>>> chords = BiarcChords.of([[0, 0]], [0.4], [[10, 0]], [0.2])
>>> kind = biarc_kinds(chords)
>>> kind.tolist()
['S']
>>> first, second, fallback = ruled_chords(chords, kind, "inverse")
>>> round(float(second[0] / first[0]), 6)
1.427678
"""

from __future__ import annotations

from typing import Literal, cast, get_args

import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.classical.biarc_c import stationary_chords
from assoc_hull.geometry.classical.biarc_family import BiarcChords
from assoc_hull.geometry.classical.biarc_s import chords_of_radii, ratio_radii
from assoc_hull.geometry.classical.choices import one_of
from assoc_hull.geometry.curves import FloatArray

__all__ = ["BiarcRule", "biarc_kinds", "known_rule", "ruled_chords"]

BiarcRule = Literal["inverse", "as_printed", "min_jump", "equal_chord"]

BoolArray = NDArray[np.bool_]
StrArray = NDArray[np.str_]

_NIL = 1e-11
"""An angle below this (rad) is none."""


def known_rule(rule: object) -> BiarcRule:
    """Take the name of a rule.

    Raises
    ------
    GeometryError
        No such rule.
    """
    return cast(BiarcRule, one_of(rule, get_args(BiarcRule), "biarc: no rule is called"))


def biarc_kinds(chords: BiarcChords) -> StrArray:
    """Tell "line", "circle", "C" (one bend) or "S" (an inflection), for each of n.

    An angle below 1e-11 rad is none, and two of the same side that differ by less are one circle.
    Where one angle is none and the other is not, it is an "S".
    """
    a, b = np.abs(chords.alpha), np.abs(chords.beta)
    bent = chords.one_bend
    return np.select(
        [chords.steepest < _NIL, np.minimum(a, b) < _NIL, bent & (np.abs(a - b) < _NIL), bent],
        ["line", "S", "circle", "C"],
        "S",
    )


def ruled_chords(
    chords: BiarcChords, kind: StrArray, rule: BiarcRule
) -> tuple[FloatArray, FloatArray, BoolArray]:
    """Give the chords of both arcs, in any unit, by a rule.

    Returns
    -------
    first, second : (n,)
        Chords.
    fallback : (n,) bool
        Where the rule would need a radius below nil, and equal chords stand in for it.
    """
    first, second = np.ones((2, len(chords)))
    fallback = np.zeros(len(chords), bool)
    if rule == "equal_chord":
        return first, second, fallback
    a, b = np.abs(chords.alpha), np.abs(chords.beta)
    low, high = np.minimum(a, b), np.maximum(a, b)
    fallback = (kind == "C") & (3.0 * low - high < _NIL)
    c = np.flatnonzero((kind == "C") & ~fallback)
    first[c], second[c] = stationary_chords(a[c], b[c])
    if rule != "min_jump":
        s = np.flatnonzero((kind == "S") & (low >= _NIL))
        q = a[s] / b[s] if rule == "inverse" else b[s] / a[s]
        radii = ratio_radii(chords.chord[s], a[s], b[s], q)
        first[s], second[s] = chords_of_radii(chords.chord[s], a[s], b[s], *radii)
    return first, second, fallback
