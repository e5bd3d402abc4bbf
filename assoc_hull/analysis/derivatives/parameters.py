"""What hydrostatics can be differentiated by, and how a whole hull moves with it.

Each is a small value that says how fast the floating position and the defining points of a
hull change with it.

How a whole hull moves with one parameter: its points, its directions, its dimensions.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.arguments import (
    checked,
    choice,
    flag,
    instance,
    number,
    numbers,
    shown,
    text,
)
from assoc_hull.errors import (
    BadInputError,
    FreedomError,
    PointRoleError,
    WrongTypeError,
)
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.plane import AXES
from assoc_hull.model.address import resolve_address
from assoc_hull.model.links import free_axes
from assoc_hull.model.tables import HullState

__all__ = [
    "DRAUGHT",
    "DRAUGHT_AFT",
    "DRAUGHT_FORE",
    "FIXED_DIMENSIONS",
    "HEEL",
    "TRIM",
    "Deformation",
    "Moves",
    "Parameter",
    "PointMove",
    "Position",
    "Rates",
    "ShapeParameter",
    "TitledParameter",
]

_WHERE = "in hydrostatic_derivatives"


def _three(rates: object) -> tuple[float, float, float]:
    found = numbers(rates, "rates", _WHERE)
    if found.shape != (3,):
        raise BadInputError(f"rates are {rates!r}", _WHERE, "give those of T_A, T_F and heel")
    aft, fore, heel = found.tolist()
    return aft, fore, heel


class Parameter(ABC):
    """Something to differentiate by: of the floating position, or of the shape."""

    @property
    @abstractmethod
    def title(self) -> str:
        """What it is called."""

    @property
    def per(self) -> str:
        """Its unit."""
        return "m"


class TitledParameter(Parameter):
    """A parameter with a name and a unit of its own."""

    name: str
    unit: str

    @property
    def title(self) -> str:
        """What it is called."""
        return self.name

    @property
    def per(self) -> str:
        """Its unit."""
        return self.unit


@attrs.frozen
class Position(TitledParameter):
    """A parameter of the floating position: `DRAUGHT` and so on, or one of your own.

    Attributes
    ----------
    name : str
        What it is called.
    rates : (float, float, float)
        Change of T_A (m), of T_F (m) and of the heel (degrees) per unit.
    unit : str
        Of the parameter.
    """

    name: str = attrs.field(validator=checked(text, _WHERE))
    rates: tuple[float, float, float] = attrs.field(converter=_three)
    unit: str = "m"


DRAUGHT = Position("draught", (1.0, 1.0, 0.0))
"""The mean draught, at the same trim and heel; m."""

TRIM = Position("trim", (0.5, -0.5, 0.0))
"""The trim T_A - T_F, + by the stern, at the same mean draught and heel; m."""

DRAUGHT_AFT = Position("draught aft", (1.0, 0.0, 0.0))
"""The draught at the after perpendicular, T_F and heel held; m."""

DRAUGHT_FORE = Position("draught fore", (0.0, 1.0, 0.0))
"""The draught at the fore perpendicular, T_A and heel held; m."""

HEEL = Position("heel", (0.0, 0.0, 1.0), "deg")
"""The heel, + starboard down, draughts on the centre line held; per degree."""


@attrs.frozen
class Rates:
    """How the principal dimensions change with a parameter, m per unit.

    Attributes
    ----------
    length, breadth, depth, draught : float
        Lpp, moulded breadth and depth, moulded design draught.
    """

    length: float = attrs.field(default=0.0, validator=checked(number, _WHERE))
    breadth: float = attrs.field(default=0.0, validator=checked(number, _WHERE))
    depth: float = attrs.field(default=0.0, validator=checked(number, _WHERE))
    draught: float = attrs.field(default=0.0, validator=checked(number, _WHERE))


FIXED_DIMENSIONS = Rates()
"""No principal dimension changes."""


class ShapeParameter(Parameter):
    """A parameter of the shape: points move, given directions may turn."""

    rates: Rates = FIXED_DIMENSIONS
    """How the principal dimensions go along."""

    @property
    def follows(self) -> bool:
        """Points that are computed from curves follow."""
        return False

    @abstractmethod
    def moves(self, state: HullState) -> tuple[FloatArray, FloatArray | None]:
        """Give how all points move, (n, 3) by row, m per unit, and how directions turn.

        The second is the gradient at each point, (n, 3, 3); None if directions stay.
        """


@attrs.frozen
class PointMove(ShapeParameter):
    """One defining point that moves in the planes of its lines; m.

    All other defining points stay, and so do given directions; the curves through the point
    are lofted anew. Points that are computed from these curves stay, too, unless they `follow`.

    Attributes
    ----------
    address : str
        Of the point, for instance ``"WL 2.5 x ST 7"``.
    axis : "x", "y", "z" or None
        The coordinate that grows by 1 per unit, one of those in which the point is free; None
        where it is free in one only. In an oblique plane another coordinate goes along.
    follow : bool
        Points that are computed from curves follow, as they do in an edit; adopted points, which
        an edit carries along, do not.
    """

    address: str = attrs.field(validator=checked(text, _WHERE))
    axis: str | None = None
    follow: bool = attrs.field(default=False, validator=checked(flag, _WHERE))

    @property
    def follows(self) -> bool:
        """Points that are computed from curves follow."""
        return self.follow

    @property
    def title(self) -> str:
        """The address, with the axis if one was given."""
        return self.address if self.axis is None else f"{self.address} {self.axis}"

    def moves(self, state: HullState) -> tuple[FloatArray, None]:
        """Give how all points move, (n, 3) by row, m per m.

        Raises
        ------
        UnknownNameError, BadInputError
            No point has this address, or the axis is missing.
        PointRoleError
            The point defines no curve, or is computed itself and is to be followed.
        FreedomError
            It is not free along the axis.
        """
        row = resolve_address(state, self.address).row
        if row < 0:
            raise BadInputError(f"{self.address!r} names no point", _WHERE, "ask hull.points")
        if not (state.rows.reader[row] >= 0).any():
            raise PointRoleError(self.address, "watched", None, "move one that defines a curve")
        driver = int(state.rows.driver[row])
        if self.follow and driver >= 0:
            title = str(state.lines.name[state.line_of(driver)])
            raise PointRoleError(self.address, "driven", title, "move a point of its driver")
        found = np.zeros((state.rows.count, 3))
        found[row] = _along(state, row, self._axis(state, row))
        return found, None

    def _axis(self, state: HullState, row: int) -> int:
        free = free_axes(state, row)
        if self.axis is None and len(free) > 1:
            what = f"{self.address!r} is free along {', '.join(free)}"
            raise BadInputError(what, _WHERE, "say along which axis it moves")
        axis = free[0] if self.axis is None else choice(self.axis, "axis", AXES, _WHERE)
        if axis not in free:
            raise FreedomError(self.address, (axis,), free)
        return AXES.index(axis)


def _along(state: HullState, row: int, axis: int) -> FloatArray:
    """Give the direction in all planes of a point's lines whose component along an axis is 1."""
    lines = [state.line_of(each) for each in state.rows.curve[row].tolist() if each >= 0]
    normals = [state.lines.normal[line] for line in lines if state.lines.planar[line]]
    one: FloatArray = np.zeros(3)
    one[axis] = 1.0
    if not normals:
        return one
    # The least change of the others that stays in all planes.
    rest = np.arange(3) != axis
    matrix = np.array(normals)
    found, *_ = np.linalg.lstsq(matrix[:, rest], -matrix[:, axis], rcond=None)
    one[rest] = found
    return one


VectorField = Callable[[FloatArray], FloatArray]
"""From places (n, 3), m, to something for each."""


@attrs.frozen
class Deformation(TitledParameter, ShapeParameter):
    """A smooth field by which all defining points move.

    Planes of sections and waterlines may move along; the curves are lofted anew.

    Attributes
    ----------
    name : str
        What it is called.
    field : callable, (n, 3) m to (n, 3) m per unit
        How the points move.
    gradient : callable, (n, 3) m to (n, 3, 3) per unit, or None
        The derivative of component i of the field by coordinate j: by it, directions that are
        given at points and ends turn. None: they stay. Second derivatives that are given at
        ends stay in any case.
    unit : str
        Of the parameter.
    """

    name: str = attrs.field(validator=checked(text, _WHERE))
    field: VectorField
    gradient: VectorField | None = None
    unit: str = "-"

    def moves(self, state: HullState) -> tuple[FloatArray, FloatArray | None]:
        """Give how all points move, (n, 3), and the gradient there, (n, 3, 3), by row.

        Raises
        ------
        WrongTypeError, BadInputError
            No function, or one that gives something else than is wanted.
        """
        xyz = state.rows.xyz[: state.rows.count]
        used = np.asarray(np.isfinite(xyz).all(axis=1))
        turn = None if self.gradient is None else self._called(self.gradient, xyz, used, (3, 3))
        return self._called(self.field, xyz, used, (3,)), turn

    def _called(
        self,
        function: VectorField,
        xyz: FloatArray,
        used: NDArray[np.bool_],
        shape: tuple[int, ...],
    ) -> FloatArray:
        if not callable(function):
            raise WrongTypeError(f"{self.name!r} has no function", _WHERE, "give one of (n, 3)")
        found = np.zeros((len(xyz), *shape))
        given = np.asarray(function(xyz[used].copy()), np.float64)
        if given.shape != found[used].shape or not np.isfinite(given).all():
            what = f"{self.name!r} gives {given.shape}, or numbers that are not finite"
            raise BadInputError(what, _WHERE, f"give {found[used].shape}")
        found[used] = given
        return found


_IN_MOVES = "in Moves"


def _array(values: object, name: str, tail: tuple[int, ...]) -> FloatArray:
    """Take finite numbers (n, *tail), in memory of their own."""
    try:
        found = np.array(values, np.float64)
    except (TypeError, ValueError, OverflowError):
        found = np.full(1, np.nan)
    if found.ndim != 1 + len(tail) or found.shape[1:] != tail or not np.isfinite(found).all():
        wanted = f"(n, {', '.join(map(str, tail))})"
        what = f"{name} is {shown(values)}"
        raise BadInputError(what, _IN_MOVES, f"give finite numbers {wanted}, a row per point")
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
    >>> from assoc_hull.analysis.derivatives.parameters import Moves
    >>> from assoc_hull.analysis.derivatives.parameters import Rates
    >>> from assoc_hull.hull.sources import examples
    >>> hull = examples.wigley()
    >>> half = hull.state.rows.xyz.data * [0.0, 1.0, 0.0] / hull.particulars.breadth
    >>> wider = Moves("breadth", half, rates=Rates(breadth=1.0), unit="m")
    >>> found = hydrostatic_derivatives(hull, [wider], draught=6.25)
    >>> found.of("volume").round(2).tolist(), round(found.value.volume / 10.0, 2)
    ([277.75], 277.74)
    """

    name: str = attrs.field(validator=checked(text, _IN_MOVES))
    displacement: FloatArray = attrs.field(converter=_displacement)
    gradient: FloatArray | None = attrs.field(
        default=None, converter=attrs.converters.optional(_gradient)
    )
    rates: Rates = attrs.field(default=FIXED_DIMENSIONS)
    unit: str = "-"

    def __attrs_post_init__(self) -> None:
        instance(self.rates, Rates, "rates", _IN_MOVES)
        if self.gradient is not None and len(self.gradient) != len(self.displacement):
            what = f"gradient has {len(self.gradient)} rows, displacement {len(self.displacement)}"
            raise BadInputError(what, _IN_MOVES, "give a row per point in both")

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
            raise BadInputError(what, _IN_MOVES, "take the moves from this hull")
        return self.displacement, self.gradient
