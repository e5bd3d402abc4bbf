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

__all__ = ["jit", "jit_part", "was_loaded"]

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


def jit_part(function: Callable[P, R]) -> Callable[P, R]:
    """Compile a function as `jit` does, that only compiled functions call.

    What would let Python call it is not made, which halves the time that this takes. What is
    handed to it had better be no literal number: numba would compile it once more for that.

    Examples
    --------
    >>> @jit_part
    ... def half(number: float) -> float:
    ...     return number / 2.0
    >>> @jit
    ... def quarter(number: float) -> float:
    ...     return half(half(number))
    >>> quarter(6.0)
    1.5
    """
    kept = not function.__code__.co_filename.startswith("<")
    # The stubs of numba do not know all of its options.
    options = {"cache": kept, "no_cpython_wrapper": True, "no_cfunc_wrapper": True}
    make: Callable[..., Callable[..., Callable[P, R]]] = numba.njit
    return make(error_model="numpy", nogil=True, **options)(function)


def was_loaded(function: Callable[..., object]) -> bool:
    """Tell whether a compiled function came from the cache on the disk."""
    stats = getattr(function, "stats", None)
    return stats is not None and sum(stats.cache_hits.values()) > 0
