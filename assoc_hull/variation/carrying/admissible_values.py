"""What named parameters of a hull may be asked for: maps of values, or why there is none.

`AdmissibleValues` measures a hull once and then lays out and certifies maps of asked values (m or
degrees); what cannot be had is refused with the interval of the parameter at fault. It belongs to
carrying, not to the catalogue, because a map is refused also when features cannot be drawn again
after it. `list_parameters` gives present values, intervals and conflicts of all parameters.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping, Sequence
from functools import cached_property

import attrs
import numpy as np

from assoc_hull.edit.mapped_planes import PlaneSamples, planar_lines
from assoc_hull.errors import AssocHullError, BadInputError, FoldError, OutOfRangeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.tables import HullState
from assoc_hull.variation.certificate.fold_check import Certificate, admissible_amplitudes, certify
from assoc_hull.variation.comparing.line_fairness import ImagedLines
from assoc_hull.variation.features.redrawn_features import HullFeatures, redraw_features
from assoc_hull.variation.fields.space_map import VariationMap
from assoc_hull.variation.parameters.catalogue import CATALOGUE
from assoc_hull.variation.parameters.compose_map import compose_map, conflicts, refuse_clashes
from assoc_hull.variation.parameters.field_layout import Layout
from assoc_hull.variation.parameters.hull_and_end_measures import drawn_breadth
from assoc_hull.variation.parameters.measurement import Measures
from assoc_hull.variation.parameters.parameter_measures import measure_all
from assoc_hull.variation.parameters.parent import Parent, parent_of
from assoc_hull.variation.parameters.value_limits import (
    admissible_interval,
    fair_end,
    hull_box,
    present_values,
    value_bounds,
)
from assoc_hull.variation.request import TOLERANCE

__all__ = [
    "SAME",
    "AdmissibleValues",
    "ListedParameter",
    "list_parameters",
    "parameter_table",
    "requested_radii",
]

SAME = 1e-9
"""A value (m, degrees) as near as this to the present one is no change."""

_STEP = 0.02
"""Part of all changes with which a search begins."""

_BODY = {"body start": "parallel_body_start", "body end": "parallel_body_end"}
"""Places of the parent at the ends of its parallel body, and what asks for them."""

_ROUND = 1e-6
"""m: a circle whose centre is as near as this to a place is about it."""


def requested_radii(
    state: HullState, parent: Parent, asked: Mapping[str, float], now: Mapping[str, float]
) -> dict[str, float]:
    """Give the radius (m) asked for of the bossing's end, by the key of the feature; or nothing."""
    radius = asked.get("bossing_radius")
    if radius is None or abs(radius - now["bossing_radius"]) <= SAME or not parent.has("boss"):
        return {}
    boss = parent.places["boss"]
    return {
        each.key: radius for each in state.features
        if each.centre is not None and each.kind == "circle"
        and bool((np.abs(boss - each.centre) <= _ROUND).all())
    }  # fmt: skip


@attrs.frozen(eq=False)
class AdmissibleValues:
    """What named parameters of a hull may be asked for.

    Attributes
    ----------
    state : HullState
        The tables.
    parent : Parent
        What layouts know of it.
    present : mapping of str to float
        Values now, of those that are asked for.
    layout : Layout
    box : (2, 3), m
        Of the hull.
    """

    state: HullState
    parent: Parent
    present: Mapping[str, float]
    layout: Layout
    box: FloatArray
    _found: dict[str, tuple[float, float]] = attrs.field(factory=dict, init=False, repr=False)
    _fair: dict[str, tuple[float, float]] = attrs.field(factory=dict, init=False, repr=False)

    @classmethod
    def of(cls, state: HullState, layout: Layout, tolerance: float) -> AdmissibleValues:
        """Measure a hull.

        Parameters
        ----------
        state : HullState
            The tables.
        layout : Layout
            How far fields reach.
        tolerance : float, m
            How far drivers may leave their images.
        """
        measures = measure_all(state)
        parent, was = parent_of(state, measures), present_values(measures, layout)
        return cls(state, parent, was, layout, hull_box(state, tolerance))

    @cached_property
    def had(self) -> HullFeatures:
        """The circles and bilges of the hull."""
        return HullFeatures.of(self.state)

    @cached_property
    def samples(self) -> PlaneSamples:
        """Places along its planar lines."""
        return PlaneSamples.of(self.state, planar_lines(self.state))

    def interval(self, name: str) -> tuple[float, float]:
        """Give the least and greatest value of a parameter, asked for alone; sought once."""
        if name not in self._found:
            now = self.present[name]
            rule = value_bounds(name, self.parent, now, self.layout)
            self._found[name] = admissible_interval(self._alone(name), now, rule, self.box)
        return self._found[name]

    @cached_property
    def images(self) -> ImagedLines:
        """The lines, to be judged by their images."""
        return ImagedLines.of(self.state)

    def fair_interval(self, name: str) -> tuple[float, float]:
        """Give between which values of a parameter, asked for alone, lines stay fair."""
        if name not in self._fair:
            now = self.present[name]

            def sharper(value: float) -> float:
                """Give the logarithm of how much sharper the sharpest comb becomes."""
                try:
                    vmap = compose_map(self.parent, {name: value}, self.layout)
                except BadInputError:
                    return math.inf
                combs = (times for _, times in self.images.compared(vmap).unfairness)
                return math.log(max(combs, default=1.0) or 1.0)

            low, high = self.interval(name)
            self._fair[name] = fair_end(sharper, now, low), fair_end(sharper, now, high)
        return self._fair[name]

    def fair_words(self, name: str) -> str:
        """Give the ends of `fair_interval` in words, rounded inward."""
        low, high = (each if math.isfinite(each) else None for each in self.fair_interval(name))
        ends = f"from {_end(low, math.ceil)} to {_end(high, math.floor)} {CATALOGUE[name].unit}"
        return ends.removesuffix(" -")

    def check(self, asked: Mapping[str, float]) -> None:
        """Refuse values that make no hull, or contradict each other.

        Raises
        ------
        OutOfRangeError
            With the interval, and what becomes of the hull beyond.
        BadInputError
            Two parameters that are one number.
        """
        refuse_clashes(asked, self.layout)
        parent = self._bounding(asked)
        for name, value in asked.items():
            rule = value_bounds(name, parent, self.present[name], self.layout)
            if not rule.hold(value):
                raise self._outside(name, value, rule.why)

    def _bounding(self, asked: Mapping[str, float]) -> Parent:
        """Give what bounds values: breadth and ends of the parallel body are those asked for."""
        breadth = asked.get("breadth", self.parent.breadth)
        longer = asked.get("length", self.parent.length) / self.parent.length
        ends = {
            place: float(asked.get(name, longer * self.parent.places[place][0]))
            for place, name in _BODY.items() if self.parent.has(place)
        }  # fmt: skip
        body = asked.get("parallel_body_length")
        if body is not None and "parallel_body_start" in asked:
            ends["body end"] = asked["parallel_body_start"] + body
        elif body is not None and "parallel_body_end" in asked:
            ends["body start"] = asked["parallel_body_end"] - body
        places = {place: np.array([x, 0.0, 0.0]) for place, x in ends.items()}
        return attrs.evolve(self.parent, breadth=breadth, places={**self.parent.places, **places})

    def map(self, asked: Mapping[str, float]) -> VariationMap:
        """Lay out a map, or refuse with the value that cannot be laid out.

        Raises
        ------
        OutOfRangeError
            One of the values cannot be had even alone; with the interval.
        BadInputError
            As `compose_map`.
        """
        try:
            return compose_map(self.parent, asked, self.layout)
        except BadInputError as error:
            raise self._at_fault(error, asked) from None

    def certified(self, vmap: VariationMap, asked: Mapping[str, float]) -> Certificate:
        """Certify a map, or refuse it with the room that the parameter at fault has.

        Raises
        ------
        FoldError
            It folds, or nearly; where, by how much, and what would do.
        OutOfRangeError
            Features cannot be drawn again after it; with the interval.
        BadInputError
            They cannot for several values together.
        """
        found = certify(vmap, self.box)
        try:
            found.check()
            self._featured(vmap, asked)
        except FoldError as error:
            raise self._with_interval(error, asked) from None
        except BadInputError as error:
            raise self._at_fault(error, asked) from None
        return found

    def _at_fault(self, error: BadInputError, asked: Mapping[str, float]) -> AssocHullError:
        """Give the error of the value that cannot be had even alone; else the given error."""
        for name, value in asked.items():
            if self._refused(name, value) and not self._refused(name, self.present[name]):
                return self._outside(name, value, f"cannot be had ({error.what})")
        return error

    def _featured(self, vmap: VariationMap, asked: Mapping[str, float]) -> None:
        """Refuse a map after which features cannot be drawn again."""
        redraw_features(
            self.state,
            vmap,
            requested_radii(self.state, self.parent, asked, self.present),
            self.had,
        )

    def _laid(self, asked: Mapping[str, float]) -> VariationMap:
        """Lay out a map after which features can be drawn again."""
        vmap = compose_map(self.parent, asked, self.layout)
        self._featured(vmap, asked)
        return vmap

    def _alone(self, name: str) -> Callable[[float], VariationMap]:
        return lambda value: self._laid({name: value})

    def _with_interval(self, error: FoldError, asked: Mapping[str, float]) -> FoldError:
        """Add to a fold between which values the parameter at fault may be asked for."""
        name = error.field or error.layer
        if name not in asked:
            return error
        low, high = self.interval(name)
        # where the value can be had alone, the others are at fault too: say how much of all can be
        # had
        alone = low <= asked[name] <= high
        return attrs.evolve(
            error, interval=(low, high), unit=CATALOGUE[name].unit, fair=self.fair_interval(name),
            part=self._part(asked) if alone and len(asked) > 1 else None,
        )  # fmt: skip

    def _part(self, asked: Mapping[str, float]) -> float:
        """Give the part of all changes together, 0 to 1, that is certified."""

        def laid(part: float) -> VariationMap:
            values = {
                name: self.present[name] + part * (value - self.present[name])
                for name, value in asked.items()
            }
            return self._laid(values)

        return admissible_amplitudes(laid, self.box, first=_STEP)[1]

    def _refused(self, name: str, value: float) -> bool:
        """Tell whether a value cannot be had even alone."""
        try:
            self._laid({name: value})
        except BadInputError:
            return True
        return False

    def _outside(self, name: str, value: float, why: str) -> OutOfRangeError:
        """Give the error for a value out of its interval."""
        (low, high), unit = self.interval(name), CATALOGUE[name].unit
        remedy = f"for lines as fair as these, one {self.fair_words(name)}"
        return OutOfRangeError(name, value, "in vary", why, low, high, unit, remedy)


# --------------------------------------------------------------------------------------
# The list of parameters.

_DIGITS = 4
"""Significant digits of the ends of intervals, which are rounded inward."""

_HEAD = ("parameter", "present", "", "from", "to", "fair from", "to", "what it is")
_FOOT = """\
x from AP forward, z from the base line up. Each interval is that of the parameter asked for alone.
Between the fair ends lines stay about as fair as they are. Beyond, some get bends that the report
names; hulls that no one would take are refused, unless --accept takes them. Beyond the other two
the map folds, a round end cannot be made anew, or what comes out is no ship. Towards all ends a
line may still be refused, with its name and the place."""


@attrs.frozen
class ListedParameter:
    """A named parameter of one hull.

    Attributes
    ----------
    name, unit, meaning : str
    value : float or None
        Present value; None where the hull has none, for the `reason`.
    low, high : float or None
        Between these (m or degrees) it may be asked for alone; None where nothing ends it.
    fair_low, fair_high : float or None
        Between these lines stay about as fair as they are.
    conflicts : tuple of str
        Parameters that cannot be asked for beside it.
    reason : str or None
        Why it has no value, or cannot be varied.
    """

    name: str
    unit: str
    meaning: str
    value: float | None
    low: float | None
    high: float | None
    fair_low: float | None
    fair_high: float | None
    conflicts: tuple[str, ...]
    reason: str | None

    @property
    def words(self) -> tuple[str, ...]:
        """What a table says of it, in columns."""
        if self.value is None:
            return self.name, "-", "", "", "", "", "", str(self.reason)
        now = f"{self.value:.4f}"
        if self.reason is not None:
            return self.name, now, self.unit, "", "", "", "", self.reason
        apart = f"; not with {' or '.join(self.conflicts)}" if self.conflicts else ""
        return (
            self.name, now, self.unit, self._from(self.low), _end(self.high, math.floor),
            self._from(self.fair_low), _end(self.fair_high, math.floor), self.meaning + apart,
        )  # fmt: skip

    def _from(self, low: float | None) -> str:
        open_ = low == 0.0 and CATALOGUE[self.name].positive
        return "> 0" if open_ else _end(low, math.ceil)


def parameter_table(found: Sequence[ListedParameter]) -> str:
    """Give parameters as a table in text, with a head and a word on how to read it.

    Examples
    --------
    >>> from assoc_hull.variation.carrying.admissible_values import ListedParameter, parameter_table
    >>> shaft = ListedParameter(
    ...     "shaft_height", "m", "height", 5.0, 2.71649, 11.55896, 4.0, 6.0, (), None
    ... )
    >>> for row in parameter_table([shaft]).splitlines()[:2]:
    ...     print(row)
    parameter     present      from     to  fair from  to  what it is
    shaft_height   5.0000  m  2.717  11.55          4   6  height
    """
    rows = [_HEAD, *(each.words for each in found)]
    wide = [max(len(row[k]) for row in rows) for k in range(len(_HEAD) - 1)]
    lines = []
    for row in rows:
        name, *numbers, last = row
        cells = [name.ljust(wide[0])]
        cells += [each.rjust(room) for each, room in zip(numbers, wide[1:], strict=True)]
        lines.append("  ".join([*cells, last]))
    return "\n".join([*lines, _FOOT])


def _end(value: float | None, inward: Callable[[float], int]) -> str:
    """Give an end of an interval with four digits, rounded inward: what is listed can be had."""
    if value is None:
        return "any"
    whole = math.floor(math.log10(abs(value))) if value else 0
    scale = 10.0 ** (_DIGITS - 1 - whole)
    return f"{inward(value * scale) / scale:.{_DIGITS}g}"


def list_parameters(
    state: HullState, layout: Layout | None = None, limits: Collection[str] = CATALOGUE
) -> tuple[ListedParameter, ...]:
    """List all named parameters of a hull.

    Parameters
    ----------
    state : HullState
        The tables.
    layout : Layout or None
        How far the fields reach, on which intervals depend; None for the usual reaches.
    limits : names
        Of which parameters the interval is sought, up to a second for each; the others have none.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.variation.carrying.admissible_values import list_parameters
    >>> found = {each.name: each for each in list_parameters(wigley())}
    >>> found["breadth"].value, found["bulb_length"].reason
    (10.0, 'no profile forward of FP below z=6.250')
    """
    given = layout or Layout()
    found = measure_all(state)
    # the box in which a variation is certified
    parent, box = parent_of(state, found), hull_box(state, TOLERANCE)
    room = AdmissibleValues(state, parent, present_values(found, given), given, box)
    return tuple(_listed(name, found, room, name in limits) for name in CATALOGUE)


def _listed(name: str, found: Measures, room: AdmissibleValues, limited: bool) -> ListedParameter:
    entry, reason = CATALOGUE[name], found.absent.get(name)
    value = room.present.get(name)
    low = high = fair_low = fair_high = None
    if value is None:
        reason = reason or "the deck edge does not reach there"
    elif limited:
        try:
            ends = (*room.interval(name), *room.fair_interval(name))
            low, high, fair_low, fair_high = (x if math.isfinite(x) else None for x in ends)
        except BadInputError as error:
            reason = f"cannot be varied: {error.what.partition(': ')[2] or error.what}"
        except Exception as error:  # a fault at one parameter must not lose the list of the others
            told = str(error) if isinstance(error, AssocHullError) else (
                f"{type(error).__name__} inside the program ({error}): report it"
            )  # fmt: skip
            reason = f"cannot be varied: {told}"
        else:
            if not ends[1] - ends[0] > SAME:
                reason = f"cannot be varied: the map folds as soon as it leaves {value:.4g}"
    beside = drawn_breadth(found.anchors[name]) if name == "breadth" else ()
    return ListedParameter(
        name, entry.unit, "; ".join((entry.meaning, *beside)), value, low, high,
        fair_low, fair_high, conflicts(name, room.layout), reason,
    )  # fmt: skip
