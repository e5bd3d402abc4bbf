"""How fair a curve, the lines of a hull, or all lines of its net are, by five criteria.

A knuckle of the net is a joint that may bend. Offsets of a line are the crossings on it that
define neither of their lines: their gap, over the limit of the gap.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assoc_hull.analysis.fairness.fairness_table import FairnessTable
from assoc_hull.analysis.hydrostatics.measured_hull import HasState, state_of
from assoc_hull.arguments import shown
from assoc_hull.errors import BadInputError, GeometryError, UnknownNameError, WrongTypeError
from assoc_hull.geometry.curves import IntArray, PointKind, SplineBatch
from assoc_hull.geometry.fairness.criteria import FairnessRecord, Offsets, criteria
from assoc_hull.geometry.splines.fairness_pieces import Pieces, SplinePieces
from assoc_hull.model.curve import Curve
from assoc_hull.model.gaps import watched_on
from assoc_hull.model.line import Line
from assoc_hull.model.state import HullState

if TYPE_CHECKING:
    from scipy.interpolate import PPoly

    from assoc_hull.geometry.classical.arcs import Arcs
    from assoc_hull.geometry.classical.chord_spline import ChordSpline
    from assoc_hull.geometry.classical.elastica import Elastica
    from assoc_hull.geometry.classical.truncated_power_spline import TruncatedPower

    Single = PPoly | Arcs | ChordSpline | Elastica | TruncatedPower

__all__ = ["fairness", "hull_fairness"]

_WHERE = "in fairness"


def fairness(
    of: HasState | Line | Curve | Single,
    *,
    lines: Iterable[str] | None = None,
    allowed: int | Mapping[str, int] = 0,
    offsets: ArrayLike | None = None,
    tolerances: ArrayLike = 0.005,
) -> FairnessTable | FairnessRecord:
    """Take the five criteria of fairness as numbers; they are never put into one score.

    Parameters
    ----------
    of : Hull, Line, Curve or a plane curve
        What is looked at. A plane curve is a chord spline, an elastica, a chain of arcs, a
        truncated-power spline or a piecewise polynomial y(x) of scipy.
    lines : iterable of str, optional
        Names of lines of the hull; all of them by default.
    allowed : int or mapping of str to int
        Inflections that are wanted: of each curve, or by name of line (others: none).
    offsets : (k, 2), m, optional
        Points that a plane curve is meant to pass. Lines of a hull bring theirs along: the
        crossings that define neither line, and how wide their gaps may be.
    tolerances : float or (k,), m
        How far it may pass them.

    Returns
    -------
    FairnessTable or FairnessRecord
        A table, a record for each curve, of a hull, a line or one of its curves; one record of
        a plane curve.

    Raises
    ------
    GeometryError
        ``"fairness: curve has no length"``, ``"fairness: offsets and tolerances differ in
        length"``.
    UnknownNameError
        There is no such line.
    BadInputError
        A number of wanted inflections that is none.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> found = ah.fairness(ah.examples.wigley())
    >>> found["WL 2.5"][0].failed
    ()
    """
    if isinstance(of, Line | Curve) or isinstance(getattr(of, "state", None), HullState):
        if offsets is not None:
            what, remedy = "lines of a hull bring their offsets", "leave offsets out"
            raise BadInputError(what, _WHERE, remedy)
        return hull_fairness(cast("HasState | Line | Curve", of), lines, allowed)
    if lines is not None:
        raise BadInputError("lines of one curve", _WHERE, "give names of lines with a hull only")
    pieces, name = _pieces_of(of)
    points = None if offsets is None else Offsets.measured(pieces, offsets, tolerances)
    wanted = _count(allowed)
    return criteria(pieces, names=(name,), allowed=wanted, offsets=points)[0]


def _count(value: object) -> int:
    if isinstance(value, bool) or not isinstance(value, int | np.integer) or value < 0:
        raise BadInputError(f"allowed is {shown(value)}", _WHERE, "give a whole number from 0")
    if value > 10**9:
        raise BadInputError(f"allowed is {shown(value)}", _WHERE, "give a number below 1e9")
    return int(value)


def _pieces_of(curve: object) -> tuple[Pieces, str]:
    """Look at a plane curve in pieces, and name its kind."""
    # Only who asks for these curves waits for scipy's interpolation.
    from scipy.interpolate import PPoly

    from assoc_hull.analysis.fairness.classical_pieces import (
        ArcPieces,
        ElasticaPieces,
        chord_pieces,
    )
    from assoc_hull.geometry.classical.arcs import Arcs
    from assoc_hull.geometry.classical.chord_spline import ChordSpline
    from assoc_hull.geometry.classical.elastica import Elastica
    from assoc_hull.geometry.classical.truncated_power_spline import TruncatedPower
    from assoc_hull.geometry.splines.fairness_graph import GraphPieces

    if isinstance(curve, ChordSpline):
        return chord_pieces(curve), "chord spline"
    if isinstance(curve, Elastica):
        return ElasticaPieces((curve,)), "elastica"
    if isinstance(curve, Arcs):
        if not len(curve):
            raise GeometryError("fairness: curve has no length", "give one arc or more")
        return ArcPieces(curve), "arcs"
    if isinstance(curve, TruncatedPower):
        return GraphPieces.of(curve.curve), "truncated powers"
    if isinstance(curve, PPoly):
        return GraphPieces.of(curve), "graph"
    raise WrongTypeError(
        f"{shown(curve)} is no curve that can be looked at", _WHERE,
        "give a Hull, a Line, a Curve, a classical plane curve or a PPoly of scipy",
    )  # fmt: skip


def hull_fairness(
    of: HasState | Line | Curve,
    lines: Iterable[str] | None = None,
    allowed: int | Mapping[str, int] = 0,
) -> FairnessTable:
    """Look at curves of a net in one batch; arguments as of `fairness`."""
    state = of.tables if isinstance(of, Line | Curve) else state_of(of, _WHERE)
    chosen = _chosen(of, state, lines)
    if not chosen:
        return FairnessTable((), (), ())
    curves = np.array(chosen, np.int64)
    batch = SplineBatch.join([state.spline(curve) for curve in chosen])
    line = state.curves.line.data[curves]
    flat = state.lines.planar.data[line][:, None]
    pieces = SplinePieces(batch, np.where(flat, state.lines.normal.data[line], np.nan))
    names = [str(state.lines.name.data[each]) for each in line.tolist()]
    titles = [Curve.of(state, curve).name for curve in chosen]
    records = criteria(
        pieces,
        names=titles,
        knuckles=_knuckles(state, chosen),
        allowed=_wanted(allowed, names, state),
        offsets=_watched(state, curves),
    )
    keys = tuple(str(state.curves.key.data[curve]) for curve in chosen)
    return FairnessTable(records, keys, tuple(names))


def _chosen(
    of: HasState | Line | Curve, state: HullState, lines: Iterable[str] | None
) -> list[int]:
    """Give the numbers of the curves that are asked for, those with a shape."""
    if isinstance(of, Curve):
        which = [of.row]
    elif isinstance(of, Line):
        which = state.curves_of(of.row)
    else:
        which = [c for line in _lines(state, lines) for c in state.curves_of(line)]
    if lines is not None and isinstance(of, Line | Curve):
        raise BadInputError("lines of one line", _WHERE, "give names of lines with a hull only")
    return which


def _lines(state: HullState, lines: object) -> list[int]:
    live = [int(line) for line in state.live("lines")]
    if lines is None:
        return live
    if isinstance(lines, str) or not isinstance(lines, Iterable):
        raise WrongTypeError(f"lines is {shown(lines)}", _WHERE, "give a list of names")
    names = [str(state.lines.name.data[line]) for line in live]
    found = []
    for each in lines:
        if not isinstance(each, str):
            raise WrongTypeError(f"lines holds {shown(each)}", _WHERE, "give names")
        if each not in names:
            raise UnknownNameError("line", each, tuple(names))
        found += [line for line, name in zip(live, names, strict=True) if name == each]
    return found


def _wanted(allowed: int | Mapping[str, int], names: Sequence[str], state: HullState) -> IntArray:
    if not isinstance(allowed, Mapping):
        return np.full(len(names), _count(allowed))
    known = {str(state.lines.name.data[line]) for line in state.live("lines").tolist()}
    for each in allowed:
        if each not in known:
            raise UnknownNameError("line", str(each), tuple(known))
    return np.array([_count(allowed.get(name, 0)) for name in names])


def _knuckles(state: HullState, curves: Sequence[int]) -> NDArray[np.bool_]:
    """Tell for each segment but the last of all whether it ends at a knuckle of its curve."""
    kind, found = state.rows.kind.data, []
    for curve in curves:
        rows, side = state.curves.rows.data[curve], state.curves.side.data[curve]
        bent = kind[rows, side] == PointKind.KNUCKLE
        bent[-1] = False
        found.append(bent[1:])
    return np.concatenate(found)[:-1]


def _watched(state: HullState, curves: IntArray) -> Offsets:
    """Give the gaps of watched crossings as offsets of both lines."""
    rows = watched_on(state, curves)
    gap, limit = state.rows.gap.data[rows], state.rows.limit.data[rows]
    told = np.isfinite(gap) & (limit > 0.0)
    rows, gap, limit = rows[told], gap[told], limit[told]
    place = np.full(state.curves.count, -1)
    place[curves] = np.arange(len(curves))
    owner = place[state.rows.curve.data[rows]]
    mine = owner >= 0
    return Offsets(
        owner[mine], np.repeat(gap[:, None], 2, axis=1)[mine],
        np.repeat(limit[:, None], 2, axis=1)[mine],
    )  # fmt: skip
