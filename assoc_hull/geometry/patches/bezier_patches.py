"""Bezier patches of one bidegree: points, normals, derivatives and curvatures at their parameters.

`Patches` is a batch of control nets, polynomial or rational, with the place of each on its surface.
Every value is computed for itself, so its bits do not depend on the other points asked for.
At umbilics no principal direction is given, at poles no curvature: there the values are nan.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Self

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.numeric.tensor_bernstein import bernstein_basis

__all__ = [
    "Curvatures",
    "Jets",
    "Patches",
    "area_stretch",
    "curvatures",
    "inner",
    "jets",
    "patch_normals",
    "patch_points",
]


@attrs.frozen(eq=False)
class Patches:
    """Bezier patches of one bidegree (m, n), all polynomial or all rational.

    Attributes
    ----------
    net : (k, m + 1, n + 1, 3), m
        Control points; the first axis after the patch is u.
    box : (k, 2, 2)
        The parameters of the surface that the unit square of each patch covers:
        ``[[u0, u1], [v0, v1]]``.
    surface : (k,) int
        Which surface each belongs to.
    weight : (k, m + 1, n + 1) or None
        Weights of the control points, above 0; None for polynomial patches.
    """

    net: FloatArray
    box: FloatArray
    surface: IntArray
    weight: FloatArray | None = None

    def __attrs_post_init__(self) -> None:
        freeze(self.net, self.box, self.surface)
        if self.weight is not None:
            freeze(self.weight)

    @classmethod
    def single(cls, net: FloatArray, weight: FloatArray | None = None) -> Self:
        """Give one patch, on the unit square, of a net (m + 1, n + 1, 3)."""
        return cls(
            np.array(net, np.float64)[None],
            np.array([[[0.0, 1.0]] * 2]),
            np.zeros(1, np.intp),
            None if weight is None else np.array(weight, np.float64)[None],
        )

    @classmethod
    def joined(cls, batches: Sequence[Patches]) -> Self:
        """Put batches of one bidegree behind each other: all polynomial, or all rational."""
        weights = [each.weight for each in batches if each.weight is not None]
        return cls(
            np.concatenate([each.net for each in batches]),
            np.concatenate([each.box for each in batches]),
            np.concatenate([each.surface for each in batches]),
            np.concatenate(weights) if weights else None,
        )

    @property
    def degrees(self) -> tuple[int, int]:
        """The degrees in u and v."""
        return self.net.shape[1] - 1, self.net.shape[2] - 1

    def __len__(self) -> int:
        """Count the patches."""
        return len(self.net)

    def __getitem__(self, rows: IntArray | slice) -> Self:
        """Take some patches, by their numbers, by a mask or a slice."""
        weight = None if self.weight is None else self.weight[rows]
        return type(self)(self.net[rows], self.box[rows], self.surface[rows], weight)

    @property
    def components(self) -> FloatArray:
        """The control points as coefficients of vectors, (k, 3, m + 1, n + 1), m."""
        return np.moveaxis(self.net, -1, 1)

    def parameters(self, row: IntArray, uv: FloatArray) -> FloatArray:
        """Turn parameters of patches, 0 to 1, into those of their surfaces.

        Parameters
        ----------
        row : (p,) int
            The patch of each.
        uv : (p, 2)
            Parameters in it.

        Returns
        -------
        (p, 2)
            Parameters of the surface; 0 and 1 give those of the border, to the last bit.

        Examples
        --------
        >>> import numpy as np
        >>> from assoc_hull.geometry.patches.bezier_patches import Patches
        >>> Patches.single(np.zeros((2, 2, 3))).parameters(np.array([0]), np.array([[0.25, 1.0]]))
        array([[0.25, 1.  ]])
        """
        box = self.box[row]
        return np.asarray((1.0 - uv) * box[..., 0] + uv * box[..., 1])


def patch_points(patches: Patches, patch: IntArray, uv: FloatArray) -> FloatArray:
    """Give the points (n, 3), m, at parameters (n, 2) of some patches (n,)."""
    value = _value(_homogeneous(patches, patch), uv)
    return np.asarray(value[:, :3] / value[:, 3:])


def patch_normals(patches: Patches, patch: IntArray, uv: FloatArray) -> FloatArray:
    """Give the vectors ``r_u x r_v`` (n, 3), m2, at parameters (n, 2) of some patches."""
    net = _homogeneous(patches, patch)
    value = _value(net, uv)
    point, weight = value[:, :3] / value[:, 3:], value[:, 3:]
    slopes = []
    for axis, degree in zip((1, 2), patches.degrees, strict=True):
        slope = _value(degree * np.diff(net, axis=axis), uv) if degree else 0.0 * value
        slopes.append((slope[:, :3] - point * slope[:, 3:]) / weight)
    return np.cross(slopes[0], slopes[1])


def area_stretch(patches: Patches, patch: IntArray, uv: FloatArray) -> FloatArray:
    """Give the area per area of parameters, ``|r_u x r_v|``, m2, at parameters of some patches."""
    return np.asarray(np.sqrt((patch_normals(patches, patch, uv) ** 2).sum(axis=-1)))


def _homogeneous(patches: Patches, patch: IntArray) -> FloatArray:
    """Give the nets of some patches times their weights, with the weights: (n, m + 1, n + 1, 4)."""
    net = patches.net[patch]
    weight = np.ones(net.shape[:-1]) if patches.weight is None else patches.weight[patch]
    return np.concatenate([net * weight[..., None], weight[..., None]], axis=-1)


def _value(net: FloatArray, uv: FloatArray) -> FloatArray:
    """Evaluate nets (n, m + 1, n + 1, 4), each at its own parameters (n, 2)."""
    u, v = bernstein_basis(net.shape[1] - 1, uv[:, 0]), bernstein_basis(net.shape[2] - 1, uv[:, 1])
    found = np.zeros((len(net), net.shape[-1]))
    for i in range(net.shape[1]):
        row = np.zeros_like(found)
        for j in range(net.shape[2]):
            row += v[:, j, None] * net[:, i, j]
        found += u[:, i, None] * row
    return found


def inner(a: FloatArray, b: FloatArray) -> FloatArray:
    """Give scalar products of vectors (p, 3), (p,), each added in the same order."""
    return np.asarray(a[:, 0] * b[:, 0] + a[:, 1] * b[:, 1] + a[:, 2] * b[:, 2])


@attrs.frozen(eq=False)
class Jets:
    """Points of patches and derivatives there.

    Attributes
    ----------
    r : (p, 3), m
        Points.
    ru, rv : (p, 3), m
        First derivatives with respect to the parameters of the patch, 0 to 1.
    ruu, ruv, rvv : (p, 3), m
        Second derivatives.
    """

    r: FloatArray
    ru: FloatArray
    rv: FloatArray
    ruu: FloatArray
    ruv: FloatArray
    rvv: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.r, self.ru, self.rv, self.ruu, self.ruv, self.rvv)

    @property
    def s(self) -> FloatArray:
        """The normal S = r_u x r_v, not of unit length, (p, 3), m2."""
        return np.cross(self.ru, self.rv)

    @property
    def element(self) -> FloatArray:
        """The area of the surface for a unit of parameters, |S|, (p,), m2."""
        return np.asarray(np.sqrt(inner(self.s, self.s)))


def _along(a: FloatArray, t: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give values and two derivatives of Bezier polygons (p, d + 1, ...) at parameters (p,)."""
    degree = a.shape[1] - 1
    t = t.reshape(-1, 1, *(1,) * (a.ndim - 2))
    while a.shape[1] > 3:
        a = (1.0 - t) * a[:, :-1] + t * a[:, 1:]
    second = np.zeros_like(a[:, 0])
    if degree > 1:
        second = degree * (degree - 1) * ((a[:, 2] - a[:, 1]) - (a[:, 1] - a[:, 0]))
        a = (1.0 - t) * a[:, :-1] + t * a[:, 1:]
    first = degree * (a[:, 1] - a[:, 0])
    return (1.0 - t[:, 0]) * a[:, 0] + t[:, 0] * a[:, 1], first, second


def jets(patches: Patches, row: IntArray, uv: FloatArray) -> Jets:
    """Give points of patches and derivatives there, by de Casteljau's rule.

    Points are taken from a corner of the patch, so that it costs no digits to be 100 m away from
    the origin.

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
    Jets
        Points and derivatives; those of a point do not depend on the others, to the last bit.
    """
    local = patches.net[row]
    corner = local[:, 0, 0]
    local = local - corner[:, None, None]
    if patches.weight is not None:
        weight = patches.weight[row][..., None]
        local = np.concatenate([local * weight, weight], axis=-1)
    u, v = uv[:, 0], uv[:, 1]
    in_u = np.stack(_along(local, u), axis=2)
    (r, ru, ruu), (rv, ruv, _), (rvv, _, _) = (np.moveaxis(each, 1, 0) for each in _along(in_u, v))
    if patches.weight is not None:
        r, ru, rv, ruu, ruv, rvv = _quotients(r, ru, rv, ruu, ruv, rvv)
    return Jets(r + corner, ru, rv, ruu, ruv, rvv)


def _quotients(*homogeneous: FloatArray) -> tuple[FloatArray, ...]:
    """Divide weighted points by their weights, with derivatives: each (p, 4) gives (p, 3)."""
    (r, ru, rv, ruu, ruv, rvv), (w, wu, wv, wuu, wuv, wvv) = (
        [each[:, part] for each in homogeneous] for part in (slice(3), slice(3, 4))
    )
    r = r / w
    ru, rv = (ru - wu * r) / w, (rv - wv * r) / w
    ruu = (ruu - 2.0 * wu * ru - wuu * r) / w
    ruv = (ruv - wu * rv - wv * ru - wuv * r) / w
    rvv = (rvv - 2.0 * wv * rv - wvv * r) / w
    return r, ru, rv, ruu, ruv, rvv


# --------------------------------------------------------------------------------------
# Curvatures: Gaussian, mean, principal ones and their directions.

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
    """Give the second form in two tangent directions of unit length at right angles, 1/m.

    With E = r_u.r_u, F = r_u.r_v, G = r_v.r_v, W = |S|, S = r_u x r_v and the second form
    L = S.r_uu / W, M = S.r_uv / W, N = S.r_vv / W, it is in the directions e1 = r_u / sqrt(E) and
    e2 = S x e1 / W the symmetric matrix

        a = L / E,    b = (M - F L / E) / W,    c = (E N - 2 F M + F**2 L / E) / W**2

    whose eigenvalues are the principal curvatures, H its half trace and K its determinant.
    """
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
