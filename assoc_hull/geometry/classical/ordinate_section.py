"""A section of a ship given directly: heights on buttocks below, half-breadths on waterlines above.

The bottom part is given by heights at equal steps of y from the centre line, the main part by
half-breadths at equal steps of z from the top of the bottom part. Both are parabolas on pairs of
steps, so that areas are those of Simpson's rule; a straight line joins them, a parabola is the
camber. The curve bends at every second ordinate; it is not fair, and is not said to be.
Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK.

Examples
--------
>>> from assoc_hull.geometry.classical.ordinate_section import OrdinateSection
>>> section = OrdinateSection.make(
...     hb=0.9, sb=3, sw=2, hd=12.4, bd=15.2, cam=0.4, zb=[0, 0.02, 0.10, 0.31, 0.80],
...     yw=[12.3, 14.2, 14.8, 15, 15.1, 15.2, 15.2],
... )
>>> round(section.area, 7), section.form
(363.0914583, 'bottom+main+camber')
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checks import figure, finite
from assoc_hull.geometry.classical.ordinate_area import area_below
from assoc_hull.geometry.classical.ordinate_checks import (
    FORMS,
    check_section,
    notes_of_section,
    read_sizes,
)
from assoc_hull.geometry.classical.ordinate_outline import outline_steps
from assoc_hull.geometry.classical.paired_parabolas import PairedParabolas
from assoc_hull.geometry.curves import FloatArray

__all__ = ["FORMS", "OrdinateSection"]


@attrs.frozen(eq=False)
class OrdinateSection:
    """A section: eight values, heights on buttocks, half-breadths on waterlines.

    Attributes
    ----------
    hb : float, m
        Height of the bottom part: of the lowest waterline of the main part.
    sb, sw : float, m
        Spacing of buttocks and of waterlines.
    hd, bd : float, m
        Height and half-breadth of the deck side.
    cam : float, m
        Camber, from the deck side up to the centre line.
    nb, nw : int
        How many buttocks off the centre line, and waterlines.
    form : str
        One of `FORMS`.
    bottom : PairedParabolas or None
        Height over y from 0 to nb sb; None where there is no part on buttocks.
    side : PairedParabolas
        Half-breadth over z from the lowest waterline up, beyond the deck side.
    keel : float, m
        Height of the lowest place on the centre line.
    notes : tuple of str
        What is unusual, a sentence each.
    """

    hb: float
    sb: float
    sw: float
    hd: float
    bd: float
    cam: float
    nb: int
    nw: int
    form: str
    bottom: PairedParabolas | None
    side: PairedParabolas
    keel: float
    notes: tuple[str, ...]

    @classmethod
    def make(
        cls,
        *,
        hb: float,
        sb: float,
        sw: float,
        hd: float,
        bd: float,
        cam: float,
        zb: ArrayLike,
        yw: ArrayLike,
        nb: int | None = None,
        nw: int | None = None,
        form: str | None = None,
    ) -> Self:
        """Check what is given, and make the section.

        Parameters
        ----------
        hb, sb, sw, hd, bd, cam : float, m
            As the attributes; heights from the base line.
        zb : (nb + 1,), m
            Heights at y = 0, sb ... nb sb. Without buttocks the height of the keel alone, or
            nothing, where the main part begins at the keel.
        yw : (nw,), m
            Half-breadths at z = hb + k sw; without main part at z = zb[0] + k sw.
        nb, nw : int or None
            Counts; as many as are given if None.
        form : str or None
            One of `FORMS`. If None: with buttocks the first, else without a main part if
            hb >= hd.

        Raises
        ------
        GeometryError
            Numbers of which no section can be made.
        """
        sizes = read_sizes(hb, sb, sw, hd, bd, cam)
        heights, breadths = finite(zb, "section", (None,)), finite(yw, "section", (None,))
        buttocks = max(len(heights) - 1, 0) if nb is None else nb
        waterlines = len(breadths) if nw is None else nw
        shape = check_section(sizes, heights, breadths, (buttocks, waterlines), form)
        if not len(heights):
            heights = np.array([sizes.hb])
        bottom = None
        if buttocks:
            bottom = PairedParabolas.make("section bottom", 0.0, sizes.sb, heights)
        foot = float(heights[0]) if shape == FORMS[2] else sizes.hb
        side = PairedParabolas.make("section side", foot, sizes.sw, breadths)
        notes = notes_of_section(sizes, bottom, side)
        return cls(
            sizes.hb, sizes.sb, sizes.sw, sizes.hd, sizes.bd, sizes.cam, buttocks, waterlines,
            shape, bottom, side, float(heights[0]), notes,
        )  # fmt: skip

    @property
    def bottom_area(self) -> float:
        """Area of one side below hb, up to the closing line; 0 without buttocks; m2."""
        if self.bottom is None:
            return 0.0
        edge, close = self.bottom.last, self.hb - float(self.bottom.values[-1])
        under = self.hb * edge - self.bottom.integral()
        return under + 0.5 * close * (float(self.side.values[0]) - edge)

    @property
    def main_area(self) -> float:
        """Area of one side from the lowest waterline to the deck side, m2."""
        return self.side.integral(None, self.hd)

    @property
    def camber_area(self) -> float:
        """Area of one side above the deck side, m2."""
        return 2.0 * self.cam * self.bd / 3.0

    @property
    def area(self) -> float:
        """Of both sides, camber included, m2."""
        return 2.0 * (self.bottom_area + self.main_area + self.camber_area)

    @property
    def moment(self) -> float:
        """Area of both sides times the height of its centroid, m3."""
        camber = self.camber_area * self.hd + 4.0 * self.cam**2 * self.bd / 15.0
        return 2.0 * (self._bottom_moment() + self.side.moment(None, self.hd) + camber)

    def _bottom_moment(self) -> float:
        """Give the first moment of one side below hb about the base line, m3."""
        if self.bottom is None:
            return 0.0
        _, z, weight = self.bottom.quadrature()
        foot, wide = float(self.bottom.values[-1]), float(self.side.values[0]) - self.bottom.last
        close = 0.5 * wide * (self.hb - foot) * (2.0 * self.hb + foot) / 3.0
        return 0.5 * float(weight @ (self.hb**2 - z * z)) + close

    @property
    def deck_breadth(self) -> float:
        """Half-breadth of the main part at the deck side, m; `bd` is what was given for it."""
        return float(self.side.at(self.hd))

    def half_breadth(self, z: ArrayLike) -> FloatArray:
        """Give y of the main part at heights from its lowest waterline to the last, m.

        Raises
        ------
        GeometryError
            A height outside.
        """
        return self.side.at(z)

    def height(self, y: ArrayLike) -> FloatArray:
        """Give z of the bottom part at places from 0 to nb sb, m.

        Raises
        ------
        GeometryError
            A place outside, or no bottom part on buttocks.
        """
        if self.bottom is None:
            what = f"section: no buttocks are given in the form {self.form}"
            raise GeometryError(what, "ask for its half-breadths", {"form": self.form})
        return self.bottom.at(y)

    def camber(self, y: ArrayLike) -> FloatArray:
        """Give z of the deck at half-breadths within `bd`, m: a parabola.

        Raises
        ------
        GeometryError
            ``"camber: |y|={y} exceeds half-breadth {b}"``.
        """
        across = np.abs(finite(y, "camber", None))
        if (across > self.bd * (1.0 + 1e-12)).any():
            worst = float(across.max())
            what = f"camber: |y|={figure(worst)} exceeds half-breadth {figure(self.bd)}"
            raise GeometryError(what, "ask within the deck", {"y": worst, "b": self.bd})
        part = across / self.bd if self.bd else across
        return np.asarray(self.hd + self.cam * (1.0 - part * part))

    def area_below(self, z: float) -> float:
        """Give the area of both sides below a height up to the deck side, m2; exact.

        Raises
        ------
        GeometryError
            A height above the deck side.
        """
        level = float(finite(z, "section", ()))
        if level > self.hd:
            what = f"section: z={figure(level)} above the deck side {figure(self.hd)}"
            raise GeometryError(what, "ask below the deck", {"z": level, "hd": self.hd})
        return 2.0 * area_below(self.bottom, self.side, level, self.hb)

    def steps(self) -> FloatArray:
        """Give the curve from one given point to the next; see `outline_steps`."""
        return outline_steps(self.bottom, self.side, self.hd, self.keel)

    def outline(self) -> FloatArray:
        """Give the given points from the centre line up to the deck side, (n, 2) as y, z in m.

        The last is where the main part meets the deck side, not the half-breadth `bd`.
        """
        steps = self.steps()
        return np.concatenate([steps[:, 0], steps[-1].sum(axis=0)[None]])
