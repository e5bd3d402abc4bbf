"""Ends that a file does not have: sections alone may stop before the hull does.

Beyond the last section hydrostatics go on by straight lines to a perpendicular, or end flat where
nothing tells of one. Both may be right, as at a transom; what it costs if they are not is told.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.record import Hydrostatics
from assoc_hull.analysis.net.surface_layout import BROAD_END
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.splines.evaluation import sample
from assoc_hull.io.importing.verdict import Findings
from assoc_hull.model.address import AddressBook
from assoc_hull.model.tables import HullState

__all__ = ["examine_ends"]

_VOLUME, _SURFACE = 5e-4, 5e-3
"""An end is told where more of V or of S may hang on it: so closely imports are to be right."""

_CLOSED = 2e-3
"""Lines that reach this part of Lpp beyond a section close the hull there."""

_FINE = 16


@attrs.frozen
class _LastSection:
    """The last section at an end: its place, what is immersed of it, and how far the hull goes on.

    `area` (m2) and `girth` (m) are of both sides below the water, `broad` (m) there, `half` of the
    whole section; `beyond` is where a perpendicular puts the end, `spacing` the distance of the
    section before it, `drawn` tells whether lines along the ship end here.
    """

    name: str
    fore: bool
    x: float
    area: float
    girth: float
    broad: float
    half: float
    beyond: float
    spacing: float
    drawn: bool

    @property
    def reach(self) -> float:
        """How far the hull may go on, m."""
        return abs(self.beyond - self.x) or self.spacing

    @property
    def part(self) -> float:
        """Of what lies within reach, how much may be wrong: half where it is closed by lines."""
        return 0.5 if self.beyond != self.x else 1.0


def examine_ends(state: HullState, record: Hydrostatics | None, found: Findings) -> None:
    """Suspect the ends of a hull whose profile is not drawn, where sections stop before it does."""
    if record is None:
        return
    widest = max(float(state.spline(c).xyz[:, 1].max()) for c in state.live("curves").tolist())
    ends = []
    for fore in (False, True):
        end = _last_section(state, record.draught_mean, fore=fore)
        if end is None or (not fore and end.drawn and end.half >= BROAD_END * widest):
            continue  # an end aft that is broad, be it over the water, is a transom
        volume, surface = end.area * end.reach, end.girth * end.reach
        if volume > _VOLUME * record.volume or surface > _SURFACE * record.wetted_surface:
            ends.append(end)
    if ends:
        _tell(ends, record, found)


def _tell(ends: list[_LastSection], record: Hydrostatics, found: Findings) -> None:
    taken = [
        f"{'forward of' if end.fore else 'abaft'} {end.name}, still {end.broad:.4g} m broad in the "
        "water, " + (
            f"it is closed by straight lines to the perpendicular, x = {end.beyond:.6g} m"
            if end.beyond != end.x else "it ends flat"
        )
        for end in ends
    ]  # fmt: skip
    volume = sum(end.part * end.area * end.reach for end in ends) / record.volume
    surface = sum(end.part * end.girth * end.reach for end in ends) / record.wetted_surface
    what = (
        f"nothing tells how the hull ends: {'; '.join(taken)}; V may be off by "
        f"{100.0 * volume:.2g} % and S by {100.0 * surface:.2g} %: give the profile, or sections "
        "as far as the ends; or length= and ap= if it ends at the perpendiculars"
    )
    where = " and ".join(f"{end.name} at x = {end.x:.6g} m" for end in ends)
    found.suspect("open end", where, what, volume)


def _last_section(state: HullState, draught: float, *, fore: bool) -> _LastSection | None:
    """Give the last section at an end, None where lines along the ship close the hull beyond it."""
    book, sign = AddressBook(state), 1.0 if fore else -1.0
    across: dict[float, list[tuple[str, FloatArray]]] = {}
    along, flats = [], []
    for curve in state.live("curves").tolist():
        line = state.line_of(curve)
        xyz = sample(state.spline(curve), _FINE)[1]
        family = state.family(line).name
        level = state.lines.planar[line] and abs(state.lines.normal[line][0]) == 1.0
        if family == "sections" or (level and not fore):
            name = str(state.lines.name[line]) or book.curve_name(curve)
            across.setdefault(float(xyz[:, 0].mean()), []).append((name, xyz))
        elif level:
            flats.append(float(xyz[:, 0].mean()))
        else:
            along.append(float((sign * xyz[:, 0]).max()))
    if len(across) < 2:
        return None
    places = sorted(across, key=lambda x: -sign * x)
    x, near = places[0], _CLOSED * state.particulars.length
    perpendicular = state.particulars.length if fore else 0.0
    if any(each > sign * x + near for each in along) or any(abs(f - x) <= near for f in flats):
        return None
    measured = [_immersed(xyz, draught) for _, xyz in across[x]]
    area, girth, broad = np.array(measured).sum(axis=0).tolist()
    half = max(float(xyz[:, 1].max()) for _, xyz in across[x])
    on = sign * (perpendicular - x) > near
    return _LastSection(
        across[x][0][0], fore, x, area, girth, broad, half, perpendicular if on else x,
        abs(places[1] - x), bool(along) and max(along) >= sign * x - near,
    )  # fmt: skip


def _immersed(xyz: FloatArray, draught: float) -> tuple[float, float, float]:
    """Give area and girth below the water, both sides, and the greatest breadth there; m."""
    y, z = xyz[:, 1], np.minimum(xyz[:, 2], draught)
    wet = np.minimum(xyz[:-1, 2], xyz[1:, 2]) < draught
    area = abs(float((0.5 * (y[1:] + y[:-1]) * np.diff(z)).sum()))
    girth = float(np.hypot(np.diff(y), np.diff(z))[wet].sum())
    below = xyz[:, 2] <= draught
    return 2.0 * area, 2.0 * girth, 2.0 * float(y[below].max(initial=0.0))
