"""Files of lines that the package wrote give the very hull back, or say what has become of them."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.hull import Hull
from assoc_hull.io.importing.own_files import own_dxf_lines
from tests.conftest import Shipped
from tests.long_forms import LONG
from tests.own_files import FORMS, facts, went_and_came

SHIPPED = (
    "wigley", "series60_60", "series60_70", "bulk_carrier", "bulk_carrier_180m",
    "container_ship_225m", "plain_ship", "seaking_ship", "sfolds_ship", "prelikon_ship",
)  # fmt: skip
EVERY = [(ship, form) for ship in SHIPPED for form in FORMS]
SOME = [("bulk_carrier", "dxf"), ("plain_ship", "iges-lines"), ("wigley", "3dm")]


@pytest.mark.parametrize(("ship", "form"), EVERY if LONG else SOME)
def test_own_lines_come_back_as_they_were(
    shipped: Shipped, tmp_path: Path, ship: str, form: str
) -> None:
    """Curves to 1e-9 m, no new inflection; names, flats, kinds, roles, features, particulars."""
    hull = shipped(ship)
    back, found = went_and_came(hull, tmp_path / f"ship{FORMS[form]}", form)
    assert found.away <= 1e-9
    assert found.inflections == 0
    assert facts(back) == facts(hull)
    assert back.check() == ()
    assert back.adoption is not None
    assert "verdict: sound" in back.adoption.notes


@pytest.fixture(scope="module")
def edited(shipped: Shipped) -> Hull:
    """A hull with all that an edit can leave on its lines."""
    hull = shipped("wigley")
    with hull.edit("by hand") as edit:
        edit.move("WL 2.5 x ST 10", y=3.4)
        edit.insert("WL 3.125", (42.3, 3.72, 3.125), lead=False)
        edit.set_kind("WL 5 x ST 4", "knuckle")
        edit.set_kind("WL 5 x ST 8", "tangent", direction=(1.0, 0.05, 0.0))
        edit.set_end("WL 1.25", "start", tangent=(1.0, 0.3, 0.0))
        edit.set_end("WL 1.25", "finish", curvature=(0.0, 0.001, 0.0))
        edit.add_line("sections", 33.3)
        edit.rename("ST 6.66", 'Spant 7 ü^|% "x"')
    return hull


@pytest.mark.parametrize(
    ("form", "unit"),
    [("dxf", "mm"), ("iges-lines", "mm"), *([("dxf", "m"), ("3dm", "mm")] if LONG else [])],
)
def test_edited_lines_come_back_in_any_unit(
    edited: Hull, tmp_path: Path, form: str, unit: str
) -> None:
    """Placed points, knuckles, tangents, ends and odd names are in the file as well."""
    path = tmp_path / f"ship{FORMS[form]}"
    edited.export(path, form, unit)
    back = ah.read(path, unit=unit)
    assert facts(back) == facts(edited)
    assert back.state.definitions == ()


def test_it_is_told_what_the_form_does_not_hold(shipped: Shipped, tmp_path: Path) -> None:
    """Definitions by form parameters stay behind: the report of the export says so."""
    report = shipped("plain_ship").export(tmp_path / "ship.dxf")
    assert [note.kind for note in report.left_out] == ["definitions"]


def test_particulars_may_be_given(edited: Hull, tmp_path: Path) -> None:
    """What moves no line may be said of a file of ours too."""
    path = tmp_path / "ship.dxf"
    edited.export(path)
    back = ah.read(path, draught=5.0, deck="closed")
    assert (back.particulars.draught, back.particulars.deck) == (5.0, "closed")
    assert back.particulars.length == edited.particulars.length


def moved(text: str) -> str:
    """Move a control point by a micrometre."""
    place = re.search(r"\n 10\n(\d+\.\d+)\n 20\n(\d\.\d{3,})\n", text)
    assert place is not None
    y = f"{float(place[2]) + 1e-6:.17g}"
    return text[: place.start(2)] + y + text[place.end(2) :]


def without_a_curve(text: str) -> str:
    """Leave out the last spline."""
    first = text.rindex("  0\nSPLINE\n")
    return text[:first] + text[text.index("  0\nENDSEC", first) :]


CHANGES = {
    "a control point moved": (moved, "off the curve through its points"),
    "a curve deleted": (without_a_curve, "it has 31 curves of the 32"),
    "a curve drawn twice": (
        lambda text: text.replace(
            "  0\nENDSEC\n  0\nSECTION\n  2\nOBJECTS",
            text[text.rindex("  0\nSPLINE\n") : text.index("  0\nENDSEC", text.rindex("SPLINE"))]
            + "  0\nENDSEC\n  0\nSECTION\n  2\nOBJECTS",
        ),
        "1 curves were added",
    ),
    "a text damaged": (
        lambda text: text.replace('"particulars":{', '"particulars":['), "cannot be read",
    ),
    "a later version": (
        lambda text: text.replace('"assoc-hull\\u0020lines":1', '"assoc-hull\\u0020lines":2'),
        "of version 2",
    ),
    "a unit unsaid": (lambda text: re.sub(r"INSUNITS\n 70\n\d+", "INSUNITS\n 70\n0", text), "unit"),
}  # fmt: skip


@pytest.fixture(scope="module")
def drawing(edited: Hull, tmp_path_factory: pytest.TempPathFactory) -> str:
    """The drawing of the edited hull."""
    path = tmp_path_factory.mktemp("drawing") / "ship.dxf"
    edited.export(path)
    return path.read_text(encoding="utf-8")


@pytest.mark.parametrize("change", CHANGES)
def test_a_change_by_another_program_is_seen(drawing: str, change: str) -> None:
    """A curve or text that is not as it was written makes the drawing none of ours."""
    act, words = CHANGES[change]
    assert act(drawing) != drawing
    found = own_dxf_lines(act(drawing), "ship.dxf")
    assert found is not None
    assert words in found.fault
    known = own_dxf_lines(drawing, "ship.dxf")
    assert known is not None
    assert known.fault == ""


def test_a_changed_drawing_is_read_as_any_other(drawing: str, tmp_path: Path) -> None:
    """It is read as digitised lines, and says so."""
    path = tmp_path / "ship.dxf"
    path.write_text(moved(drawing), encoding="utf-8")
    back = ah.read(path, accept=True)
    assert back.adoption is not None
    told = [note for note in back.adoption.notes if "own file" in note]
    assert len(told) == 1
    assert "off the curve through its points" in told[0]
    assert "read as digitised lines" in told[0]


def test_an_option_that_moves_lines_makes_digitised_lines_of_them(
    edited: Hull, tmp_path: Path
) -> None:
    """A scale is for drawings of others, and is told."""
    path = tmp_path / "ship.dxf"
    edited.export(path)
    back = ah.read(path, scale=2.0, accept=True)
    assert back.adoption is not None
    assert any("scale was given" in note for note in back.adoption.notes)
    assert back.particulars.length == pytest.approx(2.0 * edited.particulars.length, rel=1e-3)


def test_images_to_starboard_are_no_curves_of_their_own(edited: Hull, tmp_path: Path) -> None:
    """Lines written to both sides come back as the half that they are."""
    from assoc_hull.io.iges.write import write_iges_lines

    write_iges_lines(edited.state, tmp_path / "both.igs", half=False)
    assert facts(ah.read(tmp_path / "both.igs")) == facts(edited)
