"""What a classical definition says of itself, and how far a net of it goes along.

The numbers of a definition are its own: exact areas, integrated along the ship. Beside them stand
those of the net, if there is one, and how far the lines of the net leave the curves of the
definition: between given points the kernel's lines are smooth where the definition may only be
continuous.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.flotation import flotation
from assoc_hull.arguments import instance, text
from assoc_hull.display import ShownAsText
from assoc_hull.errors import BadInputError, UnknownNameError
from assoc_hull.geometry.curves import FloatArray, SplineBatch, freeze
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.geometry.integrals.area_moments import line_integral
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.model.tables import HullState

__all__ = [
    "ClassicalReport",
    "DefinedSection",
    "Departure",
    "NetMeasure",
    "ReportFigure",
    "departures",
    "measure_net",
    "with_net_figures",
]


@attrs.frozen
class ReportFigure:
    """One number of a definition.

    Attributes
    ----------
    name : str
        What it is.
    value : float
        By the definition.
    unit : str
        m, m2, m3, rad or nothing.
    net : float or None
        The same of the net, if it was measured.
    error : float or None
        How far the value may be off where it was integrated by rule; None where it is exact.
    """

    name: str
    value: float
    unit: str
    net: float | None = None
    error: float | None = None


@attrs.frozen
class Departure:
    """How far a section of the net leaves the curve of the definition.

    Attributes
    ----------
    name : str
        The line.
    distance : float, m
        The largest distance of a place of the definition's curve from the net's.
    area, net : float, m2
        Between curve and centre plane, one side, by the definition and by the net.
    """

    name: str
    distance: float
    area: float
    net: float


@attrs.frozen(repr=False)
class ClassicalReport(ShownAsText):
    """What a definition says of itself.

    Attributes
    ----------
    kind, title : str
        Kind of definition, name of the ship.
    figures : tuple of ReportFigure
        Its numbers.
    notes : tuple of str
        What was moved, left out or looked odd.
    departures : tuple of Departure
        Of the sections of a net, if there is one.
    """

    kind: str
    title: str
    figures: tuple[ReportFigure, ...]
    notes: tuple[str, ...] = ()
    departures: tuple[Departure, ...] = ()

    def figure(self, name: str) -> ReportFigure:
        """Give a number by its name.

        Raises
        ------
        UnknownNameError
            There is none.
        """
        wanted = text(name, "name", "in a report of a definition")
        for each in self.figures:
            if each.name == wanted:
                return each
        raise UnknownNameError("figure", wanted, tuple(each.name for each in self.figures))

    @property
    def worst(self) -> Departure | None:
        """The section that leaves its curve the farthest, None without any."""
        return max(self.departures, key=lambda each: each.distance, default=None)

    def as_dict(self) -> dict[str, Any]:
        """Give all of it as plain values, for JSON."""
        return attrs.asdict(self)

    def __str__(self) -> str:
        beside = any(each.net is not None for each in self.figures)
        lines = [f"{self.kind} {self.title}"]
        lines += [_row(each, beside) for each in self.figures]
        if (worst := self.worst) is not None:
            change = max(self.departures, key=lambda each: abs(each.net - each.area))
            lines += [
                f"{len(self.departures)} sections: the net leaves the definition by up to "
                f"{1e3 * worst.distance:.2f} mm (at {worst.name}); their half areas differ by up "
                f"to {change.net - change.area:+.4f} m2 (at {change.name}, "
                f"{change.area:.3f} m2)"
            ]
        return "\n".join([*lines, *(f"note: {each}" for each in self.notes)]) + "\n"


def _row(each: ReportFigure, beside: bool) -> str:
    row = f"  {each.name:42}{each.value:16.6f} {each.unit:4}"
    if beside and each.net is not None:
        part = f" ({each.net / each.value - 1.0:+.1e})" if each.value else ""
        row += f" net {each.net:16.6f}{part}"
    if each.error is not None:
        row += f"  +-{each.error:.1e}"
    return row.rstrip()


@attrs.frozen
class NetMeasure:
    """What a net has below a level plane, both sides.

    Attributes
    ----------
    volume : float, m3
        Of displacement.
    x, z : float, m
        Its centre, from AP and from the base line.
    area : float, m2
        Of the waterplane.
    """

    volume: float
    x: float
    z: float
    area: float


def measure_net(state: HullState, height: float) -> NetMeasure:
    """Measure a net below a height (m) above the base line.

    Examples
    --------
    >>> from assoc_hull.creation.classical.report import measure_net
    >>> from assoc_hull.shipped.wigley import wigley
    >>> found = measure_net(wigley(), 6.25)
    >>> round(found.volume), round(found.x, 6)
    (2777, 50.0)
    """
    instance(state, HullState, "state", "in a report of a definition")
    plane = FloatingPlanes(np.array([height]), np.zeros(1), np.zeros(1))
    found = flotation(state).measure(plane)
    volume = float(found.volume[0])
    return NetMeasure(
        volume,
        float(found.moment_x[0]) / volume,
        float(found.moment_z[0]) / volume,
        float(found.area[0]),
    )


def with_net_figures(
    figures: Callable[[HullState | None], Iterable[ReportFigure]], state: HullState | None
) -> tuple[tuple[ReportFigure, ...], tuple[str, ...]]:
    """Give figures with those of a net beside them; a note instead if the net cannot be measured.

    `figures` gives the figures of a definition, and those of a net where it is handed one.
    """
    try:
        return tuple(figures(state)), ()
    except BadInputError as error:
        return tuple(figures(None)), (f"the net cannot be measured: {error.what}",)


@attrs.frozen(eq=False)
class DefinedSection:
    """A section as a definition has it.

    Attributes
    ----------
    name : str
        Of the line in the net.
    points : (n, 3), m
        Places on the definition's curve, close together.
    area : float, m2
        Between the curve and the centre plane, one side: the integral of y dz.
    """

    name: str
    points: FloatArray
    area: float

    def __attrs_post_init__(self) -> None:
        freeze(self.points)


def departures(state: HullState, sections: Sequence[DefinedSection]) -> tuple[Departure, ...]:
    """Report how far the lines of a net leave the curves of a definition.

    Sections whose line the net lacks are left out.
    """
    names = {state.lines.name[line]: line for line in state.live("lines").tolist()}
    found = []
    for each in sections:
        if each.name not in names:
            continue
        curves = state.lines.curves[names[each.name]]
        batch = SplineBatch.join([state.spline(curve) for curve in curves])
        away = [closest_points(batch, k, each.points)[2] for k in range(batch.count)]
        area = float(line_integral(batch, (1, 0), (1, 2), along=1).sum())
        farthest = float(np.min(away, axis=0).max())
        found.append(Departure(each.name, farthest, each.area, area))
    return tuple(found)
