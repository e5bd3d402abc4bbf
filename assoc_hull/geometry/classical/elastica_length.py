"""The modulus at which an elastica with given end angles has a given length.

Along the family that begins at the free length (k^2 = 1/2) the length falls as the modulus
rises. Towards a modulus of 1 it nears its least; towards small moduli the family ends where it
folds back, at its greatest length. Longer ones exist, with further waves; they are not sought.
"""

from __future__ import annotations

import attrs
import numpy as np
from scipy.optimize import brentq

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checks import figure
from assoc_hull.geometry.classical.elastica import force_frame
from assoc_hull.geometry.classical.elastica_solve import (
    FREE_MODULUS,
    fit_amplitudes,
    least_modulus,
    no_solution,
)
from assoc_hull.geometry.curves import FloatArray

__all__ = ["with_length"]

_PARTS = np.array([
    1e-9, 1e-6, 1e-4, 1e-3, 0.01, 0.03, 0.06, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5,
    0.55, 0.6, 0.7, 0.8, 0.9, 0.95, 0.98, 0.99, 0.999, 0.9999, 1.0 - 1e-6,
])  # fmt: skip
"""Where the family is looked at, between the least modulus and 1."""

_HALVINGS = 20
_JUMP = 1.1  # rad: a span that changes by more belongs to another family


@attrs.frozen(eq=False)
class _Member:
    """One of a family: its modulus, amplitude at the start, span, and length over chord."""

    k: float
    phi0: float
    span: float
    ratio: float


def with_length(
    alpha: float, beta: float, ratio: float, chord: float
) -> tuple[float, float, float]:
    """Find the elastica of a length.

    Parameters
    ----------
    alpha, beta : float, rad
        End angles from the chord, not both nil.
    ratio : float
        Length over chord.
    chord : float, m
        For the message.

    Returns
    -------
    float, float, float
        Modulus, amplitude at the start and span of amplitudes.

    Raises
    ------
    GeometryError
        ``"elastica: length {L} outside the attainable range [{lo},{hi}]"``, or no solution for
        these angles at the free length.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.elastica_length import with_length
    >>> round(with_length(0.5, -0.3, 1.03, 1.0)[0], 9)
    0.423998899
    """
    family = _family(alpha, beta)
    if not family[-1].ratio <= ratio <= family[0].ratio:
        least, most = chord * family[-1].ratio, chord * family[0].ratio
        raise GeometryError(
            f"elastica: length {figure(chord * ratio)} outside the attainable range "
            f"[{figure(least)},{figure(most)}]", "ask within it, or leave the length free",
            {"length": chord * ratio, "least": least, "most": most},
        )  # fmt: skip
    ratios = np.array([each.ratio for each in family])
    after = int(np.clip(np.searchsorted(-ratios, -ratio), 1, len(ratios) - 1))
    low, high = family[after - 1], family[after]

    def missing(k: float) -> float:
        return _between(low, high, k, alpha, beta).ratio - ratio

    k = low.k
    if missing(high.k) == 0.0:
        k = high.k
    elif missing(low.k) != 0.0:
        k = float(brentq(missing, low.k, high.k, xtol=1e-15, rtol=8.9e-16))
    found = _between(low, high, k, alpha, beta)
    return k, found.phi0, found.span


def _between(low: _Member, high: _Member, k: float, alpha: float, beta: float) -> _Member:
    """Solve for a modulus between two members, begun between their amplitudes."""
    part = (k - low.k) / (high.k - low.k)
    begin = low.phi0 + part * (high.phi0 - low.phi0), low.span + part * (high.span - low.span)
    return _solved(alpha, beta, k, begin) or low


def _solved(
    alpha: float, beta: float, k: float, begin: tuple[float, float] | None
) -> _Member | None:
    """Give the member of a modulus, or nothing where there is none nearby."""
    ends = np.array([alpha]), np.array([beta])
    near = None if begin is None else (np.array(begin[:1]), np.array(begin[1:]))
    phi0, span, found = fit_amplitudes(*ends, k, near)
    if not found[0]:
        return None
    xi, eta, length = (float(each[0]) for each in force_frame(phi0, phi0 + span, np.array([k])))
    return _Member(k, float(phi0[0]), float(span[0]), length / float(np.hypot(xi, eta)))


def _family(alpha: float, beta: float) -> list[_Member]:
    """Give members by ascending modulus, their lengths falling."""
    home = _solved(alpha, beta, FREE_MODULUS, None)
    if home is None:
        raise no_solution(alpha, beta, FREE_MODULUS)
    least = least_modulus(alpha, beta)
    k = least + (1.0 - least) * _PARTS
    up = _walk(alpha, beta, home, k[k > FREE_MODULUS])
    down = _walk(alpha, beta, home, k[k < FREE_MODULUS][::-1])
    return [*down[::-1], home, *up]


def _walk(alpha: float, beta: float, home: _Member, moduli: FloatArray) -> list[_Member]:
    """Follow the family from one modulus to the next, to its end."""
    members = [home]
    for k in moduli.tolist():
        new = _next(alpha, beta, members[-2:], k)
        if new is None:
            _go_to_the_fold(alpha, beta, members, k)
            break
        members.append(new)
    return members[1:]


def _next(alpha: float, beta: float, last: list[_Member], k: float) -> _Member | None:
    """Give the member of another modulus, if it is one of the same family as the last two."""
    before, at = last[0], last[-1]
    part = (k - at.k) / (at.k - before.k) if at is not before else 0.0
    begin = (
        at.phi0 + part * (at.phi0 - before.phi0),
        max(at.span + part * (at.span - before.span), 0.1 * at.span),
    )
    new = _solved(alpha, beta, k, begin)
    if new is None or abs(new.span - at.span) > _JUMP:
        return None
    return new if (new.ratio - at.ratio) * (k - at.k) < 0.0 else None


def _go_to_the_fold(alpha: float, beta: float, members: list[_Member], out: float) -> None:
    """Add members up to where the family ends, before a modulus without one."""
    for _ in range(_HALVINGS):
        middle = 0.5 * (out + members[-1].k)
        new = _next(alpha, beta, members[-2:], middle)
        if new is None:
            out = middle
        else:
            members.append(new)
