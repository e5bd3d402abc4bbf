"""A comparison on paper: the lines of both hulls, every number once, words within the page."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from matplotlib.figure import Figure

import assoc_hull as ah
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.plot import comparison_pdf
from assoc_hull.plot.lines_plan.comparison import comparison_plan, comparison_sheets
from assoc_hull.plot.sheet.report_pages import LEFT, PAGE, RIGHT
from assoc_hull.plot.sheet.sheet_figure import Sheet, pdf_of
from assoc_hull.variation.comparing.comparison import HullComparison

Lines = Callable[[Figure, str], list[FloatArray]]


@pytest.fixture(scope="module")
def variant() -> ah.Hull:
    """A broader Wigley hull with fewer lines."""
    return ah.examples.wigley(breadth=11.0, stations=11, waterlines=6)


@pytest.fixture(scope="module")
def found(wigley: ah.Hull, variant: ah.Hull) -> HullComparison:
    """Both side by side."""
    return wigley.compare(variant)


@pytest.fixture(scope="module")
def sheets(wigley: ah.Hull, variant: ah.Hull, found: HullComparison) -> list[Sheet]:
    """The pages of it."""
    return comparison_sheets(wigley, variant, found)


def words(sheet: Sheet, begin: str) -> list[str]:
    """Words of a page whose ids begin like this."""
    texts = sheet.axes.texts
    return [text.get_text() for text in texts if str(text.get_gid()).startswith(begin)]


def test_lines_of_both_lie_over_one_another(sheets: list[Sheet], lines_of: Lines) -> None:
    """The parent's grey where they differ, also what went; the variant's red where it moved."""
    plan = sheets[0].figure
    (was,) = lines_of(plan, "half-breadth/before/WL 6.25$")
    now = np.concatenate(lines_of(plan, "half-breadth/moved/WL 6.25$"))
    scale = np.ptp(was[:, 0]) / 100.0
    assert np.ptp(was[:, 1]) == pytest.approx(5.0 * scale, rel=1e-6)
    assert np.ptp(now[:, 1]) == pytest.approx(5.5 * scale, rel=1e-3)
    assert lines_of(plan, "half-breadth/before/WL 0.625$")
    assert not lines_of(plan, "half-breadth/moved/WL 0.625$")


def test_a_section_that_passed_midship_lies_in_the_half_it_was_in(
    sheets: list[Sheet], lines_of: Lines
) -> None:
    """The parent's seventh in the aft body, the variant's in the fore body; midship in both."""
    plan = sheets[0].figure
    middle = float(np.mean([line[0, 0] for line in lines_of(plan, "body/grid/CL$")]))
    (was,) = lines_of(plan, "body/before/ST 7$")
    (now,) = lines_of(plan, "body/moved/ST 7$")
    assert was[:, 0].max() <= middle <= now[:, 0].min()
    assert len(lines_of(plan, "body/before/ST 10$")) == 2


def test_a_hull_over_itself_is_black(wigley: ah.Hull, lines_of: Lines) -> None:
    """Nothing is grey, nothing red."""
    plan = comparison_plan(wigley, wigley, paper="A4")
    names = [str(line.get_gid()) for line in plan.axes[0].lines]
    assert [name for name in names if "/before/" in name or "/moved/" in name] == []
    assert lines_of(plan, "body/sections/ST 7$")


def test_every_line_and_number_stands_there_once(
    sheets: list[Sheet], found: HullComparison
) -> None:
    """Every line that moved, every form parameter that differs; what went by name."""
    cells = [text for sheet in sheets[1:] for text in words(sheet, "label/cell/")]
    for line in found.of("moved"):
        assert cells.count(line.name) == 1
    for number in found.parameters:
        if not number.prints_alike and number.difference is not None:
            assert cells.count(number.symbol) >= 1
            told = f"{number.difference:+.{number.digits}f}".replace("-", "−")
            assert told in cells
    assert any(text.startswith("went: ST 10, ST 11") for text in cells)
    assert words(sheets[1], "label/form") == ["Parent and variant"]
    pages = [text for sheet in sheets[1:] for text in words(sheet, "label/page")]
    assert pages == [f"{k} / {len(sheets)}" for k in range(2, len(sheets) + 1)]


def test_words_lie_within_the_page_and_columns_apart(sheets: list[Sheet]) -> None:
    """None leaves the margins; no cell reaches into its neighbour on the same line."""
    for sheet in sheets[1:]:
        boxes = np.array([sheet.box(text) for text in sheet.axes.texts])
        assert boxes[:, 0].min() >= LEFT - 0.4
        assert boxes[:, 2].max() <= RIGHT + 0.4
        assert boxes[:, 1].min() >= 5.0
        assert boxes[:, 3].max() <= PAGE.height - 5.0
        order = np.lexsort([boxes[:, 0], boxes[:, 1].round(1)])
        one, other = boxes[order[:-1]], boxes[order[1:]]
        level = np.abs(one[:, 1] - other[:, 1]) < 0.05
        assert (other[level, 0] - one[level, 2]).min(initial=1.0) > -0.4


def test_a_pdf_has_all_pages_and_no_date(sheets: list[Sheet]) -> None:
    """So its bytes are the same each time; the plan is the first page, larger than others."""
    data = pdf_of(sheets, "both")
    assert b"CreationDate" not in data
    assert f"/Count {len(sheets)} ".encode() in data
    assert [sheet.paper.name for sheet in sheets] == ["A3"] + [PAGE.name] * (len(sheets) - 1)


def test_what_is_no_hull_is_refused(wigley: ah.Hull) -> None:
    """As is a comparison that is none; before anything is drawn."""
    with pytest.raises(BadInputError, match="HullComparison"):
        comparison_pdf(wigley, wigley, "a")  # type: ignore[arg-type]
    with pytest.raises(BadInputError, match="variant"):
        comparison_pdf(wigley, "a")  # type: ignore[arg-type]
