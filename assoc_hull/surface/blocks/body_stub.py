from __future__ import annotations
import numpy as np, attrs
from assoc_hull.surface.blocks import whole_sections as ws
from assoc_hull.surface.blocks.block import Block, Stretch
from assoc_hull.geometry.fitting.samples import Samples
from assoc_hull.geometry.fitting.fit import fit_surface
from assoc_hull.geometry.fitting.breaks import subdivided, even


def lay_out(net, length, left_out=frozenset()):
    left = np.array([n in left_out for n in net.name])
    scale = length / 300
    sec = ws._whole(net, left)
    x = net.x[sec]
    mean = float(np.mean([ws._arc(net, i)[1][-1] for i in sec]))
    first = [ws._section(net, i, 0.25 * scale, mean) for i in sec]
    first = Samples(*(np.concatenate(e) for e in zip(*first)))
    f = fit_surface("b", first, subdivided(x, 2), even(0, mean, 30), 8e-11 * length**3, rounds=2)
    oth = [
        ws._other(net, i, 0.6 * scale, f.surface, x[[0, -1]])
        for i in range(net.batch.count)
        if i not in set(sec) and not left[i] and not np.isfinite(net.x[i])
    ]
    parts = [f.samples, *(e for e in oth if e is not None)]
    sa = Samples(
        *[np.concatenate([getattr(p, a.name) for p in parts]) for a in attrs.fields(Samples)]
    )
    ext = np.array([[x[0], x[-1]], [0, mean]])
    sides = {"u0": (), "u1": (), "v0": (), "v1": (Stretch(x[0], x[-1], centre=True),)}
    return (
        Block(
            "body", "body", 0, ext, ext, sa, np.ones(len(sa), bool), sides, x, np.array([0, mean])
        ),
    )
