"""Generated curves that have come to need more points get them, in a second pass.

A definition that bends a section more sharply leaves the spline through the old points too far
off, or its area. Marks are only added: what reads a point never loses it so.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.followup.generated_curves import recipe_for, remake_points
from assoc_hull.edit.modification import Work
from assoc_hull.geometry.curves import IntArray
from assoc_hull.model.form_definition import GeneratedCurve
from assoc_hull.model.forms.generate_points import marks_suffice
from assoc_hull.model.generated_curves import attached_curves, end_points, forms_of, line_offset
from assoc_hull.model.make_objects import Maker

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
    known = attached_curves(state)
    done = {}
    chosen = [known[curve] for curve in curves.tolist() if curve in known]
    for made in _not_held(work, chosen):
        recipe = recipe_for(state, made, made.layout)
        if recipe.marks != made.marks:
            done[made.key] = remake_points(maker, made, recipe)
    if done:
        maker.generated(({each.key: each for each in state.generated} | done).values())
        work.renew()
    return sorted(made.curve for made in done.values())


def _not_held(work: Work, made: list[GeneratedCurve]) -> list[GeneratedCurve]:
    """Give those that their marks do not hold."""
    state, numbers = work.state, [each.curve for each in made]
    if not made:
        return []
    places = np.array([line_offset(state, curve) for curve in numbers])
    held = marks_suffice(forms_of(state), made, places, end_points(state, numbers))
    return [each for each, enough in zip(made, held.tolist(), strict=True) if not enough]
