"""The elastica, a thin rod bent by forces at its ends, and the one through two tangents.

`Elastica` is a segment in closed form by elliptic integrals; `fit_elastica` lays one between two
points with given tangents. Two points and two end angles are four data, an elastica has five
unknowns: a free length, a modulus or a length closes the problem. Lengths in m, angles in rad.
Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK, eq. 9.
"""

from __future__ import annotations

from typing import Literal, Self

import attrs
import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import ellipeinc, ellipj, ellipkinc

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import (
    check_magnitude,
    digits,
    finite_array,
    one_of,
    within_range,
    wrap_angle,
)
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.numeric.polynomials import brent_root

__all__ = [
    "FREE_MODULUS",
    "Elastica",
    "Family",
    "check_modulus",
    "elastica_of_length",
    "fit_amplitudes",
    "fit_elastica",
    "force_frame",
    "frame_direction",
    "least_modulus",
    "no_elastica_error",
]

# --------------------------------------------------------------------------------------
# A segment of an elastica.
#
# With modulus k, amplitude phi and rate beta (1/m), F and E the elliptic integrals of the first
# and second kind of parameter k^2, an inflecting elastica is, in axes along its force and from
# phi0 on,
#
#     beta xi = 2 (E - E0) - (F - F0),  beta eta = 2 k (cos phi0 - cos phi),  beta s = F - F0,
#
# its direction psi = 2 asin(k sin phi), its curvature 2 beta k cos phi. The one without
# inflections has p = 1 / k < 1, psi = 2 phi, and with D = sqrt(1 - p^2 sin^2 phi)
#
#     B xi = (1 - 2 / p^2) (F - F0) + 2 / p^2 (E - E0),  B eta = 2 / p^2 (D0 - D),  B s = F - F0,
#
# its curvature 2 B D. Along both the second derivative of the direction is -beta^2 sin psi, with
# B p for beta.

Family = Literal["inflecting", "not inflecting"]

_MOST_TURNS = 1e6
"""rad: beyond, an amplitude has lost the digits of its angle."""


def check_modulus(k: float) -> float:
    """Take a modulus between 0 and 1, neither included; raises GeometryError for others."""
    found = float(finite_array(k, "elastica", ()))
    if not 0.0 < found < 1.0:
        raise GeometryError(
            f"elastica: modulus k must lie in (0,1), not {digits(found)}",
            "give k between these; one without inflections takes p = 1 / k", {"k": found},
        )  # fmt: skip
    return found


def force_frame(
    phi0: FloatArray, phi1: FloatArray, k: FloatArray | float, family: Family = "inflecting"
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give xi, eta and s from one amplitude (rad) to another at unit rate, any shape.

    For the family without inflections k is the inverse of the modulus, p.
    """
    m = np.asarray(k * k)
    first, second = (
        f(phi1, m) - f(phi0, m) for f in (ellipkinc, ellipeinc)
    )  # differences of F and of E
    if family == "inflecting":
        # The difference of cosines as a product keeps its digits on a short segment.
        eta = 4.0 * k * np.sin(0.5 * (phi1 + phi0)) * np.sin(0.5 * (phi1 - phi0))
        return 2.0 * second - first, eta, first
    root0, root1 = (np.sqrt(1.0 - m * np.sin(phi) ** 2) for phi in (phi0, phi1))
    return first + 2.0 / m * (second - first), 2.0 / m * (root0 - root1), first


def frame_direction(
    phi: FloatArray, k: FloatArray | float, family: Family = "inflecting"
) -> FloatArray:
    """Give directions (rad) from the line of the force, any shape."""
    if family == "inflecting":
        return np.asarray(2.0 * np.arcsin(k * np.sin(phi)))
    return np.asarray(2.0 * phi)


@attrs.frozen(eq=False)
class Elastica:
    """A segment of an elastica in the plane, or a straight line.

    Attributes
    ----------
    start : (2,), m
        Its first point.
    rotation : float, rad
        Direction of the line of force.
    k : float
        Modulus; for the family without inflections its inverse, p.
    phi0, phi1 : float, rad
        Amplitudes at both ends, ascending.
    rate : float, 1/m
        Beta, or B; 0 for a straight line along `rotation`.
    length : float, m
        Along the curve.
    family : "inflecting" or "not inflecting"
        Of the two kinds above.
    """

    start: FloatArray
    rotation: float
    k: float
    phi0: float
    phi1: float
    rate: float
    length: float
    family: Family = "inflecting"

    def __attrs_post_init__(self) -> None:
        freeze(self.start)

    @classmethod
    def make(
        cls,
        k: float,
        phi0: float,
        phi1: float,
        rate: float = 1.0,
        *,
        start: ArrayLike = (0.0, 0.0),
        rotation: float = 0.0,
        family: Family = "inflecting",
    ) -> Self:
        """Make a segment from its amplitudes.

        Parameters
        ----------
        k, phi0, phi1, rate, start, rotation, family
            As the attributes; phi1 above phi0, the rate above 0.

        Raises
        ------
        GeometryError
            ``"elastica: modulus k must lie in (0,1)"``; amplitudes that do not ascend; a rate
            that is not above 0; an unknown family.

        Examples
        --------
        >>> from assoc_hull.geometry.classical.elastica import Elastica
        >>> loop = Elastica.make(0.8, -0.3, 1.2, 1.1, family="not inflecting")
        >>> round(loop.length, 9)
        1.547657369
        """
        modulus = check_modulus(k)
        low, high, speed, turn = (
            float(finite_array(each, "elastica", ())) for each in (phi0, phi1, rate, rotation)
        )
        one_of(family, ("inflecting", "not inflecting"), "elastica: no family")
        if not -_MOST_TURNS < low < high < _MOST_TURNS or not speed > 0.0:
            raise GeometryError(
                f"elastica: amplitudes {digits(low)} to {digits(high)} at a rate of "
                f"{digits(speed)}", "give ascending amplitudes below 1e6 and a rate above 0",
                {"phi0": low, "phi1": high, "rate": speed},
            )  # fmt: skip
        ends = np.array(low), np.array(high)
        length = float(force_frame(*ends, modulus, family)[2]) / speed
        check_magnitude(np.array([speed, max(abs(low), abs(high))]), "elastica")
        first = check_magnitude(finite_array(start, "elastica", (2,)), "elastica")
        return cls(first, turn, modulus, low, high, speed, length, family)

    @classmethod
    def straight(cls, start: ArrayLike, end: ArrayLike) -> Self:
        """Give the straight line between two points (2,), m."""
        first, last = (
            check_magnitude(finite_array(each, "elastica", (2,)), "elastica")
            for each in (start, end)
        )
        step = last - first
        angle, size = float(np.arctan2(step[1], step[0])), float(np.hypot(*step))
        return cls(first, angle, 1.0, 0.0, 0.0, 0.0, size)

    @property
    def is_straight(self) -> bool:
        """Whether it is a straight line."""
        return self.rate == 0.0

    def amplitude(self, s: ArrayLike) -> FloatArray:
        """Give amplitudes (rad) at arc lengths s of any shape, m.

        Raises
        ------
        GeometryError
            ``"elastica: x={x} outside [{a}, {b}]"``.
        """
        along = within_range(s, "elastica", 0.0, self.length, slack=1e-12 * self.length)
        if self.is_straight:
            return np.zeros_like(along)
        m = self.k * self.k
        found = ellipj(ellipkinc(self.phi0, m) + self.rate * along, m)[3]
        return np.clip(found, self.phi0, self.phi1)

    def frame_point(self, phi: ArrayLike) -> FloatArray:
        """Give xi, eta (..., 2), m, in axes of the force from the start, at amplitudes phi."""
        at = within_range(phi, "elastica", self.phi0, self.phi1, slack=1e-12)
        if self.is_straight:
            return np.zeros((*at.shape, 2))
        xi, eta, _ = force_frame(np.array(self.phi0), at, self.k, self.family)
        return np.stack([xi, eta], axis=-1) / self.rate

    def at(self, s: ArrayLike) -> FloatArray:
        """Give points (..., 2), m, at arc lengths s of any shape, m."""
        phi = self.amplitude(s)
        if self.is_straight:
            local = np.stack([np.asarray(s, np.float64), phi], axis=-1)
        else:
            local = self.frame_point(phi)
        cosine, sine = np.cos(self.rotation), np.sin(self.rotation)
        found: FloatArray = self.start + local @ np.array([[cosine, sine], [-sine, cosine]])
        return found

    def direction(self, s: ArrayLike) -> FloatArray:
        """Give directions (rad), not wrapped, at arc lengths s of any shape, m."""
        return self.rotation + self._psi(s)

    def _psi(self, s: ArrayLike) -> FloatArray:
        phi = self.amplitude(s)
        return phi if self.is_straight else frame_direction(phi, self.k, self.family)

    def curvature(self, s: ArrayLike) -> FloatArray:
        """Give curvature (1/m, positive to the left) at arc lengths s of any shape, m."""
        phi = self.amplitude(s)
        if self.family == "inflecting":
            return np.asarray(2.0 * self.rate * self.k * np.cos(phi))
        return np.asarray(2.0 * self.rate * np.sqrt(1.0 - (self.k * np.sin(phi)) ** 2))

    def curvature_rate(self, s: ArrayLike) -> FloatArray:
        """Give the derivative of curvature by arc length (1/m2) at arc lengths s, m."""
        beta = self.rate if self.family == "inflecting" else self.rate * self.k
        return np.asarray(-(beta**2) * np.sin(self._psi(s)))

    @property
    def energy(self) -> float:
        """The integral of the square of curvature along it, 1/m."""
        if self.is_straight:
            return 0.0
        m = self.k * self.k
        first, second = (
            float(f(self.phi1, m)) - float(f(self.phi0, m)) for f in (ellipkinc, ellipeinc)
        )
        if self.family == "inflecting":
            return 4.0 * self.rate * (second - (1.0 - m) * first)
        return 4.0 * self.rate * second


# --------------------------------------------------------------------------------------
# Amplitudes of given end angles on chords of unit length. With psi the direction at an amplitude
# and w that of the chord, both from the line of the force, psi - w is to be the given angle at
# either end: two equations for the first amplitude and the span of amplitudes.

FREE_MODULUS = float(np.sqrt(0.5))
"""The modulus of an elastica whose length adjusts itself without friction: the energy of bending
is stationary there."""

_AGREED = 1e-14  # rad: Newton's rule stops here
_MOST_STEPS = 60
_MOST_STEP = 0.5  # rad
_SOLVED = 1e-10  # rad: residuals of end angles up to this count as a solution
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
    """Find first amplitudes and spans (rad) for pairs of end angles; last, which were found, (n,).

    `alpha`, `beta` (n,), rad, are directions from the chord, not both zero. Newton's rule begins at
    amplitudes and spans `near`, and nothing else is then tried; without it, at the cubic of small
    deflections, and where that fails the angles are approached in 20 steps.
    """
    modulus = np.broadcast_to(np.asarray(k, np.float64), alpha.shape)
    if near is not None:
        return _newton(alpha, beta, modulus, *near)
    phi0, span, solved = _newton(alpha, beta, modulus, *_first_guess(alpha, beta, modulus))
    lost = np.flatnonzero(~solved)
    if len(lost):
        phi0[lost], span[lost], solved[lost] = _approach_angles(
            alpha[lost], beta[lost], modulus[lost]
        )
    return phi0, span, solved


def _approach_angles(
    alpha: FloatArray, beta: FloatArray, k: FloatArray
) -> tuple[FloatArray, FloatArray, NDArray[np.bool_]]:
    """Walk from small end angles to those wanted, in the same proportion."""
    phi0, span = _first_guess(0.05 * alpha, 0.05 * beta, k)
    solved = np.ones(len(alpha), np.bool_)
    for part in np.linspace(0.05, 1.0, 20):
        phi0, span, solved = _newton(part * alpha, part * beta, k, phi0, span)
    return phi0, span, solved


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
    """Improve amplitudes until directions agree to `_AGREED`, or no shorter step helps either."""
    phi0, span = phi0.copy(), span.copy()
    residual, table = _equations(alpha, beta, k, phi0, span)
    size = np.abs(residual).max(axis=0)
    alive = np.isfinite(size)
    for _ in range(_MOST_STEPS):
        alive &= size > _AGREED
        work = np.flatnonzero(alive)
        if not len(work):
            break
        step = _solve_pairs(table[:, :, work], -residual[:, work])
        step *= np.minimum(1.0, _MOST_STEP / np.maximum(np.abs(step).max(axis=0), 1e-300))
        better = np.zeros(len(work), np.bool_)
        for factor in (1.0, 0.5, 0.25, 0.1, 0.02):
            todo = np.flatnonzero(~better)
            if not len(todo):
                break
            who = work[todo]
            at = phi0[who] + factor * step[0, todo], span[who] + factor * step[1, todo]
            new, slopes = _equations(alpha[who], beta[who], k[who], *at)
            # The amplitude must grow along the curve: a span of the other sign is another curve.
            gain = (np.abs(new).max(axis=0) < size[who]) & (at[1] > 0.0)
            kept = who[gain]
            phi0[kept], span[kept] = at[0][gain], at[1][gain]
            residual[:, kept], table[:, :, kept] = new[:, gain], slopes[:, :, gain]
            size[kept] = np.abs(new).max(axis=0)[gain]
            better[todo[gain]] = True
        alive[work[~better]] = False
    return phi0, span, size <= _SOLVED


def _solve_pairs(table: FloatArray, right: FloatArray) -> FloatArray:
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
    """Give the residuals of directions, (2, n) rad, and derivatives by first amplitude and span."""
    phi1 = phi0 + span
    xi, eta, _ = force_frame(phi0, phi1, k)
    chord2 = xi * xi + eta * eta
    way = np.arctan2(eta, xi)
    residual = np.stack([
        wrap_angle(frame_direction(phi, k) - way - wanted)
        for phi, wanted in ((phi0, alpha), (phi1, beta))
    ])  # fmt: skip
    with np.errstate(invalid="ignore", divide="ignore"):
        turns, sways = zip(
            *(_amplitude_rates(phi, k, xi, eta, chord2) for phi in (phi0, phi1)), strict=True
        )
    # The chord's direction grows with the last amplitude and falls with the first.
    by_first = np.stack([turns[0] + sways[0], sways[0]])
    by_last = np.stack([-sways[1], turns[1] - sways[1]])
    return residual, np.stack([by_first + by_last, by_last], axis=1)


def _amplitude_rates(
    phi: FloatArray, k: FloatArray, xi: FloatArray, eta: FloatArray, chord2: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Give how direction and the chord's direction go with an amplitude."""
    root = np.sqrt(1.0 - (k * np.sin(phi)) ** 2)
    sway = (xi * 2.0 * k * np.sin(phi) - eta * (2.0 * root - 1.0 / root)) / chord2
    return 2.0 * k * np.cos(phi) / root, sway


def no_elastica_error(alpha: float, beta: float, k: float) -> GeometryError:
    """Say that there is no elastica with these end angles (rad) and modulus."""
    hint = f"give a modulus well above {digits(least_modulus(alpha, beta))}, which they need"
    if max(abs(alpha), abs(beta)) > _TRIED:
        hint = "give end angles up to 1 rad from the chord"
    return GeometryError(
        f"elastica: no solution found for end angles ({digits(alpha)},{digits(beta)})", hint,
        {"alpha": alpha, "beta": beta, "k": k},
    )  # fmt: skip


# --------------------------------------------------------------------------------------
# The modulus of a given length. Along the family that begins at the free length (k^2 = 1/2) the
# length falls as the modulus rises. Towards a modulus of 1 it nears its least; towards small moduli
# the family ends where it folds back, at its greatest length. Longer ones exist, with further
# waves; they are not sought.

_PARTS = np.array([
    1e-9, 1e-6, 1e-4, 1e-3, 0.01, 0.03, 0.06, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5,
    0.55, 0.6, 0.7, 0.8, 0.9, 0.95, 0.98, 0.99, 0.999, 0.9999, 1.0 - 1e-6,
])  # fmt: skip
"""Moduli at which the family is solved, as parts of the way from the least modulus to 1."""

_HALVINGS = 20  # leave a millionth of a step of the modulus before the fold
_JUMP = 1.1  # rad: a span that changes by more belongs to another family


@attrs.frozen(eq=False)
class _Member:
    """One of a family: its modulus, amplitude at the start, span, and length over chord."""

    k: float
    phi0: float
    span: float
    ratio: float


def elastica_of_length(
    alpha: float, beta: float, ratio: float, chord: float
) -> tuple[float, float, float]:
    """Find modulus, first amplitude (rad) and span (rad) of the elastica of a length over chord.

    End angles from the chord, rad, not both zero; the chord (m) is for the message. Raises
    GeometryError for a length out of reach, and where the angles have no solution at the free one.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.elastica import elastica_of_length
    >>> round(elastica_of_length(0.5, -0.3, 1.03, 1.0)[0], 9)
    0.423998899
    """
    family = _family(alpha, beta)
    if not family[-1].ratio <= ratio <= family[0].ratio:
        least, most = chord * family[-1].ratio, chord * family[0].ratio
        raise GeometryError(
            f"elastica: length {digits(chord * ratio)} outside the attainable range "
            f"[{digits(least)},{digits(most)}]", "ask within it, or leave the length free",
            {"length": chord * ratio, "least": least, "most": most},
        )  # fmt: skip
    ratios = np.array([each.ratio for each in family])
    after = int(np.clip(np.searchsorted(-ratios, -ratio), 1, len(ratios) - 1))
    low, high = family[after - 1], family[after]

    def missing(k: float) -> float:
        return _member_between(low, high, k, alpha, beta).ratio - ratio

    k = low.k
    # The root is bracketed by members that are known: either may have the length itself.
    if missing(high.k) == 0.0:
        k = high.k
    elif missing(low.k) != 0.0:
        k = brent_root(missing, low.k, high.k, xtol=1e-15, rtol=8.9e-16)
    found = _member_between(low, high, k, alpha, beta)
    return k, found.phi0, found.span


def _member_between(low: _Member, high: _Member, k: float, alpha: float, beta: float) -> _Member:
    """Solve for a modulus between two members, begun between their amplitudes."""
    part = (k - low.k) / (high.k - low.k)
    begin = low.phi0 + part * (high.phi0 - low.phi0), low.span + part * (high.span - low.span)
    return _member_of_modulus(alpha, beta, k, begin) or low


def _member_of_modulus(
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
    home = _member_of_modulus(alpha, beta, FREE_MODULUS, None)
    if home is None:
        raise no_elastica_error(alpha, beta, FREE_MODULUS)
    least = least_modulus(alpha, beta)
    k = least + (1.0 - least) * _PARTS
    up = _follow_family(alpha, beta, home, k[k > FREE_MODULUS])
    down = _follow_family(alpha, beta, home, k[k < FREE_MODULUS][::-1])
    return [*down[::-1], home, *up]


def _follow_family(alpha: float, beta: float, home: _Member, moduli: FloatArray) -> list[_Member]:
    """Follow the family from one modulus to the next, to its end."""
    members = [home]
    for k in moduli.tolist():
        new = _next_member(alpha, beta, members[-2:], k)
        if new is None:
            _extend_to_fold(alpha, beta, members, k)
            break
        members.append(new)
    return members[1:]


def _next_member(alpha: float, beta: float, last: list[_Member], k: float) -> _Member | None:
    """Give the member of another modulus, if it is one of the same family as the last two."""
    before, at = last[0], last[-1]
    part = (k - at.k) / (at.k - before.k) if at is not before else 0.0
    begin = (
        at.phi0 + part * (at.phi0 - before.phi0),
        # A span that is extrapolated to nothing would have no chord.
        max(at.span + part * (at.span - before.span), 0.1 * at.span),
    )
    new = _member_of_modulus(alpha, beta, k, begin)
    if new is None or abs(new.span - at.span) > _JUMP:
        return None
    return new if (new.ratio - at.ratio) * (k - at.k) < 0.0 else None


def _extend_to_fold(alpha: float, beta: float, members: list[_Member], out: float) -> None:
    """Add members up to where the family ends, before a modulus without one."""
    for _ in range(_HALVINGS):
        middle = 0.5 * (out + members[-1].k)
        new = _next_member(alpha, beta, members[-2:], middle)
        if new is None:
            out = middle
        else:
            members.append(new)


# --------------------------------------------------------------------------------------
# Elastica through two points with given tangents.


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
        A straight line where both angles are zero.

    Raises
    ------
    GeometryError
        ``"elastica: modulus k must lie in (0,1)"``, ``"elastica: no solution found for end
        angles ({a},{b})"``, ``"elastica: length {L} outside the attainable range [{lo},{hi}]"``.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.elastica import fit_elastica
    >>> round(fit_elastica([0, 0], [1, 0], 0.5, -0.3, length=1.03).k, 9)
    0.423998899
    """
    first, last = (
        check_magnitude(finite_array(each, "elastica", (2,)), "elastica") for each in (start, end)
    )
    a, b = (float(wrap_angle(finite_array(each, "elastica", ()))) for each in (alpha, beta))
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
        return _solve_for_modulus(
            first, step, a, b, FREE_MODULUS if k is None else check_modulus(k)
        )
    wanted = float(finite_array(length, "elastica", ()))
    modulus, *near = elastica_of_length(a, b, wanted / chord, chord)
    return _place_on_chord(first, step, modulus, *near)


def _check_straight(length: float | None, k: float | None, chord: float) -> None:
    if k is not None:
        check_modulus(k)
    if length is None:
        return
    wanted = float(finite_array(length, "elastica", ()))
    if abs(wanted - chord) > 1e-12 * chord:
        raise GeometryError(
            f"elastica: length {digits(wanted)} outside the attainable range "
            f"[{digits(chord)},{digits(chord)}]", "a straight line has the length of its chord",
            {"length": wanted, "least": chord, "most": chord},
        )  # fmt: skip


def _solve_for_modulus(
    first: FloatArray, step: FloatArray, a: float, b: float, k: float
) -> Elastica:
    """Solve for amplitudes of one modulus."""
    phi0, span, solved = fit_amplitudes(np.array([a]), np.array([b]), k)
    if not solved[0]:
        raise no_elastica_error(a, b, k)
    return _place_on_chord(first, step, k, float(phi0[0]), float(span[0]))


def _place_on_chord(
    first: FloatArray, step: FloatArray, k: float, phi0: float, span: float
) -> Elastica:
    """Turn and scale a segment from the frame of its force onto its chord."""
    ends = np.array(phi0), np.array(phi0 + span)
    xi, eta, _ = (float(each) for each in force_frame(*ends, k))
    rate = float(np.hypot(xi, eta)) / float(np.hypot(*step))
    turn = float(np.arctan2(step[1], step[0]) - np.arctan2(eta, xi))
    return Elastica.make(k, phi0, phi0 + span, rate, start=first, rotation=turn)
