"""Points at equal lengths along immersed half sections."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.floating_body import require_afloat, require_numbers
from assoc_hull.analysis.hydrostatics.flotation import flotation, header_of
from assoc_hull.analysis.hydrostatics.hull_hydrostatics import position_of
from assoc_hull.analysis.panels.wet_sheets import Band, Waterplane, bands
from assoc_hull.arguments import integer, numbers
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.splines.arc_length import CubicChains
from assoc_hull.model.tables import HasState, state_of

__all__ = ["section_points"]

_WHERE = "in section_points"
_MOST = 2_000


def section_points(
    hull: HasState,
    x: object,
    *,
    points: int = 20,
    draught: float | None = None,
    draughts: tuple[float, float] | None = None,
) -> FloatArray:
    """Part immersed half sections of an upright hull into equal lengths.

    The arguments and what is raised are those of `Hull.section_points`.
    """
    state = state_of(hull)
    body = flotation(state)
    terms: dict[str, object] = {"rho": 1.0, "shell_factor": 1.0, "appendages": ()}
    header = header_of(hull, body, terms | {"fingerprint": ""})
    require_numbers(draughts if draught is None else draught, body.limits)
    position = position_of(header, draught, draughts, 0.0, "moulded")
    planes = require_afloat([position], body.limits, header.length)
    plane = Waterplane(*(float(each[0]) for each in attrs.astuple(planes)))
    where = np.atleast_1d(numbers(x, "x", _WHERE))
    count = integer(points, "points", _WHERE, least=2, most=_MOST)
    found = np.full((len(where), count, 3), np.nan)
    sections = _sections(bands(body, plane), plane, where)
    wet = [i for i, cubics in enumerate(sections) if len(cubics)]
    if wet:
        start = np.append(0, np.cumsum([len(sections[i]) for i in wet])).astype(np.int64)
        found[wet] = CubicChains(start, np.concatenate([sections[i] for i in wet])).equal(count)
    freeze(found)
    return found


def _sections(every: list[Band], plane: Waterplane, x: FloatArray) -> list[FloatArray]:
    """Give what is wet of each section as cubics (s, 4, 3), its pieces from below."""
    pieces: list[list[FloatArray]] = [[] for _ in x]
    for band in every:
        # A place at which two bands meet belongs to the one forward.
        inside = np.flatnonzero((x >= band.x[0]) & ((x < band.x[-1]) | _last(every, band, x)))
        q = np.interp(x[inside], band.x, np.arange(band.count + 1.0))
        wet = band.wet(q, plane)
        for run, number in enumerate(wet.curve.tolist()):
            cubics = wet.chains.cubic[wet.chains.start[run] : wet.chains.start[run + 1]]
            pieces[int(inside[number])].append(cubics)
    ordered = [sorted(each, key=lambda cubics: float(cubics[0, 0, 2])) for each in pieces]
    return [np.concatenate(each) if each else np.zeros((0, 4, 3)) for each in ordered]


def _last(every: list[Band], band: Band, x: FloatArray) -> np.typing.NDArray[np.bool_]:
    """Tell which places lie at the fore end of a band that no other goes on from."""
    followed = any(other.x[0] == band.x[-1] for other in every)
    found: np.typing.NDArray[np.bool_] = (x == band.x[-1]) & (not followed)
    return found
