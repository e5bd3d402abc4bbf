"""Names of outputs, their values and derivatives (fields of the record of hydrostatics only)."""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.analysis.derivatives import hydrostatic_derivatives
from assoc_hull.analysis.hydrostatics import hydrostatics
from assoc_hull.analysis.moves import Moves
from assoc_hull.analysis.parameters import DRAUGHT
from assoc_hull.analysis.record_fields import FIELDS
from assoc_hull.errors import UnknownNameError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.state import HullState

__all__ = ["Outputs"]


@attrs.frozen(eq=False)
class _Held:
    state: HullState


@attrs.frozen
class Outputs:
    """Outputs by name, at the design draught."""

    names: tuple[str, ...]

    @classmethod
    def of(cls, state: HullState, names: Sequence[str]) -> Outputs:
        """Take names."""
        for name in names:
            if name not in FIELDS:
                raise UnknownNameError("output", name, tuple(FIELDS))
        return cls(tuple(names))

    @property
    def units(self) -> tuple[str, ...]:
        """Their units."""
        return tuple(FIELDS[name].unit for name in self.names)

    def values(self, state: HullState) -> FloatArray:
        """Give values, (m,)."""
        found = hydrostatics(_Held(state), draught=state.particulars.draught)
        return np.array([getattr(found, name) for name in self.names], np.float64)

    def derivatives(
        self, state: HullState, shapes: Sequence[Moves]
    ) -> tuple[FloatArray, FloatArray]:
        """Give values, (m,), and derivatives, (m, k)."""
        found = hydrostatic_derivatives(
            _Held(state), [*shapes, DRAUGHT], draught=state.particulars.draught
        )
        values = np.array([getattr(found.value, name) for name in self.names], np.float64)
        whole = found.matrix(self.names)
        draught = np.array([each.rates.draught for each in shapes])
        return values, whole[:, :-1] + whole[:, -1:] * draught
