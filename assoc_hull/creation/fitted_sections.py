"""Sections fitted to a hull: the values of form-parameter pieces nearest to drawn sections.

Each section is laid out as the definitions of areas, waterline, contour, deck and flats have it
where it stands. Angles, curvatures and tangents of its pieces are then those for which points of
the drawn section lie nearest, with its area held; all sections of one layout are fitted at once, by
damped Gauss-Newton steps.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import attrs
import numpy as np

from assoc_hull.creation.fair_courses import GivenForms
from assoc_hull.creation.fitted_courses import distances
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.form_curves.curve import form_at
from assoc_hull.model.forms.form_values import Forms
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

__all__ = ["DrawnSection", "SectionFit", "evenly", "fit_sections"]


@attrs.frozen(eq=False)
class DrawnSection:
    """One curve of a section that was drawn.

    Attributes
    ----------
    name : str
        Of the station.
    x : float, m
        Where it stands.
    part : int
        Which curve, from below.
    layout : str
        Of which pieces it is to be made.
    at : (m, 2), m
        Points z, y from the contour upward, evenly along the curve.
    ends : (2, 3), m
        Where it starts on the contour, and ends on the deck edge or on the contour above.
    """

    name: str
    x: float
    part: int
    layout: str
    at: FloatArray
    ends: FloatArray


@attrs.frozen(eq=False)
class SectionFit:
    """The values of a section, by use, and how far (m) its points lie off."""

    section: DrawnSection
    values: Mapping[str, float]
    off: FloatArray


@attrs.frozen
class _Value:
    """How a value is varied: start, step for rates, a usual move, limits."""

    start: float
    step: float
    usual: float
    least: float
    most: float


_VALUES: Mapping[str, _Value] = {
    "keel_angle": _Value(45.0, 0.02, 15.0, 0.0, 90.0),
    "keel_curvature": _Value(0.0, 1e-4, 0.3, -8.0, 8.0),
    "keel_tangent": _Value(0.5, 1e-3, 0.4, 0.08, 2.0),
    "waterline_angle": _Value(5.0, 0.02, 8.0, -60.0, 85.0),
    "waterline_curvature": _Value(0.0, 1e-4, 0.1, -4.0, 4.0),
    "waterline_tangent": _Value(0.5, 1e-3, 0.4, 0.08, 2.0),
    "deck_angle": _Value(0.0, 0.02, 8.0, -75.0, 85.0),
    "deck_curvature": _Value(0.0, 1e-4, 0.1, -2.0, 2.0),
    "bulb_area": _Value(1.0, 1e-3, 1.0, 0.05, 1e3),
    "bulb_height": _Value(1.0, 1e-3, 0.5, 0.05, 1e3),
    "bulb_neck": _Value(1.0, 1e-3, 0.4, 0.0, 1e2),
    "bulb_neck_angle": _Value(0.0, 0.05, 20.0, -85.0, 85.0),
}

_PLACES = 48
"""Points of a drawn section that are looked at."""

_T = np.linspace(0.0, 4.0, 15)

_INNER = np.array([
    form_at(np.stack([np.eye(7), np.eye(7)], axis=-1), np.full(7, t))[:, 0]
    for t in np.linspace(0.1, 3.9, 20).tolist()
])  # fmt: skip
"""Shares of vertices in inner points of a piece, (20, 7)."""

_PRIOR = 1e-4
"""Of the breadth: what a usual move of a value costs."""

_INSIDE, _MARGIN = 5.0, 2e-3
"""Weight of each metre by which a piece is not so far (m) from the centre plane."""

_ROUNDS, _GAIN, _GOOD = 30, 1e-3, 2e-4
"""Most rounds; a smaller gain, of what is left, ends it; what lies off by less, of the breadth, in
the mean, is not tried again from another beginning."""


def _uses_of(layout: str) -> tuple[str, ...]:
    """Give what a section of a layout is shaped by, flats and contour left out."""
    lower, upper = parts_at_draught(layout)
    found = list[str]()
    if lower == ("round",):
        return ("bulb_area",)
    if lower and lower[0] == "bulb":
        found += ["bulb_area", "bulb_height", "bulb_neck", "bulb_neck_angle",
                  "waterline_angle", "waterline_curvature", "waterline_tangent"]  # fmt: skip
    elif "curve" in lower:
        found += [] if lower[0] == "level" else ["keel_angle"]
        found += ["keel_curvature", "keel_tangent"]
        found += [] if lower[-1] == "upright" else ["waterline_angle"]
        found += ["waterline_curvature", "waterline_tangent"]
    elif not lower:
        found += ["keel_angle", "keel_curvature", "keel_tangent"]
    if upper:
        found += ["deck_angle", "deck_curvature"]
    return tuple(found)


def evenly(points: FloatArray, count: int = _PLACES) -> FloatArray:
    """Give points evenly along a polyline."""
    step = np.hypot(*np.diff(points, axis=0).T)
    along = np.concatenate([[0.0], step.cumsum()])
    want = np.linspace(0.0, along[-1], count)
    return np.stack([np.interp(want, along, points[:, k]) for k in range(points.shape[1])], axis=1)


class _AnyEnds(SectionEnds):
    """Sections of which nothing is refused while they are sought."""

    def refuse(self, bad: object, what: str, remedy: str) -> None:
        """Let it pass."""

    def within(self, name: str, *args: object) -> None:
        """Let it pass."""


def fit_sections(forms: Forms, sections: Sequence[DrawnSection]) -> list[SectionFit]:
    """Fit drawn sections; `forms` has areas, waterline, contour, deck and flats."""
    found: dict[int, SectionFit] = {}
    groups: dict[str, list[int]] = {}
    for number, each in enumerate(sections):
        groups.setdefault(each.layout, []).append(number)
    for layout, numbers in groups.items():
        some = [sections[number] for number in numbers]
        found |= dict(zip(numbers, _Group.of(forms, layout, some).solved(), strict=True))
    return [found[number] for number in range(len(sections))]


@attrs.frozen(eq=False)
class _Group:
    """Sections of one layout."""

    forms: Forms
    layout: str
    sections: Sequence[DrawnSection]
    uses: tuple[str, ...]
    x: FloatArray
    ends: FloatArray
    at: FloatArray

    @classmethod
    def of(cls, forms: Forms, layout: str, sections: Sequence[DrawnSection]) -> _Group:
        return cls(
            forms, layout, sections, _uses_of(layout), np.array([each.x for each in sections]),
            np.array([each.ends for each in sections]), np.array([each.at for each in sections]),
        )  # fmt: skip

    def solved(self) -> list[SectionFit]:
        """Give the values with which each lies nearest, the better of two beginnings."""
        if not self.uses:
            off = self._off(np.zeros((len(self.x), 0)), np.arange(len(self.x)))[:, :_PLACES]
            return [SectionFit(s, {}, o) for s, o in zip(self.sections, off, strict=True)]
        first = self._first()
        every = np.arange(len(self.x))
        best, cost = self._descended(first, first, every)
        for use, value in (("keel_tangent", 1.0), ("waterline_tangent", 1.0)):
            bad = np.flatnonzero(cost > _PLACES * (_GOOD * self.forms.particulars.breadth) ** 2)
            if use not in self.uses or not len(bad):
                continue
            other = first.copy()
            other[:, self.uses.index(use)] = value
            values, now = self._descended(other[bad], first[bad], bad)
            better = now < cost[bad]
            best[bad] = np.where(better[:, None], values, best[bad])
            cost[bad] = np.minimum(now, cost[bad])
        off = self._off(best, every)[:, :_PLACES]
        return [
            SectionFit(section, dict(zip(self.uses, row, strict=True)), left)
            for section, row, left in zip(self.sections, best.tolist(), off, strict=True)
        ]

    def _first(self) -> FloatArray:
        """Read angles where they lie, and a bulb about its broadest place."""
        found = np.tile([_VALUES[use].start for use in self.uses], (len(self.x), 1))
        ship = self.forms.particulars
        for number, section in enumerate(self.sections):
            at = section.at
            way = np.degrees(np.arctan2(np.diff(at[:, 1]), np.diff(at[:, 0])))
            read = {"keel_angle": way[0], "deck_angle": way[-1]}
            water = int(np.clip(np.searchsorted(at[:, 0], ship.draught), 1, len(way)))
            read["waterline_angle"] = way[water - 1]
            if "bulb_area" in self.uses:
                read |= _bulb(at, ship.draught, self.layout == "round")
            for column, use in enumerate(self.uses):
                limits = _VALUES[use]
                if use in read:
                    found[number, column] = np.clip(read[use], limits.least, limits.most)
        return found

    def _descended(
        self, values: FloatArray, first: FloatArray, sections: IntArray
    ) -> tuple[FloatArray, FloatArray]:
        """Give values of sections after damped steps, (n, u), and the sums of squares, (n,)."""
        width = len(self.uses)
        least, most, steps, usual = (
            np.array([getattr(_VALUES[use], name) for use in self.uses])
            for name in ("least", "most", "step", "usual")
        )
        prior = _PRIOR * self.forms.particulars.breadth * np.sqrt(_PLACES) / usual

        def rows(p: FloatArray, owner: IntArray) -> FloatArray:
            off = self._off(p, sections[owner])
            return np.concatenate([off, prior * (p - first[owner])], axis=1)

        values = values.copy()
        now = rows(values, np.arange(len(values)))
        cost, damping = (now * now).sum(axis=1), np.full(len(values), 1e-2)
        active = np.arange(len(values))
        for _ in range(_ROUNDS):
            count = len(active)
            here, left = values[active], now[active]
            # One more row for each value, moved by its step.
            moved = here[:, None] + np.diag(steps)
            other = rows(moved.reshape(-1, width), np.repeat(active, width))
            slope = (other.reshape(count, width, -1) - left[:, None]) / steps[:, None]
            matrix = slope @ slope.transpose(0, 2, 1)
            size = damping[active, None] * np.einsum("nii->ni", matrix) + 1e-12
            matrix = matrix + size[:, :, None] * np.eye(width)
            step = -np.linalg.solve(matrix, slope @ left[:, :, None])[:, :, 0]
            to = np.clip(here + np.clip(step, -2.0 * usual, 2.0 * usual), least, most)
            trial = rows(to, active)
            then = (trial * trial).sum(axis=1)
            better = then < cost[active]
            done = better & (cost[active] - then <= _GAIN * then) | (damping[active] > 1e3)
            kept = active[better]
            values[kept], now[kept], cost[kept] = to[better], trial[better], then[better]
            damping[active] = np.clip(damping[active] * np.where(better, 0.2, 6.0), 1e-9, 1e6)
            active = active[~done]
            if not len(active):
                break
        return values, cost

    def _off(self, values: FloatArray, owner: IntArray) -> FloatArray:
        """Give how far points lie off, and how far pieces pass the centre plane."""
        given = {use: values[:, column] for column, use in enumerate(self.uses)}
        x, ends = self.x[owner], self.ends[owner]
        shape, curves = _shape(self.forms, self.layout, x, ends, given)
        every = np.arange(len(x))
        line = np.concatenate(
            [
                np.stack([piece.at(every, np.full(len(x), t)) for t in _T.tolist()], axis=1)
                for piece in shape.pieces
            ],
            axis=1,
        )
        off = distances(self.at[owner], line)
        past = [np.zeros((len(x), 1))]
        for piece in curves:
            inner = np.einsum("st,nt->ns", _INNER, piece.vertices[:, :, 1])
            room = np.minimum(_MARGIN, 0.05 * np.maximum(piece.finish[:, 1], piece.start[:, 1]))
            past.append(np.minimum(inner - room[:, None], 0.0))
        found = np.concatenate([off, _INSIDE * np.concatenate(past, axis=1)], axis=1)
        return np.where(np.isfinite(found), found, 10.0)


_FEWEST = 8
"""Fewer points below the draught tell nothing of a bulb."""


def _bulb(at: FloatArray, draught: float, closed: bool) -> dict[str, float]:
    """Read a bulb off a section, (m, 2) z and y: its area, and the neck where it is narrowest."""
    if closed:
        return {"bulb_area": 2.0 * abs(float(np.trapezoid(at[:, 1], at[:, 0])))}
    below = at[at[:, 0] <= draught]
    if len(below) < _FEWEST:
        return {}
    widest = int(below[: 2 * len(below) // 3, 1].argmax())
    narrow = widest + int(below[widest:, 1].argmin())
    if not widest + 1 < narrow < len(below) - 2:
        # Without a waist the neck is where the section draws in most.
        narrow = widest + int(np.diff(below[widest:, 1]).argmin())
        narrow = min(max(narrow, 3), len(below) - 2)
    upto = below[: narrow + 1]
    ahead = below[min(narrow + 1, len(below) - 1)] - below[narrow - 1]
    return {
        "bulb_area": 2.0 * float(np.trapezoid(upto[:, 1], upto[:, 0])),
        "bulb_height": float(below[narrow, 0]), "bulb_neck": float(below[narrow, 1]),
        "bulb_neck_angle": float(np.degrees(np.arctan2(ahead[1], ahead[0]))),
    }  # fmt: skip


def _shape(
    forms: Forms, layout: str, x: FloatArray, ends: FloatArray, given: Mapping[str, FloatArray]
) -> tuple[SectionShape, list[SectionCurves]]:
    """Make sections of one layout with values (n,) by use; nothing is refused."""
    read = GivenForms(forms.definitions, forms.particulars, given)
    stand = _AnyEnds.of(read, x, ends)
    lower, upper = parts_at_draught(layout)
    pieces = list[SectionPieces]()
    below = None
    if lower:
        make = bulb_pieces if lower[0] in ("bulb", "round") else underwater_pieces
        pieces, below = make(stand, lower)
    if upper:
        pieces = pieces + topside_pieces(stand, upper, below)
    return SectionShape(x, tuple(pieces)), [e for e in pieces if isinstance(e, SectionCurves)]
