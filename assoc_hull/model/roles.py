"""The role rule: which crossings define a curve.

Not every crossing may define. On real hulls the two closest crossings of a curve lie a
millimetre apart, and where a waterline runs almost parallel to a buttock plane the meeting
may slide by metres while the hull differs by millimetres. So a crossing must be transversal
and far enough from the others; the outcome is stored with the crossing and never changes by
an edit of shape.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.kinds import Role
from assoc_hull.tolerance import Tolerances

__all__ = ["Candidates", "choose", "role_of"]

BoolArray = np.typing.NDArray[np.bool_]


@attrs.frozen(eq=False)
class Candidates:
    """Crossings and fixed points of one curve, in order along it.

    Attributes
    ----------
    position : (k,), m
        Along the curve, ascending.
    angle_deg : (k,)
        Between the curve's tangent and the partner's plane; ignored where `fixed`.
    tangent : (k, 3)
        Unit tangents.
    fixed : (k,) bool
        Ends, knuckle, tangent and placed points: they always define.
    room : (k,), m, or None
        Least distance to any other point that defines, where a crossing slides easily.
    """

    position: FloatArray
    angle_deg: FloatArray
    tangent: FloatArray
    fixed: BoolArray
    room: FloatArray | None = None


def choose(candidates: Candidates, tolerances: Tolerances) -> BoolArray:
    """Choose the crossings that define the curve.

    Parameters
    ----------
    candidates : Candidates
        What meets the curve.
    tolerances : Tolerances
        `transversal_deg`, `spacing`, `turn_deg`, `turn_spacing`, `turn_spacing_part`.

    Returns
    -------
    (k,) bool
        The more transversal first (angle rounded to 0.01 degree), ties by the lower
        position; one defines unless an accepted one lies closer than a quarter of the
        median spacing of all that are transversal. Where the curve turns, closer ones pass.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.model.roles import Candidates, choose
    >>> from assoc_hull.tolerance import Tolerances
    >>> at = np.array([0.0, 1.0, 2.0, 2.1, 3.0])
    >>> steep = np.array([90.0, 90.0, 80.0, 70.0, 90.0])
    >>> straight = np.tile([1.0, 0, 0], (5, 1))
    >>> fixed = np.array([True, False, False, False, True])
    >>> choose(Candidates(at, steep, straight, fixed), Tolerances()).tolist()
    [True, True, True, False, True]
    """
    steep = candidates.fixed | (candidates.angle_deg >= tolerances.transversal_deg)
    chosen = candidates.fixed.copy()
    passed = np.flatnonzero(steep)
    if len(passed) < 2:
        return chosen | steep
    median = float(np.median(np.diff(candidates.position[passed])))
    rounded = np.round(candidates.angle_deg, 2)
    free = passed[~candidates.fixed[passed]]
    order = free[np.lexsort((candidates.position[free], -rounded[free]))]
    for item in order.tolist():
        chosen[item] = _fits(candidates, np.flatnonzero(chosen), item, median, tolerances)
    return chosen


def _fits(
    candidates: Candidates,
    accepted: np.typing.NDArray[np.int64],
    item: int,
    median: float,
    tolerances: Tolerances,
) -> bool:
    """Tell whether an item is far enough from the accepted ones beside it."""
    after = int(np.searchsorted(accepted, item))
    least = max(tolerances.turn_spacing, tolerances.turn_spacing_part * median)
    for neighbour in accepted[max(after - 1, 0) : after + 1].tolist():
        apart = abs(float(candidates.position[neighbour] - candidates.position[item]))
        room = 0.0 if candidates.room is None else float(candidates.room[[item, neighbour]].max())
        if apart < room:
            return False
        if apart >= tolerances.spacing * median:
            continue
        cosine = float((candidates.tangent[neighbour] * candidates.tangent[item]).sum())
        turn = float(np.degrees(np.arccos(min(1.0, max(-1.0, cosine)))))
        if apart < least or turn < tolerances.turn_deg:
            return False
    return True


def role_of(defines_a: bool, defines_b: bool, generates: tuple[bool, bool]) -> Role:
    """Say what a crossing does, from what the rule chose on its two curves.

    Parameters
    ----------
    defines_a, defines_b : bool
        Whether the crossing may define the curve of lower rank (a) and of higher rank (b).
    generates : (bool, bool)
        Whether a generates on b, and b on a; both for a two-way association.

    Returns
    -------
    Role
        Driven links run down the ranks only, or along a one-way association. A crossing
        that could only be driven upward is watched.

    Examples
    --------
    >>> from assoc_hull.model.roles import role_of
    >>> role_of(True, True, (True, True)).text, role_of(False, True, (True, True)).text
    ('shared', 'drives b')
    >>> role_of(True, False, (True, True)).text
    'watched'
    """
    if generates == (True, False):
        return Role.DRIVES_B if defines_b else Role.WATCHED
    if generates == (False, True):
        return Role.DRIVES_A if defines_a else Role.WATCHED
    if defines_a and defines_b:
        return Role.SHARED
    return Role.DRIVES_B if defines_b else Role.WATCHED
