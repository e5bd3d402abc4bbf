"""A form-parameter curve: made from its parameters, changed by its vertices, read back.

A curve has seven vertices and, just as many numbers, fourteen parameters: at both ends a point, an
angle, a curvature, a tangent length and a stretch; then area and centroid. Vertices follow from
parameters and parameters from vertices, so whoever drags one reads the other. Source: Kim & Kang,
"Ship Lines Creation by B-Spline Form Parameter Method", Trans. SNAK 29(2), 1992.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Mapping
from functools import cached_property
from types import MappingProxyType
from typing import Any, Literal, Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import all_of, choice, integer, number, numbers, positive, shown
from assoc_hull.errors import BadInputError, UnknownNameError, WrongTypeError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.form_curves.chain import FormChain
from assoc_hull.geometry.form_curves.checks import FormMessage, check_parameters, check_shape
from assoc_hull.geometry.form_curves.curve import (
    NAMES,
    FormEnd,
    FormParameters,
    end_vertices,
    form_values,
)
from assoc_hull.geometry.form_curves.integrals import (
    fair_vertex,
    form_integrals,
    middle_vertex,
    required_middle,
    slide_vertex,
    with_middle,
)
from assoc_hull.geometry.form_curves.shape import (
    ENERGIES,
    FASTEST,
    SLOWEST,
    chord_lengths,
    fairest_tangents,
    form_energy,
    form_inflections,
    form_length,
    usual_tangents,
)

__all__ = [
    "PARAMETER_NAMES",
    "CurveValues",
    "FormCurve",
    "Tangents",
    "check_angles",
    "check_kept",
    "check_named_parameters",
    "check_plane_point",
    "check_vertices",
    "curve_document",
    "curve_messages",
    "curve_table",
    "curve_values",
    "make_vertices",
]

# --------------------------------------------------------------------------------------
# Arguments checked, and made into vertices.

Tangents = Literal["default", "auto"] | tuple[float, float] | None
"""How tangent lengths are given."""

_WHERE = "in a form-parameter curve"
_LARGEST, _FARTHEST = 1e12, 1e6
"""Greatest area or other parameter; greatest coordinate."""

PARAMETER_NAMES = tuple(f"{n}_deg" if n.endswith("_angle") else n for n in NAMES)
"""Names of the parameters as they are typed: angles in degrees."""


def check_vertices(given: object) -> FloatArray:
    """Take seven vertices, (7, 2), as a new array without negative zeros."""
    try:
        found = np.array(given, np.float64)
    except (TypeError, ValueError, OverflowError):
        found = np.empty(0)
    if found.shape != (7, 2) or not (np.abs(found) <= _FARTHEST).all() or _holds_bools(given):
        what = f"the vertices are {shown(given)}"
        raise BadInputError(what, _WHERE, "give seven finite places (x, y)")
    return found + 0.0


def _holds_bools(given: object) -> bool:
    """Tell whether an array is of truth values, which numpy would take as 0 and 1."""
    return np.asarray(given).dtype == bool


def check_messages(given: Iterable[FormMessage]) -> tuple[FormMessage, ...]:
    """Take remarks about a curve."""
    return tuple(all_of(given, FormMessage, "notes", _WHERE))


def check_angles(given: tuple[float, float] | None) -> tuple[float, float] | None:
    """Take the angles of both ends, rad."""
    return None if given is None else check_plane_point(given, "angles")


def check_plane_point(given: object, name: str, where: str = _WHERE) -> tuple[float, float]:
    """Take a point (x, y)."""
    found = numbers(given, name, where)
    if found.shape != (2,):
        raise BadInputError(f"{name} is {shown(given)}", where, "give (x, y)")
    x, y = found.tolist()
    return x, y


def check_kept(given: object, vertex: int) -> set[str]:
    """Take what is to be kept while a vertex is dragged."""
    where = "in drag"
    if not isinstance(given, Collection) or isinstance(given, str | bytes):
        raise WrongTypeError(f"keep is {shown(given)}", where, 'give ("area", "centroid") or ()')
    kept = {choice(each, "an item of keep", ("area", "centroid"), where) for each in given}
    if kept == {"centroid"}:
        raise BadInputError("keep is the centroid alone", where, 'give ("area", "centroid")')
    if vertex == 3 and len(kept) == 2:
        what = "area and centroid are kept, and the middle vertex is where they put it"
        raise BadInputError(what, where, 'drag another vertex, or keep ("area",) or ()')
    return kept


def check_named_parameters(given: object) -> tuple[dict[str, Any], Tangents]:
    """Take parameters by name; tangents go apart."""
    if not isinstance(given, Mapping):
        raise WrongTypeError(f"the parameters are {shown(given)}", _WHERE, "give them by name")
    for name in given:
        if name not in PARAMETER_NAMES:
            raise UnknownNameError("parameter of a curve", str(name), PARAMETER_NAMES)
    values = dict(given)
    pair = [values.pop(f"{end}_tangent", None) for end in ("start", "finish")]
    if (pair[0] is None) != (pair[1] is None):
        raise BadInputError("one tangent is given, and the other is not", _WHERE, "give both")
    for name in PARAMETER_NAMES:
        if name not in values and ("curvature" in name or "stretch" in name):
            values[name] = 0.0
        values.setdefault(name, None)
    return values, None if pair[0] is None else (pair[0], pair[1])


def make_vertices(
    values: Mapping[str, Any], tangents: Tangents, energy: str
) -> tuple[FloatArray, tuple[FormMessage, ...], tuple[float, float]]:
    """Make the vertices, (7, 2), messages about making them, and the angles (rad) of both ends."""
    known = _checked(values)
    area, centroid = known.integrals()
    start, finish = known.ends()
    choice(energy, "energy", ENERGIES, _WHERE)
    pace, notes = _tangents(tangents, start, finish, (area, centroid), energy)
    start, finish = (
        FormEnd(e.x, e.y, e.angle, e.curvature, pace[:, k], e.stretch)
        for k, e in enumerate((start, finish))
    )
    ends = np.concatenate([end_vertices(start), end_vertices(finish)], axis=1)
    if np.isnan(area[0]):
        middle = fair_vertex(ends)
    else:
        middle = required_middle(ends, area, None if np.isnan(centroid[0]) else centroid)
    found = with_middle(ends, middle[:, 0], middle[:, 1])[0]
    if not (np.abs(found) <= _FARTHEST).all():
        what = f"these parameters put a vertex {np.abs(found).max():.3g} away"
        raise BadInputError(what, _WHERE, "give smaller curvatures, stretches or tangents")
    return found, notes, (known.start_angle, known.finish_angle)


def _checked(values: Mapping[str, Any]) -> FormParameters:
    """Check the numbers; tangents are given apart and stand as 1 here."""
    found = dict[str, float]()
    for name in PARAMETER_NAMES:
        if name.endswith("_tangent"):
            found[name] = 1.0
        elif name in ("area", "centroid") and values[name] is None:
            found[name] = math.nan
        elif name.endswith("_angle_deg"):
            found[name.removesuffix("_deg")] = math.radians(number(values[name], name, _WHERE))
        else:
            found[name] = _large(values[name], name)
    if math.isnan(found["area"]) and not math.isnan(found["centroid"]):
        raise BadInputError("a centroid is given without an area", _WHERE, "give the area as well")
    if found["area"] == 0.0 and not math.isnan(found["centroid"]):
        raise BadInputError("an area of 0 has no centroid", _WHERE, "leave the centroid out")
    return FormParameters(**found)


def _large(value: object, name: str) -> float:
    """Take a number: areas are squares of lengths, curvatures inverses of small ones."""
    if isinstance(value, int | float) and not isinstance(value, bool) and abs(value) <= _LARGEST:
        return float(value)
    return number(value, name, _WHERE)


def _tangents(
    given: Tangents,
    start: FormEnd,
    finish: FormEnd,
    integrals: tuple[FloatArray, FloatArray],
    energy: str,
) -> tuple[FloatArray, tuple[FormMessage, ...]]:
    """Give the tangent lengths, (1, 2), and what is to be said of them."""
    if (given is None or isinstance(given, str)) and not chord_lengths(start, finish)[0] > 0.0:
        remedy = "give ends that differ, or tangents"
        raise BadInputError("start and finish are one place", _WHERE, remedy)
    if given is None or (isinstance(given, str) and given == "default"):
        return usual_tangents(start, finish), ()
    if isinstance(given, str):
        choice(given, "tangents", ("default", "auto"), _WHERE)
        found = fairest_tangents(start, finish, *integrals, energy)
        if not np.isfinite(found.tangents).all():
            # No curve at any pace: that of the usual tangents has a reason to tell.
            return usual_tangents(start, finish), ()
        return found.tangents, tuple(_bounds(found.at_bound[0].tolist(), start, finish))
    pair = [positive(each, "a tangent", _WHERE) for each in check_plane_point(given, "tangents")]
    return np.array([pair]), ()


def _bounds(active: list[bool], start: FormEnd, finish: FormEnd) -> list[FormMessage]:
    """Say which tangent is held by a bound."""
    even = float(chord_lengths(start, finish)[0]) / 4.0
    return [
        FormMessage(
            "bound",
            "info",
            f"the tangent at the {end} is at a bound: from {SLOWEST * even:.6g} to "
            f"{FASTEST * even:.6g}; the fairest curve would have it beyond",
        )
        for end, held in zip(("start", "finish"), active, strict=True)
        if held
    ]


# --------------------------------------------------------------------------------------
# The curve.

_ENDS = [0, 1, 2, 4, 5, 6]
"""All vertices but the middle one."""


def _frozen(given: object) -> FloatArray:
    found = check_vertices(given)
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
        Of start and finish, as they are taken where a tangent is zero.

    Raises
    ------
    BadInputError
        No seven finite places.
    """

    vertices: FloatArray = attrs.field(converter=_frozen)
    notes: tuple[FormMessage, ...] = attrs.field(default=(), converter=check_messages)
    angles: tuple[float, float] | None = attrs.field(default=None, converter=check_angles)

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
            Area and centroid cannot both be had; the nearest centroid is named.
        DegenerateEndsError
            The area does not depend on the middle vertex.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> section = ah.creation.FormCurve.of(
        ...     (0.0, 0.0), (10.5, 8.0), start_angle_deg=62.0, finish_angle_deg=0.0,
        ...     area=60.0, centroid=6.4,
        ... )
        >>> round(section.centroid_height, 10), section.inflections
        (3.3237365694, ())
        """
        (x0, y0), (x1, y1) = check_plane_point(start, "start"), check_plane_point(finish, "finish")
        values = {
            "start_x": x0, "start_y": y0, "start_angle_deg": start_angle_deg,
            "start_curvature": start_curvature, "start_stretch": start_stretch,
            "finish_x": x1, "finish_y": y1, "finish_angle_deg": finish_angle_deg,
            "finish_curvature": finish_curvature, "finish_stretch": finish_stretch,
            "area": area, "centroid": centroid,
        }  # fmt: skip
        return cls(*make_vertices(values, tangents, energy))

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
        values, given = check_named_parameters(parameters)
        if tangents is not None:
            choice(tangents, "tangents", ("default", "auto"), "in a form-parameter curve")
        return cls(*make_vertices(values, given if tangents is None else tangents, energy))

    @cached_property
    def _values(self) -> CurveValues:
        return curve_values(self.vertices, self.angles)

    @cached_property
    def parameters(self) -> Mapping[str, float]:
        """The 14 parameters by name; angles in degrees.

        Where a tangent is zero its angle is the last one it had, and its curvature 0; where the
        area is zero, ``"moment"``, int x y dx, stands instead of ``"centroid"``. Messages say so.
        """
        return MappingProxyType(self._values.named)

    @cached_property
    def messages(self) -> tuple[FormMessage, ...]:
        """What is wrong with the curve, or worth knowing: how it was made, then errors first."""
        return (*self.notes, *curve_messages(self.vertices, self._values))

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
        """Int x y dx / area; nan where the area is zero."""
        return self._values.known.centroid

    @property
    def centroid_height(self) -> float:
        """1/2 int y^2 dx / area: the ordinate of the centroid; nan where the area is zero."""
        height = float(form_integrals(self.vertices[None]).moment_y[0])
        return height / self.area if not math.isnan(self.centroid) else math.nan

    @property
    def length(self) -> float:
        """The length of the curve, in the unit of the plane."""
        return float(form_length(self.vertices[None])[0])

    @property
    def inflections(self) -> tuple[float, ...]:
        """Where the curvature changes its sign: parameters t."""
        return form_inflections(self.vertices)

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
        return float(
            form_energy(self.vertices[None], choice(kind, "kind", ENERGIES, "in energy"))[0]
        )

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
            What is kept cannot be had.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> curve = ah.creation.FormCurve.of(
        ...     (0.0, 0.0), (4.0, 2.0), start_angle_deg=0.0, finish_angle_deg=45.0, area=3.5
        ... )
        >>> round(curve.drag(1, (0.1, 0.0), keep=("area",)).area, 12)
        3.5
        """
        index = integer(vertex, "vertex", "in drag", least=0, most=6)
        kept = check_kept(keep, index)
        moved = self.vertices.copy()
        moved[index] = check_plane_point(to, "to", "in drag")
        ends, area = moved[None, _ENDS], np.array([self.area])
        if kept == {"area", "centroid"}:
            moved[3] = required_middle(ends, area, np.array([self.centroid]))[0]
        elif kept == {"area"}:
            # For its refusals: no place on the line of equal area could be had.
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


# --------------------------------------------------------------------------------------
# The curve in numbers and words.

_ZERO = 1e-14
"""Part of the size of a curve: a smaller number is written as 0."""

_RANK = {"error": 0, "warning": 1, "info": 2}


@attrs.frozen
class CurveValues:
    """The parameters of a curve as they are shown, all of them numbers.

    Attributes
    ----------
    known : FormParameters
        Where a tangent is zero: with the angle it had last, and no curvature. Where the area is
        zero the centroid is nan.
    moment : float
        int x y dx.
    still : tuple of str
        Ends whose tangent is zero.
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
    """Read the parameters of a curve, (7, 2); angles (rad) are for ends whose tangent is zero."""
    if angles is None:
        # An end that never had an angle is taken to look along the chord.
        x, y = (vertices[4:] - vertices[:3]).T @ np.array([1.0, 4.0, 1.0])
        angles = (math.atan2(y, x),) * 2
    found = form_values(vertices[None], (np.array(angles[:1]), np.array(angles[1:])))
    known = FormParameters.of(found)
    still = tuple(e for e in ("start", "finish") if math.isnan(getattr(known, f"{e}_curvature")))
    known = attrs.evolve(known, **{f"{end}_curvature": 0.0 for end in still})
    return CurveValues(known, float(found.moment[0]), still)


def curve_messages(vertices: FloatArray, values: CurveValues) -> tuple[FormMessage, ...]:
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


def _further_numbers(curve: FormCurve) -> Mapping[str, float]:
    found = {"centroid_height": curve.centroid_height, "length": curve.length}
    return found | {kind: curve.energy(kind) for kind in ENERGIES}


def curve_table(curve: FormCurve) -> str:
    """Give vertices, parameters and messages in words."""
    lines = ["vertices"]
    lines += [f"  P{k} {x:18.12f} {y:18.12f}" for k, (x, y) in enumerate(curve.vertices + 0.0)]
    lines.append("parameters")
    size = max(1.0, float(np.abs(curve.vertices).max()))
    lines += [
        f"  {name:20} {value if abs(value) > _ZERO * size else 0.0:18.12g}"
        for name, value in curve.parameters.items()
    ]
    lines.append("besides")
    lines += [f"  {name:20} {value:18.12g}" for name, value in _further_numbers(curve).items()]
    lines.append("messages")
    lines += [f"  {message}" for message in curve.messages] or ["  none"]
    return "\n".join(lines)


def curve_document(curve: FormCurve) -> dict[str, Any]:
    """Give the same for JSON; numbers are not rounded."""
    return {
        "vertices": curve.vertices.tolist(),
        "parameters": dict(curve.parameters),
        **_further_numbers(curve),
        "inflections": list(curve.inflections),
        "messages": [attrs.asdict(each) for each in curve.messages],
    }
