"""Definitions by form parameters: what they are used for, and the values they hold.

A definition is a plain value that a hull holds in its tables, but no line: a curve of sectional
areas does not lie in space. Sections, profile and deck edge read it where they stand. A
*generated* curve is one whose points, except its ends, are computed from definitions; once a
designer has edited it, it is *detached*. Nothing is computed here: see `assoc_hull.model.forms`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import TypedDict, Unpack

import attrs

from assoc_hull.arguments import all_of, choice, instance, number, text
from assoc_hull.errors import BadInputError, UnknownNameError

__all__ = [
    "FORM_KINDS",
    "GENERATED",
    "HALVES",
    "NODE_FIELDS",
    "ON_FLATS",
    "RULES",
    "USES",
    "FormDefinition",
    "GeneratedCurve",
    "Mark",
    "Use",
]

# --------------------------------------------------------------------------------------
# Uses. A generated curve reads these definitions where it stands, and nothing else: that is what
# the graph of dependencies holds.


@attrs.frozen
class Use:
    """What a definition may be used for; each use stands at most once in a hull.

    Attributes
    ----------
    kind : str
        Of what kind the definition is.
    unit : str
        Of its ordinate.
    what : str
        What it gives.
    needed : bool
        Whether sections cannot be made without it.
    held : bool
        Whether its first and last ordinates hold beyond its ends, too.
    """

    kind: str
    unit: str
    what: str
    needed: bool = False
    held: bool = False


USES: Mapping[str, Use] = MappingProxyType(
    {
        "sectional_area": Use("halves", "m2", "area of the whole section below the draught", True),
        "design_waterline": Use("halves", "m", "half-breadth at the draught", True),
        "profile": Use("course", "m", "contour in the centre plane, x and z", True),
        "deck_side": Use("course", "m", "half-breadth of the deck edge", True),
        "deck_height": Use("course", "m", "z of the deck edge", True),
        "deck_centre": Use("course", "m", "z of the deck in the centre plane"),
        "flat_of_side": Use("course", "m", "z of the lower border of the flat of side"),
        "flat_of_bottom": Use("course", "m", "half-breadth of the flat of bottom"),
        "bilge_radius": Use(
            "course", "m", "radius of the bilge in the parallel middle body", held=True
        ),
        "half_siding": Use("course", "m", "half-breadth at the contour"),
        "centroid": Use("course", "m", "z of the centroid of the section below the draught"),
        "keel_angle": Use("course", "deg", "angle at the contour, 0 upright, 90 level", held=True),
        "keel_curvature": Use("course", "1/m", "curvature at the contour", held=True),
        "keel_tangent": Use(
            "course", "", "tangent at the contour, in quarters of the chord", held=True
        ),
        "waterline_angle": Use(
            "course", "deg", "angle (flare) at the draught, 0 upright", held=True
        ),
        "waterline_curvature": Use(
            "course", "1/m", "curvature at the draught, or where the flat of side begins", held=True
        ),
        "waterline_tangent": Use(
            "course", "", "tangent at the draught, in quarters of the chord", held=True
        ),
        "deck_angle": Use("course", "deg", "angle (flare) at the deck edge, 0 upright", held=True),
        "deck_curvature": Use("course", "1/m", "curvature at the deck edge", held=True),
        "bulb_area": Use(
            "course", "m2", "area of the whole section up to the neck, or of the bulb"
        ),
        "bulb_height": Use("course", "m", "z of the neck, or of the bulb's top ahead of the stem"),
        "bulb_neck": Use("course", "m", "half-breadth of the neck"),
        "bulb_neck_angle": Use("course", "deg", "angle of the section at the neck", held=True),
    }
)
"""By use: what the definition gives. Angles and abscissae of sections are those of a graph of the
half-breadth over the height: z is its abscissa."""


# --------------------------------------------------------------------------------------
# Definitions and generated curves.

FORM_KINDS = ("halves", "course")
"""Halves: a run, a parallel part and an entrance, in the frame of the ship. Course: nodes that are
joined by pieces, in natural units."""

HALVES = (
    "full",
    "run_start", "run_start_ordinate", "run_start_angle_deg", "run_start_curvature",
    "run_start_tangent", "run_end", "run_end_angle_deg", "run_end_curvature", "run_end_tangent",
    "run_area", "run_centroid", "top",
    "entrance_start", "entrance_start_angle_deg", "entrance_start_curvature",
    "entrance_start_tangent", "entrance_end", "entrance_end_ordinate", "entrance_end_angle_deg",
    "entrance_end_curvature", "entrance_end_tangent", "entrance_area", "entrance_centroid",
)  # fmt: skip
"""The values of a curve of two halves. ``full`` is what the ordinate 1 stands for (m2 of the
midship section, m of the half-breadth); abscissae run from -1 at AP to 1 at FP. Area and centroid
may be None: then they come out fairest; a tangent length that is None is an eighth of the chord."""

NODE_FIELDS = (
    "x", "y", "angle_deg", "curvature", "tangent", "leave_angle_deg", "leave_curvature",
    "leave_tangent",
)  # fmt: skip
"""The values of a node of a course: ``LABEL_x`` and so on. x in m from AP; y in m, degrees or 1/m,
whichever it is a curve of. An angle (degrees, from +x to +y of the course's plane, along the
course) may be None: the rule then gives it. ``leave_...`` are set where the course turns a corner.
``tangent`` is a factor of a quarter of the chord; None is 1."""

RULES = ("straight", "monotone", "spline", "form")
"""How the pieces of a course run where nothing is given: straight; as a cubic without overshoot
(Fritsch & Carlson 1980); as cubics whose second derivatives are continuous; as a form-parameter
curve of least int |Q'''|^2 dt."""

GENERATED = (
    "section", "transom", "profile", "deck edge", "deck centre", "flat of side", "flat of bottom",
    "waterline", "buttock",
)  # fmt: skip
"""What may be generated; of waterlines and buttocks, where they come onto a flat and leave it."""

ON_FLATS = ("waterline", "buttock")
"""Lines of which only the places where they come onto a flat and leave it are generated."""

Mark = tuple[int, float]
"""A piece of a generated curve, and t (0 to 4) on it."""

_CALL = "in a definition"


def _values(given: Mapping[str, float | None]) -> Mapping[str, float | None]:
    values = instance(given, Mapping, "values", _CALL)  # type: ignore[type-abstract]
    return MappingProxyType(
        {
            text(name, "a name", _CALL): None if value is None else number(value, name, _CALL) + 0.0
            for name, value in values.items()
        }
    )


def _labels(given: Iterable[str]) -> tuple[str, ...]:
    return tuple(all_of(given, str, "nodes", _CALL))


@attrs.frozen
class FormDefinition:
    """A curve of form parameters.

    Attributes
    ----------
    name : str
        What it is called; no two of a hull have one name.
    use : str
        What is taken from it, see `assoc_hull.model.form_definition.USES`; each use stands once in
        a hull, so it is the identity.
    kind : str
        One of `FORM_KINDS`.
    values : mapping of str to float or None
        By name: `HALVES`, or `NODE_FIELDS` of each of the `nodes`.
    rule : str
        Of a course: one of `RULES`.
    nodes : tuple of str
        Of a course: labels of the nodes, in order.
    """

    name: str
    use: str
    kind: str
    values: Mapping[str, float | None] = attrs.field(
        converter=_values, eq=lambda v: tuple(v.items())
    )
    rule: str = "form"
    nodes: tuple[str, ...] = attrs.field(default=(), converter=_labels)

    def __attrs_post_init__(self) -> None:
        where = f"in the definition {text(self.name, 'name', _CALL)!r}"
        if text(self.use, "use", where) not in USES:
            raise UnknownNameError("use of a definition", self.use, tuple(USES))
        wanted = USES[self.use].kind
        if choice(self.kind, "kind", FORM_KINDS, where) != wanted:
            raise BadInputError(f"the kind {self.kind!r}", where, f"{self.use} is of {wanted!r}")
        choice(self.rule, "rule", RULES, where)
        for node in self.nodes:
            if self.nodes.count(text(node, "a node", where)) > 1:
                raise BadInputError(f"two nodes are labelled {node!r}", where, "rename one")
        known = self.names
        for name in self.values:
            if name not in known:
                raise UnknownNameError("value", name, known)
        object.__setattr__(self, "values", _values({n: self.values.get(n) for n in known}))

    def __reduce__(self) -> tuple[type[FormDefinition], tuple[object, ...]]:
        """Let copies and other processes have it: a read-only mapping is not taken along."""
        given = {name: value for name, value in self.values.items() if value is not None}
        return type(self), (self.name, self.use, self.kind, given, self.rule, self.nodes)

    @property
    def key(self) -> str:
        """Its identity."""
        return f"form:{self.use}"

    @property
    def names(self) -> tuple[str, ...]:
        """The names of its values, in their order."""
        if self.kind == "halves":
            return HALVES
        return tuple(f"{node}_{field}" for node in self.nodes for field in NODE_FIELDS)

    def value(self, name: str) -> float | None:
        """Give a value by its name."""
        if text(name, "a name", _CALL) not in self.values:
            raise UnknownNameError("value", name, tuple(self.names))
        return self.values[name]

    def having(self, changes: Mapping[str, float | None]) -> FormDefinition:
        """Give the same definition with other values."""
        for name in instance(changes, Mapping, "changes", _CALL):  # type: ignore[type-abstract]
            self.value(name)
        return attrs.evolve(self, values={**self.values, **changes})


class _Changes(TypedDict, total=False):
    """Attributes of a `GeneratedCurve`."""

    key: str
    curve: int
    what: str
    layout: str
    rows: tuple[int, ...]
    marks: tuple[Mark, ...]
    attached: bool


@attrs.frozen
class GeneratedCurve:
    """A curve whose points, except its ends, are computed from definitions.

    Attributes
    ----------
    key : str
        Key of the curve.
    curve : int
        Number of the curve; its key stands for it in a definition of the hull.
    what : str
        What is generated: ``"section"``, ``"profile"``, ``"deck edge"``, ``"waterline"`` ...
    layout : str
        The pieces that it is made of, as `assoc_hull.model.forms.line_layout` names them.
    rows : tuple of int
        Row numbers of the generated points, in order along the curve.
    marks : tuple of Mark
        Where each lies on the pieces of the layout.
    attached : bool
        Whether the points are still those of the definitions.
    """

    key: str
    curve: int
    what: str
    layout: str
    rows: tuple[int, ...]
    marks: tuple[Mark, ...]
    attached: bool = True

    @property
    def reads_ends(self) -> bool:
        """Whether the points depend on where the ends of the curve lie: those of sections do."""
        return self.what == "section"

    def evolve(self, **changes: Unpack[_Changes]) -> GeneratedCurve:
        """Give the same with other attributes."""
        return attrs.evolve(self, **changes)
