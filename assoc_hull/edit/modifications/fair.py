"""Fairing: noise is taken out of all lines at once, or of some of them, or in a window.

The points that carry the shape move along their own freedom, and no farther than the noise that is
stated allows; what is placed, a flat, a feature or on the profile stays, and what is computed
follows. Each move counts from the value that a point was given, not from where fairing took it
last: to fair twice is to fair once. The net is moved as by a pull, in one field.
"""

from __future__ import annotations

import contextlib
from collections.abc import Collection, Mapping
from typing import Literal

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.fairness.batten_problem import BattenProblem
from assoc_hull.analysis.fairness.fair_solution import (
    FairSolution,
    estimate_noise,
    hold_sums,
    linear_algebra,
    solve_battens,
)
from assoc_hull.analysis.fairness.rounding_unit import rounding_noise, rounding_unit
from assoc_hull.analysis.hydrostatics.flotation import (
    EvenKeelDisplacement,
    even_keel_displacement,
)
from assoc_hull.arguments import small_length
from assoc_hull.edit.displacement_field import SolvedField, quintic_fade
from assoc_hull.edit.document import Document
from assoc_hull.edit.field_moves import FieldMoves
from assoc_hull.edit.net_battens import net_battens, reasons_to_stay, volume_weights
from assoc_hull.edit.past_states import PastStates
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.model.address import address
from assoc_hull.model.tables import HullState

__all__ = [
    "BoundPoint",
    "FairRequest",
    "Faired",
    "GivenBattens",
    "Held",
    "Noise",
    "TakenBack",
    "fair",
    "given_values",
    "solve_fair",
    "table_unit",
    "tolerances_of",
    "window_fade",
]

_WHERE = "in fair"

Noise = float | Literal["auto"] | None
Held = Literal["volume", "lcb"]

_SIGMAS = 3.0
"""A point may move by so many times the noise if no tolerance is given."""

_INSIDE = 1e-3
"""A window holds the points where its fade is more than this."""

_DIGIT = 1e-6
"""Displacements are whole micrometres: the last bits of a solution must not show."""

_FINE_DIGIT = 1e-9
"""Where sums are held: a micrometre too much at each point would show in them."""

_LIKELY = 0.25
"""Lines that look so much fairer than rounding leaves them were not rounded: values of a formula
may be short numbers by themselves."""

_MEDIAN_POINTS, _LEAST_RESIDUALS = 12, 100
"""Lines and nets with fewer points do not tell noise from shape."""

_TAKEN = 1e-5
"""Times `Tolerances.factor`: a given value that an edit changed by more (m) is told."""

_NAMED = 5
"""So many points a message names."""

_HOLDS, _VOLUME_OFF, _LCB_OFF = 6, 1e-8, 1e-6
"""So often sums are corrected; a part of the volume, and m."""


# --------------------------------------------------------------------------------------
# What is asked for, and what came of it.


@attrs.frozen(eq=False)
class FairRequest:
    """What is to be faired, checked.

    Attributes
    ----------
    noise : float, "auto" or None, m
        The noise along the freedom of the points; None: that of the source, if it is known.
    lines : (k,) int or None
        Lines whose points may move; None: all.
    tolerance : float or None, m
        How far each point may move along its freedom; None: three times the noise.
    lines_within, points_within : mapping of int to float, m
        Tolerances of lines and of points.
    at, radius : (3,), (float, float), m, or None
        The middle of a window, and how far it reaches along the length and the girth.
    keep : frozenset of int
        Points that stay.
    hold : tuple of "volume" or "lcb"
        What the hull is to have as before.
    since : str or None
        A checkpoint: points were given where they were then.
    """

    noise: Noise = None
    lines: IntArray | None = None
    tolerance: float | None = None
    lines_within: Mapping[int, float] = attrs.field(factory=dict)
    points_within: Mapping[int, float] = attrs.field(factory=dict)
    at: FloatArray | None = None
    radius: tuple[float, float] | None = None
    keep: frozenset[int] = frozenset()
    hold: tuple[Held, ...] = ()
    since: str | None = None


@attrs.frozen
class BoundPoint:
    """A point that fairing would have moved farther than its tolerance.

    Attributes
    ----------
    point : str
        Its address.
    given, now : (float, float, float), m
        The place that was given for it, and where it came to lie.
    tolerance : float, m
        How far it may move along its freedom.
    """

    point: str
    given: tuple[float, float, float]
    now: tuple[float, float, float]
    tolerance: float


@attrs.frozen
class TakenBack:
    """A point that an edit had moved since the checkpoint that fairing counts from.

    Attributes
    ----------
    point : str
        Its address.
    distance : float, m
        How far edits had moved it.
    """

    point: str
    distance: float


@attrs.frozen(eq=False)
class Faired:
    """What fairing has found; the edit carries it out.

    Attributes
    ----------
    noise : float, m
        The noise that was taken out, as a standard deviation along the freedom of the points.
    source : str
        Where that number comes from.
    unknowns, residuals : int
        Points that could move, and places at which battens were looked at.
    moved_rms, moved_95, moved_largest : float, m
        How far they move along the normal of the hull, from the values that were given for them.
    largest_at : str
        Address of the one that moves farthest; empty if none moves.
    at_bound : tuple of BoundPoint
        Those that end at their tolerance.
    stayed : mapping of str to int
        How many points could not move, by reason.
    taken_back : tuple of TakenBack
        Points that edits had moved since the checkpoint, and that count from where they were
        then, the farthest first.
    taken_back_edits : tuple of str
        Names of the edits since then that were not fairing.
    problem : BattenProblem
        The residuals about the given values; only the points that could move are in it.
    """

    noise: float
    source: str
    unknowns: int
    residuals: int
    moved_rms: float
    moved_95: float
    moved_largest: float
    largest_at: str
    at_bound: tuple[BoundPoint, ...]
    stayed: Mapping[str, int]
    taken_back: tuple[TakenBack, ...] = ()
    taken_back_edits: tuple[str, ...] = ()
    problem: BattenProblem = attrs.field(repr=False, kw_only=True)

    @property
    def note(self) -> str:
        """What the history tells of it, in a line."""
        moved = f"rms {1e3 * self.moved_rms:.2f} mm, largest {1e3 * self.moved_largest:.2f} mm"
        return (
            f"faired by a noise of {1e3 * self.noise:.3g} mm, {self.source}: "
            f"{self.unknowns} points could move, {moved}"
        )

    def estimated_noise(self, factor: float = 1.0) -> float:
        """Estimate the noise of the points that could move from their lines, m."""
        return estimate_noise(self.problem, factor)


# --------------------------------------------------------------------------------------
# The problem that is solved.


@attrs.frozen(eq=False)
class GivenBattens:
    """A problem about the given values of its points.

    Attributes
    ----------
    problem : BattenProblem
        About them.
    present : (k,), m
        Where the points are now, along the normal from there.
    offset : (k, 3), m
        The same in space.
    share : (k,) or None
        By what the noise of each is multiplied.
    kept : int
        Points that stay as they were named.
    """

    problem: BattenProblem
    present: FloatArray
    offset: FloatArray
    share: FloatArray | None
    kept: int


def fair(edit: Transaction, asked: FairRequest) -> Faired:
    """Find how a hull is fair within its noise, and ask for it.

    Raises
    ------
    BadInputError
        Nothing can move, the noise is not known or cannot be told, a tolerance is too small for
        the noise, or volume and centre cannot be held.
    RefusedEditError
        The hull that is tried to hold them would be refused.
    """
    before = edit.pending.asked(FieldMoves)
    if before is not None and before.faired:
        # Each is solved for the published hull: together they would move it twice.
        what = "fairing is asked for twice in one edit"
        raise BadInputError(what, _WHERE, "name all lines in one call, or use two edits")
    found, rows, delta, more = solve_fair(edit.document, asked)
    if len(rows):
        moves = edit.pending.ask(FieldMoves)
        moves.fields.append(SolvedField(rows, delta))
        moves.faired.append((rows, more))
        edit.pending.notes.append(found.note)
    return found


def solve_fair(
    document: Document, asked: FairRequest
) -> tuple[Faired, IntArray, FloatArray, FloatArray]:
    """Solve for the published hull: what was found, the points, by how much they move, m.

    Given last is by how much each is farther from its given value then, (k, 3), m.
    """
    state = document.state.published()
    given = given_values(document, asked)
    with linear_algebra().limit(limits=1):
        noise, source = _noise(state, given.problem, asked.noise)
        within = tolerances_of(state, given.problem, asked, noise)
        limit = within * given.problem.freedom
        solution = solve_battens(given.problem, noise, given.share, limit)
    digit = (_FINE_DIGIT if asked.hold else _DIGIT) * state.tolerances.factor
    if asked.hold:
        solution = _held(document, given, solution, limit, digit, asked.hold)
    rows, delta, more = _displacements(state, given, solution, limit, digit)
    told = _told(state, given, solution, within, source)
    if asked.since is not None:
        told = attrs.evolve(
            told, taken_back=_taken_back(document, given.problem.rows, asked.since),
            taken_back_edits=_edits_since(document, asked.since),
        )  # fmt: skip
    return told, rows, delta, more


def _displacements(
    state: HullState, given: GivenBattens, solution: FairSolution, limit: FloatArray, digit: float
) -> tuple[IntArray, FloatArray, FloatArray]:
    """Give the points that move, by how much, and how much farther from the given values."""
    problem, present = given.problem, given.present
    step = np.round((solution.displacement - present) / digit) * digit
    bound = solution.side * limit - present
    step = np.where(solution.side, bound, np.clip(step, -limit - present, limit - present))
    delta = problem.moves * step[:, None]
    more = given.offset + delta - state.rows.faired.take(problem.rows)
    some = np.flatnonzero((delta != 0.0).any(axis=1) | (more != 0.0).any(axis=1))
    return problem.rows[some], delta[some], more[some]


def given_values(document: Document, asked: FairRequest) -> GivenBattens:
    """Put the problem together: who may move, from where, and by how much the noise counts."""
    state = document.state.published()
    whole = net_battens(state)
    chosen = np.ones(len(whole.rows), np.bool_)
    if asked.lines is not None:
        curve = state.rows.curve.data[whole.rows]
        line = np.where(curve >= 0, state.curves.line.data[np.maximum(curve, 0)], -1)
        chosen &= np.isin(line, asked.lines).any(axis=1)
    fade = None
    if asked.at is not None and asked.radius is not None:
        fade = window_fade(state, whole.rows, asked.at, asked.radius)
        chosen &= fade > _INSIDE
    kept = np.isin(whole.rows, sorted(asked.keep))
    _refuse_all_kept(state, whole.rows[chosen], kept[chosen])
    chosen &= ~kept
    places = np.flatnonzero(chosen)
    problem = whole if len(places) == len(chosen) else whole.part(places)
    if not len(problem.rows) or not len(problem.residual):
        raise BadInputError(
            "nothing to move", _WHERE,
            f"the points here stay: {_reasons(reasons_to_stay(state, asked.lines))}; "
            "name other lines, or a wider window",
        )  # fmt: skip
    offset = _offsets(document, problem.rows, asked.since)
    square = (problem.moves * problem.moves).sum(axis=1)
    present = (offset * problem.moves).sum(axis=1) / square
    if fade is None:
        return GivenBattens(problem.shifted(-present), present, offset, None, int(kept.sum()))
    share = fade[places]
    # The rim of a window stays where it is, its middle counts from what was given.
    middle = share[:, None] * offset
    present = (middle * problem.moves).sum(axis=1) / square
    return GivenBattens(problem.shifted(-present), present, offset, share, int(kept.sum()))


def _refuse_all_kept(state: HullState, rows: IntArray, kept: NDArray[np.bool_]) -> None:
    """Refuse to keep all the points that could move."""
    if len(rows) and kept.all():
        names = ", ".join(address(state, row) for row in rows[:_NAMED].tolist())
        more = f" and {len(rows) - _NAMED} more" if len(rows) > _NAMED else ""
        raise BadInputError(
            "nothing to move", _WHERE,
            f"keep names all {len(rows)} points that could move ({names}{more}); keep fewer",
        )  # fmt: skip


def window_fade(
    state: HullState, rows: IntArray, at: FloatArray, radius: tuple[float, float]
) -> FloatArray:
    """Give the fade of a window at points (k,): 1 in its middle, 0 at its rim."""
    step = state.rows.xyz[rows] - at
    girth = np.sqrt(step[:, 1] * step[:, 1] + step[:, 2] * step[:, 2])
    found: FloatArray = quintic_fade(step[:, 0] / radius[0]) * quintic_fade(girth / radius[1])
    return found


def _offsets(document: Document, rows: IntArray, since: str | None) -> FloatArray:
    """Give how far points (k,) lie from their given values, (k, 3), m."""
    state = document.state.published()
    if since is None:
        return state.rows.faired.take(rows)
    then = PastStates(document).at(document.labelled(since))
    # The tables of one hull number their points alike; what came later was given where it came.
    known = np.flatnonzero(rows < then.rows.count)
    known = known[then.rows.alive.data[rows[known]]]
    offset = np.array(state.rows.faired.take(rows))
    offset[known] = state.rows.xyz[rows[known]] - then.rows.xyz[rows[known]]
    return offset


def _taken_back(document: Document, rows: IntArray, since: str) -> tuple[TakenBack, ...]:
    """Give the points whose given values edits have changed since a checkpoint."""
    state = document.state.published()
    then = PastStates(document).at(document.labelled(since))
    known = rows[rows < then.rows.count]
    known = known[then.rows.alive.data[known]]
    now, was = (each.rows.xyz.data[known] - each.rows.faired.take(known) for each in (state, then))
    away = np.sqrt(((now - was) ** 2).sum(axis=1))
    order = np.argsort(-away, kind="stable")
    order = order[away[order] > _TAKEN * state.tolerances.factor]
    return tuple(TakenBack(address(state, int(known[i])), float(away[i])) for i in order.tolist())


def _edits_since(document: Document, since: str) -> tuple[str, ...]:
    """Name the edits since a checkpoint that were not fairing."""
    before = {step.number for step in document.path(document.labelled(since))}
    return tuple(
        step.report.name
        for step in document.history
        if step.number not in before
        and not (step.script.edits and all(each["op"] == "fair" for each in step.script.edits))
    )


# --------------------------------------------------------------------------------------
# Noise and tolerances.


def _noise(state: HullState, problem: BattenProblem, asked: Noise) -> tuple[float, str]:
    """Give the noise, m, and where the number comes from."""
    factor = state.tolerances.factor
    if asked == "auto":
        _refuse_few(state, problem)
        return estimate_noise(problem, factor), "estimated from the lines"
    if asked is not None:
        length = state.particulars.length
        return small_length(asked, "noise", _WHERE, length), "stated"
    unit, estimate = table_unit(state), None
    with contextlib.suppress(BadInputError):
        _refuse_few(state, problem)
        estimate = estimate_noise(problem, factor)
    if unit is not None and (estimate is None or estimate > _LIKELY * rounding_noise(unit)):
        return rounding_noise(unit), f"rounded to {1e3 * unit:.4g} mm"
    look = "" if estimate is None else f" (the lines look like {1e3 * estimate:.2g} mm)"
    raise BadInputError(
        f"the noise is not known{look}",
        _WHERE,
        "state it, noise=0.001 for 1 mm (in the shell --noise 1), or let it be estimated, "
        'noise="auto" (in the shell --noise auto)',
    )


def table_unit(state: HullState) -> float | None:
    """Give the unit to which the given values of a hull were rounded, m; None if none is seen.

    Half-breadths where sections cross waterlines are looked at, as a table of offsets has them.
    """
    curve = state.rows.curve.data
    live = np.flatnonzero(state.rows.alive.data & (curve >= 0).all(axis=1))
    names = [
        [state.family(state.line_of(each)).name for each in pair] for pair in curve[live].tolist()
    ]
    table = np.array([set(pair) == {"sections", "waterlines"} for pair in names], np.bool_)
    rows = live[table & (state.rows.reader.data[live] >= 0).all(axis=1)]
    y = state.rows.xyz[rows, 1] - state.rows.faired.take(rows)[:, 1]
    return rounding_unit(y, state.particulars.breadth)


def _refuse_few(state: HullState, problem: BattenProblem) -> None:
    """Refuse to tell noise from shape where there is too little to tell it by."""
    curves = np.unique(problem.curve).tolist()
    median = float(np.median([len(state.curves.rows.data[each]) for each in curves]))
    if median < _MEDIAN_POINTS or len(problem.residual) < _LEAST_RESIDUALS:
        raise BadInputError(
            f"too few points to tell noise from shape: the median line has {median:.0f}, and "
            f"battens are looked at in {len(problem.residual)} places", _WHERE,
            f"{_MEDIAN_POINTS} and {_LEAST_RESIDUALS} are needed; state the noise",
        )  # fmt: skip


def tolerances_of(
    state: HullState, problem: BattenProblem, asked: FairRequest, noise: float
) -> FloatArray:
    """Give how far each point may move along its freedom, m."""
    usual = _SIGMAS * noise if asked.tolerance is None else asked.tolerance
    within = np.full(len(problem.rows), usual)
    if asked.lines_within:
        curve = state.rows.curve.data[problem.rows]
        line = np.where(curve >= 0, state.curves.line.data[np.maximum(curve, 0)], -1)
        for each, value in asked.lines_within.items():
            on = (line == each).any(axis=1)
            within[on] = np.where(within[on] == usual, value, np.minimum(within[on], value))
    for row, value in asked.points_within.items():
        within[problem.rows == row] = value
    # A single point may be held tighter: of most of them it would only be cut off.
    narrow = float(np.median(within))
    if narrow < 0.5 * noise:
        raise BadInputError(
            f"the noise is {1e3 * noise:.4g} mm and the tolerance {1e3 * narrow:.4g} mm", _WHERE,
            f"most points would end at their bound; give {1e3 * noise:.4g} mm or more, "
            f"or a noise of {2e3 * narrow:.4g} mm or less",
        )  # fmt: skip
    return within


# --------------------------------------------------------------------------------------
# Volume and centre of buoyancy.


def _held(
    document: Document, given: GivenBattens, solution: FairSolution, limit: FloatArray,
    digit: float, hold: Collection[Held],
) -> FairSolution:  # fmt: skip
    """Correct a solution until the hull that it gives has the volume and centre of before."""
    state = document.state.published()
    before = even_keel_displacement(state)
    weight, x = volume_weights(state)
    sums = [given.problem.rates.T @ weight]
    lever = given.problem.rates.T @ (weight * (x - before.lcb))
    sums = ([sums[0]] if "volume" in hold else []) + ([lever] if "lcb" in hold else [])
    off = np.zeros(2)
    for _ in range(_HOLDS):
        after = _tried(document, _displacements(state, given, solution, limit, digit))
        off = np.array([after.volume / before.volume - 1.0, after.lcb - before.lcb])
        if all(_kept(name, off) for name in hold):
            return solution
        moment = after.volume * (after.lcb - before.lcb)
        errors = ([after.volume - before.volume] if "volume" in hold else []) + (
            [moment] if "lcb" in hold else []
        )
        if not (solution.side == 0).any():
            break
        solution = hold_sums(solution, np.array(sums), np.array(errors))
        d = np.clip(solution.displacement, -limit, limit)
        side = np.where(np.abs(d) >= limit, np.sign(d), 0.0).astype(np.int64)
        solution = attrs.evolve(solution, displacement=d, side=side)
    bound = np.flatnonzero(solution.side)
    rows = given.problem.rows[bound[:_NAMED]].tolist()
    names = ", ".join(address(state, row) for row in rows) + (" ..." if len(bound) > _NAMED else "")
    ends = f", {len(bound)} points are at their bound ({names})" if len(bound) else ""
    raise BadInputError(
        f"{' and '.join(hold)} cannot be held: volume is off by {off[0]:.2g} of it and LCB by "
        f"{1e3 * off[1]:.2g} mm after {_HOLDS} rounds{ends}", _WHERE,
        "let more points move (lines, a wider window, a larger tolerance), or hold less",
    )  # fmt: skip


def _kept(name: Held, off: FloatArray) -> bool:
    size, allowed = (off[0], _VOLUME_OFF) if name == "volume" else (off[1], _LCB_OFF)
    return bool(abs(size) <= allowed)


def _tried(
    document: Document, moved: tuple[IntArray, FloatArray, FloatArray]
) -> EvenKeelDisplacement:
    """Measure the hull that displacements give, beside the hull."""
    beside = Document(document.state.published().snapshot())
    rows, delta, _ = moved
    with Transaction(beside, "fair") as edit:
        edit.pending.ask(FieldMoves).fields.append(SolvedField(rows, delta))
    return even_keel_displacement(beside.state.published())


# --------------------------------------------------------------------------------------
# What is told.


def _told(
    state: HullState, given: GivenBattens, solution: FairSolution, within: FloatArray, source: str
) -> Faired:
    problem, d = given.problem, solution.displacement
    stayed = reasons_to_stay(state, None) | ({"to be kept": given.kept} if given.kept else {})
    size = np.abs(d)
    most = int(np.argmax(size))
    places = np.flatnonzero(solution.side)
    base = state.rows.xyz[problem.rows] - problem.moves * given.present[:, None]
    bound = [
        BoundPoint(
            address(state, int(problem.rows[i])),
            _place(base[i]), _place(base[i] + problem.moves[i] * d[i]), float(within[i]),
        )
        for i in places.tolist()
    ]  # fmt: skip
    return Faired(
        solution.noise, source, len(problem.rows), len(problem.residual),
        float(np.sqrt((d * d).mean())), float(np.percentile(size, 95.0)), float(size[most]),
        address(state, int(problem.rows[most])) if size[most] > 0.0 else "",
        tuple(bound), stayed, problem=problem,
    )  # fmt: skip


def _place(xyz: FloatArray) -> tuple[float, float, float]:
    x, y, z = xyz.tolist()
    return x, y, z


def _reasons(stayed: Mapping[str, int]) -> str:
    return ", ".join(f"{count} {why}" for why, count in stayed.items()) or "there are none"
