"""The cells of a net whose tables do not hold all crossings, where that can be mended."""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.net.gather import Net
from assoc_hull.surface.cells.faces import Cells, cells, following, loops
from assoc_hull.surface.cells.net_graph import NetGraph, net_graph
from assoc_hull.surface.cells.soundness import missed_crossings

__all__ = ["sound_cells"]


def sound_cells(net: Net, leave_out: NDArray[np.bool_] | None = None) -> Cells:
    """Find the cells of a net, with crossings that its tables do not hold if need be.

    Where the edges do not fit on half a hull, crossings are looked for along all lines; if they
    still do not, borders of flats are left out: they are found on some lines and drawn through,
    and two of them may run into one another. Both is told in the notes.

    Parameters
    ----------
    net : Net
        Curves and crossings.
    leave_out : (m,) bool or None
        Curves to do without.

    Raises
    ------
    OpenNetError
        As `cells`.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.analysis.net.gather import gather
    >>> from assoc_hull.surface.cells.sound_cells import sound_cells
    >>> found = sound_cells(gather(ah.examples.wigley().state))
    >>> found.count, found.notes
    (220, ())
    """
    first = net_graph(net, leave_out=leave_out)
    if _fits(first):
        return cells(first)
    gone = np.zeros(net.batch.count, bool) if leave_out is None else leave_out
    flat = net.flat & ~gone
    for search, without in ((True, gone), (False, gone | flat), (True, gone | flat)):
        graph = net_graph(net, leave_out=without, search=search)
        if _fits(graph):
            return attrs.evolve(cells(graph), notes=_notes(first, search, without & flat))
    return cells(first)


def _fits(graph: NetGraph) -> bool:
    """Tell whether the edges can be drawn on half a hull without crossing one another."""
    if not len(graph.edge):
        return False
    faces = len(loops(following(graph))[0]) - 1
    return len(graph.place) - len(graph.edge) + faces == 2


def _notes(graph: NetGraph, search: bool, flats: NDArray[np.bool_]) -> tuple[str, ...]:
    """Say what was done."""
    found = []
    if search:
        missed = missed_crossings(graph)
        found.append("crossings that the tables do not hold: " + "; ".join(missed))
    if flats.any():
        names = dict.fromkeys(graph.net.name[c] for c in np.flatnonzero(flats).tolist())
        found.append("left out, as they do not fit the lines: " + ", ".join(names))
    return tuple(found)
