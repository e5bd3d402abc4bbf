"""What of a hull changes with what: a table of derivatives of outputs by parameters."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.measured_hull import HasState, state_of
from assoc_hull.variation.aiming.outputs import Outputs
from assoc_hull.variation.hull_moves import HullMoves
from assoc_hull.variation.parameters.layout import Layout
from assoc_hull.variation.sensitivity_table import Sensitivities

__all__ = ["USUAL_OUTPUTS", "sensitivities"]

_WHERE = "in sensitivities"

USUAL_OUTPUTS = ("volume", "lcb", "kb", "kmt", "cb", "cp", "cm", "cw", "wetted_surface")
"""What is differentiated if nothing is named."""


def sensitivities(
    hull: HasState,
    outputs: Iterable[str] | None = None,
    parameters: Iterable[object] | None = None,
    *,
    kg: float | None = None,
    layout: Mapping[str, Any] | Layout | None = None,
) -> Sensitivities:
    """Differentiate outputs of a hull by parameters of its shape and position.

    The hull floats upright at its design draught, the new one where a parameter changes that.

    Parameters
    ----------
    hull : Hull
        The hull.
    outputs : iterable of m str or None
        Fields of the record of hydrostatics ("volume", "lcb"), symbols of form parameters
        ("Cpa"), section areas ("A ST 5", "A x=42.5"); None: `USUAL_OUTPUTS`.
    parameters : iterable of k or None
        Each the name of a parameter that `vary` knows ("breadth", m or degrees),
        "mean_draught" or "trim" (m), a raw layer (by its strength), or one of
        `assoc_hull.analysis.derivatives.parameters` such as a `PointMove`; None: all that `vary`
        knows and this hull has.
    kg : float or None, m
        Centre of gravity above the base line, for metacentric heights.
    layout : mapping or Layout or None
        How far the fields of named parameters reach, as for `vary`.

    Returns
    -------
    Sensitivities
        The table. A named parameter changes alone, as in `vary` with it alone: lines, dimensions
        and features go along, other parameters may change with it.

    Raises
    ------
    UnknownNameError
        No such output or parameter, with the nearest names.
    BadInputError
        The hull lacks one; a name that stands twice; a hull that is doubtful.
    WrongTypeError, OutOfRangeError
        What is no parameter; a hull that does not float at its design draught.

    Examples
    --------
    >>> from assoc_hull.sources import examples
    >>> from assoc_hull.variation.sensitivities import sensitivities
    >>> found = sensitivities(examples.wigley(), ["volume", "cb"], ["breadth", "mean_draught"])
    >>> print(found)
                  per   volume           cb
                            m3            -
    now                2777.45     0.444392
    breadth         m  277.747  2.97793e-07
    mean_draught    m  666.625    0.0355574
    """
    state = state_of(hull, _WHERE)
    wanted = Outputs.of(state, USUAL_OUTPUTS if outputs is None else outputs, kg=kg)
    reach = attrs.asdict(layout) if isinstance(layout, Layout) else layout
    known = HullMoves(state, Layout.of(reach))
    taken, absent = known.every() if parameters is None else (known.chosen(parameters), {})
    found = wanted.differentiated(state, [each.parameter for each in taken])
    return Sensitivities(
        state.particulars.name, wanted.names, wanted.units, found.values,
        tuple(each.name for each in taken), tuple(each.parameter.per or "-" for each in taken),
        found.jacobian, np.array([each.usual for each in taken], np.float64), found.exact, absent,
    )  # fmt: skip
