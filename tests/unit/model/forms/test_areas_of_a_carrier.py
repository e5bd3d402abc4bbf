"""Curves of areas with the parameters that Versluis's carrier was fitted with, number by number.

Kim & Kang 1992 print Versluis's section areas beside those of their own hull. Designs whose area
and centroid of the run were fitted show what the curve can do; the one with rounded numbers is
that of the example.
"""

from __future__ import annotations

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.geometry.integrals.stations import integrate_by_simpson
from assoc_hull.model.forms.closure import coefficients
from assoc_hull.model.forms.form_values import chain_of
from tests.cases import versluis

SHIP = ah.Particulars("carrier", versluis.LPP, versluis.BREADTH, 15.8, versluis.DRAUGHT)
FULL = 292.59

KIM_AREAS = np.array([
    6.02, 16.29, 41.97, 69.91, 100.97, 164.81, 221.56, 262.61, 283.99, 290.85, 292.15, 292.13,
    292.14, 292.13, 292.13, 292.19, 291.52, 285.20, 261.66, 215.76, 150.39, 112.38, 72.26, 31.71,
    0.0,
])  # fmt: skip
KIM_MOMENTS = np.array([
    58.55, 149.07, 313.24, 484.65, 665.49, 1013.34, 1289.92, 1460.02, 1528.07, 1541.45, 1542.94,
    1542.92, 1542.92, 1542.92, 1542.92, 1542.97, 1542.45, 1528.48, 1433.49, 1215.19, 873.28,
    664.0, 438.71, 205.97, 0.0,
])  # fmt: skip
"""Areas (m2) and moments (m3) of the hull of Kim & Kang at Versluis's stations."""

DESIGNS = {
    "free fit": (
        (-0.21089637, 0.0, -30.0, 0.03336, 0.30285, 0.50808021, -0.48976913),
        (0.33954775, -54.177, 4.601, 0.21720, 0.09075), (0.23, 0.50),
    ),
    "curvature of the start kept": (
        (-0.21016503, 0.0, 0.0, 0.04046, 0.30219, 0.50880648, -0.48938635),
        (0.33922533, -55.098, 4.178, 0.21705, 0.10185), (0.23, 0.57),
    ),
    "angle of 25 degrees": (
        (-0.20771834, 25.0, 0.0, 0.06714, 0.29816, 0.51119719, -0.48817717),
        (0.33980880, -54.027, 0.0, 0.22239, 0.05283), (0.36, 1.40),
    ),
    "rounded": (
        (-0.208, 25.0, 0.0, 0.067, 0.298, 0.511, -0.488),
        (0.34, -54.0, 0.0, 0.222, 0.053), (0.60, 1.72),
    ),
}  # fmt: skip
"""Run, entrance, and how far areas are off at the stations: root mean square and most, m2."""


def areas_of(run: tuple[float, ...], entrance: tuple[float, ...]) -> ah.creation.FormDefinition:
    """Close a curve of areas at CB 0.75, LCB 2.90 m forward of midship."""
    names = (
        "run_end", "run_start_angle_deg", "run_start_curvature", "run_start_tangent",
        "run_end_tangent", "run_area", "run_centroid",
    )  # fmt: skip
    fore = (
        "entrance_start", "entrance_end_angle_deg", "entrance_end_curvature",
        "entrance_start_tangent", "entrance_end_tangent",
    )  # fmt: skip
    values = {**dict(zip(names, run, strict=True)), **dict(zip(fore, entrance, strict=True))}
    return ah.creation.sectional_area(
        SHIP, name="areas", cm=FULL / (SHIP.breadth * SHIP.draught), cb=0.75, lcb=2.90,
        run_start_ordinate=6.08 / FULL, **values,
    )  # fmt: skip


@pytest.mark.parametrize("name", DESIGNS)
def test_areas_are_as_far_off_as_they_are_printed(name: str) -> None:
    """CB and LCB exactly; the areas at all 25 stations to the printed digits."""
    run, entrance, off = DESIGNS[name]
    definition = areas_of(run, entrance)
    closed = coefficients(definition, SHIP)
    assert closed.block == pytest.approx(0.75, abs=1e-12)
    assert closed.centroid == pytest.approx(2.90, abs=1e-12)
    errors = chain_of(definition, SHIP).ordinate(versluis.X) - versluis.AREAS
    found = np.sqrt(np.mean(errors**2)), np.abs(errors).max()
    # Tangents are printed to five digits: of the areas that moves the last digit.
    assert found == pytest.approx(off, abs=0.006)


def test_the_hull_of_kim_and_kang_has_its_values_to_the_last_digit() -> None:
    """V 39,623.6 m3, CB .748746, LCB 2.921 m forward of midship, KB 5.488 m."""
    x, areas = versluis.X, KIM_AREAS
    columns = np.stack([areas, areas * x, KIM_MOMENTS], axis=1)
    volume, lengthwise, upward = integrate_by_simpson(x, columns).tolist()
    box = versluis.LPP * versluis.BREADTH * versluis.DRAUGHT
    assert f"{volume:.1f}" == "39623.6"
    assert f"{volume / box:.6f}" == "0.748746"
    assert f"{lengthwise / volume - versluis.LPP / 2.0:.3f}" == "2.921"
    assert f"{upward / volume:.3f}" == "5.488"


def test_the_hull_of_kim_and_kang_is_near_that_of_versluis() -> None:
    """Areas amidships 0.154 % less, 0.25 % more at the second station; moments within 0.18 %."""
    off = KIM_AREAS[:-1] / versluis.AREAS[:-1] - 1.0
    assert f"{100.0 * off[11]:.3f}" == "-0.154"
    assert f"{100.0 * np.abs(off[1:]).max():.2f}" == "0.25"
    assert f"{100.0 * off[0]:.1f}" == "-1.0"
    moments = KIM_MOMENTS[1:-1] / versluis.MOMENTS[1:-1] - 1.0
    assert f"{100.0 * np.abs(moments).max():.2f}" == "0.18"


def test_a_section_of_flats_and_a_bilge_has_its_moment() -> None:
    """B 28 m, T 10.5 m, radius 1.8125 m: 292.59 m2, 1542.929 m3."""
    radius, breadth, draught = 1.8125, versluis.BREADTH, versluis.DRAUGHT
    corner = (1.0 - np.pi / 4.0) * radius**2
    area = breadth * draught - 2.0 * corner
    moment = breadth * draught**2 / 2.0 - 2.0 * _corner_moment(radius)
    assert f"{area:.2f}" == "292.59"
    assert f"{moment:.3f}" == "1542.929"


def _corner_moment(radius: float) -> float:
    """Give the moment about its lower side of a square less the quarter of a circle in it."""
    quarter = np.pi / 4.0 * radius**2
    return float(radius**3 / 2.0 - quarter * (radius - 4.0 * radius / (3.0 * np.pi)))
