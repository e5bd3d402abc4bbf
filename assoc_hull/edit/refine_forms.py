"""Generated curves that have come to need more points get them, in a second pass.

A definition that bends a section more sharply leaves the spline through the old points too far
off, or its area. Marks are only added: what reads a point never loses it so.
"""

from __future__ import annotations

from assoc_hull.edit.remake import recipe_for, remake
from assoc_hull.edit.work import Work
from assoc_hull.geometry.curves import IntArray
from assoc_hull.model.generated import attached
from assoc_hull.model.make import Maker

__all__ = ["refine_forms"]


def refine_forms(work: Work, curves: IntArray) -> list[int]:
    """Give more points to those of some curves whose marks do not hold them.

    Parameters
    ----------
    work : Work
        The update, whose main pass has run.
    curves : (k,) int
        Curves that it has evaluated.

    Returns
    -------
    list of int
        The curves that were made anew, to be evaluated once more.

    Raises
    ------
    AssocHullError
        A curve that cannot be held by any points.
    """
    state, maker = work.state, Maker(work.state, work.journal)
    known = attached(state)
    done = {}
    for curve in curves.tolist():
        made = known.get(curve)
        if made is None:
            continue
        recipe = recipe_for(state, made, made.layout)
        if recipe.marks != made.marks:
            done[made.key] = remake(maker, made, recipe)
    if done:
        maker.generated(({each.key: each for each in state.generated} | done).values())
        work.renew()
    return sorted(made.curve for made in done.values())
