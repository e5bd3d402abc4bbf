"""A parallel middle body: one midship section over a length, between flat ends.

The thinnest of classical definitions, and the one whose net has an exact volume to be held
against.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import attrs
import numpy as np

from assoc_hull.arguments import instance, positive
from assoc_hull.creation.classical.midship import Midship
from assoc_hull.creation.classical.outline import Outline, circular, straight
from assoc_hull.creation.classical.report import ClassicalReport, Figure, measure_net
from assoc_hull.errors import BadInputError
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.state import HullState, Particulars

__all__ = ["MiddleBody", "midship_outline"]


def midship_outline(midship: Midship, depth: float) -> Outline:
    """Give a midship section up to a depth (m), from the centre line.

    Examples
    --------
    >>> from assoc_hull.creation.classical.middle_body import midship_outline
    >>> from assoc_hull.creation.classical.midship import Midship
    >>> chine = midship_outline(Midship(16.0, 0.0, 0.0, 0.0), 10.0)
    >>> chine.points.tolist(), chine.kind.tolist()
    ([[0.0, 0.0], [16.0, 0.0], [16.0, 10.0]], [0, 2, 0])
    """
    instance(midship, Midship, "midship", "in its outline")
    positive(depth, "depth", "in the outline of a midship section")
    bilge = midship.bilge()
    pieces = [
        straight((0.0, 0.0), (midship.flat, 0.0)),
        straight((midship.flat, 0.0), midship.floor_point),
        *([] if bilge is None else [circular(bilge)]),
        straight(midship.side_point, (midship.half_breadth, depth)),
    ]
    return Outline.of(pieces)


@attrs.frozen(kw_only=True)
class MiddleBody:
    """A middle body.

    Attributes
    ----------
    midship : Midship
        Its section.
    length, depth, draught : float, m
        Of the body, of its side, and to which its volume is told.
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

    def report(self, state: HullState | None = None) -> ClassicalReport:
        """Give volume and its centre below the draught, beside those of a net if one is given."""
        net = None if state is None else measure_net(state, self.draught)
        volume = self.volume(self.draught)
        figures = (
            Figure("volume", volume, "m3", None if net is None else net.volume),
            Figure("centre of volume, x", 0.5 * self.length, "m", None if net is None else net.x),
        )
        return ClassicalReport(self.kind, self.name, figures, self.notes)
