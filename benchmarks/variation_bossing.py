"""A larger bossing, with the tube that keeps the hull beside it as it is, and without."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from assoc_hull.model.tables import HullState
from assoc_hull.variation.fields.bounded_functions import Blend, BlendChain
from assoc_hull.variation.fields.field import AffinePiece, StackedField, Tube, level_boundaries
from assoc_hull.variation.fields.layers import FieldLayer
from benchmarks.variation_methods import cloud, fared
from benchmarks.variation_tasks import METHODS, Task

__all__ = ["GROWTH", "HATS", "bossing", "tubes"]

HATS = ("rounded hat, cubic", "rounded hat, quintic")
"""The methods whose blends are compared."""

GROWTH = 1.0 / 0.725
"""By what a bossing is made larger: that of the carrier from 0.725 to 1.0 m."""


def bossing(task: Task, growth: float, blend: Blend, *, tube: bool) -> FieldLayer:
    """Lay out a larger bossing about the place of a task, with or without its tube."""
    h, r = task.z, task.radius
    fade = BlendChain.through([task.x, task.x + 20.0 * r], [growth - 1.0, 0.0], blend)
    walls = level_boundaries(["-4r", "-r", "+r", "+5r"], [h - 4.0 * r, h - r, h + r, h + 5.0 * r])
    still = BlendChain.constant(0.0)
    none, out, up = (
        AffinePiece(still, 0.0, still),
        AffinePiece(fade, 0.0, still),
        AffinePiece(fade, h, still),
    )
    around = Tube(r, 6.0, blend) if tube else None
    return FieldLayer("bossing", (
        StackedField("radius", "y", walls, (none, out, out, none), blend, around),
        StackedField("radius", "z", walls, (none, up, up, none), blend),
    ))  # fmt: skip


def tubes(state: HullState, task: Task) -> Iterator[str]:
    """Give what a larger bossing does to the sections, with its tube and without."""
    yield f"{'':24} {'comb':>6} {'worst':>7} {'signs':>11} {'most m':>6}"
    for name, (_, blend) in METHODS.items():
        if name not in HATS:
            continue
        for tube in (True, False):
            layer = bossing(task, GROWTH, blend, tube=tube)
            it = fared(state, task, layer)
            moved = layer.displacement(cloud(state))
            most = float(np.sqrt((moved * moved).sum(axis=1)).max())
            label = f"{name.split()[-1]}, {'tube' if tube else 'no tube'}"
            yield (
                f"{label:24} {it.median:6.3f} {it.worst:7.2f} {it.before:4d} -> {it.after:3d}"
                f" {most:6.3f}"
            )
