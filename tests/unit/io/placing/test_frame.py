"""Where base line, waterline and perpendiculars are: given, or found with the evidence told."""

from typing import Any

import attrs
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.surfaces.triangles import Triangles, grid_triangles
from assoc_hull.io.lines.ship_frame import ShipFrame, StatedPlaces
from assoc_hull.io.placing.frame import find_frame
from assoc_hull.io.placing.options import FileAxes, FrameOptions
from assoc_hull.io.placing.outline import HullOutline, outline_of_mesh
from assoc_hull.io.reports import Notebook
from tests import meshes

LPP, DRAUGHT, DEPTH, HALF = 100.0, 6.0, 10.0, 8.0


def ship() -> Triangles:
    """Half a ship: transom 4 m aft of AP and wet by .5 m, stem raked 45 degrees over the design
    waterline, which it meets at x = 100, flat keel at z = 0 from 10 to 95 m."""
    z = np.linspace(0.0, DEPTH, 21)
    t = np.linspace(0.0, 1.0, 101)
    aft = np.interp(z, [0.0, DRAUGHT - 0.5, DRAUGHT, DEPTH], [10.0, 2.0, -4.0, -4.0])
    fore = np.interp(z, [0.0, 2.0, DRAUGHT, DEPTH], [95.0, 98.0, 100.0, 104.0])
    x = aft + t[:, None] * (fore - aft)
    full = np.clip(np.minimum(t / 0.3, (1.0 - t) / 0.25), 0.0, 1.0)[:, None]
    full = np.where(t[:, None] < 0.5, np.maximum(full, 0.5 * (z >= DRAUGHT - 0.25)), full)
    y = HALF * full * np.sqrt(np.clip(z / 2.0, 0.0, 1.0))
    return grid_triangles(np.stack([x, y, np.broadcast_to(z, x.shape)], axis=2))


def with_bulb(nose: float, top: float, foot: float) -> HullOutline:
    """The ship with a bulb: how far forward and how high it reaches, and where the stem begins."""
    outline = outline_of_mesh(ship())
    places = [(95.0, 0.0), (nose, 0.4 * top), (nose, 0.8 * top), (nose - 2.0, top),
              (100.0, foot), (100.2, foot + 1.0), (104.0, DEPTH)]  # fmt: skip
    stem = np.array(places)
    aft = outline.centre[outline.centre[:, :, 0].max(axis=1) < 95.0]
    bulb = np.stack([stem[:-1], stem[1:]], axis=1)
    return HullOutline(outline.xyz, outline.edge, np.concatenate([aft, bulb]))


def moved(mesh: Triangles, x: float, z: float) -> Triangles:
    """A mesh with another origin."""
    return meshes.moved(mesh, lambda xyz: xyz + np.array([x, 0.0, z]))


def raked(mesh: Triangles, rise: float) -> Triangles:
    """The ship with its keel sheared so that it rises forward by so much over Lpp."""

    def shear(xyz: FloatArray) -> FloatArray:
        out = xyz.copy()
        out[:, 2] += rise * (xyz[:, 0] / LPP) * (1.0 - xyz[:, 2] / DEPTH)
        return out

    return meshes.moved(mesh, shear)


def find(
    mesh: Triangles, stated: StatedPlaces | None = None, axes: FileAxes | None = None, **said: Any
) -> tuple[ShipFrame, Notebook]:
    """Find the frame of a mesh, with what was told."""
    book = Notebook()
    outline = outline_of_mesh(mesh)
    frame = find_frame(outline, FrameOptions(**said), book, "the mesh", axes=axes, stated=stated)
    return frame, book


def suspected(book: Notebook) -> set[str]:
    """The kinds of what was suspected."""
    return {note.kind for note in book.suspicions}


def told(book: Notebook, kind: str) -> str:
    """What was assumed of one kind."""
    return next(note.what for note in book.assumptions if note.kind == kind)


def test_a_ship_in_its_own_axes_stays_to_the_bit() -> None:
    """With Lpp and draught given nothing moves, though the transom lies aft of the AP."""
    mesh = ship()
    frame, book = find(mesh, length=LPP, draught=DRAUGHT)
    assert (frame.ap, frame.fp, frame.base) == (0.0, 100.0, 0.0)
    assert not frame.moves
    assert frame.moved(mesh.xyz) is mesh.xyz
    assert not book.suspicions
    assert (frame.breadth, frame.depth) == (2 * HALF, DEPTH)


@given(x=st.floats(-150, 150), z=st.floats(-20, 20))
def test_perpendiculars_follow_the_hull_wherever_the_file_has_its_origin(
    x: float, z: float
) -> None:
    """By Lpp and draught alone AP, FP and base line are found within half a per cent of Lpp."""
    frame, book = find(moved(ship(), x, z), length=LPP, draught=DRAUGHT)
    assert frame.ap == pytest.approx(x, abs=5e-3 * LPP)
    assert frame.fp - frame.ap == pytest.approx(LPP, abs=1e-9)
    assert frame.base == pytest.approx(z, abs=1e-3 * LPP)
    # z = 0 may cut the hull somewhere else than at the draught, x = 0 lie beside a perpendicular
    # or midship: that is asked about.
    beside = min(abs(x), abs(x + 0.5 * LPP), abs(x + LPP)) < 0.03 * LPP + 1e-6
    allowed = {"aft perpendicular", "forward perpendicular"} if beside else set()
    assert suspected(book) <= allowed | ({"draught"} if -1.001 * DEPTH < z < 0.0 else set())


@pytest.mark.parametrize(
    ("x", "origin"), [(2.0, "ap"), (-2.5, "ap"), (-51.5, "midship"), (-98.0, "fp"), (-102.0, "fp")]
)
def test_x_0_beside_a_found_perpendicular_is_suspected_and_each_remedy_cures_it(
    x: float, origin: str
) -> None:
    """The origin, or the place, as the message says, in a file turned round too."""
    mesh, axes = moved(ship(), x, 0.0), FileAxes(x_sign=-1.0)
    _, book = find(mesh, axes=axes, length=LPP, draught=DRAUGHT)
    (note,) = book.suspicions
    assert f"give origin={origin!r}" in note.what
    assert f"{abs(x + {'ap': 0, 'midship': 50, 'fp': 100}[origin]):.4g} m" in note.what
    place = note.what.partition("give ap='")[2].partition("'")[0]
    frame, book = find(mesh, axes=axes, length=LPP, draught=DRAUGHT, ap=place)
    assert frame.ap == pytest.approx(x, abs=1e-3)
    assert not book.suspicions
    frame, _ = find(mesh, axes=axes, length=LPP, draught=DRAUGHT, origin=origin)
    assert frame.ap == {"ap": 0.0, "midship": -50.0, "fp": -100.0}[origin]


def test_without_lpp_x_0_beside_the_found_ap_is_named_with_its_origin() -> None:
    """On either side of it, in the suspicion that is there anyway."""
    for x in (6.0, 2.0):
        _, book = find(moved(ship(), x, 0.0), draught=DRAUGHT)
        (note,) = book.suspicions
        assert f"2 m {'aft' if x > 4.0 else 'forward'} of it, is the AP give" in note.what
        assert "origin='ap'" in note.what


def test_the_base_line_is_the_bottom_amidships_and_no_dome_or_skeg() -> None:
    """What hangs below it forward or aft is told with its depth and does not count."""
    for place, kind in ((85.0, "dome"), (15.0, "skeg")):
        mesh = ship()
        xyz = mesh.xyz.copy()
        on = (np.abs(xyz[:, 0] - place) < 4.0) & (xyz[:, 2] == 0.0)
        xyz[on, 2] -= 1.5
        frame, book = find(Triangles(xyz, mesh.face), length=LPP, draught=DRAUGHT)
        assert frame.base == 0.0
        assert kind in told(book, "below the base line")
        assert "1.5 m below" in told(book, "below the base line")


def test_a_raked_keel_is_told_and_the_base_line_goes_through_its_lowest_place_amidships() -> None:
    """The rake is over Lpp, positive where the keel is deeper aft."""
    frame, book = find(raked(ship(), 2.0), length=LPP, draught=DRAUGHT)
    assert frame.rake == pytest.approx(2.0, rel=0.01)
    assert frame.base == pytest.approx(0.02 * 30.0, abs=0.1)
    assert "2 m deeper aft" in told(book, "raked keel")
    flat, _ = find(ship(), length=LPP, draught=DRAUGHT)
    assert flat.rake == 0.0


def test_a_draught_over_a_raked_keel_is_suspected_beside_z_0_and_each_remedy_cures_it() -> None:
    """The place is named as the file has it, in a file with z downward too."""
    mesh, axes = raked(ship(), 2.0), FileAxes(z_sign=-1.0)
    frame, book = find(mesh, axes=axes, length=LPP, draught=DRAUGHT)
    assert suspected(book) == {"base line"}
    what = book.suspicions[0].what
    assert f"{frame.base:.4g} m over z = 0" in what
    assert "give base=0;" in what
    place = what.partition("give base='")[2].partition("'")[0]
    for base, low in ((place, frame.base), (0, 0.0)):
        again, book = find(mesh, axes=axes, length=LPP, draught=DRAUGHT, base=base)
        assert again.base == pytest.approx(low, abs=1e-5)
        assert not suspected(book)


def test_z_0_is_the_waterline_only_where_it_cuts_the_hull_above_the_base_line() -> None:
    """Drawn from the waterline the draught is found; from the keel it is taken, and said."""
    frame, book = find(moved(ship(), 0.0, -DRAUGHT), length=LPP)
    assert (frame.base, frame.draught) == (-DRAUGHT, DRAUGHT)
    assert "taken for the waterline" in told(book, "draught")
    assert frame.origins["draught"] == "found"
    for z in (-DEPTH - 0.5, 1.0 - DEPTH / 10, -DEPTH + 0.2):
        frame, book = find(moved(ship(), 0.0, z), length=LPP)
        assert frame.draught == pytest.approx(0.5 * DEPTH)
    frame, book = find(ship(), length=LPP)
    assert frame.draught == 0.5 * DEPTH
    assert "nothing tells it" in told(book, "draught")
    assert frame.origins["draught"] == "assumed"


def test_without_lpp_the_ap_is_the_end_of_the_waterline_and_a_suspicion() -> None:
    """It names what hangs on it and how to say better; what it says to give cures it."""
    frame, book = find(ship(), draught=DRAUGHT)
    assert frame.ap == pytest.approx(-4.0)
    assert frame.length == pytest.approx(104.0)
    assert [note.kind for note in book.suspicions] == ["aft perpendicular"]
    what = book.suspicions[0].what
    assert "LCB in % of Lpp and station numbers hang on it" in what
    assert "origin='ap'" in what
    cured, book = find(ship(), draught=DRAUGHT, origin="ap")
    assert cured.ap == 0.0
    assert cured.length == pytest.approx(LPP)
    assert not book.suspicions


@pytest.mark.parametrize(("top", "foot"), [(5.0, 4.0), (7.0, 5.5), (9.0, 5.0)])
def test_the_fp_is_where_the_stem_meets_the_waterline_and_not_the_bulb(
    top: float, foot: float
) -> None:
    """A bulb below the waterline, through it, or high over it stands before the FP."""
    book = Notebook()
    said = FrameOptions(draught=DRAUGHT, origin="ap")
    frame = find_frame(with_bulb(106.0, top, foot), said, book, "the mesh")
    assert frame.stem is not None
    assert 100.0 <= frame.stem <= 101.0
    assert frame.fp == frame.stem
    assert ("bulb" in told(book, "stem")) if top > DRAUGHT else not book.suspicions


def test_a_waterline_that_ends_on_the_bulb_is_doubted() -> None:
    """At a draught below the top of a bulb that joins the stem, the FP goes by the stem above."""
    mesh = ship()
    xyz = mesh.xyz.copy()
    bulb = (xyz[:, 2] < 4.0) & (xyz[:, 0] > 90.0)
    xyz[bulb, 0] += 6.0 * (xyz[bulb, 0] - 90.0) / 10.0
    frame, book = find(Triangles(xyz, mesh.face), draught=3.0, origin="ap")
    assert frame.fp == pytest.approx(99.0, abs=0.5)
    assert suspected(book) == {"stem"}


@pytest.mark.parametrize(
    ("said", "ap", "base"),
    [
        ({"ap": 7.0, "length": LPP}, 7.0, 3.0),
        ({"ap": 7.0}, 7.0, 3.0),
        ({"fp": 107.0, "length": LPP}, 7.0, 3.0),
        ({"ap": "7 m", "fp": "107 m"}, 7.0, 3.0),
        ({"base": "3 m", "length": LPP}, 7.0, 3.0),
        ({"waterline": 9.0, "length": LPP}, 7.0, 3.0),
        ({"waterline": 9.0, "draught": 6.0, "length": LPP}, 7.0, 3.0),
    ],
)
def test_places_that_are_given_are_taken(said: dict[str, Any], ap: float, base: float) -> None:
    """Perpendiculars, base line and waterline in coordinates of the file, alone or together."""
    known = {"draught": DRAUGHT} | said
    if "waterline" in said and "draught" not in said:
        known.pop("draught")
    frame, book = find(moved(ship(), 7.0, 3.0), **known)
    assert frame.ap == pytest.approx(ap, abs=0.01)
    assert frame.fp == pytest.approx(107.0, abs=0.01)
    assert (frame.base, frame.draught) == pytest.approx((base, DRAUGHT))
    assert not book.suspicions


def test_numbers_are_in_units_of_the_file_and_texts_in_metres() -> None:
    """A file in feet at scale 1:10, its bow at low x; a sign goes with its axis."""
    axes = FileAxes(factor=3.048, x_sign=-1.0)
    for fp, waterline in ((-107.0 / 3.048, 9.0 / 3.048), ("-107 m", "9000 mm")):
        frame, _ = find(
            moved(ship(), 7.0, 3.0), axes=axes, fp=fp, waterline=waterline, length=LPP, base="3m"
        )
        assert (frame.ap, frame.fp) == pytest.approx((7.0, 107.0))
        assert frame.draught == pytest.approx(6.0)


@pytest.mark.parametrize(("origin", "x"), [("ap", 0.0), ("midship", -50.0), ("fp", -100.0)])
def test_the_origin_of_x_may_be_said(origin: str, x: float) -> None:
    """At AP, midship or FP; with Lpp or, but at the FP, without it."""
    known: tuple[dict[str, Any], ...] = ({"length": LPP}, {})
    for said in known:
        frame, book = find(moved(ship(), x, 0.0), draught=DRAUGHT, origin=origin, **said)
        if said or origin != "fp":
            assert frame.ap == pytest.approx(x, abs=0.01)
            assert not book.suspicions
        else:
            assert suspected(book) == {"aft perpendicular"}


def test_what_a_file_states_comes_after_what_is_given_and_before_what_is_found() -> None:
    """Lpp, draught and base line of the file; a rudder axis is the AP where Lpp is not told."""
    frame, book = find(ship(), StatedPlaces(length=98.0, draught=6.0, depth=9.5, base=0.25))
    assert (frame.length, frame.draught, frame.depth, frame.base) == (98.0, 6.0, 9.5, 0.25)
    frame, book = find(ship(), StatedPlaces(rudder=1.0), draught=DRAUGHT)
    assert frame.ap == 1.0
    assert not book.suspicions
    frame, _ = find(ship(), StatedPlaces(length=98.0, draught=5.0), length=LPP, draught=DRAUGHT)
    assert (frame.length, frame.draught) == (LPP, DRAUGHT)


def test_a_design_trim_is_told_and_the_fp_goes_by_the_draught_there() -> None:
    """The draught of the hull is that amidships; the stem is met at the draught of the FP."""
    frame, book = find(ship(), draught_aft=6.5, draught_fwd=5.5, origin="ap")
    assert (frame.draught, frame.trim) == (6.0, 1.0)
    assert frame.stem == pytest.approx(99.75, abs=0.01)
    assert "by the stern" in told(book, "design trim")


WRONG: list[tuple[dict[str, Any], str]] = [
    ({"draught": 60.0}, "over the top of the hull"),
    ({"waterline": 6000.0}, "the hull runs from z ="),
    ({"base": -60.0}, "the hull runs from z ="),
    ({"ap": 4000.0}, "give ap in units of the file, or with a unit"),
    ({"ap": 90.0, "fp": 10.0}, "exchange them"),
    ({"ap": 0.0, "fp": 100.0, "length": 50.0}, "leave one out"),
    ({"origin": "fp", "length": LPP}, "the perpendiculars would stand at"),
    ({"length": 400.0}, "the perpendiculars would stand at"),
    ({"depth": 100.0}, "the hull reaches 10 m"),
    ({"base": 8.0, "waterline": 6.0}, "below the base line"),
    ({"draught_aft": 6.0}, "draught_fwd is missing"),
    ({"draught_aft": 6.0, "draught_fwd": 5.0, "draught": 7.0}, "leave draught out"),
    ({"origin": "ap", "ap": 0.0}, "give either"),
    ({"origin": "stern"}, "use ap or midship or fp"),
    ({"waterline": "6,0 m"}, "as '12.5 m'"),
    ({"waterline": "6 furlongs"}, "as '12.5 m'"),
    ({"length": -3.0}, "give a number above 0"),
]


@pytest.mark.parametrize(("said", "words"), WRONG)
def test_what_the_hull_contradicts_is_refused_with_what_to_do(
    said: dict[str, Any], words: str
) -> None:
    """Places off the hull, particulars it does not have, and options that say one thing twice."""
    with pytest.raises(BadInputError, match=words.replace("(", r"\(")):
        find(ship(), **said)


def test_a_length_that_does_not_fit_is_suspected() -> None:
    """Too long by a fifth the AP lies behind the hull; where x = 0 was said the FP is off."""
    assert suspected(find(ship(), length=120.0, draught=DRAUGHT)[1]) == {"aft perpendicular"}
    frame, book = find(ship(), length=90.0, draught=DRAUGHT, origin="ap")
    assert frame.fp == 90.0
    assert suspected(book) == {"forward perpendicular"}


def test_a_base_line_off_the_bottom_is_suspected_and_taken() -> None:
    """A metre off as given: it counts, and is told."""
    frame, book = find(ship(), base=-1.0, length=LPP, draught=DRAUGHT)
    assert frame.base == -1.0
    assert suspected(book) == {"base line"}


@pytest.mark.parametrize("power", [-4, 4])
def test_a_frame_scales_with_its_hull_to_the_bit(power: int) -> None:
    """At scales of a power of two every place is the same number times the scale."""
    mesh, by = moved(ship(), 12.0, -2.5), 2.0**power
    frame, _ = find(mesh, length=LPP, draught=DRAUGHT)
    other, _ = find(meshes.moved(mesh, lambda xyz: xyz * by), length=by * LPP, draught=by * DRAUGHT)
    for name in ("ap", "fp", "base", "draught", "breadth", "depth", "rake"):
        assert getattr(other, name) == by * getattr(frame, name)


def test_a_fin_amidships_is_no_bottom() -> None:
    """A fin keel between .3 and .7 of the waterline is told by its depth below the bottom."""
    mesh = ship()
    fin = np.array([[48.0, 0, 0], [56.0, 0, 0], [50.0, 0, -4.0], [54.0, 0, -4.0]])
    thick = fin + np.array([0.0, 0.1, 0.0])
    count = len(mesh.xyz)
    face = np.array([[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 4, 2], [2, 4, 6],
                     [1, 3, 5], [3, 7, 5], [2, 6, 3], [3, 6, 7]]) + count  # fmt: skip
    whole = Triangles(np.concatenate([mesh.xyz, fin, thick]), np.concatenate([mesh.face, face]))
    frame, book = find(whole, length=LPP, draught=DRAUGHT)
    assert frame.base == 0.0
    assert "a fin reaches 4 m below" in told(book, "below the base line")


def test_every_value_that_was_not_given_is_told() -> None:
    """Base line, draught, perpendiculars, length, breadth and depth, each once."""
    frame, book = find(ship())
    kinds = [note.kind for note in book.assumptions]
    wanted = {"base line", "draught", "forward perpendicular", "aft perpendicular", "length",
              "breadth", "depth"}  # fmt: skip
    assert wanted <= set(kinds)
    assert all(kinds.count(kind) == 1 for kind in wanted)
    assert set(frame.origins) >= {"base", "draught", "ap", "fp", "breadth", "depth"}
    said = attrs.asdict(FrameOptions(length=LPP, breadth=16, draught=6, depth=10, base=0, ap=0))
    _, book = find(ship(), **{name: value for name, value in said.items() if value is not None})
    assert {note.kind for note in book.assumptions} == {"origin"}
