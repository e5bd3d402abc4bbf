"""What is said of curvature regions beside their picture: areas, band, lines, notes, colours."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

import numpy as np

from assoc_hull.plot.block import ROW, title_block
from assoc_hull.plot.form_flow import wrapped
from assoc_hull.plot.paper import MARGIN
from assoc_hull.plot.pens import LINE
from assoc_hull.plot.plate_paint import BORDER, SIGNS, TINTS, hatched
from assoc_hull.plot.sheet import Sheet
from assoc_hull.surface.region_areas import RegionAreas
from assoc_hull.surface.region_result import RegionResult

__all__ = ["BLOCK", "area_words", "band_words", "legend", "region_block", "share_words"]

BLOCK = 84.0
"""Width of the block, mm at A3."""

_NAMES = {1: "convex", 0: "developable", -1: "saddle"}
_SMALL = 0.9


def band_words(result: RegionResult) -> dict[int, str]:
    """Say where each region is: by K0, or by K = 0."""
    if result.k0 > 0.0:
        return {1: "K > K0", 0: "|K| ≤ K0", -1: "K < −K0"}
    return {1: "K > 0", 0: "K = 0", -1: "K < 0"}


def area_words(area: float) -> str:
    """Give an area as it is written; small ones are not made nil."""
    return f"{area:.4f} m²" if area == 0.0 or area >= 1e-3 else f"{area:.2e} m²"


def share_words(areas: RegionAreas) -> str:
    """Give the shares of a plate in a line, by sign."""
    shares = {1: areas.positive_share, 0: areas.zero_share, -1: areas.negative_share}
    return ", ".join(f"{_NAMES[sign]} {100.0 * share:.2f} %" for sign, share in shares.items())


def region_block(sheet: Sheet, result: RegionResult, title: str) -> float:
    """Write what holds for the whole picture into the right upper corner; give the lower edge."""
    paper, factor = sheet.paper, sheet.paper.factor
    corner = (paper.width - MARGIN * factor, paper.height - MARGIN * factor)
    room = (BLOCK - 7.0) * factor
    notes = [line for words in result.notes for line in wrapped(sheet, words, room, 1.0)]
    return title_block(sheet, corner, BLOCK * factor, title, list(_facts(result)), notes)


def _facts(result: RegionResult) -> Iterator[tuple[str, str]]:
    """Give the rows of the block."""
    many = len(result.surfaces)
    yield ("Area" if many == 1 else f"Area of {many} plates"), area_words(result.total)
    yield "Error estimate of areas", f"{result.error_estimate:.1e} m²"
    if result.k0 > 0.0:
        yield "Band, K0", f"{result.k0:.4g} 1/m²"
    else:
        yield "Band", "none: K = 0"
    if result.strain_tol is not None and result.breadth is not None:
        yield "K0 = 8 ε/b²", f"ε {result.strain_tol:g}, b {result.breadth:g} m"
    if result.delta > 0.0:
        yield "Control points known to", f"{result.delta:.1e} m"
    counts = Counter(each.kind.replace("_", " ") for each in result.components)
    yield "Lines and spots", ", ".join(f"{n} {kind}" for kind, n in sorted(counts.items())) or "0"


def legend(sheet: Sheet, result: RegionResult, top: float) -> float:
    """Draw the colours with what they mean and how large each region is; give the lower edge."""
    factor = sheet.paper.factor
    right = sheet.paper.width - MARGIN * factor
    left, step = right - (BLOCK - 3.0) * factor, 1.35 * ROW * factor
    areas, words = result.areas, band_words(result)
    found = {1: areas.positive, 0: areas.zero, -1: areas.negative}
    y = top - 1.1 * step
    for sign, area in found.items():
        _swatch(sheet, left, y, sign)
        _row(sheet, left, y, f"{_NAMES[sign]}, {words[sign]}", area, areas.total)
        y -= step
    hatched(sheet, _rectangle(left, y, factor), "legend/unresolved")
    _row(sheet, left, y, "unresolved", areas.unresolved, areas.total)
    y -= step
    sheet.rule((left, y), (left + 7.0 * factor, y), BORDER, "legend/line")
    words_ = "K = K0 and K = −K0" if result.k0 > 0.0 else "K = 0"
    sheet.text((left + 9.0 * factor, y), words_, across="left", name="label/legend/line")
    return y - 0.7 * step


def _rectangle(left: float, y: float, factor: float) -> np.ndarray:
    wide, tall = 7.0 * factor, 2.1 * factor
    return np.array([(left, y - tall), (left + wide, y - tall), (left + wide, y + tall),
                     (left, y + tall)])  # fmt: skip


def _swatch(sheet: Sheet, left: float, y: float, sign: int) -> None:
    factor = sheet.paper.factor
    ring = _rectangle(left, y, factor)
    sheet.axes.fill(ring[:, 0], ring[:, 1], color=TINTS[sign], linewidth=0.0, zorder=1.5,
                    gid=f"legend/{sign}")  # fmt: skip
    sheet.line(np.concatenate([ring, ring[:1]]), LINE, "legend")
    place = (left + 3.5 * factor, y)
    sheet.text(place, SIGNS[sign], size=1.5, bold=True, name=f"label/legend/{sign}")


def _row(sheet: Sheet, left: float, y: float, words: str, area: float, total: float) -> None:
    factor = sheet.paper.factor
    right = sheet.paper.width - (MARGIN + 3.0) * factor
    share = 100.0 * area / total if total > 0.0 else 0.0
    sheet.text((left + 9.0 * factor, y), words, size=1.1, across="left", name="label/legend")
    sheet.text((right - 15.0 * factor, y), area_words(area), size=1.1, across="right",
               name="label/legend/area")  # fmt: skip
    sheet.text((right, y), f"{share:.2f} %", size=1.1, across="right", name="label/legend/share")
