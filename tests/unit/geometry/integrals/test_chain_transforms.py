"""Series of chains of cubics: closed forms, the series of functions, and laws of descriptors."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_allclose

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import CurveData, FloatArray
from assoc_hull.geometry.integrals.area_moments import plane_integrals
from assoc_hull.geometry.integrals.chains import (
    PlaneChains,
    chain_ends,
    closed_loop,
    cut_chain,
    join_chains,
    reversed_chain,
    straight_chain,
)
from assoc_hull.geometry.integrals.series import (
    ComplexArray,
    chebyshev_of_chains,
    chebyshev_of_function,
    descriptor_truncation,
    evaluate_descriptors,
    fourier_descriptors,
    function_samples,
    length_of_chains,
    sine_of_chains,
    sine_of_function,
)
from assoc_hull.geometry.splines.loft import loft
from tests.long_forms import draws
from tests.unit.geometry.integrals.test_transforms import PRINTED, SHIP_B, SHIP_C

HALF = np.array([[0.0, 0.0, 0], [3.0, 0.2, 0], [4.0, 2.5, 0], [4.5, 6.0, 0]])
"""Half a section: y, z."""
OFFSETS = arrays(np.float64, 5, elements=st.floats(0.1, 5.0))


def parabolas(*pieces: tuple[float, float, float, float, float]) -> FloatArray:
    """Pieces from u0 to u1 with v = a + b t + c t^2 each."""
    return np.array([[[p, a], [q - p, b], [0, c], [0, 0]] for p, q, a, b, c in pieces], float)


def section() -> PlaneChains:
    """A smooth section closed with its mirror image."""
    return PlaneChains.single(
        closed_loop(PlaneChains.of(loft(CurveData.single(HALF)), (0, 1)).cubic, 0)
    )


def turned(chain: PlaneChains, first: int) -> PlaneChains:
    """The same closed curve, begun at another of its cubics."""
    return PlaneChains.single(np.roll(chain.cubic, -first, axis=0))


def changed(chain: PlaneChains, factor: complex, shift: complex) -> PlaneChains:
    """The image under w -> factor w + shift."""
    u, v = chain.cubic[..., 0], chain.cubic[..., 1]
    w = (u + 1j * v) * factor
    w[:, 0] += shift
    return PlaneChains.single(np.stack([w.real, w.imag], axis=-1))


def test_a_curve_of_three_pieces_to_its_printed_digits() -> None:
    """Run, parallel body and entrance as cubics: the same numbers as from the function."""
    ship = parabolas((-1, -0.2, 0, 2, -1), (-0.2, 0.3, 1, 0, 0), (0.3, 1, 1, 0, -1))
    assert_allclose(chebyshev_of_chains(PlaneChains.single(ship), 7)[0], SHIP_C, atol=PRINTED)
    assert_allclose(sine_of_chains(PlaneChains.single(ship), 6)[0], SHIP_B, atol=PRINTED)


def test_an_upright_end_costs_no_digits() -> None:
    """v = sqrt((1 - xi) / 2), as u = 1 - 2 t^2, v = t: c_k = (2 - delta) / pi 2 / (1 - 4 k^2)."""
    k = np.arange(40)
    end = np.array([[[1.0, 0.0], [0.0, 1.0], [-2.0, 0.0], [0.0, 0.0]]])
    found = chebyshev_of_chains(PlaneChains.single(reversed_chain(end)), 40)[0]
    assert_allclose(found, (2.0 - (k == 0)) / np.pi * 2.0 / (1.0 - 4.0 * k**2), atol=1e-12)


def test_a_step_is_a_piece_as_any_other() -> None:
    """From 0 to 2 at xi = 0, and upright at both ends: the closed form of a jump."""
    corners = [(-1, 5), (-1, 0), (0, 0), (0, 2), (1, 2), (1, -3)]
    places = np.array(corners, float)
    steps = [straight_chain(a, b) for a, b in pairwise(places)]
    k = np.arange(1, 30)
    wanted = np.where(k % 2, 4.0 / (np.pi * k) * (-1.0) ** ((k - 1) // 2), 0.0)
    chain = PlaneChains.single(join_chains(steps))
    assert_allclose(chebyshev_of_chains(chain, 30)[0], [1.0, *wanted], atol=1e-12)
    jump = sine_of_function(lambda xi: np.where(xi > 0.0, 2.0, 0.0), 30, [0.0])
    assert_allclose(sine_of_chains(chain, 30)[0], jump, atol=1e-12)


@given(OFFSETS)
def test_splines_have_the_series_of_the_functions_they_are(y: FloatArray) -> None:
    """A curve over evenly run abscissas, as cubics and as a function; several go at once."""
    x = np.array([0.0, 2.0, 5.0, 6.0, 10.0])
    from scipy.interpolate import PPoly

    rise = np.diff(y)
    cubic = np.stack([np.stack([x[:-1], y[:-1]], -1), np.stack([np.diff(x), rise + 1.0], -1),
                      np.stack([0 * rise, -3.0 + 0 * rise], -1),
                      np.stack([0 * rise, 2.0 + 0 * rise], -1)], axis=1)  # fmt: skip
    wide = np.diff(x)
    function = PPoly(cubic[:, ::-1, 1].T / wide ** np.arange(3, -1, -1)[:, None], x)
    both = PlaneChains(np.array([0, 4, 8]), np.concatenate([cubic, 2.0 * cubic]))
    inner = x[1:-1] / 5.0 - 1.0
    wanted = chebyshev_of_function(lambda xi: function(5.0 * (xi + 1.0)), 9, inner)
    assert_allclose(chebyshev_of_chains(both, 9), [wanted, 2.0 * wanted], atol=1e-11)
    wanted = sine_of_function(lambda xi: function(5.0 * (xi + 1.0)), 9, inner)
    assert_allclose(sine_of_chains(both, 9), [wanted, 2.0 * wanted], atol=1e-11)


def test_samples_integrate_over_the_abscissa() -> None:
    """The weights of a chain add up to the range, and with v to the mean height times two."""
    xi, v, weights = function_samples(PlaneChains.single(parabolas((0, 10, 0, 4, -4))))
    assert weights.sum() == pytest.approx(2.0, rel=1e-13)
    assert (weights * v).sum() == pytest.approx(4.0 / 3.0, rel=1e-13)
    assert_allclose(v, 1.0 - xi**2, atol=1e-13)


def test_descriptors_of_a_square_are_those_of_its_sides() -> None:
    """X_k = (8 / pi^2) sqrt(2) e^(..) / k^2 in size for k = 1, -3, 5, ..., nil otherwise."""
    square = PlaneChains.single(
        closed_loop(straight_chain(np.array([1.0, -1]), np.array([1.0, 1])), 0)
    )
    k = np.arange(-9, 10)
    size = np.where(k % 4 == 1, 8.0 * np.sqrt(2.0) / (np.pi * np.where(k == 0, 1, k)) ** 2, 0.0)
    assert_allclose(np.abs(fourier_descriptors(square, 9)[0]), size, atol=1e-12)


def test_a_fast_transform_of_even_places_agrees() -> None:
    """The curve walked in equal steps of length, transformed by the FFT, to its own accuracy."""
    chain = section()
    t = np.linspace(0.0, 1.0, 4001)[:-1]
    place = chain.at(t).reshape(-1, 2)
    w = place[:, 0] + 1j * place[:, 1]
    s = np.concatenate([[0.0], np.cumsum(np.abs(np.diff([*w, w[0]])))])
    even = np.arange(8192) / 8192 * s[-1]
    walked = np.interp(even, s, [*w.real, w.real[0]]) + 1j * np.interp(
        even, s, [*w.imag, w.imag[0]]
    )
    fast = np.fft.fft(walked) / 8192
    found = fourier_descriptors(chain, 12)[0]
    assert_allclose(found, fast[np.arange(-12, 13)], atol=1e-5)


def test_the_area_inside_is_pi_times_the_sum_of_k_squares() -> None:
    """Of a circle-like loop of eight splines' cubics; by Green's theorem the same."""
    angle = np.linspace(0.0, 2.0 * np.pi, 9)
    ring = np.stack([3.0 * np.cos(angle), 2.0 * np.sin(angle), 0.0 * angle], axis=1)
    ring[-1] = ring[0]
    ends = np.array([[0.0, 1, 0], [0, 1, 0]])
    spline = loft(CurveData.single(ring, end_kind=(1, 1), end_vector=ends))
    found = fourier_descriptors(PlaneChains.of(spline, (0, 1)), 200)[0]
    k = np.arange(-200, 201)
    area = np.pi * (k * np.abs(found) ** 2).sum()
    assert area == pytest.approx(float(plane_integrals(spline).area[0]), rel=1e-8)


@settings(max_examples=draws(20))
@given(
    st.complex_numbers(min_magnitude=0.1, max_magnitude=10.0),
    st.complex_numbers(max_magnitude=50.0),
    st.integers(0, 6),
)
def test_shift_turn_scale_and_start(factor: complex, shift: complex, first: int) -> None:
    """X_k f for w f; X_0 + d for w + d; X_k e^(2 pi i k s0 / L) for a start at s0."""
    chain, k = section(), np.arange(-6, 7)
    plain = fourier_descriptors(chain, 6)[0]
    found = fourier_descriptors(changed(chain, factor, shift), 6)[0]
    assert_allclose(found, factor * plain + shift * (k == 0), atol=1e-9)
    before = PlaneChains.single(chain.cubic[:first]) if first else None
    share = 0.0 if before is None else length_of_chains(before)[0] / length_of_chains(chain)[0]
    moved = fourier_descriptors(turned(chain, first), 6)[0]
    assert_allclose(moved, plain * np.exp(2j * np.pi * k * share), atol=1e-10)


def test_a_section_is_symmetric() -> None:
    """Begun in the mirror y = 0 all X_k are imaginary; begun in the mirror v = 0 they are real."""
    assert_allclose(fourier_descriptors(section(), 9)[0].real, 0.0, atol=1e-12)
    waterline = closed_loop(
        PlaneChains.of(loft(CurveData.single(HALF[:, [1, 0, 2]])), (0, 1)).cubic, 1
    )
    assert_allclose(fourier_descriptors(PlaneChains.single(waterline), 9)[0].imag, 0.0, atol=1e-12)


def test_descriptors_come_back_to_the_curve() -> None:
    """Many harmonics are the curve, by what is said to be left; squares add up to its mean."""
    chain = section()
    found: ComplexArray = fourier_descriptors(chain, 150)[0]
    rest = descriptor_truncation(chain, found)
    corner = chain.cubic[4, 0]
    share = length_of_chains(PlaneChains.single(chain.cubic[:4]))[0] / length_of_chains(chain)[0]
    off = np.linalg.norm(evaluate_descriptors(found, [share])[0] - corner)
    assert off <= 1.05 * rest.largest[-1] < 0.03
    assert (np.diff(rest.rms) <= 1e-14).all()
    whole = rest.rms[0] ** 2 + (np.abs(found[149:152]) ** 2).sum()
    assert rest.rms[-1] ** 2 + (np.abs(found) ** 2).sum() == pytest.approx(whole, rel=1e-9)


def test_what_is_no_function_or_not_closed_is_refused() -> None:
    """A chain that ends behind its beginning, and one that does not come back."""
    line = straight_chain(np.array([0.0, 0.0]), np.array([4.0, 1.0]))
    with pytest.raises(BadInputError, match="run through it forward"):
        chebyshev_of_chains(PlaneChains.single(reversed_chain(line)), 3)
    with pytest.raises(BadInputError, match="an open curve"):
        fourier_descriptors(PlaneChains.single(line), 3)


def test_a_chain_is_cut_where_it_passes_the_limits() -> None:
    """An arch cut by two heights leaves its two flanks, their ends at the heights."""
    arch = parabolas((0, 4, 0, 4, -4), (4, 6, 0, -1, 0))
    left, right = cut_chain(arch, 1, 0.25, 0.75)
    assert_allclose(chain_ends(left), [[4 * (0.5 - 0.75**0.5 / 2), 0.25], [1.0, 0.75]], atol=1e-12)
    assert_allclose(chain_ends(right)[1][1], 0.25, atol=1e-12)
    assert len(cut_chain(arch, 0, 1.0, 5.0)) == 1
    assert cut_chain(arch, 1, 2.0, 3.0) == []


def test_a_loop_is_closed_and_counter_clockwise() -> None:
    """Whichever way its half runs."""
    half = PlaneChains.of(loft(CurveData.single(HALF)), (0, 1)).cubic
    for each in (half, reversed_chain(half)):
        ring = closed_loop(each, 0)
        first, last = chain_ends(ring)
        assert_allclose(first, last, atol=1e-12)
        assert first[0] == 0.0
        found = fourier_descriptors(PlaneChains.single(ring), 3)[0]
        assert np.abs(found[4]) > np.abs(found[2])
