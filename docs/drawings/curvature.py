"""Curvature regions: four typical plates, a mixed one, its curvature, and a plate laid flat."""

import numpy as np
from matplotlib.figure import Figure

import assoc_hull as ah
from assoc_hull.plot.plates.curvature_map import curvature_figure
from assoc_hull.plot.plates.development import development_figure

__all__ = ["curvature_lines", "curvature_mixed", "curvature_typical", "plate_flat"]


def _inflected() -> ah.surface.SplineSurface:
    """Give a plate that is bent one way below and the other way above, and a little along."""
    x, y = np.mgrid[0:7:4j, -1.2:1.2:4j]
    # Control points of 0.004 x**2 and 0.12 y**3 over these spans.
    along = 0.004 * 49.0 * np.array([0.0, 0.0, 1.0 / 3.0, 1.0])[:, None]
    across = 0.12 * 1.2**3 * np.array([-1.0, 1.0, -1.0, 1.0])
    return ah.surface.SplineSurface.bezier(np.stack([x, y, along + across], axis=-1), "inflected")


def _plates() -> dict[str, ah.surface.SplineSurface]:
    return {plate.name: plate for plate in ah.examples.typical_plates()}


def curvature_typical() -> Figure:
    """Draw a convex plate, a saddle, a cylinder and an inflected plate."""
    known = _plates()
    shown = [known[name] for name in ("bulb shoulder", "stern hollow", "bilge")]
    return curvature_figure(ah.surface.plates([*shown, _inflected()]), title="Four kinds of plates")


def curvature_mixed() -> Figure:
    """Draw the flare of a bow, which is convex below and hollow above."""
    return curvature_figure(ah.surface.plates(_plates()["bow flare"]), title="Bow flare")


def curvature_lines() -> Figure:
    """Draw the curvature of the same plate, with lines of further levels."""
    found = ah.surface.curvature_regions(_plates()["bow flare"], levels=(-0.006, -0.003, 0.003))
    return curvature_figure(found, views=("plan", "parameters"), quantity="curvature",
                            title="Curvature")  # fmt: skip


def plate_flat() -> Figure:
    """Draw the shoulder of a bulb laid flat."""
    (plate,) = ah.surface.plates(_plates()["bulb shoulder"])
    return development_figure(plate.development())
