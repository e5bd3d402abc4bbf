"""One plate of a hull: its nodes and extent, what other fits make of it, its class and axis.

`judge_plate` puts a `HullPlate` together from areas, nodes and the doubt of other fits.
Where other fits change the curvature by more than the band, the band is doubled until they do not.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Self

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.display import ShownAsText
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.surface.plating.curvature_nodes import CurvatureNodes, curvature_nodes
from assoc_hull.surface.plating.hull_seams import AXES, PlateRange
from assoc_hull.surface.plating.hull_shell import NODES, HullShell
from assoc_hull.surface.plating.options import PlateOptions
from assoc_hull.surface.plating.plate import radius_of
from assoc_hull.surface.plating.plate_areas import Tally, patches_in
from assoc_hull.surface.plating.plate_class import (
    COHERENT,
    PlateShares,
    Rulings,
    roll_axis,
    rulings,
    suggestion_key,
)

__all__ = [
    "COARSE",
    "CurvatureDoubt",
    "HullPlate",
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
# The plate.

COARSE = 0.2
"""The class of a plate of which so much is in doubt is that of the fitted surface alone."""


@attrs.frozen(eq=False, repr=False)
class HullPlate(ShownAsText):
    """What lies between two butts and two seams of a hull.

    Attributes
    ----------
    name : str
        Its number along the ship, and, after a point, up the girth.
    range : PlateRange
        Between which places it lies.
    blocks : tuple of str
        The blocks of the surface that it has a part of.
    area : float, m2
        Its area.
    area_error : float, m2
        What its area and those of its regions may be off by, as areas of this surface.
    length, breadth : float, m
        The larger and the smaller extent along e1 and e2.
    axes : (3, 3)
        The axes e1 (along), e2, e3 of the plate, as rows; seen from outside, e2 lies to the right
        of e1.
    dk : float or None, 1/m2
        By how much Gaussian curvature changes between fits of the same net, on 95 % of the plate;
        None if no other fit was given.
    k0 : float, 1/m2
        Half the width of the band that counts as no curvature: that which was asked for, doubled
        until it is not below `dk`.
    shares : PlateShares
        Convex, saddle, cylinder, flat and unresolved parts of the area, together 1.
    contested : float
        The part of the area with K0/2 <= |K| <= 2 K0: which region it belongs to is in doubt.
    changed : float
        The part outside that, of which another fit tells another region, or a curvature that
        differs by more than the K0 that was asked for.
    kind : {"flat", "cylinder", "saddle", "convex", "mixed"} or None
        The class of the fitted surface, in doubt where `is_doubtful`; None where too much is
        unresolved.
    order : {1, 2, 3} or None
        1 flat, 2 bent one way, 3 bent both ways.
    rollable : bool
        Whether cylinder and flat parts together have the asked share.
    roll_axis : float or None, degrees
        The direction it is rolled about, from e1 towards e2, 0 to 180; None where no single one
        serves.
    roll_direction : (3,) or None
        The same in space.
    coherence : float
        How well the directions of bending agree, 0 to 1.
    least_radius, largest_radius : float or None, m
        One over the larger principal curvature, where it is most and where it is least.
    total_curvature : float
        The integral of |K| dA.
    mean_strain, largest_strain : float
        |K| b**2 / 8 with the plate's own breadth b, mean and largest.
    suggestion : str
        Advice, no instruction.
    notes : tuple of str
        What is to be known of it, each a sentence.
    nodes : CurvatureNodes
        Curvature at nodes; those outside the plate have no area.
    """

    name: str
    range: PlateRange
    blocks: tuple[str, ...]
    area: float
    area_error: float
    length: float
    breadth: float
    axes: FloatArray
    dk: float | None
    k0: float
    shares: PlateShares
    contested: float
    changed: float
    kind: str | None
    order: int | None
    rollable: bool
    roll_axis: float | None
    roll_direction: FloatArray | None
    coherence: float
    least_radius: float | None
    largest_radius: float | None
    total_curvature: float
    mean_strain: float
    largest_strain: float
    suggestion: str
    notes: tuple[str, ...]
    nodes: CurvatureNodes = attrs.field(repr=False)

    def __attrs_post_init__(self) -> None:
        freeze(self.axes)
        if self.roll_direction is not None:
            freeze(self.roll_direction)

    @property
    def doubt(self) -> float:
        """The part of the area of which the region is in doubt: contested and changed parts."""
        return self.contested + self.changed

    @property
    def is_doubtful(self) -> bool:
        """Whether so much is in doubt (a fifth) that the net does not tell the class for certain.

        It is that of the fitted surface then, the best that is known.
        """
        return self.doubt > COARSE

    def rulings(self, count: int = 9) -> Rulings:
        """Give the mean direction of rulings in stretches along the plate; see `Plate.rulings`."""
        return rulings(self.nodes, self.axes, count)

    def __str__(self) -> str:
        """Say in a line what it is."""
        kind = self.kind or "unresolved"
        if self.is_doubtful:
            kind += f" (in doubt on {100.0 * self.doubt:.0f} %)"
        axis = "no roll axis" if self.roll_axis is None else f"roll axis {self.roll_axis:.1f} deg"
        return (
            f"{self.name} ({self.range}): {self.length:.2f} x {self.breadth:.2f} m, "
            f"{self.area:.3f} m2, {kind}, {axis}, {100.0 * self.contested:.1f} % contested"
        )


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
) -> HullPlate:
    """Put a plate together of its nodes, its areas above the levels of `levels_about`, and doubts.

    `band` is K0, 1/m2, and the breadth that it is meant for, m; `asked` K0 before it was widened.
    """
    nodes, (k0, band_breadth) = measured.nodes, band
    axes = measured.axes
    breadth, length = np.sort(measured.extents(axes)).tolist()
    shares = _shares(tallied, nodes, k0, options.flat_bend(band_breadth))
    contested = _contested(tallied)
    changed = doubt.changed(nodes.gauss, nodes.area, k0, _WIDE, asked)
    kind = _kind(shares, options.share)
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
        least_radius=radius_of(float(there.max())),
        largest_radius=radius_of(0.0 if shares.flat > 0.0 else float(there.min())),
        total_curvature=whole, mean_strain=strain * whole / float(nodes.area.sum()),
        largest_strain=strain * float(amount[nodes.area > 0.0].max()),
        suggestion=_advice(kind, contested + changed, rollable, single, options),
        notes=_notes(wanted.name, tallied, contested, changed, doubt, k0 / asked), nodes=nodes,
    )  # fmt: skip


def _kind(shares: PlateShares, share: float) -> str | None:
    """Give the class; None where what is unresolved could make it another one."""
    kind = shares.kind(share)
    return None if kind == "mixed" and shares.unresolved > 1.0 - share else kind


def _shares(tallied: Tally, nodes: CurvatureNodes, k0: float, flat_bend: float) -> PlateShares:
    """Give the shares of regions."""
    area, settled = tallied.area, tallied.area - tallied.margin
    convex, not_saddle = tallied.above[:2].tolist()
    saddle = max(settled - not_saddle, 0.0)
    zero = max(settled - convex - saddle, 0.0)
    small = nodes.area * (np.abs(nodes.gauss) <= k0)
    whole = float(small.sum())
    flat = float((small * (nodes.bent <= flat_bend)).sum()) / whole if whole > 0.0 else 0.0
    return PlateShares(
        convex / area, saddle / area, zero * (1.0 - flat) / area, zero * flat / area,
        tallied.margin / area,
    )  # fmt: skip


def _contested(tallied: Tally) -> float:
    """Give the part with K0/2 <= |K| <= 2 K0."""
    half, minus_half, double, minus_double = tallied.above[2:].tolist()
    return float(max(half - double + minus_double - minus_half, 0.0) / tallied.area)


def _advice(
    kind: str | None, doubt: float, rollable: bool, single: bool, options: PlateOptions
) -> str:
    """Give the suggestion, with the doubt where it is large; none for a plate without a class."""
    if kind is None:
        return "none: too much of it is unresolved"
    advice = options.suggestions[suggestion_key(kind, rollable, single)]
    return f"{advice} (in doubt on {100.0 * doubt:.0f} % of it)" if doubt > COARSE else advice


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
