"""Files of closed meshes: what trimesh finds in them, and what is refused."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.errors import BadInputError, MissingExtraError, OpenMeshError, WrongTypeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.mesh.closed_mesh import write_mesh
from assoc_hull.surface.cells.closed_mesh import ClosedMesh, closed_mesh

trimesh: Any = pytest.importorskip("trimesh")

FORMS = ("stl", "stl-text", "obj", "ply", "glb")
ENDINGS = {"stl": ".stl", "stl-text": ".stl", "obj": ".obj", "ply": ".ply", "glb": ".glb"}
SINGLE = ("stl", "glb")


@pytest.fixture(scope="module")
def ship() -> ah.Hull:
    """A small hull."""
    return ah.examples.wigley(stations=9, waterlines=6)


@pytest.fixture(scope="module")
def mesh(ship: ah.Hull) -> ClosedMesh:
    """Its mesh, shell and deck."""
    return closed_mesh(ship, points=2)


def loaded(path: Path, scale: float = 1.0) -> Any:
    """What trimesh reads: one mesh, m, equal vertices merged and nothing else."""
    found = trimesh.load(path, process=False)
    found = found.to_mesh() if hasattr(found, "to_mesh") else found
    found.merge_vertices()
    found.apply_scale(scale)
    return found


@pytest.mark.parametrize("unit", ["m", "mm"])
@pytest.mark.parametrize("form", FORMS)
def test_what_is_written_is_closed(mesh: ClosedMesh, tmp_path: Path, form: str, unit: str) -> None:
    """Trimesh agrees: watertight, wound one way, Euler 2, outward, the same volume and places."""
    path = tmp_path / f"ship{ENDINGS[form]}"
    if (form, unit) == ("glb", "mm"):
        with pytest.raises(BadInputError, match="unit is 'mm'"):
            write_mesh(mesh, path, form, unit=unit)
        assert not path.exists()
        return
    report = write_mesh(mesh, path, form, unit=unit)
    assert (report.form, report.unit, report.half) == (form, unit, False)
    assert (report.triangles, report.left_out) == (len(mesh.triangle), 0)
    assert report.size == path.stat().st_size
    found = loaded(path, 1e-3 if unit == "mm" else 1.0)
    assert found.is_watertight
    assert found.is_winding_consistent
    assert found.euler_number == 2
    assert (len(found.vertices), len(found.faces)) == (report.vertices, report.triangles)
    near = 2e-6 if form in SINGLE else 1e-7 if form != "ply" else 1e-12
    assert found.volume == pytest.approx(mesh.volume, rel=near)
    places = found.vertices[:, [2, 0, 1]] if form == "glb" else found.vertices
    np.testing.assert_allclose(sorted_rows(places), sorted_rows(mesh.xyz), atol=5e-6)


def sorted_rows(places: FloatArray) -> FloatArray:
    """Places in an order of their own: rounded ones by rounded ones."""
    rounded = np.round(places, 4)
    return np.asarray(places[np.lexsort(rounded.T[::-1])])


@pytest.mark.parametrize("form", FORMS)
def test_one_mesh_is_one_file(mesh: ClosedMesh, tmp_path: Path, form: str) -> None:
    """No times, no random order."""
    paths = [tmp_path / f"{i}{ENDINGS[form]}" for i in range(2)]
    for path in paths:
        write_mesh(mesh, path, form)
    assert paths[0].read_bytes() == paths[1].read_bytes()


def solids(path: Path) -> set[str]:
    """Names in a text of STL."""
    return {row.split()[1] for row in path.read_text().splitlines() if row.startswith("solid")}


def groups(path: Path) -> set[str]:
    """Names in an OBJ."""
    return {row[2:] for row in path.read_text().splitlines() if row.startswith("g ")}


def comments(path: Path) -> set[str]:
    """Names in the head of a PLY."""
    head = path.read_bytes().partition(b"end_header")[0].decode()
    return {row.split()[3] for row in head.splitlines() if row.startswith("comment group")}


def nodes(path: Path) -> set[str]:
    """Names in a scene."""
    data = path.read_bytes()
    size = int.from_bytes(data[12:16], "little")
    return {each["name"] for each in json.loads(data[20 : 20 + size])["meshes"]}


@pytest.mark.parametrize(
    ("form", "names"), [("stl-text", solids), ("obj", groups), ("ply", comments), ("glb", nodes)]
)
def test_groups_are_kept(
    mesh: ClosedMesh, tmp_path: Path, form: str, names: Callable[[Path], set[str]]
) -> None:
    """Shell and deck have their names where the form knows groups."""
    path = tmp_path / f"ship{ENDINGS[form]}"
    write_mesh(mesh, path, form)
    assert names(path) == {"shell", "deck"}


def test_triangles_stay_in_their_group_whatever_their_order(
    mesh: ClosedMesh, tmp_path: Path
) -> None:
    """Every triangle under the name of the deck lies at the height of the deck edge."""
    mixed = np.random.default_rng(3).permutation(len(mesh.triangle))
    shuffled = attrs.evolve(
        mesh, triangle=mesh.triangle[mixed], group=mesh.group[mixed], cell=mesh.cell[mixed]
    )
    write_mesh(shuffled, tmp_path / "ship.obj")
    rows = (tmp_path / "ship.obj").read_text().splitlines()
    height = [float(row.split()[3]) for row in rows if row.startswith("v ")]
    deck = [row.split()[1:] for row in rows[rows.index("g deck") + 1 :] if row.startswith("f ")]
    assert len(deck) == int((mesh.group == mesh.names.index("deck")).sum())
    assert {height[int(each) - 1] for row in deck for each in row} == {max(height)}


def test_a_half_is_open_in_the_centre_plane(ship: ah.Hull, tmp_path: Path) -> None:
    """It may be written, says what it is, and has no volume."""
    half = closed_mesh(ship, half=True, points=2)
    report = write_mesh(half, tmp_path / "half.ply", name="Wigley")
    assert (report.half, report.volume) == (True, None)
    assert b"comment Wigley: port half, open in the centre plane; unit m" in (
        (tmp_path / "half.ply").read_bytes()
    )
    found = loaded(tmp_path / "half.ply")
    edges = found.edges_sorted
    _, first, count = np.unique(edges, axis=0, return_index=True, return_counts=True)
    assert np.abs(found.vertices[edges[first[count == 1]], 1]).max() == 0.0


def test_what_is_not_watertight_is_refused(mesh: ClosedMesh, tmp_path: Path) -> None:
    """A triangle less, or one turned round: no file, whatever the report of the mesh says."""
    turned = mesh.triangle.copy()
    turned[0] = turned[0, ::-1]
    for broken in (
        attrs.evolve(mesh, triangle=mesh.triangle[1:], group=mesh.group[1:], cell=mesh.cell[1:]),
        attrs.evolve(mesh, triangle=turned),
        attrs.evolve(mesh, triangle=mesh.triangle[:, ::-1].copy()),
    ):
        with pytest.raises(OpenMeshError):
            write_mesh(broken, tmp_path / "ship.stl")
    assert list(tmp_path.iterdir()) == []


def test_triangles_that_rounding_makes_nil_are_left_out_on_both_sides(
    mesh: ClosedMesh, tmp_path: Path
) -> None:
    """A vertex 1 nm beside another falls onto it in single precision: two triangles go."""
    first = int(np.abs(mesh.xyz[mesh.triangle]).min(axis=(1, 2)).argmax())  # far from zero
    a, b, c = mesh.triangle[first].tolist()
    other = next(
        i for i, face in enumerate(mesh.triangle.tolist()) if i != first and {a, b} <= set(face)
    )
    (d,) = set(mesh.triangle[other].tolist()) - {a, b}
    start, step = mesh.xyz[a], mesh.xyz[b] - mesh.xyz[a]
    near = start + 1e-9 * step / np.linalg.norm(step)
    new = len(mesh.xyz)
    rows = np.delete(mesh.triangle, [first, other], axis=0)
    split = np.array([[a, new, c], [new, b, c], [new, a, d], [b, new, d]])
    fine = attrs.evolve(
        mesh, xyz=np.concatenate([mesh.xyz, near[None]]),
        triangle=np.concatenate([rows, split]),
        group=np.zeros(len(rows) + 4, np.int64), cell=np.zeros(len(rows) + 4, np.int64),
    )  # fmt: skip
    report = write_mesh(fine, tmp_path / "ship.stl")
    assert (report.left_out, report.triangles) == (2, len(mesh.triangle))
    assert loaded(tmp_path / "ship.stl").is_watertight


def test_a_corner_that_rounding_folds_upon_itself_becomes_one_point(
    mesh: ClosedMesh, tmp_path: Path
) -> None:
    """Of three points .3 um apart two fall together: four triangles would share an edge."""
    ring = [
        (0.0, 0.0),
        (10.0, 0.0),
        (10.0, 3.4),
        (10.0, 3.4 + 3e-7),
        (10.0, 3.4 + 2e-8),
        (0.0, 3.4),
    ]
    xyz = np.array([*((x, 0.0, z) for x, z in ring), (5.0, 2.0, 1.7), (5.0, -2.0, 1.7)])
    port, starboard, count = len(ring), len(ring) + 1, len(ring)
    pairs = [(i, (i + 1) % count) for i in range(count)]
    sides = [[j, i, port] for i, j in pairs] + [[i, j, starboard] for i, j in pairs]
    none = np.zeros(len(sides), np.int64)
    folded = attrs.evolve(mesh, xyz=xyz, triangle=np.array(sides), group=none, cell=none)
    report = write_mesh(folded, tmp_path / "corner.stl")
    found = loaded(tmp_path / "corner.stl")
    assert found.is_watertight
    assert (report.left_out, len(found.faces)) == (4, 8)
    assert found.volume == pytest.approx(10.0 * 3.4 * 4.0 / 3.0, rel=1e-6)


@pytest.mark.parametrize("form", ["stl-text", "obj"])
def test_texts_of_a_small_model_are_as_near_as_those_of_a_ship(
    mesh: ClosedMesh, tmp_path: Path, form: str
) -> None:
    """Rounded by half of 1e-8 of the length: at 1/256, 0.4 m, a micrometre would show."""
    path, small = tmp_path / f"model{ENDINGS[form]}", mesh.xyz / 256.0
    report = write_mesh(attrs.evolve(mesh, xyz=small), path, form)
    found = loaded(path)
    assert found.is_watertight
    assert (report.left_out, report.triangles) == (0, len(mesh.triangle))
    length = float(np.ptp(small[:, 0]))
    off = np.abs(sorted_rows(found.vertices * 256.0) - sorted_rows(mesh.xyz)).max() / 256.0
    assert off <= 0.51e-8 * length
    assert found.volume == pytest.approx(mesh.volume / 256.0**3, rel=1e-7)


def test_a_closed_mesh_becomes_a_net_again(tmp_path: Path) -> None:
    """`read` cuts stations, waterlines and buttocks from the STL, without its deck or mirror."""
    made = closed_mesh(ah.examples.wigley(stations=15, waterlines=8))
    write_mesh(made, tmp_path / "ship.stl")
    again = ah.read(tmp_path / "ship.stl", stations=15, waterlines=8, buttocks=2, draught=6.25)
    assert again.check() == ()
    volume = again.hydrostatics(draught=6.25).volume
    assert volume == pytest.approx(made.below(6.25).volume, rel=5e-4)


def test_bad_calls_are_named(
    mesh: ClosedMesh, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """No form, another unit, something else than a mesh, no trimesh: one line each, no file."""
    with pytest.raises(BadInputError, match=r"end it in \.stl, \.obj, \.ply, \.glb"):
        write_mesh(mesh, tmp_path / "ship.mesh")
    with pytest.raises(BadInputError, match="unit is 'ft'"):
        write_mesh(mesh, tmp_path / "ship.stl", unit="ft")
    with pytest.raises(WrongTypeError):
        write_mesh("ship", tmp_path / "ship.stl")  # type: ignore[arg-type]
    monkeypatch.setitem(__import__("sys").modules, "trimesh", None)
    with pytest.raises(MissingExtraError, match=r"assoc-hull\[mesh\]"):
        write_mesh(mesh, tmp_path / "ship.glb")
    assert list(tmp_path.iterdir()) == []
