"""The definitions of a hull by form parameters, with their curvature combs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Protocol

import attrs
import numpy as np

from assoc_hull.arguments import shown
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.curve import form_at
from assoc_hull.model.form_definition import USES, FormDefinition
from assoc_hull.model.forms.closure import coefficients
from assoc_hull.model.forms.form_values import Forms
from assoc_hull.model.tables import Particulars
from assoc_hull.plot.sheet.chart import Chart, ChartScale, level_grid, scale_to, upright_grid
from assoc_hull.plot.sheet.paper import AXIS, MARGIN, PaperName, Pen
from assoc_hull.plot.sheet.sheet_figure import Path_, Sheet, save
from assoc_hull.plot.sheet.title_block import BLOCK, frame, title_block

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["definition_curves"]

_PANELS: tuple[tuple[str, float, tuple[str, ...]], ...] = (
    ("area, m2", 2.0, ("sectional_area", "bulb_area")),
    (
        "half-breadth, m", 2.0,
        ("design_waterline", "deck_side", "flat_of_bottom", "half_siding", "bulb_neck"),
    ),
    (
        "height, m", 2.0,
        ("profile", "deck_height", "deck_centre", "flat_of_side", "centroid", "bulb_height"),
    ),
    ("angle, deg", 1.5, ("keel_angle", "waterline_angle", "deck_angle", "bulb_neck_angle")),
    ("tangent", 1.0, ("keel_tangent", "waterline_tangent")),
    ("curvature, 1/m", 1.0, ("keel_curvature", "waterline_curvature", "deck_curvature")),
    ("radius, m", 1.0, ("bilge_radius",)),
)  # fmt: skip
"""Of each panel: the ordinate, its share of the height, and the uses drawn in it."""

_COLOURS = ("#0b3c6f", "#b3402a", "#3f7d3a", "#7a4f9a", "#8a6a1f", "#2a8a8a")
_STEPS = 24
"""Places on a quarter of a piece."""

_USUAL, _CUT = 5.0, 9.0
"""A tooth longer than 19 of 20, and the longest that is drawn, mm at A3."""

_FOOT, _BETWEEN = 9.0, 10.0
"""Below the panels, and between them, mm at A3."""


class HasDefinitions(Protocol):
    """A design, or the tables of a hull."""

    @property
    def definitions(self) -> Sequence[FormDefinition]:
        """Its definitions."""
        ...

    @property
    def particulars(self) -> Particulars:
        """Its principal dimensions."""
        ...


def definition_curves(
    source: HasDefinitions, path: Path_ | None = None, *, paper: PaperName = "A3"
) -> Figure:
    """Draw the definitions of a hull or of a design over the length of the ship.

    Combs show the curvature of the curves as they are drawn, so that an unfair place meets the
    eye; 19 of 20 teeth of a panel are at most 5 mm long (at A3). Dots are nodes.

    Parameters
    ----------
    source : Hull, HullState or Design
        What has the definitions.
    path : path, optional
        Where to write it; the ending says whether PDF, SVG or PNG.
    paper : "A3", "A1" or "A4"
        Size of the sheet, landscape.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    BadInputError
        Nothing that has definitions, an unknown paper or ending.
    MissingExtraError
        Matplotlib is not installed.
    """
    forms = _forms(source)
    sheet = Sheet(paper)
    factor, margin = sheet.paper.factor, MARGIN * sheet.paper.factor
    frame(sheet, margin)
    ends = _extent(forms)
    used = [
        (title, share, uses)
        for title, share, every in _PANELS
        if (uses := [use for use in every if forms.has(use)])
    ]
    total = sum(share for _, share, _ in used)
    left, wide = margin + 21.0 * factor, sheet.paper.width - 2.0 * margin - (BLOCK + 33.0) * factor
    top = sheet.paper.height - margin - 8.0 * factor
    room = top - margin - (_FOOT + _BETWEEN * (len(used) - 1)) * factor
    for title, share, uses in used:
        tall = room * share / total
        chart = Chart(sheet, left, top - tall, wide, tall)
        _panel(chart, forms, title, uses, ends)
        top -= tall + _BETWEEN * factor
    corner = (sheet.paper.width - margin, sheet.paper.height - margin)
    rows, notes = _rows(forms), ["Combs: curvature as drawn. Dots: nodes, ends of pieces."]
    title_block(
        sheet, corner, BLOCK * factor, f"{forms.particulars.name}: definitions", rows, notes
    )
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure


def _forms(source: Any) -> Forms:
    """Take what has definitions."""
    tables = getattr(source, "state", source)
    found = getattr(tables, "definitions", None)
    if not isinstance(found, tuple) or not found:
        what = f"{shown(source)} has no definitions"
        raise BadInputError(what, "in a picture of definitions", "give a created hull or a design")
    return Forms.of(found, tables.particulars)


def _extent(forms: Forms) -> tuple[float, float]:
    """Give where the ship begins and ends, m from AP."""
    found = [0.0, forms.particulars.length]
    for use in ("profile", "deck_side"):
        if forms.has(use):
            chain = forms.chain(use)
            found += chain.vertices[:, 1:-1, 0].ravel().tolist()
    return min(found), max(found)


@attrs.frozen(eq=False)
class _Drawn:
    """A curve on paper, mm: places, teeth of its comb, and ends of its pieces."""

    use: str
    name: str
    course: FloatArray
    tooth: FloatArray
    nodes: FloatArray


def _panel(
    chart: Chart, forms: Forms, title: str, uses: Sequence[str], ends: tuple[float, float]
) -> None:
    values = np.concatenate([_course(forms, use, ends)[0][:, 1] for use in uses])
    low, high = min(0.0, float(values.min())), float(values.max())
    along = scale_to(*ends, chart.left, chart.wide, 20, whole=False)
    up = scale_to(low, high + 0.08 * max(high - low, 1e-6), chart.low, chart.tall, 8)
    level_grid(chart, up, title)
    upright_grid(chart, along, "x, m")
    chart.border()
    drawn = [_on_paper(forms, use, ends, along, up) for use in uses]
    size = np.concatenate([np.hypot(*each.tooth.T) for each in drawn])
    factor = chart.sheet.paper.factor
    scale = _USUAL * factor / max(float(np.percentile(size, 95.0)), 1e-12)
    for number, each in enumerate(drawn):
        _draw(chart, each, _COLOURS[number % len(_COLOURS)], scale, number)
    for value in (0.0, forms.particulars.length):
        x = float(along.at(value))
        chart.sheet.rule((x, chart.low), (x, chart.top), AXIS, f"perpendicular/{value:g}")


def _course(
    forms: Forms, use: str, ends: tuple[float, float]
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give places, first and second derivatives along a curve in its own units, (k, 2) each."""
    vertices = forms.chain(use).vertices
    t = np.linspace(0.0, 4.0, 4 * _STEPS + 1)
    each = np.repeat(vertices, len(t), axis=0)
    at = np.tile(t, len(vertices))
    found = [form_at(each, at, order) for order in range(3)]
    inside = (found[0][:, 0] >= ends[0] - 1e-6) & (found[0][:, 0] <= ends[1] + 1e-6)
    if inside.sum() < 2:  # a level course that runs far beyond the ship
        x = np.linspace(*ends, 4)
        level = np.column_stack([x, np.interp(x, *found[0].T)])
        return level, np.tile((1.0, 0.0), (4, 1)), np.zeros((4, 2))
    place, first, second = (part[inside] for part in found)
    return place, first, second


def _on_paper(
    forms: Forms, use: str, ends: tuple[float, float], along: ChartScale, up: ChartScale
) -> _Drawn:
    place, first, second = _course(forms, use, ends)
    unit = np.array([along.size / (along.high - along.low), up.size / (up.high - up.low)])
    course = np.column_stack([along.at(place[:, 0]), up.at(place[:, 1])])
    pace, bend = first * unit, second * unit
    speed = np.maximum(np.hypot(*pace.T), 1e-12)
    curvature = (pace[:, 0] * bend[:, 1] - pace[:, 1] * bend[:, 0]) / speed**3
    outward = np.column_stack([pace[:, 1], -pace[:, 0]]) / speed[:, None]
    nodes = place[:: 4 * _STEPS + 1] if len(place) % (4 * _STEPS + 1) == 0 else place[:1]
    spots = np.concatenate([nodes, place[-1:]])
    return _Drawn(
        use, forms.definitions[use].name, course, curvature[:, None] * outward,
        np.column_stack([along.at(spots[:, 0]), up.at(spots[:, 1])]),
    )  # fmt: skip


def _draw(chart: Chart, drawn: _Drawn, colour: str, scale: float, number: int) -> None:
    """Draw a curve with its comb, and its name above the panel."""
    sheet, factor = chart.sheet, chart.sheet.paper.factor
    length = scale * np.hypot(*drawn.tooth.T)
    short = np.minimum(1.0, _CUT * factor / np.maximum(length, 1e-12))
    tip = drawn.course + scale * short[:, None] * drawn.tooth
    for axis, (least, most) in enumerate(((chart.left, chart.right), (chart.low, chart.top))):
        tip[:, axis] = np.clip(tip[:, axis], least, most)
    teeth = np.full((3 * len(tip), 2), np.nan)
    teeth[0::3], teeth[1::3] = drawn.course, tip
    sheet.line(teeth[: 3 * len(tip)], Pen(0.05, colour, over=1.5), f"teeth/{drawn.use}")
    sheet.line(tip, Pen(0.08, colour, over=1.6), f"tips/{drawn.use}")
    sheet.line(drawn.course, Pen(0.35, colour, over=3.0), f"curve/{drawn.use}")
    sheet.dots(drawn.nodes, colour, 0.9, f"nodes/{drawn.use}")
    place = (chart.left + (18.0 + 42.0 * number) * factor, chart.top + 1.2 * factor)
    sheet.take(
        sheet.text(place, drawn.name, across="left", up="bottom", colour=colour, bold=True,
                   name=f"label/{drawn.use}")
    )  # fmt: skip


def _rows(forms: Forms) -> list[tuple[str, str]]:
    """Give dimensions, and what the curves of two halves close to."""
    ship = forms.particulars
    rows = [
        ("Length between perpendiculars", f"{ship.length:.3f} m"),
        ("Breadth, moulded", f"{ship.breadth:.3f} m"),
        ("Design draught, moulded", f"{ship.draught:.3f} m"),
    ]
    for use, name, centre in (("sectional_area", "CP", "LCB"), ("design_waterline", "CW", "LCF")):
        if not forms.has(use):
            continue
        found = coefficients(forms.definitions[use], ship)
        if found.block is not None:
            rows.append(("CB", f"{found.block:.6f}"))
        rows.append((name, f"{found.fullness:.6f}"))
        rows.append((f"{centre} from midship, + forward", f"{found.centroid:+.4f} m"))
    rows.append(("Definitions", f"{len(forms.definitions)} of {len(USES)} uses"))
    return rows
