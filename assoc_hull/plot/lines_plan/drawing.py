"""What is drawn of a hull: lines as polylines, crossings, bodies, mouths of tunnels, a stretch.

But for the graph of drivers, this is the one place here that reads the tables of a hull.
Everything given out is frozen, so a drawing is also a snapshot: it stays as it is while the hull
is edited. Lines that were handed in, before they became a net, make a drawing as well.

Outlines of bodies beside the net on a lines plan: what of them stands to port.

Mouths of tunnels on a lines plan: closed curves on the shell, and lines that end at them.

A stretch of a hull along x, drawn larger: its lines cut off at two stations.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import attrs
import numpy as np

from assoc_hull.arguments import pair
from assoc_hull.edit.hull_normals import hull_normals
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import (
    FloatArray,
    IntArray,
    SplineBatch,
    freeze,
)
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.model.address import AddressBook
from assoc_hull.model.attached_body import AttachedBody
from assoc_hull.model.gaps import crossing_normals, tangents
from assoc_hull.model.kinds import FAMILIES, BoundaryKind
from assoc_hull.model.line_source import LineSource, line_curve_data
from assoc_hull.model.named_mapping import NamedMapping
from assoc_hull.model.tables import (
    HasState,
    HullState,
    Particulars,
    state_of,
)
from assoc_hull.plot.sheet.paper import HEAVY, LINE, TINT, Pen

__all__ = [
    "CHORDS",
    "Drawable",
    "Drawing",
    "PlotCrossings",
    "PlotLine",
    "PlotMouth",
    "clipped",
    "drawing",
    "drawn_outlines",
    "given_lines",
    "mouths_of",
    "outside_mouths",
    "particulars_of",
    "pen_of",
    "short_name",
    "tables_of",
    "zoomed",
]


def drawn_outlines(body: AttachedBody) -> Iterator[FloatArray]:
    """Give the polylines (n, 3), m, of a body on the side that a plan shows.

    A body that stands to starboard alone is drawn in its mirror image.
    """
    mirrored = bool((body.points[..., 1] <= 0.0).all())
    for points in body.outlines.values():
        yield from _to_port(points * [1.0, -1.0, 1.0] if mirrored else points)


def _to_port(points: FloatArray) -> Iterator[FloatArray]:
    """Give the pieces of a polyline (n, 3) with y not below 0."""
    y = points[:, 1]
    crossed = np.flatnonzero(y[:-1] * y[1:] < 0.0)
    part = y[crossed] / (y[crossed] - y[crossed + 1])
    cuts = points[crossed] + part[:, None] * (points[crossed + 1] - points[crossed])
    cuts[:, 1] = 0.0
    every = np.insert(points, crossed + 1, cuts, axis=0)
    keep = np.concatenate([[False], 0.5 * (every[1:, 1] + every[:-1, 1]) >= 0.0, [False]])
    begins, ends = np.flatnonzero(~keep[:-1] & keep[1:]), np.flatnonzero(keep[:-1] & ~keep[1:])
    for begin, end in zip(begins.tolist(), ends.tolist(), strict=True):
        yield every[begin : end + 1]


@attrs.frozen(eq=False)
class PlotMouth:
    """The mouth of a tunnel to port.

    Attributes
    ----------
    name : str
        Of the tunnel.
    x, z, radius : float, m
        Of its axis, and of its inside.
    points : (n, 3), m
        Around the mouth; the last is the first.
    """

    name: str
    x: float
    z: float
    radius: float
    points: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.points)


def mouths_of(state: HullState) -> tuple[PlotMouth, ...]:
    """Take the mouths of the tunnels that a hull holds, as its shell is now."""
    if not state.tunnels:
        return ()
    from assoc_hull.analysis.hydrostatics.tunnel import kept_tunnels

    return tuple(
        PlotMouth(
            each.name, each.x, each.z, each.radius, np.concatenate([each.mouth, each.mouth[:1]])
        )
        for each in kept_tunnels(state)
    )


def outside_mouths(points: FloatArray, mouths: Sequence[PlotMouth]) -> Iterator[FloatArray]:
    """Give the pieces of a polyline on the shell, (n, 3), m, that lie in no mouth."""
    pieces = [points]
    for mouth in mouths:
        pieces = [part for each in pieces for part in _outside(each, mouth)]
    yield from pieces


def _outside(points: FloatArray, mouth: PlotMouth) -> Iterator[FloatArray]:
    """Give what of a polyline lies outside one cylinder."""
    from_axis = points[:, [0, 2]] - [mouth.x, mouth.z]
    way = np.diff(from_axis, axis=0)
    # On a chord from_axis + t way the distance from the axis is the radius at roots of a square.
    square, half = (way * way).sum(axis=1), (from_axis[:-1] * way).sum(axis=1)
    rest = (from_axis[:-1] ** 2).sum(axis=1) - mouth.radius**2
    under = half * half - square * rest
    met = np.flatnonzero((under > 0.0) & (square > 0.0))
    if not len(met):
        if not len(rest) or rest[0] >= 0.0:
            yield points
        return
    root = np.sqrt(under[met])
    part = np.stack([-half[met] - root, -half[met] + root]) / square[met]
    inside = (part > 0.0) & (part < 1.0)
    cuts = (met + part)[inside]
    place = np.unique(np.concatenate([np.arange(len(points), dtype=np.float64), cuts]))
    every = np.column_stack(
        [np.interp(place, np.arange(len(points)), points[:, axis]) for axis in range(3)]
    )
    middle = 0.5 * (every[1:] + every[:-1])[:, [0, 2]] - [mouth.x, mouth.z]
    keep = np.concatenate([[False], (middle * middle).sum(axis=1) >= mouth.radius**2, [False]])
    begins, ends = np.flatnonzero(~keep[:-1] & keep[1:]), np.flatnonzero(keep[:-1] & ~keep[1:])
    for begin, end in zip(begins.tolist(), ends.tolist(), strict=True):
        yield every[begin : end + 1]


_BOUNDARY = {
    BoundaryKind.END: HEAVY,
    BoundaryKind.FLAT: Pen(0.16, "black", (2.0, 0.7, 0.4, 0.7), 2.2),
    BoundaryKind.KNUCKLE: Pen(0.22, over=2.4),
}


def pen_of(line: PlotLine, tinted: bool = False) -> Pen:
    """Give the pen of a line: heavy for the ends of the hull, dashed for borders of flats."""
    pen = LINE if line.boundary is None else _BOUNDARY[line.boundary]
    if tinted:
        return Pen(max(pen.width, 0.26), TINT, pen.dash, 3.0)
    return pen


def particulars_of(drawing: Drawing) -> list[tuple[str, str]]:
    """Give the principal particulars as they are printed."""
    ship = drawing.particulars
    counts = [
        (len(drawing.of(family)), family)
        for family in ("sections", "waterlines", "buttocks", "diagonals")
    ]
    (aft, *_), (fore, *_) = drawing.bounds.tolist()
    return [
        ("Length between perpendiculars", f"{ship.length:.3f} m"),
        ("Length of hull, moulded", f"{fore - aft:.3f} m"),
        ("Breadth, moulded", f"{ship.breadth:.3f} m"),
        ("Depth, moulded", f"{ship.depth:.3f} m"),
        ("Design draught, moulded", f"{ship.draught:.3f} m"),
        ("L/B,  B/T,  L/D", _ratios(drawing)),
        ("Lines", ", ".join(f"{count} {family}" for count, family in counts if count)),
    ]


def _ratios(drawing: Drawing) -> str:
    ship = drawing.particulars
    ratios = ship.length / ship.breadth, ship.breadth / ship.draught, ship.length / ship.depth
    return ",  ".join(f"{ratio:.3f}" for ratio in ratios)


# --------------------------------------------------------------------------------------
# What is drawn of a hull: its lines as polylines, and where they cross.
#
# The one place in this package that reads a hull's tables, but for `links`. Everything given
# out is frozen, so a drawing is also a snapshot: it stays as it is while the hull is edited.

CHORDS = 8
"""Chords that stand for one segment of a line, and four times as many for a boundary."""


@attrs.frozen(eq=False)
class PlotLine:
    """One line of a hull.

    Attributes
    ----------
    name, label : str
        Its name, and the short one without the prefix of its family.
    family : str
        Name of its family.
    boundary : BoundaryKind or None
        What it does to lines that meet it.
    normal : (3,)
        Unit normal of its plane; nan for a space curve.
    offset : float, m
        Offset of its plane; nan for a space curve.
    splines : tuple of SplineBatch
        Its curves, batches of one.
    polylines : tuple of (n, 3), m
        Its curves for drawing.
    """

    name: str
    label: str
    family: str
    boundary: BoundaryKind | None
    normal: FloatArray
    offset: float
    splines: tuple[SplineBatch, ...]
    polylines: tuple[FloatArray, ...]

    @property
    def points(self) -> FloatArray:
        """The points of all its polylines, (k, 3), m."""
        return np.concatenate([np.zeros((0, 3)), *self.polylines])


@attrs.frozen(eq=False)
class PlotCrossings:
    """The crossings of a hull whose normals are known.

    Attributes
    ----------
    key : tuple of k str
        What they are; a key outlives edits.
    line : tuple of k (str, str)
        Names of the lines that cross.
    xyz, normal : (k, 3)
        Place, m, and unit outward normal of the hull.
    """

    key: tuple[str, ...]
    line: tuple[tuple[str, str], ...]
    xyz: FloatArray
    normal: FloatArray


@attrs.frozen(eq=False)
class Drawing:
    """All lines of a hull as they were when it was made.

    Attributes
    ----------
    particulars : Particulars
        Principal dimensions, m.
    lines : tuple of DrawnLine
        By family, along each family by plane.
    crossings : Crossings
        Where they cross.
    window : (float, float) or None, m
        The x between which its lines are cut off; None where they are whole.
    mouths : tuple of PlotMouth
        Of its tunnels.
    bodies : tuple of AttachedBody
        Beside its net.
    """

    particulars: Particulars
    lines: tuple[PlotLine, ...]
    crossings: PlotCrossings
    window: tuple[float, float] | None = None
    mouths: tuple[PlotMouth, ...] = ()
    bodies: tuple[AttachedBody, ...] = ()

    def of(self, family: str) -> tuple[PlotLine, ...]:
        """Give the lines of a family."""
        return tuple(line for line in self.lines if line.family == family)

    def line(self, name: str) -> PlotLine:
        """Give the line of a name.

        Raises
        ------
        UnknownNameError
            There is none.
        """
        # Of several lines of a name the first.
        named = {line.name: line for line in reversed(self.lines)}
        return NamedMapping("line", named, spoken=True)[name]

    @property
    def profile(self) -> PlotLine | None:
        """The boundary in the centre plane."""
        for line in self.of("boundary"):
            if line.boundary == BoundaryKind.END and abs(line.normal[1]) == 1.0:
                return line
        return None

    @property
    def bounds(self) -> FloatArray:
        """Least and greatest coordinates, (2, 3), m; in x those of its window."""
        points = np.concatenate(
            [line.points for line in self.lines]
            + [part for each in self.bodies for part in drawn_outlines(each)]
        )
        found = np.stack([points.min(axis=0), points.max(axis=0)])
        if self.window is not None:
            found[:, 0] = self.window
        return found

    @property
    def middle(self) -> float:
        """The middle of what is drawn along x, m: of Lpp where the lines are whole."""
        return 0.5 * (self.particulars.length if self.window is None else sum(self.window))

    def shows(self, x: float) -> bool:
        """Tell whether a station lies in its window."""
        return self.window is None or self.window[0] <= x <= self.window[1]


Drawable = HasState | HullState | Drawing
"""What can be drawn."""


def tables_of(hull: HasState | HullState) -> HullState:
    """Give the tables of a hull; tables are given back as they are."""
    return hull if isinstance(hull, HullState) else state_of(hull, "in a picture")


def drawing(hull: Drawable) -> Drawing:
    """Take the lines of a hull as they are now; a drawing is given back as it is."""
    if isinstance(hull, Drawing):
        return hull
    state = tables_of(hull)
    book = AddressBook(state)
    lines = [_drawn(state, book, line) for line in state.live("lines").tolist()]
    lines.sort(key=lambda line: (FAMILIES[line.family].rank, line.offset, line.name))
    crossings, mouths = _crossings(state, book), mouths_of(state)
    return Drawing(state.particulars, tuple(lines), crossings, mouths=mouths, bodies=state.bodies)


def _crossings(state: HullState, book: AddressBook) -> PlotCrossings:
    """Take the crossings where both curves pass and their tangents differ."""
    table, rows = state.rows, state.live("rows")
    rows = rows[(table.curve[rows, 1] >= 0) & np.isfinite(table.parameter[rows]).all(axis=1)]
    curve, at = table.curve[rows], table.parameter[rows]
    normal = crossing_normals(*(tangents(state, curve[:, i], at[:, i]) for i in (0, 1)))
    known = (normal != 0.0).any(axis=1)
    rows, normal = rows[known], normal[known]
    inward = (normal * hull_normals(state)[rows]).sum(axis=1) < 0.0
    normal[inward] *= -1.0
    name = {line: book.line_name(line) for line in state.live("lines").tolist()}
    lines = state.curves.line[table.curve[rows]]
    return PlotCrossings(
        tuple(table.key[row] for row in rows.tolist()),
        tuple((name[a], name[b]) for a, b in lines.tolist()),
        table.spot[rows].mean(axis=1),
        normal,
    )


def _drawn(state: HullState, book: AddressBook, line: int) -> PlotLine:
    table, family = state.lines, state.family(line)
    boundary = int(table.boundary[line])
    splines = tuple(state.spline(curve) for curve in state.curves_of(line))
    chords = CHORDS if boundary < 0 else 4 * CHORDS
    normal = table.normal[line].copy()
    flat = bool(table.planar[line])
    return PlotLine(
        book.line_name(line),
        short_name(str(table.name[line]), family.prefix),
        family.name,
        None if boundary < 0 else BoundaryKind(boundary),
        normal if flat else np.full(3, np.nan),
        float(table.offset[line]) if flat else float("nan"),
        splines,
        tuple(sample(spline, chords)[1] for spline in splines),
    )


def short_name(name: str, prefix: str) -> str:
    """Give the name of a line without the prefix of its family, if that leaves anything."""
    found = name.removeprefix(prefix).strip() if prefix else name
    return found or name


# --------------------------------------------------------------------------------------
# Lines as they were handed in, as a drawing: what a hull was before it was adopted.


def given_lines(sources: Sequence[LineSource], particulars: Particulars) -> Drawing:
    """Make a drawing of lines before adoption, each lofted through all its own points.

    Parameters
    ----------
    sources : sequence of LineSource
        The lines; several of one name are one line.
    particulars : Particulars
        Principal dimensions.

    Examples
    --------
    >>> from assoc_hull.model.line_source import line_curve_data, LineSource
    >>> from assoc_hull.model.tables import Particulars
    >>> from assoc_hull.plot.lines_plan.drawing import given_lines
    >>> water = LineSource.make("waterlines", "WL 1", [[0, 0, 1], [5, 2, 1], [9, 0, 1]])
    >>> given_lines([water], Particulars("boat", 9.0, 4.0, 2.0, 1.0)).line("WL 1").offset
    1.0
    """
    pieces: dict[tuple[str, str], list[LineSource]] = {}
    for source in sources:
        pieces.setdefault((source.group, source.name), []).append(source)
    lines = [_given_drawn(mine) for mine in pieces.values()]
    lines.sort(key=lambda line: (FAMILIES[line.family].rank, line.offset, line.name))
    none = PlotCrossings((), (), np.zeros((0, 3)), np.zeros((0, 3)))
    return Drawing(particulars, tuple(lines), none)


def _given_drawn(pieces: Sequence[LineSource]) -> PlotLine:
    first = pieces[0]
    splines = tuple(loft(line_curve_data([piece])) for piece in pieces)
    short = short_name(first.name, FAMILIES[first.family].prefix)
    return PlotLine(
        first.name, short, first.family, first.boundary,
        np.full(3, np.nan) if first.normal is None else first.normal,
        float("nan") if first.normal is None else first.offset,
        splines, tuple(sample(spline, CHORDS)[1] for spline in splines),
    )  # fmt: skip


def zoomed(plan: Drawing, x: tuple[float, float] | None) -> Drawing:
    """Give a drawing of what lies between two x, m; all of it where x is None.

    Raises
    ------
    BadInputError
        The two are no span, or no line lies there.
    """
    if x is None:
        return plan
    low, high = pair(x, "x", "in a picture", positive=False)
    lines = tuple(line for line in (_cut(each, low, high) for each in plan.lines) if line.polylines)
    if not any(line.boundary is None for line in lines):
        aft, fore = plan.bounds[:, 0]
        raise BadInputError(
            f"no line lies between x = {low:g} and {high:g} m", "in a picture",
            f"name a stretch of the hull, which lies between {aft:.2f} and {fore:.2f} m",
        )  # fmt: skip
    every = plan.crossings
    inside = np.flatnonzero((every.xyz[:, 0] >= low) & (every.xyz[:, 0] <= high))
    some = PlotCrossings(
        tuple(every.key[i] for i in inside.tolist()),
        tuple(every.line[i] for i in inside.tolist()),
        every.xyz[inside],
        every.normal[inside],
    )
    return attrs.evolve(plan, lines=lines, crossings=some, window=(low, high))


def _cut(line: PlotLine, low: float, high: float) -> PlotLine:
    """Give what of a line lies between two x; its splines stay whole, one for each piece."""
    found = [
        (spline, piece)
        for spline, points in zip(line.splines, line.polylines, strict=True)
        for piece, _ in clipped(points, low, high)
    ]
    splines, pieces = tuple(each[0] for each in found), tuple(each[1] for each in found)
    return attrs.evolve(line, splines=splines, polylines=pieces)


def clipped(points: FloatArray, low: float, high: float) -> Iterator[tuple[FloatArray, IntArray]]:
    """Give the pieces of a polyline (n, 3) between two x, and for each chord the one it lies on."""
    x = points[:, 0]
    rise = np.diff(x)
    cuts = [np.arange(len(points), dtype=np.float64)]
    for edge in (each for each in (low, high) if np.isfinite(each)):
        part = (edge - x[:-1]) / np.where(rise == 0.0, np.inf, rise)
        inner = np.flatnonzero((part > 0.0) & (part < 1.0))
        cuts.append(inner + part[inner])
    place = np.unique(np.concatenate(cuts))
    every = np.column_stack(
        [np.interp(place, np.arange(len(points)), points[:, axis]) for axis in range(3)]
    )
    middle = 0.5 * (every[1:, 0] + every[:-1, 0])
    inside = np.concatenate([[False], (middle >= low) & (middle <= high), [False]])
    begins, ends = (
        np.flatnonzero(~inside[:-1] & inside[1:]),
        np.flatnonzero(inside[:-1] & ~inside[1:]),
    )
    for begin, end in zip(begins.tolist(), ends.tolist(), strict=True):
        chord = np.floor(0.5 * (place[begin:end] + place[begin + 1 : end + 1])).astype(np.int64)
        yield every[begin : end + 1], chord
