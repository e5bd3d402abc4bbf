"""Sections through a bulb: areas, how the pieces join, and what is refused."""

from __future__ import annotations

import math

import numpy as np
import pytest

from assoc_hull.errors import BadInputError, OutOfRangeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.curve import form_at
from assoc_hull.geometry.form_curves.integrals import form_integrals
from assoc_hull.model.form_definition import GeneratedCurve
from assoc_hull.model.forms.form_values import Forms
from assoc_hull.model.forms.generate_points import definitions_read, generated_points, marks_for
from assoc_hull.model.forms.line_layout import ends_for, layout_at
from assoc_hull.model.forms.sections import SectionCurves, bulb_vertices, section_shape
from assoc_hull.shipped.container_ship_225m import container_ship_225m_design

DESIGN = container_ship_225m_design()
FORMS = Forms.of(DESIGN.definitions, DESIGN.particulars)
DRAUGHT = DESIGN.particulars.draught


def changed(use: str, **values: float) -> Forms:
    """The definitions of the ship with other values of one of them."""
    design = DESIGN.having(DESIGN.definition(use).having(values))
    return Forms.of(design.definitions, design.particulars)


def ends_at(forms: Forms, x: float, part: int = 0) -> FloatArray:
    """Where a curve of a section meets profile or deck edge, (2, 3)."""
    y, z = (float(forms.value(use, x)[0]) for use in ("deck_side", "deck_height"))
    heights = [(0.0, each) for each in forms.contour(x)] + [(y, z)]
    return np.array([[x, *heights[2 * part]], [x, *heights[2 * part + 1]]])


def pieces(forms: Forms, x: float, part: int = 0) -> list[SectionCurves]:
    """The pieces of a curve of a section."""
    layout = layout_at(forms, "section", x, part)
    shape = section_shape(forms, layout, np.array([x]), ends_at(forms, x, part)[None])
    found = [each for each in shape.pieces if isinstance(each, SectionCurves)]
    assert len(found) == len(shape.pieces)
    return found


def curvature(piece: SectionCurves, t: float) -> float:
    """The signed curvature of a piece, by its derivatives."""
    (x1, y1), (x2, y2) = (form_at(piece.vertices, np.array([t]), n)[0] for n in (1, 2))
    return float((x1 * y2 - y1 * x2) / math.hypot(x1, y1) ** 3)


def angle(piece: SectionCurves, t: float) -> float:
    """The angle (degrees) of a piece in the graph of y over z."""
    z, y = form_at(piece.vertices, np.array([t]), 1)[0]
    return math.degrees(math.atan2(y, z))


def area(piece: SectionCurves) -> float:
    """The area of half a section under a piece."""
    return float(form_integrals(piece.vertices).area[0])


@pytest.mark.parametrize("x", [198.0, 205.0, 213.75, 222.0])
def test_bulb_and_upper_curve_share_the_area_and_join_without_curvature(x: float) -> None:
    """The bulb has its own, both that of the section; at the neck point and angle are one."""
    bulb, upper, topside = pieces(FORMS, x)
    whole, part = (float(FORMS.value(use, x)[0]) for use in ("sectional_area", "bulb_area"))
    assert 2.0 * area(bulb) == pytest.approx(part, rel=1e-12)
    assert 2.0 * (area(bulb) + area(upper)) == pytest.approx(whole, rel=1e-12)
    assert angle(bulb, 0.0) == pytest.approx(90.0, abs=1e-9)
    np.testing.assert_array_equal(bulb.finish, upper.start)
    want = float(FORMS.value("bulb_neck_angle", x)[0])
    for piece, t in ((bulb, 4.0), (upper, 0.0)):
        assert angle(piece, t) == pytest.approx(want, abs=1e-9)
        assert curvature(piece, t) == pytest.approx(0.0, abs=1e-9)
    np.testing.assert_array_equal(upper.finish, topside.start)
    assert angle(upper, 4.0) == pytest.approx(angle(topside, 0.0), abs=1e-9)
    assert curvature(upper, 4.0) == pytest.approx(curvature(topside, 0.0), abs=1e-9)


def test_ahead_of_the_stem_a_bulb_closes_square_to_the_centre_plane() -> None:
    """With the whole area; the topside above it is a curve of its own."""
    (bulb,) = pieces(FORMS, 228.0)
    assert 2.0 * area(bulb) == pytest.approx(float(FORMS.value("bulb_area", 228.0)[0]), rel=1e-12)
    assert angle(bulb, 0.0) == pytest.approx(90.0, abs=1e-9)
    assert angle(bulb, 4.0) == pytest.approx(-90.0, abs=1e-9)
    assert layout_at(FORMS, "section", 228.0, 1) == "topside"
    assert ends_for("round").vector == ((0.0, 1.0, 0.0), (0.0, -1.0, 0.0))


def test_a_bulb_that_closes_is_half_an_ellipse_within_2_per_cent() -> None:
    """Of its half-breadth; with the area of the ellipse it is its curve, nearly."""
    height, breadth = 9.0, 2.25
    half = np.array([0.25 * math.pi * height * breadth])
    found = bulb_vertices(np.zeros((1, 2)), np.array([[height, 0.0]]), half)
    t = np.linspace(0.0, 4.0, 101)
    z, y = form_at(np.repeat(found, len(t), axis=0), t).T
    off = np.hypot((z - 0.5 * height) / (0.5 * height), y / breadth) - 1.0
    assert float(np.abs(off).max()) < 0.02
    assert y[50] == pytest.approx(breadth, rel=0.01)


def test_an_open_bulb_becomes_the_closed_one_as_its_neck_closes() -> None:
    """The rule of tangent and curvature at the contour is one for both."""
    half, start = np.array([16.0]), np.zeros((1, 2))
    closed = bulb_vertices(start, np.array([[9.0, 0.0]]), half)
    nearly = bulb_vertices(start, np.array([[9.0, 1e-6]]), half, np.array([-0.5 * math.pi]))
    np.testing.assert_allclose(nearly[0, :3], closed[0, :3], atol=1e-4)


def test_sections_of_a_bulb_have_the_same_bits_alone_and_in_a_batch() -> None:
    """Whatever else is made with them."""
    places = [199.0, 204.0, 213.75, 218.5, 222.0]
    made, ends = [], []
    for x in places:
        layout, end = layout_at(FORMS, "section", x), ends_at(FORMS, x)
        marks = marks_for(FORMS, "section", layout, x, end)[0]
        made.append(GeneratedCurve("", 0, "section", layout, tuple(range(len(marks))), marks))
        ends.append(end)
    together = generated_points(FORMS, made, np.array(places), np.array(ends))
    for x, curve, end, points in zip(places, made, ends, together, strict=True):
        (alone,) = generated_points(FORMS, [curve], np.array([x]), end[None])
        assert alone.tobytes() == points.tobytes()


def test_sections_of_a_bulb_depend_on_what_shapes_it() -> None:
    """Ahead of the stem on area only; topsides do not."""
    bulb = {"bulb_area", "bulb_height", "bulb_neck", "bulb_neck_angle"}
    for layout, wanted in (
        ("bulb+upper+topside", bulb), ("round", {"bulb_area"}), ("topside", set[str]()),
    ):  # fmt: skip
        curve = GeneratedCurve("", 0, "section", layout, (), ())
        assert bulb & set(definitions_read(curve)) == wanted
    whole = definitions_read(GeneratedCurve("", 0, "section", "bulb+upper+topside", (), ()))
    assert {"sectional_area", "design_waterline", "waterline_angle", "deck_angle"} <= set(whole)
    assert "keel_angle" not in whole


def test_without_a_bulb_there_is_no_second_curve() -> None:
    """Nor where the bulb has not begun."""
    with pytest.raises(BadInputError, match=r"no curve 1 where no bulb closes"):
        layout_at(FORMS, "section", 218.0, 1)
    assert layout_at(FORMS, "section", 190.5) == "curve+topside"


def test_a_section_through_the_overhang_below_the_draught_is_refused() -> None:
    """Between the neck of the stem and FP; the message tells where to stand."""
    with pytest.raises(BadInputError, match=r"x = 224.8 m; let the section stand abaft the neck"):
        layout_at(FORMS, "section", 224.8)


@pytest.mark.parametrize(
    ("use", "values", "message"),
    [
        ("bulb_area", {"x 218_y": 60.0}, r"bulb_area of .* m2 is not a part of the section"),
        ("bulb_area", {"x 218_y": -1.0}, r"bulb_area of -1 m2 is not a part of the section"),
        ("bulb_height", {"x 217_y": 11.5, "x 219.5_y": 11.5}, r"bulb_height of .*10\.79 m"),
        ("bulb_neck", {"x 217_y": -0.1, "x 219.5_y": -0.1}, r"bulb_neck of -0\.1 m"),
        ("bulb_neck", {"x 217_y": 8.0, "x 219.5_y": 8.0}, r"no curve of the bulb has this area"),
        ("bulb_area", {"x 218_y": 39.0}, r"the curve above the neck has a half-breadth of -"),
    ],
    ids=["larger than the section", "negative", "neck above the water", "neck beyond the centre",
         "neck wider than the bulb", "little left above"],
)  # fmt: skip
def test_what_no_bulb_can_be_is_refused(use: str, values: dict[str, float], message: str) -> None:
    """Station, value and interval are told."""
    forms = changed(use, **values)
    with pytest.raises((BadInputError, OutOfRangeError), match=message) as caught:
        pieces(forms, 218.0)
    assert "x = 218 m" in str(caught.value)
