"""What a transformation knows of each point on its way: where the mapping sends it, where it goes.

A point whose image lies in the planes of its lines goes there. A crossing of a driver with
a follower whose plane the image has left *slides*: it goes where the image of the driver
meets that plane.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.edit.crossings.adopted_points import PlaneTangency
from assoc_hull.edit.lines.kept_runs import KeptRuns
from assoc_hull.edit.mapped_planes import (
    IN_PLANE,
    TransformedPlanes,
    flat_borders,
    plane_heights,
    snap_into_planes,
)
from assoc_hull.edit.space_map import SpaceMap
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import CurveData, EndKind, FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.segments import derivative
from assoc_hull.graph.journal import Journal
from assoc_hull.model.kinds import Sort
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.program.engine import is_compiled
from assoc_hull.model.tables import CurveIntersections, Ends, HullState

__all__ = [
    "DefiningPoints",
    "PointImages",
    "PointStructure",
    "TransformationState",
    "carry_directions",
    "carry_ends",
    "carry_points",
    "loft_through",
    "point_images",
    "turned_directions",
    "turned_ends",
]

BoolArray = np.typing.NDArray[np.bool_]
EndVector = tuple[float, float, float]
_Directed = tuple[IntArray, IntArray, FloatArray]


@attrs.define(eq=False)
class DefiningPoints:
    """The points a curve is to be made through, in order.

    Attributes
    ----------
    row : list of int
        The points; -1 for a new adopted one.
    place : list of (3,), m
        Where they go.
    at : list of float, m
        For drivers, parameters on the curve before the mapping.
    """

    row: list[int]
    place: list[FloatArray]
    at: list[float]


@attrs.define(eq=False)
class PointImages:
    """Where a mapping sends the points of a net, and which of them lie in their planes there.

    Attributes
    ----------
    state : HullState
        The tables, with the places of before.
    space : SpaceMap
        The mapping.
    planes : TransformedPlanes
        Where the planes of the lines come to.
    driver : (l,) bool
        Which lines drive.
    image : (r, 3), m
        Where the mapping sends each point.
    value : (r, 3), m
        Where each point goes.
    direct : (r,) bool
        Whether its image lies in the planes of its lines.
    still : (r,) bool
        Whether the mapping leaves it and all around it where it is, to the last bit.
    known : (r,) bool
        Whether `value` is final.
    slid : (r,) bool
        Whether a crossing was found where an image or a follower meets a plane.
    slope : (r, 3, 3)
        Jacobian of the mapping at each point; the unit matrix for one that is gone.
    """

    state: HullState
    space: SpaceMap
    planes: TransformedPlanes
    driver: BoolArray
    image: FloatArray
    value: FloatArray
    direct: BoolArray
    still: BoolArray
    known: BoolArray
    slid: BoolArray
    slope: FloatArray


@attrs.define(eq=False)
class TransformationState(PointImages):
    """A transformation under way; the tables hold the places of before.

    Attributes
    ----------
    maker : Maker
        Writes structure.
    made : dict of int to DefiningPoints
        Curves whose points are chosen.
    gone : set of int
        Points that have no place any more.
    watched : set of int
        Crossings of drivers with followers that come to pass them within the tolerance only.
    come : list of (int, (3,) array)
        Followers with places at which a driver has come to meet their planes.
    contacts : list of (int, int)
        Followers with new crossings with boundary curves.
    anew : dict of int to dict of (int, int) to int
        Followers that come to end elsewhere on boundary curves: they are cut wholly anew.
        Crossings with drivers by the driver and the intersection, counted along it.
    stays : dict of int to KeptRuns
        What of followers that are cut wholly anew stays as it was, nevertheless.
    held : set of int
        All points that stay so.
    touches : dict of (int, int) to PlaneTangency
        Where planes are tangent to features, by the curve of the feature and the line.
    fine : dict of int to float, m
        Drivers that are features, and how far they may leave their exact shape.
    driven : set of int
        Crossings that a driver has come to drive, as they slid onto another of its points.
    doubt : dict of int to float, m
        Own points of followers that slip over the hull, and how uncertain it is where to.
    ends : dict of (int, int) to (int, int)
        Meetings of drivers with followers, by the driver and the number of the root, at which a
        piece comes to begin (0) or end (1).
    new_ends : dict of (int, int) to int
        The crossings there, by the piece and its side.
    extra : dict of int to list of (float, int)
        Points that come to define a driver, with their parameters on it before the mapping.
    met : dict of int to (CurveIntersections, (k, 3) array)
        Intersections of curves with planes, as they were when they were mapped, and their images.
    """

    maker: Maker
    made: dict[int, DefiningPoints] = attrs.field(factory=dict)
    gone: set[int] = attrs.field(factory=set)
    watched: set[int] = attrs.field(factory=set)
    come: list[tuple[int, FloatArray]] = attrs.field(factory=list)
    contacts: list[tuple[int, int]] = attrs.field(factory=list)
    anew: dict[int, dict[tuple[int, int], int]] = attrs.field(factory=dict)
    stays: dict[int, KeptRuns] = attrs.field(factory=dict)
    held: set[int] = attrs.field(factory=set)
    touches: dict[tuple[int, int], PlaneTangency] = attrs.field(factory=dict)
    fine: dict[int, float] = attrs.field(factory=dict)
    driven: set[int] = attrs.field(factory=set)
    kept: set[int] = attrs.field(factory=set)
    doubt: dict[int, float] = attrs.field(factory=dict)
    ends: dict[tuple[int, int], tuple[int, int]] = attrs.field(factory=dict)
    new_ends: dict[tuple[int, int], int] = attrs.field(factory=dict)
    extra: dict[int, list[tuple[float, int]]] = attrs.field(factory=dict)
    met: dict[int, tuple[CurveIntersections, FloatArray]] = attrs.field(factory=dict)

    def add(self, place: FloatArray) -> None:
        """Take in one more point, which has just been made, at its final place."""
        self.image = np.concatenate([self.image, place[None]])
        self.value = np.concatenate([self.value, place[None]])
        self.direct, self.known = np.append(self.direct, True), np.append(self.known, True)
        self.slid, self.still = np.append(self.slid, True), np.append(self.still, False)
        self.slope = np.concatenate([self.slope, np.eye(3)[None]])

    def met_images(self, curve: int) -> FloatArray:
        """Give where the mapping sends the intersections of a curve with planes, (k, 3), m."""
        meets = self.state.curves.meets.data
        if not self.met:
            # All curves at once: each call of a mapping costs more than the places that it maps.
            live = self.state.live("curves").tolist()
            count = np.cumsum([len(meets[each].xyz) for each in live])[:-1]
            every = self.space.places(np.concatenate([meets[each].xyz for each in live]))
            parts = zip(live, np.split(every, count), strict=True)
            self.met |= {each: (meets[each], part) for each, part in parts}
        known = self.met.get(curve)
        if known is None or known[0] is not meets[curve]:
            known = self.met[curve] = meets[curve], self.space.places(meets[curve].xyz)
        return known[1]

    def piece(self, line: int, place: FloatArray) -> int:
        """Give the curve of a line whose carried points come nearest to a place."""
        curves = self.state.lines.curves[line]
        away = [
            float(((self.image[self.state.curves.rows[curve]] - place) ** 2).sum(1).min())
            for curve in curves
        ]
        return int(curves[int(np.argmin(away))])

    def end(self, curve: int, side: int) -> int:
        """Give the point at which a curve comes to begin (0) or end (1)."""
        rows: IntArray = self.state.curves.rows[curve]
        return self.new_ends.get((curve, side), int(rows[-side]))

    def drives(self, curve: int) -> bool:
        """Tell whether a curve belongs to a driving line."""
        return bool(self.driver[self.state.line_of(curve)])

    def apart(self, row: int) -> bool:
        """Tell whether a point lies on a follower that is cut wholly anew, and does not stay."""
        if row in self.held:
            return False
        curves = self.state.rows.curve[row].tolist()
        return any(self.state.line_of(curve) in self.anew for curve in curves if curve >= 0)

    def touched(self, line: int) -> tuple[PlaneTangency, ...]:
        """Give the touches of a line, by curve."""
        found = sorted(key for key in self.touches if key[1] == line)
        return tuple(self.touches[key] for key in found)

    def other(self, row: int, curve: int) -> int:
        """Give the curve on the other side of a crossing, -1 if there is none."""
        one, two = self.state.rows.curve[row].tolist()
        return int(two if one == curve else one)


def carry_points(
    maker: Maker, space: SpaceMap, planes: TransformedPlanes, driver: BoolArray
) -> TransformationState:
    """Begin a transformation: map all points, as `point_images`."""
    each = point_images(maker.state, space, planes, driver)
    return TransformationState(
        each.state, space, planes, driver, each.image, each.value, each.direct, each.still,
        each.known, each.slid, each.slope, maker,
    )  # fmt: skip


@attrs.frozen(eq=False)
class PointStructure:
    """What of the points of a net no mapping changes: looked up once for many mappings.

    Attributes
    ----------
    live : (k,) int
    xyz : (r, 3), m
        Places of all points; those that are gone among them.
    line : (r, 2) int
        Their lines, -1 for none.
    crossing : (r,) bool
    directed : two of (rows (d,), lines (d, 2), directions (d, 3))
        Points with given directions on either side.
    bound : tuple of int
        Curves with conditions at their ends.
    """

    live: IntArray
    xyz: FloatArray
    line: IntArray
    crossing: BoolArray
    directed: tuple[_Directed, _Directed]
    bound: tuple[int, ...]

    @classmethod
    def of(cls, state: HullState) -> PointStructure:
        """Look it up in tables, which must not change afterwards."""
        table, ends = state.rows, state.curves.ends.data
        line = np.where(table.curve.data >= 0, state.curves.line[table.curve.data], -1)
        directed = []
        for side in (0, 1):
            given = table.alive.data & (table.direction[:, side] != 0.0).any(axis=1)
            rows = np.flatnonzero(given)
            directed.append((rows, line[rows], table.direction[rows, side]))
        bound = [curve for curve in state.live("curves").tolist() if any(ends[curve].kind)]
        crossing = np.asarray(table.sort.data == Sort.CROSSING)
        return cls(
            state.live("rows"), table.xyz.data.copy(), line, crossing,
            (directed[0], directed[1]), tuple(bound),
        )  # fmt: skip


def point_images(
    state: HullState, space: SpaceMap, planes: TransformedPlanes, driver: BoolArray,
    structure: PointStructure | None = None,
) -> PointImages:  # fmt: skip
    """Map all points, and see which come to lie in the planes of their lines.

    `structure` is that of these tables, if it is at hand.

    Raises
    ------
    BadInputError
        The mapping turns the hull inside out somewhere.
    """
    known = PointStructure.of(state) if structure is None else structure
    live, before = known.live, known.xyz
    image, slope = before.copy(), np.zeros((len(before), 3, 3))
    slope[:, (0, 1, 2), (0, 1, 2)] = 1.0
    image[live] = space.places(before[live])
    slope[live] = space.jacobians(before[live])
    if is_compiled(counts=False):
        from assoc_hull.edit.recut.compiled_images import set_images

        given = live, known.line, before, known.crossing
        told = planes.normal, planes.offset, planes.planar, driver
        sound, value, direct, still, settled = set_images(given, told, IN_PLANE, image, slope)
        if not sound:
            _refuse_folds(state, live, slope[live])
    else:
        _refuse_folds(state, live, slope[live])
        value, direct, still, settled = _placed(state, planes, driver, known, image, slope)
    return PointImages(
        state, space, planes, driver, image, value, direct, still, settled,
        np.zeros(len(image), bool), slope,
    )  # fmt: skip


def _placed(
    state: HullState, planes: TransformedPlanes, driver: BoolArray, known: PointStructure,
    image: FloatArray, slope: FloatArray,
) -> tuple[FloatArray, BoolArray, BoolArray, BoolArray]:  # fmt: skip
    """Give where points go, and which are direct, still and known."""
    live, line, count = known.live, known.line, len(image)
    still = np.zeros(count, bool)
    still[live] = (slope[live] == np.eye(3)).all(axis=(1, 2)) & (
        image[live] == known.xyz[live]
    ).all(axis=1)
    direct, drives = np.ones(count, bool), np.ones(count, bool)
    for side in (0, 1):
        held = (line[:, side] >= 0) & planes.planar[line[:, side]]
        off = plane_heights(image, planes.normal[line[:, side]]) - planes.offset[line[:, side]]
        direct &= ~held | (np.abs(off) <= IN_PLANE)
        drives &= (line[:, side] < 0) | driver[line[:, side]]
    value = image.copy()
    value[live] = np.where(
        direct[live][:, None], snap_into_planes(state, planes, live, image[live]), image[live]
    )
    return value, direct, still, np.where(known.crossing, direct, drives & direct)


def _refuse_folds(state: HullState, live: IntArray, j: FloatArray) -> None:
    """See that the mapping keeps right- and left-handed apart at every point."""
    volume = (
        j[:, 0, 0] * (j[:, 1, 1] * j[:, 2, 2] - j[:, 1, 2] * j[:, 2, 1])
        - j[:, 0, 1] * (j[:, 1, 0] * j[:, 2, 2] - j[:, 1, 2] * j[:, 2, 0])
        + j[:, 0, 2] * (j[:, 1, 0] * j[:, 2, 1] - j[:, 1, 1] * j[:, 2, 0])
    )
    worst = int(volume.argmin())
    if not volume[worst] > 0.0:
        x, y, z = state.rows.xyz[live[worst]].tolist()
        raise BadInputError(
            f"the mapping folds: its Jacobian determinant is {volume[worst]:.3g}",
            f"at ({x:.3f}, {y:.3f}, {z:.3f}) m in transform", "make it smaller or smoother",
        )  # fmt: skip


def loft_through(
    work: TransformationState, curves: Sequence[int], parts: Sequence[DefiningPoints] | None = None
) -> SplineBatch:
    """Loft curves through the points chosen for them, beside the tables.

    Parameters
    ----------
    work : TransformationState
        The transformation.
    curves : sequence of int
        The curves; one may come again with other points.
    parts : sequence of DefiningPoints or None
        Their points; None for those that are chosen.

    Raises
    ------
    CoincidentPointsError, TooFewPointsError
        With the name of the line whose points came together or are too few.
    """
    state = work.state
    parts = [work.made[curve] for curve in curves] if parts is None else parts
    start = np.zeros(len(parts) + 1, np.int64)
    np.cumsum([len(part.row) for part in parts], out=start[1:])
    row = np.array([each for part in parts for each in part.row], np.int64)
    owner = np.repeat(np.array(curves, np.int64), np.diff(start))
    side = (state.rows.curve[row, 0] != owner).astype(np.int64)
    kind = np.where(row >= 0, state.rows.kind[row, side], 0).astype(np.int8)
    direction = np.where((row >= 0)[:, None], state.rows.direction[row, side], 0.0)
    ends = [state.curves.ends[curve] for curve in curves]
    data = CurveData(
        start,
        np.array([place for part in parts for place in part.place]),
        kind,
        direction,
        np.array([end.kind for end in ends], np.int8),
        np.array([end.vector for end in ends], np.float64),
    )
    return loft(data, [str(state.lines.name[state.line_of(curve)]) for curve in curves])


def _lay(vectors: FloatArray, normal: FloatArray) -> FloatArray:
    """Lay vectors (k, 3) into the planes with normals (k, 3); nil normals leave them."""
    size = np.sqrt((vectors * vectors).sum(axis=1))
    flat = vectors - normal * (vectors * normal).sum(axis=1)[:, None]
    flat = np.where(np.abs(normal) == 1.0, 0.0, flat)
    length = np.sqrt((flat * flat).sum(axis=1))
    laid: FloatArray = flat * (size / np.where(length > 0.0, length, 1.0))[:, None]
    return laid


def _turned(slope: FloatArray, vectors: FloatArray) -> FloatArray:
    """Turn vectors with the mapping; their lengths stay, and so do bits where it is still."""
    new = (slope * vectors[:, None, :]).sum(axis=2)
    still = (slope == np.eye(3)).all(axis=(1, 2))
    old = np.sqrt((vectors * vectors).sum(axis=1))
    size = np.sqrt((new * new).sum(axis=1))
    new = new * (old / np.where(size > 0.0, size, 1.0))[:, None]
    return np.where(still[:, None], vectors, new)


def carry_directions(work: TransformationState, journal: Journal) -> set[int]:
    """Turn given directions of points with the mapping, and what fairing did; give the curves."""
    table, changed = work.state.rows, set[int]()
    for side, (rows, new) in enumerate(turned_directions(work)):
        if len(rows):
            both = table.direction[rows].copy()
            both[:, side] = new
            journal.put(table.direction, rows, both)
            changed |= set(table.curve[rows, side].tolist())
    _carry_faired(work, journal)
    return changed - {-1}


def _carry_faired(work: PointImages, journal: Journal) -> None:
    """Let the values that were given for faired points go with the mapping, as the points do."""
    column = work.state.rows.faired
    rows = np.flatnonzero(column.data.any(axis=1) & work.state.rows.alive.data)
    if len(rows):
        given = column.take(rows)
        journal.put(column, rows, (work.slope[rows] * given[:, None, :]).sum(axis=2))


def turned_directions(
    work: PointImages, structure: PointStructure | None = None
) -> list[tuple[IntArray, FloatArray]]:
    """Give, for either side, points (k,) with directions (k, 3) that the mapping turns, and these.

    A direction stays in the plane of its curve, and in the flat it borders. `structure` is that of
    these tables, if it is at hand.
    """
    found, flats = [], flat_borders(work.state, work.planes)
    directed = (PointStructure.of(work.state) if structure is None else structure).directed
    for side, (rows, line, old) in enumerate(directed):
        new = _turned(work.slope[rows], old)
        moved = (new != old).any(axis=1)
        rows, line, new = rows[moved], line[moved], new[moved]
        normal = np.where((line >= 0)[:, :, None], work.planes.normal[line], 0.0)
        border = np.where(np.isin(line[:, 1 - side], flats)[:, None], normal[:, 1 - side], 0.0)
        found.append((rows, _lay(_lay(new, normal[:, side]), border)))
    return found


def carry_ends(work: TransformationState, journal: Journal) -> set[int]:
    """Turn and bend the end conditions of curves with the mapping; give those that change."""
    found, ends = turned_ends(work), work.state.curves.ends
    for curve, vectors in found.items():
        journal.set(ends, [curve], [Ends(ends.data[curve].kind, vectors)])
    return set(found)


def turned_ends(
    work: PointImages, structure: PointStructure | None = None
) -> dict[int, tuple[EndVector, EndVector]]:
    """Give the vectors of the end conditions that the mapping turns or bends, by curve."""
    state, ends = work.state, work.state.curves.ends.data
    changed = dict[int, tuple[EndVector, EndVector]]()
    for curve in (PointStructure.of(state) if structure is None else structure).bound:
        old: Ends = ends[curve]
        slope = work.slope[state.curves.rows[curve][[0, -1]]]
        new = _end(work, curve, 0, slope[[0]]), _end(work, curve, 1, slope[[1]])
        if new != old.vector:
            changed[curve] = new
    return changed


def _end(work: PointImages, curve: int, at: int, slope: FloatArray) -> EndVector:
    """Give the vector of one end condition under the mapping, of the slope (1, 3, 3) there."""
    ends: Ends = work.state.curves.ends[curve]
    if ends.kind[at] == EndKind.FREE or (slope[0] == np.eye(3)).all():
        return ends.vector[at]
    spline = work.state.spline(curve)
    knot = 0 if at == 0 else -1
    place, vector = spline.xyz[[knot]], np.array([ends.vector[at]])
    if ends.kind[at] == EndKind.TANGENT:
        new = _turned(slope, vector)
    else:
        tangent = derivative(spline, np.zeros(1, np.int64), spline.knot[[knot]])
        tangent = tangent / np.sqrt((tangent * tangent).sum())
        stretch = (slope * tangent[:, None, :]).sum(axis=2)
        new = (slope * vector[:, None, :]).sum(axis=2) + work.space.bends(place, tangent)
        new = new / (stretch * stretch).sum()
    normal = work.planes.normal[[work.state.line_of(curve)]]
    flat = new - normal * (new * normal).sum()
    x, y, z = np.where(np.abs(normal) == 1.0, 0.0, flat)[0].tolist()
    return (x, y, z)
