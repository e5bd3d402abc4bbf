"""Curvatures of patches at points: Gaussian, mean, principal ones and their directions.

With E = r_u.r_u, F = r_u.r_v, G = r_v.r_v, W = |S|, S = r_u x r_v and the second form
L = S.r_uu / W, M = S.r_uv / W, N = S.r_vv / W, in the tangent directions e1 = r_u / sqrt(E) and
e2 = S x e1 / W the second form is the symmetric matrix

    a = L / E,    b = (M - F L / E) / W,    c = (E N - 2 F M + F**2 L / E) / W**2

whose eigenvalues are the principal curvatures, H its half trace and K its determinant. Where both
are equal (an umbilic), no direction is principal, and none is given.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.curvatures import curvatures
>>> from assoc_hull.geometry.patches.patches import Patches
>>> net = np.zeros((3, 2, 3))
>>> net[..., 0], net[..., 1] = np.mgrid[-1:2, 0:2]
>>> net[..., 2] = np.array([1.0, -1.0, 1.0])[:, None]
>>> found = curvatures(Patches.single(net), np.array([0]), np.array([[0.5, 0.5]]))
>>> found.gauss, found.principal, found.axes[0].round(12)
(array([0.]), array([[2., 0.]]), array([[1., 0., 0.], [0., 1., 0.]]))
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.patches.patches import Patches
from assoc_hull.geometry.patches.pointwise import Jets, inner, jets

__all__ = ["Curvatures", "curvatures"]

_EPS = 2.0**-53

_POLE = 1e-9
"""Where |S| is below this part of what the control points let expect, there is no curvature."""


@attrs.frozen(eq=False)
class Curvatures:
    """Curvatures of patches at points; nan where the surface has no tangent plane.

    Attributes
    ----------
    position : (p, 3), m
        The points.
    normal : (p, 3)
        Unit vectors along r_u x r_v.
    element : (p,), m2
        The area of the surface for a unit of the parameters of the patch, |r_u x r_v|.
    gauss : (p,), 1/m2
        K, the product of the principal curvatures.
    mean : (p,), 1/m
        H, their mean; positive where the surface bends towards its normal.
    principal : (p, 2), 1/m
        Principal curvatures, the greater one first.
    axes : (p, 2, 3)
        Unit vectors along their directions in space, at right angles; nan at umbilics.
    directions : (p, 2, 2)
        The same directions as (du, dv) in the patch, with unit length in space.
    """

    position: FloatArray
    normal: FloatArray
    element: FloatArray
    gauss: FloatArray
    mean: FloatArray
    principal: FloatArray
    axes: FloatArray
    directions: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.position, self.normal, self.element, self.gauss, self.mean)
        freeze(self.principal, self.axes, self.directions)


def _largest_steps(patches: Patches, row: IntArray) -> tuple[FloatArray, FloatArray]:
    """Give the greatest |r_u| and |r_v| that the control points of each patch let expect."""
    found = []
    for axis, degree in zip((1, 2), patches.degrees, strict=True):
        steps = np.abs(np.diff(patches.net, axis=axis)).max(axis=(1, 2))
        found.append(degree * np.sqrt(inner(steps, steps))[row])
    return found[0], found[1]


def curvatures(patches: Patches, row: IntArray, uv: FloatArray) -> Curvatures:
    """Give the curvatures of patches at points.

    Parameters
    ----------
    patches : Patches
        The patches, polynomial or rational.
    row : (p,) int
        The patch of each point.
    uv : (p, 2)
        Parameters in the patch, 0 to 1.

    Returns
    -------
    Curvatures
        Values; those of a point do not depend on the others, to the last bit.
    """
    jet = jets(patches, row, uv)
    element = jet.element
    along_u, along_v = _largest_steps(patches, row)
    regular = element > _POLE * along_u * along_v
    width = np.where(regular, element, np.nan)
    normal = jet.s / width[:, None]
    form, frame = _second_form(jet, normal, width), _frame(jet, width)
    noise = _noise(patches, row, jet, width)
    middle, half = (form[0] + form[2]) / 2.0, np.hypot((form[0] - form[2]) / 2.0, form[1])
    principal = np.stack([middle + half, middle - half], axis=-1)
    umbilic = half <= noise
    angle = np.where(umbilic, np.nan, 0.5 * np.arctan2(2.0 * form[1], form[0] - form[2]))
    cosine, sine = np.cos(angle), np.sin(angle)
    turned = np.stack([np.stack([cosine, sine], -1), np.stack([-sine, cosine], -1)], axis=1)
    directions = turned[..., :1] * frame[:, None, 0] + turned[..., 1:] * frame[:, None, 1]
    axes = directions[..., :1] * jet.ru[:, None] + directions[..., 1:] * jet.rv[:, None]
    gauss = form[0] * form[2] - form[1] ** 2
    return Curvatures(jet.r, normal, element, gauss, middle, principal, axes, directions)


def _second_form(
    jet: Jets, normal: FloatArray, width: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give the second form in two tangent directions of unit length at right angles, 1/m."""
    e, f = inner(jet.ru, jet.ru), inner(jet.ru, jet.rv)
    l, m, n = (inner(normal, each) for each in (jet.ruu, jet.ruv, jet.rvv))
    e = np.where(np.isnan(width), np.nan, e)
    slope = f / e
    last = e * (n - 2.0 * slope * m + slope**2 * l) / width**2
    return l / e, (m - slope * l) / width, last


def _frame(jet: Jets, width: FloatArray) -> FloatArray:
    """Give these two directions as (du, dv), (p, 2, 2)."""
    root = np.where(np.isnan(width), np.nan, np.sqrt(inner(jet.ru, jet.ru)))
    first = np.stack([1.0 / root, 0.0 * root], axis=-1)
    second = np.stack([-inner(jet.ru, jet.rv) / (root * width), root / width], axis=-1)
    return np.stack([first, second], axis=1)


def _noise(patches: Patches, row: IntArray, jet: Jets, width: FloatArray) -> FloatArray:
    """Bound the curvature that rounding of control points makes, 1/m: less is no difference."""
    m, n = patches.degrees
    size = np.abs(patches.net).max(axis=(1, 2, 3))[row]
    off = 16.0 * _EPS * size * (m * np.sqrt(inner(jet.rv, jet.rv))) ** 2
    off += 16.0 * _EPS * size * (n * np.sqrt(inner(jet.ru, jet.ru))) ** 2
    return np.asarray(off / width**2)
