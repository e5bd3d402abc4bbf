"""Surfaces as tensor products of B-splines: checks, points, Bezier patches and parts.

`SplineSurface` is what users hand in, what files hold and what a fit gives.
Its input is checked before it is made: net, degrees, knots, weights.
Parameters run over the domain of the knots; `patches` gives the same surface as Bezier patches.
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np

from assoc_hull.arguments import integer, shown, word
from assoc_hull.errors import BadInputError, WrongTypeError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.patches.bezier_patches import Patches
from assoc_hull.geometry.patches.knots import (
    bezier_pieces,
    blossom,
    checked_knots,
    cut_spline,
    knot_domain,
    span_at,
    span_limits,
)

__all__ = [
    "HIGHEST_DEGREE",
    "SplineSurface",
    "checked_degrees",
    "checked_name",
    "checked_net",
    "checked_parameters",
    "checked_part",
    "checked_surface_knots",
    "checked_weights",
]


HIGHEST_DEGREE = 7
"""The highest degree of a surface: |S|**4 is of degree 8 m - 4 then, and the binomials of 52 are
the last that floating-point numbers hold exactly. Surfaces of ships are of degree 3, rarely 5."""

_FARTHEST = 1e6
"""Coordinates of control points lie within this, m."""

_WIDEST = 1e4
"""Weights differ by this factor at most: bounds of errors grow with a power of it."""

_SAME = 1e-12
"""Parameters nearer to an end of the domain than this part of its size are that end."""

Limits = tuple[float, float]


def checked_name(value: object) -> str:
    """Take the name of a surface: text of one line, which may be empty."""
    found = word(value, "name", "in a surface")
    if not found.isprintable():
        raise BadInputError(
            f"name is {shown(value)}", "in a surface", "give printable text in one line"
        )
    return found


def _array(value: object, name: str, where: str, remedy: str) -> FloatArray:
    """Give numbers as an array of their own, or say that they are none."""
    try:
        given = np.asarray(value)
        if given.dtype.kind not in "iuf":
            raise TypeError(given.dtype)
        # + 0.0 makes 0.0 of -0.0: equal nets have equal bits.
        return np.array(given, np.float64) + 0.0
    except (TypeError, ValueError, OverflowError):
        raise WrongTypeError(f"{name} is {shown(value)}", where, remedy) from None


def checked_net(value: object, where: str) -> FloatArray:
    """Take a control net (nu, nv, 3), m, of at least two points each way.

    Raises
    ------
    BadInputError
        Another shape, or a number that is not finite or above 1e6 m.
    """
    remedy = "give an array (nu, nv, 3), m, with at least two points each way"
    net = _array(value, "net", where, remedy)
    if net.ndim != 3 or net.shape[2] != 3 or min(net.shape) < 2:
        raise BadInputError(f"net is of shape {net.shape}", where, remedy)
    bad = np.argwhere(~(np.abs(net) <= _FARTHEST))
    if len(bad):
        i, j, axis = (int(each) for each in bad[0])
        raise BadInputError(
            f"{'xyz'[axis]} of the control point {i}, {j} is {net[i, j, axis]:g}",
            where, f"give finite numbers up to {_FARTHEST:g} m",
        )  # fmt: skip
    return net


def checked_degrees(value: object, net: FloatArray, where: str) -> tuple[int, int]:
    """Take the degrees in u and v of a net (nu, nv, 3).

    Raises
    ------
    BadInputError
        No pair of whole numbers from 1 to 7, or fewer points than a degree needs.
    """
    if not isinstance(value, tuple | list) or len(value) != 2:
        raise WrongTypeError(f"degrees is {shown(value)}", where, "give a pair of whole numbers")
    most = HIGHEST_DEGREE
    m, n = (integer(each, "a degree", where, least=1, most=most) for each in value)
    for degree, count, axis in zip((m, n), net.shape, "uv", strict=False):
        if count <= degree:
            raise BadInputError(
                f"net has {count} control points in {axis} for degree {degree}",
                where, f"give at least {degree + 1}",
            )  # fmt: skip
    return m, n


def checked_surface_knots(
    values: tuple[object, object], degrees: tuple[int, int], net: FloatArray, where: str
) -> tuple[FloatArray, FloatArray]:
    """Take the knots in u and v of a net (nu, nv, 3); raises as `checked_knots`."""
    (m, n), (nu, nv) = degrees, net.shape[:2]
    return (
        checked_knots(values[0], m, nu, "knots_u", where),
        checked_knots(values[1], n, nv, "knots_v", where),
    )


def checked_weights(value: object, net: FloatArray, where: str) -> FloatArray | None:
    """Take weights (nu, nv) of a net (nu, nv, 3); None if there are none, or all are equal.

    Raises
    ------
    BadInputError
        Another shape, a weight that is not above 0, or weights of very different size.
    """
    if value is None:
        return None
    remedy = f"give a number above 0 for each control point, an array {net.shape[:2]}"
    weights = _array(value, "weights", where, remedy)
    if weights.shape != net.shape[:2]:
        raise BadInputError(f"weights is of shape {weights.shape}", where, remedy)
    bad = np.argwhere(~((weights > 0.0) & (weights < np.inf)))
    if len(bad):
        i, j = (int(each) for each in bad[0])
        raise BadInputError(
            f"the weight of the control point {i}, {j} is {weights[i, j]:g}", where, remedy
        )
    least, most = float(weights.min()), float(weights.max())
    if most > _WIDEST * least:
        raise BadInputError(
            f"weights lie between {least:g} and {most:g}",
            where, f"the greatest may be {_WIDEST:g} times the least",
        )  # fmt: skip
    return None if least == most else weights


def _inside(t: FloatArray, limits: Limits, axis: str, where: str) -> None:
    """Refuse parameters outside the domain."""
    bad = t[~((t >= limits[0]) & (t <= limits[1]))]
    if len(bad):
        raise BadInputError(
            f"{axis} is {bad[0]:g}", where, f"give {axis} from {limits[0]:g} to {limits[1]:g}"
        )


def checked_parameters(
    u: object, v: object, domain: tuple[Limits, Limits], where: str
) -> tuple[FloatArray, FloatArray]:
    """Take parameters in the domain of a surface, numbers or arrays, broadcast.

    Raises
    ------
    BadInputError
        No numbers, outside the domain, or arrays that do not fit each other.
    """
    found = [_array(each, axis, where, "give numbers") for each, axis in ((u, "u"), (v, "v"))]
    for t, limits, axis in zip(found, domain, "uv", strict=True):
        _inside(t.ravel(), limits, axis, where)
    try:
        first, second = np.broadcast_arrays(*found)
    except ValueError:
        shapes = " and ".join(str(each.shape) for each in found)
        raise BadInputError(
            f"u and v are of shapes {shapes}", where, "give arrays that broadcast"
        ) from None
    return first, second


def _between(value: object, limits: Limits, axis: str, where: str) -> Limits:
    """Take two rising parameters; those within rounding of an end are the end."""
    given = _array(value, axis, where, "give (low, high)")
    if given.shape != (2,):
        raise WrongTypeError(f"{axis} is {shown(value)}", where, "give (low, high)")
    room = _SAME * max(abs(limits[0]), abs(limits[1]))
    ends = [next((end for end in limits if abs(t - end) <= room), t) for t in given.tolist()]
    _inside(np.array(ends), limits, axis, where)
    if not ends[1] - ends[0] > room:
        raise BadInputError(f"{axis} is {shown(value)}", where, "give (low, high), rising")
    return ends[0], ends[1]


def checked_part(
    u: object, v: object, domain: tuple[Limits, Limits], where: str
) -> tuple[Limits, Limits]:
    """Take a part of the domain of a surface: two rising parameters each way.

    Raises
    ------
    BadInputError
        Anything else.
    """
    return _between(u, domain[0], "u", where), _between(v, domain[1], "v", where)


# --------------------------------------------------------------------------------------
# The surface itself.


@attrs.frozen(eq=False)
class SplineSurface:
    """A tensor-product B-spline surface, one of its patches a Bezier surface.

    Attributes
    ----------
    name : str
        What messages and tables call it.
    degrees : (int, int)
        The degrees m in u and n in v, 1 to 7.
    knots_u : (nu + m + 1,)
        Knots in u, not falling. The parameter runs from knot m to knot nu; ends need not be
        repeated. A knot within is repeated m times at most.
    knots_v : (nv + n + 1,)
        Knots in v, likewise.
    net : (nu, nv, 3), m
        Control points; the first axis is u.
    weights : (nu, nv) or None
        Weights of the control points, above 0; None, or all equal, for a polynomial surface.

    Raises
    ------
    BadInputError
        Numbers that are not finite, other shapes, falling or torn knots, weights that are not
        above 0, degrees below 1 or above 7.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
    >>> net = np.zeros((3, 2, 3))
    >>> net[..., 0], net[..., 1] = np.mgrid[0:3, 0:2]
    >>> surface = SplineSurface("two strips", (1, 1), [0, 0, 1, 2, 2], [0, 0, 1, 1], net)
    >>> surface.at([0.5, 2.0], 1.0)
    array([[0.5, 1. , 0. ],
           [2. , 1. , 0. ]])
    """

    name: str = attrs.field(converter=checked_name)
    degrees: tuple[int, int] = attrs.field()
    knots_u: FloatArray = attrs.field()
    knots_v: FloatArray = attrs.field()
    net: FloatArray = attrs.field()
    weights: FloatArray | None = None

    def __attrs_post_init__(self) -> None:
        where = self.where
        net = checked_net(self.net, where)
        degrees = checked_degrees(self.degrees, net, where)
        knots = checked_surface_knots((self.knots_u, self.knots_v), degrees, net, where)
        weights = checked_weights(self.weights, net, where)
        freeze(net, *knots, *([] if weights is None else [weights]))
        found = {"degrees": degrees, "net": net, "weights": weights}
        found |= {"knots_u": knots[0], "knots_v": knots[1]}
        for key, value in found.items():
            object.__setattr__(self, key, value)

    @classmethod
    def bezier(cls, net: FloatArray, name: str = "", weights: FloatArray | None = None) -> Self:
        """Give the Bezier surface of a control net, with parameters 0 to 1.

        Parameters
        ----------
        net : (m + 1, n + 1, 3), m
            Control points; the first axis is u.
        name : str
            What messages and tables call it.
        weights : (m + 1, n + 1), optional
            Weights of the control points.

        Raises
        ------
        BadInputError
            As the class itself.

        Examples
        --------
        >>> import numpy as np
        >>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
        >>> SplineSurface.bezier(np.ones((2, 4, 3))).degrees
        (1, 3)
        """
        points = checked_net(net, f"in surface {checked_name(name)!r}")
        m, n = points.shape[0] - 1, points.shape[1] - 1
        knots = [np.repeat([0.0, 1.0], degree + 1) for degree in (m, n)]
        return cls(name, (m, n), knots[0], knots[1], points, weights)

    @property
    def where(self) -> str:
        """How messages call the place of what is wrong with this surface."""
        return f"in surface {self.name!r}" if self.name else "in a surface"

    @property
    def domain(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """The least and greatest parameters: ``((u0, u1), (v0, v1))``."""
        return knot_domain(self.knots_u, self.degrees[0]), knot_domain(
            self.knots_v, self.degrees[1]
        )

    @property
    def rational(self) -> bool:
        """Whether the weights differ."""
        return self.weights is not None

    def _homogeneous(self) -> FloatArray:
        """Give the net (nu, nv, 3), or with weights (nu, nv, 4): weighted points and weights."""
        if self.weights is None:
            return self.net
        weights = self.weights[..., None]
        return np.concatenate([self.net * weights, weights], axis=-1)

    def at(self, u: object, v: object) -> FloatArray:
        """Give points of the surface.

        Parameters
        ----------
        u, v : (...)
            Parameters in the domain; numbers or arrays, which broadcast.

        Returns
        -------
        (..., 3), m
            The points.

        Raises
        ------
        BadInputError
            A parameter that is no number, or outside the domain.

        Examples
        --------
        >>> import numpy as np
        >>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
        >>> net = np.zeros((2, 2, 3))
        >>> net[1, :, 0] = net[:, 1, 1] = net[1, 1, 2] = 1.0
        >>> SplineSurface.bezier(net, "hypar").at(0.5, 0.5)
        array([0.5 , 0.5 , 0.25])
        """
        (m, n), (ku, kv) = self.degrees, (self.knots_u, self.knots_v)
        u, v = checked_parameters(u, v, self.domain, self.where)
        if not u.size:
            return np.zeros((*u.shape, 3))
        s, t = u.ravel(), v.ravel()
        i, j = span_at(ku, m, s), span_at(kv, n, t)
        rows, columns = i[:, None] + np.arange(-m, 1), j[:, None] + np.arange(-n, 1)
        local = self._homogeneous()[rows[:, :, None], columns[:, None, :]]
        found = blossom(local, ku, m, i, np.repeat(s[:, None], m, 1))
        found = blossom(found, kv, n, j, np.repeat(t[:, None], n, 1))
        if self.weights is not None:
            found = found[:, :3] / found[:, 3:]
        return found.reshape(*u.shape, 3)

    def patches(self, number: int = 0) -> Patches:
        """Cut the surface at its knots into Bezier patches.

        Parameters
        ----------
        number : int
            The number of this surface, kept with the patches.

        Returns
        -------
        Patches
            The patches, in rows of equal u. Borders of neighbours have the same control points to
            the last bit. A control point of the surface has a share in (m + 1) (n + 1) patches at
            most; when it moves, the others stay as they are to the last bit.

        Examples
        --------
        >>> import numpy as np
        >>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
        >>> net = np.zeros((5, 4, 3))
        >>> net[..., 0], net[..., 1] = np.mgrid[0:5, 0:4]
        >>> knots = [0, 0, 0, 0, 1, 2, 2, 2, 2], [0, 0, 0, 0, 1, 1, 1, 1]
        >>> SplineSurface("plane", (3, 3), *knots, net).patches().box.tolist()
        [[[0.0, 1.0], [0.0, 1.0]], [[1.0, 2.0], [0.0, 1.0]]]
        """
        number = integer(number, "number", self.where, least=0)
        (m, n), (ku, kv) = self.degrees, (self.knots_u, self.knots_v)
        rows = bezier_pieces(self._homogeneous(), ku, m)
        found = bezier_pieces(np.moveaxis(rows, 2, 0), kv, n)
        found = np.moveaxis(found, (0, 1, 2, 3), (1, 3, 0, 2))
        found = np.ascontiguousarray(found).reshape(-1, m + 1, n + 1, found.shape[-1])
        box = _boxes(span_limits(ku, m), span_limits(kv, n))
        surface = np.full(len(found), number, np.intp)
        if self.weights is None:
            return Patches(found, box, surface)
        weight = np.ascontiguousarray(found[..., 3])
        return Patches(found[..., :3] / weight[..., None], box, surface, weight)

    def restricted(self, u: object, v: object, name: str | None = None) -> Self:
        """Give the part of the surface between two parameters each way, with parameters kept.

        Parameters
        ----------
        u, v : (low, high)
            The part; both in the domain.
        name : str, optional
            Its name; that of the surface if none is given.

        Returns
        -------
        SplineSurface
            The part, by knot insertion. Patches that it holds whole are those of the
            surface, to rounding.

        Raises
        ------
        BadInputError
            Anything but two rising numbers in the domain.

        Examples
        --------
        >>> import numpy as np
        >>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
        >>> net = np.zeros((2, 2, 3))
        >>> net[1, :, 0] = net[:, 1, 1] = 1.0
        >>> half = SplineSurface.bezier(net).restricted((0.5, 1), (0, 1))
        >>> half.domain, half.at(0.5, 1.0).tolist()
        (((0.5, 1.0), (0.0, 1.0)), [0.5, 1.0, 0.0])
        """
        between = checked_part(u, v, self.domain, self.where)
        points, knots_u = cut_spline(
            self._homogeneous(), self.knots_u, self.degrees[0], *between[0]
        )
        turned, knots_v = cut_spline(
            np.swapaxes(points, 0, 1), self.knots_v, self.degrees[1], *between[1]
        )
        net, weights = np.swapaxes(turned, 0, 1), None
        if self.weights is not None:
            net, weights = net[..., :3] / net[..., 3:], net[..., 3]
        name = self.name if name is None else name
        return type(self)(name, self.degrees, knots_u, knots_v, net, weights)


def _boxes(u: FloatArray, v: FloatArray) -> FloatArray:
    """Give all pairs of intervals (a, 2) and (b, 2), those of v running faster, (a b, 2, 2)."""
    return np.stack([np.repeat(u, len(v), axis=0), np.tile(v, (len(u), 1))], axis=1)
