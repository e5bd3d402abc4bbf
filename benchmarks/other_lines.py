"""Hydrostatics of lines alone, on a layout that is kept, against those of a hull laid out anew.

``python -m benchmarks.other_lines`` prints milliseconds of a processor, the least of many: from
lines to volume, centroids, waterplane, wetted surface, stations, transom and the range of draughts,
at one position; how many times as long a new layout takes; and by how much numbers differ.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from importlib.util import find_spec

import attrs
import numpy as np

import assoc_hull as ah
from assoc_hull.analysis.derivatives.reused_layout import flotation_on_lines
from assoc_hull.analysis.hydrostatics.floating_body import FloatingPosition, planes_of
from assoc_hull.analysis.hydrostatics.flotation import Flotation, flotation
from assoc_hull.geometry.floating.immersion import FloatingPlanes, ImmersedIntegrals
from assoc_hull.geometry.splines.backend import set_backend
from assoc_hull.hull import Hull
from assoc_hull.model.program.engine import is_compiled
from assoc_hull.model.tables import copy_state

__all__ = ["OtherLines", "costs"]

_TIMES = 25


@attrs.frozen
class OtherLines:
    """Milliseconds by a new layout, by the one that is kept, and the greatest difference.

    `difference` is a part of the volume, or of the moment or area that differs.
    """

    anew: float
    kept: float
    difference: float


def costs(hull: Hull, position: FloatingPosition, arithmetic: str) -> OtherLines:
    """Measure a hull both ways; `arithmetic` is "numpy" or "numba"."""
    set_backend(arithmetic)  # type: ignore[arg-type]
    for _ in range(30):  # who asks often is given what is compiled
        is_compiled()
    base = flotation(hull.state)
    net, planes = base.net, planes_of([position], base.particulars.length)

    def anew() -> ImmersedIntegrals:
        return _measured(flotation(copy_state(hull.state)), planes)

    def kept() -> ImmersedIntegrals:
        found = flotation_on_lines(base, net.batch, net.x, net.place, net.normal)
        assert found is not None
        return _measured(found, planes)

    one, other = kept(), anew()
    fields = (field.name for field in attrs.fields(ImmersedIntegrals))
    pairs = [(getattr(one, name)[0], getattr(other, name)[0]) for name in fields]
    size = float(other.volume[0])
    off = max(abs(a - b) / max(abs(b), size) for a, b in pairs if np.isfinite(b))
    return OtherLines(_least(anew, 3), _least(kept, _TIMES), off)


def _measured(body: Flotation, planes: FloatingPlanes) -> ImmersedIntegrals:
    body.limits.mean_draughts(planes, body.particulars.length)
    body.stations(planes)
    body.transom(planes)
    return body.measure(planes)


def _least(work: Callable[[], object], times: int) -> float:
    found = []
    for _ in range(times):
        begin = time.process_time()
        work()
        found.append(time.process_time() - begin)
    return 1e3 * min(found)


def _ships() -> Iterator[tuple[str, Hull]]:
    yield "bulk carrier 207k", ah.examples.bulk_carrier_207k()
    yield "Series 60, CB 0.70", ah.examples.series60(0.70)
    yield "container ship", ah.examples.container_ship_225m()
    yield "Wigley", ah.examples.wigley()


def main() -> None:
    """Print all of it."""
    known = ["numpy", *(["numba"] if find_spec("numba") else [])]
    for name, hull in _ships():
        d = hull.particulars.draught
        upright, heeled = FloatingPosition(d, d), FloatingPosition(0.95 * d, 1.05 * d, 10.0)
        for arithmetic in known:
            for what, position in (("upright", upright), ("heeled 10 deg, trimmed", heeled)):
                each = costs(hull, position, arithmetic)
                print(
                    f"{name:20s} {arithmetic:6s} {what:24s} anew {each.anew:6.1f} ms, on lines "
                    f"{each.kept:6.2f} ms, {each.anew / each.kept:5.1f} times; "
                    f"differs by {each.difference:.0e}"
                )


if __name__ == "__main__":
    main()
