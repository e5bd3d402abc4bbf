"""The maps of a parent as a function of amplitudes, and what each of them does to its lines."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property

import attrs
import numpy as np

from assoc_hull.edit.arguments import GivenObjects
from assoc_hull.edit.mapped_planes import TransformedPlanes, carry_planes
from assoc_hull.edit.space_map import SpaceMap, carry_features
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.model.features import Feature
from assoc_hull.model.tables import HullState, Particulars
from assoc_hull.variation.carrying.admissible_values import AdmissibleValues, requested_radii
from assoc_hull.variation.carrying.carry_hull import resized_particulars
from assoc_hull.variation.carrying.driving_lines import choose_drivers, section_planes
from assoc_hull.variation.certificate.fold_check import Certificate
from assoc_hull.variation.features.redrawn_features import RedrawnFeatures, redraw_features
from assoc_hull.variation.fields.layers import Layer
from assoc_hull.variation.fields.space_map import SlopedMap, VariationMap
from assoc_hull.variation.parameters.catalogue import Freedom
from assoc_hull.variation.request import VariationRequest

__all__ = ["HullMaps", "LaidMap"]


@attrs.frozen(eq=False)
class LaidMap:
    """A map at some amplitudes, and what becomes of lines, features and dimensions.

    Attributes
    ----------
    vmap : VariationMap
        The map without features.
    planes : TransformedPlanes
        Where the planes of the parent's lines go.
    particulars : Particulars
    space : SpaceMap
        What carries places: `map` with its Jacobian.
    drawn : RedrawnFeatures
        What is drawn anew.
    state : HullState
        The tables of the parent.
    """

    vmap: VariationMap
    planes: TransformedPlanes
    particulars: Particulars
    space: SpaceMap
    drawn: RedrawnFeatures
    state: HullState

    @property
    def map(self) -> SlopedMap:
        """The map with circles and bilges drawn anew."""
        return self.drawn.quick

    @cached_property
    def features(self) -> tuple[Feature, ...]:
        """The parent's features with the numbers that they get."""
        return self.drawn.features(carry_features(self.state, self.space, np.inf)).features


@attrs.frozen(eq=False)
class HullMaps:
    """The maps of a parent by the amplitudes of its free parameters.

    Attributes
    ----------
    room : AdmissibleValues
        Lays out maps of named parameters, and certifies them.
    ask : VariationRequest
        What is asked for besides.
    aim : mapping of str to float
        What the map is to give the parameters that are set, m or degrees: what is asked for, and
        what lofting leaves over.
    free : tuple of k Freedom
    """

    room: AdmissibleValues
    ask: VariationRequest
    aim: Mapping[str, float]
    free: tuple[Freedom, ...]

    @property
    def state(self) -> HullState:
        """The tables of the parent."""
        return self.room.state

    def still(self, amplitudes: FloatArray) -> bool:
        """Tell whether the map is that which moves nothing."""
        return not (self.aim or self.ask.layers or np.any(amplitudes))

    def values(self, amplitudes: FloatArray) -> dict[str, float]:
        """Give the values that named parameters get: those that are set, and those that are free.

        Parameters
        ----------
        amplitudes : (k,)
            Of the free parameters.
        """
        named = self._named(amplitudes)
        return dict(self.ask.values) | {each.name: each.present + by for each, by in named}

    def _named(self, amplitudes: FloatArray) -> list[tuple[Freedom, float]]:
        pairs = zip(self.free, amplitudes.tolist(), strict=True)
        return [(each, by) for each, by in pairs if each.layer is None]

    def _asked(self, amplitudes: FloatArray) -> dict[str, float]:
        """Give what is asked of the map; of what does not change, nothing."""
        named = [(each, by) for each, by in self._named(amplitudes) if by != 0.0]
        return dict(self.aim) | {each.name: each.present + by for each, by in named}

    def map(self, amplitudes: FloatArray) -> VariationMap:
        """Lay out the map, uncertified.

        Raises
        ------
        OutOfRangeError, BadInputError
            A value cannot be laid out.
        """
        if self.still(amplitudes):
            return VariationMap(())
        named = self.room.map(self._asked(amplitudes)).layers
        return VariationMap((*named, *self.ask.layers, *self._raw(amplitudes)))

    def _raw(self, amplitudes: FloatArray) -> list[Layer]:
        pairs = zip(self.free, amplitudes.tolist(), strict=True)
        found = [each.scaled(amplitude) for each, amplitude in pairs]
        return [layer for layer in found if layer is not None]

    def certified(self, amplitudes: FloatArray) -> tuple[VariationMap, Certificate]:
        """Lay out the map, and certify that it folds nothing.

        Raises
        ------
        FoldError, OutOfRangeError, BadInputError
            There is no such map; why.
        """
        asked = self._asked(amplitudes)
        self.room.check(asked)
        vmap = self.map(amplitudes)
        return vmap, self.room.certified(vmap, asked)

    def with_boundaries(self, lines: Sequence[int]) -> IntArray:
        """Give lines that drive, boundary curves among them, rising."""
        table = self.state.lines
        boundary = np.flatnonzero(table.alive.data & (table.boundary.data >= 0))
        return np.union1d(boundary, np.array(lines, np.int64))

    def driving(self, amplitudes: FloatArray) -> tuple[IntArray, bool]:
        """Give the lines that drive under a map, and whether planes of followers go along."""
        state, ask, vmap = self.state, self.ask, self.map(amplitudes)
        anew = redraw_features(state, vmap, self._radii(amplitudes), self.room.had)
        given = None if ask.drivers is None else GivenObjects(state).driving(ask.drivers)
        kept = choose_drivers(
            state, anew.space, given, ask.stations,
            follow=ask.planes == "follow",
        )  # fmt: skip
        return self.with_boundaries(kept.lines), kept.follow

    def _radii(self, amplitudes: FloatArray) -> dict[str, float]:
        asked = self.values(amplitudes)
        return requested_radii(self.state, self.room.parent, asked, self.room.present)

    def places(self, amplitudes: FloatArray, source: FloatArray) -> FloatArray:
        """Give where a map sends places (n, 3) of the parent, m, circles drawn anew."""
        anew = redraw_features(
            self.state, self.map(amplitudes), self._radii(amplitudes), self.room.had
        )
        return anew.quick(source)

    def laid(
        self, amplitudes: FloatArray, lines: IntArray, *, follow: bool,
        vmap: VariationMap | None = None,
    ) -> LaidMap:  # fmt: skip
        """Give a map, and what it does with lines, features and dimensions of the parent.

        Parameters
        ----------
        amplitudes : (k,)
        lines : (d,) int
            Numbers of the lines that drive, boundary curves among them.
        follow : bool
            Whether planes of followers go along.
        vmap : VariationMap or None
            The map, if it is at hand.
        """
        state, asked = self.state, self.values(amplitudes)
        vmap = self.map(amplitudes) if vmap is None else vmap
        anew = redraw_features(state, vmap, self._radii(amplitudes), self.room.had)
        space = anew.space
        levels = section_planes(state, vmap.layers if self.ask.stations == "number" else ())
        planes = carry_planes(
            state, space, lines, follow=follow, levels=levels, samples=self.room.samples
        )
        size = resized_particulars(state, anew.plain, self.room.parent, asked)
        return LaidMap(vmap, planes, size, space, anew, state)
