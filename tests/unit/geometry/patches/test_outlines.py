"""Outlines of regions: closed, the region on the left, adding up to the whole patch."""

import numpy as np
import pytest

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.cells import CellKind
from assoc_hull.geometry.patches.outlines import (
    Outlines,
    SignRegion,
    outlines_of_region,
    outlines_of_rest,
)
from assoc_hull.geometry.patches.zero_set_arcs import sample_arcs
from tests.curved_patches import graph_plates, patch, random_nets
from tests.unit.geometry.patches.isolines import monkey
from tests.unit.geometry.patches.joined_lines import Joined, join, join_nets
from tests.unit.geometry.patches.test_joining import spline

REGIONS = CellKind.POSITIVE, CellKind.NEGATIVE, CellKind.ZERO, CellKind.UNRESOLVED


def drawn(found: Joined, kind: CellKind, chord_tol: float = 1e-3, across: bool = False) -> Outlines:
    """The outlines of a region with sampled arcs."""
    samples = sample_arcs(found.patches, found.cells, found.arcs, chord_tol)
    return outlines_of_region(
        found.patches, SignRegion(found.cells, found.arcs, kind, samples), across
    )


def enclosed(found: Joined, kind: CellKind) -> FloatArray:
    """What the outlines of a region enclose of each patch."""
    lines = drawn(found, kind)
    sums = np.zeros(len(found.patches))
    np.add.at(sums, lines.patch, lines.enclosed)
    return sums


@pytest.mark.parametrize(
    "nets",
    [graph_plates(20, 1), random_nets(6, 2), patch("P07_double_cross")[None]],
    ids=["plates", "nets", "a line of undecided cells"],
)
@pytest.mark.parametrize("known_to", [0.0, 1e-9], ids=["to rounding", "to 1 nm"])
def test_outlines_add_up_to_the_patch(nets: FloatArray, known_to: float) -> None:
    """What the four regions enclose is the unit square of every patch, to rounding.

    Chords of arcs are the same from both sides, so this holds for the coarsest of them.
    """
    found = join_nets(nets, known_to)
    total = np.sum([enclosed(found, kind) for kind in REGIONS], axis=0)
    assert np.abs(total - 1.0).max() < 1e-14


def test_a_hole_is_a_loop_of_its_own() -> None:
    """Round a convex disc the saddle region has two loops: the patch, and the disc backward."""
    found = join_nets(monkey(0.5)[None])
    (disc,) = drawn(found, CellKind.POSITIVE).enclosed
    outer, inner = drawn(found, CellKind.NEGATIVE).enclosed
    assert outer == 1.0
    assert inner == pytest.approx(-disc, rel=1e-14)
    # The patch is 1.8 by 1.6.
    assert disc == pytest.approx(np.pi * 0.5**2 / (1.8 * 1.6), rel=2e-3)


def test_outlines_converge_to_the_region() -> None:
    """The area of the polygon about a disc comes nearer with finer chords, as their height."""
    found = join_nets(monkey(0.5)[None])
    exact = np.pi * 0.5**2 / (1.8 * 1.6)
    errors = [
        exact - float(drawn(found, CellKind.POSITIVE, tol).enclosed[0]) for tol in (1e-3, 1e-5)
    ]
    assert 0.0 < errors[1] < 0.05 * errors[0] < 1e-4
    assert errors[1] < 1e-5


def test_loops_that_touch_keep_to_their_side() -> None:
    """At a crossing each positive quarter is a loop of its own; none runs through another."""
    found = join_nets(patch("P05_cross")[None])
    for kind in (CellKind.POSITIVE, CellKind.NEGATIVE):
        lines = drawn(found, kind)
        assert len(lines) == 2
        assert (lines.enclosed > 0.0).all()


def test_outlines_merged_across_patches() -> None:
    """Merged, the regions of a surface enclose what they do patch by patch, in fewer loops."""
    found = join(spline(3).patches())
    size = 0.0
    for kind in (CellKind.POSITIVE, CellKind.NEGATIVE):
        alone, merged = drawn(found, kind), drawn(found, kind, across=True)
        assert len(merged) < len(alone)
        size += merged.enclosed.sum()
        assert merged.enclosed.sum() == pytest.approx(alone.enclosed.sum(), abs=1e-12)
    assert size == pytest.approx(3.0 * 5.0, abs=1e-12)


def test_outlines_of_a_patch_do_not_depend_on_the_batch() -> None:
    """Corners, to the last bit of the patch's own parameters, are the same one by one."""
    nets = graph_plates(5, 3)
    together = drawn(join_nets(nets), CellKind.POSITIVE)
    for k, net in enumerate(nets):
        alone = drawn(join_nets(net[None]), CellKind.POSITIVE)
        mine = np.flatnonzero(together.patch == k)
        assert len(mine) == len(alone)
        for i, loop in enumerate(mine.tolist()):
            np.testing.assert_allclose(together.loop(loop), alone.loop(i), rtol=0.0, atol=1e-14)


@pytest.mark.parametrize("across", [False, True], ids=["patch by patch", "merged"])
def test_what_a_band_leaves(across: bool) -> None:
    """Where the curvature lies within a band, beside what lies above it and what below."""
    patches = spline(3).patches()
    size, taken = 0.0, []
    for level, kind in ((0.02, CellKind.POSITIVE), (-0.02, CellKind.NEGATIVE)):
        found = join(patches, level)
        samples = sample_arcs(patches, found.cells, found.arcs, 1e-3)
        taken.append(SignRegion(found.cells, found.arcs, kind, samples))
        size += outlines_of_region(patches, taken[-1], across).enclosed.sum()
    band = outlines_of_rest(patches, taken, across)
    assert size + band.enclosed.sum() == pytest.approx(15.0, abs=1e-12)
    assert 0.2 < band.enclosed.sum() < 10.0
    assert outlines_of_rest(patches, [], True).enclosed.tolist() == [15.0]


def test_a_region_that_is_not_there_has_no_outline() -> None:
    """A saddle has no convex region."""
    found = drawn(join_nets(patch("P11_hypar")[None]), CellKind.POSITIVE)
    assert len(found) == 0
    assert found.enclosed.tolist() == []
