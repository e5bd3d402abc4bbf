"""Cutting a triangulated hull into lines: what is found, mended and refused."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from assoc_hull.errors import BadInputError, MissingExtraError, NoMeetingError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.surfaces.triangles import Triangles
from assoc_hull.io.lines.slices import HullSlices
from assoc_hull.io.mesh import read as mesh_read
from assoc_hull.io.placing.options import FrameOptions
from assoc_hull.io.slicing.mesh_lines import read_mesh, slice_mesh
from tests import meshes

CUTS: dict[str, Any] = {"stations": [25.0, 50.0, 75.0], "waterlines": [2.0, 4.0], "buttocks": [2.0]}


def facet_error(nx: int = 81, nz: int = 31) -> float:
    """How far the facets of the Wigley mesh may lie off the hull: steps h, h H h / 8, m."""
    along, down = 100.0 / (nx - 1), 6.25 / (nz - 1)
    return (4e-3 * along**2 + 0.256 * down**2 + 2.0 * 0.064 * along * down) / 8.0


def check_wigley(slices: HullSlices) -> None:
    """All lines lie on the formula within what the facets allow."""
    for line in slices.lines:
        for piece in line.pieces:
            x, y, z = piece.points.T
            off = np.abs(y - meshes.wigley_y(x, z))
            assert off.max() <= facet_error()


@pytest.mark.parametrize("name", ["h.stl", "h.obj", "h.ply", "h.stl.gz", "h.ply.gz"])
def test_every_form_gives_the_same_lines(tmp_path: Path, name: str) -> None:
    """STL, OBJ and PLY, packed or not, give lines on the hull, in its ends, in order."""
    slices = read_mesh(meshes.write(meshes.closed_wigley(), tmp_path / name), **CUTS)
    assert [line.name for line in slices.lines] == [
        "ST 25", "ST 50", "ST 75", "WL 2", "WL 4", "BTK 2",
    ]  # fmt: skip
    assert {piece.ends for line in slices.group("sections") for piece in line.pieces} == {
        ("profile", "deck edge")
    }
    assert slices["WL 2"].pieces[0].ends == ("profile", "profile")
    assert (np.diff(slices["WL 2"].pieces[0].points[:, 0]) > 0.0).all()
    check_wigley(slices)


def test_boundary_curves_are_found() -> None:
    """Profile and deck edge are one chain each, from aft forward, where the hull ends."""
    slices = slice_mesh(meshes.closed_wigley(), **CUTS)
    profile, deck = slices.boundary("profile"), slices.boundary("deck edge")
    assert profile is not None
    assert deck is not None
    assert len(profile.pieces) == len(deck.pieces) == 1
    assert np.allclose(profile.pieces[0].points[[0, -1]], [[0, 0, 6.25], [100, 0, 6.25]])
    assert np.allclose(deck.pieces[0].points[:, 2], 6.25)
    assert slices.boundary("transom") is None


def turned(mesh: Triangles, matrix: list[list[int]]) -> Triangles:
    """A mesh in other axes; a reflection leaves its triangles inside out."""
    return meshes.moved(mesh, lambda xyz: xyz @ np.array(matrix, np.float64).T)


def shifted(mesh: Triangles, x: float, y: float, z: float) -> Triangles:
    """A mesh with another origin."""
    return meshes.moved(mesh, lambda xyz: xyz + np.array([x, y, z]))


def scrambled(mesh: Triangles) -> Triangles:
    """A third of the triangles turned round."""
    face = mesh.face.copy()
    face[::3] = face[::3, ::-1]
    return Triangles(mesh.xyz, face)


def copied(mesh: Triangles, away: FloatArray, *, turn: bool = False) -> Triangles:
    """A mesh and its copy some way off, its triangles turned round if asked."""
    face = mesh.face[:, ::-1] if turn else mesh.face
    return Triangles(
        np.concatenate([mesh.xyz, mesh.xyz + away]),
        np.concatenate([mesh.face, face + len(mesh.xyz)]),
    )


ON_ITS_SIDE, KEEL_UP = [[1, 0, 0], [0, 0, -1], [0, 1, 0]], [[1, 0, 0], [0, -1, 0], [0, 0, -1]]
OTHER_SIDE = [[1, 0, 0], [0, 0, 1], [0, -1, 0]]
WRONG: list[Any] = [
    pytest.param(lambda m: turned(m, ON_ITS_SIDE), ["axes"], id="on its side"),
    pytest.param(lambda m: turned(m, OTHER_SIDE), ["axes"], id="on its other side"),
    pytest.param(lambda m: turned(m, [[0, 0, 1], [1, 0, 0], [0, 1, 0]]), ["axes"],
                 id="rolled axes"),
    pytest.param(lambda m: turned(m, [[0, 0, -1], [0, 1, 0], [1, 0, 0]]), ["axes"],
                 id="on its stern"),
    pytest.param(lambda m: turned(m, KEEL_UP), ["upside down"], id="keel up"),
    pytest.param(lambda m: Triangles(m.xyz, m.face[:, ::-1].copy()), ["inside-out"],
                 id="inside out"),
    pytest.param(scrambled, ["winding"], id="mixed winding"),
    pytest.param(lambda m: copied(m, np.zeros(3)), ["duplicate"], id="twice"),
    pytest.param(lambda m: copied(m, np.zeros(3), turn=True), ["duplicate"], id="two-sided"),
    pytest.param(lambda m: copied(m, np.full(3, 1e-7)), ["duplicate"], id="twice but for rounding"),
    pytest.param(lambda m: shifted(m, 0.0, 3.0, 0.0), ["centre plane"], id="off centre"),
    pytest.param(lambda m: shifted(m, -50.0, 0.0, -6.25), ["origin"],
                 id="origin amidships at the waterline"),
]  # fmt: skip
HALF_OR_WHOLE = pytest.mark.parametrize(
    "hull", [pytest.param(meshes.wigley_half, id="half"),
             pytest.param(meshes.closed_wigley, id="whole")]
)  # fmt: skip


@HALF_OR_WHOLE
def test_a_mesh_in_order_is_left_as_it_is(hull: Callable[[], Triangles]) -> None:
    """Nothing is mended or suspected; what was assumed is told."""
    report = slice_mesh(hull(), **CUTS, frame=FrameOptions(length=100.0)).report
    assert report.kinds("repairs") == report.kinds("suspicions") == ()
    assert {"unit", "axes", "bow", "origin", "half or whole"} <= set(report.kinds("assumptions"))


@HALF_OR_WHOLE
@pytest.mark.parametrize(("spoil", "kinds"), WRONG)
def test_a_mesh_that_is_out_of_order_is_mended_and_reported(
    spoil: Callable[[Triangles], Triangles], kinds: list[str], hull: Callable[[], Triangles]
) -> None:
    """Whatever was done to the mesh is undone and named, and the lines are the hull's."""
    slices = slice_mesh(spoil(hull()), **CUTS, frame=FrameOptions(length=100.0))
    assert set(kinds) <= set(slices.report.kinds("repairs"))
    assert slices.report.kinds("suspicions") == ()
    check_wigley(slices)


def test_a_mirrored_whole_hull_is_inside_out() -> None:
    """Mirroring exchanges the sides, which are alike, and turns the triangles inward."""
    mesh = turned(meshes.closed_wigley(), [[1, 0, 0], [0, -1, 0], [0, 0, 1]])
    slices = slice_mesh(mesh, **CUTS)
    assert slices.report.kinds("repairs") == ("inside-out",)
    check_wigley(slices)


def test_a_starboard_half_is_mirrored() -> None:
    """Half a hull at negative y gives the lines to port, and says so."""
    half = meshes.moved(meshes.wigley_half(), lambda xyz: xyz * [1.0, -1.0, 1.0])
    slices = slice_mesh(half, **CUTS)
    assert slices.report.kinds("repairs") == ("inside-out", "mirrored")
    check_wigley(slices)


def test_an_open_mesh_is_told() -> None:
    """A hull without deck is read; how many edges are open, and where, is said."""
    notes = slice_mesh(meshes.wigley_half(), **CUTS).report.assumptions
    (note,) = (each for each in notes if each.kind == "open")
    assert "220 edges have one triangle only, from (0, 0, 0) to (100, 5, 6.25)" in note.what


def test_parts_that_touch_nowhere_are_told() -> None:
    """A second hull above the first is cut too, so it is named, with its extent."""
    two = copied(meshes.closed_wigley(), np.array([0.0, 0.0, 8.0]))
    report = slice_mesh(two, **CUTS).report
    (note,) = (each for each in report.suspicions if each.kind == "parts")
    assert "2 parts" in note.what
    assert "from (0, -5, 8) to (100, 5, 14.25)" in note.what


def test_triangles_on_triangles_are_refused() -> None:
    """A second deck on the first, of other triangles, leaves no one surface: what to leave out."""
    mesh = meshes.wigley_half(41, 16)
    face = np.concatenate([mesh.face, mesh.face[:, [0, 1, 2]], np.roll(mesh.face, 5, axis=0)])
    face[len(mesh.face) :, 2] = np.roll(face[len(mesh.face) :, 2], 7)
    with pytest.raises(BadInputError, match=r"three triangles or more.*leave out"):
        slice_mesh(Triangles(mesh.xyz, face), **CUTS)


def pointed(xyz: FloatArray) -> FloatArray:
    """Draw the bow in, so that the ends differ."""
    return np.asarray(xyz * np.column_stack([
        np.ones(len(xyz)), np.clip(1.05 - xyz[:, 0] / 100.0, 0.0, 1.0), np.ones(len(xyz))
    ]))  # fmt: skip


@HALF_OR_WHOLE
def test_a_bow_at_negative_x_is_turned_forward(hull: Callable[[], Triangles]) -> None:
    """The finer end at the deck is the bow; turned round it gives the same lines."""
    mesh = meshes.moved(hull(), pointed)
    there = slice_mesh(mesh, **CUTS)
    back = slice_mesh(turned(mesh, [[-1, 0, 0], [0, -1, 0], [0, 0, 1]]), **CUTS)
    assert "bow at negative x" in back.report.kinds("repairs")
    assert "bow at negative x" not in there.report.kinds("repairs")
    for line in there.lines:
        for mine, other in zip(back[line.name].pieces, line.pieces, strict=True):
            assert np.allclose(mine.points[[0, -1]], other.points[[0, -1]], atol=1e-9)


def test_given_axes_are_taken() -> None:
    """Axes that are given are not guessed at."""
    mesh = turned(meshes.closed_wigley(), [[1, 0, 0], [0, 0, -1], [0, 1, 0]])
    check_wigley(slice_mesh(mesh, axes="+x+z-y", **CUTS))


def test_millimetres_are_seen() -> None:
    """A hull of 100,000 units is one of 100 m in millimetres."""
    mesh = meshes.moved(meshes.closed_wigley(), lambda xyz: 1e3 * xyz)
    slices = slice_mesh(mesh, **CUTS)
    assert "unit" in slices.report.kinds("assumptions")
    check_wigley(slices)


def test_millimetres_read_as_metres_are_refused() -> None:
    """Told metres, a hull of 100,000 units is refused with the unit to give."""
    mesh = meshes.moved(meshes.closed_wigley(), lambda xyz: 1e3 * xyz)
    with pytest.raises(BadInputError, match="unit='mm'"):
        slice_mesh(mesh, unit="m", **CUTS)


@pytest.mark.parametrize(("unit", "metres"), [("cm", 0.01), ("ft", 0.3048), ("in", 0.0254)])
def test_other_units_are_taken_where_given(unit: str, metres: float) -> None:
    """Centimetres, feet and inches are not guessed at, but read."""
    mesh = meshes.moved(meshes.closed_wigley(), lambda xyz: xyz / metres)
    check_wigley(slice_mesh(mesh, unit=unit, **CUTS))


@pytest.mark.parametrize(
    ("unit", "factor"), [("mm", 1.0), ("auto", 1e-3)], ids=["told so", "exported so"]
)
def test_metres_read_as_millimetres_are_refused(unit: str, factor: float) -> None:
    """A ship of 100 mm is refused with what to give."""
    mesh = meshes.moved(meshes.closed_wigley(), lambda xyz: factor * xyz)
    with pytest.raises(BadInputError, match=r"only 0\.1 m long.*give unit='m', or the scale"):
        slice_mesh(mesh, unit=unit, **CUTS)


def test_units_that_differ_between_axes_are_seen() -> None:
    """Length in metres, breadth and depth in decimetres: proportions that no ship has."""
    mesh = meshes.moved(meshes.closed_wigley(), lambda xyz: xyz * [1.0, 10.0, 10.0])
    report = slice_mesh(mesh, stations=3, waterlines=2, buttocks=0).report
    (note,) = (each for each in report.suspicions if each.kind == "proportions")
    assert "L/B is 1, L/D is 1.6" in note.what


def test_a_model_is_scaled() -> None:
    """A model at 1:40 gives the ship at full scale."""
    mesh = meshes.moved(meshes.closed_wigley(), lambda xyz: xyz / 40.0)
    check_wigley(slice_mesh(mesh, scale=40.0, **CUTS))


def test_a_plane_that_misses_is_named() -> None:
    """A station ahead of the hull is an error with the range to stay in."""
    with pytest.raises(NoMeetingError, match=r"stations at 120 m.*between 0 and 100"):
        slice_mesh(meshes.closed_wigley(), stations=[50.0, 120.0])


@pytest.mark.parametrize(
    ("family", "place"), [("stations", -0.5), ("waterlines", 6.25), ("buttocks", 5.2)]
)
def test_every_family_names_the_plane_that_misses(family: str, place: float) -> None:
    """Before the hull, at the deck, and beside it."""
    with pytest.raises(NoMeetingError, match=f"the plane of {family} at {place:g} m"):
        slice_mesh(meshes.closed_wigley(), **{**CUTS, family: [place]})


def torn(mesh: Triangles, gap: float) -> Triangles:
    """The hull in two parts, a slot between z = 3.1 and z = 3.1 + gap."""
    centre = mesh.corners.mean(axis=1)[:, 2]
    upper = mesh.xyz + np.array([0.0, 0.0, gap])
    face = np.where((centre > 3.1)[:, None], mesh.face + len(mesh.xyz), mesh.face)
    used, number = np.unique(face, return_inverse=True)
    return Triangles(np.concatenate([mesh.xyz, upper])[used], number.reshape(-1, 3))


def test_small_gaps_are_joined_and_tabled() -> None:
    """Sections over a slot of 30 mm are one piece each, every join with place and width."""
    slices = slice_mesh(torn(meshes.wigley_half(), 0.03), **CUTS)
    assert [len(line.pieces) for line in slices.group("sections")] == [1, 1, 1]
    mine = [join for join in slices.joins if join.line == "ST 50"]
    assert len(mine) == 1
    assert mine[0].gap == pytest.approx(0.03, abs=1e-3)
    assert "join" in slices.report.kinds("repairs")


def test_a_wide_gap_is_refused_with_its_place() -> None:
    """Over a slot of 150 mm the pieces do not chain: the error tells where and how wide."""
    with pytest.raises(BadInputError, match=r"do not chain.*150 mm apart.*ST 25"):
        slice_mesh(torn(meshes.wigley_half(), 0.15), **CUTS)


def test_a_plane_through_a_gap_is_named() -> None:
    """A waterline within the extent of the hull that meets no triangle."""
    with pytest.raises(BadInputError, match=r"WL 3\.6 cuts no triangle.*mend the gap"):
        slice_mesh(torn(meshes.wigley_half(), 1.0), stations=0, waterlines=[3.6], buttocks=0)


@pytest.mark.parametrize("nx", [81, 21], ids=["fine", "coarse"])
def test_a_hole_is_seen(nx: int) -> None:
    """A missing bottom is reported, with the lowest place of its edge and the loose ends."""
    mesh = meshes.wigley_half(nx)
    mesh = Triangles(mesh.xyz, mesh.face[mesh.corners.mean(axis=1)[:, 2] > 0.9])
    slices = slice_mesh(mesh, axes="+x+y+z", **CUTS)
    assert {"hole", "loose end"} <= set(slices.report.kinds())


def test_a_line_that_crosses_itself_is_seen() -> None:
    """A fold that passes through the side is reported with its place."""

    def fold(xyz: FloatArray) -> FloatArray:
        out = xyz.copy()
        z = xyz[:, 2]
        out[:, 2] += np.where(np.abs(z - 3.0) < 1.0, 2.5 * np.sin(np.pi * (z - 3.0)), 0.0)
        out[:, 1] += np.where(np.abs(z - 3.0) < 1.0, np.sin(2.0 * np.pi * z + 1.0), 0.0) * (
            xyz[:, 1] > 0
        )
        return out

    slices = slice_mesh(
        meshes.moved(meshes.wigley_half(), fold), axes="+x+y+z",
        stations=[50.0], waterlines=0, buttocks=0,
    )  # fmt: skip
    assert "self-crossing" in slices.report.kinds()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        pytest.param({"scale": 0.0}, "above 0", id="no scale"),
        pytest.param({"unit": "yd"}, "one of", id="unknown unit"),
        pytest.param({"axes": "xyz"}, "such as", id="unknown axes"),
        pytest.param({"stations": -1}, "0 to", id="less than none"),
        pytest.param({"stations": [5.0, 5.0]}, "each place once", id="one place twice"),
        pytest.param({"stations": "many"}, "number of planes", id="words"),
    ],
)
def test_bad_arguments_say_what_to_give(arguments: dict[str, Any], words: str) -> None:
    """Each argument that cannot be used is named with what to give."""
    with pytest.raises(BadInputError, match=words):
        slice_mesh(meshes.wigley_half(), **arguments)


def test_a_file_without_triangles_is_refused(tmp_path: Path) -> None:
    """Text that is no mesh, an empty mesh and a cut-off gzip file are errors of the family."""
    (tmp_path / "a.stl").write_text("no mesh")
    (tmp_path / "b.obj").write_text("v 0 0 0\n")
    (tmp_path / "c.stl.gz").write_bytes(b"\x1f\x8b\x08broken")
    (tmp_path / "d.step").write_text("ISO")
    for name in ("a.stl", "b.obj", "c.stl.gz", "d.step", "missing.stl"):
        with pytest.raises(BadInputError):
            read_mesh(tmp_path / name)


def test_without_trimesh_the_extra_is_named(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Where trimesh is missing the error says which extra to install."""
    path = meshes.write(meshes.wigley_half(5, 5), tmp_path / "h.stl")
    monkeypatch.setattr(mesh_read, "find_spec", lambda name: None)
    with pytest.raises(MissingExtraError, match=r"assoc-hull\[mesh\]"):
        read_mesh(path)


def test_dtc_is_cut_into_its_lines(data_folder: Path) -> None:
    """DTC: 41 stations, 20 waterlines and 12 buttocks, no loose end, deck and transom found."""
    slices = read_mesh(data_folder / "dtc" / "DTC-scaled.stl.gz", scale=59.407)
    assert [len(slices.group(name)) for name in ("sections", "waterlines", "buttocks")] == [
        41, 20, 12,
    ]  # fmt: skip
    assert slices.report.suspicions == ()
    deck, transom = slices.boundary("deck edge"), slices.boundary("transom")
    assert deck is not None
    assert transom is not None
    assert np.ptp(deck.pieces[0].points[:, 2]) < 1e-3
    assert np.ptp(transom.pieces[0].points[:, 0]) < 1e-3
    assert sum(len(line.pieces) for line in slices.lines) == 78
