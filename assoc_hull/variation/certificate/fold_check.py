"""The fold check: whether a map is one to one, and how far an amplitude may go.

A positive determinant alone does not make a map one to one; all principal minors of the Jacobian
positive on a box do (D. Gale, H. Nikaido, "The Jacobian matrix and global univalence of mappings",
Mathematische Annalen 159, 1965). Each layer is checked alone, on the box that the layers before it
make of the hull's. The `Certificate` has the least minor, where it is, and which field between
which boundary curves is the cause. Folds beyond the hull are harmless and reported as a warning.

How far an amplitude may go before a layer folds.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Literal, TypedDict

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import (
    not_negative,
    number,
    places,
    positive,
)
from assoc_hull.errors import BadInputError, FoldError, WrongTypeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.numeric.intervals import (
    Interval,
    interval_difference,
    interval_product,
    interval_sum,
)
from assoc_hull.variation.certificate.field_enclosures import enclose_field
from assoc_hull.variation.certificate.field_minors import field_cells, field_minors, half_breadths
from assoc_hull.variation.certificate.layer_minors import (
    additive_minors,
    corner_minors,
    shear_minors,
    skew_box,
)
from assoc_hull.variation.certificate.minor_search import LeastMinor
from assoc_hull.variation.fields.field import StackedField
from assoc_hull.variation.fields.layers import (
    AdditiveLayer,
    CornerLayer,
    DeadriseLayer,
    Factors,
    FieldLayer,
    Layer,
    Rake,
)
from assoc_hull.variation.fields.space_map import VariationMap

__all__ = [
    "Certificate",
    "Reason",
    "admissible_amplitudes",
    "certify",
    "fold_cause",
    "fold_outside",
    "image_box",
]

Reason = Literal["certified", "folds", "thin", "undecided"]


@attrs.frozen
class Certificate:
    """Whether a layer, or a map, keeps space the right way round in a box.

    Attributes
    ----------
    reason : {"certified", "folds", "thin", "undecided"}
        ``"folds"``: a minor of the Jacobian is zero or negative at the witness. ``"thin"``: all
        are positive as far as was searched, but one is below the margin. ``"undecided"``: the
        bounds did not become sharp enough; such a layer is refused as well.
    least : float
        The least minor met.
    minor : str
        Which: ``"X_x"``, ``"Y_y"``, ``"Z_z"``, or ``"D"``, the determinant of two of them.
    witness : (float, float, float), m
        Where it was met.
    bound : float
        No minor is below it, if certified.
    margin : float
        What every minor must reach.
    boxes, splits : int
        How many boxes were searched, and how many of them halved.
    layer, field : str
        The layer, and the field of it that makes the minor small; empty if there is none.
    between : tuple of (str, float)
        Names and heights (m) of the field's boundary curves next below and above the witness.
    node : float or None, m
        The node nearest to the witness along the ship.
    minors : tuple of (str, float)
        The least value met of every minor that is not 1 by itself.
    """

    reason: Reason
    least: float
    minor: str
    witness: tuple[float, float, float]
    bound: float
    margin: float
    boxes: int = 0
    splits: int = 0
    layer: str = ""
    field: str = ""
    between: tuple[tuple[str, float], ...] = ()
    node: float | None = None
    minors: tuple[tuple[str, float], ...] = ()

    @property
    def certified(self) -> bool:
        """Whether all minors reach the margin everywhere in the box."""
        return self.reason == "certified"

    def check(self) -> None:
        """Refuse what is not certified.

        Raises
        ------
        FoldError
            With the numbers.
        """
        if not self.certified:
            raise FoldError(
                self.reason, self.minor, self.least, self.margin, self.witness, self.layer,
                self.field, self.between, self.node,
            )  # fmt: skip


class FoldCause(TypedDict):
    """The entries of a certificate that name the cause; heights and node in m."""

    field: str
    between: tuple[tuple[str, float], ...]
    node: float | None


def fold_cause(layer: FieldLayer, axes: str, place: tuple[float, float, float]) -> FoldCause:
    """Name the field that shrinks space most at a place, of those that move along given axes.

    Examples
    --------
    >>> from assoc_hull.variation.fields.bounded_functions import BlendChain
    >>> from assoc_hull.variation.certificate.fold_check import fold_cause
    >>> from assoc_hull.variation.fields.layers import FieldLayer
    >>> from assoc_hull.variation.fields.anchor_fields import hat_field
    >>> fade = BlendChain.through([6, 66], [1, 0])
    >>> shaft = hat_field("shaft", [("base", 0, 0), ("shaft", 5, 1), ("T", 18, 0)], fade)
    >>> fold_cause(FieldLayer("local", (shaft,)), "z", (6.0, 0.0, 9.0))["between"]
    (('shaft+', 6.5), ('T-', 14.1))
    """
    xyz = np.array([place])
    fields = [each for each in layer.fields if each.axis in axes]
    if not fields:
        return FoldCause(field="", between=(), node=None)
    field = fields[0]
    if len(fields) > 1:
        own = [float(each.gradient(xyz)[0, "xyz".index(each.axis)]) for each in fields]
        field = fields[int(np.argmin(own))]
    return FoldCause(field=field.name, between=_between(field, place), node=_node(field, place[0]))


def _between(
    field: StackedField | Rake, place: tuple[float, float, float]
) -> tuple[tuple[str, float], ...]:
    """Give name and height (m) of the boundary curves next below and above a place."""
    if isinstance(field, Rake):
        return ()
    x = np.array([place[0]])
    heights = [(each.name, float(each.height.at(x)[0])) for each in field.boundaries]
    below = [each for each in heights if each[1] <= place[2]][-1:]
    above = [each for each in heights if each[1] > place[2]][:1]
    return (*below, *above)


def _node(field: StackedField | Rake, x: float) -> float | None:
    """Give the node nearest to a place along the ship, m, of the functions that vary."""
    parts = [field.course] if isinstance(field, Rake) else [
        part for each in field.pieces for part in (each.a, each.d)
    ]  # fmt: skip
    nodes = [node for part in parts if len(part.nodes) > 1 for node in part.nodes.tolist()]
    return min(nodes, key=lambda node: (abs(node - x), node), default=None)


# --------------------------------------------------------------------------------------
# The image of a box, enclosed by a box, for the layer after it.

_PARTS = 8
"""Every cell is divided into so many parts a side: bounds of sums become sharper."""


def image_box(layer: Layer, box: FloatArray) -> FloatArray:
    """Enclose the image of a box, (2, 3), m, by a box.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.fields.bounded_functions import BlendChain
    >>> from assoc_hull.variation.fields.field import AffinePiece, level_boundaries, StackedField
    >>> from assoc_hull.variation.fields.layers import FieldLayer
    >>> from assoc_hull.variation.certificate.fold_check import image_box
    >>> longer = AffinePiece.along(BlendChain.constant(1.0), 0.02, 0.0)
    >>> layer = FieldLayer(
    ...     "longer", (StackedField("x", "x", level_boundaries(["base"], [0.0]), (longer,)),)
    ... )
    >>> image_box(layer, np.array([[0.0, -20, 0], [200, 20, 30]])).round(9).tolist()
    [[0.0, -20.0, 0.0], [204.0, 20.0, 30.0]]
    """
    if isinstance(layer, FieldLayer):
        return _of_fields(layer, box)
    if isinstance(layer, CornerLayer):
        return _of_corner(layer, box)
    if isinstance(layer, DeadriseLayer):
        return _of_shear(layer, box)
    assert isinstance(layer, AdditiveLayer)
    return _of_additive(layer, box)


def _parted(low: FloatArray, high: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Divide boxes (m, k), (m, k) into `_PARTS` equal ones a side."""
    k = low.shape[1]
    step = np.array(list(np.ndindex(*(_PARTS,) * k)))
    size = (high - low)[:, None, :] / _PARTS
    first = low[:, None, :] + step[None, :, :] * size
    return first.reshape(-1, k), (first + size).reshape(-1, k)


def _around(x: Interval, y: Interval, z: Interval) -> FloatArray:
    """Give the box around intervals of x, of the half-breadth and of z."""
    side = float(max(y[1].max(), -y[0].min()))
    return np.array(
        [
            [float(x[0].min()), -side, float(z[0].min())],
            [float(x[1].max()), side, float(z[1].max())],
        ]
    )


def _of_fields(layer: FieldLayer, box: FloatArray) -> FloatArray:
    lower, upper = _parted(*field_cells(layer.fields, box))
    x, z = (lower[:, 0], upper[:, 0]), (lower[:, 1], upper[:, 1])
    out = half_breadths(box)
    y = np.full(len(lower), out[0]), np.full(len(lower), out[1])
    wide = y
    for field in layer.fields:
        found = enclose_field(field, lower, upper)
        if field.axis == "x":
            x = interval_sum(x, found.u)
        elif field.axis == "z":
            z = interval_sum(z, found.u)
        else:
            # psi lies between zero and the half-breadth
            wide = interval_sum(wide, interval_product(found.own, (np.zeros(len(lower)), y[1])))
    return _around(x, wide, z)


def _of_corner(layer: CornerLayer, box: FloatArray) -> FloatArray:
    spans = np.array(skew_box(layer, box))
    lower, upper = _parted(spans[None, :, 0], spans[None, :, 1])
    eta, zeta = (lower[:, 0], upper[:, 0]), (lower[:, 1], upper[:, 1])
    course = layer.course.bounds(box[:1, 0], box[1:, 0])
    weight = interval_product(
        course, interval_product(layer.fade.bounds(*eta), layer.fade.bounds(*zeta))
    )
    new = []
    for ratio, part in ((layer.eta_ratio, eta), (layer.zeta_ratio, zeta)):
        size = np.array([ratio - 1.0])
        new.append(
            interval_sum(part, interval_product(interval_product((size, size), weight), part))
        )
    # back from the skew coordinates: y = y_c - eta cos, z = z_c + zeta - eta sin
    cos, sin = (np.array([part(layer.rise)]) for part in (math.cos, math.sin))
    corner = np.array([layer.y]), np.array([layer.z])
    y = interval_difference((corner[0], corner[0]), interval_product((cos, cos), new[0]))
    z = interval_difference(
        interval_sum((corner[1], corner[1]), new[1]), interval_product((sin, sin), new[0])
    )
    inner = half_breadths(box)
    return _around((box[:1, 0], box[1:, 0]), (np.minimum(y[0], inner[0]), y[1]), z)


def _of_shear(layer: DeadriseLayer, box: FloatArray) -> FloatArray:
    lower, upper = _parted(box[:1, 2:], box[1:, 2:])
    z = lower[:, 0], upper[:, 0]
    ramp = layer.ramp(np.array(half_breadths(box)))[0] * layer.q
    lift = ramp.min(keepdims=True), ramp.max(keepdims=True)
    course = layer.course.bounds(box[:1, 0], box[1:, 0])
    z = interval_sum(z, interval_product(interval_product(course, lift), layer.fade.bounds(*z)))
    return _around((box[:1, 0], box[1:, 0]), (box[:1, 1], box[1:, 1]), z)


def _of_additive(layer: AdditiveLayer, box: FloatArray) -> FloatArray:
    out = half_breadths(box)
    spans = np.array([box[:, 0], out, box[:, 2]])
    lower, upper = _parted(spans[None, :, 0], spans[None, :, 1])
    x, y, z = ((lower[:, axis], upper[:, axis]) for axis in range(3))
    sides = x, y, z
    if layer.x is not None:
        x = interval_sum(x, layer.x.bounds(*x))
    if layer.y is not None:
        y = interval_sum(y, _product(layer.y, sides))
    if layer.z is not None:
        z = interval_sum(z, _product(layer.z, sides))
    return _around(x, y, z)


def _product(factors: Factors, sides: tuple[Interval, Interval, Interval]) -> Interval:
    first, second, third = (part.bounds(*side) for part, side in zip(factors, sides, strict=True))
    return interval_product(interval_product(first, second), third)


# --------------------------------------------------------------------------------------
# The check, layer by layer.

MARGIN = 0.05
"""What minors must reach: less is a legal map, and useless lines."""

_AXES = {"X_x": "x", "Y_y": "y", "Z_z": "z", "D": "xz"}


def certify(what: VariationMap | Layer, box: ArrayLike, least: float = MARGIN) -> Certificate:
    """Check that a layer or a map folds nothing in a box.

    Parameters
    ----------
    what : VariationMap or Layer
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
    >>> from assoc_hull.variation.certificate.fold_check import certify
    >>> from assoc_hull.variation.fields.bounded_functions import BlendChain
    >>> from assoc_hull.variation.fields.layers import FieldLayer
    >>> from assoc_hull.variation.fields.anchor_fields import hat_field
    >>> fade = BlendChain.through([6, 66], [1, 0])
    >>> shaft = hat_field("shaft", [("base", 0, 0), ("shaft", 5, 1), ("T", 18, 0)], fade)
    >>> found = certify(FieldLayer("local", (shaft,)), [[0, -25, -1], [300, 25, 27]])
    >>> found.certified, found.minor, round(found.least, 6)
    (True, 'Z_z', 0.87501)
    """
    corners = _box(box)
    margin = not_negative(least, "least", "in certify")
    found = list[Certificate]()
    layers = what.layers if isinstance(what, VariationMap) else (what,)
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
    """Give the certificate of what moves nothing: all minors are 1."""
    x, y, z = box[0].tolist()
    return Certificate("certified", 1.0, "D", (x, y, z), 1.0, margin, layer=layer)


def _layer(layer: Layer, box: FloatArray, margin: float) -> Certificate:
    """Certify one layer on the box that it acts on."""
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
        return attrs.evolve(record, **fold_cause(layer, _AXES[worst.minor], worst.witness))
    return record


def _minors(layer: Layer, box: FloatArray, margin: float) -> list[LeastMinor]:
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


def _by_minor(found: Sequence[LeastMinor]) -> tuple[tuple[str, float], ...]:
    """Give the least value found of each minor, over strips."""
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


_BEYOND = 0.25
"""Where a region has no end, the check reaches beyond the box by this part of its extent."""


def fold_outside(what: VariationMap | Layer, box: ArrayLike) -> Certificate | None:
    """Tell whether a map that is certified in the hull's box folds in its regions beyond.

    Parameters
    ----------
    what : VariationMap or Layer
    box : (2, 3), m
        Least and greatest coordinates of the hull.

    Returns
    -------
    Certificate or None
        Of a fold outside the box; None if there is none.

    Examples
    --------
    >>> from assoc_hull.variation.fields.bounded_functions import BlendChain
    >>> from assoc_hull.variation.fields.layers import FieldLayer
    >>> from assoc_hull.variation.certificate.fold_check import fold_outside
    >>> from assoc_hull.variation.fields.anchor_fields import hat_field
    >>> deck = hat_field(
    ...     "deck", [("T", 18, 0), ("deck", 28, 2), ("mast", 30, 0)], BlendChain.constant(1.0)
    ... )
    >>> layer = FieldLayer("local", (deck,))
    >>> fold_outside(layer, [[0, -25, 0], [300, 25, 27]]).reason
    'folds'
    """
    corners = places(box, "box", "in certify")
    wide = _reach(what, corners)
    if (wide == corners).all():
        return None
    found = certify(what, wide, least=0.0)
    return found if found.reason == "folds" else None


def _reach(what: VariationMap | Layer, box: FloatArray) -> FloatArray:
    """Give the box (2, 3), m, around the hull's and all regions."""
    wide = box.copy()
    size = _BEYOND * (box[1] - box[0])
    for region in what.regions():
        for axis, (low, high) in ((0, region.x), (2, region.z)):
            if low > high:
                continue
            wide[0, axis] = min(wide[0, axis], _end(low, float(box[0, axis] - size[axis])))
            wide[1, axis] = max(wide[1, axis], _end(high, float(box[1, axis] + size[axis])))
    return wide


def _end(place: float, instead: float) -> float:
    """Give an end of a region; another place instead where it has none."""
    return place if math.isfinite(place) else instead


_ROUNDS = 60
_NEAR = 1e-9
"""An end is known to so much of itself,"""

_UNSURE = 1e-7
"""or the least minor there is the margin to twice so much: nearer, bounds leave it undecided."""

_LARGE = 16.0
"""Steps grow so much at most."""

_FARTHEST = _LARGE**6
"""So many first changes away nothing is taken to fold."""

_FLAT = 1e-9


def admissible_amplitudes(
    layer_of: Callable[[float], VariationMap | Layer], box: ArrayLike, *, present: float = 0.0,
    first: float = 1.0, least: float = MARGIN,
) -> tuple[float, float]:  # fmt: skip
    """Give the least and the greatest amplitude that are certified.

    Parameters
    ----------
    layer_of : callable
        Gives the layer, or map, of an amplitude. One that it refuses (BadInputError) counts as
        one that folds.
    box : (2, 3), m
        Least and greatest coordinates.
    present : float
        The amplitude at which nothing moves.
    first : float
        A usual change of it, above nil.
    least : float
        What minors must reach.

    Returns
    -------
    low, high : float
        Both certified themselves; infinite where nothing ever folds.

    Examples
    --------
    >>> from assoc_hull.variation.certificate.fold_check import admissible_amplitudes
    >>> from assoc_hull.variation.fields.bounded_functions import BlendChain
    >>> from assoc_hull.variation.fields.layers import FieldLayer
    >>> from assoc_hull.variation.fields.anchor_fields import hat_field
    >>> fade = BlendChain.through([6, 66], [1, 0])
    >>> def shaft(rise):
    ...     anchors = [("base", 0, 0), ("shaft", 5, rise), ("T", 18, 0)]
    ...     return FieldLayer("local", (hat_field("shaft", anchors, fade),))
    >>> low, high = admissible_amplitudes(shaft, [[0, -25, -1], [300, 25, 27]])
    >>> round(low, 3), round(high, 3)
    (-3.83, 7.601)
    """
    number(present, "present", "in admissible")
    step = positive(first, "first", "in admissible")

    def spare(amplitude: float) -> float:
        """Give by how much the least minor lies above the margin; it falls with the amplitude."""
        try:
            found = certify(layer_of(amplitude), box, least)
        except BadInputError:
            return -math.inf
        return found.least - least if found.certified else min(found.least - least, -_UNSURE)

    return _last_amplitude(spare, present, -step), _last_amplitude(spare, present, step)


def _last_amplitude(spare: Callable[[float], float], present: float, step: float) -> float:
    """Find the last amplitude in one sense that leaves something to spare.

    Where minors are linear in the amplitude, the secant meets the end at once.
    """
    held, room = present, spare(present)
    if room < 0.0:
        return present
    failed, lack = present + step, spare(present + step)
    while lack >= 0.0:
        if abs(failed - present) > _FARTHEST * abs(step):
            return math.copysign(math.inf, step)
        beyond = _beyond(failed - held, room, lack)
        held, room = failed, lack
        failed, lack = held + beyond, spare(held + beyond)
    for rounds in range(_ROUNDS):
        if abs(failed - held) <= _NEAR * abs(failed - present) or room <= 2.0 * _UNSURE:
            break
        tried = _between_amplitudes(held, room, failed, lack, halve=rounds % 3 == 2)
        value = spare(tried)
        if value >= 0.0:
            held, room = tried, value
        else:
            failed, lack = tried, value
    return held


def _beyond(step: float, before: float, after: float) -> float:
    """Give a step at whose end nothing will be left, if what is left goes on falling as it did.

    It is no shorter than the last: what falls ever slower, as a square does, is met all the same.
    """
    falls = before - after
    if not falls > _FLAT * before:
        return _LARGE * step
    return min(max(after / falls * (1.0 + 1e-9) + 1e-9, 1.0), _LARGE) * step


def _between_amplitudes(
    held: float, room: float, failed: float, lack: float, *, halve: bool
) -> float:
    """Give where the secant is nil, a little to the safe side; now and then the middle."""
    part = 0.5 if halve or math.isinf(lack) else room / (room - lack) * (1.0 - 1e-10)
    return held + part * (failed - held)
