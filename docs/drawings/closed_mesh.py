"""The closed mesh of a stern, seen from abaft: cells of the net, elements, what closes it."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

import assoc_hull as ah
from assoc_hull.analysis.net.curve_net import gather_net
from assoc_hull.surface.cells.closed_mesh import ClosedMesh
from assoc_hull.surface.cells.net_graph import NetGraph, net_graph
from drawings.common import ACCENT, INK, Floats, bare

__all__ = ["closed_mesh_stern"]

_TONES = {"shell": "#9db8cf", "deck": "#d9cfae", "transom": "#d8a48f", "bossing end": "#d8a48f"}
_LIGHT = np.array([-0.35, 0.55, 0.75])
_FROM, _DOWN = np.radians(52.0), np.radians(14.0)
_UNTIL = 60.01
"""Drawn is what lies abaft of the station at 60 m."""
_CELLS = 30.0
"""Forward of this only cells are drawn, abaft of it elements too, m."""


def seen(place: Floats) -> tuple[Floats, Floats]:
    """Give places (..., 3) as seen on paper (..., 2), and how near they are (...)."""
    ahead = np.array([np.sin(_FROM) * np.cos(_DOWN), np.cos(_FROM) * np.cos(_DOWN), -np.sin(_DOWN)])
    ahead = ahead * [1.0, -1.0, -1.0]
    right = np.cross(ahead, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    up = np.cross(right, ahead)
    return np.stack([place @ right, place @ up], axis=-1), -(place @ ahead)


def closed_mesh_stern() -> Figure:
    """Draw the stern of the bulk carrier: what closes it is of its own colour."""
    hull = ah.examples.bulk_carrier_207k()
    mesh = hull.mesh(points=4)
    figure, axes = plt.subplots(figsize=(8.6, 5.6), layout="constrained")
    bare(axes)
    axes.set_aspect("equal")
    paint(axes, mesh)
    lines(axes, net_graph(gather_net(hull.state)))
    axes.autoscale_view()
    return figure


def paint(axes: Axes, mesh: ClosedMesh) -> None:
    """Paint triangles, the farthest first; deck, transom and other ends by their own colours."""
    corner = mesh.triangles.corners
    chosen = corner[:, :, 0].max(axis=1) < _UNTIL
    corner, group = corner[chosen], mesh.group[chosen]
    normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-12)[:, None]
    flat, near = seen(corner)
    order = np.argsort(near.mean(axis=1))
    light = 0.62 + 0.38 * np.clip(normal @ (_LIGHT / np.linalg.norm(_LIGHT)), -0.6, 1.0)
    tone = np.array([[int(_TONES[name][i : i + 2], 16) for i in (1, 3, 5)] for name in mesh.names])
    colour = np.clip(tone[group] / 255.0 * light[:, None], 0.0, 1.0)
    edge = np.where((corner[:, :, 0].mean(axis=1) < _CELLS)[:, None], 0.72 * colour, colour)
    axes.add_collection(
        PolyCollection(
            list(flat[order]), facecolors=colour[order], edgecolors=edge[order], linewidths=0.25
        )
    )


def lines(axes: Axes, graph: NetGraph) -> None:
    """Draw the edges of cells that face the eye, on port."""
    place = graph.points(8)
    chosen = (place[:, :, 0].max(axis=1) < _UNTIL) & visible(graph)
    flat, _ = seen(place[chosen])
    end = graph.net.end[graph.curve[chosen]]
    for own, colour, width in ((~end, INK, 0.7), (end, ACCENT, 1.3)):
        paths = [np.concatenate([each, each[::-1]]) for each in flat[own]]
        axes.add_collection(
            PolyCollection(paths, facecolors="none", edgecolors=colour, linewidths=width)
        )


def visible(graph: NetGraph) -> np.ndarray:
    """Tell which edges lie where the hull faces the eye."""
    _, near = seen(graph.normal)
    return np.asarray(near[graph.edge].max(axis=1) > -0.05)
