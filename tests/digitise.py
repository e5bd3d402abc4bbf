"""The lines of a net as text of digitised points with noise, as if read off a drawing."""

import numpy as np

from assoc_hull.geometry.curves import SplineBatch
from assoc_hull.geometry.splines.segments import evaluate
from assoc_hull.hull import Hull


def as_digitised(hull: Hull, seed: int, noise: float, leave_out: tuple[str, ...]) -> str:
    """Points about 0.15 m apart on sections and 0.5 m on other lines, scattered in their plane.

    Lines named in `leave_out` are not written; ends and space curves are not scattered.
    """
    draw, state = np.random.default_rng(seed), hull.state
    text = ["line,piece,x,y,z"]
    for line in state.live("lines").tolist():
        name, group = state.lines.name[line], int(state.lines.group[line])
        if name in leave_out:
            continue
        spacing = 0.15 if state.groups.name[group] == "sections" else 0.5
        for piece, curve in enumerate(state.lines.curves[line]):
            xyz, ahead = _along(state.curves.spline[curve], spacing, draw)
            if state.lines.planar[line]:
                across = np.cross(ahead, state.lines.normal[line])
                across /= np.linalg.norm(across, axis=1)[:, None]
                off = draw.normal(0.0, noise, (len(xyz), 1))
                off[[0, -1]] = 0.0
                xyz = xyz + across * off
            text += [f"{name},{piece},{x:.6f},{y:.6f},{z:.6f}" for x, y, z in xyz.tolist()]
    return "\n".join(text) + "\n"


def _along(
    spline: SplineBatch, spacing: float, draw: np.random.Generator
) -> tuple[np.ndarray, np.ndarray]:
    """Places about evenly along a curve, and the directions there."""
    fine = np.linspace(0.0, float(spline.knot[-1]), 4001)
    xyz = evaluate(spline, np.zeros(4001, np.int64), fine)
    length = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(xyz, axis=0), axis=1)))
    count = max(8, round(float(length[-1]) / spacing))
    part = np.arange(count + 1) + np.append(np.append(0.0, draw.uniform(-0.2, 0.2, count - 1)), 0.0)
    at = np.interp(part / count * length[-1], length, fine)
    places = evaluate(spline, np.zeros(count + 1, np.int64), at)
    return places, np.gradient(places, axis=0)
