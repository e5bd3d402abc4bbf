"""What is told of the surface of a hull: a table to read, and plain values for programs."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import attrs

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.surface.blocks.net_records import Border, Residuals
from assoc_hull.surface.blocks.net_surface import FittedBlock, NetSurface

__all__ = ["FORMAT", "SCHEMA", "ResidualTable", "document_of", "text_of"]

FORMAT, SCHEMA = "assoc-hull surface", 1
_MM = 1000.0
_HEAD = (
    f"{'block':16}{'lines':10}{'points':>8}{'median':>9}{'p95':>9}{'p99':>9}{'max mm':>9}"
    f"{'limit':>8}  {'where the largest is (x, y, z m)':34}"
)


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
        rows = [_row(block.name, found, block.limit) for block, found in self]
        rows += [_row("all", found) for found in self.whole]
        return "\n".join([_HEAD.rstrip(), *rows])


def _row(name: str, found: Residuals, limit: float | None = None) -> str:
    if not found.count:
        return f"{name:16}{found.kind:10}{0:8d}"
    columns = (found.median, found.p95, found.p99, found.largest)
    numbers = "".join(f"{_MM * each:9.2f}" for each in columns)
    bound = f"{_MM * limit:8.1f}" if limit and found.kind == "fitted" else f"{'':8}"
    return (
        f"{name:16}{found.kind:10}{found.count:8d}{numbers}{bound}  "
        f"{_place(found.place)} on {found.line}"
    )


def _place(place: FloatArray) -> str:
    return "({:.2f}, {:.2f}, {:.2f})".format(*place.tolist())


def text_of(surface: NetSurface) -> str:
    """Write the report of a surface.

    Parameters
    ----------
    surface : NetSurface
        The surface.
    """
    ship = surface.particulars
    count = sum(len(each.surface.patches()) for each in surface.blocks)
    head = f"Surface of {ship.name}, Lpp {ship.length:.2f} m, half: {len(surface.blocks)} "
    head += f"block(s), {count} Bezier patches"
    table = ResidualTable(surface.blocks, surface.whole)
    parts = [head, "", str(table), "", *map(_fit, surface.blocks)]
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


def _border(border: Border) -> str:
    gap = " / ".join(f"{_MM * each:.2f}" for each in border.gap.tolist())
    angle = " / ".join(f"{each:.3f}" for each in border.angle.tolist())
    return (
        f"{border.names[0]} | {border.names[1]}: gap {gap} mm as fitted, "
        f"{_MM * border.joined_gap:.3g} joined; angle {angle} deg (median / p95 / max, "
        f"largest at {_place(border.place)})"
    )


def document_of(surface: NetSurface) -> dict[str, Any]:
    """Give the report as plain values: lengths in m, angles in degrees.

    Parameters
    ----------
    surface : NetSurface
        The surface.
    """
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


def _plain(record: Residuals | Border) -> dict[str, Any]:
    """Give a record with lists for arrays; None for what is no number, as where nothing lies."""
    found = attrs.asdict(record, recurse=False)
    return {key: _value(value) for key, value in found.items()}


def _value(value: object) -> object:
    if hasattr(value, "tolist"):
        values: list[float] = value.tolist()
        return None if any(each != each for each in values) else values
    return list(value) if isinstance(value, tuple) else value
