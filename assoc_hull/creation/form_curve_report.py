"""A form-parameter curve in numbers and words: its parameters by name, and what is to be said."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.checks import FormMessage, check_parameters, check_shape
from assoc_hull.geometry.form_curves.inverse import form_values
from assoc_hull.geometry.form_curves.parameters import FormParameters
from assoc_hull.geometry.form_curves.shape import ENERGIES

if TYPE_CHECKING:
    from assoc_hull.creation.form_curve import FormCurve

__all__ = ["CurveValues", "curve_document", "curve_table", "curve_values", "remarks"]

_NIL = 1e-14
"""Of the size of a curve: a smaller number is written as 0."""
_RANK = {"error": 0, "warning": 1, "info": 2}


@attrs.frozen
class CurveValues:
    """The parameters of a curve as they are shown, all of them numbers.

    Attributes
    ----------
    known : FormParameters
        Where a tangent is nil: with the angle it had last, and no curvature. Where the area is
        nil the centroid is nan.
    moment : float
        int x y dx.
    still : tuple of str
        Ends whose tangent is nil.
    """

    known: FormParameters
    moment: float
    still: tuple[str, ...]

    @property
    def named(self) -> dict[str, float]:
        """The 14 parameters, angles in degrees; the moment if there is no centroid."""
        found = dict[str, float]()
        for name, value in attrs.asdict(self.known).items():
            if name.endswith("_angle"):
                found[f"{name}_deg"] = math.degrees(value) + 0.0
            elif math.isnan(value):
                found["moment"] = self.moment
            else:
                found[name] = value + 0.0
        return found


def curve_values(vertices: FloatArray, angles: tuple[float, float] | None) -> CurveValues:
    """Read the parameters of a curve, (7, 2); angles (rad) are for ends whose tangent is nil."""
    if angles is None:
        # An end that never had an angle is taken to look along the chord.
        x, y = (vertices[4:] - vertices[:3]).T @ np.array([1.0, 4.0, 1.0])
        angles = (math.atan2(y, x),) * 2
    found = form_values(vertices[None], (np.array(angles[:1]), np.array(angles[1:])))
    known = FormParameters.of(found)
    still = tuple(e for e in ("start", "finish") if math.isnan(getattr(known, f"{e}_curvature")))
    known = attrs.evolve(known, **{f"{end}_curvature": 0.0 for end in still})
    return CurveValues(known, float(found.moment[0]), still)


def remarks(vertices: FloatArray, values: CurveValues) -> tuple[FormMessage, ...]:
    """Look at a curve and its parameters; errors come first."""
    found = [*_singular(values), *check_parameters(values.known), *check_shape(vertices)]
    return tuple(sorted(found, key=lambda each: _RANK[each.severity]))


def _singular(values: CurveValues) -> Iterator[FormMessage]:
    """Say where parameters have no meaning."""
    for end in values.still:
        text = (
            f"the tangent at the {end} is nil: its angle is kept at "
            f"{values.named[f'{end}_angle_deg']:.6g} deg, its curvature has no meaning, and these "
            "parameters do not give the curve again"
        )
        yield FormMessage("tangent", "warning", text)
    if math.isnan(values.known.centroid):
        text = "the area is nil and has no centroid: the moment is given instead"
        yield FormMessage("area", "warning", text)


def _besides(curve: FormCurve) -> Mapping[str, float]:
    found = {"centroid_height": curve.centroid_height, "length": curve.length}
    return found | {kind: curve.energy(kind) for kind in ENERGIES}


def curve_table(curve: FormCurve) -> str:
    """Give vertices, parameters and messages in words."""
    lines = ["vertices"]
    lines += [f"  P{k} {x:18.12f} {y:18.12f}" for k, (x, y) in enumerate(curve.vertices + 0.0)]
    lines.append("parameters")
    size = max(1.0, float(np.abs(curve.vertices).max()))
    lines += [
        f"  {name:20} {value if abs(value) > _NIL * size else 0.0:18.12g}"
        for name, value in curve.parameters.items()
    ]
    lines.append("besides")
    lines += [f"  {name:20} {value:18.12g}" for name, value in _besides(curve).items()]
    lines.append("messages")
    lines += [f"  {message}" for message in curve.messages] or ["  none"]
    return "\n".join(lines)


def curve_document(curve: FormCurve) -> dict[str, Any]:
    """Give the same for JSON; numbers are not rounded."""
    return {
        "vertices": curve.vertices.tolist(),
        "parameters": dict(curve.parameters),
        **_besides(curve),
        "inflections": list(curve.inflections),
        "messages": [attrs.asdict(each) for each in curve.messages],
    }
