"""Volumes of a ship by boundary data: exact areas of sections, integrated along the ship.

The curve of areas has corners wherever a line has a point, begins or ends, or where the keel
passes a waterline. Between these places it is smooth, and rules of Gauss of two orders tell how
far it is off; where they differ too much the interval is halved.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray

if TYPE_CHECKING:
    from assoc_hull.creation.classical.seaking import Seaking

__all__ = ["Sums", "breaks_of", "sums"]

_LESS, _MORE = 4, 7
"""Nodes of the two rules."""

_ENOUGH = 1e-9
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


def sums(ship: Seaking, level: float | None = None) -> Sums:
    """Integrate below a height (m), or all of it.

    Parameters
    ----------
    ship : Seaking
        The definition.
    level : float or None, m
        Above the base line; None for the whole, its decks included.
    """
    height = 1e6 if level is None else float(level)
    places = breaks_of(ship, height)
    low, high = places[:-1], places[1:]
    total, error, whole = np.zeros(4), 0.0, 0.0
    for turn in range(_HALVINGS + 1):
        fine, coarse = (_rule(ship, low, high, height, count) for count in (_MORE, _LESS))
        off = np.abs(fine[:, 0] - coarse[:, 0])
        whole = max(whole, float(fine[:, 0].sum()))
        done = (off <= _ENOUGH * whole) | (turn == _HALVINGS)
        total += fine[done].sum(axis=0)
        error += float(off[done].sum())
        if done.all():
            break
        middle = 0.5 * (low + high)[~done]
        low, high = (
            np.concatenate([low[~done], middle]), np.concatenate([middle, high[~done]])
        )  # fmt: skip
    volume = max(float(total[0]), np.finfo(np.float64).tiny)
    plane = 0.0 if level is None else float(total[3])
    return Sums(float(total[0]), total[1] / volume, total[2] / volume, plane, error)


def _rule(ship: Seaking, low: FloatArray, high: FloatArray, level: float, count: int) -> FloatArray:
    """Integrate area, its moments over x and z, and breadth over each interval, (n, 4)."""
    node, weight = np.polynomial.legendre.leggauss(count)
    half = 0.5 * (high - low)
    place = 0.5 * (low + high)[:, None] + half[:, None] * node
    found = ship.sections(place.ravel())
    area = np.array([each.area(level) for each in found])
    values = np.stack(
        [
            area, area * place.ravel(), np.array([each.moment(level) for each in found]),
            2.0 * np.nan_to_num([each.half_breadth(level) for each in found]),
        ],
        axis=-1,
    )  # fmt: skip
    summed = np.einsum("nkc,k->nc", values.reshape(len(low), count, 4), weight)
    return np.asarray(summed * half[:, None])


def breaks_of(ship: Seaking, level: float) -> FloatArray:
    """Give the places (m) at which the curve of areas below a height (m) is not smooth."""
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
    heights = np.array([*(each.z for each in ship.waterlines), level])
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
