"""temporary"""

import numpy as np
from assoc_hull.geometry.patches.heights import heights, polynomials_over

__all__ = ["sampled", "edge_lines"]


def sampled(patches, cells, arcs, tol, q=9):
    n = len(arcs)
    out = np.zeros((n, q, 2))
    for k in (0, 1):
        rows = np.flatnonzero(arcs.across == k)
        if not len(rows):
            continue
        c = arcs.cell[rows]
        b = polynomials_over(cells, c)
        box = cells.box[c]
        run = 1 - k
        s = np.linspace(0, 1, q)
        par = arcs.span[rows, :1] + (arcs.span[rows, 1:] - arcs.span[rows, :1]) * s
        t = np.clip((par - box[:, run, :1]) / (box[:, run, 1:] - box[:, run, :1]), 0, 1)
        g = heights(b, arcs.rising[rows], t)
        o = box[:, k, :1] + g * (box[:, k, 1:] - box[:, k, :1])
        out[rows, :, run] = par
        out[rows, :, k] = o
    out[:, 0] = arcs.ends[:, 0]
    out[:, -1] = arcs.ends[:, 1]
    return np.arange(n + 1) * q, out.reshape(-1, 2)


def edge_lines(function):
    d = np.abs(function.b) <= function.err
    return np.stack(
        [d[:, 0].all(1), d[:, -1].all(1), d[:, :, 0].all(1), d[:, :, -1].all(1)], axis=1
    )
