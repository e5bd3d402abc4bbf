"""Aiming on a ship of formulas: convergence, least change, bounds, and what cannot be had."""

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any

import attrs
import numpy as np
import pytest
from scipy.optimize import least_squares, minimize

from assoc_hull.errors import (
    BadInputError,
    DependentTargetsError,
    TooFewFreeError,
    UnreachableError,
)
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.aiming.newton_iteration import StoppingRule
from assoc_hull.variation.aiming.report import AimReport
from assoc_hull.variation.aiming.target_solver import solve_targets
from tests.aims import FULLER, SHIFTED, problem, small
from tests.formula_ships import OUTPUTS, PARENT, UNITS, Formula, FormulaShip

ALL = tuple(PARENT)
FIVE = ("breadth", "draught", "fore", "aft", "flare")
CHANGE = {"volume": 105.366667, "lcb": 0.36, "kmt": 0.2, "cw": 0.005, "a_m": -0.24}
"""+1 % V, +0.3 % L LCB, +0.2 m KMT, +0.005 CW, -0.2 % A_M."""


def changed(ship: FormulaShip, change: dict[str, float] | None = None) -> FloatArray:
    """Targets: the parent's outputs and some change."""
    asked = CHANGE if change is None else change
    targets: FloatArray = ship.parent + np.array([asked[name] for name in ship.outputs])
    return targets


def aim(ship: FormulaShip, targets: FloatArray, **how: Any) -> AimReport:
    """Aim from the parent, with the ship's own scales."""
    units = tuple(UNITS[OUTPUTS.index(name)] for name in ship.outputs)
    return solve_targets(
        ship, targets, start=np.zeros(len(ship.free)), scales_free=ship.usual,
        scales_out=ship.sizes, units=units, **how,
    )  # fmt: skip


def scaled(
    ship: FormulaShip, targets: FloatArray
) -> tuple[Callable[[FloatArray], FloatArray], Callable[[FloatArray], FloatArray]]:
    """Misses and their derivatives as other solvers want them."""

    def misses(mu: FloatArray) -> FloatArray:
        return (ship.at(mu * ship.usual).values - targets) / ship.sizes

    def slopes(mu: FloatArray) -> FloatArray:
        return ship.at(mu * ship.usual).jacobian * ship.usual / ship.sizes[:, None]

    return misses, slopes


def least_change(ship: FormulaShip, targets: FloatArray, bounds: FloatArray) -> FloatArray:
    """The least scaled change that meets targets, by scipy's sequential quadratic programming."""
    sequential: Any = minimize  # its types want one overload for each method
    misses, slopes = scaled(ship, targets)
    known = sequential(
        lambda mu: 0.5 * mu @ mu, np.zeros(7), jac=lambda mu: mu, method="SLSQP",
        constraints={"type": "eq", "fun": misses, "jac": slopes},
        bounds=bounds / ship.usual[:, None], options={"ftol": 1e-15, "maxiter": 200},
    )  # fmt: skip
    assert known.success
    found: FloatArray = known.x
    return found


@pytest.mark.parametrize(
    ("free", "outputs"),
    [
        pytest.param(("breadth", "fore", "aft"), OUTPUTS[:3], id="three by three"),
        pytest.param(FIVE, OUTPUTS, id="five by five"),
    ],
)
def test_square_problems_converge_quadratically(
    free: tuple[str, ...], outputs: tuple[str, ...]
) -> None:
    """Residual 1e-10 in at most 6 steps, each no more than 200 times the square of the last."""
    ship = FormulaShip(free, outputs)
    found = aim(ship, changed(ship))
    residuals = [each.residual for each in found.steps]
    assert found.reached
    assert len(residuals) - 1 <= 6
    assert residuals[-1] <= 1e-10
    for before, after in pairwise(residuals):
        assert after <= max(200.0 * before**2, 1e-14)
    assert ship.looks == len(residuals)
    assert np.abs(ship.at(found.amplitudes).values - found.targets).max() < 1e-8


def test_more_freedom_gives_the_least_change() -> None:
    """Five targets, seven freedoms: 12 steps to 1e-10 and KKT 1e-6, and the known least change.

    The known one is found by sequential quadratic programming.
    """
    ship = FormulaShip(ALL)
    targets = changed(ship)
    found = aim(ship, targets)
    plain = aim(ship, targets, rule=StoppingRule(least=False))
    assert len(found.steps) - 1 <= 12
    assert found.residual <= 1e-10
    assert found.kkt <= 1e-6
    assert plain.residual <= 1e-10
    assert plain.kkt > 1e-2
    assert found.change < plain.change
    known = least_change(ship, targets, np.full((7, 2), np.inf) * [-1.0, 1.0])
    assert found.amplitudes / ship.usual == pytest.approx(known, abs=1e-5)


def test_a_hull_of_the_kernel_gets_the_least_change_that_meets_its_targets() -> None:
    """Two targets, four freedoms: 12 steps to 1e-10 and KKT 1e-6, below plain shortest steps."""
    hull = small()
    now = hull.hydrostatics()
    targets = [1.03 * now.volume, now.lcb + 0.4]
    free = ["breadth", "draught", SHIFTED, FULLER]
    found, plain = (
        solve_targets(
            ship,
            targets,
            start=np.zeros(4),
            scales_free=[each.usual for each in ship.maps.free],
            scales_out=targets,
            rule=rule,
        )
        for ship, rule in (
            (problem(hull, ["volume", "lcb"], free), rule)
            for rule in (StoppingRule(), StoppingRule(least=False))
        )
    )
    assert len(found.steps) - 1 <= 12
    assert found.residual <= 1e-10
    assert found.kkt <= 1e-6
    assert plain.residual <= 1e-10
    assert found.change < plain.change


def test_more_freedom_within_bounds_gives_the_least_change_within_them() -> None:
    """A bound that the least change would pass is met to the bit, and the rest is the least."""
    ship = FormulaShip(ALL)
    targets = changed(ship)
    bounds = np.array([[-2.0, 2.0]] * 7) * ship.usual[:, None]
    bounds[ALL.index("fore")] = -0.05, 0.1
    found = aim(ship, targets, bounds=bounds)
    assert found.active == ("fore",)
    assert found.amplitudes[ALL.index("fore")] == 0.1
    assert found.residual <= 1e-10
    assert found.kkt <= 1e-6
    known = least_change(ship, targets, bounds)
    assert found.change == pytest.approx(float(np.linalg.norm(known)), rel=1e-9)


def test_an_answer_at_a_bound_is_found() -> None:
    """Targets that belong to a hull with a parameter at its bound are met there."""
    ship = FormulaShip(("breadth", "fore", "aft"), OUTPUTS[:3])
    answer = np.array([0.4, 0.3, -0.1])
    bounds = np.array([[-1.0, 0.4], [-1.0, 1.0], [-1.0, 1.0]])
    found = aim(ship, ship.at(answer).values, bounds=bounds)
    assert found.reached
    assert found.amplitudes == pytest.approx(answer, abs=1e-8)


def test_what_bounds_forbid_is_refused_with_their_names_and_the_shortfall() -> None:
    """V + 10 % with two bounded parameters: both are named, and the shortfall is that at both."""
    ship = FormulaShip(("fore", "aft"), ("volume",))
    targets = 1.1 * ship.parent
    bounds = np.full((2, 2), 0.3) * [-1.0, 1.0]
    with pytest.raises(UnreachableError) as caught:
        aim(ship, targets, bounds=bounds)
    best = ship.at(np.full(2, 0.3)).values[0]
    error = caught.value
    assert (error.target, error.bounds) == ("volume", ("fore", "aft"))
    assert error.best == best
    assert error.shortfall == 100.0 * (best - targets[0]) / ship.parent[0]
    assert str(error) == (
        "volume cannot be brought to 11590.3 m3: the nearest is 10855.1 m3 "
        "(6.98 % of the parent's value less than asked), with fore and aft at their bounds; "
        "widen them, free another parameter, or ask for less"
    )


def test_what_is_held_at_one_value_is_a_bound() -> None:
    """A parameter whose bounds are one value is named where it is in the way, and in the report."""
    ship = FormulaShip(("breadth", "fore"), ("volume",))
    held = [[0.1, 0.1], [-0.1, 0.1]]
    with pytest.raises(UnreachableError) as caught:
        aim(ship, 1.1 * ship.parent, bounds=held)
    assert caught.value.bounds == ("breadth", "fore")
    found = aim(ship, 1.005 * ship.parent, bounds=held)
    assert found.active == ("breadth",)
    assert found.kkt <= 1e-6


def test_the_best_within_bounds_is_that_of_least_squares() -> None:
    """Several targets out of reach: the compromise has the least sum of squares, to rounding."""
    ship = FormulaShip(FIVE)
    targets = changed(ship, {name: 3.0 * each for name, each in CHANGE.items()})
    bounds = np.array([[-1.0, 1.0]] * 5) * ship.usual[:, None]
    found = aim(ship, targets, bounds=bounds, exact=False)
    misses, slopes = scaled(ship, targets)
    known = least_squares(
        misses, np.zeros(5), slopes, bounds=(-np.ones(5), np.ones(5)),
        xtol=1e-15, ftol=1e-15, gtol=1e-15,
    )  # fmt: skip
    assert not found.reached
    assert found.active
    assert found.kkt < 1e-8
    assert np.linalg.norm(found.misses / ship.sizes) <= np.linalg.norm(known.fun) * (1.0 + 1e-9)
    assert "best compromise" in str(found)


def test_fewer_free_parameters_than_targets_need_leave_for_a_compromise() -> None:
    """Exactly it is refused before a hull is made; else the gradient of the squares is nil."""
    ship = FormulaShip(("fore", "aft"), OUTPUTS[:3])
    with pytest.raises(TooFewFreeError) as caught:
        aim(ship, changed(ship))
    assert str(caught.value) == (
        "aim: 3 targets need at least 3 free parameters for an exact answer (2 given); "
        "the best compromise is returned only with exact=False (--compromise)"
    )
    assert ship.looks == 0
    found = aim(ship, changed(ship), exact=False)
    assert not found.reached
    assert found.condition == np.inf
    assert found.singular.shape == (2,)
    misses, slopes = scaled(ship, found.targets)
    mu = found.amplitudes / ship.usual
    assert np.abs(slopes(mu).T @ misses(mu)).max() < 1e-8


@pytest.mark.parametrize(
    ("free", "outputs", "together", "words"),
    [
        pytest.param(
            ("breadth", "draught", "length"), ("cw", "volume"), ("cw",),
            "aim: no free parameter moves cw; drop it or free another one",
            id="one that nothing moves",
        ),
        pytest.param(
            ("breadth",), ("cw",), ("cw",),
            "aim: no free parameter moves cw; drop it or free another one",
            id="the only one",
        ),
        pytest.param(
            ("breadth", "draught"), ("volume", "a_m"), ("volume", "a_m"),
            "aim: targets volume and a_m move together (condition inf); drop one or free another "
            "parameter",
            id="two that move together",
        ),
    ],
)  # fmt: skip
def test_targets_that_cannot_be_told_apart_are_named(
    free: tuple[str, ...], outputs: tuple[str, ...], together: tuple[str, ...], words: str
) -> None:
    """The combination that nothing moves is told, at the first look."""
    ship = FormulaShip(free, outputs)
    with pytest.raises(DependentTargetsError) as caught:
        aim(ship, changed(ship))
    assert set(caught.value.targets) == set(together)
    assert str(caught.value) == words
    assert ship.looks == 1
    loose = aim(ship, changed(ship), exact=False)
    assert set(loose.together) == set(together)


def test_a_target_that_hardly_moves_is_one_that_nothing_moves() -> None:
    """A coefficient that only the loft changes is not chased until the hull folds."""

    @attrs.frozen
    class Faint:
        free, outputs = ("breadth",), ("cb",)

        def at(self, amplitudes: FloatArray) -> Formula:
            if abs(amplitudes[0]) > 5.0:
                raise BadInputError("the map folds", "in the ship", "ask for less")
            return Formula(0.7 + 1e-7 * amplitudes, np.full((1, 1), 1e-7))

    with pytest.raises(DependentTargetsError) as caught:
        solve_targets(Faint(), [0.71], start=[0.0], scales_free=[1.0], scales_out=[0.7])
    assert caught.value.targets == ("cb",)


def test_targets_that_agree_may_move_together() -> None:
    """Breadth and draught scale volume and section alike; asked for alike, both are met."""
    ship = FormulaShip(("breadth", "draught"), ("volume", "a_m"))
    found = aim(ship, 1.01 * ship.parent)
    assert found.reached
    assert found.rank == 1


def test_steps_are_halved_where_there_is_no_hull() -> None:
    """A whole step that lands where the map folds is halved; the targets are met all the same."""
    whole = FormulaShip(("breadth", "fore", "aft"), OUTPUTS[:3])
    targets = changed(whole)
    answer = aim(whole, targets).amplitudes
    tight = FormulaShip(
        whole.free, whole.outputs, lambda values: bool(values[0] < 20.0 + 1.01 * answer[0])
    )
    found = aim(tight, targets)
    assert min(each.part for each in found.steps[1:]) < 1.0
    assert found.amplitudes == pytest.approx(answer, abs=1e-9)


def test_targets_beyond_the_last_hull_are_refused_with_the_reason() -> None:
    """Where hulls end before the targets, the nearest one found is told, and why it is the last."""
    ship = FormulaShip(("breadth",), ("volume",), lambda values: bool(values[0] < 20.5))
    with pytest.raises(UnreachableError) as caught:
        aim(ship, 1.1 * ship.parent)
    error = caught.value
    assert error.bounds == ()
    assert 1.024 * ship.parent[0] < error.best < 1.025 * ship.parent[0]
    assert str(error).endswith(
        "; no certified hull beyond: the map folds, in the ship; ask for less"
    )


def test_a_start_outside_the_bounds_begins_at_the_nearest_place() -> None:
    """Changes are counted from the start as it is given."""
    ship = FormulaShip(("breadth", "fore"), ("volume",))
    bounds = [[0.3, 2.0], [-1.0, 1.0]]
    found = aim(ship, ship.parent, bounds=bounds)
    assert found.amplitudes[0] == 0.3
    assert found.active == ("breadth",)
    assert found.steps[0].change == pytest.approx(1.0)


def test_a_hull_that_is_right_already_is_left_alone() -> None:
    """Nothing asked for, nothing changed, in no step."""
    ship = FormulaShip(ALL)
    found = aim(ship, ship.parent)
    assert found.amplitudes.tolist() == [0.0] * 7
    assert len(found.steps) == 1
    assert ship.looks == 1


def test_the_same_question_has_the_same_answer_to_the_bit() -> None:
    """Nothing depends on time, order or memory."""
    ship = FormulaShip(ALL)
    one, two = (aim(ship, changed(ship), bounds=[[-0.5, 0.5]] * 7, exact=False) for _ in range(2))
    assert one.amplitudes.tobytes() == two.amplitudes.tobytes()
    assert one.steps == two.steps
    assert not one.amplitudes.flags.writeable


def test_a_report_says_what_was_reached_and_by_what() -> None:
    """Steps, condition and total change; values with units; changes: one line each."""
    ship = FormulaShip(("breadth", "fore", "aft"), OUTPUTS[:3])
    found = aim(ship, changed(ship))
    lines = str(found).splitlines()
    assert found.condition == pytest.approx(7.91, rel=1e-3)
    told = "aim: met after 4 steps; all changes together are 2.585 times the usual ones"
    assert lines[0] == told
    alike = attrs.evolve(found, singular=found.singular * [1.0, 1.0, 1e-3])
    assert "the targets hardly differ (condition number 7.91e+03)" in str(alike)
    assert lines[1:4] == [
        "volume 10536.7 -> 10642.0333 m3", "lcb 1.56189 -> 1.92189271 m",
        "kmt 8.50667 -> 8.70667299 m",
    ]  # fmt: skip
    assert lines[4] == "breadth by +0.66462"
    assert found.hull is not None
    left, values, _ = np.linalg.svd(found.hull.jacobian * ship.usual / ship.sizes[:, None])
    assert found.singular == pytest.approx(values)
    assert abs(found.combination @ left[:, -1]) == pytest.approx(1.0)
    assert np.abs(found.shortfalls).max() < 1e-7


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        pytest.param({"targets": [1.0]}, "targets is [1.0], in aiming; give finite", id="length"),
        pytest.param({"targets": [1.0, np.nan]}, "targets is [1.0, nan]", id="no number"),
        pytest.param({"start": ["a", 0.0]}, "start is ['a', 0.0]", id="text"),
        pytest.param({"scales_free": [1.0, 0.0]}, "give numbers above 0, 2", id="scale of nil"),
        pytest.param({"bounds": [[1.0, -1.0], [0.0, 1.0]]}, "give (low, high)", id="bounds"),
        pytest.param({"bounds": [[np.nan, 1.0], [0.0, 1.0]]}, "bounds are", id="bound no number"),
        pytest.param({"bounds": [1.0, 2.0]}, "bounds are [1.0, 2.0]", id="bounds no pairs"),
    ],
)
def test_numbers_that_cannot_be_used_are_refused(
    wrong: dict[str, Sequence[object]], words: str
) -> None:
    """An error of the family says which argument; no hull is made."""
    ship = FormulaShip(("fore", "aft"), ("volume", "lcb"))
    given: dict[str, Any] = {
        "targets": ship.parent, "start": [0.0, 0.0], "scales_free": [1.0, 1.0],
        "scales_out": [1.0, 1.0], **wrong,
    }  # fmt: skip
    with pytest.raises(BadInputError) as caught:
        solve_targets(ship, **given)
    assert words in str(caught.value)
    assert ship.looks == 0
