"""The formulas of Lackenby as he published them: exact in area, first order in the centre.

H. Lackenby, "On the systematic geometrical variation of ship forms", Trans. INA 92, 1950. In half
lengths from midship, outward: phi is the prismatic coefficient of a half body, xb its centroid,
k its radius of gyration about midship, p the part of it that is parallel.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.shifts.shifted_areas import VolumeElements

__all__ = ["HalfBody", "half_bodies", "lackenby_changes"]


@attrs.frozen
class HalfBody:
    """A half body in half lengths from midship, outward.

    Attributes
    ----------
    phi : float
        Prismatic coefficient, on the largest section.
    centroid, square : float
        xb, and k^2.
    parallel : float
        p: the sections up to it are the largest one.

    Examples
    --------
    A parabola 1 - x^2:

    >>> from assoc_hull.variation.shifts.lackenby import HalfBody
    >>> half = HalfBody(2 / 3, 3 / 8, 1 / 5, 0.0)
    >>> round(half.one_minus_cp(0.5, 0.02), 9), round(half.lackenby(0.5, 0.02), 9)
    (0.03, 0.03)
    """

    phi: float
    centroid: float
    square: float
    parallel: float

    def one_minus_cp(self, x: float | FloatArray, change: float) -> float | FloatArray:
        """Give delta at x that changes phi by pushing the half body with its parallel part."""
        return change * (1.0 - x) / (1.0 - self.phi)

    def lackenby(
        self, x: float | FloatArray, change: float, parallel: float = 0.0
    ) -> float | FloatArray:
        """Give delta at x that changes phi, and p by `parallel`; x not below p."""
        p, phi = self.parallel, self.phi
        first = parallel / (1.0 - p)
        rest = change - parallel * (1.0 - phi) / (1.0 - p)
        return (1.0 - x) * (first + (x - p) / self.area * rest)

    @property
    def area(self) -> float:
        """A = phi (1 - 2 xb) - p (1 - phi)."""
        return self.phi * (1.0 - 2.0 * self.centroid) - self.parallel * (1.0 - self.phi)

    @property
    def lever(self) -> float:
        """B: the lever of the area that Lackenby's shift adds."""
        inner = 2.0 * self.centroid - 3.0 * self.square
        return self.phi * (inner - self.parallel * (1.0 - 2.0 * self.centroid)) / self.area


def half_bodies(
    elements: VolumeElements, length: float, ends: tuple[float, float]
) -> list[HalfBody]:
    """Give fore and after body of a curve of areas between the perpendiculars.

    Parameters
    ----------
    elements : VolumeElements
        Of the curve; the section amidships is the largest.
    length : float, m
    ends : (float, float)
        p of fore and after body, in half lengths.
    """
    half, found = 0.5 * length, list[HalfBody]()
    for sign, parallel in zip((1.0, -1.0), ends, strict=True):
        x = sign * (elements.x - elements.middle) / half
        part = np.where(x > 0.0, elements.volume, 0.0)
        total = float(part.sum())
        found.append(
            HalfBody(
                total / (elements.area * half), float((part * x).sum()) / total,
                float((part * x * x).sum()) / total, parallel,
            )
        )  # fmt: skip
    return found


def lackenby_changes(fore: HalfBody, aft: HalfBody, phi: float, z: float) -> tuple[float, float]:
    """Give the changes of phi of both bodies for those of the whole hull, the parallel body held.

    Parameters
    ----------
    fore, aft : HalfBody
    phi : float
        By how much the prismatic coefficient of the hull is to change.
    z : float
        By how much its centre is to move, + forward, half lengths.

    Returns
    -------
    (float, float)
        Of the fore and the after body.
    """
    whole = 0.5 * (fore.phi + aft.phi)
    centre = 0.5 * (fore.phi * fore.centroid - aft.phi * aft.centroid) / whole
    moved, levers = z * (whole + phi), fore.lever + aft.lever
    return (
        2.0 * (phi * (aft.lever + centre) + moved) / levers,
        2.0 * (phi * (fore.lever - centre) - moved) / levers,
    )
