"""Chains of biarcs through points: published curvatures, order of the error, knuckles, frames."""

from collections.abc import Callable
from typing import cast

import numpy as np
import pytest
from numpy.testing import assert_allclose

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.biarc_chain import BiarcChain, biarc_chain
from assoc_hull.geometry.classical.biarcs import BiarcRule
from assoc_hull.geometry.curves import FloatArray

FIVE = np.array([[0, 0], [1, 0.8], [2.5, 1.5], [4, 1.7], [6, 1.2]])
RULES: tuple[BiarcRule, ...] = ("inverse", "as_printed", "min_jump", "equal_chord")


def wave(count: int) -> FloatArray:
    """Points of y = 2 sin x from 0 to 3: curved, with no inflection but near its start."""
    x = np.linspace(0.3, 3.0, count)
    return np.stack([x, 2.0 * np.sin(x)], axis=1)


def test_published_chain_of_five_points() -> None:
    """Eight curvatures and the length, all digits; every interval bends one way."""
    chain = biarc_chain(FIVE)
    bends = [
        [-0.15604807996004075, -0.16386060455140367], [-0.15121316508085897, -0.21201191093323715],
        [-0.18335755490337421, -0.22128013716714573], [-0.21926762453591248, -0.18731938042664198],
    ]  # fmt: skip
    assert chain.biarcs.kind.tolist() == ["C"] * 4
    assert_allclose(chain.biarcs.curvatures, bends, rtol=1e-12)
    assert_allclose(chain.length, 6.539769452257154, rtol=1e-15)
    assert chain.notes == ()


@pytest.mark.parametrize("rule", RULES)
def test_the_chain_leaves_a_curve_by_the_third_power(rule: BiarcRule) -> None:
    """Four times as many intervals: the distance falls by about 64; order 2.7 to 3.4."""
    dense = wave(1501)
    counts = np.array([13, 25, 49])
    off = [biarc_chain(wave(count), rule=rule).distances(dense).max() for count in counts]
    orders = np.log2(np.array(off[:-1]) / off[1:])
    assert ((orders > 2.7) & (orders < 3.4)).all()


def test_arcs_follow_one_another_in_order() -> None:
    """Each begins where the last one ended, in its direction, but at knuckles."""
    points = np.concatenate([FIVE, FIVE[1:] * [1, -1] + [6, 2.4]])
    arcs = biarc_chain(points, knuckles=[4]).arcs
    assert_allclose(arcs.ends()[:-1], arcs.start[1:], atol=1e-14)
    turned = np.abs(np.exp(1j * arcs.end_angles()[:-1]) - np.exp(1j * arcs.angle[1:]))
    assert np.flatnonzero(turned > 1e-13).tolist() == [7]


def test_places_along_the_chain() -> None:
    """Ends exact; equal steps of arc length; the tangent is that of the points that were given."""
    chain = biarc_chain(FIVE)
    s = np.linspace(0.0, chain.length, 4001)
    points = chain.at(s)
    assert_allclose(points[[0, -1]], FIVE[[0, -1]], atol=1e-14)
    assert_allclose(np.hypot(*np.diff(points, axis=0).T), s[1], rtol=1e-6)
    steps = np.diff(points, axis=0)
    halfway = chain.direction(0.5 * (s[1:] + s[:-1]))
    assert_allclose(np.arctan2(steps[:, 1], steps[:, 0]), halfway, atol=1e-4)
    ends = np.concatenate([[0.0], np.cumsum(chain.biarcs.lengths)])
    assert_allclose(chain.at(ends), FIVE, atol=1e-14)
    assert_allclose(chain.direction(ends), chain.tangents.leaving_angles, atol=1e-14)


def test_places_keep_their_shape() -> None:
    """A number gives a point; an array of any shape one of points."""
    chain = biarc_chain(FIVE)
    assert chain.at(1.0).shape == (2,)
    assert chain.at(np.ones((2, 3))).shape == (2, 3, 2)
    assert chain.direction(1.0).shape == ()
    assert chain.at([]).shape == (0, 2)


def test_at_a_knuckle_the_arriving_direction_counts() -> None:
    """One corner, two lines."""
    chain = biarc_chain([[0, 0], [2, 0], [2, 3]], knuckles=[1])
    assert chain.direction([1.0, 2.0, 2.001]).tolist() == [0.0, 0.0, np.pi / 2]
    assert chain.at([2.0, 5.0]).tolist() == [[2.0, 0.0], [2.0, 3.0]]


def test_distances_are_from_the_nearest_arc() -> None:
    """Points of the chain have none; points off it the distance along the normal."""
    chain = biarc_chain(wave(9))
    s = np.linspace(0.0, chain.length, 300)
    on, way = chain.at(s), chain.direction(s)
    normal = np.stack([-np.sin(way), np.cos(way)], axis=1)
    assert chain.distances(on).max() < 1e-14
    assert_allclose(chain.distances(on + 0.1 * normal), 0.1, rtol=1e-12)
    assert chain.distances(np.empty((0, 2))).shape == (0,)


def test_the_frame_does_not_matter() -> None:
    """A rotated and moved line has arcs that are so."""
    turn = 0.7
    rotation = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    plain, moved = biarc_chain(wave(9)), biarc_chain(wave(9) @ rotation + [100.0, -40.0])
    assert_allclose(moved.biarcs.joins, plain.biarcs.joins @ rotation + [100.0, -40.0], atol=1e-12)
    assert_allclose(moved.arcs.curvature, plain.arcs.curvature, atol=1e-11)


def test_points_of_a_circle_with_its_end_tangents_give_the_circle() -> None:
    """Every arc has its radius, every interval is one circle, however points are spaced."""
    turns = np.array([0.0, 0.4, 0.5, 1.3, 2.2])
    points = 3.0 * np.stack([np.cos(turns), np.sin(turns)], axis=1)
    chain = biarc_chain(points, start=(0.0, 1.0), end=(-np.sin(2.2), np.cos(2.2)))
    assert set(chain.biarcs.kind.tolist()) == {"circle"}
    assert_allclose(chain.arcs.curvature, 1.0 / 3.0, rtol=1e-12)
    assert_allclose(chain.length, 3.0 * 2.2, rtol=1e-14)


def test_a_least_radius_reaches_every_interval() -> None:
    """No arc of the chain is sharper; the note counts those that were changed."""
    points = [[0.0, 0.0], [4.0, 0.4], [6.0, 2.0], [6.6, 5.0]]
    free = biarc_chain(points)
    least = 1.05 / float(np.abs(free.arcs.curvature).max())
    chain = biarc_chain(points, least_radius=least)
    assert_allclose(np.abs(chain.arcs.curvature).max(), 1.0 / least, rtol=1e-12)
    assert len(chain.notes) == 1


def chain_of_five() -> BiarcChain:
    """The published one."""
    return biarc_chain(FIVE)


WRONG: dict[str, tuple[Callable[[], object], str]] = {
    "before the start": (
        lambda: chain_of_five().at(-0.1),
        "biarc chain: x=-0.1 outside [0, 6.539769452]; ask between these",
    ),
    "direction behind the end": (
        lambda: chain_of_five().direction([1.0, 7.0]),
        "biarc chain: x=7 outside [0, 6.539769452]; ",
    ),
    "place that is no number": (
        lambda: chain_of_five().at(np.nan), "biarc chain: non-finite value at index 0; ",
    ),
    "places of a ragged list": (
        lambda: chain_of_five().at(cast(list[float], [1, [2], 3])),
        "biarc chain: expected shape (...), got no array of numbers; ",
    ),
    "distance of points in space": (
        lambda: chain_of_five().distances([[1, 2, 3]]),
        "biarc chain: expected shape (n, 2), got (1, 3); ",
    ),
    "one point": (lambda: biarc_chain([[0, 0]]), "biarc: at least 2 points; "),
    "a radius beyond reach": (
        lambda: biarc_chain(FIVE, least_radius=9.0), "biarc: r_min=9 not attainable, limit 6.",
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", WRONG)
def test_what_cannot_be_is_refused(case: str) -> None:
    """One line: what is wrong with its numbers, and what to do."""
    call, message = WRONG[case]
    with pytest.raises(GeometryError) as caught:
        call()
    assert str(caught.value).startswith(message)


def test_a_refusal_names_the_interval() -> None:
    """Of a chain, the interval whose radius cannot be had."""
    with pytest.raises(GeometryError) as caught:
        biarc_chain(FIVE, least_radius=[0.0, 0.0, 50.0, 0.0])
    assert caught.value.where == "interval 2"
    assert caught.value.values["index"] == 2
