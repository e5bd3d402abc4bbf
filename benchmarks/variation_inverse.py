"""The inverse of maps: how many steps it takes, and how far it misses."""

from __future__ import annotations

from collections.abc import Iterator

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.tables import HullState
from assoc_hull.variation.fields.bounded_functions import Blend, BlendChain
from assoc_hull.variation.fields.field import AffinePiece, StackedField, level_boundaries
from assoc_hull.variation.fields.layers import FieldLayer
from assoc_hull.variation.fields.space_map import solve_coordinates
from benchmarks.variation_bossing import HATS, bossing
from benchmarks.variation_methods import cloud
from benchmarks.variation_tasks import METHODS, Task

__all__ = ["inverses", "inverted"]


@attrs.frozen(eq=False)
class _Counting:
    """A layer that counts how often its Jacobian is asked for."""

    layer: FieldLayer
    calls: list[int]

    @property
    def name(self) -> str:
        """That of the layer."""
        return self.layer.name

    def displacement(self, xyz: FloatArray) -> FloatArray:
        """Give what the layer gives."""
        return self.layer.displacement(xyz)

    def jacobian(self, xyz: FloatArray) -> FloatArray:
        """Give what the layer gives, and count."""
        self.calls[0] += 1
        return self.layer.jacobian(xyz)

    def regions(self) -> tuple[object, ...]:
        """Give those of the layer."""
        return self.layer.regions()


def inverted(layer: FieldLayer, xyz: FloatArray) -> tuple[int, float]:
    """Give how many steps the inverse takes for x and z, and how far it misses places, m."""
    counting = _Counting(layer, [0])
    image = xyz + layer.displacement(xyz)
    found = image.copy()
    solve_coordinates(counting, image, found, (0, 2))  # type: ignore[arg-type]
    steps = counting.calls[0]
    solve_coordinates(layer, image, found, (1,))
    return steps, float(np.sqrt(((found - xyz) ** 2).sum(axis=1)).max())


def inverses(state: HullState, task: Task) -> Iterator[str]:
    """Give what the inverse does at places of the lines, and anywhere in the box of the hull."""
    places = cloud(state)
    low, high = places.min(axis=0), places.max(axis=0)
    scattered = np.random.default_rng(7).uniform(low, high, (20_000, 3))
    for name in HATS:
        lay, blend = METHODS[name]
        hat = lay(task, blend)
        if not isinstance(hat, FieldLayer):
            continue
        fields = (*hat.fields, *bossing(task, 1.1, blend, tube=True).fields, _longer(task, blend))
        both = FieldLayer("both", fields)
        for kind, points, layer in (("of the lines", places, hat), ("scattered", scattered, both)):
            steps, miss = inverted(layer, points)
            yield f"{name}: {len(points)} places {kind}, {steps} steps, missed by {miss:.1e} m"


def _longer(task: Task, blend: Blend) -> StackedField:
    """Move the ends of the region by 0.4 m below a sloping boundary."""
    fade, still = BlendChain.through(task.nodes, task.ends, blend), BlendChain.constant(0.0)
    walls = level_boundaries(["z", "high"], [task.z, task.high])
    pieces = (AffinePiece(still, 0.0, fade.scaled(0.4)), AffinePiece(still, 0.0, still))
    return StackedField("longer", "x", walls, pieces, blend)
