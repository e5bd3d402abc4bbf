"""Lines cut from a mesh or digitised: one type for both, before they become a net."""

from __future__ import annotations

from collections.abc import Mapping

import attrs

from assoc_hull.arguments import instance, not_negative, shown
from assoc_hull.errors import BadInputError, UnknownNameError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.io.lines.ship_frame import ShipFrame
from assoc_hull.io.reports import OffsetReport
from assoc_hull.model.tables import Association

__all__ = [
    "ASSOCIATIONS",
    "AXES",
    "GapJoin",
    "Gaps",
    "HullSlices",
    "LinePiece",
    "SliceLine",
    "settled_gaps",
]

ASSOCIATIONS = (
    Association("boundary", "sections"),
    Association("boundary", "waterlines"),
    Association("boundary", "buttocks"),
    Association("sections", "waterlines"),
    Association("sections", "buttocks"),
    Association("waterlines", "buttocks"),
)
"""Every family generates points on every other, in both directions."""


AXES = {"sections": 0, "buttocks": 1, "waterlines": 2}
"""The coordinate that is constant on a line of each group."""


@attrs.frozen(eq=False)
class LinePiece:
    """One connected piece of a line.

    Attributes
    ----------
    points : (n, 3), m
        In order: sections upward, other lines from aft forward.
    ends : (str, str)
        What lies under its first and last point: "profile", "deck edge", "transom", another
        boundary curve, or "loose".
    closed : bool
        Whether the last point joins the first again.
    sine : (n,) or None
        Sine of the angle between plane and hull at each point, where the hull is known: by its
        inverse a distance in the plane is larger than the distance from the hull.
    owner : (n,) int or None
        The triangle that each point was cut from, where the mesh tells whence its triangles are.
    """

    points: FloatArray
    ends: tuple[str, str] = ("loose", "loose")
    closed: bool = False
    sine: FloatArray | None = None
    owner: IntArray | None = None

    def __attrs_post_init__(self) -> None:
        freeze(self.points)
        if self.sine is not None:
            freeze(self.sine)
        if self.owner is not None:
            freeze(self.owner)

    def reversed(self) -> LinePiece:
        """Give the piece the other way round."""
        sine = None if self.sine is None else self.sine[::-1].copy()
        owner = None if self.owner is None else self.owner[::-1].copy()
        return LinePiece(self.points[::-1].copy(), self.ends[::-1], self.closed, sine, owner)


@attrs.frozen(eq=False)
class SliceLine:
    """A line, in one piece or several.

    Attributes
    ----------
    group, name : str
        Such as "sections" and "ST 12.5", or "boundary" and "deck edge".
    offset : float, m
        Place of its plane; nan for a boundary curve.
    pieces : tuple of LinePiece
        Lowest first, then aftmost first.
    """

    group: str
    name: str
    offset: float
    pieces: tuple[LinePiece, ...]


@attrs.frozen
class GapJoin:
    """Two ends that were joined across a gap.

    Attributes
    ----------
    line : str
        The line.
    place : (float, float, float), m
        The middle of the gap.
    gap : float, m
        Its width.
    """

    line: str
    place: tuple[float, float, float]
    gap: float


_JOIN, _REFUSE = 0.06, 0.2


def _join(value: object) -> float:
    return not_negative(value, "join", "in Gaps")


def _refuse(value: object) -> float:
    return not_negative(value, "refuse", "in Gaps")


@attrs.frozen
class Gaps:
    """What to do about gaps between pieces.

    Attributes
    ----------
    join : float, m
        Loose ends this close are joined.
    refuse : float, m
        Loose ends farther apart than `join`, and up to this, are an error: a line that should
        chain does not. At least `join`.

    Raises
    ------
    BadInputError
        A width that is no number of 0 or more, or `refuse` less than `join`.
    """

    join: float = attrs.field(default=_JOIN, converter=_join)
    refuse: float = attrs.field(default=_REFUSE, converter=_refuse)

    @classmethod
    def at_size(cls, factor: float, join: float | None = None) -> Gaps:
        """Give those of a hull by its factor of lengths, or with a given `join` (m)."""
        width = factor * _JOIN if join is None else join
        return cls(width, max(width, factor * _REFUSE))

    def __attrs_post_init__(self) -> None:
        if self.refuse < self.join:
            raise BadInputError(
                f"refuse is {shown(self.refuse)}, less than join, {shown(self.join)}", "in Gaps",
                "give a wider gap from which on pieces are left apart",
            )  # fmt: skip


def settled_gaps(gaps: object, factor: float, where: str) -> Gaps:
    """Give what was asked for: `Gaps`, the width (m) of what is joined, or None: by the size."""
    if gaps is None or isinstance(gaps, float | int):
        return Gaps.at_size(factor, gaps)
    return instance(gaps, Gaps, "gaps", where)


@attrs.frozen(eq=False)
class HullSlices:
    """Lines of a hull as points, from a mesh or digitised.

    Attributes
    ----------
    name : str
        Of the hull.
    lines : tuple of SliceLine
        Sections, waterlines and buttocks, each group by place.
    boundaries : tuple of SliceLine
        Profile, deck edge and edge of the transom, as far as they were found.
    joins : tuple of GapJoin
        Every join across a gap.
    report : OffsetReport
        What was assumed, repaired and found suspicious.
    facets : bool
        Whether the points are corners of facets (of a mesh), whose chords lie inside the hull.
    low, high : (3,), m
        Extent of the hull.
    depth : float, m
        How deep facets of the mesh lie inside the hull, 0 for digitised lines.
    gaps : Gaps
        What was joined and what would have been refused.
    knuckles : mapping of str to (k, 3), m
        Places of a line that the file marks as knuckles.
    factor : float
        Of lengths, by the size of the hull; see `assoc_hull.tolerance.length_factor`.
    frame : ShipFrame or None
        Where the ship lay in its file, and its particulars; None where nobody looked.
    """

    name: str
    lines: tuple[SliceLine, ...]
    boundaries: tuple[SliceLine, ...]
    joins: tuple[GapJoin, ...]
    report: OffsetReport
    facets: bool
    low: FloatArray
    high: FloatArray
    depth: float = 0.0
    gaps: Gaps = attrs.field(factory=Gaps)
    knuckles: Mapping[str, FloatArray] = attrs.field(factory=dict)
    factor: float = 1.0
    frame: ShipFrame | None = None

    def __attrs_post_init__(self) -> None:
        freeze(self.low, self.high, *self.knuckles.values())

    def group(self, name: str) -> tuple[SliceLine, ...]:
        """Give the lines of a group, by place."""
        return tuple(line for line in self.lines if line.group == name)

    def boundary(self, name: str) -> SliceLine | None:
        """Give a boundary curve, None if there is none of this name."""
        return next((line for line in self.boundaries if line.name == name), None)

    def __getitem__(self, name: str) -> SliceLine:
        """Give a line by its name."""
        every = (*self.lines, *self.boundaries)
        found = next((line for line in every if line.name == name), None)
        if found is None:
            raise UnknownNameError("line", name, tuple(line.name for line in every))
        return found
