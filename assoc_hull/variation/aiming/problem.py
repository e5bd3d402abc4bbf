"""What aiming asks of a problem: outputs of a hull at given amplitudes, and their derivatives."""

from __future__ import annotations

from typing import Protocol

from assoc_hull.geometry.curves import FloatArray

__all__ = ["Evaluated", "Problem"]


class Evaluated(Protocol):
    """A certified hull at some amplitudes."""

    @property
    def values(self) -> FloatArray:
        """Outputs in their own units, (m,)."""
        ...

    @property
    def jacobian(self) -> FloatArray:
        """Derivatives of outputs by amplitudes, (m, k); may be computed when first asked for."""
        ...


class Problem(Protocol):
    """Outputs of a hull as functions of amplitudes of its free parameters.

    An amplitude is the change of a named parameter from its present value, in m or degrees, or
    the factor on a layer as it was given.
    """

    @property
    def free(self) -> tuple[str, ...]:
        """Names of the k free parameters."""
        ...

    @property
    def outputs(self) -> tuple[str, ...]:
        """Names of the m outputs that are aimed at."""
        ...

    def at(self, amplitudes: FloatArray) -> Evaluated:
        """Give the hull at amplitudes, (k,).

        Raises
        ------
        AssocHullError
            There is no certified hull there.
        """
        ...
