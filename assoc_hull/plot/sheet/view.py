"""From metres on the hull to millimetres on paper, and the scales a drawing may have."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray

__all__ = ["View", "scale_of"]

_STEPS = (1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0, 7.5)
"""Drawing offices take one of these, times a power of ten, as the scale's denominator."""


def scale_of(metres: float, millimetres: float) -> float:
    """Give the smallest usual denominator at which a length fits on paper.

    Examples
    --------
    >>> from assoc_hull.plot.sheet.view import scale_of
    >>> scale_of(121.92, 360.0), scale_of(10.0, 150.0)
    (350.0, 75.0)
    """
    least = max(metres, 1e-9) * 1e3 / millimetres
    power = 10.0 ** np.floor(np.log10(least))
    steps = [step * power for step in (*_STEPS, 10.0) if step * power >= least * (1.0 - 1e-12)]
    return float(f"{steps[0]:.6g}")


@attrs.frozen
class View:
    """A view of the hull at one place of the sheet.

    Attributes
    ----------
    name : str
        Begins the names of everything drawn in it.
    axes : (int, int)
        Coordinates that run to the right and upward.
    denominator : float
        The scale is 1 to this.
    origin : (float, float), mm
        Where the coordinates are nil.
    sign : float
        -1 mirrors the view right to left.
    """

    name: str
    axes: tuple[int, int]
    denominator: float
    origin: tuple[float, float]
    sign: float = 1.0

    @property
    def unit(self) -> float:
        """Millimetres on paper for one metre."""
        return 1e3 / self.denominator

    def across(self, value: float) -> float:
        """Give the place (mm) of a coordinate that runs to the right."""
        return self.origin[0] + self.sign * self.unit * value

    def up(self, value: float) -> float:
        """Give the place (mm) of a coordinate that runs upward."""
        return self.origin[1] + self.unit * value

    def on_paper(self, xyz: FloatArray) -> FloatArray:
        """Project points (k, 3), m, onto the sheet, (k, 2), mm."""
        plane = xyz[:, list(self.axes)]
        return np.asarray(self.origin) + self.unit * plane * (self.sign, 1.0)

    def mirrored(self) -> View:
        """Give the same view, right and left exchanged."""
        return attrs.evolve(self, sign=-self.sign)
