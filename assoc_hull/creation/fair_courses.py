"""Solve the courses that shape sections, so that the family of sections is fair along the ship.

Waves of a created ship come of its courses: angles, curvatures and tangents whose nodes do not suit
one another from station to station. Here the nodes of all courses by the rule ``spline`` are solved
together. Held are areas, waterline, contour and flats, and nodes whose angle is given. What is made
least, over many waterlines and buttocks, is how much a batten turns that is lifted off a section,

    rho = r |e . n| / h,    sum of s^2 log(1 + (rho / s)^2)

with r the batten residual of five sections, h their spacing, e . n the share of the move across the
line that is normal to the hull; the logarithm lets shoulders be. Added are the squared third
derivatives of sections, which keep these plain, and squared moves of nodes from where they stood.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from functools import cached_property

import attrs
import numpy as np

from assoc_hull.analysis.fairness.fair_solution import linear_algebra
from assoc_hull.creation.design import Design
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.fairness.criteria import batten_coefficients
from assoc_hull.geometry.form_curves.chain import FormChain
from assoc_hull.geometry.form_curves.curve import form_at
from assoc_hull.geometry.form_curves.shape import least_coordinate
from assoc_hull.model.form_definition import FormDefinition
from assoc_hull.model.forms.courses import course_vertices
from assoc_hull.model.forms.form_values import Forms
from assoc_hull.model.forms.line_layout import layout_at
from assoc_hull.model.forms.sections import (
    SectionCurves,
    SectionEnds,
    SectionPieces,
    SectionShape,
    bulb_pieces,
    parts_at_draught,
    topside_pieces,
    underwater_pieces,
)

__all__ = ["GivenForms", "fair_courses"]

# --------------------------------------------------------------------------------------
# Numbers.


@attrs.frozen
class _Use:
    """How a value of a course is moved: a step for rates, what is a usual move, and limits."""

    step: float
    usual: float
    least: float
    most: float


_USES: Mapping[str, _Use] = {
    "keel_angle": _Use(-0.05, 15.0, 1.0, 89.5),
    "keel_curvature": _Use(1e-4, 0.15, -math.inf, math.inf),
    "keel_tangent": _Use(1e-3, 0.25, 0.2, 1.4),
    "waterline_angle": _Use(0.05, 4.0, 0.0, 88.0),
    "waterline_curvature": _Use(1e-4, 0.1, -math.inf, 0.0),
    "waterline_tangent": _Use(1e-3, 0.25, 0.2, 1.4),
    "deck_angle": _Use(0.05, 3.0, -5.0, 75.0),
    "bulb_area": _Use(1e-3, 2.0, 0.0, math.inf),
    "bulb_height": _Use(1e-3, 0.5, 0.0, math.inf),
    "bulb_neck": _Use(1e-3, 0.4, 0.0, math.inf),
    "bulb_neck_angle": _Use(0.05, 10.0, -85.0, 85.0),
}

_SHOULDER = math.radians(0.7)
"""s: what turns by much more is meant to."""

_STAY, _PLAIN, _INSIDE = math.radians(0.15), 8e-3, 5.0
"""Weights, rad: of a usual move of a node, of third derivatives over the chord, and of each metre
beyond the centre plane or below where a piece starts."""

_ROUNDS, _FACTOR, _GAIN = 10, 6.0, 1e-2
"""Most rounds; by what damping changes; a smaller gain, of what is left, ends it."""

_APART = 0.25
"""Sections of the family stand no farther apart, in twentieths of the length."""

_SQUARE = 0.25
"""A line that meets the hull at a smaller |e . n| says little."""

_SAMPLES = np.linspace(0.0, 4.0, 25)
"""Parameters of a piece between which it is looked for levels."""


def fair_courses(design: Design, rounds: int = _ROUNDS) -> Design:
    """Give the design with the values of nodes for which the family of its sections is fair.

    A design without courses by the rule ``spline`` comes back as it is.
    """
    uses = [each for each in design.definitions if each.rule == "spline" and each.use in _USES]
    if not uses:
        return design
    family = _Family.of(design, [each.use for each in uses])
    nodes = _Nodes.of(design, family.x, uses)
    with linear_algebra().limit(limits=1):
        # Other threads would give other last digits.
        values = _solved(family, nodes, rounds)
    return design.having(*nodes.definitions(values))


# --------------------------------------------------------------------------------------
# Nodes: the unknowns. A course by the rule ``spline`` is linear in the ordinates of its nodes.


@attrs.frozen(eq=False)
class _Nodes:
    """Nodes of courses.

    Attributes
    ----------
    courses : tuple of FormDefinition
        Whose nodes they are.
    start : (n,)
        Their ordinates.
    use : (n,) int
        Whose each is.
    free : (n,) bool
        Which move.
    least, most, usual : (n,)
        Limits, and a usual move.
    share : (u, x, n)
        What each adds to its course at the places of a family.
    """

    courses: tuple[FormDefinition, ...]
    start: FloatArray
    use: IntArray
    free: np.typing.NDArray[np.bool_]
    least: FloatArray
    most: FloatArray
    usual: FloatArray
    share: FloatArray

    @classmethod
    def of(cls, design: Design, x: FloatArray, courses: Sequence[FormDefinition]) -> _Nodes:
        """Take the nodes of courses; those with an angle are held."""
        rows = [(number, each, node) for number, each in enumerate(courses) for node in each.nodes]
        share = np.zeros((len(courses), len(x), len(rows)))
        for column, (number, each, node) in enumerate(rows):
            share[number, :, column] = _share(each, node, x)
        level = _level_from(design)
        limits = [
            _limits(each.use, each.value(f"{node}_x") or 0.0, level) for _, each, node in rows
        ]
        start = np.array([each.value(f"{node}_y") for _, each, node in rows], np.float64)
        bow = design.particulars.length
        free = [
            each.value(f"{node}_angle_deg") is None
            # Ahead of the stem a bulb is one with its contour.
            and not (each.use.startswith("bulb_a") and (each.value(f"{node}_x") or 0.0) >= bow)
            for _, each, node in rows
        ]
        return cls(
            tuple(courses), start, np.array([number for number, *_ in rows]), np.array(free),
            np.array([low for low, _ in limits]), np.array([high for _, high in limits]),
            np.array([_USES[each.use].usual for _, each, _ in rows]), share,
        )  # fmt: skip

    def within(self, values: FloatArray) -> FloatArray:
        """Keep free nodes within their limits."""
        return np.where(self.free, np.clip(values, self.least, self.most), self.start)

    def definitions(self, values: FloatArray) -> list[FormDefinition]:
        """Give the courses with other ordinates."""
        return [
            each.having({
                # Beyond six digits it is rounding of a solver.
                f"{node}_y": round(float(value), 6) if free else float(value)
                for node, value, free in zip(
                    each.nodes, values[self.use == number], self.free[self.use == number],
                    strict=True,
                )
            })
            for number, each in enumerate(self.courses)
        ]  # fmt: skip


def _share(course: FormDefinition, node: str, x: FloatArray) -> FloatArray:
    """Give what one node adds to a course at places, (x,), for each unit of its ordinate."""
    unit = {f"{each}_y": float(each == node) for each in course.nodes}
    level = {
        f"{each}_{name}": None if course.value(f"{each}_{name}") is None else 0.0
        for each in course.nodes for name in ("angle_deg", "leave_angle_deg")
    }  # fmt: skip
    chain = FormChain(course_vertices(course.having({**unit, **level})))
    return chain.ordinate(np.clip(x, chain.start[0], chain.finish[0]))


def _level_from(design: Design) -> float:
    """Give from which place (m) sections start level, or bend inward at the contour."""
    for each in design.definitions:
        if each.use == "flat_of_bottom":
            return each.value(f"{each.nodes[0]}_x") or 0.0
    return math.inf


def _limits(use: str, x: float, level_from: float) -> tuple[float, float]:
    """Give the limits of a node: a skeg is hollow at the contour, all ahead of it round."""
    least, most = _USES[use].least, _USES[use].most
    if use == "keel_curvature":
        return (0.0, most) if x < level_from - _NEAR else (least, 0.0)
    return least, most


# --------------------------------------------------------------------------------------
# The family of sections.


class _Lenient(SectionEnds):
    """Sections of which nothing is refused while they are sought."""

    def refuse(self, bad: object, what: str, remedy: str) -> None:
        """Let it pass."""

    def within(self, name: str, *args: object) -> None:
        """Let it pass, but for areas that lie outside their box whatever the courses are."""
        if name == "sectional_area":
            SectionEnds.within(self, name, *args)  # type: ignore[arg-type]


@attrs.frozen(eq=False)
class GivenForms(Forms):
    """Definitions some of which have other values where sections stand."""

    given: Mapping[str, FloatArray] = attrs.field(factory=dict)

    def value(self, use: str, x: object, default: float = np.nan) -> FloatArray:
        """Read a definition at the places of the family."""
        found = self.given.get(use)
        return Forms.value(self, use, x, default) if found is None else found  # type: ignore[arg-type]


@attrs.frozen(eq=False)
class _Found:
    """Lines of a family: coordinates at columns, and their rates.

    Attributes
    ----------
    at : (l, c), m
        By level and column; nan where the line is not.
    cosine : (l, c)
        |e . n| of the line.
    rate : (l, c, u)
        By the values of uses at the column.
    row, row_x, row_rate : (k,), (k,) int, (k, u)
        Other residuals of single sections, with their columns and rates.
    gap, gap_x, gap_rate : (m,), (m,) int, (m, u)
        How far (m) sections are inside of the centre plane and of their beginnings, likewise.
    """

    at: FloatArray
    cosine: FloatArray
    rate: FloatArray
    row: FloatArray
    row_x: IntArray
    row_rate: FloatArray
    gap: FloatArray
    gap_x: IntArray
    gap_rate: FloatArray


@attrs.frozen(eq=False, slots=False)
class _Family:
    """Sections along a ship, and the waterlines and buttocks through them.

    Attributes
    ----------
    forms : Forms
        Definitions.
    x : (c,), m
        Where sections stand.
    uses : tuple of str
        What is varied.
    ends : (c, 2, 3), m
        On contour and deck edge.
    groups : mapping of str to (n,) int
        Sections of one layout.
    heights, breadths : (w,), (b,) m
        Levels of waterlines and buttocks.
    """

    forms: Forms
    x: FloatArray
    uses: tuple[str, ...]
    ends: FloatArray
    groups: Mapping[str, IntArray]
    heights: FloatArray
    breadths: FloatArray

    @classmethod
    def of(cls, design: Design, uses: Sequence[str]) -> _Family:
        """Let sections of a design stand closely."""
        forms = Forms.of(design.definitions, design.particulars)
        x, ends, groups = list[float](), list[object](), dict[str, list[int]]()
        for each in _places(design):
            heights = forms.contour(each)
            part = 1 if len(heights) == 3 else 0
            if len(heights) not in (1, 3):
                continue
            side, deck = (float(forms.value(use, each)[0]) for use in ("deck_side", "deck_height"))
            if not deck > heights[-1] + 0.1:
                continue
            groups.setdefault(layout_at(forms, "section", each, part), []).append(len(x))
            ends.append(((each, 0.0, heights[-1 if part else 0]), (each, side, deck)))
            x.append(each)
        ship = design.particulars
        return cls(
            forms, np.array(x), tuple(uses), np.array(ends),
            {layout: np.array(numbers) for layout, numbers in groups.items()},
            np.concatenate([
                ship.draught * np.array(_BELOW),
                ship.draught + (ship.depth - ship.draught) * np.array(_ABOVE),
            ]),
            0.5 * ship.breadth * np.array(_OUT),
        )  # fmt: skip

    @cached_property
    def stems(self) -> FloatArray:
        """Give where waterlines end on the contour, aft and forward, (w, 2) m; nan if nowhere."""
        chain = self.forms.chain("profile")
        middle = 0.5 * self.forms.particulars.length
        found = np.full((len(self.heights), 2), np.nan)
        for number, height in enumerate(self.heights.tolist()):
            places = chain.meets(1, height)
            if not places:
                continue
            piece, t = (np.array(each) for each in zip(*places, strict=True))
            x = chain.at(piece, t)[:, 0]
            if (x < middle).any():
                found[number, 0] = x[x < middle].min()
            if (x > middle).any():
                found[number, 1] = x[x > middle].max()
        return found

    def found(self, values: FloatArray, rates: bool = True) -> _Found:
        """Lay lines through the sections with values (u, c) of the uses."""
        levels, columns = len(self.heights) + len(self.breadths), len(self.x)
        count = len(self.uses) if rates else 0
        at = np.full((levels, columns), np.nan)
        cosine = np.zeros((levels, columns))
        rate = np.zeros((levels, columns, count))
        others = list[tuple[FloatArray, IntArray, FloatArray]]()
        gaps = list[tuple[FloatArray, IntArray, FloatArray]]()
        for layout, here in self.groups.items():
            group = _Group.of(self, layout, here, values[:, here], rates)
            level, section, co, share, change = group.lines(self.heights, self.breadths)
            at[level, here[section]], cosine[level, here[section]] = co, share
            rate[level, here[section]] = change
            plain, inside = group.plain(), group.inside()
            others += [(value, here[column], by) for value, column, by in plain]
            gaps += [(value, here[column], by) for value, column, by in inside]
        return _Found(
            at, cosine, rate, *map(np.concatenate, zip(*others, strict=True)),
            *map(np.concatenate, zip(*gaps, strict=True)),
        )  # fmt: skip


_BELOW = (0.05, 0.1, 0.19, 0.29, 0.38, 0.48, 0.57, 0.67, 0.76, 0.86, 0.95, 1.0)
_ABOVE = (0.2, 0.4, 0.6, 0.8)
_OUT = (0.07, 0.15, 0.3, 0.45, 0.6, 0.75, 0.88)
"""Levels of lines: of the draught, of the freeboard, of half the breadth."""


def _places(design: Design) -> list[float]:
    """Give places (m) of sections: stations, and others between them."""
    step = _APART * design.particulars.length / 20.0
    found: list[float] = []
    if design.transom is not None and design.station_places[0] - design.transom > 0.1:
        found.append(design.transom)
    for low, high in itertools.pairwise(design.station_places):
        parts = max(1, math.ceil((high - low) / step - 1e-9))
        found += np.linspace(low, high, parts + 1)[:-1].tolist()
    return [*found, design.station_places[-1]]


@attrs.frozen(eq=False)
class _Group:
    """Sections of one layout, as they are and with each use moved by its step.

    Attributes
    ----------
    shape : SectionShape
        As they are first, then with each use moved.
    count, uses : int
        Of sections, and of uses that are moved.
    steps : (u,)
        By what.
    half : float, m
        Half the breadth, which no section may pass.
    """

    shape: SectionShape
    count: int
    steps: FloatArray
    half: float

    @classmethod
    def of(
        cls, family: _Family, layout: str, here: IntArray, values: FloatArray, rates: bool
    ) -> _Group:
        """Make sections of a family."""
        steps = np.array([_USES[use].step for use in family.uses]) if rates else np.empty(0)
        blocks = 1 + len(steps)
        given = {}
        for number, use in enumerate(family.uses):
            tiled = np.tile(values[number], (blocks, 1))
            if rates:
                tiled[number + 1] += steps[number]
            given[use] = tiled.ravel()
        forms = GivenForms(family.forms.definitions, family.forms.particulars, given)
        rows = np.tile(here, blocks)
        stand = _Lenient.of(forms, family.x[rows], family.ends[rows])
        lower, upper = parts_at_draught(layout)
        pieces, below = list[SectionPieces](), None
        if lower:
            make = bulb_pieces if lower[0] == "bulb" else underwater_pieces
            pieces, below = make(stand, lower)
        if upper:
            pieces = pieces + topside_pieces(stand, upper, below)
        shape = SectionShape(family.x[rows], tuple(pieces))
        return cls(shape, len(here), steps, 0.5 * family.forms.particulars.breadth)

    def lines(
        self, heights: FloatArray, breadths: FloatArray
    ) -> tuple[IntArray, IntArray, FloatArray, FloatArray, FloatArray]:
        """Give level, section, coordinate, |e . n| and rates of all crossings with lines."""
        count, pieces, each = self.count, len(self.shape.pieces), len(_SAMPLES)
        row = np.repeat(np.arange(count), pieces * each)
        piece = np.tile(np.repeat(np.arange(pieces), each), count)
        points = self.shape.at(row, piece, np.tile(_SAMPLES, count * pieces))
        points = points.reshape(count, pieces, each, 3)
        found = []
        for first, across, levels in ((0, 2, heights), (len(heights), 1, breadths)):
            off = points[None, ..., across] - levels[:, None, None, None]
            low, high = off[..., :-1], off[..., 1:]
            passed = ((low <= 0.0) != (high <= 0.0)).reshape(len(levels), count, -1)
            level, section = np.nonzero(passed.any(axis=2))
            # Of several crossings the lowest counts.
            place = passed[level, section].argmax(axis=1)
            number, part = np.divmod(place, each - 1)
            found.append((level + first, section, number, part, levels[level], 0 * level + across))
        level, section, number, part, height, axis = map(np.concatenate, zip(*found, strict=True))
        t = self._refined(section, number, part, height, axis)
        point, along = self.shape.at(section, number, t), self.shape.tangent(section, number, t)
        every = np.arange(len(t))
        other = 3 - axis
        rise = along[every, axis]
        cosine = np.abs(rise) / np.sqrt((along * along).sum(axis=1))
        rise = np.where(np.abs(rise) < 1e-6, 1e-6, rise)
        rates = np.zeros((len(t), len(self.steps)))
        for use, step in enumerate(self.steps.tolist()):
            moved = self.shape.at(section + (use + 1) * self.count, number, t) - point
            slide = moved[every, axis] * along[every, other] / rise
            rates[:, use] = (moved[every, other] - slide) / step
        return level, section, point[every, other], cosine, rates

    def _refined(
        self, section: IntArray, piece: IntArray, part: IntArray, height: FloatArray, axis: IntArray
    ) -> FloatArray:
        """Give the parameters at which pieces reach levels, between two samples."""
        low, high = _SAMPLES[part], _SAMPLES[part + 1]
        every = np.arange(len(low))
        ends = [self.shape.at(section, piece, t)[every, axis] - height for t in (low, high)]
        t = low + (high - low) * ends[0] / (ends[0] - ends[1])
        for _ in range(3):
            off = self.shape.at(section, piece, t)[every, axis] - height
            rate = self.shape.tangent(section, piece, t)[every, axis]
            t = np.clip(t - off / np.where(np.abs(rate) < 1e-9, 1e-9, rate), low, high)
        return t

    def plain(self) -> list[tuple[FloatArray, IntArray, FloatArray]]:
        """Give third derivatives of the pieces of sections over their chords, weighted."""
        found = []
        every = np.arange(self.count)
        for piece in self._curves:
            v = piece.vertices
            third = v[:, 3:] - 3.0 * v[:, 2:-1] + 3.0 * v[:, 1:-2] - v[:, :-3]
            step = piece.finish - piece.start
            chord = np.maximum(np.sqrt((step * step).sum(axis=1)), 0.5)
            part = _PLAIN * third.reshape(len(v), 8) / chord[:, None]
            part = part.reshape(1 + len(self.steps), -1, 8)
            rate = (part[1:] - part[0]) / self.steps[:, None, None]
            found += [(part[0, :, k], every, rate[:, :, k].T) for k in range(8)]
        return found

    def inside(self) -> list[tuple[FloatArray, IntArray, FloatArray]]:
        """Give how far pieces are from the centre plane and the side, and above their starts."""
        found = []
        every = np.arange(self.count)
        for piece in self._curves:
            v = piece.vertices
            # Near its ends a piece may touch the centre plane.
            y = np.einsum("st,nt->ns", _INNER, v[:, :, 1])
            room = y.min(axis=1) - np.minimum(0.2 * piece.finish[:, 1], _MARGIN)
            for gap in (
                room, self.half - y.max(axis=1), least_coordinate(v, 0) - piece.start[:, 0]
            ):  # fmt: skip
                part = gap.reshape(1 + len(self.steps), -1)
                found.append((part[0], every, ((part[1:] - part[0]) / self.steps[:, None]).T))
        return found

    @property
    def _curves(self) -> list[SectionCurves]:
        return [each for each in self.shape.pieces if isinstance(each, SectionCurves)]


_MARGIN = 2e-2
"""m: sections are to stay off the centre plane by so much."""

_INNER = np.array([
    form_at(np.stack([np.eye(7), np.eye(7)], axis=-1), np.full(7, t))[:, 0]
    for t in np.linspace(0.25, 3.75, 15).tolist()
])  # fmt: skip
"""Shares of vertices in points of a piece, (15, 7)."""


# --------------------------------------------------------------------------------------
# Least squares.


@attrs.frozen(eq=False)
class _Windows:
    """Windows of five sections on lines: which places, with which coefficients.

    Attributes
    ----------
    place : (w, 5) int
        In the flat array of lines, which has a column more on either side.
    column : (w, 5) int
        The section of each.
    coefficient : (w, 5), 1/m
        rho is their sum with the coordinates.
    fixed : (l, c + 2), m
        Coordinates where waterlines end on the contour, else nan.
    """

    place: IntArray
    column: IntArray
    coefficient: FloatArray
    fixed: FloatArray

    @classmethod
    def of(cls, family: _Family, found: _Found) -> _Windows:
        """Lay windows where lines are and say something; none runs across a gap."""
        levels, columns = found.at.shape[0], found.at.shape[1] + 2
        here = np.pad(np.isfinite(found.at), ((0, 0), (1, 1)))
        x = np.tile(np.pad(family.x, 1), (levels, 1))
        share = np.pad(found.cosine, ((0, 0), (1, 1)), constant_values=1.0)
        good = here & (share > _SQUARE)
        fixed = np.full((levels, columns), np.nan)
        for level, ends in enumerate(family.stems.tolist()):
            where = np.flatnonzero(here[level])
            if not len(where):
                continue
            for end, beside, stem in ((where[0], -1, ends[0]), (where[-1], 1, ends[1])):
                if (stem - x[level, end]) * beside > _NEAR:
                    column = end + beside
                    fixed[level, column], x[level, column] = 0.0, stem
                    good[level, column], share[level, column] = True, share[level, end]
        runs = np.lib.stride_tricks.sliding_window_view(good, 5, 1).all(2)
        line, first = np.nonzero(runs)
        place = (line * columns + first)[:, None] + np.arange(5)
        at = x.ravel()[place]
        weight = share.ravel()[place[:, 2]] / (0.25 * (at[:, -1] - at[:, 0]))
        column = np.clip(place % columns - 1, 0, columns - 3)
        whole = cls(place, column, batten_coefficients(at) * weight[:, None], fixed)
        # A line that jumps, from a bulb to the hull above it, is none.
        kept = np.abs(whole.turned(found)) < _JUMP
        return cls(place[kept], column[kept], whole.coefficient[kept], fixed)

    def turned(self, found: _Found) -> FloatArray:
        """Give rho of each window, (w,) rad; nan where the line no longer is."""
        at = np.pad(found.at, ((0, 0), (1, 1)), constant_values=np.nan)
        at = np.where(np.isfinite(self.fixed), self.fixed, at)
        turned: FloatArray = (self.coefficient * at.ravel()[self.place]).sum(axis=1)
        return turned

    def rates(self, found: _Found, nodes: _Nodes) -> FloatArray:
        """Give how rho changes with the nodes, (w, n)."""
        rate = np.pad(found.rate, ((0, 0), (1, 1), (0, 0)))
        change = self.coefficient[:, :, None] * rate.reshape(-1, rate.shape[2])[self.place]
        total = np.zeros((len(self.place), len(nodes.start)))
        for use in range(rate.shape[2]):
            mine = np.flatnonzero(nodes.use == use)
            share = nodes.share[use][:, mine]
            for k in range(5):
                total[:, mine] += change[:, k, use, None] * share[self.column[:, k]]
        return total


_JUMP = 0.3
"""rad: what turns by more from section to section is not one line."""

_NEAR = 0.05
"""m: a contour nearer to a section is no place of its own."""


def _solved(family: _Family, nodes: _Nodes, rounds: int) -> FloatArray:
    """Give ordinates of nodes by damped Gauss-Newton steps."""
    values = nodes.within(nodes.start)
    found = family.found(nodes.share @ values)
    windows = _Windows.of(family, found)
    damping = _DAMPING
    for _ in range(rounds):
        rho = windows.turned(found)
        here = np.isfinite(rho)
        rho = np.where(here, rho, 0.0)
        stay = _STAY / nodes.usual
        now = _energy(rho, found, stay * (values - nodes.start))
        weight = here / (1.0 + (rho / _SHOULDER) ** 2)
        slope = windows.rates(found, nodes)
        plain = np.einsum("ku,ukn->kn", found.row_rate, nodes.share[:, found.row_x])
        matrix = slope.T @ (weight[:, None] * slope) + plain.T @ plain + np.diag(stay**2)
        gradient = slope.T @ (weight * rho) + plain.T @ found.row
        gradient += stay**2 * (values - nodes.start)
        close = found.gap < _CLOSE
        inward = np.einsum("ku,ukn->kn", found.gap_rate[close], nodes.share[:, found.gap_x[close]])
        better = None
        for _ in range(_TRIES):
            to = values
            for _ in range(_PREDICTIONS):
                # What the last step would take beyond the centre plane is to end on it.
                out = found.gap[close] + inward @ (to - values) < 0.0
                edge = _INSIDE * inward[out]
                beyond = edge.T @ (_INSIDE * found.gap[close][out])
                to = _step(nodes, values, matrix + edge.T @ edge, gradient + beyond, damping)
            trial = family.found(nodes.share @ to, rates=False)
            turned = windows.turned(trial)
            # A line that is lost counts as it was.
            turned = np.where(here & np.isfinite(turned), turned, rho)
            energy = _energy(turned, trial, stay * (to - nodes.start))
            if energy < now:
                better = to
                break
            damping = max(_FACTOR * damping, _DAMPING)
        if better is None:
            break
        values, damping = better, damping / _FACTOR
        if now - energy < _GAIN * float((weight * rho * rho).sum()):
            break
        found = family.found(nodes.share @ values)
    return values


_DAMPING, _TRIES, _PREDICTIONS = 1e-2, 5, 3
"""Of the first step; steps tried in a round; solutions of one for what it takes too far."""

_CLOSE = 1.0
"""m: what is farther inside is not looked at in a step."""


def _energy(rho: FloatArray, found: _Found, moved: FloatArray) -> float:
    bent = _SHOULDER**2 * np.log1p((rho / _SHOULDER) ** 2)
    out = _INSIDE * np.minimum(found.gap, 0.0)
    return float(bent.sum() + sum((each * each).sum() for each in (found.row, out, moved)))


def _step(
    nodes: _Nodes, values: FloatArray, matrix: FloatArray, gradient: FloatArray, damping: float
) -> FloatArray:
    """Give where a damped step leads; nodes that it would take beyond a limit stay there."""
    free = nodes.free.copy()
    to = values
    for _ in range(3):
        some = np.flatnonzero(free)
        part = matrix[np.ix_(some, some)]
        part = part + damping * np.diag(np.diag(part) + 1e-9)
        step = np.linalg.solve(part, -gradient[some])
        step = np.clip(step, -nodes.usual[some], nodes.usual[some])
        to = values.copy()
        to[some] += step
        kept = nodes.within(to)
        stuck = (kept != to) & (kept == values)
        to = kept
        if not stuck.any():
            break
        free &= ~stuck
    return to
