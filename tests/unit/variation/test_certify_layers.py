"""The fold check of corners, shears, additive functions and maps of several layers."""

from __future__ import annotations

import attrs
import numpy as np
import pytest
from hypothesis import given, settings

from assoc_hull.errors import WrongTypeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.certificate.fold_check import (
    admissible_amplitudes,
    certify,
    fold_outside,
    image_box,
)
from assoc_hull.variation.fields.anchor_fields import hat_field
from assoc_hull.variation.fields.bounded_functions import BLENDS, BlendChain
from assoc_hull.variation.fields.field import (
    AffinePiece,
    FieldRegion,
    StackedField,
    level_boundaries,
)
from assoc_hull.variation.fields.layers import (
    AdditiveLayer,
    CornerLayer,
    DeadriseLayer,
    FieldLayer,
    Layer,
)
from assoc_hull.variation.fields.space_map import VariationMap
from tests.long_forms import draws
from tests.variation_strategies import BEAM, DEPTH, LENGTH, layers, places

BOX = np.array([[-8.0, -0.5 * BEAM, -2.0], [LENGTH + 8.0, 0.5 * BEAM, DEPTH]])


def bilge(ratio: float, reach: float, blend: str = "quintic") -> CornerLayer:
    """The corner of the printed values: r = 2.4 m, half-breadth 29 m, faded at some radii."""
    fade = BlendChain.through([2.4, 2.4 * reach], [1.0, 0.0], BLENDS[blend])
    return CornerLayer("bilge", BlendChain.constant(1.0), 29.0, 0.0, 0.0, ratio, ratio, fade)


CORNER_BOX = [[0.0, -29.0, 0.0], [300.0, 29.0, 30.0]]


@pytest.mark.parametrize(("reach", "largest"), [(8.0, 4.8), (5.0, 4.45), (3.0, 3.8)])
def test_largest_bilge_radius_is_near_the_printed_one(reach: float, largest: float) -> None:
    """A quintic corner about r = 2.4 m folds near the radius that is stated for its reach."""
    high = admissible_amplitudes(
        lambda ratio: bilge(ratio, reach), CORNER_BOX, present=1.0, first=0.1, least=0.0
    )[1]
    assert 2.4 * high == pytest.approx(largest, rel=0.05)


@pytest.mark.parametrize("rise", [0.0, 0.04])
@pytest.mark.parametrize("ratios", [(1.5, 1.5), (0.5, 1.0), (1.0, 1.9)])
def test_minors_of_a_corner_are_those_of_its_jacobian(
    rise: float, ratios: tuple[float, float]
) -> None:
    """No minor in the skew coordinates, sampled by differences, lies below the least one found."""
    eta_ratio, zeta_ratio = ratios
    layer = attrs.evolve(bilge(1.0, 5.0), rise=rise, eta_ratio=eta_ratio, zeta_ratio=zeta_ratio)
    found = certify(layer, CORNER_BOX)
    y, z = np.meshgrid(np.linspace(0.0, 29.0, 300), np.linspace(0.0, 30.0, 300))
    xyz = np.stack([np.zeros(y.size), y.ravel(), z.ravel()], axis=1)
    inner = layer.jacobian(xyz)[:, 1:, 1:]
    # the rows and columns of eta and zeta: y = Y - eta cos, z = Z + zeta - eta sin
    turn = np.array([[-np.cos(rise), 0.0], [-np.sin(rise), 1.0]])
    skew = np.linalg.inv(turn) @ inner @ turn
    least = min(skew[:, 0, 0].min(), skew[:, 1, 1].min(), np.linalg.det(skew).min())
    assert found.bound <= least + 1e-12
    assert found.least == pytest.approx(least, abs=2e-3)


def test_corner_that_reaches_the_centre_plane_is_refused() -> None:
    """What moves at the centre plane would tear the two sides apart."""
    assert certify(bilge(1.2, 11.0), CORNER_BOX).certified
    assert certify(bilge(1.2, 13.0), CORNER_BOX).reason == "folds"


@pytest.mark.parametrize("blend", ["cubic", "quintic"])
def test_deadrise_folds_at_the_closed_form(blend: str) -> None:
    """Z_z = 1 - tan change x half-breadth x max b' / fade height."""
    curve = BLENDS[blend]
    fade = BlendChain.through([2.4, 14.4], [1.0, 0.0], curve)

    def deadrise(q: float) -> DeadriseLayer:
        return DeadriseLayer("deadrise", BlendChain.constant(1.0), q, 1.0, 0.0, fade, curve)

    high = admissible_amplitudes(deadrise, CORNER_BOX, first=0.01, least=0.05)[1]
    assert high == pytest.approx(0.95 * 12.0 / (28.0 * curve.steepest), rel=1e-6)
    refused = certify(deadrise(1.1 * high / 0.95), CORNER_BOX)
    assert (refused.reason, refused.minor) == ("folds", "Z_z")
    assert refused.witness[2] == pytest.approx(8.4, abs=0.2)


def test_layer_is_checked_where_the_layers_before_it_put_the_hull() -> None:
    """A fold just beyond the parent's stem counts once the hull is lengthened into it."""
    longer = StackedField(
        "length",
        "x",
        level_boundaries(["base"], [0.0]),
        (AffinePiece.along(BlendChain.constant(1.0), 0.05, 0.0),),
    )
    back = BlendChain.through([249.0, 252.0], [0.0, -9.0])
    fold = StackedField(
        "fold",
        "x",
        level_boundaries(["base"], [0.0]),
        (AffinePiece(BlendChain.constant(0.0), 0.0, back),),
    )
    first, second = FieldLayer("length", (longer,)), FieldLayer("fold", (fold,))
    assert certify(second, BOX).certified
    found = certify(VariationMap((first, second)), BOX)
    assert (found.reason, found.layer) == ("folds", "fold")
    outside = fold_outside(VariationMap((second,)), BOX)
    assert outside is not None
    assert outside.witness[0] > BOX[1, 0]
    assert fold_outside(VariationMap((first,)), BOX) is None


def test_additive_functions_are_certified_as_other_layers_are() -> None:
    """Their own check answers in the same terms."""
    fade = BlendChain.through([6.0, 66.0], [1.0, 0.0])

    def shaft(rise: float) -> AdditiveLayer:
        hump = BlendChain.through([0.0, 5.0, 18.0], [0.0, 1.0, 0.0])
        return AdditiveLayer("shaft", z=(fade.scaled(rise), BlendChain.constant(1.0), hump))

    assert certify(shaft(1.0), BOX).certified
    found = certify(shaft(8.0), BOX)
    assert (found.reason, found.minor) == ("folds", "Z_z")


@attrs.frozen
class Mystery:
    """A layer that moves nothing, of a kind that nobody knows."""

    name: str

    def displacement(self, xyz: FloatArray) -> FloatArray:
        return np.zeros_like(xyz)

    def jacobian(self, xyz: FloatArray) -> FloatArray:
        return np.tile(np.eye(3), (len(xyz), 1, 1))

    def regions(self) -> tuple[FieldRegion, ...]:
        return ()


def test_layer_of_an_unknown_kind_is_refused() -> None:
    """What cannot be checked is not certified."""

    with pytest.raises(WrongTypeError, match="Mystery"):
        certify(Mystery("other"), BOX)


@settings(max_examples=draws(40), deadline=None)
@given(layer=layers(2.0), xyz=places(200))
def test_image_of_a_box_holds_the_images_of_its_places(layer: Layer, xyz: FloatArray) -> None:
    """Whatever the layer, no place of the box is mapped out of the image box."""
    xyz = np.clip(xyz, BOX[0], BOX[1])
    image = image_box(layer, BOX)
    moved = xyz + layer.displacement(xyz)
    assert (moved >= image[0] - 1e-9).all()
    assert (moved <= image[1] + 1e-9).all()


def test_admissible_interval_of_a_plateau_has_the_closed_form() -> None:
    """-1 / max phi and -1 / min phi of the unit field: gaps below and above over max b'."""
    fade = BlendChain.through([4.37, 62.0], [1.0, 0.0], BLENDS["cubic"])
    walls = level_boundaries(["base", "shaft-r", "shaft+r", "T"], [0.0, 3.27, 4.73, 10.8])

    def shaft(amount: float) -> FieldLayer:
        pieces = tuple(AffinePiece.along(fade, 0.0, amount * d) for d in (0.0, 1.0, 1.0, 0.0))
        return FieldLayer("local", (StackedField("shaft", "z", walls, pieces, BLENDS["cubic"]),))

    low, high = admissible_amplitudes(shaft, BOX, least=0.0)
    assert [low, high] == pytest.approx([-3.27 / 1.5, 6.07 / 1.5])
    low, high = admissible_amplitudes(shaft, BOX)
    assert [low, high] == pytest.approx([-0.95 * 3.27 / 1.5, 0.95 * 6.07 / 1.5])
    assert certify(shaft(low), BOX).certified
    assert certify(shaft(high), BOX).certified


def test_admissible_interval_ends_where_the_layout_refuses() -> None:
    """An amplitude that cannot be laid out counts as one that folds; without a fold, infinity."""
    fade = BlendChain.through([6.0, 66.0], [1.0, 0.0])

    def anchored(rise: float) -> FieldLayer:
        anchors = [("base", 0.0, 0.0), ("shaft", 5.0 + rise, 0.0), ("T", 18.0, 0.0)]
        return FieldLayer("anchored", (hat_field("shaft", anchors, fade),))

    low, high = admissible_amplitudes(anchored, BOX)
    assert [low, high] == pytest.approx([-5.0, 13.0], abs=1e-6)
    assert admissible_amplitudes(lambda _: FieldLayer("none", ()), BOX) == (-np.inf, np.inf)


@pytest.mark.parametrize("first", [0.1, 3.0])
def test_admissible_interval_does_not_depend_on_the_first_change(first: float) -> None:
    """The usual change is a start, no more."""
    fade = BlendChain.through([6.0, 66.0], [1.0, 0.0])

    def shaft(rise: float) -> FieldLayer:
        anchors = [("base", 0.0, 0.0), ("shaft", 5.0, rise), ("T", 18.0, 0.0)]
        return FieldLayer("local", (hat_field("shaft", anchors, fade),))

    assert admissible_amplitudes(shaft, BOX, first=first) == pytest.approx(
        admissible_amplitudes(shaft, BOX), rel=1e-7
    )
