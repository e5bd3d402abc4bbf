"""The body of a hull: sections in one piece from the centre plane to the deck."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.analysis.net.gather import Net
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.evaluation import evaluate
from assoc_hull.geometry.fitting.samples import Samples
from assoc_hull.surface.blocks.first_fit import clamped, feet, fit

__all__ = ["body_of_sections"]


def body_of_sections(net: Net, length: float, left_out: np.typing.NDArray[np.bool_]):
    """Give surface, samples, distances of the body."""
    scale = length / 300.0
    sections = _whole(net, left_out)
    if len(sections) < 4:
        raise BadInputError("fewer than four whole sections", "in surface", "give more stations")
    x = net.x[sections]
    girth = np.array([_arc(net, i)[1][-1] for i in sections])
    mean = float(girth.mean())
    of_sections = [_section(net, i, 0.25 * scale, mean) for i in sections]
    first = Samples(*(np.concatenate(each) for each in zip(*of_sections, strict=True)))
    ku = clamped(_spread(x, 2))
    kv = clamped(np.linspace(0.0, mean, 31))
    smoothing = 8e-11 * length**3
    surface, first, _ = fit("body", first, ku, kv, smoothing, 2)
    others = [
        _other(net, i, 0.6 * scale, surface, x[[0, -1]])
        for i in range(net.batch.count)
        if i not in set(sections) and not left_out[i] and not np.isfinite(net.x[i])
    ]
    parts = [first, *(each for each in others if each is not None)]
    arrays = [np.concatenate([getattr(p, f.name) for p in parts]) for f in attrs.fields(Samples)]
    return fit("body", Samples(*arrays), ku, kv, smoothing, 4)


def _whole(net: Net, left_out) -> list[int]:
    """Sections that stand alone in their plane, from the centre plane up to the deck."""
    batch = net.batch
    top = {}
    found = []
    for i in range(batch.count):
        if net.family[i] == "sections" and not left_out[i]:
            top.setdefault(float(net.x[i]), []).append(i)
    for x in sorted(top):
        if len(top[x]) != 1:
            continue
        (i,) = top[x]
        ends = batch.xyz[[batch.start[i], batch.start[i + 1] - 1]]
        if abs(ends[0, 1]) < 1e-6 and ends[1, 2] > ends[0, 2]:
            found.append(i)
    # from the longest run of sections whose girth does not jump
    girth = np.array([_arc(net, i)[1][-1] for i in found])
    jump = np.abs(np.diff(girth)) > 0.12 * np.minimum(girth[1:], girth[:-1])
    cuts = np.concatenate([[0], np.flatnonzero(jump) + 1, [len(found)]])
    a, b = max(zip(cuts[:-1], cuts[1:]), key=lambda p: p[1] - p[0])
    return found[a:b]


def _arc(net: Net, curve: int, step: float = 0.05) -> tuple[FloatArray, FloatArray]:
    """Chord parameters and arc lengths along a curve."""
    count = max(int(net.length(curve) / step), 8)
    t = np.linspace(0.0, net.length(curve), count + 1)
    p = evaluate(net.batch, np.full(len(t), curve), t)
    return t, np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(p, axis=0), axis=1))])


def _section(net: Net, curve: int, step: float, mean: float):
    t, s = _arc(net, curve)
    count = max(int(s[-1] / step), 8)
    at = np.linspace(0.0, s[-1], count + 1)
    places = np.interp(at, s, t)
    point = evaluate(net.batch, np.full(len(places), curve), places)
    v = (1.0 - at / s[-1]) * mean  # from the deck down, so that normals point outward
    uv = np.stack([np.full(len(v), net.x[curve]), v], axis=1)
    weight = np.full(len(v), s[-1] / count)
    weight[[0, -1]] *= 2.0
    held = np.zeros((len(v), 2), np.bool_)
    held[:, 0] = True
    held[[0, -1], 1] = True
    return uv, point, weight, np.full(len(v), curve), held


def _other(net: Net, curve: int, step: float, surface, x):
    t, s = _arc(net, curve, 0.2)
    count = max(int(s[-1] / step), 2)
    places = np.interp(np.linspace(0.0, s[-1], count + 1), s, t)
    point = evaluate(net.batch, np.full(len(places), curve), places)
    inside = (point[:, 0] >= x[0]) & (point[:, 0] <= x[1])
    point = point[inside]
    if len(point) < 2:
        return None
    u = point[:, 0]
    v = np.linspace(*surface.domain[1], 121)
    grid = surface.at(u[:, None], v[None, :])
    near = v[((grid - point[:, None]) ** 2).sum(-1).argmin(1)]
    held = np.zeros((len(u), 2), np.bool_)
    ends = np.isclose(near, v[0]) | np.isclose(near, v[-1])
    if net.end[curve]:
        held[:, 1] = ends
    uv = np.stack([u, near], 1)
    weight = np.full(len(u), step * (3.0 if net.end[curve] else 1.0))
    return Samples(uv, point, weight, np.full(len(u), curve), held)


def _spread(x: FloatArray, each: int) -> FloatArray:
    """Each interval parted in equal spans."""
    parts = [np.linspace(a, b, each, endpoint=False) for a, b in zip(x[:-1], x[1:], strict=True)]
    return np.concatenate([*parts, x[-1:]])
