"""Panels of a hull on one sheet: seen from the water, in the three views, and in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.panels.mesh_quality import PanelReport, panel_report
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.surfaces.panel_mesh import PanelMesh
from assoc_hull.plot.sheet.paper import AXIS, MARGIN, POINT, WATER, PaperName, View, scale_of
from assoc_hull.plot.sheet.sheet_figure import Path_, Sheet, save
from assoc_hull.plot.sheet.title_block import caption, frame, scale_bar, title_block

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["panel_plan"]

_BLOCK, _SIDE = 96.0, 14.0
"""Width of the block, and room beside the long views, mm at A3."""

_EDGE = 0.05
"""Width of the edges of panels, mm at A3."""

_EYE = (-2.0, 0.6)
"""From where the hull is seen: turned about the vertical and raised, radians; from below."""

_LIGHT = np.array([0.25, 0.75, -0.6])
_TINT = np.array([0.55, 0.72, 0.86])


def panel_plan(mesh: PanelMesh, path: Path_ | None = None, *, paper: PaperName = "A3") -> Figure:
    """Draw a mesh of panels.

    Above, the whole hull as seen from the water, and the quality of the mesh in words; then the
    body plan, aft body left and fore body right, profile, and the plan from below. Views show
    the panels of the port side that face the eye.

    Parameters
    ----------
    mesh : PanelMesh
        The mesh.
    path : path, optional
        Where to write it; the ending says whether PDF, SVG or PNG.
    paper : "A3", "A1" or "A4"
        Size of the sheet, landscape.

    Returns
    -------
    matplotlib.figure.Figure
        The picture; the panels of a view have the id ``view/panels``.

    Raises
    ------
    MissingExtraError
        Matplotlib is not installed.
    BadInputError
        An unknown paper or ending.

    Examples
    --------
    >>> from assoc_hull.analysis.panels.hull_panels import panels
    >>> from assoc_hull.plot.plates.panel_plan import panel_plan
    >>> from assoc_hull.hull.sources import examples
    >>> figure = panel_plan(panels(examples.wigley(), count=200))
    """
    sheet, whole = Sheet(paper), mesh.whole()
    frame(sheet, MARGIN * sheet.paper.factor)
    low = _block(sheet, panel_report(mesh))
    top = _long_views(sheet, whole)
    _body(sheet, whole, top, low)
    _seen(sheet, whole, top)
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure


def _block(sheet: Sheet, report: PanelReport) -> float:
    """Write the quality of the mesh into the right upper corner; give the lower edge, mm."""
    paper, spread = sheet.paper, "{:.3g},  {:.3g},  {:.3g}"
    volume = sum(report.volume) / 3.0
    rows = [
        ("Panels (triangles)", f"{report.panels} ({report.triangles})"),
        ("Parts of the whole", str(report.images)),
        ("Volume", f"{volume:.2f} m3"),
        ("Wetted surface", f"{report.area:.2f} m2"),
        ("Centre of buoyancy x, y, z", "{:.3f}, {:.3f}, {:.3f} m".format(*report.buoyancy)),
    ]
    if report.origin is not None:
        errors = 100.0 * (report.volume_error or 0.0), 100.0 * (report.area_error or 0.0)
        rows += [
            (
                "Exact volume, surface",
                f"{report.origin.volume:.2f} m3, {report.origin.area:.2f} m2",
            ),
            ("Error of volume, surface", "{:+.3f} %, {:+.3f} %".format(*errors)),
            ("Error of the centre", f"{report.centre_error or 0.0:.4f} m"),
        ]
    for name, each, unit in (
        ("Size: median, 95 %, most", report.size, " m"),
        ("Aspect: median, 95 %, most", report.aspect, ""),
        ("Warp: median, 95 %, most", report.warp, ""),
    ):
        rows.append((name, spread.format(each.median, each.p95, each.most) + unit))
    edges = report.edges
    rows += [
        ("Without area", str(report.degenerate)),
        ("Free edges below, above", f"{edges.below}, {edges.above}"),
        ("Watertight, normals outward", f"{_yes(report.watertight)}, {_yes(report.outward)}"),
        ("Shortest wave", f"{report.shortest_wave:.1f} m"),
    ]
    notes = ("Axes of the mesh, m: x forward, y to port, z up from the water surface.",)
    corner = (paper.width - MARGIN * paper.factor, paper.height - MARGIN * paper.factor)
    title, _, words = report.title.partition(", T_A ")
    words = words and f"T_A {words}"
    return title_block(
        sheet,
        corner,
        _BLOCK * paper.factor,
        title or "Panels",
        rows,
        (*((words,) if words else ()), *notes),
    )


def _yes(value: bool) -> str:
    return "yes" if value else "no"


def _upright(whole: PanelMesh) -> bool:
    """Tell whether port and starboard are alike: then port is drawn."""
    return bool(abs(whole.buoyancy[1]) <= 1e-6 * float(np.ptp(whole.xyz[:, 0])))


def _long_views(sheet: Sheet, whole: PanelMesh) -> float:
    """Draw profile and plan from below; give the height they reach, mm."""
    paper, one_side = sheet.paper, _upright(whole)
    factor = paper.factor
    low, high = whole.xyz.min(axis=0), whole.xyz.max(axis=0)
    below = 0.0 if one_side else float(low[1])
    scale = scale_of(float(high[0] - low[0]), paper.width - 2.0 * (MARGIN + _SIDE) * factor)
    unit = 1e3 / scale
    across = 0.5 * (paper.width - unit * (high[0] - low[0])) - unit * low[0]
    foot = (MARGIN + 16.0) * factor
    plan = View("plan", (0, 1), scale, (across, foot - unit * below))
    deep = plan.up(float(high[1])) + 17.0 * factor
    profile = View("profile", (0, 2), scale, (across, deep - unit * low[2]))
    port = (whole.centre[:, 1] > 0.0) | (not one_side)
    _panels(sheet, plan, whole, port & (whole.normal[:, 2] <= 1e-9), -whole.centre[:, 2])
    _panels(sheet, profile, whole, whole.normal[:, 1] >= -1e-9, whole.centre[:, 1])
    ends = np.array([[x, 0.0, 0.0] for x in (low[0], high[0])])
    sheet.line(plan.on_paper(ends), AXIS, "plan/centre line")
    sheet.line(profile.on_paper(ends), WATER, "profile/water")
    middle = plan.across(0.5 * float(low[0] + high[0]))
    words = "PLAN, PORT SIDE" if one_side else "PLAN"
    caption(sheet, (middle, foot - 4.0 * factor), words)
    caption(sheet, (middle, profile.up(float(low[2])) - 4.0 * factor), "PROFILE")
    place = (plan.across(float(low[0])), foot - 11.0 * factor)
    scale_bar(sheet, plan, place, 60.0 * factor, f"1:{scale:g}")
    return profile.up(float(high[2])) + 6.0 * factor


def _body(sheet: Sheet, whole: PanelMesh, low: float, high: float) -> None:
    """Draw the body plan at the right, between the long views and the block."""
    paper, one_side = sheet.paper, _upright(whole)
    factor = paper.factor
    half, deep = float(np.abs(whole.xyz[:, 1]).max()), float(np.ptp(whole.xyz[:, 2]))
    width = (_BLOCK - 8.0) * factor
    room = max(high - low - 14.0 * factor, 3.0)
    # Of a heeled ship either body has both sides: they stand beside one another.
    breadth = 2.0 * half if one_side else 4.3 * half
    scale = max(scale_of(breadth, width), scale_of(deep, room))
    middle = paper.width - (MARGIN + 0.5 * _BLOCK) * factor
    aside = 0.0 if one_side else 1.1e3 / scale * half
    top = high - 5.0 * factor - 1e3 / scale * float(whole.xyz[:, 2].max())
    fore = View("body", (1, 2), scale, (middle + aside, top))
    aft = View("body", (1, 2), scale, (middle - aside, top), -1.0)
    port = (whole.centre[:, 1] > 0.0) | (not one_side)
    where = 0.5 * float(whole.xyz[:, 0].min() + whole.xyz[:, 0].max())
    ahead, facing = whole.centre[:, 0] >= where, whole.normal[:, 0]
    _panels(sheet, fore, whole, port & ahead & (facing >= -1e-9), whole.centre[:, 0])
    _panels(sheet, aft, whole, port & ~ahead & (facing <= 1e-9), -whole.centre[:, 0])
    water = np.array([[0.0, -half, 0.0], [0.0, half, 0.0]])
    for view in (fore,) if one_side else (fore, aft):
        sheet.line(view.on_paper(water), WATER, "body/water")
    foot = fore.up(float(whole.xyz[:, 2].min())) - 3.0 * factor
    caption(sheet, (middle, foot), f"BODY PLAN  1:{scale:g}")


def _seen(sheet: Sheet, whole: PanelMesh, low: float) -> None:
    """Draw the hull as seen from the water, with light on it."""
    paper = sheet.paper
    factor = paper.factor
    left, right = (MARGIN + 6.0) * factor, paper.width - (MARGIN + _BLOCK + 6.0) * factor
    high = paper.height - (MARGIN + 6.0) * factor
    turn = _turned(*_EYE)
    flat = whole.xyz @ turn.T
    spread = np.ptp(flat, axis=0)
    unit = float(min((right - left) / spread[0], (high - low - 10.0 * factor) / spread[1]))
    middle = 0.5 * (flat.min(axis=0) + flat.max(axis=0))
    centre = np.array([0.5 * (left + right), 0.5 * (low + high) + 3.0 * factor])
    on_paper = centre + unit * (flat[:, :2] - middle[:2])
    toward = whole.normal @ turn[2]
    shown = np.flatnonzero(toward > 1e-9)
    order = shown[np.argsort((whole.centre @ turn[2])[shown], kind="stable")]
    bright = np.clip(whole.normal @ (_LIGHT / np.sqrt(_LIGHT @ _LIGHT)), 0.0, 1.0)
    colour = np.clip((0.62 + 0.38 * bright[order])[:, None] * _TINT * 1.25, 0.0, 1.0)
    _filled(sheet, on_paper[whole.panel[order]], colour, "seen/panels")
    foot = float(on_paper[:, 1].min()) - 4.0 * factor
    caption(sheet, (float(centre[0]), foot), "SEEN FROM BELOW, PORT BOW")


def _turned(about: float, raised: float) -> FloatArray:
    """Give the axes of a picture: to the right, upward, toward the eye; the eye looks up."""
    toward = np.array([
        -np.cos(about) * np.cos(raised), -np.sin(about) * np.cos(raised), -np.sin(raised)
    ])  # fmt: skip
    right = np.cross([0.0, 0.0, 1.0], toward)
    right /= np.sqrt(right @ right)
    return np.array([right, np.cross(toward, right), toward])


def _panels(
    sheet: Sheet, view: View, whole: PanelMesh, shown: NDArray[np.bool_], near: FloatArray
) -> None:
    """Draw some panels in a view, those that are nearer over the others."""
    chosen = np.flatnonzero(shown)
    chosen = chosen[np.argsort(near[chosen], kind="stable")]
    corner = view.on_paper(whole.xyz)[whole.panel[chosen]]
    _filled(sheet, corner, np.tile(0.35 + 0.65 * _TINT, (len(corner), 1)), f"{view.name}/panels")


def _filled(sheet: Sheet, corner: FloatArray, colour: FloatArray, name: str) -> None:
    """Fill polygons (k, 4, 2), mm."""
    from matplotlib.collections import PolyCollection

    if not len(corner):
        return
    sheet.axes.add_collection(
        PolyCollection(
            list(corner), facecolors=colour, edgecolors="0.15",
            linewidths=_EDGE * sheet.paper.factor / POINT, zorder=1.5, gid=name,
        ),
        autolim=False,
    )  # fmt: skip
