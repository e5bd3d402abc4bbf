"""How a whole hull moves with one parameter: its points, its directions, its dimensions."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.analysis.derivatives.parameters import (
    FIXED_DIMENSIONS,
    Rates,
    ShapeParameter,
    TitledParameter,
)
from assoc_hull.arguments import checked, instance, shown, text
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.model.tables import HullState

__all__ = ["Moves"]

_WHERE = "in Moves"


def _array(values: object, name: str, tail: tuple[int, ...]) -> FloatArray:
    """Take finite numbers (n, *tail), in memory of their own."""
    try:
        found = np.array(values, np.float64)
    except (TypeError, ValueError, OverflowError):
        found = np.full(1, np.nan)
    if found.ndim != 1 + len(tail) or found.shape[1:] != tail or not np.isfinite(found).all():
        wanted = f"(n, {', '.join(map(str, tail))})"
        what = f"{name} is {shown(values)}"
        raise BadInputError(what, _WHERE, f"give finite numbers {wanted}, a row per point")
    freeze(found)
    return found


def _displacement(values: object) -> FloatArray:
    return _array(values, "displacement", (3,))


def _gradient(values: object) -> FloatArray:
    return _array(values, "gradient", (3, 3))


@attrs.frozen(eq=False)
class Moves(TitledParameter, ShapeParameter):
    """A parameter by which all defining points move as given.

    Points that are computed from curves follow these exactly, whatever stands in their rows;
    all others, adopted ones included, move as given. Planes of lines may go along.

    Attributes
    ----------
    name : str
        What it is called.
    displacement : (n, 3), m per unit
        By row of the table of points.
    gradient : (n, 3, 3) per unit, or None
        The derivative of component i of the displacement by coordinate j at each point: by it
        directions turn that are given at points and ends. None: they stay.
    rates : Rates
        How the principal dimensions change.
    unit : str
        Of the parameter.

    Raises
    ------
    BadInputError
        Arrays of another shape, or numbers that are not finite.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.analysis.derivatives.hydrostatic_derivatives import hydrostatic_derivatives
    >>> from assoc_hull.analysis.derivatives.given_motion import Moves
    >>> from assoc_hull.analysis.derivatives.parameters import Rates
    >>> from assoc_hull.hull.sources import examples
    >>> hull = examples.wigley()
    >>> half = hull.state.rows.xyz.data * [0.0, 1.0, 0.0] / hull.particulars.breadth
    >>> wider = Moves("breadth", half, rates=Rates(breadth=1.0), unit="m")
    >>> found = hydrostatic_derivatives(hull, [wider], draught=6.25)
    >>> found.of("volume").round(2).tolist(), round(found.value.volume / 10.0, 2)
    ([277.75], 277.74)
    """

    name: str = attrs.field(validator=checked(text, _WHERE))
    displacement: FloatArray = attrs.field(converter=_displacement)
    gradient: FloatArray | None = attrs.field(
        default=None, converter=attrs.converters.optional(_gradient)
    )
    rates: Rates = attrs.field(default=FIXED_DIMENSIONS)
    unit: str = "-"

    def __attrs_post_init__(self) -> None:
        instance(self.rates, Rates, "rates", _WHERE)
        if self.gradient is not None and len(self.gradient) != len(self.displacement):
            what = f"gradient has {len(self.gradient)} rows, displacement {len(self.displacement)}"
            raise BadInputError(what, _WHERE, "give a row per point in both")

    @property
    def follows(self) -> bool:
        """Points that are computed from curves follow."""
        return True

    def moves(self, state: HullState) -> tuple[FloatArray, FloatArray | None]:
        """Give how all points move, (n, 3) by row, and the gradient there, (n, 3, 3) or None.

        Raises
        ------
        BadInputError
            The hull has another number of points.
        """
        count = state.rows.count
        if len(self.displacement) != count:
            what = f"{self.name!r} moves {len(self.displacement)} points, the hull has {count}"
            raise BadInputError(what, _WHERE, "take the moves from this hull")
        return self.displacement, self.gradient
