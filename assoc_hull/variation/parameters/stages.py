"""Which parameters one map carries, and which come after it, where several are asked for.

One map for all would bend the planes of most lines: a field that moves heights at the stern bends
every waterline, one that moves half-breadths every buttock, and little is left to drive the rest.
A map that moves one coordinate keeps the planes of the other two whole. So parameters are taken
class by class, and each map is laid out on the hull that the one before has made. Where a class is
refused it is taken end by end, then parameter by parameter, then in parts of its change.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import attrs

__all__ = [
    "CLASSES",
    "Plan",
    "Stage",
    "class_plan",
    "finer_plan",
    "refined_plan",
    "single_plan",
]

CLASSES: tuple[tuple[tuple[str, ...], ...], ...] = (
    (("length", "breadth", "draught", "depth", "deck_height"),),
    # Before anything along the ship: a bilge fades out beyond the parallel body, and so moves its
    # ends.
    (("bilge_radius", "deadrise_deg", "flat_of_bottom"),),
    (
        ("parallel_body_length", "parallel_body_start", "aft_shift"),
        ("parallel_body_end", "fore_shift", "bulb_length", "stem_rake_deg"),
    ),
    (("transom_height", "shaft_height", "sheer_aft"), ("bulb_height", "sheer_fore")),
    (
        ("transom_half_breadth", "aft_frame_height", "run_deg", "waterline_fullness"),
        (
            "bulb_half_breadth",
            "bulb_area",
            "bulb_section_height",
            "fore_frame_height",
            "entrance_deg",
        ),
    ),
    (("bossing_radius",),),
)
"""Classes of parameters in the order in which they are taken; of each what is aft, then the fore
body, in the order in which they are taken one by one."""

_MOST = 8
"""In no more parts is a change taken."""

_AT_ONCE = {*CLASSES[0][0], "fore_shift", "aft_shift"}
"""Never taken in parts: ratios of the whole hull, which would be the same, and movements, of which
several are not one of their sum."""


@attrs.frozen
class Stage:
    """Parameters that one map carries.

    Attributes
    ----------
    names : tuple of str
        The parameters, in the order of their class.
    parts : int
        In how many equal parts their change is taken, each part by a map of its own.
    layers : bool
        Whether raw layers act after them.
    """

    names: tuple[str, ...]
    parts: int = 1
    layers: bool = False

    def __str__(self) -> str:
        what = ", ".join([*self.names, *(["raw fields"] if self.layers else [])])
        return what if self.parts == 1 else f"{what} in {self.parts} parts"


Plan = tuple[Stage, ...]
"""Stages in their order."""


def class_plan(names: Iterable[str], *, layers: bool = False) -> Plan:
    """Give a stage for each class of parameters; raw layers act after the last.

    Examples
    --------
    >>> from assoc_hull.variation.parameters.stages import class_plan
    >>> [str(stage) for stage in class_plan(["bulb_height", "draught", "shaft_height", "breadth"])]
    ['breadth, draught', 'shaft_height, bulb_height']
    """
    asked = set(names)
    classes = CLASSES
    if {"shaft_height", "bossing_radius"} <= asked:
        # One similarity about the centre carries the bossing's end to height and radius at once.
        heights, breadths, bossing = CLASSES[-3:]
        joined = ((*heights[0], *bossing[0]), *heights[1:])
        classes = (*CLASSES[:-3], joined, breadths)
    stages = [Stage(found) for each in classes if (found := _in_order(each, asked))]
    stages = stages or [Stage(())]
    return (*stages[:-1], attrs.evolve(stages[-1], layers=layers))


def single_plan(names: Iterable[str], *, layers: bool = False) -> Plan:
    """Give one stage of all parameters."""
    asked = set(names)
    return (Stage(tuple(one for each in CLASSES for one in _in_order(each, asked)), 1, layers),)


def finer_plan(plan: Plan) -> Plan:
    """Give a plan with every stage refined that can be."""
    return tuple(finer for stage in plan for finer in (tuple(_finer(stage)) or (stage,)))


def refined_plan(plan: Plan, at: int) -> Plan | None:
    """Give a plan with one of its stages refined; None where that cannot be refined.

    Examples
    --------
    >>> from assoc_hull.variation.parameters.stages import Stage, refined_plan
    >>> plan = (Stage(("bulb_height", "shaft_height")),)
    >>> for _ in range(3):
    ...     plan = refined_plan(plan, 0)
    ...     print("; ".join(str(stage) for stage in plan))
    shaft_height; bulb_height
    shaft_height in 2 parts; bulb_height
    shaft_height in 4 parts; bulb_height
    """
    stage = plan[at]
    finer = tuple(_finer(stage))
    return (*plan[:at], *finer, *plan[at + 1 :]) if finer else None


def _finer(stage: Stage) -> Iterator[Stage]:
    """Give what a stage is refined to: its ends, else its parameters, else twice as many parts."""
    if stage.layers and stage.names:
        yield Stage(stage.names, stage.parts)
        yield Stage((), layers=True)
        return
    asked = set(stage.names)
    ends = [found for each in CLASSES for end in each if (found := _in_order((end,), asked))]
    groups = ends if len(ends) > 1 else [(name,) for end in ends for name in end]
    if len(groups) > 1:
        yield from (Stage(group, stage.parts) for group in groups)
    elif stage.names and stage.parts < _MOST and not set(stage.names) <= _AT_ONCE:
        yield attrs.evolve(stage, parts=2 * stage.parts)


def _in_order(ends: tuple[tuple[str, ...], ...], asked: set[str]) -> tuple[str, ...]:
    return tuple(name for end in ends for name in end if name in asked)
