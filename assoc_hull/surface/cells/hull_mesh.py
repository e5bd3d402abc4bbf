"""A closed mesh of a hull, of a plain call: what is asked for is checked here."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.hydrostatics.measured_hull import HasState, state_of
from assoc_hull.analysis.net.gather import Net, gather
from assoc_hull.arguments import all_of
from assoc_hull.errors import BadInputError, UnknownNameError
from assoc_hull.surface.cells.closed_mesh import ClosedMesh, mesh_of_net

__all__ = ["closed_mesh", "curves_named"]

_WHERE = "in a closed mesh"


def closed_mesh(
    hull: HasState, *, half: bool = False, points: int = 4, leave_out: Sequence[str] = ()
) -> ClosedMesh:
    """Make a closed mesh on the lines of a hull: for panels, printing, a check of volumes.

    The lines part the hull into cells; these are filled with elements that fit together along
    every edge. Deck and transom are covered, whatever the particulars say of the deck, and the
    half is mirrored. The mesh comes from the lines alone: it shares nothing with
    `assoc_hull.hydrostatics` but these.

    Parameters
    ----------
    hull : Hull
        The hull.
    half : bool
        The port half only, open in the centre plane.
    points : int
        Into how many parts each piece of a line between two crossings is cut: even, 2 to 64.
    leave_out : sequence of str
        Names of lines to do without.

    Returns
    -------
    ClosedMesh
        Checked: every edge is that of two triangles, once in each sense.

    Raises
    ------
    BadInputError
        A curve of the hull has failed, or an option is out of its range.
    UnknownNameError
        A line to leave out does not exist.
    OpenNetError
        The lines do not part the hull into cells; those at fault are named.
    OpenMeshError
        The mesh does not close all the same.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> hull = ah.examples.wigley()
    >>> mesh = ah.closed_mesh(hull)
    >>> mesh.names, mesh.report.euler, mesh.report.open_edges
    (('shell', 'deck'), 2, 0)
    >>> round(mesh.below(6.25).volume, 1), round(ah.hydrostatics(hull, draught=6.25).volume, 1)
    (2776.3, 2777.4)
    """
    state = state_of(hull, _WHERE)
    if state.failed:
        raise BadInputError("a curve has failed", _WHERE, "mend it, or take back the edit")
    net = gather(state)
    return mesh_of_net(net, half=half, points=points, leave_out=curves_named(net, leave_out))


def curves_named(net: Net, names: Sequence[str], where: str = _WHERE) -> NDArray[np.bool_]:
    """Tell which curves of a net are those of some lines, (m,).

    Raises
    ------
    WrongTypeError, UnknownNameError
        Something else than names was given, or a name is that of no line.
    """
    wanted = all_of(names, str, "leave_out", where)
    for name in wanted:
        if name not in net.name:
            raise UnknownNameError("line", name, tuple(dict.fromkeys(net.name)))
    return np.isin(np.array(net.name), wanted)
