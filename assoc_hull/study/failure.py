"""Why a variant of a study is none."""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.errors import (
    AssocHullError,
    FoldError,
    OutOfRangeError,
    RefusedEditError,
)
from assoc_hull.geometry.curves import FloatArray

__all__ = ["NotReachedError", "kind_of"]


@attrs.define(slots=False, eq=False)
class NotReachedError(AssocHullError, ValueError):
    """Steps towards targets came to no end; the output that is farthest off is named."""

    names: Sequence[str]
    target: FloatArray
    best: FloatArray
    trials: int

    def __str__(self) -> str:
        part = np.abs(self.target - self.best) / np.maximum(np.abs(self.target), 1e-300)
        worst = int(part.argmax())
        return (
            f"{self.names[worst]} came to {self.best[worst]:.9g}, {self.target[worst]:.9g} was "
            f"asked, in study after {self.trials} trials; ask for less, or free other parameters"
        )


def kind_of(error: AssocHullError) -> str:
    """Give a word for what went wrong, by which failed variants are counted.

    Examples
    --------
    >>> from assoc_hull.errors import RefusedEditError
    >>> from assoc_hull.study.failure import kind_of
    >>> kind_of(RefusedEditError("x", ("a line folds",)))
    'refused'
    """
    words: tuple[tuple[type[AssocHullError], str], ...] = (
        (FoldError, "map folds"),
        (OutOfRangeError, "out of range"),
        (RefusedEditError, "refused"),
        (NotReachedError, "not reached"),
    )
    return next((word for kind, word in words if isinstance(error, kind)), "no hull")
