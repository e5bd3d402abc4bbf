"""From a definition to the form definitions of a hull and its generated curves, all checked.

Examples
--------
>>> from assoc_hull.graph.journal import Journal
>>> from assoc_hull.model.definition.filling import Keys
>>> from assoc_hull.model.definition.filling_forms import put_forms
>>> from assoc_hull.model.state import HullState, Particulars
>>> state = HullState(Particulars("S", 9.0, 2.0, 1.0, 1.0))
>>> put_forms(state, Journal(), {}, Keys({}, {}, {}, {}))
>>> state.definitions, state.generated
((), ())
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.graph.journal import Journal
from assoc_hull.model.definition.filling import Keys, wrong
from assoc_hull.model.definition_part import GENERATED, FormDefinition, GeneratedCurve
from assoc_hull.model.kinds import Sort
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.state import HullState

__all__ = ["computed_points", "put_forms"]

Record = Mapping[str, Any]


def computed_points(definition: Record) -> frozenset[str]:
    """Name the points whose places come from form definitions."""
    return frozenset(
        key
        for record in definition.get("generated", ())
        if record.get("attached", True)
        for key in record["points"]
    )


def put_forms(state: HullState, journal: Journal, definition: Record, keys: Keys) -> None:
    """Put form definitions and generated curves into tables that hold curves and points.

    Raises
    ------
    BadInputError
        A curve or point that is not there, a use or curve that stands twice, values that
        do not fit the kind, or points that do not define their curve in this order.
    """
    forms = [_form(record) for record in definition.get("definitions", ())]
    curves = [_curve(state, record, keys) for record in definition.get("generated", ())]
    for title, found in (("use", [each.use for each in forms]),
                         ("name", [each.name for each in forms]),
                         ("curve", [each.key for each in curves])):  # fmt: skip
        twice = sorted({each for each in found if found.count(each) > 1})
        if twice:
            raise wrong(f"the {title} {twice[0]!r} stands there twice", "in the definitions")
    maker = Maker(state, journal)
    maker.definitions(forms)
    maker.generated(curves)


def _form(record: Record) -> FormDefinition:
    try:
        return FormDefinition(
            record["name"], record["use"], record["kind"], record["values"], record["rule"],
            record["nodes"],
        )  # fmt: skip
    except BadInputError as error:
        raise wrong(error.what, error.where) from error


def _curve(state: HullState, record: Record, keys: Keys) -> GeneratedCurve:
    key = record["curve"]
    where = f"at the generated curve {key!r}"
    curve = keys.find("curves", key, "the generated curves")
    if record["what"] not in GENERATED:
        raise wrong(f"{record['what']!r} cannot be generated", where)
    rows = tuple(keys.find("points", point, key) for point in record["points"])
    marks = tuple(_mark(mark, where) for mark in record["marks"])
    pieces = record["layout"].split("+")
    beyond = [mark for mark in marks if mark[0] >= len(pieces)]
    if beyond and record["what"] != "waterline":
        raise wrong(f"a mark on piece {beyond[0][0]}, of {len(pieces)}", where)
    attached = bool(record.get("attached", True))
    if len(marks) != len(rows):
        raise wrong(f"there are {len(rows)} points and {len(marks)} marks", where)
    if attached:
        _check(state, curve, rows, where)
    return GeneratedCurve(key, curve, record["what"], record["layout"], rows, marks, attached)


def _mark(mark: Sequence[float], where: str) -> tuple[int, float]:
    piece, t = mark
    if piece != int(piece):
        raise wrong(f"the piece {piece!r} is no whole number", where)
    return int(piece), float(t)


def _check(state: HullState, curve: int, rows: tuple[int, ...], where: str) -> None:
    """Require that the points of an attached curve define it in their order, all adopted."""
    chosen = np.array(rows, np.int64)
    defining = state.curves.rows.data[curve]
    if not np.array_equal(defining[np.isin(defining, chosen)], chosen):
        raise wrong("its points do not define it in this order", where)
    if (state.rows.sort.data[chosen] != Sort.ADOPTED).any():
        raise wrong("a point of it is not adopted", where)
