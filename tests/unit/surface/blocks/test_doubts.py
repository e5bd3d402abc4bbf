"""What is doubtful of a fit is said, with numbers and places."""

import numpy as np
import pytest

from assoc_hull.geometry.fitting.folds import surface_elements
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.surface.blocks.fit_options import angle_limit, fit_options
from assoc_hull.surface.blocks.fit_quality import (
    BlockBorder,
    Residuals,
    doubts_of_border,
    doubts_of_fit,
    doubts_of_half,
    doubts_of_penalty,
    doubts_of_shape,
)

OPTIONS = fit_options(300.0)


def residuals(*numbers: float, y: float = 3.0) -> Residuals:
    """Median, p95, p99 and largest, mm."""
    median, p95, p99, largest = (1e-3 * each for each in numbers)
    return Residuals("fitted", 900, median, p95, p99, largest, np.array([1.0, y, 2.0]), "WL 2")


@pytest.mark.parametrize(
    ("kind", "found", "words"),
    [
        ("body", residuals(0.1, 7.0, 12.0, 40.0), []),
        ("bow", residuals(0.1, 14.0, 30.0, 50.0), []),
        ("body", residuals(0.1, 9.0, 12.0, 40.0), ["95 % of the residuals are up to 9.0 mm"]),
        ("bow", residuals(1.6, 9.0, 12.0, 40.0), ["the median residual is 1.60 mm"]),
        ("body", residuals(0.1, 2.0, 12.0, 90.0), ["missing knuckle?"]),
        ("body", residuals(0.01, 0.2, 1.2, 2.0), []),
        ("stern", residuals(0.1, 9.0, 30.0, 90.0, y=0.1), ["stem not resolved"]),
    ],
    ids=["fine", "fine bow", "p95", "median", "knuckle", "small all over", "stem"],
)
def test_a_fit_off_its_limits_is_told(kind: str, found: Residuals, words: list[str]) -> None:
    """Each sentence names what is too large, and the place of the largest."""
    notes = list(doubts_of_fit(kind, found, OPTIONS))
    assert [note.startswith(word) for note, word in zip(notes, words, strict=True)] == [True] * len(
        words
    )
    assert all("at (1.00, " in note and "on WL 2" in note for note in notes if "largest" in note)


def test_limits_go_with_the_length() -> None:
    """8 and 15 mm are those of a ship of 300 m."""
    half = fit_options(150.0)
    assert (half.limit("body"), half.limit("bow")) == (0.004, 0.0075)
    assert OPTIONS.smoothing == 8.0 * half.smoothing
    assert half.median_limit == pytest.approx(0.00075)


def test_a_small_end_has_a_small_penalty() -> None:
    """With half the length and breadth an end has an eighth of the penalty; a large one no more."""
    small, twice = OPTIONS.smoothing_of("bow", 50.0), OPTIONS.smoothing_of("bow", 200.0)
    assert twice == pytest.approx(8.0 * small)
    assert OPTIONS.smoothing_of("bow", 1e4) == OPTIONS.smoothing_of("bow", 1e5)
    assert OPTIONS.smoothing_of("body", 50.0) == OPTIONS.smoothing


def folded_sheet(back: float) -> SplineSurface:
    """A sheet whose middle goes back in u."""
    net = np.zeros((4, 4, 3))
    net[..., 0] = np.array([0.0, 1.0 + back, 2.0 - back, 3.0])[:, None]
    net[..., 1] = np.arange(4.0)
    knots = np.repeat([0.0, 3.0], 4)
    return SplineSurface("sheet", (3, 3), knots, knots.copy(), net)


def test_a_fold_is_told() -> None:
    """A sheet that goes back on itself is folded; one that only slows down is not."""
    for back, count in ((0.0, 0), (6.0, 1)):
        sheet = folded_sheet(back)
        shape = surface_elements(sheet)
        notes = list(doubts_of_shape(sheet, shape, shape.folded))
        assert sum(note.startswith("folded: the normal turns over") for note in notes) == count


def test_a_stiffer_penalty_is_told() -> None:
    """Only if it is stiffer."""
    assert list(doubts_of_penalty(1.0, 1.0)) == []
    (note,) = doubts_of_penalty(9.0, 1.0)
    assert "9 times as large" in note


def test_borders_over_their_limits_are_told() -> None:
    """Gaps beyond rounding, and angles over .1 degrees at the body, .5 elsewhere."""
    limit = angle_limit(("body", "bow"))
    assert (limit, angle_limit(("bow", "bow"))) == (0.1, 0.5)
    place, gap = np.array([5.0, 1.0, 2.0]), np.zeros(3)
    good = BlockBorder(("body", "bow"), gap, 1e-12, np.array([0.0, 0.0, 0.09]), place, limit)
    assert list(doubts_of_border(good)) == []
    bad = BlockBorder(("body", "bow"), gap, 1e-4, np.array([0.0, 0.0, 0.2]), place, limit)
    assert [note.split(": ")[1][:9] for note in doubts_of_border(bad)] == ["a gap of ", "the norma"]


@pytest.mark.parametrize(("across", "told"), [(0.0, False), (0.00005, False), (0.002, True)])
def test_a_half_that_crosses_the_centre_plane_is_told(across: float, told: bool) -> None:
    """By how much, and where; to a tenth of a millimetre on 300 m it may."""
    net = np.zeros((4, 4, 3))
    net[..., 0], net[..., 2] = np.mgrid[0:4, 0:4]
    net[..., 1] = -across
    net[:, -1, 1] = 1.0
    knots = np.repeat([0.0, 3.0], 4)
    surface = SplineSurface("half", (3, 3), knots, knots, net)
    notes = list(doubts_of_half(surface, surface_elements(surface), OPTIONS))
    assert len(notes) == told
    if told:
        assert notes[0].startswith("waves across the centre plane by 2.00 mm at (")
        assert "(0.00, -0.00, 0.00)" in notes[0]
