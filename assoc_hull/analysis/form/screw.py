"""What the lines of a hull do not tell of its screw and shaft."""

from __future__ import annotations

import attrs

from assoc_hull.arguments import checked, not_negative, number, positive

__all__ = ["Screw"]

_WHERE = "in a screw"


def _maybe_positive(value: object, name: str, where: str) -> None:
    if value is not None:
        positive(value, name, where)


def _maybe_number(value: object, name: str, where: str) -> None:
    if value is not None:
        number(value, name, where)


@attrs.frozen
class Screw:
    """Screw and shaft, port side where there are two.

    Attributes
    ----------
    height : float, m
        Of the shaft's centre above the base line, in the plane of the screw.
    diameter : float, m
        Of the screw.
    x : float or None, m
        Plane of the screw, from AP, + forward.
    spacing : float, m
        Between the centres of the shafts of two screws; 0: one screw on the centre line.
    boss_diameter : float or None, m
        Of the stern boss at its aft face.
    boss_x : float or None, m
        Aft face of the stern boss, from AP, + forward.

    Raises
    ------
    BadInputError
        A number that cannot be used.

    Examples
    --------
    >>> from assoc_hull.analysis.form.screw import Screw
    >>> Screw(height=4.2, diameter=6.0, spacing=16.9).spacing
    16.9
    """

    height: float = attrs.field(validator=checked(number, _WHERE))
    diameter: float = attrs.field(validator=checked(positive, _WHERE))
    x: float | None = attrs.field(default=None, validator=checked(_maybe_number, _WHERE))
    spacing: float = attrs.field(default=0.0, validator=checked(not_negative, _WHERE))
    boss_diameter: float | None = attrs.field(
        default=None, validator=checked(_maybe_positive, _WHERE)
    )
    boss_x: float | None = attrs.field(default=None, validator=checked(_maybe_number, _WHERE))
