"""Make a net of given lines, or of lines whose defining points are known, with a report.

The lines are lofted through their own points (the *references*), their crossings are found and
given roles by the role rule, and points are added only where crossings alone do not hold the shape
within the tolerance. The order in which lines are handed in plays no part: they are sorted first.
The report says per curve how far it passes its line, with how many points, and how fair it is.

The net of lines whose defining points are known: those of a net that was written and is read.

Nothing is chosen and nothing is added: each point tells which line it was a crossing with, or that
it was placed or adopted. So every curve is made through the points it was made through before, and
a crossing has the role that follows from the curves that it defines.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.arguments import all_of, instance
from assoc_hull.edit.adoption.match_crossings import (
    Contact,
    LineIntersection,
    find_contacts,
    find_line_intersections,
    snap_to_coordinate_planes,
)
from assoc_hull.edit.adoption.thin_net import thin_net
from assoc_hull.edit.adoption.thinning_state import (
    OmittedPoint,
    PointItem,
    ReferenceNet,
    ThinnedNet,
    brought_back,
    grown_sources,
    grown_tolerances,
)
from assoc_hull.edit.crossings.adopted_points import link_adopted_points
from assoc_hull.edit.followup.settle_features import find_features
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.fairness.inflections import inflections
from assoc_hull.geometry.splines.distance import closest_points_each
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.segments import evaluate
from assoc_hull.graph.journal import Journal
from assoc_hull.model.address import address
from assoc_hull.model.kinds import FAMILIES, Role, Sort
from assoc_hull.model.line_source import LineSource, line_curve_data
from assoc_hull.model.loft_hull import loft_all, set_limits
from assoc_hull.model.make_objects import CrossingSpec, Maker, PointSpec
from assoc_hull.model.tables import Association, HullState, Particulars
from assoc_hull.tolerance import Tolerances

__all__ = [
    "OVER",
    "AdoptionReport",
    "LineReport",
    "adopt",
    "are_defined",
    "defined_net",
    "match_lines",
    "report_lines",
    "source_order",
    "write_kinds",
]

_SAME = 1e-6
"""A crossing this near (m) to a point is that point: two points of a curve lie farther apart."""

_ROLES = {(True, True): Role.SHARED, (True, False): Role.DRIVES_A, (False, True): Role.DRIVES_B}

Side = tuple[int, int]
"""A contact or meeting, by its number, and the side of it: 0 of curve a, 1 of curve b."""


def are_defined(sources: Sequence[LineSource]) -> bool:
    """Tell whether lines know what their points were.

    Raises
    ------
    BadInputError
        Some do and some do not.
    """
    known = [source.origin is not None for source in sources]
    if any(known) and not all(known):
        name = sources[known.index(False)].name
        raise BadInputError(
            f"{known.count(False)} of {len(known)} lines do not tell what their points were",
            f"in {name}", "give origins for all lines or for none",
        )  # fmt: skip
    return all(known)


def defined_net(net: ReferenceNet) -> tuple[ReferenceNet, ThinnedNet, int]:
    """Give crossings their roles by the points that they define.

    Gives the net with those contacts that define their line, the outcome, and how many points were
    crossings and are none here.
    """
    held = _held(net)
    sides = set(held.values())
    contacts = len(net.contacts)
    # A contact defines the line that ends, turns or leaves a flat there, or it is none.
    kept = [i for i in range(contacts) if (i, 1) in sides]
    kept += range(contacts, contacts + len(net.meetings))
    number = {old: new for new, old in enumerate(kept)}
    first = len(kept)
    roles = [_ROLES.get(((i, 0) in sides, (i, 1) in sides), Role.WATCHED) for i in kept]
    points: list[PointItem] = []
    order: list[tuple[int, ...]] = []
    lost = 0
    for curve, source in enumerate(net.sources):
        mine = []
        for point, origin in enumerate(source.origin or ()):
            known = number.get(held.get((curve, point), (-1, 0))[0])
            if known is None:
                lost += not isinstance(origin, Sort)
                known = first + len(points)
                points.append(_own(source, curve, point, placed=origin == Sort.PLACED))
            mine.append(known)
        order.append(tuple(mine))
    exact = _exact(net, held)
    count = sum(i < contacts for i in kept)
    found = attrs.evolve(
        exact, contacts=tuple(exact.contacts[i] for i in kept[:count]), meetings=exact.meetings
    )
    outcome = ThinnedNet(
        tuple(roles[:count]), tuple(roles[count:]), tuple(points), tuple(order), ()
    )
    return found, outcome, lost


def write_kinds(maker: Maker, net: ReferenceNet) -> None:
    """Give all defining points the kinds and directions of the lines: adoption knows one side."""
    table, curves = maker.state.rows, maker.state.curves
    for curve, source in enumerate(net.sources):
        rows, side = curves.rows[curve], curves.side[curve]
        kind, direction = table.kind[rows].copy(), table.direction[rows].copy()
        at = np.arange(len(rows))
        kind[at, side], direction[at, side] = source.kind, source.direction
        maker.journal.put(table.kind, rows, kind)
        maker.journal.put(table.direction, rows, direction)


def _held(net: ReferenceNet) -> dict[tuple[int, int], Side]:
    """Find the crossing that each point was, by curve and point."""
    near = _candidates(net)
    held: dict[tuple[int, int], Side] = {}
    taken: set[Side] = set()
    for curve, source in enumerate(net.sources):
        for point, origin in enumerate(source.origin or ()):
            if isinstance(origin, Sort):
                continue
            place = source.points[point]
            found = [
                (float(np.abs(xyz - place).max()), side)
                for xyz, side, only in near[curve, origin]
                if side not in taken and only in (-1, point)
            ]
            best = min(found, default=(np.inf, (-1, 0)))
            if best[0] <= _SAME:
                held[curve, point] = best[1]
                taken.add(best[1])
    return held


def _candidates(
    net: ReferenceNet,
) -> defaultdict[tuple[int, tuple[str, str]], list[tuple[FloatArray, Side, int]]]:
    """List crossings by curve and line on the other side: place, side, the point it is bound to."""
    name = [(source.group, source.name) for source in net.sources]
    found: defaultdict[tuple[int, tuple[str, str]], list[tuple[FloatArray, Side, int]]]
    found = defaultdict(list)
    for i, contact in enumerate(net.contacts):
        found[contact.boundary, name[contact.curve]].append((contact.xyz, (i, 0), -1))
        found[contact.curve, name[contact.boundary]].append((contact.xyz, (i, 1), contact.point))
    for i, meeting in enumerate(net.meetings, len(net.contacts)):
        found[meeting.a, name[meeting.b]].append((meeting.spots[0], (i, 0), -1))
        found[meeting.b, name[meeting.a]].append((meeting.spots[1], (i, 1), -1))
    return found


def _exact(net: ReferenceNet, held: dict[tuple[int, int], Side]) -> ReferenceNet:
    """Put crossings to the very places of the points: where two meet was found to rounding only."""
    state = net.state
    given = {side: net.sources[curve].points[point] for (curve, point), side in held.items()}

    def place(number: int, a: int, b: int) -> FloatArray | None:
        found = given.get((number, 0), given.get((number, 1)))
        if found is None:
            return None
        # The last bit of a spline at its knot must not lead out of a plane.
        return snap_to_coordinate_planes(state, (state.line_of(a), state.line_of(b)), found)

    contacts = []
    for number, each in enumerate(net.contacts):
        found = place(number, each.boundary, each.curve)
        contacts.append(each if found is None else attrs.evolve(each, xyz=found))
    meetings = []
    for number, meeting in enumerate(net.meetings, len(contacts)):
        found = place(number, meeting.a, meeting.b)
        same = meeting if found is None else attrs.evolve(meeting, spots=(found, found))
        meetings.append(same)
    return attrs.evolve(net, contacts=tuple(contacts), meetings=tuple(meetings))


def _own(source: LineSource, curve: int, point: int, *, placed: bool) -> PointItem:
    return PointItem(
        curve, source.points[point], placed, int(source.kind[point]), source.direction[point]
    )


# --------------------------------------------------------------------------------------
# The report.


@attrs.frozen
class LineReport:
    """How one curve was adopted.

    Attributes
    ----------
    curve : str
        Key of the curve.
    group, line : str
        The line it belongs to; a line in several pieces has several curves.
    given, defining : int
        Points given, and points that define the curve.
    crossings, adopted, placed : int
        The defining points by sort; together they are `defining`.
    deviation : float, m
        Largest distance of a given point from the curve; of a densely drawn line, of a place
        half-way between two points, too.
    deviation_median, deviation_p95 : float, m
        Half, and 19 of 20, of the given points lie this close.
    place : (float, float, float), m
        The given point that lies farthest off.
    tolerance : float, m
        How far the curve may pass that point.
    tolerance_used : float
        The largest part of what is allowed, at any place: up to 1 the curve is within.
    inflections_given, inflections : int
        Of the given line and of the curve; 0 for a space curve, whose curvature has no sign.
    """

    curve: str
    group: str
    line: str
    given: int
    defining: int
    crossings: int
    adopted: int
    placed: int
    deviation: float
    deviation_median: float
    deviation_p95: float
    place: tuple[float, float, float]
    tolerance: float
    tolerance_used: float
    inflections_given: int
    inflections: int


@attrs.frozen
class AdoptionReport:
    """What adoption made of the given lines; notes say what was assumed or left out.

    Attributes
    ----------
    lines : tuple of LineReport
        Curve by curve.
    notes : tuple of str
        What was assumed, and what was left out.
    unused : tuple of str
        Numbers of the file that the net has no place for: whoever drew them should know.
    """

    lines: tuple[LineReport, ...]
    notes: tuple[str, ...]
    unused: tuple[str, ...] = ()

    @property
    def worst(self) -> LineReport:
        """The curve with the largest deviation."""
        return max(self.lines, key=lambda each: each.deviation)

    @property
    def own_points(self) -> int:
        """Adopted points: those that define a curve and that no crossing holds."""
        return sum(each.adopted for each in self.lines)

    @property
    def inflections(self) -> tuple[int, int]:
        """Inflections of the given lines in all, and those that the net has more, by line."""
        lines: dict[tuple[str, str], list[LineReport]] = defaultdict(list)
        for each in self.lines:
            lines[each.group, each.line].append(each)
        more = (
            sum(each.inflections - each.inflections_given for each in mine)
            for mine in lines.values()
        )
        given = sum(each.inflections_given for each in self.lines)
        return given, sum(max(0, count) for count in more)


def report_lines(net: ReferenceNet) -> tuple[LineReport, ...]:
    """Compare the curves of a net with the lines it was adopted from."""
    splines = SplineBatch.join([net.state.spline(i) for i in range(len(net.sources))])
    normals = np.array(
        [np.full(3, np.nan) if each.normal is None else each.normal for each in net.sources]
    )
    bends = (inflections(batch, normals)[0] for batch in (net.reference, splines))
    given, found = bends
    away = _away(net, splines)
    return tuple(
        _line(net, i, away[i], int(given[i]), int(found[i])) for i in range(len(net.sources))
    )


def _away(net: ReferenceNet, splines: SplineBatch) -> list[FloatArray]:
    """Give how far each curve passes the points it is measured at, m."""
    points = [_measured(net, i)[0] for i in range(len(net.sources))]
    sizes = [len(each) for each in points]
    curve = np.repeat(np.arange(len(points)), sizes)
    away = closest_points_each(splines, curve, np.concatenate(points))[2]
    return np.split(away, np.cumsum(sizes)[:-1])


def _line(net: ReferenceNet, number: int, away: FloatArray, given: int, found: int) -> LineReport:
    state, source = net.state, net.sources[number]
    crossings, adopted, placed = _sorts(state, state.curves.rows[number])
    points, tolerance = _measured(net, number)
    worst = int(np.argmax(away))
    x, y, z = points[worst].tolist()
    return LineReport(
        state.curves.key[number], source.group, source.name, len(source.points),
        crossings + adopted + placed, crossings, adopted, placed, float(away[worst]),
        float(np.median(away)), float(np.percentile(away, 95.0)), (x, y, z),
        float(tolerance[worst]), float((away / tolerance).max()), given, found,
    )  # fmt: skip


def _measured(net: ReferenceNet, number: int) -> tuple[FloatArray, FloatArray]:
    """Give places of a line and how far they may be passed: of a dense one, between points too."""
    source = net.sources[number]
    tolerance = np.broadcast_to(source.tolerance, len(source.points)).astype(np.float64)
    if not source.dense:
        return source.points, tolerance
    knot = net.reference.curve(number).knot
    at = np.sort(np.concatenate([knot, 0.5 * (knot[1:] + knot[:-1])]))
    points = evaluate(net.reference, np.full(len(at), number), at)
    return points, np.interp(at, knot, tolerance)


def _sorts(state: HullState, rows: IntArray) -> tuple[int, int, int]:
    """Count the points of a curve: crossings, adopted and placed ones."""
    sort = state.rows.sort[rows]
    adopted, placed = int((sort == Sort.ADOPTED).sum()), int((sort == Sort.PLACED).sum())
    return len(rows) - adopted - placed, adopted, placed


# --------------------------------------------------------------------------------------
# Adoption.

OVER = 1.05
"""Between its points a curve may pass its line by this part more than at them."""


def adopt(
    sources: Sequence[LineSource],
    particulars: Particulars,
    associations: Sequence[Association],
    tolerances: Tolerances | None = None,
    grown: Sequence[LineSource] | None = None,
) -> tuple[HullState, AdoptionReport]:
    """Make a net of given lines.

    Parameters
    ----------
    sources : sequence of LineSource
        The lines, in any order.
    particulars : Particulars
        Principal dimensions.
    associations : sequence of Association
        Which groups generate points on which, in any order.
    tolerances : Tolerances or None
        Defaults if None.
    grown : sequence of LineSource or None
        Of a hull under 100 m the same lines, in the same order, at 100 m: what defines a curve is
        chosen there, so that it is the same at any size. By default they are made of `sources`.

    Returns
    -------
    HullState, AdoptionReport

    Raises
    ------
    BadInputError
        No lines, or an association with a group that has none.
    RingError
        One-way associations that run in a ring.
    """
    sources = all_of(sources, LineSource, "lines", "in a net of lines")
    instance(particulars, Particulars, "particulars", "in a net of lines")
    associations = all_of(associations, Association, "associations", "in a net of lines")
    if tolerances is not None:
        instance(tolerances, Tolerances, "tolerances", "in a net of lines")
    if not sources:
        raise BadInputError("no lines were given", particulars.name, "give two lines or more")
    state = HullState(particulars, tolerances or Tolerances())
    journal = Journal()
    maker = Maker(state, journal)
    factor = state.tolerances.factor
    full = list(grown_sources(sources, factor) if grown is None else grown)
    order = sorted(range(len(full)), key=lambda i: source_order(full[i]))
    ordered, full = [sources[i] for i in order], [full[i] for i in order]
    _make_lines(maker, ordered, associations)
    reference = loft(line_curve_data(ordered), list(state.curves.key.data))
    if are_defined(ordered):
        net = ReferenceNet(state, tuple(ordered), reference, *_matches(state, ordered, reference))
        net, notes = _write_defined(maker, net)
        thinned, allowed = None, [state.tolerances.adoption] * len(ordered)
    else:
        net, thinned = _thinned(state, ordered, full, reference, associations)
        allowed = [float(np.max(each.tolerance)) for each in ordered]
        notes = _write(maker, net, thinned)
    notes += _loft(maker)
    link_adopted_points(state, state.live("curves"), journal)
    set_limits(state, journal)
    maker.features(find_features(state, allowed))
    lines = report_lines(net)
    return state, AdoptionReport(lines, (*notes, *_over_notes(net, thinned, lines)))


def _thinned(
    state: HullState,
    sources: Sequence[LineSource],
    full: Sequence[LineSource],
    reference: SplineBatch,
    associations: Sequence[Association],
) -> tuple[ReferenceNet, ThinnedNet]:
    """Match lines and choose what defines them, at full size; gives the net at its own."""
    if full[0] is sources[0]:
        net = ReferenceNet(state, tuple(sources), reference, *_matches(state, sources, reference))
        return net, thin_net(net)
    grown = HullState(state.particulars, grown_tolerances(state.tolerances))
    _make_lines(Maker(grown, Journal()), full, associations)
    lofted = loft(line_curve_data(full), list(grown.curves.key.data))
    net = ReferenceNet(grown, tuple(full), lofted, *_matches(grown, full, lofted))
    return brought_back(net, thin_net(net), state, sources, reference)


def _write_defined(maker: Maker, net: ReferenceNet) -> tuple[ReferenceNet, list[str]]:
    """Write a net whose lines know their defining points; gives it with its crossings."""
    found, outcome, lost = defined_net(net)
    notes = _write(maker, found, outcome)
    write_kinds(maker, found)
    if lost:
        notes.append(f"{lost} points were crossings and are adopted points now: none lies there")
    return found, notes


def match_lines(
    sources: Sequence[LineSource], associations: Sequence[Association]
) -> tuple[SplineBatch, tuple[LineIntersection, ...]]:
    """Find where given lines meet, without adopting them.

    Gives the splines through their points, numbered in the order of the lines, and the
    intersections of those whose groups are associated.
    """
    # the particulars are placeholders: crossings do not depend on them
    state = HullState(Particulars("lines", 1.0, 1.0, 1.0, 1.0), Tolerances())
    _make_lines(Maker(state, Journal()), sources, associations)
    reference = loft(line_curve_data(sources), list(state.curves.key.data))
    return reference, tuple(find_line_intersections(state, reference))


def source_order(source: LineSource) -> tuple[int, str, float, str, bytes]:
    """Give what lines are sorted by, content alone: the order of input changes nothing."""
    offset = source.offset if source.normal is not None else 0.0
    rank = FAMILIES[source.family].rank
    return rank, source.group, offset, source.name, source.points.tobytes()


def _make_lines(
    maker: Maker, sources: Sequence[LineSource], associations: Sequence[Association]
) -> None:
    groups: dict[str, int] = {}
    lines: dict[tuple[str, str], int] = {}
    wanted = {source.group: source.family for source in sources}
    linked = {name for link in associations for name in (link.a, link.b)}
    wanted |= {name: name for name in linked - set(wanted) if name in FAMILIES}
    for name in sorted(wanted, key=lambda each: (FAMILIES[wanted[each]].rank, each)):
        groups[name] = maker.group(name, wanted[name])
    for source in sources:
        if (source.group, source.name) not in lines:
            plane = None if source.normal is None else (source.normal, source.offset)
            boundary = -1 if source.boundary is None else int(source.boundary)
            lines[source.group, source.name] = maker.line(
                groups[source.group], source.name, plane, boundary
            )
        maker.curve(lines[source.group, source.name], source.ends)
    for link in sorted(associations, key=lambda each: (each.a, each.b)):
        maker.associate(link)


def _matches(
    state: HullState, sources: Sequence[LineSource], reference: SplineBatch
) -> tuple[tuple[Contact, ...], tuple[LineIntersection, ...]]:
    contacts = find_contacts(state, reference, [source.kind for source in sources])
    return tuple(contacts), tuple(find_line_intersections(state, reference))


def _write(maker: Maker, net: ReferenceNet, thinned: ThinnedNet) -> list[str]:
    """Write the chosen crossings and points into the tables; say what was left out."""
    specs = [
        CrossingSpec(
            contact.boundary, contact.curve, contact.xyz, role, contact.sign, None, True,
            int(net.sources[contact.curve].kind[contact.point]),
            net.sources[contact.curve].direction[contact.point],
        )
        for contact, role in zip(net.contacts, thinned.contact_role, strict=True)
    ]  # fmt: skip
    specs += [
        CrossingSpec(meeting.a, meeting.b, meeting.spots[0], role, meeting.sign, meeting.spots)
        for meeting, role in zip(net.meetings, thinned.meeting_role, strict=True)
    ]
    rows = maker.crossings(specs)
    points = [
        PointSpec(
            item.curve,
            item.xyz,
            Sort.PLACED if item.placed else Sort.ADOPTED,
            item.kind,
            item.direction,
        )
        for item in thinned.points
    ]
    own = maker.points(points)
    numbers = np.concatenate([rows, own])
    for curve, order in enumerate(thinned.order):
        maker.define(curve, numbers[np.array(order, np.int64)])
    return [_left_note(net, each) for each in thinned.left]


def _left_note(net: ReferenceNet, left: OmittedPoint) -> str:
    x, y, z = net.sources[left.curve].points[left.point].tolist()
    name = net.state.lines.name[net.state.line_of(left.curve)]
    near = np.broadcast_to(net.sources[left.curve].tolerance, len(net.sources[left.curve].points))
    over = (
        f"{name} passes the given point ({x:.3f}, {y:.3f}, {z:.3f}) m {1e3 * left.away:.1f} mm "
        f"off, over its tolerance of {1e3 * float(near[left.point]):g} mm: "
    )
    if left.bends:
        return over + "a point there would give it an inflection that the given line lacks"
    return over + (
        f"it lies {1e3 * left.beside:.1f} mm beside a point of the curve, closer than "
        f"{net.state.tolerances.adopted_spacing:g} m; the lines disagree there, mend the one "
        "that is wrong"
    )


def _over_notes(
    net: ReferenceNet, thinned: ThinnedNet | None, lines: Sequence[LineReport]
) -> list[str]:
    """Name the densely drawn lines that are passed too far off and have no note for a point."""
    noted = set() if thinned is None else {each.curve for each in thinned.left}
    return [
        f"{line.line} is passed by {line.tolerance_used:.2f} times what is allowed at some place: "
        "no point could be adopted there, another stands too close"
        for number, line in enumerate(lines)
        if line.tolerance_used > OVER and net.sources[number].dense and number not in noted
    ]


def _loft(maker: Maker) -> list[str]:
    """Loft; a crossing that its driver no longer reaches becomes an adopted point."""
    notes: list[str] = []
    table = maker.state.rows
    # Where a stem runs upright in the plane of a section, its passage may be the run's other end.
    along = np.flatnonzero(table.alive.data & table.contact.data & (table.sign.data == 0))
    given, near = table.xyz[along].copy(), maker.state.tolerances.adoption
    while True:
        missing = loft_all(maker.state, maker.journal)
        away = np.abs(table.xyz[along] - given).max(axis=1, initial=0.0)
        missing = np.union1d(missing, along[table.alive[along] & (away > near)])
        if not len(missing):
            return notes
        places = dict(zip(along.tolist(), given, strict=True))
        for row in missing.tolist():
            notes.append(f"{address(maker.state, row)}: not reached, left out")
            _release(maker, row, places.get(row, table.xyz[row].copy()))


def _release(maker: Maker, row: int, xyz: FloatArray) -> None:
    """Take out a crossing; the curve it defined keeps an adopted point at its place (m)."""
    table = maker.state.rows
    curves = [curve for curve in table.reader[row].tolist() if curve >= 0]
    for curve in curves:
        point = maker.points([PointSpec(curve, xyz, Sort.ADOPTED)])[0]
        rows = maker.state.curves.rows[curve]
        maker.define(curve, np.where(rows == row, point, rows))
    maker.remove_rows([row])
