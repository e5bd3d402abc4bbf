"""How good a mesh of panels is: what a seakeeping code would stumble over."""

from __future__ import annotations

import math
from collections.abc import Iterator

import attrs
import numpy as np

from assoc_hull.arguments import instance
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.surfaces.panel_mesh import PanelMesh, PanelOrigin

__all__ = ["FreeEdges", "PanelReport", "PanelStatistics", "panel_report"]

_GRAVITY = 9.80665
_PER_WAVE = 6.0
"""So many diagonals of the largest panel go on the shortest wave that is worth computing."""

_SMALL = 1e-6
"""A panel of a smaller part of the mean area has none."""


@attrs.frozen
class PanelStatistics:
    """How a number is spread over the panels: least, median, 95 of 100, most."""

    least: float
    median: float
    p95: float
    most: float

    @classmethod
    def of(cls, values: FloatArray) -> PanelStatistics:
        """Take the values of all panels, (p,)."""
        low, middle, high, most = np.percentile(values, [0.0, 50.0, 95.0, 100.0]).tolist()
        return cls(low, middle, high, most)

    def words(self, digits: int = 3) -> str:
        """Give it in words."""
        values = (self.median, self.p95, self.most)
        return "median {}, 95 % below {}, most {}".format(*(f"{x:.{digits}g}" for x in values))


@attrs.frozen
class FreeEdges:
    """Edges of one panel only, by where they lie.

    Attributes
    ----------
    waterline : int
        In the water surface z = 0.
    mirror : int
        In a plane of symmetry: the image closes them.
    below, above : int
        Elsewhere: the mesh is open there, or neighbours do not go round the same way.
    """

    waterline: int
    mirror: int
    below: int
    above: int


@attrs.frozen
class PanelReport:
    """What a mesh is, and how good.

    Attributes
    ----------
    title : str
        Of the mesh.
    panels, triangles, vertices : int
        As many as there are, mirror images not counted.
    images : int
        Of how many parts the whole consists.
    volume : (float, float, float), m3
        Of the whole, by the fluxes of x, y and z.
    area : float, m2
        Of the whole.
    buoyancy : (float, float, float), m
        Its centre of volume.
    aspect : PanelStatistics
        Of each panel the longer over the shorter mean of opposite sides; of a triangle the
        longest side over the height on it.
    warp : PanelStatistics
        Distance of corners from the mean plane, over the root of the area.
    size : PanelStatistics, m
        Root of the area.
    diagonal : float, m
        The largest of all panels.
    degenerate : int
        Panels without area.
    edges : FreeEdges
        Where it is open.
    above : int
        Panels with a corner above the water.
    origin : PanelOrigin or None
        What it was made of, with the exact values, if that is known.
    """

    title: str
    panels: int
    triangles: int
    vertices: int
    images: int
    volume: tuple[float, float, float]
    area: float
    buoyancy: tuple[float, float, float]
    aspect: PanelStatistics
    warp: PanelStatistics
    size: PanelStatistics
    diagonal: float
    degenerate: int
    edges: FreeEdges
    above: int
    origin: PanelOrigin | None

    @property
    def watertight(self) -> bool:
        """It is closed but for the water surface."""
        return self.edges.below == 0 and self.edges.above == 0

    @property
    def outward(self) -> bool:
        """Normals point out of the hull: it is closed, and its volume positive."""
        return self.watertight and min(self.volume) > 0.0

    @property
    def volume_error(self) -> float | None:
        """Volume less the exact one, as a part of that; None if that is not known."""
        if self.origin is None:
            return None
        return sum(self.volume) / 3.0 / self.origin.volume - 1.0

    @property
    def area_error(self) -> float | None:
        """Area less the exact one, as a part of that; None if that is not known."""
        return None if self.origin is None else self.area / self.origin.area - 1.0

    @property
    def centre_error(self) -> float | None:
        """Distance of the centre of buoyancy from the exact one, m; None if not known."""
        if self.origin is None:
            return None
        return float(np.sqrt(((np.array(self.buoyancy) - self.origin.centre) ** 2).sum()))

    @property
    def shortest_wave(self) -> float:
        """Length of the shortest wave worth computing, m: six diagonals of the largest panel."""
        return _PER_WAVE * self.diagonal

    @property
    def highest_frequency(self) -> float:
        """Of that wave in deep water, rad/s."""
        return math.sqrt(2.0 * math.pi * _GRAVITY / self.shortest_wave)

    def as_dict(self) -> dict[str, object]:
        """Give all of it as what JSON can say, with what follows from it."""
        found = attrs.asdict(self, recurse=True)
        if self.origin is not None:
            found["origin"]["centre"] = self.origin.centre.tolist()
        for name in (
            "watertight", "outward", "volume_error", "area_error", "centre_error",
            "shortest_wave", "highest_frequency",
        ):  # fmt: skip
            found[name] = getattr(self, name)
        return found

    def lines(self) -> Iterator[tuple[str, str]]:
        """Give it as pairs of a title and words."""
        yield "mesh", self.title or "without a title"
        whole = f", {self.images} times by mirroring" if self.images > 1 else ", the whole hull"
        yield "panels", f"{self.panels}, {self.triangles} of them triangles{whole}"
        yield "vertices", str(self.vertices)
        yield "volume", " ".join(f"{each:.3f}" for each in self.volume) + " m3, by x, y and z"
        yield "area", f"{self.area:.3f} m2"
        yield "centre", "x {:.3f} m, y {:.3f} m, z {:.3f} m".format(*self.buoyancy)
        yield from self._against()
        yield "size", f"{self.size.words()} m, root of the area"
        yield "aspect", self.aspect.words()
        yield "warp", f"{self.warp.words()} of the size"
        yield "degenerate", str(self.degenerate)
        yield from self._edges()
        wave = f"{self.shortest_wave:.2f} m, {self.highest_frequency:.3f} rad/s in deep water"
        yield "waves", f"down to {wave}: six diagonals of the largest panel"

    def _against(self) -> Iterator[tuple[str, str]]:
        exact = self.origin
        if exact is None:
            return
        yield "exact", f"{exact.volume:.3f} m3, {exact.area:.3f} m2"
        yield (
            "error",
            f"volume {100.0 * (self.volume_error or 0.0):+.4f} %, "
            f"area {100.0 * (self.area_error or 0.0):+.4f} %, "
            f"centre {self.centre_error or 0.0:.4f} m",
        )
        where = f"x forward from {exact.x:g} m before AP, y to port, z up from the water surface"
        yield "axes", where

    def _edges(self) -> Iterator[tuple[str, str]]:
        edges = self.edges
        yield (
            "free edges",
            f"{edges.waterline} in the water surface, {edges.mirror} in planes of symmetry, "
            f"{edges.below} elsewhere below, {edges.above} above",
        )
        yield "watertight", "yes" if self.watertight else "no: the mesh is open, see free edges"
        if self.watertight:
            yield "normals", "out of the hull" if self.outward else "INTO the hull: turn them"
        else:
            yield "normals", "cannot be told of an open mesh"
        if self.above:
            yield "dry", f"{self.above} panels reach above the water: cut the mesh at z = 0"

    def __str__(self) -> str:
        return "\n".join(f"{title:<12}{words}" for title, words in self.lines())


def panel_report(mesh: PanelMesh) -> PanelReport:
    """Judge a mesh.

    Parameters
    ----------
    mesh : PanelMesh
        One that was made of a hull, or read from a file.

    Returns
    -------
    PanelReport
        ``print`` shows it.

    Examples
    --------
    >>> from assoc_hull.analysis.panels.hull_panels import panels
    >>> from assoc_hull.analysis.panels.mesh_quality import panel_report
    >>> from assoc_hull.hull.sources import examples
    >>> report = panel_report(panels(examples.wigley(), count=500))
    >>> report.watertight, report.outward, round(100 * report.volume_error, 2)
    (True, True, -0.31)
    """
    instance(mesh, PanelMesh, "the mesh", "in panel_report")
    small = mesh.areas <= _SMALL * max(float(mesh.areas.mean()), 1e-300)
    aspect, warp, diagonal = _shapes(mesh)
    good = ~small if (~small).any() else np.ones(mesh.count, np.bool_)
    x, y, z = mesh.volumes.tolist()
    cx, cy, cz = mesh.buoyancy.tolist()
    return PanelReport(
        title=mesh.title,
        panels=mesh.count,
        triangles=int(mesh.triangle.sum()),
        vertices=len(mesh.xyz),
        images=mesh.images,
        volume=(x, y, z),
        area=mesh.area,
        buoyancy=(cx, cy, cz),
        aspect=PanelStatistics.of(aspect[good]),
        warp=PanelStatistics.of(warp[good]),
        size=PanelStatistics.of(np.sqrt(mesh.areas)),
        diagonal=float(diagonal.max()),
        degenerate=int(small.sum()),
        edges=_free(mesh),
        above=int((mesh.xyz[:, 2][mesh.panel] > 0.0).any(axis=1).sum()),
        origin=mesh.origin,
    )


def _free(mesh: PanelMesh) -> FreeEdges:
    """Count free edges by where they lie."""
    ends = mesh.xyz[mesh.free_edges()]
    flat = (ends == 0.0).all(axis=1)
    mirror = (flat[:, 0] & mesh.mirror_x) | (flat[:, 1] & mesh.mirror_y)
    water = flat[:, 2] & ~mirror
    rest = ~(mirror | water)
    above = rest & (ends[:, :, 2] > 0.0).any(axis=1)
    return FreeEdges(
        int(water.sum()), int(mirror.sum()), int((rest & ~above).sum()), int(above.sum())
    )


def _shapes(mesh: PanelMesh) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give aspect ratio, warp and longest diagonal or side of each panel, (p,)."""
    corner = mesh.xyz[mesh.panel]
    side = np.sqrt(((np.roll(corner, -1, axis=1) - corner) ** 2).sum(axis=2))
    first, second = 0.5 * (side[:, 0] + side[:, 2]), 0.5 * (side[:, 1] + side[:, 3])
    longest = side.max(axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        quad = np.maximum(first, second) / np.minimum(first, second)
        triangle = longest**2 / (2.0 * mesh.areas)
        off = np.abs(((corner - mesh.centre[:, None]) * mesh.normal[:, None]).sum(axis=2))
        warp = off.max(axis=1) / np.sqrt(mesh.areas)
    cross = corner[:, [2, 3]] - corner[:, [0, 1]]
    diagonal = np.maximum(np.sqrt((cross**2).sum(axis=2)).max(axis=1), longest)
    return np.where(mesh.triangle, triangle, quad), warp, diagonal
