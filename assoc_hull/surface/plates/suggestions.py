"""What to do with a plate of a class: advice, which a yard replaces by its own.

The texts are advice and no instruction. Heating patterns in a shop deviate near the borders of
regions, where edges are stiff, and hot work can relax a shape that was rolled cold: the source
says so itself.

Source: "Curvature Region Analysis for Application of Plates Forming", J. SNAK.

Examples
--------
>>> from assoc_hull.surface.plates.suggestions import suggestions_with
>>> suggestions_with({"flat": "cut and ship"})["flat"]
'cut and ship'
"""

from __future__ import annotations

from collections.abc import Mapping

from assoc_hull.arguments import choice, shown, text
from assoc_hull.errors import WrongTypeError

__all__ = ["CAVEAT", "SUGGESTIONS", "suggestion_key", "suggestions_with"]

SUGGESTIONS: dict[str, str] = {
    "flat": "none, or straightening",
    "cylinder": "roll or press-brake about the roll axis, to the radii given",
    "cone": "press with turned rolls, by the table of rulings",
    "saddle": "pre-roll about the roll axis where there is one, then shrink the centre band "
    "relative to the edges: line heating along the centre",
    "convex": "pre-roll about the roll axis where there is one, then shrink the edges: line or "
    "triangle heating from the free edges",
    "mixed": "by region; heat where the strain exceeds the tolerance, with care where convex and "
    "saddle regions meet",
}
"""What is advised, by class; "cone" is a developable plate without a common roll axis."""

CAVEAT = (
    "Advice only: heating patterns deviate near the borders of regions, where edges are stiff, "
    "and hot work can relax a shape that was rolled cold."
)
"""What every table of suggestions has to say."""


def suggestions_with(own: object, where: str = "in plates") -> dict[str, str]:
    """Give the texts by class, some replaced.

    Parameters
    ----------
    own : mapping of str to str, or None
        Texts by "flat", "cylinder", "cone", "saddle", "convex", "mixed".
    where : str
        Where it was given, for messages.

    Raises
    ------
    BadInputError, WrongTypeError
        Another class, no text.
    """
    if own is None:
        return dict(SUGGESTIONS)
    if not isinstance(own, Mapping):
        remedy = f"give texts by {', '.join(SUGGESTIONS)}"
        raise WrongTypeError(f"suggestions is {shown(own)}", where, remedy)
    given = {}
    for key, value in own.items():
        kind = choice(key, "a key of suggestions", SUGGESTIONS, where)
        given[kind] = text(value, f"the text of {kind}", where)
    return SUGGESTIONS | given


def suggestion_key(kind: str, rollable: bool, single_axis: bool) -> str:
    """Give the key of the advice for a plate.

    Parameters
    ----------
    kind : str
        Its class.
    rollable : bool
        Whether it is developable, whatever it is called.
    single_axis : bool
        Whether one roll axis serves all of it.

    Examples
    --------
    >>> from assoc_hull.surface.plates.suggestions import suggestion_key
    >>> suggestion_key("mixed", rollable=True, single_axis=True)
    'cylinder'
    """
    if kind == "flat" or not rollable:
        return kind
    return "cylinder" if single_axis else "cone"
