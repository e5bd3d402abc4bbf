"""The middle vertex: by area and centroid, fairest, and where there is none."""

from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from scipy.optimize import minimize

from assoc_hull.errors import DegenerateEndsError, NoMiddleVertexError
from assoc_hull.geometry.form_curves.curve import FormEnd, end_vertices, form_values, form_vertices
from assoc_hull.geometry.form_curves.integrals import (
    area_vertex,
    centroid_limit,
    fair_vertex,
    form_integrals,
    middle_vertex,
    only_area,
    required_middle,
    with_middle,
)
from assoc_hull.geometry.form_curves.shape import form_energy, least_rate
from tests.exact_curves import integrals, on_the_line
from tests.form_curves import CURVES

COUNT = 3000


class Drawn:
    """Curves of unit size that rise by their ends: both not steep at once, any curvature, pace."""

    def __init__(self, seed: int) -> None:
        rng = np.random.default_rng(seed)
        x, y = rng.uniform(-1.0, 0.0, COUNT), rng.uniform(0.0, 0.3, COUNT)
        length, height = rng.uniform(0.5, 1.0, (2, COUNT))
        steep = rng.uniform(0.0, 90.0, COUNT)
        level = rng.uniform(0.0, 1.0, COUNT) * (90.0 - steep)
        turned = rng.random(COUNT) < 0.5
        angles = np.radians([np.where(turned, level, steep), np.where(turned, steep, level)])
        bends = rng.uniform(-2.0, 2.0, (2, COUNT))
        paces = np.hypot(length, height) / 4.0 * rng.uniform(0.2, 0.8, (2, COUNT))
        full = rng.uniform(0.3, 0.7, COUNT)
        self.area = length * (y + full * height)
        low = 0.5 * length**2 * (y + height * full**2)
        high = 0.5 * length**2 * (y + height * full * (2.0 - full))
        at = rng.uniform(0.2, 0.8, COUNT)
        self.centroid = x + (low + at * (high - low)) / self.area
        self.start = FormEnd.of(x, y, angles[0], bends[0], paces[0])
        self.finish = FormEnd.of(x + length, y + height, angles[1], bends[1], paces[1])
        self.ends = np.concatenate([end_vertices(self.start), end_vertices(self.finish)], axis=1)
        self.vertices = form_vertices(self.start, self.finish, self.area, self.centroid)
        self.made = np.isfinite(self.vertices[:, 3]).all(axis=1)


@pytest.fixture(scope="module")
def drawn() -> Drawn:
    """The same curves for all tests."""
    return Drawn(4)


def test_all_twelve_parameters_are_met(drawn: Drawn) -> None:
    """3,000 drawn curves: what is made has all parameters to 1e-12, at most a tenth is refused."""
    assert np.mean(~drawn.made) < 0.1
    found = form_values(drawn.vertices[drawn.made])
    pairs = [
        (getattr(got, name), getattr(want, name)[drawn.made])
        for got, want in ((found.start, drawn.start), (found.finish, drawn.finish))
        for name in ("x", "y", "angle", "curvature", "tangent", "stretch")
    ]
    pairs += [(found.area, drawn.area[drawn.made]), (found.centroid, drawn.centroid[drawn.made])]
    for got, want in pairs:
        assert np.abs(got - want).max() < 1e-12


def test_area_and_centroid_in_whole_numbers(drawn: Drawn) -> None:
    """Nothing is rounded in this check: a sample, and the curves of the farthest vertices."""
    far = np.argsort(-np.where(drawn.made, np.abs(drawn.vertices[:, 3]).max(axis=1), 0.0))[:60]
    for row in {*far.tolist(), *np.flatnonzero(drawn.made)[::20].tolist()}:
        area, moment = integrals(drawn.vertices[row])
        assert abs(float(area) - drawn.area[row]) < 1e-12
        assert abs(float(moment / area) - drawn.centroid[row]) < 1e-12


def test_every_refusal_is_proved(drawn: Drawn) -> None:
    """In whole numbers, too, the equation for the middle vertex has no root."""
    refused = np.flatnonzero(~drawn.made)
    told = middle_vertex(drawn.ends, drawn.area, drawn.centroid)[1]
    assert len(refused) > 50
    for row in refused.tolist():
        line = on_the_line(drawn.ends[row], drawn.area[row])
        want = line.discriminant(Fraction(drawn.area[row]) * Fraction(drawn.centroid[row]))
        assert want < 0
        assert told[row] == pytest.approx(float(want), rel=1e-9, abs=1e-12)


def test_if_a_root_runs_forward_it_is_the_nearest(drawn: Drawn) -> None:
    """The choice: the far root gives no curve whose abscissa rises where the near one does not."""
    other = drawn.vertices.copy()
    other[:, 3] = middle_vertex(drawn.ends, drawn.area, drawn.centroid, other=True)[0]
    near, far = (least_rate(each, 0) >= 0.0 for each in (drawn.vertices, other))
    assert near.any()
    assert not (far & ~near).any()


def test_bits_alone_and_in_company(drawn: Drawn) -> None:
    """A curve has the same bits whatever else is in its batch."""
    fields = ("x", "y", "angle", "curvature", "tangent", "stretch")
    sums = form_integrals(drawn.vertices)
    for rows in (slice(7, 8), slice(1000, 1003), slice(2990, 3000), slice(0, 500)):
        start, finish = (
            FormEnd(*(getattr(end, name)[rows] for name in fields))
            for end in (drawn.start, drawn.finish)
        )
        alone = form_vertices(start, finish, drawn.area[rows], drawn.centroid[rows])
        assert alone.tobytes() == drawn.vertices[rows].tobytes()
        assert form_integrals(alone).moment_y.tobytes() == sums.moment_y[rows].tobytes()
        assert form_integrals(alone).moment.tobytes() == sums.moment[rows].tobytes()


def _type1_run() -> np.ndarray:
    return np.delete(np.array(CURVES["T1_run"]["P"]), 3, axis=0)[None]


def test_a_centroid_that_cannot_be_met() -> None:
    """The run of type 1 cannot have its centroid at -0.3; what is named can just be had."""
    ends, area = _type1_run(), np.array([0.55])
    with pytest.raises(NoMiddleVertexError) as caught:
        required_middle(ends, area, np.array([-0.3]), "the run")
    error = caught.value
    assert error.where == "the run"
    assert error.discriminant < 0.0
    assert error.nearest < -0.3
    assert centroid_limit(ends, area)[0] == error.nearest
    for off, made in ((-1e-6, True), (1e-6, False)):
        vertex, disc = middle_vertex(ends, area, np.array([error.nearest + off]))
        assert np.isfinite(vertex).all() == made
        assert (disc[0] >= 0.0) == made


def test_ends_that_leave_no_say() -> None:
    """Where opposite vertices coincide the area does not depend on the middle one: an error."""
    ends = np.array([[[0.0, 0.0], [1, 0], [1, 1], [1, 1], [1, 0], [0, 0]]])
    assert only_area(ends)[0] == form_integrals(with_middle(ends, 3.0, -2.0)).area[0]
    for centroid in (None, np.array([0.5])):
        with pytest.raises(DegenerateEndsError) as caught:
            required_middle(ends, np.array([0.3]), centroid)
        assert caught.value.only == only_area(ends)[0]


def test_a_straight_curve_is_made() -> None:
    """Its moment does not change along the line of equal area: the nearest vertex is taken."""
    ends = np.array([[[-1.0, 0], [0, 0], [1, 0], [3, 1], [4, 1], [5, 1]]])
    straight = np.array([[[0.1 * k, 0.2 * k] for k in (0, 1, 2, 4, 5, 6)]])
    for each, middle in ((ends, [2.0, 0.5]), (straight, [0.3, 0.6])):
        found = form_integrals(with_middle(each, *middle))
        vertex, disc = middle_vertex(each, found.area, found.moment / found.area)
        assert vertex[0] == pytest.approx(middle, abs=1e-7)
        assert disc[0] >= 0.0


def test_one_root_where_the_lever_is_upright() -> None:
    """With D_x = 0 the equation is linear, and its one root meets both."""
    ends = np.array([[[0, 0], [0.2, 0.1], [0.5, 0.3], [0.5, 0.8], [0.225, 0.9], [-1.4, 1.2]]])
    want = with_middle(ends, 0.7, 0.6)
    found = form_integrals(want)
    vertex, _ = middle_vertex(ends, found.area, found.moment / found.area)
    assert vertex[0] == pytest.approx([0.7, 0.6], abs=1e-12)
    other, _ = middle_vertex(ends, found.area, found.moment / found.area, other=True)
    assert np.isnan(other).all()


@pytest.mark.parametrize(("order", "kind"), [(2, "E2"), (3, "E3")])
def test_fairest_vertices_are_stationary(order: int, kind: str) -> None:
    """No step from them lowers the energy, and the known rows vanish on their curves."""
    rng = np.random.default_rng(order)
    ends = rng.uniform(-1.0, 1.0, (20, 6, 2))
    middle = fair_vertex(ends, order)
    curves = with_middle(ends, middle[:, 0], middle[:, 1])
    least = form_energy(curves, kind)
    for step in ((1e-4, 0.0), (-1e-4, 0.0), (0.0, 1e-4), (0.0, -1e-4)):
        moved = with_middle(ends, middle[:, 0] + step[0], middle[:, 1] + step[1])
        assert (form_energy(moved, kind) > least).all()
    row = {2: [1, 0, -9, 16, -9, 0, 1], 3: [-1, 6, -15, 20, -15, 6, -1]}[order]
    assert np.abs(np.einsum("k,nkx->nx", np.array(row, float), curves)).max() < 1e-13


def test_the_fairest_vertex_of_an_area() -> None:
    """It is where a minimiser on the line of equal area ends."""
    ends = np.random.default_rng(6).uniform(-1.0, 1.0, (1, 6, 2))
    area = np.array([0.37])
    vertex = area_vertex(ends, area)[0]
    assert form_integrals(with_middle(ends, *vertex)).area[0] == pytest.approx(0.37, abs=1e-14)
    free = fair_vertex(ends)[0]
    way = np.array([vertex[1] - free[1], free[0] - vertex[0]])

    def cost(s: np.ndarray) -> float:
        return float(form_energy(with_middle(ends, *(vertex + s[0] * way)), "E3")[0])

    found: Any = minimize(cost, [0.3])
    assert found.x[0] == pytest.approx(0.0, abs=1e-6)
