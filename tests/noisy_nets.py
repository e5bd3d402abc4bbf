"""Nets with known noise: a fixed series of numbers along the freedom of points, by their keys."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.analysis.fairness.batten_problem import BattenProblem
from assoc_hull.edit.displacement_field import SolvedField
from assoc_hull.edit.field_moves import FieldMoves
from assoc_hull.edit.net_battens import net_battens
from assoc_hull.edit.transaction import Transaction
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.fairness.inflections import inflections
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.hull import Hull
from assoc_hull.model.network import curve_data
from assoc_hull.model.tables import HullState


def uniform_noise(count: int, width: float) -> FloatArray:
    """Numbers between -width and width, the same each time."""
    number = np.arange(1.0, count + 1.0)
    part = np.modf(np.modf(43758.5453 * np.sin(12.9898 * number))[0] + 1.0)[0]
    noise: FloatArray = width * (2.0 * part - 1.0)
    return noise


def rms(values: FloatArray) -> float:
    """The root of the mean square."""
    return float(np.sqrt((values**2).mean()))


def sign_changes(state: HullState, xyz: FloatArray | None = None, lobe: float = 0.2) -> IntArray:
    """Changes of the sign of curvature of each curve, with the points elsewhere if given."""
    curves = state.live("curves")
    line = state.curves.line[curves]
    normals = np.where(state.lines.planar[line][:, None], state.lines.normal[line], np.nan)
    if xyz is None:
        batch = SplineBatch.join([state.spline(each) for each in curves.tolist()])
    else:
        row = np.concatenate([state.curves.rows.data[each] for each in curves.tolist()])
        batch = loft(attrs.evolve(curve_data(state, curves), xyz=xyz[row]))
    return inflections(batch, normals, lobe)[0]


@attrs.frozen(eq=False)
class NoisyNet:
    """A net, noise at its points, and the problem that fairing is given.

    `error` (k,), m, is the noise along the normal of the hull.
    """

    state: HullState
    clean: BattenProblem
    problem: BattenProblem
    error: FloatArray

    @classmethod
    def of(cls, hull: Hull, width: float) -> NoisyNet:
        """Put uniform noise of a half width, m, along the freedom of all points that can move."""
        clean = net_battens(hull.state)
        return cls.with_noise(hull.state, uniform_noise(len(clean.rows), width))

    @classmethod
    def with_noise(cls, state: HullState, noise: FloatArray) -> NoisyNet:
        """Put given noise (k,), m, along the freedom of the points."""
        clean = net_battens(state)
        error = noise * clean.freedom
        return cls(state, clean, clean.shifted(error), error)

    def left(self, displacement: FloatArray) -> float:
        """What part of the error is left."""
        return rms(self.error + displacement) / rms(self.error)

    def computed_left(self, displacement: FloatArray) -> float:
        """The same of points that are computed from curves."""
        moved = np.flatnonzero(np.diff(self.clean.rates.indptr))
        rates = self.clean.rates[np.setdiff1d(moved, self.clean.rows)]
        return rms(rates @ (self.error + displacement)) / rms(rates @ self.error)

    def excess(self, displacement: FloatArray, lobe: float) -> tuple[int, int, int]:
        """Changes of sign that the clean net has not, noisy and faired; and those that are lost."""
        given = self.state.rows.xyz.data
        true, noisy, fair = (
            sign_changes(self.state, self.clean.places(given, each), lobe)
            for each in (0.0 * displacement, self.error, self.error + displacement)
        )
        more, less = np.maximum(fair - true, 0).sum(), np.maximum(true - fair, 0).sum()
        return int(np.maximum(noisy - true, 0).sum()), int(more), int(less)


def put_noise(hull: Hull, width: float) -> BattenProblem:
    """Displace the points of a hull by noise, in one edit; give the problem of the clean net."""
    clean = net_battens(hull.state)
    error = uniform_noise(len(clean.rows), width) * clean.freedom
    with Transaction(hull.document, "noise") as edit:
        field = SolvedField(clean.rows, clean.moves * error[:, None])
        edit.pending.ask(FieldMoves).fields.append(field)
    return clean


def error_left(clean: BattenProblem, before: FloatArray, hull: Hull) -> float:
    """How far the points lie from where they were, along the normal of the hull, rms, m."""
    step = hull.state.rows.xyz[clean.rows] - before[clean.rows]
    square = (clean.moves**2).sum(axis=1)
    return rms((step * clean.moves).sum(axis=1) / square)
