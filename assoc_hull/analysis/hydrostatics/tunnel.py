"""A thruster's tunnel: a cylinder athwartships through the hull, and what it takes from it.

All is measured on waterlines that are cut for it, as `half_breadth` cuts them: the mouth is where
the cylinder meets the shell as it is now, so it follows the hull whenever it is asked for anew. The
disc is integrated along chords z = z0 + r cos t by Gauss's rule in t and along x: exact to rounding
where the half-breadth is a polynomial of low degree.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.floating_body import Appendage
from assoc_hull.arguments import number, positive, text
from assoc_hull.errors import BadInputError, NoMeetingError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.numeric.quadrature import gauss
from assoc_hull.model.half_breadth import half_breadths
from assoc_hull.model.tables import HasState, HullState, state_of

__all__ = ["Tunnel", "measure_tunnel"]

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

    def __attrs_post_init__(self) -> None:
        freeze(self.mouth)

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
    radius = positive(radius, "radius", _WHERE)
    mouth = _mouth(state, x, z, radius, name)
    coarse, fine = (_disc(state, x, z, radius, count) for count in (_COUNT, _FINER))
    volume = float(fine[0])
    wall = 2.0 * radius * (2.0 * np.pi / _AROUND) * float(mouth[:, 1].sum())
    centroid = (float(fine[1]) / volume, 0.0, float(fine[2]) / volume)
    sections = MappingProxyType(_sections(state, x, z, radius))
    return Tunnel(
        name, x, z, radius, volume, abs(volume - float(coarse[0])), centroid, wall,
        float(fine[3]), mouth, sections,
    )  # fmt: skip


def _mouth(state: HullState, x: float, z: float, radius: float, name: str) -> FloatArray:
    """Give the mouth to port, (n, 3), m; refuse where there is no hull."""
    angle = np.linspace(0.0, 2.0 * np.pi, _AROUND, endpoint=False)
    found = np.column_stack(
        [x + radius * np.cos(angle), np.zeros(_AROUND), z + radius * np.sin(angle)]
    )
    for here in found:
        try:
            here[1] = half_breadths(state, here[:1], float(here[2]))[0][0]
        except NoMeetingError:
            here[1] = 0.0
        if here[1] <= 0.0:
            what = f"{name!r} leaves the hull at x {here[0]:.4g}, z {here[2]:.4g} m"
            remedy = "give a smaller radius, or an axis farther inside the hull"
            raise BadInputError(what, _WHERE, remedy)
    return found


def _rule(count: int) -> tuple[FloatArray, FloatArray]:
    """Give places and weights of Gauss's rule from -1 to 1, (n,) each."""
    node, weight = gauss(count)
    return 2.0 * node - 1.0, 2.0 * weight


def _disc(state: HullState, x: float, z: float, radius: float, count: int) -> FloatArray:
    """Integrate over the disc: volume, its moments in x and z, m3, m4, and opening, m2."""
    node, weight = _rule(count)
    turn = 0.5 * np.pi * (1.0 + node)
    total = np.zeros(4)
    for angle, share in zip(turn.tolist(), (0.5 * np.pi * weight).tolist(), strict=True):
        half, level = radius * np.sin(angle), z + radius * np.cos(angle)
        at = x + half * node
        breadth, slope = half_breadths(state, at, level)
        step = _STEP * radius
        above, below = (half_breadths(state, at, level + way)[0] for way in (step, -step))
        steep = (above - below) / (2.0 * step)
        strip = 2.0 * share * half * half * weight
        total += [
            float((strip * breadth).sum()),
            float((strip * breadth * at).sum()),
            float((strip * breadth).sum()) * level,
            float((strip * np.sqrt(1.0 + slope * slope + steep * steep)).sum()),
        ]
    return total


def _sections(state: HullState, x: float, z: float, radius: float) -> dict[str, float]:
    """Give what it takes of the areas of the stations that it cuts, m2, both sides, along x."""
    lines, found = state.lines, list[tuple[float, str, float]]()
    node, weight = _rule(_FINER)
    for line in state.live("lines").tolist():
        upright = state.family(line).name == "sections" and lines.planar[line]
        at = float(lines.offset[line])
        if not upright or lines.normal[line, 0] != 1.0 or abs(at - x) >= radius:
            continue
        half = float(np.sqrt(radius**2 - (at - x) ** 2))
        breadth = [half_breadths(state, np.array([at]), z + half * each)[0][0] for each in node]
        found.append((at, str(lines.name[line]), 2.0 * half * float((weight * breadth).sum())))
    return {name: area for _, name, area in sorted(found)}
