"""A form-parameter curve: made from its parameters, changed by its vertices, read back.

A curve has seven vertices and, just as many numbers, fourteen parameters: at both ends a point,
an angle, a curvature, a tangent length and a stretch; then area and centroid. Vertices follow from
parameters and parameters from vertices, so whoever drags one reads the other.

Kim & Kang, "Ship Lines Creation by B-Spline Form Parameter Method", Trans. SNAK 29(2), 1992.

Examples
--------
>>> import assoc_hull as ah
>>> run = ah.FormCurve.of(
...     (-1.0, 0.0), (-0.3, 1.0), start_angle_deg=60.0, start_curvature=-2.0,
...     finish_angle_deg=0.0, area=0.55, centroid=-0.59,
... )
>>> run.vertices[3].round(9).tolist()
[-0.92217359, 0.787861836]
>>> fuller = run.drag(3, (-0.92, 0.85))
>>> [name for name, value in fuller.parameters.items() if abs(value - run.parameters[name]) > 1e-9]
['area', 'centroid']
>>> [message.code for message in run.messages]
['inflections', 'C6']
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from functools import cached_property
from types import MappingProxyType
from typing import Any, Literal, Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import choice, integer, numbers, positive
from assoc_hull.creation.form_curve_input import (
    Tangents,
    angles_of,
    kept_of,
    made,
    notes_of,
    parameters_of,
    plane_place,
    vertices_of,
)
from assoc_hull.creation.form_curve_report import (
    CurveValues,
    curve_document,
    curve_table,
    curve_values,
    remarks,
)
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.form_curves.chain import FormChain
from assoc_hull.geometry.form_curves.checks import FormMessage
from assoc_hull.geometry.form_curves.integrals import form_integrals
from assoc_hull.geometry.form_curves.middle import middle_vertex, slide_vertex
from assoc_hull.geometry.form_curves.shape import ENERGIES, energy, form_length, inflections
from assoc_hull.geometry.form_curves.solve import required_middle

__all__ = ["FormCurve"]

_ENDS = [0, 1, 2, 4, 5, 6]


def _frozen(given: object) -> FloatArray:
    found = vertices_of(given)
    freeze(found)
    return found


@attrs.frozen(eq=False, slots=False)
class FormCurve:
    """A form-parameter curve in a plane.

    Attributes
    ----------
    vertices : (7, 2)
        Of a uniform cubic B-spline, t from 0 to 4: abscissa and ordinate, in one unit, which may
        be none. The curve does not pass through the first and the last.
    notes : tuple of FormMessage
        What is to be said of the making of the curve.
    angles : (float, float), rad
        Of start and finish, as they are taken where a tangent is nil.

    Raises
    ------
    BadInputError
        No seven finite places.
    """

    vertices: FloatArray = attrs.field(converter=_frozen)
    notes: tuple[FormMessage, ...] = attrs.field(default=(), converter=notes_of)
    angles: tuple[float, float] | None = attrs.field(default=None, converter=angles_of)

    @classmethod
    def of(
        cls,
        start: ArrayLike,
        finish: ArrayLike,
        *,
        start_angle_deg: float,
        finish_angle_deg: float,
        start_curvature: float = 0.0,
        finish_curvature: float = 0.0,
        area: float | None = None,
        centroid: float | None = None,
        tangents: Tangents = "default",
        start_stretch: float = 0.0,
        finish_stretch: float = 0.0,
        energy: Literal["E2", "E3", "J"] = "E3",
    ) -> Self:
        """Make a curve from its parameters.

        Parameters
        ----------
        start, finish : (float, float)
            The ends: abscissa and ordinate.
        start_angle_deg, finish_angle_deg : float, deg
            Of the tangent, from the positive abscissa to the left, along the curve.
        start_curvature, finish_curvature : float, 1/unit
            Positive where the curve turns left.
        area : float, optional
            int y dx; as it comes out fairest if it is not given.
        centroid : float, optional
            int x y dx / area; as it comes out fairest with this area if it is not given.
        tangents : "default", "auto", or (float, float)
            Lengths of the derivative by t at both ends, in the unit of the plane: an eighth of
            the chord; those of the fairest curve; or given, above 0.
        start_stretch, finish_stretch : float, unit
            Components of the second derivative along the tangent.
        energy : "E3", "E2" or "J"
            What is least for ``"auto"``: int |Q'''|^2 dt, int |Q''|^2 dt, or length times int
            curvature^2 ds.

        Raises
        ------
        BadInputError
            An argument that is no number or no place; ends that coincide; a centroid without
            an area.
        NoMiddleVertexError
            Area and centroid cannot both be met; the nearest centroid is named.
        DegenerateEndsError
            The area does not depend on the middle vertex.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> section = ah.FormCurve.of(
        ...     (0.0, 0.0), (10.5, 8.0), start_angle_deg=62.0, finish_angle_deg=0.0,
        ...     area=60.0, centroid=6.4,
        ... )
        >>> round(section.centroid_height, 10), section.inflections
        (3.3237365694, ())
        """
        (x0, y0), (x1, y1) = plane_place(start, "start"), plane_place(finish, "finish")
        values = {
            "start_x": x0, "start_y": y0, "start_angle_deg": start_angle_deg,
            "start_curvature": start_curvature, "start_stretch": start_stretch,
            "finish_x": x1, "finish_y": y1, "finish_angle_deg": finish_angle_deg,
            "finish_curvature": finish_curvature, "finish_stretch": finish_stretch,
            "area": area, "centroid": centroid,
        }  # fmt: skip
        return cls(*made(values, tangents, energy))

    @classmethod
    def from_parameters(
        cls,
        parameters: Mapping[str, float | None],
        *,
        tangents: Literal["default", "auto"] | None = None,
        energy: Literal["E2", "E3", "J"] = "E3",
    ) -> Self:
        """Make a curve from parameters by name, as `parameters` gives them.

        Parameters
        ----------
        parameters : mapping of str to float or None
            Curvatures and stretches that are left out are 0; tangents that are left out are an
            eighth of the chord; area and centroid are as in `of`.
        tangents : "default" or "auto", optional
            As in `of`, whatever the tangents among the parameters.
        energy : "E3", "E2" or "J"
            As in `of`.

        Raises
        ------
        UnknownNameError
            A name that is none of the 14.
        BadInputError, NoMiddleVertexError, DegenerateEndsError
            As `of`.
        """
        values, given = parameters_of(parameters)
        if tangents is not None:
            choice(tangents, "tangents", ("default", "auto"), "in a form-parameter curve")
        return cls(*made(values, given if tangents is None else tangents, energy))

    @cached_property
    def _values(self) -> CurveValues:
        return curve_values(self.vertices, self.angles)

    @cached_property
    def parameters(self) -> Mapping[str, float]:
        """The 14 parameters by name; angles in degrees.

        Where a tangent is nil its angle is the last one it had, and its curvature 0; where the
        area is nil, ``"moment"``, int x y dx, stands instead of ``"centroid"``. Messages say so.
        """
        return MappingProxyType(self._values.named)

    @cached_property
    def messages(self) -> tuple[FormMessage, ...]:
        """What is wrong with the curve, or worth knowing: how it was made, then errors first."""
        return (*self.notes, *remarks(self.vertices, self._values))

    def at(self, t: ArrayLike) -> FloatArray:
        """Give points: (2,) at one parameter in [0, 4], (k, 2) at k."""
        return self._asked(t, "at", lambda chain, each: chain.at(0, each))

    def curvature(self, t: ArrayLike) -> FloatArray:
        """Give signed curvatures, 1/unit, at one parameter in [0, 4], or at k: (k,)."""
        return self._asked(t, "curvature", lambda chain, each: chain.bend(0, each))

    def _asked(self, t: ArrayLike, where: str, ask: Any) -> FloatArray:
        at = numbers(t, "t", f"in {where}")
        if not ((at >= 0.0) & (at <= 4.0)).all():
            raise BadInputError(f"t is {t!r}", f"in {where}", "give parameters from 0 to 4")
        found: FloatArray = ask(FormChain(self.vertices[None]), at)
        return np.asarray(found[0] if np.ndim(t) == 0 else found)

    @property
    def area(self) -> float:
        """Int y dx."""
        return self._values.known.area

    @property
    def centroid(self) -> float:
        """Int x y dx / area; nan where the area is nil."""
        return self._values.known.centroid

    @property
    def centroid_height(self) -> float:
        """1/2 int y^2 dx / area: the ordinate of the centroid; nan where the area is nil."""
        height = float(form_integrals(self.vertices[None]).moment_y[0])
        return height / self.area if not math.isnan(self.centroid) else math.nan

    @property
    def length(self) -> float:
        """The length of the curve, in the unit of the plane."""
        return float(form_length(self.vertices[None])[0])

    @property
    def inflections(self) -> tuple[float, ...]:
        """Where the curvature changes its sign: parameters t."""
        return inflections(self.vertices)

    @property
    def other_middle(self) -> tuple[float, float] | None:
        """The other middle vertex with the same area and centroid; None if there is one only.

        It lies far away as a rule, and is no curve that one would want.
        """
        ends, size = self.vertices[None, _ENDS], np.array([self.area])
        found = middle_vertex(ends, size, np.array([self.centroid]), other=True)[0]
        x, y = (float(each) for each in found[0])
        return (x, y) if math.isfinite(x) and math.isfinite(y) else None

    def energy(self, kind: Literal["E2", "E3", "J"] = "E3") -> float:
        """Give int |Q''|^2 dt (E2), int |Q'''|^2 dt (E3), or length times int curvature^2 ds (J).

        Raises
        ------
        BadInputError
            Another kind.
        """
        return float(energy(self.vertices[None], choice(kind, "kind", ENERGIES, "in energy"))[0])

    def drag(self, vertex: int, to: ArrayLike, keep: Collection[str] = ()) -> FormCurve:
        """Give the curve with one vertex moved.

        Parameters
        ----------
        vertex : int
            From 0 to 6. The middle one, 3, changes area and centroid only; the others change
            the parameters of their end, too.
        to : (float, float)
            Where it goes.
        keep : collection of str
            ``("area", "centroid")``: the middle vertex moves so that both stay. ``("area",)``:
            it moves as little as that needs; if it is dragged itself, it goes along the line of
            equal area to the place nearest to `to`.

        Raises
        ------
        BadInputError
            No such vertex, no place, a centroid kept without the area, or the middle vertex
            dragged while both are kept.
        NoMiddleVertexError, DegenerateEndsError
            What is kept cannot be met.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> curve = ah.FormCurve.of(
        ...     (0.0, 0.0), (4.0, 2.0), start_angle_deg=0.0, finish_angle_deg=45.0, area=3.5
        ... )
        >>> round(curve.drag(1, (0.1, 0.0), keep=("area",)).area, 12)
        3.5
        """
        number_ = integer(vertex, "vertex", "in drag", least=0, most=6)
        kept = kept_of(keep, number_)
        moved = self.vertices.copy()
        moved[number_] = plane_place(to, "to", "in drag")
        ends, area = moved[None, _ENDS], np.array([self.area])
        if kept == {"area", "centroid"}:
            moved[3] = required_middle(ends, area, np.array([self.centroid]))[0]
        elif kept == {"area"}:
            required_middle(ends, area)
            moved[3] = slide_vertex(ends, moved[None, 3], area)[0]
        known = self._values.known
        return FormCurve(moved, (), (known.start_angle, known.finish_angle))

    def scaled(self, a: float, b: float) -> FormCurve:
        """Give the curve with abscissae times `a` and ordinates times `b`, both above 0.

        Angles, curvatures and tangents become those of the stretched curve.

        Raises
        ------
        BadInputError
            A factor that is not above 0.
        """
        factors = [positive(each, name, "in scaled") for each, name in ((a, "a"), (b, "b"))]
        return FormCurve(self.vertices * np.array(factors))

    def mirrored(self) -> FormCurve:
        """Give the curve mirrored at x = 0 and run backward, so that it goes forward again."""
        return FormCurve(self.vertices[::-1] * np.array([-1.0, 1.0]))

    def table(self) -> str:
        """Give vertices, parameters and messages in words."""
        return curve_table(self)

    def document(self) -> dict[str, Any]:
        """Give the same for JSON; numbers are not rounded."""
        return curve_document(self)
