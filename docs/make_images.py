"""Draw the pictures of the documentation: `python docs/make_images.py [name ...]`.

Everything drawn is computed here from the shipped hulls; nothing is drawn by hand but the
boxes and arrows. Needs the extra `plot`. Each picture stays below 150 kB.
"""

import sys
from collections.abc import Callable
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import FancyArrowPatch, Rectangle
from numpy.typing import NDArray
from PIL import Image

import assoc_hull as ah
from assoc_hull.geometry.curves import CurveData
from assoc_hull.geometry.evaluation import sample
from assoc_hull.geometry.spline import loft
from assoc_hull.plot import lines_plan

Floats = NDArray[np.float64]

FOLDER = Path(__file__).parent / "images"
LARGEST = 150_000

INK, PALE, FAINT = "#20262c", "#9aa4ad", "#d9dee2"
SHARED, DRIVEN, WATCHED, FIXED, ACCENT = "#0b5394", "#d9660a", "#8b1a8b", "#1a7f37", "#c0392b"

mpl.use("Agg")
mpl.rcParams.update(
    {
        "font.size": 10,
        "axes.edgecolor": PALE,
        "axes.labelcolor": INK,
        "xtick.color": INK,
        "ytick.color": INK,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "savefig.dpi": 120,
    }
)

_MADE: list[ah.Hull] = []


def ship() -> ah.Hull:
    """Give Series 60 CB 0.70, made once; who edits it takes the edit back."""
    if not _MADE:
        _MADE.append(ah.examples.series60(0.70))
    return _MADE[0]


def curve(hull: ah.Hull, line: str) -> Floats:
    """Give places along the one curve of a line, (n, 3), m."""
    return np.array(hull.lines[line].curves[0].polyline(8))


def bare(axes: Axes) -> None:
    """Leave out ticks and frame."""
    axes.set_axis_off()


def arrow(axes: Axes, start: Floats, end: Floats, bend: float = 0.0, color: str = INK) -> None:
    """Draw an arrow in data coordinates."""
    style = f"arc3,rad={bend}"
    axes.add_patch(
        FancyArrowPatch(
            tuple(start), tuple(end), arrowstyle="-|>", mutation_scale=12, color=color,
            connectionstyle=style, linewidth=1.2, zorder=6,
        )
    )  # fmt: skip


# One crossing, two handles -----------------------------------------------------------------


def oblique(xyz: Floats) -> Floats:
    """Look at the port side from forward and above: (k, 3) to (k, 2)."""
    x, y, z = xyz.T
    return np.column_stack([0.62 * (x - 103.632) - 0.80 * y, z - 0.16 * (x - 103.632) - 0.42 * y])


def crossing() -> Figure:
    """Draw a section and a waterline; their crossing is one row of the table of points."""
    hull = ship()
    figure, axes = plt.subplots(figsize=(9.4, 3.0), layout="constrained")
    for name in ("ST 16", "ST 18", "WL 0.25", "WL 0.75"):
        axes.plot(*_window(hull, name).T, color=FAINT, linewidth=1.2)
    for name, color in (("ST 17", SHARED), ("WL 0.5", DRIVEN)):
        axes.plot(*_window(hull, name).T, color=color, linewidth=2.2)
    point = hull.find("WL 0.5 x ST 17")
    spot = oblique(np.array([point.position]))[0]
    axes.plot(*spot, "o", color=INK, markersize=8, zorder=7)
    _label_ends(axes, hull)
    _table(axes, hull, spot)
    axes.set_xlim(-16.5, 22.0)
    axes.set_ylim(-5.6, 6.6)
    axes.set_aspect("equal")
    bare(axes)
    return figure


def _window(hull: ah.Hull, name: str) -> Floats:
    xyz = curve(hull, name)
    inside = (xyz[:, 0] > 93.0) & (xyz[:, 0] < 112.5) & (xyz[:, 2] > 0.7) & (xyz[:, 2] < 8.8)
    return oblique(xyz[inside])


def _label_ends(axes: Axes, hull: ah.Hull) -> None:
    top, side = _window(hull, "ST 17")[-1], _window(hull, "WL 0.5")[0]
    axes.text(top[0], top[1] + 0.25, "curve a: ST 17", color=SHARED, ha="center")
    axes.text(side[0] - 0.3, side[1], "curve b: WL 0.5", color=DRIVEN, ha="right", va="center")


def _table(axes: Axes, hull: ah.Hull, spot: Floats) -> None:
    """Draw the row of the crossing between its neighbours in the table, and the two handles."""
    left, width, high = 6.6, 15.0, 1.0
    names = ("WL 0.42 x ST 17", "WL 0.5 x ST 17", "WL 0.58 x ST 17")
    heads = (("x", 7.4), ("y", 9.7), ("z", 11.9), ("free", 13.8))
    axes.text(left, 1.85, "table of points", color=INK, weight="bold")
    for title, at in heads:
        axes.text(left + at + 0.9, 1.85, title, color=PALE, ha="right", fontsize=9)
    for i, name in enumerate(names):
        point, low = hull.find(name), 0.55 - high * i
        mine = i == 1
        axes.add_patch(
            Rectangle((left - 0.2, low), width, high, facecolor="#fff4d6" if mine else "white",
                      edgecolor=INK if mine else FAINT, linewidth=1.4 if mine else 0.8,
                      zorder=5 if mine else 4)
        )  # fmt: skip
        color = INK if mine else PALE
        cells = (f"{point.x:.3f}", f"{point.y:.3f}", f"{point.z:.3f}", " ".join(point.free))
        axes.text(left, low + 0.3, name, color=color, fontsize=9, zorder=8)
        for text, (_, at) in zip(cells, heads, strict=True):
            axes.text(
                left + at + 0.9, low + 0.3, text, color=color, fontsize=9, ha="right", zorder=8
            )
    boxes = (
        ("friend point on ST 17", 'hull.find("ST 17 x WL 0.5")', 3.9, SHARED),
        ("friend point on WL 0.5", 'hull.find("WL 0.5 x ST 17")', -5.1, DRIVEN),
    )
    for title, code, low, color in boxes:
        axes.add_patch(Rectangle((left + 1.6, low), 11.4, 1.8, facecolor="white", edgecolor=color))
        axes.text(left + 7.3, low + 1.08, title, color=color, ha="center")
        axes.text(
            left + 7.3, low + 0.34, code, color=INK, ha="center", fontsize=8.5, family="monospace"
        )
    arrow(axes, np.array([left + 7.3, 3.9]), np.array([left + 7.3, 1.65]), color=SHARED)
    arrow(axes, np.array([left + 7.3, -3.3]), np.array([left + 7.3, -1.55]), color=DRIVEN)
    axes.text(left + 7.7, -2.75, "both read this row", color=INK, fontsize=9)
    arrow(axes, np.array([left - 0.3, 0.05]), spot + np.array([0.35, 0.0]), bend=0.05)


# Roles -------------------------------------------------------------------------------------


_MARKS = {
    "shared": ("o", SHARED, "shared: defines both curves"),
    "drives b": ("^", DRIVEN, "driven: the section or waterline gives the value"),
    "watched": ("x", WATCHED, "watched: defines neither, its gap is measured"),
    "end": ("s", FIXED, "end on the profile"),
}


def roles() -> Figure:
    """Draw three waterlines of the run, each crossing marked by its role."""
    hull = ship()
    figure, axes = plt.subplots(figsize=(8.6, 5.0), layout="constrained")
    for line in hull.groups["sections"].lines.values():
        if line.position < 36.0:
            axes.axvline(line.position, color=FAINT, linewidth=0.9, zorder=0)
            if line.name in {"ST 0", "ST 1", "ST 2", "ST 3", "ST 4", "ST 5"}:
                axes.text(line.position, 9.05, line.name, ha="center", color=PALE, fontsize=9)
    for line in hull.groups["buttocks"].lines.values():
        axes.axhline(line.position, color=FAINT, linewidth=0.9, zorder=0)
        if line.name in {"BTK 0.2", "BTK 0.52", "BTK 0.84"}:
            axes.text(0.15, line.position, line.name, va="center", color=PALE, fontsize=9,
                      bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.0})  # fmt: skip
    for name in ("WL 0.25", "WL 0.5", "WL 0.75"):
        _line_with_roles(axes, hull, name)
    handles = [
        Line2D([], [], marker=mark, color=color, linestyle="", label=text, markersize=6)
        for mark, color, text in _MARKS.values()
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=2, frameon=False)
    axes.set(xlim=(-0.8, 34.0), ylim=(-0.3, 8.9), xlabel="x (m, from AP)", ylabel="y (m)")
    return figure


def _line_with_roles(axes: Axes, hull: ah.Hull, name: str) -> None:
    xyz = curve(hull, name)
    near = xyz[:, 0] < 36.0
    axes.plot(xyz[near, 0], xyz[near, 1], color=INK, linewidth=1.1)
    at = int(np.argmin(np.abs(xyz[:, 0] - 34.0)))
    axes.text(
        34.25,
        xyz[at, 1] + 0.1 * (name == "WL 0.75"),
        name,
        va="center",
        color=INK,
        fontsize=9,
        weight="bold",
    )
    for point in hull.lines[name].points:
        if point.x > 34.0 or point.crossing is None:
            continue
        boundary = point.parent_curve.line.group.name == "boundary"
        mark, color, _ = _MARKS["end" if boundary else point.crossing_role]
        axes.plot(point.x, point.y, mark, color=color, markersize=6, markeredgewidth=1.4, zorder=5)


# What a pull moves -------------------------------------------------------------------------


def pull() -> Figure:
    """Draw body plan and half-breadth plan of the fore body before and after a pull of 200 mm."""
    hull = ship()
    fore = [f"ST {number:g}" for number in (12, 13, 14, 15, 16, 17, 18, 18.5, 19, 19.5, 20)]
    water = [f"WL {part:g}" for part in (0.075, 0.25, 0.5, 0.75, 1.0, 1.25)]
    before = {name: curve(hull, name) for name in (*fore, *water)}
    with hull.edit("pull") as edit:
        edit.pull("WL 0.75 x ST 17", d=0.2, radius=(20.0, 5.0))
    after = {name: curve(hull, name) for name in before}
    place = hull.find("WL 0.75 x ST 17").position
    hull.undo()
    figure, (body, plan) = plt.subplots(
        1, 2, figsize=(9.4, 4.7), width_ratios=(1.0, 1.35), layout="constrained"
    )
    _tinted(body, before, after, fore, (1, 2))
    _tinted(plan, before, after, water, (0, 1))
    body.plot(place[1], place[2], "o", color=ACCENT, markersize=5)
    plan.plot(place[0], place[1], "o", color=ACCENT, markersize=5)
    body.set_aspect("equal")
    body.set(
        xlabel="y (m)", ylabel="z (m)", title="fore body, sections", xlim=(0, 9), ylim=(0, 10.6)
    )
    plan.set(
        xlabel="x (m)",
        ylabel="y (m)",
        title="half-breadth plan, six waterlines",
        xlim=(82, 124),
        ylim=(0, 9),
    )
    handles = [
        Line2D([], [], color=ACCENT, label="moved by more than 1 mm, after"),
        Line2D([], [], color=PALE, label="before, and what did not move"),
        Line2D([], [], color=ACCENT, marker="o", linestyle="", label="the point that was pulled"),
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=3, frameon=False)
    return figure


def _tinted(
    axes: Axes,
    before: dict[str, Floats],
    after: dict[str, Floats],
    names: list[str],
    view: tuple[int, int],
) -> None:
    for name in names:
        old, new = before[name], after[name]
        axes.plot(*old[:, view].T, color=PALE, linewidth=0.7, zorder=1)
        if len(old) != len(new):
            axes.plot(*new[:, view].T, color=ACCENT, linewidth=1.2, zorder=2)
            continue
        gone = np.sqrt(((new - old) ** 2).sum(axis=1))
        part = np.where((gone > 1e-3)[:, None], new[:, view], np.nan)
        axes.plot(*part.T, color=ACCENT, linewidth=1.2, zorder=2)


# Pinned against field ----------------------------------------------------------------------


def pinned_or_field() -> Figure:
    """Draw the same 20 mm at one point, as a drag and as a pull, along a waterline and a section."""
    hull = ship()
    point = "WL 0.5 x ST 16"
    here = hull.find(point).position
    xs, zs = np.linspace(75.0, 120.0, 451), np.linspace(0.2, 10.0, 246)
    ground, share = _breadths(hull, xs, zs), _normal_share(hull, point)
    shapes: list[tuple[str, str, tuple[Floats, Floats]]] = []
    for title, color in (("drag (pinned)", DRIVEN), ("pull, radii 20 m and 8 m (field)", SHARED)):
        with hull.edit(title) as edit:
            if title.startswith("drag"):
                edit.move(point, y=float(here[1]) + 0.02)
            else:
                edit.pull(point, d=0.02 * share, radius=(20.0, 8.0))
        shapes.append((title, color, _breadths(hull, xs, zs)))
        hull.undo()
    figure, (left, right) = plt.subplots(
        1, 2, figsize=(9.4, 3.6), width_ratios=(1.6, 1.0), layout="constrained"
    )
    for title, color, (along, girth) in shapes:
        left.plot(xs, 1e3 * (along - ground[0]), color=color, label=title)
        right.plot(1e3 * (girth - ground[1]), zs, color=color)
    left.set(xlabel="x along WL 0.5 (m)", ylabel="change of half-breadth (mm)", ylim=(-5, 25))
    right.set(xlabel="change of half-breadth (mm)", ylabel="z on ST 16 (m)", xlim=(-5, 25))
    for axes in (left, right):
        axes.grid(color=FAINT, linewidth=0.6)
    left.plot(here[0], 20.0, "o", color=INK, markersize=4)
    right.plot(20.0, here[2], "o", color=INK, markersize=4)
    figure.legend(loc="outside lower center", ncols=2, frameon=False)
    return figure


def _normal_share(hull: ah.Hull, point: str) -> float:
    """How much of a metre in y is normal displacement at a point: a pull by it moves y by 1 m."""
    start = hull.find(point).position[1]
    with hull.edit("try") as edit:
        edit.pull(point, d=0.02, radius=(20.0, 8.0))
    gone = hull.find(point).position[1] - start
    hull.undo()
    return float(0.02 / gone)


def _breadths(hull: ah.Hull, xs: Floats, zs: Floats) -> tuple[Floats, Floats]:
    """Half-breadths of WL 0.5 at xs and of ST 16 at zs, m."""
    water, section = hull.lines["WL 0.5"], hull.lines["ST 16"]
    along = [water.meet(((1.0, 0.0, 0.0), x))[0, 1] for x in xs.tolist()]
    girth = [section.meet(((0.0, 0.0, 1.0), z))[0, 1] for z in zs.tolist()]
    return np.array(along), np.array(girth)


# Levels ------------------------------------------------------------------------------------


def levels() -> Figure:
    """Draw the curves that one drag re-lofts, by level; a line is a crossing that drove."""
    hull = ship()
    with hull.edit("drag") as edit:
        edit.move("WL 0.5 x ST 16", y=hull.find("WL 0.5 x ST 16").y + 0.02)
    links, columns = _driven_links(hull), _columns(hull)
    hull.undo()
    figure, axes = plt.subplots(figsize=(9.0, 4.8), layout="constrained")
    places = {}
    for level, names in columns.items():
        for i, name in enumerate(names):
            places[name] = np.array([4.2 + 3.6 * level, 0.5 * (len(names) - 1) - i])
    for first, second in links:
        if first in places and second in places:
            start, end = places[first] + (0.6, 0.0), places[second] - (0.75, 0.0)
            axes.plot(*np.array([start, end]).T, color=PALE, linewidth=0.6, zorder=1)
    for name, place in places.items():
        color = SHARED if name in {"ST 16", "WL 0.5"} else INK
        axes.text(*place, name, ha="center", va="center", color=color, fontsize=9,
                  bbox={"facecolor": "white", "edgecolor": color, "pad": 2.0})  # fmt: skip
    axes.text(0.6, 0.0, "WL 0.5 x ST 16\n+20 mm in y", ha="center", va="center", color=ACCENT,
              bbox={"facecolor": "white", "edgecolor": ACCENT, "pad": 4.0})  # fmt: skip
    for name in ("ST 16", "WL 0.5"):
        bend = 0.0 if name == "ST 16" else -0.28
        arrow(axes, np.array([1.95, 0.0]), places[name] - (0.85, 0.0), bend, ACCENT)
    for level in columns:
        axes.text(4.2 + 3.6 * level, 6.6, f"level {level}", ha="center", color=PALE, weight="bold")
    axes.text(0.6, 6.6, "the edit", ha="center", color=PALE, weight="bold")
    axes.set(xlim=(-1.2, 16.4), ylim=(-6.4, 7.0))
    bare(axes)
    return figure


def _columns(hull: ah.Hull) -> dict[int, list[str]]:
    state, level = hull.state, hull.document.index.level
    found: dict[int, list[str]] = {}
    for number in hull.document.history[-1].curves.tolist():
        name = str(state.lines.name.data[state.line_of(number)])
        found.setdefault(int(level[number]), []).append(name)
    order = {name: i for i, name in enumerate(hull.lines)}
    columns = {each: sorted(found[each], key=lambda name: -order[name]) for each in sorted(found)}
    for names in columns.values():
        if "WL 0.5" in names:
            names.insert(0, names.pop(names.index("WL 0.5")))
    return columns


def _driven_links(hull: ah.Hull) -> list[tuple[str, str]]:
    """Pairs of lines of which the first told the second to follow, through a driven crossing."""
    step, state = hull.document.history[-1], hull.state
    pairs = set(zip(step.cause.source.tolist(), step.cause.reader.tolist(), strict=True))
    moved = set(step.rows.tolist())
    through = [
        (source >> 1, reader >> 1) for source, reader in pairs if source & 1 and not reader & 1
    ]
    found = set()
    for source, row in through:
        if row in moved:
            for other in state.rows.reader.data[row].tolist():
                if other >= 0:
                    names = [
                        str(state.lines.name.data[state.line_of(each)]) for each in (source, other)
                    ]
                    found.add((names[0], names[1]))
    return sorted(found)


# Spline ------------------------------------------------------------------------------------


def knuckle_end() -> Figure:
    """Draw the interval behind a knuckle with its vertices, and all three kinds of points."""
    figure, (left, right) = plt.subplots(
        1, 2, figsize=(9.4, 3.9), width_ratios=(1.15, 1.0), layout="constrained"
    )
    _four_vertices(left)
    _three_kinds(right)
    return figure


def _four_vertices(axes: Axes) -> None:
    first, last = np.zeros(2), np.array([3.0, 1.0])
    along = np.array([np.cos(np.radians(40.0)), np.sin(np.radians(40.0))])
    reach = float(last @ along) / 3.0
    third = last - reach * along
    second = 0.5 * (first + third)
    polygon = np.array([first, second, third, last])
    t = np.linspace(0.0, 1.0, 60)[:, None]
    bezier = (
        (1 - t) ** 3 * first
        + 3 * t * (1 - t) ** 2 * second
        + 3 * t * t * (1 - t) * third
        + t**3 * last
    )
    axes.plot(*polygon.T, "o--", color=DRIVEN, linewidth=1.0, markersize=5)
    axes.plot(*bezier.T, color=SHARED, linewidth=2.0)
    arrow(axes, last, last + 0.75 * along, color=INK)
    words = (
        (first, (-0.1, 0.3), "$V_1=P_k$, the knuckle", "left"),
        (second, (0.0, -0.2), r"$V_2=\frac{1}{2}(V_1+V_3)$", "left"),
        (third, (0.02, -0.2), r"$V_3=V_4-\lambda\,e$", "left"),
        (last, (-0.1, 0.12), r"$V_4=P_j$", "right"),
        (last + 0.75 * along, (0.05, 0.0), r"$e$", "left"),
    )
    for place, shift, text, side in words:
        axes.text(*(place + shift), text, ha=side, color=INK)
    axes.set(xlim=(-0.2, 4.0), ylim=(-0.55, 1.8), title="the interval behind a knuckle")
    axes.set_aspect("equal")
    bare(axes)


def _three_kinds(axes: Axes) -> None:
    points = np.array(
        [[0, 0], [5.0, 0], [6.7, 0.5], [7.5, 1.9], [7.7, 3.6], [7.7, 6.0], [7.2, 7.4], [7.4, 9.2]]
    )
    xyz = np.column_stack([np.zeros(len(points)), points])
    kind = np.array([0, 1, 0, 0, 1, 1, 2, 0])
    direction = np.zeros((len(points), 3))
    direction[1] = (0, 1, 0)
    direction[[4, 5]] = (0, 0, 1)
    spline = loft(CurveData.single(xyz, kind, direction))
    axes.plot(*sample(spline, 20)[1][:, 1:].T, color=SHARED, linewidth=2.0)
    style = {0: ("o", SHARED, "smooth"), 1: ("s", FIXED, "tangent"), 2: ("D", DRIVEN, "knuckle")}
    for code, (mark, color, name) in style.items():
        chosen = kind == code
        axes.plot(*points[chosen].T, mark, color=color, markersize=6, linestyle="", label=name)
    axes.legend(loc="center left", frameon=False)
    axes.set(
        xlabel="y (m)",
        ylabel="z (m)",
        xlim=(-0.3, 8.6),
        ylim=(-0.4, 9.6),
        title="three kinds of points",
    )
    axes.set_aspect("equal")


# Completions -------------------------------------------------------------------------------


def completions() -> Figure:
    """Draw what the Series 60 table leaves open, and what it was completed with."""
    from assoc_hull.examples.completion import widening
    from assoc_hull.examples.contours import centre_profile, end_contours
    from assoc_hull.examples.flats import flat_of_bottom, flat_of_side
    from assoc_hull.examples.series60_table import todd_table

    table = todd_table(0.70)[0]
    stern, stem = end_contours(table)
    profile = curve(ship(), "profile")
    side, bottom = widening(flat_of_side(table).border), flat_of_bottom(table)
    points = centre_profile(table)[0]
    figure, (above, below) = plt.subplots(
        2, 1, figsize=(9.4, 5.4), layout="constrained", height_ratios=(1.25, 1)
    )
    above.plot(profile[:, 0], profile[:, 2], color=INK, linewidth=1.6, label="centre-line profile")
    above.plot(
        stern, table.z, "o", color=DRIVEN, markersize=4.5, label="waterline ends found or assumed"
    )
    above.plot(stem, table.z, "o", color=DRIVEN, markersize=4.5)
    above.plot(
        side[:, 0], side[:, 2], ".-", color=FIXED, linewidth=1.2, label="border of the flat of side"
    )
    above.axhline(table.draught, color=SHARED, linewidth=0.8, linestyle="--")
    above.text(25.0, table.draught + 0.15, "T", color=SHARED)
    above.plot(points[[0, -1], 0], points[[0, -1], 2], color=PALE, linewidth=1.2, zorder=0)
    above.text(61.0, points[0, 2] + 0.25, "deck edge, level at 1.5 T", color=PALE, ha="center")
    above.set(ylabel="z (m)", ylim=(-0.6, 12.2), xlim=(-7, 127))
    for x in table.x.tolist():
        below.axvline(x, color=FAINT, linewidth=0.6, zorder=0)
    deck = curve(ship(), "deck edge")
    below.plot(deck[:, 0], deck[:, 1], color=PALE, linewidth=1.2, label="deck edge")
    below.plot(
        bottom[:, 0],
        bottom[:, 1],
        ".-",
        color=SHARED,
        linewidth=1.2,
        label="border of the flat of bottom (WL 0)",
    )
    below.set(
        xlabel="x (m, from AP); thin lines: the stations of the table",
        ylabel="y (m)",
        xlim=(-7, 127),
        ylim=(-0.4, 9.4),
    )
    above.legend(loc="lower right", bbox_to_anchor=(0.94, 0.12), frameon=False, fontsize=9)
    below.legend(loc="center", bbox_to_anchor=(0.52, 0.3), frameon=False, fontsize=9)
    return figure


# Lines plan --------------------------------------------------------------------------------


def plan() -> Figure:
    """Draw the lines plan of Series 60 CB 0.70."""
    return lines_plan(ship(), paper="A4")


PICTURES: dict[str, Callable[[], Figure]] = {
    "series60": plan,
    "crossing": crossing,
    "roles": roles,
    "pull": pull,
    "pinned_or_field": pinned_or_field,
    "levels": levels,
    "spline": knuckle_end,
    "completions": completions,
}


def write(name: str) -> int:
    """Draw one picture, take its colours down to a palette, give its size in bytes."""
    figure = PICTURES[name]()
    path = FOLDER / f"{name}.png"
    dpi = 110 if name == "series60" else 120
    figure.savefig(path, dpi=dpi, facecolor="white", bbox_inches=None)
    plt.close(figure)
    colours = 16 if name == "series60" else 64
    with Image.open(path) as image:
        image.convert("RGB").quantize(colours).save(path, optimize=True)
    return path.stat().st_size


def main(names: list[str]) -> int:
    """Draw the pictures that are named, or all; tell their sizes."""
    FOLDER.mkdir(exist_ok=True)
    heavy = 0
    for name in names or PICTURES:
        size = write(name)
        heavy += size > LARGEST
        print(f"{name}.png: {size / 1000:.0f} kB" + (" (too large)" if size > LARGEST else ""))
    return int(heavy > 0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
