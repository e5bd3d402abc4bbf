"""Digitised lines: points per line, in one or several pieces, read into ship axes.

Files are in ship axes already: x forward, y to port, z up. Unit and scale are settled first, all
that follows is in m. Of lines drawn on both sides one side is kept, to port. What was assumed,
repaired or looks wrong goes to a `Notebook`.
"""

from __future__ import annotations

import math
from pathlib import Path

import attrs
import numpy as np

from assoc_hull.arguments import file_path, positive, shown
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.polylines.operations import cumulative_lengths, drop_repeats
from assoc_hull.io.digitised.bulwarks import below_deck
from assoc_hull.io.digitised.one_hull import take_one_hull
from assoc_hull.io.digitised.rhino import rhino_lines
from assoc_hull.io.digitised.text import parse_lines
from assoc_hull.io.lines.mend_lines import (
    distances_off,
    drawn_once,
    join_pieces,
    join_width_text,
    nearest_ends,
    polyline_distance,
    put_in_order,
    put_pieces_in_order,
    report_crossings,
    report_holes,
    report_joins,
    with_met_ends,
)
from assoc_hull.io.lines.raw_lines import (
    BOUNDARIES,
    RawLines,
    RawPiece,
    boundary_name,
    refuse_retraced,
)
from assoc_hull.io.lines.several_hulls import HullChoice
from assoc_hull.io.lines.ship_frame import StatedPlaces
from assoc_hull.io.lines.slices import (
    AXES,
    GapJoin,
    Gaps,
    HullSlices,
    LinePiece,
    SliceLine,
    settled_gaps,
)
from assoc_hull.io.mesh.frame import axes_rows
from assoc_hull.io.placing.options import FileAxes, FrameOptions
from assoc_hull.io.placing.placed_lines import place_slices
from assoc_hull.io.reports import Notebook
from assoc_hull.io.rhino.read import is_rhino
from assoc_hull.io.tables.table_text import read_text
from assoc_hull.io.units import refuse_other_unit
from assoc_hull.tolerance import length_factor, round_at_size, settled

__all__ = [
    "read_lines",
    "to_one_side",
]

# --------------------------------------------------------------------------------------
# Both sides of a hull: pieces are cut at the centre plane, and one side is kept.

_FLIP = np.array([1.0, -1.0, 1.0])

# Lengths of this module are those of hulls of 100 m and more, and less in proportion for others.

_CENTRE = 1e-3
"""Points this close (m) to the centre plane lie in it."""

_ACROSS = 0.02
"""A piece that lies farther than this (m) on each side is drawn on both sides."""

_IMAGE = 0.1
"""A piece whose mirror image is passed by no more than this (m) is drawn twice."""

_SYMMETRIC = 5e-3
"""Sides that differ by more than this (m) are reported."""

_AGAIN = 0.05
"""A side that begins this close (m) to where the other began is drawn from its beginning again."""


@attrs.define(eq=False)
class _Sides:
    """The pieces of one line: to port, and to starboard brought to port."""

    port: list[RawPiece] = attrs.field(factory=list)
    starboard: list[RawPiece] = attrs.field(factory=list)
    cut: bool = False


def to_one_side(raw: list[RawPiece], book: Notebook, small: float = 1.0) -> list[RawPiece]:
    """Bring all pieces (m) to port, those that lie on both sides once.

    Pieces of a line stand together, the lines in the order in which they come first. `book` takes
    what was cut, left out and mirrored, and lines whose sides differ; `small` is the factor of
    lengths, by the size of the hull.
    """
    lines: dict[str, _Sides] = {}
    for each in raw:
        _sort(each, lines.setdefault(each.line, _Sides()), small)
    kept: list[RawPiece] = []
    cut: list[str] = []
    images = turned = 0
    for name, sides in lines.items():
        again, others = _drawn_twice(sides, small)
        _report_difference(name, sides.port, again, book, small)
        cut += [name] if sides.cut else []
        images += 0 if sides.cut else len(again)
        turned += len(others)
        kept += [*sides.port, *others]
    _report_sides(cut, images, turned, book)
    return to_port_of_centre(kept, book, small)


def to_port_of_centre(pieces: list[RawPiece], book: Notebook, small: float) -> list[RawPiece]:
    """Cut pieces where they pass the centre plane by less than makes them lie on both sides.

    The profile lies in it. Only y >= 0 is a part of the hull, and no edit of a hull would be taken
    that has other points.
    """
    found, past = [], dict[str, float]()
    for each in pieces:
        off = np.abs(each.points[:, 1]) if each.line.lower() == "profile" else -each.points[:, 1]
        most = float(off.max())
        if not 0.0 < most <= small * _ACROSS:
            found.append(each)
            continue
        past[each.line] = max(most, past.get(each.line, 0.0))
        found.append(attrs.evolve(each, points=_cut_ends(each)))
    if past:
        worst = max(past, key=lambda name: past[name])
        what = f"{len(past)} lines pass y = 0, by up to {1e3 * past[worst]:.3g} mm ({worst})"
        book.repair("centre plane", "the lines", f"{what}: cut there", past[worst])
    return found


def _cut_ends(piece: RawPiece) -> FloatArray:
    """Give the points of a piece that are not beyond the centre plane, its ends brought into it."""
    points = piece.points.copy()
    inside = np.flatnonzero(points[:, 1] > 0.0)
    if piece.line.lower() == "profile" or not len(inside):
        points[:, 1] = 0.0
        return points
    first, last = int(inside[0]), int(inside[-1])
    kept = points[first : last + 1]
    kept[:, 1] = np.maximum(kept[:, 1], 0.0)
    head = _through_centre(points[first - 1], points[first]) if first else kept[:0]
    tail = _through_centre(points[last + 1], points[last]) if last + 1 < len(points) else kept[:0]
    return np.concatenate([head, kept, tail])


def _through_centre(beyond: FloatArray, inside: FloatArray) -> FloatArray:
    """Give the place, (1, 3), where a chord passes the centre plane."""
    part = inside[1] / (inside[1] - beyond[1])
    place = inside + part * (beyond - inside)
    place[1] = 0.0
    found: FloatArray = place[None]
    return found


def _report_sides(cut: list[str], images: int, turned: int, book: Notebook) -> None:
    if cut:
        what = f"{len(cut)} lines lie on both sides, as {cut[0]}: cut at y = 0"
        book.repair("both sides", "the lines", f"{what} and the port side kept", len(cut))
    if images:
        what = f"{images} pieces at negative y are mirror images of others and left out"
        book.repair("both sides", "the lines", what, images)
    if turned:
        what = f"{turned} pieces at negative y brought to port"
        book.repair("mirrored", "the lines", what, turned)


def _sort(piece: RawPiece, sides: _Sides, small: float) -> None:
    """Put a piece, or its parts, on the side where it lies."""
    y = piece.points[:, 1]
    across = min(float(y.max()), -float(y.min())) > small * _ACROSS
    sides.cut |= across
    for points in _cut_at_centre(piece.points, small) if across else [piece.points]:
        if points[:, 1].mean() < -small * 1e-6:
            turned = points * _FLIP + 0.0
            sides.starboard.append(RawPiece(piece.line, turned, piece.where))
        else:
            sides.port.append(RawPiece(piece.line, points, piece.where))


def _cut_at_centre(points: FloatArray, small: float) -> list[FloatArray]:
    """Cut a piece where it goes from one side to the other."""
    points = points.copy()
    points[np.abs(points[:, 1]) < small * _CENTRE, 1] = 0.0
    side = np.sign(points[:, 1])
    off = np.flatnonzero(side)
    found: list[FloatArray] = []
    head = points[: off[0]]
    begin = int(off[0])
    for last, first in zip(off[:-1].tolist(), off[1:].tolist(), strict=True):
        if side[last] != side[first]:
            run = np.concatenate([head, points[begin : last + 1]])
            tail, head = _between(run, points[last + 1 : first], points[first], small * _AGAIN)
            found.append(np.concatenate([run, tail]))
            begin = first
    found.append(np.concatenate([head, points[begin:]]))
    return [each for each in found if len(each) > 1]


def _between(
    run: FloatArray, centre: FloatArray, after: FloatArray, near: float
) -> tuple[FloatArray, FloatArray]:
    """Share the points in the centre plane between the run before and the run after them.

    Where there are none, both get the point where the chord between them passes y = 0. A side
    that begins as `near` (m) to the beginning of the other is drawn again.
    """
    half = len(centre) // 2
    # "Again": the second side is drawn from the beginning of the first, so that the pen jumped
    # and no chord between the runs is a part of the hull.
    again = any(
        np.linalg.norm(each * _FLIP - run[0]) < near for each in (*centre[half:][:1], after)
    )
    if len(centre) == 1 and again:
        nearer = np.linalg.norm(centre[0] - run[-1]) < np.linalg.norm(centre[0] - after)
        return (centre, centre[:0]) if nearer else (centre[:0], centre)
    if len(centre) or again:
        return centre[: (len(centre) + 1) // 2], centre[half:]
    before = run[-1]
    place = before + before[1] / (before[1] - after[1]) * (after - before)
    place[1] = 0.0
    return place[None], place[None]


def _drawn_twice(sides: _Sides, small: float) -> tuple[list[RawPiece], list[RawPiece]]:
    """Give the pieces to starboard that port has too, and the others.

    Of a line that was cut at the centre plane the longer side stays.
    """
    if not sides.port or not sides.starboard:
        return [], sides.starboard
    if sides.cut:
        if 2.0 * _length(sides.port) < _length(sides.starboard):
            sides.port, sides.starboard = sides.starboard, sides.port
        return sides.starboard, []
    again = [
        distances_off(each.points, sides.port).max() < small * _IMAGE for each in sides.starboard
    ]
    pairs = list(zip(sides.starboard, again, strict=True))
    return [each for each, twice in pairs if twice], [each for each, twice in pairs if not twice]


def _length(pieces: list[RawPiece]) -> float:
    return sum(float(cumulative_lengths(each.points)[-1]) for each in pieces)


def _report_difference(
    name: str, kept: list[RawPiece], dropped: list[RawPiece], book: Notebook, small: float
) -> None:
    """Report the sides of a line that differ by more than drawing errors."""
    away = max((float(distances_off(each.points, kept).max()) for each in dropped), default=0.0)
    if away > small * _SYMMETRIC:
        what = f"its sides differ by up to {1e3 * away:.3g} mm; one is left out"
        book.suspect("both sides", name, what, away)


# --------------------------------------------------------------------------------------
# Reading: unit, families, pieces, gaps.

_UNITS = {"m": 1.0, "mm": 1e-3, "cm": 1e-2, "ft": 0.3048, "in": 0.0254}
_METRIC = ("m", "cm", "mm")
_LONGEST, _SHORTEST = 600.0, 1.0
"""Lengths (m) between which a hull may lie at full scale. Absolute: others show a wrong unit."""

_OFF_PLANE = 0.02
"""Points scattered less than this (m) about a plane are meant to lie in it."""

_MOST_PIECES = 400
"""Pieces of one line are joined within seconds up to here; a line with more is no one line."""

_REACH = 0.1
"""The end of a line this near (m) to a boundary curve lies on it."""

_GROUPS = {
    "ST": "sections", "SECTION": "sections", "FRAME": "sections", "FR": "sections",
    "WL": "waterlines", "WATERLINE": "waterlines", "BTK": "buttocks", "BUTTOCK": "buttocks",
}  # fmt: skip
_ORDER = ("sections", "waterlines", "buttocks")


def read_lines(
    path_or_text: str | Path,
    *,
    scale: float = 1.0,
    unit: str = "auto",
    gaps: Gaps | float | None = None,
    length: float | None = None,
    name: str | None = None,
    frame: FrameOptions | None = None,
    choice: HullChoice | None = None,
    axes: str | None = None,
    deck_edge: str | None = None,
    stated: StatedPlaces | None = None,
) -> HullSlices:
    """Read digitised lines: x forward, y to port, z up; wherever the file has its origin.

    Parameters
    ----------
    path_or_text : str or Path
        A file, or the text itself: CSV with the columns line, x, y, z (and piece), DXF, BRITFAIR,
        curves or offsets of DELFTship, or a GHS geometry file. A line is a section, waterline
        or buttock by its constant coordinate; lines called "profile", "deck edge", "transom" and,
        as edges in which a part ends across the ship, "bossing end" or "skeg end" are boundary
        curves.
    scale : float
        Full scale over the scale of the file.
    unit : {"auto", "m", "mm", "cm", "ft", "in"}
        Unit of the file.
    gaps : Gaps, float or None
        Loose ends closer than `join` are joined, 60 mm by default; farther ones stay apart,
        and those up to `refuse` are reported. A number is the width `join` (m).
    length : float or None, m
        Between perpendiculars, where it is known. Of a hull under 100 m all limits are less in
        proportion.
    name : str or None
        Of the hull; that of the file by default.
    frame : FrameOptions or None
        Where base line, waterline and perpendiculars are, what is not given being found; None:
        x and z stay as the file has them.
    choice : HullChoice or None
        Which of several hulls side by side; by default there is one.
    axes : str or None
        Axes of the file that point forward, to port and up: ``"-x-y+z"``; as they are by default.
    deck_edge : str or None
        The line that is the deck edge; what stands above it is cut off.
    stated : StatedPlaces or None
        What comments say of the ship, m at the scale of the file; besides what the form itself has.

    Returns
    -------
    HullSlices

    Raises
    ------
    BadInputError
        A text that holds no lines, a line in no plane, one name in two planes, or several hulls.
    """
    if not isinstance(path_or_text, str):
        file_path(path_or_text, "in read_lines")
    book = Notebook()
    found, source = _parsed(path_or_text, book)
    turn = np.eye(3) if axes is None or axes == "auto" else axes_rows(axes)
    raw = found.pieces if axes is None else [_turned(each, turn) for each in found.pieces]
    factor = _factor(raw, scale, _unit(found, unit, book, source), book, source)
    for each in raw:
        refuse_retraced(each)
    raw = [RawPiece(e.line, e.points * factor, e.where, e.knuckles * factor) for e in raw]
    raw = put_pieces_in_order(raw, book)
    raw = take_one_hull(raw, choice or HullChoice(), factor, book, float(turn[1].sum()))
    if deck_edge is not None:
        raw = below_deck(raw, deck_edge, book)
    knuckles = _knuckles(raw)
    small = _length_factor(raw, length)
    if math.frexp(factor)[0] != 0.5:
        # A change of unit leaves something in the last bits, on which no choice may turn.
        raw = [attrs.evolve(each, points=settled(each.points, small)) for each in raw]
    raw = drawn_once(to_one_side(raw, book, small), book, small)
    every = np.concatenate([each.points for each in raw])
    joins: list[GapJoin] = []
    limits = settled_gaps(gaps, small, "in read_lines")
    rims = _by_name(raw, boundary=True)
    boundaries = [
        SliceLine(
            "boundary",
            title,
            float("nan"),
            tuple(_boundary(title, rims, limits, joins, book, small)),
        )
        for title in rims
    ]
    borders = {
        line.name: np.concatenate([each.points for each in line.pieces]) for line in boundaries
    }
    lines = [
        _line(title, mine, limits, joins, borders, book, small)
        for title, mine in _by_name(raw, boundary=False).items()
    ]
    _refuse_twins(lines, source)
    report_joins(joins, book, small)
    lines.sort(key=lambda each: (_ORDER.index(each.group), each.offset))
    default = Path(source).stem if source != "text" else "lines"
    slices = HullSlices(
        default if name is None else name, tuple(lines), tuple(boundaries), tuple(joins),
        book.report(), False, every.min(axis=0), every.max(axis=0), gaps=limits,
        knuckles=knuckles, factor=small,
    )  # fmt: skip
    if frame is None:
        return slices
    if frame.ends(factor) == (None, None):
        _tell_bow(slices, book)
    signs = {"x_sign": float(turn[0].sum()), "z_sign": float(turn[2].sum())}
    # Places of a form are along its own axes.
    own = found.stated if axes is None else StatedPlaces()
    said = own.scaled(factor).joined((stated or StatedPlaces()).scaled(scale))
    return place_slices(slices, frame, FileAxes(factor=factor, **signs), book, said)


def _turned(piece: RawPiece, turn: FloatArray) -> RawPiece:
    """Give a piece in axes of the ship, of which each is one of the file or its opposite."""
    points, knuckles = (
        np.stack([(xyz * row).sum(axis=1) for row in turn], axis=1) + 0.0
        for xyz in (piece.points, piece.knuckles)
    )
    return attrs.evolve(piece, points=points, knuckles=knuckles)


def _parsed(path_or_text: str | Path, book: Notebook) -> tuple[RawLines, str]:
    """Give the lines of a file or text, and its name."""
    if isinstance(path_or_text, Path) and is_rhino(path_or_text):
        return rhino_lines(path_or_text, book), path_or_text.name
    text, source = read_text(path_or_text, book)
    return parse_lines(text, source, book), source


def _length_factor(raw: list[RawPiece], length: float | None) -> float:
    """Give the factor of lengths of a hull, by what is known of its length, m."""
    size = np.ptp(np.concatenate([each.points for each in raw]), axis=0)
    if length is None and not 0.0 < size[0] == size.max():
        return 1.0  # a part of a hull, as a few sections: nothing tells how long it is
    return length_factor(float(size[0]) if length is None else length)


def _knuckles(raw: list[RawPiece]) -> dict[str, FloatArray]:
    """Give the points marked as knuckles by line, (k, 3), m, to port."""
    found: dict[str, list[FloatArray]] = {}
    for each in raw:
        if len(each.knuckles):
            places = each.knuckles.copy()
            places[:, 1] = np.abs(places[:, 1])
            found.setdefault(each.line, []).append(places)
    return {name: np.concatenate(places) for name, places in found.items()}


def _unit(found: RawLines, unit: str, book: Notebook, source: str) -> str:
    """Give the unit of the format where it has one; another may be given only against a hint."""
    if found.unit is None or unit == found.unit:
        return unit
    if unit != "auto" and found.told:
        raise BadInputError(f"the unit {shown(unit)} was given and the form has {found.unit}",
                            f"at {source}", "leave the unit out")  # fmt: skip
    if unit != "auto" and found.unit in _METRIC:
        refuse_other_unit(source, found.unit, unit)
    if unit != "auto":
        # Drawings that say feet or inches do so by default more often than not.
        what = f"{unit}, as given; the header says {found.unit}: right is one of the two"
        book.suspect("unit", "the lines", what)
        return unit
    if not found.told and found.unit not in _METRIC:
        what = f"the header says {found.unit}, as it does by default: the unit goes by the size"
        book.suspect("unit", "the lines", f"{what}; give the unit")
        return unit
    book.assume("unit", "the lines", f"{found.unit}, as the form has it")
    return found.unit


def _factor(raw: list[RawPiece], scale: float, unit: str, book: Notebook, source: str) -> float:
    """Give the factor from units of the file to m at full scale."""
    scale = positive(scale, "scale", "as an argument")
    if unit not in ["auto", *_UNITS]:
        known = " or ".join(map(repr, ("auto", *_UNITS)))
        raise BadInputError(f"the unit {shown(unit)} is unknown for digitised lines",
                            "the argument unit", f"give {known}")  # fmt: skip
    size = scale * float(np.ptp(np.concatenate([each.points for each in raw]), axis=0).max())
    if unit == "auto":
        unit = "mm" if size > _LONGEST else "m"
        what = f"{unit}, because the longest side is {size:.6g} units at full scale"
        book.assume("unit", "the lines", what, size)
    if size * _UNITS[unit] > _LONGEST:
        what = f"the lines are {size * _UNITS[unit]:.6g} m long in {unit}, with {_farthest(raw)}"
        other = unit == "m" and _SHORTEST < size * _UNITS["mm"] < _LONGEST
        more = "are these millimetres? give unit='mm'; or " if other else ""
        raise BadInputError(
            what, f"at {source}", f"{more}correct it, or give another unit or scale"
        )
    if 0.0 < size * _UNITS[unit] < _SHORTEST:
        raise BadInputError(f"the lines are only {size * _UNITS[unit]:.4g} m long in {unit}",
                            f"at {source}", "give unit='m', or the scale")  # fmt: skip
    return scale * _UNITS[unit]


def _farthest(raw: list[RawPiece]) -> str:
    """Name the coordinate that lies farthest from the middle one of its kind."""
    every = np.concatenate([each.points for each in raw])
    far = np.abs(every - np.median(every, axis=0))
    row, axis = np.unravel_index(int(far.argmax()), far.shape)
    ends = np.cumsum([len(each.points) for each in raw])
    piece = raw[int(np.searchsorted(ends, row, side="right"))]
    return f"{'xyz'[axis]} = {every[row, axis]:.6g} in {piece.line} (from {piece.where})"


def _by_name(raw: list[RawPiece], *, boundary: bool) -> dict[str, list[RawPiece]]:
    """Give the pieces of boundary curves, or of all other lines, by name."""
    found: dict[str, list[RawPiece]] = {}
    for each in raw:
        title = boundary_name(each.line)
        if (title is not None) == boundary:
            found.setdefault(title or each.line, []).append(each)
    return found


def _chain(
    name: str,
    raw: list[RawPiece],
    gaps: Gaps,
    joins: list[GapJoin],
    borders: dict[str, FloatArray],
    book: Notebook,
    small: float,
) -> list[LinePiece]:
    """Join the pieces of one line where they meet; gaps wider than `join` stay open."""
    pieces = _pieces(name, raw, book)
    pieces = [
        attrs.evolve(
            each,
            ends=(
                _under(each.points[0], borders, small), _under(each.points[-1], borders, small),
            ),
        )
        for each in pieces
    ]  # fmt: skip
    pieces, made = join_pieces(name, pieces, Gaps(gaps.join, gaps.join))
    joins += made
    _report_gap(name, pieces, gaps, book)
    return pieces


def _boundary(
    name: str,
    rims: dict[str, list[RawPiece]],
    gaps: Gaps,
    joins: list[GapJoin],
    book: Notebook,
    small: float,
) -> list[LinePiece]:
    """Join the pieces of a boundary curve; a hole that stays is reported: no net of it closes."""
    others = [(other, each.points) for other in rims if other != name for each in rims[other]]
    pieces = with_met_ends(_pieces(name, rims[name], book), others, small * _REACH)
    pieces, made = join_pieces(name, pieces, Gaps(gaps.join, gaps.join))
    joins += made
    report_holes(name, pieces, book, small)
    return pieces


def _pieces(name: str, raw: list[RawPiece], book: Notebook) -> list[LinePiece]:
    """Give the pieces of one line with their points in order."""
    if len(raw) > _MOST_PIECES:
        raise BadInputError(f"{name} comes in {len(raw)} pieces, more than {_MOST_PIECES}",
                            f"in {raw[0].where}", "join them where they were drawn")  # fmt: skip
    pieces: list[LinePiece] = []
    for each in raw:
        points = drop_repeats(each.points, 1e-6)
        if len(points) < 2:
            raise BadInputError(f"{name} has a piece of one point", f"in {each.where}",
                                "give two or more")  # fmt: skip
        pieces.append(LinePiece(put_in_order(name, points, book)))
    return pieces


def _report_gap(name: str, pieces: list[LinePiece], gaps: Gaps, book: Notebook) -> None:
    """Report loose ends that face one another across a gap too wide to be closed unasked."""
    near = nearest_ends(pieces)
    if near is None or near[0] > gaps.refuse or near[1][0] == near[2][0]:
        return
    gap, (piece, end), _ = near
    x, y, z = pieces[piece].points[-end].tolist()
    what = (
        f"two pieces end {1e3 * gap:.3g} mm apart at ({x:.4g}, {y:.4g}, {z:.4g}) m and were not "
        f"joined; if they are one line give join= of {join_width_text(gap)} m or more"
    )
    book.suspect("gap", name, what, gap)


def _under(place: FloatArray, borders: dict[str, FloatArray], small: float) -> str:
    """Name the boundary curve on which the end of a line lies: "loose" if on none."""
    for name in sorted(borders, key=lambda each: (each not in BOUNDARIES, each)):
        near = name != "profile" and polyline_distance(borders[name], place) < small * _REACH
        if near:
            return name
    return "profile" if abs(place[1]) < small * _CENTRE else "loose"


def _line(
    name: str,
    raw: list[RawPiece],
    gaps: Gaps,
    joins: list[GapJoin],
    borders: dict[str, FloatArray],
    book: Notebook,
    small: float,
) -> SliceLine:
    """Make a line of its pieces: its family, its plane, its gaps; from aft or from below."""
    every = np.concatenate([each.points for each in raw])
    group = _group(name, every, raw[0].where, small)
    axis = AXES[group]
    offset = round_at_size(float(np.median(every[:, axis])), 9, small)
    off = float(np.abs(every[:, axis] - offset).max())
    if off > small * _OFF_PLANE:
        raise _no_plane(name, every, axis, raw[0].where, small)
    if off > small * 1e-9:
        what = f"points up to {1e3 * off:.3g} mm off {'xyz'[axis]} = {offset:.6g} m put into it"
        book.repair("plane", name, what, off)
    flat = [RawPiece(each.line, _flattened(each.points, axis, offset), each.where) for each in raw]
    pieces = _chain(name, flat, gaps, joins, borders, book, small)
    report_crossings(name, pieces, axis, book)
    way = 2 if group == "sections" else 0
    turned = [
        each if each.points[-1, way] >= each.points[0, way] else each.reversed() for each in pieces
    ]
    turned.sort(key=lambda each: (each.points[:, 2].min(), each.points[:, 0].min()))
    return SliceLine(group, name, offset, tuple(turned))


def _no_plane(name: str, every: FloatArray, axis: int, where: str, small: float) -> BadInputError:
    """Say how a line lies: in the plane of another family, or in none."""
    spread = np.ptp(every, axis=0)
    other = int(np.argmin(spread))
    median = float(np.median(every[:, axis]))
    off = float(np.abs(every[:, axis] - median).max())
    what = f"{name} lies in no plane: {'xyz'[axis]} runs to {off:.3g} m off {median:.6g} m"
    if other != axis and spread[other] < small * _OFF_PLANE:
        return BadInputError(
            f"{what}, but {'xyz'[other]} is constant", f"in {where}",
            "the hull lies on its side: give x forward, y to port, z up; or the name is wrong",
        )  # fmt: skip
    return BadInputError(what, f"in {where}", "give each line its own name")


def _flattened(points: FloatArray, axis: int, offset: float) -> FloatArray:
    out = points.copy()
    out[:, axis] = offset
    return out


def _group(name: str, points: FloatArray, where: str, small: float) -> str:
    """Give the family by the first word of the name, else by the coordinate that is constant."""
    word = name.split()[0].upper() if name.split() else ""
    if word in _GROUPS:
        return _GROUPS[word]
    spread = np.ptp(points, axis=0)
    flat = [group for group, axis in AXES.items() if spread[axis] < 2.0 * small * _OFF_PLANE]
    if len(flat) != 1:
        raise BadInputError(
            f"{name!r} is no section, waterline or buttock by its points", f"in {where}",
            "begin its name with ST, WL or BTK, or call it profile, deck edge or transom; leave a "
            "chine or knuckle line out: it is found where the sections turn",
        )  # fmt: skip
    return flat[0]


_ENDS, _BROADER = 0.08, 0.15
"""Parts of the length at either end, and of the half-breadth: by so much a stern is broader."""


def _tell_bow(slices: HullSlices, book: Notebook) -> None:
    """Suspect lines whose transom, or broader end, lies forward: their x may run aft."""
    pieces = [piece for line in (*slices.lines, *slices.boundaries) for piece in line.pieces]
    x, y, z = np.concatenate([piece.points for piece in pieces]).T
    low, high = float(x.min()), float(x.max())
    transom = slices.boundary("transom")
    found = None
    if transom is not None:
        place = float(np.concatenate([piece.points for piece in transom.pieces])[:, 0].mean())
        if place - low > high - place:
            found = f"the transom is at x = {place:.6g} m, at the fore end"
    else:
        # Ends are compared above the middle: below it a stern may be finer than the bow.
        part, upper = (x - low) / max(high - low, 1e-300), y * (2.0 * z > z.min() + z.max())
        aft, fore = (float(upper[at].max(initial=0.0)) for at in (part < _ENDS, part > 1.0 - _ENDS))
        if fore - aft > _BROADER * float(y.max()):
            found = f"the fore end is {2.0 * fore:.4g} m broad, the aft end {2.0 * aft:.4g} m"
    if found is not None:
        remedy = "if x runs aft in the file give axes='-x-y+z'; of a body plan station_zero="
        book.suspect("bow", "the lines", f"{found}: {remedy}")


def _refuse_twins(lines: list[SliceLine], source: str) -> None:
    """Refuse two lines of one family in one plane."""
    seen: dict[tuple[str, float], str] = {}
    for line in lines:
        key = (line.group, line.offset)
        if key in seen:
            raise BadInputError(
                f"{seen[key]!r} and {line.name!r} lie in one plane", f"at {source}",
                "give their pieces one name",
            )  # fmt: skip
        seen[key] = line.name
