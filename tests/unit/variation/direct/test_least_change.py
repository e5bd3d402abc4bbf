"""Direct manipulation of B-splines with the least change of their control points."""

import numpy as np
import pytest
from scipy.interpolate import BSpline

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.direct.least_change import (
    Basis,
    CurveTarget,
    SurfaceTarget,
    least_change,
    pull_curve,
    pull_surface,
)

KNOTS = [0, 0, 0, 0, 1, 2, 3, 4, 4, 4, 4]
POINTS = np.array([(0, 0), (1, 2), (2.5, 3), (4, 3), (5.5, 2), (6.5, 1), (7, 0)], np.float64)
D = (0.1, 0.4)
PRINTED = 0.6e-12
"""Half a unit of the last printed digit, and what rounding adds."""

BASIS = Basis.on(KNOTS)
PULL = CurveTarget(1.7, D)


def places(points: FloatArray, u: list[float], order: int = 0) -> FloatArray:
    """Places of the curve, by scipy."""
    return np.asarray(BSpline(np.array(KNOTS, float), points, 3)(u, order))


def test_the_curve_of_the_example() -> None:
    """Q(1.7) of the printed example."""
    assert (BASIS.rows([1.7]) @ POINTS)[0] == pytest.approx([3.546625, 2.9360833333], abs=6e-11)


def test_one_target_moves_four_points() -> None:
    """The printed changes of points 1 to 4; the others stay; the place moves by d."""
    change = pull_curve(BASIS, [PULL])
    assert change[1:5] == pytest.approx(
        np.array(
            [
                (0.001432304134, 0.005729216538),
                (0.073401166196, 0.293604664785),
                (0.125229356541, 0.500917426164),
                (0.012130378225, 0.048521512899),
            ]
        ),
        abs=PRINTED,
    )
    assert change[[0, 5, 6]].tolist() == [[0.0, 0.0]] * 3
    moved = places(POINTS + change, [1.7]) - places(POINTS, [1.7])
    assert moved[0] == pytest.approx(D, abs=1e-15)


def test_pins_hold() -> None:
    """With both ends and u = 2.6 pinned, the printed changes of points 2 and 4."""
    pins = [CurveTarget(u, (0.0, 0.0)) for u in (0.0, 2.6, 4.0)]
    change = pull_curve(BASIS, [PULL, *pins])
    assert change[2] == pytest.approx((0.113926227022, 0.455704908087), abs=PRINTED)
    assert change[4] == pytest.approx((-0.089837001133, -0.359348004531), abs=PRINTED)
    moved = places(POINTS + change, [1.7, 0.0, 2.6, 4.0]) - places(POINTS, [1.7, 0.0, 2.6, 4.0])
    assert moved == pytest.approx(np.array([D, (0, 0), (0, 0), (0, 0)]), abs=1e-14)


def test_the_change_is_the_least() -> None:
    """Any other change that does the same is longer: the change is orthogonal to what is free."""
    weights = np.array([1.0, 2, 3, 4, 5, 6, 7])
    change = pull_curve(BASIS, [PULL, CurveTarget(2.6, (0, 0))], weights=weights)
    rows = BASIS.rows([1.7, 2.6])
    free = np.linalg.svd(rows)[2][2:]
    assert np.abs(free @ (weights[:, None] * change)).max() < 1e-14


def test_fixed_points_stay() -> None:
    """A fixed control point keeps its place to the last bit, and the curve does as asked."""
    change = pull_curve(BASIS, [PULL], fixed=[2, 3])
    assert change[[2, 3]].tolist() == [[0.0, 0.0]] * 2
    assert (BASIS.rows([1.7]) @ change)[0] == pytest.approx(D, abs=1e-14)


def test_a_condition_on_the_slope() -> None:
    """A row of derivatives turns the curve at a place that stays."""
    asked = [CurveTarget(1.7, (0.0, 0.0)), CurveTarget(1.7, (0.0, 0.3), order=1)]
    change = pull_curve(BASIS, asked)
    assert np.abs(places(change, [1.7])).max() < 1e-15
    assert places(change, [1.7], 1)[0] == pytest.approx((0.0, 0.3), abs=1e-14)


def test_a_surface() -> None:
    """One row of a surface: dP_ij = N_i M_j d / (sum N^2 sum M^2)."""
    other = Basis.on([0, 0, 0, 1, 1, 1], 2)
    change = pull_surface(BASIS, other, [SurfaceTarget(1.7, 0.4, (0.1, 0.4, -0.2))])
    n, m = BASIS.rows([1.7])[0], other.rows([0.4])[0]
    expected = np.multiply.outer(n, m) / ((n @ n) * (m @ m))
    assert change.shape == (7, 3, 3)
    assert change == pytest.approx(np.multiply.outer(expected, [0.1, 0.4, -0.2]), abs=1e-15)


def test_a_surface_with_pins_and_fixed_points() -> None:
    """Pins stay, fixed points stay, the target moves by what is asked."""
    targets = [
        SurfaceTarget(1.7, 1.7, (0.0, 0.0, 1.0)),
        SurfaceTarget(2.6, 1.0, (0.0, 0.0, 0.0)),
        SurfaceTarget(1.7, 1.7, (0.0, 0.0, 0.0), order=(1, 0)),
    ]
    change = pull_surface(BASIS, BASIS, targets, fixed=[(2, 2)])
    rows = [
        np.kron(BASIS.rows([t.u], t.order[0]), BASIS.rows([t.v], t.order[1]))[0] for t in targets
    ]
    assert change[2, 2].tolist() == [0.0, 0.0, 0.0]
    assert np.array(rows) @ change.reshape(49, 3) == pytest.approx(
        np.array([t.d for t in targets]), abs=1e-14
    )


def test_two_targets_on_one_point_are_refused() -> None:
    """What cannot be told apart is an error that names both."""
    with pytest.raises(BadInputError, match=r"pull: 2 targets on one point, at u=1\.7 and u=1\.7"):
        pull_curve(BASIS, [PULL, CurveTarget(2.6, D), CurveTarget(1.7, (0.0, 0.0))])


@pytest.mark.parametrize(
    ("targets", "options", "message"),
    [
        ([], {}, "pull: no target"),
        ([CurveTarget(u, D) for u in (0.2, 0.4, 0.5, 0.6, 0.8)], {}, "5 targets depend"),
        ([CurveTarget(0.0, D)], {"fixed": [0]}, "no free control point moves, at u=0"),
        ([CurveTarget(4.1, D)], {}, "parameter 4.1 lies off the curve"),
        ([PULL], {"fixed": [7]}, "fixed is 7"),
        ([PULL], {"weights": [1, 1, 1, 1, 1, 1, 0]}, "7 weights, the least 0"),
        ([PULL], {"weights": [1, 1]}, "2 weights"),
        ([PULL, CurveTarget(2.6, (0.1,))], {}, "changes of 1 and 2 coordinates"),
    ],
)
def test_what_cannot_be_done_is_refused(
    targets: list[CurveTarget], options: dict[str, list[int]], message: str
) -> None:
    """Each refusal is an error of the family and says what is wrong."""
    with pytest.raises(BadInputError, match=message):
        pull_curve(BASIS, targets, fixed=options.get("fixed", ()), weights=options.get("weights"))


@pytest.mark.parametrize(
    ("fixed", "message"), [((1, 8), "fixed is 8"), ((7, 0), "fixed is 7"), (3, r"give \(i, j\)")]
)
def test_a_fixed_point_off_the_net_is_refused(fixed: tuple[int, int], message: str) -> None:
    """Also one whose number, row by row, would be that of another control point."""
    with pytest.raises(BadInputError, match=message):
        pull_surface(BASIS, BASIS, [SurfaceTarget(1.7, 1.0, (0.1,))], fixed=[fixed])


@pytest.mark.parametrize(("knots", "degree"), [([0, 1], 3), ([0, 0, 1, 0.5], 1)])
def test_knots_are_checked(knots: list[float], degree: int) -> None:
    """Too few knots and knots that fall are refused."""
    with pytest.raises(BadInputError, match="knots for degree"):
        Basis.on(knots, degree)


def test_rows_of_any_length_ask_alike() -> None:
    """Rows a million times longer than others do not hide them."""
    rows = np.array([[1e6, 0.0, 1e6], [0.0, 1e-3, 1e-3]])
    asked = np.array([[2e6], [1e-3]])
    assert rows @ least_change(rows, asked) == pytest.approx(asked, rel=1e-12)
