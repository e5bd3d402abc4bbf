"""A ship whose half-breadths are a formula: what aiming can be tried on without a hull.

With u from the largest section to an end and s from keel to draught, both from 0 to 1, they are
B/2 {(1 - u^n) (1 - (1 - s)^q) + e u (1 - u) s^2}: n fore and aft of their own, e the flare. All is
summed by Gauss's rule, and derivatives are complex steps of the sums.
"""

from collections.abc import Callable

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray

PARENT = {
    "breadth": 20.0, "draught": 7.0, "length": 120.0, "fore": 3.0, "aft": 2.2, "fullness": 6.0,
    "flare": 0.2,
}  # fmt: skip
"""m; exponents of fore and after body and of sections; flare."""

USUAL = {
    "breadth": 0.3, "draught": 0.1, "length": 1.0, "fore": 0.2, "aft": 0.2, "fullness": 0.5,
    "flare": 0.05,
}  # fmt: skip
OUTPUTS = ("volume", "lcb", "kmt", "cw", "a_m")
UNITS = ("m3", "m", "m", "", "m2")


_nodes, _weights = np.polynomial.legendre.leggauss(16)
U, DU = 0.5 * _nodes + 0.5, 0.5 * _weights


def ship(values: np.ndarray) -> np.ndarray:
    """Volume, LCB from midship, KM_T, C_W, area of the largest section, (5,); of values (7,)."""
    B, T, L, fore, aft, q, flare = values
    deep, flared = 1.0 - (1.0 - U) ** q, U**2
    volume = moment = rise = area = inertia = 0.0
    for n, side in (fore, 1.0), (aft, -1.0):
        f, h = 1.0 - U**n, flare * U * (1.0 - U)
        sections = B * T * (f * (deep @ DU) + h * (flared @ DU))
        lifts = B * T**2 * (f * ((deep * U) @ DU) + h * ((flared * U) @ DU))
        breadths = B * (f + h)
        volume += 0.5 * L * (sections @ DU)
        moment += side * 0.25 * L**2 * ((sections * U) @ DU)
        rise += 0.5 * L * (lifts @ DU)
        area += 0.5 * L * (breadths @ DU)
        inertia += 0.5 * L / 12.0 * (breadths**3 @ DU)
    kmt = (rise + inertia) / volume
    return np.array([volume, moment / volume, kmt, area / (L * B), B * T * (deep @ DU)])


@attrs.frozen(eq=False)
class Formula:
    """The ship at some amplitudes."""

    values: FloatArray
    jacobian: FloatArray


@attrs.define(eq=False)
class FormulaShip:
    """The ship as a problem of aiming; counts how often it is looked at.

    Attributes
    ----------
    free, outputs : tuple of str
        Of `PARENT` and `OUTPUTS`.
    allowed : callable
        Whether there is a certified hull at the parameters, (7,).
    """

    free: tuple[str, ...]
    outputs: tuple[str, ...] = OUTPUTS
    allowed: Callable[[FloatArray], bool] = lambda _: True
    looks: int = 0

    def at(self, amplitudes: FloatArray) -> Formula:
        """Evaluate the formulas; outside what is allowed there is no hull."""
        self.looks += 1
        values = np.array(list(PARENT.values()))
        columns = [list(PARENT).index(name) for name in self.free]
        values[columns] += amplitudes
        if not self.allowed(values):
            raise BadInputError("the map folds", "in the ship", "ask for less")
        rows = [OUTPUTS.index(name) for name in self.outputs]
        jacobian = np.empty((len(rows), len(columns)))
        for j, column in enumerate(columns):
            stepped = values.astype(complex)
            stepped[column] += 1e-30j
            jacobian[:, j] = ship(stepped)[rows].imag / 1e-30
        return Formula(ship(values)[rows], jacobian)

    @property
    def usual(self) -> FloatArray:
        """Usual changes of what is free, (k,)."""
        return np.array([USUAL[name] for name in self.free])

    @property
    def parent(self) -> FloatArray:
        """Outputs of the ship as it is, (m,)."""
        return ship(np.array(list(PARENT.values())))[[OUTPUTS.index(name) for name in self.outputs]]

    @property
    def sizes(self) -> FloatArray:
        """Sizes of the outputs, (m,)."""
        full = dict(zip(OUTPUTS, ship(np.array(list(PARENT.values()))), strict=True))
        full["lcb"] = PARENT["length"]
        return np.array([full[name] for name in self.outputs])
