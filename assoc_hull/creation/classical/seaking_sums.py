"""Volumes of a ship by boundary data: exact areas of sections, integrated along the ship.

The curve of areas has corners wherever a line has a point, begins or ends, or where the keel
passes a waterline. Between these places it is smooth, and rules of Gauss of two orders tell how
far it is off; where they differ too much the interval is halved.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import attrs
import numpy as np

from assoc_hull.creation.classical.seaking_sections import Section
from assoc_hull.geometry.classical.arc_area import arc_area, arc_moment
from assoc_hull.geometry.classical.frame import Frame
from assoc_hull.geometry.classical.quadratics import Quadratics
from assoc_hull.geometry.curves import FloatArray

if TYPE_CHECKING:
    from assoc_hull.creation.classical.seaking import Seaking

__all__ = ["Sums", "breaks_of", "sums"]

_LESS, _MORE = np.polynomial.legendre.leggauss(4), np.polynomial.legendre.leggauss(7)
"""Nodes and weights of the two rules."""

_ABOVE = 1e6
"""A height (m) above any ship."""

_ENOUGH = 1e-8
"""Each interval is halved until it is off by no more than this part of the whole."""

_HALVINGS = 8
_SAME = 1e-9


@attrs.frozen
class Sums:
    """Integrals of the part of a hull below a height, both sides, without appendages.

    Attributes
    ----------
    volume : float, m3
        Its volume.
    x, z : float, m
        Its centre.
    waterplane : float, m2
        Area at the height; 0 if all of the hull was asked for.
    error : float, m3
        How far the volume may be off: the sum over intervals of what two rules differ by.
    """

    volume: float
    x: float
    z: float
    waterplane: float
    error: float


def sums(ship: Seaking, levels: Sequence[float | None]) -> tuple[Sums, ...]:
    """Integrate below heights (m), or all of a hull; sections are built once for all of them.

    Parameters
    ----------
    ship : Seaking
        The definition.
    levels : sequence of float or None, m
        Above the base line; None for the whole, its decks included.
    """
    heights = [_ABOVE if each is None else float(each) for each in levels]
    places = breaks_of(ship, heights)
    low, high = places[:-1], places[1:]
    total, error = np.zeros((len(heights), 4)), np.zeros(len(heights))
    whole = np.zeros(len(heights))
    for turn in range(_HALVINGS + 1):
        fine, coarse = (_rule(ship, low, high, heights, each) for each in (_MORE, _LESS))
        off = np.abs(fine[..., 0] - coarse[..., 0])
        whole = np.maximum(whole, fine[..., 0].sum(axis=0))
        done = (off <= _ENOUGH * whole).all(axis=1) | (turn == _HALVINGS)
        total += fine[done].sum(axis=0)
        error += off[done].sum(axis=0)
        if done.all():
            break
        middle = 0.5 * (low + high)[~done]
        low, high = (
            np.concatenate([low[~done], middle]), np.concatenate([middle, high[~done]])
        )  # fmt: skip
    return tuple(
        Sums(
            float(volume), float(x / volume) if volume else 0.0,
            float(z / volume) if volume else 0.0, 0.0 if level is None else float(plane),
            float(doubt),
        )
        for (volume, x, z, plane), doubt, level in zip(total, error, levels, strict=True)
    )  # fmt: skip


def _rule(
    ship: Seaking, low: FloatArray, high: FloatArray, levels: Sequence[float],
    rule: tuple[FloatArray, FloatArray],
) -> FloatArray:  # fmt: skip
    """Integrate area, its moments over x and z, and breadth over each interval, (n, levels, 4)."""
    node, weight = rule
    half = 0.5 * (high - low)
    place = (0.5 * (low + high)[:, None] + half[:, None] * node).ravel()
    built = ship.sections(place)
    values = np.empty((len(place), len(levels), 4))
    for number, level in enumerate(levels):
        values[:, number] = _measured(built, level)
    values[..., 1] *= values[..., 0]
    values[..., 3] = 2.0 * np.nan_to_num(values[..., 3])
    shape = (len(low), len(weight), len(levels), 4)
    summed = np.einsum("nklc,k->nlc", values.reshape(shape), weight)
    return np.asarray(summed * half[:, None, None])


def _measured(built: Sequence[Section], level: float) -> FloatArray:
    """Give area, x, moment and half-breadth of each section below a level, (n, 4).

    Pieces of all frames go through at once.
    """
    found = np.empty((len(built), 4))
    frames = [i for i, each in enumerate(built) if isinstance(each, Frame)]
    for i, each in enumerate(built):
        if not isinstance(each, Frame):
            found[i] = each.area(level), each.x, each.moment(level), each.half_breadth(level)
    if not frames:
        return found
    chosen = [each for each in built if isinstance(each, Frame)]
    parts = [[each.side] if each.deck is None else [each.side, each.deck] for each in chosen]
    joined = Quadratics.join([part for several in parts for part in several])
    count = np.array([sum(len(part) for part in several) for several in parts])
    first = np.cumsum(count) - count
    area, moment = (2.0 * np.add.reduceat(each, first) for each in joined.each_below(level))
    widest = np.fmax.reduceat(np.fmax.reduce(joined.crossings(level), axis=1), first)
    for i, each in enumerate(chosen):
        if each.corner is not None:
            arc, centre = each.corner.arc(), each.corner.centre
            area[i] += 2.0 * arc_area(arc, centre, level)
            moment[i] += 2.0 * arc_moment(arc, centre, level)
    found[frames] = np.column_stack([area, [each.x for each in chosen], moment, widest])
    return found


def breaks_of(ship: Seaking, levels: Sequence[float]) -> FloatArray:
    """Give the places (m) at which the curve of areas below heights (m) is not smooth."""
    first, last = ship.ends
    keel = ship.keel
    lines = [keel.aft, keel.forward]
    found = [
        np.array([first, last, keel.x_a, keel.x_b]), keel.aft[:, 0], keel.forward[:, 0],
        keel.tangent[:, 0], ship.deck.x, ship.camber.rise[:, 0], ship.camber.corner[:, 0],
        *(each.points[:, 0] for each in ship.waterlines),
        *(each.line.x for each in ship.knuckles),
    ]  # fmt: skip
    if ship.parallel is not None:
        found.append(np.array([ship.parallel.first, ship.parallel.last]))
    heights = np.array([*(each.z for each in ship.waterlines), *levels])
    found += [_passes(line, heights) for line in lines]
    places = np.unique(np.concatenate(found))
    places = places[(places >= first) & (places <= last)]
    return np.asarray(places[np.append(True, np.diff(places) > _SAME)])


def _passes(line: FloatArray, heights: FloatArray) -> FloatArray:
    """Give x where straight pieces of a contour (n, 2) pass heights."""
    (x, z), (v, w) = line[:-1].T, line[1:].T
    with np.errstate(divide="ignore", invalid="ignore"):
        part = (heights[:, None] - z) / (w - z)
    inside = np.isfinite(part) & (part > 0.0) & (part < 1.0)
    return np.asarray((x + part * (v - x))[inside])
