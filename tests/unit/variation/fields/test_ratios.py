"""The source paper's own form: ratio curves through the anchors."""

from __future__ import annotations

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.errors import BadInputError
from assoc_hull.variation.fields.anchor_fields import ratio_field
from assoc_hull.variation.fields.bounded_functions import CUBIC, QUINTIC, Blend, BlendChain
from assoc_hull.variation.parameters.compose_map import compose_map
from assoc_hull.variation.parameters.field_layout import Layout
from assoc_hull.variation.parameters.parent import parent_of

ONE = BlendChain.constant(1.0)


@pytest.mark.parametrize(("blend", "low", "high"), [
    (CUBIC, 6.69627076134, 13.29134770594), (QUINTIC, 6.702781039, 13.28013288496),
])  # fmt: skip
def test_shaft_and_bossing_add_to_the_stack_of_the_paper(
    blend: Blend, low: float, high: float
) -> None:
    """Raised by 1 m and widened from .725 to 1 m: the printed heights of two places."""
    shaft = [("base", 0.0, 0.0), ("h-r", 4.275, 1.0), ("h", 5.0, 1.0), ("h+r", 5.725, 1.0),
             ("T", 18.0, 0.0)]  # fmt: skip
    boss = [("base", 0.0, 0.0), ("h-r", 4.275, -0.275), ("h", 5.0, 0.0), ("h+r", 5.725, 0.275),
            ("T", 18.0, 0.0)]  # fmt: skip
    xyz = np.array([[0.0, 0.5, 5.5], [0.0, 3.0, 12.0]])
    moved = xyz[:, 2].copy()
    for name, anchors in (("shaft", shaft), ("boss", boss)):
        moved += ratio_field(name, anchors, ONE, blend=blend).displacement(xyz)
    assert moved == pytest.approx([low, high], abs=5e-10)


def test_an_anchor_at_the_base_has_no_ratio() -> None:
    """One that stays there needs none; one that is to move is refused by name."""
    ratio_field("bulb", [("base", 0.0, 0.0), ("tip", 5.0, 1.0)], ONE)
    says = r"'bulb' cannot use a ratio: anchor 'base' at 0\.000 m"
    with pytest.raises(BadInputError, match=says):
        ratio_field("bulb", [("base", 0.0, 0.5), ("tip", 5.0, 1.0)], ONE)


def test_the_form_is_chosen_by_the_layout(bulk_carrier: ah.Hull) -> None:
    """Same anchor, same change; between anchors the ratio's field differs from the hat's."""
    parent = parent_of(bulk_carrier.state)
    hat, paper = (
        compose_map(parent, {"bulb_height": 7.4}, Layout.of({"blend": blend}))
        for blend in ("cubic", "paper")
    )
    tip = parent.places["bulb tip"][None, :]
    assert [float(each(tip)[0, 2]) for each in (hat, paper)] == pytest.approx([7.4] * 2, abs=1e-12)
    place = np.array([[302.0, 1.0, 10.0]])
    assert abs(float((hat(place) - paper(place))[0, 2])) > 0.01
    assert Layout.of({"blend": "paper"}).curve is CUBIC


@pytest.mark.parametrize(
    ("name", "place"), [("shaft_height", "boss"), ("bossing_radius", "boss top")]
)
def test_the_stern_has_the_stack_of_the_paper(bulk_carrier: ah.Hull, name: str, place: str) -> None:
    """A shaft is met at its centre, a radius at the top of the circle."""
    parent = parent_of(bulk_carrier.state)
    asked, height = {"shaft_height": (5.5, 5.5), "bossing_radius": (0.8, 5.8)}[name]
    vmap = compose_map(parent, {name: asked}, Layout.of({"blend": "paper"}))
    assert float(vmap(parent.places[place][None, :])[0, 2]) == pytest.approx(height, abs=1e-6)
