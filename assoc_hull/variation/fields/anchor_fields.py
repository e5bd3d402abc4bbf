"""Fields laid out over anchors, so that each anchor moves by exactly what is asked.

An anchor is a height with a displacement. The rounded hat joins the displacements by straight
lines that are blended into one another; this is the usual way. Ratio curves are the way of Choi &
Lee (1999), kept for comparison with their paper. Both give a `StackedField`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.variation.fields.bounded_functions import QUINTIC, Blend, BoundedFunction
from assoc_hull.variation.fields.field import AffinePiece, Axis, StackedField, level_boundaries

__all__ = [
    "hat_field",
    "level_window",
    "ratio_field",
]

# --------------------------------------------------------------------------------------
# The rounded hat. Straight lines join the anchors and their displacements; at each anchor one line
# is blended into the next within a window. The lines agree at the anchor, so it moves by exactly
# what is asked, whatever the blend, and slopes stay near those of the lines.

_WINDOW = 0.3
"""Half-width of a window as a part of the smaller gap beside its anchor. At one half two
boundaries would coincide."""

_HALVINGS = 60


def hat_field(
    name: str,
    anchors: Sequence[tuple[str, float, float]],
    course: BoundedFunction,
    *,
    axis: Axis = "z",
    blend: Blend = QUINTIC,
    outward: Sequence[str] = (),
    windows: Mapping[str, tuple[float, float]] | None = None,
) -> StackedField:
    """Lay out a field over anchors, from below.

    Parameters
    ----------
    name : str
    anchors : sequence of (str, float, float)
        Name, height (m) and displacement (m). Below the first and above the last the
        displacement stays what it is there.
    course : BoundedFunction
        How it fades along the ship, 1 where it is full.
    axis : {"x", "z"}
        What is displaced.
    blend : Blend
    outward : sequence of str
        Anchors whose windows point away from the plateau beside them, so that this stays rigid.
    windows : mapping of str to (float, float) or None
        How far windows reach down and up where that is not the usual, as parts of the gaps there.
        Below the first and above the last anchor the gap next to it counts.

    Raises
    ------
    BadInputError
        Anchors that do not rise, or fewer than two; windows that touch.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.fields.bounded_functions import BlendChain
    >>> from assoc_hull.variation.fields.anchor_fields import hat_field
    >>> field = hat_field(
    ...     "shaft", [("base", 0, 0), ("shaft", 5, 1), ("T", 18, 0)], BlendChain.constant(1)
    ... )
    >>> field.displacement(np.array([[10.0, 2.0, 5.0], [10.0, 2.0, 22.0]])).tolist()
    [1.0, 0.0]
    """
    names = [each[0] for each in anchors]
    z = np.array([each[1] for each in anchors], np.float64)
    d = np.array([each[2] for each in anchors], np.float64)
    if len(z) < 2:
        raise BadInputError(f"field '{name}' has {len(z)} anchors", "in vary", "give at least two")
    level_boundaries(names, z.tolist())
    gap = np.diff(z)
    beside = np.column_stack([np.append(gap[0], gap), np.append(gap, gap[-1])])
    special = windows or {}
    # below the first and above the last anchor the displacement stays
    slope = np.concatenate([[0.0], np.diff(d) / gap, [0.0]])
    labels, heights, pieces = list[str](), list[float](), list[AffinePiece]()
    for j, anchor in enumerate(names):
        if anchor in special:
            below, above = (np.array(special[anchor]) * beside[j]).tolist()
        else:
            below, above = _window(_WINDOW * beside[j], d, j, rigid=anchor in outward)
        for sign, part, k in (("-", below, j), ("+", above, j + 1)):
            labels.append(f"{anchor}{sign}")
            heights.append(float(z[j]) - part if sign == "-" else float(z[j]) + part)
            pieces.append(AffinePiece.along(course, float(slope[k]), float(d[j]), float(z[j])))
    return StackedField(name, axis, level_boundaries(labels, heights), tuple(pieces), blend)


def _window(
    reach: np.typing.NDArray[np.float64],
    d: np.typing.NDArray[np.float64],
    j: int,
    *,
    rigid: bool,
) -> tuple[float, float]:
    """Give how far the window of an anchor reaches down and up.

    One that points away from a plateau is as wide as the gap on its own side allows.
    """
    below, above = reach.tolist()
    if not rigid:
        return min(below, above), min(below, above)
    plateau_above = j + 1 < len(d) and d[j + 1] == d[j]
    return (below, 0.0) if plateau_above else (0.0, above)


def level_window(below: float, above: float, blend: Blend = QUINTIC) -> float:
    """Give how wide a window is above its anchor, by its width below, to be level there.

    Parameters
    ----------
    below, above : float, m
        Gaps to the anchors beside, which stay.
    blend : Blend

    Returns
    -------
    float
        Width above / width below.

    Notes
    -----
    The lines rise by D / below and fall by D / above. Both give D at the anchor, so that the
    slope there is D / below - b(s) (D / below + D / above): zero for
    b(s) = above / (below + above).

    Examples
    --------
    >>> from assoc_hull.variation.fields.anchor_fields import level_window
    >>> level_window(5.0, 5.0)
    1.0
    """
    # bisection: the blend has no inverse in closed form
    wanted = above / (below + above)
    low, high = 0.0, 1.0
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        if float(blend.value(np.array(middle))) < wanted:
            low = middle
        else:
            high = middle
    return (1.0 - high) / high


# --------------------------------------------------------------------------------------
# Ratio curves: a boundary through each anchor carries the ratio of the anchor's coordinate after
# and before, blended between two of them, so that a place is not moved by the lines that join the
# anchors. Choi & Lee, "A Study on the Hull Form Design System on the Basis of the Associative
# Geometry Objects", J. SNAK 36(4), 1999, section 3.4, formulas 3.1 to 3.3.

_GRIP = 1e-6
"""A height below this part of the highest anchor's has no ratio."""


def ratio_field(
    name: str,
    anchors: Sequence[tuple[str, float, float]],
    course: BoundedFunction,
    *,
    blend: Blend = QUINTIC,
) -> StackedField:
    """Lay out a z-field by the ratios of heights.

    Parameters
    ----------
    name : str
    anchors : sequence of (str, float, float)
        Name, height (m, above the base) and displacement (m), from below.
    course : BoundedFunction
        How it fades along the ship, 1 where it is full.
    blend : Blend

    Raises
    ------
    BadInputError
        Anchors that do not rise, or one at the base that is to move.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.fields.bounded_functions import BlendChain
    >>> from assoc_hull.variation.fields.anchor_fields import ratio_field
    >>> anchors = [("base", 0, 0), ("shaft", 5, 1), ("T", 18, 0)]
    >>> field = ratio_field("shaft", anchors, BlendChain.constant(1))
    >>> field.displacement(np.array([[10.0, 2.0, 5.0], [10.0, 2.0, 22.0]])).tolist()
    [1.0, 0.0]
    """
    heights = [float(z) for _, z, _ in anchors]
    walls = level_boundaries([label for label, _, _ in anchors], heights)
    least = _GRIP * max(map(abs, heights))
    pieces = list[AffinePiece]()
    for label, z, change in anchors:
        if abs(z) < least and change != 0.0:
            raise BadInputError(
                f"'{name}' cannot use a ratio: anchor '{label}' at {z:.3f} m equals its pivot",
                "in vary", "leave blend='paper' out, so that it is shifted",
            )  # fmt: skip
        pieces.append(AffinePiece.along(course, change / z if change else 0.0, 0.0))
    return StackedField(name, "z", walls, tuple(pieces), blend)
