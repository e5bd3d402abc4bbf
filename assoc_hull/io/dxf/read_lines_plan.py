"""A lines plan of ours, read back: each line from the view that shows its true shape.

Extended data of an entity tell name and family of its line; of one that is to be read also its
view, where the origin of the view lies, and the place of its plane. A curve in space has no
plane: the two views of it are put together, control point by control point.
"""

from __future__ import annotations

import re

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.dxf.entities import DrawingEntity, RawCurve, RawSpline
from assoc_hull.io.dxf.lines import NAMES
from assoc_hull.io.dxf.lines_plan import PLACE, VIEW_AXES, VIEW_ORIGIN, PlanView
from assoc_hull.io.reports import Notebook

__all__ = ["names_of", "plan_curves"]

_LETTERS = re.compile(r"(?:\\U\+[0-9A-Fa-f]{4})+")


def names_of(entity: DrawingEntity) -> tuple[str, str]:
    """Give name and family of the line of an entity, empty where no drawing of ours tells them."""
    name, family, _ = _words(entity)
    return name, family


def _words(entity: DrawingEntity) -> tuple[str, str, str]:
    """Give name, family and view."""
    ours = entity.extended(NAMES)
    words = [] if ours is None else [value for code, value, _ in ours.codes if code == 1000]
    name, family, view = [*words, "", "", ""][:3]
    return _LETTERS.sub(_letters, name), family, view


def _letters(match: re.Match[str]) -> str:
    """Give letters that are told by their numbers."""
    return bytes.fromhex(match.group().replace("\\U+", "")).decode("utf-16-be", "replace")


@attrs.frozen(eq=False)
class _Shown:
    """A curve as a view shows it; the place of its plane, None for a curve in space."""

    name: str
    family: str
    view: PlanView
    place: float | None
    curve: RawCurve

    def in_space(self, place: float | FloatArray) -> FloatArray:
        """Give its corners in space, (n, 3), by the coordinate that the view does not show."""
        return self.view.in_space(self.curve.corners[:, :2], place)


def plan_curves(
    drawn: list[tuple[DrawingEntity, RawCurve]], book: Notebook
) -> list[tuple[str, str, RawCurve]]:
    """Give the curves of a lines plan in space.

    Parameters
    ----------
    drawn : list of (DrawingEntity, RawCurve)
        All curves of a drawing.
    book : Notebook
        Takes curves of which a view is missing.

    Returns
    -------
    list of (str, str, RawCurve)
        Name, family, curve; empty if the drawing is no lines plan of ours.
    """
    shown = [each for pair in drawn if (each := _shown(*pair)) is not None]
    found = [
        (each.name, each.family, each.curve.moved(each.in_space(each.place)))
        for each in shown
        if each.place is not None
    ]
    in_space: dict[str, list[_Shown]] = {}
    for each in shown:
        if each.place is None:
            in_space.setdefault(each.name, []).append(each)
    for name, views in in_space.items():
        profile = [each for each in views if each.view.name == "profile"]
        plan = [each for each in views if each.view.name == "half-breadth"]
        if len(profile) != len(plan) or not all(map(_match, profile, plan)):
            what = "its curves in profile and half-breadth plan do not match, and are left out"
            book.suspect("views", name, what, len(views))
            continue
        found += [_together(*pair) for pair in zip(profile, plan, strict=True)]
    return found


def _shown(entity: DrawingEntity, curve: RawCurve) -> _Shown | None:
    """Give what an entity shows, None if it is not one to read from."""
    name, family, view = _words(entity)
    ours = entity.extended(NAMES)
    if ours is None or view not in VIEW_AXES:
        return None
    x, y, _ = ours.place(VIEW_ORIGIN)
    place = next(iter(ours.numbers(PLACE)), None)
    return _Shown(name, family, PlanView(view, (x, y)), place, curve)


def _match(one: _Shown, other: _Shown) -> bool:
    """Tell whether two views can be of one curve: as many points, and the same knots."""
    shapes = one.curve.shape, other.curve.shape
    if len(one.curve.corners) != len(other.curve.corners):
        return False
    knots = [each.knots for each in shapes if isinstance(each, RawSpline)]
    return len(knots) == 2 and np.array_equal(knots[0], knots[1])


def _together(profile: _Shown, plan: _Shown) -> tuple[str, str, RawCurve]:
    """Put two views of a curve together: lengths and heights, and breadths."""
    breadth = plan.in_space(0.0)[:, 1]
    return profile.name, profile.family, profile.curve.moved(profile.in_space(breadth))
