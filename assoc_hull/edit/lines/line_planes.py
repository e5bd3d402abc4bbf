"""Planes of lines: where a new line is cut, and whether places lie in the planes of others.

A family of parallel planes takes one number, the coordinate along its axis (m). A diagonal
takes two: the height (m) at which its plane meets the centre plane, and the angle (degrees)
by which it falls outward from the horizontal.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import number, shown, word
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError, UnknownNameError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.kinds import FAMILIES
from assoc_hull.model.tables import Association, HullState
from assoc_hull.tolerance import IN_PLANE, SAME_PLANE

__all__ = [
    "CuttingPlane",
    "checked_in_planes",
    "completed_in_planes",
    "new_plane",
    "ready_group",
    "shifted_plane",
]

_DIAGONALS = "diagonals"
_ROUNDED = 1e-12
"""So far (m) from an inclined plane the rounding of coordinates alone may leave a place."""

_PARTNERS = {
    "sections": ("boundary", "waterlines", "buttocks"),
    "waterlines": ("boundary", "sections", "buttocks"),
    "buttocks": ("boundary", "sections", "waterlines"),
    _DIAGONALS: ("boundary", "sections"),
}
"""The groups that a group is made with by its first line, and those among whose lines that line is
cut and which it shapes in turn."""


@attrs.frozen(eq=False)
class CuttingPlane:
    """The plane of a line that is to be.

    Attributes
    ----------
    group : int
        The group it joins.
    normal, offset : (3,), float
        The plane, normal . P = offset, m.
    title : str
        The place as a designer says it, for a name.
    key : str or None
        The key of the line; None for the usual one, group and offset.
    """

    group: int
    normal: FloatArray
    offset: float
    title: str
    key: str | None


def ready_group(edit: Transaction, name: object, position: ArrayLike) -> str:
    """Take the name of a group for a new line; the first line of a family brings its group along.

    Raises
    ------
    UnknownNameError
        No such group.
    BadInputError
        No position of a line, where the group would be made for it.
    """
    state, group = edit.state, word(name, "the group", "in add_line")
    names = state.groups.name.data
    if group in names:
        return group
    if group not in _PARTNERS:
        raise UnknownNameError("group", group, tuple(dict.fromkeys((*names, *_PARTNERS))))
    if group == _DIAGONALS:
        _inclined(len(names), group, position)
    else:
        number(position, "position", f"for a line of {group}")
    edit.pending.structural = True
    edit.maker.group(group, group)
    for partner in _PARTNERS[group]:
        if partner in names:
            first, second = sorted((partner, group), key=lambda each: FAMILIES[each].rank)
            edit.maker.associate(Association(first, second))
    return group


def new_plane(state: HullState, group: str, position: ArrayLike, own: int = -1) -> CuttingPlane:
    """Check a position for a line of a group.

    Parameters
    ----------
    state : HullState
        The tables.
    group : str
        A group of the hull.
    position : float, m, or (float, float), m and degrees
        Along the family's axis; of a diagonal height on the centre line and angle.
    own : int
        The line that is shifted, if it is not a new one: its own plane is not taken.

    Raises
    ------
    BadInputError
        A family without planes of its own, a number that is not finite, or a plane that
        is taken.
    """
    index = state.groups.name.data.index(group)
    family = FAMILIES[state.groups.family[index]]
    if family.name == _DIAGONALS:
        cut = _inclined(index, group, position)
    elif family.axis is None:
        raise BadInputError(
            f"the lines of {group} have no common direction", "in add_line", "give a plane family"
        )
    else:
        place = number(position, "position", f"for a line of {group}")
        cut = CuttingPlane(index, np.eye(3)[family.axis], place, f"{place:g}", None)
    _refuse_taken(state, group, cut, own)
    return cut


def _inclined(index: int, group: str, position: ArrayLike) -> CuttingPlane:
    """Give the plane of a diagonal by height on the centre line, m, and angle, degrees."""
    what = f"the position of a diagonal is {shown(position)}"
    remedy = "give (height on the centre line in m, degrees by which it falls outward)"
    if not isinstance(position, tuple | list | np.ndarray) or len(position) != 2:
        raise BadInputError(what, "in add_line", remedy)
    height = number(position[0], "the height", f"for a line of {group}")
    angle = number(position[1], "the angle", f"for a line of {group}")
    if not 0.0 < abs(angle) < 90.0:
        raise BadInputError(
            what, "in add_line", "give an angle between 0 and 90 degrees; below 0 it rises outward"
        )
    slope = math.radians(angle)
    normal = np.array([0.0, math.sin(slope), math.cos(slope)])
    key = f"{group}:{height:.6f} at {angle:.6f} deg"
    return CuttingPlane(index, normal, height * math.cos(slope), f"{height:g} {angle:g}", key)


def shifted_plane(state: HullState, line: int, position: ArrayLike) -> CuttingPlane:
    """Check a new position for a line; a diagonal keeps its angle, its height is given.

    Raises
    ------
    BadInputError
        As `new_plane`.
    """
    group = str(state.groups.name[int(state.lines.group[line])])
    if not state.lines.planar[line]:
        raise BadInputError(
            f"{state.lines.name[line]} is a curve in space and has no plane", "in shift_line",
            "transform it, or remove it and cut a new line",
        )  # fmt: skip
    if state.family(line).name != _DIAGONALS:
        return new_plane(state, group, position, line)
    height = number(position, "position", f"for a line of {group}")
    normal = state.lines.normal[line].copy()
    offset = height * float(normal[2])
    cut = CuttingPlane(int(state.lines.group[line]), normal, offset, f"{height:g}", None)
    _refuse_taken(state, group, cut, line)
    return cut


def _refuse_taken(state: HullState, group: str, cut: CuttingPlane, own: int) -> None:
    lines = state.lines
    mine = lines.alive.data & (lines.group.data == cut.group) & lines.planar.data
    mine &= np.arange(len(mine)) != own
    mine &= np.abs(lines.normal.data - cut.normal).max(axis=1) < SAME_PLANE
    near = np.abs(lines.offset[mine] - cut.offset)
    if len(near) and near.min() < SAME_PLANE:
        remedy = "choose another position"
        raise BadInputError(f"there is a line at {cut.title} m already", f"in {group}", remedy)


def checked_in_planes(
    state: HullState, lines: list[int], xyz: FloatArray, where: str | Callable[[], str]
) -> FloatArray:
    """Check that places lie in the planes of lines; put them there to the bit.

    Parameters
    ----------
    state : HullState
        The tables.
    lines : list of int
        The lines; space curves among them are passed over.
    xyz : (3,) or (k, 3), m
        The places.
    where : str or callable
        For the error; or what tells it.

    Returns
    -------
    The places, exactly in those planes that are normal to an axis, within rounding in others.

    Raises
    ------
    BadInputError
        A place is farther off a plane than `IN_PLANE`.
    """
    out = np.array(xyz, np.float64)
    table = state.lines
    normals = {line: table.normal.data[line].tolist() for line in lines if table.planar.data[line]}
    for line, normal in sorted(normals.items(), key=lambda each: max(each[1])):
        offset = float(table.offset.data[line])
        # Column by column; one place is plain numbers, which are the quickest.
        columns = out.tolist() if out.ndim == 1 else [out[..., axis] for axis in range(3)]
        x, y, z = (column * along for column, along in zip(columns, normal, strict=True))
        away = x + y + z - offset
        most = abs(away) if out.ndim == 1 else float(np.abs(away).max())
        if most > IN_PLANE:
            name = state.lines.name[line]
            what = f"the place lies {most:.3g} m off the plane of {name}"
            told = where if isinstance(where, str) else where()
            raise BadInputError(what, told, "give a place in that plane")
        if 1.0 in normal:
            out[..., normal.index(1.0)] = offset
        elif most > _ROUNDED:
            out -= np.asarray(away)[..., None] * np.array(normal)
    return out


def completed_in_planes(
    state: HullState, lines: list[int], xyz: FloatArray, given: Mapping[int, float]
) -> FloatArray:
    """Give the place with some coordinates given, the others as the planes of lines say.

    Parameters
    ----------
    state : HullState
        The tables.
    lines : list of int
        The lines.
    xyz : (3,), m
        The place so far.
    given : mapping of int to float, m
        Axis and coordinate.
    """
    out = np.array(xyz, np.float64)
    for axis, value in given.items():
        out[axis] = value
    table = state.lines
    normals = {line: table.normal.data[line].tolist() for line in lines if table.planar.data[line]}
    oblique = [line for line in lines if line in normals and max(normals[line]) < 1.0]
    held = {each.index(max(each)) for line, each in normals.items() if line not in oblique}
    open_axes = [axis for axis in range(3) if axis not in given and axis not in held]
    if len(oblique) == len(open_axes) == 1:
        normal, axis = table.normal[oblique[0]], open_axes[0]
        rest = sum(float(normal[i] * out[i]) for i in range(3) if i != axis)
        out[axis] = (float(table.offset[oblique[0]]) - rest) / float(normal[axis])
    return out
