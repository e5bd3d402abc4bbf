"""Whether a body made on the lines of a hull encloses what hydrostatics find of the same lines.

Meshes and surfaces fill the cells of the net in ways of their own, so that a volume which differs
tells of a wrong body, though it is closed and passes near all lines. Compared are volumes and their
centres below the design draught and below the lowest place of the deck edge, and the extent of the
lines. Of a half both sides are taken.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.flotation import Flotation, body_of_state, flotation
from assoc_hull.analysis.hydrostatics.section_areas import area_curve
from assoc_hull.analysis.net.curve_net import CurveNet
from assoc_hull.errors import AssocHullError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.geometry.patches.volume_below import integrate_below
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.geometry.surfaces.triangles import grid_triangles
from assoc_hull.model.tables import HullState
from assoc_hull.surface.cells.closed_mesh import BelowDraught, ClosedMesh, triangles_below
from assoc_hull.surface.cells.meshed_bodies import welded

__all__ = [
    "NOT_HELD",
    "Displaced",
    "displaced_of",
    "extent_faults",
    "mesh_below",
    "mesh_faults",
    "mesh_off",
    "surface_below",
    "surface_volume_faults",
    "volume_faults",
]

NOT_HELD = "not compared with hydrostatics, which were not had of its lines"
"""What is told of a body that there was nothing to hold against."""

_ALLOWED = 0.005
"""Volumes may differ by this part: five times what those of ships with waterlines do."""

_CENTRE = 1e-3
"""The centre of a volume may lie off by this part of the length: with `_ALLOWED` of the volume too
much in one place and as much too little in another, these are a fifth of the length apart."""

_BEYOND = 1e-3
"""A body may leave the extent of its lines by this part of the length."""

_ON_CENTRE = 1e-6
"""Places so near to the centre plane (lengths of the hull) lie in it."""

_FEW = 4
"""Chords to an edge that may be the reason, however near to their lines, on a slender hull."""

_REMEDY = "draw stations or waterlines there"

_PLACES = 101
"""Sections that are compared to find where volumes differ."""


@attrs.frozen(eq=False)
class Displaced:
    """What hydrostatics find of a hull below one level.

    Attributes
    ----------
    level : float, m
        Height of the plane above base.
    volume : float, m3
        Below it, of both sides.
    x : (n,), m
        Places along the ship.
    area : (n,), m2
        Of the sections there, of both sides.
    centre : (float, float), m
        x and z of the centre of the volume.
    """

    level: float
    volume: float
    x: FloatArray
    area: FloatArray
    centre: tuple[float, float]

    def __attrs_post_init__(self) -> None:
        freeze(self.x, self.area)


def displaced_of(state: HullState, *, tunnels: bool = True) -> tuple[Displaced, ...]:
    """Measure a hull by hydrostatics, below the design draught and below the deck edge.

    Less its tunnels, or with them. Nothing where hydrostatics cannot be had.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.surface.volume_check import displaced_of
    >>> [(each.level, round(each.volume)) for each in displaced_of(ah.examples.wigley().state)]
    [(6.25, 2777), (9.375, 4861)]
    """
    try:
        body = flotation(state)
        whole = body_of_state(state) if tunnels else body
        top = float(body.limits.deck[:, 2].min())
        levels = np.unique([min(state.particulars.draught, top), top])
        planes = FloatingPlanes(levels, 0.0 * levels, 0.0 * levels)
        found = whole.measure(planes)
        return tuple(
            _below(body, level, volume, (along / volume, up / volume))
            for level, volume, along, up in zip(
                levels.tolist(), found.volume.tolist(), found.moment_x.tolist(),
                found.moment_z.tolist(), strict=True,
            )
            if volume > 0.0
        )  # fmt: skip
    except (AssocHullError, ValueError, ArithmeticError):
        return ()  # such hulls have no reliable volume to be held against


def _below(body: Flotation, level: float, volume: float, centre: tuple[float, float]) -> Displaced:
    curve = area_curve(body, FloatingPlanes(np.array([level]), np.zeros(1), np.zeros(1)))
    edges = np.linspace(curve.low, curve.high, _PLACES + 1)
    x = 0.5 * (edges[1:] + edges[:-1])
    return Displaced(level, volume, x, curve.at(x), centre)


def volume_faults(
    displaced: Sequence[Displaced],
    volumes: Iterable[float],
    corners: FloatArray,
    sides: int,
    remedy: str = _REMEDY,
) -> tuple[str, ...]:
    """Say by how much volumes differ from those of hydrostatics, and where most; nothing if little.

    Parameters
    ----------
    displaced : sequence of Displaced
        By hydrostatics.
    volumes : iterable of float, m3
        Of the body below each level, of both sides.
    corners : (f, 3, 3), m
        Of triangles that follow it.
    sides : 1 or 2
        Of the ship that they are on.
    remedy : str
        What to do.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.surface.volume_check import Displaced, volume_faults
    >>> box = Displaced(2.0, 48.0, np.array([0.5, 1.5]), np.array([24.0, 24.0]), (1.0, 1.0))
    >>> volume_faults([box], [48.1], np.empty((0, 3, 3)), 2)
    ()
    """
    off = [
        (volume / each.volume - 1.0, volume, each)
        for each, volume in zip(displaced, volumes, strict=True)
    ]
    worst = max(off, key=lambda each: abs(each[0]), default=None)
    if worst is None or abs(worst[0]) <= _ALLOWED:
        return ()
    part, volume, found = worst
    here = np.array([_cut(corners, x, found.level) * (3 - sides) for x in found.x.tolist()])
    k = int(np.abs(here - found.area).argmax())
    return (
        f"it holds {volume:.2f} m3 below {found.level:.2f} m, where hydrostatics find "
        f"{found.volume:.2f} m3 on the same lines: {100.0 * part:+.2f} %; most is at x = "
        f"{found.x[k]:.2f} m, where its section has {here[k]:.2f} m2 and the lines "
        f"{found.area[k]:.2f} m2: {remedy}",
    )


def _centre_faults(
    displaced: Sequence[Displaced], centres: Iterable[tuple[float, float]]
) -> tuple[str, ...]:
    """Say how far centres (x, z), m, of right volumes lie from those of hydrostatics."""
    off: list[tuple[float, str]] = []
    for each, centre in zip(displaced, centres, strict=True):
        # Half a step lies beyond the first and the last place.
        length = float(np.ptp(each.x)) * len(each.x) / max(len(each.x) - 1, 1)
        for axis, allowed, mine, lines in zip(
            "xz", (_CENTRE * length, _ALLOWED * each.level), centre, each.centre, strict=True
        ):
            away = mine - lines
            off.append((
                abs(away) / max(allowed, 1e-300),
                f"the centre of what it holds below {each.level:.2f} m is at {axis} = {mine:.3f} "
                f"m, where hydrostatics find {lines:.3f} m on the same lines, {away:+.3f} m off, "
                f"though the volume agrees: it is too full in one place and too fine in another; "
                "draw more stations or waterlines",
            ))  # fmt: skip
    worst = max(off, default=None)
    return () if worst is None or worst[0] <= 1.0 else (worst[1],)


def _cut(corners: FloatArray, x: float, level: float) -> float:
    """Give the area (m2) below a level of the section that triangles have at x.

    What closes it, the centre plane of a half and the water, adds nothing to the integral of y dz.
    """
    ahead = corners[:, :, 0] > x
    cut = corners[ahead.any(axis=1) & ~ahead.all(axis=1)]
    step = np.roll(cut, -1, axis=1) - cut
    share = (x - cut[..., 0]) / np.where(step[..., 0] == 0.0, np.nan, step[..., 0])
    met = (cut[..., 0] > x) != (cut[..., 0] + step[..., 0] > x)
    place = (cut + share[..., None] * step)[met].reshape(-1, 2, 3)
    falls = ((np.roll(cut, -1, axis=1)[..., 0] > x) & met)[met].reshape(-1, 2)
    # From where the edge comes from aft to where it goes back: one sense for all triangles.
    place = np.where(falls[:, :1, None], place, place[:, ::-1])
    y, z = place[..., 1], np.minimum(place[..., 2], level)
    rise = place[:, 1, 2] - place[:, 0, 2]
    bent = np.divide(
        z - place[:, :1, 2], rise[:, None], out=np.zeros_like(z), where=rise[:, None] != 0
    )
    wet = y[:, :1] + bent * (y[:, 1:] - y[:, :1])
    return abs(float((0.5 * wet.sum(axis=1) * (z[:, 1] - z[:, 0])).sum()))


def mesh_faults(mesh: ClosedMesh, displaced: Sequence[Displaced], net: CurveNet) -> tuple[str, ...]:
    """Say where the mesh of a hull or of its port half, made on a net, is not that of its lines.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.analysis.net.curve_net import gather_net
    >>> from assoc_hull.surface.volume_check import displaced_of, mesh_faults
    >>> state = ah.examples.wigley().state
    >>> mesh_faults(ah.examples.wigley().mesh(), displaced_of(state), gather_net(state))
    ()
    """
    xyz = mesh.xyz[: mesh.report.vertices]
    corners = xyz[mesh.triangle[: mesh.report.triangles]]
    held = [mesh_below(mesh, each.level) for each in displaced]
    found = volume_faults(
        displaced,
        [each.volume for each in held],
        corners,
        1 if mesh.half else 2,
        _REMEDY if mesh.fine and mesh.steps > _FEW else f"give more points, or {_REMEDY}",
    ) or _centre_faults(displaced, [(each.lcb, each.vcb) for each in held])
    return (*found, *extent_faults(xyz, net))


def mesh_off(mesh: ClosedMesh, displaced: Sequence[Displaced]) -> float:
    """Tell by how much volumes of a mesh differ, of what is allowed."""
    parts = [abs(mesh_below(mesh, each.level).volume / each.volume - 1.0) for each in displaced]
    return max(parts, default=0.0) / _ALLOWED


def mesh_below(mesh: ClosedMesh, level: float) -> BelowDraught:
    """Give volume and centre of both sides below a level, of the mesh of a hull or of its half.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.surface.volume_check import mesh_below
    >>> hull = ah.examples.wigley(stations=9, waterlines=6)
    >>> mesh, half = hull.mesh(), hull.mesh(half=True)
    >>> round(mesh_below(half, 6.25).volume / mesh_below(mesh, 6.25).volume, 9)
    1.0
    """
    if not mesh.half:
        return mesh.below(level)
    xyz = mesh.xyz[: mesh.report.vertices].copy()
    # What is open there lies in the centre plane but for rounding.
    xyz[np.abs(xyz[:, 1]) <= _ON_CENTRE * float(np.ptp(xyz[:, 0])), 1] = 0.0
    face = mesh.triangle[: mesh.report.triangles]
    both = welded(
        np.concatenate([xyz, xyz * (1.0, -1.0, 1.0) + 0.0]),
        np.concatenate([face, face[:, ::-1] + len(xyz)]),
    )
    return triangles_below(both, level)


def surface_volume_faults(
    patches: Sequence[SplineSurface], held: Sequence[BelowDraught], displaced: Sequence[Displaced]
) -> tuple[str, ...]:
    """Say where the surface of a half hull, `held` below each level, is not that of its lines."""
    if all(
        abs(mine.volume / each.volume - 1.0) <= _ALLOWED
        for mine, each in zip(held, displaced, strict=True)
    ):
        return _centre_faults(displaced, [(each.lcb, each.vcb) for each in held])
    corners = np.concatenate([_followed(each) for each in patches])
    return volume_faults(displaced, [each.volume for each in held], corners, 1)


def _followed(patch: SplineSurface) -> FloatArray:
    """Give triangles that follow a patch, (f, 3, 3), m."""
    share = np.linspace(0.0, 1.0, _PLACES)
    u, v = (knots[0] + (knots[-1] - knots[0]) * share for knots in (patch.knots_u, patch.knots_v))
    return grid_triangles(patch.at(u[:, None], v[None, :])).corners


def surface_below(patches: Sequence[SplineSurface], level: float) -> BelowDraught:
    """Give volume and centre of both sides below a level."""
    found = integrate_below(patches, level)
    half, (along, up) = float(found.volume), found.moment.tolist()
    return BelowDraught(2.0 * half, along / half if half else 0.0, up / half if half else 0.0)


def extent_faults(xyz: FloatArray, net: CurveNet) -> tuple[str, ...]:
    """Say how far a body leaves the box around its lines, and where; nothing if little.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.analysis.net.curve_net import gather_net
    >>> from assoc_hull.surface.volume_check import extent_faults
    >>> hull = ah.examples.wigley()
    >>> extent_faults(hull.mesh().xyz, gather_net(hull.state))
    ()
    """
    lines = np.concatenate([sample(net.batch, 8)[1], net.batch.xyz])
    low, high = lines.min(axis=0), lines.max(axis=0)
    low[1] = -high[1]
    away = np.maximum(low - xyz, xyz - high)
    place, axis = np.unravel_index(int(away.argmax()), away.shape)
    if away[place, axis] <= _BEYOND * (high[0] - low[0]):
        return ()
    where = "({:.2f}, {:.2f}, {:.2f})".format(*xyz[place].tolist())
    return (f"it reaches {away[place, axis]:.3f} m beyond all lines, at {where}: draw lines there",)
