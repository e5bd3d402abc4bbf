"""What a picture of plates is made of: from regions, or from plates with class and roll axis."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.plot.plates.plate_scene import STEPS, Scene, scene_of
from assoc_hull.surface.plates.plate import Plate
from assoc_hull.surface.plates.plate_table import Plates
from assoc_hull.surface.regions.region_areas import RegionAreas
from assoc_hull.surface.regions.region_component import Component
from assoc_hull.surface.regions.region_result import RegionResult

__all__ = ["REGIONS", "Entry", "Picture", "area_words", "picture_of", "shares_of"]

REGIONS = {1: "convex", 0: "developable", -1: "saddle"}
"""The regions by their sign."""

_ROUNDING = 1e-12
"""m: what control points are off by, if it is no more than this, is rounding."""

_STEPS_OF_MANY = 20
"""Tiles along a side of a plate that is one of several: it is drawn small."""


@attrs.frozen(eq=False)
class Entry:
    """One plate of a picture.

    Attributes
    ----------
    name : str
        Stands above it; may be empty.
    scene : Scene
        What is drawn.
    words : str
        Stands below it.
    axis : (3,) or None
        The direction it is rolled about.
    frame : (3, 3) or None
        Rows: along the plate, across it, its normal; None where it is found from the shape.
    result : RegionResult
        What holds the plate.
    number : int
        Its number there.
    """

    name: str
    scene: Scene
    words: str
    axis: FloatArray | None
    frame: FloatArray | None
    result: RegionResult
    number: int


@attrs.frozen(eq=False)
class Picture:
    """All plates of a picture, and what holds for all of them.

    Attributes
    ----------
    entries : tuple of Entry
        The plates.
    areas : RegionAreas
        Of all plates.
    banded : bool
        Whether there is a band about K = 0.
    facts : tuple of (str, str)
        Names and values of the block.
    notes : tuple of str
        Sentences below it.
    """

    entries: tuple[Entry, ...]
    areas: RegionAreas
    banded: bool
    facts: tuple[tuple[str, str], ...]
    notes: tuple[str, ...]


def picture_of(found: RegionResult | Plates) -> Picture:
    """Take a result, or plates, apart into what is drawn."""
    count = len(found) if isinstance(found, Plates) else len(found.surfaces)
    steps = STEPS if count == 1 else _STEPS_OF_MANY
    if isinstance(found, Plates):
        entries = tuple(_of_plate(found, number, steps) for number in range(count))
        results, notes = found.results, found.notes
        axes = any(entry.axis is not None for entry in entries)
        notes = (*(("Dash-dotted: the axis a plate is rolled about.",) if axes else ()), *notes)
    else:
        entries = tuple(_of_surface(found, number, steps) for number in range(count))
        results, notes = (found,), found.notes
    areas = RegionAreas.added(attrs.astuple(each.areas) for each in results)
    facts = tuple(_facts(results, areas, len(entries)))
    return Picture(entries, areas, results[0].k0 > 0.0, facts, notes)


def _of_surface(result: RegionResult, number: int, steps: int) -> Entry:
    name = result.surfaces[number].name or (f"{number + 1}" if len(result.surfaces) > 1 else "")
    words = shares_of(result.of_surface(number))
    return Entry(name, scene_of(result, number, steps), words, None, None, result, number)


def _of_plate(plates: Plates, number: int, steps: int) -> Entry:
    plate, result = plates[number], plates.result_of(number)
    scene = scene_of(result, plate.number, steps)
    frame = plate.axes * np.array([[1.0], [-1.0], [-1.0]])  # e2 runs down, e3 away from the eye
    words = _told(plate)
    return Entry(plate.name, scene, words, plate.roll_direction, frame, result, plate.number)


def _told(plate: Plate) -> str:
    """Say of which class a plate is, and how it is rolled."""
    parts = [plate.kind, shares_of(plate.areas)]
    if plate.roll_axis is not None:
        parts.append(f"roll axis {plate.roll_axis:.1f}°")
    return "; ".join(parts)


def area_words(area: float) -> str:
    """Give an area as it is written; a small one is not made nil."""
    return f"{area:.4f} m²" if area == 0.0 or area >= 1e-3 else f"{area:.2e} m²"


def shares_of(areas: RegionAreas) -> str:
    """Give the shares of regions in words; those that are nil are left out."""
    shares = {1: areas.positive_share, 0: areas.zero_share, -1: areas.negative_share}
    words = [f"{REGIONS[sign]} {100.0 * share:.2f} %" for sign, share in shares.items() if share]
    if areas.unresolved:
        words.append(f"unresolved {100.0 * areas.unresolved_share:.1g} %")
    return ", ".join(words)


def _facts(
    results: tuple[RegionResult, ...], areas: RegionAreas, many: int
) -> Iterator[tuple[str, str]]:
    """Give the rows of the block."""
    first, one = results[0], len(results) == 1
    yield ("Area" if many == 1 else f"Area of {many} plates"), area_words(areas.total)
    yield "Error estimate of areas", f"{areas.error_estimate:.1e} m²"
    if first.k0 == 0.0:
        yield "Band", "none: K = 0"
    elif one:
        yield "Band, K0", f"{first.k0:.4g} 1/m²"
    else:
        least, most = (f"{pick(each.k0 for each in results):.3g}" for pick in (min, max))
        yield "Band, K0 of each plate", f"{least} to {most} 1/m²"
    if first.strain_tol is not None and first.breadth is not None:
        own = f"{first.breadth:g} m" if one else "its own"
        yield "K0 = 8 ε/b²", f"ε {first.strain_tol:g}, b {own}"
    delta = max(each.delta for each in results)
    if delta > _ROUNDING:
        yield "Control points known to", f"{delta:.1e} m"
    yield "Lines and spots", _counted([each for result in results for each in result.components])


def _counted(components: list[Component]) -> str:
    """Count lines by their kind."""
    kinds = Counter(each.kind.replace("_", " ") for each in components)
    return ", ".join(f"{count} {kind}" for kind, count in sorted(kinds.items())) or "none"
