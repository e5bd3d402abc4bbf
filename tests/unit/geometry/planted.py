"""Plane curves with planted features, drawn from their curvature, with noise."""

from collections.abc import Callable

import numpy as np

from assoc_hull.geometry.curves import FloatArray

NOISE = 1e-3
"""Standard deviation across the curve, m."""


class Planted:
    """A curve by arc length: curvature and corners."""

    def __init__(
        self,
        length: float,
        curvature: Callable[[FloatArray], FloatArray],
        corners: tuple[tuple[float, float], ...] = (),
    ) -> None:
        """Take corners as (place in m, turn in degrees)."""
        self.s = np.linspace(0.0, length, int(2000 * length) + 1)
        bend = curvature(self.s)
        step = self.s[1]
        self.angle = 0.3 + np.append(0.0, np.cumsum(0.5 * (bend[1:] + bend[:-1]) * step))
        for place, turn_deg in corners:
            self.angle += np.where(self.s > place, np.deg2rad(turn_deg), 0.0)
        middle = 0.5 * (self.angle[1:] + self.angle[:-1])
        ahead = np.column_stack([np.cos(middle), np.sin(middle)])
        self.xy = np.concatenate([np.zeros((1, 2)), np.cumsum(ahead * step, axis=0)])

    def at(self, s: FloatArray | float) -> FloatArray:
        """Places at arc lengths."""
        return np.stack([np.interp(s, self.s, column) for column in self.xy.T], axis=-1)

    def digitised(self, seed: int, spacing: float = 0.1) -> FloatArray:
        """Points about `spacing` apart, scattered across the curve."""
        draw = np.random.default_rng(seed)
        count = round(self.s[-1] / spacing)
        s = (np.arange(count) + draw.uniform(-0.2, 0.2, count) + 0.3) * spacing
        angle = np.interp(s, self.s, self.angle)
        across = np.column_stack([-np.sin(angle), np.cos(angle)])
        return np.asarray(self.at(s) + across * draw.normal(0.0, NOISE, (count, 1)))
