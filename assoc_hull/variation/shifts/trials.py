"""A shift of a hull in the making: its present values, its closed form, its trials."""

from __future__ import annotations

from collections.abc import Mapping

import attrs
import numpy as np

from assoc_hull.edit.document import Document
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.copy import copy_of
from assoc_hull.model.state import HullState
from assoc_hull.variation.ask import Ask
from assoc_hull.variation.carrying.apply import apply
from assoc_hull.variation.fields.space_map import VMap
from assoc_hull.variation.notes import shifted_without_body
from assoc_hull.variation.parameters.read_parent import parent_of
from assoc_hull.variation.shifts.elements import Elements
from assoc_hull.variation.shifts.newton import Aim
from assoc_hull.variation.shifts.parent import elements_of, terminals_of, values_of
from assoc_hull.variation.shifts.shift_request import BODIES, CENTRES, SIZES, ShiftAsk
from assoc_hull.variation.shifts.shift_terms import ShiftTerms, Terminals
from assoc_hull.variation.shifts.sums import Sums
from assoc_hull.variation.shifts.tasks import Bodies, Task, Whole
from assoc_hull.variation.vary import vary_document

__all__ = ["ShiftWork"]

_LEVEL = 1e-9
"""Of the mean section: areas that differ by less are alike."""


@attrs.frozen(eq=False)
class ShiftWork:
    """A shift in the making.

    Attributes
    ----------
    state : HullState
        Tables of the parent; nothing is written to them.
    measured : HullState
        Those of the hull whose sections shift: the parent, or that with other dimensions.
    dimensions : mapping of str to float
        Named parameters, m, that the parent is given before.
    ask : ShiftAsk
        What is asked for.
    terms : ShiftTerms
        What sections move by.
    names : (str, str)
        The two values that sizes are sought for, asked for or held.
    now : (2,)
        What they are on the measured hull.
    elements, sums
        Of its curve of areas.
    notes : tuple of str
        What stands for the parallel body where there is none.
    """

    state: HullState
    measured: HullState
    dimensions: Mapping[str, float]
    ask: ShiftAsk
    terms: ShiftTerms
    names: tuple[str, str]
    now: FloatArray
    elements: Elements
    sums: Sums
    notes: tuple[str, ...]

    @classmethod
    def of(
        cls, state: HullState, ask: ShiftAsk, dimensions: Mapping[str, float] | None = None
    ) -> ShiftWork:
        """Measure the parent.

        Raises
        ------
        BadInputError
            It has not what is asked for.
        """
        measured = _scaled(state, dimensions) if dimensions else state
        parent = parent_of(measured)
        terms = _terms(terminals_of(parent, ask.terminals), ask)
        names = BODIES if ask.by_body else (_of(ask, SIZES), _of(ask, CENTRES))
        elements = elements_of(measured, terms)
        sums = Sums.of(elements, terms)
        _refuse_level(terms, elements, sums)
        return cls(
            state, measured, dimensions or {}, ask, terms, names, values_of(measured, names),
            elements, sums,
            () if ask.terminals else shifted_without_body(parent),
        )  # fmt: skip

    @property
    def asked(self) -> FloatArray:
        """What the two values are to be, (2,)."""
        pairs = zip(self.names, self.now.tolist(), strict=True)
        return np.array([self.ask.asked(name, now) for name, now in pairs])

    @property
    def scale(self) -> FloatArray:
        """What misses are told in parts of, (2,): a volume itself, Lpp for a centre."""
        whole = {"lcb": self.measured.particulars.length, "lcb_percent": 100.0}
        pairs = zip(self.names, self.now.tolist(), strict=True)
        return np.array([whole.get(name, now) for name, now in pairs])

    @property
    def task(self) -> Task:
        """What the closed form is asked for."""
        first, second = ((self.asked - self.now) / self.scale).tolist()
        if self.ask.by_body:
            prism = self.elements.total / float(self.now.sum())
            fore, aft = (self.asked - self.now).tolist()
            return Bodies(self.elements, self.sums, prism, fore, aft)
        cb = values_of(self.measured, ["cb"])[0] if self.names[0] != "cb" else self.now[0]
        block, length = self.elements.total / float(cb), self.measured.particulars.length
        return Whole(self.elements, self.sums, block, length, first * float(cb), 100.0 * second)

    @property
    def aim(self) -> Aim:
        """What Newton's rule is to reach."""
        return Aim(self.names, self.asked, self.scale, self._slopes)

    def _slopes(self, sizes: FloatArray) -> FloatArray:
        """Give the derivatives of the two values by the sizes there, by the closed form."""
        if self.ask.by_body:
            return np.asarray((self.now / self.elements.bodies)[:, None] * self.sums.by_body)
        volume, moment = self.sums.volume_at(sizes), self.sums.moment_at(sizes)
        by_volume, by_moment = self.sums.jacobian(sizes)
        by_centre = (by_moment - moment / volume * by_volume) / volume
        length = self.measured.particulars.length
        return np.array([
            self.now[0] / self.elements.total * by_volume, by_centre * self.scale[1] / length
        ])  # fmt: skip

    def variation(self, sizes: FloatArray) -> Ask:
        """Give the shift of sizes (2,), m, as a variation by raw layers."""
        return Ask.of(
            self.dimensions, layers=[self.terms.data(*sizes.tolist())],
            tolerance=self.ask.tolerance, name=self.ask.name,
        )  # fmt: skip

    def values(self, sizes: FloatArray) -> FloatArray:
        """Give the two values, (2,), of the hull that is shifted by sizes (2,), m."""
        ask, trial = self.variation(sizes), Document(copy_of(self.state))
        if self.dimensions:
            vary_document(trial, ask)
        else:
            with Transaction(trial, ask.name) as edit:
                apply(edit, VMap(ask.layers), follow=True, tolerance=ask.tolerance)
        return values_of(trial.state, self.names)


def _scaled(state: HullState, dimensions: Mapping[str, float]) -> HullState:
    """Give the tables of a hull with other dimensions."""
    trial = Document(copy_of(state))
    vary_document(trial, Ask.of(dimensions))
    return trial.state


def _terms(at: Terminals, ask: ShiftAsk) -> ShiftTerms:
    """Give what sections move by, with the ends of the parallel body where they are to be."""
    start = ask.asked("parallel_body_start", at.start) - at.start
    end = ask.asked("parallel_body_end", at.end) - at.end
    return ShiftTerms(at, ask.shape, start, end, ask.fade)


def _refuse_level(terms: ShiftTerms, elements: Elements, sums: Sums) -> None:
    """Refuse terminals between which areas are alike: no shift changes anything there."""
    at = terms.terminals
    for gain, low, high in zip(
        sums.alpha.tolist(), (at.end, at.aft), (at.fore, at.start), strict=True
    ):
        if abs(gain) <= _LEVEL * elements.total / (at.fore - at.aft):
            raise BadInputError(
                f"the sections from {low:g} to {high:g} m are all alike, or there are none",
                "in shift_sections", "set the terminals elsewhere",
            )  # fmt: skip


def _of(ask: ShiftAsk, alike: tuple[str, ...]) -> str:
    """Give the one of some names that is asked for; the first, which is held, if none is."""
    return next((name for name in ask.names if name in alike), alike[0])
