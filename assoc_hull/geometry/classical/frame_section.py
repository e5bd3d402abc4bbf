"""A frame: the section of a hull where its longitudinal lines are cut at one x.

From below: the flat of bottom, parabolas over the chords between given points, a rounded corner,
the camber of the deck; y outward, z up, m, areas exact. The frame passes all points and is
continuous only: its direction jumps at each, and these jumps are reported. They fall with about
the square of the spacing of waterlines on smooth data. Source: Kim & Chang, "Some Representations
of Ship Hulls by Mathematical Method for Design and Production", J. SNAK.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import integer
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.camber import KINDS
from assoc_hull.geometry.classical.checked_input import (
    bounded_height,
    digits,
    finite_array,
    one_of,
    wrap_angle,
)
from assoc_hull.geometry.classical.circular_arcs import PlaneArcs, arc_area, arc_moment
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.numeric.polynomials import brent_root

__all__ = [
    "MOST_RATIO",
    "DeckCorner",
    "FrameRun",
    "FrameSection",
    "Quadratics",
    "deck_corner",
    "deck_pieces",
    "frame_runs",
    "run_bends",
    "spacing_notes",
    "tangent_jumps",
]

# --------------------------------------------------------------------------------------
# Pieces whose two coordinates are quadratic in the length along their chord: lines, parabolas over
# chords, cambers.

_FAR = 1e9
"""A level (m) beyond all that is integrated; infinite ones are brought here."""

_SLACK = 1e-12
"""A place so far beyond an end (as a part of the length) is the end."""

_GAUSS = np.polynomial.legendre.leggauss(3)


@attrs.frozen(eq=False)
class Quadratics:
    """Pieces, one behind the other.

    Attributes
    ----------
    y, z : (n, 3)
        Coefficients of both coordinates in powers of p, from the constant on; m.
    length : (n,), m
        p runs from 0 to this.
    """

    y: FloatArray
    z: FloatArray
    length: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.y, self.z, self.length)

    @classmethod
    def over(cls, points: ArrayLike, bend: ArrayLike) -> Self:
        """Give the parabolas q = K/2 p (p - l) over the chords of points.

        Parameters
        ----------
        points : (n + 1, 2) array_like, m
            Not coincident; p runs along each chord, q to its left.
        bend : (n,) array_like, 1/m
            K of each.
        """
        place = finite_array(points, "parabolas", (None, 2))
        k = finite_array(bend, "parabolas", (len(place) - 1,))
        step = np.diff(place, axis=0)
        length = np.hypot(*step.T)
        cosine, sine = step.T / length
        lean = 0.5 * k * length
        y = np.stack([place[:-1, 0], cosine + sine * lean, -0.5 * sine * k], axis=1)
        z = np.stack([place[:-1, 1], sine - cosine * lean, 0.5 * cosine * k], axis=1)
        return cls(y, z, length)

    @classmethod
    def join(cls, parts: Sequence[Quadratics]) -> Self:
        """Put pieces behind one another."""
        names = ("y", "z", "length")
        return cls(*(np.concatenate([getattr(each, name) for each in parts]) for name in names))

    def __len__(self) -> int:
        return len(self.length)

    def at(self, piece: IntArray, p: ArrayLike) -> FloatArray:
        """Give points (k, 2), m, on the pieces numbered `piece` (k,) at lengths `p` (k,), m."""
        t = np.asarray(p, np.float64)
        found = [
            each[piece, 0] + t * (each[piece, 1] + t * each[piece, 2]) for each in (self.y, self.z)
        ]
        return np.stack(found, axis=-1)

    def angles(self) -> tuple[FloatArray, FloatArray]:
        """Give directions (rad) at the beginning and the end of each, two of (n,)."""
        ends = [
            [each[:, 1] + 2.0 * t * each[:, 2] for each in (self.y, self.z)]
            for t in (np.zeros(len(self)), self.length)
        ]
        return np.arctan2(ends[0][1], ends[0][0]), np.arctan2(ends[1][1], ends[1][0])

    def area(self) -> float:
        """Give the integral of y dz over all of them, m2."""
        return float((self._integral(self.length) - self._integral(0.0 * self.length)).sum())

    def area_below(self, level: float) -> float:
        """Give the integral of y dz over what lies at or below a level (m), m2."""
        if not np.isfinite(level):
            return self.area() if level > 0.0 else 0.0
        return float(self.each_below(level)[0].sum())

    def moment_below(self, level: float) -> float:
        """Give the integral of y z dz over what lies at or below a level (m), m3."""
        return float(self.each_below(min(max(level, -_FAR), _FAR))[1].sum())

    def each_below(self, level: float) -> tuple[FloatArray, FloatArray]:
        """Give both integrals, m2 and m3, of each piece by itself, two of (n,)."""
        inner = np.sort(np.nan_to_num(np.clip(self._roots(level), 0.0, self.length[:, None])))
        breaks = np.column_stack([np.zeros(len(self)), inner, self.length])
        low, high = breaks[:, :-1], breaks[:, 1:]
        wet = self._polynomial(self.z, 0.5 * (low + high)) <= level
        area = self._integral(high) - self._integral(low)
        # Three nodes of Gauss are exact to the fifth power, which is what stands here.
        node, weight = _GAUSS
        p = (0.5 * (low + high)[..., None] + 0.5 * (high - low)[..., None] * node).reshape(
            len(self), -1
        )
        y, z = (self._polynomial(each, p) for each in (self.y, self.z))
        rise = self.z[:, 1:2] + 2.0 * p * self.z[:, 2:]
        moment = (y * z * rise).reshape(*wet.shape, 3) @ weight * 0.5 * (high - low)
        return np.where(wet, area, 0.0).sum(axis=1), np.where(wet, moment, 0.0).sum(axis=1)

    def crossings(self, level: float) -> FloatArray:
        """Give y (m) where each passes a level (m), (n, 2); nan where it does not."""
        p = self._roots(level)
        return np.asarray(self._polynomial(self.y, p))

    def _roots(self, level: float) -> FloatArray:
        """Give p where each passes a level, (n, 2), nan where it does not."""
        a, b, c = self.z[:, 2], self.z[:, 1], self.z[:, 0] - level
        root = np.sqrt(np.maximum(b * b - 4.0 * a * c, 0.0))
        # The stable form: no difference of numbers that are nearly the same.
        half = -0.5 * (b + np.where(b < 0.0, -root, root))
        with np.errstate(divide="ignore", invalid="ignore"):
            roots = np.stack([c / half, half / a], axis=1)
        slack = _SLACK * self.length[:, None]
        real = (b * b - 4.0 * a * c >= 0.0)[:, None] & np.isfinite(roots)
        real &= (roots >= -slack) & (roots <= self.length[:, None] + slack)
        return np.where(real, roots, np.nan)

    def _polynomial(self, of: FloatArray, p: FloatArray) -> FloatArray:
        c = of if p.ndim == 1 else of[:, :, None]
        return np.asarray(c[:, 0] + p * (c[:, 1] + p * c[:, 2]))

    def _integral(self, p: FloatArray) -> FloatArray:
        """Integrate y dz from 0 to p, (n,) or (n, k)."""
        y, z = (each if p.ndim == 1 else each[:, :, None] for each in (self.y, self.z))
        one = y[:, 0] * z[:, 1]
        two = 0.5 * (y[:, 1] * z[:, 1] + 2.0 * y[:, 0] * z[:, 2])
        three = (y[:, 2] * z[:, 1] + 2.0 * y[:, 1] * z[:, 2]) / 3.0
        four = 0.5 * y[:, 2] * z[:, 2]
        return np.asarray(p * (one + p * (two + p * (three + p * four))))


# --------------------------------------------------------------------------------------
# Deck: the camber, and the arc that rounds its corner with the side. The centre of the arc lies by
# the radius below the camber and by the radius inside the side.


@attrs.frozen
class DeckCorner:
    """A rounded corner; points (y, z), m.

    Attributes
    ----------
    side_point, deck_point : (float, float), m
        Where it leaves the side, and where it comes onto the deck.
    centre : (float, float), m
        Of the arc.
    radius : float, m
        Of the arc.
    """

    side_point: tuple[float, float]
    deck_point: tuple[float, float]
    centre: tuple[float, float]
    radius: float

    def arc(self) -> PlaneArcs:
        """Give it as an arc from the side to the deck; it turns left."""
        (y, z), (v, w), (c, d) = self.side_point, self.deck_point, self.centre
        first, last = math.atan2(z - d, y - c), math.atan2(w - d, v - c)
        return PlaneArcs.make(
            [self.side_point], [first + 0.5 * math.pi], [1.0 / self.radius],
            [self.radius * (last - first)],
        )  # fmt: skip


def deck_corner(
    half_breadth: float, side_height: float, rise: float, radius: float, *,
    side_angle: float = 0.5 * math.pi, kind: str = "parabola", name: str = "frame",
) -> DeckCorner:  # fmt: skip
    """Round the corner (y, z) = (half_breadth, side_height) of deck and side, m.

    `rise` (m) is that of the camber from the side to the centre line, `side_angle` (rad) the upward
    direction of the side from the outward horizontal; the side is taken as straight. Raises
    GeometryError for a radius that does not fit.
    """
    one_of(kind, KINDS, f"{name}: camber kind is")
    numbers = (half_breadth, side_height, rise, radius, side_angle)
    b, zs, c, r, lean = (float(finite_array(each, name, ())) for each in numbers)
    if not r > 0.0 or not b > 0.0:
        what = f"{name}: corner radius {digits(r)} does not fit"
        raise GeometryError(what, "give a radius and a half-breadth above 0", {"r": r})
    inward = np.array([-math.sin(lean), math.cos(lean)])

    def centre(y: float) -> np.typing.NDArray[np.float64]:
        part = y / b
        if kind == "parabola":
            z, slope = zs + c * (1.0 - part * part), -2.0 * c * part / b
        else:
            z, slope = zs + c * (1.0 - part), -c / b
        normal = np.array([-slope, 1.0]) / math.hypot(1.0, slope)
        return np.array([y, z]) - r * normal

    def over(y: float) -> float:
        """How much farther than the radius the centre lies inside the side."""
        return float((centre(y) - (b, zs)) @ inward) - r

    if over(0.0) * over(b) > 0.0:
        what = f"{name}: corner radius {digits(r)} does not fit"
        raise GeometryError(what, "give a smaller radius", {"r": r})
    y = brent_root(over, 0.0, b, xtol=1e-14, rtol=1e-15)
    middle = centre(y)
    part = y / b
    top = zs + c * (1.0 - (part * part if kind == "parabola" else part))
    side = middle - r * inward
    return DeckCorner((float(side[0]), float(side[1])), (y, top), tuple(middle.tolist()), r)


def deck_pieces(
    top: FloatArray, rise: float, kind: str = "parabola", corner: DeckCorner | None = None
) -> Quadratics:
    """Give the camber from the side `top` (y, z), m, or from the corner, to the centre line.

    `rise` (m) is counted from the side, also where the camber begins at a corner.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.classical.frame_section import deck_pieces
    >>> round(2 * deck_pieces(np.array([15.0, 18.0]), 0.45).area(), 9)
    9.0
    """
    half, side = np.asarray(top, np.float64).tolist()
    start = half if corner is None else corner.deck_point[0]
    bend = rise / half**2 if kind == "parabola" and half else 0.0
    slope = 2.0 * bend * start if kind == "parabola" or not half else rise / half
    level = side + rise - (bend * start**2 if kind == "parabola" else slope * start)
    return Quadratics(
        np.array([[start, -1.0, 0.0]]), np.array([[level, slope, -bend]]), np.array([start])
    )


# --------------------------------------------------------------------------------------
# Points in order from the bottom past waterlines and knuckles to the deck side.

MOST_RATIO = 4.0
"""Beyond this ratio of neighbouring spacings of waterlines a frame bends badly."""

_SAME = 1e-9
"""Points (m) that differ by less are one."""


@attrs.frozen(eq=False)
class FrameRun:
    """Points (n, 2), m, from one end or knuckle to the next, upward."""

    points: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.points)


def frame_runs(
    first: FloatArray, water: FloatArray, knuckles: FloatArray, top: FloatArray, name: str
) -> tuple[FrameRun, ...]:
    """Put points (y, z), m, in order and part them at knuckles; `name` stands in messages.

    `first` is the lowest point, `top` the deck side. Of `water` (n, 2) only what lies between them
    counts, of `knuckles` (k, 2) also what is level with either. Raises GeometryError for two points
    at one height that are not both knuckle, edge of the flat or deck side.
    """
    water = water[(water[:, 1] > first[1] + _SAME) & (water[:, 1] < top[1] - _SAME)]
    inner = (knuckles[:, 1] >= first[1] - _SAME) & (knuckles[:, 1] <= top[1] + _SAME)
    corners = np.concatenate([first[None], knuckles[inner], top[None]])
    corners = corners[_distinct(corners)]
    water = water[[not _near(corners, each) for each in water]] if len(water) else water
    points = np.concatenate([corners, water])
    corner = np.arange(len(points)) < len(corners)
    # The first and the last stay where they are among points of one height.
    rank = np.where(corner, np.arange(len(points)), 0.5)
    order = np.lexsort([rank, points[:, 1]])
    points, corner = points[order], corner[order]
    if len(points) < 2 or top[1] < first[1] - _SAME:
        what = f"{name}: fewer than 2 points on the section"
        raise GeometryError(what, "let lines reach it above its keel", {"points": len(points)})
    level = np.diff(points[:, 1]) <= _SAME
    bad = np.flatnonzero(level & ~(corner[1:] & corner[:-1]))
    if len(bad):
        z = float(points[bad[0] + 1, 1])
        what = f"{name}: section points not increasing in z at {digits(z)}"
        raise GeometryError(what, "leave one of the two lines out there", {"z": z})
    ends = np.flatnonzero(corner)
    return tuple(FrameRun(points[a : b + 1].copy()) for a, b in itertools.pairwise(ends))


def _distinct(points: FloatArray) -> np.typing.NDArray[np.bool_]:
    """Tell which points coincide with none before them."""
    return np.array([not _near(points[:i], each) for i, each in enumerate(points)], bool)


def _near(points: FloatArray, place: FloatArray) -> bool:
    return bool((np.abs(points - place).max(axis=1, initial=0.0) <= _SAME).any())


def spacing_notes(
    water: FloatArray, first: FloatArray, top: FloatArray, name: str
) -> tuple[str, ...]:
    """Report neighbouring waterlines, bottom to deck side, whose spacings differ too much."""
    inner = np.unique(water[(water[:, 1] > first[1]) & (water[:, 1] < top[1]), 1])
    gap = np.diff(inner)
    if len(gap) < 2:
        return ()
    ratio = np.maximum(gap[1:] / gap[:-1], gap[:-1] / gap[1:])
    worst = int(ratio.argmax())
    if ratio[worst] <= MOST_RATIO:
        return ()
    return (
        f"{name}: waterline spacing ratio {digits(ratio[worst])} exceeds {digits(MOST_RATIO)} at "
        f"z={digits(inner[worst + 1])}",
    )


# --------------------------------------------------------------------------------------
# Bends of the pieces between given points.
#
# Over each chord stands q = K/2 p (p - l), p along the chord of length l, q to its left. A parabola
# through both ends and a neighbour at (p_n, q_n) has K = 2 q_n / (p_n (p_n - l)); the mean of the
# two neighbours is taken, or the only one at an end, or with a given direction at the start
# K = -2 tan(alpha) / l, alpha from the chord to it.


def run_bends(
    points: ArrayLike, start_angle: float | None = None, name: str = "frame"
) -> tuple[FloatArray, tuple[str, ...]]:
    """Give the bend K (1/m) of each piece of a run (n,), 0 where nothing tells, and notes.

    `points` (n + 1, 2), m, lead from one knuckle or end to the next; `start_angle` (rad) is the
    direction at the start, if it is known. Notes name neighbours that lie beside a chord.
    """
    place = finite_array(points, name, (None, 2))
    if len(place) < 2:
        what = f"{name}: fewer than 2 points on the section"
        raise GeometryError(what, "give waterlines that reach it", {"points": len(place)})
    step = np.diff(place, axis=0)
    length = np.hypot(*step.T)
    if (length == 0.0).any():
        row = int(np.argmax(length == 0.0))
        what = f"{name}: points {row} and {row + 1} coincide"
        raise GeometryError(what, "leave one of them out", {"row": row})
    along = step / length[:, None]
    before, after = np.full((2, len(length)), np.nan)
    before[1:], low = _with_neighbour(place[:-2], place[1:-1], along[1:], length[1:], ahead=False)
    after[:-1], high = _with_neighbour(place[2:], place[:-2], along[:-1], length[:-1], ahead=True)
    if start_angle is not None:
        lean = float(
            wrap_angle(
                float(finite_array(start_angle, name, ())) - np.arctan2(step[0, 1], step[0, 0])
            )
        )
        if abs(lean) < 0.5 * np.pi:
            before[0] = -2.0 * np.tan(lean) / length[0]
    both = np.stack([before, after])
    count = np.isfinite(both).sum(axis=0)
    bend = np.where(count > 0, np.nansum(both, axis=0) / np.maximum(count, 1), 0.0)
    dropped = [*(np.flatnonzero(low) + 1).tolist(), *np.flatnonzero(high).tolist()]
    notes = tuple(
        f"{name}: a neighbour of the piece from ({digits(place[i, 0])}, {digits(place[i, 1])}) "
        "lies beside its chord and was left out"
        for i in sorted(dropped)
    )
    return bend, notes


def _with_neighbour(
    neighbour: FloatArray, foot: FloatArray, along: FloatArray, length: FloatArray, *, ahead: bool
) -> tuple[FloatArray, np.typing.NDArray[np.bool_]]:
    """Give K by a neighbour of each chord, nan where that lies beside it; and where it does."""
    away = neighbour - foot
    p = (away * along).sum(axis=1)
    q = along[:, 0] * away[:, 1] - along[:, 1] * away[:, 0]
    beyond = p > length if ahead else p < 0.0
    with np.errstate(divide="ignore", invalid="ignore"):
        bend = 2.0 * q / (p * (p - length))
    return np.where(beyond, bend, np.nan), ~beyond


def tangent_jumps(pieces: Quadratics) -> FloatArray:
    """Give by how much the direction turns at each inner point (rad), (n - 1,).

    Examples
    --------
    >>> from assoc_hull.geometry.classical.frame_section import run_bends, tangent_jumps
    >>> from assoc_hull.geometry.classical.frame_section import Quadratics
    >>> run = [(7.5, 0), (11, 0.8), (13.5, 2.5), (14.8, 5), (15, 9), (15, 14)]
    >>> jumps = tangent_jumps(Quadratics.over(run, run_bends(run)[0]))
    >>> round(float(abs(jumps).max()), 9)
    0.127501846
    """
    leave, arrive = pieces.angles()
    return wrap_angle(leave[1:] - arrive[:-1])


# --------------------------------------------------------------------------------------
# The frame itself.


@attrs.frozen(eq=False)
class FrameSection:
    """A frame, one side; y outward, z up, m.

    Attributes
    ----------
    x : float, m
        Where it stands.
    flat : float, m
        Half-width of the flat of bottom, 0 without one.
    runs : tuple of FrameRun
        Points from the bottom to the first knuckle, from there to the next, up to the deck side.
    side : Quadratics
        The pieces of all runs; the last one ends where the corner begins, if there is one.
    corner : DeckCorner or None
        Between side and deck.
    deck : Quadratics or None
        The camber from there to the centre line; None of a deck that is straight across, or none.
    jumps : (k,), rad
        By how much the direction turns at each point of the runs but their ends.
    notes : tuple of str
        Neighbours that were left out, uneven spacing.
    level_start : bool
        Whether it leaves a flat of bottom horizontally.
    side_area : float, m2
        Of one side up to the deck side, without corner and camber.
    """

    x: float
    flat: float
    runs: tuple[FrameRun, ...]
    side: Quadratics
    corner: DeckCorner | None
    deck: Quadratics | None
    jumps: FloatArray
    notes: tuple[str, ...]
    level_start: bool = False
    side_area: float = 0.0

    def __attrs_post_init__(self) -> None:
        freeze(self.jumps)

    @classmethod
    def make(
        cls, x: float, waterline_points: ArrayLike, *, deck_side: ArrayLike,
        keel: float = 0.0, flat: float | None = None, knuckles: ArrayLike | None = None,
        camber: float | None = None, camber_kind: str = "parabola", corner_radius: float = 0.0,
    ) -> Self:  # fmt: skip
        """Build a frame.

        Parameters
        ----------
        x : float, m
            Where it stands.
        waterline_points : (n, 2) array_like, m
            Points (y, z) of waterlines, in any order; those not above the bottom or not below
            the deck side are left out.
        deck_side : (2,) array_like, m
            (y, z) of the deck side.
        keel : float, m
            Height of the keel where there is no flat of bottom.
        flat : float or None, m
            Half-width of the flat of bottom at z = 0, which the frame leaves horizontally; None
            where the frame begins at the keel.
        knuckles : (k, 2) array_like or None, m
            Points (y, z) of knuckle lines.
        camber : float or None, m
            Rise of the deck at the centre line; None for a deck straight across.
        camber_kind : {"line", "parabola"}
            Its curve.
        corner_radius : float, m
            Of the corner between side and deck, 0 for none.

        Raises
        ------
        GeometryError
            ``"frame x={x}: fewer than 2 points on the section"``, ``"frame x={x}: section points
            not increasing in z at {z}"``, ``"frame x={x}: corner radius {r} does not fit"``.
        """
        name = f"frame x={digits(float(finite_array(x, 'frame', ())))}"
        one_of(camber_kind, KINDS, f"{name}: camber kind is")
        level = flat is not None
        start = keel if flat is None else flat
        foot, radius = (float(finite_array(each, name, ())) for each in (start, corner_radius))
        # `foot` is a half-width on the base line, or a height on the centre line.
        first = np.array([foot, 0.0] if level else [0.0, foot])
        rise = None if camber is None else float(finite_array(camber, name, ()))
        top = finite_array(deck_side, name, (2,))
        water = _rows(waterline_points, name)
        runs = frame_runs(first, water, _rows(knuckles, name), top, name)
        notes = list(spacing_notes(water, first, top, name))
        pieces, jumps = [], []
        for number, run in enumerate(runs):
            # Only the lowest run begins at the flat, which the frame leaves horizontally.
            lean = 0.0 if level and not number else None
            bend, told = run_bends(run.points, lean, name)
            pieces.append(Quadratics.over(run.points, bend))
            jumps.append(tangent_jumps(pieces[-1]))
            notes += told
        if level:
            # The flat itself has the direction 0.
            jumps.insert(0, pieces[0].angles()[0][:1])
        # The whole is kept for its area: the corner shortens the last piece.
        side = whole = Quadratics.join(pieces)
        corner = None
        if radius:
            # A deck straight across is rounded as a camber without rise.
            side, corner = _rounded(side, top, rise or 0.0, radius, camber_kind, name)
        deck = None if rise is None else deck_pieces(top, rise, camber_kind, corner)
        return cls(
            float(x), foot if level else 0.0, runs, side, corner, deck, np.concatenate(jumps),
            tuple(notes), level, whole.area(),
        )  # fmt: skip

    @property
    def largest_jump(self) -> float:
        """The largest jump of the direction at a point that is no knuckle, rad."""
        return float(np.abs(self.jumps).max(initial=0.0))

    @property
    def keel(self) -> float:
        """Height of its lowest given point, m."""
        return float(self.runs[0].points[0, 1])

    def area(self, level: float | None = None) -> float:
        """Give the area of both sides below a height (m), m2; all of it if None.

        Exact: parabolas, arc and camber are integrated in closed form.
        """
        height = math.inf if level is None else bounded_height(level, "frame area")
        parts = [self.side] if self.deck is None else [self.side, self.deck]
        if not math.isfinite(height):
            found = sum(each.area() for each in parts)
        else:
            found = sum(each.area_below(height) for each in parts)
        if self.corner is not None:
            found += arc_area(self.corner.arc(), self.corner.centre, height)
        return 2.0 * found

    def moment(self, level: float) -> float:
        """Give the moment of the area of both sides below a height (m) about the base, m3."""
        height = bounded_height(level, "frame moment")
        parts = [self.side] if self.deck is None else [self.side, self.deck]
        found = sum(each.moment_below(height) for each in parts)
        if self.corner is not None:
            found += arc_moment(self.corner.arc(), self.corner.centre, height)
        return 2.0 * found

    def half_breadth(self, level: float) -> float:
        """Give the greatest half-breadth at a height (m), m; nan where it has none."""
        found = self.side.crossings(bounded_height(level, "frame"))
        return float(np.fmax.reduce(found, axis=None))

    def drawn(self, count: int = 8) -> FloatArray:
        """Give points up to the deck side, `count` chords a piece, (n, 2), m."""
        integer(count, "count", "in a drawn frame", least=1, most=10_000)
        part = np.linspace(0.0, 1.0, count + 1)[1:]
        piece = np.repeat(np.arange(len(self.side)), count)
        inner = self.side.at(piece, np.outer(self.side.length, part).ravel())
        start = self.side.at(np.zeros(1, np.int64), np.zeros(1))
        centre = np.zeros((1 if self.flat else 0, 2))
        return np.concatenate([centre, start, inner])


def _rows(points: ArrayLike | None, name: str) -> FloatArray:
    if points is None or (isinstance(points, list | tuple) and not points):
        return np.zeros((0, 2))
    return finite_array(points, name, (None, 2))


def _rounded(
    side: Quadratics, top: FloatArray, rise: float, radius: float, kind: str, name: str
) -> tuple[Quadratics, DeckCorner]:
    """Round the corner above the last piece, which ends where the arc begins."""
    lean = float(side.angles()[1][-1])
    made = deck_corner(
        float(top[0]), float(top[1]), rise, radius, side_angle=lean, kind=kind, name=name
    )
    last = side.at(np.array([len(side) - 1]), np.zeros(1))[0]
    if made.side_point[1] <= last[1]:
        what = f"{name}: corner radius {digits(radius)} does not fit"
        raise GeometryError(
            what, "give a smaller radius, or waterlines that leave room below the deck",
            {"r": radius, "z": made.side_point[1]},
        )  # fmt: skip
    # The side is straight below the corner: the arc touches it there.
    short = Quadratics.over(np.array([last, made.side_point]), np.zeros(1))
    kept = Quadratics(side.y[:-1], side.z[:-1], side.length[:-1])
    return Quadratics.join([kept, short]), made
