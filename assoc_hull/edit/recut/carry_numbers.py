"""A mapping carries a net point by point: its structure stays, with tables or without.

Every point goes to its image, or slides back into the planes of its lines over the image of the
hull; then all lines are lofted again. No point comes or goes, so lines leave their exact images
between their points as they will, and a hull so carried is a smooth function of the mapping.
`assoc_hull.edit.recut.transform` holds lines to their images and cuts others anew instead.

Numbers alone, through the program of the structure, give the same bits without tables: no edit is
begun, nothing is copied, no history is written. Where lines come to meet others than before, or a
gap has to be mended, there is more to do than numbers tell: nothing is given then, and the net is
carried by an edit.

A crossing of a driver with a line whose plane does not go along slides over the driver: the
place P(t) of it is sought whose image lies in that plane. Where both lines stay in planes that
the mapping bends, the place is sought on the surface ``S(s, t) = A(s) + B(t) - P`` that the two
curves span about their crossing P; a point of one line slides along what crosses the line beside
it. So nothing is lofted, no point comes or goes, and places depend smoothly on the mapping.
"""

from __future__ import annotations

from functools import cached_property

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.edit.carried_net import CarriedNet
from assoc_hull.edit.mapped_planes import TransformedPlanes, plane_heights, snap_into_planes
from assoc_hull.edit.recut.carried_points import (
    PointImages,
    PointStructure,
    TransformationState,
    carry_directions,
    carry_ends,
    carry_points,
    point_images,
    turned_directions,
    turned_ends,
)
from assoc_hull.edit.recut.transform import carry_intersections, move_planes, refuse_others
from assoc_hull.edit.space_map import CarriedFeatures, SpaceMap, carry_attachments
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import (
    FloatArray,
    IntArray,
    SplineBatch,
    freeze,
)
from assoc_hull.geometry.splines.segments import (
    derivative,
    evaluate_with_slope,
    locate_by_knots,
    positions,
)
from assoc_hull.model.address import address
from assoc_hull.model.features import Feature
from assoc_hull.model.index import Index
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.program.engine import runner_of
from assoc_hull.model.program.run_program import write_points
from assoc_hull.model.program.structure import (
    CompiledFeatures,
    Program,
    PublishedProgram,
    Values,
    plane_lines,
)
from assoc_hull.model.tables import HullState, Particulars

__all__ = [
    "CarriedNumbers",
    "NetMap",
    "NetNumbers",
    "carry_net",
    "given_points",
    "refuse_bent",
    "slide_over",
    "ways_across",
]

_ROUNDS = 20
_EXACT = 1e-12
"""m: a step so small changes nothing."""

_CLOSE = 1e-3
"""m: after a step so small the slopes of the mapping are kept."""

_NEAR = 1e-9
"""m: so near to the plane a place must come."""

BoolArray = np.typing.NDArray[np.bool_]


def slide_over(work: PointImages, across: FloatArray | None = None) -> IntArray:
    """Move points that the mapping takes out of the planes of their lines back into these.

    Parameters
    ----------
    work : PointImages
        The mapping under way; its `value` is changed.
    across : (r, 3) or None
        Of the points of these tables `ways_across`, if they are at hand.

    Returns
    -------
    (k,) int
        The points that slid.

    Raises
    ------
    BadInputError
        A point would slide off the end of its curve: lines would end elsewhere, and the points
        of the net would be others.
    """
    rows = _sliding(work)
    if len(rows):
        ways = _Ways.of(work, rows, across)
        work.value[rows] = snap_into_planes(work.state, work.planes, rows, ways.solved(work))
        work.slid[rows] = True
    return rows


def _sliding(work: PointImages) -> IntArray:
    """Give the points that have to slide: none that are computed from curves, or only watched."""
    table, live = work.state.rows, work.state.live("rows")
    watched = (table.sort.data == Sort.CROSSING) & (table.role.data == Role.WATCHED)
    given = (table.driver.data < 0) & ~watched & ~work.direct
    rows: IntArray = live[given[live]]
    return rows


@attrs.frozen(eq=False)
class _Course:
    """Where n points lie on the curves that they slide along.

    Attributes
    ----------
    item : (n,) int
        The points, among those that slide.
    curve : (n,) int
        Curves of a batch.
    at, low, high : (n,), m
        Where the points lie on these, and where the curves begin and end.
    here : (n, 3), m
        What the curves give there: points that only ride lie a little off.
    segment : (n,) int
        The segments of the curves that they lie on: they seldom slide on to others.
    """

    item: IntArray
    curve: IntArray
    at: FloatArray
    low: FloatArray
    high: FloatArray
    here: FloatArray
    segment: IntArray

    @classmethod
    def of(cls, batch: SplineBatch, item: IntArray, curve: IntArray, at: FloatArray) -> _Course:
        low, high = batch.knot[batch.start[curve]], batch.knot[batch.start[curve + 1] - 1]
        first, u, _ = locate_by_knots(batch, curve, at)
        here = positions(batch, first, u).T
        return cls(item, curve, at, low, high, here, first - batch.start[curve])


@attrs.frozen(eq=False)
class _Ways:
    """The ways by which k points slide: two each, of which one may be barred.

    Attributes
    ----------
    rows : (k,) int
    batch : SplineBatch
        Their curves.
    curve : (k, 2) int
        The curves that are the two ways, in the batch; -1 for a straight way.
    at : (k, 2), m
        Where the points lie on these.
    straight : (k, 3)
        Direction of a straight way: the second one.
    barred : (k, 2) bool
        Ways that are not used; the plane of the same side is not asked for.
    normal, offset : (k, 2, 3), (k, 2)
        The planes that are to be met; that of side 0 by the second way, and the other way round.
    """

    rows: IntArray
    batch: SplineBatch
    curve: IntArray
    at: FloatArray
    straight: FloatArray
    barred: BoolArray
    normal: FloatArray
    offset: FloatArray

    @classmethod
    def of(cls, work: PointImages, rows: IntArray, across: FloatArray | None) -> _Ways:
        state = work.state
        own = state.rows.curve[rows]
        line = np.where(own >= 0, state.curves.line[own], -1)
        plane = (own >= 0) & work.planes.planar[line]
        drives = (own >= 0) & (work.driver[line] | ~work.planes.planar[line])
        # along a driver the plane of the driver is kept: only that of the other line is sought
        barred = np.stack([drives[:, 1] & ~drives[:, 0], drives[:, 0]], axis=1)
        barred[:, 0] |= ~plane[:, 1]
        barred[:, 1] |= ~plane[:, 0]
        curves = np.unique(own[own >= 0])
        batch = SplineBatch.join([state.spline(curve) for curve in curves.tolist()])
        curve = np.where(own >= 0, np.searchsorted(curves, own), -1)
        straight = np.zeros((len(rows), 3))
        alone = np.flatnonzero(own[:, 1] < 0)
        if across is None:
            straight[alone] = _across(state, rows[alone], work.planes.normal[line[alone, 0]])
        else:
            straight[alone] = across[rows[alone]]
        return cls(
            rows, batch, curve, np.nan_to_num(state.rows.parameter[rows]), straight, barred,
            np.where(plane[..., None], work.planes.normal[line], 0.0),
            np.where(plane, work.planes.offset[line], 0.0),
        )  # fmt: skip

    def solved(self, work: PointImages) -> FloatArray:
        """Give the images of the places that lie in the planes, (k, 3), m; by Newton's rule."""
        start = work.state.rows.xyz[self.rows]
        way, far = np.zeros((len(self.rows), 2)), np.inf
        for _ in range(_ROUNDS):
            place, along = self._places(start, way)
            if far > _CLOSE:  # slopes are dear, and close by they hardly change
                turn = work.space.jacobians(place)
            step = self._step(work.space.places(place), np.einsum("nij,nkj->nki", turn, along))
            way += step
            far = float(np.abs(step).max(initial=0.0))
            if far <= _EXACT:
                break
        image = work.space.places(self._places(start, way)[0])
        self._require(work, image, way)
        return image

    def _step(self, image: FloatArray, slope: FloatArray) -> FloatArray:
        """Give Newton's step along both ways, (k, 2), m."""
        matrix = np.einsum("nei,nwi->new", self.normal[:, ::-1], slope)
        left = self.offset[:, ::-1] - (self.normal[:, ::-1] * image[:, None]).sum(axis=2)
        # the way that is barred keeps to nil
        matrix = np.where(self.barred[:, :, None] | self.barred[:, None, :], 0.0, matrix)
        matrix += self.barred[:, :, None] * np.eye(2)
        left = np.where(self.barred, 0.0, left)
        det = matrix[:, 0, 0] * matrix[:, 1, 1] - matrix[:, 0, 1] * matrix[:, 1, 0]
        det = np.where(det == 0.0, np.inf, det)
        first = left[:, 0] * matrix[:, 1, 1] - left[:, 1] * matrix[:, 0, 1]
        second = left[:, 1] * matrix[:, 0, 0] - left[:, 0] * matrix[:, 1, 0]
        found: FloatArray = np.stack([first / det, second / det], axis=1)
        return found

    def _places(self, start: FloatArray, way: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give places (k, 3), m, and how they move along either way, (k, 2, 3)."""
        place, along = start.copy(), np.zeros((len(start), 2, 3))
        for side, each in self._open:
            at = np.clip(each.at + way[each.item, side], each.low, each.high)
            there, along[each.item, side] = evaluate_with_slope(
                self.batch, each.curve, at, each.segment
            )
            place[each.item] += there - each.here
        lone = self.curve[:, 1] < 0
        place[lone] += way[lone, 1:] * self.straight[lone]
        along[lone, 1] = self.straight[lone]
        return place, along

    @cached_property
    def _open(self) -> list[tuple[int, _Course]]:
        """The curves that points slide along, by their side: what no round changes of them."""
        found = list[tuple[int, _Course]]()
        for side in (0, 1):
            item = np.flatnonzero((self.curve[:, side] >= 0) & ~self.barred[:, side])
            if len(item):
                curve, at = self.curve[item, side], self.at[item, side]
                found.append((side, _Course.of(self.batch, item, curve, at)))
        return found

    def _require(self, work: PointImages, image: FloatArray, way: FloatArray) -> None:
        """See that all have come into their planes."""
        off = np.zeros(len(image))
        for side in (0, 1):
            asked = ~self.barred[:, 1 - side]
            away = np.abs(plane_heights(image, self.normal[:, side]) - self.offset[:, side])
            off = np.maximum(off, np.where(asked, away, 0.0))
        worst = int(off.argmax())
        if not off[worst] <= _NEAR:
            raise BadInputError(
                f"{address(work.state, int(self.rows[worst]))} has no place within its lines "
                f"({off[worst]:.3g} m away after {np.abs(way[worst]).max():.3g} m)",
                "in carrying a net point by point",
                "make the change smaller, or vary the hull by a call of its own",
            )  # fmt: skip


def ways_across(state: HullState) -> FloatArray:
    """Give in which direction each point of one line only slides across it, (r, 3); nil for others.

    They hold under mappings that turn no plane.
    """
    table, live = state.rows, state.live("rows")
    rows = live[(table.curve[live, 0] >= 0) & (table.curve[live, 1] < 0)]
    found = np.zeros((table.count, 3))
    normal = state.lines.normal[state.curves.line[table.curve[rows, 0]]]
    found[rows] = _across(state, rows, normal)
    return found


def _across(state: HullState, rows: IntArray, normal: FloatArray) -> FloatArray:
    """Give the directions across their lines in which points of one line slide, (k, 3).

    They are those of what crosses the line beside them, by the distances along the line.
    """
    found, table = normal.copy(), state.rows
    own = table.curve[rows, 0]
    for curve in np.unique(own).tolist():
        mine = np.flatnonzero(own == curve)
        at, along = _crossing_ways(state, curve)
        if len(at):
            here = _knots(state, curve, rows[mine])
            found[mine] = np.stack([np.interp(here, at, along[:, i]) for i in range(3)], axis=1)
    return found


def _knots(state: HullState, curve: int, rows: IntArray) -> FloatArray:
    """Give where points that define a curve lie on it, (k,), m."""
    through = state.curves.rows[curve]
    order = np.argsort(through, kind="stable")
    knot: FloatArray = state.spline(curve).knot[order[np.searchsorted(through[order], rows)]]
    return knot


def _crossing_ways(state: HullState, curve: int) -> tuple[FloatArray, FloatArray]:
    """Give where curves cross a given one, (m,), m, and their unit tangents there, (m, 3)."""
    table, rows = state.rows, state.curves.rows[curve]
    rows = rows[table.sort[rows] == Sort.CROSSING]
    side = (table.curve[rows, 0] == curve).astype(np.int64)
    other, at = table.curve[rows, side], table.parameter[rows, side]
    mine = table.parameter[rows, 1 - side]
    good = (other >= 0) & np.isfinite(at) & np.isfinite(mine)
    other, at, mine = other[good], at[good], mine[good]
    if not len(other):
        return mine, np.zeros((0, 3))
    batch = SplineBatch.join([state.spline(each) for each in other.tolist()])
    tangent = derivative(batch, np.arange(len(other)), at)
    for i in range(1, len(tangent)):  # all to one side of the curve
        if float((tangent[i] * tangent[i - 1]).sum()) < 0.0:
            tangent = np.concatenate([tangent[:i], -tangent[i:]])
    order = np.argsort(mine, kind="stable")
    return mine[order], tangent[order]


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


@attrs.frozen(eq=False)
class CarriedNumbers:
    """A net after a mapping, in numbers.

    Attributes
    ----------
    program : Program
        The structure of the parent, with planes and directions as the mapping leaves them.
    values : Values
    planes : TransformedPlanes
        Of the lines of the parent.
    """

    program: Program
    values: Values
    planes: TransformedPlanes

    def splines(self, curves: IntArray) -> SplineBatch:
        """Give curves of the tables, one behind the other."""
        run, local = runner_of(self.program), self.program.local[curves]
        return run.splines(self.values, self.values, local)[0]


@attrs.frozen(eq=False)
class NetNumbers:
    """A net that mappings carry, in numbers.

    Attributes
    ----------
    state : HullState
        The tables; they must not change.
    published : PublishedProgram
        Their program; without features, which an edit lets go where they are left.
    given : (k,) int
        The points whose places are given.
    held : (h,) int
        Those that stay where they are put, though they ride with others.
    line : (m,) int
        The line of each curve of the program.
    plane_line : (p,) int
        The line of each plane of the program.
    knots : (rows, 2) int
        Where each point defines its curves in the program, -1 where it does not.
    across : (rows, 3)
        In which direction points of one line only slide across it.
    points : PointStructure
        What of its points no mapping changes.
    """

    state: HullState
    published: PublishedProgram
    given: IntArray
    held: IntArray
    line: IntArray
    plane_line: IntArray
    knots: IntArray
    across: FloatArray
    points: PointStructure

    @classmethod
    def of(cls, state: HullState, index: Index, published: PublishedProgram) -> NetNumbers | None:
        """Prepare a net; None where some of its curves are made by more than their points.

        Parameters
        ----------
        state : HullState
            The tables, in a published state; they must not change.
        index : Index
            Look-ups derived from them.
        published : PublishedProgram
            Their program and its numbers.
        """
        program = published.program
        if program.unsure.any() or program.unsure_row.any():
            return None
        program = attrs.evolve(program, features=CompiledFeatures.none(state.rows.count))
        live = state.live("rows")
        knots = np.full((state.rows.count, 2), -1)
        owner = program.number[np.repeat(np.arange(program.curves), np.diff(program.start))]
        side = (state.rows.curve[program.row, 0] != owner).astype(np.int64)
        knots[program.row, side] = np.arange(len(program.row))
        return cls(
            state, PublishedProgram(program, published.values), given_points(state),
            live[state.rows.sort[live] == Sort.ADOPTED], state.curves.line[program.number],
            plane_lines(state, index, program), knots, ways_across(state),
            PointStructure.of(state),
        )  # fmt: skip

    def carry(
        self, space: SpaceMap, drivers: IntArray, planes: TransformedPlanes
    ) -> CarriedNumbers | None:
        """Carry the net.

        Parameters
        ----------
        space : SpaceMap
            The mapping.
        drivers : (d,) int
            Lines whose planes go along with it, boundary curves among them.
        planes : TransformedPlanes
            Where the planes of all lines go.

        Returns
        -------
        CarriedNumbers or None
            None where the net that comes of it has another structure, or is to be refused.

        Raises
        ------
        BadInputError
            As `carry_net`.
        """
        refuse_bent(self.state, planes)
        drives = np.zeros(self.state.lines.count, bool)
        drives[drivers] = True
        program = self._program(planes)
        if program is None:
            return None
        images = point_images(self.state, space, planes, drives, self.points)
        slide_over(images, self.across)
        direction, end = program.direction.copy(), program.end_vector.copy()
        for side, (rows, new) in enumerate(turned_directions(images, self.points)):
            knot = self.knots[rows, side]
            direction[knot[knot >= 0]] = new[knot >= 0]
        for curve, vectors in turned_ends(images, self.points).items():
            end[program.local[curve]] = vectors
        freeze(direction, end)
        program = attrs.evolve(program, direction=direction, end_vector=end)
        before = self.published.values
        values = before.copy()
        rows = write_points(values, self.given, images.value[self.given])
        every = np.arange(program.curves)
        run = runner_of(program).run(values, before, rows, self.held, every)
        return CarriedNumbers(program, values, planes) if run.kept else None

    def _program(self, planes: TransformedPlanes) -> Program | None:
        """Give the program with its planes where they go; None where one turns or lies no more."""
        program, table = self.published.program, self.state.lines
        mine = self.plane_line
        if not planes.planar[mine].all() or (planes.normal[mine] != table.normal[mine]).any():
            return None
        offset = planes.offset[mine]
        rising: NDArray[np.bool_] = np.diff(offset) > 0.0
        rising[program.first[1:-1] - 1] = True
        if not rising.all():
            return None
        normal = planes.normal[self.line]
        flat = (normal == 1.0).any(axis=1)
        axis = np.where(flat, np.argmax(normal == 1.0, axis=1), -1)
        own = np.where(flat, planes.offset[self.line], 0.0)
        freeze(offset, axis, own)
        return attrs.evolve(program, offset=offset, own_axis=axis, own_offset=own)
