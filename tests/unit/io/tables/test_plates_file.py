"""Plates as a table and as a document: the same names, units and numbers as the objects."""

from __future__ import annotations

import csv
import json
from importlib import resources
from pathlib import Path

import numpy as np
import pytest
from jsonschema import Draft202012Validator

import assoc_hull as ah
from assoc_hull.errors import BadInputError
from assoc_hull.hull.results import Plates
from assoc_hull.io.tables.json_schema import dumps_schema
from assoc_hull.io.tables.plates import (
    development_csv,
    plates_csv,
    plates_document,
    plates_json,
    plates_schema,
)
from assoc_hull.surface.plating.development import LABEL
from assoc_hull.surface.plating.plate_table import COLUMNS
from assoc_hull.surface.plating.surface_plates import Seams

VALIDATOR = Draft202012Validator(plates_schema())


@pytest.fixture(scope="module")
def plates() -> Plates:
    """The plates that ship."""
    return ah.surface.plates(ah.examples.typical_plates())


def test_a_table_has_names_units_and_rows(plates: Plates) -> None:
    """Names are columns of the objects; numbers come back to the last digit; nothing is blank."""
    names, units, *rows = csv.reader(plates_csv(plates).splitlines())
    assert names == [column.name for column in COLUMNS]
    assert units == [column.unit for column in COLUMNS]
    assert [row[0] for row in rows] == plates.column("name")
    place = names.index("area")
    assert [float(row[place]) for row in rows] == plates.column("area")
    axes = [row[names.index("roll_axis")] for row in rows]
    assert axes == ["" if axis is None else repr(axis) for axis in plates.column("roll_axis")]
    assert [row[names.index("rollable")] for row in rows][:4] == ["true", "true", "true", "false"]


def test_a_document_has_what_the_table_has_and_more(plates: Plates) -> None:
    """Options, areas, axes in space, notes; it is as its schema says."""
    found = plates_document(plates)
    VALIDATOR.validate(json.loads(plates_json(plates)))
    assert [list(row)[: len(COLUMNS)] for row in found["plates"]] == [
        [column.name for column in COLUMNS]
    ] * len(plates)
    assert found["search"]["strain_tol"] == 1e-3
    flare = found["plates"][-1]
    assert flare["areas"]["positive"] == plates["bow flare"].areas.positive
    assert np.linalg.norm(flare["roll_direction"]) == pytest.approx(1.0)
    assert found["notes"] == list(plates.notes)


@pytest.mark.parametrize(
    "options",
    [
        pytest.param({"zero": "absolute", "k0": 1e-3}, id="absolute"),
        pytest.param({"zero": "exact", "delta": 0.0}, id="exact"),
        pytest.param({"breadth": None, "sagitta_length": 4.0}, id="own breadths"),
        pytest.param({"seams": Seams(u=0.5)}, id="seams"),
    ],
)
def test_every_mode_gives_a_valid_document(options: dict[str, object]) -> None:
    """What a mode does not have is null."""
    given = [ah.examples.typical_plates()[k] for k in (0, 5)]
    VALIDATOR.validate(plates_document(ah.surface.plates(given, **options)))  # type: ignore[call-overload]


def test_the_schema_that_ships_is_that_of_the_writer() -> None:
    """If not: ``python -m assoc_hull schema --of plates -o assoc_hull/io/plates.schema.json``."""
    Draft202012Validator.check_schema(plates_schema())
    shipped = resources.files("assoc_hull.io").joinpath("plates.schema.json")
    assert shipped.read_text("utf-8") == dumps_schema(plates_schema())


def test_the_schema_refuses_what_is_no_table_of_plates(plates: Plates) -> None:
    """Another class, a number as text, a key that is unknown or missing."""
    for key, value in {"kind": "round", "area": "19.2", "colour": "red", "order": 4}.items():
        found = plates_document(plates)
        found["plates"][0][key] = value
        assert not VALIDATOR.is_valid(found)
    found = plates_document(plates)
    del found["plates"][0]["k0"]
    assert not VALIDATOR.is_valid(found)


def test_the_ending_of_a_name_chooses_the_form(plates: Plates, tmp_path: Path) -> None:
    """A table or a document, the same bytes each time; another ending is refused."""
    plates.save(tmp_path / "plates.csv")
    assert (tmp_path / "plates.csv").read_text() == plates_csv(plates)
    plates.save(tmp_path / "plates.JSON")
    assert (tmp_path / "plates.JSON").read_text() == plates_json(plates)
    with pytest.raises(BadInputError, match="the ending of the name tells no form"):
        plates.save(tmp_path / "plates.xls")


def test_plates_that_were_saved_serve_as_earlier_ones(plates: Plates) -> None:
    """The face that writes is the same object to the search."""
    again = ah.surface.plates(ah.examples.typical_plates(), previous=plates)
    assert again.computed == 0
    assert plates_json(again) == plates_json(plates)


def test_a_plate_laid_flat_is_a_row_a_node(plates: Plates) -> None:
    """Places in space and in the plane, and strains to the next node; blank at the last."""
    flat = plates["bow flare"].development((5, 3))
    comment, *table = development_csv([flat]).splitlines()
    assert comment == f"# {LABEL}"
    names, units, *rows = csv.reader(table)
    assert len(rows) == 15
    assert {len(row) for row in (names, units, *rows)} == {12}
    assert [float(cell) for cell in rows[4][5:10]] == [*flat.place[1, 1], *flat.flat[1, 1]]
    assert float(rows[4][10]) == flat.longitudinal[1, 1]
    assert float(rows[4][11]) == flat.transverse[1, 1]
    assert [row[10] for row in rows[-3:]] == [""] * 3
    assert [row[11] for row in rows[2::3]] == [""] * 5
