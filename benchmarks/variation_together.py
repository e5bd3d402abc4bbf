"""Parameters that see each other: two that ask for one place, and six that are met together."""

from __future__ import annotations

from collections.abc import Iterator
from time import perf_counter

import numpy as np

import assoc_hull as ah
from assoc_hull.errors import AssocHullError
from assoc_hull.model.tables import HullState
from assoc_hull.variation.certificate.fold_check import certify
from assoc_hull.variation.fields.bounded_functions import BlendChain
from assoc_hull.variation.fields.field import AffinePiece, StackedField, level_boundaries
from assoc_hull.variation.parameters.catalogue import CATALOGUE
from assoc_hull.variation.parameters.compose_map import compose_map, solve_field_sizes
from assoc_hull.variation.parameters.field_layout import Layout, Share
from assoc_hull.variation.parameters.parent import parent_of
from benchmarks.variation_methods import cloud
from benchmarks.variation_tasks import Task

__all__ = ["overlapping", "together"]

_SIX: dict[str, tuple[float, float]] = {
    "shaft_height": (0.0, 1.0), "transom_height": (0.0, 0.6), "transom_half_breadth": (0.05, 0.0),
    "bulb_height": (0.0, 0.5), "bulb_half_breadth": (0.08, 0.0), "bulb_length": (0.0, 1.0),
}  # fmt: skip
"""Part of the present value, and m, by which six parameters are changed together."""


def overlapping(task: Task) -> Iterator[str]:
    """Give what is said of two parameters whose plateaus overlap."""
    r, z, reach = task.radius, task.z, task.nodes[1] - task.nodes[0]
    shares = list[Share]()
    for name, x, height, top, change in (
        ("shaft", 0.0, z, z + 2.0 * r, 1.0),
        ("counter", 0.1, z + 1.5 * r, z + 3.0 * r, 0.4),
    ):
        near = (task.x + x * reach, task.nodes[1] + x * reach)
        walls = level_boundaries(["low", "h-r", "top", "high"], [0.0, z - r, top, task.high + x])
        fade, still = BlendChain.through(near, [1.0, 0.0]), BlendChain.constant(0.0)
        pieces = tuple(
            AffinePiece(still, 0.0, fade.scaled(d * change)) for d in (0.0, 1.0, 1.0, 0.0)
        )
        place = np.array([near[0], 0.0, height])
        shares.append(Share.at(name, "z", change, place, StackedField(name, "z", walls, pieces)))
    effect = np.array([[each.effect(anchor) / each.change for each in shares] for anchor in shares])
    size = np.linalg.solve(effect, [share.change for share in shares])
    yield f"W = {effect.round(6).tolist()}, condition {np.linalg.cond(effect):.0f}"
    yield f"sizes that would be needed for 1.0 and 0.4 m: {size.round(1).tolist()}"
    try:
        solve_field_sizes(shares)
    except AssocHullError as error:
        yield f"refused: {error}"


def together(state: HullState) -> Iterator[str]:
    """Give how six parameters are met together, and what the fold check takes."""
    parent, now = parent_of(state), ah.Hull(state).measure(only=list(_SIX))
    asked = {
        name: now[name] + part * now[name] + amount for name, (part, amount) in _SIX.items()
        if name in now
    }  # fmt: skip
    layout = Layout()
    vmap = compose_map(parent, asked, layout)
    worst = 0.0
    for name in asked:
        share = CATALOGUE[name].lays(parent, asked[name], layout)  # type: ignore[misc]
        if isinstance(share, Share):
            moved = (vmap(share.places) - share.places)[:, "xyz".index(share.axis)]
            worst = max(worst, abs(float((moved * share.weights).sum()) - share.change))
    places = cloud(state)
    box = np.stack([places.min(axis=0), places.max(axis=0)])
    times = list[float]()
    for _ in range(5):
        begin = perf_counter()
        found = certify(vmap, box)
        times.append(perf_counter() - begin)
    yield f"{', '.join(asked)}: an anchor is missed by {worst:.1e} m at most"
    yield (
        f"{found.reason}, least minor {found.least:.3f} ({found.minor}), {found.boxes} boxes, "
        f"{found.splits} halved, {1e3 * min(times):.0f} ms"
    )
