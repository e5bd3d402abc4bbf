"""Section areas and moments of a bulk carrier, as printed: what the created one is held against.

The parent is that of A. Versluis 1977, as Table 3 of S.Y. Kim, S.W. Kang, "Ship Lines Creation by
B-Spline Form Parameter Method", Trans. SNAK 29(2), 1992, has it. Where the stations are is not
printed there: half ones at the ends give the block coefficient 0.75 and the centre of buoyancy
2.90 m forward of midship that are.

Examples
--------
>>> from assoc_hull.shipped.versluis_section_areas import AREAS, MOMENTS, X
>>> float(X[1]), float(AREAS[1]), round(float(MOMENTS[1] / AREAS[1]), 3)
(4.5, 16.25, 9.157)
"""

from __future__ import annotations

import numpy as np

__all__ = ["AREAS", "BREADTH", "DRAUGHT", "LPP", "MOMENTS", "X"]

LPP, BREADTH, DRAUGHT = 180.0, 28.0, 10.5
"""Main dimensions, m."""

# station (0 = AP), area below the draught in m2, its moment about the base line in m3
_TABLE = np.array([
    ( 0.0,   6.08,   59.0),
    ( 0.5,  16.25,  148.8),
    ( 1.0,  41.96,  313.1),
    ( 1.5,  69.92,  484.6),
    ( 2.0, 100.96,  665.3),
    ( 3.0, 164.84, 1013.1),
    ( 4.0, 221.68, 1289.3),
    ( 5.0, 262.87, 1460.1),
    ( 6.0, 284.36, 1528.1),
    ( 7.0, 291.30, 1541.6),
    ( 8.0, 292.59, 1543.0),
    ( 9.0, 292.58, 1542.9),
    (10.0, 292.59, 1542.9),
    (11.0, 292.59, 1543.0),
    (12.0, 292.58, 1542.9),
    (13.0, 292.63, 1543.0),
    (14.0, 291.95, 1542.3),
    (15.0, 285.60, 1528.7),
    (16.0, 261.94, 1433.4),
    (17.0, 215.92, 1215.1),
    (18.0, 150.47,  873.3),
    (18.5, 112.40,  663.9),
    (19.0,  72.24,  438.5),
    (19.5,  31.69,  205.9),
    (20.0,   0.00,    0.0),
])  # fmt: skip

X = _TABLE[:, 0] * LPP / 20.0
"""Places of the stations from AP, m; half stations at the ends."""

AREAS, MOMENTS = _TABLE[:, 1], _TABLE[:, 2]
"""Areas, m2, and their moments about the base line, m3, of both sides below the draught."""

X.flags.writeable = AREAS.flags.writeable = MOMENTS.flags.writeable = False
