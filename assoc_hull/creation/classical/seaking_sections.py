"""Sections of a ship by boundary data, as the net and the report need them.

Examples
--------
>>> from assoc_hull.creation.classical.seaking_sections import MidshipSection
>>> from assoc_hull.creation.classical.midship import Midship
>>> round(float(MidshipSection.make(50.0, Midship(16.0, 2.0, 0.3, 2.5), 14.0).area(9.0)), 7)
281.2485565
"""

from __future__ import annotations

import math
from typing import Self

import attrs
import numpy as np

from assoc_hull.arguments import instance
from assoc_hull.creation.classical.middle_body import midship_outline
from assoc_hull.creation.classical.midship import Midship
from assoc_hull.creation.classical.outline import Outline, smooth, straight
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.arc_area import arc_area, arc_moment
from assoc_hull.geometry.classical.camber import KINDS
from assoc_hull.geometry.classical.checks import figure
from assoc_hull.geometry.classical.choices import height_of, one_of
from assoc_hull.geometry.classical.deck_corner import DeckCorner, deck_corner, deck_pieces
from assoc_hull.geometry.classical.frame import Frame
from assoc_hull.geometry.classical.quadratics import Quadratics
from assoc_hull.geometry.curves import FloatArray

__all__ = ["MidshipSection", "Section", "drawn_of", "half_area", "outline_of"]

_DRAWN = 64
"""Chords that stand for a bilge in a comparison."""


@attrs.frozen
class MidshipSection:
    """The midship section where the ship is parallel.

    Attributes
    ----------
    x : float, m
        Where it stands.
    midship : Midship
        Its shape.
    depth : float, m
        Height of the deck side.
    deck : Quadratics or None
        Camber; None of a deck straight across.
    corner : DeckCorner or None
        Between side and deck.
    """

    x: float
    midship: Midship
    depth: float
    deck: Quadratics | None
    corner: DeckCorner | None

    @classmethod
    def make(
        cls, x: float, midship: Midship, depth: float, rise: float | None = None,
        kind: str = "parabola", radius: float = 0.0,
    ) -> Self:  # fmt: skip
        """Put a deck with a rise (m; None without) and a corner radius (m, 0 without) on it.

        Raises
        ------
        GeometryError
            ``"frame x={x}: corner radius {r} does not fit"``.
        """
        instance(midship, Midship, "midship", "in a section")
        given = (depth, radius, x, 0.0 if rise is None else rise)
        height, round_off, place, crown = (height_of(each, "frame") for each in given)
        top, corner = np.array([midship.half_breadth, height]), None
        if round_off:
            name = f"frame x={figure(place)}"
            corner = deck_corner(
                midship.half_breadth, height, crown, round_off, kind=kind, name=name
            )
            if corner.side_point[1] < midship.centre[1]:
                what = f"{name}: corner radius {figure(round_off)} does not fit"
                raise GeometryError(what, "give a smaller radius", {"r": round_off})
        one_of(kind, KINDS, "camber: kind")
        bare = rise is None and corner is None
        deck = None if bare else deck_pieces(top, crown, kind, corner)
        return cls(place, midship, height, deck, corner)

    @property
    def largest_jump(self) -> float:
        """Nil: what corners it has are meant, rad."""
        return 0.0

    @property
    def notes(self) -> tuple[str, ...]:
        """None."""
        return ()

    def area(self, level: float | None = None) -> float:
        """Give the area of both sides below a height (m), m2; all of it if None."""
        height = math.inf if level is None else level
        found = self.midship.area(min(max(height, 0.0), self._side))
        if self.corner is not None:
            found += 2.0 * arc_area(self.corner.arc(), self.corner.centre, height)
        return found + (0.0 if self.deck is None else 2.0 * self.deck.area_below(height))

    def moment(self, level: float) -> float:
        """Give the moment of that area about the base, m3."""
        found = self.midship.moment(min(max(level, 0.0), self._side))
        if self.corner is not None:
            found += 2.0 * arc_moment(self.corner.arc(), self.corner.centre, level)
        return found + (0.0 if self.deck is None else 2.0 * self.deck.moment_below(level))

    @property
    def _side(self) -> float:
        return self.depth if self.corner is None else self.corner.side_point[1]

    def half_breadth(self, level: float) -> float:
        """Give the half-breadth at a height (m), m; nan where it has none."""
        if not 0.0 <= level <= self.depth:
            return math.nan
        return float(self.midship.half_breadths(level))


Section = Frame | MidshipSection
"""Either kind."""


def outline_of(section: Section) -> Outline:
    """Give a section from the centre line to the deck side as the net draws it.

    Its given points are points of the line, corners are knuckles; a flat of bottom is left
    horizontally. Between points the kernel's smooth curve runs in the place of parabolas.
    """
    if isinstance(section, MidshipSection):
        return midship_outline(section.midship, section.depth)
    pieces = [straight((0.0, 0.0), (section.flat, 0.0))]
    for number, run in enumerate(section.runs):
        level = number == 0 and section.level_start
        if len(run.points) == 2 and not level:
            pieces.append(straight(*run.points))
        else:
            pieces.append(smooth(run.points, start=0.0 if level else None))
    return Outline.of(pieces)


def drawn_of(section: Section) -> FloatArray:
    """Give points close together on the definition's curve, (n, 2), m."""
    if isinstance(section, Frame):
        return section.drawn()
    outline = midship_outline(section.midship, section.depth)
    bilge = section.midship.bilge()
    if bilge is None:
        return outline.points
    along = np.linspace(0.0, float(bilge.length[0]), _DRAWN + 1)
    return np.concatenate([outline.points, bilge.at(np.zeros(len(along), np.int64), along)])


def half_area(section: Section) -> float:
    """Give the area of one side up to the deck side, without camber and corner, m2."""
    if isinstance(section, MidshipSection):
        return 0.5 * section.midship.area(section.depth)
    return section.side_area
