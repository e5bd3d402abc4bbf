"""A surface follows an edit: blocks whose lines stayed are taken over to the last bit."""

from collections.abc import Callable, Iterator

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.hull import Hull
from assoc_hull.hull.results import HullSurface
from assoc_hull.surface.blocks.fit_net import share_kept
from assoc_hull.surface.blocks.fitted_surface import FittedBlock
from tests.long_forms import long_form

STAYED = ("stern counter", "stern boss", "body")


def bits(block: FittedBlock) -> bytes:
    """All bits of a block's surface."""
    surface = block.surface
    return surface.knots_u.tobytes() + surface.knots_v.tobytes() + surface.net.tobytes()


@attrs.frozen
class Story:
    """The surface of the carrier, and that after her bow was pulled by 2 cm."""

    before: HullSurface
    same: HullSurface
    after: HullSurface


@pytest.fixture(scope="module")
def story(bulk_carrier: Hull, surface_of: Callable[[Hull], HullSurface]) -> Iterator[Story]:
    """Before the pull, nothing pulled, then with a cut-off."""
    before = surface_of(bulk_carrier)
    same = bulk_carrier.surface(previous=before, cutoff=0.0)
    with bulk_carrier.edit("pull") as edit:
        edit.pull("WL 8 x ST 20.175", d=0.02, radius=(4.0, 3.0))
    yield Story(before, same, bulk_carrier.surface(previous=before))
    bulk_carrier.undo()


@pytest.fixture(scope="module")
def scratch(story: Story, bulk_carrier: Hull) -> HullSurface:
    """After the pull, which the story has made, from scratch."""
    assert story.after is not story.before
    return bulk_carrier.surface()


def test_a_surface_of_lines_that_stayed_is_the_earlier_one(story: Story) -> None:
    """Nothing is fitted, and not a bit changes, where no line has moved."""
    assert story.before.refitted == tuple(block.name for block in story.before.blocks)
    assert story.same.refitted == ()
    assert [bits(b) for b in story.same.blocks] == [bits(b) for b in story.before.blocks]
    assert story.same.borders == story.before.borders


def test_a_pull_in_the_bow_leaves_stern_and_body_bit_for_bit(story: Story) -> None:
    """Exactly the bow is fitted again, though waterlines are splines and ripple to the stern."""
    assert story.after.refitted == ("bow",)
    old = {block.name: block for block in story.before.blocks}
    new = {block.name: block for block in story.after.blocks}
    assert [bits(new[name]) == bits(old[name]) for name in STAYED] == [True] * 3
    assert bits(new["bow"]) != bits(old["bow"])
    assert np.abs(new["bow"].surface.net - old["bow"].surface.net).max() > 0.01
    # The joint holds as before: the body's row, and its tangent planes.
    border = next(each for each in story.after.borders if "bow" in each.names)
    assert border.joined_gap < 1e-12
    assert border.angle[2] < 0.1


@long_form
def test_without_a_cutoff_it_is_the_surface_from_scratch(
    story: Story, scratch: HullSurface, bulk_carrier: Hull
) -> None:
    """Blocks taken over with a cut-off of 0 are those that would be fitted, in every bit.

    A walk of edits on a Wigley hull, below, says so always.
    """
    exact = bulk_carrier.surface(previous=story.before, cutoff=0.0)
    assert {"body", "bow"} <= set(exact.refitted) < set(story.before.refitted)
    assert [bits(b) for b in exact.blocks] == [bits(b) for b in scratch.blocks]
    assert exact.borders[0].gap.tolist() == scratch.borders[0].gap.tolist()


@long_form
def test_with_a_cutoff_it_stays_beside_the_surface_from_scratch(
    story: Story, scratch: HullSurface
) -> None:
    """Control points stay within the cut-off of where a fit from scratch puts them."""
    for one, other in zip(story.after.blocks, scratch.blocks, strict=True):
        assert np.abs(one.surface.net - other.surface.net).max() < 1e-7
    assert share_kept(story.after.patches[:3], story.before.patches) == 1.0


def test_a_walk_of_edits_never_drifts() -> None:
    """After moves far below, about and above the cut-off a surface is that from scratch within it.

    Points may have moved by the cut-off since the fit, and control points be off by as much again.
    """
    hull = ah.examples.wigley(stations=5, waterlines=4)
    found = hull.surface()
    fitted = []
    for point, d in (
        ("ST 2", 6e-8),
        ("ST 3", 1e-3),
        ("ST 2", 6e-8),
        ("ST 2", 6e-8),
        ("ST 2", 6e-8),
    ):
        with hull.edit("walk") as edit:
            edit.pull(f"WL 4.16667 x {point}", d=d, radius=(8.0, 2.0))
        found = hull.surface(previous=found)
        fitted.append(bool(found.refitted))
        scratch = hull.surface()
        away = [a.net - b.net for a, b in zip(found.patches, scratch.patches, strict=True)]
        assert max(np.abs(each).max() for each in away) < 2e-7
    exact = hull.surface(previous=found, cutoff=0.0)
    assert [bits(b) for b in exact.blocks] == [bits(b) for b in scratch.blocks]
    assert fitted[:3] == [False, True, False]
    assert any(fitted[3:])


def test_curvature_regions_follow_to_a_millionth() -> None:
    """Regions are taken over where patches were kept; areas agree with those from scratch."""
    hull = ah.examples.wigley(stations=5, waterlines=4)
    before = hull.surface()
    known = ah.surface.curvature_regions(before.patches, zero="absolute", k0=1e-4)
    with hull.edit("pull") as edit:
        edit.pull("WL 4.16667 x ST 3", d=1e-5, radius=(8.0, 2.0))
    after, scratch = hull.surface(previous=before), hull.surface()
    kept = share_kept(after.patches, before.patches)
    follows = ah.surface.curvature_regions(after.patches, zero="absolute", k0=1e-4, previous=known)
    afresh = ah.surface.curvature_regions(scratch.patches, zero="absolute", k0=1e-4)
    assert follows.computed == round((1.0 - kept) * afresh.computed) < afresh.computed
    expected = attrs.astuple(afresh.areas)
    assert attrs.astuple(follows.areas) == pytest.approx(expected, abs=1e-6 * afresh.areas.total)
    assert follows.areas != known.areas
