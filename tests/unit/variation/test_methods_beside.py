"""What the methods of variation are compared by: the lattice, the tasks, what is measured."""

import numpy as np
import pytest

from assoc_hull.hull import Hull
from assoc_hull.variation.fields.batch_displacements import FieldPlan
from assoc_hull.variation.fields.layers import AdditiveLayer
from assoc_hull.variation.fields.space_map import VariationMap
from benchmarks.ffd import SIDE, Lattice, LatticeLayer, LatticePlan
from benchmarks.variation_methods import fared
from benchmarks.variation_tasks import METHODS, Task, tasks

BOX = np.array([[-5.0, -25.0, 0.0], [80.0, 25.0, 18.0]])
LATTICE = Lattice(BOX)
XYZ = np.random.default_rng(8).uniform(BOX[0] - 5.0, BOX[1] + 5.0, (500, 3))


@pytest.fixture(scope="module")
def found(bulk_carrier: Hull) -> dict[str, Task]:
    """The tasks of the carrier."""
    return {task.name: task for task in tasks(bulk_carrier.document.state)}


def test_a_lattice_reproduces_what_is_linear() -> None:
    """Weights add up to 1, and control points moved by a linear map move all places by it."""
    inside = XYZ[LATTICE.inside(XYZ)]
    assert LATTICE.weights(inside).sum(axis=1) == pytest.approx(np.ones(len(inside)), abs=1e-14)
    steps = np.linspace(0.0, 1.0, SIDE)
    grid = np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), axis=-1)
    points = BOX[0] + grid * (BOX[1] - BOX[0])
    linear = np.array([[0.02, 0.01, 0.0], [0.0, -0.03, 0.01], [0.02, 0.0, 0.04]])
    moved = LatticeLayer(LATTICE, points @ linear.T).displacement(inside)
    assert moved == pytest.approx(inside @ linear.T, abs=1e-13)


def test_the_jacobian_of_a_lattice_is_the_derivative() -> None:
    """It agrees with central differences; outside it is the unit matrix."""
    layer = LatticeLayer(LATTICE, np.random.default_rng(9).uniform(-1, 1, (SIDE, SIDE, SIDE, 3)))
    xyz, h = XYZ[LATTICE.inside(XYZ)], 1e-5
    xyz = np.clip(xyz, BOX[0] + h, BOX[1] - h)
    slopes = layer.jacobian(xyz) - np.eye(3)
    for axis in range(3):
        step = h * np.eye(3)[axis]
        ahead, behind = layer.displacement(xyz + step), layer.displacement(xyz - step)
        assert slopes[:, :, axis] == pytest.approx((ahead - behind) / (2 * h), abs=1e-8)
    assert (layer.jacobian(BOX[:1] - 1.0) == np.eye(3)).all()


def test_a_planned_lattice_gives_what_the_lattice_gives() -> None:
    """One variant and many, with all control points or those that may move."""
    active = np.arange(10, 25)
    moves = np.random.default_rng(10).uniform(-1, 1, (7, SIDE**3))
    moves[:, np.setdiff1d(np.arange(SIDE**3), active)] = 0.0
    whole, part = LatticePlan.of(LATTICE, XYZ, 2), LatticePlan.of(LATTICE, XYZ, 2, active)
    three = np.zeros((SIDE, SIDE, SIDE, 3))
    for one, row in zip(moves, whole.batch(moves), strict=True):
        three[..., 2] = one.reshape(SIDE, SIDE, SIDE)
        expected = VariationMap((LatticeLayer(LATTICE, three),))(XYZ)[whole.rows, 2]
        for given in (row, whole.moved(one), part.moved(one[active])):
            assert given == pytest.approx(expected, abs=1e-12)


def test_the_carrier_has_all_tasks(found: dict[str, Task]) -> None:
    """Shaft, transom and bulb."""
    assert list(found) == ["shaft +1.0 m", "transom +0.6 m", "bulb +0.5 m"]


@pytest.mark.parametrize("method", METHODS)
def test_every_method_does_the_task(found: dict[str, Task], method: str) -> None:
    """The place is raised by what is asked, heights below and above stay; so does the far end."""
    lay, blend = METHODS[method]
    for task in found.values():
        layer = lay(task, blend)
        xyz = np.array(
            [[task.x, 0.0, task.z], [task.x, 0.0, task.low], [task.x, 0.0, task.high],
             [150.0, 3.0, task.z]]
        )  # fmt: skip
        moved = layer.displacement(xyz)
        assert moved[:, 2] == pytest.approx([task.lift, 0.0, 0.0, 0.0], abs=1e-12)
        assert (moved[:, :2] == 0.0).all()


def test_what_is_measured_of_a_method(bulk_carrier: Hull, found: dict[str, Task]) -> None:
    """Additive functions on the bulb: what is told agrees with what is known of them."""
    task = found["bulb +0.5 m"]
    lay, blend = METHODS["additive, quintic"]
    layer = lay(task, blend)
    assert isinstance(layer, AdditiveLayer)
    it = fared(bulk_carrier.document.state, task, layer)
    steepest = blend.steepest * task.lift / (task.z - task.low)
    least = 1.0 - blend.steepest * task.lift / (task.high - task.z)
    assert it.least == pytest.approx(least, abs=1e-4)
    assert steepest > 1.0 - it.least
    assert it.most == pytest.approx(task.lift, abs=1e-3)
    assert 0.0 < it.spill < 1.0
    assert 0.9 < it.median < it.worst < 1.5


def test_a_plan_is_made_of_any_method(found: dict[str, Task]) -> None:
    """Weights of a layer that adds are those of its map."""
    task = found["shaft +1.0 m"]
    for lay, blend in METHODS.values():
        layer = lay(task, blend)
        assert (
            FieldPlan.of([layer], XYZ).places([1.0]).tobytes()
            == VariationMap((layer,))(XYZ).tobytes()
        )
