"""Direct manipulation: a curve or surface is pulled, its control points change least.

A place ``Q(u) = sum N_i(u) P_i`` is asked to move by d. Of all changes of the control points that
do it, the one with the least sum ``w_i |dP_i|^2`` is taken; with the rows C of all that is asked,

    dP = W^-1 C^T (C W^-1 C^T)^-1 d

A pin is a target that moves by nil, a condition on a derivative is a row of derivatives of the
basis, a fixed control point is a column left out.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import BSpline

from assoc_hull.arguments import integer, numbers, shown
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["Basis", "CurveTarget", "SurfaceTarget", "least_change", "pull_curve", "pull_surface"]

_SINGULAR = 1e-10
"""Rows of unit length are taken to depend on one another below this singular value."""

_WHERE = "in pull"


@attrs.frozen(eq=False)
class Basis:
    """B-spline basis functions of one parameter.

    Attributes
    ----------
    knots : (n + degree + 1,)
        Knots, not falling.
    degree : int

    Examples
    --------
    >>> from assoc_hull.variation.direct.least_change import Basis
    >>> Basis.on([0, 0, 0, 0, 1, 1, 1, 1]).rows([0.5]).tolist()
    [[0.125, 0.375, 0.375, 0.125]]
    """

    knots: FloatArray
    degree: int = 3

    def __attrs_post_init__(self) -> None:
        freeze(self.knots)

    @classmethod
    def on(cls, knots: ArrayLike, degree: int = 3) -> Basis:
        """Take knots and degree as a designer gives them.

        Raises
        ------
        BadInputError
            Knots that fall, or fewer than two for each basis function of this degree.
        """
        integer(degree, "degree", _WHERE, least=1, most=9)
        given = numbers(knots, "knots", _WHERE)
        if len(given) < 2 * (degree + 1) or (np.diff(given) < 0.0).any():
            raise BadInputError(
                f"{len(given)} knots for degree {degree}, or knots that fall", _WHERE,
                f"give at least {2 * (degree + 1)}, none below the one before",
            )  # fmt: skip
        return cls(given.copy(), degree)

    @property
    def count(self) -> int:
        """Number of basis functions, so of control points."""
        return len(self.knots) - self.degree - 1

    def rows(self, u: ArrayLike, order: int = 0) -> FloatArray:
        """Give the values of all functions at parameters, or their derivatives, (k, n).

        Raises
        ------
        BadInputError
            A parameter off the curve.
        """
        at = numbers(u, "u", _WHERE)
        low, high = self.knots[self.degree], self.knots[-self.degree - 1]
        off = at[~((at >= low) & (at <= high))]
        if len(off):
            raise BadInputError(
                f"parameter {off[0]:g} lies off the curve", _WHERE, f"give {low:g} to {high:g}"
            )
        spline = BSpline(self.knots, np.eye(self.count), self.degree)
        found: FloatArray = spline(at, integer(order, "order", _WHERE, least=0, most=self.degree))
        return found


@attrs.frozen(eq=False)
class CurveTarget:
    """By how much a place of a curve, or a derivative there, is to change.

    Attributes
    ----------
    u : float
        Parameter.
    d : (c,), m
        Change of the place, or of the derivative by u; nil pins it.
    order : int
        0 for the place, 1 for the first derivative.
    """

    u: float
    d: Sequence[float] | FloatArray
    order: int = 0


@attrs.frozen(eq=False)
class SurfaceTarget:
    """By how much a place of a surface, or a derivative there, is to change.

    Attributes
    ----------
    u, v : float
        Parameters.
    d : (c,), m
        Change; nil pins it.
    order : (int, int)
        Of the derivative by u and by v.
    """

    u: float
    v: float
    d: Sequence[float] | FloatArray
    order: tuple[int, int] = (0, 0)


def pull_curve(
    basis: Basis,
    targets: Sequence[CurveTarget],
    *,
    fixed: Sequence[int] = (),
    weights: ArrayLike | None = None,
) -> FloatArray:
    """Give the least change of the control points of a B-spline curve that does what is asked.

    Parameters
    ----------
    basis : Basis
        Of the curve, n functions.
    targets : sequence of CurveTarget
        What is asked, pins among them.
    fixed : sequence of int
        Control points that stay.
    weights : (n,) or None
        Above nil: the larger, the less a control point moves; 1 if None.

    Returns
    -------
    (n, c), m
        Changes of the control points; frozen.

    Raises
    ------
    BadInputError
        Two targets on one point, or targets that depend on one another or move nothing that may
        move.

    Examples
    --------
    >>> from assoc_hull.variation.direct.least_change import Basis, CurveTarget, pull_curve
    >>> basis = Basis.on([0, 0, 0, 0, 1, 2, 3, 4, 4, 4, 4])
    >>> pull_curve(basis, [CurveTarget(1.7, (0.1, 0.4))])[2].round(12).tolist()
    [0.073401166196, 0.293604664785]
    """
    _some(targets)
    rows = np.concatenate([basis.rows([each.u], each.order) for each in targets])
    labels = [f"u={each.u:g}" for each in targets]
    return least_change(rows, _asked(targets), weights=weights, fixed=fixed, labels=labels)


def pull_surface(
    basis_u: Basis,
    basis_v: Basis,
    targets: Sequence[SurfaceTarget],
    *,
    fixed: Sequence[tuple[int, int]] = (),
    weights: ArrayLike | None = None,
) -> FloatArray:
    """Give the least change of the control net of a B-spline surface that does what is asked.

    Parameters
    ----------
    basis_u, basis_v : Basis
        Of the surface, n and m functions.
    targets : sequence of SurfaceTarget
        What is asked, pins among them.
    fixed : sequence of (int, int)
        Control points that stay.
    weights : (n, m) or None
        Above nil; 1 if None.

    Returns
    -------
    (n, m, c), m
        Changes of the control points; frozen.

    Raises
    ------
    BadInputError
        As for `pull_curve`.
    """
    _some(targets)
    shape = basis_u.count, basis_v.count
    rows = np.concatenate(
        [
            np.kron(basis_u.rows([each.u], each.order[0]), basis_v.rows([each.v], each.order[1]))
            for each in targets
        ]
    )
    found = least_change(
        rows,
        _asked(targets),
        weights=None if weights is None else np.ravel(weights),
        fixed=[_index(each, shape) for each in fixed],
        labels=[f"(u, v)=({each.u:g}, {each.v:g})" for each in targets],
    )
    return found.reshape(*shape, -1)


def _index(point: Sequence[int], shape: tuple[int, int]) -> int:
    """Give the number of a control point (i, j) of a net, row by row."""
    if np.shape(point) != (2,):
        raise BadInputError(f"fixed holds {shown(point)}", _WHERE, "give (i, j) each")
    i, j = (
        integer(each, "fixed", _WHERE, least=0, most=size - 1)
        for each, size in zip(point, shape, strict=True)
    )
    return i * shape[1] + j


def _some(targets: Sequence[object]) -> None:
    if not len(targets):
        raise BadInputError("pull: no target", _WHERE, "say what is to move, and by how much")


def _asked(targets: Sequence[CurveTarget] | Sequence[SurfaceTarget]) -> FloatArray:
    asked = [numbers(each.d, "d", _WHERE) for each in targets]
    size = {len(each) for each in asked}
    if len(size) > 1:
        raise BadInputError(
            f"pull: changes of {' and '.join(map(str, sorted(size)))} coordinates", _WHERE,
            "give as many coordinates of each target",
        )  # fmt: skip
    return np.stack(asked)


def least_change(
    rows: FloatArray,
    asked: FloatArray,
    *,
    weights: ArrayLike | None = None,
    fixed: Sequence[int] = (),
    labels: Sequence[str] | None = None,
) -> FloatArray:
    """Give the least x, in the norm of the weights, with ``rows x = asked``.

    Parameters
    ----------
    rows : (k, n)
        What is asked of x, row by row.
    asked : (k, c)
        Right-hand sides.
    weights : (n,) or None
        Above nil; 1 if None.
    fixed : sequence of int
        Entries of x that stay nil.
    labels : sequence of k str, or None
        What messages call the rows; their numbers if None.

    Returns
    -------
    (n, c)
        The solution; frozen.

    Raises
    ------
    BadInputError
        Rows that depend on one another, or are nil; weights that are not above nil.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.direct.least_change import least_change
    >>> least_change(np.array([[0.5, 0.5]]), np.array([[3.0]]), weights=[1.0, 2.0]).tolist()
    [[4.0], [2.0]]
    """
    count = rows.shape[1]
    root = np.ones(count) if weights is None else np.sqrt(_weights(weights, count))
    free = np.ones(count, bool)
    free[[integer(each, "fixed", _WHERE, least=0, most=count - 1) for each in fixed]] = False
    scaled = rows[:, free] / root[free]
    names = labels or [f"row {i}" for i in range(len(rows))]
    size = np.sqrt((scaled * scaled).sum(axis=1))
    # What the fixed columns leave is compared with the whole row: its rounding is no row.
    nil = np.flatnonzero(size <= _SINGULAR * np.sqrt((rows * rows).sum(axis=1)) / root.max())
    if len(nil):
        raise BadInputError(
            "pull: a target that no free control point moves", f"at {names[int(nil[0])]}",
            "leave it out, or fix fewer points",
        )  # fmt: skip
    unit = scaled / size[:, None]
    left, value, right = np.linalg.svd(unit, full_matrices=False)
    if len(value) < len(rows) or value[-1] < _SINGULAR * value[0]:
        raise _dependent(unit, names)
    found = np.zeros((count, asked.shape[1]))
    part = (left.T @ (asked / size[:, None])) / value[:, None]
    found[free] = (right.T @ part) / root[free, None]
    freeze(found)
    return found


def _weights(weights: ArrayLike, count: int) -> FloatArray:
    given = numbers(weights, "weights", _WHERE)
    if len(given) != count or (given <= 0.0).any():
        raise BadInputError(
            f"{len(given)} weights, the least {given.min(initial=np.inf):g}", _WHERE,
            f"give {count} above 0",
        )  # fmt: skip
    return given


def _dependent(unit: FloatArray, names: Sequence[str]) -> BadInputError:
    """Say which rows ask for the same."""
    alike = np.triu(1.0 - np.abs(unit @ unit.T) < _SINGULAR, 1)
    if alike.any():
        i, j = (int(each[0]) for each in np.nonzero(alike))
        return BadInputError(
            "pull: 2 targets on one point", f"at {names[i]} and {names[j]}", "leave one of them out"
        )
    return BadInputError(
        f"pull: {len(unit)} targets depend on one another", f"at {', '.join(names)}",
        "leave one of them out, or free more control points",
    )  # fmt: skip
