"""A hull of Lewis sections: breadth, draught and area coefficient along the ship, nothing else.

Between upright ends every section below the waterline is the image of a circle by two terms; above
it sides are upright. Volume and centre follow from the areas alone.

Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK, Table 1 (Tuck and von Kerczek: conformal sections along the ship).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.creation.classical.report import (
    ClassicalReport,
    DefinedSection,
    ReportFigure,
    departures,
    measure_net,
)
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import digits, numbers
from assoc_hull.geometry.classical.conformal_sections import ConformalSections, lewis_sections
from assoc_hull.geometry.curves import EndKind, FloatArray, PointKind, freeze
from assoc_hull.model.attached_body import AttachedBody
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.tables import Ends, HullState, Particulars

__all__ = ["LewisHull"]

_LEVEL = ((0.0, 1.0, 0.0), (0.0, 0.0, 0.0))
_HALVINGS = 52
"""Of the angle, until the level is reached to the last bits."""


@attrs.frozen(eq=False)
class LewisHull:
    """A hull of Lewis sections.

    Attributes
    ----------
    x : (n,), m
        Stations from AP, rising; at the first and last the hull ends upright, without breadth.
    half_breadth : (n,), m
        At the waterline; 0 at both ends.
    coefficient : (n,)
        Areas by breadth and draught; those of both ends are not used.
    draught, depth : float, m
    levels : tuple of float, m
        Of waterlines below the draught, which is one besides.
    name : str
    points : int
        Of a section below the waterline.
    """

    x: FloatArray
    half_breadth: FloatArray
    coefficient: FloatArray
    draught: float
    depth: float
    levels: tuple[float, ...]
    name: str = "Lewis hull"
    points: int = 25

    def __attrs_post_init__(self) -> None:
        freeze(self.x, self.half_breadth, self.coefficient)

    @classmethod
    def make(
        cls, x: ArrayLike, half_breadth: ArrayLike, coefficient: ArrayLike, draught: float,
        depth: float, levels: ArrayLike = (), name: str = "Lewis hull",
    ) -> LewisHull:  # fmt: skip
        """Check what is given; arguments as the attributes.

        Raises
        ------
        GeometryError
            Stations that do not rise, ends with breadth, a section that is not simple or that
            swells below the base line, levels outside the draught.

        Examples
        --------
        >>> import numpy as np
        >>> from assoc_hull.creation.classical.lewis_hull import LewisHull
        >>> x = np.linspace(0.0, 100.0, 11)
        >>> beam = 8.0 * (1.0 - (x / 50.0 - 1.0) ** 4)
        >>> LewisHull.make(x, beam, np.full(11, 0.9), 6.0, 9.0).areas.max().round(6).item()
        86.4
        """
        stations = numbers(x, "Lewis hull", (None,))
        beams, full = (
            numbers(each, "Lewis hull", (len(stations),)) for each in (half_breadth, coefficient)
        )
        deep, side = numbers([draught, depth], "Lewis hull", (2,)).tolist()
        heights = numbers(levels, "Lewis hull", (None,))
        if len(stations) < 5 or not (np.diff(stations) > 0.0).all():
            what = f"Lewis hull: {len(stations)} stations that do not all rise"
            raise GeometryError(what, "give five or more, from aft forward")
        if beams[0] or beams[-1]:
            what = f"Lewis hull: half-breadths {digits(beams[0])}, {digits(beams[-1])} at the ends"
            raise GeometryError(what, "let them be 0")
        if not 0.0 < deep < side or ((heights <= 0.0) | (heights >= deep)).any():
            rest = f"depth {digits(side)}, levels {heights.tolist()}"
            what = f"Lewis hull: draught {digits(deep)}, {rest}"
            raise GeometryError(what, "let levels lie below the draught, that below the depth")
        found = cls(stations, beams, full, deep, side, tuple(heights.tolist()), str(name))
        low = found.offsets[..., 1].min(axis=1)
        if low.min() < -1e-9 * deep:
            worst = int(np.argmin(low))
            place = digits(stations[worst + 1])
            what = f"Lewis hull: section at x={place} swells {digits(-low[worst])} m below the base"
            told = {"x": float(stations[worst + 1]), "below": float(-low[worst])}
            raise GeometryError(what, "take a smaller area coefficient there", told)
        return found

    @cached_property
    def sections(self) -> ConformalSections:
        """Those between the ends."""
        inner = slice(1, -1)
        deep = np.full(len(self.x) - 2, self.draught)
        return lewis_sections(self.half_breadth[inner], deep, self.coefficient[inner])

    @property
    def areas(self) -> FloatArray:
        """Of whole sections to the draught, (n,), m2: sigma B T."""
        return np.asarray(2.0 * self.coefficient * self.half_breadth * self.draught)

    @cached_property
    def offsets(self) -> FloatArray:
        """Half-breadth and height above base of each section to the waterline, (n - 2, m, 2), m."""
        return self._above_base(self.sections.at(np.linspace(0.0, 0.5 * np.pi, self.points)))

    def _above_base(self, places: FloatArray) -> FloatArray:
        found: FloatArray = places * [1.0, -1.0] + [0.0, self.draught]
        # The terms add up to the draught only by rounding.
        found[:, 0] = 0.0
        return found

    def at_level(self, height: float) -> FloatArray:
        """Give half-breadths at a height above base, from 0 to the draught, (n,), m."""
        low, high = np.zeros(len(self.sections)), np.full(len(self.sections), 0.5 * np.pi)
        rows = np.arange(len(low))
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            under = self.draught - self.sections.at(middle)[rows, rows, 1] < height
            low, high = np.where(under, middle, low), np.where(under, high, middle)
        inner = self.sections.at(0.5 * (low + high))[rows, rows, 0]
        return np.concatenate([[0.0], inner, [0.0]])

    @property
    def kind(self) -> str:
        """LEWIS."""
        return "LEWIS"

    @property
    def particulars(self) -> Particulars:
        """Dimensions; the deck is closed."""
        beam, length = 2.0 * float(self.half_breadth.max()), float(self.x[-1] - self.x[0])
        return Particulars(self.name, length, beam, self.depth, self.draught, "closed")

    @property
    def notes(self) -> tuple[str, ...]:
        """None."""
        return ()

    @property
    def cuts(self) -> Mapping[str, Sequence[float]]:
        """No further planes."""
        return {}

    def lines(self) -> tuple[LineSource, ...]:
        """Give profile, deck edge, sections and waterlines."""
        first, last = float(self.x[0]), float(self.x[-1])
        corners = [[first, 0, self.depth], [first, 0, 0], [last, 0, 0], [last, 0, self.depth]]
        corner = int(PointKind.KNUCKLE)
        profile = LineSource.make(
            "boundary", "profile", corners, plane=((0, 1, 0), 0.0), kind=[0, corner, corner, 0],
            boundary=BoundaryKind.END,
        )  # fmt: skip
        deck = LineSource.make(
            "boundary", "deck edge", self._level(self.depth, self.half_breadth),
            plane=((0, 0, 1), self.depth), boundary=BoundaryKind.END,
        )  # fmt: skip
        names = zip(self.x[1:-1].tolist(), self.offsets, strict=True)
        levels = [
            LineSource.make("waterlines", f"WL {h:g}", self._level(h, self.at_level(h)))
            for h in self.levels
        ]
        design = self._level(self.draught, self.half_breadth)
        levels.append(LineSource.make("waterlines", f"WL {self.draught:g}", design))
        return (profile, deck, *(self._section(x, places) for x, places in names), *levels)

    def _level(self, height: float, y: FloatArray) -> FloatArray:
        return np.column_stack([self.x, y, np.full(len(y), height)])

    def _section(self, x: float, places: FloatArray) -> LineSource:
        """Run from the keel, level there, up; a tangent point where the upright side begins."""
        top = [[places[-1, 0], self.depth]]
        points = np.vstack([places, top])
        kind = np.zeros(len(points), int)
        kind[-2] = PointKind.TANGENT
        upward = np.where((kind == PointKind.TANGENT)[:, None], [0.0, 0.0, 1.0], 0.0)
        return LineSource.make(
            "sections", f"ST {x:g}", np.column_stack([np.full(len(points), x), points]),
            kind=kind.tolist(), direction=upward, ends=Ends((int(EndKind.TANGENT), 0), _LEVEL),
        )  # fmt: skip

    def bodies(self) -> tuple[AttachedBody, ...]:
        """Give what stands beside the net: nothing."""
        return ()

    def report(self, state: HullState | None = None) -> ClassicalReport:
        """Give volume, its centre and the waterplane, beside those of a net if one is given.

        Areas and breadths at the stations are integrated as natural cubic splines, as the lines
        of the net run.
        """
        from scipy.interpolate import CubicSpline

        net = None if state is None else measure_net(state, self.draught)
        ends = float(self.x[0]), float(self.x[-1])
        volume, moment, plane = (
            float(CubicSpline(self.x, each).integrate(*ends))
            for each in (self.areas, self.areas * self.x, 2.0 * self.half_breadth)
        )
        figures = (
            ReportFigure("volume", volume, "m3", None if net is None else net.volume),
            ReportFigure(
                "centre of volume, x", moment / volume, "m", None if net is None else net.x
            ),
            ReportFigure("area of the waterplane", plane, "m2", None if net is None else net.area),
        )
        away = () if state is None else departures(state, self._curves())
        return ClassicalReport(self.kind, self.name, figures, self.notes, away)

    def _curves(self) -> tuple[DefinedSection, ...]:
        """Give the sections below the waterline, closely, with the half areas of whole ones."""
        dense = self._above_base(self.sections.at(np.linspace(0.0, 0.5 * np.pi, 8 * self.points)))
        over = (self.depth - self.draught) * self.half_breadth[1:-1]
        half = 0.5 * self.areas[1:-1] + over
        return tuple(
            DefinedSection(f"ST {x:g}", np.column_stack([np.full(len(places), x), places]), area)
            for x, places, area in zip(self.x[1:-1].tolist(), dense, half.tolist(), strict=True)
        )
