"""What a designer hands to `fair`, checked before anything is looked at."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal, cast

import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import choice, pair, place, positive, shown
from assoc_hull.edit.arguments import GivenObjects
from assoc_hull.edit.modifications.fair import FairRequest, Held, Noise
from assoc_hull.errors import BadInputError, WrongTypeError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.model.objects import Group, Line, Point
from assoc_hull.model.tables import HullState

__all__ = ["fair_request", "window_of"]

_WHERE = "in fair"
_HELD = ("volume", "lcb")


def fair_request(
    state: HullState,
    lines: Sequence[Group | Line | str] | None,
    noise: float | Literal["auto"] | None,
    tolerance: float | Mapping[Line | Point | str, float] | None,
    at: Point | str | ArrayLike | None,
    radius: tuple[float, float] | None,
    keep: Sequence[Line | Point | str],
    hold: Sequence[Literal["volume", "lcb"]],
    since: str | None,
) -> FairRequest:
    """Take the arguments of `fair`.

    Raises
    ------
    BadInputError, WrongTypeError, UnknownNameError, ForeignPointError
        As `GivenObjects`; a length that is not above 0, a radius without a place.
    """
    given = GivenObjects(state)
    usual = None if tolerance is None or isinstance(tolerance, Mapping) else tolerance
    by_line, by_point = _tolerances(given, tolerance if isinstance(tolerance, Mapping) else {})
    return FairRequest(
        noise=_noise(noise),
        lines=None if lines is None else _lines(given, lines),
        tolerance=None if usual is None else positive(usual, "tolerance", _WHERE),
        lines_within=by_line,
        points_within=by_point,
        at=None if at is None else _spot(given, at),
        radius=_radius(at, radius),
        keep=_kept(given, keep),
        hold=_held(hold),
        since=since,
    )


def window_of(
    state: HullState, at: object, radius: object
) -> tuple[FloatArray, tuple[float, float]]:
    """Take the middle of a window, m, and its radius, m."""
    return _spot(GivenObjects(state), at), pair(radius, "radius", _WHERE, positive=True)


def _noise(noise: object) -> Noise:
    if noise is None or isinstance(noise, str):
        if noise is not None and noise != "auto":
            raise BadInputError(f"noise is {shown(noise)}", _WHERE, 'give m, or "auto"')
        return cast("Noise", noise)
    return positive(noise, "noise", _WHERE)


def _several(values: object, name: str) -> Sequence[object]:
    if isinstance(values, str | Group | Line | Point) or not isinstance(values, Sequence):
        raise WrongTypeError(f"{name} is {shown(values)}", _WHERE, "give a list of names")
    return values


def _lines(given: GivenObjects, lines: object) -> IntArray:
    """Take lines, and groups for all of theirs."""
    asked = _several(lines, "lines")
    found = given.driving(cast("list[Group | Line | str]", list(asked)))
    if not found:
        raise BadInputError("no line is named", _WHERE, "name some, or leave lines out for all")
    return np.array(sorted(set(found)), np.int64)


def _thing(given: GivenObjects, thing: object) -> tuple[int, int]:
    """Give the number of a line and that of a point, -1 for the one that it is not."""
    found = given.place(thing)
    if found.row >= 0:
        return -1, found.row
    if found.line < 0:
        raise WrongTypeError(f"{shown(thing)} is no line and no point", _WHERE, "name one")
    return found.line, -1


def _tolerances(
    given: GivenObjects, asked: Mapping[Line | Point | str, float]
) -> tuple[dict[int, float], dict[int, float]]:
    by_line, by_point = dict[int, float](), dict[int, float]()
    for thing, value in asked.items():
        line, row = _thing(given, thing)
        within = positive(value, f"tolerance of {shown(thing)}", _WHERE)
        if row >= 0:
            by_point[row] = within
        else:
            by_line[line] = within
    return by_line, by_point


def _spot(given: GivenObjects, at: object) -> FloatArray:
    if isinstance(at, Point | str):
        row, _ = given.point(at)
        return np.array(given.tables.rows.xyz[row])
    return place(at, "at", _WHERE)


def _radius(at: object, radius: object) -> tuple[float, float] | None:
    if at is None and radius is None:
        return None
    if at is None or radius is None:
        name, other = ("radius", "at") if at is None else ("at", "radius")
        remedy = "give the place of the window, and how far it reaches: at=, radius=(r_x, r_girth)"
        raise BadInputError(f"{name} is given without {other}", _WHERE, remedy)
    return pair(radius, "radius", _WHERE, positive=True)


def _kept(given: GivenObjects, keep: object) -> frozenset[int]:
    """Give the points that stay: those named, and all of the lines named."""
    found, curve = set[int](), given.tables.rows.curve.data
    line = np.where(curve >= 0, given.tables.curves.line.data[np.maximum(curve, 0)], -1)
    for each in _several(keep, "keep"):
        number, row = _thing(given, each)
        found |= {row} if row >= 0 else set(np.flatnonzero((line == number).any(axis=1)).tolist())
    return frozenset(found)


def _held(hold: object) -> tuple[Held, ...]:
    names = [choice(each, "hold", _HELD, _WHERE) for each in _several(hold, "hold")]
    return tuple(cast("Held", each) for each in _HELD if each in names)
