"""Bodies that hydrostatics knows by formula: what a table of a hull is tested on without one."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.floating_body import (
    IntegralChange,
    StationAreas,
    WaterplaneLimits,
)
from assoc_hull.analysis.hydrostatics.record import HydrostaticHeader
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.floating.immersed_strips import PreparedStrips, prepare_strips
from assoc_hull.geometry.floating.immersion import (
    FloatingPlanes,
    ImmersedIntegrals,
    integrate_immersed,
)
from tests import exact_hulls

__all__ = ["Box", "StripBody", "Wigley", "box_body", "ellipsoid_body", "head", "wigley_body"]

NODES, WEIGHTS = np.polynomial.legendre.leggauss(3)


def head(length: float, breadth: float, draught: float, **given: object) -> HydrostaticHeader:
    """A head for a body: salt water, bare hull, no KG, but for what is given."""
    facts: dict[str, object] = {
        "ship": "Body", "length": length, "breadth": breadth, "draught": draught, "rho": 1.025,
        "shell_factor": 1.0, "kg": None, "keel_thickness": 0.0, "transom": False,
        "deck": "closed", "appendages": (), "fingerprint": "0",
    }  # fmt: skip
    return HydrostaticHeader(**(facts | given))  # type: ignore[arg-type]


@attrs.frozen
class Box:
    """A box from x = 0; planes cut its four walls, neither bottom nor deck.

    The integrals are those of polynomials over its plan, which three Gauss points do exactly.
    """

    length: float = 100.0
    breadth: float = 20.0
    depth: float = 12.0
    off: float = 0.0
    """Every integral is off by this part, for tests of the estimate."""
    closed: bool = True
    trouble: tuple[str, ...] = ()

    @property
    def limits(self) -> WaterplaneLimits:
        side = np.array([[x, 0.5 * self.breadth, 0.0] for x in (0.0, self.length)])
        return WaterplaneLimits(side, side + np.array([0.0, 0.0, self.depth]), self.closed)

    def measure(self, planes: FloatingPlanes) -> ImmersedIntegrals:
        x = 0.5 * self.length * (1.0 + NODES)[:, None]
        y = 0.5 * self.breadth * NODES[None, :]
        da = 0.25 * self.length * self.breadth * WEIGHTS[:, None] * WEIGHTS[None, :]
        tt, th = planes.tan_trim[:, None, None], planes.tan_heel[:, None, None]
        h = planes.height[:, None, None] + tt * x - th * y
        plan = np.ones_like(h)

        def over(value: FloatArray) -> FloatArray:
            found: FloatArray = (value * da).sum(axis=(1, 2))
            return found

        middle = planes.height + 0.5 * self.length * planes.tan_trim
        shell = self.length * (self.breadth + 2.0 * middle)
        ones = np.ones(len(middle))
        return ImmersedIntegrals(
            over(h), over(x * h), over(y * h), over(0.5 * h * h), over(plan), over(x * plan),
            over(y * plan), over(x * x * plan), over(x * y * plan), over(y * y * plan),
            shell, shell.copy(), 0.0 * ones, 0.0 * ones, self.length * ones,
            -0.5 * self.breadth * ones, 0.5 * self.breadth * ones,
        )  # fmt: skip

    def stations(self, planes: FloatingPlanes) -> StationAreas:
        x = np.linspace(0.0, self.length, 21)
        area = self.breadth * (planes.height[:, None] + planes.tan_trim[:, None] * x)
        return StationAreas(x, area, tuple(f"ST {k}" for k in range(21)))

    def transom(self, planes: FloatingPlanes) -> FloatArray:
        """Both ends."""
        return self.breadth * (2.0 * planes.height + planes.tan_trim * self.length)

    def changes(self, planes: FloatingPlanes) -> Sequence[IntegralChange]:
        sums = self.measure(planes)
        off = {
            each.name: self.off * getattr(sums, each.name)
            for each in attrs.fields(ImmersedIntegrals)
        }
        stations, transom = self.stations(planes), self.transom(planes)
        return [
            IntegralChange(ImmersedIntegrals(**off), self.off * stations.area, self.off * transom)
        ]

    def doubts(self, planes: FloatingPlanes, numbers: bool = True) -> Sequence[str]:
        return self.trouble


@attrs.frozen
class Wigley:
    """The Wigley hull at even keel up to its draught, in closed form; no wetted surface."""

    length: float = 100.0
    breadth: float = 10.0
    depth: float = 6.25

    @property
    def limits(self) -> WaterplaneLimits:
        x = np.linspace(0.0, self.length, 3)
        keel = np.stack([x, 0.0 * x, 0.0 * x], axis=1)
        return WaterplaneLimits(keel, keel + np.array([0.0, 0.0, self.depth]), closed=False)

    def measure(self, planes: FloatingPlanes) -> ImmersedIntegrals:
        assert not planes.tan_trim.any()
        assert not planes.tan_heel.any()
        length, breadth, t = self.length, self.breadth, planes.height / self.depth
        full = 2.0 * t - t * t  # half-breadth at the plane, of B / 2
        volume = 2.0 / 3.0 * length * breadth * self.depth * (t * t - t**3 / 3.0)
        up = 2.0 / 3.0 * length * breadth * self.depth**2 * (2.0 / 3.0 * t**3 - 0.25 * t**4)
        area = 2.0 / 3.0 * length * breadth * full
        zero, x, ends = 0.0 * t, 0.5 * length, np.zeros(len(t))
        xx = area * x * x + breadth * full * length**3 / 30.0
        yy = 16.0 / 35.0 * (breadth * full) ** 3 * length / 12.0
        return ImmersedIntegrals(
            volume, volume * x, zero, up, area, area * x, zero.copy(), xx, zero.copy(), yy,
            np.full(len(t), 1487.906310), np.full(len(t), 1480.0), zero.copy(), ends,
            ends + length, -0.5 * breadth * full, 0.5 * breadth * full,
        )  # fmt: skip

    def stations(self, planes: FloatingPlanes) -> StationAreas:
        x = np.linspace(0.0, self.length, 21)
        along = 1.0 - (2.0 * x / self.length - 1.0) ** 2
        t = planes.height / self.depth
        up = self.breadth * self.depth * (t * t - t**3 / 3.0)
        return StationAreas(x, up[:, None] * along, tuple(f"ST {k}" for k in range(21)))

    def transom(self, planes: FloatingPlanes) -> FloatArray:
        return 0.0 * planes.height

    def changes(self, planes: FloatingPlanes) -> Sequence[IntegralChange]:
        return []

    def doubts(self, planes: FloatingPlanes, numbers: bool = True) -> Sequence[str]:
        return []


@attrs.frozen(eq=False)
class StripBody:
    """Strips of an exact hull; its one station is amidships and has no area."""

    strips: PreparedStrips
    limits: WaterplaneLimits

    @classmethod
    def of(cls, strips: PreparedStrips, half_breadth: float, top: float) -> StripBody:
        """A body 100 m long whose deck edge is taken to be straight."""
        x = np.array([[0.0, 0.0, 0.0], [100.0, 0.0, 0.0]])
        return cls(strips, WaterplaneLimits(x, x + np.array([0.0, half_breadth, top]), closed=True))

    def measure(self, planes: FloatingPlanes) -> ImmersedIntegrals:
        return integrate_immersed(self.strips, planes)

    def stations(self, planes: FloatingPlanes) -> StationAreas:
        return StationAreas(np.array([50.0]), np.zeros((len(planes.height), 1)), ("ST 10",))

    def transom(self, planes: FloatingPlanes) -> FloatArray:
        return 0.0 * planes.height

    def changes(self, planes: FloatingPlanes) -> Sequence[IntegralChange]:
        return []

    def doubts(self, planes: FloatingPlanes, numbers: bool = True) -> Sequence[str]:
        return []


@cache
def wigley_body() -> StripBody:
    """Wigley's hull, wall-sided to 12.5 m; it has no deck, so nothing may come near to it."""
    return StripBody.of(prepare_strips(exact_hulls.wigley()), 5.0, 12.5)


@cache
def ellipsoid_body() -> StripBody:
    """The ellipsoid; what a plane must lie between are the corners of the box around it."""
    places = np.array([[x, 8.0, z] for x in (0.0, 100.0) for z in (0.0, 12.0)])
    return StripBody(
        prepare_strips(exact_hulls.ellipsoid()),
        WaterplaneLimits(places, places.copy(), closed=True),
    )


@cache
def box_body(closed: bool = True) -> StripBody:
    """The box of 100 x 20 x 12 m."""
    low = np.array([[0.0, 10.0, 0.0], [100.0, 10.0, 0.0]])
    limits = WaterplaneLimits(low, low + np.array([0.0, 0.0, 12.0]), closed)
    return StripBody(prepare_strips(exact_hulls.box()), limits)
