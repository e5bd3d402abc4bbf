"""A variation carried out: lay out, certify, apply, measure, and correct until all is met.

The map is found beside the published hull: what is missing of the asked values, as measured on a
lofted trial, is added to what is asked of the map. Then `vary_document` varies the hull in one
step. The notes of its report say what a designer should know besides: folds beyond the hull,
planes that went along, values that changed as well.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import attrs
import numpy as np

from assoc_hull.display import ShownAsText, counted
from assoc_hull.edit.checks.update_findings import MOVE_ADVICE
from assoc_hull.edit.document import Document, end_if_stopped
from assoc_hull.edit.mapped_planes import IN_PLANE
from assoc_hull.edit.step import EditReport
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError, RefusedEditError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.tables import HullState
from assoc_hull.variation.aiming.report import AimReport
from assoc_hull.variation.carrying.admissible_values import AdmissibleValues
from assoc_hull.variation.certificate.fold_check import Certificate, fold_outside
from assoc_hull.variation.comparing.line_fairness import FairnessChange, FairnessComparison
from assoc_hull.variation.earlier_values import left_values, values_before, values_of_variation
from assoc_hull.variation.fields.field import FieldRegion
from assoc_hull.variation.fields.space_map import VariationMap
from assoc_hull.variation.parameters.catalogue import CATALOGUE
from assoc_hull.variation.parameters.field_layout import Layout, Share
from assoc_hull.variation.parameters.hull_and_end_measures import drawn_breadth
from assoc_hull.variation.parameters.paper_regions import regions_of
from assoc_hull.variation.parameters.parameter_fields import shift_terminals
from assoc_hull.variation.parameters.parameter_measures import measure_all
from assoc_hull.variation.parameters.parent import Parent, cannot_vary
from assoc_hull.variation.parameters.value_limits import present_values
from assoc_hull.variation.plan_choice import KINK, beyond_fair, choose_plan, parent_fairness
from assoc_hull.variation.request import VariationRequest, script_of, title_of

if TYPE_CHECKING:
    from assoc_hull.variation.faired_followers import FairedFollowers

__all__ = [
    "Target",
    "VariationReport",
    "also_changed",
    "composed_of",
    "folds_outside",
    "moved_by_ratios",
    "shifted_without_body",
    "vary_document",
    "went_along",
]

# --------------------------------------------------------------------------------------
# Notes of the report: what a designer should know besides.

_SEEN = 1e-3
"""A named value that changes by less (m, degrees) is not reported."""


def folds_outside(vmap: VariationMap, box: FloatArray) -> tuple[str, ...]:
    """Give a note where a map folds beyond the box (2, 3), m, of a hull; none if nowhere."""
    beyond = fold_outside(vmap, box)
    if beyond is None:
        return ()
    x, _, z = beyond.witness
    return (f"fold_outside_hull: the map folds at x={x:.3f} z={z:.3f}, where there is no hull",)


def went_along(before: FloatArray, length: float, state: HullState) -> tuple[str, ...]:
    """Give notes on lines that went with the map, where names may say a height or a place.

    Parameters
    ----------
    before : (l,), m
        Offsets of the planes of all lines.
    length : float, m
        Lpp before: a numbered section stands at a part of it.
    state : HullState
        The hull afterwards.
    """
    level, place, numbered = list[int](), list[int](), list[int]()
    for line in state.live("lines").tolist():
        if state.lines.boundary[line] >= 0:
            continue
        if state.family(line).axis in (1, 2):
            level.append(line)
        elif _says(state.lines.name[line], float(before[line])):
            place.append(line)
        else:
            numbered.append(line)
    kinds = ("waterlines and buttocks", level), ("sections named by their place", place)
    kept = (note for kind, lines in kinds for note in _kept_names(kind, lines, before, state))
    went = [each for each in numbered if state.lines.offset[each] != before[each]]
    scaled = before * (state.particulars.length / length)
    return *kept, *_off_their_numbers(went, scaled, state)


def _off_their_numbers(
    went: Sequence[int], scaled: FloatArray, state: HullState
) -> tuple[str, ...]:
    """Tell of numbered sections that went elsewhere than to their parts of the length."""
    lines = np.array(went, np.int64)
    shifts = state.lines.offset[lines] - scaled[lines]
    count = int(np.count_nonzero(np.abs(shifts) > _SEEN))
    if not count:
        return ()
    farthest = int(np.nanargmax(np.abs(shifts)))
    name, at = state.lines.name[lines[farthest]], state.lines.offset[lines[farthest]]
    return (
        f"{counted(count, 'section')} moved along the ship and kept "
        f"{'its number' if count == 1 else 'their numbers'}, {name} farthest, by "
        f"{shifts[farthest]:+.3f} m to {at:.3f} m (stations='x', --stations x, leaves sections "
        "where they are)",
    )


def _kept_names(
    kind: str, some: Sequence[int], before: FloatArray, state: HullState
) -> tuple[str, ...]:
    lines = np.array(some, np.int64)
    moved = np.abs(state.lines.offset[lines] - before[lines])
    gone = lines[moved > IN_PLANE]
    if not len(gone):
        return ()
    farthest = int(lines[np.nanargmax(moved)])
    name, level = state.lines.name[farthest], float(state.lines.offset[farthest])
    return (f"{len(gone)} {kind} went along and kept their names: {name} is at {level:.6g} m",)


def _says(name: str, offset: float) -> bool:
    """Tell whether a name ends with the place of its line, m, to the digits that it has."""
    word = name.rpartition(" ")[2]
    try:
        return abs(float(word) - offset) <= 0.5 * 10.0 ** -len(word.partition(".")[2])
    except ValueError:
        return False


def also_changed(
    before: Mapping[str, float], after: Mapping[str, float], asked: Mapping[str, float]
) -> tuple[str, ...]:
    """Give a note on values that changed unasked: a field moves all that it reaches.

    Examples
    --------
    >>> from assoc_hull.variation.vary import also_changed
    >>> was = {"shaft_height": 5.0, "transom_height": 18.4}
    >>> also_changed(was, {"shaft_height": 6.0, "transom_height": 18.632}, {"shaft_height": 6.0})
    ('also changed: transom_height 18.4 -> 18.632 m',)
    """
    told = [
        f"{name} {before[name]:.6g} -> {after[name]:.6g} {CATALOGUE[name].unit}"
        for name in CATALOGUE
        if name in before and name in after and name not in asked
        and abs(after[name] - before[name]) > _SEEN
    ]  # fmt: skip
    return (f"also changed: {', '.join(told)}",) if told else ()


def unfair_lines(fairness: FairnessComparison) -> tuple[str, ...]:
    """Give a note on the lines that have a kink after a variation; none if there is none."""
    told = [
        f"{line.name} ({_sharper(line)})" for line, times in fairness.unfairness if times > KINK
    ]
    if not told:
        return ()
    added = f"{fairness.added} changes of curvature sign added in all"
    return (f"lines less fair than those of the parent by their combs: {', '.join(told)}; {added}",)


def _sharper(line: FairnessChange) -> str:
    """Say by how much a comb integral has risen; of a line that was straight, to what."""
    if not line.before.comb:
        return f"straight before, now {line.after.comb:.3g} 1/m3"
    return f"{line.comb_ratio:.3g} times the parent's, {line.shape_ratio:.3g} at the size it had"


_NAMED = 3
"""So many lines are named."""


def _refuse_unfair(
    edit: Transaction, ask: VariationRequest, room: AdmissibleValues, fairness: FairnessComparison
) -> None:
    """Refuse a hull that no one would take for its lines, with the values that would be fair."""
    beyond = beyond_fair(fairness, edit.state)
    if not beyond:
        return
    lines = ", ".join(f"{name} {times:.3g} times" for name, times in beyond[:_NAMED])
    if len(beyond) > _NAMED:
        lines += f" and {counted(len(beyond) - _NAMED, 'more line')}"
    edit.take_back()  # what may be asked for is sought on the parent
    raise RefusedEditError(ask.name, (
        f"lines would bend more sharply than they do, by their combs: {lines}; "
        f"{_fair_values(ask, room)}, or take the hull as it is with accept=True (--accept)",
    ))  # fmt: skip


def _fair_values(ask: VariationRequest, room: AdmissibleValues) -> str:
    """Say what to ask for instead of values beyond those at which lines stay fair."""
    remedies = []
    for name, value in ask.values.items():
        low, high = room.fair_interval(name)
        if not low <= value <= high:
            remedies.append(f"ask for {name} {room.fair_words(name)}, where lines stay fair")
    return " and ".join(remedies or ["ask for less"])


@contextmanager
def _advised(document: Document, ask: VariationRequest) -> Iterator[None]:
    """Give a refusal of the carried hull the advice of a variation: no point was moved by hand."""
    try:
        yield
    except RefusedEditError as error:
        if not any(MOVE_ADVICE in each for each in error.findings):
            raise
        room = AdmissibleValues.of(document.state, ask.layout, ask.tolerance)
        advice = _fair_values(ask, room)
        first, *others = (each.partition(MOVE_ADVICE)[0] for each in error.findings)
        raise RefusedEditError(error.edit, (f"{first}: {advice}", *others)) from None


def shifted_without_body(
    parent: Parent, asked: Iterable[str] = ("fore_shift", "aft_shift")
) -> tuple[str, ...]:
    """Give a note on what stands for the parallel body where sections shift and there is none.

    Parameters
    ----------
    parent : Parent
    asked : iterable of str
        Names of the parameters that are asked for.
    """
    shifts = any(name in ("fore_shift", "aft_shift") for name in asked)
    if not shifts or parent.has("body start") or not parent.has("largest aft"):
        return ()
    _, start, end, _ = shift_terminals(parent, "section shifts")
    where = f"at {start:.6g} m" if start == end else f"from {start:.6g} to {end:.6g} m"
    what = "the largest station stands" if start == end else "the two largest stations stand"
    return (f"no parallel middle body: {what} for it, {where}",)


_MORE = 1.05
"""What moves by so many times more than was asked is told."""


def moved_by_ratios(
    parent: Parent, xyz: FloatArray, asked: Mapping[str, float], layout: Layout
) -> tuple[str, ...]:
    """Give notes on the regions of the paper's form, and on what its ratios move besides.

    A ratio multiplies what lies farther out than its place by as much: a small radius that grows
    by much has a large one. None for other forms.

    Parameters
    ----------
    parent : Parent
    xyz : (n, 3), m
        Places of the hull.
    asked : mapping of str to float
        Values of named parameters.
    layout : Layout
    """
    if layout.blend != "paper":
        return ()
    regions = regions_of(parent, layout)
    told = [] if regions is None else [str(regions)]
    for name, value in asked.items():
        lays = CATALOGUE[name].lays
        share = None if lays is None or name not in _RATIOS else lays(parent, value, layout)
        if isinstance(share, Share) and share.change:
            told += _beside(share, xyz)
    return tuple(told)


_RATIOS = (
    "shaft_height", "bossing_radius", "transom_height", "transom_half_breadth", "bulb_height",
    "bulb_half_breadth",
)  # fmt: skip
"""Parameters whose fields are ratios of what they change."""


def _beside(share: Share, xyz: FloatArray) -> list[str]:
    """Say how large the ratio of a share is, and by how much it moves what lies round it."""
    moved = np.zeros_like(xyz)
    for field in share.fields:
        moved[:, "xyz".index(field.axis)] += field.displacement(xyz)
    size = np.sqrt((moved * moved).sum(axis=1))
    most = int(size.argmax())
    own = float(share.places[0, "xyz".index(share.axis)])
    if size[most] <= _MORE * abs(share.change) or not own:
        return []
    x, y, z = xyz[most].tolist()
    return [
        f"{share.name} asks for {share.change:.4g} m, a ratio of {1.0 + share.change / own:.4g}, "
        f"which moves what lies round it by up to {size[most]:.4g} m, at "
        f"({x:.3f}, {y:.3f}, {z:.3f}) m"
    ]


def composed_of(maps: int, layout: Layout) -> tuple[str, ...]:
    """Give a note where several maps of ratios were composed, which is no map of ratios."""
    if layout.blend != "paper" or maps < 2:
        return ()
    return (f"{maps} maps of ratios one after the other: together they are no one map of ratios",)


# --------------------------------------------------------------------------------------
# The variation and its report.


@attrs.frozen(repr=False)
class Target(ShownAsText):
    """A named parameter of a variation.

    Attributes
    ----------
    name, unit : str
    before, asked, reached : float
        Measured on the parent, asked for, measured on the varied hull; an amplitude reaches
        what is asked for.
    """

    name: str
    unit: str
    before: float
    asked: float
    reached: float

    def __str__(self) -> str:
        return f"{self.name} {self.before:.6g} -> {self.reached:.9g} {self.unit}"


@attrs.frozen(repr=False)
class VariationReport(ShownAsText):
    """What a variation did.

    Attributes
    ----------
    targets : tuple of Target
    rounds : int
        How often the plan was carried out in full until all targets were met; small misses are
        made up for by a nudge of the carried hull, which is none.
    regions : tuple of FieldRegion
        Boxes of the profile plane outside which no map moves anything.
    drivers : tuple of str
        Lines that were carried as they are; all others were cut again.
    added : int
        Adopted points that hold the drivers to their images.
    certificate : Certificate
        That the map folds nothing.
    edit : EditReport
        What changed, as of any edit.
    notes : tuple of str
        What else there is to know.
    script : mapping or None
        What was asked for as data: with it, `Hull.vary_by` repeats the variation.
        None where layers were given that are not data.
    aim : AimReport or None
        How targets of outputs were reached; None where none were given.
    stages : tuple of str
        What was carried by one map after the other.
    worst_comb : float
        The largest ratio of a line's comb integral to that of the parent's.
    added_sign_changes : int
        Changes of sign of curvature that lines of the parent have more.
    maps : int
        How many maps were composed: stages, and parts of them.
    faired : FairedFollowers or None
        What fairing the followers has done; None where it was not asked for.
    """

    targets: tuple[Target, ...]
    rounds: int
    regions: tuple[FieldRegion, ...]
    drivers: tuple[str, ...]
    added: int
    certificate: Certificate
    edit: EditReport
    notes: tuple[str, ...] = ()
    script: Mapping[str, Any] | None = None
    aim: AimReport | None = None
    stages: tuple[str, ...] = ()
    worst_comb: float = 1.0
    added_sign_changes: int = 0
    maps: int = 1
    faired: FairedFollowers | None = None

    def __str__(self) -> str:
        aimed = () if self.aim is None else (str(self.aim),)
        targets = (str(each) for each in self.targets)
        faired = () if self.faired is None else (str(self.faired),)
        stages = () if len(self.stages) < 2 else (f"in stages: {'; '.join(self.stages)}",)
        return "\n".join([*targets, *aimed, *stages, *faired, *self.notes, str(self.edit)])


def _without_tunnels(state: HullState, ask: VariationRequest) -> tuple[str, ...]:
    """Give a note where outputs are reached of a hull that has tunnels, which these do not see."""
    if not state.tunnels or ask.reach is None:
        return ()
    names = ", ".join(each.name for each in state.tunnels)
    return (f"what was to be reached is of the moulded hull, without its tunnels ({names})",)


def measure_parent(state: HullState) -> None:
    """Measure what every variation asks of its parent; copies of the hull know it from then on."""
    measure_all(state)
    parent_fairness(state)


_LONG = 80
"""Characters of a ship's name: what more was varied is not told in it."""


def variant_name(parent: str, ask: VariationRequest) -> str:
    """Give what a variant is called: as the parent, and what was asked for.

    The name of the step does not count: one request gives one hull, whatever it is called.
    """
    found = f"{parent}, {title_of(ask.values, ask.reach).removeprefix('vary ')}"
    short = found if len(found) <= _LONG else f"{parent}, varied"
    return short if len(short) <= _LONG else parent


def vary_document(
    document: Document, ask: VariationRequest, ship: str | None = None
) -> tuple[VariationMap, VariationReport]:
    """Vary a hull in place, as one step that can be undone.

    Parameters
    ----------
    document : Document
        The hull.
    ask : VariationRequest
        What is asked for.
    ship : str or None
        What the ship is called from then on, if anything changes; None: as before.

    Raises
    ------
    BadInputError, FoldError, RefusedEditError
        What is asked for cannot be had; the hull is unchanged.
    """
    with _advised(document, ask), Transaction(document, ask.name) as edit:
        room = AdmissibleValues.of(edit.state, ask.layout, ask.tolerance)
        parent, was = room.parent, room.present
        for name in ask.values:
            if name in parent.absent:
                raise cannot_vary(name, parent.absent[name])
        room.check(ask.values)
        levels, length = edit.state.lines.offset.data.copy(), edit.state.particulars.length
        beside = moved_by_ratios(
            parent, edit.state.rows.xyz[edit.state.live("rows")], ask.values, ask.layout
        )
        found, fairness = choose_plan(edit, room, ask)
        end_if_stopped()
        measured = measure_all(edit.state)
        now = present_values(measured, ask.layout)
        if not ask.accept:
            _refuse_unfair(edit, ask, room, fairness)
        reached = {
            name: value if CATALOGUE[name].amplitude else now[name]
            for name, value in ask.values.items()
        }
        if found.faired is not None:
            edit.notes.append(str(found.faired))
        edit.variation = script_of(ask)
        edit.varied = values_of_variation(ask, was, found.aimed)
        if not any(step.script.varied for step in document.history):
            edit.varied_before = values_before(document)
        bare = _without_tunnels(edit.state, ask)
        left = left_values(document, ask, now)
        broad = drawn_breadth(measured.anchors["breadth"]) if "breadth" in found.values else ()
        beyond = folds_outside(found.carry.map, room.box)
        along = went_along(levels, length, edit.state)
        if ship is not None and edit.changes:
            # In the same step: undo gives the parent back with her name.
            called = attrs.evolve(edit.state.particulars, name=ship)
            edit.journal.set(edit.state.settings.particulars, [0], [called])
    report = edit.report
    if report is None:
        raise BadInputError("an edit is open", "in vary", "finish it before")
    targets = tuple(
        Target(name, CATALOGUE[name].unit, was[name], value, reached[name])
        for name, value in ask.values.items()
    )
    carried, whole = found.carry.carried, found.carry.map
    notes = (
        *shifted_without_body(parent, found.values), *beside,
        *composed_of(len(carried), ask.layout), *beyond, *along, *broad,
        *also_changed(was, now, found.values), *bare, *left, *unfair_lines(fairness),
    )  # fmt: skip
    drivers = [each.applied.drivers for each in carried]
    regions = dict.fromkeys(one for each in carried for one in each.regions)
    return whole, VariationReport(
        targets, found.rounds, tuple(regions),
        tuple(name for name in drivers[0] if all(name in each for each in drivers)),
        sum(each.applied.added for each in carried), found.carry.certificate, report, notes,
        script_of(ask),
        None if found.aimed is None else attrs.evolve(found.aimed, hull=None),  # a hull is large
        tuple(map(str, found.carry.plan)), fairness.worst, fairness.added,
        len(carried), found.faired,
    )  # fmt: skip
