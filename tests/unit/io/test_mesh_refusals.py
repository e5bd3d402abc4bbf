"""What cannot be cut is named: meshes, files, gaps and places that are none."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import assoc_hull
from assoc_hull.errors import BadInputError, NoMeetingError
from assoc_hull.geometry.surfaces.triangles import Triangles
from assoc_hull.io.lines.slices import Gaps
from assoc_hull.io.slicing.mesh_lines import read_mesh, slice_mesh
from tests import meshes

FEW: dict[str, Any] = {"stations": 3, "waterlines": 2, "buttocks": 1}


def small() -> Triangles:
    """Half a hull of few triangles."""
    return meshes.wigley_half(21, 9)


@pytest.mark.parametrize(
    ("widths", "words"),
    [
        ((np.nan, 1.0), "join is nan"),
        ((-1.0, 0.0), "join is -1.0"),
        (("a", 1.0), "join is 'a'"),
        ((0.1, np.inf), "refuse is inf"),
        ((1.0, 0.5), "refuse is 0.5, less than join, 1.0"),
    ],
)
def test_gaps_that_are_none_are_refused(widths: tuple[Any, Any], words: str) -> None:
    """A width is a number of 0 or more, and the one refused is at least the one joined."""
    with pytest.raises(BadInputError, match=words):
        Gaps(*widths)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"gaps": "0.06"}, "give a Gaps"),
        ({"scale": "big"}, "scale is 'big'"),
        ({"scale": True}, "scale is True"),
        ({"unit": 3}, "unit is 3"),
        ({"axes": 3}, "axes is 3"),
    ],
)
def test_an_argument_of_another_type_is_named(arguments: dict[str, Any], words: str) -> None:
    """Whatever cannot be taken is refused by its name, not in the middle of a sum."""
    with pytest.raises(BadInputError, match=words):
        slice_mesh(small(), **arguments)


@pytest.mark.parametrize("option", [{"scale": [2]}, {"axes": 3}, {"unit": ["m"]}])
def test_read_names_an_option_of_another_type(option: dict[str, Any], tmp_path: Path) -> None:
    """The way through `read` names it too."""
    path = meshes.write(small(), tmp_path / "h.stl")
    with pytest.raises(BadInputError, match=next(iter(option))):
        assoc_hull.read(path, **option)


def test_triangles_that_are_none_are_named() -> None:
    """No triangle, one of a vertex that is not there, and a vertex that is not finite."""
    mesh = small()
    with pytest.raises(BadInputError, match="no triangles"):
        slice_mesh(Triangles(np.zeros((0, 3)), np.zeros((0, 3), np.int64)))
    face = mesh.face.copy()
    face[7, 1] = 9999
    with pytest.raises(BadInputError, match=r"triangle 7 has the vertices .*9999"):
        slice_mesh(Triangles(mesh.xyz, face))
    xyz = mesh.xyz.copy()
    xyz[50, 1] = np.nan
    with pytest.raises(BadInputError, match=r"vertex 50 is not finite: \(.*nan"):
        slice_mesh(Triangles(xyz, mesh.face))
    with pytest.raises(BadInputError, match="give a Triangles"):
        slice_mesh("hull.stl")  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("name", "before", "after"),
    [
        ("h.obj", b"", b"# Gr\xf6\xdfe\n"),
        ("h.stl", b"solid", b"solid Gr\xf6\xdfe"),
        ("h.ply", b"format ascii 1.0\n", b"format ascii 1.0\ncomment Gr\xf6\xdfe\n"),
    ],
)
def test_comments_in_latin_1_do_no_harm(
    name: str, before: bytes, after: bytes, tmp_path: Path
) -> None:
    """A comment or name in another encoding than UTF-8 leaves the mesh as it is."""
    import trimesh

    plain = trimesh.Trimesh(small().xyz, small().face, process=False)
    form = {"h.obj": "obj", "h.stl": "stl_ascii", "h.ply": "ply"}[name]
    more = {"encoding": "ascii"} if form == "ply" else {}
    data = plain.export(file_type=form, **more)
    raw = data.encode() if isinstance(data, str) else bytes(data)
    (tmp_path / f"plain-{name}").write_bytes(raw)
    (tmp_path / name).write_bytes(raw.replace(before, after, 1))
    there, here = (read_mesh(tmp_path / each, **FEW) for each in (f"plain-{name}", name))
    assert np.array_equal(there["ST 50"].pieces[0].points, here["ST 50"].pieces[0].points)


@pytest.mark.parametrize("part", [0.0, 0.001, 0.5, 0.99])
def test_a_text_stl_that_is_cut_short_is_called_so(part: float, tmp_path: Path) -> None:
    """Whatever part of it is there, the error is about the file, not about curves."""
    import trimesh

    mesh = small()
    text = str(trimesh.Trimesh(mesh.xyz, mesh.face, process=False).export(file_type="stl_ascii"))
    (tmp_path / "h.stl").write_text(text[: int(part * len(text))])
    with pytest.raises(BadInputError, match="whole"):
        read_mesh(tmp_path / "h.stl")


def test_garbage_is_no_stl(tmp_path: Path) -> None:
    """Text that is no mesh is called no STL."""
    (tmp_path / "h.stl").write_text("no mesh at all")
    with pytest.raises(BadInputError, match="no STL"):
        read_mesh(tmp_path / "h.stl")


@pytest.mark.parametrize(
    "wanted", [True, "7", 7.0, 7.5, np.float64(7.0), ["7"], [True, 20.0], None, {7.0: 1}],
    ids=repr,
)  # fmt: skip
def test_what_is_neither_count_nor_list_of_places_is_refused(wanted: Any) -> None:
    """A truth value, text or a lone number with a point may mean either; both are shown."""
    with pytest.raises(BadInputError, match=r"stations=.*such as 7, or a list.*\[7\.0\]"):
        slice_mesh(small(), stations=wanted)


@pytest.mark.parametrize("wanted", [7, np.int64(7)])
def test_a_whole_number_is_a_count(wanted: Any) -> None:
    """Also one of numpy."""
    slices = slice_mesh(small(), stations=wanted, waterlines=0, buttocks=0)
    assert len(slices.group("sections")) == 7


def test_a_plane_at_the_end_touches_only() -> None:
    """It does not miss the hull; it meets no more than its end."""
    with pytest.raises(NoMeetingError, match="at 0 m only touches what it was to cut"):
        slice_mesh(small(), stations=[0.0, 50.0])


def test_places_less_than_a_millimetre_apart_are_one() -> None:
    """Both would have one name, so both are told; 1 mm and more is two lines."""
    with pytest.raises(BadInputError, match=r"10 m and 10\.000002 m, less than 1 mm apart"):
        slice_mesh(small(), stations=[10.0, 10.000002])
    slices = slice_mesh(small(), stations=[10.0, 10.002], waterlines=0, buttocks=0)
    assert [line.name for line in slices.lines] == ["ST 10", "ST 10.002"]
