"""Where lines are unfair, judged by the lines beside."""

from __future__ import annotations

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.analysis.fairness.unfair_places import judge_battens
from assoc_hull.edit.net_battens import net_battens
from assoc_hull.errors import BadInputError
from assoc_hull.hull import Hull
from tests.long_forms import LONG

_DENTS, _SIZE, _FIRST = 100, 8.0, 5


@pytest.mark.parametrize(("name", "most"), [("wigley", 0), ("bulk_carrier", 3)])
def test_hulls_of_formulas_have_few_unfair_lines(
    name: str, most: int, request: pytest.FixtureRequest
) -> None:
    """Fewer than one line in twenty is called unfair on a hull that is fair."""
    hull = ah.examples.wigley() if name == "wigley" else request.getfixturevalue(name)
    table = hull.fairness()
    called = {place.line for place in table.unfair}
    assert len(called) <= most < len(hull.lines) / 20.0
    assert all(place.ratio > 3.0 for place in table.unfair)


@pytest.mark.parametrize("name", ["series60_70", *(["wigley", "bulk_carrier"] if LONG else [])])
def test_planted_dents_are_named(name: str, request: pytest.FixtureRequest) -> None:
    """Of 100 dents of 8 times the usual, one at a time, 90 stand among the first five places."""
    hull = ah.examples.wigley() if name == "wigley" else request.getfixturevalue(name)
    state, rng = hull.document.state, np.random.default_rng(1)
    problem = net_battens(state)
    judged = judge_battens(state, problem)
    column = {row: place for place, row in enumerate(problem.rows.tolist())}
    free = np.isfinite(judged.usual) & np.isin(problem.centre, problem.rows)
    named = 0
    for index in rng.choice(np.flatnonzero(free), _DENTS).tolist():
        centre = problem.centre[index]
        usual = judged.usual[problem.centre == centre]
        dent = np.zeros(len(problem.rows))
        dent[column[int(centre)]] = _SIZE * usual[np.isfinite(usual)].max() * rng.choice([-1, 1])
        ratio = judge_battens(state, problem.shifted(dent)).ratio
        named += centre in problem.centre[np.argsort(-ratio)[:_FIRST]]
    assert named >= 0.9 * _DENTS


def test_a_point_that_was_pushed_is_the_first_place() -> None:
    """Its waterline is called there, with how far the batten springs."""
    hull = ah.examples.wigley()
    with hull.edit("push") as edit:
        edit.move("WL 2.5 x ST 7", y=hull.points["WL 2.5 x ST 7"].y + 0.005)
    first = hull.fairness().unfair[0]
    assert (first.line, first.point) == ("WL 2.5", "WL 2.5 x ST 7")
    assert 0.003 < abs(first.residual) < 0.006
    assert "times the usual" in str(first)
    assert "of 31 lines" in str(hull.fairness())


def test_a_stated_noise_is_not_called(bulk_carrier: Hull) -> None:
    """With a noise of 10 mm nothing of the carrier is; a noise that is none is refused."""
    assert not bulk_carrier.fairness(noise=0.01).unfair
    with pytest.raises(BadInputError, match="noise"):
        bulk_carrier.fairness(noise=-1.0)


def test_chosen_lines_have_the_verdict_of_the_whole_net(bulk_carrier: Hull) -> None:
    """A line is judged by the lines beside, whether these are asked for or not."""
    whole = bulk_carrier.fairness()
    [place, *_] = whole.unfair
    assert place in bulk_carrier.fairness(lines=[place.line]).unfair
    assert not bulk_carrier.fairness(lines=["ST 5"]).unfair
