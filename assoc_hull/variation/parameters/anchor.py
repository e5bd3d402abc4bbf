"""What is measured of a hull for its variation: a number, and the places it was taken at."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from types import MappingProxyType

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import plain
from assoc_hull.errors import AbsentParameterError, BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.model.named_mapping import Named

__all__ = ["Anchor", "Measures"]


def _places(value: ArrayLike) -> FloatArray:
    found = np.array(value, np.float64).reshape(-1, 3)
    freeze(found)
    return found


def _numbers(value: Mapping[str, float]) -> Mapping[str, float]:
    return MappingProxyType({name: plain(float(each)) for name, each in value.items()})


@attrs.frozen(eq=False)
class Anchor:
    """A named parameter of a hull as it is: what a variation of it holds on to.

    Attributes
    ----------
    name : str
        Of the parameter.
    unit : {"m", "deg"}
        Of its value.
    value : float or None
        None where the hull has none, for the `reason`.
    how : str
        How it was measured.
    places : (k, 3), m
        Where it was taken.
    curves : tuple of str
        Keys of the curves that it was taken from.
    numbers : mapping of str to float
        What else a layout of fields needs, in m or degrees; each measure says what it gives.
    reason : str or None
        Why there is no value; lower case, no full stop.
    """

    name: str
    unit: str
    value: float | None
    how: str = ""
    places: FloatArray = attrs.field(factory=lambda: np.zeros((0, 3)), converter=_places)
    curves: tuple[str, ...] = ()
    numbers: Mapping[str, float] = attrs.field(factory=dict, converter=_numbers)
    reason: str | None = None

    def __attrs_post_init__(self) -> None:
        if (self.value is None) == (self.reason is None):
            raise BadInputError(
                f"{self.name} has {'neither' if self.value is None else 'both'} value and reason",
                "in an anchor", "give one of them",
            )  # fmt: skip


class Measures(Mapping[str, float]):
    """Present values of named parameters by name, of those that a hull has.

    Parameters
    ----------
    anchors : iterable of Anchor
        In order.

    Attributes
    ----------
    anchors : mapping of str to Anchor
        All that were asked for, also those without a value.
    absent : mapping of str to str
        Why a hull has no value, for those it has none of.

    Examples
    --------
    >>> from assoc_hull.variation.parameters.anchor import Anchor, Measures
    >>> found = Measures([Anchor("draught", "m", 6.25), Anchor("bulb_length", "m", None,
    ...     reason="no profile forward of FP below z=6.250")])
    >>> dict(found), dict(found.absent)
    ({'draught': 6.25}, {'bulb_length': 'no profile forward of FP below z=6.250'})
    """

    def __init__(self, anchors: Iterable[Anchor]) -> None:
        given = tuple(anchors)
        self.anchors: Mapping[str, Anchor] = Named(
            "named parameter", {each.name: each for each in given}
        )
        self.absent: Mapping[str, str] = Named(
            "absent parameter", {each.name: each.reason for each in given if each.reason}
        )
        self._values = {each.name: each.value for each in given if each.value is not None}

    def __getitem__(self, name: str) -> float:
        reason = self.anchors[name].reason
        if reason is not None:
            raise AbsentParameterError(
                f"cannot measure {name!r}: {reason}", "in measure", "ask for what the hull has"
            )
        return self._values[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __contains__(self, name: object) -> bool:
        return name in self._values

    def __repr__(self) -> str:
        values = ", ".join(f"{name} {value:.6g}" for name, value in self._values.items())
        return f"<Measures: {values}>"
