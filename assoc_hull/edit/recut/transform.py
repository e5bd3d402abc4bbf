"""Global modification: a mapping of space carries the driving lines, the others follow.

The images of the drivers are exact; their planes go where the mapping sends them. The
followers are cut again, each at its own plane, first from the drivers, then from one
another in the order of the ranks. Crossings keep their identity by sign and order along
the images, roles and kinds stay, and what the designer placed is carried by the mapping.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import attrs
import numpy as np

from assoc_hull.edit.carried_net import CarriedNet
from assoc_hull.edit.crossings.settle_crossings import make_latent
from assoc_hull.edit.mapped_planes import TransformedPlanes, carry_planes
from assoc_hull.edit.recut.carried_points import (
    DefiningPoints,
    TransformationState,
    carry_directions,
    carry_ends,
    carry_points,
)
from assoc_hull.edit.recut.changed_ends import take_out_lines
from assoc_hull.edit.recut.cut_drivers import (
    bend_lines,
    cut_drivers,
    drop_bent_planes,
    hold_to_images,
)
from assoc_hull.edit.recut.cut_followers import cut_followers, cut_kept, settle_stand_ins
from assoc_hull.edit.space_map import Affine, SpaceMap, carry_attachments, carry_features
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.address import AddressBook
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.links import crossings_between, named_lines
from assoc_hull.model.make_objects import Maker, PointSpec
from assoc_hull.model.network import bits_differ
from assoc_hull.model.tables import Corner, CurveIntersections, HullState, Particulars

__all__ = [
    "PlaceFeaturePoints",
    "carry_intersections",
    "driving_lines",
    "move_planes",
    "refuse_others",
    "transform",
]

PlaceFeaturePoints = Callable[[TransformationState], None]
"""Gives points that features own their exact places, before the drivers are cut."""

_TOLERANCE = 2e-3
"""How far (m) a driver may leave its exact image between the points it is made through."""

_FINEST = 1e-4
"""A tolerance (m) below this would fill drivers with points to no use."""


def transform(
    edit: Transaction,
    space: SpaceMap,
    drivers: Sequence[int],
    *,
    follow: bool = False,
    levels: Mapping[int, float] | None = None,
    tolerance: float | None = None,
    reshape: PlaceFeaturePoints | None = None,
    particulars: Particulars | None = None,
    keep_features: bool = False,
    lines_may_go: bool = False,
) -> int:
    """Carry driving lines by a mapping and cut the others again.

    Parameters
    ----------
    edit : Transaction
        The edit; nothing else may be in it.
    space : SpaceMap
        The mapping.
    drivers : sequence of int
        The driving lines. Boundary curves are features of the hull and no cuts of it: they
        are carried with the drivers, named or not.
    follow : bool
        Whether the planes of followers move where the mapping sends them to parallel ones.
    levels : mapping of int to float, m, or None
        Offsets that planes of followers get, by line.
    tolerance : float or None, m
        How far a driver may leave its exact image; at least 0.1 mm, and 2 mm if None, both of a
        hull under 100 m less in proportion.
    reshape : callable or None
        Is given the transformation when all points have been carried; what it settles there
        takes the place of their images.
    particulars : Particulars or None
        Those of the hull afterwards; None leaves them.
    keep_features : bool
        Whether features stay whose points the mapping bends off them: for who makes them anew
        right after.
    lines_may_go : bool
        Whether followers go, with a note, whose planes the hull does not reach any more; else
        they refuse the edit.

    Returns
    -------
    int
        How many adopted points were added to drivers.

    Raises
    ------
    BadInputError
        A finer tolerance, no driver, a mapping that cannot be used, or lines that cannot follow it.
    """
    least = edit.state.tolerances.factor * _FINEST
    tolerance = edit.state.tolerances.factor * _TOLERANCE if tolerance is None else tolerance
    if tolerance < least:
        raise BadInputError(
            f"tolerance is {tolerance:g} m", "in transform",
            f"give at least {least:g} m: finer, and points crowd without end",
        )  # fmt: skip
    state = edit.state
    driver = driving_lines(state, drivers)
    refuse_others(edit)
    edit.pending.alone = True
    planes = carry_planes(state, space, np.flatnonzero(driver), follow=follow, levels=levels)
    work = carry_points(edit.maker, space, planes, driver)
    edit.resized()
    if particulars is not None:
        edit.journal.set(state.settings.particulars, [0], [particulars])
    went = carry_attachments(state, edit.journal, space)
    if not _anything(state, work):
        _tell(edit, work, 0)
        return 0
    edit.pending.structural = True
    edit.pending.features = carry_features(state, space, np.inf if keep_features else tolerance)
    turned = carry_directions(work, edit.journal) | carry_ends(work, edit.journal)
    if reshape is not None:
        reshape(work)
    _carry_rulings(edit, work)
    bend_lines(work)
    image = cut_drivers(work, edit.document.index)
    cut_kept(work)
    settle_stand_ins(work)
    cut_followers(work)
    _watch(edit, work)
    added = hold_to_images(work, image, tolerance)
    drop_bent_planes(edit, work)
    kept = _numbers_kept(state, space, planes)
    move_planes(edit.maker, planes)  # first, so that lines that come back find their new ones
    take_out_lines(edit, work, may_go=lines_may_go)
    _publish(edit, work, turned)
    _tell(edit, work, added)
    edit.pending.notes += kept + went
    return added


def _numbers_kept(state: HullState, space: SpaceMap, planes: TransformedPlanes) -> list[str]:
    """Say which lines keep a number as their name though a shift moved their planes.

    A shift mostly changes the frame, and numbers of stations hang on it; the designer renames.
    """
    call = space.call
    if not isinstance(call, Affine) or not (call.scale == 1.0).all() or not call.shift.any():
        return []
    table = state.lines
    lines = [
        line
        for line in state.live("lines").tolist()
        if table.planar[line]
        and planes.offset[line] != table.offset[line]
        and any(letter.isdigit() for letter in str(table.name[line]))
    ]
    if not lines:
        return []
    first = lines[0]
    away, name = float(planes.offset[first]), str(table.name[first])
    return [
        f"{len(lines)} lines that go by a number keep their names though the shift moved them: "
        f"the plane of {name} is at {away:.6g} m now; edit.rename gives another name"
    ]


def driving_lines(state: HullState, drivers: Sequence[int]) -> np.typing.NDArray[np.bool_]:
    """Mark the driving lines, (l,): those that are named, and boundary curves.

    Raises
    ------
    BadInputError
        None is named, or a curve has failed.
    """
    driver = np.zeros(state.lines.count, bool)
    driver[list(drivers)] = True
    boundary = state.lines.boundary.data >= 0
    if not (driver & ~boundary).any():
        raise BadInputError(
            "no driver but boundary curves" if driver.any() else "no driver", "in transform",
            "name groups or lines that carry the hull, for instance ['sections', 'profile']",
        )  # fmt: skip
    if state.failed:
        names = ", ".join(map(AddressBook(state).curve_name, state.failed))
        raise BadInputError(f"{names} has failed", "in transform", "mend it before")
    found: np.typing.NDArray[np.bool_] = (driver | boundary) & state.lines.alive.data
    return found


def refuse_others(edit: Transaction) -> None:
    """See that nothing else is in the edit."""
    pending = edit.pending
    if edit.journal.entries or pending.values or pending.displaces or pending.curves:
        raise BadInputError(*pending.not_alone(edit.name))


def _anything(state: HullState, work: TransformationState) -> bool:
    """Tell whether the mapping moves anything by a bit."""
    live = state.live("rows")
    same = not bits_differ(work.value[live] + 0.0, state.rows.xyz[live] + 0.0).any()
    lines = state.live("lines")
    planes, table = work.planes, state.lines
    flat = table.planar[lines]
    return not (
        same
        and bool((planes.planar[lines] == flat).all())
        and bool((planes.offset[lines[flat]] == table.offset[lines[flat]]).all())
    )


def move_planes(maker: Maker, planes: TransformedPlanes) -> None:
    """Write where the planes of all lines have come to."""
    table, put = maker.state.lines, maker.journal.put
    lines = maker.state.live("lines")
    put(table.planar, lines, planes.planar[lines])
    put(table.normal, lines, planes.normal[lines])
    put(table.offset, lines, planes.offset[lines])


def _carry_rulings(edit: Transaction, work: TransformationState) -> None:
    """Let boxes in which lines rule hold the crossings that they held before, where boxes can."""
    state = edit.state
    if not state.rulings:
        return
    found = []
    for each in state.rulings:
        rows = crossings_between(state, named_lines(state, each.a), named_lines(state, each.b))
        before, after = state.rows.xyz[rows], work.value[rows]
        low, high = (_carried_corner(corner, before, after) for corner in (each.low, each.high))
        found.append(attrs.evolve(each, low=low, high=high))
    if tuple(found) != state.rulings:
        edit.journal.set(state.settings.rulings, [0], [tuple(found)])


def _carried_corner(corner: Corner, before: FloatArray, after: FloatArray) -> Corner:
    x, y, z = (
        None if bound is None else _carried_bound(bound, before[:, axis], after[:, axis])
        for axis, bound in enumerate(corner)
    )
    return x, y, z


def _carried_bound(bound: float, before: FloatArray, after: FloatArray) -> float:
    """Give a bound that parts places (k,), m, as another did before; that one where none can."""
    inside = before <= bound
    below = int(np.argmax(np.where(inside, after, -np.inf))) if inside.any() else -1
    above = int(np.argmin(np.where(inside, np.inf, after))) if not inside.all() else -1
    if below < 0 or above < 0:
        end = max(below, above)  # all lie on one side: it goes along with the nearest
        return bound if end < 0 else float(bound + (after[end] - before[end]))
    if not after[below] < after[above]:
        return bound
    if after[below] == before[below] and after[above] == before[above]:
        return bound
    part = (bound - before[below]) / (before[above] - before[below])
    return float(after[below] + part * (after[above] - after[below]))


def _publish(edit: Transaction, work: TransformationState, turned: set[int]) -> None:
    """Hand everything over to the update."""
    state, pending = edit.state, edit.pending
    for curve in sorted(work.made):
        _define(edit, curve, work.made[curve], work.gone)
    carry_intersections(edit, work.space)
    _remove(edit, work)
    live = state.live("rows")
    live = live[live < len(work.value)]
    computed = state.rows.driver[live] >= 0
    watched = (state.rows.sort[live] == Sort.CROSSING) & (state.rows.role[live] == Role.WATCHED)
    apart = np.array([bool(work.anew) and work.apart(row) for row in live.tolist()], bool)
    rows = live[~computed & ~watched & ~apart]
    edit.write(rows, work.value[rows], "transform")
    adopted = state.live("rows")
    adopted = adopted[state.rows.sort[adopted] == Sort.ADOPTED]
    fresh = [row for _, row in work.contacts]
    # all that is computed: the plane of a line may move along a driver of which no bit changes
    pending.computed |= set(fresh) | work.driven | set(live[computed].tolist())
    pending.born += sorted(str(state.rows.key[row]) for row in fresh)
    pending.held |= set(adopted.tolist())
    pending.curves |= set(state.live("curves").tolist())
    pending.moved_curves |= {curve for curve in work.made if work.drives(curve)}
    pending.ask(CarriedNet).relink |= set(state.live("curves").tolist())


def _watch(edit: Transaction, work: TransformationState) -> None:
    """Let crossings define neither of their curves any more."""
    rows = np.array(sorted(work.watched), np.int64)
    if not len(rows):
        return
    edit.maker.roles(rows, np.full(len(rows), int(Role.WATCHED)))
    limit = 2.0 * edit.state.tolerances.adoption
    edit.journal.put(edit.state.rows.limit, rows, np.full(len(rows), limit))
    for curve, part in work.made.items():
        if work.drives(curve):
            kept = [i for i, row in enumerate(part.row) if row not in work.watched]
            part.row, part.place = [part.row[i] for i in kept], [part.place[i] for i in kept]
            part.at = [part.at[i] for i in kept]
    edit.pending.notes.append(
        f"{len(rows)} crossings of lines that a mapping carried with lines that were cut again "
        "are watched now: there the two agree within the tolerance of adoption"
    )


def _define(edit: Transaction, curve: int, chosen: DefiningPoints, gone: set[int]) -> None:
    """Say which points define a curve now; make the new adopted ones."""
    new = [place for row, place in zip(chosen.row, chosen.place, strict=True) if row < 0]
    specs = [PointSpec(curve, place, Sort.ADOPTED) for place in new]
    made = iter(edit.maker.points(specs).tolist())
    rows = [row if row >= 0 else next(made) for row in chosen.row]
    rows = [row for row in rows if row not in gone]
    if rows != edit.state.curves.rows[curve].tolist():
        edit.maker.define(curve, rows)


def carry_intersections(edit: Transaction, space: SpaceMap) -> None:
    """Let the update look for each meeting where the mapping has carried it."""
    state, table = edit.state, edit.state.curves.meets
    curves = [curve for curve in state.live("curves").tolist() if len(table.data[curve].line)]
    if not curves:
        return
    meets: list[CurveIntersections] = [table.data[curve] for curve in curves]
    carried = space.places(np.concatenate([each.xyz for each in meets]))
    parts = np.split(carried, np.cumsum([len(each.line) for each in meets])[:-1])
    for curve, each, xyz in zip(curves, meets, parts, strict=True):
        edit.journal.set(table, [curve], [attrs.evolve(each, xyz=xyz)])


def _remove(edit: Transaction, work: TransformationState) -> None:
    """Take out what has no place any more."""
    state, keys = edit.state, edit.state.rows.key.data
    rows = sorted(work.gone, key=lambda row: str(keys[row]))
    for row in rows:
        for curve in state.rows.curve[row].tolist():
            if curve >= 0 and state.rows.sort[row] == Sort.CROSSING:
                make_latent(edit.maker, curve, row)
    edit.maker.remove_rows(rows)
    edit.pending.gone += [str(keys[row]) for row in rows if state.rows.sort[row] == Sort.CROSSING]


def _tell(edit: Transaction, work: TransformationState, added: int) -> None:
    """Put into the report what was carried and what was cut again."""
    state, pending = edit.state, edit.pending
    every = {*state.live("lines").tolist(), *work.anew}
    lines = sorted(every, key=lambda line: str(state.lines.key[line]))
    for line in lines:
        key = str(state.lines.key[line])
        (pending.carried if work.driver[line] else pending.cut_again).append(key)
    for line, away in sorted(work.planes.bent.items()):
        far = "less than 0.1 mm" if away < 5e-5 else f"{1e3 * away:.1f} mm"
        pending.notes.append(f"{state.lines.name[line]} is a curve in space now, {far} off a plane")
    if added:
        pending.notes.append(f"{added} adopted points hold the drivers to their images")
