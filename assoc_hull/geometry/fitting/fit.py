"""A smooth surface through points of lines: solve, correct the parameters, and again.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.fitting.breaks import even
>>> from assoc_hull.geometry.fitting.fit import fit_surface
>>> from assoc_hull.geometry.fitting.samples import Samples
>>> uv = np.stack(np.meshgrid(np.linspace(0, 4, 30), np.linspace(0, 2, 30)), axis=-1)
>>> x, y = uv.reshape(-1, 2).T
>>> samples = Samples.of(np.column_stack([x, y]), np.column_stack([x, y, 0.1 * x**2]))
>>> found = fit_surface("trough", samples, even(0, 4, 8), even(0, 2, 4), 1e-9)
>>> bool(found.residual.max() < 1e-6), found.surface.net.shape
(True, (11, 7, 3))
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.arguments import not_negative
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.fitting.basis import DEGREE, clamped
from assoc_hull.geometry.fitting.breaks import checked_breaks
from assoc_hull.geometry.fitting.foot_points import STEPS, foot_points
from assoc_hull.geometry.fitting.held_controls import HeldControls
from assoc_hull.geometry.fitting.samples import Samples
from assoc_hull.geometry.fitting.solving import controls
from assoc_hull.geometry.patches.spline_surface import SplineSurface

__all__ = ["Fit", "fit_surface", "solved"]

ROUNDS = 4
START = 30.0
STIFF = 2


@attrs.frozen(eq=False)
class Fit:
    """A surface, and the points that it was fitted to.

    Attributes
    ----------
    surface : SplineSurface
        A bicubic B-spline.
    samples : Samples
        The points, with parameters of the places of the surface nearest to them.
    residual : (k,), m
        How far they lie from these.
    smoothing : float, m3
        The factor of the penalty.
    """

    surface: SplineSurface
    samples: Samples
    residual: FloatArray
    smoothing: float

    def __attrs_post_init__(self) -> None:
        freeze(self.residual)

    @property
    def spans(self) -> tuple[int, int]:
        """How many spans of knots there are in u and in v."""
        knots = self.surface.knots_u, self.surface.knots_v
        return len(np.unique(knots[0])) - 1, len(np.unique(knots[1])) - 1


def fit_surface(
    name: str,
    samples: Samples,
    breaks_u: FloatArray,
    breaks_v: FloatArray,
    smoothing: float,
    *,
    held: HeldControls | None = None,
    rounds: int = ROUNDS,
    start: float = START,
    stiff: int = STIFF,
) -> Fit:
    """Fit a bicubic B-spline to points of lines.

    Parameters
    ----------
    name : str
        What messages and tables call the surface.
    samples : Samples
        The points, with parameters to start from and weights.
    breaks_u, breaks_v : (b,), m
        Where spans meet, with both ends.
    smoothing : float, m3
        The factor of the penalty: as all parameters are lengths, it is a volume.
    held : HeldControls, optional
        Coordinates of control points that are given.
    rounds : int
        How often to solve and then to correct the parameters, at least once.
    start, stiff : float, int
        In the first `stiff` rounds, but not the last, the penalty is `start` times as large, so
        that bad parameters do not lock in.

    Returns
    -------
    Fit
        The surface and the corrected points; the same bits for the same bits given.

    Raises
    ------
    BadInputError
        Breaks that do not rise, parameters beyond them, a penalty below 0, or points
        that leave control points free.
    """
    where = f"in the fit of {name!r}"
    breaks = (
        checked_breaks(breaks_u, "breaks_u", where),
        checked_breaks(breaks_v, "breaks_v", where),
    )
    _check(samples, breaks, smoothing, where)
    factors = [start] * min(stiff, rounds - 1) + [1.0] * (rounds - min(stiff, rounds - 1))
    found = solved(name, samples, breaks, smoothing * factors[0], held)
    for factor in factors[1:]:
        found = solved(name, found.samples, breaks, smoothing * factor, held)
    return found


def _check(
    samples: Samples, breaks: tuple[FloatArray, FloatArray], smoothing: float, where: str
) -> None:
    """Refuse points that lie beyond the breaks, and a penalty that is none."""
    not_negative(smoothing, "smoothing", where)
    if not len(samples):
        raise BadInputError("there are no points", where, "give points of lines")
    for axis, each in enumerate(breaks):
        at = samples.uv[:, axis]
        bad = at[~((at >= each[0]) & (at <= each[-1]))]
        if len(bad):
            raise BadInputError(
                f"{'uv'[axis]} of a point is {bad[0]:g}",
                where, f"give parameters from {each[0]:g} to {each[-1]:g}",
            )  # fmt: skip


def solved(
    name: str,
    samples: Samples,
    breaks: tuple[FloatArray, FloatArray],
    smoothing: float,
    held: HeldControls | None = None,
    steps: int = STEPS,
) -> Fit:
    """Solve once with the parameters as they are, then correct them.

    Parameters
    ----------
    name, samples, breaks, smoothing, held
        As of `fit_surface`; `breaks` those of both parameters.
    steps : int
        Steps of the correction.
    """
    knots = clamped(breaks[0]), clamped(breaks[1])
    where = f"in the fit of {name!r}"
    net = controls(samples, knots[0], knots[1], smoothing, held, where)
    surface = SplineSurface(name, (DEGREE, DEGREE), knots[0], knots[1], net)
    uv, away = foot_points(surface, samples.point, samples.uv, held=samples.held, steps=steps)
    return Fit(surface, attrs.evolve(samples, uv=uv), away, smoothing)
