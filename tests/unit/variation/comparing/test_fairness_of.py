"""Fairness of varied nets: signs of curvature beyond a dead band, and comb integrals."""

from collections.abc import Iterator

import attrs
import numpy as np
import pytest
from scipy.integrate import quad

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import CurveData, SplineBatch
from assoc_hull.geometry.fairness.combs import (
    comb_integrals,
    curvature_sign_changes,
    sampled_curvatures,
)
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.hull import Hull
from assoc_hull.hull.sources import examples
from assoc_hull.variation.comparing.line_fairness import (
    FairnessChange,
    LineFairness,
    compare_fairness,
    measure_fairness,
)
from tests.taken_back import taken_back

UP = [0.0, 0.0, 1.0]


def wave(amplitude: float, count: int = 41) -> SplineBatch:
    """A spline through points of a sine of two periods over 40 m: curvature 0.1 at most per m."""
    x = np.linspace(0.0, 40.0, count)
    return loft(CurveData.single(np.stack([x, amplitude * np.sin(np.pi * x / 10), 0 * x], 1)))


@pytest.fixture
def hull(wigley: Hull) -> Iterator[Hull]:
    """The Wigley hull, to be edited at will."""
    with taken_back(wigley) as copy:
        yield copy


@pytest.fixture(scope="module")
def wigley() -> Hull:
    """The Wigley hull."""
    return examples.wigley()


def test_changes_of_sign_are_those_of_the_wave() -> None:
    """Two periods of a sine change the sign of curvature three times."""
    assert curvature_sign_changes(wave(0.5), UP, 2e-3).tolist() == [3]


def test_curvature_within_the_dead_band_has_no_sign() -> None:
    """A wave whose curvature is 1e-3 1/m at most counts only with a narrower band."""
    flat = wave(1e-3 * 100.0 / np.pi**2)
    assert curvature_sign_changes(flat, UP, 2e-3).tolist() == [0]
    assert curvature_sign_changes(flat, UP, 1e-4).tolist() == [3]
    assert sampled_curvatures(flat, UP).greatest()[0] == pytest.approx(1e-3, rel=0.01)


def test_curves_of_a_batch_are_counted_apart() -> None:
    """The end of one curve and the start of the next make no change of sign."""
    half = loft(CurveData.single(np.array([[0.0, 0, 0], [1, 1, 0], [2, 0, 0]])))
    turned = loft(CurveData.single(np.array([[2.0, 0, 0], [3, -1, 0], [4, 0, 0]])))
    both = SplineBatch.join([half, turned])
    assert curvature_sign_changes(both, UP, 1e-3).tolist() == [0, 0]


def test_a_curve_without_a_plane_counts_nothing() -> None:
    """A row of nan in place of a normal gives no change, no comb and no curvature."""
    normal = np.full((1, 3), np.nan)
    assert curvature_sign_changes(wave(0.5), normal, 0.0).tolist() == [0]
    assert comb_integrals(wave(0.5), normal).tolist() == [0.0]
    assert sampled_curvatures(wave(0.5), normal).greatest().tolist() == [0.0]


def test_comb_integral_of_a_parabola() -> None:
    """The integral agrees with adaptive quadrature of dk/ds of y = x^2 / 8 from 0 to 4."""
    ends = np.array([[0.0, 0, 0], [4, 2, 0]])
    leave, arrive = np.array([[1.0, 0, 0]] * 2), np.array([[1.0, 1, 0]] * 2)
    parabola = SplineBatch(np.array([0, 2]), np.array([0.0, 4]), ends, leave, arrive)

    def density(x: float) -> float:
        # k = (1/4) (1 + x^2/16)^-1.5, dk/dx = -(3/64) x (...)^-2.5, ds/dx = (...)^0.5
        return float((3 / 64 * x) ** 2 * (1 + x * x / 16) ** -5.5)

    assert comb_integrals(parabola, UP)[0] == pytest.approx(quad(density, 0, 4)[0], rel=1e-6)


def test_comb_integral_has_no_view_from_the_side() -> None:
    """A comb is that of the projection: what lies across the plane does not count."""
    data, up = wave(0.5), np.array(UP)
    lifted = SplineBatch(
        data.start, data.knot, data.xyz + up * data.knot[:, None], data.leave + up, data.arrive + up
    )
    assert comb_integrals(lifted, UP)[0] == pytest.approx(comb_integrals(data, UP)[0], rel=1e-12)


def test_a_similarity_scales_combs_by_the_cube(hull: Hull) -> None:
    """Twice the hull has an eighth of the comb integrals and as many changes of sign."""
    parent = measure_fairness(hull.document.state)
    with hull.edit("twice") as edit:
        edit.transform(scale=[2.0, 2.0, 2.0], drivers=["sections", "profile"], planes="follow")
    table = compare_fairness(parent, measure_fairness(hull.document.state, like=parent))
    ratios = [line.comb_ratio for line in table.lines if not np.isnan(line.comb_ratio)]
    assert table.added == 0
    assert ratios == pytest.approx([0.125] * len(ratios), rel=1e-9)


def test_lines_left_alone_are_not_judged(hull: Hull) -> None:
    """An unchanged hull gives a table in which no line has changed."""
    parent = measure_fairness(hull.document.state)
    table = compare_fairness(parent, measure_fairness(hull.document.state, like=parent))
    assert len(table.lines) == len(parent)
    assert table.changed == ()
    assert (table.median, table.worst, table.worst_line) == (1.0, 1.0, None)


def test_a_dent_is_seen_in_the_lines_it_crosses(hull: Hull) -> None:
    """Moving one point inward by 0.3 m adds changes of sign and multiplies the comb."""
    state = hull.document.state
    lines = [line for line in state.live("lines").tolist() if state.lines.planar[line]]
    parent = measure_fairness(state, lines)
    with hull.edit("dent") as edit:
        edit.move("WL 2.5 x ST 10", y=hull.half_breadth(50.0, 2.5) - 0.3)
    table = compare_fairness(parent, measure_fairness(state, lines, like=parent))
    assert table.added > 0
    assert table.worst > 5.0
    assert table.worst_line is not None
    assert table.worst_line.comb_ratio == table.worst


@pytest.mark.parametrize("line", [-1, 10_000])
def test_an_unknown_line_is_refused(wigley: Hull, line: int) -> None:
    """A number that no line has is an error of the family."""
    with pytest.raises(BadInputError, match="there is no line"):
        measure_fairness(wigley.document.state, [line])


@pytest.mark.parametrize("noise", [0.0, 1e-12, 1e-6])
def test_rounding_along_a_straight_line_is_no_comb(noise: float) -> None:
    """Bent by less than the tolerance, a straight line has become as sharp as it was."""
    before = LineFairness("a", "a", np.zeros((1, 3)), 0, noise * 1e-20, 0.0, 3.0)
    bent = attrs.evolve(before, comb=9e-5, greatest=4e-3)
    assert FairnessChange(before, bent).comb_ratio == 1.0
    knuckled = attrs.evolve(before, comb=1.0, greatest=0.5)
    assert 100.0 < FairnessChange(before, knuckled).comb_ratio < 1e5


def test_the_comb_of_a_line_that_shows_it_is_told_as_it_is() -> None:
    """No floor comes between two lines that have curvature to be seen."""
    before = LineFairness("a", "a", np.zeros((1, 3)), 0, 0.5, 0.2, 3.0)
    assert FairnessChange(before, attrs.evolve(before, comb=1.5)).comb_ratio == 3.0


def test_what_nobody_sees_is_less_on_a_small_ship() -> None:
    """Where 2 mm along a line are not seen on a ship of 100 m, it is .2 mm on a boat of 10 m."""
    ship = examples.wigley().document.state
    boat = attrs.evolve(ship, tolerances=ship.tolerances.scaled(0.1))
    large, small = measure_fairness(ship), measure_fairness(boat)
    for key, line in large.items():
        assert small[key].least_comb == pytest.approx(1e-2 * line.least_comb)
