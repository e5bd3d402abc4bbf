"""Form-parameter curves against the numbers of Kim & Kang 1992 and of their design examples."""

import math

import numpy as np
import pytest

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.chain import FormChain, straight_vertices
from assoc_hull.geometry.form_curves.curve import (
    FormEnd,
    end_of,
    end_vertices,
    form_at,
    form_values,
    form_vertices,
)
from assoc_hull.geometry.form_curves.integrals import fair_vertex, form_integrals, middle_vertex
from assoc_hull.geometry.form_curves.shape import (
    form_energy,
    form_inflections,
    form_length,
    least_rate,
)
from tests.form_curves import BULK_CARRIER, CURVES

NAMES = tuple(CURVES)

# As printed: tangent, P0 to P6, the other middle vertex, Q(2), curvature there, Yc, E2, E3.
PRINTED = {
    "T1_run": (
        ".152581945197",
        "-1.062849536644 -.139900257366 -1.006720717977 .003880208333 -.910267591447 "
        ".124379424032 -.922173590026 .787861836193 -.452581945197 1 -.3 1 -.147418054803 1",
        "11.177601670357 22.307826438821", "-.841923982791 .712637794801", "-2.6052313596",
        ".442976291456", ".4687539229", "2.5197115394", 2,
    ),
    "T1_ent": (
        ".160078105936",
        ".039921894064 1 .2 1 .360078105936 1 .879961592759 .750897142971 .884017184352 "
        ".111645988518 1.006543296285 .005490477499 1.089809630508 -.133607898516",
        "-11.081103997324 19.555811649199", ".793990276887 .685872426734", "-2.4161604075",
        ".434416278313", ".4796571191", "2.5781318903", 2,
    ),
    "T2_run": (
        ".168170300588",
        "-1.084085150294 -.145639752472 -1 0 -.915914849706 .145639752472 -.978072263418 "
        ".893779247080 -.268170300588 1 -.1 1 .068170300588 1",
        "36.262913970 48.091848320", "-.849395700661 .786792790132", "-3.4903629676",
        ".462004450782", ".8482802351", "5.0940239147", 1,
    ),
    "T2_ent": (
        ".185825859341",
        "-.285825859341 1 -.1 1 .085825859341 1 .866824739133 .617600550199 .825380811226 "
        ".063556187046 1 0 1.174619188774 -.063556187046",
        "-13.592211191 17.577184733", ".72975093785 .58899306464", "-2.1120391866",
        ".418498784686", ".7671481532", "4.3586890787", 1,
    ),
}  # fmt: skip


def printed(words: str, numbers: object, units: float = 0.5000001) -> bool:
    """Whether numbers are those of a text, rounded at its last digit; or so many units off it."""
    given = words.split()
    got = np.ravel(np.array(numbers, float)).tolist()
    room = [units * 10.0 ** -len(each.partition(".")[2]) for each in given]
    return len(given) == len(got) and all(
        abs(float(word) - value) <= slack
        for word, value, slack in zip(given, got, room, strict=True)
    )


def ends_of(name: str) -> tuple[FormEnd, FormEnd, FloatArray, FloatArray]:
    """The ends, area and centroid of a curve of table 2, tangents an eighth of the chord."""
    g = CURVES[name]["inp"]
    start = FormEnd.of(g["x0"], g["y0"], g["a0"], g["k0"], g["d0"])
    finish = FormEnd.of(g["x1"], g["y1"], g["a1"], g["k1"], g["d1"])
    return start, finish, np.array([g["A"]]), np.array([g["Xc"]])


def curvature(vertices: FloatArray, t: float) -> float:
    """Of one curve, positive to the left."""
    at = np.array([t])
    (dx, dy), (ex, ey) = (form_at(vertices, at, order)[0].tolist() for order in (1, 2))
    return float((dx * ey - dy * ex) / math.hypot(dx, dy) ** 3)


@pytest.mark.parametrize("name", NAMES)
def test_vertices_are_the_published_ones(name: str) -> None:
    """As printed to 12 digits, and in full to 1e-14; so is the far root, to what it keeps."""
    start, finish, area, centroid = ends_of(name)
    vertices = form_vertices(start, finish, area, centroid)
    tangent, points, second, *_ = PRINTED[name]
    chord = math.hypot(finish.x[0] - start.x[0], finish.y[0] - start.y[0])
    assert printed(tangent, chord / 8.0)
    assert printed(points, vertices)
    assert vertices[0] == pytest.approx(np.array(CURVES[name]["P"]), abs=1e-14)
    ends = np.concatenate([end_vertices(start), end_vertices(finish)], axis=1)
    # Ten times as far away, and as many digits fewer: by a unit of the twelfth.
    assert printed(second, middle_vertex(ends, area, centroid, other=True)[0], units=1.0)


@pytest.mark.parametrize("name", NAMES)
def test_shapes_are_the_published_ones(name: str) -> None:
    """Middle of the curve, curvature there, height of the centroid, energies, inflections."""
    vertices = form_vertices(*ends_of(name))
    _, _, _, middle, bend, height, two, three, count = PRINTED[name]
    found = form_integrals(vertices)
    assert printed(middle, form_at(vertices, np.array([2.0])))
    assert printed(bend, curvature(vertices, 2.0))
    assert printed(height, found.moment_y / found.area)
    assert printed(two, form_energy(vertices, "E2"))
    assert printed(three, form_energy(vertices, "E3"))
    assert len(form_inflections(vertices[0])) == count


@pytest.mark.parametrize("name", NAMES)
def test_imposed_parameters_are_met(name: str) -> None:
    """Area, centroid, angles and curvatures come back to 5.2e-15; so do the rest."""
    start, finish, area, centroid = ends_of(name)
    found = form_values(form_vertices(start, finish, area, centroid))
    for got, want in ((found.start, start), (found.finish, finish)):
        for part in ("x", "y", "angle", "curvature", "tangent", "stretch"):
            assert getattr(got, part)[0] == pytest.approx(getattr(want, part)[0], abs=5.3e-15)
    assert found.area[0] == pytest.approx(area[0], abs=5.2e-15)
    assert found.centroid[0] == pytest.approx(centroid[0], abs=5.2e-15)


def test_end_vertices_pass_through_the_end() -> None:
    """At a knot (a, b, c): Q = (a + 4 b + c)/6, Q' = (c - a)/2, Q'' = a - 2 b + c, both ends."""
    end = FormEnd.of(0.5, -0.25, 0.75, -1.5, 0.25, 0.125)
    (a, b, c) = end_vertices(end)[0]
    along, across = (
        np.array([math.cos(0.75), math.sin(0.75)]),
        np.array([-math.sin(0.75), math.cos(0.75)]),
    )
    assert (a + 4 * b + c) / 6 == pytest.approx([0.5, -0.25], abs=1e-16)
    assert (c - a) / 2 == pytest.approx(0.25 * along, abs=1e-16)
    assert a - 2 * b + c == pytest.approx(0.25**2 * -1.5 * across + 0.125 * along, abs=2e-16)


def test_fourteen_parameters_and_back() -> None:
    """Random vertices, their parameters, the same vertices: to 1e-12 of max(1, value)."""
    vertices = np.random.default_rng(2).uniform(-1.0, 1.0, (2000, 7, 2))
    first = form_values(vertices)
    # Tangents and areas near nil are the singular cases: parameters grow without bounds there.
    sane = (np.minimum(first.start.tangent, first.finish.tangent) > 0.01) & (
        np.abs(first.area) > 0.01
    )
    cut = ("x", "y", "angle", "curvature", "tangent", "stretch")
    start, finish = (
        FormEnd(*(getattr(e, n)[sane] for n in cut)) for e in (first.start, first.finish)
    )
    again = form_vertices(start, finish, first.area[sane], first.centroid[sane])
    # The middle vertex may be that of the other root; the parameters are the same in any case.
    second = form_values(again)
    assert sane.sum() > 1900
    pairs = [
        (getattr(got, name), getattr(end, name))
        for end, got in ((start, second.start), (finish, second.finish))
        for name in cut
    ]
    pairs += [(second.area, first.area[sane]), (second.centroid, first.centroid[sane])]
    for found, want in pairs:
        assert (np.abs(found - want) / np.maximum(1.0, np.abs(want))).max() < 1e-12
    assert np.abs(np.delete(again - vertices[sane], 3, axis=1)).max() < 1e-12


def test_a_dragged_vertex_needs_the_stretch() -> None:
    """P1 of a run moved by (0.01, -0.02): the parameters as printed, and what they give again."""
    vertices = np.array(CURVES["T1_run"]["P"])[None].copy()
    before = form_values(vertices)
    vertices[0, 1] += (0.01, -0.02)
    found = form_values(vertices)
    start = found.start
    values = (start.x, start.y, start.angle, start.tangent, start.curvature, start.stretch)
    assert printed(
        "-0.993333333333 -0.0133333333333 1.0471975512 0.152581945197 -0.396971465205 "
        "0.0246410161514 0.548264056893 -0.588838529742",
        [*values, found.area, found.centroid],
    )
    for name in ("x", "y", "angle", "curvature", "tangent", "stretch"):
        assert getattr(found.finish, name)[0] == getattr(before.finish, name)[0]
    again = form_vertices(start, found.finish, found.area, found.centroid)
    assert np.abs(again - vertices).max() < 1e-14
    bare = FormEnd.of(start.x, start.y, start.angle, start.curvature, start.tangent)
    without = form_vertices(bare, found.finish, found.area, found.centroid)
    assert printed("0.0071", np.abs(without - vertices).max())
    t = np.linspace(0.0, 4.0, 4001)
    apart = [form_at(np.repeat(each, len(t), axis=0), t) for each in (without, vertices)]
    assert printed("0.0036", np.abs(apart[0] - apart[1]).max())


def test_the_middle_vertex_changes_area_and_centroid_only() -> None:
    """Ends keep every bit of their six parameters."""
    vertices = np.array(CURVES["T2_ent"]["P"])[None].copy()
    before = form_values(vertices)
    vertices[0, 3] += (0.05, 0.07)
    after = form_values(vertices)
    for one, two in ((before.start, after.start), (before.finish, after.finish)):
        for name in ("x", "y", "angle", "curvature", "tangent", "stretch"):
            assert getattr(one, name)[0] == getattr(two, name)[0]
    assert after.area[0] != before.area[0]
    assert after.centroid[0] != before.centroid[0]


def test_an_end_without_tangent_keeps_its_angle() -> None:
    """The angle is the one handed in, the curvature has none."""
    vertices = np.array([[[0.0, 0.5], [1.0, 1.0], [0.0, 0.5]]])
    assert np.isnan(end_of(vertices).angle[0])
    found = end_of(vertices, np.array([0.3]))
    assert (found.angle[0], found.tangent[0]) == (0.3, 0.0)
    assert np.isnan(found.curvature[0])


def test_scaling_changes_parameters_by_the_known_rules() -> None:
    """tan, curvature, tangent, area and centroid of x' = a x, y' = b y."""
    a, b = 90.0, 292.59
    vertices = form_vertices(*ends_of("T1_run"))
    one, two = form_values(vertices), form_values(vertices * np.array([a, b]))
    for before, after in ((one.start, two.start), (one.finish, two.finish)):
        cos, sin = math.cos(before.angle[0]), math.sin(before.angle[0])
        stretch = math.sqrt(a * a * cos * cos + b * b * sin * sin)
        assert math.tan(after.angle[0]) == pytest.approx(b / a * sin / cos, rel=1e-13)
        want = before.curvature[0] * a * b / stretch**3
        assert after.curvature[0] == pytest.approx(want, abs=1e-16, rel=1e-12)
        assert after.tangent[0] == pytest.approx(before.tangent[0] * stretch, rel=1e-13)
    assert two.area[0] == pytest.approx(a * b * one.area[0], rel=1e-14)
    assert two.centroid[0] == pytest.approx(a * one.centroid[0], rel=1e-14)
    again = form_vertices(two.start, two.finish, two.area, two.centroid)
    assert again == pytest.approx(vertices * np.array([a, b]), abs=1e-10)


@pytest.mark.parametrize("name", ["T1_ent", "T2_ent"])
def test_a_mirrored_entrance_is_a_reflected_run(name: str) -> None:
    """(x0, y0, a0, k0, ...) -> (-x1, y1, -a1, k1, ...): the vertices mirrored, to rounding."""
    start, finish, area, centroid = ends_of(name)
    begin, end = (
        FormEnd(-each.x, each.y, -each.angle, each.curvature, each.tangent, each.stretch)
        for each in (finish, start)
    )
    found = form_vertices(begin, end, area, -centroid)
    want = form_vertices(start, finish, area, centroid)[:, ::-1] * np.array([-1.0, 1.0])
    assert found == pytest.approx(want, abs=1e-14)


SECTION = (np.radians(62.0), np.array([60.0]), np.array([6.4]))


@pytest.mark.parametrize(
    ("tangent", "middle", "height", "girth"),
    [
        ("1.650047347806", "4.06634928353 6.583522278763", "3.3237365693904", "14.0323291352"),
        ("2.640075756489", "3.617398688192 5.754153725792", "3.3193535396", "14.0246003912"),
    ],
    ids=["an eighth of the chord", "a fifth of the chord"],
)
def test_a_section_by_its_area_and_centroid(
    tangent: str, middle: str, height: str, girth: str
) -> None:
    """z from 0 to 10.5, half-breadth from 0 to 8, area 60, centroid 6.4, as printed."""
    chord = math.hypot(10.5, 8.0)
    given = {"1": chord / 8.0, "2": chord / 5.0}[tangent[0]]
    assert printed(tangent, given)
    angle, area, centroid = SECTION
    start, finish = FormEnd.of(0.0, 0.0, angle, 0.0, given), FormEnd.of(10.5, 8.0, 0.0, 0.0, given)
    vertices = form_vertices(start, finish, area, centroid)
    found = form_integrals(vertices)
    assert printed(middle, vertices[0, 3])
    assert printed(height, found.moment_y / found.area)
    assert printed(girth, form_length(vertices))
    if tangent[0] == "1":
        assert printed("4.31500001556 5.965165741483", form_at(vertices, np.array([2.0])))
        assert form_inflections(vertices[0]) == ()


def test_a_topside_joins_with_curvature() -> None:
    """From (10.5, 8) to (15, 9.5), tangents a quarter of the chord: fairest vertices as printed."""
    tangent = math.sqrt(22.5) / 4.0
    assert printed("1.185854122563", tangent)
    start = FormEnd.of(10.5, 8.0, np.radians(15.0), 0.01, tangent)
    finish = FormEnd.of(15.0, 9.5, np.radians(10.0), 0.0, tangent)
    ends = np.concatenate([end_vertices(start), end_vertices(finish)], axis=1)
    assert printed("12.7353988862 8.8153890288", fair_vertex(ends, 2))
    assert printed("12.733173599 8.8250015454", fair_vertex(ends, 3))
    assert printed("0.010000000000", curvature(form_vertices(start, finish), 0.0))


def test_one_curve_is_no_midship_section() -> None:
    """B 28, T 10.5: flat, bilge and wall have radius 1.8125 and moment 1542.929 as told.

    From the centre line to the draught, with area and moment exact, one curve leaves them by some
    5 cm even with its best tangents, and dips below the base line: so three pieces are taken.
    """
    half, draught, area = 14.0, 10.5, 0.5 * 292.59
    corner = 1.0 - math.pi / 4.0
    assert printed("1.8125", math.sqrt((half * draught - area) / corner))
    r = 1.8125
    missing = r * r * (r / 2.0) - math.pi / 4.0 * r * r * (r - 4.0 * r / (3.0 * math.pi))
    moment = 0.5 * half * draught**2 - missing
    assert printed("1542.929", 2.0 * moment)
    even = math.hypot(half, draught) / 4.0
    vertices = form_vertices(
        FormEnd.of(0.0, 0.0, 0.5 * np.pi, 0.0, 2.5 * even),
        FormEnd.of(draught, half, 0.0, 0.0, 1.67 * even),
        np.array([area]), np.array([moment / area]),
    )  # fmt: skip
    z, y = FormChain(vertices).at(0, np.linspace(0.0, 4.0, 2001)).T
    bilge = (z < r) & (y > half - r)
    off = np.where(z < r, np.abs(z), np.abs(y - half))
    off = np.where(bilge, np.abs(np.hypot(z - r, y - half + r) - r), off)
    assert 0.045 < off.max() < 0.055
    assert -0.015 < z.min() < -0.005


def test_the_least_pace_of_a_full_run() -> None:
    """Of table 2, one curve runs back by a trifle with tangents of an eighth of the chord."""
    paces = [least_rate(form_vertices(*ends_of(name)), 0)[0] for name in NAMES]
    assert printed("-0.001", paces[2])
    assert min(paces[:2] + paces[3:]) > 0.0


def test_the_sectional_areas_of_a_bulk_carrier() -> None:
    """Both halves from the rounded values: middle vertices, and areas at 25 sections as printed."""
    full, p = 292.59, BULK_CARRIER["p"]
    run = form_vertices(
        FormEnd.of(-1.0, 6.08 / full, p["alpha0R"], p["k0R"], p["d0R"]),
        FormEnd.of(p["X1R"], 1.0, 0.0, 0.0, p["d1R"]),
        np.array([p["A_R"]]), np.array([p["Xc_R"]]),
    )  # fmt: skip
    entrance = form_vertices(
        FormEnd.of(p["X0E"], 1.0, 0.0, 0.0, p["d0E"]),
        FormEnd.of(1.0, 0.0, p["alpha1E"], p["k1E"], p["d1E"]),
        np.array([BULK_CARRIER["AE"]]), np.array([BULK_CARRIER["XcE"]]),
    )  # fmt: skip
    assert printed("-.7554385001 .4313007763", run[0, 3])
    assert printed(".7654970753 .6351452174", entrance[0, 3])
    assert run[0] == pytest.approx(np.array(BULK_CARRIER["run"]), abs=1e-13)
    assert entrance[0] == pytest.approx(np.array(BULK_CARRIER["ent"]), abs=1e-13)
    middle = straight_vertices((p["X1R"], 1.0), (p["X0E"], 1.0))
    course = FormChain.of([run[0], middle, entrance[0]])
    stations = np.array([0, 0.5, 1, 1.5, *range(2, 18), 18, 18.5, 19, 19.5, 20])
    areas = full * course.ordinate(stations / 10.0 - 1.0)
    assert printed(
        "6.080000 17.968035 41.267184 69.655946 100.138193 163.836942 222.351781 264.215741 "
        "284.909891 291.767568 292.59 292.59 292.59 292.59 292.59 292.59 292.237671 285.780666 "
        "262.435107 216.081681 150.103105 111.910901 71.796116 31.623908 0",
        areas,
    )
    assert areas == pytest.approx(BULK_CARRIER["areas"], abs=2e-12)
    coefficient = 0.995204081633 * course.area() / 2.0
    assert coefficient == pytest.approx(0.75, abs=1e-12)
    assert 90.0 * course.moment() / course.area() == pytest.approx(2.9, abs=1e-12)
