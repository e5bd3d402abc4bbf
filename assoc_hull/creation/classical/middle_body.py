"""The midship section of a few numbers, and a parallel middle body that has it throughout.

`Midship` is made of half-breadth, flat of bottom, rise of floor and bilge radius, with exact area
and moment; SEAKING takes it for its parallel part. `MiddleBody` is the simplest of classical
definitions: its net can be checked against an exact volume. y outward from the centre line, z up
from the base line, m.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import instance, positive
from assoc_hull.creation.classical.line_outline import PlaneOutline, circular_piece, straight_piece
from assoc_hull.creation.classical.report import ClassicalReport, ReportFigure, measure_net
from assoc_hull.errors import BadInputError, GeometryError
from assoc_hull.geometry.classical.checked_input import digits, finite_array, within_range
from assoc_hull.geometry.classical.circular_arcs import PlaneArcs, arc_area, arc_moment
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.attached_body import AttachedBody
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.tables import HullState, Particulars

__all__ = [
    "MiddleBody",
    "Midship",
    "midship_outline",
]

# --------------------------------------------------------------------------------------
# The midship section.
#
# From the centre line the section is level to the edge of the flat, rises straight to the bilge,
# turns on a circle that floor and side touch, and goes straight up. Source: Kim & Chang, "Some
# Representations of Ship Hulls by Mathematical Method for Design and Production", J. SNAK; the rise
# of floor is measured at the side.

_HIGHEST = 1e6
"""m: no draught reaches up to here."""


def _number(value: object) -> float:
    return float(finite_array(value, "midship", ()))  # type: ignore[arg-type]


@attrs.frozen
class Midship:
    """A midship section; y outward from the centre line, z up from the base line, m.

    Attributes
    ----------
    half_breadth : float, m
        Of the upright side, above 0.
    flat : float, m
        Half-width of the flat of bottom, from 0 to below the half-breadth.
    rise : float, m
        Rise of floor at the side, not below 0.
    radius : float, m
        Of the bilge; 0 is a chine.
    depth : float or None, m
        Height of the side, if the bilge is to be checked to end below it.

    Raises
    ------
    GeometryError
        ``"midship: b={b} must lie in [0, a)"``, ``"midship: R={R} exceeds the limit {Rmax}"``
        where the bilge would pass the edge of the flat, ``"midship: bilge centre z={zc} above
        the side height {D}"``, and a half-breadth, rise or radius of no section.
    """

    half_breadth: float = attrs.field(converter=_number)
    flat: float = attrs.field(converter=_number)
    rise: float = attrs.field(converter=_number)
    radius: float = attrs.field(converter=_number)
    depth: float | None = attrs.field(
        default=None, converter=attrs.converters.optional(_number)
    )  # fmt: skip

    def __attrs_post_init__(self) -> None:
        a, b = self.half_breadth, self.flat
        _least("a", a, above=True)
        if not 0.0 <= b < a:
            raise GeometryError(
                f"midship: b={digits(b)} must lie in [0, a)",
                f"give a flat narrower than the half-breadth of {digits(a)}", {"b": b, "a": a},
            )  # fmt: skip
        _least("c", self.rise)
        _least("R", self.radius)
        if self.radius > self.most_radius * (1.0 + 1e-12):
            raise GeometryError(
                f"midship: R={digits(self.radius)} exceeds the limit {digits(self.most_radius)}",
                "give a smaller radius: the bilge would pass the edge of the flat",
                {"R": self.radius, "Rmax": self.most_radius},
            )
        if self.depth is not None and self.centre[1] > self.depth:
            raise GeometryError(
                f"midship: bilge centre z={digits(self.centre[1])} above the side height "
                f"{digits(self.depth)}",
                "give a smaller radius or rise", {"zc": self.centre[1], "D": self.depth},
            )  # fmt: skip

    @property
    def floor_angle(self) -> float:
        """Of the floor above the horizontal, rad."""
        return math.atan2(self.rise, self.half_breadth - self.flat)

    @property
    def most_radius(self) -> float:
        """The radius at which the bilge begins at the edge of the flat, m."""
        return (self.half_breadth - self.flat) / (1.0 - math.sin(self.floor_angle))

    @property
    def centre(self) -> tuple[float, float]:
        """Of the bilge circle, (y, z), m."""
        slope, y = self.floor_angle, self.half_breadth - self.radius
        z = (y - self.flat) * math.tan(slope) + self.radius / math.cos(slope)
        return y, z

    @property
    def floor_point(self) -> tuple[float, float]:
        """Where the bilge leaves the floor, (y, z), m."""
        (y, z), slope = self.centre, self.floor_angle
        return y + self.radius * math.sin(slope), z - self.radius * math.cos(slope)

    @property
    def side_point(self) -> tuple[float, float]:
        """Where the bilge comes to the side, (y, z), m."""
        return self.half_breadth, self.centre[1]

    def area(self, draught: float) -> float:
        """Give the area of both sides below a draught (m), m2.

        Raises
        ------
        GeometryError
            A draught below the base line.
        """
        level = float(
            within_range(finite_array(draught, "midship area", ()), "midship area", 0.0, _HIGHEST)
        )
        a, b, top = self.half_breadth, self.flat, self.centre[1]
        if level >= top:
            # The rectangle less the triangle below the floor, and less what the bilge cuts off.
            turn = 0.5 * math.pi - self.floor_angle
            corner = self.radius**2 * (math.tan(0.5 * turn) - 0.5 * turn)
            return 2.0 * (a * level - 0.5 * self.rise * (a - b) - corner)
        floor = min(level, self.floor_point[1])
        width = b + (floor / math.tan(self.floor_angle) if self.rise else 0.0)
        bilge = self.bilge()
        arc = 0.0 if bilge is None else arc_area(bilge, self.centre, level)
        return (b + width) * floor + 2.0 * arc

    def moment(self, draught: float) -> float:
        """Give the moment of that area about the base line, m3."""
        level = float(
            within_range(finite_array(draught, "midship area", ()), "midship area", 0.0, _HIGHEST)
        )
        top, bilge = self.centre[1], self.bilge()
        floor = min(level, self.floor_point[1])
        lean = 1.0 / math.tan(self.floor_angle) if self.rise else 0.0
        found = self.flat * floor**2 / 2.0 + lean * floor**3 / 3.0
        if bilge is not None:
            found += arc_moment(bilge, self.centre, level)
        if level > top:
            found += 0.5 * self.half_breadth * (level**2 - top**2)
        return 2.0 * found

    def bilge(self) -> PlaneArcs | None:
        """Give the bilge, from the floor up; None of a chine."""
        if self.radius == 0.0:
            return None
        turn = 0.5 * math.pi - self.floor_angle
        return PlaneArcs.make(
            [self.floor_point], [self.floor_angle], [1.0 / self.radius], [self.radius * turn]
        )

    def half_breadths(self, z: ArrayLike) -> FloatArray:
        """Give half-breadths (m) at heights (m) not below 0, of the same shape.

        At 0 it is the outer edge of what is level there.

        Raises
        ------
        GeometryError
            A height below the base line.
        """
        height = within_range(z, "midship", 0.0, _HIGHEST)
        (yc, zc), slope = self.centre, self.floor_angle
        low = self.floor_point[1]
        with np.errstate(divide="ignore", invalid="ignore"):
            floor = self.flat + height / math.tan(slope) if slope else np.full_like(height, yc)
        reach = np.sqrt(np.maximum(self.radius**2 - (zc - height) ** 2, 0.0))
        found = np.where(height < low, floor, np.where(height < zc, yc + reach, self.half_breadth))
        return np.asarray(found)


def _least(name: str, value: float, *, above: bool = False) -> None:
    if value < 0.0 or (above and value == 0.0):
        rule = "above 0" if above else "0 or more"
        raise GeometryError(
            f"midship: {name}={digits(value)} must be {rule}", f"give {rule}", {name: value}
        )


# --------------------------------------------------------------------------------------
# The middle body: its section over a length, between flat ends.


def midship_outline(midship: Midship, depth: float) -> PlaneOutline:
    """Give a midship section up to a depth (m), from the centre line.

    Examples
    --------
    >>> from assoc_hull.creation.classical.middle_body import midship_outline
    >>> from assoc_hull.creation.classical.middle_body import Midship
    >>> chine = midship_outline(Midship(16.0, 0.0, 0.0, 0.0), 10.0)
    >>> chine.points.tolist(), chine.kind.tolist()
    ([[0.0, 0.0], [16.0, 0.0], [16.0, 10.0]], [0, 2, 0])
    """
    instance(midship, Midship, "midship", "in its outline")
    positive(depth, "depth", "in the outline of a midship section")
    bilge = midship.bilge()
    pieces = [
        straight_piece((0.0, 0.0), (midship.flat, 0.0)),
        straight_piece((midship.flat, 0.0), midship.floor_point),
        *([] if bilge is None else [circular_piece(bilge)]),
        straight_piece(midship.side_point, (midship.half_breadth, depth)),
    ]
    return PlaneOutline.of(pieces)


@attrs.frozen(kw_only=True)
class MiddleBody:
    """A middle body.

    Attributes
    ----------
    midship : Midship
        Its section.
    length, depth, draught : float, m
        Length of the body, height of its side, and the draught that its volume is reported for.
    stations : int
        Sections between the two ends.
    name : str
        Of the hull.
    """

    midship: Midship = attrs.field(kw_only=False)
    length: float
    depth: float
    draught: float
    stations: int = 5
    name: str = "Middle body"

    def __attrs_post_init__(self) -> None:
        instance(self.midship, Midship, "midship", "in a middle body")
        for each in ("length", "depth", "draught"):
            positive(getattr(self, each), each, "in a middle body")
        if self.midship.centre[1] >= min(self.draught, self.depth) or self.draught > self.depth:
            what = f"draught {self.draught:g} m, depth {self.depth:g} m"
            raise BadInputError(what, "in a middle body", "let bilge < draught <= depth")

    @property
    def kind(self) -> str:
        """SEAKING: it is the middle of such a definition."""
        return "SEAKING"

    @property
    def particulars(self) -> Particulars:
        """Dimensions; the deck is closed."""
        breadth = 2.0 * self.midship.half_breadth
        return Particulars(
            self.name, self.length, breadth, self.depth, self.draught, "closed"
        )  # fmt: skip

    @property
    def notes(self) -> tuple[str, ...]:
        """None."""
        return ()

    @property
    def cuts(self) -> Mapping[str, Sequence[float]]:
        """Four waterlines and three buttocks."""
        top, half = self.depth, self.midship.half_breadth
        return {
            "waterlines": (0.25 * self.midship.centre[1], *(top * np.array([0.3, 0.5, 0.8]))),
            "buttocks": tuple((half * np.array([0.25, 0.5, 0.8])).tolist()),
        }

    def volume(self, draught: float) -> float:
        """Give the volume below a draught (m), m3, exactly."""
        return self.midship.area(draught) * self.length

    def lines(self) -> tuple[LineSource, ...]:
        """Give both ends, keel, deck edge, the edges of flat and bilge, and the sections."""
        outline = midship_outline(self.midship, self.depth)
        ends = [
            outline.boundary("aft end", 0, 0.0), outline.boundary("fore end", 0, self.length)
        ]  # fmt: skip
        lower, flat = self.midship.floor_point, BoundaryKind.FLAT
        upper = self.midship.side_point
        corner = BoundaryKind.KNUCKLE
        along = [
            self._along("profile", (0.0, 0.0), BoundaryKind.END, 1),
            self._along("deck edge", (self.midship.half_breadth, self.depth), BoundaryKind.END, 2),
        ]
        if self.midship.flat and self.midship.rise:
            along.append(self._along("flat of bottom", (self.midship.flat, 0.0), corner))
        if self.midship.radius:
            along += [
                self._along("bilge below", lower, flat),
                self._along("bilge above", upper, flat),
            ]
        else:
            along.append(self._along("chine", upper, corner))
        places = np.linspace(0.0, self.length, self.stations + 2)[1:-1]
        return (*ends, *along, *(outline.section(f"FR {x:g}", x) for x in places.tolist()))

    def _along(
        self, name: str, yz: tuple[float, float], kind: BoundaryKind, axis: int | None = None
    ) -> LineSource:
        points = [[0.0, *yz], [self.length, *yz]]
        plane = None if axis is None else (np.eye(3)[axis], points[0][axis])
        return LineSource.make("boundary", name, points, plane=plane, boundary=kind)

    def bodies(self) -> tuple[AttachedBody, ...]:
        """Give what stands beside the net: nothing."""
        return ()

    def report(self, state: HullState | None = None) -> ClassicalReport:
        """Give volume and its centre below the draught, beside those of a net if one is given."""
        net = None if state is None else measure_net(state, self.draught)
        volume = self.volume(self.draught)
        figures = (
            ReportFigure("volume", volume, "m3", None if net is None else net.volume),
            ReportFigure(
                "centre of volume, x", 0.5 * self.length, "m", None if net is None else net.x
            ),
        )
        return ClassicalReport(self.kind, self.name, figures, self.notes)
