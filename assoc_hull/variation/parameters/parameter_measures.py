"""The named parameters of a hull as it is, measured on its drawn curves.

Extremes are roots of derivatives of the splines, not defining points, so that values are exact
for the curves as drawn. Each measure takes `DrawnCurves` and gives a `MeasuredParameter`.

Examples
--------
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.variation.parameters.parameter_measures import measure_all
>>> found = measure_all(wigley())
>>> found["breadth"], found.absent["bulb_length"]
(10.0, 'no profile forward of FP below z=6.250')
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from types import MappingProxyType

from assoc_hull.arguments import shown
from assoc_hull.errors import UnknownNameError, WrongTypeError
from assoc_hull.graph.derived import Objects
from assoc_hull.model.tables import HasState, HullState, state_of
from assoc_hull.variation.parameters import hull_and_end_measures, midship_measures
from assoc_hull.variation.parameters.measurement import (
    DrawnCurves,
    MeasuredParameter,
    Measures,
)

__all__ = ["AMPLITUDES", "MEASURES", "measure", "measure_all"]

MEASURES: Mapping[str, Callable[[DrawnCurves], MeasuredParameter]] = MappingProxyType(
    {
        each.__name__: each
        for each in (
            hull_and_end_measures.length,
            hull_and_end_measures.breadth,
            hull_and_end_measures.draught,
            hull_and_end_measures.depth,
            hull_and_end_measures.deck_height,
            hull_and_end_measures.sheer_fore,
            hull_and_end_measures.sheer_aft,
            hull_and_end_measures.shaft_height,
            hull_and_end_measures.bossing_radius,
            hull_and_end_measures.transom_height,
            hull_and_end_measures.transom_half_breadth,
            hull_and_end_measures.bulb_height,
            hull_and_end_measures.bulb_half_breadth,
            hull_and_end_measures.bulb_area,
            hull_and_end_measures.bulb_section_height,
            hull_and_end_measures.bulb_length,
            midship_measures.bilge_radius,
            midship_measures.deadrise_deg,
            midship_measures.flat_of_bottom,
            midship_measures.parallel_body_start,
            midship_measures.parallel_body_end,
            midship_measures.parallel_body_length,
            hull_and_end_measures.stem_rake_deg,
            hull_and_end_measures.fore_frame_height,
            hull_and_end_measures.aft_frame_height,
            hull_and_end_measures.entrance_deg,
            hull_and_end_measures.run_deg,
            hull_and_end_measures.waterline_fullness,
        )
    }
)
"""What measures the named parameters, by name."""

AMPLITUDES = ("fore_shift", "aft_shift")
"""Parameters that are no property of a hull: they are zero until they are asked for."""


def _amplitude(name: str) -> MeasuredParameter:
    return MeasuredParameter(
        name, "m", 0.0, "largest movement of a section; nil for a hull as it is"
    )


def measure_all(state: HullState, only: Iterable[str] | None = None) -> Measures:
    """Measure named parameters of a hull.

    Parameters
    ----------
    state : HullState
        The tables.
    only : iterable of str or None
        Names; None: all of them, in the order of the catalogue.

    Raises
    ------
    UnknownNameError
        A name that is none of a parameter.
    """
    if only is None:
        return state.derived(("measures",), _depends_on(state), lambda: _measured(state, None), 2)
    return _measured(state, only)


def _depends_on(state: HullState) -> tuple[object, ...]:
    """Give what measures depend on: splines, features, and some columns."""
    rows, lines, curves = state.rows, state.lines, state.curves
    made = [state.spline(curve) for curve in state.live("curves").tolist()]
    return (
        Objects([*made, state.particulars, *state.features]), rows.xyz, rows.parameter, rows.role,
        rows.alive, rows.sort, rows.curve, lines.alive, lines.boundary, lines.offset, lines.planar,
        lines.normal, lines.group, curves.alive, curves.line, tuple(lines.name.data),
    )  # fmt: skip


def _measured(state: HullState, only: Iterable[str] | None) -> Measures:
    known = (*MEASURES, *AMPLITUDES)
    hull, found = DrawnCurves(state), []
    for name in known if only is None else _names(only):
        if name not in known:
            raise UnknownNameError("named parameter", name, known)
        found.append(_amplitude(name) if name in AMPLITUDES else hull.take(MEASURES[name]))
    return Measures(found)


def _names(only: object) -> tuple[str, ...]:
    """Take names; one alone may come without a list."""
    found = (only,) if isinstance(only, str) or not isinstance(only, Iterable) else tuple(only)
    for each in found:
        if not isinstance(each, str):
            raise WrongTypeError(f"only holds {shown(each)}", "in measure", "give names")
    return found


def measure(hull: HasState, *, only: Iterable[str] | None = None) -> Measures:
    """Give the present values of a hull's named parameters, and nothing spent.

    The arguments and what is raised are those of `Hull.measure`.
    """
    return measure_all(state_of(hull, "in measure"), only)
