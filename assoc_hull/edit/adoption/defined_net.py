"""The net of lines whose defining points are known: those of a net that was written and is read.

Nothing is chosen and nothing is added: each point tells which line it was a crossing with, or that
it was placed or adopted. So every curve is made through the points it was made through before, and
a crossing has the role that follows from the curves that it defines.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.edit.adoption.match_crossings import snap_to_coordinate_planes
from assoc_hull.edit.adoption.thinning_state import PointItem, ReferenceNet, ThinnedNet
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.make_objects import Maker

__all__ = ["are_defined", "defined_net", "write_kinds"]

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
