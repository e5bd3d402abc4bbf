"""What became of slices: everything that was assumed, mended, measured and allowed."""

from __future__ import annotations

import attrs

from assoc_hull.edit.adoption.report import AdoptionReport
from assoc_hull.io.lines.slices import Gaps, Join
from assoc_hull.io.offset_report import OffsetReport
from assoc_hull.io.slicing.curves import Border
from assoc_hull.io.slicing.features import FeatureRules, KnuckleLine
from assoc_hull.io.slicing.sources import SmoothReport
from assoc_hull.tolerance import Tolerances

__all__ = ["SliceReport"]


_COARSE = 3.0
"""Lines adopted within more than this many times the least tolerance of a mesh are doubtful."""


@attrs.frozen(eq=False)
class SliceReport:
    """What became of slices.

    Attributes
    ----------
    slices : OffsetReport
        What was assumed, mended and found suspicious when they were read.
    joins : tuple of Join
        Every join across a gap.
    gaps : Gaps
        Which gaps were joined.
    rules : FeatureRules
        The thresholds of features and smoothing.
    tolerances : Tolerances
        Those of the net; `tolerances.adoption` is how far, measured across the hull, an adopted
        curve may pass its smooth line.
    noise : float, m
        Median over the pieces.
    facet_depth : float, m
        How deep facets of the mesh lie inside the hull; nil for digitised lines.
    smoothing : tuple of SmoothReport
        Per piece, in the order of `adoption.lines`.
    knuckles : tuple of KnuckleLine
        Knuckle lines found.
    borders : tuple of Border
        Boundary curves drawn from knuckles and from the ends of straight runs.
    adoption : AdoptionReport
        Per curve: deviations from the smooth lines, points, inflections.
    """

    slices: OffsetReport
    joins: tuple[Join, ...]
    gaps: Gaps
    rules: FeatureRules
    tolerances: Tolerances
    noise: float
    facet_depth: float
    smoothing: tuple[SmoothReport, ...]
    knuckles: tuple[KnuckleLine, ...]
    borders: tuple[Border, ...]
    adoption: AdoptionReport

    @property
    def tolerance(self) -> float:
        """How far (m), measured across the hull, an adopted curve may pass its smooth line."""
        return self.tolerances.adoption

    @property
    def bands(self) -> tuple[float, ...]:
        """How far (m) the hull may lie off each curve, in the order of `adoption.lines`.

        The band of the smooth line, and what the adopted curve passes that by.
        """
        pairs = zip(self.smoothing, self.adoption.lines, strict=True)
        return tuple(piece.band + line.deviation for piece, line in pairs)

    @property
    def adopted(self) -> int:
        """Points that no crossing holds."""
        return self.adoption.own_points

    @property
    def inflections(self) -> tuple[int, int]:
        """Inflections of the smooth lines in all, and what the net has more, line by line."""
        return self.adoption.inflections

    @property
    def suspicions(self) -> tuple[str, ...]:
        """What is doubtful about smoothing and adoption, none for a hull drawn well."""
        most = _COARSE * self.rules.adopt_least_facets
        if self.tolerance <= most:
            return ()
        near, noise = 1e3 * self.tolerance, 1e3 * self.noise
        return (
            f"tolerance: adopted within {near:.3g} mm only, since the lines scatter by {noise:.3g} "
            "mm; corners that facets or points are too few to show count as scatter, and are "
            "rounded: give a finer mesh, more points, or tolerance=",
        )
