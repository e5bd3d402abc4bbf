"""Curves of areas and waterlines without a parallel part, of one polynomial from end to end.

A polynomial with a zero of first or second order at both ends, a mean, a centroid and the maximum 1
is the one of least integral of the squared third derivative; so is the place of its maximum. Its
definition by two halves has the area, the centroid, and point, angle and curvature at the ends of
each half. The frame is that of `assoc_hull.model.forms.two_halves`: -1 at AP, 1 at FP.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from numpy.polynomial import Polynomial
from scipy.optimize import minimize_scalar

from assoc_hull.errors import BadInputError
from assoc_hull.model.form_definition import FormDefinition

__all__ = ["fairest_polynomial", "halves_of", "maximum_of"]

_S = Polynomial([0.0, 1.0])

_TERMS = 9
"""Unknowns; more change the curve by less than 1e-3."""

_PEAKS = (-0.6, 0.4)
"""Where the maximum is looked for."""


def fairest_polynomial(
    order: int, mean: float, centroid: float, slopes: Mapping[float, float]
) -> Polynomial:
    """Give the fairest curve with zeros of an order at -1 and 1, and slopes there if asked for."""
    ends = Polynomial([1.0, 0.0, -1.0]) ** order
    base = [ends * Polynomial.basis(k) for k in range(_TERMS)]
    third = [each.deriv(3) for each in base]
    bent = np.array([[_over(one * other) for other in third] for one in third])
    fixed = [[_over(each) for each in base], [_over(each * _S) for each in base]]
    fixed += [[float(each.deriv()(place)) for each in base] for place in slopes]
    asked = [2.0 * mean, 2.0 * mean * centroid, *slopes.values(), 1.0, 0.0]

    def solved(peak: float) -> np.typing.NDArray[np.float64]:
        top = [[float(each(peak)) for each in base], [float(each.deriv()(peak)) for each in base]]
        rows = np.array([*fixed, *top])
        zero = np.zeros((len(rows), len(rows)))
        whole = np.block([[bent, rows.T], [rows, zero]])
        found: np.typing.NDArray[np.float64] = np.linalg.solve(whole, [*[0.0] * _TERMS, *asked])
        return found[:_TERMS]

    def energy(peak: float) -> float:
        share = solved(peak)
        return float(share @ bent @ share)

    best = minimize_scalar(energy, bounds=_PEAKS, method="bounded", options={"xatol": 1e-9})
    return ends * Polynomial(solved(float(best.x)))


def _over(curve: Polynomial) -> float:
    """Integrate from -1 to 1."""
    whole = curve.integ()
    return float(whole(1.0) - whole(-1.0))


def maximum_of(curve: Polynomial) -> float:
    """Give where a curve that is 1 at most has its maximum.

    Raises BadInputError where it is higher, or below 0: a mean and a centroid that do not go
    together.
    """
    roots = curve.deriv().roots()
    inside = np.sort(roots[np.abs(roots.imag) < 1e-9].real)
    inside = inside[np.abs(inside) < 1.0 - 1e-9]
    values = curve(inside)
    if not len(inside) or values.max() > 1.0 + 1e-6 or curve(np.linspace(-1, 1, 201)).min() < -1e-9:
        what = "no fair curve without a parallel part has this fullness and this centroid"
        raise BadInputError(what, "in a ship from six numbers", "give others")
    return float(inside[np.argmax(values)])


def halves_of(curve: Polynomial, name: str, use: str, full: float) -> FormDefinition:
    """Give the definition by two halves; `full` is what the ordinate 1 stands for, m or m2."""
    at = maximum_of(curve)
    values = {
        "full": full, "run_start": -1.0, "run_end": at, "entrance_start": at, "entrance_end": 1.0,
        "top": 1.0,
    }  # fmt: skip
    for half, low, high in (("run", -1.0, at), ("entrance", at, 1.0)):
        for end, place in (("start", low), ("end", high)):
            # Rounding is no angle where the curve ends level.
            slope = 0.0 if place == at else round(float(curve.deriv()(place)), 9)
            size = math.hypot(1.0, slope)
            values[f"{half}_{end}_angle_deg"] = math.degrees(math.atan(slope))
            values[f"{half}_{end}_curvature"] = float(curve.deriv(2)(place)) / size**3
            # An even pace in s.
            values[f"{half}_{end}_tangent"] = 0.25 * (high - low) * size
        area, moment = (
            float(each.integ()(high) - each.integ()(low)) for each in (curve, curve * _S)
        )
        values[f"{half}_area"], values[f"{half}_centroid"] = area, moment / area
    return FormDefinition(name, use, "halves", values)
