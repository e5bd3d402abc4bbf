"""Digitised lines: what is read, mended and refused."""

import re

import numpy as np
import pytest

from assoc_hull.errors import BadInputError, WrongTypeError
from assoc_hull.io.digitised.read import read_lines
from assoc_hull.io.lines.slices import Gaps, HullSlices
from assoc_hull.io.slicing.mesh_lines import slice_mesh
from tests import meshes


def as_csv(slices: HullSlices, mark: str = ",") -> str:
    """The lines of a hull as text, one row per point."""
    rows = [mark.join(["line", "piece", "x", "y", "z"])]
    for line in (*slices.lines, *slices.boundaries):
        for number, piece in enumerate(line.pieces):
            rows += [
                mark.join([line.name, str(number), *(f"{v:.6f}" for v in point)])
                for point in piece.points.tolist()
            ]
    return "\n".join(rows) + "\n"


@pytest.mark.parametrize("mark", [",", ";", "\t"], ids=["comma", "semicolon", "tab"])
def test_a_mesh_and_its_digitised_lines_are_alike(mark: str) -> None:
    """Lines written as text come back as the slices they were: groups, places, ends, points."""
    cut = slice_mesh(meshes.wigley_half(41, 16), stations=3, waterlines=2, buttocks=1)
    back = read_lines(as_csv(cut, mark))
    assert [line.name for line in back.lines] == [line.name for line in cut.lines]
    for mine, other in zip(back.lines, cut.lines, strict=True):
        assert mine.group == other.group
        assert [piece.ends for piece in mine.pieces] == [piece.ends for piece in other.pieces]
        assert np.allclose(mine.pieces[0].points, other.pieces[0].points, atol=1e-6)


def test_pieces_are_joined_where_they_touch() -> None:
    """A blank row begins another piece; ends within 60 mm are joined, others stay apart."""
    parts = ["5,0,0|5,1,1", "5,3,4|5,1,1.04", "5,0,9|5,1,9"]
    rows = ["\n".join(f"ST 1,{point}" for point in part.split("|")) for part in parts]
    text = "line,x,y,z\n" + "\n\n".join(rows) + "\n"
    line = read_lines(text)["ST 1"]
    assert [piece.points[[0, -1], 2].tolist() for piece in line.pieces] == [[0.0, 4.0], [9.0, 9.0]]


@pytest.mark.parametrize(
    ("gap", "repairs", "suspicions"),
    [(0.03, ("join",), ()), (0.12, (), ("gap",)), (0.9, (), ())],
    ids=["closed", "told", "two pieces"],
)
def test_gaps_are_closed_or_told(
    gap: float, repairs: tuple[str, ...], suspicions: tuple[str, ...]
) -> None:
    """Within 60 mm pieces are joined, up to 200 mm they are named with what to give."""
    text = f"line,x,y,z\nST 1,5,0,0\nST 1,5,1,1\n\nST 1,5,1,{1.0 + gap}\nST 1,5,3,4\n"
    slices = read_lines(text)
    assert slices.report.kinds("repairs") == repairs
    assert slices.report.kinds("suspicions") == suspicions
    if suspicions:
        (note,) = slices.report.suspicions
        assert "end 120 mm apart at (5, 1, 1" in note.what
        told = re.search(r"give join= of ([\d.]+) m", note.what)
        assert told is not None
        closed = read_lines(text, gaps=Gaps(float(told.group(1)), 0.2))
        assert len(closed["ST 1"].pieces) == 1


def test_points_beside_their_plane_are_put_into_it() -> None:
    """Points up to 20 mm off the plane of their line are repaired, and told."""
    text = "line,x,y,z\nST 1,5,0,0\nST 1,5.004,1,1\nST 1,5,2,2\n"
    slices = read_lines(text)
    assert slices.report.kinds("repairs") == ("plane",)
    assert slices["ST 1"].pieces[0].points[:, 0].tolist() == [5.0, 5.0, 5.0]


def lines_of(order: list[int]) -> str:
    """Section 1 through a stern bulb, its 13 points in some order, beside a waterline."""
    angle = np.linspace(0.0, np.pi, 9)
    bulb = np.column_stack([1.5 * np.sin(angle), 2.0 - 2.0 * np.cos(angle)])
    neck = np.array([[0.4, 4.6], [1.2, 5.4], [3.0, 6.2], [6.0, 7.0]])
    points = np.concatenate([bulb, neck])[order]
    rows = [f"ST 1,5,{y:.6f},{z:.6f}" for y, z in points.tolist()]
    return "\n".join(["line,x,y,z", *rows, "WL 3,0,1,3", "WL 3,5,1.3,3", "WL 3,9,0,3", ""])


RIGHT = list(range(13))
SHUFFLED = np.random.default_rng(3).permutation(13).tolist()


@pytest.mark.parametrize(
    "order",
    [
        pytest.param([0, 1, 3, 2, *range(4, 13)], id="two exchanged"),
        pytest.param([*range(6, 13), *range(6)], id="two blocks exchanged"),
        pytest.param(SHUFFLED, id="shuffled"),
    ],
)
def test_points_out_of_order_are_put_in_order(order: list[int]) -> None:
    """The section is the one that was digitised, and the report says how many points moved."""
    given, mended = read_lines(lines_of(RIGHT)), read_lines(lines_of(order))
    assert given.report.kinds("repairs") == ()
    assert mended.report.kinds("repairs") == ("order",)
    assert "points put in order along the line" in mended.report.repairs[0].what
    assert np.allclose(mended["ST 1"].pieces[0].points, given["ST 1"].pieces[0].points)


def shuffled_wigley(jumble: float = 0.0) -> str:
    """Nine sections of Wigley's hull on both sides, their points shuffled, some written twice."""
    draw, rows = np.random.default_rng(5), ["line,x,y,z"]
    for x in np.linspace(10.0, 90.0, 9):
        z = np.linspace(0.0, 6.25, 21)
        y = meshes.wigley_y(np.full(21, x), z)
        points = np.column_stack([np.append(-y[:0:-1], y), np.append(z[:0:-1], z)])
        points = draw.permutation(np.concatenate([points, points[5:7]]))
        points += draw.uniform(-jumble, jumble, points.shape)
        rows += [f"ST {x:g},{x:g},{a:.4f},{b:.4f}" for a, b in points.tolist()]
    return "\n".join(rows) + "\n"


def test_shuffled_points_are_no_hulls_side_by_side() -> None:
    """Sections are put in order before hulls are counted and sides are parted."""
    lines = read_lines(shuffled_wigley())
    assert sum(note.kind == "order" for note in lines.report.repairs) == 9
    assert lines.report.kinds("suspicions") == ()
    for line in lines.lines:
        ((x, y, z),) = [piece.points.T for piece in line.pieces]
        assert len(z) == 21
        assert (np.diff(z) > 0.0).all()
        assert np.abs(y - meshes.wigley_y(x, z)).max() < 1e-4


def test_shuffled_points_without_one_order_are_refused_as_such() -> None:
    """Scattered as they are shuffled: the line, how often it turns back, and what to give."""
    with pytest.raises(BadInputError, match=r"points of ST \d+ are in no order: it turns back at"):
        read_lines(shuffled_wigley(0.8))


def test_a_line_without_one_plain_order_is_named() -> None:
    """A line that runs back over itself to begin a branch: the place, and what to give."""
    text = "line,x,y,z\n" + "".join(
        f"ST 1,5,{y},{z}\n" for y, z in ((0, 0), (1, 2), (1, 4), (1, 6), (1, 3.9), (3, 4), (5, 4))
    )
    report = read_lines(text).report
    assert report.kinds("suspicions") == ("order",)
    assert "turned back at (5, 1, 6) m" in report.suspicions[0].what
    assert "give the points in order" in report.suspicions[0].what


def test_noise_is_no_disorder() -> None:
    """Points 3 mm apart that scatter by 0.5 mm are left as they are."""
    y = np.linspace(0.0, 10.0, 5001)
    z = y + np.random.default_rng(1).normal(0.0, 5e-4, 5001)
    text = "line,x,y,z\n" + "".join(f"ST 1,5,{a:.6f},{b:.6f}\n" for a, b in zip(y, z, strict=True))
    assert read_lines(text).report.suspicions == ()


def test_a_digitised_line_that_crosses_itself_is_named() -> None:
    """A loop is told with its place."""
    points = ((0, 0), (4, 2), (4, 5), (2, 5), (3, 0))
    text = "line,x,y,z\n" + "".join(f"ST 1,5,{y},{z}\n" for y, z in points)
    (note,) = read_lines(text).report.suspicions
    assert note.kind == "self-crossing"
    assert "crosses itself 1 times" in note.what


@pytest.mark.parametrize("title", ["bossing end", "boundary: bossing end", "Skeg end"])
def test_lines_end_on_the_edge_in_which_a_part_ends(title: str) -> None:
    """It parts the profile, which then has no hole, and is no section though it lies across."""
    angle = np.linspace(-0.5 * np.pi, 0.5 * np.pi, 13)
    rows = [f"{title},6,{0.7 * np.cos(a):.5f},{5 + 0.7 * np.sin(a):.5f}" for a in angle]
    rows += [f"profile,{x},0,{z},{piece}" for x, z, piece in (
        (0, 9, 1), (4, 7, 1), (6, 5.7, 1), (6, 4.3, 2), (12, 2, 2), (30, 0, 2), (100, 0, 2),
    )]  # fmt: skip
    rows += [f"WL 5,{x},{y},5" for x, y in ((6, 0.7), (12, 1.4), (50, 8), (100, 0))]
    rows = [row if row.count(",") == 4 else f"{row},1" for row in rows]
    slices = read_lines("\n".join(["line,x,y,z,piece", *rows, ""]))
    name = title.removeprefix("boundary: ").lower()
    assert [line.name for line in slices.boundaries] == [name, "profile"]
    assert slices["WL 5"].pieces[0].ends == (name, "profile")
    assert slices.group("sections") == ()
    assert slices.report.suspicions == ()


def test_millimetres_and_starboard_are_seen() -> None:
    """Lines in millimetres, drawn to starboard, come as metres to port, and it is told."""
    text = "line,x,y,z\nWL 1,0,0,1000\nWL 1,50000,-4000,1000\nWL 1,99000,0,1000\n"
    slices = read_lines(text)
    assert slices["WL 1"].pieces[0].points[1].tolist() == [50.0, 4.0, 1.0]
    assert slices.report.kinds("repairs") == ("mirrored",)


def test_polylines_of_a_drawing_are_lines() -> None:
    """DXF: a POLYLINE and an LWPOLYLINE with its elevation, named by their layers."""
    poly = ["0", "POLYLINE", "8", "ST 2"]
    for y, z in ((0, 0), (2, 1), (3, 4)):
        poly += ["0", "VERTEX", "8", "ST 2", "10", "7", "20", str(y), "30", str(z)]
    light = ["0", "LWPOLYLINE", "8", "WL 1", "38", "1.0"]
    for x, y in ((0, 0), (7, 2), (9, 0)):
        light += ["10", str(x), "20", str(y)]
    rows = [
        "0",
        "SECTION",
        "2",
        "ENTITIES",
        *poly,
        "0",
        "SEQEND",
        *light,
        "0",
        "ENDSEC",
        "0",
        "EOF",
    ]
    slices = read_lines("\n".join(rows) + "\n")
    assert slices["ST 2"].pieces[0].points.tolist() == [[7, 0, 0], [7, 2, 1], [7, 3, 4]]
    assert slices["WL 1"].pieces[0].points.tolist() == [[0, 0, 1], [7, 2, 1], [9, 0, 1]]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        pytest.param("a,b\n1,2\n", "columns line, x, y, z", id="no columns"),
        pytest.param("line,x,y,z\n", "no points", id="no points"),
        pytest.param("line,x,y,z\nST 1,5,0,low\n", "row 2", id="no number"),
        pytest.param("line,x,y,z\nST 1,5,0\n", "row 2", id="short row"),
        pytest.param("line,x,y,z\nST 1,5,0,0\n", "one point", id="one point"),
        pytest.param("line,x,y,z\nST 1,5,0,0\nST 1,6,1,1\n", "no plane", id="no plane"),
        pytest.param(
            "line,x,y,z\nST 1,0,5,0\nST 1,1,5,1\nST 1,3,5,4\n", "on its side", id="on its side"
        ),
        pytest.param(
            "line,x,y,z\nWL 1,0,0,0.001\nWL 1,0.05,0.004,0.001\nWL 1,0.099,0,0.001\n",
            r"only 0\.099 m long.*unit='m'",
            id="too small",
        ),
        pytest.param("line,x,y,z\na,5,0,0\na,6,1,1\n", "begin its name", id="unknown family"),
        pytest.param(
            "line,x,y,z\nST 1,5,0,0\nST 1,5,1,1\nST 2,5,0,0\nST 2,5,1,1\n", "one plane", id="twins"
        ),
    ],
)
def test_what_cannot_be_read_is_named(text: str, words: str) -> None:
    """Each text that holds no lines is refused, with the row and what to do."""
    with pytest.raises(BadInputError, match=words):
        read_lines(text)


HALF = [(0.0, 0.0), (2.0, 0.5), (3.5, 2.0), (4.0, 4.0), (4.2, 6.0)]
PORT = [f"ST 5,5,{y},{z}" for y, z in HALF]
STARBOARD = [f"ST 5,5,{-y},{z}" for y, z in HALF]
FLAT = [f"ST 5,5,{side * y},{z}" for side in (1, -1) for y, z in HALF[1:]]


@pytest.mark.parametrize(
    "rows",
    [
        pytest.param([*PORT[::-1], *STARBOARD[1:]], id="one polyline"),
        pytest.param([*PORT, "", *STARBOARD], id="two pieces"),
        pytest.param([*STARBOARD, "", *PORT], id="starboard first"),
        pytest.param([*PORT, *STARBOARD], id="one after the other"),
        pytest.param([*PORT[::-1], *STARBOARD[::-1]], id="from the deck, twice"),
    ],
)
def test_of_lines_on_both_sides_one_is_kept(rows: list[str]) -> None:
    """However both sides are drawn, the section is its port half, and it is told."""
    slices = read_lines("line,x,y,z\n" + "\n".join(rows) + "\n")
    (piece,) = slices["ST 5"].pieces
    assert [(y, z) for _, y, z in piece.points.tolist()] == HALF
    assert slices.report.kinds("repairs") == ("both sides",)
    assert slices.report.suspicions == ()


def test_sides_without_a_point_at_the_centre_are_parted() -> None:
    """Port and then starboard from the bilge: no chord from deck to bilge is drawn."""
    (piece,) = read_lines("line,x,y,z\n" + "\n".join(FLAT) + "\n")["ST 5"].pieces
    assert [(y, z) for _, y, z in piece.points.tolist()] == HALF[1:]


def test_a_line_across_the_centre_plane_is_cut_where_it_crosses() -> None:
    """Without a point in the centre plane, the place where the polyline passes it ends the half."""
    rows = [*PORT[:0:-1], *STARBOARD[1:]]
    (piece,) = read_lines("line,x,y,z\n" + "\n".join(rows) + "\n")["ST 5"].pieces
    assert piece.points[0].tolist() == [5.0, 0.0, 0.5]
    assert piece.ends[0] == "profile"


def test_sides_that_differ_are_told() -> None:
    """A starboard side 40 mm off the port one is left out, with the difference."""
    other = [f"ST 5,5,{-y - 0.04 * (y > 0)},{z}" for y, z in HALF]
    report = read_lines("line,x,y,z\n" + "\n".join([*PORT[::-1], *other[1:]]) + "\n").report
    (note,) = report.suspicions
    assert (note.kind, note.what) == (
        "both sides",
        "its sides differ by up to 40 mm; one is left out",
    )


def test_pieces_of_both_sides_that_are_no_images_stay() -> None:
    """A lower piece to port and an upper one to starboard are both wanted."""
    slices = read_lines("line,x,y,z\n" + "\n".join([*PORT[:3], "", *STARBOARD[2:]]) + "\n")
    assert [len(piece.points) for piece in slices["ST 5"].pieces] == [5]
    assert "mirrored" in slices.report.kinds("repairs")


def drawing(*entities: str) -> str:
    """A DXF with some entities, each written as codes and values parted by blanks."""
    words = " ".join(["0 SECTION 2 ENTITIES", *entities, "0 ENDSEC 0 EOF"]).split()
    return "\n".join(word.replace("_", " ") for word in words) + "\n"


SECTION = "0 POLYLINE 8 ST_2 70 {} " + " ".join(
    f"0 VERTEX 8 ST_2 10 7 20 {y} 30 {z}" for y, z in ((0, 0), (2, 1), (3, 4), (0, 5))
)


@pytest.mark.parametrize(
    "entity",
    [
        pytest.param(SECTION.format(1), id="POLYLINE"),
        pytest.param(
            "0 LWPOLYLINE 8 WL_1 38 1 70 1 10 0 20 0 10 7 20 2 10 9 20 1", id="LWPOLYLINE"
        ),
    ],
)
def test_a_closed_polyline_of_a_drawing_has_its_last_side(entity: str) -> None:
    """The closed flag leads the polyline back to its first point."""
    (line,) = read_lines(drawing(entity)).lines
    points = line.pieces[0].points
    assert np.linalg.norm(points[0] - points[-1]) == 0.0


@pytest.mark.parametrize(
    ("entity", "kind", "words"),
    [
        ("0 SPLINE 8 ST_3 11 8 21 0 31 0", "fit points", "SPLINE has no control points"),
        ("0 ARC 8 ST_3 10 8 20 0 40 2", "curve", "ARC is no polyline and left out"),
        ("0 LWPOLYLINE 8 WL_1 38 1 10 0 20 0 42 1.0 10 9 20 2", "bulge", "arcs between its points"),
        ("0 LWPOLYLINE 8 WL_1 38 1 220 1 230 0 10 0 20 0 10 9 20 2", "extrusion", "of its own"),
        ("0 POLYLINE 8 M 70 16 0 VERTEX 10 1 20 1 0 VERTEX 10 2 20 2", "mesh", "left out"),
    ],
)  # fmt: skip
def test_what_a_drawing_holds_beside_polylines_is_told(entity: str, kind: str, words: str) -> None:
    """Curves, bulges and turned coordinates: how many, where the first is, and what to do."""
    (note,) = read_lines(drawing(SECTION.format(0), entity)).report.suspicions
    assert (note.kind, note.amount) == (kind, 1)
    assert words in note.what
    assert "the first at line " in note.what
    assert "explode it to polylines" in note.what


def test_control_points_of_a_fitted_polyline_are_no_points_of_it() -> None:
    """Of a spline-fitted POLYLINE the drawn vertices are read, not its frame."""
    frame = "0 VERTEX 8 ST_2 70 16 10 7 20 9 30 9"
    points = read_lines(drawing(f"{SECTION.format(4)} {frame}"))["ST 2"].pieces[0].points
    assert len(points) == 4


@pytest.mark.parametrize(
    ("text", "words"),
    [
        pytest.param(
            drawing("0 LWPOLYLINE 8 ST_1 20 1 10 1"), "20 before its first 10", id="order"
        ),
        pytest.param(
            drawing("0 SPLINE 8 ST_1"), "no points; SPLINE has no control points", id="curves"
        ),
        pytest.param(drawing("--5 x"), "'--5' is no group code", id="two signs"),
        pytest.param(drawing("\u00b2 x"), "is no group code, line 5", id="superscript"),
        pytest.param(drawing("0 LINE 8 ST_1 10 low"), "'low' is no number, line 9", id="number"),
        pytest.param(
            f"line,x,y,z\nST 1,5,0,0\nST 1,5,{'1' * 200000},1\n", "row 3 of text", id="long cell"
        ),
    ],
)
def test_broken_texts_are_named(text: str, words: str) -> None:
    """What is no DXF or no CSV: the line, and what is wrong there."""
    with pytest.raises(BadInputError, match=words):
        read_lines(text)


@pytest.mark.parametrize(("unit", "metre"), [("ft", 0.3048), ("in", 0.0254), ("cm", 0.01)])
def test_units_other_than_metres_can_be_given(unit: str, metre: float) -> None:
    """Places come in metres."""
    text = "line,x,y,z\nWL 1,0,0,100\nWL 1,500,40,100\nWL 1,990,0,100\n"
    (piece,) = read_lines(text, unit=unit)["WL 1"].pieces
    assert piece.points[1].tolist() == pytest.approx([500 * metre, 40 * metre, 100 * metre])


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"unit": "normalised"}, "'normalised' is unknown for digitised lines.*'ft' or 'in'"),
        ({"unit": ["m"]}, "is unknown"),
        ({"scale": "big"}, "scale is 'big'"),
        ({"scale": 0}, "scale is 0"),
    ],
)
def test_units_and_scales_that_are_none_are_named(options: dict[str, object], words: str) -> None:
    """The argument, and what it may be."""
    with pytest.raises(BadInputError, match=words):
        read_lines("line,x,y,z\n" + "\n".join(PORT) + "\n", **options)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("x", "words"),
    [("1e308", "'1e308' is too large.*row 7"), ("9e6", r"x = 9e\+06 in WL 1 \(from row 7 of text")],
)
def test_a_coordinate_beyond_any_ship_is_named(x: str, words: str) -> None:
    """The number and where it stands, not the length of the ship alone."""
    text = "line,x,y,z\n" + "\n".join([*PORT, f"WL 1,{x},0,1", "WL 1,5,2.5,1"]) + "\n"
    with pytest.raises(BadInputError, match=words):
        read_lines(text)


@pytest.mark.parametrize("value", [3, None, b"line,x,y,z\n", ["a.csv"]])
def test_what_is_neither_path_nor_text_is_named(value: object) -> None:
    """The wrong type is told as such."""
    with pytest.raises(WrongTypeError, match="give the name of a file"):
        read_lines(value)  # type: ignore[arg-type]
