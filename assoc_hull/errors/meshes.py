"""Errors of meshes of a hull: lines that enclose nothing, triangles that do not close."""

from __future__ import annotations

import attrs

from assoc_hull.errors.family import AssocHullError

__all__ = ["OpenMeshError", "OpenNetError"]

_SHOWN = 4


@attrs.define(slots=False, eq=False)
class OpenNetError(AssocHullError, ValueError):
    """The lines of a hull do not part its surface into cells.

    Attributes
    ----------
    what : str
        What is wrong.
    findings : tuple of str
        The lines or crossings at fault, each with its place; none where none could be found.
    remedy : str
        What to do.
    """

    what: str
    findings: tuple[str, ...]
    remedy: str

    def __str__(self) -> str:
        shown = ", ".join(self.findings[:_SHOWN])
        left = len(self.findings) - _SHOWN
        more = f" and {left} more" if left > 0 else ""
        told = f": {shown}{more}" if shown else ""
        return f"the lines do not part the hull into cells: {self.what}{told}; {self.remedy}"


@attrs.define(slots=False, eq=False)
class OpenMeshError(AssocHullError, RuntimeError):
    """A mesh that is not closed has no volume, and is not written.

    Attributes
    ----------
    asked : str
        What was asked of it.
    edges : int
        How many edges are not those of two triangles, once in each sense.
    place : (float, float, float), m
        Where the first of them is.
    remedy : str
        What to do.
    """

    asked: str
    edges: int
    place: tuple[float, float, float]
    remedy: str

    def __str__(self) -> str:
        at = ", ".join(f"{each:.3f}" for each in self.place)
        return (
            f"{self.asked} of a mesh with {self.edges} open edges, the first at ({at}) m; "
            f"{self.remedy}"
        )
