"""The curve that one makes, drags and reads back."""

import json
import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import assoc_hull as ah
from assoc_hull.errors import BadInputError, NoMiddleVertexError, UnknownNameError
from tests.form_curves import CURVES

GOOD: dict[str, Any] = {"start_angle_deg": 0.0, "finish_angle_deg": 45.0}
LONG, ODD = {"tangents": "long"}, {"energy": "E4"}
END = {"x", "y", "angle_deg", "curvature", "tangent", "stretch"}


def published(name: str = "T1_run", tangents: Any = "default") -> ah.creation.FormCurve:
    """A curve of table 2 of Kim & Kang 1992."""
    g = CURVES[name]["inp"]
    return ah.creation.FormCurve.of(
        (g["x0"], g["y0"]), (g["x1"], g["y1"]),
        start_angle_deg=math.degrees(g["a0"]), finish_angle_deg=math.degrees(g["a1"]),
        start_curvature=g["k0"], finish_curvature=g["k1"],
        area=g["A"], centroid=g["Xc"], tangents=tangents,
    )  # fmt: skip


def changed(one: ah.creation.FormCurve, two: ah.creation.FormCurve) -> set[str]:
    """Names of parameters that differ by more than rounding."""
    old, new = one.parameters, two.parameters
    return {n for n in old if abs(old[n] - new[n]) > 1e-12 * max(1.0, abs(old[n]))}


@pytest.mark.parametrize("name", CURVES)
def test_a_published_curve(name: str) -> None:
    """Vertices, parameters and the rest, through the public face."""
    curve, want = published(name), CURVES[name]
    assert curve.vertices == pytest.approx(np.array(want["P"]), abs=1e-14)
    assert curve.at(2.0) == pytest.approx(want["Q2"], abs=1e-14)
    assert curve.curvature(2.0) == pytest.approx(want["k2"], abs=1e-12)
    assert curve.centroid_height == pytest.approx(want["inverse"]["Yc"], abs=1e-14)
    assert curve.energy("E2") == pytest.approx(want["E2"], rel=1e-13)
    assert curve.energy() == pytest.approx(want["E3"], rel=1e-13)
    assert curve.other_middle == pytest.approx(want["second_root"], abs=1e-11)
    assert (curve.area, curve.centroid) == pytest.approx((want["inp"]["A"], want["inp"]["Xc"]))
    with pytest.raises(ValueError, match="read-only"):
        curve.vertices[0, 0] = 1.0


def test_the_middle_vertex_moves_area_and_centroid() -> None:
    """And nothing else."""
    curve = published()
    assert changed(curve, curve.drag(3, (-0.9, 0.8))) == {"area", "centroid"}


@pytest.mark.parametrize("vertex", [0, 1, 2, 4, 5, 6])
def test_a_vertex_of_one_end_leaves_the_other(vertex: int) -> None:
    """Its own end, area and centroid change; with these kept, its own end only."""
    curve = published()
    to = curve.vertices[vertex] + (0.01, -0.02)
    end = "start" if vertex < 3 else "finish"
    own = {f"{end}_{each}" for each in END}
    assert changed(curve, curve.drag(vertex, to)) <= own | {"area", "centroid"}
    kept = curve.drag(vertex, to, keep=("area", "centroid"))
    assert changed(curve, kept) <= own
    assert changed(curve, curve.drag(vertex, to, keep=("area",))) <= own | {"centroid"}
    assert kept.vertices[vertex] == pytest.approx(to, abs=0.0)


def test_the_middle_vertex_slides_on_its_line() -> None:
    """With the area kept it goes to the nearest place of equal area."""
    curve = published()
    to = np.array([-0.8, 0.9])
    slid = curve.drag(3, to, keep=("area",))
    assert slid.area == pytest.approx(curve.area, abs=1e-15)
    way = slid.vertices[3] - curve.vertices[3]
    assert abs(way @ (to - slid.vertices[3])) < 1e-14


def test_a_drag_that_cannot_keep_both() -> None:
    """The reason names the nearest centroid, and the curve is as it was."""
    curve = published()
    with pytest.raises(NoMiddleVertexError) as caught:
        curve.drag(4, (-0.99, 0.02), keep=("area", "centroid"))
    assert math.isfinite(caught.value.nearest)


places = st.tuples(*(st.floats(-1.0, 1.0),) * 2)


@given(st.lists(places, min_size=7, max_size=7))
def test_parameters_make_the_curve_again(vertices: list[tuple[float, float]]) -> None:
    """Of any seven vertices, where no tangent and no area is nil, and the root is the near one."""
    curve = ah.creation.FormCurve(vertices)
    p = curve.parameters
    nil = min(p["start_tangent"], p["finish_tangent"]) < 1e-2 or abs(p["area"]) < 1e-2
    if nil:
        return
    again = ah.creation.FormCurve.from_parameters(p)
    for name, value in again.parameters.items():
        turn = 360.0 if name.endswith("_deg") else math.inf
        off = abs(value - p[name])
        assert min(off, abs(turn - off)) <= 1e-11 * max(1.0, abs(p[name])), name
    assert np.abs(np.delete(again.vertices - curve.vertices, 3, axis=0)).max() < 1e-12


def test_tangents_by_fairness() -> None:
    """Those of least energy, with a message where a bound holds them; given ones are taken."""
    auto = published("T2_ent", "auto")
    assert auto.parameters["start_tangent"] == pytest.approx(0.317626, abs=1e-4)
    assert auto.parameters["finish_tangent"] == pytest.approx(0.055741, abs=1e-4)
    assert auto.messages[0].code == "bound"
    assert auto.energy() < published("T2_ent").energy()
    assert published("T1_run", (0.1, 0.2)).parameters["start_tangent"] == pytest.approx(0.1)
    assert published("T1_run", None).vertices.tobytes() == published().vertices.tobytes()


def test_without_a_root_at_any_tangent_the_reason_is_told() -> None:
    """`auto` refuses as `default` does."""
    for tangents in ("default", "auto"):
        with pytest.raises(NoMiddleVertexError):
            ah.creation.FormCurve.of(
                (0.0, 0.0), (1.0, 1.0), start_angle_deg=0.0, finish_angle_deg=0.0,
                area=0.5, centroid=7.0, tangents=tangents,
            )  # fmt: skip


def test_a_nil_tangent_keeps_the_angle_it_had() -> None:
    """A message says so; before it had any, the chord gives it."""
    curve = published()
    p0, _, _ = curve.vertices[:3]
    nil = curve.drag(2, p0)
    assert nil.parameters["start_tangent"] == 0.0
    assert nil.parameters["start_angle_deg"] == pytest.approx(60.0, abs=1e-12)
    assert {"tangent", "C0"} <= {each.code for each in nil.messages}
    again = nil.drag(2, curve.vertices[2])
    assert again.vertices.tobytes() == curve.vertices.tobytes()
    bare = ah.creation.FormCurve(nil.vertices)
    rise = bare.at(4.0) - bare.at(0.0)
    chord = math.degrees(math.atan2(rise[1], rise[0]))
    assert bare.parameters["start_angle_deg"] == pytest.approx(chord, abs=1e-12)


def test_no_area_no_centroid() -> None:
    """The moment stands instead, and a message says so."""
    odd = [(k, k - 3.0) for k in range(7)]
    curve = ah.creation.FormCurve([(x - 3.0, y**3) for x, y in odd])
    assert "centroid" not in curve.parameters
    assert curve.parameters["moment"] == pytest.approx(
        float(np.trapezoid(curve.at(np.linspace(0, 4, 4001)).prod(axis=1),
                           curve.at(np.linspace(0, 4, 4001))[:, 0])), rel=1e-4
    )  # fmt: skip
    assert math.isnan(curve.centroid)
    assert "area" in {each.code for each in curve.messages}


def test_scaled_and_mirrored() -> None:
    """A curve in another unit, and a falling one made rising: areas and centroids go along."""
    curve = published()
    big = curve.scaled(90.0, 292.59)
    assert big.area == pytest.approx(90.0 * 292.59 * curve.area, rel=1e-14)
    assert big.centroid == pytest.approx(90.0 * curve.centroid, rel=1e-14)
    turned = curve.mirrored()
    assert turned.area == pytest.approx(curve.area, abs=1e-15)
    assert turned.centroid == pytest.approx(-curve.centroid, abs=1e-15)
    assert turned.mirrored().vertices.tobytes() == curve.vertices.tobytes()
    for name in ("curvature", "tangent"):
        got = turned.parameters[f"finish_{name}"]
        assert got == pytest.approx(curve.parameters[f"start_{name}"], abs=1e-14)


def test_areas_may_be_large() -> None:
    """They are squares: a curve of 180 km is a curve."""
    curve = ah.creation.FormCurve.of((0.0, 0.0), (1.8e5, 12.0), **GOOD, area=1.2e6)
    assert curve.area == pytest.approx(1.2e6, rel=1e-14)


def test_words_and_document() -> None:
    """All is in the table, and in the document as JSON takes it."""
    curve = published()
    words, document = curve.table(), json.loads(json.dumps(curve.document()))
    assert all(name in words for name in curve.parameters)
    assert "-0.922173590026" in words
    assert "C6 info: area 0.55 needs an inflection" in words
    assert document["parameters"]["area"] == curve.area
    assert (
        ah.creation.FormCurve(document["vertices"]).vertices.tobytes() == curve.vertices.tobytes()
    )


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: ah.creation.FormCurve([(0.0, 0.0)] * 6), "seven finite places"),
        (lambda: ah.creation.FormCurve([(0.0, math.nan)] * 7), "seven finite places"),
        (
            lambda: ah.creation.FormCurve.of((0, 0), (0, 0), **GOOD),
            "start and finish are one place",
        ),
        (lambda: ah.creation.FormCurve.of((0, 0), (1, 1), **GOOD, centroid=0.5), "without an area"),
        (
            lambda: ah.creation.FormCurve.of((0, 0), (1, 1), **GOOD, area=0.0, centroid=1.0),
            "area of 0",
        ),
        (lambda: ah.creation.FormCurve.of((0, 0), (1, 1), **GOOD | LONG), "default or auto"),
        (lambda: ah.creation.FormCurve.of((0, 0), (1, 1), **GOOD, tangents=(0.0, 1.0)), "above 0"),
        (lambda: ah.creation.FormCurve.of((0, 0), (1, 1), **GOOD | ODD), "E2 or E3 or J"),
        (
            lambda: ah.creation.FormCurve.of((0, 0), (1, 1), **GOOD, start_curvature=1e9),
            "a vertex 1.04e",
        ),
        (lambda: ah.creation.FormCurve.from_parameters({"start_x": 0.0}), "start_y is None"),
        (lambda: published().at(4.5), "from 0 to 4"),
        (lambda: published().drag(7, (0.0, 0.0)), "from 0 to 6"),
        (lambda: published().drag(0, (0.0, 0.0), keep=("centroid",)), "centroid alone"),
        (lambda: published().drag(0, (0.0, 0.0), keep="area"), "keep is"),
        (lambda: published().drag(3, (0, 0), keep=("area", "centroid")), "another vertex"),
        (lambda: published().scaled(0.0, 1.0), "above 0"),
    ],
)
def test_what_cannot_be_used_is_refused(call: Callable[[], object], words: str) -> None:
    """In words that tell what to do."""
    with pytest.raises(BadInputError, match=words):
        call()


def test_an_unknown_parameter_is_named() -> None:
    """With the nearest known one."""
    with pytest.raises(UnknownNameError, match="start_angle_deg"):
        ah.creation.FormCurve.from_parameters({"start_angle": 0.0})


def test_printed_areas_are_those_of_the_half_curves_themselves() -> None:
    """Taken as fullness, or with the parallel body, the centroids of the paper cannot be."""
    fullness = ah.creation.FormCurve.of(
        start=(-0.1, 1.0), start_angle_deg=0.0, finish=(1.0, 0.0), finish_angle_deg=-20.0,
        area=0.775 * 1.1, centroid=0.325, tangents="default",
    )  # fmt: skip
    told = next(str(each) for each in fullness.messages if each.code == "C4s")
    assert "allowed in [0.32625, " in told
    area = 0.55 - 0.3  # less the parallel body from -0.3 to midship
    centroid = (0.55 * -0.59 - 0.3 * -0.15) / area
    assert centroid == pytest.approx(-1.118, abs=5e-4)  # abaft the start of the curve at -1
