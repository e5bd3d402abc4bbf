"""Shell plates: surfaces out of files, plates, their tables.

The face of what `surface` finds and `io` reads and writes.

Examples
--------
>>> from assoc_hull.plating import plates, read_surfaces
>>> plates.__name__, read_surfaces.__name__
('plates', 'read_surfaces')
"""

from __future__ import annotations

import os

from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.surface.plates import plates

__all__ = ["plates", "read_surfaces"]


def read_surfaces(
    path: str | os.PathLike[str], unit: str | None = None
) -> tuple[SplineSurface, ...]:
    """Read surfaces."""
    raise NotImplementedError
