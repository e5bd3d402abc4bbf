"""What comes of a transform: a curve as a series, and what the series leaves out."""

from __future__ import annotations

from typing import Literal

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import integer, numbers
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.integrals.chain_transforms import evaluate_descriptors
from assoc_hull.geometry.integrals.transforms import ComplexArray, Truncation, evaluate_series

__all__ = ["KINDS", "CurveTransform", "Kind"]

Kind = Literal["chebyshev", "sine", "fourier"]
KINDS = ("chebyshev", "sine", "fourier")


@attrs.frozen(eq=False)
class CurveTransform:
    """A curve as a series.

    Attributes
    ----------
    kind : "chebyshev", "sine" or "fourier"
        Which series.
    name : str
        Of the curve.
    along, across : str
        Abscissa and ordinate, or the real and the imaginary part: x, y, z, or A for areas.
    low, high : float, m
        Range of the abscissa: xi = -1 and 1; of Fourier descriptors, 0 and the length around.
    unit : float
        By what ordinates are divided: 1 (m or m2), or the largest of them (none).
    coefficients : (terms,), or (2 terms + 1,) complex
        From c_0, or from b_1; of Fourier descriptors (m), X_k with k from -terms to terms.
    position : str
        Where the hull floats, for sectional areas; else empty.
    truncation : Truncation
        What is left after 1, 2, ... terms or pairs of harmonics, over `unit` too.
    places : (q, 2)
        The curve itself, for pictures: abscissa (m) and ordinate over `unit`.
    """

    kind: Kind
    name: str
    along: str
    across: str
    low: float
    high: float
    unit: float
    coefficients: FloatArray | ComplexArray
    position: str
    truncation: Truncation
    places: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.coefficients, self.places)

    @property
    def terms(self) -> int:
        """Terms of the series, or harmonics to each side."""
        return len(self.truncation.rms)

    @property
    def orders(self) -> tuple[int, ...]:
        """The k of each coefficient."""
        first = {"chebyshev": 0, "sine": 1, "fourier": -self.terms}[self.kind]
        return tuple(range(first, first + len(self.coefficients)))

    def evaluate(self, at: ArrayLike, terms: int | None = None) -> FloatArray:
        """Add up the series.

        Parameters
        ----------
        at : float or (k,), m
            Abscissas; of Fourier descriptors, the length from where the curve begins.
        terms : int or None
            With the first so many terms, or harmonics to each side; all if None.

        Returns
        -------
        (k,), over `unit`, or (k, 2), m
            The ordinates, or the places.

        Raises
        ------
        BadInputError
            A place outside the range, or more terms than there are.
        """
        where = f"in the series of {self.name}"
        place = np.atleast_1d(numbers(at, "at", where))
        xi = 2.0 * (place - self.low) / (self.high - self.low) - 1.0
        if not (np.abs(xi) <= 1.0 + 1e-9).all():
            what = f"a place outside {self.low:.6g} to {self.high:.6g} m"
            raise BadInputError(what, where, "give places of the range")
        most = self.terms
        count = most if terms is None else integer(terms, "terms", where, least=1, most=most)
        if self.kind == "fourier":
            kept = np.asarray(self.coefficients[most - count : most + count + 1], np.complex128)
            return evaluate_descriptors(kept, 0.5 * (xi + 1.0))
        series = np.real(self.coefficients[:count])
        return evaluate_series(self.kind, series, np.clip(xi, -1.0, 1.0))
