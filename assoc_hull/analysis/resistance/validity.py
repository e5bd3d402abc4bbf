"""For which ships Holtrop's regression was made, and what to mind where another is asked about.

The sample has five types of ships, each with a range of Froude numbers, prismatic coefficients and
proportions. A ship that lies within none of them is told of the type to which she comes nearest.

Source: J. Holtrop and G.G.J. Mennen, "A statistical power prediction method", International
Shipbuilding Progress 25 (1978) no. 290, pp. 253-256, for Froude number, CP and L/B; limits of B/T
as programs that follow it print them. The papers of 1982 and 1984 enlarge the sample by faster
ships and repeat no table.
"""

from __future__ import annotations

import attrs

from assoc_hull.analysis.resistance.holtrop_ship import NU, HoltropShip

__all__ = ["TYPES", "SampledShips", "nearest_type", "types_of", "warnings_of"]


@attrs.frozen
class SampledShips:
    """Ships of one type in the sample.

    Attributes
    ----------
    name : str
        In the plural, lower case.
    froude : float
        The greatest Froude number.
    cp, slender, wide : (float, float)
        Least and greatest CP, L/B and B/T.
    """

    name: str
    froude: float
    cp: tuple[float, float]
    slender: tuple[float, float]
    wide: tuple[float, float]

    def beyond(self, ship: HoltropShip, froude: float) -> list[tuple[str, float]]:
        """Give in what a ship lies outside, in words, and by how much of the limit."""
        given = {
            "Fn": (froude, 0.0, self.froude),
            "CP": (ship.cp, *self.cp),
            "L/B": (ship.length / ship.breadth, *self.slender),
            "B/T": (ship.breadth / ship.draught, *self.wide),
        }
        found = []
        for name, (value, least, most) in given.items():
            if not least <= value <= most:
                far, limit = (value - most, most) if value > most else (least - value, least)
                words = f"{name} {value:.3g} is {'above' if value > most else 'below'} {limit:g}"
                found.append((words, far / limit))
        return found


TYPES: tuple[SampledShips, ...] = (
    SampledShips("tankers and bulk carriers", 0.24, (0.73, 0.85), (5.1, 7.1), (2.4, 3.2)),
    SampledShips("trawlers, coasters and tugs", 0.38, (0.55, 0.65), (3.9, 6.3), (2.1, 3.0)),
    SampledShips("container ships and destroyers", 0.45, (0.55, 0.67), (6.0, 9.5), (3.0, 4.0)),
    SampledShips("cargo liners", 0.30, (0.56, 0.75), (5.3, 8.0), (2.4, 4.0)),
    SampledShips("ro-ro ships and car ferries", 0.35, (0.55, 0.67), (5.3, 8.0), (3.2, 4.0)),
)
"""The types of the sample."""


def types_of(ship: HoltropShip, froude: float) -> tuple[str, ...]:
    """Give the types within whose ranges a ship lies, up to a Froude number.

    Examples
    --------
    >>> from assoc_hull.analysis.resistance.holtrop_ship import HoltropShip
    >>> from assoc_hull.analysis.resistance.validity import types_of
    >>> ship = HoltropShip(length=205.0, breadth=32.0, draught_fore=10.0, draught_aft=10.0,
    ...                    volume=37500.0, lcb=-0.75, cm=0.98, cwp=0.75)
    >>> types_of(ship, 0.287)
    ('container ships and destroyers', 'cargo liners', 'ro-ro ships and car ferries')
    """
    return tuple(each.name for each in TYPES if not each.beyond(ship, froude))


def nearest_type(ship: HoltropShip, froude: float) -> SampledShips:
    """Give the type to which a ship comes nearest: by all that she lies outside, of the limits."""
    return min(TYPES, key=lambda each: sum(far for _, far in each.beyond(ship, froude)))


_BULB = 0.2
"""Of the total: more of it than a bulb costs that lies as deep as those of the sample."""


def warnings_of(ship: HoltropShip, froude: float, bulb: float = 0.0) -> tuple[str, ...]:
    """Say what to mind about the resistance of a ship, up to a Froude number.

    `bulb` is the greatest part of the total that is RB.
    """
    found = []
    nearest = nearest_type(ship, froude)
    beyond = nearest.beyond(ship, froude)
    if beyond:
        words = ", ".join(each for each, _ in beyond)
        found.append(
            f"outside the ranges of all types of ships of the regression; nearest are "
            f"{nearest.name}: {words}"
        )
    if ship.bulb_centre < ship.bulb_height:
        found.append(
            f"the centre of the bulb's section is {ship.bulb_height:.3f} m above the base line; "
            f"0.6 T_F, {ship.bulb_centre:.3f} m, is taken, as the papers ask, and RB is doubtful"
        )
    if bulb > _BULB:
        found.append(
            f"RB is up to {100.0 * bulb:.0f} % of R: the bulb lies near the surface, where the "
            "regression overrates it"
        )
    if ship.rho < 1.01 and ship.nu == NU:
        found.append(
            "rho is that of fresh water, nu that of salt water; fresh water of 15 degrees has "
            "nu 1.139e-6 m2/s"
        )
    return tuple(found)
