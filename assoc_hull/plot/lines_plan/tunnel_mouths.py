"""Mouths of tunnels on a lines plan: closed curves on the shell, and lines that end at them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.model.tables import HullState

__all__ = ["PlotMouth", "mouths_of", "outside_mouths"]


@attrs.frozen(eq=False)
class PlotMouth:
    """The mouth of a tunnel to port.

    Attributes
    ----------
    name : str
        Of the tunnel.
    x, z, radius : float, m
        Of its axis, and of its inside.
    points : (n, 3), m
        Around the mouth; the last is the first.
    """

    name: str
    x: float
    z: float
    radius: float
    points: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.points)


def mouths_of(state: HullState) -> tuple[PlotMouth, ...]:
    """Take the mouths of the tunnels that a hull holds, as its shell is now."""
    if not state.tunnels:
        return ()
    from assoc_hull.analysis.hydrostatics.tunnel import kept_tunnels

    return tuple(
        PlotMouth(
            each.name, each.x, each.z, each.radius, np.concatenate([each.mouth, each.mouth[:1]])
        )
        for each in kept_tunnels(state)
    )


def outside_mouths(points: FloatArray, mouths: Sequence[PlotMouth]) -> Iterator[FloatArray]:
    """Give the pieces of a polyline on the shell, (n, 3), m, that lie in no mouth."""
    pieces = [points]
    for mouth in mouths:
        pieces = [part for each in pieces for part in _outside(each, mouth)]
    yield from pieces


def _outside(points: FloatArray, mouth: PlotMouth) -> Iterator[FloatArray]:
    """Give what of a polyline lies outside one cylinder."""
    from_axis = points[:, [0, 2]] - [mouth.x, mouth.z]
    way = np.diff(from_axis, axis=0)
    # On a chord from_axis + t way the distance from the axis is the radius at roots of a square.
    square, half = (way * way).sum(axis=1), (from_axis[:-1] * way).sum(axis=1)
    rest = (from_axis[:-1] ** 2).sum(axis=1) - mouth.radius**2
    under = half * half - square * rest
    met = np.flatnonzero((under > 0.0) & (square > 0.0))
    if not len(met):
        if not len(rest) or rest[0] >= 0.0:
            yield points
        return
    root = np.sqrt(under[met])
    part = np.stack([-half[met] - root, -half[met] + root]) / square[met]
    inside = (part > 0.0) & (part < 1.0)
    cuts = (met + part)[inside]
    place = np.unique(np.concatenate([np.arange(len(points), dtype=np.float64), cuts]))
    every = np.column_stack(
        [np.interp(place, np.arange(len(points)), points[:, axis]) for axis in range(3)]
    )
    middle = 0.5 * (every[1:] + every[:-1])[:, [0, 2]] - [mouth.x, mouth.z]
    keep = np.concatenate([[False], (middle * middle).sum(axis=1) >= mouth.radius**2, [False]])
    begins, ends = np.flatnonzero(~keep[:-1] & keep[1:]), np.flatnonzero(keep[:-1] & ~keep[1:])
    for begin, end in zip(begins.tolist(), ends.tolist(), strict=True):
        yield every[begin : end + 1]
