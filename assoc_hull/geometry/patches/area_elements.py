"""How much surface lies over a square of parameters: |r_u x r_v| of Bezier patches.

Taken from the control points themselves, not from the polynomial |S|**2, which has lost digits
where |S| is small.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.area_elements import on_grid
>>> from assoc_hull.geometry.patches.patches import Patches
>>> net = np.zeros((2, 2, 3))
>>> net[1, :, 0], net[:, 1, 1] = 2.0, 3.0
>>> on_grid(Patches.single(net), np.array([0.5]), np.array([0.0, 1.0]))
array([[[6., 6.]]])
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.algebra import across, binomials, u_derivative, v_derivative
from assoc_hull.geometry.patches.patches import Patches

__all__ = ["added", "bernstein_values", "on_grid", "on_lines", "swapped", "taken"]


def added(terms: FloatArray) -> FloatArray:
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
    >>> float(added(np.array([1.0, 2.0, 3.0])))
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


def swapped(patches: Patches) -> Patches:
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
    >>> swapped(Patches.single(np.zeros((2, 4, 3)))).degrees
    (3, 1)
    """
    return Patches(patches.net.swapaxes(1, 2), patches.box[:, ::-1], patches.surface)


def taken(patches: Patches, rows: IntArray) -> Patches:
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
    >>> len(taken(Patches.single(np.zeros((2, 4, 3))), np.array([0, 0])))
    2
    """
    return Patches(patches.net[rows], patches.box[rows], patches.surface[rows])


def on_grid(patches: Patches, u: FloatArray, v: FloatArray) -> FloatArray:
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
    >>> on_grid(Patches.single(net), np.array([0.5]), np.array([0.5]))
    array([[[1.]]])
    """
    m, n = patches.degrees
    r = patches.components
    ru = across(bernstein_values(m - 1, u).T, u_derivative(r), bernstein_values(n, v).T)
    rv = across(bernstein_values(m, u).T, v_derivative(r), bernstein_values(n - 1, v).T)
    return _lengths(np.moveaxis(ru, 1, 0), np.moveaxis(rv, 1, 0))


def on_lines(patches: Patches, patch: IntArray, u: FloatArray, v: FloatArray) -> FloatArray:
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
    >>> on_lines(Patches.single(net), row, u, v)
    array([[[1., 1.]]])
    """
    m, n = patches.degrees
    r = patches.components
    ru = _on_lines(u_derivative(r)[patch], bernstein_values(m - 1, u), bernstein_values(n, v))
    rv = _on_lines(v_derivative(r)[patch], bernstein_values(m, u), bernstein_values(n - 1, v))
    return _lengths(ru, rv)


def _on_lines(a: FloatArray, in_u: FloatArray, in_v: FloatArray) -> FloatArray:
    """Give vectors (3, c, p, q) of coefficients (c, 3, m + 1, n + 1) on lines."""
    lines = a @ np.moveaxis(in_v, 0, 1)[:, None]
    found = np.zeros((3, *in_u.shape[1:]))
    for i, values in enumerate(in_u):
        found += np.moveaxis(lines[:, :, i], 1, 0)[..., None] * values
    return found


def _lengths(a: FloatArray, b: FloatArray) -> FloatArray:
    """Give the lengths of vector products; components along the first axis."""
    x = a[1] * b[2] - a[2] * b[1]
    y = a[2] * b[0] - a[0] * b[2]
    z = a[0] * b[1] - a[1] * b[0]
    return np.asarray(np.sqrt(x * x + y * y + z * z))
