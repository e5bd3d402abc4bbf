"""Elastica through two points with given tangents: free length, modulus or length given.

Two points and two end angles are four data; an elastica has five unknowns. What closes it is
chosen: a length that adjusts itself without friction, which has k^2 = 1/2 (the energy of
bending is stationary there), a modulus, or a length. In the frame of the unit chord only the
first amplitude and the span of amplitudes are to be found, by Newton's rule for many at once,
from the curvatures that the cubic of small deflections has at its ends.

Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK, eq. 9.

Examples
--------
>>> from assoc_hull.geometry.classical.elastica_fit import fit_elastica
>>> rod = fit_elastica([0, 0], [1, 0], 0.5, -0.3)
>>> round(rod.length, 9), round(rod.energy, 9)
(1.028556519, 0.736516918)
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import bearable
from assoc_hull.geometry.classical.checks import figure, finite, wrap
from assoc_hull.geometry.classical.elastica import Elastica, check_modulus, force_frame
from assoc_hull.geometry.classical.elastica_length import with_length
from assoc_hull.geometry.classical.elastica_solve import FREE_MODULUS, fit_amplitudes, no_solution
from assoc_hull.geometry.curves import FloatArray

__all__ = ["fit_elastica"]


def fit_elastica(
    start: ArrayLike,
    end: ArrayLike,
    alpha: float,
    beta: float,
    *,
    length: float | None = None,
    k: float | None = None,
) -> Elastica:
    """Lay an elastica between two points with given tangents.

    Parameters
    ----------
    start, end : (2,), m
        Its ends.
    alpha, beta : float, rad
        Directions at start and end, from the chord, positive to the left.
    length : float, m, optional
        Of the curve; without it, and without k, the length adjusts itself.
    k : float, optional
        Modulus, between 0 and 1.

    Returns
    -------
    Elastica
        A straight line where both angles are nil.

    Raises
    ------
    GeometryError
        ``"elastica: modulus k must lie in (0,1)"``, ``"elastica: no solution found for end
        angles ({a},{b})"``, ``"elastica: length {L} outside the attainable range [{lo},{hi}]"``.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.elastica_fit import fit_elastica
    >>> round(fit_elastica([0, 0], [1, 0], 0.5, -0.3, length=1.03).k, 9)
    0.423998899
    """
    first, last = (bearable(finite(each, "elastica", (2,)), "elastica") for each in (start, end))
    a, b = (float(wrap(finite(each, "elastica", ()))) for each in (alpha, beta))
    step = last - first
    chord = float(np.hypot(*step))
    if chord == 0.0:
        raise GeometryError("elastica: coincident points", "give two points apart")
    if length is not None and k is not None:
        what = "elastica: both a length and a modulus are given"
        raise GeometryError(what, "leave one of them open", {"length": length, "k": k})
    if a == 0.0 and b == 0.0:
        _check_straight(length, k, chord)
        return Elastica.straight(first, last)
    if length is None:
        return _placed(first, step, a, b, FREE_MODULUS if k is None else check_modulus(k))
    wanted = float(finite(length, "elastica", ()))
    modulus, *near = with_length(a, b, wanted / chord, chord)
    return _laid(first, step, modulus, *near)


def _check_straight(length: float | None, k: float | None, chord: float) -> None:
    if k is not None:
        check_modulus(k)
    if length is None:
        return
    wanted = float(finite(length, "elastica", ()))
    if abs(wanted - chord) > 1e-12 * chord:
        raise GeometryError(
            f"elastica: length {figure(wanted)} outside the attainable range "
            f"[{figure(chord)},{figure(chord)}]", "a straight line has the length of its chord",
            {"length": wanted, "least": chord, "most": chord},
        )  # fmt: skip


def _placed(first: FloatArray, step: FloatArray, a: float, b: float, k: float) -> Elastica:
    """Solve for amplitudes of one modulus."""
    phi0, span, met = fit_amplitudes(np.array([a]), np.array([b]), k)
    if not met[0]:
        raise no_solution(a, b, k)
    return _laid(first, step, k, float(phi0[0]), float(span[0]))


def _laid(first: FloatArray, step: FloatArray, k: float, phi0: float, span: float) -> Elastica:
    """Turn and scale a segment from the frame of its force onto its chord."""
    ends = np.array(phi0), np.array(phi0 + span)
    xi, eta, _ = (float(each) for each in force_frame(*ends, k))
    rate = float(np.hypot(xi, eta)) / float(np.hypot(*step))
    turn = float(np.arctan2(step[1], step[0]) - np.arctan2(eta, xi))
    return Elastica.make(k, phi0, phi0 + span, rate, start=first, rotation=turn)
