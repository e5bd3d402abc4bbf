"""Designs: what is checked, and what JSON holds of them."""

import json
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from assoc_hull.creation.design import Design, design_document, design_schema
from assoc_hull.creation.form_definitions import course, design_waterline, sectional_area
from assoc_hull.errors import (
    AssocHullError,
    BadInputError,
    NameTakenError,
    OutOfRangeError,
    UnknownNameError,
)
from assoc_hull.model.forms.closure import coefficients
from assoc_hull.model.tables import Particulars
from assoc_hull.tolerance import Tolerances

SHIP = Particulars("ship", 180.0, 28.0, 15.8, 10.5)

HALF: dict[str, Any] = {
    "run_end": -0.208, "entrance_start": 0.34, "run_area": 0.511, "run_centroid": -0.488,
    "run_start_angle_deg": 25.0, "entrance_end_angle_deg": -54.0,
}  # fmt: skip


def definitions() -> list[Any]:
    """What a design cannot do without."""
    return [
        sectional_area(SHIP, cm=0.995, cb=0.75, lcb=2.9, **HALF),
        design_waterline(SHIP, cw=0.77, lcf=4.2, **HALF),
        course("profile", {"stern": (-4.0, 11.0), "keel": (8.0, 0.0, 0.0), "stem": (182.0, 15.8)}),
        course("deck_side", {"AP": (-4.0, 8.0), "body": (60.0, 14.0), "FP": (182.0, 0.0)}),
        course("deck_height", {"AP": (-4.0, 15.8), "FP": (182.0, 15.8)}, rule="straight"),
    ]


def design(**changes: Any) -> Design:
    """A design of a ship."""
    given = {"stations": [0, 10, 20, -0.25], "waterlines": (5, 2.5), "buttocks": [4.0]}
    return Design(SHIP, **{"definitions": definitions(), **given, **changes})


def test_places_are_put_in_order() -> None:
    """Stations count from AP to FP in twentieths of the length."""
    found = design()
    assert found.stations == (-0.25, 0.0, 10.0, 20.0)
    assert found.station_places == (-2.25, 0.0, 90.0, 180.0)
    assert found.waterlines == (2.5, 5.0)


def test_json_gives_the_same_design() -> None:
    """There and back every number keeps its last bit."""
    one = design(transom=-4.0, tolerances=Tolerances(spacing=0.12))
    assert Design.from_json(one.to_json()) == one


def test_json_from_a_file(tmp_path: Any) -> None:
    """A path is read as text is."""
    file = tmp_path / "ship.json"
    file.write_text(design().to_json(), encoding="utf-8")
    assert Design.from_json(file) == Design.from_json(str(file)) == design()
    file.write_text(design().to_json(), encoding="utf-8-sig")
    assert Design.from_json(file) == design(), "editors of Windows put a mark before it"


def test_the_schema_takes_what_is_written() -> None:
    """A validator that knows nothing of the package agrees with the reader."""
    validator = Draft202012Validator(design_schema())
    document = json.loads(design(transom=-4.0).to_json())
    validator.validate(document)
    document["definitions"][0]["values"]["run_end"] = "x"
    assert not validator.is_valid(document)


def test_json_may_ask_for_a_closure() -> None:
    """What is written by hand need not know the entrance."""
    document = design_document(design())
    values = document["definitions"][0]["values"]
    del values["entrance_area"], values["entrance_centroid"]
    document["definitions"][0]["close"] = {"cb": 0.749, "lcb": 2.8}
    found = coefficients(Design.from_json(json.dumps(document)).definition("sectional_area"), SHIP)
    assert (found.block, found.centroid) == pytest.approx((0.749, 2.8), abs=1e-12)


def test_a_design_can_be_closed() -> None:
    """Areas and waterline at once; what is not asked for keeps its definition."""
    one = design()
    found = one.closed(cb=0.749, lcb=2.8, cw=0.769)
    areas = coefficients(found.definition("sectional_area"), SHIP)
    line = coefficients(found.definition("design waterline"), SHIP)
    assert (areas.block, areas.centroid) == pytest.approx((0.749, 2.8), abs=1e-12)
    assert (line.fullness, line.centroid) == pytest.approx((0.769, 4.2), abs=1e-12)
    assert found.definition("profile") is one.definition("profile")
    with pytest.raises(OutOfRangeError, match=r"cb of 0\.99"):
        one.closed(cb=0.99)


@pytest.mark.parametrize(
    ("changes", "error", "words"),
    [
        pytest.param({"definitions": []}, BadInputError, "lacks sectional_area", id="nothing"),
        pytest.param(
            {"definitions": [*definitions(), definitions()[2]]}, BadInputError, "defined twice",
            id="a use twice",
        ),
        pytest.param(
            {"definitions": [*definitions(), course("centroid", {"AP": (0, 5)}, name="profile")]},
            NameTakenError, "profile", id="a name twice",
        ),
        pytest.param({"stations": [1, 1.0]}, BadInputError, "two of the stations", id="one place"),
        pytest.param({"stations": ["a"]}, BadInputError, "position of lines", id="a word"),
        pytest.param({"waterlines": [[1.0]]}, BadInputError, "position of lines", id="a table"),
        pytest.param({"transom": "aft"}, BadInputError, "transom is 'aft'", id="a word as transom"),
        pytest.param({"tolerances": 1.0}, BadInputError, "tolerances is 1.0", id="one tolerance"),
    ],
)  # fmt: skip
def test_designs_that_are_none(
    changes: dict[str, Any], error: type[AssocHullError], words: str
) -> None:
    """The error names what is wrong."""
    with pytest.raises(error, match=words):
        design(**changes)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        pytest.param("{", "is no JSON", id="no JSON"),
        pytest.param("{}", "'format' is missing", id="empty"),
        pytest.param("no-such-file.json", "No such file", id="no file"),
    ],
)
def test_texts_that_hold_no_design(text: str, words: str) -> None:
    """Where something is wrong, and what."""
    with pytest.raises(BadInputError, match=words):
        Design.from_json(text)


def test_the_place_of_a_fault_in_a_document_is_told() -> None:
    """By the way to it."""
    document = design_document(design())
    document["definitions"][2]["nodes"][1]["x"] = None
    with pytest.raises(BadInputError, match=r"at definitions\[2\].nodes\[1\].x"):
        Design.from_json(json.dumps(document))


def test_an_unknown_definition() -> None:
    """The nearest names are told."""
    with pytest.raises(UnknownNameError, match="profile"):
        design().definition("profil")


@pytest.mark.parametrize(
    ("use", "nodes", "words"),
    [
        pytest.param("sectional_area", {"AP": (0, 1)}, "two halves", id="halves"),
        pytest.param("keel", {"AP": (0, 1)}, "nearest names are 'keel_angle'", id="an unknown use"),
        pytest.param("centroid", {}, "no nodes", id="no nodes"),
        pytest.param("centroid", [(0, 1)], "nodes is", id="a list"),
        pytest.param("centroid", {"AP": (0,)}, "shape", id="one number"),
        pytest.param("centroid", {"AP": {"x": 0}}, "y is missing", id="half a node"),
        pytest.param("centroid", {"AP": {"x": 0, "y": 1, "z": 2}}, "named 'z'", id="z"),
    ],
)
def test_courses_that_are_none(use: str, nodes: Any, words: str) -> None:
    """The error names use and node."""
    with pytest.raises((BadInputError, UnknownNameError), match=words):
        course(use, nodes)
