"""Generated curves that are edited by hand leave their definitions, and keep their shape.

A curve is detached by whatever changes its points, their kinds, its end conditions or its plane,
but its definitions: before the update runs, so that no definition writes over what was asked for;
and after it, where the update itself has changed the curve.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TypeVar

import numpy as np

from assoc_hull.edit.modification import Pending
from assoc_hull.errors import AssocHullError
from assoc_hull.geometry.curves import IntArray
from assoc_hull.graph.journal import Journal
from assoc_hull.graph.table import Column, ValueColumn
from assoc_hull.model.form_definition import ON_FLATS, GeneratedCurve
from assoc_hull.model.generated_curves import attached_curves, points_given
from assoc_hull.model.kinds import Sort
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.network import bits_differ
from assoc_hull.model.tables import HullState

__all__ = ["detach", "detach_rows", "detached_note", "edited", "off_definitions", "tidy", "whole"]

V = TypeVar("V")

_TOLD = 3
"""So many curves a note names."""


def edited(state: HullState, journal: Journal, pending: Pending) -> set[int]:
    """Give the attached curves that the modifications of a transaction have edited by hand.

    Those that it has made, or made anew, of definitions are not among them.

    Parameters
    ----------
    state : HullState
        The tables, in which structure is changed already and places are not.
    journal : Journal
        What was written so far.
    pending : Pending
        What is asked for.
    """
    fresh = _changed(journal, state.produced.curve)
    made_so = {state.produced.curve[number].curve for number in fresh}
    known = {c: made for c, made in attached_curves(state).items() if c not in made_so}
    if not known:
        return set()
    moved = _moved(state, journal, pending)
    table = state.rows
    marked = moved.union(*(_changed(journal, each) for each in (
        table.kind, table.direction, table.sort, table.alive, table.reader, table.curve,
    )))  # fmt: skip
    found = {curve for curve, made in known.items() if marked.intersection(made.rows)}
    if pending.alone:
        found |= {c for c in known if moved.intersection(state.curves.rows[c].tolist())}
    recipes = _changed(journal, state.curves.ends) | _changed(journal, state.curves.alive)
    planes = _changed(journal, state.lines.offset) | _changed(journal, state.lines.normal)
    found |= {c for c in known if c in recipes or state.line_of(c) in planes}
    return found | {curve for curve, made in known.items() if not whole(state, made)}


def _moved(state: HullState, journal: Journal, pending: Pending) -> set[int]:
    """Give the points that lie, or are to lie, elsewhere by a bit."""
    rows = np.array(sorted(pending.values), np.int64)
    asked = np.array([pending.values[row] for row in rows.tolist()]).reshape(-1, 3) + 0.0
    there = state.rows.xyz.data
    found = set(rows[bits_differ(there[rows], asked)].tolist()) if len(rows) else set[int]()
    return found | _changed(journal, state.rows.xyz)


def _changed(journal: Journal, column: Column[np.generic] | ValueColumn[V]) -> set[int]:
    """Give the rows of a column that differ from what they were before the transaction."""
    if not any(column is each for each in journal.columns()):
        return set()
    if isinstance(column, ValueColumn):
        held = journal.net(column)
        pairs = zip(held.rows.tolist(), held.old, held.new, strict=True)
        return {row for row, old, new in pairs if old != new}
    net = journal.net(column)
    old, new = (part.reshape(len(net.rows), -1) for part in (net.old, net.new))
    differs = (old != new) & ~(_nan(old) & _nan(new))
    return set(net.rows[differs.any(axis=1)].tolist())


def _nan(values: np.typing.NDArray[np.generic]) -> np.typing.NDArray[np.bool_]:
    return np.isnan(values) if values.dtype.kind == "f" else np.zeros(values.shape, np.bool_)


def whole(state: HullState, made: GeneratedCurve) -> bool:
    """Tell whether just the points of a generated curve define it, in order, but for its ends."""
    rows: IntArray = state.curves.rows[made.curve]
    if not state.curves.alive[made.curve]:
        return False
    own = np.array(made.rows, np.int64)
    if (state.rows.sort[own] != Sort.ADOPTED).any():
        return False
    mine = np.isin(rows, own)
    if not np.array_equal(rows[mine], own):
        return False
    return made.what in ON_FLATS or bool(mine[1:-1].all())


def off_definitions(state: HullState, curves: Iterable[int]) -> set[int]:
    """Give those of some attached curves that are not as the definitions have them, to the bit."""
    known = attached_curves(state)
    chosen = [known[curve] for curve in curves if curve in known]
    broken = {made.curve for made in chosen if not whole(state, made)}
    return broken | _off(state, [made for made in chosen if made.curve not in broken])


def _off(state: HullState, chosen: Sequence[GeneratedCurve]) -> set[int]:
    """Compare all at once; one by one where some cannot be made at all."""
    try:
        rows, places = points_given(state, chosen)
    except AssocHullError:
        if len(chosen) == 1:
            return {chosen[0].curve}
        return set[int]().union(*(_off(state, [made]) for made in chosen))
    odd = rows[bits_differ(state.rows.xyz[rows], places)]
    return set(state.rows.curve[odd, 0].tolist())


def detach(maker: Maker, pending: Pending, curves: Iterable[int]) -> None:
    """Let curves keep their shape whatever the definitions say; those that have gone are dropped.

    The structure changes: look-ups have to be derived anew.
    """
    state, left = maker.state, set(curves)
    if not left:
        return
    found = []
    for made in state.generated:
        if made.curve not in left:
            found.append(made)
        elif state.curves.alive[made.curve]:
            found.append(_pruned(state, made.evolve(attached=False)))
    maker.generated(found)
    pending.detached += sorted(each for each in left if state.curves.alive[each])
    pending.structural = True


def _pruned(state: HullState, made: GeneratedCurve) -> GeneratedCurve:
    """Give a detached curve without the points that have gone."""
    alive = [
        bool(state.rows.alive[row]) and int(state.rows.curve[row, 0]) == made.curve
        for row in made.rows
    ]
    if all(alive):
        return made
    rows = tuple(row for row, here in zip(made.rows, alive, strict=True) if here)
    marks = tuple(mark for mark, here in zip(made.marks, alive, strict=True) if here)
    return made.evolve(rows=rows, marks=marks)


def tidy(maker: Maker) -> None:
    """Drop generated curves that have gone, and points that detached ones have lost."""
    state = maker.state
    there = [each for each in state.generated if state.curves.alive[each.curve]]
    maker.generated(each if each.attached else _pruned(state, each) for each in there)


def detach_rows(maker: Maker, pending: Pending, rows: IntArray) -> bool:
    """Detach the curves that some points are generated on; tell whether there are any."""
    known: Mapping[int, GeneratedCurve] = attached_curves(maker.state)
    moved = set(rows.tolist())
    left = {curve for curve, made in known.items() if moved.intersection(made.rows)}
    detach(maker, pending, left)
    return bool(left)


def detached_note(state: HullState, curves: Iterable[int]) -> list[str]:
    """Say in one note which lines were detached."""
    lines = sorted({state.line_of(curve) for curve in curves if state.curves.alive[curve]})
    names = [str(state.lines.name[line]) for line in lines]
    if not names:
        return []
    if len(names) == 1:
        return [f"{names[0]} is detached from the definitions; edit.reattach returns it"]
    told = ", ".join(names[:_TOLD])
    more = f" and {len(names) - _TOLD} more" if len(names) > _TOLD else ""
    return [
        f"{len(names)} lines are detached from the definitions, {told}{more}; edit.reattach "
        "returns one"
    ]
