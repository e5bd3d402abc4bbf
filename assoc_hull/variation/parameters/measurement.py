"""What named parameters are measured on, and what a measurement gives.

`DrawnCurves` offers the lofted curves of a hull to the measures: profile, sections, borders of
flats, deck, and their intersections. A measurement gives a number (m or degrees), or the reason
why the hull has no such parameter, and the places at which the fields of a variation are anchored.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from types import MappingProxyType
from typing import TypeVar, cast

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.analysis.net.curve_net import CurveNet, gather_net
from assoc_hull.arguments import plain
from assoc_hull.errors import AbsentParameterError, BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.polylines.flats import fit_plane
from assoc_hull.geometry.splines.plane_intersections import (
    PointsOnCurves,
    coordinate_turns,
    points_at_coordinate,
)
from assoc_hull.geometry.splines.segments import derivative, evaluate
from assoc_hull.model.named_mapping import NamedMapping
from assoc_hull.model.tables import HullState, Particulars

__all__ = [
    "GAUSS",
    "DrawnCurves",
    "MeasuredParameter",
    "Measures",
    "SectionFrames",
    "frame_at",
    "frames_beside",
    "measure_frames",
]


def _places(value: ArrayLike) -> FloatArray:
    found = np.array(value, np.float64).reshape(-1, 3)
    freeze(found)
    return found


def _numbers(value: Mapping[str, float]) -> Mapping[str, float]:
    return MappingProxyType({name: plain(float(each)) for name, each in value.items()})


@attrs.frozen(eq=False)
class MeasuredParameter:
    """A named parameter of a hull as it is, and where fields of a variation are anchored.

    Attributes
    ----------
    name : str
        Of the parameter.
    unit : {"m", "m2", "deg", "-"}
        Of its value.
    value : float or None
        None where the hull has none, for the `reason`.
    how : str
        How it was measured.
    places : (k, 3), m
        Where it was taken.
    curves : tuple of str
        Keys of the curves that it was taken from.
    numbers : mapping of str to float
        What else a layout of fields needs, in m or degrees; each measure says what it gives.
    reason : str or None
        Why there is no value; lower case, no full stop.
    """

    name: str
    unit: str
    value: float | None
    how: str = ""
    places: FloatArray = attrs.field(factory=lambda: np.zeros((0, 3)), converter=_places)
    curves: tuple[str, ...] = ()
    numbers: Mapping[str, float] = attrs.field(factory=dict, converter=_numbers)
    reason: str | None = None

    def __attrs_post_init__(self) -> None:
        if (self.value is None) == (self.reason is None):
            raise BadInputError(
                f"{self.name} has {'neither' if self.value is None else 'both'} value and reason",
                "in an anchor", "give one of them",
            )  # fmt: skip


class Measures(Mapping[str, float]):
    """Present values of named parameters by name, of those that a hull has.

    Parameters
    ----------
    anchors : iterable of MeasuredParameter
        In order.
    spent : mapping of str to float
        See the attribute.

    Attributes
    ----------
    anchors : mapping of str to MeasuredParameter
        All that were asked for, also those without a value.
    absent : mapping of str to str
        Why a hull has no value, for those it has none of.
    spent : mapping of str to float
        By how much variations in the history of the hull have changed each parameter, m or
        degrees: shifts of the fore and the after body too, which no line shows; strengths of
        layers by their names.

    Examples
    --------
    >>> from assoc_hull.variation.parameters.measurement import MeasuredParameter, Measures
    >>> found = Measures(
    ...     [
    ...         MeasuredParameter("draught", "m", 6.25),
    ...         MeasuredParameter(
    ...             "bulb_length", "m", None, reason="no profile forward of FP below z=6.250"
    ...         ),
    ...     ]
    ... )
    >>> dict(found), dict(found.absent)
    ({'draught': 6.25}, {'bulb_length': 'no profile forward of FP below z=6.250'})
    """

    def __init__(
        self, anchors: Iterable[MeasuredParameter], spent: Mapping[str, float] | None = None
    ) -> None:
        given = tuple(anchors)
        self.spent: Mapping[str, float] = MappingProxyType(dict(spent or {}))
        self.anchors: Mapping[str, MeasuredParameter] = NamedMapping(
            "named parameter", {each.name: each for each in given}
        )
        self.absent: Mapping[str, str] = NamedMapping(
            "absent parameter", {each.name: each.reason for each in given if each.reason}
        )
        self._values = {each.name: each.value for each in given if each.value is not None}

    def __getitem__(self, name: str) -> float:
        reason = self.anchors[name].reason
        if reason is not None:
            raise AbsentParameterError(
                f"cannot measure {name!r}: {reason}", "in measure", "ask for what the hull has"
            )
        return self._values[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __contains__(self, name: object) -> bool:
        return name in self._values

    def __repr__(self) -> str:
        values = ", ".join(f"{name} {value:.6g}" for name, value in self._values.items())
        spent = ", ".join(f"{name} {value:+.6g}" for name, value in self.spent.items() if value)
        return f"<Measures: {values}{'; spent by variations: ' if spent else ''}{spent}>"


Measured = TypeVar("Measured")


@attrs.frozen(eq=False)
class DrawnCurves:
    """The curves of a hull.

    Attributes
    ----------
    state : HullState
        Its tables.
    """

    state: HullState
    _kept: dict[object, object] = attrs.field(factory=dict, init=False, repr=False)

    def take(self, measure: Callable[[DrawnCurves], Measured]) -> Measured:
        """Give what a measure returns for this hull; it is called once and kept."""
        if measure not in self._kept:
            self._kept[measure] = measure(self)
        return cast(Measured, self._kept[measure])

    @cached_property
    def net(self) -> CurveNet:
        """The curves as arrays."""
        return gather_net(self.state)

    @property
    def ship(self) -> Particulars:
        """The stored particulars."""
        return self.state.particulars

    @property
    def length(self) -> float:
        """Lpp, m: x of FP."""
        return self.ship.length

    @property
    def middle(self) -> float:
        """Where midship is, m from AP."""
        return 0.5 * self.ship.length

    def one(self, curve: int) -> SplineBatch:
        """Give a curve of the net."""
        return self.net.batch.part(curve, curve + 1)

    def some(self, curves: Iterable[int]) -> SplineBatch:
        """Give curves of the net."""
        return SplineBatch.join([self.one(curve) for curve in curves])

    def keys(self, curves: Iterable[int]) -> tuple[str, ...]:
        """Give the keys of curves."""
        return tuple(str(self.state.curves.key[self.net.curve[i]]) for i in curves)

    def across(self, curves: Iterable[int], axis: int, value: float) -> PointsOnCurves:
        """Give where curves have an x (axis 0), y or z, m; `curve` counts in `curves`."""
        chosen = list(curves)
        return points_at_coordinate(self.some(chosen) if chosen else _NOTHING, axis, value)

    def extreme(self, curves: Iterable[int], axis: int, sense: float = 1.0) -> FloatArray:
        """Give the place, (3,), m, at which curves have the greatest x, y or z; -1: the least."""
        places = np.concatenate(coordinate_turns(self.some(curves), axis))
        found: FloatArray = places[int((sense * places[:, axis]).argmax())]
        return found

    # Which curve is what.

    @cached_property
    def profile(self) -> list[int]:
        """The curves of the centre plane at which the hull ends."""
        return np.flatnonzero(self.net.end & self.net.centre).tolist()

    @cached_property
    def deck_edge(self) -> list[int]:
        """The curves at which the hull ends off the centre plane, but for flat ends."""
        ends = self.net.end & ~self.net.centre & ~np.isfinite(self.net.x)
        return np.flatnonzero(ends).tolist()

    @cached_property
    def flats_of_bottom(self) -> list[int]:
        """The borders of flats that lie level, or nearly."""
        return [i for i in self._flats if self._outward(i) == 2]

    @cached_property
    def flats_of_side(self) -> list[int]:
        """The borders of flats that stand upright along the ship, or nearly."""
        return [i for i in self._flats if self._outward(i) == 1]

    @property
    def _flats(self) -> list[int]:
        return np.flatnonzero(self.net.flat).tolist()

    def _outward(self, curve: int) -> int:
        """Give the axis that the plane through a curve is most nearly square to."""
        normal = self.net.normal[curve]
        if np.isnan(normal).any():
            normal = fit_plane(self.one(curve).xyz, 0.0)[0]
        return int(np.abs(normal).argmax())

    @cached_property
    def waterlines(self) -> IntArray:
        """The curves of waterlines."""
        return np.flatnonzero(np.array(self.net.family) == "waterlines")

    @cached_property
    def sections(self) -> IntArray:
        """The curves of sections that stand across the ship."""
        return np.flatnonzero(np.isfinite(self.net.x) & ~self.net.end)

    @cached_property
    def section_amidships(self) -> int | None:
        """The longest curve of the section nearest to midship; of two as near, of the aft one."""
        if not len(self.sections):
            return None
        off = np.abs(self.net.x[self.sections] - self.middle)
        nearest = self.sections[off <= off.min() + 1e-9]
        x = self.net.x[nearest].min()
        there: list[int] = nearest[self.net.x[nearest] == x].tolist()
        return max(there, key=self.net.length)


_NOTHING = SplineBatch(
    np.zeros(1, np.int64), np.zeros(0), np.zeros((0, 3)), np.zeros((0, 3)), np.zeros((0, 3))
)
"""No curve at all."""


# --------------------------------------------------------------------------------------
# Sections as sums. A section is a set of places with weights dz, so that the sum of y dz is the
# area of its half and that of y z dz its moment about the base line. Between knots places are those
# of Gauss, with which both sums are exact for the drawn curves.

GAUSS = np.polynomial.legendre.leggauss(5)
"""Nodes and weights, exact for y z dz of cubics, a polynomial of degree 8."""

_APART = 1e-6
"""m: sections nearer than this are one station."""


@attrs.frozen(eq=False)
class SectionFrames:
    """Sections up to the draught.

    Attributes
    ----------
    x : (k,), m
        Where they stand, rising.
    start : (k + 1,) int
        Where the places of each begin.
    xyz : (n, 3), m
        Places of the port half.
    dz : (n,), m
        Their weights.
    """

    x: FloatArray
    start: IntArray
    xyz: FloatArray
    dz: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.x, self.start, self.xyz, self.dz)

    def mapped(self, move: Callable[[FloatArray], FloatArray]) -> SectionFrames:
        """Give the sections mapped; weights grow as each section becomes higher."""
        xyz = np.array(move(self.xyz))
        x = np.array([xyz[self.start[i], 0] for i in range(len(self.x))])
        grown = self._high(xyz) / self._high(self.xyz)
        dz = self.dz * np.repeat(grown, np.diff(self.start))
        return SectionFrames(x, self.start.copy(), xyz, dz)

    def _high(self, xyz: FloatArray) -> FloatArray:
        """Give between which heights the places of each section lie, (k,), m."""
        if not len(self.x):
            return np.zeros(0)
        begin, z = self.start[:-1], xyz[:, 2]
        return np.asarray(np.maximum.reduceat(z, begin) - np.minimum.reduceat(z, begin))

    def sums(self, values: FloatArray) -> FloatArray:
        """Give the integral of values (n,) over z, section by section, (k,)."""
        total = np.concatenate([[0.0], np.cumsum(values * self.dz)])
        return np.asarray(np.diff(total[self.start]))

    @property
    def areas(self) -> FloatArray:
        """Areas of the halves, (k,), m2."""
        return self.sums(self.xyz[:, 1])

    @property
    def heights(self) -> FloatArray:
        """Heights of the centres of area, (k,), m."""
        return np.asarray(self.sums(self.xyz[:, 1] * self.xyz[:, 2]) / self.areas)

    def beside(self, x: float) -> FloatArray:
        """Give the weights (k,) with which the two sections beside a place stand for it."""
        after = int(np.clip(np.searchsorted(self.x, x), 1, len(self.x) - 1))
        part = (x - self.x[after - 1]) / (self.x[after] - self.x[after - 1])
        found = np.zeros(len(self.x))
        found[after - 1], found[after] = 1.0 - part, part
        return found


def measure_frames(hull: DrawnCurves) -> SectionFrames:
    """Give all sections of a hull."""
    return _frames(hull, _stations(hull))


def frames_beside(hull: DrawnCurves, x: float) -> SectionFrames | None:
    """Give the two sections beside a place; None where it does not lie between two."""
    stations = _stations(hull)
    places = np.array([each for each, _ in stations])
    after = int(np.searchsorted(places, x))
    return _frames(hull, stations[after - 1 : after + 1]) if 0 < after < len(places) else None


def frame_at(section: SplineBatch, x: float, top: float) -> SectionFrames:
    """Give the curves of one section up to a height, m, with where it stands."""
    _, xyz, dz = _places_below(section, top)
    start = np.array([0, len(xyz)], np.int64)
    return SectionFrames(np.array([x]), start, xyz, dz)


def _stations(hull: DrawnCurves) -> list[tuple[float, list[int]]]:
    """Give the places at which sections stand, with their curves, from aft."""
    curves = hull.sections[np.argsort(hull.net.x[hull.sections], kind="stable")]
    found = list[tuple[float, list[int]]]()
    for curve in curves.tolist():
        x = float(hull.net.x[curve])
        if found and x - found[-1][0] <= _APART:
            found[-1][1].append(curve)
        else:
            found.append((x, [curve]))
    return found


def _frames(hull: DrawnCurves, stations: Sequence[tuple[float, list[int]]]) -> SectionFrames:
    chosen = [curve for _, curves in stations for curve in curves]
    owner, xyz, dz = _places_below(hull.some(chosen), hull.ship.draught)
    station = np.repeat(np.arange(len(stations)), [len(curves) for _, curves in stations])[owner]
    start = np.searchsorted(station, np.arange(len(stations) + 1))
    # A station that lies wholly above the draught has no area.
    some = np.flatnonzero(np.diff(start) > 0)
    return SectionFrames(
        np.array([stations[i][0] for i in some.tolist()]),
        np.append(start[:-1][some], len(xyz)).astype(np.int64), xyz, dz,
    )  # fmt: skip


def _places_below(batch: SplineBatch, top: float) -> tuple[IntArray, FloatArray, FloatArray]:
    """Give places on curves below a height (m): the curve of each, (n, 3), and their weights."""
    curve, begin, end = _intervals(batch, top)
    half = 0.5 * (end - begin)
    t = (0.5 * (begin + end))[:, None] + half[:, None] * GAUSS[0]
    owner = np.repeat(curve, len(GAUSS[0]))
    xyz = evaluate(batch, owner, t.ravel())
    slope = derivative(batch, owner, t.ravel())[:, 2]
    # from the keel up, whichever way a curve runs
    low, high = batch.xyz[batch.start[:-1], 2], batch.xyz[batch.start[1:] - 1, 2]
    dz = slope * (half[:, None] * GAUSS[1]).ravel() * np.where(high < low, -1.0, 1.0)[owner]
    return owner, np.array(xyz), dz


def _intervals(batch: SplineBatch, top: float) -> tuple[IntArray, FloatArray, FloatArray]:
    """Give the pieces of curves below a height: curve, begin and end along it."""
    met = points_at_coordinate(batch, 2, top)
    owner = np.repeat(np.arange(batch.count), np.diff(batch.start))
    curve = np.concatenate([owner, met.curve])
    t = np.concatenate([batch.knot, met.t])
    order = np.lexsort((t, curve))
    curve, t = curve[order], t[order]
    inside = (curve[1:] == curve[:-1]) & (t[1:] > t[:-1])
    which, begin, end = curve[:-1][inside], t[:-1][inside], t[1:][inside]
    below = evaluate(batch, which, 0.5 * (begin + end))[:, 2] < top
    return which[below], begin[below], end[below]
