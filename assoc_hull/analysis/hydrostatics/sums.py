"""The numbers that a record of hydrostatics is computed from, hull and appendages together."""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.floating_body import Change, StationAreas
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.floating.immersed import Immersed
from assoc_hull.geometry.numeric.dual import is_plain, real

__all__ = ["Layout", "Sums", "change_of", "sums_of"]


@attrs.frozen(eq=False)
class Sums:
    """Integrals and sections of both sides below each of d planes, all (d,); as `Immersed`.

    Attributes
    ----------
    volume, moment_x, moment_y, moment_z : m3, m4
        With appendages.
    area, area_x, area_y, area_xx, area_xy, area_yy : m2, m3, m4
        Of the waterplane in plan.
    shell : m2
        Wetted surface: shell, closed deck, appendages, and the transom if it counts.
    girth : m2
        Integral of the girth over the length, of the shell alone.
    x_least, x_most, y_least, y_most : m
        Extent of the waterplane.
    transom : m2
        Immersed transom.
    a_max, x_a_max, a_midship : m2, m, m2
        The largest station, where it is, and the section at Lpp / 2.
    """

    volume: FloatArray
    moment_x: FloatArray
    moment_y: FloatArray
    moment_z: FloatArray
    area: FloatArray
    area_x: FloatArray
    area_y: FloatArray
    area_xx: FloatArray
    area_xy: FloatArray
    area_yy: FloatArray
    shell: FloatArray
    girth: FloatArray
    x_least: FloatArray
    x_most: FloatArray
    y_least: FloatArray
    y_most: FloatArray
    transom: FloatArray
    a_max: FloatArray
    x_a_max: FloatArray
    a_midship: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(*attrs.astuple(self, recurse=False))


@attrs.frozen
class Layout:
    """What of a hull counts as what.

    Attributes
    ----------
    middle : float, m
        x of Lpp / 2.
    transom : bool
        The transom is a part of the wetted surface.
    """

    middle: float
    transom: bool = False


def sums_of(
    immersed: Immersed, stations: StationAreas, transom: FloatArray, layout: Layout
) -> Sums:
    """Bring together what is measured of a hull.

    Parameters
    ----------
    immersed : Immersed
        The integrals.
    stations : StationAreas
        Areas of the stations. The section at Lpp / 2 is the station there; if there is none, the
        cubic through the four stations next to it.
    transom : (d,), m2
        Immersed area of the transom.
    layout : Layout
        Where Lpp / 2 is, and what counts.
    """
    return _joined(immersed, stations, transom, layout, _largest(stations, layout.middle))


def change_of(change: Change, stations: StationAreas, layout: Layout) -> Sums:
    """Bring together changes of what is measured; nan where they are not known.

    Parameters
    ----------
    change : Change
        The changes.
    stations : StationAreas
        The stations, not changed: the largest of them stays the largest.
    layout : Layout
        As for `sums_of`.
    """
    most = _largest(stations, layout.middle)
    areas = np.full_like(stations.area, np.nan) if change.areas is None else change.areas
    unknown = np.full(len(most), np.nan)
    transom = unknown if change.transom is None else change.transom
    changed = attrs.evolve(stations, area=areas)
    found = _joined(change.immersed, changed, transom, layout, most)
    return attrs.evolve(found, x_a_max=unknown)


def _joined(
    immersed: Immersed,
    stations: StationAreas,
    transom: FloatArray,
    layout: Layout,
    most: IntArray,
) -> Sums:
    found = {
        field.name: getattr(immersed, field.name)
        for field in attrs.fields(Immersed)
        if field.name != "wet_deck"
    }
    if layout.transom:
        found["shell"] = immersed.shell + transom
    return Sums(
        **found,
        transom=transom,
        a_max=stations.area[np.arange(len(most)), most],
        x_a_max=stations.x[most],
        a_midship=_section(stations, layout.middle),
    )


def _largest(stations: StationAreas, middle: float) -> IntArray:
    """Give which station is the largest, (d,): of equal ones that next to Lpp / 2."""
    area = real(stations.area)
    most = area.max(axis=1, keepdims=True)
    away = np.abs(real(stations.x) - real(middle))
    off = np.where(area >= most * (1.0 - 1e-12), away, np.inf)
    found: IntArray = off.argmin(axis=1)
    return found


def _section(stations: StationAreas, x: float) -> FloatArray:
    """Give the area of a section at x, (d,), m2, by Lagrange's cubic where no station is.

    A station at x may move away from it, to either side: then it is one of four stations or one
    of another four, and the derivative is the mean of both.
    """
    known, count, place = real(stations.x), min(4, len(stations.x)), float(real(x))
    near = int(np.argmin(np.abs(known - place)))
    there = abs(known[near] - place) <= 1e-9 * max(abs(place), 1.0)
    if there and is_plain(stations.x) and is_plain(x):
        found: FloatArray = stations.area[:, near]
        return found
    after = (near, near + 1) if there else (int(np.searchsorted(known, place)),)
    begin = [int(np.clip(each - 2, 0, len(known) - count)) for each in after]
    areas = [_cubic(stations, x, first, count) for first in begin]
    return sum(areas[1:], areas[0]) / len(areas)


def _cubic(stations: StationAreas, x: float, first: int, count: int) -> FloatArray:
    knots = [stations.x[i] for i in range(first, first + count)]
    areas = [stations.area[:, i] for i in range(first, first + count)]
    return lagrange(knots, areas, x)


def lagrange(knots: Sequence[FloatArray], values: Sequence[FloatArray], x: float) -> FloatArray:
    """Give at x the polynomial that has given values at given places."""
    found = 0.0 * values[0]
    for i, (knot, value) in enumerate(zip(knots, values, strict=True)):
        weight = 1.0 + 0.0 * knot
        for j, other in enumerate(knots):
            if j != i:
                weight = weight * (x - other) / (knot - other)
        found = found + weight * value
    return found
