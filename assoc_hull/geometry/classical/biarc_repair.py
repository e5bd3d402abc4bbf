"""Biarcs whose radii are at least what can be made: the smaller one takes that, the other follows.

Source: Kim and Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK, whose repair of radii below nil this is.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.classical.biarcs import biarcs
>>> found = biarcs([[0, 0]], np.radians([60]), [[10, 0]], np.radians([-15]), least_radius=1.0)
>>> (1 / np.abs(found.arcs.curvature)).round(6).tolist()
[1.0, 22.381989]
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.biarc_c import (
    direction_of_radius,
    one_bend_limit,
)  # fmt: skip
from assoc_hull.geometry.classical.biarc_family import BiarcChords, interval
from assoc_hull.geometry.classical.biarc_s import chords_of_radii, other_radius, ratio_radii
from assoc_hull.geometry.classical.checks import figure, finite
from assoc_hull.geometry.curves import FloatArray, IntArray

__all__ = ["least_radii", "radius_limits", "repaired_chords"]

BoolArray = NDArray[np.bool_]
StrArray = NDArray[np.str_]
Chords = tuple[FloatArray, FloatArray]

_SLACK = 1e-12
"""So much of a radius is rounding."""
_LEAST = 1e-12
"""So much of a chord is none."""


def least_radii(radius: ArrayLike, chords: BiarcChords) -> FloatArray:
    """Take one radius for all, or one each, m; 0 asks for none.

    Raises
    ------
    GeometryError
        Not finite, below 0, of another count, or too small to be seen beside the chord.
    """
    count = len(chords)
    flat = not isinstance(radius, list | tuple) and np.ndim(radius) == 0
    found = np.broadcast_to(finite(radius, "biarc", () if flat else (count,)), (count,))
    if (found < 0.0).any():
        index = int(np.flatnonzero(found < 0.0)[0])
        what = f"biarc: least radius {figure(found[index])} is below 0"
        raise GeometryError(what, "give 0 for none", {"index": index, "radius": found[index]})
    minute = np.flatnonzero((found > 0.0) & (found < _LEAST * chords.chord))
    if len(minute):
        index = int(minute[0])
        what = f"biarc: least radius {figure(found[index])} is none beside the chord"
        told = {"index": index, "radius": float(found[index])}
        raise GeometryError(what, "give 0 for none", told, interval(index, count))
    return found


def radius_limits(chords: BiarcChords, kind: StrArray) -> FloatArray:
    """Give the least radius (m) that each could be asked for; infinite for lines."""
    a, b = np.abs(chords.alpha), np.abs(chords.beta)
    found = np.full(len(chords), np.inf)
    for rows, limit in (
        (np.flatnonzero(np.isin(kind, ("C", "circle"))), one_bend_limit),
        (np.flatnonzero(kind == "S"), _balanced),
    ):
        found[rows] = limit(chords.chord[rows], a[rows], b[rows])
    return found


def _balanced(chord: FloatArray, a: FloatArray, b: FloatArray) -> FloatArray:
    return ratio_radii(chord, a, b, np.ones_like(a))[0]


def repaired_chords(
    chords: BiarcChords, kind: StrArray, rows: IntArray, radius: FloatArray, at_start: BoolArray
) -> Chords:
    """Give the chords (m) of both arcs where the smaller radius is given.

    Parameters
    ----------
    chords : BiarcChords, n of them
        What is spanned.
    kind : (n,) str
        By `biarc_kinds`.
    rows : (k,)
        Which of them; no lines.
    radius : (n,), m
        The smaller radius.
    at_start : (n,) bool
        Whether it is the first of the two, where there is an inflection. Where there is none, it
        is the one at the larger angle.

    Returns
    -------
    first, second : (k,), m
        Chords.

    Raises
    ------
    GeometryError
        ``"biarc: r_min={} not attainable, limit {}"``.
    """
    _refuse_unattainable(chords, kind, rows, radius)
    a, b = np.abs(chords.alpha[rows]), np.abs(chords.beta[rows])
    chord, least = chords.chord[rows], radius[rows]
    tau = direction_of_radius(chord, a, b, least)
    bent = np.sin(0.5 * (b - tau)), np.sin(0.5 * (a + tau))
    begin = at_start[rows]
    far = other_radius(chord, np.where(begin, a, b), np.where(begin, b, a), least)
    radii = np.where(begin, least, far), np.where(begin, far, least)
    wound = chords_of_radii(chord, a, b, *radii)
    winds = kind[rows] == "S"
    return np.where(winds, wound[0], bent[0]), np.where(winds, wound[1], bent[1])


def _refuse_unattainable(
    chords: BiarcChords, kind: StrArray, rows: IntArray, radius: FloatArray
) -> None:
    limit = radius_limits(chords, kind)
    reached = np.where(kind == "S", radius <= limit * (1.0 + _SLACK), radius < limit)
    bad = rows[~reached[rows]]
    if len(bad):
        index = int(bad[0])
        raise GeometryError(
            f"biarc: r_min={figure(radius[index])} not attainable, limit {figure(limit[index])}",
            "ask for less, or move the points", {
                "index": index, "r_min": float(radius[index]), "limit": float(limit[index]),
            }, interval(index, len(chords)),
        )  # fmt: skip
