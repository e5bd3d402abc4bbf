"""Sections as images of a circle: two terms after Lewis, or more by least squares.

Half a section below the waterline, t from 0 at the keel to pi/2 at the waterline, y half-breadth
and z depth *below the waterline*:

    y = M [sin t + a1 sin t - a3 sin 3t + a5 sin 5t - ...]
    z = M [cos t - a1 cos t + a3 cos 3t - a5 cos 5t + ...]

The area of the whole section is (pi/2) M^2 (1 - a1^2 - 3 a3^2 - 5 a5^2 - ...). Two terms follow
from the ratio of half-breadth to draught and the area coefficient in closed form. An image may fold
or cross the centre line; such a section is refused. One that only swells a little beyond breadth
and draught, as very full ones do, is not.

Sources: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK (Tuck and von Kerczek); F.M. Lewis, "The inertia of the water surrounding a
vibrating ship", Trans. SNAME 37, 1929.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import digits, numbers, whole_number, within_range
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["ConformalSections", "fit_conformal", "lewis_sections"]

_CHECKED = 181
"""Angles at which folds are looked for: every half degree, and exactly for two terms."""

_TRIALS = 100
"""Of the angles of offsets; a section takes ten to forty."""

_ROUNDING = 1e-9
"""Less than this part of the scale on the wrong side is rounding."""


@attrs.frozen(eq=False)
class ConformalSections:
    """Sections as images of a circle, many at once.

    Attributes
    ----------
    scale : (k,), m
        M.
    terms : (k, n)
        a1, a3, a5 ...
    """

    scale: FloatArray
    terms: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.scale, self.terms)

    def __len__(self) -> int:
        return len(self.scale)

    @property
    def orders(self) -> FloatArray:
        """1, 3, 5 ... of the terms, (n,)."""
        return np.asarray(2.0 * np.arange(self.terms.shape[1]) + 1.0, np.float64)

    def at(self, t: ArrayLike) -> FloatArray:
        """Give half-breadth and depth below the waterline at angles.

        Parameters
        ----------
        t : (m,) or (), rad
            From 0 at the keel to pi/2 at the waterline, the same for all sections.

        Returns
        -------
        (k, m, 2) or (k, 2), m

        Raises
        ------
        GeometryError
            ``"conformal section: x={x} outside [{a}, {b}]"``.

        Examples
        --------
        >>> from assoc_hull.geometry.classical.conformal_sections import lewis_sections
        >>> lewis_sections([6.0], [5.0], [0.94]).at(0.0)[0].round(9).tolist()
        [0.0, 5.0]
        """
        return _image(
            self.scale, self.terms, within_range(t, "conformal section", 0.0, 0.5 * np.pi)
        )

    def areas(self) -> FloatArray:
        """Give the areas of the whole sections below the waterline, (k,), m2."""
        lost = np.sum(self.orders * self.terms**2, axis=1)
        return np.asarray(0.5 * np.pi * self.scale**2 * (1.0 - lost))

    def draughts(self) -> FloatArray:
        """Give depths of the keel below the waterline, (k,), m."""
        return self.at(0.0)[:, 1]

    def half_breadths(self) -> FloatArray:
        """Give half-breadths at the waterline, (k,), m."""
        return self.at(0.5 * np.pi)[:, 0]

    def simple(self) -> np.ndarray[tuple[int, ...], np.dtype[np.bool_]]:
        """Tell which are neither folded nor cross centre line or waterline, (k,)."""
        t = np.linspace(0.0, 0.5 * np.pi, _CHECKED)
        place, rate = _image(self.scale, self.terms, t), _image(self.scale, self.terms, t, 1)
        slack = _ROUNDING * self.scale[:, None]
        inward, down = rate[..., 0] < -slack, rate[..., 1] > slack
        outside = (place < -slack[..., None]).any(axis=(1, 2))
        good = np.asarray(~outside & ~(inward & down).any(axis=1))
        # Without both there is no loop; with both, there may be none.
        for k in np.flatnonzero(good & inward.any(axis=1) & down.any(axis=1)):
            good[k] = not _crosses_itself(place[k])
        return good

    def checked(self) -> ConformalSections:
        """Give these if all are simple.

        Raises
        ------
        GeometryError
            ``"conformal section: not simple"``.
        """
        bad = np.flatnonzero(~self.simple())
        if len(bad):
            told = ", ".join(digits(each) for each in self.terms[bad[0]])
            raise GeometryError(
                f"conformal section: not simple (section {bad[0]}, terms {told})",
                "take another area coefficient or ratio of breadth to draught, or fewer terms",
                {"index": int(bad[0]), "terms": self.terms[bad[0]].tolist()},
            )  # fmt: skip
        return self


def lewis_sections(
    half_breadth: ArrayLike, draught: ArrayLike, coefficient: ArrayLike
) -> ConformalSections:
    """Make sections of two terms from breadth, draught and area.

    Parameters
    ----------
    half_breadth, draught : (k,), m
        At the waterline, and below it; above 0.
    coefficient : (k,)
        Area of the section by breadth times draught.

    Returns
    -------
    ConformalSections

    Raises
    ------
    GeometryError
        ``"conformal section: not simple"``; values that are not above 0, an area coefficient
        for which there are no two terms.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.conformal_sections import lewis_sections
    >>> lewis_sections([6.0], [5.0], [0.94]).terms[0].round(9).tolist()
    [0.081927588, -0.098796528]
    """
    beam = numbers(half_breadth, "conformal section", (None,))
    deep, sigma = (
        numbers(each, "conformal section", (len(beam),)) for each in (draught, coefficient)
    )
    for name, values in (("half-breadth", beam), ("draught", deep), ("area coefficient", sigma)):
        bad = np.flatnonzero(values <= 0.0)
        if len(bad):
            what = f"conformal section: {name} {digits(values[bad[0]])} at index {bad[0]}"
            raise GeometryError(what, "give values above 0", {"index": int(bad[0])})
    ratio, full = (beam - deep) / (beam + deep), 4.0 * sigma / np.pi
    c1 = 3.0 + full + (1.0 - full) * ratio**2
    bad = np.flatnonzero(c1 > 4.5)
    if len(bad):
        value = digits(sigma[bad[0]])
        what = f"conformal section: no two terms give area coefficient {value} at index {bad[0]}"
        raise GeometryError(what, "give a smaller one", {"index": int(bad[0])})
    a3 = (3.0 - c1 + np.sqrt(9.0 - 2.0 * c1)) / c1
    a1 = ratio * (1.0 + a3)
    return ConformalSections(beam / (1.0 + a1 + a3), np.stack([a1, a3], axis=1)).checked()


def fit_conformal(offsets: ArrayLike, terms: int) -> tuple[ConformalSections, FloatArray]:
    """Fit a section of more terms to offsets.

    Angles of the offsets are unknown too: they start in proportion to arc length and are moved
    with scale and terms until the sum of squared distances is least. An offset on the centre line
    keeps angle 0, one on the waterline pi/2.

    Parameters
    ----------
    offsets : (n, 2), m
        Half-breadth and depth below the waterline, from the keel to the waterline.
    terms : int
        How many of a1, a3, a5 ...; at most n - 2.

    Returns
    -------
    ConformalSections
        Of one section.
    (n,), m
        How far each offset lies from its image.

    Raises
    ------
    GeometryError
        ``"conformal section: not simple"``; too few offsets, or two that are one.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.classical.conformal_sections import fit_conformal, lewis_sections
    >>> section = lewis_sections([6.0], [5.0], [0.94])
    >>> again, off = fit_conformal(section.at(np.linspace(0.0, np.pi / 2, 12))[0], 2)
    >>> bool(np.abs(again.terms - section.terms).max() < 1e-7), bool(off.max() < 1e-6)
    (True, True)
    """
    from scipy.optimize import least_squares

    points = numbers(offsets, "conformal section", (None, 2))
    if len(points) < 3:
        what = f"conformal section: {len(points)} offsets"
        raise GeometryError(what, "give three or more")
    whole_number(terms, "conformal section: terms", 1, len(points) - 2)
    steps = np.hypot(*np.diff(points, axis=0).T)
    if not (steps > 0.0).all():
        what = f"conformal section: coincident points at index {int(np.argmin(steps)) + 1}"
        raise GeometryError(what, "leave one of them out")
    if points[0, 1] <= points[-1, 1]:
        what = f"conformal section: depths from {digits(points[0, 1])} to {digits(points[-1, 1])}"
        raise GeometryError(what, "give offsets from the keel to the waterline")
    arc = np.concatenate([[0.0], np.cumsum(steps)])
    start: FloatArray = 0.5 * np.pi * arc / arc[-1]
    if points.max(axis=0).min() <= 0.0:
        what = "conformal section: not simple (offsets on one line)"
        raise GeometryError(what, "give half-breadths and depths above 0")
    if points[0, 0] > 0.0 or points[-1, 1] > 0.0:
        # Where the ends are open, angles begin with those of an ellipse about the waterline.
        start = np.arctan2(*(points / points.max(axis=0)).T)
    free = (points[:, 0] != 0.0) & (points[:, 1] != 0.0)
    start[points[:, 0] == 0.0], start[points[:, 1] == 0.0] = 0.0, 0.5 * np.pi
    high = 0.5 * np.pi

    def whole(angles: FloatArray) -> FloatArray:
        t = start.copy()
        t[free] = angles
        return t

    def off(angles: FloatArray) -> FloatArray:
        return np.asarray(_linear(points, whole(angles), terms)[1])

    if free.any():
        begin = np.clip(start[free], 1e-6, high - 1e-6)
        found = least_squares(
            off, begin, bounds=(0.0, high), xtol=1e-14, ftol=1e-14, gtol=1e-14, max_nfev=_TRIALS
        )
        start = whole(found.x)
    linear, residual = _linear(points, start, terms)
    if linear[0] <= 0.0:
        what = f"conformal section: not simple (scale {digits(linear[0])})"
        raise GeometryError(what, "give offsets from keel to waterline", {"scale": linear[0]})
    section = ConformalSections(linear[:1].copy(), (linear[1:] / linear[0])[None, :]).checked()
    return section, np.hypot(*residual.reshape(2, -1))


def _crosses_itself(points: FloatArray) -> bool:
    """Tell whether a polyline (n, 2) crosses itself."""
    start, step = points[:-1], np.diff(points, axis=0)

    def side(places: FloatArray) -> FloatArray:
        """Give on which side of each step (rows) the places (columns) lie."""
        away = places[None] - start[:, None]
        turn = step[:, None, 0] * away[..., 1] - step[:, None, 1] * away[..., 0]
        return np.asarray(np.sign(turn))

    other = side(points[:-1]) * side(points[1:]) < 0.0
    both = other & other.T
    return bool(np.triu(both, 2).any())


def _linear(points: FloatArray, t: FloatArray, terms: int) -> tuple[FloatArray, FloatArray]:
    """Give M and M times the terms for given angles, and the residuals (2n,): y, then z."""
    order = 2.0 * np.arange(terms) + 1.0
    sign = np.resize([1.0, -1.0], terms)
    across = np.column_stack([np.sin(t), sign * np.sin(np.outer(t, order))])
    down = np.column_stack([np.cos(t), -sign * np.cos(np.outer(t, order))])
    columns = np.vstack([across, down])
    wanted = points.T.ravel()
    found = np.asarray(np.linalg.lstsq(columns, wanted, rcond=None)[0], np.float64)
    residual: FloatArray = columns @ found - wanted
    return found, residual


def _image(scale: FloatArray, terms: FloatArray, t: FloatArray, rate: int = 0) -> FloatArray:
    """Give y and z, or their rates by t, (k, ..., 2)."""
    order = 2.0 * np.arange(terms.shape[1]) + 1.0
    signed = terms * np.resize([1.0, -1.0], terms.shape[1])
    angle = t[..., None] * order
    if rate:
        y, z = np.cos(t), -np.sin(t)
        more = (order * np.cos(angle), order * np.sin(angle))
    else:
        y, z = np.sin(t), np.cos(t)
        more = (np.sin(angle), -np.cos(angle))
    across, down = (np.tensordot(signed, each, axes=(1, -1)) for each in more)
    shape = (len(scale), *(1,) * t.ndim, 1)
    return np.asarray(scale.reshape(shape) * np.stack([y + across, z + down], axis=-1))
