"""A portion of a ship: sections at equal steps, of one of thirteen kinds, summed by Simpson's rule.

Main portions, 1 to 7, follow one another along the ship; the others are bodies of their own, as a
bulb or a forecastle. Each is integrated by itself, and a ship is the sum.
Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK.

Examples
--------
>>> from assoc_hull.creation.classical.sfolds_portion import Portion
>>> aft = Portion.of_areas(2, [0, 8, 16, 24, 32], [120, 160, 185, 190, 178])
>>> round(aft.volume, 6), round(aft.centre_x, 8)
(5514.666667, 16.91295938)
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import Self

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import all_of, shown
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import digits, finite_array
from assoc_hull.geometry.classical.ordinate_section import OrdinateSection, PairedParabolas
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["KINDS", "MAIN", "Portion", "require_portions_apart", "three_eighths_rule"]

KINDS = (
    "stern", "aft portion", "middle body (aft)", "middle body (fwd)", "fore body", "bow", "stem",
    "bulbous bow", "cruiser stern", "poop", "bridge", "forecastle", "bossing",
)  # fmt: skip
"""The thirteen kinds, from number 1 on; a rudder and other small bodies use the nearest."""

MAIN = range(1, 8)
"""Numbers of the portions of the main body."""

_EQUAL = 1e-6
"""Steps that differ by this part are equal."""


@attrs.frozen(eq=False)
class Portion:
    """Sections at equal steps.

    Attributes
    ----------
    number : int
        Of its kind, 1 to 13.
    stations : (m,), m
        x of its sections, forward; m odd, equal steps.
    areas : (m,), m2
        Of both sides.
    moments : (m,), m3
        Area times height of its centroid; nan where areas alone are given.
    sections : tuple of OrdinateSection
        The sections; empty where areas alone are given.
    """

    number: int
    stations: FloatArray
    areas: FloatArray
    moments: FloatArray
    sections: tuple[OrdinateSection, ...]

    def __attrs_post_init__(self) -> None:
        freeze(self.stations, self.areas, self.moments)

    @classmethod
    def make(cls, number: int, stations: ArrayLike, sections: Sequence[OrdinateSection]) -> Self:
        """Make a portion of sections.

        Parameters
        ----------
        number : int
            Of its kind.
        stations : (m,), m
            x, ascending.
        sections : sequence of m OrdinateSection
            One each.

        Raises
        ------
        GeometryError
            ``"portion {k}: number must be 1..13"``, ``"portion {k}: Simpson's first rule needs an
            odd number (>=3) of stations, got {m}"``, ``"portion {k}: stations not equally spaced
            at index {i} (step {d}, expected {s})"``.
        """
        sections = all_of(sections, OrdinateSection, "sections", "in a portion")
        x = _stations(number, stations, len(sections))
        areas = np.array([each.area for each in sections])
        moments = np.array([each.moment for each in sections])
        return cls(number, x, areas, moments, tuple(sections))

    @classmethod
    def of_areas(cls, number: int, stations: ArrayLike, areas: ArrayLike) -> Self:
        """Make a portion of which the section areas (m,), m2, alone are known; errors as `make`."""
        given = finite_array(areas, "section areas", (None,))
        x = _stations(number, stations, len(given))
        return cls(number, x, given, np.full(len(x), np.nan), ())

    @property
    def kind(self) -> str:
        """What it is, one of `KINDS`."""
        return KINDS[self.number - 1]

    @property
    def is_main(self) -> bool:
        """Whether it belongs to the main body."""
        return self.number in MAIN

    @property
    def curve(self) -> PairedParabolas:
        """The curve of section areas, m2 over x in m."""
        return self._over(self.areas)

    def _over(self, values: FloatArray) -> PairedParabolas:
        step = float(self.stations[-1] - self.stations[0]) / (len(self.stations) - 1)
        name = f"portion {self.number}"
        return PairedParabolas.make(name, float(self.stations[0]), step, values)

    @property
    def volume(self) -> float:
        """By Simpson's first rule, m3."""
        return self.curve.simpson()

    @property
    def moment_x(self) -> float:
        """First moment about x = 0, m4, by Simpson's rule of x A."""
        return self._over(self.stations * self.areas).simpson()

    @property
    def moment_z(self) -> float:
        """First moment about the base line, m4; nan where areas alone are given."""
        return self._over(self.moments).simpson() if self.sections else float("nan")

    @property
    def centre_x(self) -> float:
        """Of the volume, m; nan where that is 0."""
        return self.moment_x / self.volume if self.volume else float("nan")

    @property
    def centre_z(self) -> float:
        """Of the volume, m above base; nan where that is 0, or areas alone are given."""
        return self.moment_z / self.volume if self.volume else float("nan")

    def area(self, x: ArrayLike) -> FloatArray:
        """Give section areas at places within, m2, of the shape of `x`.

        Raises
        ------
        GeometryError
            A place outside.
        """
        return self.curve.at(x)

    def volume_below(self, z: float) -> float:
        """Give the volume below a height, m3, by Simpson's rule of the areas below it.

        A section counts to its deck side where that is lower: camber is left out.

        Raises
        ------
        GeometryError
            Areas alone are given.
        """
        return self._over(self._areas_below(z)).simpson()

    def moment_x_below(self, z: float) -> float:
        """Give the first moment about x = 0 of what `volume_below` counts, m4."""
        return self._over(self.stations * self._areas_below(z)).simpson()

    def _areas_below(self, z: float) -> FloatArray:
        if not self.sections:
            what = f"portion {self.number}: no sections, only areas"
            raise GeometryError(what, "make it of sections", {"number": self.number})
        level = float(finite_array(z, f"portion {self.number}", ()))
        return np.array([each.area_below(min(level, each.hd)) for each in self.sections])


def _stations(number: object, stations: ArrayLike, count: int) -> FloatArray:
    """Take the number of a portion and its stations, or refuse them."""
    if isinstance(number, bool) or not isinstance(number, int) or not 1 <= number <= len(KINDS):
        what = f"portion {shown(number)}: number must be 1..{len(KINDS)}"
        raise GeometryError(what, "give that of its kind", {"number": number})
    name = f"portion {number}"
    x = finite_array(stations, name, (None,))
    if len(x) != count:
        what = f"{name}: {len(x)} stations and {count} sections"
        raise GeometryError(what, "give one each", {"stations": len(x), "sections": count})
    if len(x) < 3 or len(x) % 2 == 0:
        raise GeometryError(
            f"{name}: Simpson's first rule needs an odd number (>=3) of stations, got {len(x)}",
            "add a station or leave one out", {"count": len(x)},
        )  # fmt: skip
    step = np.diff(x)
    expected = float(step[0])
    if expected <= 0.0:
        what = f"{name}: stations not ascending at index 0 (step {digits(expected)})"
        raise GeometryError(what, "give them from aft forward", {"step": expected})
    uneven = np.flatnonzero(np.abs(step - expected) > _EQUAL * expected)
    if len(uneven):
        index = int(uneven[0])
        raise GeometryError(
            f"{name}: stations not equally spaced at index {index} (step {digits(step[index])}, "
            f"expected {digits(expected)})",
            "space them equally, or give a portion each",
            {"index": index, "step": float(step[index]), "expected": expected},
        )  # fmt: skip
    return x


def require_portions_apart(portions: Sequence[Portion]) -> tuple[str, ...]:
    """Refuse portions of the main body that overlap, and report the gaps, a sentence for each.

    Portions may come in any order; those beyond the main body are not looked at.

    Examples
    --------
    >>> from assoc_hull.creation.classical.sfolds_portion import Portion, require_portions_apart
    >>> one, two = (Portion.of_areas(k, [k, k + 1, k + 2], [1, 1, 1]) for k in (2, 5))
    >>> require_portions_apart([one, two])
    ('portions 2 and 5 of the main body leave a gap in x: [4,5]',)
    """
    given = all_of(portions, Portion, "portions", "of a main body")
    main = sorted((each for each in given if each.is_main), key=lambda each: each.stations[0])
    notes = []
    for one, two in itertools.pairwise(main):
        end, begin = float(one.stations[-1]), float(two.stations[0])
        near = _EQUAL * float(one.stations[1] - one.stations[0])
        text = f"portions {one.number} and {two.number} of the main body"
        told = {"portions": (one.number, two.number), "from": begin, "to": end}
        if begin < end - near:
            most = min(end, float(two.stations[-1]))
            what = f"{text} overlap in x: [{digits(begin)},{digits(most)}]"
            raise GeometryError(what, "let one end where the other begins", told | {"to": most})
        if begin > end + near:
            notes.append(f"{text} leave a gap in x: [{digits(end)},{digits(begin)}]")
    return tuple(notes)


def three_eighths_rule(values: ArrayLike, step: float) -> float:
    """Integrate four values at equal steps (m) by Simpson's second rule, 3 s (f0+3f1+3f2+f3) / 8.

    Examples
    --------
    >>> from assoc_hull.creation.classical.sfolds_portion import three_eighths_rule
    >>> three_eighths_rule([1, 4, 9, 16], 1.0)
    21.0
    """
    given = finite_array(values, "3/8 rule", (4,))
    spacing = float(finite_array(step, "3/8 rule", ()))
    return float(0.375 * spacing * (np.array([1.0, 3.0, 3.0, 1.0]) @ given))
