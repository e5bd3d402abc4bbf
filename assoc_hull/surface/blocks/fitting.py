"""From the lines of a hull to its surface: blocks are fitted, joined and measured."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from assoc_hull.analysis.net.gather import gather
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.state import HullState
from assoc_hull.surface.blocks.whole_sections import body_of_sections
from assoc_hull.surface.net_surface import FittedBlock, NetSurface, Residuals

__all__ = ["surface_of_net"]


def surface_of_net(state: HullState, leave_out: Sequence[str] = ()) -> NetSurface:
    """Fit a surface to the lines of a hull."""
    net = gather(state)
    length = state.particulars.length
    left = np.array([name in leave_out for name in net.name])
    surface, samples, distance = body_of_sections(net, length, left)
    found = _residuals("fitted", distance, samples.point, samples.line, net.name)
    block = FittedBlock(
        "body", "body", surface, surface, samples, (found,), 1.0, (),
        (len(surface.knots_u) - 7, len(surface.knots_v) - 7), 8e-11 * length**3, (),
    )  # fmt: skip
    return NetSurface(state.particulars, net, (block,), (), ("body",), ())


def _residuals(kind: str, distance: FloatArray, point, line, names) -> Residuals:
    worst = int(distance.argmax())
    median, p95, p99 = np.percentile(distance, [50.0, 95.0, 99.0]).tolist()
    return Residuals(
        kind, len(distance), median, p95, p99, float(distance[worst]),
        point[worst].copy(), names[line[worst]],
    )  # fmt: skip
