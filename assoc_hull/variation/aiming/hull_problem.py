"""Hulls as a smooth function of amplitudes: carried in full now and then, nudged in between.

A hull that is carried in full has the lines that its map wants; which points these are made through
is decided anew each time, within the tolerance of the drivers. So a full carry is no smooth
function of its amplitudes. Near one, all points move in proportion to the changes of the
amplitudes, and the hull is as smooth a function of these as its sums are of its points.
"""

from __future__ import annotations

from functools import cached_property

import attrs
import numpy as np

from assoc_hull.analysis.derivatives.parameters import Moves, Rates
from assoc_hull.edit.carried_net import Nudge, nudge
from assoc_hull.edit.document import Document
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import RefusedEditError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.model.tables import HullState, copy_state
from assoc_hull.variation.aiming.outputs import Outputs
from assoc_hull.variation.carrying.carry_hull import carry_out
from assoc_hull.variation.carrying.hull_maps import HullMaps
from assoc_hull.variation.carrying.velocities import Velocities, velocities
from assoc_hull.variation.parameters.catalogue import Freedom

__all__ = ["HullProblem", "NudgeBase", "Reached"]

_FAR = 0.2
"""m: drivers have points that hold them to their images; farther on, they need others."""

_OFF = 0.25
"""In a nudge points stray from their images by no more than this part of the tolerance."""

_KEPT = 4
"""So many hulls that were carried in full are kept, to be nudged from."""

_HAIR = 1e-3
"""Usual changes by which it is found which lines of a parent will drive."""


@attrs.frozen(eq=False)
class NudgeBase:
    """A hull carried in full, from which others are nudged.

    Attributes
    ----------
    state : HullState
    amplitudes : (k,)
    lines : (d,) int
        Those that drove, boundary curves among them.
    follow : bool
    still : bool
        Whether it is the parent itself, not to be nudged.
    maps : HullMaps
    """

    state: HullState
    amplitudes: FloatArray
    lines: IntArray
    follow: bool
    still: bool
    maps: HullMaps

    @classmethod
    def of(cls, maps: HullMaps) -> NudgeBase:
        """Take the hull of maps as it is: its lines drive as when all parameters move a hair."""
        lines, follow = maps.driving(_HAIR * Freedom.probe(maps.free))
        return cls(maps.state, np.zeros(len(maps.free)), lines, follow, still=False, maps=maps)

    @cached_property
    def rates(self) -> Velocities:
        """How fast it moves with the amplitudes."""
        return velocities(self.state, self.maps, self.amplitudes, self.lines, follow=self.follow)

    def near(self, amplitudes: FloatArray) -> bool:
        """Tell whether a hull at some amplitudes may be nudged from here."""
        by = amplitudes - self.amplitudes
        if self.still:
            return not by.any()
        rates, most = self.rates, _OFF * self.maps.ask.tolerance
        if rates.farthest(by) > _FAR or rates.slides_off(by) > most:
            return False
        return self.rates.strays(by, self.maps, amplitudes) <= most

    def nudge_to(self, amplitudes: FloatArray) -> Nudge | None:
        """Give the nudge that leads to amplitudes; None if nothing moves."""
        by = amplitudes - self.amplitudes
        if not by.any():
            return None
        return self.rates.nudge(by, self.state.particulars, self.maps.ask.tolerance)

    def nudged(self, amplitudes: FloatArray) -> HullState | None:
        """Give the hull nudged to amplitudes; None if its structure would not stay."""
        document, by = Document(copy_state(self.state)), self.nudge_to(amplitudes)
        if by is None:
            return self.state
        try:
            with Transaction(document, self.maps.ask.name) as edit:
                nudge(edit, by)
        except RefusedEditError:
            return None
        return document.state if _same_structure(self.state, document.state) else None


@attrs.define(eq=False)
class Reached:
    """A certified hull at some amplitudes.

    Attributes
    ----------
    state : HullState
        Its tables.
    amplitudes : (k,)
    base : Base
        What it was nudged from.
    outputs : Outputs
        What is measured.
    like : HullState or None
        A hull whose layout serves to measure this one; None to lay it out by itself.
    """

    state: HullState
    amplitudes: FloatArray
    base: NudgeBase
    outputs: Outputs
    like: HullState | None = None
    _values: FloatArray | None = None
    _jacobian: FloatArray | None = None

    def moves(self) -> list[Moves]:
        """Give how it moves with each amplitude."""
        rates = self.base.rates
        turn = rates.turning(self.amplitudes - self.base.amplitudes)
        return [
            Moves(each.name, rates.move[j], turn[j], Rates(*rates.sizes[j].tolist()), each.unit)
            for j, each in enumerate(self.base.maps.free)
        ]

    @property
    def values(self) -> FloatArray:
        """Outputs in their own units, (m,)."""
        if self._values is None:
            self._values = self.outputs.values(self.state, like=self.like)
        return self._values

    @property
    def jacobian(self) -> FloatArray:
        """Derivatives of outputs by amplitudes, (m, k)."""
        if self._jacobian is None:
            self._values, self._jacobian = self.outputs.derivatives(
                self.state, self.moves(), like=self.like
            )
        return self._jacobian


@attrs.define(eq=False)
class HullProblem:
    """Outputs of varied hulls as functions of amplitudes; a `Problem` of aiming.

    Attributes
    ----------
    maps : HullMaps
        The maps of the parent.
    measured : Outputs
        What is aimed at.
    bases : list of Base
        The hulls that were last carried in full, the oldest first.
    quick : bool
        Whether nudged hulls are measured by the layout of what they were nudged from. What a
        layout of their own would decide otherwise is below rounding, or nearly.
    carries, nudges : int
        How many hulls were carried and nudged.
    """

    maps: HullMaps
    measured: Outputs
    bases: list[NudgeBase] = attrs.field(factory=list)
    quick: bool = True
    carries: int = 0
    nudges: int = 0
    _known: dict[bytes, Reached] = attrs.field(factory=dict)

    @property
    def free(self) -> tuple[str, ...]:
        """Names of the k free parameters."""
        return tuple(each.name for each in self.maps.free)

    @property
    def outputs(self) -> tuple[str, ...]:
        """Names of the m outputs."""
        return self.measured.names

    def at(self, amplitudes: FloatArray) -> Reached:
        """Give the hull at amplitudes, (k,).

        Raises
        ------
        FoldError, OutOfRangeError, RefusedEditError, BadInputError
            There is no certified hull there.
        """
        at = np.array(amplitudes, np.float64)
        freeze(at)
        key = at.tobytes()
        if key not in self._known:
            self._known[key] = self._reached(at)
        return self._known[key]

    def _reached(self, at: FloatArray) -> Reached:
        if self.maps.still(at):
            return Reached(self.maps.state, at, self._parent(at), self.measured)
        self.maps.certified(at)
        for base in self.bases:  # the oldest first: a step that is halved leads back to it
            found = self._nudged(base, at) if base.near(at) else None
            if found is not None:
                return found
        base = self._carried(at)
        self.bases = [*self.bases[-_KEPT + 1 :], base]
        return Reached(base.state, at, base, self.measured)

    def _parent(self, at: FloatArray) -> NudgeBase:
        """Take the parent as it is; it is nudged nowhere, as it has not the lines of any map."""
        return attrs.evolve(NudgeBase.of(self.maps), amplitudes=at, still=True)

    def _carried(self, at: FloatArray) -> NudgeBase:
        """Carry the parent in full."""
        maps, room = self.maps, self.maps.room
        document = Document(copy_state(maps.state))
        applied, _ = carry_out(
            document, maps.map(at), room.parent, maps.ask, room.present, maps.values(at)
        )
        self.carries += 1
        lines = maps.with_boundaries(applied.driving.lines)
        return NudgeBase(document.state, at, lines, applied.driving.follow, still=False, maps=maps)

    def _nudged(self, base: NudgeBase, at: FloatArray) -> Reached | None:
        """Nudge a hull; None if its structure would not stay."""
        if not (at - base.amplitudes).any():
            return Reached(base.state, at, base, self.measured)
        state = base.nudged(at)
        if state is None:
            return None
        self.nudges += 1
        return Reached(state, at, base, self.measured, base.state if self.quick else None)


def _same_structure(one: HullState, other: HullState) -> bool:
    """Tell whether two hulls have the same points, in the same roles, on the same curves."""
    if one.rows.count != other.rows.count or one.curves.count != other.curves.count:
        return False
    same = (one.rows.alive.data == other.rows.alive.data).all()
    same &= (one.rows.role.data == other.rows.role.data).all()
    same &= (one.rows.driver.data == other.rows.driver.data).all()
    return bool(same) and all(
        np.array_equal(one.curves.rows[curve], other.curves.rows[curve])
        for curve in one.live("curves").tolist()
    )
