"""A mapping carries the numbers of a net, through the program of its structure.

It is what `assoc_hull.edit.recut.carry_structure` does, to the bit, without tables: no edit is
begun, nothing is copied but numbers, and no history is written. Where lines come to meet others
than before, or a gap has to be mended, there is more to do than numbers tell: nothing is given
then, and the net is carried by an edit.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.edit.mapped_planes import TransformedPlanes
from assoc_hull.edit.recut.carried_points import (
    PointStructure,
    point_images,
    turned_directions,
    turned_ends,
)
from assoc_hull.edit.recut.carry_structure import given_points, refuse_bent
from assoc_hull.edit.recut.slide_into_planes import slide_over, ways_across
from assoc_hull.edit.space_map import SpaceMap
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.model.index import Index
from assoc_hull.model.kinds import Sort
from assoc_hull.model.program.engine import runner_of
from assoc_hull.model.program.run_program import write_points
from assoc_hull.model.program.structure import (
    CompiledFeatures,
    Program,
    PublishedProgram,
    Values,
    plane_lines,
)
from assoc_hull.model.tables import HullState

__all__ = ["CarriedNumbers", "NetNumbers"]


@attrs.frozen(eq=False)
class CarriedNumbers:
    """A net after a mapping, in numbers.

    Attributes
    ----------
    program : Program
        The structure of the parent, with planes and directions as the mapping leaves them.
    values : Values
    planes : TransformedPlanes
        Of the lines of the parent.
    """

    program: Program
    values: Values
    planes: TransformedPlanes

    def splines(self, curves: IntArray) -> SplineBatch:
        """Give curves of the tables, one behind the other."""
        run, local = runner_of(self.program), self.program.local[curves]
        return run.splines(self.values, self.values, local)[0]


@attrs.frozen(eq=False)
class NetNumbers:
    """A net that mappings carry, in numbers.

    Attributes
    ----------
    state : HullState
        The tables; they must not change.
    published : PublishedProgram
        Their program; without features, which an edit lets go where they are left.
    given : (k,) int
        The points whose places are given.
    held : (h,) int
        Those that stay where they are put, though they ride with others.
    line : (m,) int
        The line of each curve of the program.
    plane_line : (p,) int
        The line of each plane of the program.
    knots : (rows, 2) int
        Where each point defines its curves in the program, -1 where it does not.
    across : (rows, 3)
        In which direction points of one line only slide across it.
    points : PointStructure
        What of its points no mapping changes.
    """

    state: HullState
    published: PublishedProgram
    given: IntArray
    held: IntArray
    line: IntArray
    plane_line: IntArray
    knots: IntArray
    across: FloatArray
    points: PointStructure

    @classmethod
    def of(cls, state: HullState, index: Index, published: PublishedProgram) -> NetNumbers | None:
        """Prepare a net; None where some of its curves are made by more than their points.

        Parameters
        ----------
        state : HullState
            The tables, in a published state; they must not change.
        index : Index
            Look-ups derived from them.
        published : PublishedProgram
            Their program and its numbers.
        """
        program = published.program
        if program.unsure.any() or program.unsure_row.any():
            return None
        program = attrs.evolve(program, features=CompiledFeatures.none(state.rows.count))
        live = state.live("rows")
        knots = np.full((state.rows.count, 2), -1)
        owner = program.number[np.repeat(np.arange(program.curves), np.diff(program.start))]
        side = (state.rows.curve[program.row, 0] != owner).astype(np.int64)
        knots[program.row, side] = np.arange(len(program.row))
        return cls(
            state, PublishedProgram(program, published.values), given_points(state),
            live[state.rows.sort[live] == Sort.ADOPTED], state.curves.line[program.number],
            plane_lines(state, index, program), knots, ways_across(state),
            PointStructure.of(state),
        )  # fmt: skip

    def carry(
        self, space: SpaceMap, drivers: IntArray, planes: TransformedPlanes
    ) -> CarriedNumbers | None:
        """Carry the net.

        Parameters
        ----------
        space : SpaceMap
            The mapping.
        drivers : (d,) int
            Lines whose planes go along with it, boundary curves among them.
        planes : TransformedPlanes
            Where the planes of all lines go.

        Returns
        -------
        CarriedNumbers or None
            None where the net that comes of it has another structure, or is to be refused.

        Raises
        ------
        BadInputError
            As `carry_net`.
        """
        refuse_bent(self.state, planes)
        drives = np.zeros(self.state.lines.count, bool)
        drives[drivers] = True
        program = self._program(planes)
        if program is None:
            return None
        images = point_images(self.state, space, planes, drives, self.points)
        slide_over(images, self.across)
        direction, end = program.direction.copy(), program.end_vector.copy()
        for side, (rows, new) in enumerate(turned_directions(images, self.points)):
            knot = self.knots[rows, side]
            direction[knot[knot >= 0]] = new[knot >= 0]
        for curve, vectors in turned_ends(images, self.points).items():
            end[program.local[curve]] = vectors
        freeze(direction, end)
        program = attrs.evolve(program, direction=direction, end_vector=end)
        before = self.published.values
        values = before.copy()
        rows = write_points(values, self.given, images.value[self.given])
        every = np.arange(program.curves)
        run = runner_of(program).run(values, before, rows, self.held, every)
        return CarriedNumbers(program, values, planes) if run.kept else None

    def _program(self, planes: TransformedPlanes) -> Program | None:
        """Give the program with its planes where they go; None where one turns or lies no more."""
        program, table = self.published.program, self.state.lines
        mine = self.plane_line
        if not planes.planar[mine].all() or (planes.normal[mine] != table.normal[mine]).any():
            return None
        offset = planes.offset[mine]
        rising: NDArray[np.bool_] = np.diff(offset) > 0.0
        rising[program.first[1:-1] - 1] = True
        if not rising.all():
            return None
        normal = planes.normal[self.line]
        flat = (normal == 1.0).any(axis=1)
        axis = np.where(flat, np.argmax(normal == 1.0, axis=1), -1)
        own = np.where(flat, planes.offset[self.line], 0.0)
        freeze(offset, axis, own)
        return attrs.evolve(program, offset=offset, own_axis=axis, own_offset=own)
