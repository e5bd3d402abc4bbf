"""Compiled looks at points and lines of a hull beside those of numpy."""

from __future__ import annotations

from unittest import mock

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from assoc_hull.analysis.hydrostatics.accuracy import (
    are_plainly_sound,
    doubtful_lines,
    open_sections,
)
from assoc_hull.analysis.hydrostatics.flotation import Flotation, flotation
from assoc_hull.edit.mapped_planes import carry_planes
from assoc_hull.edit.recut.carried_points import PointImages, point_images
from assoc_hull.edit.space_map import SpaceMap
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.model.tables import HullState
from tests.conftest import Shipped
from tests.long_forms import draws

pytest.importorskip("numba")

SHIPS = ["bulk_carrier", "series60_70", "wigley"]
COMPILED = "assoc_hull.edit.recut.carried_points.is_compiled"


def bulge(by: float, slope: float) -> SpaceMap:
    """A map that widens the ship by parts, and leans its sections."""

    def image(xyz: FloatArray) -> FloatArray:
        x, y, z = xyz.T
        return np.column_stack([x + slope * z, y * (1.0 + by * np.tanh(z / 5.0)), z])

    return SpaceMap(image)


def images(state: HullState, space: SpaceMap, *, quick: bool) -> PointImages:
    """Where points go; all lines drive."""
    drivers = state.live("lines")
    planes = carry_planes(state, space, drivers, follow=True)
    drives = np.ones(state.lines.count, bool)
    with mock.patch(COMPILED, return_value=quick):
        return point_images(state, space, planes, drives)


@pytest.mark.parametrize("name", SHIPS)
@settings(max_examples=4, deadline=None)
@given(by=st.floats(-0.05, 0.05), slope=st.sampled_from([0.0, 0.01]))
def test_points_go_where_numpy_sends_them(
    name: str, shipped: Shipped, by: float, slope: float
) -> None:
    """To the bit, and told alike which lie in their planes."""
    state, space = shipped(name).state, bulge(by, slope)
    quick, usual = (images(state, space, quick=each) for each in (True, False))
    for field in ("image", "value", "direct", "still", "known", "slope"):
        one, other = getattr(quick, field), getattr(usual, field)
        live = state.live("rows")
        assert one[live].tobytes() == other[live].tobytes(), field


def test_a_map_that_folds_is_refused_by_both(shipped: Shipped) -> None:
    """With the same words."""
    state = shipped("wigley").state
    turned = np.diag([1.0, 1.0, -1.0])
    folded = SpaceMap(lambda xyz: xyz, lambda xyz: np.tile(turned, (len(xyz), 1, 1)))
    told = set[str]()
    for quick in (True, False):
        with pytest.raises(BadInputError, match="folds") as error:
            images(state, folded, quick=quick)
        told.add(str(error.value))
    assert len(told) == 1


def draught(body: Flotation) -> FloatingPlanes:
    """The plane at the design draught."""
    return FloatingPlanes(np.array([body.particulars.draught]), np.zeros(1), np.zeros(1))


def plainly(body: Flotation) -> bool:
    """What compiled code says."""
    curves = body.known_stations.curve
    return are_plainly_sound(body.net, body.layout, curves, body.kinds, draught(body))


def doubts(body: Flotation) -> list[str]:
    """What numpy says."""
    return [
        *open_sections(body.net, body.sections, draught(body)),
        *doubtful_lines(body.net, body.layout, body.sections, body.kinds),
    ]


def with_places(body: Flotation, xyz: FloatArray) -> Flotation:
    """The same hull with its lines led through other places; slopes as they were."""
    was = body.net.batch
    batch = SplineBatch(was.start, was.knot, xyz, was.leave, was.arrive)
    return attrs.evolve(body, net=attrs.evolve(body.net, batch=batch))


@pytest.mark.parametrize("name", SHIPS)
def test_sound_ships_are_plainly_sound(name: str, shipped: Shipped) -> None:
    """So that the quick look is worth while."""
    body = flotation(shipped(name).state)
    assert doubts(body) == []
    assert plainly(body)


@pytest.mark.parametrize("name", SHIPS)
@settings(max_examples=draws(12), deadline=None)
@given(seed=st.integers(0, 10**6), size=st.sampled_from([1e-4, 0.02, 0.3, 3.0]))
def test_what_is_plainly_sound_is_doubted_by_nobody(
    name: str, shipped: Shipped, seed: int, size: float
) -> None:
    """Lines with one point out of place: kinks, open ends, lines that pass one another."""
    body = flotation(shipped(name).state)
    spread = np.random.default_rng(seed)
    xyz = body.net.batch.xyz.copy()
    some = spread.integers(0, len(xyz), 2)
    xyz[some, 1:] += spread.normal(size=(2, 2)) * size
    odd = with_places(body, xyz)
    if plainly(odd):
        assert doubts(odd) == []


def test_faults_are_not_plainly_sound(shipped: Shipped) -> None:
    """A section that begins off the centre plane, and one with a hook."""
    body = flotation(shipped("wigley").state)
    start = body.net.batch.start
    section = int(body.known_stations.curve[len(body.known_stations.curve) // 2])
    for point, step in ((start[section], 1.0), (start[section] + 3, -4.0)):
        xyz = body.net.batch.xyz.copy()
        xyz[point, 1] += step
        odd = with_places(body, xyz)
        assert doubts(odd) != []
        assert not plainly(odd)
