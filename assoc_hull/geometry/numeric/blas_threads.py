"""Linear algebra on one thread: what it gives must not depend on how many cores a machine has.

Libraries of linear algebra divide a sum among the threads they have, and every division rounds
otherwise: a mesh that was read with two threads gave other last digits than with one.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from threadpoolctl import threadpool_limits

__all__ = ["one_thread"]


def one_thread() -> threadpool_limits:
    """Hold libraries of linear algebra to one thread from now on, or for a block of ``with``.

    Examples
    --------
    >>> from assoc_hull.geometry.numeric.blas_threads import one_thread
    >>> with one_thread():
    ...     pass
    """
    import scipy.linalg  # noqa: F401  # brings a library of its own, which must be there by now
    from threadpoolctl import threadpool_limits

    return threadpool_limits(limits=1)
