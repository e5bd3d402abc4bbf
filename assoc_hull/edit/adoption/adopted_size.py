"""Lines of a short hull adopted at 100 m: grown before, and what was chosen brought back.

Which crossings and points define a curve hangs on comparisons by the hundred. Made at one size for
all hulls, of lines that are the same to the last bit, they come out the same.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.edit.adoption.match_crossings import (
    Contact,
    LineIntersection,
    snap_to_coordinate_planes,
)
from assoc_hull.edit.adoption.thinning_state import (
    OmittedPoint,
    PointItem,
    ReferenceNet,
    ThinnedNet,
)
from assoc_hull.geometry.curves import FloatArray, SplineBatch, freeze
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.tables import HullState
from assoc_hull.tolerance import Tolerances, at_full_length

__all__ = ["brought_back", "grown_sources", "grown_tolerances"]


def grown_sources(sources: Sequence[LineSource], factor: float) -> Sequence[LineSource]:
    """Give lines at 100 m, decimals as decimals; the lines themselves where the factor is 1."""
    return sources if factor == 1.0 else [_grown(each, factor) for each in sources]


def _grown(source: LineSource, factor: float) -> LineSource:
    points = at_full_length(source.points, factor)
    near = at_full_length(source.tolerance, factor)
    freeze(points, near)
    return attrs.evolve(
        source, points=points, offset=float(at_full_length(source.offset, factor)),
        tolerance=near if near.ndim else float(near),
    )  # fmt: skip


def grown_tolerances(tolerances: Tolerances) -> Tolerances:
    """Give the tolerances of the hull at 100 m."""
    factor = tolerances.factor
    grown = tolerances.scaled(1.0 / factor)
    lengths = {
        name: float(at_full_length(getattr(tolerances, name), factor))
        for name in attrs.asdict(grown) if getattr(grown, name) != getattr(tolerances, name)
    }  # fmt: skip
    return attrs.evolve(grown, **lengths)


def brought_back(
    net: ReferenceNet,
    thinned: ThinnedNet,
    state: HullState,
    sources: Sequence[LineSource],
    reference: SplineBatch,
) -> tuple[ReferenceNet, ThinnedNet]:
    """Give a net of grown lines, and what was chosen, at the size of a hull's own lines.

    `state` holds the lines and tolerances of the hull, `reference` the splines of `sources`.
    """
    factor = state.tolerances.factor
    own = ReferenceNet(
        state, tuple(sources), reference,
        tuple(_contact(net, each, state, sources, factor) for each in net.contacts),
        tuple(_meeting(each, state, factor) for each in net.meetings),
    )  # fmt: skip
    points = tuple(
        attrs.evolve(each, xyz=_given_place(net, each, sources)) for each in thinned.points
    )
    left = tuple(_left(each, factor) for each in thinned.left)
    return own, attrs.evolve(thinned, points=points, left=left)


def _contact(
    net: ReferenceNet,
    contact: Contact,
    state: HullState,
    sources: Sequence[LineSource],
    factor: float,
) -> Contact:
    """Bring a contact back; where it is the very point of its line it stays that."""
    given = net.sources[contact.curve].points[contact.point]
    mine = sources[contact.curve].points[contact.point]
    place = np.where(contact.xyz == given, mine, factor * contact.xyz)
    xyz = _in_planes(state, (contact.boundary, contact.curve), place)
    return attrs.evolve(contact, at=factor * contact.at, xyz=xyz)


def _meeting(meeting: LineIntersection, state: HullState, factor: float) -> LineIntersection:
    first, second = (
        _in_planes(state, (meeting.a, meeting.b), factor * each) for each in meeting.spots
    )
    at = (factor * meeting.at[0], factor * meeting.at[1])
    return attrs.evolve(meeting, at=at, spots=(first, second), gap=factor * meeting.gap)


def _in_planes(state: HullState, curves: tuple[int, int], place: FloatArray) -> FloatArray:
    """Put a place exactly into the planes of two curves, as it is at 100 m."""
    lines = tuple(
        line for line in map(state.line_of, curves) if state.lines.planar[line]
    )  # fmt: skip
    return snap_to_coordinate_planes(state, lines, place)


def _given_place(net: ReferenceNet, point: PointItem, sources: Sequence[LineSource]) -> FloatArray:
    """Give the point of a hull's own line that was adopted at 100 m."""
    grown = net.sources[point.curve].points
    number = int(np.flatnonzero((grown == point.xyz).all(axis=1))[0])
    found: FloatArray = sources[point.curve].points[number]
    return found


def _left(point: OmittedPoint, factor: float) -> OmittedPoint:
    return attrs.evolve(point, away=factor * point.away, beside=factor * point.beside)
