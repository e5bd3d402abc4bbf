"""A frame: the section of a hull where its longitudinal lines are cut at one x.

From the bottom up: the flat of bottom, a run of parabolas to each knuckle and to the deck side, a
rounded corner, the camber of the deck. The frame passes all points of the lines and is continuous
only: its direction jumps at each of them. These jumps, the corrugation, are told; they fall with
about the square of the spacing of waterlines on smooth data. Source: Kim & Chang, "Some
Representations of Ship Hulls by Mathematical Method for Design and Production", J. SNAK.

Examples
--------
>>> from assoc_hull.geometry.classical.frame import Frame
>>> side = [(11, 0.8), (13.5, 2.5), (14.8, 5), (15, 9)]
>>> frame = Frame.make(20.0, side, deck_side=(15, 14), flat=7.5)
>>> round(frame.area(9.0) / 2, 5), round(frame.largest_jump, 5)
(124.76609, 0.1275)
"""

from __future__ import annotations

import math
from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import integer
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.arc_area import arc_area, arc_moment
from assoc_hull.geometry.classical.camber import KINDS
from assoc_hull.geometry.classical.checks import figure, finite
from assoc_hull.geometry.classical.choices import height_of, one_of
from assoc_hull.geometry.classical.deck_corner import DeckCorner, deck_corner, deck_pieces
from assoc_hull.geometry.classical.frame_parabolas import run_bends, tangent_jumps
from assoc_hull.geometry.classical.frame_points import Run, runs_of, spacing_notes
from assoc_hull.geometry.classical.quadratics import Quadratics
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["Frame"]


@attrs.frozen(eq=False)
class Frame:
    """A frame, one side; y outward, z up, m.

    Attributes
    ----------
    x : float, m
        Where it stands.
    flat : float, m
        Half-width of the flat of bottom, 0 without one.
    runs : tuple of Run
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
    runs: tuple[Run, ...]
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
        name = f"frame x={figure(float(finite(x, 'frame', ())))}"
        one_of(camber_kind, KINDS, f"{name}: camber kind is")
        level = flat is not None
        start = keel if flat is None else flat
        foot, radius = (float(finite(each, name, ())) for each in (start, corner_radius))
        first = np.array([foot, 0.0] if level else [0.0, foot])
        rise = None if camber is None else float(finite(camber, name, ()))
        top = finite(deck_side, name, (2,))
        water = _rows(waterline_points, name)
        runs = runs_of(first, water, _rows(knuckles, name), top, name)
        notes = list(spacing_notes(water, first, top, name))
        pieces, jumps = [], []
        for number, run in enumerate(runs):
            lean = 0.0 if level and not number else None
            bend, told = run_bends(run.points, lean, name)
            pieces.append(Quadratics.over(run.points, bend))
            jumps.append(tangent_jumps(pieces[-1]))
            notes += told
        if level:
            jumps.insert(0, pieces[0].angles()[0][:1])
        side = whole = Quadratics.join(pieces)
        corner = None
        if radius:
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
        height = math.inf if level is None else height_of(level, "frame area")
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
        height = height_of(level, "frame moment")
        parts = [self.side] if self.deck is None else [self.side, self.deck]
        found = sum(each.moment_below(height) for each in parts)
        if self.corner is not None:
            found += arc_moment(self.corner.arc(), self.corner.centre, height)
        return 2.0 * found

    def half_breadth(self, level: float) -> float:
        """Give the greatest half-breadth at a height (m), m; nan where it has none."""
        found = self.side.crossings(height_of(level, "frame"))
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
    return finite(points, name, (None, 2))


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
        what = f"{name}: corner radius {figure(radius)} does not fit"
        raise GeometryError(
            what, "give a smaller radius, or waterlines that leave room below the deck",
            {"r": radius, "z": made.side_point[1]},
        )  # fmt: skip
    # The side is straight below the corner: the arc touches it there.
    short = Quadratics.over(np.array([last, made.side_point]), np.zeros(1))
    kept = Quadratics(side.y[:-1], side.z[:-1], side.length[:-1])
    return Quadratics.join([kept, short]), made
