"""Triangulated hulls below floating planes: exact on what is flat, converging on what is not."""

from collections.abc import Callable
from typing import Any

import attrs
import numpy as np
import pytest

from assoc_hull.analysis.hydrostatics.mesh_flotation import MeshFlotation, mesh_flotation
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.floating.immersion import FloatingPlanes, ImmersedIntegrals
from assoc_hull.geometry.surfaces.triangles import Triangles
from tests import meshes

SIZE = 100.0, 20.0, 12.0
"""The box of the reference table, m."""

TEN, TWENTY, FORTY = np.tan(np.deg2rad([10.0, 20.0, 40.0])).tolist()

# V, LCB, TCB, KB, Aw, LCF, TCF, I_T, I_L, I_LT in plan, wetted surface; m
BOXES: dict[tuple[float, float, float], tuple[float, ...]] = {
    (6.0, 0.0, 0.0): (12000.0, 50.0, 0.0, 3.0, 2000.0, 50.0, 0.0, 2e5 / 3, 5e6 / 3, 0.0, 3440.0),
    (5.0, 0.02, 0.0): (
        12000.0, 50 + 25 / 9, 0.0, 3 + 1 / 36, 2000.0, 50.0, 0.0, 2e5 / 3, 5e6 / 3, 0.0, 3440.0,
    ),
    (6.0, 0.0, TWENTY): (
        12000.0, 50.0, -2.0220568570344577, 3.3679842539772062, 2000.0, 50.0, 0.0, 2e5 / 3, 5e6 / 3,
        0.0, 3440.0,
    ),
    (5.0, 0.02, TWENTY): (
        12000.0, 50 + 25 / 9, -2.0220568570344577, 3.3957620317549835, 2000.0, 50.0, 0.0, 2e5 / 3,
        5e6 / 3, 0.0, 3440.0,
    ),
    (8.0, 0.0, FORTY): (
        14860.208622226106, 50.0, -3.1201005029111597, 4.845154050684799, 1430.104311113052, 50.0,
        2.38350718518842, 24373.72470054203, 1191753.5925942115, 0.0, 3973.9056094822067,
    ),
}  # fmt: skip

WIGLEY = 100.0, 10.0, 6.25
WIGLEY_BOTH = (
    2779.1486298103205, 51.19442708246491, -0.23956861395466675, 3.934394080601322,
    661.8504555354777, 50.0649232355497, -0.03097947176978168, 3717.928297301862,
    331649.9446135885, 138.08708179315067, 1488.4604234338635,
)  # fmt: skip
ELLIPSOID = 100.0, 16.0, 6.0
ELLIPSOID_BOTH = (
    3829.3762318298814, 53.7419622428732, -0.8445553974899602, 3.3057871851312988,
    1176.5256905550518, 51.282385456442526, -0.2894325192178653, 17405.54842501525,
    698093.2735185195, 4147.388920753941, 1537.5710836478736,
)  # fmt: skip


def planes(*rows: tuple[float, float, float]) -> FloatingPlanes:
    """Planes of (height, tangent of trim, tangent of heel)."""
    return FloatingPlanes(*(np.array(column, np.float64) for column in zip(*rows, strict=True)))


def values(found: ImmersedIntegrals) -> FloatArray:
    """What the reference table holds, (d, 11)."""
    lcf, tcf = found.area_x / found.area, found.area_y / found.area
    columns = [
        found.volume, found.moment_x / found.volume, found.moment_y / found.volume,
        found.moment_z / found.volume, found.area, lcf, tcf, found.area_yy - found.area_y * tcf,
        found.area_xx - found.area_x * lcf, found.area_xy - found.area_x * tcf, found.shell,
    ]  # fmt: skip
    return np.stack(columns, axis=1)


def scales(size: tuple[float, float, float], wanted: FloatArray) -> FloatArray:
    """The scale of each value: V; L, B, T for centres; B^3 L, B L^3 for inertias."""
    L, B, T = size
    one = [L, B, T, L * B, L, B, B**3 * L, B * L**3, (B * L) ** 2]
    return np.array([wanted[0], *one, wanted[10]])


def box(*cells: int) -> Triangles:
    """The box of the reference table with so many cells each way."""
    x, y, z = (np.linspace(0.0, size, n + 1) for size, n in zip(SIZE, cells, strict=True))
    return meshes.box(x, y - 10.0, z)


def prepared(mesh: Triangles, **options: Any) -> MeshFlotation:
    """A mesh ready to be measured."""
    return mesh_flotation(mesh.xyz, mesh.face, **options)


@pytest.mark.parametrize("cells", [(1, 1, 1), (2, 2, 2), (7, 5, 12)])
def test_boxes_are_exact(cells: tuple[int, int, int]) -> None:
    """Every value of a box agrees with the reference to 1e-12, heeled and with a wet deck too."""
    found = values(prepared(box(*cells)).measure(planes(*BOXES)))
    for row, wanted in zip(found, BOXES.values(), strict=True):
        off = (row - wanted) / scales(SIZE, np.array(wanted))
        np.testing.assert_allclose(off, 0.0, atol=1e-12)


def test_a_row_of_vertices_in_the_plane_counts_once() -> None:
    """A box with rows of vertices at every draught asked for has the volume of a box at each."""
    rows = np.array([0.0, 0.5, 1.0, 1.7, 2.0, 2.5, 3.3])
    body = prepared(meshes.box(np.linspace(0.0, 10.0, 8), np.linspace(-2.5, 2.5, 6), rows))
    found = body.measure(FloatingPlanes(rows[1:].copy(), np.zeros(6), np.zeros(6)))
    np.testing.assert_allclose(found.volume, 50.0 * rows[1:], rtol=1e-12)
    np.testing.assert_allclose(found.area, 50.0, rtol=1e-12)
    np.testing.assert_allclose(found.area_yy, 10.0 * 5.0**3 / 12.0, rtol=1e-12)
    np.testing.assert_allclose(found.moment_z, 50.0 * rows[1:] ** 2 / 2.0, rtol=1e-12)
    np.testing.assert_allclose(found.shell, 50.0 + 30.0 * rows[1:], rtol=1e-12)
    np.testing.assert_allclose(found.girth, 10.0 * (5.0 + 2.0 * rows[1:]), rtol=1e-12)


def test_a_heeled_plane_through_vertices_is_exact() -> None:
    """Rows of vertices in an inclined plane, on sides and ends, change nothing."""
    rows = np.linspace(0.0, 4.0, 9)
    tilted = planes((2.0, 0.125, 0.5), (1.5, 0.0, 0.25), (2.0, -0.25, 0.0))
    fine = prepared(meshes.box(np.linspace(-4.0, 4.0, 9), np.linspace(-2.0, 2.0, 9), rows))
    height, trim, heel = tilted.height, tilted.tan_trim, tilted.tan_heel
    found = fine.measure(tilted)
    np.testing.assert_allclose(found.volume, 32.0 * height, rtol=1e-12)
    np.testing.assert_allclose(found.area, 32.0, rtol=1e-12)
    np.testing.assert_allclose(found.moment_x, trim * 4.0 * 8.0**3 / 12.0, atol=1e-12)
    np.testing.assert_allclose(found.moment_y, -heel * 8.0 * 4.0**3 / 12.0, atol=1e-12)


@pytest.mark.parametrize("part", [1.0 - 1e-14, 1.0, 1.0 + 1e-14])
def test_volume_does_not_jump_at_a_row_of_vertices(part: float) -> None:
    """Rounding of the draught changes no volume by more than rounding, nor the waterplane."""
    body = prepared(meshes.wigley_half(21, 11))
    rows = np.linspace(0.0, meshes.T, 11)[1:]
    whole = body.measure(FloatingPlanes(rows.copy(), np.zeros(10), np.zeros(10)))
    near = body.measure(FloatingPlanes(rows * part, np.zeros(10), np.zeros(10)))
    np.testing.assert_allclose(near.volume, whole.volume, rtol=1e-12)
    np.testing.assert_allclose(near.area, whole.area, rtol=1e-12)
    np.testing.assert_allclose(near.x_most, whole.x_most, rtol=1e-12)


@pytest.mark.parametrize(
    ("made", "plane", "wanted", "size"),
    [
        (meshes.wigley_walled, (5.75, 0.01, TEN), WIGLEY_BOTH, WIGLEY),
        (meshes.ellipsoid_port, (4.0, 0.02, TEN), ELLIPSOID_BOTH, ELLIPSOID),
    ],
    ids=["wigley", "ellipsoid"],
)
def test_meshes_of_a_formula_converge_to_the_reference(
    made: Callable[[int, int], Triangles], plane: tuple[float, float, float],
    wanted: tuple[float, ...], size: tuple[float, float, float],
) -> None:  # fmt: skip
    """Trimmed and heeled, errors fall fourfold as triangles halve, and lead on to the reference.

    What remains after the part of second order is taken off is 1e-6 of each value's scale.
    """
    meshed = [prepared(made(40 * n + 1, 16 * n + 1)) for n in (2, 4, 8)]
    found = np.concatenate([values(body.measure(planes(plane))) for body in meshed])
    first, second, third = (found - wanted) / scales(size, np.array(wanted))
    sure = [0, 3, 4, 10]
    assert (np.abs(first[sure]) > 3.9 * np.abs(second[sure])).all()
    assert (np.abs(second[sure]) > 3.9 * np.abs(third[sure])).all()
    np.testing.assert_allclose((4.0 * third - second) / 3.0, 0.0, atol=1e-6)


def test_moments_are_the_derivatives_of_one_another() -> None:
    """A second route: what moves with the plane is what its waterplane holds."""
    body = prepared(meshes.ellipsoid_port(61, 31))
    at, step = np.array([4.1, 0.02, 0.15]), 1e-4

    def slopes(name: str) -> FloatArray:
        rows = [tuple((at + sign * step * side).tolist()) for side in np.eye(3) for sign in (1, -1)]
        high = getattr(body.measure(planes(*rows)), name)
        return np.asarray((high[::2] - high[1::2]) / (2.0 * step))

    one = body.measure(planes(tuple(at.tolist())))
    area, x, y = one.area[0], one.area_x[0], one.area_y[0]
    xx, xy, yy = one.area_xx[0], one.area_xy[0], one.area_yy[0]
    np.testing.assert_allclose(slopes("volume"), [area, x, -y], rtol=1e-6)
    np.testing.assert_allclose(slopes("moment_x"), [x, xx, -xy], rtol=1e-6)
    np.testing.assert_allclose(slopes("moment_y"), [y, xy, -yy], rtol=1e-6)
    mean_z = at[0] * area + at[1] * x - at[2] * y
    np.testing.assert_allclose(slopes("moment_z")[0], mean_z, rtol=1e-6)


def test_a_batch_is_what_its_planes_give_one_by_one() -> None:
    """Planes in any order and inclination give the values of each alone.

    So do more of them than are held at a time.
    """
    body = prepared(meshes.wigley_walled(61, 25))
    rows = [(3.0 + 0.01 * (i * 7 % 250), 0.0, 0.0) for i in range(1500)]
    rows += [(3.0 + 0.02 * (i * 7 % 50), 0.001 * (i % 5), 0.01 * (i % 3)) for i in range(50)]
    batch = attrs.astuple(body.measure(planes(*rows)), recurse=False)
    for i in (0, 101, 249, 1400, 1500, 1507, 1549):
        alone = attrs.astuple(body.measure(planes(rows[i])), recurse=False)
        for many, one in zip(batch, alone, strict=True):
            np.testing.assert_allclose(many[i], one[0], rtol=1e-11, atol=1e-9)


def test_a_half_is_what_the_whole_hull_is() -> None:
    """One side, port or starboard, and both sides give the same values; each is recognised."""
    side = meshes.wigley_half(41, 17)
    other = meshes.moved(side, lambda xyz: xyz * [1.0, -1.0, 1.0])
    bodies = [prepared(each) for each in (side, other, meshes.closed_wigley(41, 17))]
    assert [body.half for body in bodies] == [True, True, False]
    rows = [values(body.measure(planes((4.0, 0.01, 0.1))))[0] for body in bodies]
    for row in rows[1:]:
        np.testing.assert_allclose(row, rows[0], rtol=1e-12, atol=1e-9)


def test_triangles_that_face_inward_are_turned() -> None:
    """A mesh inside out, and one with every third triangle turned, give the values of a sound one.

    How many were turned is told.
    """
    sound = meshes.closed_wigley(31, 13)
    count = len(sound.face)
    third = np.arange(count) % 3 == 0
    wanted = values(prepared(sound).measure(planes((4.0, 0.01, 0.1))))
    for wrong in (np.ones(count, np.bool_), third):
        face = np.where(wrong[:, None], sound.face[:, ::-1], sound.face)
        body = mesh_flotation(sound.xyz, face)
        assert body.turned == wrong.sum()
        found = values(body.measure(planes((4.0, 0.01, 0.1))))
        np.testing.assert_allclose(found, wanted, rtol=1e-12, atol=1e-9)
    assert prepared(sound).turned == 0


def test_the_waterplane_reaches_from_edge_to_edge() -> None:
    """Extents are those of the waterplane, deck and bottom cut too; none without a waterplane."""
    found = prepared(box(3, 4, 5)).measure(planes((8.0, 0.0, FORTY), (-1.0, 0.0, 0.0)))
    assert found.x_least[0] == 0.0
    assert found.x_most[0] == 100.0
    np.testing.assert_allclose(found.y_least[0], (8.0 - 12.0) / FORTY, rtol=1e-12)
    np.testing.assert_allclose(found.y_most[0], 8.0 / FORTY, rtol=1e-12)
    assert np.isnan([found.x_least[1], found.x_most[1], found.y_least[1], found.y_most[1]]).all()
    assert found.volume[1] == found.area[1] == 0.0


def test_an_opening_below_the_plane_is_refused_with_its_place_and_length() -> None:
    """A triangle that is missing matters where it is below the plane, and there only."""
    mesh = box(10, 4, 6)
    low = mesh.corners[:, :, 2].max(axis=1)
    bottom = int(np.flatnonzero(low == 0.0)[0])
    x, y, _ = mesh.corners[bottom].mean(axis=0)
    body = mesh_flotation(mesh.xyz, np.delete(mesh.face, bottom, axis=0))
    with pytest.raises(BadInputError, match="open below the plane: 3 edges") as refused:
        body.measure(planes((4.0, 0.0, 0.0)))
    ends = np.linalg.norm(np.diff(mesh.corners[bottom][[0, 1, 2, 0]], axis=0), axis=1)
    assert f"{ends.sum():.4g} m in all" in refused.value.what
    found = [float(each) for each in refused.value.what.split("(")[-1].split(")")[0].split(",")]
    assert np.abs(np.array(found) - [x, y, 0.0]).max() < 10.0
    top = np.flatnonzero(mesh.corners[:, :, 2].min(axis=1) == 12.0)[0]
    opened = mesh_flotation(mesh.xyz, np.delete(mesh.face, top, axis=0))
    assert opened.measure(planes((4.0, 0.0, 0.0))).volume[0] == pytest.approx(8000.0, rel=1e-12)


def test_halves_that_differ_by_rounding_are_one_hull() -> None:
    """A seam whose sides are 1e-13 m apart is closed; one that gapes by a millimetre is open."""
    half = meshes.wigley_half(21, 9)
    level = planes((5.0, 0.0, 0.0))
    wanted = prepared(half).measure(level).volume
    for gap in (1e-13, 1e-3):
        face = np.concatenate([half.face, half.face[:, ::-1] + len(half.xyz)])
        away = np.where(half.xyz[:, 1:2] == 0.0, gap, half.xyz[:, 1:2]) * [0.0, 1.0, 0.0]
        xyz = half.xyz * [1.0, 0.0, 1.0]
        whole = mesh_flotation(np.concatenate([xyz + away, xyz - away]), face)
        assert not whole.half
        if gap < 1e-9:
            np.testing.assert_allclose(whole.measure(level).volume, wanted, rtol=1e-12)
        else:
            with pytest.raises(BadInputError, match="open below the plane"):
                whole.measure(level)


def test_shells_that_are_not_sewn_are_told_by_their_openings() -> None:
    """Sides of a box that touch nowhere all count as outward, and are refused as open."""
    one = box(2, 2, 2)
    corners = one.corners + 1e-3 * np.sign(one.area_vectors())[:, None]
    apart = mesh_flotation(corners.reshape(-1, 3), np.arange(3 * len(corners)).reshape(-1, 3))
    assert apart.turned == 0
    with pytest.raises(BadInputError, match="not shared by two triangles"):
        apart.measure(planes((4.0, 0.0, 0.0)))


def test_no_plane_gives_no_value() -> None:
    """An empty batch is an empty result."""
    found = prepared(box(1, 1, 1)).measure(FloatingPlanes(np.zeros(0), np.zeros(0), np.zeros(0)))
    assert found.volume.shape == found.x_least.shape == (0,)


def test_a_drowned_open_deck_is_refused() -> None:
    """A plane above the edge of an open deck gives no numbers, at an angle neither."""
    body = prepared(meshes.wigley_half(21, 9))
    for plane in ((6.26, 0.0, 0.0), (6.25, 0.001, 0.0), (6.2, 0.0, 0.1)):
        with pytest.raises(BadInputError, match="open below the plane"):
            body.measure(planes(plane))


def test_parts_that_disagree_about_outward_are_refused() -> None:
    """Of two boxes one inside out: refused with its triangles, volume and place.

    It does not matter whether they touch at an edge.
    """
    one = box(1, 1, 1)
    face = np.concatenate([one.face, one.face[:, ::-1] + len(one.xyz)])
    for away, y in (([200.0, 0.0, 0.0], "0"), ([100.0, 20.0, 0.0], "20")):
        xyz = np.concatenate([one.xyz, one.xyz + np.array(away)])
        place = rf"\({away[0] + 50:g}, {y}, 6\)"
        with pytest.raises(BadInputError, match=rf"12 triangles and 2.4e\+04 m3 about {place}"):
            mesh_flotation(xyz, face)
    both = mesh_flotation(xyz, np.concatenate([one.face, one.face + len(one.xyz)]))
    assert both.measure(planes((1.0, 0.0, 0.0))).volume[0] == pytest.approx(4000.0, rel=1e-12)


def test_a_surface_of_one_side_is_refused() -> None:
    """A Moebius strip has no outside."""
    t = np.linspace(0.0, 2.0 * np.pi, 41)[:-1]
    edges = [
        np.stack([(9 + s * np.cos(t / 2)) * np.cos(t), (9 + s * np.cos(t / 2)) * np.sin(t),
                  s * np.sin(t / 2)], axis=1)
        for s in (1.0, -1.0)
    ]  # fmt: skip
    i = np.arange(40)
    j = (i + 1) % 40
    low, high = np.where(j == 0, 40, j), np.where(j == 0, 0, 40 + j)
    face = np.concatenate([np.stack([i, low, 40 + i], 1), np.stack([low, high, 40 + i], 1)])
    with pytest.raises(BadInputError, match="cannot all face outward"):
        mesh_flotation(np.concatenate(edges), face, half=False)


def test_half_a_hull_with_a_lid_in_the_centre_plane_asks_which_it_is() -> None:
    """What may be half a hull or a whole one is refused until it is said; then both are right."""
    lid = meshes.box(np.linspace(0.0, 9.0, 4), np.linspace(0.0, 2.0, 3), np.linspace(0.0, 3.0, 4))
    with pytest.raises(BadInputError, match="half=True or half=False"):
        prepared(lid)
    level = planes((1.0, 0.0, 0.0))
    both = prepared(lid, half=True).measure(level)
    assert both.volume[0] == pytest.approx(36.0, rel=1e-12)
    assert both.shell[0] == pytest.approx(36.0 + 26.0, rel=1e-12)
    assert prepared(lid, half=False).measure(level).volume[0] == pytest.approx(18.0, rel=1e-12)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda mesh: (mesh.xyz * [1.0, 1.0, np.nan], mesh.face), "not finite"),
        (lambda mesh: (mesh.xyz, mesh.face + 1), "has the vertices"),
        (lambda mesh: (mesh.xyz, mesh.face * 1.0), "faces hold float64"),
        (lambda mesh: (mesh.xyz, mesh.face[:0]), "no triangles"),
        (lambda mesh: (mesh.xyz * [1.0, 1.0, 0.0], mesh.face), "in one plane"),
    ],
)
def test_what_is_no_mesh_is_refused(
    change: Callable[[Triangles], tuple[Any, Any]], words: str
) -> None:
    """Numbers that are none, triangles of no vertex, and flat drawings are named."""
    with pytest.raises(BadInputError, match=words):
        mesh_flotation(*change(box(2, 2, 2)))
