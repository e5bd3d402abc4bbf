"""How a plate of a hull is judged: its nodes and extent, and what other fits make of it.

`judge_plate` puts a `Plate` together from areas, nodes and the doubt of other fits.
Where other fits change the curvature by more than the band, the band is doubled until they do not.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Self

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.surface.plating.curvature_nodes import CurvatureNodes, curvature_nodes
from assoc_hull.surface.plating.hull_seams import AXES, PlateRange
from assoc_hull.surface.plating.hull_shell import NODES, HullShell
from assoc_hull.surface.plating.options import PlateOptions
from assoc_hull.surface.plating.plate import COARSE, HullExtent, Plate, assemble_plate
from assoc_hull.surface.plating.plate_areas import TOL, Tally, patches_in
from assoc_hull.surface.plating.plate_class import PlateShares
from assoc_hull.surface.regions.level_lines import RegionAreas

__all__ = [
    "CurvatureDoubt",
    "PlateNodes",
    "doubled_band",
    "judge_plate",
    "nodes_in",
]


_PART = 0.95
"""The change of curvature is what this part of the area stays below."""


@attrs.frozen(eq=False)
class CurvatureDoubt:
    """By how much other fits change the Gaussian curvature of a plate.

    Attributes
    ----------
    dk : float or None, 1/m2
        What the change stays below on 95 % of the area where all fits have a value; None without
        other fits.
    part : float
        That part of the area.
    others : tuple of (...) float, 1/m2
        The curvatures of the other fits at the nodes; nan where they have none.
    """

    dk: float | None
    part: float
    others: tuple[FloatArray, ...]

    @classmethod
    def of(cls, gauss: FloatArray, others: Sequence[FloatArray], area: FloatArray) -> Self:
        """Compare the curvature at nodes, 1/m2, with that of other fits, nan where there is none.

        `area`, m2, is what each node stands for; zero outside the plate.
        """
        if not others:
            return cls(None, 0.0, ())
        change = np.stack([np.abs(each - gauss) for each in others])
        told = np.isfinite(change).all(axis=0) & (area > 0.0)
        size, weight = change[:, told].max(axis=0), area[told]
        whole = float(area.sum())
        if not len(size):
            return cls(None, 0.0, ())
        order = np.argsort(size, kind="stable")
        share = np.cumsum(weight[order]) / weight.sum()
        place = min(int(np.searchsorted(share, _PART)), len(share) - 1)
        return cls(float(size[order[place]]), float(weight.sum()) / whole, tuple(others))

    def changed(
        self, gauss: FloatArray, area: FloatArray, k0: float, wide: float, most: float
    ) -> float:
        """Give the part of the area of which another fit has another region, or quite another K.

        What is contested by its own curvature, k0 / wide <= abs(K) <= wide k0, is not counted
        again. A change above `most`, the K0 that was asked for, counts, too. Curvatures in 1/m2,
        areas in m2.
        """
        if not self.others:
            return 0.0
        size = np.abs(gauss)
        clear = (size < k0 / wide) | (size > wide * k0)
        own = _region(gauss, k0)
        differs = [
            np.isfinite(each) & ((_region(each, k0) != own) | (np.abs(each - gauss) > most))
            for each in self.others
        ]
        found = clear & np.any(differs, axis=0)
        return float(area[found].sum()) / float(area.sum())


def _region(gauss: FloatArray, k0: float) -> FloatArray:
    """Give 1 where K > K0, -1 where K < -K0, else 0."""
    return np.where(np.abs(gauss) > k0, np.sign(gauss), 0.0)


# --------------------------------------------------------------------------------------
# The nodes of a plate.


@attrs.frozen(eq=False)
class PlateNodes:
    """Nodes of the patches that have a part in a plate.

    Attributes
    ----------
    rows : (p,) int
        The patches.
    inside : (p, q, q) bool
        Which nodes lie in the plate.
    nodes : CurvatureNodes
        Those of these patches; outside the plate they have no area.
    edge : (e, 3), m
        Places where lines of nodes leave the plate.
    """

    rows: IntArray
    inside: NDArray[np.bool_]
    nodes: CurvatureNodes
    edge: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.rows, self.inside, self.edge)

    @property
    def axes(self) -> FloatArray:
        """e1 (along), e2 (across) and e3 (into the hull) as rows, (3, 3), right-handed.

        e3 goes against the mean normal, e1 and e2 are those of the second moments of area in the
        plane across it: also of a narrow strip that is bent along, whose moment is the larger
        along the normal. Of e1 the component with the largest amount is positive.
        """
        weight = self.nodes.area.ravel() / self.nodes.area.sum()
        place = self.nodes.place.reshape(-1, 3)
        inward = -self.nodes.normal.sum(axis=(0, 1, 2))
        e3 = inward / np.sqrt(inward @ inward)
        off = place - weight @ place
        off = off - (off @ e3)[:, None] * e3
        _, vectors = np.linalg.eigh((off * weight[:, None]).T @ off)
        e1 = vectors[:, 2] - (vectors[:, 2] @ e3) * e3
        e1 /= np.sqrt(e1 @ e1) * np.sign(e1[np.abs(e1).argmax()])
        return np.stack([e1, np.cross(e3, e1), e3])

    def extents(self, axes: FloatArray) -> FloatArray:
        """Give how far the plate reaches along the first two axes, (2,), m."""
        places = np.concatenate([self.nodes.place[self.inside], self.edge])
        return np.asarray(np.ptp(places @ axes[:2].T, axis=0))


def nodes_in(shell: HullShell, wanted: PlateRange, count: int = NODES) -> PlateNodes:
    """Find the nodes of a plate, `count` each way on a patch."""
    rows, _ = patches_in(shell, wanted)
    if count == NODES:
        nodes = CurvatureNodes(*(np.array(each[rows]) for each in attrs.astuple(shell.nodes)))
    else:
        nodes = curvature_nodes(shell.patches[rows], count)
    bounds = _bounds(shell, wanted, rows, count)
    inside = np.all([bound <= 0.0 for bound in bounds], axis=0) & np.ones(nodes.area.shape, bool)
    kept = attrs.evolve(
        nodes,
        area=np.where(inside, nodes.area, 0.0),
        normal=np.where(inside[..., None], nodes.normal, 0.0),
    )
    edges = [_crossings(nodes.place, bound, bounds, axis) for bound in bounds for axis in (1, 2)]
    return PlateNodes(rows, inside, kept, np.concatenate([np.zeros((0, 3)), *edges]))


def _bounds(shell: HullShell, wanted: PlateRange, rows: IntArray, count: int) -> list[FloatArray]:
    """Give by how much nodes lie beyond each seam of a range, (p, q, q), m; zero or less inside."""
    found = []
    for axis in AXES:
        low, high = getattr(wanted, axis)
        if np.isinf(low) and np.isinf(high):
            continue
        value = shell.at(axis, rows, count)
        found += [low - value] if np.isfinite(low) else []
        found += [value - high] if np.isfinite(high) else []
    return found


def _crossings(
    place: FloatArray, beyond: FloatArray, bounds: list[FloatArray], axis: int
) -> FloatArray:
    """Give where steps between nodes along an axis cross a seam within the others, (e, 3), m."""
    count = place.shape[axis]

    def steps(values: FloatArray) -> tuple[FloatArray, FloatArray]:
        return np.take(values, range(count - 1), axis), np.take(values, range(1, count), axis)

    (p, q), (a, b) = steps(place), steps(beyond)
    out = (a > 0.0) != (b > 0.0)
    t = a[out] / (a[out] - b[out])
    kept = np.ones(len(t), bool)
    for other in bounds:
        if other is not beyond:
            c, d = steps(other)
            kept &= c[out] + t * (d[out] - c[out]) <= 0.0
    found = p[out] + t[:, None] * (q[out] - p[out])
    return np.asarray(found[kept])


# --------------------------------------------------------------------------------------
# How it is judged: areas, doubt, class, axis, strains.

_WIDE = 2.0
"""What is farther from K0 than by this factor is not contested."""

_SEEN = 0.01
"""A part of a plate below this is not reported."""


def doubled_band(k0: float, dk: float | None) -> float:
    """Double a band until it is not narrower than what curvature is known to, 1/m2."""
    if dk is None or not dk > k0:
        return k0
    return float(k0 * 2.0 ** np.ceil(np.log2(dk / k0)))


def judge_plate(
    wanted: PlateRange,
    blocks: Sequence[str],
    measured: PlateNodes,
    tallied: Tally,
    doubt: CurvatureDoubt,
    band: tuple[float, float],
    asked: float,
    options: PlateOptions,
) -> Plate:
    """Put a plate together of its nodes, its areas above the levels of `levels_about`, and doubts.

    `band` is K0, 1/m2, and the breadth that it is meant for, m; `asked` K0 before it was widened.
    """
    nodes, (k0, band_breadth) = measured.nodes, band
    axes = measured.axes
    breadth, length = np.sort(measured.extents(axes)).tolist()
    areas = _areas(tallied)
    shares = _shares(areas, nodes, k0, options.flat_bend(band_breadth))
    contested = _contested(tallied)
    changed = doubt.changed(nodes.gauss, nodes.area, k0, _WIDE, asked)
    return assemble_plate(
        nodes, shares, _kind(shares, options.share), options,
        name=wanted.name, areas=areas, length=length, breadth=breadth, axes=axes, k0=k0,
        band_breadth=band_breadth, heating=areas.positive + areas.negative > TOL * areas.total,
        notes=_notes(wanted.name, tallied, contested, changed, doubt, k0 / asked),
        extent=HullExtent(wanted, tuple(blocks), nodes, doubt.dk, contested, changed),
    )  # fmt: skip


def _kind(shares: PlateShares, share: float) -> str | None:
    """Give the class; None where what is unresolved could make it another one."""
    kind = shares.kind(share)
    return None if kind == "mixed" and shares.unresolved > 1.0 - share else kind


def _areas(tallied: Tally) -> RegionAreas:
    """Give the areas of regions; what lies beside borders of blocks is unresolved."""
    settled = tallied.area - tallied.margin
    convex, not_saddle = tallied.above[:2].tolist()
    saddle = max(settled - not_saddle, 0.0)
    zero = max(settled - convex - saddle, 0.0)
    return RegionAreas(
        convex, saddle, zero, tallied.margin, convex, saddle, tallied.off, tallied.area
    )


def _shares(areas: RegionAreas, nodes: CurvatureNodes, k0: float, flat_bend: float) -> PlateShares:
    """Give the shares of regions; nodes, not samples between them, part cylinder from flat."""
    small = nodes.area * (np.abs(nodes.gauss) <= k0)
    whole, area, zero = float(small.sum()), areas.total, areas.zero
    flat = float((small * (nodes.bent <= flat_bend)).sum()) / whole if whole > 0.0 else 0.0
    return PlateShares(
        areas.positive_share, areas.negative_share, zero * (1.0 - flat) / area, zero * flat / area,
        areas.unresolved_share,
    )  # fmt: skip


def _contested(tallied: Tally) -> float:
    """Give the part with K0/2 <= |K| <= 2 K0."""
    half, minus_half, double, minus_double = tallied.above[2:].tolist()
    return float(max(half - double + minus_double - minus_half, 0.0) / tallied.area)


def _notes(
    name: str, tallied: Tally, contested: float, changed: float, doubt: CurvatureDoubt, wider: float
) -> tuple[str, ...]:
    """Say what is to be known of a plate."""
    found = []
    if contested + changed > COARSE:
        more = f", other fits change {100.0 * changed:.0f} % more" if changed > _SEEN else ""
        found.append(
            f"{name}: its class is that of the fitted surface, in doubt: {100.0 * contested:.0f} % "
            f"of it lies within a factor of 2 of K0{more}; take more lines there, or a larger "
            "strain tolerance."
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
