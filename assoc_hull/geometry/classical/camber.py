"""Camber of decks, in the two ways of the papers.

`Camber` gives the rise from the side to the centre line over x (SEAKING): with t the part of the
half-breadth a parabola z = zs + c (1 - t t), or a straight line z = zs + c (1 - t). `CamberKind`
gives the drop below the centre line over the half-breadth, in four kinds (PRELIKON); a deck is made
of it. Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design
and Production", J. SNAK.
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import shown
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import (
    digits,
    finite_array,
    one_of,
    require_broadcast,
    within_range,
)
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = [
    "KINDS",
    "Camber",
    "CamberKind",
]


KINDS = ("line", "parabola")
"""What a camber is between side and centre line."""

_SLACK = 1e-9
"""So far (as a part of the half-breadth) beyond the side counts as the side, by rounding."""


@attrs.frozen(eq=False)
class Camber:
    """Camber over x; between stations all goes in straight lines.

    Attributes
    ----------
    x : (n,), m
        Increasing.
    half_breadth, side_height, rise : (n,), m
        Of the side, and from there to the centre line.
    kind : {"line", "parabola"}
        Its curve athwartships.
    notes : tuple of str
        A negative rise.
    """

    x: FloatArray
    half_breadth: FloatArray
    side_height: FloatArray
    rise: FloatArray
    kind: str
    notes: tuple[str, ...] = ()

    def __attrs_post_init__(self) -> None:
        freeze(self.x, self.half_breadth, self.side_height, self.rise)

    @classmethod
    def make(
        cls, x: ArrayLike, half_breadth: ArrayLike, side_height: ArrayLike, rise: ArrayLike,
        kind: str = "parabola",
    ) -> Self:  # fmt: skip
        """Check the arguments.

        Parameters
        ----------
        x : (n,) array_like, m
            Stations, increasing; one stands for its own place only.
        half_breadth, side_height, rise : (n,) array_like or float, m
            One for all stations, or one each.
        kind : {"line", "parabola"}
            Its curve athwartships.

        Raises
        ------
        GeometryError
            ``"camber: half-breadth must be positive"``; stations out of order, another kind.
        """
        one_of(kind, KINDS, "camber: kind is")
        places = finite_array(x, "camber", (None,))
        if not len(places) or (np.diff(places) <= 0.0).any():
            row = int(np.argmax(np.diff(places) <= 0.0)) + 1 if len(places) else 0
            what = f"camber: x not strictly increasing at row {row}"
            raise GeometryError(what, "put the stations in order from aft", {"row": row})
        breadth, side, bow = (
            _each(part, len(places)) for part in (half_breadth, side_height, rise)
        )
        if (breadth <= 0.0).any():
            row = int(np.argmax(breadth <= 0.0))
            told = {"row": row, "b": float(breadth[row])}
            raise GeometryError("camber: half-breadth must be positive", "give one above 0", told)
        return cls(places, breadth, side, bow, kind, _hollow(places, bow))

    def height(self, x: ArrayLike, y: ArrayLike) -> FloatArray:
        """Give heights above the base line (m).

        Parameters
        ----------
        x, y : array_like, m
            Places, of shapes that broadcast; y to either side.

        Raises
        ------
        GeometryError
            ``"camber: |y|={y} exceeds half-breadth {b}"``, x beyond the stations.
        """
        _place, half, side, rise = self._at(x)
        off = np.abs(finite_array(y, "camber", None))
        off, half, side, rise = np.broadcast_arrays(off, half, side, rise)
        beyond = off > half * (1.0 + _SLACK)
        if beyond.any():
            first = float(off[beyond].flat[0]), float(half[beyond].flat[0])
            raise GeometryError(
                f"camber: |y|={digits(first[0])} exceeds half-breadth {digits(first[1])}",
                "ask between the sides", {"y": first[0], "b": first[1]},
            )  # fmt: skip
        part = np.minimum(off / half, 1.0)
        drop = part * part if self.kind == "parabola" else part
        return np.asarray(side + rise * (1.0 - drop))

    def area(self, x: ArrayLike) -> FloatArray:
        """Give areas of both sides above the height of the side, m2, at x (m).

        4 b c / 3 for a parabola, b c for a line.
        """
        _, half, _, rise = self._at(x)
        return np.asarray((4.0 / 3.0 if self.kind == "parabola" else 1.0) * half * rise)

    def _at(self, x: ArrayLike) -> tuple[FloatArray, ...]:
        place = within_range(x, "camber", float(self.x[0]), float(self.x[-1]))
        columns = (self.half_breadth, self.side_height, self.rise)
        return (place, *(np.asarray(np.interp(place, self.x, each)) for each in columns))


def _each(value: ArrayLike, count: int) -> FloatArray:
    """Take one number for all stations, or one each."""
    if isinstance(value, int | float | np.number):
        return np.full(count, finite_array(value, "camber", ()))
    return finite_array(value, "camber", (count,))


def _hollow(x: FloatArray, rise: FloatArray) -> tuple[str, ...]:
    """Report the first negative rise: the deck is lower at the centre line than at the side."""
    below = np.flatnonzero(rise < 0.0)
    if not len(below):
        return ()
    row = int(below[0])
    return (
        f"camber: c={digits(rise[row])} at x={digits(x[row])} is negative: the deck is lower at "
        "the centre line than at the side",
    )


# --------------------------------------------------------------------------------------
# Camber by the drop below the centre line.

_LARGEST = 1e6
"""No half-breadth (m) is larger."""

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(2)
"""Exact for cubics: each piece of a camber curve is a parabola."""


@attrs.frozen(eq=False)
class CamberKind:
    """Drop of a deck below its centre line, over the half-breadth.

    Kind 1 is a parabola (C-infinity), 2 a parabola up to `joint` and its tangent beyond (C1), 3
    two lines, one on each side (C0), 4 three lines, flat up to `joint` (C0). Read on the
    half-breadth, 3 and 4 are two and three lines on each side, through given points. The camber
    of the PRELIKON system in Kim & Chang, "Some Representations of Ship Hulls by Mathematical
    Method for Design and Production", J. SNAK.

    Attributes
    ----------
    kind : int
        1 to 4.
    half_breadth : float, m
        The reference half-breadth B.
    total : float, m
        Drop c at B, positive downward.
    joint : float, m
        Kind 2: where the line begins; kind 4: half the width of the flat centre; else 0.
    reading : {"full", "half"}
        Whether the lines of kinds 3 and 4 are counted over the breadth or the half-breadth.
    scale : {"fixed", "local"}
        The same curve at every x, or stretched so that B is the half-breadth there.
    y, drops : (n,), m
        Ends of the pieces from the centre line outward, and the drop there.
    bend : (n - 1,), 1/m
        Second derivative of each piece; 0 is a line.
    """

    kind: int
    half_breadth: float
    total: float
    joint: float
    reading: str
    scale: str
    y: FloatArray
    drops: FloatArray
    bend: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.y, self.drops, self.bend)

    @classmethod
    def make(
        cls,
        kind: int,
        half_breadth: float,
        total: float,
        *,
        joint: float = 0.0,
        scale: str = "fixed",
    ) -> Self:
        """Make one of the four kinds; arguments as the attributes.

        Raises
        ------
        GeometryError
            ``"camber: kind {k} not in 1..4"``; ``"camber: y1={y} must be inside (0, B)"``; a
            half-breadth that is not above 0, numbers that are not finite.
        """
        known = _kind(kind)
        most, drop, inner = (
            float(finite_array(each, "camber", ())) for each in (half_breadth, total, joint)
        )
        _require_size(most)
        if known in (2, 4) and not _SLACK * most < inner < most:
            raise GeometryError(
                f"camber: y1={digits(inner)} must be inside (0, {digits(most)})",
                "give a joint between the centre line and the reference half-breadth",
                {"y1": inner, "B": most},
            )  # fmt: skip
        y, drops, bend = _pieces(known, most, drop, inner)
        where = inner if known in (2, 4) else 0.0
        return cls(known, most, drop, where, "full", _scale(scale), y, drops, bend)

    @classmethod
    def through(cls, kind: int, points: ArrayLike, *, scale: str = "fixed") -> Self:
        """Make kind 3 or 4 as two or three lines on the half-breadth.

        Parameters
        ----------
        kind : int
            3 or 4.
        points : (3, 2) or (4, 2), m
            Rows (y, drop) from (0, 0) outward; the last y is the reference half-breadth.
        scale : {"fixed", "local"}
            As the attribute.

        Raises
        ------
        GeometryError
            ``"camber: kind {k} not in 1..4"``; kind 1 or 2; another number of points; points
            that do not begin at (0, 0) or whose y does not increase.

        Examples
        --------
        >>> from assoc_hull.geometry.classical.camber import CamberKind
        >>> camber = CamberKind.through(3, [(0, 0), (9, 0.1), (15, 0.5)])
        >>> float(camber.drop(12.0).round(12))
        0.3
        """
        known = _kind(kind)
        if known < 3:
            what = f"camber: kind {known} read on the half-breadth"
            raise GeometryError(what, "use kind 3 or 4", {"kind": known})
        rows = finite_array(points, "camber", (known, 2))
        if rows[0].any() or (np.diff(rows[:, 0]) <= 0.0).any():
            raise GeometryError(
                "camber: points do not run from (0, 0) outward", "sort them by y",
                {"points": rows.tolist()},
            )  # fmt: skip
        y, drops = rows[:, 0].copy(), rows[:, 1].copy()
        most, drop = float(y[-1]), float(drops[-1])
        _require_size(most)
        return cls(known, most, drop, 0.0, "half", _scale(scale), y, drops, np.zeros(known - 1))

    def drop(self, y: ArrayLike, half_breadth: ArrayLike | None = None) -> FloatArray:
        """Give the drop (m) at half-breadths, the same to both sides.

        Parameters
        ----------
        y : array_like, m
            Of any shape.
        half_breadth : array_like, m, optional
            Of the deck there, where the curve is scaled to it; broadcast with `y`.

        Raises
        ------
        GeometryError
            ``"camber: y={y} beyond reference half-breadth {B}"``; a scaled curve without the
            half-breadth, or one that is not above 0.
        """
        asked = self._referred(y, half_breadth)
        piece = np.clip(np.searchsorted(self.y, asked, "right") - 1, 0, len(self.bend) - 1)
        low, high = self.y[piece], self.y[piece + 1]
        slope = (self.drops[piece + 1] - self.drops[piece]) / (high - low)
        chord = self.drops[piece] + slope * (asked - low)
        return np.asarray(chord + 0.5 * self.bend[piece] * (asked - low) * (asked - high))

    def mean(self, y: float, half_breadth: float | None = None) -> float:
        """Give the mean drop (m) from the centre line to `y` > 0, exactly.

        Raises
        ------
        GeometryError
            As `drop`; a `y` that is not above 0.
        """
        most = float(finite_array(y, "camber", ()))
        if not most > 0.0:
            raise GeometryError(f"camber: mean up to y={digits(most)}", "give y above 0")
        # For its refusals.
        self.drop(most, half_breadth)
        inner = self.y
        if self.scale == "local":
            given = 0.0 if half_breadth is None else half_breadth
            inner = inner * (float(finite_array(given, "camber", ())) / self.half_breadth)
        ends = np.concatenate([inner[inner < most], [most]])
        width = 0.5 * np.diff(ends)
        at = ends[:-1, None] + width[:, None] * (1.0 + _NODES)
        return float((self.drop(at, half_breadth) @ _WEIGHTS * width).sum()) / most

    def _referred(self, y: ArrayLike, half_breadth: ArrayLike | None) -> FloatArray:
        """Give y as it lies on the reference half-breadth."""
        asked = np.abs(finite_array(y, "camber", None))
        if self.scale == "local":
            wide = _breadths(half_breadth)
            require_broadcast("camber", asked, wide)
            asked = asked * (self.half_breadth / wide)
        beyond = asked > self.half_breadth * (1.0 + _SLACK)
        if beyond.any():
            first = float(asked[beyond].flat[0])
            raise GeometryError(
                f"camber: y={digits(first)} beyond reference half-breadth "
                f"{digits(self.half_breadth)}",
                "give a wider reference, or scale it to the deck",
                {"y": first, "B": self.half_breadth},
            )  # fmt: skip
        return np.minimum(asked, self.half_breadth)


def _require_size(half_breadth: float) -> None:
    if not _SLACK < half_breadth <= _LARGEST:
        raise GeometryError(
            f"camber: half-breadth {digits(half_breadth)}",
            f"give one above 0, and of at most {_LARGEST:g} m", {"B": half_breadth},
        )  # fmt: skip


def _kind(kind: object) -> int:
    if isinstance(kind, bool) or not isinstance(kind, int) or not 1 <= kind <= 4:
        what = f"camber: kind {shown(kind)} not in 1..4"
        raise GeometryError(what, "use 1, 2, 3 or 4", {"kind": kind})
    return kind


def _scale(scale: object) -> str:
    if not isinstance(scale, str) or scale not in ("fixed", "local"):
        what = f"camber: scale is {shown(scale)}"
        raise GeometryError(what, 'use "fixed" or "local"', {"scale": scale})
    return scale


def _breadths(half_breadth: ArrayLike | None) -> FloatArray:
    if half_breadth is None:
        what = "camber: scaled to the deck, whose half-breadth is not given"
        raise GeometryError(what, "give half_breadth")
    found = finite_array(half_breadth, "camber", None)
    if (found <= 0.0).any():
        what = f"camber: half-breadth {digits(float(found.min()))}"
        raise GeometryError(what, "give one above 0", {"half_breadth": float(found.min())})
    return found


def _pieces(
    kind: int, most: float, drop: float, joint: float
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give ends, drops there and second derivatives of the pieces."""
    if kind == 1:
        return np.array([0.0, most]), np.array([0.0, drop]), np.array([2.0 * drop / most**2])
    if kind == 2:
        steep = drop / (2.0 * joint * most - joint**2)
        ends, drops = [0.0, joint, most], [0.0, steep * joint**2, drop]
        return np.array(ends), np.array(drops), np.array([2.0 * steep, 0.0])
    if kind == 3:
        return np.array([0.0, most]), np.array([0.0, drop]), np.zeros(1)
    return np.array([0.0, joint, most]), np.array([0.0, 0.0, drop]), np.zeros(2)
