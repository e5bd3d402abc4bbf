"""Slices of a body between planes across it, and its sections anywhere along it."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from numpy.polynomial import Polynomial

from assoc_hull.geometry.curves import FloatArray, IntArray, IsoCurves
from assoc_hull.geometry.floating.immersed_strips import prepare_strips
from assoc_hull.geometry.floating.immersion import FloatingPlanes, integrate_immersed
from assoc_hull.geometry.floating.raked_strips import StripSpans, strip_spans
from assoc_hull.geometry.floating.sections import (
    SliceIntegrals,
    areas_at,
    cross_section,
    integrate_slice,
)
from assoc_hull.geometry.numeric.quadrature import gauss
from tests.exact_hulls import FormStrips, box, ellipsoid, wigley
from tests.long_forms import draws

LENGTH, BREADTH, DRAUGHT = 100.0, 10.0, 6.25

RAKED = FormStrips(
    breadth=Polynomial([0.2, 0.0, 6.0, -6.0]) + Polynomial([5.0]),
    keel=Polynomial([1.0, -1.5, 1.2]),
    height=Polynomial([8.0, 1.0]),
    rake=Polynomial([-6.0, 8.0, 5.0]),
)
"""All its strips are raked: forward at the bow, aft at the stern; open at both ends."""


def at(height: float, trim: float = 0.0) -> FloatingPlanes:
    """One floating plane, upright."""
    return FloatingPlanes(np.array([height]), np.array([trim]), np.zeros(1))


@pytest.fixture(scope="module")
def exact_wigley() -> StripSpans:
    """Wigley's hull by its formula."""
    return strip_spans(prepare_strips(wigley()))


@pytest.fixture(scope="module")
def exact_ellipsoid() -> StripSpans:
    """An ellipsoid, nearly by its formula."""
    return strip_spans(prepare_strips(ellipsoid()))


@pytest.fixture(scope="module")
def raked() -> StripSpans:
    """A body of raked strips."""
    return strip_spans(prepare_strips(RAKED))


def wigley_aft_of(x: float) -> SliceIntegrals:
    """Of Wigley's hull at its draught: A(x) = 2/3 B T s, b(x) = B/2 s, s = 1 - (2 x/L - 1)^2."""
    s = 1.0 - Polynomial([-1.0, 2.0 / LENGTH]) ** 2
    along = Polynomial([0.0, 1.0])
    amount, moment = s.integ()(x), (along * s).integ()(x)
    section = 2.0 / 3.0 * BREADTH * DRAUGHT
    up = 5.0 / 8.0 * DRAUGHT
    return SliceIntegrals(
        section * amount, section * moment, up * section * amount,
        BREADTH * amount, BREADTH * moment,
    )  # fmt: skip


def close(found: SliceIntegrals, wanted: SliceIntegrals, within: float) -> bool:
    """Whether two parts of Wigley's hull are the same but for so much of the whole."""
    scale = SliceIntegrals(2777.8, 138889.0, 10851.0, 666.7, 33333.0)
    return all(
        abs(getattr(found, name) - getattr(wanted, name)) <= within * getattr(scale, name)
        for name in ("volume", "moment_x", "moment_z", "area", "area_x")
    )


@given(x=st.floats(0.0, LENGTH))
def test_the_part_of_wigleys_hull_aft_of_any_place_is_the_polynomial(
    exact_wigley: StripSpans, x: float
) -> None:
    """Volume, waterplane and their moments aft of x, in closed form, to 1e-12 of the whole."""
    assert close(integrate_slice(exact_wigley, -np.inf, x, at(DRAUGHT)), wigley_aft_of(x), 1e-12)


@example(x=3.0705343726637063e-12)
@given(x=st.floats(0.0, LENGTH))
def test_the_volume_of_the_ellipsoid_aft_of_any_place_is_half_a_cap(
    exact_ellipsoid: StripSpans, x: float
) -> None:
    """At half its height: pi b c / 2 times the integral of 1 - ((x - a) / a)^2, to 1e-9."""
    t = x / 50.0 - 1.0
    wanted = 0.5 * np.pi * 8.0 * 6.0 * 50.0 * (t - t**3 / 3.0 + 2.0 / 3.0)
    found = integrate_slice(exact_ellipsoid, -np.inf, x, at(6.0)).volume
    assert found == pytest.approx(wanted, abs=1e-9 * 5026.5)


@pytest.mark.parametrize("x", [5e-324, 1e-15, 8e-11, 1.1e-10, 1e-8])
def test_next_to_nothing_lies_aft_of_a_place_at_the_end(
    exact_ellipsoid: StripSpans, x: float
) -> None:
    """No error there: the strip that the plane leaves is too short to have a height."""
    found = integrate_slice(exact_ellipsoid, -np.inf, x, at(6.0))
    assert abs(found.volume) < 1e-12


@pytest.mark.parametrize("x", [0.5, 33.0, 50.0, 99.0])
def test_sections_of_the_ellipsoid_are_half_ellipses(exact_ellipsoid: StripSpans, x: float) -> None:
    """Below the height of the centre, between the curves of the rule too; to 1e-9."""
    wanted = 0.5 * np.pi * 48.0 * (1.0 - (x / 50.0 - 1.0) ** 2)
    found = areas_at(exact_ellipsoid, np.array([x]), at(6.0))
    assert found == pytest.approx([wanted], rel=1e-9)


def test_a_slice_of_a_box_is_a_box() -> None:
    """Between x 10 and 37.5 m at a trim: breadth times length times the mean draught."""
    found = integrate_slice(strip_spans(prepare_strips(box())), 10.0, 37.5, at(5.0, 0.02))
    mean = 5.0 + 0.02 * 23.75
    assert found.volume == pytest.approx(20.0 * 27.5 * mean, rel=1e-13)
    assert (found.area, found.area_x) == pytest.approx((550.0, 550.0 * 23.75), rel=1e-13)


def test_no_body_lies_beyond_its_ends(exact_wigley: StripSpans) -> None:
    """Slices and sections there are nil, not an error."""
    assert integrate_slice(exact_wigley, 120.0, np.inf, at(DRAUGHT)) == SliceIntegrals(
        0.0, 0.0, 0.0, 0.0, 0.0
    )
    assert areas_at(exact_wigley, np.array([-1.0, 101.0]), at(DRAUGHT)).tolist() == [0.0, 0.0]
    assert cross_section(exact_wigley, 101.0).count == 0


@settings(max_examples=draws(20))
@given(x=st.floats(12.0, 88.0), height=st.floats(3.0, 7.0), trim=st.floats(-0.01, 0.01))
def test_parts_of_raked_strips_add_up_to_the_body(
    raked: StripSpans, x: float, height: float, trim: float
) -> None:
    """The two parts on either side of any place, of strips that a plane across cuts askew."""
    plane = at(height, trim)
    parts = integrate_slice(raked, -np.inf, x, plane) + integrate_slice(raked, x, np.inf, plane)
    whole = integrate_immersed(raked.prepared, plane)
    for name in ("volume", "moment_x", "moment_z", "area", "area_x"):
        assert getattr(parts, name) == pytest.approx(float(getattr(whole, name)[0]), rel=1e-7)


def test_the_volume_between_two_places_is_the_integral_of_the_sections_there(
    raked: StripSpans,
) -> None:
    """Traced sections against slices, with another rule along the ship."""
    plane, (node, weight) = at(5.0), gauss(24)
    edge = np.linspace(41.0, 44.0, 4)
    x = (edge[:-1, None] + np.diff(edge)[:, None] * node).ravel()
    sections = areas_at(raked, x, plane).reshape(3, -1) @ weight
    assert sections.sum() == pytest.approx(
        integrate_slice(raked, 41.0, 44.0, plane).volume, rel=1e-7
    )


@pytest.mark.parametrize(("part", "within"), [(0.0, 1e-10), (0.5, 1e-7)])
def test_a_traced_section_lies_in_its_plane_and_on_the_surface(
    raked: StripSpans, part: float, within: float
) -> None:
    """Every place on it is one of the formula: where its cubics meet, and in their middles."""
    found = cross_section(raked, 57.3)
    assert (found.point[:, 0, 0] == 57.3).all()
    assert not found.point[:, 1:, 0].any()
    y, z = (found.point[:, :, axis] @ part ** np.arange(4) for axis in (1, 2))
    side = ~found.deck
    curves = RAKED.profile[1][:-1]
    for breadth, height in zip(y[side][::7], z[side][::7], strict=True):
        t = 0.573
        for _ in range(60):
            zeta = (height - RAKED.keel(t)) / RAKED.height(t)
            t = (57.3 - RAKED.rake(t) * zeta) / RAKED.length
        tile = int(np.searchsorted(curves[:, 0], zeta, side="right")) - 1
        roots = Polynomial(curves[tile] - np.array([zeta, 0.0, 0.0, 0.0])).roots()
        real = roots.real[np.abs(roots.imag) < 1e-9]
        u = float(real[(real > -1e-9) & (real < 1.0 + 1e-9)][0])
        assert RAKED.breadth(t) * Polynomial(RAKED.profile[0][tile])(u) == pytest.approx(
            breadth, abs=within
        )


def test_a_section_of_wigley_has_its_offsets(exact_wigley: StripSpans) -> None:
    """Every place of it is on the formula; above the draught the side is upright."""
    found = cross_section(exact_wigley, 30.0)
    _, y, z = found.point[~found.deck].sum(axis=1).T
    up = np.minimum(z, DRAUGHT)
    exact = 5.0 * (1.0 - 0.16) * (1.0 - ((up - DRAUGHT) / DRAUGHT) ** 2)
    assert y == pytest.approx(exact, abs=1e-11)


class Uneven:
    """The body of raked strips, v running unevenly: beyond 0.4 it grows faster and faster."""

    count, order = RAKED.count, RAKED.order

    def curves(self, strip: IntArray, v: FloatArray) -> IsoCurves:
        """As of the body."""
        more = np.maximum(v - 0.4, 0.0)
        found = RAKED.curves(strip, (v + more * more) / 1.36)
        rate = np.repeat((1.0 + 2.0 * more) / 1.36, np.diff(found.start))[:, None, None]
        return IsoCurves(found.start, found.point, rate * found.across, found.deck)


def test_a_traced_section_does_not_depend_on_how_v_runs(raked: StripSpans) -> None:
    """Lines along ships bend anew at every point of theirs; what is traced keeps to them."""
    uneven = strip_spans(prepare_strips(Uneven()))
    for x in (52.5, 54.0, 57.3):
        one, other = (cross_section(body, x).point for body in (raked, uneven))
        np.testing.assert_allclose(one[:, 0], other[:, 0], rtol=0.0, atol=1e-11)
