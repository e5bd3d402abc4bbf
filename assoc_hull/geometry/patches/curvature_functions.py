"""Polynomials that have the sign of Gaussian or mean curvature less a level, with error bounds.

With A, B and S of `curvature_terms`, K = A / |S|**4 and H = B / (2 |S|**3) on polynomial patches,
so the sign of

    K                is that of  A                                (6m - 4, 6n - 4)
    K - K0           is that of  A - K0 |S|**4                    (8m - 4, 8n - 4)
    H                is that of  B                                (5m - 3, 5n - 3)
    |H| - |H0|       is that of  B**2 - 4 H0**2 |S|**6            (10m - 6 and 12m - 6 in u)
    k1 - k2 (>= 0)   is that of  B**2 - 4 A |S|**2                (10m - 6, 10n - 6)

for patches of degrees (m, n), which stand at the right. The true degrees of A are one less each
way; reducing them saves no work. On rational patches, with A*, S* and w of `rational_terms`, K has
the sign of A*, (8m - 4, 8n - 4), and K - K0 that of A* w**4 - K0 |S*|**4, (12m - 4, 12n - 4).

Beside the coefficients stand bounds of what each may be off by: rounding, with the control points
taken as exact, and their uncertainty `delta`.

Source: the idea of iso-curves of curvature on the patches of a plate is that of "Curvature Region
Analysis for Application of Plates Forming", J. SNAK; degrees and bounds are our own.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.curvature_functions import gauss_function
>>> from assoc_hull.geometry.patches.patches import Patches
>>> net = np.zeros((4, 4, 3))
>>> net[..., 0], net[..., 1] = np.mgrid[0:4, 0:4] / 3.0
>>> found = gauss_function(Patches.single(net), 0.0)
>>> found.b.shape, bool((found.b == 0.0).all())
((1, 15, 15), True)
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.patches.bounded_terms import Bounded, BoundedTerms, less, margin
from assoc_hull.geometry.patches.curvature_terms import Delta
from assoc_hull.geometry.patches.patches import Patches
from assoc_hull.geometry.patches.rational_terms import RationalTerms
from assoc_hull.geometry.patches.running_bounds import Running

__all__ = [
    "IsoFunction", "gauss_function", "gauss_functions", "mean_function", "umbilic_function",
]  # fmt: skip

Pair = tuple[FloatArray, FloatArray]
"""Coefficients, and what each may be off by."""

_CHUNK = 64
"""So many patches at once keep all coefficients in the cache of a processor."""


@attrs.frozen(eq=False)
class IsoFunction:
    """Polynomials, one a patch, whose zero sets are wanted.

    Attributes
    ----------
    b : (k, M + 1, N + 1)
        Bernstein coefficients; positive where the curvature lies above the level.
    err : (k, M + 1, N + 1)
        What each coefficient may be off by: rounding, and the uncertainty of the control points.
    """

    b: FloatArray
    err: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.b, self.err)


def _chunks(
    patches: Patches,
    delta: Delta,
    rule: Callable[[Patches, FloatArray], list[Pair]],
) -> tuple[IsoFunction, ...]:
    """Run a rule on so many patches at once as fit the cache, and put the results together."""
    each = np.broadcast_to(np.asarray(delta, np.float64), len(patches))
    parts = [slice(low, low + _CHUNK) for low in range(0, len(patches), _CHUNK)] or [slice(0)]
    found = [rule(patches[part], each[part]) for part in parts]
    return tuple(
        IsoFunction(*(np.concatenate([pair[i] for pair in column]) for i in (0, 1)))
        for column in zip(*found, strict=True)
    )


def _gauss_terms(
    patches: Patches, delta: FloatArray, banded: bool
) -> tuple[Pair, tuple[Bounded | Running, Bounded | Running] | None]:
    """Give A; where a level is asked for, A and |S|**4 too, whose quotient is K."""
    if patches.weight is None:
        terms = BoundedTerms(patches, delta)
        a = terms.gauss()
        return (a.b, a.err), (a, terms.quartic(terms.area())) if banded else None
    rational = RationalTerms.of(patches, delta)
    found = rational.gauss()
    both = (rational.weighted(found), rational.quartic(rational.area())) if banded else None
    return (found.b, found.err), both


def gauss_functions(
    patches: Patches, levels: Sequence[float], delta: Delta = 0.0
) -> tuple[IsoFunction, ...]:
    """Give polynomials that are positive where the Gaussian curvature exceeds levels.

    Parameters
    ----------
    patches : Patches
        The patches.
    levels : sequence of float, 1/m2
        The curvatures K0. A and |S|**4 are found once for all of them.
    delta : float or (k,), m
        Each coordinate of a control point may be wrong by so much: one for all or each patch.

    Returns
    -------
    tuple of IsoFunction
        One a level: A, of degrees (6m - 4, 6n - 4), for 0; else A - K0 |S|**4, of degrees
        (8m - 4, 8n - 4); for rational patches (8m - 4, 8n - 4) and (12m - 4, 12n - 4). What is
        found for a patch does not depend on the others, to the last bit.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.patches.curvature_functions import gauss_functions
    >>> from assoc_hull.geometry.patches.patches import Patches
    >>> net = np.zeros((2, 2, 3))
    >>> net[1, :, 0] = net[:, 1, 1] = net[1, 1, 2] = 1.0
    >>> zero, below = gauss_functions(Patches.single(net), (0.0, -2.0))
    >>> zero.b.max().item(), below.b[0, 0, 0].item()
    (-1.0, 1.0)
    """

    def rule(part: Patches, off: FloatArray) -> list[Pair]:
        a, both = _gauss_terms(part, off, any(levels))
        return [less(both[0], level, both[1]) if both and level else a for level in levels]

    return _chunks(patches, delta, rule)


def gauss_function(patches: Patches, level: float, delta: Delta = 0.0) -> IsoFunction:
    """Give the polynomial that is positive where the Gaussian curvature exceeds a level.

    Parameters
    ----------
    patches : Patches
        The patches.
    level : float, 1/m2
        The curvature K0.
    delta : float or (k,), m
        Each coordinate of a control point may be wrong by so much.

    Returns
    -------
    IsoFunction
        As `gauss_functions` gives for one level.
    """
    return gauss_functions(patches, (level,), delta)[0]


def _require_polynomial(patches: Patches) -> None:
    if patches.weight is not None:
        raise BadInputError(
            "patches have weights", "in mean curvature",
            "take polynomial patches, or values at points by `curvatures`",
        )  # fmt: skip


def mean_function(patches: Patches, level: float = 0.0, delta: Delta = 0.0) -> IsoFunction:
    """Give a polynomial with the zero set of the mean curvature less a level.

    Parameters
    ----------
    patches : Patches
        The patches.
    level : float, 1/m
        The curvature H0, in the sense of r_u x r_v.
    delta : float or (k,), m
        Each coordinate of a control point may be wrong by so much.

    Returns
    -------
    IsoFunction
        For 0 it is B, positive where H is. Else it is B**2 - 4 H0**2 |S|**6, positive where
        |H| > |H0|: of its zero set only the branch where B has the sign of H0 is wanted, the
        other one is H = -H0.

    Raises
    ------
    BadInputError
        Rational patches.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.patches.curvature_functions import mean_function
    >>> from assoc_hull.geometry.patches.patches import Patches
    >>> net = np.zeros((4, 4, 3))
    >>> net[..., 0], net[..., 1] = np.mgrid[0:4, 0:4] / 3.0
    >>> mean_function(Patches.single(net)).b.shape
    (1, 13, 13)
    """
    _require_polynomial(patches)

    def rule(part: Patches, off: FloatArray) -> list[Pair]:
        terms = BoundedTerms(part, off)
        b = terms.mean()
        if level == 0.0:
            return [(b.b, b.err)]
        area, steps = terms.area(), terms.steps
        square = b.times(b, margin(steps["mean"].times(steps["mean"]), 500.0))
        four = steps["area"].times(steps["area"])
        sextic = terms.quartic(area).times(area, margin(four.times(steps["area"]), 600.0))
        return [less(square, 4.0 * level**2, sextic)]

    return _chunks(patches, delta, rule)[0]


def umbilic_function(patches: Patches, delta: Delta = 0.0) -> IsoFunction:
    """Give B**2 - 4 A |S|**2, which is nil where both principal curvatures are equal.

    Parameters
    ----------
    patches : Patches
        The patches.
    delta : float or (k,), m
        Each coordinate of a control point may be wrong by so much.

    Returns
    -------
    IsoFunction
        Of degrees (10m - 6, 10n - 6); 4 (H**2 - K) |S|**6, so never below nil but by `err`.

    Raises
    ------
    BadInputError
        Rational patches.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.patches.curvature_functions import umbilic_function
    >>> from assoc_hull.geometry.patches.patches import Patches
    >>> net = np.zeros((4, 4, 3))
    >>> net[..., 0], net[..., 1] = np.mgrid[0:4, 0:4] / 3.0
    >>> umbilic_function(Patches.single(net)).b.shape
    (1, 25, 25)
    """
    _require_polynomial(patches)

    def rule(part: Patches, off: FloatArray) -> list[Pair]:
        terms = BoundedTerms(part, off)
        b, steps = terms.mean(), terms.steps
        square = b.times(b, margin(steps["mean"].times(steps["mean"]), 500.0))
        both = steps["gauss"].times(steps["area"])
        product = terms.gauss().times(terms.area(), margin(both, 500.0))
        return [less(square, 4.0, product)]

    return _chunks(patches, delta, rule)[0]
