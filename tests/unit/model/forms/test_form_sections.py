"""Sections from definitions: area, centroid, flats, joints, and what is refused."""

from __future__ import annotations

import itertools

import attrs
import numpy as np
import pytest
from scipy.spatial.distance import cdist

from assoc_hull.errors import BadInputError, OutOfRangeError
from assoc_hull.geometry.curves import CurveData, FloatArray, SplineBatch
from assoc_hull.geometry.form_curves.curve import form_at
from assoc_hull.geometry.form_curves.integrals import form_integrals
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.segments import derivative, evaluate
from assoc_hull.model.form_definition import FormDefinition, GeneratedCurve
from assoc_hull.model.forms.form_values import Forms
from assoc_hull.model.forms.generate_points import (
    definitions_read,
    generated_points,
    marks_for,
    marks_suffice,
)
from assoc_hull.model.forms.line_layout import layout_at
from assoc_hull.model.forms.sections import (
    SectionCurves,
    SectionShape,
    parts_at_draught,
    section_shape,
)
from tests.form_ship import AREAS, PARTICULARS, WATERLINE, course, plain_ship

STATIONS = (0.0, 4.5, 9.0, 18.0, 36.0, 45.0, 54.0, 63.0, 90.0, 126.0, 135.0, 153.0, 171.0, 178.0)


def ends_at(forms: Forms, x: float) -> FloatArray:
    """Where a section meets profile and deck edge."""
    y, z = (float(forms.value(use, x)[0]) for use in ("deck_side", "deck_height"))
    return np.array([[x, 0.0, forms.contour(x)[0]], [x, y, z]])


def generated(forms: Forms, x: float) -> tuple[GeneratedCurve, FloatArray]:
    """A section as it would be generated, and its ends."""
    layout, ends = layout_at(forms, "section", x), ends_at(forms, x)
    marks = marks_for(forms, "section", layout, x, ends)[0]
    rows = tuple(range(len(marks)))
    return GeneratedCurve(f"ST {x}", 0, "section", layout, rows, marks), ends


def drawn(forms: Forms, x: float) -> tuple[SplineBatch, SectionShape, int]:
    """The spline of the kernel through a generated section, its shape, its pieces below water."""
    curve, ends = generated(forms, x)
    _, kinds, directions, finish = marks_for(forms, "section", curve.layout, x, ends)
    points = generated_points(forms, [curve], np.array([x]), ends[None])[0]
    data = CurveData.single(
        np.concatenate([ends[:1], points, ends[1:]]), [0, *kinds, 0],
        np.concatenate([np.zeros((1, 3)), directions, np.zeros((1, 3))]),
        (finish.kind[0], finish.kind[1]), np.array(finish.vector),
    )  # fmt: skip
    shape = section_shape(forms, curve.layout, np.array([x]), ends[None])
    return loft(data), shape, len(parts_at_draught(curve.layout)[0])


def immersed(spline: SplineBatch, draught: float) -> tuple[float, float]:
    """Area and moment about the base line of half a section below the draught, exactly."""
    nodes, weights = np.polynomial.legendre.leggauss(5)
    area = moment = 0.0
    for i, h in enumerate(np.diff(spline.knot).tolist()):
        if spline.xyz[i + 1, 2] > draught + 1e-9:
            break
        u, w = 0.5 + 0.5 * nodes[:, None], 0.5 * weights
        a, b, da, db = spline.xyz[i], spline.xyz[i + 1], spline.leave[i], spline.arrive[i + 1]
        point = (
            a * (1 + 2 * u) * (1 - u) ** 2 + b * u * u * (3 - 2 * u)
            + h * (da * u * (1 - u) ** 2 - db * u * u * (1 - u))
        )  # fmt: skip
        rate = (
            6 * u * (1 - u) * (b - a)
            + h * (da * (1 - u) * (1 - 3 * u) + db * u * (3 * u - 2))
        )  # fmt: skip
        area += float((point[:, 1] * rate[:, 2] * w).sum())
        moment += float((point[:, 2] * point[:, 1] * rate[:, 2] * w).sum())
    return area, moment


def distance(spline: SplineBatch, shape: SectionShape) -> float:
    """The largest distance of a spline from a shape that is drawn as a close polyline."""
    points = evaluate(spline, np.zeros(300, np.int64), np.linspace(0.0, spline.knot[-1], 300))
    # Joints but once: a step of no length has no direction.
    t = np.append(np.tile(np.arange(1000) * 4e-3, len(shape.pieces)), 4.0)
    piece = np.minimum(np.arange(len(t)) // 1000, len(shape.pieces) - 1)
    line = shape.at(np.zeros(len(t), np.int64), piece, t)
    near = cdist(points, line).argmin(axis=1)
    found = np.full(len(points), np.inf)
    for step in (-1, 1):
        start, way = line[near], line[np.clip(near + step, 0, len(line) - 1)] - line[near]
        length = np.maximum((way * way).sum(axis=1), 1e-30)
        share = np.clip(((points - start) * way).sum(axis=1) / length, 0.0, 1.0)
        off = points - start - share[:, None] * way
        found = np.minimum(found, np.sqrt((off * off).sum(axis=1)))
    return float(found.max())


def turns(rate: FloatArray, step: float) -> int:
    """How often a curve, by its derivatives at even steps, changes between left and right turns."""
    angle = np.arctan2(rate[:, 1], rate[:, 2])
    pace = np.sqrt((rate * rate).sum(axis=1))
    bend = np.diff(angle) / (0.5 * (pace[1:] + pace[:-1]) * step)
    # Flatter than a radius of 1 km is straight.
    seen = np.sign(bend[np.abs(bend) > 1e-3])
    return int((seen[1:] != seen[:-1]).sum())


def test_no_inflection_of_its_own(ship: Forms) -> None:
    """The spline turns left and right as often as its pieces do."""
    for x in (4.5, 27.0, 45.0, 153.0, 171.0):
        spline, shape, _ = drawn(ship, x)
        knots, step = np.linspace(0.0, spline.knot[-1], 1200, retstep=True)
        own = derivative(spline, np.zeros(1200, np.int64), knots)
        t = np.append(np.tile(np.arange(600) / 150.0, len(shape.pieces)), 4.0)
        piece = np.minimum(np.arange(len(t)) // 600, len(shape.pieces) - 1)
        exact = shape.tangent(np.zeros(len(t), np.int64), piece, t)
        assert turns(own, step) == turns(exact, 1.0 / 150.0)


@pytest.fixture(scope="module")
def ship() -> Forms:
    """The plain ship."""
    return plain_ship()


@pytest.mark.parametrize("x", STATIONS)
def test_area_and_distance(ship: Forms, x: float) -> None:
    """The spline has the area of the curve of areas within 1e-6, and passes the pieces by 1 mm."""
    spline, shape, _ = drawn(ship, x)
    want = 0.5 * float(ship.value("sectional_area", x)[0])
    assert immersed(spline, PARTICULARS.draught)[0] == pytest.approx(want, rel=1e-6)
    assert distance(spline, shape) < 1e-3


def varied(rng: np.random.Generator) -> Forms:
    """The plain ship with other areas, angles, tangents and half-breadths."""
    keel = {f"n{i}": (x, rng.uniform(40.0, 88.0)) for i, x in enumerate((0.0, 60.0, 120.0, 180.0))}
    flare = {f"n{i}": (x, rng.uniform(0.0, 30.0)) for i, x in enumerate((0.0, 60.0, 120.0, 180.0))}
    return plain_ship(
        AREAS.having({"full": rng.uniform(260.0, 288.0)}),
        WATERLINE.having({"run_area": rng.uniform(0.53, 0.58), "run_centroid": None}),
        course("keel_angle", keel, "monotone"),
        course("waterline_angle", flare, "monotone"),
        course("keel_tangent", {"all": (0.0, rng.uniform(0.3, 1.1))}),
        course("half_siding", {"aft": (-4.0, 0.2), "fore": (181.5, 0.2)}),
        without=("flat_of_side", "flat_of_bottom", "bilge_radius"),
    )


def test_random_definitions() -> None:
    """Whatever the definitions are: a section keeps area and distance, or is refused."""
    rng = np.random.default_rng(9)
    made = 0
    for _ in range(14):
        forms, x = varied(rng), float(rng.uniform(10.0, 165.0))
        try:
            spline, shape, _ = drawn(forms, x)
        except (OutOfRangeError, BadInputError):
            continue
        made += 1
        want = 0.5 * float(forms.value("sectional_area", x)[0])
        assert immersed(spline, PARTICULARS.draught)[0] == pytest.approx(want, rel=1e-6)
        assert distance(spline, shape) < 1e-3
        assert spline.xyz[:, 1].min() >= 0.0
    assert made >= 9


def constant(use: str, value: float) -> FormDefinition:
    """A course that has one value everywhere."""
    return course(use, {"a": (-50.0, value), "b": (250.0, value)}, "straight")


def one_section(area: float, breadth: float, deck: tuple[float, float], **uses: float) -> Forms:
    """A ship whose sections amidships are all the same."""
    return Forms.of(
        [
            attrs.evolve(AREAS.having({"full": area, "run_start_ordinate": 0.0})),
            WATERLINE.having({"full": breadth}),
            constant("profile", 0.0), constant("deck_side", deck[0]),
            constant("deck_height", deck[1]),
            *(constant(use, value) for use, value in uses.items()),
        ],
        PARTICULARS,
    )  # fmt: skip


def test_printed_section() -> None:
    """The section with the printed data has the printed middle vertex (12 digits)."""
    forms = one_section(120.0, 8.0, (9.5, 15.0), centroid=6.4, keel_angle=62.0, waterline_angle=0.0)
    shape = section_shape(forms, "curve+topside", np.array([90.0]), ends_at(forms, 90.0)[None])
    (below, _) = shape.pieces
    assert isinstance(below, SectionCurves)
    assert below.vertices[0, 3] == pytest.approx([4.06634928353, 6.583522278763], abs=2e-12)
    sums = form_integrals(below.vertices)
    assert sums.area[0] == pytest.approx(60.0, abs=1e-12)
    assert sums.moment[0] / sums.area[0] == pytest.approx(6.4, abs=1e-12)
    assert sums.moment_y[0] / sums.area[0] == pytest.approx(3.3237365693904, abs=1e-12)
    middle = form_at(below.vertices, np.array([2.0]))[0]
    assert middle == pytest.approx([4.31500001556, 5.965165741483], abs=6e-12)


def test_printed_section_of_longer_tangents() -> None:
    """The same with tangents of 0.8 of a quarter of the chord (12 digits)."""
    forms = one_section(
        120.0, 8.0, (9.5, 15.0), centroid=6.4, keel_angle=62.0, keel_tangent=0.8,
        waterline_tangent=0.8,
    )  # fmt: skip
    shape = section_shape(forms, "curve+topside", np.array([90.0]), ends_at(forms, 90.0)[None])
    below = shape.pieces[0]
    assert isinstance(below, SectionCurves)
    assert below.vertices[0, 3] == pytest.approx([3.617398688192, 5.754153725792], abs=2e-12)
    sums = form_integrals(below.vertices)
    assert sums.moment_y[0] / sums.area[0] == pytest.approx(3.3193535396, abs=6e-11)


def test_printed_joint() -> None:
    """Above the printed joint lies the printed topside; its curvature goes on (10 digits)."""
    forms = one_section(
        120.0, 8.0, (9.5, 15.0), keel_angle=62.0, waterline_angle=15.0, waterline_curvature=0.01,
        deck_angle=10.0,
    )  # fmt: skip
    shape = section_shape(forms, "curve+topside", np.array([90.0]), ends_at(forms, 90.0)[None])
    below, above = shape.pieces
    assert isinstance(above, SectionCurves)
    assert above.vertices[0, 3] == pytest.approx([12.733173599, 8.8250015454], abs=6e-11)
    assert isinstance(below, SectionCurves)
    for piece, t in ((below, 4.0), (above, 0.0)):
        first, second = (form_at(piece.vertices, np.array([t]), order)[0] for order in (1, 2))
        turn = first[0] * second[1] - first[1] * second[0]
        assert turn / float(first @ first) ** 1.5 == pytest.approx(0.01, abs=1e-12)
        assert first[1] / first[0] == pytest.approx(np.tan(np.radians(15.0)), abs=1e-12)


def test_parallel_middle_body(ship: Forms) -> None:
    """Amidships: level, an arc of the bilge radius, upright; the spline keeps 1 mm."""
    spline, _, _ = drawn(ship, 90.0)
    points = evaluate(spline, np.zeros(800, np.int64), np.linspace(0.0, spline.knot[-1], 800))
    y, z = points[:, 1], points[:, 2]
    level, wall = y < 14.0 - 1.8125, z > 1.8125
    assert np.abs(z[level]).max() < 1e-12
    assert np.abs(y[wall] - 14.0).max() < 1e-12
    bilge = ~level & ~wall
    radius = np.hypot(y[bilge] - 12.1875, z[bilge] - 1.8125)
    assert np.abs(radius - 1.8125).max() < 1e-3


def test_missing_centroid_is_the_fairest(ship: Forms) -> None:
    """With a centroid definition the section has it; without, it comes out within the box."""
    _, moment = immersed(drawn(ship, 36.0)[0], PARTICULARS.draught)
    half = 0.5 * float(ship.value("sectional_area", 36.0)[0])
    forms = plain_ship(course("centroid", {"a": (30.0, 5.8), "b": (42.0, 5.8)}))
    area, other = immersed(drawn(forms, 36.0)[0], PARTICULARS.draught)
    assert other / area == pytest.approx(5.8, rel=1e-5)
    assert moment / half != pytest.approx(5.8, rel=1e-3)


def test_same_bits_alone_and_in_company(ship: Forms) -> None:
    """A curve has the same bits alone, in any batch and in any order."""
    curves, ends = zip(*(generated(ship, x) for x in STATIONS), strict=True)
    places = np.array(STATIONS)
    together = generated_points(ship, curves, places, np.array(ends))
    order = np.random.default_rng(3).permutation(len(curves))
    shuffled = generated_points(
        ship, [curves[i] for i in order], places[order], np.array([ends[i] for i in order])
    )
    for place, i in enumerate(order.tolist()):
        alone = generated_points(ship, [curves[i]], places[i : i + 1], ends[i][None])[0]
        assert alone.tobytes() == together[i].tobytes() == shuffled[place].tobytes()


def test_a_section_depends_on_what_it_reads_only() -> None:
    """A definition that changes a section is among those that it reads, and each matters once."""
    ship = plain_ship()
    changes = {
        "sectional_area": AREAS.having({"run_area": 0.5105}),
        "design_waterline": WATERLINE.having({"run_area": 0.551}),
        "keel_angle": constant("keel_angle", 70.0),
        "keel_curvature": constant("keel_curvature", 0.01),
        "waterline_angle": constant("waterline_angle", 12.0),
        "deck_angle": constant("deck_angle", 12.0),
        "half_siding": constant("half_siding", 0.3),
        "keel_tangent": constant("keel_tangent", 0.6),
        "centroid": constant("centroid", 5.8),
    }
    before = {x: generated(ship, x) for x in (36.0, 45.0, 90.0, 181.0)}
    mattered = set()
    for use, definition in changes.items():
        forms = plain_ship(definition)
        for x, (curve, ends) in before.items():
            if use == "centroid" and x > 40.0:
                continue
            places = np.array([x])
            old, new = (generated_points(f, [curve], places, ends[None])[0] for f in (ship, forms))
            if old.tobytes() != new.tobytes():
                assert use in definitions_read(curve)
                mattered.add(use)
    assert mattered == set(changes) - {"half_siding"}
    flat = GeneratedCurve("", 0, "section", "level+curve+upright+topside", (), ())
    assert not {"keel_angle", "waterline_angle"} & set(definitions_read(flat))


def test_known_marks_stay(ship: Forms) -> None:
    """Marks that suffice come back as they are; too few are added to."""
    curve, ends = generated(ship, 36.0)
    again = marks_for(ship, "section", curve.layout, 36.0, ends, curve.marks)[0]
    assert again == curve.marks
    more = marks_for(ship, "section", curve.layout, 36.0, ends, curve.marks[::3])[0]
    assert set(curve.marks[::3]) < set(more)
    both = [curve, curve.evolve(marks=curve.marks[::3])]
    suffice = marks_suffice(ship, both, np.full(2, 36.0), np.stack([ends, ends]))
    assert suffice.tolist() == [True, False]


def test_layouts(ship: Forms) -> None:
    """Layouts follow from flats, draught and middle body."""
    found = {x: layout_at(ship, "section", x) for x in (9.0, 45.0, 54.0, 63.0, 90.0, 181.0)}
    assert found == {
        9.0: "curve+topside", 45.0: "level+curve+topside", 54.0: "level+curve+topside+wall",
        63.0: "level+curve+upright+topside", 90.0: "level+arc+upright+topside", 181.0: "topside",
    }  # fmt: skip


def test_a_moved_deck_edge_moves_the_topside_only(ship: Forms) -> None:
    """The ends are read: a section follows a deck edge that was edited, above the draught."""
    curve, ends = generated(ship, 18.0)
    moved = ends.copy()
    moved[1, 1] += 0.4
    places = np.array([18.0])
    old, new = (generated_points(ship, [curve], places, e[None])[0] for e in (ends, moved))
    above = old[:, 2] > PARTICULARS.draught + 1e-9
    assert (old[~above] == new[~above]).all()
    assert (old[above, 1] < new[above, 1]).all()


@pytest.mark.parametrize(
    ("others", "x", "name", "text"),
    [
        pytest.param(
            [WATERLINE.having({"full": 6.0})], 27.0, "sectional_area", "outside the box",
            id="an area outside the box",
        ),
        pytest.param(
            [constant("centroid", 9.9)], 27.0, "centroid", "cannot be met", id="a centroid too high"
        ),
        pytest.param(
            [constant("bilge_radius", 15.0)], 90.0, "bilge_radius", "no room", id="a bilge too wide"
        ),
    ],
)  # fmt: skip
def test_refused_with_station_and_interval(
    others: list[FormDefinition], x: float, name: str, text: str
) -> None:
    """What a section cannot have is refused, with the station and what it can have."""
    with pytest.raises(OutOfRangeError, match=text) as caught:
        generated(plain_ship(*others), x)
    assert caught.value.name == name
    assert f"x = {x:g} m" in caught.value.where
    assert caught.value.least < caught.value.most


@pytest.mark.parametrize(
    ("others", "without", "x", "text"),
    [
        pytest.param(
            [constant("bilge_radius", 2.0)], (), 90.0, "bilge_radius of 1.8124993 m", id="bilge"
        ),
        pytest.param([], ("keel_angle",), 27.0, "keel_angle", id="no angle at the contour"),
        pytest.param([], ("deck_height",), 27.0, "deck_height", id="no deck"),
        pytest.param([], (), 200.0, "does not reach", id="ahead of the ship"),
        pytest.param(
            [constant("keel_angle", -60.0)], (), 175.5,
            "half-breadth of -", id="through the centre plane",
        ),
        pytest.param(
            [constant("flat_of_side", 8.0)], (), 45.0, "flat of side", id="side without waterline"
        ),
    ],
)  # fmt: skip
def test_refused_by_name(
    others: list[FormDefinition], without: tuple[str, ...], x: float, text: str
) -> None:
    """What is missing or contradicts is named."""
    with pytest.raises(BadInputError, match=text):
        generated(plain_ship(*others, without=without), x)


def test_lines_of_courses(ship: Forms) -> None:
    """Profile, deck edge and borders of flats keep 1 mm; the keel is level between its tangents."""
    for what in ("profile", "deck edge", "flat of side", "flat of bottom"):
        layout = layout_at(ship, what, np.nan)
        marks, kinds, directions, _ = marks_for(ship, what, layout, np.nan)
        curve = GeneratedCurve(what, 0, what, layout, tuple(range(len(marks))), marks)
        (xyz,) = generated_points(ship, [curve], np.zeros(1), np.zeros((1, 2, 3)))
        assert np.isfinite(xyz).all()
        if what == "profile":
            tangent = [i for i, kind in enumerate(kinds) if kind == 1]
            assert directions[tangent].tolist() == [[1.0, 0.0, 0.0]] * 2
            assert xyz[tangent].tolist() == [[9.0, 0.0, 0.0], [172.0, 0.0, 0.0]]
        if what == "deck edge":
            for use, axis in (("deck_side", 1), ("deck_height", 2)):
                assert xyz[:, axis] == pytest.approx(ship.value(use, xyz[:, 0]), abs=1e-9)
    assert [s.split(":")[-1] for s in layout_at(ship, "deck edge", np.nan).split("+")[1:]] == [
        "side", "height", "height", "side",
    ]  # fmt: skip


def test_transom(ship: Forms) -> None:
    """A transom is a section with its ends: contour and deck edge of the definitions."""
    forms = plain_ship(WATERLINE.having({"run_start": -1.06}))
    layout = layout_at(forms, "transom", -4.0)
    marks = marks_for(forms, "transom", layout, -4.0)[0]
    curve = GeneratedCurve("transom", 0, "transom", layout, tuple(range(len(marks))), marks)
    (xyz,) = generated_points(forms, [curve], np.array([-4.0]), np.zeros((1, 2, 3)))
    assert xyz[[0, -1]] == pytest.approx(np.array([[-4.0, 0.0, 10.8], [-4.0, 10.5, 16.0]]))


@pytest.mark.parametrize(
    ("z", "layout", "breadth"),
    [
        pytest.param(6.0, "side", 14.0, id="on the side"),
        pytest.param(0.9, "parallel", 12.1875 + np.sqrt(1.8125**2 - 0.9125**2), id="in the bilge"),
        pytest.param(15.5, "", None, id="above the flat"),
        pytest.param(-0.5, "", None, id="below the ship"),
    ],
)  # fmt: skip
def test_waterlines_go_onto_the_flat(
    ship: Forms, z: float, layout: str, breadth: float | None
) -> None:
    """A waterline is tangent where it goes onto the flat of side, or the middle body below."""
    assert layout_at(ship, "waterline", z) == layout
    marks, kinds, directions, _ = marks_for(ship, "waterline", layout, z)
    curve = GeneratedCurve("WL", 0, "waterline", layout, tuple(range(len(marks))), marks)
    (xyz,) = generated_points(ship, [curve], np.array([z]), np.zeros((1, 2, 3)))
    assert len(xyz) == len(marks) == len(kinds) == len(directions)
    if breadth is not None:
        assert xyz[:, 1].tolist() == pytest.approx([breadth] * 2)
        assert all(a < b for a, b in itertools.pairwise(xyz[:, 0].tolist()))
        assert xyz[:, 2].tolist() == [z, z]


def test_unknown_line(ship: Forms) -> None:
    """What cannot be generated is refused."""
    with pytest.raises(BadInputError, match="cannot be generated"):
        layout_at(ship, "frame", 3.0)


def test_marks_on_no_piece(ship: Forms) -> None:
    """A mark beyond the pieces is refused: nothing lies there."""
    curve, ends = generated(ship, 36.0)
    for mark in ((2, 0.0), (0, 4.5), (-1, 1.0)):
        with pytest.raises(BadInputError, match="lies on no piece"):
            generated_points(ship, [curve.evolve(marks=(mark,))], np.array([36.0]), ends[None])
