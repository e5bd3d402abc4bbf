"""The surface through the lines of a hull, as what is found of it: patches, residuals, borders."""

from __future__ import annotations

from functools import cached_property

import attrs

from assoc_hull.analysis.net.gather import Net
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.fitting.samples import Samples
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.model.state import Particulars
from assoc_hull.surface.blocks.block import Block

__all__ = ["Border", "FittedBlock", "NetSurface", "Residuals"]


@attrs.frozen(eq=False)
class Residuals:
    """How far points of lines lie from the surface.

    Attributes
    ----------
    kind : str
        ``"fitted"``, or ``"left out"`` of the fit.
    count : int
        Points.
    median, p95, p99, largest : float, m
        Of the distances.
    place : (3,), m
        Where the largest is; nan without points.
    line : str
        The line it is on.
    """

    kind: str
    count: int
    median: float
    p95: float
    p99: float
    largest: float
    place: FloatArray
    line: str

    def __attrs_post_init__(self) -> None:
        freeze(self.place)


@attrs.frozen(eq=False)
class FittedBlock:
    """One block of a hull and its surface.

    Attributes
    ----------
    name : str
        ``"body"``, ``"bow bulb"`` ...
    kind : {"body", "bow", "stern"}
        Where it lies, by which its tolerances go.
    surface : SplineSurface
        Its surface, as published: cut at its borders, and joined.
    fit : SplineSurface
        As it was fitted, with the overlap and before it was joined.
    laid : Block
        As it was laid out on its rectangle, before any fit.
    samples : Samples
        What it was fitted to, with their parameters at the end.
    residuals : tuple of Residuals
        On the lines that it was fitted to, and on those left out.
    least_element : float
        The least |S_u x S_v|, as a part of the median.
    singular : tuple of (float, float)
        Parameters of corners at which the sides are tangent.
    spans : (int, int)
        Spans of knots in u and in v.
    smoothing : float, m3
        The factor of the penalty.
    limit : float, m
        What 95 % of its residuals should keep.
    notes : tuple of str
        What is to be known of it.
    """

    name: str
    kind: str
    surface: SplineSurface
    fit: SplineSurface
    laid: Block
    samples: Samples
    residuals: tuple[Residuals, ...]
    least_element: float
    singular: tuple[tuple[float, float], ...]
    spans: tuple[int, int]
    smoothing: float
    limit: float
    notes: tuple[str, ...]

    @property
    def fitted(self) -> Residuals:
        """The residuals on the lines that it was fitted to."""
        return self.residuals[0]

    @property
    def left_out(self) -> Residuals | None:
        """The residuals on lines that were left out, if there are any on it."""
        return self.residuals[1] if len(self.residuals) > 1 else None


@attrs.frozen(eq=False)
class Border:
    """Where two blocks meet.

    Attributes
    ----------
    names : (str, str)
        The blocks.
    gap : (3,), m
        Median, 95 % and largest distance of the two surfaces, before they were joined.
    joined_gap : float, m
        The largest after it.
    angle : (3,), degrees
        Median, 95 % and largest angle between the normals as published.
    place : (3,), m
        Where the largest angle is.
    limit : float, degrees
        What the angle should keep.
    """

    names: tuple[str, str]
    gap: FloatArray
    joined_gap: float
    angle: FloatArray
    place: FloatArray
    limit: float

    def __attrs_post_init__(self) -> None:
        freeze(self.gap, self.angle, self.place)


@attrs.frozen(eq=False)
class NetSurface:
    """The surface of a half hull (y >= 0), one spline surface a block.

    Attributes
    ----------
    particulars : Particulars
        Of the hull.
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
