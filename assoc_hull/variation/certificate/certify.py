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
from assoc_hull.errors import BadInputError, WrongTypeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.certificate.certify_additive import additive_minors
from assoc_hull.variation.certificate.certify_corner import corner_minors
from assoc_hull.variation.certificate.certify_fields import field_minors
from assoc_hull.variation.certificate.certify_shear import shear_minors
from assoc_hull.variation.certificate.fold_cause import culprit
from assoc_hull.variation.certificate.image_box import image_box
from assoc_hull.variation.certificate.minor_search import Found
from assoc_hull.variation.certificate.record import Certificate, Reason
from assoc_hull.variation.fields.additive import AdditiveLayer
from assoc_hull.variation.fields.corner import CornerLayer
from assoc_hull.variation.fields.fields_layer import FieldLayer
from assoc_hull.variation.fields.layer import Layer
from assoc_hull.variation.fields.shear import DeadriseLayer
from assoc_hull.variation.fields.space_map import VMap

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
        Of a map, that of the layer with the least minor, refused ones first; its bound holds for
        all layers.

    Raises
    ------
    BadInputError
        A box that is none.

    Examples
    --------
    >>> from assoc_hull.variation.certificate.certify import certify
    >>> from assoc_hull.variation.fields.piecewise_linear import Chain
    >>> from assoc_hull.variation.fields.fields_layer import FieldLayer
    >>> from assoc_hull.variation.fields.hat import hat
    >>> fade = Chain.through([6, 66], [1, 0])
    >>> shaft = hat("shaft", [("base", 0, 0), ("shaft", 5, 1), ("T", 18, 0)], fade)
    >>> found = certify(FieldLayer("local", (shaft,)), [[0, -25, -1], [300, 25, 27]])
    >>> found.certified, found.minor, round(found.least, 6)
    (True, 'Z_z', 0.87501)
    """
    corners = _box(box)
    margin = not_negative(least, "least", "in certify")
    found = list[Certificate]()
    layers = what.layers if isinstance(what, VMap) else (what,)
    for k, layer in enumerate(layers):
        if k:
            corners = image_box(layers[k - 1], corners)
        found.append(_layer(layer, corners, margin))
    refused = [each for each in found if not each.certified]
    nothing = _nothing(corners, margin)
    worst = min(refused or found, key=lambda each: each.least, default=nothing)
    if refused or not found:
        return worst
    return attrs.evolve(worst, bound=min(each.bound for each in found))


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
    found = _minors(layer, box, margin)
    if not found:
        return _nothing(box, margin, layer.name)
    worst = min(found, key=lambda each: (each.least, each.bound))
    bound = min(each.bound for each in found)
    record = Certificate(
        _reason(worst.least, bound, margin), worst.least, worst.minor, worst.witness, bound, margin,
        sum(each.boxes for each in found), sum(each.splits for each in found), layer.name,
        minors=_by_minor(found),
    )  # fmt: skip
    if isinstance(layer, FieldLayer):
        return attrs.evolve(record, **culprit(layer, _AXES[worst.minor], worst.witness))
    return record


def _minors(layer: Layer, box: FloatArray, margin: float) -> list[Found]:
    """Give the least minors of a layer of any kind."""
    if isinstance(layer, FieldLayer):
        return field_minors(layer, box, margin)
    if isinstance(layer, CornerLayer):
        return corner_minors(layer, box, margin)
    if isinstance(layer, DeadriseLayer):
        return shear_minors(layer, box)
    if isinstance(layer, AdditiveLayer):
        return additive_minors(layer, box, margin)
    raise WrongTypeError(
        f"'{layer.name}' is a {type(layer).__name__}", "in certify", "give a layer of a known kind"
    )


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
