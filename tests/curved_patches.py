"""Patches with curvature regions that are known, and what is known of them.

The areas were found without polynomials: by closed forms of the borders between regions, or line by
line in both parameters; each names its method.
"""

import csv
from functools import cache
from pathlib import Path

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray

_DATA = Path(__file__).parent / "data"


@attrs.frozen
class Reference:
    """What is known of a patch: areas (m2), and how many pieces of each kind K = 0 has."""

    positive: float
    negative: float
    zero: float
    closed: int
    open: int
    junction: int
    isolated: int

    @property
    def total(self) -> float:
        """The whole area, m2."""
        return self.positive + self.negative + self.zero


@cache
def nets() -> dict[str, FloatArray]:
    """Give the control nets, (m + 1, n + 1, 3), m, by name."""
    rows: dict[str, list[list[float]]] = {}
    with (_DATA / "curvature_patches.csv").open(newline="") as file:
        for name, *cells in list(csv.reader(file))[1:]:
            rows.setdefault(name, []).append([float(cell) for cell in cells])
    found = {}
    for name, points in rows.items():
        table = np.array(points, np.float64)
        m, n = table[-1, :2].astype(int)
        found[name] = table[:, 2:].reshape(m + 1, n + 1, 3)
        found[name].setflags(write=False)
    return found


def patch(name: str) -> FloatArray:
    """Give one control net, (m + 1, n + 1, 3), m."""
    return nets()[name]


@cache
def references() -> dict[str, Reference]:
    """Give what is known of each patch, by name."""
    with (_DATA / "curvature_reference.csv").open(newline="") as file:
        return {
            row["patch"]: Reference(
                float(row["area_pos"]), float(row["area_neg"]), float(row["area_zero"]),
                int(row["closed"]), int(row["open"]), int(row["junction"]),
                int(row["isolated_or_tangent"]),
            )
            for row in csv.DictReader(file)
        }  # fmt: skip


def graph_plates(count: int, seed: int) -> FloatArray:
    """Give bicubic plates z(x, y) of 4 m x 2 m with random heights, (count, 4, 4, 3), m."""
    draw = np.random.default_rng(seed)
    net = np.zeros((count, 4, 4, 3))
    net[..., 0] = np.linspace(0.0, 4.0, 4)[:, None]
    net[..., 1] = np.linspace(0.0, 2.0, 4)
    net[..., 2] = 0.3 * draw.standard_normal((count, 4, 4))
    return net


def random_nets(count: int, seed: int) -> FloatArray:
    """Give bicubic nets of points anywhere in space, folded and pierced, (count, 4, 4, 3), m."""
    return np.random.default_rng(seed).standard_normal((count, 4, 4, 3))
