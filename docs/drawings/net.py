"""The net: a crossing, roles on waterlines, the levels of an update."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle

import assoc_hull as ah
from drawings.common import (
    ACCENT,
    DRIVEN,
    FAINT,
    FIXED,
    INK,
    PALE,
    SHARED,
    WATCHED,
    Floats,
    arrow,
    bare,
    curve,
    ship,
)

__all__ = ["crossing", "levels", "roles"]


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
    point = hull["WL 0.5 x ST 17"]
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
    for line in hull["sections"].lines.values():
        if line.position < 36.0:
            axes.axvline(line.position, color=FAINT, linewidth=0.9, zorder=0)
            if line.name in {"ST 0", "ST 1", "ST 2", "ST 3", "ST 4", "ST 5"}:
                axes.text(line.position, 9.05, line.name, ha="center", color=PALE, fontsize=9)
    for line in hull["buttocks"].lines.values():
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


def levels() -> Figure:
    """Draw the curves that one drag re-lofts, by level; a line is a crossing that drove."""
    hull = ship()
    with hull.edit("drag") as edit:
        edit.move("WL 0.5 x ST 16", y=hull["WL 0.5 x ST 16"].y + 0.02)
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
