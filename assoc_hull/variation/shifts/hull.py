"""Sections of a hull are shifted: closed form, Newton on the hull's own hydrostatics, one step."""

from __future__ import annotations

from collections.abc import Mapping

import attrs
import numpy as np

from assoc_hull.edit.document import Document
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.certificate.certify import MARGIN
from assoc_hull.variation.fields.space_map import VMap
from assoc_hull.variation.shifts.closed_form import Shift, certified, closed_form
from assoc_hull.variation.shifts.newton import Step, settle
from assoc_hull.variation.shifts.parent import values_of
from assoc_hull.variation.shifts.shift_request import ENDS, ShiftAsk
from assoc_hull.variation.shifts.trials import ShiftWork
from assoc_hull.variation.vary import Target, VariationReport, vary_document

__all__ = ["ShiftReport", "shift_document"]

_UNITS = {"volume": "m3", "lcb": "m", "lcb_percent": "% Lpp"}


@attrs.frozen(eq=False)
class ShiftReport:
    """What a shift of sections did.

    Attributes
    ----------
    targets : tuple of Target
        What was asked for or held: value before, asked, reached.
    shift : Shift
        The movement along the ship: terminals, sizes c_f and c_a, least 1 + delta', largest
        movement; `shift.moved` gives it at any x of the parent.
    steps : tuple of Step
        Of Newton's rule on the hydrostatics of the varied hull; the first is the closed form.
    variation : VariationReport
        What changed on the hull, as of any variation.
    notes : tuple of str
        What else there is to know.
    """

    targets: tuple[Target, ...]
    shift: Shift
    steps: tuple[Step, ...]
    variation: VariationReport
    notes: tuple[str, ...] = ()

    @property
    def fore(self) -> float:
        """c_f: size of the fore shape, m, + forward."""
        return float(self.shift.sizes[0])

    @property
    def aft(self) -> float:
        """c_a: size of the after shape, m, + forward."""
        return float(self.shift.sizes[1])

    @property
    def residual(self) -> float:
        """The largest miss: of volumes relative, of centres in parts of Lpp."""
        return min(each.residual for each in self.steps)

    @property
    def told(self) -> tuple[str, ...]:
        """What was reached, by which movement, and how, in lines."""
        at = self.shift.terms.terminals
        return (
            *(str(each).removesuffix(" -") for each in self.targets),
            f"shape {self.shift.terms.shape}, terminals {at.aft:.6g}, {at.start:.6g}, "
            f"{at.end:.6g}, {at.fore:.6g} m; c_f {self.fore:+.6g} m, c_a {self.aft:+.6g} m",
            f"largest movement {self.shift.largest:.4g} m, least 1+delta' {self.shift.least:.4f}",
            f"closed form {self.steps[0].residual:.1e} off, after {len(self.steps) - 1} steps "
            f"{self.residual:.1e}",
            *self.notes,
        )  # fmt: skip

    def __str__(self) -> str:
        return "\n".join([*self.told, *self.variation.notes, str(self.variation.edit)])


def shift_document(
    document: Document, ask: ShiftAsk, dimensions: Mapping[str, float] | None = None
) -> tuple[VMap, ShiftReport]:
    """Shift the sections of a hull in place, as one step that can be undone.

    Parameters
    ----------
    document : Document
        The hull.
    ask : ShiftAsk
        What is asked for.
    dimensions : mapping of str to float or None
        Named parameters, m, that the hull is given before.

    Raises
    ------
    BadInputError, OutOfRangeError, FoldError, RefusedEditError
        What is asked for cannot be had; the hull is unchanged.
    """
    work = ShiftWork.of(document.state, ask, dimensions)
    start = closed_form(work.task, work.terms, MARGIN)
    sizes, steps = settle(work.aim, work.values, start.sizes)
    before = values_of(document.state, work.names)
    vmap, report = vary_document(document, work.variation(sizes))
    shift = Shift(work.terms, sizes, certified(work.terms, sizes, MARGIN))
    found = before, values_of(document.state, work.names)
    return vmap, ShiftReport(_targets(work, *found, shift), shift, steps, report, work.notes)


def _targets(
    work: ShiftWork, before: FloatArray, reached: FloatArray, shift: Shift
) -> tuple[Target, ...]:
    """Tell of the two values that were sought, and of ends of the parallel body that moved."""
    found = [
        Target(name, _UNITS.get(name, "-"), *numbers)
        for name, *numbers in zip(
            work.names, before.tolist(), work.asked.tolist(), reached.tolist(), strict=True
        )
    ]  # fmt: skip
    at = work.terms.terminals
    for name, now in zip(ENDS, (at.start, at.end), strict=True):
        if name in work.ask.names:
            moved = now + float(shift.moved(np.array([now]))[0])
            found.append(Target(name, "m", now, work.ask.asked(name, now), moved))
    return tuple(found)
