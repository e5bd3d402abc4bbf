"""What a ship of main types says beside its numbers, and where its net is cut by itself."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from assoc_hull.arguments import shown
from assoc_hull.creation.classical.prelikon_lines import lies_on
from assoc_hull.creation.classical.prelikon_pieces import Joint, joints_of
from assoc_hull.creation.classical.prelikon_profile import ENDS, Profile
from assoc_hull.creation.classical.prelikon_stations import AT, Station
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.appendage_box import AppendageBox
from assoc_hull.geometry.classical.arc_boundary import ArcBoundary
from assoc_hull.geometry.classical.checks import figure, finite
from assoc_hull.geometry.classical.deck_house import DeckHouse
from assoc_hull.geometry.classical.space_curve import SpaceCurve

__all__ = ["asked_cuts", "default_cuts", "notes_of"]

_TOLD = 1e-4
"""Jumps of direction (rad) that are told."""


def default_cuts(stations: Sequence[Station], draught: float) -> dict[str, tuple[float, ...]]:
    """Give heights of waterlines and half-breadths of buttocks where none are given, m."""
    top = min(float(each.curve.arcs.ends()[-1, 1]) for each in stations)
    wide = max(float(each.curve.joints()[:, 0].max()) for each in stations)
    heights = [part * draught for part in (0.15, 0.4, 0.7, 1.0)]
    heights.append(0.5 * (draught + top))
    return {
        "buttocks": tuple(part * wide for part in (0.25, 0.5, 0.75)),
        "waterlines": tuple(z for z in heights if z < top - AT),
    }


def asked_cuts(cuts: object) -> dict[str, tuple[float, ...]]:
    """Take heights of waterlines and half-breadths of buttocks as they are asked for, m.

    Raises
    ------
    GeometryError
        No mapping, another family of lines, or places that are no finite numbers.
    """
    if cuts is None:
        return {}
    if not isinstance(cuts, Mapping):
        what = f"the planes of a net are {shown(cuts)}"
        raise GeometryError(what, "give places by family of lines")
    found = {}
    for group, places in cuts.items():
        if group not in ("buttocks", "waterlines"):
            what = f"a net is not cut by {shown(group)}"
            raise GeometryError(what, "use one of buttocks, waterlines")
        found[group] = tuple(finite(places, group, (None,)).tolist())
    return found


def notes_of(
    stations: Sequence[Station],
    profile: Profile,
    boundaries: Sequence[ArcBoundary],
    curves: Sequence[SpaceCurve],
    boxes: Sequence[AppendageBox],
    houses: Sequence[DeckHouse],
) -> tuple[str, ...]:
    """Tell what the net leaves out, and how what it leaves out lies to the sections."""
    found = _of_joints(stations)
    found += [note for each in curves if (note := _of_curve(each, stations))]
    found += [_of_boundary(each, stations) for each in boundaries if each.name not in ENDS]
    for name, count in (("appendage box", len(boxes)), ("deck house", len(houses))):
        if count:
            plural = {"appendage box": "appendage boxes"}.get(name, f"{name}s")
            title = f"1 {name} is" if count == 1 else f"{count} {plural} are"
            found.append(f"{title} told here and not in the net")
    return tuple(found)


def _of_joints(stations: Sequence[Station]) -> list[str]:
    """Tell of the corners between mean circles that the net passes smoothly."""
    passed = [
        abs(float(turn))
        for each in stations
        for joint, turn in zip(joints_of(each.curve), each.curve.turns(), strict=True)
        if joint != Joint.CORNER and abs(turn) > _TOLD
    ]
    if not passed:
        return []
    most = figure(round(max(passed), 4))
    return [
        f"sections have {len(passed)} joints at which their direction jumps, by up to {most} rad: "
        "the net is smooth there"
    ]


def _of_curve(curve: SpaceCurve, stations: Sequence[Station]) -> str:
    """Tell of a space curve that is no line of the net."""
    lying = lies_on(curve, stations)
    title = f'space curve "{curve.name}" is not in the net'
    if lying.is_knuckle:
        return ""
    if lying.count < 2:
        return f"{title}: it passes {lying.count} section(s)"
    if lying.distance > AT:
        off = f"{figure(round(lying.distance, 4))} m at x={figure(lying.where)}"
        return f"{title}: it leaves the sections by up to {off}"
    return f"{title}: it lies on the sections, of which not all have a corner there"


def _of_boundary(boundary: ArcBoundary, stations: Sequence[Station]) -> str:
    """Tell how a boundary curve in another plane lies to the sections."""
    title = f'boundary "{boundary.name}" is not in the net'
    worst, where = -1.0, np.nan
    for each in stations:
        given = boundary.curve.where(0, each.x)[:, 1]
        met = each.curve.where(0, boundary.y)[:, 1]
        if len(given) and len(met):
            off = float(np.abs(given[:, None] - met).min(axis=1).max())
            if off > worst:
                worst, where = off, each.x
    if worst < 0.0:
        return f"{title}: it passes no section"
    return (
        f"{title}: it leaves the sections by up to {figure(round(worst, 4))} m at x={figure(where)}"
    )
