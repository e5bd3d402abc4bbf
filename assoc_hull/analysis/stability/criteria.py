"""Criteria of intact stability: 2008 IS Code, part A, 2.2, each as an object.

Areas count up to the heel at which water comes in, not beyond; the weather criterion (A 2.3) is
listed, and is not evaluated.
"""

from __future__ import annotations

import attrs

from assoc_hull.analysis.stability.lever_curve import LeverCurve

__all__ = ["CriteriaInput", "Criterion", "intact_criteria", "unjudged_criteria"]

_M, _MRAD, _DEG = "m", "m rad", "deg"
_NO_POINT = "phi_f not given, 40 used"
_WEATHER = "the weather criterion needs windage and rolling"
_ROUNDING = 1e-9
"""Degrees by which a curve may end early."""


@attrs.frozen
class Criterion:
    """A requirement, and how a ship meets it.

    Attributes
    ----------
    code, name : str
        Its paragraph in the 2008 IS Code, part A, and in words.
    required : float or None
        The least that is allowed; None for what is no single number.
    unit : str
        Of the numbers.
    value : float or None
        What the ship has; None: it is not evaluated.
    note : str
        Why not, or what the value rests on; else empty.

    Examples
    --------
    >>> from assoc_hull.analysis.stability.criteria import Criterion
    >>> low = Criterion("2.2.4", "initial metacentric height", 0.15, "m", 0.11)
    >>> low.passed, round(low.margin, 6)
    (False, -0.04)
    """

    code: str
    name: str
    required: float | None
    unit: str
    value: float | None
    note: str = ""

    @property
    def margin(self) -> float | None:
        """Value less what is required; below 0 if the ship fails."""
        if self.value is None or self.required is None:
            return None
        return self.value - self.required

    @property
    def passed(self) -> bool | None:
        """Whether the ship meets it; None: it is not evaluated."""
        return None if self.margin is None else self.margin >= 0.0

    def __str__(self) -> str:
        if self.value is None or self.required is None or self.margin is None:
            return f"{self.code} {self.name}: not evaluated: {self.note}"
        word = "passed" if self.passed else "FAILED"
        more = f" ({self.note})" if self.note else ""
        return (
            f"{self.code} {self.name}: {self.value:.4f} of {self.required:g} {self.unit}, "
            f"margin {self.margin:+.4f}, {word}{more}"
        )


@attrs.frozen
class CriteriaInput:
    """What criteria look at.

    Attributes
    ----------
    curve : LeverCurve
        The levers, and the side to which the ship is judged.
    flooding_deg : float or None, degrees
        Where water comes in; None: nowhere on the curve.
    points : bool
        Openings were given.
    end : str
        Why the curve ends where it does.
    """

    curve: LeverCurve
    flooding_deg: float | None
    points: bool
    end: str

    @property
    def limit(self) -> float:
        """The heel to which areas count, degrees: 40, or where water comes in before."""
        return 40.0 if self.flooding_deg is None else min(40.0, self.flooding_deg)

    @property
    def about_flooding(self) -> str:
        """What is known of the heel at which water comes in, in words."""
        if not self.points:
            return _NO_POINT
        if self.flooding_deg is None:
            return f"openings stay dry to {self.curve.end:.4g} deg, 40 used"
        return f"phi_f {self.flooding_deg:.2f} deg"


_UNJUDGED = tuple(
    Criterion(code, name, least, unit, None)
    for code, name, least, unit in (
        ("2.2.1", "area under GZ from 0 to 30 deg", 0.055, _MRAD),
        ("2.2.1", "area under GZ from 0 to 40 deg or phi_f", 0.090, _MRAD),
        ("2.2.1", "area under GZ from 30 to 40 deg or phi_f", 0.030, _MRAD),
        ("2.2.2", "largest GZ at 30 deg or more", 0.2, _M),
        ("2.2.3", "heel of the largest GZ", 25.0, _DEG),
        ("2.2.4", "initial metacentric height", 0.15, _M),
        ("2.3", "severe wind and rolling", None, ""),
    )
)


def unjudged_criteria(why: str) -> tuple[Criterion, ...]:
    """List all criteria as not evaluated, for a reason."""
    return tuple(attrs.evolve(each, note=why) for each in _UNJUDGED)


def intact_criteria(judged: CriteriaInput) -> tuple[Criterion, ...]:
    """Evaluate the criteria of 2.2, and list that of 2.3.

    Parameters
    ----------
    judged : CriteriaInput
        The ship.

    Returns
    -------
    tuple of Criterion
        Six that are evaluated where the curve goes far enough, and the weather criterion.
    """
    limit = judged.limit
    first, second, third, lever, angle, height, weather = _UNJUDGED
    return (
        _area(judged, first, (0.0, 30.0)),
        _area(judged, second, (0.0, limit)),
        _area(judged, third, (30.0, limit)),
        _lever(judged, lever),
        _angle(judged, angle),
        attrs.evolve(height, value=judged.curve.gm),
        attrs.evolve(weather, note=_WEATHER),
    )


def _area(judged: CriteriaInput, asked: Criterion, span: tuple[float, float]) -> Criterion:
    """Judge the area between two heels, or to where water comes in before the second."""
    made = attrs.evolve(asked, note=judged.about_flooding)
    low, high = span[0], min(span[1], judged.limit)
    if judged.curve.end < high - _ROUNDING:
        return attrs.evolve(made, note=judged.end)
    if high <= low:
        return attrs.evolve(made, value=0.0, note=f"{made.note}: nothing counts beyond")
    value = judged.curve.area(low, high)
    plain = high == span[1] == 30.0 != judged.limit
    return attrs.evolve(made, value=value, note="" if plain else made.note)


def _lever(judged: CriteriaInput, asked: Criterion) -> Criterion:
    """Judge the largest lever at 30 degrees or more."""
    if judged.curve.end < 30.0 - _ROUNDING:
        return attrs.evolve(asked, note=judged.end)
    gz, heel = judged.curve.most(30.0)
    return attrs.evolve(asked, value=gz, note=f"at {heel:.2f} deg")


def _angle(judged: CriteriaInput, asked: Criterion) -> Criterion:
    """Judge the heel of the largest lever."""
    gz, heel = judged.curve.largest
    if gz <= 0.0:
        return attrs.evolve(asked, note="GZ is nowhere above 0")
    if heel < judged.curve.end - _ROUNDING:
        return attrs.evolve(asked, value=heel)
    note = f"GZ still rises at the end of the curve; {judged.end}"
    least = asked.required or 0.0
    return attrs.evolve(asked, value=heel if heel >= least else None, note=note)
