"""What the drawings share: the hull, colours, arrows."""

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import FancyArrowPatch
from numpy.typing import NDArray

import assoc_hull as ah

Floats = NDArray[np.float64]

INK, PALE, FAINT = "#20262c", "#9aa4ad", "#d9dee2"
SHARED, DRIVEN, WATCHED, FIXED, ACCENT = "#0b5394", "#d9660a", "#8b1a8b", "#1a7f37", "#c0392b"

mpl.use("Agg")
mpl.rcParams.update(
    {
        "font.size": 10,
        "axes.edgecolor": PALE,
        "axes.labelcolor": INK,
        "xtick.color": INK,
        "ytick.color": INK,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "savefig.dpi": 120,
    }
)

_MADE: list[ah.Hull] = []


def ship() -> ah.Hull:
    """Give Series 60 CB 0.70, made once; who edits it takes the edit back."""
    if not _MADE:
        _MADE.append(ah.examples.series60(0.70))
    return _MADE[0]


def curve(hull: ah.Hull, line: str) -> Floats:
    """Give places along the one curve of a line, (n, 3), m."""
    return np.array(hull.lines[line].curves[0].polyline(8))


def bare(axes: Axes) -> None:
    """Leave out ticks and frame."""
    axes.set_axis_off()


def arrow(axes: Axes, start: Floats, end: Floats, bend: float = 0.0, color: str = INK) -> None:
    """Draw an arrow in data coordinates."""
    style = f"arc3,rad={bend}"
    axes.add_patch(
        FancyArrowPatch(
            tuple(start), tuple(end), arrowstyle="-|>", mutation_scale=12, color=color,
            connectionstyle=style, linewidth=1.2, zorder=6,
        )
    )  # fmt: skip
