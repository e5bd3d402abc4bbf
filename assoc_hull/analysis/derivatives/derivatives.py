"""Exact derivatives of hydrostatics: the kernel's own sums, differentiated.

Everything runs through the same code as the values, on arrays that carry tangents
(`assoc_hull.geometry.numeric.dual`): the loft with its chord lengths, the surface, its cuts by the
plane, the places where the immersed part changes its kind, and the algebra of the record.

Reference: A. Griewank, A. Walther, "Evaluating Derivatives", 2nd ed., SIAM 2008, ch. 3
(forward mode).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType

import attrs
import numpy as np

from assoc_hull.analysis.derivatives.parameters import Parameter
from assoc_hull.analysis.derivatives.tangents import dots, tangents_by
from assoc_hull.analysis.hydrostatics.appendage import Appendage
from assoc_hull.analysis.hydrostatics.floating import planes_of
from assoc_hull.analysis.hydrostatics.flotation import Flotation, flotation
from assoc_hull.analysis.hydrostatics.hydrostatic_header import SALT, HydrostaticHeader
from assoc_hull.analysis.hydrostatics.hydrostatics import (
    DraughtTo,
    OnError,
    position_of,
    trusted_table,
)
from assoc_hull.analysis.hydrostatics.measured_hull import HasState, header_of, state_of
from assoc_hull.analysis.hydrostatics.record import Hydrostatics
from assoc_hull.analysis.hydrostatics.record_fields import FIELDS
from assoc_hull.arguments import all_of, choice
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.floating.immersed import Planes

__all__ = ["Derivatives", "hydrostatic_derivatives"]

_WHERE = "in hydrostatic_derivatives"


@attrs.frozen(eq=False)
class Derivatives:
    """Derivatives of a record of hydrostatics by k parameters.

    Attributes
    ----------
    value : Hydrostatics
        The record.
    names, units : tuple of k str
        The parameters and their units.
    columns : mapping of str to (k,)
        By field of the record: its derivatives, in its unit per unit of each parameter; nan
        where the record has no value.
    """

    value: Hydrostatics
    names: tuple[str, ...]
    units: tuple[str, ...]
    columns: Mapping[str, FloatArray]

    def __attrs_post_init__(self) -> None:
        freeze(*self.columns.values())

    def of(self, name: str) -> FloatArray:
        """Give the derivatives of one field of the record, (k,).

        Raises
        ------
        BadInputError
            The record has no such field.
        """
        return self.columns[choice(name, "the field", self.columns, _WHERE)]

    def matrix(self, names: Iterable[str]) -> FloatArray:
        """Give the derivatives of some fields, (n, k): a row each."""
        return np.stack([self.of(name) for name in names])


def hydrostatic_derivatives(
    hull: HasState,
    wrt: Iterable[Parameter],
    *,
    draught: float | None = None,
    draughts: tuple[float, float] | None = None,
    heel_deg: float = 0.0,
    rho: float = SALT,
    shell_factor: float = 1.0,
    kg: float | None = None,
    transom: bool = False,
    on_error: OnError = "refuse",
    appendages: Iterable[Appendage] = (),
    keel_thickness: float = 0.0,
    draught_to: DraughtTo = "moulded",
) -> Derivatives:
    """Differentiate the hydrostatics of a hull at one floating position.

    Parameters
    ----------
    hull : Hull
        The hull.
    wrt : iterable of k parameters
        By what: `DRAUGHT`, `TRIM`, `DRAUGHT_AFT`, `DRAUGHT_FORE` (m), `HEEL` (degree),
        `PointMove` (m), `Deformation`; of `assoc_hull.analysis.derivatives.parameters`; or `Moves`.
    draught, draughts, heel_deg, rho, shell_factor, kg, transom, on_error, appendages
        As for `hydrostatics`.
    keel_thickness, draught_to
        As for `hydrostatics`.

    Returns
    -------
    Derivatives
        The record, and its derivatives.

    Raises
    ------
    WrongTypeError, BadInputError, UnknownNameError, FreedomError, PointRoleError
        A parameter that cannot be used; else as `hydrostatics`.

    Notes
    -----
    Draughts, water, KG and appendages stay as they are, and so do Lpp and B but where a parameter
    has rates for them (`assoc_hull.analysis.derivatives.given_motion.Moves`). The layout of the
    surface is that of the hull as it stands; where a value has a kink (the largest station changes,
    a section begins to be wet) the derivative is that to one side.

    Examples
    --------
    >>> from assoc_hull.analysis.derivatives.derivatives import hydrostatic_derivatives
    >>> from assoc_hull.analysis.derivatives.parameters import DRAUGHT, PointMove
    >>> from assoc_hull.sources import examples
    >>> wrt = [DRAUGHT, PointMove("WL 2.5 x ST 7")]
    >>> found = hydrostatic_derivatives(examples.wigley(), wrt, draught=6.25)
    >>> found.of("volume").round(2).tolist(), round(found.value.waterplane_area, 2)
    ([666.63, 6.25], 666.63)
    """
    terms: dict[str, object] = {
        "rho": rho, "shell_factor": shell_factor, "kg": kg, "transom": transom,
        "appendages": appendages, "keel_thickness": keel_thickness,
    }  # fmt: skip
    body = flotation(state_of(hull))
    header = header_of(hull, body, terms)
    position = position_of(header, draught, draughts, heel_deg, draught_to)
    parameters = all_of(wrt, Parameter, "wrt", _WHERE)  # type: ignore[type-abstract]
    table = trusted_table(body, [position], header, (1, 1), on_error, estimate=False)
    plane = planes_of([position], header.length)
    return Derivatives(
        table[0],
        tuple(each.title for each in parameters),
        tuple(each.per for each in parameters),
        MappingProxyType(_differentiated(body, plane, header, parameters)),
    )


def _differentiated(
    body: Flotation, plane: Planes, header: HydrostaticHeader, wrt: Sequence[Parameter]
) -> dict[str, FloatArray]:
    """Give the derivatives, (k,) by field; nan where there is no value."""
    found = {name: np.zeros(len(wrt)) for name in FIELDS}
    for some in tangents_by(body, plane, header, wrt):
        for name, value in some.values.items():
            found[name][list(some.where)] = dots(value, some.count)
    return found
