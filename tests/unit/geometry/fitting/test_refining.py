"""Knots where they are wanted, and what surfaces are measured by."""

import numpy as np
import pytest

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.fitting.basis import clamped_knots
from assoc_hull.geometry.fitting.fit_input import HeldControls, Samples
from assoc_hull.geometry.fitting.fit_surface import (
    SurfaceFit,
    checked_breaks,
    even_breaks,
    fit_refined,
    fit_surface,
    halve_spans,
    spans_to_halve,
    subdivide_bays,
)
from assoc_hull.geometry.fitting.folds import surface_elements
from assoc_hull.geometry.patches.spline_surface import SplineSurface


def wavy(count: int = 41) -> Samples:
    """A strip 8 m long, flat but for a wave in its last fourth."""
    x, y = (
        each.ravel() for each in np.meshgrid(np.linspace(0, 8, 2 * count), np.linspace(0, 2, 9))
    )
    wave = np.where(x > 6.0, 0.3 * np.sin(1.5 * (x - 6.0)) ** 3, 0.0)
    return Samples.of(np.column_stack([x, y]), np.column_stack([x, y, wave]))


def refined(samples: Samples, passes: int = 4) -> SurfaceFit:
    """A fit of the wave with 1 cm of tolerance, on few spans at first."""
    return fit_refined(
        "wave", samples, even_breaks(0, 8, 4), even_breaks(0, 2, 1), 1e-9, 0.01, passes=passes,
        held=lambda u, v: HeldControls.none((len(u) + 2, len(v) + 2)).on("u0", 0.0, axes=(2,)),
    )  # fmt: skip


def test_spans_are_halved_where_the_surface_does_not_follow() -> None:
    """Knots come near the wave, the flat part keeps its spans; what is held follows the knots."""
    found = refined(wavy())
    breaks = found.surface.knots_u[3:-3]
    assert np.percentile(found.residual, 95) < 0.01
    assert np.diff(breaks[breaks <= 3.0]).min() >= 1.0
    assert np.diff(breaks[breaks >= 6.0]).max() <= 0.5
    assert (found.surface.net[0, :, 2] == 0.0).all()
    assert found.spans[1] == 1


def test_halving_ends_with_the_passes_or_the_points() -> None:
    """No pass gives the plain fit; there are never more control points than points."""
    plain = fit_surface("wave", wavy(), even_breaks(0, 8, 4), even_breaks(0, 2, 1), 1e-9)
    assert refined(wavy(), 0).spans == plain.spans == (4, 1)
    few = fit_refined(
        "wave", wavy(), even_breaks(0, 8, 4), even_breaks(0, 2, 1), 1e-9, 1e-9, passes=12
    )
    assert len(few.samples) // 4 < len(few.surface.net.reshape(-1, 3)) <= len(few.samples)


def test_a_span_is_halved_for_more_than_one_point_in_twenty() -> None:
    """Of spans with points in both halves those with over 5 % of their points off are halved."""
    at = np.concatenate([np.linspace(0.0, 0.99, 40), np.linspace(1.0, 1.4, 40), [2.5]])
    off = np.zeros(81)
    off[[0, 1, 40, 41, 42, 43, 80]] = 1.0
    assert spans_to_halve(even_breaks(0, 3, 3), at, off, 0.5).tolist() == [False, False, False]
    off[2] = 1.0
    assert spans_to_halve(even_breaks(0, 3, 3), at, off, 0.5).tolist() == [True, False, False]


def test_breaks_keep_the_places_they_were_made_from() -> None:
    """Given places are found among the parts to the last bit; doubled ones stay doubled."""
    places = np.array([0.1, 0.7, 0.7, 2.3])
    assert subdivide_bays(places, np.array([3, 1, 2])).tolist() == pytest.approx(
        [0.1, 0.3, 0.5, 0.7, 0.7, 1.5, 2.3]
    )
    found = halve_spans(places, np.array([False, True, True]))
    assert set(places.tolist()) <= set(found.tolist())
    assert found == pytest.approx([0.1, 0.7, 0.7, 1.5, 2.3])


def test_a_place_repeated_four_times_is_refused() -> None:
    """A spline torn apart is no surface; three times is a knuckle."""
    assert len(checked_breaks(np.array([0.0, 1, 1, 1, 2]), "breaks_u", "here")) == 5
    with pytest.raises(BadInputError, match="repeats a place four times"):
        checked_breaks(np.array([0.0, 1, 1, 1, 1, 2]), "breaks_u", "here")


def graph(height: object) -> SplineSurface:
    """A surface over the unit square of its parameters, 4 by 4 spans, with given heights."""
    knots = clamped_knots(even_breaks(0.0, 1.0, 4))
    own = np.mean([knots[i : i + 7] for i in (1, 2, 3)], axis=0)
    u, v = np.meshgrid(own, own, indexing="ij")
    return SplineSurface("graph", (3, 3), knots, knots, np.stack([u, v, u * v + height], axis=-1))


def test_elements_are_those_of_the_formula() -> None:
    """For z = u v the element is the root of 1 + u^2 + v^2: least at the origin."""
    found = surface_elements(graph(0.0))
    u, v = np.meshgrid(found.u, found.v, indexing="ij")
    size = np.sqrt(1.0 + u * u + v * v)
    assert np.linalg.norm(found.normal, axis=-1) == pytest.approx(size, abs=1e-12)
    assert found.least == pytest.approx(1.0 / np.median(size), rel=1e-12)
    assert found.place == (0.0, 0.0)
    assert (len(found.folded), found.singular) == (0, ())


@pytest.mark.parametrize("axis", [0, 1])
def test_a_fold_is_found_where_it_is(axis: int) -> None:
    """A row of control points pulled past the next one folds the surface there, and only there."""
    net = graph(0.0).net.copy()
    net[(slice(None),) * axis + (3,)] += 0.6 * np.eye(3)[axis]
    given = graph(0.0)
    found = surface_elements(SplineSurface("folded", (3, 3), given.knots_u, given.knots_v, net))
    assert len(found.folded) > 0
    assert 0.25 < found.folded[:, axis].min() < found.folded[:, axis].max() < 0.95
    assert found.least < 0.2


def test_a_corner_whose_sides_are_tangent_is_singular() -> None:
    """Where three control points of a corner lie in line there is no normal, and it is named."""
    net = graph(0.0).net.copy()
    net[0, 1] = net[0, 0] + [-0.1, 0.0, 0.0]
    net[1, 0] = net[0, 0] + [0.1, 0.0, 0.0]
    given = graph(0.0)
    found = surface_elements(SplineSurface("corner", (3, 3), given.knots_u, given.knots_v, net))
    assert found.singular == ((0.0, 0.0),)
    assert found.place == (0.0, 0.0)
    assert found.least < 1e-12
