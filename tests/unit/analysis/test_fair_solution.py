"""Noise of known size is taken out of nets whose truth is known."""

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest

from assoc_hull.analysis.fairness.fair_solution import estimate_noise, solve_battens
from assoc_hull.analysis.fairness.rounding_unit import rounding_noise, rounding_unit
from tests.conftest import Shipped
from tests.long_forms import LONG
from tests.noisy_nets import NoisyNet, rms, uniform_noise

Net = Callable[[str, float], NoisyNet]
"""Gives a net by its short name, with noise of a half width in mm."""

FIXTURES = {"wigley": "wigley", "series 60": "series60_70", "carrier": "bulk_carrier"}


@pytest.fixture(scope="module")
def noisy(shipped: Shipped) -> Net:
    """Nets with noise; each hull is made once."""
    hull = cache(lambda name: shipped(FIXTURES[name]))
    return cache(lambda name, width: NoisyNet.of(hull(name), 1e-3 * width))


UNKNOWNS = {"wigley": 171, "series 60": 728, "carrier": 1545}
LEFT = {
    ("wigley", 1.6): 0.54, ("wigley", 5.0): 0.48, ("wigley", 10.0): 0.47,
    ("series 60", 1.6): 0.83, ("series 60", 5.0): 0.73, ("series 60", 10.0): 0.66,
    ("carrier", 1.6): 0.84, ("carrier", 5.0): 0.72, ("carrier", 10.0): 0.65,
}  # fmt: skip
"""By ship and half width of the noise, mm: the part of the error that a trial had left."""

SHORT = {("wigley", 10.0), ("series 60", 10.0), ("carrier", 10.0)}
CASES = [case for case in LEFT if LONG or case in SHORT]


@pytest.mark.parametrize(("name", "width"), CASES)
def test_stated_noise_is_taken_out(name: str, width: float, noisy: Net) -> None:
    """No more of it is left than the trial left; computed points gain half as much at least."""
    net = noisy(name, width)
    assert len(net.clean.rows) == UNKNOWNS[name]
    noise, limit = 1e-3 * width / np.sqrt(3.0), 1e-3 * width * net.clean.freedom
    found = solve_battens(net.problem, noise, limit=limit)
    left = net.left(found.displacement)
    assert left <= LEFT[name, width] + 0.03
    assert (np.abs(found.displacement) <= limit + 1e-12).all()
    if name != "wigley":
        assert 1.0 - net.computed_left(found.displacement) >= 0.5 * (1.0 - left)


@pytest.mark.parametrize(("name", "width"), CASES)
def test_estimated_noise_is_taken_out(name: str, width: float, noisy: Net) -> None:
    """The estimate lies near the truth, and little more is left than with the noise stated."""
    net = noisy(name, width)
    noise = estimate_noise(net.problem)
    assert 0.85 <= noise / (1e-3 * width / np.sqrt(3.0)) <= 1.3
    found = solve_battens(net.problem, noise, limit=1e-3 * width * net.clean.freedom)
    assert net.left(found.displacement) <= LEFT[name, width] + 0.04


@pytest.mark.parametrize(("name", "width"), CASES)
def test_sign_changes_that_noise_made_go(name: str, width: float, noisy: Net) -> None:
    """Of large ones nine in ten, of small ones three in four; hardly a true one is lost."""
    net = noisy(name, width)
    limit = 1e-3 * width * net.clean.freedom
    d = solve_battens(net.problem, 1e-3 * width / np.sqrt(3.0), limit=limit).displacement
    small, large = net.excess(d, 0.2), net.excess(d, 1.0)
    assert small[1] <= 0.25 * small[0]
    assert large[0] < 20 or large[1] <= 0.1 * large[0]
    assert small[2] <= (17 if name == "series 60" else 0)


@pytest.mark.parametrize("name", ["wigley", "series 60", *(["carrier"] if LONG else [])])
def test_little_noise_is_never_made_more(name: str, noisy: Net) -> None:
    """Of half a millimetre less is left than there was."""
    net = noisy(name, 0.5)
    found = solve_battens(net.problem, 0.5e-3 / np.sqrt(3.0))
    assert net.left(found.displacement) < 1.0


def test_all_lines_together_gain_more_than_one_family_alone(noisy: Net) -> None:
    """Carrier, 10 mm: by .15 of the error at least."""
    net = noisy("carrier", 10.0)
    state, noise = net.state, 10e-3 / np.sqrt(3.0)
    together = net.left(solve_battens(net.problem, noise).displacement)
    for family in ("sections", "waterlines"):
        mine = [
            state.family(state.line_of(curve)).name == family
            for curve in net.problem.curve.tolist()
        ]
        problem = net.problem.residuals_of(np.flatnonzero(mine))
        alone = net.left(solve_battens(problem, noise).displacement)
        assert alone - together >= 0.15


@pytest.mark.parametrize("unit", [0.001, 0.0254 / 16.0, 0.005])
def test_rounding_is_taken_out(unit: float, noisy: Net) -> None:
    """Series 60: as much of it as the trial took out, with the noise of the unit."""
    clean = noisy("series 60", 1.0).clean
    state = noisy("series 60", 1.0).state
    way = clean.moves * clean.freedom[:, None]  # unit vectors along the freedom
    axis = np.abs(way).argmax(axis=1)
    value = state.rows.xyz[clean.rows, axis]
    off = np.round(value / unit) * unit - value
    along = np.abs(way).max(axis=1)
    net = NoisyNet.with_noise(
        state, np.where(along > 1.0 - 1e-9, off * np.sign(way[np.arange(len(axis)), axis]), 0.0)
    )
    found = solve_battens(net.problem, rounding_noise(unit))
    allowed = {0.001: 0.93, 0.0254 / 16.0: 0.89, 0.005: 0.79}[unit]
    assert net.left(found.displacement) <= allowed + 0.03


@pytest.mark.parametrize(
    ("name", "mean", "largest"),
    [("wigley", 0.02, 0.02), ("series 60", 0.15, 2.0), *([("carrier", 0.04, 0.2)] if LONG else [])],
)
def test_a_clean_net_hardly_moves(name: str, mean: float, largest: float, noisy: Net) -> None:
    """With the noise that is estimated of it; mm."""
    problem = noisy(name, 1.0).clean
    noise = estimate_noise(problem)
    d = 1e3 * solve_battens(problem, noise).displacement
    assert rms(d) <= mean
    assert np.abs(d).max() <= largest


@pytest.mark.parametrize(("name", "width"), [("series 60", 5.0), ("carrier", 10.0)])
def test_true_shape_keeps_its_residuals(name: str, width: float, noisy: Net) -> None:
    """Bilges and shoulders, of more than five times the noise: within a twentieth."""
    net, noise = noisy(name, width), 1e-3 * width / np.sqrt(3.0)
    d = solve_battens(net.problem, noise).displacement
    sharp = np.abs(net.clean.residual) > 5.0 * noise
    after = net.problem.residual + net.problem.matrix @ d
    ratio = np.median(after[sharp] / net.clean.residual[sharp])
    assert 0.95 <= ratio <= 1.05


def test_too_large_a_noise_costs_less_than_it_gains(noisy: Net) -> None:
    """Carrier, 1.6 mm, twice and half of the noise stated: less is left than there was."""
    net = noisy("carrier", 1.6)
    for factor in (0.5, 2.0):
        found = solve_battens(net.problem, factor * 1.6e-3 / np.sqrt(3.0))
        assert net.left(found.displacement) <= 0.95


def test_the_bounded_minimum_is_one(noisy: Net) -> None:
    """Inside the bounds the force vanishes, at them it pushes outward: of the last quadratic."""
    net = noisy("wigley", 5.0)
    noise, limit = 3e-3, 1e-3 * net.clean.freedom
    found = solve_battens(net.problem, noise, limit=limit)
    a, b, d = net.problem.matrix, net.problem.residual, found.displacement
    assert (np.abs(d) <= limit).all()
    assert (np.abs(d[found.side != 0]) == limit[found.side != 0]).all()
    step = solve_battens(net.problem, noise).displacement
    assert (np.sign(step[found.side != 0]) == found.side[found.side != 0]).mean() > 0.9

    def energy(at: np.typing.NDArray[np.float64]) -> float:
        spread = noise * net.clean.freedom
        r = a @ at + b
        return float(((at / spread) ** 2).sum() + np.log1p((2.0 * r / noise) ** 2).sum())

    rng = np.random.default_rng(1)
    for _ in range(20):
        other = np.clip(d + rng.normal(0.0, 1e-4, len(d)), -limit, limit)
        assert energy(other) > energy(d)


def test_rounding_is_seen_only_where_all_values_obey() -> None:
    """One value that is no whole number of the unit, and there is none."""
    y = 5.0 + uniform_noise(100, 4.0)
    for unit in (0.01, 0.001, 0.0254 / 8.0):
        rounded = np.round(y / unit) * unit
        assert rounding_unit(rounded, 23.457) == pytest.approx(unit)
        rounded[50] += 0.3 * unit
        assert rounding_unit(rounded, 23.457) != pytest.approx(unit)
    assert rounding_unit(y[:10], 23.457) is None
