"""Adoption: a net from given lines.

The lines are lofted through their own points (the *references*), their crossings found,
each crossing given its role by the role rule, and points added only where crossings alone
do not hold the shape within the tolerance. The order in which lines are handed in plays no
part: they are sorted first.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from assoc_hull.arguments import all_of, instance
from assoc_hull.edit.adoption.match_crossings import Contact, Meeting, find_contacts, find_meetings
from assoc_hull.edit.adoption.report import AdoptionReport, LineReport, report_lines
from assoc_hull.edit.adoption.thin import thin
from assoc_hull.edit.adoption.thinning_state import Left, Net, Thinned
from assoc_hull.edit.followup.adopted_points import ride_links
from assoc_hull.edit.followup.find_features import find_features
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import SplineBatch
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.graph.journal import Journal
from assoc_hull.model.kinds import FAMILIES, Sort
from assoc_hull.model.line_source import LineSource, curve_data
from assoc_hull.model.loft_hull import loft_all, set_limits
from assoc_hull.model.make_objects import CrossingSpec, Maker, PointSpec
from assoc_hull.model.state import Association, HullState, Particulars
from assoc_hull.tolerance import Tolerances

__all__ = ["AdoptionReport", "adopt", "source_order", "where_they_meet"]


_OVER = 1.05
"""Between its points a curve may pass its line by this part more than at them."""


def adopt(
    sources: Sequence[LineSource],
    particulars: Particulars,
    associations: Sequence[Association],
    tolerances: Tolerances | None = None,
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
    ordered = sorted(sources, key=source_order)
    _make_lines(maker, ordered, associations)
    reference = loft(curve_data(ordered), list(state.curves.key.data))
    net = Net(state, tuple(ordered), reference, *_matches(state, ordered, reference))
    thinned = thin(net)
    notes = _write(maker, net, thinned)
    notes += _loft(maker)
    ride_links(state, state.live("curves"), journal)
    set_limits(state, journal)
    maker.features(find_features(state, [float(np.max(each.tolerance)) for each in ordered]))
    lines = report_lines(net)
    return state, AdoptionReport(lines, (*notes, *_over_notes(net, thinned, lines)))


def where_they_meet(
    sources: Sequence[LineSource], associations: Sequence[Association]
) -> tuple[SplineBatch, tuple[Meeting, ...]]:
    """Find where given lines meet, without adopting them.

    Parameters
    ----------
    sources : sequence of LineSource
        The lines; curves of the answer are numbered in their order.
    associations : sequence of Association
        Which groups meet.

    Returns
    -------
    SplineBatch, tuple of Meeting
        The splines through the given points, and their meetings.
    """
    state = HullState(Particulars("lines", 1.0, 1.0, 1.0, 1.0), Tolerances())
    _make_lines(Maker(state, Journal()), sources, associations)
    reference = loft(curve_data(sources), list(state.curves.key.data))
    return reference, tuple(find_meetings(state, reference))


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
) -> tuple[tuple[Contact, ...], tuple[Meeting, ...]]:
    contacts = find_contacts(state, reference, [source.kind for source in sources])
    return tuple(contacts), tuple(find_meetings(state, reference))


def _write(maker: Maker, net: Net, thinned: Thinned) -> list[str]:
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


def _left_note(net: Net, left: Left) -> str:
    x, y, z = net.sources[left.curve].points[left.point].tolist()
    name = net.state.lines.name.data[net.state.line_of(left.curve)]
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


def _over_notes(net: Net, thinned: Thinned, lines: Sequence[LineReport]) -> list[str]:
    """Name the densely drawn lines that are passed too far off and of which no point says so."""
    told = {each.curve for each in thinned.left}
    return [
        f"{line.line} is passed by {line.tolerance_used:.2f} times what is allowed at some place: "
        "no point could be adopted there, another stands too close"
        for number, line in enumerate(lines)
        if line.tolerance_used > _OVER and net.sources[number].dense and number not in told
    ]


def _loft(maker: Maker) -> list[str]:
    """Loft; a crossing that its driver no longer reaches becomes an adopted point."""
    notes: list[str] = []
    while True:
        missing = loft_all(maker.state, maker.journal)
        if not len(missing):
            return notes
        for row in missing.tolist():
            notes.append(f"{maker.state.rows.key.data[row]}: not reached, left out")
            _release(maker, row)


def _release(maker: Maker, row: int) -> None:
    """Take out a crossing; the curve it defined keeps an adopted point at its place."""
    table = maker.state.rows
    curves = [curve for curve in table.reader.data[row].tolist() if curve >= 0]
    xyz = table.xyz.data[row].copy()
    for curve in curves:
        point = maker.points([PointSpec(curve, xyz, Sort.ADOPTED)])[0]
        rows = maker.state.curves.rows.data[curve]
        maker.define(curve, np.where(rows == row, point, rows))
    maker.remove_rows([row])
