"""Section shifts and swinging: a new hull of other coefficients, its sections as they are.

Examples
--------
>>> import assoc_hull as ah
>>> parent = ah.examples.wigley()
>>> fuller = ah.shift_sections(parent, by={"cb": 0.01})
>>> before, after = (ah.hydrostatics(hull) for hull in (parent, fuller.hull))
>>> round(after.cb - before.cb, 9), round(after.lcb - before.lcb, 7)
(0.01, 0.0)
"""

from __future__ import annotations

from collections.abc import Mapping

import attrs
from numpy.typing import ArrayLike

from assoc_hull.hull import Hull, to_change
from assoc_hull.variation.fields.space_map import VariationMap
from assoc_hull.variation.request import TOLERANCE
from assoc_hull.variation.shifts.shift_hull import ShiftReport, shift_document
from assoc_hull.variation.shifts.shift_request import ShiftRequest
from assoc_hull.variation.shifts.shift_terms import Fade, ShiftShape, Terminals
from assoc_hull.variation.shifts.swing_hull import swing_document

__all__ = ["Shifted", "shift_sections", "swing"]


@attrs.frozen(eq=False)
class Shifted:
    """A hull whose sections were shifted, or that was swung.

    Attributes
    ----------
    hull : Hull
        The variant; undo gives the parent back.
    report : ShiftReport
        What was asked, reached and moved.
    map : VMap
        The map that carries places of the parent to those of the variant, m.
    """

    hull: Hull
    report: ShiftReport
    map: VariationMap

    def __str__(self) -> str:
        return str(self.report)


def shift_sections(
    hull: Hull,
    *,
    to: Mapping[str, float] | None = None,
    by: Mapping[str, float] | None = None,
    shape: ShiftShape = "c2",
    terminals: ArrayLike | Terminals | None = None,
    fade: Fade = "b5",
    tolerance: float = TOLERANCE,
    name: str | None = None,
    in_place: bool = False,
) -> Shifted:
    """Shift the sections of a hull along the ship so that its volume and centre are as asked.

    Every section keeps its shape; the ends of the hull stay where they are. After Lackenby (1950),
    by a closed form that is exact for the curve of areas, then by Newton's rule on the
    hydrostatics of the varied hull, to 1e-10. What is not asked for is held: the block
    coefficient, the centre of buoyancy, the other body, the ends of the parallel body.

    Parameters
    ----------
    hull : Hull
        The parent.
    to : mapping of str to float
        Values that are to be had at the design draught: one of ``cb``, ``cp``, ``volume`` (m3),
        and one of ``lcb`` (m from AP) and ``lcb_percent`` (% Lpp from midship, + forward); or
        ``Cpf`` and ``Cpa``, the prismatic coefficients of fore and after body, each on its own.
        With either, ``parallel_body_start`` and ``parallel_body_end`` (m from AP): where the inner
        two terminals are to be.
    by : mapping of str to float
        Changes of present values, by the same names; what is in `to` cannot be here.
    shape : str
        Of the movement between parallel body and end: ``"c2"`` leaves with slope and curvature
        nil at both; ``"c1"``, ``"end"``, ``"half"``, ``"lackenby"`` are those of
        `assoc_hull.variation.fields.shift_shapes.BUMP_SHAPES`; ``"1-cp"`` is a straight line,
        which lengthens the parallel body.
    terminals : (4,), m from AP, or Terminals
        After terminal, start and end of the parallel body, fore terminal. Nothing moves abaft the
        first and forward of the last. By default where the profile begins to rise, and the measured
        ends of the parallel body; on a hull without one, the two stations with the largest areas.
    fade : {"b5", "linear"}
        How the movement of an end of the parallel body fades out to the terminal.
    tolerance : float, m
        How far a line may leave its exact image.
    name : str
        Of the step in the history; by default it tells the values.
    in_place : bool
        Shift this hull, as a step that can be undone; else a copy of it.

    Returns
    -------
    Shifted
        The hull, what was reached, and the map.

    Raises
    ------
    OutOfRangeError
        Sections would cross, or no shift gives what is asked for; with the largest change that
        can be had.
    UnknownNameError, BadInputError, WrongTypeError
        What is asked for is not clear, or the hull has not what it takes.
    RefusedEditError
        A line would fold or lose its order. The hull is unchanged, whatever the error.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> found = ah.shift_sections(ah.examples.wigley(), by={"lcb_percent": 0.5}, to={"cb": 0.45})
    >>> [f"{target.reached:.6f}" for target in found.report.targets]
    ['0.450000', '0.500000']
    """
    ask = ShiftRequest.of(
        to, by, shape=shape, terminals=terminals, fade=fade, tolerance=tolerance, name=name
    )
    varied = to_change(hull, "shift_sections", in_place=in_place)
    vmap, report = shift_document(varied.document, ask)
    return Shifted(varied, report, vmap)


def swing(
    hull: Hull,
    *,
    length: float | None = None,
    breadth: float | None = None,
    draught: float | None = None,
    name: str | None = None,
    in_place: bool = False,
) -> Shifted:
    """Change breadth against draught, or length against both, at the same volume and coefficients.

    The map is affine, heights above the draught included. What lofting again leaves over of
    volume and centre (1e-6) is taken away by a shift of sections of less than a millimetre or so,
    so that volume, CB, and LCB in parts of Lpp are held to 1e-10.

    Parameters
    ----------
    hull : Hull
        The parent.
    length, breadth, draught : float, m
        One or two of them. The rest gives way: breadth to draught and draught to breadth; with a
        length alone, both in one ratio.
    name : str
        Of the step in the history.
    in_place : bool
        Vary this hull, as a step that can be undone; else a copy of it.

    Returns
    -------
    Shifted
        The hull, what was reached, and the map.

    Raises
    ------
    BadInputError
        None of the three is given, or all; one is no positive number. The hull is unchanged.

    See Also
    --------
    assoc_hull.vary : dimensions one by one; CB is held by each of them, the volume is not.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> variant = ah.swing(ah.examples.wigley(), breadth=12.5).hull
    >>> variant.state.particulars.draught, round(ah.hydrostatics(variant).cb, 3)
    (5.0, 0.444)
    """
    asked = {"length": length, "breadth": breadth, "draught": draught}
    varied = to_change(hull, "swing", in_place=in_place)
    vmap, report = swing_document(varied.document, asked, name)
    return Shifted(varied, report, vmap)
