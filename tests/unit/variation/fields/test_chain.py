"""Functions along the ship: bits at nodes and outside, exact bounds, refusals."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields.bounded_functions import BlendChain, BoundedFunction, Contour
from assoc_hull.variation.fields.field import level_boundaries
from assoc_hull.variation.fields.shift_shapes import Bump
from tests.variation_strategies import bumps, chains, contours, courses

Give = Callable[[FloatArray], FloatArray]
spans = st.tuples(st.floats(-50.0, 300.0), st.floats(0.5, 200.0))


def extremes(give: Give, low: float, high: float, marks: FloatArray) -> tuple[float, float]:
    """Least and greatest value by zooming in on the best of many samples."""
    found = []
    for sign in (1.0, -1.0):
        at = np.union1d(np.linspace(low, high, 2001), marks[(marks >= low) & (marks <= high)])
        for _ in range(8):
            best = int(np.argmin(sign * give(at)))
            begin, end = at[max(best - 1, 0)], at[min(best + 1, len(at) - 1)]
            at = np.union1d(np.linspace(begin, end, 41), at[best : best + 1])
        found.append(float(sign * (sign * give(at)).min()))
    return found[0], found[1]


def check_bounds(course: BoundedFunction, span: tuple[float, float]) -> None:
    """Bounds of values and slopes on an interval are those of the function, to rounding."""
    low, high = span[0], span[0] + span[1]
    one = np.array([low]), np.array([high])
    for give, bounds in ((course.at, course.bounds), (course.slope, course.slope_bounds)):
        least, most = extremes(give, low, high, course.nodes)
        below, above = (float(each[0]) for each in bounds(*one))
        assert below <= least + 1e-14
        assert above >= most - 1e-14
        assert_allclose([below, above], [least, most], rtol=0, atol=1e-7)


@given(chain=chains(-1.0, 1.0))
@example(chain=BlendChain.through([0.0, 10.0, 20.0], [0.7, 0.1, 0.7]))
@example(chain=BlendChain.through([0.0, 10.0], [0.7, 0.1]))
def test_a_chain_gives_the_values_of_its_nodes(chain: BlendChain) -> None:
    """At nodes and outside, to the last bit and with slope nil."""
    assert chain.at(chain.x).tolist() == chain.v.tolist()
    outside = np.array([-np.inf, -1e6, chain.x[0] - 1e-9, chain.x[-1] + 1e-9, 1e6, np.inf])
    ends = [chain.v[0]] * 3 + [chain.v[-1]] * 3
    assert chain.at(outside).tolist() == ends
    assert (chain.slope(outside[1:-1]) == 0.0).all()


@given(contour=contours())
def test_a_contour_gives_the_values_of_its_nodes(contour: Contour) -> None:
    """To rounding inside, to the last bit at both ends and outside."""
    assert_allclose(contour.at(contour.x), contour.v, rtol=0, atol=1e-14)
    ends = contour.at(np.array([-1e6, contour.x[0], contour.x[-1], 1e6]))
    assert ends.tolist() == [contour.v[0], contour.v[0], contour.v[-1], contour.v[-1]]
    assert (contour.slope(np.array([-1e6, contour.x[0], contour.x[-1], 1e6])) == 0.0).all()


@given(bump=bumps())
def test_a_bump_is_nil_outside_its_terminals(bump: Bump) -> None:
    """To the last bit; its greatest size is that asked, or a quarter of it after Lackenby."""
    outside = np.array([-1e6, *bump.nodes.tolist(), 1e6])
    assert (bump.at(outside) == 0.0).all()
    assert (bump.slope(outside) == 0.0).all()
    share = 0.25 if bump.shape == "lackenby" else 1.0
    low, high = bump.nodes.tolist()
    top = bump.at(np.linspace(low, high, 4001))
    assert_allclose(np.abs(top).max(), abs(bump.size) * share, rtol=1e-6, atol=1e-300)


@given(chain=chains(-1.0, 1.0), span=spans)
def test_bounds_of_a_chain_are_exact(chain: BlendChain, span: tuple[float, float]) -> None:
    """No sample exceeds them, and they are reached."""
    check_bounds(chain, span)


@given(contour=contours(-1.0, 1.0), span=spans)
def test_bounds_of_a_contour_are_exact(contour: Contour, span: tuple[float, float]) -> None:
    """No sample exceeds them, and they are reached, also where it swings out of its values."""
    check_bounds(contour, span)


@given(bump=bumps(), span=spans)
def test_bounds_of_a_bump_are_exact(bump: Bump, span: tuple[float, float]) -> None:
    """No sample exceeds them, and they are reached; at a terminal, from inside."""
    assume(min(abs(end - node) for end in (span[0], sum(span)) for node in bump.nodes) > 1e-3)
    check_bounds(bump, span)


def test_slopes_of_a_bump_count_at_its_terminals() -> None:
    """On an interval that begins or ends there, or so near that it rounds to there."""
    bump = Bump(20.0, 0.0, 1.0, "lackenby")
    for low, high in ((0.0, 5.0), (1e-30, 5.0), (-5.0, 0.0)):
        assert bump.slope_bounds(np.array([low]), np.array([high]))[1] == [0.05]


@given(course=courses())
def test_bounds_hold_everywhere(course: BoundedFunction) -> None:
    """On an interval without ends as well."""
    least, most = course.bounds(np.array([-np.inf]), np.array([np.inf]))
    sampled = course.at(np.linspace(-60.0, 400.0, 5001))
    assert least[0] <= sampled.min() + 1e-15
    assert most[0] >= sampled.max() - 1e-15


@given(course=courses(), factor=st.floats(-3.0, 3.0))
def test_a_scaled_function_is_scaled_everywhere(course: BoundedFunction, factor: float) -> None:
    """Values and slopes both, to the rounding of a spline that is solved twice."""
    x, scaled = np.linspace(-60.0, 400.0, 400), course.scaled(factor)
    for found, wanted in (
        (scaled.at(x), factor * course.at(x)),
        (scaled.slope(x), factor * course.slope(x)),
    ):
        # 79 units in the last place of the largest value were the most in 8,000 draws: the
        # slopes of a contour solve a system whose condition goes with its unequal nodes.
        rounding = 128 * np.finfo(float).eps * float(np.abs(wanted).max())
        assert_allclose(found, wanted, rtol=0, atol=rounding + 1e-15)


@given(course=courses())
def test_the_slope_is_the_derivative(course: BoundedFunction) -> None:
    """By central differences, away from where pieces join."""
    x = np.linspace(-30.0, 320.0, 701)
    x = x[np.abs(x[:, None] - course.nodes).min(axis=1) > 1e-3]
    step = 1e-4
    difference = (course.at(x + step) - course.at(x - step)) / (2.0 * step)
    assert_allclose(course.slope(x), difference, rtol=0, atol=2e-9)


@pytest.mark.parametrize(
    ("x", "v", "words"),
    [
        ([0, 10, 30, 40, 41, 40], [0] * 6, "nodes of 'rho_2' must rise: x[5]=40 after 41"),
        ([0, 0], [1, 1], "nodes of 'rho_2' must rise: x[1]=0 after 0"),
        ([], [], "nodes of 'rho_2' must rise: there are none"),
        ([0, 1], [1], "'rho_2' has 2 nodes and 1 values"),
        ([0, float("nan")], [1, 1], "rho_2"),
        ([0, 1], [1, float("inf")], "rho_2"),
    ],
)
def test_nodes_that_make_no_chain_are_refused(x: list[float], v: list[float], words: str) -> None:
    """The message names the chain, the node and what is wrong with it."""
    with pytest.raises(BadInputError) as caught:
        BlendChain.through(x, v, name="rho_2")
    assert words in str(caught.value)
    assert "in vary" in str(caught.value)


@pytest.mark.parametrize("heights", [[0.0, 5.0, 4.96], [0.0, 5.0, 5.0]])
def test_level_boundaries_that_touch_are_refused(heights: list[float]) -> None:
    """The message names both, and the gap."""
    with pytest.raises(BadInputError, match=r"'shaft\+r' and 'T' touch \(gap -?0"):
        level_boundaries(["base", "shaft+r", "T"], heights)


@pytest.mark.parametrize("nodes", [[3.0], [-1.0, 4.0, 9.0]], ids=["one node", "three"])
def test_a_level_chain_is_its_value_everywhere(nodes: list[float]) -> None:
    """To the last bit, infinitely far off as well, in the shape that is asked; slopes are nil."""
    chain = BlendChain.through(nodes, [0.1] * len(nodes))
    x = np.array([[-np.inf, -2.0, -1.0], [3.7, 9.0, np.inf]])
    assert chain.level
    assert (chain.at(x) == 0.1).all()
    assert (chain.slope(x) == 0.0).all()
    assert (chain.second(x) == 0.0).all()
    assert chain.at(x).shape == chain.slope(x).shape == x.shape
    assert chain.at(np.array(2.0)).shape == ()
