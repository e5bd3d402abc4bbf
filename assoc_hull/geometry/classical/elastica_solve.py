"""The amplitudes of elastica with given end angles on chords of unit length, many at once.

With psi the direction at an amplitude and w that of the chord, both from the line of the force,
psi - w is to be the given angle at either end. Newton's rule begins at the amplitudes whose
curvature, and slope of it, at the middle are those of the cubic of small deflections; a step
that does not help is made shorter. Where it fails, the angles are approached in 20 steps.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checks import figure, wrap
from assoc_hull.geometry.classical.elastica import force_frame, frame_direction
from assoc_hull.geometry.curves import FloatArray

__all__ = ["FREE_MODULUS", "fit_amplitudes", "least_modulus", "no_solution"]

FREE_MODULUS = float(np.sqrt(0.5))
"""The modulus of an elastica whose length adjusts itself."""

_AGREED = 1e-14
_MOST_STEPS = 60
_MOST_STEP = 0.5  # rad
_MET = 1e-10  # rad: end angles that agree so far are met
_TRIED = 1.0  # rad: end angles up to this are known to have a solution


def least_modulus(alpha: float, beta: float) -> float:
    """Give the modulus that end angles (rad, from the chord) need at least."""
    return abs(float(np.sin(0.25 * (alpha - beta))))


def fit_amplitudes(
    alpha: FloatArray,
    beta: FloatArray,
    k: FloatArray | float,
    near: tuple[FloatArray, FloatArray] | None = None,
) -> tuple[FloatArray, FloatArray, NDArray[np.bool_]]:
    """Find amplitudes for many pairs of end angles, on chords of unit length.

    Parameters
    ----------
    alpha, beta : (n,), rad
        Directions at start and end, from the chord; not both nil.
    k : (n,) or float
        Moduli.
    near : ((n,), (n,)), rad, optional
        First amplitudes and spans to begin at; nothing else is then tried.

    Returns
    -------
    phi0 : (n,), rad
        Amplitudes at the start.
    span : (n,), rad
        What the amplitude grows by.
    found : (n,) bool
        Where both directions are met.
    """
    modulus = np.broadcast_to(np.asarray(k, np.float64), alpha.shape)
    if near is not None:
        return _newton(alpha, beta, modulus, *near)
    phi0, span, met = _newton(alpha, beta, modulus, *_first_guess(alpha, beta, modulus))
    lost = np.flatnonzero(~met)
    if len(lost):
        phi0[lost], span[lost], met[lost] = _continued(alpha[lost], beta[lost], modulus[lost])
    return phi0, span, met


def _continued(
    alpha: FloatArray, beta: FloatArray, k: FloatArray
) -> tuple[FloatArray, FloatArray, NDArray[np.bool_]]:
    """Walk from small end angles to those wanted, in the same proportion."""
    phi0, span = _first_guess(0.05 * alpha, 0.05 * beta, k)
    met = np.ones(len(alpha), np.bool_)
    for part in np.linspace(0.05, 1.0, 20):
        phi0, span, met = _newton(part * alpha, part * beta, k, phi0, span)
    return phi0, span, met


def _first_guess(
    alpha: FloatArray, beta: FloatArray, k: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Match curvature and its slope at the middle of the cubic of small deflections."""
    first = -(4.0 * np.tan(alpha) + 2.0 * np.tan(beta))
    last = 2.0 * np.tan(alpha) + 4.0 * np.tan(beta)
    middle, growth = 0.5 * (first + last), last - first
    # With q the square of sin(phi) at the middle: A q (1 - k^2 q) = D (1 - q)^2.
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        a, d = (middle * middle / (2.0 * k)) ** 2, growth * growth
        root = np.sqrt(a * a + 4.0 * d * a * (1.0 - k * k))
        sine2, cosine2 = 2.0 * d / (2.0 * d + a + root), (a + root) / (2.0 * d + a + root)
        bend = np.abs(middle) / (2.0 * k * np.sqrt(cosine2))
    symmetric = np.sqrt(np.abs(growth) / (2.0 * k * np.sqrt(1.0 - k * k)))
    bend = np.where(middle == 0.0, symmetric, bend)
    phi = np.arctan2(-np.sign(growth) * np.sqrt(sine2), np.sign(middle) * np.sqrt(cosine2))
    phi = np.where(middle == 0.0, -np.sign(growth) * 0.5 * np.pi, phi)
    span = bend * np.sqrt(1.0 - k * k * np.sin(phi) ** 2)
    return phi - 0.5 * span, span


def _newton(
    alpha: FloatArray, beta: FloatArray, k: FloatArray, phi0: FloatArray, span: FloatArray
) -> tuple[FloatArray, FloatArray, NDArray[np.bool_]]:
    """Improve amplitudes until the directions agree, or do so no better."""
    phi0, span = phi0.copy(), span.copy()
    rest, table = _equations(alpha, beta, k, phi0, span)
    size = np.abs(rest).max(axis=0)
    alive = np.isfinite(size)
    for _ in range(_MOST_STEPS):
        alive &= size > _AGREED
        work = np.flatnonzero(alive)
        if not len(work):
            break
        step = _solved(table[:, :, work], -rest[:, work])
        step *= np.minimum(1.0, _MOST_STEP / np.maximum(np.abs(step).max(axis=0), 1e-300))
        better = np.zeros(len(work), np.bool_)
        for factor in (1.0, 0.5, 0.25, 0.1, 0.02):
            todo = np.flatnonzero(~better)
            if not len(todo):
                break
            who = work[todo]
            at = phi0[who] + factor * step[0, todo], span[who] + factor * step[1, todo]
            new, slopes = _equations(alpha[who], beta[who], k[who], *at)
            gain = (np.abs(new).max(axis=0) < size[who]) & (at[1] > 0.0)
            kept = who[gain]
            phi0[kept], span[kept] = at[0][gain], at[1][gain]
            rest[:, kept], table[:, :, kept] = new[:, gain], slopes[:, :, gain]
            size[kept] = np.abs(new).max(axis=0)[gain]
            better[todo[gain]] = True
        alive[work[~better]] = False
    return phi0, span, size <= _MET


def _solved(table: FloatArray, right: FloatArray) -> FloatArray:
    """Solve many systems of two equations, (2, 2, n) and (2, n)."""
    (a, b), (c, d) = table
    with np.errstate(invalid="ignore", divide="ignore"):
        found = np.stack([d * right[0] - b * right[1], a * right[1] - c * right[0]]) / (
            a * d - b * c
        )
    return np.asarray(np.nan_to_num(found, posinf=_MOST_STEP, neginf=-_MOST_STEP))


def _equations(
    alpha: FloatArray, beta: FloatArray, k: FloatArray, phi0: FloatArray, span: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Give what directions miss, (2, n) rad, and its derivatives by first amplitude and span."""
    phi1 = phi0 + span
    xi, eta, _ = force_frame(phi0, phi1, k)
    chord2 = xi * xi + eta * eta
    way = np.arctan2(eta, xi)
    rest = np.stack([
        wrap(frame_direction(phi, k) - way - wanted)
        for phi, wanted in ((phi0, alpha), (phi1, beta))
    ])  # fmt: skip
    with np.errstate(invalid="ignore", divide="ignore"):
        turns, sways = zip(*(_rates(phi, k, xi, eta, chord2) for phi in (phi0, phi1)), strict=True)
    # The chord's direction grows with the last amplitude and falls with the first.
    by_first = np.stack([turns[0] + sways[0], sways[0]])
    by_last = np.stack([-sways[1], turns[1] - sways[1]])
    return rest, np.stack([by_first + by_last, by_last], axis=1)


def _rates(
    phi: FloatArray, k: FloatArray, xi: FloatArray, eta: FloatArray, chord2: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Give how direction and the chord's direction go with an amplitude."""
    root = np.sqrt(1.0 - (k * np.sin(phi)) ** 2)
    sway = (xi * 2.0 * k * np.sin(phi) - eta * (2.0 * root - 1.0 / root)) / chord2
    return 2.0 * k * np.cos(phi) / root, sway


def no_solution(alpha: float, beta: float, k: float) -> GeometryError:
    """Say that there is no elastica with these end angles (rad) and modulus."""
    hint = f"give a modulus well above {figure(least_modulus(alpha, beta))}, which they need"
    if max(abs(alpha), abs(beta)) > _TRIED:
        hint = "give end angles up to 1 rad from the chord"
    return GeometryError(
        f"elastica: no solution found for end angles ({figure(alpha)},{figure(beta)})", hint,
        {"alpha": alpha, "beta": beta, "k": k},
    )  # fmt: skip
