"""Whatever is handed to classical splines, elastica and circles: an error, or a result."""

from __future__ import annotations

import contextlib
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from assoc_hull.errors import AssocHullError
from assoc_hull.geometry.classical.chord_spline import ChordSpline, chord_splines
from assoc_hull.geometry.classical.circular_arcs import (
    circle_by_tangent,
    circle_through,
    fitted_circle,
    tangent_curvature,
)
from assoc_hull.geometry.classical.elastica import Elastica, fit_elastica
from assoc_hull.geometry.classical.truncated_power_spline import (
    TruncatedPower,
    power_columns,
    solve_truncated_powers,
)

P = np.array([(0.0, 0.0), (2.0, 1.0), (4.0, 1.5), (7.0, 1.2), (9.0, 0.0)])
BATTEN, ROD = ChordSpline.through(P), Elastica.make(0.6, 0.0, 1.0)
POWERS = TruncatedPower.through(*P.T)

BAD: tuple[Any, ...] = (
    None, "a", float("nan"), float("inf"), -1, 0, True, 1e308, 1e-308, 10**400, 1j, b"a", [], [1],
    ["move"], [1, [2], 3], [[1, 2], [3]], {}, object(), type, np.zeros(4), np.zeros((2, 2, 2)),
    np.zeros((0, 2)), np.full((2, 3), np.nan), np.array(["a", "b"]), np.array(5.0), P * 1e-200,
    P * 1e200, P * 0.0, P[:1],
)  # fmt: skip
ENDS: dict[str, Any] = {"start": (0.0, 0.0), "end": (1.0, 0.0)}
CALLS: dict[str, tuple[Callable[..., object], dict[str, Any]]] = {
    "ChordSpline.through": (
        ChordSpline.through, {"points": P, "angle0": None, "angle1": None, "mode": "moment"}
    ),
    "chord_splines": (
        chord_splines, {"curves": [P], "ends": [(None, None)], "mode": "curvature"}
    ),
    "ChordSpline.at": (BATTEN.at, {"t": 1.0}),
    "ChordSpline.curvature": (BATTEN.curvature, {"t": 1.0}),
    "ChordSpline.where": (BATTEN.where, {"axis": "x", "values": 1.0}),
    "TruncatedPower.through": (TruncatedPower.through, {"x": P[:, 0], "y": P[:, 1]}),
    "TruncatedPower.at": (POWERS.at, {"x": 1.0}),
    "power_columns": (power_columns, {"x": P[:, 0]}),
    "solved_directly": (solve_truncated_powers, {"x": P[:, 0], "y": P[:, 1]}),
    "Elastica.make": (
        Elastica.make,
        {"k": 0.6, "phi0": 0.0, "phi1": 1.0, "rate": 1.0, "start": (0, 0), "rotation": 0.0,
         "family": "inflecting"},
    ),
    "Elastica.straight": (Elastica.straight, ENDS),
    "Elastica.at": (ROD.at, {"s": 0.1}),
    "Elastica.curvature_rate": (ROD.curvature_rate, {"s": 0.1}),
    "Elastica.frame_point": (ROD.frame_point, {"phi": 0.1}),
    "fit_elastica": (
        fit_elastica, {**ENDS, "alpha": 0.5, "beta": -0.3, "length": None, "k": None}
    ),
    "circle_through": (circle_through, {"p": (0, 0), "q": (1, 1), "r": (2, 0)}),
    "circle_by_tangent": (
        circle_by_tangent, {"start": (0, 0), "direction": (1, 0), "end": (1, 1)}
    ),
    "tangent_curvature": (
        tangent_curvature, {"start": (0, 0), "direction": (1, 0), "end": (1, 1)}
    ),
    "fitted_circle": (fitted_circle, {"points": P, "polish": True}),
}  # fmt: skip


@pytest.mark.parametrize(("function", "given"), CALLS.values(), ids=CALLS)
def test_classical_curves_take_nothing_amiss(
    function: Callable[..., object], given: dict[str, Any]
) -> None:
    """Every argument in turn, and each multiplied until its squares vanish or overflow."""
    function(**given)
    for name, value in given.items():
        scaled = []
        if isinstance(value, tuple | np.ndarray):
            scaled = [np.asarray(value, np.float64) * size for size in (1e-200, 1e200)]
        for bad in (*BAD, *scaled):
            with contextlib.suppress(AssocHullError):
                function(**{**given, name: bad})


def test_no_values_are_nowhere() -> None:
    """Places of no coordinates are none."""
    assert len(BATTEN.where("x", [])) == 0
