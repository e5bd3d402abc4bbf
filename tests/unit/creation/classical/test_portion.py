"""Portions of sections: volumes and centroids by Simpson's rules."""

from __future__ import annotations

import itertools
from collections.abc import Callable

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.creation.classical.sfolds_portion import (
    KINDS,
    Portion,
    require_portions_apart,
    three_eighths_rule,
)
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.ordinate_section import PairedParabolas
from tests.unit.geometry.classical.test_ordinate_section import section

X, AREAS = [0.0, 8.0, 16.0, 24.0, 32.0], [120.0, 160.0, 185.0, 190.0, 178.0]


def of(number: object = 3, x: object = X, areas: object = AREAS) -> Portion:
    """A portion of the printed areas, or of others."""
    return Portion.of_areas(number, x, areas)  # type: ignore[arg-type]


def test_printed_values_of_a_portion() -> None:
    """Volume and centroid of five areas, to the last digits of a double but one."""
    assert of().volume == pytest.approx(5514.666666666666, rel=1e-15)
    assert of().centre_x == pytest.approx(16.912959381044487, rel=1e-15)
    assert np.isnan(of().centre_z)


def test_printed_values_of_other_rules() -> None:
    """Simpson's second rule; the first of two steps alone."""
    assert three_eighths_rule([1.0, 4.0, 9.0, 16.0], 1.0) == 21.0
    curve = PairedParabolas.make("areas", 0.0, 1.0, [1.0, 4.0, 9.0, 16.0])
    assert curve.integral(0.0, 1.0) == pytest.approx(2.3333333333333335, rel=1e-15)


def test_a_prism_of_the_printed_section() -> None:
    """Five times the section of the printed values, 8 m apart: 363.0914583 x 32 m3."""
    prism = Portion.make(3, X, [section()] * 5)
    assert round(prism.volume, 4) == 11618.9267
    assert prism.volume == pytest.approx(32.0 * section().area, rel=1e-15)
    assert prism.kind == "middle body (aft)"
    assert prism.centre_x == pytest.approx(16.0)
    assert prism.centre_z == pytest.approx(section().moment / section().area)
    assert prism.volume_below(12.4) == pytest.approx(32.0 * (section().area - 2 * 4.05333333333333))
    assert prism.volume_below(20.0) == prism.volume_below(12.4)
    assert prism.moment_x_below(5.0) == pytest.approx(16.0 * prism.volume_below(5.0))


@pytest.mark.parametrize("seed", range(20))
def test_cubic_areas_are_integrated_exactly(seed: int) -> None:
    """A cubic on each pair of steps, another on each."""
    draw = np.random.default_rng(seed)
    step, pairs = draw.uniform(0.1, 20.0), int(draw.integers(1, 6))
    nodes = draw.normal(size=pairs + 1)
    truth, areas = 0.0, [float(nodes[0])]
    for first, last in itertools.pairwise(nodes):
        inner = draw.normal(size=2)
        cubic = np.polynomial.Polynomial.fit([0, 0.7, 1.3, 2], [first, *inner, last], 3)
        areas += [float(cubic(1.0)), float(cubic(2.0))]
        truth += float(cubic.integ()(2.0) - cubic.integ()(0.0)) * step
    found = of(1, -40.0 + step * np.arange(2 * pairs + 1), areas)
    assert found.volume == pytest.approx(truth, rel=1e-12, abs=1e-12 * step)


def test_the_error_falls_with_the_fourth_power_of_the_step() -> None:
    """On a smooth curve of areas, within a tenth of the order."""
    off = []
    for count in (9, 17, 33):
        x = np.linspace(0.0, 1.0, count)
        off.append(abs(of(2, x, np.sin(2.0 * x) + 1.0).volume - 1.0 - np.sin(1.0) ** 2))
    order = np.log2(np.array(off[:-1]) / off[1:])
    assert np.abs(order - 4.0).max() < 0.1


def test_the_curve_of_areas_is_that_of_the_rule() -> None:
    """It passes the areas, and its integral is the volume."""
    found = of()
    np.testing.assert_allclose(found.area(X), AREAS)
    assert found.curve.integral() == pytest.approx(found.volume, rel=1e-15)


def test_main_portions_are_one_to_seven() -> None:
    """There are thirteen kinds."""
    assert [of(k).is_main for k in range(1, 14)] == [True] * 7 + [False] * 6
    assert len(KINDS) == 13


def test_portions_of_the_main_body_may_leave_gaps_and_others_may_overlap() -> None:
    """A sentence for each gap; order plays no part; nothing is said of other kinds."""
    aft, fore = of(2, np.array(X) - 40.0), of(5, np.array(X) + 40.0)
    notes = require_portions_apart([fore, of(3), of(8), of(8), aft])
    assert notes == (
        "portions 2 and 3 of the main body leave a gap in x: [-8,0]",
        "portions 3 and 5 of the main body leave a gap in x: [32,40]",
    )
    assert require_portions_apart([of(3), of(4, np.array(X) + 32.0)]) == ()


def bare() -> Portion:
    """A portion of which only areas are known."""
    return of()


REFUSED: dict[str, tuple[Callable[[], object], str]] = {
    "number 0": (lambda: of(0), "portion 0: number must be 1..13"),
    "number 14": (lambda: of(14), "portion 14: number must be 1..13"),
    "no whole number": (lambda: of(2.5), "portion 2.5: number must be 1..13"),
    "an even count": (
        lambda: of(3, X[:4], AREAS[:4]),
        "portion 3: Simpson's first rule needs an odd number (>=3) of stations, got 4",
    ),
    "one station": (
        lambda: of(3, X[:1], AREAS[:1]),
        "portion 3: Simpson's first rule needs an odd number (>=3) of stations, got 1",
    ),
    "unequal steps": (
        lambda: of(3, [0.0, 8.0, 16.0, 25.0, 32.0]),
        "portion 3: stations not equally spaced at index 2 (step 9, expected 8)",
    ),
    "a step off by more than a millionth": (
        lambda: of(3, [0.0, 8.0, 16.0 + 1.2e-5, 24.0, 32.0]),
        "portion 3: stations not equally spaced at index 1 (step 8.000012, expected 8)",
    ),
    "descending": (
        lambda: of(3, X[::-1]), "portion 3: stations not ascending at index 0 (step -8)"
    ),
    "overlap": (
        lambda: require_portions_apart([of(5, np.array(X) + 24.0), of(4)]),
        "portions 4 and 5 of the main body overlap in x: [24,32]",
    ),
    "one within another": (
        lambda: require_portions_apart([of(4), of(5, 0.25 * np.array(X) + 8.0)]),
        "portions 4 and 5 of the main body overlap in x: [8,16]",
    ),
    "other counts": (lambda: of(3, X, AREAS[:3]), "portion 3: 5 stations and 3 sections"),
    "not finite": (
        lambda: of(3, [0.0, 8.0, float("nan")], AREAS[:3]),
        "portion 3: non-finite value at index 2",
    ),
    "outside": (lambda: of().area(33.0), "portion 3: x=33 outside [0, 32]"),
    "areas alone": (lambda: bare().volume_below(3.0), "portion 3: no sections, only areas"),
    "3/8 of three": (
        lambda: three_eighths_rule([1.0, 2.0, 3.0], 1.0), "3/8 rule: expected shape (4), got (3,)"
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", REFUSED)
def test_what_makes_no_portion_is_refused(case: str) -> None:
    """With these words."""
    call, what = REFUSED[case]
    with pytest.raises(GeometryError) as caught:
        call()
    assert caught.value.what == what
    assert caught.value.remedy


def test_steps_within_a_millionth_are_equal() -> None:
    """By rounding of a text."""
    assert of(3, [0.0, 8.0, 16.0 + 4e-6, 24.0, 32.0]).volume == pytest.approx(5514.6666, rel=1e-6)


def test_what_is_no_section_is_refused() -> None:
    """A portion takes sections only; a number that stands as an array is no list of them."""
    for given in ([1.0] * 5, np.array(5.0)):
        with pytest.raises(ah.AssocHullError, match="sections"):
            Portion.make(3, X, given)  # type: ignore[arg-type]
