"""The book of plates, and pictures of plates laid flat."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import attrs
import numpy as np
import pytest
from matplotlib.figure import Figure

import assoc_hull as ah
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.plot.plates.development import development_figure
from assoc_hull.plot.plates.plate_book import plate_sheet, plate_sheets
from assoc_hull.plot.sheet.paper import PAPERS
from assoc_hull.plot.sheet.sheet_figure import Sheet
from assoc_hull.surface.plating.development import LABEL, Development
from assoc_hull.surface.plating.plate_table import COLUMNS, PlateTable
from tests.curved_patches import patch

Boxes = Callable[[Figure], dict[str, FloatArray]]


@pytest.fixture(scope="module")
def shell() -> PlateTable:
    """Seven plates with long names: more than one page of maps."""
    return ah.surface.plates(
        [
            ah.surface.SplineSurface.bezier(
                patch("P12_bowl"), f"strake {k} between frames 120 and 131"
            )
            for k in range(7)
        ]
    )


@pytest.fixture(scope="module")
def pages(shell: PlateTable) -> list[Sheet]:
    """Their book."""
    return plate_sheets(shell, title="Fore body")


@pytest.fixture(scope="module")
def flat(shell: PlateTable) -> Development:
    """One of them laid flat."""
    return shell[0].development((13, 5))


def words(sheet: Sheet, begin: str) -> list[str]:
    """Words on a page whose ids begin like this."""
    return [text.get_text() for text in sheet.axes.texts
            if str(text.get_gid()).startswith(begin)]  # fmt: skip


def test_the_table_has_all_that_is_printed(shell: PlateTable, pages: list[Sheet]) -> None:
    """A cell for each column that has a head; names that are too long end in dots."""
    heads = [column for column in COLUMNS if column.head]
    assert words(pages[0], "label/head")[: len(heads)] == [column.head for column in heads]
    cells = words(pages[0], "label/cell")
    assert len(cells) == len(shell) * len(heads)
    first = cells[: len(heads)]
    assert first[0].startswith("strake 0")
    assert first[1] == f"{shell[0].area:.3f}"
    assert "convex" in first


def test_advice_conditions_and_notes_stand_there(shell: PlateTable, pages: list[Sheet]) -> None:
    """Each plate has its advice; heating patterns have their caveat, K0 its origin."""
    told = " ".join(line for page in pages for line in words(page, "label/words"))
    for plate in shell:
        assert plate.suggestion in told
    assert "Advice only" in told
    assert "strain 0.001 over 2.5 m" in told


def test_maps_of_six_plates_to_a_page(shell: PlateTable, pages: list[Sheet]) -> None:
    """All plates once, the title and the number on each page, the colours told."""
    told = [" ".join(words(page, "label/plate")) for page in pages]
    assert [each.count("strake") for each in told] == [0, 6, 1]
    assert told[1].count("heights") + told[1].count("in space") >= 6
    assert [words(page, "label/page") for page in pages] == [[f"{k} / 3"] for k in (1, 2, 3)]
    assert all(words(page, "label/title") == ["Fore body"] for page in pages)
    assert "convex, K > K0" in words(pages[1], "label/legend")


def test_words_lie_on_the_page_and_apart(pages: list[Sheet], boxes_of: Boxes) -> None:
    """No word leaves a page; none of the table covers another."""
    for page in pages:
        boxes = boxes_of(page.figure)
        every = np.array(list(boxes.values()))
        assert every[:, :2].min() > 0.0
        assert (every[:, 2:] < (PAPERS["A4"].width, PAPERS["A4"].height)).all()
        cells = np.array([box for name, box in boxes.items() if name.startswith("label/cell")])
        for box in cells:
            across = np.minimum(box[2], cells[:, 2]) - np.maximum(box[0], cells[:, 0])
            up = np.minimum(box[3], cells[:, 3]) - np.maximum(box[1], cells[:, 1])
            assert ((across > 0.0) & (up > 0.6)).sum() == 1  # itself


def test_a_book_is_a_pdf(shell: PlateTable, tmp_path: Path) -> None:
    """A page for each plate laid flat is added where this is asked; another ending is refused."""
    one = attrs.evolve(shell, rows=shell.rows[:1])
    plate_sheet(one, tmp_path / "book.PDF")
    data = (tmp_path / "book.PDF").read_bytes()
    assert data.startswith(b"%PDF-")
    assert b"/Count 2 " in data
    assert b"CreationDate" not in data  # the same bytes each time
    assert len(plate_sheets(one, developments=True)) == 3
    for given, told in (("book.png", ".pdf"), (7, "path")):
        with pytest.raises(BadInputError, match=told):
            plate_sheet(one, given)  # type: ignore[arg-type]
    with pytest.raises(BadInputError, match="Plates"):
        plate_sheets([one])  # type: ignore[arg-type]
    with pytest.raises(BadInputError, match="developments"):
        plate_sheets(one, developments=2)  # type: ignore[arg-type]


def test_a_plate_laid_flat_is_to_scale_and_says_what_it_is_not(
    flat: Development, boxes_of: Boxes
) -> None:
    """Both maps bear the outline; the label of a geometric estimate stands there."""
    figure = development_figure(flat)
    told = [text.get_text() for text in figure.axes[0].texts]
    assert any(LABEL in each for each in told)
    scale = float(next(each for each in told if each.startswith("1:"))[2:])
    for name in ("strain along", "strain across"):
        (line,) = (each for each in figure.axes[0].lines if each.get_gid() == f"{name}/outline")
        size = np.ptp(np.asarray(line.get_xydata()), axis=0)
        assert size * scale / 1e3 == pytest.approx(flat.size)
        (drawn,) = (
            each for each in figure.axes[0].collections if each.get_gid() == f"{name}/tiles"
        )
        corner = np.array([path.vertices for path in drawn.get_paths()])
        first, second = corner[:, 2] - corner[:, 0], corner[:, 3] - corner[:, 1]
        area = 0.5 * np.abs(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0])
        assert area.sum() * scale**2 / 1e6 == pytest.approx(flat.flat_area, rel=1e-3)
    for box in boxes_of(figure).values():
        assert (box[:2] > 0.0).all()
        assert (box[2:] < (PAPERS["A4"].width, PAPERS["A4"].height)).all()


def test_extremes_of_strain_are_named(flat: Development) -> None:
    """Edges of a bowl are to be shrunk: the least and the largest strain stand at their places."""
    figure = development_figure(flat)
    named = {text.get_text() for text in figure.axes[0].texts
             if text.get_gid() == "label/extreme/strain along"}  # fmt: skip
    ends = flat.longitudinal.min(), flat.longitudinal.max()
    assert named == {f"{1e3 * end:+.2f}‰".replace("-", "−") for end in ends}
    bar = [text.get_text() for text in figure.axes[0].texts if text.get_gid() == "label/bar"]
    (high,) = (float(each[1:-1]) for each in bar if each.startswith("+"))
    assert 1.0 <= high / (1e3 * flat.largest_strain) < 4.0 / 3.0 + 1e-9
    with pytest.raises(BadInputError, match="Development"):
        development_figure("flat")  # type: ignore[arg-type]
