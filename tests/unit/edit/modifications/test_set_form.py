"""set_form: a definition takes other values, and what is generated from it follows."""

import contextlib
from typing import Any

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.model.definition.records import definition
from assoc_hull.model.definition.restore import from_definition
from assoc_hull.model.tables import HullState, copy_state
from tests.formed import formed
from tests.independent import polynomial
from tests.unit.test_bad_arguments import BAD


@pytest.fixture(scope="module")
def made() -> HullState:
    """Give the net, made once."""
    return formed()


@pytest.fixture
def hull(made: HullState) -> ah.Hull:
    """Give a hull of its own for each test."""
    return ah.Hull(copy_state(made))


def area(hull: ah.Hull, line: str) -> float:
    """Give the area (m2) of a half section below the draught on its spline, by Gauss' rule."""
    state = hull.state
    number = next(i for i in state.live("lines").tolist() if state.lines.name[i] == line)
    spline = state.spline(state.curves_of(number)[0])
    shape = polynomial(spline)
    under = spline.knot[spline.xyz[:, 2] <= hull.particulars.draught + 1e-9]
    node, weight = np.polynomial.legendre.leggauss(4)
    middle, half = 0.5 * (under[1:] + under[:-1]), 0.5 * np.diff(under)
    at = middle[:, None] + half[:, None] * node
    strips = shape(at)[:, :, 1] * shape.derivative()(at)[:, :, 2]
    return float((strips * weight * half[:, None]).sum())


def test_sections_have_the_area_of_the_definition(hull: ah.Hull) -> None:
    """Within 1e-6 of the curve of areas, before and after it was changed."""
    for values in ({}, {"run_area": 0.513}):
        if values:
            with hull.edit("fuller") as edit:
                edit.set_form("areas", **values)
        from assoc_hull.model.generated_curves import forms_of

        wanted = 0.5 * float(forms_of(hull.state).value("sectional_area", 25.0)[0])
        assert area(hull, "ST 25") == pytest.approx(wanted, rel=1e-6)


def test_the_hull_is_that_of_the_other_definition(hull: ah.Hull) -> None:
    """A hull brought there by an edit has the bits of one made of the new definitions."""
    record = definition(hull.state)
    with hull.edit("fuller") as edit:
        edit.set_form("areas", run_area=0.512)
        edit.set_form("flare", AP_y=24.0)
    for each in record["definitions"]:  # type: ignore[attr-defined]
        if each["name"] == "areas":
            each["values"]["run_area"] = 0.512
        if each["name"] == "flare":
            each["values"]["AP_y"] = 24.0
    again = ah.Hull(from_definition(record))
    assert again.fingerprint == hull.fingerprint


def test_names_uses_and_definitions_name_it(hull: ah.Hull) -> None:
    """All three; the report tells what was changed, from what to what."""
    names: list[Any] = ["flare", "waterline_angle", hull.definitions["flare"]]
    for number, name in enumerate(names):
        with hull.edit("flare") as edit:
            edit.set_form(name, AP_y=24.0 - number)
    assert [each.definitions for each in hull.history] == [
        (("flare", "AP_y", 25.0 - i, 24.0 - i),) for i in range(3)
    ]
    assert "flare: AP_y 23 -> 22" in str(hull.history[-1])


def test_the_closure_gives_the_entrance(hull: ah.Hull) -> None:
    """cb and lcb are met to 1e-12 by area and centroid of the entrance."""
    from assoc_hull.model.forms.closure import coefficients

    before = coefficients(hull.definitions["areas"], hull.particulars)
    assert before.block is not None
    wanted = before.block - 0.0005
    with hull.edit("closed") as edit:
        edit.set_form("areas", cb=wanted, lcb=before.centroid)
    after = coefficients(hull.definitions["areas"], hull.particulars)
    assert after.block == pytest.approx(wanted, abs=1e-12)
    assert after.centroid == pytest.approx(before.centroid, abs=1e-10)
    assert hull.verify() == ()


def test_why_names_definition_value_old_and_new(hull: ah.Hull) -> None:
    """From a waterline back to the definition."""
    with hull.edit("fuller") as edit:
        edit.set_form("areas", run_area=0.512)
    told = str(hull.why("WL 3"))
    assert "the definition 'areas': set by the edit: run_area 0.511 -> 0.512" in told
    assert hull.why("ST 55").edit is None or "same bits" in hull.why("ST 55").what


def test_more_points_come_where_a_curve_needs_them(hull: ah.Hull) -> None:
    """Marks are added, never taken away, and undo gives all back."""
    before = {each.key: each for each in hull.state.generated}
    print_before = hull.fingerprint
    with hull.edit("level") as edit:
        edit.set_form("rise", aft_y=40.0)
    after = {each.key: each for each in hull.state.generated}
    more = [key for key in before if len(after[key].marks) > len(before[key].marks)]
    assert more
    assert all(set(before[key].marks) <= set(after[key].marks) for key in before)
    assert hull.verify() == () == hull.check()
    hull.undo()
    assert hull.fingerprint == print_before


def test_other_pieces_make_other_points(hull: ah.Hull) -> None:
    """A flat of bottom that comes makes a section of other pieces, with the kinds they need."""
    from assoc_hull.graph.journal import Journal
    from assoc_hull.model.form_definition import FormDefinition
    from assoc_hull.model.make_objects import Maker

    flat = FormDefinition(
        "flat", "half_siding", "course", {"AP_x": 0.0, "AP_y": 0.0, "FP_x": 100.0, "FP_y": 0.0},
        "straight", ("AP", "FP"),
    )  # fmt: skip
    Maker(hull.document.state, Journal()).definitions([*hull.state.definitions, flat])
    hull.document.refresh()
    before = hull.fingerprint
    with hull.edit("a bar keel") as edit:
        edit.set_form("flat", AP_y=0.2, FP_y=0.2)
    layouts = {each.layout for each in hull.state.generated if each.what == "section"}
    assert layouts == {"siding+curve+topside"}
    assert hull.verify() == () == hull.check()
    hull.undo()
    assert hull.fingerprint == before


@pytest.mark.parametrize(
    ("name", "values", "told"),
    [
        ("nothing", {"run_area": 0.5}, "there is no definition named 'nothing'"),
        ("areas", {"run_areas": 0.5}, "run_area"),
        ("areas", {"run_area": float("nan")}, "run_area"),
        ("areas", {"run_area": 0.3}, "'areas'"),
        ("areas", {"cb": 0.75, "entrance_area": 0.4}, "leave one of them out"),
        ("waterline", {"full": 5.0}, "at the section x = 15 m; give one from 0 to"),
        ("sheer", {"AP_y": 4.0}, "raise deck_height"),
        (7, {"run_area": 0.5}, "give its name or its use"),
    ],
    ids=["no definition", "no value", "not finite", "folds", "twice", "box", "deck", "no name"],
)
def test_what_cannot_be_is_refused(
    hull: ah.Hull, name: str, values: dict[str, float], told: str
) -> None:
    """By name and value, with what would do; nothing is half changed."""
    before = hull.fingerprint
    with pytest.raises(ah.AssocHullError, match=told), hull.edit("wrong") as edit:
        edit.set_form(name, **values)
    assert hull.fingerprint == before
    assert not hull.history


def test_the_same_values_are_no_step(hull: ah.Hull) -> None:
    """There is nothing to undo."""
    with hull.edit("the same") as edit:
        edit.set_form("flare", AP_y=25.0)
    assert edit.report is not None
    assert not edit.report.changed


def test_a_preview_changes_nothing(hull: ah.Hull) -> None:
    """And tells what it would do."""
    before = hull.fingerprint
    found = hull.preview([{"op": "set_form", "definition": "areas", "run_area": 0.512}])
    assert found.report is not None
    assert found.report.definitions == (("areas", "run_area", 0.511, 0.512),)
    assert hull.fingerprint == before


def test_a_driven_crossing_names_the_way_out(hull: ah.Hull) -> None:
    """A waterline is moved by its sections, and these by their definitions."""
    with (
        pytest.raises(ah.errors.PointRoleError, match=r"edit\.set_form"),
        hull.edit("move") as edit,
    ):
        edit.move("WL 3 x ST 35", y=5.0)
    assert not hull.history


def test_the_graph_shows_what_generates_what(hull: ah.Hull) -> None:
    """Definitions are nodes; an edge runs to each curve, or point, that is made of them."""
    found = hull.graph(around="ST 35", up=1, down=0)
    uses = {node for node, data in found.nodes(data=True) if data["kind"] == "definition"}
    assert {"form:sectional_area", "form:design_waterline"} <= uses
    kinds = {data["kind"] for _, _, data in hull.graph().edges(data=True)}
    assert "generates" in kinds
    drives: Any = hull.dependencies(points=True).edges(data="kind")
    assert "generates" in {kind for _, _, kind in drives}
    with hull.edit("fuller") as edit:
        edit.set_form("areas", run_area=0.512)
    assert "form:sectional_area" in hull.graph(only="changed")


def test_keep_going_refuses_what_no_definition_gives(hull: ah.Hull) -> None:
    """Points of a section have no last good place: neither those drawn nor those defined."""
    before = hull.fingerprint
    edit = hull.edit("wrong", policy="keep_going")
    with pytest.raises(ah.errors.RefusedEditError, match="outside the box"), edit:
        edit.set_form("waterline", full=5.0)
    assert hull.fingerprint == before
    assert hull.verify() == ()


@pytest.mark.parametrize("value", BAD.values(), ids=BAD)
def test_bad_values_are_errors_of_the_family(hull: ah.Hull, value: Any) -> None:
    """Whatever stands for a number, or for a definition."""
    for name, given in (("flare", {"AP_y": value}), (value, {"AP_y": 20.0})):
        with contextlib.suppress(ah.AssocHullError), hull.edit("bad") as edit:
            edit.set_form(name, **given)
    for name in ("cb", "lcb"):
        with contextlib.suppress(ah.AssocHullError), hull.edit("bad") as edit:
            edit.set_form("areas", **{name: value})
    assert hull.verify() == ()


@pytest.mark.parametrize("angle", [24.0, 28.0], ids=["come close", "pass"])
def test_crossings_that_pass_one_another_change_places(hull: ah.Hull, angle: float) -> None:
    """A waterline comes to cross a buttock where a section does: it is watched, nothing folds."""
    with hull.edit("one more waterline") as edit:
        edit.add_line("waterlines", 1.58)
    with hull.edit("a buttock") as edit:
        edit.add_line("buttocks", 4.0)
    assert hull.crossings["BTK 4 x WL 1.58"].role == "drives b"
    before = hull.fingerprint
    with hull.edit("fuller") as edit:
        edit.set_form("areas", run_area=0.518)
        edit.set_form("rise", AP_y=angle)
    assert edit.report is not None
    assert "have passed one another" in edit.report.notes[0]
    assert hull.crossings["BTK 4 x WL 1.58"].role == "watched"
    assert hull.crossings["BTK 4 x ST 15"].role == "drives b"
    (curve,) = hull.lines["BTK 4"].curves
    rows = hull.state.curves.rows[curve.row]
    assert (np.diff(hull.state.rows.xyz[rows, 0]) > 0.15).all()
    assert hull.check() == ()
    assert hull.verify() == ()
    hull.undo()
    assert hull.fingerprint == before


def test_a_gap_that_comes_of_a_definition_is_mended_or_told(hull: ah.Hull) -> None:
    """No point is put on a section; limits are those of a birth."""
    before = {each.key: each.rows for each in hull.state.generated}
    with hull.edit("a buttock") as edit:
        edit.add_line("buttocks", 6.0)
    with hull.edit("fuller") as edit:
        edit.set_form("areas", run_area=0.52)
    after = {each.key: each.rows for each in hull.state.generated}
    assert all(set(before[key]) <= set(after[key]) for key in before)
    assert all(each.attached for each in hull.state.generated)
    assert hull.check() == ()


def test_a_definition_is_asked_for_by_name(hull: ah.Hull) -> None:
    """Why and graph take its name, its key or itself; a line of the same name comes first."""
    assert "no edit has reached it" in str(hull.why("areas"))
    with hull.edit("fuller") as edit:
        edit.set_form("areas", run_area=0.513)
    told = hull.why("areas")
    assert "run_area" in told.what
    assert hull.why("form:sectional_area") == told == hull.why(hull.definitions["areas"])
    near = set(hull.graph(around="areas", up=0))
    assert "form:sectional_area" in near
    assert any(each.startswith("sections:") for each in near)
    assert "definition" not in str(hull.why("profile"))
