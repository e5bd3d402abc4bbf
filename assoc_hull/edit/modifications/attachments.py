"""Things beside the net, tunnels and bodies: put there, moved, renamed, taken away.

Bodies beside the net: put there, moved, given another shape. No line moves.

Tunnels athwartships: kept in the hull, and changed. No line moves.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TypeVar

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.analysis.hydrostatics.tunnel import mouth_of
from assoc_hull.arguments import (
    flag,
    number,
    numbers,
    pair,
    place,
    places,
    plain_name,
    positive,
    shown,
    shown_name,
    word,
)
from assoc_hull.edit.arguments import line_name
from assoc_hull.edit.checks.tunnel_findings import tunnels_that_meet
from assoc_hull.edit.modifications.names import taken_names
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import (
    BadInputError,
    NameTakenError,
    OutOfRangeError,
    UnknownNameError,
)
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.attached_body import AttachedBody
from assoc_hull.model.attachments import (
    ATTACHMENTS,
    Attachment,
    attachment_named,
    attachments_in_order,
)
from assoc_hull.model.tables import HullState
from assoc_hull.model.tunnel_definition import TunnelDefinition

__all__ = [
    "BodyShape",
    "add_body",
    "add_tunnel",
    "held_by_name",
    "is_attachment",
    "put",
    "refuse_taken",
    "remove",
    "rename_attachment",
    "set_body",
    "set_tunnel",
]

Held = TypeVar("Held", bound=Attachment)


def is_attachment(state: HullState, name: object) -> bool:
    """Tell whether something beside the net is called so."""
    return isinstance(name, str) and attachment_named(state, name) is not None


def held_by_name(state: HullState, made: type[Held], name: object) -> Held:
    """Give the thing of a class that a name stands for.

    Raises
    ------
    UnknownNameError
        There is none of that name.
    """
    found = attachment_named(state, name) if isinstance(name, str) else None
    if found is None or not isinstance(found[1], made):
        kind = next(each for each in ATTACHMENTS if each.made is made)
        names = tuple(each.name for each in kind.of(state)[0])
        raise UnknownNameError(kind.word, shown_name(name), names)
    return found[1]


def refuse_taken(state: HullState, name: str, but: Attachment | None = None) -> None:
    """Refuse a name that something else has, `but` aside, however a person writes it.

    Raises
    ------
    NameTakenError
        A group, a line, a point or a thing beside the net has it.
    """
    plain = plain_name(name)
    taken = taken_names(state) - ({but.name} if but else set())
    if any(plain_name(each) == plain for each in taken):
        raise NameTakenError("group, line, point, tunnel or body", name)


def put(edit: Transaction, old: Attachment | None, new: Attachment | None) -> None:
    """Put one thing in the place of another of its kind; of equal ones nothing is written."""
    made = type(old if new is None else new)
    column = next(each for each in ATTACHMENTS if each.made is made).of(edit.state)
    if old != new:
        kept = [each for each in column[0] if each is not old]
        found = attachments_in_order([*kept, *(() if new is None else (new,))])
        edit.journal.set(column, [0], [found])


def remove(edit: Transaction, made: type[Attachment], name: str) -> None:
    """Take a thing of a class away; `UnknownNameError` if there is none of that name."""
    put(edit, held_by_name(edit.state, made, name), None)


def rename_attachment(edit: Transaction, name: str, new: str) -> None:
    """Give a thing beside the net another name.

    Raises
    ------
    NameTakenError
        Something else has the new one.
    """
    found = attachment_named(edit.state, name)
    assert found is not None, "its name was looked up before"
    if new != found[1].name:
        refuse_taken(edit.state, new, but=found[1])
        put(edit, found[1], attrs.evolve(found[1], name=new))


_MOST = 100_000
"""So many points have all bodies of a hull together at most: a step holds them all, twice."""

_AROUND = 1_000
"""So many has a section at most: its ends are parted into triangles corner by corner."""


_THIN = 1e-4
"""m: thinner bodies are refused. Single precision of an STL tells .02 mm apart at 300 m."""


@attrs.frozen
class BodyShape:
    """What was given of the shape of a body; None where nothing was."""

    sections: ArrayLike | None = None
    x: ArrayLike | None = None
    y: ArrayLike | None = None
    z: ArrayLike | None = None
    corners: ArrayLike | None = None
    both: bool | None = None
    sign: float | None = None

    @property
    def placed(self) -> bool:
        """Whether a place was given."""
        return any(each is not None for each in (self.sections, self.x, self.y, self.z))

    @property
    def given(self) -> bool:
        """Whether anything was."""
        rest = self.corners, self.both, self.sign
        return self.placed or any(each is not None for each in rest)


def add_body(edit: Transaction, name: str, group: str, shape: BodyShape) -> None:
    """Put a body beside the net.

    Raises
    ------
    NameTakenError
        Something else has the name.
    BadInputError
        It has no shape, two of them, or encloses nothing.
    """
    where = "in body"
    refuse_taken(edit.state, name)
    if shape.sections is None and (shape.x is None or shape.y is None or shape.z is None):
        raise BadInputError(f"{name!r} has no shape", where, "give x, y and z, or sections")
    _put(edit, None, _shaped(name, group, shape, None, where), where)


def set_body(
    edit: Transaction, name: str, by: ArrayLike | None, group: str | None, shape: BodyShape
) -> None:
    """Move a body, or give it another group or shape.

    Raises
    ------
    UnknownNameError
        There is none of that name.
    BadInputError
        As for `add_body`; or nothing is given, or a movement and a new place.
    """
    where, old = "in set_body", held_by_name(edit.state, AttachedBody, name)
    if by is None and group is None and not shape.given:
        what = f"nothing is given for {old.name!r}"
        raise BadInputError(what, where, "give by, group, x, y, z, sections, corners, both or sign")
    if by is not None and shape.placed:
        raise BadInputError("both by and a new place are given", where, "give one of them")
    new = _shaped(old.name, old.group if group is None else group, shape, old, where)
    if by is not None:
        new = _sound(attrs.evolve(new, sections=new.points + place(by, "by", where)), where)
    _put(edit, old, new, where)


def _put(edit: Transaction, old: AttachedBody | None, new: AttachedBody, where: str) -> None:
    others = sum(len(each.carriers) for each in edit.state.bodies if each is not old)
    if others + len(new.carriers) > _MOST:
        what = f"{new.name!r} has {len(new.carriers)} points, and other bodies {others}"
        remedy = f"give fewer: all bodies of a hull have at most {_MOST} points together"
        raise BadInputError(what, where, remedy)
    put(edit, old, new)


def _shaped(
    name: str, group: str, shape: BodyShape, old: AttachedBody | None, where: str
) -> AttachedBody:
    """Make a body of what was given, and of one that there was."""
    box = {axis: getattr(shape, axis) for axis in "xyz"}
    given = {axis: each for axis, each in box.items() if each is not None}
    if given and shape.sections is not None:
        what = f"both sections and {', '.join(given)} are given"
        raise BadInputError(what, where, "give sections, or a box by x, y and z")
    if shape.sections is not None:
        points = _rings(shape.sections, where)
    elif old is not None:
        points = _stretched(old.points, given, where)
    else:
        points = _box(given, where)
    if shape.corners is not None:
        corners = _corners(shape.corners, points.shape[1], where)
    elif old is not None and old.points.shape[1] == points.shape[1]:
        corners = old.corners
    else:
        corners = tuple(range(points.shape[1]))
    before = 1 if old is None else old.sign
    sign = before if shape.sign is None else number(shape.sign, "sign", where)
    if sign not in (1, -1):
        what = f"sign is {shown(shape.sign)}"
        raise BadInputError(what, where, "give 1 for what stands on the hull, -1 for what is taken")
    both = (old is not None and old.both) if shape.both is None else flag(shape.both, "both", where)
    called = line_name(word(group, "the group", where))
    return _sound(AttachedBody(name, called, points, corners, both, int(sign)), where)


def _rings(sections: ArrayLike, where: str) -> FloatArray:
    """Take closed sections, (k, m, 3), m."""
    try:
        found = np.asarray(sections, np.float64)
    except (TypeError, ValueError):
        found = np.zeros(0)
    if found.ndim != 3 or found.shape[2] != 3 or found.shape[0] < 2 or found.shape[1] < 3:
        remedy = "give two or more from aft forward, each of as many points (x, y, z), at least 3"
        raise BadInputError(f"sections are {shown(sections)}", where, remedy)
    if found.shape[1] > _AROUND:
        what = f"sections have {found.shape[1]} points each"
        raise BadInputError(what, where, f"give at most {_AROUND}")
    return places(found.reshape(-1, 3), "sections", where).reshape(found.shape)


def _box(given: dict[str, ArrayLike], where: str) -> FloatArray:
    """Make the two sections of a box."""
    (x0, x1), (y0, y1), (z0, z1) = (
        pair(given[axis], axis, where, positive=False) for axis in "xyz"
    )
    ring = [(y0, z0), (y1, z0), (y1, z1), (y0, z1)]
    return np.array([[(x, y, z) for y, z in ring] for x in (x0, x1)])


def _stretched(points: FloatArray, given: dict[str, ArrayLike], where: str) -> FloatArray:
    """Stretch a body so that it reaches from one place to another along some axes."""
    found = points.copy()
    for axis, asked in given.items():
        low, high = pair(asked, axis, where, positive=False)
        part = found[:, :, "xyz".index(axis)]
        least, most = float(part.min()), float(part.max())
        # A box keeps its very numbers: low at its low side, high at its high one.
        part[:] = np.where(
            part == most, high, low + (part - least) * ((high - low) / (most - least or 1.0))
        )
    return found


def _corners(given: ArrayLike, count: int, where: str) -> tuple[int, ...]:
    found = np.atleast_1d(numbers(given, "corners", where)).ravel().tolist()
    if any(each != int(each) or not 0 <= each < count for each in found):
        remedy = f"give numbers of points of a section: 0 to {count - 1}"
        raise BadInputError(f"corners are {shown(given)}", where, remedy)
    return tuple(sorted({int(each) for each in found}))


def _sound(body: AttachedBody, where: str) -> AttachedBody:
    """Take a body that encloses something, its sections from aft forward, on one side of two."""
    points = body.points
    for k, (one, next_) in enumerate(pairwise(points[:, :, 0].mean(axis=1).tolist())):
        if not one < next_:
            what = f"section {k + 1} of {body.name!r} lies at x {next_:.6g} m, behind {one:.6g} m"
            raise BadInputError(what, where, "give sections from aft forward")
    _refuse_crossed(body, where)
    if not body.flux > 0.0:
        what = f"{body.name!r} encloses {body.flux:.6g} m3"
        raise BadInputError(what, where, "give sections that enclose an area and do not cross")
    corner = points.reshape(-1, 3)[body.triangles]
    one, other = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
    size = np.linalg.norm(np.cross(one, other), axis=1)
    # A plate of thickness t encloses t/2 times its surface, both of its faces together.
    thick = 4.0 * body.flux / float(size.sum())
    if thick < _THIN:
        what = f"{body.name!r} is {1e3 * thick:.3g} mm thick"
        remedy = f"make it {1e3 * _THIN:g} mm or more: files of meshes do not tell less apart"
        raise BadInputError(what, where, remedy)
    low, high = float(points[..., 1].min()), float(points[..., 1].max())
    if body.both and low < 0.0 < high:
        what = f"{body.name!r} stands from y {low:.6g} to {high:.6g} m: its mirror image is in it"
        raise BadInputError(what, where, "leave both out, or keep it on one side")
    return body


def _refuse_crossed(body: AttachedBody, where: str) -> None:
    """Refuse sections of which two sides cross each other, seen along the normal of the section."""
    for k, ring in enumerate(body.points, 1):
        found = _crossing(_flat(ring))
        if found is not None:
            at = ", ".join(f"{each:.6g}" for each in ring[found[0]].tolist())
            what = (
                f"section {k} of {body.name!r} crosses itself: the sides that begin with "
                f"points {found[0]} and {found[1]} meet, near ({at}) m"
            )
            raise BadInputError(what, where, "give its points in order, once round")


def _flat(ring: FloatArray) -> FloatArray:
    """Give a ring (m, 3) in its own plane, (m, 2), m."""
    centred = ring - ring.mean(axis=0)
    across = np.linalg.svd(centred, full_matrices=False)[2]
    flat: FloatArray = centred @ across[:2].T
    return flat


def _crossing(ring: FloatArray) -> tuple[int, int] | None:
    """Find two sides of a ring (m, 2) that pass through each other; not those that only touch."""
    begin, end = ring, np.roll(ring, -1, axis=0)
    size = float(np.ptp(ring, axis=0).max())
    # Twice the area of side and point: smaller ones are rounding.
    least = 1e-12 * size * size
    way = end - begin

    def beside(points: FloatArray) -> FloatArray:
        off = points[None] - begin[:, None]
        area = way[:, None, 0] * off[..., 1] - way[:, None, 1] * off[..., 0]
        return np.where(np.abs(area) <= least, 0.0, np.sign(area))

    first, last = beside(begin), beside(end)
    parted = first * last < 0.0
    found = np.argwhere(parted & parted.T)
    return None if not len(found) else (int(found[0][0]), int(found[0][1]))


def add_tunnel(edit: Transaction, name: str, x: float, z: float, radius: float) -> None:
    """Keep a tunnel through the hull.

    Raises
    ------
    NameTakenError
        Something else has the name.
    BadInputError, OutOfRangeError
        It leaves the hull as that is now, or meets another tunnel.
    """
    refuse_taken(edit.state, name)
    put(edit, None, _checked(edit, TunnelDefinition(name, x, z, radius), "in tunnel"))


def set_tunnel(
    edit: Transaction, name: str, x: float | None, z: float | None, radius: float | None
) -> None:
    """Give a tunnel another axis or radius.

    Raises
    ------
    UnknownNameError
        There is none of that name.
    BadInputError, OutOfRangeError
        As for `add_tunnel`; or nothing is given.
    """
    where, old = "in set_tunnel", held_by_name(edit.state, TunnelDefinition, name)
    if x is None and z is None and radius is None:
        raise BadInputError(f"nothing is given for {old.name!r}", where, "give x, z or radius")
    new = TunnelDefinition(
        old.name, old.x if x is None else x, old.z if z is None else z,
        old.radius if radius is None else radius,
    )  # fmt: skip
    put(edit, old, _checked(edit, new, where, old))


def _checked(
    edit: Transaction, made: TunnelDefinition, where: str, old: TunnelDefinition | None = None
) -> TunnelDefinition:
    """Take a tunnel that lies within the hull as it is now, and meets no other."""
    state = edit.state
    found = attrs.evolve(
        made, x=number(made.x, "x", where) + 0.0, z=number(made.z, "z", where) + 0.0,
        radius=positive(made.radius, "radius", where),
    )  # fmt: skip
    low, high = _ends(state)
    if not low < found.x < high:
        why = f"lies outside the ship, for {found.name!r}"
        raise OutOfRangeError("x", found.x, where, why, low, high, "m")
    mouth_of(state, found.name, found.x, found.z, found.radius)
    others = [each for each in state.tunnels if each is not old]
    if meeting := tunnels_that_meet([*others, found]):
        raise BadInputError(meeting[0], where, "set them farther apart, or give smaller radii")
    return found


def _ends(state: HullState) -> tuple[float, float]:
    """Give where the hull begins and ends, x, m, by the points of its lines."""
    x = state.rows.xyz[state.live("rows"), 0]
    return float(x.min()), float(x.max())
