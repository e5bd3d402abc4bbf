"""What class a plate is, and the axis about which it can be rolled.

The developable part is split into cylinder and flat by interpolated curvature, not by nodes alone:
an inflected plate has a flat strip that nodes miss.
The texts are advice and no instruction; a yard replaces them by its own.

The direction a plate is rolled about, and how well a single one serves all of it.

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
>>> from assoc_hull.surface.plating.plate_class import roll_axis
>>> x, y = np.mgrid[-3:3:3j, -1:1:3j]
>>> trough = np.stack([x, y, 0.2 * np.abs(y)], axis=-1)
>>> found = roll_axis(curvature_nodes(Patches.single(trough)), np.eye(3))
>>> round(found.angle_deg, 9), round(found.coherence, 9)
(0.0, 1.0)
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

import attrs
import numpy as np
from numpy.polynomial.legendre import legvander

from assoc_hull.arguments import choice, shown, text
from assoc_hull.errors import WrongTypeError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.numeric.quadrature import lobatto
from assoc_hull.surface.plating.curvature_nodes import CurvatureNodes
from assoc_hull.surface.regions.level_lines import RegionAreas

__all__ = [
    "CAVEAT",
    "KINDS",
    "SUGGESTIONS",
    "PlateShares",
    "RollAxis",
    "Rulings",
    "flat_share",
    "roll_axis",
    "rulings",
    "shares_of",
    "suggestion_key",
    "suggestions_with",
]

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


# Source: "Curvature Region Analysis for Application of Plates Forming", J. SNAK, which says itself
# that heating patterns deviate near the borders of regions and that hot work relaxes cold rolling.

SUGGESTIONS: dict[str, str] = {
    "flat": "none, or straightening",
    "cylinder": "roll or press-brake about the roll axis, to the radii given",
    "cone": "press with turned rolls, by the table of rulings",
    "saddle": "pre-roll about the roll axis where there is one, then shrink the centre band "
    "relative to the edges: line heating along the centre",
    "convex": "pre-roll about the roll axis where there is one, then shrink the edges: line or "
    "triangle heating from the free edges",
    "mixed": "by region; heat where the strain exceeds the tolerance, with care where convex and "
    "saddle regions meet",
}
"""What is advised, by class; "cone" is a developable plate without a common roll axis."""

CAVEAT = (
    "Advice only: heating patterns deviate near the borders of regions, where edges are stiff, "
    "and hot work can relax a shape that was rolled cold."
)
"""What every table of suggestions has to say."""


def suggestions_with(own: object, where: str = "in plates") -> dict[str, str]:
    """Give the texts by class, some replaced.

    Parameters
    ----------
    own : mapping of str to str, or None
        Texts by "flat", "cylinder", "cone", "saddle", "convex", "mixed".
    where : str
        Where it was given, for messages.

    Raises
    ------
    BadInputError, WrongTypeError
        Another class, no text.
    """
    if own is None:
        return dict(SUGGESTIONS)
    if not isinstance(own, Mapping):
        remedy = f"give texts by {', '.join(SUGGESTIONS)}"
        raise WrongTypeError(f"suggestions is {shown(own)}", where, remedy)
    given = {}
    for key, value in own.items():
        kind = choice(key, "a key of suggestions", SUGGESTIONS, where)
        given[kind] = text(value, f"the text of {kind}", where)
    return SUGGESTIONS | given


def suggestion_key(kind: str, rollable: bool, single_axis: bool) -> str:
    """Give the key of the advice for a plate.

    Parameters
    ----------
    kind : str
        Its class.
    rollable : bool
        Whether it is developable, whatever it is called.
    single_axis : bool
        Whether one roll axis serves all of it.

    Examples
    --------
    >>> from assoc_hull.surface.plating.plate_class import suggestion_key
    >>> suggestion_key("mixed", rollable=True, single_axis=True)
    'cylinder'
    """
    if kind == "flat" or not rollable:
        return kind
    return "cylinder" if single_axis else "cone"


# --------------------------------------------------------------------------------------
# The flat part. An inflected plate has a narrow flat strip that nodes of a quadrature rule miss, or
# count as a twentieth of the plate. So Gaussian and mean curvature, which are smooth, are
# interpolated by the polynomials through the nodes, and principal curvatures are taken from them.

_FINE = 128
"""Places each way on a patch."""

_AT_ONCE = 32
"""Patches that are sampled in one go: 30 MB."""


def flat_share(nodes: CurvatureNodes, k0: float, flat_bend: float) -> float:
    """Give the flat part, 0 to 1, of the region of a plate without Gaussian curvature.

    It is 0 without such a region. `k0`, 1/m2, is half the width of the band of what counts as none;
    with 0 the whole plate is looked at. A plate is flat up to a principal curvature of `flat_bend`,
    1/m.
    """
    parts = [
        _areas(nodes, slice(first, first + _AT_ONCE), k0, flat_bend)
        for first in range(0, len(nodes.area), _AT_ONCE)
    ]
    zero, flat = np.concatenate(parts, axis=1).sum(axis=1).tolist()
    return flat / zero if zero > 0.0 else 0.0


def _areas(nodes: CurvatureNodes, rows: slice, k0: float, flat_bend: float) -> FloatArray:
    """Give the areas without Gaussian curvature and the flat ones of some patches, (2, k), m2."""
    count = nodes.area.shape[-1]
    _, weight = lobatto(count)
    density, gauss, mean = (
        _finer(each[rows])
        for each in (nodes.area / np.outer(weight, weight), nodes.gauss, nodes.mean)
    )
    bent = np.abs(mean) + np.sqrt(np.maximum(mean**2 - gauss, 0.0))
    zero = np.maximum(density, 0.0) * ((np.abs(gauss) <= k0) if k0 else 1.0)
    return np.stack([zero.sum(axis=(1, 2)), (zero * (bent <= flat_bend)).sum(axis=(1, 2))])


def _finer(values: FloatArray) -> FloatArray:
    """Interpolate values (k, q, q) at nodes to the middles of even steps, (k, n, n)."""
    rows = _through(values.shape[-1])
    return np.asarray(rows @ values @ rows.T)


@lru_cache
def _through(count: int) -> FloatArray:
    """Give the matrix from nodes of Lobatto's rule to the middles of even steps, (n, count)."""
    at, _ = lobatto(count)
    middles = (np.arange(_FINE) + 0.5) / _FINE
    vander = legvander(2.0 * at - 1.0, count - 1)
    found = np.linalg.solve(vander.T, legvander(2.0 * middles - 1.0, count - 1).T).T
    freeze(found)
    return np.asarray(found)


# --------------------------------------------------------------------------------------
# Shares and classes.

KINDS = ("flat", "cylinder", "saddle", "convex", "mixed")
"""The classes of plates."""

_ROUNDING = 1e-9
"""A share is not below a limit by rounding."""


@attrs.frozen
class PlateShares:
    """Parts of the area of a plate; together 1, within the tolerance of areas.

    Attributes
    ----------
    convex : float
        Where K > K0.
    saddle : float
        Where K < -K0.
    cylinder : float
        Where |K| <= K0, but bent. Parted from `flat` by samples, 128 each way on a patch: the
        border between both may be off by half a step.
    flat : float
        Where |K| <= K0, and no curvature exceeds that of the sagitta which is neglected.
    unresolved : float
        What may belong to any of these.
    """

    convex: float
    saddle: float
    cylinder: float
    flat: float
    unresolved: float

    @property
    def developable(self) -> float:
        """What can be made without straining the plate: cylinder and flat."""
        return self.cylinder + self.flat

    def kind(self, share: float) -> str:
        """Give the class: the region that has this share at least, else "mixed"."""
        for kind in KINDS[:-1]:
            if getattr(self, kind) >= share - _ROUNDING:
                return kind
        return "mixed"

    def rollable(self, share: float) -> bool:
        """Tell whether so much is developable, whatever the plate is called."""
        return self.developable >= share - _ROUNDING

    def order(self, share: float) -> int:
        """Give 1 for a flat plate, 2 for one bent one way, 3 for one bent both ways.

        A mixed plate of cylinder and flat parts is bent one way.
        """
        if self.kind(share) == "flat":
            return 1
        return 2 if self.rollable(share) else 3


def shares_of(
    areas: RegionAreas, nodes: CurvatureNodes, k0: float, flat_bend: float
) -> PlateShares:
    """Give the shares of regions; the developable part is split into cylinder and flat by samples.

    `k0`, 1/m2, is half the width of the band; with 0 all samples decide which part of the zero
    region is flat, up to a principal curvature of `flat_bend`, 1/m.
    """
    flat = flat_share(nodes, k0, flat_bend)
    zero = areas.zero_share
    return PlateShares(
        areas.positive_share, areas.negative_share, zero * (1.0 - flat), zero * flat,
        areas.unresolved_share,
    )  # fmt: skip
