"""Pictures of stability: curves go through the numbers, words are apart."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.patches import Polygon
from numpy.testing import assert_allclose

from assoc_hull.analysis.stability.condition import ConditionRequest
from assoc_hull.analysis.stability.cross_curves import CrossCurves, cross_curves_of
from assoc_hull.analysis.stability.flooding import FloodingPoint
from assoc_hull.analysis.stability.stability_report import Stability, stability_of
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.plot.diagrams.stability import (
    _AREAS,
    cross_curve_picture,
    lever_picture,
    plot_stability,
)
from assoc_hull.plot.sheet.paper import PAPERS
from tests.floating_bodies import box_body, head

Lines = Callable[[Figure, str], list[FloatArray]]
Boxes = Callable[[Figure], dict[str, FloatArray]]

HEELS = np.arange(0.0, 91.0, 10.0)


def box(kg: float, *, closed: bool = True, tcg: float = 0.0, draught: float = 6.0) -> Stability:
    """The box with an opening."""
    header = head(100.0, 20.0, 6.0, kg=kg, deck="closed" if closed else "open", ship="Box")
    point = FloodingPoint("hatch", (50.0, 8.0, 10.0))
    asked = ConditionRequest(draught=draught, kg=kg, tcg=tcg)
    return stability_of(box_body(closed), header, asked, "fixed", HEELS, [point])


@pytest.fixture(scope="module")
def ships() -> dict[str, Stability]:
    """One that passes, one that lolls, one with a list, one that capsizes, one with open deck."""
    return {
        "passes": box(5.0),
        "lolls": box(8.8),
        "lists": box(6.0, tcg=0.4),
        "capsizes": box(20.0),
        "open": box(5.0, closed=False, draught=8.0),
    }


@pytest.fixture(scope="module")
def curves() -> CrossCurves:
    """The box at five draughts."""
    asked = [ConditionRequest(draughts=(t, t)) for t in (2.0, 4.0, 6.0, 8.0, 10.0)]
    return cross_curves_of(box_body(), head(100.0, 20.0, 6.0), asked, "fixed", HEELS[1:])


def test_levers_and_arms_are_drawn_where_they_are(
    ships: dict[str, Stability], lines_of: Lines
) -> None:
    """Dots are the heels that were asked; both curves are to scale from the same nought."""
    found = ships["passes"]
    figure = lever_picture(found)
    (dots,), (nought,) = lines_of(figure, "heels$"), lines_of(figure, "nought$")
    (low,), (high,) = (lines_of(figure, f"upright/{heel}$") for heel in (0, 90))
    assert_allclose(dots[:, 0], low[0, 0] + (high[0, 0] - low[0, 0]) * HEELS / 90.0, atol=1e-9)
    unit = (dots[3, 1] - nought[0, 1]) / found.gz[3]
    assert_allclose(dots[:, 1], nought[0, 1] + unit * found.gz, atol=1e-9)
    (arm,) = lines_of(figure, "curve/arm$")
    at = np.interp(dots[:, 0], arm[:, 0], arm[:, 1]) - nought[0, 1]
    assert_allclose(at / at[3], found.columns["arm"] / found.columns["arm"][3], atol=1e-6)


def test_areas_are_tinted_to_where_water_comes_in(
    ships: dict[str, Stability], lines_of: Lines
) -> None:
    """The hatch goes under before 30 degrees: what lies beyond does not count, and is bare."""
    found = ships["passes"]
    assert (found.angles.flooding or 90.0) < 30.0
    figure = lever_picture(found)
    (mark,) = lines_of(figure, "mark/down-flooding$")
    tints = [to_hex(each).upper() for each in _AREAS]
    tinted = [
        np.asarray(each.get_xy())[:, 0].max()
        for each in figure.findobj(Polygon)
        if to_hex(each.get_facecolor()).upper() in tints
    ]
    assert tinted == pytest.approx([mark[0, 0]], abs=1e-6)


def test_the_tangent_reaches_gm_at_one_radian(ships: dict[str, Stability], lines_of: Lines) -> None:
    """Or ends at the border of the field, with the slope GM."""
    found = ships["passes"]
    figure = lever_picture(found)
    (line,), (curve,) = lines_of(figure, "tangent$"), lines_of(figure, "curve/gz$")
    slope = (line[1, 1] - line[0, 1]) / (line[1, 0] - line[0, 0])
    start = (curve[1, 1] - curve[0, 1]) / (curve[1, 0] - curve[0, 0])
    assert slope == pytest.approx(start, rel=1e-3)


@pytest.mark.parametrize("paper", PAPERS)
@pytest.mark.parametrize("name", ["passes", "lolls", "lists", "capsizes", "open"])
def test_words_are_apart_and_within_the_frame(
    ships: dict[str, Stability], name: str, paper: str, boxes_of: Boxes
) -> None:
    """Whatever becomes of the ship."""
    check(lever_picture(ships[name], paper=paper), paper, boxes_of)  # type: ignore[arg-type]


@pytest.mark.parametrize("paper", PAPERS)
def test_words_of_cross_curves_are_apart(curves: CrossCurves, paper: str, boxes_of: Boxes) -> None:
    """Though curves of large heels cross."""
    check(cross_curve_picture(curves, paper=paper), paper, boxes_of)  # type: ignore[arg-type]


def check(figure: Figure, paper: str, boxes_of: Boxes) -> None:
    """Compare the boxes of all words."""
    found = boxes_of(figure)
    boxes, names = np.array(list(found.values())), list(found)
    for i, each in enumerate(boxes):
        apart = (boxes[:, :2] >= each[2:] - 1e-6).any(axis=1)
        apart |= (boxes[:, 2:] <= each[:2] + 1e-6).any(axis=1)
        assert [names[k] for k in np.flatnonzero(~apart).tolist() if k != i] == [], names[i]
    size = PAPERS[paper]
    assert (boxes[:, :2] > 8.0 * size.factor).all()
    assert (boxes[:, 2:] < np.array([size.width, size.height]) - 8.0 * size.factor).all()


def test_cross_curves_pass_through_the_table(curves: CrossCurves, lines_of: Lines) -> None:
    """KN upward, displacement to the right."""
    figure = cross_curve_picture(curves)
    (curve,) = lines_of(figure, "curve/30$")
    (low,), (high,) = (lines_of(figure, f"level/{kn}$") for kn in (0, 6))
    share = (curves.displacement - curves.displacement[0]) / np.ptp(curves.displacement)
    x = curve[0, 0] + share * (curve[-1, 0] - curve[0, 0])
    y = low[0, 1] + (high[0, 1] - low[0, 1]) * curves.kn[:, 2] / 6.0
    assert_allclose(np.interp(x, curve[:, 0], curve[:, 1]), y, atol=0.01)


def test_one_displacement_makes_no_curve() -> None:
    """The error says how many are needed."""
    header, asked = head(100.0, 20.0, 6.0), [ConditionRequest(draughts=(6.0, 6.0))]
    single = cross_curves_of(box_body(), header, asked, "fixed", HEELS[1:3])
    with pytest.raises(BadInputError, match="two or more"):
        cross_curve_picture(single)


def test_the_same_result_gives_the_same_bytes(
    ships: dict[str, Stability], curves: CrossCurves, tmp_path: Path
) -> None:
    """No dates but the one that is given, no chance."""
    for found in (ships["passes"], curves):
        for name in ("a.svg", "b.svg"):
            plot_stability(found, tmp_path / name)
        assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()


def test_the_levers_of_a_ship_with_a_list_are_drawn_from_upright(lines_of: Lines) -> None:
    """They begin far below nought on the side to which she does not lie, and are not cut there."""
    listing = box(4.5, tcg=2.0)
    (levers,) = lines_of(lever_picture(listing), "curve/gz$")
    assert np.isfinite(levers).all()


def test_levers_are_drawn_as_far_as_the_table_goes(
    ships: dict[str, Stability], lines_of: Lines
) -> None:
    """Of a ship that capsizes too: the curve is not cut where it falls far below nought."""
    for found in ships.values():
        (levers,) = lines_of(lever_picture(found), "curve/gz$")
        assert np.isfinite(levers).all()
