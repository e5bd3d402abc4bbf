"""The closed mesh of small hulls with a formula: closed, convergent, symmetric, or refused."""

from collections.abc import Callable

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.analysis.net.curve_net import CurveNet, gather_net
from assoc_hull.errors import BadInputError, OpenMeshError, OpenNetError, UnknownNameError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.shipped.wigley import wigley_half_breadth
from assoc_hull.surface.cells.closed_mesh import ClosedMesh, examine_mesh, mesh_of_net
from assoc_hull.surface.cells.filling import FilledCells, fill_cells
from assoc_hull.surface.cells.net_faces import find_cells
from assoc_hull.surface.cells.net_graph import net_graph
from tests.cases.test_box_with_bilges import round_box
from tests.net_strategies import fresh
from tests.nets import A, B, C, ellipsoid_net

INSIDE = [*(f"ST {n}" for n in range(1, 20)), *(f"WL {0.625 * n:g}" for n in range(1, 11))]
"""Lines of the Wigley hull that are no border."""


@pytest.fixture(scope="module")
def wigley() -> ah.Hull:
    """100 x 10 x 6.25 m, to z = 9.375 m."""
    return ah.examples.wigley()


@pytest.fixture(scope="module")
def ellipsoid() -> CurveNet:
    """All of it, as one half of a ship: no border but the centre plane."""
    return gather_net(ellipsoid_net(15, 7))


def closed_by_counting(mesh: ClosedMesh) -> bool:
    """Whether every edge is met once in each sense, counted one by one."""
    seen: dict[tuple[int, int], int] = {}
    for a, b, c in mesh.triangle.tolist():
        for pair in ((a, b), (b, c), (c, a)):
            seen[pair] = seen.get(pair, 0) + 1
    return all(seen.get((b, a)) == 1 == times for (a, b), times in seen.items())


def test_the_mesh_is_closed_and_faces_outward(wigley: ah.Hull) -> None:
    """Counted edge by edge; Euler's number is 2, and the volume is the same by x, y and z."""
    mesh = wigley.mesh()
    report = mesh.report
    assert closed_by_counting(mesh)
    assert report.sound
    assert (report.open_edges, report.euler, report.nil, report.collapsed) == (0, 2, 0, 0)
    assert report.fluxes == pytest.approx(np.full(3, mesh.volume), rel=1e-12)
    assert mesh.names == ("shell", "deck")
    assert mesh.cells == 220
    assert mesh.area == pytest.approx(sum(mesh.areas.values()))


def test_it_tells_how_far_lines_leave_their_chords(wigley: ah.Hull) -> None:
    """Half the step, a quarter of it; of parabolas of the formula it would be 0.78 mm."""
    coarse, fine = (wigley.mesh(points=points) for points in (4, 8))
    assert coarse.sagitta[2] == pytest.approx(4.0 * fine.sagitta[2], rel=0.1)
    # y'' = 8 B / 2 / L^2 along waterlines, cut at stations 5 m apart and between in four.
    assert coarse.sagitta[1] == pytest.approx(4.0 * 10.0 / 100.0**2 * 1.25**2 / 8.0, rel=0.05)
    assert "chords" in str(coarse)


def test_the_volume_below_the_waterline_converges_to_that_of_the_splines(wigley: ah.Hull) -> None:
    """Half a step is a quarter of the error, in the end; the centre lies at half length."""
    splines = wigley.hydrostatics(draught=6.25).volume
    below = [wigley.mesh(points=points).below(6.25) for points in (2, 4, 8)]
    off = [splines - each.volume for each in below]
    assert off[0] > 3.0 * off[1] > 0.0
    assert off[1] / off[2] == pytest.approx(4.0, rel=0.1)
    assert off[2] < 1.1e-4 * splines
    assert below[2].lcb == pytest.approx(50.0, abs=1e-8)
    assert below[2].vcb == pytest.approx(0.625 * 6.25, rel=1e-4)


def lines_and_cells(filled: FilledCells, off: FloatArray) -> tuple[float, float]:
    """The largest of some distances on lines, and within cells."""
    graph = filled.cells.graph
    inner = len(graph.place) + len(graph.edge) * (filled.steps - 1)
    return float(np.abs(off[:inner]).max()), float(np.abs(off[inner:]).max())


def test_between_the_lines_the_mesh_is_as_good_as_the_lines(
    wigley: ah.Hull, ellipsoid: CurveNet
) -> None:
    """Vertices within cells lie off the formula by no more than splines between crossings do."""
    filled = fill_cells(find_cells(net_graph(gather_net(wigley.state))), 4)
    x, y, z = filled.xyz.T
    off = np.where(z <= 6.25, y - wigley_half_breadth(x, z, 100.0, 10.0, 6.25), 0.0)
    on_lines, in_cells = lines_and_cells(filled, off)
    assert on_lines < 4e-3
    assert in_cells < 1.05 * on_lines
    filled = fill_cells(find_cells(net_graph(ellipsoid)), 4)
    size = np.sqrt((((filled.xyz - [A, 0.0, C]) / [A, B, C]) ** 2).sum(axis=1))
    on_lines, in_cells = lines_and_cells(filled, size - 1.0)
    assert on_lines < 5e-3
    assert in_cells < on_lines


def test_elements_of_neighbours_fit_together(ellipsoid: CurveNet) -> None:
    """Whatever the number of their sides, cells share all points of their common edge."""
    filled: FilledCells = fill_cells(find_cells(net_graph(ellipsoid)), 4)
    triangle, cell = filled.triangles()
    report = examine_mesh(filled.xyz, triangle)
    outline = filled.along(filled.cells.outline)
    assert report.open_edges == outline.shape[0] * 4
    assert report.euler == 1
    assert (np.bincount(cell) == np.where(filled.cells.sides == 3, 24, 32)).all()


def test_a_body_without_deck_closes_by_itself(ellipsoid: CurveNet) -> None:
    """The profile of an ellipsoid is a ring; nothing is covered, volume and centre are right."""
    mesh = mesh_of_net(ellipsoid, points=8)
    assert mesh.names == ("shell",)
    assert mesh.volume == pytest.approx(4.0 / 3.0 * np.pi * A * B * C, rel=2e-3)
    assert mesh.report.sound


def test_a_half_is_open_in_the_centre_plane_only_and_has_no_volume(wigley: ah.Hull) -> None:
    """It says that it is a half; both together have twice its area."""
    half, whole = wigley.mesh(half=True), wigley.mesh()
    assert half.half
    assert half.report.open_edges > 0
    assert half.report.off_centre == 0
    assert half.xyz[:, 1].min() == 0.0
    assert whole.area == pytest.approx(2.0 * half.area)
    count = len(half.triangle)
    assert whole.triangle[:count].tolist() == half.triangle.tolist()
    with pytest.raises(
        OpenMeshError, match="this is one half, open in the centre plane: make both"
    ):
        _ = half.volume
    with pytest.raises(OpenMeshError, match=r"the volume below a draught of a mesh with \d+ open"):
        half.below(6.25)


def test_the_mesh_is_the_same_to_the_bit_at_every_call(wigley: ah.Hull) -> None:
    """And its two sides are mirror images to the bit."""
    one, again = wigley.mesh(), wigley.mesh()
    assert one.xyz.tobytes() == again.xyz.tobytes()
    assert one.triangle.tobytes() == again.triangle.tobytes()
    port = {tuple(each) for each in one.xyz[one.xyz[:, 1] > 0.0].tolist()}
    starboard = {(x, -y, z) for x, y, z in one.xyz[one.xyz[:, 1] < 0.0].tolist()}
    assert port == starboard
    with pytest.raises(ValueError, match="read-only"):
        one.xyz[0] = 0.0


@pytest.mark.parametrize("number", [1, 3, 4, 8, 10])
def test_nets_drawn_at_random_close_or_are_refused_by_name(number: int) -> None:
    """Volume and centre as hydrostatics has them, the coarser the net the more roughly.

    Two of the nets have buttocks that pass the deck edge by decimetres and end on nothing.
    """
    hull = fresh(number)
    ship = hull.particulars
    try:
        mesh = hull.mesh()
    except OpenNetError as error:
        loose = {each.partition(" at ")[0] for each in error.findings}
        assert all(each.startswith("BTK ") for each in loose)
        mesh = hull.mesh(leave_out=sorted(loose))
    assert mesh.report.sound
    found, wanted = mesh.below(ship.draught), hull.hydrostatics(draught=ship.draught)
    assert found.volume == pytest.approx(wanted.volume, rel=4e-3)
    assert found.lcb == pytest.approx(wanted.lcb, abs=2e-4 * ship.length)


def test_chords_that_leave_lines_by_much_are_told(wigley: ah.Hull) -> None:
    """A box whose bilges are drawn by sections alone loses 5 % with four points; Wigley nothing."""
    (note,) = round_box().mesh().notes
    assert note.startswith("chords leave the lines by more than 0.")
    assert wigley.mesh().notes == ()


def test_places_that_coincide_are_one() -> None:
    """Ends with a level bottom: what is ruled from there to the centre plane comes to nothing."""
    mesh = round_box().mesh(points=8)
    assert mesh.names == ("shell", "aft end", "fore end", "deck")
    assert mesh.report.collapsed > 0
    assert mesh.report.sound
    corner = mesh.triangles.corners
    side = corner - np.roll(corner, 1, axis=1)
    assert (side * side).sum(axis=2).min() > 1e-6


def test_a_profile_that_misses_the_centre_plane_by_rounding_lies_in_it(wigley: ah.Hull) -> None:
    """20 micrometres to port on a hull of 100 m: the halves meet all the same."""
    net = gather_net(wigley.state)
    profile = net.name.index("profile")
    rows = np.arange(net.batch.start[profile], net.batch.start[profile + 1])
    xyz = net.batch.xyz.copy()
    xyz[rows, 1] += 2e-5
    mesh = mesh_of_net(attrs.evolve(net, batch=attrs.evolve(net.batch, xyz=xyz)))
    assert mesh.report.sound
    assert np.abs(mesh.xyz[:, 1])[mesh.xyz[:, 1] != 0.0].min() > 1e-4


TETRAHEDRON = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])


@pytest.mark.parametrize(
    ("change", "open_edges", "euler"),
    [
        pytest.param(lambda face: face, 0, 2, id="closed"),
        pytest.param(lambda face: face[:3], 3, 1, id="a triangle missing"),
        pytest.param(lambda face: np.vstack([face, face[:1]]), 3, 3, id="a triangle twice"),
        pytest.param(lambda face: np.vstack([face[:3], face[3:, ::-1]]), 3, 2, id="one turned"),
        pytest.param(lambda face: face[:, ::-1], 0, 2, id="inside out"),
        pytest.param(lambda face: np.vstack([face, face + 4]), 0, 4, id="two bodies"),
        pytest.param(
            lambda face: np.vstack([face, np.array([0, 1, 4, 5])[face]]),
            1,
            3,
            id="two bodies that share an edge",
        ),
    ],
)
def test_faults_of_a_mesh_are_found(
    change: Callable[[np.ndarray], np.ndarray], open_edges: int, euler: int
) -> None:
    """Each of them takes the volume away; only the first is sound."""
    corner = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    face = change(TETRAHEDRON)
    report = examine_mesh(np.vstack([corner, corner + 2.0])[: face.max() + 1], face)
    assert (report.open_edges, report.euler) == (open_edges, euler)
    assert report.sound == np.array_equal(face, TETRAHEDRON)
    if report.sound:
        return
    empty = np.zeros(len(face), np.int64)
    mesh = ClosedMesh(
        np.vstack([corner, corner + 2.0]),
        face,
        empty,
        empty,
        ("shell",),
        False,
        2,
        1,
        report,
        np.zeros(3),
    )
    with pytest.raises(OpenMeshError):
        _ = mesh.volume


@pytest.mark.parametrize(
    ("options", "kind", "told"),
    [
        pytest.param({"points": 3}, BadInputError, "3 points to an edge", id="odd"),
        pytest.param({"points": 0}, BadInputError, "points", id="none"),
        pytest.param({"half": "no"}, BadInputError, "half", id="half as text"),
        pytest.param({"leave_out": "WL 2.5"}, BadInputError, "leave_out", id="names as text"),
        pytest.param({"leave_out": ["WL 9"]}, UnknownNameError, "WL 9", id="no such line"),
        pytest.param(
            {"leave_out": ["profile"]}, OpenNetError, "deck edge at (0.000, 0.000, 9.375) m",
            id="the profile left out",
        ),
        pytest.param(
            {"leave_out": INSIDE},
            OpenNetError, "add sections and waterlines", id="all but the border left out",
        ),
    ],
)  # fmt: skip
def test_what_cannot_be_meant_is_refused(
    wigley: ah.Hull, options: dict[str, object], kind: type[Exception], told: str
) -> None:
    """With the value, or the line."""
    with pytest.raises(kind) as caught:
        wigley.mesh(**options)  # type: ignore[arg-type]
    assert told in str(caught.value)
