"""What plates are measured by: curvature at nodes, axes, extents, the direction of rolling."""

import numpy as np
import pytest

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.bezier_patches import Patches
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.surface.plating.curvature_nodes import CurvatureNodes, curvature_nodes
from assoc_hull.surface.plating.plate import plate_axes, plate_extents, seam_lengths
from assoc_hull.surface.plating.plate_class import RollAxis, flat_share, roll_axis, rulings
from tests import bent_plates
from tests.curved_patches import nets, patch


def monge(heights: FloatArray) -> FloatArray:
    """The bicubic net over the unit square with these heights."""
    x, y = np.mgrid[0:4, 0:4] / 3.0
    return np.stack([x, y, heights], axis=-1)


def axis_of(surface: SplineSurface) -> RollAxis:
    """The roll axis of a surface."""
    nodes = curvature_nodes(surface.patches())
    return roll_axis(nodes, plate_axes(nodes))


def test_curvature_is_that_of_the_formula_for_heights() -> None:
    """Of z = f(x, y): K, both principal curvatures, and the direction of the larger one."""
    rng = np.random.default_rng(3)
    heights = rng.normal(0.0, 0.2, (4, 4))
    nodes = curvature_nodes(Patches.single(monge(heights)), 9)
    x, y = nodes.place[0, ..., 0], nodes.place[0, ..., 1]

    def basis(t: FloatArray, slope: int) -> FloatArray:
        rows = [np.polynomial.Polynomial([1.0, -1.0]), np.polynomial.Polynomial([0.0, 1.0])]
        times = (1.0, 3.0, 3.0, 1.0)
        parts = [times[i] * rows[0] ** (3 - i) * rows[1] ** i for i in range(4)]
        return np.stack([(part.deriv(slope) if slope else part)(t) for part in parts], axis=-1)

    def height(i: int, j: int) -> FloatArray:
        found: FloatArray = np.einsum("abi,ij,abj->ab", basis(x, i), heights, basis(y, j))
        return found

    fx, fy, fxx, fxy, fyy = (height(i, j) for i, j in ((1, 0), (0, 1), (2, 0), (1, 1), (0, 2)))
    w = 1.0 + fx**2 + fy**2
    gauss = (fxx * fyy - fxy**2) / w**2
    mean = ((1 + fx**2) * fyy - 2 * fx * fy * fxy + (1 + fy**2) * fxx) / (2 * w**1.5)
    assert nodes.gauss[0] == pytest.approx(gauss, abs=1e-12)
    assert nodes.bent[0] + np.sign(gauss) * nodes.other[0] == pytest.approx(
        2 * np.abs(mean), abs=1e-11
    )
    assert nodes.bent[0] * nodes.other[0] == pytest.approx(np.abs(gauss), abs=1e-11)
    dx, dy = nodes.bending[0, ..., 0], nodes.bending[0, ..., 1]
    along = (fxx * dx**2 + 2 * fxy * dx * dy + fyy * dy**2) / np.sqrt(w)
    assert np.abs(along) == pytest.approx(nodes.bent[0], abs=1e-11)
    assert np.linalg.norm(nodes.bending, axis=-1) == pytest.approx(1.0)


def test_a_rational_cylinder_is_round_everywhere() -> None:
    """Weights are part of the shape: a quarter of a circle as a conic has one radius."""
    net = np.zeros((3, 2, 3))
    net[..., :2] = np.array([[2.0, 0.0], [2.0, 2.0], [0.0, 2.0]])[:, None]
    net[:, 1, 2] = 3.0
    weight = np.array([[1.0], [np.sqrt(0.5)], [1.0]]) * np.ones((1, 2))
    nodes = curvature_nodes(Patches.single(net, weight))
    assert nodes.bent == pytest.approx(0.5, abs=1e-12)
    assert nodes.gauss == pytest.approx(0.0, abs=1e-12)
    assert nodes.area.sum() == pytest.approx(3.0 * np.pi, rel=1e-12)


def test_each_patch_is_measured_by_itself() -> None:
    """A batch gives the same bits as its patches one by one, in any order."""
    given = np.stack(list(nets().values()))
    order = np.random.default_rng(5).permutation(len(given))
    all_of = curvature_nodes(_batch(given[order]))
    for row, number in enumerate(order):
        one = curvature_nodes(_batch(given[[number]]))
        for field in ("place", "area", "gauss", "bent", "other", "bending"):
            assert getattr(all_of, field)[row].tobytes() == getattr(one, field)[0].tobytes()


def _batch(given: FloatArray) -> Patches:
    k = len(given)
    box = np.broadcast_to([[0.0, 1.0]] * 2, (k, 2, 2)).copy()
    return Patches(given, box, np.zeros(k, np.intp))


def test_a_pole_has_no_curvature() -> None:
    """Where there is no normal, nothing is evaluated: no infinity, no area."""
    nodes = curvature_nodes(Patches.single(patch("P17_pole_sphere")))
    there = nodes.area > 0.0
    assert np.isfinite(nodes.gauss).all()
    assert (nodes.gauss[~there] == 0.0).all()
    assert (~there).sum() == 24
    assert nodes.gauss[there] == pytest.approx(1.0, abs=0.07)  # a bicubic octant is near a sphere


@pytest.mark.parametrize(
    ("surface", "angle", "coherence"),
    [
        pytest.param(bent_plates.cylinder(6.0, 2.0, 2.5), 0.0, 1.0, id="cylinder"),
        pytest.param(SplineSurface.bezier(patch("P15_cyl_rot")), 0.0, 1.0, id="rotated"),
        pytest.param(bent_plates.moved(bent_plates.cylinder(6.0, 2.0, 2.5)), 0.0, 1.0, id="moved"),
        pytest.param(SplineSurface.bezier(patch("P16_cone_rot")), 0.0, 0.98, id="cone"),
        pytest.param(SplineSurface.bezier(patch("P11_hypar")), 135.7, 1.0, id="hypar"),
        pytest.param(SplineSurface.bezier(patch("P09_bow_plate")), 5.1, 0.97, id="bow"),
    ],
)
def test_plates_are_rolled_about_their_rulings(
    surface: SplineSurface, angle: float, coherence: float
) -> None:
    """A cylinder about its long axis, wherever it lies; a cone about its middle; others about the
    direction of the smaller curvature.
    """
    found = axis_of(surface)
    assert min(abs(found.angle_deg - angle), abs(found.angle_deg - angle - 180.0)) < 0.2
    assert found.coherence == pytest.approx(coherence, abs=0.005)


def test_the_roll_direction_turns_with_the_plate() -> None:
    """The direction in space is that of the rulings, up to its sign."""
    surface = bent_plates.cylinder(6.0, 2.0, 2.5, askew=0.4)
    turned = bent_plates.moved(surface, seed=4)
    first = surface.net - surface.net[0, 0]
    turn, *_ = np.linalg.lstsq(first.reshape(-1, 3), (turned.net - turned.net[0, 0]).reshape(-1, 3))
    here, there = axis_of(surface).direction, axis_of(turned).direction
    assert abs(here[0]) == pytest.approx(1.0, abs=2e-3)
    assert abs((here @ turn) @ there) == pytest.approx(1.0, abs=1e-9)


def test_parameters_do_not_matter() -> None:
    """Exchanged and reversed parameters give the same axis; seen from the other side, mirrored."""
    net = patch("P09_bow_plate")
    here = axis_of(SplineSurface.bezier(net)).angle_deg
    same = axis_of(SplineSurface.bezier(np.swapaxes(net, 0, 1)[::-1])).angle_deg
    mirrored = axis_of(SplineSurface.bezier(net[::-1])).angle_deg
    assert same == pytest.approx(here, abs=1e-9)
    assert mirrored == pytest.approx(180.0 - here, abs=1e-9)


def test_a_plane_has_no_axis_that_means_anything() -> None:
    """Nothing bent at all gives no angle; the noise of a plane is for the class to refuse."""
    x, y = np.mgrid[0:4, 0:4] / 1.0
    nodes = curvature_nodes(Patches.single(np.stack([3 * x, y, 0.0 * x], axis=-1)))
    found = roll_axis(nodes, plate_axes(nodes))
    assert np.isnan(found.angle_deg)
    assert found.coherence == 0.0
    table = rulings(nodes, plate_axes(nodes), 3)
    assert np.isinf(table.radius).all()
    assert np.isnan(table.angle_deg).all()


def test_rulings_of_a_cone_turn_along_it() -> None:
    """Along a plate athwart its rulings their angle turns as the cone does, evenly; the radius is
    that at the middle of the rulings.
    """
    surface = bent_plates.cone(4.0, 5.0, 30.0, 120.0)
    nodes = curvature_nodes(surface.patches())
    table = rulings(nodes, plate_axes(nodes), 5)
    assert table.station[0] < table.station[-1] < np.ptp(nodes.place @ plate_axes(nodes)[0])
    assert (np.abs(np.diff(table.angle_deg)) > 1.0).all()
    assert abs(table.angle_deg[2] - 90.0) < 1.0
    assert table.radius[2] == pytest.approx(4.5 * np.tan(np.radians(30.0)), rel=0.05)


def test_extents_are_those_of_the_rectangle() -> None:
    """A flat plate, anywhere in space, has its length and breadth, along axes that are right-handed
    and see the normal from its front.
    """
    net = np.zeros((2, 2, 3))
    net[1, :, 0], net[:, 1, 1] = 2.5, 7.0
    surface = bent_plates.moved(SplineSurface.bezier(net))
    nodes = curvature_nodes(surface.patches())
    axes = plate_axes(nodes)
    assert plate_extents(surface.net, axes) == pytest.approx([7.0, 2.5])
    assert axes @ axes.T == pytest.approx(np.eye(3), abs=1e-12)
    assert np.linalg.det(axes) == pytest.approx(1.0)
    assert axes[2] @ _normal(nodes) == pytest.approx(-1.0)
    assert seam_lengths(surface) == pytest.approx([2.5, 7.0])


def _normal(nodes: CurvatureNodes) -> FloatArray:
    found = nodes.normal.sum(axis=(0, 1, 2))
    return np.asarray(found / np.linalg.norm(found))


def test_the_flat_part_is_that_of_the_developable_region() -> None:
    """Where a plate is a dome it is neither flat nor bent one way: it does not count at all."""
    x, y = np.mgrid[0:3, 0:3] / 1.0
    plane, dome = np.stack([x, y, 0.0 * x], axis=-1), np.stack([x, y, 0.2 * (x + y)], axis=-1)
    dome[1, 1, 2] += 1.0
    nodes = curvature_nodes(_batch(np.stack([plane, dome])))
    assert nodes.gauss[1].min() < 1e-3 < nodes.gauss[1].max()
    assert flat_share(nodes, 1e-9, 1e-3) == pytest.approx(1.0, abs=0.01)
    assert 0.2 < flat_share(nodes, 0.0, 1e-3) < 0.6
    assert flat_share(curvature_nodes(_batch(dome[None])), 1e-3, 1e-9) == 0.0
