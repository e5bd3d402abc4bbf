"""The tasks on which methods of variation are compared, and the methods laid out for them.

Each task raises a place of the centre plane by some metres; all methods have the same anchors
below and above it, fade along the ship alike, and leave the rest of the hull as it is.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.tables import HullState
from assoc_hull.variation.fields.anchor_fields import hat_field
from assoc_hull.variation.fields.bounded_functions import CUBIC, QUINTIC, Blend, BlendChain
from assoc_hull.variation.fields.field import AffinePiece, StackedField, level_boundaries
from assoc_hull.variation.fields.layers import AdditiveLayer, FieldLayer, Layer
from assoc_hull.variation.parameters.parent import parent_of
from benchmarks.ffd import SIDE, Lattice, LatticeLayer

__all__ = ["METHODS", "Task", "active_points", "lattice", "tasks"]

_RADIUS = 0.145
"""Radius at a place without a circle, as a part of its height: that of the carrier's bossing."""


@attrs.frozen(eq=False)
class Task:
    """A place is raised.

    Attributes
    ----------
    name : str
    x, z : float, m
        The place.
    lift : float, m
        By how much.
    low, high : float, m
        Heights that stay.
    radius : float, m
        What belongs to the place; three times that is its neighbourhood.
    nodes, ends : (float, float), m
        Between which x it fades, and what the course is there.
    reach : (float, float), m
        Extent of the ship along x.
    """

    name: str
    x: float
    z: float
    lift: float
    low: float
    high: float
    radius: float
    nodes: tuple[float, float]
    ends: tuple[float, float]
    reach: tuple[float, float]

    def course(self, blend: Blend) -> BlendChain:
        """Give how it fades along the ship."""
        return BlendChain.through(self.nodes, self.ends, blend)


def tasks(state: HullState) -> list[Task]:
    """Give the tasks that a hull has the places for."""
    parent = parent_of(state)
    x = state.rows.xyz[state.live("rows")][:, 0]
    reach = float(x.min()), float(x.max())
    length, draught, found = parent.length, parent.draught, []
    if parent.has("boss"):
        at, _, z = parent.places["boss"].tolist()
        top = parent.places.get("boss top")
        r = _RADIUS * z if top is None else float(top[2]) - z
        nodes = (at, at + 0.25 * length)
        found.append(Task("shaft +1.0 m", at, z, 1.0, 0.0, draught, r, nodes, (1.0, 0.0), reach))
    if parent.has("transom"):
        at, _, z = parent.places["transom"].tolist()
        nodes, r = (at, at + 0.25 * length), _RADIUS * z
        found.append(
            Task("transom +0.6 m", at, z, 0.6, 0.3 * draught, parent.depth, r, nodes, (1.0, 0.0),
                 reach)
        )  # fmt: skip
    if parent.has("bulb tip"):
        _, _, z = parent.places["bulb tip"].tolist()
        nodes, r = (0.9 * length, length), _RADIUS * z
        found.append(
            Task("bulb +0.5 m", length, z, 0.5, 0.0, 1.25 * draught, r, nodes, (0.0, 1.0), reach)
        )
    return found


def _ratio(task: Task, blend: Blend) -> Layer:
    """Lay out the paper's form: ratios of z at h - r, h and h + r, 1 at both anchors."""
    z, r, d = task.z, task.radius, task.lift
    heights = [task.low, z - r, z, z + r, task.high]
    course = task.course(blend)
    ratios = [0.0, *(d / height for height in heights[1:-1]), 0.0]
    pieces = tuple(AffinePiece.along(course, ratio, 0.0) for ratio in ratios)
    names = ["low", "h-r", "h", "h+r", "high"]
    return FieldLayer(
        "ratio", (StackedField("ratio", "z", level_boundaries(names, heights), pieces, blend),)
    )


def _steps(task: Task, blend: Blend) -> Layer:
    """Lay out a plateau from h - r to h + r with a step on either side."""
    z, r, course = task.z, task.radius, task.course(blend)
    walls = level_boundaries(["low", "h-r", "h+r", "high"], [task.low, z - r, z + r, task.high])
    pieces = tuple(AffinePiece.along(course, 0.0, d) for d in (0.0, task.lift, task.lift, 0.0))
    return FieldLayer("steps", (StackedField("steps", "z", walls, pieces, blend),))


def _hat(task: Task, blend: Blend) -> Layer:
    """Lay out the rounded hat."""
    anchors = [("low", task.low, 0.0), ("h", task.z, task.lift), ("high", task.high, 0.0)]
    return FieldLayer("hat", (hat_field("hat", anchors, task.course(blend), blend=blend),))


def _rigid(task: Task, blend: Blend) -> Layer:
    """Lay out a hat whose top is level from h - r to h + r, so that a circle there is kept."""
    anchors = [
        ("low", task.low, 0.0),
        ("h-r", task.z - task.radius, task.lift),
        ("h+r", task.z + task.radius, task.lift),
        ("high", task.high, 0.0),
    ]
    field = hat_field("hat", anchors, task.course(blend), blend=blend, outward=("h-r", "h+r"))
    return FieldLayer("rigid", (field,))


def _additive(task: Task, blend: Blend) -> Layer:
    """Lay out additive functions: a peak over z, the same course along x, nothing of y."""
    peak = BlendChain.through([task.low, task.z, task.high], [0.0, task.lift, 0.0], blend)
    return AdditiveLayer("additive", z=(task.course(blend), BlendChain.constant(1.0), peak))


def lattice(task: Task) -> Lattice:
    """Give the lattice over the region of a task; the ship's end lies on its face."""
    aft = task.ends[0] == 1.0
    x = (task.reach[0], task.nodes[1]) if aft else (task.nodes[0], task.reach[1])
    y = 1000.0 * np.array([-1.0, 1.0])
    # in y nothing varies: any box that holds the ship gives the same
    return Lattice(np.array([[x[0], y[0], task.low], [x[1], y[1], task.high]]))


def active_points(task: Task) -> FloatArray:
    """Give which control points move, (5, 5, 5), 1 or 0.

    Two layers at each face inside the ship stay, so that curves are smooth across it: that leaves
    one layer of five over the height, and three along, those at the end of the ship.
    """
    on = np.zeros((SIDE, SIDE, SIDE))
    along = slice(0, 3) if task.ends[0] == 1.0 else slice(2, SIDE)
    on[along, :, 2] = 1.0
    return on


def _ffd(task: Task, blend: Blend) -> Layer:
    """Lay out a free-form deformation, sized so that the place is met."""
    del blend
    frame, moves = lattice(task), np.zeros((SIDE, SIDE, SIDE, 3))
    moves[..., 2] = active_points(task)
    unit = LatticeLayer(frame, moves)
    grip = float(unit.displacement(np.array([[task.x, 0.0, task.z]]))[0, 2])
    return LatticeLayer(frame, task.lift / grip * moves)


METHODS: Mapping[str, tuple[Callable[[Task, Blend], Layer], Blend]] = {
    "ratio (paper), cubic": (_ratio, CUBIC),
    "ratio, quintic": (_ratio, QUINTIC),
    "plateau steps, cubic": (_steps, CUBIC),
    "plateau steps, quintic": (_steps, QUINTIC),
    "rounded hat, cubic": (_hat, CUBIC),
    "rounded hat, quintic": (_hat, QUINTIC),
    "rigid hat, cubic": (_rigid, CUBIC),
    "rigid hat, quintic": (_rigid, QUINTIC),
    "additive, cubic": (_additive, CUBIC),
    "additive, quintic": (_additive, QUINTIC),
    "FFD 5 x 5 x 5": (_ffd, QUINTIC),
}
"""What lays out each method."""
