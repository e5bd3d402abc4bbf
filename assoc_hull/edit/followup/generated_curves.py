"""Points of a curve that comes from definitions, made anew from a recipe.

That happens when the pieces of the curve are others than before, when it needs more points, or
when a line is returned to its definitions. Points whose mark stays keep their identity, so that
nothing that reads them loses them.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import IntArray
from assoc_hull.model.form_definition import ON_FLATS, GeneratedCurve, Mark
from assoc_hull.model.forms.generate_points import marks_for
from assoc_hull.model.forms.line_layout import layout_at
from assoc_hull.model.generated_curves import (
    end_points,
    forms_of,
    line_offset,
    part_in_line,
    points_given,
)
from assoc_hull.model.kinds import Sort
from assoc_hull.model.make_objects import Maker, PointSpec
from assoc_hull.model.tables import Ends, HullState

__all__ = [
    "CurveRecipe",
    "attachable_curves",
    "layout_now",
    "recipe_for",
    "remake_points",
]


def attachable_curves(state: HullState, line: int) -> list[GeneratedCurve]:
    """Give what comes, came or may come from definitions on a line.

    Examples
    --------
    >>> from assoc_hull.edit.followup.generated_curves import attachable_curves
    >>> from assoc_hull.shipped.wigley import wigley
    >>> attachable_curves(wigley(stations=5, waterlines=4), 0)
    []
    """
    curves = [c for c in state.lines.curves[line] if state.curves.alive[c]]
    known = {each.curve: each for each in state.generated}
    found = [known[curve] for curve in curves if curve in known]
    if found or not _is_section(state, line):
        return found
    keys = state.curves.key.data
    return [GeneratedCurve(str(keys[c]), c, "section", "", (), (), attached=False) for c in curves]


def _is_section(state: HullState, line: int) -> bool:
    """Tell whether a line is a section like those that are generated."""
    groups = {
        int(state.lines.group[state.line_of(each.curve)])
        for each in state.generated
        if each.what == "section"
    }
    return int(state.lines.group[line]) in groups


# --------------------------------------------------------------------------------------
# Recipes.

Vector = tuple[float, float, float]


@attrs.frozen
class CurveRecipe:
    """What a generated curve is to be made of.

    Attributes
    ----------
    layout : str
        Its pieces.
    marks : tuple of Mark
        Where its points lie on them.
    kinds : tuple of int
        A `PointKind` each.
    directions : tuple of (3,)
        Directions of tangent points.
    ends : Ends
        End conditions.
    """

    layout: str
    marks: tuple[Mark, ...]
    kinds: tuple[int, ...]
    directions: tuple[Vector, ...]
    ends: Ends = attrs.field(factory=Ends)


def layout_now(state: HullState, made: GeneratedCurve) -> str:
    """Give the layout that the definitions ask for where a curve stands.

    Raises
    ------
    BadInputError
        A definition is missing, or the curve is not there any more.
    """
    place = line_offset(state, made.curve)
    return layout_at(forms_of(state), made.what, place, part_in_line(state, made.curve))


def recipe_for(state: HullState, made: GeneratedCurve, layout: str) -> CurveRecipe:
    """Give the recipe of a curve by its layout, with its ends as they lie now.

    Raises
    ------
    AssocHullError
        The curve cannot be made.
    """
    if not layout:
        return CurveRecipe(layout, (), (), ())
    place, ends = line_offset(state, made.curve), end_points(state, [made.curve])[0]
    marks, kinds, directions, conditions = marks_for(
        forms_of(state), made.what, layout, place, ends,
        made.marks if layout == made.layout and made.attached else (),
    )  # fmt: skip
    vectors = [(x, y, z) for x, y, z in np.asarray(directions, np.float64).reshape(-1, 3).tolist()]
    chosen = tuple((int(piece), float(t)) for piece, t in marks)
    numbers = tuple(np.asarray(kinds, np.int64).tolist())
    return CurveRecipe(layout, chosen, numbers, tuple(vectors), conditions)


def remake_points(maker: Maker, made: GeneratedCurve, recipe: CurveRecipe) -> GeneratedCurve:
    """Give a curve the points of a recipe, its own ends before and behind them.

    The result is attached; the caller puts it into the table.
    """
    state, journal = maker.state, maker.journal
    rows, fresh = _rows(maker, made, recipe)
    new = made.evolve(
        layout=recipe.layout, marks=recipe.marks, rows=tuple(rows.tolist()), attached=True
    )
    _thread(maker, made, new)
    kinds = state.rows.kind[rows].copy()
    kinds[:, 0] = recipe.kinds
    directions = state.rows.direction[rows].copy()
    directions[:, 0] = np.array(recipe.directions, np.float64).reshape(-1, 3)
    journal.put(state.rows.kind, rows, kinds)
    journal.put(state.rows.direction, rows, directions)
    journal.put(state.rows.sort, rows, int(Sort.ADOPTED))
    journal.put(state.rows.anchor, rows, -1)
    if state.curves.ends[made.curve] != recipe.ends:
        journal.set(state.curves.ends, [made.curve], [recipe.ends])
    _place(maker, new, fresh)
    return new


def _rows(maker: Maker, made: GeneratedCurve, recipe: CurveRecipe) -> tuple[IntArray, IntArray]:
    """Give the points of a recipe, and those of them that are new; others are taken out."""
    state = maker.state
    same = made.layout == recipe.layout
    known = {
        mark: row
        for mark, row in zip(made.marks, made.rows, strict=True)
        if same and state.rows.alive[row]
    }
    missing = [mark for mark in recipe.marks if mark not in known]
    # a key is of the place where its point first lay: that must be known before the point is made
    bare = made.evolve(layout=recipe.layout, marks=tuple(missing), rows=(-1,) * len(missing))
    places = points_given(state, [bare])[1]
    specs = [PointSpec(made.curve, place, Sort.ADOPTED) for place in places]
    fresh = maker.points(specs)
    known |= dict(zip(missing, fresh.tolist(), strict=True))
    rows = np.array([known[mark] for mark in recipe.marks], np.int64)
    lost = np.setdiff1d(np.array(made.rows, np.int64), rows)
    maker.remove_rows(lost[state.rows.alive[lost]])
    return rows, fresh


def _thread(maker: Maker, made: GeneratedCurve, new: GeneratedCurve) -> None:
    """Let the new points define the curve; only lines on a flat have others than their ends."""
    state = maker.state
    old: IntArray = state.curves.rows[made.curve]
    rows = np.array(new.rows, np.int64)
    rest = old[~np.isin(old, np.union1d(np.array(made.rows, np.int64), rows))]
    if made.what in ON_FLATS:
        every = np.concatenate([rest, rows])
        maker.define(made.curve, every[np.argsort(state.rows.xyz[every, 0], kind="stable")])
        return
    # ends that are no generated points stay: there a section meets profile and deck edge
    first, last = rest[rest == old[0]], rest[rest == old[-1]]
    left = rest[(rest != old[0]) & (rest != old[-1])]
    maker.define(made.curve, np.concatenate([first, rows, last]))
    maker.remove_rows(left[state.rows.sort[left] == Sort.ADOPTED])


def _place(maker: Maker, new: GeneratedCurve, fresh: IntArray) -> None:
    """Put points that stay where the definitions have them; new ones lie there already."""
    rows, places = points_given(maker.state, [new])
    old = ~np.isin(rows, fresh)
    maker.journal.put(maker.state.rows.xyz, rows[old], places[old])
