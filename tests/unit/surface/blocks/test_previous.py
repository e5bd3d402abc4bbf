"""What still holds of an earlier surface: by points, by control points, by options."""

from types import SimpleNamespace
from typing import Any

import attrs
import numpy as np
import pytest

from assoc_hull.geometry.fitting.basis import clamped_knots
from assoc_hull.geometry.fitting.fit_input import Samples
from assoc_hull.geometry.fitting.fit_surface import SurfaceFit, even_breaks
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.surface.blocks.block_layout import HullBlock, SideStretch
from assoc_hull.surface.blocks.fit_net import (
    arrays_near,
    block_unmoved,
    earlier_of,
    settle_controls,
    share_kept,
)
from assoc_hull.surface.blocks.fit_options import fit_options

CUTOFF = 1e-7
NAMES = ("WL 1", "ST 1", "WL 2")


def a_block(**other: Any) -> HullBlock:
    """A block of four points on two lines."""
    uv = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]])
    point = np.column_stack([uv, np.zeros(4)])
    given: dict[str, Any] = {
        "name": "bow",
        "kind": "bow",
        "extent": np.array([[0.0, 1.0], [0.0, 1.0]]),
        "reach": np.array([[0.0, 1.0], [0.0, 1.0]]),
        "samples": Samples.of(uv, point, 1.0, np.array([0, 0, 2, 2])),
        "inside": np.ones(4, np.bool_),
        "sides": {"u0": (SideStretch(0.0, 1.0, False, "body", "u1", 0.0, 1.0),)},
        "stations": np.array([0.5]),
        "levels": np.array([0.5]),
        "corners": np.zeros((4, 3)),
        "turns": np.full(4, 90.0),
        "singular": (),
        "notes": (),
    }
    return HullBlock(**(given | other))


def moved(block: HullBlock, **by: float) -> HullBlock:
    """The block with one number of its points, or of itself, moved."""
    ((name, step),) = by.items()
    if hasattr(block, name):
        return attrs.evolve(block, **{name: getattr(block, name) + step})
    value = getattr(block.samples, name).copy()
    value.flat[0] += step
    return attrs.evolve(block, samples=attrs.evolve(block.samples, **{name: value}))


@pytest.mark.parametrize("name", ["uv", "weight", "extent", "reach", "stations", "levels"])
def test_without_cutoff_all_that_a_fit_depends_on_counts(name: str) -> None:
    """The last bit of any of them asks for a new fit with a cut-off of 0, and not with another."""
    old = a_block()
    new = moved(old, **{name: 1e-12})
    assert block_unmoved(old, NAMES, a_block(), NAMES, 0.0)
    assert not block_unmoved(new, NAMES, old, NAMES, 0.0)
    assert block_unmoved(new, NAMES, old, NAMES, CUTOFF)


def test_points_count_by_how_far_they_moved() -> None:
    """A point within the cut-off is where it was, one beyond it is not."""
    old = a_block()
    assert block_unmoved(moved(old, point=0.9 * CUTOFF), NAMES, old, NAMES, CUTOFF)
    assert not block_unmoved(moved(old, point=1.1 * CUTOFF), NAMES, old, NAMES, CUTOFF)
    assert not block_unmoved(moved(old, point=1e-15), NAMES, old, NAMES, 0.0)


def test_moves_add_up() -> None:
    """The points of the fit are compared, not those of the last edit: small steps do not drift."""
    old = a_block()
    steps = [moved(old, point=0.3 * number * CUTOFF) for number in range(1, 6)]
    kept = [block_unmoved(step, NAMES, old, NAMES, CUTOFF) for step in steps]
    assert kept == [True, True, True, False, False]


def test_lines_count_by_name() -> None:
    """Other numbers of the same lines are no change; another line with the same number is one."""
    old = a_block()
    again = attrs.evolve(old.samples, line=np.array([1, 1, 2, 2]))
    renamed = ("ST 1", "WL 1", "WL 2")
    assert block_unmoved(attrs.evolve(old, samples=again), renamed, old, NAMES, CUTOFF)
    assert not block_unmoved(old, renamed, old, NAMES, CUTOFF)


@pytest.mark.parametrize(
    "other",
    [
        pytest.param({"sides": {"u0": (SideStretch(0.0, 1.0, True),)}}, id="another side"),
        pytest.param({"inside": np.array([True, True, True, False])}, id="a point outside"),
        pytest.param(
            {"samples": Samples.of(np.zeros((3, 2)), np.zeros((3, 3)))}, id="fewer points"
        ),
        pytest.param({"samples": Samples.of(np.zeros((0, 2)), np.zeros((0, 3)))}, id="no points"),
    ],
)
def test_a_block_of_other_structure_is_another_block(other: dict[str, Any]) -> None:
    """Sides, neighbours and the number of points count with any cut-off."""
    assert not block_unmoved(a_block(**other), NAMES, a_block(), NAMES, 1.0)


def a_fit(shift: float = 0.0, only: tuple[int, int] | None = None, knot: float = 0.0) -> SurfaceFit:
    """A plane of 6 by 6 spans, one control point or all of them moved."""
    breaks = even_breaks(0.0, 6.0, 6)
    breaks[1] += knot
    knots = clamped_knots(breaks)
    net = np.zeros((9, 9, 3))
    net[..., 0], net[..., 1] = np.mgrid[0:9, 0:9]
    net[only if only else ...] += [0.0, 0.0, shift]
    samples = Samples.of(np.zeros((1, 2)), np.zeros((1, 3)))
    return SurfaceFit(SplineSurface("plane", (3, 3), knots, knots, net), samples, np.zeros(1), 1.0)


def test_control_points_that_hardly_moved_keep_their_bits() -> None:
    """One that moved further takes its new place; the others, and all patches but its own, stay."""
    old = a_fit().surface
    new = a_fit(0.4 * CUTOFF)
    net = new.surface.net.copy()
    net[0, 0, 2] = 0.5
    new = attrs.evolve(new, surface=SplineSurface("", (3, 3), old.knots_u, old.knots_v, net))
    found = settle_controls(new, old, CUTOFF).surface
    assert found.net[0, 0, 2] == 0.5
    assert (found.net.reshape(-1, 3)[1:] == old.net.reshape(-1, 3)[1:]).all()
    assert share_kept([found], [old]) == 35 / 36


def test_published_control_points_never_drift() -> None:
    """However many small steps are settled, each is within the cut-off of the fit of its step."""
    published = a_fit().surface
    for step in range(1, 12):
        new = a_fit(0.3 * step * CUTOFF)
        published = settle_controls(new, published, CUTOFF).surface
        assert np.abs(published.net - new.surface.net).max() < CUTOFF
    assert published.net[0, 0, 2] == 0.3 * 8 * CUTOFF


@pytest.mark.parametrize(
    ("new", "cutoff", "borders"),
    [
        pytest.param(a_fit(0.4 * CUTOFF), 0.0, (), id="no cut-off"),
        pytest.param(a_fit(0.4 * CUTOFF, knot=2 * CUTOFF), CUTOFF, (), id="other knots"),
    ],
)
def test_nothing_is_kept_without_cutoff_or_on_other_knots(
    new: SurfaceFit, cutoff: float, borders: tuple[str, ...]
) -> None:
    """The fit itself is given then."""
    assert settle_controls(new, a_fit().surface, cutoff, borders) is new


def test_rows_at_masters_are_left_to_them() -> None:
    """The border and the row behind it stay as they were joined, to the bit."""
    old, new = a_fit().surface, a_fit(0.4 * CUTOFF)
    found = settle_controls(new, old, CUTOFF, ("u1", "v0")).surface.net
    fresh = np.zeros((9, 9), np.bool_)
    fresh[-2:] = fresh[:, :2] = True
    assert ((found[..., 2] == 0.4 * CUTOFF) == fresh).all()
    assert ((found[..., 2] == 0.0) == ~fresh).all()


def test_near_is_by_amount_or_by_bit() -> None:
    """Shapes count; the sign of nil counts only where all bits do."""
    one = np.zeros(3)
    assert arrays_near(one, one + 1e-8, CUTOFF)
    assert not arrays_near(one, np.zeros(4), CUTOFF)
    assert arrays_near(one, -one, CUTOFF)
    assert not arrays_near(one, -one, 0.0)


def test_only_a_surface_of_the_same_options_is_of_use() -> None:
    """Another penalty, tolerance or lines left out give nothing; another cut-off does."""
    past: Any = SimpleNamespace(
        left_out=("WL 1",), options=fit_options(100.0), blocks=(), net=SimpleNamespace(name=NAMES)
    )
    same = fit_options(100.0, cutoff=0.0)
    assert earlier_of(past, same, ("WL 1",)) is not None
    assert earlier_of(past, same, ()) is None
    assert earlier_of(past, fit_options(100.0, tolerance=0.1), ("WL 1",)) is None
    assert earlier_of(None, same, ("WL 1",)) is None
