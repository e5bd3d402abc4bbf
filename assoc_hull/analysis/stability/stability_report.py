"""Stability of a hull in a condition: righting levers, angles, criteria, and the report of them.

`stability` takes a hull, `stability_of` a floating body. Levers are computed at all heels asked and
every 5 degrees, to where an open deck is flooded. Heels are in degrees, + starboard down; levers in
m, + where they right a heel to starboard. Notes say what is not evaluated, and which heels have no
lever and why.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.draughts_from_weight import weight_in_tons
from assoc_hull.analysis.hydrostatics.floating_body import (
    CLOSE_DECK,
    Appendage,
    FloatingBody,
)
from assoc_hull.analysis.hydrostatics.flotation import body_of, header_of
from assoc_hull.analysis.hydrostatics.hull_hydrostatics import doubts_of
from assoc_hull.analysis.hydrostatics.record import SALT, HydrostaticHeader
from assoc_hull.analysis.stability.condition import (
    HEELS,
    Condition,
    ConditionRequest,
    OnError,
    case_of,
    checked_on_error,
    condition_of,
    heels_of,
)
from assoc_hull.analysis.stability.criteria import CriteriaInput, Criterion, intact_criteria
from assoc_hull.analysis.stability.flooding import (
    Flooding,
    FloodingPoint,
    immersion_heels,
    mirrored_places,
    open_deck_limit,
)
from assoc_hull.analysis.stability.lever_curve import LeverCurve, lever_curve
from assoc_hull.analysis.stability.righting_lever import (
    FREE_MOST,
    HeeledShip,
    StabilityCase,
    TrimRule,
    float_at_heels,
    rough_levers,
)
from assoc_hull.arguments import all_of, choice, number
from assoc_hull.display import ShownAsText
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.model.named_mapping import NamedMapping
from assoc_hull.model.tables import HasState

__all__ = [
    "Stability",
    "StabilityAngles",
    "stability",
    "stability_notes",
    "stability_of",
    "why_it_ends",
]

# --------------------------------------------------------------------------------------
# Results.

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


@attrs.frozen(eq=False, repr=False)
class Stability(ShownAsText):
    """Stability of a ship in a condition.

    Attributes
    ----------
    header : HydrostaticHeader
        What the numbers hold good for; whether the deck is open or closed.
    condition : Condition
        Weight, its centre, and how she floats upright.
    trim : str
        "fixed" or "free".
    heels : HeeledShip
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
    heels: HeeledShip
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
    def not_evaluated(self) -> tuple[Criterion, ...]:
        """The criteria of which nothing is known; the weather criterion always is one."""
        return tuple(each for each in self.criteria if each.passed is None)

    @property
    def columns(self) -> Mapping[str, FloatArray]:
        """The table: heel, levers, dynamic arm and draughts, (d,) each; nan where there is none.

        Draughts are those on the centre line at the perpendiculars; there is none where the water
        passes above the deck or below the keel there, as it does on a ship that lies on her side.
        """
        aft, fore = _centre_draughts(self.heels, self.curve.case)
        found = {
            "heel_deg": self.heels.heel_deg,
            "kn": self.heels.kn,
            "gz": self.heels.gz,
            "arm": self.curve.arm(self.heels.heel_deg),
            "draught_aft": aft,
            "draught_fore": fore,
        }
        for each in found.values():
            freeze(each)
        return NamedMapping("value", found)

    def __str__(self) -> str:
        """Give what is found as `lines` does, without the head; levers are in `columns`."""
        head = {title for title, _ in self.header.lines()}
        told = [(title, words) for title, words in self.lines() if title not in head]
        wide = max(len(title) for title, _ in told)
        return "\n".join(f"{title:{wide}}  {words}" for title, words in told)

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
    left = ", ".join(f"{each.code} {each.name}" for each in stability.not_evaluated)
    if stability.passed is None:
        return f"no criterion fails, but not all are evaluated: not {left}"
    # Never a bare "passed": the code asks for more than what is evaluated here.
    return f"2.2.1 to 2.2.4 are met; not evaluated: {left}"


# --------------------------------------------------------------------------------------
# Notes.


def why_it_ends(end: float, limit: float | None) -> str:
    """Say why a curve of levers ends at `end` degrees.

    `limit` is where the edge of an open deck goes under; None: the deck is closed, or stays dry.
    """
    if limit is not None:
        return f"GZ stops at {limit:.2f} deg, where the edge of the open deck goes under"
    return f"GZ is computed to {end:.4g} deg"


def stability_notes(
    at: HeeledShip, case: StabilityCase, limit: float | None, side: int
) -> tuple[str, ...]:
    """Say whether the deck is open, what is not evaluated, and which heels have no lever.

    `limit` as for `why_it_ends`; `side` to which the ship is judged: 1 starboard, -1 port.
    """
    notes = ["the deck is closed" if case.afloat.body.limits.closed else "the deck is open"]
    if limit is not None:
        notes[0] += f": {why_it_ends(0.0, limit)}; edit.set_particulars(deck='closed') closes it"
    if case.trim == "fixed":
        notes.append("trim is fixed: levers are those of the plane with the draughts' difference")
    notes.append("the weather criterion (2008 IS Code A 2.3) is not evaluated")
    notes += [*_other_side(at, side), *_missing(at, case, limit), *_beside(at, case)]
    return (*notes, *rough_levers(at))


def _other_side(at: HeeledShip, side: int) -> list[str]:
    """Note that all heels of the table are to the side on which the ship is not judged."""
    towards = side * at.heel_deg
    if (towards > 0.0).any() or not (towards < 0.0).any():
        return []
    judged, sign = ("starboard", "positive") if side > 0 else ("port", "negative")
    return [f"she is judged heeling to {judged}: for levers to that side ask for {sign} heels"]


def _missing(at: HeeledShip, case: StabilityCase, limit: float | None) -> list[str]:
    """Name heels that were asked and have no lever, though the deck keeps the water out."""
    most = FREE_MOST if case.trim == "free" else 90.0
    heel = np.abs(at.heel_deg)
    none = np.isnan(at.gz) & (heel <= (most if limit is None else limit))
    notes = []
    if (heel > most).any() and limit is None:
        notes.append(f"at free trim nothing is computed beyond {most:g} deg")
    if none.any():
        words = ", ".join(f"{each:g}" for each in at.heel_deg[none].tolist())
        notes.append(f"she does not float at {words} deg, or an appendage gets wet just there")
    return notes


# --------------------------------------------------------------------------------------
# Draughts on the centre line. They grow as 1 / cos(heel): of a ship on her side they are the height
# of a place far above the deck, or below the keel, and no draughts.


_ROUNDING = 1e-6
"""Draughts this near to the deck or the keel (m) are at it."""


def _centre_draughts(at: HeeledShip, case: StabilityCase) -> tuple[FloatArray, FloatArray]:
    """Give draughts at AP and FP (d,), m; nan where the water passes the hull by there."""
    limits, half = case.afloat.body.limits, 0.5 * case.afloat.length
    z = np.concatenate([limits.bottom[:, 2], limits.deck[:, 2]])
    found = []
    for side in (-half, half):
        draught = at.mean + side * at.slope
        # A trim that leaves one end bare even upright has draughts beyond keel or deck there.
        upright = float(case.mean[0] + side * case.slope[0])
        least = min(float(z.min()), upright) - _ROUNDING
        most = max(float(z.max()), upright) + _ROUNDING
        found.append(np.where((draught >= least) & (draught <= most), draught, np.nan))
    return found[0], found[1]


def _beside(at: HeeledShip, case: StabilityCase) -> list[str]:
    """Note from which heel on the table has no draughts, though she floats."""
    aft, fore = _centre_draughts(at, case)
    # Beyond 89.75 degrees there are none anyway.
    none = np.abs(at.heel_deg[np.isfinite(at.mean) & (np.isnan(aft) | np.isnan(fore))])
    if not len(none):
        return []
    return [
        f"from {none.min():g} deg on the water passes the centre line above the deck or below the "
        "keel at a perpendicular: no draughts there"
    ]


# --------------------------------------------------------------------------------------
# Computing them.

_WHERE = "in stability"
_STEP = 5.0  # degrees
_LEAST = 40.0
"""The curve goes at least to this heel (degrees), for the criteria."""

_RIM = 1e-6
"""Degrees by which the curve stays short of the edge of an open deck."""


def stability(
    hull: HasState,
    *,
    kg: float,
    weight: float | None = None,
    draught: float | None = None,
    draughts: tuple[float, float] | None = None,
    lcg: float | None = None,
    tcg: float = 0.0,
    trim: TrimRule = "fixed",
    heels: Sequence[float] = HEELS,
    flooding: Iterable[FloodingPoint] = (),
    rho: float = SALT,
    shell_factor: float = 1.0,
    appendages: Iterable[Appendage] = (),
    on_error: OnError = "refuse",
    date: str | None = None,
) -> Stability:
    """Compute the righting levers of a ship in a condition, and judge them.

    The arguments and what is raised are those of `Hull.stability`.
    """
    terms: dict[str, object] = {
        "rho": rho, "shell_factor": shell_factor, "kg": number(kg, "kg", _WHERE),
        "appendages": appendages, "date": date,
    }  # fmt: skip
    choice(trim, "trim", ("fixed", "free"), _WHERE)
    checked_on_error(on_error)
    points = all_of(flooding, FloodingPoint, "flooding", _WHERE)
    wanted = heels_of(heels)
    body = body_of(hull)
    header = header_of(hull, body, terms)
    centre = None if lcg is None else number(lcg, "lcg", _WHERE)
    aside = number(tcg, "tcg", _WHERE)
    asked = ConditionRequest(
        None if weight is None else weight_in_tons(weight),
        draught,
        draughts,
        centre,
        aside,
        header.kg,
    )
    found = stability_of(body, header, asked, trim, wanted, points)
    doubts = doubts_of(body, header, [found.condition.upright], on_error, _WHERE)
    return attrs.evolve(found, notes=(*found.notes, *doubts))


def stability_of(
    body: FloatingBody,
    header: HydrostaticHeader,
    asked: ConditionRequest,
    trim: TrimRule,
    heels: FloatArray,
    points: Sequence[FloodingPoint] = (),
) -> Stability:
    """Compute the stability of a floating body: the inner part of `stability`."""
    condition = condition_of(body, header, asked)
    case = case_of(body, header, [condition], trim)
    upright = float_at_heels(case, np.zeros(1))
    if not np.isfinite(upright.gz[0]):
        remedy = "give another condition"
        raise BadInputError("she does not float upright", _WHERE, remedy)
    # Positive upright, the lever turns her to port: she is judged to the side she lists to.
    side = -1 if upright.gz[0] > 1e-12 else 1
    limit = None if body.limits.closed else open_deck_limit(case, condition, side)
    curve = lever_curve(case, _nodes(heels, side, _end(limit)), side)
    drowned = immersion_heels(
        curve, [mirrored_places(body.limits.deck), *(each.places for each in points)]
    )
    floodings = tuple(map(Flooding, points, drowned[1:]))
    first = min((each for each in drowned[1:] if each is not None), default=None)
    curve = curve.through([*drowned[:1], first])
    why = why_it_ends(curve.end, limit)
    at = float_at_heels(case, heels, near=curve.heels)
    gz_max, largest = curve.largest
    return Stability(
        header,
        condition,
        trim,
        at,
        curve,
        StabilityAngles(drowned[0] if limit is None else limit, first, largest, *curve.positive),
        curve.gm,
        gz_max,
        intact_criteria(CriteriaInput(curve, first, bool(points), why)),
        floodings,
        stability_notes(at, case, limit, side),
    )


def _end(limit: float | None) -> float:
    """Give the largest heel that is computed, degrees."""
    if limit is not None and limit <= 2.0 * _RIM:
        remedy = f"give less draught, or {CLOSE_DECK}"
        raise BadInputError("the edge of the open deck is in the water upright", _WHERE, remedy)
    return 90.0 if limit is None else limit - _RIM


def _nodes(heels: FloatArray, side: int, end: float) -> FloatArray:
    """Give the heels from which the curve is begun: all that are asked, and every 5 degrees."""
    most = max(_LEAST, float(np.abs(heels).max()))
    least = min(0.0, float((side * heels).min()))
    steps = np.arange(0.0, 90.0 + _STEP, _STEP)
    judged = np.concatenate([steps[steps < most], [most], -steps[-steps > least], [least]])
    inside = np.clip(np.concatenate([judged, side * heels]), -end, end)
    return np.unique(side * inside)
