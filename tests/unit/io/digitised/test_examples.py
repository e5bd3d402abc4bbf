"""What the parts of `io.digitised` give, one small example of each."""

from __future__ import annotations

import numpy as np

from assoc_hull.io.digitised.read import read_lines, to_one_side
from assoc_hull.io.digitised.text import parse_iges
from assoc_hull.io.iges.write import iges_of_lines
from assoc_hull.io.lines.raw_lines import RawPiece
from assoc_hull.io.reports import Notebook
from assoc_hull.shipped.wigley import wigley


def test_curves_of_an_iges_file_as_digitised_lines_each() -> None:
    """Curves of an IGES file as digitised lines: each by the name of its entity."""
    found = parse_iges(iges_of_lines(wigley())[0], "wigley.igs", Notebook())
    assert (found.pieces[0].line, found.unit) == ("ST 1", "m")


def test_digitised_lines_of_both_sides_of_a_hull_cut() -> None:
    """Digitised lines of both sides of a hull: cut at the centre plane, one side kept."""
    book = Notebook()
    whole = np.array([[5.0, 3, 4], [5, 2, 1], [5, 0, 0], [5, -2, 1], [5, -3, 4]])
    assert to_one_side([RawPiece("ST 5", whole, "row 2")], book)[0].points.tolist() == [
        [5.0, 3.0, 4.0],
        [5.0, 2.0, 1.0],
        [5.0, 0.0, 0.0],
    ]
    assert (
        str(book.report().repairs[0])
        == "both sides: the lines: 1 lines lie on both sides, as ST 5: "
        "cut at y = 0 and the port side kept"
    )


def test_digitised_lines_lists_of_points_per_line_in_one() -> None:
    """Digitised lines: lists of points per line, in one or several pieces."""
    text = """line,x,y,z
    ST 10,50,0,0
    ST 10,50,3,1
    ST 10,50,4,5
    WL 1,0,0,1
    WL 1,50,3,1
    WL 1,99,0,1
    """
    slices = read_lines(text)
    assert [(line.group, line.name, line.offset) for line in slices.lines] == [
        ("sections", "ST 10", 50.0),
        ("waterlines", "WL 1", 1.0),
    ]
    assert slices["WL 1"].pieces[0].ends == ("profile", "profile")
