"""Outputs of a hull near its parent, to second order: where a search begins, and its slopes.

    y(mu) = y0 + G mu + mu^T H mu / 2        mu = (values - present) / usual changes

G and H come of central differences over a part of the usual changes, on hulls of the study. They
need not be exact: what a variant reaches is measured on itself.
"""

from __future__ import annotations

from itertools import combinations

import attrs
import numpy as np

from assoc_hull.errors import AssocHullError, BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.study.prepared_parent import Ground

__all__ = ["Model"]

_PARTS = (0.25, 0.1, 0.03, 0.01)
"""Parts of usual changes over which differences are taken; the first at which all hulls exist."""


@attrs.frozen(eq=False)
class Model:
    """Outputs as a function of scaled changes of parameters.

    Attributes
    ----------
    value : (m,)
        Outputs of the parent.
    slope : (m, p)
    bend : (m, p, p)
    size : (m,)
        By which what an output lacks is measured: its value for the parent, or 1 if that is nil.
    """

    value: FloatArray
    slope: FloatArray
    bend: FloatArray
    size: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.value, self.slope, self.bend, self.size)

    @classmethod
    def of(cls, ground: Ground) -> Model:
        """Take differences.

        Parameters
        ----------
        ground : Ground
            The parent, with what is aimed at.

        Raises
        ------
        AssocHullError
            A parameter cannot even be changed by a hundredth of a usual change.
        """
        for part in _PARTS:
            try:
                return cls._of(ground, part)
            except AssocHullError:
                if part == _PARTS[-1]:
                    raise
        raise AssertionError

    @classmethod
    def _of(cls, ground: Ground, part: float) -> Model:
        names, count = ground.aims.names, len(ground.usual)

        def at(*moves: tuple[int, float]) -> FloatArray:
            mu = np.zeros(count)
            for i, sign in moves:
                mu[i] += sign * part
            return ground.measured(ground.variant(ground.present + mu * ground.usual))

        middle = at()
        slope, bend = np.zeros((len(names), count)), np.zeros((len(names), count, count))
        up = [at((i, 1.0)) for i in range(count)]
        down = [at((i, -1.0)) for i in range(count)]
        for i in range(count):
            slope[:, i] = (up[i] - down[i]) / (2.0 * part)
            bend[:, i, i] = (up[i] - 2.0 * middle + down[i]) / part**2
        for i, j in combinations(range(count), 2):
            mixed = (at((i, 1.0), (j, 1.0)) - up[i] - up[j] + middle) / part**2
            bend[:, i, j] = bend[:, j, i] = mixed
        if not (np.isfinite(slope).all() and np.isfinite(bend).all()):
            name = names[int(np.argmin(np.isfinite(slope).all(axis=1)))]
            raise BadInputError(f"{name} is not known of this hull", "in study", "leave it out")
        return cls(middle, slope, bend, np.where(middle == 0.0, 1.0, np.abs(middle)))

    def at(self, mu: FloatArray) -> FloatArray:
        """Give outputs, (m,)."""
        found: FloatArray = self.value + self.slope @ mu + 0.5 * (self.bend @ mu) @ mu
        return found

    def jacobian(self, mu: FloatArray) -> FloatArray:
        """Give their derivatives by mu, (m, p)."""
        found: FloatArray = self.slope + self.bend @ mu
        return found
