"""Which field makes a minor small at a place, and between which of its boundary curves."""

from __future__ import annotations

from typing import TypedDict

import numpy as np

from assoc_hull.variation.fields.field import Field
from assoc_hull.variation.fields.fields_layer import FieldLayer, Rake

__all__ = ["culprit"]


class Culprit(TypedDict):
    """The entries of a certificate that tell it."""

    field: str
    between: tuple[tuple[str, float], ...]
    node: float | None


def culprit(layer: FieldLayer, axes: str, place: tuple[float, float, float]) -> Culprit:
    """Name the field that shrinks space most at a place, of those that move along given axes.

    Examples
    --------
    >>> from assoc_hull.variation.fields.piecewise_linear import Chain
    >>> from assoc_hull.variation.certificate.fold_cause import culprit
    >>> from assoc_hull.variation.fields.fields_layer import FieldLayer
    >>> from assoc_hull.variation.fields.hat import hat
    >>> fade = Chain.through([6, 66], [1, 0])
    >>> shaft = hat("shaft", [("base", 0, 0), ("shaft", 5, 1), ("T", 18, 0)], fade)
    >>> culprit(FieldLayer("local", (shaft,)), "z", (6.0, 0.0, 9.0))["between"]
    (('shaft+', 6.5), ('T-', 14.1))
    """
    xyz = np.array([place])
    fields = [each for each in layer.fields if each.axis in axes]
    if not fields:
        return Culprit(field="", between=(), node=None)
    own = [float(each.gradient(xyz)[0, "xyz".index(each.axis)]) for each in fields]
    field = fields[int(np.argmin(own))]
    return Culprit(field=field.name, between=_between(field, place), node=_node(field, place[0]))


def _between(
    field: Field | Rake, place: tuple[float, float, float]
) -> tuple[tuple[str, float], ...]:
    """Give the boundary curves below and above a place, those there are."""
    if isinstance(field, Rake):
        return ()
    x = np.array([place[0]])
    heights = [(each.name, float(each.height.at(x)[0])) for each in field.boundaries]
    below = [each for each in heights if each[1] <= place[2]][-1:]
    above = [each for each in heights if each[1] > place[2]][:1]
    return (*below, *above)


def _node(field: Field | Rake, x: float) -> float | None:
    """Give the node nearest to a place, of the courses that vary."""
    parts = [field.course] if isinstance(field, Rake) else [
        part for each in field.pieces for part in (each.a, each.d)
    ]  # fmt: skip
    nodes = [node for part in parts if len(part.nodes) > 1 for node in part.nodes.tolist()]
    return min(nodes, key=lambda node: (abs(node - x), node), default=None)
