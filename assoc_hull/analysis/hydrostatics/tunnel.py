"""A thruster's tunnel: a cylinder athwartships, and what it takes from the hull and when it floats.

All is measured on waterlines that are cut for it, as `half_breadth` cuts them: the mouth is where
the cylinder meets the shell as it is now, so it follows the hull whenever it is asked for anew. The
disc is integrated along chords z = z0 + r cos t by Gauss's rule in t and along x: exact to rounding
where the half-breadth is a polynomial of low degree.

A floating body with the tunnels of its hull taken off, as far as each is immersed.

Volume, moments, waterplane and its moments, wetted surface and the areas of stations are less by
what of each tunnel lies below the plane. The girth, the deck, the transom and the extent of the
waterplane stay those of the hull.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from types import MappingProxyType

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.floating_body import (
    Appendage,
    FloatingBody,
    IntegralChange,
    StationAreas,
    WaterplaneLimits,
)
from assoc_hull.analysis.hydrostatics.immersed_tunnel import ImmersedTunnel, MouthShape, disc_places
from assoc_hull.arguments import number, positive, text
from assoc_hull.errors import BadInputError, NoMeetingError
from assoc_hull.geometry.curves import FloatArray, SplineBatch, freeze
from assoc_hull.geometry.floating.immersion import FloatingPlanes, ImmersedIntegrals
from assoc_hull.geometry.numeric.quadrature import gauss
from assoc_hull.geometry.splines.plane_intersections import intersect_planes
from assoc_hull.graph.derived import Objects
from assoc_hull.model.half_breadth import half_breadth_rows, half_breadths
from assoc_hull.model.tables import HasState, HullState, state_of
from assoc_hull.model.tunnel_definition import TunnelDefinition

__all__ = ["Tunnel", "TunnelledBody", "kept_mouths", "kept_tunnels", "measure_tunnel", "mouth_of"]

_COUNT, _FINER = 16, 24
"""Places of the rule along each way of the disc; the finer one tells how far off the other is."""

_AROUND = 64
"""Points of a mouth; the integral around it converges faster than any power of them."""

_STEP = 1e-3
"""Slopes over the height are differences over this part of the radius to either side."""

_WHERE = "in tunnel"


@attrs.frozen(eq=False)
class Tunnel:
    """What a tunnel athwartships takes from a hull; x from AP, y + to port, z from the base line.

    Attributes
    ----------
    name : str
        Of the tunnel.
    x, z, radius : float, m
        Of its axis, and inner radius.
    volume : float, m3
        Of the hull that it takes, shell to shell.
    error : float, m3
        How far the volume may be off, by a coarser rule.
    centroid : (float, float, float), m
        Of that volume.
    wall : float, m2
        Of the cylinder within the hull.
    opening : float, m2
        Of the shell that both mouths take, by its true element.
    mouth : (64, 3), m
        The mouth to port, a closed curve: the first point follows the last. From the foremost
        point upward; that to starboard is its mirror image.
    sections : mapping of str to float, m2
        By name, the stations that it cuts, and what it takes of their areas, both sides.
    shape : MouthShape
        The shell around the mouth, of which `hydrostatics` takes what is immersed.
    """

    name: str
    x: float
    z: float
    radius: float
    volume: float
    error: float
    centroid: tuple[float, float, float]
    wall: float
    opening: float
    mouth: FloatArray
    sections: Mapping[str, float]
    shape: MouthShape = attrs.field(repr=False)

    def __attrs_post_init__(self) -> None:
        freeze(self.mouth)

    @cached_property
    def immersed(self) -> ImmersedTunnel:
        """The tunnel as planes cut it."""
        return ImmersedTunnel(self.shape)

    @property
    def appendage(self) -> Appendage:
        """For `hydrostatics(appendages=...)`: the volume is negative, walls less openings count."""
        return Appendage(self.name, -self.volume, self.centroid, self.wall - self.opening)

    def gap(self, *, x: float | None = None, z: float | None = None) -> tuple[float, float] | None:
        """Give the gap that it leaves in a section at x, or in a waterline at z.

        Parameters
        ----------
        x : float or None, m
            Of a section: given are the least and the largest z.
        z : float or None, m
            Of a waterline: given are the least and the largest x.

        Returns
        -------
        (float, float) or None, m
            None for a line that it does not cut.

        Raises
        ------
        BadInputError
            Both were given, or none.
        """
        if (x is None) == (z is None):
            raise BadInputError("x and z", "in gap", "give one of them: x of a section, or z")
        place, at, middle = (x, self.x, self.z) if x is not None else (z, self.z, self.x)
        away = number(place, "x" if x is not None else "z", "in gap") - at
        if abs(away) >= self.radius:
            return None
        half = float(np.sqrt(self.radius**2 - away**2))
        return middle - half, middle + half

    def __str__(self) -> str:
        return (
            f"{self.name}: {2.0 * self.radius:g} m across at x {self.x:g}, z {self.z:g} m: "
            f"{self.volume:.6g} m3, wall {self.wall:.6g} m2, openings "
            f"{self.opening:.6g} m2"
        )


def measure_tunnel(hull: HasState, name: str, x: float, z: float, radius: float) -> Tunnel:
    """Measure a tunnel athwartships through a hull.

    Parameters
    ----------
    hull : Hull
        The hull, as it is now.
    name : str
        What the tunnel is called.
    x, z : float, m
        Of its axis, from AP and from the base line.
    radius : float, m
        Of its inside.

    Returns
    -------
    Tunnel

    Raises
    ------
    BadInputError
        The cylinder leaves the hull: below, above, before, behind, or where the hull has no
        breadth.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.analysis.hydrostatics.tunnel import measure_tunnel
    >>> found = measure_tunnel(ah.examples.wigley(), "bow thruster", 88.0, 3.0, 0.8)
    >>> print(found)
    bow thruster: 1.6 m across at x 88, z 3 m: 6.15981 m3, wall 15.3104 m2, openings 4.28877 m2
    """
    state = state_of(hull, _WHERE)
    text(name, "name", _WHERE)
    x, z = number(x, "x", _WHERE), number(z, "z", _WHERE)
    return _measured(state, name, x, z, positive(radius, "radius", _WHERE))


def kept_tunnels(state: HullState) -> tuple[Tunnel, ...]:
    """Measure the tunnels that a hull holds, by name; anew only where a line has changed.

    Raises
    ------
    BadInputError
        One leaves the hull: no edit makes such a hull.
    """
    if not state.tunnels:
        return ()

    def measure() -> tuple[Tunnel, ...]:
        return tuple(_measured(state, *attrs.astuple(each)) for each in state.tunnels)

    return state.derived(("tunnels",), _depends_on(state), measure, most=2)


def kept_mouths(state: HullState) -> tuple[FloatArray | BadInputError, ...]:
    """Give the mouth to port of each tunnel that a hull holds; an error of one that leaves it."""

    def measure() -> tuple[FloatArray | BadInputError, ...]:
        return tuple(_mouth_or_error(state, each) for each in state.tunnels)

    return state.derived(("tunnel mouths",), _depends_on(state), measure, most=2)


def _mouth_or_error(state: HullState, each: TunnelDefinition) -> FloatArray | BadInputError:
    try:
        return mouth_of(state, *attrs.astuple(each))
    except BadInputError as error:
        return error


def _depends_on(state: HullState) -> tuple[object, ...]:
    """Give what the shell around tunnels depends on."""
    splines = [state.spline(curve) for curve in state.live("curves").tolist()]
    return (
        Objects(splines), state.tunnels, state.tolerances, state.curves.line, state.lines.boundary,
        state.lines.group, state.lines.offset, tuple(state.lines.name.data),
    )  # fmt: skip


def _measured(state: HullState, name: str, x: float, z: float, radius: float) -> Tunnel:
    mouth = mouth_of(state, name, x, z, radius)
    shape = _shape(state, x, z, radius, _FINER)
    coarse, fine = (_disc(each) for each in (_shape(state, x, z, radius, _COUNT), shape))
    volume = float(fine[0])
    wall = 2.0 * radius * (2.0 * np.pi / _AROUND) * float(mouth[:, 1].sum())
    centroid = (float(fine[1]) / volume, 0.0, float(fine[2]) / volume)
    sections = MappingProxyType(_sections(state, shape))
    return Tunnel(
        name, x, z, radius, volume, abs(volume - float(coarse[0])), centroid, wall,
        float(fine[3]), mouth, sections, shape,
    )  # fmt: skip


def mouth_of(state: HullState, name: str, x: float, z: float, radius: float) -> FloatArray:
    """Give the mouth to port of a cylinder, (64, 3), m; see `Tunnel.mouth`.

    Raises
    ------
    BadInputError
        It leaves the hull, with the place.
    """
    angle = np.linspace(0.0, 2.0 * np.pi, _AROUND, endpoint=False)
    rim = np.column_stack(
        [x + radius * np.cos(angle), np.zeros(_AROUND), z + radius * np.sin(angle)]
    )
    # Level by level, from the foremost place upward: of one level the place ahead and that abaft.
    rows = np.arange(-_AROUND // 4, _AROUND // 4 + 1)
    pairs = np.stack([rows % _AROUND, (_AROUND // 2 - rows) % _AROUND], axis=1)
    try:
        breadth, _ = half_breadth_rows(state, rim[pairs, 0], rim[pairs[:, 0], 2])
    except NoMeetingError:
        breadth = np.array([[_breadth_or_none(state, rim[i]) for i in pair] for pair in pairs])
    rim[pairs, 1] = breadth
    least, most = _heights(state, rim[:, 0])
    out = rim[(rim[:, 1] <= 0.0) | (rim[:, 2] <= least) | (rim[:, 2] >= most)]
    if len(out):
        # Told is the middle of the arc that is outside: there it is farthest out, or nearly.
        away = np.abs(out - out.mean(axis=0)).sum(axis=1)
        here = out[int(away.argmin())]
        at = f"{name!r} leaves the hull at x {here[0]:.4g}, z {here[2]:.4g} m"
        what = at + _how_far_out(state, float(here[0]), float(here[2]))
        remedy = "give a smaller radius, or an axis farther inside the hull"
        raise BadInputError(what, _WHERE, remedy)
    return rim


def _how_far_out(state: HullState, x: float, z: float) -> str:
    """Say how far a place of the centre plane lies below, above or beyond a hull, as a clause."""
    xyz = state.rows.xyz[state.live("rows")]
    low, high = float(xyz[:, 0].min()), float(xyz[:, 0].max())
    if not low < x < high:
        side, end = ("abaft", low) if x <= low else ("ahead of", high)
        return f", {abs(x - end):.4g} m {side} its end"
    least, most = (float(each[0]) for each in _heights(state, np.array([x])))
    if z >= most:
        return f", {z - most:.4g} m above its deck edge"
    if z <= least:
        return f", {least - z:.4g} m below its profile"
    return ", beyond its profile"


def _heights(state: HullState, x: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give from which to which height boundary curves reach at x (n,), m; nan where there are none.

    A waterline that is cut above a deck with sheer runs on between fore and aft body, where there
    is no hull.
    """
    curves = state.live("curves")
    bounds = curves[state.lines.boundary[state.curves.line[curves]] >= 0]
    least, most = np.full(len(x), np.nan), np.full(len(x), np.nan)
    if len(bounds):
        planes, which = np.unique(x, return_inverse=True)
        batch = SplineBatch.join([state.spline(each) for each in bounds.tolist()])
        met = intersect_planes(batch, np.eye(3)[0], planes)
        low, high = np.full(len(planes), np.nan), np.full(len(planes), np.nan)
        np.fmin.at(low, met.plane, met.xyz[:, 2])
        np.fmax.at(high, met.plane, met.xyz[:, 2])
        least, most = low[which], high[which]
    return least, most


def _breadth_or_none(state: HullState, place: FloatArray) -> float:
    """Give the half-breadth at a place, m; zero where the hull does not come."""
    try:
        return float(half_breadths(state, place[:1], float(place[2]))[0][0])
    except NoMeetingError:
        return 0.0


def _shape(state: HullState, x: float, z: float, radius: float, count: int) -> MouthShape:
    """Take the shell around the mouth, on as many chords and places of each."""
    at, level = disc_places(x, z, radius, count)
    breadth, slope = half_breadth_rows(state, at, level)
    step = _STEP * radius
    above, below = (half_breadth_rows(state, at, level + way)[0] for way in (step, -step))
    steep = (above - below) / (2.0 * step)
    return MouthShape(x, z, radius, breadth, np.sqrt(1.0 + slope * slope + steep * steep))


def _disc(shape: MouthShape) -> FloatArray:
    """Integrate over the disc: volume, its moments in x and z, m3, m4, and opening, m2."""
    count = len(shape.breadth)
    at, level = disc_places(shape.x, shape.z, shape.radius, count)
    node, weight = gauss(count)
    half = shape.radius * np.sin(np.pi * node)[:, None]
    # From one side to the other in turn and along the chord, port and starboard.
    strip = 2.0 * (np.pi * weight)[:, None] * half * half * (2.0 * weight)
    parts = shape.breadth, shape.breadth * at, shape.breadth * level[:, None], shape.element
    return np.array([float((strip * each).sum()) for each in parts])


def _sections(state: HullState, shape: MouthShape) -> dict[str, float]:
    """Give what it takes of the areas of the stations that it cuts, m2, both sides, along x."""
    lines, found = state.lines, list[tuple[float, str, float]]()
    node, weight = gauss(_FINER)
    for line in state.live("lines").tolist():
        upright = state.family(line).name == "sections" and lines.planar[line]
        at = float(lines.offset[line])
        if not upright or lines.normal[line, 0] != 1.0 or abs(at - shape.x) >= shape.radius:
            continue
        half = float(np.sqrt(shape.radius**2 - (at - shape.x) ** 2))
        level = shape.z + half * (2.0 * node - 1.0)
        breadth, _ = half_breadth_rows(state, np.full((len(level), 1), at), level)
        area = 4.0 * half * float((weight * breadth[:, 0]).sum())
        found.append((at, str(lines.name[line]), area))
    return {name: area for _, name, area in sorted(found)}


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
