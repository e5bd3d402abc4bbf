"""Curves of areas and waterlines without a parallel part, of one polynomial from end to end.

A polynomial with a zero of first or second order at both ends, a mean, a centroid and the maximum 1
is the one of least integral of the squared third derivative; so is the place of its maximum. A full
one has a maximum that is level to the third order, or it would rise above 1. Its definition by two
halves has the area, the centroid, and point, angle and curvature at the ends of each half. The
frame is that of `assoc_hull.model.forms.two_halves`: -1 at AP, 1 at FP.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from numpy.polynomial import Polynomial
from scipy.optimize import least_squares, minimize_scalar

from assoc_hull.errors import AssocHullError, BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.curve import form_at
from assoc_hull.model.form_definition import FormDefinition
from assoc_hull.model.forms.two_halves import half_number, half_vertices

__all__ = ["fairest_polynomial", "fitted_halves", "halves_of", "level_polynomial", "maximum_of"]

_S = Polynomial([0.0, 1.0])

_TERMS = 9
"""Unknowns; more change the curve by less than 1e-3."""

_PEAKS = (-0.6, 0.4)
"""Where the maximum is looked for."""


def fairest_polynomial(
    order: int, mean: float, centroid: float, slopes: Mapping[float, float]
) -> Polynomial:
    """Give the fairest curve with zeros of an order at -1 and 1, and slopes there if asked for."""
    return _fairest(order, mean, centroid, {(end, 1): slope for end, slope in slopes.items()}, 1)[0]


def level_polynomial(
    order: int, mean: float, centroid: float | None, ends: Mapping[tuple[float, int], float],
    peak: float | None = None,
) -> tuple[Polynomial, float]:  # fmt: skip
    """Give the fairest curve that is level to the third order at its maximum, and where that is.

    `ends` are derivatives by place and order; a centroid, or a place of the maximum, that is None
    comes out fairest.

    Raises BadInputError where it is higher than 1, or below 0.
    """
    curve, at = _fairest(order, mean, centroid, ends, 3, peak)
    values = curve(np.linspace(-1.0, 1.0, 401))
    if values.max() > 1.0 + 1e-6 or values.min() < -1e-9:
        raise _unfair()
    return curve, at


def _fairest(
    order: int, mean: float, centroid: float | None, ends: Mapping[tuple[float, int], float],
    level: int, peak: float | None = None,
) -> tuple[Polynomial, float]:  # fmt: skip
    """Give the fairest curve whose derivatives up to an order, `level`, are 0 at its maximum."""
    zeros = Polynomial([1.0, 0.0, -1.0]) ** order
    base = [zeros * Polynomial.basis(k) for k in range(_TERMS)]
    third = [each.deriv(3) for each in base]
    bent = np.array([[_over(one * other) for other in third] for one in third])
    fixed, asked = [[_over(each) for each in base]], [2.0 * mean]
    if centroid is not None:
        fixed.append([_over(each * _S) for each in base])
        asked.append(2.0 * mean * centroid)
    fixed += [[float(each.deriv(n)(place)) for each in base] for place, n in ends]
    asked += [*ends.values(), 1.0, *[0.0] * level]

    def solved(peak: float) -> FloatArray:
        top = [[float(each.deriv(n)(peak)) for each in base] for n in range(level + 1)]
        rows = np.array([*fixed, *top])
        zero = np.zeros((len(rows), len(rows)))
        whole = np.block([[bent, rows.T], [rows, zero]])
        found: FloatArray = np.linalg.solve(whole, [*[0.0] * _TERMS, *asked])
        return found[:_TERMS]

    def energy(peak: float) -> float:
        share = solved(peak)
        return float(share @ bent @ share)

    if peak is None:
        best = minimize_scalar(energy, bounds=_PEAKS, method="bounded", options={"xatol": 1e-9})
        peak = float(best.x)
    return zeros * Polynomial(solved(peak)), peak


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
        raise _unfair()
    return float(inside[np.argmax(values)])


def _unfair() -> BadInputError:
    what = "no fair curve without a parallel part has this fullness and this centroid"
    return BadInputError(what, "in a ship from six numbers", "give others")


def halves_of(
    curve: Polynomial, name: str, use: str, full: float, start: float = -1.0,
    at: float | None = None,
) -> FormDefinition:  # fmt: skip
    """Give the definition by two halves; `full` is what the ordinate 1 stands for, m or m2.

    The curve goes from `start` to 1 with its maximum at `at`, which is looked for if None.
    """
    at = maximum_of(curve) if at is None else at
    values = {
        "full": full, "run_start": start, "run_end": at, "entrance_start": at, "entrance_end": 1.0,
        "top": 1.0,
    }  # fmt: skip
    for half, low, high in (("run", start, at), ("entrance", at, 1.0)):
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


_PARTS = np.linspace(0.1, 3.9, 39)
"""Where a half is compared with the polynomial, in t."""

_FIRST = ((0.0, 0.0), (-0.35, -0.35), (0.25, 0.25), (-0.3, 0.2), (0.2, -0.3))
"""Logarithms of factors of both tangents: where a fit may begin."""


def fitted_halves(definition: FormDefinition, curve: Polynomial) -> FormDefinition:
    """Give tangents with which the halves come nearest to their polynomial.

    An even pace leaves them up to .025 of the largest ordinate away where a curve is full at one
    end and hollow at the other, fitted tangents .008.
    """
    for half in ("run", "entrance"):
        names = [f"{half}_{end}_tangent" for end in ("start", "end")]
        even = np.array([half_number(definition, each) for each in names])

        def having(
            part: FloatArray, now: FormDefinition = definition, names: list[str] = names,
            even: FloatArray = even,
        ) -> FormDefinition:  # fmt: skip
            return now.having(dict(zip(names, (even * np.exp(part)).tolist(), strict=True)))

        def miss(part: FloatArray, half: str = half) -> FloatArray:
            try:
                vertices = half_vertices(having(part), half)
            except AssocHullError:
                return np.ones(len(_PARTS))
            x, y = form_at(np.repeat(vertices[None], len(_PARTS), 0), _PARTS).T
            found: FloatArray = y - curve(x)
            return found

        first = min(_FIRST, key=lambda part: float(np.abs(miss(np.array(part))).max()))
        steps = np.full(2, 1e-3)
        best = least_squares(miss, first, bounds=(-0.7, 0.7), diff_step=steps, max_nfev=15)
        definition = having(best.x)
    return definition
