"""Tunnels that a hull holds: cylinders athwartships, told by axis and radius alone.

Where a tunnel meets the shell lies in no table. It is computed of the lines as they are, so it
follows every edit: `assoc_hull.analysis.hydrostatics.tunnel` measures it.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.arguments import checked, number, plain, positive, word
from assoc_hull.geometry.curves import FloatArray

__all__ = ["TunnelDefinition"]

_WHERE = "in a tunnel"


@attrs.frozen
class TunnelDefinition:
    """A tunnel athwartships, from shell to shell.

    Attributes
    ----------
    name : str
        What it is called.
    x, z, radius : float, m
        As `Hull.tunnel` takes them.

    Examples
    --------
    >>> from assoc_hull.model.tunnel_definition import TunnelDefinition
    >>> TunnelDefinition("bow thruster", 88.0, 3.0, 0.8).radius
    0.8
    """

    name: str = attrs.field(validator=checked(word, _WHERE))
    x: float = attrs.field(converter=plain, validator=checked(number, _WHERE))
    z: float = attrs.field(converter=plain, validator=checked(number, _WHERE))
    radius: float = attrs.field(converter=plain, validator=checked(positive, _WHERE))

    @property
    def carriers(self) -> FloatArray:
        """The middle of its axis, (1, 3), m: the place that a mapping of space carries."""
        return np.array([[self.x, 0.0, self.z]])

    def carried(self, places: FloatArray) -> TunnelDefinition:
        """Give it where a mapping took that place; it stays athwartships, its radius as it is."""
        x, _, z = (places[0] + 0.0).tolist()
        return attrs.evolve(self, x=x, z=z)

    @property
    def summary(self) -> str:
        """What it is in a line, but for its name."""
        return f"{2.0 * self.radius:.6g} m across at x {self.x:.6g}, z {self.z:.6g} m"
