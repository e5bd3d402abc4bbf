"""Lackenby's shift of sections, for one half body, in half lengths from midship outward.

    dx = (1 - x) { dp/(1 - p) + (x - p)/A [dphi - dp (1 - phi)/(1 - p)] },
    A  = phi (1 - 2 xb) - p (1 - phi),

changes the prismatic coefficient phi of a half body with parallel part p and centroid xb by dphi
and the parallel part by dp, both exactly, whatever the curve of areas. With the parallel part left
to come out, dx = (1 - x) dphi/(1 - phi).

Sources: H. Lackenby, "On the systematic geometrical variation of ship forms", Trans. INA 92, 1950;
Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and Production",
J. SNAK. A hull is shifted by `Hull.shift_sections`, which has more shapes and closes on both
coefficient and centre.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import digits, numbers, within_range
from assoc_hull.geometry.curves import FloatArray

__all__ = ["lackenby_shift", "one_minus_prismatic"]


def lackenby_shift(
    x: ArrayLike, phi: float, centroid: float, change: float, parallel: float = 0.0,
    parallel_change: float = 0.0,
) -> FloatArray:  # fmt: skip
    """Give by how far sections move outward.

    Parameters
    ----------
    x : (...)
        Places of sections, from `parallel` to 1.
    phi, centroid, parallel : float
        phi, xb and p of the half body.
    change, parallel_change : float
        dphi and dp.

    Returns
    -------
    (...)
        dx, in half lengths.

    Raises
    ------
    GeometryError
        ``"Lackenby: sections cross"``; x within the parallel part or beyond the end, a half body
        that there is not.

    Examples
    --------
    Areas 1 up to 0.3, then 1 - ((x - 0.3)/0.7)^2:

    >>> from assoc_hull.geometry.classical.lackenby_shift import lackenby_shift
    >>> phi, moment = 0.3 + 1.4 / 3, 0.045 + 0.14 + 0.1225
    >>> round(float(lackenby_shift(0.6, phi, moment / phi, 0.02, 0.3, 0.03)), 11)
    0.03183673469
    """
    full, centre, dphi, p, dp = numbers(
        [phi, centroid, change, parallel, parallel_change], "Lackenby", (5,)
    ).tolist()
    _check_half(full, p)
    _check_half(full, p + dp)
    places = within_range(x, "Lackenby", p, 1.0)
    spread = full * (1.0 - 2.0 * centre) - p * (1.0 - full)
    if not spread > 0.0:
        what = f"Lackenby: A = {digits(spread)} of phi {digits(full)}, centroid {digits(centre)}"
        raise GeometryError(what, "no half body has these", {"A": spread})
    first = dp / (1.0 - p)
    rest = (dphi - dp * (1.0 - full) / (1.0 - p)) / spread
    # dx = (1 - x)(first + (x - p) rest): its rate is linear in x, so both ends tell.
    rate = 1.0 - first + rest * np.array([1.0 - p, -(1.0 - p)])
    if rate.min() <= 0.0:
        place = digits((p, 1.0)[int(np.argmin(rate))])
        raise GeometryError(
            f"Lackenby: sections cross (1 + d(dx)/dx = {digits(rate.min())} at x={place})",
            "change less, or lengthen the parallel part with it", {"rate": float(rate.min())},
        )  # fmt: skip
    return np.asarray((1.0 - places) * (first + (places - p) * rest))


def one_minus_prismatic(x: ArrayLike, phi: float, change: float) -> FloatArray:
    """Give by how far sections move if the parallel part is left to come out.

    Parameters
    ----------
    x : (...)
        Places of sections, 0 to 1.
    phi, change : float
        phi and dphi.

    Raises
    ------
    GeometryError
        ``"Lackenby: sections cross"``; as `lackenby_shift`.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.lackenby_shift import one_minus_prismatic
    >>> round(float(one_minus_prismatic(0.6, 0.3 + 1.4 / 3, 0.02)), 11)
    0.03428571429
    """
    full, dphi = numbers([phi, change], "Lackenby", (2,)).tolist()
    _check_half(full, 0.0)
    rate = 1.0 - dphi / (1.0 - full)
    if rate <= 0.0:
        what = f"Lackenby: sections cross (1 + d(dx)/dx = {digits(rate)})"
        raise GeometryError(what, "change less", {"rate": rate})
    return np.asarray((1.0 - within_range(x, "Lackenby", 0.0, 1.0)) * dphi / (1.0 - full))


def _check_half(phi: float, parallel: float) -> None:
    if not 0.0 < phi < 1.0:
        raise GeometryError(f"Lackenby: phi {digits(phi)}", "give a coefficient from 0 to 1")
    if not 0.0 <= parallel < 1.0:
        what = f"Lackenby: parallel part {digits(parallel)}"
        raise GeometryError(what, "give one from 0 to below 1")
