"""Appendages: what is added to a moulded hull by name, or taken from it."""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.arguments import checked, not_negative, number, place, text
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.floating.immersed import Immersed, Planes

__all__ = ["Appendage", "require_volume", "with_appendages"]

_WHERE = "in an appendage"


def _three(value: object) -> tuple[float, float, float]:
    """Take a place as three numbers."""
    x, y, z = place(value, "centroid", _WHERE).tolist()
    return x, y, z


@attrs.frozen
class Appendage:
    """A rudder, a bilge keel, a bow thruster's tunnel: listed apart in every table.

    It counts whole where the place of its centroid is under water, and else not at all.

    Attributes
    ----------
    name : str
        Of the appendage.
    volume : float, m3
        Of all of it, both sides; negative for a recess that the moulded hull encloses.
    centroid : (float, float, float), m
        x from AP, y + to port, z from the base line.
    area : float, m2
        That it adds to the wetted surface.

    Examples
    --------
    >>> from assoc_hull.analysis.hydrostatics.appendage import Appendage
    >>> Appendage("bow thruster tunnel", -12.5, (140.0, 0.0, 3.2), 31.0).volume
    -12.5
    """

    name: str = attrs.field(validator=checked(text, _WHERE))
    volume: float = attrs.field(validator=checked(number, _WHERE))
    centroid: tuple[float, float, float] = attrs.field(converter=_three)
    area: float = attrs.field(default=0.0, validator=checked(not_negative, _WHERE))

    def immersed(self, planes: Planes) -> NDArray[np.bool_]:
        """Tell below which planes its centroid lies, (d,)."""
        x, y, z = self.centroid
        wet: NDArray[np.bool_] = z < planes.height + planes.tan_trim * x - planes.tan_heel * y
        return wet


def with_appendages(
    immersed: Immersed, appendages: Sequence[Appendage], planes: Planes
) -> Immersed:
    """Add appendages to what is measured of a bare hull: to volume, moments and shell.

    Parameters
    ----------
    immersed : Immersed
        Below d planes.
    appendages : sequence of Appendage
        Each counts below the planes under which its centroid lies.
    planes : Planes
        The planes.
    """
    for each in appendages:
        x, y, z = each.centroid
        wet = each.immersed(planes)
        volume = np.where(wet, each.volume, 0.0)
        immersed = attrs.evolve(
            immersed,
            volume=immersed.volume + volume,
            moment_x=immersed.moment_x + volume * x,
            moment_y=immersed.moment_y + volume * y,
            moment_z=immersed.moment_z + volume * z,
            shell=immersed.shell + np.where(wet, each.area, 0.0),
        )
    return immersed


def require_volume(
    volume: FloatArray, appendages: Sequence[Appendage], planes: Planes, where: str
) -> None:
    """Refuse appendages that take away all of the hull.

    Parameters
    ----------
    volume : (d,), m3
        Of hull and appendages, below each plane.
    appendages : sequence of Appendage
        They.
    planes : Planes
        The planes.
    where : str
        For the error.

    Raises
    ------
    BadInputError
        Nothing is left below a plane.
    """
    if not appendages or (volume > 0.0).all():
        return
    k = int(np.argmin(volume))
    added = sum(each.volume * float(each.immersed(planes)[k]) for each in appendages)
    bare = float(volume[k]) - added
    what = f"appendages of {added:g} m3 leave nothing of the {bare:g} m3 of the bare hull"
    at = f"below z {float(planes.height[k]):g} m at AP"
    raise BadInputError(what, f"{where}, {at}", "give volumes that are a part of the hull's")
