"""What became of definitions: closure and net side by side, and section by section.

The closure is what the definitions say; the net is measured: its volume and waterplane are those of
the surface through its lines, between the ends of the curves of the definitions. What lies beyond
these, as a short overhang abaft AP or a bulb ahead of FP, is left out.
"""

from __future__ import annotations

from typing import Any

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.flotation import Flotation, flotation
from assoc_hull.analysis.hydrostatics.section_areas import between_stations
from assoc_hull.analysis.net.curve_net import station_planes as stands
from assoc_hull.display import ShownAsText
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.fairness.inflections import inflections
from assoc_hull.geometry.floating.immersion import FloatingPlanes, ImmersedIntegrals
from assoc_hull.model.form_definition import FormDefinition, GeneratedCurve
from assoc_hull.model.forms.closure import Coefficients, coefficients
from assoc_hull.model.forms.two_halves import half_number
from assoc_hull.model.generated_curves import forms_of
from assoc_hull.model.tables import HullState

__all__ = ["CreationReport", "FormFigure", "SectionFigures", "creation_report"]

_ON = 1e-4
"""So near to a station (m) a place is on it."""


@attrs.frozen
class FormFigure:
    """One number as the definitions close it and as the net has it.

    Attributes
    ----------
    name, unit : str
        What it is.
    closure, net : float
        The two values; a centroid in m from midship, forward positive.
    """

    name: str
    unit: str
    closure: float
    net: float

    @property
    def difference(self) -> float:
        """Net less closure."""
        return self.net - self.closure


@attrs.frozen
class SectionFigures:
    """A section beside its definitions.

    Attributes
    ----------
    name : str
        Of the line.
    x : float, m
        Where it stands.
    layout : str
        Of which pieces it is made; curves are parted by a bar.
    attached : bool
        Whether all its curves are still those of the definitions.
    wanted, area : float, m2
        Of both sides below the draught: by the curve of areas (nan beyond its ends), and of
        the section in the net.
    points : int
        That define it.
    inflections : int
        Changes of the sign of its curvature; lobes that turn by less than 0.2 degrees count not.
    """

    name: str
    x: float
    layout: str
    attached: bool
    wanted: float
    area: float
    points: int
    inflections: int


@attrs.frozen(repr=False)
class CreationReport(ShownAsText):
    """A hull beside its definitions.

    Attributes
    ----------
    draught : float, m
        Below which it is measured.
    figures : tuple of FormFigure
        CB, CP, LCB, CW and LCF, as far as there are definitions of them.
    sections : tuple of SectionFigures
        From aft forward.
    """

    draught: float
    figures: tuple[FormFigure, ...]
    sections: tuple[SectionFigures, ...]

    def figure(self, name: str) -> FormFigure:
        """Give a figure by its name."""
        for each in self.figures:
            if each.name == name:
                return each
        known = ", ".join(each.name for each in self.figures)
        raise BadInputError(f"there is no figure {name!r}", "in a report", f"use one of {known}")

    def data(self) -> dict[str, Any]:
        """Give the report as plain values; what is not known is None."""
        found = attrs.asdict(self)
        for each in found["sections"]:
            each["wanted"] = each["wanted"] if np.isfinite(each["wanted"]) else None
        return found

    def __str__(self) -> str:
        lines = [f"{'':8}{'closure':>12}{'net':>12}{'difference':>13}"]
        for each in self.figures:
            title = f"{each.name} {each.unit}".strip()
            lines.append(f"{title:8}{each.closure:12.6f}{each.net:12.6f}{each.difference:13.6f}")
        lines += ["", _HEAD]
        return "\n".join([*lines, *(_row(each) for each in self.sections)]) + "\n"


_HEAD = (
    f"{'section':12}{'x m':>9}{'wanted m2':>12}{'area m2':>12}{'points':>8}{'inflections':>13}"
    "  pieces"
)


def _row(each: SectionFigures) -> str:
    wanted = f"{each.wanted:12.4f}" if np.isfinite(each.wanted) else f"{'-':>12}"
    layout = each.layout if each.attached else f"{each.layout} (detached)"
    return (
        f"{each.name:12}{each.x:9.3f}{wanted}{each.area:12.4f}{each.points:8d}"
        f"{each.inflections:13d}  {layout}"
    )


def creation_report(state: HullState) -> CreationReport:
    """Measure a hull beside its definitions; raises BadInputError for one without definitions."""
    if not state.definitions:
        raise BadInputError(
            "the hull has no definitions", state.particulars.name, "create one from a design"
        )
    body = flotation(state)
    draught = state.particulars.draught
    plane = FloatingPlanes(np.array([draught]), np.zeros(1), np.zeros(1))
    known = {each.use: each for each in state.definitions}
    figures = []
    if "sectional_area" in known:
        figures += _of_areas(state, body, plane, known["sectional_area"])
    if "design_waterline" in known:
        figures += _of_waterline(state, body, plane, known["design_waterline"])
    return CreationReport(draught, tuple(figures), tuple(_sections(state, body, plane)))


def _of_areas(
    state: HullState, body: Flotation, plane: FloatingPlanes, areas: FormDefinition
) -> list[FormFigure]:
    ship = state.particulars
    closed = coefficients(areas, ship)
    immersed = _between(body, plane, areas, ship.length)
    volume = float(immersed.volume[0])
    full = half_number(areas, "full")
    centre = float(immersed.moment_x[0]) / volume - 0.5 * ship.length
    block = volume / (ship.length * ship.breadth * ship.draught)
    assert closed.block is not None
    return [
        FormFigure("CB", "", closed.block, block),
        FormFigure("CP", "", closed.fullness, volume / (ship.length * full)),
        FormFigure("LCB", "m", closed.centroid, centre),
    ]


def _of_waterline(
    state: HullState, body: Flotation, plane: FloatingPlanes, line: FormDefinition
) -> list[FormFigure]:
    ship = state.particulars
    closed: Coefficients = coefficients(line, ship)
    immersed = _between(body, plane, line, ship.length)
    area = float(immersed.area[0])
    centre = float(immersed.area_x[0]) / area - 0.5 * ship.length
    full = 2.0 * half_number(line, "full")
    return [
        FormFigure("CW", "", closed.fullness, area / (ship.length * full)),
        FormFigure("LCF", "m", closed.centroid, centre),
    ]


def _between(
    body: Flotation, plane: FloatingPlanes, definition: FormDefinition, length: float
) -> ImmersedIntegrals:
    """Measure what lies between the ends of a curve of two halves.

    An end at which no station stands is that of the hull.
    """
    stations = stands(body.net)
    ends = []
    for name, beyond in (("run_start", -np.inf), ("entrance_end", np.inf)):
        x = 0.5 * length * (1.0 + half_number(definition, name))
        there = len(stations) > 0 and float(np.abs(stations - x).min()) <= _ON
        ends.append(x if there else beyond)
    if np.isinf(ends).all():
        return body.measure(plane)
    return between_stations(body, ends[0], ends[1], plane)


def _sections(state: HullState, body: Flotation, plane: FloatingPlanes) -> list[SectionFigures]:
    made: dict[int, list[GeneratedCurve]] = {}
    for each in state.generated:
        if each.what == "section" and state.curves.alive[each.curve]:
            made.setdefault(state.line_of(each.curve), []).append(each)
    lines = sorted(made, key=lambda line: float(state.lines.offset[line]))
    x = np.array([float(state.lines.offset[line]) for line in lines])
    wanted = forms_of(state).value("sectional_area", x)
    stations = body.stations(plane)
    found = []
    for line, place, want in zip(lines, x.tolist(), wanted.tolist(), strict=True):
        curves = [each.curve for each in made[line]]
        near = np.abs(stations.x - place) <= _ON
        turns = sum(
            int(inflections(state.spline(each), state.lines.normal[line])[0][0]) for each in curves
        )
        found.append(
            SectionFigures(
                state.lines.name[line], place,
                " | ".join(each.layout for each in made[line]),
                all(each.attached for each in made[line]),
                want, float(stations.area[0, near].sum()),
                sum(len(state.curves.rows[each]) for each in curves), turns,
            )
        )  # fmt: skip
    return found
