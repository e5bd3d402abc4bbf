"""The same work done one curve at a time by others: scipy, and OpenCASCADE.

Each gives the number of meetings it found, so that a run can check that all did the same.
Imported only where it is needed: the kernel is measured without scipy in the process.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray

__all__ = ["Job", "opencascade", "scipy_loop"]


@attrs.frozen(eq=False)
class Job:
    """Curves, each with the planes that it is cut with.

    Attributes
    ----------
    points : tuple of (n, 3), m
        What the curves run through.
    planes : tuple of tuple of (int, (p,))
        For each curve the axis of the normal and the offsets (m) of families of planes.
    """

    points: tuple[FloatArray, ...]
    planes: tuple[tuple[tuple[int, FloatArray], ...], ...]


def scipy_loop(job: Job) -> int:
    """Loft each curve with `make_interp_spline`, and solve its piecewise polynomial."""
    from scipy.interpolate import PPoly, make_interp_spline

    count = 0
    for points, families in zip(job.points, job.planes, strict=True):
        chord = np.sqrt((np.diff(points, axis=0) ** 2).sum(axis=1))
        knot = np.concatenate([[0.0], np.cumsum(chord)])
        curve = make_interp_spline(knot, points, k=3)
        for axis, offsets in families:
            pieces = PPoly.from_spline((curve.t, curve.c[:, axis], 3))
            # Without the empty pieces between the equal knots at the ends.
            height = PPoly(pieces.c[:, 3:-3], pieces.x[3:-3], extrapolate=False)
            for offset in offsets.tolist():
                count += len(curve(height.solve(offset)))
    return count


def opencascade(job: Job) -> int:
    """Loft each curve with `GeomAPI_Interpolate`, and cut it with `GeomAPI_IntCS`."""
    from OCP.collections import HArray1_gp_Pnt
    from OCP.Geom import Geom_Plane
    from OCP.GeomAPI import GeomAPI_IntCS, GeomAPI_Interpolate
    from OCP.gp import gp_Dir, gp_Pnt

    normals = [gp_Dir(*row) for row in np.eye(3).tolist()]
    surfaces: dict[tuple[int, float], Geom_Plane] = {}
    count = 0
    for points, families in zip(job.points, job.planes, strict=True):
        array = HArray1_gp_Pnt(1, len(points))
        for place, (x, y, z) in enumerate(points.tolist(), 1):
            array.SetValue(place, gp_Pnt(x, y, z))
        maker = GeomAPI_Interpolate(array, False, 1e-9)
        maker.Perform()
        curve = maker.Curve()
        for axis, offsets in families:
            for offset in offsets.tolist():
                plane = surfaces.get((axis, offset))
                if plane is None:
                    at = [0.0, 0.0, 0.0]
                    at[axis] = offset
                    plane = surfaces[axis, offset] = Geom_Plane(gp_Pnt(*at), normals[axis])
                found = GeomAPI_IntCS(curve, plane)
                for place in range(1, found.NbPoints() + 1):
                    found.Point(place)
                    count += 1
    return count
