"""The fold check: whether a map is one to one, with something to spare.

A positive determinant alone does not make a map one to one. All principal minors of the Jacobian
positive on a box do (D. Gale, H. Nikaido, "The Jacobian matrix and global univalence of mappings",
Mathematische Annalen 159, 1965). Each layer is checked alone, on the box that the layers before
it make of the hull's.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
from numpy.typing import ArrayLike

from assoc_hull.arguments import not_negative, places
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.certificate import Certificate, Reason
from assoc_hull.variation.certify_cells import Found
from assoc_hull.variation.certify_fields import field_minors
from assoc_hull.variation.culprit import culprit
from assoc_hull.variation.fields_layer import FieldLayer
from assoc_hull.variation.layer import Layer
from assoc_hull.variation.vmap import VMap

__all__ = ["certify"]

MARGIN = 0.05
"""What minors must reach: less is a legal map, and useless lines."""

_AXES = {"X_x": "x", "Y_y": "y", "Z_z": "z", "D": "xz"}


def certify(what: VMap | Layer, box: ArrayLike, least: float = MARGIN) -> Certificate:
    """Check that a layer or a map folds nothing in a box.

    Parameters
    ----------
    what : VMap or Layer
    box : (2, 3), m
        Least and greatest coordinates.
    least : float
        What every principal minor must reach.

    Returns
    -------
    Certificate
        Of a map, that of the layer with the least minor, refused ones first.

    Raises
    ------
    BadInputError
        A box that is none.

    Examples
    --------
    >>> from assoc_hull.variation.certify import certify
    >>> from assoc_hull.variation.chain import Chain
    >>> from assoc_hull.variation.fields_layer import FieldLayer
    >>> from assoc_hull.variation.hat import hat
    >>> fade = Chain.through([6, 66], [1, 0])
    >>> shaft = hat("shaft", [("base", 0, 0), ("shaft", 5, 1), ("T", 18, 0)], fade)
    >>> found = certify(FieldLayer("local", (shaft,)), [[0, -25, -1], [300, 25, 27]])
    >>> found.certified, found.minor, round(found.least, 6)
    (True, 'Z_z', 0.87501)
    """
    corners = _box(box)
    margin = not_negative(least, "least", "in certify")
    found = list[Certificate]()
    for layer in what.layers if isinstance(what, VMap) else (what,):
        found.append(_layer(layer, corners, margin))
    refused = [each for each in found if not each.certified]
    return min(refused or found, key=lambda each: each.least, default=_nothing(corners, margin))


def _box(box: ArrayLike) -> FloatArray:
    corners = places(box, "box", "in certify")
    if corners.shape != (2, 3) or (corners[1] < corners[0]).any():
        raise BadInputError(
            "the box has no extent", "in certify", "give least and greatest coordinates"
        )
    return corners


def _nothing(box: FloatArray, margin: float, layer: str = "") -> Certificate:
    x, y, z = box[0].tolist()
    return Certificate("certified", 1.0, "D", (x, y, z), 1.0, margin, layer=layer)


def _layer(layer: Layer, box: FloatArray, margin: float) -> Certificate:
    if not isinstance(layer, FieldLayer):
        raise NotImplementedError
    return _certificate(layer, field_minors(layer, box, margin), box, margin)


def _certificate(
    layer: FieldLayer, found: Sequence[Found], box: FloatArray, margin: float
) -> Certificate:
    if not found:
        return _nothing(box, margin, layer.name)
    worst = min(found, key=lambda each: (each.least, each.bound))
    bound = min(each.bound for each in found)
    record = Certificate(
        _reason(worst.least, bound, margin), worst.least, worst.minor, worst.witness, bound, margin,
        sum(each.boxes for each in found), sum(each.splits for each in found), layer.name,
        minors=_by_minor(found),
    )  # fmt: skip
    return attrs.evolve(record, **culprit(layer, _AXES[worst.minor], worst.witness))


def _by_minor(found: Sequence[Found]) -> tuple[tuple[str, float], ...]:
    least = dict[str, float]()
    for each in found:
        least[each.minor] = min(each.least, least.get(each.minor, each.least))
    return tuple(least.items())


def _reason(least: float, bound: float, margin: float) -> Reason:
    if least <= 0.0:
        return "folds"
    if least < margin:
        return "thin"
    return "certified" if bound >= margin else "undecided"
