"""The two halves of a curve of sectional areas or of a waterline, in the frame of the ship.

Abscissae run from -1 at AP to 1 at FP, the ordinate 1 is that of the whole section or half-breadth.

Examples
--------
>>> from assoc_hull.model.forms.definition import FormDefinition
>>> from assoc_hull.model.forms.halves import half_sums
>>> values = {
...     "full": 10.0, "run_start": -1.0, "run_start_ordinate": 0.0, "run_start_angle_deg": 60.0,
...     "run_start_curvature": -2.0, "run_end": -0.3, "run_area": 0.55, "run_centroid": -0.59,
...     "top": 1.0, "entrance_start": 0.2, "entrance_end": 1.0, "entrance_end_angle_deg": -50.0,
... }
>>> half_sums(FormDefinition("areas", "sectional_area", "halves", values))
(0.55, -0.59)
"""

from __future__ import annotations

import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curve import FormEnd, form_integrals, form_vertices
from assoc_hull.model.forms.definition import FormDefinition

__all__ = ["half_number", "half_sums", "half_vertices"]

_NIL = {
    "run_start_curvature", "run_end_angle_deg", "run_end_curvature", "run_start_ordinate",
    "entrance_start_angle_deg", "entrance_start_curvature", "entrance_end_curvature",
    "entrance_end_ordinate",
}  # fmt: skip
"""Values that are 0 where they are not given."""

_ENDS = {
    "run": (("run_start", "run_start_ordinate"), ("run_end", "top")),
    "entrance": (("entrance_start", "top"), ("entrance_end", "entrance_end_ordinate")),
}
"""Of each half: abscissa and ordinate of its start and of its end."""


def half_number(definition: FormDefinition, name: str) -> float:
    """Give a value that must be there, or 0 where that is what nothing means."""
    found = definition.value(name)
    if found is not None:
        return found
    if name in _NIL:
        return 0.0
    raise BadInputError(
        f"{name} is not given", f"in the definition {definition.name!r}", "give a number"
    )


def half_vertices(definition: FormDefinition, half: str) -> FloatArray:
    """Give the seven vertices of the ``"run"`` or the ``"entrance"``, (1, 7, 2).

    What of area and centroid is not given comes out fairest; a tangent that is not given has an
    eighth of the chord. The middle vertex is nan where area and centroid cannot both be met.
    """
    places = [[half_number(definition, name) for name in pair] for pair in _ENDS[half]]
    chord = float(np.hypot(places[1][0] - places[0][0], places[1][1] - places[0][1]))
    ends = [
        FormEnd.of(
            x, y, np.radians(half_number(definition, f"{half}_{end}_angle_deg")),
            half_number(definition, f"{half}_{end}_curvature"),
            _tangent(definition, f"{half}_{end}_tangent", chord),
        )
        for (x, y), end in zip(places, ("start", "end"), strict=True)
    ]  # fmt: skip
    area, centroid = (definition.value(f"{half}_{name}") for name in ("area", "centroid"))
    return form_vertices(
        ends[0], ends[1],
        np.array([np.nan if area is None else area]),
        np.array([np.nan if area is None or centroid is None else centroid]),
    )  # fmt: skip


def _tangent(definition: FormDefinition, name: str, chord: float) -> float:
    found = definition.value(name)
    return chord / 8.0 if found is None else found


def half_sums(definition: FormDefinition, half: str = "run") -> tuple[float, float]:
    """Give area and centroid of a half: those given, or else as they come out fairest."""
    given = [definition.value(f"{half}_{name}") for name in ("area", "centroid")]
    if given[0] is not None and given[1] is not None:
        return given[0], given[1]
    found = form_integrals(half_vertices(definition, half))
    area = float(found.area[0])
    return area, float(found.moment[0]) / area
