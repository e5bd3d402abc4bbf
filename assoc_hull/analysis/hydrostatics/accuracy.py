"""How far hydrostatics of a net may be off, and which lines make them doubtful.

Numbers are compared with those of other rules, of another route, and of nets with fewer lines; each
comparison gives a change of every integral (`ErrorEstimator.changes`). Doubts are sentences that
name a line, a place and an amount: open or crossed sections, kinks, crossings that gape, routes
that disagree.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.hydrostatics.floating_body import IntegralChange
from assoc_hull.analysis.net.curve_net import (
    CurveNet,
    NetSections,
    every_other_line,
    every_other_section,
    sections_of,
    station_planes,
    thinned_net,
    transom_areas_below,
)
from assoc_hull.analysis.net.open_ends import StripsWithEnds, with_ends
from assoc_hull.analysis.net.surface_layout import (
    OpenEnd,
    SurfaceLayout,
    areas_between,
    lay_out_surface,
)
from assoc_hull.geometry.curves import CurveData, FloatArray, IntArray, PointKind, Strips
from assoc_hull.geometry.floating.immersed_strips import PreparedStrips, prepare_strips
from assoc_hull.geometry.floating.immersion import (
    FloatingPlanes,
    ImmersedIntegrals,
    integrate_immersed,
)
from assoc_hull.geometry.floating.sections import sections_below
from assoc_hull.geometry.numeric.quadrature import bunched_rule
from assoc_hull.geometry.splines.segments import evaluate
from assoc_hull.geometry.surfaces.coons import CoonsStrips
from assoc_hull.model.tables import HullState

__all__ = [
    "CoarseHull",
    "ErrorEstimator",
    "LinesMade",
    "MildDoubt",
    "are_plainly_sound",
    "doubtful_lines",
    "doubtful_numbers",
    "error_estimator",
    "integrate_by_waterplanes",
    "open_sections",
]

# --------------------------------------------------------------------------------------
# Four comparisons, each a change of every integral: the Gauss order along the strips doubled (the
# error of the rule); waterplanes integrated vertically (volume and moments by another route, which
# agrees only if the surface is closed and consistent); every other section left out, the even ones
# and then the odd ones; every other waterline, buttock and diagonal left out.

_PART = 0.5
"""This part of the difference to the net with half the lines is stated.

For lines twice as far apart an error of third order is eight times as large, so that the difference
is seven times the error of the net itself. Where lines are so wide apart that no order shows, the
difference itself is large. Source: L.F. Richardson, J.A. Gaunt, "The deferred approach to the
limit", Phil. Trans. A 226 (1927).
"""

_SURFACE = {"shell": 2.0, "girth": 2.0, "wet_deck": 2.0}
"""By how much more is stated of surfaces: what strips have too much and too little of slope takes
itself away in the sum, so that the difference to the net with half the lines shows less of it.
Measured against triangulations of 5 ships that are shipped and of formulas, the error is up to 1.8
times what is stated of volumes."""

_END = 1.5
"""All of what closes an open end is in doubt: there may be none of it or twice as much, and a bulb
beyond."""

_LEVELS, _LEAST = 48, 12
"""Waterplanes of the vertical route, and those of a stretch between two corners at least."""

_STRETCHES = 7
"""The vertical route is split into this many stretches at most."""

_NEAR = 1e-3
"""Corners whose heights differ by less, in parts of the whole, are one."""


class MildDoubt(str):
    """A doubt that refuses nothing: it may be the shape, and stands in the notes."""

    __slots__ = ()


@attrs.frozen(eq=False)
class CoarseHull:
    """A hull with fewer lines.

    Attributes
    ----------
    net : CurveNet
        The lines.
    layout : SurfaceLayout
        How the surface through them is put together.
    prepared : PreparedStrips
        The surface.
    """

    net: CurveNet
    layout: SurfaceLayout
    prepared: PreparedStrips


@attrs.frozen(eq=False)
class LinesMade:
    """What the lines of a hull are made of.

    Attributes
    ----------
    state : HullState
        Its tables, or tables of the same structure.
    data : CurveData
        Points and end conditions of its lines.
    length : float, m
        Between perpendiculars.
    """

    state: HullState
    data: CurveData
    length: float


@attrs.frozen(eq=False)
class ErrorEstimator:
    """What the numbers of a hull are compared with.

    Attributes
    ----------
    own : CurveNet
        The lines.
    fine : PreparedStrips
        The same surface with the order along the strips doubled.
    sections : tuple of CoarseHull
        Without the even and without the odd sections.
    lines : CoarseHull
        Without every other line along the ship.
    closed : bool
        The deck is closed.
    without : tuple of PreparedStrips
        The surface without what closes each of its open ends.
    """

    own: CurveNet
    fine: PreparedStrips
    sections: tuple[CoarseHull, ...]
    lines: CoarseHull
    closed: bool
    without: tuple[PreparedStrips, ...] = ()

    def changes(
        self,
        known: ImmersedIntegrals,
        route: ImmersedIntegrals,
        own: NetSections,
        planes: FloatingPlanes,
    ) -> list[IntegralChange]:
        """Give the change of each comparison, in the order above, at d planes.

        `known` is what is published, `route` what `integrate_by_waterplanes` gives, `own` the
        sections.
        """
        areas = own.per_station(sections_below(own.curves, planes))
        ends = transom_areas_below(self.own, self.closed, planes)
        still, dry = np.zeros_like(areas), np.zeros_like(ends)
        share = _PART / max(len(self.sections), 1)
        found = [
            IntegralChange(_less(integrate_immersed(self.fine, planes), known), still, dry),
            IntegralChange(_less(route, known), still, dry),
        ]
        found += [
            IntegralChange(
                _stated(_less(integrate_immersed(each.prepared, planes), known), share), still, dry
            )
            for each in self.sections
        ]
        found += [
            IntegralChange(
                _stated(_less(integrate_immersed(each, planes), known), _END), still, dry
            )
            for each in self.without
        ]
        coarse = sections_of(self.lines.net, self.closed)
        fewer = coarse.per_station(sections_below(coarse.curves, planes))
        found.append(
            IntegralChange(
                _stated(_less(integrate_immersed(self.lines.prepared, planes), known), _PART),
                _PART * (fewer - areas),
                _PART * (transom_areas_below(self.lines.net, self.closed, planes) - ends),
            )
        )
        return found


def error_estimator(
    made: LinesMade,
    net: CurveNet,
    strips: Strips,
    closed: bool,
    ends: tuple[OpenEnd, ...] = (),
) -> ErrorEstimator:
    """Make the nets that a hull is compared with; `strips` is the surface through its own lines."""

    def coarse(without: NDArray[np.bool_]) -> CoarseHull:
        fewer = thinned_net(made.state, net, without, made.data)
        layout = lay_out_surface(fewer, made.length, closed)
        surface: Strips = CoonsStrips.on(layout.cells, fewer.batch)
        surface = with_ends(surface, fewer, closed, ends) if ends else surface
        return CoarseHull(fewer, layout, prepare_strips(surface))

    return ErrorEstimator(
        net,
        prepare_strips(strips, factor=2),
        tuple(coarse(every_other_section(net, first)) for first in (0, 1)),
        coarse(every_other_line(net)),
        closed,
        tuple(
            prepare_strips(with_ends(_bare(strips), net, closed, (*ends[:i], *ends[i + 1 :])))
            for i in range(len(ends))
        ),
    )


def _bare(strips: Strips) -> Strips:
    return strips.inner if isinstance(strips, StripsWithEnds) else strips


def integrate_by_waterplanes(
    prepared: PreparedStrips,
    planes: FloatingPlanes,
    known: ImmersedIntegrals,
    places: FloatArray,
    corners: FloatArray,
) -> ImmersedIntegrals:
    """Integrate waterplanes from the lowest point up: volume and moments by another route.

    The lowest is among `places` (n, 3), m. At the heights of `corners` (c, 3), m, the area of the
    waterplane may bend: each stretch between them has a rule of its own. All else is that of
    `known`.
    """
    lowest = _heights(places, planes).min(axis=1)
    stretches = [
        _stretches(float(low), float(high), row)
        for low, high, row in zip(lowest, planes.height, _heights(corners, planes), strict=True)
    ]
    rules = [_rule(edge) for edge in stretches]
    height, weight = (np.concatenate(parts) for parts in zip(*rules, strict=True))
    owner = np.repeat(np.arange(len(rules)), [len(rule[0]) for rule in rules])
    trim, heel = planes.tan_trim[owner], planes.tan_heel[owner]
    cut = integrate_immersed(prepared, FloatingPlanes(height, trim, heel))
    z = cut.area * height + trim * cut.area_x - heel * cut.area_y

    def sum_up(values: FloatArray) -> FloatArray:
        total: FloatArray = np.bincount(owner, values * weight, len(rules)).astype(np.float64)
        return total

    return attrs.evolve(
        known,
        volume=sum_up(cut.area),
        moment_x=sum_up(cut.area_x),
        moment_y=sum_up(cut.area_y),
        moment_z=sum_up(z),
    )


def _heights(places: FloatArray, planes: FloatingPlanes) -> FloatArray:
    """Give the heights at x = y = 0 of planes through places of both sides, (d, 2 n), m."""
    x, y, z = places.T
    level = z - planes.tan_trim[:, None] * x
    heel = planes.tan_heel[:, None] * y
    return np.concatenate([level - heel, level + heel], axis=1)


def _stretches(low: float, high: float, corners: FloatArray) -> FloatArray:
    """Give the heights between which a rule is laid, (s + 1,): no more than are worth it."""
    reach = max(high - low, 0.0)
    inner = np.sort(corners[(corners > low + _NEAR * reach) & (corners < high - _NEAR * reach)])
    inner = inner[np.diff(inner, prepend=-np.inf) > _NEAR * reach]
    if len(inner) >= _STRETCHES:
        inner = inner[np.linspace(0, len(inner) - 1, _STRETCHES - 1).round().astype(np.int64)]
    return np.concatenate([[low], inner, [low + reach]])


def _rule(edge: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give heights and weights between edges.

    Nodes are bunched at the lower end of a stretch: over a round bottom the area grows with
    half-integer powers of the height.
    """
    part, weight = bunched_rule(max(_LEVELS // (len(edge) - 1), _LEAST))
    step = np.diff(edge)[:, None]
    return (edge[:-1, None] + step * part).ravel(), (step * weight).ravel()


def _less(one: ImmersedIntegrals, other: ImmersedIntegrals) -> ImmersedIntegrals:
    pairs = {
        field.name: getattr(one, field.name) - getattr(other, field.name)
        for field in attrs.fields(ImmersedIntegrals)
    }
    return ImmersedIntegrals(**pairs)


def _stated(one: ImmersedIntegrals, factor: float) -> ImmersedIntegrals:
    """Give the part of a difference that is stated: of surfaces more than of volumes."""
    return ImmersedIntegrals(
        **{
            field.name: factor * _SURFACE.get(field.name, 1.0) * getattr(one, field.name)
            for field in attrs.fields(ImmersedIntegrals)
        }
    )


# --------------------------------------------------------------------------------------
# Doubts. Looked at are the sections as drawn (open, crossing themselves, bent to and fro), the
# crossings of the net (two lines that pass one another), and what the estimate compares (a section
# that its neighbours do not expect, two routes that disagree).

_OPEN = 1e-3
"""A section that ends farther from the centre plane, in half breadths of the ship, is open."""

_GAP = 4e-3
"""Lines that pass one another by more, in half breadths, do not cross."""

_TURN, _BACK = np.radians(60.0), np.radians(15.0)
"""A smooth section that turns by so much at a point, and back by so much on either side."""

_HAIRPIN = np.radians(150.0)
"""A smooth section that turns by more at a point runs back on itself."""

_EXPECTED = 0.1
"""Areas of sections differ from what the others expect by less than this, of the largest."""

_BESIDE = 0.25
"""A wrong section moves what is expected of either neighbour by at least this part of its own
amount the other way: by half on a straight line, by 9/16 on a cubic."""

_GROSS = 0.25
"""Of the largest area: so much of an error is seen from one neighbour alone."""

_AGREED = 1e-3
"""Two routes to the volume agree to this."""

_PLACES = 6
"""Places on each segment between which sections are taken as straight, to find crossings."""


_WAYS = np.array([[0.0, 1.0, -1.0, 1.0], [1.0, 1.0, 1.0, 0.0]])
"""Up, up and outward, up and inward, outward; y and z of each. What only goes one of these ways
does not come back to where it was."""


def doubtful_lines(
    net: CurveNet, layout: SurfaceLayout, sections: NetSections, kinds: NDArray[np.int8]
) -> list[str]:
    """Say which lines cannot bound a hull, wherever it floats; `kinds` are of all net points."""
    return [
        *_lost(layout),
        *_crossing(net, sections),
        *_kinked(net, sections, kinds),
        *_apart(net, _GAP * _half_breadth(net)),
    ]


def are_plainly_sound(
    net: CurveNet, layout: SurfaceLayout, sections: IntArray, kinds: NDArray[np.int8],
    planes: FloatingPlanes,
) -> bool:  # fmt: skip
    """Tell soon, by compiled code, whether nothing is doubtful; False: `doubtful_lines` says.

    `sections` are curves; neither `open_sections` nor `doubtful_lines` finds anything then.
    """
    from assoc_hull.geometry.floating import compiled_doubts

    wide = _half_breadth(net)
    limits = compiled_doubts.DoubtLimits(
        _OPEN * wide, _GAP * wide, float(_TURN), float(_BACK), float(_HAIRPIN), _PLACES
    )
    return not layout.lost and compiled_doubts.are_plainly_sound(
        net.batch, kinds, sections, net.ends_on_transom[sections],
        (net.meets, net.place, net.watched), planes, limits,
    )  # fmt: skip


def _half_breadth(net: CurveNet) -> float:
    """Give the greatest half breadth of the lines, m."""
    return float(np.abs(net.batch.xyz[:, 1]).max())


def doubtful_numbers(
    sections: NetSections,
    coarse: Sequence[CoarseHull],
    routes: tuple[FloatArray, FloatArray],
    planes: FloatingPlanes,
) -> list[str]:
    """Say where comparisons disagree by more than they do on a ship whose lines are sound.

    `coarse` is the hull without some sections, `routes` the volume (d,), m3, below each plane by
    sections and by waterplanes.
    """
    return [*_unexpected(sections, coarse, planes), *_routes(*routes)]


def _lost(layout: SurfaceLayout) -> Iterator[str]:
    """Name the curves that bound no strip."""
    for each in layout.lost:
        yield f"{', '.join(each.names)}: between two sections {each.why}"


def open_sections(net: CurveNet, sections: NetSections, planes: FloatingPlanes) -> list[str]:
    """Say which sections end off the centre plane below one of the planes."""
    most = _OPEN * _half_breadth(net)
    point = sections.curves.point[sections.curves.start[:-1], 0]
    x, y, z = point.T
    level = planes.height[:, None] + planes.tan_trim[:, None] * x
    level = level + np.abs(planes.tan_heel)[:, None] * np.abs(y)
    # A transom closes those that begin on its edge.
    wet = (z < level).any(axis=0) & ~net.ends_on_transom[sections.curve]
    return [
        f"{net.name[int(sections.curve[i])]} is open: it ends {y[i]:.3f} m off the centre plane, "
        f"at z {z[i]:.3f} m"
        for i in np.flatnonzero(wet & (np.abs(y) > most)).tolist()
    ]


def _crossing(net: CurveNet, sections: NetSections) -> Iterator[str]:
    """Find sections that cross themselves."""
    u = np.linspace(0.0, 1.0, _PLACES + 1)[:-1]
    drawn, start = ~sections.curves.deck, sections.curves.start
    tiles = sections.curves.point[drawn][:, :, 1:]
    count = np.add.reduceat(drawn.astype(np.int64), start[:-1])
    place = np.einsum("qc,scx->sqx", u[:, None] ** np.arange(4), tiles).reshape(-1, 2)
    ends = np.cumsum(count)
    place = np.insert(place, ends * _PLACES, tiles[ends - 1].sum(axis=1), axis=0)
    begin = np.concatenate([[0], ends * _PLACES + np.arange(1, len(ends) + 1)])
    ways = np.diff(place, axis=0) @ _WAYS > 0.0
    # Steps from one section to the next count for neither.
    ways[begin[1:-1] - 1] = True
    onward = np.logical_and.reduceat(ways, begin[:-1]).any(axis=1)
    for i in np.flatnonzero(~onward).tolist():
        crossing = _self_crossing(place[begin[i] : begin[i + 1]])
        if crossing is not None:
            y, z = crossing.tolist()
            name = net.name[int(sections.curve[i])]
            yield f"{name} crosses itself at y {y:.3f} m, z {z:.3f} m"


def _self_crossing(place: FloatArray) -> FloatArray | None:
    """Give where a polyline (n, 2) first crosses itself, None if nowhere."""
    first, step = place[:-1], np.diff(place, axis=0)
    one, other = np.triu_indices(len(step), 2)
    low, high = np.minimum(place[:-1], place[1:]), np.maximum(place[:-1], place[1:])
    near = ((low[one] <= high[other]) & (low[other] <= high[one])).all(axis=1)
    one, other = one[near], other[near]
    between = first[other] - first[one]
    turn = _cross(step[one], step[other])
    with np.errstate(divide="ignore", invalid="ignore"):
        s, t = _cross(between, step[other]) / turn, _cross(between, step[one]) / turn
    # Ends that touch (a closed piece on the centre plane) are no crossing.
    inside = (s > 1e-9) & (s < 1.0 - 1e-9) & (t > 1e-9) & (t < 1.0 - 1e-9)
    if not inside.any():
        return None
    k = int(np.argmax(inside))
    found: FloatArray = first[one[k]] + s[k] * step[one[k]]
    return found


def _cross(a: FloatArray, b: FloatArray) -> FloatArray:
    found: FloatArray = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    return found


def _kinked(net: CurveNet, sections: NetSections, kinds: NDArray[np.int8]) -> Iterator[str]:
    """Find sections that turn sharply at a smooth point, and back before and behind it."""
    batch, curves = net.batch, sections.curve
    owner = np.repeat(np.arange(batch.count), np.diff(batch.start))
    chord = np.diff(batch.xyz[:, 1:], axis=0)
    turn = np.arctan2(_cross(chord[:-1], chord[1:]), (chord[:-1] * chord[1:]).sum(axis=1))
    # `turn[i]` is that at point i + 1: of the points that have two before and two behind them
    middle = turn[1:-1]
    back = np.maximum(turn[:-2] * -np.sign(middle), turn[2:] * -np.sign(middle))
    smooth = (kinds[2:-2] == PointKind.SMOOTH) & (owner[:-4] == owner[4:])
    kink = (np.abs(middle) > _TURN) & (back > _BACK)
    sharp = np.flatnonzero((kink | (np.abs(middle) > _HAIRPIN)) & smooth) + 2
    for curve in curves[np.isin(curves, owner[sharp])].tolist():
        at = int(sharp[owner[sharp] == curve][0])
        y, z = batch.xyz[at, 1:].tolist()
        angle = float(np.degrees(abs(turn[at - 1])))
        yield (
            f"{net.name[curve]} has a kink of {angle:.0f} deg at y {y:.3f} m, z {z:.3f} m, "
            "where no knuckle is drawn"
        )


def _apart(net: CurveNet, most: float) -> Iterator[str]:
    """Find crossings at which one line passes the other."""
    if not len(net.meets):
        return
    one, other = (evaluate(net.batch, net.meets[:, i], net.place[:, i]) for i in (0, 1))
    gap = np.sqrt(((one - other) ** 2).sum(axis=1))
    for k in np.flatnonzero((gap > most) & ~net.watched).tolist():
        a, b = (net.name[i] for i in net.meets[k].tolist())
        x, y, z = one[k].tolist()
        yield f"{a} and {b} pass by {gap[k]:.3f} m at x {x:.2f}, y {y:.2f}, z {z:.2f} m"


def _unexpected(
    sections: NetSections, coarse: Sequence[CoarseHull], planes: FloatingPlanes
) -> Iterator[str]:
    """Find sections whose area is not what their neighbours make one expect.

    A wrong section also spoils what is expected of its neighbours, the other way and about half as
    much. Where they do not differ so, the shape changes quickly there (a shoulder, the end of a
    rake or of a cutaway): a `MildDoubt`.
    """
    own = sections.per_station(sections_below(sections.curves, planes))
    expected = _expected_areas(sections, coarse, planes)
    off = (own - expected) / own.max(axis=1)[:, None]
    large = np.abs(off) > _EXPECTED
    wrong = large & _stand_alone(off)
    for i in np.flatnonzero(large.any(axis=0)).tolist():
        # Of the draughts at which it stands alone that with the largest amount, else of all.
        at = np.abs(off[:, i]) * (wrong[:, i] if wrong[:, i].any() else large[:, i])
        k = int(at.argmax())
        doubt = (
            f"{sections.names[i]} has {own[k, i]:.2f} m2 where its neighbours "
            f"make one expect {expected[k, i]:.2f} m2, at a draught of "
            f"{planes.height[k]:.3f} m at AP"
        )
        yield doubt if wrong[k, i] else MildDoubt(f"{doubt}: {_QUICK}")


_QUICK = (
    "the shape changes quickly there, or the section is wrong; `error` counts what it may cost, "
    "and a section between them makes it less"
)


def _expected_areas(
    sections: NetSections, coarse: Sequence[CoarseHull], planes: FloatingPlanes
) -> FloatArray:
    """Give the areas (d, n), m2, of sections in the hull without them; nan where none tells."""
    found = np.full((len(planes.height), len(sections.x)), np.nan)
    for each in coarse:
        x = station_planes(each.net)
        away = np.abs(sections.x[:, None] - x).min(axis=1) > 1e-6
        found[:, away] = areas_between(
            each.layout, each.prepared.strips, x, sections.x[away], planes
        )
    return found


def _stand_alone(off: FloatArray) -> NDArray[np.bool_]:
    """Tell which sections (d, n) differ the other way than their neighbours, and by far more.

    Beside a flat or the last section only one neighbour tells it; then the amount has to be gross.
    """
    beside = np.pad(off, ((0, 0), (1, 1)), constant_values=np.nan)
    aft, fore = (-np.sign(off) * each for each in (beside[:, :-2], beside[:, 2:]))
    part = _BESIDE * np.abs(off)
    gross = np.abs(off) > _GROSS
    return ((aft >= part) & (fore >= part)) | (gross & (np.fmax(aft, fore) >= 2.0 * part))


def _routes(sections: FloatArray, waterplanes: FloatArray) -> Iterator[str]:
    """Compare the volume by sections with that by waterplanes."""
    off = np.abs(waterplanes - sections) / np.maximum(sections, 1e-300)
    if (off > _AGREED).any():
        k = int(off.argmax())
        yield (
            f"the volume is {sections[k]:.2f} m3 by sections and {waterplanes[k]:.2f} m3 by "
            "waterplanes"
        )
