"""What is found of the stability of a condition: levers, angles, criteria."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import attrs

from assoc_hull.analysis.hydrostatics.hydrostatic_header import HydrostaticHeader
from assoc_hull.analysis.stability.condition import Condition
from assoc_hull.analysis.stability.criteria import Criterion
from assoc_hull.analysis.stability.flooding import Flooding
from assoc_hull.analysis.stability.heeled import Heeled
from assoc_hull.analysis.stability.lever_curve import LeverCurve
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.model.named_mapping import Named

__all__ = ["Stability", "StabilityAngles"]

SIDES = {1: "starboard", -1: "port"}


@attrs.frozen
class StabilityAngles:
    """Heels at which something happens, degrees, to the side on which the ship is judged.

    Attributes
    ----------
    deck_edge : float or None
        The deck edge goes under; None: it stays dry as far as the curve goes.
    flooding : float or None
        The first opening goes under; None: none was given, or all stay dry.
    largest : float
        GZ is largest.
    equilibrium : float or None
        GZ begins to be positive: 0 unless she lists or lolls; None: it never is.
    vanishing : float or None
        GZ is no longer positive; None: it still is where the curve ends, or never was.
    """

    deck_edge: float | None
    flooding: float | None
    largest: float
    equilibrium: float | None
    vanishing: float | None

    @property
    def range(self) -> float | None:
        """Range of positive stability, degrees."""
        if self.equilibrium is None or self.vanishing is None:
            return None
        return self.vanishing - self.equilibrium


@attrs.frozen(eq=False)
class Stability:
    """Stability of a ship in a condition.

    Attributes
    ----------
    header : HydrostaticHeader
        What the numbers hold good for; whether the deck is open or closed.
    condition : Condition
        Weight, its centre, and how she floats upright.
    trim : str
        "fixed" or "free".
    heels : Heeled
        Levers and floating positions at the heels that were asked.
    curve : LeverCurve
        Levers at any heel between, areas, and the side to which she is judged.
    angles : StabilityAngles
        Heels at which something happens.
    gm : float, m
        Initial metacentric height: the slope of the curve upright.
    gz_max : float, m
        The largest lever.
    criteria : tuple of Criterion
        2008 IS Code A 2.2, and the weather criterion, which is not evaluated.
    floodings : tuple of Flooding
        When each opening goes under.
    notes : tuple of str
        What else there is to say.
    """

    header: HydrostaticHeader
    condition: Condition
    trim: str
    heels: Heeled
    curve: LeverCurve
    angles: StabilityAngles
    gm: float
    gz_max: float
    criteria: tuple[Criterion, ...]
    floodings: tuple[Flooding, ...]
    notes: tuple[str, ...]

    @property
    def heel_deg(self) -> FloatArray:
        """Heels that were asked, degrees, (d,)."""
        return self.heels.heel_deg

    @property
    def gz(self) -> FloatArray:
        """Righting levers at these heels, m, (d,); nan where she does not float."""
        return self.heels.gz

    @property
    def kn(self) -> FloatArray:
        """Levers about the base line at these heels, m, (d,)."""
        return self.heels.kn

    @property
    def side(self) -> str:
        """The side to which she is judged."""
        return SIDES[self.curve.side]

    @property
    def passed(self) -> bool | None:
        """Whether all six criteria of 2.2 are met; None: none fails, but not all are evaluated."""
        told = [each.passed for each in self.criteria if each.required is not None]
        return None if None in told and False not in told else all(told)

    @property
    def failed(self) -> tuple[Criterion, ...]:
        """The criteria that are not met."""
        return tuple(each for each in self.criteria if each.passed is False)

    @property
    def columns(self) -> Mapping[str, FloatArray]:
        """The table: heel, levers, dynamic arm and draughts, (d,) each; nan where there is none."""
        lift = 0.5 * self.header.length * self.heels.slope
        found = {
            "heel_deg": self.heels.heel_deg,
            "kn": self.heels.kn,
            "gz": self.heels.gz,
            "arm": self.curve.arm(self.heels.heel_deg),
            "draught_aft": self.heels.mean - lift,
            "draught_fore": self.heels.mean + lift,
        }
        for each in found.values():
            freeze(each)
        return Named("value", found)

    def lines(self) -> Iterator[tuple[str, str]]:
        """Give head, condition and findings as pairs of a title and words."""
        yield from self.header.lines()
        ship, at = self.condition, self.condition.upright
        yield "weight", f"{ship.weight:.3f} t, {ship.volume:.3f} m3"
        yield "centre of gravity", f"LCG {ship.lcg:.4f} m, TCG {ship.tcg:g} m, KG {ship.kg:g} m"
        yield "upright", f"T_A {at.draught_aft:.4f} m, T_F {at.draught_fore:.4f} m"
        yield "trim", f"{self.trim} as she heels"
        yield "judged", f"heeling to {self.side}"
        yield from _found(self)
        for each in self.floodings:
            angle = each.heel_deg
            words = "stays dry" if angle is None else f"goes under at {angle:.2f} deg"
            yield "opening", f"{each.point.name} {each.point.place}: {words}"
        for criterion in self.criteria:
            yield "criterion", str(criterion)
        yield "in all", _verdict(self)
        for note in self.notes:
            yield "note", note


def _found(stability: Stability) -> Iterator[tuple[str, str]]:
    angles = stability.angles
    yield "GM", f"{stability.gm:.4f} m, without free surfaces"
    yield "largest GZ", f"{stability.gz_max:.4f} m at {angles.largest:.2f} deg"
    end = f"beyond {stability.curve.end:.4g} deg"
    for title, angle in (
        ("equilibrium", angles.equilibrium),
        ("GZ vanishes", angles.vanishing),
        ("deck edge under", angles.deck_edge),
    ):
        yield (
            title,
            ("never" if title == "equilibrium" else end)
            if angle is None
            else (f"at {angle:.2f} deg"),
        )


def _verdict(stability: Stability) -> str:
    failed = ", ".join(f"{each.code} {each.name} ({each.margin:+.4f})" for each in stability.failed)
    if failed:
        return f"FAILED: {failed}"
    return "not all criteria are evaluated" if stability.passed is None else "passed"
