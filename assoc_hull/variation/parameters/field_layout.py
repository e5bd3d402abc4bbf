"""How far the fields of named parameters reach, and what one parameter puts into a map.

`Layout` has a number for each rule by which fields are laid out; all of them may be changed. A
`Share` is what the layout of one parameter gives: fields for the asked change, and the place where
they must give it, so that the sizes of several parameters can be solved for together.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal

import attrs
import numpy as np

from assoc_hull.arguments import number, positive, shown
from assoc_hull.errors import BadInputError, UnknownNameError, WrongTypeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields.anchor_fields import hat_field, ratio_field
from assoc_hull.variation.fields.bounded_functions import CUBIC, QUINTIC, Blend, BoundedFunction
from assoc_hull.variation.fields.field import Axis, StackedField
from assoc_hull.variation.fields.layers import Rake

__all__ = [
    "HEIGHTS",
    "LENGTHS",
    "Layout",
    "Share",
]


HEIGHTS = ("Hbase", "Hbilge", "Hshaft", "Htransom", "Hdraft", "Hmax", "Hbulb")
LENGTHS = ("BX0", "BX1", "BX2", "BX3", "EX0", "EX1", "EX2", "EX3")
"""Names of regions: those of figure 1 of the paper; `Hbulb` and `EX0` to `EX3` are ours."""


@attrs.frozen
class Layout:
    """Reaches of the fields of named parameters.

    Lengths are parts of Lpp (``stern``, ``shaft``, ``bow_from``, ``bilge_length``), of the
    draught or of the radius they belong to.

    Attributes
    ----------
    blend : {"quintic", "cubic", "paper"}
        How pieces go over into each other; "paper" is the form of Choi & Lee (1999), ratios of
        heights blended by the cubic, see `assoc_hull.variation.fields.anchor_fields`.
    rigid : bool
        Whether the bossing end moves as a whole between two windows; else one dome is level at
        its centre, and its circle is made a circle again.
    stern : float
        Fields of the transom fade over this part of Lpp forward of it.
    shaft : float
        The shaft's height fades over this part of Lpp forward of the bossing end.
    shaft_top : float
        It fades up to this part of the draught.
    bossing : float
        The bossing's breadth fades over this many radii, its height over half of them.
    tube : float
        It widens nothing beyond this many radii from the centre plane.
    bow_from : float
        Fields of the bow begin at this part of Lpp.
    bulb_top : float
        The bulb's height fades up to this part of the draught.
    bulb_side : float
        The bulb's half-breadth fades up to this part of the draught.
    bulb_stem : float
        The bulb's length fades up to this part of the draught; 1 pins the stem at the waterline.
    transom_low : float
        The transom's height fades down to this part of the draught.
    transom_side : float
        The transom's half-breadth fades down to this part of the draught.
    bilge : float
        Bilge and flat of bottom fade at this many radii from the corner.
    bilge_length : float
        They fade over this part of Lpp beyond the parallel body.
    deadrise_top : float
        Deadrise fades up to this part of the draught.
    draught_top : float
        Heights are scaled up to the draught, and shifted from this part of the draught up, or from
        the top of the hull if that is lower.
    deck : {"midship", "fore", "aft"}
        Where ``deck_height`` holds: amidships, the whole deck with it, or at a perpendicular.
    shift : str
        Shape of ``fore_shift`` and ``aft_shift``.
    Hbase, Hbilge, Hshaft, Htransom, Hdraft, Hmax : float or None, m
        With ``blend="paper"``, heights of its regions: of base line, upper end of the bilge, shaft,
        lowest point of the transom, design draught, and of the top. Once a region is named all are
        boundaries at which ratios are 1, but for that of what is changed; None: as the hull has it.
    BX0, BX1, BX2, BX3 : float or None, m
        Places from AP: a change at BX0, the transom, reaches as far as BX1, one at BX3, where the
        parallel body begins, as far as BX2.
    Hbulb, EX0, EX1, EX2, EX3 : float or None, m
        The same scheme for the fore body, which the paper does not have: height of the bulb's tip;
        a change at EX0, the FP, reaches as far as EX1, one at EX3, where the parallel body ends, as
        far as EX2.

    Examples
    --------
    >>> from assoc_hull.variation.parameters.field_layout import Layout
    >>> Layout.of({"stern": 0.3}).stern
    0.3
    """

    blend: Literal["quintic", "cubic", "paper"] = "quintic"
    rigid: bool = False
    stern: float = 0.25
    shaft: float = 0.12
    shaft_top: float = 1.25
    bossing: float = 12.0
    tube: float = 6.0
    bow_from: float = 0.85
    bulb_top: float = 1.25
    bulb_side: float = 1.15
    bulb_stem: float = 1.25
    transom_low: float = 0.3
    transom_side: float = 0.5
    bilge: float = 8.0
    bilge_length: float = 0.2
    deadrise_top: float = 0.8
    draught_top: float = 2.4
    deck: Literal["midship", "fore", "aft"] = "midship"
    shift: Literal["c1", "c2", "end", "half", "lackenby"] = "c2"
    Hbase: float | None = None
    Hbilge: float | None = None
    Hshaft: float | None = None
    Htransom: float | None = None
    Hdraft: float | None = None
    Hmax: float | None = None
    Hbulb: float | None = None
    BX0: float | None = None
    BX1: float | None = None
    BX2: float | None = None
    BX3: float | None = None
    EX0: float | None = None
    EX1: float | None = None
    EX2: float | None = None
    EX3: float | None = None

    @property
    def curve(self) -> Blend:
        """The blend itself."""
        return QUINTIC if self.blend == "quintic" else CUBIC

    def over(
        self,
        name: str,
        anchors: Sequence[tuple[str, float, float]],
        course: BoundedFunction,
        outward: Sequence[str] = (),
        windows: Mapping[str, tuple[float, float]] | None = None,
    ) -> StackedField:
        """Lay out a z-field over anchors (name, height, displacement), m, by hat or ratios."""
        if self.blend == "paper":
            return ratio_field(name, anchors, course, blend=self.curve)
        return hat_field(
            name, anchors, course, blend=self.curve, outward=outward, windows=windows or {}
        )

    @classmethod
    def of(cls, given: Mapping[str, Any] | Layout | None) -> Layout:
        """Take reaches by name; what is not named keeps its usual value.

        Raises
        ------
        UnknownNameError
            A name that is none of the attributes.
        BadInputError
            A value that cannot be used.
        """
        if given is None or isinstance(given, Layout):
            return given or cls()
        if not isinstance(given, Mapping):
            raise WrongTypeError(f"layout is {shown(given)}", "in vary", "give reaches by name")
        known = {field.name: field for field in attrs.fields(cls)}
        for name, value in given.items():
            if name not in known:
                raise UnknownNameError("reach of a field", str(name), tuple(known))
            _check(name, value)
        found = cls(**dict(given))
        named = [name for name in (*HEIGHTS, *LENGTHS) if getattr(found, name) is not None]
        if named and found.blend != "paper":
            raise BadInputError(
                f"{named[0]} is a region of the paper, and the blend is {found.blend!r}", "in vary",
                f"give blend='paper' as well, or leave {', '.join(named)} out",
            )  # fmt: skip
        return found


_WORDS = {
    "blend": ("quintic", "cubic", "paper"),
    "deck": ("fore", "midship", "aft"),
    "shift": ("c1", "c2", "end", "half", "lackenby"),
}
_LEAST = {"draught_top": 1.0, "tube": 1.0, "bilge": 1.0}
"""Reaches that begin at 1, of draught or radius, and end at what is given; others begin at 0."""


def _check(name: str, value: Any) -> None:
    if name in _WORDS:
        if value not in _WORDS[name]:
            raise BadInputError(
                f"{name} is {value!r}", "in vary", f"give one of {', '.join(_WORDS[name])}"
            )
    elif name == "rigid":
        if not isinstance(value, bool):
            raise BadInputError(f"rigid is {value!r}", "in vary", "give True or False")
    elif name in HEIGHTS or name in LENGTHS:
        if value is not None:
            number(value, name, "in vary")
    elif not positive(value, name, "in vary") > _LEAST.get(name, 0.0):
        raise BadInputError(
            f"{name} is {value:g}", "in vary", f"give a number above {_LEAST[name]:g}"
        )


@attrs.frozen(eq=False)
class Share:
    """Fields of one parameter, laid out for the change that is asked.

    Attributes
    ----------
    name : str
        The parameter.
    axis : {"x", "y", "z"}
        The coordinate of the anchor that must change.
    change : float, m
        By how much.
    places : (k, 3), m
        The anchor; further places are subtracted by their weights.
    weights : (k,)
        1 for the anchor itself.
    fields : tuple of StackedField or Rake
        Which alone give the change.
    """

    name: str
    axis: Axis
    change: float
    places: FloatArray
    weights: FloatArray
    fields: tuple[StackedField | Rake, ...]

    @classmethod
    def at(
        cls, name: str, axis: Axis, change: float, place: FloatArray, *fields: StackedField | Rake
    ) -> Share:
        """Give a share whose anchor is one place."""
        return cls(name, axis, change, place[None, :].copy(), np.ones(1), fields)

    def scaled(self, factor: float) -> Share:
        """Give the share with its fields times a factor; bits stay with a factor of 1."""
        if factor == 1.0:
            return self
        return attrs.evolve(self, fields=tuple(each.scaled(factor) for each in self.fields))

    def effect(self, other: Share) -> float:
        """Give what these fields change at the anchor of another share, m."""
        axis = other.axis
        moved = np.zeros(len(other.places))
        for field in self.fields:
            if field.axis == axis:
                moved = moved + field.displacement(other.places)
        return float((moved * other.weights).sum())
