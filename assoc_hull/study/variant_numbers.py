"""Variants of a hull in numbers: carried by its program, measured by the layout of its surface.

Most variants have the structure of their parent: the same lines cross, in the same order. Then
nothing is written to tables. The numbers of the parent's program are run on new places of points,
and the surface is the parent's, put on the lines as they have become. The numbers have the bits of
the hull that an edit makes of the parent by the same map. Where the structure becomes another there
are no such numbers, and the hull is made by that edit.
"""

from __future__ import annotations

from functools import cached_property

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.derivatives.reused_layout import flotation_on_lines
from assoc_hull.analysis.hydrostatics.flotation import (
    Flotation,
    flotation,
    flotation_of_lines,
)
from assoc_hull.analysis.net.curve_net import CurveNet
from assoc_hull.edit.document import Document
from assoc_hull.edit.published_program import published_program
from assoc_hull.edit.recut.carry_numbers import CarriedNumbers, NetNumbers
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.model.tables import HullState, Particulars
from assoc_hull.variation.carrying.hull_maps import LaidMap

__all__ = ["ParentNumbers", "VariantNumbers"]

_LAYOUTS = 4
"""So many layouts are kept."""


@attrs.frozen(eq=False)
class VariantNumbers:
    """A variant in numbers.

    Attributes
    ----------
    parent : ParentNumbers
    carried : CarriedNumbers
    particulars : Particulars
        Its dimensions.
    """

    parent: ParentNumbers
    carried: CarriedNumbers
    particulars: Particulars

    @property
    def xyz(self) -> FloatArray:
        """Places of all points of the parent's tables, (rows, 3), m."""
        return self.carried.values.xyz

    @cached_property
    def net(self) -> CurveNet | None:
        """Its lines; None where one has left a plane that says what it is."""
        return self.parent.lines(self.carried)

    @cached_property
    def body(self) -> Flotation:
        """Its surface, with the bits of a hull that has never been seen."""
        net, size = self.net, self.particulars
        assert net is not None
        for base in self.parent.layouts:
            kept = flotation_on_lines(base, net.batch, net.x, net.place, net.normal, size)
            if kept is not None:
                return kept
        base = self.parent.base
        found = flotation_of_lines(base.state, net, base.kinds, size)
        # Another variant may fit it: its numbers are the same, on whichever layout that fits.
        self.parent.layouts[_LAYOUTS - 1 :] = [found]
        return found


@attrs.frozen(eq=False)
class ParentNumbers:
    """A parent, ready to give variants in numbers.

    Attributes
    ----------
    net : NetNumbers
        What carries it.
    base : Flotation
        Its surface.
    line : (m,) int
        The line of each curve of the surface.
    across : (m,) bool
        Curves that stand across the ship.
    knot, meeting : (k, 2) int
        Where the numbers have the parameters of each crossing on its two curves: as a knot, else
        as a meeting; -1 where not.
    layouts : list of Flotation
        Hulls of its structure whose layouts are at hand, the parent first.
    """

    net: NetNumbers
    base: Flotation
    line: IntArray
    across: NDArray[np.bool_]
    knot: IntArray
    meeting: IntArray
    layouts: list[Flotation]

    @classmethod
    def of(cls, state: HullState) -> ParentNumbers | None:
        """Prepare a hull; None where it has tunnels, or lines are made by more than their points.

        Raises
        ------
        BadInputError
            It has no surface.
        """
        if state.tunnels:
            return None  # the edit looks whether a tunnel leaves the hull
        document = Document(state)
        published = published_program(document)
        if published is None:
            return None
        net = NetNumbers.of(document.state.published(), document.index, published)
        if net is None:
            return None
        base, program = flotation(state), published.program
        lines, row = base.net, base.net.row
        side = (state.rows.curve[row][:, :1] != lines.curve[lines.meets]).astype(np.int64)
        known = np.full((state.rows.count, 2), -1)
        held = np.flatnonzero(program.meet_row >= 0)
        owner = program.number[program.meet_curve[held]]
        at = program.meet_row[held]
        known[at, (state.rows.curve[at, 0] != owner).astype(np.int64)] = held
        knot, meeting = net.knots[row[:, None], side], known[row[:, None], side]
        if ((knot < 0) & (meeting < 0)).any():
            return None
        return cls(
            net, base, state.curves.line[lines.curve], np.isfinite(lines.x), knot, meeting, [base]
        )

    def carry(self, laid: LaidMap, lines: IntArray) -> VariantNumbers | None:
        """Carry the parent by a map, of which given lines (d,) drive; None for another structure.

        Raises
        ------
        BadInputError
            As `carry_net`.
        """
        found = self.net.carry(laid.space, lines, laid.planes)
        return None if found is None else VariantNumbers(self, found, laid.particulars)

    def lines(self, carried: CarriedNumbers) -> CurveNet | None:
        """Give the lines of the surface as they have become; None where one is of another kind."""
        planes, values, was = carried.planes, carried.values, self.base.net
        planar, normal = planes.planar[self.line], planes.normal[self.line]
        offset = planes.offset[self.line]
        centre = planar & (np.abs(normal[:, 1]) == 1.0) & (offset == 0.0)
        if not planar[self.across].all() or (centre != was.centre).any():
            return None
        place = np.where(self.knot >= 0, values.knot.take(self.knot), values.at.take(self.meeting))
        return attrs.evolve(
            was, batch=carried.splines(was.curve), place=place,
            x=np.where(self.across, offset * normal[:, 0], np.nan),
            normal=np.where(planar[:, None], normal, np.nan),
        )  # fmt: skip
