"""What a form parameter gives: a number, or the reason why there is none."""

from __future__ import annotations

import attrs

from assoc_hull.errors import BadInputError

__all__ = ["Absent", "Found", "Value", "Warned"]


@attrs.frozen
class Absent:
    """That a hull does not have a parameter.

    Attributes
    ----------
    reason : str
        Why: no bulb, single skeg, no screw given ...; lower case, no full stop.
    """

    reason: str


@attrs.frozen
class Warned:
    """A number to be read with care.

    Attributes
    ----------
    number : float
        In the unit of its parameter.
    warning : str
        What to mind; lower case, no full stop.
    """

    number: float
    warning: str


Found = float | Absent | Warned
"""What the function of a parameter gives."""


@attrs.frozen
class Value:
    """A form parameter of a hull.

    Attributes
    ----------
    number : float or None
        In `unit`; None where there is none, for the `reason`.
    unit : str
        A dash where there is none.
    definition : str
        The symbol under which the catalogue holds the definition.
    reason : str or None
        Why there is no number.
    warning : str or None
        What to mind about the number.

    Examples
    --------
    >>> from assoc_hull.analysis.form.value import Value
    >>> Value(None, "m", "BL", reason="no bulb").reason
    'no bulb'
    """

    number: float | None
    unit: str
    definition: str
    reason: str | None = None
    warning: str | None = None

    def __attrs_post_init__(self) -> None:
        if (self.number is None) == (self.reason is None):
            raise BadInputError(
                f"{self.definition} has {'neither' if self.number is None else 'both'} "
                "a number and a reason",
                "in a form parameter", "give one of them",
            )  # fmt: skip
