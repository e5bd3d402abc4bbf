"""The fold check of layers of fields: printed values, closed forms, what it must not miss."""

from __future__ import annotations

import numpy as np
import pytest

from assoc_hull.errors import BadInputError, FoldError
from assoc_hull.variation.certificate.fold_check import certify
from assoc_hull.variation.fields.bounded_functions import BLENDS, Blend, BlendChain
from assoc_hull.variation.fields.field import (
    AffinePiece,
    Boundary,
    StackedField,
    Tube,
    level_boundaries,
)
from assoc_hull.variation.fields.layers import FieldLayer

BOX = np.array([[-5.0, -16.0, -1.0], [230.0, 16.0, 20.0]])


def shaft(amount: float, blend: Blend) -> FieldLayer:
    """Field S of the printed values: a plateau around the shaft, nil at base and T."""
    fade = BlendChain.through([4.37, 62.0], [1.0, 0.0], blend)
    walls = level_boundaries(["base", "shaft-r", "shaft+r", "T"], [0.0, 3.27, 4.73, 10.8])
    pieces = tuple(AffinePiece.along(fade, 0.0, amount * d) for d in (0.0, 1.0, 1.0, 0.0))
    return FieldLayer("local", (StackedField("shaft_height", "z", walls, pieces, blend),))


@pytest.mark.parametrize(
    ("blend", "amount", "reason", "least"),
    [
        ("cubic", 1.0, "certified", 0.7528830313),
        ("cubic", 3.2, "certified", 0.2092257002),
        ("cubic", 4.2, "folds", -0.0378912685),
        ("quintic", 1.0, "certified", 0.6911037891),
        ("quintic", 3.2, "thin", 0.0115321252),
        ("quintic", 4.2, "folds", -0.2973640857),
    ],
)
def test_least_minor_of_a_plateau_has_its_printed_digits(
    blend: str, amount: float, reason: str, least: float
) -> None:
    """The least Z_z of a shift between four boundaries is found to 1e-9, in few boxes."""
    found = certify(shaft(amount, BLENDS[blend]), BOX)
    assert (found.reason, found.minor) == (reason, "Z_z")
    assert found.least == pytest.approx(least, abs=1e-9)
    assert found.bound == pytest.approx(least, abs=1e-9)
    assert found.splits <= 45


@pytest.mark.parametrize(("blend", "least"), [("cubic", 0.7203869730), ("quintic", 0.6598594214)])
def test_least_minor_of_the_papers_stacks_has_its_printed_digits(blend: str, least: float) -> None:
    """Ratios of z and y about the base, constant along the ship."""
    curve, none = BLENDS[blend], BlendChain.constant(0.0)

    def ratios(axis: str, z: list[float], values: list[float]) -> StackedField:
        pieces = tuple(AffinePiece(BlendChain.constant(value - 1.0), 0.0, none) for value in values)
        names = [f"h{k}" for k in range(len(z))]
        return StackedField(
            axis, "z" if axis == "z" else "y", level_boundaries(names, z), pieces, curve
        )

    heights = ratios("z", [0, 4.275, 5, 5.725, 18], [1, 5 / 4.275, 6 / 5, 7 / 5.725, 1])
    breadths = ratios("y", [2.825, 5, 7.175], [1, 1 / 0.725, 1])
    found = certify(FieldLayer("paper", (heights, breadths)), BOX)
    assert (found.certified, found.minor) == (True, "Z_z")
    assert found.least == pytest.approx(least, abs=1e-9)


def step(amount: float, gap: float, blend: Blend) -> FieldLayer:
    """A shift of z from nil to an amount over a gap."""
    pieces = tuple(
        AffinePiece(BlendChain.constant(0.0), 0.0, BlendChain.constant(d)) for d in (0.0, amount)
    )
    return FieldLayer(
        "step",
        (StackedField("step", "z", level_boundaries(["a", "b"], [3, 3 + gap]), pieces, blend),),
    )


@pytest.mark.parametrize("blend", BLENDS.values(), ids=list(BLENDS))
@pytest.mark.parametrize("gap", [0.1, 2.0, 7.5])
def test_step_folds_where_the_closed_form_says(blend: Blend, gap: float) -> None:
    """A shift by D over a gap g folds from D = -g / max b' on; its least minor is linear in D."""
    for part in (0.2, 0.9, 0.94):
        found = certify(step(-part * gap / blend.steepest, gap, blend), BOX)
        assert found.certified
        assert found.least == pytest.approx(1.0 - part, abs=1e-9)
    assert certify(step(-0.96 * gap / blend.steepest, gap, blend), BOX).reason == "thin"
    assert certify(step(-1.001 * gap / blend.steepest, gap, blend), BOX).reason == "folds"
    assert certify(step(5.0 * gap, gap, blend), BOX).certified


def test_bossing_of_the_story_is_certified_by_its_tube() -> None:
    """Y_y is least where psi falls most steeply: .588."""
    r, h = 0.725, 5.0
    ratio = 1.0 / r - 1.0
    walls = level_boundaries(["base", "h-r", "h+r", "T"], [0.0, h - r, h + r, 18.0])
    near, far = BlendChain.through([6, 30], [1, 0]), BlendChain.through([6, 66], [1, 0])
    none = AffinePiece.along(near, 0.0, 0.0)
    tall = AffinePiece(near.scaled(ratio), h, far)
    broad = AffinePiece.along(near, ratio, 0.0)
    up = StackedField("shaft", "z", walls, (none, tall, tall, none))
    out = StackedField("bossing", "y", walls, (none, broad, broad, none), tube=Tube(r))
    found = certify(FieldLayer("boss", (up, out)), [[6, -16, 0], [66, 16, 18]])
    assert found.certified
    assert dict(found.minors)["Y_y"] == pytest.approx(0.588, abs=5e-4)


def crossed(size: float) -> FieldLayer:
    """Heights shift lengths and lengths shift heights: X_x = Z_z = 1 everywhere."""
    none = BlendChain.constant(0.0)
    along = StackedField(
        "along", "x", level_boundaries(["a", "b"], [4.0, 6.0]),
        (AffinePiece(none, 0.0, none), AffinePiece(none, 0.0, BlendChain.constant(4.0 * size))),
    )  # fmt: skip
    up = StackedField(
        "up", "z", level_boundaries(["a"], [0.0]),
        (AffinePiece(none, 0.0, BlendChain.through([100.0, 110.0], [0.0, 3.0])),),
    )  # fmt: skip
    return FieldLayer("crossed", (along, up))


def test_determinant_alone_can_fold() -> None:
    """Both diagonal minors are 1, yet the map folds once their products outweigh them."""
    most = (1.875 * 4.0 / 2.0) * (1.875 * 3.0 / 10.0)
    found = certify(crossed(0.9 / most), BOX)
    assert (found.certified, found.minor) == (True, "D")
    assert found.least == pytest.approx(0.1, abs=1e-8)
    folded = certify(crossed(1.1 / most), BOX)
    assert (folded.reason, folded.minor) == ("folds", "D")
    x, _, z = folded.witness
    assert [x, z] == pytest.approx([105.0, 5.0], abs=1e-3)


@pytest.mark.parametrize("axis", ["x", "z"])
@pytest.mark.parametrize("places", [(1.0, -1.0), (25.0, 30.0)])
def test_one_sloping_boundary_is_checked_on_both_sides(
    axis: str, places: tuple[float, float]
) -> None:
    """A piece acts below and above its only boundary; a fold counts wherever that lies."""
    wall = Boundary("counter", BlendChain.through([0.0, 200.0], places))
    fall = BlendChain.through([100.0, 110.0], [0.0, -20.0])
    shift = AffinePiece(BlendChain.constant(0.0), 0.0, fall)
    ratio = AffinePiece(BlendChain.constant(-1.2), 0.0, BlendChain.constant(0.0))
    field = StackedField(
        "field", "x" if axis == "x" else "z", (wall,), (shift if axis == "x" else ratio,)
    )
    assert certify(FieldLayer("one", (field,)), BOX).reason == "folds"


def test_refusal_says_where_and_between_what() -> None:
    """The error names field, boundary curves with heights, the nearest node and the minor."""
    with pytest.raises(FoldError) as caught:
        certify(shaft(4.2, BLENDS["cubic"]), BOX).check()
    text = str(caught.value)
    assert "'shaft_height' folds at x=4.370 z=7.765 (heights come out -0.038 times as far" in text
    assert "between 'shaft+r' (4.730) and 'T' (10.800), node x=4.370" in text
    assert caught.value.least == pytest.approx(-0.0378912685, abs=1e-9)


@pytest.mark.parametrize("first", [0, 1])
def test_the_field_that_shrinks_space_most_is_named(first: int) -> None:
    """Of several that act at the witness, in whatever order they stand."""
    shifts = [AffinePiece.along(BlendChain.constant(1.0), 0.0, d) for d in (0.0, -0.5, 0.0)]
    weak = StackedField(
        "weak", "z", level_boundaries(["low", "middle", "high"], [0.0, 8.0, 16.0]), tuple(shifts)
    )
    strong = shaft(4.2, BLENDS["cubic"]).fields[0]
    fields = (weak, strong) if first == 0 else (strong, weak)
    found = certify(FieldLayer("local", fields), BOX)
    assert not found.certified
    assert found.field == "shaft_height"


def test_identity_is_certified_with_minors_of_one() -> None:
    """Nothing that acts, nothing that folds."""
    found = certify(shaft(0.0, BLENDS["cubic"]), BOX)
    assert (found.certified, found.least) == (True, 1.0)
    assert certify(FieldLayer("none", ()), BOX).certified


def test_field_that_moves_nothing_in_the_box_costs_nothing() -> None:
    """Beside fields that are nil, or act beyond the box, a field is checked as if alone."""
    walls = (
        Boundary("low", BlendChain.through([0.0, 200.0], [2.0, 4.0])),
        Boundary("high", BlendChain.through([50.0, 150.0], [9.0, 8.0])),
    )
    none = AffinePiece(BlendChain.constant(0.0), 0.0, BlendChain.constant(0.0))
    lift = AffinePiece(BlendChain.constant(0.0), 0.0, BlendChain.through([60.0, 90.0], [0.0, -3.0]))
    far = AffinePiece(BlendChain.constant(0.0), 0.0, BlendChain.through([240.0, 260.0], [0.0, 3.0]))
    one = StackedField("lift", "z", walls, (none, lift))
    idle = (
        StackedField("idle", "z", walls, (none, none)),
        StackedField("far", "z", walls, (none, far)),
    )
    alone, beside = (certify(FieldLayer("local", each), BOX) for each in ((one,), (one, *idle)))
    assert beside == alone


def test_box_without_extent_is_refused() -> None:
    """The corners must come in order."""
    with pytest.raises(BadInputError, match="extent"):
        certify(shaft(1.0, BLENDS["cubic"]), BOX[::-1])
