"""A mapping carries a net point by point: its structure stays as it is.

Every point goes to its image, or slides back into the planes of its lines over the image of the
hull (`assoc_hull.edit.recut.slide_into_planes`); then all lines are lofted again. No point comes or
goes, so lines leave their exact images between their points as they will, and a hull so carried is
a smooth function of the mapping. `assoc_hull.edit.recut.transform` holds lines to their images and
cuts others anew instead.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.edit.carried_net import CarriedNet
from assoc_hull.edit.mapped_attachments import carry_attachments
from assoc_hull.edit.mapped_features import CarriedFeatures
from assoc_hull.edit.mapped_planes import TransformedPlanes
from assoc_hull.edit.recut.carried_points import (
    TransformationState,
    carry_directions,
    carry_ends,
    carry_points,
)
from assoc_hull.edit.recut.slide_into_planes import slide_over
from assoc_hull.edit.recut.transform import carry_intersections, move_planes, refuse_others
from assoc_hull.edit.space_map import SpaceMap
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import IntArray
from assoc_hull.model.features import Feature
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.tables import HullState, Particulars

__all__ = ["NetMap", "carry_net", "given_points", "refuse_bent"]


@attrs.frozen(eq=False)
class NetMap:
    """A mapping, and what it does with all that a net has beside points.

    Attributes
    ----------
    space : SpaceMap
        The mapping.
    drivers : (d,) int
        Lines whose planes go along with the mapping, boundary curves among them.
    planes : TransformedPlanes
        Where the planes of all lines go.
    features : tuple of Feature
        With the numbers that they get.
    particulars : Particulars
        Those of the hull afterwards.
    within : float, m
        How far points of features may come to lie off them; farther, and a feature dissolves.
    """

    space: SpaceMap
    drivers: IntArray
    planes: TransformedPlanes
    features: tuple[Feature, ...]
    particulars: Particulars
    within: float = 2e-3


def carry_net(edit: Transaction, by: NetMap) -> TransformationState:
    """Carry a net within an edit that holds nothing else.

    Parameters
    ----------
    edit : Transaction
        The edit: one undo step, refused as a whole.
    by : NetMap
        The mapping.

    Returns
    -------
    TransformationState
        Where the points go; those that are computed from curves follow when the edit ends.

    Raises
    ------
    BadInputError
        The mapping bends a line that it was to keep plane, or takes a point where its lines do
        not go; something else is in the edit.
    """
    state, pending, maker = edit.state, edit.pending, edit.maker
    refuse_others(edit)
    refuse_bent(state, by.planes)
    pending.alone = pending.structural = True
    drives = np.zeros(state.lines.count, bool)
    drives[by.drivers] = True
    work = carry_points(maker, by.space, by.planes, drives)
    slide_over(work)
    carry_directions(work, edit.journal)
    carry_ends(work, edit.journal)
    carry_intersections(edit, by.space)
    move_planes(maker, by.planes)
    if by.particulars != state.particulars:
        edit.journal.set(state.settings.particulars, [0], [by.particulars])
    pending.notes += carry_attachments(state, edit.journal, by.space)
    rows = given_points(state)
    edit.write(rows, work.value[rows], "carrying a net")
    pending.features = _features(work, by)
    adopted = state.live("rows")
    pending.held |= set(adopted[state.rows.sort[adopted] == Sort.ADOPTED].tolist())
    curves = set(state.live("curves").tolist())
    pending.curves |= curves
    # A straight keel stays as it is to the bit while the planes that cut it move along it.
    live = state.live("rows")
    pending.computed |= set(live[state.rows.driver[live] >= 0].tolist())
    pending.ask(CarriedNet).relink |= curves
    return work


def given_points(state: HullState) -> IntArray:
    """Give the points whose places are given: not computed from a curve, and not only watched."""
    table, live = state.rows, state.live("rows")
    watched = (table.sort[live] == Sort.CROSSING) & (table.role[live] == Role.WATCHED)
    rows: IntArray = live[(table.driver[live] < 0) & ~watched]
    return rows


def _features(work: TransformationState, by: NetMap) -> CarriedFeatures:
    """Let features keep their points, as long as these lie on them."""
    rows = {row for each in by.features for row in each.points}
    places = {row: work.image[row] for row in sorted(rows)}
    return CarriedFeatures(by.features, frozenset(), by.within, places)


def refuse_bent(state: HullState, planes: TransformedPlanes) -> None:
    """Refuse a mapping that takes lines out of their planes that it is to keep there."""
    for line, away in sorted(planes.bent.items()):
        if state.lines.boundary[line] < 0:
            raise BadInputError(
                f"{state.lines.name[line]} leaves its plane by {away:.3g} m",
                "in carrying a net point by point", "let it follow instead of driving",
            )  # fmt: skip
