"""A floating body with the tunnels of its hull taken off, as far as each is immersed.

Volume, moments, waterplane and its moments, wetted surface and the areas of stations are less by
what of each tunnel lies below the plane. The girth, the deck, the transom and the extent of the
waterplane stay those of the hull.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.floating_body import (
    FloatingBody,
    IntegralChange,
    StationAreas,
    WaterplaneLimits,
)
from assoc_hull.analysis.hydrostatics.immersed_tunnel import ImmersedTunnel
from assoc_hull.analysis.hydrostatics.tunnel import Tunnel
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.floating.immersion import FloatingPlanes, ImmersedIntegrals

__all__ = ["TunnelledBody"]


@attrs.frozen(eq=False)
class TunnelledBody:
    """A hull with tunnels through it; implements `FloatingBody`.

    Attributes
    ----------
    body : FloatingBody
        The hull without them.
    tunnels : tuple of Tunnel
        Through it.
    """

    body: FloatingBody
    tunnels: tuple[Tunnel, ...]

    @property
    def limits(self) -> WaterplaneLimits:
        """What a waterplane must lie between, and the deck edge."""
        return self.body.limits

    @property
    def assumed(self) -> tuple[str, ...]:
        """What is taken of the hull that no line shows."""
        found: tuple[str, ...] = getattr(self.body, "assumed", ())
        return found

    @property
    def _cut(self) -> tuple[ImmersedTunnel, ...]:
        return tuple(each.immersed for each in self.tunnels)

    def measure(self, planes: FloatingPlanes) -> ImmersedIntegrals:
        """Give the integrals below each plane."""
        found = self.body.measure(planes)
        for each in self._cut:
            less = each.measure(planes)
            found = attrs.evolve(
                found, **{name: getattr(found, name) - value for name, value in less.items()}
            )
        return found

    def stations(self, planes: FloatingPlanes) -> StationAreas:
        """Give the areas of the stations below each plane, less the holes."""
        found = self.body.stations(planes)
        area, _ = self.holes(found.x, planes)
        return StationAreas(found.x.copy(), found.area - area, found.names)

    def holes(self, x: FloatArray, planes: FloatingPlanes) -> tuple[FloatArray, FloatArray]:
        """Give what tunnels take of sections at x (n,): areas, m2, and moments of z, m3, (d, n)."""
        area, moment = (np.zeros((len(planes.height), len(x))) for _ in range(2))
        for each in self._cut:
            for i in np.flatnonzero(np.abs(x - each.shape.x) < each.shape.radius).tolist():
                less, turned = each.section_areas(float(x[i]), planes)
                area[:, i] += less
                moment[:, i] += turned
        return area, moment

    def transom(self, planes: FloatingPlanes) -> FloatArray:
        """Give the area of transoms below each plane, (d,), m2; a tunnel ends in no transom."""
        return self.body.transom(planes)

    def changes(self, planes: FloatingPlanes) -> Sequence[IntegralChange]:
        """Give by how much the integrals may be off: those of the hull, and of each tunnel."""
        known = tuple(self.body.changes(planes))
        count, stations = len(planes.height), len(self.body.stations(planes).x)
        none = {each.name: np.zeros(count) for each in attrs.fields(ImmersedIntegrals)}
        off = []
        for tunnel, cut in zip(self.tunnels, self._cut, strict=True):
            part = cut.measure(planes)["volume"] / tunnel.volume * tunnel.error
            moved = dict(zip(("moment_x", "moment_y", "moment_z"), tunnel.centroid, strict=True))
            immersed = {name: part * at for name, at in moved.items()} | {"volume": part}
            off.append(
                IntegralChange(
                    ImmersedIntegrals(**{**none, **immersed}),
                    np.zeros((count, stations)), np.zeros(count),
                )
            )  # fmt: skip
        return (*known, *off)

    def doubts(self, planes: FloatingPlanes, numbers: bool = True) -> Sequence[str]:
        """Name what makes the integrals doubtful; `numbers` compares them by other routes too."""
        return self.body.doubts(planes, numbers)
