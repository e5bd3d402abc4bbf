"""What makes the numbers of a hull doubtful: lines named, with place and amount.

Looked at are the sections as drawn (open, crossing themselves, bent to and fro), the crossings
of the net (two lines that pass one another), and what the estimate compares (a section that
its neighbours do not expect, two routes that disagree).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.hydrostatics.estimate import Coarse
from assoc_hull.analysis.net.between import areas_between
from assoc_hull.analysis.net.cells import Layout
from assoc_hull.analysis.net.gather import Net
from assoc_hull.analysis.net.sections import Sections
from assoc_hull.analysis.net.slabs import planes as stands
from assoc_hull.geometry.curves import FloatArray, PointKind
from assoc_hull.geometry.floating.immersed import Planes
from assoc_hull.geometry.floating.immersed_sections import sections_below
from assoc_hull.geometry.splines.evaluation import evaluate

__all__ = ["doubtful_lines", "doubtful_numbers", "open_sections"]

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

_AGREED = 1e-3
"""Two routes to the volume agree to this."""

_PLACES = 6
"""Places on each segment between which sections are taken as straight, to find crossings."""


def doubtful_lines(
    net: Net, layout: Layout, sections: Sections, kinds: NDArray[np.int8]
) -> list[str]:
    """Say which lines cannot bound a hull, wherever it floats.

    Parameters
    ----------
    net : Net
        The lines.
    layout : Layout
        How the surface through them is put together.
    sections : Sections
        The sections as drawn.
    kinds : (n,) int8
        The `PointKind` of each defining point of the net.
    """
    return [
        *_lost(layout),
        *_crossing(net, sections),
        *_kinked(net, sections, kinds),
        *_apart(net, _GAP * _half_breadth(net)),
    ]


def _half_breadth(net: Net) -> float:
    """Give the greatest half breadth of the lines, m."""
    return float(np.abs(net.batch.xyz[:, 1]).max())


def doubtful_numbers(
    sections: Sections,
    coarse: Sequence[Coarse],
    routes: tuple[FloatArray, FloatArray],
    planes: Planes,
) -> list[str]:
    """Say where comparisons disagree by more than lines do on a ship.

    Parameters
    ----------
    sections : Sections
        The sections as drawn.
    coarse : sequence of Coarse
        The hull without some of them.
    routes : ((d,), (d,)), m3
        The volume below each plane, by sections and by waterplanes.
    planes : Planes
        d planes.
    """
    return [*_unexpected(sections, coarse, planes), *_routes(*routes)]


def _lost(layout: Layout) -> Iterator[str]:
    for each in layout.lost:
        yield f"{', '.join(each.names)}: between two sections {each.why}"


def open_sections(net: Net, sections: Sections, planes: Planes) -> list[str]:
    """Say which sections end off the centre plane below one of the planes."""
    most = _OPEN * _half_breadth(net)
    point = sections.curves.point[sections.curves.start[:-1], 0]
    x, y, z = point.T
    level = planes.height[:, None] + planes.tan_trim[:, None] * x
    level = level + np.abs(planes.tan_heel)[:, None] * np.abs(y)
    wet = (z < level).any(axis=0)
    return [
        f"{net.name[int(sections.curve[i])]} is open: it ends {y[i]:.3f} m off the centre plane, "
        f"at z {z[i]:.3f} m"
        for i in np.flatnonzero(wet & (np.abs(y) > most)).tolist()
    ]


def _crossing(net: Net, sections: Sections) -> Iterator[str]:
    """Find sections that cross themselves."""
    u = np.linspace(0.0, 1.0, _PLACES + 1)[:-1]
    power = u[:, None] ** np.arange(4)
    for i, curve in enumerate(sections.curve.tolist()):
        a, b = sections.curves.start[i : i + 2]
        tiles = sections.curves.point[a:b][~sections.curves.deck[a:b]]
        place = np.einsum("qc,scx->sqx", power, tiles[:, :, 1:]).reshape(-1, 2)
        place = np.concatenate([place, tiles[-1:, :, 1:].sum(axis=1)])
        meets = _self_crossing(place)
        if meets is not None:
            y, z = meets.tolist()
            yield f"{net.name[curve]} crosses itself at y {y:.3f} m, z {z:.3f} m"


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


def _kinked(net: Net, sections: Sections, kinds: NDArray[np.int8]) -> Iterator[str]:
    """Find sections that turn sharply at a smooth point, and back before and behind it."""
    for curve in sections.curve.tolist():
        a, b = net.batch.start[curve : curve + 2]
        chord = np.diff(net.batch.xyz[a:b, 1:], axis=0)
        if len(chord) < 4:
            continue
        turn = np.arctan2(_cross(chord[:-1], chord[1:]), (chord[:-1] * chord[1:]).sum(axis=1))
        middle = turn[1:-1]
        back = np.maximum(turn[:-2] * -np.sign(middle), turn[2:] * -np.sign(middle))
        smooth = kinds[a + 2 : b - 2] == PointKind.SMOOTH
        kink = (np.abs(middle) > _TURN) & (back > _BACK)
        sharp = np.flatnonzero((kink | (np.abs(middle) > _HAIRPIN)) & smooth)
        if len(sharp):
            y, z = net.batch.xyz[a + 2 + sharp[0], 1:].tolist()
            angle = float(np.degrees(abs(middle[sharp[0]])))
            yield (
                f"{net.name[curve]} has a kink of {angle:.0f} deg at y {y:.3f} m, z {z:.3f} m, "
                "where no knuckle is drawn"
            )


def _apart(net: Net, most: float) -> Iterator[str]:
    """Find crossings at which one line passes the other."""
    if not len(net.meets):
        return
    one, other = (evaluate(net.batch, net.meets[:, i], net.place[:, i]) for i in (0, 1))
    gap = np.sqrt(((one - other) ** 2).sum(axis=1))
    for k in np.flatnonzero((gap > most) & ~net.watched).tolist():
        a, b = (net.name[i] for i in net.meets[k].tolist())
        x, y, z = one[k].tolist()
        yield f"{a} and {b} pass by {gap[k]:.3f} m at x {x:.2f}, y {y:.2f}, z {z:.2f} m"


def _unexpected(sections: Sections, coarse: Sequence[Coarse], planes: Planes) -> Iterator[str]:
    """Find sections whose area is not what their neighbours make one expect."""
    own = sections.per_station(sections_below(sections.curves, planes))
    most = own.max(axis=1)
    for each in coarse:
        x = stands(each.net)
        for i, place in enumerate(sections.x.tolist()):
            if np.abs(x - place).min() > 1e-6:
                at, strips = np.array([place]), each.prepared.strips
                found = areas_between(each.layout, strips, x, at, planes)
                if found is None:
                    continue
                area = found[:, 0]
                off = np.abs(area - own[:, i]) / most
                if (off > _EXPECTED).any():
                    k = int(off.argmax())
                    yield (
                        f"{sections.names[i]} has {own[k, i]:.2f} m2 where its neighbours "
                        f"make one expect {area[k]:.2f} m2"
                    )


def _routes(sections: FloatArray, waterplanes: FloatArray) -> Iterator[str]:
    """Compare the volume by sections with that by waterplanes."""
    off = np.abs(waterplanes - sections) / np.maximum(sections, 1e-300)
    if (off > _AGREED).any():
        k = int(off.argmax())
        yield (
            f"the volume is {sections[k]:.2f} m3 by sections and {waterplanes[k]:.2f} m3 by "
            "waterplanes"
        )
