"""Plates laid flat: shapes with a known development, strips with a known strain."""

import numpy as np
import pytest
from scipy.optimize import least_squares

from assoc_hull.errors import BadInputError, WrongTypeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.surface.plating.development import (
    LABEL,
    development,
    equal_grid,
    flatten_grid,
    springs_of,
)
from tests import bent_plates
from tests.curved_patches import patch


def range_amidships(surface: SplineSurface) -> float:
    """How far the strain along a plate ranges across its middle."""
    return float(np.ptp(development(surface).longitudinal[24]))


def test_a_cylinder_gets_its_own_outline() -> None:
    """A developable plate is laid flat without strain: length by girth, also where it lies askew
    to its grid and anywhere in space.
    """
    flat = development(bent_plates.moved(bent_plates.cylinder(6.0, 2.0, 2.5, askew=0.3)))
    assert flat.largest_strain < 1e-8
    assert np.abs(flat.diagonal).max() < 1e-8
    assert flat.size == pytest.approx([6.0, 2.0], abs=1e-7)
    assert flat.area_change == pytest.approx(0.0, abs=2e-7)
    assert flat.area == pytest.approx(12.0, rel=2e-7)
    assert flat.notes == ()


def test_a_cone_gets_its_own_sector() -> None:
    """A cone of 30 degrees turned by 90 is flat a sector of 45, from radius 1 to radius 4."""
    flat = development(bent_plates.cone(1.0, 4.0, 30.0, 90.0)).flat
    assert np.linalg.norm(flat[-1, -1] - flat[-1, 0]) == pytest.approx(
        8.0 * np.sin(np.radians(22.5)), rel=1e-6
    )
    assert np.linalg.norm(flat[-1, 0] - flat[0, 0]) == pytest.approx(3.0, rel=1e-6)
    assert np.linalg.norm(flat[0, -1] - flat[0, 0]) == pytest.approx(
        2.0 * np.sin(np.radians(22.5)), rel=1e-6
    )


def test_a_plate_rolled_over_itself_is_laid_flat() -> None:
    """Three quarters of a tube, whose projection onto a plane would overlap, comes out straight."""
    angle, z = np.meshgrid(np.linspace(0.0, 4.7, 97), np.linspace(0.0, 1.6, 33), indexing="ij")
    flat = flatten_grid(springs_of(np.stack([np.cos(angle), np.sin(angle), z], axis=-1)))
    assert flat.settled
    assert np.ptp(flat.place[..., 0]) == pytest.approx(4.7, rel=1e-6)
    assert np.abs(flat.strain).max() < 1e-7


def test_the_outline_goes_round_once() -> None:
    """Counter-clockwise, each border node once, with the same nodes on the surface."""
    flat = development(bent_plates.cylinder(6.0, 2.0, 4.0), (9, 5))
    x, y = flat.outline.T
    assert 0.5 * (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() == pytest.approx(flat.flat_area)
    assert len(np.unique(flat.outline, axis=0)) == len(flat.outline) == 24
    steps = np.linalg.norm(np.diff(flat.outline_on_surface, axis=0), axis=1)
    assert steps == pytest.approx(np.hypot(np.diff(x), np.diff(y)), rel=1e-3)


@pytest.mark.parametrize(
    ("surface", "sign", "breadth"),
    [
        pytest.param(bent_plates.sphere(6.0, 1.0), -1.0, 1.0, id="sphere, 1 m broad"),
        pytest.param(bent_plates.sphere(6.0, 2.0), -1.0, 2.0, id="sphere, 2 m broad"),
        pytest.param(bent_plates.pseudosphere(6.0, 2.0), 1.0, 2.0, id="saddle, 2 m broad"),
    ],
)
def test_a_strip_needs_the_strain_of_its_breadth(
    surface: SplineSurface, sign: float, breadth: float
) -> None:
    """With K = 0.01 1/m2 the strain along ranges over K b**2/8: from K b**2/12 at the edges,
    which are shrunk where K > 0, to K b**2/24 of the other sign in the middle.
    """
    strain = development(surface).longitudinal
    middle = strain[len(strain) // 2]
    assert np.ptp(middle) == pytest.approx(0.01 * breadth**2 / 8.0, rel=0.01)
    assert middle[[0, -1]] == pytest.approx(sign * 0.01 * breadth**2 / 12.0, rel=0.01)
    assert middle[8] == pytest.approx(-sign * 0.01 * breadth**2 / 24.0, rel=0.02)


def test_a_square_needs_less_strain_than_a_strip() -> None:
    """Both ways share the strain: of a square plate it ranges over half as much."""
    flat = development(bent_plates.sphere(2.0, 2.0))
    assert np.ptp(flat.longitudinal[len(flat.longitudinal) // 2]) < 0.6 * 5e-3


def test_the_figure_is_the_best_one() -> None:
    """A general solver that starts from the figure finds nothing better; one that starts from the
    projection onto a plane ends there too.
    """
    points = equal_grid(bent_plates.sphere(2.0, 1.5, 2.0), (7, 5))
    springs = springs_of(points.fine)
    first, second = springs.ends

    def off(at: FloatArray) -> FloatArray:
        apart = np.linalg.norm(np.diff(at.reshape(-1, 2)[[first, second]], axis=0)[0], axis=1)
        return np.asarray(np.sqrt(springs.weight) * (apart / springs.length - 1.0))

    found = flatten_grid(springs)
    assert found.settled
    least = float((off(found.place.ravel()) ** 2).sum())
    for start in (found.place, points.place[..., :2]):
        fit = least_squares(off, start.ravel(), ftol=1e-13, xtol=1e-13, gtol=1e-13)
        assert 2.0 * fit.cost == pytest.approx(least, rel=1e-8)


@pytest.mark.parametrize("turned", [False, True], ids=["long in u", "long in v"])
@pytest.mark.parametrize("side", [1.0, -1.0], ids=["seen from above", "seen from below"])
def test_the_figure_is_seen_from_the_side_of_the_normal(turned: bool, side: float) -> None:
    """A flat plate without symmetry keeps its shape; it is mirrored only when r_u x r_v says so,
    whichever parameter runs along it.
    """
    net = np.zeros((2, 2, 3))
    net[..., :2] = [[[0.0, 0.0], [0.5, 2.0]], [[5.0, 0.0], [3.0, 1.0]]]
    net = net if side > 0.0 else net[:, ::-1]
    net = np.swapaxes(net, 0, 1)[:, ::-1] if turned else net
    found = development(SplineSurface.bezier(net))
    true = np.concatenate([found.place[..., :1], side * found.place[..., 1:2]], axis=-1)
    true = (true - true.mean(axis=(0, 1))).reshape(-1, 2)
    turn, *_ = np.linalg.lstsq(true, found.flat.reshape(-1, 2))
    assert turn @ turn.T == pytest.approx(np.eye(2), abs=1e-9)
    assert np.linalg.det(turn) == pytest.approx(1.0)


def test_a_pole_is_no_obstacle() -> None:
    """Where an edge has shrunk to a point, its nodes stay one; this is told."""
    flat = development(SplineSurface.bezier(patch("P17_pole_sphere"), "octant"))
    assert np.isfinite(flat.flat).all()
    assert flat.largest_strain < 0.1
    assert np.ptp(flat.outline, axis=0).max() < 2.0
    assert any("no length" in note for note in flat.notes)


def test_a_development_is_the_same_every_time() -> None:
    """No randomness: the same bits again."""
    surface = SplineSurface.bezier(patch("P08_wavy_plate"))
    first, second = development(surface), development(surface)
    assert first.flat.tobytes() == second.flat.tobytes()


def test_square_cells_are_the_default() -> None:
    """17 nodes across, and 49 along a plate three times as long; what is asked for is kept."""
    surface = bent_plates.cylinder(6.0, 2.0, 4.0)
    assert development(surface).flat.shape == (49, 17, 2)
    assert development(surface, (9, 5)).flat.shape == (9, 5, 2)
    assert LABEL in str(development(surface, (9, 5)))


def test_the_steps_of_the_grid_are_even() -> None:
    """However unevenly parameters run, steps along and across are alike, and cells square."""
    x, y = np.meshgrid([0.0, 0.1, 0.3, 6.0], [0.0, 1.5, 1.9, 2.0], indexing="ij")
    place = equal_grid(SplineSurface.bezier(np.stack([x, y, 0.0 * x], axis=-1))).place
    assert np.linalg.norm(np.diff(place, axis=0), axis=-1) == pytest.approx(0.125, rel=0.02)
    assert np.linalg.norm(np.diff(place, axis=1), axis=-1) == pytest.approx(0.125, rel=0.02)


@pytest.mark.parametrize("grid", [(2, 9), (9,), (9, 300), "49x17", 49], ids=str)
def test_another_grid_is_refused(grid: object) -> None:
    """A grid has 3 to 257 nodes each way."""
    with pytest.raises((BadInputError, WrongTypeError), match="grid"):
        development(bent_plates.cylinder(6.0, 2.0, 4.0), grid)  # type: ignore[arg-type]


def test_a_line_is_no_plate() -> None:
    """A surface without breadth is refused by its name."""
    net = np.zeros((2, 2, 3))
    net[1, :, 0] = 1.0
    with pytest.raises(BadInputError, match=r"edge.*not a line"):
        development(SplineSurface.bezier(net, "edge"))
