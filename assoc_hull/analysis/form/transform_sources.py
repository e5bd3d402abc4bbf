"""Where the curves of a transform come from: lines, closed lines, the sectional areas."""

from __future__ import annotations

import numpy as np

from assoc_hull.analysis.form.line_chains import AXES, Span, closed_chain, function_chain
from assoc_hull.analysis.form.transform_record import CurveTransform
from assoc_hull.analysis.hydrostatics.area_curve import area_curve
from assoc_hull.analysis.hydrostatics.floating import require_afloat
from assoc_hull.analysis.hydrostatics.flotation import flotation
from assoc_hull.analysis.hydrostatics.hydrostatic_header import SALT
from assoc_hull.analysis.hydrostatics.hydrostatics import position_of
from assoc_hull.analysis.hydrostatics.measured_hull import HasState, header_of, state_of
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.integrals.chain_transforms import (
    chebyshev_of_chains,
    descriptor_truncation,
    fourier_descriptors,
    function_samples,
    length_of_chains,
    sine_of_chains,
)
from assoc_hull.geometry.integrals.plane_chains import PlaneChains
from assoc_hull.geometry.integrals.transforms import (
    Series,
    chebyshev,
    composite,
    edges_of,
    sine,
    spread,
    truncation,
)
from assoc_hull.model.curve import Curve
from assoc_hull.model.line import Line

__all__ = ["AREAS", "of_areas", "of_line", "of_loop"]

AREAS = "sectional areas"
"""Stands for the sectional-area curve where a line is asked for."""

_WHERE = "in a transform"
_NEAR = 1e-8  # of the largest section area: surfaces are cut to about this
_TERMS: dict[str, object] = {
    "rho": SALT, "shell_factor": 1.0, "appendages": (), "fingerprint": ""
}  # fmt: skip
"""What a header asks for and areas do not depend on."""


def _curves(line: Line | Curve) -> tuple[Curve, ...]:
    return line.curves if isinstance(line, Line) else (line,)


def of_line(
    line: Line | Curve,
    kind: Series,
    terms: int,
    axes: tuple[int, int],
    span: Span,
    relative: bool,
) -> CurveTransform:
    """Expand one coordinate of a line over another."""
    chain = function_chain(_curves(line), axes, span, line.name)
    low, high = chain.ends[0, :, 0].tolist()
    xi, v, weights = function_samples(chain)
    unit = float(np.abs(v).max()) if relative else 1.0
    if unit == 0.0:
        what = f"{AXES[axes[1]]} is nil all along {line.name}"
        raise BadInputError(what, _WHERE, "choose another ordinate, or leave relative out")
    make = chebyshev_of_chains if kind == "chebyshev" else sine_of_chains
    series = make(chain, terms)[0] / unit
    rest = truncation(kind, series, xi, v / unit, weights)
    places = np.stack([low + 0.5 * (high - low) * (xi + 1.0), v / unit], axis=1)
    names = AXES[axes[0]], AXES[axes[1]]
    return CurveTransform(kind, line.name, *names, low, high, unit, series, "", rest, places)


def of_loop(
    line: Line | Curve,
    terms: int,
    axes: tuple[int, int],
    span: Span,
    relative: bool,
) -> CurveTransform:
    """Expand a line, closed with its mirror image, over its length."""
    if relative:
        what = "Fourier descriptors are asked relative to the largest ordinate"
        raise BadInputError(what, _WHERE, "divide them by |X_1|, say, to be free of the size")
    chain = closed_chain(_curves(line), axes, axes.index(1), span, line.name)
    found = fourier_descriptors(chain, terms)[0]
    rest = descriptor_truncation(chain, found)
    names = AXES[axes[0]], AXES[axes[1]]
    places = _around(chain)
    length = float(length_of_chains(chain)[0])
    return CurveTransform("fourier", line.name, *names, 0.0, length, 1.0, found, "", rest, places)


def _around(chain: PlaneChains) -> FloatArray:
    """Give places once around a closed chain, (q, 2), m."""
    return np.asarray(chain.at(np.linspace(0.0, 1.0, 17))).reshape(-1, 2)


def of_areas(
    hull: HasState,
    kind: Series,
    terms: int,
    span: Span,
    relative: bool,
    where: tuple[float | None, tuple[float, float] | None, float],
) -> CurveTransform:
    """Expand the areas of sections over x."""
    body = flotation(state_of(hull))
    header = header_of(hull, body, _TERMS)
    position = position_of(header, *where, "moulded")
    curve = area_curve(body, require_afloat([position], body.limits, header.length))
    low, high = (curve.low, curve.high) if span is None else span
    unit = curve.largest if relative else 1.0
    places = np.concatenate([[curve.low], curve.breaks, [curve.high]])
    breaks = 2.0 * (places[(places > low) & (places < high)] - low) / (high - low) - 1.0

    def values(xi: FloatArray) -> FloatArray:
        return curve.at(low + 0.5 * (high - low) * (xi + 1.0)) / unit

    make = chebyshev if kind == "chebyshev" else sine
    series = make(values, terms, breaks, _NEAR)
    xi, weights = spread(edges_of(breaks), *composite(1))
    y = values(xi)
    drawn = np.stack([low + 0.5 * (high - low) * (xi + 1.0), y], axis=1)
    rest = truncation(kind, series, xi, y, weights)
    at = str(position)
    return CurveTransform(kind, AREAS, "x", "A", low, high, unit, series, at, rest, drawn)
