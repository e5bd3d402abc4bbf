"""A plate of a hull judged: areas, what is in doubt, class, axis, strains.

Examples
--------
>>> from assoc_hull.surface.plates.judging import rung
>>> rung(1e-3, 5e-4), rung(1e-3, 3e-3), rung(1e-3, None)
(0.001, 0.004, 0.001)
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from assoc_hull.surface.plates.curvature_nodes import CurvatureNodes
from assoc_hull.surface.plates.doubt import Doubt
from assoc_hull.surface.plates.hull_plate import COARSE, TOO_COARSE, HullPlate
from assoc_hull.surface.plates.hull_seams import PlateRange
from assoc_hull.surface.plates.options import PlateOptions
from assoc_hull.surface.plates.plate_class import Shares
from assoc_hull.surface.plates.plate_nodes import PlateNodes
from assoc_hull.surface.plates.plate_of import radius
from assoc_hull.surface.plates.roll_axis import COHERENT, roll_axis
from assoc_hull.surface.plates.suggestions import suggestion_key
from assoc_hull.surface.plates.tally import Tally

__all__ = ["judged", "rung"]

_WIDE = 2.0
"""What is farther from K0 than by this factor is not contested."""

_SEEN = 0.01
"""A part of a plate below this is not told."""


def rung(k0: float, dk: float | None) -> float:
    """Double a band until it is not narrower than what curvature is known to, 1/m2."""
    if dk is None or not dk > k0:
        return k0
    return float(k0 * 2.0 ** np.ceil(np.log2(dk / k0)))


def judged(
    wanted: PlateRange,
    blocks: Sequence[str],
    measured: PlateNodes,
    tallied: Tally,
    doubt: Doubt,
    band: tuple[float, float],
    asked: float,
    options: PlateOptions,
) -> HullPlate:
    """Put a plate together.

    Parameters
    ----------
    wanted : PlateRange
        Between which places it lies.
    blocks : sequence of str
        The blocks it has a part of.
    measured : PlateNodes
        Its nodes.
    tallied : Tally
        Its areas above the levels of `levels_about`.
    doubt : Doubt
        What other fits make of it.
    band : (float, float), 1/m2 and m
        K0, and the breadth it is meant for.
    asked : float, 1/m2
        K0 before it was widened.
    options : PlateOptions
        By what plates are told apart.
    """
    nodes, (k0, band_breadth) = measured.nodes, band
    axes = measured.axes
    breadth, length = np.sort(measured.extents(axes)).tolist()
    shares = _shares(tallied, nodes, k0, options.flat_bend(band_breadth))
    contested = _contested(tallied)
    changed = doubt.changed(nodes.gauss, nodes.area, k0, _WIDE, asked)
    coarse = contested + changed > COARSE
    kind = None if coarse else _kind(shares, options.share)
    rollable = shares.rollable(options.share)
    axis = roll_axis(nodes, axes)
    single = kind != "flat" and axis.coherence >= COHERENT
    strain, amount = breadth**2 / 8.0, np.abs(nodes.gauss)
    whole = float((nodes.area * amount).sum())
    there = nodes.bent[nodes.area > 0.0]
    return HullPlate(
        name=wanted.name, range=wanted, blocks=tuple(blocks), area=tallied.area,
        area_error=tallied.off, length=length, breadth=breadth, axes=axes, dk=doubt.dk, k0=k0,
        shares=shares, contested=contested, changed=changed, kind=kind,
        order=None if kind is None else shares.order(options.share), rollable=rollable,
        roll_axis=axis.angle_deg if single else None,
        roll_direction=axis.direction if single else None, coherence=axis.coherence,
        least_radius=radius(float(there.max())),
        largest_radius=radius(0.0 if shares.flat > 0.0 else float(there.min())),
        total_curvature=whole, mean_strain=strain * whole / float(nodes.area.sum()),
        largest_strain=strain * float(amount[nodes.area > 0.0].max()),
        suggestion=_advice(kind, coarse, rollable, single, options),
        notes=_notes(wanted.name, tallied, contested, changed, doubt, k0 / asked), nodes=nodes,
    )  # fmt: skip


def _kind(shares: Shares, share: float) -> str | None:
    """Give the class; None where what is unresolved could make it another one."""
    kind = shares.kind(share)
    return None if kind == "mixed" and shares.unresolved > 1.0 - share else kind


def _shares(tallied: Tally, nodes: CurvatureNodes, k0: float, flat_bend: float) -> Shares:
    """Give the shares of regions."""
    area, settled = tallied.area, tallied.area - tallied.margin
    convex, not_saddle = tallied.above[:2].tolist()
    saddle = max(settled - not_saddle, 0.0)
    zero = max(settled - convex - saddle, 0.0)
    small = nodes.area * (np.abs(nodes.gauss) <= k0)
    whole = float(small.sum())
    flat = float((small * (nodes.bent <= flat_bend)).sum()) / whole if whole > 0.0 else 0.0
    return Shares(
        convex / area, saddle / area, zero * (1.0 - flat) / area, zero * flat / area,
        tallied.margin / area,
    )  # fmt: skip


def _contested(tallied: Tally) -> float:
    """Give the part with K0/2 <= |K| <= 2 K0."""
    half, minus_half, double, minus_double = tallied.above[2:].tolist()
    return float(max(half - double + minus_double - minus_half, 0.0) / tallied.area)


def _advice(
    kind: str | None, coarse: bool, rollable: bool, single: bool, options: PlateOptions
) -> str:
    """Give the suggestion; none for a plate without a class."""
    if kind is None:
        return TOO_COARSE if coarse else "none: too much of it is unresolved"
    return options.suggestions[suggestion_key(kind, rollable, single)]


def _notes(
    name: str, tallied: Tally, contested: float, changed: float, doubt: Doubt, wider: float
) -> tuple[str, ...]:
    """Say what is to be known of a plate."""
    found = []
    if contested + changed > COARSE:
        more = f", other fits change {100.0 * changed:.0f} % more" if changed > _SEEN else ""
        found.append(
            f"{name}: {TOO_COARSE}: {100.0 * contested:.0f} % of it lies within a factor of 2 of "
            f"K0{more}; take more lines there, or a larger strain tolerance."
        )
    elif wider > 1.0:
        found.append(
            f"{name}: its regions are told by {wider:.0f} times the K0 that was asked for; below "
            "that, curvature is one of the fit."
        )
    margin = tallied.margin / tallied.area
    if margin > _SEEN:
        found.append(
            f"{name}: {100.0 * margin:.0f} % of it lies within a span of a border of blocks or of "
            "a tangent corner, and is unresolved."
        )
    if doubt.dk is not None and doubt.part < 1.0 - COARSE:
        found.append(f"{name}: other fits are told on {100.0 * doubt.part:.0f} % of it only.")
    return tuple(found)
