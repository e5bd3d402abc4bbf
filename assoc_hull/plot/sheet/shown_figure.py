"""A figure of matplotlib that a notebook shows without being told to.

It is a module of its own since it imports matplotlib, which others import when a sheet is made.
"""

from __future__ import annotations

import io

from matplotlib.figure import Figure

__all__ = ["ShownFigure"]

_DOTS = 100.0
"""Of an inch on the screen."""


class ShownFigure(Figure):
    """A figure that a notebook shows as a picture, whether pyplot has been imported or not."""

    def _repr_png_(self) -> bytes:
        file = io.BytesIO()
        self.savefig(file, format="png", dpi=_DOTS)
        return file.getvalue()
