"""Half sections anywhere along a hull: as drawn, or cut from the surface through its lines.

Between two stations most curves of the surface lie in planes across the ship already. Where it
ends on a raked stem or stern, or a piece begins, they do not; there the surface is cut.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.analysis.flotation import Flotation
from assoc_hull.analysis.net.slabs import planes as stands
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.isocurves import IsoCurves
from assoc_hull.geometry.segments import power
from assoc_hull.geometry.surface_cut import cut_across

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
    >>> from assoc_hull.analysis.flotation import flotation
    >>> from assoc_hull.analysis.half_section import half_section
    >>> from assoc_hull.examples.wigley import wigley
    >>> section = half_section(flotation(wigley()), 50.0)
    >>> round(float(section.xyz[:, 1].max()), 6)  # B / 2
    5.0
    """
    pieces = _drawn(body, x) or _end(body, x) or _between(body, x)
    return SplineBatch.join([as_spline(each) for each in pieces]) if pieces else None


def as_spline(cubic: FloatArray) -> SplineBatch:
    """Take cubics one behind the other, (s, 4, 3), as a spline; its knots are their chords."""
    first, last = cubic[:, 0], cubic[-1:].sum(axis=1)
    xyz = np.concatenate([first, last])
    chord = np.sqrt((np.diff(xyz, axis=0) ** 2).sum(axis=1))
    whole = chord > 0.0
    if not whole.all():
        return as_spline(cubic[whole])
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
    c0, c1, c2, c3 = (cubic[::-1, i] for i in range(4))
    return np.stack([c0 + c1 + c2 + c3, -(c1 + 2.0 * c2 + 3.0 * c3), c2 + 3.0 * c3, -c3], axis=1)


def _between(body: Flotation, x: float) -> list[FloatArray]:
    """Cut the surface between two stations, or beyond the last ones."""
    slab = int(np.searchsorted(stands(body.net), x))
    chosen = np.array([i for i, f in enumerate(body.layout.frames) if f.slab == slab], np.int64)
    flat = body.layout.cells.plane[chosen]
    found = [piece for i in chosen[~flat].tolist() for piece in cut_across(body.strips, i, x)]
    for i in chosen[flat].tolist():
        aft, fore = _rails(body, i)
        if aft < x < fore:
            curves = body.strips.curves(np.array([i]), np.array([(x - aft) / (fore - aft)]))
            found += _pieces(curves, np.array([0]))
    return found


def _rails(body: Flotation, strip: int) -> tuple[float, float]:
    """Give between which x a strip reaches whose rails stand across the ship."""
    curves = body.strips.curves(np.array([strip, strip]), np.array([0.0, 1.0]))
    aft, fore = curves.point[curves.start[:2], 0, 0].tolist()
    return aft, fore


def _pieces(curves: IsoCurves, chosen: IntArray) -> list[FloatArray]:
    """Give the cubics of curves, without their decks."""
    bounds = curves.start[:-1], curves.start[1:]
    spans = [slice(int(bounds[0][i]), int(bounds[1][i])) for i in chosen.tolist()]
    return [curves.point[span][~curves.deck[span]] for span in spans]
