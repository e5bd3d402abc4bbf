"""A map carries a net: which lines drive, which follow, and what changes with them.

Drivers are by default all lines whose planes the map keeps: their images are exact. A line
whose plane would bend is cut again, at its own plane, from the drivers.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal

import attrs

from assoc_hull.edit.recut.transform import transform
from assoc_hull.edit.space_map import SpaceMap
from assoc_hull.edit.transaction import Transaction
from assoc_hull.model.state import HullState, Particulars
from assoc_hull.variation.carrying.drivers import Driving, driving
from assoc_hull.variation.carrying.stations import section_planes
from assoc_hull.variation.features.redrawn_features import regenerated
from assoc_hull.variation.fields.field import Region
from assoc_hull.variation.fields.space_map import VMap

__all__ = ["Applied", "apply"]

Stations = Literal["number", "x"]


@attrs.frozen
class Applied:
    """How a map was applied to a net.

    Attributes
    ----------
    drivers : tuple of str
        Names of the lines that drove, boundary curves among them.
    driving : Driving
        How they were chosen.
    added : int
        How many adopted points hold the drivers to their images.
    regions : tuple of Region
        Boxes of the profile plane in which features that were made anew change the map.
    """

    drivers: tuple[str, ...]
    driving: Driving
    added: int
    regions: tuple[Region, ...] = ()


def apply(
    edit: Transaction,
    vmap: VMap,
    *,
    drivers: Sequence[int] | None = None,
    stations: Stations = "number",
    follow: bool = False,
    tolerance: float = 2e-3,
    particulars: Particulars | None = None,
    radii: Mapping[str, float] | None = None,
) -> Applied:
    """Carry a net by a map, within an edit that holds nothing else.

    Parameters
    ----------
    edit : Transaction
        The edit: one undo step, refused as a whole.
    vmap : VMap
        The map.
    drivers : sequence of int or None
        Numbers of the driving lines; None for all whose planes the map keeps.
    stations : {"number", "x"}
        Whether sections go with the map and keep their numbers, or stay where they are along
        the ship and are cut again. Where the map bends their planes they are cut again where
        the part of it goes that bends none.
    follow : bool
        Whether waterlines and buttocks go where the map sends most of each of them to a parallel
        plane; else they stay at their heights and half-breadths.
    tolerance : float, m
        How far a driver may leave its exact image.
    particulars : Particulars or None
        Those of the hull afterwards; None leaves them.
    radii : mapping of str to float or None
        Radii (m) that are asked for of circles, by the keys of features.

    Raises
    ------
    BadInputError
        Nothing can drive, the map folds, or lines cannot follow it.
    """
    state, anew = edit.state, regenerated(edit.state, vmap, radii)
    space = SpaceMap(anew.map, anew.map.jacobian)
    chosen = driving(state, space, drivers, stations, follow=follow)
    levels = section_planes(state, vmap.layers) if stations == "number" else None
    added = transform(
        edit, space, chosen.lines, follow=chosen.follow, levels=levels, tolerance=tolerance,
        reshape=anew.settle, particulars=particulars, lines_may_go=True,
    )  # fmt: skip
    if edit.pending.features is not None:
        edit.pending.features = anew.features(edit.pending.features)
    return Applied(_names(state, chosen.lines), chosen, added, anew.regions())


def _names(state: HullState, lines: Sequence[int]) -> tuple[str, ...]:
    boundary = state.live("lines")[state.lines.boundary.data[state.live("lines")] >= 0]
    every = sorted({*lines, *boundary.tolist()}, key=lambda line: str(state.lines.key.data[line]))
    return tuple(str(state.lines.name.data[line]) for line in every)
