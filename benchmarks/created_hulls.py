"""Created hulls: to make them from definitions, and to give a definition another value.

``python -m benchmarks created_hulls``; each value set is taken back at once, and that counts, too.
"""

from __future__ import annotations

from collections.abc import Callable

import attrs

import assoc_hull as ah
from assoc_hull.shipped.bulk_carrier_180m import bulk_carrier_180m_design
from benchmarks.clock import Figure, side_by_side

__all__ = ["figures"]

_SETS = {
    "angle at the draught at one station": ("waterline angle", {"ST 3_y": 18.0}),
    "contour above the draught": ("profile", {"head_y": 18.6}),
    "area of the run, all sections of it": ("sectional areas", {"run_area": 0.5112}),
}


def _setting(hull: ah.Hull, name: str, values: dict[str, float]) -> Callable[[], None]:
    """Give the change of a definition, and its undoing, as one job."""

    def job() -> None:
        with hull.edit("set") as edit:
            edit.set_form(name, **values)
        hull.undo()

    return job


def _lofted_again(hull: ah.Hull, name: str, values: dict[str, float]) -> int:
    """Count the curves that a change of a definition lofts again."""
    with hull.edit("set") as edit:
        edit.set_form(name, **values)
    count = len(set(hull.history[-1].relofted))
    hull.undo()
    return count


def _fewer() -> ah.Hull:
    """Make the bulk carrier of every second station."""
    design = bulk_carrier_180m_design()
    return ah.create(attrs.evolve(design, stations=design.stations[::2]))


def figures(quick: bool = False) -> list[Figure]:
    """Measure: making anew and setting, side by side in one run."""
    hull = ah.examples.bulk_carrier_180m()
    jobs: dict[str, Callable[[], object]] = {
        "bulk carrier 180 m": ah.examples.bulk_carrier_180m,
        "the same of half its stations": _fewer,
        "container ship 225 m": ah.examples.container_ship_225m,
    }
    setting = {name: _setting(hull, *asked) for name, asked in _SETS.items()}
    times = side_by_side({**jobs, **setting}, 2 if quick else 5)
    found = [Figure(f"create: {name}", times[name], "s") for name in jobs]
    whole = times["bulk carrier 180 m"]
    grows = whole / times["the same of half its stations"]
    found.append(Figure("create: all stations / half of them", grows, "x", 3.0, "most"))
    for name in setting:
        found.append(Figure(f"set and undo: {name}", times[name], "s"))
        found.append(Figure("    curves lofted again", _lofted_again(hull, *_SETS[name]), ""))
        found.append(Figure("    create anew / set and undo", whole / times[name], "x", 5.0))
    return found
