"""Centroids with which a curve runs forward."""

import numpy as np
import pytest

from assoc_hull.geometry.form_curves.checks import forward_centroids
from assoc_hull.geometry.form_curves.curve import FormEnd, end_vertices
from assoc_hull.geometry.form_curves.integrals import middle_vertex, with_middle
from assoc_hull.geometry.form_curves.shape import least_rate
from tests.form_curves import CURVES


def least(ends: np.ndarray, area: np.ndarray, centroid: np.ndarray) -> np.ndarray:
    """The least dx/dt of the curves that are made."""
    vertex = middle_vertex(ends, area, centroid)[0]
    return least_rate(with_middle(ends, vertex[:, 0], vertex[:, 1]), 0)


def test_the_interval_is_the_whole_of_it() -> None:
    """Of random ends: forward at every centroid inside, nowhere just outside; else at none."""
    rng = np.random.default_rng(3)
    count = 300
    length, height = rng.uniform(0.5, 1.0, (2, count))
    angles = np.radians(rng.uniform(0.0, 60.0, (2, count)))
    pace = np.hypot(length, height) / 4.0 * rng.uniform(0.3, 2.0, (2, count))
    start = FormEnd.of(0.0, 0.0, angles[0], 0.0, pace[0])
    ends = np.concatenate(
        [end_vertices(start), end_vertices(FormEnd.of(length, height, angles[1], 0.0, pace[1]))],
        axis=1,
    )
    area = length * height * rng.uniform(0.35, 0.65, count)
    low, high = forward_centroids(ends, area).T
    some = np.isfinite(low)
    assert 50 < some.sum() < count
    inside = [low + share * (high - low) for share in (1e-6, 0.03, 0.5, 0.97, 1.0 - 1e-6)]
    for centroid in inside:
        assert (least(ends, area, centroid)[some] > -1e-9).all()
    for centroid in (low - 1e-3, high + 1e-3):
        assert not (least(ends, area, centroid)[some] >= 0.0).any()
    for centroid in np.linspace(0.2, 0.9, 29):
        assert not (least(ends, area, centroid * length)[~some] >= 0.0).any()


@pytest.mark.parametrize(("name", "inside"), [("T1_run", True), ("T2_run", False)])
def test_published_runs(name: str, inside: bool) -> None:
    """One runs forward, and its centroid lies in the interval; one runs back by a trifle."""
    ends = np.delete(np.array(CURVES[name]["P"]), 3, axis=0)[None]
    given = CURVES[name]["inp"]
    low, high = forward_centroids(ends, np.array([given["A"]]))[0]
    assert (low <= given["Xc"] <= high) == inside
