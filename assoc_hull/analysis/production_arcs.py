"""Lines of a net as chains of arcs for production, each in its plane.

Lines are laid into their planes and fitted in one batch; a space curve is replaced by two of its
views. What no arcs within the limits can follow is refused by name, with the place, or left out
where it was not asked for by name. `ArcLines` holds the result and its report. Lengths in m.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.display import ShownAsText
from assoc_hull.errors import BadInputError, GeometryError, WrongTypeError
from assoc_hull.geometry.classical.arc_fit import ArcFit, fit_arcs
from assoc_hull.geometry.classical.checked_input import digits
from assoc_hull.geometry.classical.circular_arcs import PlaneArcs
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.plane import unit_normal
from assoc_hull.geometry.polylines.flats import fit_plane
from assoc_hull.geometry.splines.segments import power_coefficients
from assoc_hull.model.kinds import OWN
from assoc_hull.model.objects import Curve, Group, Line, handle
from assoc_hull.model.tables import HullState

__all__ = [
    "ArcLine",
    "ArcLines",
    "arc_lines",
    "curves_of",
    "drawing_axes",
]

# --------------------------------------------------------------------------------------
# Results.


@attrs.frozen(eq=False)
class ArcLine:
    """One curve of a line as arcs.

    Attributes
    ----------
    name : str
        Address of the curve: the line, with a number if it is one of several; of a space curve
        with the view: "deck edge (plan)".
    group : str
        Group of its line.
    axes : (3, 3)
        Unit vectors of the drawing plane, to the right and up, and its normal, which points to
        whoever looks at it: (y, z) for sections, (x, y) for waterlines, (x, z) for buttocks.
    height : float, m
        Of the plane along the normal.
    arcs : PlaneArcs
        In the plane, in order.
    smooth : (n,) bool
        Whether an arc begins in the direction in which the one before it ends; false for the
        first, and at knuckles.
    deviation : (2,), m
        Largest distance of the curve from the arcs, and of the arcs from the curve.
    place : (3,), m
        Where the curve is farthest from its arcs.
    points : int
        Points of the net on the curve.
    """

    name: str
    group: str
    axes: FloatArray
    height: float
    arcs: PlaneArcs
    smooth: NDArray[np.bool_]
    deviation: FloatArray
    place: FloatArray
    points: int

    def __attrs_post_init__(self) -> None:
        freeze(self.axes, self.smooth, self.deviation, self.place)

    @property
    def least_radius(self) -> float:
        """Of its arcs, m; infinite if all are straight."""
        sharpest = float(np.abs(self.arcs.curvature).max())
        return 1.0 / sharpest if sharpest > 0.0 else float("inf")

    def in_space(self, places: FloatArray) -> FloatArray:
        """Give points of the plane, (n, 2), m, in the axes of the hull, (n, 3), m."""
        found: FloatArray = places @ self.axes[:2] + self.height * self.axes[2]
        return found

    def starts(self) -> FloatArray:
        """Give where the arcs begin, (n, 3), m."""
        return self.in_space(self.arcs.start)

    def directions(self) -> FloatArray:
        """Give unit vectors along the arcs where they begin, (n, 3)."""
        angle = self.arcs.angle
        found: FloatArray = np.stack([np.cos(angle), np.sin(angle)], axis=1) @ self.axes[:2]
        return found

    def centres(self) -> FloatArray:
        """Give the centres, (n, 3), m; not a number for straight lines."""
        found = self.arcs.centres()
        return self.in_space(np.where(np.isfinite(found), found, np.nan))

    def facts(self) -> dict[str, Any]:
        """Give what is reported of it."""
        return {
            "line": self.name, "group": self.group, "arcs": len(self.arcs),
            "straight": int((self.arcs.curvature == 0.0).sum()),
            "deviation": float(self.deviation.max()),
            "deviation_of_curve": float(self.deviation[0]),
            "deviation_of_arcs": float(self.deviation[1]),
            "place": self.place.tolist(), "least_radius": self.least_radius,
            "net_points": self.points,
        }  # fmt: skip


@attrs.frozen(eq=False, repr=False)
class ArcLines(ShownAsText):
    """Lines of a hull as arcs.

    Attributes
    ----------
    ship : str
        Name of the hull.
    within : float, m
        Tolerance that was asked for.
    allowed_radius : float, m
        Least radius that was asked for; 0 if none was.
    lines : tuple of ArcLine
        In the order of the hull.
    left_out : tuple of str
        What is not among them, and why; a sentence each.
    notes : tuple of str
        What stands for a line that lies in no plane; a sentence each.
    """

    ship: str
    within: float
    allowed_radius: float
    lines: tuple[ArcLine, ...]
    left_out: tuple[str, ...]
    notes: tuple[str, ...] = ()

    @property
    def count(self) -> int:
        """Number of arcs."""
        return sum(len(line.arcs) for line in self.lines)

    @property
    def deviation(self) -> float:
        """Largest distance of a line and its arcs, both ways, m."""
        return max((float(line.deviation.max()) for line in self.lines), default=0.0)

    @property
    def least_radius(self) -> float:
        """Of all arcs, m; infinite if all are straight."""
        return min((line.least_radius for line in self.lines), default=float("inf"))

    @property
    def one_per_interval(self) -> int:
        """Arcs that one biarc between neighbouring points of the net would take."""
        return sum(2 * max(line.points - 1, 1) for line in self.lines)

    def facts(self) -> dict[str, Any]:
        """Give the report as data."""
        return {
            "ship": self.ship, "within": self.within, "least_radius_asked": self.allowed_radius,
            "arcs": self.count, "deviation": self.deviation, "least_radius": self.least_radius,
            "one_biarc_per_interval": self.one_per_interval,
            "lines": [line.facts() for line in self.lines], "left_out": list(self.left_out),
            "notes": list(self.notes),
        }  # fmt: skip

    def __str__(self) -> str:
        return (
            f"{len(self.lines)} curves, {self.count} arcs, at most {1e3 * self.deviation:.3f} mm "
            f"off, least radius {self.least_radius:.3f} m"
        )


# --------------------------------------------------------------------------------------
# Fitting.

_OFF_PLANE = 0.1
"""A curve that leaves its plane by more than this part of the tolerance is a space curve."""

Lines = Group | Line | Curve | str


@attrs.frozen(eq=False)
class _Laid:
    """A curve in its plane, or a view of it."""

    curve: Curve
    name: str
    axes: FloatArray
    height: float
    off: float
    cubic: FloatArray


def arc_lines(
    state: HullState, lines: Sequence[Lines] | Lines | None, within: float, least_radius: float
) -> ArcLines:
    """Make arcs of lines of a net (`Hull.production_arcs`)."""
    laid: list[_Laid] = []
    left_out: list[str] = []
    notes: list[str] = []
    for curve in curves_of(state, lines):
        one = _laid(curve, within)
        if one.off > _OFF_PLANE * within:
            notes.append(_space(one))
            laid += _views(curve)
        else:
            laid.append(one)
    start = np.concatenate([[0], np.cumsum([len(one.cubic) for one in laid])]).astype(np.int64)
    cubic = np.concatenate([one.cubic for one in laid] + [np.zeros((0, 4, 2))])
    found: list[ArcLine] = []
    if laid:
        fit = fit_arcs(cubic, start, within, least_radius)
        for number, one in enumerate(laid):
            if fit.stuck[number]:
                error = _lost(one, fit.sharpest[number], within, least_radius)
                left_out.append(_refused(error, lines))
            else:
                found.append(_line(one, fit, number))
    return ArcLines(
        state.particulars.name, within, least_radius, tuple(found), tuple(left_out), tuple(notes)
    )


def curves_of(state: HullState, lines: Sequence[Lines] | Lines | None) -> list[Curve]:
    """Give the curves of lines, in the order of the hull; all if none is named.

    Raises
    ------
    UnknownNameError, WrongTypeError, BadInputError
        A name that nothing has, what is no line, or none at all.
    """
    if lines is None:
        return [
            curve
            for group in state.live("groups").tolist()
            if state.groups.family[group] != OWN
            for line in Group.of(state, group).lines.values()
            for curve in line.curves
        ]
    where = "in production_arcs"
    named = [lines] if isinstance(lines, str | Group | Line | Curve) else lines
    if not isinstance(named, Iterable):
        raise WrongTypeError(f"lines are a {type(lines).__name__}", where, "give names of lines")
    found: dict[int, Curve] = {}
    for each in named:
        thing = handle(state, each) if isinstance(each, str) else each
        if not isinstance(thing, Group | Line | Curve):
            what = f"{each!r} is no line" if isinstance(each, str) else "one of them is no line"
            raise WrongTypeError(what, where, "give lines, groups or their names")
        found |= {curve.row: curve for curve in _curves(thing)}
    if not found:
        raise BadInputError("no line is named", where, "name one, or leave the argument out")
    return list(found.values())


def _curves(thing: Group | Line | Curve) -> list[Curve]:
    if isinstance(thing, Curve):
        return [thing]
    lines = thing.lines.values() if isinstance(thing, Group) else [thing]
    return [curve for line in lines for curve in line.curves]


def drawing_axes(normal: FloatArray) -> FloatArray:
    """Give right, up and the normal of a plane as a drawing shows it, (3, 3).

    They are those that DXF gives a plane of this normal: right is horizontal. The normal is turned
    so that x runs to the right where the plane runs along the ship.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.analysis.production_arcs import drawing_axes
    >>> drawing_axes(np.array([0.0, 1.0, 0.0])).tolist()
    [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]
    """
    # The rule of DXF for arbitrary axes: 1/64 is its bound between the two choices of "right".
    main = int(np.argmax(np.abs(normal)))
    wanted = -1.0 if main == 1 else 1.0
    facing = normal if normal[main] * wanted > 0.0 else -normal
    level = max(abs(float(facing[0])), abs(float(facing[1]))) < 1.0 / 64.0
    right = np.cross([0.0, 1.0, 0.0] if level else [0.0, 0.0, 1.0], facing)
    right = right / np.sqrt((right * right).sum())
    return np.stack([right, np.cross(facing, right), facing]) + 0.0


def _laid(curve: Curve, within: float) -> _Laid:
    """Lay a curve into the nearer of two planes: that of its line, and the one that fits best."""
    cubic = power_coefficients(curve.spline)
    control = _control(cubic)
    plane = curve.line.plane
    normals = [] if plane is None else [plane.normal]
    found = fit_plane(control, within)
    normals.append(unit_normal(found[0] / np.sqrt((found[0] * found[0]).sum())))
    best: _Laid | None = None
    for normal in normals:
        axes = drawing_axes(normal)
        heights = control @ axes[2]
        height = 0.5 * float(heights.max() + heights.min())
        off = 0.5 * float(heights.max() - heights.min())
        if best is None or off < best.off:
            flat = np.ascontiguousarray(cubic @ axes[:2].T)
            best = _Laid(curve, curve.name, axes, height, off, flat)
        if best.off <= _OFF_PLANE * within:
            break
    assert best is not None
    return best


def _control(cubic: FloatArray) -> FloatArray:
    """Give the Bezier points of cubics (s, 4, 3) as one list, (4 s, 3), m."""
    first = cubic[:, 0] + cubic[:, 1] / 3.0
    third = 2.0 * first - cubic[:, 0] + cubic[:, 2] / 3.0
    return np.concatenate([cubic[:, 0], first, third, cubic.sum(axis=1)])


def _line(one: _Laid, fit: ArcFit, number: int) -> ArcLine:
    """Make the result of a fitted curve; what it is off its plane counts as deviation."""
    own = slice(int(fit.start[number]), int(fit.start[number + 1]))
    place = fit.place[number] @ one.axes[:2] + one.height * one.axes[2]
    return ArcLine(
        one.name, one.curve.line.group.name, one.axes, one.height, fit.of(number),
        fit.smooth[own].copy(), np.hypot(fit.deviation[number], one.off), place,
        len(one.curve.points),
    )  # fmt: skip


def _refused(error: GeometryError, lines: object) -> str:
    """Give why a line is left out; if it was asked for by name, raise that."""
    if lines is not None:
        raise error
    return str(error)


def _views(curve: Curve) -> list[_Laid]:
    """Give the two views of a space curve that show its length, in planes of the axes."""
    cubic = power_coefficients(curve.spline)
    control = _control(cubic)
    longest = int(np.argmax(control.max(axis=0) - control.min(axis=0)))
    found = []
    for axis, view in ((2, "plan"), (1, "profile"), (0, "body plan")):
        if axis == longest:
            continue
        axes = drawing_axes(np.eye(3)[axis])
        flat = np.ascontiguousarray(cubic @ axes[:2].T)
        found.append(_Laid(curve, f"{curve.name} ({view})", axes, 0.0, 0.0, flat))
    return found


def _space(one: _Laid) -> str:
    views = " and ".join(each.name for each in _views(one.curve))
    return (
        f"{one.name} is a space curve, {1e3 * one.off:.3g} mm off its best plane: "
        f"{views} stand for it, each within the tolerance in its view"
    )


def _lost(one: _Laid, sharpest: FloatArray, within: float, least_radius: float) -> GeometryError:
    """Name the place of a curve that no arcs within the limits can follow."""
    place = np.round(sharpest[:2] @ one.axes[:2] + one.height * one.axes[2], 3) + 0.0
    told = ", ".join(f"{value:g}" for value in place.tolist())
    radius = float(sharpest[2])
    arcs = f"arcs of {digits(least_radius)} m and more" if least_radius > 0.0 else "arcs"
    return GeometryError(
        f"arcs: {one.name} has a radius of {radius:.4g} m at ({told}), "
        f"{arcs} cannot follow it within {digits(1e3 * within)} mm",
        "allow a smaller radius or a wider tolerance, or make the place a knuckle",
        {"line": one.name, "place": tuple(place.tolist()), "radius": radius, "least": least_radius},
    )  # fmt: skip
