"""How much surface lies over a square of parameters: |r_u x r_v| of Bezier patches.

Taken from the control points themselves, not from the polynomial |S|**2, which has lost digits
where |S| is small.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.area_elements import elements_on_grid
>>> from assoc_hull.geometry.patches.bezier_patches import Patches
>>> net = np.zeros((2, 2, 3))
>>> net[1, :, 0], net[:, 1, 1] = 2.0, 3.0
>>> elements_on_grid(Patches.single(net), np.array([0.5]), np.array([0.0, 1.0]))
array([[[6., 6.]]])
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.bernstein_polynomials import (
    binomials,
    degrees,
    transform_coefficients,
    u_derivative,
    v_derivative,
)  # fmt: skip
from assoc_hull.geometry.patches.bezier_patches import Patches

__all__ = [
    "bernstein_values",
    "elements_on_grid",
    "elements_on_lines",
    "pairwise_sum",
    "select_rows",
    "swap_parameters",
]


def pairwise_sum(terms: FloatArray) -> FloatArray:
    """Add along the first axis, in an order that depends on nothing but its length.

    Parameters
    ----------
    terms : (p, ...) float
        What to add; overwritten.

    Returns
    -------
    (...) float
        The sums. Those of numpy differ by a bit where there is one column only.

    Examples
    --------
    >>> float(pairwise_sum(np.array([1.0, 2.0, 3.0])))
    6.0
    """
    count = len(terms)
    while count > 1:
        half = (count + 1) // 2
        terms[: count - half] += terms[half:count]
        count = half
    found: FloatArray = terms[0]
    return found


def bernstein_values(degree: int, t: FloatArray) -> FloatArray:
    """Give the Bernstein polynomials of a degree at places.

    Parameters
    ----------
    degree : int
        The degree.
    t : (...) float
        Places, in [0, 1].

    Returns
    -------
    (degree + 1, ...) float
        The values.

    Examples
    --------
    >>> bernstein_values(2, np.array([0.5])).ravel()
    array([0.25, 0.5 , 0.25])
    """
    found = np.empty((degree + 1, *t.shape))
    falling = np.empty_like(found)
    rest = 1.0 - t
    found[0], falling[degree] = 1.0, 1.0
    for i in range(degree):
        np.multiply(found[i], t, out=found[i + 1])
        np.multiply(falling[degree - i], rest, out=falling[degree - i - 1])
    found *= falling
    found *= binomials(degree).reshape(-1, *(1,) * t.ndim)
    return found


def swap_parameters(patches: Patches) -> Patches:
    """Exchange the parameters of patches.

    Parameters
    ----------
    patches : Patches
        The patches.

    Returns
    -------
    Patches
        The same with u and v exchanged.

    Examples
    --------
    >>> swap_parameters(Patches.single(np.zeros((2, 4, 3)))).degrees
    (3, 1)
    """
    weight = None if patches.weight is None else patches.weight.swapaxes(1, 2)
    return Patches(patches.net.swapaxes(1, 2), patches.box[:, ::-1], patches.surface, weight)


def select_rows(patches: Patches, rows: IntArray) -> Patches:
    """Take some patches of a batch.

    Parameters
    ----------
    patches : Patches
        The patches.
    rows : (r,) int
        Which.

    Returns
    -------
    Patches
        These.

    Examples
    --------
    >>> len(select_rows(Patches.single(np.zeros((2, 4, 3))), np.array([0, 0])))
    2
    """
    return patches[rows]


def elements_on_grid(patches: Patches, u: FloatArray, v: FloatArray) -> FloatArray:
    """Give |r_u x r_v| of each patch on the same grid of parameters.

    Parameters
    ----------
    patches : Patches
        The patches, k of them.
    u, v : (p,), (q,)
        Parameters in [0, 1].

    Returns
    -------
    (k, p, q), m2
        The area elements, per unit of u times v of the patch.

    Examples
    --------
    >>> net = np.zeros((2, 2, 3))
    >>> net[1, :, 0] = net[:, 1, 1] = 1.0
    >>> elements_on_grid(Patches.single(net), np.array([0.5]), np.array([0.5]))
    array([[[1.]]])
    """

    def values(a: FloatArray) -> FloatArray:
        in_u, in_v = (
            bernstein_values(degree, t) for degree, t in zip(degrees(a), (u, v), strict=True)
        )
        return np.moveaxis(transform_coefficients(in_u.T, a, in_v.T), 1, 0)

    return _elements(patches, values)


def elements_on_lines(
    patches: Patches, patch: IntArray, u: FloatArray, v: FloatArray
) -> FloatArray:
    """Give |r_u x r_v| on lines v = constant, each with its own places.

    Parameters
    ----------
    patches : Patches
        The patches.
    patch : (c,) int
        Which patch the lines of each row lie on.
    u : (c, p, q)
        The places on each of p lines.
    v : (c, p)
        The lines.

    Returns
    -------
    (c, p, q), m2
        The area elements, per unit of u times v of the patch.

    Examples
    --------
    >>> net = np.zeros((2, 2, 3))
    >>> net[1, :, 0] = net[:, 1, 1] = 1.0
    >>> row, u, v = np.array([0]), np.array([[[0.1, 0.2]]]), np.array([[0.5]])
    >>> elements_on_lines(Patches.single(net), row, u, v)
    array([[[1., 1.]]])
    """

    def values(a: FloatArray) -> FloatArray:
        m, n = degrees(a)
        return _on_lines(a[patch], bernstein_values(m, u), bernstein_values(n, v))

    return _elements(patches, values)


def _elements(patches: Patches, values: Callable[[FloatArray], FloatArray]) -> FloatArray:
    """Give |r_u x r_v| where `values` evaluates polynomials, components first.

    A rational patch is X / w, with X the weighted points, and (X / w)_u = (X_u - w_u X / w) / w.
    """
    r = patches.components
    if patches.weight is None:
        return _lengths(values(u_derivative(r)), values(v_derivative(r)))
    weight = patches.weight[:, None]
    h = np.concatenate([weight * (r - r[..., :1, :1]), weight], axis=1)
    point, *both = (values(each) for each in (h, u_derivative(h), v_derivative(h)))
    place = point[:3] / point[3]
    return _lengths(*((each[:3] - each[3] * place) / point[3] for each in both))


def _on_lines(a: FloatArray, in_u: FloatArray, in_v: FloatArray) -> FloatArray:
    """Give vectors (d, c, p, q) of coefficients (c, d, m + 1, n + 1) on lines."""
    lines = a @ np.moveaxis(in_v, 0, 1)[:, None]
    found = np.zeros((a.shape[1], *in_u.shape[1:]))
    for i, values in enumerate(in_u):
        found += np.moveaxis(lines[:, :, i], 1, 0)[..., None] * values
    return found


def _lengths(a: FloatArray, b: FloatArray) -> FloatArray:
    """Give the lengths of vector products; components along the first axis."""
    x = a[1] * b[2] - a[2] * b[1]
    y = a[2] * b[0] - a[0] * b[2]
    z = a[0] * b[1] - a[1] * b[0]
    return np.asarray(np.sqrt(x * x + y * y + z * z))
