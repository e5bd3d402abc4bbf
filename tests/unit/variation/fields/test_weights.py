"""Unit displacements kept for many variants."""

import numpy as np
import pytest

from assoc_hull.errors import BadInputError
from assoc_hull.variation.fields.anchor_fields import hat_field
from assoc_hull.variation.fields.batch_displacements import FieldPlan
from assoc_hull.variation.fields.bounded_functions import QUINTIC, BlendChain
from assoc_hull.variation.fields.field import AffinePiece, StackedField, level_boundaries
from assoc_hull.variation.fields.layers import AdditiveLayer, FieldLayer, Layer, Rake
from assoc_hull.variation.fields.space_map import VariationMap

AFT, FORE = BlendChain.through([6, 66], [1, 0]), BlendChain.through([200, 250], [0, 1])
SHAFT = FieldLayer(
    "shaft", (hat_field("shaft", [("base", 0, 0), ("shaft", 5, 1), ("T", 18, 0)], AFT),)
)
TRANSOM = FieldLayer(
    "transom",
    (
        StackedField("transom", "y", level_boundaries(["low", "T"], [9, 18]),
              (AffinePiece.along(AFT, 0.0, 0.0), AffinePiece.along(AFT, 0.05, 0.0)), QUINTIC),
        hat_field("transom z", [("low", 3, 0), ("transom", 15, 0.6)], AFT),
    ),
)  # fmt: skip
STEM = FieldLayer("stem", (Rake("stem", FORE, 0.1, 14.0, 4.0),))
UNITS: tuple[Layer, ...] = (SHAFT, TRANSOM, STEM)
XYZ = np.random.default_rng(5).uniform([0, 0, 0], [260, 22, 25], (4000, 3))


def test_a_variant_is_what_the_map_gives() -> None:
    """At amplitudes 1 and 0 to the last bit; at others to rounding, all fields scaled."""
    for k, unit in enumerate(UNITS):
        plan = FieldPlan.of(UNITS, XYZ)
        assert plan.places(np.eye(3)[k]).tobytes() == VariationMap((unit,))(XYZ).tobytes()
    size = [0.7, -0.4, 1.3]
    scaled = tuple(
        field.scaled(part)
        for part, unit in zip(size, (SHAFT, TRANSOM, STEM), strict=True)
        for field in unit.fields
    )
    expected = VariationMap((FieldLayer("all", scaled),))(XYZ)
    assert np.abs(plan.places(size) - expected).max() < 1e-13


def test_what_does_not_move_keeps_its_bits() -> None:
    """Only listed places change, each in its listed coordinate."""
    plan = FieldPlan.of(UNITS, XYZ)
    found = plan.places([1.0, 1.0, 1.0])
    changed = found != XYZ
    listed = np.zeros(XYZ.shape, bool)
    for each in plan.moving:
        listed[each.rows, each.axis] = True
        assert 0 < len(each.rows) < len(XYZ)
    assert [each.axis for each in plan.moving] == [0, 1, 2]
    assert not (changed & ~listed).any()


def test_a_batch_is_variant_by_variant() -> None:
    """To rounding, whatever the other variants are, in new memory or in that of an earlier one."""
    plan = FieldPlan.of(UNITS, XYZ)
    amplitudes = np.random.default_rng(6).uniform(-1, 1, (70, 3))
    batch = plan.batch(amplitudes)
    for i, one in enumerate(amplitudes):
        for alone, values in zip(plan.moved(one), batch, strict=True):
            assert np.abs(values[i] - alone).max() < 1e-13
    again = plan.batch(amplitudes[::-1], out=batch)
    assert all(one is other for one, other in zip(again, batch, strict=True))
    assert np.abs(again[0][0] - plan.moved(amplitudes[-1])[0]).max() < 1e-13


def test_memory_of_another_shape_is_refused() -> None:
    """Nothing is written then."""
    plan = FieldPlan.of([SHAFT], XYZ)
    with pytest.raises(BadInputError, match="memory of shapes"):
        plan.batch([[1.0], [2.0]], out=plan.batch([[1.0]]))


def test_additive_functions_are_planned_alike() -> None:
    """Any layer can be a unit."""
    hump = AdditiveLayer(
        "hump", z=(AFT, BlendChain.constant(1.0), BlendChain.through([0, 5, 18], [0, 1, 0]))
    )
    plan = FieldPlan.of([hump], XYZ)
    assert plan.places([1.0]).tobytes() == VariationMap((hump,))(XYZ).tobytes()


def test_a_plan_that_moves_nothing() -> None:
    """Places outside all regions give a plan without moves."""
    plan = FieldPlan.of([SHAFT], XYZ + np.array([500.0, 0.0, 0.0]))
    assert plan.moving == ()
    assert plan.batch([[1.0], [2.0]]) == ()
    assert plan.places([3.0]).tobytes() == plan.xyz.tobytes()


@pytest.mark.parametrize("given", [[1.0, 2.0], [1.0, 2.0, np.nan], ["one", 2.0, 3.0]])
def test_amplitudes_are_checked(given: list[float]) -> None:
    """Too few, such as are not finite, and such as are no numbers, are refused."""
    plan = FieldPlan.of(UNITS, XYZ[:10])
    with pytest.raises(BadInputError):
        plan.places(given)
    with pytest.raises(BadInputError):
        plan.batch([given])


def test_a_plan_needs_a_layer() -> None:
    """None is refused."""
    with pytest.raises(BadInputError, match="no layer"):
        FieldPlan.of([], XYZ)
