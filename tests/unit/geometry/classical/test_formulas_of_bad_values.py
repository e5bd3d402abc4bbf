"""Whatever is handed to the formulas of hulls: an error of the family, or a result; no warning."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from assoc_hull.creation.classical.lewis_hull import LewisHull
from assoc_hull.errors import AssocHullError
from assoc_hull.geometry.classical.combined_waterline import (
    WaterlineRegion,
    WaterlineRegions,
    combined_waterline,
    fit_quintic,
    joined_pieces,
)
from assoc_hull.geometry.classical.conformal_sections import fit_conformal, lewis_sections
from assoc_hull.geometry.classical.lackenby_shift import lackenby_shift, one_minus_prismatic
from assoc_hull.geometry.classical.linear_least_squares import (
    bounded_fit,
    held_fit,
    linear_fit,
    orthogonal_fit,
)
from assoc_hull.geometry.classical.pieced_curve import (
    circle_piece,
    conic,
    conic_coefficients,
    conic_notes,
    cubic_conic,
    cubic_conic_coefficients,
    fit_cubic_conic,
)
from assoc_hull.geometry.classical.polynomial_hulls import (
    DraftFunctions,
    chapman_parabola,
    fit_polynomial_hull,
    fit_series,
    fit_series_hull,
    form_polynomial,
    product_hull,
    series_columns,
    taylor_quintic,
)
from assoc_hull.geometry.classical.smooth_offsets import smooth_offsets, smooth_table

BAD: list[Any] = [
    None, "a", float("nan"), float("inf"), -1, 0, 1e300, 1e-300, 1e155, 10**400, 1j, b"a", [], [1],
    ["x"], [1, [2], 3], {}, object(), type, np.zeros(4), np.zeros((2, 2, 2)), np.zeros((0, 3)),
    np.zeros((0, 2)), np.full((2, 2), np.nan), True, np.array(["a", "b"]), (1, 2), [3, 2, 1],
]  # fmt: skip

OFFSETS = [(24, 11.97), (30, 11.72), (36, 11.2), (42, 10.4), (48, 9.3), (54, 8)]
U, Y = [0.1, 0.25, 0.4, 0.55, 0.7, 0.85], [7.93, 7.58, 6.94, 6.0, 4.7, 2.95]
X = np.linspace(-1.0, 1.0, 9)
FLAT, END = [(0, 30), (5, 42)], [(0, 70), (5, 73)]
SIDE = [
    WaterlineRegion("flat", "change", "quintic", 20.0, 60.0),
    WaterlineRegion("change", "end", "conic", 60.0, 75.0),
]
ALONG = np.linspace(0.0, 100.0, 9)
BEAM = 8.0 * (1.0 - (ALONG / 50.0 - 1.0) ** 4)
SECTION = lewis_sections([6.0], [5.0], [0.9]).at(np.linspace(0.0, 0.5 * np.pi, 9))[0]
CALLS: dict[str, tuple[Callable[..., object], dict[str, Any]]] = {
    "coefficients of conics": (conic_coefficients, {"height": [2.0], "slope": [1.0]}),
    "coefficients of cubic conics": (
        cubic_conic_coefficients,
        {"height": [2.0], "slope": [1.0], "bend": [0.0]},
    ),
    "notes of a conic": (conic_notes, {"slope": 0.5}),
    "place on a series hull": (
        lambda x, z: fit_series_hull(X, X, X, (1, 0), (-1, 1), (-1, 1)).at(x, z),
        {"x": [0.1], "z": [0.1]},
    ),
    "offsets turned round": (lambda offsets: fit_conformal(offsets, 2), {"offsets": SECTION}),
    "offsets twice": (
        lambda terms: fit_conformal(np.vstack([SECTION, SECTION + 0.1]), terms),
        {"terms": 2},
    ),
    "quintic": (
        fit_quintic,
        {"u": U, "y": Y, "y0": 8.0, "y1": 1.0, "d0": 0.0, "d1": -14.0, "weights": None},
    ),
    "place on a quintic": (
        lambda u, order: fit_quintic(U, Y, 8, 1, 0, 0).at(u, order),
        {"u": 0.5, "order": 0},
    ),
    "waterline": (
        combined_waterline,
        {
            "x0": 20,
            "x1": 60,
            "x2": 75,
            "y0": 12,
            "y1": 6.5,
            "offsets": OFFSETS,
            "end": 0.0,
            "start": None,
            "slope": 0.0,
            "last": "conic",
        },
    ),
    "place on a waterline": (
        lambda x, order: combined_waterline(20, 60, 75, 12, 6.5, OFFSETS).at(x, order),
        {"x": 50.0, "order": 0},
    ),
    "conic": (conic, {"first": 60.0, "last": 75.0, "y": 6.5, "slope": -0.2, "end": 0.0}),
    "cubic conic": (
        cubic_conic,
        {"first": 60.0, "last": 75.0, "y": 6.5, "slope": -0.26, "second": -0.004, "end": 0.0},
    ),
    "cubic conic of offsets": (
        fit_cubic_conic,
        {
            "x": [1.0, 4, 7, 9.5],
            "y": [6.0, 5, 3, 1],
            "first": 0.0,
            "last": 10.0,
            "end": 0.0,
            "value": None,
            "slope": None,
        },
    ),
    "regions": (
        WaterlineRegions.make,
        {"boundaries": {"flat": FLAT, "end": END}, "formulas": {("flat", "end"): "line"}},
    ),
    "boundary": (
        lambda line: WaterlineRegions.make({"flat": FLAT, "end": line}, {}),
        {"line": END},
    ),
    "level of regions": (
        lambda z: WaterlineRegions.make({"flat": FLAT, "end": END}, {("flat", "end"): "line"}).at(
            z
        ),
        {"z": 3.0},
    ),
    "joined pieces": (
        joined_pieces,
        {"regions": SIDE, "heights": {"flat": 12.0, "change": 6.5, "end": 0.0}, "offsets": OFFSETS},
    ),
    "half-breadth of a boundary": (
        lambda y: joined_pieces(SIDE, {"flat": 12.0, "change": 6.5, "end": y}, OFFSETS),
        {"y": 0.0},
    ),
    "circle": (circle_piece, {"first": 0.0, "last": 4.0, "y": 5.0, "slope": 0.0, "end": 3.0}),
    "Lewis sections": (
        lewis_sections,
        {"half_breadth": [6.0], "draught": [5.0], "coefficient": [0.94]},
    ),
    "angle of a section": (lambda t: lewis_sections([6.0], [5.0], [0.94]).at(t), {"t": 0.5}),
    "conformal section": (fit_conformal, {"offsets": SECTION, "terms": 2}),
    "Taylor": (taylor_quintic, {"t": 1.0, "p": -2.0, "c": 0.7}),
    "form polynomial": (
        form_polynomial,
        {"powers": [0, 1], "conditions": [("value", 0, 1), ("slope", 0, 1)]},
    ),
    "Chapman": (chapman_parabola, {"x": 0.4, "n": 2.0}),
    "product": (product_hull, {"x": 0.4, "zeta": 0.2, "a": [0, 1], "b": [0, 1]}),
    "Lackenby": (
        lackenby_shift,
        {
            "x": 0.6,
            "phi": 0.76,
            "centroid": 0.4,
            "change": 0.02,
            "parallel": 0.3,
            "parallel_change": 0.03,
        },
    ),
    "one minus prismatic": (one_minus_prismatic, {"x": 0.6, "phi": 0.76, "change": 0.02}),
    "linear fit": (linear_fit, {"matrix": np.eye(3), "data": [1, 2, 3], "weights": None}),
    "held fit": (
        held_fit,
        {
            "matrix": np.eye(3),
            "data": [1, 2, 3],
            "held": [[1, 0, 0]],
            "values": [1],
            "weights": None,
        },
    ),
    "bounded fit": (bounded_fit, {"matrix": np.eye(3), "data": [1, 2, 3], "least": 0, "most": 5}),
    "orthogonal fit": (orthogonal_fit, {"matrix": np.eye(3), "data": [1, 2, 3]}),
    "lower degree": (lambda terms: orthogonal_fit(np.eye(3), [1, 2, 3]).lower(terms), {"terms": 2}),
    "series": (fit_series, {"x": X, "y": X, "degree": 3, "basis": "legendre", "span": (-1.0, 1.0)}),
    "columns of a series": (
        series_columns,
        {"x": X, "degree": 3, "basis": "legendre", "span": (-1.0, 1.0)},
    ),
    "series hull": (
        fit_series_hull,
        {
            "x": np.tile(X, 3),
            "z": np.repeat([0.0, 1, 2], 9),
            "y": np.tile(X, 3),
            "degrees": (2, 1),
            "x_span": (-1.0, 1.0),
            "z_span": (0.0, 2.0),
            "basis": "legendre",
            "columns": (),
            "weights": None,
        },
    ),
    "draft functions": (
        DraftFunctions.make,
        {"levels": [0, 1, 2.0], "values": [[1.0], [2.0], [3.0]], "degree": None},
    ),
    "level of draft functions": (
        lambda z: DraftFunctions.make([0, 1, 2.0], [[1.0], [2.0], [3.0]], 1).at(z),
        {"z": 1.0},
    ),
    "polynomial hull": (
        fit_polynomial_hull,
        {"x": X, "levels": [0, 1, 2.0], "y": np.ones((3, 9)), "degree": 2, "draft_degree": None},
    ),
    "place on a polynomial hull": (
        lambda x, z: fit_polynomial_hull(X, [0, 1, 2.0], np.ones((3, 9)), 2).at(x, z),
        {"x": 0.1, "z": 1.0},
    ),
    "smooth offsets": (smooth_offsets, {"y": Y, "stiffness": 1.0, "weights": None}),
    "smooth table": (
        smooth_table,
        {
            "x": np.arange(6.0),
            "z": np.arange(5.0),
            "y": np.ones((5, 6)),
            "lam": 1e-3,
            "tolerance": 1e-4,
            "most": 5,
        },
    ),
    "Lewis hull": (
        LewisHull.make,
        {
            "x": ALONG,
            "half_breadth": BEAM,
            "coefficient": np.full(9, 0.9),
            "draught": 6.0,
            "depth": 9.0,
            "levels": (),
            "name": "a",
        },
    ),
}


def spoilt(value: Any) -> list[Any]:
    """Give bad values, and numbers like the good ones with one that is odd, or too few."""
    found = list(BAD)
    if isinstance(value, np.ndarray | list | tuple) and not isinstance(value[:1], str):
        try:
            good = np.array(value, np.float64)
        except (TypeError, ValueError):
            return found
        for odd in (np.nan, 1e300, -1e300, 0.0, 1e-300, 1e155):
            changed = good.copy()
            changed.flat[good.size // 2 : good.size // 2 + 1] = odd
            found.append(changed)
        found += [1e200 * good, 1e-200 * good, 0.0 * good, good[:-1], good[::-1]]
    return found


@pytest.mark.parametrize(("call", "given"), CALLS.values(), ids=CALLS)
def test_formulas_refuse_what_they_cannot_use(
    call: Callable[..., object], given: dict[str, Any]
) -> None:
    """Every argument in turn; what is not refused has a result, without a warning."""
    call(**given)
    told = list[str]()
    for name, value in given.items():
        for bad in spoilt(value):
            try:
                call(**{**given, name: bad})
            except AssocHullError as error:
                told.append(str(error))
    assert told
    assert not [each for each in told if "\n" in each or len(each) > 300]
