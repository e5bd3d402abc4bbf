"""Plates of a hull as a table and as a document."""

from __future__ import annotations

import csv
import json
from importlib import resources
from pathlib import Path

import numpy as np
import pytest
from jsonschema import Draft202012Validator

from assoc_hull.errors import BadInputError
from assoc_hull.io.tables.json_schema import dumps_schema
from assoc_hull.io.tables.plates import (
    hull_plates_schema,
    plates_csv,
    plates_document,
    write_plates,
)
from assoc_hull.surface.plating.hull_plates import HullPlateTable, hull_plates
from assoc_hull.surface.plating.hull_seams import HullSeams
from assoc_hull.surface.plating.plate_table import HULL_COLUMNS
from tests.formula_sides import BOWL

VALIDATOR = Draft202012Validator(hull_plates_schema())


@pytest.fixture(scope="module")
def plates() -> HullPlateTable:
    """Four plates: bent both ways, and with a border of blocks in their middle."""
    aft = BOWL.surface((-12.0, 0.0), (-5.0, 5.0), (2, 2), "body")
    fore = BOWL.surface((0.0, 9.0), (-5.0, 5.0), (2, 2), "bow")
    return hull_plates((aft, fore), HullSeams(x=1.0, z=0.0), zero="absolute", k0=7e-3)


def test_the_document_is_what_the_schema_tells(plates: HullPlateTable) -> None:
    """With what is not there as null: no seam at an end, no other fit, no class."""
    document = plates_document(plates)
    VALIDATOR.validate(document)
    VALIDATOR.validate(json.loads(json.dumps(document, allow_nan=False)))
    first = document["plates"][0]
    assert first["ranges"] == {"x": [None, 1.0], "z": [None, 0.0], "girth": [None, None]}
    assert (first["dk"], first["kind"], document["fits"]) == (None, None, 0)
    assert first["blocks"] == ["body", "bow"]


def test_the_schema_refuses_what_is_no_table(plates: HullPlateTable) -> None:
    """Another class, a number as text, a key that is unknown."""
    for key, value in {"kind": "round", "area": "19.2", "colour": "red", "dk": "nil"}.items():
        document = plates_document(plates)
        document["plates"][0][key] = value
        assert not VALIDATOR.is_valid(document)


def test_the_schema_that_ships_is_that_of_the_writer() -> None:
    """If not: ``assoc-hull schema --of hull-plates -o assoc_hull/io/hull_plates.schema.json``."""
    Draft202012Validator.check_schema(hull_plates_schema())
    shipped = resources.files("assoc_hull.io").joinpath("hull_plates.schema.json")
    assert shipped.read_text("utf-8") == dumps_schema(hull_plates_schema())


def test_the_table_has_all_digits(plates: HullPlateTable, tmp_path: Path) -> None:
    """Names, units, a row a plate; what is printed is rounded, what is written is not."""
    path = tmp_path / "plates.csv"
    write_plates(plates, path)
    assert path.read_text() == plates_csv(plates)
    names, units, *rows = csv.reader(path.read_text().splitlines())
    assert names == [column.name for column in HULL_COLUMNS]
    assert units == [column.unit for column in HULL_COLUMNS]
    areas = [float(row[names.index("area")]) for row in rows]
    assert areas == [plate.area for plate in plates]
    assert np.sum(areas) == pytest.approx(plates.regions.total, rel=1e-9)
    assert {row[names.index("dk")] for row in rows} == {""}


def test_another_ending_is_refused(plates: HullPlateTable, tmp_path: Path) -> None:
    """And nothing is written."""
    with pytest.raises(BadInputError, match="tells no form"):
        write_plates(plates, tmp_path / "plates.xls")
    assert not list(tmp_path.iterdir())


def test_words_tell_rows_advice_and_notes(plates: HullPlateTable) -> None:
    """The table has a line a plate; a plate without a class says why."""
    words = str(plates)
    assert words.splitlines()[0].split()[:4] == ["plate", "area", "a", "b"]
    for plate in plates:
        assert f"{plate.name}, {plate.range}: {plate.suggestion}." in words
        assert all(note in words for note in plate.notes)
    assert "Curvature was compared with no other fit" in words
