"""What named parameters of a hull may be asked for: maps of values, or why there is none."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import attrs
import numpy as np

from assoc_hull.errors import AssocHullError, BadInputError, FoldError, OutOfRangeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.state import HullState
from assoc_hull.variation.certificate.admissible_amplitudes import admissible
from assoc_hull.variation.certificate.certify import certify
from assoc_hull.variation.certificate.record import Certificate
from assoc_hull.variation.features.redrawn_features import regenerated
from assoc_hull.variation.fields.space_map import VMap
from assoc_hull.variation.parameters.bounds import bounds
from assoc_hull.variation.parameters.catalogue import CATALOGUE
from assoc_hull.variation.parameters.compose_map import compose, refuse_clashes
from assoc_hull.variation.parameters.layout import Layout
from assoc_hull.variation.parameters.limits import hull_box, interval, present
from assoc_hull.variation.parameters.parameter_measures import measure_all
from assoc_hull.variation.parameters.parent_places import Parent
from assoc_hull.variation.parameters.read_parent import parent_of

__all__ = ["SAME", "Room", "asked_radii"]

SAME = 1e-9
"""A value (m, degrees) that is asked for and had already moves nothing of itself."""

_STEP = 0.02
"""A part of all changes, to begin a search with."""

_ROUND = 1e-6
"""m: a circle about a place has its centre so near to it."""


def asked_radii(
    state: HullState, parent: Parent, asked: Mapping[str, float], now: Mapping[str, float]
) -> dict[str, float]:
    """Give the radius that is asked for of the bossing's end, by the key of the feature."""
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
class Room:
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

    @classmethod
    def of(cls, state: HullState, layout: Layout, tolerance: float) -> Room:
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
        parent, was = parent_of(state, measures), present(measures, layout)
        return cls(state, parent, was, layout, hull_box(state, tolerance))

    def interval(self, name: str) -> tuple[float, float]:
        """Give the least and greatest value of a parameter, asked for alone; sought once."""
        if name not in self._found:
            now = self.present[name]
            rule = bounds(name, self.parent, now, self.layout)
            self._found[name] = interval(self._alone(name), now, rule, self.box)
        return self._found[name]

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
        parent = attrs.evolve(self.parent, breadth=asked.get("breadth", self.parent.breadth))
        for name, value in asked.items():
            rule = bounds(name, parent, self.present[name], self.layout)
            if not rule.hold(value):
                raise self._outside(name, value, rule.why)

    def map(self, asked: Mapping[str, float]) -> VMap:
        """Lay out a map, or tell which value cannot be laid out.

        Raises
        ------
        OutOfRangeError
            One of the values cannot be had even alone; with the interval.
        BadInputError
            As `compose`.
        """
        try:
            return compose(self.parent, asked, self.layout)
        except BadInputError as error:
            raise self._at_fault(error, asked) from None

    def certified(self, vmap: VMap, asked: Mapping[str, float]) -> Certificate:
        """Certify a map, or refuse it with the room that the parameter at fault has.

        Raises
        ------
        FoldError
            It folds, or nearly; where, by how much, and what would do.
        OutOfRangeError
            Features cannot be made anew after it; with the interval.
        BadInputError
            They cannot for several values together.
        """
        found = certify(vmap, self.box)
        try:
            found.check()
            self._featured(vmap, asked)
        except FoldError as error:
            raise self._told(error, asked) from None
        except BadInputError as error:
            raise self._at_fault(error, asked) from None
        return found

    def _at_fault(self, error: BadInputError, asked: Mapping[str, float]) -> AssocHullError:
        """Find the value that cannot be had even alone."""
        for name, value in asked.items():
            if self._refused(name, value) and not self._refused(name, self.present[name]):
                return self._outside(name, value, f"cannot be had ({error.what})")
        return error

    def _featured(self, vmap: VMap, asked: Mapping[str, float]) -> None:
        """Try whether features can be made anew after a map."""
        regenerated(self.state, vmap, asked_radii(self.state, self.parent, asked, self.present))

    def _laid(self, asked: Mapping[str, float]) -> VMap:
        """Lay out a map after which features can be made anew."""
        vmap = compose(self.parent, asked, self.layout)
        self._featured(vmap, asked)
        return vmap

    def _alone(self, name: str) -> Callable[[float], VMap]:
        return lambda value: self._laid({name: value})

    def _told(self, error: FoldError, asked: Mapping[str, float]) -> FoldError:
        """Add to a fold between which values the parameter at fault may be asked for."""
        name = error.field or error.layer
        if name not in asked:
            return error
        low, high = self.interval(name)
        alone = low <= asked[name] <= high
        return attrs.evolve(
            error, interval=(low, high), unit=CATALOGUE[name].unit,
            part=self._part(asked) if alone and len(asked) > 1 else None,
        )  # fmt: skip

    def _part(self, asked: Mapping[str, float]) -> float:
        """Give how much of all changes is certified."""

        def laid(part: float) -> VMap:
            values = {
                name: self.present[name] + part * (value - self.present[name])
                for name, value in asked.items()
            }
            return self._laid(values)

        return admissible(laid, self.box, first=_STEP)[1]

    def _refused(self, name: str, value: float) -> bool:
        try:
            self._laid({name: value})
        except BadInputError:
            return True
        return False

    def _outside(self, name: str, value: float, why: str) -> OutOfRangeError:
        low, high = self.interval(name)
        return OutOfRangeError(name, value, "in vary", why, low, high, CATALOGUE[name].unit)
