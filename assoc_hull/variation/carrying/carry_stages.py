"""A hull carried by several maps, each laid out and certified on what the one before has made.

All maps run in one edit, so that they are one step of the history, refused as a whole; only
who has the edit sees the hull between them.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from operator import is_
from typing import TYPE_CHECKING

import attrs
import numpy as np

from assoc_hull.edit.carried_net import Nudge
from assoc_hull.edit.document import end_if_stopped
from assoc_hull.edit.step import Step
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import AssocHullError
from assoc_hull.variation.carrying.admissible_values import SAME, AdmissibleValues
from assoc_hull.variation.carrying.carry_hull import AppliedMap, carry_map
from assoc_hull.variation.certificate.fold_check import Certificate
from assoc_hull.variation.fields.field import FieldRegion
from assoc_hull.variation.fields.space_map import VariationMap
from assoc_hull.variation.parameters.catalogue import CATALOGUE
from assoc_hull.variation.parameters.parent import cannot_vary
from assoc_hull.variation.parameters.stages import Plan, Stage, refined_plan
from assoc_hull.variation.request import VariationRequest

if TYPE_CHECKING:
    from assoc_hull.variation.faired_followers import ParentLines

__all__ = ["CarriedMap", "DoneStage", "StagedCarry"]


_PINNED = 5e-8
"""m or degrees: what is to stay is asked for so far off, less than what counts as met."""


_SIZES = {"length", "breadth", "draught", "depth", "deck_height"}
"""Their fields scale one axis each; only that of the draught takes another one, the deck, along."""


def _moved(name: str, asked: Iterable[str]) -> bool:
    """Tell whether what is asked for may move what is to stay.

    Examples
    --------
    >>> from assoc_hull.variation.carrying.carry_stages import _moved
    >>> _moved("draught", ["length"]), _moved("depth", ["draught"]), _moved("depth", [])
    (False, True, False)
    """
    others = set(asked)
    if name in _SIZES and others <= _SIZES:
        return name in ("depth", "deck_height") and "draught" in others
    return bool(others)


@attrs.frozen(eq=False)
class CarriedMap:
    """One map that has carried a hull.

    Attributes
    ----------
    map : VariationMap
        The map, without features that were drawn anew.
    certificate : Certificate
        That it folds nothing of the hull that it was laid out on.
    applied : AppliedMap
        How it was applied.
    """

    map: VariationMap
    certificate: Certificate
    applied: AppliedMap

    @property
    def regions(self) -> tuple[FieldRegion, ...]:
        """Boxes of the profile plane outside which it moves nothing."""
        return (*self.map.regions(), *self.applied.regions)


@attrs.frozen(eq=False)
class DoneStage:
    """A stage of a plan that was carried out.

    Attributes
    ----------
    stage : Stage
        The stage.
    aims : mapping of str to float, m or degrees
        What its maps were to give the parameters.
    steps : tuple of Step
        What the edit held when it was done.
    carried : tuple of CarriedMap
        All maps up to it.
    """

    stage: Stage
    aims: Mapping[str, float]
    steps: tuple[Step, ...]
    carried: tuple[CarriedMap, ...]


@attrs.define(eq=False)
class StagedCarry:
    """A plan that is carried out within an edit.

    Attributes
    ----------
    edit : Transaction
        The edit, which holds nothing else.
    ask : VariationRequest
        What is asked for.
    plan : Plan
        Its parameters, stage by stage; finer than it was where a stage was refused as it stood.
    refines : bool
        Whether stages are taken more finely where they are refused.
    together : bool
        Whether what is free to reach targets stands in one map with what is set.
    carried : list of CarriedMap
        What has been carried by now.
    refused : Stage or None
        The stage that was refused last, at its finest.
    base : AdmissibleValues or None
        What is measured of the hull as it came, if it is at hand.
    lines : ParentLines or None
        The lines of the hull as it came, where followers are to be faired.
    done : list of DoneStage
        Those that the edit holds, with their aims; another plan may go on from them.
    """

    edit: Transaction
    ask: VariationRequest
    plan: Plan
    refines: bool = True
    together: bool = False
    carried: list[CarriedMap] = attrs.field(factory=list)
    refused: Stage | None = None
    base: AdmissibleValues | None = None
    lines: ParentLines | None = None
    done: list[DoneStage] = attrs.field(factory=list)

    def run(self, aims: Mapping[str, float]) -> None:
        """Carry the hull as it came by all stages; other things carried before are taken back.

        Parameters
        ----------
        aims : mapping of str to float, m or degrees
            What the maps are to give the parameters.

        Raises
        ------
        BadInputError, FoldError, OutOfRangeError, RefusedEditError
            A stage cannot be had, however finely it is taken: what was wrong with it at first.
        """
        at, first = self._keep_stages(aims), dict[str, AssocHullError]()
        while at < len(self.plan):
            stage, keep, kept = self.plan[at], self.edit.stages, len(self.carried)
            try:
                self._carry(stage, aims)
            except AssocHullError as error:
                finer = refined_plan(self.plan, at) if self.refines else None
                for name in stage.names:
                    first.setdefault(name, error)
                if finer is None:
                    self.refused = stage
                    raise first.get(stage.names[0] if stage.names else "", error) from None
                self.plan = finer
                self.edit.take_back(keep)
                del self.carried[kept:]
            else:
                at += 1
                mine = {name: aims[name] for name in stage.names}
                self.done.append(DoneStage(stage, mine, self.edit.steps, tuple(self.carried)))

    def _keep_stages(self, aims: Mapping[str, float]) -> int:
        """Take back all but the first stages that were carried out as they would be now."""
        there, at = self.edit.steps, 0
        for stage, done in zip(self.plan, self.done, strict=False):
            held = len(done.steps) <= len(there) and all(map(is_, done.steps, there))
            if not held or stage != done.stage or any(aims[n] != v for n, v in done.aims.items()):
                break
            at += 1
        del self.done[at:]
        last = self.done[-1] if self.done else None
        self.edit.take_back(0 if last is None else len(last.steps))
        self.carried[:] = () if last is None else last.carried
        return at

    def _carry(self, stage: Stage, aims: Mapping[str, float]) -> None:
        """Carry the hull by one stage, part by part."""
        room = self._room()
        begin = {name: self._present(room, name) for name in stage.names}
        for part in range(1, stage.parts + 1):
            end_if_stopped()
            room = self._room() if part > 1 else room
            last, share = part == stage.parts, part / stage.parts
            goal = {
                name: aims[name] if last else begin[name] + (aims[name] - begin[name]) * share
                for name in stage.names
            }
            # A movement is asked for from where the hull is.
            goal |= {
                name: aims[name] / stage.parts for name in stage.names if CATALOGUE[name].amplitude
            }
            asked = {
                name: value for name, value in goal.items()
                if abs(value - self._present(room, name)) > SAME
            }  # fmt: skip
            layers = self.ask.layers if stage.layers and last else ()
            if not asked and not layers:
                continue
            # What is to stay is solved for with what moves it: a field of no size has no say.
            pins = [name for name in stage.names if name not in asked and _moved(name, asked)]
            asked |= {name: self._present(room, name) + _PINNED for name in pins}
            vmap = VariationMap((*room.map(asked).layers, *layers))
            told = {name: self.ask.values[name] if last else goal[name] for name in asked}
            self.carry(room, vmap, asked, told)

    def carry_by_nothing(self) -> None:
        """Carry the hull by the map that moves nothing: all is as it was asked for."""
        self.carry(self._room(), VariationMap(()), {})

    def _present(self, room: AdmissibleValues, name: str) -> float:
        if name not in room.present:
            why = room.parent.absent.get(name, "the hull has none")
            raise cannot_vary(name, why)
        return room.present[name]

    def _room(self) -> AdmissibleValues:
        """Measure the hull as it is by now."""
        if self.base is not None and not self.edit.stages:
            return self.base
        return AdmissibleValues.of(self.edit.state, self.ask.layout, self.ask.tolerance)

    def carry(
        self,
        room: AdmissibleValues,
        vmap: VariationMap,
        asked: Mapping[str, float],
        told: Mapping[str, float] | None = None,
        by: Nudge | None = None,
    ) -> None:
        """Carry the hull as it is by now by one map, and end the stage.

        Parameters
        ----------
        room : AdmissibleValues
            What is measured of the hull.
        vmap : VariationMap
            The map.
        asked : mapping of str to float
            Values that it was laid out for; those that it gives dimensions and radii, unless these
            are `told`.
        told : mapping of str to float or None
            See there.
        by : Nudge or None
            What moves after that.
        """
        certificate = room.certified(vmap, asked)
        applied = carry_map(
            self.edit, vmap, room.parent, self.ask, room.present,
            asked if told is None else told, by,
        )  # fmt: skip
        self.edit.end_stage()
        self.carried.append(CarriedMap(vmap, certificate, applied))

    @property
    def map(self) -> VariationMap:
        """All maps in sequence."""
        return VariationMap(tuple(layer for each in self.carried for layer in each.map.layers))

    @property
    def certificate(self) -> Certificate:
        """That of the map with the least margin."""
        least = np.argmin([each.certificate.least for each in self.carried])
        return self.carried[int(least)].certificate
