"""Tangent lengths by fairness."""

import math
from typing import Any

import numpy as np
import pytest
from scipy.optimize import minimize

from assoc_hull.geometry.form_curves.chain import FormChain, straight_vertices
from assoc_hull.geometry.form_curves.curve import FormEnd, form_vertices
from assoc_hull.geometry.form_curves.integrals import form_integrals
from assoc_hull.geometry.form_curves.shape import (
    FASTEST,
    SLOWEST,
    chord_lengths,
    fairest_tangents,
    form_energy,
    least_rate,
    usual_tangents,
)
from tests.cases import versluis
from tests.form_curves import BULK_CARRIER, CURVES

FULL = 292.59

# Tangents and energy as printed; in two of them the search went beyond its bounds by a trifle.
FAIREST = {
    "T1_run": (0.062258, 0.330483, 0.924065),
    "T1_ent": (0.337018, 0.048023, 0.963007),
    "T2_run": (0.084975, 0.538381, 1.036301),
    "T2_ent": (0.317626, 0.055741, 1.601644),
}


def given(name: str) -> tuple[FormEnd, FormEnd, np.ndarray, np.ndarray]:
    """A curve of table 2, without its tangents."""
    g = CURVES[name]["inp"]
    start = FormEnd.of(g["x0"], g["y0"], g["a0"], g["k0"])
    return (
        start,
        FormEnd.of(g["x1"], g["y1"], g["a1"], g["k1"]),
        np.array([g["A"]]),
        np.array([g["Xc"]]),
    )


def made(name: str, tangents: np.ndarray) -> np.ndarray:
    """The curve with tangents."""
    start, finish, area, centroid = given(name)
    start, finish = (
        FormEnd(e.x, e.y, e.angle, e.curvature, np.array([d]), e.stretch)
        for e, d in zip((start, finish), tangents, strict=True)
    )
    return form_vertices(start, finish, area, centroid)


@pytest.mark.parametrize("name", FAIREST)
def test_fairest_tangents_are_the_published_ones(name: str) -> None:
    """Tangents and energy to 1e-4; where the printed ones lie beyond a bound, with that bound."""
    first, last, least = FAIREST[name]
    curve = given(name)
    even = chord_lengths(*curve[:2])[0] / 4.0
    bounds = (min(SLOWEST, first / even, last / even), max(FASTEST, first / even, last / even))
    assert bounds == pytest.approx((SLOWEST, FASTEST), rel=5e-4)
    found = fairest_tangents(*curve, bounds=bounds)
    assert found.tangents[0] == pytest.approx([first, last], abs=2e-6)
    vertices = made(name, found.tangents[0])
    assert form_energy(vertices)[0] == pytest.approx(least, abs=5e-6)
    sums = form_integrals(vertices)
    assert sums.area == pytest.approx(curve[2], abs=1e-14)
    assert sums.moment / sums.area == pytest.approx(curve[3], abs=1e-14)


@pytest.mark.parametrize(
    ("name", "kind"),
    [("T1_run", "E3"), ("T1_ent", "E3"), ("T2_run", "E3"), ("T1_run", "J"), ("T2_ent", "E2")],
)
def test_no_simplex_finds_a_fairer_curve(name: str, kind: str) -> None:
    """The search of Nelder and Mead, from the middle of the range."""
    curve = given(name)
    found = fairest_tangents(*curve, kind)
    even, width = chord_lengths(*curve[:2])[0] / 4.0, (curve[1].x - curve[0].x)[0] / 4.0
    scale = 1.0 if kind == "J" else (4.0 * even) ** 2

    def cost(logs: np.ndarray) -> float:
        pace = np.exp(np.clip(logs, math.log(SLOWEST), math.log(FASTEST)))
        vertices = made(name, even * pace)
        slow = max(0.0, 0.02 - least_rate(vertices, 0)[0] / width)
        return float(form_energy(vertices, kind)[0] + scale * 1e3 * slow**2)

    options: Any = {"xatol": 1e-7, "fatol": 1e-10, "maxiter": 120}
    other = minimize(cost, np.log([0.5, 0.5]), method="Nelder-Mead", options=options)
    assert found.energy[0] < other.fun + 1e-9


def test_bounds_that_hold_are_told() -> None:
    """The entrance of type 2 wants a shorter tangent at its hollow end, its run a longer one."""
    found = fairest_tangents(*given("T2_ent"))
    assert found.at_bound.tolist() == [[False, True]]
    even = chord_lengths(*given("T2_ent")[:2])[0] / 4.0
    assert found.tangents[0, 1] == pytest.approx(SLOWEST * even, rel=1e-12)
    assert fairest_tangents(*given("T2_run")).at_bound.tolist() == [[False, True]]
    assert fairest_tangents(*given("T1_run")).at_bound.tolist() == [[False, False]]


def test_without_a_lower_bound_a_hollow_end_is_lost() -> None:
    """At a fiftieth of an even pace the end of an entrance bends beyond all measure: J is 232."""
    found = fairest_tangents(*given("T2_ent"), bounds=(0.02, FASTEST))
    assert round(form_energy(made("T2_ent", found.tangents[0]), "J")[0]) == 232


def test_alone_in_company_and_in_another_unit() -> None:
    """Four curves at once have the bits of each alone; in millimetres they look the same."""
    curves = [given(name) for name in FAIREST]
    start, finish = _joined([c[0] for c in curves]), _joined([c[1] for c in curves])
    area, centroid = np.concatenate([c[2:] for c in curves], axis=1)
    together = fairest_tangents(start, finish, area, centroid)
    for row, curve in enumerate(curves):
        assert fairest_tangents(*curve).tangents.tobytes() == together.tangents[row].tobytes()
    one, two, area, centroid = curves[0]
    start, finish = (
        FormEnd(1e3 * e.x, 1e3 * e.y, e.angle, 1e-3 * e.curvature, e.tangent, e.stretch)
        for e in (one, two)
    )
    found = fairest_tangents(start, finish, 1e6 * area, 1e3 * centroid)
    assert found.tangents[0] == pytest.approx(1e3 * together.tangents[0], rel=1e-6)


def _joined(ends: list[FormEnd]) -> FormEnd:
    """Ends as one batch."""
    fields = ("x", "y", "angle", "curvature", "tangent", "stretch")
    return FormEnd(*(np.concatenate([getattr(e, name) for e in ends]) for name in fields))


def test_without_a_curve_there_are_no_tangents() -> None:
    """nan where area and centroid cannot be met at any pace; none is said to be at a bound."""
    start, finish, area, _ = given("T1_run")
    found = fairest_tangents(start, finish, area, np.array([5.0]))
    assert np.isnan(found.tangents).all()
    assert not found.at_bound.any()


def areas(area: float, centroid: float, kind: str = "") -> np.ndarray:
    """Areas of the 180 m carrier at its stations, CB and LCB kept; given or fairest tangents."""
    p = BULK_CARRIER["p"]
    first, last, twice = p["X1R"], p["X0E"], 2.0 * 0.753614272532
    rest = twice - area - (last - first)
    moment = twice * 2.9 / 90.0 - area * centroid - (last**2 - first**2) / 2.0
    halves = (
        (
            FormEnd.of(-1.0, 6.08 / FULL, p["alpha0R"], 0.0, p["d0R"]),
            FormEnd.of(first, 1.0, 0.0, 0.0, p["d1R"]), area, centroid,
        ),
        (
            FormEnd.of(last, 1.0, 0.0, 0.0, p["d0E"]),
            FormEnd.of(1.0, 0.0, p["alpha1E"], 0.0, p["d1E"]), rest, moment / rest,
        ),
    )  # fmt: skip
    pieces = list[np.ndarray]()
    for start, finish, size, at in halves:
        sums = np.array([size]), np.array([at])
        if kind:
            d = fairest_tangents(start, finish, *sums, kind).tangents.T
            start, finish = (
                FormEnd(e.x, e.y, e.angle, e.curvature, each, e.stretch)
                for e, each in zip((start, finish), d, strict=True)
            )
        pieces.append(form_vertices(start, finish, *sums)[0])
    pieces.insert(1, straight_vertices((first, 1.0), (last, 1.0)))
    return FULL * FormChain.of(pieces).ordinate(versluis.X / 90.0 - 1.0)


@pytest.mark.parametrize(("kind", "most"), [("E3", "10.1"), ("J", "14.7"), ("E2", "18.8")])
def test_what_fairest_tangents_cost_a_ship(kind: str, most: str) -> None:
    """With CB and LCB exact, section areas leave the ship's by so much, m2."""
    off = np.abs(areas(0.511, -0.488, kind) - versluis.AREAS)
    assert f"{off.max():.1f}" == most


def test_how_exact_area_and_centroid_must_be() -> None:
    """A thousandth more area of the run: 9.2 m2; its centroid by a thousandth: 4.7 m2."""
    base = areas(0.511, -0.488)
    assert f"{np.abs(areas(0.512, -0.488) - base).max():.1f}" == "9.2"
    assert f"{np.abs(areas(0.511, -0.487) - base).max():.1f}" == "4.7"


def test_usual_tangents() -> None:
    """An eighth of the chord, both."""
    ends = FormEnd.of(0.0, 0.0, 0.0), FormEnd.of(3.0, 4.0, 0.0)
    assert usual_tangents(*ends).tolist() == [[0.625, 0.625]]
