"""Which lines of a net drive when a map carries it, and where the planes of sections go.

A line whose plane the map keeps has an image that lies in a plane again, so it can be carried
exactly and drives; one whose plane would bend is cut again from the drivers, as a designer's
sections stay plane. Stations go by the part of a map that moves whole planes along the ship.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import attrs
import numpy as np

from assoc_hull.edit.mapped_planes import IN_PLANE, mostly_in_one_plane
from assoc_hull.edit.space_map import SpaceMap
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.model.kinds import FAMILIES
from assoc_hull.model.tables import HullState
from assoc_hull.variation.fields.field import StackedField
from assoc_hull.variation.fields.layers import AdditiveLayer, FieldLayer, Layer

__all__ = [
    "DrivingLines",
    "KeptPlanes",
    "choose_drivers",
    "default_drivers",
    "find_kept_planes",
    "planes_go",
    "section_planes",
    "stations_along",
]

_SAMPLES = 4
"""Places a segment at which a map is evaluated."""


@attrs.frozen(eq=False)
class KeptPlanes:
    """What becomes of lines in planes x, y and z = const under a map, by number and axis.

    Attributes
    ----------
    plane : (l, 3) bool
        Whether they come to lie in such planes again.
    place : (l, 3) bool
        Whether they stay in their planes.
    """

    plane: np.typing.NDArray[np.bool_]
    place: np.typing.NDArray[np.bool_]


@attrs.frozen(eq=False)
class DrivingLines:
    """Which lines carry a hull under a map.

    Attributes
    ----------
    lines : tuple of int
        Their numbers; boundary curves drive besides.
    follow : bool
        Whether planes of waterlines and buttocks go along.
    keeps : KeptPlanes
        Which planes the map keeps.
    """

    lines: tuple[int, ...]
    follow: bool
    keeps: KeptPlanes


def choose_drivers(
    state: HullState, space: SpaceMap, given: Sequence[int] | None, stations: str, *, follow: bool
) -> DrivingLines:
    """Choose the lines that carry a hull.

    Parameters
    ----------
    state : HullState
        The tables.
    space : SpaceMap
        The map.
    given : sequence of int or None
        Lines that drive; None for all whose planes the map keeps.
    stations : {"number", "x"}
        Whether sections may go with the map.
    follow : bool
        Whether waterlines and buttocks may, if the map sends them to parallel planes.

    Raises
    ------
    BadInputError
        Nothing can drive.
    """
    some = LineImages.of(state, space)
    kept, goes = find_kept_planes(state, space, some), follow and planes_go(state, space, some)
    if given is not None:
        left = [line for line in sorted(given) if not _hardly_bent(state, space, line, kept)]
        return DrivingLines(tuple(left or sorted(given)), goes, kept)
    return DrivingLines(default_drivers(state, kept, stations, follow=goes), goes, kept)


@attrs.frozen(eq=False)
class LineImages:
    """Places along all lines, and where a map sends them.

    Attributes
    ----------
    line : (n,) int
    xyz, image : (n, 3), m
    """

    line: IntArray
    xyz: FloatArray
    image: FloatArray

    @classmethod
    def of(cls, state: HullState, space: SpaceMap) -> LineImages:
        """Take places along the lines of a net."""
        curves = state.live("curves")
        splines = SplineBatch.join([state.spline(curve) for curve in curves.tolist()])
        start, xyz = sample(splines, _SAMPLES)
        line = np.repeat(state.curves.line[curves], np.diff(start))
        return cls(line, xyz, space.places(xyz))


def find_kept_planes(
    state: HullState, space: SpaceMap, some: LineImages | None = None
) -> KeptPlanes:
    """Find which planes a map keeps on the lines of a net, line by line.

    Parameters
    ----------
    state : HullState
        The tables.
    space : SpaceMap
        The map.
    some : LineImages or None
        Of these, if they are at hand.

    Returns
    -------
    KeptPlanes
        By number of line; of lines that are not alive, and of axes other than a line's own, the
        entries mean nothing.
    """
    some = LineImages.of(state, space) if some is None else some
    line, xyz, image, slope = some.line, some.xyz, some.image, space.jacobians(some.xyz)
    moved = np.abs(image - xyz) > IN_PLANE
    bent, gone = np.zeros((state.lines.count, 3), bool), np.zeros((state.lines.count, 3), bool)
    for axis in range(3):
        others = [each for each in range(3) if each != axis]
        np.logical_or.at(bent[:, axis], line, (slope[:, axis, others] != 0.0).any(axis=1))
        np.logical_or.at(gone[:, axis], line, moved[:, axis])
        bent[:, axis] |= _spread(line, image[:, axis], state.lines.count) > IN_PLANE
    return KeptPlanes(~bent, ~gone)


_HARDLY = 1e-4
"""m: a line that leaves its plane by less is no curve in space that anybody asked for."""


def _hardly_bent(state: HullState, space: SpaceMap, line: int, kept: KeptPlanes) -> bool:
    """Tell whether a named driver leaves its plane by a hair: it follows then, and stays plane.

    A circle that is drawn anew corrects all within six radii, mostly by less than a micron.
    """
    axis = state.family(line).axis
    if axis is None or state.lines.boundary[line] >= 0 or kept.plane[line, axis]:
        return False
    splines = [state.spline(curve) for curve in state.lines.curves[line]]
    level = space.places(sample(SplineBatch.join(splines), _SAMPLES)[1])[:, axis]
    return float(level.max() - level.min()) <= _HARDLY


def _spread(line: IntArray, level: FloatArray, count: int) -> FloatArray:
    """Give how far apart places of each line lie along an axis, (l,), m; zero without places.

    A circle drawn again moves its own points by less than a slope tells.


    """
    low, high = np.full(count, np.inf), np.full(count, -np.inf)
    np.minimum.at(low, line, level)
    np.maximum.at(high, line, level)
    found: FloatArray = np.maximum(high - low, 0.0)
    return found


def planes_go(state: HullState, space: SpaceMap, some: LineImages | None = None) -> bool:
    """Tell whether a map sends at least half of each waterline and buttock to a parallel plane.

    If some went and others stayed, lines of one family could pass each other. `some` are of these
    tables and this map, if they are at hand.
    """
    some = LineImages.of(state, space) if some is None else some
    order = np.argsort(some.line, kind="stable")
    line, image = some.line[order], some.image[order]
    for each in state.live("lines").tolist():
        axis = state.family(each).axis
        if axis is None or axis == 0 or state.lines.boundary[each] >= 0:
            continue
        begin, end = np.searchsorted(line, (each, each + 1)).tolist()
        if not mostly_in_one_plane(np.sort(image[begin:end, axis])):
            return False
    return True


def default_drivers(
    state: HullState, kept: KeptPlanes, stations: str, *, follow: bool
) -> tuple[int, ...]:
    """Give the lines whose planes are kept, and stay or may go.

    Parameters
    ----------
    state : HullState
        The tables.
    kept : KeptPlanes
        What the map keeps.
    stations : {"number", "x"}
        Whether sections may go with the map.
    follow : bool
        Whether waterlines and buttocks may.

    Raises
    ------
    BadInputError
        No family of lines is left to drive.
    """
    chosen = list[int]()
    for line in state.live("lines").tolist():
        axis = state.family(line).axis
        if axis is None or state.lines.boundary[line] >= 0:
            continue
        may = stations == "number" if axis == 0 else follow
        if kept.plane[line, axis] and (may or kept.place[line, axis]):
            chosen.append(line)
    if not chosen:
        raise BadInputError(
            "the map bends the planes of all lines", "in vary",
            "vary in two steps, or name the drivers that may become curves in space",
        )  # fmt: skip
    return tuple(chosen)


def stations_along(layers: Iterable[Layer], x: FloatArray) -> FloatArray:
    """Carry stations by the part of a map that keeps their planes.

    A field that lengthens the bulb bends the planes of sections through it; one that lengthens
    the ship does not. A section that both act on is cut again where the second sends it, so that
    it keeps its place among the others.

    Parameters
    ----------
    layers : iterable of Layer
        The map.
    x : (n,), m
        Stations before, forward from AP.

    Returns
    -------
    (n,), m
        Stations after.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.fields.bounded_functions import BlendChain
    >>> from assoc_hull.variation.fields.field import AffinePiece, Boundary, StackedField
    >>> from assoc_hull.variation.fields.layers import FieldLayer
    >>> from assoc_hull.variation.carrying.driving_lines import stations_along
    >>> base = Boundary("base", BlendChain.constant(0.0))
    >>> by = AffinePiece.along(BlendChain.constant(1.0), 0.02, 0.0)
    >>> longer = StackedField("length", "x", (base,), (by,))
    >>> stations_along([FieldLayer("size", (longer,))], np.array([0.0, 50.0])).tolist()
    [0.0, 51.0]
    """
    for layer in layers:
        x = x + _moved(layer, x)
    return x


def _moved(layer: Layer, x: FloatArray) -> FloatArray:
    """Give by how much a layer moves whole planes, (n,), m."""
    moved = np.zeros_like(x)
    if isinstance(layer, AdditiveLayer) and layer.x is not None:
        moved += layer.x.at(x)
    elif isinstance(layer, FieldLayer):
        places = np.zeros((len(x), 3))
        places[:, 0] = x
        for field in layer.fields:
            if field.axis == "x" and isinstance(field, StackedField) and len(field.pieces) == 1:
                moved += field.displacement(places)
    return moved


def section_planes(state: HullState, layers: Iterable[Layer]) -> dict[int, float]:
    """Give where the planes of sections go, by the number of the line, m from AP.

    By no layers they stay, also where waterlines and buttocks follow.

    Parameters
    ----------
    state : HullState
        The tables.
    layers : iterable of Layer
        The map.
    """
    live, table = state.live("lines"), state.lines
    live = live[(table.boundary[live] < 0) & table.planar[live]]
    group = table.group[live]
    across = [
        each for each in np.unique(group).tolist()
        if FAMILIES[state.groups.family[each]].axis == 0
    ]  # fmt: skip
    lines = live[np.isin(group, across)]
    after = stations_along(layers, state.lines.offset[lines])
    return dict(zip(lines.tolist(), after.tolist(), strict=True))
