"""Lines of a hull as circular arcs and straight lines, for the mould loft.

Examples
--------
>>> import assoc_hull as ah
>>> arcs = ah.production_arcs(ah.examples.wigley(), lines="WL 5", within=0.0005)
>>> print(arcs)
1 curves, 10 arcs, at most 0.440 mm off, least radius 244.449 m
"""

from __future__ import annotations

import os
from collections.abc import Sequence

import attrs

from assoc_hull.analysis.production_arcs import ArcLines, arc_lines
from assoc_hull.arguments import not_negative, positive
from assoc_hull.errors import BadInputError
from assoc_hull.hull import Hull
from assoc_hull.io.export.arcs import write_arcs
from assoc_hull.model.objects import Curve, Group, Line
from assoc_hull.model.tables import state_of

__all__ = ["ProductionArcs", "production_arcs"]

_FINEST, _COARSEST = 1e-6, 1.0
"""m: finer is the rounding of coordinates, coarser are no lines of a ship."""


@attrs.frozen(eq=False)
class ProductionArcs(ArcLines):
    """Lines of a hull as arcs and straight pieces, which can be written."""

    def save(self, path: str | os.PathLike[str], entities: str = "polylines") -> None:
        """Write the arcs, as a drawing (``.dxf``) or as a table (``.csv``).

        Parameters
        ----------
        path : path
            The file; what was there is replaced by the whole of it, or stays.
        entities : {"polylines", "arcs"}
            Of a drawing: one polyline a curve, exact to the last digit; or ARC and LINE one by
            one, for machines that read nothing else.

        Raises
        ------
        BadInputError, MissingExtraError
            Another ending, other entities, a file that cannot be written; no ezdxf for a drawing.
        """
        write_arcs(self, path, entities)


def production_arcs(
    hull: Hull,
    lines: Sequence[Group | Line | Curve | str] | Group | Line | Curve | str | None = None,
    within: float = 0.0005,
    least_radius: float = 0.0,
) -> ProductionArcs:
    """Make chains of circular arcs and straight lines of the lines of a hull.

    Neighbouring arcs have one tangent where they meet, and meet on the line; at knuckles both
    tangents are kept; straight runs are straight lines. Every line lies within the tolerance of
    its arcs, and every arc of its line, measured on ten times as many places as the search used.

    Parameters
    ----------
    hull : Hull
        The hull.
    lines : names, or handles of groups, lines or curves
        Which lines; all by default. Of a line that lies in no plane its plan and profile are
        given (of one athwart ships plan and body plan).
    within : float, m
        The tolerance, 0.001 mm to 1 m.
    least_radius : float, m
        Of all arcs; 0 leaves them free.

    Returns
    -------
    ProductionArcs
        A chain for each curve, number of arcs and deviations, what was left out and why; its
        `save` writes DXF or a table.

    Raises
    ------
    GeometryError
        A line that was named is bent more than the least radius and the tolerance allow; if all
        are asked for, it is left out, and the result says so.
    UnknownNameError, WrongTypeError, BadInputError
        Lines that are not there; a tolerance or radius that is no length.

    Notes
    -----
    Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for
    Design and Production", J. SNAK.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> arcs = ah.production_arcs(ah.examples.wigley(), lines=["WL 5"], within=0.001)
    >>> line = arcs.lines[0]
    >>> len(line.arcs) == arcs.count, bool(line.deviation.max() <= 0.001)
    (True, True)
    """
    where = "in production_arcs"
    state = state_of(hull, where)
    hull.document.require_ended("production_arcs")
    tolerance = positive(within, "within", where)
    if not _FINEST <= tolerance <= _COARSEST:
        what = f"within is {tolerance:g} m"
        raise BadInputError(what, where, f"give {_FINEST:g} to {_COARSEST:g} m")
    radius = not_negative(least_radius, "least_radius", where)
    found = arc_lines(state, lines, tolerance, radius)
    return ProductionArcs(*attrs.astuple(found, recurse=False))
