"""Waterlines of pieces with their curvature; sections as images of a circle."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.interpolate import CubicSpline

from assoc_hull.geometry.classical.combined_waterline import combined_waterline as waterline
from assoc_hull.geometry.classical.conformal_sections import fit_conformal, lewis_sections
from assoc_hull.geometry.classical.pieced_curve import PiecedCurve
from drawings.common import DRIVEN, FAINT, FIXED, INK, PALE, SHARED

__all__ = ["combined_waterline", "conformal_sections"]

_OFFSETS = [(24, 11.97), (30, 11.72), (36, 11.2), (42, 10.4), (48, 9.3), (54, 8)]


def combined_waterline() -> Figure:
    """Draw a waterline of straight, quintic and conic, and curvature over length for both ends."""
    curve = waterline(20, 60, 75, 12, 6.5, _OFFSETS, start=10)
    joined = waterline(20, 60, 75, 12, 6.5, _OFFSETS, start=10, last="cubic conic")
    figure = plt.figure(figsize=(9.4, 5.0), layout="constrained")
    grid = figure.add_gridspec(2, 3, height_ratios=(1.0, 1.25))
    above, below = figure.add_subplot(grid[0, :]), figure.add_subplot(grid[1, :2])
    near = figure.add_subplot(grid[1, 2])
    for piece, colour in zip(curve.pieces, (FIXED, SHARED, DRIVEN), strict=True):
        # Closer toward the end, where the conic stands upright.
        x = piece.last - piece.length * np.linspace(1.0, 0.0, 200) ** 2
        name = "straight" if piece.formula == "line" else piece.formula
        above.plot(x, piece.at(x), color=colour, linewidth=2.0, label=name)
    above.plot(*np.array(_OFFSETS).T, "o", color=INK, markersize=4, label="offsets")
    for axes in (above, below, near):
        for join in curve.joins():
            axes.axvline(join.x, color=FAINT, linewidth=0.9, zorder=0)
    above.set(ylabel="y (m)", ylim=(-0.4, 13.2), xlim=(8, 78))
    above.set_aspect("equal")
    above.legend(loc="lower left", frameon=False, ncols=2, fontsize=9)
    for axes in (below, near):
        _curvature(axes, curve, SHARED, "-", "conic")
        _curvature(axes, joined, DRIVEN, "--", "cubic conic")
        axes.set(xlabel="x (m)")
    below.set(ylabel="curvature (1/m)", ylim=(-0.03, 0.001), xlim=(8, 78))
    near.set(title="at the change", ylim=(-0.0046, -0.0034), xlim=(58, 62))
    below.legend(loc="lower left", frameon=False)
    return figure


def _curvature(axes: Axes, curve: PiecedCurve, colour: str, style: str, label: str) -> None:
    for piece in curve.pieces:
        last = piece.last - 1e-9 - (0.04 * piece.length if piece.base is not None else 0.0)
        x = np.linspace(piece.first, last, 400)
        bend = piece.at(x, 2) / (1.0 + piece.at(x, 1) ** 2) ** 1.5
        axes.plot(x, bend, style, color=colour, linewidth=1.5, label=label)
        label = ""


def conformal_sections() -> Figure:
    """Draw sections of two terms for area coefficients, and one of more terms through offsets."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.4, 4.4), layout="constrained")
    t = np.linspace(0.0, 0.5 * np.pi, 200)
    sigma = [0.6, 0.7, 0.785, 0.85, 0.9, 0.94]
    sections = lewis_sections(np.full(6, 6.0), np.full(6, 5.0), sigma)
    for places, value in zip(sections.at(t), sigma, strict=True):
        left.plot(places[:, 0], -places[:, 1], color=SHARED, linewidth=1.4)
        middle = places[105]
        left.text(
            middle[0], -middle[1], f"{value:g}", fontsize=8, color=INK, ha="center", va="center",
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6},
        )  # fmt: skip
    left.set(title="two terms: area coefficients", xlabel="y (m)", ylabel="z below the water (m)")
    offsets = _bulbous()
    right.plot(offsets[:, 0], -offsets[:, 1], "o", color=INK, markersize=3, label="offsets")
    for terms, colour in ((2, PALE), (4, DRIVEN), (7, SHARED)):
        places = fit_conformal(offsets, terms)[0].at(t)[0]
        right.plot(places[:, 0], -places[:, 1], color=colour, linewidth=1.4, label=f"{terms} terms")
    right.set(title="more terms, by least squares", xlabel="y (m)")
    right.legend(loc="center left", bbox_to_anchor=(1.05, 0.7), frameon=False)
    for axes in (left, right):
        axes.set_aspect("equal")
    return figure


def _bulbous() -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    """Give offsets of a section near the bow: a bulb below, a neck, flare above."""
    z = np.array([8.0, 7.8, 7.2, 6.3, 5.3, 4.4, 3.5, 2.6, 1.7, 0.8, 0.0])
    y = np.array([0.0, 0.8, 1.5, 1.85, 1.8, 1.6, 1.5, 1.6, 1.9, 2.4, 3.0])
    along = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(y), np.diff(z)))])
    dense = CubicSpline(along, np.column_stack([y, z]))(np.linspace(0.0, along[-1], 41))
    dense[0, 0], dense[-1, 1] = 0.0, 0.0
    return np.asarray(dense)
