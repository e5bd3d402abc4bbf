"""The doctor of nets: planted errors are found among noise; sound hulls raise no alarm."""

from __future__ import annotations

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.edit.net_battens import net_battens
from assoc_hull.errors import BadInputError
from assoc_hull.fairing.net_doctor import examine_battens
from assoc_hull.model.address import address, resolve_address
from tests.planted_slips import SHIPS

NOISE = 1.6e-3


@pytest.mark.parametrize("ship", ["wigley", "series60", "bulk_carrier_207k"])
def test_wrong_points_are_found_among_noise(ship: str) -> None:
    """Twelve of 30 to 300 mm, 1.6 mm of noise on others: three of four are called, no other."""
    hull = getattr(ah.examples, ship)()
    problem = net_battens(hull.state)
    called = false = 0
    for seed in range(3):
        random = np.random.default_rng(seed)
        count = len(problem.rows)
        shift = random.uniform(-NOISE, NOISE, count)
        wrong = random.choice(count, 12, replace=False)
        shift[wrong] += random.uniform(0.03, 0.3, 12) * random.choice([-1.0, 1.0], 12)
        report = examine_battens(hull.state, problem.shifted(shift), 12, 1e-3)
        there = {address(hull.state, int(problem.rows[each])) for each in wrong}
        told = [each.point for each in report.alarms]
        assert len(set(told)) == len(told)
        called += len(there & set(told))
        false += len(set(told) - there)
    assert called >= 0.75 * 36
    assert false == 0


def test_what_is_told_puts_a_point_back() -> None:
    """The distance and the place that lines ask for are those it had, to the noise of its net."""
    hull = ah.examples.wigley()
    problem = net_battens(hull.state)
    row = problem.rows.tolist().index(resolve_address(hull.state, "WL 2.5 x ST 7").row)
    shift = np.zeros(len(problem.rows))
    shift[row] = 0.05
    (found,) = examine_battens(hull.state, problem.shifted(shift), 0, 1e-3).alarms
    assert found.point == "WL 2.5 x ST 7"
    assert found.off == pytest.approx(0.05, abs=1e-3)
    apart = np.linalg.norm(np.subtract(found.place, found.proposed))
    assert apart == pytest.approx(0.05 / problem.freedom[row], rel=0.03)
    assert "mm too far out" in str(found)


@pytest.mark.parametrize("ship", SHIPS)
def test_sound_hulls_raise_no_alarm(ship: str) -> None:
    """Five hulls of the program; nothing of them changes."""
    hull = getattr(ah.examples, ship)()
    before = hull.fingerprint
    report = hull.doctor(top=3)
    assert report.alarms == ()
    assert report.points > 100
    assert len(report.findings) <= 3
    assert hull.fingerprint == before


def test_a_smaller_ship_is_known_better() -> None:
    """The usual noise is in proportion to a ship shorter than 100 m; a length must be one."""
    hull = ah.examples.wigley()
    assert hull.doctor().noise == 1e-3
    assert hull.doctor(noise=0.002).noise == 0.002
    for noise in (0.0, -1.0, float("nan")):
        with pytest.raises(BadInputError, match="noise"):
            hull.doctor(noise=noise)
