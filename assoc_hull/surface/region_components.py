"""Lines of constant curvature as polylines: joined, sampled, in the order of levels and surfaces.

Examples
--------
>>> import assoc_hull as ah
>>> import numpy as np
>>> u, v = np.mgrid[0:4, 0:4] / 3.0
>>> net = np.stack([u, v, np.array([0.0, 0.0, 0.0, 1.0])[:, None] + 0.1 * v**2], axis=-1)
>>> [piece.kind for piece in ah.curvature_regions(net, zero="exact").components]
[]
"""
