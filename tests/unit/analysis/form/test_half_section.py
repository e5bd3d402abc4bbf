"""Half sections anywhere along a hull."""

import numpy as np
import pytest

from assoc_hull.analysis.form.half_section import half_section
from assoc_hull.analysis.hydrostatics.flotation import flotation
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.geometry.floating.sections import areas_at
from assoc_hull.geometry.integrals.area_moments import section_area
from assoc_hull.hull import Hull
from assoc_hull.hull.sources import examples


def test_a_section_between_stations_is_one_curve_from_keel_to_deck() -> None:
    """Wigley's at x = 33: upward, without the deck, with the offsets of the formula."""
    section = half_section(flotation(examples.wigley().state), 33.0)
    assert section is not None
    assert section.count == 1
    x, y, z = section.xyz.T
    assert (x == 33.0).all()
    assert (np.diff(z) > 0.0).all()
    up = np.minimum(z / 6.25 - 1.0, 0.0)
    assert y == pytest.approx(5.0 * (1.0 - 0.34**2) * (1.0 - up * up), abs=1e-4)


def test_beyond_the_ends_there_is_none() -> None:
    """No section, rather than an empty one."""
    body = flotation(examples.wigley().state)
    assert half_section(body, -0.5) is None
    assert half_section(body, 100.5) is None


@pytest.mark.parametrize("x", [8.5, 297.0, 300.0, 305.0])
def test_a_section_has_the_area_of_the_surface_there(bulk_carrier: Hull, x: float) -> None:
    """Before and at a drawn station, and where the surface is traced, as a spline too."""
    body, height = flotation(bulk_carrier.state), 12.0
    section = half_section(body, x)
    assert section is not None
    plane = FloatingPlanes(np.array([height]), np.zeros(1), np.zeros(1))
    area = 2.0 * float(section_area(section, height).sum())
    assert area == pytest.approx(float(areas_at(body.spans, np.array([x]), plane)[0]), rel=1e-9)
