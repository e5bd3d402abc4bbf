"""Half sections anywhere along a hull: as drawn, or cut from the surface through its lines."""

from __future__ import annotations

import numpy as np

from assoc_hull.analysis.hydrostatics.flotation import Flotation
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.floating.cross_sections import cross_section
from assoc_hull.geometry.splines.paths import stretch
from assoc_hull.geometry.splines.segments import power
from assoc_hull.geometry.surfaces.isocurves import IsoCurves

__all__ = ["half_section"]

_ON = 1e-4
"""So near to a station (m) a section is the drawn one."""


def half_section(body: Flotation, x: float) -> SplineBatch | None:
    """Give the half section at a place, port side.

    Parameters
    ----------
    body : Flotation
        The hull.
    x : float, m
        Where, from AP.

    Returns
    -------
    SplineBatch or None
        One curve for each piece, from keel to deck, without a closed deck; None where the hull
        has no section.

    Examples
    --------
    >>> from assoc_hull.analysis.hydrostatics.flotation import flotation
    >>> from assoc_hull.analysis.form.half_section import half_section
    >>> from assoc_hull.shipped.wigley import wigley
    >>> section = half_section(flotation(wigley()), 50.0)
    >>> round(float(section.xyz[:, 1].max()), 6)  # B / 2
    5.0
    """
    pieces = _drawn(body, x) or _end(body, x) or _between(body, x)
    return SplineBatch.join([_spline(each) for each in pieces]) if pieces else None


def _spline(cubic: FloatArray) -> SplineBatch:
    """Take cubics one behind the other, (s, 4, 3), as a spline; its knots are their chords."""
    first, last = cubic[:, 0], cubic[-1:].sum(axis=1)
    xyz = np.concatenate([first, last])
    chord = np.sqrt((np.diff(xyz, axis=0) ** 2).sum(axis=1))
    whole = chord > 0.0
    if not whole.all():
        return _spline(cubic[whole])
    leave = cubic[:, 1] / chord[:, None]
    arrive = (cubic[:, 1] + 2.0 * cubic[:, 2] + 3.0 * cubic[:, 3]) / chord[:, None]
    knot = np.concatenate([[0.0], np.cumsum(chord)])
    return SplineBatch(
        np.array([0, len(xyz)]),
        knot,
        xyz,
        np.concatenate([leave, arrive[-1:]]),
        np.concatenate([leave[:1], arrive]),
    )


def _drawn(body: Flotation, x: float) -> list[FloatArray]:
    """Give the pieces of a station, if one stands there."""
    found = body.sections
    near = np.flatnonzero(np.abs(found.x - x) <= _ON)
    if not len(near):
        return []
    return _pieces(found.curves, np.flatnonzero(found.station == near[0]))


def _end(body: Flotation, x: float) -> list[FloatArray]:
    """Give the curves of a transom or another end across the ship, if one stands there."""
    net = body.net
    chosen = np.flatnonzero(net.end & (np.abs(net.x - x) <= _ON))
    return [_upward(power(net.batch.part(i, i + 1))) for i in chosen.tolist()]


def _upward(cubic: FloatArray) -> FloatArray:
    if cubic[0, 0, 2] <= cubic[-1].sum(axis=0)[2]:
        return cubic
    one = np.ones(len(cubic))
    return stretch(cubic[::-1], one, 0.0 * one)


def _between(body: Flotation, x: float) -> list[FloatArray]:
    """Give the pieces of the surface's section between two stations, or beyond the last ones."""
    found = cross_section(body.spans, x)
    return _pieces(found, np.arange(found.count))


def _pieces(curves: IsoCurves, chosen: IntArray) -> list[FloatArray]:
    """Give the cubics of curves, without their decks; a curve that is but a point has none."""
    long = ~curves.deck & (np.abs(curves.point[:, 1:]).max(axis=(1, 2), initial=0.0) > 0.0)
    bounds = curves.start[:-1], curves.start[1:]
    spans = [slice(int(bounds[0][i]), int(bounds[1][i])) for i in chosen.tolist()]
    pieces = [curves.point[span][long[span]] for span in spans]
    return [piece for piece in pieces if len(piece)]
