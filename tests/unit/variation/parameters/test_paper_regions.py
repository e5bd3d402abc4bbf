"""The regions of the source paper's figure 1: named heights and lengths, the rest off the hull."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.errors import BadInputError, UnknownNameError
from assoc_hull.variation.parameters.compose_map import compose_map
from assoc_hull.variation.parameters.field_layout import Layout
from assoc_hull.variation.parameters.paper_regions import regions_of
from assoc_hull.variation.parameters.parent import Parent
from assoc_hull.variation.vary import moved_by_ratios
from tests.unit.variation.conftest import at

READ_OFF = {
    "Hbase": 0.0, "Hbilge": 2.4, "Hshaft": 5.0, "Htransom": 18.4, "Hdraft": 18.0, "Hmax": 27.0,
    "Hbulb": 7.0, "BX0": -5.0, "BX1": 70.0, "BX2": 55.0, "BX3": 115.0,
    "EX0": 300.0, "EX1": 255.0, "EX2": 265.5, "EX3": 205.5,
}  # fmt: skip
"""Of the carrier of the layouts' tests."""


def layout(**named: float) -> Layout:
    """The paper's form with some regions named."""
    return Layout.of({"blend": "paper", **named})


def moved(
    ship: Parent, asked: dict[str, float], places: list[list[float]], **named: float
) -> list[list[float]]:
    """By how much places move."""
    xyz = np.array(places)
    found = compose_map(ship, asked, layout(**named))(xyz) - xyz
    return [[float(each) for each in row] for row in found]


def test_what_is_not_named_is_read_off_the_hull(ship: Parent) -> None:
    """And what is named is told apart; without a name there are no regions."""
    assert regions_of(ship, layout()) is None
    found = regions_of(ship, layout(BX1=60.0))
    assert found is not None
    assert {**found.heights, **found.lengths} == pytest.approx(READ_OFF | {"BX1": 60.0})
    words = str(found)
    assert words.startswith("regions of the paper, m: BX1 60; read off the hull: Hbase 0, Hbilge")
    bare = regions_of(Parent(300, 50, 27, 18, 27, {}), layout(BX1=60.0))
    assert bare is not None
    assert [*bare.heights] == ["Hbase", "Hdraft", "Hmax"]


def test_a_change_reaches_as_far_as_its_length(ship: Parent) -> None:
    """The shaft's to BX1, half-way by the cubic half as far, full up to the boss or BX0."""
    places = [[x, 0.0, 5.0] for x in (-5.0, 6.0, 33.0, 60.0, 90.0)]
    lift = [row[2] for row in moved(ship, {"shaft_height": 6.0}, places, BX1=60.0)]
    assert lift == pytest.approx([1.0, 1.0, 0.5, 0.0, 0.0], abs=1e-12)
    lift = [row[2] for row in moved(ship, {"shaft_height": 6.0}, places, BX0=33.0, BX1=90.0)]
    assert lift[:3] == pytest.approx([1.0] * 3, abs=1e-12)
    ends = [[x, 0.0, 7.0] for x in (255.0, 277.5, 300.0, 306.0)]
    lift = [row[2] for row in moved(ship, {"bulb_height": 7.4}, ends, EX1=255.0)]
    assert lift == pytest.approx([0.0, 0.2, 0.4, 0.4], abs=1e-12)


@pytest.mark.parametrize(
    ("asked", "x", "rest"),
    [
        ({"shaft_height": 6.0}, 6.0, ("Hbase", "Hbilge", "Htransom", "Hdraft", "Hmax")),
        ({"bossing_radius": 0.9}, 6.0, ("Hbase", "Hbilge", "Htransom", "Hdraft", "Hmax")),
        ({"transom_height": 19.0}, -5.0, ("Hbase", "Hbilge", "Hshaft", "Hmax")),
        ({"bulb_height": 7.4}, 300.0, ("Hbase", "Hdraft", "Hmax")),
    ],
)  # fmt: skip
def test_ratios_are_one_at_every_other_height(
    ship: Parent, asked: dict[str, float], x: float, rest: tuple[str, ...]
) -> None:
    """Those of the hull, or those that are named: places on the boundaries keep their bits."""
    heights = READ_OFF | {"Hbilge": 3.5}
    places = [[x, 0.0, heights[name]] for name in rest]
    assert moved(ship, asked, places, Hbilge=3.5) == [[0.0, 0.0, 0.0]] * len(rest)


def test_the_bilge_fades_between_its_lengths(ship: Parent) -> None:
    """From BX3 to BX2 aft, from EX3 to EX2 forward."""
    x = [50.0, 82.5, 115.0, 160.0, 205.5, 237.75, 270.0]
    places = [[each, 24.0, 0.1] for each in x]
    named = {"BX2": 50.0, "EX2": 270.0}
    size = np.array(moved(ship, {"bilge_radius": 3.0}, places, **named))[:, 1]
    assert size / size[3] == pytest.approx([0.0, 0.5, 1.0, 1.0, 1.0, 0.5, 0.0], abs=1e-12)


@pytest.mark.parametrize(
    ("named", "says"),
    [
        ({"BX1": -7.0}, r"BX0 of -5 m is not aft of BX1 of -7 m \(BX0 as read off the hull\)"),
        ({"BX2": 120.0}, r"BX2 of 120 m is not aft of BX3 of 115 m \(BX3 as read"),
        ({"Hbilge": 6.0}, r"Hbilge of 6 m is not below Hshaft of 5 m .*give Hbilge below 5 m"),
        ({"Hmax": 10.0}, r"Hdraft of 18 m .* is not below Hmax|Htransom of 18.4 m is not below"),
        ({"Hbase": 3.0, "Hbilge": 2.0}, "Hbase of 3 m is not below Hbilge of 2 m, in vary"),
        ({"Hbilge": 4.5}, r"Hbilge of 4.5 m lies within what moves, 4.275 to 5.725 m"),
        ({"Hshaft": 6.0}, r"Hshaft of 6 m lies beyond the bossing, 4.275 to 5.725 m"),
        ({"BX0": 3.0, "BX1": 5.0}, "BX1 of 5 m leaves no length to fade over: .* up to 6 m"),
    ],
)
def test_what_is_out_of_order_is_refused_by_name(
    ship: Parent, named: dict[str, float], says: str
) -> None:
    """With both values, and whether one was read off the hull."""
    with pytest.raises(BadInputError, match=says):
        compose_map(ship, {"shaft_height": 5.4}, layout(**named))


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"BX1": 60.0}, "BX1 is a region of the paper, and the blend is 'quintic'"),
        ({"blend": "cubic", "Hmax": 20.0}, "give blend='paper' as well, or leave Hmax out"),
        ({"blend": "paper", "BX1": "far"}, "BX1 is 'far'"),
        ({"blend": "paper", "BX1": float("nan")}, "BX1 is nan"),
    ],
)
def test_regions_are_numbers_and_of_the_paper(given: dict[str, Any], says: str) -> None:
    """Names that there are none of get the nearest."""
    with pytest.raises(BadInputError, match=says):
        Layout.of(given)
    with pytest.raises(UnknownNameError, match="BX9"):
        Layout.of({"blend": "paper", "BX9": 1.0})


def test_a_small_radius_moves_what_lies_round_it(ship: Parent) -> None:
    """By its ratio: 1.379 of .725 m is .379 of any half-breadth beside it; others tell nothing."""
    xyz = np.array([at(6, 0.725, 5), at(6, 4.0, 5), at(60, 4, 5)])
    asked = {"bossing_radius": 1.0}
    (told,) = moved_by_ratios(ship, xyz, asked, layout())
    assert told == (
        "bossing_radius asks for 0.275 m, a ratio of 1.379, which moves what lies round it by up "
        "to 1.517 m, at (6.000, 4.000, 5.000) m"
    )
    assert moved_by_ratios(ship, xyz, asked, Layout()) == ()
    assert moved_by_ratios(ship, xyz[:1], asked, layout()) == ()


def test_a_report_tells_the_regions_and_the_script_repeats_them(bulk_carrier: ah.Hull) -> None:
    """What was used, given or not; met to 1e-6 and sound."""
    asked = {"transom_height": 18.7}
    varied = bulk_carrier.vary(set=asked, layout={"blend": "paper", "BX1": 80.0})
    assert varied.report.notes[0].startswith("regions of the paper, m: BX1 80; read off the hull:")
    assert varied.hull.measure()["transom_height"] == pytest.approx(18.7, abs=1e-6)
    assert not varied.hull.check()
    assert varied.report.script is not None
    assert varied.report.script["layout"] == {"blend": "paper", "BX1": 80.0}
    again = bulk_carrier.vary_by(varied.report.script)
    assert again.hull.fingerprint == varied.hull.fingerprint
