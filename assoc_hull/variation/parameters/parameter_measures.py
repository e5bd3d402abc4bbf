"""The named parameters of a hull as it is, measured on its drawn curves.

Extremes are roots of derivatives of the splines, not defining points, so that values are exact
for the curves as drawn. Each measure takes a `Drawn` hull and gives an `Anchor`.

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
from assoc_hull.model.tables import HasState, HullState, state_of
from assoc_hull.variation.parameters import hull_and_end_measures as anchors_bow
from assoc_hull.variation.parameters import hull_and_end_measures as anchors_hull
from assoc_hull.variation.parameters import hull_and_end_measures as anchors_stern
from assoc_hull.variation.parameters import midship_measures as anchors_midship
from assoc_hull.variation.parameters import midship_measures as anchors_parallel
from assoc_hull.variation.parameters.measurement import DrawnCurves, MeasuredParameter, Measures

__all__ = ["AMPLITUDES", "MEASURES", "measure", "measure_all"]

MEASURES: Mapping[str, Callable[[DrawnCurves], MeasuredParameter]] = MappingProxyType(
    {
        each.__name__: each
        for each in (
            anchors_hull.length,
            anchors_hull.breadth,
            anchors_hull.draught,
            anchors_hull.depth,
            anchors_hull.deck_height,
            anchors_stern.shaft_height,
            anchors_stern.bossing_radius,
            anchors_stern.transom_height,
            anchors_stern.transom_half_breadth,
            anchors_bow.bulb_height,
            anchors_bow.bulb_half_breadth,
            anchors_bow.bulb_length,
            anchors_midship.bilge_radius,
            anchors_midship.deadrise_deg,
            anchors_midship.flat_of_bottom,
            anchors_parallel.parallel_body_start,
            anchors_parallel.parallel_body_end,
            anchors_bow.stem_rake_deg,
        )
    }
)
"""What measures the named parameters, by name."""

AMPLITUDES = ("fore_shift", "aft_shift")
"""Parameters that are no property of a hull: they are nil until they are asked for."""


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
    """Give the present values of a hull's named parameters.

    Parameters
    ----------
    hull : Hull
        The hull.
    only : iterable of str or None
        Names of parameters; None: all of them.

    Returns
    -------
    mapping of str to float
        Values by name, in m, or in degrees where the name ends in ``_deg``; x from AP forward,
        z from the base line up. `absent` tells by name why the hull has no such parameter,
        `anchors` where and how each was measured.

    Raises
    ------
    UnknownNameError
        A name that is none of a parameter.

    Examples
    --------
    >>> from assoc_hull.sources import examples
    >>> from assoc_hull.variation.parameters.parameter_measures import measure
    >>> found = measure(examples.series60(0.70), only=["breadth", "depth", "bossing_radius"])
    >>> {name: round(value, 3) for name, value in found.items()}
    {'breadth': 17.417, 'depth': 10.45}
    >>> found.absent["bossing_radius"]
    'parent has no bossing circle'
    """
    return measure_all(state_of(hull, "in measure"), only)
