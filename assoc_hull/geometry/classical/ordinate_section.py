"""A section given by ordinates: heights on buttocks below, half-breadths on waterlines above.

Both parts of an `OrdinateSection` are `PairedParabolas`, the curve that Simpson's first rule
integrates, so that its areas are Simpson's values. A straight line joins the parts, a parabola is
the camber. The curve bends at every second ordinate; it is not fair. Heights in m from the base
line, half-breadths of one side. Source: Kim & Chang, "Some Representations of Ship Hulls by
Mathematical Method for Design and Production", J. SNAK.
"""

from __future__ import annotations

import math
from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import shown, shown_name
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import digits, finite_array, within_range
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = [
    "FORMS",
    "OrdinateSection",
    "OrdinateSizes",
    "PairedParabolas",
    "area_below",
    "check_section",
    "outline_steps",
    "read_sizes",
    "section_notes",
]

# --------------------------------------------------------------------------------------
# Parabolas on pairs of steps.
#
# On the nodes 2j, 2j + 1, 2j + 2 and with t from 0 to 2 the curve is
# f0 (t - 1)(t - 2) / 2 - f1 t (t - 2) + f2 t (t - 1) / 2; it bends at nodes of even number, where
# two parabolas meet. Its exact integral is Simpson's value; over a first step s alone it is
# s (5 f0 + 8 f1 - f2) / 12. A last step without a partner takes the parabola of the last three.

_PLACES, _WEIGHTS = (0.5 * part for part in np.polynomial.legendre.leggauss(3))
"""Three places over a step are exact to the fifth degree: squares of parabolas, times x."""

_SLACK = 1e-9
"""A place so far beyond an end, in steps, is the end by rounding."""


@attrs.frozen(eq=False)
class PairedParabolas:
    """A curve over equally spaced places, by parabolas on pairs of steps.

    Attributes
    ----------
    name : str
        For messages.
    first, step : float, m
        The first place and the spacing.
    values : (n,)
        At the places, n >= 3.
    """

    name: str
    first: float
    step: float
    values: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.values)

    @classmethod
    def make(cls, name: str, first: float, step: float, values: ArrayLike) -> Self:
        """Check the arguments, which are as the attributes.

        Raises
        ------
        GeometryError
            Numbers that are not finite, a spacing that is not above 0, fewer than three values.
        """
        found = finite_array(values, name, (None,))
        start, spacing = (float(finite_array(each, name, ())) for each in (first, step))
        if spacing <= 0.0:
            what = f"{name}: spacing {digits(spacing)} is not above 0"
            raise GeometryError(what, "give a spacing above 0", {"step": spacing})
        if len(found) < 3:
            what = f"{name}: at least 3 values, got {len(found)}"
            raise GeometryError(what, "a parabola needs three", {"count": len(found)})
        return cls(name, start, spacing, found)

    @property
    def places(self) -> FloatArray:
        """Where the values stand, (n,), m."""
        found: FloatArray = self.first + self.step * np.arange(len(self.values), dtype=np.float64)
        return found

    @property
    def last(self) -> float:
        """The last place, m."""
        return float(self.places[-1])

    def coefficients(self) -> FloatArray:
        """Give c0, c1, c2 of each step: f = c0 + c1 u + c2 u^2, u from 0 to 1; (n - 1, 3)."""
        step = np.arange(len(self.values) - 1)
        begin = np.minimum(step - step % 2, len(self.values) - 3)
        f0, f1, f2 = (self.values[begin + k] for k in range(3))
        bend = 0.5 * (f0 - 2.0 * f1 + f2)
        slope = f1 - f0 + bend * (2.0 * (step - begin) - 1.0)
        return np.stack([self.values[:-1], slope, bend], axis=1)

    def at(self, x: ArrayLike) -> FloatArray:
        """Give values at places, of the shape of `x`.

        Raises
        ------
        GeometryError
            A place outside; nothing is extrapolated.
        """
        place = within_range(x, self.name, self.first, self.last, _SLACK * self.step)
        u = (place - self.first) / self.step
        step = np.clip(np.floor(u).astype(np.int64), 0, len(self.values) - 2)
        c0, c1, c2 = np.moveaxis(self.coefficients()[step], -1, 0)
        u = u - step
        return np.asarray(c0 + u * (c1 + u * c2))

    def slopes(self) -> FloatArray:
        """Give the slope before and after each place, (n, 2); they differ at corners.

        Before the first and after the last place they are those of the one side there is.
        """
        _, c1, c2 = self.coefficients().T
        after, before = c1 / self.step, (c1 + 2.0 * c2) / self.step
        return np.stack(
            [np.concatenate([after[:1], before]), np.concatenate([after, before[-1:]])], axis=1
        )

    def quadrature(
        self, first: float | None = None, last: float | None = None
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Give places, values there and weights that integrate polynomials of degree 5 exactly.

        Parameters
        ----------
        first, last : float or None, m
            Limits within the curve; its ends if None.

        Raises
        ------
        GeometryError
            A limit outside.
        """
        least = self.first if first is None else first
        most = self.last if last is None else last
        limits = within_range([least, most], self.name, self.first, self.last, _SLACK * self.step)
        nodes = np.clip(self.places, *limits)
        size = np.diff(nodes)
        used = np.flatnonzero(size > 0.0)
        x = 0.5 * (nodes[used] + nodes[used + 1])[:, None] + size[used, None] * _PLACES
        u = (x - self.places[used, None]) / self.step
        c0, c1, c2 = self.coefficients()[used].T[:, :, None]
        weight = size[used, None] * _WEIGHTS
        return x.ravel(), (c0 + u * (c1 + u * c2)).ravel(), weight.ravel()

    def integral(self, first: float | None = None, last: float | None = None) -> float:
        """Integrate the curve between two places, its ends if None; exact."""
        _, value, weight = self.quadrature(first, last)
        return float(weight @ value)

    def moment(self, first: float | None = None, last: float | None = None) -> float:
        """Integrate place times value between two places, its ends if None; exact."""
        x, value, weight = self.quadrature(first, last)
        return float(weight @ (x * value))

    def simpson(self) -> float:
        """Integrate by Simpson's first rule, which is the same number for an odd count.

        Raises
        ------
        GeometryError
            An even number of values.

        Examples
        --------
        >>> from assoc_hull.geometry.classical.ordinate_section import PairedParabolas
        >>> PairedParabolas.make("areas", 0.0, 1.0, [1, 4, 9]).simpson()
        8.666666666666666
        """
        if len(self.values) % 2 == 0:
            what = f"{self.name}: Simpson's first rule needs an odd number, got {len(self.values)}"
            raise GeometryError(what, "leave one out", {"count": len(self.values)})
        weights = np.full(len(self.values), 2.0)
        weights[1::2], weights[[0, -1]] = 4.0, 1.0
        return float(self.step / 3.0 * (weights @ self.values))


# --------------------------------------------------------------------------------------
# Areas and curve of a section, from its two parts.


def area_below(
    bottom: PairedParabolas | None, side: PairedParabolas, level: float, hb: float
) -> float:
    """Give the area (m2) of one side below the height `level` (m), in closed form.

    `bottom` is height over y and ends at the height `hb`; `side` is half-breadth over z, and
    `level` is not beyond its last waterline.
    """
    above = side.integral(None, level) if level > side.first else 0.0
    if bottom is None:
        return above
    wet = min(level, hb)
    under = _area_under(bottom, wet)
    foot, wide = float(bottom.values[-1]), float(side.values[0]) - bottom.last
    # The triangle under the straight line that joins bottom and side.
    if wet > foot and hb > foot:
        under += 0.5 * (wet - foot) ** 2 / (hb - foot) * wide
    return under + above


def _area_under(curve: PairedParabolas, level: float) -> float:
    """Integrate what lies between a curve and a height above it, where it does."""
    edges = np.unique(np.concatenate([curve.places, _level_intersections(curve, level)]))
    middle = 0.5 * (edges[:-1] + edges[1:])
    wet = curve.at(middle) < level
    if not wet.any():
        return 0.0
    parts = [
        level * (last - first) - curve.integral(first, last)
        for first, last in zip(edges[:-1][wet].tolist(), edges[1:][wet].tolist(), strict=True)
    ]
    return float(sum(parts))


def _level_intersections(curve: PairedParabolas, level: float) -> FloatArray:
    """Give the places where a curve has a height, each step by its quadratic."""
    c0, c1, c2 = curve.coefficients().T
    c0 = c0 - level
    with np.errstate(divide="ignore", invalid="ignore"):
        root = np.sqrt(c1 * c1 - 4.0 * c2 * c0)
        # The form that keeps its digits: one root by the sum, the other by the product.
        sum_ = -0.5 * (c1 + np.where(c1 < 0.0, -root, root))
        u = np.stack([sum_ / c2, c0 / sum_])
    there = np.isfinite(u) & (u > 0.0) & (u < 1.0)
    found: FloatArray = (curve.places[:-1] + curve.step * u)[there]
    return found


_NOTHING = 1e-9
"""A step shorter than this, m, is none."""


def outline_steps(
    bottom: PairedParabolas | None, side: PairedParabolas, deck: float, keel: float
) -> FloatArray:
    """Give the steps from one given point to the next, up to the height `deck` (m).

    (k, 3, 2): coefficients of (y, z) in m, p(u) = c0 + c1 u + c2 u^2 with u from 0 to 1. Without a
    bottom the curve begins on the centre line at the height `keel`.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.ordinate_section import outline_steps
    >>> from assoc_hull.geometry.classical.ordinate_section import PairedParabolas
    >>> side = PairedParabolas.make("side", 0.0, 2.0, [3, 4, 5])
    >>> outline_steps(None, side, 3.0, 0.0)[:, 0].tolist()
    [[0.0, 0.0], [3.0, 0.0], [4.0, 2.0]]
    """
    parts = [_side_steps(side, deck)]
    foot = np.array([0.0, keel])
    if bottom is not None:
        rising = bottom.coefficients()
        across = np.zeros_like(rising)
        across[:, 0], across[:, 1] = bottom.places[:-1], bottom.step
        parts.insert(0, np.stack([across, rising], axis=2))
        foot = np.array([bottom.last, bottom.values[-1]])
    close = parts[-1][0, 0] - foot
    if np.hypot(*close) > _NOTHING:
        parts.insert(-1, np.stack([foot, close, np.zeros(2)])[None])
    return np.concatenate(parts)


def _side_steps(side: PairedParabolas, deck: float) -> FloatArray:
    """Cut the steps of the side off at the deck."""
    begin = side.places[:-1]
    used = begin < deck - _NOTHING
    part = np.minimum((deck - begin[used]) / side.step, 1.0)
    breadth = side.coefficients()[used] * part[:, None] ** np.arange(3)
    upward = np.zeros_like(breadth)
    upward[:, 0], upward[:, 1] = begin[used], side.step * part
    return np.stack([breadth, upward], axis=2)


# --------------------------------------------------------------------------------------
# What is refused of a section, and what is only remarked.

FORMS = ("bottom+main+camber", "main+camber", "bottom+camber")
"""The general form; without a part on buttocks; without a main part."""

_LEAST_BUTTOCKS, _LEAST_WATERLINES = 4, 3

_MOST = 10_000
"""More ordinates than this are a mistake."""

_STEP = 0.15
"""The last buttock may end below the first waterline by this part of its height, unremarked."""

_DECK = 1e-3
"""The half-breadth of the deck may differ from that of the side by this part, unremarked."""


@attrs.frozen
class OrdinateSizes:
    """Six of the eight values, m; the other two are counts."""

    hb: float
    sb: float
    sw: float
    hd: float
    bd: float
    cam: float


def read_sizes(*values: float) -> OrdinateSizes:
    """Take hb, sb, sw, hd, bd, cam (m): finite, spacings above 0, no negative breadth.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.ordinate_section import read_sizes
    >>> read_sizes(0.9, 3, 2, 12.4, 15.2, 0.4).hd
    12.4
    """
    names = attrs.fields_dict(OrdinateSizes)
    found = OrdinateSizes(
        *(
            float(finite_array(each, f"section {n}", ()))
            for n, each in zip(names, values, strict=True)
        )
    )
    for name, told in (("sb", "buttock spacing"), ("sw", "waterline spacing")):
        value = getattr(found, name)
        if value <= 0.0:
            _refuse(f"section: {told} {digits(value)} is not above 0", "give one above 0", sb=value)
    if found.bd < 0.0:
        what = f"section: negative deck half-breadth {digits(found.bd)}"
        _refuse(what, "give it to port", bd=found.bd)
    return found


def check_section(
    sizes: OrdinateSizes,
    zb: FloatArray,
    yw: FloatArray,
    counts: tuple[object, object],
    form: str | None,
) -> str:
    """Refuse what makes no section, and give its form.

    `zb` (nb + 1,) and `yw` (nw,) in m; `counts` are nb and nw as they were given. The form follows
    from them where it is None.
    """
    nb, nw = _counts(zb, yw, *counts)
    shape = _form(sizes, nb) if form is None else shown_name(form)
    if shape not in FORMS:
        what = f"section: no form {shown(form)}"
        raise GeometryError(what, f"use one of {', '.join(FORMS)}", {"form": form})
    if shape == FORMS[0] and nb < _LEAST_BUTTOCKS:
        what = f"section: bottom part needs at least {_LEAST_BUTTOCKS} buttocks, got {nb}"
        _refuse(what, "give more, or the form main+camber", nb=nb)
    if shape != FORMS[0] and nb:
        what = f"section: {nb} buttocks in the form {shape}"
        _refuse(what, "give half-breadths from the keel up", nb=nb)
    if nw < _LEAST_WATERLINES:
        what = f"section: main part needs at least {_LEAST_WATERLINES} waterlines, got {nw}"
        _refuse(what, "give more", nw=nw)
    _heights(sizes, zb, nw, shape)
    below = np.flatnonzero(yw < 0.0)
    if len(below):
        what = f"section: negative half-breadth at waterline {below[0]}"
        _refuse(what, "give 0 at the centre line", waterline=int(below[0]))
    return shape


def _form(sizes: OrdinateSizes, nb: int) -> str:
    """Give the form of a section by what is given of it."""
    if nb:
        return FORMS[0]
    return FORMS[1] if sizes.hb < sizes.hd else FORMS[2]


def _counts(zb: FloatArray, yw: FloatArray, nb: object, nw: object) -> tuple[int, int]:
    buttocks, waterlines = _whole(nb, "buttocks"), _whole(nw, "waterlines")
    if buttocks or len(zb):
        finite_array(zb, "section heights", (buttocks + 1,))
    finite_array(yw, "section half-breadths", (waterlines,))
    return buttocks, waterlines


def _whole(value: object, name: str) -> int:
    if (
        isinstance(value, bool)
        or not isinstance(value, int | np.integer)
        or not 0 <= value <= _MOST
    ):
        what = f"section: {shown(value)} {name}"
        raise GeometryError(what, f"give a whole number from 0 to {_MOST}", {name: value})
    return int(value)


def _heights(sizes: OrdinateSizes, zb: FloatArray, nw: int, form: str) -> None:
    """Refuse parts that do not follow upon one another from below."""
    foot = sizes.hb
    if form == FORMS[2]:
        if sizes.hb < sizes.hd:
            _refuse(
                f"section: without main part the bottom appendage height {digits(sizes.hb)} must "
                f"exceed the deck side height {digits(sizes.hd)}",
                "raise it, or give a main part", hb=sizes.hb, hd=sizes.hd,
            )  # fmt: skip
        foot = float(zb[0]) if len(zb) else math.nan
        if math.isnan(foot):
            _refuse("section: without main part the height of the keel is missing", "give zb")
    if sizes.hd <= foot:
        what = f"section: deck side {digits(sizes.hd)} is not above {digits(foot)}"
        _refuse(what, "raise it, or lower the first waterline", hd=sizes.hd, foot=foot)
    top = foot + (nw - 1) * sizes.sw
    if top <= sizes.hd:
        _refuse(
            f"section: last waterline z={digits(top)} must be above the deck side "
            f"{digits(sizes.hd)}", "add a waterline", z=top, hd=sizes.hd,
        )  # fmt: skip
    if form == FORMS[0] and zb[-1] > sizes.hb:
        what = f"section: last buttock height {digits(zb[-1])} above hb {digits(sizes.hb)}"
        _refuse(what, "lower it, or raise hb", z=float(zb[-1]), hb=sizes.hb)
    if form == FORMS[1] and len(zb) and zb[0] != sizes.hb:
        what = f"section: keel at {digits(zb[0])}, but the main part begins at {digits(sizes.hb)}"
        _refuse(what, "let both be the same", z=float(zb[0]), hb=sizes.hb)


def section_notes(
    sizes: OrdinateSizes, bottom: PairedParabolas | None, side: PairedParabolas
) -> tuple[str, ...]:
    """Say what is unusual about a section, a sentence each."""
    found = [] if bottom is None else _bottom_notes(sizes, bottom)
    if bottom is not None and side.values[0] < bottom.last - 1e-9 * sizes.sb:
        found.append(
            f"section: the first waterline ends at y={digits(side.values[0])}, inside the last "
            f"buttock at {digits(bottom.last)}"
        )
    if sizes.cam < 0.0:
        found.append(f"section: camber {digits(sizes.cam)} is negative: the deck falls inboard")
    wide = float(side.at(sizes.hd))
    if abs(wide - sizes.bd) > _DECK * sizes.bd:
        found.append(
            f"section: y(hd)={digits(wide)} at the deck side differs from bd={digits(sizes.bd)} "
            f"by more than {_DECK:g} bd"
        )
    return tuple(found)


def _bottom_notes(sizes: OrdinateSizes, bottom: PairedParabolas) -> list[str]:
    found = []
    last = float(bottom.values[-1])
    if abs(last - sizes.hb) > _STEP * abs(sizes.hb):
        found.append(
            f"section: last buttock height {digits(last)} differs from hb {digits(sizes.hb)} by "
            f"more than {_STEP:g} hb"
        )
    falls = np.flatnonzero(np.diff(bottom.values) < 0.0)
    if len(falls):
        found.append(f"section: buttock heights decrease at buttock {falls[0] + 1}")
    return found


def _refuse(what: str, remedy: str, **values: object) -> None:
    raise GeometryError(what, remedy, values)


# --------------------------------------------------------------------------------------
# The section itself.


@attrs.frozen(eq=False)
class OrdinateSection:
    """A section: eight values, heights on buttocks, half-breadths on waterlines.

    Attributes
    ----------
    hb : float, m
        Height of the bottom part: of the lowest waterline of the main part.
    sb, sw : float, m
        Spacing of buttocks and of waterlines.
    hd, bd : float, m
        Height and half-breadth of the deck side.
    cam : float, m
        Camber, from the deck side up to the centre line.
    nb, nw : int
        How many buttocks off the centre line, and waterlines.
    form : str
        One of `FORMS`.
    bottom : PairedParabolas or None
        Height over y from 0 to nb sb; None where there is no part on buttocks.
    side : PairedParabolas
        Half-breadth over z from the lowest waterline up, beyond the deck side.
    keel : float, m
        Height of the lowest place on the centre line.
    notes : tuple of str
        What is unusual, a sentence each.
    """

    hb: float
    sb: float
    sw: float
    hd: float
    bd: float
    cam: float
    nb: int
    nw: int
    form: str
    bottom: PairedParabolas | None
    side: PairedParabolas
    keel: float
    notes: tuple[str, ...]

    @classmethod
    def make(
        cls,
        *,
        hb: float,
        sb: float,
        sw: float,
        hd: float,
        bd: float,
        cam: float,
        zb: ArrayLike,
        yw: ArrayLike,
        nb: int | None = None,
        nw: int | None = None,
        form: str | None = None,
    ) -> Self:
        """Check what is given, and make the section.

        Parameters
        ----------
        hb, sb, sw, hd, bd, cam : float, m
            As the attributes; heights from the base line.
        zb : (nb + 1,), m
            Heights at y = 0, sb ... nb sb. Without buttocks the height of the keel alone, or
            nothing, where the main part begins at the keel.
        yw : (nw,), m
            Half-breadths at z = hb + k sw; without main part at z = zb[0] + k sw.
        nb, nw : int or None
            Counts; as many as are given if None.
        form : str or None
            One of `FORMS`. If None: with buttocks the first, else without a main part if
            hb >= hd.

        Raises
        ------
        GeometryError
            Numbers of which no section can be made.
        """
        sizes = read_sizes(hb, sb, sw, hd, bd, cam)
        heights, breadths = (
            finite_array(zb, "section", (None,)),
            finite_array(yw, "section", (None,)),
        )
        buttocks = max(len(heights) - 1, 0) if nb is None else nb
        waterlines = len(breadths) if nw is None else nw
        shape = check_section(sizes, heights, breadths, (buttocks, waterlines), form)
        if not len(heights):
            heights = np.array([sizes.hb])
        bottom = None
        if buttocks:
            bottom = PairedParabolas.make("section bottom", 0.0, sizes.sb, heights)
        foot = float(heights[0]) if shape == FORMS[2] else sizes.hb
        side = PairedParabolas.make("section side", foot, sizes.sw, breadths)
        notes = section_notes(sizes, bottom, side)
        return cls(
            sizes.hb, sizes.sb, sizes.sw, sizes.hd, sizes.bd, sizes.cam, buttocks, waterlines,
            shape, bottom, side, float(heights[0]), notes,
        )  # fmt: skip

    @property
    def bottom_area(self) -> float:
        """Area of one side below hb, up to the closing line; 0 without buttocks; m2."""
        if self.bottom is None:
            return 0.0
        edge, close = self.bottom.last, self.hb - float(self.bottom.values[-1])
        under = self.hb * edge - self.bottom.integral()
        return under + 0.5 * close * (float(self.side.values[0]) - edge)

    @property
    def main_area(self) -> float:
        """Area of one side from the lowest waterline to the deck side, m2."""
        return self.side.integral(None, self.hd)

    @property
    def camber_area(self) -> float:
        """Area of one side above the deck side, m2."""
        return 2.0 * self.cam * self.bd / 3.0

    @property
    def area(self) -> float:
        """Of both sides, camber included, m2."""
        return 2.0 * (self.bottom_area + self.main_area + self.camber_area)

    @property
    def moment(self) -> float:
        """Area of both sides times the height of its centroid, m3."""
        camber = self.camber_area * self.hd + 4.0 * self.cam**2 * self.bd / 15.0
        return 2.0 * (self._bottom_moment() + self.side.moment(None, self.hd) + camber)

    def _bottom_moment(self) -> float:
        """Give the first moment of one side below hb about the base line, m3."""
        if self.bottom is None:
            return 0.0
        _, z, weight = self.bottom.quadrature()
        foot, wide = float(self.bottom.values[-1]), float(self.side.values[0]) - self.bottom.last
        close = 0.5 * wide * (self.hb - foot) * (2.0 * self.hb + foot) / 3.0
        return 0.5 * float(weight @ (self.hb**2 - z * z)) + close

    @property
    def deck_breadth(self) -> float:
        """Half-breadth of the main part at the deck side, m; `bd` is what was given for it."""
        return float(self.side.at(self.hd))

    def half_breadth(self, z: ArrayLike) -> FloatArray:
        """Give y of the main part at heights from its lowest waterline to the last, m.

        Raises
        ------
        GeometryError
            A height outside.
        """
        return self.side.at(z)

    def height(self, y: ArrayLike) -> FloatArray:
        """Give z of the bottom part at places from 0 to nb sb, m.

        Raises
        ------
        GeometryError
            A place outside, or no bottom part on buttocks.
        """
        if self.bottom is None:
            what = f"section: no buttocks are given in the form {self.form}"
            raise GeometryError(what, "ask for its half-breadths", {"form": self.form})
        return self.bottom.at(y)

    def camber(self, y: ArrayLike) -> FloatArray:
        """Give z of the deck at half-breadths within `bd`, m: a parabola.

        Raises
        ------
        GeometryError
            ``"camber: |y|={y} exceeds half-breadth {b}"``.
        """
        across = np.abs(finite_array(y, "camber", None))
        if (across > self.bd * (1.0 + 1e-12)).any():
            worst = float(across.max())
            what = f"camber: |y|={digits(worst)} exceeds half-breadth {digits(self.bd)}"
            raise GeometryError(what, "ask within the deck", {"y": worst, "b": self.bd})
        part = across / self.bd if self.bd else across
        return np.asarray(self.hd + self.cam * (1.0 - part * part))

    def area_below(self, z: float) -> float:
        """Give the area of both sides below a height up to the deck side, m2; exact.

        Raises
        ------
        GeometryError
            A height above the deck side.
        """
        level = float(finite_array(z, "section", ()))
        if level > self.hd:
            what = f"section: z={digits(level)} above the deck side {digits(self.hd)}"
            raise GeometryError(what, "ask below the deck", {"z": level, "hd": self.hd})
        return 2.0 * area_below(self.bottom, self.side, level, self.hb)

    def steps(self) -> FloatArray:
        """Give the curve from one given point to the next; see `outline_steps`."""
        return outline_steps(self.bottom, self.side, self.hd, self.keel)

    def outline(self) -> FloatArray:
        """Give the given points from the centre line up to the deck side, (n, 2) as y, z in m.

        The last is where the main part meets the deck side, not the half-breadth `bd`.
        """
        steps = self.steps()
        return np.concatenate([steps[:, 0], steps[-1].sum(axis=0)[None]])
