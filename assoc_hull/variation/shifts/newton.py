"""From the closed form to the hull itself: Newton's rule on its own hydrostatics.

The curve of areas of a net that is lofted again through moved stations is not the moved curve, by
some 1e-5. So the sizes are corrected until the hydrostatics of the varied hull have the asked
values; the derivatives are those of the closed form, which are as near, so that every step
leaves a part of 1e-3 or less of what is missing.
"""

from __future__ import annotations

from collections.abc import Callable

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray

__all__ = ["MET", "Aim", "Step", "settle"]

MET = 1e-10
"""Relative miss of a volume, miss of a centre in parts of Lpp: what is promised."""

_ENOUGH = 1e-12
"""Nearer than rounding lets one come."""

_MOST = 10


@attrs.frozen(eq=False)
class Step:
    """A step of Newton's rule.

    Attributes
    ----------
    sizes : (float, float), m
        c_f and c_a.
    residual : float
        The largest relative miss of a volume, or miss of a centre in parts of Lpp.
    """

    sizes: tuple[float, float]
    residual: float


@attrs.frozen(eq=False)
class Aim:
    """Two values of a hull that are to be had.

    Attributes
    ----------
    names : (str, str)
    asked : (2,)
    scale : (2,)
        Misses are told in parts of it.
    slopes : callable
        From sizes (2,), m, to the derivatives (2, 2) of both values by c_f and c_a.
    """

    names: tuple[str, str]
    asked: FloatArray
    scale: FloatArray
    slopes: Callable[[FloatArray], FloatArray]


def settle(
    aim: Aim, values: Callable[[FloatArray], FloatArray], sizes: FloatArray
) -> tuple[FloatArray, tuple[Step, ...]]:
    """Find the sizes whose hull has two asked values.

    Parameters
    ----------
    aim : Aim
    values : callable
        From sizes (2,), m, to the values (2,) that the hull then has.
    sizes : (2,), m
        To begin with.

    Returns
    -------
    sizes : (2,), m
    steps : tuple of Step
        The first is the start.

    Raises
    ------
    BadInputError
        The values do not come within 1e-10.
    """
    steps, best, left = list[Step](), sizes, np.inf
    while len(steps) < _MOST and left > _ENOUGH:
        missed = (values(sizes) - aim.asked) / aim.scale
        residual = float(np.abs(missed).max())
        steps.append(Step((float(sizes[0]), float(sizes[1])), residual))
        if residual >= left and left <= MET:
            break
        if residual < left:
            best, left = sizes, residual
        sizes = sizes - np.linalg.solve(aim.slopes(sizes) / aim.scale[:, None], missed)
    if left > MET:
        raise BadInputError(
            f"{' and '.join(aim.names)} come to within {left:.2g} only", "in shift_sections",
            "give a finer or a coarser tolerance, or another shape",
        )  # fmt: skip
    return best, tuple(steps)
