"""From a definition to its curve in the units of the ship.

Examples
--------
>>> from assoc_hull.model.forms.chains import chain_of
>>> from assoc_hull.model.definition_part import FormDefinition
>>> from assoc_hull.model.state import Particulars
>>> areas = FormDefinition("areas", "sectional_area", "halves", values={
...     "full": 292.59, "run_start_angle_deg": 60.0, "run_start_curvature": -2.0,
...     "run_end": -0.3, "run_area": 0.55, "run_centroid": -0.59, "entrance_start": 0.2,
...     "entrance_area": 0.6, "entrance_centroid": 0.52, "entrance_end_angle_deg": -50.0,
...     "entrance_end_curvature": -2.0,
... })
>>> chain = chain_of(areas, Particulars("ship", 180.0, 28.0, 15.5, 10.5))
>>> round(chain.area() / 180.0 / 292.59, 12)  # the prismatic coefficient
0.825
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.form_curves.chain import FormChain
from assoc_hull.geometry.form_curves.extremes import least_rate
from assoc_hull.model.definition_part import FormDefinition
from assoc_hull.model.forms.courses import course_vertices
from assoc_hull.model.forms.halves import halves_vertices
from assoc_hull.model.state import Particulars

__all__ = ["chain_of"]

_SLACK = 1e-9
"""So far (m in t) a course may run backward: rounding."""


def chain_of(definition: FormDefinition, particulars: Particulars) -> FormChain:
    """Give the curve of a definition in the units of the ship.

    Parameters
    ----------
    definition : FormDefinition
        Any.
    particulars : Particulars
        Of its hull.

    Returns
    -------
    FormChain
        Over x, m from AP; the ordinate is that of the use: m2, m, degrees, 1/m.

    Raises
    ------
    OutOfRangeError
        A value between ends that do not admit it, with the interval that they do admit.
    BadInputError
        A value that is missing, a curve that folds back.
    """
    return _chain(definition, particulars.length)


@lru_cache(maxsize=4096)
def _chain(definition: FormDefinition, length: float) -> FormChain:
    where = f"in the definition {definition.name!r}"
    if definition.kind == "halves":
        return _in_the_ship(definition, length, where)
    vertices = course_vertices(definition)
    if definition.use != "profile":
        _forward(definition, vertices, where)
    return FormChain(vertices)


def _in_the_ship(definition: FormDefinition, length: float, where: str) -> FormChain:
    full = definition.value("full")
    if full is None or not full > 0.0:
        raise BadInputError(f"full is {full}", where, "give a number above 0")
    vertices = halves_vertices(definition)
    scaled = np.stack([(vertices[..., 0] + 1.0) * (0.5 * length), vertices[..., 1] * full], axis=-1)
    return FormChain(scaled)


def _forward(
    definition: FormDefinition, vertices: np.typing.NDArray[np.float64], where: str
) -> None:
    """Refuse a course with two ordinates at one abscissa."""
    for piece in np.flatnonzero(least_rate(vertices, 0) < -_SLACK).tolist():
        one, two = definition.nodes[piece : piece + 2]
        raise BadInputError(
            f"the course folds back between {one!r} and {two!r}: two ordinates at one x", where,
            "give the nodes by rising x, other angles, or shorter tangents",
        )  # fmt: skip
