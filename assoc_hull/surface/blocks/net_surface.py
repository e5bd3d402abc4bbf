"""The surface through the lines of a hull, as what is found of it: patches, residuals, borders."""

from __future__ import annotations

from functools import cached_property

import attrs

from assoc_hull.analysis.net.gather import Net
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.fitting.samples import Samples
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.model.state import Particulars
from assoc_hull.surface.blocks.fit_block import Made
from assoc_hull.surface.blocks.fit_options import FitOptions
from assoc_hull.surface.blocks.net_records import Border, Residuals

__all__ = ["Border", "FittedBlock", "NetSurface", "Residuals"]


@attrs.frozen(eq=False)
class FittedBlock:
    """One block of a hull and its surface.

    Attributes
    ----------
    made : Made
        Its surface, what it was made from and what it was before it was joined.
    residuals : tuple of Residuals
        On the lines that it was fitted to, and on those left out.
    least_element : float
        The least |S_u x S_v|, as a part of the median.
    singular : tuple of (float, float)
        Parameters of corners at which the sides are tangent.
    limit : float, m
        What 95 % of its residuals should keep.
    notes : tuple of str
        What is to be known of it.
    """

    made: Made
    residuals: tuple[Residuals, ...]
    least_element: float
    singular: tuple[tuple[float, float], ...]
    limit: float
    notes: tuple[str, ...]

    @property
    def name(self) -> str:
        """``"body"``, ``"bow bulb"`` ..."""
        return self.made.block.name

    @property
    def kind(self) -> str:
        """Where it lies, by which its tolerances go: ``"body"``, ``"bow"`` or ``"stern"``."""
        return self.made.block.kind

    @property
    def surface(self) -> SplineSurface:
        """Its surface, as published: cut at its borders, and joined."""
        return self.made.part.surface

    @property
    def samples(self) -> Samples:
        """The points of its lines, with parameters of the places nearest to them."""
        return self.made.part.samples

    @property
    def distance(self) -> FloatArray:
        """How far these points lie from the surface, (k,), m."""
        return self.made.part.residual

    @property
    def spans(self) -> tuple[int, int]:
        """Spans of knots in u and in v."""
        return self.made.part.spans

    @property
    def smoothing(self) -> float:
        """The factor of the penalty, m3."""
        return self.made.part.smoothing

    @property
    def fitted(self) -> Residuals:
        """The residuals on the lines that it was fitted to."""
        return self.residuals[0]

    @property
    def left_out(self) -> Residuals | None:
        """The residuals on lines that were left out, if there are any on it."""
        return self.residuals[1] if len(self.residuals) > 1 else None


@attrs.frozen(eq=False)
class NetSurface:
    """The surface of a half hull (y >= 0), one spline surface a block.

    Attributes
    ----------
    particulars : Particulars
        Of the hull.
    options : FitOptions
        Penalty, tolerances and cut-off that it was made with.
    net : Net
        The lines of the hull, as they were.
    blocks : tuple of FittedBlock
        From aft forward, each once.
    borders : tuple of Border
        Where they meet.
    left_out : tuple of str
        The lines that nothing was fitted to.
    refitted : tuple of str
        The blocks that this call has fitted; the others were taken over from an earlier result.
    notes : tuple of str
        Warnings and what is to be known of the whole.
    whole : tuple of Residuals
        Of all blocks together, on the lines fitted to and on those left out.
    """

    particulars: Particulars
    options: FitOptions
    net: Net = attrs.field(repr=False)
    blocks: tuple[FittedBlock, ...]
    borders: tuple[Border, ...]
    left_out: tuple[str, ...]
    refitted: tuple[str, ...]
    notes: tuple[str, ...]
    whole: tuple[Residuals, ...]

    @cached_property
    def patches(self) -> tuple[SplineSurface, ...]:
        """The surfaces of the blocks, with normals out of the hull."""
        return tuple(block.surface for block in self.blocks)
