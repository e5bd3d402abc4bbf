"""Which arithmetic does the work: numpy, or the same operations compiled by numba.

Both give the same bits. numpy is the default; the environment variable
``ASSOC_HULL_FAST=1`` chooses numba. numba is not imported before it is chosen.

Examples
--------
>>> from assoc_hull.geometry.splines.backend import backend, set_backend
>>> set_backend("numpy")
>>> backend()
'numpy'
"""

from __future__ import annotations

import os
from types import ModuleType
from typing import Literal

from assoc_hull.errors import BadInputError, MissingExtraError

__all__ = ["Backend", "backend", "compiled", "set_backend"]

Backend = Literal["numpy", "numba"]

_chosen: list[ModuleType | None] = []
"""Empty until a backend is asked for; then the compiled kernels, or None for numpy."""


def set_backend(name: Backend) -> None:
    """Choose the backend of `loft` and `intersect_planes`, for the whole process.

    Parameters
    ----------
    name : "numpy" or "numba"
        The backend. Choosing numba compiles, or loads what was compiled before: this
        takes about half a second, a quarter of a minute the first time on a machine.

    Raises
    ------
    MissingExtraError
        If numba is not installed.
    BadInputError
        If there is no such backend.

    Examples
    --------
    >>> set_backend("numpy")
    """
    if name not in ("numpy", "numba"):
        raise BadInputError(f"backend {name!r} was asked", "in set_backend", "ask numpy or numba")
    _chosen[:] = [_load() if name == "numba" else None]


def backend() -> Backend:
    """Name the backend in use.

    Returns
    -------
    "numpy" or "numba"
        The backend.

    Examples
    --------
    >>> set_backend("numpy")
    >>> backend()
    'numpy'
    """
    return "numpy" if compiled() is None else "numba"


def compiled() -> ModuleType | None:
    """Give the compiled kernels, if they are to be used.

    Returns
    -------
    module or None
        `assoc_hull.geometry.splines.compiled`; None where numpy does the work.

    Raises
    ------
    MissingExtraError
        If the environment asks for numba and it is not installed.

    Examples
    --------
    >>> set_backend("numpy")
    >>> compiled() is None
    True
    """
    if not _chosen:
        set_backend("numba" if os.environ.get("ASSOC_HULL_FAST") == "1" else "numpy")
    return _chosen[0]


def _load() -> ModuleType:
    try:
        from assoc_hull.geometry.splines import compiled as fast
    except ModuleNotFoundError as error:
        if error.name != "numba":
            raise
        raise MissingExtraError("numba", "fast") from error
    fast.warm()
    return fast
