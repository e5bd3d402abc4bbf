"""Ends of lines beyond their last crossing: which they are, and where on a block they lie."""

from collections.abc import Callable

import attrs
import numpy as np
import pytest

from assoc_hull.analysis.net.curve_net import gather_net
from assoc_hull.geometry.fitting.fit_input import Samples
from assoc_hull.hull import Hull
from assoc_hull.surface.blocks.block_layout import (
    HullBlock,
    LooseEnds,
    lay_out,
    loose_ends,
    with_loose_ends,
)
from assoc_hull.surface.cells.net_graph import net_graph

LENGTH = 300.0  # m, of the carrier
TIP = (21.0, 0.252, 0.0)  # m, where her flat of bottom ends, on no other line


@pytest.fixture(scope="module")
def carrier(shipped: Callable[[str], Hull]) -> Hull:
    """A carrier of its own."""
    return shipped("bulk_carrier")


def test_the_end_of_a_flat_is_loose(carrier: Hull) -> None:
    """Points at even steps to the tip stand for its length; the crossing it begins at is none."""
    graph = net_graph(gather_net(carrier.state))
    found = loose_ends(graph, LENGTH)
    assert {graph.net.name[line] for line in found.line.tolist()} == {"flat of bottom"}
    assert np.abs(found.point[-1] - TIP).max() < 1e-4
    away = np.sqrt(((found.point[:, None] - graph.place) ** 2).sum(axis=-1)).min()
    assert 0.1 < away < 0.3
    step = np.linalg.norm(np.diff(found.point, axis=0), axis=1)
    assert found.weight.sum() == pytest.approx(step.sum() + 0.5 * away, rel=0.01)


def test_a_block_has_the_points_of_loose_ends(carrier: Hull) -> None:
    """They lie on the block, are free, and are measured with the others."""
    blocks = {block.name: block for block in lay_out(gather_net(carrier.state), LENGTH)}
    boss = blocks["stern boss"]
    away = np.linalg.norm(boss.samples.point - TIP, axis=1)
    last = int(away.argmin())
    assert away[last] < 1e-4
    assert boss.inside[last]
    assert not boss.samples.held[last].any()
    uv, (low, high) = boss.samples.uv[last], boss.extent.T
    assert (low < uv).all()
    assert (uv < high).all()


def test_parameters_are_those_of_the_neighbourhood(carrier: Hull) -> None:
    """Points that are taken from a block come back with their parameters, to half a metre."""
    body, *others = lay_out(gather_net(carrier.state), LENGTH)
    samples = body.samples
    middle = np.abs(samples.uv - body.extent.mean(axis=1)) < 0.3 * np.ptp(body.extent, axis=1)
    gone = np.flatnonzero(body.inside & middle.all(axis=1))[::500]
    assert len(gone) > 5
    point, line = samples.point[gone], samples.line[gone]
    loose = LooseEnds(point, np.ones(len(gone)), line)
    found, *same = with_loose_ends([without(body, gone), *others], loose, 2.0**-7)
    assert all(one is other for one, other in zip(same, others, strict=True))
    assert len(found.samples) == len(samples)
    back = found.samples.uv[-len(gone) :]
    assert np.abs(back - samples.uv[gone]).max() < 0.5
    assert (back * 2.0**7 == np.round(back * 2.0**7)).all()


def without(block: HullBlock, gone: np.typing.NDArray[np.int64]) -> HullBlock:
    """A block that lacks some of its points."""
    kept = np.setdiff1d(np.arange(len(block.samples)), gone)
    samples = Samples(*(each[kept] for each in attrs.astuple(block.samples, recurse=False)))
    return attrs.evolve(block, samples=samples, inside=block.inside[kept])
