"""Sections as images of a circle: test values, areas, fits of more terms, what is folded."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.conformal_sections import (
    ConformalSections,
    fit_conformal,
    lewis_sections,
)
from assoc_hull.geometry.classical.polynomial_hulls import DraftFunctions
from tests.piece_values import PIECES

RIGHT = 0.5 * np.pi


def test_the_test_values_of_two_terms_are_met() -> None:
    """Ratio 1.2, area coefficient .94; the draught by the half-breadth comes out."""
    section = lewis_sections([1.2], [1.0], [0.94])
    np.testing.assert_allclose(section.terms[0], [PIECES["Lw.a1"], PIECES["Lw.a3"]], rtol=1e-12)
    found = float(section.draughts()[0] / section.half_breadths()[0])
    assert found == pytest.approx(PIECES["Lw.T"], rel=1e-12)


def test_breadth_draught_and_area_are_met_by_many_sections() -> None:
    """Drawn ones, half a circle among them; areas also by a rule over the image."""
    rng = np.random.default_rng(8)
    beam, deep = rng.uniform(4.0, 12.0, 200), rng.uniform(4.0, 12.0, 200)
    sigma = rng.uniform(0.6, 0.99, 200)
    beam[0], deep[0], sigma[0] = 3.0, 3.0, np.pi / 4
    sections = lewis_sections(beam, deep, sigma)
    np.testing.assert_allclose(sections.half_breadths(), beam, rtol=1e-13)
    np.testing.assert_allclose(sections.draughts(), deep, rtol=1e-13)
    np.testing.assert_allclose(sections.areas(), 2.0 * sigma * beam * deep, rtol=1e-12)
    np.testing.assert_allclose(sections.terms[0], 0.0, atol=1e-15)
    y, z = np.moveaxis(sections.at(np.linspace(0.0, RIGHT, 4001)), -1, 0)
    # Twice the half section: y over the depth, which falls from keel to waterline.
    np.testing.assert_allclose(-2.0 * np.trapezoid(y, z, axis=1), sections.areas(), rtol=1e-6)


def test_a_batch_is_the_same_as_one_by_one() -> None:
    """And angles may come in any shape."""
    both = lewis_sections([6.0, 5.0], [5.0, 6.0], [0.94, 0.8])
    alone = lewis_sections([5.0], [6.0], [0.8])
    np.testing.assert_array_equal(both.at([0.3, 0.4])[1], alone.at([0.3, 0.4])[0])
    assert both.at(0.3).shape == (2, 2)
    assert len(both) == 2


def test_more_terms_follow_offsets() -> None:
    """A section of five terms comes back from points on it; more terms are never worse."""
    true = ConformalSections(np.array([5.2]), np.array([[0.05, -0.09, 0.02, 0.01, -0.005]]))
    t = np.linspace(0.0, RIGHT, 25) + 0.04 * np.sin(4.0 * np.linspace(0.0, RIGHT, 25))
    points = true.at(t)[0]
    points[0, 0] = points[-1, 1] = 0.0
    section, off = fit_conformal(points, 5)
    assert off.max() < 1e-7
    np.testing.assert_allclose(section.terms, true.terms, atol=1e-6)
    worse = [float(np.sum(fit_conformal(points, n)[1] ** 2)) for n in (1, 2, 3, 4)]
    assert worse == sorted(worse, reverse=True)


def test_a_section_of_a_real_kind_is_followed() -> None:
    """Flat bottom with rise, round bilge, upright side: within 1 % of the draught, area too."""
    bottom = np.column_stack([np.linspace(0.0, 5.0, 6), 4.0 - 0.02 * np.linspace(0.0, 5.0, 6)])
    turn = np.linspace(-RIGHT, 0.0, 8)
    bilge = np.column_stack([5.0 + 1.5 * np.cos(turn), 2.4 - 1.5 * np.sin(turn)])
    side = np.column_stack([np.full(6, 6.5), np.linspace(2.0, 0.0, 6)])
    points = np.vstack([bottom[:-1], bilge, side])
    section, off = fit_conformal(points, 6)
    assert off.max() < 0.04
    area = -2.0 * float(np.trapezoid(points[:, 0], points[:, 1]))
    assert float(section.areas()[0]) == pytest.approx(area, rel=5e-3)


def test_terms_splined_along_the_ship_are_its_sections() -> None:
    """Scale and terms over x: left-out stations come back within 0.1 % of the half-breadth."""
    x = np.linspace(0.0, 80.0, 17)
    beam = 8.0 - 5.0 * (x / 80.0) ** 2
    sections = lewis_sections(beam, np.full(17, 6.0), 0.93 - 0.2 * x / 80.0)
    table = np.column_stack([sections.scale, sections.terms])
    along = DraftFunctions.make(x[::2], table[::2]).at(x)
    between = ConformalSections(along[:, 0].copy(), along[:, 1:].copy())
    t = np.linspace(0.0, RIGHT, 20)
    assert float(np.abs(between.at(t) - sections.at(t)).max()) < 8e-3
    assert between.simple().all()


def test_folds_are_found() -> None:
    """Across the centre line, a loop; bulbs and sections that swell both ways are none."""
    assert lewis_sections([3.0], [8.0], [0.6]).simple().all()
    full = lewis_sections([6.0], [6.0], [0.99])
    assert float(full.at(np.linspace(0.0, RIGHT, 99))[0].max()) > 6.0
    terms = np.array([[0.0, 0.5, 0.0], [0.0, -0.6, 0.0], [0.3, 0.05, 0.45], [0.0, -0.12, 0.0]])
    folded = ConformalSections(np.ones(4), terms)
    assert folded.simple().tolist() == [False, False, False, True]
    # Just beyond the cusp at -1/3 the loop is shorter than the step from angle to angle.
    loop = ConformalSections(np.ones(2), np.array([[0.4072, -0.3345], [0.4072, -0.3325]]))
    assert loop.simple().tolist() == [False, True]


def _crossings(points: np.ndarray) -> int:
    """Count crossings of a closed polyline with itself: places s, t in [0, 1) of two sides."""
    step = np.roll(points, -1, axis=0) - points
    i, j = np.triu_indices(len(points), 2)
    between = points[j] - points[i]
    turn = step[i, 0] * step[j, 1] - step[i, 1] * step[j, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        s = (between[:, 0] * step[j, 1] - between[:, 1] * step[j, 0]) / turn
        t = (between[:, 0] * step[i, 1] - between[:, 1] * step[i, 0]) / turn
    return int(((s > 1e-9) & (s < 1 - 1e-9) & (t > 1e-9) & (t < 1 - 1e-9)).sum())


def test_no_section_that_is_passed_crosses_itself() -> None:
    """Drawn terms: whole outlines, below the water and mirrored above it, of those passed."""
    rng = np.random.default_rng(12)
    sections = ConformalSections(np.ones(60), rng.uniform(-0.25, 0.25, (60, 3)))
    said = sections.simple()
    quarter = sections.at(np.linspace(0.0, RIGHT, 91))
    over = quarter[:, -2::-1] * [1.0, -1.0]
    half = np.concatenate([quarter, over], axis=1)
    outline = np.concatenate([half, half[:, -2:0:-1] * [-1.0, 1.0]], axis=1)
    drawn = np.array([_crossings(each) == 0 for each in outline])
    assert drawn[said].all()
    assert 10 < int(said.sum()) < 50
    assert int((~drawn).sum()) > 10


REFUSED: dict[str, tuple[str, Callable[[], object]]] = {
    "folded": (
        r"conformal section: not simple \(section 1, terms",
        lambda: lewis_sections([6.0, 6.0], [5.0, 1.0], [0.9, 0.2]),
    ),
    "folded terms": (
        "conformal section: not simple",
        lambda: ConformalSections(np.ones(1), np.array([[0.0, 0.5]])).checked(),
    ),
    "too full": (
        "conformal section: no two terms give area coefficient 1.3 at index 0",
        lambda: lewis_sections([6.0], [5.0], [1.3]),
    ),
    "no breadth": (
        "conformal section: half-breadth 0 at index 1",
        lambda: lewis_sections([6.0, 0.0], [5.0, 5.0], [0.9, 0.9]),
    ),
    "angle outside": (
        r"conformal section: x=2 outside \[0, 1.57",
        lambda: lewis_sections([6.0], [5.0], [0.9]).at(2.0),
    ),
    "terms": (
        "conformal section: terms 3; give a whole number from 1 to 1",
        lambda: fit_conformal([[0, 3], [2, 2], [3, 0]], 3),
    ),
    "offsets": ("conformal section: 2 offsets", lambda: fit_conformal([[0, 3], [3, 0]], 1)),
    "offsets on a line": (
        r"conformal section: not simple \(offsets on one line\)",
        lambda: fit_conformal([[0, 3], [0, 2], [0, 1]], 1),
    ),
    "turned round": (
        "conformal section: depths from 0 to 3; give offsets from the keel",
        lambda: fit_conformal([[3, 0], [2, 2], [0, 3]], 1),
    ),
    "one point twice": (
        "conformal section: coincident points at index 2",
        lambda: fit_conformal(np.array([[0, 3], [2, 2], [2, 2], [3, 0]]), 1),
    ),
    "offsets of a fold": (
        "conformal section: not simple",
        lambda: fit_conformal(np.array([[0, 3], [-2, 2.5], [-2, 1.5], [-1, 1], [3, 0]]), 3),
    ),
    "no number": (
        "conformal section: non-finite value at index 0", lambda: lewis_sections([np.nan], [1], [1])
    ),
}  # fmt: skip


@pytest.mark.parametrize(("message", "call"), REFUSED.values(), ids=REFUSED)
def test_what_makes_no_section_is_refused(message: str, call: Callable[[], object]) -> None:
    """With the numbers and what to do."""
    with pytest.raises(GeometryError, match=message):
        call()
