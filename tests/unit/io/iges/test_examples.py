"""What the parts of `io.iges` give, one small example of each."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.io.iges.entities import Transformation, readable_name, spline_curve
from assoc_hull.io.iges.file import Hollerith, IgesFile, IgesRecord, split_tokens
from assoc_hull.io.iges.surfaces import is_box, surfaces_of_iges
from assoc_hull.io.iges.write import IgesLayout, iges_text


def test_an_iges_file_as_lines_of_five_sections() -> None:
    """An IGES file as lines of five sections, and its free-format text as tokens."""
    assert split_tokens("1H,,1H;,4Hab,c,1.5D1;", ",", ";", "here") == [",", ";", "ab,c", "1.5D1"]
    assert [
        isinstance(each, Hollerith) for each in split_tokens("4H1.5;,1.5;", ",", ";", "here")
    ] == [True, False]


def test_the_parameters_of_one_entity_of_an_iges_file() -> None:
    """The parameters of one entity of an IGES file: whole numbers, reals, pointers, text,
    checked."""
    record = IgesRecord(["124", "1.", "2.5D-1", ""], "here")
    assert (record.whole(0, "the type"), record.reals(1, 3, "the matrix").tolist()) == (
        124,
        [1.0, 0.25, 0.0],
    )


def test_the_entities_of_an_iges_file_the_directory() -> None:
    """The entities of an IGES file: the directory, the parameters of each, units and scale."""
    plate = SplineSurface.bezier(
        np.array([[[0, 0, 0], [0, 1, 0]], [[2, 0, 0], [2, 1, 0]]], float), "plate"
    )
    file = IgesFile.of_text(iges_text([plate]), "plate.igs")
    assert (file.metres, [entry.kind for entry in file.entries.values()]) == (1.0, [128, 406])


def test_the_sections_of_an_iges_file_that_is_written() -> None:
    """The sections of an IGES file that is written: entities with their names, and the head."""
    layout = IgesLayout()
    layout.add_named(116, ["0.", "0.", "1.5", "0"], "top")
    assert (
        str(layout.text("A point", "m", 1.5).splitlines()[-1])
        == "S      1G      3D      4P      2                                        T      1"
    )


def test_spline_surfaces_as_an_iges_file_entities_128_each() -> None:
    """Spline surfaces as an IGES file: entities 128, each with its name (406, form 15)."""
    plate = SplineSurface.bezier(
        np.array([[[0, 0, 0], [0, 1, 0]], [[2, 0, 0], [2, 1, 0]]], float), "plate"
    )
    assert (
        str(iges_text([plate]).splitlines()[-1])
        == "S      1G      3D      4P      3                                        T      1"
    )


def test_names_of_entities_of_an_iges_file() -> None:
    """Names of entities of an IGES file, and the unit of their lengths."""
    assert readable_name("b\xc3\xbcrge") == "bürge"


def test_how_entities_of_an_iges_file_are_moved_chains() -> None:
    """How entities of an IGES file are moved: chains of transformations, entity 124."""
    turn = Transformation(np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]]), np.zeros(3))
    shift = Transformation(np.eye(3), np.array([0.0, 0, 5]))
    assert turn.then(shift).of(np.array([[1.0, 0, 0]])).tolist() == [[0.0, 1.0, 5.0]]


def test_spline_curves_and_surfaces_of_an_iges_file_entities() -> None:
    """Spline curves and surfaces of an IGES file: entities 126 and 128, as they stand in the
    file."""
    values = [
        "126",
        "1",
        "1",
        "1",
        "0",
        "1",
        "0",
        "0.",
        "0.",
        "1.",
        "1.",
        "1.",
        "1.",
        "0.",
        "0.",
        "0.",
        "2.",
        "0.",
        "0.",
        "0.",
        "1.",
    ]
    assert spline_curve(IgesRecord(values, "here")).points.tolist() == [
        [0.0, 0.0, 0.0],
        [2.0, 0.0, 0.0],
    ]


def test_whether_the_border_of_a_face() -> None:
    """Whether the border of a face is that of its surface: then it is not trimmed."""
    box = ((0.0, 1.0), (0.0, 2.0))
    corners = np.array([[0.0, 0], [1, 0], [1, 2], [0, 2], [0, 0]])
    sides = [corners[i : i + 2] for i in range(4)]
    assert (is_box(sides, box), is_box(sides[:3], box)) == (True, False)


def test_untrimmed_spline_surfaces_of_an_iges_file_moved() -> None:
    """Untrimmed spline surfaces of an IGES file, moved to where they belong, in metres."""
    plate = SplineSurface.bezier(
        np.array([[[0, 0, 0], [0, 1, 0]], [[2, 0, 0], [2, 1, 0]]], float), "plate"
    )
    found, unit, _notes = surfaces_of_iges(iges_text([plate], "mm"), "plate.igs")
    assert (found[0].name, found[0].net[1, 1].tolist(), unit) == ("plate", [2.0, 1.0, 0.0], "mm")
