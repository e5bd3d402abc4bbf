"""The 14 parameters of one form-parameter curve, by name, and how they go with their curve.

Examples
--------
>>> from assoc_hull.geometry.form_curves.parameters import FormParameters, NAMES
>>> len(NAMES)
14
>>> curve = FormParameters(0.0, 1.0, 0.0, 0.0, 0.25, 0.0, 1.0, 0.0, -1.5, 0.0, 0.25, 0.0, 0.5, 0.4)
>>> curve.rising.start_x, curve.rising.finish_y, curve.rising.start_angle
(-1.0, 1.0, 1.5)
"""

from __future__ import annotations

from typing import Self

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.curve import FormEnd
from assoc_hull.geometry.form_curves.inverse import FormValues

__all__ = ["NAMES", "FormParameters"]


@attrs.frozen
class FormParameters:
    """The parameters of one curve.

    Attributes
    ----------
    start_x, start_y, finish_x, finish_y : float
        The ends, in the unit of the plane.
    start_angle, finish_angle : float, rad
        Of the tangent, from the positive abscissa to the left.
    start_curvature, finish_curvature : float, 1/unit
        Positive where the curve turns left as t rises.
    start_tangent, finish_tangent : float, unit
        Lengths of the derivative by t, which runs from 0 to 4.
    start_stretch, finish_stretch : float, unit
        Components of the second derivative along the tangent.
    area : float
        int y dx; nan if it is as it comes out.
    centroid : float
        int x y dx / area; nan if it is as it comes out, or if there is no area.
    """

    start_x: float
    start_y: float
    start_angle: float
    start_curvature: float
    start_tangent: float
    start_stretch: float
    finish_x: float
    finish_y: float
    finish_angle: float
    finish_curvature: float
    finish_tangent: float
    finish_stretch: float
    area: float = float("nan")
    centroid: float = float("nan")

    @classmethod
    def of(cls, values: FormValues, row: int = 0) -> Self:
        """Take those of one curve of a batch."""
        found = [
            getattr(end, name)[row]
            for end in (values.start, values.finish)
            for name in ("x", "y", "angle", "curvature", "tangent", "stretch")
        ]
        return cls(*(float(each) for each in (*found, values.area[row], values.centroid[row])))

    def ends(self) -> tuple[FormEnd, FormEnd]:
        """Give both ends, as a batch of one curve."""
        start = (self.start_x, self.start_y, self.start_angle, self.start_curvature)
        finish = (self.finish_x, self.finish_y, self.finish_angle, self.finish_curvature)
        return (
            FormEnd.of(*start, self.start_tangent, self.start_stretch),
            FormEnd.of(*finish, self.finish_tangent, self.finish_stretch),
        )

    def integrals(self) -> tuple[FloatArray, FloatArray]:
        """Give area and centroid, as those of a batch of one curve."""
        return np.array([self.area]), np.array([self.centroid])

    def mirrored(self) -> FormParameters:
        """Give those of the curve mirrored at x = 0 and run backward; curvatures keep their sign.

        A falling curve becomes a rising one.
        """
        return FormParameters(
            -self.finish_x, self.finish_y, -self.finish_angle, self.finish_curvature,
            self.finish_tangent, -self.finish_stretch, -self.start_x, self.start_y,
            -self.start_angle, self.start_curvature, self.start_tangent, -self.start_stretch,
            self.area, -self.centroid,
        )  # fmt: skip

    @property
    def rising(self) -> FormParameters:
        """These, or those mirrored if the curve ends lower than it starts."""
        return self.mirrored() if self.finish_y < self.start_y else self


NAMES = tuple(field.name for field in attrs.fields(FormParameters))
"""In their order."""
