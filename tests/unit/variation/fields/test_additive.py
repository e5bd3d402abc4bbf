"""Additive functions: products of functions of one coordinate each, and whether they fold."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import minimize_scalar

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.certificate.fold_check import certify
from assoc_hull.variation.fields.bounded_functions import (
    CUBIC,
    QUINTIC,
    Blend,
    BlendChain,
    BoundedFunction,
    Polynomial,
    Ramp,
)
from assoc_hull.variation.fields.layers import AdditiveLayer
from assoc_hull.variation.fields.space_map import VariationMap

HALF = 16.1
"""Half-breadth, m, of the hull that is made broader."""

BOX = np.array([[-10.0, -20.0, 0.0], [110.0, 20.0, 18.0]])


def blends() -> pytest.MarkDecorator:
    """Both blends."""
    return pytest.mark.parametrize("blend", [CUBIC, QUINTIC], ids=["cubic", "quintic"])


def full(lift: float = 1.0, blend: Blend = QUINTIC) -> AdditiveLayer:
    """A layer in which all seven functions act, of all three kinds."""
    return AdditiveLayer(
        "full",
        BlendChain.through([0, 40, 100], [0, 2, 0], blend),
        (BlendChain.through([10, 60], [1, 0], blend), Ramp(1.0, 4.0, 0.1, blend),
         BlendChain.through([4, 9], [1, 0], blend)),
        (BlendChain.through([6, 66], [lift, 0], blend), Polynomial.of([1, 0, -1e-3]),
         BlendChain.through([0, 5, 18], [0, 1, 0], blend)),
    )  # fmt: skip


@pytest.mark.parametrize(("blend", "part"), [(CUBIC, 0.0962250449), (QUINTIC, 0.1467491452)])
def test_a_blend_over_the_half_breadth_is_no_scaling(blend: Blend, part: float) -> None:
    """It leaves exact scaling by the printed part of what the side moves."""
    edge = 0.4
    rise = BlendChain.through([0.0, HALF], [0.0, edge], blend)
    layer = AdditiveLayer("B", y=(BlendChain.constant(1.0), rise, BlendChain.constant(1.0)))

    def away(y: float) -> float:
        moved = layer.displacement(np.array([[50.0, y, 5.0]]))[0, 1]
        return -abs(float(moved) - edge * y / HALF)

    for low, high in ((0.0, 0.5), (0.5, 1.0)):
        worst = -minimize_scalar(
            away, bounds=(low * HALF, high * HALF), method="bounded", options={"xatol": 1e-9}
        ).fun
        assert worst / edge == pytest.approx(part, abs=0.6e-10)


def test_the_half_breadth_itself_scales_exactly() -> None:
    """With F3(y) = y the method has an affine part: B alone, to one rounding."""
    one = BlendChain.constant(1.0)
    layer = AdditiveLayer("B", y=(one, Polynomial.of([0.0, 0.03]), one))
    y = np.random.default_rng(7).uniform(-HALF, HALF, 1000)
    xyz = np.stack([np.full(1000, 50.0), y, np.full(1000, 5.0)], axis=1)
    assert np.abs(VariationMap((layer,))(xyz)[:, 1] - 1.03 * y).max() <= np.spacing(HALF)


@blends()
def test_outside_the_region_no_bit_changes(blend: Blend) -> None:
    """Displacement nil and unit Jacobian; the regions name the box."""
    layer = full(blend=blend)
    xyz = np.array([[-3.0, 7.1, 18.0], [100.0, -7.1, 5.0], [300.0, 0.1, 0.3], [101.5, 3.0, 20.0]])
    assert VariationMap((layer,))(xyz).tobytes() == xyz.tobytes()
    assert (layer.jacobian(xyz) == np.eye(3)).all()
    along, athwart, up = layer.regions()
    assert (along.x, along.z) == ((0.0, 100.0), (-np.inf, np.inf))
    assert (athwart.x, athwart.z) == ((-np.inf, 60.0), (-np.inf, 9.0))
    assert (up.x, up.z) == ((-np.inf, 66.0), (0.0, 18.0))


def test_the_centre_plane_stays() -> None:
    """Places at y = 0 move within the plane; an F3 that moves it is refused."""
    xyz = np.array([[20.0, 0.0, 5.0]])
    assert full().displacement(xyz)[0, 1] == 0.0
    with pytest.raises(BadInputError, match="moves the centre plane"):
        AdditiveLayer(
            "off", y=(BlendChain.constant(1.0), BlendChain.constant(1.0), BlendChain.constant(1.0))
        )


def test_both_sides_of_the_ship_stay_alike() -> None:
    """Starboard is the mirror of port."""
    xyz = np.random.default_rng(1).uniform(BOX[0], BOX[1], (200, 3))
    mirror = np.array([1.0, -1.0, 1.0])
    moved = full().displacement(xyz)
    assert (full().displacement(xyz * mirror) == moved * mirror).all()


@blends()
def test_the_jacobian_is_the_derivative(blend: Blend) -> None:
    """It agrees with central differences."""
    layer, h = full(blend=blend), 1e-5
    xyz = np.random.default_rng(2).uniform(BOX[0], BOX[1], (300, 3))
    found = layer.jacobian(xyz)
    for axis in range(3):
        step = h * np.eye(3)[axis]
        ahead, behind = xyz + step, xyz - step
        slope = (layer.displacement(ahead) - layer.displacement(behind)) / (2 * h)
        assert found[:, :, axis] - np.eye(3)[axis] == pytest.approx(slope, abs=1e-7)


@blends()
@pytest.mark.parametrize("lift", [1.0, -2.0])
def test_the_inverse_finds_back(blend: Blend, lift: float) -> None:
    """Images come back to 1e-12 m on a layer that is certified; others keep their bits."""
    layer = full(lift, blend)
    assert certify(layer, BOX).certified
    xyz = np.random.default_rng(4).uniform(BOX[0], BOX[1], (500, 3))
    vmap = VariationMap((layer,))
    assert np.abs(vmap.inverse(vmap(xyz)) - xyz).max() < 1e-12
    outside = np.array([[300.0, 4.0, 5.0], [-50.0, 4.0, 19.0]])
    assert vmap.inverse(outside).tobytes() == outside.tobytes()


@given(
    st.lists(st.floats(-3, 3), min_size=1, max_size=6),
    st.floats(-4, 4),
    st.floats(0.0, 5.0),
)
def test_bounds_of_polynomials_are_exact(c: list[float], low: float, width: float) -> None:
    """Dense samples of values and slopes lie within the bounds and come close to them."""
    held(Polynomial.of(c), low, low + width)


@given(
    st.floats(-3, 3), st.floats(0.1, 4), st.booleans(), st.floats(-3, 3), st.floats(-4, 4),
    st.floats(0.0, 5.0),
)  # fmt: skip
def test_bounds_of_ramps_are_exact(
    begin: float, width: float, back: bool, slope: float, low: float, span: float
) -> None:
    """Dense samples of values and slopes lie within the bounds and come close to them."""
    held(Ramp(begin, -width if back else width, slope), low, low + span)


def held(course: BoundedFunction, low: float, high: float) -> None:
    """Check bounds of a course on an interval against samples."""
    x = np.linspace(low, high, 4001)
    for sampled, (least, most) in (
        (course.at(x), course.bounds(np.array(low), np.array(high))),
        (course.slope(x), course.slope_bounds(np.array(low), np.array(high))),
    ):
        size = 1.0 + np.abs(sampled).max()
        assert least <= sampled.min() + 1e-12 * size
        assert most >= sampled.max() - 1e-12 * size
        assert sampled.min() - least < 1e-2 * size
        assert most - sampled.max() < 1e-2 * size


def minors(layer: AdditiveLayer, count: int = 40) -> FloatArray:
    """All principal minors on a grid of the box, (k, 7)."""
    axes = [np.linspace(low, high, count) for low, high in zip(*BOX, strict=True)]
    xyz = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    j = layer.jacobian(xyz)
    kept = [[0], [1], [2], [0, 1], [0, 2], [1, 2], [0, 1, 2]]
    return np.stack([np.linalg.det(j[:, k][:, :, k]) for k in kept], axis=1)


@pytest.mark.parametrize("lift", [1.0, 2.0, -2.0])
def test_a_certified_layer_has_no_minor_below_its_bound(lift: float) -> None:
    """The bound holds on a grid, and is close to the least minor of one coordinate there."""
    layer = full(lift)
    found, sampled = certify(layer, BOX), minors(layer)[:, [0, 1, 2, 5]].min()
    assert found.certified
    assert found.bound <= found.least <= sampled + 1e-12
    assert sampled - found.bound < 0.06


@pytest.mark.parametrize("lift", [-3.0, 8.0, -4.0])
def test_a_refused_layer_has_a_witness(lift: float) -> None:
    """At the place that is named, the minor that is named has the value that is named."""
    layer = full(lift)
    found = certify(layer, BOX)
    assert found.reason == "folds"
    assert found.least <= minors(layer)[:, [0, 1, 2, 5]].min() + 1e-3
    j = layer.jacobian(np.array([found.witness]))[0]
    value = {"X_x": j[0, 0], "Y_y": j[1, 1], "Z_z": j[2, 2]}.get(
        found.minor, j[1, 1] * j[2, 2] - j[1, 2] * j[2, 1]
    )
    assert value == pytest.approx(found.least, abs=1e-12)


@blends()
def test_the_interval_of_a_hump_is_found(blend: Blend) -> None:
    """A hump of D over 5 m below and 13 m above holds up to 13 / max b', to the last per cent."""
    one, hump = BlendChain.constant(1.0), BlendChain.through([0, 5, 18], [0, 1, 0], blend)
    most = 13.0 / blend.steepest
    for part, holds in ((0.99, True), (1.01, False)):
        layer = AdditiveLayer("hump", z=(BlendChain.constant(part * most), one, hump))
        assert certify(layer, BOX, least=0.0).certified is holds


def test_the_determinant_of_the_block_counts() -> None:
    """Slopes of one coordinate that are all positive do not make a map one to one."""
    one = BlendChain.constant(1.0)
    layer = AdditiveLayer(
        "swirl",
        y=(one, Polynomial.of([0.0, 1.0]), Polynomial.of([0.0, 0.2])),
        z=(one, Polynomial.of([0.0, 0.3]), Polynomial.of([1.0])),
    )
    box = np.array([[0.0, 0.0, 0.0], [1.0, 20.0, 10.0]])
    found = certify(layer, box)
    assert (found.reason, found.minor) == ("folds", "D")
    j = layer.jacobian(np.random.default_rng(3).uniform(box[0], box[1], (1000, 3)))
    assert min(j[:, i, i].min() for i in range(3)) > 0.0


def test_a_margin_thinner_than_a_rounding_is_undecided() -> None:
    """A minor that is the margin itself over a whole box can be neither shown nor refuted."""
    one = BlendChain.constant(1.0)
    layer = AdditiveLayer("thin", z=(one, one, Polynomial.of([0.0, -0.95])))
    found = certify(layer, [[0, 0, 0], [1, 1, 1]], least=1.0 - 0.95)
    assert found.reason == "undecided"
    assert not found.certified


@pytest.mark.parametrize(
    "make",
    [
        lambda: Ramp(0.0, 0.0),
        lambda: Ramp(float("nan"), 1.0),
        lambda: Polynomial.of([]),
        lambda: Polynomial.of([1.0, float("inf")]),
    ],
)
def test_functions_are_checked(make: object) -> None:
    """What is no ramp and no polynomial is refused."""
    assert callable(make)
    with pytest.raises(BadInputError, match="in vary"):
        make()
