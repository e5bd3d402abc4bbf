"""A hull whose lines carry derivatives along, put together as it was without them.

The layout is that of the hull as it stands: which lines bound which cell, what is decided. So
the sums are differentiated, not the decisions.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import attrs
import numpy as np

from assoc_hull.analysis.floating_body import StationAreas
from assoc_hull.analysis.flotation import Flotation
from assoc_hull.analysis.following import Driven
from assoc_hull.analysis.net.followed import followed
from assoc_hull.analysis.net.gather import Net
from assoc_hull.analysis.net.sections import flat_ends_below, sections_of
from assoc_hull.analysis.parameters import Shape
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.coons import CoonsStrips
from assoc_hull.geometry.curves import CurveData, EndKind, FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.dual import Dual, as_array, is_plain
from assoc_hull.geometry.immersed import Immersed, Planes
from assoc_hull.geometry.immersed_sections import sections_below
from assoc_hull.geometry.immersion import Prepared, immersed, prepare
from assoc_hull.geometry.loft_tangents import loft_tangents
from assoc_hull.model.recipe import curve_data

__all__ = ["Varied", "varied_by"]

_WHERE = "in hydrostatic_derivatives"


@attrs.frozen(eq=False)
class Varied:
    """The surface of a net whose splines are of any arithmetic; implements `Measurable`.

    Attributes
    ----------
    base : Flotation
        The hull in plain numbers, which gives the layout.
    batch : SplineBatch
        Its splines: with tangents, complex, or of points that have moved a little.
    points : (n, 3), m
        All points of its tables, in the same arithmetic.
    """

    base: Flotation
    batch: SplineBatch
    points: FloatArray

    @cached_property
    def net(self) -> Net:
        """The lines."""
        return attrs.evolve(self.base.net, batch=self.batch)

    @cached_property
    def prepared(self) -> Prepared:
        """The surface with its integrals."""
        cells = followed(self.base.layout, self.base.net, self.batch, self.points)
        strips = CoonsStrips.on(cells, self.batch)
        return prepare(strips, plain=None if is_plain(self.batch.xyz) else self.base.strips)

    def measure(self, planes: Planes) -> Immersed:
        """Give the integrals below each plane."""
        return immersed(self.prepared, planes)

    def stations(self, planes: Planes) -> StationAreas:
        """Give the areas of the stations below each plane."""
        found = sections_of(self.net, self.base.closed)
        area = found.per_station(sections_below(found.curves, planes))
        return StationAreas(self._places(found.x), area, found.names)

    def _places(self, x: FloatArray) -> FloatArray:
        """Give where the stations are: where the first points of their first pieces have gone."""
        sections = self.base.sections
        first = sections.curve[np.searchsorted(sections.station, np.arange(len(x)))]
        row = self.batch.start[first]
        was = self.base.net.batch.xyz[row, 0]
        gone: FloatArray = x + (self.batch.xyz[row, 0] - was)
        return gone

    def transom(self, planes: Planes) -> FloatArray:
        """Give the area of transom and other flat ends below each plane, (d,), m2."""
        return flat_ends_below(self.net, self.base.closed, planes)


def varied_by(base: Flotation, shapes: Sequence[Shape]) -> Varied:
    """Give a hull whose lines carry tangents, one per parameter.

    Parameters
    ----------
    base : Flotation
        The hull.
    shapes : sequence of Shape
        The parameters.

    Raises
    ------
    BadInputError
        A curve of the hull has failed; a parameter that cannot be used.
    """
    moving = _Moving.of(base, shapes)
    batch = moving.batch()
    follows = np.flatnonzero([each.follows for each in shapes])
    if len(follows):
        driven = Driven.of(base.state, base.net)
        here = np.ix_(follows, driven.row)
        rates = driven.rates(moving.points)
        for _ in range(base.net.batch.count):
            found = driven.moves(batch, rates)[follows]
            if np.array_equal(moving.points[here], found):
                break
            moving.points[here] = found
            batch = moving.batch()
    place = base.state.rows.xyz.data[: base.state.rows.count]
    return Varied(base, batch, as_array(Dual(place, moving.points)))


@attrs.frozen(eq=False)
class _Moving:
    """Curves, and how all that they are made of changes with k parameters.

    `row` (n,) is the point of each defining one, `points` (k, r, 3) how those of the tables
    move, `direction` and `end_vector` how what is given changes.
    """

    data: CurveData
    row: IntArray
    points: FloatArray
    direction: FloatArray
    end_vector: FloatArray

    @classmethod
    def of(cls, base: Flotation, shapes: Sequence[Shape]) -> _Moving:
        state, curve = base.state, base.net.curve
        data = curve_data(state, curve)
        if not np.array_equal(data.xyz, base.net.batch.xyz):
            raise BadInputError("a curve has failed", _WHERE, "mend it, or take back the edit")
        row = np.concatenate([state.curves.rows.data[each] for each in curve.tolist()])
        count = len(shapes)
        points = np.zeros((count, state.rows.count, 3))
        direction, end = (
            np.zeros((count, *data.xyz.shape)),
            np.zeros((count, *data.end_vector.shape)),
        )
        for k, each in enumerate(shapes):
            points[k], gradient = each.moves(state)
            if gradient is not None:
                direction[k], end[k] = _turned(data, gradient[row])
        return cls(data, row, points, direction, end)

    def batch(self) -> SplineBatch:
        """Loft the curves."""
        xyz = self.points[:, self.row]
        return loft_tangents(self.data, xyz, self.direction, self.end_vector).batch()


def _turned(data: CurveData, gradient: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give how given directions turn: by the gradient at their points, (n, 3, 3)."""
    ends = gradient[np.stack([data.start[:-1], data.start[1:] - 1], axis=1)]
    turned = np.einsum("meij,mej->mei", ends, data.end_vector)
    tangent = (data.end_kind == EndKind.TANGENT)[..., None]
    return np.einsum("nij,nj->ni", gradient, data.direction), np.where(tangent, turned, 0.0)
