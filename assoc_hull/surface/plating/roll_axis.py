"""The direction a plate is rolled about, and how well a single one serves all of it.

A plate is rolled about the direction of its smaller principal curvature. Directions are averaged
as axes, not as vectors: with theta the angle of the bending direction (that of the larger
principal curvature) in the plane of e1 and e2,

    z = sum of dA (|k_large| - |k_small|) exp(2 i theta),   roll axis = arg(z) / 2 + 90 degrees

and the coherence is |z| over the sum of the weights: 1 where all directions agree.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.bezier_patches import Patches
>>> from assoc_hull.surface.plating.curvature_nodes import curvature_nodes
>>> from assoc_hull.surface.plating.roll_axis import roll_axis
>>> x, y = np.mgrid[-3:3:3j, -1:1:3j]
>>> trough = np.stack([x, y, 0.2 * np.abs(y)], axis=-1)
>>> found = roll_axis(curvature_nodes(Patches.single(trough)), np.eye(3))
>>> round(found.angle_deg, 9), round(found.coherence, 9)
(0.0, 1.0)
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.surface.plating.curvature_nodes import CurvatureNodes

__all__ = ["RollAxis", "Rulings", "roll_axis", "rulings"]

COHERENT = 0.8
"""Below this coherence no single axis serves."""

_STILL = 1e-9
"""A direction whose part in the plane of the plate is below this has no angle there."""

_SAME_DEG = 1e-7
"""So little below 180 degrees an axis is one of 0: what rounding makes of it."""


@attrs.frozen(eq=False)
class RollAxis:
    """A mean direction that a plate is rolled about.

    Attributes
    ----------
    angle_deg : float
        From e1 towards e2, 0 to below 180 degrees; nan where nothing is bent.
    coherence : float
        How well the directions agree, 0 to 1; 0 where nothing is bent.
    direction : (3,)
        The same direction in space, a unit vector in the plane of e1 and e2.
    """

    angle_deg: float
    coherence: float
    direction: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.direction)


@attrs.frozen(eq=False)
class Rulings:
    """How rulings turn along a plate: a table for its stations along e1.

    Attributes
    ----------
    station : (s,), m
        Distance of the middle of each stretch from the end of the plate, along e1.
    angle_deg : (s,)
        Mean angle of the ruling there from e1 towards e2, 0 to below 180 degrees; nan where
        nothing is bent.
    radius : (s,), m
        One over the mean of the larger principal curvature; inf where nothing is bent.
    """

    station: FloatArray
    angle_deg: FloatArray
    radius: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.station, self.angle_deg, self.radius)

    def __str__(self) -> str:
        """Give station, angle and radius of each stretch in a line."""
        rows = zip(self.station, self.angle_deg, self.radius, strict=True)
        return "; ".join(f"at {x:.2f} m {angle:.1f} deg R {r:.2f}" for x, angle, r in rows)


def roll_axis(nodes: CurvatureNodes, axes: FloatArray) -> RollAxis:
    """Average the direction of the smaller principal curvature over a plate.

    Parameters
    ----------
    nodes : CurvatureNodes
        Those of all patches of the plate.
    axes : (3, 3)
        e1, e2, e3 as rows.

    Returns
    -------
    RollAxis
        Angle, coherence, direction.
    """
    weight, turn = _turns(nodes, axes)
    z, whole = complex((weight * turn).sum()), float(weight.sum())
    if not whole > 0.0 or z == 0.0:
        return RollAxis(float("nan"), 0.0, np.full(3, np.nan))
    angle = _axis_deg(np.array([z]))[0]
    direction = np.cos(np.radians(angle)) * axes[0] + np.sin(np.radians(angle)) * axes[1]
    return RollAxis(float(angle), min(abs(z) / whole, 1.0), direction)


def rulings(nodes: CurvatureNodes, axes: FloatArray, count: int = 9) -> Rulings:
    """Give the mean ruling in even stretches along a plate.

    Parameters
    ----------
    nodes : CurvatureNodes
        Those of all patches of the plate.
    axes : (3, 3)
        e1, e2, e3 as rows.
    count : int
        How many stretches.

    Returns
    -------
    Rulings
        Stations, angles, radii.
    """
    weight, turn = _turns(nodes, axes)
    along = (nodes.place @ axes[0]).ravel()
    low, high = along.min(), along.max()
    stretch = np.minimum((along - low) / (high - low) * count, count - 1).astype(np.intp)
    z = np.zeros(count, np.complex128)
    np.add.at(z, stretch, (weight * turn).ravel())
    area = np.bincount(stretch, nodes.area.ravel(), count)
    bent = np.bincount(stretch, (nodes.area * nodes.bent).ravel(), count)
    radius = np.divide(area, bent, out=np.full(count, np.inf), where=bent > 0.0)
    station = (np.arange(count) + 0.5) * (high - low) / count
    return Rulings(station, np.where(z == 0.0, np.nan, _axis_deg(z)), radius)


def _turns(
    nodes: CurvatureNodes, axes: FloatArray
) -> tuple[FloatArray, np.typing.NDArray[np.complex128]]:
    """Give the weight of each node, and its bending direction doubled, of amount 1."""
    x, y = nodes.bending @ axes[0], nodes.bending @ axes[1]
    weight = nodes.area * (nodes.bent - nodes.other)
    turn = (x + 1j * y) ** 2
    size = np.abs(turn)
    seen = size > _STILL**2
    return np.where(seen, weight, 0.0), np.divide(turn, size, out=turn * 0.0, where=seen)


def _axis_deg(z: np.typing.NDArray[np.complex128]) -> FloatArray:
    """Give the axis at right angles to a doubled direction, 0 to below 180 degrees."""
    found = np.mod(0.5 * np.degrees(np.angle(z)) + 90.0, 180.0)
    return np.where(found > 180.0 - _SAME_DEG, 0.0, found)
