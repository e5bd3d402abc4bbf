"""How exact scaling is: of the map, of the exact image of a hull, and of the net carried by it.

``python -m benchmarks.affine_exactness [--ship NAME]`` prints a table for the shipped hulls, and
for the Duisburg Test Case where the data folder is there.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from datetime import UTC, datetime

import attrs
import numpy as np

import assoc_hull as ah
from assoc_hull.errors import AssocHullError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.hull.variants import Variation
from assoc_hull.variation.parameters.compose_map import compose_map
from assoc_hull.variation.parameters.field_layout import Layout
from assoc_hull.variation.parameters.parent import parent_of
from benchmarks.affine_image import affine_image
from benchmarks.ships import duisburg_test_case

__all__ = ["POWERS", "SCALINGS", "deviation", "image_row", "map_row", "off_image", "scaled"]

POWERS: dict[str, tuple[int, int, int]] = {
    "volume": (1, 1, 1), "waterplane_area": (1, 1, 0), "lcb": (1, 0, 0), "lcf": (1, 0, 0),
    "kb": (0, 0, 1), "cb": (0, 0, 0), "cm": (0, 0, 0), "cp": (0, 0, 0), "cw": (0, 0, 0),
}  # fmt: skip
"""With which powers of the factors along x, y and z what is measured grows."""

SCALINGS: dict[str, tuple[dict[str, float], tuple[float, float, float]]] = {
    "similarity": (
        {"length": 1.1, "breadth": 1.1, "draught": 1.1, "depth": 1.1}, (1.1, 1.1, 1.1),
    ),
    "length": ({"length": 1.02}, (1.02, 1.0, 1.0)),
    "breadth": ({"breadth": 1.03}, (1.0, 1.03, 1.0)),
    "draught": ({"draught": 1.05}, (1.0, 1.0, 1.05)),
    "depth": ({"depth": 0.96}, (1.0, 1.0, 1.0)),
}  # fmt: skip
"""Named parameters with ratios, and the factors of what is immersed."""


@attrs.frozen
class Row:
    """One scaling of one hull.

    Attributes
    ----------
    name : str
    ulps : float
        Of the map: largest difference from coordinate times ratio, units in the last place.
    image : float
        Of the exact image: largest relative difference of what is measured.
    volume : float
        Of the net: relative difference of the volume.
    rest : float
        Of the net: largest relative difference of all that is measured.
    off : tuple of float, m
        Of the curves of the net, how far each leaves its exact image at most: median and largest.
    beyond, curves : int
        How many leave it by more than the tolerance of lofting, of how many.
    added : int
        Points that hold the net to the image.
    trouble : str
    """

    name: str
    ulps: float
    image: float
    volume: float = np.nan
    rest: float = np.nan
    off: tuple[float, float] = (np.nan, np.nan)
    beyond: int = 0
    curves: int = 0
    added: int = 0
    trouble: str = ""

    def cells(self) -> tuple[str, ...]:
        """Give the row as a table has it."""
        first = (self.name, f"{self.ulps:.0f}", f"{self.image:.0e}")
        if self.trouble:
            return (*first, self.trouble, "", "", "", "")
        off = "/".join(f"{1e3 * each:.2g}" for each in self.off)
        return (
            *first, f"{self.volume:+.1e}", f"{self.rest:.1e}", off,
            f"{self.beyond} of {self.curves}", str(self.added),
        )  # fmt: skip


HEAD = ("scaling", "map, ulp", "exact image", "net: volume", "net: worst", "off the image, mm",
        "beyond 2 mm", "points added")  # fmt: skip


def deviation(
    before: ah.Hull, after: ah.Hull, factors: tuple[float, float, float]
) -> dict[str, float]:
    """Give by how much of itself what is measured differs from what the factors make of it."""
    old, new = (hull.hydrostatics(estimate=False) for hull in (before, after))
    found = dict[str, float]()
    for name, power in POWERS.items():
        grown = getattr(old, name) * float(np.prod(np.array(factors) ** power))
        found[name] = getattr(new, name) / grown - 1.0
    return found


def map_row(hull: ah.Hull, name: str) -> float:
    """Give how far the map of a scaling is from coordinate times ratio, at all points of a hull.

    In units of the last place; of heights only those up to the draught count, and for a depth what
    lies there keeps its bits.
    """
    ratios, _ = SCALINGS[name]
    state = hull.state
    parent = parent_of(state)
    now = {key: getattr(parent, key) for key in ratios}
    asked = {key: now[key] * ratio for key, ratio in ratios.items()}
    xyz: FloatArray = state.rows.xyz[state.live("rows")]
    xyz = xyz[xyz[:, 2] <= parent.draught]
    scale = [
        asked[key] / now[key] if key in asked else 1.0 for key in ("length", "breadth", "draught")
    ]
    goal = xyz * scale
    found = compose_map(parent, asked, Layout())(xyz)
    return float((np.abs(found - goal) / np.spacing(np.abs(goal))).max())


def image_row(hull: ah.Hull, name: str) -> float:
    """Give the largest deviation of the exact image of a scaling."""
    factors = SCALINGS[name][1]
    found = deviation(hull, affine_image(hull, factors), factors)
    return max(abs(each) for each in found.values())


def scaled(hull: ah.Hull, name: str) -> Variation[ah.Hull]:
    """Scale a net by named parameters."""
    now = hull.measure()
    return hull.vary(set={key: now[key] * by for key, by in SCALINGS[name][0].items()})


def off_image(hull: ah.Hull, found: Variation[ah.Hull]) -> FloatArray:
    """Give how far each curve of a varied net leaves its exact image at most, m.

    Curves of the parent that the variant has no more are left out.
    """
    before, after = hull.state, found.hull.state
    curve_of = {str(before.curves.key[c]): c for c in before.live("curves").tolist()}
    away = list[float]()
    for curve in after.live("curves").tolist():
        old = curve_of.get(str(after.curves.key[curve]))
        if old is not None:
            # the image of closely spaced chords: far finer than what is looked for
            image = found.map(sample(before.spline(old), 64)[1])
            away.append(_off_chords(sample(after.spline(curve), 4)[1], image))
    return np.array(away)


def _off_chords(xyz: FloatArray, chain: FloatArray) -> float:
    """Give the largest distance of places from a chain of chords."""
    step = np.diff(chain, axis=0)
    size = (step * step).sum(axis=1)
    along = ((xyz[:, None, :] - chain[:-1]) * step).sum(axis=2) / np.where(size > 0.0, size, 1.0)
    foot = chain[:-1] + np.clip(along, 0.0, 1.0)[:, :, None] * step
    return float(np.sqrt(((xyz[:, None, :] - foot) ** 2).sum(axis=2).min(axis=1)).max())


def _row(hull: ah.Hull, name: str) -> Row:
    ulps, image = map_row(hull, name), image_row(hull, name)
    try:
        varied = scaled(hull, name)
    except AssocHullError as error:
        return Row(name, ulps, image, trouble=str(error).replace("|", "/"))
    found, off = deviation(hull, varied.hull, SCALINGS[name][1]), off_image(hull, varied)
    return Row(
        name, ulps, image, found["volume"], max(map(abs, found.values())),
        (float(np.median(off)), float(off.max())), int((off > 2e-3).sum()), len(off),
        varied.report.added,
    )  # fmt: skip


SHIPS: dict[str, Callable[[], ah.Hull | None]] = {
    "wigley": ah.examples.wigley,
    "series60": ah.examples.series60,
    "carrier": ah.examples.bulk_carrier_207k,
    "dtc": duisburg_test_case,
}


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the tables."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.affine_exactness", description=__doc__
    )
    parser.add_argument("--ship", choices=tuple(SHIPS), action="append")
    chosen = parser.parse_args(arguments)
    print(datetime.now(UTC).date().isoformat())
    for ship in chosen.ship or SHIPS:
        hull = SHIPS[ship]()
        if hull is None:
            print("the data folder is not there: no DTC", file=sys.stderr)
            continue
        rows = [HEAD, tuple("---" for _ in HEAD), *(_row(hull, each).cells() for each in SCALINGS)]
        print(f"\n{hull.particulars.name}\n")
        print("\n".join(f"| {' | '.join(cells)} |" for cells in rows), flush=True)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
