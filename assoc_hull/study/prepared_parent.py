"""The hull that a study varies, prepared once, and its variants in numbers.

A variant keeps the structure of its parent: all points go where the certified map sends them,
or slide back into the planes of their lines, all lines are lofted again through them, and what
any edit is checked for is checked. So it is an edit of a copy of the parent, and as good as one.

Variants of a hull in numbers: carried by its program, measured by the layout of its surface.

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
from assoc_hull.analysis.hydrostatics.flotation import Flotation, flotation, flotation_of_lines
from assoc_hull.analysis.net.curve_net import CurveNet
from assoc_hull.edit.document import Document
from assoc_hull.edit.published_program import published_program
from assoc_hull.edit.recut.carry_numbers import CarriedNumbers, NetMap, NetNumbers, carry_net
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import AssocHullError, BadInputError, FoldError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.model.tables import HullState, Particulars, copy_state
from assoc_hull.study.design import StudyDesign
from assoc_hull.variation.aiming.outputs import Outputs
from assoc_hull.variation.aiming.reach_targets import settle_plan, targets_before
from assoc_hull.variation.carrying.admissible_values import AdmissibleValues
from assoc_hull.variation.carrying.carry_stages import StagedCarry
from assoc_hull.variation.carrying.hull_maps import HullMaps, LaidMap
from assoc_hull.variation.certificate.fold_check import Certificate, certify
from assoc_hull.variation.parameters.catalogue import Freedom
from assoc_hull.variation.parameters.parameter_measures import measure_all
from assoc_hull.variation.parameters.parent import parent_of
from assoc_hull.variation.parameters.stages import class_plan
from assoc_hull.variation.parameters.value_limits import hull_box, present_values
from assoc_hull.variation.request import TOLERANCE, VariationRequest

__all__ = ["ParentNumbers", "StudyParent", "Variant", "VariantNumbers"]

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
        layouts = self.parent.layouts
        for k, base in enumerate(layouts):
            kept = flotation_on_lines(base, net.batch, net.x, net.place, net.normal, size)
            if kept is not None:
                layouts.insert(0, layouts.pop(k))  # the next variant is most likely like this one
                return kept
        base = self.parent.base
        found = flotation_of_lines(base.state, net, base.kinds, size)
        # Another variant may fit it: its numbers are the same, on whichever layout that fits.
        layouts[:] = [found, *layouts[: _LAYOUTS - 1]]
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
        Hulls of its structure whose layouts are at hand, that which fitted last first.
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


_PROBES = (0.1, 1e-3)
"""Parts of usual changes by which it is found which lines drive; a smaller one if one folds."""


@attrs.frozen(eq=False)
class Variant:
    """A hull that a map has carried.

    Attributes
    ----------
    made : VariantNumbers or Document
        The hull in numbers; or as a document with one step, where numbers do not tell it.
    certificate : Certificate
        That the map folds nothing.
    shift : float, m
        The largest movement of a point that the parent has as well.
    anew : bool
        Whether its lines were cut anew, by the plan of `vary`: the parent's structure would not do.
    """

    made: VariantNumbers | Document
    certificate: Certificate
    shift: float
    anew: bool = False


@attrs.frozen(eq=False)
class StudyParent:
    """The parent of a study.

    Attributes
    ----------
    maps : HullMaps
        Its maps by the amplitudes of all parameters.
    lines : (d,) int
        The lines that drive, whatever the amplitudes.
    follow : bool
        Whether planes of waterlines and buttocks go along.
    aims, outputs : Outputs
        What is aimed at, and all that is told.
    numbers : ParentNumbers or None
        What gives variants in numbers; None where its lines are made by more than their points.
    """

    maps: HullMaps
    lines: IntArray
    follow: bool
    aims: Outputs
    outputs: Outputs
    numbers: ParentNumbers | None

    @classmethod
    def of(cls, state: HullState, design: StudyDesign) -> StudyParent:
        """Prepare a hull; its tables are not changed, and must not change meanwhile.

        Raises
        ------
        UnknownNameError
            No such output.
        BadInputError
            The parent has not what a parameter changes, or an output; no line can drive.
        """
        measures = measure_all(state)
        was = present_values(measures, design.layout)
        for name in design.names:
            if name in measures.absent:
                raise BadInputError(
                    f"cannot vary '{name}': {measures.absent[name]}", "in study", "leave it out"
                )
        parent = parent_of(state, measures)
        room = AdmissibleValues(state, parent, was, design.layout, hull_box(state, TOLERANCE))
        layers = {each.name: each for each in design.layers}
        free = tuple(
            Freedom.raw(layers[name]) if name in layers
            else Freedom.named(name, was[name], state.particulars.length)
            for name in design.names
        )  # fmt: skip
        maps = HullMaps(room, VariationRequest({}, layout=design.layout), {}, free)
        lines, follow = _driving(maps)
        aims, outputs = (Outputs.of(state, names) for names in (design.aims, design.outputs))
        return cls(maps, lines, follow, aims, outputs, ParentNumbers.of(state))

    @property
    def usual(self) -> FloatArray:
        """Usual changes of all parameters, (p,)."""
        return np.array([each.usual for each in self.maps.free])

    @property
    def present(self) -> FloatArray:
        """Values of all parameters of the parent, (p,)."""
        return np.array([each.present for each in self.maps.free])

    def variant(self, values: FloatArray) -> Variant:
        """Make a variant.

        Parameters
        ----------
        values : (p,)
            Of all parameters: m, degrees, or factors on layers.

        Raises
        ------
        FoldError, OutOfRangeError, BadInputError, RefusedEditError
            There is no such hull of this structure; why.
        """
        amplitudes = self._admitted(values)
        try:
            return self._kept(amplitudes)
        except AssocHullError as error:
            document, certificate = self._anew(amplitudes, "variant", error)
        return Variant(document, certificate, self._shift(document.state.rows.xyz.data), anew=True)

    def document(self, values: FloatArray, name: str) -> Document:
        """Make a variant as a document with one step of that name; see `variant`."""
        amplitudes = self._admitted(values)
        try:
            return self._edited(self._laid(amplitudes)[0], name)
        except AssocHullError as error:
            return self._anew(amplitudes, name, error)[0]

    def _admitted(self, values: FloatArray) -> FloatArray:
        """Give the amplitudes of values; refuse those that make no hull."""
        amplitudes: FloatArray = values - self.present
        self.maps.room.check(self.maps.values(amplitudes))
        return amplitudes

    def _shift(self, places: FloatArray) -> float:
        """Give the largest movement of a point of the parent that is still there, m."""
        rows = self.maps.state.rows
        live = self.maps.state.live("rows")
        step = places[live] - rows.xyz[live]
        return float(np.sqrt((step * step).sum(axis=1).max(initial=0.0)))

    def _laid(self, amplitudes: FloatArray) -> tuple[LaidMap, Certificate]:
        """Lay out a map, and certify that it folds nothing."""
        maps = self.maps
        vmap = maps.map(amplitudes)
        certificate = certify(vmap, maps.room.box)
        certificate.check()
        laid = maps.laid(amplitudes, self.lines, follow=self.follow, vmap=vmap)
        return laid, certificate

    def _kept(self, amplitudes: FloatArray) -> Variant:
        """Carry the net with the structure of the parent, by one map."""
        laid, certificate = self._laid(amplitudes)
        numbers = None if self.numbers is None else self.numbers.carry(laid, self.lines)
        if numbers is not None and numbers.net is not None:
            return Variant(numbers, certificate, self._shift(numbers.xyz))
        document = self._edited(laid, "variant")
        return Variant(document, certificate, self._shift(document.state.rows.xyz.data))

    def _edited(self, laid: LaidMap, name: str) -> Document:
        """Carry the net by an edit of a copy of the parent."""
        document = Document(copy_state(self.maps.state))
        with Transaction(document, name) as edit:
            carry_net(
                edit,
                NetMap(laid.space, self.lines, laid.planes, laid.features, laid.particulars),
            )
        return document

    def _anew(
        self, amplitudes: FloatArray, name: str, error: AssocHullError
    ) -> tuple[Document, Certificate]:
        """Vary the parent as `vary` does; where that cannot be either, the reason is the first one.

        A map that folds is not taken in parts here: rows that cannot be are many, and should be
        refused soon.
        """
        maps = self.maps
        pairs = list(zip(maps.free, amplitudes.tolist(), strict=True))
        values = {each.name: each.present + by for each, by in pairs if each.layer is None and by}
        layers = [layer for each, by in pairs if (layer := each.scaled(by)) is not None]
        ask = attrs.evolve(maps.ask, values=values, layers=tuple(layers), name=name)
        document = Document(copy_state(maps.state))
        try:
            with Transaction(document, name) as edit:
                plan = class_plan(values, layers=bool(layers))
                carry = StagedCarry(edit, ask, plan, refines=not isinstance(error, FoldError))
                settle_plan(carry, maps.room, targets_before(maps.room, ask))
        except AssocHullError:
            raise error from None
        return document, carry.certificate

    def measured(self, variant: Variant) -> FloatArray:
        """Give the outputs that are aimed at, (m,), by the layout of the parent's surface.

        Where the net has another structure all is laid out anew, as in `fully`.

        Raises
        ------
        BadInputError, OutOfRangeError
            It lacks one of them, or does not float at its draught.
        """
        made = variant.made
        if isinstance(made, Document):
            return self.aims.values(made.state, like=self.maps.state)
        return self.aims.values_of(made.body, made.particulars)

    def fully(self, variant: Variant) -> FloatArray:
        """Give all outputs, (o,), with the bits of a hull that has never been seen.

        Raises
        ------
        BadInputError, OutOfRangeError
            As `measured`; or the hull is doubtful.
        """
        made = variant.made
        if isinstance(made, Document):
            return self.outputs.values(made.state)
        return self.outputs.values_of(made.body, made.particulars, strict=True)


def _driving(maps: HullMaps) -> tuple[IntArray, bool]:
    """Find which lines drive when all parameters change."""
    usual = Freedom.probe(maps.free)
    for part in _PROBES[:-1]:
        try:
            return maps.driving(part * usual)
        except AssocHullError:
            continue
    return maps.driving(_PROBES[-1] * usual)
