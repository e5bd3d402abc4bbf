"""Regions in the side plan: places, order, what is dropped and refused; pieces through them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.combined_waterline import (
    WaterlineRegion,
    WaterlineRegions,
    combined_waterline,
    joined_pieces,
)
from assoc_hull.geometry.classical.pieced_curve import circle_piece
from tests.piece_values import PIECES

FLAT = [(0, 30), (5, 42), (10, 50)]
CHANGE = [(0, 58), (5, 62), (10, 66)]
END = [(0, 70), (5, 73), (10, 78)]
FORMULAS: dict[tuple[str, str], Any] = {("flat", "change"): "quintic", ("change", "end"): "conic"}
OFFSETS = [(24, 11.97), (30, 11.72), (36, 11.2), (42, 10.4), (48, 9.3), (54, 8)]


def made(**other: Any) -> WaterlineRegions:
    """The boundaries of the test values, or others."""
    lines = {"end": END, "flat": FLAT, "change": CHANGE, **other}
    return WaterlineRegions.make({k: v for k, v in lines.items() if v is not None}, FORMULAS)


def test_boundaries_are_evaluated_and_put_in_order() -> None:
    """The test values at z = 6.5, and the pieces between them."""
    places = made().places(6.5)
    assert list(places) == ["flat", "change", "end"]
    wanted = [PIECES[f"G.x{k}"] for k in range(3)]
    assert list(places.values()) == pytest.approx(wanted, rel=1e-13)
    found = made().at(6.5)
    assert [(r.after, r.before, r.formula) for r in found] == [
        ("flat", "change", "quintic"), ("change", "end", "conic"),
    ]  # fmt: skip
    assert found[0].last == found[1].first


def test_boundaries_that_coincide_drop_their_piece() -> None:
    """At the level where the change meets the end, and where it meets the flat."""
    merged = made(change=[(0, 70), (5, 62), (10, 50)])
    formulas = {**FORMULAS, ("flat", "end"): "line"}
    assert [r.formula for r in merged.at(0.0)] == ["quintic"]
    assert merged.at(0.0)[0].before == "change"
    assert [r.formula for r in merged.at(10.0)] == ["conic"]
    both = WaterlineRegions.make(
        {"flat": FLAT, "end": END}, {("flat", "end"): formulas["flat", "end"]}
    )
    assert [r.formula for r in both.at(3.0)] == ["line"]


def test_touching_boundaries_do_not_cross() -> None:
    """They may meet and part again on the same sides."""
    near = FLAT + np.array([[0.0, 1e-9], [0.0, -1e-9], [0.0, 1e-9]])
    assert [r.formula for r in made(change=near).at(5.0)] == ["conic"]
    touching = made(change=[(0, 58), (5, 42), (10, 66)])
    assert [r.formula for r in touching.at(5.0)] == ["conic"]


def test_pieces_through_regions_are_those_of_the_waterline() -> None:
    """The same quintic and conic, to the last bits; heights by the name of the boundary."""
    regions = [WaterlineRegion("flat", "change", "quintic", 20.0, 60.0)]
    regions.append(WaterlineRegion("change", "end", "conic", 60.0, 75.0))
    curve = joined_pieces(regions, {"flat": 12.0, "change": 6.5, "end": 0.0}, OFFSETS)
    peer = combined_waterline(20, 60, 75, 12, 6.5, OFFSETS)
    for mine, other in zip(curve.pieces, peer.pieces, strict=True):
        np.testing.assert_allclose(mine.coefficients, other.coefficients, rtol=1e-12, atol=1e-12)


def test_every_formula_joins_with_its_rule() -> None:
    """Line, quintic, line, circle: value and slope at each join; curvature too at a cubic conic."""
    names = ["mid", "a", "b", "c", "end"]
    x, formulas = [0.0, 10.0, 30.0, 40.0, 44.0], ["line", "quintic", "line", "circle"]
    regions = [
        WaterlineRegion(names[k], names[k + 1], formulas[k], x[k], x[k + 1])  # type: ignore[arg-type]
        for k in range(4)
    ]
    heights = dict(zip(names, [8.0, 8.0, 5.0, 3.0, 1.5], strict=True))
    curve = joined_pieces(regions, heights, [(14, 7.9), (18, 7.3), (22, 6.5), (26, 5.8), (42, 2)])
    for join in curve.joins():
        assert abs(join.gap) < 1e-12
        assert abs(join.turn) < 1e-12
    assert float(curve.at(44.0)) == pytest.approx(1.5, abs=1e-12)
    regions[2:] = [WaterlineRegion("b", "end", "cubic conic", 30.0, 40.0)]
    given = [(x, 8 - 0.0075 * (x - 10) ** 2) for x in (14, 18, 22, 26)]
    joined = joined_pieces(regions, {**heights, "end": 0.0}, given)
    last = joined.joins()[-1]
    assert abs(last.turn) < 1e-12
    assert last.after == pytest.approx(last.before, rel=1e-9)


def test_a_circle_piece_is_a_circle_in_true_lengths() -> None:
    """Every point is as far from one centre; tangent and end as asked."""
    piece = circle_piece(2.0, 5.0, 6.0, -0.2, 4.5)
    x = np.linspace(2.0, 5.0, 9)
    y = piece.at(x)
    step = np.array([1.0, -0.2]) / np.hypot(1.0, 0.2)
    chord = np.array([3.0, -1.5])
    curvature = 2.0 * (step[0] * chord[1] - step[1] * chord[0]) / (chord @ chord)
    centre = np.array([2.0, 6.0]) + np.array([-step[1], step[0]]) / curvature
    np.testing.assert_allclose(np.hypot(x - centre[0], y - centre[1]), -1.0 / curvature, rtol=1e-13)
    assert float(piece.at(2.0, 1)) == pytest.approx(-0.2, rel=1e-12)


TWO = [
    WaterlineRegion("flat", "end", "conic", 0.0, 9.0),
    WaterlineRegion("end", "far", "line", 9.0, 10.0),
]
HEIGHTS = {"flat": 5.0, "end": 0.0, "far": 0.0}
REFUSED: dict[str, tuple[str, Callable[[], object]]] = {
    "crossing": (
        "regions: boundaries flat and change cross at z=4.375",
        lambda: made(change=[(0, 58), (5, 38), (10, 66)]),
    ),
    "crossing at a point": (
        "regions: boundaries flat and change cross at z=5",
        lambda: made(change=[(0, 58), (5, 42), (10, 45)]),
    ),
    "no formula": (
        "regions: no formula for region change to flat",
        lambda: made(change=[(0, 10), (10, 10)]).at(3.0),
    ),
    "short boundary": (
        "regions: boundary change does not reach z=6.5",
        lambda: made(change=CHANGE[:2]).places(6.5),
    ),
    "one boundary": ("regions: 1 boundaries", lambda: WaterlineRegions.make({"flat": FLAT}, {})),
    "z that falls": (
        "regions: z of boundary flat does not rise at z=0",
        lambda: made(flat=[(5, 42), (0, 30)]),
    ),
    "one point": ("regions: boundary flat has 1 points", lambda: made(flat=FLAT[:1])),
    "unknown formula": (
        "regions: no formula is called 'spiral'",
        lambda: WaterlineRegions.make({"a": FLAT, "b": END}, {("a", "b"): "spiral"}),  # type: ignore[dict-item]
    ),
    "unknown boundary": (
        r"regions: no two boundaries are called \('a', 'c'\)",
        lambda: WaterlineRegions.make({"a": FLAT, "b": END}, {("a", "c"): "line"}),
    ),
    "no height": (
        "regions: no half-breadth on boundary end",
        lambda: joined_pieces(TWO[:1], {"flat": 5.0}, [(1, 5)]),
    ),
    "conic before the end": (
        "regions: the conic of flat to end is not the last",
        lambda: joined_pieces(TWO, HEIGHTS, [(1, 5)]),
    ),
    "no arc": (
        "circle: no arc bends down from slope 0 over a fall of 0",
        lambda: circle_piece(0.0, 4.0, 5.0, 0.0, 5.0),
    ),
    "arc that turns back": (
        "circle: the arc turns back before x=1", lambda: circle_piece(0.0, 1.0, 5.0, 0.0, 1.0)
    ),
    "z is no number": ("regions: non-finite", lambda: made().at(float("nan"))),
}  # fmt: skip


@pytest.mark.parametrize(("message", "call"), REFUSED.values(), ids=REFUSED)
def test_what_makes_no_regions_is_refused(message: str, call: Callable[[], object]) -> None:
    """With the names, the level and what to do."""
    with pytest.raises(GeometryError, match=message):
        call()
