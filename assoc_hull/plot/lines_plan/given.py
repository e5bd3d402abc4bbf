"""Lines as they were handed in, as a drawing: what a hull was before it was adopted."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from assoc_hull.geometry.splines.evaluation import sample
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.model.kinds import FAMILIES
from assoc_hull.model.line_source import LineSource, curve_data
from assoc_hull.model.state import Particulars
from assoc_hull.plot.lines_plan.drawing import CHORDS, Crossings, Drawing, DrawnLine, short_name

__all__ = ["given_lines"]


def given_lines(sources: Sequence[LineSource], particulars: Particulars) -> Drawing:
    """Make a drawing of lines before adoption, each lofted through all its own points.

    Parameters
    ----------
    sources : sequence of LineSource
        The lines; several of one name are one line.
    particulars : Particulars
        Principal dimensions.

    Examples
    --------
    >>> from assoc_hull.model.line_source import curve_data, LineSource
    >>> from assoc_hull.model.state import Particulars
    >>> from assoc_hull.plot.lines_plan.given import given_lines
    >>> water = LineSource.make("waterlines", "WL 1", [[0, 0, 1], [5, 2, 1], [9, 0, 1]])
    >>> given_lines([water], Particulars("boat", 9.0, 4.0, 2.0, 1.0)).line("WL 1").offset
    1.0
    """
    pieces: dict[tuple[str, str], list[LineSource]] = {}
    for source in sources:
        pieces.setdefault((source.group, source.name), []).append(source)
    lines = [_drawn(mine) for mine in pieces.values()]
    lines.sort(key=lambda line: (FAMILIES[line.family].rank, line.offset, line.name))
    none = Crossings((), (), np.zeros((0, 3)), np.zeros((0, 3)))
    return Drawing(particulars, tuple(lines), none)


def _drawn(pieces: Sequence[LineSource]) -> DrawnLine:
    first = pieces[0]
    splines = tuple(loft(curve_data([piece])) for piece in pieces)
    short = short_name(first.name, FAMILIES[first.family].prefix)
    return DrawnLine(
        first.name, short, first.family, first.boundary,
        np.full(3, np.nan) if first.normal is None else first.normal,
        float("nan") if first.normal is None else first.offset,
        splines, tuple(sample(spline, CHORDS)[1] for spline in splines),
    )  # fmt: skip
