"""Shift the sections of a hull to asked values, and swing breadth against draught.

Values, curve of areas and terminals are measured on the hull. The curve of areas of a net that is
lofted again through moved stations is not the moved curve, by some 1e-5, so the sizes c_f and c_a
(m, + forward) are corrected on the hull's hydrostatics to 1e-10. The result is published as a
variation by raw layers, so a script repeats it.

Swinging: breadth against draught at the same volume and block coefficient.

    L' B' T' = L B T        x' = x L'/L    y' = y B'/B    z' = z T'/T

An affine map: volume, CB, CP, CM, CW and LCB / L of the exact image are those of the parent. A
spline through mapped points is not the mapped spline, by 1e-6 of the volume; a small shift of
sections takes that away.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence

import attrs
import numpy as np

from assoc_hull.analysis.form.form_parameters import form_parameters
from assoc_hull.analysis.hydrostatics.flotation import flotation
from assoc_hull.analysis.hydrostatics.hull_hydrostatics import hydrostatics
from assoc_hull.analysis.hydrostatics.section_areas import area_curve
from assoc_hull.arguments import positive, text
from assoc_hull.display import ShownAsText
from assoc_hull.edit.document import Document
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.model.tables import HullState, copy_state
from assoc_hull.variation.carrying.carry_hull import apply_map
from assoc_hull.variation.certificate.fold_check import MARGIN
from assoc_hull.variation.fields.space_map import VariationMap
from assoc_hull.variation.parameters.parameter_fields import shift_terminals
from assoc_hull.variation.parameters.parameter_measures import measure_all
from assoc_hull.variation.parameters.parent import Parent, parent_of
from assoc_hull.variation.request import VariationRequest
from assoc_hull.variation.shifts.closed_form import (
    CertifiedShift,
    HalfBodyTask,
    ShiftTask,
    WholeHullTask,
    certify_shift,
    closed_form,
)
from assoc_hull.variation.shifts.shift_terms import (
    BODIES,
    CENTRES,
    ENDS,
    SIZES,
    ShiftRequest,
    ShiftTerms,
    Terminals,
)
from assoc_hull.variation.shifts.shifted_areas import ShiftSums, VolumeElements
from assoc_hull.variation.vary import (
    Target,
    VariationReport,
    shifted_without_body,
    vary_document,
)

__all__ = [
    "MET",
    "SWUNG",
    "ShiftReport",
    "ShiftWork",
    "SizeStep",
    "SoughtValues",
    "elements_of",
    "shift_document",
    "solve_sizes",
    "swing_document",
    "swung_dimensions",
    "terminals_of",
    "values_of",
]

_WHERE = "in shift_sections"


@attrs.frozen
class _Tables:
    """Tables of a hull, in the form that is measured."""

    state: HullState


def values_of(state: HullState, names: Sequence[str]) -> FloatArray:
    """Give values of a hull at its design draught, upright.

    Parameters
    ----------
    state : HullState
        The tables.
    names : sequence of str
        Fields of `Hydrostatics`, or form parameters ``Cpf`` and ``Cpa``.

    Returns
    -------
    (n,)

    Raises
    ------
    BadInputError
        The hull has no such value.
    """
    hull = _Tables(state)
    if all(name in BODIES for name in names):
        forms = form_parameters(hull, only=names)
        found = [forms[name].number for name in names]
    else:
        record = hydrostatics(hull, estimate=False, on_error="report")
        found = [getattr(record, name) for name in names]
    for name, value in zip(names, found, strict=True):
        if value is None:
            raise BadInputError(f"the hull has no {name}", _WHERE, "look at its hydrostatics")
    return np.array(found, np.float64)


def elements_of(state: HullState, terms: ShiftTerms) -> VolumeElements:
    """Give the curve of areas of a hull at its design draught as elements of volume."""
    ship = state.particulars
    curve = area_curve(
        flotation(state), FloatingPlanes(np.array([ship.draught]), np.zeros(1), np.zeros(1))
    )  # fmt: skip
    inside = terms.nodes[(terms.nodes > curve.low) & (terms.nodes < curve.high)]
    ends = np.array([curve.low, curve.high])
    return VolumeElements.of(
        curve.at, np.concatenate([ends, curve.breaks, inside]), 0.5 * ship.length
    )  # fmt: skip


def terminals_of(parent: Parent, asked: Terminals | None) -> Terminals:
    """Give the terminals that are asked for, or those measured on a hull.

    Raises
    ------
    BadInputError
        The hull has none in order, and none are given.
    """
    if asked is not None:
        return asked
    return Terminals.of(shift_terminals(parent, "section shifts"))


# --------------------------------------------------------------------------------------
# Newton's method. The derivatives are those of the closed form, so near to those of the hull that
# every step leaves a part of 1e-3 or less of the residual.

MET = 1e-10
"""Residual that is promised: of a volume relative, of a centre in parts of Lpp."""

_ENOUGH = 1e-12
"""Residual at which steps end; rounding seldom allows less."""

_MOST = 10


@attrs.frozen(eq=False)
class SizeStep:
    """A step of Newton's method.

    Attributes
    ----------
    sizes : (float, float), m
        c_f and c_a.
    residual : float
        The larger of the two: of a volume relative, of a centre in parts of Lpp.
    """

    sizes: tuple[float, float]
    residual: float


@attrs.frozen(eq=False)
class SoughtValues:
    """Two values of a hull that are to be had.

    Attributes
    ----------
    names : (str, str)
    asked : (2,)
    scale : (2,)
        Residuals are parts of it.
    slopes : callable
        From sizes (2,), m, to the derivatives (2, 2) of both values by c_f and c_a.
    """

    names: tuple[str, str]
    asked: FloatArray
    scale: FloatArray
    slopes: Callable[[FloatArray], FloatArray]


def solve_sizes(
    aim: SoughtValues, values: Callable[[FloatArray], FloatArray], sizes: FloatArray
) -> tuple[FloatArray, tuple[SizeStep, ...]]:
    """Find the sizes whose hull has two asked values.

    Parameters
    ----------
    aim : SoughtValues
    values : callable
        From sizes (2,), m, to the values (2,) that the hull then has.
    sizes : (2,), m
        To begin with.

    Returns
    -------
    sizes : (2,), m
    steps : tuple of SizeStep
        The first is the start.

    Raises
    ------
    BadInputError
        The values do not come within 1e-10.
    """
    steps, best, left = list[SizeStep](), sizes, np.inf
    while len(steps) < _MOST and left > _ENOUGH:
        missed = (values(sizes) - aim.asked) / aim.scale
        residual = float(np.abs(missed).max())
        steps.append(SizeStep((float(sizes[0]), float(sizes[1])), residual))
        # what is promised is met and rounding decides from here on
        if residual >= left and left <= MET:
            break
        if residual < left:
            best, left = sizes, residual
        sizes = sizes - np.linalg.solve(aim.slopes(sizes) / aim.scale[:, None], missed)
    if left > MET:
        raise BadInputError(
            f"{' and '.join(aim.names)} come to within {left:.2g} only", "in shift_sections",
            "give a finer or a coarser tolerance, or another shape",
        )  # fmt: skip
    return best, tuple(steps)


# --------------------------------------------------------------------------------------
# One shift at work: present values, closed form, trials.

_LEVEL = 1e-9
"""Areas that differ by less than this part of the mean section are alike."""


@attrs.frozen(eq=False)
class ShiftWork:
    """One shift of a hull at work.

    Attributes
    ----------
    state : HullState
        Tables of the parent; nothing is written to them.
    measured : HullState
        Those of the hull whose sections shift: the parent, or that with other dimensions.
    dimensions : mapping of str to float
        Named parameters, m, that the parent is given before.
    ask : ShiftRequest
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
    ask: ShiftRequest
    terms: ShiftTerms
    names: tuple[str, str]
    now: FloatArray
    elements: VolumeElements
    sums: ShiftSums
    notes: tuple[str, ...]

    @classmethod
    def of(
        cls, state: HullState, ask: ShiftRequest, dimensions: Mapping[str, float] | None = None
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
        sums = ShiftSums.of(elements, terms)
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
        """What residuals are parts of, (2,): a volume itself, Lpp for a centre."""
        whole = {"lcb": self.measured.particulars.length, "lcb_percent": 100.0}
        pairs = zip(self.names, self.now.tolist(), strict=True)
        return np.array([whole.get(name, now) for name, now in pairs])

    @property
    def task(self) -> ShiftTask:
        """What the closed form is asked for."""
        first, second = ((self.asked - self.now) / self.scale).tolist()
        if self.ask.by_body:
            prism = self.elements.total / float(self.now.sum())
            fore, aft = (self.asked - self.now).tolist()
            return HalfBodyTask(self.elements, self.sums, prism, fore, aft)
        cb = values_of(self.measured, ["cb"])[0] if self.names[0] != "cb" else self.now[0]
        block, length = self.elements.total / float(cb), self.measured.particulars.length
        return WholeHullTask(
            self.elements, self.sums, block, length, first * float(cb), 100.0 * second
        )

    @property
    def aim(self) -> SoughtValues:
        """What Newton's method is to reach."""
        return SoughtValues(self.names, self.asked, self.scale, self._slopes)

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

    def variation(self, sizes: FloatArray) -> VariationRequest:
        """Give the shift of sizes (2,), m, as a variation by raw layers."""
        return VariationRequest.of(
            self.dimensions, layers=[self.terms.data(*sizes.tolist())],
            tolerance=self.ask.tolerance, accept=True, name=self.ask.name,
        )  # fmt: skip

    def values(self, sizes: FloatArray) -> FloatArray:
        """Give the two values, (2,), of the hull that is shifted by sizes (2,), m."""
        ask, trial = self.variation(sizes), Document(copy_state(self.state))
        if self.dimensions:
            vary_document(trial, ask)
        else:
            with Transaction(trial, ask.name) as edit:
                apply_map(edit, VariationMap(ask.layers), follow=True, tolerance=ask.tolerance)
        return values_of(trial.state, self.names)


def _scaled(state: HullState, dimensions: Mapping[str, float]) -> HullState:
    """Give the tables of a hull with other dimensions."""
    trial = Document(copy_state(state))
    vary_document(trial, VariationRequest.of(dimensions, accept=True))
    return trial.state


def _terms(at: Terminals, ask: ShiftRequest) -> ShiftTerms:
    """Give what sections move by, with the ends of the parallel body where they are to be."""
    start = ask.asked("parallel_body_start", at.start) - at.start
    end = ask.asked("parallel_body_end", at.end) - at.end
    return ShiftTerms(at, ask.shape, start, end, ask.fade)


def _refuse_level(terms: ShiftTerms, elements: VolumeElements, sums: ShiftSums) -> None:
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


def _of(ask: ShiftRequest, alike: tuple[str, ...]) -> str:
    """Give the one of some names that is asked for; the first, which is held, if none is."""
    return next((name for name in ask.names if name in alike), alike[0])


# --------------------------------------------------------------------------------------
# The shift as a step of the hull's history.

_UNITS = {"volume": "m3", "lcb": "m", "lcb_percent": "% Lpp"}


@attrs.frozen(eq=False, repr=False)
class ShiftReport(ShownAsText):
    """What a shift of sections did.

    Attributes
    ----------
    targets : tuple of Target
        What was asked for or held: value before, asked, reached.
    shift : CertifiedShift
        The movement along the ship: terminals, sizes c_f and c_a, least 1 + delta', largest
        movement; `shift.moved` gives it at any x of the parent.
    steps : tuple of SizeStep
        Of Newton's method on the hydrostatics of the varied hull; the first is the closed form.
    variation : VariationReport
        What changed on the hull, as of any variation.
    notes : tuple of str
        What else there is to know.
    """

    targets: tuple[Target, ...]
    shift: CertifiedShift
    steps: tuple[SizeStep, ...]
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
        """The residual reached: of volumes relative, of centres in parts of Lpp."""
        return min(each.residual for each in self.steps)

    @property
    def told(self) -> tuple[str, ...]:
        """What was reached, by which movement, and how, in lines."""
        at = self.shift.terms.terminals
        return (
            *(str(each).removesuffix(" -") for each in self.targets),
            f"shape {self.shift.terms.shape}, terminals {at.aft:.6g}, {at.start:.6g}, "
            f"{at.end:.6g}, {at.fore:.6g} m; c_f {self.fore:+.6g} m, c_a {self.aft:+.6g} m",
            f"largest movement {self.shift.largest:.4g} m, lengths between sections at least "
            f"{self.shift.least:.4f} times as before",
            f"closed form {self.steps[0].residual:.1e} off, after {len(self.steps) - 1} steps "
            f"{self.residual:.1e}",
            *self.notes,
        )  # fmt: skip

    def __str__(self) -> str:
        return "\n".join([*self.told, *self.variation.notes, str(self.variation.edit)])


def shift_document(
    document: Document, ask: ShiftRequest, dimensions: Mapping[str, float] | None = None
) -> tuple[VariationMap, ShiftReport]:
    """Shift the sections of a hull in place, as one step that can be undone.

    Parameters
    ----------
    document : Document
        The hull.
    ask : ShiftRequest
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
    sizes, steps = solve_sizes(work.aim, work.values, start.sizes)
    before = values_of(document.state, work.names)
    vmap, report = vary_document(document, work.variation(sizes))
    shift = CertifiedShift(work.terms, sizes, certify_shift(work.terms, sizes, MARGIN))
    found = before, values_of(document.state, work.names)
    return vmap, ShiftReport(_targets(work, *found, shift), shift, steps, report, work.notes)


def _targets(
    work: ShiftWork, before: FloatArray, reached: FloatArray, shift: CertifiedShift
) -> tuple[Target, ...]:
    """Report the two values that were sought, and ends of the parallel body that moved."""
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


SWUNG = ("length", "breadth", "draught")
"""The dimensions whose product is held."""

_IN_SWING = "in swing"


def swung_dimensions(
    now: Mapping[str, float], asked: Mapping[str, float | None]
) -> dict[str, float]:
    """Give all dimensions of a hull that is swung.

    Parameters
    ----------
    now : mapping of str to float
        Present ``length``, ``breadth``, ``draught`` and ``depth``, m.
    asked : mapping of str to float or None
        One or two of the first three, m. What is not asked for gives way: breadth to draught
        and draught to breadth; with a length alone, both in one ratio.

    Returns
    -------
    dict
        Dimensions that are to be had, m; the depth goes with the draught.

    Raises
    ------
    BadInputError
        None of them is asked for, or all three; one is no positive number.

    Examples
    --------
    >>> from assoc_hull.variation.shifts.shift_hull import swung_dimensions
    >>> now = {"length": 100.0, "breadth": 10.0, "draught": 6.0, "depth": 9.0}
    >>> swung_dimensions(now, {"breadth": 12.0})
    {'breadth': 12.0, 'draught': 5.0, 'depth': 7.5}
    """
    given = {
        name: positive(asked[name], name, _IN_SWING)
        for name in SWUNG
        if asked.get(name) is not None
    }
    if not given or len(given) == len(SWUNG):
        word = "all" if given else "none"
        raise BadInputError(
            f"{word} of {', '.join(SWUNG)} are given", _IN_SWING,
            "give one or two of them: the others hold the volume",
        )  # fmt: skip
    ratio = {name: value / now[name] for name, value in given.items()}
    free = _free(given)
    left = 1.0 / math.prod(ratio.values())
    for name in free:
        ratio[name] = left if len(free) == 1 else math.sqrt(left)
    found = {
        name: given.get(name, now[name] * ratio[name]) for name in SWUNG if name in ratio
    }  # fmt: skip
    found["depth"] = now["depth"] * (found["draught"] / now["draught"])
    return found


def _free(given: Mapping[str, float]) -> tuple[str, ...]:
    """Give what gives way."""
    if len(given) == 2:
        return tuple(name for name in SWUNG if name not in given)
    others = {"breadth": ("draught",), "draught": ("breadth",), "length": ("breadth", "draught")}
    return others[next(iter(given))]


_HELD = ("volume", "lcb_percent")


def swing_document(
    document: Document, asked: Mapping[str, float | None], name: str | None = None
) -> tuple[VariationMap, ShiftReport]:
    """Swing a hull in place, as one step that can be undone.

    Parameters
    ----------
    document : Document
        The hull.
    asked : mapping of str to float or None
        One or two of `SWUNG`, m.
    name : str or None
        Of the step in the history.

    Raises
    ------
    BadInputError, OutOfRangeError, FoldError, RefusedEditError
        What is asked for cannot be had; the hull is unchanged.
    """
    values = swung_dimensions(_dimensions(document.state), asked)
    words = ", ".join(f"{key}={values[key]:g}" for key in SWUNG if key in values)
    title = f"swing {words}" if name is None else text(name, "the name", _IN_SWING)
    held = dict(zip(_HELD, values_of(document.state, _HELD).tolist(), strict=True))
    return shift_document(document, ShiftRequest.of(held, name=title), values)


def _dimensions(state: HullState) -> dict[str, float]:
    """Give the dimensions as they are stored, but the depth as it is measured."""
    ship, measured = state.particulars, measure_all(state, ["depth"])
    return {
        "length": ship.length, "breadth": ship.breadth, "draught": ship.draught,
        "depth": measured.get("depth", ship.depth),
    }  # fmt: skip
