"""Surfaces as tables and as JSON, and how a file is told to be one or the other."""

from __future__ import annotations

import json
from collections.abc import Callable
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from jsonschema import Draft202012Validator

import assoc_hull as ah
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.io.surfaces.control_nets import nets_of_table, table_of_nets
from assoc_hull.io.surfaces.surface_file import ReadSurfaces, read_surface_file, write_surfaces
from assoc_hull.io.surfaces.surface_json import json_of_surfaces, surfaces_of_json, surfaces_schema
from assoc_hull.io.tables.json_schema import dumps_schema
from tests.curved_patches import nets
from tests.iges_files import Entity, iges, surface

HEAD = "patch,i_u,j_v,x,y,z"
ROWS = [f"deck,{i},{j},{2 * i},{j},0.5" for i in (0, 1, 2) for j in (0, 1)]
NET = np.array([[[2.0 * i, j, 0.5] for j in (0, 1)] for i in (0, 1, 2)])


def table(*rows: str, head: str = HEAD) -> str:
    """A table of these rows."""
    return "\n".join([head, *rows]) + "\n"


def nets_of(text: str, unit: str | None = None) -> list[SplineSurface]:
    """The surfaces of a table."""
    return nets_of_table(text, "nets.csv", unit)[0]


def test_rows_may_come_in_any_order() -> None:
    """Points say where they stand; patches come in the order of their names."""
    mixed = [ROWS[i] for i in (5, 0, 3)] + ["side,1,1,1,1,1"] + [ROWS[i] for i in (1, 4, 2)]
    side = [f"side,{i},{j},{i},{j},0" for i, j in ((0, 0), (0, 1), (1, 0))]
    found = nets_of(table("# a comment", *mixed, "", *side))
    assert [each.name for each in found] == ["deck", "side"]
    assert np.array_equal(found[0].net, NET)
    assert found[0].degrees == (2, 1)


def test_units_and_weights_are_taken() -> None:
    """Millimetres become metres, weights stay as they are; a header may be quoted."""
    rows = [f"{row},{1 + k}" for k, row in enumerate(ROWS)]
    (found,) = nets_of(table(*rows, head=f'"{HEAD.replace(",", chr(34) + "," + chr(34))}",w'), "mm")
    assert found.net == pytest.approx(1e-3 * NET)
    assert found.weights is not None
    assert found.weights.ravel().tolist() == [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]


@pytest.mark.parametrize("mark", [";", "\t"], ids=["semicolons", "tabs"])
def test_other_marks_part_cells_too(mark: str) -> None:
    """As spreadsheets write them where the comma is the decimal point."""
    text = table(*ROWS).replace(",", mark).replace("0.5", "0,5")
    assert np.array_equal(nets_of(text)[0].net, NET)


def test_reference_patches_come_back_to_the_last_bit() -> None:
    """Written with all digits, and read."""
    given = [SplineSurface.bezier(net, name) for name, net in nets().items()]
    found = nets_of(table_of_nets(given))
    assert [each.name for each in found] == list(nets())
    for one, other in zip(given, found, strict=True):
        assert one.net.tobytes() == other.net.tobytes()


REFUSED_TABLES = {
    "no header": (table(*ROWS[1:], head=ROWS[0]), "header of control nets is missing.*line 1"),
    "another column": (table(*ROWS, head=HEAD.replace("z", "height")), "header of control nets"),
    "no rows": (table(), "there are no points"),
    "a point is missing": (table(*ROWS[:4], *ROWS[5:]), "has no point 2,0 of 3 x 2.*lines 2 to 6"),
    "points are missing": (table(*ROWS[:3], ROWS[5]), "has no point 1,1 and 1 more of 3 x 2"),
    "a point comes twice": (table(*ROWS, ROWS[2]), "line 8 .first in line 4"),
    "one point": (table(ROWS[0]), "has 1 x 1 points"),
    "one row": (table(*ROWS[:2]), "has 1 x 2 points"),
    "text for a number": (table(*ROWS[:5], "deck,2,1,4,one,0"), "y is 'one', nets.csv, line 7"),
    "nan": (table(*ROWS[:5], "deck,2,1,4,nan,0"), "y is 'nan', nets.csv, line 7"),
    "a place that is none": (table(*ROWS[:5], "deck,2,-1,4,1,0"), "j_v is '-1', nets.csv, line 7"),
    "no name": (table(*ROWS[:5], " ,2,1,4,1,0"), "name of the patch is empty, nets.csv, line 7"),
    "a cell too many": (table(*ROWS, "deck,0,0,0,0,0,0"), "has 7 cells, and the header 6"),
    "too high a degree": (
        table(*(f"a,{i},{j},{i},{j},0" for i in range(9) for j in (0, 1))),
        "9 x 2 points, of degree 8 and 1.*JSON or IGES",
    ),
    "a number too large": (table(*ROWS[:5], "deck,2,1,4,1e7,0"), "nets.csv, lines 2 to 7.*1e\\+06"),
    "a quotation left open": (table(*ROWS, '"deck,0,0,0,0,0'), "this is no table"),
}


@pytest.mark.parametrize(("text", "words"), REFUSED_TABLES.values(), ids=REFUSED_TABLES)
def test_a_table_that_holds_no_nets_is_refused_by_its_lines(text: str, words: str) -> None:
    """Each fault, with the line that has it."""
    with pytest.raises(BadInputError, match=words):
        nets_of(text)


def test_a_table_holds_bezier_surfaces_with_names_only() -> None:
    """What it cannot hold is refused, before anything is written."""
    knots = [0.0, 0, 1, 2, 2], [0.0, 0, 1, 1]
    strips = SplineSurface("strips", (1, 1), np.array(knots[0]), np.array(knots[1]), NET)
    named = SplineSurface.bezier(NET, "deck")
    for wrong in ([strips], [named, named], [SplineSurface.bezier(NET)]):
        with pytest.raises(BadInputError):
            table_of_nets(wrong)


def spline() -> SplineSurface:
    """A rational B-spline surface with numbers of all sizes."""
    rng = np.random.default_rng(3)
    net = rng.normal(size=(5, 4, 3)) * 10.0 ** rng.integers(-9, 4, (5, 4, 3))
    knots = np.array([0.0, 0, 0, 1 / 3, 2 / 3, 1, 1, 1]), np.array([0.0, 0, 0, 0, 7, 7, 7, 7])
    return SplineSurface("shell, aft", (2, 3), *knots, net, rng.uniform(0.1, 3.0, (5, 4)))


@pytest.mark.parametrize("ending", [".json", ".igs"])
def test_files_come_back_to_the_last_bit(tmp_path: Path, ending: str) -> None:
    """Names, knots, nets and weights, through a file."""
    given, path = [spline(), SplineSurface.bezier(NET, "deck")], tmp_path / f"shell{ending}"
    write_surfaces(given, path)
    found = ah.surface.read_surfaces(path)
    assert isinstance(found, ReadSurfaces)
    assert (found.unit, found.notes) == ("m", ())
    for one, other in zip(given, found, strict=True):
        assert (one.name, one.degrees) == (other.name, other.degrees)
        for name in ("net", "knots_u", "knots_v", "weights"):
            first, second = getattr(one, name), getattr(other, name)
            assert (first is None) == (second is None)
            assert first is None or first.tobytes() == second.tobytes()


def document(**changes: Any) -> dict[str, Any]:
    """A good document, changed."""
    given = json.loads(json_of_surfaces([SplineSurface.bezier(NET, "deck")]))
    return {**given, **changes}


def of_surface(**changes: Any) -> dict[str, Any]:
    """A good document whose surface is changed."""
    given = document()
    return {**given, "surfaces": [{**given["surfaces"][0], **changes}]}


def test_the_schema_is_that_of_the_reader() -> None:
    """If not: ``assoc-hull schema --of surfaces -o assoc_hull/io/surfaces.schema.json``."""
    schema = surfaces_schema()
    Draft202012Validator.check_schema(schema)
    shipped = resources.files("assoc_hull.io").joinpath("surfaces.schema.json")
    assert shipped.read_text("utf-8") == dumps_schema(schema)
    Draft202012Validator(schema).validate(json.loads(json_of_surfaces([spline()])))


def test_what_is_left_out_is_a_patch_of_equal_weights() -> None:
    """Knots from 0 to 1; a document that people write by hand is short."""
    short = {"name": "deck", "degrees": [2, 1], "net": NET.tolist()}
    text = json.dumps(document(unit="mm", surfaces=[short]))
    (found,), unit, notes = surfaces_of_json(text, "deck.json")
    assert found.domain == ((0.0, 1.0), (0.0, 1.0))
    assert found.net == pytest.approx(1e-3 * NET)
    assert (unit, notes) == ("mm", ())
    _, unit, notes = surfaces_of_json(text, "deck.json", "m")
    assert unit == "m"
    assert notes == ("deck.json says that its unit is mm; it is read in m, as asked.",)


REFUSED_DOCUMENTS: dict[str, tuple[object, str]] = {
    "no JSON": ("{", "line 1, column 2"),
    "a list": ([], "the format is None"),
    "another format": (document(format="gltf"), "the format is 'gltf'"),
    "a hull": ({"format": "assoc-hull"}, "this is a hull, and no file of surfaces"),
    "a newer form": (document(schema=2), "in deck.json, schema"),
    "another unit": (document(unit="inch"), "in deck.json, unit"),
    "no surfaces": (document(surfaces=[]), "in deck.json, surfaces"),
    "an unknown key": (document(colour="red"), "'colour' is unknown"),
    "a degree of nil": (of_surface(degrees=[0, 1]), r"surfaces\[0\].degrees\[0\]"),
    "a degree too high": (of_surface(degrees=[9, 1], knots_u=None), r"surfaces\[0\].knots_u"),
    "ragged rows": (of_surface(net=[NET[0].tolist(), NET[0].tolist() * 2]), "2 to 4 points"),
    "a place in a plane": (of_surface(net=[[[0, 0], [0, 1]], [[1, 0], [1, 1]]]), r"net\[0\]\[0\]"),
    "a number as text": (of_surface(name=7), r"surfaces\[0\].name"),
    "knots that fall": (of_surface(knots_v=[0, 1, 0, 1]), "falls from 1 to 0.*surface 1"),
    "too few knots": (of_surface(knots_u=[0, 0, 1, 1]), "4 knots for 3.*surface 1"),
    "a weight of nil": (of_surface(weights=[[1, 1], [1, 0], [1, 1]]), r"weights\[1\]\[1\]"),
    "ragged weights": (of_surface(weights=[[1, 1], [1, 1, 1]]), "2 to 3 points"),
}


@pytest.mark.parametrize(("given", "words"), REFUSED_DOCUMENTS.values(), ids=REFUSED_DOCUMENTS)
def test_a_document_that_holds_no_surfaces_is_refused_by_its_place(
    given: object, words: str
) -> None:
    """Each fault, with the way to it."""
    text = given if isinstance(given, str) else json.dumps(given)
    with pytest.raises(BadInputError, match=words):
        surfaces_of_json(text, "deck.json")


def test_a_degree_beyond_all_use_makes_no_list_of_knots() -> None:
    """Knots that are left out are made of the degree: a vast one is refused first."""
    short = {"name": "deck", "degrees": [2**40, 1], "net": NET.tolist()}
    with pytest.raises(BadInputError, match="a degree is 1099511627776"):
        surfaces_of_json(json.dumps(document(surfaces=[short])), "deck.json")


CONTENTS: dict[str, tuple[Callable[[], bytes], str]] = {
    "csv": (lambda: table(*ROWS).encode(), "csv"),
    "csv with a mark of its coding": (lambda: b"\xef\xbb\xbf" + table(*ROWS).encode(), "csv"),
    "csv of Windows": (lambda: table(*ROWS).replace("\n", "\r\n").encode(), "csv"),
    "csv of semicolons": (lambda: table(*ROWS).replace(",", ";").encode(), "csv"),
    "json": (lambda: b"\n " + json.dumps(document()).encode(), "json"),
    "iges": (lambda: iges([surface()]).encode(), "iges"),
}


@pytest.mark.parametrize(("content", "form"), CONTENTS.values(), ids=CONTENTS)
def test_content_tells_the_form_of_a_file(
    tmp_path: Path, content: Callable[[], bytes], form: str
) -> None:
    """Not its name, which ends in what it likes."""
    path = tmp_path / "surfaces.dat"
    path.write_bytes(content())
    found = read_surface_file(path)
    assert found.form == form
    assert len(found) == 1


@pytest.mark.parametrize("coding", ["latin-1", "utf-8"])
def test_columns_of_iges_are_bytes(tmp_path: Path, coding: str) -> None:
    """A letter that is two bytes shifts nothing; names come as they were meant."""
    shape, name = surface(after=[0, 1, 3]), "Hülle".encode(coding)
    text = iges([shape, Entity(406, [1, f"{len(name)}H{name.decode('latin-1')}"], form=15)])
    path = tmp_path / "shell.igs"
    path.write_bytes(text.encode("latin-1"))
    assert ah.surface.read_surfaces(path)[0].name == "Hülle"


@pytest.mark.parametrize(
    ("data", "words"),
    [
        pytest.param(b"", "nothing in the file", id="empty"),
        pytest.param(b"solid hull\n", "the form is unknown", id="mesh"),
        pytest.param(b"ISO-10303-21;\nHEADER;\n", "this is a STEP file", id="STEP"),
        pytest.param(b"SQLite format 3\x00" + b"\0" * 100, "this is a hull", id="hull file"),
        pytest.param(b"\x00\xff" * 100, "the form is unknown", id="binary"),
    ],
)
def test_other_files_are_refused(tmp_path: Path, data: bytes, words: str) -> None:
    """And what could be read instead is told."""
    path = tmp_path / "surfaces.dat"
    path.write_bytes(data)
    with pytest.raises(BadInputError, match=words):
        ah.surface.read_surfaces(path)


def test_a_file_that_is_not_there_or_a_unit_that_is_none_is_refused(tmp_path: Path) -> None:
    """Without a word of Python's own."""
    with pytest.raises(BadInputError, match="cannot be read"):
        ah.surface.read_surfaces(tmp_path / "no.csv")
    with pytest.raises(BadInputError, match="cannot be read"):
        ah.surface.read_surfaces(tmp_path)
    with pytest.raises(BadInputError, match="unit is 'yd'"):
        ah.surface.read_surfaces(tmp_path / "no.csv", unit="yd")


def test_a_large_file_is_refused_unread(tmp_path: Path) -> None:
    """200 MB are the limit: nothing is made of its size."""
    path = tmp_path / "large.igs"
    with path.open("wb") as file:
        file.truncate(200_000_001)
    with pytest.raises(BadInputError, match="more than 200 MB"):
        ah.surface.read_surfaces(path)


@pytest.mark.parametrize("name", ["shell.csv", "shell.json", "shell.igs", "shell.IGES"])
def test_the_ending_of_a_name_chooses_the_form(tmp_path: Path, name: str) -> None:
    """Of what is written; the same surfaces give the same bytes."""
    given = ah.examples.typical_plates()
    write_surfaces(given, tmp_path / name)
    first = (tmp_path / name).read_bytes()
    write_surfaces(ah.surface.read_surfaces(tmp_path / name), tmp_path / name)
    assert (tmp_path / name).read_bytes() == first


def test_another_ending_is_refused(tmp_path: Path) -> None:
    """Nothing is written."""
    with pytest.raises(BadInputError, match="the ending of the name tells no form"):
        write_surfaces(ah.examples.typical_plates(), tmp_path / "shell.stp")
    assert list(tmp_path.iterdir()) == []


def test_six_plates_ship_one_of_each_kind() -> None:
    """Flat, rolled, convex, hollow and mixed; of a size that a shipyard handles."""
    found = ah.surface.plates(ah.examples.typical_plates())
    assert dict(zip(found.column("name"), found.column("kind"), strict=True)) == {
        "flat of side": "flat", "bilge": "cylinder", "fore bilge": "cylinder",
        "bulb shoulder": "convex", "stern hollow": "saddle", "bow flare": "mixed",
    }  # fmt: skip
    assert min(found.column("breadth")) > 1.7
    assert max(found.column("length")) < 8.1
    assert found["fore bilge"].total_curvature < 1e-12
