"""What an edit asks for, and how it is to be carried out: noted first, updated once."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

import attrs

from assoc_hull.edit.displacement_field import NormalField
from assoc_hull.edit.mapped_features import CarriedFeatures
from assoc_hull.edit.nudge import Nudge
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.graph.run_update import FailurePolicy
from assoc_hull.model.form_definition import FormDefinition

__all__ = ["Pending", "Settings", "TriedNumbers"]


@attrs.frozen
class Settings:
    """How an edit is carried out.

    Attributes
    ----------
    policy : FailurePolicy
        What becomes of an edit when a curve cannot be made.
    refuse_gaps : bool
        Whether a watched gap that stays over its limit refuses the edit; else it is kept
        as a defect that a check names.
    """

    policy: FailurePolicy = FailurePolicy.ALL_OR_NOTHING
    refuse_gaps: bool = True


class TriedNumbers(Protocol):
    """Numbers of a program that an edit was carried out with."""

    def publish(self) -> None:
        """Keep them: they are those of the tables, which have just been published."""

    def take_back(self) -> None:
        """Put those of before back."""


@attrs.define(eq=False)
class Pending:
    """What the modifications of a transaction ask for.

    Attributes
    ----------
    values : dict of int to (3,), m
        New places of points.
    curves : set of int
        Curves whose recipe changed.
    computed : set of int
        Crossings that have come to be computed from another curve than before, or from one.
    held : set of int
        Adopted points that a field moves: they do not ride in this update.
    structural : bool
        Whether lines, points, roles or associations came or went.
    moved_curves : set of int
        Curves that the designer edited: births take their value from these.
    fields : list of NormalField
        Displacements of the hull; several add.
    born, gone : list of str
        Keys of curves and crossings that the modifications made or unmade.
    fresh : list of int
        Curves that were made in this transaction.
    notes : list of str
        What was left alone, and why.
    alone : bool
        Whether a modification is there that no other may stand beside.
    relink : set of int
        Curves whose adopted points are linked to their neighbours anew after the main pass.
    after : list of callable
        What is done to the structure when the main pass has run.
    carried, cut_again : list of str
        Keys of the lines that a mapping carried, and of those that followed it.
    by_hand : set of (int, int)
        Points that were inserted, taken out or given another kind, each with the curve.
    features : CarriedFeatures or None
        The features as a mapping carried them; as they are in the tables if None.
    nudge : Nudge or None
        A small movement of the whole hull when all else has run.
    forms : dict of str to FormDefinition
        By use, definitions with other values.
    attach : set of int
        Lines whose points are to come from definitions again.
    detached : list of int
        Curves that have left their definitions in this transaction.
    numbers : TriedNumbers or None
        The numbers of the tables when all has run, where a program has made them.
    stopped : callable
        Tells whether somebody has asked to end the update; looked at before every pass.
    """

    values: dict[int, FloatArray] = attrs.field(factory=dict)
    curves: set[int] = attrs.field(factory=set)
    computed: set[int] = attrs.field(factory=set)
    held: set[int] = attrs.field(factory=set)
    structural: bool = False
    moved_curves: set[int] = attrs.field(factory=set)
    fields: list[NormalField] = attrs.field(factory=list)
    born: list[str] = attrs.field(factory=list)
    gone: list[str] = attrs.field(factory=list)
    fresh: list[int] = attrs.field(factory=list)
    notes: list[str] = attrs.field(factory=list)
    alone: bool = False
    relink: set[int] = attrs.field(factory=set)
    after: list[Callable[[], None]] = attrs.field(factory=list)
    carried: list[str] = attrs.field(factory=list)
    cut_again: list[str] = attrs.field(factory=list)
    by_hand: set[tuple[int, int]] = attrs.field(factory=set)
    features: CarriedFeatures | None = None
    nudge: Nudge | None = None
    forms: dict[str, FormDefinition] = attrs.field(factory=dict)
    attach: set[int] = attrs.field(factory=set)
    detached: list[int] = attrs.field(factory=list)
    numbers: TriedNumbers | None = None
    stopped: Callable[[], bool] = bool

    @property
    def places_only(self) -> bool:
        """Whether nothing but places of points is set, each by itself or by a field."""
        other = (
            self.curves, self.computed, self.structural, self.fresh, self.alone, self.relink,
            self.after, self.features, self.nudge, self.forms, self.attach,
        )  # fmt: skip
        return not any(other) and bool(self.values or self.fields)

    @staticmethod
    def not_alone(name: str) -> tuple[str, str, str]:
        """Say that a transformation stands beside something else: what, where, remedy."""
        what = "a transformation and another modification in one edit"
        remedy = "use two edits: a transformation reads the whole hull and sets it anew"
        return what, f"in the edit {name!r}", remedy
