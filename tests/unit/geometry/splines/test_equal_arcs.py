"""Points at equal lengths along chains of cubics, and shares of whole parts."""

import numpy as np
from hypothesis import example, given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from assoc_hull.geometry.curves import FloatArray, IsoCurves
from assoc_hull.geometry.floating.wetted_curves import wet_runs
from assoc_hull.geometry.numeric.polynomials import differentiate
from assoc_hull.geometry.splines.arc_length import CubicChains, length_until, share_by_length


def hermite(first: FloatArray, last: FloatArray, out: FloatArray, into: FloatArray) -> FloatArray:
    """Coefficients of cubics with given ends and derivatives there."""
    rise = last - first
    return np.stack([first, out, 3.0 * rise - 2.0 * out - into, out + into - 2.0 * rise], axis=-2)


def midship(parts: int = 64) -> FloatArray:
    """Half midship section, B 28, T 10.5, bilge radius 2: flat, arc and side, (parts + 2, 4, 3).

    The arc is in cubics that touch the circle at their ends and middles: with 64 of them off it
    by 1e-13 m.
    """
    radius, angle = 2.0, np.linspace(-0.5 * np.pi, 0.0, parts + 1)
    step = angle[1] - angle[0]
    y, z = 12.0 + radius * np.cos(angle), 2.0 + radius * np.sin(angle)
    places = np.column_stack([0.0 * angle, y, z])
    along = np.column_stack([0.0 * angle, -np.sin(angle), np.cos(angle)])
    along *= 4.0 * radius * np.tan(0.25 * step)
    arc = hermite(places[:-1], places[1:], along[:-1], along[1:])
    ends = np.array([[0.0, 0.0, 0.0], [0.0, 14.0, 10.5]])
    flat = hermite(ends[0], places[0], places[0] - ends[0], places[0] - ends[0])
    side = hermite(places[-1], ends[1], ends[1] - places[-1], ends[1] - places[-1])
    return np.concatenate([flat[None], arc, side[None]])


def test_the_half_midship_section_is_parted_as_the_reference_says() -> None:
    """Length and five of twenty points, to the ten digits that are printed of them."""
    cubic = midship()
    chain = CubicChains(np.array([0, len(cubic)]), cubic)
    points = chain.equal(20)[0]
    reference = {
        1: (1.2442943502, 0.0),
        10: (12.4393313284, 0.0488495743),
        11: (13.4941074743, 0.6704726948),
        12: (13.9889787889, 1.7903255440),
        19: (14.0, 10.5),
    }
    assert_allclose(chain.length, [23.6415926536], rtol=0.0, atol=5e-11)
    for number, place in reference.items():
        assert_allclose(points[number, 1:], place, rtol=0.0, atol=6e-11)


def test_a_side_above_the_water_does_not_count() -> None:
    """The section drawn to 18 m and cut at T 10.5 has the same points as drawn to there."""
    short = midship()
    tall = short.copy()
    tall[-1, 1, 2] = 16.0
    curves = IsoCurves(
        np.array([0, len(tall)]), tall, np.zeros_like(tall), np.zeros(len(tall), np.bool_)
    )
    wet = wet_runs(curves, 10.5, 0.0, 0.0)
    whole = CubicChains(np.array([0, len(short)]), short)
    assert wet.bottom.all()
    assert not wet.top.any()
    assert_allclose(wet.chains.equal(20), whole.equal(20), rtol=0.0, atol=1e-12)


@settings(max_examples=5)
@given(st.integers(0, 2**32 - 1), st.integers(2, 12))
def test_points_have_equal_lengths_between_them(seed: int, points: int) -> None:
    """On random chains of cubics, to 1e-10 of their length; several at once as one by one."""
    random = np.random.default_rng(seed)
    knots = random.normal(size=(7, 3))
    cubic = hermite(knots[:-1], knots[1:], *random.normal(size=(2, 6, 3)))
    chains = CubicChains(np.array([0, 2, 6]), cubic)
    found = chains.equal(points)
    for number, (low, high) in enumerate([(0, 2), (2, 6)]):
        alone = CubicChains(np.array([0, high - low]), cubic[low:high])
        assert (alone.equal(points)[0] == found[number]).all()
        length = float(alone.length[0])
        wanted = length * np.arange(points) / (points - 1)
        off = _place_at(cubic[low:high], wanted) - found[number]
        assert np.abs(off).max() <= 1e-10 * length


def _place_at(cubic: FloatArray, wanted: FloatArray) -> FloatArray:
    """The places at lengths along a chain, found by halving."""
    slopes = differentiate(cubic)
    whole = length_until(slopes, np.ones(len(cubic)))
    which = np.minimum(np.searchsorted(np.cumsum(whole), wanted), len(cubic) - 1)
    rest = wanted - (np.cumsum(whole) - whole)[which]
    low, high = np.zeros(len(wanted)), np.ones(len(wanted))
    for _ in range(50):
        middle = 0.5 * (low + high)
        short = length_until(slopes[which], middle) < rest
        low, high = np.where(short, middle, low), np.where(short, high, middle)
    u = low[:, None]
    c = cubic[which]
    return np.asarray(((c[:, 3] * u + c[:, 2]) * u + c[:, 1]) * u + c[:, 0])


def test_a_chain_without_length_gives_its_place() -> None:
    """A point as a chain has that point at every length."""
    cubic = np.zeros((1, 4, 3))
    cubic[0, 0] = [1.0, 2.0, 3.0]
    assert CubicChains(np.array([0, 1]), cubic).equal(3).tolist() == [[[1.0, 2.0, 3.0]] * 3]


@example([5e-324], 1, 1)
@given(st.lists(st.floats(0.0, 1e3), min_size=1, max_size=9), st.integers(1, 60), st.integers(1, 3))
def test_shares_are_whole_and_fair(lengths: list[float], total: int, least: int) -> None:
    """They add up, nobody goes without, and nobody is off his due by a part or more."""
    size = np.array(lengths)
    found = share_by_length(size, total, least)
    assert (found >= least).all()
    assert found.sum() == max(total, least * len(lengths))
    due = size * total / size.sum() if size.sum() > 0.0 else np.full(len(size), total / len(size))
    if (due >= least).all():
        assert (np.abs(found - due) < 1.0).all()


def test_what_rounding_leaves_goes_to_the_largest_remainder() -> None:
    """2.6, 1.3 and 1.1 of five are 3, 1 and 1."""
    assert share_by_length(np.array([2.6, 1.3, 1.1]), 5).tolist() == [3, 1, 1]
