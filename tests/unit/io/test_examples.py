"""What the parts of `io` give, one small example of each."""

from __future__ import annotations

import numpy as np

from assoc_hull.io.hull_json import dumps_hull_json, read_hull_json
from assoc_hull.io.reports import ExportBook, Notebook
from assoc_hull.model.tables import HullState, Particulars


def test_what_a_reader_of_offsets_assumed_mended_and_found() -> None:
    """What a reader of offsets assumed, mended and found suspicious, as data."""
    book = Notebook()
    book.assume("unit", "the table", "half-breadths are metres: the largest is 16.2", 16.2)
    assert str(book.report()).splitlines() == [
        "assumptions (1)",
        "  unit: the table: half-breadths are metres: the largest is 16.2",
        "repairs (0)",
        "suspicions (0)",
    ]


def test_what_is_written_down_while_a_hull_is_exported() -> None:
    """What is written down while a hull is exported: counts, rounding, what was left out."""
    book = ExportBook(decimals=1)
    assert (book.rows(np.array([[1.26, -0.01]])), round(book.largest, 3)) == (
        [["1.3", "0.0"]],
        0.04,
    )


def test_the_canonical_text_of_a_hull_hulljson_the_same() -> None:
    """The canonical text of a hull, `.hull.json`: the same hull gives the same bytes."""
    text = dumps_hull_json(HullState(Particulars("S", 9.0, 2.0, 1.0, 1.0)))
    assert dumps_hull_json(read_hull_json(text)) == text
