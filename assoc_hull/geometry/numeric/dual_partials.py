"""Derivatives of numpy's functions of one or two numbers, on plain arrays.

`PARTIAL` gives for each function its partial derivatives, one per argument, as functions of
all arguments and of the result. `assoc_hull.geometry.numeric.dual` chains them.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.numeric.dual_partials import PARTIAL
>>> [float(rule(3.0, 4.0, 5.0)) for rule in PARTIAL[np.hypot]]
[0.6, 0.8]
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

__all__ = ["CONSTANT", "PARTIAL", "Partial"]

Partial = Callable[..., Any]

CONSTANT = frozenset(
    {
        np.less, np.less_equal, np.greater, np.greater_equal, np.equal, np.not_equal,
        np.isfinite, np.isinf, np.isnan, np.sign, np.signbit,
    }
)  # fmt: skip
"""Functions whose result does not vary with its arguments, but for jumps: they see values."""


def _power_base(base: Any, exponent: Any, _: Any) -> Any:
    """``n x^(n - 1)``; nil for n = 0 also where x is nil."""
    nil = np.equal(exponent, 0)
    return np.where(nil, 0.0, exponent * np.power(base, np.where(nil, 1, exponent - 1)))


PARTIAL: Mapping[np.ufunc, tuple[Partial | None, ...]] = {
    np.positive: (lambda x, y: 1.0,),
    np.negative: (lambda x, y: -1.0,),
    np.absolute: (lambda x, y: np.sign(x),),
    np.square: (lambda x, y: 2.0 * x,),
    np.sqrt: (lambda x, y: 0.5 / y,),
    np.cbrt: (lambda x, y: y / (3.0 * x),),
    np.reciprocal: (lambda x, y: -y * y,),
    np.exp: (lambda x, y: y,),
    np.log: (lambda x, y: 1.0 / x,),
    np.sin: (lambda x, y: np.cos(x),),
    np.cos: (lambda x, y: -np.sin(x),),
    np.tan: (lambda x, y: 1.0 + y * y,),
    np.arcsin: (lambda x, y: 1.0 / np.sqrt(1.0 - x * x),),
    np.arccos: (lambda x, y: -1.0 / np.sqrt(1.0 - x * x),),
    np.arctan: (lambda x, y: 1.0 / (1.0 + x * x),),
    np.add: (lambda a, b, y: 1.0, lambda a, b, y: 1.0),
    np.subtract: (lambda a, b, y: 1.0, lambda a, b, y: -1.0),
    np.multiply: (lambda a, b, y: b, lambda a, b, y: a),
    np.true_divide: (lambda a, b, y: 1.0 / b, lambda a, b, y: -y / b),
    np.hypot: (lambda a, b, y: a / y, lambda a, b, y: b / y),
    np.arctan2: (lambda a, b, y: b / (a * a + b * b), lambda a, b, y: -a / (a * a + b * b)),
    # Where both are the same, the derivative is that of the first.
    np.maximum: (lambda a, b, y: 1.0 * (a >= b), lambda a, b, y: 1.0 * (a < b)),
    np.minimum: (lambda a, b, y: 1.0 * (a <= b), lambda a, b, y: 1.0 * (a > b)),
    np.power: (_power_base, None),
}
"""By function: the partial derivative for each argument; None where it must be a constant.

Of the magnitude it is nil at 0, where there is none.
"""
