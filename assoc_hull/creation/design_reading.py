"""A design read off a hull: form parameters of its curves, and by how much each curve misses.

Contour, deck edge and flats become courses; sectional areas and the waterline at the draught become
curves of two halves, closed to volume and centre of buoyancy; sections become form-parameter
curves, whose values at the stations are nodes of courses. S.Y. Kim, S.W. Kang, "Ship Lines Creation
by B-Spline Form Parameter Method", Trans. SNAK 29(2), 1992, take form parameters off a parent so.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from typing import Any

import attrs
import numpy as np

from assoc_hull.analysis.fairness.fair_solution import linear_algebra
from assoc_hull.analysis.hydrostatics.flotation import flotation
from assoc_hull.analysis.net.curve_net import CurveNet, gather_net
from assoc_hull.arguments import text
from assoc_hull.creation.design import Design
from assoc_hull.creation.fitted_courses import (
    DrawnPath,
    PathNode,
    distances,
    fit_halves,
    fit_path,
)
from assoc_hull.creation.fitted_sections import DrawnSection, SectionFit, evenly, fit_sections
from assoc_hull.creation.form_definitions import course
from assoc_hull.display import ShownAsText
from assoc_hull.errors import AssocHullError, BadInputError, UnknownNameError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.geometry.floating.sections import cross_section, integrate_slice, sections_below
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.model.form_definition import FormDefinition
from assoc_hull.model.forms.form_values import Forms
from assoc_hull.model.forms.line_layout import layout_at
from assoc_hull.model.forms.sections import bilge_radius_for, section_shape, span_of
from assoc_hull.model.tables import HullState, Particulars

__all__ = ["CurveResidual", "DesignReading", "design_of_hull"]


@attrs.frozen
class CurveResidual:
    """How far a curve made of form parameters lies off the one that they were read off.

    Attributes
    ----------
    name : str
        Use of the definition, or name of the section.
    unit : str
        m, or m2 of areas.
    rms, largest : float
        Of points along the curve.
    where : str
        Place of the largest.
    """

    name: str
    unit: str
    rms: float
    largest: float
    where: str


@attrs.frozen(repr=False)
class DesignReading(ShownAsText):
    """A design that was read off a hull.

    Attributes
    ----------
    design : Design
        What `create` makes the hull of again; its values can be changed.
    residuals : tuple of CurveResidual
        Of each curve: areas, waterline, boundary curves and flats, then sections from aft.
    notes : tuple of str
        What could not be read, or was left out, and why.
    """

    design: Design
    residuals: tuple[CurveResidual, ...]
    notes: tuple[str, ...] = ()

    def residual(self, name: str) -> CurveResidual:
        """Give the residual of a curve by its name; UnknownNameError if there is none."""
        for each in self.residuals:
            if each.name == name:
                return each
        known = tuple(each.name for each in self.residuals)
        raise UnknownNameError("curve", text(name, "name", "in a design"), known)

    def data(self) -> dict[str, Any]:
        """Give residuals and notes as plain values."""
        return {
            "residuals": [attrs.asdict(each) for each in self.residuals],
            "notes": list(self.notes),
        }

    def __str__(self) -> str:
        ship = self.design.particulars
        lines = [
            f"{ship.name}: {len(self.design.definitions)} definitions",
            f"{'curve':20}{'rms':>9}{'largest':>9}     where",
        ]
        lines += [
            f"{each.name:20}{each.rms:9.4f}{each.largest:9.4f} {each.unit:3} {each.where}"
            for each in self.residuals
        ]
        return "\n".join([*lines, *self.notes]) + "\n"


_FINE = 1e-4
"""Of the breadth: by so much courses of boundary curves may pass these."""

_OPEN = 1e-3
"""Of the breadth: a wider gap between profile and deck edge leaves the hull open."""

_ROUGH, _ON_FLAT = 5e-4, 1e-3
"""Of the breadth, by which courses of flats may pass the borders of these; so near (m) to its plane
the border of a flat lies."""

_FULL = 2e-3
"""By so much of its largest value a curve may be less where it counts as full."""

_FAR = 1e4
"""m: farther than any ship reaches."""

_ARC = 2e-3
"""Of the breadth: by so much a section of the parallel body may pass flats with an arc between."""

_ROOM = 0.97
"""Of the box between contour and waterline: so much a section may fill."""

_WITHIN, _LEAST_END = 1e-2, 2e-3
"""So far (m) within the ends of the waterline the area there is taken; a smaller one, of the
largest, is none."""

_PARALLEL = 0.02
"""A shorter parallel part, in halves of the length, is none."""


def design_of_hull(state: HullState) -> DesignReading:
    """Read form parameters off a hull; of one with definitions, give its own.

    Raises BadInputError where contour, deck edge or sections are not there, or where the hull is
    open at the centre plane.
    """
    if state.definitions:
        return _own(state)
    with linear_algebra().limit(limits=1):
        # Other threads would give other last digits.
        return _Reader.of(state).read()


def _own(state: HullState) -> DesignReading:
    """Give the design that a created hull holds."""
    ship = state.particulars
    net = gather_net(state)
    design = Design(
        ship, state.definitions, [20.0 * x / ship.length for x in _planes(net, "sections", 0)],
        _planes(net, "waterlines", 2), _planes(net, "buttocks", 1), _transom(net)[0],
        state.tolerances,
    )  # fmt: skip
    notes = ["the hull was created from definitions: these are its own, nothing was read off"]
    edited = sum(
        not each.attached and bool(state.curves.alive[each.curve]) for each in state.generated
    )
    if edited:
        notes.append(f"{edited} of its curves were edited by hand since, which the design has not")
    return DesignReading(design, (), tuple(notes))


def _planes(net: CurveNet, family: str, axis: int) -> list[float]:
    """Give where the lines of a family stand, m, ascending."""
    found = {
        round(float(net.batch.xyz[net.batch.start[number], axis]), 9)
        for number in range(len(net.curve))
        if net.family[number] == family
    }
    return sorted(found)


def _transom(net: CurveNet) -> tuple[float | None, list[int]]:
    """Give x (m) of a flat transom, abaft all sections, and its curves."""
    sections = [x for x, each in zip(net.x, net.family, strict=True) if each == "sections"]
    aft = min((float(x) for x in sections if math.isfinite(x)), default=-math.inf)
    found = [
        number for number in range(len(net.curve))
        if net.end[number] and math.isfinite(net.x[number]) and net.x[number] < aft + 1e-6
    ]  # fmt: skip
    return (float(net.x[found[0]]) if found else None), found


@attrs.frozen(eq=False)
class _Reader:
    """A hull that is read.

    Attributes
    ----------
    state, net : HullState, CurveNet
        The hull and its curves.
    ship : Particulars
        Dimensions.
    residuals, notes : list
        What was found so far.
    """

    state: HullState
    net: CurveNet
    ship: Particulars
    residuals: list[CurveResidual]
    notes: list[str]

    @classmethod
    def of(cls, state: HullState) -> _Reader:
        return cls(state, gather_net(state), state.particulars, [], [])

    def read(self) -> DesignReading:
        """Read boundary and flats, then areas and waterline, then sections."""
        boundary = self._boundary()
        drawn = self._drawn()
        base = [*boundary, *self._flats()]
        base += self._halves(base, drawn)
        base += self._bilge(Forms.of(base, self.ship), drawn)
        some = [*base, course("keel_angle", {"any": (0.0, 45.0)})]
        bulb = self._bulb(some, drawn)
        fits = self._fitted(Forms.of([*some, *bulb], self.ship), drawn)
        definitions, fits = self._sound(base, fits)
        for fit in fits:
            self._tell(fit.section.name, "m", fit.off,
                       [f"z = {z:.2f} m" for z in fit.section.at[:, 0].tolist()])  # fmt: skip
        stations = [20.0 * x / self.ship.length for x in sorted({fit.section.x for fit in fits})]
        x, _ = _transom(self.net)
        stations = [s for s in stations if x is None or abs(s * self.ship.length / 20.0 - x) > 1e-6]
        design = Design(
            self.ship, definitions, stations, _planes(self.net, "waterlines", 2),
            _planes(self.net, "buttocks", 1), x, self.state.tolerances,
        )  # fmt: skip
        return DesignReading(design, tuple(self.residuals), tuple(self.notes))

    # ----------------------------------------------------------------------------------
    # Boundary curves and flats.

    def _boundary(self) -> list[FormDefinition]:
        profile = self._ends("profile", lambda n: bool(self.net.centre[n]))
        deck = self._ends(
            "deck edge", lambda n: not self.net.centre[n] and not math.isfinite(self.net.x[n])
        )
        fine = _FINE * self.ship.breadth
        found = []
        for use, curves, axes, onward in (
            ("profile", profile, (0, 2), False), ("deck_side", deck, (0, 1), True),
            ("deck_height", deck, (0, 2), True),
        ):  # fmt: skip
            path = DrawnPath.of([self.net.batch.curve(n) for n in curves], axes)
            found.append(self._laid(use, path, fine, onward))
        self._meets(profile, deck)
        return found

    def _meets(self, profile: Sequence[int], deck: Sequence[int]) -> None:
        """Refuse a hull whose deck edge and profile leave it open ahead, or abaft."""
        contour, edge = (
            np.concatenate([self.net.batch.curve(n).xyz[[0, -1]] for n in some])
            for some in (profile, deck)
        )
        for place, end in (("ahead", 1.0), ("abaft", -1.0)):
            if place == "abaft" and _transom(self.net)[0] is not None:
                continue
            one, other = (each[(end * each[:, 0]).argmax()] for each in (contour, edge))
            gap = float(np.sqrt(((one - other) ** 2).sum()))
            if gap > _OPEN * self.ship.breadth:
                what = f"the hull is open {place}: profile and deck edge end {gap:.4g} m apart"
                remedy = "let them meet there" + (", or in a flat transom" if end < 0.0 else "")
                raise BadInputError(what, f"in the hull {self.ship.name!r}", remedy)

    def _ends(self, what: str, chosen: Callable[[int], bool]) -> list[int]:
        """Give the boundary curves of a kind, from aft forward."""
        found = [
            n for n in range(len(self.net.curve))
            if self.net.end[n] and self.net.family[n] == "boundary" and chosen(n)
        ]  # fmt: skip
        if not found:
            raise BadInputError(
                f"there is no {what}", f"in the hull {self.ship.name!r}",
                "give the boundary curve, or read a hull that has one",
            )  # fmt: skip
        start = {n: float(min(self.net.batch.curve(n).xyz[[0, -1], 0])) for n in found}
        return sorted(found, key=lambda n: start[n])

    def _flats(self) -> list[FormDefinition]:
        """Read the lower border of the flat of side, and that of the flat of bottom."""
        found = []
        for use, axis, value in (
            ("flat_of_side", 1, 0.5 * self.ship.breadth), ("flat_of_bottom", 2, 0.0),
        ):  # fmt: skip
            for n in range(len(self.net.curve)):
                curve = self.net.batch.curve(n)
                across = sample(curve, 4)[1][:, axis] - value
                if self.net.flat[n] and float(np.abs(across).max()) < _ON_FLAT:
                    path = DrawnPath.of([curve], (0, 3 - axis))
                    found.append(self._laid(use, path, _ROUGH * self.ship.breadth, True))
                    break
        return found

    def _laid(self, use: str, path: DrawnPath, tolerance: float, onward: bool) -> FormDefinition:
        """Lay a course along a path; with `onward` it has one ordinate at each abscissa."""
        nodes, off = fit_path(path, tolerance, onward)
        x, y = path.at.T
        aft, _ = _transom(self.net)
        if not use.startswith("flat") and aft is not None and abs(nodes[0].x - aft) < _ON_FLAT:
            nodes[0] = attrs.evolve(nodes[0], x=aft)
        made = _course(use, nodes)
        try:
            Forms.of([made], self.ship).chain(use)
        except BadInputError:
            # A curve that runs back somewhere: through those places that lie ahead of all before.
            keep = np.concatenate([[True], np.diff(np.maximum.accumulate(x)) > 1e-3])
            # Its last place stays, where others end on it.
            keep[-1] = x[-1] >= x[:-1].max()
            made, off = _through(use, x[keep], y[keep], self.ship, tolerance)
            x = x[keep]
        self._tell(use, "m", off, [f"x = {each:.2f} m" for each in x.tolist()])
        return made

    # ----------------------------------------------------------------------------------
    # Drawn sections.

    def _drawn(self) -> list[DrawnSection]:
        """Give the sections as points, and the transom; they have no layout yet."""
        by_place: dict[float, list[int]] = {}
        for n in range(len(self.net.curve)):
            if self.net.family[n] == "sections" and math.isfinite(self.net.x[n]):
                by_place.setdefault(float(self.net.x[n]), []).append(n)
        if len(by_place) < 5:
            raise BadInputError(
                f"{len(by_place)} section(s)", f"in the hull {self.ship.name!r}",
                "give at least five, so that curves of areas and waterline can be read",
            )  # fmt: skip
        x, transom = _transom(self.net)
        if x is not None:
            by_place[x] = transom
        found = []
        for place, curves in sorted(by_place.items()):
            points = [sample(self.net.batch.curve(n), 24)[1][:, [2, 1]] for n in curves]
            points = [each if each[-1, 0] >= each[0, 0] else each[::-1] for each in points]
            points.sort(key=lambda each: float(each[0, 0]))
            name = self.net.name[curves[0]]
            for part, each in enumerate(points):
                ends = np.column_stack([np.full(2, place), each[[0, -1]][:, ::-1]])
                found.append(DrawnSection(name, place, part, "", each, ends))
        return found

    def _at_draught(self, points: FloatArray) -> float:
        """Give the half-breadth of a section, (m, 2) z and y, at the draught; nan above it."""
        z = points[:, 0]
        if not z[0] < self.ship.draught < z[-1]:
            return math.nan
        upper = int(np.flatnonzero(z <= self.ship.draught)[-1])
        low, high = points[upper], points[upper + 1]
        share = (self.ship.draught - low[0]) / (high[0] - low[0])
        return float(low[1] + share * (high[1] - low[1]))

    def _area(self, points: FloatArray) -> float:
        """Give the area (m2) of both sides of a section below the draught."""
        z, y = np.minimum(points[:, 0], self.ship.draught), points[:, 1]
        return 2.0 * float(((y[1:] + y[:-1]) * 0.5 * np.diff(z)).sum())

    # ----------------------------------------------------------------------------------
    # Areas and waterline.

    def _halves(
        self, base: Sequence[FormDefinition], drawn: Sequence[DrawnSection]
    ) -> list[FormDefinition]:
        ship, forms = self.ship, Forms.of(base, self.ship)
        half = 0.5 * ship.length
        aft, fore = self._water_ends(forms, drawn)
        area: dict[float, float] = {}
        width: dict[float, float] = {}
        for each in drawn:
            area[each.x] = area.get(each.x, 0.0) + self._area(each.at)
            water = self._at_draught(each.at)
            if math.isfinite(water):
                width[each.x] = water
        x = np.array([each for each in sorted(width) if aft[0] + 1e-6 < each < fore[0] - 1e-6])
        y = np.array([width[each] for each in x.tolist()])
        level, pinned = self._water_full(forms, x / half - 1.0, y / float(y.max()))
        # A hull that flares all along is narrower at the draught than her breadth.
        full = 0.5 * ship.breadth if pinned else float(y.max())
        ends = tuple((end / half - 1.0, breadth / full) for end, breadth in (aft, fore))
        line, left = fit_halves(
            "design waterline", "design_waterline", full, x / half - 1.0, y / full,
            (ends[0], ends[1]), level, pinned,
        )  # fmt: skip
        self._tell("design_waterline", "m", left * full, [f"x = {e:.2f} m" for e in x.tolist()])
        x = np.array(sorted(area))
        x = x[(x > aft[0] + 1e-6) & (x < fore[0] - 1e-6)]
        y = np.array([area[each] for each in x.tolist()])
        full = float(y.max())
        ends = (
            (aft[0] / half - 1.0, _not_tiny(self._end_area(aft[0] + _WITHIN) / full)),
            (fore[0] / half - 1.0, _not_tiny(self._end_area(fore[0] - _WITHIN) / full)),
        )
        level = _full_part(x / half - 1.0, y / full)
        areas, _ = fit_halves(
            "sectional areas", "sectional_area", full, x / half - 1.0, y / full, ends, level, False,
            np.maximum(self._most(forms, line, x) / full, y / full),
            self._sums(full, level, fore[0]),
        )  # fmt: skip
        left = Forms.of([areas], ship).value("sectional_area", x) - y
        self._tell("sectional_area", "m2", left, [f"x = {e:.2f} m" for e in x.tolist()])
        return [areas, line]

    def _most(self, forms: Forms, line: FormDefinition, x: FloatArray) -> FloatArray:
        """Give the areas (m2) that sections have room for, between contour and waterline."""
        breadth = Forms.of([line], self.ship).value("design_waterline", x)
        found = np.full(len(x), np.inf)
        for number, (at, wide) in enumerate(zip(x.tolist(), breadth.tolist(), strict=True)):
            heights = forms.contour(at)
            if len(heights) == 1 and wide > 0.0:
                found[number] = 2.0 * _ROOM * wide * (self.ship.draught - heights[0])
        return found

    def _water_ends(
        self, forms: Forms, drawn: Sequence[DrawnSection]
    ) -> tuple[tuple[float, float], tuple[float, float]]:
        """Give where the waterline at the draught ends: x and half-breadth, m."""
        chain = forms.chain("profile")
        places = chain.meets(1, self.ship.draught)
        x, _ = _transom(self.net)
        met = np.array([])
        if places:
            piece, t = (np.array(each) for each in zip(*places, strict=True))
            met = chain.at(piece, t)[:, 0]
        middle = 0.5 * self.ship.length
        fore = met[met > middle]
        if not len(fore):
            raise BadInputError(
                "the profile does not rise through the draught ahead of midship",
                f"in the hull {self.ship.name!r}", "give the stem, or a smaller draught",
            )  # fmt: skip
        aft = met[met < middle]
        if len(aft):
            return (float(aft.min()), 0.0), (float(fore.max()), 0.0)
        for each in drawn:
            water = self._at_draught(each.at)
            if x is not None and each.x == x and math.isfinite(water):
                return (x, water), (float(fore.max()), 0.0)
        raise BadInputError(
            "the hull is open abaft: neither profile nor transom ends the waterline",
            f"in the hull {self.ship.name!r}", "close its stern by a profile or a flat transom",
        )  # fmt: skip

    def _end_area(self, x: float) -> float:
        """Give the area (m2) of the hull shortly within an end of its waterline."""
        spans = flotation(self.state).spans
        plane = FloatingPlanes(np.array([self.ship.draught]), np.zeros(1), np.zeros(1))
        return float(sections_below(cross_section(spans, x), plane).sum())

    def _water_full(
        self, forms: Forms, frame: FloatArray, y: FloatArray
    ) -> tuple[tuple[float, float], bool]:
        """Give between which places the waterline is full, and whether a flat of side says so."""
        if forms.has("flat_of_side"):
            chain = forms.chain("flat_of_side")
            places = chain.meets(1, self.ship.draught)
            if len(places) == 2:
                piece, t = (np.array(each) for each in zip(*places, strict=True))
                low, high = (2.0 * chain.at(piece, t)[:, 0] / self.ship.length - 1.0).tolist()
                return (low, high), True
        return _full_part(frame, y), False

    def _sums(
        self, full: float, level: tuple[float, float], fore: float
    ) -> tuple[tuple[float, float], tuple[float, float]]:
        """Give area and moment of the curve of areas abaft and ahead of its middle, in its frame.

        They are those of the hull itself, so the curve has her volume and centre of buoyancy.
        """
        half = 0.5 * self.ship.length
        middle = (0.5 * sum(level) + 1.0) * half
        spans = flotation(self.state).spans
        plane = FloatingPlanes(np.array([self.ship.draught]), np.zeros(1), np.zeros(1))
        found = []
        for low, high in ((-np.inf, middle), (middle, fore)):
            part = integrate_slice(spans, low, high, plane)
            found.append((
                part.volume / (full * half),
                (part.moment_x - half * part.volume) / (full * half * half),
            ))  # fmt: skip
        return found[0], found[1]

    # ----------------------------------------------------------------------------------
    # Sections.

    def _fitted(self, forms: Forms, drawn: Sequence[DrawnSection]) -> list[SectionFit]:
        """Fit the sections; those that cannot stand where they are are left out."""
        ready = []
        parts = Counter(each.x for each in drawn)
        for each in drawn:
            heights, count = forms.contour(each.x), parts[each.x]
            overhangs = count > 1 and heights[2:3] < (self.ship.draught,)
            if len(heights) != 2 * count - 1 or overhangs:
                stands = " and ".join(f"{z:.2f}" for z in heights)
                self._leave(each, f"the contour stands at z = {stands} m there, not once, nor with "
                                  "a bulb below and the stem above the draught")  # fmt: skip
                continue
            try:
                layout = layout_at(forms, "section", each.x, each.part)
            except AssocHullError as error:
                self._leave(each, str(error))
                continue
            ends = each.ends.copy()
            ends[0] = (each.x, 0.0, heights[2 * each.part])
            if each.part + 1 < count:
                ends[1] = (each.x, 0.0, heights[2 * each.part + 1])
            else:
                deck = (float(forms.value(use, each.x)[0]) for use in ("deck_side", "deck_height"))
                ends[1] = (each.x, *deck)
            ready.append(attrs.evolve(each, layout=layout, at=evenly(each.at), ends=ends))
        return fit_sections(forms, ready)

    def _bulb(
        self, base: Sequence[FormDefinition], drawn: Sequence[DrawnSection]
    ) -> list[FormDefinition]:
        """Give where a bulb lies, as courses whose values do not count; nothing without one."""
        middle = 0.5 * self.ship.length
        round_ = [each.x for each in drawn if each.part and each.x > middle]
        if not round_:
            return []
        told = list(self.notes)
        near = [e for e in drawn if 0.8 * self.ship.length < e.x < min(round_) and not e.part]
        plain, full = (
            {fit.section.x: float(np.sqrt((fit.off**2).mean()))
             for fit in self._sound(more, self._fitted(Forms.of(more, self.ship), near))[1]}
            for more in (list(base), [*base, *_bulb_courses(-_FAR, _FAR)])
        )  # fmt: skip
        begin = min(round_)
        for x in sorted(full, reverse=True):
            if not full[x] < plain.get(x, math.inf):
                break
            begin = x
        # What was left out of a trial is told of when it is left out.
        self.notes[:] = told
        tip = float(self.net.batch.xyz[:, 0].max())
        return _bulb_courses(begin, tip)

    def _sound(
        self, base: Sequence[FormDefinition], fits: Sequence[SectionFit]
    ) -> tuple[list[FormDefinition], list[SectionFit]]:
        """Give all definitions, and the sections that can be made of them."""
        kept = list(fits)
        while True:
            made = self._courses(kept)
            new = {each.use for each in made}
            definitions = [*(each for each in base if each.use not in new), *made]
            forms = Forms.of(definitions, self.ship)
            wrong = dict[float, tuple[DrawnSection, str]]()
            for fit in kept:
                each = fit.section
                try:
                    layout = layout_at(forms, "section", each.x, each.part)
                    section_shape(forms, layout, np.array([each.x]), each.ends[None])
                except AssocHullError as error:
                    wrong[each.x] = (each, str(error))
            if not wrong:
                return definitions, kept
            for each, why in wrong.values():
                self._leave(each, why)
            kept = [fit for fit in kept if fit.section.x not in wrong]

    def _leave(self, section: DrawnSection, why: str) -> None:
        """Note that a station is left out; refuse a transom, which cannot be."""
        if section.x == _transom(self.net)[0]:
            raise BadInputError(
                f"the transom cannot be made of form parameters: {why}",
                f"in the hull {self.ship.name!r}", "end the profile at the transom's lowest point",
            )  # fmt: skip
        note = f"{section.name} was left out: {why}"
        if note not in self.notes:
            self.notes.append(note)

    def _bilge(self, forms: Forms, drawn: Sequence[DrawnSection]) -> list[FormDefinition]:
        """Read the bilge radius, where sections of the parallel body are flats and an arc."""
        low, high = span_of(forms)
        within = [each for each in drawn if low <= each.x <= high]
        water = forms.value("design_waterline", np.array([low, high]))
        if not within or high - low < 1e-3 or water.min() < 0.5 * self.ship.breadth * (1.0 - 1e-9):
            return []
        middle = within[len(within) // 2]
        foot = float(middle.at[0, 0])
        half, height = 0.5 * self.ship.breadth, self.ship.draught - foot
        full = float(forms.value("sectional_area", middle.x)[0])
        radius = bilge_radius_for(half, height, 0.5 * full)
        if not 0.0 < radius < min(half, height):
            return []
        turn = np.linspace(0.0, 0.5 * math.pi, 33)
        arc = np.stack([
            foot + radius * (1.0 - np.cos(turn)), half - radius + radius * np.sin(turn)
        ], axis=1)  # fmt: skip
        line = np.concatenate([[[foot, 0.0]], arc, [[self.ship.draught, half]]])
        off = distances(middle.at[middle.at[:, 0] <= self.ship.draught], line)
        worst = float(np.abs(off).max())
        if worst > _ARC * self.ship.breadth:
            what = f"{middle.name} passes flats with an arc of {radius:.4g} m by {worst:.2g} m"
            self.notes.append(f"there is no bilge radius: {what}")
            return []
        self._tell("bilge_radius", "m", off, [middle.name])
        return [course("bilge_radius", {"body": (middle.x, radius)})]

    def _courses(self, fits: Sequence[SectionFit]) -> list[FormDefinition]:
        """Give the courses through the values of sections."""
        nodes: dict[str, dict[str, tuple[float, float]]] = {}
        for fit in fits:
            for use, value in fit.values.items():
                nodes.setdefault(use, {})[fit.section.name] = (fit.section.x, round(value, 6))
        return [course(use, each, rule="monotone") for use, each in nodes.items()]

    def _tell(self, name: str, unit: str, off: FloatArray, where: Sequence[str]) -> None:
        size = np.abs(off)
        worst = int(size.argmax()) if len(size) else 0
        rms = float(np.sqrt((size * size).mean())) if len(size) else 0.0
        largest = float(size[worst]) if len(size) else 0.0
        place = where[min(worst, len(where) - 1)] if where else ""
        self.residuals.append(CurveResidual(name, unit, rms, largest, place))


def _bulb_courses(begin: float, end: float) -> list[FormDefinition]:
    """Give courses of a bulb between two places (m)."""
    return [
        course(use, {"from": (begin, 1.0), "to": (end, 1.0)}, rule="straight")
        for use in ("bulb_area", "bulb_height", "bulb_neck", "bulb_neck_angle")
    ]


def _not_tiny(share: float) -> float:
    return share if share > _LEAST_END else 0.0


def _course(use: str, nodes: Iterable[PathNode]) -> FormDefinition:
    """Give a course of nodes, by numbers from aft."""
    return course(use, {f"{k}": node.fields() for k, node in enumerate(nodes)})


def _through(
    use: str, x: FloatArray, y: FloatArray, ship: Particulars, tolerance: float
) -> tuple[FormDefinition, FloatArray]:
    """Lay a course through points by rising x, with nodes where it misses most."""
    at = [0, len(x) - 1, int(y.argmin()), int(y.argmax())]
    while True:
        at = sorted(set(at))
        nodes = {f"{k}": (float(x[n]), float(y[n])) for k, n in enumerate(at)}
        made = course(use, nodes, rule="monotone")
        off = Forms.of([made], ship).value(use, x) - y
        if float(np.abs(off).max()) < tolerance or len(at) == len(x):
            return made, off
        at.append(int(np.abs(off).argmax()))


def _full_part(x: FloatArray, y: FloatArray) -> tuple[float, float]:
    """Give between which abscissae a curve is full; one place where it has no parallel part."""
    top = int(y.argmax())
    low = high = top
    while low > 0 and y[low - 1] >= 1.0 - _FULL:
        low -= 1
    while high < len(y) - 1 and y[high + 1] >= 1.0 - _FULL:
        high += 1
    if x[high] - x[low] < _PARALLEL:
        middle = 0.5 * float(x[low] + x[high])
        return middle, middle
    return float(x[low]), float(x[high])
