"""Cut a new line from the lines that are there, or put a section once more where it is the same.

The new plane meets boundary curves (contacts) and curves of lower rank (crossings); the role rule
chooses which of these define the line. A crossing defines the old curve too only if that stays
within `Tolerances.keep`; else the old curve drives the new one. Turns at which the line would fold
are rounded with points that follow from the normals of the hull at the marks beside them.

A section once more, elsewhere along the ship: where the hull is a cylinder, it is the same.

A section that `add_line` cuts goes through the lines that it crosses, and knows nothing of what
lies between them. A copy has all points of its model, with kinds and directions, and its features.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.edit.arguments import line_name
from assoc_hull.edit.crossings.adopted_points import NO_ROOT, insert_defining_point
from assoc_hull.edit.lines.curve_deviation import deviation_with
from assoc_hull.edit.lines.kept_runs import NO_KEPT_RUNS, KeptRuns
from assoc_hull.edit.lines.line_planes import CuttingPlane, new_plane, ready_group
from assoc_hull.edit.lines.marks import (
    Marks,
    distinct_marks,
    find_marks,
    headings,
    nearest_order,
    one_end_a_place,
    plane_misses,
    required_marks,
    through_facets,
    with_guides,
)
from assoc_hull.edit.lines.plane_intersections import enter_line_plane
from assoc_hull.edit.transaction import Transaction
from assoc_hull.geometry.curves import (
    CurveData,
    FloatArray,
    IntArray,
    PointKind,
)
from assoc_hull.geometry.splines.curve_order import curve_folds
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.segments import derivative
from assoc_hull.model.features import Feature
from assoc_hull.model.gaps import tangents
from assoc_hull.model.kinds import (
    FAMILIES,
    BoundaryKind,
    Role,
    Sort,
)
from assoc_hull.model.links import generates
from assoc_hull.model.make_objects import CrossingSpec, PointSpec
from assoc_hull.model.roles import Candidates, choose
from assoc_hull.model.tables import Ends, HullState

__all__ = [
    "add_line",
    "copy_section",
    "make_piece",
    "ordered_pieces",
    "ring_closing_point",
    "turning_points",
]


def copy_section(edit: Transaction, line: int, away: float, name: str) -> int:
    """Copy a section along the ship, and give the number of the copy.

    Lines that pass its model pass the copy at the same half-breadth and height, and those that the
    model's crossings define are defined by the copy's as well.

    Parameters
    ----------
    edit : Transaction
        The edit.
    line : int
        The section.
    away : float, m
        How far forward of it the copy stands; negative: abaft.
    name : str

    Raises
    ------
    BadInputError
        There is a line in that plane already, or the name is none.
    """
    state, maker = edit.state, edit.maker
    group = int(state.lines.group[line])
    x = float(state.lines.offset[line]) + away
    cut = new_plane(state, str(state.groups.name[group]), x)
    edit.pending.structural = True
    copy = maker.line(group, line_name(name), (cut.normal, cut.offset), key=cut.key)
    twins = dict[int, int]()
    for curve in state.lines.curves[line]:
        twins |= _copy_curve(edit, curve, copy, x)
    maker.features([*state.features, *_features(state, line, copy, away, twins)])
    enter_line_plane(edit, copy)
    return copy


def _copy_curve(edit: Transaction, curve: int, copy: int, x: float) -> dict[int, int]:
    """Copy one curve of a section; give its points by those of the model."""
    state, maker, put = edit.state, edit.maker, edit.journal.put
    table = state.rows
    new = maker.curve(copy, state.curves.ends[curve])
    mine = table.alive.data & (table.curve.data == curve).any(axis=1)
    crossings = np.flatnonzero(mine & (table.sort.data == Sort.CROSSING)).tolist()
    own = [row for row in state.curves.rows[curve].tolist() if table.sort[row] != Sort.CROSSING]
    made = maker.crossings([_crossing(state, row, curve, new, x) for row in crossings]).tolist()
    put(table.kind, made, table.kind[crossings])
    put(table.direction, made, table.direction[crossings])
    put(table.override, made, table.override[crossings])
    points = maker.points([
        PointSpec(new, _at(table.xyz[row], x), Sort(int(table.sort[row])), int(table.kind[row, 0]),
                  table.direction[row, 0].copy())
        for row in own
    ]).tolist()  # fmt: skip
    twins = dict(zip([*crossings, *own], [*made, *points], strict=True))
    maker.define(new, [twins[row] for row in state.curves.rows[curve].tolist()])
    for row in made:
        for side, other in enumerate(table.curve[row].tolist()):
            if other != new and table.reader[row, side] == other:
                insert_defining_point(maker, other, row)
                edit.pending.curves.add(other)
    edit.pending.born += sorted(str(table.key[row]) for row in made)
    return twins


def _at(place: FloatArray, x: float) -> FloatArray:
    return np.array([x, place[1], place[2]])


def _crossing(state: HullState, row: int, curve: int, new: int, x: float) -> CrossingSpec:
    """Give the crossing of a copied curve that stands for one of its model."""
    table = state.rows
    a, b = (new if each == curve else each for each in table.curve[row].tolist())
    spots = _at(table.spot[row, 0], x), _at(table.spot[row, 1], x)
    return CrossingSpec(
        a, b, _at(table.xyz[row], x), Role(int(table.role[row])), int(table.sign[row]), spots,
        contact=bool(table.contact[row]),
    )  # fmt: skip


def _features(
    state: HullState, line: int, copy: int, away: float, twins: dict[int, int]
) -> list[Feature]:
    """Give the features of a section once more, of those that lie on it alone."""
    keys, names = state.lines.key, state.lines.name
    found = list[Feature]()
    for each in state.features:
        if each.lines != (str(keys[line]),):
            continue
        centre = None if each.centre is None else (each.centre[0] + away, *each.centre[1:])
        x = [float(state.rows.xyz[row, 0]) for row in (each.points[0], twins[each.points[0]])]
        key = each.key.replace(str(keys[line]), str(keys[copy]), 1)
        key = key.replace(f"({x[0]:.4f},", f"({x[1]:.4f},")
        found.append(attrs.evolve(
            each, key=key, name=each.name.replace(str(names[line]), str(names[copy]), 1),
            lines=(str(keys[copy]),), points=tuple(twins[row] for row in each.points),
            centre=centre,
        ))  # fmt: skip
    return found


# --------------------------------------------------------------------------------------
# Rounding turns. Where a line turns back between two neighbouring lines of the net, its two marks
# there lie abreast and a curve through them would fold. The hull's normals at the marks say how the
# line runs on from each, so the outermost point of the turn follows.

_ROUNDS = 3
"""A turn that is halved three times bends by a few degrees from point to point."""

_TURN = 0.87
"""Cosine of the least turn between two points that is given another one."""


def turning_points(data: CurveData, heading: FloatArray) -> list[tuple[int, FloatArray]]:
    """Give the points to be added to the turns at which one curve would fold, in order.

    `heading` (n, 3) are unit vectors along or against the curve at its n points, zero where not
    known. Gives the index of the point before which each belongs, and its place (3,), m: the
    middle of an arc of a circle that turns by the angle between the headings on either side.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.edit.lines.add_line import turning_points
    >>> from assoc_hull.geometry.curves import CurveData
    >>> bend = np.array([[3.0, 0, 0.2], [0, 0, 0], [0, 0, 2], [3, 0, 1.8]])
    >>> way = np.array([[-1.0, 0, 0], [-1, 0, 0], [1, 0, 0], [1, 0, 0]])
    >>> [(at, place.tolist()) for at, place in turning_points(CurveData.single(bend), way)]
    [(2, [-1.0, 0.0, 1.0])]
    """
    heading, own = _along(data.xyz, heading), np.arange(len(data.xyz))
    added: list[tuple[int, FloatArray]] = []
    for _ in range(_ROUNDS):
        turns = _turns(data.xyz, heading, curve_folds(loft(data)).knot.tolist())
        if not turns:
            break
        added += [(int(own[at]), place) for at, place, _ in turns]
        before = [at for at, _, _ in turns]
        places = np.array([place for _, place, _ in turns])
        heading = np.insert(heading, before, [way for _, _, way in turns], axis=0)
        own = np.insert(own, before, own[before])
        data = CurveData.single(
            np.insert(data.xyz, before, places, axis=0),
            np.insert(data.kind, before, PointKind.SMOOTH),
            np.insert(data.direction, before, 0.0, axis=0),
        )
    order = {place.tobytes(): i for i, place in enumerate(data.xyz)}
    return sorted(added, key=lambda item: order[item[1].tobytes()])


def _turns(
    xyz: FloatArray, heading: FloatArray, folded: list[int]
) -> list[tuple[int, FloatArray, FloatArray]]:
    """Give the turns beside points at which a curve folds: index, place (m) and heading of each."""
    found: list[tuple[int, FloatArray, FloatArray]] = []
    for first in sorted({max(knot - side, 0) for knot in folded for side in (0, 1)}):
        pair = slice(first, first + 2)
        if first + 1 < len(xyz) and float((heading[first] * heading[first + 1]).sum()) < _TURN:
            place = _outermost(xyz[pair], heading[pair])
            if place is not None:
                chord = xyz[first + 1] - xyz[first]
                way = chord / np.sqrt((chord * chord).sum())
                found.append((first + 1, place, way))
    return found


def ring_closing_point(xyz: FloatArray, heading: FloatArray) -> FloatArray:
    """Give the place, (3,) m, at which a ring through points (n, 3), m, begins and ends.

    It lies between the last and the first. Headings as for `turning_points`.
    """
    ends, way = xyz[[-1, 0]], _along(xyz, heading)[[-1, 0]]
    place = _outermost(ends, way)
    middle: FloatArray = 0.5 * (ends[0] + ends[1])
    return middle if place is None else place


def _along(xyz: FloatArray, heading: FloatArray) -> FloatArray:
    """Turn headings the way the points follow one another."""
    chord = np.diff(xyz, axis=0)
    against = float((chord * (heading[:-1] + heading[1:])).sum()) < 0.0
    return -heading if against else heading


def _outermost(ends: FloatArray, heading: FloatArray) -> FloatArray | None:
    """Give the middle of an arc between two points; None where they turn to no side."""
    chord = ends[1] - ends[0]
    length = float(np.sqrt((chord * chord).sum()))
    side = heading[0] - heading[1]
    side = side - chord * float((side * chord).sum()) / length**2
    size = float(np.sqrt((side * side).sum()))
    if size < 1e-6:
        return None
    turn = float(np.arccos(np.clip((heading[0] * heading[1]).sum(), -1.0, 1.0)))
    away = 0.5 * length * np.tan(0.25 * turn)
    found: FloatArray = 0.5 * (ends[0] + ends[1]) + side / size * away
    return found


# --------------------------------------------------------------------------------------
# The new line.

_RING = 4
"""A ring of fewer marks than this makes no curve."""

_AGREEING, _AGREE = 3, 0.8
"""So many numbered lines, and such a part of them, make the measure of a group."""

_ROUNDED = 2e-3
"""Of a unit: a name is rounded to three digits."""

_SLIDE = 0.1
"""Times `Tolerances.factor`: room (m) for a crossing whose driver passes the new plane squarely;
more if obliquely."""


def add_line(
    edit: Transaction,
    group: str,
    position: ArrayLike,
    name: str | None = None,
    keep: float | None = None,
) -> int:
    """Cut a new line and give its number.

    Parameters
    ----------
    edit : Transaction
        The edit.
    group : str
        The group it joins.
    position : float, m, or (float, float), m and degrees
        Place of its plane along the family's axis; of a diagonal the height at the centre
        plane and the angle by which it falls outward from the horizontal.
    name : str or None
        If None, the prefix and the position in the measure of the group: see `_name_in_use`.
    keep : float or None, m
        Its crossings define the old curves only where these move by no more than this;
        `Tolerances.keep` if None.

    Raises
    ------
    UnknownNameError
        No such group.
    BadInputError
        No position of a line of that family, a plane that is taken, or no name.
    NoMeetingError
        If the plane meets fewer than two places.
    """
    state = edit.state
    title = None if name is None else line_name(name)
    cut = new_plane(state, ready_group(edit, group, position), position)
    marks = find_marks(state, cut.group, cut.normal, cut.offset)
    edit.pending.structural = True
    family = FAMILIES[state.groups.family[cut.group]]
    if title is None:
        title = _name_in_use(state, cut) or _free_name(
            state, cut.group, f"{family.prefix} {cut.title}"
        )
    line = edit.maker.line(cut.group, title, (cut.normal, cut.offset), key=cut.key)
    for piece in ordered_pieces(edit, line, marks):
        apart = distinct_marks(state, piece)
        if len(apart.curve) < 2:
            # At B/2 the plane of a buttock has one place of the deck edge, met by many lines.
            raise plane_misses(state, cut.group, cut.normal, cut.offset)
        make_piece(edit, line, apart, keep or state.tolerances.keep)
    enter_line_plane(edit, line)
    curves, table = np.array(state.lines.curves[line], np.int64), state.rows
    on = table.alive.data & np.isin(table.curve.data, curves).any(axis=1)
    met = np.flatnonzero(on & (table.sort.data == Sort.CROSSING))
    edit.pending.born += sorted(table.key[row] for row in met.tolist())
    return line


def ordered_pieces(edit: Transaction, line: int, marks: Marks) -> list[Marks]:
    """Put marks in order, piece by piece; sections upward, other lines from aft forward.

    A ring, that ends on no boundary curve, begins and ends between its two nearest marks.
    Among the marks of each piece are the guides beside it.
    """
    state = edit.state
    axis = 2 if state.family(line).axis == 0 else 0
    marks = one_end_a_place(state, marks)
    trails = through_facets(state, marks, state.lines.normal[line])
    if trails is None:
        ordered = nearest_order(marks.xyz, marks.boundary == BoundaryKind.END, axis)
        return with_guides(state, line, [marks.take(piece) for piece in ordered])
    rings = [_opened(marks.xyz, ring) for ring in trails.rings if len(ring) >= _RING]
    name = state.lines.name[line]
    for ring in trails.rings:
        x, y, z = marks.xyz[ring].mean(axis=0).tolist()
        done = "begins and ends between two crossings" if len(ring) >= _RING else "is left out"
        edit.pending.notes.append(
            f"{name}: a ring of {len(ring)} meetings round ({x:.3f}, {y:.3f}, {z:.3f}) m {done}"
        )
    parts = _run_on(marks.xyz[:, axis], trails.open)
    found = [marks.take(part) for part in parts]
    found += [attrs.evolve(marks.take(ring), ring=True) for ring in rings]
    return with_guides(state, line, found)


def _opened(xyz: FloatArray, ring: IntArray) -> IntArray:
    """Let a ring begin and end at its two nearest neighbours."""
    step = xyz[ring] - xyz[np.roll(ring, 1)]
    return np.roll(ring, -int((step * step).sum(axis=1).argmin()))


def _run_on(along: FloatArray, trails: list[IntArray]) -> list[IntArray]:
    """Let every piece run on along an axis, and begin with the one that begins first."""
    ways = [trail if along[trail[0]] <= along[trail[-1]] else trail[::-1] for trail in trails]
    return sorted(ways, key=lambda way: float(along[way[0]]))


def _name_in_use(state: HullState, cut: CuttingPlane) -> str | None:
    """Give a new line the number by which its group counts; None where that is metres.

    Lines called ``WL 0.5``, ``WL 1`` at half the draught and at the draught are counted in
    draughts, and sections by stations: a new one in metres would stand among them under another
    measure. The measure is what at least `_AGREE` of the numbered names agree upon.
    """
    family = FAMILIES[state.groups.family[cut.group]]
    if family.axis is None:
        return None
    known = [
        (float(match[1]), float(state.lines.offset[line]))
        for line in state.live("lines").tolist()
        if state.lines.group[line] == cut.group
        and (match := re.fullmatch(rf"{family.prefix} (-?\d+(?:\.\d+)?)", state.lines.name[line]))
    ]
    numbers, places = np.array(known).reshape(-1, 2).T
    if len(np.unique(numbers)) < _AGREEING:
        return None
    order = np.argsort(numbers, kind="stable")
    steps, ways = np.diff(numbers[order]), np.diff(places[order])
    unit = float(np.median(ways[steps > 0.0] / steps[steps > 0.0]))
    zero = float(np.median(places - unit * numbers))
    off = np.abs(places - zero - unit * numbers)
    # Stations may be counted from forward: then places fall as numbers rise.
    if unit == 0.0 or (off < _ROUNDED * abs(unit)).mean() < _AGREE:
        return None
    if abs(unit - 1.0) < _ROUNDED and abs(zero) < _ROUNDED:
        return None
    taken = {state.lines.name[i] for i in state.live("lines") if state.lines.group[i] == cut.group}
    # As few digits as tell it from the others.
    wishes = (
        f"{family.prefix} {round((cut.offset - zero) / unit, digits) + 0.0:g}"
        for digits in range(3, 7)
    )
    return next((wish for wish in wishes if wish not in taken), None)


def _free_name(state: HullState, group: int, wish: str) -> str:
    taken = {state.lines.name[i] for i in state.live("lines") if state.lines.group[i] == group}
    return wish if wish not in taken else f"{wish} m"


def make_piece(
    edit: Transaction,
    line: int,
    marks: Marks,
    keep: float,
    curve: int | None = None,
    known: Mapping[tuple[int, int], int] | None = None,
    stays: KeptRuns = NO_KEPT_RUNS,
) -> int:
    """Make one curve of a line from marks in order along it, and give its number.

    Parameters
    ----------
    edit : Transaction
        The edit.
    line : int
        The line.
    marks : Marks
        Where it passes.
    keep : float, m
        Crossings define the old curves only where these move by no more than this.
    curve : int or None
        The curve to define; a new one if None.
    known : mapping of (int, int) to int, or None
        Crossings that are there already, by the other curve and the mark's `root`.
    stays : KeptRuns
        Runs of points that take the place of the marks on them.
    """
    state = edit.state
    kind, direction = _kinds(state, line, marks)
    ruled = _pick(state, line, marks, kind, direction)
    picked = required_marks(state, marks, kind, direction, ruled)
    run = stays.of(state, marks)
    # of a kept run the first and last mark stand for all its points, see `splice`
    picked |= (run >= 0) & ((np.roll(run, 1) != run) | (np.roll(run, -1) != run))
    if curve is None:
        curve = edit.maker.curve(line, Ends())
    chosen, run = marks.take(np.flatnonzero(picked)), run[picked]
    # What the rule did not choose ties no old curve: an adopted point stands at its place.
    roles = [
        role if ruled[i] else Role.WATCHED
        for i, role in zip(np.flatnonzero(picked), _roles(state, line, chosen, keep), strict=True)
    ]
    own = np.flatnonzero(~chosen.guide & (run < 0))
    specs = [
        _spec(state, curve, chosen, i, roles[i], int(kind[picked][i]), direction[picked][i])
        for i in own.tolist()
    ]
    rows = dict(zip(own.tolist(), _rows(edit, chosen.take(own), specs, known or {}), strict=True))
    adopted = [i for i, role in enumerate(roles) if role is Role.WATCHED and run[i] < 0]
    points = edit.maker.points([PointSpec(curve, chosen.xyz[i], Sort.ADOPTED) for i in adopted])
    # Over the crossing at the same mark, which is watched and defines nothing.
    rows |= dict(zip(adopted, points.tolist(), strict=True))
    order = [stays.stand_in(int(on)) if on >= 0 else rows[i] for i, on in enumerate(run)]
    # Before runs are put in: it goes by marks and points, one for one.
    order = _rounded(edit, curve, chosen, order)
    whole = stays.splice(state, order)
    # What lay between the first and the last mark of a run has given way to it.
    edit.maker.remove_rows(sorted({row for row in order if row >= 0} - set(whole)))
    edit.maker.define(curve, whole)
    # A shared crossing defines the old curve too; those of kept runs do so already.
    for i, role in enumerate(roles):
        if role is Role.SHARED and run[i] < 0:
            insert_defining_point(edit.maker, int(chosen.curve[i]), int(rows[i]))
            edit.pending.curves.add(int(chosen.curve[i]))
    return curve


def _rounded(edit: Transaction, curve: int, marks: Marks, rows: list[int]) -> list[int]:
    """Add points to the turns at which a new curve would fold, and where a ring closes."""
    state, line = edit.state, edit.state.line_of(curve)
    data = CurveData.single(marks.xyz, *_kinds(state, line, marks))
    if not len(curve_folds(loft(data))) and not marks.ring:
        return rows
    heading = headings(state, marks, state.lines.normal[line])
    turns = turning_points(data, heading)
    if marks.ring:
        close = ring_closing_point(marks.xyz, heading)
        turns = [(0, close), *turns, (len(rows), close)]
    points = [PointSpec(curve, _in_plane(state, line, at), Sort.ADOPTED) for _, at in turns]
    added = edit.maker.points(points)
    return np.insert(np.array(rows), [before for before, _ in turns], added).tolist()


def _in_plane(state: HullState, line: int, place: FloatArray) -> FloatArray:
    exact = state.lines.normal[line] == 1.0
    return np.where(exact, state.lines.offset[line], place)


def _rows(
    edit: Transaction,
    marks: Marks,
    specs: list[CrossingSpec],
    known: Mapping[tuple[int, int], int],
) -> list[int]:
    """Make crossings, or let those that are there already have a new place and role."""
    marked = zip(marks.curve.tolist(), marks.root.tolist(), strict=True)
    rows = [known.get(mark, -1) for mark in marked]
    new = iter(
        edit.maker.crossings([spec for spec, row in zip(specs, rows, strict=True) if row < 0])
    )
    for spec, row in zip(specs, rows, strict=True):
        if row >= 0:
            edit.maker.replace(row, spec)
    return [row if row >= 0 else int(next(new)) for row in rows]


def _kinds(
    state: HullState, line: int, marks: Marks
) -> tuple[np.typing.NDArray[np.int8], FloatArray]:
    """Give each mark its kind; at the border of a flat the direction lies in the flat.

    Where a line leaves the centre plane after running along it, it turns in a knuckle.
    """
    kind = np.zeros(len(marks.curve), np.int8)
    flat = marks.boundary == BoundaryKind.FLAT
    flat &= state.lines.planar[state.curves.line[marks.curve]]
    kind[flat] = PointKind.TANGENT
    kind[marks.boundary == BoundaryKind.KNUCKLE] = PointKind.KNUCKLE
    direction = np.zeros((len(marks.curve), 3))
    for i in np.flatnonzero(flat).tolist():
        border = state.lines.normal[state.line_of(int(marks.curve[i]))]
        along = np.cross(border, state.lines.normal[line])
        chord = marks.xyz[min(i + 1, len(kind) - 1)] - marks.xyz[max(i - 1, 0)]
        direction[i] = along if float(along @ chord) >= 0.0 else -along
    kind[_leaving(marks.xyz[:, 1] == 0.0)] = PointKind.KNUCKLE
    return kind, direction


def _leaving(central: np.typing.NDArray[np.bool_]) -> IntArray:
    """Give the marks at which a line that begins or ends along the centre plane leaves it.

    A waterline runs so along the top of a cylinder that it touches, before it turns outward.
    """
    off = np.flatnonzero(~central)
    if not len(off):
        return off
    ends = np.array([off[0] - 1, off[-1] + 1])
    return ends[[off[0] > 1, off[-1] < len(central) - 2]]


def _pick(
    state: HullState,
    line: int,
    marks: Marks,
    kind: np.typing.NDArray[np.int8],
    direction: FloatArray,
) -> np.typing.NDArray[np.bool_]:
    """Apply the role rule on the new line to the marks it is cut from.

    A mark on a curve that runs along the new plane slides by decimetres in an edit of
    centimetres, so it is given the room to.
    """
    given = ~marks.guide
    marks = marks.take(np.flatnonzero(given))
    spline = loft(CurveData.single(marks.xyz, kind[given], direction[given]))
    slope = derivative(spline, np.zeros(len(marks.curve), np.int64), spline.knot)
    tangent = slope / np.sqrt((slope * slope).sum(axis=1))[:, None]
    normal = state.lines.normal[state.curves.line[marks.curve]]
    sine = np.minimum(np.abs((tangent * normal).sum(axis=1)), 1.0)
    theirs = tangents(state, marks.curve, marks.at) * state.lines.normal[line]
    slide = state.tolerances.factor * _SLIDE / np.maximum(np.abs(theirs.sum(axis=1)), 0.1)
    fixed = _held(state, marks.curve, marks.boundary)
    fixed[[0, -1]] = True
    angle = np.degrees(np.arcsin(sine))
    ruled = given.copy()
    ruled[given] = choose(Candidates(spline.knot, angle, tangent, fixed, slide), state.tolerances)
    return ruled


def _held(state: HullState, curve: IntArray, boundary: IntArray) -> np.typing.NDArray[np.bool_]:
    """Tell at which curves a new line is always made: boundary curves, and space curves."""
    planar = state.lines.planar[state.curves.line[curve]]
    return np.asarray((boundary >= 0) | ~planar)


def _roles(state: HullState, line: int, marks: Marks, keep: float) -> list[Role]:
    """Give the role of each chosen mark: all define the new line, some the old curve too."""
    may = _old_may(state, line, marks, keep)
    rank = state.family(line).rank
    roles: list[Role] = []
    for i, curve in enumerate(marks.curve.tolist()):
        if marks.root[i] == NO_ROOT:
            roles.append(Role.SHARED)
            continue
        old = state.line_of(curve)
        lower = state.family(old).rank < rank
        old_gives, new_gives = generates(state, old, line, marks.xyz[i])
        if may[i] and old_gives and new_gives:
            roles.append(Role.SHARED)
        elif old_gives and (lower or not new_gives):
            roles.append(Role.DRIVES_B if lower else Role.DRIVES_A)
        else:
            roles.append(Role.WATCHED)
    return roles


def _old_may(state: HullState, line: int, marks: Marks, keep: float) -> np.typing.NDArray[np.bool_]:
    """Tell which old curves their mark may define: transversal, with room, moved within `keep`."""
    slope = tangents(state, marks.curve, marks.at)
    sine = np.minimum(np.abs(slope @ state.lines.normal[line]), 1.0)
    may: np.typing.NDArray[np.bool_] = (
        np.degrees(np.arcsin(sine)) >= state.tolerances.transversal_deg
    )
    some = np.flatnonzero(may)
    moved, room = deviation_with(state, marks.curve[some], marks.xyz[some])
    may[some] = (moved <= keep) & (room >= state.tolerances.spacing)
    return may


def _spec(
    state: HullState, curve: int, marks: Marks, i: int, role: Role, kind: int, direction: FloatArray
) -> CrossingSpec:
    other = int(marks.curve[i])
    contact = bool(_held(state, marks.curve[[i]], marks.boundary[[i]])[0])
    if state.rank(other) < state.rank(curve):
        return CrossingSpec(
            other, curve, marks.xyz[i], role, int(marks.sign[i]), None, contact, kind, direction
        )
    return CrossingSpec(curve, other, marks.xyz[i], role, int(marks.sign[i]))
