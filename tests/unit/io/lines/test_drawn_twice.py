"""Lines that are drawn twice over or in pieces that overlap: each part is kept once."""

import numpy as np
import pytest

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.lines.mend_lines import drawn_once
from assoc_hull.io.lines.raw_lines import RawPiece
from assoc_hull.io.reports import Notebook

Y = np.linspace(0.0, 10.0, 41)
LINE = np.column_stack([np.full(41, 5.0), Y, 0.05 * Y**2])
APART = np.array([0.0, -0.02, 0.02])


def kept(*pieces: FloatArray, small: float = 1.0) -> tuple[list[FloatArray], Notebook]:
    """What is kept of pieces of one line."""
    book = Notebook()
    raw = [RawPiece("ST 5", small * each, "row 2") for each in pieces]
    return [each.points / small for each in drawn_once(raw, book, small)], book


@pytest.mark.parametrize("small", [1.0, 0.125], ids=["a ship", "a boat"])
@pytest.mark.parametrize(
    ("pieces", "left"),
    [
        pytest.param([LINE, LINE], [LINE], id="twice"),
        pytest.param([LINE, LINE[::-2]], [LINE], id="again with fewer points, backward"),
        pytest.param([LINE[5:20], LINE], [LINE], id="a part of it first"),
        pytest.param([LINE[:21], LINE[20:]], [LINE[:21], LINE[20:]], id="pieces that meet"),
        pytest.param([LINE[:25], LINE[18:]], [LINE[:25], LINE[24:]], id="pieces that overlap"),
        pytest.param([LINE[:25], LINE[:17:-1]], [LINE[:25], LINE[24:]], id="one turned round"),
    ],
)
def test_each_part_of_a_line_is_kept_once(
    pieces: list[FloatArray], left: list[FloatArray], small: float
) -> None:
    """What lies on another piece goes, what overlaps is cut at its end; it is told as a repair."""
    found, book = kept(*pieces, small=small)
    assert len(found) == len(left)
    for one, other in zip(found, left, strict=True):
        assert np.allclose(one if one[0, 1] <= one[-1, 1] else one[::-1], other)
    assert bool(book.repairs) == (len(found) < len(pieces) or len(left[-1]) == 17)
    assert not book.suspicions


def test_copies_that_differ_are_suspected_with_how_far() -> None:
    """28 mm apart one is kept, and the difference is told; a metre apart both are."""
    found, book = kept(LINE, LINE + APART)
    assert len(found) == 1
    assert "(ST 5)" in book.suspicions[0].what
    assert book.suspicions[0].amount == pytest.approx(0.0283, rel=0.1)
    assert len(kept(LINE, LINE + 50.0 * APART)[0]) == 2


def test_a_stub_that_closes_a_gap_stays() -> None:
    """A piece of 80 mm between two others lies near their ends and on neither."""
    gap = np.array([[5.0, 10.0, 5.0], [5.0, 10.08, 5.0]])
    after = gap[1] + np.array([[0.0, 0.0, 0.0], [0.0, 2.0, 1.0]])
    assert len(kept(LINE, gap, after)[0]) == 3


def test_a_branch_is_no_overlap() -> None:
    """A piece that begins on another and leads away stays whole."""
    branch = np.array([[5.0, 5.0, 1.25], [5.0, 5.0, 3.0], [5.0, 5.0, 4.0]])
    assert [len(each) for each in kept(LINE, branch)[0]] == [41, 3]
