"""A ship of portions, each a row of sections given by ordinates.

Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK.

Examples
--------
>>> from assoc_hull.creation.classical.sfolds import Sfolds
>>> from assoc_hull.geometry.classical.ordinate_section import OrdinateSection
>>> from assoc_hull.creation.classical.sfolds_portion import Portion
>>> from assoc_hull.model.state import Particulars
>>> section = OrdinateSection.make(
...     hb=0.9, sb=3, sw=2, hd=12.4, bd=15.2, cam=0.4, zb=[0, 0.02, 0.10, 0.31, 0.80],
...     yw=[12.3, 14.2, 14.8, 15, 15.1, 15.2, 15.2],
... )
>>> middle = Portion.make(3, [0, 8, 16, 24, 32], [section] * 5)
>>> ship = Sfolds.make(Particulars("Body", 32, 30.4, 12.4, 9), [middle])
>>> round(ship.volume, 4)
11618.9267
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Self

import attrs
import numpy as np

from assoc_hull.arguments import all_of, instance, not_negative, shown
from assoc_hull.creation.classical.report import ClassicalReport
from assoc_hull.creation.classical.sfolds_cuts import default_cuts
from assoc_hull.creation.classical.sfolds_lines import lines_of_portions
from assoc_hull.creation.classical.sfolds_notes import notes_of
from assoc_hull.creation.classical.sfolds_portion import Portion, require_apart
from assoc_hull.creation.classical.sfolds_report import report_of
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checks import finite
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.state import HullState, Particulars

__all__ = ["CORNER", "Sfolds"]

CORNER = 10.0
"""Degrees; sections of the net keep corners of the definition that are sharper."""


@attrs.frozen(eq=False)
class Sfolds:
    """A ship of portions.

    Attributes
    ----------
    particulars : Particulars
        Name and principal dimensions; x is counted from AP.
    portions : tuple of Portion
        As given.
    corner : float, degrees
        Sections of the net keep corners that are sharper; at 0 all of them.
    cuts : mapping of str to tuple of float, m
        Heights of waterlines, half-breadths of buttocks that the net is cut by.
    notes : tuple of str
        Gaps, what is odd about a section, what the net leaves out.
    """

    particulars: Particulars
    portions: tuple[Portion, ...]
    corner: float
    cuts: Mapping[str, tuple[float, ...]]
    notes: tuple[str, ...]

    @classmethod
    def make(
        cls,
        particulars: Particulars,
        portions: Sequence[Portion],
        *,
        corner: float = CORNER,
        cuts: Mapping[str, Sequence[float]] | None = None,
        notes: Sequence[str] = (),
    ) -> Self:
        """Put portions together.

        Parameters
        ----------
        particulars : Particulars
            Name and principal dimensions.
        portions : sequence of Portion
            In any order.
        corner : float, degrees
            As the attribute.
        cuts : mapping of str to sequence of float or None
            ``"waterlines"`` and ``"buttocks"``, m; those that the widest section is given on for
            what is left out.
        notes : sequence of str
            What to say beforehand.

        Raises
        ------
        GeometryError
            No portion, or portions of the main body that overlap.
        """
        instance(particulars, Particulars, "particulars", "in a ship of portions")
        given = tuple(all_of(portions, Portion, "portions", "in a ship of portions"))
        if not given:
            raise GeometryError("a ship of portions has none", "give one or more")
        angle = not_negative(corner, "corner", "in a ship of portions")
        gaps = require_apart(given)
        chosen = default_cuts(given, particulars.draught)
        chosen |= _asked(cuts)
        before = all_of(notes, str, "notes", "in a ship of portions")
        return cls(particulars, given, angle, chosen, (*before, *gaps, *notes_of(given)))

    @property
    def kind(self) -> str:
        """What its texts begin with."""
        return "SFOLDS"

    @property
    def volume(self) -> float:
        """Sum of all portions, camber included, m3."""
        return float(sum(each.volume for each in self.portions))

    @property
    def centre(self) -> tuple[float, float]:
        """Of that volume: x from AP and z from base, m; nan for z where areas alone are given."""
        moments = [(each.moment_x, each.moment_z) for each in self.portions]
        x, z = (np.array(moments).sum(axis=0) / self.volume).tolist()
        return x, z

    def volume_below(self, z: float) -> float:
        """Give the volume of the main body below a height (m), without camber, m3.

        Raises
        ------
        GeometryError
            A portion of areas alone.
        """
        return float(sum(each.volume_below(z) for each in self.portions if each.is_main))

    def lines(self) -> tuple[LineSource, ...]:
        """Give the lines of the main body; see `lines_of_portions`.

        Raises
        ------
        GeometryError
            Portions of which no net can be made.
        """
        return lines_of_portions(self.portions, self.corner)

    def report(self, state: HullState | None = None) -> ClassicalReport:
        """Give volumes and centres of portions and of the whole, beside those of a net of it."""
        if state is not None:
            instance(state, HullState, "state", "in a report of portions")
        return report_of(self, state)


def _asked(cuts: object) -> dict[str, tuple[float, ...]]:
    """Take planes that are asked for, by group."""
    found: dict[str, tuple[float, ...]] = {}
    if cuts is None:
        return found
    if not isinstance(cuts, Mapping):
        what = f"the planes of a net are {shown(cuts)}"
        raise GeometryError(what, "give places by group, as {'waterlines': (1.0, 2.0)}")
    for group, places in cuts.items():
        if group not in ("waterlines", "buttocks"):
            what = f"a net is not cut by {shown(group)}"
            raise GeometryError(what, "use waterlines or buttocks")
        found[group] = tuple(finite(places, group, (None,)).tolist())
    return found
