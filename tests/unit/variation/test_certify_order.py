"""What a certificate promises of places, and a refusal of its witness."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.certificate.fold_check import certify
from assoc_hull.variation.fields.layers import FieldLayer
from tests.long_forms import draws
from tests.variation_strategies import BEAM, DEPTH, LENGTH, field_layers

BOX = np.array([[0.0, -0.5 * BEAM, 0.0], [LENGTH, 0.5 * BEAM, DEPTH]])
PAIRS = 50_000


def pairs(axis: int, seed: int) -> tuple[FloatArray, FloatArray]:
    """Pairs of places of the box that differ in one coordinate only, the lesser first."""
    rng = np.random.default_rng(seed)
    one = rng.uniform(BOX[0], BOX[1], (PAIRS, 3))
    other = one.copy()
    other[:, axis] = rng.uniform(BOX[0, axis], BOX[1, axis], PAIRS)
    first = np.where((one[:, axis] < other[:, axis])[:, None], one, other)
    return first, one + other - first


@settings(max_examples=draws(20))
@given(layer=field_layers(1.5))
def test_what_is_certified_keeps_places_in_order(layer: FieldLayer) -> None:
    """100,000 pairs: in x at one y and z, and in z at one x and y."""
    if not certify(layer, BOX).certified:
        return
    for axis in (0, 2):
        low, high = pairs(axis, axis)
        moved = [place[:, axis] + layer.displacement(place)[:, axis] for place in (low, high)]
        apart = high[:, axis] - low[:, axis] > 1e-9
        assert (moved[0] < moved[1])[apart].all()


@settings(max_examples=draws(20))
@given(layer=field_layers(6.0))
def test_what_folds_has_a_minor_below_nil_at_its_witness(layer: FieldLayer) -> None:
    """The Jacobian there says the same as the certificate."""
    found = certify(layer, BOX)
    if found.reason != "folds":
        return
    slope = layer.jacobian(np.array([found.witness]))[0]
    minors = {
        "X_x": slope[0, 0], "Y_y": slope[1, 1], "Z_z": slope[2, 2],
        "D": slope[0, 0] * slope[2, 2] - slope[0, 2] * slope[2, 0],
    }  # fmt: skip
    assert minors[found.minor] <= 1e-12
