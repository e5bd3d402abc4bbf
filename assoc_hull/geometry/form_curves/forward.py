"""Between which centroids form-parameter curves of an area run forward: dx/dt nowhere below 0.

All middle vertices of an area lie on a line; the least dx/dt of the curve is a concave function
of the place on it, so those that run forward are a stretch of that line. On the side of the
extreme of the moment on which the chosen root lies, the moment is monotone: the stretch is an
interval of centroids, and every centroid in it has a curve that runs forward.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.form_curves.curve import end_vertices, FormEnd
>>> from assoc_hull.geometry.form_curves.forward import forward_centroids
>>> run = FormEnd.of(-1.0, 0.0, np.radians(60.0), -2.0, 0.1525819451966713)
>>> body = FormEnd.of(-0.3, 1.0, 0.0, 0.0, 0.1525819451966713)
>>> ends = np.concatenate([end_vertices(run), end_vertices(body)], axis=1)
>>> forward_centroids(ends, np.array([0.55])).round(4).tolist()
[[-0.5936, -0.5521]]
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.extremes import least_rate
from assoc_hull.geometry.form_curves.integrals import MiddleTerms, middle_terms
from assoc_hull.geometry.form_curves.middle import centroid_extreme, with_middle

__all__ = ["forward_centroids"]

_THIRDS, _HALVES = 70, 60
"""Steps toward the largest least rate, and toward both ends of the stretch."""


def forward_centroids(ends: FloatArray, area: FloatArray) -> FloatArray:
    """Give the centroids between which curves of an area run forward.

    Parameters
    ----------
    ends : (n, 6, 2)
        P0, P1, P2, P4, P5, P6.
    area : (n,)
        int y dx, above 0.

    Returns
    -------
    (n, 2)
        The least and the largest; nan where no curve of the area runs forward, or where its
        abscissae do not depend on the middle vertex of the area.
    """
    terms = middle_terms(ends)
    with np.errstate(divide="ignore", invalid="ignore"):
        low, high = _bracket(ends)
        low, high = _beside_extreme(ends, terms, area, low, high)
        top = _highest(ends, terms, area, low, high)
        fine = _rate(ends, terms, area, top) >= 0.0
        edges = [_edge(ends, terms, area, top, each) for each in (low, high)]
        found = np.stack([_centroid(terms, area, each) for each in edges], axis=1)
    return np.where(fine[:, None], np.sort(found, axis=1), np.nan)


def _bracket(ends: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give abscissae of the middle vertex beyond which a curve runs back for certain."""
    x = ends[:, :, 0]
    return x[:, 2] - np.abs(x[:, 2] - x[:, 1]), x[:, 3] + np.abs(x[:, 4] - x[:, 3])


def _beside_extreme(
    ends: FloatArray, terms: MiddleTerms, area: FloatArray, low: FloatArray, high: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Keep the side of the extreme of the moment on which the nearest root lies."""
    at, want = centroid_extreme(ends, area)
    lies = np.isfinite(at)
    low = np.where(lies & (want >= at), np.maximum(low, at), low)
    high = np.where(lies & (want < at), np.minimum(high, at), high)
    return np.minimum(low, high), high


def _ordinate(terms: MiddleTerms, area: FloatArray, x: FloatArray) -> FloatArray:
    """Give the ordinates of middle vertices of the area."""
    return np.asarray((area - terms.area + terms.lever[:, 1] * x) / terms.lever[:, 0])


def _rate(ends: FloatArray, terms: MiddleTerms, area: FloatArray, x: FloatArray) -> FloatArray:
    return least_rate(with_middle(ends, x, _ordinate(terms, area, x)), 0)


def _centroid(terms: MiddleTerms, area: FloatArray, x: FloatArray) -> FloatArray:
    return np.asarray(terms.moment_at(x, _ordinate(terms, area, x)) / area)


def _highest(
    ends: FloatArray, terms: MiddleTerms, area: FloatArray, low: FloatArray, high: FloatArray
) -> FloatArray:
    """Find where the least rate is largest: it is concave, so thirds can be left out."""
    for _ in range(_THIRDS):
        one, two = low + (high - low) / 3.0, high - (high - low) / 3.0
        left = _rate(ends, terms, area, one) >= _rate(ends, terms, area, two)
        low, high = np.where(left, low, one), np.where(left, two, high)
    return np.asarray(0.5 * (low + high))


def _edge(
    ends: FloatArray, terms: MiddleTerms, area: FloatArray, inside: FloatArray, outside: FloatArray
) -> FloatArray:
    """Find the last place from inside that runs forward."""
    whole = _rate(ends, terms, area, outside) >= 0.0
    near, far = inside, outside
    for _ in range(_HALVES):
        middle = 0.5 * (near + far)
        forward = _rate(ends, terms, area, middle) >= 0.0
        near, far = np.where(forward, middle, near), np.where(forward, far, middle)
    return np.where(whole, outside, near)
