"""A mapping carries a net point by point: its structure stays as it is.

Every point goes to its image, or slides back into the planes of its lines over the image of the
hull (`assoc_hull.edit.slide`); then all lines are lofted again. No point comes or goes, so lines
leave their exact images between their points as they will, and a hull so carried is a smooth
function of the mapping. `assoc_hull.edit.transform` holds lines to their images and cuts others
anew instead.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import attrs
import numpy as np

from assoc_hull.edit.carry import Carried, carry_directions, carry_ends, carry_points
from assoc_hull.edit.carry_features import carry_features
from assoc_hull.edit.carry_planes import carry_planes
from assoc_hull.edit.mapping import SpaceMap
from assoc_hull.edit.slide import slide_over
from assoc_hull.edit.transaction import Transaction
from assoc_hull.edit.transform import carry_meetings, driving, move_planes, refuse_others
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import IntArray
from assoc_hull.model.family import Role, Sort
from assoc_hull.model.make import Maker
from assoc_hull.model.state import HullState, Particulars

__all__ = ["Way", "carry_net", "carry_tables", "given_rows"]


@attrs.frozen(eq=False)
class Way:
    """How a net is carried.

    Attributes
    ----------
    space : SpaceMap
        The mapping.
    drivers : sequence of int
        Lines whose planes go along with the mapping, beside boundary curves.
    follow : bool
        Whether the planes of the others move where the mapping sends them to parallel ones.
    levels : mapping of int to float, m, or None
        Offsets that planes get, by line.
    particulars : Particulars or None
        Those of the hull afterwards; None leaves them.
    """

    space: SpaceMap
    drivers: Sequence[int]
    follow: bool = True
    levels: Mapping[int, float] | None = None
    particulars: Particulars | None = None


def given_rows(state: HullState) -> IntArray:
    """Give the points whose places are given: not computed from a curve, and not only watched."""
    table, live = state.rows, state.live("rows")
    watched = (table.sort.data[live] == Sort.CROSSING) & (table.role.data[live] == Role.WATCHED)
    rows: IntArray = live[(table.driver.data[live] < 0) & ~watched]
    return rows


def carry_tables(maker: Maker, way: Way) -> Carried:
    """Carry planes, directions and end conditions in the tables, and find where points go.

    Parameters
    ----------
    maker : Maker
        Writes the tables.
    way : Way
        How the net is carried.

    Returns
    -------
    Carried
        With the places of all points, which are not written.

    Raises
    ------
    BadInputError
        The mapping bends the plane of a driver, or takes a point where its lines do not go.
    """
    state = maker.state
    driver = driving(state, way.drivers)
    planes = carry_planes(
        state, way.space, np.flatnonzero(driver), follow=way.follow, levels=way.levels
    )
    for line, away in sorted(planes.bent.items()):
        if state.lines.boundary.data[line] < 0:
            raise BadInputError(
                f"{state.lines.name.data[line]} leaves its plane by {away:.3g} m",
                "in carrying a net point by point", "name as drivers what the mapping keeps plane",
            )  # fmt: skip
    work = carry_points(maker, way.space, planes, driver)
    slide_over(work)
    carry_directions(work, maker.journal)
    carry_ends(work, maker.journal)
    move_planes(maker, planes)
    if way.particulars is not None:
        maker.journal.set(state.settings.particulars, [0], [way.particulars])
    return work


def carry_net(edit: Transaction, way: Way) -> Carried:
    """Carry a net within an edit that holds nothing else.

    Parameters
    ----------
    edit : Transaction
        The edit.
    way : Way
        How the net is carried.

    Raises
    ------
    BadInputError
        As `carry_tables`; or the edit holds something else.
    """
    state, pending = edit.state, edit.pending
    refuse_others(edit)
    pending.alone = pending.structural = True
    pending.features = carry_features(state, way.space, np.inf)
    work = carry_tables(edit.maker, way)
    carry_meetings(edit, way.space)
    rows = given_rows(state)
    edit.write(rows, work.value[rows], "carrying a net")
    adopted = state.live("rows")
    adopted = adopted[state.rows.sort.data[adopted] == Sort.ADOPTED]
    curves = set(state.live("curves").tolist())
    pending.held |= set(adopted.tolist())
    pending.curves |= curves
    pending.relink |= curves
    return work
