"""The surface through the lines of a hull: its blocks, residuals, borders, and the report of them.

`FittedSurface` is the half y >= 0, one spline surface a block, with normals out of the hull.
The report is a table to read (`text_of`) and plain values for programs (`document_of`).
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from typing import Any

import attrs

from assoc_hull.analysis.net.curve_net import CurveNet
from assoc_hull.errors import NotSoundError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.fitting.fit_input import Samples
from assoc_hull.geometry.fitting.folds import surface_elements
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.model.tables import Particulars
from assoc_hull.surface.blocks.fit_block import MadeBlock
from assoc_hull.surface.blocks.fit_options import CREASE, FitOptions
from assoc_hull.surface.blocks.fit_quality import (
    BlockBorder,
    Residuals,
    doubts_of_half,
    doubts_of_limits,
)
from assoc_hull.surface.cells.closed_mesh import BelowDraught
from assoc_hull.surface.volume_check import (
    NOT_HELD,
    Displaced,
    surface_below,
    surface_volume_faults,
)

__all__ = [
    "FORMAT",
    "SCHEMA",
    "FittedBlock",
    "FittedSurface",
    "ResidualTable",
    "document_of",
    "require_sound_surface",
    "surface_faults",
    "text_of",
]


@attrs.frozen(eq=False)
class FittedBlock:
    """One block of a hull and its surface.

    Attributes
    ----------
    made : MadeBlock
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

    made: MadeBlock
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
class FittedSurface:
    """The surface of a half hull (y >= 0), one spline surface a block.

    Attributes
    ----------
    particulars : Particulars
        Of the hull.
    options : FitOptions
        Penalty, tolerances and cut-off that it was made with.
    net : CurveNet
        The lines of the hull, as they were.
    blocks : tuple of FittedBlock
        From aft forward, each once.
    borders : tuple of BlockBorder
        Where they meet.
    left_out : tuple of str
        The lines that nothing was fitted to.
    refitted : tuple of str
        The blocks that this call has fitted; the others were taken over from an earlier result.
    notes : tuple of str
        Warnings and what is to be known of the whole.
    whole : tuple of Residuals
        Of all blocks together, on the lines fitted to and on those left out.
    displaced : tuple of Displaced
        What hydrostatics find of the lines, less nothing for tunnels; none if they find nothing.
    """

    particulars: Particulars
    options: FitOptions
    net: CurveNet = attrs.field(repr=False)
    blocks: tuple[FittedBlock, ...]
    borders: tuple[BlockBorder, ...]
    left_out: tuple[str, ...]
    refitted: tuple[str, ...]
    notes: tuple[str, ...]
    whole: tuple[Residuals, ...]
    displaced: tuple[Displaced, ...] = ()

    @cached_property
    def patches(self) -> tuple[SplineSurface, ...]:
        """The surfaces of the blocks, with normals out of the hull."""
        return tuple(block.surface for block in self.blocks)

    @cached_property
    def held(self) -> tuple[BelowDraught, ...]:
        """What it encloses below the levels of `displaced`, both sides."""
        return tuple(surface_below(self.patches, each.level) for each in self.displaced)


# --------------------------------------------------------------------------------------
# Faults, for which a surface is not written to a file.


def surface_faults(surface: FittedSurface) -> tuple[str, ...]:
    """List where a surface crosses the centre plane or leaves its limits, and how far.

    Limits are those of residuals, and of the volume: it should be that of hydrostatics.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.surface.blocks.fitted_surface import surface_faults
    >>> surface_faults(ah.examples.wigley(stations=9, waterlines=6).surface())
    ()
    """
    options = surface.options
    found = tuple(
        f"{block.name}: {doubt}"
        for block in surface.blocks
        for doubt in (
            *doubts_of_limits(block.kind, block.fitted, options),
            # Halves that cross by less than the surface may be off its lines are told of only.
            *doubts_of_half(
                block.surface, surface_elements(block.surface), options, options.limit(block.kind)
            ),
        )
    )
    return (*found, *surface_volume_faults(surface.patches, surface.held, surface.displaced))


def require_sound_surface(surface: FittedSurface, *, accept: bool) -> None:
    """Refuse a surface with faults, unless it is accepted as it is.

    Raises
    ------
    NotSoundError
        All faults, each with its block, place and size.
    """
    faults = () if accept else surface_faults(surface)
    if faults:
        raise NotSoundError(f"the surface of {surface.particulars.name or 'the hull'}", faults)


# --------------------------------------------------------------------------------------
# The report.

FORMAT, SCHEMA = "assoc-hull surface", 1
_MM = 1000.0
_HEAD = (
    f"{'lines':10}{'points':>8}{'median':>9}{'p95':>9}{'p99':>9}{'max mm':>9}"
    f"{'limit':>8}  {'where the largest is (x, y, z m)':34}"
)
_WIDTH = 16
"""Of the names of blocks, if none is longer."""


@attrs.frozen(eq=False)
class ResidualTable:
    """Residuals of all blocks, fitted and left out.

    Attributes
    ----------
    blocks : tuple of FittedBlock
        The blocks.
    whole : tuple of Residuals
        All of them together.
    """

    blocks: tuple[FittedBlock, ...]
    whole: tuple[Residuals, ...]

    def __iter__(self) -> Iterator[tuple[FittedBlock, Residuals]]:
        """Give each block with its residuals: on lines it was fitted to, on lines left out."""
        return ((block, each) for block in self.blocks for each in block.residuals)

    def __len__(self) -> int:
        return sum(len(block.residuals) for block in self.blocks)

    def __str__(self) -> str:
        """Write the table, mm."""
        width = max(_WIDTH, *(len(block.name) + 2 for block in self.blocks))
        rows = [block.name.ljust(width) + _row(found, block.limit) for block, found in self]
        rows += ["all".ljust(width) + _row(found) for found in self.whole]
        return "\n".join(["block".ljust(width) + _HEAD.rstrip(), *rows])


def _row(found: Residuals, limit: float | None = None) -> str:
    if not found.count:
        return f"{found.kind:10}{0:8d}"
    columns = (found.median, found.p95, found.p99, found.largest)
    numbers = "".join(f"{_MM * each:9.2f}" for each in columns)
    bound = f"{_MM * limit:8.1f}" if limit and found.kind == "fitted" else f"{'':8}"
    return f"{found.kind:10}{found.count:8d}{numbers}{bound}  {_place(found.place)} on {found.line}"


def _place(place: FloatArray) -> str:
    return "({:.2f}, {:.2f}, {:.2f})".format(*place.tolist())


def text_of(surface: FittedSurface) -> str:
    """Write the report of a surface as a table and sentences."""
    ship = surface.particulars
    count = sum(len(each.surface.patches()) for each in surface.blocks)
    head = f"Surface of {ship.name}, Lpp {ship.length:.2f} m, half: {len(surface.blocks)} "
    head += f"block(s), {count} Bezier patches"
    table = ResidualTable(surface.blocks, surface.whole)
    parts = [head, "", str(table), "", *map(_fit, surface.blocks)]
    parts += [
        "",
        *(map(_volume, surface.held, surface.displaced) if surface.displaced else [NOT_HELD]),
    ]
    if surface.borders:
        parts += ["", *map(_border, surface.borders)]
    if surface.left_out:
        parts += ["", f"left out of the fit: {', '.join(surface.left_out)}"]
    notes = [f"{block.name}: {note}" for block in surface.blocks for note in block.notes]
    notes += surface.notes
    return "\n".join([*parts, *(["", *notes] if notes else [])])


def _fit(block: FittedBlock) -> str:
    u, v = block.spans
    return (
        f"{block.name}: {u} x {v} spans, lam {block.smoothing:.3g} m3, "
        f"least |S| {block.least_element:.3f} of the median, "
        f"error between the lines about {1.5 * _MM * block.fitted.p95:.1f} mm (1.5 p95)"
    )


def _volume(found: BelowDraught, by_lines: Displaced) -> str:
    return (
        f"below {by_lines.level:.2f} m: {found.volume:.2f} m3, by hydrostatics of the lines "
        f"{by_lines.volume:.2f} m3 ({100.0 * (found.volume / by_lines.volume - 1.0):+.2f} %)"
    )


def _border(border: BlockBorder) -> str:
    gap = " / ".join(f"{_MM * each:.2f}" for each in border.gap.tolist())
    angle = " / ".join(f"{each:.3f}" for each in border.angle.tolist())
    return (
        f"{border.names[0]} | {border.names[1]}: gap {gap} mm as fitted, "
        f"{_MM * border.joined_gap:.3g} joined; angle {angle} deg (median / p95 / max, "
        f"largest at {_place(border.place)})" + (", a crease" if border.limit == CREASE else "")
    )


def document_of(surface: FittedSurface) -> dict[str, Any]:
    """Give the report as plain values: lengths in m, angles in degrees."""
    return {
        "format": FORMAT,
        "schema": SCHEMA,
        "ship": attrs.asdict(surface.particulars),
        "blocks": [_block(block) for block in surface.blocks],
        "whole": [_plain(each) for each in surface.whole],
        "borders": [_plain(border) for border in surface.borders],
        "left_out": list(surface.left_out),
        "refitted": list(surface.refitted),
        "notes": list(surface.notes),
    }


def _block(block: FittedBlock) -> dict[str, Any]:
    net = block.surface.net
    return {
        "name": block.name,
        "kind": block.kind,
        "control_points": list(net.shape[:2]),
        "spans": list(block.spans),
        "smoothing": block.smoothing,
        "limit": block.limit,
        "least_element": block.least_element,
        "singular": [list(each) for each in block.singular],
        "residuals": [_plain(each) for each in block.residuals],
        "notes": list(block.notes),
    }


def _plain(record: Residuals | BlockBorder) -> dict[str, Any]:
    """Give a record with lists for arrays; None for what is no number, as where nothing lies."""
    found = attrs.asdict(record, recurse=False)
    return {key: _value(value) for key, value in found.items()}


def _value(value: object) -> object:
    if hasattr(value, "tolist"):
        values: list[float] = value.tolist()
        return None if any(each != each for each in values) else values
    return list(value) if isinstance(value, tuple) else value
