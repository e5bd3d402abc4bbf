"""Straight runs of neighbouring lines joined to flats: plane parts of a hull.

Runs of neighbouring lines belong to one flat where they overlap side by side and lie in one
plane.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.polylines.flats import join_straight_runs
>>> x = np.array([0.0, 10.0, 20.0])
>>> low = np.column_stack([x, np.full(3, 16.0), 2.0 + 0.1 * x])
>>> high = np.column_stack([x, np.full(3, 16.0), np.full(3, 12.0)])
>>> [flat] = join_straight_runs(np.arange(3), low, high, 1e-3)
>>> flat.runs, flat.normal.tolist(), flat.offset
((0, 1, 2), [0.0, 1.0, 0.0], 16.0)
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze

__all__ = ["FlatRegion", "fit_plane", "join_straight_runs"]


@attrs.frozen(eq=False)
class FlatRegion:
    """A plane part of a hull, seen on lines of one group.

    Attributes
    ----------
    runs : tuple of int
        Its runs, by line.
    normal : (3,)
        Unit normal; exactly along an axis where that fits as well.
    offset : float, m
        normal . place.
    """

    runs: tuple[int, ...]
    normal: FloatArray
    offset: float

    def __attrs_post_init__(self) -> None:
        freeze(self.normal)


def join_straight_runs(
    line: IntArray,
    begin: FloatArray,
    end: FloatArray,
    within: float | FloatArray,
    lines: int = 3,
    beyond: FloatArray | None = None,
) -> list[FlatRegion]:
    """Join straight runs of neighbouring lines that lie in one plane.

    Parameters
    ----------
    line : (n,)
        Number of the line of each run, neighbours by 1 apart.
    begin, end : (n, 3), m
        Both ends of each run, all in the same sense.
    within : float or (n,), m
        How far the ends of each may lie off the plane; for several the largest counts.
    lines : int
        Neighbouring lines that must agree.
    beyond : (n, 2, 3) or None, m
        Where the line before and the line after each run pass its middle most closely, nan where
        there is no such line: an oblique plane off which the hull only bends there is none.

    Returns
    -------
    list of FlatRegion
        The one of most lines first; each run is in one at most.
    """
    beside = _neighbours(line, begin, end)
    allowed = np.broadcast_to(np.asarray(within, np.float64), line.shape)
    chains: list[list[int]] = []
    for seed in _seeds(beside, begin, end, allowed, lines):
        chain = _grow(seed, beside, begin, end, allowed)
        chain = _grow(chain[::-1], _turned(beside), begin, end, allowed)[::-1]
        chains.append(chain)
    found: list[FlatRegion] = []
    taken: set[int] = set()
    back = _turned(beside)
    for chain in sorted(chains, key=lambda each: (-len(each), each)):
        few = len(chain) <= lines + 1
        go_on = few or bool(back[chain[0]]), few or bool(beside[chain[-1]])
        if taken.isdisjoint(chain) and not _is_curved(chain, begin, end, beyond, go_on, allowed):
            taken |= set(chain)
            normal, offset, _ = fit_plane(_ends(chain, begin, end), float(allowed[chain].max()))
            found.append(FlatRegion(tuple(chain), normal, offset))
    return found


def fit_plane(points: FloatArray, within: float) -> tuple[FloatArray, float, float]:
    """Fit a plane; one across an axis where that passes the points within `within` too.

    Parameters
    ----------
    points : (n, 3), m
        Places on it.
    within : float, m
        See above.

    Returns
    -------
    normal (3,), offset in m, largest distance in m

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.polylines.flats import fit_plane
    >>> fit_plane(np.array([[0.0, 5, 0], [9, 5.001, 0], [0, 5, 9], [9, 5.001, 9]]), 1e-3)[0]
    array([0., 1., 0.])
    """
    middle = points.mean(axis=0)
    local = points - middle
    axis = int(np.argmin(np.ptp(local, axis=0)))
    worst = float(np.abs(local[:, axis]).max())
    if worst <= within:
        return np.eye(3)[axis], float(middle[axis]), worst
    normal = np.linalg.svd(local, full_matrices=False)[2][-1]
    normal = normal * (1.0 if normal[np.argmax(np.abs(normal))] > 0.0 else -1.0)
    off = np.abs(local @ normal)
    return normal, float(middle @ normal), float(off.max())


_Links = dict[int, list[int]]


def _neighbours(line: IntArray, begin: FloatArray, end: FloatArray) -> _Links:
    """Give for each run those of the next line that overlap it."""
    ahead = end - begin
    length = np.sqrt((ahead * ahead).sum(axis=1))
    unit = ahead / np.maximum(length, 1e-12)[:, None]
    links: _Links = {}
    for i in range(len(line)):
        low, high = (begin - begin[i]) @ unit[i], (end - begin[i]) @ unit[i]
        shared = np.minimum(high, length[i]) - np.maximum(low, 0.0)
        # Much of the shorter run: lines that only touch end to end are no neighbours.
        beside = shared > 0.3 * np.minimum(length, length[i])
        links[i] = np.flatnonzero(beside & (line == line[i] + 1)).tolist()
    return links


def _turned(links: _Links) -> _Links:
    back: _Links = {i: [] for i in links}
    for i, others in links.items():
        for j in others:
            back[j].append(i)
    return back


def _seeds(
    links: _Links, begin: FloatArray, end: FloatArray, within: FloatArray, lines: int
) -> list[list[int]]:
    """Give all chains of the least number of lines that lie in one plane."""
    chains = [[i] for i in links]
    for _ in range(lines - 1):
        chains = [[*chain, j] for chain in chains for j in links[chain[-1]]]
    return [chain for chain in chains if _off(chain, begin, end, within) <= 1.0]


def _grow(
    chain: list[int], links: _Links, begin: FloatArray, end: FloatArray, within: FloatArray
) -> list[int]:
    """Lengthen a chain at its end as long as it lies in one plane."""
    out = list(chain)
    while True:
        ways = [(_off([*out, j], begin, end, within), j) for j in links[out[-1]]]
        if not ways or min(ways)[0] > 1.0:
            return out
        out.append(min(ways)[1])


_BEND = np.tan(np.deg2rad(8.0))
"""A wall whose next line leaves the plane of the last ones by less bends on; by more it breaks."""


def _is_curved(
    chain: list[int],
    begin: FloatArray,
    end: FloatArray,
    beyond: FloatArray | None,
    go_on: tuple[bool, bool],
    within: FloatArray,
) -> bool:
    """Tell whether the hull bends off an oblique plane beside the lines that lie in it.

    Few lines of an upright wall that is curved along the ship lie in one plane as nearly as is
    asked. Of more only straight lines that go on speak against the plane, before and after as
    `go_on` says: a flat may have a bend beside it. One across an axis is flat in any case.
    """
    allowed = float(within[chain].max())
    normal, offset, _ = fit_plane(_ends(chain, begin, end), allowed)
    if beyond is None or 1.0 in normal:
        return False
    for side, run in enumerate((chain[0], chain[-1])):
        place = beyond[run, side]
        off = abs(float(place @ normal) - offset)
        step = place - 0.5 * (begin[run] + end[run])
        away = float(np.sqrt(max(step @ step - float(step @ normal) ** 2, 0.0)))
        # Where there is no line, nan is neither.
        if go_on[side] and allowed < off < _BEND * away:
            return True
    return False


def _ends(chain: list[int], begin: FloatArray, end: FloatArray) -> FloatArray:
    return np.concatenate([begin[chain], end[chain]])


def _off(chain: list[int], begin: FloatArray, end: FloatArray, within: FloatArray) -> float:
    """Give how far the ends of runs lie off one plane, as a part of what is allowed."""
    allowed = float(within[chain].max())
    return fit_plane(_ends(chain, begin, end), allowed)[2] / allowed
