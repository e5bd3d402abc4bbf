"""How the compiled backend is compiled. Importing this module imports numba.

Examples
--------
>>> from assoc_hull.geometry.numeric.jit import jit
>>> @jit
... def double(number: float) -> float:
...     return 2.0 * number
>>> double(3.0)
6.0
"""

from __future__ import annotations

from collections.abc import Callable
from typing import ParamSpec, TypeVar

import numba

__all__ = ["jit", "was_loaded"]

P = ParamSpec("P")
R = TypeVar("R")


def jit(function: Callable[P, R]) -> Callable[P, R]:
    """Compile a function so that it does the very operations that are written down.

    Parameters
    ----------
    function : callable
        What to compile, on the first call.

    Returns
    -------
    callable
        The compiled function. It neither reorders nor fuses operations (no fastmath),
        divides by nil as numpy does, and lets other threads run meanwhile. It is kept on
        disk where that is possible.

    Examples
    --------
    >>> @jit
    ... def half(number: float) -> float:
    ...     return number / 2.0
    >>> half(3.0)
    1.5
    """
    # Interactive functions have no file beside which a cache could lie.
    kept = not function.__code__.co_filename.startswith("<")
    decorate = numba.njit(cache=kept, error_model="numpy", nogil=True)
    result: Callable[P, R] = decorate(function)
    return result


def was_loaded(function: Callable[..., object]) -> bool:
    """Tell whether a compiled function came from the cache on the disk."""
    stats = getattr(function, "stats", None)
    return stats is not None and sum(stats.cache_hits.values()) > 0
