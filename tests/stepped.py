"""Derivatives of hydrostatics by other ways: complex steps and central differences."""

from __future__ import annotations

from typing import Any

import attrs
import numpy as np

from assoc_hull.analysis.derivatives.hydrostatic_derivatives import TangentFlotation
from assoc_hull.analysis.derivatives.parameters import Parameter, Position, ShapeParameter
from assoc_hull.analysis.hydrostatics.floating_body import FloatingPosition, planes_of
from assoc_hull.analysis.hydrostatics.flotation import Flotation, flotation, header_of
from assoc_hull.analysis.hydrostatics.hull_hydrostatics import values_at
from assoc_hull.analysis.hydrostatics.record import FIELDS, HydrostaticHeader
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.model.network import curve_data
from assoc_hull.model.tables import HasState
from tests.complex_loft import as_batch

__all__ = ["Floats"]

STEP = 1e-100
KINKED = {"a_max", "x_a_max", "cx", "cp", "bwl", "lwl", "cb_lwl", "cp_lwl"}
"""What comes of a greatest value: several stations or breadths may be equally great."""

_FAR = {-2: 1.0 / 12.0, -1: -8.0 / 12.0, 1: 8.0 / 12.0, 2: -1.0 / 12.0}
_AHEAD = {1: -1.0, 2: 1.0}


@attrs.frozen(eq=False)
class Floats:
    """A hull at a floating position."""

    body: Flotation
    header: HydrostaticHeader
    position: FloatingPosition

    @classmethod
    def of(cls, hull: HasState, aft: float, fore: float, heel_deg: float, kg: float) -> Floats:
        """With a centre of gravity, so that no field lacks."""
        body = flotation(hull.state)
        terms: dict[str, object] = {
            "rho": 1.025, "shell_factor": 1.0, "kg": kg, "appendages": (),
        }  # fmt: skip
        return cls(body, header_of(hull, body, terms), FloatingPosition(aft, fore, heel_deg))

    def stepped(self, parameter: Parameter) -> dict[str, float]:
        """Derivatives by a complex step through everything, with a loft of its own."""
        plane = planes_of([self.position], self.header.length)
        if isinstance(parameter, Position):
            aft, fore, heel = parameter.rates
            turn = np.radians(heel) * (1.0 + plane.tan_heel**2)
            rates = aft, (fore - aft) / self.header.length, turn
            numbers: list[Any] = [
                number + 1j * STEP * rate
                for number, rate in zip(attrs.astuple(plane), rates, strict=True)
            ]
            values = values_at(self.body, FloatingPlanes(*numbers), self.header)
        else:
            values = values_at(self._varied(parameter, 1j * STEP), plane, self.header)
        return {name: float(np.imag(values[name][0])) / STEP for name in FIELDS}

    def central(self, parameter: Parameter, step: float) -> dict[str, float]:
        """Derivatives by differences of plain numbers; nan where there is a kink."""
        values = {i: self._at(parameter, i * step) for i in (-2, -1, 1, 2)}
        found = {}
        for name in FIELDS:
            far, ahead, back = (
                sum(weight * values[sign * i][name] for i, weight in rule.items()) / (sign * step)
                for rule, sign in ((_FAR, 1), (_AHEAD, 1), (_AHEAD, -1))
            )
            size = max(abs(far), abs(values[1][name]) * 1e-3)
            kink = name in KINKED and np.ptp([far, ahead, back]) > 1e-3 * size
            found[name] = np.nan if kink else far
        return found

    def _at(self, parameter: Parameter, amount: float) -> dict[str, float]:
        """The values where the parameter has changed by so much."""
        position, body = self.position, self.body
        if isinstance(parameter, Position):
            aft, fore, heel = (amount * rate for rate in parameter.rates)
            moved = FloatingPosition(
                position.draught_aft + aft, position.draught_fore + fore, position.heel_deg + heel
            )
            values = values_at(body, planes_of([moved], self.header.length), self.header)
        else:
            plane = planes_of([position], self.header.length)
            values = values_at(self._varied(parameter, amount), plane, self.header)
        return {name: float(value[0]) for name, value in values.items()}

    def _varied(self, parameter: Parameter, amount: complex) -> TangentFlotation:
        """The hull whose points have moved by a plain or complex amount."""
        assert isinstance(parameter, ShapeParameter)
        curve, state = self.body.net.curve, self.body.state
        row = np.concatenate([state.curves.rows[each] for each in curve.tolist()])
        data = curve_data(state, curve)
        points: Any = amount * parameter.moves(state)[0] + state.rows.xyz[: state.rows.count]
        plain = np.isrealobj(points)
        batch = loft(attrs.evolve(data, xyz=points[row])) if plain else as_batch(data, points[row])
        return TangentFlotation(self.body, batch, points)
