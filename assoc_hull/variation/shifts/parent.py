"""What a shift needs to know of a hull: its values, its curve of areas, its terminals."""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.analysis.form.form_parameters import form_parameters
from assoc_hull.analysis.hydrostatics.area_curve import area_curve
from assoc_hull.analysis.hydrostatics.flotation import flotation
from assoc_hull.analysis.hydrostatics.hydrostatics import hydrostatics
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.floating.immersed import Planes
from assoc_hull.model.state import HullState
from assoc_hull.variation.parameters.layouts_body import shift_terminals
from assoc_hull.variation.parameters.parent_places import Parent
from assoc_hull.variation.shifts.elements import Elements
from assoc_hull.variation.shifts.shift_request import BODIES
from assoc_hull.variation.shifts.shift_terms import ShiftTerms, Terminals

__all__ = ["elements_of", "terminals_of", "values_of"]

_WHERE = "in shift_sections"


@attrs.frozen
class _Held:
    """Tables, as what is measured."""

    state: HullState


def values_of(state: HullState, names: Sequence[str]) -> FloatArray:
    """Give values of a hull at its design draught, upright.

    Parameters
    ----------
    state : HullState
        The tables.
    names : sequence of str
        Fields of `Hydrostatics`, or form parameters ``Cpf`` and ``Cpa``.

    Returns
    -------
    (n,)

    Raises
    ------
    BadInputError
        The hull has no such value.
    """
    hull = _Held(state)
    if all(name in BODIES for name in names):
        forms = form_parameters(hull, only=names)
        found = [forms[name].number for name in names]
    else:
        record = hydrostatics(hull, estimate=False, on_error="report")
        found = [getattr(record, name) for name in names]
    for name, value in zip(names, found, strict=True):
        if value is None:
            raise BadInputError(f"the hull has no {name}", _WHERE, "look at its hydrostatics")
    return np.array(found, np.float64)


def elements_of(state: HullState, terms: ShiftTerms) -> Elements:
    """Give the curve of areas of a hull at its design draught as elements of volume."""
    ship = state.particulars
    curve = area_curve(
        flotation(state), Planes(np.array([ship.draught]), np.zeros(1), np.zeros(1))
    )  # fmt: skip
    inside = terms.nodes[(terms.nodes > curve.low) & (terms.nodes < curve.high)]
    ends = np.array([curve.low, curve.high])
    return Elements.of(
        curve.at, np.concatenate([ends, curve.breaks, inside]), 0.5 * ship.length
    )  # fmt: skip


def terminals_of(parent: Parent, asked: Terminals | None) -> Terminals:
    """Give the terminals that are asked for, or those measured on a hull.

    Raises
    ------
    BadInputError
        The hull has none in order, and none are given.
    """
    if asked is not None:
        return asked
    return Terminals.of(shift_terminals(parent, "section shifts"))
