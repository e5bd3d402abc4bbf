"""Linear least squares as classical curves use them: weighted, held to equations, bounded.

A fit that is held exactly to some linear equations is solved in their null space: the coefficients
are a particular solution plus what the equations leave free, which makes an ordinary problem of
least squares. The same result comes from Lagrange's multipliers, with the condition squared.

Sources: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK; the surveys there of Roesingh and Berghuis (a user's own basis, with bounds),
Kaiser (patches held at their edges), Kantorowitz (discrete orthogonal polynomials).
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import numbers, positive_weights, whole_number
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["LinearFit", "OrthogonalFit", "bounded_fit", "held_fit", "linear_fit", "orthogonal_fit"]


@attrs.frozen(eq=False)
class LinearFit:
    """Coefficients, and how far the fit leaves the data.

    Attributes
    ----------
    coefficients : (k,)
        One per column.
    rms : float
        Root of the (weighted) mean square of the residuals, in the unit of the data.
    """

    coefficients: FloatArray
    rms: float

    def __attrs_post_init__(self) -> None:
        freeze(self.coefficients)


def linear_fit(
    matrix: ArrayLike, data: ArrayLike, weights: ArrayLike | None = None, name: str = "fit"
) -> LinearFit:
    """Fit coefficients of given columns.

    Parameters
    ----------
    matrix : (n, k)
        The values of the k basis functions at the n places.
    data : (n,)
        What they are to add up to.
    weights : (n,) or None
        Above 0; 1 if None.
    name : str
        Of the curve, for messages.

    Raises
    ------
    GeometryError
        Weights that are not positive; columns of which one follows from the others at these
        places (``"{name}: rank-deficient (points too close together)"``).

    Examples
    --------
    >>> from assoc_hull.geometry.classical.linear_least_squares import linear_fit
    >>> linear_fit([[1, 0], [1, 1], [1, 2]], [1, 3, 5]).coefficients.round(9).tolist()
    [1.0, 2.0]
    """
    columns = numbers(matrix, name, (None, None))
    right = numbers(data, name, (len(columns),))
    root = np.sqrt(positive_weights(weights, len(columns), name))
    found, _, rank, _ = np.linalg.lstsq(root[:, None] * columns, root * right, rcond=None)
    if rank < columns.shape[1]:
        raise _deficient(name, int(rank), columns.shape[1])
    return LinearFit(np.asarray(found, np.float64), _rms(columns @ found - right, root))


def held_fit(
    matrix: ArrayLike,
    data: ArrayLike,
    held: ArrayLike,
    values: ArrayLike,
    weights: ArrayLike | None = None,
    name: str = "fit",
) -> LinearFit:
    """Fit coefficients that satisfy linear equations exactly.

    Parameters
    ----------
    matrix, data, weights, name
        As in `linear_fit`.
    held : (m, k)
        The equations ``held @ coefficients = values``.
    values : (m,)

    Raises
    ------
    GeometryError
        As `linear_fit`; equations that contradict one another.

    Examples
    --------
    A line through (0, 1), nearest to two points:

    >>> from assoc_hull.geometry.classical.linear_least_squares import held_fit
    >>> held_fit([[1, 1], [1, 2]], [3.1, 4.9], [[1, 0]], [1]).coefficients.round(9).tolist()
    [1.0, 1.98]
    """
    from scipy.linalg import null_space

    columns = numbers(matrix, name, (None, None))
    equations = numbers(held, name, (None, columns.shape[1]))
    wanted = numbers(values, name, (len(equations),))
    given = np.linalg.lstsq(equations, wanted, rcond=None)[0]
    miss = float(np.abs(equations @ given - wanted).max(initial=0.0))
    if miss > 1e-9 * max(1.0, float(np.abs(wanted).max(initial=0.0))):
        what = f"{name}: the equations to be held contradict one another by {miss:.3g}"
        raise GeometryError(what, "leave one of them out", {"by": miss})
    free = null_space(equations)
    right = numbers(data, name, (len(columns),)) - columns @ given
    part = linear_fit(columns @ free, right, weights, name)
    return LinearFit(given + free @ part.coefficients, part.rms)


def bounded_fit(
    matrix: ArrayLike, data: ArrayLike, least: ArrayLike, most: ArrayLike, name: str = "fit"
) -> LinearFit:
    """Fit coefficients that stay within bounds.

    Parameters
    ----------
    matrix, data, name
        As in `linear_fit`.
    least, most : (k,) or float
        Bounds of the coefficients; may be infinite.

    Raises
    ------
    GeometryError
        Bounds that leave nothing between them; no data.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.linear_least_squares import bounded_fit
    >>> bounded_fit([[1, 0], [0, 1]], [-1, 2], 0.0, 5.0).coefficients.round(6).tolist()
    [0.0, 2.0]
    """
    from scipy.optimize import lsq_linear

    columns = numbers(matrix, name, (None, None))
    right = numbers(data, name, (len(columns),))
    try:
        low, high = (np.broadcast_to(np.asarray(b, float), columns.shape[1]) for b in (least, most))
    except (TypeError, ValueError, OverflowError):
        what = f"{name}: bounds of {columns.shape[1]} coefficients are no numbers, or not so many"
        raise GeometryError(what, "give one for all, or one each") from None
    bad = np.flatnonzero(~(low < high))
    if len(bad):
        what = f"{name}: bounds {low[bad[0]]:g} to {high[bad[0]]:g} of coefficient {bad[0]}"
        raise GeometryError(what, "give the lesser first", {"index": int(bad[0])})
    if not columns.size:
        raise _deficient(name, 0, columns.shape[1])
    # Bounded variables by active sets end at a vertex exactly; the interior method only nears it.
    found = lsq_linear(columns, right, (low, high), method="bvls").x
    return LinearFit(np.asarray(found), _rms(columns @ found - right, np.ones(len(right))))


@attrs.frozen(eq=False)
class OrthogonalFit:
    """A fit in columns made orthogonal over the places themselves.

    A coefficient does not change when later columns are taken up or left out: a series of lower
    order is read off by leaving the last ones out.

    Attributes
    ----------
    coefficients : (k,)
        Of the orthonormal columns, first to last.
    back : (k, k)
        Upper triangle R of the columns A = Q R.
    """

    coefficients: FloatArray
    back: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.coefficients, self.back)

    def lower(self, terms: int) -> FloatArray:
        """Give coefficients of the first `terms` columns as they were handed in, (terms,).

        Raises
        ------
        GeometryError
            Terms that there are not.
        """
        from scipy.linalg import solve_triangular

        n = whole_number(terms, "fit: terms", 1, len(self.coefficients))
        found: FloatArray = solve_triangular(self.back[:n, :n], self.coefficients[:n])
        return found


def orthogonal_fit(matrix: ArrayLike, data: ArrayLike, name: str = "fit") -> OrthogonalFit:
    """Fit discrete orthogonal polynomials: the columns, made orthonormal at the places.

    Parameters
    ----------
    matrix, data, name
        As in `linear_fit`; for polynomials a matrix of powers, or of two variables.

    Raises
    ------
    GeometryError
        ``"{name}: rank-deficient (points too close together)"``.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.classical.linear_least_squares import orthogonal_fit
    >>> x = np.linspace(-1.0, 1.0, 9)
    >>> fit = orthogonal_fit(np.vander(x, 4, increasing=True), 1.0 + 2.0 * x)
    >>> fit.lower(2).round(9).tolist()
    [1.0, 2.0]
    """
    columns = numbers(matrix, name, (None, None))
    right = numbers(data, name, (len(columns),))
    across, back = np.linalg.qr(columns)
    heart = np.abs(np.diag(back))
    rank = int((heart > heart.max(initial=0.0) * len(columns) * np.finfo(float).eps).sum())
    if len(columns) < columns.shape[1] or rank < columns.shape[1]:
        raise _deficient(name, rank, columns.shape[1])
    return OrthogonalFit(across.T @ right, back)


def _rms(residual: FloatArray, root: FloatArray) -> float:
    return float(np.sqrt(np.sum((root * residual) ** 2) / np.sum(root * root)))


def _deficient(name: str, rank: int, wanted: int) -> GeometryError:
    what = f"{name}: rank-deficient (points too close together)"
    return GeometryError(what, "spread the points, or give more", {"rank": rank, "wanted": wanted})
