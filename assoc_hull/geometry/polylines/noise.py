"""How far the points of a digitised line scatter, and how far facets lie off a curve.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.polylines.noise import point_scatter
>>> t = np.linspace(0.0, 3.0, 200)
>>> noise = np.random.default_rng(1).normal(0.0, 1e-3, (200, 2))
>>> line = np.column_stack([10.0 * np.cos(t), 10.0 * np.sin(t)]) + noise
>>> round(1e3 * point_scatter(line), 1)
1.0
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.polylines.operations import cumulative_lengths

__all__ = ["facet_depth", "facet_depths", "forward_points", "point_scatter"]

_GAUSS = 1.4826
"""Standard deviation over median of the absolute value, of a normal distribution."""


def point_scatter(points: FloatArray) -> float:
    """Estimate the standard deviation (m) of points across their line.

    Each point is compared with the cubic through the two before and the two after it; the
    median makes corners and single wild points count little. Shape that five neighbours
    show beyond a cubic counts as noise.

    Parameters
    ----------
    points : (n, k), m
        In order along the line; zero is given for fewer than seven.
    """
    if len(points) < 7:
        return 0.0
    at = cumulative_lengths(points)
    middle = at[2:-2]
    rows = [at[i : len(at) - 4 + i] for i in (0, 1, 3, 4)]
    values = [points[i : len(points) - 4 + i] for i in (0, 1, 3, 4)]
    weight = []
    for i in range(4):
        others = [rows[j] for j in range(4) if j != i]
        top = (middle - others[0]) * (middle - others[1]) * (middle - others[2])
        below = (rows[i] - others[0]) * (rows[i] - others[1]) * (rows[i] - others[2])
        weight.append(top / below)
    guess = sum((w[:, None] * v for w, v in zip(weight, values, strict=True)), np.zeros(1))
    spread = np.sqrt(1.0 + sum((w * w for w in weight), np.zeros(1)))
    ahead = points[3:-1] - points[1:-3]
    length = np.sqrt((ahead * ahead).sum(axis=1))
    off = points[2:-2] - guess
    along = (off * ahead).sum(axis=1) / np.maximum(length, 1e-300)
    across = np.sqrt(np.maximum((off * off).sum(axis=1) - along * along, 0.0))
    single = across / spread
    robust = _GAUSS * float(np.median(single))
    calm = single[single <= 3.5 * robust]
    return float(np.sqrt((calm * calm).mean())) if len(calm) else robust


_ALONE = 0.6
"""A point that has this part of all that it and two on either side turn is a corner."""


def facet_depth(points: FloatArray, corner_deg: float = 10.0) -> float:
    """Estimate how deep (m) the facets of a polyline lie inside the curve they stand for.

    The sagitta of a facet is its length times the turn to the next over 8; 19 of 20 are less
    than what is given. Turns above `corner_deg` at short facets, and of single points, are corners
    and left out.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.polylines.noise import facet_depth
    >>> t = np.linspace(0.0, 3.0, 31)
    >>> circle = 10.0 * np.column_stack([np.cos(t), np.sin(t)])
    >>> round(facet_depth(circle), 4), round(10.0 * 0.05**2 / 2.0, 4)
    (0.0125, 0.0125)
    """
    depth, mean, smooth = _depths(points, corner_deg)
    depth, mean = depth[smooth], mean[smooth]
    if not len(depth):
        return 0.0
    # Weighted by length, so that many short facets do not hide the long ones.
    order = np.argsort(depth)
    share = np.cumsum(mean[order])
    return float(depth[order][np.searchsorted(share, 0.95 * share[-1])])


def _depths(
    points: FloatArray, corner_deg: float
) -> tuple[FloatArray, FloatArray, np.typing.NDArray[np.bool_]]:
    """Give sagitta and mean facet at each inner point, and whether it is no corner."""
    step = np.diff(points, axis=0)
    length = np.sqrt((step * step).sum(axis=1))
    unit = step / np.maximum(length, 1e-300)[:, None]
    turn = np.arccos(np.clip((unit[1:] * unit[:-1]).sum(axis=1), -1.0, 1.0))
    mean = 0.5 * (length[1:] + length[:-1])
    # Facets of a curve turn alike: a point that turns nearly alone is a corner.
    around = np.convolve(turn, np.ones(5))[2:-2] if len(turn) else turn
    alone = (turn > np.deg2rad(corner_deg)) & (turn >= _ALONE * around)
    smooth = (turn < np.deg2rad(corner_deg)) | ((mean > 1.0) & ~alone)
    return np.minimum(length[1:], length[:-1]) * turn / 8.0, mean, smooth


def facet_depths(points: FloatArray, corner_deg: float = 10.0) -> FloatArray:
    """Estimate how deep (m) the facets around each point lie inside the curve, (n,).

    The deepest of the nine facets around: a slice passes large triangles near their corners
    too, where its own facets are short.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.polylines.noise import facet_depths
    >>> facet_depths(np.array([[0.0, 0], [2, 0], [4, 0.1], [6, 0.3]])).round(4)
    array([0.0125, 0.0125, 0.0125, 0.0125])
    """
    from scipy.ndimage import maximum_filter1d

    if len(points) < 3:
        return np.zeros(len(points))
    depth, _, smooth = _depths(points, corner_deg)
    whole = np.concatenate([[0.0], np.where(smooth, depth, 0.0), [0.0]])
    return np.asarray(maximum_filter1d(whole, 9, mode="nearest"))


_WINDOW = 12
"""A line that runs to and fro is looked at over so many points at most."""


def forward_points(points: FloatArray, allowed: FloatArray) -> IntArray:
    """Give the points (k,) of a line without those between which it runs to and fro.

    A plane that grazes a surface cuts its facets in an order that is not that of the line. Where
    a line turns by over 90 degrees, and the chord over that place passes all points between its
    ends by no more than is allowed, those are left out. Corners stay: chords pass them farther off.

    Parameters
    ----------
    points : (n, d), m
        In order along the line.
    allowed : (n,), m
        How far the line may be moved at each of them.

    Examples
    --------
    >>> x = np.array([0.0, 1.0, 2.0, 1.9, 2.1, 3.0])
    >>> forward_points(np.column_stack([x, 0.01 * x]), np.full(6, 0.05)).tolist()
    [0, 1, 4, 5]
    """
    kept = np.arange(len(points))
    place = 1
    while place < len(kept) - 1:
        one, two = np.diff(points[kept[place - 1 : place + 2]], axis=0)
        window = None if one @ two >= 0.0 else _turn_window(points[kept], allowed[kept], place)
        if window is None:
            place += 1
            continue
        low, high = window
        kept = np.delete(kept, np.arange(low + 1, high))
        place = max(low, 1)
    return kept


def _turn_window(points: FloatArray, allowed: FloatArray, place: int) -> tuple[int, int] | None:
    """Give the shortest stretch around a turn whose chord may take its place, by its ends."""
    last = len(points) - 1
    for size in range(2, _WINDOW + 1):
        for low in range(max(place - size + 1, 0), place):
            high = low + size
            if high > last:
                break
            chord = points[high] - points[low]
            length = float(chord @ chord)
            inner = points[low + 1 : high] - points[low]
            part = np.clip(inner @ chord / max(length, 1e-300), 0.0, 1.0)
            away = inner - part[:, None] * chord
            near = (away * away).sum(axis=1) <= allowed[low + 1 : high] ** 2
            if near.all() and _goes_on(points, low, high):
                return low, high
    return None


def _goes_on(points: FloatArray, low: int, high: int) -> bool:
    """Tell whether the line goes on at both ends of a chord without turning back."""
    chord = points[high] - points[low]
    before = low == 0 or bool((points[low] - points[low - 1]) @ chord > 0.0)
    after = high == len(points) - 1 or bool((points[high + 1] - points[high]) @ chord > 0.0)
    return before and after
