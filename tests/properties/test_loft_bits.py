"""A curve has the same bits alone and in any batch."""

from collections.abc import Iterator

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from assoc_hull.geometry.curves import CurveData, SplineBatch
from assoc_hull.geometry.splines.backend import backend, set_backend
from assoc_hull.geometry.splines.loft import loft, loft_with_signed_zeros
from assoc_hull.geometry.splines.plane_intersections import intersect_planes
from tests.long_forms import draws

FIELDS = ("knot", "xyz", "leave", "arrive")
NORMALS = [(1.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.48, 0.6, 0.64)]


@pytest.fixture(autouse=True, scope="module", params=["numpy", "numba"])
def backend_in_use(request: pytest.FixtureRequest) -> Iterator[None]:
    """Every test of this file holds for both backends."""
    if request.param == "numba":
        pytest.importorskip("numba")
    before = backend()
    set_backend(request.param)
    yield
    set_backend(before)


def curve_data(seed: int, count: int) -> CurveData:
    """A random curve with all kinds of points and ends, wild or smooth; often in a plane.

    Directions along an axis have zeros of both signs, as those have that a tangent was read from.
    """
    rng = np.random.default_rng(seed)
    walk = rng.normal(size=(count, 3)) + np.eye(3)[0]
    xyz = np.cumsum(walk, axis=0) if rng.random() < 0.5 else walk * 10.0 ** rng.integers(-2, 4)
    direction, ends = rng.normal(size=(count, 3)), rng.normal(size=(1, 2, 3))
    if rng.random() < 0.5:
        xyz[:, 2] = rng.choice([0.0, 3.0])
        for vectors in (direction, ends[0]):
            vectors[:, 1:] = rng.choice([0.0, -0.0, 1.0], (len(vectors), 2))
            vectors[:, 0] = rng.choice([1.0, -1.0], len(vectors))
    return CurveData(
        np.array([0, count]),
        xyz,
        rng.choice(3, count, p=[0.8, 0.1, 0.1]).astype(np.int8),
        direction,
        rng.integers(0, 3, (1, 2)).astype(np.int8),
        ends,
    )


def joined(parts: list[CurveData]) -> CurveData:
    """One batch of all the curves."""
    return CurveData(
        np.cumsum([0, *[len(part.xyz) for part in parts]]),
        np.concatenate([part.xyz for part in parts]),
        np.concatenate([part.kind for part in parts]),
        np.concatenate([part.direction for part in parts]),
        np.concatenate([part.end_kind for part in parts]),
        np.concatenate([part.end_vector for part in parts]),
    )


def same_bits(one: SplineBatch, other: SplineBatch) -> bool:
    """Whether two batches agree in every bit."""
    return all(getattr(one, name).tobytes() == getattr(other, name).tobytes() for name in FIELDS)


seeds = st.integers(0, 2**32 - 1)
counts = st.lists(
    st.one_of(st.integers(2, 6), st.integers(2, 70), st.integers(60, 300)), min_size=1, max_size=8
)


@settings(max_examples=draws(60), deadline=None)
@given(seeds, counts)
def test_a_curve_alone_has_the_bits_it_has_in_a_batch(seed: int, sizes: list[int]) -> None:
    """Equal defining data give equal bits, whatever else is in the batch."""
    parts = [curve_data(seed + index, size) for index, size in enumerate(sizes)]
    batch = loft(joined(parts))
    for index, part in enumerate(parts):
        assert same_bits(loft(part), batch.curve(index))


@settings(max_examples=draws(60), deadline=None)
@given(seeds, counts)
def test_zeros_of_derivatives_have_no_sign(seed: int, sizes: list[int]) -> None:
    """Those of versions before had, and are the same splines but for that."""
    data = joined([curve_data(seed + index, size) for index, size in enumerate(sizes)])
    spline, before = loft(data), loft_with_signed_zeros(data)
    for name in ("leave", "arrive"):
        one, other = getattr(spline, name), getattr(before, name)
        assert (one == other).all()
        assert not np.signbit(one[one == 0.0]).any()


@settings(max_examples=draws(60), deadline=None)
@given(seeds, counts, st.sampled_from(NORMALS))
def test_meetings_alone_have_the_bits_they_have_in_a_batch(
    seed: int, sizes: list[int], normal: tuple[float, float, float]
) -> None:
    """The meetings of a curve do not depend on the other curves."""
    parts = [curve_data(seed + index, size) for index, size in enumerate(sizes)]
    batch = loft(joined(parts))
    offsets = np.sort(np.concatenate([np.linspace(-20, 20, 15), batch.xyz[::7, 0]]))
    together = intersect_planes(batch, np.array(normal), offsets)
    for index in range(batch.count):
        alone = intersect_planes(batch.curve(index), np.array(normal), offsets)
        mine = together.curve == index
        assert np.array_equal(alone.plane, together.plane[mine])
        assert np.array_equal(alone.sign, together.sign[mine])
        assert np.array_equal(alone.tangential, together.tangential[mine])
        assert alone.t.tobytes() == together.t[mine].tobytes()
        assert alone.xyz.tobytes() == together.xyz[mine].tobytes()
        assert np.array_equal(alone.segment + batch.start[index], together.segment[mine])


@settings(max_examples=draws(60), deadline=None)
@given(seeds, counts, st.sampled_from(NORMALS))
def test_both_backends_give_the_same_bits(
    seed: int, sizes: list[int], normal: tuple[float, float, float]
) -> None:
    """numpy does exactly what the backend in use does, splines and meetings alike."""
    data = joined([curve_data(seed + index, size) for index, size in enumerate(sizes)])
    mine = loft(data)
    offsets = np.sort(np.concatenate([np.linspace(-20, 20, 15), mine.xyz[::7, 0]]))
    met = intersect_planes(mine, np.array(normal), offsets)
    in_use = backend()
    set_backend("numpy")
    try:
        assert same_bits(mine, loft(data))
        again = intersect_planes(mine, np.array(normal), offsets)
    finally:
        set_backend(in_use)
    for name in ("curve", "plane", "segment", "t", "xyz", "sign", "tangential"):
        assert getattr(met, name).tobytes() == getattr(again, name).tobytes()


@settings(max_examples=draws(60), deadline=None)
@given(seeds, st.integers(2, 40))
def test_signs_alternate_on_any_curve(seed: int, count: int) -> None:
    """Also with planes through knots and as close as rounding allows, signs alternate."""
    spline = loft(curve_data(seed, count))
    levels = spline.xyz[:, 1]
    offsets = np.sort(np.concatenate([levels, np.nextafter(levels, 9e9), levels + 3e-10]))
    meetings = intersect_planes(spline, np.array([0.0, 1.0, 0.0]), offsets)
    same = np.diff(meetings.plane) == 0
    assert (meetings.sign[1:][same] == -meetings.sign[:-1][same]).all()
    assert (np.diff(meetings.t)[same] >= 0.0).all()
    first = np.append(True, ~same)[: meetings.count]
    below = levels[0] < offsets[meetings.plane[first]]
    assert (meetings.sign[first] == np.where(below, 1, -1)).all()
