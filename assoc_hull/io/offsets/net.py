"""From a table of offsets to a net: lines, boundary curves, adoption."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.edit.adoption.adopt import adopt
from assoc_hull.edit.adoption.report import AdoptionReport
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import CurveData, FloatArray, PointKind
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.plane_intersections import meet_planes
from assoc_hull.io.offsets.table import OffsetTable
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.state import Association, HullState, Particulars
from assoc_hull.tolerance import Tolerances

__all__ = ["ASSOCIATIONS", "Completion", "net_from_offsets"]

ASSOCIATIONS = (
    Association("boundary", "sections"),
    Association("boundary", "waterlines"),
    Association("boundary", "buttocks"),
    Association("sections", "waterlines"),
    Association("sections", "buttocks"),
    Association("waterlines", "buttocks"),
)
"""Every family generates points on every other, in both directions."""


@attrs.frozen(eq=False)
class Completion:
    """What a table of offsets leaves open and a net needs.

    Attributes
    ----------
    profile : (n, 3), m
        Centre-line profile, from the stern at the deck round to the stem at the deck.
    profile_kind : (n,) int8
        A `PointKind` per point.
    stern, stem : (w,), m
        Where each waterline of the table ends.
    bottom : (n, 3), m, or None
        Border of the flat of bottom, from aft.
    side : (n, 3), m, or None
        Border of the flat of side, from the deck aft round to the deck forward.
    """

    profile: FloatArray
    profile_kind: np.typing.NDArray[np.int8]
    stern: FloatArray
    stem: FloatArray
    bottom: FloatArray | None
    side: FloatArray | None


def particulars_of_table(table: OffsetTable, deck: str = "open") -> Particulars:
    """Give the particulars that a table tells, and the deck, which no table tells.

    Parameters
    ----------
    table : OffsetTable
        Any table; depth and draught are its highest waterline where it tells none.
    deck : {"open", "closed"}
        Closed: there is a deck between the deck edges.

    Returns
    -------
    Particulars

    Raises
    ------
    BadInputError
        Another word for the deck, or dimensions that are not positive.
    """
    top = float(table.z[-1])
    return Particulars(
        table.name, table.length, table.breadth, table.depth or top, table.draught or top, deck
    )


def net_from_offsets(
    table: OffsetTable,
    completion: Completion,
    particulars: Particulars | None = None,
    tolerances: Tolerances | None = None,
) -> tuple[HullState, AdoptionReport]:
    """Adopt a table of offsets as a net of sections, waterlines and boundary curves.

    The highest waterline of the table becomes the deck edge, the lowest, at the base line,
    the border of the flat of bottom: their planes touch the hull and cut nothing.

    Parameters
    ----------
    table : OffsetTable
        Offsets in metres.
    completion : Completion
        Profile, ends and flats.
    particulars : Particulars or None
        From the table if None.
    tolerances : Tolerances or None
        Defaults if None.

    Returns
    -------
    HullState, AdoptionReport

    Raises
    ------
    BadInputError
        A table without a waterline between the lowest and the highest.
    """
    if len(table.z) < 3:
        raise BadInputError(
            f"{len(table.z)} waterlines", f"table {table.name!r}", "give three or more"
        )
    ship = particulars or particulars_of_table(table)
    flats = _Flats(completion.side, table)
    sources = _boundaries(table, completion, flats)
    wet = [i for i in range(len(table.x)) if (table.half_breadth[i, 1:] > 0.0).any()]
    sources += [_section(table, completion, flats, i) for i in wet]
    sources += [_waterline(table, completion, flats, j) for j in range(1, len(table.z) - 1)]
    state, report = adopt(sources, ship, ASSOCIATIONS, tolerances)
    bare = [i for i in range(len(table.x)) if i not in wet]
    notes = tuple(f"station at x = {table.x[i]:g} m: no breadth, no section made" for i in bare)
    return state, attrs.evolve(report, notes=(*_printed(table), *notes, *report.notes))


def _printed(table: OffsetTable) -> list[str]:
    """Say how coarsely the offsets are printed."""
    ratio = table.z / (table.draught or 1.0)
    unit = "T" if table.draught else "m"
    found: list[str] = []
    for value in np.unique(np.round(table.rounding, 9)).tolist():
        mine = ratio[np.abs(table.rounding - value) < 1e-9]
        heights = ", ".join(f"{each:.4g}" for each in mine)
        found.append(f"offsets at {heights} {unit} are printed to +-{1e3 * value:.2g} mm")
    return found


class _Flats:
    """Where lines enter and leave the flat of side, taken from its border curve."""

    def __init__(self, side: FloatArray | None, table: OffsetTable) -> None:
        self.side = side
        self.half = table.breadth / 2.0
        if side is not None:
            self.border = loft(CurveData.single(side, _border_kinds(side)))

    def meet(self, axis: int, offset: float) -> FloatArray:
        """Give the places where the border passes a plane, (k, 3), m."""
        if self.side is None:
            return np.zeros((0, 3))
        return meet_planes(self.border, np.eye(3)[axis], np.array([offset])).xyz


def _border_kinds(side: FloatArray) -> list[int]:
    """Let a border be smooth, if as such it passes every level once on either side."""
    smooth, knuckles = ([int(kind)] * len(side) for kind in (PointKind.SMOOTH, PointKind.KNUCKLE))
    low, high = float(side[:, 2].min()) + 0.1, float(side[:, 2].max()) - 0.02
    if low >= high:  # too low a flat to tell
        return knuckles
    levels = np.linspace(low, high, 40)
    met = meet_planes(loft(CurveData.single(side, smooth)), np.eye(3)[2], levels)
    once = np.bincount(met.plane, minlength=len(levels)) == 2
    return smooth if once.all() else knuckles


def _boundaries(table: OffsetTable, completion: Completion, flats: _Flats) -> list[LineSource]:
    top = float(table.z[-1])
    deck = _waterline(table, completion, flats, len(table.z) - 1)
    found = [
        LineSource.make(
            "boundary", "profile", completion.profile, plane=((0, 1, 0), 0.0),
            boundary=BoundaryKind.END, kind=completion.profile_kind.tolist(),
        ),
        LineSource.make(
            "boundary", "deck edge", deck.points, plane=((0, 0, 1), top),
            boundary=BoundaryKind.END, kind=deck.kind.tolist(), direction=deck.direction,
        ),
    ]  # fmt: skip
    if completion.bottom is not None:
        found.append(
            LineSource.make(
                "boundary", "flat of bottom", completion.bottom, plane=((0, 0, 1), 0.0),
                boundary=BoundaryKind.FLAT,
            )
        )  # fmt: skip
    if completion.side is not None:
        found.append(
            LineSource.make(
                "boundary", "flat of side", completion.side,
                plane=((0, 1, 0), table.breadth / 2.0), boundary=BoundaryKind.FLAT,
                kind=_border_kinds(completion.side),
            )
        )  # fmt: skip
    return found


def _line(
    group: str,
    name: str,
    points: list[FloatArray],
    tangents: FloatArray,
    along: FloatArray,
    axis: int,
) -> LineSource:
    """Put points in order along an axis, those on a flat's border marked as tangent points."""
    xyz = np.array([*points, *tangents])
    tangent = np.arange(len(xyz)) >= len(points)
    order = np.lexsort((~tangent, xyz[:, axis]))
    xyz, tangent = xyz[order], tangent[order]
    step = np.abs(np.diff(xyz, axis=0)).max(axis=1)
    near = step <= 1e-4
    drop = np.concatenate([[False], near & (~tangent[1:] | tangent[:-1])])
    drop[:-1] |= near & tangent[1:] & ~tangent[:-1]
    xyz, tangent = xyz[~drop], tangent[~drop]
    kind = np.where(tangent, int(PointKind.TANGENT), int(PointKind.SMOOTH))
    direction = np.where(tangent[:, None], along, 0.0)
    return LineSource.make(group, name, xyz, kind=kind.tolist(), direction=direction)


def _section(table: OffsetTable, completion: Completion, flats: _Flats, i: int) -> LineSource:
    x = float(table.x[i])
    y, z = table.half_breadth[i], table.z
    wet = np.isfinite(y) & (y > 0.0)
    wet[0] = False
    name = f"ST {round(20.0 * x / table.length, 6):g}"
    start = _foot(completion, x, float(z[wet][0]))
    points = [np.array([x, b, h]) for b, h in zip(y[wet], z[wet], strict=True)]
    side = flats.meet(0, x)
    side = side[(side[:, 2] > 1e-6) & (side[:, 2] < z[-1] - 1e-6)]
    line = _line("sections", name, points, side, np.array([0.0, 0.0, 1.0]), 2)
    foot = [start]
    kind, direction = [int(PointKind.SMOOTH)], [np.zeros(3)]
    if y[0] > 0.0 and start[2] == 0.0 and completion.bottom is not None:
        foot.append(np.array([x, y[0], 0.0]))
        kind.append(int(PointKind.TANGENT))
        direction.append(np.array([0.0, 1.0, 0.0]))
    return LineSource.make(
        "sections", name, np.concatenate([foot, line.points]),
        kind=kind + line.kind.tolist(), direction=np.concatenate([direction, line.direction]),
    )  # fmt: skip


def _foot(completion: Completion, x: float, below: float) -> FloatArray:
    """Give the highest place of the profile at a station that lies below its first offset."""
    p = completion.profile
    heights = [float(h) for h in p[np.abs(p[:, 0] - x) < 1e-6, 2] if h < below]
    spline = loft(CurveData.single(p, completion.profile_kind.tolist()))
    met = meet_planes(spline, np.eye(3)[0], np.array([x])).xyz
    heights += [float(h) for h in met[:, 2] if h < below]
    return np.array([x, 0.0, max(heights)])


def _waterline(table: OffsetTable, completion: Completion, flats: _Flats, j: int) -> LineSource:
    z = float(table.z[j])
    y = table.half_breadth[:, j]
    inside = (table.x > completion.stern[j] + 1e-6) & (table.x < completion.stem[j] - 1e-6)
    wet = np.isfinite(y) & (y > 0.0) & inside
    points = [np.array([x, b, z]) for x, b in zip(table.x[wet], y[wet], strict=True)]
    points += [np.array([completion.stern[j], 0.0, z]), np.array([completion.stem[j], 0.0, z])]
    side = flats.meet(2, z) if j < len(table.z) - 1 else _deck_flat(flats, z)
    name = f"WL {z / (table.draught or 1.0):g}"
    return _line("waterlines", name, points, side, np.array([1.0, 0.0, 0.0]), 0)


def _deck_flat(flats: _Flats, z: float) -> FloatArray:
    """Give the ends of the flat of side's border, in the deck's plane."""
    if flats.side is None:
        return np.zeros((0, 3))
    ends = flats.side[[0, -1]]
    return ends[np.abs(ends[:, 2] - z) < 1e-9]
