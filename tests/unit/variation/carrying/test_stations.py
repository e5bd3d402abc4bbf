"""Sections whose planes a map would bend keep their place among the others."""

from __future__ import annotations

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.variation.carrying.driving_lines import section_planes, stations_along
from assoc_hull.variation.fields.bounded_functions import BlendChain
from assoc_hull.variation.fields.field import AffinePiece, Boundary, StackedField
from assoc_hull.variation.fields.layers import AdditiveLayer, FieldLayer, Layer, Rake

LONGER = StackedField(
    "length", "x", (Boundary("base", BlendChain.constant(0.0)),),
    (AffinePiece.along(BlendChain.constant(1.0), 0.02, 0.0),),
)  # fmt: skip
RAKE = Rake("rake", BlendChain.constant(1.0), 0.1, 2.0, 1.0)
X = np.array([0.0, 50.0, 100.0])


def test_stations_go_with_what_keeps_their_planes_and_not_with_what_bends_them() -> None:
    """Layer after layer, each at the places that the one before gives."""
    layers: list[Layer] = [
        FieldLayer("size", (LONGER, RAKE)),
        AdditiveLayer("shift", x=BlendChain.through([0.0, 102.0], [0.0, 1.0])),
    ]
    assert stations_along(layers, X).tolist() == [0.0, 51.5, 103.0]


def test_layers_that_move_nothing_along_the_ship_move_no_station() -> None:
    """To the bit."""
    rising = BlendChain.through([0.0, 5.0], [0.0, 1.0])
    wide = AdditiveLayer("wide", y=(BlendChain.constant(1.0), rising, BlendChain.constant(1.0)))
    assert stations_along([wide, FieldLayer("rake", (RAKE,))], X).tolist() == X.tolist()


def test_a_map_that_lengthens_the_ship_and_rakes_her_stem_keeps_the_order_of_her_sections() -> None:
    """The section through the rake is cut again where the length sends it."""
    parent = ah.examples.wigley()
    variant = parent.vary(set={"length": 103.3, "stem_rake_deg": 0.7}).hull
    before, after = parent.groups["sections"].lines, variant.groups["sections"].lines
    assert list(after) == list(before)
    old = np.array([line.curves[0].spline.xyz[0, 0] for line in before.values()])
    new = np.array([line.curves[0].spline.xyz[0, 0] for line in after.values()])
    assert new == pytest.approx(old * 1.033, abs=1e-12)
    assert variant.check() == ()


def test_every_plane_section_is_told_its_place() -> None:
    """By the number of its line; without layers at the old one."""
    state = ah.examples.wigley().state
    found = section_planes(state, ())
    assert len(found) == len(ah.examples.wigley().groups["sections"].lines)
    assert all(state.lines.offset[line] == x for line, x in found.items())
