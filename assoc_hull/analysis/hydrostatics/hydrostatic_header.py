"""The head of a table of hydrostatics: without it nobody can tell what the numbers mean."""

from __future__ import annotations

from collections.abc import Iterator

import attrs

from assoc_hull.analysis.hydrostatics.appendage import Appendage
from assoc_hull.arguments import all_of, checked, flag, not_negative, number, plain, positive, text

__all__ = ["FRESH", "SALT", "HydrostaticHeader"]

SALT, FRESH = 1.025, 1.000
"""Densities of salt and fresh water, t/m3."""

_WHERE = "in hydrostatics"
_WATERS = {SALT: "salt water", FRESH: "fresh water"}


def _appendages(values: object) -> tuple[Appendage, ...]:
    return tuple(all_of(values, Appendage, "appendages", _WHERE))


@attrs.frozen
class HydrostaticHeader:
    """What a table of hydrostatics holds good for.

    Attributes
    ----------
    ship : str
        Name.
    length, breadth, draught : float, m
        Lpp, moulded breadth, moulded design draught.
    rho : float, t/m3
        Density of the water.
    shell_factor : float
        Displacement over that of the moulded volume.
    kg : float or None, m
        Centre of gravity above the base line, if one was given.
    keel_thickness : float, m
        From the base line down to the underside of keel.
    transom : bool
        The immersed transom is a part of the wetted surface.
    deck : str
        "open" or "closed".
    appendages : tuple of Appendage
        That are added to the moulded hull.
    fingerprint : str
        Of the hull.
    date : str or None
        As the caller gives it.
    """

    ship: str
    length: float
    breadth: float
    draught: float
    rho: float = attrs.field(converter=plain, validator=checked(positive, _WHERE))
    shell_factor: float = attrs.field(converter=plain, validator=checked(positive, _WHERE))
    kg: float | None = attrs.field(
        converter=attrs.converters.optional(plain),
        validator=attrs.validators.optional(checked(number, _WHERE)),
    )
    keel_thickness: float = attrs.field(converter=plain, validator=checked(not_negative, _WHERE))
    transom: bool = attrs.field(validator=checked(flag, _WHERE))
    deck: str
    appendages: tuple[Appendage, ...] = attrs.field(converter=_appendages)
    fingerprint: str
    date: str | None = attrs.field(
        default=None, validator=attrs.validators.optional(checked(text, _WHERE))
    )

    @property
    def water(self) -> str:
        """The water in words."""
        return f"{_WATERS.get(self.rho, 'water')}, {self.rho:.6g} t/m3"

    @property
    def datum(self) -> str:
        """Origin, axes and signs in words."""
        return (
            "x from AP, + forward; y from the centre plane, + to port; z from the base line, up; "
            "draughts moulded, on the centre line at the perpendiculars; trim + by the stern; "
            "heel + starboard down"
        )

    def lines(self) -> Iterator[tuple[str, str]]:
        """Give the head as pairs of a title and words."""
        yield "ship", self.ship
        yield "Lpp, B, T", f"{self.length:.3f} m, {self.breadth:.3f} m, {self.draught:.3f} m"
        yield "datum", self.datum
        yield "water", self.water
        yield "shell factor", f"{self.shell_factor:g}"
        yield "KG", "not given" if self.kg is None else f"{self.kg:g} m"
        yield (
            "keel",
            (
                f"draught to the underside of keel is the moulded one + {self.keel_thickness:g} m"
                if self.keel_thickness
                else "no keel thickness given: draughts are moulded"
            ),
        )
        yield "wetted surface", "with the transom" if self.transom else "without the transom"
        yield "deck", self.deck
        yield from self._added()
        if self.date is not None:
            yield "date", self.date
        yield "fingerprint", self.fingerprint

    def _added(self) -> Iterator[tuple[str, str]]:
        if not self.appendages:
            yield "appendages", "none: bare hull"
        for each in self.appendages:
            x, y, z = each.centroid
            yield (
                "appendage",
                f"{each.name}: {each.volume:g} m3 at ({x:g}, {y:g}, {z:g}) m, {each.area:g} m2",
            )
